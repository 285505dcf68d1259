/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Round shapes as triangles; see tubes.h. The radius of a cylinder's corners is such that its area is the circle's. */
#include "picture/figures/tubes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float pi = 3.14159265f;

void tubes_clear(tubes *t, uint32_t sides)
{
    t->vertices = t->triangles = 0;
    t->sides = sides < 3 ? 3 : sides;
    t->failed = 0;
}

void tubes_free(tubes *t)
{
    free(t->position);
    free(t->normal);
    free(t->index);
    free(t->entry);
    memset(t, 0, sizeof *t);
}

static int grow(void **memory, size_t bytes)
{
    void *larger = realloc(*memory, bytes);
    if (larger)
        *memory = larger;
    return larger ? 0 : -1;
}

/* Room for some more vertices and triangles. Returns 0, or -1 with `failed` set. */
static int reserve(tubes *t, uint32_t vertices, uint32_t triangles)
{
    const size_t v = (size_t)t->vertices + vertices, n = (size_t)t->triangles + triangles;
    if (t->failed || v > (size_t)1 << 31 || n > (size_t)1 << 31) {
        t->failed = 1;
        return -1;
    }
    if (v > t->vertex_capacity) {
        const size_t more = v + v / 2 + 64;
        t->failed = grow((void **)&t->position, more * 3 * sizeof(float)) ||
                    grow((void **)&t->normal, more * 3 * sizeof(float));
        t->vertex_capacity = t->failed ? 0 : more;
    }
    if (n > t->triangle_capacity && !t->failed) {
        const size_t more = n + n / 2 + 64;
        t->failed =
            grow((void **)&t->index, more * 3 * sizeof(uint32_t)) || grow((void **)&t->entry, more * sizeof(uint16_t));
        t->triangle_capacity = t->failed ? 0 : more;
    }
    return t->failed ? -1 : 0;
}

static uint32_t add_vertex(tubes *t, const float position[3], const float normal[3])
{
    memcpy(t->position + 3 * (size_t)t->vertices, position, 3 * sizeof(float));
    memcpy(t->normal + 3 * (size_t)t->vertices, normal, 3 * sizeof(float));
    return t->vertices++;
}

static void add_triangle(tubes *t, uint32_t a, uint32_t b, uint32_t c, uint16_t entry)
{
    memcpy(t->index + 3 * (size_t)t->triangles, (const uint32_t[]){a, b, c}, 3 * sizeof(uint32_t));
    t->entry[t->triangles++] = entry;
}

/* Unit vector from a to b and two at right angles to it. Returns its length, 0 where there is no direction. */
static float axes(const float a[3], const float b[3], float along[3], float u[3], float v[3])
{
    float length = 0.0f, largest = 0.0f;
    for (int c = 0; c < 3; c++) {
        along[c] = b[c] - a[c];
        largest = fmaxf(largest, fabsf(along[c]));
    }
    if (!(largest > 0.0f) || !isfinite(largest))
        return 0.0f;
    for (int c = 0; c < 3; c++)
        length += along[c] / largest * (along[c] / largest);
    length = largest * sqrtf(length);
    for (int c = 0; c < 3; c++)
        along[c] /= length;
    /* Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017. */
    const float sign = along[2] < 0.0f ? -1.0f : 1.0f, k = -1.0f / (sign + along[2]), m = along[0] * along[1] * k;
    memcpy(u, (const float[]){1.0f + sign * along[0] * along[0] * k, sign * m, -sign * along[0]}, 3 * sizeof *u);
    memcpy(v, (const float[]){m, sign + along[1] * along[1] * k, -along[1]}, 3 * sizeof *v);
    return isfinite(length) ? length : 0.0f;
}

/* The direction of corner i of the sides. */
static void corner(const tubes *t, uint32_t i, const float u[3], const float v[3], float out[3])
{
    const float angle = 2.0f * pi * (float)i / (float)t->sides;
    for (int c = 0; c < 3; c++)
        out[c] = cosf(angle) * u[c] + sinf(angle) * v[c];
}

/* Corners lie so far out that the polygon's area is that of the unit circle. */
static float corner_radius(const tubes *t)
{
    const float angle = 2.0f * pi / (float)t->sides;
    return sqrtf(angle / sinf(angle));
}

void tubes_add_cylinder(tubes *t, const float a[3], const float b[3], float radius, uint16_t entry)
{
    float along[3], u[3] = {0}, v[3] = {0}, n[3], p[3];
    if (!(axes(a, b, along, u, v) > 0.0f) || reserve(t, 2 * t->sides, 2 * t->sides))
        return;
    const uint32_t first = t->vertices;
    radius *= corner_radius(t);
    for (uint32_t i = 0; i < t->sides; i++) {
        corner(t, i, u, v, n);
        for (int end = 0; end < 2; end++) {
            for (int c = 0; c < 3; c++)
                p[c] = (end ? b : a)[c] + radius * n[c];
            add_vertex(t, p, n);
        }
    }
    for (uint32_t i = 0; i < t->sides; i++) {
        const uint32_t k = first + 2 * i, next = first + 2 * ((i + 1) % t->sides);
        add_triangle(t, k, next, k + 1, entry);
        add_triangle(t, next, next + 1, k + 1, entry);
    }
}

void tubes_add_cone(tubes *t, const float a[3], const float b[3], float radius, uint16_t entry)
{
    float along[3], u[3] = {0}, v[3] = {0}, out[3], n[3], p[3];
    const float length = axes(a, b, along, u, v);
    if (!(length > 0.0f) || reserve(t, 3 * t->sides + 1, 2 * t->sides))
        return;
    const uint32_t first = t->vertices;
    for (uint32_t i = 0; i < t->sides; i++) {
        corner(t, i, u, v, out);
        for (int c = 0; c < 3; c++) {
            p[c] = a[c] + radius * out[c];
            n[c] = out[c] * length + along[c] * radius; /* at right angles to the slope */
        }
        add_vertex(t, p, n);
        add_vertex(t, b, n);
        const float back[3] = {-along[0], -along[1], -along[2]};
        add_vertex(t, p, back);
    }
    const uint32_t middle = add_vertex(t, a, (const float[]){-along[0], -along[1], -along[2]});
    for (uint32_t i = 0; i < t->sides; i++) {
        const uint32_t k = first + 3 * i, next = first + 3 * ((i + 1) % t->sides);
        add_triangle(t, k, next, k + 1, entry);
        add_triangle(t, next + 2, k + 2, middle, entry);
    }
}

void tubes_add_ball(tubes *t, const float center[3], float radius, uint16_t entry)
{
    const uint32_t around = t->sides, rings = t->sides / 2 < 2 ? 2 : t->sides / 2;
    if (!isfinite(center[0] + center[1] + center[2]) || reserve(t, (rings + 1) * around, 2 * rings * around))
        return;
    const uint32_t first = t->vertices;
    for (uint32_t j = 0; j <= rings; j++)
        for (uint32_t i = 0; i < around; i++) {
            const float polar = pi * (float)j / (float)rings, angle = 2.0f * pi * (float)i / (float)around;
            const float n[3] = {sinf(polar) * cosf(angle), sinf(polar) * sinf(angle), cosf(polar)};
            const float p[3] = {center[0] + radius * n[0], center[1] + radius * n[1], center[2] + radius * n[2]};
            add_vertex(t, p, n);
        }
    for (uint32_t j = 0; j < rings; j++)
        for (uint32_t i = 0; i < around; i++) {
            const uint32_t k = first + j * around + i, next = first + j * around + (i + 1) % around;
            if (j > 0) /* at the poles a ring is a point */
                add_triangle(t, k, k + around, next, entry);
            if (j + 1 < rings)
                add_triangle(t, next, k + around, next + around, entry);
        }
}

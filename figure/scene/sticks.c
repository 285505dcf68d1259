/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Sticks; see sticks.h. The radius of a mesh's corners is such that a cylinder's area is the circle's. */
#include "scene/sticks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float pi = 3.14159265f;

void cgt_sticks_clear(sticks *s, uint32_t sides)
{
    s->count = s->vertices = s->triangles = 0;
    s->sides = sides < 3 ? 3 : sides;
    s->failed = 0;
}

void cgt_sticks_free(sticks *s)
{
    free(s->end);
    free(s->radius);
    free(s->entry);
    free(s->position);
    free(s->normal);
    free(s->index);
    free(s->mesh_entry);
    memset(s, 0, sizeof *s);
}

float cgt_sticks_visible(const sticks *s, const float place[3], float radius)
{
    double square = 0.0;
    for (int c = 0; c < 3; c++)
        square += ((double)place[c] - s->eye[c]) * ((double)place[c] - s->eye[c]);
    return fmaxf(radius, (float)(s->spread * sqrt(square) + s->least));
}

static int grow(void **memory, size_t bytes)
{
    void *larger = realloc(*memory, bytes);
    if (larger)
        *memory = larger;
    return larger ? 0 : -1;
}

/* ---- Capsules ----------------------------------------------------------------------------------------------- */

static int reserve_capsule(sticks *s)
{
    if (s->failed || s->count == (uint32_t)1 << 30)
        return s->failed = 1;
    if (s->count < s->capacity)
        return 0;
    const size_t more = s->capacity + s->capacity / 2 + 64;
    s->failed = grow((void **)&s->end, more * 6 * sizeof *s->end) ||
                grow((void **)&s->radius, more * sizeof *s->radius) ||
                grow((void **)&s->entry, more * 2 * sizeof *s->entry);
    s->capacity = s->failed ? 0 : more;
    return s->failed;
}

void cgt_sticks_add(sticks *s, const float a[3], const float b[3], float radius, uint16_t entry_a, uint16_t entry_b)
{
    const int is_point = a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
    const int is_finite =
        isfinite(a[0]) && isfinite(a[1]) && isfinite(a[2]) && isfinite(b[0]) && isfinite(b[1]) && isfinite(b[2]);
    if (is_point || !is_finite || reserve_capsule(s))
        return;
    memcpy(s->end + 6 * (size_t)s->count, a, 3 * sizeof *a);
    memcpy(s->end + 6 * (size_t)s->count + 3, b, 3 * sizeof *b);
    s->entry[2 * (size_t)s->count] = entry_a;
    s->entry[2 * (size_t)s->count + 1] = entry_b;
    s->radius[s->count++] = radius;
}

/* ---- Meshes ------------------------------------------------------------------------------------------------- */

/* Room for some more vertices and triangles. Returns 0, or -1 with `failed` set. */
static int reserve(sticks *s, uint32_t vertices, uint32_t triangles)
{
    const size_t v = (size_t)s->vertices + vertices, n = (size_t)s->triangles + triangles;
    if (s->failed || v > (size_t)1 << 30 || n > (size_t)1 << 30) {
        s->failed = 1;
        return -1;
    }
    if (v > s->vertex_capacity) {
        const size_t more = v + v / 2 + 64;
        s->failed = grow((void **)&s->position, more * 3 * sizeof(float)) ||
                    grow((void **)&s->normal, more * 3 * sizeof(float));
        s->vertex_capacity = s->failed ? 0 : more;
    }
    if (n > s->triangle_capacity && !s->failed) {
        const size_t more = n + n / 2 + 64;
        s->failed = grow((void **)&s->index, more * 3 * sizeof(uint32_t)) ||
                    grow((void **)&s->mesh_entry, more * sizeof(uint16_t));
        s->triangle_capacity = s->failed ? 0 : more;
    }
    return s->failed ? -1 : 0;
}

static uint32_t add_vertex(sticks *s, const float position[3], const float normal[3])
{
    memcpy(s->position + 3 * (size_t)s->vertices, position, 3 * sizeof(float));
    memcpy(s->normal + 3 * (size_t)s->vertices, normal, 3 * sizeof(float));
    return s->vertices++;
}

static void add_triangle(sticks *s, uint32_t a, uint32_t b, uint32_t c, uint16_t entry)
{
    memcpy(s->index + 3 * (size_t)s->triangles, (const uint32_t[]){a, b, c}, 3 * sizeof(uint32_t));
    s->mesh_entry[s->triangles++] = entry;
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
static void corner(const sticks *s, uint32_t i, const float u[3], const float v[3], float out[3])
{
    const float angle = 2.0f * pi * (float)i / (float)s->sides;
    for (int c = 0; c < 3; c++)
        out[c] = cosf(angle) * u[c] + sinf(angle) * v[c];
}

/* Corners lie so far out that the polygon's area is that of the unit circle. */
static float corner_radius(const sticks *s)
{
    const float angle = 2.0f * pi / (float)s->sides;
    return sqrtf(angle / sinf(angle));
}

void cgt_sticks_add_cylinder(sticks *s, const float a[3], const float b[3], float radius, uint16_t entry)
{
    float along[3], u[3] = {0}, v[3] = {0}, n[3], p[3];
    if (!(axes(a, b, along, u, v) > 0.0f) || reserve(s, 2 * s->sides, 2 * s->sides))
        return;
    const uint32_t first = s->vertices;
    radius *= corner_radius(s);
    for (uint32_t i = 0; i < s->sides; i++) {
        corner(s, i, u, v, n);
        for (int end = 0; end < 2; end++) {
            for (int c = 0; c < 3; c++)
                p[c] = (end ? b : a)[c] + radius * n[c];
            add_vertex(s, p, n);
        }
    }
    for (uint32_t i = 0; i < s->sides; i++) {
        const uint32_t k = first + 2 * i, next = first + 2 * ((i + 1) % s->sides);
        add_triangle(s, k, next, k + 1, entry);
        add_triangle(s, next, next + 1, k + 1, entry);
    }
}

void cgt_sticks_add_cone(sticks *s, const float a[3], const float b[3], float radius, uint16_t entry)
{
    float along[3], u[3] = {0}, v[3] = {0}, out[3], n[3], p[3];
    const float length = axes(a, b, along, u, v);
    if (!(length > 0.0f) || reserve(s, 3 * s->sides + 1, 2 * s->sides))
        return;
    const uint32_t first = s->vertices;
    for (uint32_t i = 0; i < s->sides; i++) {
        corner(s, i, u, v, out);
        for (int c = 0; c < 3; c++) {
            p[c] = a[c] + radius * out[c];
            n[c] = out[c] * length + along[c] * radius; /* at right angles to the slope */
        }
        add_vertex(s, p, n);
        add_vertex(s, b, n);
        const float back[3] = {-along[0], -along[1], -along[2]};
        add_vertex(s, p, back);
    }
    const uint32_t middle = add_vertex(s, a, (const float[]){-along[0], -along[1], -along[2]});
    for (uint32_t i = 0; i < s->sides; i++) {
        const uint32_t k = first + 3 * i, next = first + 3 * ((i + 1) % s->sides);
        add_triangle(s, k, next, k + 1, entry);
        add_triangle(s, next + 2, k + 2, middle, entry);
    }
}

void cgt_sticks_add_ball(sticks *s, const float center[3], float radius, uint16_t entry)
{
    const uint32_t around = s->sides, rings = s->sides / 2 < 2 ? 2 : s->sides / 2;
    if (!isfinite(center[0] + center[1] + center[2]) || reserve(s, (rings + 1) * around, 2 * rings * around))
        return;
    const uint32_t first = s->vertices;
    for (uint32_t j = 0; j <= rings; j++)
        for (uint32_t i = 0; i < around; i++) {
            const float polar = pi * (float)j / (float)rings, angle = 2.0f * pi * (float)i / (float)around;
            const float n[3] = {sinf(polar) * cosf(angle), sinf(polar) * sinf(angle), cosf(polar)};
            const float p[3] = {center[0] + radius * n[0], center[1] + radius * n[1], center[2] + radius * n[2]};
            add_vertex(s, p, n);
        }
    for (uint32_t j = 0; j < rings; j++)
        for (uint32_t i = 0; i < around; i++) {
            const uint32_t k = first + j * around + i, next = first + j * around + (i + 1) % around;
            if (j > 0) /* at the poles a ring is a point */
                add_triangle(s, k, k + around, next, entry);
            if (j + 1 < rings)
                add_triangle(s, next, k + around, next + around, entry);
        }
}

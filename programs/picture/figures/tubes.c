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

float tubes_visible(const tubes *t, const float place[3], float radius)
{
    double square = 0.0;
    for (int c = 0; c < 3; c++)
        square += ((double)place[c] - t->eye[c]) * ((double)place[c] - t->eye[c]);
    return fmaxf(radius, (float)(t->spread * sqrt(square) + t->least));
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

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Turns u to a right angle with the direction `along` by the shortest way: frames along a path do not twist. Where u
 * has come to lie along it, any right angle will do. v completes the two. */
static void transport(const float along[3], float u[3], float v[3])
{
    const float share = dot(u, along);
    float length = 0.0f, other[3], origin[3] = {0.0f, 0.0f, 0.0f};
    for (int c = 0; c < 3; c++)
        u[c] -= share * along[c];
    length = sqrtf(dot(u, u));
    if (length > 1e-3f)
        for (int c = 0; c < 3; c++)
            u[c] /= length;
    else
        axes(origin, along, other, u, v);
    v[0] = along[1] * u[2] - along[2] * u[1];
    v[1] = along[2] * u[0] - along[0] * u[2];
    v[2] = along[0] * u[1] - along[1] * u[0];
}

/* The direction of a path at place k: halfway between those of the pieces that meet there; where the path goes straight
 * back, at a right angle to both, as in any other hairpin. */
static void direction_at(const float (*place)[3], uint32_t count, uint32_t k, float along[3])
{
    float before[3] = {0.0f}, after[3] = {0.0f}, sum[3], u[3], v[3];
    const float origin[3] = {0.0f, 0.0f, 0.0f};
    if (k > 0)
        axes(place[k - 1], place[k], before, u, v);
    if (k + 1 < count)
        axes(place[k], place[k + 1], after, u, v);
    for (int c = 0; c < 3; c++)
        sum[c] = before[c] + after[c];
    if (dot(sum, sum) < 1e-6f || !(axes(origin, sum, along, u, v) > 0.0f)) {
        axes(origin, after, sum, u, v);
        memcpy(along, u, 3 * sizeof *along);
    }
}

/* The corners of a path at one place, with normals away from it. */
static void add_ring(tubes *t, const float place[3], float radius, const float u[3], const float v[3])
{
    float n[3], p[3];
    for (uint32_t i = 0; i < t->sides; i++) {
        corner(t, i, u, v, n);
        for (int c = 0; c < 3; c++)
            p[c] = place[c] + radius * n[c];
        add_vertex(t, p, n);
    }
}

/* A flat end of a path, seen from where `out` points: back along the path, or on along it. */
static void add_end(tubes *t, const float place[3], float radius, const float out[3], int is_start, const float u[3],
                    const float v[3], uint16_t entry)
{
    const uint32_t middle = add_vertex(t, place, out);
    add_ring(t, place, radius, u, v);
    for (uint32_t i = 0; i < t->sides; i++) {
        memcpy(t->normal + 3 * ((size_t)middle + 1 + i), out, 3 * sizeof *out);
        const uint32_t corner_at = middle + 1 + i, next = middle + 1 + (i + 1) % t->sides;
        add_triangle(t, middle, is_start ? next : corner_at, is_start ? corner_at : next, entry);
    }
}

void tubes_add_path(tubes *t, const float (*place)[3], const float *radius, uint32_t count, uint16_t entry)
{
    float along[3], back[3], u[3] = {1.0f, 0.0f, 0.0f}, v[3];
    if (count < 2 || reserve(t, (count + 2) * t->sides + 2, 2 * count * t->sides))
        return;
    const float out = corner_radius(t);
    for (uint32_t k = 0; k < count; k++) {
        direction_at(place, count, k, along);
        transport(along, u, v);
        for (int c = 0; c < 3 && k == 0; c++)
            back[c] = -along[c];
        if (k == 0)
            add_end(t, place[0], out * radius[0], back, 1, u, v, entry);
        const uint32_t ring = t->vertices, before = ring - t->sides;
        add_ring(t, place[k], out * radius[k], u, v);
        for (uint32_t i = 0; i < t->sides && k > 0; i++) {
            const uint32_t next = (i + 1) % t->sides;
            add_triangle(t, before + i, before + next, ring + i, entry);
            add_triangle(t, before + next, ring + next, ring + i, entry);
        }
    }
    add_end(t, place[count - 1], out * radius[count - 1], along, 0, u, v, entry);
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

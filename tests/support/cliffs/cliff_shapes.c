/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Troubles of shapes and of order: thin triangles, triangles of one vertex, primitives that are skipped, a mesh whose
 * sample lies. */
#include "support/cliffs/cliffs.h"

#include <math.h>
#include <string.h>

#define TURN 6.28318530717958648

/* A disc of triangles that share its centre. */
void cliff_fan(cliff_scene *s, test_random *r, float amount)
{
    (void)r;
    for (uint32_t i = 0; i < s->count; i++) {
        float *p = s->data + (size_t)9 * i;
        memset(p, 0, 3 * sizeof *p);
        for (uint32_t k = 1; k < 3; k++) {
            const double angle = TURN * (i + k - 1) / s->count;
            p[3 * k] = (float)cos(angle);
            p[3 * k + 1] = (float)sin(angle);
            p[3 * k + 2] = amount * p[3 * k];
        }
    }
}

/* As long as the scene, and so wide. */
void cliff_slivers(cliff_scene *s, test_random *r, float amount)
{
    for (uint32_t i = 0; i < s->count; i++) {
        float along[3], across[3], *p = s->data + (size_t)9 * i;
        random_direction(r, along);
        random_direction(r, across);
        for (int a = 0; a < 3; a++) {
            const float start = random_float(r, -1, 1);
            p[a] = start;
            p[3 + a] = start + along[a];
            p[6 + a] = start + amount * across[a];
        }
    }
}

static void swap_triangles(cliff_scene *s, uint32_t i, uint32_t k)
{
    float held[9];
    memcpy(held, s->data + (size_t)9 * i, sizeof held);
    memcpy(s->data + (size_t)9 * i, s->data + (size_t)9 * k, sizeof held);
    memcpy(s->data + (size_t)9 * k, held, sizeof held);
}

/* The triangles of a mesh in any order. */
void cliff_shuffled(cliff_scene *s, test_random *r, float amount)
{
    (void)amount;
    for (uint32_t i = s->count - 1; i > 0; i--)
        swap_triangles(s, i, random_below(r, i + 1));
}

/* Whether a triangle is one of eight that builders/choose_clusters.c samples. */
static bool is_sampled(uint32_t triangle, uint32_t count)
{
    const uint32_t full = count / 8, cluster = triangle / 8;
    bool sampled = false;
    for (uint32_t k = 1; k <= 64 && !sampled; k++)
        sampled = (uint32_t)((uint64_t)(k * 0x9e3779b9u) * full >> 32) == cluster;
    return sampled;
}

/* The triangles of a mesh in any order, but for those that are sampled. */
void cliff_lying_sample(cliff_scene *s, test_random *r, float amount)
{
    uint32_t before = 0;
    (void)amount;
    for (uint32_t i = 1; i < s->count; i++) {
        if (is_sampled(i, s->count))
            continue;
        const uint32_t other = random_below(r, i);
        swap_triangles(s, i, is_sampled(other, s->count) ? before : other);
        before = i;
    }
}

/* This share of the triangles has no area. */
void cliff_no_area(cliff_scene *s, test_random *r, float amount)
{
    for (uint32_t i = 0; i < s->count; i++) {
        float *p = s->data + (size_t)9 * i;
        if (random_float(r, 0, 1) < amount)
            memcpy(p + 6, p + 3, 3 * sizeof *p);
    }
}

/* This share of the primitives is not finite; of spheres as many have a negative radius. */
void cliff_invalid(cliff_scene *s, test_random *r, float amount)
{
    for (uint32_t i = 0; i < s->count; i++) {
        float *p = s->data + (size_t)i * cliff_floats(s);
        const float at = random_float(r, 0, 1);
        if (at < amount)
            p[i % 3] = i % 2 ? NAN : INFINITY;
        else if (at < 2 * amount && s->base == CLIFF_CLOUD)
            p[3] = -p[3];
    }
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Troubles of planes: lights and rays in the plane of a mesh, faces that lie on each other. */
#include "support/cliffs/cliffs.h"

#include <math.h>
#include <string.h>

/* Above or in front of the plane; in it are the points whose height is `slope` times their first coordinate. */
static void see_plane(cliff_scene *s, int normal, float slope)
{
    const float eye[3] = {0.7f, 1.5f, -2};
    s->camera.fov = 50;
    for (int a = 0; a < 3; a++) {
        s->camera.eye[(normal + a) % 3] = eye[(1 + a) % 3];
        s->light[(normal + a) % 3] = a == 0 ? slope * 0.2f : a == 1 ? 0.2f : 0.1f;
    }
    if (normal == 1)
        return;
    s->camera.up[0] = s->camera.up[1] = s->camera.up[2] = 0;
    s->camera.up[normal] = 1;
}

/* A mesh of squares across an axis, the height rounded to floats; the light lies in its plane. */
static void make_mesh(cliff_scene *s, int normal, float slope)
{
    const uint32_t columns = (uint32_t)ceil(sqrt(s->count / 2.0));
    for (uint32_t i = 0; i < s->count; i++) {
        const uint32_t square = i / 2;
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t corner = i % 2 + k; /* of a square: 0, 1, 2 and 1, 2, 3 */
            const float u = (float)(square % columns + corner % 2) / (float)columns * 2 - 1;
            const float v = (float)(square / columns + corner / 2) / (float)columns * 2 - 1;
            float *p = s->data + (size_t)9 * i + (size_t)3 * k;
            p[normal] = slope * u;
            p[(normal + 1) % 3] = u;
            p[(normal + 2) % 3] = v;
        }
    }
    s->size = 1 / (float)columns;
    see_plane(s, normal, slope);
}

void cliff_floor(cliff_scene *s, test_random *r, float amount)
{
    (void)r;
    make_mesh(s, 1, amount);
}

void cliff_wall(cliff_scene *s, test_random *r, float amount)
{
    (void)r;
    make_mesh(s, 0, amount);
}

/* All triangles in one plane, seven on each other, their vertices on a lattice; the light is above. */
void cliff_decals(cliff_scene *s, test_random *r, float amount)
{
    const float size = 3 / sqrtf((float)s->count);
    for (uint32_t i = 0; i < s->count; i++) {
        const float middle[2] = {random_float(r, -1, 1), random_float(r, -1, 1)};
        float *p = s->data + (size_t)9 * i;
        for (int k = 0; k < 3; k++, p += 3) {
            p[0] = roundf((middle[0] + random_float(r, -1, 1) * size) * 1024) / 1024;
            p[2] = roundf((middle[1] + random_float(r, -1, 1) * size) * 1024) / 1024;
            p[1] = amount * p[0];
        }
    }
    s->size = size;
    see_plane(s, 1, 0);
    s->light[1] = 1;
}

/* The second half of the triangles lies on the first, seen from behind. */
void cliff_double_faces(cliff_scene *s, test_random *r, float amount)
{
    (void)r;
    (void)amount;
    for (uint32_t i = 0; i < s->count / 2; i++) {
        const float *from = s->data + (size_t)9 * i;
        float *to = s->data + (size_t)9 * (s->count / 2 + i);
        for (int k = 0; k < 3; k++)
            memcpy(to + (size_t)3 * (2 - k), from + (size_t)3 * k, 3 * sizeof *to);
    }
}

/* From anywhere to anywhere in the plane of cliff_floor or cliff_wall. */
void cliff_bend_into_plane(const cliff_scene *s, test_random *r, float amount, uint32_t i, truth_ray *ray)
{
    const int normal = (int)amount;
    (void)s;
    (void)r;
    (void)i;
    ray->org[normal] = ray->dir[normal] = 0;
    if (ray->dir[(normal + 1) % 3] == 0)
        ray->dir[(normal + 1) % 3] = 1;
}

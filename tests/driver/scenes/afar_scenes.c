/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tiny spheres or triangles near a place that the foot of a ray from afar is near, too, and where floats are coarse:
 * the origin, moved there, is off by more than leaves allow for at that distance. */
#include <math.h>
#include <string.h>

#include "driver/rays/lines.h"
#include "driver/scenes/scene_heap.h"

#define TINY 32u /* in one leaf or two, each with a ray of its own */
#define SIZE 0x1p-12f

static truth_ray own[TINY]; /* of the last scene */

static double along(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static double random_real(test_random *r) { return (double)random_float(r, -1, 1); }

/* A vector of this length, across d. */
static void random_across(test_random *r, const double d[3], double length, double v[3])
{
    float any[3];
    random_direction(r, any);
    const double share = ((double)any[0] * d[0] + (double)any[1] * d[1] + (double)any[2] * d[2]) / along(d, d);
    for (int a = 0; a < 3; a++)
        v[a] = (double)any[a] - share * d[a];
    const double scale = length / sqrt(along(v, v));
    for (int a = 0; a < 3; a++)
        v[a] *= scale;
}

/* Aims a ray at a place from afar. foot: where it passes, off by what floats of the origin are. */
static void aim_from_afar(test_random *r, const float dir[3], const double place[3], truth_ray *ray, double foot[3])
{
    const double far = (double)random_log(r, 0x1p9f, 0x1p12f);
    double d[3], to[3];
    *ray = (truth_ray){.t_max = INFINITY};
    for (int a = 0; a < 3; a++) {
        d[a] = (double)dir[a];
        ray->dir[a] = dir[a];
        ray->org[a] = (float)(place[a] - far * d[a]);
        to[a] = place[a] - (double)ray->org[a];
    }
    const double t = along(to, d) / along(d, d);
    for (int a = 0; a < 3; a++)
        foot[a] = (double)ray->org[a] + t * d[a];
}

/* A sphere and a triangle whose silhouettes pass the ray at a few times the error of its origin. */
static void make_tiny_pair(test_random *r, const double d[3], const double foot[3], float sphere[4], float corner[9])
{
    double side[3], edge[3], offset[3], square = 0, share = 0;
    random_across(r, d, (double)SIZE, side);
    for (int a = 0; a < 3; a++) {
        sphere[a] = (float)(foot[a] + side[a]);
        offset[a] = (double)sphere[a] - foot[a];
    }
    share = along(offset, d) / along(d, d);
    for (int a = 0; a < 3; a++)
        square += (offset[a] - share * d[a]) * (offset[a] - share * d[a]);
    sphere[3] = (float)(sqrt(square) + random_real(r) * 0x1p-25);
    random_across(r, d, (double)SIZE, edge);
    for (int a = 0; a < 3; a++) {
        const double at = foot[a] + 0x1p-25 * random_real(r);
        corner[a] = (float)(at + edge[a]);
        corner[3 + a] = (float)(at - edge[a]);
        corner[6 + a] = (float)(at + side[a]);
    }
}

/* The last two primitives are the scene's ends, so that its middle is the origin. */
static void add_ends(scene_heap *h, bool spheres)
{
    for (int i = 0; i < 2; i++) {
        const float end = i ? 1.9f : -1.9f;
        float *const p = scene_heap_add(h, spheres ? ORACLE_SPHERE : ORACLE_TRIANGLE);
        for (int k = 0; k < (spheres ? 3 : 9); k++)
            p[k] = end - (!spheres && k / 3 == k % 3 ? copysignf(0x1p-10f, end) : 0);
        if (spheres)
            p[3] = 0x1p-20f;
    }
}

static void make(scene_heap *h, uint32_t family)
{
    test_random *const r = h->r;
    float dir[3], sphere[4], corner[9];
    double d[3], place[3];
    random_direction(r, dir);
    for (int a = 0; a < 3; a++)
        d[a] = (double)dir[a];
    random_across(r, d, (double)random_float(r, 1.2f, 1.8f), place);
    for (uint32_t i = 0; i < TINY; i++) {
        double to[3], foot[3];
        for (int a = 0; a < 3; a++)
            to[a] = place[a] + 4 * (double)SIZE * random_real(r);
        aim_from_afar(r, dir, to, &own[i], foot);
        make_tiny_pair(r, d, foot, sphere, corner);
        if (family == 0)
            memcpy(scene_heap_add(h, ORACLE_SPHERE), sphere, sizeof sphere);
        else
            memcpy(scene_heap_add(h, ORACLE_TRIANGLE), corner, sizeof corner);
    }
    add_ends(h, family == 0);
}

static const char *family_name(uint32_t family) { return family ? "tiny triangles" : "tiny spheres"; }

const scene_group afar_scenes = {2, family_name, make};

void afar_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    (void)s;
    for (uint32_t i = 0; i < count; i++)
        ray[i].line = own[i % TINY];
}

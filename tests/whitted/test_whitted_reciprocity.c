/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reciprocity of whole paths: light that takes a path through glass backwards loses as much as forwards. Each path that
 * leaves a scene is traced once more from its end, and must come back with the same weight. Fresnel's shares agree on
 * both sides of a surface, Beer's law knows no direction; the squares of the indices, by which radiance changes at a
 * surface, cancel on a path that begins and ends outside. Where bodies overlap, their priorities say what is in
 * both (whitted.h); of equal ones it would be the one entered last, which is another one on the way back. */
#include <math.h>
#include <string.h>

#include "support/suite.h"
#include "whitted/whitted_scenes.h"

enum { BOUNCES = 7, LONGEST = 5, MOST_ENDS = 512 };

/* Where paths leave the scene. */
typedef struct ends {
    uint32_t count;
    uint32_t bounce[MOST_ENDS];
    float org[MOST_ENDS][3], dir[MOST_ENDS][3], weight[MOST_ENDS][3];
} ends;

static whitted_scene scene;

static const cgt_material materials[] = {
    {.kind = CGT_MATERIAL_GLASS, .index = 1.5f, .absorption = {0.3f, 0.1f, 0}},
    {.kind = CGT_MATERIAL_GLASS, .index = 1.2f, .absorption = {0, 0.2f, 0.4f}},
    {.kind = CGT_MATERIAL_MIRROR, .color = {0.9f, 0.8f, 0.7f}},
    {.kind = CGT_MATERIAL_GLASS, .index = 1.3f, .absorption = {0.1f, 0.4f, 0.2f}, .priority = 1},
    {.kind = CGT_MATERIAL_GLASS, .index = 1.7f, .absorption = {0.2f, 0, 0.1f}, .priority = 7},
};

static void watch(void *user, uint32_t bounce, const whitted_ray *ray, const whitted_hit *hit)
{
    ends *e = user;
    if (hit->primitive != CGT_INVALID_ID || bounce == 0 || e->count == MOST_ENDS)
        return;
    assert_int_equal(ray->nested, 0);
    e->bounce[e->count] = bounce;
    memcpy(e->org[e->count], ray->org, sizeof ray->org);
    memcpy(e->dir[e->count], ray->dir, sizeof ray->dir);
    memcpy(e->weight[e->count++], ray->weight, sizeof ray->weight);
}

static void find_ends(const float org[3], const float dir[3], ends *e)
{
    float from[1][3], along[1][3], light[1][3];
    e->count = 0;
    memcpy(from[0], org, sizeof from[0]);
    memcpy(along[0], dir, sizeof along[0]);
    scene.w.watch_user = e;
    whitted_scene_trace(&scene, 1, (const float(*)[3])from, (const float(*)[3])along, light);
}

/* How far the line through `org` along `dir` passes from a point, and how far the directions are apart. */
static double distance(const float org[3], const float dir[3], const float point[3], const float back[3])
{
    double to[3], along = 0, square = 0, turn = 0;
    for (int a = 0; a < 3; a++) {
        to[a] = (double)point[a] - (double)org[a];
        along += to[a] * (double)dir[a];
    }
    for (int a = 0; a < 3; a++) {
        const double off = to[a] - along * (double)dir[a], apart = (double)dir[a] + (double)back[a];
        square += off * off;
        turn += apart * apart;
    }
    return sqrt(square) + sqrt(turn);
}

/* The error of a path grows by 2 l / r at each curved surface (path_error.h), at most 8 here, and hardly at
 * planes; a share of light changes by less than 2 to an angle of 1 but for grazing rays, whose paths are faint. */
static double bound_of(double growth, uint32_t bounce) { return 0x1p-22 * pow(growth, bounce); }

/* Follows the path that ends at `k` back. Returns whether it ends where the first one began. */
static bool comes_back(const float org[3], const float dir[3], const ends *forward, uint32_t k, double bound,
                       double *error)
{
    static ends backward;
    float from[3], along[3];
    double nearest = INFINITY;
    uint32_t at = 0;
    for (int a = 0; a < 3; a++) {
        from[a] = forward->org[k][a] + 2.0f * forward->dir[k][a];
        along[a] = -forward->dir[k][a];
    }
    find_ends(from, along, &backward);
    for (uint32_t i = 0; i < backward.count; i++) {
        if (backward.bounce[i] != forward->bounce[k])
            continue;
        const double here = distance(backward.org[i], backward.dir[i], org, dir);
        if (here < nearest)
            nearest = here, at = i;
    }
    *error = 0;
    for (int c = 0; c < 3 && nearest < INFINITY; c++)
        *error = fmax(*error, fabs((double)backward.weight[at][c] - (double)forward->weight[k][c]));
    return nearest <= 4.0 * bound;
}

static void check_paths(const char *name, double growth, uint32_t rays)
{
    static ends forward;
    test_random r = random_make(8);
    double worst[LONGEST + 1] = {0};
    uint32_t paths[LONGEST + 1] = {0}, lost = 0, all = 0;
    scene.w.watch = watch;
    scene.w.bounces = BOUNCES;
    scene.w.faintest = 0;
    for (uint32_t i = 0; i < rays; i++) {
        const float org[3] = {random_float(&r, -3, 3), random_float(&r, -3, 3), -6};
        float dir[3], length = 0;
        for (int a = 0; a < 3; a++) {
            dir[a] = random_float(&r, -0.8f, 0.8f) - org[a];
            length += dir[a] * dir[a];
        }
        for (int a = 0; a < 3; a++)
            dir[a] /= sqrtf(length);
        find_ends(org, dir, &forward);
        for (uint32_t k = 0; k < forward.count; k++) {
            const uint32_t bounce = forward.bounce[k];
            const float *w = forward.weight[k];
            double error;
            if (bounce > LONGEST || fmaxf(w[0], fmaxf(w[1], w[2])) < 0.01f)
                continue;
            all++;
            if (!comes_back(org, dir, &forward, k, bound_of(growth, bounce), &error)) {
                lost++; /* an edge or a silhouette lies within the error */
                continue;
            }
            paths[bounce]++;
            worst[bounce] = fmax(worst[bounce], error);
        }
    }
    for (uint32_t k = 1; k <= LONGEST; k++) {
        print_message("%s: %u bounces: %u paths, weights differ by %.3g, bound %.3g\n", name, (unsigned)k,
                      (unsigned)paths[k], worst[k], bound_of(growth, k));
        assert_true(worst[k] <= bound_of(growth, k));
    }
    print_message("%s: %u of %u paths did not come back\n", name, (unsigned)lost, (unsigned)all);
    assert_true(all > rays / 2 && lost * 200 <= all);
}

TEST(through_balls)
{
    whitted_scene_begin(&scene, materials, TEST_COUNT(materials));
    whitted_scene_add_sphere(&scene, 0, 0, 0, 1, 0);
    whitted_scene_add_sphere(&scene, 0.1f, 0.1f, 0.2f, 0.5f, 1); /* inside the first */
    whitted_scene_add_sphere(&scene, 1.7f, -0.9f, 1, 0.8f, 1);   /* beside it */
    whitted_scene_commit(&scene, NULL, 1);
    check_paths("balls", 8, test_between(300, 600));
    whitted_scene_end(&scene);
}

TEST(through_boxes)
{
    whitted_scene_begin(&scene, materials, TEST_COUNT(materials));
    whitted_scene_add_cube(&scene, (const float[3]){-0.9f, -0.9f, -0.6f}, (const float[3]){0.8f, 0.9f, 0.4f}, false, 0);
    whitted_scene_add_cube(&scene, (const float[3]){-0.5f, -0.4f, -0.2f}, (const float[3]){0.6f, 0.3f, 0.3f}, false, 1);
    whitted_scene_add_cube(&scene, (const float[3]){-3, -1.4f, -3}, (const float[3]){3, -1.2f, 3}, false, 2);
    whitted_scene_commit(&scene, NULL, 1);
    check_paths("boxes", 2, test_between(300, 600));
    whitted_scene_end(&scene);
}

TEST(through_overlaps)
{
    whitted_scene_begin(&scene, materials, TEST_COUNT(materials));
    whitted_scene_add_sphere(&scene, 0, 0, 0, 1, 0);
    whitted_scene_add_sphere(&scene, 0.7f, 0.2f, 0.3f, 0.8f, 3);
    whitted_scene_add_sphere(&scene, 0.1f, -0.6f, 0.5f, 0.7f, 4);
    whitted_scene_add_cube(&scene, (const float[3]){-0.9f, -0.9f, -0.1f}, (const float[3]){-0.2f, 0.8f, 1.4f}, false,
                           3);
    whitted_scene_commit(&scene, NULL, 1);
    check_paths("overlaps", 8, test_between(300, 600));
    whitted_scene_end(&scene);
}

SEEDED_SUITE("test_whitted_reciprocity", NULL, NULL)

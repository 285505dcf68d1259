/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A plugin with a copy of the library of its own, from the archive: test_process loads it beside others. */
#include <cgt/cgt.h>

typedef cgt_result create_function(const cgt_context_options *, cgt_context **);

/* Traces some rays with a context of its own; returns the sum of their t, or a negative value. create: gets the
 * function that it calls. */
__attribute__((visibility("default"))) double plugin_trace(uint32_t threads, create_function **create)
{
    enum { SPHERES = 2000, RAYS = 500 };
    static const float dir[3][1] = {{0}, {0}, {-1}};
    float center[SPHERES][3], org[3][RAYS], to[3][RAYS], t[RAYS];
    const cgt_spheres spheres = {.count = SPHERES, .centers = cgt_floats(center[0], 0), .radius = 0.4f};
    const cgt_rays rays = {.count = RAYS, .org = {org[0], org[1], org[2]}, .dir = {to[0], to[1], to[2]}};
    const cgt_hits hits = {.t = t};
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    double sum = 0;
    *create = cgt_context_create;
    for (int i = 0; i < SPHERES; i++)
        center[i][0] = (float)(i % 17), center[i][1] = (float)(i % 19), center[i][2] = (float)(i % 23);
    for (int i = 0; i < RAYS; i++)
        for (int a = 0; a < 3; a++) {
            org[a][i] = a == 2 ? 40 : (float)(i % (17 + a));
            to[a][i] = dir[a][0];
        }
    if (cgt_context_create(&(cgt_context_options){.threads = threads}, &context) != CGT_OK ||
        cgt_scene_create(context, NULL, &scene) != CGT_OK || cgt_scene_set_spheres(scene, NULL, &spheres) != CGT_OK ||
        cgt_scene_commit(scene) != CGT_OK || cgt_trace_rays(scene, &rays, &hits, NULL) != CGT_OK)
        sum = -1e30;
    for (int i = 0; i < RAYS && sum >= 0; i++)
        sum += t[i] < 1e9f ? (double)t[i] : 1;
    cgt_scene_release(scene);
    cgt_context_release(context);
    return sum;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A user's first program: one sphere, one ray, one hit. Only the public header. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <cgt/cgt.h>

static int cast(cgt_scene *scene)
{
    const float center[3] = {0.f, 0.f, 0.f};
    const cgt_spheres spheres = {.count = 1, .centers = cgt_floats(center, 0), .radius = 1.f};
    const float org[3][2] = {{0.f, 3.f}, {0.f, 0.f}, {5.f, 5.f}}; /* two rays along -z, the second misses the sphere */
    const float dir[3][2] = {{0.f, 0.f}, {0.f, 0.f}, {-1.f, -1.f}};
    const cgt_rays rays = {.count = 2, .org = {org[0], org[1], org[2]}, .dir = {dir[0], dir[1], dir[2]}};
    float t[2] = {0.f, 0.f};
    uint32_t primitive[2] = {7, 7};
    const cgt_hits hits = {.t = t, .primitive = primitive};

    uint32_t geometry = CGT_INVALID_ID;
    if (cgt_scene_set_spheres(scene, &geometry, &spheres) != CGT_OK || geometry != 0)
        return 1;
    if (cgt_scene_commit(scene) != CGT_OK || cgt_trace_rays(scene, &rays, &hits, NULL) != CGT_OK)
        return 1;
    printf("t %g %g, primitive %u %u\n", (double)t[0], (double)t[1], (unsigned)primitive[0], (unsigned)primitive[1]);
    return !(t[0] == 4.f && primitive[0] == 0 && isinf(t[1]) && primitive[1] == CGT_INVALID_ID);
}

int main(void)
{
    if (strcmp(cgt_get_version(), CGT_VERSION_STRING) != 0) {
        fprintf(stderr, "header %s, library %s\n", CGT_VERSION_STRING, cgt_get_version());
        return 1;
    }
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    int status = 1;
    if (cgt_context_create(NULL, &context) == CGT_OK && cgt_scene_create(context, NULL, &scene) == CGT_OK)
        status = cast(scene);
    if (status) {
        char text[256];
        cgt_context_get_error_message(context, text, sizeof text);
        fprintf(stderr, "wrong: %s\n", text);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
    return status;
}

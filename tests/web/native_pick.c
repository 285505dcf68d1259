/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * native_pick FILE CAMERA WIDTH HEIGHT X Y...   what the pixels of a file's first frame show: a number for each pair,
 * -1: nothing. By the public calls alone. */
#include <stdio.h>
#include <stdlib.h>

#include <cgt/cgt.h>
#include <cgt/trajectory.h>

int main(int argc, char **argv)
{
    cgt_camera c;
    cgt_trajectory *t;
    cgt_context *context;
    cgt_scene *scene;
    cgt_trajectory_frame f;
    cgt_camera_init(&c);
    if (argc < 7 || sscanf(argv[2], "%f,%f,%f,%f,%f,%f,%f,%f,%f,%f", &c.eye[0], &c.eye[1], &c.eye[2], &c.target[0],
                           &c.target[1], &c.target[2], &c.up[0], &c.up[1], &c.up[2], &c.fov) != 10)
        return 2;
    if (cgt_trajectory_open(argv[1], NULL, &t) != CGT_OK || cgt_trajectory_read(t, &f) != CGT_OK) {
        char error[256];
        cgt_trajectory_get_error_message(t, error, sizeof error);
        fprintf(stderr, "%s\n", error);
        return 1;
    }
    const cgt_spheres spheres = {
        .count = f.count, .centers = cgt_floats(f.xyzr, 16), .radii = cgt_floats(f.xyzr + 3, 16)};
    if (cgt_context_create(NULL, &context) || cgt_scene_create(context, NULL, &scene) ||
        cgt_scene_set_spheres(scene, NULL, &spheres) || cgt_scene_commit(scene))
        return 1;
    for (int i = 5; i + 1 < argc; i += 2) {
        cgt_single_ray ray = {0};
        cgt_hit hit;
        if (cgt_camera_get_ray(&c, (uint32_t)atoi(argv[3]), (uint32_t)atoi(argv[4]), (uint32_t)atoi(argv[i]),
                               (uint32_t)atoi(argv[i + 1]), ray.org, ray.dir) ||
            cgt_trace_ray(scene, &ray, &hit, NULL))
            return 1;
        printf("%d\n", (int)hit.primitive);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
    cgt_trajectory_close(t);
    return 0;
}

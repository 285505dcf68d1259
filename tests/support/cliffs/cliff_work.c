/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The calls of cliffs, and what they count. */
#include "support/cliffs/cliffs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "query/camera.h"

const char *cliff_call_name(cliff_call call)
{
    static const char *const name[CLIFF_CALLS] = {"commit", "camera", "light", "single", "rays", "occluded"};
    return name[call];
}

const char *cliff_structure_name(cliff_structure structure)
{
    static const char *const name[CLIFF_STRUCTURES] = {"auto", "loose-grid", "bvh", "bih"};
    return name[structure];
}

bool cliff_concerns(const cliff *c, cliff_call call) { return c->disturb || call > CLIFF_LIGHT; }

bool cliff_has_structure(cliff_base base, cliff_structure structure)
{
    return base != CLIFF_STICKS || structure != CLIFF_BIH;
}

cgt_scene_options cliff_structure_options(cliff_structure structure)
{
    static const cgt_structure value[CLIFF_STRUCTURES] = {CGT_STRUCTURE_AUTO, CGT_STRUCTURE_LOOSE_GRID,
                                                          CGT_STRUCTURE_BVH, CGT_STRUCTURE_BIH};
    cgt_scene_options options;
    cgt_scene_options_init(&options);
    options.structure = value[structure];
    return options;
}

/* Weights are rough, as measured: a step in single precision works on a whole vector or cache line and takes about 4
 * ns, a test of one ray in double about 100 ns, one in whole numbers about a microsecond. */
double cliff_work(const cgt_trace_statistics *trace, const cgt_research_trace_statistics *research)
{
    const double blocks = (double)trace->ray_tests / 16 + (double)trace->packet_tests;
    const double places = 2 * (double)(research->nodes + research->leaves + research->slices + trace->packets) +
                          (double)(research->cells + research->references + research->cull_tests) / 4;
    const double decisions =
        24 * (double)trace->double_tests + 200 * (double)(trace->exact_tests + trace->exact_values);
    return blocks + places + decisions;
}

/* ---- points to be lit ---- */

void cliff_points_free(cliff_points *points)
{
    free(points->point);
    memset(points, 0, sizeof *points);
}

cgt_points cliff_points_array(const cliff_points *points)
{
    const cliff_point *p = points->point;
    return (cgt_points){.count = points->count,
                        .stride = sizeof *p,
                        .position = {&p->position[0], &p->position[1], &p->position[2]},
                        .skip_primitive = &p->primitive};
}

static void keep_points(const cliff_scene *scene, uint32_t width, uint32_t height, const float *t,
                        const uint32_t *primitive, cliff_points *points)
{
    char message[CGT_CAMERA_MESSAGE_BYTES];
    cgt_camera_rays rays;
    if (cgt_camera_prepare(&scene->camera, width, height, &rays, message) != CGT_OK)
        return;
    for (uint32_t k = 0; k < width * height; k++) {
        float org[3], dir[3], *p = points->point[points->count].position;
        if (primitive[k] == CGT_INVALID_ID)
            continue;
        cgt_camera_pixel(&rays, k % width, k / width, org, dir);
        for (int a = 0; a < 3; a++)
            p[a] = org[a] + t[k] * dir[a];
        points->point[points->count].primitive = primitive[k];
        points->count += isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
    }
}

bool cliff_make_points(const cliff_scene *scene, const cgt_scene *committed, uint32_t width, uint32_t height,
                       cliff_points *points)
{
    const size_t pixels = (size_t)width * height;
    cgt_frame frame;
    cgt_frame_init(&frame, width, height);
    frame.t = malloc(pixels * sizeof(float));
    frame.primitive = malloc(pixels * sizeof(uint32_t));
    *points = (cliff_points){.point = malloc((pixels + 1) * sizeof *points->point)}; /* one that is not kept */
    const bool good = frame.t && frame.primitive && points->point &&
                      cgt_trace_camera(committed, &scene->camera, &frame, NULL) == CGT_OK;
    if (good)
        keep_points(scene, width, height, frame.t, frame.primitive, points);
    else
        cliff_points_free(points);
    free(frame.t);
    free(frame.primitive);
    return good;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames as hits of rays. */
#include "structures/scenes/picture.h"

#include <stdlib.h>
#include <string.h>

picture picture_make(uint32_t width, uint32_t height)
{
    picture q = {.p = planes_make(width, height)};
    q.uv = malloc(2 * q.p.elements * sizeof *q.uv);
    q.hit = malloc(q.p.elements * sizeof *q.hit);
    assert_true(q.uv && q.hit);
    return q;
}

void picture_free(picture *q)
{
    planes_free(&q->p);
    free(q->uv);
    free(q->hit);
    *q = (picture){.uv = NULL};
}

void picture_trace(const cgt_scene *scene, const cgt_camera *camera, const cgt_trace_options *options, picture *q)
{
    const size_t pixels = q->p.elements;
    cgt_frame frame = frame_of(&q->p);
    memset(q->p.memory, 0x77, 6 * pixels * sizeof *q->p.memory);
    memset(q->uv, 0x77, 2 * pixels * sizeof *q->uv);
    frame.u = q->uv;
    frame.v = q->uv + pixels;
    assert_int_equal(cgt_trace_camera(scene, camera, &frame, options), CGT_OK);
    for (size_t i = 0; i < pixels; i++)
        q->hit[i] = (full_hit){q->p.t[i],
                               q->p.primitive[i],
                               q->p.geometry[i],
                               {q->p.normal[0][i], q->p.normal[1][i], q->p.normal[2][i]},
                               {frame.u[i], frame.v[i]}};
}

void picture_aim(hard_scene *s, const cgt_camera *camera, uint32_t width, uint32_t height)
{
    cgt_camera_rays pixels;
    char message[160];
    if (cgt_camera_prepare(camera, width, height, &pixels, message) != CGT_OK)
        fail_msg("%s", message);
    s->rays = 0;
    s->wanted = width * height;
    for (uint32_t i = 0; i < s->wanted; i++) {
        const truth_ray ray = camera_ray(&pixels, i % width, i / width);
        hard_raw_ray(s, &ray);
    }
    assert_false(s->failed);
    assert_int_equal(s->rays, width * height);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera, its lights and what is right about them, between judge_frames.c and judge_shadows.c. */
#ifndef JUDGE_VIEW_H
#define JUDGE_VIEW_H

#include "oracle/judge/judge_run.h"

/* All planes of a frame, dense. */
typedef struct frame_planes {
    float t[JUDGE_PIXELS], normal[3][JUDGE_PIXELS], u[JUDGE_PIXELS], v[JUDGE_PIXELS], position[3][JUDGE_PIXELS];
    uint32_t primitive[JUDGE_PIXELS], geometry[JUDGE_PIXELS];
} frame_planes;

typedef struct judge_view {
    cgt_camera camera;
    uint32_t width, height, pixels;
    bool has_rays, has_first;
    judge_ray ray[JUDGE_PIXELS];
    judge_truth right[JUDGE_PIXELS];
    frame_planes got, first;
    cgt_light light[JUDGE_LIGHTS];
    cgt_shadow_options shadows;
    judge_ray to_light[JUDGE_LIGHTS][JUDGE_PIXELS];
    judge_truth shadow[JUDGE_LIGHTS][JUDGE_PIXELS];
    judge_ray to_point[JUDGE_POINTS]; /* from points, to the first light */
    judge_truth point_shadow[JUDGE_POINTS];
    cgt_ambient_options ambient;
    bool has_ambient;
    uint32_t open[2][JUDGE_PIXELS]; /* rays that hit nothing: at least, at most */
    float first_visibility[JUDGE_PIXELS];
} judge_view;

static inline bool judge_is_hit(const judge_view *w, uint32_t i) { return w->got.primitive[i] != CGT_INVALID_ID; }

/* org + t dir in float. */
void judge_position(const judge_view *w, uint32_t i, float p[3]);

/* Before the first setup: lights, and points against the first one. */
void judge_shadows_begin(judge_run *run, judge_view *w);

/* The rays from the hits of the first setup, which the others must have. */
void judge_shadows_find(judge_run *run, judge_view *w);

void judge_points_ask(judge_run *run, judge_view *w);
void judge_shadows_ask(judge_run *run, judge_view *w, const cgt_frame *frame);

#endif

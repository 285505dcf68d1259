/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera, its lights and what is right about them, between the files of calls that need it. */
#ifndef VIEW_H
#define VIEW_H

#include "driver/driver.h"

/* All planes of the rows that are asked for, dense. */
typedef struct frame_planes {
    float t[DRIVER_PIXELS], normal[3][DRIVER_PIXELS], u[DRIVER_PIXELS], v[DRIVER_PIXELS], position[3][DRIVER_PIXELS];
    uint32_t primitive[DRIVER_PIXELS], geometry[DRIVER_PIXELS];
} frame_planes;

typedef struct driver_view {
    cgt_camera camera;
    uint32_t width, height, first_row, rows, pixels; /* pixels: of these rows */
    uint32_t every;                                  /* one pixel of so many is judged, all are compared */
    bool has_rays, has_first;
    judge_ray ray[DRIVER_PIXELS];
    judge_truth right[DRIVER_PIXELS];
    frame_planes got, first;
    cgt_light light[DRIVER_LIGHTS];
    cgt_shadow_options shadows;
    judge_ray to_light[DRIVER_LIGHTS][DRIVER_PIXELS];
    judge_truth shadow[DRIVER_LIGHTS][DRIVER_PIXELS];
    uint32_t lit, lit_every;               /* points, against the first light; one of so many is judged */
    bool lit_ranges, lit_skips, lit_masks; /* else all see everything as far as the light */
    judge_ray to_lit[DRIVER_LIT];
    judge_truth lit_shadow[DRIVER_LIT];
    cgt_ambient_options ambient;
    bool has_ambient;
    uint32_t open[2][DRIVER_PIXELS]; /* rays that hit nothing: at least, at most */
    float first_visibility[DRIVER_PIXELS];
} driver_view;

/* Whether frames or points are so many that a part is judged, and the others are compared. */
static inline bool driver_samples(const driver_run *run)
{
    return run->profile->pixels || run->profile->lit > DRIVER_JUDGED;
}

/* So that about as many are judged as then may be. */
static inline uint32_t driver_every(const driver_run *run, uint32_t of, uint32_t sample)
{
    return 1 + of / (driver_samples(run) ? sample : DRIVER_JUDGED);
}

/* One of `every`, anywhere. */
static inline bool driver_is_one_of(uint32_t every, uint32_t i) { return (i * 2654435761u >> 12) % every == 0; }

static inline bool driver_is_hit(const driver_view *w, uint32_t i) { return w->got.primitive[i] != CGT_INVALID_ID; }

/* Before the first setup: the camera, and the size of its frame. */
void driver_camera_make(driver_run *run, driver_view *w);

/* org + t dir in float. */
static inline void driver_place(const truth_ray *line, float t, float p[3])
{
    for (int a = 0; a < 3; a++) {
        const float way = t * line->dir[a];
        p[a] = line->org[a] + way;
    }
}

static inline void driver_position(const driver_view *w, uint32_t i, float p[3])
{
    driver_place(&w->ray[i].line, w->got.t[i], p);
}

/* Before the first setup: lights. */
void driver_shadows_begin(driver_run *run, driver_view *w);
judge_ray driver_ray_to(const cgt_light *light, const float from[3]);

/* The rays from the hits of the first setup, which the others must have. */
void driver_shadows_find(driver_run *run, driver_view *w);

/* The points against the first light. */
void driver_points_begin(driver_run *run, driver_view *w);
void driver_points_ask(driver_run *run, driver_view *w);
void driver_shadows_ask(driver_run *run, driver_view *w, const cgt_frame *frame);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What cgt-render chooses where the command line does not: colours, camera, light; see render_setup.h. */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "render/render_setup.h"

/* Whether spheres jump by most of the extent in one frame, as through the boundary of a box that the file does not
 * tell. */
static int has_jumps(const survey *s)
{
    int jumps = 0;
    for (int c = 0; c < 3 && s->kind == TRAJECTORY_SPHERES; c++)
        jumps |= s->boxless_steps[c] > 0.5f * (s->bounds_max[c] - s->bounds_min[c]);
    return jumps;
}

/* What the colours show. */
static coloring_by choose_coloring(const renderer *r)
{
    const survey *s = &r->survey;
    if (r->options.by != COLORING_AUTO)
        return r->options.by;
    if (s->has_element)
        return COLORING_ELEMENT;
    if (s->has_type && s->type_max > s->type_min)
        return COLORING_TYPE;
    if (s->kind == TRAJECTORY_TRIANGLES)
        return COLORING_PLAIN;
    return survey_speed_quantile(s, 1.0) > 0.0f && !has_jumps(s) ? COLORING_SPEED : COLORING_ID;
}

/* The values at the ends of the map, from the survey. */
static void choose_range(const renderer *r, coloring_by by, int axis, float *min, float *max)
{
    const survey *s = &r->survey;
    const float fastest = survey_speed_quantile(s, 0.99);
    if (by == COLORING_SPEED) {
        *min = 0.0f;
        *max = fastest > 0.0f ? fastest : survey_speed_quantile(s, 1.0);
    } else if (by == COLORING_ID && s->id_min <= s->id_max) {
        *min = (float)s->id_min;
        *max = (float)s->id_max;
    } else if (by == COLORING_VALUE && s->values) {
        *min = (float)(r->options.logarithmic && isfinite(s->value_least) ? s->value_least : s->value_min);
        *max = (float)s->value_max;
    } else if (by == COLORING_HEIGHT && s->drawable) {
        *min = s->bounds_min[axis];
        *max = s->bounds_max[axis];
    }
}

int render_choose_colors(renderer *r)
{
    const render_options *o = &r->options;
    const coloring_by by = choose_coloring(r);
    const int axis = o->up[0] != 0.0f ? 0 : o->up[1] != 0.0f ? 1 : 2;
    float min = o->range_min, max = o->range_max;
    if (!o->has_range)
        choose_range(r, by, axis, &min, &max);
    const int is_chosen = o->by == COLORING_AUTO && by == COLORING_ID;
    if ((is_chosen || by == COLORING_SPEED) && has_jumps(&r->survey) && share_is_first(&r->share))
        program_error("spheres move by more than half of the run's extent in one frame, as through the boundary of a "
                      "periodic box, but the file has no box: %s",
                      is_chosen ? "colours are not chosen by speed" : "speeds may be false");
    if (by != COLORING_SPEED && !(r->formula && expression_uses(r->formula, "speed"))) {
        speed_release(r->source.tracker);
        r->source.tracker = NULL;
    }
    if (by == COLORING_PLAIN ? coloring_init_plain(&r->coloring, o->plain)
                             : coloring_init(&r->coloring, by, o->map, min, max)) {
        program_error("out of memory");
        return -1;
    }
    render_scene_color(r);
    r->coloring.axis = axis;
    r->coloring.formula = r->formula;
    r->coloring.logarithmic = o->logarithmic && by != COLORING_TYPE && by != COLORING_PLAIN && min > 0.0f;
    if (o->logarithmic && !r->coloring.logarithmic)
        program_error("--log-scale: there is nothing above 0 to scale: the scale is linear");
    return 0;
}

/* What the camera must show of a bulk: all within its bounds where that is among the samples, else the bounds. */
static void narrow_reach(survey *s, const camera_fit *fit)
{
    const bulk *const b = &s->bulk;
    camera_reach within;
    camera_reach_clear(&within);
    if (b->count < b->seen)
        camera_reach_add_box(&within, fit, s->bounds_min, s->bounds_max);
    for (uint32_t i = 0; i < b->count && b->count == b->seen; i++) {
        const float *const p = b->sample[i].place;
        const double place[3] = {(double)p[0], (double)p[1], (double)p[2]};
        int is_inside = 1;
        for (int c = 0; c < 3; c++)
            is_inside &= p[c] - p[3] >= s->bounds_min[c] && p[c] + p[3] <= s->bounds_max[c];
        if (is_inside)
            camera_reach_add(&within, fit, place, (double)p[3]);
    }
    for (uint32_t k = 0; k < fit->count; k++)
        s->reach.along[k] = fmin(s->reach.along[k], within.along[k]);
}

/* The camera, and what depends on the scene's size, follow the bulk: one primitive that has flown off must not make all
 * others a dot. */
static void follow_bulk(renderer *r)
{
    survey *s = &r->survey;
    int narrowed;
    const float was_min[3] = {s->bounds_min[0], s->bounds_min[1], s->bounds_min[2]};
    const float was_max[3] = {s->bounds_max[0], s->bounds_max[1], s->bounds_max[2]};
    const uint64_t outside = bulk_narrow(&s->bulk, s->bounds_min, s->bounds_max, &narrowed);
    if (narrowed)
        narrow_reach(s, renderer_fit(r));
    if (!narrowed || r->options.has_camera || !share_is_first(&r->share))
        return;
    program_error("the camera follows the bulk, from (%g, %g, %g) to (%g, %g, %g), and leaves out about %" PRIu64
                  " of %" PRIu64 " %s of the run, which reaches from (%g, %g, %g) to (%g, %g, %g)",
                  (double)s->bounds_min[0], (double)s->bounds_min[1], (double)s->bounds_min[2],
                  (double)s->bounds_max[0], (double)s->bounds_max[1], (double)s->bounds_max[2], outside, s->drawable,
                  s->kind == TRAJECTORY_TRIANGLES ? "triangles" : "spheres", (double)was_min[0], (double)was_min[1],
                  (double)was_min[2], (double)was_max[0], (double)was_max[1], (double)was_max[2]);
}

int render_choose_camera(renderer *r)
{
    const render_options *o = &r->options;
    const camera_fit *const fit = renderer_fit(r);
    survey *const s = &r->survey;
    if (s->drawable)
        follow_bulk(r);
    if (o->has_camera) {
        camera_path_fixed(&r->path, &o->camera, (double)o->orbit);
        return render_scene_bound(r);
    }
    if (render_scene_bound(r))
        return -1;
    if (!s->drawable) {
        for (int c = 0; c < 3; c++) {
            s->bounds_min[c] = -1.0f;
            s->bounds_max[c] = 1.0f;
        }
        camera_reach_add_box(&s->reach, fit, s->bounds_min, s->bounds_max);
    }
    if (camera_path_fit(&r->path, fit, &s->reach, s->bounds_min, s->bounds_max) == 0)
        return 0;
    program_error("%s: the scene, from (%g, %g, %g) to (%g, %g, %g), is too large for an automatic camera: give one "
                  "with -c",
                  o->input, (double)s->bounds_min[0], (double)s->bounds_min[1], (double)s->bounds_min[2],
                  (double)s->bounds_max[0], (double)s->bounds_max[1], (double)s->bounds_max[2]);
    return -1;
}

void render_choose_light(renderer *r)
{
    float light[3], length = 0.0f, axis[3][3];
    for (int c = 0; c < 3; c++)
        light[c] = r->options.light[c];
    if (!r->options.has_light) {
        const float aspect = (float)r->options.width / (float)r->options.height;
        draw_half_picture(&r->camera, aspect, axis[0], axis[1], axis[2]);
        float right = 0.0f, up = 0.0f;
        for (int c = 0; c < 3; c++) {
            right += axis[0][c] * axis[0][c];
            up += axis[1][c] * axis[1][c];
        }
        for (int c = 0; c < 3; c++)
            light[c] = 0.70f * axis[1][c] / sqrtf(up) - 0.45f * axis[0][c] / sqrtf(right) - 0.55f * axis[2][c];
    }
    for (int c = 0; c < 3; c++)
        length = fmaxf(length, fabsf(light[c]));
    float sum = 0.0f;
    for (int c = 0; c < 3; c++) { /* divide by the largest, so that squares of finite floats stay finite */
        r->light[c] = light[c] / length;
        sum += r->light[c] * r->light[c];
    }
    for (int c = 0; c < 3; c++)
        r->light[c] /= sqrtf(sum);
}

void render_camera_at(const renderer *r, uint64_t number, cgt_camera *camera)
{
    const double share = r->survey.has_total ? (double)number / (double)r->survey.total : 0.0;
    if (r->options.keys.count)
        camera_keys_at(&r->options.keys, number, camera);
    else
        camera_path_at(&r->path, share, camera);
}

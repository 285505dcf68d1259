/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What cgt-render chooses where the command line does not: colours, camera, light; see render_setup.h. */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "playback/origin.h"
#include "render/render_setup.h"

/* ---- Origin ------------------------------------------------------------------------------------------------- */

/* `more` is as seen from the origin so far. */
static void take_origin(renderer *r, const double more[3], const char *what)
{
    for (int c = 0; c < 3; c++)
        r->origin[c] += more[c];
    cgt_trajectory_set_origin(r->source.file, r->origin);
    origin_tell(r->origin, what);
}

void render_choose_camera_origin(renderer *r)
{
    const camera_key *const camera = &r->options.figure.camera;
    double eye[3], target[3], origin[3];
    for (int c = 0; c < 3; c++) {
        eye[c] = camera->eye[c] - r->origin[c];
        target[c] = camera->target[c] - r->origin[c];
    }
    if (r->options.figure.has_camera && !r->options.reading.has_origin && origin_of_camera(eye, target, origin))
        take_origin(r, origin, "the camera looks at places");
}

int render_choose_bulk_origin(renderer *r)
{
    double origin[3];
    if (!r->has_survey || r->options.figure.has_camera || r->options.reading.has_origin ||
        r->survey.kind == CGT_TRAJECTORY_TRIANGLES || !origin_of_bulk(&r->survey.bulk, origin))
        return 0;
    take_origin(r, origin, "the spheres are");
    return 1;
}

int render_move_cameras(renderer *r)
{
    render_options *const o = &r->options;
    int same = o->figure.has_camera && camera_key_move(&o->figure.camera, r->origin);
    for (size_t k = 0; k < o->figure.keys.count; k++)
        same |= camera_key_move(&o->figure.keys.key[k], r->origin);
    if (same)
        program_error(
            "eye and target of the camera are the same point in single precision: an --origin near them helps");
    return same ? -1 : 0;
}

void renderer_name_camera(const renderer *r, const cgt_camera *camera, char text[RENDERER_CAMERA_SIZE])
{
    const int digits = renderer_is_moved(r) ? 15 : 9;
    size_t used = 0;
    for (int c = 0; c < 6; c++)
        used += (size_t)snprintf(text + used, RENDERER_CAMERA_SIZE - used, "%.*g,", digits,
                                 (double)(c < 3 ? camera->eye : camera->target)[c % 3] + r->origin[c % 3]);
    snprintf(text + used, RENDERER_CAMERA_SIZE - used, "%.9g,%.9g,%.9g,%.9g\n", (double)camera->up[0],
             (double)camera->up[1], (double)camera->up[2], (double)camera->fov);
}

void renderer_print_camera(const renderer *r, const cgt_camera *camera, FILE *to)
{
    char text[RENDERER_CAMERA_SIZE];
    renderer_name_camera(r, camera, text);
    fputs(text, to);
}

/* ---- Colours ------------------------------------------------------------------------------------------------ */

int render_choose_colors(renderer *r)
{
    const render_options *o = &r->options;
    const coloring_by by = o->figure.by == COLORING_AUTO ? coloring_choose(&r->survey) : o->figure.by;
    const int axis = o->figure.up[0] != 0.0f ? 0 : o->figure.up[1] != 0.0f ? 1 : 2;
    double min = o->figure.range_min, max = o->figure.range_max;
    if (!o->figure.has_range)
        coloring_choose_range(&r->survey, by, axis, o->figure.logarithmic, r->origin, &min, &max);
    if (!renderer_is_moved(r)) { /* near 0 single precision does, and is what settings are printed in */
        min = (double)(float)min;
        max = (double)(float)max;
    }
    const int is_chosen = o->figure.by == COLORING_AUTO && by == COLORING_ID;
    if ((is_chosen || by == COLORING_SPEED) && coloring_has_jumps(&r->survey))
        program_error("spheres move by more than half of the run's extent in one frame, as through the boundary of a "
                      "periodic box, but the file has no box: %s",
                      is_chosen ? "colours are not chosen by speed" : "speeds may be false");
    if (by == COLORING_PLAIN ? coloring_init_plain(&r->coloring, o->figure.plain)
                             : coloring_init(&r->coloring, by, o->figure.map, min, max)) {
        program_error("out of memory");
        return -1;
    }
    render_scene_color(r);
    r->coloring.axis = axis;
    r->coloring.formula = r->formula;
    r->coloring.logarithmic = o->figure.logarithmic && by != COLORING_TYPE && by != COLORING_PLAIN && min > 0.0;
    if (o->figure.logarithmic && !r->coloring.logarithmic)
        program_error("--log-scale: there is nothing above 0 to scale: the scale is linear");
    return 0;
}

/* ---- Camera and light --------------------------------------------------------------------------------------- */

enum { BOUNDS_SIZE = 200 };

/* "from (0, 0, 0) to (1, 1, 1)", in the file's coordinates. */
static void write_bounds(const renderer *r, const float min[3], const float max[3], char text[BOUNDS_SIZE])
{
    const int digits = renderer_is_moved(r) ? 15 : 6;
    const double *const o = r->origin;
    snprintf(text, BOUNDS_SIZE, "from (%.*g, %.*g, %.*g) to (%.*g, %.*g, %.*g)", digits, o[0] + (double)min[0], digits,
             o[1] + (double)min[1], digits, o[2] + (double)min[2], digits, o[0] + (double)max[0], digits,
             o[1] + (double)max[1], digits, o[2] + (double)max[2]);
}

/* What the camera must show of a bulk: all within its bounds where that is among the samples, else the bounds. */
static void narrow_reach(survey *s, const camera_directions *fit)
{
    const bulk *const b = &s->bulk;
    camera_reach within;
    cgt_camera_reach_clear(&within);
    if (b->count < b->seen)
        cgt_camera_reach_add_box(&within, fit, s->bounds_min, s->bounds_max);
    for (uint32_t i = 0; i < b->count && b->count == b->seen; i++) {
        const float *const p = b->sample[i].place;
        const double place[3] = {(double)p[0], (double)p[1], (double)p[2]};
        int is_inside = 1;
        for (int c = 0; c < 3; c++)
            is_inside &= p[c] - p[3] >= s->bounds_min[c] && p[c] + p[3] <= s->bounds_max[c];
        if (is_inside)
            cgt_camera_reach_add(&within, fit, place, (double)p[3]);
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
    if (!narrowed || r->options.figure.has_camera)
        return;
    char bounds[2][BOUNDS_SIZE];
    write_bounds(r, s->bounds_min, s->bounds_max, bounds[0]);
    write_bounds(r, was_min, was_max, bounds[1]);
    program_error("the camera follows the bulk, %s, and leaves out about %" PRIu64 " of %" PRIu64
                  " %s of the run, which reaches %s",
                  bounds[0], outside, s->drawable, s->kind == CGT_TRAJECTORY_TRIANGLES ? "triangles" : "spheres",
                  bounds[1]);
}

int render_choose_camera(renderer *r)
{
    const render_options *o = &r->options;
    const camera_directions *const fit = renderer_fit(r);
    survey *const s = &r->survey;
    if (s->drawable)
        follow_bulk(r);
    if (o->figure.has_camera) {
        camera_path_fixed(&r->path, &o->figure.camera.camera, (double)o->figure.orbit);
        return render_scene_bound(r);
    }
    if (render_scene_bound(r))
        return -1;
    if (!s->drawable) {
        for (int c = 0; c < 3; c++) {
            s->bounds_min[c] = -1.0f;
            s->bounds_max[c] = 1.0f;
        }
        cgt_camera_reach_add_box(&s->reach, fit, s->bounds_min, s->bounds_max);
    }
    if (camera_path_fit(&r->path, fit, &s->reach, s->bounds_min, s->bounds_max) == 0) {
        if (o->figure.zoom > 0.0f)
            camera_path_zoom(&r->path, o->figure.zoom);
        return 0;
    }
    char bounds[BOUNDS_SIZE];
    write_bounds(r, s->bounds_min, s->bounds_max, bounds);
    program_error("%s: the scene, %s, is too large for an automatic camera: give one with -c", o->input, bounds);
    return -1;
}

void render_choose_light(renderer *r)
{
    const render_options *o = &r->options;
    if (o->figure.has_light)
        memcpy(r->light, o->figure.light, sizeof r->light);
    else
        cgt_camera_get_key_light(&r->camera, o->figure.width, o->figure.height, r->light);
}

void render_camera_at(const renderer *r, uint64_t number, cgt_camera *camera)
{
    const double share = r->survey.has_total ? (double)number / (double)r->survey.total : 0.0;
    if (r->options.figure.keys.count)
        camera_keys_at(&r->options.figure.keys, number, camera);
    else
        camera_path_at(&r->path, share, camera);
}

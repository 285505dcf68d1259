/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pictures of cgt-view; see view_draw.h. Alone of the viewer's files it knows how cgt-render draws. */
#define _POSIX_C_SOURCE 200809L
#include "view/draw/view_draw_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "common/program.h"

/* ---- Opening ------------------------------------------------------------------------------------------------ */

/* The full picture's planes and overlay, of the options at hand. */
int view_draw_set_up_full(view_draw *d)
{
    renderer *const r = &d->r;
    render_picture_close(r);
    r->options.settings = d->given ? strdup(d->given) : NULL;
    return render_picture_setup(r);
}

static void free_quick(view_draw *d)
{
    for (int i = 0; i < VIEW_FULL; i++) {
        cgt_picture_release(d->quick[i]);
        d->quick[i] = NULL;
    }
    free(d->small);
    d->small = NULL;
}

void view_draw_name_color(view_draw *d)
{
    static const char *const names[] = {"auto", "type", "id", "speed", "height", "", "element", "", ""};
    const renderer *const r = &d->r;
    const coloring_by by = r->figure.coloring.by;
    if (by == COLORING_VALUE || by == COLORING_CATEGORY)
        snprintf(d->color, sizeof d->color, "%s", r->figure.options.formula);
    else if (by != COLORING_PLAIN)
        snprintf(d->color, sizeof d->color, "%s", names[by]);
    else
        snprintf(d->color, sizeof d->color, "%02x%02x%02x", (unsigned)(r->figure.options.plain[0] * 255.0f + 0.5f),
                 (unsigned)(r->figure.options.plain[1] * 255.0f + 0.5f),
                 (unsigned)(r->figure.options.plain[2] * 255.0f + 0.5f));
}

/* All frames of small files, and where a legend names what any frame has, a floor lies below all, glass is as dark as
 * the run is large; else the first few: the window is to open at once. */
static uint64_t choose_survey(const render_options *o)
{
    const uint64_t few = 4;
    const off_t small = 32 << 20; /* bytes */
    off_t bytes = 0;
    struct stat info;
    if (o->figure.picture.legend || o->figure.picture.bar || o->figure.floor.is_set || o->figure.bounce.is_set)
        return UINT64_MAX;
    for (size_t i = 0; i < o->input_count; i++)
        bytes += stat(o->inputs[i], &info) == 0 && S_ISREG(info.st_mode) ? info.st_size : small + 1;
    return bytes <= small ? UINT64_MAX : few;
}

int view_draw_has_range(const coloring *c) { return c->by != COLORING_PLAIN && !coloring_has_kinds(c->by); }

/* Values that are all the same have a range, too, so that a command line can give it. */
void view_draw_widen_range(coloring *c)
{
    if (view_draw_has_range(c) && !(c->max > c->min))
        c->max = c->min + fmax(1.0, fabs(c->min));
}

view_draw *view_draw_open(const view_options *options)
{
    view_draw *const d = calloc(1, sizeof *d);
    if (!d) {
        program_error("out of memory");
        return NULL;
    }
    renderer *const r = &d->r;
    r->options = options->render;
    r->options.settings = NULL;
    d->given = options->render.settings;
    d->show = strdup(options->render.figure.particles.show);
    if (r->options.output.survey == VIEW_SURVEY_AUTO)
        r->options.output.survey = choose_survey(&r->options);
    r->stop = &d->stop;
    if (!d->show || render_prepare(r)) {
        view_draw_close(d);
        return NULL;
    }
    view_draw_widen_range(&r->figure.coloring);
    view_draw_name_color(d);
    return d;
}

void view_draw_stop(view_draw *d)
{
    if (d)
        d->stop = 1;
}

void view_draw_close_scene(view_draw *d)
{
    if (d) {
        cgt_scene_release(d->r.figure.scene);
        d->r.figure.scene = NULL;
    }
}

void view_draw_close(view_draw *d)
{
    if (!d)
        return;
    free_quick(d);
    cgt_frame_parts_free(&d->parts);
    render_close(&d->r);
    free(d->given);
    free(d->show);
    free(d);
}

view_frames *view_draw_start_frames(view_draw *d, size_t memory, void (*wake)(void *user), void *user)
{
    renderer *const r = &d->r;
    const render_options *const o = &r->options;
    const view_frames_options options = {
        .paths = o->inputs,
        .path_count = o->input_count,
        .reading = &o->reading,
        .range = o->range,
        .memory = memory,
        .total = r->figure.has_survey && r->figure.survey.has_total ? r->figure.survey.total : 0,
        .wake = wake,
        .user = user};
    if (o->figure.particles.trails &&
        !(r->figure.sequence.trails = cgt_trail_history_create(o->figure.particles.trails))) {
        program_error("out of memory for the trails");
        return NULL;
    }
    if (!r->figure.sequence.tracker)
        r->figure.sequence.tracker =
            cgt_speed_create(r->context); /* colours may change to speeds; without memory they are unknown */
    return view_frames_start(&r->source, &options);
}

figure_options *view_draw_options(view_draw *d) { return &d->r.figure.options; }
const char *view_draw_color_name(const view_draw *d) { return d->color; }

void view_draw_first_camera(const view_draw *d, cgt_camera *camera, float up[3])
{
    *camera = d->r.figure.path.start;
    memcpy(up, d->r.figure.options.up, 3 * sizeof *up);
    if (up[0] == 0.0f && up[1] == 0.0f && up[2] == 0.0f)
        memcpy(up, camera->up, 3 * sizeof *up);
}

int view_draw_resize(view_draw *d, uint32_t width, uint32_t height)
{
    d->r.figure.options.width = width;
    d->r.figure.options.height = height;
    free_quick(d);
    return view_draw_set_up_full(d);
}

/* ---- A frame ------------------------------------------------------------------------------------------------ */

static int bind(view_draw *d, const view_frame *f)
{
    renderer *const r = &d->r;
    expression *const all[] = {r->figure.formula,       r->figure.parts.show,     r->figure.parts.radius,
                               r->figure.parts.layer,   r->figure.parts.arrow[0], r->figure.parts.arrow[1],
                               r->figure.parts.arrow[2]};
    label_rules *const labels = &r->figure.parts.labels;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (all[i] && cgt_expression_bind(all[i], &f->frame, f->speed, r->error, sizeof r->error))
            return render_fail(r);
    for (uint32_t i = 0; i <= labels->parts; i++) {
        expression *const e = i < labels->parts ? labels->part[i].value : labels->which;
        if (e && cgt_expression_bind(e, &f->frame, f->speed, r->error, sizeof r->error))
            return render_fail(r);
    }
    return 0;
}

/* As cgt-render has it where -c gives this camera. */
static void set_camera(view_draw *d, const cgt_camera *camera)
{
    cgt_camera_path_fixed(&d->r.figure.path, camera, 0.0);
    d->r.figure.camera = *camera;
    cgt_figure_choose_light(&d->r.figure);
}

int view_draw_set_frame(view_draw *d, const view_frame *f, const cgt_camera *camera)
{
    renderer *const r = &d->r;
    if (!d->checked && render_check_kind(r, &f->frame))
        return -1;
    d->checked = 1;
    set_camera(d, camera);
    if (bind(d, f))
        return -1;
    if (cgt_coloring_apply(&r->figure.coloring, &f->frame, f->speed)) {
        program_error("out of memory for the colours");
        return -1;
    }
    if (cgt_figure_scene_prepare(&r->figure, &f->frame, r->figure.coloring.index, &d->parts, r->error, sizeof r->error))
        return render_fail(r);
    r->figure.frame = &f->frame;
    r->figure.speed_from = f->speed_from;
    if (render_result(r, cgt_figure_scene_set(&r->figure, &d->parts)))
        return -1;
    const cgt_result result = cgt_scene_commit(r->figure.scene);
    return result ? render_result(r, cgt_figure_fail_library(&r->figure, "build", result)) : 0;
}

int view_draw_follows_camera(const view_draw *d) { return cgt_figure_scene_has_figures(&d->r.figure); }

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

static void simplify(cgt_picture_options *s, view_quality quality)
{
    s->antialias = 1;
    s->lighting.ambient = 0;
    if (s->shading == CGT_SHADING_BOUNCES) /* mirrors and glass seem matt */
        s->shading = CGT_SHADING_FULL;
    for (uint32_t i = 0; i < s->lighting.light_count; i++) {
        s->lighting.lights[i].size = 0.0f;
        s->lighting.lights[i].shadows = s->lighting.lights[i].shadows && quality == VIEW_SHADOWS;
    }
}

/* The picture of a quality, which is made when it is first drawn. */
static cgt_picture *picture_of(view_draw *d, view_quality quality, const cgt_picture_options *s)
{
    cgt_picture **const p = quality == VIEW_FULL ? &d->r.figure.drawing : &d->quick[quality];
    const int is_new = !*p;
    const cgt_result result = is_new ? cgt_picture_create(d->r.context, s, p) : cgt_picture_set_options(*p, s);
    if (result == CGT_OK)
        return *p;
    program_error("cannot make a picture of %ux%u pixels: %s", s->width, s->height, cgt_get_result_string(result));
    if (is_new) {
        cgt_picture_release(*p);
        *p = NULL;
    }
    return NULL;
}

static void enlarge(const uint8_t *from, uint32_t from_width, uint8_t *to, uint32_t width, uint32_t height,
                    uint32_t shrink)
{
    for (uint32_t y = 0; y < height; y++) {
        uint8_t *const row = to + 3 * (size_t)y * width;
        if (y % shrink) {
            memcpy(row, row - 3 * (size_t)width, 3 * (size_t)width);
            continue;
        }
        const uint8_t *const source = from + 3 * (size_t)(y / shrink) * from_width;
        for (uint32_t x = 0; x < width; x++)
            memcpy(row + 3 * (size_t)x, source + 3 * (size_t)(x / shrink), 3);
    }
}

static cgt_picture_options settings_of(view_draw *d, const cgt_camera *camera, const stop_flag *stop)
{
    set_camera(d, camera);
    cgt_picture_options s = cgt_figure_get_settings(&d->r.figure);
    s.style.transparent &= d->alpha != NULL;
    s.work.stop = stop_flag_is_set;
    s.work.stop_user = stop;
    return s;
}

/* What came of a picture in rgb, which gets what lies over it. */
static int finish_picture(view_draw *d, cgt_picture *q, cgt_result result, uint8_t *rgb)
{
    renderer *const r = &d->r;
    char message[256] = "";
    if (result == CGT_OK) {
        r->figure.image = (cgt_image){.bytes = rgb, .alpha = d->alpha};
        cgt_figure_draw_overlay(&r->figure);
    }
    if (result == CGT_OK || result == CGT_ERROR_STOPPED)
        return result == CGT_OK ? 0 : 1;
    cgt_picture_get_error_message(q, message, sizeof message);
    program_error("cannot draw frame %llu: %s", (unsigned long long)r->figure.frame->number,
                  *message ? message : cgt_get_result_string(result));
    return -1;
}

int view_draw_picture(view_draw *d, const cgt_camera *camera, view_quality quality, uint32_t shrink, uint8_t *rgb,
                      const stop_flag *stop)
{
    renderer *const r = &d->r;
    const uint32_t width = r->figure.options.width, height = r->figure.options.height;
    cgt_look looks[FIGURE_LOOKS];
    cgt_picture_options s = settings_of(d, camera, stop);
    if (quality != VIEW_FULL)
        simplify(&s, quality);
    s.width = (width + shrink - 1) / shrink;
    s.height = (height + shrink - 1) / shrink;
    if (shrink > 1 && !d->small && !(d->small = malloc(3 * (size_t)width * height))) {
        program_error("out of memory");
        return -1;
    }
    cgt_picture *const q = picture_of(d, quality, &s);
    if (!q)
        return -1;
    const uint32_t count = cgt_figure_begin_picture(&r->figure, looks);
    const cgt_image image = {.bytes = shrink > 1 ? d->small : rgb, .alpha = d->alpha};
    const cgt_result result = cgt_picture_draw(q, r->figure.scene, &r->figure.camera, looks, count, &image, NULL);
    if (result == CGT_OK && shrink > 1)
        enlarge(d->small, s.width, rgb, width, height, shrink);
    return finish_picture(d, q, result, rgb);
}

int view_draw_grow(view_draw *d, const cgt_camera *camera, int begins, uint8_t *rgb, const stop_flag *stop,
                   uint32_t *left)
{
    renderer *const r = &d->r;
    const cgt_image image = {.bytes = rgb};
    cgt_look looks[FIGURE_LOOKS];
    const cgt_picture_options s = settings_of(d, camera, stop);
    cgt_picture *const q = begins ? picture_of(d, VIEW_FULL, &s) : r->figure.drawing;
    if (!q)
        return -1;
    const uint32_t count = cgt_figure_begin_picture(&r->figure, looks);
    cgt_result result = begins ? cgt_picture_begin(q, r->figure.scene, &r->figure.camera, looks, count, NULL) : CGT_OK;
    if (!result)
        result = cgt_picture_step(q, begins ? 0 : d->grown ? d->grown : 1, left);
    if (!result) /* as many again: steps of one ray would take twice as long in all */
        d->grown = begins ? 0 : d->grown ? 2 * d->grown : 1;
    if (!result)
        result = cgt_picture_read(q, &image);
    return finish_picture(d, q, result, rgb);
}

/* ---- Asking ------------------------------------------------------------------------------------------------- */

int view_draw_fit(view_draw *d, cgt_camera *camera)
{
    const renderer *const r = &d->r;
    const cgt_trajectory_frame *const f = r->figure.frame;
    if (!f)
        return 0;
    const particles *const p =
        f->kind == CGT_TRAJECTORY_SPHERES && r->figure.parts.selects ? &d->parts.particles : NULL;
    const float *const xyzr = p ? p->xyzr : f->xyzr; /* NULL in files of triangles */
    const size_t stride = 4 * sizeof(float);
    const cgt_spheres spheres = {.count = p ? p->count : f->count,
                                 .centers = cgt_floats(xyzr, stride),
                                 .radii = cgt_floats(xyzr ? xyzr + 3 : NULL, stride)};
    const cgt_spheres vertices = {.count = f->count, .centers = cgt_floats(f->position, 0)};
    cgt_camera fitted = *camera;
    if (r->figure.options.picture.ortho)
        fitted.projection = CGT_PROJECTION_ORTHOGRAPHIC;
    if (cgt_camera_fit_spheres(&fitted, r->figure.options.width, r->figure.options.height,
                               f->kind == CGT_TRAJECTORY_SPHERES ? &spheres : &vertices)) {
        program_error("there is nothing to fit the camera to");
        return -1;
    }
    memcpy(camera->eye, fitted.eye, sizeof camera->eye);
    memcpy(camera->target, fitted.target, sizeof camera->target);
    return 0;
}

int view_draw_pick(view_draw *d, const cgt_camera *camera, uint32_t x, uint32_t y, view_hit *hit)
{
    renderer *const r = &d->r;
    cgt_single_ray ray = {0};
    cgt_hit found;
    memset(hit, 0, sizeof *hit);
    if (!r->figure.frame)
        return 0;
    set_camera(d, camera);
    cgt_look looks[FIGURE_LOOKS];
    cgt_figure_begin_picture(&r->figure, looks); /* the projection */
    cgt_result result = cgt_camera_get_ray(&r->figure.camera, r->figure.options.width, r->figure.options.height, x, y,
                                           ray.org, ray.dir);
    if (!result)
        result = cgt_trace_ray(r->figure.scene, &ray, &found, NULL);
    if (result)
        return render_result(r, cgt_figure_fail_library(&r->figure, "pick", result));
    hit->is_hit = found.primitive != CGT_INVALID_ID;
    hit->t = found.t;
    for (int c = 0; c < 3 && hit->is_hit; c++)
        hit->place[c] = ray.org[c] + found.t * ray.dir[c];
    hit->is_file = hit->is_hit && cgt_figure_scene_find(&r->figure, found.geometry, found.primitive, &hit->element);
    return 0;
}

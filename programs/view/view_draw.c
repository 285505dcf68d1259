/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pictures of cgt-view; see view_draw.h. Alone of the viewer's files it knows how cgt-render draws. */
#define _POSIX_C_SOURCE 200809L
#include "view/view_draw.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "common/program.h"
#include "picture/files/image_write.h"
#include "render/render_setup.h"

struct view_draw {
    renderer r; /* its drawing is that of VIEW_FULL */
    stop_flag stop;
    frame_parts parts;
    drawing quick[VIEW_FULL];
    uint32_t quick_size[VIEW_FULL][2];
    uint8_t *small; /* a picture of fewer pixels */
    char *given;    /* the settings of the command line */
    char *show;     /* the conditions of the command line */
    char condition[2048], color[512];
    int checked;
};

/* ---- Opening ------------------------------------------------------------------------------------------------ */

/* The full picture's planes and overlay, of the options at hand. */
static int set_up_full(view_draw *d)
{
    renderer *const r = &d->r;
    render_picture_close(r);
    memset(&r->drawing, 0, sizeof r->drawing);
    memset(&r->overlay, 0, sizeof r->overlay);
    memset(r->texts, 0, sizeof r->texts);
    r->text_count = 0;
    r->settings = NULL;
    r->options.settings = d->given ? strdup(d->given) : NULL;
    return render_picture_setup(r);
}

static void free_quick(view_draw *d)
{
    for (int i = 0; i < VIEW_FULL; i++) {
        draw_free(&d->quick[i]);
        memset(&d->quick[i], 0, sizeof d->quick[i]);
        d->quick_size[i][0] = d->quick_size[i][1] = 0;
    }
    free(d->small);
    d->small = NULL;
}

static void name_color(view_draw *d)
{
    static const char *const names[] = {"auto", "type", "id", "speed", "height", "", "element", ""};
    const renderer *const r = &d->r;
    const coloring_by by = r->coloring.by;
    if (by == COLORING_VALUE)
        snprintf(d->color, sizeof d->color, "%s", r->options.formula);
    else if (by != COLORING_PLAIN)
        snprintf(d->color, sizeof d->color, "%s", names[by]);
    else
        snprintf(d->color, sizeof d->color, "%02x%02x%02x", (unsigned)(r->options.plain[0] * 255.0f + 0.5f),
                 (unsigned)(r->options.plain[1] * 255.0f + 0.5f), (unsigned)(r->options.plain[2] * 255.0f + 0.5f));
}

/* All frames of small files, and where a legend names what any frame has; else the first few: the window is to open
 * at once. */
static uint64_t choose_survey(const render_options *o)
{
    const uint64_t few = 4;
    const off_t small = 32 << 20; /* bytes */
    off_t bytes = 0;
    struct stat info;
    if (o->picture.legend || o->picture.bar)
        return UINT64_MAX;
    for (size_t i = 0; i < o->input_count; i++)
        bytes += stat(o->inputs[i], &info) == 0 && S_ISREG(info.st_mode) ? info.st_size : small + 1;
    return bytes <= small ? UINT64_MAX : few;
}

/* Values that are all the same have a range, too, so that a command line can give it. */
static void widen_range(coloring *c)
{
    const int is_measured = c->by != COLORING_TYPE && c->by != COLORING_ELEMENT && c->by != COLORING_PLAIN;
    if (is_measured && !(c->max > c->min))
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
    d->show = strdup(options->render.particles.show);
    if (r->options.output.survey == VIEW_SURVEY_AUTO)
        r->options.output.survey = choose_survey(&r->options);
    r->stop = &d->stop;
    r->share.stop = &d->stop;
    if (!d->show || render_prepare(r)) {
        view_draw_close(d);
        return NULL;
    }
    widen_range(&r->coloring);
    name_color(d);
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
        cgt_scene_release(d->r.scene);
        d->r.scene = NULL;
    }
}

void view_draw_close(view_draw *d)
{
    if (!d)
        return;
    free_quick(d);
    frame_parts_free(&d->parts);
    d->r.source.trails = NULL; /* the reader's */
    render_close(&d->r);
    free(d->given);
    free(d->show);
    free(d);
}

view_frames *view_draw_start_frames(view_draw *d, size_t memory, void (*wake)(void *user), void *user)
{
    renderer *const r = &d->r;
    const render_options *const o = &r->options;
    const view_frames_options options = {.paths = o->inputs,
                                         .path_count = o->input_count,
                                         .reading = &o->reading,
                                         .range = o->range,
                                         .memory = memory,
                                         .total = r->has_survey && r->survey.has_total ? r->survey.total : 0,
                                         .wake = wake,
                                         .user = user};
    if (o->particles.trails && !(r->source.trails = trail_history_create(o->particles.trails))) {
        program_error("out of memory for the trails");
        return NULL;
    }
    if (!r->source.tracker)
        r->source.tracker = speed_create(); /* colours may change to speeds; without memory they are unknown */
    trail_history *const trails = r->source.trails;
    view_frames *const frames = view_frames_start(&r->source, &options);
    r->source.trails = frames ? trails : NULL;
    return frames;
}

render_options *view_draw_options(view_draw *d) { return &d->r.options; }
const double *view_draw_origin(const view_draw *d) { return d->r.origin; }
const char *view_draw_color_name(const view_draw *d) { return d->color; }

void view_draw_first_camera(const view_draw *d, cgt_camera *camera, float up[3])
{
    *camera = d->r.path.start;
    memcpy(up, d->r.options.up, 3 * sizeof *up);
    if (up[0] == 0.0f && up[1] == 0.0f && up[2] == 0.0f)
        memcpy(up, camera->up, 3 * sizeof *up);
}

int view_draw_resize(view_draw *d, uint32_t width, uint32_t height)
{
    d->r.options.width = width;
    d->r.options.height = height;
    free_quick(d);
    return set_up_full(d);
}

/* ---- A frame ------------------------------------------------------------------------------------------------ */

static int bind(view_draw *d, const view_frame *f)
{
    renderer *const r = &d->r;
    expression *const all[] = {r->formula,        r->parts.show,     r->parts.radius,
                               r->parts.arrow[0], r->parts.arrow[1], r->parts.arrow[2]};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (all[i] && expression_bind(all[i], &f->frame, f->speed, r->error, sizeof r->error))
            return render_fail(r);
    return 0;
}

/* As cgt-render has it where -c gives this camera. */
static void set_camera(view_draw *d, const cgt_camera *camera)
{
    camera_path_fixed(&d->r.path, camera, 0.0);
    d->r.camera = *camera;
    render_choose_light(&d->r);
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
    if (coloring_apply(&r->coloring, &f->frame, f->speed)) {
        program_error("out of memory for the colours");
        return -1;
    }
    if (render_scene_prepare(r, &f->frame, r->coloring.index, &d->parts, r->error, sizeof r->error))
        return render_fail(r);
    r->frame = &f->frame;
    r->speed_from = f->speed_from;
    if (render_scene_set(r, &d->parts))
        return -1;
    const cgt_result result = cgt_scene_commit(r->scene);
    return result ? render_fail_library(r, "build", result) : 0;
}

int view_draw_follows_camera(const view_draw *d) { return render_scene_has_figures(&d->r); }

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

static void simplify(draw_settings *s, view_quality quality)
{
    const uint32_t few = 4;
    s->samples = 1;
    if (quality == VIEW_COARSE) {
        s->ambient = s->ambient < few ? s->ambient : few;
        s->light_samples = s->light_samples < few ? s->light_samples : few;
        return;
    }
    s->ambient = 0;
    for (uint32_t i = 0; i < s->light_count; i++) {
        s->lights[i].size = 0.0f;
        s->lights[i].shadows = s->lights[i].shadows && quality == VIEW_SHADOWS;
    }
}

/* The planes of a quick picture, made when it is first drawn at this size. */
static drawing *quick_drawing(view_draw *d, view_quality quality, const draw_settings *s)
{
    drawing *const q = &d->quick[quality];
    uint32_t *const size = d->quick_size[quality];
    if (size[0] != s->width || size[1] != s->height) {
        draw_free(q);
        memset(q, 0, sizeof *q);
        size[0] = size[1] = 0;
        if (draw_init(q, s, &d->r.tables)) {
            program_error("out of memory for a picture of %ux%u pixels", s->width, s->height);
            return NULL;
        }
        size[0] = s->width;
        size[1] = s->height;
    }
    q->settings = *s;
    return q;
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

int view_draw_picture(view_draw *d, const cgt_camera *camera, view_quality quality, uint32_t shrink, uint8_t *rgb,
                      const stop_flag *stop)
{
    renderer *const r = &d->r;
    const uint32_t width = r->options.width, height = r->options.height;
    drawing *q = &r->drawing;
    cgt_trace_options options;
    cgt_trace_options_init(&options);
    set_camera(d, camera);
    draw_settings s = render_picture_settings(r);
    s.stop = stop;
    if (quality != VIEW_FULL) {
        simplify(&s, quality);
        s.width = (width + shrink - 1) / shrink;
        s.height = (height + shrink - 1) / shrink;
        q = quick_drawing(d, quality, &s);
        if (!q)
            return -1;
        if (shrink > 1 && !d->small && !(d->small = malloc(3 * (size_t)width * height))) {
            program_error("out of memory");
            return -1;
        }
    }
    q->settings = s;
    render_picture_begin(r);
    if (q != &r->drawing)
        memcpy(q->surfaces, r->drawing.surfaces, sizeof q->surfaces);
    q->rgb = shrink > 1 ? d->small : rgb;
    const cgt_result result = draw_frame(q, r->scene, &r->camera, &options);
    if (result == CGT_ERROR_STOPPED)
        return 1;
    if (result)
        return render_fail_library(r, "trace", result);
    if (shrink > 1)
        enlarge(d->small, s.width, rgb, width, height, shrink);
    r->drawing.rgb = rgb;
    render_picture_overlay(r);
    return 0;
}

/* ---- Asking ------------------------------------------------------------------------------------------------- */

/* The primitives' places: spheres that are drawn, or vertices. */
static const float *places(const view_draw *d, uint32_t *count, size_t *stride)
{
    const renderer *const r = &d->r;
    const cgt_trajectory_frame *const f = r->frame;
    const int spheres = f->kind == CGT_TRAJECTORY_SPHERES;
    *stride = spheres ? 4 : 3;
    *count = spheres && r->parts.selects ? d->parts.particles.count : f->count;
    return !spheres ? f->position : r->parts.selects ? d->parts.particles.xyzr : f->xyzr;
}

int view_draw_fit(view_draw *d, cgt_camera *camera)
{
    const render_options *const o = &d->r.options;
    static camera_fit fit; /* one thread at a time, and too large for some stacks */
    camera_reach reach;
    camera_path path;
    float view[3], min[3] = {INFINITY, INFINITY, INFINITY}, max[3] = {-INFINITY, -INFINITY, -INFINITY};
    uint32_t count;
    size_t stride;
    if (!d->r.frame)
        return 0;
    const float *const p = places(d, &count, &stride);
    for (int c = 0; c < 3; c++)
        view[c] = camera->eye[c] - camera->target[c];
    camera_fit_begin(&fit, view, camera->up, camera->fov, (double)o->width / (double)o->height, 0.0, o->picture.ortho);
    camera_reach_clear(&reach);
    for (uint32_t i = 0; i < count; i++) {
        const float *const at = p + stride * i;
        const double place[3] = {(double)at[0], (double)at[1], (double)at[2]};
        const float radius = stride == 4 ? at[3] : 0.0f;
        if (!isfinite(at[0] + at[1] + at[2] + radius) || radius < 0.0f)
            continue;
        camera_reach_add(&reach, &fit, place, (double)radius);
        for (int c = 0; c < 3; c++) {
            min[c] = fminf(min[c], at[c] - radius);
            max[c] = fmaxf(max[c], at[c] + radius);
        }
    }
    if (min[0] > max[0] || camera_path_fit(&path, &fit, &reach, min, max)) {
        program_error("there is nothing to fit the camera to");
        return -1;
    }
    memcpy(camera->eye, path.start.eye, sizeof camera->eye);
    memcpy(camera->target, path.start.target, sizeof camera->target);
    return 0;
}

int view_draw_pick(view_draw *d, const cgt_camera *camera, uint32_t x, uint32_t y, view_hit *hit)
{
    renderer *const r = &d->r;
    cgt_single_ray ray = {0};
    cgt_single_hit found;
    memset(hit, 0, sizeof *hit);
    if (!r->frame)
        return 0;
    set_camera(d, camera);
    render_picture_begin(r); /* the projection */
    cgt_result result = cgt_camera_get_ray(&r->camera, r->options.width, r->options.height, x, y, ray.org, ray.dir);
    if (!result)
        result = cgt_trace_ray(r->scene, &ray, &found, NULL);
    if (result)
        return render_fail_library(r, "pick", result);
    hit->is_hit = found.primitive != CGT_INVALID_ID;
    hit->t = found.t;
    for (int c = 0; c < 3 && hit->is_hit; c++)
        hit->place[c] = ray.org[c] + found.t * ray.dir[c];
    hit->is_file = hit->is_hit && found.geometry == r->geometry;
    hit->element = found.primitive;
    if (hit->is_file && r->parts.selects)
        hit->element = d->parts.particles.source[found.primitive];
    return 0;
}

/* ---- Changing looks ----------------------------------------------------------------------------------------- */

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The range of a formula in the frame: the 1 % and the 99 % quantile, or all where those are equal or `is_whole`. */
static int find_range(expression *e, const view_frame *f, int is_whole, double *min, double *max)
{
    const uint32_t count = f->frame.count;
    double *const value = malloc(((size_t)count + 1) * sizeof *value);
    uint32_t known = 0;
    if (!value)
        return -1;
    expression_values(e, 0, count, value);
    for (uint32_t i = 0; i < count; i++)
        if (isfinite(value[i]))
            value[known++] = value[i];
    qsort(value, known, sizeof *value, compare);
    *min = *max = 0.0;
    if (known) {
        const uint32_t skip = is_whole || known < 101 ? 0 : known / 100;
        *min = value[skip];
        *max = value[known - 1 - skip];
        if (!(*min < *max)) {
            *min = value[0];
            *max = value[known - 1];
        }
    }
    free(value);
    return 0;
}

/* What is measured by a name of --color; NULL: nothing. */
static const char *measured(const render_options *o)
{
    static const char *const axes[] = {"x", "y", "z"};
    switch (o->by) {
    case COLORING_ID: return "id";
    case COLORING_SPEED: return "speed";
    case COLORING_HEIGHT: return axes[o->up[0] != 0.0f ? 0 : o->up[1] != 0.0f ? 1 : 2];
    case COLORING_VALUE: return o->formula;
    default: return NULL;
    }
}

int view_draw_color(view_draw *d, const view_frame *f, const char *by)
{
    renderer *const r = &d->r;
    render_options o = r->options;
    char text[sizeof d->color], *kept = NULL;
    snprintf(text, sizeof text, "%s", by);
    if (parse_coloring(text, &o, r->error, sizeof r->error))
        return render_fail(r);
    const char *const name = measured(&o);
    expression *const e = name ? expression_parse(name, r->error, sizeof r->error) : NULL;
    if (name && !e)
        return render_fail(r);
    o.has_range = 0;
    if (e && o.by == COLORING_ID && !f->frame.id) {
        o.has_range = 1;
        o.range_min = 0.0;
        o.range_max = f->frame.count ? (double)(f->frame.count - 1) : 0.0;
    } else if (e) {
        if (expression_bind(e, &f->frame, f->speed, r->error, sizeof r->error) ||
            find_range(e, f, o.by == COLORING_ID || o.by == COLORING_HEIGHT, &o.range_min, &o.range_max)) {
            expression_free(e);
            return render_fail(r);
        }
        o.range_min = o.by == COLORING_SPEED ? 0.0 : (double)(float)o.range_min;
        o.range_max = (double)(float)o.range_max;
        o.has_range = 1;
    }
    if (o.by == COLORING_VALUE && !(kept = strdup(text))) {
        expression_free(e);
        program_error("out of memory");
        return -1;
    }
    expression_free(r->formula);
    r->formula = o.by == COLORING_VALUE ? e : NULL;
    if (o.by != COLORING_VALUE)
        expression_free(e);
    o.formula = kept; /* stays for the run, as those of the command line do */
    r->options = o;
    coloring_free(&r->coloring);
    memset(&r->coloring, 0, sizeof r->coloring);
    if (render_choose_colors(r))
        return -1;
    widen_range(&r->coloring);
    name_color(d);
    return set_up_full(d);
}

int view_draw_show(view_draw *d, const view_frame *f, const char *condition)
{
    renderer *const r = &d->r;
    particle_options *const p = &r->options.particles;
    char show[sizeof p->show];
    expression *e = NULL;
    const int length = snprintf(show, sizeof show, "%s%s%s", d->show, *d->show && *condition ? " && " : "", condition);
    if (length < 0 || (size_t)length >= sizeof show) {
        program_error("the conditions of what is hidden are too long together");
        return -1;
    }
    if (*show && (!(e = expression_parse(show, r->error, sizeof r->error)) ||
                  expression_bind(e, &f->frame, f->speed, r->error, sizeof r->error))) {
        expression_free(e);
        return render_fail(r);
    }
    expression_free(r->parts.show);
    r->parts.show = e;
    r->parts.rules.show = e;
    r->parts.selects = !particle_rules_are_empty(&r->parts.rules) || p->bonds || p->arrows || p->trails;
    memcpy(p->show, show, sizeof show);
    snprintf(d->condition, sizeof d->condition, "%s", condition);
    return 0;
}

/* ---- Writing ------------------------------------------------------------------------------------------------ */

void view_draw_print_camera(const view_draw *d, const cgt_camera *camera, FILE *to)
{
    renderer_print_camera(&d->r, camera, to);
}

/* Options that the viewer gives itself, or that -c excludes. */
static int is_replaced(const char *line)
{
    static const char *const names[] = {"size", "antialias", "camera", "view",  "up",
                                        "fov",  "color",     "range",  "ortho", "survey"};
    const size_t length = strcspn(line, " \n");
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strlen(names[i]) == length && memcmp(line, names[i], length) == 0)
            return 1;
    return 0;
}

typedef struct command {
    char **argv;
    int argc;
    int failed;
} command;

static void add(command *c, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void add(command *c, const char *format, ...)
{
    char text[4096];
    va_list list;
    va_start(list, format);
    const int length = vsnprintf(text, sizeof text, format, list);
    va_end(list);
    char **more = realloc(c->argv, ((size_t)c->argc + 2) * sizeof *more);
    c->argv = more ? more : c->argv;
    char *const copy = more && length >= 0 && (size_t)length < sizeof text ? strdup(text) : NULL;
    if (!copy) {
        c->failed = 1;
        return;
    }
    more[c->argc++] = copy;
    more[c->argc] = NULL;
}

/* "name = value" of the settings becomes --name=value. */
static void add_given(command *c, const char *settings)
{
    for (const char *line = settings; line && *line;) {
        const size_t length = strcspn(line, "\n"), name = strcspn(line, " \n");
        if (!is_replaced(line) && length > name + 3)
            add(c, "--%.*s=%.*s", (int)name, line, (int)(length - name - 3), line + name + 3);
        else if (!is_replaced(line))
            add(c, "--%.*s", (int)name, line);
        line += length + (line[length] == '\n');
    }
}

char **view_draw_command(view_draw *d, const cgt_camera *camera, const char *pattern, int *argc)
{
    const renderer *const r = &d->r;
    const render_options *const o = &r->options;
    command c = {0};
    char *text = NULL;
    size_t size = 0;
    FILE *const to = open_memstream(&text, &size);
    if (to)
        renderer_print_camera(r, camera, to);
    const int is_printed = to && fclose(to) == 0 && size > 0;
    add(&c, "cgt-render");
    add_given(&c, d->given);
    if (is_printed)
        add(&c, "--camera=%.*s", (int)(size - 1), text);
    free(text);
    if (renderer_is_moved(r) && !o->reading.has_origin)
        add(&c, "--origin=%.17g,%.17g,%.17g", r->origin[0], r->origin[1], r->origin[2]);
    add(&c, "--size=%ux%u", o->width, o->height);
    add(&c, "--antialias=%u", o->samples);
    /* -c excludes --up, which says what height is */
    add(&c, "--color=%s", r->coloring.by == COLORING_HEIGHT && o->has_up ? measured(o) : d->color);
    if (r->coloring.max > r->coloring.min)
        add(&c, "--range=%.17g,%.17g", r->coloring.min, r->coloring.max);
    if (o->picture.ortho)
        add(&c, "--ortho");
    if (*d->condition)
        add(&c, "--show=%s", d->condition);
    add(&c, "--first=%llu", (unsigned long long)r->frame->number);
    add(&c, "--last=%llu", (unsigned long long)r->frame->number);
    add(&c, "--output=%s", pattern);
    for (size_t i = 0; i < o->input_count; i++)
        add(&c, "%s", o->inputs[i]);
    *argc = c.argc;
    if (!c.failed && is_printed)
        return c.argv;
    program_error("out of memory for the command line");
    for (int i = 0; i < c.argc; i++)
        free(c.argv[i]);
    free(c.argv);
    return NULL;
}

/* The texts of the picture are those of the command line, its camera as single precision reads it. */
static int write_picture(view_draw *d, render_options *o, const view_frame *f, const char *path)
{
    renderer *const r = &d->r;
    image_writer *const writer = image_writer_create();
    uint8_t *const rgb = malloc(3 * (size_t)o->width * o->height);
    const stop_flag never = 0;
    int result = -1;
    if (!writer || !rgb)
        program_error("out of memory for the picture");
    else if (camera_key_move(&o->camera, r->origin))
        program_error("eye and target of the camera are the same point");
    else if (view_draw_set_frame(d, f, &o->camera.camera) == 0 &&
             view_draw_picture(d, &o->camera.camera, VIEW_FULL, 1, rgb, &never) == 0) {
        const image_content image = {.width = o->width,
                                     .height = o->height,
                                     .rgb = rgb,
                                     .quality = o->output.quality,
                                     .texts = r->texts,
                                     .text_count = r->text_count};
        result = image_write(writer, path, &image, r->error, sizeof r->error) ? render_fail(r) : 0;
    }
    if (writer)
        image_writer_release(writer);
    free(rgb);
    return result;
}

int view_draw_write(view_draw *d, char **arguments, int argc, const view_frame *f, const char *path)
{
    renderer *const r = &d->r;
    render_options o;
    view_options_parse_render(&o, argc, arguments);
    /* what the texts say is what the command line gives */
    char *const given = d->given;
    const int has[] = {r->options.has_camera, r->options.has_range, r->options.reading.has_origin};
    d->given = o.settings;
    r->options.has_camera = 1;
    r->options.has_range = o.has_range;
    r->options.reading.has_origin = o.reading.has_origin;
    int result = set_up_full(d) ? -1 : write_picture(d, &o, f, path);
    d->given = given;
    free(o.settings);
    r->options.has_camera = has[0];
    r->options.has_range = has[1];
    r->options.reading.has_origin = has[2];
    return set_up_full(d) ? -1 : result;
}

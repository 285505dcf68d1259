/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the page of programs/web asks of the libraries: a file's frames, a camera, pictures as bytes for a canvas, and
 * what a pixel shows. One worker calls it. Functions that return an int give 0, or -1 with a sentence in
 * web_message. */
#include <emscripten.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cgt/picture.h>
#include <cgt/trajectory.h>

#include "playback/survey_run.h"
#include "figure_state.h"
#include "data/element_symbols.h"
#include "view/view_camera.h"

/* How much a picture takes: SHADED is that of a style which is not plain while the camera moves. */
typedef enum web_quality { WEB_PLAIN, WEB_SHADED, WEB_FULL, WEB_QUALITIES } web_quality;

static struct {
    cgt_context *context;
    frame_source file;
    int is_open;
    cgt_figure figure; /* of the file */
    frame_parts parts;
    cgt_camera camera; /* of the hand */
    cgt_picture *picture[WEB_QUALITIES];
    picture_style style;
    uint32_t width, height;
    uint8_t *pixels;
    char message[1024];
    char cut[1024]; /* why the file's frames end too early, until it is told; "": they do not */
} web;

EMSCRIPTEN_KEEPALIVE int web_seek(uint32_t number);

static int fail(const char *text)
{
    snprintf(web.message, sizeof web.message, "%s", text);
    return -1;
}

static int fail_library(cgt_result result)
{
    if (!cgt_context_get_error_message(web.context, web.message, sizeof web.message))
        snprintf(web.message, sizeof web.message, "%s", cgt_get_result_string(result));
    return -1;
}

/* Bytes of the heap that are in use. */
EMSCRIPTEN_KEEPALIVE double web_used(void) { return (double)mallinfo().uordblks; }

EMSCRIPTEN_KEEPALIVE const char *web_message(void) { return web.message; }

/* Starts with so many threads, the caller's included. Returns how many there are, or -1. */
EMSCRIPTEN_KEEPALIVE int web_start(uint32_t threads)
{
    cgt_context_options options = {.threads = threads};
    cgt_result result = cgt_context_create(&options, &web.context);
    while (result == CGT_ERROR_THREADS && options.threads > 1) { /* the browser refuses so many */
        cgt_context_release(web.context);
        options.threads /= 2;
        result = cgt_context_create(&options, &web.context);
    }
    return result ? fail_library(result) : (int)options.threads;
}

/* ---- A file ------------------------------------------------------------------------------------------------- */

static void close_file(void)
{
    cgt_figure_close(&web.figure); /* its scene uses the frame's arrays */
    cgt_frame_parts_free(&web.parts);
    frame_source_close(&web.file);
    memset(&web.figure, 0, sizeof web.figure);
    memset(&web.parts, 0, sizeof web.parts);
    web.is_open = 0;
}

static int fail_figure(void) { return fail(web.figure.message); }

static int fail_file(void)
{
    close_file();
    return -1;
}

/* Looks at all frames, as cgt-render does, for colours and camera; of a large file at the first few. */
static int survey_file(const char *path)
{
    const off_t large = 64 << 20; /* bytes */
    static const stop_flag never = 0;
    struct stat info;
    const survey_plan plan = {.most = stat(path, &info) == 0 && info.st_size > large ? 4 : UINT64_MAX,
                              .count = 1,
                              .quiet = 1,
                              .stop = &never,
                              .context = web.context,
                              .fit = cgt_figure_begin_fit(&web.figure)};
    if (survey_run(&web.file, &plan, &web.figure.survey, web.message, sizeof web.message))
        return -1;
    web.figure.has_survey = 1;
    return web.figure.survey.frames ? 0 : fail("the file has no frame");
}

static int set_scene(void)
{
    cgt_figure *const figure = &web.figure;
    const cgt_trajectory_frame *const f = &figure->sequence.frame;
    if (cgt_coloring_apply(&figure->coloring, f, figure->sequence.speed))
        return fail("out of memory for the colours");
    if (cgt_figure_scene_prepare(figure, f, figure->coloring.index, &web.parts, web.message, sizeof web.message))
        return -1;
    figure->frame = f;
    if (cgt_figure_scene_set(figure, &web.parts))
        return fail_figure();
    const cgt_result result = cgt_scene_commit(figure->scene);
    return result ? fail_library(result) : 0;
}

/* Light and style of cgt-render with this camera given. */
static void set_looks(void)
{
    cgt_figure *const figure = &web.figure;
    figure_options o;
    cgt_figure_options_init(&o);
    o.picture.style = web.style;
    o.width = web.width;
    o.height = web.height;
    cgt_figure_options_finish(&o, web.message, sizeof web.message);
    o.picture.ambient = o.picture.ambient < 0 ? cgt_style_get(web.style)->ambient : o.picture.ambient;
    figure->options.picture = o.picture;
    figure->options.width = o.width;
    figure->options.height = o.height;
    cgt_camera_path_fixed(&figure->path, &web.camera, 0.0);
    figure->camera = web.camera;
    cgt_figure_choose_light(figure);
}

/* Of the file, as far as it can be read. */
EMSCRIPTEN_KEEPALIVE uint32_t web_frames(void)
{
    return (uint32_t)(web.figure.survey.has_total ? web.figure.survey.total : web.figure.survey.frames);
}

/* Opens a file and makes its first frame the one that is drawn. The size of pictures is set. */
EMSCRIPTEN_KEEPALIVE int web_open(const char *path)
{
    const cgt_trajectory_options options = {.threads = 1, .leave_out_sites = true};
    const size_t kept = 64 << 20; /* bytes of frames, which are not read again */
    cgt_figure *const figure = &web.figure;
    close_file();
    web.message[0] = web.cut[0] = 0;
    cgt_figure_options_init(&figure->options);
    figure->options.width = web.width;
    figure->options.height = web.height;
    figure->source = strrchr(path, '/') ? strrchr(path, '/') + 1 : path;
    figure->context = web.context;
    if (cgt_figure_options_finish(&figure->options, web.message, sizeof web.message))
        return fail_file();
    if (cgt_figure_open(figure)) {
        fail_figure();
        return fail_file();
    }
    if (frame_source_open(&web.file, &figure->sequence, &path, 1, &options, web.message, sizeof web.message))
        return fail_file();
    web.file.keep.most = kept;
    cgt_trajectory_get_origin(web.file.file, figure->origin);
    if (survey_file(path))
        return fail_file();
    if (cgt_figure_choose_bulk_origin(figure)) {
        cgt_trajectory_set_origin(web.file.file, figure->origin);
        if (frame_source_rewind(&web.file, web.message, sizeof web.message) || survey_file(path))
            return fail_file();
    }
    web.file.looks_ahead = 1;
    if (figure->survey.is_cut && (frame_source_read(&web.file, web_frames(), web.cut, sizeof web.cut) >= 0 ||
                                  frame_source_rewind(&web.file, web.message, sizeof web.message)))
        return fail_file();
    if (cgt_figure_move_cameras(figure) || cgt_figure_choose_colors(figure) || cgt_figure_choose_camera(figure) ||
        cgt_figure_settle(figure)) {
        fail_figure();
        return fail_file();
    }
    web.camera = figure->path.start;
    web.is_open = 1;
    return web_seek(0);
}

/* Makes frame `number` the one that is drawn. */
int web_seek(uint32_t number)
{
    if (!web.is_open)
        return fail("no file is open");
    if (web.figure.has_geometry && number == web.figure.sequence.frame.number)
        return 0;
    if (number < web.file.next && frame_source_rewind(&web.file, web.message, sizeof web.message))
        return fail_file();
    const int status = frame_source_read(&web.file, number, web.message, sizeof web.message);
    if (status == 0)
        fail("there is no such frame");
    return status <= 0 || set_scene() ? fail_file() : 0;
}

/* The camera that shows all of the frame; from where it looks stays. */
EMSCRIPTEN_KEEPALIVE int web_fit(void)
{
    const cgt_trajectory_frame *const f = &web.figure.sequence.frame;
    const int has_spheres = f->kind == CGT_TRAJECTORY_SPHERES;
    const size_t stride = (has_spheres ? 4 : 3) * sizeof(float);
    const cgt_spheres all = {.count = f->count,
                             .centers = cgt_floats(has_spheres ? f->xyzr : f->position, stride),
                             .radii = cgt_floats(has_spheres ? f->xyzr + 3 : NULL, has_spheres ? stride : 0)};
    if (!web.is_open || cgt_camera_fit_spheres(&web.camera, web.width, web.height, &all))
        return fail("there is nothing to fit the camera to");
    return 0;
}

EMSCRIPTEN_KEEPALIVE uint32_t web_frame(void) { return (uint32_t)web.figure.sequence.frame.number; }
EMSCRIPTEN_KEEPALIVE uint32_t web_primitives(void) { return frame_primitives(&web.figure.sequence.frame); }
/* The next thing that is doubtful about the file, or was chosen for it; NULL: there is none. */
EMSCRIPTEN_KEEPALIVE const char *web_warning(void)
{
    if (web.is_open && web.cut[0]) {
        memcpy(web.message, web.cut, sizeof web.message);
        web.cut[0] = 0;
        return web.message;
    }
    const char *const notice = web.is_open ? cgt_notices_take(&web.figure.notices) : NULL;
    return notice || !web.is_open ? notice : cgt_trajectory_take_warning(web.file.file);
}

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

EMSCRIPTEN_KEEPALIVE int web_resize(uint32_t width, uint32_t height)
{
    uint8_t *const pixels = malloc(4 * (size_t)width * height);
    if (!pixels)
        return fail("out of memory for the picture");
    free(web.pixels);
    web.pixels = pixels;
    web.width = width;
    web.height = height;
    for (int i = 0; i < WEB_QUALITIES; i++) {
        cgt_picture_release(web.picture[i]);
        web.picture[i] = NULL;
    }
    return 0;
}

EMSCRIPTEN_KEEPALIVE uint8_t *web_pixels(void) { return web.pixels; }
EMSCRIPTEN_KEEPALIVE void web_style(int style) { web.style = (picture_style)style; }

/* Those of cgt-render with this camera given, where the quality is full. */
static cgt_picture_options settings_of(web_quality quality)
{
    set_looks();
    cgt_picture_options s = cgt_figure_get_settings(&web.figure);
    if (quality != WEB_FULL) {
        s.lighting.ambient = 0;
        s.lighting.lights[0].shadows = 0;
    }
    return s;
}

static cgt_picture *picture_of(web_quality quality)
{
    cgt_picture **const p = &web.picture[quality];
    cgt_picture_options s = settings_of(quality);
    const int is_new = !*p;
    const cgt_result result = is_new ? cgt_picture_create(web.context, &s, p) : cgt_picture_set_options(*p, &s);
    if (!result)
        return *p;
    cgt_picture_get_error_message(*p, web.message, sizeof web.message);
    if (is_new) {
        cgt_picture_release(*p);
        *p = NULL;
    }
    return NULL;
}

static int finish(cgt_picture *p, cgt_result result)
{
    if (!result)
        return 0;
    if (!cgt_picture_get_error_message(p, web.message, sizeof web.message))
        fail(cgt_get_result_string(result));
    return -1;
}

/* Draws the frame: plain is complete; another style has neither shadows nor occlusion before web_grow. */
EMSCRIPTEN_KEEPALIVE int web_draw(void)
{
    const web_quality quality = web.style == STYLE_PLAIN ? WEB_PLAIN : WEB_SHADED;
    if (!web.figure.scene)
        return fail("no file is open");
    cgt_picture *const p = picture_of(quality);
    const cgt_image image = {.bytes = web.pixels, .channels = 4};
    cgt_look looks[FIGURE_LOOKS];
    if (!p)
        return -1;
    const uint32_t count = cgt_figure_begin_picture(&web.figure, looks);
    return finish(p, cgt_picture_draw(p, web.figure.scene, &web.camera, looks, count, &image, NULL));
}

/* Adds a step of soft light to the picture; begins: the first. Returns how many are left, or -1. */
EMSCRIPTEN_KEEPALIVE int web_grow(int begins)
{
    uint32_t left = 0;
    if (!web.figure.scene)
        return fail("no file is open");
    cgt_picture *const p = begins ? picture_of(WEB_FULL) : web.picture[WEB_FULL];
    const cgt_image image = {.bytes = web.pixels, .channels = 4};
    cgt_look looks[FIGURE_LOOKS];
    if (!p)
        return -1;
    const uint32_t count = cgt_figure_begin_picture(&web.figure, looks);
    cgt_result result = begins ? cgt_picture_begin(p, web.figure.scene, &web.camera, looks, count, NULL) : CGT_OK;
    if (!result)
        result = cgt_picture_step(p, 1, &left);
    if (!result)
        result = cgt_picture_read(p, &image);
    return finish(p, result) ? -1 : (int)left;
}

/* ---- The camera --------------------------------------------------------------------------------------------- */

/* By pixels of the picture. */
EMSCRIPTEN_KEEPALIVE void web_turn(float right, float down)
{
    const float turn = 4.0f / (float)web.height;
    view_camera_turn(&web.camera, web.camera.target, web.figure.options.up, right * turn, down * turn);
}

EMSCRIPTEN_KEEPALIVE void web_pan(float right, float down) { view_camera_pan(&web.camera, right, -down, web.height); }

/* By a factor, about what a pixel shows as far off as the target. */
EMSCRIPTEN_KEEPALIVE void web_zoom(float x, float y, float factor)
{
    float place[3];
    view_camera_place(&web.camera, (float)web.width / (float)web.height, x / (float)web.width, y / (float)web.height,
                      place);
    view_camera_zoom(&web.camera, place, factor);
}

/* As -c of cgt-render takes it. */
EMSCRIPTEN_KEEPALIVE const char *web_camera(void)
{
    const cgt_camera *const c = &web.camera;
    const double *const o = web.figure.origin;
    const int digits = o[0] != 0.0 || o[1] != 0.0 || o[2] != 0.0 ? 15 : 9;
    snprintf(web.message, sizeof web.message, "%.*g,%.*g,%.*g,%.*g,%.*g,%.*g,%.9g,%.9g,%.9g,%.9g", digits,
             o[0] + (double)c->eye[0], digits, o[1] + (double)c->eye[1], digits, o[2] + (double)c->eye[2], digits,
             o[0] + (double)c->target[0], digits, o[1] + (double)c->target[1], digits, o[2] + (double)c->target[2],
             (double)c->up[0], (double)c->up[1], (double)c->up[2], (double)c->fov);
    return web.message;
}

/* ---- What a pixel shows ------------------------------------------------------------------------------------- */

/* A sentence of it in web_message, "" where there is nothing. Returns the primitive's number, or -1. */
EMSCRIPTEN_KEEPALIVE int web_pick(uint32_t x, uint32_t y)
{
    const cgt_trajectory_frame *const f = &web.figure.sequence.frame;
    cgt_single_ray ray = {0};
    cgt_hit hit;
    web.message[0] = 0;
    if (!web.figure.scene)
        return -1;
    cgt_result result = cgt_camera_get_ray(&web.camera, web.width, web.height, x, y, ray.org, ray.dir);
    if (!result)
        result = cgt_trace_ray(web.figure.scene, &ray, &hit, NULL);
    if (result)
        return fail_library(result);
    if (hit.primitive == CGT_INVALID_ID)
        return -1;
    const uint32_t k = hit.primitive;
    int n = snprintf(web.message, sizeof web.message, "%s %u",
                     f->kind == CGT_TRAJECTORY_SPHERES ? "sphere" : "triangle", k);
    if (f->kind == CGT_TRAJECTORY_SPHERES) {
        const float *const s = f->xyzr + 4 * (size_t)k;
        if (f->id)
            n += snprintf(web.message + n, sizeof web.message - (size_t)n, ", id %u", f->id[k]);
        if (f->element && f->element[k])
            n += snprintf(web.message + n, sizeof web.message - (size_t)n, ", %s", element_symbol(f->element[k]));
        else if (f->type)
            n += snprintf(web.message + n, sizeof web.message - (size_t)n, ", type %u", f->type[k]);
        snprintf(web.message + n, sizeof web.message - (size_t)n, ", at %.7g, %.7g, %.7g, radius %.6g",
                 web.figure.origin[0] + (double)s[0], web.figure.origin[1] + (double)s[1],
                 web.figure.origin[2] + (double)s[2], (double)s[3]);
    }
    return (int)k;
}

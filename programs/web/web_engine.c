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

#include "picture/color/coloring.h"
#include "picture/style.h"
#include "playback/survey_run.h"
#include "playback/origin.h"
#include "picture/figures/element_symbols.h"
#include "view/view_camera.h"

/* How much a picture takes: SHADED is that of a style which is not plain while the camera moves. */
typedef enum web_quality { WEB_PLAIN, WEB_SHADED, WEB_FULL, WEB_QUALITIES } web_quality;

static struct {
    cgt_context *context;
    cgt_scene *scene;
    frame_source file;
    frame_sequence sequence;
    int is_open;
    survey survey;
    double origin[3];         /* subtracted from the file's coordinates */
    cgt_trajectory_kind kind; /* of the scene's geometry; 0: there is none */
    coloring coloring;
    cgt_camera camera;
    float axis[3]; /* points up */
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
    cgt_scene_release(web.scene); /* it uses the frame's arrays */
    frame_source_close(&web.file);
    frame_sequence_close(&web.sequence);
    coloring_free(&web.coloring);
    memset(&web.file, 0, sizeof web.file);
    web.scene = NULL;
    web.is_open = 0;
    web.kind = 0;
}

static int fail_file(void)
{
    close_file();
    return -1;
}

/* Looks at all frames, as cgt-render does, for colours and camera; of a large file at the first few. */
static int survey_file(const char *path, const camera_directions fit[2])
{
    const off_t large = 64 << 20; /* bytes */
    static const stop_flag never = 0;
    struct stat info;
    const survey_plan plan = {.most = stat(path, &info) == 0 && info.st_size > large ? 4 : UINT64_MAX,
                              .count = 1,
                              .quiet = 1,
                              .stop = &never,
                              .context = web.context,
                              .fit = fit};
    if (survey_run(&web.file, &plan, &web.survey, web.message, sizeof web.message))
        return -1;
    return web.survey.frames ? 0 : fail("the file has no frame");
}

/* As cgt-render without -k. */
static int choose_colors(void)
{
    const coloring_by by = coloring_choose(&web.survey);
    double min = 0.0, max = 0.0;
    coloring_choose_range(&web.survey, by, 2, 0, web.origin, &min, &max);
    if (by != COLORING_SPEED) {
        speed_release(web.sequence.tracker);
        web.sequence.tracker = NULL;
    }
    if (by == COLORING_PLAIN ? coloring_init_plain(&web.coloring, style_mesh_color)
                             : coloring_init(&web.coloring, by, NULL, (double)(float)min, (double)(float)max))
        return fail("out of memory for the colours");
    return 0;
}

static int set_scene(void)
{
    const cgt_trajectory_frame *const f = &web.sequence.frame;
    const size_t stride = 4 * sizeof(float);
    const cgt_spheres spheres = {.count = f->count,
                                 .centers = cgt_floats(f->count ? f->xyzr : NULL, stride),
                                 .radii = cgt_floats(f->count ? f->xyzr + 3 : NULL, stride)};
    const cgt_triangles triangles = {.count = f->triangles,
                                     .indices = cgt_uint32s(f->index, 0),
                                     .vertex_count = f->count,
                                     .vertices = cgt_floats(f->position, 0)};
    uint32_t geometry = web.kind ? 0 : CGT_INVALID_ID;
    cgt_result result = f->kind == CGT_TRAJECTORY_SPHERES ? cgt_scene_set_spheres(web.scene, &geometry, &spheres)
                                                          : cgt_scene_set_triangles(web.scene, &geometry, &triangles);
    if (!result)
        result = cgt_scene_commit(web.scene);
    if (result)
        return fail_library(result);
    web.kind = f->kind;
    return coloring_apply(&web.coloring, f, web.sequence.speed) ? fail("out of memory for the colours") : 0;
}

/* Where cgt-render looks from: the front, the side and above, z up for spheres, y for meshes. */
static void begin_fit(camera_directions *fit, int up)
{
    float view[3], axis[3] = {0.0f};
    axis[up] = 1.0f;
    view[up] = 0.45f;
    view[(up + 1) % 3] = up == 2 ? 0.5f : 1.0f;
    view[(up + 2) % 3] = up == 2 ? -1.0f : 0.5f;
    cgt_camera_directions_set(fit, view, axis, 30.0f, (double)web.width / (double)web.height, 0.0, 0);
}

static int choose_camera(const camera_directions fit[2])
{
    survey *const s = &web.survey;
    const int has_spheres = s->kind == CGT_TRAJECTORY_SPHERES;
    memset(web.axis, 0, sizeof web.axis);
    web.axis[has_spheres ? 2 : 1] = 1.0f;
    for (int c = 0; c < 3 && !s->drawable; c++) {
        s->bounds_min[c] = -1.0f;
        s->bounds_max[c] = 1.0f;
    }
    if (!s->drawable)
        cgt_camera_reach_add_box(&s->reach, &fit[!has_spheres], s->bounds_min, s->bounds_max);
    cgt_camera_init(&web.camera);
    if (cgt_camera_reach_show(&s->reach, &fit[!has_spheres], s->bounds_min, s->bounds_max, &web.camera))
        return fail("the scene is too large for a camera");
    return 0;
}

/* Of the file, as far as it can be read. */
EMSCRIPTEN_KEEPALIVE uint32_t web_frames(void)
{
    return (uint32_t)(web.survey.has_total ? web.survey.total : web.survey.frames);
}

/* Opens a file and makes its first frame the one that is drawn. The size of pictures is set. */
EMSCRIPTEN_KEEPALIVE int web_open(const char *path)
{
    const cgt_trajectory_options options = {.threads = 1};
    const size_t kept = 64 << 20; /* bytes of frames, which are not read again */
    camera_directions fit[2];
    close_file();
    begin_fit(&fit[0], 2);
    begin_fit(&fit[1], 1);
    web.message[0] = 0;
    memset(web.origin, 0, sizeof web.origin);
    if (frame_source_open(&web.file, &web.sequence, &path, 1, &options, web.message, sizeof web.message))
        return fail_file();
    web.sequence.tracker = speed_create(web.context);
    if (!web.sequence.tracker) {
        fail("out of memory for the speeds");
        return fail_file();
    }
    web.file.keep.most = kept;
    if (survey_file(path, fit))
        return fail_file();
    cgt_trajectory_get_origin(web.file.file, web.origin);
    if (web.survey.kind == CGT_TRAJECTORY_SPHERES && origin_of_bulk(&web.survey.bulk, web.origin)) {
        cgt_trajectory_set_origin(web.file.file, web.origin);
        if (frame_source_rewind(&web.file, web.message, sizeof web.message) || survey_file(path, fit))
            return fail_file();
    }
    web.file.looks_ahead = 1;
    web.cut[0] = 0;
    if (web.survey.is_cut && (frame_source_read(&web.file, web_frames(), web.cut, sizeof web.cut) >= 0 ||
                              frame_source_rewind(&web.file, web.message, sizeof web.message)))
        return fail_file();
    const cgt_result result = cgt_scene_create(web.context, NULL, &web.scene);
    if (result)
        fail_library(result);
    if (result || choose_colors() || choose_camera(fit))
        return fail_file();
    web.is_open = 1;
    return web_seek(0);
}

/* Makes frame `number` the one that is drawn. */
int web_seek(uint32_t number)
{
    if (!web.is_open)
        return fail("no file is open");
    if (web.kind && number == web.sequence.frame.number)
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
    const cgt_trajectory_frame *const f = &web.sequence.frame;
    const int has_spheres = f->kind == CGT_TRAJECTORY_SPHERES;
    const size_t stride = (has_spheres ? 4 : 3) * sizeof(float);
    const cgt_spheres all = {.count = f->count,
                             .centers = cgt_floats(has_spheres ? f->xyzr : f->position, stride),
                             .radii = cgt_floats(has_spheres ? f->xyzr + 3 : NULL, has_spheres ? stride : 0)};
    if (!web.is_open || cgt_camera_fit_spheres(&web.camera, web.width, web.height, &all))
        return fail("there is nothing to fit the camera to");
    return 0;
}

EMSCRIPTEN_KEEPALIVE uint32_t web_frame(void) { return (uint32_t)web.sequence.frame.number; }
EMSCRIPTEN_KEEPALIVE uint32_t web_primitives(void) { return frame_primitives(&web.sequence.frame); }
/* The next doubtful thing about the file; NULL: there is none. */
EMSCRIPTEN_KEEPALIVE const char *web_warning(void)
{
    if (web.is_open && web.cut[0]) {
        memcpy(web.message, web.cut, sizeof web.message);
        web.cut[0] = 0;
        return web.message;
    }
    return web.is_open ? cgt_trajectory_take_warning(web.file.file) : NULL;
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
    const style_values *const v = style_get(web.style);
    cgt_picture_options s = {
        .width = web.width, .height = web.height, .lighting = {.light_count = 1, .light_samples = 8}};
    s.shading = quality == WEB_PLAIN ? CGT_SHADING_PLAIN : CGT_SHADING_FULL;
    s.lighting.ambient = quality == WEB_FULL ? (uint32_t)v->ambient : 0;
    s.lighting.ambient_radius = style_ambient_radius(&web.camera);
    s.lighting.sky = v->sky;
    s.lighting.head = v->head;
    s.style.outline = v->outline;
    s.lighting.lights[0].light.kind = CGT_LIGHT_DIRECTIONAL;
    s.lighting.lights[0].shadows = quality == WEB_FULL && v->shadows;
    cgt_camera_get_key_light(&web.camera, web.width, web.height, s.lighting.lights[0].light.position);
    for (int c = 0; c < 3; c++) {
        s.lighting.lights[0].color[c] = v->key;
        s.style.outline_color[c] = 0.01f;
        s.style.background[c] = cgt_srgb_to_linear((float)v->background[c] / 255.0f);
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

static cgt_look look_of_frame(void)
{
    const int triangles = web.sequence.frame.kind == CGT_TRAJECTORY_TRIANGLES;
    return (cgt_look){.index = web.coloring.index,
                      .palette = web.coloring.palette[0],
                      .palette_steps = COLORING_STEPS,
                      .vertex_normals = triangles ? web.sequence.frame.vertex_normal : NULL};
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
    if (!web.scene)
        return fail("no file is open");
    cgt_picture *const p = picture_of(quality);
    const cgt_image image = {.bytes = web.pixels, .channels = 4};
    const cgt_look look = look_of_frame();
    return p ? finish(p, cgt_picture_draw(p, web.scene, &web.camera, &look, 1, &image, NULL)) : -1;
}

/* Adds a step of soft light to the picture; begins: the first. Returns how many are left, or -1. */
EMSCRIPTEN_KEEPALIVE int web_grow(int begins)
{
    uint32_t left = 0;
    if (!web.scene)
        return fail("no file is open");
    cgt_picture *const p = begins ? picture_of(WEB_FULL) : web.picture[WEB_FULL];
    const cgt_image image = {.bytes = web.pixels, .channels = 4};
    const cgt_look look = look_of_frame();
    if (!p)
        return -1;
    cgt_result result = begins ? cgt_picture_begin(p, web.scene, &web.camera, &look, 1, NULL) : CGT_OK;
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
    view_camera_turn(&web.camera, web.camera.target, web.axis, right * turn, down * turn);
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
    const double *const o = web.origin;
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
    const cgt_trajectory_frame *const f = &web.sequence.frame;
    cgt_single_ray ray = {0};
    cgt_hit hit;
    web.message[0] = 0;
    if (!web.scene)
        return -1;
    cgt_result result = cgt_camera_get_ray(&web.camera, web.width, web.height, x, y, ray.org, ray.dir);
    if (!result)
        result = cgt_trace_ray(web.scene, &ray, &hit, NULL);
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
                 web.origin[0] + (double)s[0], web.origin[1] + (double)s[1], web.origin[2] + (double)s[2],
                 (double)s[3]);
    }
    return (int)k;
}

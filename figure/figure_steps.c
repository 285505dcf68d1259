/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The calls of <cgt/figure.h> for pictures of the shown frame: whole, quick or in steps; the camera of a hand. */
#include "figure_state.h"

#include <stdlib.h>
#include <string.h>

#include "options/figure_values.h"

/* ---- The camera --------------------------------------------------------------------------------------------- */

static int is_zero(const float v[3]) { return v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f; }

/* In place of zeros: styles and texts measure by the camera's numbers, too. */
static void put_defaults(cgt_camera *camera)
{
    cgt_camera usual;
    cgt_camera_init(&usual);
    if (is_zero(camera->eye) && is_zero(camera->target) && is_zero(camera->up))
        memcpy(camera->eye, usual.eye, sizeof camera->eye);
    if (is_zero(camera->up))
        memcpy(camera->up, usual.up, sizeof camera->up);
    if (camera->fov == 0.0f)
        camera->fov = usual.fov;
}

/* Refuses what the option camera or a picture would. The camera becomes that of its text, which has fewer digits far
 * from 0, and all of them near it. */
static int check_camera(cgt_figure *figure, cgt_camera *camera)
{
    char text[FIGURE_CAMERA_SIZE], error[256];
    float org[3], dir[3];
    camera_key key;
    cgt_figure_name_camera(figure, camera, text);
    text[strcspn(text, "\n")] = '\0';
    if (cgt_parse_camera(text, &key, error, sizeof error))
        return cgt_figure_fail(figure, "camera: %s", error);
    if (cgt_camera_key_move(&key, figure->origin))
        return cgt_figure_fail(figure, "camera: eye and target are the same point");
    memcpy(camera->eye, key.camera.eye, sizeof camera->eye);
    memcpy(camera->target, key.camera.target, sizeof camera->target);
    if (cgt_camera_get_ray(camera, figure->options.width, figure->options.height, 0, 0, org, dir))
        return cgt_figure_fail(figure, "camera: its rays are not finite, or t_min and t_max are no range from 0 on");
    return 0;
}

cgt_result cgt_figure_set_camera(cgt_figure *figure, const cgt_camera *camera)
{
    cgt_camera hand = *camera;
    hand.projection = CGT_PROJECTION_PERSPECTIVE;
    put_defaults(&hand);
    if (check_camera(figure, &hand))
        return cgt_figure_result(figure);
    figure->hand = hand;
    figure->has_hand = figure->has_moved = 1;
    if (figure->is_settled)
        cgt_figure_take_hand(figure);
    return CGT_OK;
}

cgt_result cgt_figure_fit(cgt_figure *figure)
{
    const cgt_trajectory_frame *const f = figure->frame;
    if (!f) {
        cgt_figure_fail(figure, "nothing is shown");
        return cgt_figure_result(figure);
    }
    const int has_spheres = f->kind == CGT_TRAJECTORY_SPHERES;
    const particles *const p = has_spheres && figure->parts.selects ? &figure->drawn.particles : NULL;
    const float *const xyzr = p ? p->xyzr : f->xyzr; /* NULL in frames of triangles */
    const size_t stride = 4 * sizeof(float);
    const cgt_spheres spheres = {.count = p ? p->count : f->count,
                                 .centers = cgt_floats(xyzr, stride),
                                 .radii = cgt_floats(xyzr ? xyzr + 3 : NULL, stride)};
    const cgt_spheres vertices = {.count = f->count, .centers = cgt_floats(f->position, 0)};
    cgt_camera camera = figure->camera, fitted;
    camera.projection = CGT_PROJECTION_PERSPECTIVE;
    fitted = camera;
    if (figure->options.picture.ortho)
        fitted.projection = CGT_PROJECTION_ORTHOGRAPHIC;
    if (cgt_camera_fit_spheres(&fitted, figure->options.width, figure->options.height,
                               has_spheres ? &spheres : &vertices)) {
        cgt_figure_fail(figure, "there is nothing to fit the camera to");
        return cgt_figure_result(figure);
    }
    memcpy(camera.eye, fitted.eye, sizeof camera.eye);
    memcpy(camera.target, fitted.target, sizeof camera.target);
    return cgt_figure_set_camera(figure, &camera);
}

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

void cgt_figure_set_stop(cgt_figure *figure, bool (*stop)(const void *user), const void *user)
{
    figure->stop = stop;
    figure->stop_user = user;
}

static cgt_result refuse(cgt_figure *figure, const char *sentence)
{
    cgt_figure_fail(figure, "%s", sentence);
    return cgt_figure_result(figure);
}

/* Before a picture of any kind. is_whole: lines are as thick as the camera asks for. */
static cgt_result make_ready(cgt_figure *figure, int is_whole)
{
    if (!figure->frame)
        return refuse(figure, "nothing is shown");
    if (!figure->drawing && cgt_figure_open_picture(figure)) {
        cgt_figure_close_picture(figure);
        return cgt_figure_result(figure);
    }
    if (!is_whole || !figure->has_moved || !figure->shown || !cgt_figure_scene_has_figures(figure))
        return CGT_OK;
    if (cgt_figure_build(figure, 1)) {
        cgt_figure_unshow(figure);
        return cgt_figure_result(figure);
    }
    if (figure->has_hand)
        cgt_figure_take_hand(figure);
    return CGT_OK;
}

static cgt_result finish(cgt_figure *figure, const cgt_picture *picture, cgt_result result)
{
    if (result && picture)
        cgt_picture_get_error_message(picture, figure->message, sizeof figure->message);
    if (result && (!picture || !*figure->message))
        cgt_figure_fail(figure, "cannot draw: %s", cgt_get_result_string(result));
    figure->failure = CGT_OK; /* it is told here */
    return result;
}

cgt_result cgt_figure_draw(cgt_figure *figure, const cgt_image *image, const cgt_trace_options *options)
{
    cgt_result result = make_ready(figure, 1);
    if (result)
        return result;
    const cgt_picture_options settings = cgt_figure_get_settings(figure);
    figure->image = *image;
    result = cgt_picture_set_options(figure->drawing, &settings);
    if (!result)
        result = cgt_figure_trace(figure, options);
    figure->has_begun = !result;
    figure->begun = figure->camera;
    return finish(figure, figure->drawing, result);
}

cgt_result cgt_figure_begin(cgt_figure *figure)
{
    cgt_look looks[FIGURE_LOOKS];
    cgt_result result = make_ready(figure, 1);
    if (result)
        return result;
    cgt_picture_options settings = cgt_figure_get_settings(figure);
    settings.style.transparent = false;
    result = cgt_picture_set_options(figure->drawing, &settings);
    if (!result) {
        const uint32_t count = cgt_figure_begin_picture(figure, looks);
        result = cgt_picture_begin(figure->drawing, figure->scene, &figure->camera, looks, count, NULL);
    }
    figure->has_begun = !result;
    figure->begun = figure->camera;
    return finish(figure, figure->drawing, result);
}

cgt_result cgt_figure_step(cgt_figure *figure, uint32_t samples, uint32_t *left)
{
    return figure->has_begun ? finish(figure, figure->drawing, cgt_picture_step(figure->drawing, samples, left))
                             : refuse(figure, "no picture has begun");
}

cgt_result cgt_figure_read(cgt_figure *figure, const cgt_image *image)
{
    if (!figure->has_begun)
        return refuse(figure, "no picture has begun");
    const cgt_camera next = figure->camera; /* one may have been set since */
    figure->image = *image;
    const cgt_result result = cgt_picture_read(figure->drawing, image);
    figure->camera = figure->begun;
    if (!result)
        cgt_figure_draw_overlay(figure);
    figure->camera = next;
    return finish(figure, figure->drawing, result);
}

/* ---- Quick pictures ----------------------------------------------------------------------------------------- */

static void simplify(cgt_picture_options *s, cgt_figure_quality quality)
{
    s->antialias = 1;
    s->lighting.ambient = 0;
    s->style.transparent = false;
    s->work.stop = NULL;
    if (s->shading == CGT_SHADING_BOUNCES) /* mirrors and glass seem matt */
        s->shading = CGT_SHADING_FULL;
    for (uint32_t i = 0; i < s->lighting.light_count; i++) {
        s->lighting.lights[i].size = 0.0f;
        s->lighting.lights[i].shadows = s->lighting.lights[i].shadows && quality == CGT_FIGURE_SHADOWS;
    }
}

static void enlarge(const uint8_t *from, uint32_t from_width, uint8_t *to, uint32_t width, uint32_t height,
                    uint32_t shrink, size_t channels)
{
    for (uint32_t y = 0; y < height; y++) {
        uint8_t *const row = to + channels * y * width;
        if (y % shrink) {
            memcpy(row, row - channels * width, channels * width);
            continue;
        }
        const uint8_t *const source = from + channels * (y / shrink) * from_width;
        for (uint32_t x = 0; x < width; x++)
            memcpy(row + channels * x, source + channels * (x / shrink), channels);
    }
}

cgt_result cgt_figure_draw_quick(cgt_figure *figure, cgt_figure_quality quality, uint32_t shrink,
                                 const cgt_image *image)
{
    const size_t channels = image->channels ? image->channels : 3;
    const int has_gaps = image->row_stride && image->row_stride != figure->options.width * channels;
    cgt_look looks[FIGURE_LOOKS];
    if (quality >= CGT_FIGURE_QUALITIES || !shrink || !image->bytes || has_gaps)
        return refuse(figure, "a quick picture is one of bytes, without gaps between its rows");
    cgt_result result = make_ready(figure, 0);
    if (result)
        return result;
    const uint32_t width = figure->options.width, height = figure->options.height;
    if (shrink > 1 && !figure->small && !(figure->small = malloc(4 * (size_t)width * height)))
        return finish(figure, NULL, CGT_ERROR_OUT_OF_MEMORY);
    cgt_picture_options settings = cgt_figure_get_settings(figure);
    simplify(&settings, quality);
    settings.width = (width - 1) / shrink + 1; /* no sum that wraps: shrink may be any */
    settings.height = (height - 1) / shrink + 1;
    cgt_picture **const p = &figure->quick[quality];
    result = *p ? cgt_picture_set_options(*p, &settings) : cgt_picture_create(figure->context, &settings, p);
    if (!result) {
        const cgt_image small = {.bytes = shrink > 1 ? figure->small : image->bytes, .channels = image->channels};
        const uint32_t count = cgt_figure_begin_picture(figure, looks);
        result = cgt_picture_draw(*p, figure->scene, &figure->camera, looks, count, &small, NULL);
    }
    if (result) {
        finish(figure, *p, result);
        cgt_picture_release(*p);
        *p = NULL;
        return result;
    }
    if (shrink > 1)
        enlarge(figure->small, settings.width, image->bytes, width, height, shrink, channels);
    figure->image = *image;
    cgt_figure_draw_overlay(figure);
    return CGT_OK;
}

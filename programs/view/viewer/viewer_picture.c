/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The viewer's pictures. While something moves each must be there within --budget: shadows are drawn where
 * they have taken less, then none, then fewer pixels. At rest the picture grows to cgt-render's; an event
 * ends the step at hand. */
#include "view/viewer/viewer_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double settle = 0.12; /* seconds without a move before pictures grow */

/* From the best on. */
static const struct {
    view_quality quality;
    uint32_t shrink;
} levels[VIEW_LEVELS] = {{VIEW_SHADOWS, 1}, {VIEW_PLAIN, 1}, {VIEW_PLAIN, 2},
                         {VIEW_PLAIN, 3},   {VIEW_PLAIN, 4}, {VIEW_PLAIN, 6}};

int viewer_is_moving(const viewer *v)
{
    return v->playing || v->now - v->moved < settle || (v->shown && v->wanted != v->shown->chosen);
}

int viewer_picture_resize(viewer *v, uint32_t width, uint32_t height, float scale)
{
    char error[PROGRAM_ERROR_SIZE], size[32];
    const uint32_t least = 16, most = 16384;
    width = width < least ? least : width > most ? most : width;
    height = height < least ? least : height > most ? most : height;
    if (width == v->width && height == v->height && scale == v->scale && v->rgb)
        return 0;
    const size_t bytes = 3 * (size_t)width * height;
    free(v->rgb);
    free(v->over);
    v->rgb = calloc(bytes, 1);
    v->over = malloc(bytes);
    snprintf(size, sizeof size, "%ux%u", width, height);
    if (!v->rgb || !v->over || (v->draw && view_draw_tell(v->draw, cgt_figure_set(v->draw->figure, "size", size)))) {
        program_error("out of memory for a window of %ux%u pixels", width, height);
        return -1;
    }
    v->width = width;
    v->height = height;
    v->scale = scale > 0.0f ? scale : 1.0f;
    cgt_text_close(v->font); /* without FreeType, or a font, the title of the window tells the frame */
    v->font =
        cgt_text_open(v->options.render.figure.picture.font, floorf(13.0f * v->scale + 0.5f), error, sizeof error);
    memset(v->cost, 0, sizeof v->cost);
    v->outdated = v->changed = 1;
    if (v->draw)
        viewer_publish(v);
    return 0;
}

/* ---- What to draw ------------------------------------------------------------------------------------------- */

/* The best level that fits into what a frame leaves for drawing. What has become too slow is tried again at times. */
static int choose_level(viewer *v)
{
    const double budget = fmax(4.0, (double)v->options.budget - v->compose_cost - (v->playing ? v->build_cost : 0.0));
    int level = 0;
    while (level < VIEW_LEVELS - 1 && v->cost[level] > budget)
        v->cost[level++] *= 0.985;
    return level;
}

static double draw_moving(viewer *v)
{
    const int level = choose_level(v);
    const double begin = program_seconds();
    const cgt_image image = {.bytes = v->rgb};
    cgt_figure *const figure = v->draw->figure;
    cgt_result result = cgt_figure_set_camera(figure, &v->camera);
    if (!result)
        result = cgt_figure_draw_quick(figure, (cgt_figure_quality)levels[level].quality, levels[level].shrink, &image);
    if (view_draw_tell(v->draw, result)) {
        v->scene_is_wrong = 1;
        return INFINITY;
    }
    const double ms = (program_seconds() - begin) * 1e3;
    v->cost[level] = v->cost[level] > 0.0 ? 0.7 * v->cost[level] + 0.3 * ms : ms;
    v->frame_ms =
        v->frame_ms > 0.0 ? 0.9 * v->frame_ms + 0.1e3 * (v->now - v->last_picture) : (double)v->options.budget;
    if (v->now - v->last_picture > 0.5)
        v->frame_ms = 0.0;
    v->last_picture = v->now;
    v->drawn++;
    v->quality = levels[level].quality;
    v->shrink = levels[level].shrink;
    v->outdated = v->is_full = 0;
    v->changed = 1;
    return 0.0;
}

/* One more ray for all that is soft. */
static double draw_better(viewer *v)
{
    const int begins = v->quality != VIEW_FULL;
    uint8_t *const picture = v->over; /* what lies over it is drawn anew in any case */
    cgt_figure *const figure = v->draw->figure;
    const cgt_image image = {.bytes = picture};
    uint32_t left = 0;
    v->grown = begins ? 0 : v->grown ? 2 * v->grown : 1; /* steps of one ray would take twice as long in all */
    cgt_result result = begins ? cgt_figure_set_camera(figure, &v->camera) : CGT_OK;
    if (!result && begins) {
        cgt_figure_set_stop(figure, stop_flag_is_set, &v->stop);
        result = cgt_figure_begin(figure);
        cgt_figure_set_stop(figure, NULL, NULL);
    }
    if (!result)
        result = cgt_figure_step(figure, v->grown > 1 ? v->grown / 2 : v->grown, &left);
    if (!result)
        result = cgt_figure_read(figure, &image);
    const int failed = view_draw_tell(v->draw, result);
    if (failed) { /* an event has come, or an error */
        v->scene_is_wrong |= failed < 0;
        v->quality = VIEW_PLAIN;
        return 0.0;
    }
    v->over = v->rgb;
    v->rgb = picture;
    v->drawn++;
    v->quality = VIEW_FULL;
    v->shrink = 1;
    v->is_full = left == 0;
    v->changed = 1;
    return v->is_full ? INFINITY : 0.0;
}

int viewer_is_settled(const viewer *v)
{
    return (!v->draw && !v->opens) || v->scene_is_wrong ||
           (v->shown && v->wanted == v->shown->chosen && v->is_full && !v->outdated && !v->playing &&
            !v->movie.is_made);
}

double viewer_picture_step(viewer *v)
{
    if (v->outdated)
        return draw_moving(v);
    if (v->is_full || v->playing)
        return INFINITY;
    if (viewer_is_moving(v))
        return fmax(0.001, settle - (v->now - v->moved));
    return draw_better(v);
}

/* ---- What is seen ------------------------------------------------------------------------------------------- */

uint32_t viewer_band(uint32_t height) { return (height + VIEW_RECTS - 1) / VIEW_RECTS; }

/* A row of the picture to that of the window; `dirty` grows by the columns that differ. */
static void put_row(const uint8_t *rgb, uint32_t *pixels, uint32_t width, uint32_t dirty[2])
{
    uint32_t from = width, to = 0;
    for (uint32_t x = 0; x < width; x++) {
        const uint32_t pixel =
            0xff000000u | (uint32_t)rgb[3 * x] << 16 | (uint32_t)rgb[3 * x + 1] << 8 | rgb[3 * x + 2];
        if (pixels[x] != pixel) {
            from = from < x ? from : x;
            to = x + 1;
            pixels[x] = pixel;
        }
    }
    if (from >= to)
        return;
    const int is_first = dirty[0] >= dirty[1];
    dirty[0] = is_first || from < dirty[0] ? from : dirty[0];
    dirty[1] = is_first || to > dirty[1] ? to : dirty[1];
}

static void set_title(viewer *v)
{
    const char *const input = v->options.render.input ? v->options.render.input : "cgt-view";
    if (v->shown)
        snprintf(v->title, sizeof v->title, "%.180s: frame %llu", input, (unsigned long long)v->shown->frame.number);
    else
        snprintf(v->title, sizeof v->title, "%.180s", input);
}

static void put_band(void *user, uint32_t number)
{
    viewer *const v = user;
    const uint32_t rows = viewer_band(v->height), first = number * rows;
    for (uint32_t y = first; y < first + rows && y < v->pixels_height; y++)
        put_row(v->over + 3 * (size_t)y * v->width, v->pixels + (size_t)y * v->width, v->width, v->dirty[number]);
}

void viewer_compose(viewer *v)
{
    const double begin = program_seconds();
    memcpy(v->over, v->rgb, 3 * (size_t)v->width * v->height);
    viewer_draw_panels(v);
    pthread_mutex_lock(&v->picture_lock);
    if (v->pixels_width != v->width || v->pixels_height != v->height) {
        free(v->pixels);
        v->pixels = calloc((size_t)v->width * v->height, sizeof *v->pixels);
        v->pixels_width = v->pixels ? v->width : 0;
        v->pixels_height = v->pixels ? v->height : 0;
        memset(v->dirty, 0, sizeof v->dirty);
    }
    if (v->draw)
        cgt_context_run_tasks(v->draw->context, put_band, v, VIEW_RECTS);
    for (uint32_t i = 0; i < VIEW_RECTS && !v->draw; i++)
        put_band(v, i);
    v->picture_number++;
    set_title(v);
    pthread_mutex_unlock(&v->picture_lock);
    v->changed = 0;
    v->compose_cost = 0.8 * v->compose_cost + 0.2e3 * (program_seconds() - begin);
}

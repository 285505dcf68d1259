/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Texts on pictures of many sizes: each inside of the picture and of its rectangle, none over another one or the scene,
 * which the automatic camera shows in the room that is left. */
#include "support/suite.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/camera_path.h"
#include "figure_state.h"
#include "text/overlay.h"

static const char *const long_text =
    "Relaxation of a slab of amorphous silica at constant pressure, after a quench from 4000 K at 5 K each picosecond, "
    "in a box that is periodic along x and y, with walls above and below that nobody sees";

enum { KINDS = 24 };
static overlay_kind kinds[KINDS];
static coloring colors;

static int make_kinds(void **state)
{
    (void)state;
    for (int i = 0; i < KINDS; i++) {
        for (int c = 0; c < 3; c++)
            kinds[i].color[c] = 1.0f;
        snprintf(kinds[i].name, sizeof kinds[i].name, i % 5 == 4 ? "a kind with a rather long name %d" : "kind %d", i);
    }
    return cgt_coloring_init(&colors, COLORING_VALUE, NULL, -12345.5f, 23456.5f);
}

static int free_colors(void **state)
{
    (void)state;
    cgt_coloring_free(&colors);
    return 0;
}

static const uint32_t sizes[][2] = {{400, 600}, {3000, 2000}, {200, 200},  {64, 48},  {1280, 720},
                                    {1, 1},     {10, 300},    {2000, 100}, {33, 900}, {320, 240}};
static const char *const titles[] = {NULL, "Grains", "", NULL /* the long one */,
                                     "Donaudampfschifffahrtsgesellschaften"};
enum { SIZES = sizeof sizes / sizeof sizes[0], TITLES = sizeof titles / sizeof titles[0] };

/* Texts of a kind for each bit or so of a number. */
static overlay make_overlay(text_font *font, uint32_t number, uint32_t height, float share)
{
    static const uint32_t counts[] = {0, 2, 9, 24, 500};
    overlay o = {
        .font = font, .size = fmaxf(8.0f, share * (float)height), .color = {1.0f, 1.0f, 1.0f}, .coloring = &colors};
    const char *const title = number % TITLES == 3 ? long_text : titles[number % TITLES];
    o.title = title;
    o.axes = number / 5 % 2;
    o.scale = (scale_bar){font && number / 4 % 3 == 1, number / 12 % 2 ? 0.0 : 2.5, "furlong"};
    o.time = number / 10 % 3 == 0 ? NULL : number / 10 % 3 == 1 ? "t = {time:.2f} ps" : long_text;
    o.extreme[0] = (overlay_frame){.time = -3.5};
    o.extreme[1] = (overlay_frame){.time = 12345.25};
    o.extremes = 2;
    if (number / 30 % 3 == 1) {
        o.bar = number % 2 ? "speed, m/s" : number % 4 ? "" : long_text;
    } else if (number / 30 % 3 == 2) {
        o.legend = number % 3 ? "kinds" : number % 9 ? "" : long_text;
        o.kinds = kinds;
        o.kind_count = counts[number / 7 % 5];
    }
    return o;
}

static int is_there(const layout_rect *r) { return r->x1 > r->x0; }

static int overlap(const layout_rect *a, const layout_rect *b)
{
    const float tolerance = 0.01f;
    return a->x0 < b->x1 - tolerance && b->x0 < a->x1 - tolerance && a->y0 < b->y1 - tolerance &&
           b->y0 < a->y1 - tolerance;
}

static void check_rectangles(const layout *l, uint32_t width, uint32_t height, uint32_t number)
{
    const float w = (float)width, h = (float)height;
    for (int i = 0; i < LAYOUT_ITEMS; i++) {
        const layout_rect *const r = &l->rect[i];
        if (!is_there(r))
            continue;
        if (r->x0 < 0.0f || r->y0 < 0.0f || r->x1 > w + 0.01f || r->y1 > h + 0.01f)
            fail_msg("%ux%u, texts %u: %d reaches out", width, height, number, i);
        if (l->left_out >> i & 1u)
            fail_msg("%ux%u, texts %u: %d is left out, and there", width, height, number, i);
        for (int k = 0; k < i; k++)
            if (is_there(&l->rect[k]) && overlap(r, &l->rect[k]))
                fail_msg("%ux%u, texts %u: %d lies over %d", width, height, number, i, k);
        if (is_there(&l->rect[LAYOUT_AXES]) || l->rooms == 1)
            for (uint32_t k = 0; k < l->rooms; k++)
                if (overlap(r, &l->room[k]))
                    fail_msg("%ux%u, texts %u: %d lies in the scene's room", width, height, number, i);
    }
    for (uint32_t k = 0; k < l->rooms; k++) {
        const layout_rect *const r = &l->room[k];
        if (r->x1 - r->x0 < 0.39f * w || r->y1 - r->y0 < 0.39f * h || r->x0 >= 0.5f * w || r->x1 <= 0.5f * w ||
            r->y0 >= 0.5f * h || r->y1 <= 0.5f * h)
            fail_msg("%ux%u, texts %u: the scene's room is small", width, height, number);
    }
}

/* All that is there was asked for, and what was asked for is there or told. */
static void check_told(const overlay *o, uint32_t number)
{
    const layout *const l = &o->layout;
    const int wanted[LAYOUT_ITEMS] = {o->title && *o->title,      o->time != NULL, o->scale.is_set, o->bar != NULL,
                                      o->legend && o->kind_count, o->axes};
    for (int i = 0; i < LAYOUT_ITEMS; i++)
        if (wanted[i] != (is_there(&l->rect[i]) || l->left_out >> i & 1u))
            fail_msg("texts %u: %d is %s", number, i, wanted[i] ? "not told" : "there");
}

static text_font *open_font(void)
{
    char error[256];
    text_font *const font = cgt_text_open(NULL, 12.0f, error, sizeof error);
    if (!font)
        print_message("%s\n", error);
    return font;
}

TEST(texts_have_places_of_their_own)
{
    text_font *const font = open_font();
    uint32_t placed = 0, cut = 0;
    for (int with_font = 0; with_font < 1 + (font != NULL); with_font++)
        for (size_t s = 0; s < SIZES; s++)
            for (uint32_t number = 0; number < 360; number += s < 4 ? 3 : 13) {
                overlay o = make_overlay(with_font ? font : NULL, number, sizes[s][1], number % 11 ? 0.03f : 0.12f);
                if (!with_font) /* texts have no width */
                    o.title = o.time = NULL;
                cgt_overlay_place(&o, sizes[s][0], sizes[s][1]);
                check_rectangles(&o.layout, sizes[s][0], sizes[s][1], number);
                check_told(&o, number);
                for (int i = 0; i < LAYOUT_ITEMS; i++)
                    placed += (uint32_t)is_there(&o.layout.rect[i]);
                cut += o.layout.cut != 0;
            }
    assert_true(placed > 600 && (!font || cut > 60));
    cgt_text_close(font);
}

/* At usual sizes nothing usual is left out or cut. */
TEST(usual_texts_find_room)
{
    text_font *const font = open_font();
    static const uint32_t usual[][2] = {{400, 600}, {3000, 2000}, {1280, 720}, {640, 480}};
    for (size_t s = 0; s < sizeof usual / sizeof usual[0] && font; s++)
        for (int is_legend = 0; is_legend < 2; is_legend++) {
            overlay o = make_overlay(font, 11, usual[s][1], 0.03f);
            o.title = "Grains poured into a box";
            o.axes = 1;
            o.bar = is_legend ? NULL : "speed, m/s";
            o.legend = is_legend ? "streams" : NULL;
            o.kinds = kinds;
            o.kind_count = 4;
            cgt_overlay_place(&o, usual[s][0], usual[s][1]);
            assert_int_equal(o.layout.left_out | o.layout.cut, 0);
            assert_int_equal(o.layout.title.count, 1);
        }
    cgt_text_close(font);
}

/* Names that fit in small letters are not told as cut; others are cut, and lines beyond a few counted. */
TEST(legends_shrink_before_they_are_cut)
{
    text_font *const font = open_font();
    if (!font)
        skip();
    overlay_kind long_kinds[] = {{{1, 1, 1}, "a name that is rather long, yet not too long"}, {{1, 1, 1}, "water"}};
    overlay o = make_overlay(font, 0, 480, 0.03f);
    o.legend = "kinds";
    o.kinds = long_kinds;
    o.kind_count = 2;
    cgt_overlay_place(&o, 640, 480);
    assert_int_equal(o.layout.cut | o.layout.left_out, 0);
    assert_true(o.layout.lines == 2 && o.layout.size[LAYOUT_LEGEND] < 0.75f * o.size);
    cgt_overlay_place(&o, 400, 480);
    assert_int_equal(o.layout.cut, 1u << LAYOUT_LEGEND);
    assert_int_equal(o.layout.lines, 2);
    o.kinds = kinds;
    o.kind_count = 100;
    cgt_overlay_place(&o, 640, 200);
    assert_true(o.layout.lines > 4 && o.layout.lines <= OVERLAY_MOST_KINDS);
    cgt_text_close(font);
}

/* What is drawn is where the layout says, but for the grey of a letter's edge. */
TEST(texts_stay_in_their_rectangles)
{
    text_font *const font = open_font();
    const overlay_frame frame = {
        .time = 7.5, .right = {0.6f, 0.8f, 0}, .up = {0, 0, -1}, .forward = {0.8f, -0.6f, 0}, .pixel = 0.05};
    if (!font)
        skip();
    for (size_t s = 0; s < SIZES; s++)
        for (uint32_t number = 1; number<360; number += sizes[s][0]> 2000 ? 40 : 7) {
            const uint32_t width = sizes[s][0], height = sizes[s][1];
            uint8_t *const rgb = calloc((size_t)width * height, 3);
            assert_non_null(rgb);
            const canvas c = {width, height, {.bytes = rgb}};
            overlay o = make_overlay(font, number, height, 0.03f);
            cgt_overlay_place(&o, width, height);
            cgt_overlay_draw(&o, &c, &frame);
            uint32_t outside = 0;
            for (uint32_t y = 0; y < height; y++)
                for (uint32_t x = 0; x < width; x++) {
                    const uint8_t *const p = rgb + 3 * ((size_t)y * width + x);
                    int is_inside = !p[0] && !p[1] && !p[2];
                    for (int i = 0; i < LAYOUT_ITEMS && !is_inside; i++) {
                        const layout_rect *const r = &o.layout.rect[i];
                        is_inside = (float)x >= r->x0 - 2.0f && (float)x <= r->x1 + 1.0f && (float)y >= r->y0 - 1.0f &&
                                    (float)y <= r->y1 + 1.0f;
                    }
                    outside += !is_inside;
                }
            free(rgb);
            if (outside)
                fail_msg("%ux%u, texts %u: %u pixels outside", width, height, number, outside);
        }
    cgt_text_close(font);
}

/* What follows a number does not move with its digits. */
TEST(times_keep_their_width)
{
    static const char *const formats[] = {"t = {time} ps", "{step} steps", "{frame}: {time:.3f} x"};
    static const double times[] = {-1.5, 0.25, 9.5, 10.0, 999.125, 1200.0};
    enum { WIDTH = 400, HEIGHT = 100 };
    static uint8_t rgb[3 * WIDTH * HEIGHT];
    text_font *const font = open_font();
    if (!font)
        skip();
    for (size_t k = 0; k < 3; k++) {
        int last = -1;
        for (uint64_t i = 0; i < 6; i++) {
            overlay o = make_overlay(font, 0, HEIGHT, 0.12f);
            const canvas c = {WIDTH, HEIGHT, {.bytes = rgb}};
            const overlay_frame frame = {.number = 3 * i, .step = -7 + 33 * (int64_t)i, .time = times[i]};
            o.time = formats[k];
            o.extreme[0] = (overlay_frame){.number = 0, .step = -7, .time = -1.5};
            o.extreme[1] = (overlay_frame){.number = 15, .step = 200, .time = 1200.0};
            o.time_letters = 7;
            memset(rgb, 0, sizeof rgb);
            cgt_overlay_place(&o, WIDTH, HEIGHT);
            cgt_overlay_draw(&o, &c, &frame);
            int right = -1;
            for (int x = 0; x < WIDTH; x++)
                for (int y = 0; y < HEIGHT; y++)
                    right = rgb[3 * (y * WIDTH + x)] ? x : right;
            assert_true(right > 40);
            if (last >= 0)
                assert_in_range(right, last - 1, last + 1); /* places of letters are whole pixels */
            last = last < 0 ? right : last;
        }
    }
    cgt_text_close(font);
}

/* ---- The camera ----------------------------------------------------------------------------------------------- */

enum { BALLS = 60 };

static float noise(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / 16777216.0f;
}

static void make_scene(uint32_t seed, double center[BALLS][3], double radius[BALLS])
{
    const double extent[3] = {1.0 + 20.0 * (double)noise(&seed), 1.0 + 20.0 * (double)noise(&seed),
                              1.0 + 20.0 * (double)noise(&seed)};
    for (int i = 0; i < BALLS; i++) {
        for (int c = 0; c < 3; c++)
            center[i][c] = 100.0 * c + extent[c] * (double)noise(&seed);
        radius[i] = 0.1 + (double)noise(&seed);
    }
}

/* Where a point is seen, in pixels. */
static void project(const cgt_camera *camera, const double p[3], uint32_t width, uint32_t height, float pixel[2])
{
    float right[3], up[3], forward[3];
    double at[3] = {0.0, 0.0, 0.0};
    const double tangent = tan((double)camera->fov * 3.14159265358979323846 / 360.0);
    cgt_camera_get_axes(camera, right, up, forward);
    for (int c = 0; c < 3; c++) {
        const double from = p[c] - (double)camera->eye[c];
        at[0] += from * (double)right[c];
        at[1] += from * (double)up[c];
        at[2] += from * (double)forward[c];
    }
    assert_true(at[2] > 0.0);
    const double half =
        camera->projection == CGT_PROJECTION_ORTHOGRAPHIC ? 0.5 * (double)camera->height : at[2] * tangent;
    pixel[0] = (float)(0.5 * (double)width + 0.5 * (double)height / half * at[0]);
    pixel[1] = (float)(0.5 * (double)height - 0.5 * (double)height / half * at[1]);
}

/* Where the scene is seen: by points all over the balls. */
static layout_rect find_seen(const cgt_camera *camera, double center[BALLS][3], const double radius[BALLS],
                             uint32_t width, uint32_t height)
{
    layout_rect seen = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (int i = 0; i < BALLS; i++)
        for (int k = 0; k < 200; k++) { /* a spiral */
            const double z = (k + 0.5) / 100.0 - 1.0, angle = 2.399963 * k, away = sqrt(1.0 - z * z);
            const double p[3] = {center[i][0] + radius[i] * away * cos(angle),
                                 center[i][1] + radius[i] * away * sin(angle), center[i][2] + radius[i] * z};
            float at[2];
            project(camera, p, width, height, at);
            seen = (layout_rect){fminf(seen.x0, at[0]), fminf(seen.y0, at[1]), fmaxf(seen.x1, at[0]),
                                 fmaxf(seen.y1, at[1])};
        }
    return seen;
}

/* Rooms of all kinds of texts, scenes that are wide, high and deep, angles and orbits: the scene is in its room, and
 * fills it, unless it goes around. */
TEST(the_scene_is_in_its_room)
{
    static const uint32_t pictures[][2] = {{400, 600}, {3000, 2000}, {1280, 720}, {200, 200}};
    text_font *const font = open_font();
    for (uint32_t number = 0; number < 1320; number += 11) {
        const uint32_t width = pictures[number % 4][0], height = pictures[number % 4][1];
        const double orbit = number % 3 == 2 ? 130.0 : 0.0;
        const int is_parallel = number % 5 == 4;
        const float fov = number % 7 == 6 ? 90.0f : 30.0f, up[3] = {0, 0, 1};
        const float view[3] = {0.5f, -1.0f, number % 2 ? 0.45f : -0.2f};
        static camera_directions fit;
        static camera_reach reach;
        double center[BALLS][3], radius[BALLS];
        float min[3] = {INFINITY, INFINITY, INFINITY}, max[3] = {-INFINITY, -INFINITY, -INFINITY};
        overlay o = make_overlay(font, number, height, 0.03f);
        cgt_overlay_place(&o, width, height);
        cgt_camera_directions_set(&fit, view, up, fov, (double)width / (double)height, orbit, is_parallel);
        if (!is_parallel)
            cgt_camera_directions_add_plain(&fit);
        cgt_camera_reach_clear(&reach);
        make_scene(number, center, radius);
        for (int i = 0; i < BALLS; i++) {
            cgt_camera_reach_add(&reach, &fit, center[i], radius[i]);
            for (int c = 0; c < 3; c++) {
                min[c] = fminf(min[c], (float)(center[i][c] - radius[i]));
                max[c] = fmaxf(max[c], (float)(center[i][c] + radius[i]));
            }
        }
        camera_room rooms[2];
        for (uint32_t i = 0; i < o.layout.rooms; i++) {
            const layout_rect *const r = &o.layout.room[i];
            rooms[i] = cgt_camera_room_between(r->x0, r->y0, r->x1, r->y1, width, height);
        }
        camera_path path;
        uint32_t chosen = 9;
        assert_int_equal(cgt_camera_path_fit_room(&path, &fit, &reach, min, max, rooms, o.layout.rooms, &chosen), 0);
        assert_true(chosen < o.layout.rooms);
        const layout_rect *const room = &o.layout.room[chosen];
        for (int k = 0; k < (orbit != 0.0 ? 10 : 1); k++) {
            cgt_camera camera;
            cgt_camera_path_at(&path, k / 9.0, &camera);
            if (is_parallel) {
                double square = 0.0;
                for (int c = 0; c < 3; c++)
                    square += pow((double)camera.eye[c] - (double)camera.target[c], 2.0);
                camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
                camera.height = (float)(2.0 * sqrt(square) * tan((double)fov * 3.14159265358979323846 / 360.0));
            }
            const layout_rect seen = find_seen(&camera, center, radius, width, height);
            if (seen.x0 < room->x0 || seen.y0 < room->y0 || seen.x1 > room->x1 || seen.y1 > room->y1)
                fail_msg("%u: the scene reaches out of its room", number);
            const float x = (seen.x1 - seen.x0) / (room->x1 - room->x0),
                        y = (seen.y1 - seen.y0) / (room->y1 - room->y0);
            if (orbit == 0.0 && fmaxf(x, y) < (fov > 60.0f ? 0.7f : 0.88f) && !(is_parallel && fov > 60.0f))
                fail_msg("%u: the scene fills %g by %g of its room", number, (double)x, (double)y);
        }
        if (orbit == 0.0) { /* what is in the middle of the room stays there */
            double middle[3];
            float at[2];
            for (int c = 0; c < 3; c++)
                middle[c] = (double)path.start.target[c] + path.middle[c];
            for (int k = 0; k < 2; k++) {
                project(&path.start, middle, width, height, at);
                assert_true(fabsf(at[0] - 0.5f * (room->x0 + room->x1)) < 0.02f * (float)width);
                assert_true(fabsf(at[1] - 0.5f * (room->y0 + room->y1)) < 0.02f * (float)height);
                cgt_camera_path_zoom(&path, number % 2 ? 3.0f : 0.5f);
            }
        }
    }
    cgt_text_close(font);
}

/* Whole figures: options, a survey, a picture. */
TEST(figures_show_the_scene_in_its_room)
{
    static const char *const sets[][5][2] = {
        {{"title", "Grains"}, {"colorbar", "heat, K"}, {"time", "step {step}"}, {"axes", NULL}, {"size", "400x600"}},
        {{"color", "type"}, {"legend", "kinds"}, {"axes", NULL}, {"ortho", NULL}, {"size", "300x200"}},
        {{"colorbar", ""}, {"scale-bar", NULL}, {"fov", "70"}, {"view", "top"}, {"size", "320x240"}},
        {{"title", "Grains"}, {"colorbar", "heat"}, {"orbit", "90"}, {"axes", NULL}, {"size", "640x300"}},
        {{"title", "Grains"}, {"axes", NULL}, {"time", "{frame}"}, {"zoom", "0.8"}, {"size", "200x200"}}};
    static float place[BALLS][3], radii[BALLS], heat[BALLS];
    static uint32_t types[BALLS];
    static uint8_t pixels[3 * 640 * 600];
    text_font *const font = open_font();
    cgt_context *context;
    if (!font)
        skip();
    cgt_text_close(font);
    assert_int_equal(cgt_context_create(NULL, &context), CGT_OK);
    for (size_t k = 0; k < 2 * sizeof sets / sizeof sets[0]; k++) {
        const cgt_figure_column columns[] = {{.name = "radius", .values = cgt_floats(radii, 0)},
                                             {.name = "type", .values = cgt_uint32s(types, 0)},
                                             {.name = "heat", .values = cgt_floats(heat, 0)}};
        const cgt_figure_data data = {.points = {BALLS, cgt_floats(place[0], 0), columns, 3, 0.0f}};
        const cgt_image image = {.bytes = pixels};
        double center[BALLS][3], radius[BALLS];
        cgt_figure *figure;
        cgt_camera camera;
        make_scene((uint32_t)k + 77, center, radius);
        for (int i = 0; i < BALLS; i++) {
            for (int c = 0; c < 3; c++)
                place[i][c] = (float)center[i][c];
            radii[i] = (float)radius[i];
            types[i] = 1 + (uint32_t)i % 3;
            heat[i] = (float)i;
        }
        assert_int_equal(cgt_figure_create(context, &figure), CGT_OK);
        assert_int_equal(cgt_figure_set(figure, "color", "heat"), CGT_OK);
        assert_int_equal(cgt_figure_set(figure, "style", "plain"), CGT_OK);
        for (int i = 0; i < 5; i++)
            assert_int_equal(cgt_figure_set(figure, sets[k / 2][i][0], sets[k / 2][i][1]), CGT_OK);
        assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
        assert_int_equal(cgt_figure_draw(figure, &image, NULL), CGT_OK);
        camera = figure->camera; /* with its projection */
        const layout *const l = &figure->overlay.layout;
        const uint32_t width = figure->options.width, height = figure->options.height;
        const layout_rect seen = find_seen(&camera, center, radius, width, height), *const room = &l->room[l->chosen];
        assert_int_equal(l->left_out, 0);
        assert_true(room->x1 - room->x0 < (float)width || room->y1 - room->y0 < (float)height);
        if (seen.x0 < room->x0 || seen.y0 < room->y0 || seen.x1 > room->x1 || seen.y1 > room->y1)
            fail_msg("%zu: the scene reaches out of its room", k);
        const float x = (seen.x1 - seen.x0) / (room->x1 - room->x0), y = (seen.y1 - seen.y0) / (room->y1 - room->y0);
        assert_true(fmaxf(x, y) > (k / 2 == 3 ? 0.3f : 0.7f));
        cgt_figure_release(figure);
    }
    cgt_context_release(context);
}

/* The numbers of all frames that were looked at count for the width. */
TEST(surveys_know_the_longest_times)
{
    static const char *const formats[] = {"{step} steps", "{time} ps", "at {frame}: {time:.1f} ps"};
    static const double times[] = {-20.125, 0.5, 8.25};
    enum { WIDTH = 500, HEIGHT = 100 };
    static uint8_t pixels[3 * WIDTH * HEIGHT];
    static const float place[3] = {0.0f, 0.0f, 0.0f};
    text_font *const font = open_font();
    cgt_context *context;
    if (!font)
        skip();
    cgt_text_close(font);
    assert_int_equal(cgt_context_create(NULL, &context), CGT_OK);
    for (size_t k = 0; k < sizeof formats / sizeof formats[0]; k++) {
        cgt_figure *figure;
        cgt_figure_data data = {.points = {1, cgt_floats(place, 0), NULL, 0, 0.01f}};
        const cgt_image image = {.bytes = pixels};
        int right[3] = {0, 0, 0};
        assert_int_equal(cgt_figure_create(context, &figure), CGT_OK);
        assert_int_equal(cgt_figure_set(figure, "size", "500x100"), CGT_OK);
        assert_int_equal(cgt_figure_set(figure, "camera", "0,0,9,0,0,0,0,1,0,5"), CGT_OK);
        assert_int_equal(cgt_figure_set(figure, "background", "black"), CGT_OK);
        assert_int_equal(cgt_figure_set(figure, "time", formats[k]), CGT_OK);
        for (int show = 0; show < 2; show++)
            for (uint64_t i = 0; i < 3; i++) {
                data.number = i;
                data.step = -1000 + 1100 * (int64_t)i;
                data.time = &times[i];
                if (!show) {
                    assert_int_equal(cgt_figure_survey(figure, &data), CGT_OK);
                    continue;
                }
                assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
                assert_int_equal(cgt_figure_draw(figure, &image, NULL), CGT_OK);
                for (int x = 0; x < WIDTH / 2 - 20; x++) /* the sphere is in the middle */
                    for (int y = HEIGHT / 2; y < HEIGHT; y++)
                        right[i] = pixels[3 * (y * WIDTH + x)] > 20 ? x : right[i];
            }
        assert_in_range(right[1], right[0] - 1, right[0] + 1);
        assert_in_range(right[2], right[0] - 1, right[0] + 1);
        assert_true(right[0] > 40);
        cgt_figure_release(figure);
    }
    cgt_context_release(context);
}

SUITE(make_kinds, free_colors)

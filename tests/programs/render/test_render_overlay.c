/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What lies over pictures of cgt-render: lines, text, ticks, the colour bar, axes, each where it should be. */
#include "support/suite.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "options/numbers.h"
#include "text/overlay.h"

enum { WIDTH = 320, HEIGHT = 200 };

static uint8_t rgb[3 * WIDTH * HEIGHT], alpha[WIDTH * HEIGHT];
static const float white[3] = {1.0f, 1.0f, 1.0f};

/* A black canvas. */
static canvas make_canvas(int with_alpha)
{
    memset(rgb, 0, sizeof rgb);
    memset(alpha, 0, sizeof alpha);
    return (canvas){WIDTH, HEIGHT, {.bytes = rgb, .alpha = with_alpha ? alpha : NULL}};
}

static const uint8_t *pixel(int x, int y) { return rgb + 3 * (y * WIDTH + x); }

/* Pixels that are not black in a rectangle. */
static int drawn(int x0, int y0, int x1, int y1)
{
    int count = 0;
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++)
            count += pixel(x, y)[0] || pixel(x, y)[1] || pixel(x, y)[2];
    return count;
}

TEST(coverage_blends_light)
{
    canvas c = make_canvas(0);
    cgt_canvas_blend(&c, 3, 4, white, 0.5f);
    assert_int_equal(pixel(3, 4)[0], 188); /* half the light, in sRGB */
    cgt_canvas_blend(&c, -1, 4, white, 1.0f);
    cgt_canvas_blend(&c, WIDTH, 4, white, 1.0f);
    cgt_canvas_blend(&c, 3, HEIGHT, white, 1.0f);
    assert_int_equal(drawn(0, 0, WIDTH, HEIGHT), 1);
    c = make_canvas(1); /* over nothing the colour is the line's own */
    cgt_canvas_blend(&c, 3, 4, white, 0.5f);
    assert_int_equal(pixel(3, 4)[0], 255);
    assert_int_equal(alpha[4 * WIDTH + 3], 128);
}

/* What is drawn on linear pixels is what is drawn on the coded ones, and leaves depth and primitive. */
TEST(linear_pixels_are_drawn_on)
{
    static cgt_linear_pixel linear[WIDTH * HEIGHT];
    static const float grey[3] = {0.5f, 0.25f, 0.125f}, blue[3] = {0.0f, 0.0f, 1.0f};
    for (int with_alpha = 0; with_alpha < 2; with_alpha++) {
        canvas c = make_canvas(with_alpha);
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            linear[i] = (cgt_linear_pixel){0.0f, 0.0f, 0.0f, 7.0f, 5, with_alpha ? 0.0f : 1.0f};
        c.image.linear = linear;
        cgt_canvas_fill(&c, 10.0f, 20.5f, 50.0f, 20.0f, grey);
        cgt_canvas_line(&c, (const float[]){5, 5}, (const float[]){80, 90}, 3.0f, blue);
        int partly = 0;
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const float a = with_alpha ? linear[i].a : 1.0f, *color = &linear[i].r;
            assert_true(linear[i].depth == 7.0f && linear[i].id == 5);
            assert_true(!with_alpha || fabsf(linear[i].a - (float)alpha[i] / 255.0f) < 0.01f);
            partly += a > 0.2f && a < 0.8f;
            for (int k = 0; k < 3 && a > 0.2f; k++) /* premultiplied */
                assert_in_range(cgt_srgb_encode(color[k] / a) + 6, rgb[3 * i + k], rgb[3 * i + k] + 12);
        }
        assert_true(!with_alpha || partly > 50);
        assert_true(fabsf(linear[30 * WIDTH + 55].r - 0.5f) < 1e-6f);
    }
}

TEST(shapes_are_where_they_should)
{
    canvas c = make_canvas(0);
    cgt_canvas_fill(&c, 10.0f, 20.5f, 5.0f, 2.0f, white);
    assert_int_equal(pixel(9, 21)[0], 0);
    assert_int_equal(pixel(10, 21)[0], 255);
    assert_int_equal(pixel(14, 21)[0], 255);
    assert_int_equal(pixel(15, 21)[0], 0);
    assert_int_equal(pixel(12, 20)[0], 188); /* half of a row */
    assert_int_equal(pixel(12, 22)[0], 188);
    c = make_canvas(0);
    cgt_canvas_line(&c, (const float[]){50, 50}, (const float[]){80, 90}, 3.0f, white); /* 50 long */
    assert_int_equal(pixel(65, 70)[0], 255);
    assert_int_equal(pixel(50, 50)[0], 255);
    assert_int_equal(pixel(65, 50)[0], 0);
    assert_int_equal(pixel(81, 91)[0], 0); /* beyond its end */
    assert_in_range(drawn(0, 0, WIDTH, HEIGHT), 150, 330);
    cgt_canvas_line(&c, (const float[]){-1e6f, 10}, (const float[]){1e6f, 10}, 1.0f,
                    white); /* cut, and no endless loop */
    assert_int_equal(pixel(0, 10)[0] > 0 && pixel(WIDTH - 1, 10)[0] > 0, 1);
}

TEST(ticks_are_round)
{
    static const struct {
        double min, max;
        int logarithmic;
        double first;
        uint32_t count;
    } rows[] = {{0.0, 10.0, 0, 0.0, 6}, {0.13, 0.97, 0, 0.2, 4}, {-3.0, 3.0, 0, -3.0, 0}, {1.0, 1000.0, 1, 1.0, 4},
                {2.0, 5e6, 1, 10.0, 6}, {1e-9, 1e9, 1, 1e-9, 0}, {2.0, 9.0, 1, 2.0, 0}};
    double ticks[6];
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const uint32_t count = cgt_overlay_ticks(rows[i].min, rows[i].max, rows[i].logarithmic, ticks, 6);
        if (count < 2 || (rows[i].count && count != rows[i].count))
            fail_msg("row %zu has %u ticks", i, count);
        for (uint32_t k = 0; k < count; k++)
            assert_true(ticks[k] >= rows[i].min * (rows[i].min > 0 ? 0.999 : 1.001) - 1e-9 &&
                        ticks[k] <= rows[i].max * 1.001 && (k == 0 || ticks[k] > ticks[k - 1]));
        if (rows[i].count)
            assert_true(fabs(ticks[0] - rows[i].first) < 1e-9 * fabs(rows[i].first) + 1e-12);
    }
    assert_int_equal(cgt_number_digits(12345680.0, 20.0), 8); /* so that the numbers at them differ */
    assert_int_equal(cgt_number_digits(3.00002, 1e-5), 7);
    assert_int_equal(cgt_number_digits(5e6, 1e6), 6);
    assert_int_equal(cgt_number_digits(1.0, 0.0), 6);
    assert_int_equal(cgt_number_digits(1e30, 1e-30), 15);
    assert_int_equal(cgt_overlay_ticks(1.0, 1.0, 0, ticks, 6), 0);
    assert_int_equal(cgt_overlay_ticks(0.0, INFINITY, 0, ticks, 6), 0);
}

/* All ticks of a range, as they are written: an end that is a tick has one, though ranges are floats. */
TEST(ticks_reach_the_ends)
{
    static const struct {
        float min, max;
        int logarithmic;
        uint32_t most;
        const char *ticks;
    } rows[] = {
        {0.0f, 60.0f, 0, 6, "0 20 40 60"},
        {0.0f, 300.0f, 0, 6, "0 100 200 300"},
        {0.0f, 50.0f, 0, 6, "0 10 20 30 40 50"},
        {-3.0f, 3.0f, 0, 6, "-2 0 2"},
        {-0.6f, 0.0f, 0, 6, "-0.6 -0.4 -0.2 0"},
        {0.1f, 0.5f, 0, 6, "0.1 0.2 0.3 0.4 0.5"},
        {0.1f, 0.7f, 0, 6, "0.2 0.4 0.6"},
        {1000.1f, 1000.5f, 0, 6, "1000.1 1000.2 1000.3 1000.4 1000.5"},
        {1e30f, 3e30f, 0, 6, "1e+30 1.5e+30 2e+30 2.5e+30 3e+30"},
        {-1.0f, 1.0f, 0, 2, "-1 1"},
        {-2.0f, 4.0f, 0, 3, "-2 2"},
        {0.0f, 4.0f, 0, 2, "0 4"},
        {1.0f, 1e6f, 1, 6, "1 100 10000 1e+06"},
        {0.001f, 1000.0f, 1, 6, "0.001 0.1 10 1000"},
        {1e-8f, 1e8f, 1, 6, "1e-08 0.0001 1 10000 1e+08"},
        {1e-30f, 1e30f, 1, 6, "1e-30 1e-18 1e-06 1e+06 1e+18 1e+30"},
        {1.0f, 10.0f, 1, 6, "1 2 5 10"},
        {2.0f, 90.0f, 1, 6, "2 5 10 20 50"},
        {2.0f, 90.0f, 1, 3, "2 10 50"},
        {3.0f, 95.0f, 1, 6, "5 10 20 50"},
        {1.1f, 11.5f, 1, 6, "2 5 10"},
        {0.2f, 500.0f, 1, 6, "1 10 100"},
        {2.0f, 9.0f, 1, 6, "2 4 6 8"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double ticks[6];
        char text[128] = "";
        const uint32_t count =
            cgt_overlay_ticks((double)rows[i].min, (double)rows[i].max, rows[i].logarithmic, ticks, rows[i].most);
        for (uint32_t k = 0; k < count; k++)
            snprintf(text + strlen(text), sizeof text - strlen(text), k ? " %s" : "%s", cgt_number(6, ticks[k]).text);
        assert_string_equal(text, rows[i].ticks);
    }
}

TEST(times_replace_their_names)
{
    overlay_frame f = {.number = 7, .step = -1200, .time = 0.5};
    char text[64], little[6];
    cgt_overlay_format("t = {time} ps, {step}/{frame} {other}", &f, text, sizeof text);
    assert_string_equal(text, "t = 0.5 ps, -1200/7 {other}");
    f.time = NAN;
    cgt_overlay_format("{time} ps, {time:.2f} ps, {step}", &f, text, sizeof text);
    assert_string_equal(text, "- ps, - ps, -1200");
    f.time = 12.0;
    cgt_overlay_format("{time:.2f} {time:.0f} {time:.f} {time:.12f}", &f, text, sizeof text);
    assert_string_equal(text, "12.00 12 {time:.f} {time:.12f}");
    f.time = -1e300;
    cgt_overlay_format("{time:.9f}", &f, text, sizeof text);
    assert_string_equal(text, "-1e+300");
    cgt_overlay_format("{step}{step}", &f, little, sizeof little); /* cut */
    assert_string_equal(little, "-1200");
}

/* Times and labels: no two frames of a run are alike, and no digits are noise of a float. */
TEST(numbers_are_as_long_as_they_need)
{
    static const struct {
        double value;
        const char *text;
    } rows[] = {
        {0.0, "0"},
        {-0.0, "0"},
        {-7.0, "-7"},
        {1000000.0, "1000000"},
        {1000500.0, "1000500"},
        {123456789012.0, "123456789012"},
        {0.1, "0.1"},
        {3.0 * 0.1, "0.3"},
        {(double)0.1f, "0.1"},
        {100000.002, "100000.002"},
        {1000000.002, "1000000.002"},
        {100000.1015625, "100000.1"}, /* floats */
        {100000.203125, "100000.2"},
        {1234567.5, "1234567.5"},
        {1.0 / 3.0, "0.333333"},
        {(double)(1.0f / 3.0f), "0.333333"},
        {48.8882129084, "48.8882"},
        {48888.2129084123, "48888.213"},
        {4888821.29084123, "4888821.291"},
        {1.5e-9, "1.5e-09"},
        {2.5e20, "2.5e+20"},
        {1e300, "1e+300"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        assert_string_equal(cgt_number_shortest(rows[i].value).text, rows[i].text);
    assert_string_equal(cgt_number_shortest((double)INFINITY).text, "inf");
    for (int i = 1; i < 1000; i++) { /* 2 fs a frame, after 100 ns */
        const overlay_frame before = {.time = 1e5 + 0.002 * (i - 1)}, frame = {.time = 1e5 + 0.002 * i};
        char last[64], text[64];
        cgt_overlay_format("{time}", &before, last, sizeof last);
        cgt_overlay_format("{time}", &frame, text, sizeof text);
        assert_string_not_equal(text, last);
    }
}

static void place_and_draw(overlay *o, const canvas *c, const overlay_frame *f)
{
    cgt_overlay_place(o, WIDTH, HEIGHT);
    cgt_overlay_draw(o, c, f);
}

static overlay make_overlay(coloring *k)
{
    assert_int_equal(cgt_coloring_init(k, COLORING_VALUE, NULL, 0.0f, 1.0f), 0);
    return (overlay){.size = 10.0f, .color = {1.0f, 1.0f, 1.0f}, .coloring = k};
}

TEST(the_bar_shows_the_map)
{
    static coloring k;
    const canvas c = make_canvas(0);
    const overlay_frame f = {.number = 0};
    overlay o = make_overlay(&k);
    o.bar = "";
    place_and_draw(&o, &c, &f);
    /* From a quarter of the height to three, 5.5 sizes from the right: viridis' yellow above, its violet below. */
    const uint8_t *above = pixel(WIDTH - 50, HEIGHT / 4 + 1), *below = pixel(WIDTH - 50, 3 * HEIGHT / 4 - 2);
    assert_true(above[0] > 240 && above[1] > 220 && above[2] < 60);
    assert_true(below[0] > 60 && below[0] < 75 && below[1] < 10 && below[2] > 75);
    assert_int_equal(drawn(0, 0, WIDTH - 60, HEIGHT), 0);
    assert_int_equal(drawn(0, 0, WIDTH, HEIGHT / 4 - 2), 0);
    cgt_coloring_free(&k);
}

TEST(the_legend_has_a_line_for_each_kind)
{
    static coloring k;
    static overlay_kind kinds[30] = {{{0.0f, 0.0f, 1.0f}, "C"}, {{1.0f, 0.0f, 0.0f}, "oxygen"}};
    char error[256];
    canvas c = make_canvas(0);
    const overlay_frame f = {.number = 0};
    overlay o = make_overlay(&k);
    o.legend = "";
    o.kinds = kinds;
    o.kind_count = 2;
    place_and_draw(&o, &c, &f);
    /* Without a font: swatches of 10 pixels, 14.5 apart around the middle, 9 pixels from the edge. */
    const int x = WIDTH - 9 - 13 + 5;
    assert_true(pixel(x, HEIGHT / 2 - 7)[2] == 255 && pixel(x, HEIGHT / 2 - 7)[0] == 0);
    assert_true(pixel(x, HEIGHT / 2 + 7)[0] == 255 && pixel(x, HEIGHT / 2 + 7)[2] == 0);
    assert_int_equal(drawn(0, 0, x - 6, HEIGHT), 0);
    assert_int_equal(drawn(0, 0, WIDTH, HEIGHT / 2 - 14), 0);
    assert_in_range(drawn(x - 6, 0, WIDTH, HEIGHT), 130, 210);
    o.font = cgt_text_open(NULL, o.size, error, sizeof error);
    if (o.font) { /* names to the right of the swatches, which make room; a title above */
        c = make_canvas(0);
        o.legend = "kinds";
        place_and_draw(&o, &c, &f);
        const int left = (int)((float)WIDTH - 9.0f - 13.5f - cgt_text_width(o.font, "oxygen"));
        assert_true(drawn(left + 13, HEIGHT / 2 + 2, WIDTH - 8, HEIGHT / 2 + 24) > 40);
        assert_true(drawn(left, HEIGHT / 2 - 24, left + 40, HEIGHT / 2 - 10) > 40);
        assert_int_equal(drawn(0, 0, left - 1, HEIGHT), 0);
        o.kind_count = 30; /* more than there is room for */
        place_and_draw(&o, &c, &f);
        cgt_text_close(o.font);
    }
    cgt_coloring_free(&k);
}

TEST(axes_point_as_the_camera_sees_them)
{
    static coloring k;
    const canvas c = make_canvas(0);
    const overlay_frame f = {.right = {1, 0, 0}, .up = {0, 0, 1}, .forward = {0, 1, 0}}; /* from the front: y away */
    overlay o = make_overlay(&k);
    o.axes = 1;
    place_and_draw(&o, &c, &f);
    const int x = 34, y = HEIGHT - 34;                                  /* the origin: 3.4 sizes */
    assert_true(pixel(x + 15, y)[0] > 150 && pixel(x + 15, y)[2] < 60); /* x is red, to the right */
    assert_true(pixel(x, y - 15)[2] > 150 && pixel(x, y - 15)[0] < 60); /* z is blue, up */
    assert_int_equal(drawn(x - 20, y - 2, x - 4, y + 2), 0);
    cgt_coloring_free(&k);
}

TEST(texts_are_drawn_where_there_is_a_font)
{
    static coloring k;
    char error[256] = "";
    assert_null(cgt_text_open("/no/such/font.ttf", 12.0f, error, sizeof error));
    assert_true(*error);
    overlay o = make_overlay(&k);
    o.font = cgt_text_open(NULL, o.size, error, sizeof error);
    if (!o.font) {
        print_message("%s\n", error);
        cgt_coloring_free(&k);
        skip();
    }
    const canvas c = make_canvas(0);
    const overlay_frame f = {.time = 2.5};
    o.title = "A title";
    o.time = "t = {time}";
    place_and_draw(&o, &c, &f);
    const float width = cgt_text_width(o.font, o.title);
    assert_true(width > 20.0f && width < 60.0f);
    assert_true(drawn((int)(0.5f * (WIDTH - width)), 5, (int)(0.5f * (WIDTH + width)), 22) > 40);
    assert_int_equal(drawn(0, 0, (int)(0.5f * (WIDTH - width)) - 2, 30), 0);
    assert_true(drawn(5, HEIGHT - 22, 60, HEIGHT - 4) > 30);
    assert_int_equal(drawn(80, HEIGHT - 30, WIDTH, HEIGHT), 0);
    /* Accents are one character; bytes that are no UTF-8 are drawn as unknown ones, and do no harm. */
    assert_true(fabsf(cgt_text_width(o.font, "\xc3\xa9") - cgt_text_width(o.font, "e")) < 2.0f);
    assert_true(cgt_text_width(o.font, "\xff\xc3") > 0.0f);
    cgt_text_draw(o.font, &c, 1e4f, -1e4f, "outside \xe2\x82", white);
    /* what no font has, each once; nothing of Latin, Greek and units */
    char missing[12] = "";
    assert_int_equal(cgt_text_find_missing(o.font, "\xc3\x85, \xc2\xb5, \xce\xb1 \xe2\x86\x92 100 \xc2\xb0", missing,
                                           sizeof missing),
                     0);
    assert_int_equal(cgt_text_find_missing(o.font, "\xe2\xbf\xa0\xe2\xbf\xa1 T \xe2\xbf\xa0", missing, sizeof missing),
                     0x2fe0);
    assert_string_equal(missing, "\xe2\xbf\xa0\xe2\xbf\xa1");
    assert_int_equal(cgt_text_find_missing(o.font, "\xe2\xbf\xa1", missing, sizeof missing), 0);
    cgt_text_find_missing(o.font, "\xe2\xbf\xa2\xe2\xbf\xa3\xe2\xbf\xa4", missing,
                          sizeof missing); /* as far as there is room */
    assert_int_equal(strlen(missing), 9);
    cgt_text_close(o.font);
    cgt_coloring_free(&k);
}

/* DejaVu Sans Mono has no Hebrew, DejaVu Sans has: it is drawn in another font where fontconfig finds one, else told.
 * What the font has itself is its own. */
TEST(other_fonts_have_what_one_lacks)
{
    static const char alef[] = "\xd7\x90";
    static uint8_t box[sizeof rgb];
    char error[256], missing[12] = "";
    text_font *const font =
        cgt_text_open("/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf", 40.0f, error, sizeof error);
    if (!font) {
        print_message("%s\n", error);
        skip();
    }
    canvas c = make_canvas(0);
    cgt_text_draw(font, &c, 20.0f, 100.0f, "\xe2\xbf\xa0", white); /* which no font has */
    memcpy(box, rgb, sizeof rgb);
    assert_true(drawn(20, 50, 80, 120) > 50);
    c = make_canvas(0);
    cgt_text_draw(font, &c, 20.0f, 100.0f, alef, white);
    assert_true(drawn(20, 50, 80, 120) > 50);
#ifdef CGT_HAVE_FONTCONFIG
    assert_int_equal(cgt_text_find_missing(font, alef, missing, sizeof missing), 0);
    assert_memory_not_equal(rgb, box, sizeof rgb);
#else
    assert_int_equal(cgt_text_find_missing(font, alef, missing, sizeof missing), 0x5d0);
    assert_memory_equal(rgb, box, sizeof rgb);
#endif
    const float width = cgt_text_width(font, alef);
    cgt_text_set_size(font, 20.0f); /* of all fonts */
    assert_true(fabsf(cgt_text_width(font, alef) - 0.5f * width) < 1.5f);
    assert_true(fabsf(cgt_text_width(font, "i") - cgt_text_width(font, "M")) < 0.01f);
    cgt_text_close(font);
}

SUITE(NULL, NULL)

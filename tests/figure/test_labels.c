/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scale bars and labels of spheres: how long, what they say, and where they are seen. */
#include "support/suite.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/figure.h>

#include "data/expression/label_rules.h"
#include "options/figure_values.h"
#include "text/labels.h"

/* ---- Scale bars ----------------------------------------------------------------------------------------------- */

TEST(scale_bars_are_round)
{
    static const struct {
        double length;
        const char *unit;
        double pixel, angstrom;
        float most;
        const char *label; /* NULL: there is no bar */
        double pixels;
    } rows[] = {{0, "", 0.05, 0, 160, "5", 100},
                {0, "", 0.05, 0, 199, "5", 100},
                {0, "", 0.05, 0, 200, "10", 200},
                {0, "", 0.05, 1.0, 160, "5 \xc3\x85", 100},
                {0, "", 0.05, (double)0.1f, 160, "5 nm", 100},
                {0, "nm", 0.05, 1.0, 160, "0.5 nm", 100},
                {0, "pm", 0.05, (double)0.1f, 160, "5000 pm", 100},
                {0, "nm", 0.05, 0, 160, "5 nm", 100},
                {0, "furlong", 0.05, 1.0, 160, "5 furlong", 100},
                {0, "", 3e-9, 0, 100, "2e-07", 66.6667},
                {0, "", 2e20, 0, 100, "2e+22", 100},
                {3, "", 0.05, 1.0, 160, "3 \xc3\x85", 60},
                {1, "nm", 0.1, 1.0, 160, "1 nm", 100},
                {1, "angstrom", 0.05, (double)0.1f, 160, "1 angstrom", 2},
                {1, "NM", 0.1, 1.0, 160, "1 NM", 100},
                {1, "cm", 1e6, 1.0, 160, "1 cm", 100},
                {1, "fm", 1e-7, 1.0, 160, "1 fm", 100},
                {1e-9, "m", 0.1, 1.0, 160, "1e-09 m", 100},
                {7.25, "m", 0.1, 0, 160, "7.25 m", 72.5},
                {9, "", 0.05, 0, 160, NULL, 0},
                {0.05, "", 0.05, 0, 160, NULL, 0}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        scale_bar bar = {1, rows[i].length, ""};
        char label[SCALE_BAR_LABEL] = "";
        float length = 0.0f;
        strcpy(bar.unit, rows[i].unit);
        const int result = cgt_scale_bar_find(&bar, rows[i].pixel, rows[i].angstrom, rows[i].most, &length, label);
        if (result != (rows[i].label ? 0 : -1) || (rows[i].label && strcmp(label, rows[i].label) != 0) ||
            (rows[i].label && fabs((double)length - rows[i].pixels) > 0.01))
            fail_msg("row %zu: %d, \"%s\", %g pixels", i, result, label, (double)length);
    }
}

TEST(scale_bars_are_read)
{
    static const struct {
        const char *text;
        double length;
        const char *unit; /* NULL: refused */
    } rows[] = {{"", 0, ""},
                {"nm", 0, "nm"},
                {"10", 10, ""},
                {"2.5,nm", 2.5, "nm"},
                {".5", 0.5, ""},
                {"0", 0, NULL},
                {"-1,nm", 0, NULL},
                {"10,", 0, NULL},
                {"x,nm", 0, NULL},
                {"10nm", 0, NULL},
                {"inf", 0, "inf"},
                {"1e999", 0, NULL},
                {"a unit that is much too long", 0, NULL}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        scale_bar bar = {0};
        char error[200] = "";
        const int result = cgt_parse_scale_bar(rows[i].text, &bar, error, sizeof error);
        if (result != (rows[i].unit ? 0 : -1) || (result && !*error))
            fail_msg("\"%s\": %d, \"%s\"", rows[i].text, result, error);
        if (rows[i].unit && (!bar.is_set || bar.length != rows[i].length || strcmp(bar.unit, rows[i].unit) != 0))
            fail_msg("\"%s\": %g \"%s\"", rows[i].text, bar.length, bar.unit);
    }
}

/* ---- What labels say ------------------------------------------------------------------------------------------ */

enum { SPHERES = 1000 };
static float xyzr[4 * SPHERES], charge[SPHERES], names[SPHERES];
static uint8_t elements[SPHERES];
static uint32_t ids[SPHERES];

/* A frame with words, elements and numbers. */
static cgt_trajectory_frame make_frame(void)
{
    static const char words[2][64] = {"CA", "a word of many letters, so that labels of it are cut"};
    static const cgt_trajectory_column columns[] = {
        {"q", CGT_TRAJECTORY_NUMBER, charge, 0, NULL},
        {"name", CGT_TRAJECTORY_WORD, names, 2, (char(*)[64])(void *)words}};
    for (int i = 0; i < SPHERES; i++) {
        xyzr[4 * i] = (float)i;
        xyzr[4 * i + 3] = i == 3 ? -1.0f : 0.5f;
        charge[i] = 0.25f * (float)i;
        names[i] = (float)(i % 3); /* none, CA, the other one */
        elements[i] = (uint8_t)(i % 9);
        ids[i] = 7000000u + (uint32_t)i;
    }
    return (cgt_trajectory_frame){.kind = CGT_TRAJECTORY_SPHERES,
                                  .count = SPHERES,
                                  .xyzr = xyzr,
                                  .id = ids,
                                  .element = elements,
                                  .columns = 2,
                                  .column = columns,
                                  .time = NAN};
}

static void apply(const char *which, const char *text, const char *show, label_list *labels)
{
    const cgt_trajectory_frame frame = make_frame();
    label_rules rules = {.is_id = !text};
    particle_rules drawn = {.radius_scale = 1.0f, .images = {1, 1, 1}};
    char error[300] = "";
    rules.which = cgt_expression_parse(which, error, sizeof error);
    expression *const shown = show ? cgt_expression_parse(show, error, sizeof error) : NULL;
    drawn.show = shown;
    assert_true(rules.which && (!show || shown));
    assert_int_equal(text ? cgt_label_rules_split(&rules, text, error, sizeof error) : 0, 0);
    for (uint32_t i = 0; i < rules.parts; i++)
        assert_int_equal(cgt_expression_bind(rules.part[i].value, &frame, NULL, error, sizeof error), 0);
    assert_int_equal(cgt_expression_bind(rules.which, &frame, NULL, error, sizeof error), 0);
    assert_true(!shown || cgt_expression_bind(shown, &frame, NULL, error, sizeof error) == 0);
    assert_int_equal(cgt_label_rules_apply(&rules, &drawn, &frame, labels), 0);
    cgt_label_rules_free(&rules);
    cgt_expression_free(shown);
}

TEST(labels_say_what_columns_have)
{
    label_list labels = {NULL, 0, 0};
    apply("index == 1", "{name}{element}: {q} e, {id}{q*4+0.125}!", NULL, &labels);
    assert_int_equal(labels.count, 1);
    assert_string_equal(labels.list[0].text, "CAH: 0.25 e, 70000011.125!");
    assert_true(labels.list[0].place[0] == 1.0f && labels.list[0].radius == 0.5f);
    apply("index == 1", "{q*4-2/3} {12345.678} {1234567.5} {123456.75} {id*1000}", NULL, &labels);
    assert_string_equal(labels.list[0].text, "0.333333 12345.7 1234567.5 123456.75 7000001000");
    apply("index < 3", NULL, NULL, &labels);
    assert_int_equal(labels.count, 3);
    assert_string_equal(labels.list[2].text, "7000002");
    apply("index < 9", "here", "index > 1", &labels); /* those that are drawn: 3 has no radius */
    assert_int_equal(labels.count, 6);
    apply("index == 0", "{name}{element}", NULL, &labels);
    assert_string_equal(labels.list[0].text, "");
    apply("index == 2", "{name}{name}{name}", NULL, &labels); /* as far as there is room */
    assert_int_equal(strlen(labels.list[0].text), LABEL_SIZE - 1);
    apply("index > 3", "x", NULL, &labels);
    assert_int_equal(labels.count, LABELS_MOST);
    assert_int_equal(labels.matched, SPHERES - 4);
    free(labels.list);
}

TEST(texts_of_labels_are_checked)
{
    static const char *const wrong[] = {
        "{name",       "{q+}",
        "{}",          "{q}{q}{q}{q}{q}{q}",
        "{chain == }", "a text that is longer than all that a label has room for, by far, with no end"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        label_rules rules = {.which = NULL};
        char error[300] = "";
        if (cgt_label_rules_split(&rules, wrong[i], error, sizeof error) != -1 || !*error)
            fail_msg("\"%s\" is taken", wrong[i]);
        cgt_label_rules_free(&rules);
    }
}

/* ---- Where they are ------------------------------------------------------------------------------------------- */

enum { WIDTH = 240, HEIGHT = 200, BYTES = 3 * WIDTH * HEIGHT };
static uint8_t rgb[BYTES];

/* Many in one place: the nearest at it, others beside it, and none over another one or the title. */
TEST(labels_do_not_overlap)
{
    char error[256];
    overlay o = {.size = 12.0f, .color = {1.0f, 1.0f, 1.0f}, .title = "A title"};
    text_label labels[40];
    const canvas c = {WIDTH, HEIGHT, {.bytes = rgb}};
    o.font = cgt_text_open(NULL, o.size, error, sizeof error);
    if (!o.font)
        skip();
    cgt_overlay_place(&o, WIDTH, HEIGHT);
    memset(rgb, 0, sizeof rgb);
    for (int i = 0; i < 40; i++)
        labels[i] = (text_label){100.0f, 100.0f, 24.0f, 40.0f - (float)i, "label"};
    labels[3].x = -5.0f; /* not in the picture, which is no fault */
    assert_int_equal(cgt_labels_draw(&o, &c, labels, 40), 39 - 5);
    assert_true(labels[0].depth == 1.0f);
    for (int i = 0; i < 2; i++)
        labels[i] = (text_label){0.5f * WIDTH, 15.0f, 0.0f, 1.0f + (float)i, "MMMM"}; /* at the title: below it */
    uint8_t before[BYTES];
    memcpy(before, rgb, sizeof rgb);
    cgt_labels_draw(&o, &c, labels, 2);
    const layout_rect *const title = &o.layout.rect[LAYOUT_TITLE];
    for (int y = (int)title->y0 + 1; y < (int)title->y1; y++)
        for (int x = (int)title->x0 + 1; x < (int)title->x1; x++)
            assert_int_equal(rgb[3 * (y * WIDTH + x)], before[3 * (y * WIDTH + x)]);
    cgt_text_close(o.font);
}

/* ---- In pictures ---------------------------------------------------------------------------------------------- */

static const float places[2][3] = {{0, 0, 0}, {2, 1, -3}};
static const uint32_t numbers[2] = {8, 88};

static int draw(cgt_figure *figure, uint8_t *to)
{
    const cgt_figure_column columns[] = {{.name = "id", .values = cgt_uint32s(numbers, 0)}};
    const cgt_figure_data data = {.points = {2, cgt_floats(places[0], 0), columns, 1, 0.4f}};
    const cgt_image image = {.bytes = to};
    return cgt_figure_show(figure, &data) || cgt_figure_draw(figure, &image, NULL) ? -1 : 0;
}

/* Where two pictures differ. */
static layout_rect find_changes(const uint8_t *a, const uint8_t *b)
{
    layout_rect r = {WIDTH, HEIGHT, 0, 0};
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        if (memcmp(a + 3 * i, b + 3 * i, 3) != 0) {
            const float x = (float)(i % WIDTH), y = (float)(i / WIDTH);
            r = (layout_rect){fminf(r.x0, x), fminf(r.y0, y), fmaxf(r.x1, x + 1.0f), fmaxf(r.y1, y + 1.0f)};
        }
    return r;
}

/* The camera shows 2 * 20 * tan(15 degrees) = 10.718 at its target over 200 pixels: a length of 2 has 37.3. A sphere is
 * labelled where it is seen. */
TEST(pictures_have_bars_and_labels_in_place)
{
    static uint8_t without[BYTES], with[BYTES];
    cgt_context *context;
    assert_int_equal(cgt_context_create(NULL, &context), CGT_OK);
    for (int is_parallel = 0; is_parallel < 2; is_parallel++) {
        cgt_figure *figure;
        char error[512];
        assert_int_equal(cgt_figure_create(context, &figure), CGT_OK);
        assert_int_equal(cgt_figure_set(figure, "size", "240x200"), CGT_OK);
        assert_int_equal(cgt_figure_set(figure, "camera", "0,0,20,0,0,0,0,1,0,30"), CGT_OK);
        assert_int_equal(is_parallel ? cgt_figure_set(figure, "ortho", NULL) : CGT_OK, CGT_OK);
        assert_int_equal(draw(figure, without), 0);
        assert_int_equal(cgt_figure_set(figure, "scale-bar", NULL), CGT_OK);
        if (draw(figure, with)) { /* no font */
            cgt_figure_get_error_message(figure, error, sizeof error);
            print_message("%s\n", error);
            cgt_figure_release(figure);
            cgt_context_release(context);
            skip();
        }
        layout_rect r = find_changes(without, with);
        assert_true(fabsf(r.x1 - r.x0 - 37.32f) < 2.0f && r.x0 > 0.5f * WIDTH && r.y0 > 0.8f * HEIGHT);
        assert_int_equal(cgt_figure_set(figure, "scale-bar", "3,cm"), CGT_OK);
        assert_int_equal(draw(figure, with), 0);
        r = find_changes(without, with);
        assert_true(fabsf(r.x1 - r.x0 - 55.98f) < 2.0f);
        assert_int_equal(cgt_figure_set(figure, "scale-bar", "30"), CGT_OK);
        assert_int_equal(draw(figure, with), 0);
        assert_memory_equal(with, without, BYTES);
        const char *const notice = cgt_figure_take_notice(figure);
        assert_true(notice && strstr(notice, "--scale-bar: in frame 0 this length"));
        assert_int_equal(cgt_figure_unset(figure, "scale-bar"), CGT_OK);
        assert_int_equal(cgt_figure_set(figure, "label", "id > 9"), CGT_OK);
        assert_int_equal(draw(figure, with), 0);
        r = find_changes(without, with);
        const float scale = 100.0f / ((is_parallel ? 20.0f : 23.0f) * tanf(15.0f * 3.14159265f / 180.0f));
        assert_true(fabsf(0.5f * (r.x0 + r.x1) - 0.5f * WIDTH - 2.0f * scale) < 2.0f);
        assert_true(fabsf(0.5f * (r.y0 + r.y1) - 0.5f * HEIGHT + 1.0f * scale) < 2.0f);
        assert_int_equal(cgt_figure_set(figure, "label", "id < 9"), CGT_OK); /* one more */
        assert_int_equal(cgt_figure_set(figure, "label-text", "n{id}"), CGT_OK);
        assert_int_equal(draw(figure, with), 0);
        r = find_changes(without, with);
        assert_true(r.x0 < 0.5f * WIDTH && r.x1 > 0.5f * WIDTH + 1.8f * scale);
        assert_int_equal(cgt_figure_set(figure, "label-text", "{colour}"), CGT_OK);
        assert_int_equal(draw(figure, with), -1);
        cgt_figure_get_error_message(figure, error, sizeof error);
        assert_true(strstr(error, "no column \"colour\""));
        cgt_figure_release(figure);
    }
    cgt_context_release(context);
}

SUITE(NULL, NULL)

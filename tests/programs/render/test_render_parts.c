/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Parts of cgt-render: colours, names, contact sheets, progress. */
#define _POSIX_C_SOURCE 200809L
#include "color/srgb.h"
#include "support/suite.h"
#include "support/test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "color/coloring.h"
#include "picture/overlay/contact_sheet.h"
#include "common/out_path.h"
#include "common/program.h"
#include <cgt/picture.h>

/* ---- sRGB --------------------------------------------------------------------------------------------------- */

TEST(srgb_has_the_values_of_the_standard)
{
    assert_near(cgt_srgb_to_linear(0.5f), 0.21404114, 1e-6);
    assert_near(cgt_srgb_to_linear(0.02f), 0.02 / 12.92, 1e-8);
    assert_near(cgt_srgb_from_linear(0.18f), 0.46135613, 1e-6);
    assert_near(cgt_srgb_from_linear(0.002f), 0.02584, 1e-6);
    assert_true(cgt_srgb_to_linear(0.0f) == 0.0f && cgt_srgb_to_linear(1.0f) == 1.0f);
    assert_true(cgt_srgb_to_linear(-3.0f) == 0.0f && cgt_srgb_from_linear(7.0f) > 0.999f);
    assert_true(cgt_srgb_from_linear(NAN) == 0.0f);
}

TEST(srgb_tables_follow_the_curve)
{
    srgb_table table;
    cgt_srgb_table_init(&table);
    for (int i = 0; i < 256; i++)
        assert_int_equal(cgt_srgb_encode(cgt_srgb_decode((uint8_t)i)), i); /* every code survives the round trip */
    for (int i = -10; i <= 100010; i++) {
        const float x = (float)i / 100000.0f;
        assert_near(cgt_srgb_encode(x), cgt_srgb_from_linear(x) * 255.0f, 1.0);
        assert_int_equal(cgt_srgb_encode(x), srgb_encode(&table, x)); /* which pixels take */
    }
    assert_int_equal(cgt_srgb_encode(NAN), 0);
    assert_int_equal(cgt_srgb_encode(INFINITY), 255);
}

/* ---- Colours ------------------------------------------------------------------------------------------------ */

TEST(maps_are_the_published_ones)
{
    /* Entries 0, 64, 128, 191 and 255 of the 256 that matplotlib publishes, in 8 bits. */
    static const int at[5] = {0, 64, 128, 191, 255};
    static const uint8_t viridis[5][3] = {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {92, 200, 99}, {253, 231, 37}};
    static const uint8_t plasma[5][3] = {{13, 8, 135}, {126, 3, 168}, {204, 71, 120}, {248, 148, 65}, {240, 249, 33}};
    static const uint8_t batlow[5][3] = {
        {1, 25, 89}, {34, 96, 97}, {130, 130, 49}, {241, 157, 107}, {250, 204, 250}}; /* as GMT has it */
    float c[3];
    for (int i = 0; i < 5; i++)
        for (int k = 0; k < 3; k++) {
            cgt_get_map_color(cgt_find_colormap("viridis"), (float)at[i] / 255.0f, c);
            assert_near(c[k] * 255.0f, viridis[i][k], 1.5);
            cgt_get_map_color(cgt_find_colormap("plasma"), (float)at[i] / 255.0f, c);
            assert_near(c[k] * 255.0f, plasma[i][k], 2.6);
            cgt_get_map_color(cgt_find_colormap("batlow"), (float)at[i] / 255.0f, c);
            assert_near(c[k] * 255.0f, batlow[i][k], 1.5);
        }
    assert_null(cgt_find_colormap("rainbow"));
}

TEST(maps_are_continuous_and_clamp)
{
    for (const char *const *name = cgt_get_colormap_names(); *name; name++) {
        const cgt_colormap *map = cgt_find_colormap(*name);
        float last[3], c[3];
        assert_non_null(map);
        cgt_get_map_color(map, 0.0f, last);
        cgt_get_map_color(map, NAN, c);
        assert_memory_equal(c, last, sizeof c);
        cgt_get_map_color(map, -1.0f, c);
        assert_memory_equal(c, last, sizeof c);
        for (int i = 1; i <= 2000; i++) {
            cgt_get_map_color(map, (float)i / 2000.0f, c);
            for (int k = 0; k < 3; k++)
                assert_near(c[k], last[k], 0.004);
            memcpy(last, c, sizeof last);
        }
        cgt_get_map_color(map, INFINITY, c);
        assert_memory_equal(c, last, sizeof c);
    }
}

TEST(maps_diverge_close_and_turn_round)
{
    static const char *const diverging[] = {"coolwarm", "vik", "berlin"}, *const cyclic[] = {"romaO", "vikO"};
    float a[3], b[3], middle[3];
    for (size_t i = 0; i < TEST_COUNT(diverging); i++) {
        const cgt_colormap *map = cgt_find_colormap(diverging[i]);
        cgt_get_map_color(map, 0.0f, a);
        cgt_get_map_color(map, 1.0f, b);
        cgt_get_map_color(map, 0.5f, middle);
        assert_true(a[2] > a[0] + 0.2f && b[0] > b[2] + 0.2f); /* blue to red */
        assert_near(middle[0], middle[1], 0.05);
        assert_near(middle[2], middle[1], 0.05);
    }
    cgt_get_map_color(cgt_find_colormap("coolwarm"), 0.5f, middle); /* Moreland's table: 221, 221, 221 */
    for (int k = 0; k < 3; k++)
        assert_near(middle[k] * 255.0f, 221.0, 3.0);
    for (size_t i = 0; i < TEST_COUNT(cyclic); i++) {
        cgt_get_map_color(cgt_find_colormap(cyclic[i]), 0.0f, a);
        cgt_get_map_color(cgt_find_colormap(cyclic[i]), 1.0f, b);
        for (int k = 0; k < 3; k++)
            assert_near(a[k], b[k], 0.02);
    }
    for (const char *const *name = cgt_get_colormap_names(); *name; name++) {
        char reversed[40];
        snprintf(reversed, sizeof reversed, "%s_r", *name);
        assert_non_null(cgt_find_colormap(reversed));
        for (int i = 0; i <= 64; i++) {
            cgt_get_map_color(cgt_find_colormap(*name), (float)i / 64.0f, a);
            cgt_get_map_color(cgt_find_colormap(reversed), 1.0f - (float)i / 64.0f, b);
            for (int k = 0; k < 3; k++)
                assert_near(a[k], b[k], 1e-5);
        }
    }
    assert_null(cgt_find_colormap("vik_"));
    assert_null(cgt_find_colormap("vik_r_r"));
    assert_null(cgt_find_colormap("_r"));
}

/* Larger values are brighter: the lightness of viridis rises monotonically, so that it reads well in grey. */
TEST(viridis_rises_in_lightness)
{
    float last = -1.0f;
    for (int i = 0; i <= 100; i++) {
        float c[3];
        cgt_get_map_color(cgt_find_colormap("viridis"), (float)i / 100.0f, c);
        const float y = 0.2126f * cgt_srgb_to_linear(c[0]) + 0.7152f * cgt_srgb_to_linear(c[1]) +
                        0.0722f * cgt_srgb_to_linear(c[2]);
        assert_true(y > last);
        last = y;
    }
}

TEST(kinds_differ_and_repeat)
{
    float a[3], b[3];
    for (uint32_t i = 1; i <= 16; i++) {
        cgt_get_type_color(i, a);
        for (uint32_t j = i + 1; j <= 16; j++) {
            cgt_get_type_color(j, b);
            assert_true(fabsf(a[0] - b[0]) + fabsf(a[1] - b[1]) + fabsf(a[2] - b[2]) > 0.2f);
        }
        cgt_get_type_color(i + 16, b);
        assert_memory_equal(a, b, sizeof a);
    }
    cgt_get_type_color(1, a);
    assert_near(a[0] * 255.0f, 230.0, 0.01); /* Okabe and Ito's orange */
    assert_near(a[1] * 255.0f, 159.0, 0.01);
    cgt_get_type_color(0, a); /* any number is valid */
    cgt_get_type_color(UINT32_MAX, a);
}

TEST(values_find_their_entries)
{
    const float xyzr[20] = {0}, speeds[5] = {1.0f, 3.0f, 2.0f, NAN, 9.0f};
    const uint32_t ids[5] = {10, 20, 4000000000u, 15, 0}, types[5] = {1, 2, 17, 0, 16};
    const cgt_trajectory_frame frame = {.count = 5, .xyzr = xyzr, .id = ids, .type = types};
    coloring c;
    assert_int_equal(cgt_coloring_init(&c, COLORING_SPEED, NULL, 1.0f, 3.0f), 0);
    assert_int_equal(cgt_coloring_apply(&c, &frame, speeds), 0);
    assert_int_equal(c.index[0], 0);
    assert_int_equal(c.index[1], COLORING_STEPS - 1);
    assert_near(c.index[2], (COLORING_STEPS - 1) / 2.0, 0.51);
    assert_int_equal(c.index[3], COLORING_UNKNOWN);
    assert_int_equal(c.index[4], COLORING_STEPS - 1);
    cgt_coloring_free(&c);
    assert_int_equal(cgt_coloring_init(&c, COLORING_ID, NULL, 10.0f, 20.0f), 0);
    assert_int_equal(cgt_coloring_apply(&c, &frame, NULL), 0);
    assert_int_equal(c.index[0], 0);
    assert_int_equal(c.index[2], COLORING_STEPS - 1);
    assert_int_equal(c.index[4], 0);
    cgt_coloring_free(&c);
    assert_int_equal(cgt_coloring_init(&c, COLORING_ID, NULL, 7.0f, 7.0f), 0); /* one value only: no division by zero */
    assert_int_equal(cgt_coloring_apply(&c, &frame, NULL), 0);
    assert_int_equal(c.index[1], 0);
    cgt_coloring_free(&c);
    assert_int_equal(cgt_coloring_init(&c, COLORING_TYPE, NULL, 0.0f, 0.0f), 0);
    assert_int_equal(cgt_coloring_apply(&c, &frame, NULL), 0);
    assert_memory_equal(c.palette[c.index[0]], c.palette[c.index[2]], sizeof c.palette[0]); /* 1 and 17 */
    assert_memory_equal(c.palette[c.index[3]], c.palette[c.index[4]], sizeof c.palette[0]); /* 0 and 16 */
    assert_memory_not_equal(c.palette[c.index[0]], c.palette[c.index[1]], sizeof c.palette[0]);
    cgt_coloring_free(&c);
}

/* Words are named in the order of the data, those without one last; numbers in their own. */
TEST(categories_are_sorted)
{
    static const char words[3][64] = {"B", "A", "C"};
    static const float value[6] = {3, 0, 1, 2, 2, 0}, number[6] = {7, -2, 7, 0, 40, -2};
    const cgt_trajectory_column column[2] = {{"chain", CGT_TRAJECTORY_WORD, value, 3, words},
                                             {"mol", CGT_TRAJECTORY_WHOLE, number, 0, NULL}};
    const float xyzr[24] = {0};
    const cgt_trajectory_frame frame = {.count = 6, .xyzr = xyzr, .columns = 2, .column = column};
    static const struct {
        const char *formula, *show, *sorted;
    } rows[] = {{"chain", NULL, "B A C none "},
                {"chain", "chain != A", "B C none "},
                {"mol", NULL, "-2 0 7 40 "},
                {"mol", "mol > 40", ""}};
    for (size_t i = 0; i < TEST_COUNT(rows); i++) {
        char error[200], name[64], all[200] = "";
        categories c = {.takes_numbers = 1};
        expression *const e = cgt_expression_parse(rows[i].formula, error, sizeof error);
        expression *const show = rows[i].show ? cgt_expression_parse(rows[i].show, error, sizeof error) : NULL;
        assert_int_equal(cgt_expression_bind(e, &frame, NULL, error, sizeof error), 0);
        assert_true(!show || cgt_expression_bind(show, &frame, NULL, error, sizeof error) == 0);
        cgt_categories_take(&c, e, &frame);
        cgt_categories_look(&c, e, show, frame.count);
        int64_t *const sorted = cgt_categories_sort(&c);
        for (size_t k = 0; k < c.shown.count; k++) {
            cgt_categories_name(&c, sorted[k], name, sizeof name);
            strcat(strcat(all, name), " ");
        }
        assert_string_equal(all, rows[i].sorted);
        free(sorted);
        cgt_categories_free(&c);
        cgt_expression_free(e);
        cgt_expression_free(show);
    }
}

/* More than any table begins with. */
TEST(categories_may_be_many)
{
    enum { MANY = 5000 };
    static char words[MANY][64];
    static float value[MANY], xyzr[4 * MANY];
    char error[200];
    for (uint32_t i = 0; i < MANY; i++) {
        snprintf(words[i], sizeof words[i], "w%u", (unsigned)(i * 7919 % MANY));
        value[i] = (float)(i + 1);
    }
    const cgt_trajectory_column column = {"word", CGT_TRAJECTORY_WORD, value, MANY, (const char(*)[64])words};
    const cgt_trajectory_frame frame = {.count = MANY, .xyzr = xyzr, .columns = 1, .column = &column};
    categories c = {.takes_numbers = 0};
    expression *const e = cgt_expression_parse("word", error, sizeof error);
    int64_t number;
    assert_int_equal(cgt_expression_bind(e, &frame, NULL, error, sizeof error), 0);
    cgt_categories_take(&c, e, &frame);
    cgt_categories_take(&c, e, &frame);
    cgt_categories_look(&c, e, NULL, frame.count);
    assert_true(!c.failed && c.words == MANY && c.shown.count == MANY);
    for (uint32_t i = 0; i < MANY; i++) {
        assert_int_equal(cgt_categories_find(&c, words[i], strlen(words[i]), &number), 0);
        assert_int_equal(number, i + 1);
    }
    assert_int_equal(cgt_categories_find(&c, "w", 1, &number), -1);
    cgt_categories_free(&c);
    cgt_expression_free(e);
}

/* Height is that of a sphere's centre, or of each vertex; ids and types are the triangles', of which there are two. */
TEST(triangles_find_their_entries)
{
    const float xyzr[8] = {9, 0, 9, 1, 0, 9, 0, 1};
    const float position[12] = {0, -1, 0, 1, 0, 0, 0, 3, 0, 5, NAN, 5}, speeds[4] = {0, 1, 3, NAN};
    const uint32_t index[6] = {0, 1, 2, 1, 2, 3}, types[2] = {1, 2};
    const cgt_trajectory_frame spheres = {.count = 2, .xyzr = xyzr};
    const cgt_trajectory_frame frame = {.kind = CGT_TRAJECTORY_TRIANGLES,
                                        .count = 4,
                                        .triangles = 2,
                                        .index = index,
                                        .position = position,
                                        .type = types};
    coloring c;
    assert_int_equal(cgt_coloring_init(&c, COLORING_HEIGHT, NULL, -1.0f, 3.0f), 0);
    c.axis = 1;
    assert_int_equal(cgt_coloring_apply(&c, &frame, NULL), 0);
    assert_true(c.per_vertex);
    assert_int_equal(c.index[0], 0);
    assert_near(c.index[1], (COLORING_STEPS - 1) / 4.0, 0.51);
    assert_int_equal(c.index[2], COLORING_STEPS - 1);
    assert_int_equal(c.index[3], COLORING_UNKNOWN);
    assert_int_equal(cgt_coloring_apply(&c, &spheres, NULL), 0);
    assert_false(c.per_vertex);
    assert_near(c.index[0], (COLORING_STEPS - 1) / 4.0, 0.51);
    assert_int_equal(c.index[1], COLORING_STEPS - 1);
    cgt_coloring_free(&c);
    assert_int_equal(cgt_coloring_init(&c, COLORING_SPEED, NULL, 0.0f, 3.0f), 0);
    assert_int_equal(cgt_coloring_apply(&c, &frame, speeds), 0);
    assert_true(c.per_vertex && c.index[2] == COLORING_STEPS - 1 && c.index[3] == COLORING_UNKNOWN);
    cgt_coloring_free(&c);
    assert_int_equal(cgt_coloring_init(&c, COLORING_TYPE, NULL, 0.0f, 0.0f), 0);
    assert_int_equal(cgt_coloring_apply(&c, &frame, NULL), 0);
    assert_true(!c.per_vertex && c.index[0] == 0 && c.index[1] == 1);
    cgt_coloring_free(&c);
    assert_int_equal(cgt_coloring_init_plain(&c, (const float[]){0.5f, 1.0f, 0.0f}), 0);
    assert_int_equal(cgt_coloring_apply(&c, &frame, NULL), 0);
    assert_true(!c.per_vertex && c.index[0] == 0 && c.index[1] == 0);
    assert_near(c.palette[0][0], 0.21404114, 1e-6);
    assert_true(c.palette[0][1] == 1.0f && c.palette[0][2] == 0.0f);
    cgt_coloring_free(&c);
}

/* ---- Names -------------------------------------------------------------------------------------------------- */

static void check_name(const char *pattern, uint64_t number, const char *expected)
{
    char error[200], name[64];
    out_path path;
    assert_int_equal(out_path_parse(&path, pattern, error, sizeof error), 0);
    assert_int_equal(out_path_name(&path, number, name, sizeof name), 0);
    assert_string_equal(name, expected);
}

TEST(names_follow_patterns)
{
    static const char *const wrong[] = {"",         "out/",    "%s.png", "%d%d.png",  "%04x.png", "%",
                                        "a%0d.png", "%4d.png", "%n",     "%010d.png", "%d/a.png"};
    char error[200], name[8];
    out_path path;
    check_name("out/f_%04d.png", 7, "out/f_0007.png");
    check_name("out/f_%04d.png", 123456, "out/f_123456.png");
    check_name("%d", 0, "0");
    check_name("100%%_%02d%%.exr", 3, "100%_03%.exr");
    check_name("plain.png", 9, "plain.png");
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_int_equal(out_path_parse(&path, wrong[i], error, sizeof error), -1);
    assert_int_equal(out_path_parse(&path, "f%04d.png", error, sizeof error), 0);
    assert_int_equal(out_path_name(&path, 1, name, sizeof name), -1); /* does not fit */
    assert_true(out_path_ends_in("a.PNG", ".png") && !out_path_ends_in(".png", ".png") &&
                !out_path_ends_in("apng", ".png"));
}

/* ---- Contact sheets ----------------------------------------------------------------------------------------- */

static uint64_t count_wanted(const contact_sheet *sheet, uint64_t frames)
{
    uint64_t wanted = 0;
    for (uint64_t k = 0; k < frames; k++)
        wanted += contact_sheet_wants(sheet, k) ? 1 : 0;
    return wanted;
}

TEST(sheets_take_evenly_spaced_frames)
{
    for (uint64_t frames = 1; frames < 60; frames++) {
        contact_sheet *sheet = contact_sheet_create(4, 3, frames, 64, 32);
        uint32_t width, height;
        assert_non_null(sheet);
        assert_true(contact_sheet_wants(sheet, 0));
        assert_true(contact_sheet_wants(sheet, frames - 1));
        assert_int_equal(count_wanted(sheet, frames + 5), frames < 12 ? frames : 12);
        assert_non_null(contact_sheet_pixels(sheet, &width, &height));
        const uint32_t cells = frames < 12 ? (uint32_t)frames : 12;
        assert_int_equal(width, (cells < 4 ? cells : 4) * 72 + 8);
        assert_int_equal(height, (cells + 3) / 4 * 40 + 8);
        contact_sheet_release(sheet);
    }
    contact_sheet *huge = contact_sheet_create(100, 100, UINT64_MAX, 8, 8);
    assert_non_null(huge);
    assert_true(contact_sheet_wants(huge, UINT64_MAX - 1));
    contact_sheet_release(huge);
}

TEST(sheets_refuse_nonsense)
{
    uint32_t width, height;
    assert_null(contact_sheet_create(0, 3, 10, 64, 32));
    assert_null(contact_sheet_create(4, 101, 10, 64, 32));
    assert_null(contact_sheet_create(4, 3, 0, 64, 32));
    assert_null(contact_sheet_create(4, 3, 10, 0, 32));
    contact_sheet *thin = contact_sheet_create(1, 1, 1, 65536, 1); /* scaled to nothing but one row */
    assert_non_null(thin);
    contact_sheet_pixels(thin, &width, &height);
    assert_int_equal(width, CONTACT_SHEET_THUMB + 16);
    assert_int_equal(height, 1 + 16);
    contact_sheet_release(thin);
}

/* Alternating columns of black and white: scaled down to the mean of light, which is not the mean of codes. */
TEST(sheets_scale_in_linear_light)
{
    enum { W = 642, H = 10 };
    static uint8_t rgb[H][W][3], alpha[H][W];
    static const uint8_t background[3] = {255, 0, 0};
    uint32_t width, height;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
            memset(rgb[y][x], x % 2 ? 255 : 0, 3);
    contact_sheet *sheet = contact_sheet_create(1, 1, 1, W, H);
    assert_non_null(sheet);
    contact_sheet_add(sheet, 0, 0, &rgb[0][0][0], NULL, background);
    contact_sheet_add(sheet, 1, 1, &rgb[0][0][0], NULL, background); /* not on the sheet: skipped */
    const uint8_t *pixels = contact_sheet_pixels(sheet, &width, &height);
    assert_int_equal(width, 320 + 16);
    assert_near(pixels[((size_t)10 * width + 8 + 160) * 3], 188, 1);         /* half the light, in sRGB */
    assert_int_equal(pixels[0], 40);                                         /* paper */
    contact_sheet_add(sheet, 0, 0, &rgb[0][0][0], &alpha[0][0], background); /* all is seen through */
    assert_memory_equal(pixels + ((size_t)10 * width + 8 + 160) * 3, background, 3);
    contact_sheet_release(sheet);
}

/* ---- Progress ----------------------------------------------------------------------------------------------- */

/* If standard error is no terminal, progress consists of whole lines without control characters, and errors of lines
 * of their own. */
TEST(progress_is_plain_lines_in_a_file)
{
    char text[2000];
    program_progress progress;
    FILE *file = tmpfile();
    assert_non_null(file);
    fflush(stderr);
    const int saved = dup(STDERR_FILENO);
    assert_true(saved >= 0 && dup2(fileno(file), STDERR_FILENO) >= 0);
    program_progress_start(&progress, "rendering", "frames", 100.0, 0);
    progress.start -= 60.0; /* as if a minute had gone by */
    progress.last -= 60.0;
    program_progress_update(&progress, 25.0, -1.0);
    program_progress_update(&progress, 26.0, -1.0); /* too soon */
    program_error("something %s", "happened");
    program_progress_end(&progress);
    program_progress_start(&progress, "silent", "frames", 100.0, 1);
    progress.last -= 60.0;
    program_progress_update(&progress, 25.0, -1.0);
    program_progress_end(&progress);
    fflush(stderr);
    dup2(saved, STDERR_FILENO);
    close(saved);
    rewind(file);
    const size_t length = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[length] = '\0';
    assert_null(strpbrk(text, "\r\033"));
    assert_non_null(strstr(text, "25 frames"));
    assert_non_null(strstr(text, " 25 %"));
    assert_true(strstr(text, "03:0") && strstr(text, " left")); /* a busy machine rounds up */
    assert_null(strstr(text, "26 frames"));
    assert_null(strstr(text, "silent"));
    assert_non_null(strstr(text, "\ncgt-test: something happened\n"));
}

int main(void)
{
    program_init("cgt-test");
    return SUITE_RUN(NULL, NULL);
}

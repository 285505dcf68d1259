/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * <cgt/figure.h>: options that are set, taken back and refused; frames of columns; surveys that begin anew. What
 * pictures show is compared with cgt-render's by doors.sh. */
#include "support/suite.h"
#include "support/test.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <cgt/figure.h>

enum { GRAINS = 50, WIDTH = 48, HEIGHT = 32, BYTES = 3 * WIDTH * HEIGHT };

static cgt_context *context;
static float place[GRAINS][3], heat[GRAINS];

static int make_grains(void **state)
{
    (void)state;
    for (int i = 0; i < GRAINS; i++) {
        place[i][0] = (float)(i % 5);
        place[i][1] = (float)(i / 5 % 5);
        place[i][2] = (float)(i / 25);
        heat[i] = (float)(i % 7);
    }
    return cgt_context_create(&(cgt_context_options){.threads = 2}, &context);
}

static int release_context(void **state)
{
    (void)state;
    cgt_context_release(context);
    return 0;
}

static cgt_figure *make_figure(void)
{
    cgt_figure *figure;
    assert_int_equal(cgt_figure_create(context, &figure), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "size", "48x32"), CGT_OK);
    return figure;
}

static const cgt_figure_column columns[] = {{.name = "heat", .values = {heat, 0, CGT_FORMAT_FLOAT}}};

static cgt_figure_data grains(void)
{
    return (cgt_figure_data){.points = {GRAINS, cgt_floats(place[0], 0), columns, 1, 0.4f}};
}

/* The figure has a sentence with these words. */
static void expect_message(const cgt_figure *figure, const char *words)
{
    char text[1024];
    const size_t length = cgt_figure_get_error_message(figure, text, sizeof text);
    assert_int_equal(length, strlen(text));
    if (!strstr(text, words))
        fail_msg("no \"%s\" in \"%s\"", words, text);
}

static void draw(cgt_figure *figure, const cgt_figure_data *data, uint8_t rgb[BYTES])
{
    const cgt_image image = {.bytes = rgb};
    assert_int_equal(cgt_figure_show(figure, data), CGT_OK);
    assert_int_equal(cgt_figure_draw(figure, &image, NULL), CGT_OK);
}

TEST(options_have_names_and_kinds)
{
    cgt_figure_option option, other;
    uint32_t count = 0, lists = 0, repeating = 0;
    for (; cgt_figure_get_option(count, &option); count++) {
        assert_true(option.name && *option.name && option.group && option.help && *option.help);
        assert_true(option.kind == CGT_FIGURE_SWITCH || option.value);
        assert_true(option.kind != CGT_FIGURE_WORD || option.words);
        assert_true((option.kind != CGT_FIGURE_NUMBER && option.kind != CGT_FIGURE_WHOLE) || option.low < option.high);
        lists += option.kind == CGT_FIGURE_LIST;
        repeating += option.repeats;
        for (uint32_t k = 0; k < count; k++) {
            assert_true(cgt_figure_get_option(k, &other));
            assert_string_not_equal(other.name, option.name);
        }
    }
    assert_true(count > 60 && lists > 5 && repeating == 10);
    assert_false(cgt_figure_get_option(UINT32_MAX, &option));
}

/* A value replaces the one before, and goes to the end; those of options that repeat are added. */
TEST(values_count_in_the_order_in_which_they_were_set)
{
    static const char all[] = "size = 48x32\nshow = heat > 1\naxes\nshow = heat < 5\nstyle = paper\n";
    cgt_figure *const figure = make_figure();
    char text[200];
    assert_int_equal(cgt_figure_set(figure, "style", "plain"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "show", "heat > 1"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "axes", NULL), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "show", "heat < 5"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "style", "paper"), CGT_OK);
    assert_int_equal(cgt_figure_get(figure, NULL, text, sizeof text), strlen(all));
    assert_string_equal(text, all);
    assert_int_equal(cgt_figure_get(figure, "show", text, 12), strlen("heat > 1\nheat < 5\n"));
    assert_string_equal(text, "heat > 1\nhe");
    assert_int_equal(cgt_figure_unset(figure, "show"), CGT_OK);
    assert_int_equal(cgt_figure_get(figure, "show", text, sizeof text), 0);
    assert_int_equal(cgt_figure_unset(figure, NULL), CGT_OK);
    assert_int_equal(cgt_figure_get(figure, NULL, NULL, 0), 0);
    cgt_figure_release(figure);
}

TEST(a_refused_value_changes_nothing)
{
    static const char *const wrong[][3] = {{"colour", "red", "there is no option \"colour\""},
                                           {"style", "grey", "style: \"grey\" is not soft, paper or plain"},
                                           {"style", NULL, "style: the option takes a value"},
                                           {"axes", "x", "axes: the option takes no value"},
                                           {"size", "0x3", "size: "},
                                           {"show", "heat >", "show: "},
                                           {"fov", "30", "--fov"},
                                           {"camera-keys", "no such file", "camera-keys: "}};
    cgt_figure *const figure = make_figure();
    const cgt_figure_data data = grains();
    uint8_t before[BYTES], after[BYTES];
    char settings[200], same[200];
    assert_int_equal(cgt_figure_set(figure, "camera", "9,-9,9,2,2,0,0,0,1,30"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "style", "paper"), CGT_OK);
    cgt_figure_get(figure, NULL, settings, sizeof settings);
    draw(figure, &data, before);
    for (size_t i = 0; i < TEST_COUNT(wrong); i++) {
        assert_int_equal(cgt_figure_set(figure, wrong[i][0], wrong[i][1]), CGT_ERROR_INVALID_ARGUMENT);
        expect_message(figure, wrong[i][2]);
        cgt_figure_get(figure, NULL, same, sizeof same);
        assert_string_equal(same, settings);
    }
    assert_int_equal(cgt_figure_unset(figure, "colour"), CGT_ERROR_INVALID_ARGUMENT);
    draw(figure, &data, after);
    assert_memory_equal(after, before, sizeof after);
    cgt_figure_release(figure);
}

/* What is set after a frame counts for the next one, as if it had been set at the start. */
TEST(options_may_be_set_at_any_time)
{
    cgt_figure *const figure = make_figure(), *const fresh = make_figure();
    const cgt_figure_data data = grains();
    uint8_t first[BYTES], then[BYTES], expected[BYTES];
    const cgt_image image = {.bytes = then};
    draw(figure, &data, first);
    assert_int_equal(cgt_figure_set(figure, "color", "heat"), CGT_OK);
    assert_int_equal(cgt_figure_draw(figure, &image, NULL), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "nothing is shown");
    draw(figure, &data, then);
    assert_int_equal(cgt_figure_set(fresh, "color", "heat"), CGT_OK);
    draw(fresh, &data, expected);
    assert_memory_equal(then, expected, sizeof then);
    assert_memory_not_equal(then, first, sizeof then);
    assert_int_equal(cgt_figure_unset(figure, "color"), CGT_OK);
    draw(figure, &data, then);
    assert_memory_equal(then, first, sizeof then);
    cgt_figure_release(figure);
    cgt_figure_release(fresh);
}

/* The camera shows what was surveyed; a frame after one that was shown begins a new survey. */
TEST(cameras_follow_the_survey)
{
    cgt_figure *const figure = make_figure();
    cgt_figure_data data = grains();
    cgt_camera one, both, again;
    assert_int_equal(cgt_figure_get_camera(figure, &one), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
    assert_int_equal(cgt_figure_get_camera(figure, &one), CGT_OK);
    assert_int_equal(cgt_figure_survey(figure, &data), CGT_OK);
    data.number = 1;
    for (int i = 0; i < GRAINS; i++)
        place[i][0] += 5.0f;
    assert_int_equal(cgt_figure_survey(figure, &data), CGT_OK);
    for (int i = 0; i < GRAINS; i++)
        place[i][0] -= 5.0f;
    data.number = 0;
    assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
    assert_int_equal(cgt_figure_get_camera(figure, &both), CGT_OK);
    assert_true(both.target[0] > one.target[0] + 1.0f);
    assert_int_equal(cgt_figure_survey(figure, &data), CGT_OK);
    assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
    assert_int_equal(cgt_figure_get_camera(figure, &again), CGT_OK);
    assert_memory_equal(&again, &one, sizeof one);
    cgt_figure_release(figure);
}

/* An origin is taken off in double: far from 0 the picture is that of the same grains near it. */
TEST(far_data_keep_their_digits)
{
    static double far[GRAINS][3];
    cgt_figure *const figure = make_figure();
    cgt_figure_data data = grains();
    uint8_t near_by[BYTES], far_off[BYTES];
    cgt_camera camera;
    draw(figure, &data, near_by);
    for (int i = 0; i < GRAINS; i++)
        for (int c = 0; c < 3; c++)
            far[i][c] = 1e9 + (double)place[i][c];
    data.points.positions = cgt_doubles(far[0], 0);
    data.origin[0] = data.origin[1] = data.origin[2] = 1e9;
    assert_int_equal(cgt_figure_survey(figure, &data), CGT_OK);
    draw(figure, &data, far_off);
    assert_memory_equal(far_off, near_by, sizeof far_off);
    assert_int_equal(cgt_figure_get_camera(figure, &camera), CGT_OK);
    assert_true(fabsf(camera.target[0]) < 10.0f);
    cgt_figure_release(figure);
}

static uint32_t numbers[GRAINS];
static float halves[GRAINS];
static const char *const words[] = {"wall", "grain"};

TEST(words_are_compared_in_formulas)
{
    cgt_figure *const figure = make_figure();
    cgt_figure_data data = grains();
    uint8_t grain[BYTES], all[BYTES];
    for (uint32_t i = 0; i < GRAINS; i++)
        numbers[i] = i % 2 + 1;
    const cgt_figure_column named[] = {
        {.name = "kind", .values = cgt_uint32s(numbers, 0), .words = words, .word_count = 2}};
    data.points.columns = named;
    draw(figure, &data, all);
    assert_int_equal(cgt_figure_set(figure, "show", "kind == \"grain\""), CGT_OK);
    draw(figure, &data, grain);
    assert_memory_not_equal(all, grain, sizeof all);
    assert_int_equal(cgt_figure_set(figure, "show", "kind > 1"), CGT_OK);
    assert_int_equal(cgt_figure_show(figure, &data), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "has words in the column \"kind\"");
    cgt_figure_release(figure);
}

static void refuse(cgt_figure *figure, const cgt_figure_data *data, const char *text)
{
    assert_int_equal(cgt_figure_show(figure, data), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, text);
    assert_int_equal(cgt_figure_survey(figure, data), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, text);
}

static void refuse_column(cgt_figure *figure, cgt_figure_column column, const char *text)
{
    cgt_figure_data data = grains();
    data.points.columns = &column;
    refuse(figure, &data, text);
}

TEST(wrong_data_are_refused)
{
    static const uint16_t corners[] = {0, 1, 2, 0, 1, GRAINS};
    static const uint32_t ends[] = {0, GRAINS};
    cgt_figure *const figure = make_figure();
    cgt_figure_data data = grains();
    data.points.positions.data = NULL;
    refuse(figure, &data, "positions: there is no array");
    data.points.positions = cgt_uint32s(numbers, 0);
    refuse(figure, &data, "positions: the array's numbers");
    data = grains();
    data.triangles = (cgt_figure_triangles){2, cgt_uint16s(corners, 0)};
    refuse(figure, &data, "triangle 1 has the corner 50, and there are 50 vertices");
    data.triangles.corners = cgt_floats(heat, 0);
    refuse(figure, &data, "corners of triangles are whole numbers");
    data = grains();
    data.bonds = (cgt_figure_bonds){1, ends};
    refuse(figure, &data, "bond 0 ends at 50");
    data.bonds.ends = NULL;
    refuse(figure, &data, "bonds: there is no array");
    data = grains();
    data.box.edges[1][1] = (double)INFINITY;
    refuse(figure, &data, "not finite");
    data = grains();
    data.points.column_count = 300;
    refuse(figure, &data, "more than 256 columns");
    for (int i = 0; i < GRAINS; i++) {
        numbers[i] = 3;
        halves[i] = 0.5f;
    }
    refuse_column(figure, (cgt_figure_column){.values = cgt_floats(heat, 0)}, "a column has no name");
    refuse_column(figure, (cgt_figure_column){.name = "a"}, "a: there is no array");
    refuse_column(figure, (cgt_figure_column){.name = "id", .values = cgt_floats(halves, 0)},
                  "id: number 0 is 0.5, not a whole number");
    refuse_column(figure,
                  (cgt_figure_column){.name = "a", .values = cgt_uint32s(numbers, 0), .words = words, .word_count = 2},
                  "a: number 0 is 3, and there are 2 words");
    refuse_column(figure, (cgt_figure_column){.name = "velocity", .values = cgt_uint32s(numbers, 0)},
                  "velocity: the array is not one of floats");
    data = grains(); /* the figure is good for more */
    assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
    cgt_figure_release(figure);
}

TEST(kinds_do_not_change_in_a_run)
{
    static const uint16_t corners[] = {0, 1, 2};
    cgt_figure *const figure = make_figure();
    cgt_figure_data data = grains();
    assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
    data.number = 1;
    data.triangles = (cgt_figure_triangles){1, cgt_uint16s(corners, 0)};
    assert_int_equal(cgt_figure_show(figure, &data), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "of another kind");
    assert_int_equal(cgt_figure_show(figure, &data), CGT_OK); /* a run of its own */
    cgt_figure_release(figure);
}

/* Walls are copied, and taken away again. */
TEST(meshes_stand_among_particles)
{
    static float wall[3][3] = {{-3.0f, 6.0f, -3.0f}, {9.0f, 6.0f, -3.0f}, {3.0f, 6.0f, 9.0f}};
    static const uint16_t corners[] = {0, 1, 2};
    cgt_figure *const figure = make_figure();
    const cgt_figure_data data = grains();
    cgt_figure_data mesh = {.points = {3, cgt_floats(wall[0], 0), NULL, 0, 0.0f},
                            .triangles = {1, cgt_uint16s(corners, 0)}};
    uint8_t alone[BYTES], walled[BYTES], again[BYTES];
    draw(figure, &data, alone);
    assert_int_equal(cgt_figure_set_mesh(figure, &mesh), CGT_OK);
    wall[2][2] = 90.0f; /* after the call it is nobody's */
    draw(figure, &data, walled);
    assert_memory_not_equal(walled, alone, sizeof walled);
    assert_int_equal(cgt_figure_set_mesh(figure, &data), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "the mesh has no triangles");
    mesh.points.count = 2;
    assert_int_equal(cgt_figure_set_mesh(figure, &mesh), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "triangle 0 has the corner 2");
    draw(figure, &data, again);
    assert_memory_equal(again, walled, sizeof again);
    assert_int_equal(cgt_figure_set_mesh(figure, NULL), CGT_OK);
    draw(figure, &data, again);
    assert_memory_equal(again, alone, sizeof again);
    cgt_figure_release(figure);
}

TEST(origins_are_found)
{
    static double far[GRAINS][3];
    cgt_figure *const figure = make_figure();
    cgt_figure_data data = grains();
    double origin[3];
    assert_false(cgt_figure_get_origin(figure, origin)); /* nothing was looked at */
    assert_int_equal(cgt_figure_survey(figure, &data), CGT_OK);
    assert_false(cgt_figure_get_origin(figure, origin));
    for (int i = 0; i < GRAINS; i++)
        for (int c = 0; c < 3; c++)
            far[i][c] = 1e7 + (double)place[i][c];
    data.points.positions = cgt_doubles(far[0], 0);
    assert_int_equal(cgt_figure_survey(figure, &data), CGT_OK);
    assert_true(cgt_figure_get_origin(figure, origin));
    for (int c = 0; c < 3; c++)
        assert_true(fabs(origin[c] - 1e7) < 10.0);
    memcpy(data.origin, origin, sizeof origin);
    assert_int_equal(cgt_figure_survey(figure, &data), CGT_OK);
    assert_false(cgt_figure_get_origin(figure, origin));
    assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
    cgt_figure_release(figure);
}

/* One colour for all is what the option color draws; where there are more than a palette holds, near ones are drawn. */
TEST(colours_are_those_of_a_column)
{
    enum { MANY = 1600 }; /* of more colours than 1,024 */
    static float color[MANY][3], at[MANY][3];
    const cgt_figure_column given[] = {{.name = "rgb", .values = cgt_floats(color[0], 0)}};
    cgt_figure *const figure = make_figure();
    cgt_figure_data data = grains();
    uint8_t wanted[BYTES], rgb[BYTES];
    assert_int_equal(cgt_figure_set(figure, "color", "ff8000"), CGT_OK);
    draw(figure, &data, wanted);
    for (int i = 0; i < MANY; i++) {
        color[i][0] = cgt_srgb_decode(255);
        color[i][1] = cgt_srgb_decode(128);
        for (int c = 0; c < 3; c++)
            at[i][c] = (float)(c == 2 ? 0 : c ? i / 40 : i % 40);
    }
    data.points.columns = given;
    assert_int_equal(cgt_figure_unset(figure, "color"), CGT_OK);
    draw(figure, &data, rgb);
    assert_memory_equal(rgb, wanted, sizeof rgb);
    for (int i = 0; i < MANY; i++) {
        color[i][0] = (float)(i % 40) / 40.0f;
        color[i][1] = (float)(i / 40) / 40.0f;
    }
    color[7][0] = NAN;
    data.points = (cgt_figure_points){MANY, cgt_floats(at[0], 0), given, 1, 0.7f};
    assert_int_equal(cgt_figure_set(figure, "view", "top"), CGT_OK);
    draw(figure, &data, rgb);
    for (int i = 0; i < BYTES; i += 3)
        assert_true(rgb[i + 2] < 3 || (rgb[i + 2] == 0x37 && rgb[i] == 0x2a)); /* no blue but the background's */
    data.points.column_count = 0;
    draw(figure, &data, rgb); /* a frame that lacks them is grey */
    for (int i = 0; i < BYTES; i += 3)
        assert_true(rgb[i + 2] > 3);
    cgt_figure_release(figure);
}

TEST(nothing_is_a_figure_too)
{
    cgt_figure *figure = NULL;
    const cgt_figure_data nothing = {.number = 0};
    uint8_t rgb[BYTES];
    assert_int_equal(cgt_figure_create(NULL, &figure), CGT_ERROR_INVALID_ARGUMENT);
    assert_null(figure);
    assert_int_equal(cgt_figure_create(context, NULL), CGT_ERROR_INVALID_ARGUMENT);
    cgt_figure_release(NULL);
    figure = make_figure();
    assert_null(cgt_figure_take_notice(figure));
    cgt_figure_data data = nothing;
    data.points.positions = cgt_floats(place[0], 0);
    draw(figure, &data, rgb);
    for (int i = 3; i < BYTES; i++)
        assert_int_equal(rgb[i], rgb[i % 3]);
    cgt_figure_release(figure);
}

SEEDED_SUITE("test_figure", make_grains, release_context)

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
#include <cgt/trajectory.h>

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
    assert_true(count > 60 && lists > 5 && repeating == 13);
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

/* Settings are lines, which no value ends. */
TEST(a_value_is_one_line)
{
    static const char lines[] = "size = 48x32\ntitle = a b  c\nshow = heat > 1   && heat < 5\n";
    cgt_figure *const figure = make_figure(), *const other = make_figure();
    char text[200];
    assert_int_equal(cgt_figure_set(figure, "title", "a\nb\r\nc"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "show", "heat > 1\n  && heat < 5"), CGT_OK);
    cgt_figure_get(figure, NULL, text, sizeof text);
    assert_string_equal(text, lines);
    assert_int_equal(cgt_figure_set_lines(other, text), CGT_OK);
    cgt_figure_get(other, NULL, text, sizeof text);
    assert_string_equal(text, lines);
    cgt_figure_release(figure);
    cgt_figure_release(other);
}

/* Lines are checked together, and set together or not at all. */
TEST(lines_are_set_at_once)
{
    static const char lines[] =
        "material = 2=glass\ntitle = a = b\naxes\nshow = heat > 1\nshow = heat < 5\nbounces = 2\n";
    cgt_figure *const figure = make_figure();
    char text[200], all[200];
    snprintf(all, sizeof all, "size = 48x32\n%s", lines);
    assert_int_equal(cgt_figure_set(figure, "material", "2=glass"), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_set_lines(figure, lines), CGT_OK);
    cgt_figure_get(figure, NULL, text, sizeof text);
    assert_string_equal(text, all);
    assert_int_equal(cgt_figure_set_lines(figure, "\nfov = 40\nfog = 3"), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "there is no option \"fog\"");
    assert_int_equal(cgt_figure_set_lines(figure, "axes=3\n"), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_set_lines(figure, "axes = 3\n"), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "axes: the option takes no value");
    assert_int_equal(cgt_figure_set_lines(figure, "camera = 1,1,1,0,0,0,0,0,1,30\nfov = 3\n"),
                     CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_set_lines(figure, ""), CGT_OK);
    cgt_figure_get(figure, NULL, text, sizeof text);
    assert_string_equal(text, all);
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

/* A figure that is drawn with one option, in a camera that shows all frames alike. */
static void draw_with(const char *name, const char *value, const cgt_figure_data *data, uint8_t rgb[BYTES])
{
    cgt_figure *const figure = make_figure();
    assert_int_equal(cgt_figure_set(figure, "camera", "2,-9,9,2,2,0,0,0,1,40"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, name, value), CGT_OK);
    draw(figure, data, rgb);
    cgt_figure_release(figure);
}

/* Words have the colours of types, by their order in the run; so have whole numbers. */
TEST(categories_have_colours)
{
    static const char *const names[] = {"wall", "grain", "oil"}, *const other[] = {"oil", "wall", "grain"};
    static uint32_t turned[GRAINS];
    cgt_figure_data data = grains();
    uint8_t types[BYTES], drawn[BYTES];
    for (uint32_t i = 0; i < GRAINS; i++) {
        numbers[i] = i % 3 + 1;
        turned[i] = (i % 3 + 1) % 3 + 1;
        halves[i] = (float)(i % 2) / 2.0f;
    }
    const cgt_figure_column all[] = {
        {.name = "type", .values = cgt_uint32s(numbers, 0)},
        {.name = "kind", .values = cgt_uint32s(numbers, 0), .words = names, .word_count = 3},
        {.name = "half", .values = cgt_floats(halves, 0)}};
    const cgt_figure_column later = {.name = "kind", .values = cgt_uint32s(turned, 0), .words = other, .word_count = 3};
    data.points.columns = all;
    data.points.column_count = 3;
    draw_with("color", "type", &data, types);
    draw_with("color", "kind", &data, drawn);
    assert_memory_equal(drawn, types, sizeof drawn);
    draw_with("category", "kind", &data, drawn);
    assert_memory_equal(drawn, types, sizeof drawn);
    draw_with("category", "type", &data, drawn);
    assert_memory_equal(drawn, types, sizeof drawn);
    draw_with("category", "type + 1024", &data, drawn); /* they begin again */
    assert_memory_equal(drawn, types, sizeof drawn);
    cgt_figure *const figure = make_figure();
    assert_int_equal(cgt_figure_set(figure, "camera", "2,-9,9,2,2,0,0,0,1,40"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "color", "kind"), CGT_OK);
    draw(figure, &data, drawn);
    assert_memory_equal(drawn, types, sizeof drawn);
    data.number = 1; /* the same words in another order */
    data.points.columns = &later;
    data.points.column_count = 1;
    draw(figure, &data, drawn);
    assert_memory_equal(drawn, types, sizeof drawn);
    data.number = 0;
    data.points.columns = all;
    data.points.column_count = 3;
    assert_int_equal(cgt_figure_set(figure, "type-color", "grain=102030"), CGT_OK);
    draw(figure, &data, drawn);
    assert_memory_not_equal(drawn, types, sizeof drawn);
    cgt_figure *const by_number = make_figure();
    assert_int_equal(cgt_figure_set(by_number, "camera", "2,-9,9,2,2,0,0,0,1,40"), CGT_OK);
    assert_int_equal(cgt_figure_set(by_number, "type-color", "2=102030"), CGT_OK);
    assert_int_equal(cgt_figure_set(by_number, "category", "type"), CGT_OK);
    draw(by_number, &data, types);
    assert_memory_equal(drawn, types, sizeof drawn);
    cgt_figure_release(by_number);
    assert_int_equal(cgt_figure_set(figure, "color", "type"), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "--type-color: \"grain\" is neither");
    assert_int_equal(cgt_figure_set(figure, "category", "half"), CGT_OK);
    assert_int_equal(cgt_figure_show(figure, &data), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "\"half\" has the value 0.5");
    assert_int_equal(cgt_figure_set(figure, "category", "kin"), CGT_OK);
    assert_int_equal(cgt_figure_show(figure, &data), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "has no column \"kin\", but x, y, z, type, kind, half");
    cgt_figure_release(figure);
}

/* A chain of carbon: bonds of columns are guessed as those of files are; types may be elements. */
TEST(bonds_are_guessed)
{
    static float chain[4][3] = {{0.0f, 0.0f, 0.0f}, {1.5f, 0.0f, 0.0f}, {3.0f, 0.0f, 0.0f}, {6.0f, 0.0f, 0.0f}};
    static const uint32_t ends[] = {0, 1, 1, 2};
    static const uint8_t carbon[] = {6, 6, 6, 6}, types[] = {9, 9, 9, 9};
    cgt_figure_column column = {.name = "element", .values = cgt_uint8s(carbon, 0)};
    cgt_figure_data data = {.points = {4, cgt_floats(chain[0], 0), &column, 1, 0.0f}, .bonds = {2, ends}};
    uint8_t listed[BYTES], drawn[BYTES];
    cgt_figure *const figure = make_figure();
    assert_int_equal(cgt_figure_set(figure, "bonds", NULL), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "radius-scale", "0.2"), CGT_OK);
    draw(figure, &data, listed);
    data.bonds.count = 0; /* it is known that there are none */
    draw(figure, &data, drawn);
    assert_memory_not_equal(drawn, listed, sizeof drawn);
    data.bonds.ends = NULL;
    assert_int_equal(cgt_figure_unset(figure, "color"), CGT_OK); /* a run of its own */
    draw(figure, &data, drawn);
    assert_memory_equal(drawn, listed, sizeof drawn);
    assert_non_null(strstr(cgt_figure_take_notice(figure), "guessed by the covalent radii"));
    column = (cgt_figure_column){.name = "type", .values = cgt_uint8s(types, 0)};
    assert_int_equal(cgt_figure_unset(figure, "color"), CGT_OK);
    assert_int_equal(cgt_figure_show(figure, &data), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "or the elements of its types by --type-element");
    assert_int_equal(cgt_figure_set(figure, "type-element", "3=H,9=C"), CGT_OK);
    draw(figure, &data, drawn);
    assert_memory_equal(drawn, listed, sizeof drawn);
    data.points.column_count = 0;
    assert_int_equal(cgt_figure_show(figure, &data), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "--type-element: frame 0 has no types");
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

static float corner[4][3] = {{0.0f, 0.0f, 0.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 4.0f, 0.0f}, {0.0f, 0.0f, 4.0f}};
static const uint32_t closed_mesh[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

static cgt_figure_data tetrahedron(const uint32_t *corners)
{
    return (cgt_figure_data){.points = {4, cgt_floats(corner[0], 0), NULL, 0, 0.0f},
                             .triangles = {4, cgt_uint32s(corners, 0)}};
}

/* They are numbers of vertices, of which there may be fewer than triangles: for formulas alone. */
TEST(columns_of_meshes_are_of_vertices)
{
    static const uint32_t number[] = {0, 0, 0, 8};
    cgt_figure *const figure = make_figure();
    cgt_figure_data data = tetrahedron(closed_mesh);
    uint8_t plain[BYTES], then[BYTES];
    uint32_t twice[24];
    for (int i = 0; i < 24; i++)
        twice[i] = closed_mesh[i % 12];
    data.triangles = (cgt_figure_triangles){8, cgt_uint32s(twice, 0)};
    const cgt_figure_column whole[] = {{.name = "id", .values = cgt_uint32s(number, 0)},
                                       {.name = "type", .values = cgt_uint32s(number, 0)},
                                       {.name = "element", .values = cgt_uint32s(number, 0)}};
    assert_int_equal(cgt_figure_set(figure, "color", "id"), CGT_OK);
    draw(figure, &data, plain);
    data.points.columns = whole;
    data.points.column_count = 3;
    assert_int_equal(cgt_figure_set(figure, "color", "id"), CGT_OK);
    draw(figure, &data, then);
    assert_memory_equal(then, plain, sizeof then);
    assert_int_equal(cgt_figure_set(figure, "color", "element + type"), CGT_OK);
    draw(figure, &data, then);
    assert_memory_not_equal(then, plain, sizeof then);
    assert_int_equal(cgt_figure_set(figure, "color", "type"), CGT_OK);
    assert_int_equal(cgt_figure_show(figure, &data), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "the triangles have no types");
    cgt_figure_release(figure);
}

/* A shown frame is the figure's own, whatever becomes of the reader's. */
TEST(frames_are_copied)
{
    uint32_t index[12], ids[4] = {1, 2, 3, 4};
    float values[4] = {1.0f, 2.0f, 3.0f, 4.0f}, spheres[16] = {0.0f};
    uint8_t element[4] = {6, 6, 6, 6}, before[BYTES], after[BYTES];
    char told[200];
    cgt_trajectory_column column = {.name = "heat", .value = values};
    cgt_trajectory_frame frame = {.kind = CGT_TRAJECTORY_TRIANGLES,
                                  .count = 4,
                                  .triangles = 4,
                                  .index = index,
                                  .position = corner[0],
                                  .angstrom = 1.0f,
                                  .box_min = {1.0f}};
    const cgt_figure_data data = {.frame = &frame};
    const cgt_image image = {.bytes = after};
    cgt_figure *const figure = make_figure();
    memcpy(index, closed_mesh, sizeof index);
    draw(figure, &data, before);
    memset(index, 0, sizeof index);
    assert_int_equal(cgt_figure_draw(figure, &image, NULL), CGT_OK);
    assert_memory_equal(after, before, sizeof after);
    assert_int_equal(cgt_figure_describe(figure, 3, told, sizeof told), strlen("triangle 3, vertices 1, 2, 3\n"));
    assert_string_equal(told, "triangle 3, vertices 1, 2, 3\n");
    frame = (cgt_trajectory_frame){.kind = CGT_TRAJECTORY_SPHERES,
                                   .count = 4,
                                   .xyzr = spheres,
                                   .id = ids,
                                   .element = element,
                                   .angstrom = 1.0f,
                                   .columns = 1,
                                   .column = &column,
                                   .box_min = {1.0f}};
    spheres[7] = 0.5f;
    assert_int_equal(cgt_figure_unset(figure, NULL), CGT_OK); /* a run of its own */
    assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
    cgt_figure_describe(figure, 1, told, sizeof told);
    assert_string_equal(told, "sphere 1\nat  0, 0, 0\nradius  0.5\n");
    cgt_figure_release(figure);
}

/* Glass has the bodies of its own triangles. */
TEST(bodies_are_those_of_the_mesh)
{
    static const uint32_t open_mesh[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 3, 2};
    cgt_figure *const figure = make_figure();
    cgt_figure_data data = tetrahedron(closed_mesh);
    uint8_t rgb[BYTES];
    assert_int_equal(cgt_figure_set_lines(figure, "bounces = 2\nmaterial = all=glass\n"), CGT_OK);
    draw(figure, &data, rgb);
    data = tetrahedron(open_mesh);
    data.number = 1;
    assert_int_equal(cgt_figure_show(figure, &data), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "glass must be closed");
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
        assert_true(rgb[i + 2] <= 0x37); /* no more blue than the background has */
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

/* ---- Frames that are kept ----------------------------------------------------------------------------------- */

static cgt_figure_frame *keep(cgt_figure *figure, const cgt_figure_data *data)
{
    cgt_figure_frame *frame = NULL;
    char text[256];
    uint64_t lead;
    assert_int_equal(cgt_figure_begin_keep(figure, &lead), CGT_OK);
    assert_int_equal(lead, 1); /* of speeds */
    assert_int_equal(cgt_figure_keep(figure, data, &frame, text, sizeof text), CGT_OK);
    assert_string_equal(text, "");
    return frame;
}

static void draw_shown(cgt_figure *figure, uint8_t rgb[BYTES])
{
    const cgt_image image = {.bytes = rgb};
    assert_int_equal(cgt_figure_draw(figure, &image, NULL), CGT_OK);
}

/* With an option that leaves the camera's reach the kept frame looks as one that is shown by a figure that had the
 * option from the start; without it as before. What is not there is refused, and changes nothing. */
TEST(options_change_what_is_shown)
{
    static const char *const options[][2] = {{"color", "heat"},
                                             {"bonds", "1.2"},
                                             {"head", "0.5"},
                                             {"style", "paper"},
                                             {"antialias", "4"},
                                             {"background", "red"},
                                             {"floor", NULL},
                                             {"bounces", "2"},
                                             {"view", "top"},
                                             {"zoom", "3"},
                                             {"images", "1,1,1"},
                                             {"light", "1,0,0"},
                                             {"color", "id"},
                                             {"color", "height"},
                                             {"orbit", "20"},
                                             {"range", "symmetric"},
                                             {"category", "heat"},
                                             {"category", "floor(heat / 2)"},
                                             {"opacity", "heat > 2=0.4"},
                                             {"show", "heat == heat"}, /* all: none is in a layer any more */
                                             {"opacity", "bonds=0.5"}};
    static const char *const wrong[][3] = {{"color", "cold", "has no column \"cold\""},
                                           {"show", "cold > 2", "has no column \"cold\""},
                                           {"opacity", "cold > 2=0.5", "has no column \"cold\""},
                                           {"category", "heat / 2", "it takes whole numbers"},
                                           {"type-element", "1=H", "type-element: the frames"},
                                           {"box", NULL, "has no box"},
                                           {"bonds", NULL, "has no bonds"},
                                           {"font", "no such file", NULL},
                                           {"trails", "3", "trails: the frames that are kept were taken otherwise"},
                                           {"unwrap", NULL, "unwrap: the frames"},
                                           {"whole", NULL, "whole: the frames"},
                                           {"fill", "x", "fill: "}};
    cgt_figure *const figure = make_figure();
    const cgt_figure_data data = grains();
    uint8_t first[BYTES], then[BYTES], expected[BYTES];
    char before[200], after[200];
    cgt_figure_frame *const frame = keep(figure, &data);
    assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
    draw_shown(figure, first);
    for (size_t i = 0; i < TEST_COUNT(options); i++) {
        cgt_figure *const fresh = make_figure();
        assert_int_equal(cgt_figure_set(figure, options[i][0], options[i][1]), CGT_OK);
        draw_shown(figure, then);
        assert_int_equal(cgt_figure_set(fresh, options[i][0], options[i][1]), CGT_OK);
        draw(fresh, &data, expected);
        if (memcmp(then, expected, sizeof then) != 0)
            fail_msg("%s: another picture than that of a figure which had it from the start", options[i][0]);
        assert_int_equal(cgt_figure_unset(figure, options[i][0]), CGT_OK);
        draw_shown(figure, then);
        if (memcmp(then, first, sizeof then) != 0)
            fail_msg("%s: without it the picture is not as before", options[i][0]);
        cgt_figure_release(fresh);
    }
    cgt_figure_get(figure, NULL, before, sizeof before);
    for (size_t i = 0; i < TEST_COUNT(wrong); i++) {
        const int is_font = strcmp(wrong[i][0], "font") == 0; /* read where there is a text */
        if (is_font && cgt_figure_set(figure, "axes", NULL) != CGT_OK)
            continue; /* without FreeType */
        if (is_font) {
            draw_shown(figure, first);
            cgt_figure_get(figure, NULL, before, sizeof before);
        }
        assert_int_equal(cgt_figure_set(figure, wrong[i][0], wrong[i][1]), CGT_ERROR_INVALID_ARGUMENT);
        expect_message(figure, wrong[i][2] ? wrong[i][2] : "");
        cgt_figure_get(figure, NULL, after, sizeof after);
        assert_string_equal(after, before);
        draw_shown(figure, then);
        assert_memory_equal(then, first, sizeof then);
    }
    cgt_figure_frame_release(frame); /* which is taken away */
    const cgt_image image = {.bytes = then};
    assert_int_equal(cgt_figure_draw(figure, &image, NULL), CGT_ERROR_INVALID_ARGUMENT);
    cgt_figure_release(figure);
}

/* Bonds of a kept frame are guessed where options ask for them, as if they had been asked for from the start. */
TEST(kept_frames_have_bonds)
{
    static float chain[3][3] = {{0.0f, 0.0f, 0.0f}, {1.5f, 0.0f, 0.0f}, {3.0f, 0.0f, 0.0f}};
    static const uint8_t carbon[] = {6, 6, 6};
    const cgt_figure_column column = {.name = "element", .values = cgt_uint8s(carbon, 0)};
    const cgt_figure_data data = {.points = {3, cgt_floats(chain[0], 0), &column, 1, 0.0f}};
    cgt_figure *const figure = make_figure(), *const fresh = make_figure();
    uint8_t then[BYTES], expected[BYTES];
    assert_int_equal(cgt_figure_set(figure, "radius-scale", "0.2"), CGT_OK);
    cgt_figure_frame *const frame = keep(figure, &data);
    assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "bonds", NULL), CGT_OK);
    assert_non_null(strstr(cgt_figure_take_notice(figure), "guessed by the covalent radii"));
    draw_shown(figure, then);
    assert_int_equal(cgt_figure_set_lines(fresh, "radius-scale = 0.2\nbonds\n"), CGT_OK);
    draw(fresh, &data, expected);
    assert_memory_equal(then, expected, sizeof then);
    assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
    draw_shown(figure, then);
    assert_memory_equal(then, expected, sizeof then);
    cgt_figure_release(figure);
    cgt_figure_release(fresh);
    cgt_figure_frame_release(frame);
}

/* Materials that no option has any more, while light still bounces, in a frame of more spheres than had one: that such
 * a material is asked for, memory checkers alone see. */
TEST(materials_go_with_their_option)
{
    cgt_figure *const figure = make_figure(), *const fresh = make_figure();
    cgt_figure_data data = grains(), few = data;
    uint8_t then[BYTES], expected[BYTES];
    few.points.count = 3;
    cgt_figure_frame *const one = keep(figure, &few), *other = NULL;
    assert_int_equal(cgt_figure_show_frame(figure, one), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "bounces", "2"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "material", "all=glass"), CGT_OK);
    draw_shown(figure, then);
    assert_int_equal(cgt_figure_unset(figure, "material"), CGT_OK);
    data.number = 1;
    assert_int_equal(cgt_figure_keep(figure, &data, &other, NULL, 0), CGT_OK);
    assert_int_equal(cgt_figure_show_frame(figure, other), CGT_OK);
    draw_shown(figure, then);
    assert_int_equal(cgt_figure_set(fresh, "bounces", "2"), CGT_OK);
    assert_int_equal(cgt_figure_survey(fresh, &few), CGT_OK);
    draw(fresh, &data, expected);
    assert_memory_equal(then, expected, sizeof then);
    cgt_figure_release(figure);
    cgt_figure_release(fresh);
    cgt_figure_frame_release(one);
    cgt_figure_frame_release(other);
}

/* Layers and words go with the frame that is released, and come with the next one. */
TEST(what_is_seen_through_goes_with_its_frame)
{
    static const char *const names[] = {"wall", "grain", "oil"};
    cgt_figure *const figure = make_figure(), *const fresh = make_figure();
    cgt_figure_data data = grains();
    uint8_t first[BYTES], then[BYTES], expected[BYTES];
    for (uint32_t i = 0; i < GRAINS; i++)
        numbers[i] = i % 3 + 1;
    const cgt_figure_column kinds = {
        .name = "kind", .values = cgt_uint32s(numbers, 0), .words = names, .word_count = 3};
    data.points.columns = &kinds;
    assert_int_equal(cgt_figure_set(figure, "opacity", "kind == oil=0.4"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "color", "kind"), CGT_OK);
    cgt_figure_frame *const one = keep(figure, &data);
    data.number = 1;
    cgt_figure_frame *const other = keep(figure, &data);
    assert_int_equal(cgt_figure_show_frame(figure, one), CGT_OK);
    draw_shown(figure, first);
    cgt_figure_frame_release(one);
    assert_int_equal(cgt_figure_show_frame(figure, other), CGT_OK);
    draw_shown(figure, then);
    assert_memory_equal(then, first, sizeof then);
    assert_int_equal(cgt_figure_set(figure, "style", "paper"), CGT_OK);
    draw_shown(figure, then);
    assert_int_equal(cgt_figure_set(fresh, "opacity", "kind == oil=0.4"), CGT_OK);
    assert_int_equal(cgt_figure_set(fresh, "color", "kind"), CGT_OK);
    assert_int_equal(cgt_figure_set(fresh, "style", "paper"), CGT_OK);
    draw(fresh, &data, expected);
    assert_memory_equal(then, expected, sizeof then);
    cgt_figure_release(figure);
    cgt_figure_release(fresh);
    cgt_figure_frame_release(other);
}

/* The same of what lies over the picture: texts, and labels of grains, with a camera that is given, since an automatic
 * one leaves room for texts. */
TEST(texts_change_over_what_is_shown)
{
    static const char *const options[][2] = {{"label", "heat > 5"}, {"label-text", "{heat}"}, {"title", "A"},
                                             {"axes", NULL},        {"scale-bar", "1,m"},     {"colorbar", "heat"},
                                             {"text-size", "0.1"},  {"legend", "kinds"}};
    cgt_figure *const figure = make_figure(), *const fresh = make_figure();
    const cgt_figure_data data = grains();
    uint8_t then[BYTES], expected[BYTES];
    char settings[500];
    assert_int_equal(cgt_figure_set_lines(figure, "camera = 9,-9,9,2,2,0,0,0,1,40\ncolor = heat\nrange = 0,6\n"),
                     CGT_OK);
    cgt_figure_frame *const frame = keep(figure, &data);
    assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
    for (size_t i = 0; i < TEST_COUNT(options); i++) {
        if (cgt_figure_set(figure, options[i][0], options[i][1]) != CGT_OK) {
            expect_message(figure, "FreeType");
            break;
        }
        draw_shown(figure, then);
        cgt_figure_get(figure, NULL, settings, sizeof settings);
        assert_int_equal(cgt_figure_unset(fresh, NULL), CGT_OK);
        assert_int_equal(cgt_figure_set_lines(fresh, settings), CGT_OK);
        draw(fresh, &data, expected);
        if (memcmp(then, expected, sizeof then) != 0)
            fail_msg("%s: another picture than that of a figure which had it from the start", options[i][0]);
    }
    cgt_figure_unset(figure, "label-text");
    cgt_figure_unset(figure, "label"); /* which goes */
    draw_shown(figure, then);
    cgt_figure_get(figure, NULL, settings, sizeof settings);
    assert_int_equal(cgt_figure_unset(fresh, NULL), CGT_OK);
    assert_int_equal(cgt_figure_set_lines(fresh, settings), CGT_OK);
    draw(fresh, &data, expected);
    assert_memory_equal(then, expected, sizeof then);
    cgt_figure_release(figure);
    cgt_figure_release(fresh);
    cgt_figure_frame_release(frame);
}

/* Texts are the same on images of three and four channels, with gaps between rows, and on linear pixels alone. */
TEST(texts_are_drawn_on_images_of_all_kinds)
{
    enum { WIDE = 192, HIGH = 128, STRIDE = 4 * WIDE + 9 };
    static uint8_t rgb[3 * WIDE * HIGH], wide[STRIDE * HIGH], plain[3 * WIDE * HIGH];
    static cgt_linear_pixel both[WIDE * HIGH], alone[WIDE * HIGH];
    cgt_figure *const figure = make_figure();
    const cgt_figure_data data = grains();
    const cgt_image image = {.bytes = rgb, .linear = both}, four = {.bytes = wide, .channels = 4, .row_stride = STRIDE},
                    linear = {.linear = alone}, textless = {.bytes = plain};
    assert_int_equal(cgt_figure_set_lines(figure, "size = 192x128\ncamera = 9,-9,9,2,2,0,0,0,1,40\n"), CGT_OK);
    cgt_figure_frame *const frame = keep(figure, &data);
    assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
    assert_int_equal(cgt_figure_draw(figure, &textless, NULL), CGT_OK);
    if (cgt_figure_set(figure, "axes", NULL) == CGT_OK) {
        memset(wide, 7, sizeof wide);
        assert_int_equal(cgt_figure_draw(figure, &image, NULL), CGT_OK);
        assert_int_equal(cgt_figure_draw(figure, &four, NULL), CGT_OK);
        assert_int_equal(cgt_figure_draw(figure, &linear, NULL), CGT_OK);
        assert_true(memcmp(rgb, plain, sizeof rgb) != 0);
        assert_memory_equal(alone, both, sizeof both);
    } else
        expect_message(figure, "FreeType");
    for (ptrdiff_t i = 0; i < WIDE * HIGH && wide[3]; i++) {
        assert_memory_equal(wide + i / WIDE * STRIDE + 4 * (i % WIDE), rgb + 3 * i, 3);
        assert_int_equal(wide[i / WIDE * STRIDE + 4 * (i % WIDE) + 3], 255);
    }
    for (ptrdiff_t i = 0; i < 9 * HIGH && wide[3]; i++)
        assert_int_equal(wide[i / 9 * STRIDE + 4 * WIDE + i % 9], 7);
    cgt_figure_release(figure);
    cgt_figure_frame_release(frame);
}

/* What was surveyed stays with options that do not concern it: camera and range are those of the run. */
TEST(a_survey_stays_while_frames_are_kept)
{
    cgt_figure *const figure = make_figure();
    cgt_figure_data data = grains();
    cgt_camera run, then;
    char range[100], after[100];
    assert_int_equal(cgt_figure_set(figure, "color", "heat"), CGT_OK);
    assert_true(cgt_figure_needs_frame(figure));
    assert_int_equal(cgt_figure_survey(figure, &data), CGT_OK);
    assert_true(cgt_figure_needs_frame(figure));
    for (int i = 0; i < GRAINS; i++) {
        place[i][0] += 9.0f;
        heat[i] *= 3.0f;
    }
    data.number = 1;
    assert_int_equal(cgt_figure_survey(figure, &data), CGT_OK);
    for (int i = 0; i < GRAINS; i++) {
        place[i][0] -= 9.0f;
        heat[i] /= 3.0f;
    }
    data.number = 0;
    cgt_figure_frame *const frame = keep(figure, &data);
    assert_int_equal(cgt_figure_get_camera(figure, &run), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "size", "48x32"), CGT_OK); /* before a frame is shown */
    assert_int_equal(cgt_figure_set(figure, "bonds", "1.2"), CGT_OK);
    assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
    assert_true(cgt_figure_get_chosen(figure, "range", range, sizeof range) > 0);
    assert_string_equal(range, "0,18\n");
    assert_int_equal(cgt_figure_set(figure, "radius-scale", "0.5"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "colormap", "plasma"), CGT_OK);
    assert_int_equal(cgt_figure_get_camera(figure, &then), CGT_OK);
    assert_memory_equal(&then, &run, sizeof run);
    cgt_figure_get_chosen(figure, "range", after, sizeof after);
    assert_string_equal(after, range);
    assert_int_equal(cgt_figure_set(figure, "color", "heat*1"), CGT_OK); /* of the frame */
    cgt_figure_get_chosen(figure, "range", after, sizeof after);
    assert_string_equal(after, "0,6\n");
    cgt_figure_release(figure); /* before its frame */
    cgt_figure_frame_release(frame);
}

/* A figure that is given what another one has chosen makes its picture, whatever it looks at. */
TEST(what_was_chosen_makes_the_picture)
{
    cgt_figure *const figure = make_figure(), *const other = make_figure();
    const cgt_figure_data data = grains();
    const cgt_camera camera = {.eye = {9.0f, -7.0f, 5.0f}, .target = {2.0f, 1.0f, 0.5f}, .up = {0, 0, 1}, .fov = 33.3f};
    uint8_t hand[BYTES], again[BYTES];
    char text[1000];
    cgt_camera fitted;
    float up[3];
    assert_int_equal(cgt_figure_get_chosen(figure, NULL, text, sizeof text), 0);
    cgt_figure_frame *const frame = keep(figure, &data);
    assert_int_equal(cgt_figure_set(figure, "zoom", "2"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "up", "y"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "color", "height"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "floor", "teal"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "show", "heat > 2"), CGT_OK);
    assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
    assert_int_equal(cgt_figure_get_up(figure, up), CGT_OK);
    assert_true(up[0] == 0.0f && up[1] == 1.0f && up[2] == 0.0f);
    assert_int_equal(cgt_figure_set_camera(figure, &camera), CGT_OK);
    assert_int_equal(cgt_figure_fit(figure), CGT_OK);
    assert_int_equal(cgt_figure_get_camera(figure, &fitted), CGT_OK);
    assert_true(fitted.fov == camera.fov && fitted.eye[0] != camera.eye[0]);
    assert_int_equal(cgt_figure_set(figure, "show", "heat < 6"), CGT_OK);
    draw_shown(figure, hand);
    const size_t length = cgt_figure_get_chosen(figure, NULL, text, sizeof text);
    assert_int_equal(length, strlen(text));
    assert_int_equal(cgt_figure_set_lines(other, text), CGT_OK);
    draw(other, &data, again);
    assert_memory_equal(again, hand, sizeof hand);
    assert_int_equal(cgt_figure_set(figure, "view", "front"), CGT_OK); /* ends the hand's */
    assert_int_equal(cgt_figure_get_camera(figure, &fitted), CGT_OK);
    assert_true(fitted.fov != camera.fov);
    cgt_figure_frame_release(frame);
    cgt_figure_release(figure);
    cgt_figure_release(other);
}

/* So it does where the view says which axis is height, and where the scale is logarithmic, or could not be. */
TEST(what_was_chosen_is_accepted)
{
    static const char *const settings[] = {"up = x\nview = top\ncolor = height\n", "color = id\nlog-scale\n",
                                           "color = height\nlog-scale\n", "color = red\nlog-scale\n",
                                           "view = top\ncolor = height\n"};
    static const char *const chosen[] = {"\ncolor = x\n", "\ncolor = id\nrange = 1,49\nlog-scale\n",
                                         "\ncolor = height\nrange = ", "\ncolor = ff0000\n", "\ncolor = height\n"};
    const cgt_figure_data data = grains();
    uint8_t first[BYTES], again[BYTES];
    char text[1000];
    for (size_t i = 0; i < TEST_COUNT(settings); i++) {
        cgt_figure *const figure = make_figure(), *const other = make_figure();
        assert_int_equal(cgt_figure_set_lines(figure, settings[i]), CGT_OK);
        draw(figure, &data, first);
        cgt_figure_get_chosen(figure, NULL, text, sizeof text);
        if (!strstr(text, chosen[i]))
            fail_msg("no \"%s\" in \"%s\"", chosen[i], text);
        assert_int_equal(strstr(text, "log-scale") != NULL, i == 1);
        assert_int_equal(cgt_figure_set_lines(other, text), CGT_OK);
        draw(other, &data, again);
        assert_memory_equal(again, first, sizeof first);
        cgt_figure_release(figure);
        cgt_figure_release(other);
    }
}

/* Speeds are those of frames that follow each other; the first one's are those towards the second. */
TEST(kept_frames_have_speeds)
{
    cgt_figure *const figure = make_figure();
    cgt_figure_data data = grains();
    cgt_figure_frame *frame[4];
    char text[300];
    const uint64_t numbered[] = {0, 1, 0, 3};
    for (int k = 0; k < 4; k++) {
        data.number = numbered[k];
        data.step = (int64_t)numbered[k];
        place[7][1] += 0.25f * (float)data.number;
        frame[k] = keep(figure, &data);
        place[7][1] -= 0.25f * (float)data.number;
        assert_int_equal(cgt_figure_frame_get_data(frame[k])->number, numbered[k]);
        assert_true(cgt_figure_frame_get_bytes(frame[k]) > 16 * GRAINS);
        assert_int_equal(cgt_figure_show_frame(figure, frame[k]), CGT_OK);
        cgt_figure_describe(figure, 7, text, sizeof text);
        assert_int_equal(strstr(text, "\nspeed  0.25\n") != NULL, k == 1 || k == 2);
    }
    for (int k = 0; k < 4; k++)
        cgt_figure_frame_release(frame[k]);
    cgt_figure_release(figure);
}

TEST(frames_are_kept_after_the_call_for_it)
{
    cgt_figure *const figure = make_figure();
    cgt_figure_data data = grains();
    cgt_figure_frame *frame;
    char text[100];
    uint64_t lead;
    assert_int_equal(cgt_figure_keep(figure, &data, &frame, text, sizeof text), CGT_ERROR_INVALID_ARGUMENT);
    assert_null(frame);
    assert_string_equal(text, "cgt_figure_begin_keep comes first");
    assert_int_equal(cgt_figure_set(figure, "trails", "5"), CGT_OK);
    assert_int_equal(cgt_figure_begin_keep(figure, &lead), CGT_OK);
    assert_int_equal(lead, 5);
    data.points.positions.data = NULL;
    assert_int_equal(cgt_figure_keep(figure, &data, NULL, text, sizeof text), CGT_ERROR_INVALID_ARGUMENT);
    assert_string_equal(text, "positions: there is no array");
    cgt_figure_frame_release(NULL);
    cgt_figure_release(figure);
}

/* ---- Pictures in parts -------------------------------------------------------------------------------------- */

TEST(steps_make_the_whole_picture)
{
    cgt_figure *const figure = make_figure();
    const cgt_figure_data data = grains();
    uint8_t whole[BYTES], steps[BYTES];
    const cgt_image image = {.bytes = steps};
    uint32_t left = 0, count = 0;
    assert_int_equal(cgt_figure_begin(figure), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "nothing is shown");
    assert_int_equal(cgt_figure_step(figure, 1, &left), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_read(figure, &image), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "no picture has begun");
    assert_int_equal(cgt_figure_set(figure, "antialias", "1"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "light-size", "5"), CGT_OK);
    draw(figure, &data, whole);
    assert_int_equal(cgt_figure_begin(figure), CGT_OK);
    do {
        assert_int_equal(cgt_figure_step(figure, 1, &left), CGT_OK);
        count++;
    } while (left);
    assert_true(count > 4);
    assert_int_equal(cgt_figure_read(figure, &image), CGT_OK);
    assert_memory_equal(steps, whole, sizeof whole);
    cgt_figure_release(figure);
}

/* A picture ends with the scene that it is of. */
TEST(steps_end_with_the_frame)
{
    cgt_figure *const figure = make_figure();
    const cgt_figure_data data = grains();
    uint8_t rgb[BYTES];
    const cgt_image image = {.bytes = rgb};
    uint32_t left;
    cgt_figure_frame *const one = keep(figure, &data), *const other = keep(figure, &data);
    assert_int_equal(cgt_figure_show_frame(figure, one), CGT_OK);
    assert_int_equal(cgt_figure_begin(figure), CGT_OK);
    assert_int_equal(cgt_figure_draw_quick(figure, CGT_FIGURE_SHADOWS, 2, &image), CGT_OK);
    assert_int_equal(cgt_figure_step(figure, 1, &left), CGT_OK);
    assert_int_equal(cgt_figure_show_frame(figure, other), CGT_OK);
    assert_int_equal(cgt_figure_step(figure, 1, &left), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "no picture has begun");
    assert_int_equal(cgt_figure_begin(figure), CGT_OK);
    assert_int_equal(cgt_figure_draw(figure, &image, NULL), CGT_OK);
    assert_int_equal(cgt_figure_step(figure, 1, &left), CGT_OK);
    cgt_figure_frame_release(other);
    assert_int_equal(cgt_figure_read(figure, &image), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "no picture has begun");
    cgt_figure_frame_release(one);
    cgt_figure_release(figure);
}

static bool always(const void *user)
{
    (void)user;
    return true;
}

/* In plain style a quick picture is the picture; a shrunk one has blocks of pixels. */
TEST(quick_pictures_are_plain)
{
    cgt_figure *const figure = make_figure();
    const cgt_figure_data data = grains();
    static uint8_t whole[BYTES], quick[BYTES], four[4 * WIDTH * HEIGHT];
    const cgt_image image = {.bytes = quick}, wide = {.bytes = four, .channels = 4, .row_stride = 4 * WIDTH},
                    none = {.channels = 3}, gaps = {.bytes = four, .row_stride = 4 * WIDTH};
    assert_int_equal(cgt_figure_set(figure, "antialias", "1"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "style", "plain"), CGT_OK);
    draw(figure, &data, whole);
    cgt_figure_set_stop(figure, always, NULL);
    assert_int_equal(cgt_figure_draw_quick(figure, CGT_FIGURE_PLAIN, 1, &image), CGT_OK);
    assert_memory_equal(quick, whole, sizeof whole);
    assert_int_equal(cgt_figure_draw_quick(figure, CGT_FIGURE_PLAIN, 1, &wide), CGT_OK);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        assert_memory_equal(four + 4 * (ptrdiff_t)i, whole + 3 * (ptrdiff_t)i, 3);
    assert_int_equal(cgt_figure_draw_quick(figure, CGT_FIGURE_SHADOWS, 3, &image), CGT_OK);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            assert_memory_equal(quick + 3 * ((ptrdiff_t)y * WIDTH + x),
                                quick + 3 * ((ptrdiff_t)(y / 3 * 3) * WIDTH + x / 3 * 3), 3);
    assert_int_equal(cgt_figure_draw_quick(figure, CGT_FIGURE_PLAIN, 0, &image), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_draw_quick(figure, CGT_FIGURE_PLAIN, 1, &none), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_draw_quick(figure, CGT_FIGURE_PLAIN, 1, &gaps), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "a quick picture is one of bytes");
    assert_int_equal(cgt_figure_set(figure, "style", "soft"), CGT_OK);
    assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
    assert_int_equal(cgt_figure_draw(figure, &image, NULL), CGT_ERROR_STOPPED);
    cgt_figure_release(figure);
}

/* What a pixel shows is the grain in front, by its number in the data, also where others are hidden. */
TEST(pixels_are_picked)
{
    cgt_figure *const figure = make_figure();
    const cgt_figure_data data = grains();
    cgt_figure_hit hit;
    char text[200];
    uint32_t hits = 0;
    assert_int_equal(cgt_figure_pick(figure, 1, 1, &hit), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_set(figure, "show", "heat > 2"), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "bonds", "1.2"), CGT_OK);
    cgt_figure_frame *const frame = keep(figure, &data);
    assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        assert_int_equal(cgt_figure_pick(figure, i % WIDTH, i / WIDTH, &hit), CGT_OK);
        if (!hit.is_data)
            continue;
        double square = 0.0;
        for (int c = 0; c < 3; c++)
            square += pow((double)hit.place[c] - (double)place[hit.element][c], 2.0);
        assert_true(fabs(sqrt(square) - 0.4) < 1e-3 && heat[hit.element] > 2.0f);
        hits++;
    }
    assert_true(hits > 100);
    snprintf(text, sizeof text, "sphere 10\nat  0, 2, 0\nradius  0.4\nheat  3\n");
    char told[200];
    assert_int_equal(cgt_figure_describe(figure, 10, told, sizeof told), strlen(text));
    assert_string_equal(told, text);
    assert_int_equal(cgt_figure_describe(figure, 10, told, 12), strlen(text));
    assert_string_equal(told, "sphere 10\na");
    assert_int_equal(cgt_figure_describe(figure, GRAINS, told, sizeof told), 0);
    cgt_figure_release(figure);
    cgt_figure_frame_release(frame);
}

SEEDED_SUITE("test_figure", make_grains, release_context)

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Formulas over columns in cgt-render: values, bindings, and formulas that are refused. */
#include "support/suite.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "picture/color/coloring.h"
#include "picture/figures/expression.h"
#include "picture/color/srgb.h"

enum { COUNT = 300 }; /* more than a block */

static float xyzr[4 * COUNT], energy[COUNT];
static uint32_t type[COUNT];
static uint8_t element[COUNT];

static trajectory_frame make_frame(void)
{
    static trajectory_column columns[2];
    trajectory_frame f = {.number = 3, .kind = TRAJECTORY_SPHERES, .step = 700, .count = COUNT, .time = 3.5};
    for (uint32_t i = 0; i < COUNT; i++) {
        xyzr[4 * i] = (float)i;
        xyzr[4 * i + 1] = 2.0f;
        xyzr[4 * i + 2] = -1.0f;
        xyzr[4 * i + 3] = 0.5f;
        energy[i] = -0.5f * (float)i;
        type[i] = 1 + i % 3;
        element[i] = i % 2 ? 8 : 1;
    }
    columns[0] = (trajectory_column){.name = "c_pe[1]", .kind = TRAJECTORY_NUMBER, .value = energy};
    columns[1] = (trajectory_column){.name = "unread", .kind = TRAJECTORY_NUMBER};
    f.xyzr = xyzr;
    f.type = type;
    f.element = element;
    f.columns = 2;
    f.column = columns;
    return f;
}

/* The value of a formula for a sphere. */
static double value(const char *text, uint32_t i)
{
    char error[512] = "";
    const trajectory_frame frame = make_frame();
    double values[COUNT];
    expression *e = expression_parse(text, error, sizeof error);
    if (!e || expression_bind(e, &frame, NULL, error, sizeof error))
        fail_msg("%s", error);
    expression_values(e, 0, COUNT, values);
    expression_free(e);
    return values[i];
}

TEST(formulas_have_their_values)
{
    static const struct {
        const char *text;
        double value; /* of sphere 257: x 257, y 2, z -1, type 3, c_pe[1] -128.5 */
    } rows[] = {
        {"x", 257.0},
        {"1 + 2 * 3", 7.0},
        {"(1 + 2) * 3", 9.0},
        {"8 - 4 - 2", 2.0},
        {"16 / 4 / 2", 2.0},
        {"2 ^ 3 ^ 2", 512.0},
        {"-2 ^ 2", -4.0},
        {"2 ^ -1", 0.5},
        {"sqrt(x^2 + y^2 - 4)", 257.0},
        {"c_pe[1] / z", 128.5},
        {"min(x, 3) + max(y, z)", 5.0},
        {"mod(x, 10)", 7.0},
        {"if(type == 3, 10, 20)", 10.0},
        {"type != 3 || x >= 257 && y < 3", 1.0},
        {"!(x > 5)", 0.0},
        {"abs(floor(-2.5)) + ceil(0.2) + sign(z)", 3.0},
        {"log10(1e3) + log(exp(2))", 5.0},
        {"cos(pi) + sin(0) + tan(0)", -1.0},
        {"step + time + index", 700.0 + 3.5 + 257.0},
        {"element", 8.0},
        {"radius * 2", 1.0},
        {"x <= 257 == 1", 1.0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const double got = value(rows[i].text, 257);
        if (!(fabs(got - rows[i].value) < 1e-9))
            fail_msg("%s is %.17g, not %.17g", rows[i].text, got, rows[i].value);
    }
    assert_true(isnan(value("sqrt(z)", 0)));
}

TEST(wrong_formulas_are_refused)
{
    static const char *const wrong[] = {"",        "1 +",     "(x",    "x)",       "foo(x)", "min(x)", "min(x, y, z)",
                                        "x y",     "3 * * 4", "sqrt(", "1e",       "$x",     "x = 3",  "x & y",
                                        "if(x,1)", "..5",     "x^",    "min(x,,y)"};
    char error[512], deep[2000];
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        *error = '\0';
        expression *e = expression_parse(wrong[i], error, sizeof error);
        if (e && strcmp(wrong[i], "1e") != 0)
            fail_msg("\"%s\" was taken", wrong[i]);
        assert_true(e || strstr(error, "at character"));
        expression_free(e);
    }
    memset(deep, '(', sizeof deep);
    deep[sizeof deep - 1] = '\0';
    assert_null(expression_parse(deep, error, sizeof error));
    memset(deep, '-', sizeof deep - 1);
    assert_null(expression_parse(deep, error, sizeof error));
    for (size_t i = 0; i + 4 < sizeof deep; i += 3)
        memcpy(deep + i, "1^(", 4);
    assert_null(expression_parse(deep, error, sizeof error));
}

TEST(missing_columns_are_named)
{
    char error[512];
    const trajectory_frame frame = make_frame();
    static const char *const wrong[] = {"speed", "unread + 1", "id"};
    for (int i = 0; i < 3; i++) {
        expression *e = expression_parse(wrong[i], error, sizeof error);
        assert_non_null(e);
        assert_int_equal(expression_bind(e, &frame, NULL, error, sizeof error), -1);
        assert_non_null(strstr(error, "c_pe[1]"));
        expression_free(e);
    }
    float speed[COUNT] = {4.0f};
    expression *e = expression_parse("speed", error, sizeof error);
    size_t names;
    assert_string_equal(expression_names(e, &names)[0], "speed");
    assert_int_equal(names, 1);
    assert_int_equal(expression_bind(e, &frame, speed, error, sizeof error), 0);
    double first;
    expression_values(e, 0, 1, &first);
    assert_true(first == 4.0);
    expression_free(e);
}

TEST(colours_follow_formulas_and_kinds)
{
    static coloring c;
    char error[512];
    const trajectory_frame frame = make_frame();
    expression *e = expression_parse("x", error, sizeof error);
    assert_int_equal(expression_bind(e, &frame, NULL, error, sizeof error), 0);
    assert_int_equal(coloring_init(&c, COLORING_VALUE, NULL, 1.0f, 100.0f), 0);
    c.formula = e;
    assert_int_equal(coloring_apply(&c, &frame, NULL), 0);
    assert_int_equal(c.index[1], 0);
    assert_int_equal(c.index[299], COLORING_STEPS - 1);
    assert_in_range(c.index[50], 505, 508); /* 49 / 99 of the way */
    c.logarithmic = 1;
    assert_int_equal(coloring_apply(&c, &frame, NULL), 0);
    assert_in_range(c.index[10], 510, 513); /* halfway from 1 to 100 */
    assert_int_equal(c.index[0], 0);        /* 0 is below every range */
    coloring_free(&c);
    expression_free(e);

    assert_int_equal(coloring_init(&c, COLORING_ELEMENT, NULL, 0.0f, 0.0f), 0);
    assert_int_equal(coloring_apply(&c, &frame, NULL), 0);
    const float *oxygen = c.palette[c.index[1]], *hydrogen = c.palette[c.index[0]];
    assert_true(oxygen[0] == 1.0f && oxygen[1] < 0.01f && hydrogen[2] == 1.0f); /* red, white */
    coloring_free(&c);
    assert_int_equal(coloring_init(&c, COLORING_TYPE, NULL, 0.0f, 0.0f), 0);
    coloring_set_kind(&c, 3, (const float[]){0.0f, 1.0f, 0.0f});
    assert_int_equal(coloring_apply(&c, &frame, NULL), 0);
    assert_true(c.palette[c.index[2]][1] == 1.0f && c.palette[c.index[2]][0] == 0.0f);
    assert_true(c.palette[c.index[1]][1] != 1.0f);
    coloring_free(&c);
}

SUITE(NULL, NULL)

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Formulas over columns in cgt-render: values, bindings, and formulas that are refused. */
#include "support/suite.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "color/coloring.h"
#include "data/expression/expression.h"
#include <cgt/picture.h>

enum { COUNT = 300 }; /* more than a block */

static float xyzr[4 * COUNT], energy[COUNT];
static uint32_t type[COUNT];
static uint8_t element[COUNT];

static cgt_trajectory_frame make_frame(void)
{
    static cgt_trajectory_column columns[2];
    cgt_trajectory_frame f = {.number = 3, .kind = CGT_TRAJECTORY_SPHERES, .step = 700, .count = COUNT, .time = 3.5};
    for (uint32_t i = 0; i < COUNT; i++) {
        xyzr[4 * i] = (float)i;
        xyzr[4 * i + 1] = 2.0f;
        xyzr[4 * i + 2] = -1.0f;
        xyzr[4 * i + 3] = 0.5f;
        energy[i] = -0.5f * (float)i;
        type[i] = 1 + i % 3;
        element[i] = i % 2 ? 8 : 1;
    }
    columns[0] = (cgt_trajectory_column){.name = "c_pe[1]", .kind = CGT_TRAJECTORY_NUMBER, .value = energy};
    columns[1] = (cgt_trajectory_column){.name = "unread", .kind = CGT_TRAJECTORY_NUMBER};
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
    const cgt_trajectory_frame frame = make_frame();
    double values[COUNT];
    expression *e = cgt_expression_parse(text, error, sizeof error);
    if (!e || cgt_expression_bind(e, &frame, NULL, error, sizeof error))
        fail_msg("%s", error);
    cgt_expression_values(e, 0, COUNT, values);
    cgt_expression_free(e);
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
        {"sqrt(z) && 1", 0.0}, /* NaN is no */
        {"0 || sqrt(z)", 0.0},
        {"!sqrt(z)", 1.0},
        {"if(sqrt(z), 1, 2)", 2.0},
        {"if(type == 3, 10, 20)", 10.0},
        {"if(z, 10, 20)", 10.0},
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
        expression *e = cgt_expression_parse(wrong[i], error, sizeof error);
        if (e && strcmp(wrong[i], "1e") != 0)
            fail_msg("\"%s\" was taken", wrong[i]);
        assert_true(e || strstr(error, "at character"));
        cgt_expression_free(e);
    }
    memset(deep, '(', sizeof deep);
    deep[sizeof deep - 1] = '\0';
    assert_null(cgt_expression_parse(deep, error, sizeof error));
    memset(deep, '-', sizeof deep - 1);
    assert_null(cgt_expression_parse(deep, error, sizeof error));
    for (size_t i = 0; i + 4 < sizeof deep; i += 3)
        memcpy(deep + i, "1^(", 4);
    assert_null(cgt_expression_parse(deep, error, sizeof error));
}

TEST(missing_columns_are_named)
{
    char error[512];
    const cgt_trajectory_frame frame = make_frame();
    static const char *const wrong[] = {"speed", "unread + 1", "id"};
    for (int i = 0; i < 3; i++) {
        expression *e = cgt_expression_parse(wrong[i], error, sizeof error);
        assert_non_null(e);
        assert_int_equal(cgt_expression_bind(e, &frame, NULL, error, sizeof error), -1);
        assert_non_null(strstr(error, "c_pe[1]"));
        cgt_expression_free(e);
    }
    float speed[COUNT] = {4.0f};
    expression *e = cgt_expression_parse("speed", error, sizeof error);
    size_t names;
    assert_string_equal(cgt_expression_names(e, &names)[0], "speed");
    assert_int_equal(names, 1);
    assert_int_equal(cgt_expression_bind(e, &frame, speed, error, sizeof error), 0);
    double first;
    cgt_expression_values(e, 0, 1, &first);
    assert_true(first == 4.0);
    cgt_expression_free(e);
}

/* Atoms of two chains, water, and an ion; a blank chain; a column of numbers. */
static cgt_trajectory_frame make_molecules(void)
{
    enum { ATOMS = 10 };
    static const char names[][64] = {"N", "CA", "C", "O", "CB", "OW"};
    static const char residues[][64] = {"ALA", "HISE", "HOH", "CA", "GLYC", "NALA", "TIP3P"};
    static const char chains[][64] = {"A", "1", "x"};
    /*                                 0  1  2  3  4  5  6  7  8  9 */
    static const float name[ATOMS] = {1, 2, 3, 4, 5, 6, 2, 2, 3, 6};
    static const float residue[ATOMS] = {1, 1, 2, 2, 6, 3, 4, 5, 5, 7};
    static const float chain[ATOMS] = {1, 1, 2, 2, 3, 0, 0, 1, 2, 3};
    static const uint8_t elements[ATOMS] = {7, 6, 6, 8, 6, 8, 20, 6, 6, 8};
    static const cgt_trajectory_column columns[] = {{"name", CGT_TRAJECTORY_WORD, name, 6, names},
                                                    {"resname", CGT_TRAJECTORY_WORD, residue, 7, residues},
                                                    {"chain", CGT_TRAJECTORY_WORD, chain, 3, chains},
                                                    {"x", CGT_TRAJECTORY_NUMBER, NULL, 0, NULL},
                                                    {"charge", CGT_TRAJECTORY_NUMBER, name, 0, NULL}};
    cgt_trajectory_frame f = {.kind = CGT_TRAJECTORY_SPHERES, .count = ATOMS, .element = elements};
    f.xyzr = xyzr;
    f.columns = 5;
    f.column = columns;
    return f;
}

TEST(words_choose_atoms)
{
    static const struct {
        const char *text, *atoms; /* for which it is 1 */
    } rows[] = {
        {"chain == \"A\"", "0 1 7"},
        {"chain == A", "0 1 7"},
        {"chain != 'A'", "2 3 4 5 6 8 9"},
        {"chain == \"\"", "5 6"},
        {"chain == \"1\"", "2 3 8"},
        {"chain == 'x'", "4 9"},
        {"chain == B", ""},
        {"(name) == CA", "1 6 7"},
        {"name == CA && element == C", "1 7"},
        {"name == CA and not element == Ca", "1 7"},
        {"not name == CA and name != C", "0 3 4 5 9"},
        {"not not name == CA", "1 6 7"},
        {"element == 'o'", "3 5 9"},
        {"element != O and element != C", "0 6"},
        {"element == 8", "3 5 9"},
        {"protein", "0 1 2 3 4"},
        {"water", "5 9"},
        {"!protein && !water", "6 7 8"},
        {"backbone", "0 1 2 3"},
        {"protein and not backbone or water", "4 5 9"},
        {"charge == charge", "0 1 2 3 4 5 6 7 8 9"},
        {"charge == index + 1", "0 1 2 3 4 5"},
        {"if(chain == A, 1, name == OW)", "0 1 5 7 9"},
    };
    char error[512] = "";
    const cgt_trajectory_frame frame = make_molecules();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double values[16];
        char atoms[64] = "";
        expression *e = cgt_expression_parse(rows[i].text, error, sizeof error);
        if (!e || cgt_expression_bind(e, &frame, NULL, error, sizeof error))
            fail_msg("%s: %s", rows[i].text, error);
        cgt_expression_values(e, 0, frame.count, values);
        cgt_expression_free(e);
        for (uint32_t k = 0; k < frame.count; k++)
            if (values[k] != 0.0)
                snprintf(atoms + strlen(atoms), sizeof atoms - strlen(atoms), *atoms ? " %u" : "%u", k);
        if (strcmp(atoms, rows[i].atoms) != 0)
            fail_msg("%s: %s", rows[i].text, atoms);
    }
}

TEST(words_that_do_not_fit_are_refused)
{
    static const struct {
        const char *text, *problem;
    } rows[] = {
        {"chain == 1", "compare by == or != with one in quotes, \"1\""},
        {"chain < 2", "compare by == or !="},
        {"1 == chain", "compare by == or != with one in quotes, \"1\""},
        {"chain + 0 == 1", "compare by == or != with one in quotes, \""},
        {"chain * x", "compare by == or != with one in quotes, \""},
        {"-chain", "compare by == or !="},
        {"x + (chain == chain)", "write the word in quotes"},
        {"if(x > 0, 1, chain)", "compare by == or !="},
        {"max(chain, 2)", "compare by == or !="},
        {"chain == x", "write the word in quotes"},
        {"charge == chain", "has words in the column \"chain\": compare by == or !="},
        {"charge == 'A'", "it is never the word \"A\""},
        {"charge == A", "no column \"A\", but x, y, z, name"},
        {"element == Xx", "\"Xx\" is none"},
        {"mass == A", "no column \"mass\""},
        {"segment == 'A'", "no column \"segment\""},
        {"chain == (", "ends too early"},
        {"\"A\" == chain", "on the right of =="},
        {"chain < \"A\"", "on the right of =="},
        {"1 == 'A'", "on the right of =="},
        {"chain == \"A", "quote at the end"},
        {"chain and", "ends too early"},
    };
    char error[1536] = "";
    cgt_trajectory_frame frame = make_molecules();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        expression *e = cgt_expression_parse(rows[i].text, error, sizeof error);
        if ((e && !cgt_expression_bind(e, &frame, NULL, error, sizeof error)) || !strstr(error, rows[i].problem))
            fail_msg("%s: %s", rows[i].text, error);
        cgt_expression_free(e);
    }
    char many[1024] = "chain == A";
    for (int i = 0; i < 32; i++)
        strcat(many, " or chain == A");
    assert_null(cgt_expression_parse(many, error, sizeof error));
    assert_non_null(strstr(error, "too many words"));
    memset(many, 0, sizeof many);
    for (int i = 0; i < 201; i++)
        strcat(many, "not ");
    assert_null(cgt_expression_parse(many, error, sizeof error));
    assert_non_null(strstr(error, "nested too deeply"));

    frame.columns = 1; /* the name alone */
    expression *e = cgt_expression_parse("backbone", error, sizeof error);
    assert_int_equal(cgt_expression_bind(e, &frame, NULL, error, sizeof error), -1);
    assert_non_null(strstr(error, "no column \"resname\", by which to know protein, but x, y, z, name"));
    const cgt_trajectory_column numbers = {"resname", CGT_TRAJECTORY_WHOLE, xyzr, 0, NULL};
    cgt_trajectory_column two[2] = {frame.column[0], numbers};
    frame.columns = 2;
    frame.column = two;
    assert_int_equal(cgt_expression_bind(e, &frame, NULL, error, sizeof error), -1);
    assert_non_null(strstr(error, "numbers in the column \"resname\", by which to know protein"));
    cgt_expression_free(e);
}

TEST(colours_follow_formulas_and_kinds)
{
    static coloring c;
    char error[512];
    const cgt_trajectory_frame frame = make_frame();
    expression *e = cgt_expression_parse("x", error, sizeof error);
    assert_int_equal(cgt_expression_bind(e, &frame, NULL, error, sizeof error), 0);
    assert_int_equal(cgt_coloring_init(&c, COLORING_VALUE, NULL, 1.0f, 100.0f), 0);
    c.formula = e;
    assert_int_equal(cgt_coloring_apply(&c, &frame, NULL), 0);
    assert_int_equal(c.index[1], 0);
    assert_int_equal(c.index[299], COLORING_STEPS - 1);
    assert_in_range(c.index[50], 505, 508); /* 49 / 99 of the way */
    c.logarithmic = 1;
    assert_int_equal(cgt_coloring_apply(&c, &frame, NULL), 0);
    assert_in_range(c.index[10], 510, 513); /* halfway from 1 to 100 */
    assert_int_equal(c.index[0], 0);        /* 0 is below every range */
    cgt_coloring_free(&c);
    cgt_expression_free(e);
    e = cgt_expression_parse("(x - 1) / 0", error, sizeof error);
    assert_int_equal(cgt_expression_bind(e, &frame, NULL, error, sizeof error), 0);
    assert_int_equal(cgt_coloring_init(&c, COLORING_VALUE, NULL, 1.0f, 100.0f), 0);
    c.formula = e;
    assert_int_equal(cgt_coloring_apply(&c, &frame, NULL), 0);
    for (int i = 0; i < 3; i++) /* infinite, or no number */
        assert_int_equal(c.index[i], COLORING_UNKNOWN);
    cgt_coloring_free(&c);
    cgt_expression_free(e);

    assert_int_equal(cgt_coloring_init(&c, COLORING_ELEMENT, NULL, 0.0f, 0.0f), 0);
    assert_int_equal(cgt_coloring_apply(&c, &frame, NULL), 0);
    const float *oxygen = c.palette[c.index[1]], *hydrogen = c.palette[c.index[0]];
    assert_true(oxygen[0] == 1.0f && oxygen[1] < 0.01f && hydrogen[2] == 1.0f); /* red, white */
    cgt_coloring_free(&c);
    assert_int_equal(cgt_coloring_init(&c, COLORING_TYPE, NULL, 0.0f, 0.0f), 0);
    cgt_coloring_set_kind(&c, 3, (const float[]){0.0f, 1.0f, 0.0f});
    assert_int_equal(cgt_coloring_apply(&c, &frame, NULL), 0);
    assert_true(c.palette[c.index[2]][1] == 1.0f && c.palette[c.index[2]][0] == 0.0f);
    assert_true(c.palette[c.index[1]][1] != 1.0f);
    const uint16_t low = cgt_coloring_entry_of_kind(&c, 2), high = cgt_coloring_entry_of_kind(&c, 2 + COLORING_STEPS);
    assert_int_equal(low, high); /* beyond the palette colours begin again, */
    assert_true(cgt_coloring_entry_of_kind(&c, 3 + COLORING_STEPS) < COLORING_STEPS); /* but not those that are given */
    cgt_coloring_set_kind(&c, 2 + COLORING_STEPS, (const float[]){0.0f, 0.0f, 1.0f});
    assert_int_equal(cgt_coloring_entry_of_kind(&c, 2), low);
    assert_true(c.palette[cgt_coloring_entry_of_kind(&c, 2 + COLORING_STEPS)][2] == 1.0f);
    cgt_coloring_free(&c);
}

SUITE(NULL, NULL)

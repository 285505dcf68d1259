/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Distances, angles and dihedrals: known values, points that have none, and nearest images beside those that a search
 * of all images finds. */
#include "support/suite.h"

#include <math.h>
#include <string.h>

#include "data/measure.h"
#include "support/test.h"

static const periodic_box open = {.near = INFINITY};

/* A box by its edges, periodic along those whose bit is set. */
static periodic_box make_box(const double edge[3][3], int bits)
{
    cgt_trajectory_frame f = {0};
    memcpy(f.box_edge, edge, sizeof f.box_edge);
    for (int e = 0; e < 3; e++)
        f.periodic[e] = (int8_t)(bits >> e & 1);
    return cgt_periodic_box_of(&f);
}

TEST(known_values)
{
    static const struct {
        uint32_t count;
        float point[4][3];
        double value;
    } rows[] = {
        {2, {{1, 2, 3}, {4, 6, 3}}, 5},
        {2, {{1, 2, 3}, {1, 2, 3}}, 0},
        {2, {{-1e6f, 0, 0}, {1e6f, 0, 0}}, 2e6},
        {3, {{1, 0, 0}, {0, 0, 0}, {0, 2, 0}}, 90},
        {3, {{1, 1, 1}, {0, 0, 0}, {-1, -1, 1}}, 109.47122063449069}, /* of a tetrahedron */
        {3, {{1, 2, 3}, {2, 4, 6}, {3, 6, 9}}, 180},
        {3, {{3, 6, 9}, {1, 2, 3}, {2, 4, 6}}, 0},
        {3, {{1, 0, 0}, {0, 0, 0}, {1, 0.001f, 0}}, 0.05729575684},
        {4, {{1, 0, 0}, {0, 0, 0}, {0, 0, 1}, {1, 0, 1}}, 0},    /* cis */
        {4, {{1, 0, 0}, {0, 0, 0}, {0, 0, 1}, {-1, 0, 1}}, 180}, /* trans */
        {4, {{1, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, 1, 1}}, 90},   /* clockwise, seen along z */
        {4, {{1, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, -1, 1}}, -90},
        {4, {{2, 0, 5}, {0, 0, 0}, {0, 0, 3}, {1, 1, -7}}, 45},
        {4, {{0, 1, 1}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}}, 90}, /* backwards it is the same */
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double value = NAN;
        if (!cgt_measure(&open, rows[i].point, rows[i].count, &value) ||
            !(fabs(value - rows[i].value) <= 1e-7 * fmax(1.0, fabs(rows[i].value))))
            fail_msg("row %zu: %.12g, not %.12g", i, value, rows[i].value);
    }
}

TEST(no_value_where_there_is_none)
{
    static const struct {
        const char *what;
        uint32_t count;
        float point[5][3];
    } rows[] = {
        {"one point", 1, {{1, 2, 3}}},
        {"five points", 5, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {2, 2, 2}}},
        {"a number is missing", 2, {{1, 2, 3}, {1, NAN, 3}}},
        {"far beyond", 2, {{1, 2, 3}, {1, INFINITY, 3}}},
        {"the first two coincide", 3, {{1, 2, 3}, {1, 2, 3}, {4, 4, 4}}},
        {"the last two coincide", 3, {{4, 4, 4}, {1, 2, 3}, {1, 2, 3}}},
        {"the middle two coincide", 4, {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}}},
        {"the first three on a line", 4, {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 0, 0}}},
        {"the last three on a line", 4, {{3, 0, 0}, {0, 0, 0}, {1, 1, 1}, {-2, -2, -2}}},
        {"on a line but for rounding", 4, {{0.1f, 0.2f, 0.3f}, {0.7f, 1.4f, 2.1f}, {1.1f, 2.2f, 3.3f}, {0, 0, 9}}},
        {"all on a line far away", 4, {{1e6f, 0, 0}, {1e6f, 1, 0}, {1e6f, 2.0625f, 0}, {1000001, 3, 0}}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double value = 7.0;
        if (cgt_measure(&open, rows[i].point, rows[i].count, &value) || value != 7.0)
            fail_msg("%s: %g", rows[i].what, value);
    }
}

TEST(steps_go_to_the_nearest_image)
{
    const double edge[3][3] = {{10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
    const periodic_box box = make_box(edge, 7), slab = make_box(edge, 3);
    const float far[2][3] = {{0.5f, 5, 0.5f}, {9.5f, 5, 9.5f}};
    const float corner[3][3] = {{9, 5, 5}, {0.5f, 5, 5}, {0.5f, 6, 5}};    /* through the boundary */
    const float turn[4][3] = {{1, 5, 0}, {0, 5, 0}, {0, 5, 9}, {0, 4, 9}}; /* the axis goes down through it */
    double value;
    assert_true(cgt_measure(&box, far, 2, &value));
    assert_true(fabs(value - sqrt(2.0)) < 1e-12);
    assert_true(cgt_measure(&slab, far, 2, &value)); /* z is not periodic */
    assert_true(fabs(value - sqrt(82.0)) < 1e-12);
    assert_true(cgt_measure(&box, corner, 3, &value));
    assert_true(fabs(value - 90.0) < 1e-12);
    assert_true(cgt_measure(&box, turn, 4, &value));
    assert_true(fabs(value - 90.0) < 1e-12);
    assert_true(cgt_measure(&open, turn, 4, &value));
    assert_true(fabs(value + 90.0) < 1e-12);
}

static double size_of(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static void add(double v[3], double times, const double edge[3])
{
    for (int c = 0; c < 3; c++)
        v[c] += times * edge[c];
}

/* The least that an image of a vector has, of parts up to 1, in a box whose edges are at least 1 along their own axis
 * and tilted by half at most. An image no longer than it differs from it by 2.8 along z: 2 edges; along y by 2.8 and
 * what these are tilted by: 3; along x: 5. */
static double search_images(const double edge[3][3], int bits, const double vector[3])
{
    enum { AROUND = 5 };
    double least = INFINITY;
    for (int x = -AROUND; x <= AROUND; x++)
        for (int y = -AROUND; y <= AROUND; y++)
            for (int z = -AROUND; z <= AROUND; z++) {
                double image[3] = {vector[0], vector[1], vector[2]};
                add(image, bits & 1 ? x : 0, edge[0]);
                add(image, bits & 2 ? y : 0, edge[1]);
                add(image, bits & 4 ? z : 0, edge[2]);
                least = fmin(least, size_of(image));
            }
    return least;
}

TEST(no_image_is_nearer)
{
    enum { BOXES = 400, VECTORS = 20 };
    test_random random = random_make(1);
    uint32_t farther = 0;
    for (int i = 0; i < BOXES; i++) {
        const int bits = 1 + (int)random_below(&random, 7);
        double edge[3][3] = {{0}}, given[3][3];
        for (int e = 0; e < 3; e++) {
            edge[e][e] = (double)random_float(&random, 1.0f, 2.0f);
            for (int c = 0; c < e; c++)
                edge[e][c] = edge[c][c] * (double)random_float(&random, -0.5f, 0.5f);
        }
        memcpy(given, edge, sizeof given); /* the same lattice, tilted as far as files have it and further */
        for (int e = 0; e < 3; e++)
            for (int k = 0; k < e; k++)
                if (bits >> k & 1)
                    add(given[e], (double)random_below(&random, 5) - 2.0, edge[k]);
        const periodic_box box = make_box(given, bits);
        for (int n = 0; n < VECTORS; n++) {
            double vector[3], found[3], rounded[3];
            for (int c = 0; c < 3; c++)
                vector[c] = (double)random_float(&random, -1.0f, 1.0f);
            const double least = search_images(edge, bits, vector);
            for (int e = 0; e < 3; e++)
                if (bits >> e & 1)
                    add(vector, (double)random_below(&random, 7) - 3.0, given[e]);
            memcpy(found, vector, sizeof found);
            memcpy(rounded, vector, sizeof rounded);
            cgt_nearest_image(&box, found);
            for (int e = 0; e < 3; e++)
                add(rounded, -rint(cgt_periodic_box_share(&box, e, vector)), given[e]);
            farther += size_of(rounded) > least + 1e-9;
            if (!(fabs(size_of(found) - least) < 1e-9))
                fail_msg("box %d, vector %d: %g, but an image is at %g", i, n, size_of(found), least);
        }
    }
    assert_true(farther > 1000); /* else the shares of edges alone would do */
}

SEEDED_SUITE("test_measure", NULL, NULL)

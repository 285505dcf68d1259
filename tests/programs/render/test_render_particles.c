/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What cgt-render draws: spheres chosen, sized and repeated by rules; sticks, boxes, bonds and arrows. */
#include "support/suite.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/shapes.h"

enum { COUNT = 300 };

static float xyzr[4 * COUNT];
static uint32_t type[COUNT], bond[4] = {0, 1, 2, 3};
static uint16_t entry[COUNT];

static float random_float(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) * 0x1p-24f;
}

/* Random spheres in a box of edge 10 whose third edge leans by 2 along x. */
static cgt_trajectory_frame make_frame(uint32_t seed)
{
    cgt_trajectory_frame f = {.kind = CGT_TRAJECTORY_SPHERES, .count = COUNT, .xyzr = xyzr, .type = type};
    for (uint32_t i = 0; i < COUNT; i++) {
        for (int c = 0; c < 3; c++)
            xyzr[4 * i + c] = 10.0f * random_float(&seed);
        xyzr[4 * i + 3] = 0.5f;
        type[i] = 1 + i % 3;
        entry[i] = (uint16_t)i;
    }
    const double edge[3][3] = {{10, 0, 0}, {0, 10, 0}, {2, 0, 10}};
    memcpy(f.box_edge, edge, sizeof edge);
    return f;
}

static particle_rules no_rules(void) { return (particle_rules){.radius_scale = 1.0f, .images = {1, 1, 1}}; }

TEST(rules_choose_and_size)
{
    char error[256] = "";
    particles p = {0};
    const cgt_trajectory_frame frame = make_frame(7);
    particle_rules rules = no_rules();
    assert_true(cgt_particle_rules_are_empty(&rules));
    expression *show = cgt_expression_parse("type != 2 && x < 5", error, sizeof error);
    expression *radius = cgt_expression_parse("y - 1", error, sizeof error);
    assert_int_equal(cgt_expression_bind(show, &frame, NULL, error, sizeof error), 0);
    expression *unknown = cgt_expression_parse("sqrt(x - 5)", error, sizeof error);
    assert_int_equal(cgt_expression_bind(radius, &frame, NULL, error, sizeof error), 0);
    assert_int_equal(cgt_expression_bind(unknown, &frame, NULL, error, sizeof error), 0);
    rules.show = show;
    rules.radius_count = 2;
    rules.radii[0] = (particle_kind){.kind = 3, .value = {0.75f}};
    rules.radii[1] = (particle_kind){.kind = 3, .value = {0.25f}}; /* the last one counts */
    rules.radius_scale = 2.0f;
    assert_false(cgt_particle_rules_are_empty(&rules));
    assert_int_equal(cgt_particles_select(&p, &rules, &frame, entry, error, sizeof error), 0);
    uint32_t k = 0;
    for (uint32_t i = 0; i < COUNT; i++) {
        if (type[i] == 2 || xyzr[4 * i] >= 5.0f)
            continue;
        assert_int_equal(p.source[k], i);
        assert_int_equal(p.index[k], entry[i]);
        assert_memory_equal(p.xyzr + 4 * k, xyzr + 4 * i, 12);
        assert_true(p.xyzr[4 * k + 3] == (type[i] == 3 ? 0.5f : 1.0f));
        k++;
    }
    assert_int_equal(p.count, k);
    rules.show = NULL;
    rules.radius = radius; /* negative ones are left out, but not of a type that has one of its own */
    assert_int_equal(cgt_particles_select(&p, &rules, &frame, entry, error, sizeof error), 0);
    for (k = 0; k < p.count; k++)
        assert_true(type[p.source[k]] != 3 || p.xyzr[4 * k + 3] == 0.5f);
    const uint32_t with_types = p.count;
    rules.radius_count = 0;
    assert_int_equal(cgt_particles_select(&p, &rules, &frame, entry, error, sizeof error), 0);
    assert_true(p.count > 200 && p.count < with_types && with_types < COUNT);
    for (k = 0; k < p.count; k++)
        assert_true(fabsf(p.xyzr[4 * k + 3] - 2.0f * (p.xyzr[4 * k + 1] - 1.0f)) < 1e-5f);
    rules = no_rules();
    rules.show = unknown; /* where nothing is known nothing is shown */
    assert_int_equal(cgt_particles_select(&p, &rules, &frame, entry, error, sizeof error), 0);
    k = 0;
    for (uint32_t i = 0; i < COUNT; i++)
        k += xyzr[4 * i] > 5.0f;
    assert_int_equal(p.count, k);
    cgt_particles_free(&p);
    cgt_expression_free(show);
    cgt_expression_free(radius);
    cgt_expression_free(unknown);
}

/* Each layer has its spheres in their order, images included. */
TEST(layers_are_sorted)
{
    char error[256] = "";
    particles p = {0};
    const cgt_trajectory_frame frame = make_frame(11);
    particle_rules rules = no_rules();
    expression *const layer = cgt_expression_parse("if(type == 2, 3, if(type == 3, 1, 0))", error, sizeof error);
    assert_int_equal(cgt_expression_bind(layer, &frame, NULL, error, sizeof error), 0);
    rules.layer = layer;
    rules.images[1] = 2;
    assert_false(cgt_particle_rules_are_empty(&rules));
    for (int turn = 0; turn < 2; turn++) { /* in the same memory again */
        assert_int_equal(cgt_particles_select(&p, &rules, &frame, entry, error, sizeof error), 0);
        assert_int_equal(cgt_particles_sort(&p), 0);
        static const uint32_t of_layer[4] = {1, 3, 0, 2}; /* types */
        assert_int_equal(p.begin[PARTICLE_LAYERS], 2 * COUNT);
        assert_int_equal(p.count, 2 * COUNT);
        for (uint32_t k = 0; k < PARTICLE_LAYERS; k++) {
            assert_int_equal(p.begin[k + 1] - p.begin[k], k < 4 && of_layer[k] ? 2 * COUNT / 3 : 0);
            for (uint32_t i = p.begin[k]; i < p.begin[k + 1]; i++) {
                const uint32_t source = p.source[i], n = i - p.begin[k];
                assert_int_equal(type[source], of_layer[k]);
                assert_int_equal(source, 3 * (n % (COUNT / 3)) + of_layer[k] - 1);
                assert_int_equal(p.index[i], entry[source]);
                assert_true(p.layer[i] == k && p.xyzr[4 * (size_t)i] == xyzr[4 * (size_t)source]);
            }
        }
    }
    cgt_particles_free(&p);
    cgt_expression_free(layer);
}

TEST(images_follow_the_boxes_edges)
{
    char error[256] = "";
    particles p = {0};
    cgt_trajectory_frame frame = make_frame(7);
    particle_rules rules = no_rules();
    rules.images[0] = 2;
    rules.images[2] = 3;
    assert_int_equal(cgt_particles_select(&p, &rules, &frame, entry, error, sizeof error), 0);
    assert_int_equal(p.count, 6 * COUNT);
    const uint32_t copy = 5; /* 1 along a, 2 along c */
    for (uint32_t i = 0; i < COUNT; i++) {
        const float *at = p.xyzr + 4 * (size_t)(copy * COUNT + i);
        assert_true(fabsf(at[0] - xyzr[4 * i] - 14.0f) < 1e-5f && at[1] == xyzr[4 * i + 1]);
        assert_true(fabsf(at[2] - xyzr[4 * i + 2] - 20.0f) < 1e-5f);
        assert_int_equal(p.source[copy * COUNT + i], i);
    }
    memset(frame.box_edge, 0, sizeof frame.box_edge);
    assert_int_equal(cgt_particles_select(&p, &rules, &frame, entry, error, sizeof error), -1);
    assert_non_null(strstr(error, "no box"));
    cgt_particles_free(&p);
}

/* ---- Sticks ------------------------------------------------------------------------------------------------- */

static const float *vertex(const sticks *s, uint32_t triangle, int k)
{
    return s->position + 3 * (size_t)s->index[3 * triangle + k];
}

TEST(sticks_have_two_ends)
{
    sticks s = {0};
    cgt_sticks_clear(&s, 16);
    const float a[3] = {1, 2, 3}, b[3] = {4, -2, 5};
    for (int i = 0; i < 300; i++)
        cgt_sticks_add(&s, i % 2 ? b : a, i % 2 ? a : b, 0.5f, 9, 7);
    cgt_sticks_add(&s, a, a, 0.5f, 9, 9); /* nothing */
    cgt_sticks_add(&s, a, (const float[]){NAN, 0, 0}, 0.5f, 9, 9);
    assert_int_equal(s.count, 300);
    for (uint32_t i = 0; i < s.count; i++) {
        assert_memory_equal(s.end + 6 * i, i % 2 ? b : a, sizeof a);
        assert_memory_equal(s.end + 6 * i + 3, i % 2 ? a : b, sizeof a);
        assert_true(s.radius[i] == 0.5f && s.entry[2 * i] == 9 && s.entry[2 * i + 1] == 7);
    }
    cgt_sticks_free(&s);
}

TEST(cylinders_are_round)
{
    sticks s = {0};
    cgt_sticks_clear(&s, 16);
    const float a[3] = {1, 2, 3}, b[3] = {4, -2, 5};
    cgt_sticks_add_cylinder(&s, a, b, 0.5f, 9);
    assert_int_equal(s.triangles, 32);
    for (uint32_t i = 0; i < s.vertices; i++) {
        /* The distance from the axis, by the cross product, is the radius but for the area's correction. */
        const float *p = s.position + 3 * i, *n = s.normal + 3 * i, d[3] = {3, -4, 2};
        const float v[3] = {p[0] - a[0], p[1] - a[1], p[2] - a[2]};
        const float c[3] = {v[1] * d[2] - v[2] * d[1], v[2] * d[0] - v[0] * d[2], v[0] * d[1] - v[1] * d[0]};
        const float far = sqrtf((c[0] * c[0] + c[1] * c[1] + c[2] * c[2]) / 29.0f);
        assert_true(far > 0.5f && far < 0.52f);
        assert_true(fabsf(n[0] * d[0] + n[1] * d[1] + n[2] * d[2]) < 1e-4f);
        assert_true(n[0] * v[0] + n[1] * v[1] + n[2] * v[2] > 0.0f);
    }
    /* Outward: each triangle's own normal agrees with its vertices'. */
    cgt_sticks_add_cone(&s, a, b, 0.5f, 9);
    cgt_sticks_add_ball(&s, a, 0.5f, 9);
    for (uint32_t i = 0; i < s.triangles; i++) {
        const float *p = vertex(&s, i, 0), *q = vertex(&s, i, 1), *r = vertex(&s, i, 2);
        const float *n = s.normal + 3 * (size_t)s.index[3 * i];
        const float u[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]}, v[3] = {r[0] - p[0], r[1] - p[1], r[2] - p[2]};
        const float c[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        if (!(c[0] * n[0] + c[1] * n[1] + c[2] * n[2] >= -1e-6f))
            fail_msg("triangle %u looks inwards", i);
        assert_int_equal(s.mesh_entry[i], 9);
    }
    const uint32_t before = s.triangles;
    cgt_sticks_add_cylinder(&s, a, a, 0.5f, 9); /* nothing */
    cgt_sticks_add_cylinder(&s, a, (const float[]){NAN, 0, 0}, 0.5f, 9);
    assert_int_equal(s.triangles, before);
    cgt_sticks_free(&s);
}

TEST(the_box_has_its_corners)
{
    static const uint32_t images[3] = {2, 1, 1};
    sticks s = {0};
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    cgt_trajectory_frame frame = make_frame(1);
    frame.box_origin[1] = -3.0;
    cgt_sticks_clear(&s, 8);
    assert_int_equal(cgt_shapes_add_box(&s, &frame, images, 0.1f, 3), 0);
    for (uint32_t i = 0; i < s.vertices; i++)
        for (int c = 0; c < 3; c++) {
            low[c] = fminf(low[c], s.position[3 * i + c]);
            high[c] = fmaxf(high[c], s.position[3 * i + c]);
        }
    const float expected_low[3] = {0, -3, 0}, expected_high[3] = {22, 7, 10};
    for (int c = 0; c < 3; c++)
        assert_true(fabsf(low[c] - expected_low[c]) < 0.12f && fabsf(high[c] - expected_high[c]) < 0.12f);
    memset(frame.box_edge, 0, sizeof frame.box_edge);
    assert_int_equal(cgt_shapes_add_box(&s, &frame, images, 0.1f, 3), -1);
    cgt_sticks_free(&s);
}

/* ---- Bonds and arrows --------------------------------------------------------------------------------------- */

TEST(near_bonds_are_those_of_all_pairs)
{
    char error[256] = "";
    for (uint32_t seed = 1; seed < 6; seed++) {
        particles p = {0};
        sticks s = {0};
        uint32_t pairs = 0;
        const cgt_trajectory_frame frame = make_frame(seed);
        xyzr[4 * 17] = NAN;
        const particle_rules rules = no_rules();
        const bond_rules bonds = {.distance = 0.4f * (float)seed, .radius = 0.1f, .entry = 5};
        assert_int_equal(cgt_particles_select(&p, &rules, &frame, entry, error, sizeof error), 0);
        for (uint32_t i = 0; i < COUNT; i++)
            for (uint32_t k = i + 1; k < COUNT; k++) {
                float square = 0.0f;
                for (int c = 0; c < 3; c++) {
                    const float d = xyzr[4 * i + c] - xyzr[4 * k + c];
                    square = c ? square + d * d : d * d;
                }
                pairs += square <= bonds.distance * bonds.distance;
            }
        cgt_sticks_clear(&s, 3);
        assert_int_equal(cgt_shapes_add_bonds(&s, &bonds, &frame, &p, error, sizeof error), 0);
        if (s.count != pairs || !pairs)
            fail_msg("seed %u: %u sticks for %u pairs", seed, s.count, pairs);
        cgt_sticks_free(&s);
        cgt_particles_free(&p);
    }
}

TEST(bonds_of_the_file_end_at_the_outer_boundary)
{
    char error[256] = "";
    particles p = {0};
    sticks s = {0};
    cgt_trajectory_frame frame = make_frame(3);
    for (int c = 0; c < 3; c++) { /* 0 and 1 are near, 2 and 3 across the boundary */
        xyzr[c] = 1.0f;
        xyzr[4 + c] = 1.5f;
        xyzr[8 + c] = 0.1f;
        xyzr[12 + c] = c ? 0.1f : 9.9f;
    }
    particle_rules rules = no_rules();
    rules.images[1] = 2;
    for (int c = 0; c < 3; c++)
        frame.periodic[c] = 1;
    bond_rules bonds = {.radius = 0.1f, .entry = -1, .images = {1, 2, 1}};
    assert_int_equal(cgt_particles_select(&p, &rules, &frame, entry, error, sizeof error), 0);
    cgt_sticks_clear(&s, 3);
    assert_int_equal(cgt_shapes_add_bonds(&s, &bonds, &frame, &p, error, sizeof error), 0);
    assert_int_equal(s.count, 0); /* a frame may have none */
    frame.bonds = 2;
    frame.bond = bond;
    assert_int_equal(cgt_shapes_add_bonds(&s, &bonds, &frame, &p, error, sizeof error), 0);
    assert_int_equal(s.count, 2); /* two images of one bond of two halves */
    assert_int_equal(s.entry[0], 0);
    assert_int_equal(s.entry[1], 1);
    cgt_sticks_free(&s);
    cgt_particles_free(&p);
}

/* The bonds between spheres 0 and 1, and their longest share of d along each axis. */
static uint32_t bonds_of_two(const cgt_trajectory_frame *frame, const uint32_t images[3], float longest[3])
{
    char error[256] = "";
    particles p = {0};
    sticks s = {0};
    particle_rules rules = no_rules();
    bond_rules bonds = {.radius = 0.001f, .entry = 5};
    memcpy(rules.images, images, sizeof rules.images);
    memcpy(bonds.images, images, sizeof bonds.images);
    assert_int_equal(cgt_particles_select(&p, &rules, frame, entry, error, sizeof error), 0);
    cgt_sticks_clear(&s, 3);
    assert_int_equal(cgt_shapes_add_bonds(&s, &bonds, frame, &p, error, sizeof error), 0);
    memset(longest, 0, 3 * sizeof *longest);
    for (uint32_t i = 0; i < s.count; i++)
        for (int c = 0; c < 3; c++)
            longest[c] = fmaxf(longest[c], fabsf(s.end[6 * i + c] - s.end[6 * i + 3 + c]));
    const uint32_t found = s.count;
    cgt_sticks_free(&s);
    cgt_particles_free(&p);
    return found;
}

/* One bond in boxes with short edges, walls, tilts; and the same between images, each of the length it has. */
TEST(bonds_cross_boundaries_edge_by_edge)
{
    static const struct {
        double edge[3][3];
        int8_t periodic[3], unwrapped[3];
        float a[3], b[3];
        uint32_t images[3], bonds;
        float length[3];
    } rows[] = {
        /* thin: along an edge that the bond does not follow; half of it; more than half, through the boundary */
        {{{20, 0, 0}, {0, 20, 0}, {0, 0, 1}}, {1, 1, 1}, {0}, {3, 3, 0}, {4, 4, 0}, {1, 1, 1}, 1, {1, 1, 0}},
        {{{20, 0, 0}, {0, 20, 0}, {0, 0, 2.46}}, {1, 1, 1}, {0}, {3, 3, 0}, {3, 3, 1.23f}, {1, 1, 1}, 1, {0, 0, 1.23f}},
        {{{20, 0, 0}, {0, 20, 0}, {0, 0, 2}}, {1, 1, 1}, {0}, {3, 3, 0}, {3, 3, 1.5f}, {1, 1, 1}, 0, {0, 0, 0}},
        {{{20, 0, 0}, {0, 20, 0}, {0, 0, 2}}, {1, 1, 1}, {0}, {3, 3, 0}, {3, 3, 1.5f}, {1, 1, 3}, 2, {0, 0, 0.5f}},
        /* walls, and molecules that are whole beyond the boundary */
        {{{20, 0, 0}, {0, 20, 0}, {0, 0, 2}}, {1, 1, 0}, {0}, {3, 3, 0}, {3, 3, 1.5f}, {1, 1, 1}, 1, {0, 0, 1.5f}},
        {{{20, 0, 0}, {0, 20, 0}, {0, 0, 2}},
         {1, 1, 1},
         {0, 0, 1},
         {3, 3, 0},
         {3, 3, 1.5f},
         {1, 1, 1},
         1,
         {0, 0, 1.5f}},
        /* unknown counts as periodic */
        {{{20, 0, 0}, {0, 20, 0}, {0, 0, 2}}, {-1, -1, -1}, {0}, {3, 3, 0}, {3, 3, 1.5f}, {1, 1, 1}, 0, {0, 0, 0}},
        /* tilted: 6 along the leaning edge of 8 goes through it, whatever x does; the images lean, too */
        {{{8, 0, 0}, {4, 8, 0}, {0, 0, 8}}, {1, 1, 1}, {0}, {1, 1, 1}, {5, 7, 1}, {1, 1, 1}, 0, {0, 0, 0}},
        {{{8, 0, 0}, {4, 8, 0}, {0, 0, 8}}, {1, 1, 1}, {0}, {1, 1, 1}, {5, 7, 1}, {2, 3, 1}, 4, {0, 2, 0}},
        /* the other way round */
        {{{20, 0, 0}, {0, 20, 0}, {0, 0, 2}}, {1, 1, 1}, {0}, {3, 3, 1.5f}, {3, 3, 0}, {1, 1, 3}, 2, {0, 0, 0.5f}},
        /* through two boundaries: a corner */
        {{{8, 0, 0}, {0, 8, 0}, {0, 0, 8}}, {1, 1, 1}, {0}, {1, 1, 1}, {7, 7, 1}, {2, 2, 1}, 1, {2, 2, 0}},
        /* rhombohedral: the shares 0.64, 0.59 and -0.38 are those of an image that is not the nearest */
        {{{2.19, 1.265, 10.16}, {-2.19, 1.265, 10.16}, {0, -2.53, 10.16}},
         {1, 1, 1},
         {0},
         {0, 0, 12.9f},
         {0.1f, 2.53f, 21.55f},
         {2, 1, 1},
         1,
         {2.09f, 1.265f, 1.51f}},
        /* a sheet, whose third edge is 0, and a chain */
        {{{5, 0, 0}, {0, 5, 0}, {0, 0, 0}}, {1, 1, 0}, {0}, {1, 1, 0}, {4.5f, 1, 0}, {2, 1, 1}, 1, {1.5f, 0, 0}},
        {{{0, 0, 0}, {0, 0, 0}, {0, 3, 4}}, {0, 0, 1}, {0}, {0, 0, 0}, {0, 2.4f, 3.2f}, {1, 1, 2}, 1, {0, 0.6f, 0.8f}},
    };
    static const uint32_t ends[2] = {0, 1};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        cgt_trajectory_frame frame = make_frame(3);
        float length[3];
        frame.count = 2;
        frame.bonds = 1;
        frame.bond = ends;
        memcpy(frame.box_edge, rows[i].edge, sizeof frame.box_edge);
        memcpy(frame.periodic, rows[i].periodic, sizeof frame.periodic);
        memcpy(frame.unwrapped, rows[i].unwrapped, sizeof frame.unwrapped);
        memcpy(xyzr, rows[i].a, sizeof rows[i].a);
        memcpy(xyzr + 4, rows[i].b, sizeof rows[i].b);
        const uint32_t found = bonds_of_two(&frame, rows[i].images, length);
        if (found != rows[i].bonds)
            fail_msg("row %zu: %u bonds, not %u", i, found, rows[i].bonds);
        for (int c = 0; c < 3; c++)
            assert_near(length[c], rows[i].length[c], 0.01);
    }
}

/* Bonds of carbon that are guessed in cells so small that a pair has more than one, or an atom is bonded to its own
 * image: as many as both ends are in the images. */
TEST(guessed_bonds_go_to_all_images)
{
    static const struct {
        double edge[3][3];
        float places[2][3];
        uint32_t count, images[3], bonds;
        float length[3];
    } rows[] = {
        /* graphene: 1 a cell, 2 more to other cells, of which those at the outer boundary are missing */
        {{{2.46, 0, 0}, {-1.23, 2.13042, 0}, {0, 0, 15}},
         {{0, 0, 7}, {0, 1.42028f, 7}},
         2,
         {4, 4, 1},
         16 + 12 + 9,
         {1.23f, 1.42f, 0}},
        /* places that are written in other cells */
        {{{2.46, 0, 0}, {-1.23, 2.13042, 0}, {0, 0, 15}},
         {{2.46f, 0, 7}, {-2.46f, 1.42028f, 7}},
         2,
         {4, 4, 1},
         8 + 6 + 9,
         {1.23f, 1.42f, 0}},
        /* a chain of atoms, each bonded to its own images */
        {{{1.4, 0, 0}, {0, 9, 0}, {0, 0, 9}}, {{0.1f, 1, 1}}, 1, {5, 1, 1}, 4, {1.4f, 0, 0}},
        /* two bonds of half an edge */
        {{{2.8, 0, 0}, {0, 9, 0}, {0, 0, 9}}, {{0, 1, 1}, {1.4f, 1, 1}}, 2, {3, 1, 1}, 3 + 2, {1.4f, 0, 0}},
        /* a cell so large that there is one bond */
        {{{9, 0, 0}, {0, 9, 0}, {0, 0, 9}}, {{8.5f, 1, 1}, {0.9f, 1, 1}}, 2, {3, 1, 1}, 2, {1.4f, 0, 0}},
    };
    static const uint32_t ends[2] = {0, 1};
    static const uint8_t carbon[2] = {6, 6};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        cgt_trajectory_frame frame = make_frame(3);
        float length[3];
        frame.count = rows[i].count;
        frame.bonds = rows[i].count - 1;
        frame.bond = ends;
        frame.bond_source = CGT_TRAJECTORY_BONDS_GUESSED;
        frame.element = carbon;
        frame.angstrom = 1.0f;
        memcpy(frame.box_edge, rows[i].edge, sizeof frame.box_edge);
        for (int e = 0; e < 3; e++)
            frame.periodic[e] = 1;
        for (int k = 0; k < 2; k++)
            memcpy(xyzr + 4 * k, rows[i].places[k], sizeof rows[i].places[k]);
        const uint32_t found = bonds_of_two(&frame, rows[i].images, length);
        if (found != rows[i].bonds)
            fail_msg("row %zu: %u bonds, not %u", i, found, rows[i].bonds);
        for (int c = 0; c < 3; c++)
            assert_near(length[c], rows[i].length[c], 0.01);
        frame.bond_source = CGT_TRAJECTORY_BONDS_LISTED; /* a list is what it is */
        assert_true(bonds_of_two(&frame, rows[i].images, length) <=
                    rows[i].images[0] * rows[i].images[1] * (rows[i].count - 1));
    }
}

TEST(arrows_point_along_their_vectors)
{
    static const char *const formulas[3] = {"1", "0", "if(index == 4, 3, 0)"};
    char error[256] = "";
    particles p = {0};
    sticks s = {0};
    expression *e[3];
    const cgt_trajectory_frame frame = make_frame(3);
    const particle_rules rules = no_rules();
    assert_int_equal(cgt_particles_select(&p, &rules, &frame, entry, error, sizeof error), 0);
    for (int i = 0; i < 3; i++) {
        e[i] = cgt_expression_parse(formulas[i], error, sizeof error);
        assert_int_equal(cgt_expression_bind(e[i], &frame, NULL, error, sizeof error), 0);
    }
    const expression *const vector[3] = {e[0], e[1], e[2]};
    p.count = 5;
    cgt_sticks_clear(&s, 6);
    cgt_shapes_add_arrows(&s, vector, 2.0f, 0.05f, &p, -1);
    assert_int_equal(s.triangles, 5 * 24);
    assert_int_equal(s.count, 0);
    /* The last arrow's tip is at its sphere's centre plus (2, 0, 6). */
    float nearest = INFINITY;
    for (uint32_t i = 0; i < s.vertices; i++) {
        const float *q = s.position + 3 * i;
        nearest =
            fminf(nearest, fabsf(q[0] - xyzr[16] - 2.0f) + fabsf(q[1] - xyzr[17]) + fabsf(q[2] - xyzr[18] - 6.0f));
    }
    assert_true(nearest < 1e-4f);
    assert_int_equal(s.mesh_entry[s.triangles - 1], 4);
    for (int i = 0; i < 3; i++)
        cgt_expression_free(e[i]);
    cgt_sticks_free(&s);
    cgt_particles_free(&p);
}

/* ---- Trails ------------------------------------------------------------------------------------------------- */

/* Frame k of a run in the box of make_frame: sphere 0 goes along x and through the boundary, 1 along the leaning edge
 * and through it, 2 rests, 3 is there from frame 2 on. Ids are told in another order each time. */
static cgt_trajectory_frame make_moved(uint32_t k, uint32_t ids[4], const double edge[3][3])
{
    cgt_trajectory_frame f = {.kind = CGT_TRAJECTORY_SPHERES, .step = 10, .number = k, .xyzr = xyzr, .id = ids};
    const float x = fmodf(8.25f + 0.5f * (float)k, 10.0f), share = fmodf(0.87f + 0.05f * (float)k, 1.0f);
    const float places[4][3] = {{x, 1, 1}, {5.0f + 2.0f * share, 5, 10.0f * share}, {3, 3, 3}, {1, 8, (float)k}};
    f.count = k < 2 ? 3 : 4;
    memcpy(f.box_edge, edge, sizeof f.box_edge);
    f.periodic[0] = f.periodic[1] = f.periodic[2] = 1;
    for (uint32_t i = 0; i < f.count; i++) {
        const uint32_t id = (i + k) % f.count;
        ids[i] = 100 + id;
        memcpy(xyzr + 4 * i, places[id], sizeof places[id]);
        xyzr[4 * i + 3] = 0.2f;
        entry[i] = (uint16_t)id;
    }
    return f;
}

/* The pieces of one sphere's trail, and the longest share of one along an axis. */
static uint32_t trail_of(const sticks *s, uint16_t id, float *longest)
{
    uint32_t pieces = 0;
    *longest = 0.0f;
    for (uint32_t i = 0; i < s->count; i++) {
        if (s->entry[2 * i] != id || s->entry[2 * i + 1] != id)
            continue;
        pieces++;
        for (int c = 0; c < 3; c++)
            *longest = fmaxf(*longest, fabsf(s->end[6 * i + c] - s->end[6 * i + 3 + c]));
    }
    return pieces;
}

TEST(trails_follow_ids_and_break_at_the_boundary)
{
    static const double edge[3][3] = {{10, 0, 0}, {0, 10, 0}, {2, 0, 10}}, no_edge[3][3];
    char error[256] = "";
    uint32_t ids[4];
    float longest;
    particles p = {0};
    sticks s = {0};
    for (int boxless = 0; boxless < 2; boxless++) {
        trail_history *history = cgt_trail_history_create(6);
        cgt_trajectory_frame f = {0};
        assert_non_null(history);
        for (uint32_t k = 0; k < 8; k++) { /* frame 0 is forgotten, 1 is the oldest */
            f = make_moved(k, ids, boxless ? no_edge : edge);
            assert_int_equal(cgt_trail_history_add(history, &f), 0);
        }
        particle_rules rules = no_rules();
        rules.images[1] = boxless ? 1 : 2;
        assert_int_equal(cgt_particles_select(&p, &rules, &f, entry, error, sizeof error), 0);
        cgt_sticks_clear(&s, 20);
        const trail_rules trails = {history, 0.05f, -1};
        assert_int_equal(cgt_shapes_add_trails(&s, &trails, &f, &p, error, sizeof error), 0);
        const uint32_t images = boxless ? 1 : 2;
        /* Sphere 0 jumps between frames 3 and 4, sphere 1 between 2 and 3: of six steps five have a piece. */
        for (uint16_t id = 0; id < 2; id++) {
            assert_int_equal(trail_of(&s, id, &longest), images * (boxless ? 6 : 5));
            assert_true(boxless ? longest > 5.0f : longest < 1.0f);
        }
        assert_int_equal(trail_of(&s, 2, &longest), 0);          /* hidden in its sphere */
        assert_int_equal(trail_of(&s, 3, &longest), images * 5); /* five steps since frame 2 */
        assert_true(longest < 1.2f);
        cgt_trail_history_release(history);
    }
    cgt_sticks_free(&s);
    cgt_particles_free(&p);
}

/* Numbers that do not increase begin another run, whatever the steps do; a place that is no number ends a trail;
 * colours and radii are the rules'. */
TEST(trails_end_where_nothing_is_known)
{
    static const double edge[3][3] = {{10, 0, 0}, {0, 10, 0}, {2, 0, 10}};
    char error[256] = "";
    uint32_t ids[4];
    float place[10][3], longest;
    particles p = {0};
    sticks s = {0};
    trail_history *history = cgt_trail_history_create(9);
    cgt_trajectory_frame f = {0};
    for (uint32_t k = 0; k < 5; k++) {
        f = make_moved(k, ids, edge);
        if (k == 2)
            xyzr[4 * 1 + 1] = NAN; /* of id (1 + 2) % 4 */
        assert_int_equal(cgt_trail_history_add(history, &f), 0);
    }
    uint32_t sphere = 0;
    while (ids[sphere] != 103)
        sphere++;
    assert_int_equal(cgt_trail_history_places(history, sphere, place), 2);
    assert_true(place[0][2] == 4.0f && place[1][2] == 3.0f);
    const particle_rules rules = no_rules();
    const trail_rules trails = {history, 0.0f, 44};
    assert_int_equal(cgt_particles_select(&p, &rules, &f, entry, error, sizeof error), 0);
    cgt_sticks_clear(&s, 20);
    assert_int_equal(cgt_shapes_add_trails(&s, &trails, &f, &p, error, sizeof error), 0);
    assert_int_equal(trail_of(&s, 44, &longest), s.count);
    float widest = 0.0f;
    for (uint32_t i = 0; i < s.count; i++)
        widest = fmaxf(widest, s.radius[i]);
    assert_true(widest < 0.04f && widest > 0.94f * 0.04f); /* near the sphere a fifth of 0.2 */
    f = make_moved(2, ids, edge);
    assert_int_equal(cgt_trail_history_add(history, &f), 0);
    assert_int_equal(cgt_trail_history_places(history, 0, place), 1);
    cgt_trail_history_restart(history);
    f = make_moved(3, ids, edge);
    assert_int_equal(cgt_trail_history_add(history, &f), 0);
    assert_int_equal(cgt_trail_history_places(history, 0, place), 1);
    cgt_trail_history_release(history);
    cgt_sticks_free(&s);
    cgt_particles_free(&p);
}

SUITE(NULL, NULL)

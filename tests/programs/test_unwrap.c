/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Molecules that a periodic box has cut, put together: against molecules that were whole before each of their spheres
 * was wrapped by itself. */
#include "support/suite.h"
#include "support/test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sequence/unwrap.h"

enum { MOLECULES = 60, MOST = 1500, RUNS = 200 };

/* Chains and rings that wander through several boxes, their spheres in any order in the file. */
typedef struct molecules {
    uint32_t count, bonds;
    uint32_t molecule[MOST]; /* of each sphere */
    double whole[MOST][3];   /* as it was before the box cut it */
    float image[3][MOST];
    float xyzr[4 * MOST];
    uint32_t bond[4 * MOST];
    cgt_trajectory_column columns[3];
    cgt_trajectory_frame frame;
} molecules;

static molecules m;

static double uniform(test_random *r, double low, double high)
{
    return low + (high - low) * (double)random_float(r, 0.0f, 1.0f);
}

/* Share of each edge, by Cramer's rule in double: the box's corner is 0. */
static void shares(const cgt_trajectory_frame *f, const double p[3], double share[3])
{
    const double(*e)[3] = f->box_edge;
    double inverse[3][3], volume = 0.0;
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++) {
            const double *a = e[(k + 1) % 3], *b = e[(k + 2) % 3];
            inverse[k][c] = a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
        }
    for (int c = 0; c < 3; c++)
        volume += inverse[0][c] * e[0][c];
    for (int k = 0; k < 3; k++)
        share[k] = (inverse[k][0] * (p[0] - f->box_origin[0]) + inverse[k][1] * (p[1] - f->box_origin[1]) +
                    inverse[k][2] * (p[2] - f->box_origin[2])) /
                   volume;
}

static void add_sphere(test_random *r, uint32_t molecule, const double p[3])
{
    const uint32_t i = m.count++;
    double share[3], place[3];
    m.molecule[i] = molecule;
    memcpy(m.whole[i], p, sizeof m.whole[i]);
    memcpy(place, p, sizeof place);
    shares(&m.frame, p, share);
    for (int e = 0; e < 3; e++) {
        const double image = m.frame.periodic[e] ? floor(share[e]) : 0.0;
        m.image[e][i] = (float)image;
        for (int c = 0; c < 3; c++)
            place[c] -= image * m.frame.box_edge[e][c];
    }
    for (int c = 0; c < 3; c++)
        m.xyzr[4 * i + (uint32_t)c] = (float)place[c];
    m.xyzr[4 * i + 3] = (float)uniform(r, 0.1, 1.0);
}

/* Swaps spheres, bonds and all, so that roots and chains are in no order. */
static void shuffle(test_random *r)
{
    static uint32_t to[MOST];
    static molecules old;
    old = m;
    for (uint32_t i = 0; i < m.count; i++)
        to[i] = i;
    for (uint32_t i = m.count; i > 1; i--) {
        const uint32_t k = random_below(r, i), other = to[k];
        to[k] = to[i - 1];
        to[i - 1] = other;
    }
    for (uint32_t i = 0; i < m.count; i++) {
        m.molecule[to[i]] = old.molecule[i];
        memcpy(m.whole[to[i]], old.whole[i], sizeof old.whole[i]);
        memcpy(m.xyzr + 4 * to[i], old.xyzr + 4 * i, 4 * sizeof(float));
        for (int e = 0; e < 3; e++)
            m.image[e][to[i]] = old.image[e][i];
    }
    for (uint32_t b = 0; b < m.bonds; b++) {
        const uint32_t at = random_below(r, b + 1), turn = random_below(r, 2);
        const uint32_t pair[2] = {to[old.bond[2 * b + turn]], to[old.bond[2 * b + 1 - turn]]};
        memcpy(m.bond + 2 * b, m.bond + 2 * at, sizeof pair);
        memcpy(m.bond + 2 * at, pair, sizeof pair);
    }
}

static void make(test_random *r)
{
    static const char *const names[3] = {"ix", "iy", "iz"};
    const double lean = uniform(r, -3.0, 3.0);
    memset(&m, 0, sizeof m);
    m.frame = (cgt_trajectory_frame){.kind = CGT_TRAJECTORY_SPHERES,
                                     .box_origin = {uniform(r, -9.0, 9.0), -4.0, 2.0},
                                     .box_edge = {{8.0, 0.0, 0.0}, {lean, 9.0, 0.0}, {-lean, 1.0, 10.0}},
                                     .periodic = {1, (int8_t)(random_below(r, 4) ? 1 : 0), -1}};
    m.frame.box_max[0] = 1.0f;
    for (uint32_t k = 0; k < MOLECULES; k++) {
        double p[3];
        const uint32_t first = m.count, length = 1 + random_below(r, 24);
        for (int c = 0; c < 3; c++)
            p[c] = uniform(r, -20.0, 20.0);
        for (uint32_t i = 0; i < length; i++) {
            const uint32_t from = i ? first + random_below(r, i) : first; /* branches, too */
            for (int c = 0; c < 3 && i; c++)
                p[c] = m.whole[from][c] + uniform(r, -1.5, 1.5);
            add_sphere(r, k, p);
            if (i) {
                m.bond[2 * m.bonds] = from;
                m.bond[2 * m.bonds++ + 1] = m.count - 1;
            }
        }
        if (length > 1 && random_below(r, 2)) { /* a bond twice: a ring of two */
            memcpy(m.bond + 2 * m.bonds, m.bond + 2 * m.bonds - 2, 2 * sizeof m.bond[0]);
            m.bonds++;
        }
    }
    shuffle(r);
    for (int e = 0; e < 3; e++)
        m.columns[e] = (cgt_trajectory_column){names[e], CGT_TRAJECTORY_WHOLE, m.image[e], 0, NULL};
    m.frame.count = m.count;
    m.frame.xyzr = m.xyzr;
    m.frame.bonds = m.bonds;
    m.frame.bond = m.bond;
    m.frame.bond_source = CGT_TRAJECTORY_BONDS_LISTED;
    m.frame.column = m.columns;
}

/* Each sphere is at its whole place, moved by the same edges as the others of its molecule. move: of each molecule. */
static void expect(const cgt_trajectory_frame *f, double (*move)[3])
{
    for (uint32_t i = 0; i < f->count; i++)
        for (int c = 0; c < 3; c++) {
            const double wanted = m.whole[i][c] + move[m.molecule[i]][c], got = (double)f->xyzr[4 * i + (uint32_t)c];
            if (!(fabs(got - wanted) < 1e-5 * (10.0 + fabs(wanted))))
                fail_msg("sphere %u of molecule %u: %.9g, not %.9g", i, m.molecule[i], got, wanted);
            assert_true(f->xyzr[4 * i + 3] == m.xyzr[4 * i + 3]);
        }
}

static cgt_trajectory_frame unwrapped(unwrap_mode mode, int columns)
{
    static unwrapping *last;
    char error[300];
    cgt_trajectory_frame f = m.frame;
    int endless = 0;
    cgt_unwrap_release(last);
    last = cgt_unwrap_create(mode);
    assert_non_null(last);
    f.columns = (uint32_t)columns;
    assert_int_equal(cgt_unwrap_frame(last, &f, &endless, error, sizeof error), 0);
    assert_false(endless);
    return f;
}

TEST(image_flags_lead_back)
{
    test_random r = random_make(1);
    static double nothing[MOLECULES][3];
    for (int run = 0; run < RUNS; run++) {
        make(&r);
        m.frame.bonds = run % 2 ? m.bonds : 0;
        const cgt_trajectory_frame f = unwrapped(UNWRAP_IMAGES, 3);
        expect(&f, nothing);
        for (int e = 0; e < 3; e++)
            assert_int_equal(f.unwrapped[e], m.frame.periodic[e] != 0);
    }
}

TEST(bonds_put_molecules_together)
{
    test_random r = random_make(2);
    static double move[MOLECULES][3];
    static int known[MOLECULES];
    for (int run = 0; run < RUNS; run++) {
        make(&r);
        memset(known, 0, sizeof known);
        for (uint32_t i = 0; i < m.count; i++) { /* the first sphere stays */
            if (known[m.molecule[i]])
                continue;
            known[m.molecule[i]] = 1;
            for (int c = 0; c < 3; c++)
                move[m.molecule[i]][c] = (double)m.xyzr[4 * i + (uint32_t)c] - m.whole[i][c];
        }
        const cgt_trajectory_frame f = unwrapped(UNWRAP_IMAGES, run % 2 ? 2 : 0); /* two flags are none */
        expect(&f, move);
        assert_true(!f.unwrapped[0] && !f.unwrapped[1] && !f.unwrapped[2]);
    }
}

TEST(whole_molecules_lie_in_the_box)
{
    test_random r = random_make(3);
    static double move[MOLECULES][3];
    for (int run = 0; run < RUNS; run++) {
        make(&r);
        for (uint32_t k = 0; k < MOLECULES; k++) {
            double middle[3] = {0.0, 0.0, 0.0}, share[3], spheres = 0.0;
            for (uint32_t i = 0; i < m.count; i++) {
                for (int c = 0; c < 3 && m.molecule[i] == k; c++)
                    middle[c] += m.whole[i][c];
                spheres += m.molecule[i] == k;
            }
            for (int c = 0; c < 3; c++)
                middle[c] /= spheres;
            shares(&m.frame, middle, share);
            for (int c = 0; c < 3; c++) {
                move[k][c] = 0.0;
                for (int e = 0; e < 3; e++)
                    move[k][c] -= m.frame.periodic[e] ? floor(share[e]) * m.frame.box_edge[e][c] : 0.0;
            }
        }
        const cgt_trajectory_frame f = unwrapped(UNWRAP_WHOLE, 3);
        expect(&f, move);
    }
}

/* Spheres that wander, in a box that changes; each frame has them in another order, and wrapped. */
TEST(spheres_are_followed_from_frame_to_frame)
{
    enum { SPHERES = 50, FRAMES = 40 };
    static const double edge[3][3] = {{8.0, 0.0, 0.0}, {2.0, 9.0, 0.0}, {-3.0, 1.0, 10.0}};
    static double share[SPHERES][3]; /* in edges, as it goes on */
    static float xyzr[4 * SPHERES];
    static uint32_t id[SPHERES];
    test_random r = random_make(5);
    unwrapping *const u = cgt_unwrap_create(UNWRAP_IMAGES);
    char error[300] = "";
    int endless = 0;
    for (int turn = 0; turn < 2; turn++) {
        for (int i = 0; i < SPHERES; i++)
            for (int e = 0; e < 3; e++)
                share[i][e] = uniform(&r, 0.0, 1.0);
        cgt_unwrap_restart(u);
        const double corner = turn ? 40.0 : 0.0; /* of a box that stands far away, too */
        for (int frame = 0; frame < FRAMES; frame++) {
            cgt_trajectory_frame f = {.kind = CGT_TRAJECTORY_SPHERES, .count = SPHERES, .xyzr = xyzr, .id = id};
            const double scale = uniform(&r, 0.9, 1.1);
            const uint32_t first = random_below(&r, SPHERES);
            f.number = (uint64_t)frame;
            for (int e = 0; e < 3; e++) {
                f.periodic[e] = e != 1;
                f.box_origin[e] = corner;
                for (int c = 0; c < 3; c++)
                    f.box_edge[e][c] = scale * edge[e][c];
            }
            for (uint32_t i = 0; i < SPHERES; i++) {
                const uint32_t at = (i + first) % SPHERES;
                id[at] = 7 * i;
                for (int e = 0; e < 3; e++)
                    share[i][e] += frame ? uniform(&r, -0.3, 0.3) : 0.0; /* 0.4 of two edges is longer than an image */
                for (uint32_t c = 0; c < 3; c++) {
                    double place = corner;
                    for (int e = 0; e < 3; e++)
                        place += (share[i][e] - (e != 1 ? floor(share[i][e]) : 0.0)) * f.box_edge[e][c];
                    xyzr[4 * at + c] = (float)place;
                }
            }
            assert_int_equal(cgt_unwrap_frame(u, &f, &endless, error, sizeof error), 0);
            assert_true(cgt_unwrap_follows(u) && cgt_unwrap_needs_all(u) && !endless);
            for (uint32_t i = 0; i < SPHERES; i++)
                for (uint32_t c = 0; c < 3; c++) {
                    double place = corner;
                    for (int e = 0; e < 3; e++)
                        place += share[i][e] * f.box_edge[e][c];
                    const double got = (double)f.xyzr[4 * ((i + first) % SPHERES) + c];
                    if (!(fabs(got - place) < 1e-4))
                        fail_msg("frame %d: sphere %u is at %.9g, not %.9g", frame, i, got, place);
                }
        }
    }
    cgt_unwrap_release(u);
}

TEST(what_cannot_be_put_together_is_told)
{
    char error[300] = "";
    int endless = 0;
    test_random r = random_make(4);
    make(&r);
    unwrapping *u = cgt_unwrap_create(UNWRAP_IMAGES), *whole = cgt_unwrap_create(UNWRAP_WHOLE);
    cgt_trajectory_frame f = m.frame;
    f.bond_source = CGT_TRAJECTORY_BONDS_UNKNOWN;
    assert_int_equal(cgt_unwrap_frame(whole, &f, &endless, error, sizeof error), -1);
    assert_non_null(strstr(error, "--whole: frame 0 has no bonds"));
    f.box_max[0] = -1.0f;
    assert_int_equal(cgt_unwrap_frame(u, &f, &endless, error, sizeof error), -1);
    assert_non_null(strstr(error, "has no box"));
    f = m.frame;
    f.kind = CGT_TRAJECTORY_TRIANGLES;
    assert_int_equal(cgt_unwrap_frame(u, &f, &endless, error, sizeof error), -1);
    assert_non_null(strstr(error, "is a mesh"));

    /* walls, and positions that go on: nothing moves, and nothing is asked for */
    f = m.frame;
    f.periodic[0] = f.periodic[1] = 0;
    f.unwrapped[2] = 1;
    assert_int_equal(cgt_unwrap_frame(u, &f, &endless, error, sizeof error), 0);
    assert_ptr_equal(f.xyzr, m.xyzr);

    /* a chain of three through the whole box; a sphere nowhere */
    static const float chain[] = {-0.5f, 0, 5, 1, 2.5f, 0, 5, 1, 5.5f, 0, 5, 1, NAN, 0, 0, 1};
    static const uint32_t bonds[] = {0, 1, 1, 2, 2, 0, 2, 3};
    f = m.frame;
    f.box_edge[1][0] = f.box_edge[2][0] = f.box_edge[2][1] = 0.0;
    f.xyzr = chain;
    f.count = 4;
    f.bond = bonds;
    f.bonds = 4;
    assert_int_equal(cgt_unwrap_frame(whole, &f, &endless, error, sizeof error), 0);
    assert_int_equal(endless, 1);
    assert_true(isnan(f.xyzr[12]));
    assert_memory_equal(f.xyzr, chain, 12 * sizeof *chain); /* it stays as it is */

    /* a sheet of two atoms, each bonded to three images of the other */
    static const float sheet[] = {0, 0, 7, 1, 0, 1.42028f, 7, 1};
    static const double edges[3][3] = {{2.46, 0.0, 0.0}, {-1.23, 2.13042, 0.0}, {0.0, 0.0, 0.0}};
    static const uint8_t carbon[2] = {6, 6};
    cgt_trajectory_frame g = {
        .count = 2, .xyzr = sheet, .element = carbon, .angstrom = 1.0f, .bonds = 1, .bond = bonds};
    g.kind = CGT_TRAJECTORY_SPHERES;
    g.periodic[0] = g.periodic[1] = 1;
    memcpy(g.box_edge, edges, sizeof g.box_edge);
    for (int guessed = 0; guessed < 2; guessed++) {
        endless = 0;
        g.xyzr = sheet;
        g.bond_source = guessed ? CGT_TRAJECTORY_BONDS_GUESSED : CGT_TRAJECTORY_BONDS_LISTED;
        assert_int_equal(cgt_unwrap_frame(whole, &g, &endless, error, sizeof error), 0);
        assert_int_equal(endless, guessed);
    }

    /* flags that end */
    f = m.frame;
    f.columns = 3;
    assert_int_equal(cgt_unwrap_frame(u, &f, &endless, error, sizeof error), 0);
    f = m.frame;
    f.number = 1;
    assert_int_equal(cgt_unwrap_frame(u, &f, &endless, error, sizeof error), -1);
    assert_non_null(strstr(error, "--unwrap: frame 1 has no image flags (ix, iy, iz), unlike the first"));
    cgt_unwrap_release(u);
    cgt_unwrap_release(whole);
    cgt_unwrap_release(NULL);
}

SUITE(NULL, NULL)

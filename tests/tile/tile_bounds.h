/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bounds of single precision over the pixels of a tile, for both kinds of primitives: a tile of 8x8 pixels, a camera,
 * what is tallied, and the tests that the bounds hold, and break where FILTER_ROUNDOFF is lowered below the unit
 * roundoff. Included by a test that has included the kind's kernels, with FILTER_ROUNDOFF as filter_u. */
#ifndef TILE_BOUNDS_H
#define TILE_BOUNDS_H

#include <math.h>
#include <string.h>

#include "support/suite.h"
#include "support/test.h"
#include "support/tightened.h"

#include "query/tile_limits.h"

typedef struct tally {
    uint64_t lanes, hits, certain, undecided, double_lanes, coarse;
    uint64_t culled_by_depth, culled_by_sides; /* triangles that are culled for the whole tile */
    uint64_t lost, invented, outside;          /* must be 0 */
} tally;

/* ---- a camera and a pixel ---- */

typedef struct tile_case {
    cgt_camera_rays rays;
    uint32_t at[2]; /* the tile's first pixel */
    bool parallel;
    float scale;
    cgt_exact_ray line; /* of a pixel of the tile */
} tile_case;

static inline void make_case_rays(const cgt_camera *camera, uint32_t edge, cgt_camera_rays *rays)
{
    char message[160];
    assert_int_equal(cgt_camera_prepare(camera, edge, edge, rays, message), CGT_OK);
}

/* Any camera, at any scale, and a tile of 8x8 pixels somewhere in its picture. */
static inline tile_case make_camera_case(test_random *r, bool parallel)
{
    tile_case c = {.parallel = parallel};
    cgt_camera camera;
    const float scale = c.scale = random_below(r, 3) ? 1 : random_log(r, 1e-6f, 1e6f);
    const float offset = random_below(r, 2) ? 0 : random_log(r, 0.1f, 1e4f);
    cgt_camera_init(&camera);
    for (int a = 0; a < 3; a++) {
        camera.eye[a] = scale * random_float(r, -1, 1) * offset;
        camera.target[a] = camera.eye[a] + scale * (a == 1 ? 2 : random_float(r, -1, 1));
    }
    random_direction(r, camera.up);
    camera.fov = random_below(r, 2) ? random_float(r, 20, 100) : random_log(r, 0.5f, 160);
    if (parallel) {
        camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
        camera.height = scale * (random_below(r, 2) ? random_float(r, 0.5f, 4) : random_log(r, 1e-3f, 30));
        if (random_below(r, 3) == 0) /* along an axis */
            for (int a = 0; a < 3; a++) {
                camera.target[a] = camera.eye[a] + (a == 2 ? scale : 0);
                camera.up[a] = a == 1;
            }
    }
    const uint32_t edge = 8 + random_below(r, random_below(r, 2) ? 1000 : 20);
    make_case_rays(&camera, edge, &c.rays);
    c.at[0] = random_below(r, edge - 7);
    c.at[1] = random_below(r, edge - 7);
    const float px = ((float)(c.at[0] + random_below(r, 8)) + 0.5f) * c.rays.pixel[0] - 1;
    const float py = 1 - ((float)(c.at[1] + random_below(r, 8)) + 0.5f) * c.rays.pixel[1];
    c.line = tile_pixel_line(&c.rays, parallel, px, py);
    return c;
}

/* What does not depend on the kind of primitives, as cgt_tile_init sets it. */
static inline void begin_tile(tile *t, const tile_case *c)
{
    t->rays = &c->rays;
    t->columns = t->rows = 8;
    tile_init_camera(&c->rays, &t->camera);
    tile_init_parallel(t);
    tile_init_tables(t, c->at[0], c->at[1]);
    tile_init_norms(t);
    tile_init_parts(t);
    tile_init_cone(t);
}

/* ---- tests ---- */

/* Makes a case of a primitive of the kind; false: it is not to be judged. */
static bool make_case(test_random *r, bool parallel);

/* Judges that case. form: which form of depths the tile takes. fresh: the tile's truth is not known yet. */
static void judge_case(uint32_t form, bool fresh, tally *sum);

static inline void print_tile_tally(const char *what, const tally *sum)
{
    print_message("%s: %llu lanes, %llu hits, %llu certain, %llu undecided; %llu slow, %llu coarse; lost %llu, "
                  "invented %llu, outside %llu\n",
                  what, (unsigned long long)sum->lanes, (unsigned long long)sum->hits, (unsigned long long)sum->certain,
                  (unsigned long long)sum->undecided, (unsigned long long)sum->double_lanes,
                  (unsigned long long)sum->coarse, (unsigned long long)sum->lost, (unsigned long long)sum->invented,
                  (unsigned long long)sum->outside);
}

/* Returns the tally, in which nothing is lost. */
static inline tally check_bounds(uint64_t stream, bool parallel, uint32_t forms, uint32_t cases)
{
    test_random r = random_make(stream);
    tally sum = {0};
    for (uint32_t k = 100 + test_scaled(cases); k; k--)
        if (make_case(&r, parallel))
            for (uint32_t form = 0; form < forms; form++)
                judge_case(form, form == 0, &sum);
    print_tile_tally(parallel ? "parallel rays" : "perspective", &sum);
    assert_int_equal(sum.lost, 0);
    assert_int_equal(sum.invented, 0);
    assert_int_equal(sum.outside, 0);
    assert_true(sum.certain > 100 && sum.undecided > 20 && sum.hits > 100 &&
                sum.lanes - sum.certain - sum.undecided > 100);
    return sum;
}

/* The bounds are worst cases: random rays come within a few orders of magnitude. least: of what is lost, invented,
 * outside. */
static inline void check_tightened_bounds(uint64_t stream, bool parallel, uint32_t forms, const double least[3])
{
    test_random r = random_make(stream);
    tally sum[STEPS] = {{0}};
    for (uint32_t k = 400 + test_scaled(2000); k; k--) {
        float scale = 0x1p-24f;
        if (!make_case(&r, parallel))
            continue;
        for (int step = 0; step < STEPS; step++, scale *= 0.70710678f) {
            filter_u = scale;
            judge_case(k % forms, step == 0, &sum[step]);
        }
        filter_u = 0x1p-24f;
    }
    check_break("a hit lost", sum, sizeof *sum, offsetof(tally, lost), least[0]);
    check_break("a hit invented", sum, sizeof *sum, offsetof(tally, invented), least[1]);
    check_break("depth outside", sum, sizeof *sum, offsetof(tally, outside), least[2]);
}

#endif

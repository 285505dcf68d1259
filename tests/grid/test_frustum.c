/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a packet leaves out of a queue grid, against wide arithmetic: the cells beside its frustum, slices before and
 * beyond its ranges, spheres outside the frustum or its block's cone, spheres before whose first t hits end. Rays run
 * along the frustum's edges through edges of cells, and touch spheres from there, so that nothing but the bounds'
 * errors decides. Then the errors are made smaller until something is lost: a bound that never breaks is too wide.
 * With one variant, and with CGT_SPU_EXACT in an SPU's arithmetic: truncated, flushed, saturated. */
#include <math.h>
#include <string.h>

#include "support/oracle/truth.h"
#include "support/suite.h"
#include "support/test.h"
#include "support/tightened.h"
#include "vector.h"

static float error_scale = 1;
#define FRUSTUM_ERROR_SCALE error_scale
#define CONE_ERROR_SCALE error_scale
#define MIN_T_ERROR_SCALE error_scale
#include "papers/kernel/grid/packet_prims.h"

#define RAYS 16
#define MOST_CELLS 32

/* What is known of one packet: filled in the arithmetic under test, judged outside of it. */
typedef struct trial {
    packet p;
    packet_prims v;
    filter_spheres s;
    bool reaches_grid, reversed;
    vec_int4 cells[MOST_CELLS]; /* of the slices from first to end - 1 */
    unsigned outside;           /* spheres */
    uint32_t reached[CGT_LANES];
} trial;

typedef struct tally {
    uint64_t points, hits;
    uint64_t cells, culled, cones, ts; /* lost: must be 0 */
} tally;

static trial t;

/* ---- the arithmetic under test ---- */

static __attribute__((noinline)) void compute(void)
{
    const vfloat one = spux_vfloat(1);
    for (uint32_t i = 0; i < RAYS; i += CGT_LANES) {
        vfloat dd = spux_vfloat(0);
        for (int a = 0; a < 3; a++) {
            const vfloat d = spux_load(t.p.dir[a] + i);
            dd = spu_add(dd, spu_mul(d, d));
        }
        spux_store(t.p.rdd + i, spux_div(one, dd));
    }
    frustum *const f = &t.v.frustum;
    t.reaches_grid = frustum_init(&t.v.space, &t.p, f->w, t.reversed, f);
    if (!t.reaches_grid)
        return;
    for (uint32_t slice = f->first; slice < f->end; slice++)
        t.cells[slice] = frustum_slice(f, slice);
    packet_prims_init(&t.v);
    t.outside = spheres_outside(&t.v, &t.s);
    filter_spheres_bound(&t.v.filter, &t.s);
    for (int k = 0; k < CGT_LANES; k++) {
        const float center[3] = {t.s.center[0][k], t.s.center[1][k], t.s.center[2][k]};
        t.reached[k] = block_cones_test_sphere(&t.v.blocks, center, t.s.radius[k], -INFINITY);
    }
}

static __attribute__((noinline)) void compute_in_mode(void)
{
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    compute();
    cgt_spu_leave_arithmetic(saved);
}

/* ---- packets ---- */

static void make_space(test_random *r)
{
    frustum_space *const g = &t.v.space;
    const float size = random_log(r, 1e-3f, 1e3f), offset = random_below(r, 2) ? 0 : random_float(r, -9, 9) * size;
    for (int a = 0; a < 3; a++) {
        const float extent = size * random_float(r, 0.2f, 1);
        g->resolution[a] = 1 + random_below(r, MOST_CELLS);
        g->org[a] = offset - extent / 2;
        g->rcell[a] = (float)g->resolution[a] / extent;
        g->cell_error[a] = error_scale * 0x1p-20f * ((float)g->resolution[a] + (fabsf(offset) + extent) * g->rcell[a]);
    }
}

/* A point on an edge of cells: whole coordinates along w and u, any along v. */
static void choose_edge_point(test_random *r, const int axis[3], double point[3])
{
    const frustum_space *g = &t.v.space;
    for (int k = 0; k < 3; k++) {
        const int a = axis[k];
        const double c = k == 2 ? (double)random_float(r, 0, (float)g->resolution[a])
                                : (double)random_below(r, g->resolution[a] + 1);
        point[a] = (double)g->org[a] + c / (double)g->rcell[a];
    }
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Takes the part of a vector that is along another away from it. */
static void make_perpendicular(double v[3], const double to[3])
{
    const double k = dot(v, to) / dot(to, to);
    for (int a = 0; a < 3; a++)
        v[a] -= k * to[a];
}

static void normalize(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int a = 0; a < 3; a++)
        v[a] /= length;
}

/* Ray 0 through the point, the others to one side of it: it lies on the edge of the frustum. side: away from those of
 * its row, and from the middle of all, where the cone's axis is. */
static bool make_packet(test_random *r, double side[2][3], double along[3])
{
    packet *const p = &t.p;
    const frustum_space *const g = &t.v.space;
    const int w = (int)random_below(r, 3), u = (w + 1 + (int)random_below(r, 2)) % 3, axis[3] = {w, u, 3 - w - u};
    const double size = (double)g->resolution[w] / (double)g->rcell[w];
    const float away = random_log(r, 0.1f, 30), narrow = random_log(r, 1e-4f, random_below(r, 2) ? 1e-3f : 0.3f);
    double point[3], org[3], step[2][3] = {{0}};
    memset(p, 0, sizeof *p);
    memset(&t.v.frustum, 0, sizeof t.v.frustum);
    choose_edge_point(r, axis, point);
    const double sign = random_below(r, 2) ? 1 : -1, inward = random_below(r, 2) ? 1 : -1;
    for (int a = 0; a < 3; a++)
        org[a] = point[a] + size * (double)away * (a == w ? -sign : (double)random_float(r, -0.7f, 0.7f));
    p->lanes = p->rays = RAYS;
    p->common_origin = random_below(r, 4) != 0;
    step[0][u] = inward * (double)narrow * size * (double)away / 4;
    step[1][axis[2]] = (random_below(r, 2) ? 1 : -1) * (double)narrow * size * (double)away / 4;
    for (int a = 0; a < 3; a++)
        along[a] = point[a] - org[a];
    if (random_below(r, 2)) /* the cone's axis is in the middle then, and ray 0 on its surface */
        for (int k = 0; k < 2; k++)
            make_perpendicular(step[k], along);
    for (uint32_t i = 0; i < RAYS; i++)
        for (int a = 0; a < 3; a++) {
            p->org[a][i] = (float)org[a];
            /* without a common origin: beside it, further inwards */
            if (!p->common_origin && i)
                p->org[a][i] += (float)(step[0][a] * (double)random_float(r, 0, 1));
            p->dir[a][i] = (float)(point[a] - (double)p->org[a][0] + (i % 4) * step[0][a] + (i / 4) * step[1][a]);
        }
    for (int a = 0; a < 3; a++) {
        along[a] = (double)p->dir[a][0];
        side[0][a] = -step[0][a];
        side[1][a] = -step[0][a] - step[1][a];
    }
    t.v.frustum.w = w;
    t.reversed = sign < 0;
    for (uint32_t i = 0; i < RAYS; i++)
        for (int a = 0; a < 3; a++)
            if (!(p->dir[w][i] * (float)sign > 0) || fabsf(p->dir[a][i]) > fabsf(p->dir[w][i]))
                return false; /* not the main axis of all */
    for (int k = 0; k < 2; k++) {
        make_perpendicular(side[k], along);
        normalize(side[k]);
    }
    return true;
}

/* Ranges: the whole ray, or one that begins or ends near where the point is, at t = 1. */
static void make_range(test_random *r, float *t_min, float *t_max)
{
    const uint32_t how = random_below(r, 4);
    *t_min = how == 1 || how == 3 ? 1 - random_log(r, 1e-8f, 0.5f) : 0;
    *t_max = how == 2 || how == 3 ? 1 + random_log(r, 1e-8f, 0.5f) : 0x1p44f;
    for (uint32_t i = 0; i < RAYS; i++) {
        t.p.t_min[i] = *t_min;
        t.p.t_max[i] = t.p.low[i] = t.p.high[i] = *t_max;
        t.p.prim[i] = CGT_INVALID_ID;
    }
    t.p.from_origin = t.p.common_origin && *t_min == 0;
}

/* Spheres that ray 0 touches from outside the frustum, or that it enters or leaves at an end of the range. */
static void make_spheres(test_random *r, double (*side)[3], const double along[3], float t_min, float t_max)
{
    const int w = t.v.frustum.w;
    const double length = sqrt(dot(along, along)), size = t.v.space.resolution[w] / (double)t.v.space.rcell[w];
    for (int k = 0; k < CGT_LANES; k++) {
        const uint32_t how = random_below(r, 4);
        const double inside = 1 - (double)random_log(r, 1e-9f, 1e-2f);
        const float where = how == 1                ? t_min
                            : how == 2 && t_max < 2 ? t_max
                                                    : 1 + random_float(r, -0.5f, 0.5f) * (float)(size / length);
        const double radius = size * (double)random_log(r, 1e-4f, 0.3f);
        t.s.radius[k] = (float)radius;
        for (int a = 0; a < 3; a++) {
            const double at = (double)t.p.org[a][0] + (double)where * along[a];
            const double away = how == 1   ? -along[a] / length /* the far root is there */
                                : how == 2 ? along[a] / length  /* the near one */
                                           : side[how / 3][a];
            t.s.center[a][k] = (float)(at + away * radius * (how == 0 || how == 3 ? inside : 1));
        }
        t.s.prim[k] = (uint32_t)k;
    }
}

/* ---- judging ---- */

/* The exact grid coordinate of a point of a ray. */
static truth_real coordinate(int axis, uint32_t ray, truth_real at)
{
    const frustum_space *const g = &t.v.space;
    return (((truth_real)t.p.org[axis][ray] - (truth_real)g->org[axis]) + at * (truth_real)t.p.dir[axis][ray]) *
           (truth_real)g->rcell[axis];
}

/* Whether the cell of a point within the slice is among those visited. Outside the grid there is nothing to visit. */
static bool is_visited(uint32_t slice, uint32_t ray, truth_real at)
{
    const frustum *const f = &t.v.frustum;
    const int axis[2] = {f->u, f->v};
    int32_t cell[2];
    for (int k = 0; k < 2; k++) {
        const truth_real c = coordinate(axis[k], ray, at);
        if (!(c >= 0) || !(c < (truth_real)t.v.space.resolution[axis[k]]))
            return true;
        cell[k] = (int32_t)c;
    }
    if (!t.reaches_grid || slice < f->first || slice >= f->end)
        return false;
    const vec_int4 b = t.cells[slice];
    return cell[0] >= b[0] && cell[0] <= b[1] && cell[1] >= b[2] && cell[1] <= b[3];
}

/* Both ends of each slice, or of the range within it. */
static void judge_cells(float t_min, float t_max, tally *sum)
{
    const int w = t.v.frustum.w;
    const uint32_t slices = t.v.space.resolution[w];
    for (uint32_t i = 0; i < RAYS; i += 5) /* a diagonal */
        for (uint32_t slice = 0; slice < slices; slice++) {
            const truth_real start = coordinate(w, i, 0), speed = coordinate(w, i, 1) - start;
            const uint32_t low = t.reversed ? slices - 1 - slice : slice;
            const truth_real inset = (truth_real)0x1p-80; /* clear of the neighbouring slice */
            truth_real enter = ((truth_real)low + inset - start) / speed,
                       leave = ((truth_real)(low + 1) - inset - start) / speed;
            if (enter > leave) {
                const truth_real swapped = enter;
                enter = leave;
                leave = swapped;
            }
            enter = enter < (truth_real)t_min ? (truth_real)t_min : enter;
            leave = leave > (truth_real)t_max ? (truth_real)t_max : leave;
            if (enter > leave)
                continue;
            sum->points += 2;
            sum->cells += !is_visited(slice, i, enter) + !is_visited(slice, i, leave);
        }
}

/* The grid's primitives do not reach beyond it. */
static bool is_in_grid(int k)
{
    const frustum_space *const g = &t.v.space;
    bool in = true;
    for (int a = 0; a < 3; a++) {
        const double low = (double)g->org[a], high = low + g->resolution[a] / (double)g->rcell[a];
        in &= (double)t.s.center[a][k] - (double)t.s.radius[k] >= low &&
              (double)t.s.center[a][k] + (double)t.s.radius[k] <= high;
    }
    return in;
}

static void judge_spheres(float t_min, float t_max, tally *sum)
{
    for (int k = 0; k < CGT_LANES && t.reaches_grid; k++)
        for (uint32_t i = 0; i < RAYS && is_in_grid(k); i += 5) {
            const float org[3] = {t.p.org[0][i], t.p.org[1][i], t.p.org[2][i]},
                        dir[3] = {t.p.dir[0][i], t.p.dir[1][i], t.p.dir[2][i]},
                        sphere[4] = {t.s.center[0][k], t.s.center[1][k], t.s.center[2][k], t.s.radius[k]};
            const truth_roots roots = truth_sphere(org, dir, sphere);
            const truth_real at = roots.near >= (truth_real)t_min ? roots.near : roots.far;
            if (!roots.hit || truth_in_doubt(&roots) || at < (truth_real)t_min || at > (truth_real)t_max)
                continue;
            sum->hits++;
            sum->culled += t.outside >> k & 1;
            sum->cones += !(t.reached[k] & 1);
            sum->ts += (truth_real)t.s.min_t[k] > at;
        }
}

static void judge(uint32_t packets, float scale, bool cells, tally *sum)
{
    test_random r = random_make(77);
    error_scale = scale;
    while (packets--) {
        double side[2][3], along[3];
        float t_min, t_max;
        make_space(&r);
        if (!make_packet(&r, side, along))
            continue;
        make_range(&r, &t_min, &t_max);
        make_spheres(&r, side, along, t_min, t_max);
        t.v.p = &t.p;
        t.v.cull = CGT_CULL_BLOCKS;
        compute_in_mode();
        if (cells)
            judge_cells(t_min, t_max, sum);
        judge_spheres(t_min, t_max, sum);
    }
    error_scale = 1;
}

/* ---- tests ---- */

static cgt_committed_scene scene = {.scale = 1};

TEST(bounds_hold)
{
    tally sum = {0};
    t.v.committed_scene = &scene;
    judge(test_between(2000, 12000), 1, true, &sum);
    print_message(
        "%llu points: %llu of cells that are not visited; %llu hits: %llu culled by the frustum, %llu by cones, "
        "%llu before their t\n",
        (unsigned long long)sum.points, (unsigned long long)sum.cells, (unsigned long long)sum.hits,
        (unsigned long long)sum.culled, (unsigned long long)sum.cones, (unsigned long long)sum.ts);
    assert_true(sum.points > 10000 && sum.hits > 1000);
    assert_int_equal(sum.cells + sum.culled + sum.cones + sum.ts, 0);
}

TEST(bounds_break_where_they_are_tightened)
{
    static tally at[STEPS];
    float scale = 1;
    bool cells = true;
    t.v.committed_scene = &scene;
    for (int step = 0; step < bound_steps(); step++, scale *= 0.70710678f) {
        judge(test_between(2500, 4000), scale, cells, &at[step]);
        cells = cells && !at[step].cells; /* they take longest, and break first */
        if (!cells && at[step].culled && at[step].cones && at[step].ts)
            break; /* all have been seen to fail */
    }
    check_break("cells", at, sizeof at[0], offsetof(tally, cells), 0x1p-11);
    check_break("culling by the frustum", at, sizeof at[0], offsetof(tally, culled), 0x1p-11);
    check_break("cones", at, sizeof at[0], offsetof(tally, cones), 0x1p-11);
#ifndef CGT_SPU_EXACT /* truncated squares and roots make it less by themselves */
    check_break("first t", at, sizeof at[0], offsetof(tally, ts), 0x1p-11);
#endif
}

int main(void)
{
    (void)packet_test_prims; /* kernels that are included and not used */
    test_begin("test_frustum");
    if (!test_variant_runs(CGT_VARIANT_NAME))
        return TEST_SKIPPED;
    return SUITE_RUN(NULL, NULL);
}

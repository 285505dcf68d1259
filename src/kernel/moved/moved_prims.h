/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A moved ray (moved_ray.h) against lists of primitives, a vector of them at a time, by the tests of lane_tests.h in
 * the space of the scene's scale. What these leave undecided, and what lies at an end of the range, is decided on the
 * ray as it was given. */
#ifndef CGT_MOVED_PRIMS_H
#define CGT_MOVED_PRIMS_H

#include "kernel/primitive/decide_lanes.h"
#include "kernel/primitive/gather_primitives.h"
#include "kernel/primitive/lane_capsules.h"
#include "query/hit_list.h"
#include "query/moved_ray.h"

typedef struct moved_query {
    const cgt_committed_scene *committed_scene;
    const cgt_ray *given;
    cgt_counts *counts;
    uint32_t skip_prim; /* CGT_INVALID_ID: none */
    uint32_t mask;
    bool any_hit;
    bool done;          /* any hit: it has one */
    cgt_hit_list *list; /* gets all hits; NULL: the nearest one or any is asked for */
    moved_ray moved;
    uint32_t prim;   /* of the best hit; CGT_INVALID_ID: none yet */
    float low, high; /* interval of its T', or of the range's end */
    float rdd;       /* 1 / D D */
} moved_query;

/* The moved ray in every lane. Made for each test, since it takes a kilobyte of stack. */
static lane_rays moved_lanes(const moved_query *u)
{
    const moved_ray *m = &u->moved;
    /* |d| is from 1 to 2 sqrt(3), its largest component below 2: bounds of all directions will do */
    lane_rays r = {.rdd = spux_vfloat(u->rdd),
                   .rlength = spux_vfloat(1),
                   .max_dir = spux_vfloat(2),
                   .underflow = spux_vfloat(0x1.8p-117f),
                   .unscale = spux_vfloat(1),
                   .t_min = spux_vfloat(m->near_out),
                   .org_error = spux_vfloat(m->start_error / FILTER_ROUNDOFF)};
    for (int a = 0; a < 3; a++) {
        r.org[a] = r.scaled_org[a] = spux_vfloat(m->start[a]);
        r.dir[a] = spux_vfloat((float)m->dir[a]);
    }
    return r;
}

/* Whether the ray skips a primitive. */
static bool moved_skips(const moved_query *u, uint32_t prim)
{
    return prim == u->skip_prim || !(cgt_primitives_array(&u->committed_scene->prims, prim)->mask & u->mask);
}

/* Decides whether a primitive beats the best hit, which it then is; [low, high] holds its T' if it is hit. */
static void moved_decide(moved_query *u, uint32_t prim, float low, float high)
{
    double t;
    if (prim == u->prim || !filter_is_closer(&u->committed_scene->prims, u->given,
                                             u->any_hit ? CGT_INVALID_ID : u->prim, prim, &t, u->counts))
        return;
    /* canonical values are within 2^-30, and the way within 2^-49 of itself */
    const double place = t * u->moved.speed, error = fabs(place) * 0x1p-29 + fabs(u->moved.way) * 0x1p-48;
    const float first = moved_end(place - u->moved.way, error, -1), last = moved_end(place - u->moved.way, error, 1);
    u->prim = prim;
    u->low = low > first ? low : first;
    u->high = high < last ? high : last;
    u->done = u->any_hit;
}

/* Drops primitives, several at once, that do not beat the best hit. Returns the others. */
__attribute__((noinline)) static unsigned moved_drop(const moved_query *u, const uint32_t *prim, uint32_t count,
                                                     unsigned lanes)
{
    _Alignas(CGT_VECTOR_BYTES) uint32_t all[CGT_LANES];
    for (unsigned remaining = lanes; remaining; remaining &= remaining - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(remaining);
        if (moved_skips(u, prim[k]))
            lanes &= ~(1u << k);
    }
    for (uint32_t k = 0; k < CGT_LANES; k++)
        all[k] = prim[k < count ? k : 0];
    return CGT_KERNEL(cgt_decide_ray)(&u->committed_scene->prims, u->given, u->prim, u->any_hit, all, lanes, u->counts);
}

/* Lists what the test found. */
static void moved_list(moved_query *u, const lane_hits *q, const uint32_t *prim, unsigned used_lanes)
{
    unsigned remaining = spux_mask_bits(spu_or(q->certain_hit, q->undecided)) & used_lanes;
    _Alignas(CGT_VECTOR_BYTES) float low[CGT_LANES];
    spux_store(low, q->low);
    for (; remaining; remaining &= remaining - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(remaining);
        if (!(low[k] > u->high) && !moved_skips(u, prim[k]))
            cgt_hit_list_decide(u->list, prim[k], CGT_BOTH_SIDES);
        u->high = cgt_hit_list_end(u->list, u->high);
    }
}

/* Updates the best hit by what the test found about the first `count` lanes. beyond: how far after the interval the hit
 * may be if it is decided: whether a sphere's first root is in the range is not known then, and the second one is at
 * most the diameter away, since |d| is at least 1. */
static void moved_update(moved_query *u, const lane_hits *q, vfloat beyond, const uint32_t *prim, uint32_t count)
{
    const unsigned used_lanes = CGT_ALL_LANES >> (CGT_LANES - count);
    if (u->list) {
        moved_list(u, q, prim, used_lanes);
        return;
    }
    const vmask certain_lanes = spu_and(q->certain_hit, spu_cmpgt(q->low, spux_vfloat(u->moved.near_in)));
    const unsigned certain_hit = spux_mask_bits(certain_lanes), inside = spux_mask_bits(q->certain_hit);
    unsigned remaining = spux_mask_bits(spu_or(q->certain_hit, q->undecided)) & used_lanes;
    _Alignas(CGT_VECTOR_BYTES) float low[CGT_LANES], high[CGT_LANES], end[CGT_LANES];
    spux_store(low, q->low);
    spux_store(high, q->high);
    spux_store(end, spu_add(q->high, beyond));
    unsigned doubtful = 0;
    for (unsigned lanes = remaining; lanes; lanes &= lanes - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(lanes);
        if (low[k] <= u->high && !(certain_hit >> k & 1 && high[k] < u->low))
            doubtful |= 1u << k;
    }
    if (__builtin_expect(spux_count_bits(doubtful) >= DECIDE_MIN_LANES, 0))
        remaining &= ~doubtful | moved_drop(u, prim, count, doubtful);
    for (; remaining && !u->done; remaining &= remaining - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(remaining);
        if (low[k] > u->high || moved_skips(u, prim[k]))
            continue;
        if (certain_hit >> k & 1 && high[k] < u->low) {
            u->prim = prim[k];
            u->low = low[k];
            u->high = high[k];
            u->done = u->any_hit;
        } else
            moved_decide(u, prim[k], low[k], inside >> k & 1 ? end[k] : INFINITY);
    }
}

/* The next three test primitives and return whether any lane may hit. beyond: see moved_update. Not inlined: their
 * stack is free again when hits are decided. */
__attribute__((noinline)) static bool moved_test_spheres(const moved_query *u, const uint32_t *prim, uint32_t count,
                                                         lane_hits *q, vfloat *beyond)
{
    _Alignas(CGT_VECTOR_BYTES) float row[4][CGT_LANES] = {{0}};
    vfloat center[3];
    for (uint32_t k = 0; k < count; k++) {
        const cgt_sphere s = cgt_primitives_sphere(&u->committed_scene->prims, prim[k]);
        row[0][k] = s.x;
        row[1][k] = s.y;
        row[2][k] = s.z;
        row[3][k] = s.r;
    }
    const vfloat scale = spux_vfloat(u->committed_scene->scale);
    for (int a = 0; a < 3; a++)
        center[a] = spu_mul(spux_load(row[a]), scale);
    const vfloat radius = spu_mul(spux_load(row[3]), scale);
    *beyond = spu_mul(radius, spux_vfloat(2.0625f));
    const lane_rays ray = moved_lanes(u);
    return lane_test_sphere_from(&ray, center, radius, true, q);
}

__attribute__((noinline)) static bool moved_test_triangles(const moved_query *u, const uint32_t *prim, uint32_t count,
                                                           lane_hits *q, vfloat *beyond)
{
    _Alignas(CGT_VECTOR_BYTES) uint32_t number[CGT_LANES];
    const vfloat scale = spux_vfloat(u->committed_scene->scale);
    vfloat vertex[3][3];
    lane_triangles t;
    spux_store_uint(number, load_references(prim, count));
    gather_scene_triangles(&u->committed_scene->prims, number, vertex);
    for (int a = 0; a < 3; a++) {
        t.vertex[a] = spu_mul(vertex[0][a], scale);
        for (int i = 0; i < 2; i++)
            t.edge[i][a] = spu_sub(spu_mul(vertex[i + 1][a], scale), t.vertex[a]);
    }
    t.sum[0] = lane_sum(t.edge[0]);
    t.sum[1] = lane_sum(t.edge[1]);
    *beyond = spux_vfloat(0);
    const lane_rays ray = moved_lanes(u);
    return lane_test_triangle_from(&ray, &t, true, q);
}

__attribute__((noinline)) static bool moved_test_capsules(const moved_query *u, const uint32_t *prim, uint32_t count,
                                                          lane_hits *q, vfloat *beyond)
{
    const vfloat scale = spux_vfloat(u->committed_scene->scale);
    vfloat d[7], n[3];
    gather_scene_capsules(&u->committed_scene->prims, prim, count, d);
    for (int k = 0; k < 7; k++)
        d[k] = spu_mul(d[k], scale);
    for (int a = 0; a < 3; a++)
        n[a] = spu_sub(d[3 + a], d[a]);
    *beyond = spu_mul(spu_madd(d[6], spux_vfloat(2), lane_sum(n)), spux_vfloat(1 + 0x1p-5f));
    const lane_rays ray = moved_lanes(u);
    return lane_test_capsule_from(&ray, d, d + 3, d[6], true, q);
}

static bool moved_test_run(const moved_query *u, cgt_kind kind, const uint32_t *prim, uint32_t count, lane_hits *q,
                           vfloat *beyond)
{
    switch (kind) {
    case CGT_KIND_SPHERES: return moved_test_spheres(u, prim, count, q, beyond);
    case CGT_KIND_CAPSULES: return moved_test_capsules(u, prim, count, q, beyond);
    case CGT_KIND_TRIANGLES: break;
    }
    return moved_test_triangles(u, prim, count, q, beyond);
}

/* Tests a list of valid primitives. */
static void moved_test_prims(moved_query *u, const uint32_t *prim, uint32_t count)
{
    u->counts->packet_tests += count;
    u->counts->ray_tests += count;
    while (count && !u->done) {
        cgt_kind kind;
        lane_hits q;
        vfloat beyond;
        const uint32_t run = leaf_same_kind_run(&u->committed_scene->prims, prim, count, &kind);
        if (moved_test_run(u, kind, prim, run, &q, &beyond))
            moved_update(u, &q, beyond, prim, run);
        prim += run;
        count -= run;
    }
}

#endif

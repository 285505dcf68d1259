/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A tile of points against one light: 64 groups, a vector of rays each, with the range of slopes of each group's rays
 * as seen from the light; and the windows of primitives, which tell the groups that they may occlude.
 *
 * Windows are conservative: all numbers are widened by the packet's margin, 2^-17 of the largest number (in wide
 * scenes, of that of the rays and the primitive: light_packet.h), and divisions here are within 2^-20. A primitive that
 * reaches behind the light has no bounded slopes: its window is unbounded.
 *
 * Beside a point light, in the plane across the main axis, w is below 2^-128 and its reciprocal overflows. Nothing made
 * of that is used. In front, near_w > 0, is what lies beyond the margin with all vertices, so that w, at the nearest as
 * at the others, is above the margin m but for rounding. m is above 2^-72: a ray of a tile is plain, so that
 * the light is at least PACKET_MIN_DIR from its point, and so is M. m is 2^-16 of the primitive's own coordinates or
 * more, and near_w, a difference of floats, at least 2^-24 m. So no quotient exceeds 2^41. A primitive with a vertex in
 * that plane and others far ahead is not in front. All w in front are above 0, so slopes of a triangle's points lie
 * between those of its vertices.
 *
 * Apart from light_grid.c and light_read.c, which inline it. */
#ifndef CGT_LIGHT_GROUPS_H
#define CGT_LIGHT_GROUPS_H

#include "kernel/light/light_leaf.h"
#include "kernel/light/light_points.h"
#include "kernel/light/light_table.h"
#include "kernel/tile/prefetch_queue.h"

#define LIGHT_GROUPS 64u
#define LIGHT_TILE_RAYS (LIGHT_GROUPS * CGT_LANES)
#define LIGHT_TILE_PACKETS (LIGHT_TILE_RAYS / PACKET_MAX_RAYS)
#define LIGHT_PACKET_GROUPS (PACKET_MAX_RAYS / CGT_LANES)

/* A tile. w grows from the light on, of parallel rays, too. Of each group: the range of slopes along both axes, or of
 * offsets of parallel rays; and `end`, the largest w of its rays. So a primitive is compared by its end nearer to the
 * light. A group whose rays are all occluded has an empty range. */
typedef struct light_tile {
    _Alignas(64) float low[2][LIGHT_GROUPS];
    float high[2][LIGHT_GROUPS], end[LIGHT_GROUPS];
    _Alignas(64) uint32_t skip[LIGHT_GROUPS]; /* the primitive that all rays of a group skip; CGT_INVALID_ID: none */
    bool skips;                               /* some group has one; else they are not set */
    light_packet packet[LIGHT_TILE_PACKETS];
    uint32_t packets;
    uint64_t undecided;              /* groups with rays that have hit nothing, as bits */
    uint64_t changed;                /* groups some of whose rays were hit since their range was computed */
    uint32_t group_tests;            /* since all ranges were computed */
    float slope[2];                  /* of parallel rays */
    float margin;                    /* of lines along any axis */
    bool is_wide;                    /* some packet is */
    float lower[2], upper[2], far_w; /* over all groups: of low, high and end */
    light_table table;
    uint64_t met_references, met_cells; /* of the chunk, without a table */
    uint64_t table_read, table_kept;    /* references of cells that a table was asked for in this chunk; still needed */
    const cgt_committed_scene *committed_scene;
    cgt_counts *counts;
    uint64_t max_work; /* the light_work at which the chunk is given up */
    bool given_up;
    bool diverges; /* some packet of the chunk did not fit into a tile of its own */
    bool is_point;
    prefetch_queues pending;
    prefetch_owner prefetch; /* of `pending` */
} light_tile;

/* ---- primitives ---- */

/* Finds what the groups of a packet skip: mostly the surface that all of a group's points lie on, which no test of it
 * can drop at once. */
CGT_SPU_INLINE void light_find_skips(light_tile *t, uint32_t number)
{
    const packet *p = &t->packet[number].rays;
    if (!p->skips_prims)
        return;
    for (uint32_t g = 0; g < LIGHT_GROUPS && !t->skips; g += CGT_LANES)
        spux_store_uint(t->skip + g, spux_vuint(CGT_INVALID_ID));
    t->skips = true;
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const bool same = spux_all(spu_cmpeq(spux_load_uint(p->skip_prim + i), spux_vuint(p->skip_prim[i])));
        t->skip[number * LIGHT_PACKET_GROUPS + i / CGT_LANES] = same ? p->skip_prim[i] : CGT_INVALID_ID;
    }
}

/* The groups all of whose rays skip a primitive, as bits. */
CGT_SPU_INLINE uint64_t light_skipping_groups(const light_tile *t, uint32_t prim)
{
    uint64_t skipping = 0;
    for (uint32_t g = 0; g < LIGHT_GROUPS && t->skips; g += CGT_LANES)
        skipping |= (uint64_t)spux_mask_bits(spu_cmpeq(spux_load_uint(t->skip + g), spux_vuint(prim))) << g;
    return skipping;
}

/* Marks a group as done. */
CGT_SPU_INLINE void light_disable_group(light_tile *t, uint32_t group)
{
    for (int a = 0; a < 2; a++) {
        t->low[a][group] = INFINITY;
        t->high[a][group] = -INFINITY;
    }
    t->end[group] = -INFINITY;
    t->undecided &= ~((uint64_t)1 << group);
}

/* To be called after a test that may have hit rays of a group. */
CGT_SPU_INLINE void light_update_group(light_tile *t, uint32_t group)
{
    t->changed |= (uint64_t)1 << group;
    if (!(t->packet[group / LIGHT_PACKET_GROUPS].undecided >> group % LIGHT_PACKET_GROUPS & 1))
        light_disable_group(t, group);
}

/* Windows of a vector of primitives. */
typedef struct light_windows {
    _Alignas(CGT_VECTOR_BYTES) float low[2][CGT_LANES], high[2][CGT_LANES];
    float near_w[CGT_LANES]; /* the end nearer to the light */
} light_windows;

/* Groups whose ranges overlap window k, as bits. */
CGT_SPU_INLINE uint64_t light_overlapping_groups(const light_tile *t, const light_windows *w, uint32_t k)
{
    uint64_t overlaps = 0;
    for (uint32_t g = 0; g < LIGHT_GROUPS; g += CGT_LANES) {
        vmask in = spux_cmpge(spux_load(t->end + g), spux_vfloat(w->near_w[k]));
        for (int a = 0; a < 2; a++) {
            in = spu_and(in, spux_cmpge(spux_vfloat(w->high[a][k]), spux_load(t->low[a] + g)));
            in = spu_and(in, spux_cmpge(spux_load(t->high[a] + g), spux_vfloat(w->low[a][k])));
        }
        overlaps |= (uint64_t)spux_mask_bits(in) << g;
    }
    return overlaps & t->undecided;
}

/* Stores windows, and returns the lanes that overlap the tile, as bits. near_w, far_w: a primitive's ends along w.
 * by_table, a constant here and below: the table of open groups is asked, too. */
CGT_SPU_INLINE unsigned light_visible_windows(const light_tile *t, const vfloat low[2], const vfloat high[2],
                                              vfloat near_w, vfloat far_w, bool by_table, light_windows *w)
{
    const vfloat end = near_w, zero = spux_vfloat(0);
    vmask out = spu_cmpgt(end, spux_vfloat(t->far_w));
    if (t->is_point)
        out = spu_or(out, spu_cmpgt(zero, far_w));
    const vmask front = t->is_point ? spu_cmpgt(near_w, zero) : spux_mask_all();
    for (int a = 0; a < 2; a++) {
        const vfloat l = spux_select(spux_vfloat(-INFINITY), low[a], front);
        const vfloat h = spux_select(spux_vfloat(INFINITY), high[a], front);
        out = spu_or(out, spu_or(spu_cmpgt(l, spux_vfloat(t->upper[a])), spu_cmpgt(spux_vfloat(t->lower[a]), h)));
        spux_store(w->low[a], l);
        spux_store(w->high[a], h);
    }
    spux_store(w->near_w, end);
    if (by_table) {
        const vfloat first[2] = {spux_load(w->low[0]), spux_load(w->low[1])},
                     last[2] = {spux_load(w->high[0]), spux_load(w->high[1])};
        out = spu_or(out, light_table_hides(&t->table, first, last, end));
    }
    return ~spux_mask_bits(out) & CGT_ALL_LANES;
}

/* A point seen from the light. */
CGT_SPU_INLINE void light_project_point(const light_packet *l, const vfloat point[3], vfloat *w, vfloat v[2])
{
    const int main = l->axis[0];
    *w = spu_mul(spu_sub(point[main], spux_vfloat(l->origin[main])), spux_vfloat(l->sign));
    for (int a = 0; a < 2; a++)
        v[a] = spu_sub(point[l->axis[a + 1]], spux_vfloat(l->origin[l->axis[a + 1]]));
}

/* Boxes, by middles and half extents. */
CGT_SPU_INLINE unsigned light_project_boxes(const light_tile *t, const vfloat middle[3], const vfloat half[3],
                                            bool by_table, light_windows *windows)
{
    const light_packet *l = &t->packet[0];
    vfloat w, v[2], low[2], high[2], half_size[3], margin = spux_vfloat(t->margin);
    if (t->is_wide) {
        vfloat magnitude = spu_add(spux_abs(middle[0]), half[0]);
        for (int a = 1; a < 3; a++)
            magnitude = spux_max(magnitude, spu_add(spux_abs(middle[a]), half[a]));
        margin = spu_add(margin, light_own_margin(magnitude));
    }
    light_project_point(l, middle, &w, v);
    for (int k = 0; k < 3; k++)
        half_size[k] = spu_madd(half[l->axis[k]], spux_vfloat(1 + 0x1p-20f), margin);
    const vfloat near_w = spu_sub(w, half_size[0]), far_w = spu_add(w, half_size[0]), one = spux_vfloat(1);
    const vfloat rnear = spux_div(one, near_w), rfar = spux_div(one, far_w);
    for (int a = 0; a < 2; a++) {
        if (t->is_point) {
            const vfloat lower = spu_sub(v[a], half_size[a + 1]), upper = spu_add(v[a], half_size[a + 1]);
            low[a] = spux_min(spu_mul(lower, rnear), spu_mul(lower, rfar));
            high[a] = spux_max(spu_mul(upper, rnear), spu_mul(upper, rfar));
        } else {
            const vfloat coord = spu_nmsub(spux_vfloat(t->slope[a]), w, v[a]);
            const vfloat offset_error = spu_madd(half_size[0], spux_vfloat(fabsf(t->slope[a])), half_size[a + 1]);
            low[a] = spu_sub(coord, offset_error);
            high[a] = spu_add(coord, offset_error);
        }
    }
    return light_visible_windows(t, low, high, near_w, far_w, by_table, windows);
}

CGT_SPU_INLINE unsigned light_project_spheres(const light_tile *t, const sphere_block *s, bool by_table,
                                              light_windows *windows)
{
    const vfloat center[3] = {spux_load(s->center[0]), spux_load(s->center[1]), spux_load(s->center[2])};
    const vfloat radius = spux_load(s->radius), half[3] = {radius, radius, radius};
    return light_project_boxes(t, center, half, by_table, windows);
}

CGT_SPU_INLINE unsigned light_project_triangles(const light_tile *t, vfloat vertex[3][3], bool by_table,
                                                light_windows *windows)
{
    vfloat w[3], v[3][2], low[2], high[2], margin = spux_vfloat(t->margin);
    if (t->is_wide) {
        vfloat magnitude = spux_vfloat(0);
        for (int k = 0; k < 9; k++)
            magnitude = spux_max(magnitude, spux_abs(vertex[k / 3][k % 3]));
        margin = spu_add(margin, light_own_margin(magnitude));
    }
    for (int k = 0; k < 3; k++)
        light_project_point(&t->packet[0], vertex[k], &w[k], v[k]);
    const vfloat near_w = spu_sub(spux_min(w[0], spux_min(w[1], w[2])), margin);
    const vfloat far_w = spu_add(spux_max(w[0], spux_max(w[1], w[2])), margin);
    vfloat scale[3], margin_slope = margin; /* the margin as a slope, without the factor 1 + |slope| */
    for (int k = 0; k < 3; k++)
        scale[k] = t->is_point ? spux_div(spux_vfloat(1), w[k]) : spux_vfloat(1);
    if (t->is_point)
        margin_slope = spux_div(spu_add(margin, margin), near_w);
    for (int a = 0; a < 2; a++) {
        vfloat coord[3];
        for (int k = 0; k < 3; k++)
            coord[k] = t->is_point ? spu_mul(v[k][a], scale[k]) : spu_nmsub(spux_vfloat(t->slope[a]), w[k], v[k][a]);
        const vfloat lower = spux_min(coord[0], spux_min(coord[1], coord[2])),
                     upper = spux_max(coord[0], spux_max(coord[1], coord[2]));
        const vfloat size = spux_max(spux_abs(lower), spux_abs(upper));
        const vfloat slope_error = t->is_point ? spu_madd(margin_slope, size, margin_slope)
                                               : spu_mul(margin, spux_vfloat(1 + fabsf(t->slope[a])));
        low[a] = spu_sub(lower, slope_error);
        high[a] = spu_add(upper, slope_error);
    }
    return light_visible_windows(t, low, high, near_w, far_w, by_table, windows);
}

/* ---- slopes ---- */

/* Slopes or offsets of rays, and w. Returns the lanes whose slope is too large. */
CGT_SPU_INLINE vmask light_project_rays(const light_tile *t, const light_packet *l, const vfloat org[3], vfloat *w,
                                        vfloat coord[2])
{
    vmask diverging = spux_mask_none();
    vfloat v[2];
    light_project_point(l, org, w, v);
    const vfloat rw = t->is_point ? spux_div(spux_vfloat(1), *w) : spux_vfloat(1);
    if (t->is_point)
        diverging = spux_not(spu_cmpgt(*w, spux_vfloat(0)));
    for (int a = 0; a < 2; a++) {
        coord[a] = t->is_point ? spu_mul(v[a], rw) : spu_nmsub(spux_vfloat(t->slope[a]), *w, v[a]);
        if (t->is_point)
            diverging = spu_or(diverging, spux_not(spu_cmpgt(spux_vfloat(LIGHT_MAX_SLOPE), spux_abs(coord[a]))));
    }
    return diverging;
}

/* The range of a group, over the rays that have hit nothing. Returns the lanes whose slope is too large. */
CGT_SPU_INLINE vmask light_compute_group(light_tile *t, uint32_t group)
{
    const light_packet *l = &t->packet[group / LIGHT_PACKET_GROUPS];
    const packet *p = &l->rays;
    const uint32_t i = group % LIGHT_PACKET_GROUPS * CGT_LANES;
    const vmask undecided = spu_cmpgt(spux_load(p->high + i), spux_vfloat(-INFINITY));
    const vfloat none = spux_vfloat(INFINITY), minus = spux_vfloat(-INFINITY);
    vfloat org[3], w, coord[2];
    for (int a = 0; a < 3; a++)
        org[a] = spux_load(p->org[a] + i);
    const vmask diverging = light_project_rays(t, l, org, &w, coord);
    for (int a = 0; a < 2; a++) {
        t->low[a][group] = spux_hmin(spux_select(none, coord[a], undecided));
        t->high[a][group] = spux_hmax(spux_select(minus, coord[a], undecided));
    }
    t->end[group] = spux_hmax(spux_select(minus, w, undecided));
    return diverging;
}

/* The groups of a packet. Returns false if a slope is too large. */
static inline bool light_compute_groups(light_tile *t, uint32_t number)
{
    vmask diverging = spux_mask_none();
    for (uint32_t i = 0; i < t->packet[number].rays.lanes; i += CGT_LANES)
        diverging = spu_or(diverging, light_compute_group(t, number * LIGHT_PACKET_GROUPS + i / CGT_LANES));
    return spux_none(diverging);
}

/* The bounds over all groups. */
static inline void light_compute_bounds(light_tile *t)
{
    vfloat far_w = spux_vfloat(-INFINITY);
    for (uint32_t g = 0; g < LIGHT_GROUPS; g += CGT_LANES)
        far_w = spux_max(far_w, spux_load(t->end + g));
    t->far_w = spux_hmax(far_w);
    for (int a = 0; a < 2; a++) {
        vfloat lower = spux_vfloat(INFINITY), upper = spux_vfloat(-INFINITY);
        for (uint32_t g = 0; g < LIGHT_GROUPS; g += CGT_LANES) {
            lower = spux_min(lower, spux_load(t->low[a] + g));
            upper = spux_max(upper, spux_load(t->high[a] + g));
        }
        t->lower[a] = spux_hmin(lower);
        t->upper[a] = spux_hmax(upper);
    }
}

/* Makes the table of the groups as they are. */
static inline void light_make_table(light_tile *t)
{
    const float *const low[2] = {t->low[0], t->low[1]}, *const high[2] = {t->high[0], t->high[1]};
    light_table_make(&t->table, t->lower, t->upper, low, high, t->end, t->undecided);
}

/* Recomputes the ranges of changed groups over the rays that have hit nothing yet. */
static inline void light_refresh_groups(light_tile *t)
{
    for (uint64_t remaining = t->changed & t->undecided; remaining; remaining &= remaining - 1)
        light_compute_group(t, (uint32_t)__builtin_ctzll(remaining));
    t->changed = 0;
    t->group_tests = 0;
    light_compute_bounds(t);
    if (t->table.is_set)
        light_make_table(t);
}

/* ---- reading ---- */

/* Sets the axes and the origin of a packet: those of the tile's first packet, which are chosen by any ray of it.
 * Returns false if that ray has no direction. */
CGT_SPU_INLINE bool light_tile_init_axes(light_tile *t, light_packet *l, const float org[3], const float dir[3])
{
    const light_packet *first = &t->packet[0];
    if (t->packets) {
        for (int a = 0; a < 3; a++) {
            l->axis[a] = first->axis[a];
            l->origin[a] = first->origin[a];
        }
        l->sign = first->sign;
        return true;
    }
    if (!light_init_axes(&l->rays, org, dir, l))
        return false;
    l->sign = t->is_point ? l->sign : -l->sign; /* from the light on */
    for (int a = 0; a < 2; a++)
        t->slope[a] = t->is_point ? 0 : dir[l->axis[a + 1]] / (l->sign * dir[l->axis[0]]);
    return true;
}

/* Reads the tile's next packet in one pass: points first to first + count - 1 of the order, whole vectors of
 * light_points_are_dense without ranges of their own. Returns false where something about them is unusual. */
bool CGT_KERNEL(cgt_light_tile_read)(const light_call *c, light_tile *t, light_packet *l, uint32_t first,
                                     uint32_t count);

#endif

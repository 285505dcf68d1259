/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Coherent grid traversal of a packet (Wald et al. 2006; Chapman, section 3): the frustum marches slice by slice along
 * its main axis; the references in the cells that it touches are collected; a vector of primitives at a time is culled
 * against the frustum; what is left is tested against the rays; the packet is done when every ray's hit lies before
 * the next slice.
 *
 * The cells of the slices are visited in two ways with the same result: by three nested loops, and by Chapman's one
 * loop, which steps cell, row and slice by selection and not by branches. His listing keeps one pair of bounds for all
 * slices and enters slices that hold no cell; here the bounds of every slice are found first, empty ones left out. */
#include "frustum.h"
#include "kernel.h"
#include "sphere_filter.h"
#include "triangle_tests.h"

#define BATCH_FULL 128
#define MAILBOX_SIZE 64 /* direct mapped by the low bits of the reference */

typedef struct traversal {
    const cgt_world *world;
    const cgt_queue_grid *grid;
    packet *p;
    cgt_counts *counts;
    frustum frustum;
    filter_packet filter;
    block_cones blocks;
    float w_far; /* no ray wants a hit beyond */
    cgt_cull cull;
    bool mailbox;
    uint32_t pending; /* references collected and not yet tested */
    _Alignas(64) uint32_t reference[BATCH_FULL + CGT_QUEUE_LENGTH];
    uint32_t seen[MAILBOX_SIZE];
} traversal;

/* ---- collecting ---- */

static void collect_overflow(traversal *v, uint32_t cell);
static void test_pending(traversal *v);

/* A voxel's references fill it from the front: copy all of it, keep the ones that are there. */
CGT_SPU_INLINE uint32_t copy_narrow(const cgt_voxel *voxel, uint32_t *to)
{
    for (int k = 0; k < CGT_QUEUE_LENGTH; k++)
        to[k] = voxel->reference[k];
    return spux_find16(voxel->reference, CGT_QUEUE_NONE);
}
CGT_SPU_INLINE uint32_t copy_wide(const cgt_wide_voxel *voxel, uint32_t *to)
{
    uint32_t none = 1u << CGT_QUEUE_LENGTH;
    for (uint32_t k = 0; k < CGT_QUEUE_LENGTH; k += CGT_LANES) {
        const vuint reference = spux_load_uint(voxel->reference + k);
        spux_store_unaligned_uint(to + k, reference);
        none |= spux_mask_bits(spu_cmpeq(reference, spux_vuint(CGT_NONE))) << k;
    }
    return (uint32_t)__builtin_ctz(none);
}

CGT_SPU_INLINE void visit_cell(traversal *v, uint32_t cell)
{
    uint32_t *to = v->reference + v->pending;
    const uint32_t length =
        v->grid->wide ? copy_wide(&v->grid->wide_voxel[cell], to) : copy_narrow(&v->grid->voxel[cell], to);
    v->pending += length;
    v->counts->cells++;
    if (length == CGT_QUEUE_LENGTH && v->grid->overflows)
        collect_overflow(v, cell);
}

static void collect_overflow(traversal *v, uint32_t cell)
{
    const cgt_queue_grid *g = v->grid;
    for (uint32_t i = cgt_queue_grid_overflow(g, cell); i < g->overflows && g->overflow[i].cell == cell; i++) {
        if (v->pending >= BATCH_FULL)
            test_pending(v);
        v->reference[v->pending++] = g->overflow[i].reference;
    }
}

/* Takes out the references that the mailbox holds, puts the others in. */
static void apply_mailbox(traversal *v)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < v->pending; i++) {
        const uint32_t reference = v->reference[i], slot = reference % MAILBOX_SIZE;
        const bool seen = v->seen[slot] == reference;
        v->reference[kept] = reference;
        v->seen[slot] = reference;
        kept += !seen;
    }
    v->counts->mailbox_skipped += v->pending - kept;
    v->pending = kept;
}

/* ---- culling ---- */

/* Points of a vector in grid space, along the frustum's axes: w along the rays, then u and v. */
typedef struct frustum_points {
    vfloat w, uv[2];
} frustum_points;

CGT_SPU_INLINE frustum_points points_in_frustum(const traversal *v, const float p[3][CGT_LANES])
{
    const frustum *f = &v->frustum;
    return (frustum_points){grid_coordinates(v->grid, f->w, f->reverse, spux_load(p[f->w])),
                            {grid_coordinates(v->grid, f->u, false, spux_load(p[f->u])),
                             grid_coordinates(v->grid, f->v, false, spux_load(p[f->v]))}};
}

/* How far inside bound k of the frustum points are, in cells; the errors of both are in `error` of the callers. */
CGT_SPU_INLINE vfloat inside_bound(const traversal *v, const frustum_points *p, int k)
{
    const frustum *f = &v->frustum;
    const vfloat along = spu_sub(p->w, spux_vfloat(f->w0));
    const vfloat x = k & 1 ? spu_xor(p->uv[k >> 1], spux_vfloat(-0.f)) : p->uv[k >> 1];
    return spu_sub(x, spu_madd(spux_vfloat(f->step[k]), along, spux_vfloat(f->bound[k])));
}

/* Lanes whose sphere lies outside the frustum, or before or beyond what its rays still want. */
static unsigned spheres_outside(const traversal *v, const filter_spheres *s)
{
    const frustum *f = &v->frustum;
    const vfloat r = spux_load(s->radius), error = spux_vfloat(f->plane_error);
    const frustum_points p = points_in_frustum(v, (const float(*)[CGT_LANES])s->center);
    const vfloat reach = spu_madd(r, spux_vfloat(v->grid->rcell[f->w] * (1 + 0x1p-20f)), error);
    vmask outside = spu_or(spu_cmpgt(spu_sub(p.w, reach), spux_vfloat(v->w_far)),
                           spu_cmpgt(spux_vfloat(f->w_near), spu_add(p.w, reach)));
    for (int k = 0; k < 4; k++) {
        const vfloat most = spu_madd(r, spux_vfloat(f->radius_scale[k]), error);
        outside = spu_or(outside, spu_cmpgt(spux_vfloat(0), spu_add(inside_bound(v, &p, k), most)));
    }
    return spux_mask_bits(outside);
}

/* Lanes whose triangle has all three vertices outside the same bound of the frustum, or before or beyond. */
static unsigned triangles_outside(const traversal *v, const filter_triangles *s)
{
    const frustum *f = &v->frustum;
    const vfloat error = spux_vfloat(f->plane_error);
    vfloat near, far, inside[4];
    for (int i = 0; i < 3; i++) {
        const frustum_points p = points_in_frustum(v, (const float(*)[CGT_LANES])s->vertex[i]);
        near = i ? spux_min(near, p.w) : p.w;
        far = i ? spux_max(far, p.w) : p.w;
        for (int k = 0; k < 4; k++) {
            const vfloat d = inside_bound(v, &p, k);
            inside[k] = i ? spux_max(inside[k], d) : d;
        }
    }
    vmask outside = spu_or(spu_cmpgt(spu_sub(near, error), spux_vfloat(v->w_far)),
                           spu_cmpgt(spux_vfloat(f->w_near), spu_add(far, error)));
    for (int k = 0; k < 4; k++)
        outside = spu_or(outside, spu_cmpgt(spux_vfloat(0), spu_add(inside[k], error)));
    return spux_mask_bits(outside);
}

/* ---- testing ---- */

static void test_spheres(traversal *v, filter_spheres *s, unsigned lanes)
{
    filter_spheres_bound(&v->filter, s);
    for (; lanes; lanes &= lanes - 1) {
        const int k = __builtin_ctz(lanes);
        v->counts->packet_tests++;
#define CALL(mode) filter_test_sphere(&v->world->objects, v->p, s, k, &v->blocks, mode, v->counts)
        FILTER_FOR_MODE(v->p, false, CALL)
#undef CALL
    }
}

static void test_triangles(traversal *v, filter_triangles *s, unsigned lanes)
{
    if (v->p->fast)
        filter_triangles_prepare_fast(&v->filter, s);
    else
        filter_triangles_bound(&v->filter, s);
    for (; lanes; lanes &= lanes - 1) {
        const int k = __builtin_ctz(lanes);
        v->counts->packet_tests++;
#define CALL(mode) filter_test_triangle(&v->world->objects, v->p, &v->filter, s, k, &v->blocks, mode, v->counts)
        FILTER_FOR_MODE(v->p, true, CALL)
#undef CALL
    }
}

/* Counts what culling left, and returns it. */
static unsigned count_culled(traversal *v, unsigned lanes, unsigned outside, uint32_t count)
{
    lanes &= ~outside;
    v->counts->cull_tests += count;
    v->counts->culled += count - spux_count_bits(lanes);
    return lanes;
}

static void test_sphere_list(traversal *v, const uint32_t *reference, uint32_t length)
{
    filter_spheres s;
    for (uint32_t i = 0; i < length; i += CGT_LANES) {
        const uint32_t count = length - i < CGT_LANES ? length - i : CGT_LANES;
        unsigned lanes = CGT_ALL_LANES >> (CGT_LANES - count);
        filter_spheres_fetch(&v->world->objects, reference + i, count, CGT_LANES, &s);
        if (v->cull != CGT_CULL_NONE)
            lanes = count_culled(v, lanes, spheres_outside(v, &s), count);
        if (lanes)
            test_spheres(v, &s, lanes);
    }
}

static void test_triangle_list(traversal *v, const uint32_t *reference, uint32_t length)
{
    filter_triangles s;
    for (uint32_t i = 0; i < length; i += CGT_LANES) {
        const uint32_t count = length - i < CGT_LANES ? length - i : CGT_LANES;
        unsigned lanes = CGT_ALL_LANES >> (CGT_LANES - count);
        filter_triangles_fetch(&v->world->objects, reference + i, count, CGT_LANES, &s);
        if (v->cull != CGT_CULL_NONE)
            lanes = count_culled(v, lanes, triangles_outside(v, &s), count);
        if (lanes)
            test_triangles(v, &s, lanes);
    }
}

/* Spheres to the front, triangles to a list of their own; only scenes of both kinds come here. */
static void test_mixed_list(traversal *v, uint32_t *reference, uint32_t length)
{
    uint32_t triangle[BATCH_FULL + CGT_QUEUE_LENGTH], spheres = 0, triangles = 0;
    for (uint32_t i = 0; i < length; i++) {
        const uint32_t object = reference[i];
        const bool sphere = cgt_objects_array(&v->world->objects, object)->kind == CGT_KIND_SPHERES;
        reference[spheres] = object;
        triangle[triangles] = object;
        spheres += sphere;
        triangles += !sphere;
    }
    test_sphere_list(v, reference, spheres);
    test_triangle_list(v, triangle, triangles);
}

static void test_pending(traversal *v)
{
    const cgt_objects *objects = &v->world->objects;
    v->counts->references += v->pending;
    if (v->mailbox)
        apply_mailbox(v);
    if (!objects->triangles)
        test_sphere_list(v, v->reference, v->pending);
    else if (!objects->spheres)
        test_triangle_list(v, v->reference, v->pending);
    else
        test_mixed_list(v, v->reference, v->pending);
    v->pending = 0;
}

/* The coordinate w beyond which no ray wants a hit: by blocks where their rays share an origin and start there. */
static float far_coordinate(const traversal *v)
{
    const packet *p = v->p;
    vfloat most = spux_vfloat(-INFINITY);
    if (!p->from_origin)
        return frustum_far(v->grid, &v->frustum, p);
    for (uint32_t i = 0; i < v->blocks.blocks; i += CGT_LANES)
        most = spux_max(spu_mul(spux_load(v->blocks.far + i), spux_load(v->blocks.speed + i)), most);
    return frustum_far_from_origin(v->grid, &v->frustum, p, spux_hmax(most));
}

/* After a slice: tests what it held. True where no ray wants anything from the next slice on. */
static bool finish_slice(traversal *v, uint32_t slice)
{
    if (v->pending) {
        test_pending(v);
        v->w_far = far_coordinate(v);
    }
    if (!(v->w_far < (float)(slice + 1)))
        return false;
    v->counts->early_exits++;
    return true;
}

/* ---- the two loops ---- */

static void traverse_nested(traversal *v)
{
    const frustum *f = &v->frustum;
    const uint32_t *stride = v->grid->stride;
    for (uint32_t slice = f->first; slice < f->end; slice++) {
        const vec_int4 b = frustum_slice(f, slice);
        const uint32_t cell = frustum_slice_cell(v->grid, f, slice);
        v->counts->slices++;
        for (int32_t y = b[2]; y <= b[3]; y++)
            for (int32_t x = b[0]; x <= b[1]; x++) {
                visit_cell(v, cell + (uint32_t)y * stride[f->v] + (uint32_t)x * stride[f->u]);
                if (v->pending >= BATCH_FULL)
                    test_pending(v);
            }
        if (finish_slice(v, slice))
            return;
    }
}

/* A slice that holds cells. */
typedef struct slice_cells {
    int32_t low_u, high_u, low_v, high_v;
    uint32_t cell; /* voxel of its (0, 0) */
    uint32_t slice;
} slice_cells;

/* Finds the slices and returns how many cells they hold in all. */
static uint32_t find_slices(traversal *v, slice_cells *s)
{
    const frustum *f = &v->frustum;
    uint32_t slices = 0, cells = 0;
    for (uint32_t slice = f->first; slice < f->end; slice++) {
        const vec_int4 b = frustum_slice(f, slice);
        const int32_t across = b[1] - b[0] + 1, down = b[3] - b[2] + 1;
        const bool some = across > 0 && down > 0;
        s[slices] = (slice_cells){b[0], b[1], b[2], b[3], frustum_slice_cell(v->grid, f, slice), slice};
        slices += some;
        cells += some ? (uint32_t)(across * down) : 0;
    }
    s[slices] = s[slices ? slices - 1 : 0]; /* read, not used, after the last cell */
    v->counts->slices += slices;
    return cells;
}

static void traverse_flattened(traversal *v)
{
    slice_cells slices[CGT_GRID_MAX_RESOLUTION + 1];
    const slice_cells *s = slices;
    const uint32_t stride_u = v->grid->stride[v->frustum.u], stride_v = v->grid->stride[v->frustum.v];
    const uint32_t cells = find_slices(v, slices);
    int32_t x = s->low_u, y = s->low_v;
    for (uint32_t left = cells; left; left--) {
        visit_cell(v, s->cell + (uint32_t)y * stride_v + (uint32_t)x * stride_u);
        const bool row_ends = x == s->high_u, slice_ends = row_ends & (y == s->high_v);
        const slice_cells *next = s + slice_ends;
        const int32_t x_next = row_ends ? next->low_u : x + 1, y_next = slice_ends ? next->low_v : y + row_ends;
        if (slice_ends | (v->pending >= BATCH_FULL)) {
            if (!slice_ends)
                test_pending(v);
            else if (finish_slice(v, s->slice))
                return;
        }
        x = x_next;
        y = y_next;
        s = next;
    }
}

/* ---- packets ---- */

/* A packet that spreads over more cells of a slice than this many per ray is halved. Measured with shuffled rays; flat
 * from half to twice as many. */
#define CELLS_PER_RAY 3.f

static void trace_parts(const cgt_world *world, packet *p, const uint32_t *part, uint32_t parts,
                        const cgt_trace_settings *settings, cgt_counts *counts);

static bool runs_apart(const traversal *v)
{
    const frustum *f = &v->frustum;
    const vec_int4 b = frustum_slice(f, f->first + (f->end - f->first) / 2);
    const float cells = (float)(b[1] - b[0] + 1) * (float)(b[3] - b[2] + 1);
    return v->p->rays > 1 && b[1] >= b[0] && cells > 4 + CELLS_PER_RAY * (float)v->p->rays;
}

/* Rays with one main axis and sign. */
static void traverse(const cgt_world *world, packet *p, uint32_t class, const cgt_trace_settings *settings,
                     cgt_counts *counts)
{
    traversal v;
    v.world = world;
    v.grid = &world->grid;
    v.p = p;
    v.counts = counts;
    v.cull = settings->cull;
    v.mailbox = settings->mailbox;
    v.pending = 0;
    if (!frustum_make(v.grid, p, (int)(class >> 1), class & 1, &v.frustum))
        return;
    if (runs_apart(&v)) {
        uint32_t part[PACKET_MAX_RAYS], seen = 0;
        for (uint32_t i = 0; i < p->lanes; i++) {
            part[i] = seen >= p->rays / 2;
            seen += p->high[i] != -INFINITY;
        }
        trace_parts(world, p, part, 2, settings, counts);
        return;
    }
    counts->packets++;
    filter_packet_make(p, world->scale, &v.filter);
    if (world->objects.triangles && !p->common_origin)
        filter_moments_make(p, &v.filter);
    block_cones_make(p, v.cull == CGT_CULL_BLOCKS, v.frustum.w, v.grid->rcell[v.frustum.w], &v.blocks);
    v.w_far = far_coordinate(&v);
    if (v.mailbox)
        memset(v.seen, 0xff, sizeof v.seen);
    if (settings->flattened)
        traverse_flattened(&v);
    else
        traverse_nested(&v);
}

/* Main axis and sign of each ray as a number: 2 * axis + reverse. */
static void classify(const packet *p, uint32_t *class)
{
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const vfloat d[3] = {spux_load(p->dir[0] + i), spux_load(p->dir[1] + i), spux_load(p->dir[2] + i)};
        const vfloat x = spux_abs(d[0]), y = spux_abs(d[1]), z = spux_abs(d[2]), zero = spux_vfloat(0);
        const vmask y_is_main = spu_andc(spu_cmpgt(y, x), spu_cmpgt(z, y));
        const vmask z_is_main = spu_and(spu_cmpgt(z, x), spu_cmpgt(z, y));
        const vfloat main = spux_select(spux_select(d[0], d[1], y_is_main), d[2], z_is_main);
        const vuint y_axis = spux_select(spux_vuint(0), spux_vuint(2), y_is_main);
        const vuint axis = spux_select(y_axis, spux_vuint(4), z_is_main);
        spux_store_uint(class + i, spux_select(axis, spu_or(axis, spux_vuint(1)), spu_cmpgt(zero, main)));
    }
}

static bool all_equal(const uint32_t *class, uint32_t count)
{
    uint32_t differs = 0;
    for (uint32_t i = 1; i < count; i++)
        differs |= class[i] ^ class[0];
    return !differs;
}

/* Copies the rays of one part to a packet of their own; from[] tells where each came from. */
static void extract_part(const packet *p, const uint32_t *part, uint32_t wanted, packet *sub, uint32_t *from)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < p->lanes; i++)
        if (part[i] == wanted && p->high[i] != -INFINITY)
            from[n++] = i;
    sub->rays = n;
    sub->lanes = (n + CGT_LANES - 1) / CGT_LANES * CGT_LANES;
    for (uint32_t k = 0; k < sub->lanes; k++) {
        const uint32_t i = from[k < n ? k : 0];
        for (int a = 0; a < 3; a++) {
            sub->org[a][k] = p->org[a][i];
            sub->dir[a][k] = p->dir[a][i];
        }
        sub->rdd[k] = p->rdd[i];
        sub->t_min[k] = p->t_min[i];
        sub->t_max[k] = p->t_max[i];
        sub->low[k] = k < n ? p->low[i] : -INFINITY;
        sub->high[k] = k < n ? p->high[i] : -INFINITY;
        sub->object[k] = p->object[i];
        sub->u[k] = p->u[i];
        sub->v[k] = p->v[i];
    }
}

static void trace_parts(const cgt_world *world, packet *p, const uint32_t *part, uint32_t parts,
                        const cgt_trace_settings *settings, cgt_counts *counts)
{
    packet sub;
    uint32_t from[PACKET_MAX_RAYS];
    sub.common_origin = p->common_origin;
    sub.from_origin = p->from_origin;
    sub.any_hit = p->any_hit;
    sub.fast = p->fast;
    sub.triangle_test = p->triangle_test;
    sub.extreme = false;
    counts->split_packets++;
    for (uint32_t k = 0; k < parts; k++) {
        extract_part(p, part, k, &sub, from);
        if (!sub.rays)
            continue;
        CGT_KERNEL(cgt_queue_grid_trace)(world, &sub, settings, counts);
        for (uint32_t i = 0; i < sub.rays; i++) {
            p->low[from[i]] = sub.low[i];
            p->high[from[i]] = sub.high[i];
            p->object[from[i]] = sub.object[i];
            if (p->fast) {
                p->u[from[i]] = sub.u[i];
                p->v[from[i]] = sub.v[i];
            }
        }
    }
}

/* Splits by main axis and sign first. */
void CGT_KERNEL(cgt_queue_grid_trace)(const cgt_world *world, packet *p, const cgt_trace_settings *settings,
                                      cgt_counts *counts)
{
    _Alignas(64) uint32_t class[PACKET_MAX_RAYS];
    class[0] = 0; /* there is at least one ray, which the compiler cannot know */
    classify(p, class);
    if (all_equal(class, p->lanes))
        traverse(world, p, class[0], settings, counts);
    else
        trace_parts(world, p, class, 6, settings, counts);
}

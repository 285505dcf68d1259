/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The pass over all primitives of a commit, a vector at a time: skipped ones, bounds, sizes. The results are those of
 * visiting one primitive after the other, for any vector width: sums are added in that order, in double; extremes do
 * not depend on it. */
#include "exact/valid_primitive.h"
#include "dispatch/kernel.h"

#include <math.h>

#include "kernel/builders/cluster_bounds.h"
#include "kernel/primitive/gather_primitives.h"

/* The results for a vector of primitives. */
typedef struct lane_bounds {
    vfloat low[3], high[3];
    vmask valid;
} lane_bounds;

/* The pass so far. */
typedef struct bounds_pass {
    cgt_primitive_bounds *bounds;
    const cgt_bounds_request *request;
    vfloat low[3], high[3];
    size_gather *sizes; /* in the scratch; of classes without clusters */
} bounds_pass;

static void bounds_pass_init(bounds_pass *p, const cgt_bounds_request *request, cgt_primitive_bounds *bounds)
{
    p->bounds = bounds;
    p->request = request;
    for (int a = 0; a < 3; a++) {
        p->low[a] = spux_vfloat(INFINITY);
        p->high[a] = spux_vfloat(-INFINITY);
    }
    p->sizes = NULL;
    if (request->classes && !request->cluster) {
        p->sizes = cgt_scratch_take(request->scratch, sizeof *p->sizes);
        size_gather_clear(p->sizes);
    }
}

static void bounds_pass_store(const bounds_pass *p, cgt_kind kind)
{
    cgt_primitive_bounds *s = p->bounds;
    for (int a = 0; a < 3; a++) {
        const float low = spux_hmin(p->low[a]), high = spux_hmax(p->high[a]);
        s->min[a] = low < s->min[a] ? low : s->min[a];
        s->max[a] = high > s->max[a] ? high : s->max[a];
    }
    if (p->sizes)
        size_gather_store(p->sizes, kind == CGT_KIND_SPHERES ? 1 : 3, p->request->classes);
}

CGT_SPU_INLINE void add_bounds(bounds_pass *p, const lane_bounds *b)
{
    for (int a = 0; a < 3; a++) {
        p->low[a] = spux_select(p->low[a], spux_min(p->low[a], b->low[a]), b->valid);
        p->high[a] = spux_select(p->high[a], spux_max(p->high[a], b->high[a]), b->valid);
    }
    p->bounds->valid += spux_count_bits(spux_mask_bits(b->valid));
}

CGT_SPU_INLINE void add_diameter(cgt_primitive_bounds *s, double d)
{
    s->diameter[1] += d;
    s->diameter[2] += d * d;
    s->diameter[3] += d * d * d;
}

/* ---- spheres ---- */

/* Which of the spheres or capsules take part: `numbers` of them, the last one a radius. */
CGT_SPU_INLINE vmask check_round(const vfloat d[], int numbers, vmask present, cgt_primitive_bounds *s)
{
    const vfloat infinity = spux_vfloat(INFINITY);
    vmask finite = present;
    for (int k = 0; k < numbers; k++)
        finite = spu_and(finite, spu_cmpgt(infinity, spux_abs(d[k])));
    const vmask valid = spu_andc(finite, spu_cmpgt(spux_vfloat(0), d[numbers - 1]));
    s->skipped_not_finite += spux_count_bits(spux_mask_bits(spu_andc(present, finite)));
    s->skipped_radius += spux_count_bits(spux_mask_bits(spu_andc(finite, valid)));
    return valid;
}

static void add_sphere_diameters(cgt_primitive_bounds *s, vfloat radius, vmask valid)
{
    _Alignas(CGT_VECTOR_BYTES) float r[CGT_LANES];
    spux_store(r, radius);
    for (unsigned remaining = spux_mask_bits(valid); remaining; remaining &= remaining - 1)
        add_diameter(s, 2.0 * r[__builtin_ctz(remaining)]);
}

static void add_spheres(bounds_pass *p, const cgt_primitive_array *a, uint32_t i, uint32_t count)
{
    vfloat d[4];
    lane_bounds b;
    load_spheres(a, i, count, d);
    b.valid = check_round(d, 4, spux_mask_first(count), p->bounds);
    for (int k = 0; k < 3; k++) {
        b.low[k] = spu_sub(d[k], d[3]);
        b.high[k] = spu_add(d[k], d[3]);
    }
    add_bounds(p, &b);
    if (p->request->diameters)
        add_sphere_diameters(p->bounds, d[3], b.valid);
    if (p->request->classes) {
        const vfloat size = spux_abs(d[3]); /* -0 is a radius too */
        size_gather_add(p->sizes, d, &size, 1, size, b.valid);
    }
}

/* ---- triangles ---- */

/* Which of the triangles certainly have an area. Differences, products, their difference and the sum of their sizes are
 * rounded four times each at most, within 2^-24, and underflow loses less than 2^-148: a component of the normal that
 * is more than 2^-20 of that sum and 2^-120 is not 0. Overflow gives infinity on both sides, or NaN, and the
 * comparison is false. */
CGT_SPU_INLINE vmask has_area(const vfloat v[3][3])
{
    vfloat e1[3], e2[3];
    vmask nonzero = spux_mask_none();
    for (int a = 0; a < 3; a++) {
        e1[a] = spu_sub(v[1][a], v[0][a]);
        e2[a] = spu_sub(v[2][a], v[0][a]);
    }
    for (int a = 0; a < 3 && !spux_all(nonzero); a++) { /* the first component mostly decides all */
        const vfloat p = spu_mul(e1[a], e2[(a + 1) % 3]), q = spu_mul(e1[(a + 1) % 3], e2[a]);
        const vfloat area_error =
            spu_madd(spu_add(spux_abs(p), spux_abs(q)), spux_vfloat(0x1p-20f), spux_vfloat(0x1p-120f));
        nonzero = spu_or(nonzero, spu_cmpgt(spux_abs(spu_sub(p, q)), area_error));
    }
    return nonzero;
}

/* The same, decided. */
static vmask decide_area(const cgt_primitive_array *a, vuint number, vmask undecided)
{
    unsigned nonzero = 0;
    for (unsigned remaining = spux_mask_bits(undecided); remaining; remaining &= remaining - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(remaining);
        const cgt_triangle q = cgt_array_triangle(a, number[k]);
        nonzero |= (unsigned)cgt_triangle_has_area(&q) << k;
    }
    return spux_mask_from_bits(nonzero);
}

CGT_SPU_INLINE vmask check_triangles(const cgt_primitive_array *a, vuint number, const vfloat v[3][3], vmask present,
                                     cgt_primitive_bounds *s)
{
    vfloat zero = spux_vfloat(0); /* finite times zero is zero; infinity and NaN give NaN, and NaN stays */
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 3; j++)
            zero = spu_madd(v[k][j], spux_vfloat(0), zero);
    const vmask finite = spu_and(present, spu_cmpeq(zero, spux_vfloat(0)));
    vmask valid = spu_and(finite, has_area(v));
    const vmask undecided = spu_andc(finite, valid);
    if (spux_any(undecided))
        valid = spu_or(valid, decide_area(a, number, undecided));
    s->skipped_not_finite += spux_count_bits(spux_mask_bits(spu_andc(present, finite)));
    s->skipped_degenerate += spux_count_bits(spux_mask_bits(spu_andc(finite, valid)));
    return valid;
}

/* A triangle's diameter is the mean edge of its bounds: it is flat, and touches fewer cells than they do. */
static void add_triangle_diameters(cgt_primitive_bounds *s, const lane_bounds *b)
{
    _Alignas(CGT_VECTOR_BYTES) float low[3][CGT_LANES], high[3][CGT_LANES];
    for (int a = 0; a < 3; a++) {
        spux_store(low[a], b->low[a]);
        spux_store(high[a], b->high[a]);
    }
    for (unsigned remaining = spux_mask_bits(b->valid); remaining; remaining &= remaining - 1) {
        const int k = __builtin_ctz(remaining);
        double extent = 0;
        for (int a = 0; a < 3; a++)
            extent += (double)high[a][k] - (double)low[a][k];
        add_diameter(s, extent / 3);
    }
}

CGT_SPU_INLINE void store_plane(float *to, vfloat v, uint32_t count)
{
    if (count == CGT_LANES)
        spux_store_unaligned(to, v);
    else
        spux_store_mask(to, v, spux_mask_first(count));
}

/* Middle and size of a vector of triangles or capsules, of which `number` is the first. */
CGT_SPU_INLINE void store_boxed(bounds_pass *p, const lane_bounds *b, uint32_t number, uint32_t count)
{
    const size_t plane = p->request->boxed;
    float *to = p->request->middle + number;
    vfloat middle[3], half[3], size = spux_vfloat(0);
    center_and_half(b->low, b->high, middle, half);
    for (int a = 0; a < 3; a++) {
        size = spux_max(size, half[a]);
        store_plane(to + (size_t)a * plane, middle[a], count);
    }
    store_plane(to + 3 * plane, spux_select(spux_vfloat(-1), size, b->valid), count);
    size_gather_add(p->sizes, middle, half, 3, size, b->valid);
}

/* Fetches vertices. Returns which lanes have an index out of range: then there are none. */
CGT_SPU_INLINE vmask gather_checked(const cgt_primitive_array *a, const vuint corner[3], vfloat v[3][3])
{
    if (!a->points)
        return spux_mask_all();
    const vuint largest = spux_max(corner[0], spux_max(corner[1], corner[2])), last = spux_vuint(a->points - 1);
    const bool before_last = spux_all(spu_cmpgt(last, largest)) && vertices_fit_offsets(a);
    if (!before_last) {
        const vmask out_of_range = spu_cmpgt(largest, last);
        if (spux_any(out_of_range))
            return out_of_range;
    }
    for (int k = 0; k < 3; k++)
        gather_vertices(a, corner[k], before_last, v[k]);
    return spux_mask_none();
}

CGT_SPU_INLINE void triangle_bounds(const vfloat v[3][3], lane_bounds *b)
{
    for (int k = 0; k < 3; k++) {
        b->low[k] = spux_min(v[0][k], spux_min(v[1][k], v[2][k]));
        b->high[k] = spux_max(v[0][k], spux_max(v[1][k], v[2][k]));
    }
}

/* Triangles one after the other. Returns false at an index out of range. */
static bool add_triangles(bounds_pass *p, const cgt_primitive_array *a, uint32_t i, uint32_t count)
{
    vuint corner[3];
    vfloat v[3][3];
    lane_bounds b;
    load_corners(a, i, count, corner);
    const vmask present = spux_mask_first(count), out_of_range = spu_and(gather_checked(a, corner, v), present);
    if (spux_any(out_of_range)) {
        p->bounds->bad_index = a->first + i + (uint32_t)__builtin_ctz(spux_mask_bits(out_of_range));
        return false;
    }
    b.valid = check_triangles(a, spu_add(spux_lane_index(), spux_vuint(i)), (const vfloat(*)[3])v, present, p->bounds);
    triangle_bounds((const vfloat(*)[3])v, &b);
    add_bounds(p, &b);
    if (p->request->diameters)
        add_triangle_diameters(p->bounds, &b);
    if (p->request->cluster)
        clusters_add(p->request->cluster, a->first + i, count, b.low, b.high, b.valid);
    else if (p->request->classes)
        store_boxed(p, &b, cgt_array_boxed_number(a, a->first + i), count);
    return true;
}

/* ---- capsules ---- */

/* The first capsule with an index out of range; CGT_INVALID_ID: none. */
static uint32_t first_bad_capsule(const cgt_primitive_array *a, uint32_t i, uint32_t count)
{
    for (uint32_t k = i; k < i + count; k++) {
        uint32_t end[2];
        cgt_array_ends(a, k, end);
        if (end[0] >= a->points || end[1] >= a->points)
            return a->first + k;
    }
    return CGT_INVALID_ID;
}

/* Capsules one after the other. Boxes are widened by more than their roundings: 2^-24 of each bound. Returns false at
 * an index out of range. */
static bool add_capsules(bounds_pass *p, const cgt_primitive_array *a, uint32_t i, uint32_t count)
{
    _Alignas(CGT_VECTOR_BYTES) float row[7][CGT_LANES] = {{0}};
    vfloat d[7];
    lane_bounds b;
    p->bounds->bad_index = first_bad_capsule(a, i, count);
    if (p->bounds->bad_index != CGT_INVALID_ID)
        return false;
    for (uint32_t k = 0; k < count; k++)
        capsule_to_lane(cgt_array_capsule(a, i + k), row, k);
    for (int k = 0; k < 7; k++)
        d[k] = spux_load(row[k]);
    b.valid = check_round(d, 7, spux_mask_first(count), p->bounds);
    for (int k = 0; k < 3; k++) {
        const vfloat low = spu_sub(spux_min(d[k], d[3 + k]), d[6]), high = spu_add(spux_max(d[k], d[3 + k]), d[6]);
        b.low[k] = spu_nmsub(spux_abs(low), spux_vfloat(0x1p-22f), low);
        b.high[k] = spu_madd(spux_abs(high), spux_vfloat(0x1p-22f), high);
    }
    add_bounds(p, &b);
    if (p->request->classes)
        store_boxed(p, &b, cgt_array_boxed_number(a, a->first + i), count);
    return true;
}

/* ---- clusters of triangles ---- */

/* The first of these triangles with an index out of range; there is one. */
static uint32_t first_bad_triangle(const cgt_primitive_array *a, uint32_t i)
{
    for (;; i++) {
        uint32_t corner[3];
        cgt_array_corners(a, i, corner);
        for (int k = 0; k < 3; k++)
            if (corner[k] >= a->points)
                return a->first + i;
    }
}

/* Bounds triangles from the first of a cluster on, a cluster in each lane, one triangle of each after the other, so
 * that lanes exchange nothing. Returns false at an index out of range. */
static bool add_clusters(bounds_pass *p, const cgt_primitive_array *a, uint32_t i, uint32_t count)
{
    const vuint first = spu_sl(spux_lane_index(), CGT_CLUSTER_SHIFT), last = spux_vuint(count - 1);
    const bool fit = clusters_fit_gather(a, i, count);
    cluster_gather g;
    cluster_gather_clear(&g);
    for (uint32_t k = 0; k < CGT_CLUSTER && k < count; k++) {
        const vuint triangle = spu_add(first, spux_vuint(k));
        const vuint number = spu_add(spux_min(triangle, last), spux_vuint(i));
        vuint corner[3];
        vfloat v[3][3];
        lane_bounds b;
        if (fit) {
            prefetch_cluster_corners(a, i + count + k * CGT_LANES);
            for (uint32_t c = 0; c < 3; c++)
                gather_cluster_corners(a, i + k, c, v[c]);
        } else {
            gather_corners(a, number, corner);
            if (spux_any(gather_checked(a, corner, v))) {
                p->bounds->bad_index = first_bad_triangle(a, i);
                return false;
            }
        }
        b.valid = check_triangles(a, number, (const vfloat(*)[3])v, spux_not(spu_cmpgt(triangle, last)), p->bounds);
        triangle_bounds((const vfloat(*)[3])v, &b);
        cluster_gather_add(&g, k, b.low, b.high, b.valid);
        p->bounds->valid += spux_count_bits(spux_mask_bits(b.valid));
    }
    for (int k = 0; k < 3; k++) {
        p->low[k] = spux_min(p->low[k], g.low[k]);
        p->high[k] = spux_max(p->high[k], g.high[k]);
    }
    cluster_gather_store(&g, p->request->cluster + (a->first + i) / CGT_CLUSTER, cgt_clusters(count));
    return true;
}

/* ---- the whole ---- */

void CGT_KERNEL(cgt_compute_array_bounds)(const cgt_primitive_array *array, uint32_t first, uint32_t end,
                                          const cgt_bounds_request *request, cgt_primitive_bounds *bounds)
{
    bounds_pass p;
    bounds_pass_init(&p, request, bounds);
    bool added = true;
    for (uint32_t prim = first; prim < end && added;) {
        /* an array's part of the cluster that it shares with the last one is visited alone */
        const uint32_t cluster_offset = request->cluster ? prim % CGT_CLUSTER : 0,
                       cluster_rest = CGT_CLUSTER - cluster_offset;
        const bool clusters_aligned = request->cluster && !cluster_offset;
        const uint32_t max_count = clusters_aligned                             ? CGT_LANES * CGT_CLUSTER
                                   : cluster_offset && cluster_rest < CGT_LANES ? cluster_rest
                                                                                : CGT_LANES;
        const uint32_t count = end - prim < max_count ? end - prim : max_count, i = prim - array->first;
        if (array->kind == CGT_KIND_SPHERES)
            add_spheres(&p, array, i, count);
        else if (array->kind == CGT_KIND_CAPSULES)
            added = add_capsules(&p, array, i, count);
        else if (clusters_aligned)
            added = add_clusters(&p, array, i, count);
        else
            added = add_triangles(&p, array, i, count);
        prim += count;
    }
    if (added)
        bounds_pass_store(&p, array->kind);
    if (p.sizes)
        cgt_scratch_return(request->scratch, p.sizes);
}

uint32_t CGT_KERNEL(cgt_compute_cluster_bounds)(cgt_cluster *cluster, uint32_t count, float max_half_area,
                                                cgt_size_classes *classes, cgt_scratch *scratch)
{
    size_gather *sizes = cgt_scratch_take(scratch, sizeof *sizes);
    size_gather_clear(sizes);
    const uint32_t large = clusters_compute_size(cluster, count, max_half_area, sizes);
    size_gather_store(sizes, 3, classes);
    cgt_scratch_return(scratch, sizes);
    return large;
}

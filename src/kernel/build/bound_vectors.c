/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The pass over all objects of a commit, a vector at a time: what is skipped, bounds, sizes. Every number is the one
 * that the objects one after another give, on any width: sums are taken in their order, in double; extremes have
 * none. */
#include "dispatch/kernel.h"

#include <math.h>

#include "kernel/build/cluster_bounds.h"
#include "kernel/primitive/gather_primitives.h"

/* What is known of a vector of objects. */
typedef struct object_bounds {
    vfloat low[3], high[3];
    vmask valid;
} object_bounds;

/* The pass so far. */
typedef struct object_pass {
    cgt_object_summary *summary;
    const cgt_summary_wishes *wishes;
    vfloat low[3], high[3];
    size_gather sizes;
} object_pass;

static void begin_pass(object_pass *p, const cgt_summary_wishes *wishes, cgt_object_summary *summary)
{
    p->summary = summary;
    p->wishes = wishes;
    for (int a = 0; a < 3; a++) {
        p->low[a] = spux_vfloat(INFINITY);
        p->high[a] = spux_vfloat(-INFINITY);
    }
    if (wishes->classes && !wishes->cluster)
        size_gather_clear(&p->sizes);
}

static void end_pass(const object_pass *p, cgt_kind kind)
{
    cgt_object_summary *s = p->summary;
    for (int a = 0; a < 3; a++) {
        const float low = spux_hmin(p->low[a]), high = spux_hmax(p->high[a]);
        s->min[a] = low < s->min[a] ? low : s->min[a];
        s->max[a] = high > s->max[a] ? high : s->max[a];
    }
    if (p->wishes->classes && !p->wishes->cluster)
        size_gather_end(&p->sizes, kind == CGT_KIND_SPHERES ? 1 : 3, p->wishes->classes);
}

CGT_SPU_INLINE void add_bounds(object_pass *p, const object_bounds *b)
{
    for (int a = 0; a < 3; a++) {
        p->low[a] = spux_select(p->low[a], spux_min(p->low[a], b->low[a]), b->valid);
        p->high[a] = spux_select(p->high[a], spux_max(p->high[a], b->high[a]), b->valid);
    }
    p->summary->valid += spux_count_bits(spux_mask_bits(b->valid));
}

CGT_SPU_INLINE void add_diameter(cgt_object_summary *s, double d)
{
    s->diameter[1] += d;
    s->diameter[2] += d * d;
    s->diameter[3] += d * d * d;
}

/* ---- spheres ---- */

/* Which of the spheres take part. */
CGT_SPU_INLINE vmask check_spheres(const vfloat d[4], vmask there, cgt_object_summary *s)
{
    const vfloat infinity = spux_vfloat(INFINITY);
    vmask finite = there;
    for (int k = 0; k < 4; k++)
        finite = spu_and(finite, spu_cmpgt(infinity, spux_abs(d[k])));
    const vmask valid = spu_andc(finite, spu_cmpgt(spux_vfloat(0), d[3]));
    s->skipped_not_finite += spux_count_bits(spux_mask_bits(spu_andc(there, finite)));
    s->skipped_radius += spux_count_bits(spux_mask_bits(spu_andc(finite, valid)));
    return valid;
}

static void add_sphere_diameters(cgt_object_summary *s, vfloat radius, vmask valid)
{
    _Alignas(CGT_VECTOR_BYTES) float r[CGT_LANES];
    spux_store(r, radius);
    for (unsigned left = spux_mask_bits(valid); left; left &= left - 1)
        add_diameter(s, 2.0 * r[__builtin_ctz(left)]);
}

static void add_spheres(object_pass *p, const cgt_object_array *a, uint32_t i, uint32_t count)
{
    vfloat d[4];
    object_bounds b;
    fetch_spheres(a, i, count, d);
    b.valid = check_spheres(d, spux_mask_first(count), p->summary);
    for (int k = 0; k < 3; k++) {
        b.low[k] = spu_sub(d[k], d[3]);
        b.high[k] = spu_add(d[k], d[3]);
    }
    add_bounds(p, &b);
    if (p->wishes->diameters)
        add_sphere_diameters(p->summary, d[3], b.valid);
    if (p->wishes->classes) {
        const vfloat size = spux_abs(d[3]); /* -0 is a radius too */
        size_gather_add(&p->sizes, d, &size, 1, size, b.valid);
    }
}

/* ---- triangles ---- */

/* Which of the triangles certainly have an area. Differences, products, their difference and the sum of their sizes are
 * rounded four times each at most, within 2^-24, and underflow loses less than 2^-148: a component of the normal that
 * is more than 2^-20 of that sum and 2^-120 is not 0. What overflows is infinite on both sides, or not a number, and
 * the comparison is false. */
CGT_SPU_INLINE vmask has_area(const vfloat v[3][3])
{
    vfloat e1[3], e2[3];
    vmask some = spux_mask_none();
    for (int a = 0; a < 3; a++) {
        e1[a] = spu_sub(v[1][a], v[0][a]);
        e2[a] = spu_sub(v[2][a], v[0][a]);
    }
    for (int a = 0; a < 3 && !spux_all(some); a++) { /* mostly the first component tells of all */
        const vfloat p = spu_mul(e1[a], e2[(a + 1) % 3]), q = spu_mul(e1[(a + 1) % 3], e2[a]);
        const vfloat least = spu_madd(spu_add(spux_abs(p), spux_abs(q)), spux_vfloat(0x1p-20f), spux_vfloat(0x1p-120f));
        some = spu_or(some, spu_cmpgt(spux_abs(spu_sub(p, q)), least));
    }
    return some;
}

/* The same, decided. */
static vmask decide_area(const cgt_object_array *a, vuint number, vmask open)
{
    unsigned some = 0;
    for (unsigned left = spux_mask_bits(open); left; left &= left - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(left);
        const cgt_triangle q = cgt_array_triangle(a, number[k]);
        some |= (unsigned)cgt_triangle_has_area(&q) << k;
    }
    return spux_mask_from_bits(some);
}

CGT_SPU_INLINE vmask check_triangles(const cgt_object_array *a, vuint number, const vfloat v[3][3], vmask there,
                                     cgt_object_summary *s)
{
    vfloat zero = spux_vfloat(0); /* finite times zero is zero; infinity and NaN give NaN, and NaN stays */
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 3; j++)
            zero = spu_madd(v[k][j], spux_vfloat(0), zero);
    const vmask finite = spu_and(there, spu_cmpeq(zero, spux_vfloat(0)));
    vmask valid = spu_and(finite, has_area(v));
    const vmask open = spu_andc(finite, valid);
    if (spux_any(open))
        valid = spu_or(valid, decide_area(a, number, open));
    s->skipped_not_finite += spux_count_bits(spux_mask_bits(spu_andc(there, finite)));
    s->skipped_degenerate += spux_count_bits(spux_mask_bits(spu_andc(finite, valid)));
    return valid;
}

/* A triangle's diameter is the mean edge of its bounds: it is flat, and touches fewer cells than they do. */
static void add_triangle_diameters(cgt_object_summary *s, const object_bounds *b)
{
    _Alignas(CGT_VECTOR_BYTES) float low[3][CGT_LANES], high[3][CGT_LANES];
    for (int a = 0; a < 3; a++) {
        spux_store(low[a], b->low[a]);
        spux_store(high[a], b->high[a]);
    }
    for (unsigned left = spux_mask_bits(b->valid); left; left &= left - 1) {
        const int k = __builtin_ctz(left);
        double extent = 0;
        for (int a = 0; a < 3; a++)
            extent += (double)high[a][k] - (double)low[a][k];
        add_diameter(s, extent / 3);
    }
}

CGT_SPU_INLINE void keep_plane(float *to, vfloat v, uint32_t count)
{
    if (count == CGT_LANES)
        spux_store_unaligned(to, v);
    else
        spux_store_mask(to, v, spux_mask_first(count));
}

/* Middle and size of a vector of triangles, of which `number` is the first. */
CGT_SPU_INLINE void keep_triangles(object_pass *p, const object_bounds *b, uint32_t number, uint32_t count)
{
    const size_t plane = p->wishes->triangles;
    float *to = p->wishes->middle + number;
    vfloat middle[3], half[3], size = spux_vfloat(0);
    box_of_bounds(b->low, b->high, middle, half);
    for (int a = 0; a < 3; a++) {
        size = spux_max(size, half[a]);
        keep_plane(to + (size_t)a * plane, middle[a], count);
    }
    keep_plane(to + 3 * plane, spux_select(spux_vfloat(-1), size, b->valid), count);
    size_gather_add(&p->sizes, middle, half, 3, size, b->valid);
}

/* Fetches vertices. Returns which lanes have an index out of range: then there are none. */
CGT_SPU_INLINE vmask fetch_triangles(const cgt_object_array *a, const vuint corner[3], vfloat v[3][3])
{
    if (!a->points)
        return spux_mask_all();
    const vuint largest = spux_max(corner[0], spux_max(corner[1], corner[2])), last = spux_vuint(a->points - 1);
    const bool before_last = spux_all(spu_cmpgt(last, largest)) && fetch_vertices_fit(a);
    if (!before_last) {
        const vmask bad = spu_cmpgt(largest, last);
        if (spux_any(bad))
            return bad;
    }
    for (int k = 0; k < 3; k++)
        fetch_vertices(a, corner[k], before_last, v[k]);
    return spux_mask_none();
}

CGT_SPU_INLINE void triangle_bounds(const vfloat v[3][3], object_bounds *b)
{
    for (int k = 0; k < 3; k++) {
        b->low[k] = spux_min(v[0][k], spux_min(v[1][k], v[2][k]));
        b->high[k] = spux_max(v[0][k], spux_max(v[1][k], v[2][k]));
    }
}

/* Triangles one after the other. Returns false at an index out of range. */
static bool add_triangles(object_pass *p, const cgt_object_array *a, uint32_t i, uint32_t count)
{
    vuint corner[3];
    vfloat v[3][3];
    object_bounds b;
    fetch_corners(a, i, count, corner);
    const vmask there = spux_mask_first(count), bad = spu_and(fetch_triangles(a, corner, v), there);
    if (spux_any(bad)) {
        p->summary->bad_index = a->first + i + (uint32_t)__builtin_ctz(spux_mask_bits(bad));
        return false;
    }
    b.valid = check_triangles(a, spu_add(spux_lane_index(), spux_vuint(i)), (const vfloat(*)[3])v, there, p->summary);
    triangle_bounds((const vfloat(*)[3])v, &b);
    add_bounds(p, &b);
    if (p->wishes->diameters)
        add_triangle_diameters(p->summary, &b);
    if (p->wishes->cluster)
        clusters_add(p->wishes->cluster, a->first + i, count, b.low, b.high, b.valid);
    else if (p->wishes->classes)
        keep_triangles(p, &b, cgt_array_triangle_number(a, a->first + i), count);
    return true;
}

/* ---- clusters of triangles ---- */

/* The first of these triangles with an index out of range; there is one. */
static uint32_t first_bad_triangle(const cgt_object_array *a, uint32_t i)
{
    for (;; i++) {
        uint32_t corner[3];
        cgt_array_corners(a, i, corner);
        for (int k = 0; k < 3; k++)
            if (corner[k] >= a->points)
                return a->first + i;
    }
}

/* Triangles from the first of a cluster on, a cluster in each lane: its triangles come one after the other, so that
 * nothing goes from lane to lane. Returns false at an index out of range. */
static bool add_clusters(object_pass *p, const cgt_object_array *a, uint32_t i, uint32_t count)
{
    const vuint first = spu_sl(spux_lane_index(), CGT_CLUSTER_SHIFT), last = spux_vuint(count - 1);
    const bool fit = clusters_fetch_fit(a, i, count);
    cluster_gather g;
    cluster_gather_clear(&g);
    for (uint32_t k = 0; k < CGT_CLUSTER && k < count; k++) {
        const vuint at = spu_add(first, spux_vuint(k));
        const vuint number = spu_add(spux_min(at, last), spux_vuint(i));
        vuint corner[3];
        vfloat v[3][3];
        object_bounds b;
        if (fit) {
            ask_cluster_corners(a, i + count + k * CGT_LANES);
            for (uint32_t c = 0; c < 3; c++)
                fetch_cluster_corners(a, i + k, c, v[c]);
        } else {
            fetch_corners_at(a, number, corner);
            if (spux_any(fetch_triangles(a, corner, v))) {
                p->summary->bad_index = first_bad_triangle(a, i);
                return false;
            }
        }
        b.valid = check_triangles(a, number, (const vfloat(*)[3])v, spux_not(spu_cmpgt(at, last)), p->summary);
        triangle_bounds((const vfloat(*)[3])v, &b);
        cluster_gather_add(&g, k, b.low, b.high, b.valid);
        p->summary->valid += spux_count_bits(spux_mask_bits(b.valid));
    }
    for (int k = 0; k < 3; k++) {
        p->low[k] = spux_min(p->low[k], g.low[k]);
        p->high[k] = spux_max(p->high[k], g.high[k]);
    }
    cluster_gather_store(&g, p->wishes->cluster + (a->first + i) / CGT_CLUSTER, cgt_clusters(count));
    return true;
}

/* ---- the whole ---- */

void CGT_KERNEL(cgt_summarise_array)(const cgt_object_array *array, uint32_t first, uint32_t end,
                                     const cgt_summary_wishes *wishes, cgt_object_summary *summary)
{
    object_pass p;
    begin_pass(&p, wishes, summary);
    for (uint32_t object = first; object < end;) {
        /* what an array has of the last one's cluster comes alone */
        const uint32_t begun = wishes->cluster ? object % CGT_CLUSTER : 0, rest = CGT_CLUSTER - begun;
        const bool whole = wishes->cluster && !begun;
        const uint32_t most = whole ? CGT_LANES * CGT_CLUSTER : begun && rest < CGT_LANES ? rest : CGT_LANES;
        const uint32_t count = end - object < most ? end - object : most, i = object - array->first;
        bool added = true;
        if (array->kind == CGT_KIND_SPHERES)
            add_spheres(&p, array, i, count);
        else if (whole)
            added = add_clusters(&p, array, i, count);
        else
            added = add_triangles(&p, array, i, count);
        if (!added)
            return;
        object += count;
    }
    end_pass(&p, array->kind);
}

void CGT_KERNEL(cgt_summarise_clusters)(cgt_cluster *cluster, uint32_t count, cgt_size_classes *classes)
{
    size_gather sizes;
    size_gather_clear(&sizes);
    clusters_finish(cluster, count, &sizes);
    size_gather_end(&sizes, 3, classes);
}

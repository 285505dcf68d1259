/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decides the entries of a tile's queue about spheres of one array, seen from one eye, a vector at a time, by the short
 * formula of sphere_double.h. Its t is the canonical one, so two t that decide.c can tell apart in double are told
 * apart here. A line misses if the discriminant is below 0 by more than its error, 18 e (c.c + r^2) d.d, for which
 * 2^-48 is taken. The rest, a few silhouettes and hits as near as another, is left to decide.c. */
#include "kernel/primitive/gather_primitives.h"
#include "kernel/resolve/resolve_spheres.h"
#include "kernel/tile_draw/tile_queue.h"

/* The decisions about a vector of entries. */
typedef struct tile_decisions {
    _Alignas(CGT_VECTOR_BYTES) uint32_t closest[CGT_LANES]; /* the pixel's closest primitive when this was decided */
    double t[CGT_LANES];                                    /* of the primitive, where it is accepted */
    unsigned accepted, rejected;                            /* lanes as bits */
} tile_decisions;

/* The short formula for a vector of lines and spheres. */
typedef struct tile_near_hits {
    vdouble t[2];
    vfloat rounded;
    vmask known, missed; /* t is the canonical one, and not before the range; certain misses */
} tile_near_hits;

CGT_SPU_INLINE tile_near_hits tile_intersect_spheres(const tile *t, const cgt_primitive_array *array, vuint number,
                                                     const vfloat dir[3])
{
    const float *eye = t->rays->eye;
    const vfloat org[3] = {spux_vfloat(eye[0]), spux_vfloat(eye[1]), spux_vfloat(eye[2])};
    tile_near_hits n;
    resolve_half h[2];
    vfloat sphere[4];
    vdouble product[2], limit[2], disc[2];
    gather_spheres(array, number, sphere);
    resolve_directions(dir, h);
    const vmask outside = resolve_terms(org, sphere, h, product);
    n.known = resolve_near_roots(product, outside, spux_vfloat(t->rays->t_min), h, &n.rounded);
    for (int i = 0; i < 2; i++) {
        const vdouble r = i ? spux_double_high(sphere[3]) : spux_double_low(sphere[3]);
        limit[i] = (product[i] + r * r * 2) * h[i].square * -0x1p-48;
        disc[i] = h[i].disc;
        n.t[i] = h[i].t;
    }
    n.missed = spux_double_cmpgt(limit, disc);
    return n;
}

/* Entries `first` and on, at most a vector. */
CGT_SPU_INLINE void tile_decide_spheres(const cgt_primitive_array *array, const tile *t, const tile_queue *q,
                                        uint32_t first, tile_decisions *v)
{
    _Alignas(CGT_VECTOR_BYTES) uint32_t number[CGT_LANES];
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        const uint32_t entry = first + k < q->entries ? first + k : first;
        number[k] = q->prim[entry];
        v->closest[k] = t->prim[q->pixel[entry]];
    }
    const vuint prim = spux_load_uint(number), closest = spux_load_uint(v->closest);
    const vmask no_closest = spu_cmpeq(closest, spux_vuint(CGT_INVALID_ID));
    const vfloat t_max = spux_vfloat(t->rays->t_max), infinity = spux_vfloat(INFINITY);
    vdouble behind[2], ahead[2], margin[2];
    vfloat dir[3];
    /* both spheres of each entry */
    tile_gather_directions(t, q->pixel + first, q->entries - first, dir);
    const tile_near_hits a = tile_intersect_spheres(t, array, prim, dir);
    const tile_near_hits b = tile_intersect_spheres(t, array, spux_select(closest, prim, no_closest), dir);
    for (int i = 0; i < 2; i++) {
        behind[i] = a.t[i] - b.t[i];
        ahead[i] = b.t[i] - a.t[i];
        margin[i] = (a.t[i] + b.t[i]) * CGT_ORDER_ERROR;
        memcpy(v->t + (size_t)i * CGT_DOUBLES, &a.t[i], sizeof a.t[i]);
    }
    /* accept what is certainly nearer, reject what is certainly farther or misses */
    const vmask within = spu_and(spux_cmpge(t_max, a.rounded), spu_cmpgt(infinity, a.rounded));
    const vmask both = spu_andc(spu_and(a.known, b.known), no_closest);
    const vmask nearer = spu_or(spu_and(a.known, no_closest), spu_and(both, spux_double_cmpgt(ahead, margin)));
    const vmask accepted = spu_and(nearer, within);
    const vmask beyond = spu_or(spu_andc(a.known, within), spu_and(both, spux_double_cmpgt(behind, margin)));
    v->accepted = spux_mask_bits(accepted);
    v->rejected = spux_mask_bits(spu_or(a.missed, beyond));
}

void CGT_KERNEL(cgt_tile_flush_spheres)(const cgt_primitives *prims, tile *t, const tile_queue *q, cgt_counts *counts)
{
    tile_decisions v;
    for (uint32_t first = 0; first < q->entries; first += CGT_LANES) {
        tile_decide_spheres(prims->array, t, q, first, &v);
        for (uint32_t k = 0; k < CGT_LANES && first + k < q->entries; k++) {
            const uint32_t i = q->pixel[first + k], prim = q->prim[first + k];
            if (!((v.accepted | v.rejected) >> k & 1) || t->prim[i] != v.closest[k] || t->z[i] == -INFINITY) {
                CGT_KERNEL(cgt_tile_decide)
                (prims, t, i, prim, counts); /* another entry of the vector may have won the pixel */
                continue;
            }
            counts->double_tests++;
            if (v.accepted >> k & 1) {
                tile_set_closest(t, i, prim);
                t->z[i] = tile_compute_depth(t, i, v.t[k]);
            }
        }
    }
}

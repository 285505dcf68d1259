/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The fields of a vector of a tile's hits, where all primitives are of one array. Apart from tile_resolve.c, whose
 * loops inline it, for its length. */
#ifndef CGT_TILE_RESOLVE_VECTOR_H
#define CGT_TILE_RESOLVE_VECTOR_H

#include "kernel/primitive/gather_primitives.h"
#include "kernel/resolve/fast_spheres.h"
#include "kernel/resolve/fast_triangles.h"
#include "kernel/resolve/resolve_spheres.h"
#include "kernel/tile_frame/tile_planes.h"

/* The two terms whose sum is a pixel's canonical direction, or a parallel ray's origin: one of the column (the forward
 * axis plus px right) and one of the row (py up), in the order of tile_compute_directions. */
typedef struct tile_ray_table {
    _Alignas(CGT_VECTOR_BYTES) float column_sum[3][TILE_EDGE];
    float up[TILE_EDGE][4];
} tile_ray_table;

CGT_SPU_INLINE void tile_init_ray_table(const tile *t, tile_ray_table *s)
{
    const cgt_camera_rays *c = t->rays;
    const float *from = t->parallel ? c->eye : c->fwd;
    for (int a = 0; a < 3; a++)
        for (uint32_t x = 0; x < TILE_EDGE; x += CGT_LANES)
            spux_store(s->column_sum[a] + x, spu_add(spux_vfloat(from[a]), spu_mul(spux_load_unaligned(t->column + x),
                                                                                   spux_vfloat(c->right[a]))));
    for (uint32_t y = 0; y < TILE_EDGE; y++)
        for (int a = 0; a < 3; a++)
            s->up[y][a] = t->row[y] * c->up[a];
}

/* The directions (or origins) of columns x and on of a row. */
CGT_SPU_INLINE void tile_load_directions(const tile_ray_table *s, uint32_t x, uint32_t row, vfloat dir[3])
{
    for (int a = 0; a < 3; a++)
        dir[a] = spu_add(spux_load(s->column_sum[a] + x), spux_vfloat(s->up[row][a]));
}
CGT_SPU_INLINE void tile_load_double_directions(const tile_ray_table *s, uint32_t x, uint32_t row, resolve_half h[2])
{
    for (int a = 0; a < 3; a++)
        for (uint32_t i = 0; i < 2; i++)
            h[i].d[a] = spux_double_sum(s->column_sum[a] + x + i * CGT_DOUBLES, s->up[row][a]);
}

/* ---- pixels ---- */

/* Which primitive each vector of pixels has hit, precomputed for the whole tile: the branches of the resolve loop then
 * depend on loads only, and mispredictions are found early. */
typedef struct tile_pixel_runs {
    uint32_t first_prim[TILE_PIXELS / CGT_LANES]; /* a primitive that one of the pixels has hit, or CGT_INVALID_ID */
    bool uniform[TILE_PIXELS / CGT_LANES];        /* none of them has hit another one */
} tile_pixel_runs;

/* Loads columns x and on of rows y and y + 1 of one of the tile's arrays. */
CGT_SPU_INLINE void tile_load_rows(const uint32_t *of, uint32_t x, uint32_t y, vuint row[2])
{
    row[0] = spux_load_uint(of + tile_index(x, y));
    row[1] = spux_load_uint(of + tile_index(x, y) + CGT_LANES);
    spux_unzip(row);
}

/* The index of columns x and on of a row in tile_pixel_runs. */
CGT_SPU_INLINE uint32_t tile_pixel_run_index(uint32_t x, uint32_t row) { return (row * TILE_EDGE + x) / CGT_LANES; }

/* Fills in the runs of a region and counts its hits. Returns whether there is any hit. */
CGT_SPU_INLINE bool tile_compute_pixel_runs(const tile *t, const cgt_region *r, tile_pixel_runs *m, cgt_counts *counts)
{
    uint64_t hits = 0;
    for (uint32_t y = 0; y < r->height; y += 2)
        for (uint32_t x = 0; x < r->width; x += CGT_LANES) {
            vuint prim[2];
            tile_load_rows(t->prim, x, y, prim);
            for (uint32_t k = 0; k < 2; k++) {
                const unsigned missed = spux_mask_bits(spu_cmpeq(prim[k], spux_vuint(CGT_INVALID_ID)));
                const unsigned hit = ~missed & CGT_ALL_LANES;
                const uint32_t lane = (uint32_t)__builtin_ctz(hit | 1u << (CGT_LANES - 1));
                const uint32_t first_prim = t->prim[tile_index(x, y) + 2 * lane + k];
                const unsigned same = spux_mask_bits(spu_cmpeq(prim[k], spux_vuint(first_prim)));
                const uint32_t i = tile_pixel_run_index(x, y + k);
                m->first_prim[i] = first_prim;
                m->uniform[i] = (same | missed) == CGT_ALL_LANES;
                hits += spux_count_bits(hit);
            }
        }
    counts->hits += hits;
    return hits != 0;
}

/* ---- prepared triangles ---- */

/* The triangles that a tile has listed (tile.h), each gathered and prepared once (resolve_triangles.h), a vector of
 * them at a time. This pays as soon as a triangle has a few pixels: gathering nine numbers for each lane of a vector of
 * pixels takes longer than all that is computed from them. Pixels know their triangle's slot since it became their
 * closest one; looking it up by the triangle's number took as long as the rest. Some listed triangles have lost all
 * their pixels since, a twelfth of them in ordinary scenes. */
_Static_assert(2 * PREPARED_RECORD == 1 << 4, "offsets into records are shifted");
_Static_assert(FAST_RECORD == PREPARED_RECORD, "the same offsets for both");

typedef union tile_prepared_triangles {
    _Alignas(64) double record[TILE_MAX_TRIANGLES + CGT_LANES][2 * PREPARED_RECORD]; /* by slot */
    _Alignas(64) float fast[TILE_MAX_TRIANGLES + CGT_LANES][2 * FAST_RECORD];        /* in precision FAST */
} tile_prepared_triangles;

/* Prepares the tile's triangles. */
CGT_SPU_INLINE void tile_prepare_triangles(const cgt_committed_scene *committed_scene, const tile *t, uint32_t fields,
                                           bool fast, tile_prepared_triangles *m)
{
    const float *eye = t->rays->eye;
    for (uint32_t i = 0; i < t->triangle_count; i += CGT_LANES) {
        const vmask valid = spux_mask_first(t->triangle_count - i < CGT_LANES ? t->triangle_count - i : CGT_LANES);
        const vuint number = spux_select(spux_vuint(t->triangles[i]), spux_load_uint(t->triangles + i), valid);
        vfloat vertex[3][3];
        gather_triangles(committed_scene->prims.array, number, vertex);
        if (fast) {
            const vfloat org[3] = {spux_vfloat(eye[0]), spux_vfloat(eye[1]), spux_vfloat(eye[2])};
            const fast_triangle q = fast_triangle_prepare(org, vertex);
            fast_triangle_store(&q, fields, m->fast[i], 2 * FAST_RECORD);
        } else
            prepare_triangles(eye, vertex, fields, m->record[i], 2 * PREPARED_RECORD);
    }
}

/* Resolves a vector of pixels by their slots. first_slot: that of one pixel with a hit, and of all of them if
 * `uniform`. Returns the lanes whose result is right. */
CGT_SPU_INLINE vmask tile_resolve_prepared(const tile_prepared_triangles *m, vuint slot, uint32_t first_slot,
                                           bool uniform, vmask missed, const vfloat dir[3], uint32_t fields,
                                           resolved_triangles *to)
{
    if (uniform)
        return resolve_prepared(m->record[first_slot], NULL, dir, fields, to);
    _Alignas(CGT_VECTOR_BYTES) uint32_t from[CGT_LANES];
    spux_store_uint(from, spu_sl(spux_select(slot, spux_vuint(first_slot), missed), 4)); /* the record */
    return resolve_prepared(m->record[0], from, dir, fields, to);
}

CGT_SPU_INLINE fast_triangle tile_load_fast(const tile_prepared_triangles *m, vuint slot, uint32_t first_slot,
                                            bool uniform, vmask missed, uint32_t fields)
{
    if (uniform)
        return fast_triangle_load(m->fast[first_slot], NULL, fields);
    _Alignas(CGT_VECTOR_BYTES) uint32_t from[CGT_LANES];
    spux_store_uint(from, spu_sl(spux_select(slot, spux_vuint(first_slot), missed), 4)); /* the record */
    return fast_triangle_load(m->fast[0], from, fields);
}

/* ---- a vector of pixels ---- */

/* A vector of pixels side by side in a row of a tile. */
typedef struct tile_pixel_vector {
    uint32_t x, row; /* of the first one */
    vuint prim;
    vmask missed;
    uint32_t first_prim; /* a primitive that one of them has hit, or CGT_INVALID_ID */
    bool uniform;        /* none of them has hit another one */
} tile_pixel_vector;

/* The sphere of the last vector of pixels: the next one has mostly hit the same. */
typedef struct tile_prepared_sphere {
    uint32_t number;
    prepared_sphere sphere;
    fast_same_sphere fast; /* in its place in precision FAST */
} tile_prepared_sphere;

/* Constant over a frame. Some members are compile-time constants where loops are instantiated (tile_resolve.c). */
typedef struct tile_resolve_mode {
    bool triangles, nontemporal, fast;
    bool prepared;   /* triangles are prepared */
    bool parallel;   /* rays are parallel: tile_load_directions loads their origins */
    uint32_t fields; /* of t, normals, u and v */
} tile_resolve_mode;

/* Shared by the vectors of a tile. */
typedef struct tile_resolve_cache {
    const tile_pixel_runs *pixel_runs;
    const tile_ray_table *ray_table;
    tile_seam *seam; /* NULL: none */
    tile_prepared_sphere *sphere;
    float *inverse; /* of fast_inverse_square, of two rows; NULL: not needed */
    const tile_prepared_triangles *prepared;
} tile_resolve_cache;

/* The lanes' primitives; lanes without a hit get that of another lane. */
CGT_SPU_INLINE vuint tile_pixel_prims(const tile_pixel_vector *p)
{
    return spux_select(p->prim, spux_vuint(p->first_prim), p->missed);
}

CGT_SPU_INLINE void tile_store_normals(const vfloat normal[3], vmask missed, tile_hits *h)
{
    for (int a = 0; a < 3; a++)
        h->normal[a] = spux_select(normal[a], spux_vfloat(0), missed);
}

/* The spheres of a vector of pixels. */
CGT_SPU_INLINE fast_sphere tile_fast_spheres(const cgt_primitive_array *array, const vfloat org[3],
                                             const tile_pixel_vector *p, tile_resolve_cache cache)
{
    tile_prepared_sphere *last = cache.sphere;
    vfloat sphere[4];
    if (!p->uniform) {
        gather_spheres(array, tile_pixel_prims(p), sphere);
        return fast_sphere_prepare(org, sphere);
    }
    if (last->number != p->first_prim) {
        const cgt_sphere q = cgt_array_sphere(array, p->first_prim);
        const float part[4] = {q.x, q.y, q.z, q.r};
        for (int a = 0; a < 4; a++)
            sphere[a] = spux_vfloat(part[a]);
        const fast_sphere s = fast_sphere_prepare(org, sphere);
        last->number = p->first_prim;
        last->fast = fast_sphere_first(&s);
    }
    return fast_sphere_of_same(&last->fast);
}

/* The next functions return the lanes whose result is right. */
CGT_SPU_INLINE vmask tile_resolve_fast_spheres(const cgt_committed_scene *committed_scene, const tile *t, bool normals,
                                               const tile_pixel_vector *p, const vfloat dir[3],
                                               tile_resolve_cache cache, vfloat *found, tile_hits *h)
{
    const cgt_primitive_array *array = committed_scene->prims.array;
    const float *eye = t->rays->eye;
    const vfloat org[3] = {spux_vfloat(eye[0]), spux_vfloat(eye[1]), spux_vfloat(eye[2])};
    const vfloat t_min = spux_vfloat(t->rays->t_min), t_max = spux_vfloat(t->rays->t_max);
    const fast_sphere s = tile_fast_spheres(array, org, p, cache);
    vfloat n[3];
    const vfloat inverse = spux_load(cache.inverse + (p->row & 1) * TILE_EDGE + p->x);
    const vmask covered = fast_sphere_resolve(&s, dir, inverse, t_min, t_max, normals, found, n);
    if (normals)
        tile_store_normals(n, p->missed, h);
    return covered;
}

CGT_SPU_INLINE vmask tile_resolve_spheres(const cgt_committed_scene *committed_scene, const tile *t,
                                          tile_resolve_mode mode, const tile_pixel_vector *p, const vfloat dir[3],
                                          tile_resolve_cache cache, tile_hits *h)
{
    const cgt_primitive_array *array = committed_scene->prims.array;
    const float *eye = t->rays->eye;
    const vfloat org[3] = {spux_vfloat(eye[0]), spux_vfloat(eye[1]), spux_vfloat(eye[2])};
    const vfloat t_min = spux_vfloat(t->rays->t_min);
    const vmask hit = spux_not(p->missed);
    const bool normals = mode.fields & CGT_FIELD_NORMAL;
    vfloat sphere[4], found;
    vmask resolved;
    if (mode.fast) {
        resolved = tile_resolve_fast_spheres(committed_scene, t, normals, p, dir, cache, &found, h);
    } else {
        resolve_half half[2];
        tile_load_double_directions(cache.ray_table, p->x, p->row, half);
        if (p->uniform) {
            if (p->first_prim != cache.sphere->number) {
                cache.sphere->number = p->first_prim;
                cache.sphere->sphere = prepare_sphere(eye, cgt_array_sphere(array, p->first_prim));
            }
            resolved = resolve_prepared_sphere(&cache.sphere->sphere, t_min, normals, hit, half, &found, h->normal);
        } else {
            gather_spheres(array, tile_pixel_prims(p), sphere);
            resolved = resolve_spheres_vector(org, sphere, t_min, normals, hit, half, &found, h->normal);
        }
    }
    h->t = spux_select(found, h->t, p->missed);
    return resolved;
}

CGT_SPU_INLINE vmask tile_resolve_triangles(const cgt_committed_scene *committed_scene, const tile *t,
                                            tile_resolve_mode mode, const tile_pixel_vector *p, const vfloat dir[3],
                                            tile_resolve_cache cache, tile_hits *h)
{
    const float *eye = t->rays->eye;
    const vfloat zero = spux_vfloat(0);
    const vfloat t_min = spux_vfloat(t->rays->t_min), t_max = spux_vfloat(t->rays->t_max);
    const uint32_t fields = mode.fields;
    resolved_triangles found = {zero, zero, zero, {zero, zero, zero}};
    vmask resolved;
    if (mode.prepared) {
        const unsigned hit = ~spux_mask_bits(p->missed) & CGT_ALL_LANES;
        const uint32_t first_slot = t->slot[tile_index(p->x + (uint32_t)__builtin_ctz(hit), p->row)];
        vuint slot[2] = {spux_vuint(first_slot), spux_vuint(first_slot)};
        if (!p->uniform)
            tile_load_rows(t->slot, p->x, p->row & ~1u, slot);
        if (mode.fast) {
            const fast_triangle q =
                tile_load_fast(cache.prepared, slot[p->row & 1], first_slot, p->uniform, p->missed, fields);
            resolved = fast_triangle_resolve(&q, dir, t_min, t_max, fields, &found);
        } else
            resolved = tile_resolve_prepared(cache.prepared, slot[p->row & 1], first_slot, p->uniform, p->missed, dir,
                                             fields, &found);
    } else {
        const vfloat org[3] = {spux_vfloat(eye[0]), spux_vfloat(eye[1]), spux_vfloat(eye[2])};
        vfloat vertex[3][3];
        gather_triangles(committed_scene->prims.array, tile_pixel_prims(p), vertex);
        if (mode.fast) {
            const fast_triangle q = fast_triangle_prepare(org, vertex);
            resolved = fast_triangle_resolve(&q, dir, t_min, t_max, fields, &found);
        } else
            resolved = resolve_triangles_vector(org, dir, vertex, fields, &found);
    }
    h->t = spux_select(found.t, h->t, p->missed);
    h->u = spux_select(found.u, zero, p->missed);
    h->v = spux_select(found.v, zero, p->missed);
    tile_store_normals(found.normal, p->missed, h);
    return resolved;
}

/* Parallel rays from these origins. */
CGT_SPU_INLINE vmask tile_resolve_parallel(const cgt_committed_scene *committed_scene, const tile *t,
                                           tile_resolve_mode mode, const tile_pixel_vector *p, const vfloat org[3],
                                           tile_hits *h)
{
    const cgt_primitive_array *array = committed_scene->prims.array;
    const float *fwd = t->rays->fwd;
    const vfloat zero = spux_vfloat(0), dir[3] = {spux_vfloat(fwd[0]), spux_vfloat(fwd[1]), spux_vfloat(fwd[2])};
    const vfloat t_min = spux_vfloat(t->rays->t_min), t_max = spux_vfloat(t->rays->t_max);
    resolved_triangles found = {zero, zero, zero, {zero, zero, zero}};
    resolve_half half[2];
    vmask resolved;
    if (mode.triangles) {
        vfloat vertex[3][3];
        gather_triangles(array, tile_pixel_prims(p), vertex);
        if (mode.fast) {
            const fast_triangle q = fast_triangle_prepare(org, vertex);
            resolved = fast_triangle_resolve(&q, dir, t_min, t_max, mode.fields, &found);
        } else
            resolved = resolve_triangles_vector(org, dir, vertex, mode.fields, &found);
    } else {
        const cgt_sphere q = cgt_array_sphere(array, p->first_prim);
        vfloat sphere[4] = {spux_vfloat(q.x), spux_vfloat(q.y), spux_vfloat(q.z), spux_vfloat(q.r)};
        if (!p->uniform)
            gather_spheres(array, tile_pixel_prims(p), sphere);
        if (mode.fast) {
            const fast_sphere s = fast_sphere_prepare(org, sphere);
            resolved = fast_sphere_resolve(&s, dir, fast_inverse_square(dir), t_min, t_max,
                                           mode.fields & CGT_FIELD_NORMAL, &found.t, found.normal);
        } else {
            resolve_directions(dir, half);
            resolved = resolve_spheres_vector(org, sphere, t_min, mode.fields & CGT_FIELD_NORMAL, spux_not(p->missed),
                                              half, &found.t, found.normal);
        }
    }
    h->t = spux_select(found.t, h->t, p->missed);
    h->u = spux_select(found.u, zero, p->missed);
    h->v = spux_select(found.v, zero, p->missed);
    tile_store_normals(found.normal, p->missed, h);
    return resolved;
}

/* Columns x and on of a row, which have hit `prim`. */
CGT_SPU_INLINE tile_hits tile_resolve_vector(const cgt_committed_scene *committed_scene, const tile *t,
                                             tile_resolve_mode mode, uint32_t x, uint32_t row, vuint prim,
                                             tile_resolve_cache cache)
{
    const uint32_t i = tile_pixel_run_index(x, row);
    const tile_pixel_vector p = {x,
                                 row,
                                 prim,
                                 spu_cmpeq(prim, spux_vuint(CGT_INVALID_ID)),
                                 cache.pixel_runs->first_prim[i],
                                 cache.pixel_runs->uniform[i]};
    tile_hits h = tile_no_hits();
    h.prim = prim;
    if (p.first_prim == CGT_INVALID_ID || !mode.fields)
        return h;
    vfloat dir[3];
    tile_load_directions(cache.ray_table, x, row, dir);
    vmask resolved;
    if (mode.parallel)
        resolved = tile_resolve_parallel(committed_scene, t, mode, &p, dir, &h);
    else if (mode.triangles)
        resolved = tile_resolve_triangles(committed_scene, t, mode, &p, dir, cache, &h);
    else
        resolved = tile_resolve_spheres(committed_scene, t, mode, &p, dir, cache, &h);
    h.unresolved = spux_mask_bits(spux_not(spu_or(p.missed, resolved)));
    return h;
}

#endif

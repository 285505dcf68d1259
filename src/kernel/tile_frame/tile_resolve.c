/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The fields of a tile's hits. Spheres or triangles of one array go from a vector of pixels straight to the caller's
 * planes; all else by strips (tile_resolve_strips.c). */
#include "kernel/tile_frame/tile_resolve_vector.h"
#include "kernel/tile_frame/tile_rows.h"

/* The rays of a vector of pixels. */
CGT_SPU_INLINE void tile_load_rays(const tile *t, bool parallel, const tile_ray_table *ray_table, uint32_t x,
                                   uint32_t row, vfloat org_dir[2][3])
{
    const cgt_camera_rays *c = t->rays;
    for (int a = 0; a < 3; a++)
        org_dir[parallel][a] = spux_vfloat(parallel ? c->fwd[a] : c->eye[a]);
    tile_load_directions(ray_table, x, row, org_dir[!parallel]);
}

/* Lanes that precision FAST does not cover, in double. */
CGT_SPU_INLINE void tile_resolve_double(const cgt_committed_scene *committed_scene, const tile *t,
                                        tile_resolve_mode mode, const tile_ray_table *ray_table, uint32_t x,
                                        uint32_t row, tile_hits *h)
{
    const cgt_primitive_array *array = committed_scene->prims.array;
    const vmask lanes = spux_mask_from_bits(h->unresolved);
    const vuint prim = spux_select(spux_vuint(h->prim[__builtin_ctz(h->unresolved)]), h->prim, lanes);
    const resolved_triangles before = {h->t, h->u, h->v, {h->normal[0], h->normal[1], h->normal[2]}};
    resolved_triangles found = before;
    vfloat org_dir[2][3], sphere[4], vertex[3][3];
    vmask resolved;
    tile_load_rays(t, mode.parallel, ray_table, x, row, org_dir);
    if (mode.triangles) {
        gather_triangles(array, prim, vertex);
        resolved = resolve_triangles_vector(org_dir[0], org_dir[1], vertex, mode.fields, &found);
    } else {
        resolve_half half[2];
        gather_spheres(array, prim, sphere);
        resolve_directions(org_dir[1], half);
        resolved = resolve_spheres_vector(org_dir[0], sphere, spux_vfloat(t->rays->t_min),
                                          mode.fields & CGT_FIELD_NORMAL, lanes, half, &found.t, found.normal);
    }
    resolved = spu_and(resolved, lanes);
    found = resolved_triangles_select(&before, &found, resolved);
    h->t = found.t;
    h->u = found.u;
    h->v = found.v;
    for (int a = 0; a < 3; a++)
        h->normal[a] = found.normal[a];
    h->unresolved &= ~spux_mask_bits(resolved);
}

/* Resolves the remaining lanes: spheres by the long formula, a vector at a time, then all ray by ray. */
CGT_SPU_INLINE void tile_resolve_remaining(const cgt_committed_scene *committed_scene, const tile *t,
                                           tile_resolve_mode mode, const tile_ray_table *ray_table, uint32_t x,
                                           uint32_t row, tile_hits *h, cgt_counts *counts)
{
    if (mode.fast)
        tile_resolve_double(committed_scene, t, mode, ray_table, x, row, h);
    unsigned unresolved = h->unresolved;
    if (unresolved && !mode.triangles) {
        const uint32_t first_prim = h->prim[__builtin_ctz(unresolved)];
        const vmask lanes = spux_mask_from_bits(unresolved);
        vfloat org_dir[2][3], sphere[4];
        tile_load_rays(t, mode.parallel, ray_table, x, row, org_dir);
        gather_spheres(committed_scene->prims.array, spux_select(spux_vuint(first_prim), h->prim, lanes), sphere);
        unresolved &= ~spux_mask_bits(resolve_spheres_long(org_dir[0], org_dir[1], sphere, spux_vfloat(t->rays->t_min),
                                                           mode.fields & CGT_FIELD_NORMAL, lanes, &h->t, h->normal));
    }
    for (; unresolved; unresolved &= unresolved - 1) {
        const int k = __builtin_ctz(unresolved);
        const cgt_ray ray = tile_pixel_ray(t, tile_index(x + (uint32_t)k, row));
        if (mode.triangles) {
            const cgt_triangle q = cgt_primitives_triangle(&committed_scene->prims, h->prim[k]);
            const resolved_triangle s = resolve_triangle_ray(&ray, &q, mode.fields, counts);
            h->t[k] = s.t;
            h->u[k] = s.u;
            h->v[k] = s.v;
            for (int a = 0; a < 3; a++)
                h->normal[a][k] = s.normal[a];
        } else {
            const cgt_sphere q = cgt_primitives_sphere(&committed_scene->prims, h->prim[k]);
            const resolved_sphere s = resolve_sphere_ray(&ray, q, counts);
            h->t[k] = s.t;
            for (int a = 0; a < 3; a++)
                h->normal[a][k] = s.normal[a];
        }
    }
}

/* Not inlined: the hits of the caller stay in registers. */
__attribute__((noinline)) static void tile_store_remaining_hits(const cgt_committed_scene *committed_scene,
                                                                const tile *t, tile_resolve_mode mode,
                                                                const tile_ray_table *ray_table, uint32_t row,
                                                                tile_store_target to, tile_hits *h, cgt_counts *counts)
{
    tile_resolve_remaining(committed_scene, t, mode, ray_table, to.x, row, h, counts);
    tile_store_hits(to, committed_scene->prims.array->geometry, h);
}

/* A vector of pixels of a row, which have hit `prim`. */
CGT_SPU_INLINE void tile_resolve_row(const cgt_committed_scene *committed_scene, const tile *t, tile_resolve_mode mode,
                                     tile_resolve_cache cache, uint32_t row, tile_store_target to, vuint prim,
                                     cgt_counts *counts)
{
    const tile_hits h = tile_resolve_vector(committed_scene, t, mode, to.x, row, prim, cache);
    if (__builtin_expect(h.unresolved != 0, 0)) {
        tile_hits unresolved = h;
        tile_store_remaining_hits(committed_scene, t, mode, cache.ray_table, row, to, &unresolved, counts);
    } else
        tile_store_hits(to, committed_scene->prims.array->geometry, &h);
}

/* Of the pixels of rows y and y + 1, ahead of the loop, whose chain of operations is long enough without a division. */
CGT_SPU_INLINE void tile_compute_inverses(const tile_ray_table *ray_table, uint32_t y, float *inverse)
{
    for (uint32_t i = 0; i < 2 * TILE_EDGE; i += CGT_LANES) {
        vfloat dir[3];
        tile_load_directions(ray_table, i % TILE_EDGE, y + i / TILE_EDGE, dir);
        spux_store(inverse + i, fast_inverse_square(dir));
    }
}

CGT_SPU_INLINE void tile_resolve_region(const cgt_committed_scene *committed_scene, const tile *t,
                                        const cgt_region *region, tile_resolve_mode mode, tile_resolve_cache cache,
                                        cgt_counts *counts)
{
    const bool by_lines = mode.nontemporal && CGT_LANES < TILE_CACHE_LINE;
    const cgt_region r = *region; /* a copy: nothing that is stored changes it */
    const bool by_rows = !mode.nontemporal && tile_needs_rows(&r);
    tile_cache_lines lines;
    tile_rows rows;
    const cgt_region q = by_lines ? tile_cache_lines_region(&r, &lines) : by_rows ? tile_rows_region(&r, &rows) : r;
    for (uint32_t y = 0; y < r.height; y += 2) {
        if (by_rows)
            tile_begin_rows(&r, cache.seam, &rows, y);
        if (mode.fast && cache.inverse)
            tile_compute_inverses(cache.ray_table, y, cache.inverse);
        for (uint32_t x = 0; x < r.width; x += CGT_LANES) {
            const size_t offset = by_lines ? x % TILE_CACHE_LINE : by_rows ? x : (size_t)y * r.row_stride + x;
            const tile_store_target to = {&q, mode.nontemporal && !by_lines, x, offset};
            const tile_store_target next_row = {&q, mode.nontemporal && !by_lines, x, offset + q.row_stride};
            vuint prim[2];
            tile_load_rows(t->prim, x, y, prim);
            tile_resolve_row(committed_scene, t, mode, cache, y, to, prim[0], counts);
            if (mode.nontemporal || y + 1 < r.height)
                tile_resolve_row(committed_scene, t, mode, cache, y + 1, next_row, prim[1], counts);
            if (by_lines && (x + CGT_LANES) % TILE_CACHE_LINE == 0)
                tile_stream_lines(&r, &lines, x + CGT_LANES - TILE_CACHE_LINE, y);
        }
        if (by_rows)
            tile_stream_rows(&r, cache.seam, &rows, y);
    }
}

/* ---- loops for constant modes ---- */

/* Ten copies of the loop, for modes whose constants gain 1 % of a frame or more. Measured: `nontemporal` 2 to 3 % with
 * spheres, 1 % with triangles; triangles without u and v 8 %; both modes of parallel rays up to 5 % at 4 lanes. Nothing
 * is gained by constants for spheres without normals or in FAST precision. */

/* Two copies, with and without `nontemporal`. */
CGT_SPU_INLINE void tile_resolve_streamed(const cgt_committed_scene *committed_scene, const tile *t,
                                          const cgt_region *r, tile_resolve_mode mode, tile_resolve_cache cache,
                                          cgt_counts *counts)
{
    mode.nontemporal = true;
    if (tile_can_stream(r)) {
        tile_resolve_region(committed_scene, t, r, mode, cache, counts);
        spux_stream_end();
        return;
    }
    mode.nontemporal = false;
    tile_resolve_region(committed_scene, t, r, mode, cache, counts);
    if (tile_needs_rows(r))
        spux_stream_end();
}

__attribute__((noinline)) static void tile_resolve_sphere_array(const cgt_committed_scene *committed_scene,
                                                                const tile *t, const cgt_region *r,
                                                                tile_resolve_mode mode, tile_resolve_cache cache,
                                                                cgt_counts *counts)
{
    tile_prepared_sphere prepared = {.number = CGT_INVALID_ID};
    _Alignas(CGT_VECTOR_BYTES) float inverse[2 * TILE_EDGE];
    cache.sphere = &prepared;
    cache.inverse = mode.fields ? inverse : NULL;
    mode.triangles = mode.parallel = false;
    tile_resolve_streamed(committed_scene, t, r, mode, cache, counts);
}

__attribute__((noinline)) static void tile_resolve_triangle_array(const cgt_committed_scene *committed_scene,
                                                                  const tile *t, const cgt_region *r,
                                                                  tile_resolve_mode mode, tile_resolve_cache cache,
                                                                  cgt_counts *counts)
{
    tile_prepared_triangles *prepared = cgt_scratch_take(counts->scratch, sizeof *prepared);
    cache.prepared = prepared;
    mode.triangles = true;
    mode.parallel = false;
    mode.prepared = mode.fields && t->triangle_count < TILE_MAX_TRIANGLES;
    if (mode.prepared)
        tile_prepare_triangles(committed_scene, t, mode.fields, mode.fast, prepared);
    if (mode.fields & CGT_FIELD_UV) {
        tile_resolve_streamed(committed_scene, t, r, mode, cache, counts);
    } else {
        mode.fields &= CGT_FIELD_T | CGT_FIELD_NORMAL;
        tile_resolve_streamed(committed_scene, t, r, mode, cache, counts);
    }
    cgt_scratch_return(counts->scratch, prepared);
}

__attribute__((noinline)) static void tile_resolve_parallel_array(const cgt_committed_scene *committed_scene,
                                                                  const tile *t, const cgt_region *r,
                                                                  tile_resolve_mode mode, tile_resolve_cache cache,
                                                                  cgt_counts *counts)
{
    const bool triangles = mode.triangles;
    mode.parallel = true;
    mode.triangles = true;
    if (triangles) {
        tile_resolve_streamed(committed_scene, t, r, mode, cache, counts);
        return;
    }
    mode.triangles = false;
    tile_resolve_streamed(committed_scene, t, r, mode, cache, counts);
}

static void tile_resolve_array(const cgt_committed_scene *committed_scene, const tile *t,
                               const cgt_trace_settings *settings, const cgt_region *r, tile_seam *seam,
                               cgt_counts *counts)
{
    const bool uv = r->plane[CGT_PLANE_U] && committed_scene->prims.triangles;
    const tile_resolve_mode mode = {.triangles = committed_scene->prims.triangles != 0,
                                    .fast = settings->precision == CGT_PRECISION_FAST,
                                    .fields = (r->plane[CGT_PLANE_T] ? CGT_FIELD_T : 0u) |
                                              (r->plane[CGT_PLANE_NORMAL] ? CGT_FIELD_NORMAL : 0u) |
                                              (uv ? CGT_FIELD_UV : 0u)};
    tile_pixel_runs pixel_runs;
    tile_ray_table ray_table;
    const tile_resolve_cache cache = {.pixel_runs = &pixel_runs, .ray_table = &ray_table, .seam = seam};
    if (tile_compute_pixel_runs(t, r, &pixel_runs, counts) && mode.fields) /* else no vector needs the table */
        tile_init_ray_table(t, &ray_table);
    if (t->parallel)
        tile_resolve_parallel_array(committed_scene, t, r, mode, cache, counts);
    else if (committed_scene->prims.triangles)
        tile_resolve_triangle_array(committed_scene, t, r, mode, cache, counts);
    else
        tile_resolve_sphere_array(committed_scene, t, r, mode, cache, counts);
}

/* ---- the tile ---- */

/* A region that no primitive has reached. */
static void tile_resolve_empty(const cgt_region *r, tile_seam *seam)
{
    const tile_hits none = tile_no_hits();
    if (!tile_needs_rows(r)) {
        for (uint32_t y = 0; y < r->height; y++)
            for (uint32_t x = 0; x < r->width; x += CGT_LANES)
                tile_store_hits((tile_store_target){r, false, x, (size_t)y * r->row_stride + x}, CGT_INVALID_ID, &none);
        return;
    }
    tile_rows rows;
    const cgt_region q = tile_rows_region(r, &rows);
    for (uint32_t k = 0; k < 2 * TILE_EDGE; k += CGT_LANES)
        tile_store_hits((tile_store_target){&q, false, 0, k < TILE_EDGE ? k : k - TILE_EDGE + TILE_ROW_WORDS},
                        CGT_INVALID_ID, &none);
    for (uint32_t y = 0; y < r->height; y += 2) {
        tile_begin_rows(r, seam, &rows, y);
        tile_stream_rows(r, seam, &rows, y);
    }
    spux_stream_end();
}

void CGT_KERNEL(cgt_tile_resolve)(const cgt_committed_scene *committed_scene, const tile *t,
                                  const cgt_trace_settings *settings, const cgt_region *region, tile_seam *seam,
                                  cgt_counts *counts)
{
    if (!t->initialised)
        tile_resolve_empty(region, seam);
    else if (tile_resolves_array(&committed_scene->prims))
        tile_resolve_array(committed_scene, t, settings, region, seam, counts);
    else
        CGT_KERNEL(cgt_tile_resolve_strips)(committed_scene, t, settings, region, counts);
}

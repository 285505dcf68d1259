/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From a tile's winners to the caller's planes. Objects of one array go from a vector of pixels straight to them; all
 * else some whole rows at a time as a packet of rays, which lie in it as their pixels do in the planes. */
#ifndef CGT_TILE_RESOLVE_H
#define CGT_TILE_RESOLVE_H

#include "camera_packet.h"
#include "object_fetch.h"
#include "resolve_fast_vectors.h"
#include "resolve_spheres.h"
#include "resolve_triangles.h"
#include "tile_mesh.h"

#define TILE_STRIP (PACKET_MAX_RAYS / TILE_EDGE) /* rows; even */

/* The canonical directions of px and py, or the origins of parallel rays, in the order of camera.h. */
CGT_SPU_INLINE void tile_directions(const tile *t, bool parallel, vfloat px, vfloat py, vfloat dir[3])
{
    const cgt_camera_rays *c = t->rays;
    const float *from = parallel ? c->eye : c->fwd;
    for (int a = 0; a < 3; a++) {
        const vfloat across = spu_add(spux_vfloat(from[a]), spu_mul(px, spux_vfloat(c->right[a])));
        dir[a] = spu_add(across, spu_mul(py, spux_vfloat(c->up[a])));
    }
}

/* ---- objects of one array ---- */

/* A row of a vector's columns of a plane; a region less wide than a tile ends among them. */
CGT_SPU_INLINE void tile_put_row(uint32_t *to, const cgt_region *r, bool stream, uint32_t x, vuint v)
{
    if (stream)
        spux_stream_uint(to, v);
    else if (x + CGT_LANES <= r->width)
        spux_store_unaligned_uint(to, v);
    else
        spux_store_mask_uint(to, v, spux_mask_first(r->width - x));
}

/* Columns x and on of rows y and y + 1 of a plane, which begin at `at` in it, from two vectors of pixels as the tile has
 * them. */
CGT_SPU_INLINE void tile_put(void *plane, const cgt_region *r, bool stream, size_t at, uint32_t x, uint32_t y, vuint a,
                             vuint b)
{
    vuint row[2] = {a, b};
    if (!plane)
        return;
    uint32_t *to = (uint32_t *)plane + at;
    spux_unzip(row);
    tile_put_row(to, r, stream, x, row[0]);
    if (stream || y + 1 < r->height)
        tile_put_row(to + r->row_stride, r, stream, x, row[1]);
}

CGT_SPU_INLINE bool tile_on_lines(const void *plane) { return (uintptr_t)plane % CGT_VECTOR_BYTES == 0; }

/* Whether whole vectors may go past the caches. */
CGT_SPU_INLINE bool tile_streams(const cgt_region *r)
{
    return r->stream && r->width == TILE_EDGE && r->height % 2 == 0 && r->row_stride % CGT_LANES == 0 &&
           tile_on_lines(r->t) && tile_on_lines(r->primitive) && tile_on_lines(r->geometry) &&
           tile_on_lines(r->normal[0]) && tile_on_lines(r->normal[1]) && tile_on_lines(r->normal[2]) &&
           tile_on_lines(r->u) && tile_on_lines(r->v);
}

/* What a vector of pixels gets. */
typedef struct tile_hits {
    vuint object;
    vfloat t, u, v, normal[3];
} tile_hits;

CGT_SPU_INLINE cgt_ray tile_hit_ray(const tile *t, const vfloat dir[3], int k)
{
    const cgt_camera_rays *c = t->rays;
    cgt_ray ray = {.t_min = c->t_min};
    for (int a = 0; a < 3; a++) {
        ray.line.org[a] = t->parallel ? dir[a][k] : c->eye[a];
        ray.line.dir[a] = t->parallel ? c->fwd[a] : dir[a][k];
    }
    return ray;
}

/* The rays of some lanes, one by one. */
__attribute__((noinline, unused)) static void tile_resolve_sphere_rays(const cgt_world *world, const tile *t,
                                                                       unsigned lanes, const vfloat dir[3],
                                                                       tile_hits *h, cgt_counts *counts)
{
    for (; lanes; lanes &= lanes - 1) {
        const int k = __builtin_ctz(lanes);
        const cgt_ray ray = tile_hit_ray(t, dir, k);
        const resolved_sphere s = resolve_sphere_ray(&ray, cgt_objects_sphere(&world->objects, h->object[k]), counts);
        h->t[k] = s.t;
        for (int a = 0; a < 3; a++)
            h->normal[a][k] = s.normal[a];
    }
}

__attribute__((noinline, unused)) static void tile_resolve_triangle_rays(const cgt_world *world, const tile *t,
                                                                         unsigned lanes, const vfloat dir[3],
                                                                         uint32_t fields, bool exact, tile_hits *h,
                                                                         cgt_counts *counts)
{
    for (; lanes; lanes &= lanes - 1) {
        const int k = __builtin_ctz(lanes);
        const cgt_ray ray = tile_hit_ray(t, dir, k);
        const cgt_triangle q = cgt_objects_triangle(&world->objects, h->object[k]);
        const resolved_triangle s = resolve_triangle_ray(&ray, &q, fields, exact, counts);
        h->t[k] = s.t;
        h->u[k] = s.u;
        h->v[k] = s.v;
        for (int a = 0; a < 3; a++)
            h->normal[a][k] = s.normal[a];
    }
}

/* What the last vector of pixels has met: the next one has mostly met the same. */
typedef struct tile_prepared_sphere {
    uint32_t number;
    prepared_sphere sphere;
} tile_prepared_sphere;

/* What is constant over a frame; inlined with constants where that makes loops shorter. */
typedef struct tile_wish {
    bool triangles, stream, exact, fast;
    bool mesh;       /* triangles are prepared */
    bool parallel;   /* rays: tile_directions are their origins */
    uint32_t fields; /* t, u v and normals */
} tile_wish;

/* The objects of a vector, `number`, lanes without a hit having that of one that has, `some`. */
CGT_SPU_INLINE void tile_resolve_spheres(const cgt_world *world, const tile *t, tile_wish wish, vuint number,
                                         uint32_t some, vmask missed, const vfloat dir[3], tile_prepared_sphere *kept,
                                         tile_hits *h, cgt_counts *counts)
{
    const cgt_object_array *array = world->objects.array;
    const float *eye = t->rays->eye;
    const vfloat t_min = spux_vfloat(t->rays->t_min), zero = spux_vfloat(0);
    const bool normals = wish.fields & CGT_FIELD_NORMAL;
    vfloat n[3] = {zero, zero, zero}, found;
    vmask known;
    if (!wish.fast && spux_all(spu_cmpeq(number, spux_vuint(some)))) {
        if (some != kept->number) {
            kept->number = some;
            kept->sphere = prepare_sphere(eye, cgt_array_sphere(array, some));
        }
        known = resolve_prepared_sphere(&kept->sphere, dir, t_min, normals, &found, n);
    } else {
        const vfloat org[3] = {spux_vfloat(eye[0]), spux_vfloat(eye[1]), spux_vfloat(eye[2])};
        _Alignas(CGT_VECTOR_BYTES) uint32_t at[CGT_LANES];
        vfloat sphere[4];
        spux_store_uint(at, number);
        fetch_spheres_at(array, at, sphere);
        known = wish.fast ? resolve_fast_spheres(org, dir, sphere, t_min, normals, &found, n)
                          : resolve_spheres_vector(org, dir, sphere, t_min, normals, &found, n);
    }
    h->t = spux_select(found, h->t, missed);
    for (int a = 0; normals && a < 3; a++)
        h->normal[a] = spux_select(n[a], zero, missed);
    const unsigned rest = spux_mask_bits(spux_not(spu_or(missed, known)));
    if (rest) { /* of copies, so that the others stay in registers */
        const vfloat d[3] = {dir[0], dir[1], dir[2]};
        tile_hits mended = *h;
        tile_resolve_sphere_rays(world, t, rest, d, &mended, counts);
        *h = mended;
    }
}

CGT_SPU_INLINE void tile_resolve_triangles(const cgt_world *world, const tile *t, tile_wish wish, uint32_t i,
                                           vuint number, unsigned hit, vmask missed, const vfloat dir[3],
                                           const tile_mesh *mesh, tile_hits *h, cgt_counts *counts)
{
    const cgt_object_array *array = world->objects.array;
    const float *eye = t->rays->eye;
    const vfloat zero = spux_vfloat(0);
    const uint32_t fields = wish.fields;
    const bool exact = wish.exact;
    resolved_triangles found = {zero, zero, zero, {zero, zero, zero}};
    vmask known;
    if (wish.mesh)
        known = tile_mesh_resolve(mesh, i, hit, dir, fields, exact, &found);
    else {
        const vfloat org[3] = {spux_vfloat(eye[0]), spux_vfloat(eye[1]), spux_vfloat(eye[2])};
        vfloat vertex[3][3];
        fetch_triangles_at(array, number, vertex);
        known = resolve_triangles_vector(org, dir, vertex, fields, exact, &found);
    }
    h->t = spux_select(found.t, h->t, missed);
    h->u = spux_select(found.u, zero, missed);
    h->v = spux_select(found.v, zero, missed);
    for (int a = 0; a < 3; a++)
        h->normal[a] = spux_select(found.normal[a], zero, missed);
    const unsigned rest = spux_mask_bits(spux_not(spu_or(missed, known)));
    if (rest) {
        const vfloat d[3] = {dir[0], dir[1], dir[2]};
        tile_hits mended = *h;
        tile_resolve_triangle_rays(world, t, rest, d, fields, exact, &mended, counts);
        *h = mended;
    }
}

/* What is kept from vector to vector. */
typedef struct tile_kept {
    tile_prepared_sphere *sphere;
    const tile_mesh *mesh;
} tile_kept;

/* A vector of parallel rays, from these origins. */
CGT_SPU_INLINE void tile_resolve_parallel(const cgt_world *world, const tile *t, tile_wish wish, vuint number,
                                          uint32_t some, vmask missed, const vfloat org[3], tile_hits *h,
                                          cgt_counts *counts)
{
    const cgt_object_array *array = world->objects.array;
    const float *fwd = t->rays->fwd;
    const vfloat zero = spux_vfloat(0), dir[3] = {spux_vfloat(fwd[0]), spux_vfloat(fwd[1]), spux_vfloat(fwd[2])};
    resolved_triangles found = {zero, zero, zero, {zero, zero, zero}};
    vmask known;
    if (wish.triangles) {
        vfloat vertex[3][3];
        fetch_triangles_at(array, number, vertex);
        known = resolve_triangles_vector(org, dir, vertex, wish.fields, wish.exact, &found);
    } else {
        _Alignas(CGT_VECTOR_BYTES) uint32_t at[CGT_LANES];
        const cgt_sphere q = cgt_array_sphere(array, some);
        vfloat sphere[4] = {spux_vfloat(q.x), spux_vfloat(q.y), spux_vfloat(q.z), spux_vfloat(q.r)};
        if (!spux_all(spu_cmpeq(number, spux_vuint(some)))) {
            spux_store_uint(at, number);
            fetch_spheres_at(array, at, sphere);
        }
        known = resolve_spheres_vector(org, dir, sphere, spux_vfloat(t->rays->t_min), wish.fields & CGT_FIELD_NORMAL,
                                       &found.t, found.normal);
    }
    h->t = spux_select(found.t, h->t, missed);
    h->u = spux_select(found.u, zero, missed);
    h->v = spux_select(found.v, zero, missed);
    for (int a = 0; a < 3; a++)
        h->normal[a] = spux_select(found.normal[a], zero, missed);
    const unsigned rest = spux_mask_bits(spux_not(spu_or(missed, known)));
    if (rest && wish.triangles)
        tile_resolve_triangle_rays(world, t, rest, org, wish.fields, wish.exact, h, counts);
    else if (rest)
        tile_resolve_sphere_rays(world, t, rest, org, h, counts);
}

CGT_SPU_INLINE tile_hits tile_resolve_vector(const cgt_world *world, const tile *t, tile_wish wish, uint32_t i,
                                             tile_kept kept, uint64_t *hits, cgt_counts *counts)
{
    const vfloat zero = spux_vfloat(0);
    tile_hits h = {spux_load_uint(t->object + i), spux_vfloat(INFINITY), zero, zero, {zero, zero, zero}};
    const vmask missed = spu_cmpeq(h.object, spux_vuint(CGT_NONE));
    const unsigned hit = ~spux_mask_bits(missed) & CGT_ALL_LANES;
    *hits += spux_count_bits(hit);
    if (!hit || !wish.fields)
        return h;
    const uint32_t some = t->object[i + (uint32_t)__builtin_ctz(hit)];
    const vuint number = spux_select(h.object, spux_vuint(some), missed);
    vfloat dir[3];
    tile_directions(t, wish.parallel, spux_load_unaligned(t->px + (i & (TILE_PAIR - 1))),
                    spux_load(t->py[i / TILE_PAIR]), dir);
    if (wish.parallel)
        tile_resolve_parallel(world, t, wish, number, some, missed, dir, &h, counts);
    else if (wish.triangles)
        tile_resolve_triangles(world, t, wish, i, number, hit, missed, dir, kept.mesh, &h, counts);
    else
        tile_resolve_spheres(world, t, wish, number, some, missed, dir, kept.sphere, &h, counts);
    return h;
}

CGT_SPU_INLINE void tile_resolve_to(const cgt_world *world, const tile *t, const cgt_region *region, tile_wish wish,
                                    tile_kept kept, cgt_counts *counts)
{
    const vuint none = spux_vuint(CGT_NONE), geometry = spux_vuint(world->objects.array->geometry);
    const cgt_region q = *region, *r = &q; /* a copy: nothing that is stored changes it */
    const bool stream = wish.stream;
    uint64_t hits = 0;
    for (uint32_t y = 0; y < r->height; y += 2)
        for (uint32_t x = 0; x < r->width; x += CGT_LANES) {
            const uint32_t i = tile_index(x, y);
            const size_t at = (size_t)y * r->row_stride + x;
            const tile_hits a = tile_resolve_vector(world, t, wish, i, kept, &hits, counts);
            const tile_hits b = tile_resolve_vector(world, t, wish, i + CGT_LANES, kept, &hits, counts);
            tile_put(r->t, r, stream, at, x, y, (vuint)a.t, (vuint)b.t);
            tile_put(r->primitive, r, stream, at, x, y, a.object, b.object);
            tile_put(r->geometry, r, stream, at, x, y, spux_select(geometry, none, spu_cmpeq(a.object, none)),
                     spux_select(geometry, none, spu_cmpeq(b.object, none)));
            for (int k = 0; k < 3; k++)
                tile_put(r->normal[k], r, stream, at, x, y, (vuint)a.normal[k], (vuint)b.normal[k]);
            tile_put(r->u, r, stream, at, x, y, (vuint)a.u, (vuint)b.u);
            tile_put(r->v, r, stream, at, x, y, (vuint)a.v, (vuint)b.v);
        }
    counts->hits += hits;
}

/* Constants make the loops shorter. */
CGT_SPU_INLINE void tile_resolve_streamed(const cgt_world *world, const tile *t, const cgt_region *r, tile_wish wish,
                                          tile_kept kept, cgt_counts *counts)
{
    wish.stream = tile_streams(r);
    if (wish.stream) {
        wish.stream = true;
        tile_resolve_to(world, t, r, wish, kept, counts);
        spux_stream_end();
    } else {
        wish.stream = false;
        tile_resolve_to(world, t, r, wish, kept, counts);
    }
}

__attribute__((noinline, unused)) static void tile_resolve_sphere_array(const cgt_world *world, const tile *t,
                                                                        const cgt_region *r, tile_wish wish,
                                                                        cgt_counts *counts)
{
    tile_prepared_sphere prepared = {.number = CGT_NONE};
    const tile_kept kept = {.sphere = &prepared};
    wish.triangles = wish.parallel = false;
    if (!(wish.fields & CGT_FIELD_NORMAL))
        tile_resolve_streamed(world, t, r, wish, kept, counts);
    else {
        wish.fields = CGT_FIELD_T | CGT_FIELD_NORMAL;
        if (wish.fast) {
            wish.fast = true;
            tile_resolve_streamed(world, t, r, wish, kept, counts);
        } else {
            wish.fast = false;
            tile_resolve_streamed(world, t, r, wish, kept, counts);
        }
    }
}

__attribute__((noinline, unused)) static void tile_resolve_triangle_array(const cgt_world *world, const tile *t,
                                                                          const cgt_region *r, tile_wish wish,
                                                                          cgt_counts *counts)
{
    tile_mesh mesh;
    const tile_kept kept = {.mesh = &mesh};
    wish.triangles = true;
    wish.parallel = false;
    wish.mesh = wish.fields && tile_mesh_list(t, r, &mesh);
    if (wish.mesh)
        tile_mesh_prepare(world, t, wish.fields, wish.exact, &mesh);
    if (wish.fields & CGT_FIELD_UV)
        tile_resolve_streamed(world, t, r, wish, kept, counts);
    else {
        wish.fields &= CGT_FIELD_T | CGT_FIELD_NORMAL;
        tile_resolve_streamed(world, t, r, wish, kept, counts);
    }
}

__attribute__((noinline, unused)) static void tile_resolve_parallel_array(const cgt_world *world, const tile *t,
                                                                          const cgt_region *r, tile_wish wish,
                                                                          cgt_counts *counts)
{
    const tile_kept kept = {NULL, NULL};
    wish.parallel = true;
    if (wish.triangles) {
        wish.triangles = true;
        tile_resolve_streamed(world, t, r, wish, kept, counts);
    } else {
        wish.triangles = false;
        tile_resolve_streamed(world, t, r, wish, kept, counts);
    }
}

CGT_SPU_INLINE void tile_resolve_array(const cgt_world *world, const tile *t, const cgt_trace_settings *settings,
                                       const cgt_region *r, cgt_counts *counts)
{
    const tile_wish wish = {.triangles = world->objects.triangles != 0,
                            .exact = settings->precision == CGT_PRECISION_EXACT,
                            .fast = settings->precision == CGT_PRECISION_FAST,
                            .fields = (r->t ? CGT_FIELD_T : 0u) | (r->normal[0] ? CGT_FIELD_NORMAL : 0u) |
                                      (r->u && world->objects.triangles ? CGT_FIELD_UV : 0u)};
    if (t->parallel)
        tile_resolve_parallel_array(world, t, r, wish, counts);
    else if (world->objects.triangles)
        tile_resolve_triangle_array(world, t, r, wish, counts);
    else
        tile_resolve_sphere_array(world, t, r, wish, counts);
}

/* ---- anything, by rows ---- */

CGT_SPU_INLINE void tile_strip_rays(const tile *t, uint32_t y, packet *p)
{
    for (uint32_t row = 0; row < TILE_STRIP; row += 2)
        for (uint32_t x = 0; x < TILE_EDGE; x += CGT_LANES) {
            const uint32_t *from = t->object + tile_index(x, y + row);
            vuint object[2] = {spux_load_uint(from), spux_load_uint(from + CGT_LANES)};
            spux_unzip(object);
            for (uint32_t k = 0; k < 2; k++) {
                const uint32_t i = (row + k) * TILE_EDGE + x;
                spux_store_uint(p->object + i, object[k]);
                if (spux_all(spu_cmpeq(object[k], spux_vuint(CGT_NONE))))
                    continue;
                vfloat dir[3];
                tile_directions(t, t->parallel, spux_load_unaligned(t->column + x), spux_vfloat(t->row[y + row + k]),
                                dir);
                for (int a = 0; a < 3; a++)
                    spux_store((t->parallel ? p->org : p->dir)[a] + i, dir[a]);
            }
        }
}

/* Whole vectors between the row's ends past the caches, wherever it begins. */
CGT_SPU_INLINE void tile_strip_stream(uint32_t *to, const uint32_t *from, uint32_t count)
{
    const uint32_t before = (uint32_t)(-(uintptr_t)to % CGT_VECTOR_BYTES / sizeof *to);
    uint32_t x = before < count ? before : count;
    memcpy(to, from, x * sizeof *to);
    for (; x + CGT_LANES <= count; x += CGT_LANES)
        spux_stream_uint(to + x, spux_load_unaligned_uint(from + x));
    memcpy(to + x, from + x, (count - x) * sizeof *to);
}

CGT_SPU_INLINE void tile_strip_plane(void *plane, const void *from, const cgt_region *r, uint32_t y, uint32_t rows)
{
    if (!plane)
        return;
    for (uint32_t k = 0; k < rows; k++) {
        uint32_t *to = (uint32_t *)plane + (y + k) * r->row_stride;
        const uint32_t *row = (const uint32_t *)from + k * TILE_EDGE;
        if (r->stream)
            tile_strip_stream(to, row, r->width);
        else
            memcpy(to, row, r->width * sizeof *to);
    }
}

CGT_SPU_INLINE void tile_strip_store(const packet_hits *h, const cgt_region *r, uint32_t y)
{
    const uint32_t rows = r->height - y < TILE_STRIP ? r->height - y : TILE_STRIP;
    tile_strip_plane(r->t, h->t, r, y, rows);
    tile_strip_plane(r->primitive, h->primitive, r, y, rows);
    tile_strip_plane(r->geometry, h->geometry, r, y, rows);
    for (int a = 0; a < 3; a++)
        tile_strip_plane(r->normal[a], h->normal[a], r, y, rows);
    tile_strip_plane(r->u, h->u, r, y, rows);
    tile_strip_plane(r->v, h->v, r, y, rows);
}

__attribute__((noinline, unused)) static void tile_resolve(const cgt_world *world, const tile *t,
                                                           const cgt_trace_settings *settings, const cgt_region *region,
                                                           cgt_counts *counts)
{
    packet p;
    packet_hits hits;
    cgt_trace_settings exactly = *settings;
    if (world->objects.arrays == 1) {
        tile_resolve_array(world, t, settings, region, counts);
        return;
    }
    if (settings->precision == CGT_PRECISION_FAST) /* takes what its tests leave in a packet */
        exactly.precision = CGT_PRECISION_ROBUST;
    camera_packet_begin(t->rays, &exactly, PACKET_MAX_EDGE, false, &p);
    p.extreme = false;
    for (uint32_t y = 0; y < region->height; y += TILE_STRIP) {
        tile_strip_rays(t, y, &p);
        CGT_KERNEL(cgt_packet_resolve)(world, &p, &exactly, &hits, counts);
        tile_strip_store(&hits, region, y);
    }
    if (region->stream)
        spux_stream_end();
}

#endif

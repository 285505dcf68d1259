/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reads points with default ranges from dense arrays into a packet of a tile, in one pass: the rays, their terms and
 * the ranges of their groups. The result is that of light_load_packet, light_compute_margin, light_compute_terms and
 * light_compute_groups, one after the other. */
#include "kernel/light/light_groups.h"

/* Lane k gets the minimum of all lanes of vector k; and the maximum. */
CGT_SPU_INLINE vfloat light_reduce_min(vfloat v[CGT_LANES])
{
    for (uint32_t n = CGT_LANES / 2; n; n /= 2)
        for (uint32_t k = 0; k < n; k++) {
            vuint two[2] = {(vuint)v[2 * k], (vuint)v[2 * k + 1]};
            spux_unzip(two);
            v[k] = spux_min((vfloat)two[0], (vfloat)two[1]);
        }
    return v[0];
}
CGT_SPU_INLINE vfloat light_reduce_max(vfloat v[CGT_LANES])
{
    for (uint32_t n = CGT_LANES / 2; n; n /= 2)
        for (uint32_t k = 0; k < n; k++) {
            vuint two[2] = {(vuint)v[2 * k], (vuint)v[2 * k + 1]};
            spux_unzip(two);
            v[k] = spux_max((vfloat)two[0], (vfloat)two[1]);
        }
    return v[0];
}

/* A packet's rays seen from the light: slopes or offsets, and w. */
typedef struct light_projected_rays {
    _Alignas(CGT_VECTOR_BYTES) float coord[2][PACKET_MAX_RAYS], w[PACKET_MAX_RAYS];
} light_projected_rays;

CGT_SPU_INLINE void light_load_vectors(const float *values, uint32_t lanes, vfloat v[CGT_LANES])
{
    for (uint32_t k = 0; k < CGT_LANES; k++)
        v[k] = spux_load(values + (k * CGT_LANES < lanes ? k * CGT_LANES : 0));
}

/* Stores the ranges of the groups of packet `number`, all of whose lanes are undecided, a vector of groups at a time.
 * Groups beyond the packet's end get any numbers. */
CGT_SPU_INLINE void light_store_groups(light_tile *t, uint32_t number, const light_projected_rays *projected,
                                       uint32_t lanes)
{
    for (uint32_t i = 0; i < lanes; i += CGT_LANES * CGT_LANES) {
        const uint32_t group = number * LIGHT_PACKET_GROUPS + i / CGT_LANES;
        vfloat v[CGT_LANES];
        for (int a = 0; a < 2; a++) {
            light_load_vectors(projected->coord[a] + i, lanes - i, v);
            spux_store(t->low[a] + group, light_reduce_min(v));
            light_load_vectors(projected->coord[a] + i, lanes - i, v);
            spux_store(t->high[a] + group, light_reduce_max(v));
        }
        light_load_vectors(projected->w + i, lanes - i, v);
        spux_store(t->end + group, light_reduce_max(v));
    }
}

CGT_SPU_INLINE bool light_tile_read_rays(const light_call *c, light_tile *t, light_packet *l, uint32_t first,
                                         uint32_t count, bool is_point)
{
    const cgt_committed_scene *committed_scene = c->committed_scene;
    const bool triangles = committed_scene->prims.triangles != 0;
    const vfloat end = spux_vfloat(is_point ? 1 : INFINITY), scale = spux_vfloat(committed_scene->scale);
    packet *p = &l->rays;
    vfloat reach[3] = {spux_vfloat(0), spux_vfloat(0), spux_vfloat(0)}, max_component = reach[0], max_sum = reach[0];
    const ray_limits limits = ray_packet_limits(committed_scene, &c->source);
    ray_extent extent = ray_extent_init();
    vmask others = spux_mask_none();
    light_projected_rays projected;
    for (uint32_t i = 0; i < count; i += CGT_LANES) {
        /* origin, direction and terms */
        vfloat org[3], dir[3], coord[2], w, square = spux_vfloat(0), sum = square;
        for (int a = 0; a < 3; a++) {
            org[a] = light_gather_points(&c->order, c->source.rays->org[a], first + i);
            dir[a] = ray_direction_lanes(&c->light, is_point, a, org[a]);
            const vfloat x = is_point ? dir[a] : spu_sub(org[a], spux_vfloat(l->origin[a]));
            square = spu_madd(dir[a], dir[a], square);
            reach[a] = spux_max(reach[a], spux_abs(org[a]));
            max_component = spux_max(max_component, spux_abs(x));
            sum = spu_add(sum, spux_abs(x));
            spux_store(p->org[a] + i, org[a]);
            spux_store(p->dir[a] + i, dir[a]);
            if (triangles)
                spux_store(l->ray_terms[a] + i, spu_mul(x, scale));
        }
        max_sum = spux_max(max_sum, sum);
        ray_extent_add(&extent, org, dir);
        others = spu_or(others, light_project_rays(t, l, org, &w, coord));
        /* the ray, without a hit */
        spux_store(l->square + i, square);
        spux_store(p->t_min + i, spux_vfloat(0));
        spux_store(p->t_max + i, end);
        spux_store(p->high + i, end);
        spux_store_uint(p->prim + i, spux_vuint(CGT_INVALID_ID));
        spux_store(projected.w + i, w);
        for (int a = 0; a < 2; a++)
            spux_store(projected.coord[a] + i, coord[a]);
    }
    if (spux_any(others) || !ray_extent_is_plain(&extent, &limits))
        return false;
    p->lanes = p->rays = count;
    p->common_origin = p->from_origin = p->extreme = false;
    ray_packet_select(committed_scene, &c->source, &c->order, first, count, p);
    l->default_ranges = true;
    /* NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): count is whole vectors, at least one */
    l->undecided = UINT64_MAX >> (64 - count / CGT_LANES);
    l->max_component = spux_hmax(max_component) * committed_scene->scale; /* a power of two */
    l->max_sum = spux_hmax(max_sum) * committed_scene->scale;
    light_set_margin(committed_scene, reach, l);
    light_store_groups(t, t->packets, &projected, count);
    return true;
}

bool CGT_KERNEL(cgt_light_tile_read)(const light_call *c, light_tile *t, light_packet *l, uint32_t first,
                                     uint32_t count)
{
    const ray_source *source = &c->source;
    const uint64_t last = ray_index(&c->order, first + count - 1);
    float org[3], dir[3];
    l->rays.to_light = t->is_point;
    for (int a = 0; a < 3; a++) {
        org[a] = ray_component(source, source->rays->org[a], last);
        dir[a] = ray_direction(source, last, a, org[a]);
        l->rays.light[a] = c->light.position[a];
    }
    if (!light_tile_init_axes(t, l, org, dir))
        return false;
    return t->is_point ? light_tile_read_rays(c, t, l, first, count, true)
                       : light_tile_read_rays(c, t, l, first, count, false);
}

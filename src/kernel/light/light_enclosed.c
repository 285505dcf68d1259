/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A light in a sphere: it occludes every point outside, so that points need neither be sorted nor traced. */
#include "kernel/light/light_leaf.h"
#include "kernel/light/light_points.h"

typedef struct enclosing_sphere {
    uint32_t prim;
    float center[3], square, light; /* r^2; of the light's distance from the centre */
} enclosing_sphere;

/* Of at most a vector of spheres, one that the light is in. */
static bool light_find_among(const light_call *c, const uint32_t *reference, uint32_t count, enclosing_sphere *e)
{
    _Alignas(CGT_VECTOR_BYTES) float row[4][CGT_LANES];
    vfloat sphere[4], distance = spux_vfloat(0);
    gather_scene_spheres(&c->committed_scene->prims, load_references(reference, count), sphere);
    for (int a = 0; a < 3; a++) {
        const vfloat to = spu_sub(sphere[a], spux_vfloat(c->light.position[a]));
        distance = spu_madd(to, to, distance);
    }
    const unsigned inside = spux_mask_bits(spu_cmpgt(spu_mul(sphere[3], sphere[3]), distance)) & first_lanes(count);
    if (!inside)
        return false;
    const uint32_t k = (uint32_t)__builtin_ctz(inside);
    for (int a = 0; a < 4; a++)
        spux_store(row[a], sphere[a]);
    *e = (enclosing_sphere){reference[k], {row[0][k], row[1][k], row[2][k]}, row[3][k] * row[3][k], 0};
    e->light = light_square_distance(e->center, c->light.position);
    return light_ends_inside(e->square, e->light, 0);
}

/* The cells of a level that may have spheres around the light. */
static bool light_cells_around(const cgt_loose_level *l, const float light[3], uint32_t low[3], uint32_t high[3])
{
    for (int a = 0; a < 3; a++) {
        const float first = (light[a] - l->low[a] - l->reach[a]) * l->rcell[a],
                    last = (light[a] - l->low[a] + l->reach[a]) * l->rcell[a], cells = (float)l->size[a];
        if (!(last >= 0 && first < cells))
            return false;
        low[a] = first > 0 ? (uint32_t)first : 0;
        high[a] = last < cells ? (uint32_t)last : l->size[a] - 1;
    }
    return true;
}

/* Looks at no more than `left` rows of cells and spheres. Missing one costs time alone. */
static bool light_find_sphere(const light_call *c, uint32_t left, enclosing_sphere *e)
{
    const cgt_loose_grid *grid = &c->committed_scene->loose;
    for (uint32_t i = 0; i < grid->levels; i++) {
        const cgt_loose_level *l = &grid->level[i];
        uint32_t low[3], high[3];
        if (!light_cells_around(l, c->light.position, low, high))
            continue;
        for (uint32_t z = low[2]; z <= high[2]; z++)
            for (uint32_t y = low[1]; y <= high[1]; y++) {
                const uint32_t *const start = grid->start + l->first + (z * l->size[1] + y) * l->size[0];
                uint32_t count, end = start[high[0] + 1];
                if (!left--)
                    return false;
                for (uint32_t k = start[low[0]]; k < end; k += count) {
                    count = end - k < CGT_LANES ? end - k : CGT_LANES;
                    if (light_find_among(c, grid->prim + k, count, e))
                        return true;
                    if (left <= count)
                        return false;
                    left -= count;
                }
            }
    }
    return false;
}

/* Rays that may skip the sphere are left to the tests of rays. */
bool CGT_KERNEL(cgt_light_is_enclosed)(const light_call *c, uint32_t count)
{
    const cgt_primitives *prims = &c->committed_scene->prims;
    const cgt_rays *points = c->source.rays;
    enclosing_sphere e;
    if (c->light.kind != CGT_LIGHT_POINT || prims->spheres != prims->count || !light_points_are_dense(c) ||
        points->t_min || points->t_max || points->mask || count < CGT_LANES || !light_find_sphere(c, count, &e))
        return false;
    const uint32_t own = e.prim - cgt_primitives_array(prims, e.prim)->first; /* its number in its geometry */
    const uint64_t first = c->order.first;
    vfloat reach = spux_vfloat(0);
    vmask occluded = spux_mask_all();
    for (uint32_t k = 0; k < count && spux_all(occluded); k += CGT_LANES) {
        const uint64_t i = first + (k + CGT_LANES <= count ? k : count - CGT_LANES);
        vfloat org[3];
        for (int a = 0; a < 3; a++) {
            org[a] = spux_load_unaligned(points->org[a] + i);
            reach = spux_max(reach, spux_abs(spu_sub(spux_vfloat(c->light.position[a]), org[a])));
        }
        occluded = spu_and(occluded, light_begins_outside(e.center, e.square, org));
        if (points->skip_primitive)
            occluded =
                spu_andc(occluded, spu_cmpeq(spux_load_unaligned_uint(points->skip_primitive + i), spux_vuint(own)));
    }
    return spux_all(occluded) && light_ends_inside(e.square, e.light, spux_hmax(reach));
}

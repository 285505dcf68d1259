/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The cells in which a light sees points, for the order of a whole call (trace/order/call_order.c), and which of them
 * need no ray: by the same conditions as kernel/packet/ray_packet.h. */
#include "kernel/light/light_projection.h"

/* Elements k to k + CGT_LANES - 1 of an array of the call's; lanes beyond its end repeat the last one. */
CGT_SPU_INLINE vfloat light_load_numbers(const light_call *c, const float *array, uint32_t k, uint32_t count)
{
    _Alignas(CGT_VECTOR_BYTES) float row[CGT_LANES];
    if (c->source.stride == sizeof(float) && k + CGT_LANES <= count)
        return spux_load_unaligned(array + c->order.first + k);
    for (uint32_t i = 0; i < CGT_LANES; i++)
        row[i] = ray_element(&c->source, array, c->order.first + (k + i < count ? k + i : count - 1));
    return spux_load(row);
}

/* Which of a vector's points are invalid: something is not finite, a limit is no number, or the point is the light. */
CGT_SPU_INLINE vmask light_invalid_points(const light_call *c, const vfloat point[3], vfloat t_min, vfloat t_max)
{
    const bool is_point = c->light.kind == CGT_LIGHT_POINT;
    const vfloat none = spux_vfloat(0);
    vfloat zero = none, size = none;
    for (int a = 0; a < 3; a++) {
        const vfloat light = spux_vfloat(c->light.position[a]);
        const vfloat d = is_point ? spu_sub(light, point[a]) : light;
        zero = spu_madd(point[a], none, spu_madd(d, none, zero)); /* NaN where one is not finite */
        size = spux_max(size, spux_abs(d));
    }
    const vmask good = spu_and(spu_cmpeq(zero, none), spu_cmpgt(size, none));
    return spux_not(spu_and(good, spu_and(spu_cmpeq(t_min, t_min), spu_cmpeq(t_max, t_max))));
}

/* The cells of a vector of points. */
CGT_SPU_INLINE vuint light_find_cells(const light_projection *projection, const cgt_light_view *view,
                                      const vfloat point[3])
{
    vfloat coord[2];
    vuint cell[2];
    if (view->is_point)
        light_unfold(projection, point, coord);
    else
        light_apply_projection(projection, point, coord);
    for (int a = 0; a < 2; a++) {
        const vfloat at = spu_mul(spu_sub(coord[a], spux_vfloat(view->low[a])), spux_vfloat(view->scale[a]));
        cell[a] = (vuint)spu_convts(spux_min(spux_max(at, spux_vfloat(0)), spux_vfloat(CGT_VIEW_EDGE - 1)), 0);
    }
    /* and: of numbers beyond the range of float */
    return spu_and(light_curve_place(cell[0], cell[1], CGT_VIEW_BITS), spux_vuint(CGT_VIEW_CELLS - 1));
}

void CGT_KERNEL(cgt_light_keys)(const cgt_rays *points, const cgt_light *light, const cgt_light_view *view,
                                uint64_t first, uint64_t end, uint16_t *key)
{
    const light_call c = {.source = ray_source_init(points, light), .light = *light, .order = {first, NULL}};
    const uint32_t count = (uint32_t)(end - first);
    light_projection projection = {.is_point = view->is_point, .main = view->main, .sign = view->sign};
    for (int a = 0; a < 3; a++)
        projection.origin[a] = view->origin[a];
    for (int a = 0; a < 2; a++)
        projection.slope[a] = view->slope[a];
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        _Alignas(CGT_VECTOR_BYTES) uint32_t row[CGT_LANES];
        vfloat point[3];
        light_load_points(&c, k, count, point);
        const vfloat t_min = points->t_min ? light_load_numbers(&c, points->t_min, k, count) : spux_vfloat(0);
        const vfloat t_max =
            points->t_max ? light_load_numbers(&c, points->t_max, k, count) : spux_vfloat(c.source.t_max);
        vuint keys = light_find_cells(&projection, view, point);
        keys = spux_select(keys, spux_vuint(CGT_VIEW_OFF), spu_cmpgt(t_min, t_max));
        keys = spux_select(keys, spux_vuint(CGT_VIEW_INVALID), light_invalid_points(&c, point, t_min, t_max));
        spux_store_uint(row, keys);
        for (uint32_t i = 0; i < CGT_LANES && k + i < count; i++)
            key[k + i] = (uint16_t)row[i];
    }
}

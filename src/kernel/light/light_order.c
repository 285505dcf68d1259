/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points as a light sees them, projected along an axis or all around it, and two orders by that, which change no
 * result:
 * the cells of a view for all points of a call (trace/order/call_order.c), with those that need no ray;
 * and the points of a chunk along a curve, which are then put into groups. */
#include "kernel/light/light_packet.h"
#include "kernel/light/light_points.h"

/* ---- projections ---- */

/* Projects points as the light sees them, along two axes and in any unit. */
CGT_SPU_INLINE void light_apply_projection(const cgt_light_view *v, const vfloat point[3], vfloat coord[2])
{
    vfloat from[3];
    for (int a = 0; a < 3; a++)
        from[a] = spu_sub(point[a], spux_vfloat(v->origin[a]));
    const vfloat w = from[v->main], rw = v->is_point ? spux_div(spux_vfloat(1), w) : spux_vfloat(1);
    for (uint32_t a = 0; a < 2; a++)
        coord[a] = spu_mul(spu_nmsub(spux_vfloat(v->slope[a]), w, from[(v->main + 1 + a) % 3]), rw);
}

/* Points all around a light: directions as the octahedron unfolds onto a square, the main one in its middle. Neighbours
 * stay neighbours but for the edges of the square, which lie behind the light. */
CGT_SPU_INLINE void light_unfold(const cgt_light_view *v, const vfloat point[3], vfloat coord[2])
{
    const vfloat minus = spux_vfloat(-0.f), one = spux_vfloat(1);
    vfloat from[3], sum = spux_vfloat(0x1p-100f);
    for (int a = 0; a < 3; a++) {
        from[a] = spu_sub(point[a], spux_vfloat(v->origin[a]));
        sum = spu_add(sum, spux_abs(from[a]));
    }
    const vfloat rsum = spux_div(one, sum);
    const vmask behind = spu_cmpgt(spux_vfloat(0), spu_mul(from[v->main], spux_vfloat(v->sign)));
    for (uint32_t a = 0; a < 2; a++) {
        const vfloat own = spu_mul(from[(v->main + 1 + a) % 3], rsum),
                     other = spu_mul(from[(v->main + 2 - a) % 3], rsum);
        const vfloat folded = spu_or(spux_abs(spu_sub(one, spux_abs(other))), spu_and(own, minus));
        coord[a] = spux_select(own, folded, behind);
    }
}

/* Elements k to k + CGT_LANES - 1 of an array of a chunk; lanes beyond its end repeat the last one. */
CGT_SPU_INLINE vfloat light_load_numbers(const light_call *c, const float *array, size_t stride, uint32_t k,
                                         uint32_t count)
{
    _Alignas(CGT_VECTOR_BYTES) float row[CGT_LANES];
    if (stride == sizeof(float) && k + CGT_LANES <= count)
        return spux_load_unaligned(array + c->order.first + k);
    for (uint32_t i = 0; i < CGT_LANES; i++)
        row[i] = ray_element(array, stride, c->order.first + (k + i < count ? k + i : count - 1));
    return spux_load(row);
}

CGT_SPU_INLINE void light_load_points(const light_call *c, uint32_t k, uint32_t count, vfloat point[3])
{
    for (int a = 0; a < 3; a++)
        point[a] = light_load_numbers(c, c->source.rays->org[a], c->source.vector_stride, k, count);
}

/* The place of a cell, below 2^bits along each axis, on a Hilbert curve: unlike a Morton curve it never jumps, so any
 * run of points on it lies close together. From the largest squares on, each is turned as its parent demands. */
CGT_SPU_INLINE vuint light_curve_place(vuint x, vuint y, uint32_t bits)
{
    vuint place = spux_vuint(0);
    for (uint32_t k = bits; k--;) {
        const vuint one = spux_vuint(1), zero = spux_vuint(0);
        const vuint right = spu_and(spu_sr(x, k), one), upper = spu_and(spu_sr(y, k), one);
        place = spu_or(spu_sl(place, 2), spu_xor(spu_add(right, right), spu_xor(spu_and(right, one), upper)));
        const vmask low = spu_cmpeq(upper, zero), flips = spu_and(low, spu_cmpeq(right, one));
        const vuint fx = spux_select(x, spu_xor(x, spux_vuint((1u << bits) - 1)), flips);
        const vuint fy = spux_select(y, spu_xor(y, spux_vuint((1u << bits) - 1)), flips);
        x = spux_select(fx, fy, low);
        y = spux_select(fy, fx, low);
    }
    return place;
}

/* ---- the order of a call ---- */

/* Loads a vector of points. Which of them are off or invalid? */
CGT_SPU_INLINE ray_lane_states light_classify_points(const light_call *c, uint32_t k, uint32_t count, vfloat point[3])
{
    const cgt_rays *points = c->source.rays;
    ray_lanes q;
    light_load_points(c, k, count, point);
    for (int a = 0; a < 3; a++) {
        q.org[a] = point[a];
        q.dir[a] = ray_direction_lanes(&c->light, c->light.kind == CGT_LIGHT_POINT, a, point[a]);
    }
    q.t_min = points->t_min ? light_load_numbers(c, points->t_min, c->source.stride, k, count) : spux_vfloat(0);
    q.t_max =
        points->t_max ? light_load_numbers(c, points->t_max, c->source.stride, k, count) : spux_vfloat(c->source.t_max);
    return ray_classify_lanes(&q, &RAY_NO_LIMITS);
}

bool CGT_KERNEL(cgt_light_all_live)(const cgt_rays *points, const cgt_light *light)
{
    const light_call c = {.source = ray_source_init(points, light), .light = *light};
    const uint32_t count = (uint32_t)points->count;
    vmask off = spux_mask_none();
    vfloat point[3];
    for (uint32_t k = 0; k < count; k += CGT_LANES)
        off = spu_or(off, light_classify_points(&c, k, count, point).off);
    return spux_none(off);
}

/* The cells of a vector of points. */
CGT_SPU_INLINE vuint light_find_cells(const cgt_light_view *view, const vfloat point[3])
{
    vfloat coord[2];
    vuint cell[2];
    if (view->is_point)
        light_unfold(view, point, coord);
    else
        light_apply_projection(view, point, coord);
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
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        _Alignas(CGT_VECTOR_BYTES) uint32_t row[CGT_LANES];
        vfloat point[3];
        const ray_lane_states state = light_classify_points(&c, k, count, point);
        vuint keys = light_find_cells(view, point);
        keys = spux_select(keys, spux_vuint(CGT_VIEW_OFF), state.off);
        keys = spux_select(keys, spux_vuint(CGT_VIEW_INVALID), state.invalid);
        spux_store_uint(row, keys);
        for (uint32_t i = 0; i < CGT_LANES && k + i < count; i++)
            key[k + i] = (uint16_t)row[i];
    }
}

/* ---- the order of a chunk ---- */

#define SORT_BITS 5u
#define SORT_CELLS (1u << SORT_BITS) /* along each axis */
#define SORT_RUNS                                                                                                      \
    4u /* of a chunk, counted in turn: neighbours share cells, and incrementing one counter repeatedly would stall */

_Static_assert(CGT_RAYS_CHUNK <= UINT16_MAX, "a chunk is counted in 16 bits");

/* The main axis is that of the ray of the chunk's middle point. */
static cgt_light_view light_init_view(const light_call *c, uint32_t count)
{
    cgt_light_view v = {.is_point = c->light.kind == CGT_LIGHT_POINT};
    float main_dir[3];
    for (uint32_t a = 0; a < 3; a++) {
        const float o = ray_component(&c->source, c->source.rays->org[a], c->order.first + count / 2);
        main_dir[a] = v.is_point ? o - c->light.position[a] : c->light.position[a];
        v.origin[a] = v.is_point ? c->light.position[a] : o;
        v.main = fabsf(main_dir[a]) > fabsf(main_dir[v.main]) ? a : v.main;
    }
    v.sign = main_dir[v.main] < 0 ? -1 : 1;
    for (uint32_t a = 0; a < 2; a++)
        v.slope[a] = v.is_point ? 0 : main_dir[(v.main + 1 + a) % 3] / main_dir[v.main];
    return v;
}

typedef struct sort_work {
    _Alignas(64) float position[2][CGT_RAYS_CHUNK];
    _Alignas(64) uint32_t key[CGT_RAYS_CHUNK];
    uint16_t start[SORT_CELLS * SORT_CELLS][SORT_RUNS];
    uint16_t curve[SORT_CELLS * SORT_CELLS]; /* the cells along the curve */
} sort_work;

/* Positions of a chunk's points, their extent, and the least of their w. */
CGT_SPU_INLINE void light_place_points(const light_call *c, const cgt_light_view *view, uint32_t count, bool unfolded,
                                       float position[2][CGT_RAYS_CHUNK], float low[2], float high[2], float *least_w)
{
    const vfloat sign = spux_vfloat(view->sign), origin = spux_vfloat(view->origin[view->main]);
    vfloat lower[2], upper[2], w = spux_vfloat(INFINITY);
    for (int a = 0; a < 2; a++) {
        lower[a] = spux_vfloat(INFINITY);
        upper[a] = spux_vfloat(-INFINITY);
    }
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vfloat point[3], coord[2];
        light_load_points(c, k, count, point);
        if (unfolded)
            light_unfold(view, point, coord);
        else
            light_apply_projection(view, point, coord);
        w = spux_min(w, spu_mul(spu_sub(point[view->main], origin), sign));
        for (int a = 0; a < 2; a++) {
            spux_store(position[a] + k, coord[a]);
            lower[a] = spux_min(lower[a], coord[a]);
            upper[a] = spux_max(upper[a], coord[a]);
        }
    }
    for (int a = 0; a < 2; a++) {
        low[a] = spux_hmin(lower[a]);
        high[a] = spux_hmax(upper[a]);
    }
    *least_w = spux_hmin(w);
}

/* The same; where the light has points around it, more than the axes of one tile allow for, by their directions. */
static void light_place_chunk(const light_call *c, uint32_t count, float position[2][CGT_RAYS_CHUNK], float low[2],
                              float high[2])
{
    const cgt_light_view view = light_init_view(c, count);
    float least_w;
    light_place_points(c, &view, count, false, position, low, high, &least_w);
    const bool narrow = least_w > 0 && low[0] >= -LIGHT_MAX_SLOPE && high[0] <= LIGHT_MAX_SLOPE &&
                        low[1] >= -LIGHT_MAX_SLOPE && high[1] <= LIGHT_MAX_SLOPE;
    if (view.is_point && !narrow)
        light_place_points(c, &view, count, true, position, low, high, &least_w);
}

/* Lists the cells along the curve. A chunk has several times as many points, whose places would take longer. */
CGT_SPU_INLINE void light_list_curve(uint16_t curve[SORT_CELLS * SORT_CELLS])
{
    for (uint32_t i = 0; i < SORT_CELLS * SORT_CELLS; i += CGT_LANES) {
        _Alignas(CGT_VECTOR_BYTES) uint32_t place[CGT_LANES];
        const vuint cell = spu_add(spux_vuint(i), spux_lane_index());
        const vuint x = spu_and(cell, spux_vuint(SORT_CELLS - 1)), y = spu_sr(cell, SORT_BITS);
        spux_store_uint(place, light_curve_place(x, y, SORT_BITS));
        for (uint32_t k = 0; k < CGT_LANES; k++)
            curve[place[k]] = (uint16_t)(i + k);
    }
}

void CGT_KERNEL(cgt_light_sort_points)(const light_call *c, uint32_t count, uint32_t from[CGT_RAYS_CHUNK])
{
    sort_work *w = cgt_scratch_take(c->counts->scratch, sizeof *w);
    float(*restrict position)[CGT_RAYS_CHUNK] = w->position;
    uint32_t *restrict key = w->key;
    uint16_t(*restrict start)[SORT_RUNS] = w->start, *restrict curve = w->curve, sum = 0;
    const uint32_t run = count / SORT_RUNS;
    float low[2], high[2];
    vfloat lower[2], scale[2];
    memset(w->start, 0, sizeof w->start);
    light_place_chunk(c, count, position, low, high);
    light_list_curve(curve);
    for (int a = 0; a < 2; a++) {
        const float length = high[a] - low[a];
        lower[a] = spux_vfloat(low[a]);
        scale[a] = spux_vfloat(length > 0 ? SORT_CELLS / length : 0);
    }
    /* the keys: cells row by row */
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vuint cell[2];
        for (int a = 0; a < 2; a++) {
            const vfloat coord = spu_mul(spu_sub(spux_load(position[a] + k), lower[a]), scale[a]);
            cell[a] = (vuint)spu_convts(spux_min(spux_max(coord, spux_vfloat(0)), spux_vfloat(SORT_CELLS - 1)), 0);
        }
        spux_store_uint(key + k,
                        spu_and(spu_or(cell[0], spu_sl(cell[1], SORT_BITS)), spux_vuint(SORT_CELLS * SORT_CELLS - 1)));
    }
    /* a counting sort: count, sum up along the curve, place */
    for (uint32_t i = 0; i < run; i++)
        for (uint32_t r = 0; r < SORT_RUNS; r++)
            start[key[r * run + i]][r]++;
    for (uint32_t k = run * SORT_RUNS; k < count; k++)
        start[key[k]][SORT_RUNS - 1]++;
    for (uint32_t k = 0; k < SORT_CELLS * SORT_CELLS; k++)
        for (uint32_t r = 0; r < SORT_RUNS; r++) {
            const uint16_t cell = curve[k], cell_count = start[cell][r];
            start[cell][r] = sum;
            sum = (uint16_t)(sum + cell_count);
        }
    for (uint32_t i = 0; i < run; i++) /* stable within a run */
        for (uint32_t r = 0; r < SORT_RUNS; r++)
            from[start[key[r * run + i]][r]++] = r * run + i;
    for (uint32_t k = run * SORT_RUNS; k < count; k++)
        from[start[key[k]][SORT_RUNS - 1]++] = k;
    cgt_scratch_return(c->counts->scratch, w);
}

bool CGT_KERNEL(cgt_light_is_scattered)(const light_call *c, uint32_t count)
{
    const cgt_light_view view = light_init_view(c, count);
    float lower[2] = {INFINITY, INFINITY}, upper[2] = {-INFINITY, -INFINITY}, sum = 0, total = 0;
    uint32_t groups = 0;
    for (uint32_t k = 0; k + CGT_LANES <= count; k += (count / 16 / CGT_LANES + 1) * CGT_LANES, groups++) {
        vfloat point[3], coord[2];
        light_load_points(c, k, count, point);
        light_apply_projection(&view, point, coord);
        for (int a = 0; a < 2; a++) {
            const float low = spux_hmin(coord[a]), high = spux_hmax(coord[a]);
            sum += high - low;
            lower[a] = low < lower[a] ? low : lower[a];
            upper[a] = light_max(upper[a], high);
        }
    }
    for (int a = 0; a < 2; a++)
        total += upper[a] - lower[a];
    return !(sum * 3 <= total * (float)groups);
}

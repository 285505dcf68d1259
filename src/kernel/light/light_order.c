/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The points of a chunk as seen from a light: the order in which they are put into groups, and an estimate of how many
 * primitives lie between. Neither changes any result. */
#include "kernel/light/light_packet.h"
#include "kernel/light/light_projection.h"

#define LIGHT_SAMPLE_STEP 16u /* one of so many vectors of points is sampled for the extent of a chunk */
#define SORT_BITS 5u
#define SORT_CELLS (1u << SORT_BITS) /* along each axis */
#define SORT_RUNS                                                                                                      \
    4u /* of a chunk, counted in turn: neighbours share cells, and incrementing one counter repeatedly would stall */

_Static_assert(CGT_RAYS_CHUNK <= UINT16_MAX, "a chunk is counted in 16 bits");

/* The main axis is that of the ray of the chunk's middle point. */
static light_projection light_init_projection(const light_call *c, uint32_t count)
{
    light_projection v = {.is_point = c->light.kind == CGT_LIGHT_POINT};
    float main_dir[3];
    for (uint32_t a = 0; a < 3; a++) {
        const float o = ray_element(&c->source, c->source.rays->org[a], c->order.first + count / 2);
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
CGT_SPU_INLINE void light_place_points(const light_call *c, const light_projection *projection, uint32_t count,
                                       bool unfolded, float position[2][CGT_RAYS_CHUNK], float low[2], float high[2],
                                       float *least_w)
{
    const vfloat sign = spux_vfloat(projection->sign), origin = spux_vfloat(projection->origin[projection->main]);
    vfloat lower[2], upper[2], w = spux_vfloat(INFINITY);
    for (int a = 0; a < 2; a++) {
        lower[a] = spux_vfloat(INFINITY);
        upper[a] = spux_vfloat(-INFINITY);
    }
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vfloat point[3], coord[2];
        light_load_points(c, k, count, point);
        if (unfolded)
            light_unfold(projection, point, coord);
        else
            light_apply_projection(projection, point, coord);
        w = spux_min(w, spu_mul(spu_sub(point[projection->main], origin), sign));
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
    const light_projection projection = light_init_projection(c, count);
    float least_w;
    light_place_points(c, &projection, count, false, position, low, high, &least_w);
    const bool narrow = least_w > 0 && low[0] >= -LIGHT_MAX_SLOPE && high[0] <= LIGHT_MAX_SLOPE &&
                        low[1] >= -LIGHT_MAX_SLOPE && high[1] <= LIGHT_MAX_SLOPE;
    if (projection.is_point && !narrow)
        light_place_points(c, &projection, count, true, position, low, high, &least_w);
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
    const light_projection projection = light_init_projection(c, count);
    float lower[2] = {INFINITY, INFINITY}, upper[2] = {-INFINITY, -INFINITY}, sum = 0, total = 0;
    uint32_t groups = 0;
    for (uint32_t k = 0; k + CGT_LANES <= count; k += (count / 16 / CGT_LANES + 1) * CGT_LANES, groups++) {
        vfloat point[3], coord[2];
        light_load_points(c, k, count, point);
        light_apply_projection(&projection, point, coord);
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

uint64_t CGT_KERNEL(cgt_tile_light_prims)(const cgt_committed_scene *committed_scene, const cgt_rays *points,
                                          const cgt_light *light, uint64_t first, uint64_t end)
{
    const light_call c = {.committed_scene = committed_scene,
                          .source = ray_source_init(points, light),
                          .light = *light,
                          .order = {first, NULL}};
    const uint32_t count = (uint32_t)(end - first);
    if (!light_is_near(&c))
        return UINT32_MAX;
    const light_projection projection = light_init_projection(&c, count);
    vfloat lower[2], upper[2], corner[3], coord[2];
    double share = 1;
    for (int a = 0; a < 2; a++) {
        lower[a] = spux_vfloat(INFINITY);
        upper[a] = spux_vfloat(-INFINITY);
    }
    /* the extent of the points */
    for (uint32_t k = 0; k < count; k += LIGHT_SAMPLE_STEP * CGT_LANES) {
        vfloat point[3];
        light_load_points(&c, k, count, point);
        light_apply_projection(&projection, point, coord);
        for (int a = 0; a < 2; a++) {
            lower[a] = spux_min(lower[a], coord[a]);
            upper[a] = spux_max(upper[a], coord[a]);
        }
    }
    /* the extent of the scene */
    float low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (uint32_t k = 0; k < 8; k++) {
        for (int a = 0; a < 3; a++)
            corner[a] = spux_vfloat(k >> a & 1 ? committed_scene->high[a] : committed_scene->low[a]);
        light_apply_projection(&projection, corner, coord);
        for (int a = 0; a < 2; a++) {
            low[a] = coord[a][0] < low[a] ? coord[a][0] : low[a];
            high[a] = light_max(high[a], coord[a][0]);
        }
    }
    for (int a = 0; a < 2; a++) {
        const double points_extent = (double)spux_hmax(upper[a]) - (double)spux_hmin(lower[a]);
        /* a light among the primitives has some of them behind it: their slopes tell nothing */
        double scene_extent = (double)high[a] - (double)low[a];
        scene_extent = projection.is_point && !(scene_extent < 2 * (double)LIGHT_MAX_SLOPE)
                           ? 2 * (double)LIGHT_MAX_SLOPE
                           : scene_extent;
        share *= points_extent >= 0 && points_extent < scene_extent ? points_extent / scene_extent : 1;
    }
    return (uint64_t)(share * committed_scene->valid);
}

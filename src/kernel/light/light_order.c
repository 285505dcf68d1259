/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The points of a chunk as seen from a light: the order in which they are put into groups, and an estimate of how many
 * primitives lie between. Neither changes any result. */
#include "kernel/light/light_packet.h"
#include "kernel/light/light_points.h"

#define LIGHT_SAMPLE_STEP 16u /* one of so many vectors of points is sampled for the extent of a chunk */
#define SORT_CELLS 32u        /* along each axis */
#define SORT_RUNS                                                                                                      \
    4u /* of a chunk, counted in turn: neighbours share cells, and incrementing one counter repeatedly would stall */

_Static_assert(CGT_RAYS_CHUNK <= UINT16_MAX, "a chunk is counted in 16 bits");

/* Moves bits 0 to 7 to the even bits. */
CGT_SPU_INLINE vuint light_spread_bits(vuint i)
{
    i = spu_and(spu_or(i, spu_sl(i, 4)), spux_vuint(0x0f0f));
    i = spu_and(spu_or(i, spu_sl(i, 2)), spux_vuint(0x3333));
    return spu_and(spu_or(i, spu_sl(i, 1)), spux_vuint(0x5555));
}

/* Projects points as the light sees them, along two axes and in any unit. */
typedef struct light_projection {
    bool is_point;
    uint32_t main;
    float origin[3], slope[2];
    float sign; /* of the middle point's way along the main axis */
} light_projection;

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

CGT_SPU_INLINE void light_apply_projection(const light_projection *v, const vfloat point[3], vfloat coord[2])
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
CGT_SPU_INLINE void light_unfold(const light_projection *v, const vfloat point[3], vfloat coord[2])
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

/* Points k to k + CGT_LANES - 1 of a chunk; lanes beyond its end repeat the last one. */
CGT_SPU_INLINE void light_load_points(const light_call *c, uint32_t k, uint32_t count, vfloat point[3])
{
    for (int a = 0; a < 3; a++) {
        const float *org = c->source.rays->org[a];
        _Alignas(CGT_VECTOR_BYTES) float o[CGT_LANES];
        if (c->source.stride == sizeof(float) && k + CGT_LANES <= count) {
            point[a] = spux_load_unaligned(org + c->order.first + k);
            continue;
        }
        for (uint32_t i = 0; i < CGT_LANES; i++)
            o[i] = ray_element(&c->source, org, c->order.first + (k + i < count ? k + i : count - 1));
        point[a] = spux_load(o);
    }
}

typedef struct sort_work {
    _Alignas(64) float position[2][CGT_RAYS_CHUNK];
    _Alignas(64) uint32_t key[CGT_RAYS_CHUNK];
    uint16_t start[SORT_CELLS * SORT_CELLS][SORT_RUNS];
} sort_work;

/* Whether the point light has a chunk's points around it, more than one tile's axes allow for. */
static bool light_is_among(const light_call *c, const light_projection *projection, uint32_t count)
{
    vmask wide = spux_mask_none();
    for (uint32_t k = 0; k < count && projection->is_point; k += CGT_LANES) {
        const uint32_t main = projection->main;
        vfloat point[3], coord[2];
        light_load_points(c, k, count, point);
        light_apply_projection(projection, point, coord);
        const vfloat w =
            spu_mul(spu_sub(point[main], spux_vfloat(projection->origin[main])), spux_vfloat(projection->sign));
        wide = spu_or(wide, spux_not(spu_cmpgt(w, spux_vfloat(0))));
        for (int a = 0; a < 2; a++)
            wide = spu_or(wide, spu_cmpgt(spux_abs(coord[a]), spux_vfloat(LIGHT_MAX_SLOPE)));
    }
    return spux_any(wide);
}

void CGT_KERNEL(cgt_light_sort_points)(const light_call *c, uint32_t count, uint32_t from[CGT_RAYS_CHUNK])
{
    sort_work *w = cgt_scratch_take(c->counts->scratch, sizeof *w);
    float(*restrict position)[CGT_RAYS_CHUNK] = w->position;
    uint32_t *restrict key = w->key;
    uint16_t(*restrict start)[SORT_RUNS] = w->start, sum = 0;
    const uint32_t run = count / SORT_RUNS;
    const light_projection projection = light_init_projection(c, count);
    const bool among = light_is_among(c, &projection, count);
    vfloat lower[2], upper[2], scale[2];
    for (int a = 0; a < 2; a++) {
        lower[a] = spux_vfloat(INFINITY);
        upper[a] = spux_vfloat(-INFINITY);
    }
    memset(w->start, 0, sizeof w->start);
    /* project all points, and find their extent */
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vfloat point[3], coord[2];
        light_load_points(c, k, count, point);
        if (among)
            light_unfold(&projection, point, coord);
        else
            light_apply_projection(&projection, point, coord);
        for (int a = 0; a < 2; a++) {
            spux_store(position[a] + k, coord[a]);
            lower[a] = spux_min(lower[a], coord[a]);
            upper[a] = spux_max(upper[a], coord[a]);
        }
    }
    for (int a = 0; a < 2; a++) {
        const float first = spux_hmin(lower[a]), length = spux_hmax(upper[a]) - first;
        lower[a] = spux_vfloat(first);
        scale[a] = spux_vfloat(length > 0 ? SORT_CELLS / length : 0);
    }
    /* the keys: cells along the curve */
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vuint cell[2];
        for (int a = 0; a < 2; a++) {
            const vfloat coord = spu_mul(spu_sub(spux_load(position[a] + k), lower[a]), scale[a]);
            cell[a] = (vuint)spu_convts(spux_min(spux_max(coord, spux_vfloat(0)), spux_vfloat(SORT_CELLS - 1)), 0);
        }
        spux_store_uint(key + k, spu_and(spu_or(light_spread_bits(cell[0]), spu_sl(light_spread_bits(cell[1]), 1)),
                                         spux_vuint(SORT_CELLS * SORT_CELLS - 1)));
    }
    /* a counting sort: count, sum up, place */
    for (uint32_t i = 0; i < run; i++)
        for (uint32_t r = 0; r < SORT_RUNS; r++)
            start[key[r * run + i]][r]++;
    for (uint32_t k = run * SORT_RUNS; k < count; k++)
        start[key[k]][SORT_RUNS - 1]++;
    for (uint32_t k = 0; k < SORT_CELLS * SORT_CELLS; k++)
        for (uint32_t r = 0; r < SORT_RUNS; r++) {
            const uint16_t cell_count = start[k][r];
            start[k][r] = sum;
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

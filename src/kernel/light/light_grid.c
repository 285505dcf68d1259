/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against one light through a loose grid, as cameras see it tile by tile (tile_trace.c): neighbours in the arrays
 * become a tile of 64 groups, a vector of rays each. All that runs between them and the light lies in a frustum
 * (light_frustum.h), along which objects come slice by slice. A vector of objects at a time is seen from the light; each
 * object has a window of slopes (of offsets, with parallel rays) then, that tells which groups may meet it. Those are
 * tested (light_leaf.h), and leave when all their rays have met something. */
#include "kernel/light/light_groups.h"
#include "kernel/light/light_order.h"
#include "kernel/light/light_read.h"
#include "kernel/tile/tile_march.h"
#include "kernel/tile_draw/tile_triangles.h"

/* Points of larger scenes are sorted in any case. Measured: that gains 7 % with 20,000 spheres and loses 15 % with 2,000. */
#define LIGHT_SORT_MIN_PRIMS 8192u

#define LIGHT_REFRESH_TESTS                                                                                            \
    256u /* tests of groups after which slopes are found again, of those that still want something */
#define LIGHT_SAMPLE_STEP 16u /* of so many vectors of points one is looked at to tell how far they reach */

_Static_assert(LIGHT_GROUPS == LIGHT_TILE_PACKETS * LIGHT_PACKET_GROUPS, "groups fill packets");

/* ---- objects ---- */

/* Counts a vector of references of which some are wanted. */
CGT_SPU_INLINE void light_count_references(const light_tile *t, uint32_t count, unsigned visible)
{
    const uint32_t visible_count = spux_count_bits(visible);
    t->counts->references += count;
    t->counts->cull_tests += count;
    t->counts->culled += count - visible_count;
    t->counts->packet_tests += visible_count;
}

CGT_SPU_INLINE void light_count_tests(light_tile *t, uint64_t overlaps)
{
    const uint32_t groups = (uint32_t)__builtin_popcountll(overlaps);
    t->counts->ray_tests += groups * CGT_LANES;
    t->group_tests += groups;
}

/* Groups that an object's lines may meet come first, without a branch on each: most of those in its window do not. */
static void light_test_visible_spheres(light_tile *t, const sphere_block *s, const light_windows *windows,
                                       unsigned visible)
{
    light_spheres q;
    light_init_spheres(&t->packet[0], s, t->committed_scene->scale, &q);
    for (; visible; visible &= visible - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(visible);
        const uint64_t overlaps = light_overlapping_groups(t, windows->low, windows->high, windows->near_w, k);
        uint64_t reached = 0;
        light_count_tests(t, overlaps);
        for (uint64_t remaining = overlaps; remaining; remaining &= remaining - 1) {
            const uint32_t group = (uint32_t)__builtin_ctzll(remaining), i = group % LIGHT_PACKET_GROUPS * CGT_LANES;
            const light_packet *l = &t->packet[group / LIGHT_PACKET_GROUPS];
            reached |= (uint64_t)light_sphere_may_hit(l, &q, s, k, i) << group;
        }
        for (; reached; reached &= reached - 1) {
            const uint32_t group = (uint32_t)__builtin_ctzll(reached), i = group % LIGHT_PACKET_GROUPS * CGT_LANES;
            light_packet *l = &t->packet[group / LIGHT_PACKET_GROUPS];
            light_test_sphere(t->committed_scene, l, s, k, q.square[k], q.plain_rule >> k & 1, i, t->counts);
            light_update_group(t, group);
        }
    }
}

static void light_tile_test_spheres(light_tile *t, const uint32_t *reference, uint32_t count)
{
    vfloat sphere[4];
    sphere_block s;
    vuint prim;
    light_windows windows;
    tile_gather_spheres(&t->committed_scene->prims, reference, count, sphere, &prim);
    spux_store_uint(s.prim, prim);
    for (int a = 0; a < 3; a++)
        spux_store(s.center[a], sphere[a]);
    spux_store(s.radius, sphere[3]);
    const unsigned visible = light_project_spheres(t, &s, &windows) & tile_first_lanes(count);
    light_count_references(t, count, visible);
    if (visible)
        light_test_visible_spheres(t, &s, &windows, visible);
}

CGT_SPU_INLINE void light_test_visible_triangles(light_tile *t, const triangle_block *s, const light_windows *windows,
                                                 unsigned visible, bool is_point)
{
    light_triangles q;
    light_init_triangles(&t->packet[0], s, t->committed_scene->scale, is_point, &q);
    for (; visible; visible &= visible - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(visible);
        const uint64_t overlaps = light_overlapping_groups(t, windows->low, windows->high, windows->near_w, k);
        uint64_t reached = 0;
        light_count_tests(t, overlaps);
        for (uint64_t remaining = overlaps; remaining; remaining &= remaining - 1) {
            const uint32_t group = (uint32_t)__builtin_ctzll(remaining), i = group % LIGHT_PACKET_GROUPS * CGT_LANES;
            const light_packet *l = &t->packet[group / LIGHT_PACKET_GROUPS];
            reached |= (uint64_t)light_triangle_may_hit(l, &q, k, i, is_point) << group;
        }
        for (; reached; reached &= reached - 1) {
            const uint32_t group = (uint32_t)__builtin_ctzll(reached), i = group % LIGHT_PACKET_GROUPS * CGT_LANES;
            light_packet *l = &t->packet[group / LIGHT_PACKET_GROUPS];
            light_test_triangle(&t->committed_scene->prims, l, &q, k, i, s->prim[k], is_point, t->counts);
            light_update_group(t, group);
        }
    }
}

/* As leaf_triangle.c makes them. */
CGT_SPU_INLINE void light_store_leaf_triangles(vfloat vertex[3][3], float scale, triangle_block *s)
{
    vfloat first[3];
    for (int a = 0; a < 3; a++) {
        first[a] = spu_mul(vertex[0][a], spux_vfloat(scale));
        spux_store(s->vertex[a], first[a]);
    }
    for (int k = 0; k < 2; k++) {
        vfloat e[3];
        for (int a = 0; a < 3; a++) {
            e[a] = spu_sub(spu_mul(vertex[k + 1][a], spux_vfloat(scale)), first[a]);
            spux_store(s->edge[k][a], e[a]);
        }
        spux_store(s->sum[k], lane_sum(e));
    }
}

static void light_tile_test_triangles(light_tile *t, const uint32_t *reference, uint32_t count)
{
    vfloat vertex[3][3];
    triangle_block s;
    light_windows windows;
    tile_load_references(reference, count, s.prim);
    tile_gather_triangles(&t->committed_scene->prims, s.prim, vertex);
    const unsigned visible = light_project_triangles(t, vertex, &windows) & tile_first_lanes(count);
    light_count_references(t, count, visible);
    if (!visible)
        return;
    light_store_leaf_triangles(vertex, t->committed_scene->scale, &s);
    if (t->is_point)
        light_test_visible_triangles(t, &s, &windows, visible, true);
    else
        light_test_visible_triangles(t, &s, &windows, visible, false);
}

/* ---- references ---- */

/* Takes the first `count` waiting references, whole vectors but for the last one. */
static void light_drain_spheres(void *owner, uint32_t count)
{
    light_tile *t = owner;
    prefetch_queue *q = &t->pending.spheres;
    for (uint32_t k = 0; k < count && t->undecided; k += CGT_LANES)
        light_tile_test_spheres(t, q->reference + k, count - k < CGT_LANES ? count - k : CGT_LANES);
    prefetch_queue_remove(q, count);
}

/* The same, with the vertices of some vectors on their way. */
static void light_drain_triangles(void *owner, uint32_t count)
{
    light_tile *t = owner;
    prefetch_queue *q = &t->pending.triangles;
    uint32_t prefetched = 0;
    for (uint32_t k = 0; k < count && t->undecided; k += CGT_LANES) {
        prefetched = prefetch_queue_vertices(q, &t->committed_scene->prims, k, count, prefetched);
        light_tile_test_triangles(t, q->reference + k, count - k < CGT_LANES ? count - k : CGT_LANES);
    }
    prefetch_queue_remove(q, count);
}

/* Clusters: the triangles of those that the tile wants wait then. */
static void light_drain_clusters(void *owner, uint32_t count)
{
    light_tile *t = owner;
    const cgt_cluster *cluster = t->committed_scene->cluster;
    prefetch_queue *q = &t->pending.clusters;
    for (uint32_t k = 0; k < count && t->undecided; k += CGT_LANES) {
        const uint32_t lane_count = count - k < CGT_LANES ? count - k : CGT_LANES;
        light_windows windows;
        vfloat d[8];
        gather_cluster_list(cluster, q->reference + k, lane_count, d);
        unsigned remaining = light_project_boxes(t, d, d + 4, &windows) & tile_first_lanes(lane_count);
        t->counts->references += lane_count;
        t->counts->cull_tests += lane_count;
        t->counts->culled += lane_count - spux_count_bits(remaining);
        for (; remaining; remaining &= remaining - 1) {
            const uint32_t number = q->reference[k + (uint32_t)__builtin_ctz(remaining)];
            if (t->pending.triangles.count > PREFETCH_QUEUE_CAPACITY - CGT_CLUSTER)
                light_drain_triangles(t, PREFETCH_QUEUE_CAPACITY / 2);
            prefetch_append_members(&t->pending.triangles, &t->committed_scene->prims, number, cluster[number].valid);
        }
    }
    prefetch_queue_remove(q, count);
}

static const prefetch_drain_fns light_drain_fns = {light_drain_spheres, light_drain_triangles, light_drain_clusters};

/* ---- the march ---- */

/* The tile's slopes and offsets, its margin as an offset. */
static void light_march_set_slopes(const light_tile *t, tile_march *m)
{
    const double margin = (double)t->margin;
    for (int k = 0; k < 2; k++) {
        const int a = (k ? m->v : m->u) == (uint32_t)t->packet[0].axis[1] ? 0 : 1;
        const double low = (double)t->lower[a], high = (double)t->upper[a], slope = (double)t->slope[a];
        m->slope_low[k] = t->is_point ? low : slope;
        m->slope_high[k] = t->is_point ? high : slope;
        m->base_low[k] = (t->is_point ? 0 : low) - margin;
        m->base_high[k] = (t->is_point ? 0 : high) + margin;
    }
}

static void light_march_init(const light_tile *t, tile_march *m)
{
    const light_packet *l = &t->packet[0];
    m->grid = &t->committed_scene->loose;
    m->w = (uint32_t)l->axis[0];
    m->u = m->w == 0 ? 1 : 0;
    m->v = m->w == 2 ? 1 : 2;
    m->forward = l->sign > 0;
    m->brute_force = false;
    m->rspeed = 1;
    m->start_low = (t->is_point ? 0 : -(double)t->far_w) - (double)t->margin; /* rays end a little behind the light */
    m->start_high = 0;
    light_march_set_slopes(t, m);
    for (uint32_t i = 0; i < m->grid->levels; i++)
        tile_march_init_level(l->origin, m, &m->grid->level[i], &m->level[i]);
}

/* ---- the tile ---- */

/* What the packets and groups have in common. */
static void light_tile_finish(light_tile *t)
{
    light_packet *first = &t->packet[0];
    float margin = 0;
    t->undecided = 0;
    for (uint32_t k = 0; k < t->packets; k++) {
        const light_packet *l = &t->packet[k];
        margin = light_max(margin, l->margin);
        first->max_component = light_max(first->max_component, l->max_component);
        first->max_sum = light_max(first->max_sum, l->max_sum);
        first->default_ranges = first->default_ranges && l->default_ranges;
        t->undecided |= l->undecided << k * (LIGHT_PACKET_GROUPS % LIGHT_GROUPS);
    }
    t->margin = margin * (1 + LIGHT_MAX_SLOPE);
    t->changed = 0;
    for (uint32_t group = 0; group < LIGHT_GROUPS; group++)
        if (!(t->undecided >> group & 1))
            light_disable_group(t, group);
    light_compute_bounds(t);
}

/* Adds the rays of the packet that has just been read. False where they are not for this tile. */
static bool light_tile_append(light_tile *t, light_packet *l)
{
    const packet *p = &l->rays;
    if (p->extreme || !light_check_ranges(p, l))
        return false;
    const float org[3] = {p->org[0][p->lanes - 1], p->org[1][p->lanes - 1], p->org[2][p->lanes - 1]};
    const float dir[3] = {p->dir[0][p->lanes - 1], p->dir[1][p->lanes - 1], p->dir[2][p->lanes - 1]};
    if (!light_tile_init_axes(t, l, org, dir))
        return false;
    light_compute_margin(t->committed_scene, p, l);
    light_compute_terms(p, t->committed_scene->scale, l);
    return light_compute_groups(t, t->packets);
}

static void light_march_grid(light_tile *t)
{
    tile_march m;
    tile_slice s;
    light_march_init(t, &m);
    t->group_tests = 0;
    while (t->undecided && tile_march_next_slice(&m, &s)) {
        if (t->is_point && s.near_t > (double)(t->far_w + t->margin)) {
            t->counts->early_exits++;
            break;
        }
        t->counts->slices++;
        if (t->group_tests >= LIGHT_REFRESH_TESTS) {
            light_refresh_groups(t);
            light_march_set_slopes(t, &m);
        }
        const uint32_t runs = tile_slice_run_count(&m, &s);
        for (uint32_t k = 0; k < runs && t->undecided; k++) {
            uint32_t count;
            const uint32_t *reference = tile_slice_get_run(&m, &s, k, &count);
            prefetch_append_run(&t->pending, t->committed_scene, reference, count, light_drain_fns, t);
        }
    }
    light_drain_clusters(t, t->pending.clusters.count);
    light_drain_spheres(t, t->pending.spheres.count);
    light_drain_triangles(t, t->pending.triangles.count);
}

static void light_trace_tile(const light_call *c, light_tile *t, uint32_t first, uint32_t count)
{
    const cgt_rays *points = c->source.rays;
    const bool default_ranges = light_points_are_dense(c) && !points->t_min && !points->t_max;
    uint32_t from[LIGHT_TILE_PACKETS] = {0}, rays[LIGHT_TILE_PACKETS] = {0};
    t->packets = 0;
    prefetch_queues_clear(&t->pending);
    for (uint32_t done = 0; done < count && t->packets < LIGHT_TILE_PACKETS; done += PACKET_MAX_RAYS) {
        const uint32_t rays_left = count - done, ray_count = rays_left < PACKET_MAX_RAYS ? rays_left : PACKET_MAX_RAYS;
        const uint64_t invalid = c->counts->invalid_rays;
        light_packet *l = &t->packet[t->packets];
        packet *p = &l->rays;
        p->any_hit = true;
        p->fast = false;
        if (default_ranges && ray_count % CGT_LANES == 0 && light_tile_read(c, t, l, first + done, ray_count)) {
            from[t->packets] = first + done;
            rays[t->packets++] = ray_count;
            continue;
        }
        if (light_read_packet(c, first + done, ray_count, p)) {
            if (!p->rays) {
                light_store_occluded(c, p, first + done, ray_count);
                continue;
            }
            if (light_tile_append(t, l)) {
                from[t->packets] = first + done;
                rays[t->packets++] = ray_count;
                continue;
            }
        }
        c->counts->invalid_rays = invalid;
        light_trace_packet(c, first + done, ray_count, p);
    }
    if (!t->packets)
        return;
    light_tile_finish(t);
    c->counts->tiles++;
    light_march_grid(t);
    for (uint32_t k = 0; k < LIGHT_TILE_PACKETS; k++)
        light_store_occluded(c, &t->packet[k].rays, from[k], rays[k]);
}

void CGT_KERNEL(cgt_tile_trace_light)(const cgt_committed_scene *committed_scene, const cgt_rays *points,
                                      const cgt_light *light, uint64_t first, uint64_t end,
                                      const cgt_trace_settings *settings, uint8_t *occluded, cgt_counts *counts)
{
    light_tile t; /* large: not all of it is set */
    _Alignas(64) uint32_t from[CGT_RAYS_CHUNK];
    light_call c = {.committed_scene = committed_scene,
                    .source = ray_source_init(points, light),
                    .light = *light,
                    .order = {first, NULL},
                    .settings = settings,
                    .occluded = occluded,
                    .counts = counts};
    const uint32_t count = (uint32_t)(end - first);
    t.committed_scene = committed_scene;
    t.counts = counts;
    t.is_point = light->kind == CGT_LIGHT_POINT;
    counts->rays += count;
    if (committed_scene->valid >= LIGHT_SORT_MIN_PRIMS || light_is_scattered(&c, count)) {
        c.order.from = from;
        light_sort_points(&c, count, from);
    }
    for (uint32_t i = 0; i < count; i += LIGHT_TILE_RAYS)
        light_trace_tile(&c, &t, i, count - i < LIGHT_TILE_RAYS ? count - i : LIGHT_TILE_RAYS);
    light_count_hits(&c, count);
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
    for (uint32_t k = 0; k < count; k += LIGHT_SAMPLE_STEP * CGT_LANES) {
        vfloat point[3];
        light_load_points(&c, k, count, point);
        light_apply_projection(&projection, point, coord);
        for (int a = 0; a < 2; a++) {
            lower[a] = spux_min(lower[a], coord[a]);
            upper[a] = spux_max(upper[a], coord[a]);
        }
    }
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
        /* a light among the objects sees some of them behind itself */
        double scene_extent = (double)high[a] - (double)low[a];
        scene_extent = projection.is_point && !(scene_extent < 2 * (double)LIGHT_MAX_SLOPE)
                           ? 2 * (double)LIGHT_MAX_SLOPE
                           : scene_extent;
        share *= points_extent >= 0 && points_extent < scene_extent ? points_extent / scene_extent : 1;
    }
    return (uint64_t)(share * committed_scene->valid);
}

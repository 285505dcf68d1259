/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against one light through a loose grid, tile by tile as cameras go through it (tile_trace.c). Neighbours in
 * the arrays become a tile of 64 groups, a vector of rays each. Primitives come slice by slice along the frustum of the
 * tile's rays (light_packet.h). A vector of primitives at a time is projected as seen from the light: each gets a
 * window of slopes (of offsets for parallel rays), which tells the groups that it may occlude. Those are tested
 * (light_leaf.h). A group is done when all its rays have hit something. A chunk that takes too much work is given up:
 * its points or the primitives are too scattered for tiles. */
#include "kernel/light/light_capsules.h"
#include "kernel/light/light_march.h"
#include "kernel/light/light_points.h"

/* Points of scenes from this size on are always sorted. Measured: gains 7 % with 20,000 spheres, loses 15 % with
 * 2,000. */
#define LIGHT_SORT_MIN_PRIMS 8192u

#define LIGHT_REFRESH_TESTS 256u /* tests of groups after which their ranges are computed again */

_Static_assert(LIGHT_GROUPS == LIGHT_TILE_PACKETS * LIGHT_PACKET_GROUPS, "groups fill packets");

/* ---- primitives ---- */

/* Counts a vector of references, of which some are visible. */
CGT_SPU_INLINE void light_count_references(light_tile *t, uint32_t count, unsigned visible)
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

/* The visible primitives of a leaf against the groups that overlap their windows. Groups that a primitive may hit are
 * found first, without a branch on each: most in a window are not. */
CGT_SPU_INLINE void light_test_visible(light_tile *t, light_leaf *leaf, light_kind kind, const light_windows *windows,
                                       unsigned visible)
{
    light_init_leaf(&t->packet[0], t->committed_scene->scale, kind, leaf);
    for (; visible; visible &= visible - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(visible);
        const uint32_t prim = kind == LIGHT_SPHERES ? leaf->sphere->prim[k] : leaf->triangle->prim[k];
        const uint64_t overlaps = light_overlapping_groups(t, windows, k) & ~light_skipping_groups(t, prim);
        uint64_t reached = 0;
        light_count_tests(t, overlaps);
        for (uint64_t remaining = overlaps; remaining; remaining &= remaining - 1) {
            const uint32_t group = (uint32_t)__builtin_ctzll(remaining), i = group % LIGHT_PACKET_GROUPS * CGT_LANES;
            const light_packet *l = &t->packet[group / LIGHT_PACKET_GROUPS];
            reached |= (uint64_t)light_may_hit(l, leaf, kind, k, i) << group;
        }
        for (; reached; reached &= reached - 1) {
            const uint32_t group = (uint32_t)__builtin_ctzll(reached), i = group % LIGHT_PACKET_GROUPS * CGT_LANES;
            light_packet *l = &t->packet[group / LIGHT_PACKET_GROUPS];
            light_test_primitive(t->committed_scene, l, leaf, kind, k, i, t->counts);
            light_update_group(t, group);
        }
    }
}

CGT_SPU_INLINE void light_test_spheres(void *owner, const uint32_t *reference, uint32_t count, bool by_table)
{
    light_tile *t = owner;
    vfloat sphere[4];
    sphere_block s;
    light_windows windows;
    const vuint prim = load_references(reference, count);
    gather_scene_spheres(&t->committed_scene->prims, prim, sphere);
    spux_store_uint(s.prim, prim);
    for (int a = 0; a < 3; a++)
        spux_store(s.center[a], sphere[a]);
    spux_store(s.radius, sphere[3]);
    const unsigned visible = light_project_spheres(t, &s, by_table, &windows) & first_lanes(count);
    light_count_references(t, count, visible);
    if (!visible)
        return;
    light_leaf leaf;
    leaf.sphere = &s;
    light_test_visible(t, &leaf, LIGHT_SPHERES, &windows, visible);
}

/* By the arithmetic of leaf_triangle.c. */
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

CGT_SPU_INLINE void light_test_triangles(void *owner, const uint32_t *reference, uint32_t count, bool by_table)
{
    light_tile *t = owner;
    vfloat vertex[3][3];
    triangle_block s;
    light_windows windows;
    spux_store_uint(s.prim, load_references(reference, count));
    gather_scene_triangles(&t->committed_scene->prims, s.prim, vertex);
    unsigned visible = light_project_triangles(t, vertex, by_table, &windows) & first_lanes(count);
    if (__builtin_expect(t->packet[0].still && visible, 0))
        visible &= ~light_find_flat(vertex, t->packet[0].still);
    light_count_references(t, count, visible);
    if (!visible)
        return;
    light_store_leaf_triangles(vertex, t->committed_scene->scale, &s);
    light_leaf leaf;
    leaf.triangle = &s;
    if (t->is_point)
        light_test_visible(t, &leaf, LIGHT_TRIANGLES_TO_POINT, &windows, visible);
    else
        light_test_visible(t, &leaf, LIGHT_TRIANGLES_PARALLEL, &windows, visible);
}

/* Not inlined: most scenes have none. */
__attribute__((noinline)) static void light_test_capsules(light_tile *t, const uint32_t *reference, uint32_t count,
                                                          bool by_table)
{
    light_capsules s;
    light_pairs pairs;
    unsigned visible = light_project_capsules(t, reference, count, by_table, &s);
    light_count_references(t, count, visible);
    light_begin_pairs(&pairs);
    for (; visible; visible &= visible - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(visible), prim = reference[k];
        uint64_t overlaps = light_overlapping_groups(t, &s.windows, k) & ~light_skipping_groups(t, prim);
        light_count_tests(t, overlaps);
        for (; overlaps; overlaps &= overlaps - 1) {
            const uint32_t group = (uint32_t)__builtin_ctzll(overlaps);
            if (LIGHT_LANES_ARE_PAIRS)
                light_add_pairs(t, &s, k, group, reference, &pairs);
            else
                light_test_capsule(t, &s, k, group, prim);
        }
    }
    light_end_pairs(t, &s, reference, &pairs);
}

/* The visible ones of at most a vector of clusters, as bits. */
CGT_SPU_INLINE unsigned light_test_clusters(void *owner, const uint32_t *reference, uint32_t count, bool by_table)
{
    light_tile *t = owner;
    light_windows windows;
    vfloat d[8];
    gather_cluster_list(t->committed_scene->cluster, reference, count, d);
    const unsigned visible = light_project_boxes(t, d, d + 4, by_table, &windows) & first_lanes(count);
    t->counts->references += count;
    t->counts->cull_tests += count;
    t->counts->culled += count - spux_count_bits(visible);
    return visible;
}

/* What a chunk has taken: references and tests of groups take about as long, decisions some times that. Fewer lanes
 * test shorter groups, but decide no faster. */
CGT_SPU_INLINE uint64_t light_work(const cgt_counts *counts)
{
    return counts->references + counts->ray_tests / CGT_LANES +
           LIGHT_DECISION_WORK * 16 / CGT_LANES * counts->double_tests;
}

static bool light_tile_is_done(const void *owner)
{
    const light_tile *t = owner;
    return !t->undecided || light_work(t->counts) > t->max_work;
}

/* Both ways are compiled: where there is no table, as in most tiles, asking for it costs 4 % in spilled registers. */
static void light_tile_test_spheres(void *owner, const uint32_t *reference, uint32_t count)
{
    light_test_spheres(owner, reference, count, false);
}
static void light_tile_test_triangles(void *owner, const uint32_t *reference, uint32_t count)
{
    light_test_triangles(owner, reference, count, false);
}
static unsigned light_tile_test_clusters(void *owner, const uint32_t *reference, uint32_t count)
{
    return light_test_clusters(owner, reference, count, false);
}
static void light_tile_test_capsules(void *owner, const uint32_t *reference, uint32_t count)
{
    light_test_capsules(owner, reference, count, false);
}
static void light_tile_ask_spheres(void *owner, const uint32_t *reference, uint32_t count)
{
    light_test_spheres(owner, reference, count, true);
}
static void light_tile_ask_triangles(void *owner, const uint32_t *reference, uint32_t count)
{
    light_test_triangles(owner, reference, count, true);
}
static unsigned light_tile_ask_clusters(void *owner, const uint32_t *reference, uint32_t count)
{
    return light_test_clusters(owner, reference, count, true);
}
static void light_tile_ask_capsules(void *owner, const uint32_t *reference, uint32_t count)
{
    light_test_capsules(owner, reference, count, true);
}

static const prefetch_tests light_tests = {CGT_LANES,
                                           light_tile_test_spheres,
                                           light_tile_test_triangles,
                                           light_tile_test_clusters,
                                           light_tile_is_done,
                                           light_tile_test_capsules,
                                           NULL};
static const prefetch_tests light_table_tests = {CGT_LANES,
                                                 light_tile_ask_spheres,
                                                 light_tile_ask_triangles,
                                                 light_tile_ask_clusters,
                                                 light_tile_is_done,
                                                 light_tile_ask_capsules,
                                                 NULL};

/* ---- the tile ---- */

/* The bounds over all packets and groups. */
static void light_tile_finish(light_tile *t)
{
    light_packet *first = &t->packet[0];
    float margin = 0;
    t->undecided = 0;
    t->is_wide = false;
    for (uint32_t k = 0; k < t->packets; k++) {
        const light_packet *l = &t->packet[k];
        margin = light_max(margin, l->margin);
        t->is_wide = t->is_wide || l->is_wide;
        first->max_component = light_max(first->max_component, l->max_component);
        first->max_sum = light_max(first->max_sum, l->max_sum);
        first->default_ranges = first->default_ranges && l->default_ranges;
        light_find_still_axes(&t->packet[k]);
        first->still &= l->still;
        t->undecided |= l->undecided << k * (LIGHT_PACKET_GROUPS % LIGHT_GROUPS);
    }
    light_compute_size_offset(t->committed_scene, first);
    t->margin = margin * (1 + LIGHT_MAX_SLOPE);
    t->changed = 0;
    for (uint32_t group = 0; group < LIGHT_GROUPS; group++)
        if (!(t->undecided >> group & 1))
            light_disable_group(t, group);
    light_compute_bounds(t);
}

/* Adds the packet that has just been read. Returns false if the tile cannot take it. */
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
    t->table.is_set = false;
    while (!light_tile_is_done(t) && tile_march_next_slice(&m, &s)) {
        /* beyond all points? */
        if (s.near_t > (double)t->far_w + (double)t->margin - m.start_high) {
            t->counts->early_exits++;
            break;
        }
        t->counts->slices++;
        /* narrow the march to the rays that remain */
        if (t->group_tests >= LIGHT_REFRESH_TESTS) {
            light_refresh_groups(t);
            light_march_set_slopes(t, &m);
        }
        if (!t->table.is_set && light_wants_table(t))
            light_make_table(t);
        /* queue the slice's references */
        if (t->table.is_set) {
            light_append_slice(t, &m, &s, &light_table_tests);
            t->table.is_set = light_table_pays(t);
            continue;
        }
        const uint32_t runs = tile_slice_run_count(&m, &s);
        for (uint32_t k = 0; k < runs && !light_tile_is_done(t); k++) {
            uint32_t count;
            const uint32_t *reference = tile_slice_get_run(&m, &s, k, &count);
            prefetch_append_run(&t->prefetch, &light_tests, reference, count);
            t->met_references += count;
        }
        t->met_cells += (uint64_t)(s.high[0] - s.low[0] + 1) * (s.high[1] - s.low[1] + 1);
    }
    if (t->table.is_set)
        prefetch_drain_all(&t->prefetch, &light_table_tests);
    else
        prefetch_drain_all(&t->prefetch, &light_tests);
    t->given_up = t->undecided && light_work(t->counts) > t->max_work;
}

/* Traces a packet that the tile cannot take, one ray at a time if need be. If the grid has regions, packets meet far
 * too many cells: a BVH takes the chunk if it may. */
static void light_trace_apart(const light_call *c, light_tile *t, uint32_t first, uint32_t count, packet *p)
{
    t->given_up = t->max_work != UINT64_MAX && c->committed_scene->loose.regions;
    if (!t->given_up)
        light_trace_packet(c, first, count, p);
}

/* Whether the packet that has just been read is usual, but for directions that differ too much for the tile. */
CGT_SPU_INLINE bool light_packet_begins_tile(light_packet *l)
{
    return !l->rays.extreme && light_check_ranges(&l->rays, l);
}

/* Adds points first to first + count - 1 of the order: in one pass if all is usual, else step by step. Returns false if
 * the tile cannot take them: *begins says whether another one may, by axes of its own or of fewer points. */
static bool light_tile_read_packet(const light_call *c, light_tile *t, uint32_t first, uint32_t count,
                                   bool default_ranges, bool *begins)
{
    const uint64_t invalid = c->counts->invalid_rays;
    light_packet *l = &t->packet[t->packets];
    packet *p = &l->rays;
    p->any_hit = true;
    p->fast = false;
    if (default_ranges && count % CGT_LANES == 0 && CGT_KERNEL(cgt_light_tile_read)(c, t, l, first, count))
        return true;
    const bool is_read = light_read_packet(c, first, count, p);
    if (is_read && (!p->rays || light_tile_append(t, l)))
        return true;
    *begins = is_read && light_packet_begins_tile(l);
    c->counts->invalid_rays = invalid;
    return false;
}

/* Traces points first to first + count - 1 of the order, or the first of them. Returns how many; maybe none, if
 * directions differ too much for a tile and the points are not in order. */
static uint32_t light_trace_tile(const light_call *c, light_tile *t, uint32_t first, uint32_t count)
{
    const cgt_rays *points = c->source.rays;
    const bool default_ranges = light_points_are_dense(c) && !points->t_min && !points->t_max;
    uint32_t from[LIGHT_TILE_PACKETS] = {0}, rays[LIGHT_TILE_PACKETS] = {0};
    t->packets = 0;
    t->skips = false;
    t->given_up = false;
    t->prefetch = (prefetch_owner){t->committed_scene, &t->pending, t};
    prefetch_queues_clear(&t->pending);
    uint32_t done = 0, most = PACKET_MAX_RAYS;
    while (done < count && t->packets < LIGHT_TILE_PACKETS && !t->given_up && light_work(c->counts) <= t->max_work) {
        const uint32_t ray_count = count - done < most ? count - done : most;
        packet *p = &t->packet[t->packets].rays;
        bool begins;
        if (light_tile_read_packet(c, t, first + done, ray_count, default_ranges, &begins)) {
            if (p->rays) {
                light_find_skips(t, t->packets);
                from[t->packets] = first + done;
                rays[t->packets++] = ray_count;
            } else
                light_store_occluded(c, p, first + done, ray_count);
        } else {
            t->diverges = t->diverges || (begins && !t->packets);
            if (begins && (t->packets || !c->order.from))
                break;
            if (begins && ray_count > CGT_LANES) { /* on several sides of the light: fewer may share a side */
                most = (ray_count / 2 + CGT_LANES - 1) / CGT_LANES * CGT_LANES;
                continue;
            }
            light_trace_apart(c, t, first + done, ray_count, p);
        }
        done += ray_count;
    }
    t->given_up = t->given_up || light_work(c->counts) > t->max_work;
    if (t->given_up || !t->packets)
        return done;
    light_tile_finish(t);
    c->counts->tiles++;
    light_march_grid(t);
    for (uint32_t k = 0; k < LIGHT_TILE_PACKETS; k++)
        light_store_occluded(c, &t->packet[k].rays, from[k], rays[k]);
    return done;
}

bool CGT_KERNEL(cgt_tile_trace_light)(const cgt_committed_scene *committed_scene, const cgt_rays *points,
                                      const cgt_light *light, uint64_t first, uint64_t end,
                                      const cgt_trace_settings *settings, uint8_t *occluded, cgt_counts *counts)
{
    light_tile *t = cgt_scratch_take(counts->scratch, sizeof *t); /* large: set field by field */
    uint32_t *from = cgt_scratch_take(counts->scratch, CGT_RAYS_CHUNK * sizeof *from);
    light_call c = {.committed_scene = committed_scene,
                    .source = ray_source_init(points, light),
                    .light = *light,
                    .order = {first, NULL},
                    .settings = settings,
                    .occluded = occluded,
                    .counts = counts};
    const uint32_t all = (uint32_t)(end - first);
    const uint64_t invalid = counts->invalid_rays, before = light_work(counts);
    uint32_t count = all;
    if (CGT_KERNEL(cgt_light_is_enclosed)(&c, all)) {
        memset(occluded + first, 1, all);
        counts->rays += all;
        counts->hits += all;
        cgt_scratch_return(counts->scratch, t);
        return true;
    }
    t->committed_scene = committed_scene;
    t->counts = counts;
    t->is_point = light->kind == CGT_LIGHT_POINT;
    t->table_read = t->table_kept = t->met_references = t->met_cells = 0;
    /* tiles of fewer lanes share less */
    const uint64_t max_work = (uint64_t)settings->max_light_work * count * 16 / CGT_LANES;
    t->max_work = max_work ? light_work(counts) + max_work : UINT64_MAX;
    if (committed_scene->valid >= LIGHT_SORT_MIN_PRIMS || CGT_KERNEL(cgt_light_is_scattered)(&c, count)) {
        c.order.from = from;
        CGT_KERNEL(cgt_light_sort_points)(&c, count, from);
    }
    t->given_up = t->diverges = false;
    for (uint32_t i = 0; i < count && !t->given_up;) {
        i += light_trace_tile(&c, t, i, count - i < LIGHT_TILE_RAYS ? count - i : LIGHT_TILE_RAYS);
        if (!t->diverges || c.order.from || i == count)
            continue;
        /* points on several sides of the light: the others side by side as it sees them */
        c.order.first += i;
        count -= i;
        i = 0;
        CGT_KERNEL(cgt_light_sort_points)(&c, count, from);
        c.order.from = from;
    }
    c.order.first = first;
    counts->light_work += light_work(counts) - before;
    if (t->given_up) {
        counts->invalid_rays = invalid;
        cgt_scratch_return(counts->scratch, t);
        return false;
    }
    counts->rays += all;
    light_count_hits(&c, all);
    cgt_scratch_return(counts->scratch, t);
    return true;
}

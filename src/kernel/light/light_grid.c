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
#define SORT_OBJECTS 8192u

#define REFRESH 256u /* tests of groups after which slopes are found again, of those that still want something */
#define SAMPLE 16u   /* of so many vectors of points one is looked at to tell how far they reach */

_Static_assert(GROUPS == PACKETS * PACKET_GROUPS, "groups fill packets");

/* ---- objects ---- */

/* Counts a vector of references of which some are wanted. */
CGT_SPU_INLINE void count_taken(const light_tile *t, uint32_t count, unsigned wanted)
{
    const uint32_t some = spux_count_bits(wanted);
    t->counts->references += count;
    t->counts->cull_tests += count;
    t->counts->culled += count - some;
    t->counts->packet_tests += some;
}

CGT_SPU_INLINE void count_tested(light_tile *t, uint64_t met)
{
    const uint32_t groups = (uint32_t)__builtin_popcountll(met);
    t->counts->ray_tests += groups * CGT_LANES;
    t->tested += groups;
}

/* Groups that an object's lines may meet come first, without a branch on each: most of those in its window do not. */
static void draw_spheres(light_tile *t, const wide_spheres *s, const light_windows *windows, unsigned wanted)
{
    light_spheres q;
    light_spheres_make(&t->packet[0], s, t->world->scale, &q);
    for (; wanted; wanted &= wanted - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(wanted);
        const uint64_t met = groups_met(t, windows->low, windows->high, windows->near, k);
        uint64_t reached = 0;
        count_tested(t, met);
        for (uint64_t left = met; left; left &= left - 1) {
            const uint32_t group = (uint32_t)__builtin_ctzll(left), i = group % PACKET_GROUPS * CGT_LANES;
            const light_packet *l = &t->packet[group / PACKET_GROUPS];
            reached |= (uint64_t)light_sphere_reached(l, &q, s, k, i) << group;
        }
        for (; reached; reached &= reached - 1) {
            const uint32_t group = (uint32_t)__builtin_ctzll(reached), i = group % PACKET_GROUPS * CGT_LANES;
            light_packet *l = &t->packet[group / PACKET_GROUPS];
            light_sphere_vector(t->world, l, s, k, q.square[k], q.simple >> k & 1, i, t->counts);
            settle(t, group);
        }
    }
}

static void take_spheres(light_tile *t, const uint32_t *reference, uint32_t count)
{
    vfloat sphere[4];
    wide_spheres s;
    vuint object;
    light_windows windows;
    tile_spheres_fetch(&t->world->objects, reference, count, sphere, &object);
    spux_store_uint(s.object, object);
    for (int a = 0; a < 3; a++)
        spux_store(s.center[a], sphere[a]);
    spux_store(s.radius, sphere[3]);
    const unsigned wanted = see_spheres(t, &s, &windows) & tile_first_lanes(count);
    count_taken(t, count, wanted);
    if (wanted)
        draw_spheres(t, &s, &windows, wanted);
}

CGT_SPU_INLINE void draw_triangles(light_tile *t, const wide_triangles *s, const light_windows *windows,
                                   unsigned wanted, bool place)
{
    light_triangles q;
    light_triangles_make(&t->packet[0], s, t->world->scale, place, &q);
    for (; wanted; wanted &= wanted - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(wanted);
        const uint64_t met = groups_met(t, windows->low, windows->high, windows->near, k);
        uint64_t reached = 0;
        count_tested(t, met);
        for (uint64_t left = met; left; left &= left - 1) {
            const uint32_t group = (uint32_t)__builtin_ctzll(left), i = group % PACKET_GROUPS * CGT_LANES;
            const light_packet *l = &t->packet[group / PACKET_GROUPS];
            reached |= (uint64_t)light_triangle_reached(l, &q, k, i, place) << group;
        }
        for (; reached; reached &= reached - 1) {
            const uint32_t group = (uint32_t)__builtin_ctzll(reached), i = group % PACKET_GROUPS * CGT_LANES;
            light_packet *l = &t->packet[group / PACKET_GROUPS];
            light_triangle_vector(&t->world->objects, l, &q, k, i, s->object[k], place, t->counts);
            settle(t, group);
        }
    }
}

/* As leaf_triangle.c makes them. */
CGT_SPU_INLINE void leaf_of_triangles(vfloat vertex[3][3], float scale, wide_triangles *s)
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

static void take_triangles(light_tile *t, const uint32_t *reference, uint32_t count)
{
    vfloat vertex[3][3];
    wide_triangles s;
    light_windows windows;
    tile_triangles_objects(reference, count, s.object);
    tile_triangles_fetch(&t->world->objects, s.object, vertex);
    const unsigned wanted = see_triangles(t, vertex, &windows) & tile_first_lanes(count);
    count_taken(t, count, wanted);
    if (!wanted)
        return;
    leaf_of_triangles(vertex, t->world->scale, &s);
    if (t->place)
        draw_triangles(t, &s, &windows, wanted, true);
    else
        draw_triangles(t, &s, &windows, wanted, false);
}

/* ---- references ---- */

/* Takes the first `count` waiting references, whole vectors but for the last one. */
static void take_waiting_spheres(void *owner, uint32_t count)
{
    light_tile *t = owner;
    waiting *q = &t->waits.spheres;
    for (uint32_t k = 0; k < count && t->open; k += CGT_LANES)
        take_spheres(t, q->reference + k, count - k < CGT_LANES ? count - k : CGT_LANES);
    waiting_remove(q, count);
}

/* The same, with the vertices of some vectors on their way. */
static void take_waiting_triangles(void *owner, uint32_t count)
{
    light_tile *t = owner;
    waiting *q = &t->waits.triangles;
    uint32_t asked = 0;
    for (uint32_t k = 0; k < count && t->open; k += CGT_LANES) {
        asked = waiting_ask(q, &t->world->objects, k, count, asked);
        take_triangles(t, q->reference + k, count - k < CGT_LANES ? count - k : CGT_LANES);
    }
    waiting_remove(q, count);
}

/* Clusters: the triangles of those that the tile wants wait then. */
static void take_waiting_clusters(void *owner, uint32_t count)
{
    light_tile *t = owner;
    const cgt_cluster *cluster = t->world->cluster;
    waiting *q = &t->waits.clusters;
    for (uint32_t k = 0; k < count && t->open; k += CGT_LANES) {
        const uint32_t some = count - k < CGT_LANES ? count - k : CGT_LANES;
        light_windows windows;
        vfloat d[8];
        fetch_clusters_of(cluster, q->reference + k, some, d);
        unsigned left = see_boxes(t, d, d + 4, &windows) & tile_first_lanes(some);
        t->counts->references += some;
        t->counts->cull_tests += some;
        t->counts->culled += some - spux_count_bits(left);
        for (; left; left &= left - 1) {
            const uint32_t number = q->reference[k + (uint32_t)__builtin_ctz(left)];
            if (t->waits.triangles.count > WAITING - CGT_CLUSTER)
                take_waiting_triangles(t, WAITING / 2);
            waiting_add_cluster(&t->waits.triangles, &t->world->objects, number, cluster[number].valid);
        }
    }
    waiting_remove(q, count);
}

static const waiting_takers takers = {take_waiting_spheres, take_waiting_triangles, take_waiting_clusters};

/* ---- the march ---- */

/* The tile's slopes and offsets, its margin as an offset. */
static void march_slopes(const light_tile *t, tile_march *m)
{
    const double margin = (double)t->margin;
    for (int k = 0; k < 2; k++) {
        const int a = (k ? m->v : m->u) == (uint32_t)t->packet[0].axis[1] ? 0 : 1;
        const double low = (double)t->least[a], high = (double)t->most[a], slope = (double)t->slope[a];
        m->slope_low[k] = t->place ? low : slope;
        m->slope_high[k] = t->place ? high : slope;
        m->base_low[k] = (t->place ? 0 : low) - margin;
        m->base_high[k] = (t->place ? 0 : high) + margin;
    }
}

static void march_make(const light_tile *t, tile_march *m)
{
    const light_packet *l = &t->packet[0];
    m->grid = &t->world->loose;
    m->w = (uint32_t)l->axis[0];
    m->u = m->w == 0 ? 1 : 0;
    m->v = m->w == 2 ? 1 : 2;
    m->forward = l->sign > 0;
    m->everything = false;
    m->rspeed = 1;
    m->start_low = (t->place ? 0 : -(double)t->far) - (double)t->margin; /* rays end a little behind the light */
    m->start_high = 0;
    march_slopes(t, m);
    for (uint32_t i = 0; i < m->grid->levels; i++)
        tile_march_level_make(l->reference, m, &m->grid->level[i], &m->level[i]);
}

/* ---- the tile ---- */

/* What the packets and groups have in common. */
static void tile_finish(light_tile *t)
{
    light_packet *first = &t->packet[0];
    float margin = 0;
    t->open = 0;
    for (uint32_t k = 0; k < t->packets; k++) {
        const light_packet *l = &t->packet[k];
        margin = larger(margin, l->margin);
        first->longest = larger(first->longest, l->longest);
        first->farthest = larger(first->farthest, l->farthest);
        first->plain = first->plain && l->plain;
        t->open |= l->open << k * (PACKET_GROUPS % GROUPS);
    }
    t->margin = margin * (1 + LIGHT_STEEPEST);
    t->changed = 0;
    for (uint32_t group = 0; group < GROUPS; group++)
        if (!(t->open >> group & 1))
            close_group(t, group);
    tile_bounds_make(t);
}

/* Adds the rays of the packet that has just been read. False where they are not for this tile. */
static bool tile_add(light_tile *t, light_packet *l)
{
    const packet *p = &l->rays;
    if (p->extreme || !light_ranges_fit(p, l))
        return false;
    const float org[3] = {p->org[0][p->lanes - 1], p->org[1][p->lanes - 1], p->org[2][p->lanes - 1]};
    const float dir[3] = {p->dir[0][p->lanes - 1], p->dir[1][p->lanes - 1], p->dir[2][p->lanes - 1]};
    if (!tile_orient(t, l, org, dir))
        return false;
    light_margin(t->world, p, l);
    light_ways(p, t->world->scale, l);
    return tile_groups(t, t->packets);
}

static void march(light_tile *t)
{
    tile_march m;
    tile_slice s;
    march_make(t, &m);
    t->tested = 0;
    while (t->open && tile_march_next(&m, &s)) {
        if (t->place && s.near_t > (double)(t->far + t->margin)) {
            t->counts->early_exits++;
            break;
        }
        t->counts->slices++;
        if (t->tested >= REFRESH) {
            tile_refresh(t);
            march_slopes(t, &m);
        }
        const uint32_t runs = tile_slice_runs(&m, &s);
        for (uint32_t k = 0; k < runs && t->open; k++) {
            uint32_t count;
            const uint32_t *reference = tile_slice_run(&m, &s, k, &count);
            waiting_run(&t->waits, t->world, reference, count, takers, t);
        }
    }
    take_waiting_clusters(t, t->waits.clusters.count);
    take_waiting_spheres(t, t->waits.spheres.count);
    take_waiting_triangles(t, t->waits.triangles.count);
}

static void trace_tile(const light_call *c, light_tile *t, uint32_t first, uint32_t count)
{
    const cgt_rays *points = c->source.rays;
    const bool plain = light_points_dense(c) && !points->t_min && !points->t_max;
    uint32_t from[PACKETS] = {0}, rays[PACKETS] = {0};
    t->packets = 0;
    waiting_clear(&t->waits);
    for (uint32_t done = 0; done < count && t->packets < PACKETS; done += PACKET_MAX_RAYS) {
        const uint32_t left = count - done, some = left < PACKET_MAX_RAYS ? left : PACKET_MAX_RAYS;
        const uint64_t invalid = c->counts->invalid_rays;
        light_packet *l = &t->packet[t->packets];
        packet *p = &l->rays;
        p->any_hit = true;
        p->fast = false;
        if (plain && some % CGT_LANES == 0 && tile_read(c, t, l, first + done, some)) {
            from[t->packets] = first + done;
            rays[t->packets++] = some;
            continue;
        }
        if (light_points_read(c, first + done, some, p)) {
            if (!p->rays) {
                light_hand_out(c, p, first + done, some);
                continue;
            }
            if (tile_add(t, l)) {
                from[t->packets] = first + done;
                rays[t->packets++] = some;
                continue;
            }
        }
        c->counts->invalid_rays = invalid;
        light_trace_packet(c, first + done, some, p);
    }
    if (!t->packets)
        return;
    tile_finish(t);
    c->counts->tiles++;
    march(t);
    for (uint32_t k = 0; k < PACKETS; k++)
        light_hand_out(c, &t->packet[k].rays, from[k], rays[k]);
}

void CGT_KERNEL(cgt_tile_trace_light)(const cgt_world *world, const cgt_rays *points, const cgt_light *light,
                                      uint64_t first, uint64_t end, const cgt_trace_settings *settings,
                                      uint8_t *occluded, cgt_counts *counts)
{
    light_tile t; /* large: not all of it is set */
    _Alignas(64) uint32_t from[CGT_RAYS_CHUNK];
    light_call c = {.world = world,
                    .source = ray_source_make(points, light),
                    .light = *light,
                    .order = {first, NULL},
                    .settings = settings,
                    .occluded = occluded,
                    .counts = counts};
    const uint32_t count = (uint32_t)(end - first);
    t.world = world;
    t.counts = counts;
    t.place = light->w == 1;
    counts->rays += count;
    if (world->valid >= SORT_OBJECTS || is_scattered(&c, count)) {
        c.order.from = from;
        sort_points(&c, count, from);
    }
    for (uint32_t i = 0; i < count; i += TILE_RAYS)
        trace_tile(&c, &t, i, count - i < TILE_RAYS ? count - i : TILE_RAYS);
    light_count_hits(&c, count);
}

uint64_t CGT_KERNEL(cgt_tile_light_objects)(const cgt_world *world, const cgt_rays *points, const cgt_light *light,
                                            uint64_t first, uint64_t end)
{
    const light_call c = {
        .world = world, .source = ray_source_make(points, light), .light = *light, .order = {first, NULL}};
    const uint32_t count = (uint32_t)(end - first);
    if (!light_is_near(&c))
        return UINT32_MAX;
    const light_view view = view_make(&c, count);
    vfloat least[2], most[2], corner[3], at[2];
    double share = 1;
    for (int a = 0; a < 2; a++) {
        least[a] = spux_vfloat(INFINITY);
        most[a] = spux_vfloat(-INFINITY);
    }
    for (uint32_t k = 0; k < count; k += SAMPLE * CGT_LANES) {
        vfloat point[3];
        chunk_load(&c, k, count, point);
        view_see(&view, point, at);
        for (int a = 0; a < 2; a++) {
            least[a] = spux_min(least[a], at[a]);
            most[a] = spux_max(most[a], at[a]);
        }
    }
    float low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (uint32_t k = 0; k < 8; k++) {
        for (int a = 0; a < 3; a++)
            corner[a] = spux_vfloat(k >> a & 1 ? world->high[a] : world->low[a]);
        view_see(&view, corner, at);
        for (int a = 0; a < 2; a++) {
            low[a] = at[a][0] < low[a] ? at[a][0] : low[a];
            high[a] = larger(high[a], at[a][0]);
        }
    }
    for (int a = 0; a < 2; a++) {
        const double of_points = (double)spux_hmax(most[a]) - (double)spux_hmin(least[a]);
        /* a light among the objects sees some of them behind itself */
        double of_world = (double)high[a] - (double)low[a];
        of_world = view.place && !(of_world < 2 * (double)LIGHT_STEEPEST) ? 2 * (double)LIGHT_STEEPEST : of_world;
        share *= of_points >= 0 && of_points < of_world ? of_points / of_world : 1;
    }
    return (uint64_t)(share * world->valid);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against one light through a loose grid, as cameras see it tile by tile (tile_trace.c): neighbours in the arrays
 * become a tile of 64 groups, a vector of rays each. All that runs between them and the light lies in a frustum
 * (light_frustum.h), along which objects come slice by slice. A vector of objects at a time is seen from the light; each
 * object has a window of slopes (of offsets, with parallel rays) then, that tells which groups may meet it. Those are
 * tested (light_leaf.h), and leave when all their rays have met something.
 *
 * A window holds whatever a ray may meet: all numbers are widened by the frustum's margin, which is a share of 2^-17 of
 * the largest, where divisions here are within 2^-20. An object that reaches behind the light has no bounds in slopes: its
 * window is everything. */
#include "light_leaf.h"
#include "light_points.h"
#include "tile_march.h"
#include "tile_triangles.h"

#define GROUPS 64u
#define TILE_RAYS (GROUPS * CGT_LANES)
#define PACKETS (TILE_RAYS / PACKET_MAX_RAYS)
#define PACKET_GROUPS (PACKET_MAX_RAYS / CGT_LANES)

/* Points of larger scenes are sorted in any case. Measured: that gains 7 % with 20,000 spheres and loses 15 % with 2,000. */
#define SORT_OBJECTS 8192u
#define SORT_CELLS 64u /* along an edge of what the light sees of a chunk */

#define REFRESH 256u /* tests of groups after which slopes are found again, of those that still want something */
#define WAITING 256u /* references that wait until what they stand for has come to the cache */
#define AHEAD 64u    /* references whose vertices are on their way */

_Static_assert(PACKETS *PACKET_GROUPS == GROUPS, "groups fill packets");

typedef struct waiting {
    uint32_t reference[WAITING];
    uint32_t count;
} waiting;

/* A tile. Of each group the least and the most slope along both axes, or offset; and w of its ray that is farthest from the
 * light, or the least one with its sign reversed where rays are parallel, so that what an object is compared with is its
 * end nearer to the light either way. A group that wants nothing any more has no slopes: infinity is their least. */
typedef struct light_tile {
    _Alignas(64) float low[2][GROUPS];
    float high[2][GROUPS], end[GROUPS];
    light_packet packet[PACKETS];
    uint32_t packets;
    uint64_t open;                /* groups as bits */
    uint64_t changed;             /* groups some of whose rays have met something since their slopes were found */
    uint32_t tested;              /* groups, since the slopes of all were found */
    float slope[2];               /* of parallel rays */
    float margin;                 /* of lines, so far apart from the numbers here along any axis */
    float least[2], most[2], far; /* of `low`, `high` and `end` */
    const cgt_world *world;
    cgt_counts *counts;
    bool place;
    waiting spheres, triangles;
} light_tile;

/* ---- objects ---- */

/* Groups whose slopes meet a window, as bits. */
CGT_SPU_INLINE uint64_t groups_met(const light_tile *t, const float low[2][CGT_LANES], const float high[2][CGT_LANES],
                                   const float near[CGT_LANES], uint32_t k)
{
    uint64_t met = 0;
    for (uint32_t g = 0; g < GROUPS; g += CGT_LANES) {
        vmask in = spux_cmpge(spux_load(t->end + g), spux_vfloat(near[k]));
        for (int a = 0; a < 2; a++) {
            in = spu_and(in, spux_cmpge(spux_vfloat(high[a][k]), spux_load(t->low[a] + g)));
            in = spu_and(in, spux_cmpge(spux_load(t->high[a] + g), spux_vfloat(low[a][k])));
        }
        met |= (uint64_t)spux_mask_bits(in) << g;
    }
    return met & t->open;
}

/* Groups without rays. */
CGT_SPU_INLINE void close_group(light_tile *t, uint32_t group)
{
    for (int a = 0; a < 2; a++) {
        t->low[a][group] = INFINITY;
        t->high[a][group] = -INFINITY;
    }
    t->end[group] = -INFINITY;
    t->open &= ~((uint64_t)1 << group);
}

/* After a test that may have closed rays of a group. */
CGT_SPU_INLINE void settle(light_tile *t, uint32_t group)
{
    t->changed |= (uint64_t)1 << group;
    if (!(t->packet[group / PACKET_GROUPS].open >> group % PACKET_GROUPS & 1))
        close_group(t, group);
}

/* Windows of a vector of objects. */
typedef struct light_windows {
    _Alignas(CGT_VECTOR_BYTES) float low[2][CGT_LANES], high[2][CGT_LANES];
    float near[CGT_LANES]; /* the end nearer to the light */
} light_windows;

/* Objects of which the tile may want something, as bits. near, far: their ends along w. */
CGT_SPU_INLINE unsigned windows_wanted(const light_tile *t, const vfloat low[2], const vfloat high[2], vfloat near,
                                       vfloat far, light_windows *w)
{
    const vfloat end = t->place ? near : spu_xor(far, spux_vfloat(-0.f)), zero = spux_vfloat(0);
    vmask out = spu_cmpgt(end, spux_vfloat(t->far));
    if (t->place)
        out = spu_or(out, spu_cmpgt(zero, far));
    const vmask front = t->place ? spu_cmpgt(near, zero) : spux_mask_all();
    for (int a = 0; a < 2; a++) {
        const vfloat l = spux_select(spux_vfloat(-INFINITY), low[a], front);
        const vfloat h = spux_select(spux_vfloat(INFINITY), high[a], front);
        out = spu_or(out, spu_or(spu_cmpgt(l, spux_vfloat(t->most[a])), spu_cmpgt(spux_vfloat(t->least[a]), h)));
        spux_store(w->low[a], l);
        spux_store(w->high[a], h);
    }
    spux_store(w->near, end);
    return ~spux_mask_bits(out) & CGT_ALL_LANES;
}

/* A point as the light sees it. */
CGT_SPU_INLINE void see_point(const light_packet *l, const vfloat point[3], vfloat *w, vfloat v[2])
{
    const int main = l->axis[0];
    *w = spu_mul(spu_sub(point[main], spux_vfloat(l->reference[main])), spux_vfloat(l->sign));
    for (int a = 0; a < 2; a++)
        v[a] = spu_sub(point[l->axis[a + 1]], spux_vfloat(l->reference[l->axis[a + 1]]));
}

CGT_SPU_INLINE unsigned see_spheres(const light_tile *t, const wide_spheres *s, light_windows *windows)
{
    const vfloat center[3] = {spux_load(s->center[0]), spux_load(s->center[1]), spux_load(s->center[2])};
    vfloat w, v[2], low[2], high[2];
    see_point(&t->packet[0], center, &w, v);
    const vfloat wide = spu_madd(spux_load(s->radius), spux_vfloat(1 + 0x1p-20f), spux_vfloat(t->margin));
    const vfloat near = spu_sub(w, wide), far = spu_add(w, wide), one = spux_vfloat(1);
    const vfloat rnear = spux_div(one, near), rfar = spux_div(one, far);
    for (int a = 0; a < 2; a++) {
        if (t->place) {
            const vfloat least = spu_sub(v[a], wide), most = spu_add(v[a], wide);
            low[a] = spux_min(spu_mul(least, rnear), spu_mul(least, rfar));
            high[a] = spux_max(spu_mul(most, rnear), spu_mul(most, rfar));
        } else {
            const vfloat middle = spu_nmsub(spux_vfloat(t->slope[a]), w, v[a]);
            const vfloat beside = spu_mul(wide, spux_vfloat(1 + fabsf(t->slope[a])));
            low[a] = spu_sub(middle, beside);
            high[a] = spu_add(middle, beside);
        }
    }
    return windows_wanted(t, low, high, near, far, windows);
}

CGT_SPU_INLINE unsigned see_triangles(const light_tile *t, vfloat vertex[3][3], light_windows *windows)
{
    const vfloat margin = spux_vfloat(t->margin);
    vfloat w[3], v[3][2], low[2], high[2];
    for (int k = 0; k < 3; k++)
        see_point(&t->packet[0], vertex[k], &w[k], v[k]);
    const vfloat near = spu_sub(spux_min(w[0], spux_min(w[1], w[2])), margin);
    const vfloat far = spu_add(spux_max(w[0], spux_max(w[1], w[2])), margin);
    vfloat scale[3], beside = margin; /* what a margin comes to in slopes, but for their own size */
    for (int k = 0; k < 3; k++)
        scale[k] = t->place ? spux_div(spux_vfloat(1), w[k]) : spux_vfloat(1);
    if (t->place)
        beside = spux_div(spux_vfloat(2 * t->margin), near);
    for (int a = 0; a < 2; a++) {
        vfloat at[3];
        for (int k = 0; k < 3; k++)
            at[k] = t->place ? spu_mul(v[k][a], scale[k]) : spu_nmsub(spux_vfloat(t->slope[a]), w[k], v[k][a]);
        const vfloat least = spux_min(at[0], spux_min(at[1], at[2])), most = spux_max(at[0], spux_max(at[1], at[2]));
        const vfloat size = spux_max(spux_abs(least), spux_abs(most));
        const vfloat wide =
            t->place ? spu_madd(beside, size, beside) : spu_mul(margin, spux_vfloat(1 + fabsf(t->slope[a])));
        low[a] = spu_sub(least, wide);
        high[a] = spu_add(most, wide);
    }
    return windows_wanted(t, low, high, near, far, windows);
}

/* Counts a vector of references of which some are wanted. */
CGT_SPU_INLINE void count_taken(const light_tile *t, uint32_t count, unsigned wanted)
{
    const uint32_t some = spux_count_bits(wanted);
    t->counts->references += count;
    t->counts->cull_tests += count;
    t->counts->culled += count - some;
    t->counts->packet_tests += some;
}

CGT_SPU_INLINE unsigned first_lanes(uint32_t count) { return count < CGT_LANES ? (1u << count) - 1 : CGT_ALL_LANES; }

CGT_SPU_INLINE void draw_spheres(light_tile *t, const wide_spheres *s, const light_windows *windows, unsigned wanted,
                                 bool place)
{
    light_spheres q;
    light_spheres_make(&t->packet[0], s, t->world->scale, place, &q);
    for (; wanted; wanted &= wanted - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(wanted);
        for (uint64_t met = groups_met(t, windows->low, windows->high, windows->near, k); met; met &= met - 1) {
            const uint32_t group = (uint32_t)__builtin_ctzll(met), i = group % PACKET_GROUPS * CGT_LANES;
            light_packet *l = &t->packet[group / PACKET_GROUPS];
            t->counts->ray_tests += CGT_LANES;
            t->tested++;
            if (!light_sphere_reached(l, &q, s, k, i, place))
                continue;
            light_sphere_vector(t->world, l, s, k, q.square[k], q.simple >> k & 1, i, t->counts);
            settle(t, group);
        }
    }
}

static void take_spheres(light_tile *t, const uint32_t *reference, uint32_t count)
{
    vfloat sphere[4];
    wide_spheres s;
    light_windows windows;
    tile_spheres_fetch(&t->world->objects, reference, count, sphere, s.object);
    for (int a = 0; a < 3; a++)
        spux_store(s.center[a], sphere[a]);
    spux_store(s.radius, sphere[3]);
    const unsigned wanted = see_spheres(t, &s, &windows) & first_lanes(count);
    count_taken(t, count, wanted);
    if (!wanted)
        return;
    if (t->place)
        draw_spheres(t, &s, &windows, wanted, true);
    else
        draw_spheres(t, &s, &windows, wanted, false);
}

CGT_SPU_INLINE void draw_triangles(light_tile *t, const wide_triangles *s, const light_windows *windows,
                                   unsigned wanted, bool place)
{
    light_triangles q;
    light_triangles_make(&t->packet[0], s, t->world->scale, place, &q);
    for (; wanted; wanted &= wanted - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(wanted);
        for (uint64_t met = groups_met(t, windows->low, windows->high, windows->near, k); met; met &= met - 1) {
            const uint32_t group = (uint32_t)__builtin_ctzll(met), i = group % PACKET_GROUPS * CGT_LANES;
            light_packet *l = &t->packet[group / PACKET_GROUPS];
            t->counts->ray_tests += CGT_LANES;
            t->tested++;
            if (!light_triangle_reached(l, &q, k, i, place))
                continue;
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
    const unsigned wanted = see_triangles(t, vertex, &windows) & first_lanes(count);
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
static void take_waiting_spheres(light_tile *t, uint32_t count)
{
    waiting *q = &t->spheres;
    for (uint32_t k = 0; k < count && t->open; k += CGT_LANES)
        take_spheres(t, q->reference + k, count - k < CGT_LANES ? count - k : CGT_LANES);
    q->count -= count;
    memmove(q->reference, q->reference + count, q->count * sizeof *q->reference);
}

/* The same, with the vertices of some vectors on their way. */
static void take_waiting_triangles(light_tile *t, uint32_t count)
{
    waiting *q = &t->triangles;
    const cgt_objects *objects = &t->world->objects;
    const cgt_object_array *a = objects->arrays == 1 && objects->array->index ? objects->array : NULL;
    uint32_t asked = 0;
    for (uint32_t k = 0; k < count && t->open; k += CGT_LANES) {
        const uint32_t ask = k + AHEAD < count ? k + AHEAD : count;
        if (a && ask > asked)
            fetch_triangles_ask(a, q->reference + asked, ask - asked);
        asked = ask;
        take_triangles(t, q->reference + k, count - k < CGT_LANES ? count - k : CGT_LANES);
    }
    q->count -= count;
    memmove(q->reference, q->reference + count, q->count * sizeof *q->reference);
}

CGT_SPU_INLINE void wait_sphere(light_tile *t, uint32_t reference)
{
    const cgt_objects *o = &t->world->objects;
    waiting *q = &t->spheres;
    q->reference[q->count++] = reference;
    if (o->arrays == 1)
        __builtin_prefetch(cgt_array_point(o->array, reference));
    if (q->count == WAITING)
        take_waiting_spheres(t, WAITING / 2);
}

CGT_SPU_INLINE void wait_triangle(light_tile *t, uint32_t reference)
{
    const cgt_object_array *a = t->world->objects.array;
    waiting *q = &t->triangles;
    q->reference[q->count++] = reference;
    if (t->world->objects.arrays == 1 && a->index)
        __builtin_prefetch(a->index + (size_t)reference * a->index_stride);
    if (q->count == WAITING)
        take_waiting_triangles(t, WAITING / 2);
}

static void wait_run(light_tile *t, const uint32_t *reference, uint32_t count)
{
    const cgt_objects *o = &t->world->objects;
    for (uint32_t k = 0; k < count; k++)
        if (!o->triangles || (o->spheres && cgt_objects_array(o, reference[k])->kind == CGT_KIND_SPHERES))
            wait_sphere(t, reference[k]);
        else
            wait_triangle(t, reference[k]);
}

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

/* Slopes of a group, of the rays that have met nothing. Returns the lanes that have too many. */
CGT_SPU_INLINE vmask group_find(light_tile *t, uint32_t group)
{
    const light_packet *l = &t->packet[group / PACKET_GROUPS];
    const packet *p = &l->rays;
    const uint32_t i = group % PACKET_GROUPS * CGT_LANES;
    const vmask open = spu_cmpgt(spux_load(p->high + i), spux_vfloat(-INFINITY));
    const vfloat none = spux_vfloat(INFINITY), minus = spux_vfloat(-INFINITY);
    vmask wild = spux_mask_none();
    vfloat org[3], w, v[2];
    for (int a = 0; a < 3; a++)
        org[a] = spux_load(p->org[a] + i);
    see_point(l, org, &w, v);
    if (t->place)
        wild = spux_not(spu_cmpgt(w, spux_vfloat(0)));
    for (int a = 0; a < 2; a++) {
        const vfloat at = t->place ? spux_div(v[a], w) : spu_nmsub(spux_vfloat(t->slope[a]), w, v[a]);
        if (t->place)
            wild = spu_or(wild, spux_not(spu_cmpgt(spux_vfloat(LIGHT_STEEPEST), spux_abs(at))));
        t->low[a][group] = spux_hmin(spux_select(none, at, open));
        t->high[a][group] = spux_hmax(spux_select(minus, at, open));
    }
    t->end[group] = t->place ? spux_hmax(spux_select(minus, w, open)) : -spux_hmin(spux_select(none, w, open));
    return wild;
}

/* The groups of a packet. False where rays leave too many directions to the light. */
static bool tile_groups(light_tile *t, uint32_t number)
{
    vmask wild = spux_mask_none();
    for (uint32_t i = 0; i < t->packet[number].rays.lanes; i += CGT_LANES)
        wild = spu_or(wild, group_find(t, number * PACKET_GROUPS + i / CGT_LANES));
    return spux_none(wild);
}

/* What all groups have in common. */
static void tile_bounds_make(light_tile *t)
{
    vfloat far = spux_vfloat(-INFINITY);
    for (uint32_t g = 0; g < GROUPS; g += CGT_LANES)
        far = spux_max(far, spux_load(t->end + g));
    t->far = spux_hmax(far);
    for (int a = 0; a < 2; a++) {
        vfloat least = spux_vfloat(INFINITY), most = spux_vfloat(-INFINITY);
        for (uint32_t g = 0; g < GROUPS; g += CGT_LANES) {
            least = spux_min(least, spux_load(t->low[a] + g));
            most = spux_max(most, spux_load(t->high[a] + g));
        }
        t->least[a] = spux_hmin(least);
        t->most[a] = spux_hmax(most);
    }
}

/* Slopes of those rays alone that still want something. */
static void tile_refresh(light_tile *t)
{
    for (uint64_t left = t->changed & t->open; left; left &= left - 1)
        group_find(t, (uint32_t)__builtin_ctzll(left));
    t->changed = 0;
    t->tested = 0;
    tile_bounds_make(t);
}

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
    const light_packet *first = &t->packet[0];
    const packet *p = &l->rays;
    if (p->extreme || !light_ranges_fit(p, l))
        return false;
    if (!t->packets) {
        if (!light_orient(p, l))
            return false;
        for (int a = 0; a < 2; a++)
            t->slope[a] = t->place ? 0 : p->dir[l->axis[a + 1]][0] / (l->sign * p->dir[l->axis[0]][0]);
    } else {
        for (int a = 0; a < 3; a++) {
            l->axis[a] = first->axis[a];
            l->reference[a] = first->reference[a];
        }
        l->sign = first->sign;
    }
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
            wait_run(t, reference, count);
        }
    }
    take_waiting_spheres(t, t->spheres.count);
    take_waiting_triangles(t, t->triangles.count);
}

static void hand_out(const light_call *c, const packet *p, uint32_t first, uint32_t count)
{
    const uint32_t *from = c->order.from ? c->order.from + first : NULL;
    uint8_t *occluded = c->occluded + c->order.first;
    if (!from)
        for (uint32_t k = 0; k < count; k++)
            occluded[first + k] = p->object[k] != CGT_NONE;
    else
        for (uint32_t k = 0; k < count; k++)
            occluded[from[k]] = p->object[k] != CGT_NONE;
}

/* Points that no tile can take: as packets. */
static void trace_apart(const light_call *c, uint32_t first, uint32_t count, packet *p)
{
    if (!ray_packet_make(c->world, &c->source, &c->order, first, count, p, c->counts)) {
        for (uint32_t k = 0; k < count; k++)
            trace_apart(c, first + k, 1, p);
        return;
    }
    CGT_KERNEL(cgt_packet_trace)(c->world, p, c->settings, c->counts);
    hand_out(c, p, first, count);
}

/* ---- the order of points ---- */

/* Bits 0 to 7 to every second place. */
CGT_SPU_INLINE vuint spread_bits(vuint i)
{
    i = spu_and(spu_or(i, spu_sl(i, 4)), spux_vuint(0x0f0f));
    i = spu_and(spu_or(i, spu_sl(i, 2)), spux_vuint(0x3333));
    return spu_and(spu_or(i, spu_sl(i, 1)), spux_vuint(0x5555));
}

/* Where the light sees points, along two axes, in any unit: for orders and estimates, which change no answer. */
typedef struct light_view {
    bool place;
    uint32_t main;
    float reference[3], slope[2];
} light_view;

/* With the way of a chunk's middle point as the main one. */
static light_view view_make(const light_call *c, uint32_t count)
{
    light_view v = {.place = c->light.w == 1};
    float way[3];
    for (uint32_t a = 0; a < 3; a++) {
        const float o = ray_element(&c->source, c->source.rays->org[a], c->order.first + count / 2);
        way[a] = v.place ? o - c->light.position[a] : c->light.position[a];
        v.reference[a] = v.place ? c->light.position[a] : o;
        v.main = fabsf(way[a]) > fabsf(way[v.main]) ? a : v.main;
    }
    for (uint32_t a = 0; a < 2; a++)
        v.slope[a] = v.place ? 0 : way[(v.main + 1 + a) % 3] / way[v.main];
    return v;
}

CGT_SPU_INLINE void view_see(const light_view *v, const vfloat point[3], vfloat at[2])
{
    vfloat from[3];
    for (int a = 0; a < 3; a++)
        from[a] = spu_sub(point[a], spux_vfloat(v->reference[a]));
    const vfloat w = from[v->main], rw = v->place ? spux_div(spux_vfloat(1), w) : spux_vfloat(1);
    for (uint32_t a = 0; a < 2; a++)
        at[a] = spu_mul(spu_nmsub(spux_vfloat(v->slope[a]), w, from[(v->main + 1 + a) % 3]), rw);
}

/* Points k to k + CGT_LANES - 1 of a chunk; the last one again beyond its end. */
CGT_SPU_INLINE void chunk_load(const light_call *c, uint32_t k, uint32_t count, vfloat point[3])
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

/* Points that the light sees side by side to the same groups, along a Morton curve. */
static void sort_points(const light_call *c, uint32_t count, uint32_t from[CGT_RAYS_CHUNK])
{
    _Alignas(64) float place[2][CGT_RAYS_CHUNK];
    _Alignas(64) uint32_t key[CGT_RAYS_CHUNK];
    uint32_t start[SORT_CELLS * SORT_CELLS + 1] = {0};
    const light_view view = view_make(c, count);
    vfloat least[2], most[2], scale[2];
    for (int a = 0; a < 2; a++) {
        least[a] = spux_vfloat(INFINITY);
        most[a] = spux_vfloat(-INFINITY);
    }
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vfloat point[3], at[2];
        chunk_load(c, k, count, point);
        view_see(&view, point, at);
        for (int a = 0; a < 2; a++) {
            spux_store(place[a] + k, at[a]);
            least[a] = spux_min(least[a], at[a]);
            most[a] = spux_max(most[a], at[a]);
        }
    }
    for (int a = 0; a < 2; a++) {
        const float first = spux_hmin(least[a]), length = spux_hmax(most[a]) - first;
        least[a] = spux_vfloat(first);
        scale[a] = spux_vfloat(length > 0 ? SORT_CELLS / length : 0);
    }
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vuint cell[2];
        for (int a = 0; a < 2; a++) {
            const vfloat at = spu_mul(spu_sub(spux_load(place[a] + k), least[a]), scale[a]);
            cell[a] = (vuint)spu_convts(spux_min(spux_max(at, spux_vfloat(0)), spux_vfloat(SORT_CELLS - 1)), 0);
        }
        spux_store_uint(key + k, spu_and(spu_or(spread_bits(cell[0]), spu_sl(spread_bits(cell[1]), 1)),
                                         spux_vuint(SORT_CELLS * SORT_CELLS - 1)));
    }
    for (uint32_t k = 0; k < count; k++)
        start[key[k] + 1]++;
    for (uint32_t k = 0; k < SORT_CELLS * SORT_CELLS; k++)
        start[k + 1] += start[k];
    for (uint32_t k = 0; k < count; k++)
        from[start[key[k]]++] = k;
}

/* Whether neighbours in the arrays are mostly far from each other, as far as some of them tell: a third of what the
 * light sees of their chunk. */
static bool is_scattered(const light_call *c, uint32_t count)
{
    const light_view view = view_make(c, count);
    float least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY}, sum = 0, all = 0;
    uint32_t groups = 0;
    for (uint32_t k = 0; k + CGT_LANES <= count; k += (count / 16 / CGT_LANES + 1) * CGT_LANES, groups++) {
        vfloat point[3], at[2];
        chunk_load(c, k, count, point);
        view_see(&view, point, at);
        for (int a = 0; a < 2; a++) {
            const float low = spux_hmin(at[a]), high = spux_hmax(at[a]);
            sum += high - low;
            least[a] = low < least[a] ? low : least[a];
            most[a] = larger(most[a], high);
        }
    }
    for (int a = 0; a < 2; a++)
        all += most[a] - least[a];
    return !(sum * 3 <= all * (float)groups);
}

static void trace_tile(const light_call *c, light_tile *t, uint32_t first, uint32_t count)
{
    uint32_t from[PACKETS] = {0}, rays[PACKETS] = {0};
    t->packets = 0;
    t->spheres.count = t->triangles.count = 0;
    for (uint32_t done = 0; done < count && t->packets < PACKETS; done += PACKET_MAX_RAYS) {
        const uint32_t left = count - done, some = left < PACKET_MAX_RAYS ? left : PACKET_MAX_RAYS;
        const uint64_t invalid = c->counts->invalid_rays;
        light_packet *l = &t->packet[t->packets];
        packet *p = &l->rays;
        p->any_hit = true;
        p->fast = false;
        if (light_points_read(c, first + done, some, p)) {
            if (!p->rays) {
                hand_out(c, p, first + done, some);
                continue;
            }
            if (tile_add(t, l)) {
                from[t->packets] = first + done;
                rays[t->packets++] = some;
                continue;
            }
        }
        c->counts->invalid_rays = invalid;
        trace_apart(c, first + done, some, p);
    }
    if (!t->packets)
        return;
    tile_finish(t);
    c->counts->tiles++;
    march(t);
    for (uint32_t k = 0; k < PACKETS; k++)
        hand_out(c, &t->packet[k].rays, from[k], rays[k]);
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
    for (uint32_t k = 0; k < count; k++)
        counts->hits += occluded[first + k];
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
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
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

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against one light through the BVH. Neighbours in the arrays become packets, whose rays lie in a frustum
 * (light_packet.h). A node's children are tested against the frustum at once, and so are a leaf's primitives; those
 * that remain are tested against all rays (light_leaf.h).
 *
 * Packets pay if primitives are large compared to them. Otherwise single rays are faster: a chunk whose first packets
 * take too much work is traced like any other rays, and so is any in a scene with capsules. */
#include "kernel/bvh/bvh_node.h"
#include "kernel/light/light_leaf.h"
#include "kernel/light/light_points.h"

#define LIGHT_BVH_PACKET_RAYS 64u
#define LIGHT_STACK_SIZE (CGT_BVH_MAX_DEPTH * (CGT_LANES - 1) + 1)

/* The first packets of a chunk, whose work decides whether it goes on as packets (LIGHT_PACKET_WORK). */
#define LIGHT_TRIAL_PACKETS 4u
#define LIGHT_MAX_WORK (4 * LIGHT_PACKET_WORK) /* of one packet: it is aborted beyond */

/* ---- the frustum ---- */

/* Widens the frustum by its margins. */
static void light_frustum_add_margins(const light_packet *l, light_frustum *f)
{
    for (int a = 0; a < 2; a++)
        for (int k = 0; k < 2; k++) {
            const float slope = f->slope[a][k], error = l->margin * (1 + fabsf(slope));
            f->offset[a][k] += k ? error : -error;
            f->length[a][k] = __builtin_sqrtf(1 + slope * slope) * (1 + 0x1p-20f);
        }
    f->w[0] -= l->margin;
    f->w[1] += l->margin;
}

/* Rays to a point light. Returns false if their directions differ too much for one frustum. */
static bool light_frustum_init_point(const packet *p, const light_packet *l, light_frustum *f)
{
    const vfloat zero = spux_vfloat(0);
    vfloat lower[3], upper[3];
    vmask diverging = spux_mask_none();
    for (int a = 0; a < 3; a++) {
        lower[a] = spux_vfloat(INFINITY);
        upper[a] = spux_vfloat(-INFINITY);
    }
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const int main = l->axis[0];
        const vfloat w =
            spu_mul(spu_sub(spux_load(p->org[main] + i), spux_vfloat(l->origin[main])), spux_vfloat(l->sign));
        const vfloat rw = spux_div(spux_vfloat(1), w);
        diverging = spu_or(diverging, spux_not(spu_cmpgt(w, zero)));
        lower[0] = spux_min(lower[0], w);
        upper[0] = spux_max(upper[0], w);
        for (int k = 1; k < 3; k++) {
            const int a = l->axis[k];
            const vfloat slope = spu_mul(spu_sub(spux_load(p->org[a] + i), spux_vfloat(l->origin[a])), rw);
            diverging = spu_or(diverging, spux_not(spu_cmpgt(spux_vfloat(LIGHT_MAX_SLOPE), spux_abs(slope))));
            lower[k] = spux_min(lower[k], slope);
            upper[k] = spux_max(upper[k], slope);
        }
    }
    if (spux_any(diverging))
        return false;
    f->w[0] = 0;
    f->w[1] = spux_hmax(upper[0]);
    for (int k = 1; k < 3; k++) {
        f->slope[k - 1][0] = spux_hmin(lower[k]);
        f->slope[k - 1][1] = spux_hmax(upper[k]);
        f->offset[k - 1][0] = f->offset[k - 1][1] = 0;
    }
    light_frustum_add_margins(l, f);
    return true;
}

/* Parallel rays. */
static void light_frustum_init_parallel(const packet *p, const light_packet *l, light_frustum *f)
{
    const int main = l->axis[0];
    vfloat low_w = spux_vfloat(INFINITY);
    for (int k = 1; k < 3; k++) {
        const int a = l->axis[k];
        const float slope = p->dir[a][0] / (l->sign * p->dir[main][0]);
        vfloat lower = spux_vfloat(INFINITY), upper = spux_vfloat(-INFINITY);
        for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
            const vfloat w =
                spu_mul(spu_sub(spux_load(p->org[main] + i), spux_vfloat(l->origin[main])), spux_vfloat(l->sign));
            const vfloat v = spu_sub(spux_load(p->org[a] + i), spux_vfloat(l->origin[a]));
            const vfloat offset = spu_nmsub(spux_vfloat(slope), w, v);
            low_w = spux_min(low_w, w);
            lower = spux_min(lower, offset);
            upper = spux_max(upper, offset);
        }
        f->slope[k - 1][0] = f->slope[k - 1][1] = slope;
        f->offset[k - 1][0] = spux_hmin(lower);
        f->offset[k - 1][1] = spux_hmax(upper);
    }
    f->w[0] = spux_hmin(low_w);
    f->w[1] = INFINITY;
    light_frustum_add_margins(l, f);
}

/* light_init_axes by the last lane: a ray of the packet, or a copy of one. */
static bool light_init_axes_from_last(light_packet *l)
{
    const packet *p = &l->rays;
    const uint32_t last_lane = p->lanes - 1;
    const float org[3] = {p->org[0][last_lane], p->org[1][last_lane], p->org[2][last_lane]};
    const float dir[3] = {p->dir[0][last_lane], p->dir[1][last_lane], p->dir[2][last_lane]};
    return light_init_axes(p, org, dir, l);
}

static bool light_packet_init(const cgt_committed_scene *committed_scene, light_packet *l)
{
    const packet *p = &l->rays;
    if (p->extreme || !light_check_ranges(p, l) || !light_init_axes_from_last(l))
        return false;
    light_compute_margin(committed_scene, p, l);
    if (!p->to_light)
        light_frustum_init_parallel(p, l, &l->frustum);
    else if (!light_frustum_init_point(p, l, &l->frustum))
        return false;
    light_compute_terms(p, committed_scene->scale, l);
    light_compute_size_offset(committed_scene, l);
    light_find_still_axes(l);
    return true;
}

/* The children that overlap the frustum, as bits. */
CGT_SPU_INLINE unsigned light_visible_children(const light_packet *l, const bvh_node *node)
{
    const light_frustum *f = &l->frustum;
    const int main = l->axis[0];
    const vfloat main_origin = spux_vfloat(l->origin[main]);
    const bool reversed = l->sign < 0;
    const vfloat below = spu_sub(spux_load(node->low[main]), main_origin),
                 above = spu_sub(spux_load(node->high[main]), main_origin);
    const vfloat minus = spux_vfloat(-0.f);
    vfloat w0 = reversed ? spu_xor(above, minus) : below, w1 = reversed ? spu_xor(below, minus) : above;
    vfloat own = spux_vfloat(0);
    if (l->is_wide) {
        for (int a = 0; a < 3; a++)
            own = spux_max(own, spux_max(spux_abs(spux_load(node->low[a])), spux_abs(spux_load(node->high[a]))));
        own = light_own_margin(own); /* infinite in lanes without a child */
        w0 = spu_sub(w0, own);
        w1 = spu_add(w1, own);
    }
    vmask out = spu_or(spu_cmpgt(spux_vfloat(f->w[0]), w1), spu_cmpgt(w0, spux_vfloat(f->w[1])));
    for (int k = 0; k < 2; k++) {
        const int a = l->axis[k + 1];
        const vfloat origin = spux_vfloat(l->origin[a]);
        const vfloat low = spu_sub(spux_load(node->low[a]), origin);
        const vfloat high = spu_sub(spux_load(node->high[a]), origin);
        const vfloat s0 = spux_vfloat(f->slope[k][0]), s1 = spux_vfloat(f->slope[k][1]);
        const vfloat upper = spu_add(spu_sub(high, spux_min(spu_mul(s0, w0), spu_mul(s0, w1))), own);
        const vfloat lower = spu_sub(spu_sub(low, spux_max(spu_mul(s1, w0), spu_mul(s1, w1))), own);
        out = spu_or(out, spu_or(spu_cmpgt(spux_vfloat(f->offset[k][0]), upper),
                                 spu_cmpgt(lower, spux_vfloat(f->offset[k][1]))));
    }
    return ~(spux_mask_bits(out) | bvh_parallel_children(node, l->still)) &
           (CGT_ALL_LANES >> (CGT_LANES - node->children));
}

/* A leaf's primitives in the frustum's coordinates. */
typedef struct light_primitives {
    vfloat w[3], v[2][3]; /* of each vertex; of a sphere's centre, three times */
    vfloat radius;
    float scale; /* factor of their coordinates */
} light_primitives;

CGT_SPU_INLINE void light_transform_points(const light_packet *l, const float point[3][CGT_LANES], float scale,
                                           vfloat w[1], vfloat v[2])
{
    const int main = l->axis[0];
    w[0] = spu_mul(spu_sub(spux_load(point[main]), spux_vfloat(l->origin[main] * scale)), spux_vfloat(l->sign));
    for (int k = 0; k < 2; k++)
        v[k] = spu_sub(spux_load(point[l->axis[k + 1]]), spux_vfloat(l->origin[l->axis[k + 1]] * scale));
}

CGT_SPU_INLINE void light_transform_spheres(const light_packet *l, const sphere_block *s, light_primitives *q)
{
    vfloat v[2];
    light_transform_points(l, s->center, 1, q->w, v);
    for (int k = 0; k < 3; k++) {
        q->w[k] = q->w[0];
        q->v[0][k] = v[0];
        q->v[1][k] = v[1];
    }
    q->radius = spux_load(s->radius);
    if (l->is_wide) {
        vfloat magnitude = spux_vfloat(0);
        for (int a = 0; a < 3; a++)
            magnitude = spux_max(magnitude, spux_abs(spux_load(s->center[a])));
        q->radius = spu_add(q->radius, light_own_margin(spu_add(magnitude, q->radius)));
    }
    q->scale = 1;
}

CGT_SPU_INLINE void light_transform_triangles(const light_packet *l, const triangle_block *s, float scale,
                                              light_primitives *q)
{
    vfloat v[2];
    light_transform_points(l, s->vertex, scale, q->w, v);
    for (int k = 0; k < 3; k++) {
        const vfloat sign = spux_vfloat(l->sign);
        q->w[k] = k ? spu_madd(spux_load(s->edge[k - 1][l->axis[0]]), sign, q->w[0]) : q->w[0];
        for (int a = 0; a < 2; a++)
            q->v[a][k] = k ? spu_add(spux_load(s->edge[k - 1][l->axis[a + 1]]), v[a]) : v[a];
    }
    q->radius = spux_vfloat(0);
    if (l->is_wide) {
        vfloat magnitude = spux_vfloat(0);
        for (int a = 0; a < 3; a++) {
            const vfloat edges = spux_max(spux_abs(spux_load(s->edge[0][a])), spux_abs(spux_load(s->edge[1][a])));
            magnitude = spux_max(magnitude, spu_add(spux_abs(spux_load(s->vertex[a])), edges));
        }
        q->radius = light_own_margin(magnitude);
    }
    q->scale = scale;
}

/* The primitives of a leaf that overlap the frustum. */
CGT_SPU_INLINE vmask light_frustum_overlaps(const light_frustum *f, const light_primitives *q, int vertices)
{
    const vfloat scale = spux_vfloat(q->scale);
    vfloat low = q->w[0], high = q->w[0];
    for (int k = 1; k < vertices; k++) {
        low = spux_min(low, q->w[k]);
        high = spux_max(high, q->w[k]);
    }
    vmask out = spu_or(spu_cmpgt(spu_sub(spu_mul(spux_vfloat(f->w[0]), scale), q->radius), high),
                       spu_cmpgt(spu_sub(low, q->radius), spu_mul(spux_vfloat(f->w[1]), scale)));
    for (int a = 0; a < 2; a++) {
        const vfloat s0 = spux_vfloat(f->slope[a][0]), s1 = spux_vfloat(f->slope[a][1]);
        vfloat upper = spu_nmsub(s0, q->w[0], q->v[a][0]), lower = spu_nmsub(s1, q->w[0], q->v[a][0]);
        for (int k = 1; k < vertices; k++) {
            upper = spux_max(upper, spu_nmsub(s0, q->w[k], q->v[a][k]));
            lower = spux_min(lower, spu_nmsub(s1, q->w[k], q->v[a][k]));
        }
        const vfloat radius0 = spu_mul(q->radius, spux_vfloat(f->length[a][0]));
        const vfloat radius1 = spu_mul(q->radius, spux_vfloat(f->length[a][1]));
        out = spu_or(out, spu_cmpgt(spu_mul(spux_vfloat(f->offset[a][0]), scale), spu_add(upper, radius0)));
        out = spu_or(out, spu_cmpgt(spu_sub(lower, radius1), spu_mul(spux_vfloat(f->offset[a][1]), scale)));
    }
    return spux_not(out);
}

/* ---- nodes and leaves ---- */

/* The lanes whose triangles a packet's rays are not all parallel to. */
__attribute__((noinline, cold)) static unsigned light_drop_flat(const cgt_primitives *prims, const light_packet *l,
                                                                const uint32_t prim[CGT_LANES], unsigned lanes)
{
    vfloat vertex[3][3];
    gather_scene_triangles(prims, prim, vertex);
    return lanes & ~light_find_flat(vertex, l->still);
}

static void light_test_leaf(const light_call *c, light_packet *l, uint32_t code)
{
    const cgt_bvh *tree = &c->committed_scene->bvh;
    const uint32_t block = code & CGT_BVH_INDEX_MASK, count = bvh_leaf_count(code);
    const bool is_triangle_leaf = code & CGT_BVH_BOXED_LEAF;
    const sphere_block *spheres = is_triangle_leaf ? NULL : (const sphere_block *)tree->sphere + block;
    const triangle_block *triangles = is_triangle_leaf ? (const triangle_block *)tree->triangle + block : NULL;
    light_primitives q;
    if (is_triangle_leaf)
        light_transform_triangles(l, triangles, c->committed_scene->scale, &q);
    else
        light_transform_spheres(l, spheres, &q);
    const vmask overlaps =
        is_triangle_leaf ? light_frustum_overlaps(&l->frustum, &q, 3) : light_frustum_overlaps(&l->frustum, &q, 1);
    unsigned remaining = spux_mask_bits(overlaps) & CGT_ALL_LANES >> (CGT_LANES - count);
    if (__builtin_expect(l->still && is_triangle_leaf && remaining, 0))
        remaining = light_drop_flat(&c->committed_scene->prims, l, triangles->prim, remaining);
    const uint32_t tests = spux_count_bits(remaining);
    c->counts->leaves++;
    c->counts->cull_tests += count;
    c->counts->culled += count - tests;
    c->counts->packet_tests += tests;
    c->counts->ray_tests += (uint64_t)tests * l->rays.lanes;
    l->work += 1 + tests;
    if (!remaining)
        return;
    light_leaf leaf;
    leaf.sphere = spheres;
    leaf.triangle = triangles;
    const uint64_t decided = c->counts->double_tests;
    if (!is_triangle_leaf)
        light_test_primitives(c->committed_scene, l, &leaf, LIGHT_SPHERES, remaining, c->counts);
    else if (l->rays.to_light)
        light_test_primitives(c->committed_scene, l, &leaf, LIGHT_TRIANGLES_TO_POINT, remaining, c->counts);
    else
        light_test_primitives(c->committed_scene, l, &leaf, LIGHT_TRIANGLES_PARALLEL, remaining, c->counts);
    l->work += LIGHT_DECISION_WORK * (c->counts->double_tests - decided);
    if (!l->undecided)
        l->last_leaf = code;
}

/* Returns false if it takes too much work: hits found by then are right, the other rays are unknown. The leaf that
 * occluded the previous packet is tested first: shadows are larger than packets. */
static bool light_traverse(const light_call *c, light_packet *l)
{
    const bvh_node *nodes = c->committed_scene->bvh.node;
    uint32_t stack[LIGHT_STACK_SIZE], top = 0, code = 0;
    l->work = 0;
    if (l->last_leaf && l->undecided) {
        light_test_leaf(c, l, l->last_leaf);
        if (l->undecided)
            l->last_leaf = 0;
    }
    while (l->undecided) {
        if (l->work > LIGHT_MAX_WORK)
            return false;
        /* test a leaf, or push the children of a node */
        if (code & CGT_BVH_LEAF) {
            light_test_leaf(c, l, code);
        } else {
            const bvh_node *node = &nodes[code];
            c->counts->nodes++;
            l->work++;
            for (unsigned remaining = light_visible_children(l, node); remaining; remaining &= remaining - 1)
                stack[top++] = node->child[__builtin_ctz(remaining)];
        }
        /* pop the next node */
        if (!top)
            return true;
        code = stack[--top];
    }
    return true;
}

/* ---- points ---- */

/* Rays as a structure of arrays. */
typedef struct light_rays {
    float org[3][CGT_RAYS_CHUNK], dir[3][CGT_RAYS_CHUNK], t_min[CGT_RAYS_CHUNK], t_max[CGT_RAYS_CHUNK];
    uint32_t mask[CGT_RAYS_CHUNK], primitive[CGT_RAYS_CHUNK], geometry[CGT_RAYS_CHUNK];
} light_rays;

static const uint32_t *light_copy_ids(const light_call *c, const uint32_t *from, uint64_t first, uint32_t count,
                                      uint32_t *to)
{
    if (!from)
        return NULL;
    for (uint32_t k = 0; k < count; k++)
        to[k] = ray_number(&c->source, from, first + k);
    return to;
}

/* Traces points first to end - 1 as single rays. */
static void light_trace_single_rays(const light_call *c, uint64_t first, uint64_t end)
{
    light_rays *copy = cgt_scratch_take(c->counts->scratch, sizeof *copy);
    const cgt_rays *points = c->source.rays;
    const uint32_t count = (uint32_t)(end - first);
    cgt_rays rays = {.count = count,
                     .t_min = copy->t_min,
                     .t_max = copy->t_max,
                     .mask = light_copy_ids(c, points->mask, first, count, copy->mask),
                     .skip_primitive = light_copy_ids(c, points->skip_primitive, first, count, copy->primitive),
                     .skip_geometry = light_copy_ids(c, points->skip_geometry, first, count, copy->geometry)};
    for (int a = 0; a < 3; a++) {
        for (uint32_t k = 0; k < count; k++) {
            copy->org[a][k] = ray_component(&c->source, points->org[a], first + k);
            copy->dir[a][k] = ray_direction(&c->source, first + k, a, copy->org[a][k]);
        }
        rays.org[a] = copy->org[a];
        rays.dir[a] = copy->dir[a];
    }
    for (uint32_t k = 0; k < count; k++) {
        copy->t_min[k] = points->t_min ? ray_element(points->t_min, c->source.stride, first + k) : 0;
        copy->t_max[k] = points->t_max ? ray_element(points->t_max, c->source.stride, first + k) : c->source.t_max;
    }
    CGT_KERNEL(cgt_bvh_trace_rays)
    (c->committed_scene, &rays, 0, count, c->settings, NULL, c->occluded + first, c->counts);
    c->counts->rays -= count; /* the call has counted them */
    cgt_scratch_return(c->counts->scratch, copy);
}

/* Traces points first to first + count - 1 of the order as a packet and adds the work that it took. Returns false if it
 * was too much: then nothing has changed. */
static bool light_trace_points(const light_call *c, light_packet *l, uint32_t first, uint32_t count, uint64_t *work)
{
    const uint64_t invalid = c->counts->invalid_rays, traced = c->counts->bvh_rays;
    if (!light_read_packet(c, first, count, &l->rays)) {
        for (uint32_t k = 0; k < count; k++)
            if (!light_trace_points(c, l, first + k, 1, work)) {
                c->counts->invalid_rays = invalid;
                c->counts->bvh_rays = traced;
                return false;
            }
        return true;
    }
    if (l->rays.rays && light_packet_init(c->committed_scene, l)) {
        const bool done = light_traverse(c, l);
        c->counts->packets++;
        c->counts->bvh_rays += done ? count : 0;
        *work += l->work;
        if (!done) {
            c->counts->invalid_rays = invalid;
            return false;
        }
    } else if (l->rays.rays) { /* directions differ too much: streams move the rays to the light where that pays */
        const uint64_t decided = c->counts->double_tests, hits = c->counts->hits;
        c->counts->invalid_rays = invalid;
        light_trace_single_rays(c, c->order.first + first, c->order.first + first + count);
        c->counts->hits = hits; /* light_count_hits counts them */
        *work += LIGHT_DECISION_WORK * (c->counts->double_tests - decided);
        return true;
    }
    light_store_occluded(c, &l->rays, first, count);
    return true;
}

bool CGT_KERNEL(cgt_bvh_trace_light)(const cgt_committed_scene *committed_scene, const cgt_rays *points,
                                     const cgt_light *light, uint64_t first, uint64_t end,
                                     const cgt_trace_settings *settings, uint8_t *occluded, cgt_counts *counts)
{
    light_packet *l = cgt_scratch_take(counts->scratch, sizeof *l);
    const light_call c = {.committed_scene = committed_scene,
                          .source = ray_source_init(points, light),
                          .light = *light,
                          .order = {first, NULL},
                          .settings = settings,
                          .occluded = occluded,
                          .counts = counts};
    const uint32_t count = (uint32_t)(end - first);
    uint32_t done = 0;
    uint64_t work = 0;
    l->rays.any_hit = true;
    l->rays.fast = false;
    l->last_leaf = 0;
    counts->rays += count;
    const bool by_packets = light_is_near(&c) && !committed_scene->bvh.capsule_blocks;
    while (by_packets && done < count &&
           (done < LIGHT_TRIAL_PACKETS * LIGHT_BVH_PACKET_RAYS ||
            LIGHT_BVH_PACKET_RAYS * work <= (uint64_t)LIGHT_PACKET_WORK * done)) {
        const uint32_t batch = count - done < LIGHT_BVH_PACKET_RAYS ? count - done : LIGHT_BVH_PACKET_RAYS;
        if (!light_trace_points(&c, l, done, batch, &work))
            break;
        done += batch;
    }
    light_count_hits(&c, done);
    if (done < count)
        light_trace_single_rays(&c, first + done, end);
    cgt_scratch_return(counts->scratch, l);
    return true;
}

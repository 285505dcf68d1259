/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray of a call through the BVH, without packets and streams: less than 16 KB of stack, of which the traversal's own
 * stack takes 8. The hit and its values are those of arrays of rays. */
#include "exact/valid_primitive.h"
#include "kernel/bvh/bvh_single.h"
#include "kernel/resolve/fast_spheres.h"
#include "kernel/resolve/fast_triangles.h"
#include "kernel/resolve/resolve_spheres.h"

/* ---- the ray ---- */

static cgt_ray one_ray_input(const cgt_single_ray *from)
{
    cgt_ray ray = {.t_min = from->t_min < -FLT_MAX ? -FLT_MAX : from->t_min,
                   .t_max = from->t_max == 0 ? INFINITY : from->t_max};
    for (int a = 0; a < 3; a++) {
        ray.line.org[a] = from->org[a];
        ray.line.dir[a] = from->dir[a];
    }
    return ray;
}

/* As ray_packet.h and stream_read.h have it: OUTSIDE is not looked for. */
CGT_SPU_INLINE ray_state one_ray_state(const cgt_ray *ray)
{
    float zero = 0, largest = 0, longest = 0;
    for (int a = 0; a < 3; a++) {
        const float o = fabsf(ray->line.org[a]), d = fabsf(ray->line.dir[a]);
        zero += o * 0 + d * 0; /* not a number where o or d is not finite */
        largest = o > largest ? o : largest;
        longest = d > longest ? d : longest;
    }
    if (zero != 0 || longest == 0 || ray->t_min != ray->t_min || ray->t_max != ray->t_max)
        return RAY_INVALID;
    if (ray->t_min > ray->t_max || ray->t_min > FLT_MAX || ray->t_max < -FLT_MAX)
        return RAY_EMPTY_RANGE;
    return largest > PACKET_MAX_COORDINATE || longest > PACKET_MAX_COORDINATE || longest < PACKET_MIN_DIR ? RAY_EXTREME
                                                                                                          : RAY_OPEN;
}

/* The call of one ray, in the form that the shared parts read. */
typedef struct one_ray_call {
    bvh_call call;
    uint32_t mask, skip_prim;
} one_ray_call;

/* Returns whether the tree serves the call. */
CGT_SPU_INLINE bool one_ray_init(const cgt_committed_scene *committed_scene, const cgt_single_ray *from,
                                 const cgt_ray *ray, bool any_hit, cgt_counts *counts, one_ray_call *c)
{
    const bool fits = bvh_call_init(committed_scene, counts, &c->call);
    c->call.ray = ray;
    c->call.any_hit = any_hit;
    c->mask = from->mask ? from->mask : UINT32_MAX;
    c->skip_prim = CGT_INVALID_ID;
    if (from->skips && from->skip_primitive != CGT_INVALID_ID)
        c->skip_prim = cgt_primitives_number(&committed_scene->prims, from->skip_geometry, from->skip_primitive);
    c->call.skip_prim = c->skip_prim == CGT_INVALID_ID ? NULL : &c->skip_prim;
    c->call.mask = committed_scene->has_masks && c->mask != UINT32_MAX ? &c->mask : NULL;
    c->call.skips_prims = c->call.skip_prim || c->call.mask;
    return fits;
}

/* ---- the way through the tree ---- */

/* The ray's slabs in every lane, and where its planes are in a node. */
typedef struct one_ray_slabs {
    vfloat rdir[3], first[3], last[3];
    uint32_t enter[3], leave[3]; /* bytes from a node to the planes that the ray meets first along an axis, and last */
} one_ray_slabs;

CGT_SPU_INLINE void one_ray_set_slabs(const bvh_ray *r, one_ray_slabs *q)
{
    for (uint32_t a = 0; a < 3; a++) {
        const uint32_t low = offsetof(bvh_node, low) + a * CGT_VECTOR_BYTES;
        const uint32_t high = offsetof(bvh_node, high) + a * CGT_VECTOR_BYTES;
        const bool from_above = r->octant >> a & 1;
        q->enter[a] = from_above ? high : low;
        q->leave[a] = from_above ? low : high;
        q->rdir[a] = spux_vfloat(r->rdir[a]);
        q->first[a] = spux_vfloat(r->first[a]);
        q->last[a] = spux_vfloat(r->last[a]);
    }
}

/* The child at lane `lane` of bvh_push_order. */
CGT_SPU_INLINE uint32_t one_ray_child_in_order(const bvh_node *n, uint32_t octant, uint32_t lane)
{
    return octant > 3 ? n->child[n->order[7 - octant][lane]] : n->child[n->order[octant][n->children - 1 - lane]];
}

/* Returns the child that the ray passes first, CGT_BVH_NO_CHILD for none, and pushes the others. The first one does not
 * take the way over the stack: reading back part of a vector that was just stored takes as long as half the step. */
CGT_SPU_INLINE uint32_t one_ray_step(const bvh_ray *r, const one_ray_slabs *q, const bvh_node *n, bvh_stack *s,
                                     bool any_hit)
{
    vfloat enter = spux_vfloat(r->near), leave = spux_vfloat(r->far);
    for (int a = 0; a < 3; a++) {
        const float *near = (const float *)(const void *)((const char *)n + q->enter[a]);
        const float *far = (const float *)(const void *)((const char *)n + q->leave[a]);
        enter = spux_max(spu_madd(spux_load(near), q->rdir[a], q->first[a]), enter);
        leave = spux_min(spu_madd(spux_load(far), q->rdir[a], q->last[a]), leave);
    }
    const unsigned children = CGT_ALL_LANES >> (CGT_LANES - n->children);
    unsigned passed = spux_mask_bits(spux_cmpge(leave, enter)) & children;
    if (!(passed & (passed - 1)))
        return passed ? n->child[__builtin_ctz(passed)] : CGT_BVH_NO_CHILD;
    vuint code = spux_load_uint(n->child);
    uint32_t first;
    if (any_hit) {
        first = n->child[__builtin_ctz(passed)];
        passed &= passed - 1;
    } else {
        const vuint order = bvh_push_order(n, r->octant);
        enter = spux_permute(enter, order);
        code = spux_permute(code, order);
        passed = spux_mask_bits(spux_cmpge(spux_permute(leave, order), enter)) & children;
        const uint32_t lane = 31 - (uint32_t)__builtin_clz(passed);
        first = one_ray_child_in_order(n, r->octant, lane);
        passed ^= 1u << lane;
    }
    const vmask others = spux_mask_from_bits(passed);
    spux_store_unaligned_uint(s->code + s->top, spux_compress(code, others));
    if (!any_hit)
        spux_store_unaligned(s->near + s->top, spux_compress(enter, others));
    s->top += spux_count_bits(passed);
    return first;
}

/* As bvh_single_trace from the root on. */
CGT_SPU_INLINE void one_ray_traverse(const bvh_call *c, bvh_ray *r, bool any_hit)
{
    bvh_stack s;
    bvh_leaf_ray l;
    one_ray_slabs q;
    uint32_t code = 0;
    one_ray_set_slabs(r, &q);
    bvh_leaf_ray_init(c, r, &l);
    s.top = 0;
    for (;;) {
        if (code & CGT_BVH_LEAF) {
            bvh_single_leaf(c, r, &l, code, any_hit);
            if (any_hit && r->far == -INFINITY)
                return;
            code = CGT_BVH_NO_CHILD;
        } else {
            c->counts->nodes++;
            code = one_ray_step(r, &q, (const bvh_node *)c->tree->node + code, &s, any_hit);
        }
        while (code == CGT_BVH_NO_CHILD) {
            if (!s.top)
                return;
            s.top--;
            code = any_hit || s.near[s.top] <= r->far ? s.code[s.top] : CGT_BVH_NO_CHILD;
        }
    }
}

/* ---- tracing ---- */

/* Numbers that single precision does not cover: against every primitive. */
__attribute__((noinline, cold)) static uint32_t one_ray_trace_extreme(const bvh_call *c, const cgt_ray *ray)
{
    const cgt_primitives *prims = &c->committed_scene->prims;
    uint32_t best = CGT_INVALID_ID;
    for (uint32_t prim = cgt_next_valid(prims, 0); prim < prims->count; prim = cgt_next_valid(prims, prim + 1)) {
        double t;
        if (bvh_ray_skips(c, 0, prim))
            continue;
        c->counts->packet_tests++;
        c->counts->ray_tests++;
        if (!filter_is_closer(prims, ray, best, prim, &t, c->counts))
            continue;
        best = prim;
        if (c->any_hit)
            break;
    }
    return best;
}

/* Returns the primitive that is hit, CGT_INVALID_ID for none. */
CGT_SPU_INLINE uint32_t one_ray_trace(const cgt_committed_scene *committed_scene, const cgt_single_ray *from,
                                      const cgt_ray *ray, bool any_hit, cgt_counts *counts)
{
    one_ray_call c;
    bvh_ray r;
    const ray_state state = one_ray_state(ray);
    counts->rays++;
    counts->invalid_rays += state == RAY_INVALID;
    if (state > RAY_EXTREME || !committed_scene->valid)
        return CGT_INVALID_ID;
    const bool fits = one_ray_init(committed_scene, from, ray, any_hit, counts, &c);
    counts->bvh_rays++;
    if (!fits || state == RAY_EXTREME || committed_scene->brute_force || !bvh_ray_normalise(&c.call, ray, 0, &r))
        return one_ray_trace_extreme(&c.call, ray);
    one_ray_traverse(&c.call, &r, any_hit);
    return r.best.prim;
}

/* ---- the hit ---- */

/* The ray in every lane. */
typedef struct one_ray_lanes {
    vfloat org[3], dir[3], t_min, t_max;
} one_ray_lanes;

CGT_SPU_INLINE one_ray_lanes one_ray_splat(const cgt_ray *ray)
{
    one_ray_lanes r = {.t_min = spux_vfloat(ray->t_min), .t_max = spux_vfloat(ray->t_max)};
    for (int a = 0; a < 3; a++) {
        r.org[a] = spux_vfloat(ray->line.org[a]);
        r.dir[a] = spux_vfloat(ray->line.dir[a]);
    }
    return r;
}

/* The next two compute a hit's values in single precision, the same bits as in a vector of rays. They return whether the
 * bounds cover it; else t and normal hold anything. */
static bool one_ray_fast_sphere(const cgt_ray *ray, cgt_sphere q, cgt_single_hit *hit)
{
    const one_ray_lanes r = one_ray_splat(ray);
    const vfloat sphere[4] = {spux_vfloat(q.x), spux_vfloat(q.y), spux_vfloat(q.z), spux_vfloat(q.r)};
    const fast_sphere s = fast_sphere_prepare(r.org, sphere);
    vfloat t, n[3];
    const vmask covered = fast_sphere_resolve(&s, r.dir, fast_inverse_square(r.dir), r.t_min, r.t_max, true, &t, n);
    hit->t = t[0];
    for (int a = 0; a < 3; a++)
        hit->normal[a] = n[a][0];
    return spux_any(covered);
}

static bool one_ray_fast_triangle(const cgt_ray *ray, const cgt_triangle *q, uint32_t fields, cgt_single_hit *hit)
{
    const one_ray_lanes r = one_ray_splat(ray);
    vfloat vertex[3][3];
    resolved_triangles h;
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            vertex[k][a] = spux_vfloat(q->v[k][a]);
    const fast_triangle s = fast_triangle_prepare(r.org, vertex);
    const vmask covered = fast_triangle_resolve(&s, r.dir, r.t_min, r.t_max, fields, &h);
    hit->t = h.t[0];
    hit->u = h.u[0];
    hit->v = h.v[0];
    for (int a = 0; a < 3; a++)
        hit->normal[a] = h.normal[a][0];
    return spux_any(covered);
}

static void one_ray_store(const cgt_committed_scene *committed_scene, const cgt_ray *ray, uint32_t prim,
                          cgt_precision precision, cgt_single_hit *hit, cgt_counts *counts)
{
    const bool fast = precision == CGT_PRECISION_FAST;
    const cgt_primitives *prims = &committed_scene->prims;
    const cgt_primitive_array *array = cgt_primitives_array(prims, prim);
    *hit = (cgt_single_hit){.primitive = prim - array->first, .geometry = array->geometry};
    if (array->kind != CGT_KIND_SPHERES) {
        const cgt_triangle q = cgt_array_triangle(array, prim - array->first);
        const uint32_t fields = CGT_FIELD_T | CGT_FIELD_NORMAL | CGT_FIELD_UV;
        if (fast && one_ray_fast_triangle(ray, &q, fields, hit))
            return;
        const resolved_triangle s = resolve_triangle_ray(ray, &q, fields, precision == CGT_PRECISION_EXACT, counts);
        hit->t = s.t;
        hit->u = s.u;
        hit->v = s.v;
        memcpy(hit->normal, s.normal, sizeof hit->normal);
    } else {
        const cgt_sphere q = cgt_array_sphere(array, prim - array->first);
        if (fast && one_ray_fast_sphere(ray, q, hit))
            return;
        const resolved_sphere s = resolve_sphere_ray(ray, q, counts);
        hit->t = s.t;
        memcpy(hit->normal, s.normal, sizeof hit->normal);
    }
}

void CGT_KERNEL(cgt_trace_one_ray)(const cgt_committed_scene *committed_scene, const cgt_single_ray *from,
                                   cgt_precision precision, cgt_single_hit *hit, cgt_counts *counts)
{
    const cgt_ray ray = one_ray_input(from);
    const uint32_t prim = one_ray_trace(committed_scene, from, &ray, false, counts);
    if (prim == CGT_INVALID_ID)
        return;
    counts->hits++;
    one_ray_store(committed_scene, &ray, prim, precision, hit, counts);
}

bool CGT_KERNEL(cgt_occluded_one_ray)(const cgt_committed_scene *committed_scene, const cgt_single_ray *from,
                                      cgt_counts *counts)
{
    const cgt_ray ray = one_ray_input(from);
    const bool occluded = one_ray_trace(committed_scene, from, &ray, true, counts) != CGT_INVALID_ID;
    counts->hits += occluded;
    return occluded;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against one light through the wide tree. Neighbours in the arrays become packets. All that runs between them
 * and the light lies in a frustum, with its tip at the light or, of parallel rays, with parallel sides: four planes and
 * two ends, against which a node's children are tested at once, and a leaf's primitives for every sixteen rays. What is
 * left is tested ray by ray, as leaves of all trees are (leaf_lanes.h).
 *
 * That shares most where primitives are large beside the packet. Where they are not, each ray is better off by itself:
 * a chunk of points whose first packets take more work than that goes through the tree as any other rays do.
 *
 * Frustum. The rays run mostly along one axis, the main one: w is the coordinate along it, seen from the reference (the
 * light, or the first point of parallel rays) and mirrored where they run against it, v that along another axis. Each
 * ray's line is v = slope w + offset, the offset 0 with a light at a place, the slope common without. So a plane is
 *     v - a w <= h,  a the largest slope and h the largest offset, and the like with the smallest
 * Margin. Let M be the sum of the largest coordinates, along any axis, of light, points and objects, and u = 2^-24.
 * Differences are within 2 u M. A slope is within 2 u of itself and of what v and w bring, so that the line is at most
 * 8 u M off between a point and the light, and 16 u M beyond a parallel ray's point as far as objects are, slopes being
 * at most 2. A canonical ray points past the light by u of its way, and t is rounded before it is compared with the
 * range. Of v - a w three operations round numbers below 8 M. The margin is 2^-17 M (1 + |a|), more than all of that. */
#include "leaf_lanes.h"
#include "ray_packet.h"
#include "wide_node.h"

#define LIGHT_RAYS 64u
#define LIGHT_GROUP 16u /* rays whose common frustum primitives are tested against */
#define LIGHT_GROUPS (LIGHT_RAYS / LIGHT_GROUP)
#define LIGHT_STACK (CGT_WIDE_MAX_DEPTH * (CGT_LANES - 1) + 1)
#define LIGHT_STEEPEST 2.f
#define LIGHT_MARGIN 0x1p-17f

/* Packets that tell whether a chunk goes on as packets, and the work, in visits of nodes and tests, that one may take:
 * each is about 70 cycles, and rays by themselves take 90. */
#define LIGHT_TRIED 4u
#define LIGHT_WORK 80u
#define LIGHT_TOO_MUCH (4 * LIGHT_WORK) /* of one packet: it is left off */

/* Rays lie between the planes v - slope[a][0] w >= offset[a][0] and v - slope[a][1] w <= offset[a][1], for both axes a,
 * and between two w. Margins are in it. */
typedef struct light_frustum {
    float slope[2][2], offset[2][2];
    float length[2][2]; /* of each plane's normal, rounded up */
    float w[2];
} light_frustum;

typedef struct light_packet {
    packet rays;
    lane_rays lane[LIGHT_RAYS / CGT_LANES];
    light_frustum all, group[LIGHT_GROUPS];
    unsigned open; /* groups with rays that have met nothing, as bits */
    int axis[3];   /* the main one first */
    float sign;    /* of the way from the reference along it */
    float reference[3];
    float margin; /* without 1 + |a| */
    uint64_t work;
} light_packet;

typedef struct light_call {
    const cgt_world *world;
    ray_source source;
    cgt_light light; /* the source's */
    ray_order order;
    const cgt_trace_settings *settings;
    uint8_t *occluded;
    cgt_counts *counts;
} light_call;

/* ---- the frustum ---- */

static float larger(float a, float b) { return a > b ? a : b; }

/* The main axis, the reference and the margin. False where there is no common way. */
static bool light_orient(const cgt_world *world, const packet *p, light_packet *l)
{
    const uint32_t first = p->lanes - 1; /* a ray that takes part, or a copy of one */
    const bool ends = p->to_light;
    float most = 0, magnitude = 0;
    for (int a = 0; a < 3; a++) {
        const float d = ends ? p->org[a][first] - p->light[a] : p->dir[a][first];
        if (fabsf(d) > most) {
            most = fabsf(d);
            l->axis[0] = a;
            l->sign = d < 0 ? -1 : 1;
        }
        vfloat farthest = spux_vfloat(0);
        for (uint32_t i = 0; i < p->lanes; i += CGT_LANES)
            farthest = spux_max(farthest, spux_abs(spux_load(p->org[a] + i)));
        l->reference[a] = ends ? p->light[a] : p->org[a][first];
        magnitude = larger(magnitude, larger(fabsf(world->low[a]), fabsf(world->high[a])) + spux_hmax(farthest) +
                                          fabsf(l->reference[a]));
    }
    l->axis[1] = (l->axis[0] + 1) % 3;
    l->axis[2] = (l->axis[0] + 2) % 3;
    l->margin = magnitude * LIGHT_MARGIN;
    return most > 0;
}

/* Adds margins. */
static void light_frustum_finish(const light_packet *l, light_frustum *f)
{
    for (int a = 0; a < 2; a++)
        for (int k = 0; k < 2; k++) {
            const float slope = f->slope[a][k], wide = l->margin * (1 + fabsf(slope));
            f->offset[a][k] += k ? wide : -wide;
            f->length[a][k] = __builtin_sqrtf(1 + slope * slope) * (1 + 0x1p-20f);
        }
    f->w[0] -= l->margin;
    f->w[1] += l->margin;
}

/* Rays first to end - 1 to a light at a place. False where they leave too many directions to it. */
static bool light_frustum_place(const packet *p, const light_packet *l, uint32_t first, uint32_t end, light_frustum *f)
{
    const vfloat zero = spux_vfloat(0);
    vfloat least[3], most[3];
    vmask wild = spux_mask_none();
    for (int a = 0; a < 3; a++) {
        least[a] = spux_vfloat(INFINITY);
        most[a] = spux_vfloat(-INFINITY);
    }
    for (uint32_t i = first; i < end; i += CGT_LANES) {
        const int main = l->axis[0];
        const vfloat w =
            spu_mul(spu_sub(spux_load(p->org[main] + i), spux_vfloat(l->reference[main])), spux_vfloat(l->sign));
        const vfloat rw = spux_div(spux_vfloat(1), w);
        wild = spu_or(wild, spux_not(spu_cmpgt(w, zero)));
        least[0] = spux_min(least[0], w);
        most[0] = spux_max(most[0], w);
        for (int k = 1; k < 3; k++) {
            const int a = l->axis[k];
            const vfloat slope = spu_mul(spu_sub(spux_load(p->org[a] + i), spux_vfloat(l->reference[a])), rw);
            wild = spu_or(wild, spux_not(spu_cmpgt(spux_vfloat(LIGHT_STEEPEST), spux_abs(slope))));
            least[k] = spux_min(least[k], slope);
            most[k] = spux_max(most[k], slope);
        }
    }
    if (spux_any(wild))
        return false;
    f->w[0] = 0;
    f->w[1] = spux_hmax(most[0]);
    for (int k = 1; k < 3; k++) {
        f->slope[k - 1][0] = spux_hmin(least[k]);
        f->slope[k - 1][1] = spux_hmax(most[k]);
        f->offset[k - 1][0] = f->offset[k - 1][1] = 0;
    }
    light_frustum_finish(l, f);
    return true;
}

/* The same with parallel rays. */
static void light_frustum_parallel(const packet *p, const light_packet *l, uint32_t first, uint32_t end,
                                   light_frustum *f)
{
    const int main = l->axis[0];
    vfloat low_w = spux_vfloat(INFINITY);
    for (int k = 1; k < 3; k++) {
        const int a = l->axis[k];
        const float slope = p->dir[a][first] / (l->sign * p->dir[main][first]);
        vfloat least = spux_vfloat(INFINITY), most = spux_vfloat(-INFINITY);
        for (uint32_t i = first; i < end; i += CGT_LANES) {
            const vfloat w =
                spu_mul(spu_sub(spux_load(p->org[main] + i), spux_vfloat(l->reference[main])), spux_vfloat(l->sign));
            const vfloat v = spu_sub(spux_load(p->org[a] + i), spux_vfloat(l->reference[a]));
            const vfloat offset = spu_nmsub(spux_vfloat(slope), w, v);
            low_w = spux_min(low_w, w);
            least = spux_min(least, offset);
            most = spux_max(most, offset);
        }
        f->slope[k - 1][0] = f->slope[k - 1][1] = slope;
        f->offset[k - 1][0] = spux_hmin(least);
        f->offset[k - 1][1] = spux_hmax(most);
    }
    f->w[0] = spux_hmin(low_w);
    f->w[1] = INFINITY;
    light_frustum_finish(l, f);
}

/* Whether all rays stay between their points and the light. */
static bool light_ranges_fit(const packet *p)
{
    vmask beyond = spux_mask_none();
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        beyond = spu_or(beyond, spu_cmpgt(spux_vfloat(0), spux_load(p->t_min + i)));
        if (p->to_light)
            beyond = spu_or(beyond, spu_cmpgt(spux_load(p->t_max + i), spux_vfloat(1)));
    }
    return spux_none(beyond);
}

static bool light_packet_make(const cgt_world *world, light_packet *l)
{
    const packet *p = &l->rays;
    if (p->extreme || !light_ranges_fit(p) || !light_orient(world, p, l))
        return false;
    l->open = 0;
    for (uint32_t first = 0, group = 0; first < p->lanes; first += LIGHT_GROUP, group++) {
        const uint32_t end = p->lanes < first + LIGHT_GROUP ? p->lanes : first + LIGHT_GROUP;
        if (!p->to_light)
            light_frustum_parallel(p, l, first, end, &l->group[group]);
        else if (!light_frustum_place(p, l, first, end, &l->group[group]))
            return false;
        vmask closed = spux_mask_all();
        for (uint32_t i = first; i < end; i += CGT_LANES) {
            lane_rays_of_packet(p, i, world->scale, &l->lane[i / CGT_LANES]);
            closed = spu_and(closed, spu_cmpeq(spux_load(p->high + i), spux_vfloat(-INFINITY)));
        }
        l->open |= (unsigned)!spux_all(closed) << group;
    }
    l->all = l->group[0];
    for (uint32_t g = 1; g < (p->lanes + LIGHT_GROUP - 1) / LIGHT_GROUP; g++) {
        const light_frustum *f = &l->group[g];
        for (int a = 0; a < 2; a++) {
            l->all.slope[a][0] = f->slope[a][0] < l->all.slope[a][0] ? f->slope[a][0] : l->all.slope[a][0];
            l->all.slope[a][1] = larger(f->slope[a][1], l->all.slope[a][1]);
            l->all.offset[a][0] = f->offset[a][0] < l->all.offset[a][0] ? f->offset[a][0] : l->all.offset[a][0];
            l->all.offset[a][1] = larger(f->offset[a][1], l->all.offset[a][1]);
        }
        l->all.w[0] = f->w[0] < l->all.w[0] ? f->w[0] : l->all.w[0];
        l->all.w[1] = larger(f->w[1], l->all.w[1]);
    }
    return true;
}

/* ---- nodes and leaves ---- */

/* Children that the frustum may meet, as bits. */
CGT_SPU_INLINE unsigned light_children(const light_packet *l, const wide_node *node)
{
    const light_frustum *f = &l->all;
    const int main = l->axis[0];
    const vfloat at = spux_vfloat(l->reference[main]);
    const bool back = l->sign < 0;
    const vfloat below = spu_sub(spux_load(node->low[main]), at), above = spu_sub(spux_load(node->high[main]), at);
    const vfloat minus = spux_vfloat(-0.f);
    const vfloat w0 = back ? spu_xor(above, minus) : below, w1 = back ? spu_xor(below, minus) : above;
    vmask out = spu_or(spu_cmpgt(spux_vfloat(f->w[0]), w1), spu_cmpgt(w0, spux_vfloat(f->w[1])));
    for (int k = 0; k < 2; k++) {
        const int a = l->axis[k + 1];
        const vfloat reference = spux_vfloat(l->reference[a]);
        const vfloat low = spu_sub(spux_load(node->low[a]), reference);
        const vfloat high = spu_sub(spux_load(node->high[a]), reference);
        const vfloat s0 = spux_vfloat(f->slope[k][0]), s1 = spux_vfloat(f->slope[k][1]);
        const vfloat most = spu_sub(high, spux_min(spu_mul(s0, w0), spu_mul(s0, w1)));
        const vfloat least = spu_sub(low, spux_max(spu_mul(s1, w0), spu_mul(s1, w1)));
        out = spu_or(
            out, spu_or(spu_cmpgt(spux_vfloat(f->offset[k][0]), most), spu_cmpgt(least, spux_vfloat(f->offset[k][1]))));
    }
    return ~spux_mask_bits(out) & (CGT_ALL_LANES >> (CGT_LANES - node->children));
}

/* A leaf's primitives in the frustum's coordinates. */
typedef struct light_primitives {
    vfloat w[3], v[2][3]; /* of each vertex; of a sphere's centre, thrice */
    vfloat radius;
    float scale; /* that they are multiplied with */
} light_primitives;

CGT_SPU_INLINE void light_place(const light_packet *l, const float point[3][CGT_LANES], float scale, vfloat w[1],
                                vfloat v[2])
{
    const int main = l->axis[0];
    w[0] = spu_mul(spu_sub(spux_load(point[main]), spux_vfloat(l->reference[main] * scale)), spux_vfloat(l->sign));
    for (int k = 0; k < 2; k++)
        v[k] = spu_sub(spux_load(point[l->axis[k + 1]]), spux_vfloat(l->reference[l->axis[k + 1]] * scale));
}

CGT_SPU_INLINE void light_place_spheres(const light_packet *l, const wide_spheres *s, light_primitives *q)
{
    vfloat v[2];
    light_place(l, s->center, 1, q->w, v);
    for (int k = 0; k < 3; k++) {
        q->w[k] = q->w[0];
        q->v[0][k] = v[0];
        q->v[1][k] = v[1];
    }
    q->radius = spux_load(s->radius);
    q->scale = 1;
}

CGT_SPU_INLINE void light_place_triangles(const light_packet *l, const wide_triangles *s, float scale,
                                          light_primitives *q)
{
    vfloat v[2];
    light_place(l, s->vertex, scale, q->w, v);
    for (int k = 0; k < 3; k++) {
        const vfloat sign = spux_vfloat(l->sign);
        q->w[k] = k ? spu_madd(spux_load(s->edge[k - 1][l->axis[0]]), sign, q->w[0]) : q->w[0];
        for (int a = 0; a < 2; a++)
            q->v[a][k] = k ? spu_add(spux_load(s->edge[k - 1][l->axis[a + 1]]), v[a]) : v[a];
    }
    q->radius = spux_vfloat(0);
    q->scale = scale;
}

/* Primitives of a leaf that a frustum may meet. */
CGT_SPU_INLINE vmask light_meets(const light_frustum *f, const light_primitives *q, int vertices)
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
        vfloat most = spu_nmsub(s0, q->w[0], q->v[a][0]), least = spu_nmsub(s1, q->w[0], q->v[a][0]);
        for (int k = 1; k < vertices; k++) {
            most = spux_max(most, spu_nmsub(s0, q->w[k], q->v[a][k]));
            least = spux_min(least, spu_nmsub(s1, q->w[k], q->v[a][k]));
        }
        const vfloat wide0 = spu_mul(q->radius, spux_vfloat(f->length[a][0]));
        const vfloat wide1 = spu_mul(q->radius, spux_vfloat(f->length[a][1]));
        out = spu_or(out, spu_cmpgt(spu_mul(spux_vfloat(f->offset[a][0]), scale), spu_add(most, wide0)));
        out = spu_or(out, spu_cmpgt(spu_sub(least, wide1), spu_mul(spux_vfloat(f->offset[a][1]), scale)));
    }
    return spux_not(out);
}

CGT_SPU_INLINE bool test_sphere(const lane_rays *r, const wide_spheres *s, uint32_t k, lane_hits *q)
{
    const vfloat center[3] = {spux_vfloat(s->center[0][k]), spux_vfloat(s->center[1][k]), spux_vfloat(s->center[2][k])};
    return lane_sphere(r, center, spux_vfloat(s->radius[k]), q);
}

CGT_SPU_INLINE bool test_triangle(const lane_rays *r, const wide_triangles *s, uint32_t k, lane_hits *q)
{
    lane_triangles t;
    for (int a = 0; a < 3; a++) {
        t.vertex[a] = spux_vfloat(s->vertex[a][k]);
        t.edge[0][a] = spux_vfloat(s->edge[0][a][k]);
        t.edge[1][a] = spux_vfloat(s->edge[1][a][k]);
    }
    t.sum[0] = spux_vfloat(s->sum[0][k]);
    t.sum[1] = spux_vfloat(s->sum[1][k]);
    return lane_triangle(r, &t, q);
}

/* Closes the rays that hit for certain, and decides the open ones. */
CGT_SPU_INLINE void light_keep(const light_call *c, packet *p, uint32_t i, uint32_t object, const lane_hits *q)
{
    const vfloat high = spux_load(p->high + i), closed = spux_vfloat(-INFINITY);
    const vmask met = spu_cmpgt(q->low, high);
    vmask certain = spu_andc(spu_andc(q->certain, met), spu_cmpgt(q->high, high));
    if (p->selective)
        certain = spu_andc(certain, select_left_out_of_one(&c->world->objects, p, i, object));
    spux_store_uint(p->object + i, spux_select(spux_load_uint(p->object + i), spux_vuint(object), certain));
    spux_store(p->high + i, spux_select(high, closed, certain));
    const vmask open = spu_andc(spu_andc(spu_or(q->certain, q->open), met), certain);
    for (unsigned left = spux_mask_bits(open); left; left &= left - 1)
        filter_decide(&c->world->objects, p, i + (uint32_t)__builtin_ctz(left), object, c->counts);
}

CGT_SPU_INLINE void light_test_group(const light_call *c, light_packet *l, uint32_t group, const wide_spheres *spheres,
                                     const wide_triangles *triangles, unsigned left)
{
    packet *p = &l->rays;
    const uint32_t first = group * LIGHT_GROUP, end = p->lanes < first + LIGHT_GROUP ? p->lanes : first + LIGHT_GROUP;
    const uint32_t count = spux_count_bits(left);
    vmask open = spux_mask_none();
    c->counts->packet_tests += count;
    c->counts->ray_tests += (uint64_t)count * (end - first);
    l->work += count;
    for (; left; left &= left - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(left);
        for (uint32_t i = first; i < end; i += CGT_LANES) {
            const lane_rays *r = &l->lane[i / CGT_LANES];
            lane_hits q;
            if (spheres) {
                if (test_sphere(r, spheres, k, &q))
                    light_keep(c, p, i, spheres->object[k], &q);
            } else if (test_triangle(r, triangles, k, &q))
                light_keep(c, p, i, triangles->object[k], &q);
        }
    }
    for (uint32_t i = first; i < end; i += CGT_LANES)
        open = spu_or(open, spu_cmpgt(spux_load(p->high + i), spux_vfloat(-INFINITY)));
    if (spux_none(open))
        l->open &= ~(1u << group);
}

static void light_test_leaf(const light_call *c, light_packet *l, uint32_t code)
{
    const cgt_wide_tree *tree = &c->world->wide;
    const uint32_t block = code & CGT_WIDE_INDEX, count = wide_leaf_count(code);
    const bool of_triangles = code & CGT_WIDE_TRIANGLES;
    const wide_spheres *spheres = of_triangles ? NULL : (const wide_spheres *)tree->sphere + block;
    const wide_triangles *triangles = of_triangles ? (const wide_triangles *)tree->triangle + block : NULL;
    const unsigned used = CGT_ALL_LANES >> (CGT_LANES - count);
    light_primitives q;
    c->counts->leaves++;
    if (spheres)
        light_place_spheres(l, spheres, &q);
    else
        light_place_triangles(l, triangles, c->world->scale, &q);
    for (unsigned groups = l->open; groups; groups &= groups - 1) {
        const uint32_t group = (uint32_t)__builtin_ctz(groups);
        const vmask meets = spheres ? light_meets(&l->group[group], &q, 1) : light_meets(&l->group[group], &q, 3);
        const unsigned left = spux_mask_bits(meets) & used;
        c->counts->cull_tests += count;
        c->counts->culled += count - spux_count_bits(left);
        l->work++;
        if (!left)
            continue;
        if (spheres)
            light_test_group(c, l, group, spheres, NULL, left);
        else
            light_test_group(c, l, group, NULL, triangles, left);
    }
}

/* False where it took too much work: what was found by then is right, the rest is not known. */
static bool light_traverse(const light_call *c, light_packet *l)
{
    const wide_node *nodes = c->world->wide.node;
    uint32_t stack[LIGHT_STACK], top = 0, code = 0;
    l->work = 0;
    while (l->open) {
        if (l->work > LIGHT_TOO_MUCH)
            return false;
        if (code & CGT_WIDE_LEAF) {
            light_test_leaf(c, l, code);
        } else {
            const wide_node *node = &nodes[code];
            c->counts->nodes++;
            l->work++;
            for (unsigned left = light_children(l, node); left; left &= left - 1)
                stack[top++] = node->child[__builtin_ctz(left)];
        }
        if (!top)
            return true;
        code = stack[--top];
    }
    return true;
}

/* ---- points ---- */

/* Rays as structure of arrays. */
typedef struct light_rays {
    float org[3][CGT_RAYS_CHUNK], dir[3][CGT_RAYS_CHUNK], t_min[CGT_RAYS_CHUNK], t_max[CGT_RAYS_CHUNK];
    uint32_t mask[CGT_RAYS_CHUNK], primitive[CGT_RAYS_CHUNK], geometry[CGT_RAYS_CHUNK];
} light_rays;

static const uint32_t *copy_numbers(const light_call *c, const uint32_t *from, uint64_t first, uint32_t count,
                                    uint32_t *to)
{
    if (!from)
        return NULL;
    for (uint32_t k = 0; k < count; k++)
        to[k] = ray_number(&c->source, from, first + k);
    return to;
}

/* Points first to end - 1 as rays like any others. */
__attribute__((noinline)) static void trace_apart(const light_call *c, uint64_t first, uint64_t end)
{
    light_rays own;
    const cgt_rays *points = c->source.rays;
    const uint32_t count = (uint32_t)(end - first);
    cgt_rays rays = {.count = count,
                     .t_min = own.t_min,
                     .t_max = own.t_max,
                     .mask = copy_numbers(c, points->mask, first, count, own.mask),
                     .ignored_primitive = copy_numbers(c, points->ignored_primitive, first, count, own.primitive),
                     .ignored_geometry = copy_numbers(c, points->ignored_geometry, first, count, own.geometry)};
    for (int a = 0; a < 3; a++) {
        for (uint32_t k = 0; k < count; k++) {
            own.org[a][k] = ray_element(&c->source, points->org[a], first + k);
            own.dir[a][k] = ray_direction(&c->source, first + k, a, own.org[a][k]);
        }
        rays.org[a] = own.org[a];
        rays.dir[a] = own.dir[a];
    }
    for (uint32_t k = 0; k < count; k++) {
        own.t_min[k] = points->t_min ? ray_element(&c->source, points->t_min, first + k) : 0;
        own.t_max[k] = points->t_max ? ray_element(&c->source, points->t_max, first + k) : c->source.t_max;
    }
    CGT_KERNEL(cgt_wide_trace_rays)(c->world, &rays, 0, count, c->settings, NULL, c->occluded + first, c->counts);
    c->counts->rays -= count; /* the call has counted them */
}

/* A whole packet of points that lie one behind the other, all of them rays as they should be: else false, and they are
 * read one by one. */
static bool read_packet(const light_call *c, uint32_t first, packet *p)
{
    const cgt_rays *points = c->source.rays;
    const uint64_t at = c->order.first + first;
    const bool ends = c->light.w == 1;
    vmask good = spux_mask_all();
    p->lanes = p->rays = LIGHT_RAYS;
    p->common_origin = p->from_origin = p->extreme = p->selective = p->masked = false;
    p->to_light = ends;
    for (uint32_t i = 0; i < LIGHT_RAYS; i += CGT_LANES) {
        vfloat zero = spux_vfloat(0), largest = zero, longest = zero, dd = zero;
        for (int a = 0; a < 3; a++) {
            const vfloat light = spux_vfloat(c->light.position[a]);
            const vfloat o = spux_load_unaligned(points->org[a] + at + i), d = ends ? spu_sub(light, o) : light;
            zero = spu_madd(o, spux_vfloat(0), zero); /* not a number where o is not finite */
            largest = spux_max(largest, spux_abs(o));
            longest = spux_max(longest, spux_abs(d));
            dd = spu_add(dd, spu_mul(d, d));
            spux_store(p->org[a] + i, o);
            spux_store(p->dir[a] + i, d);
        }
        const vfloat t_min = points->t_min ? spux_load_unaligned(points->t_min + at + i) : spux_vfloat(0);
        const vfloat t_max = points->t_max ? spux_load_unaligned(points->t_max + at + i) : spux_vfloat(c->source.t_max);
        good = spu_and(good, spu_cmpeq(zero, spux_vfloat(0)));
        good = spu_and(good, spu_and(spux_cmpge(t_max, t_min), spux_cmpge(t_min, spux_vfloat(0))));
        good = spu_and(good, spu_and(spux_cmpge(spux_vfloat(PACKET_LARGEST), spux_max(largest, longest)),
                                     spux_cmpge(longest, spux_vfloat(PACKET_SHORTEST))));
        spux_store(p->rdd + i, spux_div(spux_vfloat(1), dd));
        spux_store(p->t_min + i, t_min);
        spux_store(p->t_max + i, t_max);
        spux_store(p->low + i, t_max);
        spux_store(p->high + i, t_max);
        spux_store_uint(p->object + i, spux_vuint(CGT_NONE));
    }
    for (int a = 0; a < 3; a++)
        p->light[a] = c->light.position[a];
    return spux_all(good);
}

/* Points first to first + count - 1 of the order, and the work that they took. False where it was too much: then they
 * are as they were before. */
static bool trace_points(const light_call *c, light_packet *l, uint32_t first, uint32_t count, uint64_t *work)
{
    const cgt_rays *points = c->source.rays;
    const uint64_t invalid = c->counts->invalid_rays;
    const bool dense =
        count == LIGHT_RAYS && c->source.stride == sizeof(float) && !points->mask && !points->ignored_primitive;
    if (!(dense && read_packet(c, first, &l->rays)) &&
        !ray_packet_make(c->world, &c->source, &c->order, first, count, &l->rays, c->counts)) {
        for (uint32_t k = 0; k < count; k++)
            if (!trace_points(c, l, first + k, 1, work)) {
                c->counts->invalid_rays = invalid;
                return false;
            }
        return true;
    }
    if (l->rays.rays && light_packet_make(c->world, l)) {
        const bool done = light_traverse(c, l);
        c->counts->packets++;
        c->counts->wide_rays += done ? count : 0;
        *work += l->work;
        if (!done) {
            c->counts->invalid_rays = invalid;
            return false;
        }
    } else
        CGT_KERNEL(cgt_packet_trace)(c->world, &l->rays, c->settings, c->counts);
    for (uint32_t k = 0; k < count; k++)
        c->occluded[ray_at(&c->order, first + k)] = l->rays.object[k] != CGT_NONE;
    return true;
}

void CGT_KERNEL(cgt_wide_trace_light)(const cgt_world *world, const cgt_rays *points, const cgt_light *light,
                                      uint64_t first, uint64_t end, const cgt_trace_settings *settings,
                                      uint8_t *occluded, cgt_counts *counts)
{
    light_packet l;
    const light_call c = {.world = world,
                          .source = ray_source_make(points, light),
                          .light = *light,
                          .order = {first, NULL},
                          .settings = settings,
                          .occluded = occluded,
                          .counts = counts};
    const uint32_t count = (uint32_t)(end - first);
    uint32_t done = 0;
    uint64_t work = 0;
    l.rays.any_hit = true;
    l.rays.fast = false;
    counts->rays += count;
    while (done < count && (done < LIGHT_TRIED * LIGHT_RAYS || LIGHT_RAYS * work <= (uint64_t)LIGHT_WORK * done)) {
        const uint32_t more = count - done < LIGHT_RAYS ? count - done : LIGHT_RAYS;
        if (!trace_points(&c, &l, done, more, &work))
            break;
        done += more;
    }
    for (uint32_t k = 0; k < done; k++)
        counts->hits += occluded[first + k];
    if (done < count)
        trace_apart(&c, first + done, end);
}

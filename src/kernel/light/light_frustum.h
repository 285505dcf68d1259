/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A packet of rays to one light, and the frustum that all of them lie in, with its tip at the light or, of parallel
 * rays, with parallel sides: four planes and two ends, against which a node's children are tested at once, and a leaf's
 * primitives.
 *
 * The rays run mostly along one axis, the main one: w is the coordinate along it, seen from the reference (the light,
 * or the first point of parallel rays) and mirrored where they run against it, v that along another axis. Each ray's
 * line is v = slope w + offset, the offset 0 with a light at a place, the slope common without. So a plane is
 *     v - a w <= h,  a the largest slope and h the largest offset, and the like with the smallest
 * Margin. Let M be the sum of the largest coordinates, along any axis, of light, points and objects, and u = 2^-24.
 * Differences are within 2 u M. A slope is within 2 u of itself and of what v and w bring, so that the line is at most
 * 8 u M off between a point and the light, and 16 u M beyond a parallel ray's point as far as objects are, slopes being
 * at most 2. A canonical ray points past the light by u of its way, and t is rounded before it is compared with the
 * range. Of v - a w three operations round numbers below 8 M. The margin is 2^-17 M (1 + |a|), more than all of that.
 * */
#ifndef CGT_LIGHT_FRUSTUM_H
#define CGT_LIGHT_FRUSTUM_H

#include "kernel/packet/ray_packet.h"
#include "kernel/bvh/bvh_node.h"
#include "kernel/tunables.h"

#define LIGHT_MAX_SLOPE 2.f

/* Rays lie between the planes v - slope[a][0] w >= offset[a][0] and v - slope[a][1] w <= offset[a][1], for both axes a,
 * and between two w. Margins are in it. */
typedef struct light_frustum {
    float slope[2][2], offset[2][2];
    float length[2][2]; /* of each plane's normal, rounded up */
    float w[2];
} light_frustum;

typedef struct light_packet {
    packet rays;
    light_frustum frustum;
    _Alignas(CGT_VECTOR_BYTES) float ray_terms[3][PACKET_MAX_RAYS]; /* x, see light_leaf.h */
    float square[PACKET_MAX_RAYS];                                  /* d.d */
    float max_component, max_sum; /* of all x: the largest component, and the largest sum of their sizes */
    bool default_ranges;          /* every range is from 0, to 1 at a light that has a place, to infinity else */
    uint64_t undecided;           /* vectors with rays that have met nothing, as bits */
    int axis[3];                  /* the main one first */
    float sign;                   /* of the way from the reference along it */
    float origin[3];
    float margin;       /* without 1 + |a| */
    uint32_t last_leaf; /* the leaf that closed the last rays of the packet before; 0: none */
    uint64_t work;
} light_packet;

static float light_max(float a, float b) { return a > b ? a : b; }

/* The main axis and the reference, by any ray that takes part. False where there is no common way. */
static bool light_init_axes(const packet *p, const float org[3], const float dir[3], light_packet *l)
{
    const bool is_point = p->to_light;
    float upper = 0;
    l->axis[0] = 0;
    for (int a = 0; a < 3; a++) {
        const float d = is_point ? org[a] - p->light[a] : dir[a];
        if (fabsf(d) > upper) {
            upper = fabsf(d);
            l->axis[0] = a;
            l->sign = d < 0 ? -1 : 1;
        }
        l->origin[a] = is_point ? p->light[a] : org[a];
    }
    l->axis[1] = (l->axis[0] + 1) % 3;
    l->axis[2] = (l->axis[0] + 2) % 3;
    return upper > 0;
}

/* The same by the last lane: a ray that takes part, or a copy of one. */
static bool light_init_axes_from_last(light_packet *l)
{
    const packet *p = &l->rays;
    const uint32_t last_lane = p->lanes - 1;
    const float org[3] = {p->org[0][last_lane], p->org[1][last_lane], p->org[2][last_lane]};
    const float dir[3] = {p->dir[0][last_lane], p->dir[1][last_lane], p->dir[2][last_lane]};
    return light_init_axes(p, org, dir, l);
}

/* farthest: lanes with the largest sizes of points along each axis. */
CGT_SPU_INLINE void light_set_margin(const cgt_committed_scene *committed_scene, const vfloat max_org[3],
                                     light_packet *l)
{
    float magnitude = 0;
    for (int a = 0; a < 3; a++)
        magnitude = light_max(magnitude, light_max(fabsf(committed_scene->low[a]), fabsf(committed_scene->high[a])) +
                                             spux_hmax(max_org[a]) + fabsf(l->origin[a]));
    l->margin = magnitude * LIGHT_MARGIN;
}

static void light_compute_margin(const cgt_committed_scene *committed_scene, const packet *p, light_packet *l)
{
    vfloat max_org[3];
    for (int a = 0; a < 3; a++) {
        max_org[a] = spux_vfloat(0);
        for (uint32_t i = 0; i < p->lanes; i += CGT_LANES)
            max_org[a] = spux_max(max_org[a], spux_abs(spux_load(p->org[a] + i)));
    }
    light_set_margin(committed_scene, max_org, l);
}

/* Adds margins. */
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

/* Rays to a light at a place. False where they leave too many directions to it. */
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

/* The same with parallel rays. */
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

/* Whether all rays stay between their points and the light. */
static bool light_check_ranges(const packet *p, light_packet *l)
{
    const vfloat end = spux_vfloat(p->to_light ? 1 : INFINITY);
    vmask beyond = spux_mask_none(), other = spux_mask_none();
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const vfloat t_min = spux_load(p->t_min + i), t_max = spux_load(p->t_max + i);
        beyond = spu_or(beyond, spu_or(spu_cmpgt(spux_vfloat(0), t_min), spu_cmpgt(t_max, end)));
        other = spu_or(other, spu_or(spu_cmpgt(t_min, spux_vfloat(0)), spu_cmpgt(end, t_max)));
    }
    l->default_ranges = spux_none(other);
    return spux_none(beyond);
}

/* What the tests of leaves take. */
static void light_compute_terms(const packet *p, float scale, light_packet *l)
{
    vfloat max_component = spux_vfloat(0), max_sum = spux_vfloat(0);
    l->undecided = 0;
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        vfloat sum = spux_vfloat(0), square = spux_vfloat(0);
        for (int a = 0; a < 3; a++) {
            const vfloat d = spux_load(p->dir[a] + i);
            const vfloat x = spu_mul(p->to_light ? d : spu_sub(spux_load(p->org[a] + i), spux_vfloat(l->origin[a])),
                                     spux_vfloat(scale));
            square = spu_madd(d, d, square);
            max_component = spux_max(max_component, spux_abs(x));
            sum = spu_add(sum, spux_abs(x));
            spux_store(l->ray_terms[a] + i, x);
        }
        max_sum = spux_max(max_sum, sum);
        spux_store(l->square + i, square);
        l->undecided |= (uint64_t)spux_any(spu_cmpgt(spux_load(p->high + i), spux_vfloat(-INFINITY))) << i / CGT_LANES;
    }
    l->max_component = spux_hmax(max_component);
    l->max_sum = spux_hmax(max_sum);
}

__attribute__((unused)) static bool light_packet_init(const cgt_committed_scene *committed_scene, light_packet *l)
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
    return true;
}

/* Children that the frustum may meet, as bits. */
CGT_SPU_INLINE unsigned light_visible_children(const light_packet *l, const bvh_node *node)
{
    const light_frustum *f = &l->frustum;
    const int main = l->axis[0];
    const vfloat main_origin = spux_vfloat(l->origin[main]);
    const bool reversed = l->sign < 0;
    const vfloat below = spu_sub(spux_load(node->low[main]), main_origin),
                 above = spu_sub(spux_load(node->high[main]), main_origin);
    const vfloat minus = spux_vfloat(-0.f);
    const vfloat w0 = reversed ? spu_xor(above, minus) : below, w1 = reversed ? spu_xor(below, minus) : above;
    vmask out = spu_or(spu_cmpgt(spux_vfloat(f->w[0]), w1), spu_cmpgt(w0, spux_vfloat(f->w[1])));
    for (int k = 0; k < 2; k++) {
        const int a = l->axis[k + 1];
        const vfloat origin = spux_vfloat(l->origin[a]);
        const vfloat low = spu_sub(spux_load(node->low[a]), origin);
        const vfloat high = spu_sub(spux_load(node->high[a]), origin);
        const vfloat s0 = spux_vfloat(f->slope[k][0]), s1 = spux_vfloat(f->slope[k][1]);
        const vfloat upper = spu_sub(high, spux_min(spu_mul(s0, w0), spu_mul(s0, w1)));
        const vfloat lower = spu_sub(low, spux_max(spu_mul(s1, w0), spu_mul(s1, w1)));
        out = spu_or(out, spu_or(spu_cmpgt(spux_vfloat(f->offset[k][0]), upper),
                                 spu_cmpgt(lower, spux_vfloat(f->offset[k][1]))));
    }
    return ~spux_mask_bits(out) & (CGT_ALL_LANES >> (CGT_LANES - node->children));
}

/* A leaf's primitives in the frustum's coordinates. */
typedef struct light_primitives {
    vfloat w[3], v[2][3]; /* of each vertex; of a sphere's centre, thrice */
    vfloat radius;
    float scale; /* that they are multiplied with */
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
    q->scale = scale;
}

/* Primitives of a leaf that a frustum may meet. */
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

#endif

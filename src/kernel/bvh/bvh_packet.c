/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays of a packet through the wide tree, one at a time. In FAST precision too the hits are decided exactly. */
#include "kernel/bvh/bvh_single.h"

/* Ray i, normalised. Returns false where the bounds do not cover it. */
CGT_SPU_INLINE bool packet_ray_make(const wide_call *c, uint32_t i, wide_ray *r)
{
    const packet *p = c->p;
    float longest = 0, farthest = 0, org[3], slack[3], rdir[3];
    uint32_t bits, inverse_bits;
    float power, inverse; /* 2^k and 2^-k */
    for (int a = 0; a < 3; a++)
        longest = fabsf(p->dir[a][i]) > longest ? fabsf(p->dir[a][i]) : longest;
    memcpy(&bits, &longest, sizeof bits);
    bits &= 0x7f800000; /* of a normal number: packets of others are extreme */
    inverse_bits = 0x7f000000 - bits;
    memcpy(&power, &bits, sizeof power);
    memcpy(&inverse, &inverse_bits, sizeof inverse);
    const float speed = power * c->scale;
    for (int a = 0; a < 3; a++) {
        r->org[a] = p->org[a][i] * c->scale;
        r->dir[a] = p->dir[a][i] * inverse;
        org[a] = fabsf(r->org[a]);
        farthest = org[a] > farthest ? org[a] : farthest;
        rdir[a] = 1 / (fabsf(r->dir[a]) < WIDE_FLAT ? copysignf(WIDE_FLAT, r->dir[a]) : r->dir[a]);
    }
    const float t_min = p->t_min[i], t_max = p->t_max[i];
    r->near = (t_min - fabsf(t_min) * 0x1p-20f) * speed - 0x1p-86f;
    r->far = (t_max + fabsf(t_max) * 0x1p-20f) * speed + 0x1p-86f;
    r->near = r->near > -WIDE_LARGEST_T ? r->near : -WIDE_LARGEST_T;
    r->far = r->far < WIDE_LARGEST_T ? r->far : WIDE_LARGEST_T;
    r->number = i;
    r->best = (wide_best){r->far - fabsf(r->far) * 0x1p-18f - 0x1p-84f, r->far, CGT_INVALID_ID, 0};
    wide_slack(c, org, slack);
    wide_ray_planes(c, rdir, slack, r);
    return farthest <= WIDE_LARGEST_ORG && speed <= 0x1p60f && speed >= 0x1p-100f;
}

/* A ray that takes part, against every object. */
__attribute__((noinline, cold)) static void packet_ray_extreme(const wide_call *c, packet *p, uint32_t i)
{
    const cgt_objects *objects = &c->world->objects;
    for (uint32_t object = 0; object < objects->count; object++) {
        const cgt_shape shape = cgt_objects_shape(objects, object);
        if (cgt_shape_check(&shape) == CGT_OBJECT_VALID && !wide_hidden(c, i, object))
            filter_decide(objects, p, i, object, c->counts);
    }
}

CGT_SPU_INLINE void packet_trace_rays(const wide_call *c, packet *p, bool any_hit)
{
    for (uint32_t i = 0; i < p->lanes; i++) {
        wide_ray r;
        if (p->high[i] == -INFINITY || p->t_min[i] > FLT_MAX || p->t_max[i] < -FLT_MAX)
            continue; /* takes no part, or no t is in its range */
        c->counts->packets++;
        if (c->scale > 0x1p60f || c->scale < 0x1p-60f || !packet_ray_make(c, i, &r)) {
            packet_ray_extreme(c, p, i);
            continue;
        }
        wide_single_trace(c, &r, 0, any_hit);
        if (r.best.object == CGT_INVALID_ID)
            continue;
        p->object[i] = r.best.object;
        p->low[i] = p->high[i] = -INFINITY; /* settled */
    }
}

void CGT_KERNEL(cgt_wide_trace)(const cgt_world *world, packet *p, const cgt_trace_settings *settings,
                                cgt_counts *counts)
{
    wide_call c;
    (void)settings;
    p->fast = false; /* decided exactly, and so resolved as ROBUST is */
    wide_call_make(world, counts, &c);
    c.p = p;
    counts->bvh_rays += p->rays;
    c.any_hit = p->any_hit;
    if (p->selective) {
        c.hides = true;
        c.ignored = p->ignored;
        c.mask = p->masked ? p->mask : NULL;
    }
    if (p->any_hit)
        packet_trace_rays(&c, p, true);
    else
        packet_trace_rays(&c, p, false);
}

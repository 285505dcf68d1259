/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decides doubts. */
#include "cell/ppe/doubts.h"

cgt_ray cgt_doubts_ray(const cgt_doubts *d, uint32_t x, uint32_t y)
{
    cgt_ray ray = {.t_min = d->rays->t_min, .t_max = d->rays->t_max};
    cgt_camera_pixel(d->rays, x, y, ray.line.org, ray.line.dir);
    return ray;
}

bool cgt_doubts_hit(cgt_doubts *d, const cgt_ray *ray, uint32_t object)
{
    cgt_decided_hit hit;
    uint64_t exact = 0;
    if (!d->get(d->scene, object, &hit)) {
        d->bad++;
        return false;
    }
    const bool is_hit = cgt_decide_hit(ray, &hit, &exact);
    d->exact += exact != 0;
    return is_hit;
}

/* Whether the ray hits `hit`, which is `object`, and before `best`, which it hits unless that is CGT_INVALID_ID. */
static bool is_nearer(cgt_doubts *d, const cgt_ray *ray, cgt_decided_hit hit, uint32_t object, uint32_t best)
{
    uint64_t exact = 0;
    cgt_decided_hit other;
    bool nearer = cgt_decide_hit(ray, &hit, &exact);
    if (nearer && best != CGT_INVALID_ID && d->get(d->scene, best, &other))
        nearer = cgt_decide_is_closer(ray, object, &hit, best, &other, &exact);
    d->exact += exact != 0;
    return nearer;
}

void cgt_doubts_keep(cgt_doubts *d, const cgt_ray *ray, uint32_t object, uint32_t *nearest)
{
    cgt_decided_hit hit;
    if (!d->get(d->scene, object, &hit))
        d->bad++;
    else if (*nearest != object && is_nearer(d, ray, hit, object, *nearest))
        *nearest = object;
}

void cgt_doubts_add(cgt_doubts *d, const cgt_doubt *doubt)
{
    const uint32_t x = doubt->pixel & 0xffff, y = doubt->pixel >> 16;
    d->doubts++;
    if (x >= d->rays->width || y >= d->rays->height) {
        d->bad++;
        return;
    }
    const cgt_ray ray = cgt_doubts_ray(d, x, y);
    cgt_doubts_keep(d, &ray, doubt->object, &d->nearest[(size_t)y * d->rays->width + x]);
}

uint32_t cgt_doubts_merge(cgt_doubts *d, const cgt_ray *ray, uint32_t best, uint32_t nearest)
{
    cgt_decided_hit hit;
    if (best != CGT_INVALID_ID && !d->get(d->scene, best, &hit)) {
        d->bad++;
        best = CGT_INVALID_ID;
    }
    if (nearest == CGT_INVALID_ID || nearest == best || best == CGT_INVALID_ID)
        return nearest == CGT_INVALID_ID ? best : nearest;
    /* the nearest doubt is a hit: only the order is open */
    return d->get(d->scene, nearest, &hit) && is_nearer(d, ray, hit, nearest, best) ? nearest : best;
}

bool cgt_doubts_finish(cgt_doubts *d, uint32_t x, uint32_t y, uint32_t *id)
{
    const uint32_t before = *id;
    const cgt_ray ray = cgt_doubts_ray(d, x, y);
    *id = cgt_doubts_merge(d, &ray, before, d->nearest[(size_t)y * d->rays->width + x]);
    const bool changed = *id != CGT_INVALID_ID && *id != before;
    d->changed += changed;
    return changed;
}

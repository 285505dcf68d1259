/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decides doubts of triangles. */
#include "cell/ppe/kd/kd_doubts.h"

#include <string.h>

#include "scene/scene.h"

cgt_decided_hit cgt_kd_doubts_object(const cgt_kd_doubts *d, uint32_t object)
{
    uint32_t local = 0;
    const cgt_kd_scene_part *const part = cgt_kd_scene_find(d->scene, object, &local);
    return (cgt_decided_hit){.primitive = cgt_primitives_get(&part->scene->committed_scene.prims, local)};
}

cgt_ray cgt_kd_doubts_ray(const cgt_kd_doubts *d, uint32_t x, uint32_t y)
{
    cgt_ray ray = {.t_min = d->rays->t_min, .t_max = d->rays->t_max};
    cgt_camera_pixel(d->rays, x, y, ray.line.org, ray.line.dir);
    return ray;
}

/* Whether the id is that of a triangle of some part. */
static bool is_triangle(const cgt_kd_doubts *d, uint32_t object)
{
    if (!d->scene->parts || object < d->scene->part[0].first)
        return false;
    uint32_t local = 0;
    const cgt_kd_scene_part *const part = cgt_kd_scene_find(d->scene, object, &local);
    return local < part->scene->committed_scene.prims.count;
}

bool cgt_kd_doubts_hit(cgt_kd_doubts *d, const cgt_ray *ray, uint32_t object)
{
    if (!is_triangle(d, object)) {
        d->bad++;
        return false;
    }
    uint64_t exact = 0;
    cgt_decided_hit hit = cgt_kd_doubts_object(d, object);
    const bool is_hit = cgt_decide_hit(ray, &hit, &exact);
    d->exact += exact != 0;
    return is_hit;
}

/* Whether the ray hits `object`, and before `best`, which it hits unless that is CGT_INVALID_ID. */
static bool is_nearer(cgt_kd_doubts *d, const cgt_ray *ray, uint32_t object, uint32_t best)
{
    uint64_t exact = 0;
    cgt_decided_hit hit = cgt_kd_doubts_object(d, object);
    bool nearer = cgt_decide_hit(ray, &hit, &exact);
    if (nearer && best != CGT_INVALID_ID) {
        cgt_decided_hit other = cgt_kd_doubts_object(d, best);
        cgt_decide_t(ray, &other);
        const int order = cgt_decide_order(ray, &hit, &other, &exact);
        nearer = order < 0 || (order == 0 && object < best);
    }
    d->exact += exact != 0;
    return nearer;
}

void cgt_kd_doubts_init(cgt_kd_doubts *doubts, const cgt_camera_rays *rays, const cgt_kd_scene *scene,
                        uint32_t *nearest)
{
    *doubts = (cgt_kd_doubts){.rays = rays, .scene = scene, .nearest = nearest};
    memset(nearest, 0xff, (size_t)rays->width * rays->height * sizeof *nearest);
}

void cgt_kd_doubts_add(cgt_kd_doubts *doubts, const cgt_doubt *doubt)
{
    const uint32_t x = doubt->pixel & 0xffff, y = doubt->pixel >> 16;
    if (x >= doubts->rays->width || y >= doubts->rays->height) {
        doubts->bad++;
        return;
    }
    const cgt_ray ray = cgt_kd_doubts_ray(doubts, x, y);
    cgt_kd_doubts_keep(doubts, &ray, doubt->object, &doubts->nearest[(size_t)y * doubts->rays->width + x]);
}

void cgt_kd_doubts_keep(cgt_kd_doubts *doubts, const cgt_ray *ray, uint32_t object, uint32_t *nearest)
{
    if (!is_triangle(doubts, object))
        doubts->bad++;
    else if (*nearest != object && is_nearer(doubts, ray, object, *nearest))
        *nearest = object;
}

uint32_t cgt_kd_doubts_merge(cgt_kd_doubts *doubts, const cgt_ray *ray, uint32_t best, uint32_t nearest)
{
    if (best != CGT_INVALID_ID && !is_triangle(doubts, best)) {
        doubts->bad++;
        best = CGT_INVALID_ID;
    }
    if (nearest == CGT_INVALID_ID || nearest == best)
        return best;
    /* the nearest doubt is a hit: only the order is open */
    return best == CGT_INVALID_ID || is_nearer(doubts, ray, nearest, best) ? nearest : best;
}

bool cgt_kd_doubts_finish(cgt_kd_doubts *doubts, uint32_t x, uint32_t y, uint32_t *id)
{
    const uint32_t before = *id, nearest = doubts->nearest[(size_t)y * doubts->rays->width + x];
    const cgt_ray ray = cgt_kd_doubts_ray(doubts, x, y);
    *id = cgt_kd_doubts_merge(doubts, &ray, before, nearest);
    const bool changed = *id != CGT_INVALID_ID && *id != before;
    doubts->changed += changed;
    return changed;
}

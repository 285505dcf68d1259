/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decides doubts. */
#include "cell/ppe/grid/doubts.h"

#include <string.h>

#include "exact/decide.h"

static cgt_decided_hit object_of(const cgt_doubts *d, uint32_t object)
{
    const float *const q = d->scene->object[object];
    return (cgt_decided_hit){.primitive = {.kind = CGT_KIND_SPHERES, .sphere = {q[0], q[1], q[2], q[3]}}};
}

/* Whether the ray hits `object`, and before `best`, which it hits unless that is CGT_INVALID_ID. */
static bool is_nearer(cgt_doubts *d, const cgt_ray *ray, uint32_t object, uint32_t best)
{
    uint64_t exact = 0;
    cgt_decided_hit hit = object_of(d, object);
    bool nearer = cgt_decide_hit(ray, &hit, &exact);
    if (nearer && best != CGT_INVALID_ID) {
        cgt_decided_hit other = object_of(d, best);
        cgt_decide_t(ray, &other);
        const int order = cgt_decide_order(ray, &hit, &other, &exact);
        nearer = order < 0 || (order == 0 && object < best);
    }
    d->exact += exact != 0;
    return nearer;
}

static cgt_ray ray_of(const cgt_doubts *d, uint32_t x, uint32_t y)
{
    cgt_ray ray = {.t_min = d->rays->t_min, .t_max = d->rays->t_max};
    cgt_camera_pixel(d->rays, x, y, ray.line.org, ray.line.dir);
    return ray;
}

void cgt_doubts_init(cgt_doubts *doubts, const cgt_camera_rays *rays, const cgt_grid_scene *scene, uint32_t *nearest)
{
    *doubts = (cgt_doubts){.rays = rays, .scene = scene, .nearest = nearest};
    memset(nearest, 0xff, (size_t)rays->width * rays->height * sizeof *nearest);
}

void cgt_doubts_add(cgt_doubts *doubts, const cgt_doubt *doubt, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t x = doubt[i].pixel & 0xffff, y = doubt[i].pixel >> 16, object = doubt[i].object;
        if (doubts->light && CGT_DOUBT_SET(object)) {
            cgt_frame_light_doubt(doubts->light, &doubt[i]);
            continue;
        }
        doubts->doubts++;
        if (x >= doubts->rays->width || y >= doubts->rays->height || object >= doubts->scene->image.spheres) {
            doubts->bad++;
            continue;
        }
        uint32_t *const nearest = &doubts->nearest[(size_t)y * doubts->rays->width + x];
        const cgt_ray ray = ray_of(doubts, x, y);
        if (*nearest != object && is_nearer(doubts, &ray, object, *nearest))
            *nearest = object;
    }
}

void cgt_doubts_finish(cgt_doubts *doubts, uint32_t *ids, size_t stride)
{
    const uint32_t *nearest = doubts->nearest;
    for (uint32_t y = 0; y < doubts->rays->height; y++)
        for (uint32_t x = 0; x < doubts->rays->width; x++, nearest++) {
            uint32_t *const id = &ids[y * stride + x];
            if (*id != CGT_INVALID_ID && *id >= doubts->scene->image.spheres) {
                doubts->bad++;
                *id = CGT_INVALID_ID;
            }
            if (*nearest == CGT_INVALID_ID || *nearest == *id)
                continue;
            const cgt_ray ray = ray_of(doubts, x, y);
            /* the nearest doubt is a hit: only the order is open */
            if (*id == CGT_INVALID_ID || is_nearer(doubts, &ray, *nearest, *id)) {
                *id = *nearest;
                doubts->changed++;
                if (doubts->light)
                    doubts->light->decided[(size_t)y * doubts->rays->width + x] |= CGT_LIGHT_ALL;
            }
        }
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Secondary rays on the PPE: where they lie, and those of pixels whose hit a doubt changed, which are made and traced
 * again. */
#include <math.h>

#include "cell/ppe/kd/kd_frame_memory.h"
#include "scene/scene.h"

cgt_kd_secondary_tile *cgt_kd_frame_secondary(const kd_frame *f, uint32_t envelope, uint32_t batch)
{
    cgt_kd_secondary_tile *const first = f->array[KD_ARRAY_SECONDARY];
    return first + ((size_t)envelope * f->batches + batch) * f->tiles;
}

uint32_t *cgt_kd_frame_occlusion(const kd_frame *f, uint32_t envelope, uint32_t batch)
{
    uint32_t *const first = f->array[KD_ARRAY_OCCLUSION];
    return first + ((size_t)envelope * f->batches + batch) * ((f->tiles + 3) / 4 * 4);
}

cgt_ray cgt_kd_frame_secondary_ray(const kd_frame *f, const cgt_kd_secondary_tile *tile, uint32_t batch, uint32_t lane)
{
    const cgt_kd_frame_image *const i = &f->image;
    const bool light = batch < i->lights, mirror = cgt_kd_frame_is_mirror(f, batch);
    return (cgt_ray){.line = {.org = {tile->org[0][lane], tile->org[1][lane], tile->org[2][lane]},
                              .dir = {tile->dir[0][lane], tile->dir[1][lane], tile->dir[2][lane]}},
                     .t_min = light    ? i->light_t_min
                              : mirror ? i->mirror_t_min
                                       : i->ambient_t_min,
                     .t_max = light    ? 1
                              : mirror ? i->mirror_t_max
                                       : i->ambient_t_max};
}

/* ---- directions ---- */

static void normal_of(const cgt_triangle *q, double n[3])
{
    double e[2][3];
    for (int a = 0; a < 3; a++) {
        e[0][a] = (double)q->v[1][a] - (double)q->v[0][a];
        e[1][a] = (double)q->v[2][a] - (double)q->v[0][a];
    }
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        n[a] = e[0][b] * e[1][c] - e[0][c] * e[1][b];
    }
}

static double dot(const double n[3], const float d[3])
{
    return n[0] * (double)d[0] + n[1] * (double)d[1] + n[2] * (double)d[2];
}

/* The direction of an ambient ray, on the side of the triangle that `ray` comes from. */
static void ambient_direction(const kd_frame *f, const cgt_ray *ray, const cgt_triangle *q, uint32_t number, float d[3])
{
    double n[3];
    normal_of(q, n);
    for (int a = 0; a < 3; a++)
        d[a] = f->direction[16 + number % CGT_KD_DIRECTIONS][a];
    if ((dot(n, ray->line.dir) > 0) == (dot(n, d) > 0))
        for (int a = 0; a < 3; a++)
            d[a] = -d[a];
}

static void mirror_direction(const cgt_ray *ray, const cgt_triangle *q, float d[3])
{
    double n[3];
    normal_of(q, n);
    const double along = dot(n, ray->line.dir) / (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int a = 0; a < 3; a++)
        d[a] = (float)((double)ray->line.dir[a] - 2 * along * n[a]);
}

/* ---- again ---- */

/* A triangle's number through the whole image. */
static uint32_t number_of(const cgt_kd_scene_part *part, uint32_t geometry, uint32_t primitive)
{
    const cgt_primitives *const prims = &part->scene->committed_scene.prims;
    uint32_t k = 0;
    while (k + 1 < prims->arrays && prims->array[k].geometry != geometry)
        k++;
    return part->first + prims->array[k].first + primitive;
}

/* The first thing in a ray's way, or anything; CGT_INVALID_ID: nothing. */
static cgt_result trace_again(const kd_frame *f, const cgt_ray *ray, bool nearest, uint32_t *id)
{
    const cgt_rays rays = {.count = 1,
                           .org = {&ray->line.org[0], &ray->line.org[1], &ray->line.org[2]},
                           .dir = {&ray->line.dir[0], &ray->line.dir[1], &ray->line.dir[2]},
                           .t_min = &ray->t_min,
                           .t_max = &ray->t_max};
    const cgt_trace_options options = {.precision = CGT_PRECISION_EXACT};
    cgt_result result = CGT_OK;
    *id = CGT_INVALID_ID;
    for (uint32_t k = 0; k < f->scene->parts && *id == CGT_INVALID_ID && result == CGT_OK; k++) {
        const cgt_kd_scene_part *const part = &f->scene->part[k];
        uint8_t hit = 0;
        if (nearest) { /* there is one part then */
            uint32_t primitive = CGT_INVALID_ID, geometry = CGT_INVALID_ID;
            result = cgt_trace_rays(part->scene, &rays, &(cgt_hits){.primitive = &primitive, .geometry = &geometry},
                                    &options);
            if (primitive != CGT_INVALID_ID)
                *id = number_of(part, geometry, primitive);
        } else {
            result = cgt_occluded_rays(part->scene, &rays, &hit, &options);
            *id = hit ? 0 : CGT_INVALID_ID;
        }
    }
    return result;
}

/* The ray of a batch that leaves `hit`; false: its direction is beyond the bounds. */
static bool make_again(const kd_frame *f, const cgt_ray *from, const cgt_decided_hit *hit, uint32_t batch,
                       uint32_t number, cgt_kd_secondary_tile *to, uint32_t lane)
{
    float org[3], d[3], most = 0;
    for (int a = 0; a < 3; a++) {
        org[a] = (float)((double)from->line.org[a] + hit->t * (double)from->line.dir[a]);
        d[a] = batch < f->image.lights ? f->image.light[batch][a] - org[a] : 0;
    }
    if (cgt_kd_frame_is_mirror(f, batch))
        mirror_direction(from, &hit->primitive.triangle, d);
    else if (batch >= f->image.lights)
        ambient_direction(f, from, &hit->primitive.triangle, number + (batch - f->image.lights) * 27, d);
    for (int a = 0; a < 3; a++)
        most = fmaxf(most, fabsf(d[a]));
    const bool usual = most > 0x1p-20f && most < 0x1p20f;
    for (int a = 0; a < 3; a++) {
        to->org[a][lane] = usual ? org[a] : 0;
        to->dir[a][lane] = usual ? d[a] : 1;
    }
    return usual;
}

cgt_result cgt_kd_frame_secondary_again(kd_frame *f, uint32_t envelope, uint32_t tile, uint32_t lane, uint32_t id)
{
    for (uint32_t batch = 0; batch < f->batches; batch++) {
        cgt_kd_secondary_tile *const to = &cgt_kd_frame_secondary(f, envelope, batch)[tile];
        const uint32_t x = to->info.x + lane % 2, y = to->info.y + lane / 2, bit = 1u << lane;
        const cgt_ray from = cgt_doubts_ray(&f->run.doubts, x, y);
        cgt_decided_hit hit;
        uint32_t found = CGT_INVALID_ID;
        if (!cgt_kd_scene_get(f->scene, id, &hit)) /* a doubt that was decided names a triangle */
            return CGT_ERROR_STOPPED;
        cgt_decide_t(&from, &hit);
        const bool usual = make_again(f, &from, &hit, batch, x * 5 + y * 19, to, lane);
        if (usual) {
            const cgt_ray ray = cgt_kd_frame_secondary_ray(f, to, batch, lane);
            const cgt_result result = trace_again(f, &ray, cgt_kd_frame_is_mirror(f, batch), &found);
            if (result != CGT_OK)
                return result;
        }
        uint32_t *const bits = &cgt_kd_frame_occlusion(f, envelope, batch)[tile];
        to->prim[lane] = found;
        to->info.id_or_active = (to->info.id_or_active & ~bit) | (usual ? bit : 0);
        *bits = (*bits & ~bit) | (found != CGT_INVALID_ID ? bit : 0);
    }
    return CGT_OK;
}

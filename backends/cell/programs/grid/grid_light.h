/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays from a packet's hits, right after the packet: to a light, and along directions that all packets share, so that
 * the rays of a packet stay side by side. Any hit will do; one bit each is what remains. They go by main axis and sign,
 * a class at a time. */
#ifndef GRID_LIGHT_H
#define GRID_LIGHT_H

#include "cell/programs/grid/grid_store.h" /* first: it says whose arithmetic it is */

#include "cell/image/light_rays.h"
#include "cell/programs/grid/grid_march.h"
#include "cell/programs/grid/grid_nearest.h"

#ifndef GRID_NEAR
#define GRID_NEAR 1.f /* cells between the starts of rays that go together, along each axis */
#endif

/* Lanes of four masks as bits, the first one highest. */
static uint32_t grid_bits16(const vec_uint4 mask[4])
{
    uint32_t bits = 0;
    for (int i = 0; i < 4; i++)
        bits = bits << 4 | spu_extract(spu_gather(mask[i]), 0);
    return bits;
}

/* Lane `from` of four vectors, in all lanes. */
CGT_SPU_INLINE vec_float4 grid_splat_ray(const vec_float4 v[4], uint32_t from)
{
    return spu_splats(spu_extract(spu_rlqwbyte(v[from >> 2], (int)(4 * (from & 3))), 0));
}

/* ---- where they start ---- */

/* Hits and normals of the camera's packet. Lanes without a hit take the first one's. Returns the hits, as bits. */
static uint32_t grid_find_hits(const grid_packet *camera, grid_packet *p)
{
    const vec_float4 eye[3] = {s()->frustum.org[0], s()->frustum.org[1], s()->frustum.org[2]};
    const vec_float4 t_min = spu_splats(s()->camera.t_min);
    vec_uint4 none[4];
    for (int i = 0; i < 4; i++) {
        none[i] = spu_cmpeq(camera->prim[i], spu_splats(CGT_INVALID_ID));
        const vec_uint4 offset = spu_sl(spu_sel(camera->prim[i], spu_splats(CGT_GRID_SPHERES), none[i]), 4);
        const vec_float4 d[3] = {camera->dir[0][i], camera->dir[1][i], camera->dir[2][i]};
        vec_float4 q[4], sphere[4], point[3], normal[3];
        for (int k = 0; k < 4; k++)
            q[k] = GRID_LOAD(vec_float4, s()->sphere, spu_extract(offset, k));
        GRID_TRANSPOSE(q[0], q[1], q[2], q[3], sphere);
        cgt_light_find_hits(eye, d, camera->rdd[i], t_min, sphere, sphere[3], point, normal);
        for (int a = 0; a < 3; a++) {
            p->org[a][i] = point[a];
            s()->normal[a][i] = normal[a];
        }
        p->prim[i] = camera->prim[i];
    }
    const uint32_t hits = grid_bits16(none) ^ 0xffff;
    if (hits) {
        const uint32_t from = (uint32_t)__builtin_clz(hits) - 16;
        for (int a = 0; a < 3; a++) {
            const vec_float4 org = grid_splat_ray(p->org[a], from);
            for (int i = 0; i < 4; i++)
                p->org[a][i] = spu_sel(p->org[a][i], org, none[i]);
        }
    }
    return hits;
}

/* ---- where they go ---- */

static void grid_aim(uint32_t set, grid_packet *p)
{
    const cgt_light_image *const l = &s()->light;
    const bool shadow = set < l->shadow;
    for (int i = 0; i < 4; i++) {
        vec_float4 d[3];
        for (int a = 0; a < 3; a++)
            d[a] = shadow ? grid_add_nearest(spu_splats(l->position[a]), grid_negative(p->org[a][i]))
                          : spu_splats(l->direction[set][a]);
        if (!shadow) {
            const vec_float4 normal[3] = {s()->normal[0][i], s()->normal[1][i], s()->normal[2][i]};
            const vec_uint4 away = cgt_light_looks_away(normal, d);
            for (int a = 0; a < 3; a++)
                d[a] = spu_sel(d[a], grid_negative(d[a]), away);
        }
        for (int a = 0; a < 3; a++)
            p->dir[a][i] = d[a];
        p->rdd[i] = cgt_light_rdd(d);
        p->low[i] = p->high[i] = spu_splats(shadow ? 1.f : l->t_max);
    }
}

/* ---- their march ---- */

/* The origins' bounds, as tests of spheres take them: one, and how far others are. */
static void grid_bound_origins(const grid_packet *p, grid_frustum *f)
{
    f->org_reach = spu_splats(0.f);
    for (int a = 0; a < 3; a++) {
        const vec_float4 org = GRID_LANE(p->org[a][0], 0);
        vec_float4 most = spu_splats(0.f);
        for (int i = 0; i < 4; i++)
            most = spux_max(most, spux_abs(spu_sub(p->org[a][i], org)));
        f->org[a] = org;
        f->org_reach = spu_madd(grid_greatest(most), spu_splats(1 + 0x1p-18f), f->org_reach);
    }
}

/* Rays that start within a cell of one: a packet's hits lie at all depths, and what lies between them is crossed by no
 * ray. */
static void grid_find_neighbours(const grid_axes *x, const grid_packet *p, uint32_t from, vec_uint4 near[4])
{
    const uint32_t axis[3] = {x->u, x->v, x->w};
    for (int i = 0; i < 4; i++)
        near[i] = spu_splats(0xffffffffu);
    for (int k = 0; k < 3; k++) {
        const vec_float4 org = grid_splat_ray(p->org[axis[k]], from);
        for (int i = 0; i < 4; i++) {
            const vec_float4 apart = spu_mul(spu_sub(p->org[axis[k]][i], org), x->rcell[k]);
            near[i] = spu_andc(near[i], spu_cmpgt(spux_abs(apart), spu_splats(GRID_NEAR)));
        }
    }
}

/* Rays of one class; others have its first ray's place and are closed. */
static void grid_extract_class(const grid_packet *p, const vec_uint4 mine[4], uint32_t from, grid_packet *part)
{
    for (int i = 0; i < 4; i++) {
        for (int a = 0; a < 3; a++) {
            part->org[a][i] = spu_sel(grid_splat_ray(p->org[a], from), p->org[a][i], mine[i]);
            part->dir[a][i] = spu_sel(grid_splat_ray(p->dir[a], from), p->dir[a][i], mine[i]);
        }
        part->rdd[i] = spu_sel(grid_splat_ray(p->rdd, from), p->rdd[i], mine[i]);
        part->low[i] = part->high[i] = spu_sel(spu_splats(GRID_CLOSED), p->high[i], mine[i]);
        part->prim[i] = p->prim[i];
    }
}

static __attribute__((noinline)) void grid_march_lines(const grid_axes *x, grid_packet *p)
{
    grid_frustum *const f = &s()->line_frustum;
    if (!grid_frustum_of_lines(x, p, f))
        return;
    grid_bound_lengths(p, f);
    grid_bound_origins(p, f);
    s()->tested = spu_splats((unsigned short)CGT_QUEUE_NONE);
    grid_march(x, p, f, GRID_LIGHT);
}

/* Traces the rays that `rays` names by bits, and returns those that meet something. */
static uint32_t grid_trace_lines(const grid_packet *p, uint32_t rays)
{
    grid_packet *const part = &s()->part;
    uint32_t occluded = 0;
    while (rays) {
        const uint32_t from = (uint32_t)__builtin_clz(rays) - 16;
        const vec_uint4 left[4] = {spu_maskw(rays >> 12), spu_maskw(rays >> 8), spu_maskw(rays >> 4), spu_maskw(rays)};
        const grid_axes *const x = &s()->axes[grid_class_of(p, from)];
        vec_uint4 mine[4], met[4], near[4];
        grid_find_neighbours(x, p, from, near);
        for (int i = 0; i < 4; i++)
            mine[i] = spu_and(spu_and(left[i], near[i]), grid_rays_of(x, p, i, 1.25f));
        grid_extract_class(p, mine, from, part);
        grid_march_lines(x, part);
        for (int i = 0; i < 4; i++)
            met[i] = spu_and(mine[i], spu_cmpgt(spu_splats(0.f), part->high[i]));
        occluded |= grid_bits16(met);
        rays &= ~grid_bits16(mine) & ~(0x8000u >> from);
    }
    return occluded;
}

/* All sets of a packet; the words of control_block.h. */
static __attribute__((noinline)) void grid_trace_light(const grid_packet *camera, uint32_t *word)
{
    grid_packet *const p = &s()->from_hits;
    const uint32_t hits = grid_find_hits(camera, p), sets = s()->light.sets;
    for (uint32_t k = 0; k < (sets + 1) / 2; k++)
        word[k] = 0;
    for (uint32_t set = 0; hits && set < sets; set++) {
        vec_uint4 usual[4];
        grid_aim(set, p);
        for (int i = 0; i < 4; i++) {
            const vec_float4 d[3] = {p->dir[0][i], p->dir[1][i], p->dir[2][i]};
            const vec_uint4 own = spu_sl(p->prim[i], 12);
            usual[i] = cgt_light_is_usual(d);
            *GRID_QUADWORD(vec_uint4, s()->origin + 4 * i) = spu_or(own, spu_splats((set + 1) << 23));
        }
        const uint32_t rays = hits & grid_bits16(usual);
        for (uint32_t odd = hits & ~rays; odd; odd &= odd - 1)
            grid_add_doubt(15 - (uint32_t)__builtin_ctz(odd), CGT_DOUBT_ALL);
        word[set / 2] |= grid_trace_lines(p, rays) << (set & 1 ? 0 : 16);
        s()->counts[COUNT_LIGHT] = spu_add(s()->counts[COUNT_LIGHT], spu_splats((uint32_t)__builtin_popcount(hits)));
    }
    for (int i = 0; i < 4; i++)
        *GRID_QUADWORD(vec_uint4, s()->origin + 4 * i) = spu_splats(0u);
}

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Hits of the grid program's rays: compiled with the SPU's arithmetic in plain C. */
#include "cell/image/light_rays.h"
#include "cell/ppe/grid/grid_light.h"

static void splat(const float from[3], vec_float4 to[3])
{
    for (int a = 0; a < 3; a++)
        to[a] = spu_splats(from[a]);
}

void cgt_grid_light_hit(const float eye[3], const float dir[3], float t_min, const float sphere[4], float point[3],
                        float normal[3])
{
    vec_float4 e[3], d[3], c[3], p[3], n[3];
    splat(eye, e);
    splat(dir, d);
    splat(sphere, c);
    cgt_light_find_hits(e, d, cgt_light_rdd(d), spu_splats(t_min), c, spu_splats(sphere[3]), p, n);
    for (int a = 0; a < 3; a++) {
        point[a] = spu_extract(p[a], 0);
        normal[a] = spu_extract(n[a], 0);
    }
}

bool cgt_grid_light_looks_away(const float normal[3], const float dir[3])
{
    vec_float4 n[3], d[3];
    splat(normal, n);
    splat(dir, d);
    return spu_extract(cgt_light_looks_away(n, d), 0) != 0;
}

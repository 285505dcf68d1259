/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The thesis' accelerated triangle: 48 bytes that project a triangle onto the coordinate plane that it faces most
 * (Wald, "Realtime Ray Tracing and Interactive Global Illumination", 2004, section 7.2). With k that axis and u, v the
 * next two, the line meets the plane at
 *   t = (nw - o_k - nu o_u - nv o_v) / (d_k + nu d_u + nv d_v)
 * The point h there gives the shares of the second and the third vertex:
 *   share1 = bnu h_u + bnv h_v + bd    share2 = cnu h_u + cnv h_v + cd
 *
 * Errors in the thesis' listings, corrected here: the set-up reads c, which is not defined (it is the edge to the
 * second vertex), and takes the first edge in the wrong direction; KV of the test is KU; share1 lacks its constant; the
 * test of share2 tests share1 again; t, u, v and both ids are all written to the distance, and from the unselected
 * side. */
#ifndef CGT_ACCELERATED_TRIANGLE_H
#define CGT_ACCELERATED_TRIANGLE_H

#include "model/primitive.h"

typedef struct cgt_accelerated_triangle {
    float nu, nv, nw;
    uint32_t k;
    float bnu, bnv, bd;
    float cnu, cnv, cd;
    uint32_t triangle, geometry; /* ids */
} cgt_accelerated_triangle;

_Static_assert(sizeof(cgt_accelerated_triangle) == 48, "three 16-byte blocks: DMA transfers whole ones");

static inline cgt_accelerated_triangle cgt_accelerated_triangle_init(const cgt_triangle *q)
{
    float b[3], c[3], n[3], size[3];
    for (int a = 0; a < 3; a++) {
        b[a] = q->v[2][a] - q->v[0][a];
        c[a] = q->v[1][a] - q->v[0][a];
    }
    for (int a = 0; a < 3; a++) {
        n[a] = c[(a + 1) % 3] * b[(a + 2) % 3] - c[(a + 2) % 3] * b[(a + 1) % 3];
        size[a] = n[a] < 0 ? -n[a] : n[a];
    }
    const uint32_t k = size[0] > size[1] ? (size[0] > size[2] ? 0 : 2) : (size[1] > size[2] ? 1 : 2);
    const uint32_t u = (k + 1) % 3, v = (k + 2) % 3;
    const float *p = q->v[0], nu = n[u] / n[k], nv = n[v] / n[k], r = b[u] * c[v] - b[v] * c[u];
    return (cgt_accelerated_triangle){.nu = nu,
                                      .nv = nv,
                                      .nw = p[k] + nu * p[u] + nv * p[v],
                                      .k = k,
                                      .bnu = -b[v] / r,
                                      .bnv = b[u] / r,
                                      .bd = (b[v] * p[u] - b[u] * p[v]) / r,
                                      .cnu = c[v] / r,
                                      .cnv = -c[u] / r,
                                      .cd = (c[u] * p[v] - c[v] * p[u]) / r};
}

#endif

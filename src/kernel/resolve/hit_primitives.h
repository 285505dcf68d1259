/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The closest primitives of a packet's rays, as a structure of arrays. */
#ifndef CGT_HIT_PRIMITIVES_H
#define CGT_HIT_PRIMITIVES_H

#include "kernel/packet/packet.h"

#define RESOLVE_RAYS 16u

typedef struct hit_primitives {
    _Alignas(64) float sphere[4][PACKET_MAX_RAYS]; /* x, y, z, r; r of capsules; 0 if neither is hit */
    /* only in scenes with other kinds: */
    _Alignas(64) float vertex[3][3][PACKET_MAX_RAYS]; /* [k][a]; p and q of capsules */
    _Alignas(64) uint32_t kind[PACKET_MAX_RAYS];      /* cgt_kind, that of triangles for no hit */
    uint32_t hits;
} hit_primitives;

CGT_SPU_INLINE cgt_triangle hit_primitive_triangle(const hit_primitives *w, size_t i)
{
    return (cgt_triangle){{{w->vertex[0][0][i], w->vertex[0][1][i], w->vertex[0][2][i]},
                           {w->vertex[1][0][i], w->vertex[1][1][i], w->vertex[1][2][i]},
                           {w->vertex[2][0][i], w->vertex[2][1][i], w->vertex[2][2][i]}}};
}

CGT_SPU_INLINE cgt_sphere hit_primitive_sphere(const hit_primitives *w, size_t i)
{
    return (cgt_sphere){w->sphere[0][i], w->sphere[1][i], w->sphere[2][i], w->sphere[3][i]};
}

CGT_SPU_INLINE cgt_capsule hit_primitive_capsule(const hit_primitives *w, size_t i)
{
    return (cgt_capsule){{w->vertex[0][0][i], w->vertex[0][1][i], w->vertex[0][2][i]},
                         {w->vertex[1][0][i], w->vertex[1][1][i], w->vertex[1][2][i]},
                         w->sphere[3][i]};
}

#endif

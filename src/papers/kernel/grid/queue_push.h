/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The push of a reference to voxel queues (Chapman, section 3.4).
 *
 * Words per push: 2 loads, 2 shuffles, 2 stores: the six that Chapman counts. The reference is splatted once for
 * a primitive's eight pushes; one more word per push finds out whether any of the queues was full, which Chapman omits.
 * A test counts the words by defining CGT_QUEUE_LOAD, CGT_QUEUE_STORE and CGT_QUEUE_SHUFFLE. */
#ifndef CGT_QUEUE_PUSH_H
#define CGT_QUEUE_PUSH_H

#include "papers/model/queue_grid.h"
#include "vector.h"

#ifndef CGT_QUEUE_LOAD
#define CGT_QUEUE_LOAD(p) (*(const vec_ushort8 *)(const void *)(p))
#define CGT_QUEUE_STORE(p, v) (*(vec_ushort8 *)(void *)(p) = (v))
#define CGT_QUEUE_SHUFFLE(a, b, pattern) spu_shuffle(a, b, pattern)
#endif

/* The reference, then the first seven of the front half; the last of the front half, then the first seven behind it. */
#define CGT_QUEUE_FRONT ((vec_uchar16){0, 1, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29})
#define CGT_QUEUE_BACK ((vec_uchar16){14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29})

/* Pushes one reference to the queues of eight cells, some or all of which may be the same: all are read before any is
 * written, so that equal cells are written with equal queues and hold the reference once. A full queue
 * loses its oldest reference: the caller has saved it before. */
CGT_SPU_INLINE void queue_push8(cgt_voxel *voxel, const uint32_t cell[8], vec_ushort8 reference)
{
    vec_ushort8 front[8], back[8];
    for (int k = 0; k < 8; k++) {
        front[k] = CGT_QUEUE_LOAD(voxel[cell[k]].reference);
        back[k] = CGT_QUEUE_LOAD(voxel[cell[k]].reference + 8);
    }
    for (int k = 0; k < 8; k++) {
        CGT_QUEUE_STORE(voxel[cell[k]].reference, CGT_QUEUE_SHUFFLE(reference, front[k], CGT_QUEUE_FRONT));
        CGT_QUEUE_STORE(voxel[cell[k]].reference + 8, CGT_QUEUE_SHUFFLE(front[k], back[k], CGT_QUEUE_BACK));
    }
}

CGT_SPU_INLINE void queue_push1(cgt_voxel *voxel, vec_ushort8 reference)
{
    const vec_ushort8 front = CGT_QUEUE_LOAD(voxel->reference), back = CGT_QUEUE_LOAD(voxel->reference + 8);
    CGT_QUEUE_STORE(voxel->reference, CGT_QUEUE_SHUFFLE(reference, front, CGT_QUEUE_FRONT));
    CGT_QUEUE_STORE(voxel->reference + 8, CGT_QUEUE_SHUFFLE(front, back, CGT_QUEUE_BACK));
}

/* ---- 64-byte voxels: references of a word each, four registers long ---- */

#define CGT_QUEUE_FRONT32 ((vec_uchar16){0, 1, 2, 3, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27})
#define CGT_QUEUE_BACK32 ((vec_uchar16){12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27})

CGT_SPU_INLINE void queue_push1_32(cgt_voxel32 *voxel, vec_uint4 reference)
{
    vec_uint4 *quarter = (vec_uint4 *)(void *)voxel->reference;
    const vec_uint4 a = quarter[0], b = quarter[1], c = quarter[2], d = quarter[3];
    quarter[0] = spu_shuffle(reference, a, CGT_QUEUE_FRONT32);
    quarter[1] = spu_shuffle(a, b, CGT_QUEUE_BACK32);
    quarter[2] = spu_shuffle(b, c, CGT_QUEUE_BACK32);
    quarter[3] = spu_shuffle(c, d, CGT_QUEUE_BACK32);
}

/* A queue that begins with the reference has got it: equal cells hold it once. */
CGT_SPU_INLINE void queue_push8_32(cgt_voxel32 *voxel, const uint32_t cell[8], uint32_t reference)
{
    for (int k = 0; k < 8; k++)
        if (voxel[cell[k]].reference[0] != reference)
            queue_push1_32(&voxel[cell[k]], spu_splats(reference));
}

#endif

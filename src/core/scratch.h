/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scratch memory of tasks, so that they run on small stacks: whatever is larger than some KB lies in a block that the
 * task has for itself. Blocks belong to the context. A call takes as many as tasks of it may run at once, before it
 * starts them, and gives them back at its end; the context keeps them until it is released. So a steady state allocates
 * nothing, and workers never allocate. */
#ifndef CGT_SCRATCH_H
#define CGT_SCRATCH_H

#include "core/memory.h"

/* Of a block. At most there are, of points against a light: a batch of them, 136 KB (dispatch/frame_points.h); their
 * copies as single rays, 180 KB (kernel/light/light_bvh.c); and a stream of rays, 805 KB with 16 lanes
 * (kernel/stream/stream.h), with a packet and its hits, 34 KB. Of all hits, 480 KB for lists (trace/trace_all_rays.c),
 * the stream, and 50 KB for its rays; of points inside, 405 KB for lists and sums (trace/points_inside.c), the stream
 * and its rays. Of ambient occlusion, 467 KB for a tile's pixels and rays (trace/trace_ambient.c), and the stream. */
#ifndef CGT_SCRATCH_BYTES /* programs of an SPE have less */
#define CGT_SCRATCH_BYTES ((size_t)1408 << 10)
#endif

#define CGT_SCRATCH_HEADER 64u

typedef struct cgt_scratch {
    struct cgt_scratch *next; /* of those that the context keeps, or that a call has */
    size_t used;              /* bytes, from the block's begin */
    size_t most;              /* that were used at once */
} cgt_scratch;

/* Returns so many bytes, aligned to CGT_ALIGNMENT, uninitialised. Blocks are made for the deepest call: one that is too
 * small is a mistake of this library, which must not overwrite what is not its own. */
static inline void *cgt_scratch_take(cgt_scratch *s, size_t bytes)
{
    void *memory = (char *)s + s->used;
    s->used += (bytes + CGT_ALIGNMENT - 1) / CGT_ALIGNMENT * CGT_ALIGNMENT;
    if (s->used > s->most)
        s->most = s->used;
    if (s->used > CGT_SCRATCH_BYTES)
        __builtin_trap();
    return memory;
}

/* Gives memory back, and all that was taken after it. */
static inline void cgt_scratch_return(cgt_scratch *s, const void *memory)
{
    s->used = (size_t)((const char *)memory - (const char *)s);
}

/* Makes a block of CGT_SCRATCH_BYTES at CGT_ALIGNMENT usable. */
static inline cgt_scratch *cgt_scratch_init(void *memory)
{
    cgt_scratch *s = memory;
    *s = (cgt_scratch){.used = CGT_SCRATCH_HEADER};
    return s;
}

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Streams of rays through the BVH: the rays of a call, normalised (bvh_ray.h), one record each, and lists of rays by
 * number.
 *
 * Memory. A stream lies in the task's scratch and takes, with CGT_STREAM_CHUNK = 8192, 512 KB for records, 128 KB for
 * best hits, 33 KB for the list of all rays, 32 KB for keys and later for skipped primitives, 32 KB for masks, and 64
 * KB for the arena: 805 KB. On the stack are, one at a time, the levels of a list with the stack of a single ray, 20
 * KB, or interleaved rays, 40 KB, or the frame of the resolve, 15 KB. */
#ifndef CGT_STREAM_H
#define CGT_STREAM_H

#include "kernel/bvh/bvh_single.h"
#include "kernel/tunables.h"

#define CGT_STREAM_ARENA 16384u /* words */

#define STREAM_RECORD_BITS 4
#define STREAM_RECORD (1u << STREAM_RECORD_BITS)            /* floats: one line of the cache */
#define STREAM_DUMMY_RAY (CGT_STREAM_CHUNK * STREAM_RECORD) /* a record that hits nothing: what fills up lists */
#define STREAM_MAX_ORG 16.f                                 /* normalised origins beyond are moved */
#define STREAM_LIST_WORDS(count) ((count) + 2u * CGT_LANES) /* words for a list of `count` rays, padded */

/* The keys that rays are sorted by: octants, then the rays that streams do not take. */
enum { STREAM_UNUSUAL = 8, STREAM_SKIPPED, STREAM_KEYS };

/* Indices of a record's floats. The range of t is in both halves: for nodes and for leaves. */
enum {
    RECORD_RDIR = 0,
    RECORD_NEAR = 3,
    RECORD_SHIFT = 4, /* -org rdir */
    RECORD_FAR = 7,   /* -infinity: the ray is done */
    RECORD_ORG = 8,
    RECORD_LEAF_NEAR = 11,
    RECORD_DIR = 12,
    RECORD_LEAF_FAR = 15
};

typedef struct stream {
    _Alignas(64) float record[CGT_STREAM_CHUNK + 1][STREAM_RECORD];
    _Alignas(64) best_hit best[CGT_STREAM_CHUNK + 1]; /* of closest hits */
    _Alignas(64) uint32_t arena[CGT_STREAM_ARENA];
    _Alignas(64) uint32_t ray_list[CGT_STREAM_CHUNK + STREAM_KEYS * CGT_LANES]; /* records, by key */
    union {
        _Alignas(64) uint32_t key[CGT_STREAM_CHUNK]; /* until they are sorted */
        uint32_t skip_prim[CGT_STREAM_CHUNK + 1];    /* primitives; where rays ignore any, and so is the next */
    };
    uint32_t mask[CGT_STREAM_CHUNK + 1];
    bvh_call call;
    ray_limits limits;   /* rays beyond are moved */
    float start_error;   /* the largest of moved rays (query/moved_ray.h) */
    bool unbounded;      /* no range ends within the scene: without t_max, and t is a finite float wherever rays go */
    float slab_error[3]; /* E of all rays of streams */
    float start_low[3], start_high[3], end_low[3], end_high[3]; /* bounds of where those rays begin and end */
    float origin_spread;      /* how far their origins lie apart, along an axis, as a share of the tree's size */
    uint32_t alone, together; /* rays that nodes have handed on one by one, and those that came to leaves in lists */
    uint32_t octant;          /* being traced */
    uint32_t still;           /* axes, as bits, along which many rays do not move: those with a 0 in RECORD_DIR */
    float reach_low[3], reach_high[3]; /* no ray of the octant reaches what lies outside */
    uint32_t updates;  /* any hit: rays that have found theirs; nearest: how often a ray found another one */
    uint8_t *occluded; /* any hit: the caller's, all 0 at first */
    /* NULL, or the list of each ray: the ends of ranges are those of lists, and the inner ones stay */
    struct cgt_hit_list *const *list;
} stream;

CGT_SPU_INLINE float *stream_record(stream *s, uint32_t offset) { return &s->record[0][0] + offset; }

/* Sets the bounds of where the octant's rays may go: from the least start or end of all streams to the greatest. */
CGT_SPU_INLINE void stream_set_octant(stream *s, uint32_t octant)
{
    s->octant = octant;
    for (int a = 0; a < 3; a++) {
        const bool from_above = octant >> a & 1;
        s->reach_low[a] = from_above ? s->end_low[a] : s->start_low[a];
        s->reach_high[a] = from_above ? s->start_high[a] : s->end_high[a];
    }
}

/* Returns the boxes that the octant's rays may reach, as bits. The bounds err by less than they were moved outwards, by
 * 2^-85 at least; a ray that counts lies beyond its start but for as much. */
CGT_SPU_INLINE unsigned stream_reachable(const stream *s, const vfloat low[3], const vfloat high[3])
{
    vmask out = spux_mask_none();
    for (int a = 0; a < 3; a++)
        out = spu_or(out, spu_or(spu_cmpgt(spux_vfloat(s->reach_low[a]), high[a]),
                                 spu_cmpgt(low[a], spux_vfloat(s->reach_high[a]))));
    return ~spux_mask_bits(out);
}

/* Ends an any-hit ray that has found a hit. */
CGT_SPU_INLINE void stream_set_occluded(stream *s, uint32_t offset)
{
    stream_record(s, offset)[RECORD_FAR] = stream_record(s, offset)[RECORD_LEAF_FAR] = -INFINITY;
    s->occluded[offset / STREAM_RECORD] = 1;
    s->updates++;
}

/* Stores where a ray ends from now on. */
CGT_SPU_INLINE void stream_set_end(stream *s, uint32_t offset, float far)
{
    s->best[offset / STREAM_RECORD].high = far;
    stream_record(s, offset)[RECORD_FAR] = stream_record(s, offset)[RECORD_LEAF_FAR] = far;
    s->updates++;
}

/* Stores a ray's best hit. */
CGT_SPU_INLINE void stream_set_best(stream *s, uint32_t offset, float low, float high, uint32_t prim)
{
    best_hit *b = &s->best[offset / STREAM_RECORD];
    b->low = low;
    b->prim = prim;
    stream_set_end(s, offset, high);
}

/* Loads a record as a single ray, without its slabs. */
CGT_SPU_INLINE void stream_ray_load(stream *s, uint32_t offset, bool any_hit, bvh_ray *r)
{
    const float *d = stream_record(s, offset);
    r->still = 0;
    for (int a = 0; a < 3; a++) {
        r->org[a] = d[RECORD_ORG + a];
        r->dir[a] = d[RECORD_DIR + a];
        r->still |= (uint32_t)(r->dir[a] == 0) << a & s->still;
    }
    r->near = d[RECORD_NEAR];
    r->far = d[RECORD_FAR];
    r->number = offset / STREAM_RECORD;
    if (any_hit)
        r->best = (best_hit){r->far - fabsf(r->far) * 0x1p-18f - s->call.range_error[1], r->far, CGT_INVALID_ID, 0};
    else
        r->best = s->best[r->number];
}

/* Stores what a single ray has found, unless the record is done. */
CGT_SPU_INLINE void stream_ray_store(stream *s, uint32_t offset, const bvh_ray *r, bool any_hit)
{
    const float far = stream_record(s, offset)[RECORD_FAR];
    if (far == -INFINITY)
        return;
    if (any_hit && r->far == -INFINITY)
        stream_set_occluded(s, offset);
    if (!any_hit && (r->far != far || r->best.prim != s->best[r->number].prim))
        stream_set_best(s, offset, r->best.low, r->best.high, r->best.prim);
}

/* Bounds of the rays in streams: of their origins, of the first and the last place that counts. */
typedef struct stream_bounds {
    vfloat org_low[3], org_high[3], start_low[3], start_high[3], end_low[3], end_high[3];
} stream_bounds;

/* Moves the first `count` rays along their lines where that pays, and sets the stream's bounds anew (stream_move.c).
 * has_far: some are far away, with the key STREAM_UNUSUAL. */
void CGT_KERNEL(cgt_stream_move_rays)(stream *s, uint32_t count, bool has_far, stream_bounds *b);

/* Rays of a stream as single rays: the listed ones through the subtree of a code; those that no bounds cover
 * (kernel/moved); and rays of all octants, interleaved. */
void CGT_KERNEL(cgt_stream_trace_few)(stream *s, const uint32_t *list, uint32_t count, uint32_t code);
void CGT_KERNEL(cgt_stream_trace_unusual)(stream *s, const uint32_t *list, uint32_t count);
void CGT_KERNEL(cgt_stream_interleave)(stream *s, const uint32_t *list, uint32_t count);

/* The same of rays with lists (query/hit_list.h): those of a list through a subtree; and whole ones, by turns. */
void CGT_KERNEL(cgt_stream_list_few)(stream *s, const uint32_t *list, uint32_t count, uint32_t code);
void CGT_KERNEL(cgt_stream_list_turns)(stream *s, const uint32_t *list, uint32_t count);

/* Resolves the best hits of all `count` rays and stores them in the caller's arrays. */
void CGT_KERNEL(cgt_stream_store_hits)(stream *s, uint32_t count, const cgt_trace_settings *settings,
                                       const cgt_hits *hits);

#endif

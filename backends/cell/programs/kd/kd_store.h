/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the kd program keeps in local store, and how it is compiled: envelopes of up to 64 tiles, triangles alone, exact
 * but for what goes to the PPE. The file that includes it is one translation unit with the kernels.
 *
 * KD_IS_BIH: 1 where trees are bounding interval hierarchies (spe_bih.c), 0 where they are kd-trees. */
#ifndef KD_STORE_H
#define KD_STORE_H

#ifndef KD_IS_BIH
#define KD_IS_BIH 0
#endif

#define CGT_SPU_EXACT
#define CGT_SPE_TEXT_BYTES 47000
#define CGT_SPE_STACK_BYTES 15000
#define PACKET_MAX_RAYS 256
#define PACKET_IS_FAST(p) false
#define KD_SINGLE_RAYS false
#define ROPE_PLANE_ORDER kd_plane_order
#define SCALAR_DIVIDE(a, b) spu_extract(spux_div(spu_splats((float)(a)), spu_splats((float)(b))), 0)
#define SCALAR_SQRT(a) spu_extract(spux_sqrt(spu_splats((float)(a))), 0)
#define FILTER_DEFERS true
#define FILTER_DEFER(p, i, prim) (kd_add_doubt(i, prim), true)
#define KD_NODES(tree, i) ((void)(tree), kd_get_nodes(i))
#define KD_LEAF(tree, i) kd_get_leaf(i)
#define KD_IS_BROKEN(nodes, most, top)                                                                                 \
    (__builtin_expect(((nodes) > (most)) | ((top) > CGT_KD_MAX_DEPTH), 0) && kd_break())
#define KD_STACK 64u
#define KD_PLACE(top) ((top) % KD_STACK)
#define KD_IS_TOO_DEEP(depth) (__builtin_expect((depth) == CGT_KD_MAX_DEPTH, 0) && kd_break())
#define KD_AHEAD(n) kd_fetch_ahead(n)
#define KD_TEST_NODE(tree, l, rays, n, i) kd_test_node(l, rays, n, i)
#define KD_TEST_LEAF(tree, l, rays, of, i) kd_test_list(l, rays, (of)->first, (of)->count, i)

#include <string.h>

#include "cell/machine/spe_program.h"

#include "cell/image/kd_image.h"
#include "cell/programs/kd/spe_kd.h"
#include "cell/programs/spe_doubts.h"
#include "dispatch/kernel.h"
#include "kernel/packet/packet.h"
#include "papers/model/paper_structures.h"

#define KD_BATCH 32u /* triangles that a leaf's test takes together, at most */

/* A node, and how many primitives of a leaf are in the node itself, from word 1 on; more are in the references, and
 * word 1 is where they begin. */
#if KD_IS_BIH
typedef cgt_bih_node kd_node;
#define KD_INLINE_PRIMS CGT_BIH_INLINE_PRIMS
#else
typedef cgt_kd_node kd_node;
#define KD_INLINE_PRIMS 1u
#endif

/* A word where an SPU's loads have it at once: at the start of a quadword. */
typedef struct kd_word {
    _Alignas(16) uint32_t is;
} kd_word;

/* A cache of blocks, direct mapped; where its blocks lie in the arena. */
typedef struct kd_cache {
    kd_word first, log2, mask;  /* bytes in the arena; of elements a block; blocks - 1 */
    kd_word tag[CGT_KD_BLOCKS]; /* the block that lies there; UINT32_MAX: none */
    uint32_t total;             /* elements */
    uint32_t ea[2];
    uint32_t fetches;
} kd_cache;

/* Where a triangle went, as the number of its fetch: its slot is that modulo the slots, until that many others have
 * been fetched. */
typedef struct kd_triangle_entry {
    uint32_t id, fetch;
} kd_triangle_entry;

typedef struct kd_triangle_cache {
    uint32_t first, index, slots, mask; /* bytes in the arena: triangles, entries; entries - 1 */
    uint32_t batch, next;               /* at most; the next fetch */
    uint32_t fetches, lists, pending;   /* pending: tags of lists under way, as bits */
    uint32_t buffer;                    /* of the last list fetched ahead */
    kd_word ahead;                      /* whether of leaves, where they are pushed */
} kd_triangle_cache;

/* DMA goes to all but the last ones. */
typedef struct kd_store {
    _Alignas(128) cgt_kd_control control;
    _Alignas(128) cgt_kd_frame_image frame;
    float direction[CGT_KD_DIRECTIONS][4];
    _Alignas(128) cgt_camera_image camera;
    _Alignas(128) cgt_kd_part part;
    _Alignas(128) cgt_kd_report report;
    _Alignas(128) spe_doubts doubts;
    _Alignas(128) uint32_t list[3][KD_BATCH][2]; /* of a leaf at hand; of leaves ahead */
    _Alignas(128) cgt_kd_info info[2][8];
    union { /* of set-up; of secondary rays */
        struct {
            _Alignas(128) float column[2][2 * CGT_KD_TILES][4], row[2][2 * CGT_KD_TILES][4];
        };
        cgt_kd_secondary_tile secondary[2][CGT_KD_TILES];
    };
    _Alignas(128) uint32_t occlusion[2][CGT_KD_TILES];
    _Alignas(128) cgt_kd_ray_tile ray[2][CGT_KD_TILES];
    _Alignas(128) cgt_kd_info ray_info[2][CGT_KD_TILES];
    _Alignas(128) cgt_kd_hit_tile hit[2][CGT_KD_TILES];
    _Alignas(128) char arena[CGT_KD_CACHE_BYTES];
    kd_cache nodes, references, leaves;
    kd_triangle_cache triangles;
    packet packet;
    const cgt_kd_info
        *tile; /* of the packet, where doubts are of pixels; NULL: of secondary rays from `ray_number` on */
    uint32_t ray_number, tests;
    uint32_t broken; /* the scene is none: nothing more is traced, but the protocol is kept */
} kd_store;
CGT_SPE_STORE(kd_store, s)

/* Tags of DMA. */
enum {
    TAG_SETUP,
    TAG_BLOCK,
    TAG_LIST0,
    TAG_LIST1,
    TAG_LIST2,
    TAG_IN0, /* rays, columns and rows, hits of earlier parts */
    TAG_IN1,
    TAG_OUT0,
    TAG_OUT1,
    TAG_SECONDARY0,
    TAG_SECONDARY1,
    TAG_DOUBT0,
    TAG_DOUBT1
};

/* Remembers that the scene is broken. Returns true. */
static __attribute__((noinline)) bool kd_break(void)
{
    s()->broken = 1;
    return true;
}

static inline uint64_t kd_ea(const uint32_t word[2]) { return (uint64_t)word[0] << 32 | word[1]; }

static inline void kd_wait(uint32_t tags)
{
    mfc_write_tag_mask(tags);
    mfc_read_tag_status_all();
}

#endif

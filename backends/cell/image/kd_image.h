/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the PPE and the kd program's SPEs share, by the thesis' chapter 7: control blocks, envelopes of ray tiles, ray
 * info, hits, the parts of a scene. Rules and addresses of the first part are those of control_block.h.
 *
 * A tile is 2x2 pixels: one vector of rays. An envelope is a rectangle of tiles, up to KD_TILES of them; envelopes are
 * numbered row by row. A run has phases; all SPEs end one before any begins the next:
 *
 *   set-up       each SPE makes the rays of a contiguous share of the envelopes, and writes them to main memory
 *   part 0 ...   each part of the scene: rays against its tree; hits of earlier parts come back from main memory
 *   again        where several parts and secondary rays are there, each part once more, with the secondary rays. With
 *                one part they are traced right after the rays of their envelope
 *
 * Messages are those of control_block.h, envelopes in place of strips, and at the barrier between two phases
 *
 *   SPE to PPE   out mailbox   CGT_KD_PHASE: this SPE has ended its phase
 *   PPE to SPE   in mailbox    CGT_KD_PHASE: all have
 *
 * A doubt's pixel has CGT_KD_SECONDARY set where it is of a secondary ray; the rest is the ray's number then. */
#ifndef CGT_KD_IMAGE_H
#define CGT_KD_IMAGE_H

#include "cell/image/control_block.h"

#define CGT_KD_MAGIC 0x4b440001u /* "KD", version 1 */
#define CGT_KD_PHASE 0xfffffffeu
#define CGT_KD_SECONDARY 0x80000000u

/* ---- addresses: arrays that may be large have 4 GB each, so that no list of DMA crosses into the next ---- */

#define CGT_KD_EA_FRAME 0x00014000u
#define CGT_KD_EA(window) ((uint64_t)(window) << 32)
enum {
    CGT_KD_INFOS = 1, /* cgt_kd_info of each envelope */
    CGT_KD_RAYS,      /* cgt_kd_ray_tile */
    CGT_KD_RAY_INFOS, /* cgt_kd_info of each tile */
    CGT_KD_HITS,      /* cgt_kd_hit_tile */
    CGT_KD_SECONDARY_RAYS,
    CGT_KD_OCCLUSION, /* a word for each tile of secondary rays, and padding to 16 bytes after each envelope */
    CGT_KD_TRIANGLES,
    CGT_KD_NODES,
    CGT_KD_REFERENCES = CGT_KD_NODES + 16,
    CGT_KD_LEAVES = CGT_KD_REFERENCES + 16
};

/* ---- limits ---- */

#define CGT_KD_TILES 64u /* of an envelope */
#define CGT_KD_PARTS 16u /* of a scene */
#define CGT_KD_LIGHTS 4u
#define CGT_KD_DIRECTIONS 64u            /* of ambient rays */
#define CGT_KD_MAX_BIH_NODES 0x0fffffffu /* in 4 GB of addresses */
#define CGT_KD_BLOCKS 128u               /* of a cache */
#define CGT_KD_CACHE_BYTES 131072u       /* of all caches */

typedef enum cgt_kd_flag {
    CGT_KD_MAILBOX = 1, /* as CGT_CONTROL_MAILBOX */
    CGT_KD_ROPES = 2,
    CGT_KD_PREFETCH = 4, /* fetch a leaf's triangles where its sibling is visited first */
    CGT_KD_BIH = 8       /* trees are bounding interval hierarchies: for spe_bih; else for spe_kd */
} cgt_kd_flag;

/* The control block of an SPE, 128 bytes (thesis, section 7.4). */
typedef struct cgt_kd_control {
    uint32_t magic, spe, spes, flags;
    uint32_t first, envelopes, step; /* the envelopes that it intersects, mailbox apart */
    uint32_t setup_first, setup_envelopes;
    uint32_t half; /* doubts of half a ring */
    uint32_t frame[2], parts[2], infos[2], rays[2], ray_infos[2], hits[2], secondary[2], occlusion[2], triangles[2],
        doubts[2], report[2];
} cgt_kd_control;
_Static_assert(sizeof(cgt_kd_control) == 128, "one line");

/* How a cache is laid out. */
typedef struct cgt_kd_cache_size {
    uint32_t blocks; /* a power of two, at most CGT_KD_BLOCKS; of triangles: any power of two of them */
    uint32_t log2;   /* of the elements of a block; of triangles: of the entries of the index */
} cgt_kd_cache_size;

/* What all SPEs share, in two lines. */
typedef struct cgt_kd_frame_image {
    uint32_t width, height;
    uint32_t tiles_x, tiles_y; /* of an envelope */
    uint32_t across, envelopes;
    uint32_t parts, batch; /* triangles that a leaf's test takes together at most */
    cgt_kd_cache_size nodes, references, leaves, triangles;
    uint32_t camera[2], columns[2], rows[2];
    uint32_t lights, ambient; /* secondary rays of a pixel: to each light, then ambient ones, */
    float scale;              /* of the triangles */
    uint32_t triangle_count;
    float light_t_min, ambient_t_min, ambient_t_max;
    uint32_t mirror; /* and one that the triangle reflects: 0, or 1 where the scene has one part */
    float mirror_t_min, mirror_t_max;
    float light[CGT_KD_LIGHTS][4];
    uint32_t pad[16];
} cgt_kd_frame_image;
_Static_assert(sizeof(cgt_kd_frame_image) == 256, "two lines");

/* Followed by CGT_KD_DIRECTIONS directions of ambient rays, quads. */
#define CGT_KD_FRAME_BYTES (256 + 16 * CGT_KD_DIRECTIONS)

/* A part of the scene, 128 bytes: the thesis' cacheInfoPack. */
typedef struct cgt_kd_part {
    uint32_t nodes, references, leaves, ropes;
    float low[3], high[3];
    uint32_t node[2], reference[2], leaf[2];
    uint32_t reserved[16];
} cgt_kd_part;
_Static_assert(sizeof(cgt_kd_part) == 128, "one line");

/* ---- envelopes ---- */

/* Of an envelope: its number and first pixel. Of a tile: x and y of the first pixel, and the rays that take part, as
 * bits: bit k is pixel x + k % 2, y + k / 2. */
typedef struct cgt_kd_info {
    uint32_t id_or_active, x, y, reserved;
} cgt_kd_info;

/* Figure 7.1. */
typedef struct cgt_kd_ray_tile {
    float dir[3][4];
    float org[4];
} cgt_kd_ray_tile;

typedef struct cgt_kd_hit_tile {
    uint32_t prim[4];
    float low[4], high[4]; /* the interval of t; of no hit: the end of the ray's range */
    cgt_kd_info info;
} cgt_kd_hit_tile;

/* Secondary rays of a tile; active has the rays that there are. Those of batch b of envelope e are tiles
 * (e * batches + b) * tiles and following, their rays 4 times that. Reflected rays get their nearest triangles, with
 * the doubts still to be decided; the others get bits alone. */
typedef struct cgt_kd_secondary_tile {
    float dir[3][4], org[3][4];
    cgt_kd_info info;
    uint32_t prim[4];
} cgt_kd_secondary_tile;
_Static_assert(sizeof(cgt_kd_secondary_tile) == 128, "one line");

/* ---- what comes back ---- */

typedef enum cgt_kd_state {
    CGT_KD_STATE_NONE = 0,
    CGT_KD_STATE_DONE,
    CGT_KD_STATE_BAD_CONTROL, /* not the words that the program knows */
    CGT_KD_STATE_CACHES,      /* more bytes of caches than there are; value: those that there are */
    CGT_KD_STATE_BROKEN,      /* a part's tree has loops, is too deep, or names what there is not */
    CGT_KD_STATE_OTHER_TREE   /* the program is made for the other kind of trees */
} cgt_kd_state;

typedef struct cgt_kd_report {
    uint32_t state, value;
    uint32_t doubts, rest_half, rest; /* as in cgt_spe_report */
    uint32_t envelopes;               /* intersected, in all phases */
    uint32_t nodes, leaves, tests;    /* visited by vectors; vectors of rays against a triangle */
    uint32_t secondary;               /* rays */
    uint32_t loops;                   /* along ropes: of a broken tree alone */
    uint32_t exact_steps;
    uint32_t node_fetches, reference_fetches, leaf_fetches; /* blocks */
    uint32_t triangle_fetches, triangle_lists;              /* triangles; lists that brought them */
    uint32_t setup, traced;                                 /* steps of the decrementer: for rays; from there on */
    uint32_t reserved[13];
} cgt_kd_report;
_Static_assert(sizeof(cgt_kd_report) == 128, "one line");

#endif

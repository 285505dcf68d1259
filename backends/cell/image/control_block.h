/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the PPE and the SPEs' programs share: the control block of an SPE (thesis, section 7.4), the images of scene and
 * camera, what an SPE reports, and where they lie among the effective addresses. For the host and for an SPU's
 * compiler.
 *
 * All is made of words of 32 bits, floats among them; a 64-bit address is two words, high first. So one image serves a
 * native and a simulated program on any host, and a real Cell.
 *
 * The frame is cut into strips of CGT_STRIP_ROWS scanlines and at most CGT_STRIP_WIDTH columns, numbered row by row.
 * An SPE traces its own share, `strips` of them from `first` on in steps of `step`. Where CGT_CONTROL_MAILBOX is set it
 * then takes numbers from its mailbox until CGT_STRIP_END comes. Messages:
 *
 *   PPE to SPE   in mailbox       a strip to trace
 *   SPE to PPE   out mailbox      the strip that has been begun: the next number is wanted, one more stays under way
 *   SPE to PPE   interrupt        a half of its ring of doubts is full: half << 16 | doubts
 *   PPE to SPE   signal 1, OR     bit h: half h has been read
 *
 * A doubt is a pair of pixel and object that the SPE's single precision cannot decide: y << 16 | x, and the object. An
 * SPE with both halves unread waits: no doubt is lost.
 *
 * Where there is a light image, each pixel's hit sends rays from there: set 0 to a point, the others along directions.
 * Whether any object but the hit one is in their way is one bit. Those of a packet are words, of two sets each: set 2k
 * in the high half of word k; pixel 4 y + x of the packet is bit 15 - (4 y + x) of the half. The words of the packets
 * of four scanlines lie side by side, the next four `occluded_bytes` on. A doubt of such a ray also has the set, and
 * the object that it starts from; CGT_DOUBT_ALL for an object: the PPE traces the whole ray. */
#ifndef CGT_CONTROL_BLOCK_H
#define CGT_CONTROL_BLOCK_H

#include <stdint.h>

#define CGT_CONTROL_MAGIC 0x43475402u /* "CGT", version 2 */

/* ---- addresses ---- */

#define CGT_EA_CONTROL 0x00010000u /* of SPE i: + 128 i */
#define CGT_EA_REPORT 0x00011000u  /* of SPE i: + 128 i */
#define CGT_EA_CAMERA 0x00012000u
#define CGT_EA_SCENE 0x00013000u
#define CGT_EA_LIGHT 0x00014000u
#define CGT_EA_COLUMNS 0x00100000u
#define CGT_EA_ROWS 0x00200000u
#define CGT_EA_DOUBTS 0x00300000u   /* of SPE i: + i times the bytes of a ring */
#define CGT_EA_OBJECTS 0x01000000u  /* of the scene */
#define CGT_EA_IDS 0x40000000u      /* the id plane */
#define CGT_EA_OCCLUDED 0xc0000000u /* bits of the rays from hits */

/* ---- the frame ---- */

#define CGT_STRIP_ROWS 4u
#define CGT_STRIP_WIDTH 1280u
#define CGT_STRIP_PIECE 320u /* columns whose ids an SPE keeps, and sends together */
#define CGT_STRIP_END 0xffffffffu
#define CGT_FRAME_MAX_EDGE 32768u /* pixels: id plane and tables fit between the addresses above */

typedef enum cgt_control_flag {
    CGT_CONTROL_MAILBOX = 1,   /* take strips from the mailbox, after the own ones */
    CGT_CONTROL_FLATTENED = 2, /* one loop over the cells; else three */
    CGT_CONTROL_REMEMBER = 4,  /* do not test again what was tested lately (mailboxing) */
    CGT_CONTROL_CULL_SHIFT = 4 /* and above: a cgt_cull; all but NONE are FRUSTUM */
} cgt_control_flag;

/* 128 bytes. */
typedef struct cgt_control_block {
    uint32_t magic, spe, spes, flags;
    uint32_t width, height;
    uint32_t strip_columns; /* strips side by side */
    uint32_t first, strips, step;
    uint32_t row_bytes; /* of the id plane, a multiple of 128 */
    uint32_t half;      /* doubts of half a ring, a multiple of CGT_DOUBTS_LINE */
    uint32_t scene[2], camera[2], columns[2], rows[2], ids[2], doubts[2], report[2]; /* addresses */
    uint32_t light[2], occluded[2], occluded_bytes;                                  /* no light: zeros */
    uint32_t reserved;
} cgt_control_block;
_Static_assert(sizeof(cgt_control_block) == 128, "one line");

/* ---- images ---- */

/* The camera: the canonical rays (query/camera.h) are dir = column + row, each component rounded once, to nearest.
 * columns and rows are arrays of quads x, y, z, 0; subnormal numbers in them are 0. */
typedef struct cgt_camera_image {
    float eye[3], t_min, t_max;
    uint32_t tiny; /* 1: some number in columns or rows is below 2^-70, and not 0 */
    uint32_t reserved[26];
} cgt_camera_image;
_Static_assert(sizeof(cgt_camera_image) == 128, "one line");

#define CGT_LIGHT_SETS 16u /* rays of a hit, at most */

/* Rays from hits. Set 0 is a shadow ray where there is a light: from the hit to `position`, t up to 1. The other sets
 * run along `direction`, or against it, to where the hit's normal looks, t up to `t_max`. */
typedef struct cgt_light_image {
    float position[3], t_max;
    uint32_t sets, shadow; /* in all; 1: there is a light */
    uint32_t reserved[26];
    float direction[CGT_LIGHT_SETS][4]; /* of set k: x, y, z, 0 */
} cgt_light_image;
_Static_assert(sizeof(cgt_light_image) == 384, "three lines");

#define CGT_GRID_SPHERES 2048u /* that the program's local store holds: 16 bytes each */
#define CGT_GRID_CELLS 4096u   /* voxels of 32 bytes, 16 x 16 x 16 */
#define CGT_GRID_OVERFLOW 256u /* references that found 16 others in a voxel: 8 bytes each */
#define CGT_GRID_MAX_EDGE 32u  /* cells along an axis */

/* A scene of spheres for a grid. Objects are quads x, y, z, radius; a radius below 0: there is none of that number. */
typedef struct cgt_grid_image {
    uint32_t spheres; /* quads at `objects`, padded to 8 */
    uint32_t resolution[3];
    float org[3], rcell[3], cell_error[3]; /* papers/model/queue_grid.h */
    float scale;
    uint32_t objects[2];
    uint32_t reserved[16];
} cgt_grid_image;
_Static_assert(sizeof(cgt_grid_image) == 128, "one line");

/* ---- what comes back ---- */

#define CGT_DOUBTS_LINE 16u /* doubts of a DMA: 128 bytes */

typedef struct cgt_doubt {
    uint32_t pixel;  /* y << 16 | x */
    uint32_t object; /* of a ray from a hit: | the object that was hit << 12 | set + 1 << 23 */
} cgt_doubt;

#define CGT_DOUBT_ALL CGT_GRID_SPHERES
#define CGT_DOUBT_OBJECT(word) ((word)&0xfffu)
#define CGT_DOUBT_OWN(word) ((word) >> 12 & 0x7ffu)
#define CGT_DOUBT_SET(word) ((word) >> 23)
_Static_assert(CGT_GRID_SPHERES <= 1u << 11, "numbers of objects fit a doubt");

typedef enum cgt_report_state {
    CGT_REPORT_NONE = 0,
    CGT_REPORT_DONE,
    CGT_REPORT_BAD_CONTROL, /* not the words that the program knows */
    CGT_REPORT_SPHERES,     /* more than its store has room for; `value`: room */
    CGT_REPORT_CELLS,       /* the same of voxels */
    CGT_REPORT_OVERFLOW,    /* more references of full voxels than there is room for; value: room */
    CGT_REPORT_BAD_IMAGE    /* the scene's or the camera's numbers are out of range */
} cgt_report_state;

typedef struct cgt_spe_report {
    uint32_t state, value;
    uint32_t doubts;               /* all of them */
    uint32_t rest_half, rest;      /* those that no interrupt told of: so many in that half */
    uint32_t strips;               /* traced */
    uint32_t packets, cells;       /* visited */
    uint32_t references, overflow; /* of the grid; those in full voxels' overflow */
    uint32_t culled, tests;        /* spheres; spheres against packets */
    uint32_t built;                /* steps of the decrementer for the grid */
    uint32_t traced;               /* and from there on */
    uint32_t listed, remembered;   /* references that came to be tested; those of them that were not tested again */
    uint32_t light_rays;           /* from hits */
    uint32_t reserved[15];
} cgt_spe_report;
_Static_assert(sizeof(cgt_spe_report) == 128, "one line");

#endif

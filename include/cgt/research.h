/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * libcgt for research: structures, traversals and counters of published algorithms, beside those that cgt.h offers.
 * All of it is supported and tested, gives the same hits, and costs nothing where it is not used. The conventions are
 * those of cgt.h; 0 is the default of every field. A scene takes cgt_research_scene_options through
 * cgt_scene_options.research, a tracing call cgt_research_trace_options through cgt_trace_options.research.
 *
 * Queue grid, packets, loops, culling, mailbox, strips, local store
 *   David R. Chapman, "High Definition Interactive Animated Ray Tracing on CELL Processor using Coherent Grid
 *   Traversal"; Wald, Ize, Kensler, Knoll, Parker, "Ray Tracing Animated Scenes using Coherent Grid Traversal", 2006
 * kd-trees, layouts, ropes
 *   a thesis on ray casting on the Cell; MacDonald, Booth, "Heuristics for Ray Tracing using Space Subdivision", 1990;
 *   Popov, Guenther, Seidel, Slusallek, "Stackless KD-Tree Traversal for High Performance GPU Ray Tracing", 2007
 * Bounding interval hierarchy
 *   Waechter, Keller, "Instant Ray Tracing: The Bounding Interval Hierarchy", 2006
 * Triangle tests
 *   Moeller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997; Wald, "Realtime Ray Tracing and
 *   Interactive Global Illumination", 2004 */
#ifndef CGT_RESEARCH_H
#define CGT_RESEARCH_H

#include <cgt/cgt.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Scene -------------------------------------------------------------------------------------------------- */

/* More structures, values of cgt_structure.
 *   QUEUE_GRID   uniform grid of voxels, each a queue of 16 references (Chapman): of 16 bits, 32 bytes a voxel, up to
 *                65,535 primitives; of 32 bits, 64 bytes a voxel, beyond
 *   KD           kd-tree in nodes of 8 bytes, by the surface-area heuristic at the edges of equal bins, traversed with
 *                a stack
 *   KD_ROPES     the same tree with its leaves linked across their faces (Popov et al.), traversed without a stack; 80
 *                bytes a leaf more
 *   BIH          bounding interval hierarchy (Waechter, Keller) in nodes of 16 bytes: each primitive is in one leaf,
 *                and memory follows from their number; traversed with a stack */
#define CGT_STRUCTURE_QUEUE_GRID ((cgt_structure)3)
#define CGT_STRUCTURE_KD ((cgt_structure)4)
#define CGT_STRUCTURE_KD_ROPES ((cgt_structure)5)
#define CGT_STRUCTURE_BIH ((cgt_structure)6)

/* The order of a kd-tree's nodes in memory (thesis, figure 7.4). */
typedef enum cgt_kd_layout {
    CGT_KD_LAYOUT_AUTO = 0, /* the fastest as measured */
    CGT_KD_LAYOUT_DEPTH_FIRST,
    CGT_KD_LAYOUT_BREADTH_FIRST,
    CGT_KD_LAYOUT_MIXED /* breadth first down to the break level, depth first below each node there */
} cgt_kd_layout;

typedef struct cgt_research_scene_options {
    /* Cells of a grid along x, y, z, each at most 1024 and 16,777,216 in all; 0, 0, 0 (default): chosen from the scene
     * at each commit. With AUTO a resolution means QUEUE_GRID; a loose grid has one level then. */
    uint32_t resolution[3];
    cgt_kd_layout kd_layout;
    uint32_t kd_break_level; /* of MIXED: levels stored breadth first, at most 50; 0 (default): 8 */
} cgt_research_scene_options;

/* Fills in the defaults. */
CGT_API void cgt_research_scene_options_init(cgt_research_scene_options *options);

/* What cgt_scene_statistics does not tell of the last commit; all 0 where it does not apply. */
typedef struct cgt_research_scene_statistics {
    uint32_t resolution[3];  /* cells along x, y, z; of the loose grid's finest level */
    uint64_t cells;          /* of all levels */
    uint32_t levels;         /* of the loose grid: classes of sizes */
    uint32_t reference_bits; /* of a reference in a voxel or a leaf: 16 or 32 */
    /* Primitives in cells, counted once per cell, overflow included; of triangles that are grouped, groups of 8. */
    uint64_t references;
    uint64_t overflow_references; /* those that found a full queue and went to the overflow list */
    uint32_t overflow_cells;      /* cells with any of those */
    uint32_t large_primitives;    /* larger than a cell: more than eight corners to push */
    size_t local_store_bytes;     /* structure and primitives together: what a Cell SPU has to hold */
    /* Local_store_bytes and 64 KB for program and stack are within 256 KB, and a queue grid is at most 16x16x16. */
    bool fits_local_store;
    uint32_t kd_nodes;        /* of 8 bytes, inner ones and leaves */
    uint32_t kd_leaves;       /* of those */
    uint32_t kd_empty_leaves; /* of those */
    uint32_t kd_depth;        /* inner nodes on the longest path from the root to a leaf */
    uint32_t kd_largest_leaf; /* primitives */
    double kd_cost;           /* of the surface-area heuristic for the whole tree, in units of one sphere test */
    cgt_kd_layout kd_layout;  /* that was used */
    uint32_t bvh_nodes;
    uint32_t bvh_leaves;       /* of up to as many primitives as the variant has lanes, copied */
    uint32_t bvh_depth;        /* nodes on the longest path from the root to a leaf */
    uint32_t bih_nodes;        /* of 16 bytes, inner ones and leaves */
    uint32_t bih_leaves;       /* of those; of up to eight primitives, but where many have the same box */
    uint32_t bih_depth;        /* splits on the longest path from the root to a leaf, at most 50 */
    uint32_t bih_largest_leaf; /* primitives */
} cgt_research_scene_statistics;

/* Copies the research statistics of the last commit that has ended; all 0 before the first. Any thread may call it,
 * callbacks included. Errors: INVALID_ARGUMENT (a NULL). */
CGT_API cgt_result cgt_research_get_scene_statistics(const cgt_scene *scene, cgt_research_scene_statistics *statistics);

/* ---- Tracing ------------------------------------------------------------------------------------------------ */

/* How a frame is cut into tasks. */
typedef enum cgt_tile_shape {
    CGT_TILE_SHAPE_AUTO = 0, /* SQUARE */
    CGT_TILE_SHAPE_SQUARE,   /* 64x64 pixels */
    CGT_TILE_SHAPE_STRIP     /* Chapman's: four scanlines, 1,280 pixels at most, in scanline order; packets are 4x4 */
} cgt_tile_shape;

/* How packets go through a grid. */
typedef enum cgt_loop {
    CGT_LOOP_AUTO = 0, /* the faster as measured */
    CGT_LOOP_NESTED,   /* slices, rows and cells as three loops (Wald et al.) */
    /* One loop that steps all three without a branch (Chapman), right for empty slices and for bounds that change
     * from slice to slice. */
    CGT_LOOP_FLATTENED
} cgt_loop;

/* Which primitives of a cell are tested against which rays of a packet. */
typedef enum cgt_cull {
    CGT_CULL_AUTO = 0, /* BLOCKS */
    CGT_CULL_NONE,     /* all against all */
    CGT_CULL_FRUSTUM,  /* those that touch the packet's frustum (Wald et al., Chapman) */
    CGT_CULL_BLOCKS    /* and of those, the ones that touch a cone around each 16 of its rays */
} cgt_cull;

/* Whether a packet remembers the primitives that it has lately been tested against. */
typedef enum cgt_mailbox {
    /* ON: it saves a fifth of the time, where Chapman expected a loss; measured in
     * docs/reports/coherent_grid_traversal.md. */
    CGT_MAILBOX_AUTO = 0,
    CGT_MAILBOX_ON,
    CGT_MAILBOX_OFF
} cgt_mailbox;

/* How packets go through a kd-tree or a bounding interval hierarchy. */
typedef enum cgt_kd_traversal {
    CGT_KD_TRAVERSAL_AUTO = 0, /* the faster as measured */
    CGT_KD_TRAVERSAL_SINGLE,   /* one ray at a time */
    CGT_KD_TRAVERSAL_PACKET    /* as many rays as the variant has lanes, of any directions */
} cgt_kd_traversal;

/* How packets of rays through queue grids, kd-trees and BIHs test triangles. Others than AUTO decide by single
 * precision alone, and so do spheres then: rays that pass within some units in the last place of an edge or a
 * silhouette may go either way, ranges count with the t that the test finds, t, u and v are what it leaves, and results
 * differ between variants. Rays through a loose grid or a BVH, of scenes in bands (cgt_scene_commit) and of extreme
 * magnitudes are decided exactly whatever it says. */
typedef enum cgt_triangle_test {
    CGT_TRIANGLE_TEST_AUTO = 0, /* edge functions with error bounds; what they leave open is decided exactly */
    /* Edge functions of the ray's Pluecker coordinates, which lose as many bits as the scene is farther from the origin
     * than large. The two triangles at an edge find the same side of it, so that no ray passes between them, but for
     * one along a plane that splits a tree, where the tree chooses */
    CGT_TRIANGLE_TEST_WATERTIGHT,
    CGT_TRIANGLE_TEST_MOLLER_TRUMBORE, /* Moeller, Trumbore 1997 */
    CGT_TRIANGLE_TEST_ACCELERATED      /* projected onto the main plane (Wald 2004), from 48 bytes a triangle */
} cgt_triangle_test;

/* What cgt_trace_statistics does not tell of a call. Tiles that went through a loose grid as a whole count as packets
 * do, but not in cells and mailbox_skipped: each reference that a tile reads is a cull test, and each primitive that it
 * draws is a packet test. */
typedef struct cgt_research_trace_statistics {
    uint64_t split_packets; /* packets that were split because their rays disagreed or diverged */
    uint64_t slices;        /* slices of the grid that a packet entered */
    uint64_t cells;         /* cells that a packet visited */
    uint64_t nodes;         /* inner nodes of a tree that a ray or a packet visited */
    uint64_t leaves;        /* leaves that a ray or a packet visited */
    uint64_t rope_steps;    /* from leaf to leaf, by a ray or a packet */
    uint64_t exact_steps;   /* steps whose next plane rounded arithmetic could not decide */
    uint64_t rope_loops;    /* rays that came to a leaf a second time: 0 by construction, and counted */
    /* References read from cells, overflow included; of groups of triangles, the triangles of those that were not
     * culled count, too. */
    uint64_t references;
    uint64_t mailbox_skipped; /* references that the mailbox had seen before */
    uint64_t cull_tests;      /* primitives, and groups of triangles, tested against a packet's frustum */
    uint64_t culled;          /* of those, the ones that the test rejected */
    uint64_t early_exits;     /* packets whose hits all lay before the next slice */
    uint64_t given_up; /* points against a light that tiles gave up, and that went another way; each time counts */
    /* Why the points of the call's last light went by tiles or not: a text that is never freed; "" without a light. */
    const char *light_way;
    uint32_t packet_size; /* edge of a camera's packets, 4, 8 or 16; 0 for arrays of rays */
    cgt_tile_shape tile;  /* that was used */
    cgt_loop loop;        /* that was used */
} cgt_research_trace_statistics;

/* Packets go through the papers' structures. A loose grid is traced by whole tiles if packet, tile, loop, cull, mailbox
 * and triangle_test are all 0, else ray by ray. */
typedef struct cgt_research_trace_options {
    uint32_t packet; /* edge of a camera's packets in pixels: 4, 8, 16; 0 (default): 16, in strips 4 */
    cgt_tile_shape tile;
    cgt_loop loop;
    cgt_cull cull;
    cgt_mailbox mailbox;
    cgt_kd_traversal kd_traversal;
    cgt_triangle_test triangle_test;           /* other than AUTO only with precision FAST, and without capsules */
    cgt_research_trace_statistics *statistics; /* gets the research statistics of the call; NULL (default): none */
} cgt_research_trace_options;

/* Fills in the defaults. */
CGT_API void cgt_research_trace_options_init(cgt_research_trace_options *options);

#ifdef __cplusplus
}
#endif

#endif

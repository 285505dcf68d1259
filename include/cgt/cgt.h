/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * libcgt: ray casting of scenes in which every primitive moves every frame.
 *
 *   context   threads, memory, log; makes scenes
 *   scene     geometries over the caller's own arrays
 *   commit    builds the structure from the arrays as they are now, from scratch
 *   trace     a camera's frame, or any array of rays, against the committed scene
 *
 * A frame is: move your data, cgt_scene_commit, cgt_trace_camera.
 *
 * Conventions of every call
 *   Result   cgt_result. On an error nothing is changed but the text that cgt_context_get_error_message returns.
 *   NULL     allowed only where a text below says so.
 *   Threads  a scene is changed and committed by one thread at a time, while no thread traces it; a committed
 *            scene may be traced by any number of threads at once. There is no global state.
 *   Floats   IEEE single precision. The caller's rounding mode and flushing of denormals do not matter: commit and
 *            tracing work in the default environment and give the caller's back.
 *
 * Structures: a loose grid, which camera frames go through tile by tile; a wide tree for rays that go anywhere;
 * Chapman's queue grid; and the kd-tree of a thesis on ray casting on the Cell, with a stack or with ropes. Hits are
 * the same bits through each. Papers: David R. Chapman, "High Definition Interactive Animated Ray Tracing on CELL
 * Processor using Coherent Grid Traversal"; Wald, Ize, Kensler, Knoll, Parker, "Ray Tracing Animated Scenes using
 * Coherent Grid Traversal", SIGGRAPH 2006; Popov, Guenther, Seidel, Slusallek, "Stackless KD-Tree Traversal for High
 * Performance GPU Ray Tracing", 2007. */
#ifndef CGT_CGT_H
#define CGT_CGT_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/version.h>

#if defined(CGT_SHARED) && defined(__GNUC__)
#define CGT_API __attribute__((visibility("default")))
#else
#define CGT_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Results ------------------------------------------------------------------------------------------------ */

typedef enum cgt_result {
    CGT_OK = 0,
    CGT_ERROR_INVALID_ARGUMENT, /* a value is outside its documented range; the message names it */
    CGT_ERROR_OUT_OF_MEMORY,    /* the memory hook returned NULL; nothing is lost, the call may be tried again */
    CGT_ERROR_TOO_LARGE,        /* a size would overflow, or is beyond a documented limit */
    CGT_ERROR_NOT_COMMITTED,    /* the scene was never committed, or a geometry was changed since */
    CGT_ERROR_UNSUPPORTED,      /* this CPU or this build lacks what was asked for */
    CGT_ERROR_THREADS,          /* the system refused a thread or a lock */
    CGT_ERROR_STOPPED           /* a visitor asked to stop; the frame is incomplete */
} cgt_result;

/* Returns a sentence for the code, in English, for ever valid. Unknown codes get a sentence too. */
CGT_API const char *cgt_get_result_string(cgt_result result);

/* Returns the version of the library that is linked, as "major.minor.patch"; compare with CGT_VERSION_STRING. */
CGT_API const char *cgt_get_version(void);

/* ---- Hooks -------------------------------------------------------------------------------------------------- */

/* Memory. allocate returns at least `bytes` bytes aligned to `alignment` (a power of two, at most 64), or NULL.
 * release gets what allocate returned and the same number of bytes; never NULL. Both are called from the thread
 * that makes the call into the library, never from a worker thread. */
typedef struct cgt_memory_hooks {
    void *user;                                                    /* handed to both; default NULL */
    void *(*allocate)(void *user, size_t bytes, size_t alignment); /* default: the C library's */
    void (*release)(void *user, void *memory, size_t bytes);       /* default: the C library's */
} cgt_memory_hooks;

typedef enum cgt_log_level { CGT_LOG_LEVEL_ERROR = 0, CGT_LOG_LEVEL_WARNING, CGT_LOG_LEVEL_INFO } cgt_log_level;

/* Log. write gets one line without a line feed; it may be called from any thread that calls the library. */
typedef struct cgt_log_hook {
    void *user;                                                          /* handed to write; default NULL */
    void (*write)(void *user, cgt_log_level level, const char *message); /* default NULL: silent */
} cgt_log_hook;

/* One piece of work: `index` counts from 0 to count - 1. Pieces are independent of each other. */
typedef void cgt_task(void *argument, uint32_t index);

/* Tasks. run calls task(argument, index) once for each index below count, in any order, on any threads, and returns
 * when all have returned. With a runner set the library starts no thread of its own. A runner that runs the tasks
 * one after another on the calling thread is valid. Results do not depend on the order. A task takes up to 1.25 MB
 * of stack. */
typedef struct cgt_task_runner {
    void *user;                                                              /* handed to run; default NULL */
    void (*run)(void *user, cgt_task *task, void *argument, uint32_t count); /* default NULL: own thread pool */
} cgt_task_runner;

/* ---- Context ------------------------------------------------------------------------------------------------ */

typedef struct cgt_context cgt_context;

typedef struct cgt_context_options {
    uint32_t threads;        /* threads that work, the caller's included: 1 starts none; 0 (default) one per CPU that
                                the process may use; at most 1024. Ignored where tasks.run is set. */
    const char *variant;     /* name of a row of cgt_get_variant_names; NULL (default): the widest that this CPU runs */
    cgt_memory_hooks memory; /* both functions or neither */
    cgt_log_hook log;
    cgt_task_runner tasks;
} cgt_context_options;

/* Fills in the defaults. Call it first, so that options that come later have theirs. */
CGT_API void cgt_context_options_init(cgt_context_options *options);

/* Creates a context. options: NULL for the defaults; need not outlive the call. context: gets the handle, or NULL on
 * an error. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, UNSUPPORTED (variant), THREADS.
 * The environment variable CGT_DISABLE_CPU names variants to do without, comma-separated (avx512,avx2): they count as
 * if the CPU did not run them. A name that no variant of any build has ends the process, so that a test never believes
 * in a mask that is not there. */
CGT_API cgt_result cgt_context_create(const cgt_context_options *options, cgt_context **context);

/* Gives the context back. It stays until its last scene is released; NULL is ignored. */
CGT_API void cgt_context_release(cgt_context *context);

/* Copies the message of the last call on this context, or on a scene of it, that failed into text (ended by a zero,
 * cut to size bytes; NULL with size 0 to ask for the length). Returns the length of the whole message; 0 where no
 * call has failed. Any thread may call it; where several threads fail at once, one of their messages is kept. */
CGT_API size_t cgt_context_get_error_message(const cgt_context *context, char *text, size_t size);

/* Returns the name of the variant that the context uses, valid as long as the library is loaded. */
CGT_API const char *cgt_context_get_variant(const cgt_context *context);

/* Returns the number of threads that work for the context; 0 where the caller's task runner does. */
CGT_API uint32_t cgt_context_get_threads(const cgt_context *context);

/* Returns the names of all variants in this build, narrowest first, ended by NULL. A CPU need not run them all. */
CGT_API const char *const *cgt_get_variant_names(void);

/* ---- Scene -------------------------------------------------------------------------------------------------- */

typedef struct cgt_scene cgt_scene;

#define CGT_INVALID_ID UINT32_MAX /* the primitive and the geometry of a ray that hits nothing */

/* Spheres in the caller's arrays. The library copies nothing: the arrays stay readable and unchanged from
 * cgt_scene_commit to the last trace before the next commit. Pointers are aligned as a float is.
 * A sphere with a NaN, an infinity or a negative radius is skipped and counted; a radius of zero is a point, hit by
 * the rays that pass exactly through it. */
typedef struct cgt_spheres {
    uint32_t count;       /* spheres; 0 is valid */
    const float *centers; /* x, y, z of sphere i at byte i * center_stride; NULL only where count is 0 */
    size_t center_stride; /* bytes, a multiple of 4; 0 (default): 12 */
    const float *radii;   /* radius of sphere i at byte i * radius_stride; NULL: all have `radius` */
    size_t radius_stride; /* bytes, a multiple of 4; 0 (default): 4 */
    float radius;         /* world units, used where radii is NULL; 0 or more */
    uint32_t mask;        /* the geometry counts for a ray where this and the ray's mask have a bit in common; 0
                             (default): all bits set. From the next commit on, like all that is here */
} cgt_spheres;

/* Triangles in the caller's arrays, which the library does not copy: as with spheres they stay readable and unchanged
 * from commit to the last trace. Both sides of a triangle are hit, edges and vertices belong to it, and a ray that runs
 * in its plane misses it. A triangle with a NaN or an infinity in a vertex is skipped and counted; one without an area,
 * which no ray can hit, is counted and left out. An index that is not below vertex_count fails the commit. Scenes of
 * triangles alone, many of them, are built and traced faster where neighbours come one after the other, as meshes mostly
 * have them: runs of eight go as one then. */
typedef struct cgt_triangles {
    uint32_t count;          /* triangles; 0 is valid */
    const uint32_t *indices; /* the three vertices of triangle i at byte i * index_stride; NULL: 3i, 3i + 1, 3i + 2 */
    size_t index_stride;     /* bytes, a multiple of 4; 0 (default): 12 */
    uint32_t vertex_count;   /* vertices */
    const float *vertices;   /* x, y, z of vertex j at byte j * vertex_stride; NULL only where vertex_count is 0 */
    size_t vertex_stride;    /* bytes, a multiple of 4; 0 (default): 12 */
    uint32_t mask;           /* as of cgt_spheres */
} cgt_triangles;

typedef enum cgt_structure {
    CGT_STRUCTURE_AUTO = 0,   /* QUEUE_GRID where a resolution is given; else LOOSE_GRID, or WIDE_TREE for incoherent
                                 rays. It follows from the options alone, whatever the scene. Beside that LOOSE_GRID a
                                 wide tree is built when arrays of rays come that are many enough to pay for it: by
                                 cgt_trace_rays and cgt_occluded_rays, once a commit */
    CGT_STRUCTURE_QUEUE_GRID, /* uniform grid of voxels, each a queue of 16 references (Chapman): of 16 bits, 32 bytes a
                                 voxel, up to 65,535 primitives; of 32 bits, 64 bytes a voxel, beyond */
    CGT_STRUCTURE_KD,         /* kd-tree in nodes of 8 bytes, by the surface-area heuristic; traversed with a stack */
    CGT_STRUCTURE_KD_ROPES,   /* the same tree, its leaves linked across their faces (Popov et al. 2007); traversed
                                 without a stack; 80 bytes a leaf more */
    CGT_STRUCTURE_LOOSE_GRID, /* uniform grids, one for each class of sizes; each primitive lies in one cell, that of its
                                 middle: 4 to 6 bytes a primitive, built in linear time. A camera's frame goes through
                                 it by tiles of 64x64 pixels, see cgt_trace_options.packet */
    CGT_STRUCTURE_BVH         /* tree of boxes with as many children to a node as the variant has lanes, over copies of
                                 the primitives: for rays that start anywhere and go anywhere */
} cgt_structure;

/* What rays the scene is mostly traced with, for AUTO. */
typedef enum cgt_ray_kind {
    CGT_RAY_KIND_COHERENT = 0, /* cgt_trace_camera, or arrays in which neighbours run side by side */
    CGT_RAY_KIND_INCOHERENT    /* arrays of rays that start anywhere and go anywhere: occlusion, bounces, queries */
} cgt_ray_kind;

/* How a kd-tree is built. Both minimise the surface-area heuristic (MacDonald, Booth 1990) and give the same tree for
 * any number of threads. */
typedef enum cgt_kd_builder {
    CGT_KD_BUILDER_AUTO = 0, /* BINNED: the scene is rebuilt every frame */
    CGT_KD_BUILDER_BINNED,   /* candidate planes at the edges of equal bins */
    CGT_KD_BUILDER_SWEEP     /* all candidate planes, in O(N log N) (Wald, Havran 2006): for scenes that stay */
} cgt_kd_builder;

/* The order of a kd-tree's nodes in memory (thesis, figure 7.4). */
typedef enum cgt_kd_layout {
    CGT_KD_LAYOUT_AUTO = 0, /* what measured best */
    CGT_KD_LAYOUT_DEPTH_FIRST,
    CGT_KD_LAYOUT_BREADTH_FIRST,
    CGT_KD_LAYOUT_MIXED /* breadth first down to the break level, depth first below each node there */
} cgt_kd_layout;

typedef struct cgt_scene_options {
    cgt_structure structure;   /* default AUTO */
    uint32_t resolution[3];    /* of the grid: cells along x, y, z, each 1 to 1024 and 16,777,216 in all; 0, 0, 0
                                  (default): chosen from the scene at each commit. A loose grid has one level then */
    cgt_ray_kind rays;         /* default CAMERA */
    cgt_kd_builder kd_builder; /* default AUTO */
    cgt_kd_layout kd_layout;   /* default AUTO */
    uint32_t kd_break_level;   /* of MIXED: levels stored breadth first, 1 to 50; 0 (default): 8 */
} cgt_scene_options;

CGT_API void cgt_scene_options_init(cgt_scene_options *options);

/* Creates an empty scene. options: NULL for the defaults; need not outlive the call. */
CGT_API cgt_result cgt_scene_create(cgt_context *context, const cgt_scene_options *options, cgt_scene **scene);

/* Gives the scene back; NULL is ignored. No thread may be using it. */
CGT_API void cgt_scene_release(cgt_scene *scene);

/* Changes the options from the next commit on; until then the scene counts as not committed. */
CGT_API cgt_result cgt_scene_set_options(cgt_scene *scene, const cgt_scene_options *options);

/* Adds a geometry; geometry gets its id: the lowest that is free. The struct need not outlive the call, the arrays
 * that it points to must. The sum of the counts of all geometries stays below 2^32 - 1. */
CGT_API cgt_result cgt_scene_add_spheres(cgt_scene *scene, const cgt_spheres *spheres, uint32_t *geometry);

/* Replaces a geometry: another count, other arrays. Where only the numbers inside the arrays moved, no call but
 * cgt_scene_commit is needed. */
CGT_API cgt_result cgt_scene_update_spheres(cgt_scene *scene, uint32_t geometry, const cgt_spheres *spheres);

/* The same for triangles. A geometry keeps its kind: updating it as the other one is INVALID_ARGUMENT. */
CGT_API cgt_result cgt_scene_add_triangles(cgt_scene *scene, const cgt_triangles *triangles, uint32_t *geometry);
CGT_API cgt_result cgt_scene_update_triangles(cgt_scene *scene, uint32_t geometry, const cgt_triangles *triangles);

CGT_API cgt_result cgt_scene_remove_geometry(cgt_scene *scene, uint32_t geometry);

/* Builds the structure from the arrays as they are now. Uses the context's threads. Memory is kept from one commit to
 * the next and grows by half: a scene whose count does not grow allocates nothing, once its overflow list or its tree
 * has found its size. Errors: INVALID_ARGUMENT (a triangle's index is out of range), OUT_OF_MEMORY, TOO_LARGE (a wide
 * tree of more than 2^26 - 1 leaves among others); after an error the scene counts as not committed. An empty scene is
 * valid: no ray hits it. */
CGT_API cgt_result cgt_scene_commit(cgt_scene *scene);

/* What the last commit found, chose and spent. */
typedef struct cgt_scene_statistics {
    cgt_structure structure;     /* what was built; AUTO before the first commit */
    char reason[128];            /* why, in words */
    uint32_t geometries;         /* that the scene holds */
    uint32_t primitives;         /* given, skipped ones included */
    uint32_t spheres, triangles; /* of those */
    uint32_t skipped_not_finite; /* primitives with a NaN or an infinity */
    uint32_t skipped_radius;     /* spheres with a negative radius */
    uint32_t skipped_degenerate; /* triangles without an area */
    float bounds_min[3];         /* of all that was not skipped, rounded outwards; 0 where there is nothing */
    float bounds_max[3];
    uint32_t resolution[3]; /* cells along x, y, z; of the loose grid's finest level */
    uint64_t cells;
    uint32_t levels;              /* of the loose grid: classes of sizes */
    uint32_t reference_bits;      /* of a reference in a voxel: 16 or 32 */
    uint64_t references;          /* primitives in cells, counted once per cell, overflow included; of triangles that
                                     are neighbours one after the other, runs of 8 */
    uint64_t overflow_references; /* those that found a full queue and went to the overflow list */
    uint32_t overflow_cells;      /* cells with any of those */
    uint32_t large_primitives;    /* larger than a cell: more than eight corners to push */
    uint32_t kd_nodes;            /* of 8 bytes, inner ones and leaves */
    uint32_t kd_leaves;           /* of those */
    uint32_t kd_empty_leaves;     /* of those */
    uint32_t kd_depth;            /* inner nodes on the longest way from the root to a leaf */
    uint32_t kd_largest_leaf;     /* primitives */
    double kd_cost;               /* of the surface-area heuristic for the whole tree, in units of one sphere test */
    cgt_kd_builder kd_builder;    /* what was used */
    cgt_kd_layout kd_layout;      /* what was used */
    size_t structure_bytes;       /* that traversal reads: voxels and overflow list, cells and references, or nodes,
                                     references and ropes; without the primitives, and the 48 bytes that a tree keeps of
                                     each triangle */
    size_t bytes;                 /* memory that the scene holds now */
    size_t local_store_bytes;     /* structure and primitives together: what a Cell SPU has to hold */
    int fits_local_store;         /* 1 where local_store_bytes, with 64 KB for program and stack, is within
                                     256 KB, and a queue grid is at most 16x16x16 */
    uint32_t bvh_nodes;           /* of the wide tree; all wide_ fields are 0 where there is none */
    uint32_t bvh_leaves;          /* its leaves: up to as many primitives as the variant has lanes, copied */
    uint32_t bvh_depth;           /* nodes on the longest way from the root to a leaf */
    size_t bvh_bytes;             /* nodes and blocks */
    double bvh_build_ms;          /* building it, at the commit or, for AUTO, when rays came that wanted it */
    double bounds_ms;             /* reading, checking and bounding the primitives */
    double build_ms;              /* filling the structure */
    double commit_ms;             /* the whole call */
} cgt_scene_statistics;

CGT_API cgt_result cgt_scene_get_statistics(const cgt_scene *scene, cgt_scene_statistics *statistics);

/* ---- Tracing ------------------------------------------------------------------------------------------------ */

/* What a hit can carry; unasked fields cost nothing. */
typedef enum cgt_field {
    CGT_FIELD_T = 1,         /* float: distance in units of the ray's direction; +infinity for none */
    CGT_FIELD_PRIMITIVE = 2, /* uint32: index in its geometry; CGT_INVALID_ID for none */
    CGT_FIELD_GEOMETRY = 4,  /* uint32: id of the geometry; CGT_INVALID_ID for none */
    CGT_FIELD_NORMAL = 8,    /* 3 floats: unit normal, outward of a sphere, of a triangle along
                                (v1 - v0) x (v2 - v0); 0, 0, 0 for none */
    CGT_FIELD_UV = 16 /* 2 floats, u and v: the hit is (1 - u - v) v0 + u v1 + v v2; 0, 0 on a sphere and for none */
} cgt_field;

typedef enum cgt_tile_shape {
    CGT_TILE_SHAPE_AUTO = 0, /* chosen: square */
    CGT_TILE_SHAPE_SQUARE,   /* 64x64 pixels */
    CGT_TILE_SHAPE_STRIP /* Chapman's: four scanlines, 1,280 pixels at most, written in scanline order; packets are 4x4 */
} cgt_tile_shape;

typedef enum cgt_loop {
    CGT_LOOP_AUTO = 0, /* chosen: what measured faster */
    CGT_LOOP_NESTED,   /* slices, rows and cells as three loops (Wald et al.) */
    CGT_LOOP_FLATTENED /* one loop that steps all three without a branch (Chapman), right for empty slices and for
                          bounds that change from slice to slice */
} cgt_loop;

/* How packets go through a kd-tree. */
typedef enum cgt_kd_traversal {
    CGT_KD_TRAVERSAL_AUTO = 0, /* what measured faster */
    CGT_KD_TRAVERSAL_SINGLE,   /* one ray at a time */
    CGT_KD_TRAVERSAL_PACKET    /* as many rays as the variant has lanes, of any directions */
} cgt_kd_traversal;

typedef enum cgt_cull {
    CGT_CULL_NONE = 0, /* every primitive of a cell meets every ray of the packet */
    CGT_CULL_FRUSTUM,  /* primitives are first tested against the packet's frustum (Wald et al., Chapman) */
    CGT_CULL_BLOCKS    /* and then against a cone around every 16 of its rays */
} cgt_cull;

/* How right hits are: which ray hits which primitive, and how exact t, u, v and the normal are.
 * Decisions. ROBUST and EXACT find the hit that exact arithmetic finds on the same float input: none missed at an edge,
 * a vertex or a silhouette, none invented, the nearest one, and of equal ones the lowest id. FAST decides by single
 * precision: rays that pass within some units in the last place of an edge or a silhouette may go either way, and
 * results may differ from variant to variant. (Where a camera's frame goes by tiles through a loose grid, exact
 * decisions cost so little that FAST makes them too, and saves on t and the normal of spheres alone. Through a wide tree
 * FAST is ROBUST.)
 * Values, see cgt_trace_camera. */
typedef enum cgt_precision { CGT_PRECISION_ROBUST = 0, CGT_PRECISION_FAST, CGT_PRECISION_EXACT } cgt_precision;

/* How FAST tests triangles. ROBUST and EXACT need an error bound, which WATERTIGHT has. */
typedef enum cgt_triangle_test {
    CGT_TRIANGLE_TEST_WATERTIGHT = 0, /* edge functions of the ray's Pluecker coordinates */
    CGT_TRIANGLE_TEST_MOLLER_TRUMBORE, /* Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997 */
    CGT_TRIANGLE_TEST_ACCELERATED      /* projected onto the main plane (Wald 2004), from 48 bytes a triangle */
} cgt_triangle_test;

/* What a trace did. Handed out only where a statistics pointer is set. Where tiles went through a loose grid as a whole
 * they count as packets do, but not in packets, cells and mailbox_skipped: each reference that a tile met is a cull
 * test, what it did not cull is drawn, and each drawing is a packet test. */
typedef struct cgt_trace_statistics {
    uint64_t rays;            /* asked for */
    uint64_t invalid_rays;    /* with a NaN or an infinity in origin or direction, a zero direction, or a NaN range:
                                 they hit nothing */
    uint64_t hits;            /* rays with a hit; occluded rays in the any-hit form */
    uint64_t bvh_rays;        /* that went through a wide tree */
    uint64_t tiles;           /* tiles of a camera's frame, or of points against a light, that went through a loose grid
                                 as a whole, not by packets */
    uint64_t packets;         /* packets traversed: common main axis and sign */
    uint64_t split_packets;   /* packets that had to be split because their rays disagreed or diverged */
    uint64_t slices;          /* slices of the grid that a packet entered */
    uint64_t cells;           /* cells that a packet visited */
    uint64_t nodes;           /* inner nodes of a kd-tree that a ray or a packet visited */
    uint64_t leaves;          /* leaves that a ray or a packet visited */
    uint64_t rope_steps;      /* from leaf to leaf, by a ray or a packet */
    uint64_t exact_steps;     /* steps that rounded arithmetic could not decide: which plane a ray meets first */
    uint64_t rope_loops;      /* rays that came to a leaf a second time: 0 by construction, and counted */
    uint64_t references;      /* references read from cells, overflow included; where those are to runs of triangles,
                                 the triangles of runs that were not left out count, too */
    uint64_t mailbox_skipped; /* references that the mailbox had seen before */
    uint64_t cull_tests;      /* primitives, and runs of triangles, tested against a packet's frustum */
    uint64_t culled;          /* of those, the ones that the frustum test rejected */
    uint64_t packet_tests;    /* primitives tested against the rays of a packet */
    uint64_t ray_tests;       /* rays tested against a primitive, by whole blocks of 16; in tiles by whole vectors */
    uint64_t double_tests;    /* of those, the ones that single precision could not decide: the ambiguous ones */
    uint64_t exact_tests;     /* of those, the ones that double precision could not decide either */
    uint64_t exact_values;    /* hits of which t, u or v were computed in exact arithmetic, since double cancels */
    uint64_t early_exits;     /* packets whose hits all lay before the next slice */
    uint32_t packet_size;     /* 4, 8 or 16 of a camera's packets, where there were any; 0 for arrays of rays */
    cgt_tile_shape tile;      /* what was used */
    cgt_loop loop;            /* what was used */
    double trace_ms;          /* the whole call */
} cgt_trace_statistics;

typedef struct cgt_trace_options {
    cgt_precision precision;         /* default ROBUST */
    cgt_triangle_test triangle_test; /* default WATERTIGHT; the others only with FAST */
    uint32_t packet;               /* edge of a camera's packets in pixels: 4, 8, 16; 0 (default): 16, in strips 4; in a
                                         loose grid whole tiles, unless packet, tile, loop, cull or mailbox is set */
    cgt_tile_shape tile;           /* default AUTO */
    cgt_loop loop;                 /* default AUTO */
    cgt_cull cull;                 /* default CGT_CULL_BLOCKS */
    cgt_kd_traversal kd_traversal; /* default AUTO */
    int mailbox;                   /* remember the primitives that a packet has met lately; default 1: it saves a
                                         fifth of the time (docs/coherent_grid_traversal.md); Chapman expected a loss */
    cgt_trace_statistics *statistics; /* gets the counts of this call; NULL (default): nothing is counted */
} cgt_trace_options;

CGT_API void cgt_trace_options_init(cgt_trace_options *options);

typedef enum cgt_projection { CGT_PROJECTION_PERSPECTIVE = 0, CGT_PROJECTION_ORTHOGRAPHIC } cgt_projection;

/* A camera. With fwd, right, up its orthonormal axes, h = tan(fov / 2) and a = width / height, the ray of pixel
 * (x, y), row 0 at the top, is
 *   perspective   org = eye,  dir = fwd + (2(x + 0.5)/width - 1) h a right + (1 - 2(y + 0.5)/height) h up
 *   orthographic  org = eye + the same sum of right and up with h = height / 2,  dir = fwd
 * dir is not normalised; t is in units of dir. */
typedef struct cgt_camera {
    cgt_projection projection;
    float eye[3];
    float target[3]; /* must differ from eye */
    float up[3];     /* must not be parallel to target - eye */
    float fov;       /* perspective: vertical angle in degrees, above 0, below 180; default 45 */
    float height;    /* orthographic: height of the picture in world units, above 0; default 2 */
    float t_min;     /* hits before are ignored; 0 (default) or more */
    float t_max;     /* hits beyond are ignored; default +infinity; not below t_min */
    uint32_t mask;   /* of its rays, see cgt_rays; 0 (default): all bits set. A frame for which it hides something goes
                        packet by packet, slower through a loose grid */
} cgt_camera;

/* Fills in the defaults: perspective, from (0, 0, 5) to the origin, up (0, 1, 0). */
CGT_API void cgt_camera_init(cgt_camera *camera);

/* A finished tile. Pointers are NULL where the field was not asked for; pixel (i, j) of the tile, i < width,
 * j < height, is element j * row_stride + i. Valid during the call only. */
typedef struct cgt_tile {
    uint32_t x, y;          /* first pixel in the frame */
    uint32_t width, height; /* pixels */
    size_t row_stride;      /* elements */
    const float *t;
    const uint32_t *primitive;
    const uint32_t *geometry;
    const float *normal[3];
    const float *u, *v;
} cgt_tile;

/* Called once per tile, from the threads that trace, several at once, in any order. Returns 0 to go on; anything
 * else stops the frame: cgt_trace_camera returns CGT_ERROR_STOPPED. */
typedef int cgt_tile_visitor(void *user, const cgt_tile *tile);

/* Where a camera's frame goes: into planes, to a visitor while the tile is in cache, or both. Any planes will do; it is
 * fastest where all begin at multiples of 64 bytes, each 64 further into a page of memory than the one before, and
 * row_stride is a multiple of 16 elements: without a visitor, tiles are then stored past the caches, by whole lines. */
typedef struct cgt_frame {
    uint32_t width, height; /* pixels, each 1 to 65,536 */
    size_t row_stride;      /* elements from one row of the planes to the next; 0 (default): width */
    float *t;               /* planes of row_stride * height elements, aligned as their type; NULL: not wanted */
    uint32_t *primitive;
    uint32_t *geometry;
    float *normal[3];          /* all three or none */
    float *u, *v;              /* both or none */
    cgt_tile_visitor *visitor; /* NULL: none */
    void *visitor_user;        /* handed to the visitor */
    uint32_t visitor_fields;   /* cgt_field values that the visitor is to get, combined */
} cgt_frame;

/* Sets all to zero but the size: ask for what you want. */
CGT_API void cgt_frame_init(cgt_frame *frame, uint32_t width, uint32_t height);

/* Traces one ray per pixel to its nearest hit.
 * In precisions ROBUST and EXACT the hit is the one that exact arithmetic finds on the same float input, whatever its
 * scale. A hit counts where t_min <= t <= t_max, t as it is handed out; of equal exact distances the lowest geometry,
 * then primitive id wins. An origin inside a sphere hits its far side; on its surface, t = 0. A t beyond the range of
 * float is no hit. t is the exact one rounded to float, at most 0.51 ulp off. The same bits come from any number of
 * threads, tile shape, packet size, loop and variant.
 *   ROBUST  u, v and the normal are computed in double and rounded: u and v are within 2^-24 + 2^-45 k, k the product
 *           of the distances to the triangle's two farther vertices over its area as the ray sees it; the normal
 *           of a sphere is within 2^-23 + 2^-48 c / r, c the distance to its centre, in both precisions
 *   EXACT   u and v are within 1 ulp, and the components of a triangle's normal too
 *   FAST    t, u, v and the normal are what single precision gives; docs/accuracy.md measures how far they are off
 * options: NULL for the defaults. Errors: INVALID_ARGUMENT, NOT_COMMITTED, TOO_LARGE, STOPPED. Allocates nothing. */
CGT_API cgt_result cgt_trace_camera(const cgt_scene *scene, const cgt_camera *camera, const cgt_frame *frame,
                                    const cgt_trace_options *options);

/* Rays in the caller's arrays: element i of each at byte i * stride. stride 4 (or 0) is structure of arrays; with
 * sizeof(struct) the pointers go into an array of structs. Directions have any length but zero. */
typedef struct cgt_rays {
    uint64_t count;
    size_t stride;        /* bytes, a multiple of 4; 0 (default): 4 */
    const float *org[3];  /* x, y, z */
    const float *dir[3];  /* x, y, z */
    const float *t_min;   /* NULL: 0 for all. A negative value is used as it is: hits behind the origin count. */
    const float *t_max;   /* NULL: +infinity for all. Below t_min: the ray hits nothing. */
    const uint32_t *mask; /* a geometry counts for a ray where its mask and the ray's have a bit in common: a ray with
                             0 hits nothing. NULL: all bits set, for all */
    const uint32_t *skip_primitive; /* a primitive that the ray does not find, such as the one that it leaves:
                                          CGT_INVALID_ID for none; NULL: none for all. Its equals are found. One that its
                                          geometry does not have is none */
    const uint32_t *skip_geometry;  /* the geometry of that primitive, CGT_INVALID_ID or another that does not exist for
                                          none; NULL: 0 for all. Not read where skip_primitive is NULL */
} cgt_rays;

/* Hits in the caller's arrays: element i of each at byte i * stride. NULL: not wanted. */
typedef struct cgt_hits {
    size_t stride; /* bytes, a multiple of 4; 0 (default): 4 */
    float *t;
    uint32_t *primitive;
    uint32_t *geometry;
    float *normal[3]; /* all three or none */
    float *u, *v;     /* both or none */
} cgt_hits;

/* Traces rays to their nearest hits, as cgt_trace_camera does. Neighbours in the arrays should be neighbours in
 * space: they are traced as packets where they are. Where AUTO has built a loose grid, the first calls since a commit
 * that bring 1/32 as many rays as there are primitives build a wide tree, by the context's threads, in memory that
 * the scene keeps; any number of threads may trace meanwhile. Then OUT_OF_MEMORY and TOO_LARGE may be returned: no ray
 * was traced, and the call may be tried again. Else nothing is allocated. */
CGT_API cgt_result cgt_trace_rays(const cgt_scene *scene, const cgt_rays *rays, const cgt_hits *hits,
                                  const cgt_trace_options *options);

/* Sets occluded[i] to 1 where ray i hits anything within its range, else to 0: what cgt_trace_rays would find, but
 * faster. occluded: rays->count bytes. */
CGT_API cgt_result cgt_occluded_rays(const cgt_scene *scene, const cgt_rays *rays, uint8_t *occluded,
                                     const cgt_trace_options *options);

/* A light without extent: at a place, or so far away that it lies in one direction from everywhere. */
typedef struct cgt_light {
    float position[3]; /* w = 1: where it is; w = 0: the direction from the scene to it, of any length but zero */
    float w;           /* 1 or 0 */
} cgt_light;

/* Points in the caller's arrays, those of a frame's hits for example: element i of each at byte i * stride. */
typedef struct cgt_points {
    uint64_t count;
    size_t stride;            /* bytes, a multiple of 4; 0 (default): 4 */
    const float *position[3]; /* x, y, z */
    const float *t_min;       /* NULL: 0 for all. A little more keeps a point on a surface from finding that surface,
                                 where skip_primitive does not */
    const float *t_max;       /* NULL: the way to the light, 1 or +infinity. Below t_min: the point is not occluded,
                                 and costs nothing */
    const uint32_t *mask;     /* of the ray to the light; this and the next as of cgt_rays */
    const uint32_t *skip_primitive; /* the one that the point lies on: a frame's planes will do, and no offset is
                                          needed */
    const uint32_t *skip_geometry;
} cgt_points;

/* Sets occluded[i] to 1 where anything lies between point i and the light, else to 0. The ray of a point is
 *   org = position,  dir = light.position - position (w = 1), one float subtraction along each axis, or
 *                    dir = light.position (w = 0)
 * and what counts is a hit with t_min <= t <= t_max: t is 0 at the point, and 1 at the light where that has a place. It
 * starts at the point, so that it begins exactly where the caller says, however far away the light is. The answer is
 * that of cgt_occluded_rays to these rays, but faster, and there is no array of directions to fill. A point with a NaN
 * or an infinity, in its range a NaN, or at the very place of the light, is counted as an invalid ray and not occluded.
 * Neighbours in the arrays should be neighbours in space: then a loose grid serves, tile by tile, in every precision
 * exactly; points that lie apart from each other go as other rays do. The points are cut into chunks of 4,096, each a
 * task: fastest is a call for up to so many that belong together, such as a picture's tile, by whichever of the caller's
 * threads has made them; it uses no other thread. occluded: points->count bytes. Errors and memory: as cgt_trace_rays. */
CGT_API cgt_result cgt_occluded_points(const cgt_scene *scene, const cgt_light *light, const cgt_points *points,
                                       uint8_t *occluded, const cgt_trace_options *options);

/* Ambient occlusion of a frame's pixels. */
typedef struct cgt_ambient_options {
    uint32_t samples; /* rays of a pixel, 1 to 1,024; default 16 */
    float radius;     /* what a ray meets beyond does not count: world units, above 0; default +infinity */
    uint32_t seed;    /* another one gives other directions; default 0 */
} cgt_ambient_options;

/* Fills in the defaults. */
CGT_API void cgt_ambient_options_init(cgt_ambient_options *ambient);

/* How much of the sky the pixels of a frame see: openness gets, for each, the share of its rays that meet nothing,
 * 1 where the frame has no hit.
 *   camera    the frame's; its rays' mask is that of these rays too, its t_min and t_max are not used
 *   frame     its planes t, primitive, geometry and normal as cgt_trace_camera filled them, of this scene; read only.
 *             The visitor is not called. Normals may be others of unit length, interpolated ones for example
 *   ambient   NULL for the defaults
 *   openness  a plane of row_stride * height floats, as those of the frame are; elements beside the picture stay
 *   options   NULL for the defaults; the statistics count these rays, a hit is an occluded one
 * The rays of a pixel start at org + t dir of its ray, in float, and ignore the primitive that it hits, so that no
 * offset is needed: in a mesh a ray may meet the next triangle where it starts nearer to their edge than that is
 * rounded, and a sphere seen from inside does not hide its other side. Their directions lie about the normal, turned
 * to the eye's side, by the cosine of the angle to it: each pixel has a low-discrepancy sequence (Sobol's first two
 * dimensions, scrambled by a hash of pixel and seed), on a disc (Shirley, Chiu, "A Low Distortion Map Between Disk and
 * Square", 1997). They are the same bits for any number of threads and every variant, and so is openness, but in
 * precision FAST. A pixel whose t or normal is not finite is open. Errors and memory: as cgt_trace_rays; INVALID_ARGUMENT
 * where a plane is missing, too. */
CGT_API cgt_result cgt_ambient_occlusion(const cgt_scene *scene, const cgt_camera *camera, const cgt_frame *frame,
                                         const cgt_ambient_options *ambient, float *visibility,
                                         const cgt_trace_options *options);

#ifdef __cplusplus
}
#endif

#endif

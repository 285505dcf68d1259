/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * libcgt: ray casting of scenes in which every primitive moves every frame.
 *
 *   context   threads, memory, log; makes scenes
 *   scene     geometries over the caller's own arrays
 *   commit    builds the acceleration structure from scratch, from the arrays as they are now
 *   trace     casts a camera's frame, or any array of rays, against the committed scene
 *
 * A frame is: move your data, cgt_scene_commit, cgt_trace_camera. In outline, for particles that are doubles
 * (examples/simulate.c is the whole program, with shadows, rays of its own and errors handled):
 *
 *   static cgt_spheres s;                          zeros: the defaults
 *   s.count = n, s.centers = cgt_doubles(x, 0), s.radius = 0.1f;
 *   cgt_context_create(NULL, &context);
 *   cgt_scene_create(context, NULL, &scene);
 *   cgt_scene_set_spheres(scene, NULL, &s);
 *   cgt_camera_init(&camera);                      at (0, 0, 5), looks at the origin
 *   cgt_frame_init(&frame, width, height);
 *   frame.t = t, frame.primitive = primitive;      planes of width * height elements
 *   while (simulate(x)) {
 *       cgt_scene_commit(scene);                   reads x as it is now
 *       cgt_trace_camera(scene, &camera, &frame, NULL);
 *   }
 *
 * Conventions of every call
 *   Result    cgt_result. A failed call changes nothing except the error message, and the arrays for its results.
 *   Messages  The object that a call is made on keeps a sentence about its last call that failed; what scenes fail in,
 *             their context keeps. The object's get_error_message copies it. An object whose creation failed is there,
 *             too: it has the message, refuses all other calls, and is released like any other. What is called on no
 *             object, such as a camera's functions, has its result alone.
 *   Defaults  0 is the right default of every field: {0} (in C++ {}) and a struct's init function mean the same.
 *   NULL      is allowed only where a text below says so.
 *   Threads   One thread at a time changes and commits a scene, while no thread traces it. Any number of threads may
 *             trace a committed scene at once. A call works on the context's threads, unless its text says otherwise.
 *             There is no global state.
 *   Callbacks No lock is held over the caller's code. Hooks and task runners may query messages and statistics at any
 *             time, and trace any scene that is not being committed.
 *   Processes Call fork only while no other thread is inside a call. After fork the child has no workers. Its calls run
 *             on the calling thread and give the same hits. It may release inherited contexts and scenes.
 *   Building  A call that takes a const scene builds a BVH in it only if its first line says so.
 *   Unloading The shared library is linked with -z nodelete if possible: dlclose must not unmap code that workers run.
 *             A plugin that links the static library releases its contexts before it is closed.
 *   Floats    IEEE single precision. Commits and traces work in the default floating-point environment and restore the
 *             caller's, so rounding mode and flushing of denormals do not matter.
 *   Stack     A call uses at most 64 KB of the caller's stack, a task at most 128 KB of its thread's; hooks and
 *             visitors come on top. cgt_trace_ray uses less than 16 KB once there is a BVH.
 *   Scratch   1.4 MB for each task that runs at once. The first calls that need it allocate it; the context keeps it.
 *
 * <cgt/all_hits.h> adds hits beyond the nearest one.
 * <cgt/bounces.h> adds rays that go on from mirrors and glass.
 * <cgt/research.h> adds the structures, traversals and counters of published algorithms. */
#ifndef CGT_CGT_H
#define CGT_CGT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cgt/array.h>
#include <cgt/export.h>
#include <cgt/version.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Results ------------------------------------------------------------------------------------------------ */

typedef enum cgt_result {
    CGT_OK = 0,
    CGT_ERROR_INVALID_ARGUMENT, /* a value is outside its documented range; the message names it */
    CGT_ERROR_OUT_OF_MEMORY,    /* the memory hook returned NULL; nothing is lost, the call may be repeated */
    CGT_ERROR_TOO_LARGE,        /* a size would overflow, or is beyond a documented limit */
    CGT_ERROR_NOT_COMMITTED,    /* the scene was never committed, or a geometry was changed since */
    CGT_ERROR_UNSUPPORTED,      /* this CPU or this build lacks what was requested */
    CGT_ERROR_THREADS,          /* the system refused a thread or a lock */
    CGT_ERROR_STOPPED,          /* a visitor stopped the frame, which is incomplete */
    CGT_ERROR_FILE,             /* a file cannot be opened, read or written, or is not what it should be */
    CGT_END                     /* no error: there is no further frame in a file (trajectory.h) */
} cgt_result;

/* Returns an English sentence for any result, known or not; it is valid forever. */
CGT_API const char *cgt_get_result_string(cgt_result result);

/* Returns the version of the linked library, "major.minor.patch"; compare it with CGT_VERSION_STRING. */
CGT_API const char *cgt_get_version(void);

/* ---- Hooks -------------------------------------------------------------------------------------------------- */

/* Memory. Both functions are called by the thread that calls the library, never by a worker. */
typedef struct cgt_memory_hooks {
    void *user; /* passed to both */
    /* Returns at least `bytes` bytes aligned to `alignment`, a power of two of at most 64; or NULL. */
    void *(*allocate)(void *user, size_t bytes, size_t alignment); /* default: the C library's */
    /* Gets what allocate returned, never NULL, and the same number of bytes. */
    void (*release)(void *user, void *memory, size_t bytes); /* default: the C library's */
} cgt_memory_hooks;

typedef enum cgt_log_level { CGT_LOG_LEVEL_ERROR = 0, CGT_LOG_LEVEL_WARNING, CGT_LOG_LEVEL_INFO } cgt_log_level;

/* Log. write gets one line without a line feed, from any thread that calls the library. */
typedef struct cgt_log_hook {
    void *user;                                                          /* passed to write */
    void (*write)(void *user, cgt_log_level level, const char *message); /* default NULL: silent */
} cgt_log_hook;

/* One task of a batch; index is its number. Tasks are independent of each other. */
typedef void cgt_task(void *argument, uint32_t index);

/* Tasks. run calls task(argument, index) once for each index below count, and returns when all have returned.
 * Order:   any, on any threads; one after another on the calling thread is valid. Results are the same
 * Threads: with a runner set, the library starts none of its own
 * Number:  a call starts at most 8 tasks with scratch memory; they take work from a shared list. If all 8 ran at once,
 *          the next call starts 16, and so on */
typedef struct cgt_task_runner {
    void *user;                                                              /* passed to run */
    void (*run)(void *user, cgt_task *task, void *argument, uint32_t count); /* default NULL: own thread pool */
} cgt_task_runner;

/* ---- Context ------------------------------------------------------------------------------------------------ */

typedef struct cgt_context cgt_context;

typedef struct cgt_context_options {
    /* That work, the caller's included: 1 starts none, at most 1024; 0 (default): one per CPU that the process may
     * use. Ignored if tasks.run is set. */
    uint32_t threads;
    const char *variant;     /* a name of cgt_get_variant_names; NULL (default): the widest that this CPU runs */
    cgt_memory_hooks memory; /* both functions or neither */
    cgt_log_hook log;
    cgt_task_runner tasks;
} cgt_context_options;

/* Fills in the defaults. */
CGT_API void cgt_context_options_init(cgt_context_options *options);

/* Creates a context.
 *   options   NULL: the defaults; needed during the call only
 *   context   gets the handle; on an error, one that has the message, or NULL if there is no memory even for that
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, UNSUPPORTED (variant), THREADS.
 * Environment: CGT_DISABLE_CPU=avx512,avx2 makes the library do without these variants, as if the CPU did not run them.
 *         An unknown name is INVALID_ARGUMENT. */
CGT_API cgt_result cgt_context_create(const cgt_context_options *options, cgt_context **context);

/* Releases a context; NULL is ignored. It lives on until its last scene is released. */
CGT_API void cgt_context_release(cgt_context *context);

/* Copies the message of the last call that failed on this context or on a scene of it, its creation included.
 *   context   NULL: what cgt_context_create gave, if there was no memory; the message says so
 *   text      gets the message, cut to size and ended by a zero; NULL with size 0 asks for the length only
 *   size      bytes of text
 * Returns the length of the whole message; 0 if no call has failed.
 * Threads: any may call it. If several calls fail at once, one message is kept. */
CGT_API size_t cgt_context_get_error_message(const cgt_context *context, char *text, size_t size);

/* Returns the name of the context's variant, valid as long as the library is loaded; "" if its creation failed. */
CGT_API const char *cgt_context_get_variant(const cgt_context *context);

/* Returns the number of threads that work for the context; 0 with a task runner of the caller's. */
CGT_API uint32_t cgt_context_get_threads(const cgt_context *context);

/* Calls task(argument, index) once for each index below count, on the context's threads or by its runner, and returns
 * when all have returned: a program needs no threads of its own for what it does beside tracing.
 *   task   has the default floating-point environment; it may trace, and run tasks itself
 * Order:   any. What is to be the same every time must not depend on it
 * Threads: any may call it at once, and while others trace
 * Stack:   of the context's own threads a task may use 1 MB, of the caller's what is left there
 * Errors: INVALID_ARGUMENT, if context or task is NULL */
CGT_API cgt_result cgt_context_run_tasks(cgt_context *context, cgt_task *task, void *argument, uint32_t count);

/* Returns the names of all variants in this build, narrowest first, ended by NULL. A CPU need not run them all. */
CGT_API const char *const *cgt_get_variant_names(void);

/* ---- Scene -------------------------------------------------------------------------------------------------- */

typedef struct cgt_scene cgt_scene;

#define CGT_INVALID_ID UINT32_MAX /* no primitive, no geometry */

/* Geometries are arrays of the caller's (cgt_array).
 *   In place  floats and 32-bit indices at addresses and strides that are multiples of 4, without an origin. They stay
 *             readable and unchanged from cgt_scene_commit to the last trace before the next commit.
 *   Copied    all else: other formats, an origin, packed structs, radii by type. Needed during the commit only: the
 *             scene keeps 16 bytes a sphere, 32 a capsule, 12 a triangle's vertex, and 12 a triangle whose indices are
 *             copied (cgt_scene_statistics.copied_bytes).
 *   Values    A coordinate is (float)(given - origin), subtracted in double; a radius is (float)given; both are rounded
 *             to nearest. Hits are exact for these floats.
 *   Origin    Hits, cameras, rays and lights are relative to it. With an origin near the scene, places that are 1e9
 *             away keep their digits.
 *   Mask      A ray sees a geometry if this and the ray's mask share a bit; 0 (default): all bits set. */

/* Spheres. One with a NaN, an infinity (as a float) or a negative radius is skipped and counted. A sphere of radius 0
 * is a point: rays hit it that pass exactly through it. */
typedef struct cgt_spheres {
    uint32_t count;    /* spheres; 0 is valid */
    cgt_array centers; /* x, y, z of each */
    /* Of each sphere; with types, of each type. If there are none, all have `radius`: 0 or more, 0 (default): points,
     * which almost no ray hits. */
    cgt_array radii;
    float radius;
    /* Sphere i has the radius of type types[i]; one of type_count or more fails the commit. If types count from 1, an
     * unused radius 0 comes first. No types (default): sphere i has radius i. */
    cgt_array types;
    uint32_t type_count; /* radii of types */
    uint32_t mask;
    double origin[3]; /* subtracted from the centres; finite */
} cgt_spheres;

/* Triangles.
 * Hits:    on both sides; edges and vertices belong to a triangle; a ray in its plane misses it
 * Skipped: and counted: one with a NaN or an infinity (as a float) in a vertex, and one without area
 * Fails:   an index of vertex_count or more fails the commit
 * Speed:   large scenes of triangles alone are built and traced faster if consecutive triangles are neighbours in
 *          space, as in most meshes: they are grouped by eight */
typedef struct cgt_triangles {
    uint32_t count;        /* triangles; 0 is valid */
    cgt_array indices;     /* the three vertices of each triangle; none (default): 3i, 3i + 1, 3i + 2 */
    cgt_array vertices;    /* x, y, z of each */
    uint32_t vertex_count; /* vertices */
    uint32_t mask;
    double origin[3]; /* subtracted from the vertices; finite */
} cgt_triangles;

/* Capsules: all points within a radius of a segment. Bonds, trails, fibres, the shafts of arrows, the edges of a box.
 * Hits:    on the side and on the half spheres at the ends, as of spheres; u is 0 at the first end, 1 at the second.
 *          Equal ends make a sphere
 * Skipped: and counted: one with a NaN, an infinity (as a float) or a negative radius. A capsule of radius 0 is a
 *          segment, which almost no ray hits
 * Fails:   an index of vertex_count or more, or a type of type_count or more, fails the commit
 * Held by: AUTO, LOOSE_GRID and BVH; research's structures are UNSUPPORTED */
typedef struct cgt_capsules {
    uint32_t count;        /* capsules, at most 2^31 - 1; 0 is valid */
    cgt_array indices;     /* the two vertices of each capsule; none (default): 2i, 2i + 1, or vertex i and end i */
    cgt_array vertices;    /* x, y, z of each */
    uint32_t vertex_count; /* vertices */
    cgt_array ends;        /* in place of indices, as many as vertices, which the commit copies then. None (default) */
    cgt_array radii;       /* these four as of cgt_spheres */
    float radius;
    cgt_array types;
    uint32_t type_count;
    uint32_t mask;
    double origin[3]; /* subtracted from vertices and ends; finite */
} cgt_capsules;

/* Acceleration structures. Hits are the same bits through each.
 *   AUTO        LOOSE_GRID for coherent rays, BVH for incoherent ones, as cgt_scene_options.rays says; beside a grid
 *               also a BVH, if need be (see below). If only incoherent rays followed the last two commits, the next
 *               commit builds a BVH instead of the grid. A camera's frame is slower through it, and makes the next
 *               commit build the grid again. cgt_scene_statistics.reason says so.
 *   LOOSE_GRID  hierarchical loose grid: a uniform grid for each class of sizes, each primitive in the one cell of its
 *               centre. 4 to 6 bytes a primitive, built in linear time. A camera's frame goes by tiles of 64x64 pixels.
 *   BVH         bounding volume hierarchy over copies of the primitives, with as many children a node as the variant
 *               has lanes: for rays that start anywhere and go anywhere. */
typedef enum cgt_structure {
    CGT_STRUCTURE_AUTO = 0,
    CGT_STRUCTURE_LOOSE_GRID,
    CGT_STRUCTURE_BVH,
    CGT_STRUCTURE_MAX = 0xff /* research.h has more values up to here */
} cgt_structure;

/* When a BVH is built
 *   At the commit  with BVH, and with AUTO for incoherent rays, in place of a grid. LOOSE_GRID never has one.
 *   Beside a grid  of AUTO, at most once a commit: in cgt_scene_prepare; or in a call whose first line says that it may
 *                  build one, once such calls since the commit have brought 1/32 as many rays as there are primitives,
 *                  at the first of them if the grid has levels for crowded regions. cgt_trace_camera is such a call if
 *                  the frame cannot go by tiles (masks, an extreme camera)
 *   Memory         BVH and builder take 70 to 100 bytes a sphere and 110 to 140 a triangle or a capsule (evenly spread
 *                  ones; see cgt_scene_statistics.bytes), until the scene is released
 *   Threads        the context's build it; others may trace the scene meanwhile
 *   Errors         OUT_OF_MEMORY, TOO_LARGE: the call may be repeated; its results are undefined */

/* The rays that a scene is mostly traced with. */
typedef enum cgt_ray_kind {
    CGT_RAY_KIND_COHERENT = 0, /* cgt_trace_camera, or arrays in which neighbours run side by side */
    CGT_RAY_KIND_INCOHERENT    /* arrays of rays that start anywhere and go anywhere: occlusion, bounces, queries */
} cgt_ray_kind;

typedef struct cgt_scene_options {
    const struct cgt_research_scene_options *research; /* see research.h; NULL (default): none */
    cgt_structure structure;
    cgt_ray_kind rays; /* for AUTO */
} cgt_scene_options;

/* Fills in the defaults. */
CGT_API void cgt_scene_options_init(cgt_scene_options *options);

/* Creates an empty scene.
 *   options   NULL: the defaults; needed during the call only
 *   scene     gets the handle, NULL on an error
 * Errors: INVALID_ARGUMENT, TOO_LARGE, OUT_OF_MEMORY, THREADS. */
CGT_API cgt_result cgt_scene_create(cgt_context *context, const cgt_scene_options *options, cgt_scene **scene);

/* Releases a scene; NULL is ignored. No thread may be using it. */
CGT_API void cgt_scene_release(cgt_scene *scene);

/* Sets the options of the next commit; until then the scene counts as not committed.
 *   options   not NULL; needed during the call only
 * Errors: INVALID_ARGUMENT, TOO_LARGE (a resolution of research.h). */
CGT_API cgt_result cgt_scene_set_options(cgt_scene *scene, const cgt_scene_options *options);

/* Add spheres, triangles or capsules as a geometry, or replace a geometry: another count, other arrays. If only the
 * numbers in the arrays change, cgt_scene_commit is all that is needed. Until the next commit the scene counts as not
 * committed.
 *   geometry   CGT_INVALID_ID: adds one, and gets its id, the lowest that is free. Else the one that is replaced, of
 *              the same kind. NULL: adds one whose id is not wanted
 *   spheres, triangles, capsules: needed during the call only; the arrays that they name are read by each commit
 * Errors: INVALID_ARGUMENT (a value, no such geometry, or one of another kind), TOO_LARGE (the counts of all geometries
 *         reach 2^32 - 1), OUT_OF_MEMORY. */
CGT_API cgt_result cgt_scene_set_spheres(cgt_scene *scene, uint32_t *geometry, const cgt_spheres *spheres);
CGT_API cgt_result cgt_scene_set_triangles(cgt_scene *scene, uint32_t *geometry, const cgt_triangles *triangles);
CGT_API cgt_result cgt_scene_set_capsules(cgt_scene *scene, uint32_t *geometry, const cgt_capsules *capsules);

/* Removes a geometry. Its id is free again, the others stay. Until the next commit the scene counts as not committed.
 * Errors: INVALID_ARGUMENT if there is no such geometry. */
CGT_API cgt_result cgt_scene_remove_geometry(cgt_scene *scene, uint32_t geometry);

/* Returns a number that the ids of all geometries are below; 0: there are none. */
CGT_API uint32_t cgt_scene_get_geometries(const cgt_scene *scene);

/* Get a geometry as it was set, strides of 0 in numbers; false: there is none of this id and kind.
 * Threads: any, while none changes the scene */
CGT_API bool cgt_scene_get_spheres(const cgt_scene *scene, uint32_t geometry, cgt_spheres *spheres);
CGT_API bool cgt_scene_get_triangles(const cgt_scene *scene, uint32_t geometry, cgt_triangles *triangles);
CGT_API bool cgt_scene_get_capsules(const cgt_scene *scene, uint32_t geometry, cgt_capsules *capsules);

/* Builds the acceleration structure from the arrays as they are now. An empty scene is valid: no ray hits it.
 * Memory:  kept from one commit to the next; it grows by half, so a scene whose count does not grow stops allocating
 * Bands:   coordinates may have any size that a float holds. If a scene's largest one is beyond 2^40 or below 2^-36,
 *          the primitives are cut into bands of similar magnitude and copied, times a power of two, for a structure of
 *          each band: one primitive far out costs the others nothing. That takes 22 bytes a sphere, 42 a triangle, 38 a
 *          capsule more.
 *          Calls that trace such a scene allocate scratch while they run, and may return OUT_OF_MEMORY; FAST saves
 *          nothing there
 * Threads: the context's
 * Errors:  INVALID_ARGUMENT (an index or a type is out of range), OUT_OF_MEMORY, TOO_LARGE (such as a BVH of more than
 *          2^26 - 1 leaves), UNSUPPORTED (capsules in a structure of research.h). The scene then counts as not
 *          committed */
CGT_API cgt_result cgt_scene_commit(cgt_scene *scene);

/* Builds the BVH of a committed scene now, not in the first call that needs it.
 *   rays   INCOHERENT: builds the BVH that AUTO has beside a grid, however few rays will come; COHERENT: does nothing
 * Nothing: happens if the BVH is there, or the scene's structure is not AUTO
 * Threads: if another one is building it already, the call returns at once
 * Errors:  INVALID_ARGUMENT, NOT_COMMITTED, OUT_OF_MEMORY, TOO_LARGE: the scene can be traced as before */
CGT_API cgt_result cgt_scene_prepare(cgt_scene *scene, cgt_ray_kind rays);

/* What the last commit found, chose and spent; all 0 before the first. */
typedef struct cgt_scene_statistics {
    cgt_structure structure;               /* that was built; of bands of magnitudes, in the most populous one */
    char reason[128];                      /* why, in words */
    uint32_t geometries;                   /* in the scene */
    uint32_t primitives;                   /* given, skipped ones included */
    uint32_t spheres, triangles, capsules; /* of those */
    uint32_t skipped_not_finite;           /* primitives with a NaN or an infinity */
    uint32_t skipped_radius;               /* spheres and capsules with a negative radius */
    uint32_t skipped_degenerate;           /* triangles without area */
    float bounds_min[3];                   /* of all that was not skipped, rounded outwards; 0 where there is nothing */
    float bounds_max[3];
    /* That traversal reads: cells and references, or nodes and leaves; without the caller's arrays. */
    size_t structure_bytes;
    size_t bvh_bytes;    /* of the BVH that was built, or that AUTO built beside a grid; 0: none */
    size_t copied_bytes; /* of arrays that the commit has copied; 0: all are read in place */
    size_t bytes;        /* memory that the scene holds now */
    double bounds_ms;    /* reading, checking and bounding the primitives */
    double build_ms;     /* filling the structure */
    double bvh_build_ms; /* building the BVH, at the commit or, with AUTO, in the call that needed it */
    double commit_ms;    /* the whole call */
} cgt_scene_statistics;

/* Copies the statistics of the last commit that has ended, and of a BVH built since.
 * Threads: any may call it, in callbacks too
 * Errors:  INVALID_ARGUMENT (a NULL) */
CGT_API cgt_result cgt_scene_get_statistics(const cgt_scene *scene, cgt_scene_statistics *statistics);

/* ---- Tracing ------------------------------------------------------------------------------------------------ */

/* What a hit can carry; fields that nobody asks for cost nothing. */
typedef enum cgt_field {
    CGT_FIELD_T = 1,         /* float: distance in units of the ray's direction; +infinity for none */
    CGT_FIELD_PRIMITIVE = 2, /* uint32: index in its geometry; CGT_INVALID_ID for none */
    CGT_FIELD_GEOMETRY = 4,  /* uint32: id of the geometry; CGT_INVALID_ID for none */
    /* 3 floats: unit normal, outward on a sphere or a capsule, on a triangle along (v1 - v0) x (v2 - v0); 0, 0, 0
     * for none. */
    CGT_FIELD_NORMAL = 8,
    /* 2 floats, u and v: the hit is (1 - u - v) v0 + u v1 + v v2; on a capsule (1 - u) p + u q is the point of its
     * axis, from p to q, that is nearest to the hit, and v is 0; 0, 0 on a sphere and for none. */
    CGT_FIELD_UV = 16,
    CGT_FIELD_POSITION = 32 /* 3 floats: org + t dir of the ray, in float as written; +infinity for none. Of a frame */
} cgt_field;

/* How exact the values of a hit are.
 *   Hits   are the same in both: those that exact arithmetic finds on the same float input. None is missed at an edge,
 *          a vertex or a silhouette, none is invented; the nearest wins, of equal ones the lowest geometry, then the
 *          lowest primitive id.
 *   Bits   are the same for any variant, structure and number of threads, in both.
 *   EXACT  Every value is within 1 ulp: t within 0.51, a triangle's normal in each component, a sphere's and a
 *          capsule's as a vector (2^-23 + 2^-48 c / r; where that is above 1, it may have any length).
 *   FAST   Single precision. With |d| the length of the ray's direction, c the distance to a sphere's centre, r its
 *          radius, h half the chord, R the distance to a triangle's farthest vertex, errors are at most
 *            |d| t   sphere    2^-19 c r / h; at a silhouette 2^-9 sqrt(c r)
 *                    triangle  2^-11 R; 2^-16 R for one of good shape, seen at 45 degrees or steeper
 *            normal  sphere    2^-18 c / h; at a silhouette 2^-9 sqrt(c / r), which is 2^-3 at most
 *                    triangle  2^-13
 *            u, v              2^-7
 *          t lies in the ray's range, u and v in 0 to 1. Most values are a few ulp off (docs/reports/accuracy.md).
 *          Where single precision would lose more, and on capsules, values are those of EXACT. */
typedef enum cgt_precision { CGT_PRECISION_EXACT = 0, CGT_PRECISION_FAST } cgt_precision;

/* What a call did. */
typedef struct cgt_trace_statistics {
    uint64_t rays; /* of the call */
    /* With a NaN or an infinity in origin or direction, a zero direction, or a NaN in the range; they hit nothing. */
    uint64_t invalid_rays;
    uint64_t hits;         /* rays with a hit; of any-hit calls, occluded ones */
    uint64_t bvh_rays;     /* that went through a BVH */
    uint64_t tiles;        /* of a frame, or of points against a light, that went through a loose grid as a whole */
    uint64_t packets;      /* of rays, traversed otherwise; those of a packet share main axis and sign */
    uint64_t packet_tests; /* primitives tested against the rays of a packet, or drawn in a tile */
    uint64_t ray_tests;    /* tests of a ray against a primitive, by whole blocks of 16; in tiles by whole vectors */
    uint64_t double_tests; /* of those, the ones that single precision could not decide */
    uint64_t exact_tests;  /* of those, the ones that double precision could not decide either */
    uint64_t exact_values; /* hits whose t, u or v took exact arithmetic, since double cancels */
    double trace_ms;       /* the whole call */
} cgt_trace_statistics;

typedef struct cgt_trace_options {
    cgt_trace_statistics *statistics;                  /* gets the statistics of the call; NULL (default): none */
    const struct cgt_research_trace_options *research; /* see research.h; NULL (default): none */
    cgt_precision precision;
} cgt_trace_options;

/* Fills in the defaults. */
CGT_API void cgt_trace_options_init(cgt_trace_options *options);

typedef enum cgt_projection { CGT_PROJECTION_PERSPECTIVE = 0, CGT_PROJECTION_ORTHOGRAPHIC } cgt_projection;

/* A camera. With fwd, right, up its orthonormal axes, h = tan(fov / 2) and a = width / height, the ray of pixel
 * (x, y), row 0 at the top, is
 *   perspective   org = eye,  dir = fwd + (2(x + 0.5)/width - 1) h a right + (1 - 2(y + 0.5)/height) h up
 *   orthographic  org = eye + the same sum of right and up with h = height / 2,  dir = fwd
 * dir is not normalised; t is in units of dir. If eye, target and up are all 0, the view is the default one: from
 * (0, 0, 5) to the origin. */
typedef struct cgt_camera {
    float eye[3];
    float target[3]; /* must differ from eye */
    float up[3];     /* must not be parallel to target - eye; 0, 0, 0 (default): (0, 1, 0) */
    cgt_projection projection;
    float fov;    /* perspective: vertical angle in degrees, below 180; 0 (default): 45 */
    float height; /* orthographic: height of the picture in world units; 0 (default): 2 */
    float t_min;  /* hits before it are ignored; 0 (default) or more */
    float t_max;  /* hits beyond it are ignored; not below t_min; 0 (default): +infinity */
    /* Of its rays, as of cgt_rays; 0 (default): all bits set. If it hides something, the frame is traced packet by
     * packet, slower through a loose grid. */
    uint32_t mask;
} cgt_camera;

/* Fills in the defaults: perspective, from (0, 0, 5) to the origin, up (0, 1, 0). */
CGT_API void cgt_camera_init(cgt_camera *camera);

/* Computes the ray of a pixel: the bits that cgt_trace_camera traces.
 *   width, height   of the frame, each 1 to 65,536 pixels
 *   x, y            the pixel: column from the left, row from the top
 *   org, dir        get the ray; a hit is at org + t dir
 * Threads: any may call it
 * Errors:  INVALID_ARGUMENT (the camera, or a pixel outside the frame), TOO_LARGE */
CGT_API cgt_result cgt_camera_get_ray(const cgt_camera *camera, uint32_t width, uint32_t height, uint32_t x, uint32_t y,
                                      float org[3], float dir[3]);

/* Computes the rays of a rectangle of pixels, such as a tile's, row by row. They are those of cgt_camera_get_ray, for
 * less than a tenth of the time a ray.
 *   x, y            its first pixel
 *   columns, rows   its size, within the frame; 0 is valid
 *   stride          bytes from one ray to the next, a multiple of 4; 0: 4
 *   org, dir        columns * rows elements of each of x, y, z; cgt_rays may read them
 * Threads: any may call it
 * Errors:  INVALID_ARGUMENT (the camera, or pixels outside the frame), TOO_LARGE */
CGT_API cgt_result cgt_camera_get_rays(const cgt_camera *camera, uint32_t width, uint32_t height, uint32_t x,
                                       uint32_t y, uint32_t columns, uint32_t rows, size_t stride, float *const org[3],
                                       float *const dir[3]);

/* A finished tile, valid during the visitor's call. Pixel (i, j), i < width, j < height, is element j * row_stride + i.
 * Fields that the visitor did not ask for are NULL. */
typedef struct cgt_tile {
    uint32_t x, y;          /* first pixel in the frame */
    uint32_t width, height; /* pixels */
    size_t row_stride;      /* elements */
    const float *t;
    const uint32_t *primitive;
    const uint32_t *geometry;
    const float *normal[3];
    const float *u, *v;
    const float *position[3];
} cgt_tile;

typedef enum cgt_visit { CGT_VISIT_CONTINUE = 0, CGT_VISIT_STOP } cgt_visit;

/* Gets each finished tile once. CGT_VISIT_STOP ends the frame: cgt_trace_camera then returns CGT_ERROR_STOPPED.
 * Order:   any
 * Threads: those that trace, several at once, in the floating-point environment of the call */
typedef cgt_visit cgt_tile_visitor(void *user, const cgt_tile *tile);

/* Where a camera's frame goes: to planes, to a visitor while the tile is in cache, or to both; at least one of them.
 * Speed: addresses and strides matter by a few per cent. Without a visitor, tiles are stored past the caches, unless
 *        normals have a vector_stride */
typedef struct cgt_frame {
    uint32_t width, height; /* pixels, each 1 to 65,536 */
    size_t row_stride;      /* elements from one row of the planes to the next; 0 (default): width */
    /* Of normal and position: elements from one pixel to the next; 0 (default): 1. With 3 the planes may be the x,
     * y, z of one array of triples: pixel (x, y) is element (y * row_stride + x) * vector_stride of each. */
    size_t vector_stride;
    float *t; /* planes of row_stride * height elements, aligned as their type; NULL: not wanted */
    uint32_t *primitive;
    uint32_t *geometry;
    float *normal[3];          /* all three or none */
    float *u, *v;              /* both or none */
    float *position[3];        /* all three or none */
    cgt_tile_visitor *visitor; /* NULL: none */
    void *visitor_user;        /* passed to the visitor */
    uint32_t visitor_fields;   /* cgt_field values that the visitor gets, combined */
    uint32_t first_row;        /* with row_count: the rows that calls work on, such as one machine's share; */
    uint32_t row_count;        /* elements of others stay, and are not read. 0 (default): all from first_row on */
} cgt_frame;

/* Sets the size, and all else to 0: ask for what you want. */
CGT_API void cgt_frame_init(cgt_frame *frame, uint32_t width, uint32_t height);

/* Traces one ray per pixel to its nearest hit; may build a BVH in the scene first, if the frame cannot go by tiles.
 *   camera    its rays
 *   frame     gets the hits, as cgt_precision describes them
 *   options   NULL: the defaults
 * Range:   a hit counts if t_min <= t <= t_max, with t as EXACT returns it: a ray whose t_max is the t that was found
 *          hits again. A t beyond the range of float is no hit
 * Inside:  an origin inside a sphere or a capsule hits its far side; on its surface, t = 0
 * Memory:  none, unless a BVH is built or the scene is in bands (cgt_scene_commit)
 * Errors:  INVALID_ARGUMENT, NOT_COMMITTED, TOO_LARGE, STOPPED; with a BVH or bands those of cgt_trace_rays */
CGT_API cgt_result cgt_trace_camera(const cgt_scene *scene, const cgt_camera *camera, const cgt_frame *frame,
                                    const cgt_trace_options *options);

/* Rays in the caller's arrays: element i of each at byte i * stride, of origins and directions at byte
 * i * vector_stride. A stride of 4 (or 0) is structure of arrays; with sizeof(struct) the pointers go into an array of
 * structs; a vector_stride of 12 is for triples x, y, z beside dense numbers. Directions have any length but zero. */
typedef struct cgt_rays {
    uint64_t count;       /* rays; 0 is valid */
    size_t stride;        /* bytes, a multiple of 4; 0 (default): 4 */
    size_t vector_stride; /* of org and dir: bytes, a multiple of 4; 0 (default): stride */
    const float *org[3];  /* x, y, z */
    const float *dir[3];  /* x, y, z */
    const float *t_min;   /* NULL: 0 for all. A negative value is valid: hits behind the origin count */
    const float *t_max;   /* NULL: +infinity for all. Below t_min: the ray is off and hits nothing */
    const uint32_t *mask; /* a ray sees a geometry if their masks share a bit; 0: all bits set. NULL: 0 for all */
    /* A primitive that the ray does not find, such as the one that it leaves; CGT_INVALID_ID, or one that its
     * geometry does not have: none. Others of equal shape are found. NULL: none for all. */
    const uint32_t *skip_primitive;
    /* The geometry of that primitive; CGT_INVALID_ID, or one that does not exist: none. NULL: 0 for all. Not read if
     * skip_primitive is NULL. */
    const uint32_t *skip_geometry;
} cgt_rays;

/* Hits in the caller's arrays: element i of each at byte i * stride, of normals at byte i * vector_stride. NULL: not
 * wanted. cgt_field says what they hold, with and without a hit. */
typedef struct cgt_hits {
    size_t stride;        /* bytes, a multiple of 4; 0 (default): 4 */
    size_t vector_stride; /* of normal: bytes, a multiple of 4; 0 (default): stride */
    float *t;
    uint32_t *primitive;
    uint32_t *geometry;
    float *normal[3]; /* all three or none */
    float *u, *v;     /* both or none */
} cgt_hits;

/* Traces rays to their nearest hits; may build a BVH in the scene first.
 *   rays      neighbours in the arrays should be neighbours in space: they are traced together
 *   hits      gets the hits, with the values of cgt_trace_camera
 *   options   NULL: the defaults
 * Memory: to build a BVH, and for scenes in bands; else none
 * Errors: INVALID_ARGUMENT, NOT_COMMITTED, TOO_LARGE (count times stride, or a BVH), OUT_OF_MEMORY: the call may be
 *         repeated, and what it has written is undefined */
CGT_API cgt_result cgt_trace_rays(const cgt_scene *scene, const cgt_rays *rays, const cgt_hits *hits,
                                  const cgt_trace_options *options);

/* Finds which rays hit anything in their range, faster than cgt_trace_rays; may build a BVH in the scene first.
 *   rays       as of cgt_trace_rays
 *   occluded   rays->count bytes: 1 if cgt_trace_rays would find a hit, else 0
 *   options    NULL: the defaults
 * Errors: as cgt_trace_rays */
CGT_API cgt_result cgt_occluded_rays(const cgt_scene *scene, const cgt_rays *rays, uint8_t *occluded,
                                     const cgt_trace_options *options);

/* Which surface of a sphere or a capsule is hit. The nearest hit has NEAR, but from inside. Triangles, points, and what
 * a ray only touches have the near one; triangles that a ray crosses (<cgt/all_hits.h>) have both. */
typedef enum cgt_surface {
    CGT_SURFACE_NEAR = 0, /* where the line enters the sphere, or crosses a triangle against its normal */
    CGT_SURFACE_FAR       /* where it leaves it, or crosses a triangle along its normal */
} cgt_surface;

/* A hit: see cgt_field. */
typedef struct cgt_hit {
    float t;
    uint32_t primitive, geometry;
    uint32_t surface; /* cgt_surface */
    float normal[3];
    float u, v;
} cgt_hit;

/* One ray, for callers that must see one hit before they know the next ray. */
typedef struct cgt_single_ray {
    float org[3], dir[3]; /* dir: of any length but zero */
    float t_min, t_max;   /* t_max: 0 (default): +infinity. Below t_min: the ray is off and hits nothing */
    uint32_t mask;        /* as of cgt_rays; 0 (default): all bits set */
    /* The ray does not find this hit's primitive, such as the one that it leaves; its other members are not read. NULL
     * (default), or a hit of nothing: it finds all. */
    const cgt_hit *skip;
} cgt_single_ray;

/* Traces one ray to its nearest hit; may build a BVH in the scene first.
 *   ray       any
 *   hit       gets the hit, with the values of cgt_trace_rays
 *   options   NULL: the defaults
 * Speed:   best in scenes of CGT_RAY_KIND_INCOHERENT, whose BVH is there from the commit on; arrays of rays are faster
 * Stack:   less than 16 KB with a BVH, up to 64 KB through another structure; a call that builds a BVH takes as much
 *          as a commit
 * Threads: the calling one traces
 * Errors:  as cgt_trace_rays */
CGT_API cgt_result cgt_trace_ray(const cgt_scene *scene, const cgt_single_ray *ray, cgt_hit *hit,
                                 const cgt_trace_options *options);

/* Finds whether one ray hits anything in its range, faster than cgt_trace_ray; may build a BVH in the scene first.
 *   occluded   gets whether it does
 * Stack and all else: as cgt_trace_ray */
CGT_API cgt_result cgt_occluded_ray(const cgt_scene *scene, const cgt_single_ray *ray, bool *occluded,
                                    const cgt_trace_options *options);

typedef enum cgt_light_kind {
    CGT_LIGHT_POINT = 0,  /* at a place */
    CGT_LIGHT_DIRECTIONAL /* so far away that it lies in one direction from everywhere */
} cgt_light_kind;

/* A light without extent. */
typedef struct cgt_light {
    cgt_light_kind kind;
    float position[3]; /* POINT: where it is; DIRECTIONAL: the direction from the scene to it, of any length but zero */
} cgt_light;

/* Points in the caller's arrays, such as those of a frame's hits: element i of each at byte i * stride, of positions at
 * byte i * vector_stride. */
typedef struct cgt_points {
    uint64_t count;           /* points; 0 is valid */
    size_t stride;            /* bytes, a multiple of 4; 0 (default): 4 */
    size_t vector_stride;     /* of position: bytes, a multiple of 4; 0 (default): stride */
    const float *position[3]; /* x, y, z */
    /* NULL: 0 for all. A little more keeps a point from finding the surface that it lies on, if skip_primitive does
     * not. */
    const float *t_min;
    /* NULL: up to the light, 1 or +infinity. Below t_min: the point is off, not occluded, and costs nothing. */
    const float *t_max;
    const uint32_t *mask;           /* of the ray to the light, as of cgt_rays; so are the next two */
    const uint32_t *skip_primitive; /* the one that the point lies on: with a frame's planes no offset is needed */
    const uint32_t *skip_geometry;
} cgt_points;

/* Finds which points a light does not reach; may build a BVH in the scene first.
 *   light      one light
 *   points     neighbours in the arrays should be neighbours in space: a loose grid then serves them by tiles
 *   occluded   points->count bytes: 1 if anything lies between point and light, else 0
 *   options    NULL: the defaults
 * Ray:     org = position; dir = light.position - position (POINT), one float subtraction along each axis, or
 *          dir = light.position (DIRECTIONAL). t is 0 at the point, and 1 at a light that has a place. A hit with
 *          t_min <= t <= t_max counts, as in cgt_occluded_rays, however far away the light is
 * Invalid: a NaN or an infinity in the point, a NaN in its range, or the very place of the light: not occluded, counted
 * Speed:   faster than cgt_occluded_rays, without an array of directions. Points that are off or invalid cost next to
 *          nothing. For the shadows of a frame, cgt_occluded_frame is less work, though it takes a little time to make
 *          the points
 * Threads: one for up to 4,096 points; larger calls are cut into tasks of 4,096 neighbouring points
 * Errors:  as cgt_trace_rays */
CGT_API cgt_result cgt_occluded_points(const cgt_scene *scene, const cgt_light *light, const cgt_points *points,
                                       uint8_t *occluded, const cgt_trace_options *options);

/* Gets each rectangle of a frame's pixels once, when its results are in the caller's planes, so that they can be used
 * while they are in cache; they may only be read. CGT_VISIT_STOP ends the call, which then returns CGT_ERROR_STOPPED.
 *   x, y            its first pixel
 *   width, height   pixels, 1 or more
 * Order:   any
 * Threads: those that trace, several at once, in the floating-point environment of the call */
typedef cgt_visit cgt_pixels_visitor(void *user, uint32_t x, uint32_t y, uint32_t width, uint32_t height);

/* Shadows of a frame. */
typedef struct cgt_shadow_options {
    float t_min;                 /* of the rays to the lights, as of cgt_points; 0 (default) or more */
    cgt_pixels_visitor *visitor; /* gets pixels after the last light; NULL (default): none */
    void *visitor_user;          /* passed to the visitor */
} cgt_shadow_options;

/* Fills in the defaults. */
CGT_API void cgt_shadow_options_init(cgt_shadow_options *shadows);

/* Finds which pixels of a frame lights do not reach; may build a BVH in the scene first.
 *   camera     the frame's; its mask is that of these rays, too, its t_min and t_max are not used
 *   frame      its plane t as cgt_trace_camera filled it, of this scene; read only. If it has both primitive and
 *              geometry, rays skip the primitive that their pixel hits: no offset is needed, and a sphere casts no
 *              shadow on itself. The other planes are not read, and the visitor is not called
 *   lights     `count` lights; 0 is valid
 *   shadows    NULL: the defaults
 *   occluded   `count` planes of row_stride * height bytes, one after another: 1 if anything lies between the pixel's
 *              hit and the light, else 0; elements outside the picture stay
 *   options    NULL: the defaults; the statistics count the rays of pixels with a hit
 * Rays:    those of cgt_occluded_points for the points org + t dir of the pixels, in float (CGT_FIELD_POSITION)
 * Threads: one task per tile
 * Errors:  as cgt_trace_rays; STOPPED; INVALID_ARGUMENT if the plane t is missing */
CGT_API cgt_result cgt_occluded_frame(const cgt_scene *scene, const cgt_camera *camera, const cgt_frame *frame,
                                      const cgt_light *lights, uint32_t count, const cgt_shadow_options *shadows,
                                      uint8_t *occluded, const cgt_trace_options *options);

/* Ambient occlusion of a frame's pixels. */
typedef struct cgt_ambient_options {
    uint32_t samples; /* rays of a pixel, at most 1,024; 0 (default): 16 */
    float radius;     /* hits beyond it do not count: world units; 0 (default): +infinity */
    uint32_t seed;    /* another one gives other directions */
    /* The first of these rays in a pixel's endless sequence; 0 (default). Calls that go on where others ended find
     * together what one call finds: visibility times samples, rounded, is the number of open rays; their sum over
     * all samples has the bits of that call. */
    uint32_t first;
    cgt_pixels_visitor *visitor; /* gets pixels with their visibility; NULL (default): none */
    void *visitor_user;          /* passed to the visitor */
} cgt_ambient_options;

/* Fills in the defaults. */
CGT_API void cgt_ambient_options_init(cgt_ambient_options *ambient);

/* Finds how much of the sky each pixel of a frame sees; may build a BVH in the scene first.
 *   camera       the frame's; its mask is that of these rays, too, its t_min and t_max are not used
 *   frame        its planes t, primitive, geometry and normal as cgt_trace_camera filled them, of this scene; read
 *                only. Other normals of unit length will do, such as interpolated ones. The visitor is not called
 *   ambient      NULL: the defaults
 *   visibility   a plane of row_stride * height floats, as those of the frame: the share of the pixel's rays that hit
 *                nothing; 1 without a hit, or if t or normal is not finite; elements outside the picture stay
 *   options      NULL: the defaults; the statistics count these rays, an occluded one as a hit
 * Origins:    org + t dir of the pixel's ray, in float. Rays skip the primitive that the pixel hits: no offset is
 *             needed. In a mesh a ray may hit the next triangle if it starts nearer to their common edge than the
 *             rounding of its origin; a sphere seen from inside does not hide its other side
 * Directions: distributed by the cosine of the angle to the normal, which is turned to the eye's side: each pixel has a
 *             low-discrepancy sequence (Sobol's first two dimensions, scrambled by place and seed), on a disc (Shirley,
 *             Chiu, "A Low Distortion Map Between Disk and Square", 1997). Those of the pixels of any square of 4x4
 *             complete each other, so that a mean over such squares converges faster than its number of rays tells
 * Bits:       the same for any number of threads and any variant
 * Errors:     as cgt_trace_rays; STOPPED; INVALID_ARGUMENT if a plane is missing, or first + samples beyond 2^32 - 1 */
CGT_API cgt_result cgt_ambient_occlusion(const cgt_scene *scene, const cgt_camera *camera, const cgt_frame *frame,
                                         const cgt_ambient_options *ambient, float *visibility,
                                         const cgt_trace_options *options);

#ifdef __cplusplus
}
#endif

#endif

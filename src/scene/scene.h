/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The scene: the caller's geometries, and the structure of the last commit. */
#ifndef CGT_SCENE_H
#define CGT_SCENE_H

#include <cgt/research.h>

#include "core/context.h"
#include "model/committed_scene.h"
#include <stdatomic.h>

#define CGT_MAX_BREAK_LEVEL 50u /* of kd_break_level: no kd-tree is deeper */

typedef struct cgt_geometry {
    bool used;
    cgt_kind kind;
    union { /* strides filled in */
        cgt_spheres spheres;
        cgt_triangles triangles;
        cgt_capsules capsules;
    };
} cgt_geometry;

static inline uint32_t cgt_geometry_count(const cgt_geometry *g)
{
    switch (g->kind) {
    case CGT_KIND_SPHERES: return g->spheres.count;
    case CGT_KIND_CAPSULES: return g->capsules.count;
    case CGT_KIND_TRIANGLES: break;
    }
    return g->triangles.count;
}

/* Memory that a scene keeps from commit to commit. */
typedef enum cgt_scene_buffer {
    CGT_BUFFER_GEOMETRY = 0, /* cgt_geometry, by id */
    CGT_BUFFER_ARRAYS,       /* cgt_primitive_array of the commit */
    CGT_BUFFER_COPIES,       /* floats and indices that cannot be read in the caller's arrays: copy_arrays.h */
    CGT_BUFFER_BOUNDS,       /* cgt_primitive_bounds, one per chunk of primitives */
    CGT_BUFFER_PAPERS,       /* cgt_paper_structures, and what they consist of, up to BIH_WORK */
    CGT_BUFFER_VOXELS,       /* cgt_voxel or cgt_voxel32 */
    CGT_BUFFER_OVERFLOW,     /* cgt_overflow, in the order of their pushes */
    CGT_BUFFER_OVERFLOW_SORTING,
    CGT_BUFFER_KD_NODES,
    CGT_BUFFER_KD_REFERENCES,
    CGT_BUFFER_KD_LEAVES,
    CGT_BUFFER_LEAF_TRIANGLES,
    CGT_BUFFER_KD_WORK, /* what the builder needs while it runs */
    CGT_BUFFER_BIH_NODES,
    CGT_BUFFER_BIH_REFERENCES,
    CGT_BUFFER_BIH_WORK,     /* its items, and what the builder needs while it runs */
    CGT_BUFFER_SIZE_CLASSES, /* cgt_size_classes, one per chunk of primitives */
    CGT_BUFFER_LOOSE_START,
    CGT_BUFFER_LOOSE_PRIM,
    CGT_BUFFER_CELL_SORT_WORK, /* centres of triangles; keys of all primitives, or the primitives sorted by them */
    CGT_BUFFER_CELL_SORT_BINS, /* ends of bins in chunks of primitives */
    CGT_BUFFER_REGIONS,        /* sizes of a loose grid's levels by chunk, where regions are crowded */
    CGT_BUFFER_CLUSTERS,
    CGT_BUFFER_BVH_START,
    CGT_BUFFER_BVH_PRIM,   /* all primitives by cell and leaf */
    CGT_BUFFER_BVH_LEAVES, /* where leaves begin among them, see cgt_bvh_build */
    CGT_BUFFER_BVH_WORK,   /* keys and primitives of cells that are sorted further, then records of the binary tree */
    CGT_BUFFER_BVH_RANGES, /* cgt_bvh_range, then a branch for each */
    CGT_BUFFER_BVH_NODES,
    CGT_BUFFER_BVH_SPHERES,
    CGT_BUFFER_BVH_TRIANGLES,
    CGT_BUFFER_BVH_CAPSULES,
    CGT_BUFFER_BVH_TURNED, /* slabs of nodes, where there are bundles of capsules */
    CGT_SCENE_BUFFERS
} cgt_scene_buffer;

/* The BVH that tracing builds beside a loose grid. A thread that turns NONE into BUILDING builds it. That is no lock:
 * the caller's hooks and task runner run meanwhile, and may call the library for the same scene. */
typedef enum cgt_bvh_state { CGT_BVH_STATE_NONE = 0, CGT_BVH_STATE_BUILDING, CGT_BVH_STATE_BUILT } cgt_bvh_state;

/* Statistics as the caller gets them. */
typedef struct cgt_scene_reports {
    cgt_scene_statistics statistics;
    cgt_research_scene_statistics research;
} cgt_scene_reports;

/* What came since the commit, by which the next commit chooses a grid, a tree or both: counted work, no clock. Threads
 * set it while they trace. */
typedef struct cgt_frame_record {
    atomic_bool camera;            /* a camera's frames, which a grid serves */
    atomic_bool rays;              /* rays that were worth a BVH */
    atomic_bool points;            /* points against lights, by tiles or not */
    atomic_bool light_tiles;       /* which tiles served */
    atomic_bool light_gave_up;     /* which gave up tiles for the BVH */
    _Atomic uint64_t light_excess; /* work of tiles beyond a BVH's: trace/light_choice.h */
} cgt_frame_record;

struct cgt_bands;

struct cgt_scene {
    cgt_context *context;
    cgt_scene_options options; /* research: those below */
    cgt_research_scene_options research_options;
    cgt_buffer buffer[CGT_SCENE_BUFFERS];
    uint32_t geometries; /* in CGT_BUFFER_GEOMETRY, free ones included */
    uint32_t free_id;    /* no lower one is free */
    uint64_t primitives; /* of all geometries */
    bool is_committed;   /* nothing changed since the last commit */
    bool has_failed;     /* the last commit */
    cgt_committed_scene committed_scene;
    cgt_scene_statistics statistics;                   /* of the build, which fills them in bit by bit */
    cgt_research_scene_statistics research_statistics; /* likewise */
    cgt_scene_reports reports;                         /* of the last build that has ended */
    struct cgt_scene *mutable_scene; /* the scene itself: tracing has a const one and may build a BVH in it */
    pthread_mutex_t reports_lock;    /* held while reports are copied, and never over the caller's code: hooks, tasks */
    atomic_uint bvh_state;           /* cgt_bvh_state */
    _Atomic uint64_t bvh_rays;       /* since the commit, that would have gone through it */
    struct cgt_bands *bands;         /* scene/bands.h; NULL until a commit needs them, and kept from then on */
    bool in_bands;                   /* the last commit has made bands, and no structure of its own */
    bool is_band;                    /* this is a band of another scene, or must not be cut into bands */
    struct cgt_scene *band_of;       /* the scene that this is a band of; NULL: none */
    cgt_frame_record record;
    uint32_t frames_for_tree; /* commits in succession after which nothing came that a grid serves */
    bool expects_tree;        /* lights gave up tiles before the last commit */
};

/* Returns a geometry; NULL, with a message, if there is none of that id. */
cgt_geometry *cgt_find_geometry(const cgt_scene *scene, uint32_t id);

/* The scene of which this is a band, or the scene itself. */
static inline cgt_scene *cgt_whole_scene(cgt_scene *scene) { return scene->band_of ? scene->band_of : scene; }

static inline bool cgt_flag_is_set(const atomic_bool *flag) { return atomic_load_explicit(flag, memory_order_relaxed); }

/* Sets a flag that many threads set: they share it as long as it is not written. */
static inline void cgt_set_flag(atomic_bool *flag)
{
    if (!cgt_flag_is_set(flag))
        atomic_store_explicit(flag, true, memory_order_relaxed);
}

/* Makes the statistics of a build that has ended those that the caller gets. */
void cgt_publish_statistics(cgt_scene *scene);

/* The same after a BVH was built on demand, which the scene that this is a band of reports, too. */
void cgt_publish_built_bvh(cgt_scene *scene);

/* The result of a call that got NULL where it needs something; the scene's context keeps a message that names the call.
 * scene: may be that NULL. */
cgt_result cgt_fail_null(const cgt_scene *scene, const char *call);

/* Memory that a scene holds, bands included. */
size_t cgt_scene_bytes(const cgt_scene *scene);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A model of the library's state for fuzz_scene: one context, one scene, the geometries that the scene must hold by the
 * contract of cgt.h, and their arrays, each in a block that ends with its last element. */
#ifndef FUZZ_MODEL_H
#define FUZZ_MODEL_H

#include "fuzz/fuzz.h"
#include "fuzz/scene/fuzz_memory.h"
#include "model/primitive.h"

#define FUZZ_GEOMETRIES 6u

typedef struct fuzz_geometry {
    bool used;
    cgt_kind kind;
    cgt_spheres spheres;
    cgt_triangles triangles;
    cgt_capsules capsules;
    void *block[4]; /* of its arrays */
} fuzz_geometry;

typedef struct fuzz_model {
    fuzz_bytes bytes;
    fuzz_memory memory;
    cgt_context *context;
    cgt_scene *scene;
    fuzz_geometry geometry[FUZZ_GEOMETRIES];
    bool committed, holds_no_capsules; /* the structure that the options ask for */
    uint32_t log_lines;
} fuzz_model;

/* ---- fuzz_geometry.c ---- */

/* Adds, replaces or removes a geometry, chosen by the bytes. */
void fuzz_add(fuzz_model *m);
void fuzz_update(fuzz_model *m);
void fuzz_remove(fuzz_model *m);

/* Changes a number in an array, and commits, since the scene may not be traced before that. */
void fuzz_move(fuzz_model *m);
void fuzz_release_geometry(fuzz_geometry *g);

uint32_t fuzz_count(const fuzz_geometry *g);

/* A primitive with valid indices, as the library takes it; whether it is one that can be hit. */
cgt_primitive fuzz_primitive_at(const fuzz_geometry *g, uint32_t i);
bool fuzz_is_valid(const cgt_primitive *p);

uint32_t fuzz_mask_of(const fuzz_geometry *g);
bool fuzz_has(const fuzz_model *m, cgt_kind kind);

/* Whether all indices are below the number of vertices, and all types below that of radii. */
bool fuzz_indices_are_good(const fuzz_geometry *g);

/* ---- fuzz_scene.c ---- */

/* Checks a failed call: it has a message, and out of memory implies a refused allocation. */
void fuzz_check_error(fuzz_model *m, cgt_result result);

/* Commits; true where the scene may be traced. */
bool fuzz_commit(fuzz_model *m);

/* ---- fuzz_rays.c, fuzz_camera.c, fuzz_calls.c ---- */

void fuzz_trace_rays(fuzz_model *m);
void fuzz_trace_camera(fuzz_model *m);

/* One of all other calls. */
void fuzz_call(fuzz_model *m);

/* A call that traces may build a BVH, and bands of magnitudes take scratch: memory may run out. The call then succeeds
 * on the second attempt. Gives its result. */
#define FUZZ_TRACE(m, result, call)                                                                                    \
    do {                                                                                                               \
        (result) = (call);                                                                                             \
        if ((result) == CGT_ERROR_OUT_OF_MEMORY) {                                                                     \
            fuzz_check_error(m, result);                                                                               \
            (result) = (call);                                                                                         \
        }                                                                                                              \
    } while (0)

#endif

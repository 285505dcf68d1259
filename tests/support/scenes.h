/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Contexts, scenes, cameras and frames for tests. A failure here fails the calling test. */
#ifndef SCENES_H
#define SCENES_H

#include "support/test.h"
#include "support/ray_arrays.h"
#include "support/ways.h"

/* ---- contexts ---- */

/* The next variant of the build that this CPU runs, from *index on; NULL after the last. */
const char *variant_next(size_t *index);
#define FOR_EACH_VARIANT(name)                                                                                         \
    for (size_t name##_index_ = 0, name##_once_ = 1; name##_once_; name##_once_ = 0)                                   \
        for (const char *name = variant_next(&name##_index_); name; name = variant_next(&name##_index_))

/* Whether a variant is the first or the last that this CPU runs: the narrowest or the widest. The others are compiled
 * from the same text, so tests of many cases may run fewer of them there. */
bool variant_is_outer(const char *name);

/* Whether this program always makes clusters of triangles: clusters/always_clusters.c is linked. The same tests also
 * run without it, so anything without clusters can be left out: scenes with spheres, the queue grid, kd-trees. */
bool clusters_always(void);

cgt_context *context_make(uint32_t threads, const char *variant);

/* A context of two threads with a memory hook that counts allocations. */
cgt_context *context_counting(unsigned *allocations);

/* The message of the last error, valid until the next call. */
const char *context_message(const cgt_context *context);

/* ---- clouds of spheres: x, y, z, r ---- */

typedef enum cloud_kind {
    CLOUD_UNIFORM,   /* in a box, like radii */
    CLOUD_CLUSTERED, /* in a few dense clumps */
    CLOUD_PLANAR,    /* all centres in one plane */
    CLOUD_MIXED,     /* radii from 1e-3 to 1e3 of the usual size */
    CLOUD_FAR,       /* 1e3 to 1e5 away from the origin */
    CLOUD_LATTICE,   /* integer coordinates, many spheres touch or are equal */
    CLOUD_LINE,      /* along one axis */
    CLOUD_KINDS
} cloud_kind;

typedef struct cloud {
    uint32_t count;
    float (*sphere)[4];
    float middle[3]; /* approximate centre of the cloud */
    float reach;     /* approximate distance that it extends from there */
} cloud;

cloud cloud_make(test_random *r, cloud_kind kind, uint32_t count);
void cloud_free(cloud *c);
const char *cloud_name(cloud_kind kind);

/* ---- scenes ---- */

cgt_spheres spheres_of(const float (*sphere)[4], uint32_t count);

/* A scene of one geometry, committed. options may be NULL. */
cgt_scene *scene_of(cgt_context *context, const cgt_scene_options *options, const float (*sphere)[4], uint32_t count);

/* ---- frames ---- */

/* A camera outside a cloud that sees all of it, along an axis. */
cgt_camera camera_before(const cloud *c);

/* A camera around or inside a cloud, with any projection and opening. */
cgt_camera camera_random(test_random *r, const cloud *c);

/* All planes of a frame, in one block of memory without gaps. */
typedef struct planes {
    uint32_t width, height;
    size_t elements;
    uint32_t *memory; /* 6 * elements */
    float *t, *normal[3];
    uint32_t *primitive, *geometry;
} planes;

planes planes_make(uint32_t width, uint32_t height);
void planes_free(planes *p);
bool planes_equal(const planes *a, const planes *b);
cgt_frame frame_of(const planes *p);

/* Traces all fields of a frame. The planes are filled with a pattern first, so that an unwritten pixel shows. */
void frame_trace(const cgt_scene *scene, const cgt_camera *camera, const planes *p, const cgt_trace_options *options);

/* The rays of the frame as the library generates them: width * height of them. Release with free. */
truth_ray *frame_rays(const cgt_camera *camera, uint32_t width, uint32_t height);

/* Judges every pixel of a frame of one geometry by the exact oracle; fails the test where one is wrong. */
void frame_judge(const planes *p, const truth_ray *rays, const float (*sphere)[4], uint32_t count);

/* ---- rays ---- */

/* A ray from anywhere towards a point of a cloud, or through the cloud at random; a few have ranges. */
truth_ray ray_random(test_random *r, const cloud *c);

typedef struct ray_hit {
    float t;
    uint32_t primitive, geometry;
    float normal[3];
} ray_hit;

cgt_hits hits_of(ray_hit *hits);
void rays_trace(const cgt_scene *scene, const truth_ray *rays, uint64_t count, ray_hit *hits,
                const cgt_trace_options *options);
ray_hit ray_trace(const cgt_scene *scene, truth_ray ray);

#endif

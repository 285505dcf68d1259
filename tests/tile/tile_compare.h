/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Compares a frame by tiles with the same frame by packets, bit for bit, for the variant that this is compiled for. A
 * difference fails the test. */
#ifndef TILE_COMPARE_H
#define TILE_COMPARE_H

#include "support/scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernel/packet/packet.h"

#include "scene/scene.h"
#include "query/tile_limits.h"

static inline cgt_camera_rays rays_of(const cgt_camera *camera, uint32_t width, uint32_t height)
{
    cgt_camera_rays rays;
    char message[160];
    assert_int_equal(cgt_camera_prepare(camera, width, height, &rays, message), CGT_OK);
    return rays;
}

/* Makes a camera orthographic with a picture of the given height, often along an axis. */
static inline void make_orthographic(test_random *r, float height, cgt_camera *camera)
{
    camera->projection = CGT_PROJECTION_ORTHOGRAPHIC;
    camera->height = height;
    if (random_below(r, 2))
        return;
    const uint32_t axis = random_below(r, 3);
    float distance = 0;
    for (int a = 0; a < 3; a++)
        distance += fabsf(camera->target[a] - camera->eye[a]);
    for (uint32_t a = 0; a < 3; a++) {
        const float ahead = random_below(r, 2) ? distance : -distance;
        camera->target[a] = camera->eye[a] + (a == axis ? ahead : 0);
        camera->up[a] = a == (axis + 1) % 3 ? (random_below(r, 2) ? 1.f : -1.f) : 0;
    }
}

static inline cgt_region region_of(const planes *p, float *uv)
{
    void *const plane[CGT_PLANES] = {p->t,         p->primitive, p->geometry, p->normal[0],
                                     p->normal[1], p->normal[2], uv,          uv + p->elements};
    cgt_region r = {.width = p->width, .height = p->height, .row_stride = p->width};
    for (int k = 0; k < CGT_PLANES; k++)
        r.plane[k] = plane[k];
    return r;
}

/* Commits the scenes: BVHs are of a variant. */
static cgt_context *context;

static inline int make_context(void **state)
{
    (void)state;
    context = context_make(1, CGT_VARIANT_NAME);
    return context ? 0 : -1;
}

static inline int release_context(void **state)
{
    (void)state;
    cgt_context_release(context);
    return 0;
}

/* A scene in both structures: a queue grid, or a BVH, and a loose grid. */
typedef struct dual_scene {
    cgt_scene *scene, *loose;
} dual_scene;

static inline cgt_result add_geometry(cgt_scene *scene, const cgt_geometry *g)
{
    switch (g->kind) {
    case CGT_KIND_SPHERES: return cgt_scene_set_spheres(scene, NULL, &g->spheres);
    case CGT_KIND_TRIANGLES: return cgt_scene_set_triangles(scene, NULL, &g->triangles);
    case CGT_KIND_CAPSULES: break;
    }
    return cgt_scene_set_capsules(scene, NULL, &g->capsules);
}

/* per_cell: of the primitives, on average, in a loose grid of one level; 0: the levels that a commit chooses. */
static inline dual_scene dual_scene_of(cgt_scene *other, double per_cell)
{
    dual_scene b = {.scene = other};
    const cgt_geometry *g = other->buffer[CGT_BUFFER_GEOMETRY].data;
    test_scene_options options = {.structure = CGT_STRUCTURE_LOOSE_GRID};
    for (int a = 0; per_cell > 0 && a < 3; a++)
        options.resolution[a] = 1 + (uint32_t)cbrt(other->committed_scene.valid / per_cell);
    assert_int_equal(cgt_scene_create(context, SCENE_OPTIONS(&options), &b.loose), CGT_OK);
    for (uint32_t i = 0; i < other->geometries; i++)
        assert_int_equal(add_geometry(b.loose, &g[i]), CGT_OK);
    b.loose->is_band = other->is_band; /* in one piece where the other is */
    assert_int_equal(cgt_scene_commit(b.loose), CGT_OK);
    return b;
}

static inline void dual_scene_free(dual_scene *b)
{
    cgt_scene_release(b->loose);
    cgt_scene_release(b->scene);
}

typedef struct frames_tally {
    uint32_t frames, served, parallel; /* parallel: of the served ones */
    cgt_counts counts;                 /* of the served ones */
} frames_tally;

static inline void fail_at(const planes *got, const planes *expected, const cgt_camera_rays *c, const char *what)
{
    size_t i = 0;
    while (i < 6 * got->elements && got->memory[i] == expected->memory[i])
        i++;
    if (i == 6 * got->elements)
        fail_msg("%s: u or v", what);
    i %= got->elements;
    fail_msg("%s: %u x %u, pixel %zu: %u at %a, not %u at %a; eye %a %a %a", what, got->width, got->height, i,
             got->primitive[i], (double)got->t[i], expected->primitive[i], (double)expected->t[i], (double)c->eye[0],
             (double)c->eye[1], (double)c->eye[2]);
}

/* FAST tiles against EXACT ones: the same primitives; where a pixel hits a sphere, t and the normal are within the
 * error of fast_spheres.h plus a margin. (tests/primitive/test_fast_values.c measures the bounds.) */
static inline void compare_fast(const cgt_committed_scene *committed_scene, const cgt_camera_rays *c, const planes *got,
                                const planes *expected, const char *what)
{
    assert_memory_equal(got->primitive, expected->primitive, got->elements * sizeof *got->primitive);
    assert_memory_equal(got->geometry, expected->geometry, got->elements * sizeof *got->geometry);
    for (size_t i = 0; i < got->elements; i++) {
        const bool hit = expected->primitive[i] != CGT_INVALID_ID;
        const cgt_primitive_array *a = committed_scene->prims.array;
        while (hit && a->geometry != expected->geometry[i])
            a++;
        double square = 0, dd = 0, off = 0;
        if (!hit || a->kind != CGT_KIND_SPHERES) {
            assert_true(hit || got->t[i] == INFINITY);
            continue;
        }
        const cgt_sphere q = cgt_array_sphere(a, expected->primitive[i]);
        const double centre[3] = {q.x, q.y, q.z};
        for (int k = 0; k < 3; k++) {
            const double reach = fabs((double)c->fwd[k]) + fabs((double)c->right[k]) + fabs((double)c->up[k]);
            const double n = (double)got->normal[k][i] - (double)expected->normal[k][i];
            square += (centre[k] - (double)c->eye[k]) * (centre[k] - (double)c->eye[k]);
            dd += reach * reach;
            off += n * n;
        }
        const double far = sqrt(square) + (double)q.r;
        const double least = far * 0x1p-18 + sqrt(far * (double)q.r * 0x1p-18);
        const double t = fabs((double)got->t[i] - (double)expected->t[i]);
        if (!(t <= least || t * sqrt(dd) <= least) || !(sqrt(off) * (double)q.r <= least))
            fail_msg("%s: pixel %zu: FAST has t %a, not %a, and a normal %a off", what, i, (double)got->t[i],
                     (double)expected->t[i], sqrt(off));
    }
}

/* Traces one frame by tiles and by packets. */
static inline void compare_frame(const dual_scene *b, const cgt_camera *camera, uint32_t width, uint32_t height,
                                 const char *what, frames_tally *tally)
{
    const cgt_scene *scene = b->scene;
    const cgt_camera_rays rays = rays_of(camera, width, height);
    cgt_trace_settings settings = {.packet = 8,
                                   .cull = CGT_CULL_BLOCKS,
                                   .precision = CGT_PRECISION_EXACT,
                                   .fields = CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY | CGT_FIELD_NORMAL |
                                             CGT_FIELD_UV};
    planes expected = planes_make(width, height), got = planes_make(width, height);
    const cgt_committed_scene committed_scene = b->loose->committed_scene;
    cgt_scratch *scratch = cgt_scratch_init(aligned_alloc(CGT_ALIGNMENT, CGT_SCRATCH_BYTES));
    cgt_counts counts = {.scratch = scratch}, other = {.scratch = scratch};
    memset(expected.memory, 0x77, 6 * expected.elements * sizeof(uint32_t));
    memset(got.memory, 0x55, 6 * got.elements * sizeof(uint32_t));
    float *uv = malloc(4 * expected.elements * sizeof(float));
    assert_non_null(uv);
    memset(uv, 0x66, 4 * expected.elements * sizeof(float));
    cgt_region to_wanted = region_of(&expected, uv), to_got = region_of(&got, uv + 2 * expected.elements);
    if (tally->frames % 3 == 2) { /* separate loops serve frames without u and v */
        to_wanted.plane[CGT_PLANE_U] = to_wanted.plane[CGT_PLANE_V] = NULL;
        to_got.plane[CGT_PLANE_U] = to_got.plane[CGT_PLANE_V] = NULL;
        settings.fields &= ~CGT_FIELD_UV;
    }
    CGT_KERNEL(cgt_trace_region)(&scene->committed_scene, &rays, &settings, &to_wanted, &other);
    const bool served = cgt_tile_supports(&committed_scene, &rays); /* as the library decides */
    (served ? CGT_KERNEL(cgt_trace_tile) : CGT_KERNEL(cgt_trace_region))(&committed_scene, &rays, &settings, &to_got,
                                                                         &counts);
    if (!planes_equal(&expected, &got) ||
        memcmp(uv, uv + 2 * expected.elements, 2 * expected.elements * sizeof(float)) != 0)
        fail_at(&got, &expected, &rays, what);
    assert_int_equal(counts.rays, other.rays);
    assert_int_equal(counts.hits, other.hits);
    tally->frames++;
    if (served) {
        cgt_trace_settings fast = settings;
        cgt_counts fast_counts = {.scratch = scratch};
        fast.precision = CGT_PRECISION_FAST;
        /* nothing that EXACT has written may pass for FAST's */
        memset(got.memory, 0x55, 6 * got.elements * sizeof(uint32_t));
        memset(uv, 0x66, 4 * expected.elements * sizeof(float));
        CGT_KERNEL(cgt_trace_tile)(&committed_scene, &rays, &fast, &to_got, &fast_counts);
        compare_fast(&committed_scene, &rays, &got, &expected, what);
        assert_int_equal(fast_counts.hits, counts.hits);
        /* packets find the same bits */
        memset(expected.memory, 0x77, 6 * expected.elements * sizeof(uint32_t));
        CGT_KERNEL(cgt_trace_region)(&scene->committed_scene, &rays, &fast, &to_wanted, &other);
        if (!planes_equal(&expected, &got) ||
            memcmp(uv, uv + 2 * expected.elements, 2 * expected.elements * sizeof(float)) != 0)
            fail_at(&got, &expected, &rays, what);
    }
    if (served) {
        const uint64_t *from = (const uint64_t *)&counts;
        uint64_t *to = (uint64_t *)&tally->counts;
        tally->served++;
        tally->parallel += camera->projection == CGT_PROJECTION_ORTHOGRAPHIC;
        for (size_t i = 0; i < CGT_COUNTS; i++)
            to[i] += from[i];
    }
    free(scratch);
    free(uv);
    planes_free(&expected);
    planes_free(&got);
}

static inline void print_tally(const char *what, const frames_tally *t)
{
    print_message("%s: %u frames, %u by tiles, %u orthographic: %llu rays, %llu hits, %llu ray tests, %llu in double, "
                  "%llu exact\n",
                  what, t->frames, t->served, t->parallel, (unsigned long long)t->counts.rays,
                  (unsigned long long)t->counts.hits, (unsigned long long)t->counts.ray_tests,
                  (unsigned long long)t->counts.double_tests, (unsigned long long)t->counts.exact_tests);
}

#endif

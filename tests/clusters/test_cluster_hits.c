/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays through clusters (triangle_cluster.h) find the hits of a kd-tree over single triangles, bit for bit, at rest and
 * in motion, with each variant. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "clusters/cluster_meshes.h"
#include "support/suite.h"
#include "hard_cases/hard_run.h"

#define BEYOND CGT_CLUSTER

/* ---- hits ---- */

#define WIDTH 72u
#define HEIGHT 66u
#define PIXELS (WIDTH * HEIGHT)
#define RAYS 2400u
#define FEWER_RAYS 320u /* on slow machines; frames stay, since tiles need neighbouring points that are close */
#define FEW 128u        /* rays, of which even twice as many do not build a BVH */
#define BUNDLE 16u
#define LIGHTS 3u

typedef struct view {
    cgt_camera camera;
    bool masked; /* of VISIBLE_MASK: not all geometries */
} view;

static const cgt_light lights[LIGHTS] = {
    {CGT_LIGHT_POINT, {0.05f, -0.1f, 0.2f}}, /* inside the roll */
    {CGT_LIGHT_POINT, {3, 2, 1}},
    {CGT_LIGHT_DIRECTIONAL, {-0.4f, 0.7f, 0.5f}},
};

#define VIEWS 6u
/* On slow machines only every third view and light is used: a masked view goes with one of all geometries. */
#define SAMPLE_STEP 3u

/* From outside, parallel, and from inside the bounds; masked from outside and parallel; all along the roll. */
static view view_at(uint32_t number)
{
    static const float eye[VIEWS][3] = {{2.4f, 1.1f, 1.3f}, {-1.5f, -2.2f, 0.7f}, {0.1f, -0.15f, 0.3f},
                                        {2.4f, 1.1f, 1.3f}, {-1.5f, -2.2f, 0.7f}, {0.2f, 0.1f, 3}};
    static const float target[VIEWS][3] = {{0, 0, 0}, {0, 0.1f, 0.1f}, {0.6f, 0.5f, -0.4f},
                                           {0, 0, 0}, {0, 0.1f, 0.1f}, {0, 0, 0}};
    view v = {.masked = number == 3 || number == 4};
    cgt_camera_init(&v.camera);
    memcpy(v.camera.eye, eye[number], sizeof v.camera.eye);
    memcpy(v.camera.target, target[number], sizeof v.camera.target);
    v.camera.fov = number == 2 ? 80 : 50;
    v.camera.height = 2.3f;
    v.camera.projection = number == 1 || number == 4 ? CGT_PROJECTION_ORTHOGRAPHIC : CGT_PROJECTION_PERSPECTIVE;
    v.camera.mask = v.masked ? VISIBLE_MASK : 0;
    return v;
}

/* The queries: bundles of rays from one origin each to points of triangles, and points visible in the first view. */
typedef struct queries {
    uint32_t rays, sample;
    truth_ray ray[RAYS];
    float point[3][PIXELS];
    uint32_t skip_prim[2][PIXELS]; /* the triangle that the point is on, and its geometry */
} queries;

typedef struct answers {
    planes frame[VIEWS];
    full_hit hit[RAYS];
    uint8_t occluded[RAYS], shadow[LIGHTS][PIXELS];
} answers;

static bool is_selected(const queries *q, uint32_t number)
{
    return !test_samples() || number % SAMPLE_STEP == q->sample;
}

static answers *answers_make(void)
{
    answers *a = calloc(1, sizeof *a);
    assert_non_null(a);
    for (uint32_t i = 0; i < VIEWS; i++)
        a->frame[i] = planes_make(WIDTH, HEIGHT);
    return a;
}

static void answers_free(answers *a)
{
    for (uint32_t i = 0; i < VIEWS; i++)
        planes_free(&a->frame[i]);
    free(a);
}

static void make_rays(queries *q, const mesh *m, test_random *r)
{
    float from[3] = {0, 0, 0};
    for (uint32_t i = 0; i < q->rays; i++) {
        truth_ray *ray = &q->ray[i];
        const float(*v)[3] = (const float(*)[3])m->triangle[random_below(r, m->count)];
        const float s = random_float(r, 0, 0.5f), t = random_float(r, 0, 0.5f);
        *ray = (truth_ray){.t_min = 0, .t_max = random_below(r, 4) ? INFINITY : random_float(r, 0.5f, 1.5f)};
        for (int a = 0; a < 3; a++) {
            if (i % BUNDLE == 0)
                from[a] = random_float(r, -2, 2);
            const float to = v[0][a] + s * (v[1][a] - v[0][a]) + t * (v[2][a] - v[0][a]);
            ray->org[a] = from[a];
            ray->dir[a] = isfinite(to) ? to - from[a] : 1; /* for a NaN: any direction */
        }
    }
}

/* A pixel of the first view without a hit gets a point in the air. */
static void make_points(queries *q, const cgt_scene *scene)
{
    const view v = view_at(0);
    planes p = planes_make(WIDTH, HEIGHT);
    truth_ray *ray = frame_rays(&v.camera, WIDTH, HEIGHT);
    frame_trace(scene, &v.camera, &p, NULL);
    for (uint32_t i = 0; i < PIXELS; i++) {
        const bool hit = p.primitive[i] != CGT_INVALID_ID;
        for (int a = 0; a < 3; a++)
            q->point[a][i] = ray[i].org[a] + (hit ? p.t[i] : 4) * ray[i].dir[a];
        q->skip_prim[0][i] = p.primitive[i];
        q->skip_prim[1][i] = p.geometry[i];
    }
    free(ray);
    planes_free(&p);
}

/* Frames: by tiles if the scene has a grid; by packets for masked views, with each culling in turn. */
static void trace_frames(const cgt_scene *scene, const queries *q, uint32_t turn, answers *a)
{
    const bool grid = scene->committed_scene.loose.levels > 0,
               several = scene->committed_scene.prims.arrays > HIDDEN_PART;
    for (uint32_t i = 0; i < VIEWS; i++) {
        if (!is_selected(q, i))
            continue;
        const view v = view_at(i);
        cgt_trace_statistics st;
        cgt_research_trace_statistics research;
        test_trace_options o = {0};
        o.statistics = &st;
        o.research_statistics = &research;
        if (v.masked)
            o.cull = (cgt_cull)((turn + i) % 3);
        frame_trace(scene, &v.camera, &a->frame[i], TRACE_OPTIONS(&o));
        assert_true(st.hits > PIXELS / 8 && st.hits < PIXELS);
        const bool tiles = grid && !(v.masked && (several || o.cull != CGT_CULL_AUTO));
        assert_int_equal(st.tiles > 0, tiles);
        assert_true(!tiles || (research.culled > 0 && research.culled < research.cull_tests));
        if (v.masked && several) /* the hidden geometry makes a difference */
            assert_memory_not_equal(a->frame[i].memory, a->frame[i - SAMPLE_STEP].memory,
                                    a->frame[i].elements * sizeof(uint32_t));
    }
}

static void trace_lights(const cgt_scene *scene, const queries *q, answers *a)
{
    const cgt_points points = {.count = PIXELS,
                               .position = {q->point[0], q->point[1], q->point[2]},
                               .skip_primitive = q->skip_prim[0],
                               .skip_geometry = q->skip_prim[1]};
    for (uint32_t i = 0; i < LIGHTS; i++) {
        if (!is_selected(q, i))
            continue;
        cgt_trace_statistics st;
        test_trace_options o = {0};
        o.statistics = &st;
        assert_int_equal(cgt_occluded_points(scene, &lights[i], &points, a->shadow[i], TRACE_OPTIONS(&o)), CGT_OK);
        assert_true(st.hits > PIXELS / 20 && st.hits < PIXELS);
        /* by tiles, or through a BVH that paid in the commits before */
        assert_true(scene->committed_scene.loose.levels ? st.tiles > 0 || st.bvh_rays > 0 : st.tiles == 0);
    }
}

/* Traces in calls of `each` rays. Returns how many rays went through a BVH. */
static uint64_t trace_batches(const cgt_scene *scene, const queries *q, uint32_t first, uint32_t count, uint32_t each,
                              answers *a)
{
    uint64_t bvh_rays = 0;
    memset(a->hit + first, 0x77, count * sizeof a->hit[0]);
    memset(a->occluded + first, 0x77, count);
    for (uint32_t i = first; i < first + count; i += each) {
        const uint32_t batch = first + count - i < each ? first + count - i : each;
        const cgt_rays rays = ray_array(q->ray + i, batch);
        cgt_trace_statistics st;
        test_trace_options o = {0};
        o.statistics = &st;
        o.cull = (cgt_cull)(i / each % 3);
        assert_int_equal(trace_array(scene, q->ray + i, batch, a->hit + i, TRACE_OPTIONS(&o)), CGT_OK);
        bvh_rays += st.bvh_rays;
        assert_int_equal(cgt_occluded_rays(scene, &rays, a->occluded + i, TRACE_OPTIONS(&o)), CGT_OK);
        bvh_rays += st.bvh_rays;
    }
    return bvh_rays;
}

static void compare_answers(const answers *got, const answers *want, const queries *q, const char *what)
{
    for (uint32_t i = 0; i < VIEWS; i++)
        if (is_selected(q, i) && !planes_equal(&got->frame[i], &want->frame[i])) {
            size_t k = 0;
            while (got->frame[i].memory[k] == want->frame[i].memory[k])
                k++;
            k %= got->frame[i].elements;
            fail_msg("%s: view %u, pixel %zu: triangle %d at %a, not %d at %a", what, i, k,
                     (int)got->frame[i].primitive[k], (double)got->frame[i].t[k], (int)want->frame[i].primitive[k],
                     (double)want->frame[i].t[k]);
        }
    for (uint32_t i = 0; i < LIGHTS; i++)
        for (uint32_t k = 0; is_selected(q, i) && k < PIXELS; k++)
            if (got->shadow[i][k] != want->shadow[i][k])
                fail_msg("%s: light %u: point %u is %s", what, i, k, want->shadow[i][k] ? "in shadow" : "in the light");
    for (uint32_t i = 0; i < q->rays; i++)
        if (memcmp(&got->hit[i], &want->hit[i], sizeof want->hit[i]) != 0 || got->occluded[i] != want->occluded[i])
            fail_msg("%s: ray %u: triangle %d at %a, any hit %d; not %d at %a", what, i, (int)got->hit[i].primitive,
                     (double)got->hit[i].t, got->occluded[i], (int)want->hit[i].primitive, (double)want->hit[i].t);
}

/* The hits in a kd-tree, which holds single triangles. */
static answers *kd_answers(cgt_context *context, queries *q, const mesh *m, test_random *r, uint32_t number)
{
    cgt_scene *scene = committed(context, &kd_tree, m);
    uint32_t hits = 0;
    q->rays = test_samples() ? FEWER_RAYS : RAYS;
    q->sample = test_sample_start(number, SAMPLE_STEP);
    answers *a = answers_make();
    make_rays(q, m, r);
    make_points(q, scene);
    trace_frames(scene, q, 0, a);
    trace_lights(scene, q, a);
    trace_batches(scene, q, 0, q->rays, q->rays, a);
    for (uint32_t i = 0; i < q->rays; i++)
        hits += a->hit[i].primitive != CGT_INVALID_ID;
    assert_true(hits > q->rays / 2 && hits < q->rays);
    cgt_scene_release(scene);
    return a;
}

/* Traces everything through the grid, in calls of one ray and of a bundle. */
static void check_grid(cgt_context *context, const queries *q, const mesh *m, uint32_t turn, const answers *want)
{
    cgt_scene *scene = committed(context, &loose_grid, m);
    assert_non_null(scene->committed_scene.cluster);
    answers *got = answers_make();
    trace_frames(scene, q, turn, got);
    trace_lights(scene, q, got);
    for (uint32_t each = 1; each <= BUNDLE; each += BUNDLE - 1) {
        assert_int_equal(trace_batches(scene, q, 0, q->rays, each, got), 0);
        compare_answers(got, want, q, each == 1 ? "rays one by one" : "rays in bundles");
    }
    answers_free(got);
    cgt_scene_release(scene);
}

/* The first few rays after a commit go through the grid; then there are enough for a BVH. */
static void check_automatic(const cgt_scene *scene, const queries *q, const answers *want)
{
    answers *got = answers_make();
    assert_true(scene->committed_scene.cluster && !scene->committed_scene.bvh.node);
    assert_int_equal(trace_batches(scene, q, 0, FEW / 2, 1, got), 0);
    assert_int_equal(trace_batches(scene, q, FEW / 2, FEW / 2, BUNDLE, got), 0);
    assert_int_equal(trace_batches(scene, q, FEW, q->rays - FEW, q->rays - FEW, got), 2 * (q->rays - FEW));
    trace_frames(scene, q, 0, got);
    trace_lights(scene, q, got);
    compare_answers(got, want, q, "automatic");
    assert_int_equal(trace_batches(scene, q, 0, q->rays, BUNDLE, got), 2 * q->rays);
    compare_answers(got, want, q, "bundles through a BVH");
    answers_free(got);
}

static void check_hits(const mesh *m, uint32_t stream)
{
    queries *q = malloc(sizeof *q);
    test_random r = random_make(stream);
    cgt_context *context = context_make(1, NULL);
    uint32_t turn = 0;
    assert_non_null(q);
    answers *want = kd_answers(context, q, m, &r, stream);
    cgt_context_release(context);
    FOR_EACH_VARIANT(variant)
    {
        context = context_make(1 + turn % 2, variant);
        check_grid(context, q, m, turn++, want);
        cgt_scene *scene = committed(context, &automatic, m);
        check_automatic(scene, q, want);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
    answers_free(want);
    free(q);
}

TEST(hits_are_those_of_triangles)
{
    static const uint32_t whole[] = {10003};
    for (uint32_t form = 0; form < 3; form++) { /* the last one with a BVH of single triangles */
        mesh m = mesh_make(whole, 1, BEYOND, form);
        if (form == 2)
            mesh_loosen(&m);
        if (form)
            mesh_spoil(&m);
        mesh_store(&m);
        check_hits(&m, 10 + form);
        mesh_free(&m);
    }
}

TEST(hits_are_those_of_several_geometries)
{
    mesh m = mesh_make(uneven, PARTS, BEYOND, 0);
    mesh_spoil(&m);
    mesh_store(&m);
    check_hits(&m, 20);
    mesh_free(&m);
}

/* ---- motion ---- */

/* Before each commit the mesh moves and other triangles are skipped; only the first commit allocates. */
static void move(bool loosened)
{
    unsigned allocations = 0, before = 0;
    test_random r = random_make(30);
    queries *q = malloc(sizeof *q);
    cgt_context *context = context_counting(&allocations), *other = context_make(1, NULL);
    mesh m = mesh_make(uneven, PARTS, 0, 1);
    cgt_scene *scene = scene_with(context, &automatic, &m);
    assert_non_null(q);
    for (uint32_t step = 0; step < 3; step++) {
        mesh_place(&m, 0.1 * step);
        if (loosened)
            mesh_loosen(&m);
        if (step != 1 || loosened) /* a BVH of triangles that are all valid has more leaves */
            mesh_spoil(&m);
        mesh_store(&m);
        commit(scene);
        assert_int_equal(scene->committed_scene.bvh_of_clusters, !loosened);
        assert_true(!step || allocations == before);
        answers *want = kd_answers(other, q, &m, &r, step);
        check_automatic(scene, q, want);
        assert_true(!step || allocations == before);
        before = allocations;
        answers_free(want);
    }
    assert_true(before > 0);
    cgt_scene_release(scene);
    cgt_context_release(context);
    cgt_context_release(other);
    mesh_free(&m);
    free(q);
}

TEST(hits_move_with_the_mesh)
{
    move(false);
    move(true);
}

SEEDED_SUITE("test_cluster_hits", NULL, NULL)

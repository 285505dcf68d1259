/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays as simulations have them: doubles with an origin, structs without padding, radii by type, 16-bit indices. A
 * scene of each has the hits, bit for bit, of a scene over the floats that its numbers are rounded to. Arrays that the
 * commit copies are not read after it. No profile of tests/driver, whose numbers are floats in every form, so that all
 * loads have the same truth: this asks how numbers are rounded and arrays are told. */
#include "support/closed_meshes.h"
#include "support/suite.h"
#include "support/scenes.h"

#include <fenv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SPHERES 3000u
#define TYPES 5u
#define WIDTH 96u
#define HEIGHT 80u
#define RAYS 500u

static const double far_origin[3] = {1e9, -3e8 + 0.1, 7e6};

/* ---- what a scene answers ---- */

typedef struct answers {
    planes frame;
    ray_hit hits[RAYS];
} answers;

/* A frame, and more rays than it takes to build a BVH. */
static answers ask(const cgt_scene *scene)
{
    answers a = {.frame = planes_make(WIDTH, HEIGHT)};
    static truth_ray rays[RAYS];
    test_random r = random_make(7);
    cgt_camera camera;
    cgt_camera_init(&camera);
    camera.eye[2] = 20;
    for (uint32_t i = 0; i < RAYS; i++) {
        for (int k = 0; k < 3; k++)
            rays[i].org[k] = random_float(&r, -6, 6);
        random_direction(&r, rays[i].dir);
        rays[i].t_min = 0;
        rays[i].t_max = INFINITY;
    }
    frame_trace(scene, &camera, &a.frame, NULL);
    rays_trace(scene, rays, RAYS, a.hits, NULL);
    return a;
}

static void expect_equal(const answers *a, const answers *b, const char *what)
{
    if (!planes_equal(&a->frame, &b->frame) || memcmp(a->hits, b->hits, sizeof a->hits) != 0)
        fail_msg("%s: other hits", what);
}

static uint32_t frame_hits(const answers *a)
{
    uint32_t hits = 0;
    for (size_t i = 0; i < a->frame.elements; i++)
        hits += a->frame.primitive[i] != CGT_INVALID_ID;
    return hits;
}

static cgt_scene_statistics statistics_of(const cgt_scene *scene)
{
    cgt_scene_statistics s;
    assert_int_equal(cgt_scene_get_statistics(scene, &s), CGT_OK);
    return s;
}

/* ---- spheres ---- */

#pragma pack(push, 1)
typedef struct packed_atom { /* nothing is aligned, and two atoms are an odd number of bytes apart */
    char element;
    double x[3];
    float radius;
    uint16_t type;
} packed_atom;

typedef struct packed_float_atom {
    uint8_t type;
    float x[3], radius;
} packed_float_atom;
#pragma pack(pop)

/* The same spheres in each form. */
typedef struct sphere_arrays {
    double x[SPHERES][3], radius[SPHERES], table_double[TYPES];
    float plain[SPHERES][4], table[TYPES]; /* what the library must see */
    packed_atom atom[SPHERES];
    packed_float_atom float_atom[SPHERES];
    uint8_t type8[SPHERES];
    int32_t type32[SPHERES][2];
} sphere_arrays;

static sphere_arrays *make_spheres(test_random *r, const double origin[3])
{
    sphere_arrays *s = calloc(1, sizeof *s);
    assert_non_null(s);
    for (uint32_t k = 0; k < TYPES; k++) {
        s->table_double[k] = (double)random_float(r, 0.05f, 0.3f) * (1 + 0x1p-25); /* not a float */
        s->table[k] = (float)s->table_double[k];
    }
    for (uint32_t i = 0; i < SPHERES; i++) {
        const uint32_t type = random_below(r, TYPES);
        for (int a = 0; a < 3; a++) {
            s->x[i][a] = origin[a] + (double)random_float(r, -6, 6) / 3 * 3.0000001;
            s->plain[i][a] = (float)(s->x[i][a] - origin[a]);
            s->atom[i].x[a] = s->x[i][a];
            s->float_atom[i].x[a] = s->plain[i][a];
        }
        s->radius[i] = s->table_double[type];
        s->plain[i][3] = s->atom[i].radius = s->float_atom[i].radius = s->table[type];
        s->type8[i] = s->float_atom[i].type = (uint8_t)type;
        s->atom[i].type = (uint16_t)type;
        s->type32[i][0] = (int32_t)type;
    }
    return s;
}

#define FORMS 7u

/* Fills in the form of a number; false where it needs an origin of 0. */
static bool describe_spheres(const sphere_arrays *s, uint32_t form, const double origin[3], cgt_spheres *d)
{
    const char *atom = (const char *)s->atom, *float_atom = (const char *)s->float_atom;
    *d = (cgt_spheres){.count = SPHERES, .origin = {origin[0], origin[1], origin[2]}};
    d->centers = cgt_doubles(s->x[0], 0);
    d->radii = cgt_floats(s->table, 0);
    d->type_count = TYPES;
    switch (form) {
    case 0: d->radii = cgt_floats(NULL, 0), d->radii = cgt_doubles(s->radius, 0); return true;
    case 1:
        d->radii = cgt_floats(NULL, 0), d->radii = cgt_doubles(s->table_double, 0), d->types = cgt_uint8s(s->type8, 0);
        return true;
    case 2:
        d->types = cgt_uint32s((const uint32_t *)(const void *)s->type32[0], 0);
        d->types.stride = sizeof s->type32[0];
        return true;
    case 3:
        d->centers = cgt_doubles((const double *)(const void *)(atom + offsetof(packed_atom, x)), 0);
        d->radii = cgt_floats((const float *)(const void *)(atom + offsetof(packed_atom, radius)), 0);
        d->centers.stride = d->radii.stride = sizeof(packed_atom);
        return true;
    case 4:
        d->centers = cgt_doubles((const double *)(const void *)(atom + offsetof(packed_atom, x)), 0);
        d->types = cgt_uint16s((const uint16_t *)(const void *)(atom + offsetof(packed_atom, type)), 0);
        d->centers.stride = d->types.stride = sizeof(packed_atom);
        return true;
    case 5:
        d->centers = cgt_doubles(NULL, 0);
        d->centers = cgt_floats((const float *)(const void *)(float_atom + offsetof(packed_float_atom, x)), 0);
        d->radii = cgt_floats((const float *)(const void *)(float_atom + offsetof(packed_float_atom, radius)), 0);
        d->centers.stride = d->radii.stride = sizeof(packed_float_atom);
        return origin[0] == 0;
    default:
        d->centers = cgt_doubles(NULL, 0);
        d->centers = cgt_floats(s->plain[0], 0);
        d->centers.stride = sizeof s->plain[0];
        d->types = cgt_uint8s(&s->float_atom[0].type, 0);
        d->types.stride = sizeof(packed_float_atom);
        return origin[0] == 0;
    }
}

static int commit_rounding = FE_TONEAREST; /* of the caller, during commits */

static size_t copied_bytes_of(const cgt_scene *scene) { return statistics_of(scene).copied_bytes; }

/* Commits a copy of the arrays, which then lose their numbers. */
static answers answers_of_spheres(cgt_context *context, uint32_t structure, const sphere_arrays *from, uint32_t form,
                                  const double origin[3], bool *possible)
{
    sphere_arrays *s = malloc(sizeof *s);
    const cgt_scene_options options = structure ? structure_in_turn(structure) : (cgt_scene_options){0};
    cgt_spheres described;
    cgt_scene *scene = NULL;
    answers a = {0};
    assert_non_null(s);
    memcpy(s, from, sizeof *s);
    *possible = describe_spheres(s, form, origin, &described);
    if (*possible) {
        assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &described), CGT_OK);
        assert_int_equal(fesetround(commit_rounding), 0);
        const cgt_result result = cgt_scene_commit(scene);
        assert_int_equal(fesetround(FE_TONEAREST), 0);
        assert_int_equal(result, CGT_OK);
        assert_true(copied_bytes_of(scene) >= SPHERES * 4 * sizeof(float));
        memset(s, 0xff, sizeof *s);
        a = ask(scene);
        cgt_scene_release(scene);
    }
    free(s);
    return a;
}

TEST(spheres_of_every_form)
{
    static const double none[3] = {0};
    test_random r = random_make(1);
    for (uint32_t round = 0, rounds = test_between(2, 6); round < rounds; round++) {
        cgt_context *context = context_make(1 + round % 3, NULL);
        const double *origin = round % 2 ? far_origin : none;
        sphere_arrays *s = make_spheres(&r, origin);
        const cgt_scene_options options = round ? structure_in_turn(round) : (cgt_scene_options){0};
        cgt_scene *scene = scene_of(context, &options, (const float(*)[4])s->plain, SPHERES);
        answers expected = ask(scene);
        assert_true(frame_hits(&expected) > 1000);
        assert_int_equal(copied_bytes_of(scene), 0);
        for (uint32_t form = 0; form < FORMS; form++) {
            bool possible;
            answers a = answers_of_spheres(context, round, s, form, origin, &possible);
            if (!possible)
                continue;
            expect_equal(&expected, &a, "spheres");
            planes_free(&a.frame);
        }
        planes_free(&expected.frame);
        cgt_scene_release(scene);
        cgt_context_release(context);
        free(s);
    }
}

/* ---- triangles ---- */

/* The same mesh in each form. */
typedef struct triangle_arrays {
    uint32_t vertices, triangles;
    double (*x)[3];
    float (*plain)[3];
    uint32_t (*index)[3];
    uint16_t (*index16)[3];
    char *packed; /* vertices as floats, 13 bytes apart, then indices, 13 bytes apart, at odd addresses */
} triangle_arrays;

static triangle_arrays make_triangles(uint32_t detail, const double origin[3])
{
    closed_mesh mesh;
    triangle_arrays t = {0};
    assert_true(closed_mesh_make(&mesh, CLOSED_TORUS, detail));
    t = (triangle_arrays){.vertices = mesh.vertices, .triangles = mesh.triangles};
    t.x = calloc(t.vertices, sizeof *t.x);
    t.plain = calloc(t.vertices, sizeof *t.plain);
    t.index = calloc(t.triangles, sizeof *t.index);
    t.index16 = calloc(t.triangles, sizeof *t.index16);
    t.packed = calloc(t.vertices + t.triangles, 13);
    assert_true(t.x && t.plain && t.index && t.index16 && t.packed && t.vertices <= UINT16_MAX);
    for (uint32_t i = 0; i < t.vertices; i++) {
        for (int a = 0; a < 3; a++) {
            t.x[i][a] = origin[a] + 5 * mesh.vertex[i][a];
            t.plain[i][a] = (float)(t.x[i][a] - origin[a]);
        }
        memcpy(t.packed + 13 * (size_t)i + 1, t.plain[i], 12);
    }
    for (uint32_t i = 0; i < t.triangles; i++) {
        for (int k = 0; k < 3; k++) {
            t.index[i][k] = mesh.index[i][k];
            t.index16[i][k] = (uint16_t)mesh.index[i][k];
        }
        memcpy(t.packed + 13 * (size_t)(t.vertices + i) + 1, t.index[i], 12);
    }
    closed_mesh_free(&mesh);
    return t;
}

static void free_triangles(triangle_arrays *t)
{
    free(t->x);
    free(t->plain);
    free(t->index);
    free(t->index16);
    free(t->packed);
}

static cgt_triangles describe_triangles(const triangle_arrays *t, uint32_t form, const double origin[3])
{
    cgt_triangles d = {.count = t->triangles, .vertex_count = t->vertices};
    memcpy(d.origin, origin, sizeof d.origin);
    d.vertices = cgt_doubles(t->x[0], 0);
    if (form == 0) {
        d.indices = cgt_uint32s(t->index[0], 0);
    } else if (form == 1) {
        d.indices = cgt_uint16s(t->index16[0], 0);
    } else {
        d = (cgt_triangles){.count = t->triangles, .vertex_count = t->vertices};
        d.vertices = cgt_floats((const float *)(const void *)(t->packed + 1), 0);
        d.indices = cgt_uint32s((const uint32_t *)(const void *)(t->packed + 13 * (size_t)t->vertices + 1), 0);
        d.vertices.stride = d.indices.stride = 13;
    }
    return d;
}

static cgt_scene *scene_of_triangles(cgt_context *context, const cgt_scene_options *options, const cgt_triangles *t)
{
    cgt_scene *scene = NULL;
    assert_int_equal(cgt_scene_create(context, options, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, t), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* A mesh large enough for clusters and a small one. */
TEST(triangles_of_every_form)
{
    for (uint32_t round = 0, rounds = test_between(2, 8); round < rounds; round++) {
        cgt_context *context = context_make(1 + round % 3, NULL);
        const cgt_scene_options options = round / 2 ? structure_in_turn(round / 2) : (cgt_scene_options){0};
        const uint32_t detail = round % 2 ? 120 : 20;
        triangle_arrays t = make_triangles(detail, far_origin);
        const cgt_triangles plain = {.count = t.triangles,
                                     .indices = cgt_uint32s(t.index[0], 0),
                                     .vertex_count = t.vertices,
                                     .vertices = cgt_floats(t.plain[0], 0)};
        cgt_scene *scene = scene_of_triangles(context, &options, &plain);
        answers expected = ask(scene);
        assert_true(frame_hits(&expected) > 500);
        assert_int_equal(copied_bytes_of(scene), 0);
        cgt_scene_release(scene);
        for (uint32_t form = 0; form < 3; form++) {
            triangle_arrays lost = make_triangles(detail, far_origin);
            const cgt_triangles d = describe_triangles(&lost, form, far_origin);
            scene = scene_of_triangles(context, &options, &d);
            assert_true(copied_bytes_of(scene) >= t.vertices * 12);
            memset(lost.x, 0xff, t.vertices * sizeof *lost.x);
            memset(lost.packed, 0xff, 13 * (size_t)(t.vertices + t.triangles));
            memset(lost.index16, 0xff, t.triangles * sizeof *lost.index16);
            answers a = ask(scene);
            expect_equal(&expected, &a, "triangles");
            planes_free(&a.frame);
            cgt_scene_release(scene);
            free_triangles(&lost);
        }
        planes_free(&expected.frame);
        free_triangles(&t);
        cgt_context_release(context);
    }
}

/* ---- several geometries, and time ---- */

/* Geometries that are copied and others that are read in place, in frames whose numbers change. In a steady state
 * nothing is allocated. */
TEST(geometries_move_in_doubles)
{
    unsigned allocations = 0;
    test_random r = random_make(3);
    cgt_context *context = context_counting(&allocations);
    sphere_arrays *s = make_spheres(&r, far_origin);
    triangle_arrays t = make_triangles(30, far_origin);
    cgt_scene *given = NULL, *plain = NULL;
    cgt_spheres spheres;
    const cgt_triangles triangles = describe_triangles(&t, 0, far_origin),
                        floats = {.count = t.triangles,
                                  .indices = cgt_uint32s(t.index[0], 0),
                                  .vertex_count = t.vertices,
                                  .vertices = cgt_floats(t.plain[0], 0)};
    const cgt_spheres plain_spheres = spheres_of((const float(*)[4])s->plain, SPHERES);
    describe_spheres(s, 4, far_origin, &spheres);
    assert_int_equal(cgt_scene_create(context, NULL, &given), CGT_OK);
    assert_int_equal(cgt_scene_create(context, NULL, &plain), CGT_OK);
    for (int k = 0; k < 2; k++) { /* given: both are copied; then spheres in place */
        assert_int_equal(cgt_scene_set_triangles(given, NULL, k ? &floats : &triangles), CGT_OK);
        assert_int_equal(cgt_scene_set_spheres(given, NULL, k ? &plain_spheres : &spheres), CGT_OK);
        assert_int_equal(cgt_scene_set_triangles(plain, NULL, &floats), CGT_OK);
        assert_int_equal(cgt_scene_set_spheres(plain, NULL, &plain_spheres), CGT_OK);
    }
    for (int frame = 0; frame < 4; frame++) {
        for (uint32_t i = 0; i < SPHERES; i++)
            for (int a = 0; a < 3; a++) {
                s->atom[i].x[a] += 0.01 * frame;
                s->plain[i][a] = (float)(s->atom[i].x[a] - far_origin[a]);
            }
        const unsigned before = allocations;
        assert_int_equal(cgt_scene_commit(given), CGT_OK);
        assert_int_equal(cgt_scene_commit(plain), CGT_OK);
        assert_true(frame < 2 || allocations == before);
        answers a = ask(given), b = ask(plain);
        expect_equal(&a, &b, "geometries");
        planes_free(&a.frame);
        planes_free(&b.frame);
    }
    cgt_scene_release(given);
    cgt_scene_release(plain);
    cgt_context_release(context);
    free_triangles(&t);
    free(s);
}

/* ---- numbers at the edges ---- */

/* What is not finite as a float is skipped and counted, whatever the doubles are. */
TEST(numbers_are_judged_as_floats)
{
    static const double x[6][3] = {{0, 0, 0}, {1e300, 0, 0}, {NAN, 0, 0}, {0, -INFINITY, 0}, {3, 0, 0}, {0, 3, 0}};
    static const double radius[6] = {1, 1, 1, 1, -1e-30, 1e39};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = NULL;
    const cgt_spheres d = {.count = 6, .centers = cgt_doubles(x[0], 0), .radii = cgt_doubles(radius, 0)};
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &d), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    const cgt_scene_statistics s = statistics_of(scene);
    assert_int_equal(s.skipped_not_finite, 4);
    assert_int_equal(s.skipped_radius, 1);
    const ray_hit hit = ray_trace(scene, (truth_ray){{0, 0, 5}, {0, 0, -1}, 0, INFINITY});
    assert_true(hit.t == 4 && hit.primitive == 0);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

static void expect_commit_fails(cgt_context *context, cgt_scene *scene, const char *sentence)
{
    ray_hit hit;
    const truth_ray ray = {{0, 0, 5}, {0, 0, -1}, 0, INFINITY};
    const cgt_rays rays = ray_array(&ray, 1);
    const cgt_hits hits = hits_of(&hit);
    assert_int_equal(cgt_scene_commit(scene), CGT_ERROR_INVALID_ARGUMENT);
    assert_string_equal(context_message(context), sentence);
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_ERROR_NOT_COMMITTED);
    cgt_scene_release(scene);
}

TEST(types_and_indices_out_of_range)
{
    test_random r = random_make(4);
    cgt_context *context = context_make(3, NULL);
    for (uint32_t round = 0; round < 8; round++) {
        static float center[20000][3], radii[3] = {1, 1, 1};
        static uint32_t type[20000];
        const uint32_t bad = random_below(&r, 20000);
        const uint32_t value = round % 2 ? 3 : UINT32_MAX; /* such as an int of -1 */
        char sentence[200];
        cgt_scene *scene = NULL;
        memset(type, 0, sizeof type);
        type[bad] = value;
        if (bad < 19999)
            type[bad + random_below(&r, 19999 - bad) + 1] = 7; /* the first one is named */
        const cgt_spheres d = {.count = 20000,
                               .centers = cgt_floats(center[0], 0),
                               .radii = cgt_floats(radii, 0),
                               .types = cgt_uint32s(type, 0),
                               .type_count = 3};
        assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
        assert_int_equal(
            cgt_scene_set_spheres(scene, NULL, &(cgt_spheres){.count = 1, .centers = cgt_floats(center[0], 0)}),
            CGT_OK);
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &d), CGT_OK);
        snprintf(sentence, sizeof sentence, "commit: geometry 1: sphere %u has type %u, but there are 3 types", bad,
                 value);
        expect_commit_fails(context, scene, sentence);
    }
    const float corner[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const uint16_t index[2][3] = {{0, 1, 2}, {0, 65535, 2}};
    cgt_scene *scene = NULL;
    const cgt_triangles d = {
        .count = 2, .indices = cgt_uint16s(index[0], 0), .vertex_count = 3, .vertices = cgt_floats(corner[0], 0)};
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &d), CGT_OK);
    expect_commit_fails(context, scene, "commit: geometry 0: triangle 1 has index 65535, but there are 3 vertices");
    cgt_context_release(context);
}

/* The caller's rounding mode does not reach the copies. */
TEST(copies_are_rounded_to_nearest)
{
#ifdef FE_UPWARD
    test_random r = random_make(5);
    cgt_context *context = context_make(2, NULL);
    sphere_arrays *s = make_spheres(&r, far_origin);
    bool possible;
    answers expected = answers_of_spheres(context, 0, s, 0, far_origin, &possible);
    commit_rounding = FE_UPWARD;
    answers a = answers_of_spheres(context, 0, s, 0, far_origin, &possible);
    commit_rounding = FE_TONEAREST;
    expect_equal(&expected, &a, "rounding upwards");
    planes_free(&a.frame);
    planes_free(&expected.frame);
    cgt_context_release(context);
    free(s);
#endif
}

/* Every number of 16 bits is read as its value. */
TEST(halves_have_their_values)
{
    for (uint32_t bits = 0; bits < 1u << 16; bits++) {
        const uint32_t exponent = bits >> 10 & 31, fraction = bits & 1023;
        const double size = exponent == 31 ? (fraction ? NAN : INFINITY)
                            : exponent     ? ldexp(1024 + fraction, (int)exponent - 25)
                                           : ldexp(fraction, -24);
        const float value = cgt_half_get_float((uint16_t)bits);
        assert_true(isnan(size) ? isnan(value) : fabs((double)value) == size);
        assert_int_equal(!!signbit(value), bits >> 15);
    }
}

/* Halves, and indices of 8 and 64 bits: the hits of the same numbers as floats and 32-bit indices. */
TEST(halves_and_other_indices)
{
    static const uint16_t half[4][3] = {{0, 0, 0}, {0x3c00, 0, 0}, {0, 0x4100, 0}, {0xbc00, 0xb800, 0x3400}},
                          half_radii[2] = {0x2e66, 0x3000}; /* 0.0999, 0.125 */
    static const float plain[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2.5f, 0}, {-1, -0.5f, 0.25f}};
    static const uint32_t index[2][3] = {{0, 1, 2}, {2, 3, 0}}, end[2][2] = {{0, 3}, {1, 2}};
    static const uint8_t index8[2][3] = {{0, 1, 2}, {2, 3, 0}};
    static const int64_t index64[2][3] = {{0, 1, 2}, {2, 3, 0}};
    static const uint64_t end64[2][2] = {{0, 3}, {1, 2}}, type64[4] = {0, 1, 1, 0};
    static const uint32_t type32[4] = {0, 1, 1, 0};
    const float radii[2] = {cgt_half_get_float(half_radii[0]), 0.125f};
    const cgt_triangles meshes[] = {
        {.count = 2, .indices = cgt_uint32s(index[0], 0), .vertices = cgt_floats(plain[0], 0), .vertex_count = 4},
        {.count = 2, .indices = cgt_uint8s(index8[0], 0), .vertices = cgt_halves(half[0], 0), .vertex_count = 4},
        {.count = 2, .indices = cgt_int64s(index64[0], 0), .vertices = cgt_halves(half[0], 0), .vertex_count = 4}};
    const cgt_spheres balls[] = {{.count = 4,
                                  .centers = cgt_floats(plain[0], 0),
                                  .radii = cgt_floats(radii, 0),
                                  .types = cgt_uint32s(type32, 0),
                                  .type_count = 2},
                                 {.count = 4,
                                  .centers = cgt_halves(half[0], 0),
                                  .radii = cgt_halves(half_radii, 0),
                                  .types = cgt_uint64s(type64, 0),
                                  .type_count = 2}};
    const cgt_capsules rods[] = {{.count = 2,
                                  .indices = cgt_uint32s(end[0], 0),
                                  .vertices = cgt_floats(plain[0], 0),
                                  .vertex_count = 4,
                                  .radii = cgt_floats(radii, 0)},
                                 {.count = 2,
                                  .indices = cgt_uint64s(end64[0], 0),
                                  .vertices = cgt_halves(half[0], 0),
                                  .vertex_count = 4,
                                  .radii = cgt_halves(half_radii, 0)}};
    cgt_context *context = context_make(1, NULL);
    answers expected = {0};
    for (uint32_t form = 0; form < 3; form++) {
        cgt_scene *scene = NULL;
        assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
        assert_int_equal(cgt_scene_set_triangles(scene, NULL, &meshes[form]), CGT_OK);
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &balls[form != 0]), CGT_OK);
        assert_int_equal(cgt_scene_set_capsules(scene, NULL, &rods[form != 0]), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        answers a = ask(scene);
        if (form) {
            expect_equal(&a, &expected, "other formats");
            planes_free(&a.frame);
        } else {
            expected = a;
            assert_true(frame_hits(&a) > 20);
        }
        cgt_scene_release(scene);
    }
    planes_free(&expected.frame);
    cgt_context_release(context);
}

SEEDED_SUITE("test_arrays", NULL, NULL)

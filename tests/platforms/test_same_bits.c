/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The same bits everywhere: all calls of the public headers trace fixed scenes, and the hashes of their results are
 * those of same_bits.inc, on every platform, in every variant, through every structure, from any number of threads.
 *
 *   test_same_bits          compares
 *   test_same_bits print    prints the lines of same_bits.inc as this machine computes them */
#include "support/test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/all_hits.h>
#include <cgt/bounces.h>
#include <cgt/cgt.h>
#include <cgt/research.h>

enum { SPHERES = 600, TRIANGLES = 400, WIDTH = 96, HEIGHT = 72, PIXELS = WIDTH * HEIGHT, RAYS = 1500, ROW = 4 };

/* ---- expected and computed hashes ---- */

static const struct line {
    const char *part;
    uint64_t hash;
} expected[] = {
#define SAME(part, hash) {part, UINT64_C(hash)},
#include "same_bits.inc"
};

static struct {
    char part[48];
    uint64_t hash;
} computed[1000]; /* of all structures */
static size_t computed_count;
static const char *scene_name;
static bool has_capsules;

static uint64_t hash;

/* by value, so that the order of bytes does not matter */
static void add_word(uint32_t word)
{
    hash = (hash ^ word) * UINT64_C(1099511628211);
    hash ^= hash >> 29;
}
static void add_words(const void *words, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t word;
        memcpy(&word, (const char *)words + 4 * i, 4);
        add_word(word);
    }
}
static void add_planes(float *const plane[3], size_t count)
{
    for (int a = 0; a < 3; a++)
        add_words(plane[a], count);
}
static void add_bytes(const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        add_word(bytes[i]);
}
static void add_doubles(const double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, numbers + i, 8);
        add_word((uint32_t)bits);
        add_word((uint32_t)(bits >> 32));
    }
}

/* Ends a part: its hash is kept under its name, and the next one begins. */
static void end_part(const char *name)
{
    assert_true(computed_count < TEST_COUNT(computed));
    snprintf(computed[computed_count].part, sizeof computed[0].part, "%s, %s", scene_name, name);
    computed[computed_count++].hash = hash;
    hash = UINT64_C(14695981039346656037);
}

/* ---- input, by integers alone ---- */

static uint64_t random_state;

static uint32_t next_random(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (uint32_t)(random_state >> 16);
}
/* in [-1, 1), exact */
static float next_float(int bits)
{
    const float half = (float)(1 << (bits - 1));
    return ((float)(next_random() >> (32 - bits)) - half) / half;
}

static float centers[SPHERES][3], radii[SPHERES], vertices[3 * TRIANGLES][3];
static double far_centers[SPHERES][3];
static uint8_t types[SPHERES];
static uint16_t indices[TRIANGLES][3];

static void make_input(void)
{
    random_state = UINT64_C(88172645463325252);
    for (int i = 0; i < SPHERES; i++) {
        for (int a = 0; a < 3; a++) {
            centers[i][a] = next_float(20);
            far_centers[i][a] = 1e9 + (double)next_float(24);
        }
        radii[i] = (float)(1 + (next_random() & 63)) / 512;
        types[i] = next_random() & 3;
    }
    for (int i = 0; i < TRIANGLES; i++) {
        const float middle[3] = {next_float(12), next_float(12), next_float(12)};
        for (int k = 0; k < 3; k++) {
            for (int a = 0; a < 3; a++)
                vertices[3 * i + k][a] = middle[a] + next_float(12) / 4;
            indices[i][k] = (uint16_t)(next_random() % 3 + 3 * (uint32_t)i);
        }
    }
    /* what is skipped, and what is there twice */
    centers[7][1] = NAN;
    centers[8][2] = INFINITY;
    radii[9] = -1;
    radii[10] = 0;
    vertices[40][0] = NAN;
    memcpy(vertices[31], vertices[30], sizeof vertices[31]);
    for (int i = 100; i < 120; i++) {
        memcpy(centers[i], centers[i - 40], sizeof centers[i]);
        radii[i] = radii[i - 40];
        memcpy(vertices[(size_t)3 * i], vertices[(size_t)3 * (i - 40)], sizeof vertices[0] * 3);
    }
}

/* ---- output ---- */

static float t[PIXELS], u[PIXELS], v[PIXELS], share[PIXELS], t_min[PIXELS], t_max[PIXELS];
static float planes[12][PIXELS];
static uint32_t primitive[PIXELS], geometry[PIXELS], skip_primitive[PIXELS], skip_geometry[PIXELS], mask[RAYS];
static uint32_t surface[RAYS * ROW], row_count[RAYS];
static uint8_t bytes[2 * PIXELS];
static double doubles[7][PIXELS];

#define PLANES(i)                                                                                                      \
    {                                                                                                                  \
        planes[i], planes[(i) + 1], planes[(i) + 2]                                                                    \
    }
static float *const org[3] = PLANES(0), *const dir[3] = PLANES(3), *const normal[3] = PLANES(6),
                    *const position[3] = PLANES(9);
static const cgt_hits all_fields = {
    .t = t, .primitive = primitive, .geometry = geometry, .normal = PLANES(6), .u = u, .v = v};

static void add_hits(size_t count)
{
    add_words(t, count);
    add_words(primitive, count);
    add_words(geometry, count);
    add_planes(normal, count);
    add_words(u, count);
    add_words(v, count);
}

/* ---- calls ---- */

static void trace_frame(const cgt_scene *scene, const cgt_camera *camera, cgt_precision precision)
{
    const cgt_trace_options options = {.precision = precision};
    cgt_frame frame;
    cgt_frame_init(&frame, WIDTH, HEIGHT);
    frame = (cgt_frame){.width = WIDTH,
                        .height = HEIGHT,
                        .t = t,
                        .primitive = primitive,
                        .geometry = geometry,
                        .normal = PLANES(6),
                        .u = u,
                        .v = v,
                        .position = PLANES(9)};
    assert_int_equal(cgt_trace_camera(scene, camera, &frame, &options), CGT_OK);
    add_hits(PIXELS);
    add_planes(position, PIXELS);
    end_part(precision == CGT_PRECISION_FAST ? "frame, fast" : "frame, exact");
    if (precision == CGT_PRECISION_FAST)
        return;
    const cgt_light lights[2] = {{.kind = CGT_LIGHT_DIRECTIONAL, .position = {0.36f, 0.8f, 0.48f}},
                                 {.kind = CGT_LIGHT_POINT, .position = {-2, 3, 2}}};
    assert_int_equal(cgt_occluded_frame(scene, camera, &frame, lights, 2, NULL, bytes, NULL), CGT_OK);
    add_bytes(bytes, sizeof bytes);
    end_part("shadows");
    const cgt_ambient_options ambient = {.samples = 4, .radius = 0.5f};
    assert_int_equal(cgt_ambient_occlusion(scene, camera, &frame, &ambient, share, NULL), CGT_OK);
    add_words(share, PIXELS);
    end_part("ambient occlusion");
}

static void bounce(const cgt_scene *scene, const cgt_camera *camera)
{
    float one_org[3], one_dir[3];
    assert_int_equal(cgt_camera_get_rays(camera, WIDTH, HEIGHT, 0, 0, WIDTH, HEIGHT, 0, org, dir), CGT_OK);
    assert_int_equal(cgt_camera_get_ray(camera, WIDTH, HEIGHT, 3, 2, one_org, one_dir), CGT_OK);
    for (int a = 0; a < 3; a++) {
        assert_true(same_bits(one_org[a], org[a][2 * WIDTH + 3]));
        assert_true(same_bits(one_dir[a], dir[a][2 * WIDTH + 3]));
    }
    add_planes(org, PIXELS);
    add_planes(dir, PIXELS);
    end_part("camera's rays");
    cgt_rays rays = {.count = PIXELS, .org = PLANES(0), .dir = PLANES(3)};
    const cgt_surfaces surfaces = {.position = {doubles[0], doubles[1], doubles[2]},
                                   .normal = {doubles[3], doubles[4], doubles[5]},
                                   .length = doubles[6]};
    const cgt_bounced_rays next = {.org = PLANES(0),
                                   .dir = PLANES(3),
                                   .t_min = t_min,
                                   .t_max = t_max,
                                   .skip_primitive = skip_primitive,
                                   .skip_geometry = skip_geometry,
                                   .share = share};
    const cgt_media glass = {.inside = 1.5f};
    for (int k = 0; k < 3; k++) {
        assert_int_equal(cgt_bounce_rays(scene, &rays, &all_fields, &glass, &surfaces, k & 1 ? &next : NULL,
                                         k & 1 ? NULL : &next, NULL),
                         CGT_OK);
        rays.t_min = t_min;
        rays.t_max = t_max;
        rays.skip_primitive = skip_primitive;
        rays.skip_geometry = skip_geometry;
        for (int a = 0; a < 7; a++)
            add_doubles(doubles[a], PIXELS);
        add_planes(org, PIXELS);
        add_planes(dir, PIXELS);
        add_words(t_max, PIXELS);
        add_words(share, PIXELS);
        end_part(k & 1 ? "mirrored rays" : k ? "refracted again" : "refracted rays");
        assert_int_equal(cgt_trace_bounced_rays(scene, &rays, &all_fields, NULL), CGT_OK);
        add_hits(PIXELS);
        end_part(k & 1 ? "hits of mirrored rays" : k ? "hits of those refracted again" : "hits of refracted rays");
    }
}

static cgt_rays make_rays(void)
{
    random_state = UINT64_C(88172645463325259);
    for (int i = 0; i < RAYS; i++) {
        for (int a = 0; a < 3; a++) {
            org[a][i] = 2 * next_float(20);
            dir[a][i] = next_float(20);
        }
        mask[i] = i % 3 ? 0 : 1u << i % 4;
        t_min[i] = i % 5 ? 0 : -0.5f;
        t_max[i] = i % 7 ? INFINITY : 1.5f;
        skip_primitive[i] = i % 11 ? CGT_INVALID_ID : next_random() % SPHERES;
    }
    for (int a = 0; a < 3; a++)
        dir[a][5] = 0;
    dir[0][6] = dir[1][6] = 0;
    dir[0][7] = NAN;
    org[2][8] = INFINITY;
    return (cgt_rays){.count = RAYS,
                      .org = PLANES(0),
                      .dir = PLANES(3),
                      .t_min = t_min,
                      .t_max = t_max,
                      .mask = mask,
                      .skip_primitive = skip_primitive};
}

static void trace_rays(const cgt_scene *scene, const cgt_rays *rays)
{
    for (int k = 0; k < 2; k++) {
        const cgt_trace_options options = {.precision = k ? CGT_PRECISION_FAST : CGT_PRECISION_EXACT};
        assert_int_equal(cgt_trace_rays(scene, rays, &all_fields, &options), CGT_OK);
        add_hits(RAYS);
        end_part(k ? "rays, fast" : "rays, exact");
    }
    assert_int_equal(cgt_occluded_rays(scene, rays, bytes, NULL), CGT_OK);
    add_bytes(bytes, RAYS);
    end_part("occluded rays");
    for (int i = 0; i < 200; i++) {
        const cgt_single_ray ray = {.org = {org[0][i], org[1][i], org[2][i]}, .dir = {dir[0][i], dir[1][i], dir[2][i]}};
        cgt_hit hit;
        cgt_hit first[ROW];
        uint32_t count;
        bool occluded, more;
        assert_int_equal(cgt_trace_ray(scene, &ray, &hit, NULL), CGT_OK);
        assert_int_equal(cgt_occluded_ray(scene, &ray, &occluded, NULL), CGT_OK);
        assert_int_equal(cgt_trace_all_ray(scene, &ray, NULL, first, ROW, &count, &more, NULL), CGT_OK);
        assert_int_equal(hit.surface, count ? first[0].surface : CGT_SURFACE_NEAR);
        add_words(&hit, 3); /* all but the surface */
        add_words(hit.normal, 3);
        add_words(&hit.u, 1);
        add_words(&hit.v, 1);
        add_words(first, count * sizeof *first / 4);
        add_word(count << 2 | (uint32_t)more << 1 | occluded);
    }
    end_part("single rays");
    const cgt_light light = {.kind = CGT_LIGHT_POINT, .position = {0.25f, 3, 1}};
    const cgt_points points = {.count = RAYS, .position = PLANES(0)};
    assert_int_equal(cgt_occluded_points(scene, &light, &points, bytes, NULL), CGT_OK);
    add_bytes(bytes, RAYS);
    for (int k = 0; k < 2; k++) {
        const cgt_inside_options how = {.rule = k ? CGT_INSIDE_WINDING : CGT_INSIDE_PARITY};
        assert_int_equal(cgt_points_inside(scene, &points, &how, bytes, NULL),
                         has_capsules ? CGT_ERROR_UNSUPPORTED : CGT_OK);
        if (!has_capsules)
            add_bytes(bytes, RAYS);
    }
    end_part("points");
}

/* Adds a ray's hits to its own hash: which ray is visited first depends on the threads. */
static cgt_visit visit(void *user, uint64_t ray, const cgt_hit *hits, uint32_t count)
{
    uint32_t *sum = (uint32_t *)user + ray;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t word[sizeof *hits / 4];
        memcpy(word, hits + i, sizeof word);
        for (size_t k = 0; k < TEST_COUNT(word); k++)
            *sum = (*sum ^ word[k]) * 16777619u;
    }
    return CGT_VISIT_CONTINUE;
}

static void trace_all_hits(const cgt_scene *scene, const cgt_rays *rays)
{
    for (int k = 0; k < 2; k++) {
        const cgt_all_hits_options all = {.crossings = k};
        const cgt_hit_rows rows = {
            .capacity = ROW, .hits = all_fields, .surface = surface, .count = row_count, .more = bytes};
        memset(planes[6], 0, sizeof planes - sizeof planes[0] * 6);
        memset(t, 0, sizeof t);
        memset(primitive, 0, sizeof primitive);
        memset(geometry, 0, sizeof geometry);
        memset(u, 0, sizeof u);
        memset(v, 0, sizeof v);
        memset(surface, 0, sizeof surface);
        assert_int_equal(cgt_trace_all_rays(scene, rays, &all, &rows, NULL),
                         k && has_capsules ? CGT_ERROR_UNSUPPORTED : CGT_OK);
        if (k && has_capsules)
            continue;
        add_hits(RAYS * ROW);
        add_words(surface, RAYS * ROW);
        add_words(row_count, RAYS);
        add_bytes(bytes, RAYS);
        end_part(k ? "crossings" : "all hits");
    }
    memset(row_count, 0, sizeof row_count);
    assert_int_equal(cgt_visit_all_rays(scene, rays, NULL, CGT_FIELD_NORMAL | CGT_FIELD_UV, visit, row_count, NULL),
                     CGT_OK);
    add_words(row_count, RAYS);
    end_part("visited hits");
}

/* ---- scenes ---- */

static const cgt_spheres near_spheres = {
    .count = SPHERES, .centers = {centers[0], 0, CGT_FORMAT_FLOAT}, .radii = {radii, 0, CGT_FORMAT_FLOAT}};
static const cgt_spheres typed_spheres = {.count = SPHERES,
                                          .centers = {far_centers[0], 0, CGT_FORMAT_DOUBLE},
                                          .types = {types, 0, CGT_FORMAT_UINT8},
                                          .type_count = 4,
                                          .radii = {(const float[]){0.0625f, 0.125f, 0.1f, 0.03f}, 0, CGT_FORMAT_FLOAT},
                                          .origin = {1e9, 1e9, 1e9},
                                          .mask = 6};
static const cgt_triangles soup = {
    .count = TRIANGLES, .vertex_count = 3 * TRIANGLES, .vertices = {vertices[0], 0, CGT_FORMAT_FLOAT}};
static const cgt_triangles indexed = {.count = TRIANGLES,
                                      .vertex_count = 3 * TRIANGLES,
                                      .vertices = {vertices[0], 0, CGT_FORMAT_FLOAT},
                                      .indices = {indices[0], 0, CGT_FORMAT_UINT16},
                                      .mask = 5};

static const cgt_capsules rods = {.count = SPHERES / 2,
                                  .vertex_count = SPHERES,
                                  .vertices = {centers[0], 0, CGT_FORMAT_FLOAT},
                                  .radii = {radii, 0, CGT_FORMAT_FLOAT}};

/* What a scene has; NULL: none of that kind. */
typedef struct contents {
    const cgt_spheres *spheres;
    const cgt_triangles *triangles;
    const cgt_capsules *capsules;
} contents;

static void add_contents(cgt_scene *scene, const contents *c)
{
    if (c->spheres)
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, c->spheres), CGT_OK);
    if (c->triangles)
        assert_int_equal(cgt_scene_set_triangles(scene, NULL, c->triangles), CGT_OK);
    if (c->capsules)
        assert_int_equal(cgt_scene_set_capsules(scene, NULL, c->capsules), CGT_OK);
}

/* A scene of three geometries becomes `c`, after a commit and a frame. */
static void add_updated(cgt_scene *scene, const contents *c)
{
    static const cgt_capsules few = {.count = 20,
                                     .vertex_count = 20,
                                     .vertices = {centers[0], 0, CGT_FORMAT_FLOAT},
                                     .ends = {vertices[0], 0, CGT_FORMAT_FLOAT},
                                     .radius = 0.05f};
    const cgt_camera camera = {.eye = {0, 0, 4}, .fov = 40};
    const contents first = {&typed_spheres, &indexed, &few};
    cgt_frame frame;
    cgt_frame_init(&frame, WIDTH, HEIGHT);
    frame.primitive = primitive;
    frame.geometry = geometry;
    add_contents(scene, &first);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_int_equal(cgt_trace_camera(scene, &camera, &frame, NULL), CGT_OK);
    add_words(primitive, PIXELS);
    add_words(geometry, PIXELS);
    end_part("first frame");
    assert_int_equal(cgt_scene_set_spheres(scene, &(uint32_t){0}, c->spheres), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(scene, &(uint32_t){1}, c->triangles), CGT_OK);
    assert_int_equal(cgt_scene_set_capsules(scene, &(uint32_t){2}, c->capsules), CGT_OK);
}

static const cgt_structure structures[] = {CGT_STRUCTURE_AUTO,       CGT_STRUCTURE_BVH, CGT_STRUCTURE_LOOSE_GRID,
                                           CGT_STRUCTURE_QUEUE_GRID, CGT_STRUCTURE_KD,  CGT_STRUCTURE_KD_ROPES,
                                           CGT_STRUCTURE_BIH};

/* Emulators are slow, and the suite compares structures on its own: two are enough there, and where they compute in
 * software AUTO, which has a grid and a BVH. Capsules have one. */
static size_t structures_asked(const contents *c)
{
    if (c->capsules)
        return 1;
    return !test_samples() ? TEST_COUNT(structures) : test_scaled(100) > 1 ? 2 : 1;
}

/* Hits are the same through each structure: all of them are compared with the same lines. */
static void trace_scene(cgt_context *context, const char *name, const contents *c)
{
    const cgt_camera camera = {.eye = {0.5f, 0.75f, 3}, .fov = 50};
    cgt_scene *scene;
    scene_name = name;
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    has_capsules = c->capsules;
    (strcmp(name, "updated") ? add_contents : add_updated)(scene, c);
    const size_t count = structures_asked(c);
    for (size_t k = 0; k < count; k++) {
        cgt_scene_options options;
        cgt_scene_statistics statistics;
        cgt_scene_options_init(&options);
        options.structure = structures[k];
        assert_int_equal(cgt_scene_set_options(scene, &options), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        assert_int_equal(cgt_scene_prepare(scene, CGT_RAY_KIND_COHERENT), CGT_OK);
        assert_int_equal(cgt_scene_get_statistics(scene, &statistics), CGT_OK);
        add_words(statistics.bounds_min, 3);
        add_words(statistics.bounds_max, 3);
        add_word(statistics.primitives);
        add_word(statistics.skipped_not_finite);
        add_word(statistics.skipped_degenerate);
        add_word(statistics.skipped_radius);
        end_part("bounds");
        trace_frame(scene, &camera, CGT_PRECISION_FAST);
        trace_frame(scene, &camera, CGT_PRECISION_EXACT);
        bounce(scene, &camera);
        const cgt_rays rays = make_rays();
        trace_rays(scene, &rays);
        trace_all_hits(scene, &rays);
    }
    cgt_scene_release(scene);
}

static void compute(const char *variant, uint32_t threads)
{
    cgt_context_options options;
    cgt_context *context;
    cgt_context_options_init(&options);
    options.variant = variant;
    options.threads = threads;
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    computed_count = 0;
    hash = UINT64_C(14695981039346656037);
    make_input();
    trace_scene(context, "spheres", &(contents){&near_spheres, NULL, NULL});
    trace_scene(context, "triangles", &(contents){NULL, &soup, NULL});
    trace_scene(context, "both", &(contents){&near_spheres, &soup, NULL});
    trace_scene(context, "copied", &(contents){&typed_spheres, &indexed, NULL});
    trace_scene(context, "capsules", &(contents){NULL, NULL, &rods});
    trace_scene(context, "updated", &(contents){&near_spheres, &soup, &rods});
    memcpy(centers[20], (const float[]){0x1p60f, 0, 0}, sizeof centers[20]);
    memcpy(centers[21], (const float[]){0, 0x1p-60f, 0}, sizeof centers[21]);
    radii[20] = 0x1p50f;
    radii[21] = 0x1p-70f;
    trace_scene(context, "bands", &(contents){&near_spheres, NULL, NULL});
    cgt_context_release(context);
}

static uint64_t expected_hash(const char *part)
{
    for (size_t i = 0; i < TEST_COUNT(expected); i++)
        if (!strcmp(expected[i].part, part))
            return expected[i].hash;
    return 0;
}

static void check_variant(const char *variant, uint32_t threads)
{
    size_t wrong = 0;
    compute(variant, threads);
    for (size_t i = 0; i < computed_count; i++)
        if (computed[i].hash != expected_hash(computed[i].part)) {
            printf("%s, %u threads: %s: 0x%016llx\n", variant, (unsigned)threads, computed[i].part,
                   (unsigned long long)computed[i].hash);
            wrong++;
        }
    assert_true(computed_count >= TEST_COUNT(expected));
    assert_int_equal(wrong, 0);
}

static void test_same_bits(void **state)
{
    (void)state;
    const char *const *variants = cgt_get_variant_names();
    for (; *variants; variants++)
        if (test_variant_runs(*variants)) {
            const bool is_widest = !variants[1];
            if (!is_widest || !test_samples()) /* emulators are slow: there the widest one runs by threads alone */
                check_variant(*variants, 1);
            if (is_widest)
                check_variant(*variants, 3);
        }
}

/* Whether no structure before had this line. */
static bool is_new(size_t i)
{
    for (size_t k = 0; k < i; k++)
        if (!strcmp(computed[k].part, computed[i].part) && computed[k].hash == computed[i].hash)
            return false;
    return true;
}

int main(int argc, char **argv)
{
    test_begin("test_same_bits");
    if (argc > 1 && !strcmp(argv[1], "print")) {
        compute("portable", 1);
        for (size_t i = 0; i < computed_count; i++)
            if (is_new(i))
                printf("SAME(\"%s\", 0x%016llx)\n", computed[i].part, (unsigned long long)computed[i].hash);
        return 0;
    }
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A scene in the library, by any structure, variant and number of threads, from arrays of any form. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/driver.h"
#include "scene/bands.h"
#include "scene/scene.h"

#define VARIANTS 8u
#define THREADS 4u

static cgt_context *contexts[VARIANTS][THREADS + 1]; /* the first ones run their tasks backwards */

static void must(bool holds, const char *what, const driver_setup *setup)
{
    if (holds)
        return;
    fprintf(stderr, "%s: %s: %s\n", setup->name, what, setup->context ? context_message(setup->context) : "");
    exit(1);
}

/* ---- arrays: blocks that end with their last element ---- */

static void *allocate(driver_setup *setup, size_t bytes)
{
    must(setup->blocks < TEST_COUNT(setup->block), "too many arrays", setup);
    void *const block = malloc(bytes ? bytes : 1);
    must(block != NULL, "no memory", setup);
    setup->block[setup->blocks++] = block;
    return block;
}

/* Elements of `size` bytes at a stride; what lies between is odd. */
static char *allocate_strided(driver_setup *setup, uint32_t count, size_t size, size_t stride)
{
    const size_t bytes = count ? (count - 1) * stride + size : 0;
    return memset(allocate(setup, bytes), 0xff, bytes);
}

/* The points of a geometry's primitives, `each` of them a primitive, in the order of `at`. */
typedef struct point_array {
    uint32_t count;
    cgt_array array;
    double origin[3]; /* of doubles */
} point_array;

static const float *point_of(const judge_scene *s, const judge_geometry *g, uint32_t each, uint32_t i)
{
    return s->primitive[g->first + i / each].data + 3 * (i % each);
}

/* Whether all coordinates are what they were after adding an origin and subtracting it. */
static bool fits_origin(const judge_scene *s, const judge_geometry *g, uint32_t each, const double origin[3])
{
    for (uint32_t i = 0; i < g->count * each; i++)
        for (int a = 0; a < 3; a++) {
            const float x = point_of(s, g, each, i)[a];
            const volatile double given = (double)x + origin[a];
            const float read = (float)(given - origin[a]);
            if (isfinite(x) && memcmp(&read, &x, sizeof x) != 0) /* a zero may have lost its sign */
                return false;
        }
    return true;
}

static point_array make_points(driver_setup *setup, const judge_scene *s, const judge_geometry *g, uint32_t each,
                               const uint32_t *at, bool twice, test_random *r)
{
    static const double origins[][3] = {{0, 0, 0}, {12345, -777, 0x1p20}, {0.5, -0.25, 3}};
    const double *const origin = origins[random_below(r, 3)];
    const size_t size = twice ? sizeof(double) : sizeof(float);
    const size_t stride = size * (3 + random_below(r, 3));
    point_array p = {.count = g->count * each};
    char *const block = allocate_strided(setup, p.count, 3 * size, stride);
    const bool fits = twice && fits_origin(s, g, each, origin);
    for (int a = 0; a < 3; a++)
        p.origin[a] = fits ? origin[a] : 0;
    for (uint32_t i = 0; i < p.count; i++)
        for (int a = 0; a < 3; a++) {
            const float x = point_of(s, g, each, i)[a];
            const double far = fits ? (double)x + p.origin[a] : (double)x;
            char *const to = block + (at ? at[i] : i) * stride + (size_t)a * size;
            memcpy(to, twice ? (const void *)&far : (const void *)&x, size);
        }
    p.array = (cgt_array){block, stride, twice ? CGT_FORMAT_DOUBLE : CGT_FORMAT_FLOAT};
    return p;
}

static void shuffle(uint32_t *number, uint32_t count, test_random *r)
{
    for (uint32_t i = 0; i < count; i++)
        number[i] = i;
    for (uint32_t i = count; i > 1; i--) {
        const uint32_t k = random_below(r, i), last = number[i - 1];
        number[i - 1] = number[k];
        number[k] = last;
    }
}

/* Numbers of a format, in groups of `each` at a stride. */
static cgt_array make_numbers(driver_setup *setup, const uint32_t *number, uint32_t groups, uint32_t each,
                              cgt_format format, test_random *r)
{
    const size_t bytes = cgt_format_get_size(format), stride = bytes * (each + random_below(r, 3));
    char *const block = allocate_strided(setup, groups, each * bytes, stride);
    for (uint32_t i = 0; i < groups * each; i++) {
        const uint8_t byte = (uint8_t)number[i];
        const uint16_t half = (uint16_t)number[i];
        const uint64_t wide = number[i];
        const void *const from = bytes == 1   ? (const void *)&byte
                                 : bytes == 2 ? (const void *)&half
                                 : bytes == 4 ? (const void *)&number[i]
                                              : &wide;
        memcpy(block + i / each * stride + i % each * bytes, from, bytes);
    }
    return (cgt_array){block, stride, format};
}

/* ---- radii: of each primitive, in double, or by type ---- */

typedef struct radius_array {
    cgt_array radii, types;
    uint32_t type_count;
} radius_array;

static radius_array make_radii(driver_setup *setup, const judge_scene *s, const judge_geometry *g, test_random *r)
{
    const uint32_t form = random_below(r, 4);
    const bool twice = form == 1, types = form == 2 && g->count < 250;
    const size_t size = twice ? sizeof(double) : sizeof(float), stride = size * (1 + random_below(r, 3));
    uint32_t at[JUDGE_PRIMITIVES];
    radius_array a = {.type_count = types ? g->count : 0};
    char *const block = allocate_strided(setup, g->count, size, stride);
    shuffle(at, g->count, r);
    for (uint32_t i = 0; i < g->count; i++) {
        const float x = s->primitive[g->first + i].data[g->kind == ORACLE_SPHERE ? 3 : 6];
        const double far = (double)x;
        memcpy(block + (types ? at[i] : i) * stride, twice ? (const void *)&far : (const void *)&x, size);
    }
    a.radii = (cgt_array){block, stride, twice ? CGT_FORMAT_DOUBLE : CGT_FORMAT_FLOAT};
    if (types)
        a.types = make_numbers(setup, at, g->count, 1, (cgt_format)(CGT_FORMAT_UINT8 + random_below(r, 4)), r);
    return a;
}

/* ---- geometries ---- */

/* The id of a geometry that is there already, or that of the next one. */
static uint32_t *place_of(const driver_setup *setup, uint32_t *id)
{
    *id = *id < cgt_scene_get_geometries(setup->scene) ? *id : CGT_INVALID_ID;
    return id;
}

static void add_spheres(driver_setup *setup, const judge_scene *s, const judge_geometry *g, uint32_t id, test_random *r)
{
    const point_array p = make_points(setup, s, g, 1, NULL, random_below(r, 3) == 0, r);
    const radius_array a = make_radii(setup, s, g, r);
    cgt_spheres spheres = {.count = g->count,
                           .centers = p.array,
                           .radii = a.radii,
                           .types = a.types,
                           .type_count = a.type_count,
                           .mask = g->mask};
    memcpy(spheres.origin, p.origin, sizeof spheres.origin);
    must(cgt_scene_set_spheres(setup->scene, place_of(setup, &id), &spheres) == CGT_OK, "spheres", setup);
}

/* How vertices are named: in order, or by numbers. */
typedef struct vertex_order {
    uint32_t at[3 * JUDGE_PRIMITIVES];
    cgt_array indices;
} vertex_order;

static const uint32_t *make_order(driver_setup *setup, uint32_t primitives, uint32_t each, vertex_order *o,
                                  test_random *r)
{
    static const cgt_format formats[] = {CGT_FORMAT_UINT32, CGT_FORMAT_UINT32, CGT_FORMAT_UINT16, CGT_FORMAT_UINT64};
    o->indices = (cgt_array){0};
    if (random_below(r, 2))
        return NULL;
    shuffle(o->at, primitives * each, r);
    o->indices = make_numbers(setup, o->at, primitives, each, formats[random_below(r, 4)], r);
    return o->at;
}

static void add_triangles(driver_setup *setup, const judge_scene *s, const judge_geometry *g, uint32_t id,
                          test_random *r)
{
    static vertex_order o;
    const uint32_t *const at = make_order(setup, g->count, 3, &o, r);
    const point_array p = make_points(setup, s, g, 3, at, random_below(r, 3) == 0, r);
    cgt_triangles triangles = {
        .count = g->count, .indices = o.indices, .vertices = p.array, .vertex_count = p.count, .mask = g->mask};
    memcpy(triangles.origin, p.origin, sizeof triangles.origin);
    must(cgt_scene_set_triangles(setup->scene, place_of(setup, &id), &triangles) == CGT_OK, "triangles", setup);
}

/* By two arrays of points: all first ends, then all second ones, in one block. */
static void order_ends(uint32_t count, uint32_t *at)
{
    for (uint32_t i = 0; i < 2 * count; i++)
        at[i] = i / 2 + (i % 2 ? count : 0);
}

static void add_capsules(driver_setup *setup, const judge_scene *s, const judge_geometry *g, uint32_t id,
                         test_random *r)
{
    static vertex_order o;
    const uint32_t *at = make_order(setup, g->count, 2, &o, r);
    const bool by_ends = !at && random_below(r, 2);
    if (by_ends) {
        order_ends(g->count, o.at);
        at = o.at;
    }
    const point_array p = make_points(setup, s, g, 2, at, random_below(r, 3) == 0, r);
    const radius_array a = make_radii(setup, s, g, r);
    cgt_capsules capsules = {.count = g->count,
                             .indices = o.indices,
                             .vertices = p.array,
                             .vertex_count = by_ends ? g->count : p.count,
                             .radii = a.radii,
                             .types = a.types,
                             .type_count = a.type_count,
                             .mask = g->mask};
    if (by_ends)
        capsules.ends =
            (cgt_array){(const char *)p.array.data + g->count * p.array.stride, p.array.stride, p.array.format};
    memcpy(capsules.origin, p.origin, sizeof capsules.origin);
    must(cgt_scene_set_capsules(setup->scene, place_of(setup, &id), &capsules) == CGT_OK, "capsules", setup);
}

/* ---- setups ---- */

static cgt_context *make_context(const driver_setup *setup)
{
    const cgt_context_options options = {.variant = setup->variant, .tasks.run = run_backwards};
    cgt_context *context = NULL;
    if (setup->threads)
        return context_make(setup->threads, setup->variant);
    must(cgt_context_create(&options, &context) == CGT_OK, "context", setup);
    return context;
}

static cgt_context *context_of(driver_setup *setup, test_random *r)
{
    static const char *name[VARIANTS];
    static uint32_t variants;
    if (!variants)
        FOR_EACH_VARIANT(variant)
    name[variants++ % VARIANTS] = variant;
    if (!setup->number)
        setup->first_variant = random_below(r, variants);
    const uint32_t chosen = (setup->first_variant + setup->number) % variants;
    setup->variant = name[chosen];
    setup->threads = random_below(r, 2) ? random_below(r, THREADS + 1) : 1;
    cgt_context **const c = &contexts[chosen][setup->threads];
    if (!*c)
        *c = make_context(setup);
    return *c;
}

static bool holds(const test_way *way, const judge_scene *s) { return !way->papers || !s->of_kind[ORACLE_CAPSULE]; }

/* Unless the profile has a set, the first setup of each scene is AUTO, as half of the others are. */
static const test_way *way_of(const driver_run *run, test_random *r)
{
    const uint32_t turn = random_below(r, 1000);
    const bool chosen = !run->profile->ways && (!run->setup.number || random_below(r, 2));
    const unsigned set = chosen ? WAY_CHOSEN : run->profile->ways == DRIVER_ANY_WAY ? 0 : run->profile->ways;
    const test_way *const way = way_in_turn(set, turn);
    return holds(way, &run->scene) ? way
           : turn % 2              ? way_in_turn(WAY_TILES, turn)
                                   : way_in_turn(WAY_EACH | WAY_CLUSTERS, turn);
}

static void add_geometries(driver_setup *setup, const judge_scene *s, test_random *r)
{
    for (uint32_t k = 0; k < s->geometries; k++) {
        const judge_geometry *g = &s->geometry[k];
        switch (g->kind) {
        case ORACLE_SPHERE: add_spheres(setup, s, g, k, r); break;
        case ORACLE_TRIANGLE: add_triangles(setup, s, g, k, r); break;
        case ORACLE_CAPSULE: add_capsules(setup, s, g, k, r); break;
        }
    }
}

/* Commits other primitives under the same ids, with other masks: a later commit must not leave anything of them. */
static void load_others(driver_setup *setup, const judge_scene *s, test_random *r)
{
    static judge_scene others;
    others = *s;
    for (uint32_t k = 0; k < s->geometries; k++) {
        judge_geometry *const g = &others.geometry[k];
        g->mask = random_below(r, 4);
        g->count -= random_below(r, g->count + 1);
        for (uint32_t i = g->first; i < g->first + g->count; i++)
            for (int a = 0; a < 3 && !judge_is_broken(&s->primitive[i]); a++)
                others.primitive[i].data[a] = s->primitive[g->first].data[a];
    }
    add_geometries(setup, &others, r);
    must(cgt_scene_commit(setup->scene) == CGT_OK, "commit of others", setup);
}

/* Geometries without primitives may be removed: their ids name nothing then. */
static void remove_empty(driver_setup *setup, const judge_scene *s, test_random *r)
{
    for (uint32_t k = 0; k < s->geometries; k++)
        if (!s->geometry[k].count && random_below(r, 2))
            must(cgt_scene_remove_geometry(setup->scene, k) == CGT_OK, "remove", setup);
}

/* What the scene says about itself. */
static void check_load(driver_run *run)
{
    const judge_scene *const s = &run->scene;
    const test_way *const way = run->setup.way;
    cgt_scene_statistics st;
    uint32_t broken = 0;
    for (uint32_t i = 0; i < s->count; i++)
        broken += judge_is_broken(&s->primitive[i]);
    if (!driver_succeeds(run, cgt_scene_get_statistics(run->setup.scene, &st), "cgt_scene_get_statistics"))
        return;
    if (st.primitives != s->count || st.skipped_not_finite + st.skipped_radius != broken ||
        (!(way->serves & WAY_CHOSEN) && st.structure != way->scene.structure))
        driver_fail(run, NULL, "cgt_scene_get_statistics", "%llu primitives, %llu skipped, structure %d; %u, %u",
                    (unsigned long long)st.primitives, (unsigned long long)st.skipped_not_finite + st.skipped_radius,
                    (int)st.structure, (unsigned)s->count, (unsigned)broken);
}

static void count_load(driver_run *run)
{
    const cgt_scene *const scene = run->setup.scene;
    run->count[COUNT_LOADS]++;
    run->count[COUNT_BANDS] += scene->in_bands;
    run->count[COUNT_APART] += scene->in_bands && scene->bands->rest;
}

void driver_setup_make(driver_run *run)
{
    driver_setup *const setup = &run->setup;
    const judge_scene *const s = &run->scene;
    test_random *const r = &run->scene.random;
    setup->blocks = 0;
    setup->way = way_of(run, r);
    setup->context = context_of(setup, r);
    snprintf(setup->name, sizeof setup->name, "%s, %u threads%s, %s", setup->variant, (unsigned)setup->threads,
             setup->threads ? "" : " (tasks backwards)", setup->way->name);
    must(cgt_scene_create(setup->context, SCENE_OPTIONS(&setup->way->scene), &setup->scene) == CGT_OK, "scene", setup);
    const bool again = random_below(r, 3) == 0;
    if (again)
        load_others(setup, s, r);
    add_geometries(setup, s, r);
    remove_empty(setup, s, r);
    must(cgt_scene_commit(setup->scene) == CGT_OK, "commit", setup);
    if (random_below(r, 3) == 0)
        must(cgt_scene_prepare(setup->scene, CGT_RAY_KIND_INCOHERENT) == CGT_OK, "prepare", setup);
    run->count[COUNT_RELOADS] += again;
    count_load(run);
    check_load(run);
}

test_trace_options driver_options(driver_run *run, cgt_precision precision)
{
    test_random *const r = &run->scene.random;
    const test_way *const way = run->setup.way;
    test_trace_options o = {.precision = precision, .kd_traversal = way->traversal};
    if (way->papers || random_below(r, 4) == 0) {
        o.cull = (cgt_cull)random_below(r, 4);
        o.loop = (cgt_loop)random_below(r, 3);
        o.mailbox = (cgt_mailbox)random_below(r, 3);
        o.kd_traversal = way->traversal ? way->traversal : (cgt_kd_traversal)random_below(r, 3);
    }
    return o;
}

void driver_setup_free(driver_setup *setup)
{
    cgt_scene_release(setup->scene);
    while (setup->blocks)
        free(setup->block[--setup->blocks]);
}

void driver_contexts_free(void)
{
    for (uint32_t i = 0; i < VARIANTS * (THREADS + 1); i++)
        cgt_context_release(contexts[i / (THREADS + 1)][i % (THREADS + 1)]);
    memset(contexts, 0, sizeof contexts);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A scene in the library, by any structure, variant and number of threads, from arrays of any form. */
#include <float.h>
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

/* Elements of `size` bytes at a stride, which one in four arrays has where nothing is aligned; what lies between is
 * odd. */
static char *allocate_strided(driver_setup *setup, uint32_t count, size_t size, size_t *stride, test_random *r)
{
    const size_t odd = random_below(r, 4) ? 0 : 1 + random_below(r, 3);
    *stride += odd;
    const size_t bytes = odd + (count ? (count - 1) * *stride + size : 0);
    return (char *)memset(allocate(setup, bytes), 0xff, bytes) + odd;
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
    size_t stride = size * (3 + random_below(r, 3));
    point_array p = {.count = g->count * each};
    char *const block = allocate_strided(setup, p.count, 3 * size, &stride, r);
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

static void store_number(char *at, size_t bytes, uint64_t number)
{
    const uint8_t byte = (uint8_t)number;
    const uint16_t half = (uint16_t)number;
    const uint32_t word = (uint32_t)number;
    const void *const from = bytes == 1   ? (const void *)&byte
                             : bytes == 2 ? (const void *)&half
                             : bytes == 4 ? (const void *)&word
                                          : &number;
    memcpy(at, from, bytes);
}

/* Types, or indices of vertices, `each` of them a primitive, in a format; all of them name something. */
static cgt_array make_numbers(driver_setup *setup, const uint32_t *number, uint32_t groups, uint32_t each,
                              cgt_format format, test_random *r)
{
    const size_t bytes = cgt_format_get_size(format);
    size_t stride = bytes * (each + random_below(r, 3));
    char *const block = allocate_strided(setup, groups, each * bytes, &stride, r);
    for (uint32_t i = 0; i < groups * each; i++)
        store_number(block + i / each * stride + i % each * bytes, bytes, number[i]);
    if (groups && random_below(r, 2)) {
        const uint32_t i = random_below(r, groups);
        setup->named = (driver_number){.at = block + i * stride + random_below(r, each) * bytes,
                                       .bytes = bytes,
                                       .below = groups * each,
                                       .primitive = i,
                                       .what = each == 1 ? "type" : "index"};
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
    const size_t size = twice ? sizeof(double) : sizeof(float);
    size_t stride = size * (1 + random_below(r, 3));
    uint32_t at[JUDGE_PRIMITIVES];
    radius_array a = {.type_count = types ? g->count : 0};
    char *const block = allocate_strided(setup, g->count, size, &stride, r);
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

/* ---- what is refused ---- */

/* A number that names nothing: of 64 bits, its lower half names something. */
static uint64_t odd_number(const driver_number *n, test_random *r)
{
    const uint64_t most = UINT64_MAX >> (64 - 8 * n->bytes);
    if (n->bytes == 8 && random_below(r, 2))
        return ((uint64_t)1 << 32) + random_below(r, n->below);
    return random_below(r, 2) ? most : n->below;
}

/* A commit with such a number is refused by a sentence that names it, and the scene is mended then. */
static void refuse(driver_run *run)
{
    driver_setup *const setup = &run->setup;
    const driver_number n = setup->named;
    char before[8], text[96];
    if (!n.at || random_below(&run->scene.random, 3))
        return;
    const uint64_t odd = odd_number(&n, &run->scene.random);
    if (odd < n.below || odd > UINT64_MAX >> (64 - 8 * n.bytes)) /* any number of so few bits may name something */
        return;
    memcpy(before, n.at, n.bytes);
    store_number(n.at, n.bytes, odd);
    snprintf(text, sizeof text, " %u has %s %llu, but there are %u ", (unsigned)n.primitive, n.what,
             (unsigned long long)odd, (unsigned)n.below);
    run->count[COUNT_REFUSED]++;
    if (cgt_scene_commit(setup->scene) != CGT_ERROR_INVALID_ARGUMENT || !strstr(context_message(setup->context), text))
        driver_fail(run, NULL, "cgt_scene_commit", "the message \"%s\" has no \"%s\"", context_message(setup->context),
                    text);
    memcpy(n.at, before, n.bytes);
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

/* Whether a triangle has an area beyond doubt. */
static bool has_area(const float v[9])
{
    truth_real e[2][3];
    bool has = false;
    for (int a = 0; a < 3; a++)
        for (int k = 0; k < 2; k++)
            e[k][a] = (truth_real)v[3 * k + 3 + a] - (truth_real)v[a];
    for (int a = 0; a < 3; a++) {
        const truth_real x = e[0][a] * e[1][(a + 1) % 3], y = e[0][(a + 1) % 3] * e[1][a], off = x - y;
        has |= (off < 0 ? -off : off) > 0x1p-60 * ((x < 0 ? -x : x) + (y < 0 ? -y : y));
    }
    return has;
}

static void widen(const oracle_primitive *p, int a, double ends[2])
{
    const double r = p->kind == ORACLE_TRIANGLE ? 0 : (double)p->data[p->kind == ORACLE_SPHERE ? 3 : 6];
    const int points = p->kind == ORACLE_SPHERE ? 1 : p->kind == ORACLE_CAPSULE ? 2 : 3;
    for (int k = 0; k < points; k++) {
        ends[0] = fmin(ends[0], (double)p->data[3 * k + a] - r);
        ends[1] = fmax(ends[1], (double)p->data[3 * k + a] + r);
    }
}

/* Around all that is hit, and no farther than rounding takes them, which may be infinity; triangles of little area may
 * be skipped. */
static bool are_bounds(const judge_scene *s, const cgt_scene_statistics *st)
{
    bool good = true;
    for (int a = 0; a < 3; a++) {
        double sure[2] = {INFINITY, -INFINITY}, most[2] = {INFINITY, -INFINITY};
        for (uint32_t i = 0; i < s->count; i++) {
            const oracle_primitive *const p = &s->primitive[i];
            if (judge_is_broken(p))
                continue;
            widen(p, a, most);
            if (p->kind != ORACLE_TRIANGLE || has_area(p->data))
                widen(p, a, sure);
        }
        const double low = (double)st->bounds_min[a], high = (double)st->bounds_max[a],
                     slack = 0x1p-21 * fmax(fabs(most[0]), fabs(most[1])) + 0x1p-148;
        const double least = most[0] - slack < -FLT_MAX ? -INFINITY : most[0] - slack,
                     greatest = most[1] + slack > FLT_MAX ? INFINITY : most[1] + slack;
        if (sure[0] <= sure[1])
            good &= low <= sure[0] && high >= sure[1] && low >= least && high <= greatest;
        else if (most[0] > most[1])
            good &= low == 0 && high == 0;
    }
    return good;
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
    if (!are_bounds(s, &st))
        driver_fail(run, NULL, "cgt_scene_get_statistics", "the bounds are %a %a %a, %a %a %a",
                    (double)st.bounds_min[0], (double)st.bounds_min[1], (double)st.bounds_min[2],
                    (double)st.bounds_max[0], (double)st.bounds_max[1], (double)st.bounds_max[2]);
}

static void count_load(driver_run *run)
{
    const cgt_scene *const scene = run->setup.scene;
    run->count[COUNT_LOADS]++;
    run->count[COUNT_BANDS] += scene->in_bands;
    run->count[COUNT_CLUSTERS] += scene->committed_scene.cluster != NULL;
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
    setup->named = (driver_number){0};
    add_geometries(setup, s, r);
    remove_empty(setup, s, r);
    refuse(run);
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

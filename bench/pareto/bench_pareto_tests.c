/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The tests of FAST precision alone, in every variant, and once more in the SPU's own arithmetic, for which there is no
 * whole frame: nanoseconds a test, and errors beside exact arithmetic on the same float input. */
#include "pareto/bench_pareto.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_random.h"
#include "common/bench_timing.h"
#include "exact/integer/exact.h"

enum { CASES = 128, PRIMITIVES = 64, SAMPLES = 15, EDGE = 16 };

typedef struct kernel_row {
    const char *variant; /* that the CPU has to run */
    const char *name;
    int spu;
    pareto_kernel *run;
} kernel_row;

/* The rows of this build, narrowest first; the SPU's arithmetic goes with one row of four lanes. */
#define JOIN_(name, variant) name##variant
#define JOIN(name, variant) JOIN_(name, variant)
#define TEXT_(name) #name
#define TEXT(name) TEXT_(name)
#define SPU_KERNEL JOIN(JOIN(bench_pareto_kernel_, CGT_BENCH_SPU_ROW), _spu)
pareto_kernel bench_pareto_kernel_portable, bench_pareto_kernel_sse, bench_pareto_kernel_neon, bench_pareto_kernel_avx2,
    bench_pareto_kernel_avx512, SPU_KERNEL;
static const kernel_row kernels[] = {
#ifdef CGT_HAVE_PORTABLE
    {"portable", "portable", 0, bench_pareto_kernel_portable},
#endif
#ifdef CGT_HAVE_SSE
    {"sse", "sse", 0, bench_pareto_kernel_sse},
#endif
#ifdef CGT_HAVE_NEON
    {"neon", "neon", 0, bench_pareto_kernel_neon},
#endif
#ifdef CGT_HAVE_AVX2
    {"avx2", "avx2", 0, bench_pareto_kernel_avx2},
#endif
#ifdef CGT_HAVE_AVX512
    {"avx512", "avx512", 0, bench_pareto_kernel_avx512},
#endif
    {TEXT(CGT_BENCH_SPU_ROW), "SPU arithmetic, " TEXT(CGT_BENCH_SPU_ROW), 1, SPU_KERNEL},
};
enum { KERNELS = sizeof kernels / sizeof kernels[0] };

const char *pareto_test_name(pareto_test test)
{
    static const char *const names[PARETO_TESTS] = {"sphere", "watertight", "moller-trumbore", "accelerated"};
    return names[test];
}

/* ---- Cases --------------------------------------------------------------------------------------------------- */

/* A packet as a camera has it, and primitives in its way: in size from a tenth of its breadth to twice that. */
typedef struct test_case {
    float org[3];
    float dir[PARETO_RAYS][3];
    float sphere[PRIMITIVES][9], triangle[PRIMITIVES][9];
    float truth[2][PRIMITIVES][PARETO_RAYS]; /* t of spheres, of triangles; +infinity: a miss */
} test_case;

static float uniform(uint64_t *state, float low, float high) { return low + (high - low) * bench_random(state); }

static void make_rays(test_case *c, uint64_t *state)
{
    const float step = 0.002f; /* of a picture of some thousand pixels */
    float forward[3], right[3], up[3];
    for (int a = 0; a < 3; a++) {
        c->org[a] = uniform(state, -2.0f, 2.0f);
        forward[a] = uniform(state, -1.0f, 1.0f);
        right[a] = uniform(state, -1.0f, 1.0f);
    }
    forward[0] += forward[0] < 0.0f ? -0.5f : 0.5f;
    for (int a = 0; a < 3; a++)
        up[a] = forward[(a + 1) % 3] * right[(a + 2) % 3] - forward[(a + 2) % 3] * right[(a + 1) % 3];
    for (int i = 0; i < PARETO_RAYS; i++) {
        const int column = i % EDGE, row = i / EDGE;
        for (int a = 0; a < 3; a++)
            c->dir[i][a] = forward[a] + step * ((float)column * right[a] + (float)row * up[a]);
    }
}

static void make_primitives(test_case *c, uint64_t *state)
{
    for (int k = 0; k < PRIMITIVES; k++) {
        const float *d = c->dir[(int)(bench_random(state) * (float)PARETO_RAYS)];
        const float t = uniform(state, 1.0f, 8.0f), size = t * uniform(state, 0.003f, 0.06f);
        for (int a = 0; a < 3; a++) {
            const float at = c->org[a] + t * d[a];
            c->sphere[k][a] = at + uniform(state, -size, size);
            for (int vertex = 0; vertex < 3; vertex++)
                c->triangle[k][3 * vertex + a] = at + uniform(state, -size, size);
        }
        c->sphere[k][3] = 0.8f * size;
    }
}

/* t of the exact hit, rounded; +infinity for a miss, and for what lies behind the origin. None is around it. */
static float exact_t(const cgt_exact_ray *ray, const cgt_primitive *primitive)
{
    const cgt_exact_root root = {.primitive = primitive};
    const int hit = primitive->kind == CGT_KIND_SPHERES ? cgt_exact_line_hits_sphere(ray, primitive->sphere)
                                                        : cgt_exact_line_hits_triangle(ray, &primitive->triangle);
    const double t = hit ? cgt_exact_t(ray, &root) : INFINITY;
    return t >= 0.0 ? (float)t : INFINITY;
}

static void find_truth(test_case *c)
{
    for (int k = 0; k < PRIMITIVES; k++) {
        const float *s = c->sphere[k];
        const cgt_primitive sphere = {.kind = CGT_KIND_SPHERES, .sphere = {s[0], s[1], s[2], s[3]}};
        cgt_primitive triangle = {.kind = CGT_KIND_TRIANGLES};
        memcpy(triangle.triangle.v, c->triangle[k], sizeof triangle.triangle.v);
        for (int i = 0; i < PARETO_RAYS; i++) {
            cgt_exact_ray ray;
            memcpy(ray.org, c->org, sizeof ray.org);
            memcpy(ray.dir, c->dir[i], sizeof ray.dir);
            c->truth[0][k][i] = exact_t(&ray, &sphere);
            c->truth[1][k][i] = exact_t(&ray, &triangle);
        }
    }
}

/* ---- Measuring ----------------------------------------------------------------------------------------------- */

static pareto_work work_of(const test_case *c, pareto_test test, float *t)
{
    pareto_work work = {.test = test, .dir = c->dir, .primitives = PRIMITIVES, .t = t};
    memcpy(work.org, c->org, sizeof work.org);
    work.primitive = test == PARETO_SPHERE ? c->sphere : c->triangle;
    return work;
}

static void add_errors(pareto_error *error, const test_case *c, pareto_test test, const float *t)
{
    const float *truth = &c->truth[test == PARETO_SPHERE ? 0 : 1][0][0];
    for (size_t i = 0; i < (size_t)PRIMITIVES * PARETO_RAYS; i++)
        pareto_error_ray(error, truth[i] < INFINITY, t[i] < INFINITY, 1, truth[i], t[i]);
}

/* First quartile of samples of some milliseconds: what disturbs a shared machine only adds time. */
static double time_kernel(pareto_kernel *run, const pareto_work *work)
{
    double ns[SAMPLES], spent = 0.0;
    uint32_t passes = 1;
    for (;; passes *= 2) {
        const double start = bench_now_ms();
        for (uint32_t i = 0; i < passes; i++)
            run(work);
        spent = bench_now_ms() - start;
        if (spent > 1.0 || passes >= 1u << 20)
            break;
    }
    for (int k = 0; k < SAMPLES; k++) {
        const double start = bench_now_ms();
        for (uint32_t i = 0; i < passes; i++)
            run(work);
        ns[k] = (bench_now_ms() - start) * 1e6 / ((double)passes * PRIMITIVES * PARETO_RAYS);
    }
    return bench_spread_of(ns, SAMPLES).low;
}

/* Whether the CPU runs a variant, and the command line wants it. */
static int wanted(const bench_settings *settings, const kernel_row *kernel)
{
    cgt_context *context = NULL;
    if (settings->variant && strcmp(settings->variant, kernel->variant) != 0)
        return 0;
    const cgt_result result = bench_context_create(1, kernel->variant, &context);
    cgt_context_release(context);
    return result == CGT_OK;
}

static void add_rows(pareto_tests *tests, const bench_settings *settings, const test_case *first)
{
    for (size_t k = 0; k < KERNELS; k++)
        for (int test = 0; test < PARETO_TESTS && wanted(settings, &kernels[k]); test++) {
            pareto_test_row *row = &tests->rows[tests->count++];
            const pareto_work work = work_of(first, (pareto_test)test, tests->t);
            row->test = (pareto_test)test;
            row->variant = kernels[k].variant;
            row->name = kernels[k].name;
            row->spu = kernels[k].spu;
            row->run = kernels[k].run;
            row->ns = time_kernel(row->run, &work);
        }
}

int pareto_measure_tests(pareto_tests *tests, const bench_settings *settings)
{
    uint64_t state = bench_random_start;
    test_case *c = malloc(sizeof *c);
    tests->rows = calloc(KERNELS * PARETO_TESTS, sizeof *tests->rows);
    tests->t = aligned_alloc(64, sizeof(float) * PRIMITIVES * PARETO_RAYS);
    if (!c || !tests->rows || !tests->t) {
        free(c);
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    for (int k = 0; k < CASES; k++) {
        make_rays(c, &state);
        make_primitives(c, &state);
        find_truth(c);
        if (k == 0)
            add_rows(tests, settings, c);
        for (size_t i = 0; i < tests->count; i++) {
            const pareto_work work = work_of(c, tests->rows[i].test, tests->t);
            tests->rows[i].run(&work);
            add_errors(&tests->rows[i].error, c, tests->rows[i].test, tests->t);
        }
    }
    free(c);
    return PROGRAM_OK;
}

void pareto_tests_release(pareto_tests *tests)
{
    free(tests->rows);
    free(tests->t);
    memset(tests, 0, sizeof *tests);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The bare intersection tests of FAST, without a structure, in every variant, and once more in the SPU's arithmetic,
 * which renders no whole frame: nanoseconds per test, and errors relative to exact arithmetic on the same float
 * input. */
#include "accuracy/bench_accuracy.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accuracy/accuracy_error.h"
#include "accuracy/accuracy_kernel.h"
#include "common/bench_random.h"
#include "common/bench_timing.h"
#include "exact/integer/exact.h"

enum { CASES = 128, PRIMITIVES = 64, SAMPLES = 15, EDGE = 16 };

typedef struct kernel_row {
    const char *variant; /* which the CPU has to run */
    int spu;             /* 1: in the SPU's arithmetic */
    accuracy_kernel *run;
} kernel_row;

/* The variants of this build, narrowest first. The SPU's arithmetic uses one variant of four lanes. */
#define JOIN_(name, variant) name##variant
#define JOIN(name, variant) JOIN_(name, variant)
#define TEXT_(name) #name
#define TEXT(name) TEXT_(name)
#define SPU_KERNEL JOIN(JOIN(accuracy_kernel_, CGT_BENCH_SPU_ROW), _spu)
accuracy_kernel accuracy_kernel_portable, accuracy_kernel_sse, accuracy_kernel_neon, accuracy_kernel_avx2,
    accuracy_kernel_avx512, SPU_KERNEL;
static const kernel_row kernels[] = {
#ifdef CGT_HAVE_PORTABLE
    {"portable", 0, accuracy_kernel_portable},
#endif
#ifdef CGT_HAVE_SSE
    {"sse", 0, accuracy_kernel_sse},
#endif
#ifdef CGT_HAVE_NEON
    {"neon", 0, accuracy_kernel_neon},
#endif
#ifdef CGT_HAVE_AVX2
    {"avx2", 0, accuracy_kernel_avx2},
#endif
#ifdef CGT_HAVE_AVX512
    {"avx512", 0, accuracy_kernel_avx512},
#endif
    {TEXT(CGT_BENCH_SPU_ROW), 1, SPU_KERNEL},
};
enum { KERNELS = sizeof kernels / sizeof kernels[0] };

static const char *const test_names[ACCURACY_TESTS] = {"sphere", "watertight", "moller-trumbore", "accelerated"};

/* ---- Cases --------------------------------------------------------------------------------------------------- */

/* A packet of camera rays, and primitives in its path: from a tenth of the packet's width to twice that. */
typedef struct test_case {
    float org[3];
    float dir[ACCURACY_RAYS][3];
    float sphere[PRIMITIVES][9], triangle[PRIMITIVES][9];
    float truth[2][PRIMITIVES][ACCURACY_RAYS]; /* t of spheres, of triangles; +infinity: a miss */
} test_case;

static float uniform(uint64_t *state, float low, float high) { return low + (high - low) * bench_random(state); }

static void make_rays(test_case *c, uint64_t *state)
{
    const float step = 0.002f; /* of a picture of about a thousand pixels */
    float forward[3], right[3], up[3];
    for (int a = 0; a < 3; a++) {
        c->org[a] = uniform(state, -2.0f, 2.0f);
        forward[a] = uniform(state, -1.0f, 1.0f);
        right[a] = uniform(state, -1.0f, 1.0f);
    }
    forward[0] += forward[0] < 0.0f ? -0.5f : 0.5f;
    for (int a = 0; a < 3; a++)
        up[a] = forward[(a + 1) % 3] * right[(a + 2) % 3] - forward[(a + 2) % 3] * right[(a + 1) % 3];
    for (int i = 0; i < ACCURACY_RAYS; i++) {
        const int column = i % EDGE, row = i / EDGE;
        for (int a = 0; a < 3; a++)
            c->dir[i][a] = forward[a] + step * ((float)column * right[a] + (float)row * up[a]);
    }
}

static void make_primitives(test_case *c, uint64_t *state)
{
    for (int k = 0; k < PRIMITIVES; k++) {
        const float *d = c->dir[(int)(bench_random(state) * (float)ACCURACY_RAYS)];
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

/* t of the exact hit, rounded; +infinity for a miss and for primitives behind the origin. No primitive contains the
 * origin. */
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
        for (int i = 0; i < ACCURACY_RAYS; i++) {
            cgt_exact_ray ray;
            memcpy(ray.org, c->org, sizeof ray.org);
            memcpy(ray.dir, c->dir[i], sizeof ray.dir);
            c->truth[0][k][i] = exact_t(&ray, &sphere);
            c->truth[1][k][i] = exact_t(&ray, &triangle);
        }
    }
}

/* ---- Measuring ----------------------------------------------------------------------------------------------- */

/* One test by one kernel. */
typedef struct test_row {
    const kernel_row *kernel;
    accuracy_test test;
    double ns; /* of a ray against a primitive, including what is computed once for 256 rays */
    accuracy_error error;
} test_row;

typedef struct tests_job {
    test_row rows[KERNELS * ACCURACY_TESTS];
    size_t count;
    test_case current;
    float *t; /* a kernel's results */
} tests_job;

static accuracy_work work_of(const test_case *c, accuracy_test test, float *t)
{
    accuracy_work work = {.test = test, .dir = c->dir, .primitives = PRIMITIVES, .t = t};
    memcpy(work.org, c->org, sizeof work.org);
    work.primitive = test == ACCURACY_SPHERE ? c->sphere : c->triangle;
    return work;
}

static void add_errors(accuracy_error *error, const test_case *c, accuracy_test test, const float *t)
{
    const float *truth = &c->truth[test == ACCURACY_SPHERE ? 0 : 1][0][0];
    for (size_t i = 0; i < (size_t)PRIMITIVES * ACCURACY_RAYS; i++)
        accuracy_error_ray(error, truth[i] < INFINITY, t[i] < INFINITY, 1, truth[i], t[i]);
}

/* First quartile of samples of about a millisecond: disturbances on a shared machine only add time. */
static double time_kernel(accuracy_kernel *run, const accuracy_work *work)
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
        ns[k] = (bench_now_ms() - start) * 1e6 / ((double)passes * PRIMITIVES * ACCURACY_RAYS);
    }
    return bench_spread_of(ns, SAMPLES).low;
}

static int is_wanted(const accuracy_job *job, const kernel_row *kernel)
{
    for (size_t v = 0; v < job->variants; v++)
        if (!strcmp(job->variant[v], kernel->variant))
            return 1;
    return 0;
}

/* The rows of all requested tests and kernels, timed on the current case. */
static void add_rows(tests_job *job, const accuracy_job *accuracy)
{
    for (size_t k = 0; k < KERNELS; k++)
        for (int test = 0; test < ACCURACY_TESTS && is_wanted(accuracy, &kernels[k]); test++) {
            const accuracy_work work = work_of(&job->current, (accuracy_test)test, job->t);
            job->rows[job->count++] = (test_row){
                .kernel = &kernels[k], .test = (accuracy_test)test, .ns = time_kernel(kernels[k].run, &work)};
        }
}

/* Times every row on the first case, and adds up its errors over all cases. */
static void measure(tests_job *job, const accuracy_job *accuracy)
{
    uint64_t state = bench_random_start;
    for (int k = 0; k < CASES; k++) {
        make_rays(&job->current, &state);
        make_primitives(&job->current, &state);
        find_truth(&job->current);
        if (k == 0)
            add_rows(job, accuracy);
        for (size_t i = 0; i < job->count; i++) {
            const accuracy_work work = work_of(&job->current, job->rows[i].test, job->t);
            job->rows[i].kernel->run(&work);
            add_errors(&job->rows[i].error, &job->current, job->rows[i].test, job->t);
        }
    }
}

static void write_row(const test_row *row, bench_table *table)
{
    const char *arithmetic = row->kernel->spu ? "spu" : "ieee", *test = test_names[row->test];
    char config[BENCH_NAME_SIZE];
    snprintf(config, sizeof config, "test=%s,variant=%s,precision=fast,arithmetic=%s", test, row->kernel->variant,
             arithmetic);
    bench_table_text(table, "config", config);
    bench_table_text(table, "test", test);
    bench_table_text(table, "variant", row->kernel->variant);
    bench_table_text(table, "arithmetic", arithmetic);
    bench_table_real(table, "ns_per_test", row->ns);
    accuracy_error_cells(&row->error, table);
    bench_table_end_row(table);
}

int accuracy_tests(const accuracy_job *accuracy)
{
    tests_job *job = calloc(1, sizeof *job);
    float *t = aligned_alloc(64, sizeof(float) * PRIMITIVES * ACCURACY_RAYS);
    const int complete = job && t;
    if (complete) {
        job->t = t;
        measure(job, accuracy);
        bench_table_section(accuracy->table, "tests");
        for (size_t i = 0; i < job->count; i++)
            write_row(&job->rows[i], accuracy->table);
    } else
        program_error("out of memory");
    free(t);
    free(job);
    return complete ? PROGRAM_OK : PROGRAM_FAILED;
}

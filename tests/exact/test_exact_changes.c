/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Transformations that must not affect the exact stage: scale, position, axes, signs, the order of vertices, and a
 * processor mode that flushes denormals. */
#include "support/test.h"

#include <math.h>
#include <string.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "exact/exact_cases.h"

/* ---- Scale, place, axes, vertices ------------------------------------------------------------------------------- */

static float scaled(float f, int power)
{
    const float g = ldexpf(f, power);
    assert_true(isfinite(g) && ldexpf(g, -power) == f);
    return g;
}

typedef struct change {
    int length, direction; /* powers of two */
    int axis, flip;        /* component i comes from axis + i, those of the mask change sign */
    float by[3];
    int turn; /* of the vertices */
} change;

static void change_vector(const change *h, const float in[3], float out[3], bool position)
{
    for (int i = 0; i < 3; i++) {
        const int a = (i + h->axis) % 3;
        const float f = position ? in[a] + h->by[a] : in[a];
        out[i] = scaled(h->flip >> a & 1 ? -f : f, position ? h->length : h->direction);
    }
}

static exact_case changed(const exact_case *in, const change *h)
{
    exact_case out = *in;
    change_vector(h, in->ray.org, out.ray.org, true);
    change_vector(h, in->ray.dir, out.ray.dir, false);
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++)
            change_vector(h, in->primitive[i].triangle.v[(k + h->turn) % 3], out.primitive[i].triangle.v[k], true);
        const cgt_sphere *q = &in->primitive[i + 2].sphere;
        float at[3];
        change_vector(h, (const float[3]){q->x, q->y, q->z}, at, true);
        out.primitive[i + 2].sphere = (cgt_sphere){at[0], at[1], at[2], scaled(q->r, h->length)};
    }
    return out;
}

/* All results of the stage for a case, with t mapped back to the untransformed case. No padding: results are compared
 * as bytes. */
typedef struct answers {
    double t[4];
    int order[4][4];
    int meets[4];
} answers;

static answers ask(const exact_case *c, const change *h)
{
    answers a;
    memset(&a, 0, sizeof a);
    cgt_exact_root root[4];
    for (int i = 0; i < 4; i++) {
        root[i] = (cgt_exact_root){&c->primitive[i], i == 3};
        a.meets[i] = exact_meets(&c->ray, &c->primitive[i]);
    }
    for (int i = 0; i < 4; i++) {
        a.t[i] = a.meets[i] ? ldexp(cgt_exact_t(&c->ray, &root[i]), h->direction - h->length) : 0;
        for (int j = 0; j < 4; j++)
            if (a.meets[i] && a.meets[j])
                a.order[i][j] = cgt_exact_compare(&c->ray, &root[i], &root[j]);
    }
    return a;
}

static bool are_quarters(const float *f, int count)
{
    for (int i = 0; i < count; i++)
        if (fmodf(f[i], 0.25f) != 0)
            return false;
    return true;
}

/* Multiples of a quarter up to 16 stay exact in float when multiplied by 2^-147 to 2^123. */
static void no_change_matters(void **state)
{
    (void)state;
    test_random r = random_make(3);
    uint64_t hits = 0, denormal = 0;
    const change none = {.length = 0};
    for (uint32_t round = 0; round < 50 + test_scaled(2000); round++) {
        const exact_case c = exact_case_make(&r, EXACT_GRID);
        change h = {.length = (int)random_below(&r, 271) - 147,
                    .direction = (int)random_below(&r, 271) - 147,
                    .axis = (int)random_below(&r, 3),
                    .flip = (int)random_below(&r, 8),
                    .turn = (int)random_below(&r, 3)};
        for (int a = 0; a < 3; a++)
            h.by[a] = (float)random_below(&r, 33) / 4 - 4;
        /* computed values have more digits */
        if (!are_quarters(&c.primitive[2].sphere.r, 1) || !are_quarters(&c.primitive[3].sphere.r, 1))
            h.length = (int)random_below(&r, 100);
        if (!are_quarters(c.ray.dir, 3))
            h.direction = (int)random_below(&r, 100);
        const exact_case d = changed(&c, &h);
        const answers before = ask(&c, &none), after = ask(&d, &h);
        assert_memory_equal(&before, &after, sizeof before);
        for (int i = 0; i < 4; i++)
            hits += before.meets[i] != 0;
        denormal += h.length < -130 || h.direction < -130;
    }
    assert_true(hits > 20 && denormal > 0);
}

/* ---- Denormals flushed by the processor ---- */

#if defined(__x86_64__)
#define CAN_FLUSH 1
typedef unsigned int flush_mode;
static flush_mode flush_on(void)
{
    const flush_mode before = _mm_getcsr();
    _mm_setcsr(before | 0x8040); /* flush-to-zero and denormals-are-zero */
    return before;
}
static void flush_back(flush_mode before) { _mm_setcsr(before); }
#elif defined(__aarch64__)
#define CAN_FLUSH 1
typedef uint64_t flush_mode;
static flush_mode flush_on(void)
{
    flush_mode before;
    __asm__ volatile("mrs %0, fpcr" : "=r"(before) : : "memory");
    __asm__ volatile("msr fpcr, %0" : : "r"(before | UINT64_C(1) << 24) : "memory");
    return before;
}
static void flush_back(flush_mode before) { __asm__ volatile("msr fpcr, %0" : : "r"(before) : "memory"); }
#else
#define CAN_FLUSH 0
typedef int flush_mode;
static flush_mode flush_on(void) { return 0; }
static void flush_back(flush_mode before) { (void)before; }
#endif

static void flushing_changes_nothing(void **state)
{
    (void)state;
    if (!CAN_FLUSH)
        skip();
    test_random r = random_make(4);
    const change none = {.length = 0};
    uint64_t hits = 0;
    for (uint32_t round = 0; round < 50 + test_scaled(500); round++) {
        const exact_case c = exact_case_make(&r, EXACT_DENORMAL);
        const answers before = ask(&c, &none);
        const flush_mode mode = flush_on();
        const volatile float smallest = 0x1p-149f;
        volatile float twice = smallest + smallest; /* the stores keep the computation inside this mode */
        const answers flushed = ask(&c, &none);
        flush_back(mode);
        assert_true(twice == 0);
        assert_memory_equal(&before, &flushed, sizeof before);
        for (int i = 0; i < 4; i++)
            hits += before.meets[i] != 0;
    }
    assert_true(hits > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_change_matters),
        cmocka_unit_test(flushing_changes_nothing),
    };
    test_begin("test_exact_changes");
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The exact stage on random rays and primitives of many families. Its tiers agree bit for bit; all agree with the
 * oracle, which shares no code with it; and the order of hits is consistent. */
#include "support/oracle/oracle_line.h"
#include "support/suite.h"
#include "support/test.h"

#include <float.h>
#include <string.h>

#include "exact/exact_builds.h"
#include "exact/exact_cases.h"
#include "trace/bounce/surface.h"

#if defined(__x86_64__) && defined(__SIZEOF_FLOAT128__) || LDBL_MANT_DIG == 113
#define BINARY128 1 /* truth_real has 113 bits and an exponent that holds all that floats give */
#else
#define BINARY128 0
#endif

enum { MAX_ROOTS = 10 };

static const exact_build *const others[] = {&exact_counted, &exact_wide, &exact_halves};

/* What the cases of a family contained: shows that a test met the situations it is about. */
typedef struct tally {
    uint64_t cases, triangle_hits, sphere_hits, tangents, on_edge;
    uint64_t capsule_hits, sides;
    /* pairs[0]: triangles, [1]: mixed, [2]: spheres, [3]: with cylinders; surely: decided by binary128 as well */
    uint64_t pairs[4], equal, surely;
} tally;

/* The roots of a case's primitives, by the exact stage and by the oracle. */
typedef struct roots {
    int count;
    cgt_primitive ends[4]; /* the spheres of capsules' ends */
    cgt_exact_root root[MAX_ROOTS];
    oracle_root truth[MAX_ROOTS];
    double t[MAX_ROOTS];
    int order[MAX_ROOTS][MAX_ROOTS];
} roots;

static bool same_double(double a, double b) { return memcmp(&a, &b, sizeof a) == 0; }

static bool within(truth_real exact, double got, truth_real part)
{
    const truth_real size = exact < 0 ? -exact : exact, off = exact < got ? got - exact : exact - got;
    return off <= size * part;
}

static truth_ray whole_line(const cgt_exact_ray *ray)
{
    truth_ray line = {.t_min = 0, .t_max = 1};
    memcpy(line.org, ray->org, sizeof line.org);
    memcpy(line.dir, ray->dir, sizeof line.dir);
    return line;
}

static oracle_primitive as_oracle(const cgt_primitive *shape)
{
    oracle_primitive p = {.kind = shape->kind == CGT_KIND_SPHERES    ? ORACLE_SPHERE
                                  : shape->kind == CGT_KIND_CAPSULES ? ORACLE_CAPSULE
                                                                     : ORACLE_TRIANGLE};
    memcpy(p.data, &shape->triangle, (size_t)oracle_floats(p.kind) * sizeof *p.data);
    return p;
}

static bool meets(const exact_build *build, const cgt_exact_ray *ray, const cgt_primitive *shape)
{
    cgt_capsule_part part[2];
    return shape->kind == CGT_KIND_SPHERES    ? build->sphere_roots(ray, shape->sphere) > 0
           : shape->kind == CGT_KIND_CAPSULES ? build->capsule_roots(ray, &shape->capsule, part) > 0
                                              : build->line_meets_triangle(ray, &shape->triangle);
}

/* ---- Values ---- */

static void check_normal(const cgt_triangle *triangle, const truth_real exact[3])
{
    double n[3];
    cgt_exact_normal(triangle, n);
    const truth_real length =
        truth_square_root((truth_real)n[0] * n[0] + (truth_real)n[1] * n[1] + (truth_real)n[2] * n[2]);
    double largest = 0;
    for (int a = 0; a < 3; a++) {
        largest = largest < n[a] ? n[a] : largest < -n[a] ? -n[a] : largest;
        assert_true(within(exact[a] * length, n[a], 0x1p-51)); /* 2^-52 relative for n and for its length */
        assert_true((exact[a] == 0) == (n[a] == 0));
    }
    assert_true(largest >= 0.5 && largest <= 4);
}

static void check_values(const cgt_exact_ray *ray, const cgt_primitive *shape, const oracle_line *line,
                         const roots *all, int i)
{
    double uv[2];
    oracle_hit truth;
    if (!BINARY128)
        return;
    const oracle_primitive primitive = as_oracle(shape);
    oracle_describe(line, &primitive, &all->truth[i], &truth);
    assert_true(within(truth.t, all->t[i], 0x1p-50));
    if (all->root[i].primitive->kind == CGT_KIND_CAPSULES) {
        uv[0] = cgt_exact_capsule_u(ray, &shape->capsule, all->root[i].far);
        assert_true(within(truth.uv[0], uv[0], 0x1p-49));
        for (size_t b = 0; b < TEST_COUNT(others); b++)
            assert_true(same_double(others[b]->capsule_u(ray, &shape->capsule, all->root[i].far), uv[0]));
    }
    if (shape->kind != CGT_KIND_TRIANGLES)
        return;
    cgt_exact_uv(ray, &shape->triangle, uv);
    for (int k = 0; k < 2; k++)
        assert_true(within(truth.uv[k], uv[k], 0x1p-50));
    check_normal(&shape->triangle, truth.normal);
}

/* ---- Agreement ---- */

/* Crossings are hits. The corner with which a triangle begins does not matter; the other way round it is crossed the
 * other way. */
static void check_crossing(const cgt_exact_ray *ray, const cgt_triangle *triangle, bool hit)
{
    const int side = cgt_exact_crossing(ray, triangle);
    cgt_triangle turned = *triangle, reversed = *triangle;
    memcpy(turned.v[0], triangle->v[1], sizeof turned.v[0]);
    memcpy(turned.v[1], triangle->v[2], sizeof turned.v[1]);
    memcpy(turned.v[2], triangle->v[0], sizeof turned.v[2]);
    memcpy(reversed.v[0], triangle->v[1], sizeof reversed.v[0]);
    memcpy(reversed.v[1], triangle->v[0], sizeof reversed.v[1]);
    assert_true(hit || !side);
    assert_int_equal(cgt_exact_crossing(ray, &turned), side);
    assert_int_equal(cgt_exact_crossing(ray, &reversed), -side);
    for (size_t b = 0; b < TEST_COUNT(others); b++)
        assert_int_equal(others[b]->crossing(ray, triangle), side);
    if (!side)
        return;
    const cgt_primitive primitive = {.kind = CGT_KIND_TRIANGLES, .triangle = *triangle};
    const int t_sign = cgt_exact_crossing_t_sign(ray, triangle);
    const double t = cgt_exact_t(ray, &(cgt_exact_root){&primitive, false});
    cgt_double_ray line;
    bounce_surface surface;
    assert_int_equal(cgt_exact_triangle_side(ray, triangle), side);
    if (cgt_double_ray_init(ray->org, ray->dir, &line) && cgt_find_surface(&primitive, &line, (float)t, &surface))
        assert_int_equal(surface.front, side < 0);
    assert_true(t_sign != 0 && (t == 0 || t_sign == (t > 0 ? 1 : -1)));
    for (size_t b = 0; b < TEST_COUNT(others); b++)
        assert_true(others[b]->crossing_t_sign(ray, triangle) == t_sign &&
                    others[b]->triangle_side(ray, triangle) == side);
}

static void check_builds_on_shape(const cgt_exact_ray *ray, const cgt_primitive *shape, bool hit)
{
    double uv[2], other_uv[2], n[3], other_n[3];
    for (size_t b = 0; b < TEST_COUNT(others); b++) {
        if (meets(others[b], ray, shape) != hit)
            fail_msg("%s: hit or miss differs", others[b]->name);
        if (shape->kind != CGT_KIND_TRIANGLES)
            continue;
        cgt_exact_normal(&shape->triangle, n);
        if (b == 0)
            check_crossing(ray, &shape->triangle, hit);
        others[b]->normal(&shape->triangle, other_n);
        assert_memory_equal(n, other_n, sizeof n);
        if (!hit)
            continue;
        cgt_exact_uv(ray, &shape->triangle, uv);
        others[b]->uv(ray, &shape->triangle, other_uv);
        assert_memory_equal(uv, other_uv, sizeof uv);
    }
}

/* Adds the roots of one primitive; all builds must agree with the oracle on hit or miss. */
static void add_roots(const cgt_exact_ray *ray, const cgt_primitive *shape, const oracle_line *line, roots *all,
                      tally *sum)
{
    oracle_root truth[2];
    const oracle_primitive primitive = as_oracle(shape);
    const int count = oracle_roots(line, &primitive, truth);
    const bool sphere = shape->kind == CGT_KIND_SPHERES, capsule = shape->kind == CGT_KIND_CAPSULES;
    cgt_capsule_part part[2];
    assert_int_equal(exact_meets(ray, shape), count > 0);
    check_builds_on_shape(ray, shape, count > 0);
    if (!count)
        return;
    if (capsule)
        assert_int_equal(cgt_exact_capsule_roots(ray, &shape->capsule, part), count);
    for (int far = 0; far < (sphere || capsule ? 2 : 1); far++) {
        const int i = all->count++;
        all->root[i] = (cgt_exact_root){shape, far};
        if (capsule && part[far] != CGT_CAPSULE_SIDE) { /* those are the last four roots */
            cgt_primitive *end = &all->ends[i % 4];
            *end = (cgt_primitive){.kind = CGT_KIND_SPHERES, .sphere = cgt_capsule_end(&shape->capsule, part[far])};
            all->root[i].primitive = end;
        }
        sum->sides += capsule && part[far] == CGT_CAPSULE_SIDE;
        all->truth[i] = truth[far < count ? far : 0];
        all->t[i] = cgt_exact_t(ray, &all->root[i]);
        for (size_t b = 0; b < TEST_COUNT(others); b++)
            assert_true(same_double(others[b]->t(ray, &all->root[i]), all->t[i]));
        check_values(ray, shape, line, all, i);
    }
    sum->sphere_hits += sphere;
    sum->capsule_hits += capsule;
    sum->tangents += sphere && count == 1;
    if (sphere || capsule)
        return;
    double uv[2];
    cgt_exact_uv(ray, &shape->triangle, uv);
    sum->triangle_hits++;
    sum->on_edge += uv[0] == 0 || uv[1] == 0 || uv[0] + uv[1] == 1;
}

static void compare_pair(const cgt_exact_ray *ray, roots *all, int i, int j, tally *sum)
{
    const int order = cgt_exact_compare(ray, &all->root[i], &all->root[j]);
    all->order[i][j] = order;
    assert_int_equal(order, oracle_compare(&all->truth[i], &all->truth[j]));
    for (size_t b = 0; b < TEST_COUNT(others); b++)
        assert_int_equal(others[b]->compare(ray, &all->root[i], &all->root[j]), order);
    const cgt_kind a_kind = all->root[i].primitive->kind, b_kind = all->root[j].primitive->kind;
    const bool cylinder = a_kind == CGT_KIND_CAPSULES || b_kind == CGT_KIND_CAPSULES;
    if (i != j)
        sum->pairs[cylinder ? 3 : (a_kind == CGT_KIND_SPHERES) + (b_kind == CGT_KIND_SPHERES)]++;
    sum->equal += i != j && order == 0;

    const truth_real a = all->truth[i].t, b = all->truth[j].t, distance = a < b ? b - a : a - b;
    if (BINARY128 && distance > ((a < 0 ? -a : a) + (b < 0 ? -b : b)) * 0x1p-100) {
        assert_int_equal(order, a < b ? -1 : 1);
        sum->surely++;
    }
    /* and the returned values never contradict it by more than their error */
    const double s = all->t[i], t = all->t[j];
    assert_true(order > 0 || s <= t + 0x1p-48 * (t < 0 ? -t : t));
}

static void check_order(const roots *all)
{
    for (int i = 0; i < all->count; i++)
        for (int j = 0; j < all->count; j++) {
            assert_int_equal(all->order[i][j], -all->order[j][i]);
            for (int k = 0; k < all->count; k++)
                if (all->order[i][j] <= 0 && all->order[j][k] <= 0) {
                    assert_true(all->order[i][k] <= 0);
                    assert_int_equal(all->order[i][k] == 0, all->order[i][j] == 0 && all->order[j][k] == 0);
                }
        }
}

static void check_case(const exact_case *c, tally *sum)
{
    roots all = {.count = 0};
    oracle_line line;
    const truth_ray ray = whole_line(&c->ray);
    assert_true(oracle_line_make(&ray, &line));
    for (int i = 0; i < 6; i++)
        add_roots(&c->ray, &c->primitive[i], &line, &all, sum);
    for (int i = 0; i < all.count; i++)
        for (int j = 0; j < all.count; j++)
            compare_pair(&c->ray, &all, i, j, sum);
    check_order(&all);
    sum->cases++;
}

static tally check_family(exact_family family, uint32_t cases)
{
    tally sum = {.cases = 0};
    test_random r = random_make(2000 + (uint64_t)family);
    while (sum.cases < cases) {
        const exact_case c = exact_case_make(&r, family);
        check_case(&c, &sum);
    }
    print_message("%-8s %5llu cases: %llu triangles hit, %llu at an edge; %llu spheres, %llu touched; pairs %llu "
                  "triangles, %llu mixed, %llu spheres; %llu equal, %llu sure in binary128; %llu capsules, %llu sides, "
                  "%llu pairs\n",
                  exact_family_name(family), (unsigned long long)sum.cases, (unsigned long long)sum.triangle_hits,
                  (unsigned long long)sum.on_edge, (unsigned long long)sum.sphere_hits,
                  (unsigned long long)sum.tangents, (unsigned long long)sum.pairs[0], (unsigned long long)sum.pairs[1],
                  (unsigned long long)sum.pairs[2], (unsigned long long)sum.equal, (unsigned long long)sum.surely,
                  (unsigned long long)sum.capsule_hits, (unsigned long long)sum.sides,
                  (unsigned long long)sum.pairs[3]);
    assert_true(sum.triangle_hits > 0 && sum.sphere_hits > 0);
    assert_true(sum.pairs[0] > 0 && sum.pairs[1] > 0 && sum.pairs[2] > 0 && sum.pairs[3] > 0);
    return sum;
}

/* ---- Tests ---- */

static uint32_t cases_of_family(void) { return 100 + test_scaled(2000); }

TEST(everyday_input)
{
    for (exact_family f = EXACT_ORDINARY; f <= EXACT_FAR; f++)
        check_family(f, cases_of_family());
}

/* Input whose signs are 0, or decided by the smallest differences of floats. */
TEST(degenerate_input)
{
    const tally grid = check_family(EXACT_GRID, cases_of_family());
    assert_true(grid.on_edge > grid.triangle_hits / 10 && grid.tangents > 4 && grid.equal > 0);
    const tally places = check_family(EXACT_PLACES, cases_of_family());
    assert_true(places.on_edge > places.triangle_hits / 10 && places.equal > places.triangle_hits / 2);
    check_family(EXACT_AIMED, cases_of_family());
    const tally alike = check_family(EXACT_ALIKE, cases_of_family());
    assert_true(alike.equal > alike.cases / 4);
    check_family(EXACT_CLOSE, cases_of_family());
}

TEST(whole_range_of_float)
{
    for (exact_family f = EXACT_SPREAD; f < EXACT_FAMILIES; f++)
        check_family(f, cases_of_family());
}

/* The families reach each tier often. */
TEST(every_tier_is_reached)
{
    memset(exact_reached, 0, sizeof exact_reached);
    tally sum = {.cases = 0};
    test_random r = random_make(1);
    for (int i = 0; i < 40; i++)
        for (int f = 0; f < EXACT_FAMILIES; f++) {
            const exact_case c = exact_case_make(&r, (exact_family)f);
            check_case(&c, &sum);
        }
    const uint64_t *n = exact_reached;
    print_message("triple products: %llu in 128 bits, %llu in 192, %llu wide; dot products: %llu in 128, %llu wide\n",
                  (unsigned long long)n[EXACT_TIER_128], (unsigned long long)n[EXACT_TIER_192],
                  (unsigned long long)n[EXACT_TIER_wide], (unsigned long long)n[EXACT_TIER_dot],
                  (unsigned long long)n[EXACT_TIER_wide_dot]);
    assert_true(n[EXACT_TIER_wide] > sum.cases && n[EXACT_TIER_wide_dot] > sum.cases);
#ifdef __SIZEOF_INT128__
    assert_true(n[EXACT_TIER_128] > sum.cases && n[EXACT_TIER_192] > sum.cases / 4 && n[EXACT_TIER_dot] > sum.cases);
#endif
}

/* 2^120 + 2^67 lies half-way between two doubles: one bit far below decides. */
TEST(one_bit_decides_rounding)
{
    static const struct {
        float factor;
        double rounded;
    } cases[] = {{0x1p33f, 0.5}, {0x1.000004p33f, 0x1.0000000000001p-1}, {0x1.fffffcp32f, 0.5}};
    for (size_t i = 0; i < TEST_COUNT(cases); i++) {
        const float edges[9] = {0, 0, 0, 0x1p60f, -cases[i].factor, 0, 0x1p34f, 0x1p60f, 0};
        cgt_triangle shape;
        double normal[3];
        memcpy(&shape, edges, sizeof shape);
        cgt_exact_normal(&shape, normal);
        assert_true(normal[0] == 0 && normal[1] == 0 && normal[2] == cases[i].rounded);
    }
}

SEEDED_SUITE("test_exact_agree", NULL, NULL)

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The single-precision filter of triangles with one variant, against the exact oracle: a certain miss is a miss, a
 * certain hit is a hit, and the interval contains its t. Then FILTER_ROUNDOFF is lowered below the unit roundoff
 * until the bounds break: a bound that never breaks is too wide to be useful. */
#include "support/oracle/oracle.h"
#include "support/suite.h"
#include "support/test.h"
#include "support/tightened.h"

#include <math.h>
#include <string.h>

#include "vector.h"

static float filter_u = SPUX_ROUNDOFF;
#define FILTER_ROUNDOFF filter_u
#include "papers/kernel/packet/triangle_filter.h"

#define LANES 16 /* rays per packet: whole vectors of any width */

/* Powers of two of what has any size: up to 2^55, and denormals. An SPU's numbers end at 2^129 where those of IEEE
 * become infinite, and its comparisons then decide: its programs keep to less. */
#ifdef CGT_SPU_EXACT
enum { SMALLEST_SIZE = -30, SIZES = 40, LENGTHS = 20 };
#else
enum { SMALLEST_SIZE = -140, SIZES = 175, LENGTHS = 50 };
#endif

typedef enum family { INTERIOR, EDGES, VERTICES, GRAZING, NEEDLES, FAR, LOOKING_BACK, ANY_SIZE, FAMILIES } family;

/* Percentages of a family's rays. */
static const struct {
    const char *name;
    uint64_t least_hits, most_open;
} families[FAMILIES] = {
    [INTERIOR] = {"interior", 90, 1},          [EDGES] = {"edges", 30, 90},       [VERTICES] = {"vertices", 30, 80},
    [GRAZING] = {"grazing", 50, 70},           [NEEDLES] = {"needles", 40, 80},   [FAR] = {"far", 50, 70},
    [LOOKING_BACK] = {"looking back", 30, 20}, [ANY_SIZE] = {"any size", 60, 60},
};

/* ---- packets ---- */

typedef struct subject {
    float vertex[3][3];
    double size, middle[3], normal[3]; /* of about unit length */
    float scale;                       /* the scale of a grid around it */
} subject;

/* A triangle in double, exact enough to aim at. */
static void describe_subject(subject *s)
{
    double e[2][3], square = 0;
    float magnitude = 0;
    int exponent = 0;
    s->size = 0;
    for (int a = 0; a < 3; a++) {
        s->middle[a] = ((double)s->vertex[0][a] + s->vertex[1][a] + s->vertex[2][a]) / 3;
        for (int k = 0; k < 3; k++) {
            s->size = fmax(s->size, fabs(s->vertex[k][a] - s->middle[a]));
            magnitude = fmaxf(magnitude, fabsf(s->vertex[k][a]));
        }
        for (int k = 0; k < 2; k++)
            e[k][a] = (double)s->vertex[k + 1][a] - s->vertex[0][a];
    }
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        s->normal[a] = e[0][b] * e[1][c] - e[0][c] * e[1][b];
        square += s->normal[a] * s->normal[a];
    }
    for (int a = 0; a < 3; a++)
        s->normal[a] /= square > 0 ? sqrt(square) : 1;
    frexpf(magnitude, &exponent);
    s->scale = ldexpf(1, exponent < -100 ? 100 : -exponent); /* as the grid's plan chooses it */
}

static void make_triangle(test_random *r, family f, subject *s)
{
    const float size = random_log(r, 1e-3f, 1e3f), unit = f == INTERIOR ? size : 1;
    const float offset = random_below(r, 2) ? 0 : unit * random_log(r, 1, f == INTERIOR ? 10 : 1e4f);
    const int exponent = f == ANY_SIZE ? SMALLEST_SIZE + (int)random_below(r, SIZES) : 0;
    float middle[3];
    for (int a = 0; a < 3; a++) {
        middle[a] = random_float(r, -1, 1) * offset;
        for (int k = 0; k < 3; k++)
            s->vertex[k][a] = middle[a] + random_float(r, -1, 1) * size;
    }
    if (f == NEEDLES) { /* the third vertex close to the edge of the other two, or beyond its end */
        const float along = random_float(r, -0.2f, 1.2f), width = random_log(r, 1e-7f, 1e-2f) * size;
        for (int a = 0; a < 3; a++)
            s->vertex[2][a] =
                s->vertex[0][a] + along * (s->vertex[1][a] - s->vertex[0][a]) + random_float(r, -1, 1) * width;
    }
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            s->vertex[k][a] = ldexpf(s->vertex[k][a], exponent);
    describe_subject(s);
}

/* The target of a ray: a weighted sum of the vertices. */
static void make_target(test_random *r, family f, const subject *s, double point[3])
{
    double share[3], sum = 0;
    const uint32_t k = random_below(r, 3);
    const double fine = random_log(r, 1e-9f, 1e-3f) * (random_below(r, 2) ? 1. : -1.);
    const bool edge = f == EDGES || (f != INTERIOR && random_below(r, 4) == 0);
    for (int i = 0; i < 3; i++) {
        share[i] = (double)random_float(r, f == FAR || f == NEEDLES ? -0.1f : 0, 1);
        if (f == VERTICES)
            share[i] = i == (int)k ? 1 : share[i] * fine;
    }
    if (edge)
        share[k] = random_below(r, 4) ? fine : 0;
    for (int i = 0; i < 3; i++)
        sum += share[i];
    for (int a = 0; a < 3; a++) {
        point[a] = 0;
        for (int i = 0; i < 3; i++)
            point[a] += share[i] / sum * s->vertex[i][a];
    }
}

static double away(test_random *r, family f)
{
    return f == FAR ? random_log(r, 1e3f, 1e6f) : f == ANY_SIZE ? random_log(r, 1, 1e6f) : random_log(r, 0.1f, 300);
}

static void make_origin(test_random *r, family f, const subject *s, float org[3])
{
    float d[3];
    double in_plane = 0;
    const double reach = away(r, f), lift = f == GRAZING ? random_log(r, 1e-7f, 1e-1f) : 1;
    random_direction(r, d);
    for (int a = 0; a < 3; a++)
        in_plane += d[a] * s->normal[a];
    for (int a = 0; a < 3; a++) {
        const double to = f == GRAZING ? d[a] - in_plane * s->normal[a] * (1 - lift) : d[a];
        org[a] = (float)(s->middle[a] + reach * s->size * to);
    }
}

/* Some ranges begin or end near the triangle. */
static void make_range(test_random *r, family f, packet *p, int i, double t)
{
    const uint32_t choice = f == INTERIOR ? 3 : random_below(r, 16);
    const float near_t = (float)(t * (1 + (double)random_log(r, 1e-9f, 1) * (random_below(r, 2) ? 1 : -1)));
    p->t_min[i] = f == LOOKING_BACK && choice % 2 ? -INFINITY : choice == 0 && near_t >= 0 ? near_t : 0;
    p->t_max[i] = choice == 2 ? near_t : INFINITY;
    p->low[i] = p->high[i] = p->t_max[i];
    p->prim[i] = CGT_INVALID_ID;
}

/* A packet of one family in front of one triangle: from one origin, or from origins close to each other. */
static void make_packet(test_random *r, family f, packet *p, subject *s)
{
    float origin[3];
    memset(p, 0, sizeof *p);
    make_triangle(r, f, s);
    make_origin(r, f, s, origin);
    const int exponent = f == ANY_SIZE ? (int)random_below(r, 2 * LENGTHS + 1) - LENGTHS : 0;
    const double length = ldexp(f == ANY_SIZE ? 1 : (double)random_log(r, 1e-3f, 1e3f), exponent);
    const float jitter = (float)(random_below(r, 2) ? 0.1 * s->size : 0);
    p->lanes = p->rays = LANES;
    p->common_origin = random_below(r, 2);
    for (int i = 0; i < LANES; i++) {
        double point[3], to[3], square = 0, reach;
        float dd = 0;
        make_target(r, f, s, point);
        for (int a = 0; a < 3; a++) {
            p->org[a][i] = p->common_origin ? origin[a] : origin[a] + random_float(r, -1, 1) * jitter;
            to[a] = point[a] - p->org[a][i];
            square += to[a] * to[a];
        }
        reach = sqrt(square) * (f == LOOKING_BACK ? -1 : 1);
        if (!(square > 0)) { /* the origin equals the target */
            to[0] = reach = 1;
        }
        for (int a = 0; a < 3; a++) {
            p->dir[a][i] = (float)(to[a] / reach * length);
            dd += p->dir[a][i] * p->dir[a][i];
        }
        p->rdd[i] = 1 / dd;
        make_range(r, f, p, i, reach / length);
    }
}

/* ---- judging ---- */

typedef struct tally {
    uint64_t lanes, hits, undecided;  /* undecided: left to double precision */
    uint64_t lost, invented, outside; /* must be 0 */
} tally;

typedef struct truth_of_packet {
    bool hit[LANES];
    truth_real t[LANES];
} truth_of_packet;

static oracle_primitive primitive_of(const subject *s, uint32_t number)
{
    oracle_primitive q = {.kind = ORACLE_TRIANGLE, .primitive = number};
    memcpy(q.data, s->vertex, sizeof s->vertex);
    return q;
}

static truth_ray ray_of(const packet *p, int i)
{
    return (truth_ray){.org = {p->org[0][i], p->org[1][i], p->org[2][i]},
                       .dir = {p->dir[0][i], p->dir[1][i], p->dir[2][i]},
                       .t_min = p->t_min[i],
                       .t_max = p->t_max[i]};
}

static truth_of_packet truth_of(const packet *p, const subject *s)
{
    const oracle_primitive q = primitive_of(s, 0);
    truth_of_packet truth;
    for (int i = 0; i < LANES; i++) {
        const truth_ray ray = ray_of(p, i);
        oracle_hit hit;
        truth.hit[i] = oracle_hits(&q, &ray, &hit);
        truth.t[i] = hit.t;
    }
    return truth;
}

static void judge_lane(const truth_of_packet *truth, int i, bool certain_hit, bool undecided, float low, float high,
                       tally *sum)
{
    sum->lanes++;
    sum->hits += truth->hit[i];
    sum->undecided += undecided;
    if (undecided)
        return;
    if (!certain_hit)
        sum->lost += truth->hit[i];
    else if (!truth->hit[i])
        sum->invented++;
    else
        sum->outside += !(low <= truth->t[i] && truth->t[i] <= high);
}

/* Sets lane k of a vector of triangles. */
static void set_triangle(filter_triangles *s, int k, const subject *of, uint32_t number)
{
    for (int i = 0; i < 3; i++)
        for (int a = 0; a < 3; a++)
            s->vertex[i][a][k] = of->vertex[i][a];
    s->prim[k] = number;
}

static void fill_triangles(test_random *r, filter_triangles *s)
{
    for (int lane = 0; lane < CGT_LANES; lane++) {
        subject other;
        for (int i = 0; i < 9; i++)
            other.vertex[i / 3][i % 3] = random_float(r, -10, 10);
        set_triangle(s, lane, &other, 1000);
    }
}

/* The packet's bounds, with Pluecker coordinates where needed. */
static filter_packet bound_packet(packet *p, float scale)
{
    filter_packet of_packet;
    filter_packet_init(p, scale, &of_packet);
    if (!p->common_origin)
        filter_moments_init(p, &of_packet);
    return of_packet;
}

static void judge_packet(test_random *r, packet *p, const subject *of, const truth_of_packet *truth, tally *sum)
{
    const int k = (int)random_below(r, CGT_LANES);
    filter_triangles s;
    filter_result f = {.low = spux_vfloat(0), .high = spux_vfloat(0)}; /* where no ray is tested */
    const filter_packet of_packet = bound_packet(p, of->scale);
    fill_triangles(r, &s);
    set_triangle(&s, k, of, 7);
    filter_triangles_bound(&of_packet, &s);
    const filter_triangle q = filter_triangle_get(&of_packet, &s, k, p->common_origin);
    for (uint32_t i = 0; i < LANES; i += CGT_LANES) {
        const bool any = filter_triangle_rays(p, &q, i, p->common_origin, &f);
        const unsigned certain_hit = any ? spux_mask_bits(f.certain_hit) : 0,
                       undecided = any ? spux_mask_bits(f.undecided) : 0;
        assert_int_equal(certain_hit & undecided, 0);
        for (int lane = 0; lane < CGT_LANES; lane++)
            judge_lane(truth, (int)i + lane, certain_hit >> lane & 1, undecided >> lane & 1, f.low[lane], f.high[lane],
                       sum);
    }
}

/* ---- tests ---- */

TEST(bounds_hold)
{
    for (int f = 0; f < FAMILIES; f++) {
        test_random r = random_make((uint64_t)f);
        tally t = {0};
        for (uint32_t k = 20 + test_scaled(1200); k; k--) {
            packet p;
            subject s;
            make_packet(&r, (family)f, &p, &s);
            const truth_of_packet truth = truth_of(&p, &s);
            judge_packet(&r, &p, &s, &truth, &t);
        }
        print_message("%s: %llu rays, %llu hits, %llu undecided; lost %llu, invented %llu, outside %llu\n",
                      families[f].name, (unsigned long long)t.lanes, (unsigned long long)t.hits,
                      (unsigned long long)t.undecided, (unsigned long long)t.lost, (unsigned long long)t.invented,
                      (unsigned long long)t.outside);
        assert_int_equal(t.lost, 0);
        assert_int_equal(t.invented, 0);
        assert_int_equal(t.outside, 0);
        assert_true(t.hits * 100 > t.lanes * families[f].least_hits); /* the filter decided many of them */
        assert_true(t.undecided * 100 < t.lanes * families[f].most_open);
    }
}

TEST(bounds_break_where_they_are_tightened)
{
    static const family hard[] = {EDGES, VERTICES, GRAZING, NEEDLES, FAR};
    tally sum[STEPS] = {{0}};
    for (size_t f = 0; f < TEST_COUNT(hard); f++) {
        test_random r = random_make(50 + f);
        for (uint32_t k = 200 + test_scaled(600); k; k--) {
            packet p;
            subject s;
            float scale = SPUX_ROUNDOFF;
            make_packet(&r, hard[f], &p, &s);
            const truth_of_packet truth = truth_of(&p, &s);
            for (int step = 0; step < bound_steps(); step++, scale *= 0.70710678f) {
                filter_u = scale;
                judge_packet(&r, &p, &s, &truth, &sum[step]);
            }
            filter_u = SPUX_ROUNDOFF;
        }
    }
    /* the bounds are worst cases: random rays come within a few orders of magnitude */
    check_break("a hit lost", sum, sizeof *sum, offsetof(tally, lost), 0x1p-7);
    check_break("a hit invented", sum, sizeof *sum, offsetof(tally, invented), 0x1p-7);
    check_break("t outside", sum, sizeof *sum, offsetof(tally, outside), 0x1p-10);
}

/* ---- two triangles ---- */

typedef struct order_counts {
    uint64_t certain_hit, not_nearer, undecided;
} order_counts;

static void judge_order(const packet *p, int i, const oracle_primitive both[2], bool nearer, bool undecided,
                        order_counts *count)
{
    const truth_ray ray = ray_of(p, i);
    const oracle_hit best = oracle_trace(&(oracle_scene){.primitive = both, .count = 2}, &ray);
    count->undecided += undecided;
    if (undecided)
        return;
    /* of equal hits the first wins: 1 means strictly nearer */
    assert_int_equal(best.index, nearer ? 1 : 0);
    ++*(nearer ? &count->certain_hit : &count->not_nearer);
}

/* The second triangle of a packet is compared with the interval of the closest hit so far. */
static void order_packet(packet *p, const subject *first, const subject *second, order_counts *count)
{
    const oracle_primitive both[2] = {primitive_of(first, 0), primitive_of(second, 1)};
    const filter_packet of_packet = bound_packet(p, first->scale);
    filter_triangles s;
    filter_result f;
    memset(&s, 0, sizeof s);
    set_triangle(&s, 0, first, 0);
    set_triangle(&s, 1, second, 1);
    filter_triangles_bound(&of_packet, &s);
    const filter_triangle a = filter_triangle_get(&of_packet, &s, 0, p->common_origin);
    const filter_triangle b = filter_triangle_get(&of_packet, &s, 1, p->common_origin);
    for (uint32_t i = 0; i < LANES; i += CGT_LANES) {
        if (!filter_triangle_rays(p, &a, i, p->common_origin, &f))
            continue;
        const unsigned hit = spux_mask_bits(f.certain_hit);
        spux_store(p->low + i, spux_select(spux_load(p->low + i), f.low, f.certain_hit));
        spux_store(p->high + i, spux_select(spux_load(p->high + i), f.high, f.certain_hit));
        spux_store_uint(p->prim + i, spux_select(spux_load_uint(p->prim + i), spux_vuint(0), f.certain_hit));
        const bool retested = filter_triangle_rays(p, &a, i, p->common_origin, &f);
        if (retested) /* hit before: neither nearer than itself nor undecided */
            assert_int_equal((spux_mask_bits(f.certain_hit) | spux_mask_bits(f.undecided)) & hit, 0);
        const bool any = filter_triangle_rays(p, &b, i, p->common_origin, &f);
        const unsigned nearer = any ? spux_mask_bits(f.certain_hit) : 0,
                       undecided = any ? spux_mask_bits(f.undecided) : 0;
        for (int lane = 0; lane < CGT_LANES; lane++)
            if (hit >> lane & 1)
                judge_order(p, (int)i + lane, both, nearer >> lane & 1, undecided >> lane & 1, count);
    }
}

TEST(order_of_two_triangles)
{
    test_random r = random_make(100);
    order_counts count = {0};
    for (uint32_t round = 100 + test_scaled(1500); round; round--) {
        packet p;
        subject first, second;
        make_packet(&r, random_below(&r, 2) ? INTERIOR : FAR, &p, &first);
        second = first;
        for (uint32_t k = 1 + random_below(&r, 3); k; k--) {
            float *x = &second.vertex[random_below(&r, 3)][random_below(&r, 3)];
            *x += (float)first.size * random_log(&r, 1e-9f, 1e-1f) * (random_below(&r, 2) ? 1.f : -1.f);
        }
        order_packet(&p, &first, &second, &count);
    }
    print_message("certainly nearer %llu times, not nearer %llu, undecided %llu times\n",
                  (unsigned long long)count.certain_hit, (unsigned long long)count.not_nearer,
                  (unsigned long long)count.undecided);
    assert_true(count.certain_hit > 50 && count.not_nearer > 50 && count.undecided > 50);
}

VARIANT_SUITE("test_triangle_filter", NULL, NULL)

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A witness from outside for the judge of tests/driver: GMP's rationals say by textbook formulas where lines meet
 * triangles, balls and capsules, and in which order. Numbers of roots, order, sides, and t must be the judge's, for
 * the driver's scenes and rays. */
#include <gmp.h>
#include <math.h>
#include <stdlib.h>

#include "driver/driver.h"
#include "oracle/hard_rays.h"
#include "support/suite.h"

/* ---- rationals: three coordinates ---- */

typedef mpq_t rational;
typedef rational point[3];

static void points_init(point *p, int count)
{
    for (int i = 0; i < 3 * count; i++)
        mpq_init(p[i / 3][i % 3]);
}

static void points_clear(point *p, int count)
{
    for (int i = 0; i < 3 * count; i++)
        mpq_clear(p[i / 3][i % 3]);
}

static void point_set(point p, const float f[3])
{
    for (int a = 0; a < 3; a++)
        mpq_set_d(p[a], (double)f[a]);
}

static void point_sub(point p, point q, point r)
{
    for (int a = 0; a < 3; a++)
        mpq_sub(p[a], q[a], r[a]);
}

static void point_dot(rational to, point p, point q)
{
    rational x, sum;
    mpq_inits(x, sum, NULL);
    for (int a = 0; a < 3; a++) {
        mpq_mul(x, p[a], q[a]);
        mpq_add(sum, sum, x);
    }
    mpq_set(to, sum);
    mpq_clears(x, sum, NULL);
}

static void determinant(rational to, point p, point q, point r)
{
    point cross;
    rational x;
    points_init(&cross, 1);
    mpq_init(x);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        mpq_mul(cross[a], p[b], q[c]);
        mpq_mul(x, p[c], q[b]);
        mpq_sub(cross[a], cross[a], x);
    }
    point_dot(to, cross, r);
    points_clear(&cross, 1);
    mpq_clear(x);
}

/* ---- a + b sqrt(m), b of any sign ---- */

typedef struct surd {
    rational a, b, m;
} surd;

static void surd_init(surd *s) { mpq_inits(s->a, s->b, s->m, NULL); }
static void surd_clear(surd *s) { mpq_clears(s->a, s->b, s->m, NULL); }

static void surd_set(surd *to, const surd *from)
{
    mpq_set(to->a, from->a);
    mpq_set(to->b, from->b);
    mpq_set(to->m, from->m);
}

static int surd_sign(const surd *s)
{
    const int a = mpq_sgn(s->a), b = mpq_sgn(s->b) * mpq_sgn(s->m);
    rational x, y;
    if (a == b || !b)
        return a;
    if (!a)
        return b;
    mpq_inits(x, y, NULL);
    mpq_mul(x, s->a, s->a);
    mpq_mul(y, s->b, s->b);
    mpq_mul(y, y, s->m);
    const int larger = mpq_cmp(x, y);
    mpq_clears(x, y, NULL);
    return larger > 0 ? a : larger < 0 ? b : 0;
}

/* The sign of p - q = (p.a - q.a + p.b sqrt(p.m)) - q.b sqrt(q.m): of both sides, or else of their squares. */
static int surd_compare(const surd *p, const surd *q)
{
    surd left, squares;
    rational x;
    surd_init(&left);
    surd_init(&squares);
    mpq_init(x);
    mpq_sub(left.a, p->a, q->a);
    mpq_set(left.b, p->b);
    mpq_set(left.m, p->m);
    const int sign = surd_sign(&left), right = mpq_sgn(q->b) * mpq_sgn(q->m);
    int result = sign > right ? 1 : sign < right ? -1 : 0;
    if (sign == right && sign) {
        mpq_mul(squares.a, left.a, left.a);
        mpq_mul(x, left.b, left.b);
        mpq_mul(x, x, left.m);
        mpq_add(squares.a, squares.a, x);
        mpq_mul(x, q->b, q->b);
        mpq_mul(x, x, q->m);
        mpq_sub(squares.a, squares.a, x);
        mpq_mul(squares.b, left.a, left.b);
        mpq_add(squares.b, squares.b, squares.b);
        mpq_set(squares.m, left.m);
        result = sign * surd_sign(&squares);
    }
    surd_clear(&left);
    surd_clear(&squares);
    mpq_clear(x);
    return result;
}

static int surd_compare_double(const surd *p, double d)
{
    surd q;
    surd_init(&q);
    mpq_set_d(q.a, d);
    const int result = surd_compare(p, &q);
    surd_clear(&q);
    return result;
}

/* To some 2^-200 of the larger part, unless both cancel by more: these are compared by value only then. */
static double surd_value(const surd *p)
{
    mpf_t a, b, m;
    mpf_init2(a, 2048);
    mpf_init2(b, 2048);
    mpf_init2(m, 2048);
    mpf_set_q(a, p->a);
    mpf_set_q(b, p->b);
    mpf_set_q(m, p->m);
    mpf_sqrt(m, m);
    mpf_mul(b, b, m);
    mpf_add(a, a, b);
    const double value = mpf_get_d(a);
    mpf_clear(a);
    mpf_clear(b);
    mpf_clear(m);
    return value;
}

/* ---- a line against a primitive ---- */

typedef struct line {
    point org, dir;
} line;

/* Roots of a t^2 + 2 b t + c, in order. a > 0. */
static int quadratic(const rational a, const rational b, const rational c, surd root[2])
{
    rational x;
    mpq_init(x);
    mpq_mul(root[0].m, b, b);
    mpq_mul(x, a, c);
    mpq_sub(root[0].m, root[0].m, x);
    const int count = mpq_sgn(root[0].m) < 0 ? 0 : mpq_sgn(root[0].m) ? 2 : 1;
    mpq_div(root[0].a, b, a);
    mpq_neg(root[0].a, root[0].a);
    mpq_inv(root[0].b, a);
    mpq_neg(root[0].b, root[0].b);
    surd_set(&root[1], &root[0]);
    mpq_neg(root[1].b, root[1].b);
    mpq_clear(x);
    return count;
}

/* org + t dir = v0 + u e + v f. */
static int meet_triangle(line *l, const float *v, surd root[2])
{
    point corner, e, f, away, minus;
    rational det, u, w;
    point *all[] = {&corner, &e, &f, &away, &minus};
    for (int i = 0; i < 5; i++)
        points_init(all[i], 1);
    mpq_inits(det, u, w, NULL);
    point_set(corner, v);
    point_set(e, v + 3);
    point_set(f, v + 6);
    point_sub(e, e, corner);
    point_sub(f, f, corner);
    point_sub(away, l->org, corner);
    for (int a = 0; a < 3; a++)
        mpq_neg(minus[a], l->dir[a]);
    determinant(det, e, f, minus);
    int count = mpq_sgn(det) != 0;
    if (count) {
        determinant(u, away, f, minus);
        determinant(w, e, away, minus);
        mpq_div(u, u, det);
        mpq_div(w, w, det);
        count = mpq_sgn(u) >= 0 && mpq_sgn(w) >= 0;
        mpq_add(u, u, w);
        count = count && mpq_cmp_ui(u, 1, 1) <= 0;
        determinant(root[0].a, e, f, away);
        mpq_div(root[0].a, root[0].a, det);
        mpq_set_ui(root[0].b, 0, 1);
        mpq_set_ui(root[0].m, 0, 1);
    }
    for (int i = 0; i < 5; i++)
        points_clear(all[i], 1);
    mpq_clears(det, u, w, NULL);
    return count;
}

static int meet_ball(line *l, const float *center, float radius, surd root[2])
{
    point c;
    rational dd, b, cc, r;
    points_init(&c, 1);
    mpq_inits(dd, b, cc, r, NULL);
    point_set(c, center);
    point_sub(c, l->org, c);
    mpq_set_d(r, (double)radius);
    mpq_mul(r, r, r);
    point_dot(dd, l->dir, l->dir);
    point_dot(b, l->dir, c);
    point_dot(cc, c, c);
    mpq_sub(cc, cc, r);
    const int count = quadratic(dd, b, cc, root);
    points_clear(&c, 1);
    mpq_clears(dd, b, cc, r, NULL);
    return count;
}

/* Where along the axis, from 0 to n.n, a root is: (org - p).n + t d.n. */
static void along(const rational at_org, const rational slope, const surd *t, surd *u)
{
    mpq_mul(u->a, slope, t->a);
    mpq_add(u->a, u->a, at_org);
    mpq_mul(u->b, slope, t->b);
    mpq_set(u->m, t->m);
}

static void widen(const surd *t, int *count, surd root[2])
{
    if (!*count || surd_compare(t, &root[0]) < 0)
        surd_set(&root[0], t);
    if (!*count || surd_compare(t, &root[1]) > 0)
        surd_set(&root[1], t);
    *count = 1;
}

/* The least and the greatest t on its side between the ends, on the ball of the first end before it, and on that of the
 * second one behind it. */
static int meet_capsule(line *l, const float *c, surd root[2])
{
    point n, p;
    rational nn, dn, pn, dd, dp, pp, a, b, r;
    surd t[2], u, end;
    int found = 0;
    points_init(&n, 1);
    points_init(&p, 1);
    mpq_inits(nn, dn, pn, dd, dp, pp, a, b, r, NULL);
    surd_init(&t[0]);
    surd_init(&t[1]);
    surd_init(&u);
    surd_init(&end);
    point_set(p, c);
    point_set(n, c + 3);
    point_sub(n, n, p);
    point_sub(p, l->org, p);
    point_dot(nn, n, n);
    point_dot(dn, l->dir, n);
    point_dot(pn, p, n);
    point_dot(dd, l->dir, l->dir);
    point_dot(dp, l->dir, p);
    point_dot(pp, p, p);
    mpq_set(end.a, nn);
    /* nn |x|^2 - (x.n)^2 = nn r^2 for x = p + t d */
    mpq_set_d(r, (double)c[6]);
    mpq_mul(r, r, r);
    mpq_sub(pp, pp, r);
    mpq_mul(a, nn, dd);
    mpq_mul(r, dn, dn);
    mpq_sub(a, a, r);
    mpq_mul(b, nn, dp);
    mpq_mul(r, dn, pn);
    mpq_sub(b, b, r);
    mpq_mul(pp, nn, pp);
    mpq_mul(r, pn, pn);
    mpq_sub(pp, pp, r);
    for (int part = mpq_sgn(a) > 0 ? 0 : 1; part < 3; part++) {
        const int roots = part ? meet_ball(l, part == 1 ? c : c + 3, c[6], t) : quadratic(a, b, pp, t);
        for (int k = 0; k < roots; k++) {
            along(pn, dn, &t[k], &u);
            const int low = surd_sign(&u), high = surd_compare(&u, &end);
            if (part == 0 ? low >= 0 && high <= 0 : part == 1 ? low <= 0 : high >= 0)
                widen(&t[k], &found, root);
        }
    }
    const int count = !found ? 0 : surd_compare(&root[0], &root[1]) ? 2 : 1;
    points_clear(&n, 1);
    points_clear(&p, 1);
    mpq_clears(nn, dn, pn, dd, dp, pp, a, b, r, NULL);
    surd_clear(&t[0]);
    surd_clear(&t[1]);
    surd_clear(&u);
    surd_clear(&end);
    return count;
}

/* ---- a ray ---- */

typedef struct meeting {
    uint32_t index;
    int number;
    surd t;
} meeting;

#define MOST 600u

typedef struct witness {
    meeting met[MOST];
    uint32_t count;
    uint64_t rays, roots, equal, doubtful;
} witness;

static const judge_scene *sorted_scene; /* qsort has no argument for it */

static int compare(const void *a, const void *b)
{
    const meeting *p = a, *q = b;
    const int order = surd_compare(&p->t, &q->t);
    const oracle_primitive *x = &sorted_scene->primitive[p->index], *y = &sorted_scene->primitive[q->index];
    if (order)
        return order;
    if (x->geometry != y->geometry)
        return x->geometry < y->geometry ? -1 : 1;
    if (p->index != q->index)
        return x->primitive < y->primitive ? -1 : 1;
    return p->number - q->number;
}

/* All that the line meets, in order. */
static void meet_all(const judge_scene *s, const truth_ray *ray, witness *w)
{
    line l;
    surd root[2];
    points_init(&l.org, 1);
    points_init(&l.dir, 1);
    surd_init(&root[0]);
    surd_init(&root[1]);
    point_set(l.org, ray->org);
    point_set(l.dir, ray->dir);
    w->count = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        const oracle_primitive *const p = &s->primitive[i];
        int count = 0;
        if (judge_is_broken(p))
            continue;
        switch (p->kind) {
        case ORACLE_SPHERE: count = meet_ball(&l, p->data, p->data[3], root); break;
        case ORACLE_TRIANGLE: count = meet_triangle(&l, p->data, root); break;
        case ORACLE_CAPSULE: count = meet_capsule(&l, p->data, root); break;
        }
        for (int k = 0; k < count && w->count < MOST; k++) {
            meeting *const m = &w->met[w->count++];
            m->index = i;
            m->number = k;
            surd_init(&m->t);
            surd_set(&m->t, &root[k]);
        }
    }
    assert_true(w->count < MOST);
    sorted_scene = s;
    qsort(w->met, w->count, sizeof *w->met, compare);
    points_clear(&l.org, 1);
    points_clear(&l.dir, 1);
    surd_clear(&root[0]);
    surd_clear(&root[1]);
}

/* Where what rounds into the range begins or ends: half way to the next float. */
static double half_way(float f, float to)
{
    if (fabsf(f) == INFINITY)
        return (double)f;
    const float next = nextafterf(f, to);
    return fabsf(next) == INFINITY ? (double)f * (1 + 0x1p-25) : 0.5 * ((double)f + (double)next);
}

/* 1: t, rounded once, is in the range; 0: just beside a limit, where either is right; -1: it is not. */
static int place(const surd *t, const truth_ray *ray)
{
    const double low = ray->t_min == -INFINITY ? half_way((float)-0x1.fffffep127, -INFINITY)
                                               : half_way(ray->t_min, -INFINITY),
                 high = ray->t_max == INFINITY ? half_way((float)0x1.fffffep127, INFINITY)
                                               : half_way(ray->t_max, INFINITY);
    const double slack[2] = {0x1p-29 * fabs(low) + 0x1p-155, 0x1p-29 * fabs(high) + 0x1p-155};
    if (fabs(low) == INFINITY || fabs(high) == INFINITY)
        return ray->t_min == INFINITY || ray->t_max == -INFINITY ? -1 : 0;
    if (surd_compare_double(t, low - slack[0]) < 0 || surd_compare_double(t, high + slack[1]) > 0)
        return -1;
    return surd_compare_double(t, low + slack[0]) > 0 && surd_compare_double(t, high - slack[1]) < 0;
}

static void fail_ray(const judge_scene *s, const truth_ray *ray, uint32_t at, const char *what)
{
    fail_msg("scene %u (%s): hit %u: %s; org %a %a %a dir %a %a %a range %a %a", (unsigned)s->number, s->family,
             (unsigned)at, what, (double)ray->org[0], (double)ray->org[1], (double)ray->org[2], (double)ray->dir[0],
             (double)ray->dir[1], (double)ray->dir[2], (double)ray->t_min, (double)ray->t_max);
}

static bool is_ray(const truth_ray *ray)
{
    float sum = 0;
    for (int a = 0; a < 3; a++)
        sum += ray->org[a] * 0 + ray->dir[a] * 0;
    return sum == 0 && (ray->dir[0] != 0 || ray->dir[1] != 0 || ray->dir[2] != 0) && ray->t_min <= ray->t_max;
}

static void check_ray(const judge_scene *s, const judge_ray *ray, witness *w)
{
    judge_pool pool = {0};
    const judge_truth right = judge_trace(s, ray, JUDGE_ALL, false, &pool);
    uint32_t at = 0;
    if (!is_ray(&ray->line)) {
        assert_int_equal(right.count, 0);
        return;
    }
    meet_all(s, &ray->line, w);
    for (uint32_t i = 0; i < w->count; i++) {
        const meeting *const m = &w->met[i];
        const int in = place(&m->t, &ray->line);
        const judge_hit *const h = at < right.count ? &pool.hit[right.first + at] : NULL;
        const bool is_this = h && h->index == m->index && h->far == (m->number > 0);
        w->doubtful += !in;
        if (in < 0 && is_this)
            fail_ray(s, &ray->line, at, "the judge has one that is out of the range");
        if (in > 0 && (!is_this || h->doubtful))
            fail_ray(s, &ray->line, at, "the judge has another one, or doubts");
        if (!is_this)
            continue;
        const double value = surd_value(&m->t);
        if (!(fabs((double)h->values.t - value) <= 0x1p-50 * fabs(value)))
            fail_ray(s, &ray->line, at, "another t");
        at++;
        w->roots++;
        w->equal += i > 0 && surd_compare(&w->met[i - 1].t, &m->t) == 0;
    }
    if (at != right.count)
        fail_ray(s, &ray->line, at, "the judge has more");
    for (uint32_t i = 0; i < w->count; i++)
        surd_clear(&w->met[i].t);
    w->rays++;
    free(pool.hit);
}

/* Small scenes of all profiles; every third ray ends or begins at what it hits, as far as the judge knows. */
TEST(roots_and_order_by_rationals)
{
    static judge_scene s;
    static judge_ray ray[32];
    static witness w;
    const uint32_t scenes = test_scaled(40);
    for (uint32_t k = 0; k < driver_profile_count; k++) {
        const driver_profile *const profile = &driver_profiles[k];
        uint32_t families = 0;
        while (families < TEST_COUNT(profile->lines) && profile->lines[families])
            families++;
        for (uint32_t number = 0; number < scenes; number++) {
            scene_make(&s, random_make(1000 * k + number), profile->groups, number, SCENE_ANY_FAMILY, 10);
            for (uint32_t i = 0; i < TEST_COUNT(ray); i++)
                ray[i] = (judge_ray){
                    .line.t_max = INFINITY, .skip_primitive = CGT_INVALID_ID, .skip_geometry = CGT_INVALID_ID};
            profile->lines[number % families](&s, ray, TEST_COUNT(ray));
            for (uint32_t i = 0; i < (s.count > 200 ? 3 : s.count > 40 ? 8 : TEST_COUNT(ray)); i++) {
                judge_pool pool = {0};
                const judge_truth right = judge_trace(&s, &ray[i], JUDGE_ALL, false, &pool);
                if (i % 3 == 0 && right.count)
                    ray[i].line = hard_ray_cut(&s.random, ray[i].line, (float)pool.hit[right.first].values.t);
                free(pool.hit);
                check_ray(&s, &ray[i], &w);
            }
        }
    }
    print_message("%llu rays, %llu roots, %llu of them equal to another one, %llu beside the end of a range\n",
                  (unsigned long long)w.rays, (unsigned long long)w.roots, (unsigned long long)w.equal,
                  (unsigned long long)w.doubtful);
    assert_true(w.rays > 50 * scenes && w.roots > w.rays && w.equal > w.roots / 100);
}

SEEDED_SUITE("test_witness", NULL, NULL)

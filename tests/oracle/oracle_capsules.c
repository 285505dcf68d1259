/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The decisions about capsules, and the values of their hits, against exact arithmetic of another kind: small scenes of
 * capsules, spheres and triangles, each hard in its own way, and rays through their seams, along their axes, along
 * their silhouettes and from inside. */
#include "support/suite.h"
#include "support/test.h"

#include <math.h>
#include <string.h>

#include "exact/decide_capsule.h"
#include "exact/valid_primitive.h"
#include "oracle/hard_rays.h"
#include "support/oracle/oracle.h"

enum { MOST = 12, RAYS = 48 };

typedef struct capsule_scene {
    test_random random;
    float capsule[MOST][7];
    oracle_primitive primitive[2 * MOST];
    uint32_t count, capsules;
} capsule_scene;

static float whole(capsule_scene *s, uint32_t count) { return (float)random_below(&s->random, count); }
static float real(capsule_scene *s, float low, float high) { return random_float(&s->random, low, high); }

/* ---- kinds: what becomes of capsule i, which is evenly spread and small at first ---- */

typedef void change(capsule_scene *s, uint32_t i, float *c);

static void scale(float *c, float by)
{
    for (int k = 0; k < 7; k++)
        c[k] *= by;
}

static void even(capsule_scene *s, uint32_t i, float *c) { (void)s, (void)i, (void)c; }

static void lattice(capsule_scene *s, uint32_t i, float *c)
{
    (void)i;
    for (int k = 0; k < 6; k++)
        c[k] = whole(s, 4);
    c[6] = 0.5f;
}

/* Along an axis, so that lines along it, and across it, are exact tangents. */
static void upright(capsule_scene *s, uint32_t i, float *c)
{
    const uint32_t axis = random_below(&s->random, 3);
    (void)i;
    for (uint32_t k = 0; k < 3; k++)
        c[k] = c[3 + k] = whole(s, 3);
    c[3 + axis] += 1 + whole(s, 3);
    c[6] = 0.25f * (1 + whole(s, 4));
}

static void chain(capsule_scene *s, uint32_t i, float *c)
{
    if (i)
        memcpy(c, s->capsule[i - 1] + 3, 3 * sizeof *c);
    c[6] = i % 4 ? s->capsule[0][6] : c[6];
    if (i == 0)
        c[6] = 0.125f;
}

/* Bonds of one atom. */
static void star(capsule_scene *s, uint32_t i, float *c)
{
    memcpy(c + (i % 2 ? 3 : 0), s->capsule[0], 3 * sizeof *c);
    c[6] = s->capsule[0][6];
}

static void coincident(capsule_scene *s, uint32_t i, float *c)
{
    if (!i)
        return;
    memcpy(c, s->capsule[i / 2], 7 * sizeof *c);
    if (i % 3 == 1) { /* the ends exchanged */
        memcpy(c, s->capsule[i / 2] + 3, 3 * sizeof *c);
        memcpy(c + 3, s->capsule[i / 2], 3 * sizeof *c);
    }
    if (i % 4 == 3) {
        const uint32_t k = random_below(&s->random, 7);
        c[k] = nextafterf(c[k], INFINITY);
    }
}

/* On one line, one in the other. */
static void nested(capsule_scene *s, uint32_t i, float *c)
{
    (void)s;
    memset(c, 0, 6 * sizeof *c);
    c[3] = (float)(1 + i % 3);
    c[0] = -(float)(i / 6);
    c[6] = (float)(1 + i % 2) / 4;
}

static void long_ones(capsule_scene *s, uint32_t i, float *c)
{
    (void)i;
    c[6] = ldexpf(c[6], -(int)random_below(&s->random, 60));
}

static void thick_ones(capsule_scene *s, uint32_t i, float *c)
{
    const int exponent = (int)random_below(&s->random, 30);
    (void)i;
    for (int k = 3; k < 6; k++)
        c[k] = c[k - 3] + ldexpf(c[k], -exponent);
}

static void spheres(capsule_scene *s, uint32_t i, float *c)
{
    (void)s, (void)i;
    memcpy(c + 3, c, 3 * sizeof *c);
    c[3] *= i % 3 ? 1 : 1 + 0x1p-23f;
}

static void lines(capsule_scene *s, uint32_t i, float *c)
{
    (void)i;
    for (int k = 0; k < 6; k++)
        c[k] = whole(s, 5) / 2;
    c[6] = 0;
}

static void scales(capsule_scene *s, uint32_t i, float *c)
{
    (void)i;
    scale(c, ldexpf(1, (int)random_below(&s->random, 201) - 100));
}

static void far_away(capsule_scene *s, uint32_t i, float *c)
{
    (void)s, (void)i;
    for (int k = 0; k < 6; k++)
        c[k] += 0x1p16f * (float)(1 + k % 3);
}

static void denormal(capsule_scene *s, uint32_t i, float *c)
{
    (void)s, (void)i;
    scale(c, 0x1p-140f);
}

static void near_limit(capsule_scene *s, uint32_t i, float *c)
{
    (void)s, (void)i;
    scale(c, 0x1.8p126f);
}

static void odd_coordinates(capsule_scene *s, uint32_t i, float *c)
{
    (void)i;
    for (int k = 0; k < 7; k++)
        if (random_below(&s->random, 4) == 0)
            c[k] = ldexpf(c[k], (int)random_below(&s->random, 221) - 110);
}

static void any_bits(capsule_scene *s, uint32_t i, float *c)
{
    (void)i;
    for (int k = 0; k < 7; k++)
        c[k] = random_any_float(&s->random);
    c[6] = fabsf(c[6]);
}

static const struct {
    const char *name;
    change *change;
} kinds[] = {{"even", even},
             {"lattice", lattice},
             {"upright", upright},
             {"chain", chain},
             {"star", star},
             {"coincident", coincident},
             {"nested", nested},
             {"long", long_ones},
             {"thick", thick_ones},
             {"spheres", spheres},
             {"lines", lines},
             {"scales", scales},
             {"far from the origin", far_away},
             {"denormal", denormal},
             {"near 2^127", near_limit},
             {"odd coordinates", odd_coordinates},
             {"any bits", any_bits}};

static void add(capsule_scene *s, oracle_kind kind, const float *data)
{
    oracle_primitive *p = &s->primitive[s->count];
    *p = (oracle_primitive){.kind = kind, .geometry = 0, .primitive = s->count++};
    memcpy(p->data, data, (size_t)oracle_floats(kind) * sizeof *data);
}

/* Capsules, and among them spheres at their ends and triangles from their ends. */
static void make_scene(capsule_scene *s, uint32_t kind, uint64_t stream)
{
    memset(s, 0, sizeof *s);
    s->random = random_make(stream);
    s->capsules = 1 + random_below(&s->random, MOST);
    for (uint32_t i = 0; i < s->capsules; i++) {
        float *c = s->capsule[i];
        for (int k = 0; k < 3; k++) {
            c[k] = real(s, -1, 1);
            c[3 + k] = c[k] + real(s, -0.6f, 0.6f);
        }
        c[6] = real(s, 0.02f, 0.2f);
        kinds[kind].change(s, i, c);
        const float sphere[4] = {c[3], c[4], c[5], c[6] * (random_below(&s->random, 2) ? 1 : 1.25f)};
        const float triangle[9] = {c[0], c[1], c[2], c[3], c[4], c[5], c[0] + c[6], c[1], c[2] - c[6]};
        if (random_below(&s->random, 8) == 0)
            add(s, ORACLE_SPHERE, sphere);
        add(s, ORACLE_CAPSULE, c);
        if (random_below(&s->random, 8) == 0)
            add(s, ORACLE_TRIANGLE, triangle);
    }
}

/* ---- rays ---- */

/* A point of a capsule's axis, of its silhouette, its seam, its tip. Returns the capsule. */
static const float *target(capsule_scene *s, float p[3])
{
    const float *c = s->capsule[random_below(&s->random, s->capsules)], u = 0.25f * whole(s, 5);
    float across[3], axis[3];
    double length = 0, dot = 0, size = 0;
    random_direction(&s->random, across);
    if (random_below(&s->random, 2)) { /* exact where the axis is along a coordinate */
        const uint32_t k = random_below(&s->random, 3);
        memset(across, 0, sizeof across);
        across[k] = random_below(&s->random, 2) ? 1 : -1;
    }
    for (int a = 0; a < 3; a++) {
        axis[a] = c[3 + a] - c[a];
        length += (double)axis[a] * axis[a];
        dot += (double)axis[a] * across[a];
    }
    const bool seam = random_below(&s->random, 4) != 0;
    for (int a = 0; a < 3; a++) {
        if (seam && length > 0)
            across[a] -= (float)(dot / length * axis[a]);
        size += (double)across[a] * across[a];
    }
    const float reach = random_below(&s->random, 3) && size > 0 ? c[6] / (float)sqrt(size) : 0;
    for (int a = 0; a < 3; a++)
        p[a] = c[a] + u * axis[a] + reach * across[a];
    return c;
}

static truth_ray make_ray(capsule_scene *s)
{
    truth_ray ray = {.t_max = INFINITY};
    float at[3], away[3];
    const float *c = target(s, at);
    random_direction(&s->random, away);
    const uint32_t how = random_below(&s->random, 10);
    if (how < 3) /* from another one: inside, or on it */
        (void)target(s, ray.org);
    else
        for (int a = 0; a < 3; a++)
            ray.org[a] = at[a] + (how < 5 ? 4 : 40) * (fabsf(c[6]) + 0.1f) * away[a];
    for (int a = 0; a < 3; a++)
        ray.dir[a] = at[a] - ray.org[a];
    if (how >= 8) { /* along the axis, at its distance or at the radius */
        for (int a = 0; a < 3; a++) {
            ray.dir[a] = (c[3 + a] - c[a]) * (how == 8 ? 1 : -2);
            ray.org[a] = at[a] - 4 * ray.dir[a];
        }
    } else if (how == 7)
        hard_ray_align(&s->random, at, &ray);
    hard_ray_stretch(&s->random, &ray);
    return ray;
}

static bool is_ray(const truth_ray *ray)
{
    float sum = 0;
    for (int a = 0; a < 3; a++)
        sum += ray->org[a] * 0 + ray->dir[a] * 0;
    return sum == 0 && (ray->dir[0] != 0 || ray->dir[1] != 0 || ray->dir[2] != 0);
}

/* ---- the library's answer: the closest of all, by decisions in double and exactly ---- */

static cgt_primitive primitive_of(const oracle_primitive *p)
{
    cgt_primitive q = {.kind = p->kind == ORACLE_SPHERE    ? CGT_KIND_SPHERES
                               : p->kind == ORACLE_CAPSULE ? CGT_KIND_CAPSULES
                                                           : CGT_KIND_TRIANGLES};
    memcpy(&q.triangle, p->data, (size_t)oracle_floats(p->kind) * sizeof *p->data);
    return q;
}

static uint32_t closest(const capsule_scene *s, const cgt_ray *ray, cgt_decided_hit *best, uint64_t *exact)
{
    uint32_t found = ORACLE_NONE;
    for (uint32_t i = 0; i < s->count; i++) {
        cgt_decided_hit hit = {.primitive = primitive_of(&s->primitive[i])};
        if (cgt_primitive_check(&hit.primitive) != CGT_PRIMITIVE_VALID || !cgt_decide_hit(ray, &hit, exact))
            continue;
        if (found == ORACLE_NONE || cgt_decide_order(ray, &hit, best, exact) < 0) {
            found = i;
            *best = hit;
        }
    }
    return found;
}

typedef struct tally {
    uint64_t rays, hits, parts[3], exact;
    double u_worst, normal_worst; /* of what is promised */
} tally;

static void judge_values(const truth_ray *ray, const cgt_decided_hit *hit, const char *name, tally *sum)
{
    const cgt_ray r = {
        {{ray->org[0], ray->org[1], ray->org[2]}, {ray->dir[0], ray->dir[1], ray->dir[2]}}, ray->t_min, ray->t_max};
    const cgt_capsule *q = &hit->primitive.capsule;
    oracle_primitive primitive = {.kind = ORACLE_CAPSULE};
    oracle_hit truth;
    float normal[3];
    memcpy(primitive.data, q, sizeof *q);
    if (!oracle_hits(&primitive, ray, &truth) || truth.far != hit->far)
        return; /* in doubt, at an end of the range */
    const float u = cgt_canonical_capsule_u(&r, q, hit->far, hit->part);
    cgt_canonical_capsule_normal(&r, q, hit->t, hit->part, normal);
    const double u_off = oracle_ulp(truth.uv[0], u), angle = oracle_angle(truth.normal, normal);
    double distance = 0, at = 0;
    for (int a = 0; a < 3; a++) {
        distance += fabs((double)q->p[a] - (double)ray->org[a]) + fabs((double)q->q[a] - (double)q->p[a]);
        at += fabs(hit->t * (double)ray->dir[a]);
    }
    const double bound = 0x1p-23 + (q->r > 0 ? 0x1p-48 * (distance + at) / (double)q->r : 0);
    sum->parts[hit->part]++;
    sum->u_worst = fmax(sum->u_worst, u_off);
    if (bound < 0.25) /* else nothing is promised */
        sum->normal_worst = fmax(sum->normal_worst, angle / bound);
    if (!(u >= 0 && u <= 1 && u_off <= 0.51) || (bound < 0.25 && !(angle <= bound)))
        fail_msg("%s: u is %a, %g ulp off, the normal %g rad of %g; org %a %a %a dir %a %a %a; %a %a %a, %a %a %a, %a",
                 name, (double)u, u_off, angle, bound, (double)ray->org[0], (double)ray->org[1], (double)ray->org[2],
                 (double)ray->dir[0], (double)ray->dir[1], (double)ray->dir[2], (double)q->p[0], (double)q->p[1],
                 (double)q->p[2], (double)q->q[0], (double)q->q[1], (double)q->q[2], (double)q->r);
}

static float judge(const capsule_scene *s, const truth_ray *ray, const char *name, tally *sum)
{
    const oracle_scene scene = {.primitive = s->primitive, .count = s->count};
    const cgt_ray r = {
        {{ray->org[0], ray->org[1], ray->org[2]}, {ray->dir[0], ray->dir[1], ray->dir[2]}}, ray->t_min, ray->t_max};
    cgt_decided_hit best;
    const uint32_t found = closest(s, &r, &best, &sum->exact);
    const bool none = found == ORACLE_NONE;
    const float t = none ? INFINITY : (float)best.t;
    const char *const wrong = oracle_check(&scene, ray, none ? ORACLE_NONE : 0, none ? 0 : found, t);
    sum->rays++;
    sum->hits += !none;
    if (wrong)
        fail_msg("%s: %s: %d at %a; org %a %a %a dir %a %a %a range %a %a", name, wrong, (int)found, (double)t,
                 (double)ray->org[0], (double)ray->org[1], (double)ray->org[2], (double)ray->dir[0],
                 (double)ray->dir[1], (double)ray->dir[2], (double)ray->t_min, (double)ray->t_max);
    if (!none && best.primitive.kind == CGT_KIND_CAPSULES)
        judge_values(ray, &best, name, sum);
    return t;
}

TEST(capsules_of_every_kind)
{
    static capsule_scene s;
    for (uint32_t kind = 0; kind < TEST_COUNT(kinds); kind++) {
        tally sum = {.rays = 0};
        for (uint32_t number = 0; number < test_scaled(40); number++) {
            make_scene(&s, kind, 1000 * kind + number);
            for (uint32_t i = 0; i < RAYS; i++) {
                const truth_ray ray = make_ray(&s);
                if (!is_ray(&ray))
                    continue;
                const float t = judge(&s, &ray, kinds[kind].name, &sum);
                const truth_ray again = hard_ray_cut(&s.random, ray, t);
                if (t < INFINITY)
                    (void)judge(&s, &again, kinds[kind].name, &sum);
            }
        }
        print_message("%s: %llu of %llu rays hit, %llu the side, %llu and %llu the ends, %llu exact decisions; u %.4f "
                      "ulp, normals %.3f of the bound\n",
                      kinds[kind].name, (unsigned long long)sum.hits, (unsigned long long)sum.rays,
                      (unsigned long long)sum.parts[0], (unsigned long long)sum.parts[1],
                      (unsigned long long)sum.parts[2], (unsigned long long)sum.exact, sum.u_worst, sum.normal_worst);
        assert_true(sum.rays > 0 && sum.hits * 50 > sum.rays);
    }
}

/* From inside, where the range begins at minus infinity and the near root is below the range of float. */
TEST(near_roots_below_the_range_of_float)
{
    static capsule_scene s;
    tally sum = {.rays = 0};
    const float r = 0x1p110f * (1 + 0x1p-23f), sphere[4] = {-0x1p110f, 0, 0, r},
                capsule[7] = {-0x1p110f, 0, 0, -0x1p111f, 0, 0, r};
    const truth_ray ray = {.dir = {0x1p-20f, 0, 0}, .t_min = -INFINITY, .t_max = INFINITY};
    add(&s, ORACLE_SPHERE, sphere);
    assert_true(judge(&s, &ray, "sphere", &sum) < INFINITY);
    s.count = 0;
    add(&s, ORACLE_CAPSULE, capsule);
    assert_true(judge(&s, &ray, "capsule", &sum) < INFINITY);
    assert_int_equal(sum.hits, 2);
}

SEEDED_SUITE("oracle_capsules", NULL, NULL)

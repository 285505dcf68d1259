/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The values of capsules' hits that a vector computes have the same bits as those of one ray, which
 * tests/driver judges, and a vector computes nearly all of an ordinary picture. */
#include "primitive/lane_cases.h"
#include "support/suite.h"

#include <math.h>
#include <string.h>

#include "kernel/resolve/packet_lanes.h"

typedef struct tally {
    uint64_t hits, right, parts[3];
} tally;

typedef struct rows {
    _Alignas(CGT_VECTOR_BYTES) float org[3][CGT_LANES];
    float dir[3][CGT_LANES], data[7][CGT_LANES], t_min[CGT_LANES];
    uint32_t hit[CGT_LANES];
} rows;

static void load(const float (*row)[CGT_LANES], int count, vfloat *to)
{
    for (int a = 0; a < count; a++)
        to[a] = spux_load(row[a]);
}

/* The part where the ray of a lane hits, for the tally. */
static cgt_capsule_part part_of(const cgt_ray *ray, const cgt_capsule *q)
{
    bool far;
    cgt_capsule_part part;
    (void)cgt_canonical_capsule_t(ray, q, &far, &part);
    return part;
}

static void compare_lane(const rows *w, int k, const resolved_capsules *got, uint32_t fields, tally *sum)
{
    cgt_ray ray = {.t_min = w->t_min[k], .t_max = INFINITY};
    cgt_capsule q;
    for (int a = 0; a < 3; a++) {
        ray.line.org[a] = w->org[a][k];
        ray.line.dir[a] = w->dir[a][k];
        q.p[a] = w->data[a][k];
        q.q[a] = w->data[3 + a][k];
    }
    q.r = w->data[6][k];
    const resolved_capsule one = resolve_capsule_ray(&ray, &q);
    sum->parts[part_of(&ray, &q)]++;
    bool same = same_bits(one.t, got->t[k]);
    if (fields & CGT_FIELD_UV)
        same = same && same_bits(one.u, got->u[k]);
    for (int a = 0; fields & CGT_FIELD_NORMAL && a < 3; a++)
        same = same && same_bits(one.normal[a], got->normal[a][k]);
    if (!same)
        fail_msg("t %a %a, u %a %a, normal %a %a %a, %a %a %a; org %a %a %a dir %a %a %a; %a %a %a, %a %a %a, %a",
                 (double)one.t, (double)got->t[k], (double)one.u, (double)got->u[k], (double)one.normal[0],
                 (double)one.normal[1], (double)one.normal[2], (double)got->normal[0][k], (double)got->normal[1][k],
                 (double)got->normal[2][k], (double)ray.line.org[0], (double)ray.line.org[1], (double)ray.line.org[2],
                 (double)ray.line.dir[0], (double)ray.line.dir[1], (double)ray.line.dir[2], (double)q.p[0],
                 (double)q.p[1], (double)q.p[2], (double)q.q[0], (double)q.q[1], (double)q.q[2], (double)q.r);
}

static void compare(const rows *w, uint32_t fields, tally *sum)
{
    const vfloat zero = spux_vfloat(0);
    vfloat org[3], dir[3], data[7];
    resolved_capsules got = {zero, zero, {zero, zero, zero}};
    load(w->org, 3, org);
    load(w->dir, 3, dir);
    load(w->data, 7, data);
    const vmask hit = spu_cmpeq(spux_load_uint(w->hit), spux_vuint(1));
    const unsigned right = spux_mask_bits(
        resolve_capsules_vector(org, dir, data, data + 3, data[6], spux_load(w->t_min), fields, hit, &got));
    assert_int_equal(right & ~spux_mask_bits(hit), 0);
    sum->hits += spux_count_bits(spux_mask_bits(hit));
    sum->right += spux_count_bits(right);
    for (int k = 0; k < CGT_LANES; k++)
        if (right >> k & 1)
            compare_lane(w, k, &got, fields, sum);
}

static void set_lane(rows *w, int k, const truth_ray *ray, const float *data)
{
    oracle_primitive q = {.kind = ORACLE_CAPSULE};
    oracle_hit hit;
    memcpy(q.data, data, 7 * sizeof *data);
    for (int a = 0; a < 3; a++) {
        w->org[a][k] = ray->org[a];
        w->dir[a][k] = ray->dir[a];
    }
    for (int a = 0; a < 7; a++)
        w->data[a][k] = data[a];
    w->t_min[k] = ray->t_min;
    w->hit[k] = oracle_hits(&q, ray, &hit);
}

static const uint32_t masks[] = {CGT_FIELD_T, CGT_FIELD_T | CGT_FIELD_NORMAL, CGT_FIELD_T | CGT_FIELD_UV,
                                 CGT_FIELD_T | CGT_FIELD_UV | CGT_FIELD_NORMAL};

TEST(vectors_have_the_bits_of_single_rays)
{
    static rows w;
    for (int f = 0; f < CASE_FAMILIES; f++) {
        test_random r = random_make(700 + (uint64_t)f);
        tally sum = {.hits = 0};
        if (f == CASE_FLAT)
            continue;
        for (uint32_t n = 20 + test_scaled(150); n; n--) {
            lane_case c;
            case_make(&r, ORACLE_CAPSULE, (case_family)f, &c);
            for (int i = 0; i < CASE_LANES; i += CGT_LANES) {
                for (int k = 0; k < CGT_LANES; k++)
                    set_lane(&w, k, &c.ray[n % 2 ? 0 : i + k], c.prim[n % 2 ? i + k : 0].data);
                compare(&w, masks[n / 2 % TEST_COUNT(masks)], &sum);
            }
        }
        print_message("%s: %llu hits, %llu by vectors: %llu at the side, %llu and %llu at the ends\n", case_name(f),
                      (unsigned long long)sum.hits, (unsigned long long)sum.right, (unsigned long long)sum.parts[0],
                      (unsigned long long)sum.parts[1], (unsigned long long)sum.parts[2]);
        assert_true(sum.hits > 0);
    }
}

/* Bonds seen from some distance. */
TEST(most_hits_are_by_vectors)
{
    static rows w;
    test_random r = random_make(710);
    tally sum = {.hits = 0};
    for (uint32_t n = 100 + test_scaled(1000); n; n--) {
        for (int k = 0; k < CGT_LANES; k++) {
            float data[7], at[3];
            truth_ray ray = {.t_max = INFINITY};
            const float share = random_float(&r, 0, 1);
            for (int a = 0; a < 3; a++) {
                data[a] = random_float(&r, -10, 10);
                data[3 + a] = data[a] + random_float(&r, -1.5f, 1.5f);
                at[a] = data[a] + share * (data[3 + a] - data[a]) + random_float(&r, -0.2f, 0.2f);
                ray.org[a] = a == 2 ? -40 : random_float(&r, -1, 1);
                ray.dir[a] = at[a] - ray.org[a];
            }
            data[6] = 0.25f;
            set_lane(&w, k, &ray, data);
        }
        compare(&w, masks[3], &sum);
    }
    print_message("%llu hits, %llu by vectors: %llu at the side, %llu and %llu at the ends\n",
                  (unsigned long long)sum.hits, (unsigned long long)sum.right, (unsigned long long)sum.parts[0],
                  (unsigned long long)sum.parts[1], (unsigned long long)sum.parts[2]);
    assert_true((sum.hits - sum.right) * 200 < sum.hits);
    assert_true(sum.parts[0] > 0 && sum.parts[1] > 0 && sum.parts[2] > 0);
}

/* A capsule of radius 1 near the origin of the world that a ray from afar touches: t is right long before the place on
 * the capsule is. */
static void touch_from_afar(test_random *r, float data[7], truth_ray *ray)
{
    const double inside = 1 - ldexp(1, -4 - (int)random_below(r, 19));
    const int away = 12 + (int)random_below(r, 13);
    float aside[3];
    double along = 0, square = 0, lean = 0, axis[3], length = 0;
    random_direction(r, ray->dir);
    random_direction(r, aside);
    for (int a = 0; a < 3; a++) {
        ray->org[a] = -ldexpf(ray->dir[a], away);
        along -= (double)ray->org[a] * (double)ray->dir[a];
        square += (double)ray->dir[a] * (double)ray->dir[a];
        lean += (double)aside[a] * (double)ray->dir[a];
    }
    for (int a = 0; a < 3; a++)
        aside[a] -= (float)(lean / square) * ray->dir[a];
    for (int a = 0; a < 3; a++) /* across what leads aside, and a little along the ray */
        axis[a] = (double)aside[(a + 1) % 3] * (double)ray->dir[(a + 2) % 3] -
                  (double)aside[(a + 2) % 3] * (double)ray->dir[(a + 1) % 3];
    for (int a = 0; a < 3; a++)
        length += (double)aside[a] * (double)aside[a];
    for (int a = 0; a < 3; a++) {
        const double middle =
            (double)ray->org[a] + along / square * (double)ray->dir[a] + inside / sqrt(length) * (double)aside[a];
        data[a] = (float)(middle - 2 * axis[a] - 0.5 * (double)ray->dir[a]);
        data[3 + a] = (float)(middle + 2 * axis[a] + 0.5 * (double)ray->dir[a]);
    }
    data[6] = 1;
    ray->t_min = 0;
    ray->t_max = INFINITY;
}

static double away_of(const float org[3]) { return hypot(hypot((double)org[0], (double)org[1]), (double)org[2]); }

TEST(normals_of_far_silhouettes)
{
    test_random r = random_make(715);
    double worst = 0;
    uint32_t hits = 0;
    for (uint32_t n = test_scaled(20000); n; n--) {
        oracle_primitive q = {.kind = ORACLE_CAPSULE};
        truth_ray line;
        oracle_hit right;
        double off = 0;
        touch_from_afar(&r, q.data, &line);
        if (!oracle_hits(&q, &line, &right))
            continue;
        cgt_ray ray = {.t_max = INFINITY};
        memcpy(ray.line.org, line.org, sizeof line.org);
        memcpy(ray.line.dir, line.dir, sizeof line.dir);
        cgt_capsule capsule = {.r = q.data[6]};
        memcpy(capsule.p, q.data, sizeof capsule.p);
        memcpy(capsule.q, q.data + 3, sizeof capsule.q);
        const resolved_capsule got = resolve_capsule_ray(&ray, &capsule);
        for (int a = 0; a < 3; a++) {
            const double error = (double)(right.normal[a] - (truth_real)got.normal[a]);
            off += error * error;
        }
        hits++;
        worst = fmax(worst, sqrt(off) / (0x1p-23 + 0x1p-48 * away_of(line.org)));
    }
    print_message("%u hits, normals off by %.2f of their bound\n", hits, worst);
    assert_true(hits > test_scaled(20000) / 4 && worst <= 1);
}

/* ---- packets that hit all kinds ---- */

enum { KINDS = 3 };

static const oracle_kind kinds[KINDS] = {ORACLE_SPHERE, ORACLE_TRIANGLE, ORACLE_CAPSULE};

/* One array of each kind, with the first primitive of a case. */
static cgt_primitive_array array_of(uint32_t k, const lane_case *c)
{
    const char *const data = (const char *)c->prim[0].data;
    const size_t radius = kinds[k] == ORACLE_SPHERE ? 3 : 6;
    return (cgt_primitive_array){.kind = k == 0   ? CGT_KIND_SPHERES
                                         : k == 1 ? CGT_KIND_TRIANGLES
                                                  : CGT_KIND_CAPSULES,
                                 .first = k,
                                 .geometry = k,
                                 .mask = 1,
                                 .point = data,
                                 .point_stride = 3 * sizeof(float),
                                 .radius = data + radius * sizeof(float),
                                 .count = 1,
                                 .points = 3};
}

static void expect(const cgt_primitive *q, const cgt_ray *ray, const packet_hits *hits, size_t i)
{
    cgt_counts counts = {0};
    resolved_capsule h = {.u = 0};
    float v = 0;
    if (q->kind == CGT_KIND_SPHERES) {
        const resolved_sphere s = resolve_sphere_ray(ray, q->sphere, &counts);
        h.t = s.t;
        memcpy(h.normal, s.normal, sizeof h.normal);
    } else if (q->kind == CGT_KIND_CAPSULES)
        h = resolve_capsule_ray(ray, &q->capsule);
    else {
        const resolved_triangle t =
            resolve_triangle_ray(ray, &q->triangle, CGT_FIELD_T | CGT_FIELD_UV | CGT_FIELD_NORMAL, &counts);
        h = (resolved_capsule){t.t, t.u, {t.normal[0], t.normal[1], t.normal[2]}};
        v = t.v;
    }
    assert_true(same_bits(h.t, hits->t[i]) && same_bits(h.u, hits->u[i]) && same_bits(v, hits->v[i]));
    for (int a = 0; a < 3; a++)
        assert_true(same_bits(h.normal[a], hits->normal[a][i]));
}

TEST(packets_of_all_kinds)
{
    static packet p;
    static packet_hits hits;
    static lane_case c[KINDS];
    const cgt_trace_settings settings = {.fields = CGT_FIELD_T | CGT_FIELD_UV | CGT_FIELD_NORMAL};
    test_random r = random_make(720);
    uint64_t found = 0, rays = 0;
    for (uint32_t n = 20 + test_scaled(100); n; n--) {
        cgt_primitive_array array[KINDS];
        cgt_counts counts = {0};
        p.lanes = p.rays = KINDS * CASE_LANES;
        rays += p.rays;
        for (uint32_t k = 0; k < KINDS; k++) {
            case_truth truth;
            case_make(&r, kinds[k], n % 2 ? CASE_INTERIOR : CASE_EDGES, &c[k]);
            case_judge(&c[k], &truth);
            array[k] = array_of(k, &c[k]);
            for (uint32_t i = 0; i < CASE_LANES; i++) { /* vectors of all kinds */
                const uint32_t at = KINDS * i + k;
                for (int a = 0; a < 3; a++) {
                    p.org[a][at] = c[k].ray[i].org[a];
                    p.dir[a][at] = c[k].ray[i].dir[a];
                }
                p.t_min[at] = c[k].ray[i].t_min;
                p.t_max[at] = INFINITY;
                p.prim[at] = truth.hit[0][i] ? k : CGT_INVALID_ID;
            }
        }
        const cgt_committed_scene scene = {
            .prims = {.array = array, .arrays = KINDS, .count = KINDS, .spheres = 1, .triangles = 1, .capsules = 1}};
        found += CGT_KERNEL(cgt_packet_resolve)(&scene, &p, &settings, &hits, &counts);
        for (uint32_t i = 0; i < p.lanes; i++) {
            assert_int_equal(hits.geometry[i], p.prim[i]);
            if (p.prim[i] == CGT_INVALID_ID) {
                assert_true(hits.t[i] == INFINITY && hits.u[i] == 0 && hits.normal[0][i] == 0);
                continue;
            }
            const cgt_primitive q = cgt_primitives_get(&scene.prims, p.prim[i]);
            const cgt_ray ray = packet_ray(&p, i);
            expect(&q, &ray, &hits, i);
        }
    }
    assert_true(found > rays / 2);
}

VARIANT_SUITE("test_capsule_values", NULL, NULL)

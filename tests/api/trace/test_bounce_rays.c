/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt_bounce_rays: places, normals, directions and shares against their definitions in long double; any strides,
 * counts, threads and variants; rays that are invalid. */
#include <cgt/bounces.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "support/scenes.h"
#include "support/suite.h"

enum { SPHERES = 0, TRIANGLES = 1, PRIMITIVES = 64, RAYS = 9000 };

/* A ray with all that belongs to it, so that strides are odd. */
typedef struct row {
    double position[3], normal[3], length;
    uint32_t front;
    float start[3], unused;
    float org[3], dir[3];
    float t;
    uint32_t primitive, geometry;
    float inside, outside;
    struct {
        float org[3], dir[3], t_min, t_max, share;
        uint32_t primitive, geometry;
    } out[2];
} row;

typedef struct bed {
    cgt_context *context;
    cgt_scene *scene;
    float sphere[PRIMITIVES][4], corner[3 * PRIMITIVES][3];
} bed;

static test_random random_state;
static row rows[RAYS], again[RAYS];

static void open_bed(bed *b, uint32_t threads, const char *variant)
{
    test_random r = random_make(2);
    for (uint32_t i = 0; i < PRIMITIVES; i++) {
        for (int a = 0; a < 3; a++)
            b->sphere[i][a] = random_float(&r, -1, 1);
        b->sphere[i][3] = random_float(&r, 0.05f, 0.4f);
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                b->corner[3 * i + (uint32_t)k][a] = b->sphere[i][a] + random_float(&r, -0.5f, 0.5f);
    }
    b->context = context_make(threads, variant);
    const cgt_spheres spheres = spheres_of((const float(*)[4])b->sphere, PRIMITIVES);
    const cgt_triangles triangles = {
        .count = PRIMITIVES, .vertex_count = 3 * PRIMITIVES, .vertices = cgt_floats(b->corner[0], 0)};
    assert_int_equal(cgt_scene_create(b->context, NULL, &b->scene), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(b->scene, NULL, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(b->scene, NULL, &triangles), CGT_OK);
    assert_int_equal(cgt_scene_commit(b->scene), CGT_OK);
}

static void close_bed(bed *b)
{
    cgt_scene_release(b->scene);
    cgt_context_release(b->context);
}

#define THREE(array)                                                                                                   \
    {                                                                                                                  \
        &(array)[0], &(array)[1], &(array)[2]                                                                          \
    }

static cgt_rays rays_of(row *r, uint64_t count)
{
    return (cgt_rays){.count = count, .stride = sizeof *r, .org = THREE(r->org), .dir = THREE(r->dir)};
}

static cgt_hits row_hits(row *r)
{
    return (cgt_hits){.stride = sizeof *r, .t = &r->t, .primitive = &r->primitive, .geometry = &r->geometry};
}

static cgt_surfaces surfaces_of(row *r)
{
    return (cgt_surfaces){.stride = sizeof *r,
                          .position = THREE(r->position),
                          .normal = THREE(r->normal),
                          .start = THREE(r->start),
                          .length = &r->length,
                          .front = &r->front};
}

static cgt_bounced_rays bounced_of(row *r, int k)
{
    return (cgt_bounced_rays){.stride = sizeof *r,
                              .org = THREE(r->out[k].org),
                              .dir = THREE(r->out[k].dir),
                              .t_max = &r->out[k].t_max,
                              .t_min = &r->out[k].t_min,
                              .skip_primitive = &r->out[k].primitive,
                              .skip_geometry = &r->out[k].geometry,
                              .share = &r->out[k].share};
}

static cgt_media media_of(row *r)
{
    return (cgt_media){.stride = sizeof *r, .inside_of_ray = &r->inside, .outside_of_ray = &r->outside};
}

static void bounce_rows(const cgt_scene *scene, row *r, uint64_t count, cgt_trace_statistics *statistics)
{
    const cgt_rays rays = rays_of(r, count);
    const cgt_hits hits = row_hits(r);
    const cgt_media media = media_of(r);
    const cgt_surfaces surfaces = surfaces_of(r);
    const cgt_bounced_rays reflected = bounced_of(r, 0), refracted = bounced_of(r, 1);
    const cgt_trace_options options = {.statistics = statistics};
    assert_int_equal(cgt_bounce_rays(scene, &rays, &hits, &media, &surfaces, &reflected, &refracted, &options), CGT_OK);
}

/* Rays from anywhere, some from inside of spheres, with their hits and indices. */
static void fill_rows(const bed *b, row *r, uint32_t count)
{
    const cgt_rays rays = rays_of(r, count);
    const cgt_hits hits = row_hits(r);
    static const float indices[] = {1.0f, 1.33f, 1.5f, 2.4f, 0.7f};
    memset(r, 0x55, count * sizeof *r);
    for (uint32_t i = 0; i < count; i++) {
        const float from = i % 4 ? 3.0f : 1.0f;
        for (int a = 0; a < 3; a++) {
            r[i].org[a] = random_float(&random_state, -from, from);
            r[i].dir[a] = random_float(&random_state, -1, 1) - (i % 4 ? r[i].org[a] : 0);
        }
        r[i].inside = indices[random_below(&random_state, TEST_COUNT(indices))];
        r[i].outside = indices[random_below(&random_state, TEST_COUNT(indices))];
    }
    assert_int_equal(cgt_trace_rays(b->scene, &rays, &hits, NULL), CGT_OK);
}

/* ---- truth ---- */

typedef long double vec3[3];

static long double dot(const vec3 a, const vec3 b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* The place and the outward unit normal of a hit, and how ill-conditioned they are: c / h, or k of cgt/bounces.h. */
static long double find_truth(const bed *b, const row *r, vec3 place, vec3 normal)
{
    vec3 d, o;
    long double condition;
    for (int a = 0; a < 3; a++)
        o[a] = r->org[a], d[a] = r->dir[a];
    if (r->geometry == SPHERES) {
        const float *q = b->sphere[r->primitive];
        const vec3 from = {o[0] - q[0], o[1] - q[1], o[2] - q[2]};
        const long double square = dot(d, d), middle = -dot(from, d) / square;
        const vec3 near = {from[0] + middle * d[0], from[1] + middle * d[1], from[2] + middle * d[2]};
        const long double half = sqrtl(((long double)q[3] * q[3] - dot(near, near)) / square);
        const long double t = r->t < middle ? middle - half : middle + half;
        for (int a = 0; a < 3; a++)
            place[a] = o[a] + t * d[a], normal[a] = place[a] - q[a];
        condition = sqrtl(dot(from, from)) / (half * sqrtl(square));
    } else {
        const float *v[3] = {b->corner[3 * r->primitive], b->corner[3 * r->primitive + 1],
                             b->corner[3 * r->primitive + 2]};
        vec3 e[2], to;
        for (int a = 0; a < 3; a++) {
            e[0][a] = (long double)v[1][a] - v[0][a];
            e[1][a] = (long double)v[2][a] - v[0][a];
            to[a] = v[0][a] - o[a];
        }
        for (int a = 0; a < 3; a++)
            normal[a] = e[0][(a + 1) % 3] * e[1][(a + 2) % 3] - e[0][(a + 2) % 3] * e[1][(a + 1) % 3];
        const long double t = dot(normal, to) / dot(normal, d);
        for (int a = 0; a < 3; a++)
            place[a] = o[a] + t * d[a];
        condition = sqrtl(dot(e[0], e[0]) * dot(e[1], e[1]) / dot(normal, normal)) / fabsl(dot(normal, d)) *
                    sqrtl(dot(normal, normal) * dot(d, d));
    }
    const long double length = sqrtl(dot(normal, normal));
    for (int a = 0; a < 3; a++)
        normal[a] /= length;
    return condition;
}

static long double furthest(const float is[3], const vec3 right)
{
    long double most = 0;
    for (int a = 0; a < 3; a++)
        most = fmaxl(most, fabsl(is[a] - right[a]));
    return most;
}

/* Both directions, and the reflected share; returns whether light is refracted. near_total: whether a rounding decides
 * that. */
static bool find_directions(const row *r, const vec3 normal, bool front, vec3 out[2], long double *share,
                            bool *near_total)
{
    vec3 d = {r->dir[0], r->dir[1], r->dir[2]}, n;
    const long double length = sqrtl(dot(d, d)), sign = front ? 1 : -1;
    for (int a = 0; a < 3; a++)
        d[a] /= length, n[a] = sign * normal[a];
    const long double in = -dot(d, n),
                      eta = front ? (long double)r->outside / r->inside : (long double)r->inside / r->outside;
    vec3 across;
    for (int a = 0; a < 3; a++) {
        out[0][a] = d[a] + 2 * in * n[a];
        across[a] = eta * (d[a] + in * n[a]);
    }
    const long double square = dot(across, across);
    *near_total = fabsl(square - 1) < 1e-12L;
    *share = 1;
    if (square >= 1)
        return false;
    const long double beyond = sqrtl(1 - square);
    for (int a = 0; a < 3; a++)
        out[1][a] = across[a] - beyond * n[a];
    const long double s = (eta * in - beyond) / (eta * in + beyond), p = (eta * beyond - in) / (eta * beyond + in);
    *share = (s * s + p * p) / 2;
    return true;
}

TEST(directions_are_right)
{
    bed b;
    uint32_t hits = 0, refracted = 0, total = 0, inside = 0;
    long double worst[3] = {0};
    cgt_trace_statistics statistics;
    random_state = random_make(1);
    open_bed(&b, 2, NULL);
    for (uint32_t round = 0; round < test_scaled(20); round++) {
        fill_rows(&b, rows, RAYS);
        bounce_rows(b.scene, rows, RAYS, &statistics);
        uint32_t found = 0;
        for (uint32_t i = 0; i < RAYS; i++) {
            const row *r = &rows[i];
            vec3 place, normal, out[2];
            long double share;
            bool near_total;
            if (r->primitive == CGT_INVALID_ID) {
                assert_true(r->out[0].t_max == -1 && r->out[1].t_max == -1 && r->front == 0 && r->length == 0);
                continue;
            }
            found++;
            const bool ill = find_truth(&b, r, place, normal) > 0x1p18L;
            const bool front = normal[0] * r->dir[0] + normal[1] * r->dir[1] + normal[2] * r->dir[2] < 0;
            if (ill)
                continue;
            assert_true((r->front == 1) == front);
            for (int a = 0; a < 3; a++) {
                assert_true(fabsl(r->position[a] - place[a]) < 0x1p-30L && fabsl(r->normal[a] - normal[a]) < 0x1p-30L);
                assert_true(fabs((double)r->start[a] - r->position[a]) <= 0x1p-23 * fabs(r->position[a]) + 0x1p-149);
                assert_true(((double)r->start[a] - r->position[a]) * ((double)r->org[a] - r->position[a]) >= 0);
            }
            const long double way =
                r->t * sqrtl((long double)r->dir[0] * r->dir[0] + (long double)r->dir[1] * r->dir[1] +
                             (long double)r->dir[2] * r->dir[2]);
            assert_true(fabsl(r->length - way) <= 0x1p-22L * fabsl(way));
            const bool is_refracted = find_directions(r, normal, front, out, &share, &near_total);
            hits++;
            if (near_total)
                continue;
            if (r->inside == r->outside) {
                assert_true(r->out[0].t_max == -1 && r->out[1].share == 1);
            } else {
                worst[0] = fmaxl(worst[0], furthest(r->out[0].dir, out[0]));
                worst[2] = fmaxl(worst[2], fabsl(r->out[0].share - share));
            }
            total += !is_refracted;
            assert_true((r->out[1].t_max >= 0) == is_refracted);
            if (!is_refracted)
                continue;
            refracted++;
            worst[1] = fmaxl(worst[1], furthest(r->out[1].dir, out[1]));
            worst[2] = fmaxl(worst[2], fabsl(r->out[1].share - (1 - share)));
            for (int k = 0; k < 2; k++) { /* of spheres, the way inside ends */
                const bool goes_in = k ? front : !front;
                if (r->out[k].t_max == -1)
                    continue;
                assert_int_equal(r->out[k].primitive, r->primitive);
                assert_int_equal(r->out[k].geometry, r->geometry);
                assert_memory_equal(r->out[k].org, r->start, sizeof r->start);
                assert_true((r->out[k].t_max < INFINITY) == (goes_in && r->geometry == SPHERES));
                inside += r->out[k].t_max < INFINITY;
            }
        }
        assert_true(statistics.rays == RAYS && statistics.hits == found && statistics.invalid_rays == 0);
    }
    print_message("errors: reflected %.3Lg, refracted %.3Lg (2^-23 is %.3g), shares %.3Lg\n", worst[0], worst[1],
                  0x1p-23, worst[2]);
    assert_true(hits > 1000 && refracted > 1000 && total > 100 && inside > 100);
    assert_true(worst[0] <= 0x1p-23L && worst[1] <= 0x1p-23L && worst[2] <= 0x1p-22L);
    close_bed(&b);
}

/* ---- arrays ---- */

TEST(bits_are_the_same)
{
    static const uint64_t counts[] = {0, 1, 15, 4095, 4096, 4097, RAYS};
    bed b;
    random_state = random_make(3);
    open_bed(&b, 1, NULL);
    fill_rows(&b, rows, RAYS);
    memcpy(again, rows, sizeof rows);
    bounce_rows(b.scene, rows, RAYS, NULL);
    close_bed(&b);
    FOR_EACH_VARIANT(name)
    {
        for (uint32_t threads = 1; threads <= 4; threads += 3) {
            open_bed(&b, threads, name);
            for (size_t k = 0; k < TEST_COUNT(counts); k++) {
                static row copy[RAYS];
                memcpy(copy, again, sizeof copy);
                bounce_rows(b.scene, copy, counts[k], NULL);
                assert_memory_equal(copy, rows, counts[k] * sizeof *copy);
                assert_memory_equal(copy + counts[k], again + counts[k], (RAYS - counts[k]) * sizeof *copy);
            }
            close_bed(&b);
        }
    }
}

/* Triples beside dense numbers. */
TEST(vectors_have_a_stride_of_their_own)
{
    static float triples[2][RAYS][3], t_max[RAYS];
    bed b;
    random_state = random_make(8);
    open_bed(&b, 2, NULL);
    fill_rows(&b, rows, RAYS);
    bounce_rows(b.scene, rows, RAYS, NULL);
    const cgt_rays rays = rays_of(rows, RAYS);
    const cgt_hits hits = row_hits(rows);
    const cgt_media media = media_of(rows);
    const cgt_bounced_rays to = {.vector_stride = sizeof triples[0][0],
                                 .org = THREE(triples[0][0]),
                                 .dir = THREE(triples[1][0]),
                                 .t_max = t_max};
    assert_int_equal(cgt_bounce_rays(b.scene, &rays, &hits, &media, NULL, NULL, &to, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++) {
        assert_memory_equal(triples[0][i], rows[i].out[1].org, sizeof triples[0][i]);
        assert_memory_equal(triples[1][i], rows[i].out[1].dir, sizeof triples[1][i]);
        assert_memory_equal(&t_max[i], &rows[i].out[1].t_max, sizeof t_max[i]);
    }
    close_bed(&b);
}

/* New rays may take the place of the old ones, and the arrays that nobody wants are not needed. */
TEST(arrays_may_be_shared)
{
    bed b;
    random_state = random_make(4);
    open_bed(&b, 2, NULL);
    fill_rows(&b, rows, RAYS);
    memcpy(again, rows, sizeof rows);
    bounce_rows(b.scene, rows, RAYS, NULL);
    const cgt_rays rays = rays_of(again, RAYS);
    const cgt_hits hits = row_hits(again);
    const cgt_media media = media_of(again);
    const cgt_bounced_rays over = {
        .stride = sizeof *again, .org = THREE(again->org), .dir = THREE(again->dir), .t_max = &again->t};
    assert_int_equal(cgt_bounce_rays(b.scene, &rays, &hits, &media, NULL, NULL, &over, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++) {
        assert_memory_equal(again[i].org, rows[i].out[1].org, sizeof again[i].org);
        assert_memory_equal(again[i].dir, rows[i].out[1].dir, sizeof again[i].dir);
        assert_memory_equal(&again[i].t, &rows[i].out[1].t_max, sizeof again[i].t);
    }
    close_bed(&b);
}

/* Without skip_geometry, the primitive that a ray skips is of geometry 0, as in cgt_rays: from inside a sphere that it
 * skips it goes on at the far side, whatever its t. */
TEST(skipped_primitives_are_of_geometry_0)
{
    bed b;
    uint32_t moved = 0;
    random_state = random_make(7);
    open_bed(&b, 1, NULL);
    fill_rows(&b, rows, RAYS);
    memcpy(again, rows, sizeof rows);
    bounce_rows(b.scene, again, RAYS, NULL);
    cgt_rays rays = rays_of(rows, RAYS);
    const cgt_hits hits = row_hits(rows);
    const cgt_surfaces surfaces = surfaces_of(rows);
    rays.skip_primitive = &rows->primitive;
    assert_int_equal(cgt_bounce_rays(b.scene, &rays, &hits, NULL, &surfaces, NULL, NULL, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++) {
        const bool same = memcmp(rows[i].position, again[i].position, sizeof rows[i].position) == 0;
        const bool is_far = rows[i].front == 0; /* the side of the sphere that the ray leaves by */
        if (rows[i].primitive != CGT_INVALID_ID && rows[i].geometry == SPHERES)
            assert_true(is_far && (same || again[i].front == 1));
        else
            assert_true(same);
        moved += !same;
    }
    assert_true(moved > 1000);
    close_bed(&b);
}

/* Mirrors without media; `inside` for all; by primitive; by ray before both. */
TEST(media_are_found)
{
    bed b;
    static float index[PRIMITIVES];
    const float *by_geometry[] = {index, NULL};
    random_state = random_make(5);
    open_bed(&b, 1, NULL);
    fill_rows(&b, rows, RAYS);
    for (uint32_t i = 0; i < PRIMITIVES; i++)
        index[i] = i % 3 ? 1.2f + 0.01f * (float)i : 0.0f;
    const cgt_rays rays = rays_of(rows, RAYS);
    const cgt_hits hits = row_hits(rows);
    const cgt_bounced_rays reflected = bounced_of(rows, 0), refracted = bounced_of(rows, 1);
    const cgt_media media[] = {{.inside = 1.4f, .inside_of_primitive = by_geometry, .geometries = 1},
                               {.inside = 1.4f, .inside_of_primitive = by_geometry, .geometries = 2},
                               {.inside = 1.4f, .outside = 1.1f}};
    assert_int_equal(cgt_bounce_rays(b.scene, &rays, &hits, NULL, NULL, &reflected, &refracted, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++)
        assert_true(rows[i].primitive == CGT_INVALID_ID || (rows[i].out[0].share == 1 && rows[i].out[1].t_max == -1));
    for (size_t k = 0; k < TEST_COUNT(media); k++) {
        assert_int_equal(cgt_bounce_rays(b.scene, &rays, &hits, &media[k], NULL, &reflected, &refracted, NULL), CGT_OK);
        memcpy(again, rows, sizeof rows);
        for (uint32_t i = 0; i < RAYS; i++) {
            again[i].outside = k == 2 ? 1.1f : 0.0f;
            again[i].inside = 1.4f;
            if (k < 2 && again[i].geometry == SPHERES)
                again[i].inside = index[again[i].primitive];
        }
        bounce_rows(b.scene, again, RAYS, NULL);
        for (uint32_t i = 0; i < RAYS; i++)
            assert_memory_equal(again[i].out, rows[i].out, sizeof rows[i].out);
    }
    close_bed(&b);
}

/* ---- invalid rays ---- */

TEST(invalid_rays_are_counted)
{
    bed b;
    cgt_trace_statistics statistics;
    random_state = random_make(6);
    open_bed(&b, 1, NULL);
    fill_rows(&b, rows, RAYS);
    uint32_t broken = 0, hits = 0;
    for (uint32_t i = 0; i < RAYS; i++) {
        row *r = &rows[i];
        if (r->primitive == CGT_INVALID_ID)
            continue;
        hits++;
        const float bad = i % 2 ? NAN : INFINITY;
        broken++;
        switch (random_below(&random_state, 12)) {
        case 0: r->org[i % 3] = bad; break;
        case 1: r->dir[i % 3] = -bad; break;
        case 2: r->dir[0] = r->dir[1] = r->dir[2] = 0; break;
        case 3: r->t = bad; break;
        case 4: r->primitive = PRIMITIVES; break;
        case 5: r->geometry = 2; break;
        case 6: r->geometry = CGT_INVALID_ID; break;
        case 7: r->inside = bad; break;
        case 8: r->inside = -1; break;
        case 9: r->outside = bad; break;
        default: broken--, r->unused = 1; continue;
        }
        r->unused = 2;
    }
    bounce_rows(b.scene, rows, RAYS, &statistics);
    assert_true(broken > 500);
    assert_int_equal(statistics.rays, RAYS);
    assert_int_equal(statistics.invalid_rays, broken);
    assert_int_equal(statistics.hits, hits - broken);
    for (uint32_t i = 0; i < RAYS; i++) {
        const row *r = &rows[i];
        if (r->unused == 1) {
            assert_true(r->out[0].t_max >= 0 || r->out[1].t_max >= 0);
            continue;
        }
        for (int k = 0; k < 2; k++) {
            assert_true(r->out[k].t_min == 0 && r->out[k].t_max == -1 && r->out[k].share == 0);
            assert_true(r->out[k].dir[2] == 1 && r->out[k].dir[0] == 0 && r->out[k].org[0] == 0);
            assert_int_equal(r->out[k].primitive, CGT_INVALID_ID);
        }
        assert_true(r->normal[0] == 0 && r->position[0] == 0 && r->start[1] == 0 && r->front == 0);
    }
    close_bed(&b);
}

/* Points and segments are hit, but have no surface. */
TEST(radius_0_has_no_surface)
{
    static const float point[1][4] = {{1, 1, 1, 0}}, end[2][3] = {{4, 0, 1}, {6, 0, 1}};
    const cgt_capsules segment = {.count = 1, .vertex_count = 2, .vertices = cgt_floats(end[0], 0)};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, point, 1);
    cgt_trace_statistics statistics;
    row r[2] = {{.dir = {49, 49, 49}, .inside = 1.5f}, {.org = {5, -3, 1}, .dir = {0, 7, 0}, .inside = 1.5f}};
    const cgt_rays rays = rays_of(r, 2);
    const cgt_hits hits = row_hits(r);
    assert_int_equal(cgt_scene_set_capsules(scene, NULL, &segment), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
    bounce_rows(scene, r, 2, &statistics);
    assert_true(statistics.hits == 0 && statistics.invalid_rays == 2);
    for (int i = 0; i < 2; i++) {
        assert_true(r[i].primitive == 0 && r[i].geometry == (uint32_t)i);
        assert_true(r[i].out[0].t_max == -1 && r[i].out[1].t_max == -1 && r[i].length == 0);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
}

SEEDED_SUITE("test_bounce_rays", NULL, NULL)

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The grid program's kernels in an SPU's arithmetic, one by one: its canonical rays have the host's bits; what a
 * packet's test of a sphere calls certain, exact arithmetic confirms, and no longer where bounds are made smaller; a
 * sphere that a ray hits is never culled. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* the bounds' unit, which tests change */
static float bound_unit;
#define GRID_ROUNDOFF bound_unit

/* doubts go to this file in place of the PPE */
#define GRID_DOUBTS_H
static void grid_add_doubt(unsigned ray, unsigned object);

#pragma GCC diagnostic ignored "-Wunused-function" /* the tests call a part of the program */
#include "cell/ppe/camera_tables.h"
#include "support/suite.h"
#include "cell/programs/grid/grid_rays.h"
#include "cell/programs/grid/grid_spheres.h"
#include "exact/decide.h"
#include "support/test.h"

static uint32_t doubts; /* rays, as bits */

static void grid_add_doubt(unsigned ray, unsigned object)
{
    (void)object;
    doubts |= 1u << ray;
}

/* A local store for this thread. */
static void *arena;
static const cgt_spu_host host = {.self = &arena};

static int make_store(void **state)
{
    (void)state;
    arena = aligned_alloc(128, CGT_SPE_STORE_BYTES / 128 * 128 + 128);
    if (!arena)
        return -1;
    memset(arena, 0, sizeof(grid_store));
    cgt_spu_set_host(&host);
    return 0;
}

static int free_store(void **state)
{
    (void)state;
    cgt_spu_set_host(NULL);
    free(arena);
    return 0;
}

static float lane_of(const vec_float4 v[4], uint32_t i)
{
    float lane[4];
    memcpy(lane, &v[i / 4], sizeof lane);
    return lane[i % 4];
}

/* ---- rays ---- */

static void compare_rays(const cgt_camera *camera, uint32_t width, uint32_t height)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    char message[CGT_PPE_MESSAGE_BYTES] = "";
    cgt_camera_tables t;
    if (cgt_camera_tables_init(&t, &memory, camera, width, height, message) != CGT_OK)
        fail_msg("%s", message);
    s()->camera = t.image;
    for (uint32_t y = 0; y < height; y += 4)
        for (uint32_t x = 0; x < width; x += 4) {
            memcpy(s()->row, t.row[y], sizeof s()->row);
            memcpy(s()->column[0], t.column[x], 4 * sizeof t.column[0]);
            grid_splat_rows();
            const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
            grid_make_rays((const vec_float4 *)(const void *)s()->column[0], 4, 4, &s()->packet);
            cgt_spu_leave_arithmetic(saved);
            for (uint32_t i = 0; i < 16; i++) {
                float org[3], dir[3];
                cgt_camera_pixel(&t.rays, x + i % 4, y + i / 4, org, dir);
                for (int a = 0; a < 3; a++) {
                    const float expected = fabsf(dir[a]) < 0x1p-126f ? 0 : dir[a];
                    if (lane_of(s()->packet.dir[a], i) != expected)
                        fail_msg("pixel %u, %u, axis %d: %a, not %a", x + i % 4, y + i / 4, a,
                                 (double)lane_of(s()->packet.dir[a], i), (double)expected);
                }
            }
        }
    cgt_camera_tables_release(&t);
}

TEST(canonical_rays)
{
    test_random r = random_make(3301);
    cgt_camera c;
    bool tiny = false, usual = false;
    for (unsigned k = 0; k < 40; k++) {
        cgt_camera_init(&c);
        c.fov = random_float(&r, 1, 150);
        for (int a = 0; a < 3; a++)
            c.eye[a] = random_float(&r, -3, 3);
        if (k % 4 == 0) { /* looks along an axis but for next to nothing */
            c.eye[0] = c.eye[1] = 0;
            c.target[0] = c.target[1] = ldexpf(random_float(&r, 1, 2), -70 - (int)k);
        }
        compare_rays(&c, 32, 20);
        tiny |= s()->camera.tiny;
        usual |= !s()->camera.tiny;
    }
    assert_true(tiny && usual); /* both ways were taken */
}

/* ---- the test of a sphere ---- */

/* Rays from an eye that pass a sphere's silhouette by about a float's rounding. */
static void aim_at_silhouette(test_random *r, const float eye[3], cgt_sphere q, grid_packet *p)
{
    double to[3] = {(double)q.x - (double)eye[0], (double)q.y - (double)eye[1], (double)q.z - (double)eye[2]};
    const double d2 = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
    const double sine = (double)q.r / sqrt(d2), tangent = sine / sqrt(1 - sine * sine),
                 scale = random_float(r, 0.5f, 2);
    for (uint32_t i = 0; i < 16; i++) {
        double side[3], dot = 0, length = 0;
        for (int a = 0; a < 3; a++) {
            side[a] = random_float(r, -1, 1);
            dot += side[a] * to[a] / d2;
        }
        for (int a = 0; a < 3; a++) {
            side[a] -= dot * to[a];
            length += side[a] * side[a];
        }
        const double off = tangent * sqrt(d2 / length) * (1 + ldexp(random_float(r, -1, 1), -20 - (int)(i % 6)));
        for (int a = 0; a < 3; a++)
            p->dir[a][i / 4] =
                spu_insert((float)((to[a] + side[a] * off) * scale / sqrt(d2)), p->dir[a][i / 4], (int)(i % 4));
    }
    for (int i = 0; i < 4; i++) {
        const vec_float4 d[3] = {p->dir[0][i], p->dir[1][i], p->dir[2][i]};
        p->rdd[i] = cgt_light_rdd(d);
        p->low[i] = p->high[i] = spu_splats(0x1p40f);
        p->prim[i] = spu_splats(CGT_INVALID_ID);
    }
}

/* Contradictions with exact arithmetic among the rays of a packet. */
static uint32_t count_contradictions(const float eye[3], cgt_sphere q, const grid_packet *p)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < 16; i++) {
        const cgt_ray ray = {.line = {.org = {eye[0], eye[1], eye[2]},
                                      .dir = {lane_of(p->dir[0], i), lane_of(p->dir[1], i), lane_of(p->dir[2], i)}},
                             .t_max = 0x1p40f};
        cgt_decided_hit hit = {.primitive = {.kind = CGT_KIND_SPHERES, .sphere = q}};
        uint64_t exact = 0;
        const bool is_hit = cgt_decide_hit(&ray, &hit, &exact);
        if (lane_of((const vec_float4 *)p->high, i) != 0x1p40f)
            count += !is_hit || hit.t < (double)lane_of(p->low, i) || hit.t > (double)lane_of(p->high, i);
        else
            count += is_hit && !(doubts >> i & 1);
    }
    return count;
}

/* Contradictions of many spheres with bounds that are `share` of what was derived. */
static uint32_t test_spheres(float share)
{
    test_random r = random_make(3302);
    const uint32_t packets = test_scaled(6000);
    grid_packet *const p = &s()->packet;
    grid_frustum *const f = &s()->frustum;
    uint32_t count = 0;
    bound_unit = 0x1p-23f * share;
    for (uint32_t k = 0; k < packets; k++) {
        const float scale = ldexpf(1, (int)(random_bits(&r) % 21) - 10), size = ldexpf(1, -(int)(random_bits(&r) % 8));
        float eye[3];
        for (int a = 0; a < 3; a++)
            eye[a] = random_float(&r, -2, 2) * scale;
        const cgt_sphere q = {eye[0] + random_float(&r, 1, 3) * scale, eye[1] + random_float(&r, -2, 2) * scale,
                              eye[2] + random_float(&r, -2, 2) * scale, random_float(&r, 0.2f, 0.9f) * scale * size};
        memcpy(s()->sphere[0], &q, sizeof q);
        aim_at_silhouette(&r, eye, q, p);
        for (int a = 0; a < 3; a++)
            f->org[a] = spu_splats(eye[a]);
        f->org_reach = spu_splats(0.f);
        doubts = 0;
        const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
        grid_bound_lengths(p, f);
        grid_test_sphere(p, f, 0, GRID_CAMERA);
        cgt_spu_leave_arithmetic(saved);
        count += count_contradictions(eye, q, p);
    }
    return count;
}

TEST(bounds_hold_and_break)
{
    assert_int_equal(test_spheres(1), 0);
    float share = 1;
    while (share > 0x1p-10f && test_spheres(share) == 0)
        share /= 2;
    print_message("bounds of spheres break at 1 / %g\n", 1 / (double)share);
    assert_true(share > 0x1p-10f);
}

/* ---- culling ---- */

/* Spheres that a ray of a packet just touches are inside its frustum, however the grid lies. */
TEST(hits_are_not_culled)
{
    test_random r = random_make(3303);
    const uint32_t packets = test_scaled(4000);
    bound_unit = 0x1p-23f;
    uint32_t tried = 0;
    for (uint32_t k = 0; k < packets; k++) {
        grid_packet *const p = &s()->packet;
        grid_frustum *const f = &s()->frustum;
        const uint32_t class = (uint32_t)random_bits(&r) % GRID_CLASSES;
        s()->camera = (cgt_camera_image){.t_max = 0x1p40f};
        for (int a = 0; a < 3; a++) {
            s()->scene.resolution[a] = 1 + (uint32_t)random_bits(&r) % 16;
            s()->scene.org[a] = -1;
            s()->scene.rcell[a] = 0.5f * (float)s()->scene.resolution[a];
            s()->scene.cell_error[a] = 0x1p-18f;
            s()->camera.eye[a] = random_float(&r, -0.5f, 0.5f);
        }
        s()->camera.eye[class / 2] = class & 1 ? 2 : -2;
        const cgt_sphere q = {random_float(&r, -0.6f, 0.6f), random_float(&r, -0.6f, 0.6f),
                              random_float(&r, -0.6f, 0.6f), random_float(&r, 0.01f, 0.2f)};
        aim_at_silhouette(&r, s()->camera.eye, q, p);
        vec_float4 sphere[4];
        const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
        grid_axes_init(class, &s()->axes[0]);
        const grid_axes *const x = &s()->axes[0];
        const bool meets = grid_frustum_of_camera(x, p, f);
        f->w_far = spu_splats(GRID_MOST);
        const float number[3] = {q.x, q.y, q.z};
        sphere[0] = spu_splats(number[x->u]);
        sphere[1] = spu_splats(number[x->v]);
        sphere[2] = spu_splats(number[x->w]);
        sphere[3] = spu_splats(q.r * (1 + 0x1p-16f)); /* some ray hits it then */
        const bool culled = spu_extract(spu_gather(grid_find_inside(x, f, sphere)), 0) != 0;
        cgt_spu_leave_arithmetic(saved);
        tried += meets;
        if (!meets || culled)
            fail_msg("class %u: a sphere at %g, %g, %g of radius %g is culled", class, (double)q.x, (double)q.y,
                     (double)q.z, (double)q.r);
    }
    assert_int_equal(tried, packets);
}

int main(void)
{
    test_begin("test_cell_bounds");
    bound_unit = 0x1p-23f;
    return SUITE_RUN(make_store, free_store);
}

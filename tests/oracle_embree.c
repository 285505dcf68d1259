/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Embree as an independent opinion: the shipped trajectory and random scenes, pixel by pixel. Where the two disagree,
 * the truth in wide arithmetic says who is wrong. That must never be libcgt; how often it is Embree is printed. */
#include "support/scenes.h"

#include <embree3/rtcore.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "trajectory.h"

#define WIDTH 320
#define HEIGHT 180

/* ---- Embree ---- */

static RTCDevice device;

static void report_error(void *user, enum RTCError code, const char *text)
{
    (void)user;
    print_error("Embree: error %d: %s\n", (int)code, text);
}

static RTCScene embree_scene(const float (*sphere)[4], uint32_t count)
{
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    if (count) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
        float *buffer =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof sphere[0], count);
        assert_non_null(buffer);
        memcpy(buffer, sphere, count * sizeof sphere[0]);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene);
    assert_int_equal(rtcGetDeviceError(device), RTC_ERROR_NONE);
    return scene;
}

/* The primitive and t that Embree finds. */
static uint32_t embree_trace(RTCScene scene, const truth_ray *ray, float *t)
{
    struct RTCIntersectContext context;
    struct RTCRayHit query = {.ray = {.org_x = ray->org[0],
                                      .org_y = ray->org[1],
                                      .org_z = ray->org[2],
                                      .dir_x = ray->dir[0],
                                      .dir_y = ray->dir[1],
                                      .dir_z = ray->dir[2],
                                      .tnear = ray->t_min,
                                      .tfar = ray->t_max,
                                      .mask = UINT32_MAX},
                              .hit = {.geomID = RTC_INVALID_GEOMETRY_ID, .primID = RTC_INVALID_GEOMETRY_ID}};
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    rtcIntersect1(scene, &context, &query);
    const bool hit = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    *t = hit ? query.ray.tfar : INFINITY;
    return hit ? query.hit.primID : TRUTH_NONE;
}

/* ---- comparison ---- */

typedef struct tally {
    uint64_t rays, hits, same, missed, invented, other_sphere, t_off;
} tally;

/* Judges ours by the truth where it is not Embree's, and says what Embree's then is. */
static void judge(const truth_scene *truth, const truth_ray *ray, uint32_t ours, float our_t, uint32_t theirs, float t,
                  tally *sum)
{
    uint64_t doubts = 0;
    sum->rays++;
    sum->hits += ours != TRUTH_NONE;
    if (ours != theirs) {
        const char *wrong = truth_judge(truth, ray, ours, our_t, &doubts);
        if (wrong)
            fail_msg("%s: sphere %u at %a, Embree: sphere %u at %a", wrong, ours, (double)our_t, theirs, (double)t);
        if (theirs == TRUTH_NONE)
            sum->missed++;
        else if (ours == TRUTH_NONE)
            sum->invented++;
        else
            sum->other_sphere++;
        return;
    }
    sum->same++;
    if (ours == TRUTH_NONE || t == our_t)
        return;
    const truth_roots roots = truth_sphere(ray->org, ray->dir, truth->sphere[ours]);
    const truth_real exact = (float)roots.near >= ray->t_min ? roots.near : roots.far;
    if (!truth_accepts(&roots, exact, our_t))
        fail_msg("t is off: sphere %u at %a, Embree at %a", ours, (double)our_t, (double)t);
    sum->t_off += !truth_accepts(&roots, exact, t);
}

static void compare(const cgt_scene *scene, const cgt_camera *camera, const float (*sphere)[4], uint32_t count,
                    tally *sum)
{
    const truth_scene truth = {sphere, count};
    planes p = planes_make(WIDTH, HEIGHT);
    truth_ray *rays = frame_rays(camera, WIDTH, HEIGHT);
    RTCScene theirs = embree_scene(sphere, count);
    frame_trace(scene, camera, &p, NULL);
    for (size_t i = 0; i < p.elements; i++) {
        float t;
        const uint32_t primitive = embree_trace(theirs, &rays[i], &t);
        judge(&truth, &rays[i], p.primitive[i], p.t[i], primitive, t, sum);
    }
    rtcReleaseScene(theirs);
    free(rays);
    planes_free(&p);
}

static void print_tally(const char *what, const tally *t)
{
    print_message("%s: %llu rays, %llu hits; Embree: %llu same, %llu missed, %llu invented, %llu another sphere, "
                  "%llu of the same with t beyond 1 ulp\n",
                  what, (unsigned long long)t->rays, (unsigned long long)t->hits, (unsigned long long)t->same,
                  (unsigned long long)t->missed, (unsigned long long)t->invented, (unsigned long long)t->other_sphere,
                  (unsigned long long)t->t_off);
    assert_true(t->hits > t->rays / 200);
    /* two programs that look at the same scene agree nearly everywhere: else one of them sees another scene */
    assert_true(t->same > t->rays - t->rays / 200);
    assert_int_equal(t->same + t->missed + t->invented + t->other_sphere, t->rays);
}

/* ---- scenes ---- */

static void trajectory_frames(void **state)
{
    (void)state;
    char error[512] = "";
    trajectory *file = trajectory_open(CGT_DATA_DIR "/pour2k.lammpstrj", NULL, error, sizeof error);
    if (!file)
        fail_msg("%s", error);
    cgt_context *context = context_make(2, NULL);
    trajectory_frame f;
    tally sum = {0};
    while (trajectory_read(file, &f, error, sizeof error) == 1) {
        cgt_camera camera;
        if (f.number % 12 != 3)
            continue;
        cgt_camera_init(&camera);
        memcpy(camera.eye, (float[3]){30 - 0.2f * (float)f.number, -18, 14}, sizeof camera.eye);
        memcpy(camera.target, (float[3]){10, 6, 4}, sizeof camera.target);
        memcpy(camera.up, (float[3]){0, 0, 1}, sizeof camera.up);
        camera.fov = 40;
        cgt_scene *scene = scene_of(context, NULL, (const float(*)[4])f.xyzr, f.count);
        compare(scene, &camera, (const float(*)[4])f.xyzr, f.count, &sum);
        cgt_scene_release(scene);
    }
    assert_string_equal(error, "");
    assert_int_equal(sum.rays, 7 * WIDTH * HEIGHT);
    print_tally("trajectory", &sum);
    cgt_context_release(context);
    trajectory_close(file);
}

static void random_scenes(void **state)
{
    (void)state;
    static const cloud_kind kind[] = {CLOUD_UNIFORM, CLOUD_CLUSTERED, CLOUD_PLANAR, CLOUD_MIXED};
    cgt_context *context = context_make(2, NULL);
    for (size_t k = 0; k < TEST_COUNT(kind); k++) {
        tally sum = {0};
        for (uint32_t round = 0; round < test_scaled(4); round++) {
            test_random r = random_make(round * TEST_COUNT(kind) + k);
            cloud c = cloud_make(&r, kind[k], 2000);
            cgt_camera camera;
            float d[3];
            cgt_camera_init(&camera);
            random_direction(&r, d);
            for (int a = 0; a < 3; a++) {
                camera.eye[a] = c.middle[a] + 3 * c.reach * d[a];
                camera.target[a] = c.middle[a];
            }
            random_direction(&r, camera.up);
            cgt_scene *scene = scene_of(context, NULL, (const float(*)[4])c.sphere, c.count);
            compare(scene, &camera, (const float(*)[4])c.sphere, c.count, &sum);
            cgt_scene_release(scene);
            cloud_free(&c);
        }
        print_tally(cloud_name(kind[k]), &sum);
    }
    cgt_context_release(context);
}

/* Rays from far away at the outlines of spheres: where single precision cannot tell. */
static void outlines_from_afar(void **state)
{
    (void)state;
    const uint32_t count = test_scaled(60000);
    test_random r = random_make(1000);
    cloud c = cloud_make(&r, CLOUD_UNIFORM, 300);
    const truth_scene truth = {(const float(*)[4])c.sphere, c.count};
    cgt_context *context = context_make(2, NULL);
    cgt_scene *scene = scene_of(context, NULL, (const float(*)[4])c.sphere, c.count);
    RTCScene theirs = embree_scene((const float(*)[4])c.sphere, c.count);
    tally sum = {0};
    for (uint32_t i = 0; i < count; i++) {
        const float *q = c.sphere[random_below(&r, c.count)];
        truth_ray ray = {.t_min = 0, .t_max = INFINITY};
        float d[3], e[3];
        double de = 0, ee = 0;
        random_direction(&r, d);
        random_direction(&r, e);
        for (int a = 0; a < 3; a++)
            de += (double)d[a] * e[a];
        for (int a = 0; a < 3; a++)
            ee += (e[a] - de * d[a]) * (e[a] - de * d[a]);
        const double away = random_log(&r, 10, 1e4f) * c.reach,
                     rim = q[3] * (1 + random_float(&r, -1e-5f, 1e-5f)) / sqrt(ee);
        for (int a = 0; a < 3; a++) {
            ray.org[a] = (float)(q[a] - away * d[a]);
            ray.dir[a] = (float)(q[a] + rim * (e[a] - de * d[a]) - ray.org[a]);
        }
        float t;
        const uint32_t primitive = embree_trace(theirs, &ray, &t);
        const ray_hit hit = ray_trace(scene, ray);
        judge(&truth, &ray, hit.primitive, hit.t, primitive, t, &sum);
    }
    print_message("outlines from afar: %llu rays, %llu hits; Embree: %llu missed, %llu invented, %llu another sphere\n",
                  (unsigned long long)sum.rays, (unsigned long long)sum.hits, (unsigned long long)sum.missed,
                  (unsigned long long)sum.invented, (unsigned long long)sum.other_sphere);
    assert_true(sum.hits > count / 3);
    assert_true(sum.missed + sum.invented + sum.other_sphere > 0); /* the rays were hard */
    rtcReleaseScene(theirs);
    cgt_scene_release(scene);
    cgt_context_release(context);
    cloud_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(trajectory_frames), cmocka_unit_test(random_scenes),
                                       cmocka_unit_test(outlines_from_afar)};
    test_begin("oracle_embree");
    device = rtcNewDevice("threads=1");
    if (!device) {
        print_error("Embree: no device: error %d\n", (int)rtcGetDeviceError(NULL));
        return 1;
    }
    rtcSetDeviceErrorFunction(device, report_error, NULL);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    rtcReleaseDevice(device);
    return failed;
}

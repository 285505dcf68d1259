/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Capsules beside Embree's round linear curves of one radius: bonds seen from outside, through Embree's default and its
 * robust mode and through the decisions of libcgt, judged by the exact oracle. Embree is an approximate opinion: most
 * of its answers are the exact ones, and libcgt's all are. */
#include "support/suite.h"
#include "support/test.h"

#include <math.h>
#include <string.h>

#include "embree/embree_scene.h"
#include "exact/decide_capsule.h"
#include "support/oracle/oracle.h"

enum { MOST = 64, RAYS = 2000, CASTERS = 3 };

static const char *const caster_name[CASTERS] = {"Embree", "Embree, robust", "libcgt"};

typedef struct answer {
    uint32_t primitive; /* ORACLE_NONE: no hit */
    float t;
} answer;

typedef struct verdicts {
    uint64_t rays, missed, invented, wrong;
    double worst; /* ulp of t, of right answers */
} verdicts;

static RTCDevice device;

static RTCScene make_curves(const float (*capsule)[7], uint32_t count, enum RTCSceneFlags flags)
{
    RTCScene scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    float(*point)[4] = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof *point,
                                               2 * (size_t)count);
    uint32_t *first =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof *first, count);
    assert_true(scene && geometry && point && first);
    for (uint32_t i = 0; i < count; i++) {
        first[i] = 2 * i;
        for (uint32_t k = 0; k < 2; k++) {
            memcpy(point[2 * i + k], capsule[i] + 3 * k, 3 * sizeof(float));
            point[2 * i + k][3] = capsule[i][6];
        }
    }
    rtcSetSceneFlags(scene, flags);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    assert_int_equal(rtcGetDeviceError(device), RTC_ERROR_NONE);
    return scene;
}

static answer ask_embree(RTCScene scene, const truth_ray *ray)
{
    struct RTCIntersectContext context;
    struct RTCRayHit query = embree_query(ray, 0, INFINITY);
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
    return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? (answer){ORACLE_NONE, INFINITY}
                                                       : (answer){query.hit.primID, query.ray.tfar};
}

static answer ask_libcgt(const float (*capsule)[7], uint32_t count, const truth_ray *ray)
{
    const cgt_ray r = {
        {{ray->org[0], ray->org[1], ray->org[2]}, {ray->dir[0], ray->dir[1], ray->dir[2]}}, ray->t_min, ray->t_max};
    cgt_decided_hit best = {.t = 0};
    uint32_t found = ORACLE_NONE;
    uint64_t exact = 0;
    for (uint32_t i = 0; i < count; i++) {
        cgt_decided_hit hit = {.primitive = {.kind = CGT_KIND_CAPSULES}};
        memcpy(&hit.primitive.capsule, capsule[i], sizeof hit.primitive.capsule);
        if (!cgt_decide_hit(&r, &hit, &exact))
            continue;
        if (found == ORACLE_NONE || cgt_decide_order(&r, &hit, &best, &exact) < 0) {
            found = i;
            best = hit;
        }
    }
    return found == ORACLE_NONE ? (answer){found, INFINITY} : (answer){found, (float)best.t};
}

static void judge(const oracle_scene *scene, const truth_ray *ray, answer a, verdicts *sum)
{
    oracle_hit truth;
    const uint32_t geometry = a.primitive == ORACLE_NONE ? ORACLE_NONE : 0;
    const oracle_verdict verdict = oracle_judge(scene, ray, geometry, a.primitive, &truth);
    sum->rays++;
    sum->missed += verdict == ORACLE_MISSED;
    sum->invented += verdict == ORACLE_INVENTED;
    sum->wrong += verdict == ORACLE_WRONG;
    if (verdict == ORACLE_RIGHT && truth.index != ORACLE_NONE)
        sum->worst = fmax(sum->worst, oracle_ulp(truth.t, a.t));
}

/* Bonds from atom to atom, one after the other, of which one in four begins anew. */
static void make_bonds(test_random *r, float length, float (*capsule)[7])
{
    for (uint32_t i = 0; i < MOST; i++)
        for (int a = 0; a < 3; a++) {
            capsule[i][a] = i % 4 ? capsule[i - 1][3 + a] : random_float(r, -5, 5);
            capsule[i][3 + a] = capsule[i][a] + length * random_float(r, -1, 1);
            capsule[i][6] = 0.15f;
        }
}

static truth_ray make_ray(test_random *r, const float (*capsule)[7])
{
    truth_ray ray = {.t_max = INFINITY};
    const float *c = capsule[random_below(r, MOST)], share = random_float(r, -0.1f, 1.1f);
    random_direction(r, ray.org);
    for (int a = 0; a < 3; a++) {
        ray.org[a] *= 30;
        ray.dir[a] = c[a] + share * (c[3 + a] - c[a]) + random_float(r, -0.16f, 0.16f) - ray.org[a];
    }
    return ray;
}

TEST(bonds_beside_round_curves)
{
    static const float lengths[] = {0.01f, 1, 30};
    for (size_t l = 0; l < TEST_COUNT(lengths); l++) {
        static float capsule[MOST][7];
        verdicts sum[CASTERS] = {{0}};
        oracle_scene scene = {0};
        test_random r = random_make(900 + l);
        make_bonds(&r, lengths[l], capsule);
        oracle_scene_add_capsules(&scene, 0, (const float(*)[7])capsule, MOST);
        RTCScene curves[2] = {make_curves((const float(*)[7])capsule, MOST, RTC_SCENE_FLAG_NONE),
                              make_curves((const float(*)[7])capsule, MOST, RTC_SCENE_FLAG_ROBUST)};
        for (uint32_t i = 0; i < test_scaled(RAYS); i++) {
            const truth_ray ray = make_ray(&r, (const float(*)[7])capsule);
            for (int k = 0; k < CASTERS; k++)
                judge(&scene, &ray,
                      k < 2 ? ask_embree(curves[k], &ray) : ask_libcgt((const float(*)[7])capsule, MOST, &ray),
                      &sum[k]);
        }
        for (int k = 0; k < CASTERS; k++) {
            const uint64_t errors = sum[k].missed + sum[k].invented + sum[k].wrong;
            print_message("bonds of %g, %s: %llu rays, %llu/%llu/%llu missed/invented/wrong, t worst %g ulp\n",
                          (double)lengths[l], caster_name[k], (unsigned long long)sum[k].rays,
                          (unsigned long long)sum[k].missed, (unsigned long long)sum[k].invented,
                          (unsigned long long)sum[k].wrong, sum[k].worst);
            assert_true(k < 2 ? errors * 20 < sum[k].rays : errors == 0 && sum[k].worst <= 0.51);
        }
        rtcReleaseScene(curves[0]);
        rtcReleaseScene(curves[1]);
        oracle_scene_free(&scene);
    }
}

static int begin(void **state)
{
    (void)state;
    device = rtcNewDevice("threads=1");
    return device ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    rtcReleaseDevice(device);
    return 0;
}

SEEDED_SUITE("oracle_embree_capsules", begin, end)

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Embree 3 on a cliff. CLIFFS_EMBREE: it is installed. */
#include "cliffs/bench_cliffs.h"

#include <string.h>

#ifdef CLIFFS_EMBREE
#include <embree3/rtcore.h>
#include <math.h>
#include <stdlib.h>

#include "float_mode.h"
#include "query/camera.h"

enum { PACKET = 16, EDGE = 4 }; /* a camera's packets are squares */

#define MOST_COORDINATE 1.844e18f /* of origins and directions: Embree's documented range */

#define LIGHT_T_MIN 1e-4f /* of shadow rays, of the way to the light: Embree cannot skip a primitive */

typedef struct embree {
    const cliffs_input *input;
    RTCDevice device;
    RTCScene scene;
    RTCGeometry geometry;
    uint32_t *index;
    truth_ray *rays; /* of the step's camera or light, in the order of packets */
    uint64_t count;
    uint64_t hits;
} embree;

bool cliffs_embree_is_here(void) { return true; }

/* ---- rays ---- */

/* Whether Embree takes a ray; the others are left out. */
static bool is_valid(const truth_ray *ray)
{
    for (int a = 0; a < 3; a++)
        if (!(fabsf(ray->org[a]) <= MOST_COORDINATE && fabsf(ray->dir[a]) <= MOST_COORDINATE))
            return false;
    return ray->t_min >= 0 && !isnan(ray->t_max);
}

static bool most_are_valid(const truth_ray *rays, uint64_t count)
{
    uint64_t valid = 0;
    for (uint64_t i = 0; i < count; i++)
        valid += is_valid(&rays[i]);
    return 2 * valid > count;
}

static void make_camera_rays(embree *e, uint32_t step)
{
    const uint32_t width = CLIFFS_WIDTH << step, height = CLIFFS_HEIGHT << step;
    char message[CGT_CAMERA_MESSAGE_BYTES];
    cgt_camera_rays camera;
    e->count = 0;
    if (cgt_camera_prepare(&e->input->scene.camera, width, height, &camera, message) != CGT_OK)
        return;
    for (uint32_t y = 0; y < height; y += EDGE)
        for (uint32_t x = 0; x < width; x += EDGE)
            for (uint32_t k = 0; k < PACKET; k++) {
                truth_ray *ray = &e->rays[e->count++];
                *ray = (truth_ray){.t_max = INFINITY};
                cgt_camera_pixel(&camera, x + k % EDGE, y + k / EDGE, ray->org, ray->dir);
            }
}

static void make_light_rays(embree *e, uint32_t step)
{
    const cliff_points *points = &e->input->points[step];
    e->count = points->count;
    for (uint32_t i = 0; i < points->count; i++) {
        truth_ray *ray = &e->rays[i];
        *ray = (truth_ray){.t_min = LIGHT_T_MIN, .t_max = 1};
        for (int a = 0; a < 3; a++) {
            ray->org[a] = points->point[i].position[a];
            ray->dir[a] = e->input->scene.light[a] - ray->org[a];
        }
    }
}

/* ---- calls ---- */

static void fill(const truth_ray *rays, uint64_t count, struct RTCRayHit16 *p, int valid[PACKET])
{
    memset(p, 0, sizeof *p);
    for (uint64_t k = 0; k < PACKET; k++) {
        const truth_ray *ray = &rays[k < count ? k : 0];
        valid[k] = k < count && is_valid(ray) ? -1 : 0;
        p->ray.org_x[k] = ray->org[0];
        p->ray.org_y[k] = ray->org[1];
        p->ray.org_z[k] = ray->org[2];
        p->ray.dir_x[k] = ray->dir[0];
        p->ray.dir_y[k] = ray->dir[1];
        p->ray.dir_z[k] = ray->dir[2];
        p->ray.tnear[k] = ray->t_min;
        p->ray.tfar[k] = ray->t_max;
        p->ray.mask[k] = UINT32_MAX;
        p->hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    }
}

static uint64_t trace_packets(const embree *e, bool nearest)
{
    struct RTCIntersectContext context;
    uint64_t hits = 0;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (uint64_t i = 0; i < e->count; i += PACKET) {
        _Alignas(64) struct RTCRayHit16 p;
        _Alignas(64) int valid[PACKET];
        fill(e->rays + i, e->count - i, &p, valid);
        if (nearest)
            rtcIntersect16(valid, e->scene, &context, &p);
        else
            rtcOccluded16(valid, e->scene, &context, (struct RTCRay16 *)(void *)&p);
        for (uint32_t k = 0; k < PACKET; k++)
            hits += valid[k] && (nearest ? p.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID : p.ray.tfar[k] < 0);
    }
    return hits;
}

static uint64_t trace_rays(const embree *e, uint64_t count, bool nearest)
{
    struct RTCIntersectContext context;
    uint64_t hits = 0;
    rtcInitIntersectContext(&context);
    for (uint64_t i = 0; i < count; i++) {
        const truth_ray *ray = &e->input->rays[i];
        struct RTCRayHit h;
        if (!is_valid(ray))
            continue;
        memset(&h, 0, sizeof h);
        h.ray.org_x = ray->org[0];
        h.ray.org_y = ray->org[1];
        h.ray.org_z = ray->org[2];
        h.ray.dir_x = ray->dir[0];
        h.ray.dir_y = ray->dir[1];
        h.ray.dir_z = ray->dir[2];
        h.ray.tnear = ray->t_min;
        h.ray.tfar = ray->t_max;
        h.ray.mask = UINT32_MAX;
        h.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        if (nearest)
            rtcIntersect1(e->scene, &context, &h);
        else
            rtcOccluded1(e->scene, &context, &h.ray);
        hits += nearest ? h.hit.geomID != RTC_INVALID_GEOMETRY_ID : h.ray.tfar < 0 && ray->t_max >= 0;
    }
    return hits;
}

static int commit(const embree *e)
{
    rtcUpdateGeometryBuffer(e->geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(e->geometry);
    rtcCommitScene(e->scene);
    return 0;
}

/* Makes the rays of a picture or a light. Leaves calls out whose rays are mostly beyond Embree's range. */
static int prepare(void *self, cliff_call call, uint32_t step)
{
    embree *e = self;
    if (call == CLIFF_COMMIT)
        return 0;
    if (call == CLIFF_LIGHT && !e->input->points[step].point)
        return 1;
    if (call != CLIFF_CAMERA && call != CLIFF_LIGHT)
        return !most_are_valid(e->input->rays, CLIFFS_RAYS);
    if (call == CLIFF_CAMERA)
        make_camera_rays(e, step);
    else
        make_light_rays(e, step);
    return e->count && !most_are_valid(e->rays, e->count);
}

static int run(void *self, cliff_call call, uint32_t step)
{
    embree *e = self;
    const uint64_t count = (uint64_t)CLIFFS_RAYS << 2 * step;
    if (call == CLIFF_COMMIT)
        return commit(e);
    const float_mode callers = float_mode_flush();
    e->hits = call == CLIFF_CAMERA || call == CLIFF_LIGHT ? trace_packets(e, call == CLIFF_CAMERA)
                                                          : trace_rays(e, count, call != CLIFF_OCCLUDED);
    float_mode_restore(callers);
    return 0;
}

static uint64_t count_hits(const void *self, cliff_call call, uint32_t step)
{
    (void)step;
    return call == CLIFF_COMMIT ? 0 : ((const embree *)self)->hits;
}

/* ---- scene ---- */

static int make_geometry(embree *e)
{
    const cliff_scene *s = &e->input->scene;
    const bool spheres = s->base == CLIFF_CLOUD;
    e->geometry = rtcNewGeometry(e->device, spheres ? RTC_GEOMETRY_TYPE_SPHERE_POINT : RTC_GEOMETRY_TYPE_TRIANGLE);
    e->index = malloc((size_t)s->count * 3 * sizeof *e->index);
    e->rays = malloc(((size_t)CLIFFS_RAYS << 2 * (e->input->steps - 1)) * sizeof *e->rays);
    if (!e->geometry || !e->index || !e->rays)
        return -1;
    rtcSetGeometryBuildQuality(e->geometry, RTC_BUILD_QUALITY_LOW);
    rtcSetSharedGeometryBuffer(e->geometry, RTC_BUFFER_TYPE_VERTEX, 0, spheres ? RTC_FORMAT_FLOAT4 : RTC_FORMAT_FLOAT3,
                               s->data, 0, spheres ? 16 : 12, spheres ? s->count : (size_t)3 * s->count);
    for (uint32_t i = 0; i < 3 * s->count && !spheres; i++)
        e->index[i] = i;
    if (!spheres)
        rtcSetSharedGeometryBuffer(e->geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, e->index, 0, 12, s->count);
    rtcAttachGeometry(e->scene, e->geometry);
    return 0;
}

int cliffs_measure_embree(const cliffs_settings *settings, const cliffs_input *input, cliffs_result *result)
{
    embree e = {.input = input, .device = rtcNewDevice("threads=1,set_affinity=0")};
    const cliffs_program program = {prepare, run, count_hits, &e};
    int code = -1;
    if (e.device && (e.scene = rtcNewScene(e.device)) != NULL) {
        rtcSetSceneFlags(e.scene, RTC_SCENE_FLAG_DYNAMIC);
        rtcSetSceneBuildQuality(e.scene, RTC_BUILD_QUALITY_LOW);
        code = make_geometry(&e);
    }
    if (code)
        program_error("Embree: no device or no memory");
    else
        code = commit(&e) || cliffs_measure(settings, input, &program, result);
    if (e.geometry)
        rtcReleaseGeometry(e.geometry);
    if (e.scene)
        rtcReleaseScene(e.scene);
    if (e.device)
        rtcReleaseDevice(e.device);
    free(e.index);
    free(e.rays);
    return code;
}

#else

bool cliffs_embree_is_here(void) { return false; }

int cliffs_measure_embree(const cliffs_settings *settings, const cliffs_input *input, cliffs_result *result)
{
    (void)settings;
    (void)input;
    memset(result, 0, sizeof *result);
    return 0;
}

#endif

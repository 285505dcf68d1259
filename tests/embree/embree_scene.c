/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes and rays for Embree. */
#include "embree/embree_scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define LARGEST 1.844e18f /* limit of rtcCommitScene's manual; builds with assertions also abort on rays beyond it */

static RTCDevice device;

static void report_error(void *user, enum RTCError code, const char *text)
{
    (void)user;
    fprintf(stderr, "Embree: error %d: %s\n", (int)code, text ? text : "");
}

bool embree_begin(void)
{
    device = rtcNewDevice("threads=1");
    if (!device) {
        report_error(NULL, rtcGetDeviceError(NULL), "no device");
        return false;
    }
    rtcSetDeviceErrorFunction(device, report_error, NULL);
    return true;
}

void embree_end(void) { rtcReleaseDevice(device); }

/* ---- scenes ---- */

/* Copies an array into a buffer of the geometry; false where Embree is out of memory. */
static bool fill(RTCGeometry geometry, enum RTCBufferType type, enum RTCFormat format, const void *data, size_t size,
                 uint32_t count)
{
    void *buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, size, count);
    if (buffer)
        memcpy(buffer, data, size * count);
    return buffer != NULL;
}

static bool add_geometry(RTCScene scene, const hard_geometry *g, uint32_t id)
{
    const bool flat = g->triangles != 0;
    RTCGeometry geometry = rtcNewGeometry(device, flat ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_SPHERE_POINT);
    if (!geometry)
        return false;
    const bool filled =
        flat ? fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, g->vertex, sizeof *g->vertex, g->vertices) &&
                   fill(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, g->index, sizeof *g->index, g->triangles)
             : fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, g->sphere, sizeof *g->sphere, g->spheres);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
    return filled;
}

bool embree_scene_make(const hard_scene *s, enum RTCSceneFlags flags, embree_scene *scene)
{
    bool made = true;
    *scene = (embree_scene){NULL, NULL};
    for (uint32_t g = 0; made && g < s->geometries; g++) {
        const hard_geometry *of = &s->geometry[g];
        RTCScene *kind = of->triangles ? &scene->triangles : &scene->spheres;
        if (!of->triangles && !of->spheres)
            continue;
        if (!*kind && (*kind = rtcNewScene(device)) != NULL)
            rtcSetSceneFlags(*kind, flags);
        made = *kind && add_geometry(*kind, of, g);
    }
    if (made && scene->spheres)
        rtcCommitScene(scene->spheres);
    if (made && scene->triangles)
        rtcCommitScene(scene->triangles);
    if (rtcGetDeviceError(device) == RTC_ERROR_NONE && made)
        return true;
    embree_scene_free(scene);
    return false;
}

void embree_scene_free(embree_scene *scene)
{
    if (scene->spheres)
        rtcReleaseScene(scene->spheres);
    if (scene->triangles)
        rtcReleaseScene(scene->triangles);
    *scene = (embree_scene){NULL, NULL};
}

/* ---- rays ---- */

struct RTCRayHit embree_query(const truth_ray *ray, float t_min, float t_max)
{
    return (struct RTCRayHit){.ray = {.org_x = ray->org[0],
                                      .org_y = ray->org[1],
                                      .org_z = ray->org[2],
                                      .dir_x = ray->dir[0],
                                      .dir_y = ray->dir[1],
                                      .dir_z = ray->dir[2],
                                      .tnear = t_min,
                                      .tfar = t_max,
                                      .mask = UINT32_MAX},
                              .hit = {.geomID = RTC_INVALID_GEOMETRY_ID, .primID = RTC_INVALID_GEOMETRY_ID}};
}

static full_hit trace_kind(RTCScene scene, const truth_ray *ray)
{
    struct RTCIntersectContext context;
    struct RTCRayHit query = embree_query(ray, ray->t_min, ray->t_max);
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    rtcIntersect1(scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return (full_hit){.t = INFINITY, .primitive = CGT_INVALID_ID, .geometry = CGT_INVALID_ID};
    return (full_hit){.t = query.ray.tfar,
                      .primitive = query.hit.primID,
                      .geometry = query.hit.geomID,
                      .uv = {query.hit.u, query.hit.v}};
}

full_hit embree_trace(const embree_scene *scene, const truth_ray *ray)
{
    full_hit best = {.t = INFINITY, .primitive = CGT_INVALID_ID, .geometry = CGT_INVALID_ID};
    if (scene->spheres)
        best = trace_kind(scene->spheres, ray);
    if (scene->triangles) {
        const full_hit other = trace_kind(scene->triangles, ray);
        if (other.geometry != CGT_INVALID_ID && !(best.t <= other.t))
            best = other;
    }
    return best;
}

/* ---- input that Embree does not accept ---- */

static bool all_within(const float *f, uint32_t count, float largest)
{
    for (uint32_t i = 0; i < count; i++)
        if (!(fabsf(f[i]) <= largest))
            return false;
    return true;
}

static bool takes_sphere(const float q[4])
{
    const float box[6] = {q[0] - q[3], q[1] - q[3], q[2] - q[3], q[0] + q[3], q[1] + q[3], q[2] + q[3]};
    return all_within(q, 4, LARGEST) && q[3] >= 0 && all_within(box, 6, LARGEST);
}

static bool takes_ray(const truth_ray *ray)
{
    const bool still = ray->dir[0] == 0 && ray->dir[1] == 0 && ray->dir[2] == 0;
    return all_within(ray->org, 3, LARGEST) && all_within(ray->dir, 3, LARGEST) && !still && ray->t_min >= 0 &&
           ray->t_max >= 0;
}

static void take_geometry(const hard_geometry *g, embree_part *part)
{
    hard_new_geometry(&part->scene);
    for (uint32_t i = 0; i < g->spheres; i++) {
        if (takes_sphere(g->sphere[i]))
            hard_raw_sphere(&part->scene, g->sphere[i]);
        else
            part->primitives++;
    }
    for (uint32_t i = 0; i < g->triangles; i++) {
        float v[3][3];
        for (int k = 0; k < 3; k++)
            memcpy(v[k], g->vertex[g->index[i][k]], sizeof v[k]);
        if (all_within(v[0], 9, LARGEST))
            hard_raw_triangle(&part->scene, (const float(*)[3])v);
        else
            part->primitives++;
    }
}

bool embree_part_make(const hard_scene *s, embree_part *part)
{
    *part = (embree_part){.scene = {.wanted = s->rays, .place = s->place}};
    memcpy(part->scene.resolution, s->resolution, sizeof s->resolution);
    for (uint32_t g = 0; g < s->geometries; g++)
        take_geometry(&s->geometry[g], part);
    for (uint32_t i = 0; i < s->rays; i++) {
        if (takes_ray(&s->ray[i]))
            hard_raw_ray(&part->scene, &s->ray[i]);
        else
            part->rays++;
    }
    return !part->scene.failed;
}

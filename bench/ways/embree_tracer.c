/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Embree's scenes over moving arrays, behind the interface of tracers. */
#include "ways/embree.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct embree_scene {
    RTCScene scene; /* this and the next four: of the tracer that builds */
    RTCGeometry geometry;
    float *moving;           /* padded, since Embree reads whole vectors */
    float *aimed;            /* dir and t_max of the rays from points to a light */
    uint64_t room;           /* rays of `aimed` */
    uint32_t packet;         /* of the camera's rays */
    embree_view view;        /* made by the first picture of its size */
    embree_arrays sink_rays; /* of a frame's secondary rays */
};

/* ---- device ---- */

/* The callbacks of spheres as user geometry, by the instruction set that Embree is limited to. */
static const struct {
    const char *isa;
    embree_callbacks callbacks;
} isas[] = {
#ifdef CGT_HAVE_AVX512
    {"avx512", {embree_sphere_intersect_avx512, embree_sphere_occluded_avx512}},
#endif
#ifdef CGT_HAVE_AVX2
    {"avx2", {embree_sphere_intersect_avx2, embree_sphere_occluded_avx2}},
#endif
#ifdef CGT_HAVE_SSE
    {"avx", {embree_sphere_intersect_sse, embree_sphere_occluded_sse}},
    {"sse4.2", {embree_sphere_intersect_sse, embree_sphere_occluded_sse}},
#endif
#ifdef CGT_HAVE_NEON
    {"neon", {embree_sphere_intersect_neon, embree_sphere_occluded_neon}},
#endif
#ifdef CGT_HAVE_PORTABLE
    {"portable", {embree_sphere_intersect_portable, embree_sphere_occluded_portable}},
#endif
};
enum { ISAS = sizeof isas / sizeof isas[0] };

int bench_embree_has_isa(const char *name)
{
    for (size_t i = 0; i < ISAS; i++)
        if (!strcmp(name, isas[i].isa))
            return 1;
    return 0;
}

int bench_embree_open(bench_session *session)
{
    const char *isa = session->settings->embree_isa;
    char text[128];
    if (session->device)
        return PROGRAM_OK;
    snprintf(text, sizeof text, "threads=%u,set_affinity=0%s%s", (unsigned)cgt_context_get_threads(session->context),
             isa ? ",max_isa=" : "", isa ? isa : "");
    session->device = rtcNewDevice(text);
    if (session->device)
        return PROGRAM_OK;
    program_error("Embree: no device, error %d", (int)rtcGetDeviceError(NULL));
    return PROGRAM_FAILED;
}

void bench_embree_close(bench_session *session)
{
    for (size_t i = 0; i < session->tracers; i++) {
        embree_scene *e = session->tracer[i].embree;
        if (e)
            embree_view_release(&e->view);
        free(e);
    }
    if (session->device)
        rtcReleaseDevice(session->device);
    session->device = NULL;
}

/* Rays of the widest packets that Embree has vectors for on this CPU, within its limit. */
static uint32_t native_packet(RTCDevice device)
{
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED))
        return 16;
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED))
        return 8;
    return rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED) ? 4 : 1;
}

/* Vectors as wide as Embree's packets. */
static embree_callbacks find_callbacks(const char *isa, uint32_t packet)
{
    const char *wanted = isa ? isa : packet == 16 ? "avx512" : packet == 8 ? "avx2" : "";
    for (size_t i = 0; i < ISAS; i++)
        if (!strcmp(wanted, isas[i].isa))
            return isas[i].callbacks;
    for (size_t i = 0; i < ISAS; i++) /* four lanes, which any CPU of the kind runs */
        if (strncmp(isas[i].isa, "avx", 3) != 0)
            return isas[i].callbacks;
    return isas[ISAS - 1].callbacks;
}

/* ---- scenes ---- */

static void sphere_bounds(const struct RTCBoundsFunctionArguments *a)
{
    const float *q = (const float *)a->geometryUserPtr + 4 * (size_t)a->primID;
    a->bounds_o->lower_x = q[0] - q[3];
    a->bounds_o->lower_y = q[1] - q[3];
    a->bounds_o->lower_z = q[2] - q[3];
    a->bounds_o->upper_x = q[0] + q[3];
    a->bounds_o->upper_y = q[1] + q[3];
    a->bounds_o->upper_z = q[2] + q[3];
}

static size_t element_bytes(const bench_input *input) { return (input->triangles ? 3 : 4) * sizeof(float); }

/* Memory for the moving elements as Embree requires it: readable beyond the end. */
static float *make_moving(const bench_input *input)
{
    const size_t whole = ((size_t)input->most * element_bytes(input) + 127) / 64 * 64;
    float *memory = aligned_alloc(64, whole);
    if (memory)
        memset(memory, 0, whole);
    return memory;
}

static int make_scene(bench_tracer *t, RTCDevice device)
{
    static const enum RTCBuildQuality of_geometry[] = {RTC_BUILD_QUALITY_LOW, RTC_BUILD_QUALITY_MEDIUM,
                                                       RTC_BUILD_QUALITY_REFIT};
    const bench_way *way = t->way;
    const bench_input *input = &t->session->input;
    const int user = way->user > 0;
    embree_scene *e = t->embree;
    e->moving = make_moving(input);
    e->scene = rtcNewScene(device);
    e->geometry = rtcNewGeometry(device, user               ? RTC_GEOMETRY_TYPE_USER
                                         : input->triangles ? RTC_GEOMETRY_TYPE_TRIANGLE
                                         : input->index     ? RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE
                                                            : RTC_GEOMETRY_TYPE_SPHERE_POINT);
    if (!e->moving || !e->scene || !e->geometry)
        return -1;
    /* the filter of four hits costs other queries a little: only where it is asked for */
    rtcSetSceneFlags(e->scene, RTC_SCENE_FLAG_DYNAMIC | (way->robust ? RTC_SCENE_FLAG_ROBUST : 0) |
                                   (t->session->settings->query[2] ? RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION : 0));
    rtcSetSceneBuildQuality(e->scene, way->quality == EMBREE_MEDIUM ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryBuildQuality(e->geometry, of_geometry[way->quality]);
    if (user) {
        const embree_callbacks callbacks = find_callbacks(t->session->settings->embree_isa, native_packet(device));
        rtcSetGeometryUserData(e->geometry, e->moving);
        rtcSetGeometryBoundsFunction(e->geometry, sphere_bounds, NULL);
        rtcSetGeometryIntersectFunction(e->geometry, callbacks.intersect);
        rtcSetGeometryOccludedFunction(e->geometry, callbacks.occluded);
    } else if (input->index) {
        rtcSetSharedGeometryBuffer(e->geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                   input->triangles ? RTC_FORMAT_UINT3 : RTC_FORMAT_UINT, input->index, 0,
                                   input->triangles ? 3 * sizeof(uint32_t) : sizeof(uint32_t),
                                   input->triangles ? input->triangles : input->most / 2);
    }
    rtcAttachGeometry(e->scene, e->geometry);
    return 0;
}

static int embree_open(bench_tracer *t)
{
    const bench_session *s = t->session;
    embree_scene *e = calloc(1, sizeof *e);
    t->embree = e;
    if (e) {
        t->held = UINT32_MAX;
        e->packet =
            t->way->packet == BENCH_NATIVE_PACKET || t->way->packet == 0 ? native_packet(s->device) : t->way->packet;
        if (t->built_by != t || make_scene(t, s->device) == 0)
            return PROGRAM_OK;
    }
    program_error("Embree: no scene, or out of memory");
    return PROGRAM_FAILED;
}

static void embree_close(bench_tracer *t)
{
    embree_scene *e = t->embree;
    if (!e)
        return;
    if (e->geometry)
        rtcReleaseGeometry(e->geometry);
    if (e->scene)
        rtcReleaseScene(e->scene);
    free(e->moving);
    free(e->aimed);
    e->geometry = NULL;
    e->scene = NULL;
    e->moving = e->aimed = NULL;
}

/* Copying the elements stands for the caller's simulation, and is not timed. */
static void embree_move(bench_tracer *t)
{
    const bench_session *s = t->session;
    if (t->built_by == t)
        memcpy(t->embree->moving, s->input.moving, (size_t)s->count * element_bytes(&s->input));
}

static int embree_commit(bench_tracer *t)
{
    const bench_session *s = t->session;
    const bench_input *input = &s->input;
    const embree_scene *e = t->embree;
    if (t->built_by != t)
        return PROGRAM_OK;
    if (t->way->user > 0 && s->count != t->held)
        rtcSetGeometryUserPrimitiveCount(e->geometry, s->count);
    else if (t->way->user <= 0 && s->count != t->held)
        rtcSetSharedGeometryBuffer(e->geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                   input->triangles ? RTC_FORMAT_FLOAT3 : RTC_FORMAT_FLOAT4, e->moving, 0,
                                   element_bytes(input), s->count);
    else if (t->way->user <= 0)
        rtcUpdateGeometryBuffer(e->geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    t->held = s->count;
    rtcCommitGeometry(e->geometry);
    rtcCommitScene(e->scene);
    struct RTCBounds bounds;
    rtcGetSceneBounds(e->scene, &bounds);
    memcpy(t->built.bounds_min, &bounds.lower_x, sizeof t->built.bounds_min);
    memcpy(t->built.bounds_max, &bounds.upper_x, sizeof t->built.bounds_max);
    const enum RTCError error = rtcGetDeviceError(s->device);
    if (error != RTC_ERROR_NONE)
        program_error("Embree: error %d", (int)error);
    return error == RTC_ERROR_NONE ? PROGRAM_OK : PROGRAM_FAILED;
}

/* ---- tracing ---- */

static int embree_picture(bench_tracer *t, const bench_planes *planes, bench_picture *picture)
{
    embree_scene *e = t->embree;
    const bench_camera_axes *axes = &t->session->axes;
    (void)planes;
    if (e->view.hits.memory && (e->view.axes.width != axes->width || e->view.axes.height != axes->height))
        embree_view_release(&e->view);
    if (!e->view.hits.memory && embree_view_create(&e->view, axes, e->packet)) {
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    e->view.picture = picture;
    embree_view_trace(&e->view, t->built_by->embree->scene, t->session->context);
    return PROGRAM_OK;
}

static void embree_planes(bench_tracer *t, const bench_planes *planes) { embree_view_planes(&t->embree->view, planes); }

/* Rays are made beforehand. */
static int embree_aim(bench_tracer *t, const bench_set *set, uint32_t which)
{
    embree_scene *e = t->built_by->embree;
    const uint64_t count = set->rays.count;
    if (set->query != BENCH_POINTS && set->query != BENCH_LIT_PICTURE)
        return PROGRAM_OK;
    const cgt_light *light = &set->light[which];
    const bool is_point = light->kind == CGT_LIGHT_POINT;
    if (e->room < count) {
        free(e->aimed);
        e->room = 0;
        e->aimed = calloc((size_t)count + 1, sizeof(float[4]));
        if (!e->aimed) {
            program_error("out of memory");
            return PROGRAM_FAILED;
        }
        e->room = count;
    }
    for (int a = 0; a < 3; a++)
        for (uint64_t i = 0; i < count; i++)
            e->aimed[(uint64_t)a * count + i] = light->position[a] - (is_point ? set->rays.org[a][i] : 0);
    for (uint64_t i = 0; i < count; i++)
        e->aimed[3 * count + i] = is_point ? 1 : INFINITY;
    return PROGRAM_OK;
}

static int embree_trace(bench_tracer *t, const bench_set *set, uint64_t first, uint64_t count, uint32_t light,
                        const bench_found *found, bench_counts *counts)
{
    const embree_scene *built = t->built_by->embree;
    const uint64_t all = set->rays.count;
    const int is_aimed = set->query == BENCH_POINTS || set->query == BENCH_LIT_PICTURE;
    const cgt_rays *const rays = set->embree ? set->embree : &set->rays;
    embree_arrays arrays = {.scene = built->scene,
                            .context = t->session->context,
                            .packet = count == 1 || set->one_by_one           ? 1
                                      : t->way->packet == BENCH_NATIVE_PACKET ? t->embree->packet
                                                                              : t->way->packet,
                            .coherent = t->way->coherent,
                            .nearest = set->query == BENCH_NEAREST || set->query == BENCH_FOUR,
                            .four = set->query == BENCH_FOUR};
    cgt_rays part = {.count = count};
    (void)counts;
    if (set->query == BENCH_PICTURE)
        return embree_picture(t, &found->planes, NULL);
    for (int a = 0; a < 3; a++) {
        part.org[a] = (is_aimed ? set->rays.org : rays->org)[a] + first;
        part.dir[a] = is_aimed ? built->aimed + (uint64_t)a * all + first : rays->dir[a] + first;
    }
    part.t_min = rays->t_min ? rays->t_min + first : NULL;
    part.t_max = is_aimed ? built->aimed + 3 * all + first : rays->t_max ? rays->t_max + first : NULL;
    embree_arrays_trace(&arrays, &part,
                        found->occluded + (is_aimed ? light * all : 0) + (arrays.four ? BENCH_FOUR_HITS : 1) * first);
    return PROGRAM_OK;
}

/* ---- a frame's secondary rays ---- */

static cgt_result sink_batch(void *user, const cgt_rays *batch, const cgt_hits *scratch, uint8_t *occluded)
{
    (void)scratch;
    embree_arrays_trace(user, batch, occluded);
    return CGT_OK;
}

static cgt_result sink_tile(void *user, const float light[3], const cgt_rays *tile, uint8_t *occluded)
{
    (void)light;
    embree_arrays_trace_here(user, tile, occluded);
    return CGT_OK;
}

/* Incoherent rays go in packets, or one by one. */
static bench_rays_sink embree_sink(bench_tracer *t, int coherent, int nearest, int form)
{
    embree_arrays *rays = &t->embree->sink_rays;
    *rays = (embree_arrays){.scene = t->built_by->embree->scene,
                            .context = t->session->context,
                            .packet = form ? 1 : t->embree->packet,
                            .coherent = coherent,
                            .nearest = nearest};
    return (bench_rays_sink){.batch = sink_batch, .tile = sink_tile, .wants_dir = 1, .user = rays};
}

const bench_engine bench_embree_engine = {embree_open,   embree_close, embree_move,  embree_commit, embree_picture,
                                          embree_planes, embree_aim,   embree_trace, embree_sink,   2};

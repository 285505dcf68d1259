/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes: options and geometries. Nothing is read from the caller's arrays here. */
#include "scene/scene.h"

#include <string.h>

#include "scene/bands.h"
#include "scene/check_geometry.h"

static cgt_geometry *geometry_at(const cgt_scene *scene, uint32_t id)
{
    cgt_geometry *geometry = scene->buffer[CGT_BUFFER_GEOMETRY].data;
    return id < scene->geometries && geometry[id].used ? &geometry[id] : NULL;
}

cgt_geometry *cgt_find_geometry(const cgt_scene *scene, uint32_t id)
{
    cgt_geometry *g = geometry_at(scene, id);
    if (!g)
        cgt_fail(scene->context, CGT_ERROR_INVALID_ARGUMENT, "geometry %u does not exist", id);
    return g;
}

void cgt_scene_options_init(cgt_scene_options *options) { *options = (cgt_scene_options){0}; }

void cgt_research_scene_options_init(cgt_research_scene_options *options)
{
    *options = (cgt_research_scene_options){0};
}

static cgt_result check_resolution(cgt_context *c, const uint32_t r[3])
{
    if ((!r[0] || !r[1] || !r[2]) && (r[0] || r[1] || r[2]))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "scene options: resolution %ux%ux%u: all three or none", r[0],
                        r[1], r[2]);
    if (r[0] > CGT_GRID_MAX_RESOLUTION || r[1] > CGT_GRID_MAX_RESOLUTION || r[2] > CGT_GRID_MAX_RESOLUTION ||
        (uint64_t)r[0] * r[1] * r[2] > CGT_GRID_MAX_CELLS)
        return cgt_fail(c, CGT_ERROR_TOO_LARGE, "scene options: resolution %ux%ux%u: at most %u an axis and %u cells",
                        r[0], r[1], r[2], CGT_GRID_MAX_RESOLUTION, CGT_GRID_MAX_CELLS);
    return CGT_OK;
}

/* The research options of options, or the defaults. */
static const cgt_research_scene_options *research_options(const cgt_scene_options *o)
{
    static const cgt_research_scene_options defaults = {0};
    return o->research ? o->research : &defaults;
}

static cgt_result check_options(cgt_context *c, const cgt_scene_options *o)
{
    const cgt_research_scene_options *r = research_options(o);
    const struct {
        const char *name;
        unsigned value, last;
    } option[] = {{"structure", o->structure, CGT_STRUCTURE_BIH},
                  {"rays", o->rays, CGT_RAY_KIND_INCOHERENT},
                  {"kd_layout", r->kd_layout, CGT_KD_LAYOUT_MIXED}};
    for (size_t i = 0; i < sizeof option / sizeof option[0]; i++)
        if (option[i].value > option[i].last)
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "scene options: %s %d is unknown", option[i].name,
                            (int)option[i].value);
    if (r->kd_break_level > CGT_MAX_BREAK_LEVEL)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "scene options: kd_break_level %u: at most %u",
                        r->kd_break_level, CGT_MAX_BREAK_LEVEL);
    return check_resolution(c, r->resolution);
}

static void set_options(cgt_scene *scene, const cgt_scene_options *o)
{
    scene->research_options = *research_options(o);
    scene->options = *o;
    scene->options.research = &scene->research_options;
    scene->frames_for_tree = 0;
    scene->expects_tree = false;
}

static cgt_result fail_null(cgt_context *c, const char *call)
{
    return c ? cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: an argument is NULL", call) : CGT_ERROR_INVALID_ARGUMENT;
}

cgt_result cgt_fail_null(const cgt_scene *scene, const char *call)
{
    return fail_null(scene ? scene->context : NULL, call);
}

cgt_result cgt_scene_create(cgt_context *context, const cgt_scene_options *options, cgt_scene **scene)
{
    static const cgt_scene_options defaults = {0};
    if (!context || !scene)
        return fail_null(context, __func__);
    *scene = NULL;
    if (context->failure != CGT_OK)
        return context->failure;
    const cgt_scene_options *o = options ? options : &defaults;
    const cgt_result result = check_options(context, o);
    if (result != CGT_OK)
        return result;
    cgt_scene *s = cgt_allocate(&context->memory, sizeof *s);
    if (!s)
        return cgt_fail(context, CGT_ERROR_OUT_OF_MEMORY, "out of memory for a scene");
    memset(s, 0, sizeof *s);
    s->context = context;
    set_options(s, o);
    s->mutable_scene = s;
    atomic_init(&s->bvh_state, CGT_BVH_STATE_NONE);
    atomic_init(&s->bvh_rays, 0);
    if (pthread_mutex_init(&s->reports_lock, NULL)) {
        cgt_free(&context->memory, s, sizeof *s);
        return cgt_fail(context, CGT_ERROR_THREADS, "the system refused a lock");
    }
    cgt_context_retain(context);
    *scene = s;
    return CGT_OK;
}

static void release_bands(const cgt_memory_hooks *memory, struct cgt_bands *bands)
{
    if (!bands)
        return;
    for (uint32_t i = 0; i < CGT_MAX_BANDS; i++) {
        cgt_scene_release(bands->band[i].scene);
        cgt_buffer_release(memory, &bands->band[i].points);
        cgt_buffer_release(memory, &bands->band[i].number);
    }
    cgt_buffer_release(memory, &bands->rest_number);
    cgt_buffer_release(memory, &bands->work_exponents);
    cgt_buffer_release(memory, &bands->work_offsets);
    cgt_free(memory, bands, sizeof *bands);
}

void cgt_scene_release(cgt_scene *scene)
{
    if (!scene)
        return;
    cgt_context *context = scene->context;
    for (size_t i = 0; i < CGT_SCENE_BUFFERS; i++)
        cgt_buffer_release(&context->memory, &scene->buffer[i]);
    release_bands(&context->memory, scene->bands);
    pthread_mutex_destroy(&scene->reports_lock);
    cgt_free(&context->memory, scene, sizeof *scene);
    cgt_context_release(context);
}

cgt_result cgt_scene_set_options(cgt_scene *scene, const cgt_scene_options *options)
{
    if (!scene || !options)
        return cgt_fail_null(scene, __func__);
    const cgt_result result = check_options(scene->context, options);
    if (result != CGT_OK)
        return result;
    set_options(scene, options);
    scene->is_committed = false;
    return CGT_OK;
}

/* Stores a checked description as geometry `id`, which exists or is the next one. */
static cgt_result set_geometry(cgt_scene *scene, uint32_t id, const cgt_geometry *geometry)
{
    const cgt_geometry *old = geometry_at(scene, id);
    const uint64_t sum = scene->primitives - (old ? cgt_geometry_count(old) : 0) + cgt_geometry_count(geometry);
    if (sum >= CGT_INVALID_ID)
        return cgt_fail(scene->context, CGT_ERROR_TOO_LARGE, "scene: %llu primitives in all: at most 2^32 - 2",
                        (unsigned long long)sum);
    if (id == scene->geometries) {
        const cgt_result grown = cgt_buffer_grow(&scene->context->memory, &scene->buffer[CGT_BUFFER_GEOMETRY],
                                                 (size_t)id + 1, sizeof(cgt_geometry));
        if (grown != CGT_OK)
            return cgt_fail(scene->context, grown, "out of memory for geometry %u", id);
        scene->geometries++;
    }
    ((cgt_geometry *)scene->buffer[CGT_BUFFER_GEOMETRY].data)[id] = *geometry;
    scene->primitives = sum;
    scene->is_committed = false;
    return CGT_OK;
}

static uint32_t free_id(cgt_scene *scene)
{
    while (scene->free_id < scene->geometries && geometry_at(scene, scene->free_id))
        scene->free_id++;
    return scene->free_id;
}

static cgt_result check_description(cgt_context *c, cgt_geometry *g)
{
    switch (g->kind) {
    case CGT_KIND_SPHERES: return cgt_check_spheres(c, &g->spheres);
    case CGT_KIND_CAPSULES: return cgt_check_capsules(c, &g->capsules);
    case CGT_KIND_TRIANGLES: break;
    }
    return cgt_check_triangles(c, &g->triangles);
}

/* Whether geometry `id` is there and of this kind. */
static cgt_result check_kind(const cgt_scene *scene, uint32_t id, cgt_kind kind)
{
    static const char *const name[] = {
        [CGT_KIND_SPHERES] = "spheres", [CGT_KIND_TRIANGLES] = "triangles", [CGT_KIND_CAPSULES] = "capsules"};
    const cgt_geometry *old = cgt_find_geometry(scene, id);
    if (!old)
        return CGT_ERROR_INVALID_ARGUMENT;
    if (old->kind != kind)
        return cgt_fail(scene->context, CGT_ERROR_INVALID_ARGUMENT, "geometry %u is one of %s", id, name[old->kind]);
    return CGT_OK;
}

/* Adds or replaces. */
static cgt_result set_description(cgt_scene *scene, uint32_t *geometry, cgt_geometry *g)
{
    const bool is_new = !geometry || *geometry == CGT_INVALID_ID;
    const uint32_t id = is_new ? free_id(scene) : *geometry;
    cgt_result result = is_new ? CGT_OK : check_kind(scene, id, g->kind);
    if (result == CGT_OK)
        result = check_description(scene->context, g);
    if (result == CGT_OK)
        result = set_geometry(scene, id, g);
    if (result == CGT_OK && geometry)
        *geometry = id;
    return result;
}

cgt_result cgt_scene_set_spheres(cgt_scene *scene, uint32_t *geometry, const cgt_spheres *spheres)
{
    if (!scene || !spheres)
        return cgt_fail_null(scene, __func__);
    cgt_geometry g = {.used = true, .kind = CGT_KIND_SPHERES, .spheres = *spheres};
    return set_description(scene, geometry, &g);
}

cgt_result cgt_scene_set_triangles(cgt_scene *scene, uint32_t *geometry, const cgt_triangles *triangles)
{
    if (!scene || !triangles)
        return cgt_fail_null(scene, __func__);
    cgt_geometry g = {.used = true, .kind = CGT_KIND_TRIANGLES, .triangles = *triangles};
    return set_description(scene, geometry, &g);
}

cgt_result cgt_scene_set_capsules(cgt_scene *scene, uint32_t *geometry, const cgt_capsules *capsules)
{
    if (!scene || !capsules)
        return cgt_fail_null(scene, __func__);
    cgt_geometry g = {.used = true, .kind = CGT_KIND_CAPSULES, .capsules = *capsules};
    return set_description(scene, geometry, &g);
}

cgt_result cgt_scene_remove_geometry(cgt_scene *scene, uint32_t geometry)
{
    if (!scene)
        return CGT_ERROR_INVALID_ARGUMENT;
    cgt_geometry *g = cgt_find_geometry(scene, geometry);
    if (!g)
        return CGT_ERROR_INVALID_ARGUMENT;
    scene->primitives -= cgt_geometry_count(g);
    scene->free_id = geometry < scene->free_id ? geometry : scene->free_id;
    g->used = false;
    scene->is_committed = false;
    return CGT_OK;
}

uint32_t cgt_scene_get_geometries(const cgt_scene *scene) { return scene ? scene->geometries : 0; }

static const cgt_geometry *find_kind(const cgt_scene *scene, uint32_t id, cgt_kind kind)
{
    const cgt_geometry *g = scene ? geometry_at(scene, id) : NULL;
    return g && g->kind == kind ? g : NULL;
}

bool cgt_scene_get_spheres(const cgt_scene *scene, uint32_t geometry, cgt_spheres *spheres)
{
    const cgt_geometry *g = find_kind(scene, geometry, CGT_KIND_SPHERES);
    if (g && spheres)
        *spheres = g->spheres;
    return g && spheres;
}

bool cgt_scene_get_triangles(const cgt_scene *scene, uint32_t geometry, cgt_triangles *triangles)
{
    const cgt_geometry *g = find_kind(scene, geometry, CGT_KIND_TRIANGLES);
    if (g && triangles)
        *triangles = g->triangles;
    return g && triangles;
}

bool cgt_scene_get_capsules(const cgt_scene *scene, uint32_t geometry, cgt_capsules *capsules)
{
    const cgt_geometry *g = find_kind(scene, geometry, CGT_KIND_CAPSULES);
    if (g && capsules)
        *capsules = g->capsules;
    return g && capsules;
}

void cgt_publish_statistics(cgt_scene *scene)
{
    pthread_mutex_lock(&scene->reports_lock);
    scene->reports = (cgt_scene_reports){scene->statistics, scene->research_statistics};
    pthread_mutex_unlock(&scene->reports_lock);
}

void cgt_publish_built_bvh(cgt_scene *scene)
{
    const cgt_scene_statistics before = scene->reports.statistics; /* only this thread changes them now */
    cgt_publish_statistics(scene);
    if (!scene->band_of)
        return;
    const cgt_scene_statistics *after = &scene->statistics;
    pthread_mutex_lock(&scene->band_of->reports_lock);
    cgt_scene_statistics *whole = &scene->band_of->reports.statistics;
    whole->structure_bytes += after->structure_bytes - before.structure_bytes;
    whole->bvh_bytes += after->bvh_bytes - before.bvh_bytes;
    whole->bytes += after->bytes - before.bytes;
    whole->bvh_build_ms += after->bvh_build_ms - before.bvh_build_ms;
    pthread_mutex_unlock(&scene->band_of->reports_lock);
}

cgt_result cgt_scene_get_statistics(const cgt_scene *scene, cgt_scene_statistics *statistics)
{
    if (!scene || !statistics)
        return cgt_fail_null(scene, __func__);
    pthread_mutex_lock(&scene->mutable_scene->reports_lock);
    *statistics = scene->reports.statistics;
    pthread_mutex_unlock(&scene->mutable_scene->reports_lock);
    return CGT_OK;
}

cgt_result cgt_research_get_scene_statistics(const cgt_scene *scene, cgt_research_scene_statistics *statistics)
{
    if (!scene || !statistics)
        return cgt_fail_null(scene, __func__);
    pthread_mutex_lock(&scene->mutable_scene->reports_lock);
    *statistics = scene->reports.research;
    pthread_mutex_unlock(&scene->mutable_scene->reports_lock);
    return CGT_OK;
}

static size_t bands_bytes(const struct cgt_bands *bands)
{
    size_t bytes = sizeof *bands + bands->rest_number.bytes + bands->work_exponents.bytes + bands->work_offsets.bytes;
    for (uint32_t i = 0; i < CGT_MAX_BANDS; i++) {
        const cgt_band *band = &bands->band[i];
        bytes += (band->scene ? cgt_scene_bytes(band->scene) : 0) + band->points.bytes + band->number.bytes;
    }
    return bytes;
}

size_t cgt_scene_bytes(const cgt_scene *scene)
{
    size_t bytes = sizeof *scene;
    for (size_t i = 0; i < CGT_SCENE_BUFFERS; i++)
        bytes += scene->buffer[i].bytes;
    return bytes + (scene->bands ? bands_bytes(scene->bands) : 0);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The table of calls, and a world for them. */
#include "api/calls.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "support/closed_meshes.h"

/* ---- the world ---- */

static void *take(unsigned char **from, size_t bytes)
{
    void *taken = *from;
    *from += bytes;
    return taken;
}

api_world api_world_make(uint64_t stream, uint32_t spheres, uint32_t rays, uint32_t width, uint32_t height)
{
    test_random r = random_make(stream);
    api_world w = {.spheres = spheres, .rays = rays, .width = width, .height = height, .samples = 2};
    closed_mesh mesh;
    assert_true(closed_mesh_make(&mesh, CLOSED_ICOSPHERE, 12));
    w.triangles = mesh.triangles;
    unsigned char *at = malloc(sizeof *w.sphere * spheres + 3 * sizeof *w.vertex * mesh.triangles + 24 * (size_t)rays);
    assert_non_null(w.memory = at);
    float(*sphere)[4] = take(&at, sizeof *sphere * spheres);
    float(*vertex)[3] = take(&at, 3 * sizeof *vertex * mesh.triangles);
    for (uint32_t i = 0; i < spheres; i++) {
        for (int a = 0; a < 3; a++)
            sphere[i][a] = random_float(&r, -1, 1);
        sphere[i][3] = random_float(&r, 0.001f, 0.05f);
    }
    for (uint32_t i = 0; i < 3 * mesh.triangles; i++)
        for (int a = 0; a < 3; a++)
            vertex[i][a] = (float)mesh.vertex[mesh.index[i / 3][i % 3]][a];
    closed_mesh_free(&mesh);
    for (int a = 0; a < 3; a++) {
        float *org = take(&at, sizeof *org * rays), *dir = take(&at, sizeof *dir * rays);
        for (uint32_t i = 0; i < rays; i++) {
            org[i] = random_float(&r, -1.5f, 1.5f);
            dir[i] = random_float(&r, -1, 1);
        }
        /* numbers that bounds in single precision do not cover */
        org[7] = a == 0 ? 0x1p100f : org[7];
        dir[8] = a == 1 ? 0x1p-140f : dir[8];
        w.org[a] = org;
        w.dir[a] = dir;
    }
    w.sphere = (const float(*)[4])sphere;
    w.vertex = (const float(*)[3])vertex;
    cgt_camera_init(&w.camera);
    w.camera.eye[0] = 0.5f;
    w.camera.eye[2] = 4;
    w.light[0] = (cgt_light){.kind = CGT_LIGHT_POINT, .position = {3, 4, 5}};
    w.light[1] = (cgt_light){.kind = CGT_LIGHT_DIRECTIONAL, .position = {1, 2, 3}};
    return w;
}

void api_world_free(api_world *w) { free(w->memory); }

cgt_scene *api_scene_make(const api_world *w, cgt_context *context, const cgt_scene_options *options)
{
    const cgt_spheres spheres = spheres_of(w->sphere, w->spheres), far = spheres_of(&w->far_sphere, 1);
    const cgt_triangles triangles = {
        .count = w->triangles, .vertex_count = 3 * w->triangles, .vertices = cgt_floats((const float *)w->vertex, 0)};
    cgt_scene *scene = NULL;
    if (cgt_scene_create(context, options, &scene) != CGT_OK)
        return NULL;
    if (cgt_scene_set_spheres(scene, NULL, &spheres) == CGT_OK &&
        cgt_scene_set_triangles(scene, NULL, &triangles) == CGT_OK &&
        (w->far_sphere[3] == 0 || cgt_scene_set_spheres(scene, NULL, &far) == CGT_OK))
        return scene;
    cgt_scene_release(scene);
    return NULL;
}

/* ---- results ---- */

#define SINGLE 64u /* rays that are traced one by one */

api_results *api_results_make(const api_world *w, cgt_scene *scene)
{
    const size_t pixels = (size_t)w->width * w->height, rays = w->rays, word = sizeof(uint32_t);
    api_results *r = calloc(1, sizeof *r);
    if (!r)
        return NULL;
    r->world = w;
    r->scene = scene;
    r->bytes = word * (9 * pixels + 20 * rays) + SINGLE * sizeof *r->single + 4 * rays + 2 * pixels +
               API_ALL_HITS * (rays + 1) * sizeof *r->all_hits + word * (2 * rays + 1);
    unsigned char *at = calloc(1, r->bytes);
    if (!at) {
        free(r);
        return NULL;
    }
    r->memory = at;
    cgt_frame_init(&r->frame, w->width, w->height);
    float **const frame[] = {&r->frame.t,         &r->frame.normal[0], &r->frame.normal[1],
                             &r->frame.normal[2], &r->frame.u,         &r->frame.v};
    float **const hits[] = {&r->hits.t,         &r->hits.normal[0], &r->hits.normal[1],
                            &r->hits.normal[2], &r->hits.u,         &r->hits.v};
    for (size_t k = 0; k < TEST_COUNT(frame); k++) {
        *frame[k] = take(&at, word * pixels);
        *hits[k] = take(&at, word * rays);
    }
    r->frame.primitive = take(&at, word * pixels);
    r->frame.geometry = take(&at, word * pixels);
    r->hits.primitive = take(&at, word * rays);
    r->hits.geometry = take(&at, word * rays);
    for (int a = 0; a < 3; a++) {
        r->bounced.org[a] = take(&at, word * rays);
        r->bounced.dir[a] = take(&at, word * rays);
    }
    r->bounced.t_max = take(&at, word * rays);
    r->bounced.skip_primitive = take(&at, word * rays);
    r->bounced.skip_geometry = take(&at, word * rays);
    r->bounced_hits.t = take(&at, word * rays);
    r->bounced_hits.primitive = take(&at, word * rays);
    r->bounced_hits.geometry = take(&at, word * rays);
    r->visibility = take(&at, word * pixels);
    r->single = take(&at, SINGLE * sizeof *r->single);
    r->all_hits = take(&at, API_ALL_HITS * (rays + 1) * sizeof *r->all_hits);
    r->all_count = take(&at, word * (2 * rays + 1));
    r->occluded_ray = take(&at, rays);
    r->inside = take(&at, rays);
    for (int k = 0; k < 2; k++) {
        r->occluded_point[k] = take(&at, rays);
        r->shadows[k] = take(&at, pixels);
    }
    return r;
}

void api_results_free(api_results *r)
{
    free(r->memory);
    free(r);
}

bool api_results_equal(const api_results *a, const api_results *b)
{
    return a->bytes == b->bytes && memcmp(a->memory, b->memory, a->bytes) == 0;
}

/* ---- the calls ---- */

static cgt_result commit(api_results *r) { return cgt_scene_commit(r->scene); }
static cgt_result prepare(api_results *r) { return cgt_scene_prepare(r->scene, CGT_RAY_KIND_INCOHERENT); }

static cgt_result trace_camera(api_results *r)
{
    return cgt_trace_camera(r->scene, &r->world->camera, &r->frame, NULL);
}

/* Into the depths alone, before the perspective camera writes all planes. */
static cgt_result trace_orthographic(api_results *r)
{
    cgt_camera c = r->world->camera;
    cgt_frame f;
    cgt_frame_init(&f, r->world->width, r->world->height);
    f.t = r->visibility;
    c.projection = CGT_PROJECTION_ORTHOGRAPHIC;
    c.height = 2;
    return cgt_trace_camera(r->scene, &c, &f, NULL);
}

static cgt_visit visit(void *user, const cgt_tile *tile)
{
    (void)tile;
    atomic_fetch_add((atomic_uint *)user, 1);
    return CGT_VISIT_CONTINUE;
}

static cgt_result trace_visitor(api_results *r)
{
    atomic_uint tiles = 0;
    cgt_frame f;
    cgt_frame_init(&f, r->world->width, r->world->height);
    f.visitor = visit;
    f.visitor_user = &tiles;
    f.visitor_fields = CGT_FIELD_T | CGT_FIELD_NORMAL | CGT_FIELD_UV | CGT_FIELD_PRIMITIVE | CGT_FIELD_POSITION;
    const cgt_result result = cgt_trace_camera(r->scene, &r->world->camera, &f, NULL);
    return result == CGT_OK && !tiles ? CGT_ERROR_STOPPED : result;
}

static cgt_result trace_one_by_one(api_results *r)
{
    const api_world *w = r->world;
    cgt_result result = CGT_OK;
    bool occluded = false;
    for (uint32_t i = 0; i < SINGLE && i < w->rays && result == CGT_OK; i++) {
        const cgt_single_ray ray = {.org = {w->org[0][i], w->org[1][i], w->org[2][i]},
                                    .dir = {w->dir[0][i], w->dir[1][i], w->dir[2][i]}};
        result = cgt_trace_ray(r->scene, &ray, &r->single[i], NULL);
        if (result == CGT_OK)
            result = cgt_occluded_ray(r->scene, &ray, &occluded, NULL);
        if (result == CGT_OK && occluded != (r->single[i].primitive != CGT_INVALID_ID))
            result = CGT_ERROR_STOPPED;
    }
    return result;
}

static cgt_result trace_points(api_results *r, int light, uint32_t count)
{
    const api_world *w = r->world;
    const cgt_points points = {.count = count < w->rays ? count : w->rays,
                               .position = {w->org[0], w->org[1], w->org[2]}};
    return cgt_occluded_points(r->scene, &w->light[light], &points, r->occluded_point[light], NULL);
}
static cgt_result trace_few_points(api_results *r) { return trace_points(r, 0, 100); }
static cgt_result trace_point_light(api_results *r) { return trace_points(r, 0, UINT32_MAX); }
static cgt_result trace_directional_light(api_results *r) { return trace_points(r, 1, UINT32_MAX); }

static cgt_result find_inside(api_results *r)
{
    const api_world *w = r->world;
    const cgt_points points = {.count = w->rays, .position = {w->org[0], w->org[1], w->org[2]}};
    return cgt_points_inside(r->scene, &points, NULL, r->inside, NULL);
}

static cgt_result trace_shadows(api_results *r)
{
    cgt_result result = CGT_OK;
    for (int k = 0; k < 2 && result == CGT_OK; k++)
        result = cgt_occluded_frame(r->scene, &r->world->camera, &r->frame, &r->world->light[k], 1, NULL, r->shadows[k],
                                    NULL);
    return result;
}

static cgt_rays rays_of(const api_world *w)
{
    return (cgt_rays){
        .count = w->rays, .org = {w->org[0], w->org[1], w->org[2]}, .dir = {w->dir[0], w->dir[1], w->dir[2]}};
}

static cgt_result trace_closest(api_results *r)
{
    const cgt_rays rays = rays_of(r->world);
    return cgt_trace_rays(r->scene, &rays, &r->hits, NULL);
}

static cgt_result trace_all_hits(api_results *r)
{
    const cgt_rays rays = rays_of(r->world);
    cgt_hit *h = r->all_hits;
    const cgt_hit_rows rows = {.capacity = API_ALL_HITS,
                               .hits = {.stride = sizeof *h, .t = &h->t, .primitive = &h->primitive},
                               .surface = &h->surface,
                               .count = r->all_count};
    const api_world *w = r->world;
    const cgt_single_ray ray = {.org = {w->org[0][0], w->org[1][0], w->org[2][0]},
                                .dir = {w->dir[0][0], w->dir[1][0], w->dir[2][0]}};
    const cgt_result result = cgt_trace_all_rays(r->scene, &rays, NULL, &rows, NULL);
    return result == CGT_OK ? cgt_trace_all_ray(r->scene, &ray, NULL, h + API_ALL_HITS * (size_t)w->rays, API_ALL_HITS,
                                                r->all_count + w->rays, NULL, NULL)
                            : result;
}

static cgt_visit count_hits(void *user, uint64_t ray, const cgt_hit *hits, uint32_t count)
{
    api_results *r = user;
    r->all_count[r->world->rays + 1 + ray] = count + hits[count - 1].primitive;
    return CGT_VISIT_CONTINUE;
}

static cgt_result visit_all_hits(api_results *r)
{
    const cgt_rays rays = rays_of(r->world);
    return cgt_visit_all_rays(r->scene, &rays, NULL, CGT_FIELD_NORMAL, count_hits, r, NULL);
}

/* What goes on from the closest hits. */
static cgt_result trace_bounced(api_results *r)
{
    const cgt_rays rays = rays_of(r->world);
    const cgt_bounced_rays *b = &r->bounced;
    const cgt_rays next = {.count = rays.count,
                           .org = {b->org[0], b->org[1], b->org[2]},
                           .dir = {b->dir[0], b->dir[1], b->dir[2]},
                           .t_max = b->t_max,
                           .skip_primitive = b->skip_primitive,
                           .skip_geometry = b->skip_geometry};
    const cgt_result result = cgt_bounce_rays(r->scene, &rays, &r->hits, NULL, NULL, b, NULL, NULL);
    return result == CGT_OK ? cgt_trace_bounced_rays(r->scene, &next, &r->bounced_hits, NULL) : result;
}

static cgt_result trace_any(api_results *r)
{
    const cgt_rays rays = rays_of(r->world);
    return cgt_occluded_rays(r->scene, &rays, r->occluded_ray, NULL);
}

static cgt_result trace_ambient(api_results *r)
{
    const cgt_ambient_options ambient = {.samples = r->world->samples};
    return cgt_ambient_occlusion(r->scene, &r->world->camera, &r->frame, &ambient, r->visibility, NULL);
}

const api_call api_calls[] = {{"commit", commit, true},
                              {"orthographic", trace_orthographic, false},
                              {"camera", trace_camera, false},
                              {"visitor", trace_visitor, false},
                              {"one ray", trace_one_by_one, false},
                              {"few points", trace_few_points, false},
                              {"point light", trace_point_light, false},
                              {"shadows", trace_shadows, false},
                              {"directional light", trace_directional_light, false},
                              {"closest", trace_closest, false},
                              {"bounced", trace_bounced, false},
                              {"any", trace_any, false},
                              {"all hits", trace_all_hits, false},
                              {"visited hits", visit_all_hits, false},
                              {"points inside", find_inside, false},
                              {"ambient", trace_ambient, false},
                              {"prepare", prepare, true},
                              {"point light, BVH", trace_point_light, false},
                              {"shadows, BVH", trace_shadows, false},
                              {"one ray, BVH", trace_one_by_one, false},
                              {"all hits, BVH", trace_all_hits, false},
                              {"second commit", commit, true}};
const size_t api_call_count = TEST_COUNT(api_calls);

cgt_result api_trace_all(api_results *r)
{
    cgt_result result = CGT_OK;
    for (size_t i = 0; i < api_call_count && result == CGT_OK; i++)
        result = api_calls[i].builds ? CGT_OK : api_calls[i].make(r);
    return result;
}

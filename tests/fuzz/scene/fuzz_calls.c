/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The calls beyond arrays and frames: single rays, points, shadows, rays of pixels, bounces, a BVH ahead of time, names
 * and defaults. Each is compared with the call that must find the same, and made without what it needs, too. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/all_hits.h>
#include <cgt/bounces.h>

#include "fuzz/scene/fuzz_check.h"

#define MOST 24u /* rays, points, columns */
#define LIGHTS 3u

static bool finite3(const float v[3]) { return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]); }

/* Options, and whether the scene can be traced with them. */
static bool any_options(fuzz_model *m, test_trace_options *o)
{
    bool legal;
    *o = fuzz_options(m, false, &legal);
    return legal && m->committed;
}

static uint32_t any_rays(fuzz_model *m, truth_ray ray[MOST])
{
    const uint32_t count = fuzz_below(&m->bytes, MOST + 1);
    truth_ray last = {.org = {0, 0, 4}, .dir = {0, 0, -1}, .t_max = INFINITY};
    for (uint32_t i = 0; i < count; i++) {
        const uint8_t range = fuzz_byte(&m->bytes);
        last = fuzz_any_ray(m, &last);
        last.t_min = range & 1 ? fuzz_float(&m->bytes) : 0;
        last.t_max = range & 2 ? fuzz_float(&m->bytes) : INFINITY;
        ray[i] = last;
    }
    return count;
}

static bool same_answer(const full_hit *a, const full_hit *b) { return !memcmp(a, b, sizeof *a); }

/* ---- single rays ---- */

#define MOST_HITS 256u

/* All hits of a ray. */
typedef struct all_hits {
    uint32_t count;
    cgt_hit hit[MOST_HITS];
} all_hits;

static void keep_hits(all_hits *all, const cgt_hit *hits, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++, all->count++)
        if (all->count < MOST_HITS)
            all->hit[all->count] = hits[i];
}

static cgt_visit visit_hits(void *user, uint64_t ray, const cgt_hit *hits, uint32_t count)
{
    (void)ray;
    keep_hits(user, hits, count);
    return CGT_VISIT_CONTINUE;
}

/* Some hits at a time, and all at once: the same ones, and the first is the nearest. */
static void check_all_hits(fuzz_model *m, const cgt_single_ray *ray, const cgt_rays *rays, const full_hit *nearest,
                           uint32_t capacity, const cgt_trace_options *o)
{
    static all_hits some, all;
    cgt_hit hit[8], last;
    cgt_all_hits_options after = {0};
    uint32_t count = 0;
    bool more = false;
    some.count = all.count = 0;
    do {
        FUZZ_MUST(m, cgt_trace_all_ray(m->scene, ray, &after, hit, capacity, &count, &more, o), true);
        FUZZ_CHECK(count <= capacity && (!more || count == capacity), "%u hits of %u and more", count, capacity);
        keep_hits(&some, hit, count);
        last = hit[count ? count - 1 : 0];
        after = (cgt_all_hits_options){
            .after_primitive = &last.primitive, .after_geometry = &last.geometry, .after_surface = &last.surface};
    } while (more && some.count < MOST_HITS);
    all.count = 0; /* a call that ran out of memory has visited none */
    FUZZ_MUST(m, cgt_visit_all_rays(m->scene, rays, NULL, CGT_FIELD_NORMAL | CGT_FIELD_UV, visit_hits, &all, o), true);
    FUZZ_CHECK(some.count == all.count || some.count >= MOST_HITS, "%u hits some at a time, %u at once", some.count,
               all.count);
    for (uint32_t i = 0; i < some.count && i < MOST_HITS; i++)
        FUZZ_CHECK(!memcmp(&some.hit[i], &all.hit[i], sizeof all.hit[i]), "hit %u is another one some at a time", i);
    /* the papers' own triangle tests have no error bound, and decide for cgt_trace_rays alone */
    const bool alike = !o || !o->research || o->research->triangle_test == CGT_TRIANGLE_TEST_AUTO;
    FUZZ_CHECK(!alike || (all.count > 0) == (nearest->primitive != CGT_INVALID_ID), "%u hits, nearest %u", all.count,
               nearest->primitive);
    const cgt_hit *h = &all.hit[0];
    const full_hit first = {h->t, h->primitive, h->geometry, {h->normal[0], h->normal[1], h->normal[2]}, {h->u, h->v}};
    FUZZ_CHECK(!all.count || !alike || same_answer(&first, nearest), "first hit %u.%u at %a, nearest %u.%u at %a",
               h->geometry, h->primitive, (double)h->t, nearest->geometry, nearest->primitive, (double)nearest->t);
}

static void one_ray(fuzz_model *m)
{
    test_trace_options o;
    truth_ray ray[MOST];
    const bool legal = any_options(m, &o);
    const uint32_t count = any_rays(m, ray), mask = fuzz_below(&m->bytes, 4), primitive = fuzz_below(&m->bytes, 8),
                   geometry = fuzz_below(&m->bytes, FUZZ_GEOMETRIES + 1);
    for (uint32_t i = 0; i < count; i++) {
        if (ray[i].t_max == 0) /* infinity in a single ray */
            ray[i].t_max = 1;
        cgt_rays rays = ray_array(&ray[i], 1);
        cgt_single_ray single = single_ray(&ray[i]);
        cgt_hit got;
        full_hit hit, expected;
        bool occluded = false;
        rays.mask = &mask;
        single.mask = mask;
        const cgt_hit skip = {.primitive = primitive, .geometry = geometry};
        single.skip = mask & 1 ? &skip : NULL;
        if (single.skip) {
            rays.skip_primitive = &primitive;
            rays.skip_geometry = &geometry;
        }
        const cgt_hits hits = hit_array(&expected);
        FUZZ_MUST(m, cgt_trace_ray(m->scene, &single, &got, TRACE_OPTIONS(&o)), legal);
        FUZZ_MUST(m, cgt_occluded_ray(m->scene, &single, &occluded, TRACE_OPTIONS(&o)), legal);
        FUZZ_MUST(m, cgt_trace_rays(m->scene, &rays, &hits, TRACE_OPTIONS(&o)), legal);
        if (legal)
            check_all_hits(m, &single, &rays, &expected, 1 + primitive, TRACE_OPTIONS(&o));
        if (!legal || o.precision == CGT_PRECISION_FAST)
            continue;
        hit = (full_hit){
            got.t, got.primitive, got.geometry, {got.normal[0], got.normal[1], got.normal[2]}, {got.u, got.v}};
        FUZZ_CHECK(same_answer(&hit, &expected), "one ray: %u.%u at %a, of an array %u.%u at %a", got.geometry,
                   got.primitive, (double)got.t, expected.geometry, expected.primitive, (double)expected.t);
        FUZZ_CHECK(occluded == (got.primitive != CGT_INVALID_ID), "one ray: occluded %d", (int)occluded);
    }
}

/* ---- points and lights ---- */

static cgt_light any_light(fuzz_model *m, bool *legal)
{
    const uint8_t kind = fuzz_byte(&m->bytes);
    cgt_light light = {.kind = kind > 250 ? (cgt_light_kind)2 : (cgt_light_kind)(kind & 1)};
    for (int a = 0; a < 3; a++)
        light.position[a] = fuzz_float(&m->bytes);
    const float *const p = light.position;
    *legal = kind <= 250 && finite3(p) && (light.kind == CGT_LIGHT_POINT || p[0] != 0 || p[1] != 0 || p[2] != 0);
    return light;
}

/* Points, and the same as rays to the light. Where such a direction is beyond the range of float the points alone know
 * what is between. */
static void points_to_light(fuzz_model *m)
{
    bool good;
    test_trace_options o;
    truth_ray ray[MOST];
    uint8_t occluded[MOST], expected[MOST];
    const bool legal = any_options(m, &o);
    const cgt_light light = any_light(m, &good);
    const uint32_t count = any_rays(m, ray), how = fuzz_byte(&m->bytes);
    const float end = light.kind == CGT_LIGHT_POINT ? 1 : INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        for (int a = 0; a < 3; a++)
            ray[i].dir[a] = light.kind == CGT_LIGHT_POINT ? light.position[a] - ray[i].org[a] : light.position[a];
        ray[i].t_max = how & 1 ? ray[i].t_max : end;
    }
    const cgt_rays rays = ray_array(ray, count);
    const cgt_points points = {.count = count,
                               .stride = rays.stride,
                               .position = {rays.org[0], rays.org[1], rays.org[2]},
                               .t_min = rays.t_min,
                               .t_max = how & 1 ? rays.t_max : NULL};
    FUZZ_MUST(m, cgt_occluded_points(m->scene, &light, &points, occluded, TRACE_OPTIONS(&o)), legal && good);
    FUZZ_MUST(m, cgt_occluded_rays(m->scene, &rays, expected, TRACE_OPTIONS(&o)), legal);
    for (uint32_t i = 0; i < count && legal && good; i++) {
        FUZZ_CHECK(occluded[i] <= 1 && (occluded[i] == 0 || finite3(ray[i].org)), "point %u: %u", i, occluded[i]);
        FUZZ_CHECK(o.precision == CGT_PRECISION_FAST || !finite3(ray[i].dir) || occluded[i] == expected[i],
                   "point %u: %u, its ray %u", i, occluded[i], expected[i]);
    }
}

/* ---- points inside ---- */

static cgt_visit add_sides(void *user, uint64_t ray, const cgt_hit *hits, uint32_t count)
{
    int *sum = user;
    for (uint32_t k = 0; k < count; k++)
        sum[ray] += hits[k].surface == CGT_SURFACE_FAR ? 1 : -1;
    return CGT_VISIT_CONTINUE;
}

/* Of spheres alone, rays from the points say the same, whichever way they go. */
static void points_inside(fuzz_model *m)
{
    truth_ray ray[MOST];
    uint8_t inside[MOST];
    int sum[MOST] = {0};
    const bool triangles = fuzz_has(m, CGT_KIND_TRIANGLES);
    const uint32_t count = any_rays(m, ray), rule = fuzz_below(&m->bytes, 3);
    const cgt_inside_options how = {.rule = (cgt_inside_rule)rule};
    const cgt_all_hits_options all = {.crossings = true};
    for (uint32_t i = 0; i < count; i++) {
        ray[i].t_min = 0;
        ray[i].t_max = INFINITY;
    }
    cgt_rays rays = ray_array(ray, count);
    const cgt_points points = {
        .count = count, .stride = rays.stride, .position = {rays.org[0], rays.org[1], rays.org[2]}};
    const bool crosses = m->committed && !fuzz_has(m, CGT_KIND_CAPSULES);
    FUZZ_MUST(m, cgt_points_inside(m->scene, &points, &how, inside, NULL), rule < 2 && crosses);
    FUZZ_MUST(m, cgt_visit_all_rays(m->scene, &rays, &all, 0, add_sides, sum, NULL), crosses);
    for (uint32_t i = 0; i < count && rule < 2 && crosses; i++) {
        FUZZ_CHECK(inside[i] <= 1 && (inside[i] == 0 || finite3(ray[i].org)), "point %u: inside %u", i, inside[i]);
        FUZZ_CHECK(triangles || sum[i] <= 0 || inside[i], "point %u: inside %u, its ray %d", i, inside[i], sum[i]);
    }
}

/* ---- frames: shadows, and rays of pixels ---- */

typedef struct lit_frame {
    cgt_frame frame;
    float t[MOST * MOST], position[3][MOST * MOST];
    uint32_t primitive[MOST * MOST], geometry[MOST * MOST];
    uint8_t shadow[LIGHTS * MOST * MOST], expected[MOST * MOST];
} lit_frame;

static lit_frame *lit_frame_make(fuzz_model *m)
{
    lit_frame *f = memset(fuzz_allocate(sizeof *f), 0x77, sizeof *f);
    cgt_frame_init(&f->frame, 1 + fuzz_below(&m->bytes, MOST), 1 + fuzz_below(&m->bytes, MOST));
    f->frame.t = f->t;
    f->frame.primitive = f->primitive;
    f->frame.geometry = f->geometry;
    for (int a = 0; a < 3; a++)
        f->frame.position[a] = f->position[a];
    return f;
}

/* The planes of a frame against its points, one light after the other. */
static void check_shadows(fuzz_model *m, const lit_frame *f, const cgt_light *light, uint32_t lights, float t_min,
                          const cgt_trace_options *options)
{
    const uint32_t pixels = f->frame.width * f->frame.height;
    float start[MOST * MOST];
    uint8_t expected[MOST * MOST];
    for (uint32_t i = 0; i < pixels; i++)
        start[i] = f->primitive[i] == CGT_INVALID_ID ? INFINITY : t_min;
    for (uint32_t l = 0; l < lights; l++) {
        const cgt_points points = {.count = pixels,
                                   .position = {f->position[0], f->position[1], f->position[2]},
                                   .t_min = start,
                                   .skip_primitive = f->primitive,
                                   .skip_geometry = f->geometry};
        FUZZ_MUST(m, cgt_occluded_points(m->scene, &light[l], &points, expected, options), true);
        for (uint32_t i = 0; i < pixels; i++)
            FUZZ_CHECK(f->shadow[l * pixels + i] == expected[i], "light %u, pixel %u: %u in a frame, %u as a point", l,
                       i, f->shadow[l * pixels + i], expected[i]);
    }
}

static void shadows(fuzz_model *m)
{
    bool good = true, each;
    test_trace_options o;
    cgt_light light[LIGHTS];
    cgt_shadow_options shadow;
    lit_frame *const f = lit_frame_make(m);
    const bool legal = any_options(m, &o);
    const uint32_t lights = fuzz_below(&m->bytes, LIGHTS + 1), damage = fuzz_byte(&m->bytes);
    cgt_camera camera = fuzz_any_camera(m);
    for (uint32_t l = 0; l < lights; l++) {
        light[l] = any_light(m, &each);
        good &= each;
    }
    cgt_shadow_options_init(&shadow);
    shadow.t_min = fuzz_float(&m->bytes);
    cgt_result result = CGT_ERROR_NOT_COMMITTED;
    if (legal)
        o.tile = CGT_TILE_SHAPE_AUTO; /* that arrays and frames both take */
    FUZZ_TRACE(m, result, cgt_trace_camera(m->scene, &camera, &f->frame, TRACE_OPTIONS(&o)));
    if (result != CGT_OK && legal) { /* most cameras of any numbers are refused */
        cgt_camera_init(&camera);
        FUZZ_TRACE(m, result, cgt_trace_camera(m->scene, &camera, &f->frame, TRACE_OPTIONS(&o)));
    }
    if (result == CGT_OK) {
        /* what a frame that is not the camera's may hold */
        for (uint32_t k = 0; k < damage % 8; k++)
            f->t[fuzz_word(&m->bytes) % (MOST * MOST)] = fuzz_float(&m->bytes);
        good &= shadow.t_min >= 0;
        cgt_camera seen = camera;
        seen.mask = 0;
        FUZZ_MUST(m,
                  cgt_occluded_frame(m->scene, &seen, &f->frame, light, lights, &shadow, f->shadow, TRACE_OPTIONS(&o)),
                  legal && good);
        if (legal && good && damage % 8 == 0 && o.precision == CGT_PRECISION_EXACT)
            check_shadows(m, f, light, lights, shadow.t_min, TRACE_OPTIONS(&o));
    }
    free(f);
}

static void rays_of_pixels(fuzz_model *m)
{
    float part[2][3][MOST * MOST], org[3], dir[3];
    const cgt_camera camera = fuzz_any_camera(m);
    const uint32_t width = fuzz_word(&m->bytes) % 70000, height = 1 + fuzz_below(&m->bytes, 200),
                   x = fuzz_below(&m->bytes, 200), y = fuzz_below(&m->bytes, 200),
                   columns = fuzz_below(&m->bytes, MOST + 1), rows = fuzz_below(&m->bytes, MOST + 1);
    float *const orgs[3] = {part[0][0], part[0][1], part[0][2]}, *const dirs[3] = {part[1][0], part[1][1], part[1][2]};
    const cgt_result all = cgt_camera_get_rays(&camera, width, height, x, y, columns, rows, 0, orgs, dirs);
    for (uint32_t i = 0; i < columns * rows; i++) {
        const cgt_result one = cgt_camera_get_ray(&camera, width, height, x + i % columns, y + i / columns, org, dir);
        FUZZ_CHECK(all != CGT_OK || one == CGT_OK, "pixel %u: %s", i, cgt_get_result_string(one));
        for (int a = 0; a < 3 && all == CGT_OK; a++)
            FUZZ_CHECK(same_bits(org[a], orgs[a][i]) && same_bits(dir[a], dirs[a][i]),
                       "pixel %u: its ray is another one than in a rectangle", i);
    }
}

/* ---- bounces ---- */

typedef struct bounced {
    float org[3][MOST], dir[3][MOST], t_max[MOST], t_min[MOST], share[MOST];
    uint32_t primitive[MOST], geometry[MOST];
} bounced;

static cgt_bounced_rays bounced_rays(bounced *b)
{
    return (cgt_bounced_rays){.org = {b->org[0], b->org[1], b->org[2]},
                              .dir = {b->dir[0], b->dir[1], b->dir[2]},
                              .t_max = b->t_max,
                              .t_min = b->t_min,
                              .skip_primitive = b->primitive,
                              .skip_geometry = b->geometry,
                              .share = b->share};
}

static void check_bounced(const bounced *b, uint32_t i)
{
    const double length = sqrt((double)b->dir[0][i] * b->dir[0][i] + (double)b->dir[1][i] * b->dir[1][i] +
                               (double)b->dir[2][i] * b->dir[2][i]);
    FUZZ_CHECK(fabs(length - 1) < 1e-6, "bounce %u: a direction of length %g", i, length);
    FUZZ_CHECK(b->share[i] >= 0 && b->share[i] <= 1 && b->t_min[i] == 0, "bounce %u: share %g", i, (double)b->share[i]);
    FUZZ_CHECK(b->t_max[i] >= 0 || (b->t_max[i] == -1 && b->primitive[i] == CGT_INVALID_ID && b->share[i] == 0),
               "bounce %u: t_max %a", i, (double)b->t_max[i]);
    FUZZ_CHECK(isfinite(b->org[0][i]) && isfinite(b->org[1][i]) && isfinite(b->org[2][i]), "bounce %u: origin", i);
}

/* Traces, bounces off what was hit or what a caller says was hit, and traces on. */
static void bounces(fuzz_model *m)
{
    truth_ray ray[MOST];
    full_hit hit[MOST];
    bounced mirrored, refracted;
    const uint32_t count = any_rays(m, ray), how = fuzz_byte(&m->bytes);
    const cgt_rays rays = ray_array(ray, count);
    const cgt_hits hits = hit_array(hit);
    const cgt_bounced_rays reflect = bounced_rays(&mirrored), refract = bounced_rays(&refracted);
    const cgt_media media = {.inside = fuzz_float(&m->bytes), .outside = fuzz_float(&m->bytes)};
    const bool legal =
        m->committed && isfinite(media.inside) && media.inside >= 0 && isfinite(media.outside) && media.outside >= 0;
    FUZZ_MUST(m, cgt_trace_rays(m->scene, &rays, &hits, NULL), m->committed);
    if (!m->committed)
        memset(hit, 0, sizeof hit);
    for (uint32_t i = 0; i < count && how & 1; i++) {
        hit[i].t = how & 2 ? fuzz_float(&m->bytes) : hit[i].t;
        hit[i].primitive = how & 4 ? fuzz_word(&m->bytes) : hit[i].primitive;
        hit[i].geometry = how & 8 ? fuzz_below(&m->bytes, FUZZ_GEOMETRIES + 2) : hit[i].geometry;
    }
    FUZZ_MUST(m, cgt_bounce_rays(m->scene, &rays, &hits, &media, NULL, &reflect, &refract, NULL), legal);
    for (uint32_t i = 0; i < count && legal; i++) {
        check_bounced(&mirrored, i);
        check_bounced(&refracted, i);
        FUZZ_CHECK(mirrored.share[i] + refracted.share[i] <= 1 + 0x1p-21f, "bounce %u: more light than there was", i);
    }
    for (int k = 0; k < 2 && legal; k++) {
        const bounced *const b = k ? &refracted : &mirrored;
        const cgt_rays on = {.count = count,
                             .org = {b->org[0], b->org[1], b->org[2]},
                             .dir = {b->dir[0], b->dir[1], b->dir[2]},
                             .t_max = b->t_max,
                             .skip_primitive = b->primitive,
                             .skip_geometry = b->geometry};
        FUZZ_MUST(m, cgt_trace_bounced_rays(m->scene, &on, &hits, NULL), true);
        for (uint32_t i = 0; i < count; i++)
            FUZZ_CHECK(b->t_max[i] >= 0 || hit[i].primitive == CGT_INVALID_ID, "bounce %u: is off, and hits", i);
    }
}

/* ---- the rest ---- */

static void prepare(fuzz_model *m)
{
    const uint32_t rays = fuzz_below(&m->bytes, 3);
    FUZZ_MUST(m, cgt_scene_prepare(m->scene, (cgt_ray_kind)rays), rays < 2 && m->committed);
}

/* What is asked of a context has an answer, and the defaults are good ones. */
static void names(fuzz_model *m)
{
    cgt_trace_options trace;
    cgt_research_trace_options research;
    cgt_ambient_options ambient;
    bool occluded;
    memset(&trace, 0xee, sizeof trace);
    memset(&research, 0xee, sizeof research);
    memset(&ambient, 0xee, sizeof ambient);
    cgt_trace_options_init(&trace);
    cgt_research_trace_options_init(&research);
    cgt_ambient_options_init(&ambient);
    trace.research = &research;
    const cgt_single_ray ray = {.dir = {0, 0, 1}};
    FUZZ_MUST(m, cgt_occluded_ray(m->scene, &ray, &occluded, &trace), m->committed);
    FUZZ_CHECK(ambient.radius >= 0 && ambient.samples <= 1024, "ambient: %u samples", ambient.samples);
    FUZZ_CHECK(cgt_get_version()[0] && cgt_context_get_variant(m->context)[0], "no name");
    FUZZ_CHECK(cgt_context_get_threads(m->context) <= 3, "%u threads", cgt_context_get_threads(m->context));
}

/* Each call without one of the things that it cannot do without. */
static void without(fuzz_model *m)
{
    truth_ray ray = {.dir = {0, 0, 1}, .t_max = 1};
    full_hit hit;
    uint8_t occluded[4];
    cgt_rays rays = ray_array(&ray, 1);
    cgt_hits hits = hit_array(&hit);
    const cgt_light light = {.position = {1, 2, 3}};
    cgt_points points = {.count = 1, .position = {&ray.org[0], &ray.org[1], &ray.org[2]}};
    const uint8_t which = fuzz_byte(&m->bytes);
    const int axis = which / 16 % 3;
    cgt_result result = CGT_OK;
    switch (which % 10) {
    case 0:
        rays.org[axis] = NULL;
        FUZZ_TRACE(m, result, cgt_trace_rays(m->scene, &rays, &hits, NULL));
        break;
    case 1:
        rays.stride = 3;
        FUZZ_TRACE(m, result, cgt_trace_rays(m->scene, &rays, &hits, NULL));
        break;
    case 2:
        hits.normal[axis] = NULL;
        FUZZ_TRACE(m, result, cgt_trace_rays(m->scene, &rays, &hits, NULL));
        break;
    case 3:
        rays.count = UINT64_MAX;
        FUZZ_TRACE(m, result, cgt_occluded_rays(m->scene, &rays, occluded, NULL));
        break;
    case 4:
        points.position[axis] = NULL;
        FUZZ_TRACE(m, result, cgt_occluded_points(m->scene, &light, &points, occluded, NULL));
        break;
    case 5: FUZZ_TRACE(m, result, cgt_occluded_points(m->scene, NULL, &points, occluded, NULL)); break;
    case 6: FUZZ_TRACE(m, result, cgt_trace_ray(m->scene, NULL, NULL, NULL)); break;
    case 7: FUZZ_TRACE(m, result, cgt_bounce_rays(m->scene, &rays, NULL, NULL, NULL, NULL, NULL, NULL)); break;
    case 8:
        rays.t_max = NULL;
        FUZZ_TRACE(m, result, cgt_trace_bounced_rays(m->scene, &rays, &hits, NULL));
        break;
    default: FUZZ_TRACE(m, result, cgt_trace_camera(m->scene, NULL, NULL, NULL)); break;
    }
    FUZZ_CHECK(result == CGT_ERROR_INVALID_ARGUMENT || result == CGT_ERROR_TOO_LARGE ||
                   (!m->committed && result == CGT_ERROR_NOT_COMMITTED),
               "call %u without what it needs: %s", which % 10, cgt_get_result_string(result));
    fuzz_check_error(m, result);
}

void fuzz_call(fuzz_model *m)
{
    static void (*const calls[])(fuzz_model *) = {one_ray,        points_to_light, points_inside, shadows, bounces,
                                                  rays_of_pixels, prepare,         names,         without};
    calls[fuzz_below(&m->bytes, sizeof calls / sizeof calls[0])](m);
}

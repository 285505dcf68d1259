/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of a camera, into planes and to a visitor, compared with the same rays as an array. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "query/camera.h"
#include "fuzz/scene/fuzz_check.h"

#define MOST_EDGE 24u

cgt_camera fuzz_any_camera(fuzz_model *m)
{
    cgt_camera c;
    cgt_camera_init(&c);
    const uint8_t how = fuzz_byte(&m->bytes);
    c.projection = how == 255 ? (cgt_projection)7 : how & 1 ? CGT_PROJECTION_ORTHOGRAPHIC : CGT_PROJECTION_PERSPECTIVE;
    for (int k = 0; k < 3; k++) {
        c.eye[k] = fuzz_float(&m->bytes);
        c.target[k] = how & 2 ? fuzz_float(&m->bytes) : 0;
        c.up[k] = how & 4 ? fuzz_float(&m->bytes) : c.up[k];
    }
    if (how & 8) {
        c.fov = fuzz_float(&m->bytes) * 4;
        c.height = fuzz_float(&m->bytes);
    }
    if (how & 16) {
        c.t_min = fuzz_float(&m->bytes);
        c.t_max = fuzz_float(&m->bytes);
    }
    return c;
}

/* ---- planes ---- */

#define PLANES 8

typedef struct planes {
    size_t row_stride; /* elements */
    uint32_t width, height;
    uint32_t *plane[PLANES]; /* in the order of full_hit */
} planes;

static planes make_planes(fuzz_model *m, uint32_t width, uint32_t height)
{
    planes p = {.row_stride = width + fuzz_below(&m->bytes, 4), .width = width, .height = height};
    const size_t bytes = p.row_stride * height * sizeof(uint32_t);
    for (int k = 0; k < PLANES; k++)
        p.plane[k] = memset(fuzz_allocate(bytes), 0xcd, bytes);
    return p;
}

static void free_planes(planes *p)
{
    for (int k = 0; k < PLANES; k++)
        free(p->plane[k]);
}

static cgt_frame frame_into(const planes *p)
{
    cgt_frame f;
    cgt_frame_init(&f, p->width, p->height);
    f.row_stride = p->row_stride;
    f.t = (float *)(void *)p->plane[0];
    f.primitive = p->plane[1];
    f.geometry = p->plane[2];
    for (int k = 0; k < 3; k++)
        f.normal[k] = (float *)(void *)p->plane[3 + k];
    f.u = (float *)(void *)p->plane[6];
    f.v = (float *)(void *)p->plane[7];
    return f;
}

static void take_pixels(const planes *p, full_hit *hit)
{
    for (uint32_t y = 0; y < p->height; y++)
        for (size_t x = 0; x < p->row_stride; x++)
            for (int k = 0; k < PLANES; k++) {
                const uint32_t *at = &p->plane[k][y * p->row_stride + x];
                if (x < p->width)
                    memcpy((float *)(void *)&hit[y * p->width + x] + k, at, sizeof *at);
                else
                    FUZZ_CHECK(*at == 0xcdcdcdcd, "frame: an element past the row is written");
            }
}

/* ---- visitor ---- */

typedef struct visit {
    const planes *planes;
    uint8_t *seen; /* number of visits of each pixel; tiles are disjoint */
    bool stop;
} visit;

/* Checks that a visitor's tile holds the values of the planes. */
static cgt_visit visitor(void *user, const cgt_tile *tile)
{
    const visit *const v = user;
    const planes *const p = v->planes;
    const void *const at[PLANES] = {tile->t,         tile->primitive, tile->geometry, tile->normal[0],
                                    tile->normal[1], tile->normal[2], tile->u,        tile->v};
    FUZZ_CHECK(tile->width && tile->height && tile->x + tile->width <= p->width && tile->y + tile->height <= p->height,
               "tile %u %u %u %u in a frame of %u %u", tile->x, tile->y, tile->width, tile->height, p->width,
               p->height);
    for (uint32_t j = 0; j < tile->height; j++)
        for (uint32_t i = 0; i < tile->width; i++) {
            const size_t pixel = (size_t)(tile->y + j) * p->width + tile->x + i;
            v->seen[pixel]++;
            for (int k = 0; k < PLANES; k++) {
                const uint32_t *plane = &p->plane[k][(tile->y + j) * p->row_stride + tile->x + i];
                FUZZ_CHECK(at[k] && !memcmp((const uint32_t *)at[k] + j * tile->row_stride + i, plane, sizeof *plane),
                           "tile: plane %d differs from the frame's", k);
            }
        }
    return v->stop ? CGT_VISIT_STOP : CGT_VISIT_CONTINUE;
}

static void trace_visited(fuzz_model *m, const cgt_camera *camera, const planes *p, const test_trace_options *o)
{
    const size_t pixels = (size_t)p->width * p->height;
    visit v = {.planes = p, .seen = memset(fuzz_allocate(pixels), 0, pixels), .stop = fuzz_byte(&m->bytes) > 240};
    cgt_frame frame = frame_into(p);
    frame.visitor = visitor;
    frame.visitor_user = &v;
    frame.visitor_fields = 31;
    cgt_result result;
    FUZZ_TRACE(m, result, cgt_trace_camera(m->scene, camera, &frame, TRACE_OPTIONS(o)));
    FUZZ_CHECK(result == (v.stop ? CGT_ERROR_STOPPED : CGT_OK), "frame: %s", cgt_get_result_string(result));
    for (size_t i = 0; i < pixels && !v.stop; i++)
        FUZZ_CHECK(v.seen[i] == 1, "pixel %zu is visited %u times", i, v.seen[i]);
    free(v.seen);
}

/* ---- the whole ---- */

/* The frame's rays, as an array. */
static void trace_as_array(fuzz_model *m, const fuzz_answers *a)
{
    cgt_result result;
    FUZZ_TRACE(m, result, trace_array(m->scene, a->ray, a->count, a->exact, NULL));
    FUZZ_CHECK(result == CGT_OK, "the rays cannot be traced");
}

static void check_frame(fuzz_model *m, const cgt_camera *camera, const cgt_camera_rays *prepared, const planes *p,
                        test_trace_options *o, uint8_t how)
{
    cgt_trace_statistics statistics;
    cgt_research_trace_statistics research;
    const uint32_t count = p->width * p->height;
    truth_ray *ray = fuzz_allocate(count * sizeof *ray);
    for (uint32_t i = 0; i < count; i++)
        ray[i] = camera_ray(prepared, i % p->width, i / p->width);
    fuzz_answers a = fuzz_answers_make(ray, count);
    o->statistics = &statistics;
    o->research_statistics = &research;
    const cgt_frame frame = frame_into(p);
    cgt_result result;
    FUZZ_TRACE(m, result, cgt_trace_camera(m->scene, camera, &frame, TRACE_OPTIONS(o)));
    FUZZ_CHECK(result == CGT_OK, "frame: %s", cgt_get_result_string(result));
    take_pixels(p, a.other);
    fuzz_check_hits(m, &a, a.other, o->precision);
    fuzz_check_counts(&a, a.other, &statistics, &research);
    o->statistics = NULL;
    o->research_statistics = NULL;
    trace_as_array(m, &a);
    fuzz_check_same(m, &a, o->precision);
    if ((how & 3) == 3) {
        judge_ray *const rays = fuzz_allocate(count * sizeof *rays);
        for (uint32_t i = 0; i < count; i++)
            rays[i] = fuzz_judge_ray(&ray[i]);
        fuzz_check_truth(m, rays, count, a.exact);
        free(rays);
    }
    fuzz_answers_free(&a);
    free(ray);
}

/* The ambient openness of a traced frame, with options from the bits of a byte that nothing else reads. */
static void trace_ambient(fuzz_model *m, const cgt_camera *camera, const planes *p, test_trace_options *o, uint8_t how)
{
    static const uint32_t samples[] = {1, 3, 16, 100};
    const size_t elements = p->row_stride * p->height;
    float *open = memset(fuzz_allocate(elements * sizeof *open), 0xff, elements * sizeof *open); /* NaN */
    const cgt_ambient_options ambient = {
        .samples = samples[how >> 3 & 3], .radius = how & 32 ? 1.5f : INFINITY, .seed = how >> 6};
    const cgt_frame frame = frame_into(p);
    cgt_trace_statistics statistics;
    uint64_t hits = 0;
    o->statistics = &statistics;
    cgt_result result;
    FUZZ_TRACE(m, result, cgt_ambient_occlusion(m->scene, camera, &frame, &ambient, open, TRACE_OPTIONS(o)));
    FUZZ_CHECK(result == CGT_OK, "ambient: %s", cgt_get_result_string(result));
    o->statistics = NULL;
    for (size_t i = 0; i < elements; i++) {
        const bool inside = i % p->row_stride < p->width, hit = inside && frame.primitive[i] != CGT_INVALID_ID;
        hits += hit;
        FUZZ_CHECK(inside ? open[i] >= 0 && open[i] <= 1 : isnan(open[i]), "ambient: element %zu is %g", i,
                   (double)open[i]);
        FUZZ_CHECK(!inside || hit || open[i] == 1, "ambient: element %zu without a hit is %g", i, (double)open[i]);
    }
    FUZZ_CHECK(statistics.rays == hits * ambient.samples, "ambient: %llu rays", (unsigned long long)statistics.rays);
    free(open);
}

void fuzz_trace_camera(fuzz_model *m)
{
    char message[160];
    bool legal;
    cgt_camera_rays prepared;
    const uint8_t how = fuzz_byte(&m->bytes);
    const cgt_camera camera = fuzz_any_camera(m);
    const uint32_t width = 1 + fuzz_below(&m->bytes, MOST_EDGE), height = 1 + fuzz_below(&m->bytes, MOST_EDGE / 2);
    test_trace_options o = fuzz_options(m, true, &legal);
    planes p = make_planes(m, width, height);
    legal &= cgt_camera_prepare(&camera, width, height, &prepared, message) == CGT_OK;
    const cgt_frame frame = frame_into(&p);
    if (!m->committed || !legal) {
        cgt_result result;
        FUZZ_TRACE(m, result, cgt_trace_camera(m->scene, &camera, &frame, TRACE_OPTIONS(&o)));
        FUZZ_CHECK((!legal && result == CGT_ERROR_INVALID_ARGUMENT) ||
                       (!legal && result == CGT_ERROR_UNSUPPORTED && fuzz_has(m, CGT_KIND_CAPSULES)) ||
                       (!m->committed && result == CGT_ERROR_NOT_COMMITTED),
                   "frame: %s", cgt_get_result_string(result));
        fuzz_check_error(m, result);
    } else {
        check_frame(m, &camera, &prepared, &p, &o, how);
        trace_ambient(m, &camera, &p, &o, how);
        if (how & 4)
            trace_visited(m, &camera, &p, &o);
    }
    free_planes(&p);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera's frame, by rows, with odd strides, and its rays as an array. The rays are those of cgt_camera_get_rays;
 * what they hit is judged. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "driver/calls/view.h"

struct driver_view *driver_view_make(void) { return malloc(sizeof(driver_view)); }

/* ---- the camera ---- */

/* Along an axis or a diagonal, from outside or away from it, where the scene is behind. */
static void look_along(judge_scene *s, cgt_camera *c)
{
    test_random *r = &s->random;
    const float far = s->scale * (random_below(r, 4) ? 3 : -3);
    float d[3] = {0, 0, 0};
    while (d[0] == 0 && d[1] == 0 && d[2] == 0)
        for (int a = 0; a < 3; a++)
            d[a] = (float)random_below(r, 3) - 1;
    for (int a = 0; a < 3; a++) {
        c->target[a] = s->middle[a];
        c->eye[a] = s->middle[a] - far * d[a];
        c->target[a] += far < 0 ? -2 * far * d[a] : 0;
        c->up[a] = d[(a + 1) % 3] != 0 && d[a] == 0 ? 1 : 0.25f * (float)a;
    }
}

static void make_camera(driver_run *run, driver_view *w)
{
    static const float fov[] = {1e-4f, 0.1f, 90, 150, 175, 179, 179.9f, 179.999f};
    judge_scene *s = &run->scene;
    test_random *r = &s->random;
    const uint32_t how = random_below(r, 6);
    cgt_camera *c = &w->camera;
    cgt_camera_init(c);
    line_place(s, c->target);
    for (int a = 0; a < 3; a++)
        c->eye[a] = how > 1 ? 3 * s->scale * line_gauss(r) : c->target[a] + (a == 2 ? 3 * s->scale : 0);
    if (how == 1)
        line_place(s, c->eye);
    if (how > 3)
        line_place_beside(s, c->target, c->eye);
    if (random_below(r, 3) == 0)
        random_direction(r, c->up);
    if (random_below(r, 6) == 0)
        look_along(s, c);
    c->fov = random_below(r, 4) ? random_float(r, 5, 130) : fov[random_below(r, TEST_COUNT(fov))];
    c->projection = random_below(r, 3) ? CGT_PROJECTION_PERSPECTIVE : CGT_PROJECTION_ORTHOGRAPHIC;
    c->height = s->scale * random_float(r, 0.1f, 4);
    c->mask = random_below(r, 5) ? 0 : random_below(r, 16);
    if (random_below(r, 4) == 0)
        c->t_min = random_float(r, 0, 4);
    if (random_below(r, 4) == 0)
        c->t_max = c->t_min + random_float(r, 0, 4);
    w->width = 2 + random_below(r, random_below(r, 3) ? 30 : 120);
    w->height = 1 + random_below(r, DRIVER_PIXELS / w->width < 24 ? DRIVER_PIXELS / w->width : 24);
    if (random_below(r, 4) == 0) { /* tall */
        const uint32_t width = w->width;
        w->width = w->height;
        w->height = width;
    }
    w->pixels = w->width * w->height;
}

static void find_pixels(driver_run *run, driver_view *w)
{
    float org[3][DRIVER_PIXELS], dir[3][DRIVER_PIXELS];
    w->has_rays = cgt_camera_get_rays(&w->camera, w->width, w->height, 0, 0, w->width, w->height, 0,
                                      (float *const[]){org[0], org[1], org[2]},
                                      (float *const[]){dir[0], dir[1], dir[2]}) == CGT_OK;
    for (uint32_t i = 0; i < w->pixels && w->has_rays; i++) {
        w->ray[i] = (judge_ray){.mask = w->camera.mask, .skip_primitive = ORACLE_NONE, .skip_geometry = ORACLE_NONE};
        for (int a = 0; a < 3; a++) {
            w->ray[i].line.org[a] = org[a][i];
            w->ray[i].line.dir[a] = dir[a][i];
        }
        w->ray[i].line.t_min = w->camera.t_min;
        w->ray[i].line.t_max = w->camera.t_max == 0 ? INFINITY : w->camera.t_max;
        w->right[i] = driver_trace(run, &w->ray[i], JUDGE_NEAREST, i % 4 == 0);
        run->count[COUNT_PIXELS]++;
        run->count[COUNT_SEEN] += w->right[i].count > 0;
    }
}

/* ---- frames ---- */

static cgt_frame dense_frame(driver_view *w)
{
    frame_planes *p = &w->got;
    cgt_frame f;
    cgt_frame_init(&f, w->width, w->height);
    f.t = p->t;
    f.primitive = p->primitive;
    f.geometry = p->geometry;
    f.u = p->u;
    f.v = p->v;
    for (int a = 0; a < 3; a++) {
        f.normal[a] = p->normal[a];
        f.position[a] = p->position[a];
    }
    return f;
}

static void judge_pixel(driver_run *run, driver_view *w, uint32_t i, bool fast)
{
    const frame_planes *p = &w->got;
    const judge_answer answer = {p->t[i],
                                 p->primitive[i],
                                 p->geometry[i],
                                 {p->normal[0][i], p->normal[1][i], p->normal[2][i]},
                                 {p->u[i], p->v[i]}};
    const char *wrong = judge_nearest(&run->scene, &run->pool, &w->right[i], &w->ray[i], fast, &answer);
    float place[3] = {INFINITY, INFINITY, INFINITY};
    run->count[COUNT_ANSWERS]++;
    if (driver_is_hit(w, i))
        driver_position(w, i, place);
    for (int a = 0; a < 3 && !wrong; a++)
        if (!same_bits(place[a], p->position[a][i]))
            wrong = "the position is not org + t dir";
    if (wrong)
        driver_fail(run, &w->ray[i], "cgt_trace_camera", "pixel %u, %u of %ux%u: %s: %d.%d at %a",
                    (unsigned)(i % w->width), (unsigned)(i / w->width), (unsigned)w->width, (unsigned)w->height, wrong,
                    (int)p->geometry[i], (int)p->primitive[i], (double)p->t[i]);
}

/* The rows in two calls; those that are not asked for stay. */
static bool trace_rows(driver_run *run, driver_view *w, cgt_frame frame, cgt_precision precision)
{
    cgt_trace_statistics statistics = {0};
    cgt_research_trace_statistics research = {0};
    test_trace_options o = driver_options(run, precision);
    o.packet = o.cull ? 4u << random_below(&run->scene.random, 3) : 0;
    o.tile = o.packet == 4 ? CGT_TILE_SHAPE_STRIP : CGT_TILE_SHAPE_AUTO;
    o.statistics = &statistics;
    o.research_statistics = &research;
    const uint32_t cut = random_below(&run->scene.random, w->height + 1);
    memset(&w->got, 0x77, sizeof w->got);
    if (cut && cut < w->height) {
        frame.row_count = cut;
        if (!driver_succeeds(run, cgt_trace_camera(run->setup.scene, &w->camera, &frame, TRACE_OPTIONS(&o)),
                             "cgt_trace_camera"))
            return false;
        driver_count(run, &statistics);
        for (uint32_t i = cut * w->width; i < w->pixels; i++)
            if (w->got.primitive[i] != 0x77777777u)
                driver_fail(run, NULL, "cgt_trace_camera", "a row is written that nobody asked for");
        frame.first_row = cut;
        frame.row_count = 0;
    }
    if (!driver_succeeds(run, cgt_trace_camera(run->setup.scene, &w->camera, &frame, TRACE_OPTIONS(&o)),
                         "cgt_trace_camera"))
        return false;
    driver_count(run, &statistics);
    run->count[COUNT_SPLIT] += research.split_packets;
    return true;
}

/* Planes of triples, with gaps between rows, must have the same bits. */
static void check_strides(driver_run *run, driver_view *w)
{
    static float t[2 * DRIVER_PIXELS], normal[6 * DRIVER_PIXELS];
    const size_t row = w->width + random_below(&run->scene.random, w->width);
    cgt_frame f;
    cgt_frame_init(&f, w->width, w->height);
    f.row_stride = row;
    f.vector_stride = 3;
    f.t = t;
    for (int a = 0; a < 3; a++)
        f.normal[a] = normal + a;
    if (!driver_succeeds(run, cgt_trace_camera(run->setup.scene, &w->camera, &f, NULL), "cgt_trace_camera"))
        return;
    for (uint32_t i = 0; i < w->pixels; i++) {
        const size_t at = i / w->width * row + i % w->width;
        bool same = same_bits(t[at], w->got.t[i]);
        for (uint32_t a = 0; a < 3; a++)
            same &= same_bits(normal[3 * at + a], w->got.normal[a][i]);
        if (!same)
            driver_fail(run, &w->ray[i], "cgt_trace_camera", "not the same bits in planes with gaps");
    }
}

/* The same rays in an array give the same bits; any-hit the same hits. */
static void check_rays(driver_run *run, driver_view *w)
{
    static full_hit hit[DRIVER_PIXELS];
    static uint8_t occluded[DRIVER_PIXELS];
    const judge_ray *const r = w->ray;
    const cgt_hits hits = hit_array(hit);
    const cgt_rays rays = {.count = w->pixels,
                           .stride = sizeof *r,
                           .org = {&r->line.org[0], &r->line.org[1], &r->line.org[2]},
                           .dir = {&r->line.dir[0], &r->line.dir[1], &r->line.dir[2]},
                           .t_min = &r->line.t_min,
                           .t_max = &r->line.t_max,
                           .mask = &r->mask};
    const test_trace_options options = {.kd_traversal = run->setup.way->traversal};
    if (!driver_succeeds(run, cgt_trace_rays(run->setup.scene, &rays, &hits, TRACE_OPTIONS(&options)),
                         "cgt_trace_rays") ||
        !driver_succeeds(run, cgt_occluded_rays(run->setup.scene, &rays, occluded, NULL), "cgt_occluded_rays"))
        return;
    run->count[COUNT_ANSWERS] += 2 * w->pixels;
    for (uint32_t i = 0; i < w->pixels; i++) {
        const frame_planes *p = &w->got;
        const full_hit want = {p->t[i],
                               p->primitive[i],
                               p->geometry[i],
                               {p->normal[0][i], p->normal[1][i], p->normal[2][i]},
                               {p->u[i], p->v[i]}};
        if (memcmp(&hit[i], &want, sizeof want) != 0 || occluded[i] != driver_is_hit(w, i))
            driver_fail(run, &w->ray[i], "cgt_trace_rays",
                        "pixel %u, %u as a ray hits %d.%d at %a, any %u, not %d.%d at %a", (unsigned)(i % w->width),
                        (unsigned)(i / w->width), (int)hit[i].geometry, (int)hit[i].primitive, (double)hit[i].t,
                        occluded[i], (int)want.geometry, (int)want.primitive, (double)want.t);
    }
}

static void ask_frame(driver_run *run, driver_view *w)
{
    const cgt_frame frame = dense_frame(w);
    if (random_below(&run->scene.random, 3) == 0 && trace_rows(run, w, frame, CGT_PRECISION_FAST))
        for (uint32_t i = 0; i < w->pixels; i++)
            judge_pixel(run, w, i, true);
    if (!trace_rows(run, w, frame, CGT_PRECISION_EXACT))
        return;
    for (uint32_t i = 0; i < w->pixels; i++)
        judge_pixel(run, w, i, false);
    if (random_below(&run->scene.random, 3) == 0)
        check_strides(run, w);
    if (!w->has_first) {
        w->has_first = true;
        w->first = w->got;
        driver_shadows_find(run, w);
    } else if (memcmp(&w->first, &w->got, sizeof w->got) != 0) {
        driver_fail(run, NULL, "cgt_trace_camera", "not the bits of the first setup");
        return;
    }
    check_rays(run, w);
    driver_shadows_ask(run, w, &frame);
}

static void begin(driver_run *run)
{
    driver_view *w = run->view;
    make_camera(run, w);
    find_pixels(run, w);
    w->has_first = false;
    driver_shadows_begin(run, w);
}

static void ask(driver_run *run)
{
    driver_view *w = run->view;
    const cgt_frame frame = dense_frame(w);
    driver_points_ask(run, w);
    if (w->has_rays)
        ask_frame(run, w);
    else if (cgt_trace_camera(run->setup.scene, &w->camera, &frame, NULL) == CGT_OK)
        driver_fail(run, NULL, "cgt_trace_camera", "a camera without rays has a frame");
}

const driver_call call_frames = {begin, ask};

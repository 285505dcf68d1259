/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera's frame, by rows, with odd strides, to a visitor, and its rays as an array. The rays are those of
 * cgt_camera_get_rays; what they hit is judged, in large frames for a part of them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "driver/calls/view.h"

struct driver_view *driver_view_make(void) { return malloc(sizeof(driver_view)); }

/* ---- the rays ---- */

static void find_pixels(driver_run *run, driver_view *w)
{
    static float org[3][DRIVER_PIXELS], dir[3][DRIVER_PIXELS];
    w->has_rays = cgt_camera_get_rays(&w->camera, w->width, w->height, 0, w->first_row, w->width, w->rows, 0,
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
        if (!driver_is_one_of(w->every, i))
            continue;
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
    const char *wrong = driver_is_one_of(w->every, i)
                            ? judge_nearest(&run->scene, &run->pool, &w->right[i], &w->ray[i], fast, &answer)
                            : NULL;
    float place[3] = {INFINITY, INFINITY, INFINITY};
    run->count[COUNT_ANSWERS]++;
    if (driver_is_hit(w, i))
        driver_position(w, i, place);
    for (int a = 0; a < 3 && !wrong; a++)
        if (!same_bits(place[a], p->position[a][i]))
            wrong = "the position is not org + t dir";
    if (wrong)
        driver_fail(run, &w->ray[i], "cgt_trace_camera", "pixel %u, %u of %ux%u: %s: %d.%d at %a",
                    (unsigned)(i % w->width), (unsigned)(w->first_row + i / w->width), (unsigned)w->width,
                    (unsigned)w->height, wrong, (int)p->geometry[i], (int)p->primitive[i], (double)p->t[i]);
}

/* What nobody asked for stays. */
static void clear_planes(driver_view *w)
{
    frame_planes *const p = &w->got;
    void *const plane[] = {p->t,           p->normal[0],   p->normal[1],   p->normal[2], p->u,       p->v,
                           p->position[0], p->position[1], p->position[2], p->primitive, p->geometry};
    for (uint32_t k = 0; k < TEST_COUNT(plane); k++)
        memset(plane[k], 0x77, w->pixels * sizeof(float));
}

static bool same_planes(const driver_view *w)
{
    const frame_planes *const p = &w->got, *const q = &w->first;
    const size_t bytes = w->pixels * sizeof(float);
    bool same = !memcmp(p->t, q->t, bytes) && !memcmp(p->u, q->u, bytes) && !memcmp(p->v, q->v, bytes) &&
                !memcmp(p->primitive, q->primitive, bytes) && !memcmp(p->geometry, q->geometry, bytes);
    for (int a = 0; a < 3; a++)
        same &= !memcmp(p->normal[a], q->normal[a], bytes) && !memcmp(p->position[a], q->position[a], bytes);
    return same;
}

/* Frames of which few rows are asked for have no planes. */
static cgt_visit take_tile(void *user, const cgt_tile *tile)
{
    driver_view *const w = user;
    frame_planes *const p = &w->got;
    for (uint32_t y = 0; y < tile->height; y++)
        for (uint32_t x = 0; x < tile->width; x++) {
            const size_t from = y * tile->row_stride + x, to = (tile->y + y - w->first_row) * w->width + tile->x + x;
            p->t[to] = tile->t[from];
            p->primitive[to] = tile->primitive[from];
            p->geometry[to] = tile->geometry[from];
            p->u[to] = tile->u[from];
            p->v[to] = tile->v[from];
            for (int a = 0; a < 3; a++) {
                p->normal[a][to] = tile->normal[a][from];
                p->position[a][to] = tile->position[a][from];
            }
        }
    return CGT_VISIT_CONTINUE;
}

static cgt_frame visited_frame(driver_view *w)
{
    cgt_frame f;
    cgt_frame_init(&f, w->width, w->height);
    f.first_row = w->first_row;
    f.row_count = w->rows;
    f.visitor = take_tile;
    f.visitor_user = w;
    f.visitor_fields =
        CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY | CGT_FIELD_NORMAL | CGT_FIELD_UV | CGT_FIELD_POSITION;
    return f;
}

static bool trace_part(driver_run *run, driver_view *w, const cgt_frame *frame, cgt_precision precision)
{
    cgt_trace_statistics statistics = {0};
    cgt_research_trace_statistics research = {0};
    test_trace_options o = driver_options(run, precision);
    o.packet = o.cull ? 4u << random_below(&run->scene.random, 3) : 0;
    o.tile = o.packet == 4 ? CGT_TILE_SHAPE_STRIP : CGT_TILE_SHAPE_AUTO;
    o.statistics = &statistics;
    o.research_statistics = &research;
    if (!driver_succeeds(run, cgt_trace_camera(run->setup.scene, &w->camera, frame, TRACE_OPTIONS(&o)),
                         "cgt_trace_camera"))
        return false;
    driver_count(run, &statistics);
    run->count[COUNT_SPLIT] += research.split_packets;
    run->count[COUNT_TILES] += statistics.tiles;
    return true;
}

/* Where a frame has no planes of positions. */
static void find_places(driver_view *w)
{
    for (uint32_t i = 0; i < w->pixels; i++) {
        float place[3] = {INFINITY, INFINITY, INFINITY};
        if (driver_is_hit(w, i))
            driver_position(w, i, place);
        for (int a = 0; a < 3; a++)
            w->got.position[a][i] = place[a];
    }
}

/* The rows in two calls; those that are not asked for stay. */
static bool trace_rows(driver_run *run, driver_view *w, cgt_precision precision)
{
    test_random *const r = &run->scene.random;
    const bool whole = w->rows == w->height;
    cgt_frame frame = whole && random_below(r, 5) ? dense_frame(w) : visited_frame(w);
    const uint32_t cut = whole ? random_below(r, w->height + 1) : 0;
    const bool has_places = frame.visitor || random_below(r, 3) == 0;
    for (int a = 0; a < 3 && !has_places; a++)
        frame.position[a] = NULL;
    clear_planes(w);
    if (cut && cut < w->height) {
        frame.row_count = cut;
        if (!trace_part(run, w, &frame, precision))
            return false;
        for (uint32_t i = cut * w->width; i < w->pixels; i++)
            if (w->got.primitive[i] != 0x77777777u)
                driver_fail(run, NULL, "cgt_trace_camera", "a row is written that nobody asked for");
        frame.first_row = cut;
        frame.row_count = 0;
    }
    const bool good = trace_part(run, w, &frame, precision);
    if (good && !has_places)
        find_places(w);
    return good;
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
    memset(t, 0x5a, sizeof t); /* not the answers of the setup before */
    memset(normal, 0x5a, sizeof normal);
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
    memset(hit, 0x5a, sizeof hit);
    memset(occluded, 0x5a, sizeof occluded);
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

static uint32_t fast_primitive[DRIVER_PIXELS], fast_geometry[DRIVER_PIXELS];

static bool trace_fast(driver_run *run, driver_view *w)
{
    if (random_below(&run->scene.random, 3) || !trace_rows(run, w, CGT_PRECISION_FAST))
        return false;
    for (uint32_t i = 0; i < w->pixels; i++)
        judge_pixel(run, w, i, true);
    memcpy(fast_primitive, w->got.primitive, w->pixels * sizeof *fast_primitive);
    memcpy(fast_geometry, w->got.geometry, w->pixels * sizeof *fast_geometry);
    return true;
}

/* FAST sees the primitives of EXACT, beside those that are judged, too. */
static void check_fast(driver_run *run, driver_view *w)
{
    for (uint32_t i = 0; i < w->pixels; i++)
        if (!driver_is_one_of(w->every, i) &&
            (fast_primitive[i] != w->got.primitive[i] || fast_geometry[i] != w->got.geometry[i]))
            driver_fail(run, &w->ray[i], "cgt_trace_camera, fast", "pixel %u, %u: %d.%d, not %d.%d",
                        (unsigned)(i % w->width), (unsigned)(w->first_row + i / w->width), (int)fast_geometry[i],
                        (int)fast_primitive[i], (int)w->got.geometry[i], (int)w->got.primitive[i]);
}

static void ask_frame(driver_run *run, driver_view *w)
{
    const cgt_frame frame = dense_frame(w);
    const bool whole = w->rows == w->height, fast = trace_fast(run, w);
    if (!trace_rows(run, w, CGT_PRECISION_EXACT))
        return;
    for (uint32_t i = 0; i < w->pixels; i++)
        judge_pixel(run, w, i, false);
    if (fast)
        check_fast(run, w);
    if (whole && random_below(&run->scene.random, 3) == 0)
        check_strides(run, w);
    if (!w->has_first) {
        w->has_first = true;
        w->first = w->got;
        driver_shadows_find(run, w);
    } else if (!same_planes(w)) {
        driver_fail(run, NULL, "cgt_trace_camera", "not the bits of the first setup");
        return;
    }
    check_rays(run, w);
    if (whole)
        driver_shadows_ask(run, w, &frame);
}

/* Ends or begins the range at what a pixel sees, or a float beside it. */
static bool cut_range(driver_run *run, driver_view *w)
{
    test_random *const r = &run->scene.random;
    const uint32_t i = random_below(r, w->pixels);
    if (!run->profile->pixels || !w->has_rays || random_below(r, 4))
        return false;
    const judge_truth right = driver_trace(run, &w->ray[i], JUDGE_NEAREST, false);
    const float t = right.count ? (float)run->pool.hit[right.first].values.t : 0;
    if (!(t > 0 && t < 0x1p100f))
        return false;
    const uint32_t side = random_below(r, 3), end = random_below(r, 2);
    const float at = side ? nextafterf(t, side == 1 ? 0 : INFINITY) : t;
    if (end ? w->camera.t_min > at : w->camera.t_max != 0 && w->camera.t_max < at)
        return false;
    *(end ? &w->camera.t_max : &w->camera.t_min) = at;
    return true;
}

static void begin(driver_run *run)
{
    driver_view *w = run->view;
    driver_camera_make(run, w);
    find_pixels(run, w);
    if (cut_range(run, w))
        find_pixels(run, w);
    w->has_first = false;
    driver_shadows_begin(run, w);
    driver_points_begin(run, w);
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

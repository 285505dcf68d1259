/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames, shadows of frames and points against lights are, bit for bit, what their rays are as an array, in scenes at
 * odds with single precision (odd_scenes.h), whichever the variant; and what the rays of arrays hit is judged exactly
 * for some of them. */
#include "support/odd_scenes.h"
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PIXELS = 16384 };

/* ---- comparisons ---- */

/* Rows of a frame, from first_row on. */
typedef struct picture {
    uint32_t width, height, first_row, rows, pixels;
    float t[MAX_PIXELS], u[MAX_PIXELS], v[MAX_PIXELS], normal[3][MAX_PIXELS];
    uint32_t primitive[MAX_PIXELS], geometry[MAX_PIXELS];
} picture;

static picture by_frame, by_rays;
static float org[3][MAX_PIXELS], dir[3][MAX_PIXELS], position[3][MAX_PIXELS], to_light[3][MAX_PIXELS],
    range_begin[MAX_PIXELS], range_end[MAX_PIXELS];
static uint8_t shadow[MAX_PIXELS], shadow_of_rays[MAX_PIXELS], shadow_of_points[MAX_PIXELS];

/* The first pixel that differs, or UINT32_MAX. */
static uint32_t first_difference(const picture *a, const picture *b, uint32_t *count)
{
    uint32_t first = UINT32_MAX;
    *count = 0;
    for (uint32_t i = 0; i < a->pixels; i++) {
        bool same = a->primitive[i] == b->primitive[i] && a->geometry[i] == b->geometry[i] &&
                    same_bits(a->t[i], b->t[i]) && same_bits(a->u[i], b->u[i]) && same_bits(a->v[i], b->v[i]);
        for (int k = 0; k < 3; k++)
            same = same && same_bits(a->normal[k][i], b->normal[k][i]);
        *count += !same;
        first = !same && first == UINT32_MAX ? i : first;
    }
    return first;
}

static uint64_t case_number, faults;
static const char *family_name;

static void report_fault(const char *what, const char *variant, uint32_t i, uint32_t count)
{
    faults++;
    print_message("FAULT: %s of case %s:%llu, variant %s: %u differ, first at %u: hit %u %u t %a, by rays %u %u t %a; "
                  "org %a %a %a dir %a %a %a\n",
                  what, family_name, (unsigned long long)case_number, variant, count, i, by_frame.primitive[i],
                  by_frame.geometry[i], (double)by_frame.t[i], by_rays.primitive[i], by_rays.geometry[i],
                  (double)by_rays.t[i], (double)org[0][i], (double)org[1][i], (double)org[2][i], (double)dir[0][i],
                  (double)dir[1][i], (double)dir[2][i]);
}

/* All of a frame. */
static cgt_frame frame_over(picture *p)
{
    cgt_frame f;
    cgt_frame_init(&f, p->width, p->height);
    f.t = p->t;
    f.primitive = p->primitive;
    f.geometry = p->geometry;
    f.u = p->u;
    f.v = p->v;
    for (int a = 0; a < 3; a++)
        f.normal[a] = p->normal[a];
    return f;
}

static cgt_visit copy_tile(void *user, const cgt_tile *tile)
{
    picture *p = user;
    for (uint32_t y = 0; y < tile->height; y++)
        for (uint32_t x = 0; x < tile->width; x++) {
            const size_t from = y * tile->row_stride + x, to = (tile->y + y - p->first_row) * p->width + tile->x + x;
            p->t[to] = tile->t[from];
            p->primitive[to] = tile->primitive[from];
            p->geometry[to] = tile->geometry[from];
            p->u[to] = tile->u[from];
            p->v[to] = tile->v[from];
            for (int a = 0; a < 3; a++)
                p->normal[a][to] = tile->normal[a][from];
        }
    return CGT_VISIT_CONTINUE;
}

/* Frames of which few rows are wanted go to a visitor: they have no planes. */
static void trace_frame(const cgt_scene *scene, const cgt_camera *camera, picture *p)
{
    cgt_frame f = frame_over(p);
    if (p->rows < p->height) {
        cgt_frame_init(&f, p->width, p->height);
        f.first_row = p->first_row;
        f.row_count = p->rows;
        f.visitor = copy_tile;
        f.visitor_user = p;
        f.visitor_fields = CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY | CGT_FIELD_NORMAL | CGT_FIELD_UV;
    }
    assert_int_equal(cgt_trace_camera(scene, camera, &f, NULL), CGT_OK);
}

static void trace_rays(const cgt_scene *scene, picture *p)
{
    cgt_rays q = {.count = p->pixels, .t_min = range_begin, .t_max = range_end};
    cgt_hits h = {.t = p->t, .primitive = p->primitive, .geometry = p->geometry, .u = p->u, .v = p->v};
    for (int a = 0; a < 3; a++) {
        q.org[a] = org[a];
        q.dir[a] = dir[a];
        h.normal[a] = p->normal[a];
    }
    assert_int_equal(cgt_trace_rays(scene, &q, &h, NULL), CGT_OK);
}

static void check_frame(const cgt_scene *scene, const cgt_camera *camera, const char *variant)
{
    const picture *p = &by_frame;
    float *const o[3] = {org[0], org[1], org[2]}, *const d[3] = {dir[0], dir[1], dir[2]};
    uint32_t count;
    trace_frame(scene, camera, &by_frame);
    assert_int_equal(cgt_camera_get_rays(camera, p->width, p->height, 0, p->first_row, p->width, p->rows, 0, o, d),
                     CGT_OK);
    for (uint32_t i = 0; i < p->pixels; i++) {
        range_begin[i] = camera->t_min;
        range_end[i] = camera->t_max;
    }
    by_rays.pixels = p->pixels;
    trace_rays(scene, &by_rays);
    const uint32_t first = first_difference(&by_frame, &by_rays, &count);
    if (first != UINT32_MAX)
        report_fault("a frame", variant, first, count);
}

/* Of all variants the first: what rays hit and how much sky pixels see has the same bits in each. */
static picture by_first;
static float sky[MAX_PIXELS], sky_of_first[MAX_PIXELS];

static void check_variants(const char *variant, bool is_first)
{
    uint32_t count;
    if (is_first)
        by_first = by_rays;
    else if (first_difference(&by_first, &by_rays, &count) != UINT32_MAX)
        report_fault("rays of another variant", variant, first_difference(&by_first, &by_rays, &count), count);
}

/* ---- the truth about a few of the rays ---- */

enum { JUDGED = 6 };

static void judge_frame(test_random *r, const oracle_scene *truth, const char *variant)
{
    for (uint32_t k = 0; k < JUDGED; k++) {
        const uint32_t i = random_below(r, by_rays.pixels);
        const truth_ray ray = {.org = {org[0][i], org[1][i], org[2][i]},
                               .dir = {dir[0][i], dir[1][i], dir[2][i]},
                               .t_min = range_begin[i],
                               .t_max = range_end[i]};
        const char *error = oracle_check(truth, &ray, by_rays.geometry[i], by_rays.primitive[i], by_rays.t[i]);
        if (error)
            report_fault(error, variant, i, 1);
    }
}

static void judge_points(test_random *r, const oracle_scene *truth, uint32_t count, const char *variant)
{
    for (uint32_t k = 0; k < JUDGED; k++) {
        const uint32_t i = random_below(r, count);
        const truth_ray ray = {.org = {position[0][i], position[1][i], position[2][i]},
                               .dir = {to_light[0][i], to_light[1][i], to_light[2][i]},
                               .t_min = range_begin[i],
                               .t_max = range_end[i]};
        if ((oracle_trace(truth, &ray).index != ORACLE_NONE) == (shadow_of_rays[i] != 0))
            continue;
        faults++;
        print_message("FAULT: a shadow ray of case %s:%llu, variant %s, is %d; org %a %a %a dir %a %a %a\n",
                      family_name, (unsigned long long)case_number, variant, shadow_of_rays[i], (double)ray.org[0],
                      (double)ray.org[1], (double)ray.org[2], (double)ray.dir[0], (double)ray.dir[1],
                      (double)ray.dir[2]);
    }
}

static void check_ambient(const cgt_scene *scene, const cgt_camera *camera, const char *variant, bool is_first)
{
    const cgt_frame f = frame_over(&by_frame);
    const cgt_ambient_options options = {.samples = 2, .seed = 3};
    assert_int_equal(cgt_ambient_occlusion(scene, camera, &f, &options, sky, NULL), CGT_OK);
    if (is_first)
        memcpy(sky_of_first, sky, sizeof sky);
    for (uint32_t i = 0; i < by_frame.pixels; i++)
        if (!same_bits(sky[i], sky_of_first[i])) {
            report_fault("ambient occlusion of another variant", variant, i, 1);
            return;
        }
}

static void compare_shadows(const char *what, const uint8_t *got, uint32_t count, const char *variant)
{
    uint32_t differ = 0, first = 0;
    for (uint32_t i = count; i--;)
        if (got[i] != shadow_of_rays[i]) {
            differ++;
            first = i;
        }
    if (!differ)
        return;
    faults++;
    print_message("FAULT: %s of case %s:%llu, variant %s: %u differ, first at %u: %d, by rays %d; org %a %a %a dir %a "
                  "%a %a\n",
                  what, family_name, (unsigned long long)case_number, variant, differ, first, got[first],
                  shadow_of_rays[first], (double)position[0][first], (double)position[1][first],
                  (double)position[2][first], (double)to_light[0][first], (double)to_light[1][first],
                  (double)to_light[2][first]);
}

/* The rays of positions to a light. */
static void trace_shadow_rays(const cgt_scene *scene, const cgt_light *light, uint32_t count, bool skips)
{
    cgt_rays q = {.count = count, .t_min = range_begin, .t_max = range_end};
    for (uint32_t i = 0; i < count; i++)
        for (int a = 0; a < 3; a++)
            to_light[a][i] = light->kind == CGT_LIGHT_POINT ? light->position[a] - position[a][i] : light->position[a];
    for (int a = 0; a < 3; a++) {
        q.org[a] = position[a];
        q.dir[a] = to_light[a];
    }
    if (skips) {
        q.skip_primitive = by_frame.primitive;
        q.skip_geometry = by_frame.geometry;
    }
    assert_int_equal(cgt_occluded_rays(scene, &q, shadow_of_rays, NULL), CGT_OK);
}

static void check_shadow(const cgt_scene *scene, const cgt_camera *camera, const cgt_light *light, const char *variant)
{
    const cgt_frame f = frame_over(&by_frame);
    const uint32_t count = by_frame.pixels;
    for (uint32_t i = 0; i < count; i++) {
        range_begin[i] = 0;
        range_end[i] = light->kind == CGT_LIGHT_POINT ? 1 : INFINITY;
        if (by_frame.primitive[i] == CGT_INVALID_ID)
            range_end[i] = -1;
        for (int a = 0; a < 3; a++) {
            volatile float way = by_frame.t[i] * dir[a][i];
            position[a][i] = range_end[i] < 0 ? 0 : org[a][i] + way;
        }
    }
    assert_int_equal(cgt_occluded_frame(scene, camera, &f, light, 1, NULL, shadow, NULL), CGT_OK);
    trace_shadow_rays(scene, light, count, true);
    compare_shadows("a frame's shadow", shadow, count, variant);
}

/* ranged: with ranges of their own. */
static void check_points(test_random *r, const cgt_scene *scene, const cgt_light *light, uint32_t count, bool ranged,
                         const char *variant)
{
    cgt_points p = {.count = count};
    for (int a = 0; a < 3; a++)
        p.position[a] = position[a];
    for (uint32_t i = 0; i < count; i++) {
        range_begin[i] = ranged ? random_float(r, 0, 0.5f) : 0;
        range_end[i] = ranged ? random_float(r, 0.1f, 1) : light->kind == CGT_LIGHT_POINT ? 1 : INFINITY;
    }
    if (ranged) {
        p.t_min = range_begin;
        p.t_max = range_end;
    }
    assert_int_equal(cgt_occluded_points(scene, light, &p, shadow_of_points, NULL), CGT_OK);
    trace_shadow_rays(scene, light, count, false);
    compare_shadows("points against a light", shadow_of_points, count, variant);
}

/* ---- cases ---- */

/* ---- cases ---- */

/* Sets the size of a picture. zoomed: rows of a large frame, whose pixels are as near as the rounding of directions. */
static void choose_size(test_random *r, bool zoomed, picture *p)
{
    static const uint32_t sizes[][2] = {{64, 64}, {48, 40}, {130, 20}, {16, 150}, {3, 7},
                                        {80, 65}, {1, 1},   {4000, 2}, {2, 4000}};
    const uint32_t *size = sizes[random_below(r, TEST_COUNT(sizes))];
    p->width = size[0];
    p->height = p->rows = size[1];
    p->first_row = 0;
    if (zoomed) {
        p->width = p->height = 1024u << random_below(r, 5);
        p->rows = random_below(r, MAX_PIXELS / p->width) % 3 + 1;
        p->first_row = p->height / 2 - random_below(r, 4);
    }
    p->pixels = p->width * p->rows;
}

static bool is_possible(const cgt_camera *camera, const picture *p)
{
    cgt_camera_rays rays;
    char message[CGT_CAMERA_MESSAGE_BYTES];
    return cgt_camera_prepare(camera, p->width, p->height, &rays, message) == CGT_OK;
}

/* A scene, what sees it and what lights it. */
typedef struct odd_case {
    odd_scene scene;
    oracle_scene truth;
    cgt_camera camera;
    cgt_light light;
    uint32_t points;
    bool has_camera, has_light, ranged;
} odd_case;

/* is_first: no other variant has traced it yet. */
static void run_variant(test_random r, const odd_case *c, const char *variant, bool is_first)
{
    float *const at[3] = {position[0], position[1], position[2]};
    cgt_context *context = context_make(1, variant);
    cgt_scene *scene = odd_scene_commit(context, &c->scene);
    const bool is_whole = by_frame.rows == by_frame.height;
    if (c->has_camera) {
        check_frame(scene, &c->camera, variant);
        check_variants(variant, is_first);
        if (is_first)
            judge_frame(&r, &c->truth, variant);
        if (case_number % 4 == 0 && is_whole)
            check_ambient(scene, &c->camera, variant, is_first);
        if (c->has_light && is_whole)
            check_shadow(scene, &c->camera, &c->light, variant);
    }
    odd_points(&r, &c->scene, c->points, at);
    if (c->has_light) {
        check_points(&r, scene, &c->light, c->points, c->ranged, variant);
        if (is_first)
            judge_points(&r, &c->truth, c->points, variant);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
}

static void run_case(odd_family family, uint64_t number)
{
    static odd_case c; /* large */
    test_random r = random_make(number * ODD_FAMILIES + family);
    case_number = number;
    family_name = odd_name(family);
    const bool zoomed = random_below(&r, 4) == 0;
    odd_scene_make(&r, family, &c.scene);
    c.camera = odd_camera(&r, &c.scene, zoomed);
    c.light = odd_light(&r, &c.scene);
    c.points = 256 + random_below(&r, 700);
    c.ranged = random_below(&r, 4) == 0;
    c.truth = odd_scene_truth(&c.scene);
    choose_size(&r, zoomed, &by_frame);
    c.has_camera = is_possible(&c.camera, &by_frame);
    c.has_light = isfinite(c.light.position[0] + c.light.position[1] + c.light.position[2]);
    bool is_first = true;
    FOR_EACH_VARIANT(variant)
    {
        if (number % 4 && !variant_is_outer(variant))
            continue;
        run_variant(r, &c, variant, is_first);
        is_first = false;
    }
    oracle_scene_free(&c.truth);
}

/* CGT_TEST_CASE: FAMILY or FAMILY:NUMBER, to run those alone. */
static void run_family(odd_family family, uint32_t cases)
{
    const char *only = getenv("CGT_TEST_CASE"), *colon = only ? strchr(only, ':') : NULL, *name = odd_name(family);
    const size_t length = colon ? (size_t)(colon - only) : only ? strlen(only) : 0;
    const uint64_t first = colon ? strtoull(colon + 1, NULL, 0) : 0, end = colon ? first + 1 : test_scaled(cases);
    faults = 0;
    if (only && (strlen(name) != length || strncmp(name, only, length) != 0))
        return;
    for (uint64_t k = first; k < end; k++)
        run_case(family, k);
    if (faults)
        fail_msg("%llu faults of %s: CGT_TEST_CASE and the seed above rerun one", (unsigned long long)faults, name);
}

TEST(frames_of_rods) { run_family(ODD_RODS, 100); }
TEST(frames_of_slivers) { run_family(ODD_SLIVERS, 100); }
TEST(frames_of_giants) { run_family(ODD_GIANTS, 100); }
TEST(frames_of_strays) { run_family(ODD_STRAYS, 100); }
TEST(frames_of_sizes) { run_family(ODD_SIZES, 100); }
TEST(frames_of_equals) { run_family(ODD_EQUALS, 100); }
TEST(frames_of_usual_scenes) { run_family(ODD_USUAL, 100); }
TEST(frames_of_specks) { run_family(ODD_SPECKS, 250); }
TEST(frames_of_crowds) { run_family(ODD_CROWDS, 20); }

SEEDED_SUITE("test_frames_are_rays", NULL, NULL)

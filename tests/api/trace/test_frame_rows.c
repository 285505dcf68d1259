/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rows of a frame alone have the bits of the whole frame, whatever the first one is: hits, shadows and occlusion,
 * through every structure. Elements of other rows stay, visitors do not see them, and statistics do not count them. */
#include <string.h>

#include "support/scenes.h"
#include "support/suite.h"

#define WIDTH 90u
#define HEIGHT 150u
#define PIXELS (WIDTH * HEIGHT)
#define LIGHTS 2u

typedef struct view {
    float t[PIXELS], normal[3 * PIXELS], u[PIXELS], v[PIXELS], position[3][PIXELS];
    uint32_t primitive[PIXELS], geometry[PIXELS];
    float visibility[PIXELS];
    uint8_t occluded[LIGHTS][PIXELS], seen[3][PIXELS];
} view;

static cgt_visit see(void *user, uint32_t x, uint32_t y, uint32_t width, uint32_t height)
{
    uint8_t *const seen = user;
    for (uint32_t j = y; j < y + height; j++)
        for (uint32_t i = x; i < x + width; i++)
            seen[j * WIDTH + i] = 1;
    return CGT_VISIT_CONTINUE;
}

static cgt_visit see_tile(void *user, const cgt_tile *tile)
{
    return see(user, tile->x, tile->y, tile->width, tile->height);
}

/* Everything that calls make of some rows; `planes` without a visitor, which goes another way. */
static void make(const cgt_scene *scene, const cgt_camera *camera, bool visited, uint32_t first, uint32_t count,
                 view *v)
{
    static const cgt_light light[LIGHTS] = {{.position = {3, 4, 5}},
                                            {.kind = CGT_LIGHT_DIRECTIONAL, .position = {-1, 2, 0.5f}}};
    cgt_trace_statistics statistics;
    const cgt_trace_options options = {.statistics = &statistics};
    cgt_frame f;
    memset(v, 0x55, sizeof *v);
    cgt_frame_init(&f, WIDTH, HEIGHT);
    f.first_row = first;
    f.row_count = count;
    f.t = v->t;
    f.primitive = v->primitive;
    f.geometry = v->geometry;
    f.u = v->u;
    f.v = v->v;
    f.vector_stride = visited ? 3 : 1;
    for (int a = 0; a < 3; a++) {
        f.normal[a] = visited ? v->normal + a : v->normal + a * PIXELS;
        f.position[a] = visited ? NULL : v->position[a];
    }
    f.visitor = visited ? see_tile : NULL;
    f.visitor_user = v->seen[0];
    assert_int_equal(cgt_trace_camera(scene, camera, &f, &options), CGT_OK);
    assert_int_equal(statistics.rays, (count ? count : HEIGHT - first) * WIDTH);
    const cgt_shadow_options shadows = {.visitor = see, .visitor_user = v->seen[1]};
    assert_int_equal(cgt_occluded_frame(scene, camera, &f, light, LIGHTS, &shadows, v->occluded[0], NULL), CGT_OK);
    const cgt_ambient_options ambient = {.samples = 5, .visitor = see, .visitor_user = v->seen[2]};
    assert_int_equal(cgt_ambient_occlusion(scene, camera, &f, &ambient, v->visibility, NULL), CGT_OK);
}

/* Compares two planes of elements of some bytes: rows from `first` on are the same, all others of `part` untouched. */
static void compare(const void *whole, const void *part, size_t bytes, uint32_t first, uint32_t count)
{
    const uint8_t *const a = whole, *const b = part;
    const size_t row = WIDTH * bytes, end = (first + count) * row;
    assert_memory_equal(a + first * row, b + first * row, count * row);
    for (size_t i = 0; i < HEIGHT * row; i++)
        if (i < first * row || i >= end)
            assert_int_equal(b[i], 0x55);
}

static void compare_all(const view *whole, const view *part, bool visited, uint32_t first, uint32_t count)
{
    const uint32_t *const plane[] = {(const uint32_t *)whole->t,
                                     (const uint32_t *)part->t,
                                     whole->primitive,
                                     part->primitive,
                                     whole->geometry,
                                     part->geometry,
                                     (const uint32_t *)whole->u,
                                     (const uint32_t *)part->u,
                                     (const uint32_t *)whole->v,
                                     (const uint32_t *)part->v,
                                     (const uint32_t *)whole->visibility,
                                     (const uint32_t *)part->visibility};
    for (size_t k = 0; k < TEST_COUNT(plane); k += 2)
        compare(plane[k], plane[k + 1], sizeof(float), first, count);
    for (uint32_t k = 0; k < LIGHTS; k++)
        compare(whole->occluded[k], part->occluded[k], 1, first, count);
    for (int k = visited ? 0 : 1; k < 3; k++)
        compare(whole->seen[k], part->seen[k], 1, first, count);
    if (visited)
        compare(whole->normal, part->normal, 3 * sizeof(float), first, count);
    for (int a = 0; a < 3 && !visited; a++) {
        compare(whole->normal + a * PIXELS, part->normal + a * PIXELS, sizeof(float), first, count);
        compare(whole->position[a], part->position[a], sizeof(float), first, count);
    }
}

/* 0 rows: all from the first on. */
static const uint32_t rows[][2] = {{0, 1}, {149, 1}, {0, 64}, {13, 70}, {62, 3}, {77, 0}, {31, 97}};

TEST(rows_have_the_bits_of_the_whole)
{
    static view whole, part;
    test_random r = random_make(71);
    cgt_context *context = context_make(2, NULL);
    cloud c = cloud_make(&r, CLOUD_UNIFORM, 400);
    const cgt_camera camera = camera_before(&c);
    for (uint32_t k = 0; k < TEST_STRUCTURES; k++) {
        const cgt_scene_options options = structure_in_turn(k);
        cgt_scene *scene = scene_of(context, &options, (const float(*)[4])c.sphere, c.count);
        for (int visited = 0; visited < 2; visited++) {
            make(scene, &camera, visited, 0, 0, &whole);
            for (size_t i = 0; i < TEST_COUNT(rows); i++) {
                make(scene, &camera, visited, rows[i][0], rows[i][1], &part);
                compare_all(&whole, &part, visited, rows[i][0], rows[i][1] ? rows[i][1] : HEIGHT - rows[i][0]);
            }
        }
        cgt_scene_release(scene);
    }
    cloud_free(&c);
    cgt_context_release(context);
}

SUITE(NULL, NULL)

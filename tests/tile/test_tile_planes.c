/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Planes at any address and stride: every word of a line, planes that all begin alike or each elsewhere, odd strides
 * and widths, one to many tiles in a task. The values are those of a visitor, bit by bit, and nothing around the
 * picture is written. */
#include <stdlib.h>
#include <string.h>

#include "query/region.h"
#include "support/suite.h"
#include "support/scenes.h"

#define LINE 16u /* words */
#define HEIGHT 67u
#define GUARD 64u /* words before and behind each plane */
#define UNTOUCHED 0x5a5a5a5au

/* ---- the expected values ---- */

typedef struct picture {
    uint32_t width;
    uint32_t *plane[CGT_PLANES]; /* width * HEIGHT */
} picture;

static cgt_visit keep_tile(void *user, const cgt_tile *tile)
{
    const picture *p = user;
    const void *const from[CGT_PLANES] = CGT_PLANES_OF(tile);
    for (uint32_t y = 0; y < tile->height; y++)
        for (int k = 0; k < CGT_PLANES; k++)
            memcpy(p->plane[k] + (tile->y + y) * p->width + tile->x, (const uint32_t *)from[k] + y * tile->row_stride,
                   tile->width * sizeof(uint32_t));
    return CGT_VISIT_CONTINUE;
}

static picture picture_make(const cgt_scene *scene, const cgt_camera *camera, uint32_t width)
{
    picture p = {.width = width};
    cgt_frame frame;
    for (int k = 0; k < CGT_PLANES; k++)
        assert_non_null(p.plane[k] = malloc((size_t)width * HEIGHT * sizeof(uint32_t)));
    cgt_frame_init(&frame, width, HEIGHT);
    frame.visitor = keep_tile;
    frame.visitor_user = &p;
    frame.visitor_fields = CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY | CGT_FIELD_NORMAL | CGT_FIELD_UV;
    assert_int_equal(cgt_trace_camera(scene, camera, &frame, NULL), CGT_OK);
    return p;
}

static void picture_free(picture *p)
{
    for (int k = 0; k < CGT_PLANES; k++)
        free(p->plane[k]);
}

/* ---- planes anywhere ---- */

typedef struct layout {
    size_t row_stride;
    uint32_t offset[CGT_PLANES]; /* words from a line's begin */
} layout;

static void set_planes(cgt_frame *f, uint32_t *const plane[CGT_PLANES], uint32_t fields)
{
    f->t = fields & CGT_FIELD_T ? (float *)plane[CGT_PLANE_T] : NULL;
    f->primitive = fields & CGT_FIELD_PRIMITIVE ? plane[CGT_PLANE_PRIMITIVE] : NULL;
    f->geometry = fields & CGT_FIELD_GEOMETRY ? plane[CGT_PLANE_GEOMETRY] : NULL;
    for (int a = 0; a < 3; a++)
        f->normal[a] = fields & CGT_FIELD_NORMAL ? (float *)plane[CGT_PLANE_NORMAL + a] : NULL;
    f->u = fields & CGT_FIELD_UV ? (float *)plane[CGT_PLANE_U] : NULL;
    f->v = fields & CGT_FIELD_UV ? (float *)plane[CGT_PLANE_V] : NULL;
}

static void check_plane(const picture *expected, const layout *l, int k, bool wanted, const uint32_t *memory,
                        size_t words)
{
    const uint32_t *plane = memory + GUARD + l->offset[k];
    for (size_t i = 0; i < words; i++) {
        const size_t from_plane = i - GUARD - l->offset[k]; /* wraps before it */
        const size_t y = from_plane / l->row_stride, x = from_plane % l->row_stride;
        const bool inside = wanted && memory + i >= plane && y < HEIGHT && x < expected->width;
        const uint32_t right = inside ? expected->plane[k][y * expected->width + x] : UNTOUCHED;
        if (memory[i] != right)
            fail_msg("plane %d, offset %u, width %u, stride %zu: word %zd is %08x, not %08x", k, l->offset[k],
                     expected->width, l->row_stride, (ptrdiff_t)(memory + i - plane), memory[i], right);
    }
}

static void check_layout(const cgt_scene *scene, const cgt_camera *camera, const picture *expected, const layout *l,
                         uint32_t fields)
{
    const size_t words = (l->row_stride * HEIGHT + 2 * GUARD + LINE - 1) / LINE * LINE;
    uint32_t *memory = aligned_alloc(64, CGT_PLANES * words * sizeof *memory), *plane[CGT_PLANES];
    cgt_frame frame;
    assert_non_null(memory);
    for (size_t i = 0; i < CGT_PLANES * words; i++)
        memory[i] = UNTOUCHED;
    for (size_t k = 0; k < CGT_PLANES; k++)
        plane[k] = memory + k * words + GUARD + l->offset[k];
    cgt_frame_init(&frame, expected->width, HEIGHT);
    frame.row_stride = l->row_stride;
    set_planes(&frame, plane, fields);
    assert_int_equal(cgt_trace_camera(scene, camera, &frame, NULL), CGT_OK);
    for (int k = 0; k < CGT_PLANES; k++)
        check_plane(expected, l, k, fields & cgt_plane_field[k], memory + (size_t)k * words, words);
    free(memory);
}

/* Every offset with every kind of stride, and some of the fields. */
static void check_layouts(const cgt_scene *scene, const cgt_camera *camera, test_random *r, uint32_t width)
{
    static const uint32_t more[] = {0, 1, 3, 8, 16, 29};
    picture expected = picture_make(scene, camera, width);
    for (uint32_t offset = 0; offset < LINE; offset++)
        for (uint32_t k = 0; k < TEST_COUNT(more); k++) {
            layout l = {.row_stride = (k & 1 ? width : (width + LINE - 1) / LINE * LINE) + more[k]};
            for (int p = 0; p < CGT_PLANES; p++)
                l.offset[p] = k % 3 == 2 ? random_below(r, LINE) : offset;
            const uint32_t all =
                CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY | CGT_FIELD_NORMAL | CGT_FIELD_UV;
            check_layout(scene, camera, &expected, &l, random_below(r, 2) ? all : 1 + random_below(r, all));
        }
    picture_free(&expected);
}

/* ---- scenes: spheres, triangles, both, with sky in the picture ---- */

typedef enum scene_kind { SPHERES, TRIANGLES, BOTH, SCENES } scene_kind;

static cgt_scene *scene_make(cgt_context *context, const cloud *c, scene_kind kind)
{
    static const float corner[5][3] = {{-3, -3, -1}, {2, -2, 0}, {0, 2, 0.5f}, {3, 3, -2}, {-2, 1, 1}};
    static const uint32_t index[3][3] = {{0, 1, 2}, {1, 3, 2}, {0, 2, 4}};
    const cgt_spheres spheres = spheres_of((const float(*)[4])c->sphere, kind == TRIANGLES ? 0 : c->count);
    const cgt_triangles triangles = {
        .count = kind == SPHERES ? 0 : 3, .indices = index[0], .vertex_count = 5, .vertices = corner[0]};
    cgt_scene *scene;
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    assert_int_equal(cgt_scene_add_spheres(scene, &spheres, NULL), CGT_OK);
    assert_int_equal(cgt_scene_add_triangles(scene, &triangles, NULL), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

TEST(any_address_and_stride)
{
    static const uint32_t widths[] = {1, 17, 64, 65, 130, 321}; /* the last: several tiles in a task of one thread */
    test_random r = random_make(940);
    cloud c = cloud_make(&r, CLOUD_UNIFORM, 60);
    for (uint32_t i = 0; i < c.count; i++) {
        for (int a = 0; a < 3; a++)
            c.sphere[i][a] = random_float(&r, -1, 1);
        c.sphere[i][3] = random_float(&r, 0.02f, 0.3f);
    }
    FOR_EACH_VARIANT(variant)
    for (int kind = 0; kind < SCENES; kind++) {
        cgt_context *context = context_make(1 + (uint32_t)kind % 2, variant);
        cgt_scene *scene = scene_make(context, &c, (scene_kind)kind);
        cgt_camera camera;
        cgt_camera_init(&camera);
        for (uint32_t k = test_samples() ? 5 : 0; k < TEST_COUNT(widths); k++) {
            camera.projection = k % 3 == 1 ? CGT_PROJECTION_ORTHOGRAPHIC : CGT_PROJECTION_PERSPECTIVE;
            check_layouts(scene, &camera, &r, widths[k]);
        }
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
    cloud_free(&c);
}

/* A picture of many tiles, so that tasks take several of them. */
TEST(tasks_of_several_tiles)
{
    test_random r = random_make(941);
    cloud c = cloud_make(&r, CLOUD_UNIFORM, 500);
    const cgt_camera camera = camera_before(&c);
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, (const float(*)[4])c.sphere, c.count);
    picture expected = picture_make(scene, &camera, 64 * 18 + 7);
    for (uint32_t k = 0; k < 8; k++) {
        layout l = {.row_stride = expected.width + (k & 1)};
        for (int p = 0; p < CGT_PLANES; p++)
            l.offset[p] = random_below(&r, LINE);
        check_layout(scene, &camera, &expected, &l, CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_NORMAL);
    }
    picture_free(&expected);
    cgt_scene_release(scene);
    cgt_context_release(context);
    cloud_free(&c);
}

SEEDED_SUITE("test_tile_planes", NULL, NULL)

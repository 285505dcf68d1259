/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where a frame is stored: planes with and without a row stride, any set of fields, visitors that get tiles as they are
 * traced, both at once; and visitors that stop. All have the same bits. */
#include "support/scenes.h"
#include "support/suite.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define WIDTH 150
#define HEIGHT 71

static cgt_structure structure; /* under test */
static cgt_context *context;
static cgt_scene *scene;
static cloud spheres;
static cgt_camera camera;
static planes expected;

static int open_scene(void **state)
{
    (void)state;
    test_random r = random_make(1);
    context = context_make(3, NULL);
    spheres = cloud_make(&r, CLOUD_UNIFORM, 800);
    const cgt_scene_options made = {.structure = structure};
    scene = scene_of(context, &made, (const float(*)[4])spheres.sphere, spheres.count);
    camera = camera_before(&spheres);
    expected = planes_make(WIDTH, HEIGHT);
    frame_trace(scene, &camera, &expected, NULL);
    uint32_t hits = 0;
    for (size_t i = 0; i < expected.elements; i++)
        hits += expected.primitive[i] != CGT_INVALID_ID;
    return hits > expected.elements / 10 ? 0 : -1;
}

static int close_scene(void **state)
{
    (void)state;
    planes_free(&expected);
    cgt_scene_release(scene);
    cloud_free(&spheres);
    cgt_context_release(context);
    return 0;
}

/* ---- planes ---- */

TEST(row_stride_may_exceed_the_width)
{
    enum { STRIDE = WIDTH + 13 };
    for (int tile = CGT_TILE_SHAPE_AUTO; tile <= CGT_TILE_SHAPE_STRIP; tile++) {
        uint32_t *memory = malloc((size_t)6 * STRIDE * HEIGHT * sizeof *memory);
        test_trace_options o;
        cgt_frame frame;
        assert_non_null(memory);
        memset(memory, 0x3c, (size_t)6 * STRIDE * HEIGHT * sizeof *memory);
        o = (test_trace_options){0};
        o.tile = (cgt_tile_shape)tile;
        cgt_frame_init(&frame, WIDTH, HEIGHT);
        frame.row_stride = STRIDE;
        frame.t = (float *)memory;
        frame.primitive = memory + STRIDE * HEIGHT;
        frame.geometry = memory + 2 * STRIDE * HEIGHT;
        for (int a = 0; a < 3; a++)
            frame.normal[a] = (float *)(memory + (3 + a) * STRIDE * HEIGHT);
        assert_int_equal(cgt_trace_camera(scene, &camera, &frame, TRACE_OPTIONS(&o)), CGT_OK);
        for (int plane = 0; plane < 6; plane++)
            for (int y = 0; y < HEIGHT; y++) {
                const uint32_t *row = memory + (plane * HEIGHT + y) * STRIDE;
                assert_memory_equal(row, expected.memory + (plane * HEIGHT + y) * WIDTH, WIDTH * sizeof *row);
                for (int x = WIDTH; x < STRIDE; x++)
                    assert_int_equal(row[x], 0x3c3c3c3c); /* between the rows */
            }
        free(memory);
    }
}

/* ---- vectors side by side ---- */

enum { APART = 4, ROW = WIDTH + 5, VECTORS = APART * ROW * HEIGHT, GAP = 0x3c3c3c3c };

/* Positions as planes, by the tile, for the visitor of the test below. */
typedef struct vectors_visit {
    float normal[3][WIDTH * HEIGHT], position[3][WIDTH * HEIGHT];
    atomic_uint wrong;
} vectors_visit;

static cgt_visit visit_vectors(void *user, const cgt_tile *tile)
{
    vectors_visit *v = user;
    for (int a = 0; a < 3; a++) {
        if (!tile->normal[a] || !tile->position[a]) {
            v->wrong++;
            return CGT_VISIT_STOP;
        }
        for (uint32_t y = 0; y < tile->height; y++) {
            const size_t to = (size_t)(tile->y + y) * WIDTH + tile->x, from = y * tile->row_stride;
            memcpy(&v->normal[a][to], &tile->normal[a][from], tile->width * sizeof(float));
            memcpy(&v->position[a][to], &tile->position[a][from], tile->width * sizeof(float));
        }
    }
    return CGT_VISIT_CONTINUE;
}

/* What a frame with vector_stride has stored is what planes have, and nothing lies between. */
static void check_vectors(const uint32_t *vectors, float *const plane[3])
{
    for (size_t i = 0; i < VECTORS; i++) {
        const size_t a = i % APART, x = i / APART % ROW, y = i / APART / ROW;
        uint32_t expected_bits = GAP;
        if (a < 3 && x < WIDTH)
            memcpy(&expected_bits, &plane[a][y * WIDTH + x], sizeof expected_bits);
        if (vectors[i] != expected_bits)
            fail_msg("pixel %zu, %zu: component %zu is %08x, not %08x", x, y, a, vectors[i], expected_bits);
    }
}

/* Normals and positions as records of four words, with and without a visitor that sees them as planes; beside planes
 * that are there and, where the visitor alone wants them, that are not. */
TEST(vectors_may_lie_side_by_side)
{
    static uint32_t normal[VECTORS], position[VECTORS], t[ROW * HEIGHT];
    static float positions[3][WIDTH * HEIGHT];
    static vectors_visit v;
    float *const places[3] = {positions[0], positions[1], positions[2]};
    cgt_frame dense;
    cgt_frame_init(&dense, WIDTH, HEIGHT);
    for (int a = 0; a < 3; a++)
        dense.position[a] = places[a];
    assert_int_equal(cgt_trace_camera(scene, &camera, &dense, NULL), CGT_OK);
    for (int round = 0; round < 16; round++) {
        test_trace_options o = {.tile = round & 1 ? CGT_TILE_SHAPE_STRIP : CGT_TILE_SHAPE_AUTO};
        cgt_frame frame;
        cgt_frame_init(&frame, WIDTH, HEIGHT);
        frame.row_stride = ROW;
        frame.vector_stride = APART;
        memset(normal, 0x3c, sizeof normal);
        memset(position, 0x3c, sizeof position);
        frame.t = round & 2 ? (float *)(void *)t : NULL;
        for (int a = 0; a < 3; a++) {
            frame.normal[a] = (float *)(void *)normal + a;
            frame.position[a] = round & 4 ? (float *)(void *)position + a : NULL;
        }
        if (round & 8) {
            memset(&v, 0, sizeof v);
            frame.visitor = visit_vectors;
            frame.visitor_user = &v;
            frame.visitor_fields = CGT_FIELD_NORMAL | CGT_FIELD_POSITION;
        }
        assert_int_equal(cgt_trace_camera(scene, &camera, &frame, TRACE_OPTIONS(&o)), CGT_OK);
        check_vectors(normal, expected.normal);
        if (frame.position[0])
            check_vectors(position, places);
        for (int a = 0; a < 3 && frame.visitor; a++) {
            assert_memory_equal(v.normal[a], expected.normal[a], sizeof v.normal[a]);
            assert_memory_equal(v.position[a], places[a], sizeof v.position[a]);
        }
        for (size_t i = 0; frame.t && i < WIDTH * HEIGHT; i++)
            assert_memory_equal(&frame.t[i / WIDTH * ROW + i % WIDTH], &expected.t[i], sizeof *frame.t);
    }
}

/* A visitor that wants positions and something that has no plane gets both with the same row stride. */
TEST(a_visitor_gets_one_row_stride)
{
    static float positions[3][ROW * HEIGHT];
    static vectors_visit v;
    cgt_frame frame;
    cgt_frame_init(&frame, WIDTH, HEIGHT);
    frame.row_stride = ROW;
    for (int a = 0; a < 3; a++)
        frame.position[a] = positions[a];
    frame.visitor = visit_vectors;
    frame.visitor_user = &v;
    frame.visitor_fields = CGT_FIELD_NORMAL | CGT_FIELD_POSITION;
    assert_int_equal(cgt_trace_camera(scene, &camera, &frame, NULL), CGT_OK);
    for (int a = 0; a < 3; a++)
        for (size_t y = 0; y < HEIGHT; y++)
            assert_memory_equal(&v.position[a][y * WIDTH], &positions[a][y * ROW], WIDTH * sizeof(float));
}

/* A frame with the planes of some fields. */
static cgt_frame frame_with(const planes *p, uint32_t fields)
{
    cgt_frame frame = frame_of(p);
    if (!(fields & CGT_FIELD_T))
        frame.t = NULL;
    if (!(fields & CGT_FIELD_PRIMITIVE))
        frame.primitive = NULL;
    if (!(fields & CGT_FIELD_GEOMETRY))
        frame.geometry = NULL;
    if (!(fields & CGT_FIELD_NORMAL))
        frame.normal[0] = frame.normal[1] = frame.normal[2] = NULL;
    return frame;
}

/* The planes of the given fields are as expected, all others unchanged. */
static void check_planes(const planes *p, uint32_t fields)
{
    static const uint32_t field[6] = {CGT_FIELD_T,      CGT_FIELD_PRIMITIVE, CGT_FIELD_GEOMETRY,
                                      CGT_FIELD_NORMAL, CGT_FIELD_NORMAL,    CGT_FIELD_NORMAL};
    for (size_t plane = 0; plane < 6; plane++) {
        const uint32_t *got = p->memory + plane * p->elements;
        if (fields & field[plane])
            assert_memory_equal(got, expected.memory + plane * p->elements, p->elements * sizeof *got);
        else
            for (size_t i = 0; i < p->elements; i++)
                assert_int_equal(got[i], 0x5a5a5a5a);
    }
}

/* ---- visitors ---- */

typedef struct visit {
    planes tiles;                     /* the contents of the tiles */
    atomic_uint seen[WIDTH * HEIGHT]; /* visits of each pixel */
    atomic_uint calls, wrong;         /* errors are counted: cmocka works only on the main thread */
    uint32_t fields, tile_width, tile_height;
    unsigned stop_at; /* the call that stops; 0: none */
} visit;

static void keep(visit *v, uint32_t *to, const void *from, const cgt_tile *tile, uint32_t field)
{
    if ((from != NULL) != ((v->fields & field) != 0))
        atomic_fetch_add(&v->wrong, 1);
    if (!from)
        return;
    for (uint32_t j = 0; j < tile->height; j++)
        memcpy(to + (tile->y + j) * WIDTH + tile->x, (const uint32_t *)from + j * tile->row_stride,
               tile->width * sizeof(uint32_t));
}

static cgt_visit visit_tile(void *user, const cgt_tile *tile)
{
    visit *v = user;
    const unsigned call = atomic_fetch_add(&v->calls, 1) + 1;
    if (v->stop_at && call >= v->stop_at)
        return -1;
    if (tile->x % v->tile_width || tile->y % v->tile_height || !tile->width || !tile->height ||
        tile->width > v->tile_width || tile->height > v->tile_height || tile->row_stride < tile->width ||
        tile->x + tile->width > WIDTH || tile->y + tile->height > HEIGHT) {
        atomic_fetch_add(&v->wrong, 1);
        return 1;
    }
    for (uint32_t j = 0; j < tile->height; j++)
        for (uint32_t i = 0; i < tile->width; i++)
            atomic_fetch_add(&v->seen[(tile->y + j) * WIDTH + tile->x + i], 1);
    keep(v, (uint32_t *)v->tiles.t, tile->t, tile, CGT_FIELD_T);
    keep(v, v->tiles.primitive, tile->primitive, tile, CGT_FIELD_PRIMITIVE);
    keep(v, v->tiles.geometry, tile->geometry, tile, CGT_FIELD_GEOMETRY);
    for (int a = 0; a < 3; a++)
        keep(v, (uint32_t *)v->tiles.normal[a], tile->normal[a], tile, CGT_FIELD_NORMAL);
    return 0;
}

static visit *visit_make(uint32_t fields, cgt_tile_shape shape)
{
    visit *v = calloc(1, sizeof *v);
    assert_non_null(v);
    v->tiles = planes_make(WIDTH, HEIGHT);
    memset(v->tiles.memory, 0x5a, 6 * v->tiles.elements * sizeof(uint32_t));
    v->fields = fields;
    v->tile_width = shape == CGT_TILE_SHAPE_STRIP ? 1280 : 64;
    v->tile_height = shape == CGT_TILE_SHAPE_STRIP ? 4 : 64;
    return v;
}

static void visit_free(visit *v)
{
    planes_free(&v->tiles);
    free(v);
}

TEST(any_fields_reach_planes_and_visitors)
{
    planes p = planes_make(WIDTH, HEIGHT);
    const uint32_t step = test_samples() ? 5 : 1; /* every fifth set of the visitor's fields on slow machines */
    for (uint32_t plane_fields = 0; plane_fields < 16; plane_fields++)
        for (uint32_t visitor_fields = test_sample_start(plane_fields, step); visitor_fields < 16;
             visitor_fields += step)
            for (int tile = CGT_TILE_SHAPE_SQUARE; tile <= CGT_TILE_SHAPE_STRIP; tile++) {
                visit *v = visit_make(visitor_fields, (cgt_tile_shape)tile);
                cgt_frame frame = frame_with(&p, plane_fields);
                test_trace_options o = {0};
                o.tile = (cgt_tile_shape)tile;
                frame.visitor = visit_tile;
                frame.visitor_user = v;
                frame.visitor_fields = visitor_fields;
                memset(p.memory, 0x5a, 6 * p.elements * sizeof(uint32_t));
                assert_int_equal(cgt_trace_camera(scene, &camera, &frame, TRACE_OPTIONS(&o)), CGT_OK);
                assert_int_equal(v->wrong, 0);
                assert_int_equal(v->calls, tile == CGT_TILE_SHAPE_STRIP ? (HEIGHT + 3) / 4 : 3 * 2);
                for (int i = 0; i < WIDTH * HEIGHT; i++)
                    assert_int_equal(v->seen[i], 1);
                check_planes(&p, plane_fields);
                check_planes(&v->tiles, visitor_fields);
                visit_free(v);
            }
    planes_free(&p);
}

TEST(fields_without_a_visitor_are_ignored)
{
    planes p = planes_make(WIDTH, HEIGHT);
    cgt_frame frame = frame_with(&p, CGT_FIELD_PRIMITIVE);
    frame.visitor_fields = CGT_FIELD_NORMAL;
    memset(p.memory, 0x5a, 6 * p.elements * sizeof(uint32_t));
    assert_int_equal(cgt_trace_camera(scene, &camera, &frame, NULL), CGT_OK);
    check_planes(&p, CGT_FIELD_PRIMITIVE);
    frame.primitive = NULL; /* no field requested */
    assert_int_equal(cgt_trace_camera(scene, &camera, &frame, NULL), CGT_ERROR_INVALID_ARGUMENT);
    planes_free(&p);
}

TEST(a_visitor_stops_the_frame)
{
    for (int tile = CGT_TILE_SHAPE_SQUARE; tile <= CGT_TILE_SHAPE_STRIP; tile++)
        for (unsigned stop_at = 1; stop_at <= 6; stop_at += 5) {
            visit *v = visit_make(CGT_FIELD_T, (cgt_tile_shape)tile);
            test_trace_options o = {0};
            cgt_frame frame;
            o.tile = (cgt_tile_shape)tile;
            cgt_frame_init(&frame, WIDTH, HEIGHT);
            frame.visitor = visit_tile;
            frame.visitor_user = v;
            frame.visitor_fields = CGT_FIELD_T;
            v->stop_at = stop_at;
            assert_int_equal(cgt_trace_camera(scene, &camera, &frame, TRACE_OPTIONS(&o)), CGT_ERROR_STOPPED);
            assert_non_null(strstr(context_message(context), "visitor"));
            /* after the first stop, only the calls in progress on other threads */
            assert_in_range(v->calls, stop_at, stop_at + 2);
            visit_free(v);
        }
    planes p = planes_make(WIDTH, HEIGHT);
    frame_trace(scene, &camera, &p, NULL); /* the scene is unaffected */
    assert_true(planes_equal(&p, &expected));
    planes_free(&p);
}

/* A tile's planes are part of the frame's if no copy is needed; strips are Chapman's lines over the full width. */
TEST(strips_span_the_width)
{
    visit *v = visit_make(CGT_FIELD_T, CGT_TILE_SHAPE_STRIP);
    test_trace_options o = {0};
    cgt_frame frame;
    o.tile = CGT_TILE_SHAPE_STRIP;
    cgt_frame_init(&frame, WIDTH, HEIGHT);
    frame.visitor = visit_tile;
    frame.visitor_user = v;
    frame.visitor_fields = CGT_FIELD_T;
    v->tile_width = WIDTH; /* so that tiles start only at 0 */
    assert_int_equal(cgt_trace_camera(scene, &camera, &frame, TRACE_OPTIONS(&o)), CGT_OK);
    assert_int_equal(v->wrong, 0);
    assert_int_equal(v->calls, (HEIGHT + 3) / 4);
    visit_free(v);
}

/* ---- shadows and occlusion ---- */

enum { LIGHTS = 2 };

typedef struct pixels_visit {
    atomic_uint calls, pixels, stop_at, wrong;
    uint8_t occluded[LIGHTS][WIDTH * HEIGHT]; /* as the call leaves it */
    float visibility[WIDTH * HEIGHT];
    const uint8_t *expected_occluded; /* NULL: the visibility is expected */
    const float *expected_visibility;
    uint8_t seen[WIDTH * HEIGHT];
} pixels_visit;

static cgt_visit visit_pixels(void *user, uint32_t x0, uint32_t y0, uint32_t width, uint32_t height)
{
    pixels_visit *v = user;
    for (uint32_t y = y0; y < y0 + height; y++)
        for (uint32_t x = x0; x < x0 + width; x++) {
            const size_t i = (size_t)y * WIDTH + x;
            bool right = x < WIDTH && y < HEIGHT && !v->seen[i]++;
            for (size_t k = 0; right && k < LIGHTS && v->expected_occluded; k++)
                right = v->occluded[k][i] == v->expected_occluded[k * WIDTH * HEIGHT + i];
            if (right && v->expected_visibility)
                right = v->visibility[i] == v->expected_visibility[i];
            v->wrong += !right;
        }
    v->pixels += width * height;
    return ++v->calls >= v->stop_at ? CGT_VISIT_STOP : CGT_VISIT_CONTINUE;
}

/* A visitor sees each pixel once, with its results: of all lights, of none, of occlusion; and it stops the call. */
TEST(visitors_see_shadows_and_occlusion)
{
    static uint8_t occluded[LIGHTS][WIDTH * HEIGHT];
    static float visibility[WIDTH * HEIGHT];
    const cgt_light lights[LIGHTS] = {{.position = {3, 5, 7}}, {CGT_LIGHT_DIRECTIONAL, {-1, 2, 1}}};
    pixels_visit *v = calloc(1, sizeof *v);
    cgt_shadow_options shadows = {.visitor = visit_pixels, .visitor_user = v};
    cgt_ambient_options ambient = {.samples = 3};
    planes p = planes_make(WIDTH, HEIGHT);
    cgt_frame frame = frame_with(&p, CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY | CGT_FIELD_NORMAL);
    assert_int_equal(cgt_trace_camera(scene, &camera, &frame, NULL), CGT_OK);
    assert_int_equal(cgt_occluded_frame(scene, &camera, &frame, lights, LIGHTS, NULL, occluded[0], NULL), CGT_OK);
    assert_int_equal(cgt_ambient_occlusion(scene, &camera, &frame, &ambient, visibility, NULL), CGT_OK);
    ambient.visitor = visit_pixels;
    ambient.visitor_user = v;
    for (int call = 0; call < 6; call++) { /* lights, none, occlusion; each once to the end, once stopped */
        const bool stops = call >= 3;
        *v = (pixels_visit){.expected_occluded = call % 3 == 0 ? occluded[0] : NULL,
                            .expected_visibility = call % 3 == 2 ? visibility : NULL};
        v->stop_at = stops ? 1 : UINT32_MAX;
        const cgt_result result = call % 3 == 2
                                      ? cgt_ambient_occlusion(scene, &camera, &frame, &ambient, v->visibility, NULL)
                                      : cgt_occluded_frame(scene, &camera, &frame, lights, call % 3 ? 0 : LIGHTS,
                                                           &shadows, v->occluded[0], NULL);
        assert_int_equal(result, stops ? CGT_ERROR_STOPPED : CGT_OK);
        assert_int_equal(v->wrong, 0);
        if (stops)
            assert_in_range(v->calls, 1, 3); /* those in progress on other threads */
        else
            assert_int_equal(v->pixels, WIDTH * HEIGHT);
    }
    planes_free(&p);
    free(v);
}

int main(void)
{
    test_begin("test_visitor");
    structure = CGT_STRUCTURE_QUEUE_GRID;
    const int failed = SUITE_RUN(open_scene, close_scene);
    structure = CGT_STRUCTURE_AUTO;
    return failed + SUITE_RUN(open_scene, close_scene);
}

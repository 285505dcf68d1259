/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pictures: a ball above a floor, and what lights, occlusion, outlines, depth cue and transparency must do
 * to its pixels. */
#include "picture_tiles.h"
#include "support/suite.h"
#include "support/test.h"

#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/picture.h>

enum { EDGE = 64, PIXELS = EDGE * EDGE, BALL = 0, FLOOR = 1 };

/* The camera looks down from (0, 0, 20) on the floor z = 0, 16 units wide; x to the right, y up. */
typedef struct stage {
    float ball[2][4]; /* radius 1 at (0, 0, 2), and one that a test may place */
    float wall[2][9];
    cgt_context *context;
    cgt_scene *scene;
    cgt_picture *picture;
    cgt_picture_options settings;
    uint8_t rgb[3 * PIXELS], alpha[PIXELS];
    cgt_linear_pixel pixels[PIXELS];
} stage;

static const uint16_t first_entry[2] = {0, 0};
static const float palette[3] = {0.5f, 0.25f, 0.125f};
static const uint32_t floor_index[6] = {0, 1, 2, 0, 2, 3};
static const float floor_corner[12] = {-8, -8, 0, 8, -8, 0, 8, 8, 0, -8, 8, 0};

/* Ball and floor, with a mask. */
static void set_opaque(stage *s, uint32_t mask)
{
    const int is_new = cgt_scene_get_geometries(s->scene) == 0;
    const cgt_spheres spheres = {
        .count = 2, .centers = cgt_floats(s->ball[0], 16), .radii = cgt_floats(s->ball[0] + 3, 16), .mask = mask};
    const cgt_triangles triangles = {.count = 2,
                                     .indices = cgt_uint32s(floor_index, 0),
                                     .vertex_count = 4,
                                     .vertices = cgt_floats(floor_corner, 0),
                                     .mask = mask};
    assert_int_equal(cgt_scene_set_spheres(s->scene, is_new ? NULL : &(uint32_t){BALL}, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(s->scene, is_new ? NULL : &(uint32_t){FLOOR}, &triangles), CGT_OK);
}

static void set_up(stage *s, uint32_t threads, const char *variant)
{
    const cgt_context_options options = {.threads = threads, .variant = variant};
    memset(s, 0, sizeof *s);
    s->ball[0][2] = 2.0f;
    s->ball[0][3] = s->ball[1][3] = 1.0f;
    s->ball[1][0] = 500.0f; /* out of the picture */
    s->settings =
        (cgt_picture_options){.width = EDGE, .height = EDGE, .shading = CGT_SHADING_FULL, .lighting.light_samples = 16};
    s->settings.lighting.light_count = 1;
    s->settings.lighting.lights[0] = (cgt_picture_light){
        .light = {.kind = CGT_LIGHT_DIRECTIONAL, .position = {0, 0, 1}}, .color = {1.0f, 1.0f, 1.0f}};
    assert_int_equal(cgt_context_create(&options, &s->context), CGT_OK);
    assert_int_equal(cgt_scene_create(s->context, NULL, &s->scene), CGT_OK);
    set_opaque(s, 0);
}

/* Of ball, floor, and walls that a test adds. */
static const cgt_look looks[4] = {{.index = first_entry, .palette = palette},
                                  {.index = first_entry, .palette = palette},
                                  {.color = {0.8f, 0.1f, 0.1f}},
                                  {.color = {0.1f, 0.1f, 0.8f}}};

/* Two layers of a wall each at these heights, of opacity 1/4 and 1/2, which fill the picture. */
static void add_walls(stage *s, float one, float other)
{
    static const uint16_t index[3] = {0, 1, 2};
    set_opaque(s, 1);
    for (uint32_t k = 0; k < 2; k++) {
        const float z = k ? other : one, corner[9] = {-40.0f, -20.0f, z, 40.0f, -20.0f, z, 0.0f, 60.0f, z};
        memcpy(s->wall[k], corner, sizeof corner);
        const cgt_triangles wall = {.count = 1,
                                    .indices = cgt_uint16s(index, 0),
                                    .vertex_count = 3,
                                    .vertices = cgt_floats(s->wall[k], 0),
                                    .mask = 2u << k};
        assert_int_equal(cgt_scene_set_triangles(s->scene, NULL, &wall), CGT_OK);
        s->settings.style.layers[k] = (cgt_picture_layer){2u << k, k ? 0.5f : 0.25f};
    }
    s->settings.style.layer_count = 2;
}

/* A layer of next to no opacity before everything, of opaque geometries of mask 1: it changes nothing, but has each ray
 * drawn. */
static void add_clear_wall(stage *s)
{
    const float corner[9] = {-40.0f, -20.0f, 15.0f, 40.0f, -20.0f, 15.0f, 0.0f, 60.0f, 15.0f};
    memcpy(s->wall[0], corner, sizeof corner);
    const cgt_triangles wall = {.count = 1, .vertex_count = 3, .vertices = cgt_floats(s->wall[0], 0), .mask = 2};
    assert_int_equal(cgt_scene_set_triangles(s->scene, NULL, &wall), CGT_OK);
    s->settings.style.layers[0] = (cgt_picture_layer){2, 1e-6f};
    s->settings.style.layer_count = 1;
}

static void set_camera(cgt_camera *camera)
{
    cgt_camera_init(camera);
    camera->eye[2] = 20.0f;
    camera->projection = CGT_PROJECTION_ORTHOGRAPHIC;
    camera->height = 16.0f;
}

static cgt_image image_of(stage *s) { return (cgt_image){.bytes = s->rgb, .alpha = s->alpha, .linear = s->pixels}; }

static cgt_result make(stage *s)
{
    cgt_camera camera;
    const cgt_image image = image_of(s);
    set_camera(&camera);
    assert_int_equal(cgt_scene_commit(s->scene), CGT_OK);
    cgt_picture_release(s->picture);
    assert_int_equal(cgt_picture_create(s->context, &s->settings, &s->picture), CGT_OK);
    return cgt_picture_draw(s->picture, s->scene, &camera, looks, 4, &image, NULL);
}

static void draw(stage *s) { assert_int_equal(make(s), CGT_OK); }

static void tear_down(stage *s)
{
    cgt_picture_release(s->picture);
    cgt_scene_release(s->scene);
    cgt_context_release(s->context);
}

/* The pixel at a place of the floor: four pixels a unit. */
static int at(float x, float y) { return (int)((8.0f - y) * 4.0f) * EDGE + (int)((x + 8.0f) * 4.0f); }

/* ---- Light -------------------------------------------------------------------------------------------------- */

TEST(light_follows_lambert_and_adds_up)
{
    static stage s;
    float one[3], other[3];
    set_up(&s, 1, NULL);
    draw(&s);
    assert_near(s.pixels[at(6.1f, 6.1f)].r, 0.5, 1e-6); /* straight on: the colour itself */
    assert_near(s.pixels[at(6.1f, 6.1f)].b, 0.125, 1e-6);
    assert_int_equal(cgt_picture_get_hits(s.picture), PIXELS);
    memcpy(s.settings.lighting.lights[0].light.position, (float[]){0.8f, 0.0f, 0.6f}, sizeof one);
    draw(&s);
    one[0] = s.pixels[at(6.1f, 6.1f)].r;
    assert_near(one[0], 0.5 * 0.6, 1e-6);
    s.settings.lighting.light_count = 0;
    s.settings.lighting.sky = 0.25f;
    draw(&s);
    other[0] = s.pixels[at(6.1f, 6.1f)].r;
    assert_near(other[0], 0.5 * 0.25, 1e-6);
    s.settings.lighting.light_count = 2; /* and a lamp straight above that pixel */
    s.settings.lighting.lights[1] =
        (cgt_picture_light){.light = {.position = {6.125f, 6.125f, 3.0f}}, .color = {0.5f, 0.5f, 0.5f}};
    draw(&s);
    assert_near(s.pixels[at(6.1f, 6.1f)].r, one[0] + other[0] + 0.25, 1e-4);
    assert_near(s.rgb[3 * at(6.1f, 6.1f)], 255.0 * cgt_srgb_from_linear(s.pixels[at(6.1f, 6.1f)].r), 1.0);
    tear_down(&s);
}

TEST(triangles_are_lit_on_the_side_that_is_seen)
{
    static const uint32_t turned[6] = {0, 2, 1, 0, 3, 2};
    static uint8_t before[3 * PIXELS];
    static stage s;
    set_up(&s, 1, NULL);
    draw(&s);
    memcpy(before, s.rgb, sizeof before);
    const cgt_triangles triangles = {
        .count = 2, .indices = cgt_uint32s(turned, 0), .vertex_count = 4, .vertices = cgt_floats(floor_corner, 0)};
    assert_int_equal(cgt_scene_set_triangles(s.scene, &(uint32_t){FLOOR}, &triangles), CGT_OK);
    draw(&s);
    assert_true(s.rgb[3 * at(6.1f, 6.1f)] > 0);
    assert_memory_equal(s.rgb, before, sizeof before);
    tear_down(&s);
}

TEST(hard_shadows_fall_where_they_should)
{
    static stage s;
    set_up(&s, 2, NULL);
    s.settings.lighting.sky = 0.1f;
    /* From the right, 45 degrees high: the ball at height 2 casts its shadow 2 to the left, 2.8 wide. */
    memcpy(s.settings.lighting.lights[0].light.position, (float[]){0.7071068f, 0, 0.7071068f}, 3 * sizeof(float));
    draw(&s);
    const float lit = s.pixels[at(-2.0f, 0.1f)].r;
    assert_near(lit, 0.5 * (0.1 + 0.7071068), 1e-4); /* nothing casts shadows yet */
    s.settings.lighting.lights[0].shadows = 1;
    draw(&s);
    assert_near(s.pixels[at(-2.0f, 0.1f)].r, 0.5 * 0.1, 1e-6);
    assert_near(s.pixels[at(-3.2f, 0.1f)].r, 0.5 * 0.1, 1e-6); /* 1.41 beyond the middle is the rim */
    assert_near(s.pixels[at(-3.7f, 0.1f)].r, lit, 1e-6);
    assert_near(s.pixels[at(2.0f, 0.1f)].r, lit, 1e-6);
    assert_near(s.pixels[at(-2.0f, 1.3f)].r, lit, 1e-6);
    /* A lamp on the left at twice the ball's height: the shadow goes to the right, and is larger. */
    s.settings.lighting.lights[0].light = (cgt_light){.kind = CGT_LIGHT_POINT, .position = {-4.0f, 0.0f, 4.0f}};
    draw(&s);
    assert_near(s.pixels[at(4.1f, 0.1f)].r, 0.5 * 0.1, 1e-6);
    assert_true(s.pixels[at(-2.0f, 0.1f)].r > lit);
    tear_down(&s);
}

/* What lies in the shadow has no light of its own averted side. */
TEST(averted_sides_lend_no_light)
{
    static stage s;
    set_up(&s, 1, NULL);
    s.ball[1][0] = 40.0f;
    s.ball[1][2] = 2.0f;
    s.ball[1][3] = 36.0f; /* between the light and the ball */
    s.settings.lighting.lights[0].light.position[0] = 1.0f;
    s.settings.lighting.lights[0].light.position[2] = 0.1f;
    s.settings.lighting.lights[0].shadows = true;
    s.settings.lighting.lights[0].size = 1.0f;
    draw(&s);
    for (float y = -0.9f; y < 1.0f; y += 0.1f)
        for (float x = -0.9f; x < 1.0f; x += 0.1f)
            if (x * x + y * y < 0.8f)
                assert_near(s.pixels[at(x, y)].r, 0.0, 1e-9);
    s.ball[1][0] = 500.0f;
    draw(&s);
    assert_true(s.pixels[at(0.5f, 0.1f)].r > 0.1f);
    tear_down(&s);
}

TEST(soft_shadows_have_penumbras)
{
    static stage s;
    int between = 0;
    set_up(&s, 2, NULL);
    s.settings.lighting.lights[0].shadows = 1;
    memcpy(s.settings.lighting.lights[0].light.position, (float[]){0.7071068f, 0, 0.7071068f}, 3 * sizeof(float));
    for (int lamp = 0; lamp < 2; lamp++) {
        if (lamp)
            s.settings.lighting.lights[0].light = (cgt_light){.kind = CGT_LIGHT_POINT, .position = {7.0f, 0.0f, 9.0f}};
        s.settings.lighting.lights[0].size = 0.0f;
        draw(&s);
        const float hard = s.pixels[at(-2.0f, 0.1f)].r, lit = s.pixels[at(-7.0f, 6.0f)].r;
        for (int x = 0; x < EDGE; x++)
            between += s.pixels[EDGE / 2 * EDGE + x].r > 0.05f && s.pixels[EDGE / 2 * EDGE + x].r < 0.25f;
        const int before = between;
        s.settings.lighting.lights[0].size = lamp ? 0.7f : 5.0f; /* the umbra is wider than the window of the mean */
        draw(&s);
        assert_near(hard, 0.0, 0.0);

        assert_near(s.pixels[at(-2.0f, -0.1f)].r, 0.0, 0.0); /* the umbra stays dark, the open floor lit */
        assert_near(s.pixels[at(-7.0f, 6.0f)].r, lit, 1e-6);
        for (int x = 0; x < EDGE / 2 - 6; x++)
            between += s.pixels[EDGE / 2 * EDGE + x].r > 0.05f && s.pixels[EDGE / 2 * EDGE + x].r < 0.25f;
        assert_true(between >= before + 2);
    }
    tear_down(&s);
}

/* Squares of lengths leave the range of float long before lengths do: a power of two changes no byte. */
TEST(lamps_shine_in_any_unit)
{
    static const int exponents[] = {0, -100, -64, 64, 96};
    static uint8_t first[3 * PIXELS];
    static stage s;
    for (int way = 0; way < 4; way++)
        for (size_t k = 0; k < TEST_COUNT(exponents); k++) {
            const float unit = ldexpf(1.0f, exponents[k]);
            float corner[12], normals[12];
            cgt_camera camera;
            set_camera(&camera);
            set_up(&s, 1, NULL);
            for (int i = 0; i < 12; i++) {
                corner[i] = floor_corner[i] * unit;
                normals[i] = i % 3 == 2 ? 3.0f * unit : unit;
            }
            for (int c = 0; c < 4; c++)
                s.ball[0][c] *= unit;
            s.ball[1][0] = 5.0f * unit;
            s.ball[1][3] = unit;
            camera.eye[2] *= unit;
            camera.height *= unit;
            set_opaque(&s, 0);
            const cgt_triangles ground = {.count = 2,
                                          .indices = cgt_uint32s(floor_index, 0),
                                          .vertex_count = 4,
                                          .vertices = cgt_floats(corner, 0)};
            assert_int_equal(cgt_scene_set_triangles(s.scene, &(uint32_t){FLOOR}, &ground), CGT_OK);
            assert_int_equal(cgt_scene_commit(s.scene), CGT_OK);
            s.settings.shading = way / 2 ? CGT_SHADING_BOUNCES : CGT_SHADING_FULL;
            s.settings.bounces.limit = way / 2 ? 2 : 0;
            s.settings.lighting.lights[0] = (cgt_picture_light){.light = {.position = {7 * unit, unit, 9 * unit}},
                                                                .color = {1.0f, 1.0f, 1.0f},
                                                                .size = way == 1 ? unit : 0.0f,
                                                                .shadows = true};
            const cgt_look both[2] = {looks[0],
                                      {.color = {0.5f, 0.5f, 0.5f}, .vertex_normals = normals, .sheet = true}};
            const cgt_image image = image_of(&s);
            assert_int_equal(cgt_picture_create(s.context, &s.settings, &s.picture), CGT_OK);
            assert_int_equal(cgt_picture_draw(s.picture, s.scene, &camera, both, 2, &image, NULL), CGT_OK);
            if (k == 0)
                memcpy(first, s.rgb, sizeof first);
            assert_memory_equal(first, s.rgb, sizeof first);
            assert_true(s.rgb[3 * at(-6.1f, 6.1f)] > 50);
            tear_down(&s);
        }
}

TEST(occlusion_darkens_what_is_near)
{
    static stage s;
    set_up(&s, 1, NULL);
    s.settings.lighting.light_count = 0;
    s.settings.lighting.sky = 1.0f;
    s.settings.lighting.ambient = 64;
    s.ball[0][2] = 1.0f; /* it touches the floor */
    draw(&s);
    /* Of the floor at a distance x, a touching unit ball occludes 1 / (x^2 + 1)^1.5, weighted by the cosine. */
    for (float x = 1.625f; x < 8.0f; x += 1.0f) /* the window of the mean lies on the floor alone */
        assert_near(s.pixels[at(x, 0.1f)].r, 0.5 * (1.0 - pow(x * x + 1.0, -1.5)), 0.03);
    s.settings.lighting.ambient_radius = 0.9f;
    draw(&s);
    assert_true(s.pixels[at(1.1f, 0.1f)].r < 0.45f);
    assert_near(s.pixels[at(2.1f, 0.1f)].r, 0.5, 1e-6); /* nothing within the radius */
    tear_down(&s);
}

/* What a sphere sees changes across a few rays: the mean over neighbours must not blur it. The same with four times as
 * many rays along each edge, among which it changes less, is nearer to the truth. */
TEST(the_mean_keeps_what_a_sphere_sees)
{
    static stage s;
    static float fine[PIXELS];
    double sum = 0.0;
    uint32_t count = 0;
    set_up(&s, 2, NULL);
    s.settings.lighting.light_count = 0;
    s.settings.lighting.sky = 1.0f;
    s.settings.lighting.ambient = 256;
    s.settings.antialias = 4;
    set_opaque(&s, 1);
    add_clear_wall(&s);                 /* so that each ray is drawn */
    s.ball[0][2] = s.ball[0][3] = 1.5f; /* on the floor: six pixels */
    draw(&s);
    for (uint32_t i = 0; i < PIXELS; i++)
        fine[i] = s.pixels[i].r;
    s.settings.antialias = 1;
    draw(&s);
    for (float y = -1.1f; y < 1.2f; y += 0.25f)
        for (float x = -1.1f; x < 1.2f; x += 0.25f)
            if (x * x + y * y < 1.5f) {
                const double error = (double)(s.pixels[at(x, y)].r - fine[at(x, y)]);
                sum += error * error;
                count++;
            }
    assert_true(sqrt(sum / count) < 0.0032); /* 0.0025; by an even mean 0.0039 */
    tear_down(&s);
}

/* The root of the mean square of what a picture of white balls with few rays to the sky differs by from one with 256,
 * where each pixel's rays have hit the ball. */
static double sky_error(stage *s, uint32_t antialias)
{
    static float fine[PIXELS];
    double sum = 0.0;
    uint32_t count = 0;
    s->settings.antialias = antialias;
    s->settings.lighting.ambient = 256;
    draw(s);
    for (uint32_t i = 0; i < PIXELS; i++)
        fine[i] = s->pixels[i].r;
    s->settings.lighting.ambient = 5;
    draw(s);
    for (float y = -4.6f; y < 4.7f; y += 0.25f)
        for (float x = -4.6f; x < 4.7f; x += 0.25f)
            if (x * x + y * y < 22.0f) {
                const double error = (double)(s->pixels[at(x, y)].r - fine[at(x, y)]);
                sum += error * error;
                count++;
            }
    return sqrt(sum / count);
}

/* The rays of a pixel are shared by those of antialiasing: with more of these its mean must not have more noise; nor
 * where a layer of next to no opacity wants each ray's. */
static void check_noise(uint32_t layers)
{
    static stage s;
    set_up(&s, 2, NULL);
    set_opaque(&s, 1);
    if (layers)
        add_clear_wall(&s);
    s.settings.lighting.light_count = 0;
    s.settings.lighting.sky = 1.0f;
    s.ball[0][2] = s.ball[0][3] = 5.0f; /* on the floor, and a small one on it */
    memcpy(s.ball[1], (float[]){1.5f, 0.5f, 10.5f, 1.0f}, sizeof s.ball[1]);
    const double one = sky_error(&s, 1), two = sky_error(&s, 2), four = sky_error(&s, 4);
    print_message("error of the sky by antialiasing: %.5f, %.5f, %.5f\n", one, two, four);
    assert_true(two < 0.9 * one && four < 0.6 * one);
    tear_down(&s);
}

TEST(noise_falls_with_antialiasing)
{
    if (!test_samples())
        check_noise(0);
    check_noise(1);
}

/* ---- Stability ---------------------------------------------------------------------------------------------- */

static void set_everything(stage *s)
{
    s->settings.lighting.ambient = 8;
    s->settings.lighting.ambient_radius = 3.0f;
    s->settings.antialias = 2;
    s->settings.lighting.sky = s->settings.lighting.head = 0.3f;
    s->settings.style.outline = 1.0f;
    s->settings.style.cue = 0.5f;
    s->settings.style.cue_range[0] = 15.0f;
    s->settings.style.cue_range[1] = 25.0f;
    s->settings.lighting.light_count = 3;
    s->settings.lighting.lights[1] =
        (cgt_picture_light){.light = {.position = {3.0f, 4.0f, 6.0f}}, .color = {0.2f, 0.3f, 0.4f}};
    s->settings.lighting.lights[2] = s->settings.lighting.lights[1];
    s->settings.lighting.lights[2].size = 1.0f;
    for (int i = 0; i < 3; i++)
        s->settings.lighting.lights[i].shadows = 1;
}

/* Where all rays of a pixel hit one ball or bond alike, the picture goes on with one for all of them. A layer before
 * it, of next to no opacity, keeps it from that: shadow edges and the two colours of a bond must look the same. */
TEST(whole_pixels_look_as_their_rays_do)
{
    static const float half_color[6] = {0.9f, 0.1f, 0.1f, 0.1f, 0.1f, 0.9f}, ends[6] = {-6, 6, 2, 6, 6.7f, 2};
    static const cgt_look bond = {.colors = half_color, .halves = true};
    static stage s;
    static cgt_linear_pixel whole[PIXELS];
    const cgt_capsules bonds = {
        .count = 1, .vertices = cgt_floats(ends, 0), .vertex_count = 2, .radius = 1.0f, .mask = 1};
    cgt_camera camera;
    uint32_t edges = 0;
    set_camera(&camera);
    for (uint32_t ambient = 0; ambient <= 256; ambient += 256)
        for (uint32_t antialias = 2; antialias <= (test_samples() ? 2 : 4); antialias += 2) {
            set_up(&s, 2, NULL);
            set_everything(&s);
            set_opaque(&s, 1);
            assert_int_equal(cgt_scene_set_capsules(s.scene, NULL, &bonds), CGT_OK);
            s.settings.antialias = antialias;
            s.settings.lighting.ambient = ambient;
            s.settings.lighting.light_count = ambient ? 0 : 2;      /* without noise, or nothing else */
            s.settings.lighting.lights[0].light.position[0] = 0.5f; /* so that a shadow lies beside the small ball */
            s.settings.style.outline = 0.0f;
            s.ball[0][3] = 5.0f;
            memcpy(s.ball[1], (float[]){1.5f, 0.5f, 10.5f, 1.0f}, sizeof s.ball[1]);
            const cgt_image image = image_of(&s);
            const cgt_look of[3] = {looks[BALL], looks[FLOOR], bond};
            double sum = 0.0;
            for (uint32_t layers = 0; layers < 2; layers++) {
                if (layers)
                    add_clear_wall(&s);
                assert_int_equal(cgt_scene_commit(s.scene), CGT_OK);
                cgt_picture_release(s.picture);
                assert_int_equal(cgt_picture_create(s.context, &s.settings, &s.picture), CGT_OK);
                assert_int_equal(cgt_picture_draw(s.picture, s.scene, &camera, of, 3, &image, NULL), CGT_OK);
                if (!layers)
                    memcpy(whole, s.pixels, sizeof whole);
            }
            for (uint32_t i = 0; i < PIXELS; i++) {
                const double error = (double)fabsf(whole[i].r - s.pixels[i].r) + fabsf(whole[i].b - s.pixels[i].b);
                assert_true(error < (ambient ? 0.04 : 0.016));
                assert_true(fabsf(whole[i].a - s.pixels[i].a) < 1e-5f);
                sum += error;
                edges += !ambient && fabsf(whole[i].r - whole[i ? i - 1 : 0].r) > 0.1f;
            }
            assert_true(sum / PIXELS < 0.001);
            tear_down(&s);
        }
    assert_true(edges > 100);
}

TEST(threads_and_variants_change_no_byte)
{
    static stage s;
    static uint8_t expected[3 * PIXELS];
    static cgt_linear_pixel expected_pixels[PIXELS];
    for (const char *const *name = cgt_get_variant_names(); *name; name++)
        for (uint32_t threads = 1; threads <= 3; threads += 2) {
            cgt_context *context;
            const cgt_context_options options = {.threads = 1, .variant = *name};
            if (cgt_context_create(&options, &context) != CGT_OK)
                continue; /* this CPU does not run it */
            cgt_context_release(context);
            set_up(&s, threads, *name);
            set_everything(&s);
            add_walls(&s, 1.0f, 4.0f);
            draw(&s);
            if (name == cgt_get_variant_names() && threads == 1) {
                memcpy(expected, s.rgb, sizeof expected);
                memcpy(expected_pixels, s.pixels, sizeof expected_pixels);
            }
            assert_memory_equal(expected, s.rgb, sizeof expected);
            assert_memory_equal(expected_pixels, s.pixels, sizeof expected_pixels);
            tear_down(&s);
        }
}

/* Where nothing moves within reach, a frame has the bytes of the one before: sampling does not flicker. */
TEST(what_stands_still_looks_the_same)
{
    static stage s;
    static uint8_t before[3 * PIXELS];
    int changed = 0;
    set_up(&s, 2, NULL);
    set_everything(&s);
    s.settings.style.outline = 0.0f;
    memcpy(s.ball[1], (float[]){-5.0f, -5.0f, 1.5f}, 3 * sizeof(float));
    draw(&s);
    memcpy(before, s.rgb, sizeof before);
    s.ball[1][0] = -4.5f;
    draw(&s);
    for (int y = 0; y < EDGE; y++)
        for (int x = 0; x < EDGE; x++) {
            const int differs = memcmp(before + 3 * (y * EDGE + x), s.rgb + 3 * (y * EDGE + x), 3) != 0;
            changed += differs;
            /* The ball and its shadows, all of them on the lower left. */
            if (differs && (y < EDGE / 2 || x > EDGE / 2))
                fail_msg("pixel %d, %d has changed", x, y);
        }
    assert_true(changed > 20);
    tear_down(&s);
}

/* ---- Lines and fades ---------------------------------------------------------------------------------------- */

TEST(outlines_surround_the_ball)
{
    static stage s;
    set_up(&s, 1, NULL);
    draw(&s);
    const float rim = s.pixels[at(-0.95f, 0.1f)].r, floor = s.pixels[at(-1.4f, 0.1f)].r;
    s.settings.style.outline = 1.0f;
    draw(&s);
    assert_true(rim > 0.05f);
    assert_near(s.pixels[at(-0.95f, 0.1f)].r, 0.0, 1e-6); /* black, on the nearer side */
    assert_near(s.pixels[at(-1.4f, 0.1f)].r, floor, 1e-6);
    assert_near(s.pixels[at(0.0f, 0.0f)].r, 0.5, 1e-2);
    assert_near(s.pixels[at(4.0f, -4.0f)].r, 0.5, 1e-6); /* the floor's two triangles are one plane: no line between */
    tear_down(&s);
}

TEST(depth_cue_fades_to_the_background)
{
    static stage s;
    set_up(&s, 1, NULL);
    memcpy(s.settings.style.background, (float[]){0.0f, 0.0f, 1.0f}, 3 * sizeof(float));
    s.settings.style.cue = 0.5f;
    s.settings.style.cue_range[0] = 17.0f; /* the ball's top */
    s.settings.style.cue_range[1] = 20.0f; /* the floor */
    draw(&s);
    assert_near(s.pixels[at(6.0f, 6.0f)].b, 0.5 * 0.125 + 0.5, 1e-5);
    assert_near(s.pixels[at(6.0f, 6.0f)].r, 0.25, 1e-5);
    assert_near(s.pixels[at(0.0f, 0.0f)].r, 0.5, 1e-2);
    tear_down(&s);
}

TEST(alpha_is_the_share_of_hits)
{
    static stage s;
    int partly = 0;
    set_up(&s, 1, NULL);
    assert_int_equal(cgt_scene_remove_geometry(s.scene, FLOOR), CGT_OK);
    s.settings.antialias = 2;
    s.settings.style.transparent = 1;
    s.settings.style.background[2] = 1.0f;
    draw(&s);
    assert_int_equal(s.alpha[at(0.0f, 0.0f)], 255);
    assert_int_equal(s.alpha[at(3.0f, 0.0f)], 0);
    for (int i = 0; i < PIXELS; i++)
        if (s.alpha[i] > 0 && s.alpha[i] < 255) {
            partly++;
            assert_true(s.rgb[3 * i + 2] <= s.rgb[3 * i]); /* no background in the colour */
            assert_near(s.pixels[i].a, s.alpha[i] / 255.0, 0.003);
            assert_near(s.pixels[i].b, s.pixels[i].r / 4.0, 1e-6); /* nor in the premultiplied one */
            assert_near(cgt_srgb_from_linear(s.pixels[i].r / s.pixels[i].a) * 255.0f, s.rgb[3 * i], 1.0);
        }
    assert_true(partly > 8);
    assert_int_equal(s.pixels[at(3.0f, 0.0f)].id, CGT_INVALID_ID);
    assert_true(s.pixels[at(3.0f, 0.0f)].a == 0.0f && s.pixels[at(3.0f, 0.0f)].b == 0.0f);
    assert_int_equal(s.pixels[at(0.0f, 0.0f)].id, 0);
    tear_down(&s);
}

static bool always(const void *user)
{
    (void)user;
    return true;
}

TEST(a_picture_stops_when_told_to)
{
    static stage s;
    char message[64];
    set_up(&s, 1, NULL);
    s.settings.work.stop = always;
    assert_int_equal(make(&s), CGT_ERROR_STOPPED);
    const size_t length = cgt_picture_get_error_message(s.picture, message, sizeof message);
    assert_int_equal(length, strlen(message));
    assert_string_equal(message, "the picture was stopped");
    tear_down(&s);
}

static bool count_asks(const void *user)
{
    atomic_fetch_add((atomic_uint *)(uintptr_t)user, 1);
    return false;
}

/* The first rays are asked about, too: of a large picture they take seconds. */
TEST(each_tile_asks_whether_to_stop)
{
    static stage s;
    atomic_uint asks = 0;
    cgt_camera camera;
    set_up(&s, 2, NULL);
    set_camera(&camera);
    s.settings.antialias = 4;
    s.settings.work.stop = count_asks;
    s.settings.work.stop_user = &asks;
    assert_int_equal(cgt_scene_commit(s.scene), CGT_OK);
    assert_int_equal(cgt_picture_create(s.context, &s.settings, &s.picture), CGT_OK);
    assert_int_equal(cgt_picture_begin(s.picture, s.scene, &camera, looks, 4, NULL), CGT_OK);
    assert_true(asks > 8);
    tear_down(&s);
}

/* What the camera does not see is in no mirror either. */
TEST(bounces_keep_the_mask_of_the_camera)
{
    static const cgt_material mirror = {.kind = CGT_MATERIAL_MIRROR, .color = {1, 1, 1}};
    static stage s;
    static float seen[2][4 * PIXELS];
    cgt_camera camera;
    set_camera(&camera);
    camera.mask = 1;
    for (int removed = 0; removed < 2; removed++) {
        const cgt_image image = image_of(&s);
        set_up(&s, 1, NULL);
        set_opaque(&s, 1);
        const cgt_spheres ball = {
            .count = 1, .centers = cgt_floats(s.ball[0], 16), .radii = cgt_floats(s.ball[0] + 3, 16), .mask = 2};
        assert_int_equal(removed ? cgt_scene_remove_geometry(s.scene, BALL)
                                 : cgt_scene_set_spheres(s.scene, &(uint32_t){BALL}, &ball),
                         CGT_OK);
        s.settings.shading = CGT_SHADING_BOUNCES;
        s.settings.bounces =
            (cgt_picture_bounces){.limit = 4, .material_count = 1, .materials = &mirror, .shadow_mask = 1};
        s.settings.style.background[2] = 1.0f;
        assert_int_equal(cgt_scene_commit(s.scene), CGT_OK);
        assert_int_equal(cgt_picture_create(s.context, &s.settings, &s.picture), CGT_OK);
        assert_int_equal(cgt_picture_draw(s.picture, s.scene, &camera, looks, 4, &image, NULL), CGT_OK);
        for (int i = 0; i < PIXELS; i++)
            memcpy(&seen[removed][4 * i], (float[]){s.pixels[i].r, s.pixels[i].g, s.pixels[i].b, s.pixels[i].a},
                   4 * sizeof(float));
        tear_down(&s);
    }
    assert_memory_equal(seen[0], seen[1], sizeof seen[0]);
    assert_true(seen[0][4 * at(0.0f, 0.0f) + 2] > 0.2f); /* the sky is there */
}

/* ---- Steps -------------------------------------------------------------------------------------------------- */

/* Steps of any size end at the bytes of a whole picture, with everything that a picture can have; before the first all
 * is as bright as it can be. */
TEST(steps_end_at_the_whole_picture)
{
    static const uint32_t sizes[4][3] = {{1, 1, 1},
                                         {3, 5, 2},
                                         {7, 1, UINT32_MAX},
                                         {41, 6, 16}}; /* some shares of 41 and 47, times that, are no whole numbers */
    static stage s;
    static uint8_t whole[3 * PIXELS], first[3 * PIXELS];
    static cgt_linear_pixel whole_pixels[PIXELS];
    cgt_camera camera;
    set_camera(&camera);
    for (uint32_t k = 0; k < 4; k++) {
        set_up(&s, 2, NULL);
        set_everything(&s);
        s.settings.antialias = k == 1 ? 2 : 1;
        s.settings.lighting.ambient = k == 3 ? 64 : 28; /* more than the lights have, and not a multiple of any step */
        s.settings.lighting.light_samples = 20;
        draw(&s);
        memcpy(whole, s.rgb, sizeof whole);
        memcpy(whole_pixels, s.pixels, sizeof whole_pixels);
        memset(s.rgb, 0, sizeof s.rgb);
        const cgt_image image = image_of(&s);
        assert_int_equal(cgt_picture_begin(s.picture, s.scene, &camera, looks, 2, NULL), CGT_OK);
        assert_int_equal(cgt_picture_read(s.picture, &image), CGT_OK);
        memcpy(first, s.rgb, sizeof first);
        uint32_t left = k == 1 ? 7 : s.settings.lighting.ambient, done = 0;
        for (uint32_t i = 0; left; i++) {
            const uint32_t before = left, size = sizes[k][i % 3];
            assert_int_equal(cgt_picture_step(s.picture, size, &left), CGT_OK);
            assert_int_equal(left, before < size ? 0 : before - size);
            assert_int_equal(cgt_picture_read(s.picture, &image), CGT_OK);
            done++;
        }
        assert_true(done >= 2);
        assert_memory_equal(whole, s.rgb, sizeof whole);
        assert_memory_equal(whole_pixels, s.pixels, sizeof whole_pixels);
        assert_memory_not_equal(whole, first, sizeof whole);
        for (int i = 0; i < 3 * PIXELS; i++)
            assert_true(first[i] >= whole[i]);
        assert_int_equal(cgt_picture_step(s.picture, 1, &left), CGT_OK); /* complete stays complete */
        assert_int_equal(left, 0);
        tear_down(&s);
    }
}

/* A large picture is drawn by bands of rows in the same memory, and by steps at once: the bytes are the same, with
 * whole pixels, layers and all the planes that there are. */
TEST(bands_have_the_bytes_of_steps)
{
    enum { WIDTH = 1000, HEIGHT = 210, BYTES = 3 * WIDTH * HEIGHT };
    static uint8_t drawn[BYTES], stepped[BYTES];
    static stage s;
    cgt_camera camera;
    set_camera(&camera);
    for (uint32_t layers = test_samples() ? 1 : 0; layers < 2; layers++) {
        const cgt_image image = {.bytes = drawn}, other = {.bytes = stepped};
        set_up(&s, 2, NULL);
        set_everything(&s);
        set_opaque(&s, 1);
        s.settings.width = WIDTH;
        s.settings.height = HEIGHT;
        s.settings.antialias = 4; /* 130 MB of planes */
        s.settings.lighting.ambient = s.settings.lighting.light_samples = 1;
        s.settings.style.outline = layers ? 3.0f : 0.0f;
        s.settings.style.layer_count = layers;
        s.settings.style.layers[0] = (cgt_picture_layer){2, 0.5f};
        s.ball[0][3] = 6.0f;
        assert_int_equal(cgt_scene_commit(s.scene), CGT_OK);
        assert_int_equal(cgt_picture_create(s.context, &s.settings, &s.picture), CGT_OK);
        assert_int_equal(cgt_picture_draw(s.picture, s.scene, &camera, looks, 2, &image, NULL), CGT_OK);
        const uint64_t hits = cgt_picture_get_hits(s.picture);
        uint32_t left = 1;
        assert_int_equal(cgt_picture_step(s.picture, 1, &left), CGT_OK);
        assert_int_equal(left, 0);
        if (!test_samples()) {
            assert_int_equal(cgt_picture_read(s.picture, &other), CGT_OK); /* draws it again */
            assert_memory_equal(drawn, stepped, BYTES);
            memset(stepped, 0, sizeof stepped);
        }
        assert_int_equal(cgt_picture_begin(s.picture, s.scene, &camera, looks, 2, NULL), CGT_OK);
        assert_int_equal(cgt_picture_step(s.picture, UINT32_MAX, NULL), CGT_OK);
        assert_int_equal(cgt_picture_read(s.picture, &other), CGT_OK);
        assert_memory_equal(drawn, stepped, BYTES);
        assert_int_equal(hits, cgt_picture_get_hits(s.picture));
        tear_down(&s);
    }
}

/* Rows alone have the bytes of the whole: those of averages, outlines and soft lights, which look at rows around them,
 * too. Other pixels stay. */
TEST(rows_have_the_bytes_of_the_whole)
{
    static const uint32_t rows[][2] = {{0, 23}, {23, 1}, {24, 9}, {33, 0}};
    static stage s, untouched;
    static uint8_t whole[3 * PIXELS], whole_alpha[PIXELS];
    static cgt_linear_pixel whole_pixels[PIXELS];
    cgt_picture *kept[5]; /* so that none gets memory in which the rows of another are */
    memset(&untouched, 0x55, sizeof untouched);
    for (uint32_t k = 0; k < 5; k++) {
        set_up(&s, 2, NULL);
        set_everything(&s);
        s.settings.antialias = 1u << k % 3;
        s.settings.style.outline = k == 2 ? 1.6f : s.settings.style.outline;
        if (k == 1)
            add_walls(&s, 2.0f, 4.0f);
        s.settings.shading = k == 3 ? CGT_SHADING_PLAIN : CGT_SHADING_FULL;
        s.settings.style.transparent = k == 4;
        s.settings.lighting.light_count = k == 3 ? 0 : s.settings.lighting.light_count;
        draw(&s);
        memcpy(whole, s.rgb, sizeof whole);
        memcpy(whole_alpha, s.alpha, sizeof whole_alpha);
        memcpy(whole_pixels, s.pixels, sizeof whole_pixels);
        kept[4] = s.picture;
        memset(s.rgb, 0x55, sizeof s.rgb);
        memset(s.alpha, 0x55, sizeof s.alpha);
        memset(s.pixels, 0x55, sizeof s.pixels);
        for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
            const size_t first = (size_t)rows[i][0] * EDGE;
            s.settings.work.first_row = rows[i][0];
            s.settings.work.row_count = rows[i][1];
            assert_memory_equal(s.rgb + 3 * first, untouched.rgb + 3 * first, sizeof s.rgb - 3 * first);
            assert_memory_equal(s.pixels + first, untouched.pixels + first, sizeof s.pixels - first * sizeof *s.pixels);
            s.picture = NULL;
            draw(&s);
            kept[i] = s.picture;
        }
        s.picture = NULL;
        for (size_t i = 0; i < 5; i++)
            cgt_picture_release(kept[i]);
        assert_memory_equal(whole, s.rgb, sizeof whole);
        assert_memory_equal(whole_alpha, s.alpha, sizeof whole_alpha);
        assert_memory_equal(whole_pixels, s.pixels, sizeof whole_pixels);
        tear_down(&s);
    }
}

/* The error of a picture in the middle of its steps falls as samples grow: it is not worse than that of fewer. */
TEST(steps_come_nearer)
{
    static stage s;
    static uint8_t whole[3 * PIXELS];
    cgt_camera camera;
    double before = INFINITY;
    uint32_t left;
    set_camera(&camera);
    set_up(&s, 1, NULL);
    s.settings.lighting.sky = 1.0f;
    s.settings.lighting.ambient = 256;
    s.settings.lighting.light_count = 0;
    draw(&s);
    memcpy(whole, s.rgb, sizeof whole);
    const cgt_image image = image_of(&s);
    assert_int_equal(cgt_picture_begin(s.picture, s.scene, &camera, looks, 2, NULL), CGT_OK);
    for (uint32_t size = 4; size <= 64; size *= 4) {
        double error = 0.0;
        assert_int_equal(cgt_picture_step(s.picture, size - size / 4, &left), CGT_OK);
        assert_int_equal(cgt_picture_read(s.picture, &image), CGT_OK);
        for (int i = 0; i < 3 * PIXELS; i++)
            error += fabs((double)s.rgb[i] - (double)whole[i]);
        assert_true(error < 0.8 * before);
        before = error;
    }
    tear_down(&s);
}

/* ---- Images ------------------------------------------------------------------------------------------------- */

TEST(images_of_all_kinds_agree)
{
    enum { ROW = 4 * EDGE + 12 };
    static stage s;
    static uint8_t rgba[ROW * EDGE];
    const cgt_image image = {.bytes = rgba, .channels = 4, .row_stride = ROW};
    for (int kind = 0; kind < 6; kind++) {
        const int plain = kind >= 2, transparent = kind == 1; /* plain pictures are opaque, whatever is asked for */
        set_up(&s, 1, NULL);
        assert_int_equal(cgt_scene_remove_geometry(s.scene, FLOOR), CGT_OK);
        s.settings.shading = plain ? CGT_SHADING_PLAIN : CGT_SHADING_FULL;
        s.settings.style.transparent = kind == 1 || kind == 3;
        s.settings.antialias = kind == 4 ? 2 : kind == 5 ? 4 : 1;
        s.settings.style.background[2] = 0.3f;
        draw(&s);
        memset(rgba, 77, sizeof rgba);
        assert_int_equal(cgt_picture_read(s.picture, &image), CGT_OK);
        for (int i = 0; i < PIXELS; i++) {
            const uint8_t *const p = rgba + i / EDGE * ROW + i % EDGE * 4;
            assert_memory_equal(p, s.rgb + 3 * i, 3);
            assert_int_equal(p[3], s.alpha[i]);
            assert_int_equal(s.alpha[i], transparent && s.pixels[i].id == CGT_INVALID_ID ? 0 : 255);
            assert_true(s.pixels[i].a == s.alpha[i] / 255.0f);
            assert_int_equal(p[0], cgt_srgb_encode(s.pixels[i].r));
            assert_int_equal(p[2], cgt_srgb_encode(p[3] ? s.pixels[i].b : 0.3f));
        }
        for (int y = 0; y < EDGE; y++)
            assert_int_equal(rgba[y * ROW + 4 * EDGE], 77);
        tear_down(&s);
    }
}

/* Ray light through the layers: the nearest first. */
static float mixed(float near_color, float near_opacity, float far_color, float far_opacity, float behind)
{
    return near_opacity * near_color +
           (1.0f - near_opacity) * (far_opacity * far_color + (1.0f - far_opacity) * behind);
}

TEST(layers_are_mixed_by_depth)
{
    static stage s;
    const cgt_linear_pixel *const p = &s.pixels[at(6.1f, 4.1f)]; /* not where the floor's triangles meet */
    const cgt_linear_pixel *const on_ball = &s.pixels[at(0.1f, 0.1f)];
    for (int soft = 0; soft < 2; soft++) {
        set_up(&s, 2, NULL);
        add_walls(&s, 4.0f, 8.0f);
        s.settings.lighting.lights[0].shadows = 1; /* which no layer casts */
        s.settings.lighting.lights[0].size = soft ? 5.0f : 0.0f;
        s.settings.lighting.ambient = 4;
        s.settings.antialias = soft ? 2 : 1;
        draw(&s); /* ball and floor are 0.5, 0.25, 0.125 */
        assert_near(on_ball->r, mixed(0.1f, 0.5f, 0.8f, 0.25f, 0.5f), 0.005);
        assert_near(p->r, mixed(0.1f, 0.5f, 0.8f, 0.25f, 0.5f), 1e-6);
        assert_near(p->b, mixed(0.8f, 0.5f, 0.1f, 0.25f, 0.125f), 1e-6);
        assert_near(p->depth, 12.0, 1e-4);
        assert_near(s.rgb[3 * at(6.1f, 4.1f)], 255.0 * cgt_srgb_from_linear(p->r), 1.0);
        assert_int_equal(cgt_picture_get_hits(s.picture), soft ? 4 * PIXELS : PIXELS);
        tear_down(&s);
    }
    set_up(&s, 2, NULL);
    add_walls(&s, 8.0f, 4.0f);
    draw(&s);
    assert_near(p->r, mixed(0.8f, 0.25f, 0.1f, 0.5f, 0.5f), 1e-6);
    const cgt_image image = image_of(&s);
    cgt_camera camera;
    set_camera(&camera);
    camera.mask = 1 | 4; /* without the red wall */
    assert_int_equal(cgt_picture_draw(s.picture, s.scene, &camera, looks, 4, &image, NULL), CGT_OK);
    assert_near(p->r, 0.5 * 0.1 + 0.5 * 0.5, 1e-6);
    assert_near(p->depth, 16.0, 1e-4);
    tear_down(&s);
    set_up(&s, 2, NULL);
    add_walls(&s, 8.0f, -1.0f); /* one is below the floor */
    draw(&s);
    assert_near(p->r, 0.25 * 0.8 + 0.75 * 0.5, 1e-6);
    const cgt_triangles none = {.count = 0};
    assert_int_equal(cgt_scene_set_triangles(s.scene, &(uint32_t){FLOOR}, &none), CGT_OK);
    s.settings.style.transparent = true;
    draw(&s);
    assert_near(p->a, mixed(1.0f, 0.25f, 1.0f, 0.5f, 0.0f), 1e-6);
    assert_near(p->r, mixed(0.8f, 0.25f, 0.1f, 0.5f, 0.0f), 1e-6);
    assert_int_equal(s.alpha[at(6.1f, 4.1f)], 159); /* 0.625 */
    tear_down(&s);
}

/* The ball's shadow falls on a layer, and on the floor below it, elsewhere. */
TEST(layers_get_shadows)
{
    static stage s;
    set_up(&s, 2, NULL);
    add_walls(&s, 0.5f, -1.0f);
    s.settings.lighting.lights[0].shadows = 1;
    memcpy(s.settings.lighting.lights[0].light.position, (float[]){0.7071068f, 0, 0.7071068f}, 3 * sizeof(float));
    for (int soft = 0; soft < 2; soft++) {
        s.settings.lighting.lights[0].size = soft ? 0.1f : 0.0f;
        draw(&s);
        assert_near(s.pixels[at(-1.9f, 0.1f)].r, 0.0, 1e-6); /* both in shadow */
        if (!soft)
            assert_near(s.pixels[at(-3.2f, 0.1f)].r, 0.25 * 0.8 * 0.7071068, 1e-4);
        assert_near(s.pixels[at(6.1f, 4.1f)].r, (0.25 * 0.8 + 0.75 * 0.5) * 0.7071068, 1e-4);
    }
    tear_down(&s);
}

/* Outlines of a layer are at its rims, not where something opaque hides it. */
TEST(layers_have_outlines)
{
    static stage s;
    static cgt_linear_pixel without[PIXELS];
    uint32_t lines = 0;
    set_up(&s, 2, NULL);
    add_walls(&s, 2.0f, -1.0f); /* through the middle of the ball */
    draw(&s);
    memcpy(without, s.pixels, sizeof without);
    s.settings.style.outline = 1.0f;
    draw(&s);
    for (int y = 0; y < EDGE; y++)
        for (int x = 0; x < EDGE; x++) {
            const float dx = ((float)x + 0.5f) / 4.0f - 8.0f, dy = 8.0f - ((float)y + 0.5f) / 4.0f,
                        away = hypotf(dx, dy);
            const int differs = s.pixels[y * EDGE + x].r < without[y * EDGE + x].r - 1e-4f;
            lines += (uint32_t)differs;
            if (differs && away > 1.05f)
                fail_msg("a line at %g, %g", (double)dx, (double)dy);
        }
    assert_true(lines > 8);
    tear_down(&s);
}

/* ---- Defaults and errors ------------------------------------------------------------------------------------ */

TEST(zeros_are_the_defaults)
{
    static stage s;
    static uint8_t expected[3 * PIXELS];
    for (int shading = CGT_SHADING_PLAIN; shading <= CGT_SHADING_FULL; shading++) {
        set_up(&s, 1, NULL);
        cgt_picture_options_init(&s.settings);
        s.settings.width = s.settings.height = EDGE;
        s.settings.shading = (cgt_shading)shading;
        draw(&s);
        memcpy(expected, s.rgb, sizeof expected);
        assert_true(s.rgb[3 * at(0.0f, 0.0f)] > 60); /* there is light */
        s.settings = (cgt_picture_options){.width = EDGE, .height = EDGE, .shading = (cgt_shading)shading};
        draw(&s);
        assert_memory_equal(expected, s.rgb, sizeof expected);
        tear_down(&s);
    }
}

TEST(colours_come_from_all_places)
{
    static const float colors[6] = {0.25f, 0.5f, 0.125f, 1.0f, 0.0f, 0.0f};
    static const float corners[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    static stage s;
    cgt_camera camera;
    set_camera(&camera);
    for (int shading = CGT_SHADING_PLAIN; shading <= CGT_SHADING_FULL; shading++) {
        set_up(&s, 1, NULL);
        s.settings.shading = (cgt_shading)shading;
        draw(&s);
        const cgt_image image = image_of(&s);
        const cgt_look given[2] = {{.colors = colors}, {.colors = corners, .per_vertex = true}};
        assert_int_equal(cgt_picture_draw(s.picture, s.scene, &camera, given, 2, &image, NULL), CGT_OK);
        const cgt_linear_pixel ball = s.pixels[at(0.0f, 0.0f)], floor = s.pixels[at(6.0f, -6.0f)];
        assert_near(ball.g, 2.0f * ball.r, 1e-5);
        assert_near(ball.b, 0.5f * ball.r, 1e-5);
        assert_true(floor.g > 3.0f * floor.r && floor.g > 3.0f * floor.b); /* near the vertex of green */
        assert_true(floor.r > 0.0f);
        /* indices of another format, and none: the same pixels */
        static uint8_t expected[3 * PIXELS];
        static const uint16_t narrow[6] = {0, 1, 2, 0, 2, 3};
        cgt_triangles other = {
            .count = 2, .indices = cgt_uint16s(narrow, 0), .vertex_count = 4, .vertices = cgt_floats(floor_corner, 0)};
        memcpy(expected, s.rgb, sizeof expected);
        assert_int_equal(cgt_scene_set_triangles(s.scene, &(uint32_t){FLOOR}, &other), CGT_OK);
        assert_int_equal(cgt_scene_commit(s.scene), CGT_OK);
        assert_int_equal(cgt_picture_draw(s.picture, s.scene, &camera, given, 2, &image, NULL), CGT_OK);
        assert_memory_equal(expected, s.rgb, sizeof expected);
        assert_int_equal(cgt_picture_draw(s.picture, s.scene, &camera, NULL, 0, &image, NULL), CGT_OK); /* grey */
        assert_near(s.pixels[at(0.0f, 0.0f)].r, s.pixels[at(0.0f, 0.0f)].b, 0.0);
        assert_true(s.pixels[at(0.0f, 0.0f)].r > 0.5f);
        tear_down(&s);
    }
}

/* A capsule across the picture: the colours of its ends meet in the middle. */
TEST(capsules_have_a_colour_at_each_end)
{
    static const float ends[6] = {-5.0f, 3.0f, 3.0f, 5.0f, 3.0f, 3.0f}, colors[6] = {1, 0, 0, 0, 1, 0};
    const cgt_capsules capsules = {.count = 1, .vertex_count = 2, .vertices = cgt_floats(ends, 0), .radius = 1.0f};
    static stage s;
    cgt_camera camera;
    set_camera(&camera);
    for (int shading = CGT_SHADING_PLAIN; shading <= CGT_SHADING_FULL; shading++) {
        set_up(&s, 1, NULL);
        s.settings.shading = (cgt_shading)shading;
        assert_int_equal(cgt_scene_set_capsules(s.scene, NULL, &capsules), CGT_OK);
        draw(&s);
        const cgt_image image = image_of(&s);
        const cgt_look given[3] = {looks[0], looks[1], {.colors = colors, .halves = true}};
        assert_int_equal(cgt_picture_draw(s.picture, s.scene, &camera, given, 3, &image, NULL), CGT_OK);
        for (float x = -5.9f; x < 6.0f; x += 0.25f) {
            const cgt_linear_pixel stick = s.pixels[at(x, 3.0f)];
            assert_true(x < 0.0f ? stick.r > 0.0f && stick.g == 0.0f : stick.g > 0.0f && stick.r == 0.0f);
        }
        tear_down(&s);
    }
}

/* Each bad option is refused by a sentence that names it. */
TEST(bad_options_have_their_sentences)
{
    static const struct {
        cgt_picture_options options;
        const char *word;
    } bad[] = {{{.width = 65537}, "65537 x 720"},
               {{.width = 20000, .antialias = 4}, "20000 x 720"},
               {{.antialias = 3}, "antialias 3"},
               {{.work.first_row = 720}, "0 rows from row 720"},
               {{.work.first_row = 700, .work.row_count = 21}, "21 rows from row 700"},
               {{.shading = (cgt_shading)3}, "shading 3"},
               {{.lighting.light_count = 9}, "9 lights"},
               {{.lighting.light_count = 1, .lighting.lights[0].light.kind = CGT_LIGHT_DIRECTIONAL}, "length 0"},
               {{.lighting.light_count = 1, .lighting.lights[0].light.position[1] = NAN}, "light 0: position"},
               {{.lighting.light_count = 1, .lighting.lights[0].size = -1.0f}, "light 0: size"},
               {{.lighting.light_count = 1, .lighting.lights[0].color[2] = -1.0f}, "light 0: colour"},
               {{.lighting.light_count = 1}, "must be a direction"},
               {{.lighting.light_count = 1, .lighting.lights[0].light.kind = (cgt_light_kind)7}, "kind 7"},
               {{.lighting.ambient = 257}, "257 rays"},
               {{.lighting.light_samples = 257}, "257 to a light"},
               {{.lighting.ambient_radius = -1.0f}, "ambient_radius -1"},
               {{.lighting.sky = NAN}, "sky"},
               {{.lighting.head = -1.0f}, "head -1"},
               {{.style.background[1] = -1.0f}, "background"},
               {{.style.cue = 2.0f}, "cue 2"},
               {{.style.cue = 1.0f}, "cue from 0 to 0"},
               {{.style.outline = INFINITY}, "outline inf"},
               {{.style.layer_count = 9}, "9 layers: at most 8"},
               {{.style.layer_count = 1, .style.layers[0] = {2, 1.5f}}, "layer 0: opacity 1.5"},
               {{.style.layer_count = 1}, "layer 0: mask 0"},
               {{.style.layer_count = 1, .style.layers[0] = {UINT32_MAX, 0.5f}}, "one must be left"},
               {{.style.layer_count = 2, .style.layers = {{2, 0.5f}, {6, 0.5f}}}, "layer 1: mask 0x6"},
               {{.bounces.limit = 65}, "65 bounces"},
               {{.bounces.material_count = 1}, "materials must not be NULL"},
               {{.bounces.up[0] = INFINITY}, "up inf"}};
    static stage s;
    set_up(&s, 1, NULL);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char message[256] = "";
        const cgt_picture_options options = bad[i].options;
        cgt_picture *picture;
        if (cgt_picture_create(s.context, &options, &picture) != CGT_ERROR_INVALID_ARGUMENT ||
            cgt_picture_set_options(picture, NULL) != CGT_ERROR_INVALID_ARGUMENT ||
            cgt_picture_step(picture, 1, NULL) != CGT_ERROR_INVALID_ARGUMENT)
            fail_msg("%s was taken", bad[i].word);
        cgt_picture_get_error_message(picture, message, sizeof message);
        cgt_picture_release(picture);
        if (!strstr(message, bad[i].word))
            fail_msg("'%s' does not say '%s'", message, bad[i].word);
    }
    assert_int_equal(cgt_picture_create(s.context, NULL, NULL), CGT_ERROR_INVALID_ARGUMENT);
    tear_down(&s);
}

static void expect_error(stage *s, cgt_result result, const char *word)
{
    char message[256];
    assert_int_equal(result, CGT_ERROR_INVALID_ARGUMENT);
    cgt_picture_get_error_message(s->picture, message, sizeof message);
    if (!strstr(message, word))
        fail_msg("'%s' does not say '%s'", message, word);
}

TEST(bad_calls_have_their_sentences)
{
    static const cgt_look no_palette = {.index = first_entry}, no_indices = {.colors = palette, .per_vertex = true},
                          no_triangles = {.vertex_normals = palette}, dark = {.color[0] = -1.0f},
                          no_capsules = {.halves = true};
    static stage s;
    cgt_camera camera, wrong;
    uint32_t left;
    set_camera(&camera);
    wrong = camera;
    memcpy(wrong.target, wrong.eye, sizeof wrong.eye);
    set_up(&s, 1, NULL);
    draw(&s);
    const cgt_image image = image_of(&s), narrow = {.bytes = s.rgb, .row_stride = EDGE}, two = {.channels = 2};
    expect_error(&s, cgt_picture_begin(s.picture, s.scene, NULL, NULL, 0, NULL), "camera");
    expect_error(&s, cgt_picture_begin(s.picture, s.scene, &camera, NULL, 1, NULL), "looks");
    expect_error(&s, cgt_picture_begin(s.picture, NULL, &camera, NULL, 0, NULL), "scene");
    expect_error(&s, cgt_picture_begin(s.picture, s.scene, &camera, &no_palette, 1, NULL), "look 0: index without");
    expect_error(&s, cgt_picture_begin(s.picture, s.scene, &camera, &no_indices, 1, NULL), "per_vertex");
    expect_error(&s, cgt_picture_begin(s.picture, s.scene, &camera, &no_triangles, 1, NULL), "vertex_normals");
    expect_error(&s, cgt_picture_begin(s.picture, s.scene, &camera, &no_capsules, 1, NULL), "halves are for capsules");
    expect_error(&s, cgt_picture_begin(s.picture, s.scene, &camera, &dark, 1, NULL), "colour -1");
    expect_error(&s, cgt_picture_begin(s.picture, s.scene, &wrong, NULL, 0, NULL), "camera");
    expect_error(&s, cgt_picture_read(s.picture, &image), "after cgt_picture_begin");
    expect_error(&s, cgt_picture_step(s.picture, 1, &left), "after cgt_picture_begin");
    expect_error(&s, cgt_picture_begin_tiles(s.picture, s.scene, &camera, NULL, 0, &image, NULL), "plain shading");
    assert_int_equal(cgt_picture_begin(s.picture, s.scene, &camera, looks, 2, NULL), CGT_OK);
    expect_error(&s, cgt_picture_read(s.picture, NULL), "an image");
    expect_error(&s, cgt_picture_read(s.picture, &narrow), "row_stride");
    expect_error(&s, cgt_picture_read(s.picture, &two), "2 channels");
    assert_int_equal(cgt_picture_read(s.picture, &image), CGT_OK); /* an image that was refused spoils nothing */
    assert_int_equal(cgt_picture_begin(NULL, s.scene, &camera, NULL, 0, NULL), CGT_ERROR_INVALID_ARGUMENT);
    tear_down(&s);
}

/* ---- Mirrors and glass -------------------------------------------------------------------------------------- */

/* A mirror straight above the floor shows the camera's side of the sky; glass of index 1 shows what is behind it. */
TEST(mirrors_and_glass_bounce)
{
    static const cgt_material materials[3] = {
        {0}, {.kind = CGT_MATERIAL_MIRROR, .color = {0.5f, 0.5f, 0.5f}}, {.kind = CGT_MATERIAL_GLASS, .index = 1.0f}};
    static stage s;
    cgt_camera camera;
    set_camera(&camera);
    set_up(&s, 2, NULL);
    s.settings.shading = CGT_SHADING_BOUNCES;
    s.settings.bounces.materials = materials;
    s.settings.bounces.material_count = 3;
    s.settings.bounces.limit = 4;
    s.settings.lighting.sky = 0.25f;
    s.settings.style.background[0] = 0.8f;
    assert_int_equal(cgt_picture_create(s.context, &s.settings, &s.picture), CGT_OK);
    assert_int_equal(cgt_scene_commit(s.scene), CGT_OK);
    cgt_look both[2] = {{.material = 1}, {.sheet = true, .index = first_entry, .palette = palette}};
    const cgt_image image = image_of(&s);
    assert_int_equal(cgt_picture_draw(s.picture, s.scene, &camera, both, 2, &image, NULL), CGT_OK);
    const float lit = s.pixels[at(6.1f, 6.1f)].r;
    assert_near(lit, 0.5 * 1.25, 1e-5);
    assert_near(s.pixels[at(0.1f, 0.1f)].r, 0.5 * 0.8 * (1.0 - 0.65 * 0.24606), 1e-4); /* half the sky, a bit up */
    assert_true(s.pixels[at(0.1f, 0.1f)].b < 0.01f);
    both[0].material = 2;
    both[0].ids = (const uint32_t[2]){7, 8};
    cgt_trace_statistics traced;
    const cgt_trace_options trace = {.statistics = &traced};
    assert_int_equal(cgt_picture_draw(s.picture, s.scene, &camera, both, 2, &image, &trace), CGT_OK);
    assert_true(traced.rays == PIXELS && traced.hits == PIXELS);
    assert_int_equal(s.pixels[at(0.1f, 0.1f)].id, 7);
    assert_near(s.pixels[at(0.1f, 0.1f)].g, 0.25 * 0.25, 1e-5); /* the floor behind it, in the shadow */
    uint8_t whole[3 * PIXELS];
    memcpy(whole, s.rgb, sizeof whole);
    memset(s.rgb, 0x55, sizeof s.rgb);
    for (s.settings.work.first_row = 0; s.settings.work.first_row < EDGE;
         s.settings.work.first_row += s.settings.work.row_count) {
        s.settings.work.row_count = s.settings.work.first_row ? 37 : 27;
        assert_int_equal(s.rgb[(size_t)3 * EDGE * s.settings.work.first_row], 0x55);
        assert_int_equal(cgt_picture_set_options(s.picture, &s.settings), CGT_OK);
        assert_int_equal(cgt_picture_draw(s.picture, s.scene, &camera, both, 2, &image, NULL), CGT_OK);
    }
    assert_memory_equal(whole, s.rgb, sizeof whole);
    both[0].material = 3;
    expect_error(&s, cgt_picture_draw(s.picture, s.scene, &camera, both, 2, &image, NULL), "material that does not");
    both[0].material = 1; /* the floor has the default look, and free ids are no geometries */
    assert_int_equal(cgt_scene_set_spheres(s.scene, &(uint32_t){CGT_INVALID_ID}, &(cgt_spheres){0}), CGT_OK);
    assert_int_equal(cgt_scene_remove_geometry(s.scene, 2), CGT_OK);
    assert_int_equal(cgt_scene_commit(s.scene), CGT_OK);
    assert_int_equal(cgt_picture_draw(s.picture, s.scene, &camera, both, 1, &image, NULL), CGT_OK);
    const cgt_capsules capsules = {.count = 1, .vertex_count = 2, .vertices = cgt_floats(floor_corner, 0)};
    assert_int_equal(cgt_scene_set_capsules(s.scene, NULL, &capsules), CGT_OK);
    assert_int_equal(cgt_scene_commit(s.scene), CGT_OK);
    expect_error(&s, cgt_picture_draw(s.picture, s.scene, &camera, both, 1, &image, NULL), "spheres or triangles");
    static const uint8_t types[2] = {0, 0};
    cgt_spheres typed = {.count = 2, .centers = cgt_floats(s.ball[0], 16), .radii = cgt_floats(s.ball[0] + 3, 16)};
    for (int i = 0; i < 2; i++) {
        typed.origin[1] = i ? 0.0 : 1.0;
        typed.types = i ? cgt_uint8s(types, 0) : (cgt_array){0};
        typed.type_count = (uint32_t)i;
        assert_int_equal(cgt_scene_set_spheres(s.scene, &(uint32_t){BALL}, &typed), CGT_OK);
        assert_int_equal(cgt_scene_commit(s.scene), CGT_OK);
        expect_error(&s, cgt_picture_draw(s.picture, s.scene, &camera, both, 1, &image, NULL), "origin and types");
    }
    tear_down(&s);
}

SUITE(NULL, NULL)

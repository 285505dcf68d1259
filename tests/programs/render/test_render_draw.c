/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Drawing in cgt-render: a ball above a floor, and what lights, occlusion, outlines, depth cue and transparency must do
 * to its pixels. */
#include "support/suite.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "picture/draw/draw.h"

enum { EDGE = 64, PIXELS = EDGE * EDGE, BALL = 0, FLOOR = 1 };

/* The camera looks down from (0, 0, 20) on the floor z = 0, 16 units wide; x to the right, y up. */
typedef struct stage {
    float ball[2][4]; /* radius 1 at (0, 0, 2), and one that a test may place */
    cgt_context *context;
    cgt_scene *scene;
    drawing drawing;
    draw_settings settings;
    srgb_tables tables;
    uint8_t rgb[3 * PIXELS], alpha[PIXELS];
    image_pixel pixels[PIXELS];
} stage;

static const uint16_t first_entry[2] = {0, 0};
static const float palette[1][3] = {{0.5f, 0.25f, 0.125f}};
static const uint32_t floor_index[6] = {0, 1, 2, 0, 2, 3};
static const float floor_corner[12] = {-8, -8, 0, 8, -8, 0, 8, 8, 0, -8, 8, 0};

static void set_up(stage *s, uint32_t threads, const char *variant)
{
    const cgt_context_options options = {.threads = threads, .variant = variant};
    memset(s, 0, sizeof *s);
    s->ball[0][2] = 2.0f;
    s->ball[0][3] = s->ball[1][3] = 1.0f;
    s->ball[1][0] = 500.0f; /* out of the picture */
    srgb_tables_init(&s->tables);
    s->settings = (draw_settings){.width = EDGE, .height = EDGE, .samples = 1, .light_samples = 16, .threads = threads};
    s->settings.light_count = 1;
    s->settings.lights[0] =
        (draw_light){.light = {.kind = CGT_LIGHT_DIRECTIONAL, .position = {0, 0, 1}}, .color = {1.0f, 1.0f, 1.0f}};
    assert_int_equal(cgt_context_create(&options, &s->context), CGT_OK);
    assert_int_equal(cgt_scene_create(s->context, NULL, &s->scene), CGT_OK);
    const cgt_spheres spheres = {
        .count = 2, .centers = s->ball[0], .center_stride = 16, .radii = s->ball[0] + 3, .radius_stride = 16};
    const cgt_triangles triangles = {.count = 2, .indices = floor_index, .vertex_count = 4, .vertices = floor_corner};
    assert_int_equal(cgt_scene_add_spheres(s->scene, &spheres, NULL), CGT_OK);
    assert_int_equal(cgt_scene_add_triangles(s->scene, &triangles, NULL), CGT_OK);
}

static void draw(stage *s)
{
    cgt_camera camera;
    cgt_camera_init(&camera);
    camera.eye[2] = 20.0f;
    camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
    camera.height = 16.0f;
    assert_int_equal(cgt_scene_commit(s->scene), CGT_OK);
    draw_free(&s->drawing);
    memset(&s->drawing, 0, sizeof s->drawing);
    assert_int_equal(draw_init(&s->drawing, &s->settings, &s->tables), 0);
    s->drawing.rgb = s->rgb;
    s->drawing.alpha = s->alpha;
    s->drawing.pixels = s->pixels;
    for (int i = 0; i < 2; i++)
        s->drawing.surfaces[i] = (surface){.index = first_entry, .palette = palette, .palette_steps = 1};
    s->drawing.surfaces[FLOOR].triangle = floor_index;
    assert_int_equal(draw_frame(&s->drawing, s->scene, &camera, NULL), CGT_OK);
}

static void tear_down(stage *s)
{
    draw_free(&s->drawing);
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
    assert_int_equal(s.drawing.hits, PIXELS);
    memcpy(s.settings.lights[0].light.position, (float[]){0.8f, 0.0f, 0.6f}, sizeof one);
    draw(&s);
    one[0] = s.pixels[at(6.1f, 6.1f)].r;
    assert_near(one[0], 0.5 * 0.6, 1e-6);
    s.settings.light_count = 0;
    s.settings.sky = 0.25f;
    draw(&s);
    other[0] = s.pixels[at(6.1f, 6.1f)].r;
    assert_near(other[0], 0.5 * 0.25, 1e-6);
    s.settings.light_count = 2; /* and a lamp straight above that pixel */
    s.settings.lights[1] = (draw_light){.light = {.position = {6.125f, 6.125f, 3.0f}}, .color = {0.5f, 0.5f, 0.5f}};
    draw(&s);
    assert_near(s.pixels[at(6.1f, 6.1f)].r, one[0] + other[0] + 0.25, 1e-4);
    assert_near(s.rgb[3 * at(6.1f, 6.1f)], 255.0 * srgb_from_linear(s.pixels[at(6.1f, 6.1f)].r), 1.0);
    tear_down(&s);
}

TEST(hard_shadows_fall_where_they_should)
{
    static stage s;
    set_up(&s, 2, NULL);
    s.settings.sky = 0.1f;
    /* From the right, 45 degrees high: the ball at height 2 casts its shadow 2 to the left, 2.8 wide. */
    memcpy(s.settings.lights[0].light.position, (float[]){0.7071068f, 0, 0.7071068f}, 3 * sizeof(float));
    draw(&s);
    const float lit = s.pixels[at(-2.0f, 0.1f)].r;
    assert_near(lit, 0.5 * (0.1 + 0.7071068), 1e-4); /* nothing casts shadows yet */
    s.settings.lights[0].shadows = 1;
    draw(&s);
    assert_near(s.pixels[at(-2.0f, 0.1f)].r, 0.5 * 0.1, 1e-6);
    assert_near(s.pixels[at(-3.2f, 0.1f)].r, 0.5 * 0.1, 1e-6); /* 1.41 beyond the middle is the rim */
    assert_near(s.pixels[at(-3.7f, 0.1f)].r, lit, 1e-6);
    assert_near(s.pixels[at(2.0f, 0.1f)].r, lit, 1e-6);
    assert_near(s.pixels[at(-2.0f, 1.3f)].r, lit, 1e-6);
    /* A lamp on the left at twice the ball's height: the shadow goes to the right, and is larger. */
    s.settings.lights[0].light = (cgt_light){.kind = CGT_LIGHT_POINT, .position = {-4.0f, 0.0f, 4.0f}};
    draw(&s);
    assert_near(s.pixels[at(4.1f, 0.1f)].r, 0.5 * 0.1, 1e-6);
    assert_true(s.pixels[at(-2.0f, 0.1f)].r > lit);
    tear_down(&s);
}

TEST(soft_shadows_have_penumbras)
{
    static stage s;
    int between = 0;
    set_up(&s, 2, NULL);
    s.settings.lights[0].shadows = 1;
    memcpy(s.settings.lights[0].light.position, (float[]){0.7071068f, 0, 0.7071068f}, 3 * sizeof(float));
    for (int lamp = 0; lamp < 2; lamp++) {
        if (lamp)
            s.settings.lights[0].light = (cgt_light){.kind = CGT_LIGHT_POINT, .position = {7.0f, 0.0f, 9.0f}};
        s.settings.lights[0].size = 0.0f;
        draw(&s);
        const float hard = s.pixels[at(-2.0f, 0.1f)].r, lit = s.pixels[at(-7.0f, -6.0f)].r;
        for (int x = 0; x < EDGE; x++)
            between += s.pixels[EDGE / 2 * EDGE + x].r > 0.05f && s.pixels[EDGE / 2 * EDGE + x].r < 0.25f;
        const int before = between;
        s.settings.lights[0].size = lamp ? 1.0f : 8.0f;
        draw(&s);
        assert_near(hard, 0.0, 0.0);

        assert_near(s.pixels[at(-2.0f, -0.1f)].r, 0.0, 0.0); /* the umbra stays dark, the open floor lit */
        assert_near(s.pixels[at(-7.0f, -6.0f)].r, lit, 1e-6);
        for (int x = 0; x < EDGE / 2 - 6; x++)
            between += s.pixels[EDGE / 2 * EDGE + x].r > 0.05f && s.pixels[EDGE / 2 * EDGE + x].r < 0.25f;
        assert_true(between >= before + 2);
    }
    tear_down(&s);
}

TEST(occlusion_darkens_what_is_near)
{
    static stage s;
    set_up(&s, 1, NULL);
    s.settings.light_count = 0;
    s.settings.sky = 1.0f;
    s.settings.ambient = 64;
    s.ball[0][2] = 1.0f; /* it touches the floor */
    draw(&s);
    /* Of the floor at a distance x, a touching unit ball occludes 1 / (x^2 + 1)^1.5, weighted by the cosine. */
    for (float x = 1.125f; x < 8.0f; x += 1.0f)
        assert_near(s.pixels[at(x, 0.1f)].r, 0.5 * (1.0 - pow(x * x + 1.0, -1.5)), 0.03);
    s.settings.ambient_radius = 0.9f;
    draw(&s);
    assert_true(s.pixels[at(1.1f, 0.1f)].r < 0.45f);
    assert_near(s.pixels[at(2.1f, 0.1f)].r, 0.5, 1e-6); /* nothing within the radius */
    tear_down(&s);
}

/* ---- Stability ---------------------------------------------------------------------------------------------- */

static void set_everything(stage *s)
{
    s->settings.ambient = 8;
    s->settings.ambient_radius = 3.0f;
    s->settings.samples = 2;
    s->settings.sky = s->settings.head = 0.3f;
    s->settings.outline = 1.0f;
    s->settings.cue = 0.5f;
    s->settings.cue_near = 15.0f;
    s->settings.cue_far = 25.0f;
    s->settings.light_count = 3;
    s->settings.lights[1] = (draw_light){.light = {.position = {3.0f, 4.0f, 6.0f}}, .color = {0.2f, 0.3f, 0.4f}};
    s->settings.lights[2] = s->settings.lights[1];
    s->settings.lights[2].size = 1.0f;
    for (int i = 0; i < 3; i++)
        s->settings.lights[i].shadows = 1;
}

TEST(threads_and_variants_change_no_byte)
{
    static stage s;
    static uint8_t expected[3 * PIXELS];
    static image_pixel expected_pixels[PIXELS];
    for (const char *const *name = cgt_get_variant_names(); *name; name++)
        for (uint32_t threads = 1; threads <= 3; threads += 2) {
            cgt_context *context;
            const cgt_context_options options = {.threads = 1, .variant = *name};
            if (cgt_context_create(&options, &context) != CGT_OK)
                continue; /* this CPU does not run it */
            cgt_context_release(context);
            set_up(&s, threads, *name);
            set_everything(&s);
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
    s.settings.outline = 0.0f;
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
    s.settings.outline = 1.0f;
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
    memcpy(s.settings.background, (float[]){0.0f, 0.0f, 1.0f}, 3 * sizeof(float));
    s.settings.cue = 0.5f;
    s.settings.cue_near = 17.0f; /* the ball's top */
    s.settings.cue_far = 20.0f;  /* the floor */
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
    s.settings.samples = 2;
    s.settings.transparent = 1;
    s.settings.background[2] = 1.0f;
    draw(&s);
    assert_int_equal(s.alpha[at(0.0f, 0.0f)], 255);
    assert_int_equal(s.alpha[at(3.0f, 0.0f)], 0);
    for (int i = 0; i < PIXELS; i++)
        if (s.alpha[i] > 0 && s.alpha[i] < 255) {
            partly++;
            assert_true(s.rgb[3 * i + 2] <= s.rgb[3 * i]); /* no background in the colour */
            assert_near(s.pixels[i].a, s.alpha[i] / 255.0, 0.003);
            assert_near(s.pixels[i].b, s.pixels[i].r / 4.0, 1e-6); /* nor in the premultiplied one */
            assert_near(srgb_from_linear(s.pixels[i].r / s.pixels[i].a) * 255.0f, s.rgb[3 * i], 1.0);
        }
    assert_true(partly > 8);
    assert_int_equal(s.pixels[at(3.0f, 0.0f)].id, CGT_INVALID_ID);
    assert_true(s.pixels[at(3.0f, 0.0f)].a == 0.0f && s.pixels[at(3.0f, 0.0f)].b == 0.0f);
    assert_int_equal(s.pixels[at(0.0f, 0.0f)].id, 0);
    tear_down(&s);
}

TEST(a_frame_stops_when_told_to)
{
    static stage s;
    static const stop_flag stop = 1;
    cgt_camera camera;
    set_up(&s, 1, NULL);
    draw(&s);
    s.drawing.settings.stop = &stop;
    cgt_camera_init(&camera);
    camera.eye[2] = 20.0f;
    assert_int_equal(draw_frame(&s.drawing, s.scene, &camera, NULL), CGT_ERROR_STOPPED);
    tear_down(&s);
}

SUITE(NULL, NULL)

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Plain shading: tiles made by hand, and the light and colours that their pixels must have. */
#include "picture_tiles.h"
#include "support/suite.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include <cgt/picture.h>

typedef struct tile_case {
    float t[16], normal[3][16], u[16], v[16];
    uint32_t primitive[16];
    cgt_tile tile;
    cgt_context *context;
    cgt_scene *scene; /* NULL: of spheres */
    cgt_picture *picture;
    cgt_look look;
    uint32_t fields; /* that tiles must have */
    uint8_t rgb[16 * 3];
    cgt_linear_pixel pixels[16];
    bool stop;
    uint16_t index[2];
    float palette[3][3];
} tile_case;

static bool is_stopped(const void *user) { return ((const tile_case *)user)->stop; }

/* A frame of 4x4 hits, all of them misses; light and eye in front. */
static void set_up(tile_case *c, uint32_t samples)
{
    memset(c, 0, sizeof *c);
    for (int i = 0; i < 16; i++) {
        c->t[i] = INFINITY;
        c->primitive[i] = CGT_INVALID_ID;
    }
    c->tile = (cgt_tile){.width = 4,
                         .height = 4,
                         .row_stride = 4,
                         .t = c->t,
                         .primitive = c->primitive,
                         .normal = {c->normal[0], c->normal[1], c->normal[2]},
                         .u = c->u,
                         .v = c->v};
    c->index[1] = 1;
    for (int k = 0; k < 3; k++)
        c->palette[1][k] = 0.25f * (float)(k + 1);
    const cgt_picture_options options = {
        .width = 4 / samples,
        .height = 4 / samples,
        .antialias = samples,
        .lighting.light_count = 1,
        .lighting.lights[0].light = {.kind = CGT_LIGHT_DIRECTIONAL, .position = {0.0f, 0.0f, 1.0f}},
        .style.background[0] = 0.5f,
        .work.stop = is_stopped,
        .work.stop_user = c};
    assert_int_equal(cgt_context_create(NULL, &c->context), CGT_OK);
    assert_int_equal(cgt_picture_create(c->context, &options, &c->picture), CGT_OK);
    c->look = (cgt_look){.index = c->index, .palette = c->palette[0]};
}

/* The tile is of triangles: of their shapes nothing is read. */
static void set_triangles(tile_case *c, const uint32_t *indices, uint32_t count)
{
    static const float corners[12];
    const cgt_triangles triangles = {
        .count = count, .indices = cgt_uint32s(indices, 0), .vertex_count = 4, .vertices = cgt_floats(corners, 0)};
    assert_int_equal(cgt_scene_create(c->context, NULL, &c->scene), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(c->scene, NULL, &triangles), CGT_OK);
}

static void tear_down(tile_case *c)
{
    cgt_picture_release(c->picture);
    cgt_scene_release(c->scene);
    cgt_context_release(c->context);
}

/* Makes a picture of the tile. */
static cgt_visit shade(tile_case *c)
{
    const cgt_image image = {.bytes = c->rgb, .linear = c->pixels};
    cgt_camera camera;
    cgt_camera_init(&camera);
    camera.fov = 0.01f; /* all rays go along -z, nearly */
    assert_int_equal(cgt_picture_begin_tiles(c->picture, c->scene, &camera, &c->look, 1, &image, &c->fields), CGT_OK);
    return cgt_picture_visit_tile(c->picture, &c->tile);
}

static void hit(tile_case *c, int pixel, uint32_t primitive, float t, float nx, float nz)
{
    c->primitive[pixel] = primitive;
    c->t[pixel] = t;
    c->normal[0][pixel] = nx;
    c->normal[2][pixel] = nz;
}

TEST(shading_lights_what_faces_it)
{
    static tile_case c;
    set_up(&c, 1);
    hit(&c, 0, 1, 2.0f, 0.0f, 1.0f);
    hit(&c, 1, 1, 2.0f, 0.8f, 0.6f);
    hit(&c, 2, 1, 2.0f, 1.0f, 0.0f);
    hit(&c, 3, 0, 2.0f, 0.0f, 1.0f);
    hit(&c, 5, 1, 2.0f, 0.0f, -1.0f); /* from inside: only the headlight reaches it */
    assert_int_equal(shade(&c), 0);
    assert_int_equal(cgt_picture_get_hits(c.picture), 5);
    assert_true(c.pixels[5].r > c.pixels[2].r && c.pixels[5].r < c.pixels[1].r);
    assert_true(c.pixels[0].r > c.pixels[1].r && c.pixels[1].r > c.pixels[2].r && c.pixels[2].r > 0.0f);
    assert_near(c.pixels[0].g / c.pixels[0].r, 2.0, 1e-5); /* the palette's proportions */
    assert_near(c.pixels[0].b / c.pixels[0].r, 3.0, 1e-5);
    assert_near(c.pixels[3].r, 0.0, 0.0); /* a black sphere stays black */
    assert_near(c.pixels[4].r, 0.5, 0.0); /* nothing hit */
    assert_int_equal(c.pixels[4].id, CGT_INVALID_ID);
    assert_true(isinf(c.pixels[4].depth));
    assert_int_equal(c.rgb[4 * 3], 188); /* 0.5 in sRGB */
    assert_int_equal(c.rgb[4 * 3 + 1], 0);
    assert_near(c.rgb[0], cgt_srgb_from_linear(c.pixels[0].r) * 255.0f, 1.0);
    tear_down(&c);
}

/* Both sides of a triangle are lit alike, by the normals of its vertices if it has them. */
TEST(shading_of_triangles)
{
    static const uint32_t vertices[6] = {0, 1, 2, 0, 1, 3};
    static const float normals[12] = {0, 0, 5, 0, 0, 0.1f, 0.6f, 0, 0.8f, 0, 0, 0};
    static tile_case c;
    set_up(&c, 1);
    set_triangles(&c, vertices, sizeof vertices / sizeof *vertices / 3);
    hit(&c, 0, 1, 2.0f, 0.0f, 1.0f);
    hit(&c, 1, 1, 2.0f, 0.0f, -1.0f); /* seen from behind */
    hit(&c, 2, 1, 2.0f, 0.6f, 0.8f);
    assert_int_equal(shade(&c), 0);
    assert_int_equal(c.fields & CGT_FIELD_UV, 0);
    assert_true(c.pixels[0].r == c.pixels[1].r && c.pixels[2].r < c.pixels[0].r);
    const float flat = c.pixels[0].r, tilted = c.pixels[2].r;

    c.look.vertex_normals = normals;
    for (int i = 0; i < 4; i++)
        hit(&c, i, 0, 2.0f, 0.0f, i == 1 ? -1.0f : 1.0f);
    c.v[1] = c.v[2] = 1.0f; /* at vertex 2, from behind and from the front */
    c.v[3] = 0.5f;          /* between the vertices 0 and 2, whose normals' lengths do not matter */
    hit(&c, 4, 1, 2.0f, 0.0f, 1.0f);
    c.v[4] = 1.0f; /* at vertex 3, which has no normal: the triangle's own */
    assert_int_equal(shade(&c), 0);
    assert_true(c.fields & CGT_FIELD_UV);
    assert_near(c.pixels[0].r, flat * 0.0f, 0.0); /* primitive 0 is black */
    c.index[0] = 1;
    assert_int_equal(shade(&c), 0);
    assert_near(c.pixels[0].r, flat, 1e-6);
    assert_near(c.pixels[1].r, tilted, 1e-5);
    assert_near(c.pixels[2].r, tilted, 1e-5);
    const float half = cosf(0.5f * acosf(0.8f));
    assert_near(c.pixels[3].r, tilted + (flat - tilted) * (half - 0.8f) / 0.2f, 1e-4); /* linear in the cosine */
    assert_near(c.pixels[4].r, flat, 1e-6);
    tear_down(&c);
}

/* Colours of vertices are interpolated along the palette; an unknown one stays unknown. */
TEST(shading_mixes_colours)
{
    static const uint32_t vertices[3] = {0, 1, 2};
    static const uint16_t entries[3] = {0, 2, 2};
    static tile_case c;
    set_up(&c, 1);
    for (int k = 0; k < 3; k++) {
        c.palette[1][k] = k == 1 ? 1.0f : 0.0f;
        c.palette[2][k] = k == 2 ? 1.0f : 0.0f;
    }
    set_triangles(&c, vertices, sizeof vertices / sizeof *vertices / 3);
    c.look.index = entries;
    c.look.per_vertex = true;
    c.look.palette_steps = 3;
    for (int i = 0; i < 3; i++)
        hit(&c, i, 0, 2.0f, 0.0f, 1.0f);
    c.u[1] = c.v[1] = 0.25f;
    c.u[2] = 0.25f;
    c.v[2] = 0.75f;
    assert_int_equal(shade(&c), 0);
    assert_true(c.fields & CGT_FIELD_UV);
    assert_true(c.pixels[0].g == 0.0f && c.pixels[0].b == 0.0f);
    assert_true(c.pixels[1].g > 0.0f && c.pixels[1].b == 0.0f);
    assert_true(c.pixels[2].g == 0.0f && c.pixels[2].b > 0.0f);
    c.look.palette_steps = 2;
    assert_int_equal(shade(&c), 0);
    assert_true(c.pixels[0].b > 0.0f && c.pixels[1].b > 0.0f);
    tear_down(&c);
}

/* Each half of a capsule has a colour. */
TEST(shading_tells_the_halves_of_capsules)
{
    static const uint16_t entries[6] = {0, 0, 1, 2, 0, 0};
    static tile_case c;
    set_up(&c, 1);
    for (int k = 0; k < 3; k++) {
        c.palette[1][k] = k == 1 ? 1.0f : 0.0f;
        c.palette[2][k] = k == 2 ? 1.0f : 0.0f;
    }
    c.look.index = entries;
    c.look.halves = true;
    for (int i = 0; i < 3; i++)
        hit(&c, i, 1, 2.0f, 0.0f, 1.0f);
    c.u[1] = 0.49f;
    c.u[2] = 0.51f;
    assert_int_equal(shade(&c), 0);
    assert_true(c.fields & CGT_FIELD_UV);
    assert_true(c.pixels[0].g > 0.0f && c.pixels[0].b == 0.0f);
    assert_true(c.pixels[1].g > 0.0f && c.pixels[1].b == 0.0f);
    assert_true(c.pixels[2].g == 0.0f && c.pixels[2].b > 0.0f);
    tear_down(&c);
}

TEST(shading_averages_light_and_keeps_the_nearest)
{
    static tile_case one, four;
    set_up(&one, 1);
    hit(&one, 0, 1, 3.0f, 0.0f, 1.0f);
    assert_int_equal(shade(&one), 0);
    set_up(&four, 2);
    hit(&four, 0, 1, 3.0f, 0.0f, 1.0f);
    hit(&four, 5, 0, 2.0f, 0.0f, 1.0f);
    assert_int_equal(shade(&four), 0);
    assert_near(four.pixels[0].r, (one.pixels[0].r + 0.0f + 0.5f + 0.5f) / 4.0f, 1e-6);
    assert_int_equal(four.pixels[0].id, 0);
    assert_near(four.pixels[0].depth, 2.0, 0.0);
    assert_int_equal(four.pixels[3].id, CGT_INVALID_ID);
    assert_int_equal(cgt_picture_get_hits(four.picture), 2);
    tear_down(&one);
    tear_down(&four);
}

TEST(shading_stops_when_told_to)
{
    static tile_case c;
    set_up(&c, 2);
    c.stop = true;
    assert_int_not_equal(shade(&c), 0);
    c.stop = false;
    assert_int_equal(shade(&c), 0);
    c.tile.x = 1; /* would split a block of samples */
    assert_int_not_equal(shade(&c), 0);
    tear_down(&c);
}

SUITE(NULL, NULL)

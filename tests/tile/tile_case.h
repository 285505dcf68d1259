/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera, a tile of 8x8 pixels of its picture, and a ray of it. Included by tests that have included the kernels of
 * tiles. */
#ifndef TILE_CASE_H
#define TILE_CASE_H

#include "support/suite.h"
#include "support/test.h"

#include "query/tile_limits.h"

typedef struct tile_case {
    cgt_camera_rays rays;
    uint32_t at[2]; /* the tile's first pixel */
    bool parallel;
    float scale;
    cgt_exact_ray line; /* of a pixel of the tile */
} tile_case;

static inline void make_case_rays(const cgt_camera *camera, uint32_t edge, cgt_camera_rays *rays)
{
    char message[160];
    assert_int_equal(cgt_camera_prepare(camera, edge, edge, rays, message), CGT_OK);
}

/* Any camera, at any scale, and a tile of 8x8 pixels somewhere in its picture. */
static inline tile_case make_camera_case(test_random *r, bool parallel)
{
    tile_case c = {.parallel = parallel};
    cgt_camera camera;
    const float scale = c.scale = random_below(r, 3) ? 1 : random_log(r, 1e-6f, 1e6f);
    const float offset = random_below(r, 2) ? 0 : random_log(r, 0.1f, 1e4f);
    cgt_camera_init(&camera);
    for (int a = 0; a < 3; a++) {
        camera.eye[a] = scale * random_float(r, -1, 1) * offset;
        camera.target[a] = camera.eye[a] + scale * (a == 1 ? 2 : random_float(r, -1, 1));
    }
    random_direction(r, camera.up);
    camera.fov = random_below(r, 2) ? random_float(r, 20, 100) : random_log(r, 0.5f, 160);
    if (parallel) {
        camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
        camera.height = scale * (random_below(r, 2) ? random_float(r, 0.5f, 4) : random_log(r, 1e-3f, 30));
        if (random_below(r, 3) == 0) /* along an axis */
            for (int a = 0; a < 3; a++) {
                camera.target[a] = camera.eye[a] + (a == 2 ? scale : 0);
                camera.up[a] = a == 1;
            }
    }
    const uint32_t edge = 8 + random_below(r, random_below(r, 2) ? 1000 : 20);
    make_case_rays(&camera, edge, &c.rays);
    c.at[0] = random_below(r, edge - 7);
    c.at[1] = random_below(r, edge - 7);
    const float px = ((float)(c.at[0] + random_below(r, 8)) + 0.5f) * c.rays.pixel[0] - 1;
    const float py = 1 - ((float)(c.at[1] + random_below(r, 8)) + 0.5f) * c.rays.pixel[1];
    c.line = tile_pixel_line(&c.rays, parallel, px, py);
    return c;
}

/* What does not depend on the kind of primitives, as cgt_tile_init sets it. */
static inline void begin_tile(tile *t, const tile_case *c)
{
    t->rays = &c->rays;
    t->columns = t->rows = 8;
    tile_init_camera(&c->rays, &t->camera);
    tile_init_parallel(t);
    tile_init_tables(t, c->at[0], c->at[1]);
    tile_init_norms(t);
    tile_init_parts(t);
    tile_init_cone(t);
}

#endif

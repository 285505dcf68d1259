/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Spheres in a cube and points among them, for tests of shadow rays. */
#ifndef CGT_LIT_SCENE_H
#define CGT_LIT_SCENE_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dispatch/kernel.h"
#include "scene/scene.h"
#include "support/scenes.h"

#define LIT_EDGE 64u /* points along each axis of a piece of a surface */

typedef struct lit_scene {
    float (*sphere)[4];
    uint32_t prims, mask; /* mask: as of cgt_spheres */
    float *at[3];
    uint32_t points;
    uint8_t *got, *expected;
    cgt_trace_statistics statistics;
    cgt_research_trace_statistics research;
} lit_scene;

static const cgt_light lit_lights[] = {
    {CGT_LIGHT_POINT, {2, 3, -2.5f}},       {CGT_LIGHT_POINT, {0, 0, 0}},
    {CGT_LIGHT_POINT, {0.1f, 0.9f, 0.2f}},  {CGT_LIGHT_POINT, {0.6f, 0.4f, -1.2f}},
    {CGT_LIGHT_DIRECTIONAL, {1, 2, -1.5f}}, {CGT_LIGHT_DIRECTIONAL, {0, 0, 1}},
};

static inline void lit_scene_make(test_random *r, uint32_t prims, uint32_t points, lit_scene *s)
{
    *s = (lit_scene){.prims = prims, .points = points};
    s->sphere = malloc(prims * sizeof *s->sphere);
    s->got = malloc(points);
    s->expected = malloc(points);
    assert_true(s->sphere && s->got && s->expected);
    const float radius = 0.4f * cbrtf(8 / (float)prims);
    for (uint32_t i = 0; i < prims; i++)
        for (int a = 0; a < 4; a++)
            s->sphere[i][a] = a == 3 ? radius : random_float(r, -1, 1);
    for (int a = 0; a < 3; a++)
        assert_non_null(s->at[a] = malloc(points * sizeof(float)));
}

static inline void lit_scene_free(lit_scene *s)
{
    for (int a = 0; a < 3; a++)
        free(s->at[a]);
    free(s->sphere);
    free(s->got);
    free(s->expected);
}

static inline void lit_scatter(test_random *r, lit_scene *s)
{
    for (int a = 0; a < 3; a++)
        for (uint32_t i = 0; i < s->points; i++)
            s->at[a][i] = random_float(r, -1, 1);
}

/* Square pieces of a plane, one after the other, as tiles of a picture show them. */
static inline void lit_lay_in_tiles(lit_scene *s)
{
    for (uint32_t i = 0; i < s->points; i++) {
        const uint32_t tile = i / (LIT_EDGE * LIT_EDGE), x = i % LIT_EDGE, y = i / LIT_EDGE % LIT_EDGE;
        s->at[0][i] = -0.9f + 0.4f * (float)(tile % 4) + 0.4f * (float)x / LIT_EDGE;
        s->at[1][i] = -0.9f + 0.4f * (float)(tile / 4) + 0.4f * (float)y / LIT_EDGE;
        s->at[2][i] = -0.8f;
    }
}

static inline cgt_scene *lit_commit(cgt_context *context, const lit_scene *s, cgt_structure structure)
{
    cgt_spheres spheres = spheres_of((const float(*)[4])s->sphere, s->prims);
    cgt_scene_options options;
    cgt_scene *scene;
    cgt_scene_options_init(&options);
    options.structure = structure;
    spheres.mask = s->mask;
    assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* Options of a call whose counts the scene gets. */
static inline void lit_count(lit_scene *s, cgt_trace_options *options, cgt_research_trace_options *research)
{
    cgt_trace_options_init(options);
    cgt_research_trace_options_init(research);
    options->statistics = &s->statistics;
    options->research = research;
    research->statistics = &s->research;
}

/* Traces points first to first + count - 1. Returns the work of each: as with 16 lanes, a reference takes one lane. */
static inline double lit_trace(const cgt_scene *scene, const cgt_light *light, lit_scene *s, uint32_t first,
                               uint32_t count, uint8_t *occluded)
{
    const cgt_points points = {.count = count, .position = {s->at[0] + first, s->at[1] + first, s->at[2] + first}};
    cgt_research_trace_options research;
    cgt_trace_options options;
    lit_count(s, &options, &research);
    memset(occluded + first, 7, count);
    assert_int_equal(cgt_occluded_points(scene, light, &points, occluded + first, &options), CGT_OK);
    assert_int_equal(s->statistics.rays, count);
    const double lanes = scene->context->kernel->lanes;
    return ((double)s->research.references * lanes / 16 + (double)s->statistics.ray_tests / 16 +
            (double)s->research.nodes + (double)s->research.leaves) /
           count;
}

/* What takes too much is counted in tests of 16 rays: with narrower vectors scenes that give up tiles may not. */
static inline bool lit_has_16_lanes(const cgt_context *context)
{
    return strcmp(cgt_context_get_variant(context), "avx512") == 0;
}

#endif

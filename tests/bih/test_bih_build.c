/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The depth and the leaves of bounding interval hierarchies where halving space does not separate primitives; and more
 * primitives than one can number. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "papers/build/bih/bih_build.h"
#include "structures/check/structure_check.h"
#include "support/suite.h"

static void check_spheres(cgt_context *context, const float (*sphere)[4], uint32_t count, cgt_bih *tree)
{
    const cgt_scene_options options = {.structure = CGT_STRUCTURE_BIH};
    cgt_scene *scene = scene_of(context, &options, sphere, count);
    scene->is_band = true; /* the tree is built over it, whatever its scale */
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    *tree = scene->committed_scene.papers->bih;
    bih_check(tree, &scene->committed_scene);
    cgt_scene_release(scene);
}

/* Spheres whose distances from the origin halve again and again: each split in the middle takes a few off. The median
 * ends that in time. */
TEST(halving_distances)
{
    enum { COUNT = 20000 };
    float(*sphere)[4] = calloc(COUNT, sizeof *sphere);
    cgt_context *context = context_make(2, NULL);
    uint32_t deepest = 0;
    assert_non_null(sphere);
    for (uint32_t axes = 1; axes <= 3; axes++) {
        test_random r = random_make(axes);
        cgt_bih tree;
        for (uint32_t i = 0; i < COUNT; i++)
            for (uint32_t a = 0; a < 3; a++)
                sphere[i][a] = a < axes ? ldexpf(random_float(&r, 0.5f, 1), 40 - (int)(i * axes + a) % 120) : 0;
        check_spheres(context, (const float(*)[4])sphere, COUNT, &tree);
        deepest = deepest > tree.depth ? deepest : tree.depth;
    }
    assert_true(deepest > CGT_BIH_MAX_DEPTH - 4); /* nearly all depth was used */
    free(sphere);
    cgt_context_release(context);
}

/* Concentric spheres are halved by size: a ray past the small ones does not test them all. The same sphere again and
 * again is one leaf. */
TEST(concentric_spheres)
{
    enum { COUNT = 12000 };
    float(*sphere)[4] = calloc(COUNT, sizeof *sphere);
    cgt_context *context = context_make(2, NULL);
    cgt_bih tree;
    assert_non_null(sphere);
    for (uint32_t i = 0; i < COUNT; i++)
        sphere[i][3] = 1 + (float)i / COUNT;
    check_spheres(context, (const float(*)[4])sphere, COUNT, &tree);
    assert_true(tree.largest_leaf <= CGT_BIH_LEAF_ITEMS && tree.depth <= 14);
    for (uint32_t i = 0; i < COUNT; i++)
        sphere[i][3] = 1;
    check_spheres(context, (const float(*)[4])sphere, COUNT, &tree);
    assert_int_equal(tree.largest_leaf, COUNT);
    free(sphere);
    cgt_context_release(context);
}

/* Floats that change between the bounds of a commit and its tree are refused: a primitive more than was counted, one
 * less, one outside. */
TEST(changed_spheres)
{
    enum { COUNT = 20, SKIPPED = 7, MOVED = 19 };
    const float changes[3][2] = {{SKIPPED, 1}, {MOVED, NAN}, {MOVED, 50}};
    cgt_context *context = context_make(2, NULL);
    const cgt_scene_options options = {.structure = CGT_STRUCTURE_BIH};
    cgt_buffer nodes = {0}, references = {0}, work = {0};
    const cgt_bih_memory memory = {&nodes, &references, &work};
    float sphere[COUNT][4];
    cgt_bih tree;
    for (int i = 0; i < COUNT; i++)
        memcpy(sphere[i], (const float[4]){(float)i, 0, 0, i == SKIPPED ? -1.0f : 1.0f}, sizeof sphere[i]);
    cgt_scene *scene = scene_of(context, &options, (const float(*)[4])sphere, COUNT);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    for (int k = 0; k < 3; k++) {
        float *radius = &sphere[(int)changes[k][0]][3], before = *radius;
        *radius = changes[k][1];
        assert_int_equal(cgt_bih_build(context, &memory, &scene->committed_scene, &tree), CGT_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(context_message(context), "arrays change"));
        *radius = before;
        assert_int_equal(cgt_bih_build(context, &memory, &scene->committed_scene, &tree), CGT_OK);
    }
    cgt_buffer_release(&context->memory, &nodes);
    cgt_buffer_release(&context->memory, &references);
    cgt_buffer_release(&context->memory, &work);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

TEST(too_many_primitives)
{
    cgt_context *context = context_make(1, NULL);
    cgt_buffer nodes = {0}, references = {0}, work = {0};
    const cgt_bih_memory memory = {&nodes, &references, &work};
    const cgt_committed_scene huge = {.valid = CGT_BIH_MAX_PRIMS + 1};
    cgt_bih tree;
    assert_int_equal(cgt_bih_build(context, &memory, &huge, &tree), CGT_ERROR_TOO_LARGE);
    assert_non_null(strstr(context_message(context), "bounding interval hierarchy"));
    cgt_context_release(context);
}

SEEDED_SUITE("test_bih_build", NULL, NULL)

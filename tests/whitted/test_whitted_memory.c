/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Memory of Whitted's tracing: each allocation of a frame fails in turn, which is an error and nothing else, and what
 * is held is as whitted.h says. The linker sends malloc and calloc here. */
#include <stdatomic.h>
#include <stdlib.h>

#include "support/suite.h"
#include "whitted/whitted_scenes.h"

void *__real_malloc(size_t bytes);
void *__real_calloc(size_t count, size_t bytes);
void *__wrap_malloc(size_t bytes);
void *__wrap_calloc(size_t count, size_t bytes);

static atomic_bool is_on;
static atomic_uint calls, fail_at; /* the call that fails, counted from 1; 0: none */
static atomic_size_t asked;

/* Whether this call is the one that fails. */
static bool fails(size_t bytes)
{
    if (!is_on)
        return false;
    asked += bytes;
    return ++calls == fail_at;
}

void *__wrap_malloc(size_t bytes) { return fails(bytes) ? NULL : __real_malloc(bytes); }
void *__wrap_calloc(size_t count, size_t bytes) { return fails(count * bytes) ? NULL : __real_calloc(count, bytes); }

static void watch_from(unsigned fail)
{
    calls = 0;
    asked = 0;
    fail_at = fail;
    is_on = true;
}

static const cgt_material glass = {.kind = CGT_MATERIAL_GLASS, .index = 1.5f};

enum { WIDTH = 200, HEIGHT = 150 }; /* several tiles */

TEST(frames_fail_in_turn)
{
    static float light[2][WIDTH * HEIGHT][3];
    static whitted_scene scene;
    cgt_camera camera;
    for (uint32_t threads = 1; threads <= 3; threads += 2) {
        unsigned failures = 0;
        whitted_scene_begin(&scene, &glass, 1);
        for (int i = 0; i < 9; i++)
            whitted_scene_add_sphere(&scene, (float)(i % 3) - 1, (float)(i / 3) - 1, 0, 0.45f, 0);
        whitted_scene_commit(&scene, NULL, threads);
        scene.w.sky[1][0] = 1.0f;
        scene.w.bounces = 4;
        cgt_camera_init(&camera);
        assert_int_equal(cgt_whitted_frame(&scene.w, &camera, WIDTH, HEIGHT, NULL, light[0]), CGT_OK);
        for (unsigned k = 1; k < 1000; k++) {
            watch_from(k);
            const cgt_result result = cgt_whitted_frame(&scene.w, &camera, WIDTH, HEIGHT, NULL, light[1]);
            is_on = false;
            if (calls < k)
                break;
            assert_int_equal(result, CGT_ERROR_OUT_OF_MEMORY);
            failures++;
        }
        assert_true(failures >= 1 + scene.w.bounces + 1); /* of one thread: itself and its levels */
        assert_int_equal(cgt_whitted_frame(&scene.w, &camera, WIDTH, HEIGHT, NULL, light[1]), CGT_OK);
        assert_memory_equal(light[0], light[1], sizeof light[0]);
        whitted_scene_end(&scene);
    }
}

TEST(memory_is_as_stated)
{
    for (uint32_t bounces = 0; bounces <= WHITTED_MAX_BOUNCES; bounces += 16) {
        watch_from(0);
        whitted_memory *memory = cgt_whitted_memory_create(bounces);
        is_on = false;
        assert_non_null(memory);
        cgt_whitted_memory_free(memory);
        const double stated = 1e6 * (3.3 + 1.4 * (bounces + 1.0));
        print_message("%u bounces: %.2f MB, stated %.2f\n", (unsigned)bounces, (double)asked / 1e6, stated / 1e6);
        assert_true((double)asked <= stated && (double)asked > 0.8 * stated);
    }
}

SEEDED_SUITE("test_whitted_memory", NULL, NULL)

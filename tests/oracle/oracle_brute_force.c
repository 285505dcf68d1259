/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The shipped trajectory against brute force: in frames of a real simulation every pixel gets the closest hit among all
 * spheres, and its t, as the exact oracle finds them. */
#include "support/scenes.h"
#include "support/suite.h"
#include "support/trajectory_told.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/trajectory.h>

#define DATA CGT_DATA_DIR "/pour2k.lammpstrj"

static cgt_trajectory *file;

static int open_file(void **state)
{
    (void)state;
    char error[512] = "";
    file = told_open(DATA, NULL, error, sizeof error);
    if (!file)
        print_error("%s\n", error);
    return file ? 0 : -1;
}

static int close_file(void **state)
{
    (void)state;
    cgt_trajectory_close(file);
    return 0;
}

static cgt_trajectory_frame read_frame(uint64_t number)
{
    char error[512] = "";
    cgt_trajectory_frame frame = {0};
    if (told_rewind(file, error, sizeof error))
        fail_msg("%s", error);
    for (uint64_t i = 0; i < number; i++)
        if (told_skip(file, error, sizeof error) != 1)
            fail_msg("%s", error);
    if (told_read(file, &frame, error, sizeof error) != 1)
        fail_msg("%s", error);
    assert_int_equal(frame.number, number);
    return frame;
}

/* Views from around the box, from above, and from among the spheres. */
static cgt_camera place_camera(const cgt_trajectory_frame *f, int place)
{
    cgt_camera camera;
    float middle[3], size = 0;
    cgt_camera_init(&camera);
    for (int a = 0; a < 3; a++) {
        middle[a] = 0.5f * (f->box_min[a] + f->box_max[a]);
        size = fmaxf(size, f->box_max[a] - f->box_min[a]);
    }
    middle[2] = f->box_min[2] + 0.2f * size; /* the spheres fall to the bottom */
    const float angle = 0.7f + 2.1f * (float)place;
    memcpy(camera.target, middle, sizeof middle);
    memcpy(camera.up, (float[3]){0, 0, 1}, sizeof camera.up);
    camera.eye[0] = middle[0] + 1.4f * size * cosf(angle);
    camera.eye[1] = middle[1] + 1.4f * size * sinf(angle);
    camera.eye[2] = middle[2] + 0.5f * size;
    if (place == 2)
        camera.projection = CGT_PROJECTION_ORTHOGRAPHIC, camera.height = 0.6f * size;
    if (place == 3) {
        memcpy(camera.eye, middle, sizeof middle);
        camera.target[0] += 1;
        camera.fov = 100;
    }
    return camera;
}

TEST(pixels_of_the_trajectory)
{
    static const uint64_t number[] = {0, 3, 12, 30, 52, 75};
    const uint32_t width = test_between(64, 240), height = width * 9 / 16;
    planes p = planes_make(width, height), other = planes_make(width, height);
    uint64_t hits = 0;
    for (size_t k = 0; k < TEST_COUNT(number); k++) {
        const cgt_trajectory_frame f = read_frame(number[k]);
        const float(*sphere)[4] = (const float(*)[4])f.xyzr;
        const cgt_camera camera = place_camera(&f, (int)(k % 4));
        truth_ray *rays = frame_rays(&camera, width, height);
        bool first = true;
        uint32_t turn = (uint32_t)k;
        FOR_EACH_VARIANT(variant)
        {
            const cgt_scene_options made = structure_in_turn(turn++);
            cgt_context *context = context_make(2, variant);
            cgt_scene *scene = scene_of(context, &made, sphere, f.count);
            frame_trace(scene, &camera, first ? &p : &other, NULL);
            if (!first)
                assert_true(planes_equal(&p, &other));
            first = false;
            cgt_scene_release(scene);
            cgt_context_release(context);
        }
        frame_judge(&p, rays, sphere, f.count);
        for (size_t i = 0; i < p.elements; i++)
            hits += p.primitive[i] != CGT_INVALID_ID;
        free(rays);
    }
    print_message("%llu hits in %zu frames of %ux%u\n", (unsigned long long)hits, TEST_COUNT(number), width, height);
    assert_true(hits > p.elements / 2);
    planes_free(&p);
    planes_free(&other);
}

SEEDED_SUITE("oracle_brute_force", open_file, close_file)

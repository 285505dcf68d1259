/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Motion in cgt-render: the speeds of spheres, found by their ids, and the camera. */
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <stdio.h>
#include <string.h>

#include "camera/camera_keys.h"
#include "camera/camera_path.h"
#include "survey/survey.h"
#include "sequence/speed.h"

static cgt_context *context; /* of two threads */

static int create_context(void **state)
{
    (void)state;
    return cgt_context_create(&(cgt_context_options){.threads = 2}, &context) != CGT_OK;
}

static int release_context(void **state)
{
    (void)state;
    cgt_context_release(context);
    return 0;
}

/* ---- Speeds ------------------------------------------------------------------------------------------------- */

typedef struct speed_case {
    speed_tracker *tracker;
    const float *speeds;
    speed_source source;
} speed_case;

/* All frames have one step: their numbers tell which comes later. */
static void take(speed_case *s, uint64_t number, uint32_t count, const float *xyzr, const uint32_t *id, float box)
{
    cgt_trajectory_frame frame = {.number = number, .count = count, .xyzr = xyzr, .id = id, .box_min = {1, 1, 1}};
    for (int c = 0; c < 3 && box > 0.0f; c++) {
        frame.box_edge[c][c] = (double)box;
        frame.periodic[c] = 1;
    }
    assert_int_equal(cgt_speed_next(s->tracker, &frame, &s->speeds, &s->source), 0);
}

TEST(speeds_follow_ids)
{
    const float first[] = {0, 0, 0, 1, 5, 5, 5, 1, 9, 9, 9, 1};
    const float then[] = {9, 9, 7, 1, 3, 0, 4, 1, 1, 1, 1, 1, 5, 5, NAN, 1};
    const uint32_t first_id[] = {7, 4000000000u, 2}, then_id[] = {2, 7, 11, 4000000000u};
    speed_case s = {cgt_speed_create(context), NULL, SPEED_FROM_VELOCITY};
    assert_non_null(s.tracker);
    take(&s, 90, 0, first, first_id, 0.0f);
    assert_non_null(s.speeds); /* a run may begin without spheres */
    take(&s, 100, 3, first, first_id, 0.0f);
    assert_true(isnan(s.speeds[0]) && isnan(s.speeds[1]) && isnan(s.speeds[2]));
    take(&s, 110, 4, then, then_id, 0.0f);
    assert_int_equal(s.source, SPEED_FROM_POSITIONS);
    assert_near(s.speeds[0], 2.0, 1e-7); /* id 2: 2 units, whatever the steps between the frames */
    assert_near(s.speeds[1], 5.0, 1e-7); /* id 7: (3, 0, 4) */
    assert_true(isnan(s.speeds[2]));     /* new */
    assert_true(isnan(s.speeds[3]));     /* nowhere */
    take(&s, 110, 4, then, then_id, 0.0f);
    assert_true(isnan(s.speeds[0])); /* the same frame again */
    take(&s, 120, 0, then, then_id, 0.0f);
    take(&s, 130, 3, first, first_id, 0.0f);
    assert_true(isnan(s.speeds[0]) && isnan(s.speeds[2])); /* the frame before was empty */
    cgt_speed_restart(s.tracker);
    take(&s, 140, 3, first, first_id, 0.0f);
    assert_true(isnan(s.speeds[0]));
    cgt_speed_release(s.tracker);
}

/* By ids, through the boundary, and unknown where the second frame does not have the sphere. */
TEST(speeds_of_the_first_frame_look_ahead)
{
    const float first[] = {9.75f, 5, 5, 1, 1, 1, 1, 1, 2, 2, 2, 1}, then[] = {1, 1, 4, 1, 0.25f, 5, 5, 1};
    const uint32_t first_id[] = {7, 8, 9}, then_id[] = {8, 7};
    speed_case s = {cgt_speed_create(context), NULL, SPEED_FROM_VELOCITY};
    cgt_trajectory_frame next = {.number = 5, .count = 2, .xyzr = then, .id = then_id, .periodic = {1, 1, 1}};
    for (int c = 0; c < 3; c++)
        next.box_edge[c][c] = 10.0;
    for (int round = 0; round < 2; round++) {
        take(&s, 0, 3, first, first_id, 10.0f);
        assert_true(round ? s.speeds[0] == 0.5f && s.speeds[1] == 3.0f : isnan(s.speeds[0]) && isnan(s.speeds[1]));
        assert_true(isnan(s.speeds[2]));
        assert_int_equal(cgt_speed_look_ahead(s.tracker, &next), 0);
        cgt_speed_restart(s.tracker);
    }
    next.number = 0; /* the same frame */
    take(&s, 0, 3, first, first_id, 10.0f);
    assert_int_equal(cgt_speed_look_ahead(s.tracker, &next), 0);
    cgt_speed_restart(s.tracker);
    take(&s, 0, 3, first, first_id, 10.0f);
    assert_true(isnan(s.speeds[0]));
    cgt_speed_release(s.tracker);
}

TEST(speeds_go_the_short_way_round_the_box)
{
    const float first[] = {9.75f, 5, 0.25f, 1}, then[] = {0.25f, 5, 9.75f, 1};
    const uint32_t id[] = {1};
    speed_case s = {cgt_speed_create(context), NULL, SPEED_FROM_VELOCITY};
    take(&s, 0, 1, first, id, 10.0f);
    take(&s, 1, 1, then, id, 10.0f);
    assert_near(s.speeds[0], sqrt(0.5), 1e-6);
    take(&s, 2, 1, first, id, 0.0f); /* no box: the unwrapped distance */
    assert_near(s.speeds[0], sqrt(2.0 * 9.5 * 9.5), 1e-5);
    for (int k = 0; k < 2; k++) { /* about half of an edge */
        const float half[] = {9.75f - (k ? 5.25f : 4.75f), 5, 0.25f, 1};
        take(&s, 3 + 2 * (uint64_t)k, 1, half, id, 10.0f);
        assert_near(s.speeds[0], 4.75, 1e-6);
        take(&s, 4 + 2 * (uint64_t)k, 1, first, id, 10.0f);
    }
    cgt_speed_release(s.tracker);
}

/* A step d of each sphere, and where it ends where the box's edges are taken away `image` times. */
static void take_step(speed_case *s, cgt_trajectory_frame frame, const double d[3], const int image[3])
{
    float xyzr[2][4] = {{1.5f, 2.25f, 3.0f, 1.0f}, {0}};
    for (int c = 0; c < 3; c++) {
        double at = (double)xyzr[0][c] + d[c];
        for (int e = 0; e < 3; e++)
            at -= image[e] * frame.box_edge[e][c];
        xyzr[1][c] = (float)at;
    }
    cgt_speed_restart(s->tracker);
    frame.count = 1;
    for (int k = 0; k < 2; k++) {
        frame.number = (uint64_t)k;
        frame.xyzr = xyzr[k];
        assert_int_equal(cgt_speed_next(s->tracker, &frame, &s->speeds, &s->source), 0);
    }
}

/* In tilted boxes, also where the tilt is large, the short way is that of the edges, not of the bounds around them. */
TEST(speeds_go_the_short_way_round_tilted_boxes)
{
    static const double edges[][3][3] = {
        {{8, 0, 0}, {0, 8, 0}, {0, 0, 8}},   {{8, 0, 0}, {3, 8, 0}, {0, 0, 8}},
        {{8, 0, 0}, {-4, 8, 0}, {2, -3, 8}}, {{8, 0, 0}, {0, 8, 0}, {4, 4, 5.65625}}, /* as a rhombic dodecahedron's */
        {{20, 0, 0}, {5, 20, 0}, {0, 0, 1}}, {{8, 0, 0}, {21, 8, 0}, {0, 0, 8}}}; /* it leans by more than two edges */
    static const double d[3] = {0.125, -0.25, 0.0625};
    speed_case s = {cgt_speed_create(context), NULL, SPEED_FROM_VELOCITY};
    for (size_t k = 0; k < sizeof edges / sizeof edges[0]; k++)
        for (int i = 0; i < 27; i++) {
            const int image[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
            cgt_trajectory_frame frame = {.kind = CGT_TRAJECTORY_SPHERES, .periodic = {1, -1, 1}};
            memcpy(frame.box_edge, edges[k], sizeof frame.box_edge);
            take_step(&s, frame, d, image);
            assert_near(s.speeds[0], 0.28641, 1e-5);
        }
    cgt_speed_release(s.tracker);
}

/* Sheets and chains, whose other edges are 0, in any place of the three. */
TEST(speeds_go_the_short_way_round_boxes_with_edges_of_nothing)
{
    static const double edges[2][3][3] = {{{5, 0, 0}, {1, 5, 0}, {0, 0, 0}}, {{5, 0, 2}, {0, 0, 0}, {0, 0, 0}}};
    static const double d[3] = {0.125, -0.25, 0.0625};
    speed_case s = {cgt_speed_create(context), NULL, SPEED_FROM_VELOCITY};
    for (int i = 0; i < 6; i++) {
        cgt_trajectory_frame frame = {.kind = CGT_TRAJECTORY_SPHERES};
        int image[3];
        for (int e = 0; e < 3; e++) {
            const int at = (e + i) % 3;
            memcpy(frame.box_edge[at], edges[i / 3][e], sizeof frame.box_edge[at]);
            image[at] = frame.box_edge[at][0] != 0.0;
            frame.periodic[at] = (int8_t)image[at];
        }
        take_step(&s, frame, d, image);
        assert_near(s.speeds[0], 0.28641, 1e-5);
    }
    cgt_speed_release(s.tracker);
}

/* Walls, and positions that go on beyond the boundary: a step is as long as it says, along that edge alone. */
TEST(speeds_keep_long_steps)
{
    static const double d[3] = {8, 8, 8};
    static const int none[3] = {0, 0, 0};
    speed_case s = {cgt_speed_create(context), NULL, SPEED_FROM_VELOCITY};
    for (int long_ones = 0; long_ones < 8; long_ones++) {
        cgt_trajectory_frame walls = {.kind = CGT_TRAJECTORY_SPHERES}, unwrapped = walls;
        double square = 0.0;
        for (int e = 0; e < 3; e++) {
            const int is_long = long_ones >> e & 1;
            walls.box_edge[e][e] = unwrapped.box_edge[e][e] = 10.0;
            walls.periodic[e] = !is_long;
            unwrapped.periodic[e] = 1;
            unwrapped.unwrapped[e] = (int8_t)is_long;
            square += is_long ? 64.0 : 4.0;
        }
        take_step(&s, walls, d, none);
        assert_near(s.speeds[0], sqrt(square), 1e-5);
        take_step(&s, unwrapped, d, none);
        assert_near(s.speeds[0], sqrt(square), 1e-5);
    }
    cgt_speed_release(s.tracker);
}

TEST(speeds_without_a_box_note_long_steps)
{
    const float first[] = {9.75f, 5, 0.25f, 1}, then[] = {0.25f, 5, 1.25f, 1};
    float longest[3];
    speed_case s = {cgt_speed_create(context), NULL, SPEED_FROM_VELOCITY};
    cgt_trajectory_frame frame = {.count = 1, .xyzr = first, .box_min = {1, 1, 1}, .box_max = {-1, -1, -1}};
    assert_int_equal(cgt_speed_next(s.tracker, &frame, &s.speeds, &s.source), 0);
    frame.xyzr = then;
    frame.number = 1;
    assert_int_equal(cgt_speed_next(s.tracker, &frame, &s.speeds, &s.source), 0);
    cgt_speed_boxless_steps(s.tracker, longest);
    assert_true(longest[0] == 9.5f && longest[1] == 0.0f && longest[2] == 1.0f);
    frame.box_min[0] = frame.box_min[1] = frame.box_min[2] = -2.0f;
    for (frame.number = 2; frame.number < 4; frame.number++) {
        frame.xyzr = frame.number == 2 ? first : then;
        assert_int_equal(cgt_speed_next(s.tracker, &frame, &s.speeds, &s.source), 0);
    }
    cgt_speed_boxless_steps(s.tracker, longest);
    assert_true(longest[0] == 0.0f);
    cgt_speed_release(s.tracker);
}

TEST(speeds_without_ids_keep_places)
{
    const float a[] = {0, 0, 0, 1, 1, 1, 1, 1}, b[] = {0, 2, 0, 1, 1, 1, 1, 1, 8, 8, 8, 1};
    const uint32_t id[] = {1, 2};
    speed_case s = {cgt_speed_create(context), NULL, SPEED_FROM_VELOCITY};
    take(&s, 0, 2, a, NULL, 0.0f);
    take(&s, 2, 3, b, NULL, 0.0f);
    assert_near(s.speeds[0], 2.0, 1e-7);
    assert_near(s.speeds[1], 0.0, 0.0);
    assert_true(isnan(s.speeds[2]));
    take(&s, 3, 2, a, NULL, 0.0f);
    assert_true(isnan(s.speeds[0])); /* fewer: their identity is unknown */
    take(&s, 4, 2, a, id, 0.0f);
    assert_true(isnan(s.speeds[0])); /* ids from here on say nothing of the frame before */
    cgt_speed_release(s.tracker);
}

TEST(speeds_take_velocities)
{
    const float xyzr[8] = {0}, velocity[] = {3, 0, 4, INFINITY, 0, 0};
    const cgt_trajectory_frame frame = {.count = 2, .xyzr = xyzr, .velocity = velocity};
    speed_case s = {cgt_speed_create(context), NULL, SPEED_FROM_POSITIONS};
    assert_int_equal(cgt_speed_next(s.tracker, &frame, &s.speeds, &s.source), 0);
    assert_int_equal(s.source, SPEED_FROM_VELOCITY);
    assert_near(s.speeds[0], 5.0, 0.0);
    assert_true(isnan(s.speeds[1]));
    cgt_speed_release(s.tracker);
}

/* Vertices keep their positions for any ids of the triangles. */
TEST(speeds_of_vertices)
{
    const float a[6] = {0, 0, 0, 1, 1, 1}, b[6] = {3, 4, 0, 1, 1, 1};
    const uint32_t index[3] = {0, 1, 0}, id[1] = {7};
    cgt_trajectory_frame frame = {.kind = CGT_TRAJECTORY_TRIANGLES,
                                  .count = 2,
                                  .triangles = 1,
                                  .index = index,
                                  .position = a,
                                  .id = id,
                                  .box_min = {1, 1, 1}};
    speed_case s = {cgt_speed_create(context), NULL, SPEED_FROM_VELOCITY};
    assert_int_equal(cgt_speed_next(s.tracker, &frame, &s.speeds, &s.source), 0);
    assert_true(isnan(s.speeds[0]) && isnan(s.speeds[1]));
    frame.position = b;
    frame.number = 2;
    assert_int_equal(cgt_speed_next(s.tracker, &frame, &s.speeds, &s.source), 0);
    assert_near(s.speeds[0], 5.0, 1e-7);
    assert_near(s.speeds[1], 0.0, 0.0);
    assert_int_equal(s.source, SPEED_FROM_POSITIONS);
    cgt_speed_release(s.tracker);
}

/* Many ids in another order each frame: each is found, identified by the distance that only it moves. */
TEST(speeds_of_many_shuffled_ids)
{
    enum { COUNT = 150000, APART = 28001 }; /* several pieces; ids up to 4,200,121,999 */
    float longest[3];
    float *xyzr = calloc(COUNT * 4, sizeof *xyzr);
    uint32_t *id = calloc(COUNT, sizeof *id);
    uint64_t seed = 12345;
    speed_case s = {cgt_speed_create(context), NULL, SPEED_FROM_VELOCITY};
    assert_non_null(xyzr);
    assert_non_null(id);
    for (uint32_t i = 0; i < COUNT; i++)
        id[i] = i * APART;
    for (int frame = 0; frame < 3; frame++) {
        for (uint32_t i = COUNT - 1; i > 0; i--) {
            seed = seed * UINT64_C(6364136223846793005) + 1442695040888963407u;
            const uint32_t j = (uint32_t)((seed >> 33) % (i + 1)), swap = id[i];
            id[i] = id[j];
            id[j] = swap;
        }
        for (uint32_t i = 0; i < COUNT; i++) {
            const uint32_t k = id[i] / APART;
            xyzr[4 * i] = (float)frame * (float)k;
        }
        take(&s, frame, COUNT, xyzr, id, 0.0f);
        for (uint32_t i = 0; i < COUNT && frame > 0; i++) {
            const uint32_t k = id[i] / APART;
            assert_near(s.speeds[i], k, 0.0);
        }
        cgt_speed_boxless_steps(s.tracker, longest);
        assert_true(longest[0] == (frame > 0 ? (float)(COUNT - 1) : 0.0f) && longest[1] == 0.0f);
    }
    cgt_speed_release(s.tracker);
    free(xyzr);
    free(id);
}

TEST(quantiles_are_close)
{
    static survey s;
    assert_true(cgt_survey_speed_quantile(&s, 0.99) == 0.0f);
    for (int i = 1; i <= 10000; i++) {
        const float speed = (float)i * 1e-3f;
        uint32_t bits;
        memcpy(&bits, &speed, sizeof bits);
        s.speed_bins[bits >> 19]++;
        s.speeds++;
    }
    s.speed_max = 10.0f;
    assert_true(cgt_survey_speed_quantile(&s, 0.99) >= 9.9f && cgt_survey_speed_quantile(&s, 0.99) <= 9.9f * 1.0625f);
    assert_true(cgt_survey_speed_quantile(&s, 0.5) >= 5.0f && cgt_survey_speed_quantile(&s, 0.5) <= 5.0f * 1.0625f);
    assert_true(cgt_survey_speed_quantile(&s, 1.0) == 10.0f);
    s.speed_max = 9.95f; /* of the same bin: no quantile is above all speeds */
    assert_true(cgt_survey_speed_quantile(&s, 0.99) == 9.95f);
}

/* Ranks are those of all values up to BULK_SAMPLES of them; of more, samples are near, and the same in any order. */
TEST(ranges_of_values_are_quantiles)
{
    static bulk_values few, many, parts[2];
    double low, high;
    assert_int_equal(cgt_bulk_values_range(&few, -INFINITY, &low, &high), 0);
    for (uint32_t i = 0; i < 1001; i++)
        cgt_bulk_values_add(&few, 3, i, i == 500 ? 1e9 : (double)i - 100.0);
    assert_int_equal(cgt_bulk_values_range(&few, -INFINITY, &low, &high), 1);
    assert_true(low == -90.0 && high == 891.0);
    assert_int_equal(cgt_bulk_values_range(&few, 0.0, &low, &high), 1);
    assert_true(low == 9.0 && high == 893.0);
    for (uint32_t i = 0; i < 100000; i++) {
        cgt_bulk_values_add(&many, i % 7, i, (double)i);
        cgt_bulk_values_add(&parts[i % 3 == 0], i % 7, i, (double)i);
    }
    cgt_bulk_values_sort(&many);
    cgt_bulk_values_merge(&parts[0], &parts[1]);
    cgt_bulk_values_sort(&parts[0]);
    assert_memory_equal(&many, &parts[0], sizeof many);
    assert_int_equal(cgt_bulk_values_range(&many, -INFINITY, &low, &high), 1);
    assert_true(low > 500.0 && low < 1500.0 && high > 98500.0 && high < 99500.0);
}

/* Where most values are one, both quantiles are it: the least and the greatest count. */
TEST(ranges_of_rare_values_are_whole)
{
    static survey s;
    double low, high;
    s.values = 1000;
    s.value_min = -2.0;
    s.value_max = 5.0;
    s.value_least = 5.0;
    for (uint32_t i = 0; i < 1000; i++)
        cgt_bulk_values_add(&s.value_samples, 0, i, i == 3 ? -2.0 : i == 4 ? 5.0 : 0.0);
    assert_int_equal(cgt_survey_value_range(&s, 0, &low, &high), 0);
    assert_true(low == -2.0 && high == 5.0);
    assert_int_equal(cgt_survey_value_range(&s, 1, &low, &high), 0);
    assert_true(low == 5.0 && high == 5.0);
}

/* ---- Cameras ------------------------------------------------------------------------------------------------ */

/* The position of a point in the picture: -1 to 1 each way. */
static void project(const cgt_camera *camera, const double point[3], double aspect, double at[2])
{
    double f[3], r[3], u[3], d[3], length = 0.0, depth = 0.0;
    for (int c = 0; c < 3; c++) {
        f[c] = (double)camera->target[c] - (double)camera->eye[c];
        d[c] = point[c] - (double)camera->eye[c];
        length += f[c] * f[c];
    }
    for (int c = 0; c < 3; c++) {
        f[c] /= sqrt(length);
        depth += f[c] * d[c];
    }
    length = 0.0;
    for (int c = 0; c < 3; c++) {
        r[c] = f[(c + 1) % 3] * (double)camera->up[(c + 2) % 3] - f[(c + 2) % 3] * (double)camera->up[(c + 1) % 3];
        length += r[c] * r[c];
    }
    for (int c = 0; c < 3; c++)
        r[c] /= sqrt(length);
    for (int c = 0; c < 3; c++)
        u[c] = r[(c + 1) % 3] * f[(c + 2) % 3] - r[(c + 2) % 3] * f[(c + 1) % 3];
    const double h = tan((double)camera->fov * 3.14159265358979323846 / 360.0);
    assert_true(depth > 0.0);
    at[0] = (d[0] * r[0] + d[1] * r[1] + d[2] * r[2]) / (depth * h * aspect);
    at[1] = (d[0] * u[0] + d[1] * u[1] + d[2] * u[2]) / (depth * h);
}

/* The automatic camera of a box, as of a mesh that fills it. */
static int frame_box(camera_path *path, const float min[3], const float max[3], const float view[3], const float up[3],
                     double aspect, double orbit)
{
    static camera_directions fit;
    camera_reach reach;
    cgt_camera_directions_set(&fit, view, up, 30.0f, aspect, orbit, 0);
    cgt_camera_reach_clear(&reach);
    cgt_camera_reach_add_box(&reach, &fit, min, max);
    return cgt_camera_path_fit(path, &fit, &reach, min, max);
}

/* All corners are inside, and at one position of the orbit a corner is near the edge: the box is entirely visible, and
 * not tiny. */
static void check_framing(const float min[3], const float max[3], const float up[3], double aspect, double orbit)
{
    const float view[3] = {0.4f, -0.9f, 0.5f};
    camera_path path;
    double most = 0.0;
    assert_int_equal(frame_box(&path, min, max, view, up, aspect, orbit), 0);
    for (int stop = 0; stop <= 72; stop++) {
        cgt_camera camera;
        cgt_camera_path_at(&path, stop / 72.0, &camera);
        for (int corner = 0; corner < 8; corner++) {
            double point[3], at[2];
            for (int c = 0; c < 3; c++)
                point[c] = (double)(corner >> c & 1 ? max[c] : min[c]);
            project(&camera, point, aspect, at);
            most = fmax(most, fmax(fabs(at[0]), fabs(at[1])));
        }
    }
    assert_true(most <= 0.999);
    assert_true(most > 0.9);
}

TEST(automatic_cameras_show_the_whole_box)
{
    const float min[3] = {-5.0f, -3.0f, 0.0f}, max[3] = {5.0f, 4.0f, 30.0f}, up_z[3] = {0, 0, 1}, up_y[3] = {0, 1, 0};
    const float long_min[3] = {-1.0f, -20.0f, -1.0f}, long_max[3] = {1.0f, 20.0f, 1.0f};
    const float far_min[3] = {1e6f, 2e6f, -3e6f}, far_max[3] = {1.1e6f, 2.2e6f, -2.5e6f};
    check_framing(min, max, up_z, 16.0 / 9.0, 0.0);
    check_framing(min, max, up_y, 16.0 / 9.0, 0.0);
    check_framing(min, max, up_z, 0.25, 360.0);
    check_framing(min, max, up_z, 16.0 / 9.0, -90.0);
    check_framing(far_min, far_max, up_z, 4.0 / 3.0, 720.0);
    check_framing(long_min, long_max, up_z, 0.5, 90.0); /* seen from its end first, from its side later */
}

/* A cube of edge 10 at any scale, and so far off that floats are half a unit apart. */
TEST(automatic_cameras_work_at_any_scale_and_place)
{
    static const float up_z[3] = {0, 0, 1};
    static const float scales[] = {1e-30f, 1e-15f, 1e-10f, 1e-8f, 1e-6f, 1.0f, 1e6f, 1e20f, 1e30f};
    static const float places[] = {65536.0f, 1048576.0f, 4194304.0f, -4194304.0f, 8388610.0f};
    float min[3], max[3];
    for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++) {
        for (int c = 0; c < 3; c++) {
            min[c] = -scales[i];
            max[c] = 9.0f * scales[i];
        }
        check_framing(min, max, up_z, 4.0 / 3.0, 0.0);
    }
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        for (int c = 0; c < 3; c++) {
            min[c] = places[i] - 1.0f;
            max[c] = places[i] + 9.0f;
        }
        check_framing(min, max, up_z, 4.0 / 3.0, 0.0);
    }
}

TEST(automatic_cameras_of_odd_boxes)
{
    const float view[3] = {1, 0, 0}, up[3] = {0, 0, 1};
    const float point[3] = {1e7f, 0, 0}, zero[3] = {0, 0, 0}, huge[3] = {3e38f, 3e38f, 3e38f};
    const float inverse[3] = {-1, 0, 0}, infinite[3] = {INFINITY, 0, 0}, nan[3] = {NAN, 0, 0};
    camera_path path;
    assert_int_equal(frame_box(&path, point, point, view, up, 1.0, 0.0), 0);
    assert_true(path.start.eye[0] > path.start.target[0]); /* a point has no size, but a camera can still look at it */
    assert_int_equal(frame_box(&path, zero, zero, view, up, 1.0, 0.0), 0);
    assert_int_equal(frame_box(&path, zero, huge, view, up, 1.0, 0.0), -1);
    assert_int_equal(frame_box(&path, zero, inverse, view, up, 1.0, 0.0), -1);
    assert_int_equal(frame_box(&path, zero, infinite, view, up, 1.0, 0.0), -1);
    assert_int_equal(frame_box(&path, nan, zero, view, up, 1.0, 0.0), -1);
}

/* How far balls reach in the picture, from -1 to 1: right, left, up, down. A ball in perspective reaches to the planes
 * through the eye that touch it. */
static void reach_of_balls(const cgt_camera *camera, const float (*ball)[4], size_t count, double aspect,
                           int is_parallel, double reach[4])
{
    static camera_directions fit;
    float view[3];
    double tangent[2], distance = 0.0;
    for (int c = 0; c < 3; c++) {
        view[c] = camera->eye[c] - camera->target[c];
        distance += (double)view[c] * (double)view[c];
    }
    distance = sqrt(distance);
    tangent[1] = tan((double)camera->fov * 3.14159265358979323846 / 360.0);
    tangent[0] = aspect * tangent[1];
    cgt_camera_directions_set(&fit, view, camera->up, camera->fov, aspect, 0.0, 1); /* the picture's axes */
    for (int side = 0; side < 4; side++) {
        reach[side] = -1e30;
        for (size_t i = 0; i < count; i++) {
            double at = 0.0, off = 0.0;
            for (int c = 0; c < 3; c++) {
                const double d = (double)ball[i][c] - (double)camera->eye[c];
                const double n = c == 0 ? fit.x[side] : c == 1 ? fit.y[side] : fit.z[side];
                at += d * n;
                off -= d * (c == 0 ? fit.x[4] : c == 1 ? fit.y[4] : fit.z[4]);
            }
            const double radius = (double)ball[i][3];
            const double edge =
                is_parallel ? (at + radius) / distance : tan(atan2(at, off) + asin(radius / sqrt(at * at + off * off)));
            reach[side] = fmax(reach[side], edge / tangent[side / 2]);
        }
    }
}

/* Whatever is round, flat, long, deep or far from the middle of its bounds fills the picture: it reaches to the margin
 * at two opposite edges at least, is in the middle between the others, and is nowhere cut off. */
TEST(automatic_cameras_fill_the_picture)
{
    static const float balls[][3][4] = {
        {{5, 6, 7, 3}, {5, 6, 7, 3}, {5, 6, 7, 3}},
        {{0, 0, 0, 1}, {10, 0, 0, 1}, {0, 10, 0, 1}},
        {{0, 0, 0, 1}, {0, 0, 30, 0.5f}, {0, 0, 15, 2}},
        {{0, 0, 0, 1}, {4, -8, 3.6f, 1}, {-4, 8, -3.6f, 6}},
        {{1e-9f, 0, 0, 1e-10f}, {0, 2e-9f, 0, 1e-10f}, {0, 0, 1e-9f, 3e-10f}},
    };
    static const float view[3] = {0.5f, -1.0f, 0.45f}, up[3] = {0, 0, 1};
    static const double aspects[] = {1.0, 16.0 / 9.0, 0.25};
    static camera_directions fit;
    for (size_t k = 0; k < 2 * sizeof balls / sizeof balls[0] * 3; k++) {
        const float(*ball)[4] = balls[k / 6];
        const int is_parallel = k / 3 % 2;
        const double aspect = aspects[k % 3];
        float min[3] = {1e30f, 1e30f, 1e30f}, max[3] = {-1e30f, -1e30f, -1e30f};
        double reach[4];
        camera_reach measured;
        camera_path path;
        cgt_camera_directions_set(&fit, view, up, 30.0f, aspect, 0.0, is_parallel);
        cgt_camera_reach_clear(&measured);
        for (int i = 0; i < 3; i++) {
            const double place[3] = {(double)ball[i][0], (double)ball[i][1], (double)ball[i][2]};
            cgt_camera_reach_add(&measured, &fit, place, (double)ball[i][3]);
            for (int c = 0; c < 3; c++) {
                min[c] = fminf(min[c], ball[i][c] - ball[i][3]);
                max[c] = fmaxf(max[c], ball[i][c] + ball[i][3]);
            }
        }
        assert_int_equal(cgt_camera_path_fit(&path, &fit, &measured, min, max), 0);
        reach_of_balls(&path.start, ball, 3, aspect, is_parallel, reach);
        const double wide = fmax(reach[0], reach[1]), high = fmax(reach[2], reach[3]);
        if (wide > 0.97 || high > 0.97 || (!(is_parallel && k / 6 == 3) && fmax(wide, high) < 0.95))
            fail_msg("case %zu: reaches %g %g %g %g", k, reach[0], reach[1], reach[2], reach[3]);
        if (wide > high ? fabs(reach[0] - reach[1]) > 1e-4 : fabs(reach[2] - reach[3]) > 1e-4)
            fail_msg("case %zu: not in the middle: %g %g %g %g", k, reach[0], reach[1], reach[2], reach[3]);
    }
}

TEST(orbits_keep_distance_and_close)
{
    cgt_camera given, at;
    camera_path path;
    cgt_camera_init(&given);
    given.eye[0] = 3.0f;
    given.target[1] = 1.0f;
    cgt_camera_path_fixed(&path, &given, 360.0);
    cgt_camera_path_at(&path, 0.0, &at);
    assert_memory_equal(at.eye, given.eye, sizeof at.eye);
    cgt_camera_path_at(&path, 1.0, &at);
    for (int c = 0; c < 3; c++)
        assert_near(at.eye[c], given.eye[c], 1e-5);
    cgt_camera_path_at(&path, 0.25, &at); /* a quarter, about y, counter-clockwise: x goes to -z, z to x */
    assert_near(at.eye[0], given.eye[2], 1e-5);
    assert_near(at.eye[1], given.eye[1], 1e-5);
    assert_near(at.eye[2], -given.eye[0], 1e-5);
    cgt_camera_path_fixed(&path, &given, 0.0);
    cgt_camera_path_at(&path, 0.7, &at);
    assert_memory_equal(&at, &given, sizeof at);
}

/* 999 spheres of radius 0.5 in a box of edge 10 and a stray one: the bounds are those of the 999. Without the stray,
 * and where the samples had to be thinned out, nothing is narrowed that should not be. */
TEST(the_bulk_leaves_strays_out)
{
    static bulk b;
    uint32_t random = 12345;
    int narrowed;
    for (int stray = 0; stray < 3; stray++) {
        const uint32_t count = stray == 2 ? 100000 : 1000;
        memset(&b, 0, sizeof b);
        for (uint32_t i = 0; i < count; i++) {
            float p[3];
            for (int c = 0; c < 3; c++) {
                random = random * 1664525u + 1013904223u;
                p[c] = 10.0f * (float)(random >> 8) * 0x1p-24f;
            }
            if (stray && i == 500)
                p[1] = 1e6f;
            bulk_add(&b, i / 70, i, i, p, 0.5f);
        }
        float min[3] = {-0.5f, -0.5f, -0.5f}, max[3] = {10.5f, stray ? 1e6f : 10.5f, 10.5f};
        const uint64_t outside = cgt_bulk_narrow(&b, min, max, &narrowed);
        assert_int_equal(narrowed, stray > 0);
        assert_int_equal(outside, stray > 0);
        assert_true(max[1] > 10.0f && max[1] <= 10.5f);
        assert_true(min[1] == -0.5f && max[0] == 10.5f);
        assert_true(b.count == (count < BULK_SAMPLES ? count : BULK_SAMPLES));
    }
    memset(&b, 0, sizeof b);
    float min[3] = {0}, max[3] = {1.0f, 1.0f, 1.0f};
    assert_int_equal(cgt_bulk_narrow(&b, min, max, &narrowed), 0);
    assert_int_equal(narrowed, 0);
}

/* Bounds are rounded to float, as a survey's are: of spheres in one place none is left out. */
TEST(the_bulk_of_one_place_is_all)
{
    static bulk b;
    uint32_t random = 12345;
    for (uint32_t round = 0; round < 3000; round++) {
        const uint32_t count = round % 3 == 0 ? 1 : round % 3 == 1 ? 2 : 5000;
        float p[3], min[3], max[3];
        int narrowed;
        if (count > 2 && round % 300 != 2)
            continue;
        for (int c = 0; c < 3; c++) {
            random = random * 1664525u + 1013904223u;
            p[c] = 10.0f * (float)(random >> 8) * 0x1p-24f;
            min[c] = p[c] - 0.1f;
            max[c] = p[c] + 0.1f;
        }
        memset(&b, 0, sizeof b);
        for (uint32_t i = 0; i < count; i++)
            bulk_add(&b, 0, i, i, p, 0.1f);
        assert_int_equal(cgt_bulk_narrow(&b, min, max, &narrowed), 0);
        assert_int_equal(narrowed, 0);
        assert_true(min[0] == p[0] - 0.1f && max[2] == p[2] + 0.1f);
    }
}

/* Adds a run: 400 balls of radius 0.5 lie in a bed of 10 x 10 x 1, and each has been at `height` above it in one of 200
 * frames. One ball, in the last frame, is at `stray` above. */
static void add_falls(bulk *b, uint64_t first, uint64_t frames, float height, float stray)
{
    for (uint64_t frame = first; frame < first + frames; frame++)
        for (uint32_t i = 0; i < 400; i++) {
            const int falls = frame == i / 5;
            float p[3] = {0.5f * (float)(i % 20), 0.5f * (float)(i / 20), falls ? height : 0.0025f * (float)i};
            if (frame == 199 && i == 17 && stray > 0.0f)
                p[2] = stray;
            bulk_add(b, frame, i, 1000 + i, p, 0.5f);
        }
}

/* What most particles pass belongs to the picture, though they are there for a two-hundredth of the time; unless it is
 * far away, and one stray does not. */
TEST(the_bulk_has_what_falls_in)
{
    static bulk b, part;
    int narrowed;
    static const struct {
        float height, stray, top;
        int narrowed;
    } rows[] = {{19.0f, 0.0f, 19.5f, 0}, {19.0f, 500.0f, 19.5f, 1}, {40.0f, 0.0f, 1.5f, 1}, {40.0f, 500.0f, 1.5f, 1}};
    for (size_t row = 0; row < sizeof rows / sizeof rows[0]; row++)
        for (int parts = 1; parts <= 2; parts++) {
            const float highest = fmaxf(rows[row].height, rows[row].stray) + 0.5f;
            float min[3] = {-0.5f, -0.5f, -0.5f}, max[3] = {10.0f, 10.0f, highest};
            memset(&b, 0, sizeof b);
            memset(&part, 0, sizeof part);
            add_falls(&b, 0, parts == 1 ? 200 : 31, rows[row].height, rows[row].stray);
            add_falls(&part, 31, parts == 1 ? 0 : 169, rows[row].height, rows[row].stray);
            cgt_bulk_merge(&b, &part);
            cgt_bulk_narrow(&b, min, max, &narrowed);
            if (fabsf(max[2] - rows[row].top) > 0.1f || narrowed != rows[row].narrowed)
                fail_msg("row %zu, %d parts: up to %g, narrowed %d", row, parts, (double)max[2], narrowed);
            assert_true(min[2] == -0.5f && max[0] == 10.0f);
        }
    /* Of many particles those with the smallest hashes are followed, whatever the order of places. */
    static bulk backwards;
    memset(&b, 0, sizeof b);
    memset(&backwards, 0, sizeof backwards);
    for (uint32_t k = 0; k < 60000; k++) {
        const uint32_t i = k % 30000;
        bulk_add(&b, k / 30000, i, i, (const float[]){(float)i, (float)(k / 30000), 0.0f}, 0.5f);
        const uint32_t back = 59999 - k;
        bulk_add(&backwards, back / 30000, back % 30000, back % 30000,
                 (const float[]){(float)(back % 30000), (float)(back / 30000), 0.0f}, 0.5f);
    }
    cgt_bulk_sort(&b);
    cgt_bulk_sort(&backwards);
    assert_int_equal(b.particles, BULK_SAMPLES);
    assert_memory_equal(&b, &backwards, sizeof b);
    for (uint32_t i = 0; i < b.particles; i++)
        assert_true(b.particle[i].min[0] == b.particle[i].max[0] && b.particle[i].max[1] == 1.0f);
}

static const char *write_keys(const char *text)
{
    static char path[] = "camera_keys_test.txt";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
    return path;
}

TEST(keys_move_the_camera)
{
    camera_keys keys;
    cgt_camera c;
    char error[512];
    const char *path = write_keys("# a comment\n\n10 8,0,0,0,0,0,0,0,1,30 linear\n20 0,2,0,0,0,0,0,0,1,50\n"
                                  "40 0,-2,0,0,0,0,0,0,1,50 hold\n50 0,-9,0,0,0,0,0,0,1,20 ease\n");
    assert_int_equal(cgt_camera_keys_read(&keys, path, error, sizeof error), 0);
    assert_int_equal(keys.count, 4);
    cgt_camera_keys_at(&keys, 3, &c); /* before the first */
    assert_true(c.eye[0] == 8.0f && c.fov == 30.0f);
    cgt_camera_keys_at(&keys, 15, &c); /* halfway: on the arc, at the geometric mean of 8 and 2 */
    assert_true(fabsf(c.eye[0] - 2.828427f) < 1e-5f && fabsf(c.eye[1] - 2.828427f) < 1e-5f && c.fov == 40.0f);
    cgt_camera_keys_at(&keys, 20, &c);
    assert_true(c.eye[1] == 2.0f && c.fov == 50.0f);
    cgt_camera_keys_at(&keys, 22, &c); /* a tenth of the time: 0.028 of half a turn, around what points up */
    assert_true(fabsf(c.eye[0] + 2.0f * sinf(0.028f * 3.14159265f)) < 1e-5f && c.eye[1] > 1.9f && c.eye[2] == 0.0f);
    cgt_camera_keys_at(&keys, 30, &c);
    assert_true(fabsf(c.eye[0] + 2.0f) < 1e-5f && c.eye[2] == 0.0f);
    cgt_camera_keys_at(&keys, 49, &c); /* held */
    assert_true(c.eye[1] == -2.0f);
    cgt_camera_keys_at(&keys, 1000, &c);
    assert_true(c.eye[1] == -9.0f && c.fov == 20.0f);
    cgt_camera_keys_free(&keys);

    assert_int_equal(cgt_camera_keys_read(&keys,
                                          write_keys("\xEF\xBB\xBF"
                                                     "0 8,0,0,0,0,0,0,0,1,30\n"),
                                          error, sizeof error),
                     0);
    assert_int_equal(keys.count, 1);
    cgt_camera_keys_free(&keys);
    assert_int_equal(cgt_camera_keys_read(&keys, "/dev/zero", error, sizeof error), -1); /* endless */
    assert_non_null(strstr(error, "more than"));

    static const char *const wrong[] = {"",
                                        "5\n",
                                        "5 1,2,3\n",
                                        "5 8,0,0,0,0,0,0,0,1,30 slow\n",
                                        "x 8,0,0,0,0,0,0,0,1,30\n",
                                        "5 8,0,0,0,0,0,0,0,1,30\n5 8,0,0,0,0,0,0,0,1,30\n",
                                        "5 8,0,0,0,0,0,0,0,1,30 ease more\n"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(cgt_camera_keys_read(&keys, write_keys(wrong[i]), error, sizeof error), -1);
        assert_non_null(strstr(error, path));
    }
    assert_int_equal(remove(path), 0);
    assert_int_equal(cgt_camera_keys_read(&keys, path, error, sizeof error), -1);
}

SUITE(create_context, release_context)

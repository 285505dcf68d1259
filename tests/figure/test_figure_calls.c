/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * <cgt/figure.h>: calls in an order that few programs have. Options after frames are kept, frames of two figures,
 * cameras of a hand between the steps of a picture, and what fails. */
#include "support/suite.h"
#include "support/test.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "figure_state.h"

#include "core/sanitized.h"

#if defined __linux__ && !CGT_SANITIZED /* sanitizers have memory of their own */
#include <sys/resource.h>
#define CAN_LIMIT_MEMORY
#endif

enum { GRAINS = 4, WIDTH = 60, HEIGHT = 45, BYTES = 3 * WIDTH * HEIGHT };

static cgt_context *context;
static float place[GRAINS][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5f, 0.5f, 1}}, charge[GRAINS] = {1, 2, 3, 4};
static const cgt_figure_column columns[] = {{.name = "charge", .values = {charge, 0, CGT_FORMAT_FLOAT}}};

static int make_context(void **state)
{
    (void)state;
    return cgt_context_create(NULL, &context);
}

static int release_context(void **state)
{
    (void)state;
    cgt_context_release(context);
    return 0;
}

static cgt_figure_data grains(void)
{
    return (cgt_figure_data){.points = {GRAINS, cgt_floats(place[0], 0), columns, 1, 0.3f}};
}

static cgt_figure *make_figure(void)
{
    cgt_figure *figure;
    assert_int_equal(cgt_figure_create(context, &figure), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "size", "60x45"), CGT_OK);
    return figure;
}

static cgt_figure_frame *keep(cgt_figure *figure, const cgt_figure_data *data)
{
    cgt_figure_frame *frame = NULL;
    char text[256];
    uint64_t lead;
    assert_int_equal(cgt_figure_begin_keep(figure, &lead), CGT_OK);
    assert_int_equal(cgt_figure_keep(figure, data, &frame, text, sizeof text), CGT_OK);
    return frame;
}

/* The figure has a sentence with these words. */
static void expect_message(const cgt_figure *figure, const char *words)
{
    char text[1024];
    cgt_figure_get_error_message(figure, text, sizeof text);
    if (!strstr(text, words))
        fail_msg("no \"%s\" in \"%s\"", words, text);
}

static void draw(cgt_figure *figure, uint8_t rgb[BYTES])
{
    const cgt_image image = {.bytes = rgb};
    assert_int_equal(cgt_figure_draw(figure, &image, NULL), CGT_OK);
}

/* ---- Frames that are kept ----------------------------------------------------------------------------------- */

/* Options by which frames are taken are refused from the call on that begins to keep them: before a frame is kept,
 * before one is shown, and after a mesh has undone all choices. */
TEST(frames_are_kept_by_the_options_before)
{
    static const char *const options[][2] = {
        {"trails", "3"}, {"unwrap", NULL}, {"whole", NULL}, {"type-element", "1=O"}};
    const cgt_figure_data data = grains();
    uint8_t rgb[BYTES];
    for (size_t i = 0; i < TEST_COUNT(options); i++) {
        cgt_figure *const figure = make_figure();
        cgt_figure_frame *frame = NULL;
        char text[100];
        uint64_t lead;
        assert_int_equal(cgt_figure_begin_keep(figure, &lead), CGT_OK);
        for (int step = 0; step < 4; step++) {
            assert_int_equal(cgt_figure_set(figure, options[i][0], options[i][1]), CGT_ERROR_INVALID_ARGUMENT);
            snprintf(text, sizeof text, "%s: the frames that are kept", options[i][0]);
            expect_message(figure, text);
            assert_int_equal(cgt_figure_get(figure, options[i][0], NULL, 0), 0);
            if (step == 0)
                assert_int_equal(cgt_figure_set(figure, "color", "charge"), CGT_OK);
            if (step == 1)
                frame = keep(figure, &data);
            if (step == 2)
                assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
            if (step == 2)
                assert_int_equal(cgt_figure_set_mesh(figure, NULL), CGT_OK);
        }
        assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
        draw(figure, rgb);
        cgt_figure_frame_release(frame);
        cgt_figure_release(figure);
    }
}

/* Beside kept frames others are shown, which have trails of their own. */
TEST(trails_are_of_frames_that_are_shown_too)
{
    cgt_figure *const figure = make_figure(), *const fresh = make_figure();
    cgt_figure_data data = grains();
    uint8_t rgb[BYTES], expected[BYTES];
    const char *const settings = "trails = 3\ncamera = 4,-9,5,0.5,0.5,0.5,0,0,1,20\n";
    uint64_t lead;
    assert_int_equal(cgt_figure_set_lines(figure, settings), CGT_OK);
    assert_int_equal(cgt_figure_set_lines(fresh, settings), CGT_OK);
    assert_int_equal(cgt_figure_begin_keep(figure, &lead), CGT_OK);
    assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
    draw(figure, rgb);
    cgt_figure_frame *const frame = keep(figure, &data);
    assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
    draw(figure, rgb);
    for (data.number = 0; data.number < 3; data.number++) {
        place[3][2] += 0.7f;
        assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
        assert_int_equal(cgt_figure_show(fresh, &data), CGT_OK);
    }
    place[3][2] = 1.0f;
    draw(figure, rgb);
    draw(fresh, expected);
    assert_memory_equal(rgb, expected, sizeof rgb);
    cgt_figure_frame_release(frame);
    cgt_figure_release(figure);
    cgt_figure_release(fresh);
}

/* A frame is drawn by one figure: another one takes it. Trails are of the figure that has kept it. */
TEST(a_frame_goes_from_figure_to_figure)
{
    cgt_figure *const figure = make_figure(), *const other = make_figure();
    const cgt_figure_data data = grains();
    uint8_t rgb[BYTES], again[BYTES];
    const cgt_image image = {.bytes = rgb};
    cgt_figure_frame *const frame = keep(figure, &data);
    assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
    draw(figure, rgb);
    assert_int_equal(cgt_figure_show_frame(other, frame), CGT_OK);
    draw(other, again);
    assert_memory_equal(again, rgb, sizeof rgb);
    assert_int_equal(cgt_figure_draw(figure, &image, NULL), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "nothing is shown");
    assert_int_equal(cgt_figure_set(other, "trails", "3"), CGT_OK);
    assert_int_equal(cgt_figure_show_frame(other, frame), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(other, "another figure has kept the frame");
    assert_int_equal(cgt_figure_unset(other, "trails"), CGT_OK);
    assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
    assert_int_equal(cgt_figure_show_frame(other, frame), CGT_OK);
    cgt_figure_frame_release(frame);
    assert_int_equal(cgt_figure_draw(figure, &image, NULL), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_draw(other, &image, NULL), CGT_ERROR_INVALID_ARGUMENT);
    cgt_figure_release(figure);
    cgt_figure_release(other);
}

/* Lines change what their options say, and no more: the camera of the hand and the range of the run stay. */
TEST(lines_keep_what_they_do_not_name)
{
    cgt_figure *const figure = make_figure();
    cgt_figure_data data = grains();
    char range[100];
    cgt_camera hand, then;
    assert_int_equal(cgt_figure_set(figure, "color", "charge"), CGT_OK);
    assert_int_equal(cgt_figure_survey(figure, &data), CGT_OK);
    data.number = 1;
    charge[3] = 40.0f;
    assert_int_equal(cgt_figure_survey(figure, &data), CGT_OK);
    charge[3] = 4.0f;
    data.number = 0;
    cgt_figure_frame *const frame = keep(figure, &data);
    assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
    assert_int_equal(cgt_figure_get_camera(figure, &hand), CGT_OK);
    hand.eye[0] = 20.0f;
    assert_int_equal(cgt_figure_set_camera(figure, &hand), CGT_OK);
    assert_int_equal(cgt_figure_set_lines(figure, "outline = 2\nradius-scale = 0.8\n"), CGT_OK);
    assert_int_equal(cgt_figure_set_lines(figure, ""), CGT_OK);
    assert_int_equal(cgt_figure_get_camera(figure, &then), CGT_OK);
    assert_true(then.eye[0] == 20.0f);
    cgt_figure_get_chosen(figure, "range", range, sizeof range);
    assert_string_equal(range, "1,40\n");
    assert_int_equal(cgt_figure_set_lines(figure, "outline = 1\nview = top\n"), CGT_OK);
    assert_int_equal(cgt_figure_get_camera(figure, &then), CGT_OK);
    assert_true(then.eye[0] != 20.0f);
    cgt_figure_get_chosen(figure, "range", range, sizeof range);
    assert_string_equal(range, "1,40\n");
    assert_int_equal(cgt_figure_set_lines(figure, "color = charge\n"), CGT_OK); /* of the frame */
    cgt_figure_get_chosen(figure, "range", range, sizeof range);
    assert_string_equal(range, "1,4\n");
    cgt_figure_frame_release(frame);
    cgt_figure_release(figure);
}

/* A survey goes on after a frame that was refused, and stays where the shown one is. */
TEST(frames_that_are_refused_leave_the_survey)
{
    cgt_figure *const figure = make_figure(), *const fresh = make_figure();
    cgt_figure_data data = grains(), bad = grains();
    uint8_t rgb[BYTES], expected[BYTES];
    bad.points.column_count = 0;
    for (int k = 0; k < 2; k++) {
        cgt_figure *const f = k ? fresh : figure;
        assert_int_equal(cgt_figure_set(f, "color", "charge"), CGT_OK);
        assert_int_equal(cgt_figure_survey(f, &data), CGT_OK);
        if (f == figure)
            assert_int_equal(cgt_figure_survey(f, &bad), CGT_ERROR_INVALID_ARGUMENT);
        charge[3] = 40.0f;
        assert_int_equal(cgt_figure_survey(f, &data), CGT_OK);
        charge[3] = 4.0f;
        assert_int_equal(cgt_figure_show(f, &data), CGT_OK);
    }
    draw(fresh, expected);
    draw(figure, rgb);
    assert_memory_equal(rgb, expected, sizeof rgb);
    assert_int_equal(cgt_figure_show(figure, &bad), CGT_ERROR_INVALID_ARGUMENT);
    const cgt_image image = {.bytes = rgb};
    assert_int_equal(cgt_figure_draw(figure, &image, NULL), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "nothing is shown");
    assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
    draw(figure, rgb);
    assert_memory_equal(rgb, expected, sizeof rgb);
    /* without a survey nothing of it stays */
    assert_int_equal(cgt_figure_set(figure, "size", "64x48"), CGT_OK);
    assert_int_equal(cgt_figure_show(figure, &bad), CGT_ERROR_INVALID_ARGUMENT);
    cgt_camera camera;
    assert_int_equal(cgt_figure_get_camera(figure, &camera), CGT_ERROR_INVALID_ARGUMENT);
    cgt_figure_release(figure);
    cgt_figure_release(fresh);
}

/* ---- The camera of a hand ----------------------------------------------------------------------------------- */

/* What cannot be drawn is refused, at any origin, and the camera is the one before. */
TEST(cameras_that_see_nothing_are_refused)
{
    const cgt_camera good = {.eye = {0.5f, -6.0f, 2.0f}, .target = {0.5f, 0.5f, 0.5f}, .up = {0, 0, 1}, .fov = 30.0f};
    cgt_camera wrong[9];
    for (size_t i = 0; i < TEST_COUNT(wrong); i++)
        wrong[i] = good;
    memcpy(wrong[0].target, good.eye, sizeof good.eye);
    wrong[1].eye[2] = NAN;
    wrong[2].target[0] = INFINITY;
    wrong[3].up[1] = NAN;
    memcpy(wrong[4].up, (const float[]){0.0f, 13.0f, -3.0f}, sizeof good.up); /* along the view */
    wrong[5].fov = 400.0f;
    wrong[6].fov = NAN;
    wrong[7].t_min = -1.0f;
    wrong[8].t_min = 2.0f;
    wrong[8].t_max = 1.0f;
    for (int far_off = 0; far_off < 2; far_off++) {
        cgt_figure *const figure = make_figure();
        cgt_figure_data data = grains();
        uint8_t before[BYTES], after[BYTES];
        cgt_camera then;
        data.origin[0] = far_off ? -1000.0 : 0.0;
        assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
        assert_int_equal(cgt_figure_get_camera(figure, &then), CGT_OK);
        for (int c = 0; c < 3; c++) { /* about where the grains are */
            then.eye[c] = good.eye[c] + (then.target[c] - good.target[c]);
            then.up[c] = good.up[c];
        }
        assert_int_equal(cgt_figure_set_camera(figure, &then), CGT_OK);
        draw(figure, before);
        for (size_t i = 0; i < TEST_COUNT(wrong); i++) {
            if (cgt_figure_set_camera(figure, &wrong[i]) != CGT_ERROR_INVALID_ARGUMENT)
                fail_msg("camera %zu is not refused", i);
            expect_message(figure, "camera: ");
        }
        draw(figure, after);
        assert_memory_equal(after, before, sizeof after);
        cgt_figure_release(figure);
    }
}

/* Zeros mean the defaults to all that measures by the camera: styles, orthographic pictures, settings. */
TEST(zeros_of_cameras_are_defaults)
{
    static const char *const settings[] = {"style = soft\n", "ortho\nstyle = paper\n", "depth-cue = 0.5\n"};
    const cgt_camera zeros = {.eye = {0.5f, 0.0f, 6.0f}},
                     said = {.eye = {0.5f, 0.0f, 6.0f}, .up = {0, 1, 0}, .fov = 45};
    for (int far_off = 0; far_off < 2; far_off++)
        for (size_t i = 0; i < TEST_COUNT(settings); i++) {
            cgt_figure *const figure = make_figure(), *const other = make_figure();
            cgt_figure_data data = grains();
            cgt_camera none = {.fov = 0.0f}, then;
            uint8_t one[BYTES], two[BYTES];
            char text[500];
            data.origin[0] = far_off ? 1000.0 : 0.0;
            for (int k = 0; k < GRAINS; k++)
                place[k][0] += (float)data.origin[0];
            assert_int_equal(cgt_figure_set_lines(figure, settings[i]), CGT_OK);
            assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
            assert_int_equal(cgt_figure_set_camera(figure, &said), CGT_OK);
            draw(figure, one);
            assert_int_equal(cgt_figure_set_camera(figure, &zeros), CGT_OK);
            draw(figure, two);
            assert_memory_equal(two, one, sizeof two);
            cgt_figure_get_chosen(figure, NULL, text, sizeof text);
            assert_int_equal(cgt_figure_set_lines(other, text), CGT_OK);
            assert_int_equal(cgt_figure_show(other, &data), CGT_OK);
            draw(other, two);
            assert_memory_equal(two, one, sizeof two);
            assert_int_equal(cgt_figure_set_camera(figure, &none), CGT_OK);
            assert_int_equal(cgt_figure_get_camera(figure, &then), CGT_OK);
            assert_true(then.eye[2] == 5.0f && then.up[1] == 1.0f && then.fov == 45.0f);
            for (int k = 0; k < GRAINS; k++)
                place[k][0] -= (float)data.origin[0];
            cgt_figure_release(figure);
            cgt_figure_release(other);
        }
}

/* Edges of the box are as thick as the camera asks for that is set after the frame; of a frame that is not kept, from
 * its next showing on. */
TEST(lines_follow_the_camera)
{
    cgt_figure_data data = grains();
    for (int c = 0; c < 3; c++)
        data.box.edges[c][c] = 2.0;
    for (int is_kept = 0; is_kept < 2; is_kept++) {
        const cgt_camera camera = {.eye = {3, -90, 9}, .target = {0.5f, 0.5f, 0.5f}, .up = {0, 0, 1}, .fov = 3};
        cgt_figure *const figure = make_figure(), *const other = make_figure();
        uint8_t after[BYTES], before[BYTES];
        cgt_figure_frame *frame = NULL, *same = NULL;
        assert_int_equal(cgt_figure_set(figure, "box", NULL), CGT_OK);
        assert_int_equal(cgt_figure_set(other, "box", NULL), CGT_OK);
        assert_int_equal(cgt_figure_set_camera(other, &camera), CGT_OK);
        if (is_kept) {
            frame = keep(figure, &data);
            same = keep(other, &data);
        }
        assert_int_equal(is_kept ? cgt_figure_show_frame(figure, frame) : cgt_figure_show(figure, &data), CGT_OK);
        assert_int_equal(is_kept ? cgt_figure_show_frame(other, same) : cgt_figure_show(other, &data), CGT_OK);
        assert_int_equal(cgt_figure_set_camera(figure, &camera), CGT_OK);
        if (!is_kept)
            assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
        draw(figure, after);
        draw(other, before);
        assert_memory_equal(after, before, sizeof after);
        cgt_figure_frame_release(frame);
        cgt_figure_frame_release(same);
        cgt_figure_release(figure);
        cgt_figure_release(other);
    }
}

/* Light and occlusion follow the first camera of a run, and are told where the shown one is another. */
TEST(what_was_chosen_has_the_first_light)
{
    static const char *const settings[] = {"orbit = 90\n", "orbit = 90\nlight = 1,2,3\n", "camera-keys = %s\n",
                                           "camera-keys = %s\nstyle = plain\ndepth-cue = 0.4\n"};
    const char *const folder = getenv("TMPDIR");
    char path[300];
    snprintf(path, sizeof path, "%s/test_figure_calls.keys", folder ? folder : ".");
    FILE *const keys = fopen(path, "w");
    assert_non_null(keys);
    fputs("0 0.5,-6,2,0.5,0.5,0.5,0,0,1,30\n2 4,2,4,0.5,0.5,0.5,0,0,1,40\n", keys);
    fclose(keys);
    for (size_t i = 0; i < TEST_COUNT(settings); i++) {
        cgt_figure *const figure = make_figure(), *const other = make_figure();
        cgt_figure_data data = grains();
        uint8_t one[BYTES], two[BYTES];
        char text[1000], light[100];
        snprintf(text, sizeof text, settings[i], path);
        assert_int_equal(cgt_figure_set_lines(figure, text), CGT_OK);
        for (data.number = 0; data.number < 3; data.number++)
            assert_int_equal(cgt_figure_survey(figure, &data), CGT_OK);
        for (data.number = 0; data.number < 3; data.number++) {
            assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
            draw(figure, one);
            cgt_figure_get_chosen(figure, NULL, text, sizeof text);
            if ((strstr(text, "light = ") != NULL) != (i == 1 || data.number > 0))
                fail_msg("frame %d: light in \"%s\"", (int)data.number, text);
            assert_true(cgt_figure_get_chosen(figure, "light", light, sizeof light) > 0);
            assert_int_equal(strcmp(light, "1,2,3\n") == 0, i == 1);
            assert_int_equal(cgt_figure_unset(other, NULL), CGT_OK);
            assert_int_equal(cgt_figure_set_lines(other, text), CGT_OK);
            assert_int_equal(cgt_figure_show(other, &data), CGT_OK);
            draw(other, two);
            if (memcmp(two, one, sizeof two) != 0)
                fail_msg("frame %d: another picture by \"%s\"", (int)data.number, text);
        }
        cgt_figure_release(figure);
        cgt_figure_release(other);
    }
    remove(path);
}

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

/* However large the blocks of a quick picture are: one of them has all pixels. */
TEST(blocks_are_of_any_size)
{
    static const uint32_t shrinks[] = {WIDTH, 4000000000u, UINT32_MAX - HEIGHT, UINT32_MAX};
    cgt_figure *const figure = make_figure();
    const cgt_figure_data data = grains();
    uint8_t rgb[BYTES];
    const cgt_image image = {.bytes = rgb};
    assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
    for (size_t i = 0; i < TEST_COUNT(shrinks); i++) {
        assert_int_equal(cgt_figure_draw_quick(figure, CGT_FIGURE_SHADOWS, shrinks[i], &image), CGT_OK);
        for (int k = 3; k < BYTES; k++)
            assert_int_equal(rgb[k], rgb[k % 3]);
    }
    cgt_figure_release(figure);
}

/* Texts are where the camera of the picture sees what they name, whatever camera is set between its steps. Labels are
 * drawn there, without FreeType nothing is. */
TEST(texts_follow_the_picture)
{
    cgt_figure *const figure = make_figure();
    const cgt_figure_data data = grains();
    uint8_t one[BYTES], two[BYTES];
    const cgt_image image = {.bytes = two};
    uint32_t left;
    cgt_camera camera;
    if (cgt_figure_set_lines(figure, "axes\nlabel = charge > 2\n") == CGT_OK &&
        cgt_figure_show(figure, &data) == CGT_OK) {
        for (int is_whole = 0; is_whole < 2; is_whole++) {
            if (is_whole)
                draw(figure, one);
            else
                assert_int_equal(cgt_figure_begin(figure), CGT_OK);
            assert_int_equal(cgt_figure_step(figure, UINT32_MAX, &left), CGT_OK);
            assert_int_equal(cgt_figure_read(figure, &(cgt_image){.bytes = one}), CGT_OK);
            assert_int_equal(cgt_figure_get_camera(figure, &camera), CGT_OK);
            camera.eye[0] += 3.0f;
            camera.fov = 15.0f;
            assert_int_equal(cgt_figure_set_camera(figure, &camera), CGT_OK);
            assert_int_equal(cgt_figure_read(figure, &image), CGT_OK);
            assert_memory_equal(two, one, sizeof two);
            draw(figure, two); /* by the other camera */
            assert_memory_not_equal(two, one, sizeof two);
        }
    } else
        expect_message(figure, "FreeType");
    cgt_figure_release(figure);
}

/* With kept frames an option that is refused leaves the frame, and the next picture is that of before. */
TEST(pictures_begin_after_what_was_refused)
{
    cgt_figure *const figure = make_figure();
    const cgt_figure_data data = grains();
    uint8_t one[BYTES], two[BYTES];
    uint32_t left;
    cgt_figure_frame *const frame = keep(figure, &data);
    assert_int_equal(cgt_figure_show_frame(figure, frame), CGT_OK);
    draw(figure, one);
    assert_int_equal(cgt_figure_begin(figure), CGT_OK);
    assert_int_equal(cgt_figure_set(figure, "fov", "x"), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_step(figure, 1, &left), CGT_OK); /* what can be told without the frame */
    assert_int_equal(cgt_figure_set(figure, "color", "warmth"), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_step(figure, 1, &left), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_begin(figure), CGT_OK);
    assert_int_equal(cgt_figure_step(figure, UINT32_MAX, &left), CGT_OK);
    assert_int_equal(cgt_figure_read(figure, &(cgt_image){.bytes = two}), CGT_OK);
    assert_memory_equal(two, one, sizeof two);
    cgt_figure_frame_release(frame);
    cgt_figure_release(figure);
}

/* A pixel has what the picture has there: what the camera's range and mask leave out is not found. */
TEST(pixels_have_what_the_camera_sees)
{
    static const uint32_t masks[] = {1, 3, 4}; /* what is opaque, all, nothing */
    cgt_figure *const figure = make_figure();
    const cgt_figure_data data = grains();
    cgt_camera all, some;
    float square = 0.0f;
    uint8_t rgb[BYTES];
    assert_int_equal(cgt_figure_set_lines(figure, "style = plain\nantialias = 1\nbackground = white\n"
                                                  "opacity = charge > 2=0.5\n"),
                     CGT_OK);
    assert_int_equal(cgt_figure_show(figure, &data), CGT_OK);
    assert_int_equal(cgt_figure_get_camera(figure, &all), CGT_OK);
    for (int c = 0; c < 3; c++)
        square += (all.eye[c] - all.target[c]) * (all.eye[c] - all.target[c]);
    for (int way = 0; way < 7; way++) {
        uint32_t hits = 0;
        some = all;
        some.t_min = way == 1 ? 1e6f : way == 2 ? sqrtf(square) : 0.0f; /* all, and some of the grains */
        some.t_max = way == 3 ? 1e-3f : 0.0f;
        some.mask = way > 3 ? masks[way - 4] : 0;
        assert_int_equal(cgt_figure_set_camera(figure, &some), CGT_OK);
        draw(figure, rgb);
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
            cgt_figure_hit hit;
            assert_int_equal(cgt_figure_pick(figure, i % WIDTH, i / WIDTH, &hit), CGT_OK);
            const int is_white = rgb[3 * i] == 255 && rgb[3 * i + 1] == 255 && rgb[3 * i + 2] == 255;
            if (hit.is_hit == is_white)
                fail_msg("way %d, pixel %u: %s", way, i, is_white ? "found, not drawn" : "drawn, not found");
            hits += hit.is_hit;
        }
        if ((hits > 0) != (way == 0 || way == 2 || way == 4 || way == 5))
            fail_msg("way %d: %u hits", way, hits);
    }
    cgt_figure_release(figure);
}

/* ---- What fails --------------------------------------------------------------------------------------------- */

/* The result is not guessed from words of the user. */
TEST(words_are_no_results)
{
    static const char words[] = "out of memory";
    const cgt_figure_column column = {.name = words};
    cgt_figure *const figure = make_figure();
    cgt_figure_data data = grains();
    cgt_figure_frame *frame;
    char text[300];
    uint64_t lead;
    cgt_figure_set_source(figure, words);
    assert_int_equal(cgt_figure_set(figure, words, NULL), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_set(figure, "color", words), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_set(figure, "colormap", words), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_set(figure, "camera-keys", words), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_set(figure, "show", "\"out of memory\""), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_set(figure, "box", NULL), CGT_OK);
    assert_int_equal(cgt_figure_show(figure, &data), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, "out of memory: frame 0: --box");
    assert_int_equal(cgt_figure_unset(figure, "box"), CGT_OK);
    data.points.columns = &column;
    assert_int_equal(cgt_figure_show(figure, &data), CGT_ERROR_INVALID_ARGUMENT);
    expect_message(figure, words);
    assert_int_equal(cgt_figure_begin_keep(figure, &lead), CGT_OK);
    assert_int_equal(cgt_figure_keep(figure, &data, &frame, text, sizeof text), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_keep(figure, &data, &frame, NULL, 0), CGT_ERROR_INVALID_ARGUMENT);
    cgt_figure_release(figure);
}

/* It is that of what has failed: of the library, the sentence of a layer below, the figure's own. None outlives its
 * call. */
TEST(results_are_of_what_has_failed)
{
    cgt_figure *const figure = make_figure();
    cgt_figure_fail_library(figure, "build", CGT_ERROR_TOO_LARGE);
    assert_int_equal(cgt_figure_result(figure), CGT_ERROR_TOO_LARGE);
    snprintf(figure->message, sizeof figure->message, "out of memory for 3 spheres");
    assert_int_equal(cgt_figure_result(figure), CGT_ERROR_OUT_OF_MEMORY);
    cgt_figure_fail(figure, "out of memory for %s", "the mesh");
    assert_int_equal(cgt_figure_result(figure), CGT_ERROR_OUT_OF_MEMORY);
    cgt_figure_fail(figure, "%s", "out of memory for the mesh");
    assert_int_equal(cgt_figure_result(figure), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_figure_set(figure, "style", "x"), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(figure->failure, CGT_OK);
    assert_int_equal(cgt_figure_fit(figure), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(figure->failure, CGT_OK);
    assert_int_equal(cgt_figure_begin(figure), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(figure->failure, CGT_OK);
    cgt_figure_release(figure);
}

#ifdef CAN_LIMIT_MEMORY
/* Where there is no memory for a frame, the call says so, also without a text. */
TEST(frames_need_memory)
{
    enum { MANY = 1 << 20 };
    static float many[MANY][3];
    cgt_figure *const figure = make_figure();
    const cgt_figure_data data = {.points = {.count = MANY, .positions = cgt_floats(many[0], 0)}};
    cgt_figure_frame *frame;
    struct rlimit before, none;
    uint64_t lead;
    assert_int_equal(cgt_figure_begin_keep(figure, &lead), CGT_OK);
    assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
    none = before;
    none.rlim_cur = 1 << 20; /* less than there is: no more */
    assert_int_equal(setrlimit(RLIMIT_AS, &none), 0);
    const cgt_result result = cgt_figure_keep(figure, &data, &frame, NULL, 0);
    assert_int_equal(setrlimit(RLIMIT_AS, &before), 0);
    assert_int_equal(result, CGT_ERROR_OUT_OF_MEMORY);
    assert_null(frame);
    cgt_figure_release(figure);
}
#endif

SEEDED_SUITE("test_figure_calls", make_context, release_context)

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The programs' command-line parsers: numbers, sizes, cameras. */
#include "support/suite.h"

#include <string.h>

#include "common/program.h"
#include "options/numbers.h"

static char error[PROGRAM_ERROR_SIZE];

TEST(whole_numbers)
{
    static const char *const wrong[] = {"", "-1", "+1", " 1", "1 ", "1.0", "0x1", "18446744073709551616", "9"};
    uint64_t u = 77;
    assert_int_equal(cgt_read_u64("18446744073709551615", 0, UINT64_MAX, &u, error, sizeof error), 0);
    assert_true(u == UINT64_MAX);
    u = 77;
    assert_int_equal(cgt_read_u64("18446744073709551616", 0, UINT64_MAX, &u, error, sizeof error), -1);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        error[0] = '\0';
        assert_int_equal(cgt_read_u64(wrong[i], 1, 8, &u, error, sizeof error), -1);
        assert_non_null(strstr(error, "is not a whole number from 1 to 8"));
        assert_int_equal(u, 77);
    }
    uint32_t v = 77;
    assert_int_equal(cgt_read_u32("4294967296", 0, UINT32_MAX, &v, error, sizeof error), -1);
    assert_int_equal(v, 77);
    assert_int_equal(cgt_read_u32("4294967295", 0, UINT32_MAX, &v, error, sizeof error), 0);
    assert_true(v == UINT32_MAX);
    assert_int_equal(cgt_read_u32("0", 1, 2, &v, NULL, 0), -1);
}

TEST(floats)
{
    static const char *const wrong[] = {"", "nan", "inf", "-inf", "1e99", " 1", "1x", "1,2", "-0.5", "2.5", "e"};
    float f = 77, three[3] = {7, 7, 7};
    assert_int_equal(cgt_read_float("1.5e0", 0, 2, &f, error, sizeof error), 0);
    assert_true(f == 1.5f);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(cgt_read_float(wrong[i], 0, 2, &f, error, sizeof error), -1);
        assert_non_null(strstr(error, "is not a number from 0 to 2"));
        assert_true(f == 1.5f);
    }
    static const char *const wrong_lists[] = {"1,2", "1,2,3,4", "1,2,", ",1,2", "1;2;3", "1,nan,3", "1, 2,3", ""};
    for (size_t i = 0; i < sizeof wrong_lists / sizeof wrong_lists[0]; i++) {
        assert_int_equal(cgt_read_floats(wrong_lists[i], 3, three, error, sizeof error), -1);
        assert_true(three[0] == 7 && three[2] == 7);
    }
    assert_int_equal(cgt_read_floats("1,-2,.5", 3, three, error, sizeof error), 0);
    assert_true(three[0] == 1 && three[1] == -2 && three[2] == 0.5f);
    assert_int_equal(cgt_read_floats("1", 17, three, error, sizeof error), -1);
}

TEST(sizes)
{
    static const char *const wrong[] = {"",      "1280",     "1280x",      "x720",
                                        "0x720", "1280x0",   "65537x1",    "1x65537",
                                        "-1x1",  "1280*720", "1280x720x3", "18446744073709551617x1"};
    uint32_t w = 7, h = 7;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(cgt_read_size(wrong[i], &w, &h, error, sizeof error), -1);
        assert_non_null(strstr(error, "is not a size like 1280x720"));
        assert_true(w == 7 && h == 7);
    }
    assert_int_equal(cgt_read_size("65536x1", &w, &h, error, sizeof error), 0);
    assert_true(w == 65536 && h == 1);
}

TEST(cameras)
{
    static const struct {
        const char *text, *what;
    } wrong[] = {
        {"", "ten numbers"},
        {"0,0,5,0,0,0,0,1,0", "ten numbers"},
        {"0,0,5,0,0,0,0,1,0,45,1", "ten numbers"},
        {"0,0,nan,0,0,0,0,1,0,45", "ten numbers"},
        {"1,2,3,1,2,3,0,1,0,45", "same point"},
        {"0,0,5,0,0,0,0,0,1,45", "parallel"},
        {"0,0,5,0,0,0,0,0,-3,45", "parallel"},
        {"0,0,5,0,0,0,0,0,0,45", "parallel"},
        {"0,0,5,0,0,0,0,1,0,0", "above 0 and below 180"},
        {"0,0,5,0,0,0,0,1,0,180", "above 0 and below 180"},
        {"0,0,5,0,0,0,0,1,0,-45", "above 0 and below 180"},
    };
    cgt_camera camera, before;
    memset(&camera, 0, sizeof camera);
    camera.t_max = 9;
    before = camera;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(cgt_read_camera(wrong[i].text, &camera, error, sizeof error), -1);
        if (strstr(error, wrong[i].what) == NULL)
            fail_msg("'%s': \"%s\"", wrong[i].text, error);
        assert_memory_equal(&camera, &before, sizeof camera);
    }
    assert_int_equal(cgt_read_camera("1,2,-3,4,5,6,0,0,2,38.5", &camera, error, sizeof error), 0);
    assert_true(camera.eye[0] == 1 && camera.eye[2] == -3 && camera.target[1] == 5 && camera.up[2] == 2);
    assert_true(camera.fov == 38.5f && camera.t_max == 9 && camera.projection == CGT_PROJECTION_PERSPECTIVE);
    /* Far apart and tiny: neither overflows nor counts as zero. */
    assert_int_equal(cgt_read_camera("0,0,1e30,0,0,0,0,1e-30,0,45", &camera, error, sizeof error), 0);
}

SUITE(NULL, NULL)

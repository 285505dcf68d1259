/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * GSD of HOOMD-blue: a file that GSD's own module wrote, cut off and damaged. */
#define _GNU_SOURCE
#include "readers/trajectory_scratch.h"

static unsigned char bytes[8192];
static size_t size;

static void load(void)
{
    FILE *const file = fopen(CGT_TESTS_DIR "/readers/data/run.gsd", "rb");
    assert_non_null(file);
    size = fread(bytes, 1, sizeof bytes, file);
    assert_true(size > 0 && size < sizeof bytes);
    fclose(file);
}

static const char *word_of(const cgt_trajectory_frame *frame, uint32_t i)
{
    const cgt_trajectory_column *const c = cgt_trajectory_find_column(frame, "name");
    return c->word[(uint32_t)c->value[i] - 1];
}

TEST(frames)
{
    static const char *const names[] = {"name", "energy", "image_z"};
    static const uint32_t types[4] = {1, 2, 2, 1};
    load();
    char error[1024] = "";
    cgt_trajectory *t = scratch_open(scratch_bytes(".odd", bytes, size), NULL); /* by its first bytes */
    scratch_want(t, names, 3);
    for (uint32_t k = 0; k < 3; k++) {
        const cgt_trajectory_frame f = scratch_read(t);
        assert_int_equal(f.count, k < 2 ? 4 : 3);
        assert_int_equal(f.step, 100 * k);
        for (uint32_t i = 0; i < f.count; i++) {
            scratch_expect_sphere(&f, i, (float)i, 0.5f * (float)k, -(float)i, k < 2 ? 0.5f * (float)(i + 1) : 0.5f);
            assert_true(f.velocity[3 * i] == (float)k && f.velocity[3 * i + 1] == (float)i);
            assert_true(cgt_trajectory_find_column(&f, "energy")->value[i] == 0.5f * (float)i + (float)k);
            assert_int_equal(f.type[i], k < 2 ? types[i] : 1);
            assert_string_equal(word_of(&f, i), f.type[i] == 1 ? "A" : "poly");
        }
        assert_true((cgt_trajectory_find_column(&f, "image_z") != NULL) == (k < 2) && f.has_radius == (k < 2));
        assert_int_equal(f.bonds, k < 2 ? 2 : 0);
        assert_true(k == 2 || (f.bond[2] == 3 && f.bond[3] == 2));
        assert_true(f.box_edge[1][0] == (double)0.1f * 9.0 && f.box_edge[2][1] == (double)0.3f * 8.0);
        assert_true(f.box_origin[2] == -4.0 && f.periodic[2] == 1);
    }
    scratch_expect_end(t);
    assert_int_equal(told_rewind(t, error, sizeof error), 0);
    assert_int_equal(told_skip(t, error, sizeof error), 1);
    assert_int_equal(told_skip(t, error, sizeof error), 1);
    assert_true(cgt_trajectory_progress(t) > 0.6 && cgt_trajectory_progress(t) < 0.7);
    assert_int_equal(scratch_read(t).step, 200);
    assert_int_equal(told_skip(t, error, sizeof error), 0);
}

/* The index tells what should be there: frames that are whole come before the error. */
TEST(cuts)
{
    load();
    const char *const path = scratch_path(".gsd");
    for (size_t cut = 0; cut < size; cut += cut < 5300 ? 13 : 1) {
        char error[1024] = "";
        cgt_trajectory_frame frame;
        scratch_fill(path, bytes, cut);
        cgt_trajectory_close(scratch_open_one);
        scratch_open_one = told_open(path, NULL, error, sizeof error);
        unsigned frames = 0;
        while (scratch_open_one != NULL && told_read(scratch_open_one, &frame, error, sizeof error) > 0)
            frames++;
        const unsigned whole = cut >= 5780 ? 2 : cut >= 5644 ? 1 : 0; /* places in the index */
        if (frames != whole || strstr(error, "it is cut off") == NULL)
            fail_msg("cut off after %zu bytes: %u frames, '%s'", cut, frames, error);
    }
}

/* The place of an entry of the index. */
static size_t entry_place(size_t number)
{
    size_t place = 0;
    for (int i = 7; i >= 0; i--)
        place = place << 8 | bytes[8 + i];
    return place + 32 * number;
}

TEST(damage)
{
    load();
    const size_t entry = entry_place(0);
    const struct {
        size_t at;
        int value;
        unsigned frames;
        const char *what;
    } cases[] = {
        {0, 0, 0, "not a GSD file of version 1 or 2"},
        {46, 3, 0, "not a GSD file of version 1 or 2"},
        {112, 'x', 0, "a GSD file of the schema 'xoomd', not hoomd"},
        {14, 1, 0, "the index or the names lie beyond the end of the file: it is cut off"},
        {39, 1, 0, "the index or the names lie beyond the end of the file: it is cut off"},
        {entry + 30, 12, 0, "entry 0 of the index is damaged"},
        {entry + 24, 0, 0, "entry 0 of the index is damaged"},
        {entry + 29, 1, 0, "entry 0 of the index is damaged"},
        {entry + 32 * 15 + 20, 1, 1, "frame 1: the file ends in an array of a frame: it is cut off"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const unsigned char before = bytes[cases[i].at];
        bytes[cases[i].at] = (unsigned char)cases[i].value;
        scratch_expect_error(scratch_bytes(".gsd", bytes, size), NULL, cases[i].frames, cases[i].what);
        bytes[cases[i].at] = before;
    }
    static const cgt_trajectory_options few = {.max_count = 3};
    scratch_expect_error(scratch_bytes(".gsd", bytes, size), &few, 0, "4 spheres are more than the limit of 3");
    const size_t bond = 5596; /* the place of bonds/group */
    bytes[bond] = 4;
    scratch_expect_error(scratch_bytes(".gsd", bytes, size), NULL, 0,
                         "frame 0: bond 0 has a particle that is not there");
    bytes[bond] = 0;
    bytes[entry + 32 * 2 + 30] = 9; /* the type of particles/types */
    scratch_expect_error(scratch_bytes(".gsd", bytes, size), NULL, 0, "frame 0: the names of types are damaged");
    bytes[entry + 32 * 2 + 30] = 5;
    bytes[entry + 32 * 1 + 30] = 7; /* the type of particles/N: whole numbers with a sign */
    bytes[5403] = 0x80;
    scratch_expect_error(scratch_bytes(".gsd", bytes, size), NULL, 0,
                         "frame 0: -2.14748e+09 particles, step 0: damaged");
    bytes[5403] = 0;
    bytes[entry + 32 * 5 + 8] = 3; /* the rows of particles/position */
    scratch_expect_error(scratch_bytes(".gsd", bytes, size), NULL, 0, "frame 0: no positions of 4 particles");
    bytes[entry + 32 * 5 + 8] = 4;
    memset(bytes + 4352, 'x', 1024); /* the list of names */
    scratch_expect_error(scratch_bytes(".gsd", bytes, size), NULL, 0, "a name of an array without end");
#ifndef _WIN32 /* where no format of bytes may be a pipe */
    scratch_expect_error("/dev/zero", &(cgt_trajectory_options){.format = "gsd"}, 0, "GSD has to be a regular file");
#endif
}

/* An entry of 32 bytes says that there are millions of frames: what they lack is that of the first. */
TEST(frames_without_end)
{
    enum { FRAMES = 9000000 };
    char error[1024] = "";
    cgt_trajectory_frame frame;
    load();
    size_t last = entry_place(0);
    while (last + 32 < size && bytes[last + 32 + 16] + bytes[last + 32 + 17] > 0)
        last += 32;
    for (size_t i = 0; i < 4; i++)
        bytes[last + i] = (unsigned char)((FRAMES - 1) >> (8 * i));
    cgt_trajectory *const t = scratch_open(scratch_bytes(".gsd", bytes, size), NULL);
    for (int i = 1; i < FRAMES; i++)
        assert_true((told_skip)(t, error, sizeof error) == 1); /* itself: trajectory_scratch.h notes */
    assert_int_equal(told_read(t, &frame, error, sizeof error), -1);
    if (strstr(error, "with what frames take from the first the file becomes more than 1 GiB and 500 times") == NULL)
        fail_msg("%s", error);
}

SUITE(NULL, NULL)

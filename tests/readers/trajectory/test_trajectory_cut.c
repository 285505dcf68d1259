/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Text files cut off at every byte: whole frames come out, and no other number comes out without a warning. */
#define _GNU_SOURCE
#include "readers/trajectory_scratch.h"

#define MOST_FRAMES 4
#define MOST_VALUES 16

/* The numbers of a file's frames, and how many bytes each frame needs to be whole, line feed included. */
typedef struct whole_file {
    unsigned frames;
    size_t end[MOST_FRAMES];
    uint32_t count[MOST_FRAMES];
    float value[MOST_FRAMES][MOST_VALUES];
} whole_file;

static whole_file read_whole(const char *ending, const char *text, const char *last_lines)
{
    whole_file w = {0};
    cgt_trajectory *t = scratch_open(scratch_text(ending, text), NULL);
    cgt_trajectory_frame frame;
    char error[1024];
    const char *at = text;
    while (told_read(t, &frame, error, sizeof error) == 1) {
        assert_true(w.frames < MOST_FRAMES && 4 * frame.count <= MOST_VALUES);
        w.count[w.frames] = frame.count;
        memcpy(w.value[w.frames], frame.xyzr, 4 * sizeof(float) * frame.count);
        at = strstr(at, last_lines); /* a row that each frame ends with */
        assert_non_null(at);
        at = strchr(at, '\n') + 1;
        w.end[w.frames++] = (size_t)(at - text);
    }
    assert_null(cgt_trajectory_take_warning(t));
    return w;
}

static int is_frame(const whole_file *w, unsigned number, const cgt_trajectory_frame *frame)
{
    return number < w->frames && frame->count == w->count[number] &&
           memcmp(frame->xyzr, w->value[number], 4 * sizeof(float) * frame->count) == 0;
}

/* Reads what is left after a cut: as many frames as are whole, and no other numbers without a warning. */
static unsigned expect_cut(const whole_file *w, const char *path, size_t size)
{
    char error[1024];
    cgt_trajectory_frame frame;
    unsigned whole = 0, read = 0, warnings = 0;
    while (whole < w->frames && w->end[whole] <= size)
        whole++;
    cgt_trajectory *t = scratch_open(path, NULL);
    while (told_read(t, &frame, error, sizeof error) == 1) {
        const char *warning = cgt_trajectory_take_warning(t);
        const char *const more = warning ? cgt_trajectory_take_warning(t) : NULL; /* "0." of a radius is 0 */
        assert_true(more == NULL || strstr(more, "1 of 1 spheres have a radius of 0") != NULL);
        assert_null(cgt_trajectory_take_warning(t)); /* once */
        warnings += warning != NULL;
        if (warning == NULL && !is_frame(w, read, &frame))
            fail_msg("cut after %zu bytes: other numbers without a warning", size);
        assert_true(warning == NULL || strncmp(warning, path, strlen(path)) == 0);
        read++;
    }
    assert_true(read >= whole && read <= whole + 1);
    return warnings;
}

static void cut_everywhere(const char *ending, const char *text, const char *last_line, unsigned expected_warnings)
{
    const whole_file w = read_whole(ending, text, last_line);
    unsigned warnings = 0;
    assert_true(w.frames >= 2);
    for (size_t size = 0; size < strlen(text); size++)
        warnings += expect_cut(&w, scratch_bytes(ending, text, size), size);
    assert_int_equal(warnings, expected_warnings);
}

TEST(plain_rows)
{
    /* of each frame: "1", "1.", "1.2", "1.23", "1.234", "1.2345" */
    cut_everywhere(".xyz", "2\nx\nC 0.0 0.0 2.5\nC 5.0 0.0 1.2345\n2\nx\nC 0.0 0.0 2.5\nC 5.0 0.0 1.2345\n", "C 5.0",
                   12);
}

/* Numbers of one digit: each cut is noticed, as an error where a frame is not whole. */
TEST(whole_numbers)
{
    static const char text[] = "2\nfirst\nO 1 2 3\nH 4 5 6\n1\n\nO 7 8 9\n";
    const size_t first = (size_t)(strstr(text, "1\n\n") - text);
    const size_t ends[2] = {first, sizeof text - 1};
    scratch_expect_cuts(".xyz", text, 2, ends, (const uint32_t[]){2, 1});
}

TEST(described_rows)
{
    /* "0", "0.", "0.2", "0.25" */
    cut_everywhere(".extxyz",
                   "1\nProperties=species:S:1:pos:R:3:radius:R:1\nC 0 0 2.5 0.25\r\n"
                   "1\nProperties=species:S:1:pos:R:3:radius:R:1\nC 1 0 2.5 0.25 \n",
                   "C ", 8);
}

TEST(sections)
{
    cut_everywhere(".lammpstrj",
                   "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\n"
                   "ITEM: ATOMS id radius x y z\n1 1 1 1 17e1\n"
                   "ITEM: TIMESTEP\n10\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\n"
                   "ITEM: ATOMS id radius x y z\n1 1 1 1 17e1\n",
                   "1 1 1 1", 6); /* "1", "17", "17e1" */
}

#ifdef CGT_HAVE_MESHES
/* Lines of a mesh stand for themselves: a cut between two of them shows nowhere, one inside of a line does. */
TEST(meshes)
{
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 0 0 12.5\nf 1 2 4\n";
    const size_t first = (size_t)(strstr(text, "f 1 2 3") - text) + strlen("f 1 2 3");
    for (size_t size = first; size <= strlen(text); size++) {
        char error[1024];
        cgt_trajectory_frame frame;
        const char *path = scratch_bytes(".obj", text, size);
        cgt_trajectory_close(scratch_open_one);
        scratch_open_one = told_open(path, NULL, error, sizeof error);
        if (scratch_open_one == NULL)
            continue;
        if (told_read(scratch_open_one, &frame, error, sizeof error) == 1 && text[size - 1] != '\n')
            assert_non_null(cgt_trajectory_take_warning(scratch_open_one));
        else
            assert_null(cgt_trajectory_take_warning(scratch_open_one));
    }
}
#endif

SUITE(NULL, NULL)

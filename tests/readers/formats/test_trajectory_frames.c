/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * .frames files of spheres and of triangles: the bytes, round trips, damaged files. The bytes are spelt out, so that
 * machines of both byte orders must agree. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>

#include "readers/trajectory_scratch.h"

static const char FRAMES[] = ".frames";

/* Two frames: an empty one, and one sphere at (1, -2, 0.5) with radius 3. */
static const unsigned char two_frames[] = {
    'C', 'G', 'T', 'F', 'R', 'A', 'M',  '1',  1, 0, 0, 0,    2, 0, 0, 0,    0, 0, 0,    0,    0, 0, 0, 0, /* header */
    0,   0,   0,   0,                                                                                     /* none */
    1,   0,   0,   0,   0,   0,   0x80, 0x3f, 0, 0, 0, 0xc0, 0, 0, 0, 0x3f, 0, 0, 0x40, 0x40,             /* one */
};

TEST(bytes_are_little_endian)
{
    cgt_trajectory *t = scratch_open(scratch_bytes(FRAMES, two_frames, sizeof two_frames), NULL);
    cgt_trajectory_frame f = scratch_read(t);
    assert_int_equal(f.count, 0);
    assert_non_null(f.xyzr);
    f = scratch_read(t);
    assert_int_equal(f.count, 1);
    assert_true(f.number == 1 && f.step == 1);
    scratch_expect_sphere(&f, 0, 1, -2, 0.5f, 3);
    assert_true(f.kind == CGT_TRAJECTORY_SPHERES && f.triangles == 0 && f.index == NULL && f.position == NULL);
    assert_true(f.id == NULL && f.type == NULL && f.velocity == NULL && f.box_min[0] > f.box_max[0]);
    scratch_expect_end(t);

    char error[1024] = "";
    const char *path = scratch_path(FRAMES);
    cgt_trajectory_writer *w = told_writer_open(path, NULL, error, sizeof error);
    assert_non_null(w);
    const float sphere[4] = {1, -2, 0.5f, 3};
    assert_int_equal(told_writer_add(w, NULL, 0, error, sizeof error), 0);
    assert_int_equal(told_writer_add(w, sphere, 1, error, sizeof error), 0);
    assert_int_equal(told_writer_close(w, error, sizeof error), 0);
    unsigned char written[sizeof two_frames + 1];
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fread(written, 1, sizeof written, file), sizeof two_frames);
    assert_int_equal(fclose(file), 0);
    assert_memory_equal(written, two_frames, sizeof two_frames);
}

/* The bits of float i of a frame: all kinds, including a NaN with a payload. */
static uint32_t bits_of(uint32_t frame, uint32_t i)
{
    const uint32_t bits = (i + 1) * 2654435761u ^ frame * 40503u;
    return i % 11 == 0 ? 0x7fc12345u : i % 13 == 0 ? 0xff800000u : bits;
}

static const uint32_t round_trip_counts[] = {0, 5, 70000, 1, 0, 131072};
#define ROUND_TRIP_FRAMES (sizeof round_trip_counts / sizeof round_trip_counts[0])

static void write_round_trip(const char *path)
{
    char error[1024] = "";
    uint32_t *values = malloc(131072 * 16);
    assert_non_null(values);
    cgt_trajectory_writer *w = told_writer_open(path, NULL, error, sizeof error);
    assert_non_null(w);
    for (uint32_t k = 0; k < ROUND_TRIP_FRAMES; k++) {
        for (uint32_t i = 0; i < 4 * round_trip_counts[k]; i++)
            values[i] = bits_of(k, i);
        float *floats = (float *)(void *)values;
        assert_int_equal(told_writer_add(w, floats, round_trip_counts[k], error, sizeof error), 0);
    }
    assert_int_equal(told_writer_close(w, error, sizeof error), 0);
    free(values);
}

TEST(what_is_written_is_read)
{
    const char *path = scratch_path(FRAMES);
    write_round_trip(path);
    cgt_trajectory *t = scratch_open(path, NULL);
    char error[1024] = "";
    uint64_t frames = 0;
    assert_int_equal(told_count_frames(t, &frames, error, sizeof error), 0);
    assert_int_equal(frames, ROUND_TRIP_FRAMES);
    assert_int_equal(told_skip(t, error, sizeof error), 1);
    for (uint32_t k = 1; k < ROUND_TRIP_FRAMES; k++) {
        const cgt_trajectory_frame f = scratch_read(t);
        assert_int_equal(f.number, k);
        assert_int_equal(f.count, round_trip_counts[k]);
        for (uint32_t i = 0; i < 4 * f.count; i++) {
            uint32_t bits;
            memcpy(&bits, f.xyzr + i, sizeof bits);
            assert_int_equal(bits, bits_of(k, i));
        }
    }
    scratch_expect_end(t);
}

TEST(no_frames_at_all)
{
    char error[1024] = "";
    const char *path = scratch_path(FRAMES);
    cgt_trajectory_writer *w = told_writer_open(path, NULL, error, sizeof error);
    assert_non_null(w);
    assert_int_equal(told_writer_close(w, error, sizeof error), 0);
    scratch_expect_end(scratch_open(path, NULL));
}

TEST(headers_are_checked)
{
    static const scratch_change changes[] = {
        {4, 0x324d4152, 0, "not a .frames file"},
        {8, 2, 2, "data follow the 2 frames"}, /* a sphere has one number more than a vertex */
        {8, 0x01000000, 0, "kind 16777216 is neither"},
        {12, 0, 0, "the header says 0 frames, but data follow"},
        {12, 1, 1, "data follow the 1 frames"},
        {12, 3, 2, "frame 2: the file ends in the count"},
        {12, 0xffffffff, 0, "4294967295 frames cannot lie in 24 bytes"},
        {16, 1, 0, "a file of spheres says 1 triangles"},
        {20, 2, 0, "the header must end in 0, or in 1 where an origin follows"},
        {24, 1, 1, "frame 1: the file ends before the last of 1077936128 spheres"}, /* 3.0f is read as a count */
        {28, 2, 1, "frame 1: the file ends before the last of 2 spheres"},
        {28, 0x7fffffff, 1, "frame 1: the file ends before the last of 2147483647 spheres"},
        {28, 0xffffffff, 1, "frame 1: 4294967295 spheres are more than the limit of 2147483648"},
        {28, 0, 2, "data follow the 2 frames"},
    };
    scratch_expect_errors(two_frames, sizeof two_frames, changes, sizeof changes / sizeof changes[0]);
}

TEST(skipping_notices_damage)
{
    char error[1024] = "";
    cgt_trajectory *t = scratch_open(scratch_bytes(FRAMES, two_frames, sizeof two_frames - 1), NULL);
    assert_int_equal(told_skip(t, error, sizeof error), 1);
    assert_int_equal(told_skip(t, error, sizeof error), -1);
    assert_non_null(strstr(error, "frame 1: the file ends before"));
    /* Conversely: a frame with content is skipped, and the next one is short by a byte. */
    unsigned char bytes[24 + 20 + 20 - 1] = {0};
    memcpy(bytes, two_frames, 24);
    memcpy(bytes + 24, two_frames + 28, 20);
    scratch_put_u32(bytes, 44, 1);
    t = scratch_open(scratch_bytes(FRAMES, bytes, sizeof bytes), NULL);
    assert_int_equal(told_skip(t, error, sizeof error), 1);
    assert_int_equal(told_skip(t, error, sizeof error), -1);
}

TEST(limit_of_the_options)
{
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    options.max_count = 4;
    const char *path = scratch_path(FRAMES);
    write_round_trip(path);
    scratch_expect_error(path, &options, 1, "frame 1: 5 spheres are more than the limit of 4");
}

/* A pipe has no size to check a count against: memory grows as data arrive. */
TEST(pipes_are_read)
{
    unsigned char bytes[sizeof two_frames];
    for (int damage = 0; damage < 2; damage++) {
        memcpy(bytes, two_frames, sizeof bytes);
        scratch_put_u32(bytes, 28, damage ? 0x7fffffff : 1);
        const char *path = scratch_path(FRAMES);
        assert_int_equal(unlink(path), 0);
        assert_int_equal(mkfifo(path, 0600), 0);
        const int pipe_end = open(path, O_RDWR);
        assert_true(pipe_end >= 0);
        assert_int_equal(write(pipe_end, bytes, sizeof bytes), sizeof bytes);
        cgt_trajectory *t = scratch_open(path, NULL);
        assert_int_equal(close(pipe_end), 0);
        assert_int_equal(scratch_read(t).count, 0);
        if (damage) {
            char error[1024] = "";
            cgt_trajectory_frame frame;
            assert_int_equal(told_read(t, &frame, error, sizeof error), -1);
            assert_non_null(strstr(error, "frame 1: the file ends in the spheres"));
        } else {
            const cgt_trajectory_frame f = scratch_read(t);
            scratch_expect_sphere(&f, 0, 1, -2, 0.5f, 3);
            scratch_expect_end(t);
        }
    }
}

TEST(files_left_half_written_are_refused)
{
    char error[1024] = "";
    const char *path = scratch_path(FRAMES);
    cgt_trajectory_writer *w = told_writer_open(path, NULL, error, sizeof error);
    assert_non_null(w);
    static const float spheres[4 * 8192];
    assert_int_equal(told_writer_add(w, spheres, 8192, error, sizeof error), 0);
    /* Part of the 128 KiB has been written to the file, the header's count has not. */
    scratch_expect_error(path, NULL, 0, "the header says 0 frames, but data follow");
    assert_int_equal(told_writer_close(w, error, sizeof error), 0);
    assert_int_equal(scratch_read(scratch_open(path, NULL)).count, 8192);
}

TEST(writing_that_fails)
{
    char error[1024] = "";
    assert_null(told_writer_open("no/such/folder/x.frames", NULL, error, sizeof error));
    assert_non_null(strstr(error, "no/such/folder/x.frames: No such file"));
    assert_int_equal(told_writer_close(NULL, error, sizeof error), 0);
    if (access("/dev/full", W_OK) != 0) {
        print_message("no /dev/full here: a full disk is not tested\n");
        return;
    }
    cgt_trajectory_writer *w = told_writer_open("/dev/full", NULL, error, sizeof error);
    assert_non_null(w);
    static const float spheres[4 * 8192];
    assert_int_equal(told_writer_add(w, spheres, 8192, error, sizeof error), -1);
    assert_non_null(strstr(error, strerror(ENOSPC)));
    error[0] = '\0';
    assert_int_equal(told_writer_close(w, error, sizeof error), -1);
    assert_non_null(strstr(error, strerror(ENOSPC)));
    /* So little that only close writes it. */
    w = told_writer_open("/dev/full", NULL, error, sizeof error);
    assert_non_null(w);
    assert_int_equal(told_writer_add(w, spheres, 1, error, sizeof error), 0);
    assert_int_equal(told_writer_close(w, error, sizeof error), -1);
}

/* ---- Triangles ---------------------------------------------------------------------------------------------- */

/* Two triangles; a frame of four vertices, all numbers 1 to 12, and one of five, the last of which is unused. */
#define MESH_BYTES (24 + 24 + 4 + 48 + 4 + 60)
static const uint32_t mesh_index[6] = {0, 1, 2, 0, 2, 3};

static void fill_mesh(unsigned char bytes[MESH_BYTES])
{
    static const unsigned char magic[] = {'C', 'G', 'T', 'F', 'R', 'A', 'M', '1'};
    memset(bytes, 0, 24);
    memcpy(bytes, magic, sizeof magic);
    scratch_put_u32(bytes, 8, 2);
    scratch_put_u32(bytes, 12, 2);
    scratch_put_u32(bytes, 16, 2);
    for (size_t i = 0; i < 6; i++)
        scratch_put_u32(bytes, 24 + 4 * i, mesh_index[i]);
    size_t at = 48;
    for (uint32_t count = 4; count <= 5; count++) {
        scratch_put_u32(bytes, at, count);
        for (uint32_t i = 0; i < 3 * count; i++) {
            const float value = (float)(i + 1);
            uint32_t bits;
            memcpy(&bits, &value, sizeof bits);
            scratch_put_u32(bytes, at + 4 + 4 * (size_t)i, bits);
        }
        at += 4 + 12 * (size_t)count;
    }
}

static void expect_mesh(const cgt_trajectory_frame *f, uint32_t count)
{
    assert_int_equal(f->kind, CGT_TRAJECTORY_TRIANGLES);
    assert_int_equal(f->count, count);
    assert_int_equal(f->triangles, 2);
    assert_memory_equal(f->index, mesh_index, sizeof mesh_index);
    assert_true(f->xyzr == NULL && f->vertex_normal == NULL && f->id == NULL && f->type == NULL);
    for (uint32_t i = 0; i < 3 * count; i++)
        assert_true(f->position[i] == (float)(i + 1));
}

TEST(triangles_are_read_and_written)
{
    char error[1024] = "";
    unsigned char bytes[MESH_BYTES];
    fill_mesh(bytes);
    cgt_trajectory *t = scratch_open(scratch_bytes(FRAMES, bytes, sizeof bytes), NULL);
    assert_null(cgt_trajectory_get_mesh(t));
    for (int pass = 0; pass < 2; pass++) {
        cgt_trajectory_frame f = scratch_read(t);
        expect_mesh(&f, 4);
        f = scratch_read(t);
        assert_true(f.number == 1 && f.step == 1);
        expect_mesh(&f, 5);
        scratch_expect_end(t);
        assert_int_equal(told_rewind(t, error, sizeof error), 0);
    }
    assert_int_equal(told_skip(t, error, sizeof error), 1);
    const cgt_trajectory_frame f = scratch_read(t);
    expect_mesh(&f, 5);

    const char *path = scratch_path(FRAMES);
    cgt_trajectory_writer *w = told_writer_open_triangles(path, NULL, mesh_index, 2, error, sizeof error);
    assert_non_null(w);
    assert_int_equal(told_writer_add_vertices(w, f.position, 4, error, sizeof error), 0);
    assert_int_equal(told_writer_add_vertices(w, f.position, 5, error, sizeof error), 0);
    assert_int_equal(told_writer_close(w, error, sizeof error), 0);
    unsigned char written[MESH_BYTES + 1];
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fread(written, 1, sizeof written, file), sizeof bytes);
    assert_int_equal(fclose(file), 0);
    assert_memory_equal(written, bytes, sizeof bytes);
}

/* Frames must fit the index: no other kind of primitive, and no vertex missing. */
TEST(writing_refuses_what_does_not_fit)
{
    char error[1024] = "";
    static const float values[16] = {0};
    static const uint32_t beyond[3] = {0, 1, UINT32_MAX};
    cgt_trajectory_writer *w = told_writer_open(scratch_path(FRAMES), NULL, error, sizeof error);
    assert_non_null(w);
    assert_int_equal(told_writer_add_vertices(w, values, 4, error, sizeof error), -1);
    assert_non_null(strstr(error, "cannot hold vertices"));
    assert_int_equal(told_writer_close(w, error, sizeof error), -1);
    w = told_writer_open_triangles(scratch_path(FRAMES), NULL, mesh_index, 2, error, sizeof error);
    assert_non_null(w);
    assert_int_equal(told_writer_add(w, values, 4, error, sizeof error), -1);
    assert_non_null(strstr(error, "cannot hold spheres"));
    assert_int_equal(told_writer_close(w, error, sizeof error), -1);
    w = told_writer_open_triangles(scratch_path(FRAMES), NULL, mesh_index, 2, error, sizeof error);
    assert_non_null(w);
    assert_int_equal(told_writer_add_vertices(w, values, 3, error, sizeof error), -1);
    assert_non_null(strstr(error, "fewer vertices"));
    assert_int_equal(told_writer_close(w, error, sizeof error), -1);
    assert_null(told_writer_open_triangles(scratch_path(FRAMES), NULL, beyond, 1, error, sizeof error));
    assert_non_null(strstr(error, "out of range"));
}

TEST(triangles_are_checked)
{
    static const scratch_change changes[] = {
        {8, 1, 0, "a file of spheres says 2 triangles"},
        {16, 3, 0, "4294967295"}, /* the first frame is read as a triangle: see below */
        {16, 13, 0, "the file ends before the last of 13 triangles"},
        {16, 0x80000001, 0, "2147483649 triangles are more than the limit of 2147483648"},
        {20, 2, 0, "the header must end in 0"},
        {24, 4, 0, "frame 0: 4 vertices, but a triangle has vertex 4"},
        {44, 0xffffffff, 0, "triangle 1: vertex 4294967295 is out of range"},
        {44, 0xfffffffe, 0, "frame 0: 4 vertices, but a triangle has vertex 4294967294"},
        {48, 3, 0, "frame 0: 3 vertices, but a triangle has vertex 3"},
        {100, 3, 1, "frame 1: 3 vertices, but a triangle has vertex 3"},
        {100, 4, 2, "data follow the 2 frames"},
        {100, 6, 1, "frame 1: the file ends before the last of 6 vertices"},
        {100, 0x80000001, 1, "frame 1: 2147483649 vertices are more than the limit"},
    };
    unsigned char bytes[MESH_BYTES];
    fill_mesh(bytes);
    scratch_put_u32(bytes, 52, UINT32_MAX); /* a NaN; read as an index it is out of range */
    scratch_expect_errors(bytes, sizeof bytes, changes, sizeof changes / sizeof changes[0]);
}

TEST(meshes_without_anything)
{
    char error[1024] = "";
    const char *path = scratch_path(FRAMES);
    cgt_trajectory_writer *w = told_writer_open_triangles(path, NULL, NULL, 0, error, sizeof error);
    assert_non_null(w);
    assert_int_equal(told_writer_add_vertices(w, NULL, 0, error, sizeof error), 0);
    assert_int_equal(told_writer_close(w, error, sizeof error), 0);
    const cgt_trajectory_frame f = scratch_read(scratch_open(path, NULL));
    assert_true(f.kind == CGT_TRAJECTORY_TRIANGLES && f.count == 0 && f.triangles == 0);
    assert_true(f.index != NULL && f.position != NULL);
}

TEST(every_truncation_is_noticed)
{
    unsigned char mesh[MESH_BYTES];
    fill_mesh(mesh);
    const struct {
        const unsigned char *bytes;
        size_t size, first_end;
    } files[] = {{two_frames, sizeof two_frames, 32}, {mesh, sizeof mesh, 100}};
    const char *path = scratch_path(FRAMES);
    for (int i = 0; i < 2; i++)
        for (size_t size = 0; size < files[i].size; size++) {
            scratch_fill(path, files[i].bytes, size);
            /* Two empty frames do not fit in less than 32 bytes, which opening detects. */
            scratch_expect_error(path, NULL, size >= files[i].first_end, size < 8 ? "not a .frames file" : "cut off");
        }
}

SUITE(NULL, NULL)

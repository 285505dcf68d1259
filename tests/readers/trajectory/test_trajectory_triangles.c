/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * .frames files of triangles: the bytes, round trips, damaged files. */
#define _GNU_SOURCE
#include "readers/trajectory_scratch.h"

static const char FRAMES[] = ".frames";

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

static void expect_mesh(const trajectory_frame *f, uint32_t count)
{
    assert_int_equal(f->kind, TRAJECTORY_TRIANGLES);
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
    trajectory *t = scratch_open(scratch_bytes(FRAMES, bytes, sizeof bytes), NULL);
    assert_null(trajectory_get_mesh(t));
    for (int pass = 0; pass < 2; pass++) {
        trajectory_frame f = scratch_read(t);
        expect_mesh(&f, 4);
        f = scratch_read(t);
        assert_true(f.number == 1 && f.step == 1);
        expect_mesh(&f, 5);
        scratch_expect_end(t);
        assert_int_equal(trajectory_rewind(t, error, sizeof error), 0);
    }
    assert_int_equal(trajectory_skip(t, error, sizeof error), 1);
    const trajectory_frame f = scratch_read(t);
    expect_mesh(&f, 5);

    const char *path = scratch_path(FRAMES);
    frames_writer *w = frames_writer_open_triangles(path, mesh_index, 2, error, sizeof error);
    assert_non_null(w);
    assert_int_equal(frames_writer_add_vertices(w, f.position, 4, error, sizeof error), 0);
    assert_int_equal(frames_writer_add_vertices(w, f.position, 5, error, sizeof error), 0);
    assert_int_equal(frames_writer_close(w, error, sizeof error), 0);
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
    frames_writer *w = frames_writer_open(scratch_path(FRAMES), error, sizeof error);
    assert_non_null(w);
    assert_int_equal(frames_writer_add_vertices(w, values, 4, error, sizeof error), -1);
    assert_non_null(strstr(error, "cannot hold vertices"));
    assert_int_equal(frames_writer_close(w, error, sizeof error), -1);
    w = frames_writer_open_triangles(scratch_path(FRAMES), mesh_index, 2, error, sizeof error);
    assert_non_null(w);
    assert_int_equal(frames_writer_add(w, values, 4, error, sizeof error), -1);
    assert_non_null(strstr(error, "cannot hold spheres"));
    assert_int_equal(frames_writer_close(w, error, sizeof error), -1);
    w = frames_writer_open_triangles(scratch_path(FRAMES), mesh_index, 2, error, sizeof error);
    assert_non_null(w);
    assert_int_equal(frames_writer_add_vertices(w, values, 3, error, sizeof error), -1);
    assert_non_null(strstr(error, "fewer vertices"));
    assert_int_equal(frames_writer_close(w, error, sizeof error), -1);
    assert_null(frames_writer_open_triangles(scratch_path(FRAMES), beyond, 1, error, sizeof error));
    assert_non_null(strstr(error, "out of range"));
}

TEST(triangles_are_checked)
{
    static const scratch_change changes[] = {
        {8, 1, 0, "a file of spheres says 2 triangles"},
        {16, 3, 0, "4294967295"}, /* the first frame is read as a triangle: see below */
        {16, 13, 0, "the file ends before the last of 13 triangles"},
        {16, 0x80000001, 0, "2147483649 triangles are more than the limit of 2147483648"},
        {20, 1, 0, "the header must end in zeros"},
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

TEST(every_truncation_of_triangles_is_noticed)
{
    unsigned char bytes[MESH_BYTES];
    fill_mesh(bytes);
    const char *path = scratch_path(FRAMES);
    for (size_t size = 0; size < sizeof bytes; size++) {
        scratch_fill(path, bytes, size);
        /* The first frame ends at byte 100. */
        scratch_expect_error(path, NULL, size >= 100, size < 8 ? "not a .frames file" : "cut off");
    }
}

TEST(meshes_without_anything)
{
    char error[1024] = "";
    const char *path = scratch_path(FRAMES);
    frames_writer *w = frames_writer_open_triangles(path, NULL, 0, error, sizeof error);
    assert_non_null(w);
    assert_int_equal(frames_writer_add_vertices(w, NULL, 0, error, sizeof error), 0);
    assert_int_equal(frames_writer_close(w, error, sizeof error), 0);
    const trajectory_frame f = scratch_read(scratch_open(path, NULL));
    assert_true(f.kind == TRAJECTORY_TRIANGLES && f.count == 0 && f.triangles == 0);
    assert_true(f.index != NULL && f.position != NULL);
}

SUITE(NULL, NULL)

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reads .frames. Numbers are assembled byte by byte, so that the machine's byte order does not matter; compilers remove
 * this on little-endian machines. Counts are checked against the file before memory is allocated. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include "trajectory/trajectory_internal.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define HEADER_BYTES 24u
#define ORIGIN_BYTES 24u
#define TRIANGLE_BYTES 12u
#define CHUNK 65536u /* spheres, vertices, triangles read at a time */

typedef struct frames_state {
    cgt_trajectory_kind kind;
    uint32_t frames;     /* in the file */
    uint64_t bytes_read; /* bytes read */
    double origin[3];    /* to be added to the places */
    /* Files of triangles. */
    uint32_t triangles;
    uint32_t needed; /* vertices that the index refers to: its largest number plus one */
    size_t index_capacity, vertex_capacity;
    uint32_t *index;
    float *position;
} frames_state;

/* The items of a frame. */
typedef struct frames_item {
    cgt_trajectory_kind kind;
    uint32_t floats; /* each */
    const char *name;
} frames_item;

static const frames_item item_spheres = {CGT_TRAJECTORY_SPHERES, 4, "spheres"};
static const frames_item item_vertices = {CGT_TRAJECTORY_TRIANGLES, 3, "vertices"};

static uint32_t u32_from_bytes(const unsigned char *b)
{
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

/* Converts little-endian bytes to the machine's 32-bit numbers, in place. */
static void to_host(void *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        unsigned char *const bytes = (unsigned char *)values + 4 * i;
        const uint32_t bits = u32_from_bytes(bytes);
        memcpy(bytes, &bits, 4);
    }
}

/* Reads bytes that must exist; section: "count". */
static int read_bytes(cgt_trajectory *t, void *bytes, size_t size, const char *section)
{
    frames_state *const s = t->state;
    errno = 0;
    if (fread(bytes, 1, size, t->file) != size) {
        if (ferror(t->file))
            return trajectory_fail(t, 0, "%s", *t->input.error ? t->input.error : strerror(errno != 0 ? errno : EIO));
        return trajectory_fail(t, 0, "frame %" PRIu64 ": the file ends in the %s: it is cut off", t->next, section);
    }
    s->bytes_read += size;
    return 1;
}

/* ---- Header and index --------------------------------------------------------------------------------------- */

static const frames_item *item_of(const cgt_trajectory *t)
{
    const frames_state *const s = t->state;
    return s->kind == CGT_TRAJECTORY_SPHERES ? &item_spheres : &item_vertices;
}

/* Before memory is allocated: the triangles must fit into the file and the limit. */
static int check_triangles(cgt_trajectory *t, uint32_t triangles)
{
    const frames_state *const s = t->state;
    if (triangles > t->options.max_count)
        return trajectory_fail(t, 0, "%" PRIu32 " triangles are more than the limit of %" PRIu64, triangles,
                               t->options.max_count);
    if (t->regular && triangles > (t->file_size - s->bytes_read) / TRIANGLE_BYTES)
        return trajectory_fail(t, 0, "the file ends before the last of %" PRIu32 " triangles: it is cut off",
                               triangles);
    return 1;
}

static int check_kind(cgt_trajectory *t, const unsigned char *header)
{
    frames_state *const s = t->state;
    const uint32_t kind = u32_from_bytes(header + 8);
    const uint32_t triangles = u32_from_bytes(header + 16);
    if (kind != CGT_TRAJECTORY_SPHERES && kind != CGT_TRAJECTORY_TRIANGLES)
        return trajectory_fail(t, 0, "kind %" PRIu32 " is neither spheres (1) nor triangles (2)", kind);
    if (u32_from_bytes(header + 20) > 1)
        return trajectory_fail(t, 0, "the header must end in 0, or in 1 where an origin follows");
    if (kind == CGT_TRAJECTORY_SPHERES && triangles != 0)
        return trajectory_fail(t, 0, "the header of a file of spheres says %" PRIu32 " triangles", triangles);
    s->kind = (cgt_trajectory_kind)kind;
    s->triangles = triangles;
    return 1;
}

/* The origin of the file is that of the frames, unless the options name another one. */
static int read_origin(cgt_trajectory *t, int has_origin)
{
    frames_state *const s = t->state;
    unsigned char bytes[ORIGIN_BYTES];
    memset(s->origin, 0, sizeof s->origin);
    if (has_origin && t->regular && t->file_size - s->bytes_read < ORIGIN_BYTES)
        return trajectory_fail(t, 0, "the file ends in the header: it is cut off");
    if (has_origin && read_bytes(t, bytes, sizeof bytes, "origin") < 0)
        return -1;
    for (int axis = 0; axis < 3 && has_origin; axis++) {
        const uint64_t bits = u32_from_bytes(bytes + 8 * axis) | (uint64_t)u32_from_bytes(bytes + 8 * axis + 4) << 32;
        memcpy(&s->origin[axis], &bits, sizeof bits);
        if (!isfinite(s->origin[axis]))
            return trajectory_fail(t, 0, "the origin in the header is not finite");
    }
    if (!t->options.has_origin)
        trajectory_take_origin(t, s->origin);
    return 1;
}

static int check_frames(cgt_trajectory *t)
{
    const frames_state *const s = t->state;
    if (!t->regular)
        return 1;
    const uint64_t remaining = t->file_size - s->bytes_read;
    if (s->frames == 0 && remaining > 0)
        return trajectory_fail(t, 0, "the header says 0 frames, but data follow: the file was not finished");
    if ((uint64_t)s->frames * 4 > remaining)
        return trajectory_fail(t, 0, "%" PRIu32 " frames cannot lie in %" PRIu64 " bytes: the file is cut off",
                               s->frames, remaining);
    return 1;
}

static int reserve_index(cgt_trajectory *t, size_t triangles)
{
    frames_state *const s = t->state;
    if (triangles > s->index_capacity || s->index == NULL) {
        size_t capacity = 2 * s->index_capacity < triangles ? triangles : 2 * s->index_capacity;
        capacity = capacity > 0 ? capacity : 1;
        if (trajectory_grow(&s->index, capacity, TRIANGLE_BYTES))
            return trajectory_fail(t, 0, "not enough memory for %zu triangles", capacity);
        s->index_capacity = capacity;
    }
    return 1;
}

/* Reads the index. Each number must be a vertex of every frame; `needed` keeps the largest for that check. */
static int read_index(cgt_trajectory *t)
{
    frames_state *const s = t->state;
    s->needed = 0;
    if (reserve_index(t, 0) < 0)
        return -1;
    for (uint32_t done = 0; done < s->triangles;) {
        const uint32_t part = s->triangles - done < CHUNK ? s->triangles - done : CHUNK;
        if (reserve_index(t, (size_t)done + part) < 0)
            return -1;
        uint32_t *const index = s->index + 3 * (size_t)done;
        if (read_bytes(t, index, (size_t)part * TRIANGLE_BYTES, "index") < 0)
            return -1;
        to_host(index, 3 * (size_t)part);
        for (size_t i = 0; i < 3 * (size_t)part; i++) {
            if (index[i] == UINT32_MAX)
                return trajectory_fail(t, 0, "triangle %zu: vertex 4294967295 is out of range", done + i / 3);
            s->needed = index[i] >= s->needed ? index[i] + 1 : s->needed;
        }
        done += part;
    }
    return 1;
}

static int frames_begin(cgt_trajectory *t)
{
    unsigned char header[HEADER_BYTES];
    frames_state *const s = t->state;
    s->bytes_read = 0;
    s->needed = 0;
    errno = 0;
    const size_t status = fread(header, 1, sizeof header, t->file);
    if (ferror(t->file))
        return trajectory_fail(t, 0, "%s", *t->input.error ? t->input.error : strerror(errno != 0 ? errno : EIO));
    if (status < 8 || memcmp(header, "CGTFRAM1", 8) != 0)
        return trajectory_fail(t, 0, "not a .frames file: it does not begin with CGTFRAM1");
    if (status < sizeof header || (t->regular && t->file_size < HEADER_BYTES))
        return trajectory_fail(t, 0, "the file ends in the header: it is cut off");
    s->bytes_read = HEADER_BYTES;
    s->frames = u32_from_bytes(header + 12);
    if (check_kind(t, header) < 0 || read_origin(t, u32_from_bytes(header + 20) == 1) < 0 ||
        check_triangles(t, s->triangles) < 0 || (s->kind == CGT_TRAJECTORY_TRIANGLES && read_index(t) < 0))
        return -1;
    return check_frames(t);
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

/* Reads a frame's count: 1, 0 after the last frame, -1. */
static int read_count(cgt_trajectory *t, uint32_t *count)
{
    frames_state *const s = t->state;
    if (t->next == s->frames) {
        if (fgetc(t->file) != EOF)
            return trajectory_fail(t, 0, "data follow the %" PRIu32 " frames that the header says", s->frames);
        return 0;
    }
    unsigned char bytes[4];
    if (read_bytes(t, bytes, sizeof bytes, "count") < 0)
        return -1;
    *count = u32_from_bytes(bytes);
    const frames_item *const item = item_of(t);
    if (*count > t->options.max_count)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": %" PRIu32 " %s are more than the limit of %" PRIu64, t->next,
                               *count, item->name, t->options.max_count);
    if (*count < s->needed)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": %" PRIu32 " vertices, but a triangle has vertex %" PRIu32,
                               t->next, *count, s->needed - 1);
    if (t->regular && (s->bytes_read > t->file_size || *count > (t->file_size - s->bytes_read) / (4 * item->floats)))
        return trajectory_fail(t, 0,
                               "frame %" PRIu64 ": the file ends before the last of %" PRIu32 " %s: it is cut off",
                               t->next, *count, item->name);
    return 1;
}

/* Makes room as trajectory_reserve does, for spheres or vertices. */
static int reserve_items(cgt_trajectory *t, size_t count, size_t expected)
{
    frames_state *const s = t->state;
    if (s->kind == CGT_TRAJECTORY_SPHERES)
        return trajectory_reserve(t, count, expected);
    if (count > s->vertex_capacity || s->position == NULL) {
        size_t capacity = 2 * s->vertex_capacity > expected ? expected : 2 * s->vertex_capacity;
        capacity = capacity < count ? count : capacity;
        capacity = capacity > 0 ? capacity : 1;
        if (trajectory_grow(&s->position, capacity, 3 * sizeof *s->position))
            return trajectory_fail(t, 0, "not enough memory for %zu vertices", capacity);
        s->vertex_capacity = capacity;
    }
    return 1;
}

/* From the file's origin to that of the frames; the same one leaves all bits as they are. */
static void move_items(const cgt_trajectory *t, float *values, size_t floats, size_t count)
{
    const frames_state *const s = t->state;
    for (size_t axis = 0; axis < 3; axis++)
        for (size_t i = 0; i < count && s->origin[axis] != t->origin[axis]; i++)
            values[floats * i + axis] = trajectory_place(t, axis, (double)values[floats * i + axis] + s->origin[axis]);
}

static int frames_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    frames_state *const s = t->state;
    const frames_item *const item = item_of(t);
    uint32_t count = 0;
    const int status = read_count(t, &count);
    if (status <= 0)
        return status;
    if (reserve_items(t, 0, count) < 0)
        return -1;
    for (uint32_t done = 0; done < count;) {
        const uint32_t part = count - done < CHUNK ? count - done : CHUNK;
        if (reserve_items(t, (size_t)done + part, count) < 0)
            return -1;
        float *const array = item->kind == CGT_TRAJECTORY_SPHERES ? t->store.xyzr : s->position;
        float *const values = array + (size_t)item->floats * done;
        if (read_bytes(t, values, (size_t)part * item->floats * 4, item->name) < 0)
            return -1;
        to_host(values, (size_t)part * item->floats);
        move_items(t, values, item->floats, part);
        done += part;
    }
    if (item->kind == CGT_TRAJECTORY_SPHERES) {
        trajectory_frame_fill(t, frame, count);
        frame->has_radius = 1;
        return 1;
    }
    trajectory_frame_fill_triangles(t, frame, count, s->triangles);
    frame->index = s->index;
    frame->position = s->position;
    return 1;
}

static int frames_skip(cgt_trajectory *t)
{
    frames_state *const s = t->state;
    if (!t->regular) {
        cgt_trajectory_frame frame;
        return frames_read(t, &frame);
    }
    uint32_t count = 0;
    const int status = read_count(t, &count);
    if (status <= 0)
        return status;
    const uint64_t bytes = (uint64_t)count * item_of(t)->floats * 4;
    if (fseeko(t->file, (off_t)bytes, SEEK_CUR) != 0)
        return trajectory_fail(t, 0, "%s", strerror(errno));
    s->bytes_read += bytes;
    return 1;
}

static void frames_end(cgt_trajectory *t)
{
    frames_state *const s = t->state;
    free(s->index);
    free(s->position);
}

const trajectory_format trajectory_format_frames = {
    .is_binary = 1,
    .state_size = sizeof(frames_state),
    .keeps_state = 1,
    .begin = frames_begin,
    .read = frames_read,
    .skip = frames_skip,
    .end = frames_end,
};

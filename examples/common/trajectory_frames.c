/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reading .frames. Bytes become numbers one by one, so that the machine's byte order does not matter; compilers see
 * through it where it is the file's own. Counts are checked against the file before any memory is asked for. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include "trajectory_internal.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>

#define HEADER_BYTES 24u
#define SPHERE_BYTES 16u
#define CHUNK 65536u /* spheres read at a time */

typedef struct frames_state {
    uint32_t frames; /* in the file */
    uint64_t at;     /* bytes read */
} frames_state;

static uint32_t u32_from_bytes(const unsigned char *b)
{
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

/* Turns little-endian bytes into the machine's numbers, in place. */
static void to_host(float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        unsigned char bytes[4];
        memcpy(bytes, values + i, 4);
        const uint32_t bits = u32_from_bytes(bytes);
        memcpy(values + i, &bits, 4);
    }
}

/* Reads bytes that must be there. */
static int read_bytes(trajectory *t, void *bytes, size_t size, const char *where)
{
    frames_state *const s = t->state;
    errno = 0;
    if (fread(bytes, 1, size, t->file) != size) {
        if (ferror(t->file)) {
            return trajectory_fail(t, 0, "%s", strerror(errno != 0 ? errno : EIO));
        }
        return trajectory_fail(t, 0, "frame %" PRIu64 ": the file ends in the %s: it is cut off", t->next, where);
    }
    s->at += size;
    return 1;
}

static int check_header(trajectory *t, const unsigned char *header)
{
    frames_state *const s = t->state;
    const uint32_t kind = u32_from_bytes(header + 8);
    s->frames = u32_from_bytes(header + 12);
    if (kind == 2) {
        return trajectory_fail(t, 0, "a file of triangles: triangles are not supported here");
    }
    if (kind != 1) {
        return trajectory_fail(t, 0, "kind %" PRIu32 " is neither spheres (1) nor triangles (2)", kind);
    }
    if (u32_from_bytes(header + 16) != 0 || u32_from_bytes(header + 20) != 0) {
        return trajectory_fail(t, 0, "the header of a file of spheres must end in zeros");
    }
    if (!t->regular) {
        return 1;
    }
    const uint64_t rest = t->file_size - HEADER_BYTES;
    if (s->frames == 0 && rest > 0) {
        return trajectory_fail(t, 0, "the header says 0 frames, but data follow: the file was not finished");
    }
    if ((uint64_t)s->frames * 4 > rest) {
        return trajectory_fail(t, 0, "%" PRIu32 " frames cannot lie in %" PRIu64 " bytes: the file is cut off",
                               s->frames, rest);
    }
    return 1;
}

static int frames_begin(trajectory *t)
{
    unsigned char header[HEADER_BYTES];
    frames_state *const s = t->state;
    s->at = 0;
    errno = 0;
    const size_t got = fread(header, 1, sizeof header, t->file);
    if (ferror(t->file)) {
        return trajectory_fail(t, 0, "%s", strerror(errno != 0 ? errno : EIO));
    }
    if (got < 8 || memcmp(header, "CGTFRAM1", 8) != 0) {
        return trajectory_fail(t, 0, "not a .frames file: it does not begin with CGTFRAM1");
    }
    if (got < sizeof header || (t->regular && t->file_size < HEADER_BYTES)) {
        return trajectory_fail(t, 0, "the file ends in the header: it is cut off");
    }
    s->at = HEADER_BYTES;
    return check_header(t, header);
}

/* Reads a frame's count: 1, 0 after the last frame, -1. */
static int read_count(trajectory *t, uint32_t *count)
{
    frames_state *const s = t->state;
    if (t->next == s->frames) {
        if (fgetc(t->file) != EOF) {
            return trajectory_fail(t, 0, "data follow the %" PRIu32 " frames that the header says", s->frames);
        }
        return 0;
    }
    unsigned char bytes[4];
    if (read_bytes(t, bytes, sizeof bytes, "count") < 0) {
        return -1;
    }
    *count = u32_from_bytes(bytes);
    if (*count > t->options.max_count) {
        return trajectory_fail(t, 0, "frame %" PRIu64 ": %" PRIu32 " spheres are more than the limit of %" PRIu64,
                               t->next, *count, t->options.max_count);
    }
    if (t->regular && (s->at > t->file_size || *count > (t->file_size - s->at) / SPHERE_BYTES)) {
        return trajectory_fail(t, 0,
                               "frame %" PRIu64 ": the file ends before the last of %" PRIu32 " spheres: it is cut off",
                               t->next, *count);
    }
    return 1;
}

static int frames_read(trajectory *t, trajectory_frame *frame)
{
    uint32_t count = 0;
    const int got = read_count(t, &count);
    if (got <= 0) {
        return got;
    }
    if (trajectory_reserve(t, 0, count) < 0) {
        return -1;
    }
    for (uint32_t done = 0; done < count;) {
        const uint32_t part = count - done < CHUNK ? count - done : CHUNK;
        if (trajectory_reserve(t, (size_t)done + part, count) < 0) {
            return -1;
        }
        float *const values = t->store.xyzr + 4 * (size_t)done;
        if (read_bytes(t, values, (size_t)part * SPHERE_BYTES, "spheres") < 0) {
            return -1;
        }
        to_host(values, 4 * (size_t)part);
        done += part;
    }
    trajectory_frame_fill(t, frame, count);
    return 1;
}

static int frames_skip(trajectory *t)
{
    frames_state *const s = t->state;
    if (!t->regular) {
        trajectory_frame frame;
        return frames_read(t, &frame);
    }
    uint32_t count = 0;
    const int got = read_count(t, &count);
    if (got <= 0) {
        return got;
    }
    const uint64_t bytes = (uint64_t)count * SPHERE_BYTES;
    if (fseeko(t->file, (off_t)bytes, SEEK_CUR) != 0) {
        return trajectory_fail(t, 0, "%s", strerror(errno));
    }
    s->at += bytes;
    return 1;
}

static void frames_end(trajectory *t) { (void)t; }

static const char *const endings[] = {".frames", NULL};

const trajectory_format trajectory_format_frames = {
    .endings = endings,
    .state_size = sizeof(frames_state),
    .begin = frames_begin,
    .read = frames_read,
    .skip = frames_skip,
    .end = frames_end,
};

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reading binary files. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include "trajectory/binary/binary_reader.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>

#define BLOCK 16384u /* bytes on the stack, for what is converted or skipped */

void binary_begin(binary_reader *b, cgt_trajectory *t, int is_big)
{
    b->t = t;
    b->is_big = is_big;
    b->read = 0;
}

/* ---- Bytes -------------------------------------------------------------------------------------------------- */

static int fail_cut(binary_reader *b, const char *name)
{
    return trajectory_fail(b->t, 0, "frame %" PRIu64 ": the file ends in %s: it is cut off", b->t->next, name);
}

int binary_bytes_or_end(binary_reader *b, void *bytes, size_t size, const char *name)
{
    cgt_trajectory *const t = b->t;
    errno = 0;
    const size_t got = fread(bytes, 1, size, t->file);
    b->read += got;
    if (got == size)
        return 1;
    if (ferror(t->file))
        return trajectory_fail(t, 0, "%s", *t->input.error ? t->input.error : strerror(errno != 0 ? errno : EIO));
    return got == 0 ? 0 : fail_cut(b, name);
}

int binary_bytes(binary_reader *b, void *bytes, size_t size, const char *name)
{
    const int status = binary_bytes_or_end(b, bytes, size, name);
    return status == 0 ? fail_cut(b, name) : status;
}

int binary_blob(binary_reader *b, unsigned char **bytes, size_t *capacity, size_t size, const char *name)
{
    size_t done = 0;
    while (done < size) {
        const size_t part = size - done < ((size_t)1 << 20) ? size - done : (size_t)1 << 20;
        if (*capacity - done < part) {
            const size_t twice = 2 * *capacity < size ? 2 * *capacity : size;
            const size_t larger = twice > done + part ? twice : done + part;
            if (trajectory_grow(bytes, larger, 1))
                return trajectory_fail(b->t, 0, "not enough memory for %s", name);
            *capacity = larger;
        }
        if (binary_bytes(b, *bytes + done, part, name) < 0)
            return -1;
        done += part;
    }
    return 1;
}

int binary_expect(binary_reader *b, uint64_t size, const char *name)
{
    const cgt_trajectory *const t = b->t;
    if (t->regular && (b->read > t->file_size || size > t->file_size - b->read))
        return fail_cut(b, name);
    return 1;
}

int binary_skip(binary_reader *b, uint64_t size, const char *name)
{
    unsigned char block[BLOCK];
    if (binary_expect(b, size, name) < 0)
        return -1;
    if (b->t->regular && size > BLOCK) {
        if (fseeko(b->t->file, (off_t)size, SEEK_CUR) != 0)
            return trajectory_fail(b->t, 0, "%s", strerror(errno));
        b->read += size;
        return 1;
    }
    while (size > 0) {
        const size_t part = size < BLOCK ? (size_t)size : BLOCK;
        if (binary_bytes(b, block, part, name) < 0)
            return -1;
        size -= part;
    }
    return 1;
}

/* ---- Numbers ------------------------------------------------------------------------------------------------ */

uint32_t binary_get_u32(const unsigned char *bytes, int is_big)
{
    const uint32_t b0 = bytes[0], b1 = bytes[1], b2 = bytes[2], b3 = bytes[3];
    return is_big ? b0 << 24 | b1 << 16 | b2 << 8 | b3 : b3 << 24 | b2 << 16 | b1 << 8 | b0;
}

uint64_t binary_get_u64(const unsigned char *bytes, int is_big)
{
    const uint64_t first = binary_get_u32(bytes, is_big), second = binary_get_u32(bytes + 4, is_big);
    return is_big ? first << 32 | second : second << 32 | first;
}

float binary_get_f32(const unsigned char *bytes, int is_big)
{
    const uint32_t bits = binary_get_u32(bytes, is_big);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

double binary_get_f64(const unsigned char *bytes, int is_big)
{
    const uint64_t bits = binary_get_u64(bytes, is_big);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

int binary_u32(binary_reader *b, uint32_t *value, const char *name)
{
    unsigned char bytes[4] = {0};
    if (binary_bytes(b, bytes, sizeof bytes, name) < 0)
        return -1;
    *value = binary_get_u32(bytes, b->is_big);
    return 1;
}

int binary_i32(binary_reader *b, int32_t *value, const char *name)
{
    uint32_t bits;
    if (binary_u32(b, &bits, name) < 0)
        return -1;
    memcpy(value, &bits, sizeof *value);
    return 1;
}

int binary_u64(binary_reader *b, uint64_t *value, const char *name)
{
    unsigned char bytes[8] = {0};
    if (binary_bytes(b, bytes, sizeof bytes, name) < 0)
        return -1;
    *value = binary_get_u64(bytes, b->is_big);
    return 1;
}

int binary_f64(binary_reader *b, double *value, const char *name)
{
    uint64_t bits;
    if (binary_u64(b, &bits, name) < 0)
        return -1;
    memcpy(value, &bits, sizeof *value);
    return 1;
}

int binary_reals(binary_reader *b, double *values, size_t count, int is_double, const char *name)
{
    unsigned char block[BLOCK];
    const size_t bytes = is_double ? 8 : 4;
    for (size_t done = 0; done < count;) {
        const size_t part = count - done < BLOCK / bytes ? count - done : BLOCK / bytes;
        if (binary_bytes(b, block, part * bytes, name) < 0)
            return -1;
        for (size_t i = 0; i < part; i++) {
            const unsigned char *const from = block + bytes * i;
            values[done + i] = is_double ? binary_get_f64(from, b->is_big) : (double)binary_get_f32(from, b->is_big);
        }
        done += part;
    }
    return 1;
}

int binary_check_count(binary_reader *b, uint64_t count)
{
    cgt_trajectory *const t = b->t;
    if (count > t->options.max_count)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": %" PRIu64 " spheres are more than the limit of %" PRIu64,
                               t->next, count, t->options.max_count);
    return 1;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bytes of a file, a pipe or standard input, decompressed where they need it, for readers that know only FILE. */
#ifndef TRAJECTORY_INPUT_H
#define TRAJECTORY_INPUT_H

#include <stdint.h>
#include <stdio.h>

#include <cgt/trajectory.h>

struct archive;

#define INPUT_HEAD 6      /* bytes that tell how a file is compressed */
#define INPUT_BLOCK 65536 /* bytes given to the decompressor at a time */

/* A small file that becomes very large is more likely to be meant as an attack than a run. */
#define INPUT_MOST_TIMES 500u
#define INPUT_BLOWN_UP "more than 1 GiB and %u times its size; --no-limit reads it"

typedef struct trajectory_input {
    FILE *stream;       /* what readers read; NULL: not open, or not plain where the system has no such streams */
    int plain;          /* a regular file as it is: stream can seek, and its size is known */
    int can_rewind;     /* trajectory_input_rewind works */
    uint64_t file_size; /* bytes of a regular file, compressed or not; 0 for others */
    double follow;      /* seconds to wait for more at the end; 0: none */
    bool (*stop)(const void *user); /* as of the options */
    const void *stop_user;
    char error[256]; /* why the last read failed where errno does not tell; "" for none */

    int no_limit; /* as of the options */

    /* own */
    int descriptor;
    int is_regular;
    unsigned char head[INPUT_HEAD];
    size_t head_size, head_at;
    struct archive *archive; /* NULL: not compressed, or not begun */
    int is_compressed;
    uint64_t packed, unpacked; /* bytes so far */
    char *peeked;              /* the first bytes, which were read before their turn */
    size_t peeked_size, peeked_at;
    unsigned char *block;
    FILE *spool;       /* keeps what a pipe delivers; NULL: does not */
    uint64_t spooled;  /* bytes in it */
    uint64_t replayed; /* of them, since the last rewinding */
} trajectory_input;

/* Opens a path, "-" for standard input. follow: at the end wait so many seconds for more, 0: do not; in place of that
 * of the options. The input must stay where it is. Returns 0, or -1 with a sentence. */
int trajectory_input_open(trajectory_input *in, const char *path, double follow, const cgt_trajectory_options *options,
                          char *error, size_t error_size);

/* Reads the first bytes, at most `size` and less where the input ends, and leaves them where they are. Call it once,
 * before all reading. Returns how many, or -1: *in has the reason, or errno. */
long trajectory_input_peek(trajectory_input *in, char *bytes, size_t size);

/* Reads what there is now from an input that is not plain, as read(2) does; do not read stream, too. */
long trajectory_input_read(void *input, char *bytes, size_t size);

/* Whether so many bytes, made of those that were read, are more than a file may become: INPUT_BLOWN_UP. */
int trajectory_input_is_blown_up(uint64_t read, uint64_t made);

/* Whether a path is that of an input, or of what lies in its folder and those below: no path from the root, no parent
 * folder. What a file names may lie nowhere else. */
int trajectory_input_is_beside(const char *input, const char *path);

/* Goes back to the first byte: 0, or -1 with a sentence. stream may be another one afterwards. */
int trajectory_input_rewind(trajectory_input *in, char *error, size_t error_size);

/* The share of a regular file that was read, 0 to 1; buffered: bytes that were read and are not used yet. -1:
 * unknown. */
double trajectory_input_progress(const trajectory_input *in, uint64_t buffered);

void trajectory_input_close(trajectory_input *in);

/* The length of a path without an ending such as .gz that tells of compression. */
size_t trajectory_input_bare_length(const char *path);

#endif

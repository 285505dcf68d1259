/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bytes and numbers of binary files, in either byte order, assembled byte by byte. What is read is told by a name, for
 * the message where the file ends in it. Streams are read forwards only, so that pipes and compressed files serve. */
#ifndef BINARY_READER_H
#define BINARY_READER_H

#include "trajectory/trajectory_internal.h"

typedef struct binary_reader {
    cgt_trajectory *t;
    int is_big;    /* the file's byte order: 1 big-endian, 0 little-endian */
    uint64_t read; /* bytes read from the file */
} binary_reader;

void binary_begin(binary_reader *b, cgt_trajectory *t, int is_big);

/* Reads bytes that must exist; name: "the header". Returns 1 or -1. */
int binary_bytes(binary_reader *b, void *bytes, size_t size, const char *name);

/* The same where the file may end before the first of them: then 0. */
int binary_bytes_or_end(binary_reader *b, void *bytes, size_t size, const char *name);

/* The same to an array of *capacity bytes, which grows as bytes are read, whatever the file claims. */
int binary_blob(binary_reader *b, unsigned char **bytes, size_t *capacity, size_t size, const char *name);

/* Skips bytes that must exist. Returns 1 or -1. */
int binary_skip(binary_reader *b, uint64_t size, const char *name);

/* Returns 1 where the file may have so many more bytes, or -1: it is cut off. Call it before memory is allocated for
 * them; of a pipe nothing is known. */
int binary_expect(binary_reader *b, uint64_t size, const char *name);

/* A number that must exist. Returns 1 or -1. */
int binary_u32(binary_reader *b, uint32_t *value, const char *name);
int binary_i32(binary_reader *b, int32_t *value, const char *name);
int binary_u64(binary_reader *b, uint64_t *value, const char *name);
int binary_f64(binary_reader *b, double *value, const char *name);

/* Reads `count` floats, or doubles, to `values`. Returns 1 or -1. */
int binary_reals(binary_reader *b, double *values, size_t count, int is_double, const char *name);

/* Numbers in memory. */
uint32_t binary_get_u32(const unsigned char *bytes, int is_big);
uint64_t binary_get_u64(const unsigned char *bytes, int is_big);
float binary_get_f32(const unsigned char *bytes, int is_big);
double binary_get_f64(const unsigned char *bytes, int is_big);

/* A frame's count, checked against the options. Returns 1 or -1. */
int binary_check_count(binary_reader *b, uint64_t count);

#endif

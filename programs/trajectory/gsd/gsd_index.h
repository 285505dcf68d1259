/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The file layer of GSD (version 1 and 2): a header that tells where an index and a list of names are; an entry of the
 * index for each array of a frame: its name, numbers, and place. The index may lie anywhere, so the file has to be a
 * regular one. */
#ifndef GSD_INDEX_H
#define GSD_INDEX_H

#include "trajectory/binary/binary_reader.h"

/* Names that are asked for in each frame. */
typedef enum gsd_known {
    GSD_STEP,
    GSD_BOX,
    GSD_COUNT,
    GSD_POSITION,
    GSD_TYPES,
    GSD_SHAPES,
    GSD_BONDS,
    GSD_BOND_PAIRS,
    GSD_KNOWN
} gsd_known;

typedef struct gsd_entry {
    uint64_t frame, rows, place;
    uint32_t columns;
    uint32_t name; /* number in the list */
    int type;
} gsd_entry;

/* The first member of the format's state. */
typedef struct gsd_index {
    binary_reader in;
    unsigned char *index, *name_bytes;
    size_t index_capacity, name_capacity;
    const char **name;
    uint32_t names;
    uint32_t known[GSD_KNOWN]; /* numbers of names */
    uint32_t *particle;        /* those of arrays of particles */
    uint32_t particles;
    uint64_t *first, *here;        /* of each name: 1 + its first entry in frame 0, in this frame; 0: none */
    uint64_t here_begin, here_end; /* entries of this frame */
    uint64_t entries, frames, at;  /* at: the next frame of this file */
} gsd_index;

/* Name for messages. */
extern const char gsd_chunk[];

/* Reads header, names and index. Returns 1 or -1. */
int gsd_begin(cgt_trajectory *t);
void gsd_index_free(gsd_index *s);

/* Notes the entries of the next frame, so that each name is found at once, whatever the number of names. */
void gsd_enter_frame(gsd_index *s);

/* Finds the array of a name in this frame, else in frame 0: 1 or 0. */
int gsd_find_number(const gsd_index *s, uint32_t name, gsd_entry *e);
int gsd_find(const gsd_index *s, gsd_known name, gsd_entry *e);

/* Whether any frame of the file has this array. */
int gsd_has(const gsd_index *s, gsd_known name);

/* Goes to an array, all of which has to lie in the file. Returns 1 or -1. */
int gsd_go_to(cgt_trajectory *t, const gsd_entry *e);

/* Bytes of a value, and the value. */
size_t gsd_size_of(int type);
double gsd_value_of(int type, const unsigned char *bytes);

/* What frames lack is read from frame 0 for each of them, so a small file may be a large run: whether it is too large
 * to be meant with so many bytes from each frame so far. It must not depend on which of them were read. Returns 1 or
 * -1. */
int gsd_check_growth(cgt_trajectory *t, uint64_t bytes);

#endif

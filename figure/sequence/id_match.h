/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Finds the spheres of a frame among those of the frame before: by ids, or by their places in the arrays where a file
 * has no ids. */
#ifndef ID_MATCH_H
#define ID_MATCH_H

#include <stddef.h>
#include <stdint.h>

/* All zero at first: there is no frame before. */
typedef struct id_match {
    uint32_t *id; /* of the frame before; unused where it has none */
    uint32_t count, capacity;
    int has_id;
    uint32_t *slots;   /* index + 1 of a sphere, by a hash of its id; 0 is free */
    size_t slot_count; /* a power of two, at least twice count */
    int slots_valid;
    int is_same; /* after cgt_id_match_prepare: this frame has the same spheres in the same order */
} id_match;

/* Makes these `count` spheres those of the frame before; id NULL: they have none. Returns 0, or -1 where there is no
 * memory, as the next. */
int cgt_id_match_remember(id_match *m, const uint32_t *id, uint32_t count);

/* To be called once for a frame before its spheres are sought: makes a table where the order of ids has changed. */
int cgt_id_match_prepare(id_match *m, const uint32_t *id, uint32_t count);

/* The index of sphere i, of `count` with these ids, in the frame before; UINT32_MAX where it has none. Spheres without
 * ids may be added at the end, but where there are fewer than before nothing is known. */
uint32_t cgt_id_match_search(const id_match *m, const uint32_t *id, uint32_t count, uint32_t i);
static inline uint32_t id_match_find(const id_match *m, const uint32_t *id, uint32_t count, uint32_t i)
{
    return id && m->has_id && i < m->count && m->id[i] == id[i] ? i : cgt_id_match_search(m, id, count, i);
}

void cgt_id_match_free(id_match *m);

#endif

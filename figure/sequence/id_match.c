/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Spheres of one frame in the frame before; see id_match.h. A hash table of ids with open addressing is built only
 * where the order has changed. */
#include "sequence/id_match.h"

#include <stdlib.h>
#include <string.h>

/* Grows an array of numbers; its contents stay. */
static int grow(uint32_t **array, size_t count)
{
    uint32_t *grown = count <= SIZE_MAX / sizeof **array ? realloc(*array, count * sizeof **array) : NULL;
    if (!grown)
        return -1;
    *array = grown;
    return 0;
}

int cgt_id_match_remember(id_match *m, const uint32_t *id, uint32_t count)
{
    if (id && count > m->capacity) {
        if (grow(&m->id, count))
            return -1;
        m->capacity = count;
    }
    if (id && count)
        memcpy(m->id, id, count * sizeof *id);
    m->has_id = id != NULL;
    m->count = count;
    m->slots_valid = 0;
    return 0;
}

static size_t slot_of(const id_match *m, uint32_t id)
{
    return (size_t)((id * UINT64_C(0x9E3779B97F4A7C15)) >> 32) & (m->slot_count - 1);
}

/* Enters the ids of the frame before; of equal ids the first counts. */
static int make_slots(id_match *m)
{
    size_t needed = 16;
    while (needed / 2 < m->count)
        needed *= 2;
    if (needed > m->slot_count) {
        if (grow(&m->slots, needed))
            return -1;
        m->slot_count = needed;
    }
    memset(m->slots, 0, m->slot_count * sizeof *m->slots);
    for (uint32_t i = 0; i < m->count; i++) {
        size_t slot = slot_of(m, m->id[i]);
        while (m->slots[slot] && m->id[m->slots[slot] - 1] != m->id[i])
            slot = (slot + 1) & (m->slot_count - 1);
        if (!m->slots[slot])
            m->slots[slot] = i + 1;
    }
    m->slots_valid = 1;
    return 0;
}

int cgt_id_match_prepare(id_match *m, const uint32_t *id, uint32_t count)
{
    m->slots_valid = 0;
    const int moved = id && count && m->has_id && (count > m->count || memcmp(id, m->id, count * sizeof *id) != 0);
    m->is_same = !moved && !id == !m->has_id && count == m->count;
    return moved ? make_slots(m) : 0;
}

uint32_t cgt_id_match_search(const id_match *m, const uint32_t *id, uint32_t count, uint32_t i)
{
    if (!id || !m->has_id)
        return i < m->count && count >= m->count && !id == !m->has_id ? i : UINT32_MAX;
    if (!m->slots_valid)
        return UINT32_MAX;
    for (size_t slot = slot_of(m, id[i]); m->slots[slot]; slot = (slot + 1) & (m->slot_count - 1))
        if (m->id[m->slots[slot] - 1] == id[i])
            return m->slots[slot] - 1;
    return UINT32_MAX;
}

void cgt_id_match_free(id_match *m)
{
    free(m->id);
    free(m->slots);
    memset(m, 0, sizeof *m);
}

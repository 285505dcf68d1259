/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bonds by ids. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/atoms/trajectory_bonds.h"
#include "data/molecule/bond_guess.h"
#include "trajectory/trajectory_internal.h"

#include <inttypes.h>
#include <stdlib.h>

void bond_list_clear(bond_list *b) { b->count = b->keys = 0; }

void bond_list_free(bond_list *b)
{
    free(b->pair);
    free(b->key);
}

int bond_list_add(bond_list *b, uint32_t first, uint32_t second)
{
    if (b->count == b->capacity) {
        const size_t capacity = b->capacity == 0 ? 256 : 2 * b->capacity;
        if (capacity > UINT32_MAX || trajectory_grow(&b->pair, capacity, 2 * sizeof *b->pair))
            return -1;
        b->capacity = capacity;
    }
    b->pair[2 * b->count] = first;
    b->pair[2 * b->count + 1] = second;
    b->count++;
    return 0;
}

/* Of equal ids the first atom counts. */
static int compare_keys(const void *a, const void *b)
{
    const bond_key *const left = a, *const right = b;
    if (left->id != right->id)
        return left->id < right->id ? -1 : 1;
    return (left->index > right->index) - (left->index < right->index);
}

int bond_list_index(cgt_trajectory *t, bond_list *b, uint32_t count)
{
    if (count > b->key_capacity) {
        if (trajectory_grow(&b->key, count, sizeof *b->key))
            return trajectory_fail(t, t->text.line, "not enough memory for the ids of %" PRIu32 " atoms", count);
        b->key_capacity = count;
    }
    int is_sorted = 1;
    for (uint32_t i = 0; i < count; i++) {
        b->key[i] = (bond_key){t->store.id[i], i};
        is_sorted &= i == 0 || b->key[i - 1].id <= b->key[i].id;
    }
    b->keys = count;
    if (!is_sorted)
        qsort(b->key, count, sizeof *b->key, compare_keys);
    return 1;
}

uint32_t bond_list_find(const bond_list *b, uint32_t id)
{
    size_t low = 0, high = b->keys;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (b->key[middle].id < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low < b->keys && b->key[low].id == id ? b->key[low].index : BOND_NONE;
}

/* The smaller index first; files such as .pdb name each bond from both ends. */
static int resolve(cgt_trajectory *t, bond_list *b, int leaves_out)
{
    size_t kept = 0;
    for (size_t i = 0; i < b->count; i++) {
        const uint32_t *const id = b->pair + 2 * i;
        const uint32_t first = bond_list_find(b, id[0]), second = bond_list_find(b, id[1]);
        if (first == BOND_NONE || second == BOND_NONE) {
            if (leaves_out)
                continue;
            return trajectory_fail(t, t->text.line, "a bond to atom %" PRIu32 ", which is not there",
                                   first == BOND_NONE ? id[0] : id[1]);
        }
        if (first != second) {
            b->pair[2 * kept] = first < second ? first : second;
            b->pair[2 * kept + 1] = first < second ? second : first;
            kept++;
        }
    }
    b->count = cgt_sort_bonds(b->pair, kept);
    return 1;
}

/* ---- Of many bonds those of a frame -------------------------------------------------------------------------- */

void bond_list_sort(bond_list *b) { b->count = cgt_sort_bonds(b->pair, b->count); }

/* The first of sorted pairs that is not before this one. */
static size_t find_pair(const uint32_t *pairs, size_t count, uint32_t first, uint32_t second)
{
    const uint32_t wanted[2] = {first, second};
    size_t low = 0, high = count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (cgt_compare_bonds(pairs + 2 * middle, wanted) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The bonds of one atom with a larger id, by its bonds or by the other atoms, whichever are fewer. */
static int select_of(bond_list *b, size_t key, const uint32_t *pairs, size_t count)
{
    const uint32_t id = b->key[key].id;
    if (count <= b->keys) {
        for (size_t i = 0; i < count; i++)
            if (bond_list_find(b, pairs[2 * i + 1]) != BOND_NONE && bond_list_add(b, id, pairs[2 * i + 1]))
                return -1;
        return 0;
    }
    for (size_t k = key; k < b->keys; k++) {
        const uint32_t other = b->key[k].id;
        if (k > key && b->key[k - 1].id == other)
            continue;
        const size_t at = find_pair(pairs, count, id, other);
        if (at < count && pairs[2 * at + 1] == other && bond_list_add(b, id, other))
            return -1;
    }
    return 0;
}

int bond_list_select(bond_list *b, const uint32_t *pairs, size_t count)
{
    for (size_t k = 0; k < b->keys; k++) {
        const uint32_t id = b->key[k].id;
        if (k > 0 && b->key[k - 1].id == id)
            continue;
        const size_t from = find_pair(pairs, count, id, 0);
        const size_t to = id < UINT32_MAX ? find_pair(pairs, count, id + 1, 0) : count;
        if (from < to && select_of(b, k, pairs + 2 * from, to - from))
            return -1;
    }
    return 0;
}

int bond_list_resolve(cgt_trajectory *t, bond_list *b) { return resolve(t, b, 0); }

int bond_list_resolve_present(cgt_trajectory *t, bond_list *b) { return resolve(t, b, 1); }

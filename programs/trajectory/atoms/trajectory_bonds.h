/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bonds of a file: pairs of numbers that its atoms have there, turned into the indices of spheres. */
#ifndef TRAJECTORY_BONDS_H
#define TRAJECTORY_BONDS_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/trajectory.h>

#define BOND_NONE UINT32_MAX

typedef struct bond_key {
    uint32_t id, index;
} bond_key;

typedef struct bond_list {
    uint32_t *pair; /* 2 each: ids, and after bond_list_resolve indices */
    size_t count, capacity;
    bond_key *key; /* the atoms, sorted by ids */
    size_t keys, key_capacity;
} bond_list;

void bond_list_clear(bond_list *b);
void bond_list_free(bond_list *b);

/* Adds a bond. Returns 0, or -1: no memory. */
int bond_list_add(bond_list *b, uint32_t first, uint32_t second);

/* Makes the table of ids from those of the first `count` spheres in the store. Returns 1 or -1. */
int bond_list_index(cgt_trajectory *t, bond_list *b, uint32_t count);

/* The index of the sphere with this id, or BOND_NONE. */
uint32_t bond_list_find(const bond_list *b, uint32_t id);

/* Turns all ids into indices, and sorts out pairs that are there twice, in either direction. Returns 1 or -1: an id
 * that no atom has. */
int bond_list_resolve(cgt_trajectory *t, bond_list *b);

/* Sorts pairs of ids, the smaller one first, and leaves out those that are there twice: for bond_list_select. */
void bond_list_sort(bond_list *b);

/* Adds of sorted bonds, which may be those of many frames, the ones between atoms of b's table of ids. What that costs
 * goes by the atoms and the bonds of each, whatever the number of all bonds. Returns 0, or -1: no memory. */
int bond_list_select(bond_list *b, const uint32_t *pairs, size_t count);

/* Leaves out bonds whose atoms are missing, in place of the error. */
int bond_list_resolve_present(cgt_trajectory *t, bond_list *b);

#endif

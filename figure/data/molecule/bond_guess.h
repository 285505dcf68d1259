/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bonds that nobody lists: one rule for the readers and for figures, neither of which needs the other. Two atoms are
 * bonded where they are no farther apart than their covalent radii and 0.45 Angstrom more, through periodic boundaries,
 * too. */
#ifndef BOND_GUESS_H
#define BOND_GUESS_H

#include <stddef.h>

#include <cgt/trajectory.h>

/* Takes a bond; returns 0, or -1: no memory. */
typedef int bond_taker(void *user, uint32_t a, uint32_t b);

/* Tells the bonds of a frame of spheres that has elements, some of them twice. Returns 0, or -1: no memory. */
int cgt_guess_bonds(const cgt_trajectory_frame *frame, bond_taker *take, void *user);

/* Takes a bond of a to the image of b that lies `count` edges before b's own place, as cgt_periodic_box_count has it;
 * returns as above. */
typedef int image_bond_taker(void *user, uint32_t a, uint32_t b, const double count[3]);

/* Tells the other bonds of a frame whose bonds were guessed, once each: those of a pair, the smaller number first, to
 * more images than the nearest, and those of atoms to their own images. Only small cells have them. Returns as
 * above. */
int cgt_guess_image_bonds(const cgt_trajectory_frame *frame, image_bond_taker *take, void *user);

/* Compares two pairs for qsort, by their first numbers. */
int cgt_compare_bonds(const void *a, const void *b);

/* Sorts pairs, the smaller number first, and leaves one of each. Returns how many are left. */
size_t cgt_sort_bonds(uint32_t *pair, size_t count);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which structure AUTO builds. */
#ifndef CGT_CHOOSE_STRUCTURE_H
#define CGT_CHOOSE_STRUCTURE_H

#include "world.h"

/* The structure for the valid objects of a bounded world and the rays to come; why: gets the reason in words. */
cgt_structure cgt_choose_structure(const cgt_world *world, cgt_ray_kind rays, char *why, size_t bytes);

#endif

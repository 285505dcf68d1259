/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which structure AUTO builds. */
#ifndef CGT_CHOOSE_STRUCTURE_H
#define CGT_CHOOSE_STRUCTURE_H

#include <cgt/research.h>

/* The structure that is asked for, or AUTO's; the same for all scenes, since the pass over the primitives wants to know.
 * why: gets AUTO's reason in words, where it is no grid, whose plan has one of its own. */
cgt_structure cgt_choose_structure(const cgt_scene_options *options, const char **reason);

#endif

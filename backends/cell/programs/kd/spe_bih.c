/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The thesis' tracer with bounding interval hierarchies in place of kd-trees, which the thesis expected to suit the
 * Cell: the same text, with another traversal (kd_hierarchies.h) and nodes of 16 bytes in the cache of nodes. */
#define KD_IS_BIH 1
#include "cell/programs/kd/spe_kd.c" /* NOLINT(bugprone-suspicious-include) */

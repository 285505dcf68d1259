/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The format of a file by its first bytes, where its name does not tell. */
#ifndef TRAJECTORY_CONTENT_H
#define TRAJECTORY_CONTENT_H

#include "trajectory/trajectory_internal.h"

#define CONTENT_BYTES 4096 /* that are looked at */

/* Returns NULL where they are those of no format that is known. */
const trajectory_format *trajectory_find_content(const char *bytes, size_t size);

/* The same by signatures alone: they decide against the ending of a name. */
const trajectory_format *trajectory_find_signature(const char *bytes, size_t size);

#endif

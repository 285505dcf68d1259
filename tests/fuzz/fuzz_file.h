/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bytes as a file for the trajectory readers, and the invariants of every file, valid or not. */
#ifndef FUZZ_FILE_H
#define FUZZ_FILE_H

#include "fuzz/fuzz.h"
#include <cgt/trajectory.h>

/* Writes the bytes to a file with this ending; reads it to its end or its first error, again after a rewind, and by
 * skipping; writes the frames as .frames and reads those. */
void fuzz_file(const char *ending, const uint8_t *bytes, size_t size, const cgt_trajectory_options *options);

/* Writes the bytes to a file that is there while the process runs, such as a topology; returns its path. */
const char *fuzz_scratch(const char *name, const char *ending, const uint8_t *bytes, size_t size);

#endif

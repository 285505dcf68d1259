/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which bonds a run has: those that its files list, guessed ones, or both. */
#ifndef TRAJECTORY_GUESS_H
#define TRAJECTORY_GUESS_H

#include <cgt/trajectory.h>

/* Completes the bonds of a frame of spheres, where all are asked for. Returns 1 or -1. */
int bonds_complete(cgt_trajectory *t, cgt_trajectory_frame *frame);

#endif

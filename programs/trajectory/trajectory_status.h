/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the calls of cgt/trajectory.h tell, as programs pass it on. */
#ifndef TRAJECTORY_STATUS_H
#define TRAJECTORY_STATUS_H

#include <cgt/trajectory.h>

/* Returns 1, 0 at the end of the file, or -1 with the message. */
static inline int trajectory_status(const cgt_trajectory *t, cgt_result result, char *error, size_t error_size)
{
    if (result != CGT_OK && result != CGT_END)
        cgt_trajectory_get_error_message(t, error, error_size);
    return result == CGT_OK ? 1 : result == CGT_END ? 0 : -1;
}

/* Returns 0, or -1 with the message. */
static inline int trajectory_failed(const cgt_trajectory *t, cgt_result result, char *error, size_t error_size)
{
    return trajectory_status(t, result, error, error_size) == 1 ? 0 : -1;
}

#endif

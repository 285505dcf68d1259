/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The arithmetic that decisions rest on: round to nearest, denormals kept. Simulations often flush denormals to zero,
 * and then even a conversion from float to double loses them. So cgt_run_tasks enters the default environment around
 * each task, and a call does around what it computes outside tasks; both restore the caller's. */
#ifndef CGT_FLOAT_ENVIRONMENT_H
#define CGT_FLOAT_ENVIRONMENT_H

#include <float.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "float_mode.h"

_Static_assert(FLT_EVAL_METHOD == 0, "floats must be computed as floats: i386 needs -msse2 -mfpmath=sse (GCC: and "
                                     "-fexcess-precision=fast, as s390x does), see cmake/compile_options.cmake");

typedef float_mode cgt_float_environment;

static inline void cgt_float_environment_enter(cgt_float_environment *callers) { *callers = float_mode_default(); }

static inline void cgt_float_environment_leave(const cgt_float_environment *callers) { float_mode_restore(*callers); }

/* In any environment: by its bits, since others may take denormals for 0. */
static inline bool cgt_is_zero(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits << 1 == 0;
}

#endif

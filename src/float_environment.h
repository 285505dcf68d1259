/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The arithmetic that decisions rest on: round to nearest, denormals kept. Programs that simulate often flush
 * denormals to zero; then even the conversion of a float to double loses them. So each piece of work sets the default
 * environment and gives the caller's back. */
#ifndef CGT_FLOAT_ENVIRONMENT_H
#define CGT_FLOAT_ENVIRONMENT_H

#include <fenv.h>

static inline void cgt_float_environment_enter(fenv_t *callers)
{
    fegetenv(callers);
    fesetenv(FE_DFL_ENV);
}

static inline void cgt_float_environment_leave(const fenv_t *callers) { fesetenv(callers); }

#endif

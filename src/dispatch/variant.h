/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The variants of this build, and the ones of them that this CPU runs. */
#ifndef CGT_VARIANT_H
#define CGT_VARIANT_H

#include "dispatch/kernel.h"

typedef enum cgt_variant_state {
    CGT_VARIANT_RUNS = 0,
    CGT_VARIANT_ABSENT,      /* not in this build */
    CGT_VARIANT_UNSUPPORTED, /* the CPU lacks what it needs */
    CGT_VARIANT_DISABLED,    /* by CGT_DISABLE_CPU */
    CGT_VARIANT_BAD_LIST     /* CGT_DISABLE_CPU has a name that no variant of any build has */
} cgt_variant_state;

#define CGT_VARIANT_NAME_BYTES 32

/* Finds the named variant, or the widest that runs where name is NULL. NULL where there is none; *state tells why.
 * unknown: gets the first unknown name in CGT_DISABLE_CPU, cut to fit, where that is the reason. */
const cgt_kernel *cgt_variant_find(const char *name, cgt_variant_state *state, char unknown[CGT_VARIANT_NAME_BYTES]);

#endif

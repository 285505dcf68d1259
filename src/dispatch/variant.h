/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The variants of this build, and which of them this CPU runs. */
#ifndef CGT_VARIANT_H
#define CGT_VARIANT_H

#include "dispatch/kernel.h"

typedef enum cgt_variant_state {
    CGT_VARIANT_RUNS = 0,
    CGT_VARIANT_ABSENT,      /* not in this build */
    CGT_VARIANT_UNSUPPORTED, /* the CPU lacks what it needs */
    CGT_VARIANT_DISABLED     /* by CGT_DISABLE_CPU */
} cgt_variant_state;

/* The named variant, or the widest that runs where name is NULL. Returns NULL where there is none, with the reason in
 * *state. A name in CGT_DISABLE_CPU that no variant has ends the process. */
const cgt_kernel *cgt_variant_find(const char *name, cgt_variant_state *state);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The variants of this build, and which of them this CPU runs. */
#ifndef CGT_VARIANT_H
#define CGT_VARIANT_H

#include "kernel/kernel.h"

/* The named variant, or the widest that runs where name is NULL. NULL where there is none of that name, or this CPU
 * lacks what it needs; *known tells which. */
const cgt_kernel *cgt_variant_find(const char *name, bool *known);

#endif

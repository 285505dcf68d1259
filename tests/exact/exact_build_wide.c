/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The exact stage without its narrow tier: no group of floats spans 0 bits. */
#define CGT_EXACT_NARROW_BITS 0
#define EXACT_BUILD wide
#include "exact/exact_build.h"

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The exact stage as built by compilers without 128-bit integers. */
#define CGT_EXACT_HALVES
#define EXACT_BUILD halves
#include "exact/exact_build.h"

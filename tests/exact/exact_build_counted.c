/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The exact stage unchanged, with a counter for each tier. */
#include "exact/exact_builds.h"

uint64_t exact_reached[EXACT_TIERS];

#define CGT_EXACT_REACHED(tier) (exact_reached[EXACT_TIER_##tier]++)
#define EXACT_BUILD counted
#include "exact/exact_build.h"

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Constants of the papers' kernels that tests replace, as those of kernel/tunables.h. */
#ifndef CGT_PAPER_TUNABLES_H
#define CGT_PAPER_TUNABLES_H

#include "kernel/tunables.h"

/* Factors of the errors of a frustum (packet/frustum.h), of the cones around blocks (packet/block_cones.h), and of the
 * t before which no ray meets a sphere (packet/packet_filter.h). */
#ifndef FRUSTUM_ERROR_SCALE
#define FRUSTUM_ERROR_SCALE 1.f
#endif
#ifndef CONE_ERROR_SCALE
#define CONE_ERROR_SCALE 1.f
#endif
#ifndef MIN_T_ERROR_SCALE
#define MIN_T_ERROR_SCALE 1.f
#endif

/* Factor of what a ray adds to the margins of planes (bih/bih_rays.h). */
#ifndef BIH_ERROR_SCALE
#define BIH_ERROR_SCALE 1.f
#endif

/* Called for each leaf that a ray along ropes visits: lanes are those of a vector whose first ray is `first` of the
 * packet. */
#ifndef ROPE_VISIT
#define ROPE_VISIT(first, lanes, leaf) ((void)0)
#endif

#endif

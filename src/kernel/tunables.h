/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Numbers that tests change: bounds are made tighter until a test sees them break, limits smaller until their other
 * side is reached. A test defines a name before it includes a kernel's file. The library always has the values
 * below. */
#ifndef CGT_TUNABLES_H
#define CGT_TUNABLES_H

#include "vector.h"

/* ---- filters (primitive/), tiles (tile_draw/), points against a light (light/) ---- */

/* The unit roundoff u of single precision, in every bound of a filter. */
#ifndef FILTER_ROUNDOFF
#define FILTER_ROUNDOFF 0x1p-24f
#endif

/* The relative error of spu_rsqrte. */
#if CGT_LANES == 16
#define TILE_RSQRT_ERROR 0x1p-14f
#else
#define TILE_RSQRT_ERROR 0x1.8p-12f
#endif

/* The margin of a light's frustum, as a share of the largest coordinates: derived in light/light_packet.h. */
#ifndef LIGHT_MARGIN
#define LIGHT_MARGIN 0x1p-17f
#endif

/* Work, in nodes visited and primitives tested, that a packet of a light's rays may take in the BVH before its chunk is
 * traced ray by ray. Measured. */
#ifndef LIGHT_PACKET_WORK
#define LIGHT_PACKET_WORK 160u
#endif

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What casts.awk makes of a vector cast: one that does on any host what it does on an SPU. */
#ifndef CASTS_H
#define CASTS_H

#include <spu_intrinsics.h>

#define CLIENT_CAST(type, a) spux_cast(type, a)

#endif

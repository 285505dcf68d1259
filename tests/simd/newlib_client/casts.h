/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * casts.awk turns vector casts into these macros, which act on any host as a cast does on an SPU. */
#ifndef CASTS_H
#define CASTS_H

#include <spu_intrinsics.h>

#define CLIENT_CAST(type, a) spux_cast(type, a)

#endif

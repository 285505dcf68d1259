/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The version, in one place: CMake reads it from here. */
#ifndef CGT_VERSION_H
#define CGT_VERSION_H

#define CGT_VERSION_MAJOR 0
#define CGT_VERSION_MINOR 3
#define CGT_VERSION_PATCH 0
#define CGT_VERSION_STRING "0.3.0"

#endif

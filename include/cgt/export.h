/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What all headers of libcgt share: how its functions are exported. */
#ifndef CGT_EXPORT_H
#define CGT_EXPORT_H

#if defined(CGT_SHARED) && defined(__GNUC__)
#define CGT_API __attribute__((visibility("default")))
#else
#define CGT_API
#endif

#endif

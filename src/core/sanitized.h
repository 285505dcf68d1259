/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whether a sanitizer that makes frames larger watches this build. */
#ifndef CGT_SANITIZED_H
#define CGT_SANITIZED_H

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CGT_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define CGT_SANITIZED 1
#endif
#endif
#ifndef CGT_SANITIZED
#define CGT_SANITIZED 0
#endif

#endif

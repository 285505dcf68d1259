/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Streaming stores past the caches, for cgt-bench floor. NATIVE_HAS_STREAM is 1 where the compiler has them. */
#ifndef NATIVE_STREAM_H
#define NATIVE_STREAM_H

#include <stdint.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#define NATIVE_HAS_STREAM 1
/* Both words of a pair, aligned to its 16 bytes. */
static inline void native_stream_pair(uint64_t *pair, uint64_t word)
{
    _mm_stream_si128((__m128i *)pair, _mm_set1_epi64x((long long)word));
}
/* Stores before it complete before stores after it. */
static inline void native_stream_end(void) { _mm_sfence(); }
#elif defined(__has_builtin)
#if __has_builtin(__builtin_nontemporal_store)
#define NATIVE_HAS_STREAM 1
static inline void native_stream_pair(uint64_t *pair, uint64_t word)
{
    __builtin_nontemporal_store(word, pair);
    __builtin_nontemporal_store(word, pair + 1);
}
static inline void native_stream_end(void) {}
#endif
#endif

#ifndef NATIVE_HAS_STREAM
#define NATIVE_HAS_STREAM 0
#endif

#endif

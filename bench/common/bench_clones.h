/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What makes rays is compiled for the vectors that the CPU has, so that it costs little beside their tracing. */
#ifndef BENCH_CLONES_H
#define BENCH_CLONES_H

/* Functions that are compiled for wider vectors, too; sanitizers start too late for how they are chosen. */
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) &&                           \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define BENCH_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define BENCH_CLONES
#endif
#define BENCH_INLINE static inline __attribute__((always_inline)) /* into clones */

#endif

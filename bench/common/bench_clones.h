/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Compiles functions that make rays for the vectors of the CPU, so that making rays costs little compared with
 * tracing. */
#ifndef BENCH_CLONES_H
#define BENCH_CLONES_H

/* Compiles a function for wider vectors, too. Not under sanitizers, which start after the choice is made. */
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) &&                           \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define BENCH_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define BENCH_CLONES
#endif
#define BENCH_INLINE static inline __attribute__((always_inline)) /* into clones */

#endif

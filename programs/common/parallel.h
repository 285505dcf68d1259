/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Work on many pieces by several threads, for what a program does to pictures beside tracing. */
#ifndef PARALLEL_H
#define PARALLEL_H

#include <stdint.h>

/* Does one piece; index is its number. Pieces are independent of each other. */
typedef void parallel_piece(void *argument, uint32_t index);

/* Does the pieces below count, in any order, on at most `threads` threads, the caller's included, and returns when all
 * are done. Where the system refuses a thread the others do its share. */
void parallel_run(uint32_t threads, parallel_piece *piece, void *argument, uint32_t count);

/* Threads for a program that was told `threads`: 0 stands for one per CPU that it may use. At most 64. */
uint32_t parallel_threads(uint32_t threads);

/* A quarter of the machine's memory, in MiB; 1024 where the system does not tell. */
uint32_t parallel_memory(void);

#endif

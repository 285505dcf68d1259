/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A flag that a signal's handler sets and that any thread reads. sig_atomic_t would not do: C makes no promise for it
 * where another thread than the one that was interrupted reads it. C allows atomic objects in handlers where they are
 * free of locks. */
#ifndef STOP_FLAG_H
#define STOP_FLAG_H

#include <stdatomic.h>
#include <stdbool.h>

typedef atomic_int stop_flag; /* 0; other than 0: stop */

/* For calls that ask a function whether to stop; flag: const stop_flag *. */
static inline bool stop_flag_is_set(const void *flag) { return *(const stop_flag *)flag != 0; }

_Static_assert(ATOMIC_INT_LOCK_FREE == 2, "an atomic int of this machine needs a lock, which a handler may not take");

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Embree 3 over one frame, for the commands of cgt-bench that compare with it: a device, and scenes of spheres as its own
 * type and as user geometry, or of triangles. Where it is not installed there is none. */
#ifndef BENCH_EMBREE_H
#define BENCH_EMBREE_H

#include <stdint.h>

#include "common/bench_input.h"
#include "common/bench_threads.h"

typedef struct embree_scenes embree_scenes;

/* Over the first frame; build times are medians of some rounds, after one that warms up. threads trace the rays. NULL: it is
 * not installed, or it or memory is refused; *failed tells. */
embree_scenes *embree_scenes_create(const bench_input *input, bench_threads *threads, uint32_t rounds, int *failed);
void embree_scenes_release(embree_scenes *scenes); /* NULL does nothing */

#endif

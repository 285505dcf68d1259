/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A device of Embree, and its scenes over one frame: spheres as its own type and as user geometry, or triangles. */
#ifndef EMBREE_SCENES_H
#define EMBREE_SCENES_H

#include "embree/compare_embree.h"

enum { EMBREE_KINDS = 2 };

typedef struct embree_scenes {
    RTCDevice device;
    embree_moving moving[EMBREE_KINDS]; /* of spheres: Embree's own, and user geometry */
    double build_ms[EMBREE_KINDS];      /* at its lowest quality: the fastest to build */
    double build_cpu_ms[EMBREE_KINDS];  /* the same as CPU time */
    int kinds;
} embree_scenes;

/* Over the first frame; build times are medians of some rounds, after one that warms up. 0, or -1 where memory is
 * refused, or Embree does. */
int embree_scenes_create(embree_scenes *scenes, const bench_input *input, uint32_t threads, uint32_t rounds);
void embree_scenes_release(embree_scenes *scenes);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What is in common/bench_embree.h: only where Embree is installed. */
#ifndef EMBREE_SCENES_H
#define EMBREE_SCENES_H

#include "common/bench_embree.h"
#include "embree/compare_embree.h"

enum { EMBREE_KINDS = 2 };

struct embree_scenes {
    RTCDevice device;
    bench_threads *threads;
    embree_moving moving[EMBREE_KINDS]; /* of spheres: Embree's own, and user geometry */
    double build_ms[EMBREE_KINDS];      /* at its lowest quality: the fastest to build */
    double build_cpu_ms[EMBREE_KINDS];  /* the same as CPU time */
    int kinds;
};

#endif

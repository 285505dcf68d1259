/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes of Embree over one frame, for the commands of cgt-bench that compare with it. CLIFFS_EMBREE: it is installed. */
#include "common/bench_embree.h"

#ifdef CLIFFS_EMBREE

#include <stdio.h>
#include <stdlib.h>

#include "common/bench_timing.h"
#include "embree/embree_scenes.h"

static embree_callbacks native_callbacks(RTCDevice device)
{
#ifdef CGT_HAVE_AVX512
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED))
        return (embree_callbacks){embree_sphere_intersect_avx512, embree_sphere_occluded_avx512};
#endif
#ifdef CGT_HAVE_AVX2
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED))
        return (embree_callbacks){embree_sphere_intersect_avx2, embree_sphere_occluded_avx2};
#endif
    (void)device;
    return (embree_callbacks){embree_sphere_intersect_portable, embree_sphere_occluded_portable};
}

static int build(embree_scenes *e, int kind, const bench_input *input, uint32_t rounds)
{
    const embree_callbacks callbacks = native_callbacks(e->device);
    double *ms = calloc(2 * ((size_t)rounds + 1), sizeof *ms);
    if (!ms || embree_moving_create(&e->moving[kind], e->device, input, EMBREE_LOW, kind, 0, &callbacks)) {
        free(ms);
        return -1;
    }
    double *cpu_ms = ms + rounds + 1;
    for (uint32_t k = 0; k <= rounds; k++) {
        embree_moving_move(&e->moving[kind], 0);
        const double begin = bench_now_ms(), cpu_begin = bench_cpu_ms();
        embree_moving_commit(&e->moving[kind], 0);
        ms[k] = bench_now_ms() - begin;
        cpu_ms[k] = bench_cpu_ms() - cpu_begin;
    }
    e->build_ms[kind] = bench_median(ms + 1, rounds);
    e->build_cpu_ms[kind] = bench_median(cpu_ms + 1, rounds);
    free(ms);
    return 0;
}

embree_scenes *embree_scenes_create(const bench_input *input, bench_threads *threads, uint32_t rounds, int *failed)
{
    char text[64];
    embree_scenes *e = calloc(1, sizeof *e);
    *failed = 1;
    if (!e)
        return NULL;
    snprintf(text, sizeof text, "threads=%u,set_affinity=0", (unsigned)bench_threads_count(threads));
    e->threads = threads;
    e->device = rtcNewDevice(text);
    *failed = !e->device;
    for (int kind = 0; kind < (input->index ? 1 : EMBREE_KINDS) && !*failed; kind++, e->kinds++)
        *failed = build(e, kind, input, rounds) != 0;
    if (!*failed)
        return e;
    embree_scenes_release(e);
    return NULL;
}

void embree_scenes_release(embree_scenes *e)
{
    if (!e)
        return;
    for (int kind = 0; kind < EMBREE_KINDS; kind++)
        if (e->moving[kind].scene)
            embree_moving_release(&e->moving[kind]);
    if (e->device)
        rtcReleaseDevice(e->device);
    free(e);
}

#else

embree_scenes *embree_scenes_create(const bench_input *input, bench_threads *threads, uint32_t rounds, int *failed)
{
    (void)input;
    (void)threads;
    (void)rounds;
    *failed = 0;
    return NULL;
}

void embree_scenes_release(embree_scenes *scenes) { (void)scenes; }

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Embree 3 on the same rays: nearest hits by single rays and packets. It has no primitive to ignore: its rays begin an
 * offset farther on, as renderers do it. CLIFFS_EMBREE: it is installed. */
#include "bounces/bench_bounces.h"

#ifdef CLIFFS_EMBREE
#include <stdlib.h>

#include "common/bench_timing.h"
#include "embree/embree_scenes.h"

static const struct {
    const char *name[EMBREE_KINDS];
    uint32_t rays;
    int coherent;
} ways[] = {{{"single", "single, user"}, 1, 0},
            {{"packets of 8", "packets of 8, user"}, 8, 1},
            {{"packets of 8, incoherent", "packets of 8, user, incoherent"}, 8, 0},
            {{"packets of 16", "packets of 16, user"}, 16, 1},
            {{"packets of 16, incoherent", "packets of 16, user, incoherent"}, 16, 0}};
enum { WAYS = sizeof ways / sizeof ways[0] };
_Static_assert((int)WAYS *EMBREE_KINDS <= (int)BOUNCES_MOST_WAYS, "room for all ways");

int bounces_embree_ways(const embree_scenes *e) { return e->kinds * WAYS; }
const char *bounces_embree_way(const embree_scenes *e, int way)
{
    (void)e;
    return ways[way % WAYS].name[way / WAYS];
}
double bounces_embree_build_ms(const embree_scenes *e, int way) { return e->build_cpu_ms[way / WAYS]; }

double bounces_embree_trace(const embree_scenes *e, int way, const bounces_rays *rays)
{
    embree_arrays arrays = {.scene = e->moving[way / WAYS].scene,
                            .threads = e->threads,
                            .packet = ways[way % WAYS].rays,
                            .coherent = ways[way % WAYS].coherent,
                            .nearest = 1};
    const cgt_rays batch = {.count = rays->count,
                            .org = {rays->org[0], rays->org[1], rays->org[2]},
                            .dir = {rays->dir[0], rays->dir[1], rays->dir[2]},
                            .t_min = rays->offset,
                            .t_max = rays->t_max};
    const double begin = bench_cpu_ms();
    embree_arrays_trace(&arrays, &batch, rays->hit);
    return bench_cpu_ms() - begin;
}

#else

int bounces_embree_ways(const embree_scenes *embree)
{
    (void)embree;
    return 0;
}

const char *bounces_embree_way(const embree_scenes *embree, int way)
{
    (void)embree;
    (void)way;
    return "-";
}

double bounces_embree_build_ms(const embree_scenes *embree, int way)
{
    (void)embree;
    (void)way;
    return 0;
}

double bounces_embree_trace(const embree_scenes *embree, int way, const bounces_rays *rays)
{
    (void)embree;
    (void)way;
    (void)rays;
    return 0;
}

#endif

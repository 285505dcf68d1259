/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * oracle_scenes [FIRST [SCENES [FAMILY]]]
 * Small hard scenes of every family, each loaded in some ways, asked by every call, and judged by whole numbers. Each
 * scene depends on its number and CGT_TEST_SEED alone, so that what fails is seen again by its number. Without
 * arguments it takes as many scenes as a test has time for, times CGT_TEST_SCALE. */
#include <stdio.h>
#include <stdlib.h>

#include "oracle/judge/judge_run.h"

#define SETUPS 3u
#define SCENES 300u
#define FEW 50u /* scenes: too few to tell whether they were hard */

static void run_scene(judge_run *run, uint32_t number, uint32_t family)
{
    judge_scene_make(&run->scene, number, family);
    run->scene_bad = 0;
    judge_rays_begin(run);
    judge_frames_begin(run);
    for (uint32_t k = 0; k < SETUPS; k++) {
        run->setup.number = k;
        judge_setup_make(&run->setup, &run->scene, &run->scene.random);
        judge_rays_ask(run);
        judge_frames_ask(run);
        judge_setup_free(&run->setup);
    }
    run->counts.scenes++;
}

/* What was asked, and that it was worth it. */
static bool was_hard(const judge_counts *c)
{
    printf("%llu scenes, %llu calls: %llu rays judged, %llu answers, %llu values; %llu hits, %llu crossings, %llu "
           "points inside, %llu pixels hit, %llu of %llu shadow rays occluded, %llu rays in doubt\n",
           (unsigned long long)c->scenes, (unsigned long long)c->calls, (unsigned long long)c->rays,
           (unsigned long long)c->answers, (unsigned long long)c->values, (unsigned long long)c->hits,
           (unsigned long long)c->crossings, (unsigned long long)c->inside, (unsigned long long)c->pixels,
           (unsigned long long)c->occluded, (unsigned long long)c->shadows, (unsigned long long)c->doubtful);
    return c->hits > 20 * c->scenes && c->pixels > 10 * c->scenes && c->occluded * 20 > c->shadows &&
           c->doubtful * 100 < c->rays;
}

int main(int argc, char **argv)
{
    static judge_run run;
    const char *const first = argc > 1            ? argv[1]
                              : clusters_always() ? "10000"
                                                  : "0",
                      *const family = argc > 3 ? argv[3] : NULL;
    test_begin("oracle_scenes");
    const uint32_t scenes =
        argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 0) : test_scaled(clusters_always() ? SCENES / 3 : SCENES);
    run.view = judge_view_make();
    if (!run.view)
        return 2;
    for (uint32_t k = 0; k < scenes; k++) {
        run_scene(&run, (uint32_t)strtoul(first, NULL, 0) + k,
                  family ? (uint32_t)strtoul(family, NULL, 0) : JUDGE_ANY_FAMILY);
        if (k % 1000 == 999)
            (void)was_hard(&run.counts);
    }
    const bool hard = was_hard(&run.counts) || argc > 1 || scenes < FEW;
    judge_contexts_free();
    free(run.view);
    free(run.pool.hit);
    if (run.counts.bad)
        printf("%llu answers are wrong, of %llu scenes or more\n", (unsigned long long)run.counts.bad,
               (unsigned long long)run.counts.bad_scenes);
    else if (!hard)
        printf("these scenes are too easy\n");
    return run.counts.bad || !hard;
}

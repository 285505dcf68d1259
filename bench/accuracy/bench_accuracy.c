/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench accuracy: the parts in their order; the error of paths by bounce, in ulps of the scene's size. */
#include "accuracy/bench_accuracy.h"

#include <stdio.h>
#include <string.h>

#include "support/random.h"
#include "support/reference/path_error.h"

enum { CASES, FRAMES, PATHS, PARTS };

const accuracy_way accuracy_ways[ACCURACY_WAYS] = {[ACCURACY_EXACT] = {CGT_PRECISION_EXACT, CGT_TRIANGLE_TEST_AUTO},
                                                   [ACCURACY_FAST] = {CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_AUTO},
                                                   {CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_WATERTIGHT},
                                                   {CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_MOLLER_TRUMBORE},
                                                   {CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_ACCELERATED}};

bench_way accuracy_way_of(const bench_settings *settings, const char *variant, size_t which)
{
    bench_way way = {.structure = settings->ways ? (cgt_structure)settings->way[0] : CGT_STRUCTURE_QUEUE_GRID,
                     .choice = settings->choice};
    way.choice.variant = variant;
    way.choice.precision = accuracy_ways[which].precision;
    way.choice.precision_named = 1;
    way.choice.test = accuracy_ways[which].test;
    return way;
}

/* The variants that the CPU runs, narrowest first, or the one that the settings name. Returns how many. */
static size_t find_variants(const bench_settings *settings, const char *variants[BENCH_MOST_VARIANTS])
{
    size_t count = 0;
    if (settings->choice.variant) {
        variants[0] = settings->choice.variant;
        return 1;
    }
    for (const char *const *name = cgt_get_variant_names(); *name && count < BENCH_MOST_VARIANTS; name++) {
        const cgt_context_options options = {.threads = 1, .variant = *name};
        cgt_context *context = NULL;
        if (cgt_context_create(&options, &context) == CGT_OK)
            variants[count++] = *name;
        else
            fprintf(stderr, "variant %s left out: this CPU lacks it\n", *name);
        cgt_context_release(context);
    }
    return count;
}

static int write_paths(const accuracy_job *job)
{
    enum { STREAM = 6 };
    const char *variant = job->variant[job->variants - 1]; /* the bits are the same in all */
    bench_table_section(job->table, "paths");
    for (int balls = 0; balls < 2; balls++) {
        path_errors e;
        const cgt_result result = path_errors_measure(balls, job->settings->rays, STREAM, variant, &e);
        if (result != CGT_OK)
            return bench_failed(NULL, "paths", result);
        for (uint32_t k = 0; k < PATH_BOUNCES; k++)
            BENCH_ROW(job->table, CELL("mirrors", balls ? "balls" : "planes"), CELL("variant", variant),
                      CELL("bounce", k + 1), CELL("paths", e.paths[k]), CELL("parted", e.parted[k]),
                      CELL("mean_ulp", e.paths[k] ? e.sum[k] / e.paths[k] : 0.0), CELL("worst_ulp", e.worst[k]));
    }
    return PROGRAM_OK;
}

static int run_part(const accuracy_job *job, int part)
{
    const bench_settings *s = job->settings;
    int code = PROGRAM_OK;
    if (part != FRAMES)
        return part == CASES ? accuracy_cases(job) : write_paths(job);
    for (size_t i = 0; i < s->files && code == PROGRAM_OK; i++)
        if (!s->text || strstr(s->paths[i], s->text))
            code = accuracy_frames(job, s->paths[i]);
    return code;
}

int bench_accuracy(const bench_settings *settings)
{
    accuracy_job job = {.settings = settings};
#ifndef __OPTIMIZE__
    program_error("this build is not optimised: the times mean nothing");
#endif
    if (settings->seeded)
        random_seed(settings->seed);
    job.variants = find_variants(settings, job.variant);
    job.table = bench_table_open(settings->json_path);
    int code = job.table ? bench_input_check_files(settings) : PROGRAM_FAILED;
    for (int part = 0; part < PARTS && code == PROGRAM_OK; part++)
        if (bench_is_chosen(settings->part, PARTS, part))
            code = run_part(&job, part);
    return bench_table_close(job.table) ? PROGRAM_FAILED : code;
}

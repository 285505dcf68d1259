/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench accuracy: the command line, and the parts in their order. */
#include "accuracy/bench_accuracy.h"

#include "common/bench_input.h"

#include <stdio.h>
#include <string.h>

enum { DEFAULT_RAYS = 4000, MOST_RAYS = 10000000, DEFAULT_REPEAT = 5 };
enum { OPTION_CASE = 0x300, OPTION_SEED, OPTION_RAYS };

static const char *const parts[ACCURACY_PARTS] = {"cases", "structure", "modes", "frames", "paths", "tests"};

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "Parts:", 4},
    {"part", 'w', "NAMES", 0, "cases, structure, modes, frames, paths, tests; a list with commas (default: all)", 4},
    {"rays", OPTION_RAYS, "COUNT", 0, "rays of each case and file (default 4000); below 1000 modes trace less, too", 4},
    {"case", OPTION_CASE, "TEXT", 0, "only cases and files whose names contain TEXT", 4},
    {"seed", OPTION_SEED, "NUMBER", 0, "seed of the cases' random numbers", 4},
    {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse(int key, char *argument, struct argp_state *state)
{
    accuracy_job *job = state->input;
    char error[PROGRAM_ERROR_SIZE] = "";
    uint64_t seed = 0;
    int others = 0;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &job->shared; return 0;
    case 'w': bench_choose(state, "-w", argument, parts, ACCURACY_PARTS, job->part); return 0;
    case OPTION_RAYS: bench_parse_u32(state, "--rays", argument, 1, MOST_RAYS, &job->rays); return 0;
    case OPTION_CASE: job->filter = argument; return 0;
    case OPTION_SEED:
        if (program_parse_u64(argument, 0, UINT64_MAX, &seed, error, sizeof error))
            argp_error(state, "--seed: %s", error);
        random_seed(seed);
        return 0;
    case ARGP_KEY_SUCCESS:
        for (int part = 0; part < ACCURACY_PARTS; part++)
            others |= part != ACCURACY_FRAMES && bench_is_chosen(job->part, ACCURACY_PARTS, part);
        if (!others && !job->shared.files)
            argp_error(state, "-w frames: FILE is missing");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* Whether the filter lets a name pass. row: of a hard case; NULL for a file. */
static int is_chosen(const accuracy_job *job, const char *row, const char *name)
{
    char text[ACCURACY_NAME_SIZE];
    snprintf(text, sizeof text, "%s%s%s", row ? row : "", row ? ": " : "", name);
    return !job->filter || strstr(text, job->filter) != NULL;
}

/* Makes one subject after another, so that only one is in memory, and adds its rows. */
static int each_subject(const accuracy_job *job, int (*rows)(const accuracy_job *, const accuracy_subject *))
{
    const size_t cases = hard_case_count();
    int code = PROGRAM_OK;
    for (size_t i = 0; i < cases + job->shared.files && code == PROGRAM_OK; i++) {
        accuracy_subject subject;
        const hard_case *hard = i < cases ? hard_case_at(i) : NULL;
        const char *path = hard ? NULL : job->shared.paths[i - cases];
        if (!is_chosen(job, hard ? hard->row : NULL, hard ? hard->name : path))
            continue;
        code = hard ? accuracy_subject_case(&subject, hard, job->rays) : accuracy_subject_file(&subject, job, path);
        if (code == PROGRAM_OK) {
            code = rows(job, &subject);
            accuracy_subject_free(&subject);
        }
    }
    return code;
}

static int each_file(const accuracy_job *job)
{
    int code = PROGRAM_OK;
    for (size_t i = 0; i < job->shared.files && code == PROGRAM_OK; i++)
        if (is_chosen(job, NULL, job->shared.paths[i]))
            code = accuracy_frames(job, job->shared.paths[i]);
    return code;
}

static int run_part(const accuracy_job *job, int part)
{
    switch (part) {
    case ACCURACY_CASES: return each_subject(job, accuracy_cases);
    case ACCURACY_STRUCTURE: return each_subject(job, accuracy_structure);
    case ACCURACY_MODES: return accuracy_modes(job);
    case ACCURACY_FRAMES: return each_file(job);
    case ACCURACY_PATHS: return accuracy_paths(job);
    default: return accuracy_tests(job);
    }
}

int bench_accuracy(int argc, char **argv)
{
    static const struct argp_child children[] = {{&bench_settings_argp, 0, NULL, 0}, {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "[FILE...]",
        .children = children,
        .doc =
            "Sets time against error, in every variant, precision and triangle test. The part \"cases\" traces rays of "
            "the hard cases of ray casting and of each FILE's first frame, and judges every answer by exact "
            "arithmetic: rays that miss, that hit where nothing is, or that name another primitive; t, u and v in "
            "units "
            "in the last place; angles of normals in radians. \"structure\" sets the grid against brute force with the "
            "same kernel, \"modes\" the modes of execution against each other. \"frames\" measures whole frames of "
            "each "
            "FILE against EXACT, with the structure rebuilt; \"paths\" the error of paths between mirrors by bounce; "
            "\"tests\" the intersection tests without bounds, without "
            "a "
            "structure, also in the SPU's arithmetic."
            "\vThe first part is a plain table; each further one follows behind \"# \". -r defaults to 5."};
    accuracy_job job = {.rays = DEFAULT_RAYS};
    bench_settings_init(&job.shared);
    job.shared.repeat = DEFAULT_REPEAT;
    job.shared.least_files = 0;
    job.shared.most_files = BENCH_MOST_FILES;
    if (argp_parse(&parser, argc, argv, 0, NULL, &job))
        return PROGRAM_USAGE;
#ifndef __OPTIMIZE__
    program_error("this build is not optimised: the times mean nothing");
#endif
    job.variants = bench_variants(&job.shared, job.variant);
    job.table = bench_table_open(job.shared.json_path);
    int code = job.table ? bench_input_check_files(&job.shared) : PROGRAM_FAILED;
    for (int part = 0; part < ACCURACY_PARTS && code == PROGRAM_OK; part++)
        if (bench_is_chosen(job.part, ACCURACY_PARTS, part))
            code = run_part(&job, part);
    return bench_table_close(job.table) ? PROGRAM_FAILED : code;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench accuracy: every intersector, precision and variant over the hard cases and over files, time beside errors;
 * then the structure's errors apart from the kernel's, and the modes of execution beside each other. */
#include <stdio.h>
#include <string.h>

#include "accuracy/bench_accuracy.h"

#define DEFAULT_RAYS 4000u
#define MOST_RAYS 10000000u
#define DEFAULT_REPEAT 5u

enum { OPTION_CASE = 0x300, OPTION_SEED };

static const struct argp_option options[] = {
    {"rays", 'r', "COUNT", 0,
     "rays of each case and file (default 4000); below 1000 the picture of the modes is smaller", 0},
    {"repeat", 'n', "COUNT", 0, "time each row COUNT times and take the median (default 5)", 0},
    {"variant", 'V', "NAME", 0, "this instruction set, as the library names it; may be given several times", 0},
    {"json", 'j', "FILE", 0, "write the rows as JSON, too", 0},
    {"case", OPTION_CASE, "TEXT", 0, "only cases and files whose names contain TEXT", 0},
    {"seed", OPTION_SEED, "NUMBER", 0, "seed of the cases' random numbers", 0},
    {NULL, 0, NULL, 0, "Files:", 1},
    {"camera", 'c', "EX,EY,EZ,TX,TY,TZ,UX,UY,UZ,FOV", 0,
     "eye, target, up, vertical angle in degrees (default 0,0,-5,0,0,0,0,1,0,45)", 1},
    {"size", 's', "WxH", 0, "pixels of the picture that the rays are taken from (default 1280x720)", 1},
    {"frame", 'f', "NUMBER", 0, "frame of each file, from 0 (default 0)", 1},
    {NULL, 0, NULL, 0, NULL, 0}};

/* ---- command line ---- */

static int runs(const char *variant)
{
    cgt_context *context = NULL;
    const cgt_result result = bench_context_create(1, variant, &context);
    cgt_context_release(context);
    return result == CGT_OK;
}

/* Variants that the CPU runs; the names are the library's, which outlive the command line. */
static void add_variant(accuracy_job *job, struct argp_state *state, const char *text)
{
    for (const char *const *name = cgt_get_variant_names(); *name; name++)
        if (!strcmp(*name, text)) {
            if (!runs(*name))
                argp_error(state, "-V: this CPU does not run %s", text);
            for (size_t i = 0; i < job->variants; i++)
                if (job->variant[i] == *name)
                    return;
            if (job->variants < ACCURACY_MOST_VARIANTS)
                job->variant[job->variants++] = *name;
            return;
        }
    argp_error(state, "-V: no variant %s in this build", text);
}

static void add_all_variants(accuracy_job *job)
{
    for (const char *const *name = cgt_get_variant_names(); *name && job->variants < ACCURACY_MOST_VARIANTS; name++)
        if (runs(*name))
            job->variant[job->variants++] = *name;
}

static void add_file(accuracy_job *job, struct argp_state *state, const char *path)
{
    if (job->paths == ACCURACY_MOST_FILES)
        argp_error(state, "more than %d files", ACCURACY_MOST_FILES);
    else
        job->path[job->paths++] = path;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    accuracy_job *job = state->input;
    char error[PROGRAM_ERROR_SIZE] = "";
    uint64_t seed = 0;
    int failed = 0;
    switch (key) {
    case 'r': failed = program_parse_u32(argument, 1, MOST_RAYS, &job->rays, error, sizeof error); break;
    case 'n': failed = program_parse_u32(argument, 1, 100000, &job->repeat, error, sizeof error); break;
    case 'c': failed = program_parse_camera(argument, &job->camera, error, sizeof error); break;
    case 's': failed = program_parse_size(argument, &job->width, &job->height, error, sizeof error); break;
    case 'f': failed = program_parse_u64(argument, 0, UINT64_MAX, &job->frame, error, sizeof error); break;
    case 'V': add_variant(job, state, argument); return 0;
    case 'j': job->json_path = argument; return 0;
    case OPTION_CASE: job->filter = argument; return 0;
    case OPTION_SEED:
        if (program_parse_u64(argument, 0, UINT64_MAX, &seed, error, sizeof error))
            argp_error(state, "--seed: %s", error);
        random_seed(seed);
        return 0;
    case ARGP_KEY_ARG: add_file(job, state, argument); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
    if (failed)
        argp_error(state, "-%c: %s", key, error);
    return 0;
}

/* ---- tables ---- */

/* row: NULL for a file, of which name is the path. */
static int is_asked_for(const accuracy_job *job, const char *row, const char *name)
{
    char text[ACCURACY_NAME_SIZE];
    snprintf(text, sizeof text, "%s%s%s", row ? row : "", row ? ": " : "", name);
    return !job->filter || strstr(text, job->filter) != NULL;
}

/* Makes the subjects one after another, so that one of them is in memory, and adds their rows. */
static int each_subject(const accuracy_job *job, int (*rows)(const accuracy_job *, const accuracy_subject *))
{
    const size_t cases = hard_case_count();
    int code = PROGRAM_OK;
    for (size_t i = 0; i < cases + job->paths && code == PROGRAM_OK; i++) {
        accuracy_subject subject;
        const hard_case *hard = i < cases ? hard_case_at(i) : NULL;
        const char *path = hard ? NULL : job->path[i - cases];
        if (!is_asked_for(job, hard ? hard->row : NULL, hard ? hard->name : path))
            continue;
        code = hard ? accuracy_subject_case(&subject, hard, job->rays) : accuracy_subject_file(&subject, job, path);
        if (code == PROGRAM_OK) {
            code = rows(job, &subject);
            accuracy_subject_free(&subject);
        }
    }
    return code;
}

static int run(accuracy_job *job)
{
    job->report = accuracy_report_open(job->json_path);
    if (!job->report)
        return PROGRAM_FAILED;
    accuracy_table_begin(job);
    int code = each_subject(job, accuracy_table_rows);
    if (code == PROGRAM_OK) {
        accuracy_structure_begin(job);
        code = each_subject(job, accuracy_structure_rows);
    }
    if (code == PROGRAM_OK)
        code = accuracy_modes(job);
    return accuracy_report_close(job->report) ? PROGRAM_FAILED : code;
}

int bench_accuracy(int argc, char **argv)
{
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "[FILE...]",
        .doc = "Measures time and error of every triangle test, precision and variant: over the hard cases of ray "
               "casting, and over a frame of each FILE, a trajectory of spheres or triangles. Each answer is judged by "
               "exact arithmetic: rays that miss what they hit, hit what they miss, or name another primitive; t, u "
               "and v in units in the last place; angles of normals in radians."
               "\vBelow the table, behind \"#\": the grid beside brute force with the same kernel, and the modes of "
               "execution beside each other."};
    accuracy_job job = {.rays = DEFAULT_RAYS, .repeat = DEFAULT_REPEAT, .width = 1280, .height = 720};
    cgt_camera_init(&job.camera);
    job.camera.eye[2] = -5.0f; /* as in the other sub-commands */
    if (argp_parse(&parser, argc, argv, 0, NULL, &job))
        return PROGRAM_USAGE;
    if (!job.variants)
        add_all_variants(&job);
#ifndef __OPTIMIZE__
    program_error("this build is not optimised: the times mean nothing");
#endif
    return run(&job);
}

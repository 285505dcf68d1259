/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench cliffs: the command line, and what is measured in which order. */
#include "cliffs/bench_cliffs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    OPTION_PRIMITIVES = 0x600,
    OPTION_STRUCTURE,
    OPTION_CALL,
    OPTION_SCENE,
    OPTION_LIMIT,
    OPTION_STEPS,
    OPTION_WORST
};
enum { OPTION_QUICK = 0x620, OPTION_NO_EMBREE, OPTION_LIST };
enum { LEAST_PRIMITIVES = 64, MOST_PRIMITIVES = 10000000 };

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "Scenes and calls:", 4},
    {"primitives", OPTION_PRIMITIVES, "COUNTS", 0, "with commas (default 1000,10000,100000,1000000)", 4},
    {"structure", 'S', "NAMES", 0, "auto, loose-grid, bvh, bih (default: all)", 4},
    {"call", OPTION_CALL, "NAMES", 0, "commit, camera, light, single, rays, occluded (default: all)", 4},
    {"scene", OPTION_SCENE, "TEXT", 0, "only scenes whose names contain TEXT", 4},
    {"limit", OPTION_LIMIT, "MS", 0, "no call is measured for longer, but for 192 rays (default 1000)", 4},
    {"steps", OPTION_STEPS, "COUNT", 0, "calls grow from 192 rays by four, so many times, 1 to 7 (default 5)", 4},
    {"worst", OPTION_WORST, "COUNT", 0, "rows of each summary (default 10)", 4},
    {"quick", OPTION_QUICK, NULL, 0, "10000 primitives, auto, 3 steps, 40 ms: about a minute", 4},
    {"no-embree", OPTION_NO_EMBREE, NULL, 0, "without Embree, where it is installed", 4},
    {"list", OPTION_LIST, NULL, 0, "print the names of the scenes", 4},
    {NULL, 0, NULL, 0, NULL, 0}};

static const char *const structures[CLIFF_STRUCTURES] = {"auto", "loose-grid", "bvh", "bih"};
static const char *const calls[CLIFF_CALLS] = {"commit", "camera", "light", "single", "rays", "occluded"};

/* ---- Command line -------------------------------------------------------------------------------------------- */

static void parse_counts(struct argp_state *state, const char *list, cliffs_settings *settings)
{
    char name[BENCH_LISTED_SIZE];
    settings->counts = 0;
    while (bench_next_name(&list, name)) {
        if (settings->counts == CLIFFS_COUNTS) {
            argp_error(state, "--primitives: more than %d counts", CLIFFS_COUNTS);
            return;
        }
        bench_parse_u32(state, "--primitives", name, LEAST_PRIMITIVES, MOST_PRIMITIVES,
                        &settings->count[settings->counts++]);
    }
}

static void be_quick(cliffs_settings *settings)
{
    settings->quick = 1;
    settings->count[0] = 10000;
    settings->counts = 1;
    settings->structure[CLIFF_AUTO] = 1;
    settings->steps = 3;
    settings->limit_ms = 40;
}

static int is_any_scene(const char *text)
{
    for (uint32_t i = 0; i < cliff_count(); i++)
        if (strstr(cliff_at(i)->name, text))
            return 1;
    return 0;
}

static void list_scenes(void)
{
    for (uint32_t i = 0; i < cliff_count(); i++)
        puts(cliff_at(i)->name);
    exit(program_exit(PROGRAM_OK));
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    cliffs_settings *settings = state->input;
    uint32_t number = 0;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &settings->shared; return 0;
    case OPTION_PRIMITIVES: parse_counts(state, argument, settings); return 0;
    case 'S': bench_choose(state, "-S", argument, structures, CLIFF_STRUCTURES, settings->structure); return 0;
    case OPTION_CALL: bench_choose(state, "--call", argument, calls, CLIFF_CALLS, settings->call); return 0;
    case OPTION_SCENE:
        settings->text = argument;
        if (!is_any_scene(argument))
            argp_error(state, "--scene: no scene has a name with \"%s\": --list prints them", argument);
        return 0;
    case OPTION_LIMIT:
        bench_parse_u32(state, "--limit", argument, 1, 1000000, &number);
        settings->limit_ms = number;
        return 0;
    case OPTION_STEPS: bench_parse_u32(state, "--steps", argument, 1, CLIFFS_STEPS, &settings->steps); return 0;
    case OPTION_WORST: bench_parse_u32(state, "--worst", argument, 0, 1000000, &settings->worst); return 0;
    case OPTION_QUICK: be_quick(settings); return 0;
    case OPTION_NO_EMBREE: settings->no_embree = 1; return 0;
    case OPTION_LIST: list_scenes(); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- Measuring ----------------------------------------------------------------------------------------------- */

typedef struct job {
    const cliffs_settings *settings;
    cgt_context *context;
    bench_table *table;
    cliffs_rows rows;
    uint32_t primitives;
    cliffs_result twin[CLIFF_BASES][CLIFF_STRUCTURES]; /* for so many primitives */
    bool has_twin[CLIFF_BASES];
} job;

static bool has_embree(const cliffs_settings *settings)
{
    return cliffs_embree_is_here() && !settings->no_embree && settings->shared.threads == 1;
}

static int measure_structures(job *j, cliffs_input *input, cliffs_result result[CLIFF_STRUCTURES])
{
    for (int s = 0; s < CLIFF_STRUCTURES; s++)
        if (bench_is_chosen(j->settings->structure, CLIFF_STRUCTURES, s) &&
            cliffs_measure_library(j->settings, j->context, input, (cliff_structure)s, &result[s]))
            return -1;
    return 0;
}

static int measure_twin(job *j, cliff_base base)
{
    const cliff twin = {.name = "twin", .base = base};
    cliffs_input input;
    if (j->has_twin[base])
        return 0;
    if (cliffs_input_make(&input, &twin, false, j->primitives, j->settings->steps))
        return -1;
    const int code = measure_structures(j, &input, j->twin[base]);
    cliffs_input_free(&input);
    j->has_twin[base] = true;
    return code;
}

static int measure_cliff(job *j, const cliff *c)
{
    cliffs_result result[CLIFF_STRUCTURES], embree;
    cliffs_input input;
    if (measure_twin(j, c->base) || cliffs_input_make(&input, c, true, j->primitives, j->settings->steps))
        return -1;
    memset(&embree, 0, sizeof embree);
    int code = measure_structures(j, &input, result);
    if (!code && has_embree(j->settings))
        code = cliffs_measure_embree(j->settings, &input, &embree);
    for (int s = 0; s < CLIFF_STRUCTURES && !code; s++) {
        const cliffs_row name = {.scene = c->name, .primitives = j->primitives, .structure = (cliff_structure)s};
        if (bench_is_chosen(j->settings->structure, CLIFF_STRUCTURES, s))
            code = cliffs_add_rows(&j->rows, j->table, &name, &result[s], &j->twin[c->base][s], &embree);
    }
    cliffs_input_free(&input);
    return code;
}

static int measure_all(job *j)
{
    const cliffs_settings *settings = j->settings;
    for (uint32_t k = 0; k < settings->counts; k++) {
        j->primitives = settings->count[k];
        memset(j->has_twin, 0, sizeof j->has_twin);
        for (uint32_t i = 0; i < cliff_count(); i++)
            if ((!settings->text || strstr(cliff_at(i)->name, settings->text)) && measure_cliff(j, cliff_at(i)))
                return PROGRAM_FAILED;
    }
    cliffs_print_worst(&j->rows, j->table, settings->worst);
    return PROGRAM_OK;
}

static int run(const cliffs_settings *settings)
{
    job j = {.settings = settings};
    const cgt_result result = bench_context_create(settings->shared.threads, settings->shared.variant, &j.context);
    if (result != CGT_OK)
        return bench_scene_failed(j.context, "context", result);
    int code = PROGRAM_FAILED;
    if ((j.table = bench_table_open(settings->shared.json_path)) != NULL)
        code = measure_all(&j);
    if (bench_table_close(j.table))
        code = PROGRAM_FAILED;
    cgt_context_release(j.context);
    free(j.rows.row);
    return code;
}

int bench_cliffs(int argc, char **argv)
{
    static const struct argp_child children[] = {{&bench_settings_argp, 0, NULL, 0}, {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .children = children,
        .doc = "Measures scenes in which one trouble, such as a single primitive far away, may cost far more than it "
               "should. Prints a row for each scene, structure and call: the time, how many times that of the same "
               "scene without the trouble, and how many times Embree's where that is installed; and as comments the "
               "worst rows."};
    cliffs_settings settings = {
        .count = {1000, 10000, 100000, 1000000}, .counts = 4, .steps = 5, .limit_ms = 1000, .worst = 10};
    bench_settings_init(&settings.shared);
    settings.shared.least_files = settings.shared.most_files = 0;
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;
    return run(&settings);
}

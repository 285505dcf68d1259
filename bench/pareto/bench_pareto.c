/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench pareto: time against error of whole frames, in every variant, precision and triangle test; and of the tests
 * of FAST alone. Two tables of tab-separated values, and pictures of both. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench.h"
#include "pareto/bench_pareto.h"

typedef struct pareto_settings {
    bench_settings shared;
    const char *paths[8]; /* files, in the order of the command line */
    char *names[8];       /* of the scenes: the files' names without folder and ending */
    size_t scenes;
    const char *prefix;
} pareto_settings;

enum { MOST_SCENES = sizeof((pareto_settings *)0)->paths / sizeof((pareto_settings *)0)->paths[0] };

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "Output:", 4},
    {"output", 'o', "PREFIX", 0,
     "names of the files to write: PREFIX and PREFIX_tests, each .tsv, .gnuplot, .svg, .png", 4},
    {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse(int key, char *argument, struct argp_state *state)
{
    pareto_settings *settings = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &settings->shared; return 0;
    case 'o': settings->prefix = argument; return 0;
    case ARGP_KEY_ARG:
        if (settings->scenes == MOST_SCENES)
            argp_error(state, "more than %d files: %s", (int)MOST_SCENES, argument);
        settings->paths[settings->scenes++] = argument;
        settings->shared.path = NULL;
        return ARGP_ERR_UNKNOWN; /* the shared options want their one FILE: each in turn */
    case ARGP_KEY_END:
        if (settings->scenes && (!settings->prefix || !*settings->prefix))
            argp_error(state, "-o PREFIX is missing: what the table and the pictures are to be called");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- Table --------------------------------------------------------------------------------------------------- */

/* A file's name without its folder and its ending; to be freed, NULL where memory is refused. */
static char *scene_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *begin = slash ? slash + 1 : path;
    const char *dot = strrchr(begin, '.');
    const size_t length = dot && dot > begin ? (size_t)(dot - begin) : strlen(begin);
    char *name = malloc(length + 1);
    if (!name)
        return NULL;
    for (size_t i = 0; i < length; i++) /* a tab or a line feed would break the table */
        name[i] = (unsigned char)begin[i] < 32 ? '_' : begin[i];
    name[length] = '\0';
    return name;
}

static void write_head(FILE *to)
{
    fprintf(to,
            "scene\tconfig\tvariant\tprecision\ttest\tthreads\tbuild_ms\ttrace_ms\tms\trays\thits\tmissed\tinvented\t"
            "wrong\twrong_share\tt_ulp_median\tt_ulp_p99\tt_ulp_worst\tcost_percent\ttrace_cost_percent\n");
}

static void write_row(const pareto_row *row, const pareto_settings *settings, FILE *to)
{
    const pareto_error *e = &row->error;
    const bench_choice choice = {.variant = row->variant,
                                 .packet = settings->shared.packet,
                                 .precision = row->precision,
                                 .precision_named = 1,
                                 .test = row->test};
    char name[BENCH_NAME_SIZE];
    bench_choice_name(&choice, row->structure, name);
    fprintf(to, "%s\t%s\t%s\t%s\t%s\t%u", settings->names[row->scene], name, row->variant,
            bench_precision_name(row->precision), row->triangles ? bench_triangle_test_name(row->test) : "-",
            (unsigned)row->threads);
    fprintf(to, "\t%.3f\t%.3f\t%.3f", row->build_ms, row->trace_ms, row->ms);
    fprintf(to, "\t%llu\t%llu\t%llu\t%llu\t%llu\t%.3g", (unsigned long long)e->rays, (unsigned long long)e->hits,
            (unsigned long long)e->missed, (unsigned long long)e->invented, (unsigned long long)e->wrong,
            pareto_error_share(e));
    fprintf(to, "\t%u\t%u\t%u", (unsigned)pareto_error_t(e, 0.5), (unsigned)pareto_error_t(e, 0.99),
            (unsigned)e->t_worst);
    fprintf(to, "\t%.1f\t%.1f\n", row->cost, row->trace_cost);
}

static void write_table(const pareto_table *table, const pareto_settings *settings, FILE *to)
{
    write_head(to);
    for (size_t i = 0; i < table->count; i++)
        write_row(&table->rows[i], settings, to);
}

static void write_tests(const pareto_tests *tests, FILE *to)
{
    fprintf(to, "config\ttest\tvariant\tarithmetic\tns_per_test\t"
                "tests\thits\tmissed\tinvented\twrong_share\t"
                "t_ulp_median\tt_ulp_p99\tt_ulp_worst\n");
    for (size_t i = 0; i < tests->count; i++) {
        const pareto_test_row *row = &tests->rows[i];
        const pareto_error *e = &row->error;
        const char *arithmetic = row->spu ? "spu" : "ieee", *test = pareto_test_name(row->test);
        fprintf(to, "test=%s,variant=%s,precision=fast,arithmetic=%s\t%s\t%s\t%s\t%.3f", test, row->variant, arithmetic,
                test, row->variant, arithmetic, row->ns);
        fprintf(to, "\t%llu\t%llu\t%llu\t%llu\t%.3g\t%u\t%u\t%u\n", (unsigned long long)e->rays,
                (unsigned long long)e->hits, (unsigned long long)e->missed, (unsigned long long)e->invented,
                pareto_error_share(e), (unsigned)pareto_error_t(e, 0.5), (unsigned)pareto_error_t(e, 0.99),
                (unsigned)e->t_worst);
    }
}

/* Closes a file that was written; what was not can be said of it then. */
static int close_file(FILE *file, const char *path)
{
    const int failed = ferror(file);
    errno = 0;
    if (fclose(file) || failed) {
        program_error("%s: cannot write: %s", path, strerror(errno ? errno : EIO));
        return PROGRAM_FAILED;
    }
    return PROGRAM_OK;
}

static FILE *open_file(const char *path)
{
    FILE *file = fopen(path, "w");
    if (!file)
        program_error("%s: cannot write: %s", path, strerror(errno));
    return file;
}

/* ---- Command ------------------------------------------------------------------------------------------------- */

static int measure_all(pareto_settings *settings, pareto_table *table)
{
    int code = PROGRAM_OK;
    for (size_t i = 0; i < settings->scenes && code == PROGRAM_OK; i++) {
        settings->names[i] = scene_name(settings->paths[i]);
        if (!settings->names[i]) {
            program_error("out of memory");
            return PROGRAM_FAILED;
        }
        code = pareto_measure(table, &settings->shared, i, settings->paths[i]);
    }
    return code;
}

typedef struct paths {
    char table[4096], tests[4096], tests_prefix[4096];
} paths;

static int make_paths(paths *p, const char *prefix)
{
    if (snprintf(p->table, sizeof p->table, "%s.tsv", prefix) < (int)sizeof p->table &&
        snprintf(p->tests_prefix, sizeof p->tests_prefix, "%s_tests", prefix) < (int)sizeof p->tests_prefix &&
        snprintf(p->tests, sizeof p->tests, "%s_tests.tsv", prefix) < (int)sizeof p->tests)
        return 0;
    program_error("%s: the name is too long", prefix);
    return -1;
}

/* Both tables to their files, the first one to standard output too; then the pictures, and both are tried. */
static int report(const pareto_settings *settings, const pareto_table *table, const pareto_tests *tests,
                  const paths *to, FILE *file)
{
    write_table(table, settings, file);
    write_table(table, settings, stdout);
    fflush(stdout);
    int code = close_file(file, to->table);
    FILE *second = code == PROGRAM_OK ? open_file(to->tests) : NULL;
    if (!second)
        return PROGRAM_FAILED;
    write_tests(tests, second);
    code = close_file(second, to->tests);
    if (code != PROGRAM_OK)
        return code;
    code = pareto_plot(table, (const char *const *)settings->names, settings->scenes, settings->prefix);
    const int drawn = pareto_plot_tests(tests, to->tests_prefix);
    return code == PROGRAM_OK ? drawn : code;
}

/* The table's file is opened first: a folder that is not there is known before anything is measured. */
static int run(pareto_settings *settings, pareto_table *table, pareto_tests *tests)
{
    paths to;
    if (make_paths(&to, settings->prefix))
        return PROGRAM_FAILED;
    FILE *file = open_file(to.table);
    if (!file)
        return PROGRAM_FAILED;
    int code = measure_all(settings, table);
    if (code == PROGRAM_OK)
        code = pareto_measure_tests(tests, &settings->shared);
    if (code == PROGRAM_OK)
        return report(settings, table, tests, &to, file);
    fclose(file);
    remove(to.table);
    return code;
}

int bench_pareto(int argc, char **argv)
{
    static const struct argp_child children[] = {{&bench_settings_argp, 0, NULL, 0}, {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "FILE... -o PREFIX",
        .children = children,
        .doc =
            "Sets time against error: each FILE, a trajectory or a mesh, is traced by one camera in every variant that "
            "the CPU runs, in every precision and with every triangle test, whole frames, the structure built anew. "
            "Hits are compared with those of EXACT. Then the tests of FAST alone, in the SPU's arithmetic too. Writes "
            "tables "
            "and has gnuplot draw them."};
    pareto_settings settings;
    pareto_table table = {NULL, 0};
    pareto_tests tests = {NULL, 0, NULL};

    memset(&settings, 0, sizeof settings);
    bench_settings_init(&settings.shared);
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;
    const int code = run(&settings, &table, &tests);
    for (size_t i = 0; i < settings.scenes; i++)
        free(settings.names[i]);
    pareto_tests_release(&tests);
    free(table.rows);
    return code;
}

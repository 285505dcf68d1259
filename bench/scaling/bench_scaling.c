/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench scaling: the command line, and the points of each sweep. */
#include "scaling/bench_scaling.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "make/bench_procedural.h"

enum { OPTION_PRIMITIVES = 0x500, OPTION_PIXELS, OPTION_MOST_THREADS, OPTION_AT, OPTION_STEPS };
enum { DEFAULT_FRAMES = 5, MOST_POINTS = 4096, MOST_PRIMITIVES = 100000000 };

static const char *const sweeps[SCALING_SWEEPS] = {"primitives", "pixels", "threads"};
static const char *const kinds[SCALING_KINDS] = {"spheres", "triangles"};

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "What grows:", 4},
    {"sweep", 'w', "NAME", 0, "primitives, pixels or threads; may be given several times (default: all)", 4},
    {"kind", 'o', "NAME", 0, "spheres or triangles; may be given twice (default: both)", 4},
    {"primitives", OPTION_PRIMITIVES, "FROM,TO", 0, "default 1000,10000000", 4},
    {"pixels", OPTION_PIXELS, "FROM,TO", 0, "default 100000,33000000, in the aspect ratio of -s", 4},
    {"most-threads", OPTION_MOST_THREADS, "COUNT", 0, "from 1 to COUNT; 0 (default): to one per CPU", 4},
    {"steps", OPTION_STEPS, "COUNT", 0, "points for each factor of ten, 1 to 100 (default 2)", 4},
    {"at", OPTION_AT, "PRIMITIVES", 0, "where they do not grow (default 200000)", 4},
    {NULL, 0, NULL, 0, NULL, 0}};

/* ---- Command line -------------------------------------------------------------------------------------------- */

/* "FROM,TO": whole numbers, the second not below the first. */
static void parse_range(struct argp_state *state, const char *option, const char *text, uint64_t most,
                        uint64_t range[2])
{
    char copy[64], error[PROGRAM_ERROR_SIZE] = "";
    const char *comma = strchr(text, ',');
    const size_t length = comma ? (size_t)(comma - text) : 0;
    uint64_t from = 0, to = 0;
    if (!comma || length >= sizeof copy) {
        argp_error(state, "%s: %s: needs two whole numbers, separated by a comma", option, text);
        return;
    }
    memcpy(copy, text, length);
    copy[length] = '\0';
    if (program_parse_u64(copy, 1, most, &from, error, sizeof error) ||
        program_parse_u64(comma + 1, 1, most, &to, error, sizeof error))
        argp_error(state, "%s: %s", option, error);
    if (from > to)
        argp_error(state, "%s: %s: the first number is above the second", option, text);
    range[0] = from;
    range[1] = to;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    scaling_settings *settings = state->input;
    uint32_t threads = 0;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &settings->shared;
        state->child_inputs[1] = &settings->structure;
        state->child_inputs[2] = &settings->precision;
        return 0;
    case 'w': bench_choose(state, "-w", argument, sweeps, SCALING_SWEEPS, settings->sweep); return 0;
    case 'o': bench_choose(state, "-o", argument, kinds, SCALING_KINDS, settings->kind); return 0;
    case OPTION_PRIMITIVES:
        parse_range(state, "--primitives", argument, MOST_PRIMITIVES, settings->range[SCALING_PRIMITIVES]);
        return 0;
    case OPTION_PIXELS:
        parse_range(state, "--pixels", argument, BENCH_MOST_PIXELS, settings->range[SCALING_PIXELS]);
        return 0;
    case OPTION_MOST_THREADS:
        bench_parse_u32(state, "--most-threads", argument, 0, 1024, &threads);
        settings->range[SCALING_THREADS][1] = threads;
        return 0;
    case OPTION_STEPS: bench_parse_u32(state, "--steps", argument, 1, 100, &settings->steps); return 0;
    case OPTION_AT: bench_parse_u32(state, "--at", argument, 1, MOST_PRIMITIVES, &settings->at); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- Points -------------------------------------------------------------------------------------------------- */

static uint32_t cpus(void)
{
    cgt_context *context = NULL;
    const uint32_t threads = bench_context_create(0, NULL, &context) == CGT_OK ? cgt_context_get_threads(context) : 1;
    cgt_context_release(context);
    return threads ? threads : 1;
}

/* Sets width and height: `pixels` pixels in the aspect ratio of the settings' picture. */
static void set_pixels(const scaling_settings *settings, uint64_t pixels, scaling_point *point)
{
    const double aspect = (double)settings->shared.width / settings->shared.height;
    const double height = sqrt((double)pixels / aspect);
    point->height = height < 1.0 ? 1 : (uint32_t)lround(height);
    point->width = height * aspect < 1.0 ? 1 : (uint32_t)lround(height * aspect);
}

/* The size after `size`: 0 after the last one. */
static uint64_t next_size(const scaling_settings *settings, scaling_sweep sweep, uint64_t first, uint64_t size,
                          uint64_t last, uint32_t step)
{
    if (size >= last)
        return 0;
    const double grown = (double)first * pow(10.0, (double)step / settings->steps);
    uint64_t next = sweep == SCALING_THREADS ? size + 1 : (uint64_t)llround(grown);
    if (next <= size)
        next = size + 1;
    /* a size close to the last one becomes the last one */
    return (double)next > 0.999 * (double)last ? last : next;
}

static void make_point(const scaling_settings *settings, scaling_sweep sweep, scaling_kind kind, uint64_t size,
                       scaling_point *point)
{
    memset(point, 0, sizeof *point);
    point->sweep = sweep;
    point->kind = kind;
    point->primitives = settings->at;
    point->width = settings->shared.width;
    point->height = settings->shared.height;
    point->threads = settings->shared.threads;
    if (sweep == SCALING_PRIMITIVES)
        point->primitives = (uint32_t)size;
    else if (sweep == SCALING_PIXELS)
        set_pixels(settings, size, point);
    else
        point->threads = (uint32_t)size;
}

/* The points of one sweep; *count grows. */
static int run_sweep(const scaling_settings *settings, scaling_sweep sweep, scaling_kind kind, bench_table *table,
                     scaling_point *points, size_t *count)
{
    const uint64_t first = settings->range[sweep][0];
    const uint64_t last = settings->range[sweep][1] ? settings->range[sweep][1] : cpus();
    const size_t before = *count;
    int code = PROGRAM_OK;
    uint32_t step = 0;
    for (uint64_t size = first; size && code == PROGRAM_OK && *count < MOST_POINTS;) {
        scaling_point *point = &points[*count];
        make_point(settings, sweep, kind, size, point);
        code = scaling_measure(settings, point);
        if (code == PROGRAM_OK) {
            scaling_table_row(table, point, *count > before ? point - 1 : NULL);
            ++*count;
        }
        size = next_size(settings, sweep, first, size, last, ++step);
    }
    return code;
}

static int run(const scaling_settings *settings)
{
    scaling_point *points = calloc(MOST_POINTS, sizeof *points);
    bench_table *table = points ? bench_table_open(settings->shared.json_path) : NULL;
    int code = table ? PROGRAM_OK : PROGRAM_FAILED;
    size_t count = 0;
    if (!points)
        program_error("out of memory");
    for (int sweep = 0; sweep < SCALING_SWEEPS; sweep++)
        for (int kind = 0; kind < SCALING_KINDS && code == PROGRAM_OK; kind++)
            if (bench_is_chosen(settings->sweep, SCALING_SWEEPS, sweep) &&
                bench_is_chosen(settings->kind, SCALING_KINDS, kind))
                code = run_sweep(settings, (scaling_sweep)sweep, (scaling_kind)kind, table, points, &count);
    if (code == PROGRAM_OK)
        scaling_table_exponents(table, points, count);
    if (bench_table_close(table))
        code = PROGRAM_FAILED;
    free(points);
    return code;
}

int bench_scaling(int argc, char **argv)
{
    static const struct argp_child children[] = {{&bench_settings_argp, 0, NULL, 0},
                                                 {&bench_structure_argp, 0, NULL, 0},
                                                 {&bench_precision_argp, 0, NULL, 0},
                                                 {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .children = children,
        .doc =
            "Measures frames of clouds of spheres and of bumpy balls of triangles, made in memory, while the number of "
            "primitives, of pixels or of threads grows and all else stays. Prints a row for each size: medians and "
            "shortest times over the frames (-n, default 5), exponents of growth from row to row, memory, and how "
            "often the library allocated in the frames that count; and as comments the exponents over a whole "
            "sweep."};
    scaling_settings settings = {.range = {{1000, 10000000}, {100000, 33000000}, {1, 0}}, .at = 200000, .steps = 2};
    bench_settings_init(&settings.shared);
    bench_settings_use_procedural_camera(&settings.shared);
    settings.shared.least_files = settings.shared.most_files = 0;
    settings.shared.frames = DEFAULT_FRAMES;
    settings.structure.most = 1;
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;
    if (settings.shared.frames > SIZE_MAX / sizeof(double) / settings.shared.repeat) {
        program_error("-n, -r: too many frames");
        return PROGRAM_USAGE;
    }
    return run(&settings);
}

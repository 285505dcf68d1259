/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Command-line options that sub-commands share. */
#include <assert.h>
#include <stdio.h>
#include <string.h>

#include "common/bench.h"
#include "rays/bench_rays.h"

enum { OPTION_VARIANT = 0x100, OPTION_RADIUS, OPTION_WRAPPED };
enum { OPTION_LAYOUT = 0x180, OPTION_BREAK, OPTION_TRAVERSAL };

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "Scene and camera:", 1},
    {"camera", 'c', "EX,EY,EZ,TX,TY,TZ,UX,UY,UZ,FOV", 0,
     "eye, target, up, vertical angle in degrees (default 0,0,-5,0,0,0,0,1,0,45)", 1},
    {"size", 's', "WxH", 0, "pixels (default 1280x720)", 1},
    {"frames", 'n', "COUNT", 0, "the first COUNT frames of the file (default: all)", 1},
    {"radius", OPTION_RADIUS, "R", 0, "radius of spheres in files that have none", 1},
    {"wrapped", OPTION_WRAPPED, NULL, 0, "prefer wrapped coordinates where a file has both kinds", 1},
    {NULL, 0, NULL, 0, "Library:", 2},
    {"threads", 't', "COUNT", 0, "threads, 0 for one per CPU (default 1)", 2},
    {"variant", OPTION_VARIANT, "NAME", 0, "instruction set, as the library names it", 2},
    {"packet", 'k', "EDGE", 0, "pixels along a packet's edge: 4, 8 or 16", 2},
    {"grid", 'g', "NX,NY,NZ", 0, "cells of the grid along x, y and z", 2},
    {NULL, 0, NULL, 0, "Measurement:", 3},
    {"repeat", 'r', "COUNT", 0, "measure COUNT times", 3},
    {"verbose", 'v', NULL, 0, "report on standard error what the library chose", 3},
    {"json", 'j', "FILE", 0, "write the rows as JSON, too", 3},
    {NULL, 0, NULL, 0, NULL, 0}};

void bench_settings_init(bench_settings *settings)
{
    memset(settings, 0, sizeof *settings);
    cgt_camera_init(&settings->camera);
    settings->camera.eye[2] = -5.0f;
    settings->width = 1280;
    settings->height = 720;
    settings->threads = 1;
    settings->repeat = 1;
    settings->least_files = settings->most_files = 1;
}

void bench_settings_use_procedural_camera(bench_settings *settings)
{
    char error[PROGRAM_ERROR_SIZE] = "";
    const int failed = program_parse_camera(BENCH_PROCEDURAL_CAMERA, &settings->camera, error, sizeof error);
    assert(!failed);
    (void)failed;
}

/* ---- Values -------------------------------------------------------------------------------------------------- */

static int parse_size(const char *text, bench_settings *settings, char *error, size_t error_size)
{
    uint32_t width = 0, height = 0;
    if (program_parse_size(text, &width, &height, error, error_size))
        return -1;
    if ((uint64_t)width * height > BENCH_MOST_PIXELS) {
        snprintf(error, error_size, "%s: more than %lu pixels", text, (unsigned long)BENCH_MOST_PIXELS);
        return -1;
    }
    settings->width = width;
    settings->height = height;
    return 0;
}

static int parse_packet(const char *text, uint32_t *packet, char *error, size_t error_size)
{
    uint32_t edge = 0;
    if (program_parse_u32(text, 4, 16, &edge, error, error_size))
        return -1;
    if (edge != 4 && edge != 8 && edge != 16) {
        snprintf(error, error_size, "%s: packets are 4, 8 or 16 pixels wide", text);
        return -1;
    }
    *packet = edge;
    return 0;
}

/* "nx,ny,nz". The library checks the product. */
static int parse_grid(const char *text, uint32_t resolution[3], char *error, size_t error_size)
{
    char copy[64];
    uint32_t cells[3];
    const size_t length = strlen(text);
    if (length >= sizeof copy) {
        snprintf(error, error_size, "%s: too long", text);
        return -1;
    }
    memcpy(copy, text, length + 1);
    char *part = copy;
    for (int axis = 0; axis < 3; axis++) {
        char *comma = strchr(part, ',');
        if ((axis < 2) != (comma != NULL)) {
            snprintf(error, error_size, "%s: needs three whole numbers, separated by commas", text);
            return -1;
        }
        if (comma)
            *comma = '\0';
        if (program_parse_u32(part, 1, 1024, &cells[axis], error, error_size))
            return -1;
        part = comma ? comma + 1 : part;
    }
    memcpy(resolution, cells, sizeof cells);
    return 0;
}

/* The name of a variant of this build. Whether the CPU runs it shows when the context is created. */
static int parse_variant(const char *text, const char **variant, char *error, size_t error_size)
{
    const char *const *names = cgt_get_variant_names();
    size_t length = (size_t)snprintf(error, error_size, "%s: this build has", text);
    for (; *names; names++) {
        if (!strcmp(text, *names)) {
            *variant = *names;
            return 0;
        }
        if (length < error_size)
            length += (size_t)snprintf(error + length, error_size - length, " %s", *names);
    }
    return -1;
}

void bench_parse_u32(struct argp_state *state, const char *option, const char *text, uint32_t least, uint32_t most,
                     uint32_t *value)
{
    char error[PROGRAM_ERROR_SIZE] = "";
    if (program_parse_u32(text, least, most, value, error, sizeof error))
        argp_error(state, "%s: %s", option, error);
}

static void add_file(bench_settings *settings, struct argp_state *state, const char *path)
{
    if (settings->most_files == 0)
        argp_error(state, "this sub-command takes no FILE: %s", path);
    else if (settings->files == settings->most_files && settings->most_files == 1)
        argp_error(state, "one FILE only: %s", path);
    else if (settings->files == settings->most_files)
        argp_error(state, "more than %u files: %s", (unsigned)settings->most_files, path);
    else
        settings->paths[settings->files++] = path;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    bench_settings *settings = state->input;
    char error[PROGRAM_ERROR_SIZE] = "";
    int failed = 0;

    switch (key) {
    case 'c': failed = program_parse_camera(argument, &settings->camera, error, sizeof error); break;
    case 's': failed = parse_size(argument, settings, error, sizeof error); break;
    case 'n': failed = program_parse_u64(argument, 1, UINT64_MAX, &settings->frames, error, sizeof error); break;
    case 't': failed = program_parse_u32(argument, 0, 1024, &settings->threads, error, sizeof error); break;
    case 'k': failed = parse_packet(argument, &settings->packet, error, sizeof error); break;
    case 'g': failed = parse_grid(argument, settings->resolution, error, sizeof error); break;
    case 'r': failed = program_parse_u32(argument, 1, 1000000, &settings->repeat, error, sizeof error); break;
    case 'v': settings->verbose = 1; break;
    case OPTION_VARIANT: failed = parse_variant(argument, &settings->variant, error, sizeof error); break;
    case OPTION_RADIUS:
        failed = program_parse_float(argument, 0.0f, 1e30f, &settings->radius, error, sizeof error);
        break;
    case OPTION_WRAPPED: settings->wrapped = 1; break;
    case 'j': settings->json_path = argument; break;
    case ARGP_KEY_ARG: add_file(settings, state, argument); break;
    case ARGP_KEY_END:
        if (settings->files < settings->least_files)
            argp_error(state, "FILE is missing");
        break;
    default: return ARGP_ERR_UNKNOWN;
    }
    if (failed) {
        if (key < OPTION_VARIANT)
            argp_error(state, "-%c: %s", key, error);
        else
            argp_error(state, "--%s: %s", key == OPTION_VARIANT ? "variant" : "radius", error);
    }
    return 0;
}

const struct argp bench_settings_argp = {.options = options, .parser = parse};

/* ---- Lists of names ------------------------------------------------------------------------------------------ */

int bench_next_name(const char **list, char name[BENCH_LISTED_SIZE])
{
    if (!*list)
        return 0;
    const size_t length = strcspn(*list, ",");
    snprintf(name, BENCH_LISTED_SIZE, "%.*s", length < BENCH_LISTED_SIZE ? (int)length : BENCH_LISTED_SIZE, *list);
    *list = (*list)[length] ? *list + length + 1 : NULL;
    return 1;
}

static void refuse_name(struct argp_state *state, const char *option, const char *name, const char *const *names,
                        int count)
{
    char known[1024] = "";
    size_t length = 0;
    for (int i = 0; i < count && length < sizeof known; i++)
        length += (size_t)snprintf(known + length, sizeof known - length, "%s%s", i ? ", " : "", names[i]);
    argp_error(state, "%s: %s%s; there are %s", option, *name ? "no " : "an empty name", name, known);
}

void bench_choose(struct argp_state *state, const char *option, const char *list, const char *const *names, int count,
                  int *chosen)
{
    char name[BENCH_LISTED_SIZE];
    while (bench_next_name(&list, name)) {
        int i = 0;
        while (i < count && strcmp(name, names[i]) != 0)
            i++;
        if (i == count)
            refuse_name(state, option, name, names, count);
        else
            chosen[i] = 1;
    }
}

int bench_is_chosen(const int *chosen, int count, int which)
{
    int any = 0;
    for (int i = 0; i < count; i++)
        any |= chosen[i];
    return !any || chosen[which];
}

/* ---- Variants ------------------------------------------------------------------------------------------------ */

static int is_runnable(const char *variant)
{
    cgt_context *context = NULL;
    const cgt_result result = bench_context_create(1, variant, &context);
    cgt_context_release(context);
    return result == CGT_OK;
}

size_t bench_variants(const bench_settings *settings, const char *variants[BENCH_MOST_VARIANTS])
{
    size_t count = 0;
    if (settings->variant) {
        variants[0] = settings->variant;
        return 1;
    }
    for (const char *const *name = cgt_get_variant_names(); *name && count < BENCH_MOST_VARIANTS; name++) {
        if (is_runnable(*name))
            variants[count++] = *name;
        else
            fprintf(stderr, "variant %s left out: this CPU lacks it\n", *name);
    }
    return count;
}

/* ---- Structure ----------------------------------------------------------------------------------------------- */

#define STRUCTURES "auto, queue-grid, loose-grid, kd, kd-ropes, bih or bvh"

static const struct argp_option structure_options[] = {
    {NULL, 0, NULL, 0, "Structure:", 6},
    {"structure", 'S', "NAME", 0, STRUCTURES "; a list with commas where several are compared", 6},
    {"kd-layout", OPTION_LAYOUT, "NAME", 0, "of their nodes: depth-first, breadth-first or mixed", 6},
    {"kd-break", OPTION_BREAK, "LEVELS", 0, "of mixed: levels stored breadth first, 1 to 50", 6},
    {"kd-traversal", OPTION_TRAVERSAL, "NAME", 0, "single or packet", 6},
    {NULL, 0, NULL, 0, NULL, 0}};

static void add_structure(bench_structure_settings *settings, struct argp_state *state, const char *name)
{
    cgt_structure structure = CGT_STRUCTURE_AUTO;
    if (bench_structure_find(name, &structure))
        argp_error(state, "--structure: " STRUCTURES ", not %s", name);
    for (size_t i = 0; i < settings->count; i++)
        if (settings->requested[i] == structure)
            return;
    if (settings->count == settings->most)
        argp_error(state, "--structure: %s: at most %zu can be named", name, settings->most);
    else
        settings->requested[settings->count++] = structure;
}

static void add_structures(bench_structure_settings *settings, struct argp_state *state, const char *list)
{
    char name[BENCH_LISTED_SIZE];
    while (bench_next_name(&list, name))
        add_structure(settings, state, name);
}

static error_t parse_structure(int key, char *argument, struct argp_state *state)
{
    bench_structure_settings *settings = state->input;
    bench_kd_choice *kd = &settings->kd;
    switch (key) {
    case 'S': add_structures(settings, state, argument); return 0;
    case OPTION_LAYOUT:
        if (bench_kd_layout_find(argument, &kd->layout))
            argp_error(state, "--kd-layout: auto, depth-first, breadth-first or mixed, not %s", argument);
        return 0;
    case OPTION_BREAK: bench_parse_u32(state, "--kd-break", argument, 1, 50, &kd->break_level); return 0;
    case OPTION_TRAVERSAL:
        if (bench_kd_traversal_find(argument, &kd->traversal))
            argp_error(state, "--kd-traversal: auto, single or packet, not %s", argument);
        return 0;
    case ARGP_KEY_END:
        if (kd->break_level && kd->layout != CGT_KD_LAYOUT_MIXED)
            argp_error(state, "--kd-break: only with --kd-layout mixed");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

const struct argp bench_structure_argp = {.options = structure_options, .parser = parse_structure};

/* ---- Precision ----------------------------------------------------------------------------------------------- */

enum { OPTION_TEST = 0x1c0 };

static const struct argp_option precision_options[] = {
    {NULL, 0, NULL, 0, "Precision:", 7},
    {"precision", 'p', "NAME", 0, "robust (default), fast or exact", 7},
    {"test", OPTION_TEST, "NAME", 0, "of triangles with -p fast: watertight, moller-trumbore or accelerated", 7},
    {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse_precision(int key, char *argument, struct argp_state *state)
{
    bench_precision_settings *settings = state->input;
    switch (key) {
    case 'p':
        if (bench_precision_find(argument, &settings->precision))
            argp_error(state, "-p: robust, fast or exact, not %s", argument);
        settings->named = 1;
        return 0;
    case OPTION_TEST:
        if (bench_triangle_test_find(argument, &settings->test))
            argp_error(state, "--test: watertight, moller-trumbore or accelerated, not %s", argument);
        return 0;
    case ARGP_KEY_END:
        if (settings->test != CGT_TRIANGLE_TEST_AUTO && settings->precision != CGT_PRECISION_FAST)
            argp_error(state, "--test %s: only with -p fast", bench_triangle_test_name(settings->test));
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

const struct argp bench_precision_argp = {.options = precision_options, .parser = parse_precision};

/* ---- Secondary rays ------------------------------------------------------------------------------------------ */

static const struct argp_option secondary_options[] = {
    {NULL, 0, NULL, 0, "Secondary rays:", 5},
    {"light", 'l', "X,Y,Z", 0, "trace a shadow ray from every hit to this point", 5},
    {"ao", 'a', "RAYS", 0, "trace RAYS ambient-occlusion rays from every hit, at most 1024", 5},
    {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse_secondary(int key, char *argument, struct argp_state *state)
{
    bench_secondary_settings *settings = state->input;
    char error[PROGRAM_ERROR_SIZE] = "";
    switch (key) {
    case 'l':
        if (program_parse_floats(argument, 3, settings->light, error, sizeof error))
            argp_error(state, "-l: %s", error);
        settings->lit = 1;
        return 0;
    case 'a': bench_parse_u32(state, "-a", argument, 0, BENCH_MOST_AO_RAYS, &settings->ao); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

const struct argp bench_secondary_argp = {.options = secondary_options, .parser = parse_secondary};

/* ---- Choice -------------------------------------------------------------------------------------------------- */

bench_choice bench_choice_of(const bench_settings *settings, const bench_structure_settings *structure,
                             const bench_precision_settings *precision)
{
    bench_choice choice = {.variant = settings->variant, .packet = settings->packet};
    if (structure)
        choice.kd = structure->kd;
    if (precision) {
        choice.precision = precision->precision;
        choice.precision_named = precision->named;
        choice.test = precision->test;
    }
    return choice;
}

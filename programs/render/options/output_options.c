/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Options about movies and sharing; see output_options.h. */
#define _GNU_SOURCE /* argp */
#include "render/options/output_options.h"

#include <stdio.h>
#include <string.h>

#include "common/program.h"

enum { OPTION_RATE = 512, OPTION_QUALITY, OPTION_PRESET, OPTION_PART, OPTION_SURVEY };

static const struct argp_option table[] = {
    {NULL, 0, NULL, 0, "Movies and several processes:", 6},
    {"rate", OPTION_RATE, "N", 0, "Frames per second of movies; default 30", 0},
    {"quality", OPTION_QUALITY, "N", 0,
     "Quality of movies and .jpg, 1 (smallest files) to 100 (best); default 80 of movies, 92 of .jpg", 0},
    {"preset", OPTION_PRESET, "NAME", 0,
     "Effort of x264, from ultrafast to veryslow: smaller files for more time; default veryfast", 0},
    {"part", OPTION_PART, "K/N", 0,
     "Render the Kth of N parts of the run, with the names, camera and colours of the whole: for N processes that know "
     "nothing of each other. mpirun -n N cgt-render ... shares a run among N processes by itself",
     0},
    {"survey", OPTION_SURVEY, "N", 0,
     "Look only at the first N frames for automatic camera and colours; default: at all, which reads the input twice",
     0},
    {NULL, 0, NULL, 0, NULL, 0}};

void output_options_init(output_options *options)
{
    memset(options, 0, sizeof *options);
    options->survey = UINT64_MAX;
}

/* "2/5". */
static int parse_part(const char *text, output_options *o, char *error, size_t error_size)
{
    char first[16];
    const char *const slash = strchr(text, '/');
    uint32_t part, parts;
    if (!slash || (size_t)(slash - text) >= sizeof first) {
        snprintf(error, error_size, "\"%.80s\" is not of the form 2/5", text);
        return -1;
    }
    memcpy(first, text, (size_t)(slash - text));
    first[slash - text] = '\0';
    if (program_parse_u32(slash + 1, 1, 1000000, &parts, error, error_size) ||
        program_parse_u32(first, 1, parts, &part, error, error_size))
        return -1;
    o->part = part;
    o->parts = parts;
    return 0;
}

static int parse_preset(const char *text, const char **preset, char *error, size_t error_size)
{
    static const char *const names[] = {"ultrafast", "superfast", "veryfast", "faster",  "fast",
                                        "medium",    "slow",      "slower",   "veryslow"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(text, names[i]) == 0) {
            *preset = names[i];
            return 0;
        }
    snprintf(error, error_size,
             "\"%.80s\" is not ultrafast, superfast, veryfast, faster, fast, medium, slow, slower or "
             "veryslow",
             text);
    return -1;
}

static int parse(int key, const char *arg, output_options *o, char *error, size_t size)
{
    uint32_t quality;
    float rate;
    switch (key) {
    case OPTION_RATE:
        if (program_parse_float(arg, 1e-3f, 1000.0f, &rate, error, size))
            return -1;
        o->rate = (double)rate;
        return 0;
    case OPTION_QUALITY:
        if (program_parse_u32(arg, 1, 100, &quality, error, size))
            return -1;
        o->quality = (int)quality;
        return 0;
    case OPTION_PRESET: return parse_preset(arg, &o->preset, error, size);
    case OPTION_PART: return parse_part(arg, o, error, size);
    case OPTION_SURVEY: return program_parse_u64(arg, 1, UINT64_MAX - 1, &o->survey, error, size);
    default: return 1;
    }
}

static error_t parse_key(int key, char *arg, struct argp_state *state)
{
    char error[PROGRAM_ERROR_SIZE];
    const int result = parse(key, arg, state->input, error, sizeof error);
    if (result < 0) {
        const struct argp_option *row = table;
        while (row->key != key)
            row++;
        argp_error(state, "--%s: %s", row->name, error);
    }
    return result == 1 ? ARGP_ERR_UNKNOWN : 0;
}

const struct argp output_options_argp = {table, parse_key, NULL, NULL, NULL, NULL, NULL};

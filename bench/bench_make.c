/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench make: procedural scenes as .frames, so that every figure can be made again without a simulator.
 *   cloudN   N spheres spread evenly over a box of 3.56 x 2 x 2, their radii 0.3 to 0.5 of the mean spacing, each on a
 *            small closed path of its own; the same file on every machine with IEEE arithmetic and the same sinf */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "trajectory.h"

typedef struct make_settings {
    const char *scene, *path;
    uint32_t frames;
} make_settings;

static const struct cloud {
    const char *name;
    uint32_t spheres;
} clouds[] = {{"cloud2k", 2000}, {"cloud20k", 20000}, {"cloud200k", 200000}, {"cloud1m", 1000000}};

/* Marsaglia's xorshift of 64 bits, its 24 upper bits as a number from 0 up to 1. */
static float next_uniform(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return (float)(*state >> 40) * 0x1p-24f;
}

static const struct argp_option options[] = {{"frames", 'n', "COUNT", 0, "frames to write (default 6)", 0},
                                             {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse(int key, char *argument, struct argp_state *state)
{
    make_settings *settings = state->input;
    char error[PROGRAM_ERROR_SIZE] = "";
    switch (key) {
    case 'n':
        if (program_parse_u32(argument, 1, 1000000, &settings->frames, error, sizeof error))
            argp_error(state, "-n: %s", error);
        return 0;
    case ARGP_KEY_ARG:
        if (state->arg_num == 0)
            settings->scene = argument;
        else if (state->arg_num == 1)
            settings->path = argument;
        else
            argp_error(state, "one SCENE and one FILE, not %s too", argument);
        return 0;
    case ARGP_KEY_END:
        if (state->arg_num < 2)
            argp_error(state, "SCENE and FILE.frames are wanted");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* Places the spheres, x y z r each, and their phases. */
static void place(float *rest, float *phase, uint32_t count, float spacing)
{
    static const float half[3] = {1.78f, 1, 1};
    uint64_t state = 88172645463325252u;
    for (int i = 0; i < 256; i++)
        next_uniform(&state); /* the start of the sequence is left out */
    for (uint32_t i = 0; i < count; i++) {
        float *q = rest + 4 * (size_t)i;
        q[3] = 0.5f * spacing * (0.6f + 0.4f * next_uniform(&state));
        for (int a = 0; a < 3; a++)
            q[a] = (next_uniform(&state) * 2 - 1) * half[a];
        phase[i] = 6.28f * next_uniform(&state);
    }
}

static void move(float *now, const float *rest, const float *phase, uint32_t count, float reach, uint32_t frame)
{
    for (uint32_t i = 0; i < count; i++) {
        const float *q = rest + 4 * (size_t)i, p = phase[i] + 0.35f * (float)frame;
        float *d = now + 4 * (size_t)i;
        d[0] = q[0] + reach * sinf(p);
        d[1] = q[1] + reach * cosf(p * 1.3f);
        d[2] = q[2] + reach * sinf(p * 0.7f + 1);
        d[3] = q[3];
    }
}

static int write_cloud(const make_settings *settings, uint32_t count, float *memory)
{
    const float spacing = cbrtf(14.2f / (float)count);
    float *rest = memory, *now = rest + 4 * (size_t)count, *phase = now + 4 * (size_t)count;
    char error[PROGRAM_ERROR_SIZE] = "";
    frames_writer *writer = frames_writer_open(settings->path, error, sizeof error);
    int failed = !writer;
    place(rest, phase, count, spacing);
    for (uint32_t frame = 0; !failed && frame < settings->frames; frame++) {
        move(now, rest, phase, count, 0.3f * spacing, frame);
        failed = frames_writer_add(writer, now, count, error, sizeof error) != 0;
    }
    char ignored[PROGRAM_ERROR_SIZE];
    const int open = writer != NULL;
    if (frames_writer_close(writer, failed ? ignored : error, PROGRAM_ERROR_SIZE))
        failed = 1;
    if (!failed)
        return PROGRAM_OK;
    program_error("%s", error);
    if (open)
        remove(settings->path); /* no half file */
    return PROGRAM_FAILED;
}

int bench_make(int argc, char **argv)
{
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "SCENE FILE.frames",
        .doc = "Writes a procedural scene of moving spheres. SCENE: cloud2k, cloud20k, cloud200k, cloud1m."};
    make_settings settings = {NULL, NULL, 6};
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;
    for (size_t i = 0; i < sizeof clouds / sizeof clouds[0]; i++) {
        if (strcmp(settings.scene, clouds[i].name) != 0)
            continue;
        float *memory = calloc(clouds[i].spheres, 9 * sizeof(float));
        const int code = memory ? write_cloud(&settings, clouds[i].spheres, memory) : PROGRAM_FAILED;
        if (!memory)
            program_error("out of memory for %u spheres", (unsigned)clouds[i].spheres);
        free(memory);
        return code;
    }
    program_error("no scene %s: cloud2k, cloud20k, cloud200k or cloud1m", settings.scene);
    return PROGRAM_USAGE;
}

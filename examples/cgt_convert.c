/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-convert: any trajectory that the readers know, to .frames. The output is written beside its final name and moved
 * there when it is whole, so that a run that fails leaves what was there before. */
#define _GNU_SOURCE /* argp */
#include "program.h"
#include "trajectory.h"

#include <argp.h>
#include <errno.h>
#include <float.h>
#include <inttypes.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct convert_options {
    const char *input;
    const char *output;
    trajectory_options reading;
    uint64_t first, last, every; /* frames to convert, from 0; last included */
    int quiet;
} convert_options;

typedef struct convert_counts {
    uint64_t frames;
    uint64_t spheres;
    uint32_t fewest, most; /* spheres of a frame */
} convert_counts;

/* ---- Options ------------------------------------------------------------------------------------------------ */

enum { OPTION_WRAPPED = 256, OPTION_FIRST, OPTION_LAST, OPTION_EVERY };

static const struct argp_option option_table[] = {
    {"radius", 'r', "R", 0,
     "Radius of spheres that the file gives none, in world units (default: 0.5; in .xyz the "
     "element's van der Waals radius in Angstrom)",
     0},
    {"wrapped", OPTION_WRAPPED, NULL, 0,
     "Prefer coordinates wrapped into the periodic box (x y z) to unwrapped ones "
     "(xu yu zu) where a file has both",
     0},
    {"first", OPTION_FIRST, "N", 0, "First frame to convert, counted from 0 (default: 0)", 0},
    {"last", OPTION_LAST, "N", 0, "Last frame to convert (default: the file's last)", 0},
    {"every", OPTION_EVERY, "N", 0, "Convert every Nth frame (default: 1)", 0},
    {"quiet", 'q', NULL, 0, "Print nothing but errors", 0},
    {0},
};

static error_t parse_option(int key, char *arg, struct argp_state *state)
{
    convert_options *const o = state->input;
    char error[PROGRAM_ERROR_SIZE];
    int wrong = 0;
    const char *name = "";
    switch (key) {
    case 'r':
        name = "-r";
        wrong = program_parse_float(arg, FLT_MIN, 1e30f, &o->reading.radius, error, sizeof error);
        break;
    case 'q': o->quiet = 1; break;
    case OPTION_WRAPPED: o->reading.wrapped = 1; break;
    case OPTION_FIRST:
        name = "--first";
        wrong = program_parse_u64(arg, 0, UINT32_MAX, &o->first, error, sizeof error);
        break;
    case OPTION_LAST:
        name = "--last";
        wrong = program_parse_u64(arg, 0, UINT32_MAX, &o->last, error, sizeof error);
        break;
    case OPTION_EVERY:
        name = "--every";
        wrong = program_parse_u64(arg, 1, UINT32_MAX, &o->every, error, sizeof error);
        break;
    case ARGP_KEY_ARG:
        if (state->arg_num >= 2) {
            argp_error(state, "'%s': only an input and an output are expected", arg);
        }
        *(state->arg_num == 0 ? &o->input : &o->output) = arg;
        break;
    case ARGP_KEY_END:
        if (state->arg_num < 2) {
            argp_error(state, "an input and an output are needed");
        }
        break;
    default: return ARGP_ERR_UNKNOWN;
    }
    if (wrong) {
        argp_error(state, "%s: %s", name, error);
    }
    return 0;
}

static const char documentation[] =
    "Converts a trajectory of spheres to .frames.\v"
    "INPUT is LAMMPS dump text (.lammpstrj, .dump), .xyz (.extxyz) or .frames; OUTPUT ends in .frames. An existing "
    "OUTPUT is replaced when the new one is complete, and left alone otherwise.\n\n"
    "Exit status: 0 done, 1 a file or memory failed, 2 wrong usage.";

static const struct argp parser = {option_table, parse_option, "INPUT OUTPUT.frames", documentation, NULL, NULL, NULL};

static void check_options(const convert_options *o)
{
    const size_t length = strlen(o->output);
    if (length < 8 || strcasecmp(o->output + length - 7, ".frames") != 0) {
        program_error("'%s': the output's name must end in .frames", o->output);
        exit(PROGRAM_USAGE);
    }
    if (o->first > o->last) {
        program_error("--first %" PRIu64 " is after --last %" PRIu64, o->first, o->last);
        exit(PROGRAM_USAGE);
    }
}

/* ---- The output's two names --------------------------------------------------------------------------------- */

typedef struct output_file {
    char *target;    /* where it goes: links resolved, so that a link stays one */
    char *temporary; /* in the same folder, so that it can be moved in one step */
    mode_t mode;
    int created; /* the temporary file is there */
} output_file;

/* The temporary file that an interrupt has to remove; NULL while there is none. */
static const char *volatile unfinished;

static void on_interrupt(int number)
{
    const char *name = unfinished;
    if (name != NULL) {
        unlink(name);
    }
    signal(number, SIG_DFL);
    raise(number);
}

static void catch_interrupts(void)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        struct sigaction action;
        if (sigaction(numbers[i], NULL, &action) == 0 && action.sa_handler != SIG_IGN) {
            memset(&action, 0, sizeof action);
            action.sa_handler = on_interrupt;
            sigaction(numbers[i], &action, NULL);
        }
    }
}

/* Finds the target and its mode. Returns 0 or -1 with a message. */
static int find_target(const char *name, output_file *file)
{
    struct stat status;
    if (stat(name, &status) == 0) {
        if (!S_ISREG(status.st_mode)) {
            program_error("%s: not a regular file", name);
            return -1;
        }
        file->mode = status.st_mode & 07777;
        file->target = realpath(name, NULL);
    } else {
        const mode_t mask = umask(0);
        umask(mask);
        file->mode = 0666 & ~mask;
        file->target = strdup(name);
    }
    if (file->target == NULL) {
        program_error("%s: %s", name, strerror(errno));
        return -1;
    }
    return 0;
}

/* Creates the temporary file. Returns 0 or -1 with a message. */
static int output_begin(const char *name, output_file *file)
{
    if (find_target(name, file)) {
        return -1;
    }
    const size_t size = strlen(file->target) + sizeof ".XXXXXX";
    file->temporary = malloc(size);
    if (file->temporary == NULL) {
        program_error("%s: not enough memory", name);
        return -1;
    }
    snprintf(file->temporary, size, "%s.XXXXXX", file->target);
    const int descriptor = mkstemp(file->temporary);
    if (descriptor < 0) {
        program_error("%s: %s", name, strerror(errno));
        return -1;
    }
    close(descriptor);
    file->created = 1;
    unfinished = file->temporary;
    return 0;
}

/* Moves the file to its name, or removes it. Returns the exit code. */
static int output_end(output_file *file, int code)
{
    if (file->created && code == PROGRAM_OK) {
        if (chmod(file->temporary, file->mode) != 0 || rename(file->temporary, file->target) != 0) {
            program_error("%s: %s", file->target, strerror(errno));
            code = PROGRAM_FAILED;
        }
    }
    if (file->created && code != PROGRAM_OK) {
        unlink(file->temporary);
    }
    unfinished = NULL;
    free(file->temporary);
    free(file->target);
    return code;
}

/* ---- Converting --------------------------------------------------------------------------------------------- */

static int copy_frame(trajectory *t, frames_writer *w, convert_counts *counts, char *error, size_t error_size)
{
    trajectory_frame frame;
    const int got = trajectory_read(t, &frame, error, error_size);
    if (got <= 0) {
        return got;
    }
    if (frames_writer_add(w, frame.xyzr, frame.count, error, error_size)) {
        return -1;
    }
    counts->fewest = counts->frames == 0 || frame.count < counts->fewest ? frame.count : counts->fewest;
    counts->most = frame.count > counts->most ? frame.count : counts->most;
    counts->frames++;
    counts->spheres += frame.count;
    return 1;
}

/* Copies the frames that were asked for. Returns 0 or -1 with a text. */
static int copy_frames(const convert_options *o, trajectory *t, frames_writer *w, convert_counts *counts, char *error,
                       size_t error_size)
{
    program_progress progress;
    program_progress_start(&progress, "converting", "frames", 0.0, o->quiet);
    int got = 1;
    for (uint64_t number = 0; number <= o->last && got > 0; number++) {
        const int wanted = number >= o->first && (number - o->first) % o->every == 0;
        got = wanted ? copy_frame(t, w, counts, error, error_size) : trajectory_skip(t, error, error_size);
        program_progress_update(&progress, (double)counts->frames, trajectory_progress(t));
    }
    program_progress_end(&progress);
    return got < 0 ? -1 : 0;
}

/* Reads from t into the file `name`. Returns the exit code. */
static int convert(const convert_options *o, trajectory *t, const char *name, convert_counts *counts)
{
    char error[PROGRAM_ERROR_SIZE];
    frames_writer *w = frames_writer_open(name, error, sizeof error);
    if (w == NULL) {
        program_error("%s", error);
        return PROGRAM_FAILED;
    }
    const int failed = copy_frames(o, t, w, counts, error, sizeof error);
    if (failed) {
        program_error("%s", error);
    }
    if (frames_writer_close(w, error, sizeof error) && !failed) {
        program_error("%s", error);
        return PROGRAM_FAILED;
    }
    if (!failed && counts->frames == 0) {
        program_error("%s: no frames to convert: %s", o->input,
                      o->first > 0 ? "the file ends before --first" : "the file is empty");
        return PROGRAM_FAILED;
    }
    return failed ? PROGRAM_FAILED : PROGRAM_OK;
}

static int run(const convert_options *o)
{
    char error[PROGRAM_ERROR_SIZE];
    convert_counts counts = {0};
    output_file file = {0};
    const double start = program_seconds();
    trajectory *t = trajectory_open(o->input, &o->reading, error, sizeof error);
    if (t == NULL) {
        program_error("%s", error);
        return PROGRAM_FAILED;
    }
    int code = PROGRAM_FAILED;
    if (output_begin(o->output, &file) == 0) {
        code = convert(o, t, file.temporary, &counts);
    }
    code = output_end(&file, code);
    trajectory_close(t);
    if (code == PROGRAM_OK && !o->quiet) {
        printf("%s: %" PRIu64 " frames, %" PRIu32 " to %" PRIu32 " spheres, %.1f MB, %.2f s\n", o->output,
               counts.frames, counts.fewest, counts.most,
               1e-6 * (24.0 + 4.0 * (double)counts.frames + 16.0 * (double)counts.spheres), program_seconds() - start);
    }
    return code;
}

int main(int argc, char **argv)
{
    convert_options options = {.first = 0, .last = UINT64_MAX - 1, .every = 1};
    trajectory_options_init(&options.reading);
    program_init("cgt-convert");
    argp_parse(&parser, argc, argv, 0, NULL, &options);
    check_options(&options);
    catch_interrupts();
    return program_exit(run(&options));
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-convert: converts any trajectory or mesh that the readers know to .frames. The output goes to a temporary file
 * that is renamed when it is complete, so a failed run leaves the previous file alone. Where the input is cut off, the
 * whole frames before that are written, and the exit code tells. */
#define _POSIX_C_SOURCE 200809L
#include "common/options.h"
#include "common/out_file.h"
#include "common/program.h"
#include "survey/origin.h"
#include "trajectory/trajectory_formats.h"
#include "trajectory/trajectory_status.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <cgt/trajectory.h>

typedef struct convert_options {
    const char *input; /* the first */
    const char **inputs;
    size_t input_count;
    const char *output;
    cgt_trajectory_options reading;
    uint64_t first, last, every; /* frames to convert, from 0; last included */
    int quiet;
} convert_options;

typedef struct convert_counts {
    cgt_trajectory_kind kind;
    uint32_t triangles;
    uint64_t frames;
    uint64_t items;                /* spheres or vertices in all of them */
    uint32_t count_min, count_max; /* of a frame */
    int normals;                   /* present, but .frames cannot hold them */
} convert_counts;

/* ---- Options ------------------------------------------------------------------------------------------------ */

#define AT(type_, member) .type = OPTION_##type_, .at = offsetof(convert_options, member)
#define FRAME(member, first_) AT(U64, member), .first = first_, .last = UINT32_MAX

static const option_row rows[] = {
    {"radius", 'r', "R",
     "Radius of spheres where the file has none, in world units (default: the element's van der Waals radius in "
     "Angstrom, 1 Angstrom in formats of molecular dynamics without elements, else 0.5)",
     AT(FLOAT, reading.radius), .low = FLT_MIN, .high = 1e30f},
    {"origin", 0, "X,Y,Z",
     "Subtract this in double from all coordinates before they are rounded to single precision; OUTPUT names it, and "
     "readers add it again (default: that of a .frames file, else one is found where the first frame is far from 0)",
     AT(PARSED, reading.origin), .parse = option_parse_origin,
     .given_bool = offsetof(convert_options, reading.has_origin) + 1},
    {"wrapped", 0, NULL,
     "Prefer coordinates wrapped into the periodic box (x y z) to unwrapped ones (xu yu zu) where a file has both",
     AT(BOOL, reading.wrapped)},
    {"format", 0, "NAME",
     "Format of INPUT whatever its name: " TRAJECTORY_FORMATS " (default: by the name, else by the first bytes)",
     AT(TEXT, reading.format), .words = TRAJECTORY_FORMATS},
    {"topology", 0, "FILE",
     "File whose first frame tells what the spheres are (elements, radii), for .xtc, .dcd and others that do not",
     AT(TEXT, reading.topology)},
    {"follow", 0, "SECONDS", "At the end wait so long for more, of a run that is still being written",
     AT(DOUBLE, reading.follow), .low = 0.05f, .high = 1e9f},
    {"no-limit", 0, NULL, "Read files that unpack or expand to more than 1 GiB and 500 times their size",
     AT(BOOL, reading.no_limit)},
    {"clip", 0, "NAME", "Animation clip of a mesh, by its name or number from 0 (default: the first)",
     AT(TEXT, reading.clip)},
    {"fps", 0, "RATE", "Frames per second of the clip (default: 30)", AT(DOUBLE, reading.fps), .low = 1e-3f,
     .high = 1e6f},
    {"first", 0, "N", "First frame to convert, counted from 0 (default: 0)", FRAME(first, 0)},
    {"last", 0, "N", "Last frame to convert (default: the file's last)", FRAME(last, 0)},
    {"every", 0, "N", "Convert every Nth frame (default: 1)", FRAME(every, 1)},
    {"quiet", 'q', NULL, "Print nothing but errors", AT(FLAG, quiet), .first = 1},
};

static int take_names(void *options, const char **operands, size_t count, char *error, size_t size)
{
    convert_options *const o = options;
    if (count < 2) {
        snprintf(error, size, "an input and an output are needed");
        return -1;
    }
    o->inputs = operands;
    o->input_count = count - 1;
    o->input = operands[0];
    o->output = operands[count - 1];
    return 0;
}

static const option_table table = {
    .rows = rows,
    .count = sizeof rows / sizeof rows[0],
    .names_letters = 1,
    .arguments = "INPUT... OUTPUT.frames",
    .text =
        "Converts a trajectory of spheres, or a mesh and its animation, to .frames.\v"
        "Several INPUTs, one for each step, are one run, in the order of the numbers in their names; - is standard "
        "input. INPUT is a trajectory (" TRAJECTORY_ENDINGS "), or a mesh that assimp reads (.obj, .ply, "
        ".gltf, .dae, .x, .ifc and others) in a build that has it, and may be compressed by gzip, Zstandard, xz, bzip2 "
        "or LZ4 in a build with libarchive; OUTPUT ends in .frames, which keeps the triangles of a mesh, but no vertex "
        "normals. An existing OUTPUT is replaced when the new one is complete, or has the whole frames before an error "
        "in INPUT, and left alone otherwise.\n\n"
        "Exit status: 0 done, 1 a file or memory failed, 2 wrong usage.",
    .finish = take_names,
};

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

/* ---- Converting --------------------------------------------------------------------------------------------- */

typedef struct conversion {
    const convert_options *options;
    cgt_trajectory *from;
    const char *name;              /* of the file that is written */
    cgt_trajectory_writer *writer; /* NULL before the first frame, which tells the kind */
    convert_counts counts;
    int is_cut; /* reading failed after some whole frames, and those are written */
    char error[PROGRAM_ERROR_SIZE];
} conversion;

static int write_frame(conversion *c, const cgt_trajectory_frame *frame)
{
    const int spheres = frame->kind == CGT_TRAJECTORY_SPHERES;
    cgt_result result = CGT_OK;
    if (c->writer == NULL)
        result = spheres ? cgt_trajectory_writer_open(c->name, frame->origin, &c->writer)
                         : cgt_trajectory_writer_open_triangles(c->name, frame->origin, frame->index, frame->triangles,
                                                                &c->writer);
    if (result == CGT_OK)
        result = spheres ? cgt_trajectory_writer_add(c->writer, frame->xyzr, frame->count)
                         : cgt_trajectory_writer_add_vertices(c->writer, frame->position, frame->count);
    if (result != CGT_OK)
        cgt_trajectory_writer_get_error_message(c->writer, c->error, sizeof c->error);
    return result == CGT_OK ? 0 : -1;
}

static int skip_frame(conversion *c)
{
    return trajectory_status(c->from, cgt_trajectory_skip(c->from), c->error, sizeof c->error);
}

/* Adds the spheres of a frame to a bulk, which tells whether they are far off. */
static int find_origin(const cgt_trajectory_frame *frame, double origin[3])
{
    static bulk b;
    for (uint32_t i = 0; i < frame->count && frame->kind == CGT_TRAJECTORY_SPHERES; i++) {
        const float *const p = frame->xyzr + 4 * (size_t)i;
        if (isfinite(p[0] + p[1] + p[2] + p[3]))
            bulk_add(&b, 0, i, i, p, p[3]);
    }
    return cgt_origin_of_bulk(&b, origin);
}

/* Reads the frame `number`. The first one that is converted decides on the origin of all, and is read again. */
static int read_frame(conversion *c, uint64_t number, cgt_trajectory_frame *frame)
{
    double origin[3], before[3];
    int result = trajectory_status(c->from, cgt_trajectory_read(c->from, frame), c->error, sizeof c->error);
    if (result <= 0 || c->counts.frames > 0 || c->options->reading.has_origin || !find_origin(frame, origin))
        return result;
    cgt_trajectory_get_origin(c->from, before);
    for (int k = 0; k < 3; k++)
        origin[k] += before[k];
    if (!cgt_trajectory_can_rewind(c->from)) {
        program_error(
            "the spheres are far from 0, where single precision rounds coordinates visibly, and a pipe cannot "
            "be read again: give --origin %.15g,%.15g,%.15g",
            origin[0], origin[1], origin[2]);
        return result;
    }
    cgt_origin_tell(origin, "the spheres are", c->error, sizeof c->error);
    program_error("%s", c->error);
    cgt_trajectory_set_origin(c->from, origin);
    result = trajectory_status(c->from, cgt_trajectory_rewind(c->from), c->error, sizeof c->error);
    for (uint64_t k = 0; k < number && result > 0; k++)
        result = skip_frame(c);
    return result > 0 ? trajectory_status(c->from, cgt_trajectory_read(c->from, frame), c->error, sizeof c->error)
                      : result;
}

static int copy_frame(conversion *c, uint64_t number)
{
    cgt_trajectory_frame frame;
    const int result = read_frame(c, number, &frame);
    if (result <= 0) {
        c->is_cut = result < 0 && c->counts.frames > 0;
        return result;
    }
    const char *warning;
    while ((warning = cgt_trajectory_take_warning(c->from)) != NULL)
        program_error("warning: %s", warning);
    if (write_frame(c, &frame))
        return -1;
    convert_counts *const n = &c->counts;
    n->kind = frame.kind;
    n->triangles = frame.triangles;
    n->normals |= frame.vertex_normal != NULL;
    n->count_min = n->frames == 0 || frame.count < n->count_min ? frame.count : n->count_min;
    n->count_max = frame.count > n->count_max ? frame.count : n->count_max;
    n->frames++;
    n->items += frame.count;
    return 1;
}

/* Copies the selected frames. Returns 0 or -1 with a text. */
static int copy_frames(conversion *c)
{
    const convert_options *const o = c->options;
    program_progress progress;
    program_progress_start(&progress, "converting", "frames", 0.0, o->quiet);
    int result = 1;
    for (uint64_t number = 0; number <= o->last && result > 0; number++) {
        const int selected = number >= o->first && (number - o->first) % o->every == 0;
        result = selected ? copy_frame(c, number) : skip_frame(c);
        c->is_cut |= !selected && result < 0 && c->counts.frames > 0;
        program_progress_update(&progress, (double)c->counts.frames, cgt_trajectory_progress(c->from));
    }
    program_progress_end(&progress);
    return result < 0 ? -1 : 0;
}

/* Writes the file. Returns the exit code. */
static int convert(conversion *c)
{
    const int failed = copy_frames(c);
    if (failed)
        program_error("%s", c->error);
    if (c->writer != NULL && cgt_trajectory_writer_finish(c->writer) != CGT_OK) {
        cgt_trajectory_writer_get_error_message(c->writer, c->error, sizeof c->error);
        if (!failed || c->is_cut)
            program_error("%s", c->error);
        c->is_cut = 0;
        return PROGRAM_FAILED;
    }
    if (c->is_cut) {
        if (c->counts.frames == 1)
            program_error("the frame before that is written");
        else
            program_error("the %" PRIu64 " frames before that are written", c->counts.frames);
    }
    if (!failed && c->counts.frames == 0) {
        program_error("%s: no frames to convert: %s", c->options->input,
                      c->options->first > 0 ? "the file ends before --first" : "the file is empty");
        return PROGRAM_FAILED;
    }
    return failed ? PROGRAM_FAILED : PROGRAM_OK;
}

/* ---- Report ------------------------------------------------------------------------------------------------ */

/* Prints what the output lacks of a mesh. */
static void report_losses(const char *input, const cgt_trajectory_mesh *mesh, int normals)
{
    const struct {
        uint64_t count;
        const char *what;
    } losses[] = {
        {mesh->points, "points left out"},
        {mesh->lines, "lines left out"},
        {mesh->lost_triangles, "triangles lost with self-intersecting polygons"},
        {mesh->unshown, "meshes left out: no node refers to them"},
        {mesh->unused, "vertices left out: no triangle uses them"},
        {mesh->degenerate, "triangles without an area"},
        {mesh->still_channels, "animations of single vertices not played"},
    };
    for (size_t i = 0; i < sizeof losses / sizeof losses[0]; i++)
        if (losses[i].count > 0)
            printf("%s: %" PRIu64 " %s\n", input, losses[i].count, losses[i].what);
    if (mesh->warnings > 0)
        printf("%s: %" PRIu32 " warnings from assimp; the first: %s\n", input, mesh->warnings, mesh->warning);
    if (normals)
        printf("%s: vertex normals left out\n", input);
}

static void report(const conversion *c, double seconds)
{
    const convert_counts *const n = &c->counts;
    const cgt_trajectory_mesh *const mesh = cgt_trajectory_get_mesh(c->from);
    const int spheres = n->kind == CGT_TRAJECTORY_SPHERES;
    const double bytes =
        24.0 + 4.0 * (double)n->frames + 12.0 * (double)n->triangles + (spheres ? 16.0 : 12.0) * (double)n->items;
    if (mesh != NULL) {
        printf("%s: %" PRIu32 " meshes shown %" PRIu32 " times, %" PRIu32 " bones, %" PRIu32 " clips\n",
               c->options->input, mesh->meshes, mesh->instances, mesh->bones, mesh->clips);
        report_losses(c->options->input, mesh, n->normals);
    }
    printf("%s: %" PRIu64 " frames, ", c->options->output, n->frames);
    if (!spheres)
        printf("%" PRIu32 " triangles, ", n->triangles);
    printf("%" PRIu32 " to %" PRIu32 " %s, %.1f MB, %.2f s\n", n->count_min, n->count_max,
           spheres ? "spheres" : "vertices", 1e-6 * bytes, seconds);
}

static int run(const convert_options *o)
{
    conversion c = {.options = o};
    out_file file;
    const double start = program_seconds();
    cgt_trajectory_sort_series(o->inputs, o->input_count);
    const cgt_result opened = cgt_trajectory_open_series(o->inputs, o->input_count, &o->reading, &c.from);
    if (trajectory_failed(c.from, opened, c.error, sizeof c.error)) {
        program_error("%s", c.error);
        cgt_trajectory_close(c.from);
        return PROGRAM_FAILED;
    }
    int code = PROGRAM_FAILED;
    c.name = out_file_begin(&file, o->output, c.error, sizeof c.error);
    if (c.name == NULL) {
        program_error("%s", c.error);
    } else {
        code = convert(&c);
        cgt_trajectory_writer_close(c.writer);
        if (out_file_end(&file, code == PROGRAM_OK || c.is_cut, c.error, sizeof c.error)) {
            program_error("%s", c.error);
            code = PROGRAM_FAILED;
        }
    }
    if (code == PROGRAM_OK && !o->quiet)
        report(&c, program_seconds() - start);
    cgt_trajectory_close(c.from);
    return code;
}

int main(int argc, char **argv)
{
    convert_options options = {.first = 0, .last = UINT64_MAX - 1, .every = 1};
    cgt_trajectory_options_init(&options.reading);
    options.reading.leave_out_sites = true; /* .frames has nothing to tell them by */
    program_init("cgt-convert");
    options_parse(&table, &options, argc, argv, NULL);
    check_options(&options);
    out_file_catch_signals(NULL);
    return program_exit(run(&options));
}

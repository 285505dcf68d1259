/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All options of cgt-render, in the order of its --help. What is said of the picture is a row of the figure, in
 * figure/options/option_rows.c, and named here; a new one of files and running is a row here, and a member of
 * render_options. */
#include "common/options.h"

#include <float.h>

#define OPTION_TABLE render_options /* whose members the rows are about */
#include "options/option_macros.h"
#include "render/options/option_parsers.h"
#include "trajectory/trajectory_formats.h"

#define RUNNING .is_running = 1

static const option_row rows[] = {
    {.help = "Pictures:", .group = 1},
    {"output", 'o', "PATTERN",
     "Names of the pictures, .png, .exr, .jpg or .tif; default out/frame_%04d.png. %04d becomes the frame's number in "
     "the input: 0000, 0001, ...; folders are created. Or a movie, by the program ffmpeg: .mp4, .mov, .mkv, .webm or "
     ".gif. Or - for raw frames on standard output, 3 bytes a pixel. May be given up to four times",
     WHOLE(parse_output), RUNNING},
    {"no-images", 'n', NULL, "Write no pictures: to measure, or for a contact sheet alone", FLAG(no_images), RUNNING},
    {"size", .type = OPTION_FIGURE},
    {"antialias", .type = OPTION_FIGURE},
    {"contact-sheet", 0, "FILE", "Also write evenly spaced frames, small, as one .png",
     PARSED(contact_sheet, parse_sheet), RUNNING},
    {"sheet-grid", 0, "CxR", "Columns and rows of the contact sheet; default 4x3", WHOLE(parse_grid), RUNNING},
    {.help = "Camera:", .group = 2},
    {"camera", .type = OPTION_FIGURE},
    {"camera-keys", .type = OPTION_FIGURE},
    {"orbit", .type = OPTION_FIGURE},
    {"view", .type = OPTION_FIGURE},
    {"up", .type = OPTION_FIGURE},
    {"fov", .type = OPTION_FIGURE},
    {"zoom", .type = OPTION_FIGURE},
    {.help = "Colours and light:", .group = 3},
    {"color", .type = OPTION_FIGURE},
    {"category", .type = OPTION_FIGURE},
    {"colormap", .type = OPTION_FIGURE},
    {"range", .type = OPTION_FIGURE},
    {"log-scale", .type = OPTION_FIGURE},
    {"light", .type = OPTION_FIGURE},
    {.help = "Input:", .group = 4},
    {"first", 0, "N",
     "First frame to render, counted from 0. Numbers in names, automatic camera and colours stay those of the whole "
     "run",
     U64(range.first, 0, UINT64_MAX - 1), RUNNING},
    {"last", 0, "N", "Last frame to render", U64(range.last, 0, UINT64_MAX - 1), RUNNING},
    {"every", 0, "N", "Render every Nth frame", U64(range.every, 1, UINT64_MAX - 1), RUNNING},
    {"radius", 'r', "R",
     "Radius of spheres where the file has none; default: by element, 1 Angstrom in formats of molecular dynamics, "
     "else 0.5",
     FLOAT(reading.radius, FLT_MIN, 1e30f)},
    {"origin", 0, "X,Y,Z",
     "Subtract this in double from all coordinates before they are rounded to single precision; options and results "
     "stay in the file's coordinates. Default: that of a .frames file, else one is found where the scene is far from 0",
     PARSED(reading.origin, option_parse_origin), .given_bool = offsetof(render_options, reading.has_origin) + 1},
    {"wrapped", 0, NULL, "Prefer coordinates wrapped into the box where a file has both kinds",
     AT(BOOL, reading.wrapped)},
    {"unwrap", .type = OPTION_FIGURE},
    {"type-element", .type = OPTION_FIGURE},
    {"whole", .type = OPTION_FIGURE},
    {"fps", 0, "N", "Frames per second of a mesh's animation; default 30", DOUBLE(reading.fps, 1e-3f, 1e6f)},
    {"clip", 0, "NAME", "Animation of a mesh, by its name or its number from 0; default: the first",
     TEXT(reading.clip)},
    {"format", 0, "NAME",
     "Format of the input whatever its name: " TRAJECTORY_FORMATS "; default: by the name, else by the first bytes",
     TEXT(reading.format), .words = TRAJECTORY_FORMATS},
    {"no-limit", 0, NULL, "Read files that unpack or expand to more than 1 GiB and 500 times their size",
     AT(BOOL, reading.no_limit)},
    {"topology", 0, "FILE",
     "A file whose first frame tells the elements, types and bonds of the spheres, where the trajectory does not",
     TEXT(reading.topology)},
    {"follow", 0, "SECONDS",
     "At the end wait so long for more, of a run that is still being written; the automatic camera and colours are "
     "those of the frames that are there at the start",
     DOUBLE(reading.follow, 0.05f, 1e9f), RUNNING},
    {.help = "Running:", .group = 5},
    {"threads", 't', "N",
     "Threads that build and trace, and read large frames of text; 0 (default): one per CPU. One more reads ahead, and "
     "as many, at most 8, write pictures: three frames of the input and up to ten pictures are in memory",
     U32(threads, 0, 1024), RUNNING},
    {"memory", 0, "MIB",
     "Frames that were read for the automatic camera and colours are kept in so much memory, so that they are not read "
     "again; default: a quarter of the machine's",
     U32(memory_mib, 0, 1u << 24), RUNNING},
    {"variant", 0, "NAME", "Kernels to use; default: the widest that this CPU runs", TEXT(variant), RUNNING},
    {"stats", 0, NULL, "Print counts of structure and rays; counting makes tracing slower", FLAG(stats), RUNNING},
    {"log-file", 0, "FILE", "Write a line of times for each frame, tab-separated", TEXT(log_file), RUNNING},
    {"settings", 0, "FILE",
     "Read options from a file of lines such as 'style = paper'; those of the command line override them",
     TEXT(settings_file), RUNNING},
    {"print-settings", 0, NULL,
     "Print the options of this command line as a settings file, the others as comments, and end", FLAG(print_settings),
     RUNNING},
    {"quiet", 'q', NULL, "No progress", FLAG(quiet), RUNNING},
    {"verbose", 'v', NULL, "Show the library's log", FLAG(verbose), RUNNING},
    {.help = "Movies and parts of runs:", .group = 6},
    {"rate", 0, "N", "Frames per second of movies; default 30", DOUBLE(output.rate, 1e-3f, 1000.0)},
    {"quality", 0, "N",
     "Quality of movies and .jpg, 1 (smallest files) to 100 (best); default 80 of movies, 92 of .jpg",
     U32(output.quality, 1, 100)},
    {"preset", 0, "NAME", "Effort of x264, from ultrafast to veryslow: smaller files for more time; default veryfast",
     NAME(output.preset, "ultrafast superfast veryfast faster fast medium slow slower veryslow")},
    {"part", 0, "K/N",
     "Render the Kth of N parts of the run, with the names, camera and colours of the whole: for N processes, each "
     "with "
     "a K of its own",
     PARSED(output, parse_part), RUNNING},
    {"survey", 0, "N",
     "Look only at the first N frames for automatic camera and colours; default: at all, which reads the input twice",
     U64(output.survey, 1, UINT64_MAX - 1)},
    {.help = "Style and light:", .group = 10},
    {"style", .type = OPTION_FIGURE},
    {"ambient", .type = OPTION_FIGURE},
    {"ambient-radius", .type = OPTION_FIGURE},
    {"shadows", .type = OPTION_FIGURE},
    {"no-shadows", .type = OPTION_FIGURE},
    {"light-size", .type = OPTION_FIGURE},
    {"light-samples", .type = OPTION_FIGURE},
    {"light-strength", .type = OPTION_FIGURE},
    {"fill", .type = OPTION_FIGURE},
    {"head", .type = OPTION_FIGURE},
    {"sun", .type = OPTION_FIGURE},
    {"lamp", .type = OPTION_FIGURE},
    {.help = "Drawing:", .group = 11},
    {"background", .type = OPTION_FIGURE},
    {"transparent", .type = OPTION_FIGURE},
    {"ortho", .type = OPTION_FIGURE},
    {"depth-cue", .type = OPTION_FIGURE},
    {"outline", .type = OPTION_FIGURE},
    {"title", .type = OPTION_FIGURE},
    {"time", .type = OPTION_FIGURE},
    {"colorbar", .type = OPTION_FIGURE},
    {"legend", .type = OPTION_FIGURE},
    {"axes", .type = OPTION_FIGURE},
    {"scale-bar", .type = OPTION_FIGURE},
    {"label", .type = OPTION_FIGURE},
    {"label-text", .type = OPTION_FIGURE},
    {"font", .type = OPTION_FIGURE},
    {"no-metadata", 0, NULL, "Pictures do not say how they were made", FLAG(no_metadata), RUNNING},
    {"text-size", .type = OPTION_FIGURE},
    {.help = "What is drawn:", .group = 12},
    {"show", .type = OPTION_FIGURE},
    {"hide", .type = OPTION_FIGURE},
    {"slice", .type = OPTION_FIGURE},
    {"cut", .type = OPTION_FIGURE},
    {"radius-by", .type = OPTION_FIGURE},
    {"radius-scale", .type = OPTION_FIGURE},
    {"type-radius", .type = OPTION_FIGURE},
    {"type-color", .type = OPTION_FIGURE},
    {"type-name", .type = OPTION_FIGURE},
    {"opacity", .type = OPTION_FIGURE},
    {"images", .type = OPTION_FIGURE},
    {"box", .type = OPTION_FIGURE},
    {"bonds", .type = OPTION_FIGURE},
    {"bond-radius", .type = OPTION_FIGURE},
    {"bond-color", .type = OPTION_FIGURE},
    {"arrows", .type = OPTION_FIGURE},
    {"arrow-scale", .type = OPTION_FIGURE},
    {"arrow-radius", .type = OPTION_FIGURE},
    {"arrow-color", .type = OPTION_FIGURE},
    {"trails", .type = OPTION_FIGURE},
    {"trail-radius", .type = OPTION_FIGURE},
    {"trail-color", .type = OPTION_FIGURE},
    {"mesh", 0, "FILE", "A mesh that stands still among the spheres, such as the walls of a drum", TEXT(mesh)},
    {"mesh-opacity", .type = OPTION_FIGURE},
    {"mesh-color", .type = OPTION_FIGURE},
    {"floor", .type = OPTION_FIGURE},
    {"floor-axis", .type = OPTION_FIGURE},
    {"floor-height", .type = OPTION_FIGURE},
    {"floor-place", .type = OPTION_FIGURE},
    {.help = "On an emulated Cell:", .group = 15},
    {"cell", 0, "native|sim|real",
     "Trace spheres by Chapman's program on SPEs of 256 KB each, to the same picture: native, the program compiled for "
     "this machine, or sim, the SPU's own, by instructions and cycles, seconds a frame; real: that on SPEs of this "
     "machine",
     WORD(cell.mode, RENDER_CELL_NATIVE, "native sim real")},
    {"spes", 0, "N", "SPEs, 1 to 16; default 6. Without --cell: native", U32(cell.spes, 1, 16)},
    {"cell-assignment", 0, "NAME", "Who traces which strip: interleaved (default), static, dynamic or hybrid",
     WORD(cell.assignment, 0, RENDER_CELL_ASSIGNMENTS)},
    {"cell-program", 0, "FILE", "Of sim and real: spe_grid.elf; default: the installed one", TEXT(cell.program)},
    {.help = "Mirrors and glass:", .group = 14},
    {"bounces", .type = OPTION_FIGURE},
    {"material", .type = OPTION_FIGURE},
};

enum { ROWS = sizeof rows / sizeof rows[0] };

/* The figure's rows take their places, which are in the member `figure`. */
static void join_rows(option_row *joined)
{
    for (size_t i = 0; i < ROWS; i++) {
        joined[i] = rows[i];
        if (rows[i].type != OPTION_FIGURE)
            continue;
        joined[i] = *cgt_figure_find_row(rows[i].name);
        joined[i].at += offsetof(render_options, figure);
        joined[i].given += joined[i].given ? offsetof(render_options, figure) : 0;
    }
}

const option_table *render_option_table(void)
{
    static option_row joined[ROWS];
    static const option_table table = {
        .rows = joined,
        .count = ROWS,
        .arguments = "TRAJECTORY...",
        .text = "Renders the moving spheres or triangles of a trajectory (" TRAJECTORY_ENDINGS "); or a "
                "mesh with its animation: .obj, .ply, .gltf, .dae, .x, .ifc and others. Several files, one for each "
                "step, are "
                "one run, in the order of the numbers in their names; - is standard input.\v"
                "The structure is built anew for every frame. Exit codes: 0 all frames were rendered, 1 something "
                "failed, 2 "
                "the command line is wrong.\n\n"
                "Example: cgt-render -s 1920x1080 -a 2 --orbit 90 -o out/pour_%04d.png pour.lammpstrj\n"
                "         cgt-render -o pour.mp4 pour.lammpstrj",
        .finish = render_options_finish,
    };
    if (!joined[0].help)
        join_rows(joined);
    return &table;
}

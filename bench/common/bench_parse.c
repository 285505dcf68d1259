/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Parses the options of a subject: defaults, the rows of the table that it takes, contradictions. */
#include <assert.h>
#include <stdio.h>
#include <string.h>

#include "common/bench_options.h"
#include "common/options.h"
#include "ways/bench_way.h"

/* Of the scenes of cgt-bench make. */
#define PROCEDURAL_CAMERA "0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46"

/* What a subject is, and its defaults. */
typedef struct subject {
    bench_subject subject;
    const char *files, *doc;
    size_t least_files, most_files;
    uint32_t repeat, width, height;
    uint64_t frames;
} subject;

static const subject subjects[] = {
    {BENCH_ACCURACY, "[FILE...]",
     "Sets time against error, in every variant, precision and triangle test. \"cases\" traces rays of the hard cases "
     "of ray casting and of each FILE's first frame, and judges every answer by exact arithmetic. \"frames\" measures "
     "whole frames of each FILE against EXACT, with the structure rebuilt; \"paths\" the error of paths between "
     "mirrors.",
     0, BENCH_MOST_FILES, 5, 1280, 720, 0},
    {BENCH_BOUNCES, "FILE...",
     "Measures the rays of bounces 1 to 4 of Whitted's tracing, all primitives of a frame of each FILE being mirrors, "
     "then glass: each wave is recorded, and traced as arrays in several orders by all ways in turns. Columns and "
     "camera are those of rays.",
     1, BENCH_MOST_FILES, 3, 1280, 720, 1},
    {BENCH_CELL, "[FILE]",
     "Simulates a program of an SPU, an ELF file, and prints where its cycles go, function by function. Without FILE: "
     "programs of a few instructions whose cycles can be counted by hand, and the numbers of the timing model with "
     "their sources. Cycles are the model's; it was never compared with a console. The program has no channels: it "
     "cannot use DMA or mailboxes.",
     0, 1, 1, 320, 180, 0},
    {BENCH_CLIFFS, NULL,
     "Measures scenes in which one trouble, such as a single primitive far away, may cost far more than it should. "
     "Prints a row for each scene, structure and call: the time, how many times that of the same scene without the "
     "trouble, and how many times Embree's where that is installed; and as comments the worst rows.",
     0, 0, 1, 16, 12, 0},
    {BENCH_FRAME, "FILE",
     "Measures frames as a renderer spends them. FILE is a trajectory of spheres or triangles: .frames, .lammpstrj, "
     ".xyz, or a mesh. In every frame they move, and the scene is committed and traced, by all ways in turns. Prints a "
     "row of medians over the frames in milliseconds for each way. The first frame warms up and does not count.",
     1, 1, 1, 1280, 720, 0},
    {BENCH_LIGHT, "FILE...",
     "Measures shadow rays of a frame of each FILE to lights outside, near and inside of the scene, and from all "
     "sides, for points in several orders, by all ways in turns. Each time the scene is committed before: what the "
     "library builds for a light is in its time. Columns and camera are those of rays.",
     1, BENCH_MOST_FILES, 3, 1280, 720, 1},
    {BENCH_MAKE, "SCENE FILE.frames",
     "Writes a procedural scene of moving spheres or triangles. SCENE: cloud2k, cloud20k, cloud200k, cloud1m, "
     "clusters1m, blobs2k, blob100k, blobs1m, stadium.",
     2, 2, 1, 1, 1, 6},
    {BENCH_RAYS, "FILE...",
     "Measures rays of several kinds, by their order and by their number in a call, by all ways in turns. FILE is a "
     "trajectory of spheres or triangles; the last frame that -n reads is traced (default 1). Fails where any "
     "structure of the library finds another hit than the first, in any bit.\vColumns ending in _per_ray count what a "
     "ray visits: inner nodes, leaves, tests of primitives. In packets a node counts once for all rays of the packet.",
     1, BENCH_MOST_FILES, 3, 640, 360, 1}};

static const subject *find_subject(bench_subject which)
{
    size_t i = 0;
    while (subjects[i].subject != which)
        i++;
    return &subjects[i];
}

static void set_defaults(bench_settings *s, const subject *of)
{
    char error[PROGRAM_ERROR_SIZE] = "";
    *s = (bench_settings){.subject = of->subject,
                          .least_files = of->least_files,
                          .most_files = of->most_files,
                          .width = of->width,
                          .height = of->height,
                          .frames = of->frames,
                          .threads = 1,
                          .repeat = of->repeat,
                          .rays = of->subject == BENCH_ACCURACY ? 4000 : 131072,
                          .count = {1000, 10000, 100000, 1000000},
                          .counts = 4,
                          .limit_ms = 1000,
                          .steps = 5,
                          .worst = 10,
                          .cycles = UINT64_C(100000000000),
                          .spheres = 2000};
    cgt_camera_init(&s->camera);
    s->camera.eye[2] = -5.0f;
    if (of->subject & (BENCH_BOUNCES | BENCH_LIGHT | BENCH_RAYS)) {
        const int failed = cgt_read_camera(PROCEDURAL_CAMERA, &s->camera, error, sizeof error);
        assert(!failed);
        (void)failed;
    }
    if (of->subject == BENCH_RAYS) {
        s->ao = 1;
        memcpy(s->light, (const float[]){3, 4, -5}, sizeof s->light);
    }
}

/* ---- names ---- */

int bench_is_chosen(const int *chosen, int count, int which)
{
    int any = 0;
    for (int i = 0; i < count; i++)
        any |= chosen[i];
    return !any || chosen[which];
}

void bench_file_name(const char *path, char name[BENCH_NAME_SIZE])
{
    const char *slash = strrchr(path, '/');
    snprintf(name, BENCH_NAME_SIZE, "%s", slash ? slash + 1 : path);
    char *dot = strrchr(name, '.');
    if (dot && dot > name)
        *dot = '\0';
}

/* ---- the whole command line ---- */

static int add_files(bench_settings *s, const char **paths, size_t count, char *error, size_t size)
{
    if (count > 0 && s->most_files == 0)
        snprintf(error, size, "this subject takes no FILE: %s", paths[0]);
    else if (count > s->most_files && s->most_files == 1)
        snprintf(error, size, "one FILE only: %s", paths[1]);
    else if (count > s->most_files)
        snprintf(error, size, "more than %zu files: %s", s->most_files, paths[s->most_files]);
    else
        s->files = count;
    for (size_t i = 0; i < s->files; i++)
        s->paths[i] = paths[i];
    return count > s->most_files ? -1 : 0;
}

/* Contradictions; text: what is wrong. */
static const char *find_contradiction(const bench_settings *s)
{
    const bench_choice *c = &s->choice;
    for (size_t i = 0; i < s->ways && s->orthographic; i++)
        if (s->way[i] >= BENCH_LIBRARY_NAMES)
            return "-O: not of Embree";
    if (s->subject == BENCH_ACCURACY && s->ways && (s->ways > 1 || s->way[0] >= BENCH_LIBRARY_NAMES))
        return "-S: one structure of the library";
    if (s->files < s->least_files)
        return s->subject == BENCH_MAKE ? "SCENE and FILE.frames are wanted" : "FILE is missing";
    if (c->kd_break && c->kd_layout != CGT_KD_LAYOUT_MIXED)
        return "--kd-break: only with --kd-layout mixed";
    if (c->test != CGT_TRIANGLE_TEST_AUTO && c->precision != CGT_PRECISION_FAST)
        return "--test: only with -p fast";
    if (s->layouts && c->kd_layout != CGT_KD_LAYOUT_AUTO)
        return "--layouts covers all layouts: leave out --kd-layout";
    if (s->orthographic && (s->lit || s->ao))
        return "-O: only primary rays can be parallel: leave out -l and -a";
    if (s->shade && (s->lit || s->ao))
        return "--shade stores no planes, from which secondary rays would start: leave out -l and -a";
    if (s->all && (c->packet || c->tile != CGT_TILE_SHAPE_AUTO))
        return "--all goes through packets and tiles itself: leave out -k and --tile";
    if (s->subject == BENCH_RAYS && !s->ao)
        return "-a: 1 or more";
    if (s->subject == BENCH_ACCURACY && s->part[1] && !s->part[0] && !s->part[2] && !s->files)
        return "-w frames: FILE is missing";
    if ((s->cell_frames || s->cell_kd) && !s->files)
        return "--frames and --kd want the program's FILE, spe_grid.elf or spe_kd.elf";
    if (s->bih_path && !s->cell_kd)
        return "--bih wants --kd and the FILE of that, spe_kd.elf";
    return NULL;
}

static int finish(void *options, const char **operands, size_t count, char *error, size_t size)
{
    bench_settings *const s = options;
    if (add_files(s, operands, count, error, size))
        return -1;
    const char *const wrong = find_contradiction(s);
    if (!wrong)
        return 0;
    snprintf(error, size, "%s", wrong);
    return -1;
}

/* The rows of a subject, each heading with the first of them. */
static size_t add_rows(option_row *rows, bench_subject which)
{
    const option_row *heading = NULL;
    size_t count = 0;
    for (size_t i = 0; i < bench_option_count; i++) {
        const bench_option *const o = &bench_options[i];
        if (!o->row.name)
            heading = &o->row;
        if (!o->row.name || !(o->subjects & which))
            continue;
        assert(count + 2 <= OPTIONS_MOST);
        if (heading)
            rows[count++] = *heading;
        heading = NULL;
        rows[count++] = o->row;
    }
    return count;
}

void bench_parse(bench_settings *settings, bench_subject which, const char *program, int argc, char **argv)
{
    static option_row rows[OPTIONS_MOST];
    const subject *of = find_subject(which);
    const option_table table = {.rows = rows,
                                .count = add_rows(rows, which),
                                .names_letters = 1,
                                .arguments = of->files,
                                .text = of->doc,
                                .program = program,
                                .finish = finish};
    set_defaults(settings, of);
    options_parse(&table, settings, argc, argv, NULL);
    if (!settings->batches)
        settings->batch[settings->batches++] = UINT64_MAX;
    if (!settings->random)
        settings->random = settings->rays;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bytes as a file for the trajectory readers. The readers choose the format by a path's ending, so the bytes go to a
 * scratch file in TMPDIR, one per ending and process, which is removed when the process exits normally. */
#define _DEFAULT_SOURCE /* mkdtemp */
#include "fuzz/fuzz_file.h"
#include "support/frame_hash.h"
#include "support/trajectory_told.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define MOST_FRAMES 64u /* frames read at most; a few bytes may describe a clip of any length */
#define ERROR_BYTES 1024

/* ---- scratch files: the input, and the frames that were read, written as .frames ---- */

#define MOST_PATHS 24
typedef struct scratch {
    char folder[512];
    char path[MOST_PATHS][600];
    int paths;
} scratch;
static scratch files;

static void remove_scratch(void)
{
    for (int i = 0; i < files.paths; i++)
        unlink(files.path[i]);
    rmdir(files.folder);
}

static const char *scratch_path(const char *name, const char *ending)
{
    char path[sizeof files.path[0]];
    if (!files.folder[0]) {
        const char *parent = getenv("TMPDIR");
        snprintf(files.folder, sizeof files.folder, "%s/cgt-fuzz-XXXXXX", parent ? parent : P_tmpdir);
        FUZZ_CHECK(mkdtemp(files.folder), "no scratch folder %s", files.folder);
        atexit(remove_scratch);
    }
    snprintf(path, sizeof path, "%s/%s%s", files.folder, name, ending);
    for (int i = 0; i < files.paths; i++)
        if (!strcmp(files.path[i], path))
            return files.path[i];
    FUZZ_CHECK(files.paths < MOST_PATHS, "more endings than scratch files");
    return strcpy(files.path[files.paths++], path);
}

/* A new file each time, as in replay.c. */
static void fill(const char *path, const uint8_t *bytes, size_t size)
{
    remove(path);
    FILE *file = fopen(path, "wb");
    FUZZ_CHECK(file && fwrite(bytes, 1, size, file) == size && !fclose(file), "%s: cannot be written", path);
}

const char *fuzz_scratch(const char *name, const char *ending, const uint8_t *bytes, size_t size)
{
    const char *const path = scratch_path(name, ending);
    fill(path, bytes, size);
    return path;
}

/* ---- frames ---- */

/* The numbers of words are those of the table. */
static void check_column(const cgt_trajectory_column *c, uint32_t count)
{
    FUZZ_CHECK(c->name, "a column without a name");
    for (uint32_t i = 0; c->value && c->kind == CGT_TRAJECTORY_WORD && i < count; i++)
        FUZZ_CHECK(c->value[i] >= 0 && c->value[i] <= (float)c->words, "column %s: word %g of %u", c->name,
                   (double)c->value[i], c->words);
}

/* Asks for columns of all kinds. A topology is read anew with them, and may have words that are none. */
static void want_columns(cgt_trajectory *t, bool has_topology)
{
    static const char *const names[] = {"x",       "fx",   "q",        "name", "resname", "chain",   "resid",
                                        "element", "type", "b_factor", "c_ke", "vz",      "species", "temperature"};
    char error[ERROR_BYTES] = "";
    FUZZ_CHECK(!told_want_columns(t, names, sizeof names / sizeof names[0], error, sizeof error) || has_topology, "%s",
               error);
}

static void check_frame(const cgt_trajectory_frame *f, uint64_t number, const cgt_trajectory_options *o)
{
    const uint64_t most = o->max_count ? o->max_count : UINT64_C(1) << 31;
    FUZZ_CHECK(f->number == number, "frame %llu claims to be %llu", (unsigned long long)number,
               (unsigned long long)f->number);
    FUZZ_CHECK(f->count <= most && f->triangles <= most, "frame: more than the limit");
    for (size_t i = 0; i < 2 * (size_t)f->bonds; i++)
        FUZZ_CHECK(f->bond[i] < f->count, "frame: bond %zu is of sphere %u of %u", i / 2, f->bond[i], f->count);
    for (uint32_t i = 0; i < f->columns; i++)
        check_column(&f->column[i], f->count);
    if (f->kind == CGT_TRAJECTORY_SPHERES) {
        FUZZ_CHECK(f->xyzr && !f->triangles && !f->index && !f->position && !f->vertex_normal,
                   "frame: spheres with arrays of triangles");
        return;
    }
    FUZZ_CHECK(f->kind == CGT_TRAJECTORY_TRIANGLES && !f->xyzr, "frame: neither spheres nor triangles");
    FUZZ_CHECK((f->position || !f->count) && (f->index || !f->triangles), "frame: arrays are missing");
    for (size_t i = 0; i < 3 * (size_t)f->triangles; i++)
        FUZZ_CHECK(f->index[i] < f->count, "frame: index %zu is %u of %u", i, f->index[i], f->count);
}

/* ---- a file ---- */

/* The result of one pass over a file. */
typedef struct pass {
    uint32_t frames; /* MOST_FRAMES: the file may have more */
    int end;         /* 0: end of the file; -1: error; 1: neither reached */
    uint64_t whole[MOST_FRAMES], shapes[MOST_FRAMES];
    char error[ERROR_BYTES];
} pass;

/* topology: whose errors they may be, too; NULL: none. */
static void check_error(const char *path, const char *topology, const char *error)
{
    if (topology && !strncmp(error, topology, strlen(topology)))
        path = topology;
    FUZZ_CHECK(!strncmp(error, path, strlen(path)) && error[strlen(path)] == ':', "the error \"%s\" has no path",
               error);
    FUZZ_CHECK(strlen(error) > strlen(path) + 2, "the error \"%s\" says nothing", error);
}

/* After an error every call repeats it; after the end there is no frame. */
static void check_end(cgt_trajectory *t, const char *path, const pass *p)
{
    char error[ERROR_BYTES] = "";
    cgt_trajectory_frame frame;
    if (p->end == 1)
        return;
    FUZZ_CHECK(told_read(t, &frame, error, sizeof error) == p->end, "%s: a frame after the end", path);
    if (p->end == 0)
        return;
    check_error(path, NULL, p->error);
    FUZZ_CHECK(!strcmp(p->error, error), "\"%s\", then \"%s\"", p->error, error);
    FUZZ_CHECK(told_skip(t, error, sizeof error) == -1 && !strcmp(p->error, error), "skip goes past an error");
}

static void read_all(cgt_trajectory *t, const char *path, const cgt_trajectory_options *o, cgt_trajectory_writer **copy,
                     const char *copy_path, pass *p)
{
    cgt_trajectory_frame frame;
    char error[ERROR_BYTES] = "";
    *p = (pass){.end = 1};
    while (p->frames < MOST_FRAMES && (p->end = told_read(t, &frame, p->error, sizeof p->error)) == 1) {
        check_frame(&frame, p->frames, o);
        p->whole[p->frames] = frame_hash(&frame);
        p->shapes[p->frames] = frame_hash_shapes(&frame);
        const double progress = cgt_trajectory_progress(t);
        FUZZ_CHECK(progress <= 1, "progress %g", progress);
        const bool spheres = frame.kind == CGT_TRAJECTORY_SPHERES;
        if (copy && !*copy) {
            *copy = spheres ? told_writer_open(copy_path, frame.origin, error, sizeof error)
                            : told_writer_open_triangles(copy_path, frame.origin, frame.index, frame.triangles, error,
                                                         sizeof error);
            FUZZ_CHECK(*copy, "%s", error);
        }
        if (copy)
            FUZZ_CHECK(!(spheres ? told_writer_add(*copy, frame.xyzr, frame.count, error, sizeof error)
                                 : told_writer_add_vertices(*copy, frame.position, frame.count, error, sizeof error)),
                       "%s", error);
        p->frames++;
    }
    check_end(t, path, p);
}

static void rewind_it(cgt_trajectory *t)
{
    char error[ERROR_BYTES] = "";
    FUZZ_CHECK(!told_rewind(t, error, sizeof error), "%s", error);
}

/* Skipping passes at least the frames that reading finds; without an error, exactly those. */
static void skip_all(cgt_trajectory *t, const char *path, const pass *p)
{
    char error[ERROR_BYTES] = "";
    uint64_t counted = 0;
    uint32_t frames = 0;
    int got = 1;
    rewind_it(t);
    while (frames < MOST_FRAMES && (got = told_skip(t, error, sizeof error)) == 1)
        frames++;
    FUZZ_CHECK(frames >= p->frames && (p->end == -1 || frames == p->frames), "%u frames skipped of %u", frames,
               p->frames);
    if (got == 1)
        return; /* counting all of them may legitimately take very long */
    FUZZ_CHECK(p->end == -1 || got == 0, "skip: %s", error);
    if (got == -1)
        check_error(path, NULL, error);
    rewind_it(t);
    FUZZ_CHECK(told_count_frames(t, &counted, error, sizeof error) == got, "count: %s", error);
    FUZZ_CHECK(got == -1 || counted == frames, "%llu frames counted of %u", (unsigned long long)counted, frames);
}

static void read_again(cgt_trajectory *t, const char *path, const cgt_trajectory_options *o, const pass *first)
{
    pass again;
    rewind_it(t);
    read_all(t, path, o, NULL, NULL, &again);
    FUZZ_CHECK(again.frames == first->frames && again.end == first->end, "read twice: %u frames, then %d; %u, then %d",
               first->frames, first->end, again.frames, again.end);
    /* why bytes cannot be decompressed is libarchive's to say, which may say another thing */
    const bool is_ours = strstr(first->error, "cannot be decompressed") == NULL;
    FUZZ_CHECK(!is_ours || !strcmp(again.error, first->error), "read twice: \"%s\", then \"%s\"", first->error,
               again.error);
    FUZZ_CHECK(!memcmp(again.whole, first->whole, sizeof again.whole), "read twice, the frames differ");
}

/* Rewound after 0, 1, half of the frames, and all of them; and after skipping as many, which leaves the others as they
 * are: an error of a frame that was skipped may show or not. */
static void read_in_parts(cgt_trajectory *t, const char *path, const cgt_trajectory_options *o, const pass *first)
{
    const uint32_t points[4] = {0, 1, first->frames / 2, first->frames + 1};
    char error[ERROR_BYTES] = "";
    cgt_trajectory_frame frame;
    for (int k = 0; k < 4; k++) {
        rewind_it(t);
        for (uint32_t i = 0; i < points[k]; i++)
            told_read(t, &frame, error, sizeof error);
        read_again(t, path, o, first);
        rewind_it(t);
        for (uint32_t i = 0; i < points[k]; i++)
            told_skip(t, error, sizeof error);
        const bool is_read = told_read(t, &frame, error, sizeof error) == 1;
        if (points[k] < first->frames)
            FUZZ_CHECK(is_read && frame_hash(&frame) == first->whole[points[k]], "frame %u after skipping differs",
                       points[k]);
        read_again(t, path, o, first);
    }
}

/* The copy equals the frames that were read. */
static void read_copy(const char *path, const pass *first)
{
    char error[ERROR_BYTES] = "";
    cgt_trajectory_options o;
    pass copy;
    cgt_trajectory_options_init(&o);
    cgt_trajectory *t = told_open(path, &o, error, sizeof error);
    FUZZ_CHECK(t, "the copy: %s", error);
    read_all(t, path, &o, NULL, NULL, &copy);
    FUZZ_CHECK(copy.frames == first->frames && copy.end != -1, "the copy has %u frames of %u, and ends with \"%s\"",
               copy.frames, first->frames, copy.error);
    FUZZ_CHECK(!memcmp(copy.shapes, first->shapes, sizeof copy.shapes), "the copy differs");
    cgt_trajectory_close(t);
}

void fuzz_file(const char *ending, const uint8_t *bytes, size_t size, const cgt_trajectory_options *options)
{
    char error[ERROR_BYTES] = "";
    const char *const path = fuzz_scratch("input", ending, bytes, size);
    const char *const copy_path = scratch_path("copy", ".frames");
    pass first;
    cgt_trajectory_writer *copy = NULL;
    remove(copy_path);
    cgt_trajectory *t = told_open(path, options, error, sizeof error);
    if (!t) {
        check_error(path, options->topology, error);
        return;
    }
    want_columns(t, options->topology);
    read_all(t, path, options, &copy, copy_path, &first);
    read_again(t, path, options, &first);
    read_in_parts(t, path, options, &first);
    skip_all(t, path, &first);
    cgt_trajectory_close(t);
    FUZZ_CHECK(!told_writer_close(copy, error, sizeof error), "%s", error);
    if (first.frames)
        read_copy(copy_path, &first);
}

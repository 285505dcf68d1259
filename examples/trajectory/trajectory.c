/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Trajectories: opening by ending, reading, and the arrays of a frame. Each format has a file of its own. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include "trajectory/trajectory_internal.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#define DEFAULT_MAX_COUNT ((uint64_t)1 << 31)
#define DEFAULT_FPS 30.0

static const trajectory_format *const formats[] = {&trajectory_format_lammps, &trajectory_format_xyz,
                                                   &trajectory_format_frames, &trajectory_format_mesh};

/* ---- For the formats ---------------------------------------------------------------------------------------- */

int trajectory_line(trajectory *t, text_span *line)
{
    const char *reason = "";
    const int status = text_reader_next(&t->text, line, &reason);
    return status < 0 ? trajectory_fail(t, t->text.line, "%s", reason) : status;
}

int trajectory_line_inside(trajectory *t, text_span *line, const char *section)
{
    const int status = trajectory_line(t, line);
    return status == 0 ? trajectory_fail(t, t->text.line, "the file ends %s: it is cut off", section) : status;
}

int trajectory_parse_count(trajectory *t, text_span word, uint32_t *count)
{
    char quote[TEXT_QUOTE_SIZE];
    uint64_t value;
    if (!text_u64(word, UINT64_MAX, &value)) {
        return trajectory_fail(t, t->text.line, "'%s' is not a number of spheres", text_quote(word, quote));
    }
    if (value > t->options.max_count) {
        return trajectory_fail(t, t->text.line, "%" PRIu64 " spheres are more than the limit of %" PRIu64, value,
                               t->options.max_count);
    }
    *count = (uint32_t)value;
    return 1;
}

int trajectory_grow(void *array, size_t capacity, size_t bytes)
{
    void *old;
    memcpy(&old, array, sizeof old);
    if (capacity > SIZE_MAX / bytes) {
        return -1;
    }
    void *const larger = realloc(old, capacity * bytes);
    if (larger == NULL) {
        return -1;
    }
    memcpy(array, &larger, sizeof larger);
    return 0;
}

int trajectory_reserve(trajectory *t, size_t count, size_t expected)
{
    trajectory_store *const s = &t->store;
    if (count <= s->capacity && s->capacity > 0) {
        return 1;
    }
    size_t capacity = s->capacity > SIZE_MAX / 2 ? SIZE_MAX : 2 * s->capacity;
    capacity = capacity < 4096 ? 4096 : capacity;
    capacity = capacity > expected ? expected : capacity;
    capacity = capacity < count ? count : capacity;
    capacity = capacity == 0 ? 1 : capacity;
    if (trajectory_grow(&s->xyzr, capacity, 4 * sizeof *s->xyzr) || trajectory_grow(&s->id, capacity, sizeof *s->id) ||
        trajectory_grow(&s->type, capacity, sizeof *s->type) ||
        trajectory_grow(&s->velocity, capacity, 3 * sizeof *s->velocity)) {
        return trajectory_fail(t, t->text.line, "not enough memory for %zu spheres", capacity);
    }
    s->capacity = capacity;
    return 1;
}

static void fill_frame(const trajectory *t, trajectory_frame *frame, trajectory_kind kind, uint32_t count)
{
    memset(frame, 0, sizeof *frame);
    frame->number = t->next;
    frame->kind = kind;
    frame->step = (int64_t)t->next;
    frame->count = count;
    for (int axis = 0; axis < 3; axis++) {
        frame->box_min[axis] = 1.0f;
        frame->box_max[axis] = -1.0f;
    }
}

void trajectory_frame_fill(trajectory *t, trajectory_frame *frame, uint32_t count)
{
    fill_frame(t, frame, TRAJECTORY_SPHERES, count);
    frame->xyzr = t->store.xyzr;
}

void trajectory_frame_fill_triangles(trajectory *t, trajectory_frame *frame, uint32_t count, uint32_t triangles)
{
    fill_frame(t, frame, TRAJECTORY_TRIANGLES, count);
    frame->triangles = triangles;
}

/* ---- Opening and closing ------------------------------------------------------------------------------------ */

void trajectory_options_init(trajectory_options *options)
{
    options->radius = 0.0f;
    options->wrapped = 0;
    options->max_count = DEFAULT_MAX_COUNT;
    options->fps = DEFAULT_FPS;
    options->clip = NULL;
}

/* Returns the path's ending with its dot, or NULL: none, or nothing before it. */
static const char *find_ending(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash != NULL ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    return dot != NULL && dot > path ? dot : NULL;
}

static int has_ending(const trajectory_format *format, const char *ending)
{
    if (format->knows != NULL) {
        return format->knows(ending);
    }
    for (const char *const *known = format->endings; *known != NULL; known++) {
        if (strcasecmp(ending, *known) == 0) {
            return 1;
        }
    }
    return 0;
}

static const trajectory_format *find_format(const char *path)
{
    const char *ending = find_ending(path);
    for (size_t f = 0; ending != NULL && f < sizeof formats / sizeof formats[0]; f++) {
        if (has_ending(formats[f], ending)) {
            return formats[f];
        }
    }
    return NULL;
}

/* Copies the options and fills in the defaults. Returns 0, or -1: no memory. */
static int copy_options(trajectory_options *copy, const trajectory_options *options)
{
    trajectory_options_init(copy);
    if (options == NULL) {
        return 0;
    }
    *copy = *options;
    if (copy->max_count == 0) {
        copy->max_count = DEFAULT_MAX_COUNT;
    }
    if (copy->max_count >= UINT32_MAX) {
        copy->max_count = UINT32_MAX - 1;
    }
    if (copy->fps == 0.0) {
        copy->fps = DEFAULT_FPS;
    }
    copy->clip = options->clip != NULL ? strdup(options->clip) : NULL;
    return options->clip != NULL && copy->clip == NULL ? -1 : 0;
}

/* Returns a trajectory without its file, or NULL: no memory. */
static trajectory *new_trajectory(const char *path, const trajectory_format *format, const trajectory_options *options)
{
    trajectory *t = calloc(1, sizeof *t);
    if (t == NULL) {
        return NULL;
    }
    t->format = format;
    t->path = strdup(path);
    t->state = calloc(1, format->state_size);
    if (copy_options(&t->options, options) || t->path == NULL || t->state == NULL) {
        trajectory_close(t);
        return NULL;
    }
    return t;
}

static int open_file(trajectory *t)
{
    t->file = fopen(t->path, "rb");
    struct stat status;
    if (t->file == NULL || fstat(fileno(t->file), &status) != 0) {
        return trajectory_fail(t, 0, "%s", strerror(errno));
    }
    if (S_ISDIR(status.st_mode)) {
        return trajectory_fail(t, 0, "%s", strerror(EISDIR));
    }
    t->regular = S_ISREG(status.st_mode);
    t->file_size = t->regular ? (uint64_t)status.st_size : 0;
    text_reader_init(&t->text, t->file);
    return t->format->begin(t);
}

trajectory *trajectory_open(const char *path, const trajectory_options *options, char *error, size_t error_size)
{
    const trajectory_format *format = find_format(path);
    if (format == NULL) {
        trajectory_path_error(
            path,
            "the ending is not one of .lammpstrj, .dump, .xyz, .extxyz, .frames, nor that of a mesh that can be "
            "read here",
            error, error_size);
        return NULL;
    }
    if (options != NULL && !(options->radius >= 0.0f && isfinite(options->radius))) {
        trajectory_path_error(path, "the radius for files without one must be 0 or more", error, error_size);
        return NULL;
    }
    if (options != NULL && !(options->fps >= 0.0 && isfinite(options->fps))) {
        trajectory_path_error(path, "the frames per second must be 0 or more", error, error_size);
        return NULL;
    }
    trajectory *t = new_trajectory(path, format, options);
    if (t == NULL) {
        trajectory_path_error(path, "not enough memory", error, error_size);
        return NULL;
    }
    if (open_file(t) < 0) {
        trajectory_copy_message(t, error, error_size);
        trajectory_close(t);
        return NULL;
    }
    return t;
}

void trajectory_close(trajectory *t)
{
    if (t == NULL) {
        return;
    }
    if (t->state != NULL) {
        t->format->end(t);
    }
    if (t->file != NULL) {
        fclose(t->file);
    }
    text_reader_free(&t->text);
    free(t->store.xyzr);
    free(t->store.id);
    free(t->store.type);
    free(t->store.velocity);
    free(t->state);
    free((char *)t->options.clip);
    free(t->path);
    free(t);
}

const trajectory_mesh *trajectory_get_mesh(const trajectory *t)
{
    return t->format->mesh != NULL ? t->format->mesh(t) : NULL;
}

/* ---- Reading ------------------------------------------------------------------------------------------------ */

int trajectory_read(trajectory *t, trajectory_frame *frame, char *error, size_t error_size)
{
    const int status = t->failed ? -1 : t->format->read(t, frame);
    if (status < 0) {
        trajectory_copy_message(t, error, error_size);
    }
    if (status > 0 && t->text.is_open) {
        trajectory_warn_open(t, t->text.line);
    }
    t->next += status > 0;
    return status;
}

int trajectory_skip(trajectory *t, char *error, size_t error_size)
{
    const int status = t->failed ? -1 : t->format->skip(t);
    if (status < 0) {
        trajectory_copy_message(t, error, error_size);
    }
    t->next += status > 0;
    return status;
}

int trajectory_rewind(trajectory *t, char *error, size_t error_size)
{
    int done = -1;
    if (!t->regular) { /* reading may continue if it could before */
        const int failed = t->failed;
        trajectory_fail(t, 0, "cannot go back to the first frame: not a regular file");
        t->failed = failed;
    } else if (fseeko(t->file, 0, SEEK_SET) != 0) {
        trajectory_fail(t, 0, "%s", strerror(errno));
    } else {
        clearerr(t->file);
        text_reader_restart(&t->text);
        t->next = 0;
        t->failed = 0;
        done = t->format->begin(t);
    }
    if (done < 0) {
        trajectory_copy_message(t, error, error_size);
        return -1;
    }
    return 0;
}

int trajectory_count_frames(trajectory *t, uint64_t *frames, char *error, size_t error_size)
{
    if (trajectory_rewind(t, error, error_size)) {
        return -1;
    }
    int status;
    while ((status = trajectory_skip(t, error, error_size)) > 0) {
    }
    if (status < 0) {
        return -1;
    }
    *frames = t->next;
    return trajectory_rewind(t, error, error_size);
}

double trajectory_progress(const trajectory *t)
{
    if (t->format->progress != NULL) {
        return t->format->progress(t);
    }
    if (!t->regular || t->file_size == 0) {
        return -1.0;
    }
    const off_t offset = ftello(t->file);
    if (offset < 0) {
        return -1.0;
    }
    /* Bytes in the line buffer are not read yet. */
    const double done = ((double)offset - (double)(t->text.end - t->text.begin)) / (double)t->file_size;
    return done > 1.0 ? 1.0 : done;
}

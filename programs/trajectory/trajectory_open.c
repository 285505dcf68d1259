/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Opening trajectories: the format by name or ending, one file or a series of them. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include "trajectory/trajectory_content.h"
#include "trajectory/trajectory_internal.h"
#include "trajectory/atoms/trajectory_topology.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#define DEFAULT_MAX_COUNT ((uint64_t)1 << 31)
#define DEFAULT_FPS 30.0

typedef struct reader_row {
    const trajectory_format *format;
    const char *names, *endings; /* with ", " between them; "": goes by knows alone */
} reader_row;

#define ROW(format, name, names, told, known) {&trajectory_format_##format, name ", " names, told ", " known},
static const reader_row readers[] = {TRAJECTORY_READERS(ROW, ROW){&trajectory_format_mesh, "", ""}};
#undef ROW
enum { READERS = sizeof readers / sizeof readers[0] };

void cgt_trajectory_options_init(cgt_trajectory_options *options)
{
    *options = (cgt_trajectory_options){.max_count = DEFAULT_MAX_COUNT, .fps = DEFAULT_FPS, .threads = 1};
}

/* Returns the path's ending with its dot, or NULL: none, or nothing before it. */
static const char *find_ending(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash != NULL ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    return dot != NULL && dot > path ? dot : NULL;
}

/* Whether a list has a word, in letters of either case. */
static int has_word(const char *list, const char *word)
{
    const size_t length = strlen(word);
    for (; *list != '\0'; list += strspn(list, ", ")) {
        const size_t size = strcspn(list, ",");
        if (size == length && strncasecmp(list, word, length) == 0)
            return 1;
        list += size;
    }
    return 0;
}

static const trajectory_format *find_format(const char *ending)
{
    for (size_t i = 0; ending != NULL && i < READERS; i++) {
        const trajectory_format *const format = readers[i].format;
        if (format->knows != NULL ? format->knows(ending) : has_word(readers[i].endings, ending))
            return format;
    }
    return NULL;
}

/* By the name that the options give. */
static const trajectory_format *find_named_format(const char *name)
{
    for (size_t i = 0; i < READERS; i++)
        if (has_word(readers[i].names, name))
            return readers[i].format;
    return NULL;
}

/* By the ending of a path, which may have one such as .gz after it. */
static const trajectory_format *find_path_format(const char *path)
{
    char *bare = strdup(path);
    if (bare == NULL)
        return NULL;
    bare[trajectory_input_bare_length(path)] = '\0';
    const trajectory_format *found = find_format(find_ending(bare));
    free(bare);
    return found;
}

/* Copies the options and fills in the defaults. Returns 0, or -1: no memory. */
static int copy_options(cgt_trajectory_options *copy, const cgt_trajectory_options *options)
{
    cgt_trajectory_options_init(copy);
    if (options == NULL)
        return 0;
    *copy = *options;
    if (copy->max_count == 0)
        copy->max_count = DEFAULT_MAX_COUNT;
    if (copy->max_count >= UINT32_MAX)
        copy->max_count = UINT32_MAX - 1;
    if (copy->fps == 0.0)
        copy->fps = DEFAULT_FPS;
    copy->format = copy->topology = NULL; /* used while opening */
    copy->clip = options->clip != NULL ? strdup(options->clip) : NULL;
    return options->clip != NULL && copy->clip == NULL ? -1 : 0;
}

/* Gives a trajectory what is its own before a file is open. Returns 1, or -1: no memory. */
static int begin_trajectory(cgt_trajectory *t, const char *const *paths, size_t count, const trajectory_format *format,
                            const cgt_trajectory_options *options)
{
    t->format = format;
    t->state = format != NULL ? calloc(1, format->state_size) : NULL;
    t->paths = calloc(count, sizeof *t->paths);
    int missing = copy_options(&t->options, options) || (format != NULL && t->state == NULL) || t->paths == NULL;
    for (size_t i = 0; i < count && !missing; i++) {
        t->paths[i] = strdup(paths[i]);
        missing = t->paths[i] == NULL;
        t->path_count++;
    }
    if (missing)
        return trajectory_refuse(t, paths[0], CGT_ERROR_OUT_OF_MEMORY, "not enough memory");
    t->path = t->paths[0];
    if (t->options.has_origin)
        trajectory_take_origin(t, t->options.origin);
    return 1;
}

/* A signature decides against the ending of a name that was not told to be of a format. */
static int check_signature(cgt_trajectory *t)
{
    char bytes[CONTENT_BYTES];
    const long size = trajectory_input_peek(&t->input, bytes, sizeof bytes);
    const trajectory_format *const found = size > 0 ? trajectory_find_signature(bytes, (size_t)size) : NULL;
    if (found == NULL || found == t->format)
        return 1;
    void *const state = calloc(1, found->state_size);
    if (state == NULL)
        return trajectory_fail(t, 0, "not enough memory");
    free(t->state);
    t->state = state;
    t->format = found;
    return 1;
}

/* Finds the format in the first bytes: 1 or -1. */
static int find_content(cgt_trajectory *t)
{
    char bytes[CONTENT_BYTES];
    const long size = trajectory_input_peek(&t->input, bytes, sizeof bytes);
    if (size < 0)
        return trajectory_fail(t, 0, "%s", t->input.error[0] != '\0' ? t->input.error : strerror(errno));
    t->format = trajectory_find_content(bytes, (size_t)size);
    if (size == 0 && t->path_count == 1 && t->options.follow == 0.0) /* no frames, in any format */
        t->format = &trajectory_format_xyz;
    if (t->format == NULL)
        return trajectory_fail(t, 0,
                               "the first bytes are those of no format that is known, and the ending is not one "
                               "of " TRAJECTORY_ENDINGS
                               ", nor that of a mesh that can be read here; other names need a format");
    t->state = calloc(1, t->format->state_size);
    return t->state != NULL ? 1 : trajectory_fail(t, 0, "not enough memory");
}

int trajectory_open_file(cgt_trajectory *t, size_t number)
{
    char reason[256];
    const int is_last = number + 1 == t->path_count;
    trajectory_input_close(&t->input);
    t->file = t->text.file = NULL;
    t->path_at = number;
    t->path = t->paths[number];
    struct stat status;
    if (t->format == &trajectory_format_mesh && stat(t->path, &status) == 0 && !S_ISREG(status.st_mode) &&
        !S_ISDIR(status.st_mode))
        return trajectory_fail(t, 0, "a mesh has to be a regular file"); /* opening a pipe would wait for its bytes */
    if (trajectory_input_open(&t->input, t->path, is_last ? t->options.follow : 0.0, &t->options, reason,
                              sizeof reason))
        return trajectory_fail(t, 0, "%s", reason);
    t->file = t->input.stream;
    t->regular = t->input.plain;
    t->file_size = t->input.plain ? t->input.file_size : 0;
    if (t->text.data == NULL)
        text_reader_init(&t->text, t->file);
    const int is_guess = number == 0 && t->next == 0 && !t->is_named && t->format != NULL;
    if ((t->format == NULL && find_content(t) < 0) ||
        (is_guess && t->input.plain && t->format != &trajectory_format_mesh && check_signature(t) < 0))
        return -1;
    if (t->file == NULL && t->format->is_binary)
        return trajectory_fail(t, 0, "on this system files of this format must be whole, and no pipes");
    if (t->format->lacks_places && !t->is_topology)
        return trajectory_fail(t, 0, "files of this format have no positions: give it as the topology of a trajectory");
    t->text.file = t->file;
    t->text.read_some = t->input.plain ? NULL : trajectory_input_read;
    t->text.input = &t->input;
    t->text.why = t->input.error;
    text_reader_restart(&t->text);
    return t->format->begin(t);
}

/* Returns NULL, or what is wrong with the options. */
static const char *check_options(const cgt_trajectory_options *options)
{
    if (options == NULL)
        return NULL;
    if (!(options->radius >= 0.0f && isfinite(options->radius)))
        return "the radius for files without one must be 0 or more";
    if (!(options->fps >= 0.0 && isfinite(options->fps)))
        return "the frames per second must be 0 or more";
    if (options->has_origin && !trajectory_is_finite(options->origin))
        return "the origin must be finite";
    return options->follow >= 0.0 && isfinite(options->follow) ? NULL : "the seconds to wait must be 0 or more";
}

/* Returns NULL, or why these files are no run of this format. */
static const char *check_series(const trajectory_format *format, const char *const *paths, size_t count, double follow)
{
    if (count > 1 && !format->is_series)
        return "files of this format cannot be read as a series: each has a whole run";
    if (follow > 0.0 && !format->is_followed)
        return "files of this format cannot be read while they are written";
    for (size_t i = 0; i < count && count > 1; i++)
        if (strcmp(paths[i], "-") == 0)
            return "standard input cannot be one of several files";
    return NULL;
}

/* Looks for files that are missing, or of another format by their endings, before the first frame is used. format: that
 * of the first; NULL: it does not go by endings. */
static const char *check_paths(const trajectory_format *format, const char *const *paths, size_t count,
                               const char **wrong)
{
    for (size_t i = 1; i < count; i++) {
        const trajectory_format *const other = find_path_format(paths[i]);
        *wrong = paths[i];
        if (other != NULL && format != NULL && other != format)
            return "not of the format of the files before it";
        if (access(paths[i], R_OK) != 0)
            return strerror(errno);
    }
    return NULL;
}

/* Opens the first file, with its topology. Returns 1, or -1 with an error noted. */
static int open_series(cgt_trajectory *t, const char *const *paths, size_t count, const cgt_trajectory_options *options)
{
    const double follow = options != NULL ? options->follow : 0.0;
    const char *path = count > 0 ? paths[0] : "";
    const char *const named = options != NULL ? options->format : NULL;
    const trajectory_format *format = named != NULL ? find_named_format(named) : find_path_format(path);
    const char *reason = check_options(options);
    if (count == 0)
        reason = "no file is given";
    else if (format == NULL && named != NULL)
        reason = "the format is not one of " TRAJECTORY_FORMATS;
    else if (reason == NULL && format != NULL)
        reason = check_series(format, paths, count, follow);
    const char *wrong = path;
    if (reason == NULL && (reason = check_paths(named == NULL ? format : NULL, paths, count, &wrong)) != NULL)
        path = wrong;
    if (reason != NULL)
        return trajectory_refuse(t, path, CGT_ERROR_FILE, reason);
    t->is_named = named != NULL;
    if (begin_trajectory(t, paths, count, format, options) < 0 || trajectory_open_file(t, 0) < 0)
        return -1;
    if (t->format != format && (reason = check_series(t->format, paths, count, follow)) != NULL)
        return trajectory_fail(t, 0, "%s", reason);
    return options == NULL || options->topology == NULL || topology_open(t, options->topology, options) == CGT_OK ? 1
                                                                                                                  : -1;
}

static cgt_result open_all(const char *const *paths, size_t count, const cgt_trajectory_options *options,
                           int is_topology, cgt_trajectory **made)
{
    cgt_trajectory *t = *made = calloc(1, sizeof *t);
    if (t == NULL)
        return CGT_ERROR_OUT_OF_MEMORY;
    t->input.descriptor = -1;
    t->is_topology = is_topology;
    const int status = open_series(t, paths, count, options);
    t->is_open = status > 0;
    t->failed |= status < 0;
    return trajectory_result(t, status);
}

cgt_result cgt_trajectory_open_series(const char *const *paths, size_t count, const cgt_trajectory_options *options,
                                      cgt_trajectory **made)
{
    return open_all(paths, count, options, 0, made);
}

cgt_result trajectory_open_topology(const char *path, const cgt_trajectory_options *options, cgt_trajectory **made)
{
    return open_all(&path, 1, options, 1, made);
}

cgt_result cgt_trajectory_open(const char *path, const cgt_trajectory_options *options, cgt_trajectory **made)
{
    return cgt_trajectory_open_series(&path, 1, options, made);
}

/* ---- Order of a series -------------------------------------------------------------------------------------- */

static int is_digit(char c) { return c >= '0' && c <= '9'; }

/* Numbers in the names by their values: dump.9 precedes dump.10. */
static int compare_names(const char *a, const char *b)
{
    while (*a != '\0' && *b != '\0') {
        if (!is_digit(*a) || !is_digit(*b)) {
            if (*a != *b)
                return (unsigned char)*a < (unsigned char)*b ? -1 : 1;
            a++;
            b++;
            continue;
        }
        a += strspn(a, "0");
        b += strspn(b, "0");
        const size_t digits_a = strspn(a, "0123456789"), digits_b = strspn(b, "0123456789");
        const int order = digits_a == digits_b ? memcmp(a, b, digits_a) : digits_a < digits_b ? -1 : 1;
        if (order != 0)
            return order;
        a += digits_a;
        b += digits_b;
    }
    return (*a != '\0') - (*b != '\0');
}

static int compare_paths(const void *a, const void *b)
{
    const char *const left = *(const char *const *)a, *const right = *(const char *const *)b;
    const int order = compare_names(left, right);
    return order != 0 ? order : strcmp(left, right);
}

void cgt_trajectory_sort_series(const char **paths, size_t count) { qsort(paths, count, sizeof *paths, compare_paths); }

void cgt_trajectory_close(cgt_trajectory *t)
{
    if (t == NULL)
        return;
    if (t->state != NULL && t->format != NULL && t->format->end != NULL)
        t->format->end(t);
    trajectory_input_close(&t->input);
    text_reader_free(&t->text);
    trajectory_store_free(&t->store);
    bond_list_free(&t->bonds);
    columns_free(&t->columns);
    topology_close(t->topology);
    free(t->state);
    free((char *)t->options.clip);
    for (size_t i = 0; t->paths != NULL && i < t->path_count; i++)
        free(t->paths[i]);
    free(t->paths);
    free(t);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * reader_cases [--accept] [NAME...]
 * Reads the files of each folder of tests/readers/cases, or of those named, and compares all that their frames,
 * warnings and errors hold with the file `expected` there; --accept writes that file. Each file is also rewound and
 * read again, and read from each frame on after skipping those before it: that has to give the same. The README there
 * tells more. */
#define _GNU_SOURCE
#define _FILE_OFFSET_BITS 64 /* folders are read on systems of 32 bits, too, whatever numbers their entries have */
#include <dirent.h>

#include "readers/frame_text.h"
#include "readers/line_difference.h"
#include "support/trajectory_told.h"

#define MOST_FILES 128
#define MOST_NAMES CGT_TRAJECTORY_MOST_COLUMNS
#define CASES CGT_TESTS_DIR "/readers/cases"

/* A folder, and what its file `options` says. */
typedef struct reader_case {
    char name[256], folder[1024];
    char *file[MOST_FILES]; /* names within the folder, in order; owned */
    size_t files;
    cgt_trajectory_options options;
    char format[64], topology[1536];
    text words; /* the file itself, cut into words */
    const char *column[MOST_NAMES];
    size_t columns;
    int has_columns, is_series;
    text out;     /* what is compared */
    int is_wrong; /* whatever is expected: options, rewinding, skipping */
} reader_case;

static void wrong(reader_case *c, const char *what, const char *detail)
{
    text_print(&c->out, "WRONG: %s%s\n", what, detail);
    c->is_wrong = 1;
}

/* ---- Files ---------------------------------------------------------------------------------------------------- */

static int compare_names(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

/* The names in a folder but `.`, `..` and other hidden ones, in order; -1: no folder. */
static int list_folder(const char *path, char **name, size_t most)
{
    int count = 0;
    DIR *const folder = opendir(path);
    if (folder == NULL)
        return -1;
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;)
        if (entry->d_name[0] != '.') {
            if ((size_t)count == most || (name[count] = strdup(entry->d_name)) == NULL)
                abort();
            count++;
        }
    closedir(folder);
    qsort(name, (size_t)count, sizeof *name, compare_names);
    return count;
}

/* Adds the bytes of a file without carriage returns; 0: there is none. */
static int read_file(const char *path, text *t)
{
    FILE *const file = fopen(path, "rb");
    if (file == NULL)
        return 0;
    for (int byte; (byte = getc(file)) != EOF;)
        if (byte != '\r')
            text_add(t, &(char){(char)byte}, 1);
    fclose(file);
    return 1;
}

static const char *path_of(const reader_case *c, const char *file)
{
    static char path[2][2048];
    static int turn;
    turn = 1 - turn;
    snprintf(path[turn], sizeof path[turn], "%s/%s", c->folder, file);
    return path[turn];
}

/* Adds a message without the folder's path; also, a line each, to the file that CGT_TEST_MESSAGES names, for
 * tests/readers/messages.sh. */
static void add_message(reader_case *c, const char *kind, const char *message)
{
    const size_t length = strlen(c->folder) + 1, begin = c->out.size + strlen(kind);
    text_add(&c->out, kind, strlen(kind));
    for (const char *p = message; *p != '\0';) {
        if (strncmp(p, c->folder, length - 1) == 0 && p[length - 1] == '/')
            p += length;
        text_add(&c->out, p, *p != '\0');
        p += *p != '\0';
    }
    text_add(&c->out, "\n", 1);
    const char *const path = getenv("CGT_TEST_MESSAGES");
    FILE *const file = path != NULL ? fopen(path, "a") : NULL;
    if (file != NULL) {
        fputs(c->out.bytes + begin, file);
        fclose(file);
    }
}

/* ---- Options -------------------------------------------------------------------------------------------------- */

static void add_file(reader_case *c, const char *name)
{
    if (c->files == MOST_FILES || (c->file[c->files++] = strdup(name)) == NULL)
        abort();
}

/* A line of `options`: its first word, and what follows it. */
static int take_option(reader_case *c, const char *word, char *rest)
{
    cgt_trajectory_options *const o = &c->options;
    if (strcmp(word, "columns") == 0) {
        c->has_columns = 1;
        for (char *name = strtok(rest, " "); name != NULL && c->columns < MOST_NAMES; name = strtok(NULL, " "))
            c->column[c->columns++] = name;
    } else if (strcmp(word, "format") == 0) {
        snprintf(c->format, sizeof c->format, "%s", rest);
        o->format = c->format;
    } else if (strcmp(word, "topology") == 0) {
        snprintf(c->topology, sizeof c->topology, "%s/%s", c->folder, rest);
        o->topology = c->topology;
    } else if (strcmp(word, "origin") == 0) {
        o->has_origin = 1;
        return sscanf(rest, "%lf %lf %lf", &o->origin[0], &o->origin[1], &o->origin[2]) == 3;
    } else if (strcmp(word, "radius") == 0) {
        o->radius = strtof(rest, NULL);
    } else if (strcmp(word, "max_count") == 0) {
        o->max_count = strtoull(rest, NULL, 10);
    } else if (strcmp(word, "wrapped") == 0) {
        o->wrapped = 1;
    } else if (strcmp(word, "all_bonds") == 0) {
        o->all_bonds = 1;
    } else if (strcmp(word, "leave_out_sites") == 0) {
        o->leave_out_sites = 1;
    } else if (strcmp(word, "series") == 0) {
        c->is_series = 1;
    } else if (strcmp(word, "input") == 0) {
        add_file(c, rest);
    } else {
        return word[0] == '#' || word[0] == '\0';
    }
    return 1;
}

static void read_options(reader_case *c)
{
    cgt_trajectory_options_init(&c->options);
    if (!read_file(path_of(c, "options"), &c->words))
        return;
    for (char *line = c->words.bytes; line != NULL;) {
        char *const next = strchr(line, '\n');
        if (next != NULL)
            *next = '\0';
        char *rest = line + strcspn(line, " ");
        if (*rest != '\0')
            *rest++ = '\0';
        if (!take_option(c, line, rest))
            wrong(c, "options: ", line);
        line = next != NULL ? next + 1 : NULL;
    }
}

/* ---- Reading -------------------------------------------------------------------------------------------------- */

static cgt_trajectory *open_input(const reader_case *c, const char *file, char *error, size_t size)
{
    const char *path[MOST_FILES];
    char paths[MOST_FILES][1536];
    if (!c->is_series)
        return told_open(path_of(c, file), &c->options, error, size);
    for (size_t i = 0; i < c->files; i++) {
        snprintf(paths[i], sizeof paths[i], "%s", path_of(c, c->file[i]));
        path[i] = paths[i];
    }
    return told_open_series(path, c->files, &c->options, error, size);
}

/* Names of columns that some frame has; `names` owns them. */
static size_t find_columns(const reader_case *c, const char *file, char *name[MOST_NAMES])
{
    char error[4096];
    size_t names = 0;
    cgt_trajectory_frame frame;
    cgt_trajectory *const t = open_input(c, file, error, sizeof error);
    while (t != NULL && told_read(t, &frame, error, sizeof error) == 1)
        for (uint32_t i = 0; i < frame.columns; i++) {
            size_t k = 0;
            while (k < names && strcmp(name[k], frame.column[i].name) != 0)
                k++;
            if (k == names && names < MOST_NAMES && (name[names++] = strdup(frame.column[i].name)) == NULL)
                abort();
        }
    cgt_trajectory_close(t);
    return names;
}

/* Rewound and read again, all frames are the same; so is each after those before it were skipped. `begin` has the
 * places of frames in `first`. */
static void read_again(reader_case *c, cgt_trajectory *t, const text *first, const size_t *begin, size_t frames)
{
    char error[4096] = "";
    cgt_trajectory_frame frame;
    text again = {0};
    text_clear(&again);
    if (told_rewind(t, error, sizeof error))
        wrong(c, "not rewound: ", error);
    while (told_read(t, &frame, error, sizeof error) == 1)
        frame_text(&again, &frame);
    if (strcmp(again.bytes, first->bytes) != 0)
        wrong(c, "rewound and read again:\n", again.bytes);
    for (size_t k = 1; k < frames; k++) {
        text_clear(&again);
        told_rewind(t, error, sizeof error);
        for (size_t i = 0; i < k; i++)
            told_skip(t, error, sizeof error);
        if (told_read(t, &frame, error, sizeof error) == 1)
            frame_text(&again, &frame);
        if (again.size != begin[k + 1] - begin[k] || memcmp(again.bytes, first->bytes + begin[k], again.size) != 0)
            wrong(c, "after skipping:\n", again.bytes);
    }
    free(again.bytes);
}

/* All frames, with the warnings where they come, and the end. */
static void read_frames(reader_case *c, cgt_trajectory *t)
{
    enum { MOST_SKIPPED = 16 };
    size_t begin[MOST_SKIPPED + 1] = {0}, frames = 0;
    char error[4096] = "", repeated[4096] = "";
    cgt_trajectory_frame frame;
    text all = {0};
    int status;
    text_clear(&all);
    do {
        const size_t size = all.size;
        status = told_read(t, &frame, error, sizeof error);
        if (status == 1)
            frame_text(&all, &frame);
        text_add(&c->out, all.bytes + size, all.size - size);
        if (status == 1 && frames < MOST_SKIPPED)
            begin[++frames] = all.size;
        for (const char *warning; (warning = cgt_trajectory_take_warning(t)) != NULL;)
            add_message(c, "warning: ", warning);
    } while (status == 1);
    if (status < 0)
        add_message(c, "error: ", error);
    if (told_read(t, &frame, repeated, sizeof repeated) != status || strcmp(error, repeated) != 0 ||
        told_skip(t, repeated, sizeof repeated) != status || strcmp(error, repeated) != 0)
        wrong(c, "not repeated: ", repeated);
    read_again(c, t, &all, begin, frames);
    free(all.bytes);
}

static void read_input(reader_case *c, const char *file)
{
    char error[4096] = "";
    char *name[MOST_NAMES];
    text_print(&c->out, "== %s\n", c->is_series ? "series" : file);
    const size_t names = c->has_columns ? 0 : find_columns(c, file, name);
    cgt_trajectory *const t = open_input(c, file, error, sizeof error);
    if (t == NULL || told_want_columns(t, c->has_columns ? c->column : (const char *const *)name,
                                       c->has_columns ? c->columns : names, error, sizeof error) != 0)
        add_message(c, "error: ", error);
    else
        read_frames(c, t);
    cgt_trajectory_close(t);
    for (size_t i = 0; i < names; i++)
        free(name[i]);
}

static int is_input(const reader_case *c, const char *name)
{
    return strcmp(name, "expected") != 0 && strcmp(name, "options") != 0 &&
           (c->options.topology == NULL || strcmp(path_of(c, name), c->topology) != 0);
}

/* ---- Comparing ------------------------------------------------------------------------------------------------ */

static int judge(reader_case *c, int accept)
{
    const char *const path = path_of(c, "expected");
    text expected = {0};
    text_clear(&expected);
    read_file(path, &expected);
    int is_right = strcmp(expected.bytes, c->out.bytes) == 0 && !c->is_wrong;
    if (!is_right && accept && !c->is_wrong) {
        FILE *const file = fopen(path, "wb");
        const int is_written = file != NULL && fwrite(c->out.bytes, c->out.size, 1, file) == 1;
        is_right = file != NULL && fclose(file) == 0 && is_written;
        printf("%s: %s\n", path, is_right ? "written" : "not written");
    } else if (!is_right) {
        printf("%s: not as expected; - expected, + read\n", c->name);
        print_difference(expected.bytes, c->out.bytes);
    }
    free(expected.bytes);
    return is_right;
}

static int run_case(const char *name, int accept)
{
    reader_case *const c = calloc(1, sizeof *c);
    char *entry[MOST_FILES];
    if (c == NULL)
        abort();
    snprintf(c->name, sizeof c->name, "%s", name);
    snprintf(c->folder, sizeof c->folder, "%s/%s", CASES, name);
    const int entries = list_folder(c->folder, entry, MOST_FILES);
    text_clear(&c->out);
    read_options(c);
    for (int i = 0; i < entries; i++) {
        if (is_input(c, entry[i]))
            add_file(c, entry[i]);
        free(entry[i]);
    }
    if (c->files == 0)
        wrong(c, "no file to read in ", c->folder);
    for (size_t i = 0; i < (c->is_series && c->files > 0 ? 1 : c->files); i++)
        read_input(c, c->file[i]);
    const int is_right = judge(c, accept);
    for (size_t i = 0; i < c->files; i++)
        free(c->file[i]);
    free(c->words.bytes);
    free(c->out.bytes);
    free(c);
    return is_right;
}

int main(int argc, char **argv)
{
    char *entry[1024];
    const int accept = argc > 1 && strcmp(argv[1], "--accept") == 0, named = argc > 1 + accept;
    const int entries = named ? 0 : list_folder(CASES, entry, sizeof entry / sizeof entry[0]);
    int cases = 0, right = 0;
    for (int i = 1 + accept; i < argc; i++, cases++)
        right += run_case(argv[i], accept);
    for (int i = 0; i < entries; i++) {
        if (strchr(entry[i], '.') == NULL) { /* a folder: the README has an ending */
            cases++;
            right += run_case(entry[i], accept);
        }
        free(entry[i]);
    }
    printf("%d cases, %d right\n", cases, right);
    return cases == 0 || right < cases;
}

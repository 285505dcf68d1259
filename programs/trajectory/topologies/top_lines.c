/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * GROMACS' preprocessor. Files are looked for as grompp does: beside the file that includes them, beside the topology,
 * then in GMXLIB and where GROMACS keeps its force fields. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/topologies/top_lines.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ---- Files ------------------------------------------------------------------------------------------------------ */

static top_file *top_of(const top_lines *l) { return l->depth > 0 ? l->file[l->depth - 1] : NULL; }

int top_lines_fail(cgt_trajectory *t, const top_lines *l, const char *format, ...)
{
    const top_file *const file = top_of(l);
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return file == NULL ? trajectory_fail(t, t->text.line, "%s", text)
                        : trajectory_fail(t, 0, "%.300s:%" PRIu64 ": %s", file->path, file->text.line, text);
}

static void close_file(top_lines *l)
{
    top_file *const file = l->file[--l->depth];
    trajectory_input_close(&file->input);
    text_reader_free(&file->text);
    free(file->path);
    free(file);
}

/* The path of a file in a folder, of `length` letters; NULL: it is no regular file. The caller frees it. */
static char *find_in(const char *folder, size_t length, const char *name)
{
    const size_t size = length + strlen(name) + 2;
    char *const path = malloc(size);
    struct stat status;
    if (path == NULL)
        return NULL;
    snprintf(path, size, "%.*s%s%s", (int)length, folder, length > 0 && folder[length - 1] != '/' ? "/" : "", name);
    if (stat(path, &status) == 0 && S_ISREG(status.st_mode))
        return path;
    free(path);
    return NULL;
}

/* With a separator between folders. */
static char *find_in_list(const char *folders, const char *name)
{
    char *found = NULL;
    while (folders != NULL && found == NULL && *folders != '\0') {
        const size_t length = strcspn(folders, ":");
        if (length > 0)
            found = find_in(folders, length, name);
        folders += length + (folders[length] == ':');
    }
    return found;
}

static char *find_beside(const char *path, const char *name)
{
    const char *const slash = strrchr(path, '/');
    return find_in(path, slash != NULL ? (size_t)(slash - path) + 1 : 0, name);
}

static char *find_file(const cgt_trajectory *t, const top_lines *l, const char *name)
{
    static const char folders[] = "/usr/share/gromacs/top:/usr/local/gromacs/share/gromacs/top:"
                                  "/usr/local/share/gromacs/top";
    if (name[0] == '/')
        return find_in("", 0, name);
    char *found = l->depth > 0 ? find_beside(top_of(l)->path, name) : NULL;
    found = found != NULL ? found : find_beside(t->path, name);
    found = found != NULL ? found : find_in_list(getenv("GMXLIB"), name);
    return found != NULL ? found : find_in_list(folders, name);
}

static int open_file(cgt_trajectory *t, top_lines *l, char *path)
{
    char reason[256];
    top_file *const file = calloc(1, sizeof *file);
    if (file == NULL) {
        free(path);
        return top_lines_fail(t, l, "not enough memory");
    }
    file->path = path;
    file->input.descriptor = -1;
    if (trajectory_input_open(&file->input, path, 0.0, &t->options, reason, sizeof reason)) {
        top_lines_fail(t, l, "%.200s: %s", path, reason);
        free(path);
        free(file);
        return -1;
    }
    text_reader_init(&file->text, file->input.stream);
    file->text.read_some = file->input.plain ? NULL : trajectory_input_read;
    file->text.input = &file->input;
    file->text.why = file->input.error;
    l->file[l->depth++] = file;
    return 1;
}

enum { QUOTE = 0x22 };

/* The name of a file in quotes, or <file>. */
static int include(cgt_trajectory *t, top_lines *l, text_span rest)
{
    char name[256];
    text_trim(&rest);
    const char end = *rest.begin == '<' ? '>' : QUOTE;
    const char *const last =
        text_length(rest) > 2 ? memchr(rest.begin + 1, end, (size_t)(rest.end - rest.begin - 1)) : NULL;
    if ((*rest.begin != QUOTE && *rest.begin != '<') || last == NULL || last - rest.begin > (int)sizeof name)
        return top_lines_fail(t, l, "#include names no file");
    snprintf(name, sizeof name, "%.*s", (int)(last - rest.begin - 1), rest.begin + 1);
    if (l->depth == TOP_DEEPEST || l->files == TOP_FILES)
        return top_lines_fail(t, l, "more than %d files that include each other, or %d in all", TOP_DEEPEST, TOP_FILES);
    char *const path = find_file(t, l, name);
    if (path == NULL) {
        if (l->missing++ == 0)
            snprintf(l->first_missing, sizeof l->first_missing, "%s", name);
        return 1;
    }
    l->files++;
    return open_file(t, l, path);
}

/* ---- Directives ------------------------------------------------------------------------------------------------- */

static int is_defined(const top_lines *l, text_span name)
{
    const uint32_t word = word_map_find(&l->defined, name);
    return word != WORD_NONE && l->is_defined[word];
}

static int define(cgt_trajectory *t, top_lines *l, text_span name, int defined)
{
    const uint32_t before = l->defined.capacity, word = word_map_add(&l->defined, name);
    if (word == WORD_NONE ||
        (l->defined.capacity > before && trajectory_grow(&l->is_defined, l->defined.capacity, sizeof *l->is_defined)))
        return top_lines_fail(t, l, "not enough memory");
    l->is_defined[word] = (uint8_t)defined;
    return 1;
}

static int begin_condition(cgt_trajectory *t, top_lines *l, int is_on)
{
    if (l->ifs == TOP_IFS)
        return top_lines_fail(t, l, "more than %d conditions one within the other", TOP_IFS);
    l->on += l->on == l->ifs && is_on;
    l->is_on[l->ifs] = (uint8_t)is_on;
    l->was_else[l->ifs++] = 0;
    return 1;
}

/* #else, or #endif */
static int end_condition(cgt_trajectory *t, top_lines *l, int is_else)
{
    if (l->ifs == 0 || (is_else && l->was_else[l->ifs - 1]))
        return top_lines_fail(t, l, "%s without #ifdef", is_else ? "#else" : "#endif");
    const int was_on = l->is_on[l->ifs - 1];
    l->on -= l->on == l->ifs;
    l->ifs--;
    if (!is_else)
        return 1;
    begin_condition(t, l, !was_on);
    l->was_else[l->ifs - 1] = 1;
    return 1;
}

/* A line behind its "#"; what is not known of is passed over, as #error is. */
static int direct(cgt_trajectory *t, top_lines *l, text_span rest)
{
    text_span word, name = {"", ""};
    if (!text_word(&rest, &word))
        return 1;
    text_span after = rest;
    const int is_named = text_word(&after, &name);
    if (text_is(word, "ifdef"))
        return begin_condition(t, l, is_defined(l, name));
    if (text_is(word, "ifndef"))
        return begin_condition(t, l, !is_defined(l, name));
    if (text_is(word, "else") || text_is(word, "endif"))
        return end_condition(t, l, text_is(word, "else"));
    if (l->on < l->ifs)
        return 1;
    if (text_is(word, "include") && is_named)
        return include(t, l, rest);
    return is_named && (text_is(word, "define") || text_is(word, "undef")) ? define(t, l, name, text_is(word, "define"))
                                                                           : 1;
}

/* ---- Lines ------------------------------------------------------------------------------------------------------ */

/* A line of the file that is read, or of the one that has included it. */
static int read_line(cgt_trajectory *t, top_lines *l, text_span *line)
{
    while (l->depth > 0) {
        const char *reason = "";
        const int status = text_reader_next(&top_of(l)->text, line, &reason);
        if (status != 0)
            return status > 0 ? 1 : top_lines_fail(t, l, "%s", reason);
        close_file(l);
    }
    return trajectory_line(t, line);
}

static void cut_comment(text_span *line)
{
    const char *const comment = memchr(line->begin, ';', text_length(*line));
    line->end = comment != NULL ? comment : line->end;
    text_trim(line);
}

/* Adds the lines behind one that goes on. */
static int join(cgt_trajectory *t, top_lines *l, text_span *line)
{
    size_t length = 0;
    for (int goes_on = 1; goes_on;) {
        goes_on = line->end > line->begin && line->end[-1] == '\\';
        const size_t part = text_length(*line) - (size_t)goes_on;
        if (length + part + 2 > TEXT_LONGEST_LINE)
            return top_lines_fail(t, l, "a line that goes on is too long");
        if (length + part + 2 + TEXT_SLACK > l->line_capacity) {
            const size_t capacity = 2 * (length + part) + 1024 + TEXT_SLACK;
            if (trajectory_grow(&l->line, capacity, 1))
                return top_lines_fail(t, l, "not enough memory");
            l->line_capacity = capacity;
        }
        memcpy(l->line + length, line->begin, part);
        length += part;
        l->line[length++] = ' ';
        const int status = goes_on ? read_line(t, l, line) : 1;
        if (status < 0)
            return -1;
        goes_on &= status;
        if (goes_on)
            cut_comment(line);
    }
    memset(l->line + length, 0, TEXT_SLACK);
    *line = (text_span){l->line, l->line + length};
    return 1;
}

int top_lines_next(cgt_trajectory *t, top_lines *l, text_span *line)
{
    int status;
    while ((status = read_line(t, l, line)) > 0) {
        cut_comment(line);
        if (line->end > line->begin && line->end[-1] == '\\' && join(t, l, line) < 0)
            return -1;
        if (text_is_blank(*line))
            continue;
        text_trim(line);
        if (*line->begin != '#') {
            if (l->on == l->ifs)
                return 1;
            continue;
        }
        if (direct(t, l, (text_span){line->begin + 1, line->end}) < 0)
            return -1;
    }
    if (status == 0 && l->ifs > 0)
        return trajectory_fail(t, t->text.line, "#ifdef without #endif");
    return status;
}

void top_lines_free(top_lines *l)
{
    while (l->depth > 0)
        close_file(l);
    word_map_free(&l->defined);
    free(l->is_defined);
    free(l->line);
    *l = (top_lines){.depth = 0};
}

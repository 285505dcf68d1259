/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Settings files; see settings_file.h. */
#define _POSIX_C_SOURCE 200809L
#include "common/settings_file.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/out_file.h"
#include "common/program.h"
#include "options/figure_options.h"
#include "options/figure_settings.h"

enum { MOST_LINE = 4096, MOST_LINES = 1000000 };

/* ---- Reading ------------------------------------------------------------------------------------------------ */

/* Takes spaces from both ends. */
static char *trim(char *text)
{
    size_t length = strlen(text);
    while (length > 0 && isspace((unsigned char)text[length - 1]))
        text[--length] = '\0';
    while (isspace((unsigned char)*text))
        text++;
    return text;
}

static int is_blank(char letter) { return isspace((unsigned char)letter) != 0; }

/* Whether a value of so many letters is another one without quotes: its blanks do not count, or it is such a value in
 * quotes, which would lose them. */
static int needs_quotes(const char *value, size_t length)
{
    for (; length > 0; value++, length -= 2) {
        if (is_blank(value[0]) || is_blank(value[length - 1]))
            return 1;
        if (length < 2 || value[0] != '"' || value[length - 1] != '"')
            return 0;
    }
    return 0;
}

/* What is in the quotes of a value that needs them, else the value. */
static char *take_quotes(char *value)
{
    const size_t length = strlen(value);
    if (length < 2 || value[0] != '"' || value[length - 1] != '"' || !needs_quotes(value + 1, length - 2))
        return value;
    value[length - 1] = '\0';
    return value + 1;
}

/* "name = value" or "name". */
static int take_line(char *line, settings_taker *take, void *user, char *error, size_t size)
{
    char *name = trim(line), *equals = strchr(name, '=');
    const char *value = NULL;
    if (*name == '\0' || *name == '#')
        return 0;
    if (equals) {
        *equals = '\0';
        value = take_quotes(trim(equals + 1));
        name = trim(name);
    }
    return take(user, name, value, error, size);
}

int settings_read(const char *path, settings_taker *take, void *user, char *error, size_t size)
{
    char line[MOST_LINE], why[PROGRAM_ERROR_SIZE];
    unsigned number = 0;
    int result = 0;
    FILE *file = fopen(path, "r");
    if (!file) {
        snprintf(error, size, "%s: %s", path, strerror(errno));
        return -1;
    }
    while (result == 0 && fgets(line, sizeof line, file)) {
        number++;
        if (!strchr(line, '\n') && !feof(file)) {
            snprintf(error, size, "%s:%u: the line is longer than %d bytes", path, number, MOST_LINE - 2);
            result = -1;
        } else if (number > MOST_LINES) {
            snprintf(error, size, "%s: there are more than %d lines", path, MOST_LINES);
            result = -1;
        } else {
            const int has_mark = number == 1 && strncmp(line, "\xEF\xBB\xBF", 3) == 0; /* of UTF-8 */
            result = take_line(has_mark ? line + 3 : line, take, user, why, sizeof why);
            if (result)
                snprintf(error, size, "%s:%u: %s", path, number, why);
        }
    }
    if (result == 0 && ferror(file)) {
        snprintf(error, size, "%s: cannot read", path);
        result = -1;
    }
    fclose(file);
    return result;
}

int settings_check(const option_row *row, const char *value, void *options, char *error, size_t size)
{
    char why[PROGRAM_ERROR_SIZE];
    if ((value && !row->value) || (!value && row->value && !row->is_optional)) {
        snprintf(error, size, value ? "%s: the option takes no value" : "%s: the option takes a value", row->name);
        return -1;
    }
    const int failed = cgt_option_set(row, value, options, why, sizeof why);
    if (failed)
        snprintf(error, size, "%s: %s", row->name, why);
    return failed;
}

/* ---- Of a figure -------------------------------------------------------------------------------------------- */

typedef struct figure_lines {
    char *text;
    size_t length;
    int without_size;
    char *left_out;
    size_t left_out_size;
} figure_lines;

static void leave_out(figure_lines *l, const char *name)
{
    const size_t length = strlen(l->left_out);
    if (length < l->left_out_size)
        snprintf(l->left_out + length, l->left_out_size - length, length ? ", %s" : "%s", name);
}

static int add_figure_line(void *user, const char *name, const char *value, char *error, size_t size)
{
    figure_lines *const l = user;
    const option_row *const row = cgt_figure_find_row(name);
    if (!row || (l->without_size && strcmp(name, "size") == 0)) {
        if (!row)
            leave_out(l, name);
        return 0;
    }
    figure_options options;
    cgt_figure_options_init(&options);
    const int failed = settings_check(row, value, &options, error, size);
    cgt_camera_keys_free(&options.keys);
    if (failed)
        return -1;
    const size_t more = strlen(name) + (value ? strlen(value) + 3 : 0) + 1;
    char *const text = realloc(l->text, l->length + more + 1);
    if (!text) {
        snprintf(error, size, "out of memory, or too many options");
        return -1;
    }
    snprintf(text + l->length, more + 1, value ? "%s = %s\n" : "%s\n", name, value);
    l->text = text;
    l->length += more;
    return 0;
}

char *settings_read_figure(const char *path, int without_size, char *left_out, size_t left_out_size, char *error,
                           size_t size)
{
    figure_lines l = {calloc(1, 1), 0, without_size, left_out, left_out_size};
    left_out[0] = '\0';
    if (!l.text)
        snprintf(error, size, "%s: out of memory, or too many options", path);
    else if (settings_read(path, add_figure_line, &l, error, size) == 0)
        return l.text;
    free(l.text);
    return NULL;
}

/* ---- Lines -------------------------------------------------------------------------------------------------- */

const char *settings_next_line(const char *line)
{
    const size_t length = strcspn(line, "\n");
    return line + length + (line[length] == '\n');
}

size_t settings_name_length(const char *line) { return strcspn(line, " \n"); }

/* Whether a line's name is a figure's option. */
static int is_of_figure(const char *line)
{
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)settings_name_length(line), line);
    return cgt_figure_find_row(name) != NULL;
}

size_t settings_copy_part(const char *lines, int of_figure, char *to)
{
    size_t used = 0;
    for (const char *line = lines, *next; *line; line = next) {
        next = settings_next_line(line);
        if (is_of_figure(line) != of_figure)
            continue;
        memcpy(to + used, line, (size_t)(next - line));
        used += (size_t)(next - line);
    }
    return used;
}

void settings_print_part(FILE *to, const char *lines, int of_figure)
{
    for (const char *line = lines; *line; line = settings_next_line(line))
        if (is_of_figure(line) == of_figure)
            fprintf(to, "%.*s\n", (int)strcspn(line, "\n"), line);
}

/* ---- Writing ------------------------------------------------------------------------------------------------ */

char *settings_quote(const char *lines)
{
    size_t count = 0, used = 0;
    for (const char *line = lines; *line; line = settings_next_line(line))
        count++;
    char *const text = malloc(strlen(lines) + 2 * count + 1);
    if (!text)
        return NULL;
    for (const char *line = lines, *next; *line; line = next) {
        settings_line l;
        next = cgt_figure_settings_line(line, &l);
        const char *const value = l.value ? l.value : next, *const end = value + l.value_length;
        const char *const quote = needs_quotes(value, l.value_length) ? "\"" : "";
        used += (size_t)sprintf(text + used, "%.*s%s%.*s%s%.*s", (int)(value - line), line, quote, (int)l.value_length,
                                value, quote, (int)(next - end), end);
    }
    text[used] = '\0';
    return text;
}

int settings_write(const char *path, const char *lines, char *error, size_t size)
{
    out_file out;
    char *const quoted = settings_quote(lines);
    const char *const name = quoted ? out_file_begin(&out, path, error, size) : NULL;
    FILE *const to = name ? fopen(name, "wb") : NULL;
    if (!quoted)
        snprintf(error, size, "%s: out of memory", path);
    int failed = !to || fprintf(to, "# libcgt " CGT_VERSION_STRING "\n%s", quoted) < 0;
    free(quoted);
    if (!name)
        return -1;
    if (to)
        failed |= fclose(to) != 0;
    if (out_file_end(&out, !failed, error, size))
        return -1;
    if (failed)
        snprintf(error, size, "%s: cannot be written", path);
    return failed ? -1 : 0;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Settings files; see settings_file.h. */
#define _GNU_SOURCE
#include "render/options/settings_file.h"
#include "render/options/option_parsers.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ARGUMENTS = 100000, MOST_LINE = 4096, MOST_LINES = 1000000 };

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

static int append(settings_arguments *to, const char *text)
{
    const size_t count = (size_t)to->argc + 1;
    if (to->argc >= MOST_ARGUMENTS)
        return -1;
    char **more = to->argv;
    if ((count & (count - 1)) == 0) /* doubles the room, for the NULL behind the last one, too */
        more = realloc(to->argv, 2 * count * sizeof *more);
    char *copy = strdup(text);
    if (!more || !copy) {
        to->argv = more ? more : to->argv;
        free(copy);
        return -1;
    }
    more[to->argc++] = copy;
    more[to->argc] = NULL;
    to->argv = more;
    return 0;
}

/* Names may be shortened, as on the command line. */
static int is_option(const char *name)
{
    int known = 0;
    for (size_t i = 0; i < render_option_table()->count && *name; i++) {
        const char *const option = render_option_table()->rows[i].name;
        known |= option && strncmp(option, name, strlen(name)) == 0;
    }
    return known && strcmp(name, "settings") != 0;
}

/* "name = value" or "name" becomes --name=value or --name. */
static int append_line(settings_arguments *to, char *line, const char *path, unsigned number, char *error, size_t size)
{
    char argument[MOST_LINE + 8];
    char *name = trim(line), *equals = strchr(name, '=');
    const char *value = NULL;
    if (*name == '\0' || *name == '#')
        return 0;
    if (equals) {
        *equals = '\0';
        value = trim(equals + 1);
        name = trim(name);
    }
    if (!is_option(name)) {
        snprintf(error, size, "%s:%u: \"%s\" is no option that a settings file may have", path, number, name);
        return -1;
    }
    snprintf(argument, sizeof argument, value ? "--%s=%s" : "--%s", name, value);
    if (append(to, argument) == 0)
        return 0;
    snprintf(error, size, "%s:%u: out of memory, or too many options", path, number);
    return -1;
}

static int read_file(settings_arguments *to, const char *path, char *error, size_t size)
{
    char line[MOST_LINE];
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
            result = append_line(to, has_mark ? line + 3 : line, path, number, error, size);
        }
    }
    if (result == 0 && ferror(file)) {
        snprintf(error, size, "%s: cannot read", path);
        result = -1;
    }
    fclose(file);
    return result;
}

/* The file that an argument names: in itself or as the next one, which *takes tells; NULL for other arguments. */
static const char *settings_path(int argc, char **argv, int i, int *takes)
{
    *takes = 1;
    if (strncmp(argv[i], "--settings=", 11) == 0)
        return argv[i] + 11;
    if (strcmp(argv[i], "--settings") != 0 || i + 1 >= argc)
        return NULL;
    *takes = 2;
    return argv[i + 1];
}

int settings_expand(int argc, char **argv, settings_arguments *to, char *error, size_t error_size)
{
    int failed = 0, takes;
    memset(to, 0, sizeof *to);
    failed = argc > 0 && append(to, argv[0]);
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i += takes) {
        const char *path = settings_path(argc, argv, i, &takes);
        if (path && read_file(to, path, error, error_size))
            return -1;
    }
    int is_operand = 0;
    for (int i = 1; i < argc && argv[i] && !failed; i += takes) {
        is_operand |= strcmp(argv[i], "--") == 0;
        if (is_operand || !settings_path(argc, argv, i, &takes)) {
            takes = 1;
            failed = append(to, argv[i]);
        }
    }
    if (failed)
        snprintf(error, error_size, "out of memory for the command line");
    return failed ? -1 : 0;
}

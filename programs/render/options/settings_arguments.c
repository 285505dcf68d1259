/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Settings files of a command line; see settings_arguments.h. */
#define _GNU_SOURCE
#include "render/options/settings_arguments.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/settings_file.h"
#include "render/options/option_parsers.h"

enum { MOST_ARGUMENTS = 100000 };

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

/* The row of a name, which may be shortened, as on the command line: that of the whole name, else the first that begins
 * so; NULL: there is none. *matches gets how many begin so. */
static const option_row *find_row(const char *name, size_t length, int *matches)
{
    const option_row *found = NULL;
    *matches = 0;
    for (size_t i = 0; i < render_option_table()->count && length; i++) {
        const option_row *const row = &render_option_table()->rows[i];
        if (!row->name || strncmp(row->name, name, length) != 0)
            continue;
        if (!found || !row->name[length])
            found = row;
        ++*matches;
    }
    return found;
}

static int is_settings(const option_row *row) { return row && strcmp(row->name, "settings") == 0; }

/* A whole name's value is checked here, where the line is known. */
static int check_option(const option_row *row, const char *value, char *error, size_t size)
{
    render_options options;
    render_options_init(&options);
    const int failed = settings_check(row, value, &options, error, size);
    cgt_camera_keys_free(&options.figure.keys);
    return failed;
}

/* "name = value" or "name" becomes --name=value or --name. */
static int append_option(void *user, const char *name, const char *value, char *error, size_t size)
{
    settings_arguments *const to = user;
    int matches;
    const option_row *const row = find_row(name, strlen(name), &matches);
    if (!row || is_settings(row)) {
        snprintf(error, size, "\"%s\" is no option that a settings file may have", name);
        return -1;
    }
    if (strcmp(row->name, name) == 0 && check_option(row, value, error, size))
        return -1;
    const size_t room = strlen(name) + (value ? strlen(value) : 0) + 4;
    char *const argument = malloc(room);
    if (argument)
        snprintf(argument, room, value ? "--%s=%s" : "--%s", name, value);
    const int failed = !argument || append(to, argument);
    if (failed)
        snprintf(error, size, "out of memory, or too many options");
    free(argument);
    return failed ? -1 : 0;
}

/* The file that an argument names: in itself or as the next one, which *takes tells; NULL for other arguments. */
static const char *settings_path(int argc, char **argv, int i, int *takes)
{
    const size_t length = strncmp(argv[i], "--", 2) == 0 ? strcspn(argv[i] + 2, "=") : 0;
    const char *const end = argv[i] + 2 + length;
    int matches;
    *takes = 1;
    if (!length || !is_settings(find_row(argv[i] + 2, length, &matches)) || matches != 1)
        return NULL;
    if (*end == '=')
        return end + 1;
    if (i + 1 >= argc)
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
        if (path && settings_read(path, append_option, to, error, error_size))
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

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Settings files; see settings_file.h. */
#define _GNU_SOURCE
#include "render/options/settings/settings_file.h"

#include <ctype.h>
#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ARGUMENTS = 100000, MOST_LINE = 4096, MOST_OPTIONS = 256 };

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

static int append(settings_arguments *to, const char *text)
{
    if (to->argc >= MOST_ARGUMENTS)
        return -1;
    char **more = realloc(to->argv, ((size_t)to->argc + 2) * sizeof *more);
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
    if (name[strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789-")] != '\0' || *name == '-' || *name == '\0' ||
        strcmp(name, "settings") == 0) {
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
        } else {
            result = append_line(to, line, path, number, error, size);
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

/* ---- Writing ------------------------------------------------------------------------------------------------ */

typedef struct option_list {
    const struct argp_option *row[MOST_OPTIONS];
    size_t count;
} option_list;

/* The rows of a parser and of its children, those of running left out. */
static void collect(const struct argp *parser, option_list *list)
{
    for (const struct argp_option *row = parser->options; row && (row->name || row->doc || row->group); row++)
        if (row->name && list->count < MOST_OPTIONS)
            list->row[list->count++] = row;
    for (const struct argp_child *child = parser->children; child && child->argp; child++)
        collect(child->argp, list);
}

/* What changes no pixel of a frame: pictures of a part of a run have the bytes of those of the whole. */
static int is_of_running(const char *name)
{
    static const char *const names[] = {"settings",      "print-settings", "threads",    "variant", "stats",
                                        "log-file",      "quiet",          "verbose",    "output",  "no-images",
                                        "first",         "last",           "every",      "part",    "follow",
                                        "contact-sheet", "sheet-grid",     "no-metadata"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(name, names[i]) == 0)
            return 1;
    return 0;
}

/* The tables of getopt_long, which reads the arguments as argp does. The index in the list plus 512 stands for an option;
 * a letter for itself. */
static void make_tables(const option_list *list, struct option *longs, char *shorts)
{
    *shorts++ = ':'; /* errors are argp's to tell */
    for (size_t i = 0; i < list->count; i++) {
        const struct argp_option *row = list->row[i];
        const int has = !row->arg                          ? no_argument
                        : row->flags & OPTION_ARG_OPTIONAL ? optional_argument
                                                           : required_argument;
        longs[i] = (struct option){row->name, has, NULL, (int)i + 512};
        if (row->key > ' ' && row->key < 127) {
            *shorts++ = (char)row->key;
            if (row->arg)
                *shorts++ = ':';
        }
    }
    longs[list->count] = (struct option){NULL, 0, NULL, 0};
    *shorts = '\0';
}

static size_t find_row(const option_list *list, int key)
{
    size_t i = key >= 512 ? (size_t)key - 512 : 0;
    while (key < 512 && i < list->count && list->row[i]->key != key)
        i++;
    return i;
}

char *settings_text(const struct argp *parser, int argc, char **argv, int all)
{
    static option_list list;
    struct option longs[MOST_OPTIONS + 1];
    char shorts[2 * MOST_OPTIONS + 2], *text = NULL;
    int given[MOST_OPTIONS] = {0}, key;
    size_t size = 0;
    char **copy = malloc(((size_t)argc + 1) * sizeof *copy); /* getopt permutes it */
    FILE *out = open_memstream(&text, &size);
    if (!copy || !out) {
        free(copy);
        if (out)
            fclose(out);
        free(text);
        return NULL;
    }
    list.count = 0;
    collect(parser, &list);
    make_tables(&list, longs, shorts);
    memcpy(copy, argv, ((size_t)argc + 1) * sizeof *copy);
    optind = 0;
    while ((key = getopt_long(argc, copy, shorts, longs, NULL)) != -1) {
        const size_t i = key == '?' || key == ':' ? list.count : find_row(&list, key);
        if (i >= list.count || is_of_running(list.row[i]->name))
            continue;
        given[i] = 1;
        fprintf(out, optarg ? "%s = %s\n" : "%s\n", list.row[i]->name, optarg);
    }
    for (size_t i = 0; i < list.count && all; i++)
        if (!given[i] && !is_of_running(list.row[i]->name))
            fprintf(out, list.row[i]->arg ? "# %s = %s\n" : "# %s\n", list.row[i]->name, list.row[i]->arg);
    free(copy);
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Files that were opened last; see view_recent.h. */
#define _XOPEN_SOURCE 700
#include "view/view_recent.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/out_file.h"
#include "common/out_path.h"
#include "common/program.h"

enum { MOST_RECENT = 12, MOST_PATH = 4096 };

/* Returns 0, or -1: there is no place for it. */
static int find_place(char *path, size_t size)
{
    const char *const data = getenv("XDG_DATA_HOME"), *const home = getenv("HOME");
    const int has_data = data && data[0] == '/';
    if (!has_data && !home)
        return -1;
    const int length = snprintf(path, size, "%s%s/cgt/recent", has_data ? data : home, has_data ? "" : "/.local/share");
    return length > 0 && (size_t)length < size ? 0 : -1;
}

char *view_recent_list(void)
{
    char place[MOST_PATH], line[MOST_PATH];
    char *text = NULL;
    size_t size;
    FILE *const to = open_memstream(&text, &size);
    FILE *const file = to && find_place(place, sizeof place) == 0 ? fopen(place, "r") : NULL;
    for (int i = 0; file && i < MOST_RECENT && fgets(line, sizeof line, file); i++)
        if (line[0] == '/')
            fputs(line, to);
    if (file)
        fclose(file);
    if (to && fclose(to) == 0)
        return text;
    free(text);
    return NULL;
}

void view_recent_add(const char *path)
{
    char place[MOST_PATH], error[PROGRAM_ERROR_SIZE];
    char *const whole = realpath(path, NULL), *const list = view_recent_list();
    out_file out;
    const int is_good = whole && list && !strchr(whole, '\n') && find_place(place, sizeof place) == 0 &&
                        out_path_make_folder(place, error, sizeof error) == 0;
    const char *const name = is_good ? out_file_begin(&out, place, error, sizeof error) : NULL;
    FILE *const to = name ? fopen(name, "w") : NULL;
    if (to) {
        fprintf(to, "%s\n", whole);
        for (const char *line = list; *line;) {
            const size_t length = strcspn(line, "\n");
            if (length != strlen(whole) || strncmp(line, whole, length) != 0)
                fprintf(to, "%.*s\n", (int)length, line);
            line += length + (line[length] == '\n');
        }
    }
    const int failed = to ? ferror(to) | fclose(to) : 1;
    if (name)
        out_file_end(&out, !failed, error, sizeof error);
    free(whole);
    free(list);
}

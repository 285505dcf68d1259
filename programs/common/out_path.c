/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Names of output files; see out_path.h. */
#define _POSIX_C_SOURCE 200809L
#include "common/out_path.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "system/system.h"

/* Parses %d or %0Nd at text, which begins with a %. Returns its length, or 0 where it is neither. */
static size_t parse_number(const char *text, int *digits)
{
    size_t i = 1;
    *digits = 1;
    if (text[i] == '0') {
        if (text[i + 1] < '1' || text[i + 1] > '9')
            return 0;
        *digits = text[i + 1] - '0';
        i += 2;
    }
    return text[i] == 'd' ? i + 1 : 0;
}

int out_path_parse(out_path *path, const char *pattern, char *error, size_t error_size)
{
    out_path parsed = {pattern, strlen(pattern), strlen(pattern), 1, 0};
    for (size_t i = 0; pattern[i]; i++) {
        if (pattern[i] != '%')
            continue;
        if (pattern[i + 1] == '%') {
            i++;
            continue;
        }
        const size_t length = parsed.numbered ? 0 : parse_number(pattern + i, &parsed.digits);
        if (!length) {
            snprintf(error, error_size, "\"%s\": one %%d or %%04d for the number, %%%% for a %% itself", pattern);
            return -1;
        }
        parsed.numbered = 1;
        parsed.number_at = i;
        parsed.number_end = i + length;
        i += length - 1;
    }
    for (size_t i = parsed.number_end; pattern[i]; i++)
        if (system_is_separator(pattern[i])) {
            snprintf(error, error_size, "\"%s\": the number is of the file, not of a folder", pattern);
            return -1;
        }
    if (!*pattern || pattern[strlen(pattern) - 1] == '/') {
        snprintf(error, error_size, "\"%s\" names no file", pattern);
        return -1;
    }
    *path = parsed;
    return 0;
}

/* Copies pattern[begin, end) to text at *used, %% as %. Returns 0, or -1 where it does not fit. */
static int append(const out_path *path, size_t begin, size_t end, char *text, size_t size, size_t *used)
{
    for (size_t i = begin; i < end; i++) {
        if (path->pattern[i] == '%')
            i++;
        if (*used + 1 >= size)
            return -1;
        text[(*used)++] = path->pattern[i];
    }
    text[*used] = '\0';
    return 0;
}

int out_path_name(const out_path *path, uint64_t number, char *text, size_t size)
{
    size_t used = 0;
    if (size == 0 || append(path, 0, path->number_at, text, size, &used))
        return -1;
    if (!path->numbered)
        return 0;
    const int length = snprintf(text + used, size - used, "%0*" PRIu64, path->digits, number);
    if (length < 0 || (size_t)length >= size - used)
        return -1;
    used += (size_t)length;
    return append(path, path->number_end, strlen(path->pattern), text, size, &used);
}

int out_path_makes(const out_path *path, const char *name)
{
    char made[4096];
    size_t begin = 0;
    uint64_t number = 0;
    if (append(path, 0, path->number_at, made, sizeof made, &begin) || strncmp(made, name, begin) != 0)
        return 0;
    if (!path->numbered)
        return strcmp(made, name) == 0;
    for (const char *digit = name + begin; *digit >= '0' && *digit <= '9' && number < UINT64_MAX / 10 - 1; digit++) {
        number = 10 * number + (uint64_t)(*digit - '0');
        if (out_path_name(path, number, made, sizeof made) == 0 && strcmp(made, name) == 0)
            return 1;
    }
    return 0;
}

/* mkdir that accepts a folder that exists already. */
static int make_one(const char *folder, char *error, size_t error_size)
{
    struct stat info;
    if (system_make_folder(folder) == 0)
        return 0;
    const int mkdir_errno = errno;
    if (stat(folder, &info) == 0) {
        if (S_ISDIR(info.st_mode))
            return 0;
        snprintf(error, error_size, "%s: is not a folder", folder);
        return -1;
    }
    snprintf(error, error_size, "%s: cannot make the folder: %s", folder, strerror(mkdir_errno));
    return -1;
}

int out_path_make_folder(const char *name, char *error, size_t error_size)
{
    const size_t bytes = strlen(name) + 1;
    char *folder = malloc(bytes);
    if (!folder) {
        snprintf(error, error_size, "%s: out of memory", name);
        return -1;
    }
    memcpy(folder, name, bytes);
    int result = 0;
    for (size_t i = 1; folder[i] && result == 0; i++) {
        if (!system_is_separator(folder[i]) || system_is_separator(folder[i - 1]))
            continue;
        folder[i] = '\0';
        result = make_one(folder, error, error_size);
        folder[i] = name[i];
    }
    free(folder);
    return result;
}

int out_path_ends_in(const char *name, const char *ending)
{
    const size_t length = strlen(name), tail = strlen(ending);
    return length > tail && strcasecmp(name + length - tail, ending) == 0;
}

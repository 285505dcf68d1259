/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What was set of a figure; see figure_settings.h. */
#include "options/figure_settings.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "options/option_row.h"

int cgt_figure_settings_replay(const figure_settings *s, figure_options *options, char *error, size_t size)
{
    char reason[1024];
    cgt_figure_options_init(options);
    for (size_t i = 0; i < s->count; i++)
        if (cgt_option_set(cgt_figure_find_row(s->list[i].name), s->list[i].value, options, reason, sizeof reason)) {
            snprintf(error, size, "%s: %s", s->list[i].name, reason);
            return -1;
        }
    return cgt_figure_options_finish(options, error, size);
}

/* The settings `next` take the place of those that were, if they can be. Returns 0, or -1 with a sentence. */
static int take(figure_settings *s, const figure_settings *next, figure_options *options, char *error, size_t size)
{
    figure_options made;
    if (cgt_figure_settings_replay(next, &made, error, size)) {
        cgt_camera_keys_free(&made.keys);
        return -1;
    }
    cgt_camera_keys_free(&options->keys);
    free(s->list);
    *s = *next;
    *options = made;
    return 0;
}

/* A list of what stays: all but the values of one name, or of none. NULL where there is no memory. */
static figure_setting *copy_without(const figure_settings *s, const char *name, size_t *count)
{
    figure_setting *const list = malloc((s->count + 1) * sizeof *list);
    *count = 0;
    for (size_t i = 0; i < s->count && list; i++)
        if (!name || strcmp(s->list[i].name, name) != 0)
            list[(*count)++] = s->list[i];
    return list;
}

/* Frees the values of a name that are in `from` alone. */
static void free_values(const figure_setting *from, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++)
        if (!name || strcmp(from[i].name, name) == 0)
            free(from[i].value);
}

int cgt_figure_settings_set(figure_settings *s, const char *name, const char *value, figure_options *options,
                            char *error, size_t size)
{
    const option_row *const row = name ? cgt_figure_find_row(name) : NULL;
    if (!row || (value && !row->value) || (!value && row->value && !row->is_optional)) {
        snprintf(error, size,
                 !row    ? "there is no option \"%.80s\""
                 : value ? "%.80s: the option takes no value"
                         : "%.80s: the option takes a value",
                 name ? name : "");
        return -1;
    }
    figure_settings next, before;
    before.list = copy_without(s, NULL, &before.count); /* whose values are freed when they no longer count */
    next.list = copy_without(s, row->repeats ? NULL : row->name, &next.count);
    char *const copy = value ? malloc(strlen(value) + 1) : NULL;
    if (copy)
        memcpy(copy, value, strlen(value) + 1);
    if (!before.list || !next.list || (value && !copy))
        snprintf(error, size, "out of memory for options");
    else
        next.list[next.count++] = (figure_setting){row->name, copy};
    if (!before.list || !next.list || (value && !copy) || take(s, &next, options, error, size)) {
        free(before.list);
        free(next.list);
        free(copy);
        return -1;
    }
    if (!row->repeats)
        free_values(before.list, before.count, row->name);
    free(before.list);
    return 0;
}

int cgt_figure_settings_unset(figure_settings *s, const char *name, figure_options *options, char *error, size_t size)
{
    figure_settings next = {0}, before = {0};
    if (name && !cgt_figure_find_row(name)) {
        snprintf(error, size, "there is no option \"%.80s\"", name);
        return -1;
    }
    before.list = copy_without(s, NULL, &before.count);
    next.list = name ? copy_without(s, name, &next.count) : malloc(sizeof *next.list);
    if (!before.list || !next.list) {
        snprintf(error, size, "out of memory for options");
    } else if (take(s, &next, options, error, size) == 0) {
        free_values(before.list, before.count, name);
        free(before.list);
        return 0;
    }
    free(before.list);
    free(next.list);
    return -1;
}

int cgt_figure_settings_copy(const figure_settings *from, figure_settings *to)
{
    *to = (figure_settings){.list = calloc(from->count + 1, sizeof *to->list)};
    for (; to->list && to->count < from->count; to->count++) {
        const char *const value = from->list[to->count].value;
        char *const copy = value ? malloc(strlen(value) + 1) : NULL;
        if (value && !copy) {
            cgt_figure_settings_free(to);
            return -1;
        }
        to->list[to->count] = (figure_setting){from->list[to->count].name, copy};
        if (value)
            memcpy(copy, value, strlen(value) + 1);
    }
    return to->list ? 0 : -1;
}

size_t cgt_figure_settings_print(const figure_settings *s, const char *name, char *text, size_t size)
{
    size_t length = 0;
    if (size > 0)
        text[0] = '\0';
    for (size_t i = 0; i < s->count; i++) {
        const char *const value = s->list[i].value;
        if (name && strcmp(name, s->list[i].name) != 0)
            continue;
        const char *const parts[] = {name ? "" : s->list[i].name, value && !name ? " = " : "", value ? value : "",
                                     "\n"};
        for (size_t k = 0; k < sizeof parts / sizeof parts[0]; k++) {
            const size_t part = strlen(parts[k]);
            if (length < size)
                snprintf(text + length, size - length, "%s", parts[k]);
            length += part;
        }
    }
    return length;
}

void cgt_figure_settings_free(figure_settings *s)
{
    free_values(s->list, s->count, NULL);
    free(s->list);
    memset(s, 0, sizeof *s);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What was set of a figure; see figure_settings.h. */
#include "options/figure_settings.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "options/numbers.h"
#include "options/option_row.h"

int cgt_figure_settings_replay(const figure_settings *s, figure_options *options, char *error, size_t size)
{
    char reason[1024];
    cgt_figure_options_init(options);
    for (size_t i = 0; i < s->count; i++)
        if (cgt_option_set(cgt_figure_find_row(s->list[i].name), s->list[i].value, options, reason, sizeof reason)) {
            const int is_memory = cgt_tells_of_memory(reason);
            snprintf(error, size, "%s%s%s", is_memory ? "" : s->list[i].name, is_memory ? "" : ": ", reason);
            return -1;
        }
    return cgt_figure_options_finish(options, error, size);
}

/* The settings `next` take the place of those that were, if they can be. Returns 0, or -1 with a sentence. */
static int take(figure_settings *s, figure_settings *next, figure_options *options, char *error, size_t size)
{
    figure_options made;
    if (cgt_figure_settings_replay(next, &made, error, size)) {
        cgt_camera_keys_free(&made.keys);
        cgt_figure_settings_free(next);
        return -1;
    }
    cgt_camera_keys_free(&options->keys);
    cgt_figure_settings_free(s);
    *s = *next;
    *options = made;
    return 0;
}

static char *copy_text(const char *text, size_t length)
{
    char *const copy = malloc(length + 1);
    if (copy) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}

int cgt_figure_settings_copy(const figure_settings *from, figure_settings *to)
{
    *to = (figure_settings){.list = calloc(from->count + 1, sizeof *to->list)};
    for (; to->list && to->count < from->count; to->count++) {
        const figure_setting *const f = &from->list[to->count];
        char *const copy = f->value ? copy_text(f->value, strlen(f->value)) : NULL;
        if (f->value && !copy) {
            cgt_figure_settings_free(to);
            return -1;
        }
        to->list[to->count] = (figure_setting){f->name, copy};
    }
    return to->list ? 0 : -1;
}

static int fail_memory(char *error, size_t size)
{
    snprintf(error, size, "out of memory for options");
    return -1;
}

/* Drops the values of one name; NULL: of all. */
static void drop(figure_settings *s, const char *name)
{
    size_t count = 0;
    for (size_t i = 0; i < s->count; i++)
        if (name && strcmp(s->list[i].name, name) != 0)
            s->list[count++] = s->list[i];
        else
            free(s->list[i].value);
    s->count = count;
}

/* A value of so many letters, NULL: none, goes to the end. */
static int put(figure_settings *s, const char *name, const char *value, size_t length, char *error, size_t size)
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
    char *const copy = value ? copy_text(value, length) : NULL;
    figure_setting *const list = realloc(s->list, (s->count + 1) * sizeof *list);
    s->list = list ? list : s->list;
    if (!list || (value && !copy)) {
        free(copy);
        return fail_memory(error, size);
    }
    if (copy)
        cgt_join_lines(copy);
    if (!row->repeats)
        drop(s, row->name);
    s->list[s->count++] = (figure_setting){row->name, copy};
    return 0;
}

const char *cgt_figure_settings_line(const char *line, settings_line *told)
{
    const size_t length = strcspn(line, "\n"), own = strcspn(line, " \n");
    const int has_value = length >= own + 3 && memcmp(line + own, " = ", 3) == 0;
    snprintf(told->name, sizeof told->name, "%.*s", (int)(has_value ? own : length), line);
    told->value = has_value ? line + own + 3 : NULL;
    told->value_length = has_value ? length - own - 3 : 0;
    return line + length + (line[length] == '\n');
}

static int put_lines(figure_settings *s, const char *text, char *error, size_t size)
{
    settings_line l;
    while (*text) {
        text = cgt_figure_settings_line(text, &l);
        if (*l.name && put(s, l.name, l.value, l.value_length, error, size))
            return -1;
    }
    return 0;
}

int cgt_figure_settings_change(figure_settings *s, settings_change change, const char *name, const char *value,
                               figure_options *options, char *error, size_t size)
{
    figure_settings next;
    int failed = 0;
    if (change == SETTINGS_UNSET && name && !cgt_figure_find_row(name)) {
        snprintf(error, size, "there is no option \"%.80s\"", name);
        return -1;
    }
    if (cgt_figure_settings_copy(s, &next))
        return fail_memory(error, size);
    if (change == SETTINGS_UNSET)
        drop(&next, name);
    else if (change == SETTINGS_SET)
        failed = put(&next, name, value, value ? strlen(value) : 0, error, size);
    else
        failed = put_lines(&next, value, error, size);
    if (!failed)
        return take(s, &next, options, error, size);
    cgt_figure_settings_free(&next);
    return -1;
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
    drop(s, NULL);
    free(s->list);
    memset(s, 0, sizeof *s);
}

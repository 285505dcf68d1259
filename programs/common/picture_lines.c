/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The command line and the Python of a picture; see picture_lines.h. */
#define _POSIX_C_SOURCE 200809L
#include "common/picture_lines.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/settings_file.h"

/* What was printed, which is known by the end; NULL: no memory. */
static char *end_text(FILE *to, char **text)
{
    if (to && fclose(to) == 0)
        return *text;
    free(*text);
    return NULL;
}

/* Where the value of a line begins, and its letters; NULL: it has none. */
static const char *value_of(const char *line, size_t *length)
{
    const size_t all = strcspn(line, "\n"), before = settings_name_length(line) + strlen(" = ");
    *length = all > before ? all - before : 0;
    return all > before ? line + before : NULL;
}

/* ---- The command line --------------------------------------------------------------------------------------- */

/* "name = value" becomes --name=value, as 0 ends it. */
static void print_option(FILE *to, const char *line)
{
    size_t length;
    const char *const value = value_of(line, &length);
    fprintf(to, "--%.*s", (int)settings_name_length(line), line);
    if (value)
        fprintf(to, "=%.*s", (int)length, value);
    putc('\0', to);
}

char *picture_lines_options(const char *settings)
{
    char *text = NULL;
    size_t size = 0;
    FILE *const to = open_memstream(&text, &size);
    for (; to && *settings; settings = settings_next_line(settings))
        print_option(to, settings);
    if (to)
        putc('\0', to);
    return to ? end_text(to, &text) : NULL;
}

/* An argument as a shell takes it, of two parts, after a blank. */
static void print_argument(FILE *to, const char *before, const char *text)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=,:+%@-";
    const int is_plain = *text && text[strspn(text, plain)] == '\0';
    fprintf(to, is_plain ? " %s" : " '%s", before);
    for (; *text; text++)
        if (*text == '\'')
            fputs("'\\''", to);
        else
            putc(*text, to);
    if (!is_plain)
        putc('\'', to);
}

/* A file's name, which is no option. */
static void print_name(FILE *to, const char *name) { print_argument(to, name[0] == '-' && name[1] ? "./" : "", name); }

char *picture_lines_command(const picture_lines *p)
{
    char *text = NULL, *const options = picture_lines_options(p->settings);
    size_t size = 0;
    FILE *const to = options ? open_memstream(&text, &size) : NULL;
    if (to) {
        fputs("cgt-render", to);
        for (const char *option = options; *option; option += strlen(option) + 1)
            print_argument(to, "", option);
        fprintf(to, " --first=%" PRIu64 " --last=%" PRIu64, p->number, p->number);
        print_argument(to, "--output=", p->output);
        for (size_t i = 0; i < p->input_count; i++)
            print_name(to, p->inputs[i]);
        putc('\n', to);
    }
    free(options);
    return to ? end_text(to, &text) : NULL;
}

/* ---- Python ------------------------------------------------------------------------------------------------- */

static void print_string(FILE *to, const char *text, size_t length)
{
    putc('"', to);
    for (size_t i = 0; i < length; i++)
        if ((unsigned char)text[i] < ' ') {
            fprintf(to, "\\x%02x", (unsigned)text[i]);
        } else {
            if (text[i] == '"' || text[i] == '\\')
                putc('\\', to);
            putc(text[i], to);
        }
    putc('"', to);
}

static void print_text(FILE *to, const char *before, const char *text)
{
    if (text) {
        fputs(before, to);
        print_string(to, text, strlen(text));
    }
}

/* The value of a line, or True. */
static void print_value(FILE *to, const char *line)
{
    size_t length;
    const char *const value = value_of(line, &length);
    if (value)
        print_string(to, value, length);
    else
        fputs("True", to);
}

static int has_name_of(const char *line, const char *other)
{
    const size_t length = settings_name_length(other);
    return settings_name_length(line) == length && strncmp(line, other, length) == 0;
}

/* A keyword, with all values of the lines of its name that follow. */
static void print_keyword(FILE *to, const char *line, int repeats)
{
    const size_t name = settings_name_length(line);
    fputs("    ", to);
    for (size_t i = 0; i < name; i++)
        putc(line[i] == '-' ? '_' : line[i], to);
    fputs(repeats ? "=[" : "=", to);
    print_value(to, line);
    for (const char *next = settings_next_line(line); repeats && *next; next = settings_next_line(next))
        if (has_name_of(next, line)) {
            fputs(", ", to);
            print_value(to, next);
        }
    fputs(repeats ? "],\n" : ",\n", to);
}

/* Those of the figure, each name once. */
static void print_keywords(FILE *to, const char *settings)
{
    char name[64];
    for (const char *line = settings; *line; line = settings_next_line(line)) {
        const char *before = settings;
        snprintf(name, sizeof name, "%.*s", (int)settings_name_length(line), line);
        const option_row *const row = cgt_figure_find_row(name);
        while (before < line && !has_name_of(before, line))
            before = settings_next_line(before);
        if (row && before == line)
            print_keyword(to, line, row->repeats);
    }
}

static void print_origin(FILE *to, const double *o)
{
    if (o)
        fprintf(to, ", origin=(%.17g, %.17g, %.17g)", o[0], o[1], o[2]);
}

/* The arguments of cgt.read. */
static void print_reading(FILE *to, const picture_lines *p)
{
    const cgt_trajectory_options *const r = p->reading;
    const char *between = "";
    if (p->input_count > 1)
        putc('[', to);
    for (size_t i = 0; i < p->input_count; i++) {
        print_text(to, between, p->inputs[i]);
        between = ", ";
    }
    if (p->input_count > 1)
        putc(']', to);
    if (r->radius > 0.0f)
        fprintf(to, ", radius=%.9g", (double)r->radius);
    if (r->wrapped)
        fputs(", wrapped=True", to);
    print_origin(to, p->origin);
    print_text(to, ", format=", r->format);
    print_text(to, ", topology=", r->topology);
    if (r->all_bonds)
        fputs(", all_bonds=True", to);
    if (r->leave_out_sites)
        fputs(", leave_out_sites=True", to);
    if (r->fps > 0.0)
        fprintf(to, ", fps=%.9g", r->fps);
    print_text(to, ", clip=", r->clip);
    if (r->no_limit)
        fputs(", no_limit=True", to);
}

char *picture_lines_python(const picture_lines *p)
{
    char *text = NULL;
    size_t size = 0;
    FILE *const to = open_memstream(&text, &size);
    if (!to)
        return NULL;
    fputs("import cgt\n\nrun = cgt.read(", to);
    print_reading(to, p);
    fputs(")\nfigure = cgt.Figure(\n", to);
    print_keywords(to, p->settings);
    fputs(")\n", to);
    if (p->mesh) {
        print_text(to, "figure.set_mesh(cgt.read(", p->mesh);
        print_origin(to, p->origin);
        fputs(")[0])\n", to);
    }
    fprintf(to, "figure.survey(run)\nfor frame in run[%" PRIu64 ":%" PRIu64 "]:\n    figure.show(frame)\nfigure.save(",
            p->number - (p->lead < p->number ? p->lead : p->number), p->number + 1);
    print_text(to, "", p->output);
    fputs(")\n", to);
    return end_text(to, &text);
}

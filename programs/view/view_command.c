/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The command line of cgt-render for what is seen, and the picture that it makes; see view_draw.h. */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/program.h"
#include "common/settings_file.h"
#include "options/option_row.h"
#include "picture/files/image_write.h"
#include "view/view_draw.h"

/* Those of the command line that are not the figure's, those of the figure, and the origin that was found. */
char *view_draw_settings(const view_draw *d)
{
    char *text = NULL;
    size_t size = 0;
    char *const chosen = view_draw_get(d, cgt_figure_get_chosen, NULL);
    FILE *const to = chosen ? open_memstream(&text, &size) : NULL;
    if (to)
        settings_print_part(to, d->options.settings, 0);
    if (to && d->has_moved)
        fprintf(to, "origin = %.17g,%.17g,%.17g\n", d->origin[0], d->origin[1], d->origin[2]);
    if (to)
        fputs(chosen, to);
    free(chosen);
    if (to && fclose(to) == 0)
        return text;
    program_error("out of memory for the settings");
    free(text);
    return NULL;
}

/* "name = value" becomes --name=value, as 0 ends it. */
static void print_option(FILE *to, const char *line)
{
    const size_t length = strcspn(line, "\n"), name = settings_name_length(line);
    fprintf(to, "--%.*s", (int)name, line);
    if (length > name + 3)
        fprintf(to, "=%.*s", (int)(length - name - 3), line + name + 3);
    putc('\0', to);
}

/* What was printed; NULL with the message printed. */
static char *end_text(FILE *to, char **text)
{
    if (to && fclose(to) == 0)
        return *text;
    program_error("out of memory");
    free(*text);
    return NULL;
}

char *view_command_arguments(const char *settings)
{
    char *text = NULL;
    size_t size = 0;
    FILE *const to = open_memstream(&text, &size);
    for (; to && *settings; settings = settings_next_line(settings))
        print_option(to, settings);
    if (to)
        putc('\0', to);
    return end_text(to, &text);
}

/* An argument as a shell takes it, after a blank. */
static void print_argument(FILE *to, const char *text)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=,:+%@-";
    const int is_plain = *text && strspn(text, plain) == strlen(text);
    fputs(is_plain ? " " : " '", to);
    for (; *text; text++)
        if (*text == '\'')
            fputs("'\\''", to);
        else
            putc(*text, to);
    if (!is_plain)
        putc('\'', to);
}

char *view_command(const view_draw *d, const char *settings, uint64_t number, const char *pattern)
{
    char *text = NULL, *const options = view_command_arguments(settings);
    size_t size = 0;
    FILE *const to = options ? open_memstream(&text, &size) : NULL;
    if (to) {
        char output[4200];
        fputs("cgt-render", to);
        for (const char *option = options; *option; option += strlen(option) + 1)
            print_argument(to, option);
        fprintf(to, " --first=%" PRIu64 " --last=%" PRIu64, number, number);
        snprintf(output, sizeof output, "--output=%s", pattern);
        print_argument(to, output);
        for (size_t i = 0; i < d->options.input_count; i++)
            print_argument(to, d->options.inputs[i]);
        putc('\n', to);
    }
    free(options);
    return options ? end_text(to, &text) : NULL;
}

/* ---- Python ------------------------------------------------------------------------------------------------- */

static void print_string(FILE *to, const char *text, size_t length)
{
    putc('"', to);
    for (size_t i = 0; i < length; i++) {
        if (text[i] == '"' || text[i] == '\\')
            putc('\\', to);
        putc(text[i], to);
    }
    putc('"', to);
}

/* The value of a line, or True. */
static void print_value(FILE *to, const char *line)
{
    const size_t length = strcspn(line, "\n"), name = settings_name_length(line);
    if (length > name + 3)
        print_string(to, line + name + 3, length - name - 3);
    else
        fputs("True", to);
}

/* A keyword, with all values of the lines of its name that follow. */
static void print_keyword(FILE *to, const char *line, int repeats)
{
    const size_t name = settings_name_length(line);
    for (size_t i = 0; i < name; i++)
        putc(line[i] == '-' ? '_' : line[i], to);
    fputs(repeats ? "=[" : "=", to);
    print_value(to, line);
    for (const char *next = settings_next_line(line); repeats && *next; next = settings_next_line(next))
        if (settings_name_length(next) == name && strncmp(next, line, name) == 0) {
            fputs(", ", to);
            print_value(to, next);
        }
    if (repeats)
        putc(']', to);
}

/* Whether a line before this one has its name. */
static int is_told(const char *settings, const char *line)
{
    const size_t name = settings_name_length(line);
    for (const char *before = settings; before < line; before = settings_next_line(before))
        if (settings_name_length(before) == name && strncmp(before, line, name) == 0)
            return 1;
    return 0;
}

/* Arguments of cgt.read, by the reading's options as they are set. */
static void print_reading(FILE *to, const view_draw *d)
{
    const cgt_trajectory_options *const r = &d->options.reading;
    if (r->radius > 0.0f)
        fprintf(to, ", radius=%.9g", (double)r->radius);
    if (r->wrapped)
        fputs(", wrapped=True", to);
    if (r->has_origin || d->has_moved)
        fprintf(to, ", origin=(%.17g, %.17g, %.17g)", d->origin[0], d->origin[1], d->origin[2]);
    if (r->format) {
        fputs(", format=", to);
        print_string(to, r->format, strlen(r->format));
    }
    if (r->topology) {
        fputs(", topology=", to);
        print_string(to, r->topology, strlen(r->topology));
    }
    if (view_draw_has(d, "bonds"))
        fputs(", all_bonds=True", to);
    if (r->leave_out_sites)
        fputs(", leave_out_sites=True", to);
}

char *view_command_python(const view_draw *d, const char *settings, uint64_t number)
{
    char *text = NULL, name[64];
    size_t size = 0;
    FILE *const to = open_memstream(&text, &size);
    const char *between = "";
    if (to) {
        fputs("import cgt\n\nrun = cgt.read([", to);
        for (size_t i = 0; i < d->options.input_count; i++) {
            fputs(i ? ", " : "", to);
            print_string(to, d->options.inputs[i], strlen(d->options.inputs[i]));
        }
        fputs("]", to);
        print_reading(to, d);
        fputs(")\nfigure = cgt.Figure(", to);
        for (const char *line = settings; *line; line = settings_next_line(line)) {
            snprintf(name, sizeof name, "%.*s", (int)settings_name_length(line), line);
            const option_row *const row = cgt_figure_find_row(name);
            if (!row || is_told(settings, line))
                continue;
            fputs(between, to);
            print_keyword(to, line, row->repeats);
            between = ", ";
        }
        fprintf(to, ")\nfigure.show(run[%" PRIu64 "]).save(\"frame_%" PRIu64 ".png\")\n", number, number);
    }
    return end_text(to, &text);
}

int view_draw_write(view_draw *d, const char *settings, const char *path)
{
    const render_options *const o = &d->options;
    char error[PROGRAM_ERROR_SIZE];
    uint32_t width, height;
    char *const size = view_draw_get(d, cgt_figure_get_chosen, "size");
    char *const title = view_draw_get(d, cgt_figure_get, "title");
    image_writer *const writer = image_writer_create();
    const int has_size = size && sscanf(size, "%" SCNu32 "x%" SCNu32, &width, &height) == 2;
    const size_t pixels = has_size ? (size_t)width * height : 0;
    uint8_t *const rgb = malloc(4 * pixels + 1);
    const cgt_image image = {.bytes = rgb, .alpha = view_draw_has(d, "transparent") ? rgb + 3 * pixels : NULL};
    int result = -1;
    if (!has_size || !title || !writer || !rgb) {
        program_error("out of memory for the picture");
    } else if (view_draw_tell(d, cgt_figure_draw(d->figure, &image, NULL)) == 0) {
        title[strcspn(title, "\n")] = '\0';
        png_text texts[4] = {{"Software", "cgt-render (libcgt " CGT_VERSION_STRING ")"}, {"Source", o->input}};
        size_t texts_count = 2;
        if (*title)
            texts[texts_count++] = (png_text){"Title", title};
        texts[texts_count++] = (png_text){"Settings", settings};
        const image_content content = {.width = width,
                                       .height = height,
                                       .rgb = rgb,
                                       .alpha = image.alpha,
                                       .quality = o->output.quality,
                                       .texts = texts,
                                       .text_count = o->no_metadata ? 0 : texts_count};
        result = image_write(writer, path, &content, error, sizeof error);
        if (result)
            program_error("%s", error);
    }
    if (writer)
        image_writer_release(writer);
    free(size);
    free(title);
    free(rgb);
    return result;
}

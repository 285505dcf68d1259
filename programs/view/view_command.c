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
#include "options/option_row.h"
#include "picture/files/image_write.h"
#include "view/view_draw.h"

/* Those of the command line that are not the figure's, those of the figure, and the origin that was found. */
char *view_draw_settings(const view_draw *d)
{
    char *text = NULL, name[64];
    size_t size = 0;
    char *const chosen = view_draw_get(d, cgt_figure_get_chosen, NULL);
    FILE *const to = chosen ? open_memstream(&text, &size) : NULL;
    for (const char *line = d->options.settings; to && *line;) {
        const size_t length = strcspn(line, "\n");
        snprintf(name, sizeof name, "%.*s", (int)strcspn(line, " \n"), line);
        if (!cgt_figure_find_row(name))
            fprintf(to, "%.*s\n", (int)length, line);
        line += length + (line[length] == '\n');
    }
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

/* An argument as a shell takes it. */
static void print_argument(const char *text, size_t length)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=,:+%@-";
    const int is_plain = length && strspn(text, plain) >= length;
    if (!is_plain)
        putchar('\'');
    for (size_t i = 0; i < length; i++)
        if (text[i] == '\'')
            fputs("'\\''", stdout);
        else
            putchar(text[i]);
    if (!is_plain)
        putchar('\'');
}

static void print_text(const char *text)
{
    putchar(' ');
    print_argument(text, strlen(text));
}

void view_draw_print_command(const view_draw *d, const char *settings, uint64_t number, const char *pattern)
{
    char text[4200];
    fputs("cgt-render", stdout);
    for (const char *line = settings; *line;) { /* "name = value" becomes --name=value */
        const size_t length = strcspn(line, "\n"), name = strcspn(line, " \n");
        if (length > name + 3)
            snprintf(text, sizeof text, "--%.*s=%.*s", (int)name, line, (int)(length - name - 3), line + name + 3);
        else
            snprintf(text, sizeof text, "--%.*s", (int)name, line);
        print_text(text);
        line += length + (line[length] == '\n');
    }
    printf(" --first=%" PRIu64 " --last=%" PRIu64, number, number);
    snprintf(text, sizeof text, "--output=%s", pattern);
    print_text(text);
    for (size_t i = 0; i < d->options.input_count; i++)
        print_text(d->options.inputs[i]);
    putchar('\n');
    fflush(stdout);
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

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What is seen as settings, as the command line of cgt-render, as Python, and as the picture that these make; see
 * view_draw.h. */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/picture_lines.h"
#include "common/program.h"
#include "common/settings_file.h"
#include "figure_state.h"
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

/* What the lines are made of. reading gets how the files are read. */
static picture_lines lines_of(const view_draw *d, const char *settings, const view_frame *frame, const char *output,
                              cgt_trajectory_options *reading)
{
    const render_options *const o = &d->options;
    *reading = o->reading;
    reading->all_bonds = cgt_figure_options_need_bonds(&d->figure->options);
    return (picture_lines){.settings = settings,
                           .inputs = o->inputs,
                           .input_count = o->input_count,
                           .mesh = o->mesh,
                           .reading = reading,
                           .origin = o->reading.has_origin || d->has_moved ? d->origin : NULL,
                           .number = frame->frame.number,
                           .lead = frame->lead,
                           .output = output};
}

static char *tell(char *text)
{
    if (!text)
        program_error("out of memory");
    return text;
}

char *view_command(const view_draw *d, const char *settings, const view_frame *frame, const char *pattern)
{
    cgt_trajectory_options reading;
    const picture_lines p = lines_of(d, settings, frame, pattern, &reading);
    return tell(picture_lines_command(&p));
}

char *view_command_python(const view_draw *d, const char *settings, const view_frame *frame)
{
    char output[64];
    cgt_trajectory_options reading;
    snprintf(output, sizeof output, "frame_%" PRIu64 ".png", frame->frame.number);
    const picture_lines p = lines_of(d, settings, frame, output, &reading);
    return tell(picture_lines_python(&p));
}

int view_draw_write(view_draw *d, const char *settings, const char *path)
{
    const render_options *const o = &d->options;
    char error[PROGRAM_ERROR_SIZE];
    uint32_t width, height;
    char *const size = view_draw_get(d, cgt_figure_get_chosen, "size");
    char *const title = view_draw_get(d, cgt_figure_get, "title"), *const quoted = settings_quote(settings);
    image_writer *const writer = image_writer_create();
    const int has_size = size && sscanf(size, "%" SCNu32 "x%" SCNu32, &width, &height) == 2;
    const size_t pixels = has_size ? (size_t)width * height : 0;
    uint8_t *const rgb = malloc(4 * pixels + 1);
    const cgt_image image = {.bytes = rgb, .alpha = view_draw_has(d, "transparent") ? rgb + 3 * pixels : NULL};
    int result = -1;
    if (!has_size || !title || !quoted || !writer || !rgb) {
        program_error("out of memory for the picture");
    } else if (view_draw_tell(d, cgt_figure_draw(d->figure, &image, NULL)) == 0) {
        title[strcspn(title, "\n")] = '\0';
        png_text texts[4] = {{"Software", "cgt-render (libcgt " CGT_VERSION_STRING ")"}, {"Source", o->input}};
        size_t texts_count = 2;
        if (*title)
            texts[texts_count++] = (png_text){"Title", title};
        texts[texts_count++] = (png_text){"Settings", quoted};
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
    free(quoted);
    free(rgb);
    return result;
}

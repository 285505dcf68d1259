/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pictures in order; see render_writer.h. */
#define _POSIX_C_SOURCE 200809L
#include "render/stream/render_writer.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "common/program.h"

int render_stream_begin(render_writer *w)
{
    const render_options *o = w->options;
    char error[PROGRAM_ERROR_SIZE];
    for (uint32_t i = 0; i < o->output_count; i++) {
        if (render_output_kind(o->outputs[i].pattern) != OUTPUT_MOVIE)
            continue;
        const movie_options options = {.path = o->outputs[i].pattern,
                                       .width = o->figure.width,
                                       .height = o->figure.height,
                                       .rate = o->output.rate > 0.0 ? o->output.rate : 30.0,
                                       .quality = o->output.quality,
                                       .stop = w->stop,
                                       .preset = o->output.preset};
        w->movies[i] = movie_begin(&options, error, sizeof error);
        if (!w->movies[i]) {
            program_error("%s", error);
            return -1;
        }
    }
    return 0;
}

int render_stream_end(render_writer *w, int keep)
{
    char error[PROGRAM_ERROR_SIZE];
    int result = 0;
    for (uint32_t i = 0; i < RENDER_MAX_OUTPUTS; i++) {
        if (movie_end(w->movies[i], keep, error, sizeof error)) {
            program_error("%s", error);
            result = -1;
        } else if (w->movies[i] && keep) {
            w->movies_made |= 1u << i;
        }
        w->movies[i] = NULL;
    }
    return result;
}

/* Raw frames: the bytes of the pictures, one after the other. */
static int write_raw(const uint8_t *rgb, size_t left, const stop_flag *stop)
{
    while (left > 0 && !*stop) {
        const ssize_t written = write(STDOUT_FILENO, rgb, left);
        if (written > 0) {
            rgb += written;
            left -= (size_t)written;
        } else if (written == 0 || errno != EINTR) {
            program_error("standard output: %s", strerror(written == 0 ? EIO : errno));
            return -1;
        }
    }
    return 0;
}

static uint64_t number_of(const render_writer *w, uint64_t chosen)
{
    return w->options->range.first + chosen * w->options->range.every;
}

static int take(render_writer *w, const writer_picture *p)
{
    const render_options *o = w->options;
    char error[PROGRAM_ERROR_SIZE];
    for (uint32_t i = 0; i < o->output_count; i++) {
        if (w->movies[i] && movie_add(w->movies[i], p->rgb, error, sizeof error)) {
            if (*w->stop)
                return 0;
            program_error("%s", error);
            return -1;
        }
        if (render_output_kind(o->outputs[i].pattern) == OUTPUT_RAW &&
            write_raw(p->rgb, (size_t)o->figure.width * o->figure.height * 3, w->stop))
            return -1;
    }
    if (w->sheet)
        contact_sheet_add(w->sheet, p->chosen - w->first_chosen, number_of(w, p->chosen), p->rgb, p->alpha,
                          o->figure.picture.background);
    return 0;
}

void render_stream_run(render_writer *w)
{
    int failed = 0;
    for (writer_picture *p = NULL; !failed && (p = render_writer_next_in_order(w)) != NULL;) {
        const double begin = program_seconds();
        /* after a signal no movie is kept, but the files of this picture are */
        failed = !*w->stop && take(w, p);
        render_writer_streamed(w, p, failed, (program_seconds() - begin) * 1e3);
    }
}

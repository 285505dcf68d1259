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
                                       .width = o->width,
                                       .height = o->height,
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

/* Whether a picture is wanted here, on rank 0; others ask themselves the same before they send it. */
static int is_wanted(const render_writer *w, uint64_t chosen)
{
    return w->wants_all || (w->sheet && contact_sheet_wants(w->sheet, chosen - w->first_chosen));
}

static int take(render_writer *w, uint64_t chosen, const uint8_t *rgb)
{
    const render_options *o = w->options;
    char error[PROGRAM_ERROR_SIZE];
    for (uint32_t i = 0; i < o->output_count; i++) {
        if (w->movies[i] && movie_add(w->movies[i], rgb, error, sizeof error)) {
            if (*w->stop)
                return 0;
            program_error("%s", error);
            return -1;
        }
        if (render_output_kind(o->outputs[i].pattern) == OUTPUT_RAW &&
            write_raw(rgb, (size_t)o->width * o->height * 3, w->stop))
            return -1;
    }
    if (w->sheet)
        contact_sheet_add(w->sheet, chosen - w->first_chosen, number_of(w, chosen), rgb);
    return 0;
}

/* The next picture of this process. Returns 0, or -1 where there is none, or after a failure. */
static int take_own(render_writer *w)
{
    writer_picture *const p = render_writer_next_in_order(w);
    if (!p)
        return -1;
    const double begin = program_seconds();
    const uint64_t chosen = p->done.chosen;
    const size_t bytes = (size_t)w->options->width * w->options->height * 3;
    /* after a signal no movie is kept, but the files of this picture are */
    const int failed = *w->stop                    ? 0
                       : !share_is_first(w->share) ? is_wanted(w, chosen) && share_send_picture(w->share, p->rgb, bytes)
                                                   : take(w, chosen, p->rgb);
    render_writer_streamed(w, p, failed, (program_seconds() - begin) * 1e3);
    return failed ? -1 : 0;
}

/* The pictures of all processes, in order. */
static void run_for_all(render_writer *w)
{
    const size_t bytes = (size_t)w->options->width * w->options->height * 3;
    int rank;
    for (uint64_t chosen = w->first_chosen; share_find_owner(w->share, chosen, &rank); chosen++) {
        if (rank == 0) {
            if (take_own(w))
                break;
            continue;
        }
        if (!is_wanted(w, chosen))
            continue;
        if (share_receive_picture(w->share, chosen, rank, w->received, bytes))
            break;
        if (take(w, chosen, w->received)) {
            render_writer_fail(w);
            break;
        }
    }
    share_drop_pictures(w->share, w->received, bytes); /* after a failure; else none come */
}

void render_stream_run(render_writer *w)
{
    if (w->share->link.size > 1 && share_is_first(w->share)) {
        run_for_all(w);
        return;
    }
    while (take_own(w) == 0)
        continue;
}

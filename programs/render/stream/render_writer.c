/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Writing behind; see render_writer.h. */
#define _POSIX_C_SOURCE 200809L
#include "render/stream/render_writer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/program.h"

/* ---- The ring ----------------------------------------------------------------------------------------------- */

static writer_picture *at(render_writer *w, uint64_t count) { return &w->ring[count % w->places]; }

/* Frees places whose pictures are done, in order, and tells of them. One thread at a time does, without the lock
 * while it tells. Under the lock. */
static void retire(render_writer *w)
{
    while (!w->retiring && w->retired < w->submitted) {
        writer_picture *const p = at(w, w->retired);
        if (!p->written || !(p->streamed || w->stream_over))
            break;
        w->retiring = 1;
        if (!p->failed) {
            pthread_mutex_unlock(&w->lock);
            const int wrong = w->on_done(w->user, &p->done);
            pthread_mutex_lock(&w->lock);
            w->failed |= wrong != 0;
            w->done++;
        }
        w->retiring = 0;
        w->retired++;
    }
    pthread_cond_broadcast(&w->changed);
}

static void fail(render_writer *w)
{
    pthread_mutex_lock(&w->lock);
    w->failed = 1;
    pthread_cond_broadcast(&w->changed);
    pthread_mutex_unlock(&w->lock);
}

/* ---- Files -------------------------------------------------------------------------------------------------- */

static int write_files(render_writer *w, image_writer *files, const writer_picture *p)
{
    const render_options *o = w->options;
    char name[4096], error[PROGRAM_ERROR_SIZE];
    const image_content image = {.width = o->figure.width,
                                 .height = o->figure.height,
                                 .rgb = p->rgb,
                                 .alpha = p->alpha,
                                 .pixels = p->pixels,
                                 .quality = o->output.quality,
                                 .texts = w->texts,
                                 .text_count = w->text_count};
    for (uint32_t i = 0; i < o->output_count; i++) {
        if (render_output_kind(o->outputs[i].pattern) != OUTPUT_PICTURE)
            continue;
        if (out_path_name(&o->outputs[i], p->done.record.number, name, sizeof name))
            snprintf(error, sizeof error, "%s: the name is too long", o->outputs[i].pattern);
        else if (image_write(files, name, &image, error, sizeof error) == 0)
            continue;
        program_error("%s", error);
        return -1;
    }
    return 0;
}

/* A thread that writes files until there are no more. After a failure it only empties the ring. */
static void *write_pictures(void *user)
{
    render_writer *const w = user;
    image_writer *const files = image_writer_create();
    if (!files)
        program_error("out of memory for writing pictures");
    pthread_mutex_lock(&w->lock);
    for (;;) {
        while (w->writing == w->submitted && !w->closing)
            pthread_cond_wait(&w->changed, &w->lock);
        if (w->writing == w->submitted)
            break;
        writer_picture *const p = at(w, w->writing++);
        const int skipped = w->failed;
        pthread_mutex_unlock(&w->lock);
        const double begin = program_seconds();
        const int failed = skipped || !files || write_files(w, files, p);
        const double ms = (program_seconds() - begin) * 1e3;
        if (failed && !skipped)
            fail(w);
        pthread_mutex_lock(&w->lock);
        p->done.record.write_ms += ms;
        p->failed |= failed;
        p->written = 1;
        retire(w);
    }
    pthread_mutex_unlock(&w->lock);
    image_writer_release(files);
    return NULL;
}

/* ---- In order ----------------------------------------------------------------------------------------------- */

writer_picture *render_writer_next_in_order(render_writer *w)
{
    pthread_mutex_lock(&w->lock);
    while (w->streaming == w->submitted && !w->closing && !w->failed)
        pthread_cond_wait(&w->changed, &w->lock);
    writer_picture *const p = w->streaming < w->submitted && !w->failed ? at(w, w->streaming++) : NULL;
    pthread_mutex_unlock(&w->lock);
    return p;
}

void render_writer_streamed(render_writer *w, writer_picture *p, int failed, double ms)
{
    if (failed)
        fail(w);
    pthread_mutex_lock(&w->lock);
    p->done.record.write_ms += ms;
    p->failed |= failed;
    p->streamed = 1;
    retire(w);
    pthread_mutex_unlock(&w->lock);
}

static void *write_in_order(void *user)
{
    render_writer *const w = user;
    render_stream_run(w);
    pthread_mutex_lock(&w->lock);
    w->stream_over = 1;
    retire(w);
    pthread_mutex_unlock(&w->lock);
    return NULL;
}

/* ---- Start and end ------------------------------------------------------------------------------------------ */

static int make_buffers(render_writer *w)
{
    const render_options *o = w->options;
    const size_t pixels = (size_t)o->figure.width * o->figure.height; /* at most FIGURE_MAX_PIXELS */
    int exr = 0, wrong = 0;
    for (uint32_t i = 0; i < o->output_count; i++)
        exr |= image_format_of(o->outputs[i].pattern) == IMAGE_EXR;
    for (uint32_t i = 0; i < w->places && !wrong; i++) {
        w->ring[i].rgb = malloc(pixels * 3);
        w->ring[i].pixels = exr ? malloc(pixels * sizeof *w->ring[i].pixels) : NULL;
        w->ring[i].alpha = o->figure.picture.transparent ? malloc(pixels) : NULL;
        wrong = !w->ring[i].rgb || (o->figure.picture.transparent && !w->ring[i].alpha) || (exr && !w->ring[i].pixels);
    }
    if (wrong)
        program_error("out of memory for %u pictures of %ux%u pixels", (unsigned)w->places, (unsigned)o->figure.width,
                      (unsigned)o->figure.height);
    return wrong ? -1 : 0;
}

static int start_thread(render_writer *w, void *(*run)(void *))
{
    if (pthread_create(&w->thread[w->thread_count], NULL, run, w) != 0) {
        program_error("cannot start a thread that writes");
        return -1;
    }
    w->thread_count++;
    return 0;
}

/* What the outputs ask for. */
static int survey_outputs(render_writer *w)
{
    const render_options *o = w->options;
    char error[PROGRAM_ERROR_SIZE];
    for (uint32_t i = 0; i < o->output_count; i++) {
        const int files = render_output_kind(o->outputs[i].pattern) == OUTPUT_PICTURE;
        w->has_files |= files;
        w->has_stream |= !files;
        if (files && image_format_load(image_format_of(o->outputs[i].pattern), error, sizeof error)) {
            program_error("%s: %s", o->outputs[i].pattern, error);
            return -1;
        }
    }
    w->has_stream |= w->sheet != NULL;
    return 0;
}

int render_writer_start(render_writer *w)
{
    pthread_mutex_init(&w->lock, NULL);
    pthread_cond_init(&w->changed, NULL);
    w->started = 1;
    if (survey_outputs(w))
        return -1;
    w->file_threads = w->threads < WRITER_MOST_THREADS ? w->threads : WRITER_MOST_THREADS;
    w->file_threads = w->has_files ? w->file_threads : 0;
    w->places = w->file_threads + WRITER_SPARE;
    if (make_buffers(w) || render_stream_begin(w))
        return -1;
    for (uint32_t i = 0; i < w->file_threads; i++)
        if (start_thread(w, write_pictures))
            return -1;
    return w->has_stream ? start_thread(w, write_in_order) : 0;
}

writer_picture *render_writer_begin(render_writer *w)
{
    pthread_mutex_lock(&w->lock);
    while (!w->failed && w->submitted - w->retired == w->places)
        pthread_cond_wait(&w->changed, &w->lock);
    writer_picture *const p = w->failed ? NULL : at(w, w->submitted);
    pthread_mutex_unlock(&w->lock);
    if (p) {
        memset(&p->done, 0, sizeof p->done);
        p->written = !w->has_files;
        p->streamed = !w->has_stream;
        p->failed = 0;
    }
    return p;
}

void render_writer_submit(render_writer *w)
{
    pthread_mutex_lock(&w->lock);
    w->submitted++;
    retire(w);
    pthread_mutex_unlock(&w->lock);
}

uint64_t render_writer_count_done(render_writer *w)
{
    pthread_mutex_lock(&w->lock);
    const uint64_t done = w->done;
    pthread_mutex_unlock(&w->lock);
    return done;
}

int render_writer_drain(render_writer *w)
{
    pthread_mutex_lock(&w->lock);
    w->closing = 1;
    pthread_cond_broadcast(&w->changed);
    pthread_mutex_unlock(&w->lock);
    for (uint32_t i = 0; i < w->thread_count; i++)
        pthread_join(w->thread[i], NULL);
    w->thread_count = 0;
    return w->failed ? -1 : 0;
}

int render_writer_finish(render_writer *w, int keep)
{
    if (!w->started)
        return 0;
    int result = render_writer_drain(w);
    if (render_stream_end(w, keep && result == 0))
        result = -1;
    for (uint32_t i = 0; i < w->places; i++) {
        free(w->ring[i].rgb);
        free(w->ring[i].alpha);
        free(w->ring[i].pixels);
    }
    const uint32_t made = w->movies_made;
    memset(w, 0, sizeof *w);
    w->movies_made = made;
    return result;
}

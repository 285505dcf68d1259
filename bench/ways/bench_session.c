/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One file, and the tracers of all its ways. */
#include <stdlib.h>
#include <string.h>

#include "common/bench_timing.h"
#include "ways/bench_tracer.h"

/* Opens a tracer for each way, before the first commit. */
static int open_tracers(bench_session *s)
{
    s->tracers = bench_ways_make(s->settings, s->input.index != NULL, s->way);
    s->tracer = calloc(s->tracers + 1, sizeof *s->tracer);
    if (!s->tracer) {
        program_error("out of memory");
        s->tracers = 0;
        return PROGRAM_FAILED;
    }
    int code = PROGRAM_OK;
    for (size_t i = 0; i < s->tracers && code == PROGRAM_OK; i++) {
        bench_tracer *t = &s->tracer[i];
        t->session = s;
        t->way = &s->way[i];
        t->built_by = &s->tracer[t->way->built_by];
        t->engine = &bench_library_engine;
#ifdef BENCH_HAS_EMBREE
        if (t->way->embree) {
            t->engine = &bench_embree_engine;
            code = bench_embree_open(s);
        }
#endif
        bench_way_name(t->way, t->way->structure, t->config);
        if (code == PROGRAM_OK)
            code = t->engine->open(t);
        t->left_out |= t->built_by->left_out;
    }
    return code;
}

int bench_session_open_input(bench_session *s, const bench_settings *settings, const char *path,
                             const bench_input *input)
{
    memset(s, 0, sizeof *s);
    s->settings = settings;
    s->camera = &settings->camera;
    s->path = path;
    bench_file_name(path, s->scene);
    bench_camera_axes_init(&s->axes, &settings->camera, settings->width, settings->height);
    s->input = *input;
    s->count = bench_input_move(&s->input, s->input.frames - 1);
    const int code = bench_context_create(settings->threads, settings->choice.variant, &s->context);
    return code == PROGRAM_OK ? open_tracers(s) : code;
}

int bench_session_open(bench_session *s, const bench_settings *settings, const char *path)
{
    bench_input input;
    memset(s, 0, sizeof *s);
    return bench_input_load_file(&input, settings, path) ? PROGRAM_FAILED
                                                         : bench_session_open_input(s, settings, path, &input);
}

void bench_session_close(bench_session *s)
{
    for (size_t i = 0; i < s->tracers; i++)
        if (s->tracer[i].engine && s->tracer[i].built_by == &s->tracer[i])
            s->tracer[i].engine->close(&s->tracer[i]);
#ifdef BENCH_HAS_EMBREE
    bench_embree_close(s);
#endif
    free(s->tracer);
    cgt_context_release(s->context);
    bench_input_release(&s->input);
}

bench_tracer *bench_session_first(const bench_session *s)
{
    for (int embree = 0; embree < 2; embree++)
        for (size_t i = 0; i < s->tracers; i++)
            if (!s->tracer[i].left_out && s->tracer[i].way->embree == embree)
                return &s->tracer[i];
    return NULL;
}

double bench_session_ms(const bench_session *session)
{
    return bench_clock_ms(cgt_context_get_threads(session->context) == 1);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Movies of what is seen: cgt-render makes them, in a process of its own, by the settings of the picture at hand; so
 * they have its bytes, and the window goes on. */
#define _POSIX_C_SOURCE 200809L
#include "view/viewer/viewer_internal.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "common/picture_lines.h"
#include "system/system.h"

static const double poll_every = 0.25; /* seconds between two looks at it */

/* ---- The command -------------------------------------------------------------------------------------------- */

/* cgt-render beside this program, else the one that the system finds. */
static void find_renderer(char *path, size_t size)
{
    static const char name[] = "cgt-render";
    char *slash;
    if (system_own_path(path, size) || !(slash = strrchr(path, '/')) || (size_t)(slash + 1 - path) + sizeof name > size)
        slash = NULL;
    else
        memcpy(slash + 1, name, sizeof name);
    if (!slash || access(path, X_OK) != 0)
        snprintf(path, size, "%s", name);
}

/* A file of times, a line for each frame, by which the movie's progress is known. */
static int make_log(char *path, size_t size)
{
    const char *const folder = getenv("TMPDIR");
    snprintf(path, size, "%s/cgt-view-XXXXXX", folder && *folder ? folder : "/tmp");
    const int file = mkstemp(path);
    if (file >= 0)
        close(file);
    else
        path[0] = '\0'; /* there is none to remove */
    return file >= 0 ? 0 : -1;
}

static int start(viewer *v, char *settings, float turn)
{
    view_movie *const m = &v->movie;
    const render_options *const o = &v->options.render;
    const size_t others = 16; /* beside the settings' options and the files */
    char renderer[4096], text[6][128];
    size_t count = 0, options = 0;
    char *const lines = picture_lines_options(settings);
    for (const char *line = lines; line && *line; line += strlen(line) + 1)
        options++;
    const char **const argv = lines ? malloc((options + o->input_count + others) * sizeof *argv) : NULL;
    if (!argv) {
        program_error("out of memory for a movie");
        free(lines);
        return ENOMEM;
    }
    find_renderer(renderer, sizeof renderer);
    argv[count++] = renderer;
    for (const char *line = lines; *line; line += strlen(line) + 1)
        argv[count++] = line;
    snprintf(text[0], sizeof text[0], "--first=%" PRIu64, o->range.first);
    snprintf(text[1], sizeof text[1], "--last=%" PRIu64, o->range.last);
    snprintf(text[2], sizeof text[2], "--every=%" PRIu64, o->range.every);
    snprintf(text[3], sizeof text[3], "--output=%s", m->name);
    snprintf(text[4], sizeof text[4], "--orbit=%.9g", (double)turn);
    for (int i = 0; i < 4 + (turn != 0.0f); i++)
        argv[count++] = text[i];
    argv[count++] = "--quiet";
    argv[count++] = "--log-file";
    argv[count++] = m->log;
    argv[count++] = "--";
    for (size_t i = 0; i < o->input_count; i++)
        argv[count++] = o->inputs[i];
    argv[count] = NULL;
    const int wrong = process_start(&m->child, argv, m->messages);
    free(argv);
    free(lines);
    if (wrong)
        program_error("%s cannot be started: %s", renderer, strerror(wrong));
    else
        process_close_pipe(&m->child);
    return wrong;
}

/* ---- Begin, end --------------------------------------------------------------------------------------------- */

static void clean(viewer *v)
{
    if (v->movie.messages)
        fclose(v->movie.messages);
    if (v->movie.log[0])
        unlink(v->movie.log);
    v->movie = (view_movie){.frames = 0};
    v->changed = 1;
}

void viewer_start_movie(viewer *v, float turn)
{
    view_movie *const m = &v->movie;
    view_frames_state state;
    if (m->is_made) {
        viewer_stop_movie(v);
        return;
    }
    if (!v->shown || v->scene_is_wrong)
        return;
    view_frames_get(v->frames, &state);
    if (state.is_final && state.count < 2) {
        viewer_say(v, "a movie needs more than one frame");
        return;
    }
    int number = 1;
    do
        snprintf(m->name, sizeof m->name, number == 1 ? "view.mp4" : "view-%d.mp4", number);
    while (access(m->name, F_OK) == 0 && ++number < 100000);
    if (view_draw_tell(v->draw, cgt_figure_set_camera(v->draw->figure, &v->camera)))
        return;
    char *const settings = view_draw_settings(v->draw);
    m->messages = system_temporary();
    if (settings && m->messages && make_log(m->log, sizeof m->log) == 0 && start(v, settings, turn) == 0) {
        m->is_made = 1;
        viewer_say(v, "%s is being made; m ends it", m->name);
    } else {
        if (settings && (!m->messages || !m->log[0]))
            program_error("no temporary file for a movie: %s", strerror(errno));
        clean(v);
    }
    free(settings);
}

void viewer_stop_movie(viewer *v)
{
    if (v->movie.is_made && !v->movie.is_stopped)
        process_interrupt(&v->movie.child);
    v->movie.is_stopped = 1;
}

/* ---- Meanwhile ---------------------------------------------------------------------------------------------- */

/* Lines of the log, but the first, which names its columns. */
static void count_frames(view_movie *m)
{
    FILE *const log = fopen(m->log, "r");
    uint64_t lines = 0;
    int c;
    if (!log)
        return;
    while ((c = getc(log)) != EOF)
        lines += c == '\n';
    fclose(log);
    m->frames = lines ? lines - 1 : 0;
}

/* What it said last. */
static void tell_failure(const view_movie *m, const char *reason)
{
    char line[512], last[512] = "";
    rewind(m->messages);
    while (fgets(line, sizeof line, m->messages))
        if (line[0] != '\n')
            snprintf(last, sizeof last, "%s", line);
    last[strcspn(last, "\n")] = '\0';
    program_error("%s: %s", m->name, last[0] ? last : reason);
}

double viewer_watch_movie(viewer *v, int waits)
{
    view_movie *const m = &v->movie;
    char reason[200] = "it failed";
    int code = 0;
    if (!m->is_made)
        return 1e9;
    if (!process_has_ended(&m->child, waits, &code, reason, sizeof reason)) {
        const uint64_t before = m->frames;
        count_frames(m);
        v->changed |= m->frames != before;
        return poll_every;
    }
    if (m->is_stopped)
        viewer_say(v, "no movie: it was ended");
    else if (code == 0)
        viewer_say(v, "wrote %s", m->name);
    else
        tell_failure(m, reason);
    if (m->is_stopped && code == 0)
        unlink(m->name); /* it was ready by then */
    clean(v);
    return 0.0;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Other files in place of those that are shown, the same read anew, and settings files. What fails leaves all as it
 * is. */
#define _POSIX_C_SOURCE 200809L
#include "view/viewer/viewer_internal.h"

#include <inttypes.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "common/settings_file.h"
#include "options/option_row.h"
#include "view/view_recent.h"

/* ---- Settings ----------------------------------------------------------------------------------------------- */

static int is_named(const char *line, const char *name)
{
    return settings_name_length(line) == strlen(name) && strncmp(line, name, strlen(name)) == 0;
}

/* Lines that begin with any of the names; or all others. */
static void print_lines(FILE *to, const char *lines, const char *const *names, int others)
{
    for (const char *line = lines; *line; line = settings_next_line(line)) {
        int is_one = 0;
        for (size_t i = 0; names[i]; i++)
            is_one |= is_named(line, names[i]);
        if (is_one != others)
            fprintf(to, "%.*s\n", (int)strcspn(line, "\n"), line);
    }
}

/* What of the command line goes on: of other files no more than how they are written. */
static void print_own(FILE *to, const viewer *v, int is_same)
{
    static const char *const of_writing[] = {"rate", "quality", NULL};
    const char *const lines = v->options.render.settings;
    if (lines && is_same)
        settings_print_part(to, lines, 0);
    else if (lines)
        print_lines(to, lines, of_writing, 0);
}

/* ---- Waiting ------------------------------------------------------------------------------------------------ */

typedef struct view_opening {
    view_draw *draw;
    pthread_mutex_t lock; /* of all below */
    pthread_cond_t changed;
    int is_done, failed;
} view_opening;

static void *open_draw(void *user)
{
    view_opening *const o = user;
    const int failed = view_draw_open(o->draw);
    pthread_mutex_lock(&o->lock);
    o->failed = failed;
    o->is_done = 1;
    pthread_cond_signal(&o->changed);
    pthread_mutex_unlock(&o->lock);
    return NULL;
}

/* Whether it is done, for a tenth of a second at most. */
static int wait_for(view_opening *o)
{
    const long tenth = 100000000, second = 1000000000;
    struct timespec end;
    timespec_get(&end, TIME_UTC);
    end.tv_sec += (end.tv_nsec + tenth) / second;
    end.tv_nsec = (end.tv_nsec + tenth) % second;
    pthread_mutex_lock(&o->lock);
    while (!o->is_done && pthread_cond_timedwait(&o->changed, &o->lock, &end) == 0) {
    }
    const int is_done = o->is_done;
    pthread_mutex_unlock(&o->lock);
    return is_done;
}

/* Whether the opening is to end: by Escape, which is for this alone then, or with the window, which says no more. */
static int is_to_end(viewer *v)
{
    int ends = 0;
    pthread_mutex_lock(&v->lock);
    v->is_leaving |= v->closing;
    for (size_t i = 0; i < v->event_count; i++) {
        view_event *const e = &v->events[i];
        if (e->kind == VIEW_KEY && e->key == VIEW_KEY_ESCAPE) {
            e->key = 0;
            ends = 1;
        }
        v->is_leaving |= e->kind == VIEW_KEY && e->key == 'q' && !e->control;
    }
    ends |= v->is_leaving;
    pthread_mutex_unlock(&v->lock);
    return ends;
}

/* Opens files in a thread of its own. What is shown stays meanwhile, and tells how far it is. Takes the settings of the
 * options over. Returns NULL with the message printed. */
static view_draw *open_and_tell(viewer *v, const view_options *options, int *was_ended)
{
    view_opening o = {.lock = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};
    pthread_t thread;
    *was_ended = 0;
    o.draw = view_draw_create(options);
    if (!o.draw) {
        free(options->render.settings);
        return NULL;
    }
    const int has_thread = pthread_create(&thread, NULL, open_draw, &o) == 0;
    if (!has_thread)
        open_draw(&o);
    while (!wait_for(&o)) {
        if (is_to_end(v)) {
            *was_ended = 1;
            view_draw_stop(o.draw);
        }
        v->is_opening = 1;
        viewer_compose(v);
        v->wake(v->user, 1);
    }
    if (has_thread)
        pthread_join(thread, NULL);
    pthread_mutex_lock(&v->lock);
    v->sent = 0.0; /* how long pictures take is not told by events that waited for this */
    pthread_mutex_unlock(&v->lock);
    v->changed |= v->is_opening;
    v->is_opening = 0;
    if (!o.failed)
        return o.draw;
    view_draw_close(o.draw);
    return NULL;
}

/* ---- Opening ------------------------------------------------------------------------------------------------ */

/* Names of files, a line each, as they are kept. */
static char **split_paths(char *lines, size_t *count)
{
    size_t most = 1;
    for (const char *c = lines; *c; c++)
        most += *c == '\n';
    char **const paths = calloc(most, sizeof *paths);
    *count = 0;
    for (char *line = lines; paths && *line;) {
        const size_t length = strcspn(line, "\n");
        const int ends = line[length] == '\0';
        line[length] = '\0';
        if (length)
            paths[(*count)++] = line;
        line += length + !ends;
    }
    return paths;
}

/* What was shown is gone, and the new file takes its place. Frame and picks of the same files stay, and the conditions
 * of the command line stay what they are; a new camera follows no selection. */
static void replace(viewer *v, view_draw *draw, const render_options *options, int is_same, int keeps_camera)
{
    const uint64_t frame = v->shown ? v->shown->chosen : 0;
    char size[32];
    cgt_camera camera;
    if (v->draw && (is_same || draw->shows[0])) { /* else they were left out */
        char *const shows = draw->shows;
        draw->shows = v->draw->shows;
        v->draw->shows = shows;
    }
    view_draw_stop(v->draw);
    view_frames_release(v->frames, v->shown);
    view_frames_finish(v->frames);
    view_draw_close(v->draw);
    v->draw = draw;
    v->shown = NULL;
    v->options.render = *options;
    v->wanted = is_same ? frame : 0;
    v->is_arriving |= !is_same;
    v->playing = v->scene_is_wrong = v->list = 0;
    v->picks = is_same ? v->picks : 0;
    v->filter.is_followed &= keeps_camera;
    v->drag = DRAG_NONE;
    snprintf(size, sizeof size, "%ux%u", v->width, v->height);
    view_draw_tell(draw, cgt_figure_set(draw->figure, "size", size));
    cgt_figure_get_up(draw->figure, v->axis);
    if (!keeps_camera && cgt_figure_get_camera(draw->figure, &camera) == CGT_OK) {
        v->camera = camera;
        view_camera_straighten(&v->camera);
        memcpy(v->pivot, v->camera.target, sizeof v->pivot);
    }
    v->outdated = v->changed = 1;
    viewer_publish(v);
}

static int start_frames(viewer *v)
{
    v->frames = view_draw_start_frames(v->draw, render_memory(&v->options.render), viewer_on_frames, v);
    if (!v->frames) { /* there is a message to read */
        view_draw_close(v->draw);
        v->draw = NULL;
        v->options.render.settings = NULL;
        return -1;
    }
    view_recent_add(v->options.render.input);
    return 0;
}

/* Opens files by settings, of which the figure's are also needed as options. Takes paths and settings over. Returns 0,
 * -1, or 1 where the user ended it. */
static int open_by(viewer *v, char *paths, char *settings, int is_same, int keeps_camera)
{
    view_options o = v->options;
    view_opened next = {.paths = paths};
    char error[PROGRAM_ERROR_SIZE] = "out of memory";
    size_t count = 0;
    next.inputs = paths ? split_paths(paths, &count) : NULL;
    if (!is_same) {
        render_options plain;
        render_options_init(&plain);
        o.render.reading = plain.reading;
        o.render.range = plain.range;
        o.render.mesh = NULL;
    }
    o.render.inputs = (const char **)(void *)next.inputs;
    o.render.input_count = count;
    o.render.input = count ? next.inputs[0] : NULL;
    o.render.settings = settings;
    char *const of_figure = settings ? calloc(strlen(settings) + 1, 1) : NULL;
    FILE *const to = of_figure && *settings ? fmemopen(of_figure, strlen(settings) + 1, "w") : NULL;
    if (to) {
        settings_print_part(to, settings, 1);
        fclose(to);
    }
    cgt_figure_options_init(&o.render.figure);
    int failed = !next.inputs || !count || !of_figure ||
                 cgt_figure_settings_change(&next.settings, SETTINGS_LINES, NULL, of_figure, &o.render.figure, error,
                                            sizeof error);
    free(of_figure);
    if (failed) {
        program_error("%s", error);
        free(settings);
    }
    int was_ended = 0;
    view_draw *const draw = failed ? NULL : open_and_tell(v, &o, &was_ended);
    if (!draw) {
        viewer_free_opened(&next);
        return was_ended ? 1 : -1;
    }
    viewer_forget_settings(v);
    replace(v, draw, &o.render, is_same, keeps_camera);
    viewer_free_opened(&v->opened);
    v->opened = next;
    return start_frames(v);
}

void viewer_open_first(viewer *v)
{
    int was_ended;
    const char *const given = v->options.render.settings;
    char *const copy = given ? strdup(given) : NULL; /* for another file, where this one cannot be opened */
    view_draw *const draw = open_and_tell(v, &v->options, &was_ended);
    v->options.render.settings = copy; /* what opens took them over */
    if (!draw && was_ended)
        v->options.render.input_count = 0; /* there is no file */
    if (!draw)
        return;
    viewer_forget_settings(v);
    replace(v, draw, &draw->options, 0, 0);
    start_frames(v);
}

void viewer_forget_settings(viewer *v)
{
    if (!v->draw) /* else they are its own */
        free(v->options.render.settings);
    v->options.render.settings = NULL;
}

void viewer_free_opened(view_opened *o)
{
    free(o->inputs);
    free(o->paths);
    cgt_figure_settings_free(&o->settings);
    *o = (view_opened){.paths = NULL};
}

/* Opens files by lines of the figure's settings; paths: NULL: those that are shown. Results as those of open_by. */
static int open_lines(viewer *v, const char *paths, const char *lines, int keeps_camera)
{
    static const char *const size_name[] = {"size", NULL};
    char *text = NULL, *names = NULL;
    size_t size, names_size;
    FILE *const to = open_memstream(&text, &size), *const to_names = open_memstream(&names, &names_size);
    if (to) {
        print_own(to, v, !paths);
        print_lines(to, lines, size_name, 1);
        fprintf(to, "size = %ux%u\n", v->width, v->height);
    }
    for (size_t i = 0; to_names && !paths && i < v->options.render.input_count; i++)
        fprintf(to_names, "%s\n", v->options.render.inputs[i]);
    if (to_names && paths)
        fputs(paths, to_names);
    const int failed = (to ? fclose(to) : -1) | (to_names ? fclose(to_names) : -1);
    if (failed) {
        program_error("out of memory");
        free(text);
        free(names);
        return -1;
    }
    return open_by(v, names, text, !paths, keeps_camera);
}

/* Whether the first of the files can be read. */
static int is_there(const char *paths)
{
    char *const first = strndup(paths, strcspn(paths, "\n"));
    const int result = first && access(first, R_OK) == 0;
    free(first);
    return result;
}

/* The figure's; without a file those of the command line. */
static char *current_lines(const viewer *v)
{
    const char *const given = v->options.render.settings;
    char *text = NULL;
    size_t size;
    if (v->draw)
        return view_draw_get(v->draw, cgt_figure_get, NULL);
    FILE *const to = open_memstream(&text, &size);
    if (to)
        settings_print_part(to, given ? given : "", 1);
    return to && fclose(to) == 0 ? text : NULL;
}

int viewer_open(viewer *v, const char *paths)
{
    static const char *const of_place[] = {"camera", NULL};
    static const char *const of_any[] = {"style", NULL};
    char *text = NULL, *few = NULL;
    size_t size, few_size;
    int result = -1;
    if (!paths[strspn(paths, "\n")])
        return 0;
    char *const lines = current_lines(v);
    FILE *const to = lines ? open_memstream(&text, &size) : NULL;
    FILE *const to_few = lines ? open_memstream(&few, &few_size) : NULL;
    if (to)
        print_lines(to, lines, of_place, 1);
    if (to_few)
        print_lines(to_few, lines, of_any, 0);
    const int failed = (to ? fclose(to) : -1) | (to_few ? fclose(to_few) : -1);
    if (failed)
        program_error("out of memory");
    else if ((result = open_lines(v, paths, text, 0)) < 0 && strcmp(text, few) != 0 && is_there(paths) &&
             (result = open_lines(v, paths, few, 0)) == 0)
        viewer_say(v, "options that do not go with this file are left out"); /* why was said before */
    free(text);
    free(few);
    free(lines);
    return result;
}

void viewer_read_anew(viewer *v)
{
    char *const lines = v->draw ? current_lines(v) : NULL;
    if (lines && open_lines(v, NULL, lines, 1) == 0)
        viewer_say(v, "read anew");
    free(lines);
}

int viewer_read_by(viewer *v, const char *name, const char *values)
{
    const char *const names[] = {name, NULL};
    char *text = NULL;
    size_t size;
    char *const lines = current_lines(v);
    FILE *const to = lines ? open_memstream(&text, &size) : NULL;
    if (to)
        print_lines(to, lines, names, 1);
    for (const char *value = values; to && *value; value = settings_next_line(value)) {
        const size_t length = strcspn(value, "\n");
        fprintf(to, length ? "%s = %.*s\n" : "%s%.*s\n", name, (int)length, value);
    }
    const int result = !to || fclose(to) ? -1 : open_lines(v, NULL, text, 1);
    free(text);
    free(lines);
    return result;
}

/* ---- Settings files ----------------------------------------------------------------------------------------- */

void viewer_load_settings(viewer *v, const char *path)
{
    char left_out[512], error[PROGRAM_ERROR_SIZE];
    char *const lines = settings_read_figure(path, 1, left_out, sizeof left_out, error, sizeof error);
    int has_camera = 0;
    if (!lines) {
        program_error("%s", error);
        return;
    }
    for (const char *line = lines; *line; line += strcspn(line, "\n") + 1)
        has_camera |= is_named(line, "camera");
    const view_change change = {
        .option = VIEW_ALL, .before = current_lines(v), .has_camera = has_camera, .camera = v->camera};
    if (!v->draw)
        viewer_say(v, "open a file first");
    if (!v->draw || open_lines(v, NULL, lines, !has_camera)) {
        free(change.before);
    } else {
        viewer_remember(v, change, 0);
        viewer_say(v, left_out[0] ? "%s is loaded, without %s" : "%s is loaded", path, left_out);
    }
    free(lines);
}

int viewer_unload_settings(viewer *v, const view_change *change)
{
    const int result = open_lines(v, NULL, change->before, 1);
    if (result == 0 && change->has_camera) {
        v->camera = change->camera;
        memcpy(v->pivot, v->camera.target, sizeof v->pivot);
    }
    return result;
}

/* By a name that is not there yet. */
void viewer_save_settings(viewer *v)
{
    char name[64], error[PROGRAM_ERROR_SIZE];
    if (!v->shown || v->scene_is_wrong || view_draw_tell(v->draw, cgt_figure_set_camera(v->draw->figure, &v->camera)))
        return;
    int number = 1;
    do
        snprintf(name, sizeof name, number == 1 ? "view.settings" : "view-%d.settings", number);
    while (access(name, F_OK) == 0 && ++number < 100000);
    char *const lines = view_draw_settings(v->draw);
    if (lines && settings_write(name, lines, error, sizeof error))
        program_error("%s", error);
    else if (lines)
        viewer_say(v, "wrote %s, for --settings, and to be dropped on a window", name);
    free(lines);
}

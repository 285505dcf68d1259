/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The viewer; see viewer.h. Its steps: take events, take the frame that is due, draw a picture of what has changed or
 * a better one of what has not. */
#define _POSIX_C_SOURCE 200809L
#include "view/viewer/viewer_internal.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- Messages ----------------------------------------------------------------------------------------------- */

static void add_message(viewer *v, const char *text)
{
    pthread_mutex_lock(&v->lock);
    uint32_t same = 0; /* what was said before is not said twice */
    while (same < v->messages && strncmp(v->message[same].text, text, sizeof v->message[same].text - 1) != 0)
        same++;
    v->messages -= same < v->messages;
    for (uint32_t i = same < VIEW_MESSAGES ? same : VIEW_MESSAGES - 1; i > 0; i--)
        v->message[i] = v->message[i - 1];
    snprintf(v->message[0].text, sizeof v->message[0].text, "%s", text);
    v->message[0].until = 0.0;
    v->messages = v->messages < VIEW_MESSAGES ? v->messages + 1 : VIEW_MESSAGES;
    v->is_woken = 1;
    pthread_mutex_unlock(&v->lock);
}

void viewer_say(viewer *v, const char *format, ...)
{
    char text[512];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    add_message(v, text);
}

/* Errors are seen in the window, and go where they always do. */
static int on_error(void *user, const char *text)
{
    viewer *const v = user;
    pthread_mutex_lock(&v->lock);
    const int is_leaving = v->is_leaving;
    pthread_mutex_unlock(&v->lock);
    if (is_leaving)
        return 1;
    add_message(v, text);
    v->wake(v->user, 0);
    return 0;
}

static void on_progress(void *user, const char *text)
{
    viewer *const v = user;
    pthread_mutex_lock(&v->lock);
    snprintf(v->progress, sizeof v->progress, "%s", text);
    pthread_mutex_unlock(&v->lock);
}

/* Messages stay for some seconds; those about a file that cannot be opened for ever. */
static void age_messages(viewer *v)
{
    const double stay = 8.0;
    pthread_mutex_lock(&v->lock);
    for (uint32_t i = 0; i < v->messages; i++)
        if (v->message[i].until == 0.0) {
            v->message[i].until = v->draw || !v->options.render.input_count ? v->now + stay : INFINITY;
            v->changed = 1;
        }
    while (v->messages && v->message[v->messages - 1].until <= v->now) {
        v->messages--;
        v->changed = 1;
    }
    pthread_mutex_unlock(&v->lock);
}

/* ---- Begin and end ------------------------------------------------------------------------------------------ */

void viewer_on_frames(void *user)
{
    viewer *const v = user;
    pthread_mutex_lock(&v->lock);
    v->is_woken = 1;
    pthread_mutex_unlock(&v->lock);
    v->wake(v->user, 0);
}

viewer *viewer_create(const view_options *options, viewer_wake *wake, void *user)
{
    viewer *const v = calloc(1, sizeof *v);
    if (!v)
        return NULL;
    v->options = *options;
    v->created = program_seconds();
    v->wake = wake;
    v->user = user;
    v->shrink = 1;
    v->scale = 1.0f;
    v->rate = options->render.output.rate > 0.0 ? options->render.output.rate : 30.0;
    v->outdated = v->changed = v->is_arriving = v->is_new = 1;
    pthread_mutex_init(&v->lock, NULL);
    pthread_mutex_init(&v->picture_lock, NULL);
    program_set_error_sink(on_error, v);
    program_set_progress_sink(on_progress, v);
    v->opens = options->render.input_count > 0;
    if (viewer_picture_resize(v, options->render.figure.width, options->render.figure.height, 1.0f)) {
        viewer_free(v);
        return NULL;
    }
    return v;
}

void viewer_stop(viewer *v)
{
    v->closing = 1;
    v->stop = 1;
}

void viewer_free(viewer *v)
{
    if (!v)
        return;
    viewer_stop(v);
    viewer_stop_movie(v);
    viewer_watch_movie(v, 1);
    view_draw_stop(v->draw);
    view_frames_release(v->frames, v->shown);
    view_frames_finish(v->frames);
    viewer_forget_settings(v);
    view_draw_close(v->draw);
    program_set_error_sink(NULL, NULL);
    program_set_progress_sink(NULL, NULL);
    viewer_free_options(v);
    viewer_free_selection(v);
    viewer_free_opened(&v->opened);
    for (size_t i = 0; i < v->event_count; i++)
        free(v->events[i].text);
    cgt_text_close(v->font);
    free(v->events);
    free(v->clipboard);
    free(v->rgb);
    free(v->over);
    free(v->pixels);
    pthread_mutex_destroy(&v->lock);
    pthread_mutex_destroy(&v->picture_lock);
    free(v);
}

/* ---- Steps -------------------------------------------------------------------------------------------------- */

void viewer_send(viewer *v, const view_event *event)
{
    pthread_mutex_lock(&v->lock);
    view_event *const last = v->event_count ? &v->events[v->event_count - 1] : NULL;
    const int is_put_on = last && event->kind == VIEW_PUT && event->continues && last->option == event->option;
    if (last && last->kind == event->kind && (event->kind == VIEW_MOVE || event->kind == VIEW_RESIZE || is_put_on)) {
        const int continues = last->continues;
        free(last->text);
        *last = *event; /* where the pointer was is of no use */
        last->continues = continues;
    } else {
        if (v->event_count == v->event_room) {
            view_event *more = realloc(v->events, (2 * v->event_room + 64) * sizeof *more);
            v->event_room = more ? 2 * v->event_room + 64 : v->event_room;
            v->events = more ? more : v->events;
        }
        if (v->events && v->event_count < v->event_room)
            v->events[v->event_count++] = *event;
        else
            free(event->text);
    }
    v->sent = v->sent > 0.0 ? v->sent : program_seconds();
    v->stop = 1;
    pthread_mutex_unlock(&v->lock);
    v->wake(v->user, 0);
}

/* How long events have waited for the picture that is there now. */
static void count_wait(viewer *v, double sent)
{
    const double ms = (program_seconds() - sent) * 1e3;
    if (sent > 0.0) {
        v->waits++;
        v->waited += ms;
        v->longest_wait = fmax(v->longest_wait, ms);
    }
}

/* Returns when the first of them was sent; 0: there was none. */
static double take_events(viewer *v)
{
    view_event *events;
    size_t count;
    pthread_mutex_lock(&v->lock);
    events = v->events;
    count = v->event_count;
    v->events = NULL;
    v->event_count = v->event_room = 0;
    const double sent = v->sent;
    v->sent = 0.0;
    v->stop = v->closing;
    v->changed |= v->is_woken;
    v->is_woken = 0;
    pthread_mutex_unlock(&v->lock);
    for (size_t i = 0; i < count; i++) {
        viewer_handle(v, &events[i]);
        free(events[i].text);
    }
    free(events);
    return sent;
}

/* While playing: the frame after the one that is shown, where it is due; the first after the last. */
static void play(viewer *v)
{
    view_frames_state state;
    if (!v->playing || !v->shown || v->wanted != v->shown->chosen || v->now < v->next_frame)
        return;
    view_frames_get(v->frames, &state);
    uint64_t next = v->wanted + 1;
    if (next >= state.count && state.is_final)
        next = v->options.render.reading.follow > 0.0 ? v->wanted : 0;
    v->next_frame = fmax(v->next_frame + 1.0 / v->rate, v->now - 0.5 / v->rate);
    v->wanted = next;
}

/* Takes the frame that is wanted where it is there, or says that it is none. */
static void take_frame(viewer *v)
{
    view_frames_state state;
    view_frame *const frame = view_frames_take(v->frames, v->wanted);
    if (!frame) {
        view_frames_get(v->frames, &state);
        if (state.is_final && v->wanted >= state.count) {
            if (*state.error)
                program_error("%s", state.error);
            else if (state.count == 0)
                program_error("there is no frame");
            v->wanted = v->shown ? v->shown->chosen : 0;
            v->playing = *state.error ? 0 : v->playing;
            v->scene_is_wrong |= state.count == 0;
            v->changed = 1;
        }
        return;
    }
    const double begin = program_seconds();
    v->scene_is_wrong = viewer_show_frame(v, frame) != 0;
    v->build_cost = 0.8 * v->build_cost + 0.2e3 * (program_seconds() - begin);
    const int is_first = !v->shown;
    view_frames_release(v->frames, v->shown);
    v->shown = frame;
    if (is_first) /* with the columns */
        viewer_publish(v);
    v->is_arriving = v->is_arriving && !figure_run_shows(frame->kept);
    v->wanted += (uint64_t)v->is_arriving;
    v->outdated = 1;
    v->changed = 1;
    v->playing = v->scene_is_wrong ? 0 : v->playing;
    viewer_follow_picks(v);
    viewer_follow_selection(v);
}

double viewer_step(viewer *v, double now)
{
    double wait = INFINITY;
    v->now = now;
    if (v->opens)
        viewer_open_first(v);
    v->opens = 0;
    const double sent = take_events(v);
    if (v->frames && !v->wants_end && !v->closing) {
        play(v);
        if ((!v->shown || v->wanted != v->shown->chosen) && !(v->scene_is_wrong && !v->shown))
            take_frame(v);
        age_messages(v);
        wait = v->shown && !v->scene_is_wrong ? viewer_picture_step(v) : INFINITY;
        if (v->playing && v->shown && v->wanted == v->shown->chosen)
            wait = fmin(wait, fmax(0.0, v->next_frame - v->now));
    } else {
        age_messages(v);
    }
    wait = fmin(wait, viewer_watch_movie(v, 0));
    if (v->changed) {
        viewer_compose(v);
        count_wait(v, sent);
    }
    if (v->messages)
        wait = fmin(wait, 0.5);
    return wait;
}

int viewer_wants_end(const viewer *v) { return v->wants_end; }
int viewer_has_failed(const viewer *v) { return !v->draw && !v->opens && v->options.render.input_count; }

/* ---- Asking ------------------------------------------------------------------------------------------------- */

void viewer_take(viewer *v, view_picture *p)
{
    pthread_mutex_lock(&v->picture_lock);
    const uint32_t band = viewer_band(v->pixels_height);
    *p = (view_picture){
        .width = v->pixels_width, .height = v->pixels_height, .pixels = v->pixels, .number = v->picture_number};
    memcpy(p->title, v->title, sizeof p->title);
    for (uint32_t i = 0; i < VIEW_RECTS && i * band < p->height; i++) {
        const uint32_t from = v->dirty[i][0], to = v->dirty[i][1], rows = p->height - i * band;
        if (from < to)
            p->rects[p->rect_count++] = (view_rect){from, i * band, to - from, rows < band ? rows : band};
    }
    memset(v->dirty, 0, sizeof v->dirty);
}

void viewer_peek(viewer *v, view_picture *p)
{
    pthread_mutex_lock(&v->picture_lock);
    *p = (view_picture){.width = v->pixels_width, .height = v->pixels_height, .number = v->picture_number};
    pthread_mutex_unlock(&v->picture_lock);
}

void viewer_give_back(viewer *v) { pthread_mutex_unlock(&v->picture_lock); }

char *viewer_take_clipboard(viewer *v)
{
    pthread_mutex_lock(&v->lock);
    char *const text = v->clipboard;
    v->clipboard = NULL;
    pthread_mutex_unlock(&v->lock);
    return text;
}

view_request viewer_take_request(viewer *v, uint32_t size[2])
{
    pthread_mutex_lock(&v->lock);
    const view_request request = v->request;
    memcpy(size, v->asked, sizeof v->asked);
    v->request = VIEW_ASKS_NOTHING;
    pthread_mutex_unlock(&v->lock);
    return request;
}

void viewer_describe(const viewer *v, char *text, size_t size)
{
    static const char *const names[] = {"plain", "shadows", "full"};
    char lines[4][128], *const color = v->shown ? view_draw_get(v->draw, cgt_figure_get_chosen, "color") : NULL;
    if (!color) {
        snprintf(text, size, "no frame");
        return;
    }
    const int length =
        snprintf(text, size,
                 "frame %llu, %s, 1/%u, color %s, eye %.9g,%.9g,%.9g, %llu pictures, at %.3f s, %.3f s of CPU, "
                 "event to picture %.1f ms, longest %.1f ms",
                 (unsigned long long)v->shown->frame.number,
                 v->quality == VIEW_FULL && !v->is_full ? "grows" : names[v->quality], v->shrink, strtok(color, "\n"),
                 (double)v->camera.eye[0], (double)v->camera.eye[1], (double)v->camera.eye[2],
                 (unsigned long long)v->drawn, program_seconds() - v->created, (double)clock() / CLOCKS_PER_SEC,
                 v->waits ? v->waited / (double)v->waits : 0.0, v->longest_wait);
    free(color);
    if (v->picks && viewer_pick_lines(v, lines, 1) && length > 0 && (size_t)length < size)
        snprintf(text + length, size - (size_t)length, ", selected %s", lines[0]);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Options of the viewer's figure: whatever control changes one comes here, what was there before can be had back, and
 * panels of other threads read copies. */
#define _POSIX_C_SOURCE 200809L
#include "options/numbers.h"
#include "view/viewer/viewer_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int viewer_show_frame(viewer *v, view_frame *frame)
{
    cgt_figure *const figure = v->draw->figure;
    return view_draw_tell(v->draw, cgt_figure_set_camera(figure, &v->camera)) ||
                   view_draw_tell(v->draw, cgt_figure_show_frame(figure, frame->kept))
               ? -1
               : 0;
}

/* ---- One value ---------------------------------------------------------------------------------------------- */

/* An option of the camera takes the place of the hand's. */
static void follow_camera(viewer *v, const cgt_camera *before)
{
    cgt_camera now;
    if (cgt_figure_get_camera(v->draw->figure, &now) || memcmp(&now, before, sizeof now) == 0)
        return;
    now.projection = CGT_PROJECTION_PERSPECTIVE;
    v->camera = now;
    view_camera_straighten(&v->camera);
    memcpy(v->pivot, v->camera.target, sizeof v->pivot);
}

/* The sentence of a call of the figure that failed. */
static int check(viewer *v, cgt_result result, char *why, size_t size)
{
    if (result)
        cgt_figure_get_error_message(v->draw->figure, why, size);
    return result ? -1 : 0;
}

static int change(viewer *v, const char *name, const char *value, int is_set, char *why, size_t size)
{
    cgt_figure *const figure = v->draw->figure;
    const char *const not_here = view_options_why_not(name);
    cgt_camera before;
    if (not_here) {
        snprintf(why, size, "%s: %s", name, not_here);
        return -1;
    }
    if (v->shown && v->wanted != v->shown->chosen && view_draw_has(v->draw, "trails")) { /* the reader moves them on */
        snprintf(why, size, "%s: a frame with trails is being read: try again", name);
        return 1;
    }
    if (check(v, cgt_figure_set_camera(figure, &v->camera), why, size))
        return -1;
    cgt_figure_get_camera(figure, &before);
    if (check(v, is_set ? cgt_figure_set(figure, name, value) : cgt_figure_unset(figure, name), why, size))
        return -1;
    follow_camera(v, &before);
    cgt_figure_get_up(figure, v->axis);
    if (v->scene_is_wrong && v->shown)
        v->scene_is_wrong = viewer_show_frame(v, v->shown) != 0;
    v->moved = v->now;
    v->outdated = v->changed = 1;
    return 0;
}

/* ---- All values of a name ----------------------------------------------------------------------------------- */

/* The index of an option; UINT32_MAX: there is none. */
static uint32_t find_option(const char *name, cgt_figure_option *option)
{
    for (uint32_t i = 0; cgt_figure_get_option(i, option); i++)
        if (strcmp(name, option->name) == 0)
            return i;
    return UINT32_MAX;
}

/* Lines as cgt_figure_get has them; "\n": set without a value; "": not set. What is refused may leave some of
 * several. */
static int set_lines(viewer *v, const cgt_figure_option *o, const char *lines, char *why, size_t size)
{
    const size_t first = strcspn(lines, "\n");
    if (!o->repeats && lines[first] && lines[first + 1]) {
        snprintf(why, size, "%s: the option takes one value", o->name);
        return -1;
    }
    int failed = !lines[0] || o->repeats ? change(v, o->name, NULL, 0, why, size) : 0;
    for (const char *line = lines; *line && !failed;) {
        const size_t length = strcspn(line, "\n");
        char *const value = strndup(line, length);
        if (!value)
            snprintf(why, size, "out of memory for options");
        failed = value ? change(v, o->name, length ? value : NULL, 1, why, size) : -1;
        free(value);
        line += length + (line[length] == '\n');
    }
    return failed;
}

/* Frames that are kept are of such an option: they are read anew. So they are where bonds are to be guessed, or sites
 * to be shown, that were left out so far. */
static int is_of_reading(const viewer *v, const char *name, const char *lines)
{
    const cgt_trajectory_options *const r = &v->draw->options.reading;
    int is_one = cgt_figure_option_is_of_frames(name);
    is_one |= strcmp(name, "bonds") == 0 && *lines && !r->all_bonds;
    is_one |= strcmp(name, "show") == 0 && strstr(lines, "site") && r->leave_out_sites;
    return is_one;
}

/* Keeps what was there before, but of the steps of one movement of a slider only the first. */
void viewer_remember(viewer *v, view_change next, int continues)
{
    const uint32_t count = v->change_count;
    if (!next.before || (continues && count && v->change[count - 1].option == next.option)) {
        free(next.before);
        return;
    }
    if (v->change_count == VIEW_CHANGES) {
        free(v->change[0].before);
        memmove(v->change, v->change + 1, (VIEW_CHANGES - 1) * sizeof *v->change);
        v->change_count--;
    }
    next.event = v->event;
    v->change[v->change_count++] = next;
}

/* The picture has the window's size, which follows. */
static int ask_size(viewer *v, const char *lines, char *why, size_t size)
{
    char text[64];
    uint32_t width, height;
    snprintf(text, sizeof text, "%.*s", (int)strcspn(lines, "\n"), lines);
    if (cgt_read_size(text, &width, &height, why, size))
        return -1;
    pthread_mutex_lock(&v->lock);
    v->request = VIEW_ASKS_SIZE;
    v->asked[0] = width;
    v->asked[1] = height;
    pthread_mutex_unlock(&v->lock);
    v->changed = 1; /* the window looks for it when a picture comes */
    return 0;
}

int viewer_put(viewer *v, const char *name, const char *lines, view_put how, char *why, size_t size)
{
    cgt_figure_option o;
    const uint32_t option = find_option(name, &o);
    char *const before = view_draw_get(v->draw, cgt_figure_get, name);
    why[0] = '\0';
    if (option == UINT32_MAX)
        snprintf(why, size, "there is no option \"%.80s\"", name);
    if (option == UINT32_MAX || !before || strcmp(before, lines) == 0) {
        free(before);
        return option == UINT32_MAX || !before ? -1 : 0;
    }
    if (strcmp(name, "size") == 0) {
        free(before);
        return ask_size(v, lines, why, size);
    }
    const int reads = v->shown && is_of_reading(v, name, lines);
    const int failed = reads ? viewer_read_by(v, name, lines) : set_lines(v, &o, lines, why, size);
    if (failed && reads) {
        pthread_mutex_lock(&v->lock);
        snprintf(why, size, "%s", v->messages ? v->message[0].text : "");
        pthread_mutex_unlock(&v->lock);
    } else if (failed && o.repeats) {
        char ignored[VIEW_SENTENCE];
        set_lines(v, &o, before, ignored, sizeof ignored);
    }
    if (failed || how == VIEW_PUT_BACK)
        free(before);
    else
        viewer_remember(v, (view_change){.option = option, .before = before}, how == VIEW_PUT_ON);
    if (failed)
        return failed;
    view_draw_tell(v->draw, CGT_OK); /* what it notices */
    viewer_publish(v);
    return 0;
}

int viewer_set_lines(viewer *v, const char *name, const char *lines)
{
    char why[VIEW_SENTENCE];
    const int failed = !lines || viewer_put(v, name, lines, VIEW_PUT_NEW, why, sizeof why);
    if (failed)
        program_error("%s", lines ? why : "out of memory");
    return failed ? -1 : 0;
}

int viewer_set(viewer *v, const char *name, const char *value)
{
    cgt_figure_option o;
    const uint32_t option = find_option(name, &o);
    char *const before = view_draw_get(v->draw, cgt_figure_get, name);
    const size_t kept = before && option != UINT32_MAX && o.repeats ? strlen(before) : 0;
    const size_t room = kept + (value ? strlen(value) : 0) + 2;
    char *const lines = before ? malloc(room) : NULL;
    if (lines)
        snprintf(lines, room, "%.*s%s\n", (int)kept, before, value ? value : "");
    const int result = viewer_set_lines(v, name, lines);
    free(before);
    free(lines);
    return result;
}

int viewer_unset(viewer *v, const char *name) { return viewer_set_lines(v, name, ""); }

/* Returns as viewer_put. */
static int put_back(viewer *v, const view_change *c)
{
    char why[VIEW_SENTENCE] = "";
    cgt_figure_option o = {.name = "settings"};
    const int failed = cgt_figure_get_option(c->option, &o)
                           ? viewer_put(v, o.name, c->before, VIEW_PUT_BACK, why, sizeof why)
                           : viewer_unload_settings(v, c);
    if (!failed)
        viewer_say(v, "%s: as before", o.name);
    else if (why[0])
        program_error("%s", why);
    return failed;
}

void viewer_undo(viewer *v)
{
    if (!v->change_count) {
        viewer_say(v, "there is nothing to undo");
        return;
    }
    const uint64_t event = v->change[v->change_count - 1].event;
    int failed = 0;
    while (failed <= 0 && v->draw && v->change_count && v->change[v->change_count - 1].event == event) {
        view_change *const last = &v->change[v->change_count - 1];
        failed = put_back(v, last);
        if (failed <= 0) { /* else the next undo tries again */
            free(last->before);
            v->change_count--;
        }
    }
}

/* ---- For other threads -------------------------------------------------------------------------------------- */

static void take_text(char **to, char *text)
{
    free(*to);
    *to = text;
}

/* Names of the columns that formulas may use, a line each. */
static char *column_names(const viewer *v)
{
    const cgt_trajectory_frame *const f = &v->shown->frame;
    size_t room = 1, used = 0;
    for (uint32_t i = 0; i < f->columns; i++)
        room += strlen(f->column[i].name) + 1;
    char *const text = calloc(1, room);
    for (uint32_t i = 0; text && i < f->columns; i++)
        used += (size_t)snprintf(text + used, room - used, "%s\n", f->column[i].name);
    return text;
}

void viewer_publish(viewer *v)
{
    cgt_figure_option o;
    char *values[OPTIONS_MOST], *const columns = v->shown ? column_names(v) : NULL;
    uint32_t count = 0;
    for (; count < OPTIONS_MOST && cgt_figure_get_option(count, &o); count++)
        values[count] = view_draw_get(v->draw, cgt_figure_get, o.name);
    pthread_mutex_lock(&v->lock);
    for (uint32_t i = 0; i < count; i++)
        take_text(&v->option[i].values, values[i]);
    take_text(&v->columns, columns);
    v->options_version++;
    pthread_mutex_unlock(&v->lock);
}

void viewer_take_put(viewer *v, const view_event *e)
{
    char why[VIEW_SENTENCE];
    cgt_figure_option o;
    if (e->option < OPTIONS_MOST && cgt_figure_get_option(e->option, &o)) {
        const int failed = viewer_put(v, o.name, e->text, e->continues ? VIEW_PUT_ON : VIEW_PUT_NEW, why, sizeof why);
        pthread_mutex_lock(&v->lock);
        take_text(&v->option[e->option].refused, failed ? strdup(why) : NULL);
        v->options_version++;
        pthread_mutex_unlock(&v->lock);
    }
}

uint64_t viewer_options_version(viewer *v)
{
    pthread_mutex_lock(&v->lock);
    const uint64_t version = v->options_version;
    pthread_mutex_unlock(&v->lock);
    return version;
}

static char *copy(const char *text) { return strdup(text ? text : ""); }

void viewer_copy_option(viewer *v, uint32_t index, char **values, char **refused)
{
    pthread_mutex_lock(&v->lock);
    *values = copy(index < OPTIONS_MOST ? v->option[index].values : NULL);
    *refused = copy(index < OPTIONS_MOST ? v->option[index].refused : NULL);
    pthread_mutex_unlock(&v->lock);
}

char *viewer_copy_columns(viewer *v)
{
    pthread_mutex_lock(&v->lock);
    char *const text = copy(v->columns);
    pthread_mutex_unlock(&v->lock);
    return text;
}

void viewer_free_options(viewer *v)
{
    for (uint32_t i = 0; i < OPTIONS_MOST; i++) {
        free(v->option[i].values);
        free(v->option[i].refused);
    }
    for (uint32_t i = 0; i < v->change_count; i++)
        free(v->change[i].before);
    free(v->columns);
}

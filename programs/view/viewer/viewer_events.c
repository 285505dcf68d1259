/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Events of the viewer: what hand and keys change. */
#define _POSIX_C_SOURCE 200809L
#include "view/viewer/viewer_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/settings_file.h"

static void camera_moved(viewer *v)
{
    v->moved = v->now;
    v->outdated = 1;
}

static float aspect_of(const viewer *v) { return (float)v->width / (float)v->height; }

/* The pixel of a place in the picture; 0 where it is outside. */
static int pixel_of(const viewer *v, float x, float y, uint32_t pixel[2])
{
    if (!(x >= 0.0f && y >= 0.0f && x < (float)v->width && y < (float)v->height))
        return 0;
    pixel[0] = (uint32_t)x;
    pixel[1] = (uint32_t)y;
    return 1;
}

/* What lies under the pointer: the exact hit, else the place as far off as the target. Returns whether there is a
 * hit. */
static int place_under(viewer *v, float x, float y, float place[3])
{
    uint32_t pixel[2];
    cgt_figure_hit hit;
    if (v->shown && !v->scene_is_wrong && pixel_of(v, x, y, pixel) &&
        cgt_figure_set_camera(v->draw->figure, &v->camera) == CGT_OK &&
        cgt_figure_pick(v->draw->figure, pixel[0], pixel[1], &hit) == CGT_OK && hit.is_hit) {
        memcpy(place, hit.place, sizeof hit.place);
        return 1;
    }
    view_camera_place(&v->camera, aspect_of(v), x / (float)v->width, y / (float)v->height, place);
    return 0;
}

void viewer_move_to(viewer *v, uint64_t frame)
{
    view_frames_state state;
    view_frames_get(v->frames, &state);
    if (state.is_final && state.count && frame >= state.count)
        frame = state.count - 1;
    v->wanted = frame;
    v->is_arriving = 0;
    v->moved = v->now;
    v->changed = 1;
}

/* ---- The panel ---------------------------------------------------------------------------------------------- */

static void ask(viewer *v, view_request request)
{
    pthread_mutex_lock(&v->lock);
    v->request = request;
    pthread_mutex_unlock(&v->lock);
    v->changed = 1; /* the window looks for it when a picture comes */
}

static void ask_panel(viewer *v)
{
    if (v->panel == VIEW_PANEL_ABSENT)
        viewer_say(v, "this build has no panel of options: it needs Dear ImGui");
    else
        ask(v, VIEW_ASKS_PANEL);
}

/* ---- The hand ----------------------------------------------------------------------------------------------- */

/* To where the pointer is along the bar. */
static void move_along_bar(viewer *v, double share)
{
    view_frames_state state;
    view_frames_get(v->frames, &state);
    viewer_move_to(v, state.count ? (uint64_t)(share * (double)(state.count - 1) + 0.5) : 0);
}

static void press(viewer *v, const view_event *e)
{
    double share;
    const int row = viewer_list_row(v, e->x, e->y);
    v->pressed_x = v->x = e->x;
    v->pressed_y = v->y = e->y;
    v->dragged = 0;
    if (e->button == 1 && viewer_button_at(v, e->x, e->y)) {
        ask_panel(v);
        return;
    }
    if (e->button == 1 && row >= 0) {
        viewer_take_list(v, row);
        return;
    }
    if (e->button == 1 && viewer_bar_at(v, e->x, e->y, &share)) {
        v->drag = DRAG_BAR;
        move_along_bar(v, share);
        return;
    }
    if (e->button == 1 && e->clicks == 2) {
        float place[3];
        if (place_under(v, e->x, e->y, place)) {
            memcpy(v->pivot, place, sizeof v->pivot);
            view_camera_target(&v->camera, place, view_draw_has(v->draw, "ortho"));
            viewer_say(v, "turns about the point under the pointer; f: about the middle");
            camera_moved(v);
        }
        v->drag = DRAG_NONE;
        return;
    }
    v->drag = e->button == 1 ? DRAG_TURN : DRAG_PAN;
}

static void move(viewer *v, const view_event *e)
{
    const float dx = e->x - v->x, dy = e->y - v->y, slack = 3.0f * v->scale;
    double share;
    if (v->drag == DRAG_NONE)
        return;
    if (!v->dragged && fabsf(e->x - v->pressed_x) < slack && fabsf(e->y - v->pressed_y) < slack)
        return; /* a click of a hand that trembles */
    v->dragged = 1;
    v->x = e->x;
    v->y = e->y;
    if (v->drag == DRAG_BAR) {
        viewer_bar_at(v, e->x, v->pressed_y, &share);
        move_along_bar(v, share);
        return;
    }
    const float turn = 4.0f / (float)v->height; /* over the picture's height */
    if (v->drag == DRAG_TURN)
        view_camera_turn(&v->camera, v->pivot, v->axis, dx * turn, dy * turn);
    else
        view_camera_pan(&v->camera, dx, -dy, v->height);
    camera_moved(v);
}

static void release(viewer *v, const view_event *e)
{
    if (v->drag == DRAG_TURN && !v->dragged && e->button == 1)
        viewer_click(v, e->x, e->y);
    v->drag = DRAG_NONE;
    v->changed = 1;
}

static void zoom(viewer *v, const view_event *e)
{
    float place[3];
    const float turns = fmaxf(-10.0f, fminf(e->turns, 10.0f));
    place_under(v, e->x, e->y, place);
    view_camera_zoom(&v->camera, place, powf(0.88f, turns));
    camera_moved(v);
}

/* ---- Keys --------------------------------------------------------------------------------------------------- */

static void look_along(viewer *v, int axis, int from_below)
{
    float direction[3] = {0.0f}, up[3];
    const int is_up = v->axis[axis] != 0.0f;
    memcpy(up, v->axis, sizeof up);
    direction[axis] = from_below ? -1.0f : 1.0f;
    if (is_up) { /* from above: what lay behind is at the top */
        memset(up, 0, sizeof up);
        up[axis == 2 ? 1 : 2] = axis == 2 ? 1.0f : -1.0f;
    }
    view_camera_look(&v->camera, direction, up);
    memcpy(v->pivot, v->camera.target, sizeof v->pivot);
    camera_moved(v);
}

/* As the option view has it. */
static void look_from(viewer *v, const char *side)
{
    static const char *const sides[] = {"front", "back", "right", "left", "top", "bottom"};
    const int up = v->axis[1] != 0.0f ? 1 : v->axis[0] != 0.0f ? 0 : 2, front = up == 1 ? 2 : 1, right = 3 - up - front;
    const int axes[] = {front, front, right, right, up, up}, front_is_below = up == 2;
    for (int i = 0; i < 6; i++)
        if (strcmp(side, sides[i]) == 0)
            look_along(v, axes[i], (i & 1) ^ (i < 2 && front_is_below));
}

static void fit(viewer *v)
{
    cgt_figure *const figure = v->draw->figure;
    if (!v->shown || v->scene_is_wrong || view_draw_tell(v->draw, cgt_figure_set_camera(figure, &v->camera)) ||
        view_draw_tell(v->draw, cgt_figure_fit(figure)))
        return;
    cgt_figure_get_camera(figure, &v->camera);
    memcpy(v->pivot, v->camera.target, sizeof v->pivot);
    camera_moved(v);
}

static void step(viewer *v, int64_t frames)
{
    const uint64_t back = (uint64_t)(frames < 0 ? -frames : 0);
    v->playing = 0;
    viewer_move_to(v, frames < 0 ? (v->wanted > back ? v->wanted - back : 0) : v->wanted + (uint64_t)frames);
}

static void change_rate(viewer *v, double factor)
{
    v->rate = fmin(1000.0, fmax(0.1, v->rate * factor));
    viewer_say(v, "%.3g frames a second", v->rate);
}

static void set_playing(viewer *v, int playing)
{
    v->playing = playing;
    v->next_frame = v->now;
    v->moved = v->now;
    v->changed = 1;
}

/* Keys of the list of colours; returns whether it was one. */
static int list_key(viewer *v, int key)
{
    if (!v->list)
        return 0;
    const int last = (int)v->list_count - 1;
    switch (key) {
    case VIEW_KEY_UP: v->list_at = v->list_at > 0 ? v->list_at - 1 : last; return 1;
    case VIEW_KEY_DOWN: v->list_at = v->list_at < last ? v->list_at + 1 : 0; return 1;
    case VIEW_KEY_ENTER: viewer_take_list(v, v->list_at); return 1;
    default: return 0;
    }
}

static void escape(viewer *v)
{
    if (v->help || v->list)
        v->help = v->list = 0;
    else
        v->picks = 0;
}

static void time_key(viewer *v, int key, int shift)
{
    view_frames_state state;
    view_frames_get(v->frames, &state);
    const int64_t tenth = (int64_t)(state.count / 10 + 1);
    switch (key) {
    case ' ': set_playing(v, !v->playing); break;
    case VIEW_KEY_LEFT: step(v, shift ? -10 : -1); break;
    case VIEW_KEY_RIGHT: step(v, shift ? 10 : 1); break;
    case VIEW_KEY_PAGE_UP: step(v, -tenth); break;
    case VIEW_KEY_PAGE_DOWN: step(v, tenth); break;
    case VIEW_KEY_HOME: viewer_move_to(v, 0); break;
    case VIEW_KEY_END: viewer_move_to(v, state.count ? state.count - 1 : 0); break;
    case '+':
    case '=': change_rate(v, 1.5); break;
    case '-': change_rate(v, 1.0 / 1.5); break;
    default: break;
    }
}

static void key(viewer *v, int key, int shift, int control)
{
    v->changed = 1;
    if (control) {
        if (key == 'z')
            viewer_undo(v);
        else if (key == 'o')
            ask(v, VIEW_ASKS_FILE);
        else if (key == 's')
            viewer_save_settings(v);
        return;
    }
    if (list_key(v, key))
        return;
    switch (key) {
    case 'q': v->wants_end = 1; break;
    case 'h': v->help = !v->help; break;
    case VIEW_KEY_ESCAPE: escape(v); break;
    case 'f': fit(v); break;
    case 'x':
    case 'y':
    case 'z': look_along(v, key - 'x', shift); break;
    case 'o': ask_panel(v); break;
    case 'u': viewer_undo(v); break;
    case 'r': viewer_read_anew(v); break;
    case 'p': view_draw_has(v->draw, "ortho") ? viewer_unset(v, "ortho") : viewer_set(v, "ortho", NULL); break;
    case 'l': viewer_open_list(v); break;
    case 'd':
    case VIEW_KEY_DELETE: viewer_hide(v, shift, 0); break;
    case 'i': viewer_hide(v, 1, 1); break;
    case 'a': viewer_show_all(v); break;
    case 's': viewer_write_picture(v); break;
    case 'k': viewer_add_key(v); break;
    case 'm': viewer_start_movie(v, shift ? 360.0f : 0.0f); break;
    case 'c': shift ? viewer_copy_command(v) : viewer_copy_camera(v); break;
    default: time_key(v, key, shift); break;
    }
}

static int is_of_settings(const char *line)
{
    static const char ending[] = ".settings";
    const size_t length = strcspn(line, "\n"), end = sizeof ending - 1;
    return length > end && strncmp(line + length - end, ending, end) == 0;
}

/* Settings are for the files that come with them, else for those that are shown. */
static void open_files(viewer *v, const char *paths)
{
    char *const line = calloc(strlen(paths) + 2, 1), *const others = calloc(strlen(paths) + 2, 1);
    size_t used = 0;
    if (!line || !others)
        program_error("out of memory");
    for (const char *c = paths; others && *c; c = settings_next_line(c))
        if (!is_of_settings(c))
            used += (size_t)sprintf(others + used, "%.*s\n", (int)strcspn(c, "\n"), c);
    const int failed = !line || !others || viewer_open(v, others);
    for (const char *c = paths; !failed && *c; c = settings_next_line(c))
        if (is_of_settings(c)) {
            sprintf(line, "%.*s", (int)strcspn(c, "\n"), c);
            viewer_load_settings(v, line);
        }
    free(line);
    free(others);
    v->changed = 1;
}

void viewer_handle(viewer *v, const view_event *e)
{
    v->event++;
    if (e->kind == VIEW_RESIZE) {
        if (viewer_picture_resize(v, e->width, e->height, e->scale))
            v->wants_end = 1;
        return;
    }
    if (e->kind == VIEW_PANEL) {
        v->panel = e->panel;
        v->changed = 1;
        return;
    }
    if (e->kind == VIEW_OPEN) {
        open_files(v, e->text);
        return;
    }
    if (!v->draw) { /* there is a message to read, or a file to be named */
        if (e->kind == VIEW_KEY && e->control && e->key == 'o')
            ask(v, VIEW_ASKS_FILE);
        v->wants_end |= e->kind == VIEW_KEY && (e->key == 'q' || e->key == VIEW_KEY_ESCAPE);
        return;
    }
    v->is_new &= e->kind != VIEW_PRESS && e->kind != VIEW_WHEEL && e->kind != VIEW_KEY;
    switch (e->kind) {
    case VIEW_PRESS: press(v, e); break;
    case VIEW_MOVE: move(v, e); break;
    case VIEW_RELEASE: release(v, e); break;
    case VIEW_WHEEL: zoom(v, e); break;
    case VIEW_KEY: key(v, e->key, e->shift, e->control); break;
    case VIEW_PUT: viewer_take_put(v, e); break;
    case VIEW_LOOK: look_from(v, e->text); break;
    case VIEW_SELECT: e->text ? viewer_select(v, e->text) : viewer_select_picks(v); break;
    case VIEW_USE: viewer_use_selection(v, e->text); break;
    case VIEW_COPY: strcmp(e->text, "python") == 0 ? viewer_copy_python(v) : viewer_copy_command(v); break;
    case VIEW_RESIZE:
    case VIEW_OPEN:
    case VIEW_PANEL: break;
    }
}

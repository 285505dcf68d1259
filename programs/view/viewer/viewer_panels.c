/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What lies over the viewer's picture: the line of status, the bar of time, what is selected, lists, help, messages. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "options/numbers.h"
#include "view/viewer/viewer_internal.h"

static const float white[3] = {0.85f, 0.85f, 0.85f}, dim[3] = {0.3f, 0.3f, 0.3f}, accent[3] = {1.0f, 0.45f, 0.05f};

enum { PANEL_LINES = 64 };

static canvas canvas_of(viewer *v) { return (canvas){v->width, v->height, {.bytes = v->over}}; }
static float line_height(const viewer *v) { return 18.0f * v->scale; }

/* Darkens a rectangle, so that text on it can be read over any picture. */
static void shade(viewer *v, float x, float y, float width, float height)
{
    const uint32_t from = (uint32_t)fmaxf(0.0f, x), top = (uint32_t)fmaxf(0.0f, y);
    const float right = fminf(x + width, (float)v->width), bottom = fminf(y + height, (float)v->height);
    for (uint32_t j = top; (float)j < bottom; j++)
        for (uint32_t i = from; (float)i < right; i++) {
            uint8_t *const p = v->over + 3 * ((size_t)j * v->width + i);
            for (int c = 0; c < 3; c++)
                p[c] = (uint8_t)(p[c] / 5 + 10);
        }
}

static void write_at(viewer *v, float x, float y, const char *text, const float color[3])
{
    const canvas c = canvas_of(v);
    if (v->font)
        cgt_text_draw(v->font, &c, x, y, text, color);
}

/* Lines on a dark ground, from a corner; right: the corner is at the right. Returns the width. */
static float panel(viewer *v, float x, float y, int right, const char lines[][128], uint32_t count, int marked)
{
    float width = 0.0f;
    const float pad = 8.0f * v->scale, line = line_height(v);
    for (uint32_t i = 0; i < count && v->font; i++)
        width = fmaxf(width, cgt_text_width(v->font, lines[i]));
    width += 2.0f * pad;
    const float left = right ? x - width : x;
    shade(v, left, y, width, (float)count * line + pad);
    for (uint32_t i = 0; i < count; i++)
        write_at(v, left + pad, y + pad * 0.5f + ((float)i + 0.75f) * line, lines[i],
                 (int)i == marked ? accent : white);
    return width;
}

/* ---- Time --------------------------------------------------------------------------------------------------- */

static float bar_top(const viewer *v) { return (float)v->height - 22.0f * v->scale; }

int viewer_bar_at(const viewer *v, float x, float y, double *share)
{
    const float pad = 12.0f * v->scale, width = fmaxf(1.0f, (float)v->width - 2.0f * pad);
    *share = fmin(1.0, fmax(0.0, (double)((x - pad) / width)));
    view_frames_state state = {0};
    if (v->frames)
        view_frames_get(v->frames, &state);
    return state.count > 1 && y >= bar_top(v);
}

static void draw_bar(viewer *v, const view_frames_state *s)
{
    const canvas c = canvas_of(v);
    const float pad = 12.0f * v->scale, width = (float)v->width - 2.0f * pad, y = (float)v->height - 11.0f * v->scale;
    if (s->count < 2 || width < 8.0f)
        return;
    shade(v, 0.0f, bar_top(v), (float)v->width, 22.0f * v->scale);
    cgt_canvas_fill(&c, pad, y - 1.5f * v->scale, width, 3.0f * v->scale, dim);
    /* what is in memory */
    for (uint32_t x = 0; x < (uint32_t)width; x += 2)
        if (view_frames_has(v->frames, (uint64_t)((double)x / (double)width * (double)(s->count - 1) + 0.5)))
            cgt_canvas_fill(&c, pad + (float)x, y - 1.5f * v->scale, 2.0f, 3.0f * v->scale, white);
    const float at = pad + width * (float)((double)v->wanted / (double)(s->count - 1));
    const float place[2] = {fminf(at, pad + width), y};
    cgt_canvas_line(&c, place, place, 11.0f * v->scale, accent);
}

/* Above the bar. */
static void draw_line(viewer *v, const view_frames_state *s, const char line[][128])
{
    panel(v, 6.0f * v->scale, (s->count > 1 ? bar_top(v) : (float)v->height) - 32.0f * v->scale, 0, line, 1, -1);
}

/* How far the opening of other files is. */
static void draw_opening(viewer *v, const view_frames_state *s)
{
    char line[1][128];
    pthread_mutex_lock(&v->lock);
    snprintf(line[0], sizeof line[0], "%.90s   Escape: end", v->progress[0] ? v->progress : "reading");
    pthread_mutex_unlock(&v->lock);
    draw_line(v, s, (const char(*)[128])line);
}

static void draw_status(viewer *v, const view_frames_state *s)
{
    char line[1][128], time[48] = "", state[48] = "";
    const cgt_trajectory_frame *const f = v->shown ? &v->shown->frame : NULL;
    if (!f) {
        snprintf(line[0], sizeof line[0], "reading");
    } else {
        if (isfinite(f->time))
            snprintf(time, sizeof time, "  t = %s", cgt_number_shortest(f->time).text);
        else if (f->step != (int64_t)f->number)
            snprintf(time, sizeof time, "  step %lld", (long long)f->step);
        if (v->wanted != v->shown->chosen)
            snprintf(state, sizeof state, "  reading %llu", (unsigned long long)viewer_number(v, v->wanted));
        else if (v->shrink > 1)
            snprintf(state, sizeof state, "  at 1/%u size, to keep up", v->shrink);
        else if (f->count == 0)
            snprintf(state, sizeof state, "  empty");
        else if (!v->playing && !v->is_full && v->now - v->moved > 0.1)
            snprintf(state, sizeof state, "  grows");
        if (v->frame_ms > 0.0 && viewer_is_moving(v) && *state == '\0')
            snprintf(state, sizeof state, "  %.0f pictures/s", 1e3 / v->frame_ms);
        if (v->movie.is_made)
            snprintf(state, sizeof state, "  movie: %llu frames", (unsigned long long)v->movie.frames);
        const uint64_t end = s->count ? viewer_number(v, s->count - 1) + 1 : 0; /* of the file's numbers */
        char text[256];
        snprintf(text, sizeof text, "%s %llu of %llu%s%s%s   %sh: help", v->playing ? "playing" : "frame",
                 (unsigned long long)f->number, (unsigned long long)end, s->is_final ? "" : "+", time, state,
                 !v->is_new ? ""
                 : v->panel ? "drag: turn   click: ask   o: options   "
                            : "drag: turn   click: ask   ");
        snprintf(line[0], sizeof line[0], "%.127s", text);
    }
    draw_line(v, s, (const char(*)[128])line);
}

/* ---- The button of the panel of options ----------------------------------------------------------------------- */

static const char button_text[][128] = {"options: o"};

/* From the top at the right: where there is a panel, and it is closed. */
int viewer_button_at(const viewer *v, float x, float y)
{
    return v->panel == VIEW_PANEL_CLOSED && v->font && !v->list &&
           y < 12.0f * v->scale + line_height(v) + 8.0f * v->scale &&
           x >= (float)v->width - 28.0f * v->scale - cgt_text_width(v->font, button_text[0]);
}

/* ---- Panels ------------------------------------------------------------------------------------------------- */

static const char help_lines[][128] = {
    "drag: turn       right or middle button: pan       wheel: zoom to the pointer",
    "double click: turn about that point       f: fit       x y z: along an axis (Shift: from behind)",
    "p: perspective or parallel       o: options       u: undo",
    "",
    "space: play, pause       left, right: a frame (Shift: ten)       Page up, down: a tenth",
    "Home, End       + -: faster, slower       the bar below: drag",
    "",
    "click: what is this?  The second tells the distance, the third the angle; Escape ends it",
    "d: hide it (Shift: its kind)       i: show its kind alone       a: show all",
    "l: colour by ...",
    "",
    "s: write the picture, and print the command line that makes it",
    "k: add a key frame for --camera-keys       c: copy the camera (Shift: the command line)",
    "m: make a movie of all frames (Shift: that turns once), or end it",
    "Ctrl+O: open a file, or drop it here       r: read it anew       Ctrl+S: save the settings",
    "h: this help       q: end",
};

/* Without a file, or with one that cannot be opened. */
static const char empty_lines[][128] = {"Drop a file here", "or press Ctrl+O to choose one.       q: end"};

/* The first of the list's rows that are seen, and how many fit. */
static int first_row(const viewer *v, int *rows)
{
    const float room = ((float)v->height - 80.0f * v->scale) / line_height(v);
    *rows = (int)fmaxf(1.0f, fminf(room, (float)PANEL_LINES));
    return v->list_at >= *rows ? v->list_at - *rows + 1 : 0;
}

int viewer_list_row(const viewer *v, float x, float y)
{
    const float line = line_height(v), top = 12.0f * v->scale, pad = 8.0f * v->scale;
    int rows;
    const int first = first_row(v, &rows);
    const float place = floorf((y - top - pad * 0.5f) / line);
    if (!v->list || x < (float)v->width - 260.0f * v->scale || !(place >= 0.0f && place < (float)rows))
        return -1;
    const int row = (int)place;
    return first + row < (int)v->list_count ? first + row : -1;
}

static void draw_list(viewer *v)
{
    char lines[PANEL_LINES][128];
    int rows;
    const int first = first_row(v, &rows);
    uint32_t count = 0;
    for (int i = first; i < (int)v->list_count && (int)count < rows; i++)
        snprintf(lines[count++], sizeof lines[0], "%s", v->list_names[i]);
    panel(v, (float)v->width - 12.0f * v->scale, 12.0f * v->scale, 1, (const char(*)[128])lines, count,
          v->list_at - first);
}

static void draw_messages(viewer *v)
{
    const float line = line_height(v);
    char lines[VIEW_MESSAGES][128];
    pthread_mutex_lock(&v->lock);
    uint32_t count = 0;
    for (uint32_t i = v->messages; i-- > 0;) {
        const char *text = v->message[i].text;
        for (int part = 0; part < 4 && *text && count < VIEW_MESSAGES; part++) { /* in lines of 100 characters */
            size_t length = strlen(text);
            if (length > 100) {
                length = 100;
                while (length > 40 && text[length] != ' ')
                    length--;
            }
            snprintf(lines[count++], sizeof lines[0], "%.*s", (int)length, text);
            text += length + (text[length] == ' ');
        }
    }
    pthread_mutex_unlock(&v->lock);
    if (count)
        panel(v, 6.0f * v->scale, (float)v->height - 66.0f * v->scale - (float)count * line, 0,
              (const char(*)[128])lines, count, -1);
}

/* A ring around each that is selected, and lines between them. */
static void draw_picks(viewer *v)
{
    const canvas c = canvas_of(v);
    const float aspect = (float)v->width / (float)v->height;
    const int is_parallel = view_draw_has(v->draw, "ortho");
    float at[VIEW_PICKS][2];
    int seen[VIEW_PICKS] = {0};
    for (uint32_t i = 0; i < v->picks; i++) {
        if (v->pick[i].element == UINT32_MAX ||
            !view_camera_project(&v->camera, is_parallel, aspect, v->pick[i].place, at[i]))
            continue;
        seen[i] = 1;
        at[i][0] *= (float)v->width;
        at[i][1] *= (float)v->height;
        const float radius = 9.0f * v->scale;
        for (int k = 0; k < 24; k++) {
            const float a = (float)k * 0.2617994f, b = (float)(k + 1) * 0.2617994f;
            const float from[2] = {at[i][0] + radius * cosf(a), at[i][1] + radius * sinf(a)};
            const float to[2] = {at[i][0] + radius * cosf(b), at[i][1] + radius * sinf(b)};
            cgt_canvas_line(&c, from, to, 2.0f * v->scale, accent);
        }
        if (i > 0 && seen[i - 1])
            cgt_canvas_line(&c, at[i - 1], at[i], 2.0f * v->scale, accent);
    }
}

void viewer_draw_panels(viewer *v)
{
    char lines[PANEL_LINES][128];
    view_frames_state state = {0};
    if (v->frames) {
        view_frames_get(v->frames, &state);
        draw_picks(v);
        draw_bar(v, &state);
        if (!v->is_opening)
            draw_status(v, &state);
    }
    if (v->is_opening)
        draw_opening(v, &state);
    else if (!v->draw)
        panel(v, fmaxf(24.0f * v->scale, 0.5f * (float)v->width - 150.0f * v->scale), 0.45f * (float)v->height, 0,
              empty_lines, sizeof empty_lines / sizeof empty_lines[0], 0);
    if (v->picks) {
        const float room = (float)v->height - 90.0f * v->scale;
        const uint32_t most = (uint32_t)fmaxf(2.0f, fminf(room / line_height(v), (float)PANEL_LINES));
        const uint32_t count = viewer_pick_lines(v, lines, most);
        panel(v, 12.0f * v->scale, 12.0f * v->scale, 0, (const char(*)[128])lines, count, -1);
    }
    if (v->list)
        draw_list(v);
    else if (v->panel == VIEW_PANEL_CLOSED && v->draw)
        panel(v, (float)v->width - 12.0f * v->scale, 12.0f * v->scale, 1, button_text, 1, -1);
    if (v->help)
        panel(v, 24.0f * v->scale, 40.0f * v->scale, 0, help_lines, sizeof help_lines / sizeof help_lines[0], -1);
    draw_messages(v);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The viewer without its window: events go in, pictures come out. Whoever shows them, a window or a test, calls
 * viewer_step in one thread, and may hand in events and take pictures in others. */
#ifndef VIEWER_H
#define VIEWER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum view_event_kind {
    VIEW_PRESS,   /* button, clicks, x, y */
    VIEW_RELEASE, /* button, x, y */
    VIEW_MOVE,    /* x, y */
    VIEW_WHEEL,   /* turns, x, y */
    VIEW_KEY,     /* key, shift, control */
    VIEW_RESIZE,  /* width, height, scale */
    VIEW_PUT,     /* option, text, continues: lines as cgt_figure_get has them become all values of an option */
    VIEW_LOOK,    /* text: front, back, right, left, top or bottom */
    VIEW_SELECT,  /* text: a formula; "": nothing; NULL: what was picked */
    VIEW_USE,     /* text: hide, show, fade, label or follow the selection */
    VIEW_COPY,    /* text: command or python: what makes the picture goes to the clipboard */
    VIEW_OPEN,    /* text: names of files, a line each; settings files end in .settings */
    VIEW_PANEL    /* panel: whether there is one beside the picture */
} view_event_kind;

/* Keys are the characters on them, lower case letters, and these. */
enum {
    VIEW_KEY_ESCAPE = 27,
    VIEW_KEY_ENTER = 13,
    VIEW_KEY_DELETE = 127,
    VIEW_KEY_LEFT = 256,
    VIEW_KEY_RIGHT,
    VIEW_KEY_UP,
    VIEW_KEY_DOWN,
    VIEW_KEY_HOME,
    VIEW_KEY_END,
    VIEW_KEY_PAGE_UP,
    VIEW_KEY_PAGE_DOWN
};

typedef struct view_event {
    view_event_kind kind;
    int button; /* 1 left, 2 middle, 3 right */
    int clicks; /* 2: the second of a double click */
    float x, y; /* pixels of the picture */
    float turns;
    int key, shift, control;
    uint32_t width, height;
    float scale;     /* of texts: 2 where pixels are half as large */
    uint32_t option; /* as cgt_figure_get_option counts */
    char *text;      /* the viewer frees it */
    int continues;   /* the last put goes on, as of a slider that is dragged: both are undone together */
    int panel;
} view_event;

typedef enum view_panel_state { VIEW_PANEL_ABSENT = 0, VIEW_PANEL_CLOSED, VIEW_PANEL_OPEN } view_panel_state;

typedef struct viewer viewer;
struct view_options; /* view_options.h */

/* viewer_step has something to do, or has_picture: it goes on, and has one to show meanwhile; any thread calls it. */
typedef void viewer_wake(void *user, int has_picture);

/* The first step opens the input: where that fails the viewer shows why, where there is none how to name one. NULL: no
 * memory. */
viewer *viewer_create(const struct view_options *options, viewer_wake *wake, void *user);
void viewer_free(viewer *v);

/* Any thread. */
void viewer_send(viewer *v, const view_event *event);

/* Ends the picture that viewer_step draws, and what it waits for: before viewer_free, from another thread. */
void viewer_stop(viewer *v);

/* Does what is due at `now` (seconds): takes events, draws one picture. Returns in how many seconds it is to be called
 * again where no event comes before: 0 at once, +infinity not before that. While files are opened it tells by pictures
 * how far that is, and Escape ends it. */
double viewer_step(viewer *v, double now);

/* Whether the user asked to end. */
int viewer_wants_end(const viewer *v);

/* In the thread of the steps: whether the picture is as good as it gets, and a movie is ready. */
int viewer_is_settled(const viewer *v);

/* Whether the input could not be opened. */
int viewer_has_failed(const viewer *v);

typedef struct view_rect {
    uint32_t x, y, width, height;
} view_rect;

enum { VIEW_RECTS = 64 };

/* The picture that is to be seen, until viewer_give_back; other threads' steps wait. rects: where it differs from the
 * one taken before. */
typedef struct view_picture {
    uint32_t width, height;
    const uint32_t *pixels; /* 0xffRRGGBB */
    view_rect rects[VIEW_RECTS];
    uint32_t rect_count;
    char title[256];
    uint64_t number; /* how many there were */
} view_picture;
void viewer_take(viewer *v, view_picture *picture);
void viewer_give_back(viewer *v);

/* The same without taking it: rects and pixels are left out. */
void viewer_peek(viewer *v, view_picture *picture);

/* For scripts and tests, between steps. A line about what is selected, "" for none; the frame and how it is drawn. */
void viewer_describe(const viewer *v, char *text, size_t size);

/* What a panel shows, in any thread: how often any of it has changed; an option's values, and why the last that was put
 * is not among them; the names of columns, a line each. "": none; NULL: no memory; the caller frees texts. */
uint64_t viewer_options_version(viewer *v);
void viewer_copy_option(viewer *v, uint32_t index, char **values, char **refused);
char *viewer_copy_columns(viewer *v);

/* How many spheres the formula of the selection has, or what is wrong with it; its formula, where the viewer made it,
 * once: NULL: there is no new one. The caller frees them. */
char *viewer_copy_selection(viewer *v);
char *viewer_take_formula(viewer *v);

/* What the viewer asks of its window, once. */
typedef enum view_request {
    VIEW_ASKS_NOTHING = 0,
    VIEW_ASKS_PANEL, /* to open or close it */
    VIEW_ASKS_FILE,  /* for the name of one to open */
    VIEW_ASKS_SIZE   /* that the picture has these pixels */
} view_request;
view_request viewer_take_request(viewer *v, uint32_t size[2]);

/* Text for the user to paste, once, which the caller frees; NULL: there is nothing new. */
char *viewer_take_clipboard(viewer *v);

#ifdef __cplusplus
}
#endif

#endif

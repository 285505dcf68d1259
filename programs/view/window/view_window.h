/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The window of cgt-view, and scripts of events in place of a user's. */
#ifndef VIEW_WINDOW_H
#define VIEW_WINDOW_H

#include <SDL2/SDL.h>

#include "system/process.h"
#include "view/window/view_panel.h"

typedef struct view_window {
    viewer *viewer;
    SDL_Window *window;
    view_panel *panel; /* NULL: this build has none */
    int panel_is_open;
    int grown;                 /* units that the window is wider by for the panel */
    char *dropped;             /* files so far, a line each; NULL: none */
    SDL_Thread *dialog_thread; /* that waits for the dialog; NULL: there was none */
    process_child dialog;
    int dialog_is_open, dialog_ends; /* dialog_ends: no other is to be started */
    Uint32 event;                    /* a picture may be there */
    SDL_mutex *lock;                 /* of all below */
    SDL_cond *changed;
    int is_woken, closing;
    int is_settled; /* since the last event */
    int asks;       /* the next whole step is to tell the state: */
    char state[1024];
} view_window;

/* Takes what SDL has, and shows the picture where there is a new one. Waits for up to `ms`. Returns 0 where the window
 * was closed. */
int view_window_poll(view_window *w, int ms);

/* The columns of pixels that the panel has at the right of the window's; scale: of its texts. */
int view_window_panel_width(const view_window *w, float *scale);

/* Asks for files to open, in a window of the desktop's; ends that. Takes events of files that are dropped. */
void view_dialog_open(view_window *w);
void view_dialog_end(view_window *w);
void view_dialog_drop(view_window *w, const SDL_Event *event);

/* Runs a script: 0, or -1 with the message printed. */
int view_script_run(view_window *w, const char *path);

#endif

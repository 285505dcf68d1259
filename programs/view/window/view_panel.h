/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The panel of cgt-view beside the picture: a control for each of the figure's options, by Dear ImGui. A build without
 * that has view_panel_absent.c. One thread calls all. */
#ifndef VIEW_PANEL_H
#define VIEW_PANEL_H

#include <SDL2/SDL.h>

#include "view/viewer/viewer.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct view_panel view_panel;

/* NULL: this build has none, or no memory. */
view_panel *view_panel_create(viewer *v);
void view_panel_free(view_panel *p); /* NULL is ignored */

/* Begins at its search field, which has the keyboard then. */
void view_panel_focus(view_panel *p);

/* Takes an event. `left` is where the panel begins, in pixels, `pixels` how many a unit of the window's coordinates
 * has. Returns whether it was the panel's, */
enum { VIEW_PANEL_LEAVES = 0, VIEW_PANEL_TAKES = 1, VIEW_PANEL_CLOSES = 2 /* or asks to close it */ };
int view_panel_event(view_panel *p, const SDL_Event *event, float left, float pixels);

/* Its picture of so many pixels, where it differs from the last one, or is asked for; else, or without memory, NULL.
 * Valid until the next call. */
SDL_Surface *view_panel_draw(view_panel *p, int width, int height, float scale, int all);

#ifdef __cplusplus
}
#endif

#endif

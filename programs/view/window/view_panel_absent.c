/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A build without Dear ImGui has no panel. */
#include "view/window/view_panel.h"

view_panel *view_panel_create(viewer *v)
{
    (void)v;
    return NULL;
}

void view_panel_free(view_panel *p) { (void)p; }

void view_panel_focus(view_panel *p) { (void)p; }

int view_panel_event(view_panel *p, const SDL_Event *event, float left, float pixels)
{
    (void)p;
    (void)event;
    (void)left;
    (void)pixels;
    return VIEW_PANEL_LEAVES;
}

SDL_Surface *view_panel_draw(view_panel *p, int width, int height, float scale, int all)
{
    (void)p;
    (void)width;
    (void)height;
    (void)scale;
    (void)all;
    return NULL;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Options of the viewer's figure: whatever control changes one comes here. */
#include "view/viewer_internal.h"

#include <string.h>

int viewer_show_frame(viewer *v, view_frame *frame)
{
    cgt_figure *const figure = v->draw->figure;
    return view_draw_tell(v->draw, cgt_figure_set_camera(figure, &v->camera)) ||
                   view_draw_tell(v->draw, cgt_figure_show_frame(figure, frame->kept))
               ? -1
               : 0;
}

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

static int change(viewer *v, const char *name, const char *value, int is_set)
{
    cgt_figure *const figure = v->draw->figure;
    cgt_camera before;
    if (strcmp(name, "size") == 0) {
        viewer_say(v, "size: the window has its own");
        return -1;
    }
    if (v->shown && v->wanted != v->shown->chosen && view_draw_has(v->draw, "trails")) { /* the reader moves them on */
        viewer_say(v, "%s: a frame with trails is being read: try again", name);
        return -1;
    }
    if (view_draw_tell(v->draw, cgt_figure_set_camera(figure, &v->camera)))
        return -1;
    cgt_figure_get_camera(figure, &before);
    if (view_draw_tell(v->draw, is_set ? cgt_figure_set(figure, name, value) : cgt_figure_unset(figure, name)))
        return -1;
    follow_camera(v, &before);
    cgt_figure_get_up(figure, v->axis);
    if (v->scene_is_wrong && v->shown)
        v->scene_is_wrong = viewer_show_frame(v, v->shown) != 0;
    v->moved = v->now;
    v->outdated = v->changed = 1;
    return 0;
}

int viewer_set(viewer *v, const char *name, const char *value) { return change(v, name, value, 1); }
int viewer_unset(viewer *v, const char *name) { return change(v, name, NULL, 0); }

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The selection by a formula: how many spheres it has, and what is done with them. */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "data/measure.h"
#include "view/view_ask.h"
#include "view/viewer/viewer_internal.h"

/* Of the shown frame. */
static void count_selected(viewer *v)
{
    view_filter *const s = &v->filter;
    double center[3];
    char why[VIEW_SENTENCE] = "";
    s->count = s->formula && v->shown ? view_ask_select(v->shown->kept, s->formula, center, why, sizeof why) : 0;
    pthread_mutex_lock(&v->lock);
    free(v->selection);
    v->selection = s->formula ? malloc(VIEW_SENTENCE + 32) : NULL;
    if (v->selection && s->count >= 0)
        snprintf(v->selection, VIEW_SENTENCE + 32, "%" PRId64 " of %u spheres", s->count,
                 v->shown ? v->shown->frame.count : 0);
    else if (v->selection)
        snprintf(v->selection, VIEW_SENTENCE + 32, "%s", why);
    v->options_version++;
    pthread_mutex_unlock(&v->lock);
}

void viewer_select(viewer *v, const char *formula)
{
    view_filter *const s = &v->filter;
    free(s->formula);
    s->formula = formula && formula[0] ? strdup(formula) : NULL;
    s->is_followed = 0;
    count_selected(v);
}

/* The camera goes with the middle of the selection, through a boundary where that is nearer. */
void viewer_follow_selection(viewer *v)
{
    view_filter *const s = &v->filter;
    double center[3], step[3];
    char why[VIEW_SENTENCE];
    if (!s->formula)
        return;
    count_selected(v);
    if (!s->is_followed || view_ask_select(v->shown->kept, s->formula, center, why, sizeof why) <= 0)
        return;
    const periodic_box box = cgt_periodic_box_of(&v->shown->frame);
    for (int c = 0; c < 3; c++)
        step[c] = center[c] - s->center[c];
    cgt_nearest_image(&box, step);
    for (int c = 0; c < 3; c++) {
        v->camera.eye[c] += (float)step[c];
        v->camera.target[c] += (float)step[c];
        v->pivot[c] += (float)step[c];
        s->center[c] = center[c];
    }
}

static void follow(viewer *v)
{
    view_filter *const s = &v->filter;
    char why[VIEW_SENTENCE];
    s->is_followed = !s->is_followed && view_ask_select(v->shown->kept, s->formula, s->center, why, sizeof why) > 0;
    viewer_say(v, s->is_followed ? "the camera goes with the middle of the selection" : "the camera goes with nothing");
}

void viewer_use_selection(viewer *v, const char *what)
{
    static const char faded[] = "0.15"; /* opacity of what is not selected */
    const view_filter *const s = &v->filter;
    char text[4096];
    if (!s->formula || s->count <= 0 || !v->shown) {
        viewer_say(v, "the selection is empty");
        return;
    }
    const int length = snprintf(text, sizeof text, "not (%s)=%s", s->formula, faded);
    if (strcmp(what, "follow") == 0)
        follow(v);
    else if (strcmp(what, "fade") == 0 && length > 0 && (size_t)length < sizeof text)
        viewer_set(v, "opacity", text);
    else if (strcmp(what, "hide") == 0 && snprintf(text, sizeof text, "(%s)", s->formula) < (int)sizeof text)
        viewer_set(v, what, text); /* else a single word is a type */
    else if (strcmp(what, "show") == 0 || strcmp(what, "label") == 0)
        viewer_set(v, what, s->formula);
}

char *viewer_copy_selection(viewer *v)
{
    pthread_mutex_lock(&v->lock);
    char *const text = strdup(v->selection ? v->selection : "");
    pthread_mutex_unlock(&v->lock);
    return text;
}

char *viewer_take_formula(viewer *v)
{
    pthread_mutex_lock(&v->lock);
    char *const text = v->formula;
    v->formula = NULL;
    pthread_mutex_unlock(&v->lock);
    return text;
}

void viewer_free_selection(viewer *v)
{
    free(v->filter.formula);
    free(v->formula);
    free(v->selection);
}

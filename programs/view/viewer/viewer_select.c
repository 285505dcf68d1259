/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What is this? What the viewer tells of a sphere or triangle; hiding, and colours by any column. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "options/numbers.h"
#include "view/view_ask.h"
#include "view/viewer/viewer_internal.h"

/* ---- Selecting ---------------------------------------------------------------------------------------------- */

static void set_place(const viewer *v, view_pick *p)
{
    const cgt_trajectory_frame *const f = &v->shown->frame;
    if (f->kind == CGT_TRAJECTORY_SPHERES)
        memcpy(p->place, f->xyzr + 4 * (size_t)p->element, sizeof p->place);
    else
        view_ask_place(f, p->element, p->share, p->place);
}

static void add_pick(viewer *v, uint32_t element, const float place[3])
{
    const cgt_trajectory_frame *const f = &v->shown->frame;
    view_pick *const p = &v->pick[v->picks++];
    p->element = element;
    p->id = f->id ? f->id[element] : element;
    memcpy(p->place, place, sizeof p->place);
    if (f->kind == CGT_TRAJECTORY_TRIANGLES)
        view_ask_shares(f, element, place, p->share);
    else
        set_place(v, p);
}

/* Whether a sphere was picked before, which is then picked no more. Places on a triangle are never the same. */
static int take_back(viewer *v, uint32_t element)
{
    for (uint32_t i = 0; i < v->picks && v->shown->frame.kind == CGT_TRAJECTORY_SPHERES; i++)
        if (v->pick[i].element == element) {
            memmove(v->pick + i, v->pick + i + 1, (--v->picks - i) * sizeof v->pick[0]);
            return 1;
        }
    return 0;
}

void viewer_click(viewer *v, float x, float y)
{
    cgt_figure *const figure = v->draw->figure;
    cgt_figure_hit hit;
    if (!v->shown || v->scene_is_wrong || !(x >= 0.0f && y >= 0.0f && x < (float)v->width && y < (float)v->height) ||
        view_draw_tell(v->draw, cgt_figure_set_camera(figure, &v->camera)) ||
        view_draw_tell(v->draw, cgt_figure_pick(figure, (uint32_t)x, (uint32_t)y, &hit)))
        return;
    v->changed = 1;
    uint32_t ends[2];
    if (hit.is_data) {
        v->has_bond = 0;
        if (take_back(v, hit.element))
            return;
        v->picks = v->picks < VIEW_PICKS ? v->picks : 0;
        add_pick(v, hit.element, hit.place);
    } else if (hit.is_hit && v->shown->frame.kind == CGT_TRAJECTORY_SPHERES && view_ask_bond(figure, &hit, ends)) {
        v->picks = 0;
        v->has_bond = 1;
        add_pick(v, ends[0], hit.place);
        add_pick(v, ends[1], hit.place);
    } else if (hit.is_hit) {
        viewer_say(v, "an arrow, a line, the box, the floor or the mesh: not of the file's own");
    }
}

void viewer_follow_picks(viewer *v)
{
    const cgt_trajectory_frame *const f = &v->shown->frame;
    for (uint32_t i = 0; i < v->picks; i++) {
        view_pick *const p = &v->pick[i];
        if (f->kind == CGT_TRAJECTORY_TRIANGLES) { /* whose numbers are the same in all frames */
            p->element = p->id < f->triangles ? p->id : UINT32_MAX;
            if (p->element != UINT32_MAX)
                set_place(v, p);
            continue;
        }
        uint32_t k = p->element; /* most files keep their order */
        if (!f->id) {
            k = p->id < f->count ? p->id : UINT32_MAX;
        } else if (k >= f->count || f->id[k] != p->id) {
            for (k = 0; k < f->count && f->id[k] != p->id;)
                k++;
            k = k < f->count ? k : UINT32_MAX;
        }
        p->element = k;
        if (k != UINT32_MAX)
            set_place(v, p);
    }
}

/* ---- Telling ------------------------------------------------------------------------------------------------ */

typedef struct lines {
    char (*text)[128];
    uint32_t count, most;
} lines;

static void tell(lines *l, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void tell(lines *l, const char *format, ...)
{
    va_list list;
    if (l->count >= l->most)
        return;
    va_start(list, format);
    vsnprintf(l->text[l->count++], sizeof *l->text, format, list);
    va_end(list);
}

/* What the figure knows of it; of several, without columns. */
static void tell_pick(const viewer *v, const view_pick *p, lines *l)
{
    const cgt_trajectory_frame *const f = &v->shown->frame;
    const double *const o = f->origin;
    const uint32_t own = 3, most = v->picks > 1 ? own : UINT32_MAX; /* lines without columns */
    char text[16384];
    cgt_figure_describe(v->draw->figure, p->element, text, sizeof text);
    uint32_t left = 0;
    for (const char *c = text; *c; c++)
        left += *c == '\n';
    left = left < most ? left : most;
    for (const char *line = text; left; left--, line += strcspn(line, "\n") + 1) {
        if (l->count >= own && l->count + 1 == l->most && left > 1) {
            tell(l, "and %u columns more", left);
            return;
        }
        tell(l, "%.*s", (int)strcspn(line, "\n"), line);
    }
    if (f->kind == CGT_TRAJECTORY_TRIANGLES)
        tell(l, "hit at  %.9g, %.9g, %.9g", o[0] + (double)p->place[0], o[1] + (double)p->place[1],
             o[2] + (double)p->place[2]);
}

/* Between all that were picked, and between the last of them; through the boundaries of a periodic box where that is
 * nearer. */
static void tell_measures(const viewer *v, lines *l)
{
    static const char *const names[] = {"distance", "angle", "dihedral"};
    static const char *const wholes[] = {"", " at the second", " about the middle two"};
    static const char *const none[] = {"not known", "none: two of them coincide", "none: three of them lie on a line"};
    const periodic_box box = cgt_periodic_box_of(&v->shown->frame);
    float place[VIEW_PICKS][3];
    for (uint32_t i = 0; i < v->picks; i++)
        memcpy(place[i], v->pick[i].place, sizeof place[i]);
    for (uint32_t count = 2; count <= v->picks; count++) {
        double value;
        const float(*const last)[3] = (const float(*)[3])place + (v->picks - count);
        const int is_known = cgt_measure(&box, last, count, &value);
        tell(l, "%s%s  %s%s", names[count - 2], v->picks > count ? " of the last" : wholes[count - 2],
             is_known ? cgt_number(count == 2 ? 9 : 6, value).text : none[count - 2],
             is_known && count > 2 ? " degrees" : "");
    }
}

uint32_t viewer_pick_lines(const viewer *v, char text[][128], uint32_t most)
{
    lines l = {text, 0, most};
    int there = 1;
    if (!v->shown || !v->picks)
        return 0;
    for (uint32_t i = 0; i < v->picks; i++) {
        if (v->pick[i].element == UINT32_MAX) {
            tell(&l, "id %u is not in this frame", v->pick[i].id);
            there = 0;
        } else {
            tell_pick(v, &v->pick[i], &l);
        }
        if (i + 1 < v->picks)
            tell(&l, "%s", "");
    }
    if (there && v->picks > 1) {
        tell(&l, "%s", "");
        if (v->has_bond && v->picks == 2)
            tell(&l, "a bond of these two");
        tell_measures(v, &l);
    }
    return l.count;
}

/* ---- Looks -------------------------------------------------------------------------------------------------- */

static const char one_color[] = "one colour";

static void add_name(viewer *v, const char *name)
{
    for (uint32_t i = 0; i < v->list_count; i++)
        if (strcmp(v->list_names[i], name) == 0)
            return;
    if (v->list_count < VIEW_LIST_MOST)
        snprintf(v->list_names[v->list_count++], sizeof v->list_names[0], "%s", name);
}

void viewer_open_list(viewer *v)
{
    v->list = !v->list && v->shown;
    if (!v->list)
        return;
    const cgt_trajectory_frame *const f = &v->shown->frame;
    v->list_count = 0;
    v->list_at = 0;
    if (f->element)
        add_name(v, "element");
    if (f->type)
        add_name(v, "type");
    add_name(v, "id");
    add_name(v, "speed");
    add_name(v, "height");
    add_name(v, one_color);
    for (uint32_t i = 0; i < f->columns; i++)
        if (f->column[i].value)
            add_name(v, f->column[i].name);
    char *const color = view_draw_get(v->draw, cgt_figure_get_chosen, "color");
    if (color)
        color[strcspn(color, "\n")] = '\0';
    for (uint32_t i = 0; i < v->list_count && color; i++)
        if (strcmp(v->list_names[i], color) == 0)
            v->list_at = (int)i;
    free(color);
}

void viewer_take_list(viewer *v, int row)
{
    v->changed = 1;
    if (row < 0 || (uint32_t)row >= v->list_count || !v->shown)
        return;
    v->list_at = row;
    const char *const name = v->list_names[row];
    char *const range = view_draw_get(v->draw, cgt_figure_get, "range");
    if (range && viewer_set(v, "color", strcmp(name, one_color) == 0 ? "dcd3c4" : name) == 0 && *range &&
        strcmp(range, "symmetric\n") != 0)
        viewer_unset(v, "range"); /* it was that of other values */
    free(range);
}

void viewer_hide(viewer *v, int kind, int only)
{
    const cgt_trajectory_frame *const f = v->shown ? &v->shown->frame : NULL;
    char condition[1024], one[64];
    int length = 0;
    if (!f || f->kind != CGT_TRAJECTORY_SPHERES || !v->picks) {
        viewer_say(v, "click a sphere first");
        return;
    }
    const char *const sign = only ? "==" : "!=";
    for (uint32_t i = 0; i < v->picks; i++) {
        const uint32_t k = v->pick[i].element;
        if (k == UINT32_MAX)
            continue;
        if (kind && f->element && f->element[k])
            snprintf(one, sizeof one, "element %s %u", sign, f->element[k]);
        else if (kind && f->type)
            snprintf(one, sizeof one, "type %s %u", sign, f->type[k]);
        else
            snprintf(one, sizeof one, "%s %s %u", f->id ? "id" : "index", sign, f->id ? f->id[k] : k);
        length += snprintf(condition + length, sizeof condition - (size_t)length, "%s%s", length ? " && " : "", one);
        if (only)
            break; /* one kind alone */
    }
    if (!length || viewer_set(v, "show", condition) == 0)
        v->picks = 0;
}

/* Those that the command line hides stay hidden. */
void viewer_show_all(viewer *v)
{
    if (v->shown)
        viewer_set_lines(v, "show", v->draw->shows);
}

void viewer_select_picks(viewer *v)
{
    char formula[512] = "";
    int length = 0;
    if (!v->shown || v->shown->frame.kind != CGT_TRAJECTORY_SPHERES || !v->picks) {
        viewer_say(v, "click a sphere first");
        return;
    }
    for (uint32_t i = 0; i < v->picks; i++)
        length += snprintf(formula + length, sizeof formula - (size_t)length, "%s%s == %u", i ? " or " : "",
                           v->shown->frame.id ? "id" : "index", v->pick[i].id);
    pthread_mutex_lock(&v->lock);
    free(v->formula);
    v->formula = strdup(formula);
    pthread_mutex_unlock(&v->lock);
    viewer_select(v, formula); /* has the panel look for it */
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What is this? What the viewer tells of a sphere or triangle; hiding, and colours by any column. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "data/element_symbols.h"
#include "view/viewer_internal.h"

/* ---- Selecting ---------------------------------------------------------------------------------------------- */

static void set_place(const viewer *v, view_pick *p)
{
    if (v->shown->frame.kind == CGT_TRAJECTORY_SPHERES)
        memcpy(p->place, v->shown->frame.xyzr + 4 * (size_t)p->element, sizeof p->place);
}

void viewer_click(viewer *v, float x, float y)
{
    view_hit hit;
    if (!v->shown || v->scene_is_wrong || !(x >= 0.0f && y >= 0.0f && x < (float)v->width && y < (float)v->height) ||
        view_draw_pick(v->draw, &v->camera, (uint32_t)x, (uint32_t)y, &hit))
        return;
    v->changed = 1;
    if (!hit.is_file) {
        if (hit.is_hit)
            viewer_say(v, "a bond, an arrow, a line or the mesh: not of the file's own");
        return;
    }
    if (v->picks == VIEW_PICKS)
        v->picks = 0;
    view_pick *const p = &v->pick[v->picks++];
    p->element = hit.element;
    p->id = v->shown->frame.id ? v->shown->frame.id[hit.element] : hit.element;
    memcpy(p->place, hit.place, sizeof p->place);
    set_place(v, p);
}

void viewer_follow_picks(viewer *v)
{
    const cgt_trajectory_frame *const f = &v->shown->frame;
    for (uint32_t i = 0; i < v->picks && f->kind == CGT_TRAJECTORY_SPHERES; i++) {
        view_pick *const p = &v->pick[i];
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

/* Columns that have a line of their own. */
static int is_told(const char *name)
{
    static const char *const names[] = {"id", "type", "x", "y", "z", "radius"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(names[i], name) == 0)
            return 1;
    return 0;
}

static void tell_columns(const viewer *v, uint32_t k, lines *l)
{
    const cgt_trajectory_frame *const f = &v->shown->frame;
    for (uint32_t i = 0; i < f->columns; i++) {
        const cgt_trajectory_column *const c = &f->column[i];
        if (!c->value || is_told(c->name))
            continue;
        if (l->count + 1 == l->most && i + 1 < f->columns) {
            tell(l, "and %u columns more", f->columns - i);
            return;
        }
        const float value = c->value[k];
        if (c->kind == CGT_TRAJECTORY_WORD && c->word && value >= 1.0f && value <= (float)c->words)
            tell(l, "%s  %s", c->name, c->word[(uint32_t)value - 1]);
        else
            tell(l, "%s  %.7g", c->name, (double)value);
    }
    if (v->shown->speed && isfinite(v->shown->speed[k]))
        tell(l, "speed  %.6g", (double)v->shown->speed[k]);
}

static void tell_sphere(const viewer *v, const view_pick *p, lines *l)
{
    const cgt_trajectory_frame *const f = &v->shown->frame;
    const double *const o = f->origin;
    const int digits = o[0] != 0.0 || o[1] != 0.0 || o[2] != 0.0 ? 15 : 7; /* what the numbers have */
    const uint32_t k = p->element;
    const float *const s = f->xyzr + 4 * (size_t)k;
    char id[32] = "", kind[64] = "";
    if (f->id)
        snprintf(id, sizeof id, ", id %u", f->id[k]);
    if (f->type)
        snprintf(kind, sizeof kind, ", type %u", f->type[k]);
    if (f->element && f->element[k])
        snprintf(kind + strlen(kind), sizeof kind - strlen(kind), ", %s", element_symbol(f->element[k]));
    tell(l, "sphere %u%s%s", k, id, kind);
    tell(l, "at  %.*g, %.*g, %.*g", digits, o[0] + (double)s[0], digits, o[1] + (double)s[1], digits,
         o[2] + (double)s[2]);
    tell(l, "radius  %.6g", (double)s[3]);
}

static void tell_triangle(const viewer *v, const view_pick *p, lines *l)
{
    const cgt_trajectory_frame *const f = &v->shown->frame;
    const double *const o = f->origin;
    const uint32_t *const corner = f->index + 3 * (size_t)p->element;
    tell(l, "triangle %u, vertices %u, %u, %u", p->element, corner[0], corner[1], corner[2]);
    tell(l, "hit at  %.9g, %.9g, %.9g", o[0] + (double)p->place[0], o[1] + (double)p->place[1],
         o[2] + (double)p->place[2]);
}

static void between(const view_pick *a, const view_pick *b, double to[3])
{
    for (int c = 0; c < 3; c++)
        to[c] = (double)b->place[c] - (double)a->place[c];
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void tell_measures(const viewer *v, lines *l)
{
    double a[3], b[3];
    const view_pick *const p = v->pick;
    if (v->picks >= 2) {
        between(&p[v->picks - 2], &p[v->picks - 1], a);
        tell(l, "distance of the last two  %.9g", sqrt(dot(a, a)));
    }
    if (v->picks == 3) {
        between(&p[1], &p[0], a);
        between(&p[1], &p[2], b);
        const double both = sqrt(dot(a, a)) * sqrt(dot(b, b));
        if (both > 0.0)
            tell(l, "angle at the second  %.6g degrees",
                 acos(fmax(-1.0, fmin(1.0, dot(a, b) / both))) * 57.29577951308232);
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
        } else if (v->shown->frame.kind == CGT_TRAJECTORY_SPHERES) {
            tell_sphere(v, &v->pick[i], &l);
        } else {
            tell_triangle(v, &v->pick[i], &l);
        }
        if (i + 1 < v->picks)
            tell(&l, "%s", "");
    }
    const view_pick *const last = &v->pick[v->picks - 1];
    if (v->picks == 1 && there && v->shown->frame.kind == CGT_TRAJECTORY_SPHERES)
        tell_columns(v, last->element, &l);
    if (there && v->picks > 1) {
        tell(&l, "%s", "");
        tell_measures(v, &l);
    }
    return l.count;
}

/* ---- Looks -------------------------------------------------------------------------------------------------- */

/* The frame at hand by the new looks. */
static void set_again(viewer *v)
{
    v->scene_is_wrong = view_draw_set_frame(v->draw, v->shown, &v->camera) != 0;
    v->moved = v->now;
    v->outdated = v->changed = 1;
}

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
    v->list = !v->list;
    if (!v->list || !v->shown)
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
    for (uint32_t i = 0; i < v->list_count; i++)
        if (strcmp(v->list_names[i], view_draw_color_name(v->draw)) == 0)
            v->list_at = (int)i;
}

void viewer_take_list(viewer *v, int row)
{
    v->changed = 1;
    if (row < 0 || (uint32_t)row >= v->list_count || !v->shown)
        return;
    v->list_at = row;
    const char *const name = v->list_names[row];
    if (view_draw_color(v->draw, v->shown, strcmp(name, one_color) == 0 ? "dcd3c4" : name) == 0)
        set_again(v);
}

static void show(viewer *v, const char *condition)
{
    if (view_draw_show(v->draw, v->shown, condition))
        return;
    snprintf(v->condition, sizeof v->condition, "%s", condition);
    set_again(v);
}

void viewer_hide(viewer *v, int kind, int only)
{
    const cgt_trajectory_frame *const f = v->shown ? &v->shown->frame : NULL;
    char next[sizeof v->condition], one[64];
    int length = snprintf(next, sizeof next, "%s", v->condition);
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
        length += snprintf(next + length, sizeof next - (size_t)length, "%s%s", length ? " && " : "", one);
        if (only || (size_t)length >= sizeof next)
            break; /* one kind alone */
    }
    if ((size_t)length >= sizeof next) {
        viewer_say(v, "too much is hidden one by one: a shows all");
        return;
    }
    v->picks = 0;
    show(v, next);
}

void viewer_show_all(viewer *v)
{
    if (v->shown)
        show(v, "");
}

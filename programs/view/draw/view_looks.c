/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Changing what is drawn: colours and conditions; see view_draw.h. */
#define _POSIX_C_SOURCE 200809L
#include "view/draw/view_draw_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/program.h"

/* The range of a formula in the frame: the 1 % and the 99 % quantile, as of a survey, or all where those are equal or
 * `is_whole`. */
static int find_range(expression *e, const view_frame *f, int is_whole, double *min, double *max, char *error,
                      size_t size)
{
    const uint32_t count = f->frame.count;
    double *const value = malloc(((size_t)count + 1) * sizeof *value), low, high;
    bulk_values *const samples = calloc(1, sizeof *samples);
    *min = INFINITY;
    *max = -INFINITY;
    if (value && samples)
        expression_values(e, 0, count, value);
    for (uint32_t i = 0; i < count && value && samples; i++)
        if (isfinite(value[i])) {
            bulk_values_add(samples, f->frame.number, i, value[i]);
            *min = fmin(*min, value[i]);
            *max = fmax(*max, value[i]);
        }
    if (samples && !is_whole && bulk_values_range(samples, -INFINITY, &low, &high) && low < high) {
        *min = low;
        *max = high;
    }
    if (!(*min <= *max)) /* nothing is known */
        *min = *max = 0.0;
    const int failed = !value || !samples;
    if (failed)
        snprintf(error, size, "out of memory for the range of the colours");
    free(value);
    free(samples);
    return failed ? -1 : 0;
}

const char *view_draw_measured(const render_options *o)
{
    static const char *const axes[] = {"x", "y", "z"};
    switch (o->figure.by) {
    case COLORING_ID: return "id";
    case COLORING_SPEED: return "speed";
    case COLORING_HEIGHT: return axes[o->figure.up[0] != 0.0f ? 0 : o->figure.up[1] != 0.0f ? 1 : 2];
    case COLORING_VALUE: return o->figure.formula;
    default: return NULL;
    }
}

int view_draw_color(view_draw *d, const view_frame *f, const char *by)
{
    renderer *const r = &d->r;
    render_options o = r->options;
    char text[sizeof d->color];
    snprintf(text, sizeof text, "%s", by);
    if (parse_coloring(text, &o.figure, r->error, sizeof r->error))
        return render_fail(r);
    const char *const name = view_draw_measured(&o);
    expression *const e = name ? expression_parse(name, r->error, sizeof r->error) : NULL;
    if (name && !e)
        return render_fail(r);
    o.figure.has_range = 0;
    if (e && o.figure.by == COLORING_ID && !f->frame.id) {
        o.figure.has_range = 1;
        o.figure.range_min = 0.0;
        o.figure.range_max = f->frame.count ? (double)(f->frame.count - 1) : 0.0;
    } else if (e) {
        if (expression_bind(e, &f->frame, f->speed, r->error, sizeof r->error) ||
            find_range(e, f, o.figure.by == COLORING_ID || o.figure.by == COLORING_HEIGHT, &o.figure.range_min,
                       &o.figure.range_max, r->error, sizeof r->error)) {
            expression_free(e);
            return render_fail(r);
        }
        o.figure.range_min = o.figure.by == COLORING_SPEED ? 0.0 : (double)(float)o.figure.range_min;
        o.figure.range_max = (double)(float)o.figure.range_max;
        o.figure.has_range = 1;
    }
    expression_free(r->formula);
    r->formula = o.figure.by == COLORING_VALUE ? e : NULL;
    if (o.figure.by != COLORING_VALUE)
        expression_free(e);
    memcpy(d->formula, text, sizeof d->formula);
    o.figure.formula = o.figure.by == COLORING_VALUE ? d->formula : NULL;
    r->options = o;
    coloring_free(&r->coloring);
    memset(&r->coloring, 0, sizeof r->coloring);
    if (render_choose_colors(r))
        return -1;
    view_draw_widen_range(&r->coloring);
    view_draw_name_color(d);
    return view_draw_set_up_full(d);
}

int view_draw_show(view_draw *d, const view_frame *f, const char *condition)
{
    renderer *const r = &d->r;
    particle_options *const p = &r->options.figure.particles;
    char show[sizeof p->show];
    expression *e = NULL;
    const int length = snprintf(show, sizeof show, "%s%s%s", d->show, *d->show && *condition ? " && " : "", condition);
    if (length < 0 || (size_t)length >= sizeof show) {
        program_error("the conditions of what is hidden are too long together");
        return -1;
    }
    if (*show && (!(e = expression_parse(show, r->error, sizeof r->error)) ||
                  expression_bind(e, &f->frame, f->speed, r->error, sizeof r->error))) {
        expression_free(e);
        return render_fail(r);
    }
    expression_free(r->parts.show);
    r->parts.show = e;
    r->parts.rules.show = e;
    r->parts.selects = !particle_rules_are_empty(&r->parts.rules) || p->bonds || p->arrows || p->trails;
    memcpy(p->show, show, sizeof show);
    snprintf(d->condition, sizeof d->condition, "%s", condition);
    return 0;
}

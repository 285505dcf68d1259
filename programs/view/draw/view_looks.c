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
        cgt_expression_values(e, 0, count, value);
    for (uint32_t i = 0; i < count && value && samples; i++)
        if (isfinite(value[i])) {
            cgt_bulk_values_add(samples, f->frame.number, i, value[i]);
            *min = fmin(*min, value[i]);
            *max = fmax(*max, value[i]);
        }
    if (samples && !is_whole && cgt_bulk_values_range(samples, -INFINITY, &low, &high) && low < high) {
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

const char *view_draw_measured(const figure_options *o)
{
    static const char *const axes[] = {"x", "y", "z"};
    switch (o->by) {
    case COLORING_ID: return "id";
    case COLORING_SPEED: return "speed";
    case COLORING_HEIGHT: return axes[o->up[0] != 0.0f ? 0 : o->up[1] != 0.0f ? 1 : 2];
    case COLORING_VALUE: return o->formula;
    default: return NULL;
    }
}

int view_draw_color(view_draw *d, const view_frame *f, const char *by)
{
    renderer *const r = &d->r;
    figure_options o = r->figure.options;
    char text[sizeof d->color];
    snprintf(text, sizeof text, "%s", by);
    if (cgt_parse_coloring(text, &o, r->error, sizeof r->error))
        return render_fail(r);
    const char *const name = view_draw_measured(&o);
    expression *const e = name ? cgt_expression_parse(name, r->error, sizeof r->error) : NULL;
    if (name && !e)
        return render_fail(r);
    o.has_range = 0;
    if (e && o.by == COLORING_ID && !f->frame.id) {
        o.has_range = 1;
        o.range_min = 0.0;
        o.range_max = f->frame.count ? (double)(f->frame.count - 1) : 0.0;
    } else if (e) {
        if (cgt_expression_bind(e, &f->frame, f->speed, r->error, sizeof r->error) ||
            find_range(e, f, o.by == COLORING_ID || o.by == COLORING_HEIGHT, &o.range_min, &o.range_max, r->error,
                       sizeof r->error)) {
            cgt_expression_free(e);
            return render_fail(r);
        }
        if (o.is_symmetric)
            cgt_coloring_make_symmetric(&o.range_min, &o.range_max);
        o.range_min = o.by == COLORING_SPEED && !o.is_symmetric ? 0.0 : (double)(float)o.range_min;
        o.range_max = (double)(float)o.range_max;
        o.has_range = 1;
    }
    cgt_expression_free(r->figure.formula);
    r->figure.formula = o.by == COLORING_VALUE ? e : NULL;
    if (o.by != COLORING_VALUE)
        cgt_expression_free(e);
    cgt_categories_free(&r->figure.categories);
    if (r->figure.formula) {
        cgt_categories_take(&r->figure.categories, e, &f->frame);
        if (r->figure.categories.has_words)
            cgt_categories_look(&r->figure.categories, e, r->figure.parts.show, f->frame.count);
    }
    memcpy(d->formula, text, sizeof d->formula);
    o.formula = o.by == COLORING_VALUE ? d->formula : NULL;
    r->figure.options = o;
    cgt_coloring_free(&r->figure.coloring);
    memset(&r->figure.coloring, 0, sizeof r->figure.coloring);
    if (render_result(r, cgt_figure_choose_colors(&r->figure)))
        return -1;
    view_draw_widen_range(&r->figure.coloring);
    view_draw_name_color(d);
    return view_draw_set_up_full(d);
}

int view_draw_show(view_draw *d, const view_frame *f, const char *condition)
{
    renderer *const r = &d->r;
    particle_options *const p = &r->figure.options.particles;
    char show[sizeof p->show];
    expression *e = NULL;
    const int length = snprintf(show, sizeof show, "%s%s%s", d->show, *d->show && *condition ? " && " : "", condition);
    if (length < 0 || (size_t)length >= sizeof show) {
        program_error("the conditions of what is hidden are too long together");
        return -1;
    }
    if (*show && (!(e = cgt_expression_parse(show, r->error, sizeof r->error)) ||
                  cgt_expression_bind(e, &f->frame, f->speed, r->error, sizeof r->error))) {
        cgt_expression_free(e);
        return render_fail(r);
    }
    cgt_expression_free(r->figure.parts.show);
    r->figure.parts.show = e;
    r->figure.parts.rules.show = e;
    r->figure.parts.selects =
        !cgt_particle_rules_are_empty(&r->figure.parts.rules) || p->bonds || p->arrows || p->trails;
    memcpy(p->show, show, sizeof show);
    snprintf(d->condition, sizeof d->condition, "%s", condition);
    return 0;
}

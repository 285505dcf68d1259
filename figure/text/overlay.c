/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What lies over a picture; see overlay.h. All lengths are in units of the font's size. */
#include "text/overlay.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "options/numbers.h"

static const float margin = 0.9f;

/* ---- Text --------------------------------------------------------------------------------------------------- */

/* Of {time} or {time:.2f}, with one digit of decimals; 0: there is neither. */
static size_t time_length(const char *format)
{
    if (strncmp(format, "{time}", 6) == 0)
        return 6;
    return strncmp(format, "{time:.", 7) == 0 && format[7] >= '0' && format[7] <= '9' && format[8] == 'f' &&
                   format[9] == '}'
               ? 10
               : 0;
}

void cgt_overlay_format(const char *format, const overlay_frame *f, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    while (*format && used + 1 < size) {
        int length = 1;
        size_t taken = 1;
        const size_t time = time_length(format);
        if (time) {
            const number_text number = time == 6 ? cgt_number(6, f->time) : cgt_fixed(format[7] - '0', f->time);
            length = isnan(f->time) ? snprintf(text + used, size - used, "%" PRId64, f->step)
                                    : snprintf(text + used, size - used, "%s", number.text);
            taken = time;
        } else if (strncmp(format, "{step}", 6) == 0) {
            length = snprintf(text + used, size - used, "%" PRId64, f->step);
            taken = 6;
        } else if (strncmp(format, "{frame}", 7) == 0) {
            length = snprintf(text + used, size - used, "%" PRIu64, f->number);
            taken = 7;
        } else {
            text[used] = *format;
            text[used + 1] = '\0';
        }
        used += (size_t)length;
        format += taken;
    }
}

static void draw_texts(const overlay *o, const canvas *c, const overlay_frame *frame)
{
    char text[256];
    if (o->title) {
        const float width = cgt_text_width(o->font, o->title);
        cgt_text_draw(o->font, c, 0.5f * ((float)c->width - width), (margin + 0.8f) * o->size, o->title, o->color);
    }
    if (o->time) {
        cgt_overlay_format(o->time, frame, text, sizeof text);
        cgt_text_draw(o->font, c, margin * o->size, (float)c->height - margin * o->size, text, o->color);
    }
}

/* ---- Colour bar --------------------------------------------------------------------------------------------- */

static uint32_t linear_ticks(double min, double max, double *ticks, uint32_t most)
{
    static const double steps[] = {1.0, 2.0, 5.0, 10.0};
    const double rough = (max - min) / most, power = pow(10.0, floor(log10(rough)));
    double step = 10.0 * power;
    uint32_t count = 0;
    for (int i = 3; i >= 0; i--)
        step = steps[i] * power >= rough ? steps[i] * power : step;
    for (double k = ceil(min / step - 1e-9); k <= max / step + 1e-9 && count < most; k += 1.0)
        ticks[count++] = k * step;
    return count;
}

uint32_t cgt_overlay_ticks(double min, double max, int logarithmic, double *ticks, uint32_t most)
{
    if (!(max > min) || !isfinite(max - min))
        return 0;
    if (!logarithmic || max / min < 10.0)
        return linear_ticks(min, max, ticks, most);
    const double decades = log10(max / min);
    const double every = ceil(decades / most);
    uint32_t count = 0;
    for (double k = ceil(log10(min) - 1e-9); k <= log10(max) + 1e-9 && count < most; k += every)
        ticks[count++] = pow(10.0, k);
    return count;
}

/* Where a value lies on the bar, 0 to 1. */
static double share_of(const coloring *k, double value)
{
    if (k->logarithmic)
        return log(value / k->min) / log(k->max / k->min);
    return (value - k->min) / (k->max - k->min);
}

static void draw_ticks(const overlay *o, const canvas *c, float left, float top, float height)
{
    enum { MOST = 6 };
    double ticks[MOST];
    const uint32_t count = cgt_overlay_ticks(o->coloring->min, o->coloring->max, o->coloring->logarithmic, ticks, MOST);
    for (uint32_t i = 0; i < count; i++) {
        const float y = top + (1.0f - (float)share_of(o->coloring, ticks[i])) * height;
        cgt_canvas_fill(c, left, y - 0.04f * o->size, 0.3f * o->size, 0.08f * o->size, o->color);
        const double tick = fabs(ticks[i]) < 1e-12 * fabs(o->coloring->max) ? 0.0 : ticks[i];
        if (o->font)
            cgt_text_draw(o->font, c, left + 0.5f * o->size, y + 0.36f * o->size, cgt_number(6, tick).text, o->color);
    }
}

static void draw_bar(const overlay *o, const canvas *c)
{
    const coloring *k = o->coloring;
    /* Whole pixels: two rows that share one would let the ground shine through. */
    const float height = roundf(0.5f * (float)c->height), top = roundf(0.25f * (float)c->height);
    const float width = roundf(0.9f * o->size), left = roundf((float)c->width - (margin + 4.6f) * o->size);
    for (uint32_t row = 0; (float)row < height; row++) {
        const float y = (float)row;
        const float x = 1.0f - (y + 0.5f) / height;
        const uint32_t entry = (uint32_t)(fmaxf(0.0f, x) * (COLORING_STEPS - 1) + 0.5f);
        cgt_canvas_fill(c, left, top + y, width, fminf(1.0f, height - y), k->palette[entry]);
    }
    draw_ticks(o, c, left + width, top, height);
    if (*o->bar) {
        const float length = cgt_text_width(o->font, o->bar), room = (float)c->width - margin * o->size - left;
        cgt_text_draw(o->font, c, length < room ? left : (float)c->width - margin * o->size - length,
                      top - 0.7f * o->size, o->bar, o->color);
    }
}

/* ---- Legend of kinds ---------------------------------------------------------------------------------------- */

/* A ball of the colour, with a rim, so that it is seen on a ground of the same colour. */
static void draw_swatch(const overlay *o, const canvas *c, float x, float y, const float color[3])
{
    const float center[2] = {x, y};
    float rim[3];
    for (int k = 0; k < 3; k++)
        rim[k] = 0.5f * (o->color[k] + color[k]);
    cgt_canvas_line(c, center, center, 0.96f * o->size, rim);
    cgt_canvas_line(c, center, center, 0.96f * o->size - fmaxf(1.0f, 0.1f * o->size), color);
}

/* To the right, in the middle of the height, as far from the edge as the longest line wants. */
static void draw_legend(const overlay *o, const canvas *c)
{
    const float indent = 1.35f * o->size, step = 1.45f * o->size;
    const uint32_t lines = o->kind_count < OVERLAY_MOST_KINDS ? o->kind_count : OVERLAY_MOST_KINDS;
    char more[32] = "";
    float width = o->font ? cgt_text_width(o->font, o->legend) : 0.0f;
    if (o->kind_count > lines)
        snprintf(more, sizeof more, "and %" PRIu32 " more", o->kind_count - lines);
    for (uint32_t i = 0; i < lines && o->font; i++)
        width = fmaxf(width, indent + cgt_text_width(o->font, o->kinds[i].name));
    if (*more && o->font)
        width = fmaxf(width, indent + cgt_text_width(o->font, more));
    const float left = (float)c->width - margin * o->size - fmaxf(width, indent);
    float y = 0.5f * ((float)c->height - step * (float)(lines + (*o->legend != 0) + (*more != 0)));
    if (*o->legend) {
        if (o->font)
            cgt_text_draw(o->font, c, left, y + 0.9f * o->size, o->legend, o->color);
        y += step;
    }
    for (uint32_t i = 0; i < lines; i++, y += step) {
        draw_swatch(o, c, left + 0.5f * o->size, y + 0.5f * step, o->kinds[i].color);
        if (o->font)
            cgt_text_draw(o->font, c, left + indent, y + 0.5f * step + 0.36f * o->size, o->kinds[i].name, o->color);
    }
    if (*more && o->font)
        cgt_text_draw(o->font, c, left + indent, y + 0.5f * step + 0.36f * o->size, more, o->color);
}

/* ---- Axes --------------------------------------------------------------------------------------------------- */

static void draw_axes(const overlay *o, const canvas *c, const overlay_frame *f)
{
    static const float colors[3][3] = {{0.67f, 0.02f, 0.02f}, {0.03f, 0.36f, 0.03f}, {0.02f, 0.16f, 0.60f}};
    const float length = 2.4f * o->size, below = o->time ? 1.6f * o->size : 0.0f;
    const float origin[2] = {margin * o->size + length, (float)c->height - margin * o->size - length - below};
    int order[3] = {0, 1, 2};
    for (int i = 0; i < 3; i++) /* what points into the picture first */
        for (int k = 0; k < 2; k++)
            if (f->forward[order[k]] < f->forward[order[k + 1]]) {
                const int swapped = order[k];
                order[k] = order[k + 1];
                order[k + 1] = swapped;
            }
    for (int i = 0; i < 3; i++) {
        const int a = order[i];
        const float tip[2] = {origin[0] + length * f->right[a], origin[1] - length * f->up[a]};
        const char name[2] = {(char)('x' + a), '\0'};
        cgt_canvas_line(c, origin, tip, 0.16f * o->size, colors[a]);
        if (o->font)
            cgt_text_draw(o->font, c, tip[0] + 0.35f * o->size * f->right[a] - 0.3f * o->size,
                          tip[1] - 0.45f * o->size * f->up[a] + 0.3f * o->size, name, o->color);
    }
}

void cgt_overlay_draw(const overlay *o, const canvas *c, const overlay_frame *frame)
{
    if (o->legend)
        draw_legend(o, c);
    if (o->bar && o->coloring->max > o->coloring->min)
        draw_bar(o, c);
    if (o->axes)
        draw_axes(o, c, frame);
    if (o->font)
        draw_texts(o, c, frame);
}

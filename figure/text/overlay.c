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

/* ---- Time --------------------------------------------------------------------------------------------------- */

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

enum { NUMBER_SIZE = 64 };

/* Writes the number that a format begins with, and returns how much of the format that is; 0: it begins with none. */
static size_t format_number(const char *format, const overlay_frame *f, char text[NUMBER_SIZE])
{
    const size_t time = time_length(format);
    text[0] = '\0';
    if (time) { /* a step in place of the time would stand before the time's unit */
        const number_text number = time == 6 ? cgt_number_shortest(f->time) : cgt_fixed(format[7] - '0', f->time);
        snprintf(text, NUMBER_SIZE, "%s", isnan(f->time) ? "-" : number.text);
        return time;
    }
    if (strncmp(format, "{step}", 6) == 0) {
        snprintf(text, NUMBER_SIZE, "%" PRId64, f->step);
        return 6;
    }
    if (strncmp(format, "{frame}", 7) != 0)
        return 0;
    snprintf(text, NUMBER_SIZE, "%" PRIu64, f->number);
    return 7;
}

void cgt_overlay_format(const char *format, const overlay_frame *f, char *text, size_t size)
{
    char number[NUMBER_SIZE];
    size_t used = 0;
    text[0] = '\0';
    while (*format && used + 1 < size) {
        const size_t taken = format_number(format, f, number);
        used += (size_t)(taken ? snprintf(text + used, size - used, "%s", number)
                               : snprintf(text + used, size - used, "%c", *format));
        format += taken ? taken : 1;
    }
}

/* All digits take the same width, in any font. */
static float digit_width(const text_font *font)
{
    float widest = 0.0f;
    for (char digit[2] = "0"; *digit <= '9'; ++*digit)
        widest = fmaxf(widest, cgt_text_width(font, digit));
    return widest;
}

/* Draws a number from x on, unless c is NULL, and returns its width. */
static float draw_number(const overlay *o, const canvas *c, float x, float y, const char *text)
{
    const float cell = digit_width(o->font), begin = x;
    for (; *text; text++) {
        const char letter[2] = {*text, '\0'};
        const float own = cgt_text_width(o->font, letter), width = *text >= '0' && *text <= '9' ? cell : own;
        if (c)
            cgt_text_draw(o->font, c, x + 0.5f * (width - own), y, letter, o->color);
        x += width;
    }
    return x - begin;
}

/* How wide a number of the format becomes in any frame that is known. */
static float number_width(const overlay *o, const char *format)
{
    float widest = 0.0f;
    char text[NUMBER_SIZE];
    for (uint32_t i = 0; i < o->extremes; i++) {
        format_number(format, &o->extreme[i], text);
        widest = fmaxf(widest, draw_number(o, NULL, 0.0f, 0.0f, text));
    }
    return time_length(format) == 6 ? fmaxf(widest, (float)o->time_letters * digit_width(o->font)) : widest;
}

/* Whether a number stands at the right end of its place: one that is last and has no fixed decimals grows. */
static int keeps_width(const char *format, size_t taken) { return format[taken] != '\0' || time_length(format) == 10; }

/* Longer than their texts: of a place in them clang-tidy does not know what follows. */
static const char default_time[2 * NUMBER_SIZE] = "t = {time}", default_step[2 * NUMBER_SIZE] = "step {step}";

/* The text of a frame. */
static const char *format_of(const overlay *o, const overlay_frame *frame)
{
    return *o->time ? o->time : isnan(frame->time) ? default_step : default_time;
}

int cgt_overlay_lacks_time(const overlay *o, const overlay_frame *frame)
{
    int asks = 0;
    for (const char *at = o->time; at && *at; at++)
        asks |= time_length(at) > 0;
    return asks && isnan(frame->time);
}

/* Draws a time from x on, unless c is NULL, with numbers at the right end of their place; returns its width. frame
 * NULL: the widest of all. */
static float draw_time(const overlay *o, const canvas *c, float x, float y, const char *format,
                       const overlay_frame *frame)
{
    static const overlay_frame first = {.number = 0};
    const float begin = x;
    char text[NUMBER_SIZE];
    while (*format) {
        const size_t taken = format_number(format, frame ? frame : &first, text);
        if (taken && frame) {
            const float width = draw_number(o, NULL, x, y, text);
            x += keeps_width(format, taken) ? fmaxf(0.0f, number_width(o, format) - width) : 0.0f;
            x += draw_number(o, c, x, y, text);
        } else if (taken) {
            x += number_width(o, format);
        } else {
            size_t length = 1 + strcspn(format + 1, "{");
            length = length < sizeof text ? length : sizeof text - 1;
            while (length > 1 && ((unsigned char)format[length] & 0xc0) == 0x80) /* whole characters */
                length--;
            snprintf(text, sizeof text, "%.*s", (int)length, format);
            if (c)
                cgt_text_draw(o->font, c, x, y, text, o->color);
            x += cgt_text_width(o->font, text);
            format += length;
        }
        format += taken;
    }
    return x - begin;
}

/* The width of the widest time of all frames. */
static float time_width(const overlay *o)
{
    float widest = 0.0f;
    if (*o->time || !o->extremes)
        return draw_time(o, NULL, 0.0f, 0.0f, *o->time ? o->time : default_time, NULL);
    for (uint32_t i = 0; i < o->extremes; i++)
        widest = fmaxf(widest, draw_time(o, NULL, 0.0f, 0.0f, format_of(o, &o->extreme[i]), NULL));
    return widest;
}

/* ---- Titles ------------------------------------------------------------------------------------------------- */

/* Lines from the upper edge y on, at x, or with their middles there. */
static void draw_lines(const overlay *o, const canvas *c, const layout_text *t, float x, float y, int is_centred)
{
    if (t->count)
        cgt_text_set_size(o->font, t->size);
    for (uint32_t i = 0; i < t->count; i++) {
        const float from = is_centred ? x - 0.5f * cgt_text_width(o->font, t->line[i]) : x;
        cgt_text_draw(o->font, c, from, y + (0.95f + layout_step * (float)i) * t->size, t->line[i], o->color);
    }
}

static void draw_texts(const overlay *o, const canvas *c, const overlay_frame *frame)
{
    const layout_rect *const title = &o->layout.rect[LAYOUT_TITLE], *const time = &o->layout.rect[LAYOUT_TIME];
    const layout_rect *const scale = &o->layout.rect[LAYOUT_SCALE];
    draw_lines(o, c, &o->layout.title, 0.5f * (title->x0 + title->x1), title->y0, 1);
    if (time->x1 <= time->x0)
        return;
    /* Frames that the survey did not look at may have longer numbers. */
    const float end =
        scale->x1 > scale->x0 && scale->y1 > time->y0 ? scale->x0 - o->size : (float)c->width - layout_margin * o->size;
    const float y = (float)c->height - layout_margin * o->size;
    char text[LAYOUT_LINE_SIZE], cut[LAYOUT_LINE_SIZE];
    cgt_text_set_size(o->font, o->layout.size[LAYOUT_TIME]);
    const char *const format = format_of(o, frame);
    if (draw_time(o, NULL, time->x0, y, format, frame) <= end - time->x0 + 1.0f) {
        draw_time(o, c, time->x0, y, format, frame);
        return;
    }
    cgt_overlay_format(format, frame, text, sizeof text);
    cgt_layout_cut(o->font, text, end - time->x0, cut, sizeof cut);
    cgt_text_draw(o->font, c, time->x0, y, cut, o->color);
}

/* ---- Colour bar --------------------------------------------------------------------------------------------- */

/* Where a value lies on the bar, 0 to 1; a tick may be beyond an end by what that is rounded. */
static double share_of(const coloring *k, double value)
{
    const double share =
        k->logarithmic ? log(value / k->min) / log(k->max / k->min) : (value - k->min) / (k->max - k->min);
    return fmin(fmax(share, 0.0), 1.0);
}

enum { MOST_TICKS = 6 };

/* Ticks of the bar, and the numbers at them. */
static uint32_t find_ticks(const overlay *o, uint32_t most, double ticks[MOST_TICKS], number_text texts[MOST_TICKS])
{
    const coloring *const k = o->coloring;
    const uint32_t count = cgt_overlay_ticks(k->min, k->max, k->logarithmic, ticks, most);
    const int digits = count < 2 ? 6
                                 : cgt_number_digits(fmax(fabs(ticks[0]), fabs(ticks[count - 1])),
                                                     ticks[count - 1] - ticks[count - 2]);
    for (uint32_t i = 0; i < count; i++)
        texts[i] = cgt_number(digits, ticks[i]);
    return count;
}

static void draw_ticks(const overlay *o, const canvas *c, float left, float top, float height)
{
    const float size = o->layout.size[LAYOUT_BAR];
    double ticks[MOST_TICKS];
    number_text texts[MOST_TICKS];
    const float most = fminf((float)MOST_TICKS, fmaxf(2.0f, floorf(height / (1.6f * size))));
    const uint32_t count = find_ticks(o, (uint32_t)most, ticks, texts);
    for (uint32_t i = 0; i < count; i++) {
        const float y = top + (1.0f - (float)share_of(o->coloring, ticks[i])) * height;
        cgt_canvas_fill(c, left, y - 0.04f * size, 0.3f * size, 0.08f * size, o->color);
        if (o->font)
            cgt_text_draw(o->font, c, left + layout_tick * size, y + 0.36f * size, texts[i].text, o->color);
    }
}

static void draw_bar(const overlay *o, const canvas *c)
{
    const coloring *k = o->coloring;
    const layout_rect *const map = &o->layout.map, *const all = &o->layout.rect[LAYOUT_BAR];
    const float height = map->y1 - map->y0;
    for (uint32_t row = 0; (float)row < height; row++) {
        const float y = (float)row;
        const float x = 1.0f - (y + 0.5f) / height;
        const uint32_t entry = (uint32_t)(fmaxf(0.0f, x) * (COLORING_STEPS - 1) + 0.5f);
        cgt_canvas_fill(c, map->x0, map->y0 + y, map->x1 - map->x0, 1.0f, k->palette[entry]);
    }
    if (o->font)
        draw_lines(o, c, &o->layout.bar_title, all->x0, all->y0, 0);
    cgt_text_set_size(o->font, o->layout.size[LAYOUT_BAR]);
    draw_ticks(o, c, map->x1, map->y0, height);
}

/* ---- Legend of kinds ---------------------------------------------------------------------------------------- */

/* A ball of the colour, with a rim, so that it is seen on a ground of the same colour. */
static void draw_swatch(const overlay *o, const canvas *c, float x, float y, float size, const float color[3])
{
    const float center[2] = {x, y};
    float rim[3];
    for (int k = 0; k < 3; k++)
        rim[k] = 0.5f * (o->color[k] + color[k]);
    cgt_canvas_line(c, center, center, 0.96f * size, rim);
    cgt_canvas_line(c, center, center, 0.96f * size - fmaxf(1.0f, 0.1f * size), color);
}

static void draw_legend(const overlay *o, const canvas *c)
{
    const layout *const l = &o->layout;
    const layout_rect *const all = &l->rect[LAYOUT_LEGEND];
    const float size = l->size[LAYOUT_LEGEND], indent = layout_indent * size, step = layout_row * size;
    const float top = all->y1 - step * (float)l->rows;
    char more[32], text[sizeof o->kinds->name];
    snprintf(more, sizeof more, "and %" PRIu32 " more", o->kind_count - l->lines);
    if (o->font)
        draw_lines(o, c, &l->legend_title, all->x0, all->y0, 0);
    cgt_text_set_size(o->font, size);
    for (uint32_t i = 0; i < l->lines + (o->kind_count > l->lines); i++) {
        const uint32_t column = i / l->rows, row = i % l->rows;
        const float x = all->x0 + l->column * (float)column, y = top + step * ((float)row + 0.5f);
        if (i < l->lines)
            draw_swatch(o, c, x + 0.5f * size, y, size, o->kinds[i].color);
        if (!o->font)
            continue;
        cgt_layout_cut(o->font, i < l->lines ? o->kinds[i].name : more, l->name_width + 0.5f, text, sizeof text);
        cgt_text_draw(o->font, c, x + indent, y + 0.36f * size, text, o->color);
    }
}

/* ---- Scale bar ---------------------------------------------------------------------------------------------- */

/* A line with ends on the right, its label over it. */
static int draw_scale(const overlay *o, const canvas *c, const overlay_frame *f)
{
    const layout_rect *const all = &o->layout.rect[LAYOUT_SCALE];
    const float most = cgt_scale_bar_share(&o->scale) * (float)c->width, thick = fmaxf(1.0f, roundf(0.12f * o->size));
    float length;
    char label[SCALE_BAR_LABEL];
    if (cgt_scale_bar_find(&o->scale, f->pixel, f->angstrom, most, &length, label))
        return -1;
    const float width = cgt_text_width(o->font, label), middle = all->x1 - 0.5f * fmaxf(length, width);
    const float left = middle - 0.5f * length, y = roundf(all->y1 - 0.4f * o->size), end = 0.25f * o->size;
    cgt_canvas_fill(c, left, y, length, thick, o->color);
    cgt_canvas_fill(c, left, y + 0.5f * thick - end, thick, 2.0f * end, o->color);
    cgt_canvas_fill(c, left + length - thick, y + 0.5f * thick - end, thick, 2.0f * end, o->color);
    cgt_text_draw(o->font, c, middle - 0.5f * width, all->y0 + 0.95f * o->size, label, o->color);
    return 0;
}

/* ---- Axes --------------------------------------------------------------------------------------------------- */

static void draw_axes(const overlay *o, const canvas *c, const overlay_frame *f)
{
    static const float colors[3][3] = {{0.67f, 0.02f, 0.02f}, {0.03f, 0.36f, 0.03f}, {0.02f, 0.16f, 0.60f}};
    const layout_rect *const all = &o->layout.rect[LAYOUT_AXES];
    const float size = o->layout.size[LAYOUT_AXES], length = 2.4f * size,
                origin[2] = {0.5f * (all->x0 + all->x1), 0.5f * (all->y0 + all->y1)};
    int order[3] = {0, 1, 2};
    cgt_text_set_size(o->font, size);
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
        cgt_canvas_line(c, origin, tip, 0.16f * size, colors[a]);
        if (o->font)
            cgt_text_draw(o->font, c, tip[0] + 0.35f * size * f->right[a] - 0.3f * size,
                          tip[1] - 0.45f * size * f->up[a] + 0.3f * size, name, o->color);
    }
}

/* ---- All ---------------------------------------------------------------------------------------------------- */

void cgt_overlay_place(overlay *o, uint32_t width, uint32_t height)
{
    const char *names[OVERLAY_MOST_KINDS];
    layout_input in = {.width = width,
                       .height = height,
                       .font = o->font,
                       .size = o->size,
                       .title = o->title,
                       .legend = o->legend,
                       .names = names,
                       .kind_count = o->kind_count,
                       .axes = o->axes};
    double ticks[MOST_TICKS];
    number_text texts[MOST_TICKS];
    cgt_text_set_size(o->font, o->size);
    in.name_count = o->kind_count < OVERLAY_MOST_KINDS ? o->kind_count : OVERLAY_MOST_KINDS;
    for (uint32_t i = 0; i < in.name_count; i++)
        names[i] = o->kinds[i].name;
    if (o->time && o->font)
        in.time_width = fmaxf(o->size, time_width(o));
    if (o->bar && o->coloring->max > o->coloring->min) {
        in.bar = o->bar;
        for (uint32_t i = find_ticks(o, MOST_TICKS, ticks, texts); o->font && i-- > 0;)
            in.tick_width = fmaxf(in.tick_width, cgt_text_width(o->font, texts[i].text));
    }
    if (o->scale.is_set) {
        char label[SCALE_BAR_LABEL];
        cgt_scale_bar_longest(&o->scale, label);
        in.scale_width = fmaxf(cgt_scale_bar_share(&o->scale) * (float)width, cgt_text_width(o->font, label));
    }
    cgt_layout_make(&in, &o->layout);
}

static int has(const overlay *o, layout_item item) { return o->layout.rect[item].x1 > o->layout.rect[item].x0; }

int cgt_overlay_draw(const overlay *o, const canvas *c, const overlay_frame *frame)
{
    if (has(o, LAYOUT_LEGEND))
        draw_legend(o, c);
    if (has(o, LAYOUT_BAR))
        draw_bar(o, c);
    if (has(o, LAYOUT_AXES))
        draw_axes(o, c, frame);
    if (o->font)
        draw_texts(o, c, frame);
    cgt_text_set_size(o->font, o->size);
    return has(o, LAYOUT_SCALE) ? draw_scale(o, c, frame) : 0;
}

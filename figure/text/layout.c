/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where texts lie on a picture; see layout.h. The title has a strip above, time and scale bar one below, colour bar or
 * legend a column on the right, axes the corner over the time. The scene keeps at least 0.4 of both edges. */
#include "text/layout.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const float gap = 0.4f;   /* between texts, and the scene, in sizes */
static const float share = 0.4f; /* of an edge: what texts take from one side at most, and what is left at least */
static const float least = 7.0f; /* pixels of a font that can be read */

/* ---- Texts in lines ------------------------------------------------------------------------------------------- */

static float width_of(const text_font *font, const char *text) { return font ? cgt_text_width(font, text) : 0.0f; }

static size_t fit(const text_font *font, const char *text, float width)
{
    return font ? cgt_text_fit(font, text, width) : strlen(text);
}

int cgt_layout_cut(const text_font *font, const char *text, float width, char *to, size_t size)
{
    size_t bytes = fit(font, text, width);
    const int is_cut = text[bytes] != '\0' || bytes >= size;
    if (is_cut) {
        bytes = fit(font, text, fmaxf(0.0f, width - width_of(font, "...")));
        while (bytes + 4 > size || (bytes && ((unsigned char)text[bytes] & 0xc0) == 0x80)) /* whole characters */
            bytes--;
        while (bytes && text[bytes - 1] == ' ')
            bytes--;
    }
    snprintf(to, size, "%.*s%s", (int)bytes, text, is_cut ? "..." : "");
    return is_cut;
}

/* Wraps a text to at most so many lines, at blanks. Returns 0, or -1 where it does not fit; with `cuts` the last line
 * is cut then. */
static int wrap(const text_font *font, const char *text, float width, uint32_t most, int cuts, layout_text *lines)
{
    lines->count = 0;
    lines->width = 0.0f;
    lines->is_cut = 0;
    if (cuts && width_of(font, "...") > width)
        return -1;
    while (*text) {
        char *const line = lines->line[lines->count];
        size_t bytes = fit(font, text, width);
        const int is_last = lines->count + 1 == most;
        if (text[bytes] != '\0') { /* back to a blank */
            const size_t whole = bytes;
            while (bytes && text[bytes] != ' ')
                bytes--;
            if (!bytes && !cuts)
                return -1;
            bytes = bytes ? bytes : whole;
        }
        if (text[bytes] != '\0' && is_last) {
            if (!cuts)
                return -1;
            bytes = strlen(text);
        }
        if (bytes >= LAYOUT_LINE_SIZE && !cuts)
            return -1;
        if (is_last || bytes >= LAYOUT_LINE_SIZE) {
            lines->is_cut |= cgt_layout_cut(font, text, width, line, LAYOUT_LINE_SIZE);
            bytes = is_last ? strlen(text) : bytes;
        } else {
            memcpy(line, text, bytes);
            line[bytes] = '\0';
        }
        lines->width = fmaxf(lines->width, width_of(font, line));
        lines->count++;
        if (!bytes) /* not even one character fits */
            break;
        for (text += bytes; *text == ' ';)
            text++;
    }
    return 0;
}

typedef struct attempt {
    uint32_t lines;
    float scale;
} attempt;

/* Takes the first form of a text that fits; the last ones are cut. Returns 0, or -1 where not even those are low
 * enough. */
static int set_text(const layout_input *in, const char *text, float width, float height, layout_text *lines)
{
    static const attempt attempts[] = {{1, 1.0f}, {1, 0.85f}, {2, 1.0f}, {2, 0.85f}, {3, 0.7f}, {2, 0.7f}, {1, 0.7f}};
    for (int cuts = 0; cuts < 2; cuts++)
        for (size_t i = cuts ? 4 : 0; i < sizeof attempts / sizeof attempts[0]; i++) {
            lines->size = fmaxf(fminf(least, in->size), attempts[i].scale * in->size);
            cgt_text_set_size(in->font, lines->size);
            if (layout_step * lines->size * (float)attempts[i].lines <= height &&
                wrap(in->font, text, width, attempts[i].lines, cuts, lines) == 0)
                return 0;
        }
    lines->count = 0;
    return -1;
}

/* ---- Strips above and below ------------------------------------------------------------------------------------ */

/* What is not taken yet. */
typedef struct area {
    float top, bottom, right;
} area;

static void leave_out(layout *l, layout_item item) { l->left_out |= 1u << item; }

static void place_title(const layout_input *in, layout *l, area *a)
{
    const float edge = layout_margin * in->size, middle = 0.5f * (float)in->width;
    const float height = share * (float)in->height - edge;
    if (!in->title || !*in->title)
        return;
    if (set_text(in, in->title, (float)in->width - 2.0f * edge, height, &l->title)) {
        leave_out(l, LAYOUT_TITLE);
        return;
    }
    l->cut |= (uint32_t)l->title.is_cut << LAYOUT_TITLE;
    const float y = 0.75f * in->size, bottom = y + layout_step * l->title.size * (float)l->title.count;
    l->size[LAYOUT_TITLE] = l->title.size;
    l->rect[LAYOUT_TITLE] = (layout_rect){middle - 0.5f * l->title.width, y, middle + 0.5f * l->title.width, bottom};
    a->top = bottom + gap * in->size;
}

/* Time on the left, the scale bar on the right, or above it where both are too wide. */
static void place_below(const layout_input *in, layout *l, area *a)
{
    const float edge = layout_margin * in->size, width = (float)in->width - 2.0f * edge;
    const float height = (float)in->height, limit = fmaxf((1.0f - share) * height, a->top + share * height);
    const float time_top = height - edge - in->size, end = height - edge + 0.3f * in->size;
    float size = in->size;
    if (in->time_width > 0.0f && (time_top - gap * in->size < limit || width < 2.0f * in->size))
        leave_out(l, LAYOUT_TIME);
    else if (in->time_width > 0.0f) {
        if (in->time_width > width)
            size = fmaxf(fminf(least, in->size), fmaxf(0.7f, width / in->time_width) * in->size);
        const float needed = in->time_width * size / in->size;
        l->cut |= (uint32_t)(needed > 1.001f * width) << LAYOUT_TIME;
        l->size[LAYOUT_TIME] = size;
        l->rect[LAYOUT_TIME] = (layout_rect){edge, time_top, edge + fminf(needed, width), end};
        a->bottom = time_top - gap * in->size;
    }
    if (!(in->scale_width > 0.0f))
        return;
    const layout_rect *const time = &l->rect[LAYOUT_TIME];
    const int is_beside = time->x1 + in->size + in->scale_width <= (float)in->width - edge;
    const float bottom = is_beside ? end : a->bottom, top = bottom - 2.0f * in->size;
    if (top - gap * in->size < limit || in->scale_width > width) {
        leave_out(l, LAYOUT_SCALE);
        return;
    }
    l->size[LAYOUT_SCALE] = in->size;
    l->rect[LAYOUT_SCALE] =
        (layout_rect){(float)in->width - edge - in->scale_width, top, (float)in->width - edge, bottom};
    a->bottom = fminf(a->bottom, top - gap * in->size);
}

/* ---- The column on the right ------------------------------------------------------------------------------------ */

/* How wide the bar and its numbers are, in the largest letters that fit; 0: in none. */
static float choose_bar(const layout_input *in, float most, float *size)
{
    static const float scales[] = {1.0f, 1.0f, 0.85f, 0.7f};
    for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++) {
        *size = fmaxf(fminf(least, in->size), scales[i] * in->size);
        const float needed = (layout_bar + layout_tick) * *size + in->tick_width * *size / in->size;
        const float width = i ? needed : fmaxf(4.6f * *size, needed); /* the same for numbers of usual lengths */
        if (width <= most)
            return width;
    }
    return 0.0f;
}

/* The bar takes half of the height, in whole pixels: two rows that share one would let the ground shine through. */
static void place_bar(const layout_input *in, layout *l, area *a)
{
    const float edge = layout_margin * in->size, height = (float)in->height;
    const float most = a->right - (1.0f - share) * (float)in->width - edge - gap * in->size;
    const float above = fmaxf(a->top, edge), below = fminf(a->bottom, height - edge);
    layout_text *const title = &l->bar_title;
    float size, title_height = 0.0f, column = choose_bar(in, most, &size);
    if (column <= 0.0f || below - above < 3.0f * size) {
        leave_out(l, LAYOUT_BAR);
        return;
    }
    if (*in->bar) {
        const float wide = fmaxf(column, fminf(most, 0.25f * (float)in->width));
        if (set_text(in, in->bar, wide, 0.5f * (below - above), title))
            l->cut |= 1u << LAYOUT_BAR;
        l->cut |= (uint32_t)title->is_cut << LAYOUT_BAR;
        column = fmaxf(column, title->width);
        title_height = layout_step * title->size * (float)title->count;
    }
    const float x0 = roundf(a->right - edge - column);
    const float top = roundf(fmaxf(0.25f * height, above + title_height + 0.4f * size));
    const float bottom = top + roundf(fminf(0.5f * height, below - 0.4f * size - top));
    if (bottom - top < 2.0f * size) {
        leave_out(l, LAYOUT_BAR);
        title->count = 0;
        return;
    }
    l->size[LAYOUT_BAR] = size;
    l->map = (layout_rect){x0, top, x0 + roundf(layout_bar * size), bottom};
    l->rect[LAYOUT_BAR] = (layout_rect){x0, top - title_height - 0.4f * size, x0 + column, bottom + 0.4f * size};
    a->right = x0 - gap * in->size;
}

/* Sets the legend's size and columns for an attempt. Returns whether all has a place. */
static int try_legend(const layout_input *in, layout *l, uint32_t columns, float scale, float width, float height)
{
    const float size = fmaxf(fminf(least, in->size), scale * in->size);
    const uint32_t more = in->kind_count > in->name_count, lines = in->name_count + more;
    float names = 0.0f;
    char text[32];
    cgt_text_set_size(in->font, size);
    for (uint32_t i = 0; i < in->name_count; i++)
        names = fmaxf(names, width_of(in->font, in->names[i]));
    snprintf(text, sizeof text, "and %" PRIu32 " more", in->kind_count);
    if (more)
        names = fmaxf(names, width_of(in->font, text));
    l->size[LAYOUT_LEGEND] = size;
    l->rows = (lines + columns - 1) / columns;
    l->lines = in->name_count;
    l->name_width = names;
    l->column = layout_indent * size + names + size;
    return l->column * (float)columns - size <= width && layout_row * size * (float)l->rows <= height;
}

/* As many lines as there is room for, in small letters, with names cut short. Returns 0, or -1: there is none. */
static int cut_legend(const layout_input *in, layout *l, float width, float height)
{
    try_legend(in, l, 1, 0.7f, width, height);
    const float size = l->size[LAYOUT_LEGEND], room = width - layout_indent * size;
    const uint32_t rows = (uint32_t)fmaxf(0.0f, floorf(height / (layout_row * size)));
    if (rows < 1 || room < 2.0f * size)
        return -1;
    if (l->name_width > room) {
        l->name_width = room;
        l->column = width + size;
    }
    const uint32_t columns = (uint32_t)fmaxf(1.0f, floorf((width + size) / l->column));
    const uint32_t places = rows < in->kind_count ? rows * columns : in->kind_count;
    l->rows = places < in->kind_count ? rows : (in->kind_count + columns - 1) / columns;
    l->lines = places < in->kind_count || in->kind_count > in->name_count ? places - 1 : places;
    l->lines = l->lines < in->name_count ? l->lines : in->name_count;
    const uint32_t lines = l->lines + (in->kind_count > l->lines);
    l->rows = l->rows < lines ? l->rows : lines;
    l->cut |= 1u << LAYOUT_LEGEND;
    return l->lines ? 0 : -1;
}

static void place_legend(const layout_input *in, layout *l, area *a)
{
    static const attempt attempts[] = {{1, 1.0f},  {1, 0.85f}, {2, 1.0f}, {2, 0.85f},
                                       {3, 0.85f}, {1, 0.7f},  {2, 0.7f}, {3, 0.7f}};
    const float edge = layout_margin * in->size;
    const float most = a->right - (1.0f - share) * (float)in->width - edge - gap * in->size;
    const float above = fmaxf(a->top, edge), below = fminf(a->bottom, (float)in->height - edge);
    layout_text *const title = &l->legend_title;
    float title_height = 0.0f;
    int fits = 0;
    if (*in->legend) {
        if (set_text(in, in->legend, most, 0.3f * (below - above), title))
            l->cut |= 1u << LAYOUT_LEGEND;
        l->cut |= (uint32_t)title->is_cut << LAYOUT_LEGEND;
        title_height = layout_step * title->size * (float)title->count + (title->count ? 0.2f * in->size : 0.0f);
    }
    for (size_t i = 0; i < sizeof attempts / sizeof attempts[0] && !fits; i++)
        fits = try_legend(in, l, attempts[i].lines, attempts[i].scale, most, below - above - title_height);
    if (!fits && cut_legend(in, l, most, below - above - title_height)) {
        leave_out(l, LAYOUT_LEGEND);
        title->count = l->lines = 0;
        return;
    }
    const float size = l->size[LAYOUT_LEGEND];
    const uint32_t lines = l->lines + (in->kind_count > l->lines), columns = (lines + l->rows - 1) / l->rows;
    const float width = fmaxf(title->width, l->column * (float)columns - size);
    const float height = title_height + layout_row * size * (float)l->rows;
    const float x0 = a->right - edge - width;
    const float y0 = fminf(fmaxf(0.5f * ((float)in->height - height), above), below - height);
    l->rect[LAYOUT_LEGEND] = (layout_rect){x0, y0, x0 + width, y0 + height};
    a->right = x0 - gap * in->size;
}

/* ---- All -------------------------------------------------------------------------------------------------------- */

/* In the corner above the time. The scene is on their right, or above them. */
static void place_axes(const layout_input *in, layout *l, const area *a)
{
    static const float scales[] = {1.0f, 0.85f, 0.7f};
    const float width = (float)in->width, height = (float)in->height;
    for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++) {
        const float edge = 2.0f * layout_axes * scales[i] * in->size, y = a->bottom - edge;
        const int has_right = edge <= share * width && a->right - edge >= share * width && y >= a->top;
        const int has_above = y >= (1.0f - share) * height && y - a->top >= share * height && edge <= a->right;
        if (!has_right && !has_above)
            continue;
        l->size[LAYOUT_AXES] = scales[i] * in->size;
        l->rect[LAYOUT_AXES] = (layout_rect){0.0f, y, edge, a->bottom};
        if (has_right)
            l->room[l->rooms++] = (layout_rect){edge, a->top, a->right, a->bottom};
        if (has_above)
            l->room[l->rooms++] = (layout_rect){0.0f, a->top, a->right, y};
        return;
    }
    leave_out(l, LAYOUT_AXES);
}

void cgt_layout_make(const layout_input *in, layout *l)
{
    area a = {0.0f, (float)in->height, (float)in->width};
    memset(l, 0, sizeof *l);
    place_title(in, l, &a);
    place_below(in, l, &a);
    if (in->bar)
        place_bar(in, l, &a);
    if (in->legend && in->kind_count)
        place_legend(in, l, &a);
    if (in->axes)
        place_axes(in, l, &a);
    if (!l->rooms)
        l->room[l->rooms++] = (layout_rect){0.0f, a.top, a.right, a.bottom};
    cgt_text_set_size(in->font, in->size);
}

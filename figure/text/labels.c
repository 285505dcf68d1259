/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Labels on pictures; see labels.h. */
#include "text/labels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int compare_depths(const void *a, const void *b)
{
    const text_label *const p = a, *const q = b;
    if (p->depth != q->depth)
        return p->depth < q->depth ? -1 : 1;
    return (p->text > q->text) - (p->text < q->text); /* texts are in the order of an array */
}

static int overlap(const layout_rect *a, const layout_rect *b)
{
    return a->x0 < b->x1 && b->x0 < a->x1 && a->y0 < b->y1 && b->y0 < a->y1;
}

static int is_free(const overlay *o, const canvas *c, const layout_rect *r, const layout_rect *taken, uint32_t count)
{
    if (r->x0 < 0.0f || r->y0 < 0.0f || r->x1 > (float)c->width || r->y1 > (float)c->height)
        return 0;
    for (int i = 0; i < LAYOUT_ITEMS; i++)
        if (overlap(r, &o->layout.rect[i]))
            return 0;
    for (uint32_t i = 0; i < count; i++)
        if (overlap(r, &taken[i]))
            return 0;
    return 1;
}

/* The first free place of a label: on what it names, to its right or left, above or below it. */
static int find_place(const overlay *o, const canvas *c, const text_label *label, float width, float height,
                      const layout_rect *taken, uint32_t count, layout_rect *place)
{
    static const float sides[5][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, -1}, {0, 1}};
    for (int side = 0; side < 5; side++) {
        const float x = label->x + sides[side][0] * (label->radius + 0.5f * width);
        const float y = label->y + sides[side][1] * (label->radius + 0.5f * height);
        *place = (layout_rect){x - 0.5f * width, y - 0.5f * height, x + 0.5f * width, y + 0.5f * height};
        if (is_free(o, c, place, taken, count))
            return 1;
    }
    return 0;
}

/* With a rim of the opposite grey: labels lie over all colours. */
static void draw_label(const overlay *o, const canvas *c, const char *text, float x, float y, float size)
{
    const float grey = o->color[0] > 0.5f ? 0.01f : 0.85f, rim[3] = {grey, grey, grey};
    cgt_text_draw_rim(o->font, c, x, y, text, (uint32_t)fmaxf(1.0f, roundf(0.07f * size)), rim);
    cgt_text_draw(o->font, c, x, y, text, o->color);
}

uint32_t cgt_labels_draw(const overlay *o, const canvas *c, text_label *labels, uint32_t count)
{
    const float size = fmaxf(fminf(7.0f, o->size), 0.85f * o->size), height = 1.2f * size;
    layout_rect *const taken = malloc((count + 1) * sizeof *taken);
    uint32_t placed = 0, seen = 0;
    if (!taken)
        return count;
    qsort(labels, count, sizeof *labels, compare_depths);
    cgt_text_set_size(o->font, size);
    for (uint32_t i = 0; i < count; i++) {
        const text_label *const label = &labels[i];
        layout_rect *const place = &taken[placed];
        if (!(label->x >= 0.0f && label->y >= 0.0f && label->x < (float)c->width && label->y < (float)c->height) ||
            !*label->text)
            continue;
        seen++;
        const float width = cgt_text_width(o->font, label->text) + 0.4f * size;
        if (!find_place(o, c, label, width, height, taken, placed, place))
            continue;
        placed++;
        draw_label(o, c, label->text, place->x0 + 0.2f * size, place->y0 + 0.95f * size, size);
    }
    free(taken);
    cgt_text_set_size(o->font, o->size);
    return seen - placed;
}

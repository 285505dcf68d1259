/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Colours and names that options give to types, elements and categories, and colours of figures; see figure_scene.h. */
#include <string.h>

#include "figure_state.h"

static void set_color(cgt_figure *figure, uint32_t entry, const uint8_t srgb[3])
{
    for (int c = 0; c < 3; c++)
        figure->parts.palette[entry][c] = cgt_srgb_to_linear((float)srgb[c] / 255.0f);
}

/* The kind that the colours have under this name. Returns 0, or -1: they have none such. */
static int find_kind(const coloring *c, const particle_kind *kind, int64_t *number)
{
    *number = kind->kind;
    if (c->by == COLORING_CATEGORY)
        return cgt_categories_find(c->categories, kind->text, strcspn(kind->text, "="), number);
    return kind->is_word || c->by != (kind->is_element ? COLORING_ELEMENT : COLORING_TYPE) ? -1 : 0;
}

static void color_kinds(cgt_figure *figure)
{
    const particle_options *const o = &figure->options.particles;
    coloring *const c = &figure->coloring;
    for (uint32_t i = 0; i < o->color_count; i++) {
        const particle_kind *const kind = &o->colors[i];
        int64_t number;
        if (find_kind(c, kind, &number) == 0)
            cgt_coloring_set_kind(c, number, kind->value);
        else if (c->by == COLORING_CATEGORY)
            cgt_notices_add(&figure->notices, "--type-color: the colours tell nothing apart that is called \"%.*s\"",
                            (int)strcspn(kind->text, "="), kind->text);
        else
            cgt_notices_add(&figure->notices, "--type-color: the colours are not those of %s: see --color",
                            kind->is_word      ? "words"
                            : kind->is_element ? "elements"
                                               : "types");
    }
}

const char *cgt_figure_name_of(const cgt_figure *figure, int64_t number)
{
    const particle_options *const o = &figure->options.particles;
    const char *name = NULL;
    for (uint32_t i = 0; i < o->name_count; i++) {
        int64_t named;
        if (find_kind(&figure->coloring, &o->names[i].kind, &named) == 0 && named == number)
            name = o->names[i].name;
    }
    return name;
}

void cgt_figure_scene_color(cgt_figure *figure)
{
    const particle_options *o = &figure->options.particles;
    const uint8_t *back = figure->options.picture.background;
    const uint8_t edge = back[0] + back[1] + back[2] > 384 ? 70 : 190; /* dark on light, light on dark */
    color_kinds(figure);
    memcpy(figure->parts.palette, figure->coloring.palette, sizeof figure->coloring.palette);
    set_color(figure, FIGURE_BOX, (const uint8_t[]){edge, edge, edge});
    set_color(figure, FIGURE_BOND, o->bond_color);
    set_color(figure, FIGURE_ARROW, o->arrow_color);
    set_color(figure, FIGURE_MESH, o->mesh_color);
    set_color(figure, FIGURE_TRAIL, o->trail_color);
    const floor_options *floor = &figure->options.floor;
    const uint8_t grey = back[0] + back[1] + back[2] > 384 ? 240 : 120;
    set_color(figure, FIGURE_FLOOR, floor->has_color ? floor->color : (const uint8_t[]){grey, grey, grey});
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tells of options that were given and change nothing. What is told is certain, whatever other frames have. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "figure_state.h"

/* ---- What an option is about ---------------------------------------------------------------------------------- */

typedef enum unused_need {
    NEEDS_BONDS,
    NEEDS_ARROWS,
    NEEDS_TRAILS,
    NEEDS_MESH,
    NEEDS_VALUES,
    NEEDS_NO_BOUNCES
} unused_need;

static const char *const reasons[] = {
    [NEEDS_BONDS] = "no bonds are drawn",
    [NEEDS_ARROWS] = "no arrows are drawn",
    [NEEDS_TRAILS] = "no trails are drawn",
    [NEEDS_MESH] = "no mesh stands among the spheres",
    [NEEDS_VALUES] = "the colours are not those of values",
    [NEEDS_NO_BOUNCES] = "--bounces has hard shadows and no occlusion",
};

static const struct {
    const char *name;
    unused_need needs;
} options[] = {
    {"bond-radius", NEEDS_BONDS},         {"bond-color", NEEDS_BONDS},
    {"arrow-scale", NEEDS_ARROWS},        {"arrow-radius", NEEDS_ARROWS},
    {"arrow-color", NEEDS_ARROWS},        {"trail-radius", NEEDS_TRAILS},
    {"trail-color", NEEDS_TRAILS},        {"mesh-opacity", NEEDS_MESH},
    {"mesh-color", NEEDS_MESH},           {"range", NEEDS_VALUES},
    {"colormap", NEEDS_VALUES},           {"ambient", NEEDS_NO_BOUNCES},
    {"ambient-radius", NEEDS_NO_BOUNCES}, {"light-size", NEEDS_NO_BOUNCES},
    {"light-samples", NEEDS_NO_BOUNCES},
};

static int has(const cgt_figure *figure, unused_need need)
{
    const particle_options *const p = &figure->options.particles;
    switch (need) {
    case NEEDS_BONDS: return p->bonds;
    case NEEDS_ARROWS: return p->arrows != NULL;
    case NEEDS_TRAILS: return p->trails > 0;
    case NEEDS_MESH: return figure->parts.mesh_entries != NULL;
    case NEEDS_VALUES: return cgt_coloring_has_range(&figure->coloring);
    default: return !figure->options.bounce.is_set;
    }
}

/* ---- Types ------------------------------------------------------------------------------------------------------ */

/* Options whose values begin with types or elements, with commas between several: 2,3 or 2=red. */
static const char *const of_types[] = {"hide", "opacity", "type-radius", "type-color", "type-element"};

static int is_no_type(const survey *s, uint64_t type)
{
    return s->has_type && (type < s->type_min || type > s->type_max);
}

static void tell_types(cgt_figure *figure, const char *name, const char *value)
{
    while (value && *value) {
        const size_t digits = strspn(value, "0123456789");
        const char after = value[digits];
        const uint64_t type = digits && digits < 10 ? strtoull(value, NULL, 10) : 0;
        if (digits && digits < 10 && (after == '\0' || after == ',' || after == '=') &&
            is_no_type(&figure->survey, type))
            cgt_notices_add(&figure->notices,
                            "--%s: nothing is of type %" PRIu64 " in what was looked at, %" PRIu64 " %s", name, type,
                            figure->survey.frames, figure->survey.frames == 1 ? "frame" : "frames");
        value += strcspn(value, ",");
        value += *value == ',';
    }
}

/* ---- All --------------------------------------------------------------------------------------------------------- */

static void tell_setting(cgt_figure *figure, const figure_setting *s)
{
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++)
        if (strcmp(s->name, options[i].name) == 0 && !has(figure, options[i].needs) &&
            !(s->value && strcmp(s->value, "0") == 0)) /* which asks for nothing */
            cgt_notices_add(&figure->notices, "--%s: %s: it changes nothing", s->name, reasons[options[i].needs]);
    for (size_t i = 0; i < sizeof of_types / sizeof of_types[0]; i++)
        if (strcmp(s->name, of_types[i]) == 0 &&
            (figure->coloring.by == COLORING_TYPE || strcmp(s->name, "type-color") != 0)) /* else that is told */
            tell_types(figure, s->name, s->value);
}

void cgt_figure_tell_unused(cgt_figure *figure)
{
    const int is_told = figure->has_unused_told;
    figure->has_unused_told = 1;
    for (size_t i = 0; i < figure->given.count && !is_told; i++)
        tell_setting(figure, &figure->given.list[i]);
}

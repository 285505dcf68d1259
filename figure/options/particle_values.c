/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Values of options about what is drawn and what it is made of; see figure_values.h. */
#include "options/figure_values.h"

#include <stdio.h>
#include <string.h>

#include "options/numbers.h"
#include "options/option_row.h"
#include "data/molecule/element_symbols.h"

/* ---- Which spheres ------------------------------------------------------------------------------------------- */

/* Adds a condition to those that a sphere must meet. */
int cgt_parse_show(const char *text, void *to, char *error, size_t size)
{
    particle_options *o = to;
    expression *formula = cgt_expression_parse(text, error, size);
    const size_t used = strlen(o->show);
    if (!formula)
        return -1;
    cgt_expression_free(formula);
    const int length = snprintf(o->show + used, sizeof o->show - used, "%s(%s)", used ? " && " : "", text);
    if (length < 0 || (size_t)length >= sizeof o->show - used) {
        o->show[used] = '\0';
        snprintf(error, size, "the conditions are too long together");
        return -1;
    }
    return 0;
}

/* Types and elements with commas between them: 1 done, 0 not such a list, -1. */
static int hide_kinds(const char *text, void *to, char *error, size_t size)
{
    char name[32], condition[64];
    for (int adds = 0; adds < 2; adds++)
        for (const char *at = text, *end; at; at = *end ? end + 1 : NULL) {
            uint32_t kind = 0;
            end = at + strcspn(at, ",");
            const size_t length = (size_t)(end - at);
            if (length == 0 || length >= sizeof name)
                return 0;
            memcpy(name, at, length);
            name[length] = '\0';
            const uint32_t element = element_named(name);
            if (!element && cgt_read_u32(name, 0, UINT32_MAX, &kind, error, size))
                return 0;
            snprintf(condition, sizeof condition, element ? "element != %u" : "type != %u", element ? element : kind);
            if (adds && cgt_parse_show(condition, to, error, size))
                return -1;
        }
    return 1;
}

int cgt_parse_hide(const char *text, void *to, char *error, size_t size)
{
    char condition[2048];
    const int done = hide_kinds(text, to, error, size);
    if (done)
        return done > 0 ? 0 : -1;
    expression *const formula = cgt_expression_parse(text, error, size); /* so that an error shows what was given */
    if (!formula)
        return -1;
    cgt_expression_free(formula);
    if (snprintf(condition, sizeof condition, "!(%s)", text) >= (int)sizeof condition) {
        snprintf(error, size, "the formula is too long");
        return -1;
    }
    return cgt_parse_show(condition, to, error, size);
}

int cgt_parse_slice(const char *text, void *to, char *error, size_t size)
{
    double v[4];
    char condition[256];
    if (cgt_read_doubles(text, 4, v, error, size))
        return -1;
    snprintf(condition, sizeof condition, "%s * x + %s * y + %s * z <= %s", cgt_number(17, v[0]).text,
             cgt_number(17, v[1]).text, cgt_number(17, v[2]).text, cgt_number(17, v[3]).text);
    return cgt_parse_show(condition, to, error, size);
}

int cgt_parse_cut(const char *text, void *to, char *error, size_t size)
{
    double v[6];
    char condition[256];
    if (cgt_read_doubles(text, 6, v, error, size))
        return -1;
    if (v[0] > v[3] || v[1] > v[4] || v[2] > v[5]) {
        snprintf(error, size, "\"%s\": the first corner is not below the second", text);
        return -1;
    }
    snprintf(condition, sizeof condition, "x >= %s && y >= %s && z >= %s && x <= %s && y <= %s && z <= %s",
             cgt_number(17, v[0]).text, cgt_number(17, v[1]).text, cgt_number(17, v[2]).text, cgt_number(17, v[3]).text,
             cgt_number(17, v[4]).text, cgt_number(17, v[5]).text);
    return cgt_parse_show(condition, to, error, size);
}

/* Checks a formula that is parsed again where it is used. */
int cgt_parse_formula(const char *text, void *to, char *error, size_t size)
{
    expression *e = cgt_expression_parse(text, error, size);
    if (!e)
        return -1;
    cgt_expression_free(e);
    *(const char **)to = text;
    return 0;
}

int cgt_parse_images(const char *text, void *to, char *error, size_t size)
{
    uint32_t *images = to;
    float v[3];
    if (cgt_read_floats(text, 3, v, error, size))
        return -1;
    for (int c = 0; c < 3; c++)
        if (!(v[c] >= 1.0f && v[c] <= 100.0f) || v[c] != (float)(uint32_t)v[c]) {
            snprintf(error, size, "\"%s\" is not three whole numbers from 1 to 100", text);
            return -1;
        }
    for (int c = 0; c < 3; c++)
        images[c] = (uint32_t)v[c];
    return 0;
}

int cgt_parse_floor(const char *text, void *to, char *error, size_t size)
{
    floor_options *o = to;
    o->has_color = 1;
    return cgt_parse_color(text, o->color, error, size);
}

int cgt_parse_floor_place(const char *text, void *to, char *error, size_t size)
{
    const double *const place = to;
    if (cgt_read_doubles(text, 4, to, error, size))
        return -1;
    if (place[3] > 0.0)
        return 0;
    snprintf(error, size, "the extent must be above 0");
    return -1;
}

/* ---- Types --------------------------------------------------------------------------------------------------- */

enum { TYPE_SIZE = 64 }; /* as long as words of columns are */

static int is_type(const char *name)
{
    return (*name && strspn(name, "0123456789") == strlen(name)) || element_named(name);
}

/* A type's number, or the symbol of an element. nor: what else it may be, for the sentence. */
static int parse_type(const char *name, const char *nor, int *is_element, uint32_t *kind, char *error, size_t size)
{
    *is_element = name[0] < '0' || name[0] > '9';
    if (!*is_element)
        return cgt_read_u32(name, 0, UINT32_MAX, kind, error, size);
    *kind = element_named(name);
    if (*kind)
        return 0;
    snprintf(error, size, "\"%s\" is neither a type's number nor a chemical element%s", name, nor);
    return -1;
}

/* TYPE=VALUE: copies the type. Returns the value, or NULL with a sentence. */
static const char *split_type(const char *text, const char *form, char name[TYPE_SIZE], char *error, size_t size)
{
    const char *value = cgt_split(text, '=', name, TYPE_SIZE);
    if (value && *name)
        return value;
    snprintf(error, size, "\"%s\" is not of the form %s", text, form);
    return NULL;
}

static int refuse_more(uint32_t most, char *error, size_t size)
{
    snprintf(error, size, "more than %u types", most);
    return -1;
}

/* TYPE=VALUE: sets the kind. may_be_word: it may also be a category, whose words the data tell: others are refused by
 * cgt_figure_options_finish. Returns the value, or NULL with a sentence. */
static const char *parse_kind(const char *text, int may_be_word, particle_kind *kind, uint32_t count, char *error,
                              size_t size)
{
    char name[TYPE_SIZE];
    if (count == PARTICLE_KINDS && refuse_more(PARTICLE_KINDS, error, size))
        return NULL;
    const char *const value = split_type(text, "TYPE=VALUE", name, error, size);
    if (!value)
        return NULL;
    kind->text = text;
    kind->is_word = may_be_word && !is_type(name);
    return kind->is_word || parse_type(name, "", &kind->is_element, &kind->kind, error, size) == 0 ? value : NULL;
}

int cgt_parse_type_radius(const char *text, void *to, char *error, size_t size)
{
    particle_options *o = to;
    particle_kind kind;
    const char *value = parse_kind(text, 0, &kind, o->radius_count, error, size);
    if (!value || cgt_read_float(value, 0.0f, 1e30f, &kind.value[0], error, size))
        return -1;
    o->radii[o->radius_count++] = kind;
    return 0;
}

int cgt_parse_type_color(const char *text, void *to, char *error, size_t size)
{
    particle_options *o = to;
    particle_kind kind;
    uint8_t rgb[3];
    const char *value = parse_kind(text, 1, &kind, o->color_count, error, size);
    if (!value || cgt_parse_color(value, rgb, error, size))
        return -1;
    for (int c = 0; c < 3; c++)
        kind.value[c] = (float)rgb[c] / 255.0f;
    o->colors[o->color_count++] = kind;
    return 0;
}

int cgt_parse_type_name(const char *text, void *to, char *error, size_t size)
{
    particle_options *o = to;
    particle_name name;
    name.name = parse_kind(text, 1, &name.kind, o->name_count, error, size);
    if (!name.name)
        return -1;
    o->names[o->name_count++] = name;
    return 0;
}

/* TYPE=ELEMENT, several with commas between them. */
int cgt_parse_type_element(const char *text, void *to, char *error, size_t size)
{
    particle_options *o = to;
    atom_type next[FRAME_ATOM_TYPES];
    uint32_t count = o->type_count;
    char item[OPTION_ITEM_SIZE], type[TYPE_SIZE];
    memcpy(next, o->types, sizeof next);
    while (cgt_option_next(&text, item)) {
        if (count == FRAME_ATOM_TYPES)
            return refuse_more(FRAME_ATOM_TYPES, error, size);
        atom_type *const added = &next[count];
        const char *const symbol = split_type(item, "TYPE=ELEMENT", type, error, size);
        if (!symbol || cgt_read_u32(type, 0, UINT32_MAX, &added->type, error, size))
            return -1;
        added->element = (uint8_t)element_named(symbol);
        if (!added->element)
            return cgt_refuse(error, size, "\"%s\" is no chemical element", symbol);
        count++;
    }
    memcpy(o->types, next, sizeof next);
    o->type_count = count;
    return 0;
}

/* ---- Opacity ------------------------------------------------------------------------------------------------- */

/* Adds a condition, which is 0 or 1, to those that tell a sphere's layer: the last that holds counts, since its number
 * is the greatest. Left to right, so that many of them take no more of an expression's stack. */
static int add_layer(particle_options *o, const char *condition, uint32_t layer, char *error, size_t size)
{
    char formula[sizeof o->opacity];
    const unsigned number = PARTICLE_LAYER_STEP * (o->opacity_count + 1) + layer;
    const int length =
        snprintf(formula, sizeof formula, "max(%s, (%s) * %u)", *o->opacity ? o->opacity : "0", condition, number);
    expression *const all =
        length > 0 && (size_t)length < sizeof formula ? cgt_expression_parse(formula, error, size) : NULL;
    if (!all)
        return cgt_refuse(error, size, "these are too many conditions together");
    cgt_expression_free(all);
    memcpy(o->opacity, formula, sizeof formula);
    o->opacity_count++;
    return 0;
}

/* WHAT=SHARE: a type, an element or a formula, whose spheres go to the layer of the share; those for which a formula is
 * NaN do not. */
int cgt_parse_opacity(const char *text, void *to, char *error, size_t size)
{
    particle_options *o = to;
    char what[1024], condition[1100];
    const char *const mark = strrchr(text, '=');
    const size_t length = mark ? (size_t)(mark - text) : 0;
    float share;
    if (length == 0 || length >= sizeof what)
        return cgt_refuse(error, size, "\"%.80s\" is not of the form WHAT=SHARE", text);
    memcpy(what, text, length);
    what[length] = '\0';
    if (cgt_read_float(mark + 1, 0.001f, 1.0f, &share, error, size))
        return -1;
    const uint32_t layer = cgt_particle_options_layer(o, share);
    if (layer == UINT32_MAX)
        return cgt_refuse(error, size, "more than %d opacities", CGT_PICTURE_MAX_LAYERS);
    if (strcmp(what, "bonds") == 0) {
        o->has_bond_layer = 1;
        o->bond_layer = layer;
        return 0;
    }
    const uint32_t element = element_named(what);
    if (element)
        snprintf(condition, sizeof condition, "element == %u", (unsigned)element);
    else if (is_type(what))
        snprintf(condition, sizeof condition, "type == %s", what);
    if (element || is_type(what))
        return add_layer(o, condition, layer, error, size);
    expression *const given = cgt_expression_parse(what, error, size); /* so that an error shows what was given */
    if (!given)
        return -1;
    cgt_expression_free(given);
    snprintf(condition, sizeof condition, "abs(%s) > 0", what);
    return add_layer(o, condition, layer, error, size);
}

/* ---- Mirrors and glass --------------------------------------------------------------------------------------- */

/* INDEX or INDEX:PRIORITY. */
static int parse_glass(const char *text, bounce_material *m, char *error, size_t size)
{
    char index[32];
    const char *priority = cgt_split(text, ':', index, sizeof index);
    if (!priority && (strchr(text, ':') || strlen(text) >= sizeof index)) {
        snprintf(error, size, "the index of refraction \"%s\" is too long", text);
        return -1;
    }
    if (cgt_read_float(priority ? index : text, 1.0f, 100.0f, &m->index, error, size))
        return -1;
    return priority ? cgt_read_u32(priority, 0, UINT8_MAX, &m->priority, error, size) : 0;
}

static int parse_made_of(const char *text, bounce_material *m, char *error, size_t size)
{
    m->index = 1.5f;
    if (strcmp(text, "matt") == 0) {
        m->material = CGT_MATERIAL_MATTE;
    } else if (strcmp(text, "mirror") == 0) {
        m->material = CGT_MATERIAL_MIRROR;
    } else if (strncmp(text, "glass", 5) == 0 && (text[5] == '\0' || text[5] == ':')) {
        m->material = CGT_MATERIAL_GLASS;
        return text[5] ? parse_glass(text + 6, m, error, size) : 0;
    } else {
        snprintf(error, size, "\"%s\" is not matt, mirror, glass, glass:INDEX or glass:INDEX:PRIORITY", text);
        return -1;
    }
    return 0;
}

int cgt_parse_material(const char *text, void *to, char *error, size_t size)
{
    bounce_options *o = to;
    bounce_material m = {0};
    char name[TYPE_SIZE];
    const char *value = split_type(text, "TYPE=KIND", name, error, size);
    if (!value)
        return -1;
    if (o->count == BOUNCE_MATERIALS)
        return refuse_more(BOUNCE_MATERIALS, error, size);
    m.is_all = strcmp(name, "all") == 0;
    if ((!m.is_all && parse_type(name, ", nor all", &m.is_element, &m.kind, error, size)) ||
        parse_made_of(value, &m, error, size))
        return -1;
    o->materials[o->count++] = m;
    return 0;
}

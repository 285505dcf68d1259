/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Options about mirrors and glass; see bounce_options.h. */
#include "render/options/bounce_options.h"

#include <stdio.h>
#include <string.h>

#include "common/program.h"
#include "trajectory/trajectory_elements.h"

enum { OPTION_BOUNCES = 3072, OPTION_MATERIAL, OPTION_FLOOR };

static const struct argp_option table[] = {
    {NULL, 0, NULL, 0, "Mirrors and glass:", 14},
    {"bounces", OPTION_BOUNCES, "N", 0,
     "Follow light through up to N reflections and refractions, with hard shadows; at most 64", 0},
    {"material", OPTION_MATERIAL, "TYPE=KIND", 0,
     "What a type, by its number, or an element is made of, or all others: matt (default), mirror, glass, glass:INDEX "
     "of refraction, 1.5 unless given, or glass:INDEX:PRIORITY, 0 to 255, where bodies of glass overlap: 2=glass, "
     "Si=mirror, all=glass:1.33. Glass and mirrors have their type's colour",
     0},
    {"floor", OPTION_FLOOR, NULL, 0, "A chequered floor under everything", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

static int parse_type(const char *name, bounce_material *m, char *error, size_t size)
{
    element_reading reading;
    m->is_all = strcmp(name, "all") == 0;
    if (m->is_all)
        return 0;
    m->is_element = name[0] < '0' || name[0] > '9';
    if (!m->is_element)
        return program_parse_u32(name, 0, UINT32_MAX, &m->kind, error, size);
    m->kind = element_find((text_span){name, name + strlen(name)}, &reading);
    if (m->kind)
        return 0;
    snprintf(error, size, "\"%s\" is neither a type's number nor a chemical element, nor all", name);
    return -1;
}

/* INDEX or INDEX:PRIORITY. */
static int parse_glass(const char *text, bounce_material *m, char *error, size_t size)
{
    char index[32];
    const char *colon = strchr(text, ':');
    const size_t length = colon ? (size_t)(colon - text) : strlen(text);
    if (length >= sizeof index) {
        snprintf(error, size, "the index of refraction \"%s\" is too long", text);
        return -1;
    }
    memcpy(index, text, length);
    index[length] = '\0';
    if (program_parse_float(index, 1.0f, 100.0f, &m->index, error, size))
        return -1;
    return colon ? program_parse_u32(colon + 1, 0, UINT8_MAX, &m->priority, error, size) : 0;
}

static int parse_kind(const char *text, bounce_material *m, char *error, size_t size)
{
    m->index = 1.5f;
    if (strcmp(text, "matt") == 0) {
        m->material = WHITTED_MATTE;
    } else if (strcmp(text, "mirror") == 0) {
        m->material = WHITTED_MIRROR;
    } else if (strncmp(text, "glass", 5) == 0 && (text[5] == '\0' || text[5] == ':')) {
        m->material = WHITTED_GLASS;
        return text[5] ? parse_glass(text + 6, m, error, size) : 0;
    } else {
        snprintf(error, size, "\"%s\" is not matt, mirror, glass, glass:INDEX or glass:INDEX:PRIORITY", text);
        return -1;
    }
    return 0;
}

static int parse_material(const char *text, bounce_options *o, char *error, size_t size)
{
    bounce_material m = {0};
    char name[32];
    const char *equals = strchr(text, '=');
    if (!equals || equals == text || (size_t)(equals - text) >= sizeof name) {
        snprintf(error, size, "\"%s\" is not of the form TYPE=KIND", text);
        return -1;
    }
    if (o->count == BOUNCE_MATERIALS) {
        snprintf(error, size, "more than %d types", BOUNCE_MATERIALS);
        return -1;
    }
    memcpy(name, text, (size_t)(equals - text));
    name[equals - text] = '\0';
    if (parse_type(name, &m, error, size) || parse_kind(equals + 1, &m, error, size))
        return -1;
    o->materials[o->count++] = m;
    return 0;
}

int bounce_rule_of(const bounce_options *o, const uint32_t *type, const uint8_t *element)
{
    int named = -1, all = -1;
    for (uint32_t k = 0; k < o->count; k++) {
        const bounce_material *m = &o->materials[k];
        if (m->is_all)
            all = (int)k;
        else if (m->is_element ? element && *element == m->kind : type && *type == m->kind)
            named = (int)k;
    }
    return named >= 0 ? named : all;
}

static error_t parse_key(int key, char *arg, struct argp_state *state)
{
    bounce_options *o = state->input;
    char error[PROGRAM_ERROR_SIZE];
    switch (key) {
    case OPTION_BOUNCES:
        o->is_set = 1;
        if (program_parse_u32(arg, 0, WHITTED_MAX_BOUNCES, &o->bounces, error, sizeof error))
            argp_error(state, "--bounces: %s", error);
        return 0;
    case OPTION_MATERIAL:
        if (parse_material(arg, o, error, sizeof error))
            argp_error(state, "--material: %s", error);
        return 0;
    case OPTION_FLOOR: o->floor = 1; return 0;
    case ARGP_KEY_END:
        if ((o->count || o->floor) && !o->is_set)
            argp_error(state, "--material and --floor are for --bounces");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

const struct argp bounce_options_parser = {table, parse_key, NULL, NULL, NULL, NULL, NULL};

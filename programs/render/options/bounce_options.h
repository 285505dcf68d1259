/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Options of cgt-render about mirrors and glass. */
#ifndef BOUNCE_OPTIONS_H
#define BOUNCE_OPTIONS_H

#include <argp.h>
#include <stdint.h>

#include "picture/figures/particles.h"
#include "whitted/whitted.h"

enum { BOUNCE_MATERIALS = PARTICLE_KINDS };

/* The material of a type, of an element, or of all that no other names. */
typedef struct bounce_material {
    int is_all, is_element;
    uint32_t kind; /* a type, or an atomic number */
    whitted_kind material;
    float index;       /* of refraction */
    uint32_t priority; /* of glass that overlaps: whitted_material */
} bounce_material;

typedef struct bounce_options {
    int is_set; /* --bounces was given */
    uint32_t bounces;
    bounce_material materials[BOUNCE_MATERIALS];
    uint32_t count;
    int floor; /* 1: a chequered floor under the bulk */
} bounce_options;

/* The rule, by its number, of a sphere of a type (NULL: the file has none) and an element (the same): one that names it
 * before one for all, the last of several; -1: none. */
int bounce_rule_of(const bounce_options *options, const uint32_t *type, const uint8_t *element);

/* A child of the parser of cgt-render; its input is a bounce_options of zeros. */
extern const struct argp bounce_options_parser;

#endif

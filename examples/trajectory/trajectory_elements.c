/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Van der Waals radii of the main group: M. Mantina, A. C. Chamberlin, R. Valero, C. J. Cramer, D. G. Truhlar,
 * "Consistent van der Waals Radii for the Whole Main Group", J. Phys. Chem. A 113 (2009). */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/trajectory_elements.h"

#include <string.h>
#include <strings.h>

typedef struct element {
    char symbol[3];
    float radius; /* Angstrom */
} element;

static const element elements[] = {
    {"H", 1.10f},  {"D", 1.10f},  {"He", 1.40f}, {"Li", 1.81f}, {"Be", 1.53f}, {"B", 1.92f},  {"C", 1.70f},
    {"N", 1.55f},  {"O", 1.52f},  {"F", 1.47f},  {"Ne", 1.54f}, {"Na", 2.27f}, {"Mg", 1.73f}, {"Al", 1.84f},
    {"Si", 2.10f}, {"P", 1.80f},  {"S", 1.80f},  {"Cl", 1.75f}, {"Ar", 1.88f}, {"K", 2.75f},  {"Ca", 2.31f},
    {"Ga", 1.87f}, {"Ge", 2.11f}, {"As", 1.85f}, {"Se", 1.90f}, {"Br", 1.83f}, {"Kr", 2.02f}, {"Rb", 3.03f},
    {"Sr", 2.49f}, {"In", 1.93f}, {"Sn", 2.17f}, {"Sb", 2.06f}, {"Te", 2.06f}, {"I", 1.98f},  {"Xe", 2.16f},
};

float element_radius(text_span symbol)
{
    while (symbol.end > symbol.begin && symbol.end[-1] >= '0' && symbol.end[-1] <= '9') {
        symbol.end--;
    }
    const size_t length = text_length(symbol);
    for (size_t i = 0; i < sizeof elements / sizeof elements[0]; i++) {
        if (strlen(elements[i].symbol) == length && strncasecmp(elements[i].symbol, symbol.begin, length) == 0) {
            return elements[i].radius;
        }
    }
    return ELEMENT_DEFAULT_RADIUS;
}

uint32_t name_table_find(name_table *names, text_span name, const char **reason)
{
    if (names->count > 0 && text_is(name, names->name[names->last])) {
        return names->last + 1;
    }
    for (uint32_t i = 0; i < names->count; i++) {
        if (text_is(name, names->name[i])) {
            names->last = i;
            return i + 1;
        }
    }
    const size_t length = text_length(name);
    if (length > NAME_LONGEST) {
        *reason = "the name is longer than 15 characters";
        return 0;
    }
    if (memchr(name.begin, '\0', length)) {
        *reason = "the name has a zero byte in it";
        return 0;
    }
    if (names->count == NAMES_MOST) {
        *reason = "more than 1024 different names";
        return 0;
    }
    names->last = names->count++;
    memcpy(names->name[names->last], name.begin, length);
    names->name[names->last][length] = '\0';
    names->radius[names->last] = element_radius(name);
    return names->last + 1;
}

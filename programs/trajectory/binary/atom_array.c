/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of atoms. Programs write their names in small letters, in capitals or mixed. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/binary/atom_array.h"

#include <string.h>
#include <strings.h>

static const struct {
    const char *name;
    uint32_t parts;
    atom_use use;
} known[] = {
    {"id", 1, ATOM_ID},
    {"type", 1, ATOM_TYPE},
    {"radius", 1, ATOM_RADIUS},
    {"diameter", 1, ATOM_DIAMETER},
    {"velocities", 3, ATOM_VELOCITY},
    {"v", 3, ATOM_VELOCITY},
    {"velocity", 3, ATOM_VELOCITY},
};

int atom_array_plan(cgt_trajectory *t, atom_array *a, const char *name, uint32_t parts, int is_whole)
{
    char text[512];
    a->parts = parts <= ATOM_MOST_PARTS ? parts : 0;
    if (a->use == ATOM_PLACE) {
        a->is_wanted = 1;
        return 1;
    }
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (parts == known[i].parts && strcasecmp(name, known[i].name) == 0) {
            a->use = known[i].use;
            a->is_wanted = 1;
        }
    }
    for (uint32_t i = 0; i < a->parts; i++) {
        columns_part_name(name, parts, i, text, sizeof text);
        a->slot[i] = columns_add_named(t, text, is_whole ? CGT_TRAJECTORY_WHOLE : CGT_TRAJECTORY_NUMBER);
        if (a->slot[i] < 0)
            return -1;
        a->is_wanted |= a->slot[i] > 0;
    }
    return 1;
}

static uint32_t to_whole(double value) { return value >= 0.0 && value <= (double)UINT32_MAX ? (uint32_t)value : 0; }

void atom_array_store(cgt_trajectory *t, const atom_array *a, size_t atom, uint32_t part, double value)
{
    trajectory_store *const s = &t->store;
    switch (a->use) {
    case ATOM_PLACE: s->xyzr[4 * atom + part] = trajectory_place(t, part, value); break;
    case ATOM_VELOCITY: s->velocity[3 * atom + part] = (float)value; break;
    case ATOM_ID: s->id[atom] = to_whole(value); break;
    case ATOM_TYPE: s->type[atom] = to_whole(value); break;
    case ATOM_RADIUS: s->xyzr[4 * atom + 3] = (float)value; break;
    case ATOM_DIAMETER: s->xyzr[4 * atom + 3] = 0.5f * (float)value; break;
    case ATOM_NONE: break;
    }
    if (a->slot[part] > 0)
        columns_values(t, a->slot[part])[atom] = (float)value;
}

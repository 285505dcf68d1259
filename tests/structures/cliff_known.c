/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rows whose work exceeds its twin's by more than test_cliffs.c allows, and how far they may: about 1.5 times of what
 * was counted, since variants differ. The test prints a line for each row that is missing here, that has become worse or
 * that may leave. */
#include "structures/cliff_counts.h"

#include <string.h>

typedef struct known_row {
    const char *name;
    cliff_call call;
    cliff_structure structure;
    double bound; /* times the twin's work */
} known_row;

static const known_row known[] = {
    {"stray 1e17, spheres", CLIFF_RAYS, CLIFF_AUTO, 1000},
};

double cliff_known_bound(const char *name, cliff_call call, cliff_structure structure)
{
    for (size_t i = 0; i < TEST_COUNT(known); i++)
        if (!strcmp(known[i].name, name) && known[i].call == call && known[i].structure == structure)
            return known[i].bound;
    return 0;
}

static bool is_in_catalogue(const char *name)
{
    for (uint32_t i = 0; i < cliff_count(); i++)
        if (!strcmp(cliff_at(i)->name, name))
            return true;
    return false;
}

uint32_t cliff_known_check(void)
{
    for (size_t i = 0; i < TEST_COUNT(known); i++) {
        if (!is_in_catalogue(known[i].name) || !(known[i].bound > 0))
            fail_msg("known row %zu: no cliff has the name \"%s\", or its bound is missing", i, known[i].name);
        for (size_t k = 0; k < i; k++)
            if (!strcmp(known[k].name, known[i].name) && known[k].call == known[i].call &&
                known[k].structure == known[i].structure)
                fail_msg("known rows %zu and %zu are the same: \"%s\"", k, i, known[i].name);
    }
    return TEST_COUNT(known);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All hard cases as one list. */
#include "hard_cases/hard_cases.h"

static const hard_table *const tables[] = {&hard_cases_edges,   &hard_cases_triangles, &hard_cases_rays,
                                           &hard_cases_spheres, &hard_cases_grid,      &hard_cases_input};
#define TABLES (sizeof tables / sizeof tables[0])

size_t hard_case_count(void)
{
    size_t count = 0;
    for (size_t i = 0; i < TABLES; i++)
        count += tables[i]->count;
    return count;
}

const hard_case *hard_case_at(size_t i)
{
    for (size_t k = 0; k < TABLES; k++) {
        if (i < tables[k]->count)
            return &tables[k]->first[i];
        i -= tables[k]->count;
    }
    return NULL;
}

/* The number of the case's random stream, a hash of its name: a new case does not change the others. */
static uint64_t stream_of(const hard_case *c)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    const char *const text[2] = {c->row, c->name};
    for (int k = 0; k < 2; k++)
        for (const char *p = text[k]; *p; p++)
            hash = (hash ^ (unsigned char)*p) * UINT64_C(0x100000001b3);
    return hash;
}

bool hard_case_make(const hard_case *c, uint32_t rays, hard_scene *s)
{
    *s = (hard_scene){.wanted = rays, .place = c->place, .random = random_make(stream_of(c))};
    c->make(s);
    return !s->failed;
}

void hard_case_follow(const hard_case *c, hard_scene *s, const hard_found *found)
{
    s->random = random_make(stream_of(c) + 1);
    for (uint32_t i = 0; c->follow && i < s->rays; i++)
        c->follow(s, i, &found[i]);
}

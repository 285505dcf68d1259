/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Ways to the same hits: every structure, by every builder, in every layout, traversed in every manner. One table for
 * all tests; ways.c tells how to add a row. Free of the test framework. */
#ifndef WAYS_H
#define WAYS_H

#include <stdbool.h>
#include <stdint.h>

#include "support/random.h"
#include "support/research_options.h"

/* What a way serves. A set is the sum of some of these, and holds the ways that serve all of them. */
enum {
    WAY_EACH = 1,      /* one per structure, by its defaults, without AUTO */
    WAY_BUILDER = 2,   /* one per structure and builder */
    WAY_TRAVERSAL = 4, /* one per structure, builder and traversal */
    WAY_LAYOUT = 8,    /* a kd-tree in one of its layouts */
    WAY_CELLS = 16,    /* one per structure and resolution of a grid */
    WAY_CHOSEN = 32,   /* AUTO, for each kind of rays */
    WAY_TILES = 64,    /* a camera and lights go by tiles */
    WAY_CLUSTERS = 128 /* triangles are grouped in clusters */
};

typedef struct test_way {
    const char *name;
    test_scene_options scene;
    cgt_kd_traversal traversal; /* of rays through kd-trees and BIH */
    unsigned serves;
    bool papers; /* a structure of research.h */
} test_way;

/* The next way of a set after `after`, or the first after NULL; NULL after the last. */
const test_way *way_next(const test_way *after, unsigned set);
#define FOR_EACH_WAY(w, set) for (const test_way *w = way_next(NULL, set); w; w = way_next(w, set))

uint32_t way_count(unsigned set);

/* Number turn, counted around the set. */
const test_way *way_in_turn(unsigned set, uint32_t turn);

/* One cell, in which every ray tests every primitive: the reference for all ways. */
extern const test_way one_cell;

/* The scene options of WAY_EACH in turn. */
#define TEST_STRUCTURES way_count(WAY_EACH)
cgt_scene_options structure_in_turn(uint32_t turn);

/* Any structure, AUTO included, with any builder, layout and break level. */
test_scene_options structure_random(test_random *r);

/* A task runner that runs tasks from the last to the first, and counts its calls in an unsigned; user: that, or
 * NULL. */
void run_backwards(void *user, cgt_task *task, void *argument, uint32_t count);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The hard cases by name, of tests/hard_cases, with rays of their own; those of a case that is traced twice follow the
 * hits of the oracle. */
#include <math.h>
#include <string.h>

#include "driver/rays/lines.h"
#include "driver/scenes/scene_heap.h"
#include "hard_cases/hard_run.h"
#include "support/suite.h"

#define CASES 83u
#define RAYS 1024u

static truth_ray own[RAYS]; /* of the last scene */
static uint32_t own_count;

static const char *case_name(uint32_t family) { return hard_case_at(family)->name; }

static void follow_hits(const hard_case *c, hard_scene *s)
{
    hard_truth truth;
    if (!c->follow)
        return;
    assert_true(hard_truth_make(s, &truth));
    for (uint32_t i = 0; i < s->rays; i++) {
        const oracle_hit *const hit = &truth.hit[i];
        hard_found found = {.t = INFINITY};
        if (hit->index != ORACLE_NONE)
            found.t = (float)hit->t;
        for (int a = 0; a < 3; a++)
            found.normal[a] = (float)hit->normal[a];
        c->follow(s, i, &found);
    }
    hard_truth_free(&truth);
}

static void add_geometry(scene_heap *h, const hard_geometry *g)
{
    for (uint32_t i = 0; i < g->spheres; i++)
        memcpy(scene_heap_add(h, ORACLE_SPHERE), g->sphere[i], sizeof g->sphere[i]);
    for (uint32_t i = 0; i < g->triangles; i++) {
        float *const v = scene_heap_add(h, ORACLE_TRIANGLE);
        for (int k = 0; k < 3; k++)
            memcpy(v + 3 * k, g->vertex[g->index[i][k]], 3 * sizeof *v);
    }
}

static void make_case(scene_heap *h, uint32_t family)
{
    const hard_case *const c = hard_case_at(family);
    hard_scene s = {.wanted = RAYS, .place = c->place, .random = *h->r};
    c->make(&s);
    assert_true(!s.failed && hard_case_count() == CASES);
    follow_hits(c, &s);
    for (uint32_t g = 0; g < s.geometries; g++)
        add_geometry(h, &s.geometry[g]);
    own_count = s.rays;
    memcpy(own, s.ray, own_count * sizeof *own);
    *h->r = s.random;
    hard_scene_free(&s);
}

const scene_group case_scenes = {CASES, case_name, make_case};

void case_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    const uint32_t from = random_below(&s->random, own_count);
    for (uint32_t i = 0; i < count; i++)
        ray[i].line = own[(from + i) % own_count];
}

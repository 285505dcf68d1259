/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Time cliffs, by counted work: what one trouble in a scene or in its rays may cost, compared with the same scene
 * without it, for each call and each structure that AUTO may choose. The goal is GOAL_FACTOR, the limit MOST_FACTOR;
 * cliff_known.c lists the rows that exceed it today. All structures must find the same hits meanwhile, and those that
 * exact arithmetic finds. Times are what cgt-bench cliffs measures. */
#include "structures/scenes/cliff_counts.h"
#include "support/suite.h"

#include <stdlib.h>
#include <string.h>

#include "support/oracle/oracle.h"

#define GOAL_FACTOR 3.0
#define MOST_FACTOR 10.0

/* Decisions in whole numbers of all calls of a cliff of planes, or of an eye on a sphere: a hundredth of its rays and
 * points. What is parallel or lies in one plane is told by comparisons, or in double; so are roots of which one is 0
 * but for roundings. */
#define MOST_EXACT 32u

/* Twins that need less than this for a ray are taken to need it: a few nodes and blocks. */
#define LEAST_WORK 8.0

/* What AUTO makes for coherent rays, a loose grid and a BVH beside it; and for others, a BVH; and the BIH, a tree by
 * other rules. */
#define COUNTED 3
static const cliff_structure counted[COUNTED] = {CLIFF_AUTO, CLIFF_BVH, CLIFF_BIH};

/* Bounds of the twins' own work, so that a cliff is not measured by a slope: 1.3 times of the widest variant's, or of
 * the narrowest's where that takes more. */
static const double most_twin[CLIFF_BASES][COUNTED][CLIFF_CALLS] = {
    /* commit, camera, light, single, rays, occluded */
    [CLIFF_CLOUD] = {{6, 25, 17, 115, 70, 58}, {65, 55, 63, 51, 70, 58}, {13, 43, 63, 94, 122, 99}},
    [CLIFF_SOUP] = {{6, 13, 46, 235, 122, 117}, {115, 84, 119, 109, 122, 117}, {13, 78, 139, 243, 223, 211}},
    [CLIFF_MESH] = {{6, 20, 46, 102, 59, 55}, {82, 29, 72, 37, 59, 55}, {14, 28, 70, 99, 114, 88}},
    [CLIFF_STICKS] = {{6, 11, 18, 169, 92, 74}, {103, 69, 61, 91, 92, 74}},
};

/* Of the scenes that exact arithmetic judges ray by ray. */
#define JUDGED_PRIMITIVES 150u
#define JUDGED_RAYS 24u
#define JUDGED_WIDTH 8u
#define JUDGED_HEIGHT 6u

static const char *const call_word[CLIFF_CALLS] = {"CLIFF_COMMIT", "CLIFF_CAMERA", "CLIFF_LIGHT",
                                                   "CLIFF_SINGLE", "CLIFF_RAYS",   "CLIFF_OCCLUDED"};
static const char *const structure_word[CLIFF_STRUCTURES] = {"CLIFF_AUTO", "CLIFF_GRID", "CLIFF_BVH", "CLIFF_BIH"};

/* ---- work ---- */

typedef struct tally {
    uint32_t rows, above_goal, known, bad;
} tally;

/* A line as cliff_known.c has it. */
static void print_row(const char *why, const cliff *c, cliff_call call, cliff_structure structure, double factor)
{
    print_message("%s: {\"%s\", %s, %s, %.0f}, now %.3g\n", why, c->name, call_word[call], structure_word[structure],
                  factor * 1.5 + 1, factor);
}

static void judge_row(const cliff *c, cliff_call call, cliff_structure structure, double factor, tally *t)
{
    const double bound = cliff_known_bound(c->name, call, structure);
    t->rows++;
    t->above_goal += factor > GOAL_FACTOR;
    t->known += bound > 0;
    if (factor > (bound > 0 ? bound : MOST_FACTOR)) {
        print_row(bound > 0 ? "worse than known" : "above the limit", c, call, structure, factor);
        t->bad++;
    } else if (bound > 0 && factor <= MOST_FACTOR) {
        print_row("known, may leave the table if so in all variants", c, call, structure, factor);
    }
}

static bool wants_no_whole_numbers(const cliff *c)
{
    return (strstr(c->name, "on a surface") && c->base == CLIFF_CLOUD) || strstr(c->name, "in its plane") ||
           strstr(c->name, "decals") || strstr(c->name, "double faces") || strstr(c->name, "listed twice");
}

static void count_cliff(cgt_context *context, const cliff *c, double twin[COUNTED][CLIFF_CALLS], tally *t)
{
    cliff_counts counts[COUNTED];
    const int last = cliff_has_structure(c->base, counted[COUNTED - 1]) ? COUNTED : COUNTED - 1;
    for (int s = 0; s < last; s++) {
        cliff_counts_make(&counts[s], context, c, true, counted[s]);
        for (int call = 0; call < CLIFF_CALLS; call++)
            if (cliff_concerns(c, (cliff_call)call)) {
                const double least = twin[s][call] > LEAST_WORK ? twin[s][call] : LEAST_WORK;
                judge_row(c, (cliff_call)call, counted[s], counts[s].work[call] / least, t);
            }
        if (wants_no_whole_numbers(c) && counts[s].exact > MOST_EXACT) {
            print_message("%s, %s: %.0f decisions in whole numbers\n", c->name, cliff_structure_name(counted[s]),
                          (double)counts[s].exact);
            t->bad++;
        }
    }
    for (int s = 1; s < last; s++)
        cliff_counts_compare(c, &counts[s], &counts[0]);
    for (int s = 0; s < last; s++)
        cliff_counts_free(&counts[s]);
}

static void count_twin(cgt_context *context, cliff_base base, double work[COUNTED][CLIFF_CALLS], tally *t)
{
    static const char *const name[CLIFF_BASES] = {"cloud", "soup", "mesh", "sticks"};
    const cliff twin = {.name = "twin", .base = base};
    for (int s = 0; s < COUNTED && cliff_has_structure(base, counted[s]); s++) {
        cliff_counts counts;
        cliff_counts_make(&counts, context, &twin, false, counted[s]);
        memcpy(work[s], counts.work, sizeof counts.work);
        cliff_counts_free(&counts);
        for (int call = 0; call < CLIFF_CALLS; call++) {
            const bool good = work[s][call] <= most_twin[base][s][call];
            print_message("%s %.1f%s", call ? "," : name[base], work[s][call], good ? "" : " (too much)");
            t->bad += !good;
        }
        print_message(" by commit, camera, light, single, rays, occluded; %s\n", cliff_structure_name(counted[s]));
    }
}

TEST(work_stays_in_proportion)
{
    static double twin[CLIFF_BASES][COUNTED][CLIFF_CALLS];
    tally t = {0};
    cgt_context *context = context_make(1, NULL);
    for (int base = 0; base < CLIFF_BASES; base++)
        count_twin(context, (cliff_base)base, twin[base], &t);
    const uint32_t step = test_scaled(10) < 10 ? 10 / test_scaled(10) : 1;
    for (uint32_t i = test_sample_start(0, step); i < cliff_count(); i += step)
        count_cliff(context, cliff_at(i), twin[cliff_at(i)->base], &t);
    print_message("%u rows: %u above the goal of %g, %u known to be above %g\n", t.rows, t.above_goal, GOAL_FACTOR,
                  t.known, MOST_FACTOR);
    cgt_context_release(context);
    if (t.bad)
        fail_msg("%u rows take too much work", t.bad);
}

TEST(the_table_of_known_rows_is_sound) { cliff_known_check(); }

/* ---- exactness ---- */

static void judge_ray(const char *name, const oracle_scene *truth, const truth_ray *ray, uint32_t primitive, float t)
{
    static const char *const word[] = {"right", "missed", "invented", "another one is closer"};
    oracle_hit exact;
    const uint32_t geometry = primitive == CGT_INVALID_ID ? CGT_INVALID_ID : 0;
    const oracle_verdict verdict = oracle_judge(truth, ray, geometry, primitive, &exact);
    if (verdict != ORACLE_RIGHT || (!geometry && !(oracle_ulp(exact.t, t) <= 1)))
        fail_msg("%s: %s: primitive %d at %a, by exact arithmetic %d at %a; ray from %a %a %a to %a %a %a", name,
                 word[verdict], (int)primitive, (double)t, (int)exact.index, (double)exact.t, (double)ray->org[0],
                 (double)ray->org[1], (double)ray->org[2], (double)ray->dir[0], (double)ray->dir[1],
                 (double)ray->dir[2]);
}

static void judge_frame(const cliff *c, const oracle_scene *truth, const cliff_scene *scene, const cgt_scene *committed)
{
    truth_ray *rays = frame_rays(&scene->camera, JUDGED_WIDTH, JUDGED_HEIGHT);
    planes p = planes_make(JUDGED_WIDTH, JUDGED_HEIGHT);
    frame_trace(committed, &scene->camera, &p, NULL);
    for (uint32_t k = 0; k < JUDGED_WIDTH * JUDGED_HEIGHT; k++)
        judge_ray(c->name, truth, &rays[k], p.primitive[k], p.t[k]);
    planes_free(&p);
    free(rays);
}

static void add_judged_sticks(oracle_scene *truth, const cliff_scene *scene)
{
    static float capsule[JUDGED_PRIMITIVES][7];
    for (uint32_t i = 0; i < scene->count; i++) {
        const float *p = scene->data + (size_t)8 * i;
        memcpy(capsule[i], p, 3 * sizeof *p);
        memcpy(capsule[i] + 3, p + 4, 4 * sizeof *p);
    }
    oracle_scene_add_capsules(truth, 0, (const float(*)[7])capsule, scene->count);
}

static void judge_cliff(cgt_context *context, const cliff *c)
{
    cliff_scene scene;
    oracle_scene truth = {0};
    truth_ray rays[JUDGED_RAYS];
    full_hit hit[JUDGED_RAYS];
    assert_true(cliff_make(&scene, c, true, JUDGED_PRIMITIVES));
    cliff_make_rays(&scene, c, true, rays, JUDGED_RAYS);
    if (scene.base == CLIFF_CLOUD)
        oracle_scene_add_spheres(&truth, 0, (const float(*)[4])(const void *)scene.data, scene.count);
    else if (scene.base == CLIFF_STICKS)
        add_judged_sticks(&truth, &scene);
    else
        oracle_scene_add_triangles(&truth, 0, (const float(*)[3])(const void *)scene.data, 3 * scene.count, NULL,
                                   scene.count);
    for (int s = 0; s < CLIFF_STRUCTURES && cliff_has_structure(c->base, (cliff_structure)s); s++) {
        const cgt_scene_options options = cliff_structure_options((cliff_structure)s);
        cgt_scene *committed = NULL;
        assert_int_equal(cgt_scene_create(context, &options, &committed), CGT_OK);
        assert_int_equal(cliff_add(&scene, committed), CGT_OK);
        assert_int_equal(cgt_scene_commit(committed), CGT_OK);
        assert_int_equal(trace_array(committed, rays, JUDGED_RAYS, hit, NULL), CGT_OK);
        for (uint32_t i = 0; i < JUDGED_RAYS; i++)
            judge_ray(c->name, &truth, &rays[i], hit[i].primitive, hit[i].t);
        if (c->disturb)
            judge_frame(c, &truth, &scene, committed);
        cgt_scene_release(committed);
    }
    oracle_scene_free(&truth);
    cliff_free(&scene);
}

TEST(hits_are_exact)
{
    const uint32_t step = test_scaled(10) < 10 ? 10 / test_scaled(10) : 1;
    cgt_context *context = context_make(1, NULL);
    for (uint32_t i = test_sample_start(1, step); i < cliff_count(); i += step)
        judge_cliff(context, cliff_at(i));
    cgt_context_release(context);
}

SEEDED_SUITE("test_cliffs", NULL, NULL)

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Runs the calls of a cliff and counts their work. */
#include "structures/scenes/cliff_counts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Few points cost no less than this many: the groups of a tile and its march are there in any case. */
#define LEAST_POINTS 256u

typedef struct counting {
    const cliff_scene *scene;
    cgt_scene *committed;
    cliff_counts *counts;
    const truth_ray *rays;
    uint32_t single[CLIFF_SINGLE_RAYS]; /* what they hit one by one */
    cgt_trace_statistics trace;
    cgt_research_trace_statistics research;
    cgt_research_trace_options research_options;
    cgt_trace_options options;
} counting;

static double work_of(const counting *c)
{
    c->counts->exact += c->trace.exact_tests + c->trace.exact_values;
    return cliff_work(&c->trace, &c->research);
}

static double count_commit(const counting *c)
{
    cgt_scene_statistics st;
    assert_int_equal(cgt_scene_get_statistics(c->committed, &st), CGT_OK);
    const size_t tree = st.structure == CGT_STRUCTURE_BVH ? 0 : st.bvh_bytes;
    return (double)(st.structure_bytes + tree) / c->scene->count;
}

static double count_camera(counting *c)
{
    c->counts->frame = planes_make(CLIFF_WIDTH, CLIFF_HEIGHT);
    frame_trace(c->committed, &c->scene->camera, &c->counts->frame, &c->options);
    return work_of(c) / (CLIFF_WIDTH * CLIFF_HEIGHT);
}

static double count_light(counting *c)
{
    cgt_light light = {.kind = CGT_LIGHT_POINT};
    cliff_points points;
    memcpy(light.position, c->scene->light, sizeof light.position);
    assert_true(cliff_make_points(c->scene, c->committed, CLIFF_WIDTH, CLIFF_HEIGHT, &points));
    uint8_t *occluded = malloc(points.count + 1);
    assert_non_null(occluded);
    const cgt_points to = cliff_points_array(&points);
    assert_int_equal(cgt_occluded_points(c->committed, &light, &to, occluded, &c->options), CGT_OK);
    const double count = points.count > LEAST_POINTS ? points.count : LEAST_POINTS;
    free(occluded);
    cliff_points_free(&points);
    return work_of(c) / count;
}

static double count_single(counting *c)
{
    double work = 0;
    for (uint32_t i = 0; i < CLIFF_SINGLE_RAYS; i++) {
        const cgt_single_ray ray = single_ray(&c->rays[i]);
        cgt_hit hit;
        assert_int_equal(cgt_trace_ray(c->committed, &ray, &hit, &c->options), CGT_OK);
        c->single[i] = hit.primitive;
        work += work_of(c);
    }
    return work / CLIFF_SINGLE_RAYS;
}

static double count_rays(counting *c)
{
    memset(c->counts->hit, 0xee, sizeof c->counts->hit);
    assert_int_equal(trace_array(c->committed, c->rays, CLIFF_RAYS_COUNTED, c->counts->hit, &c->options), CGT_OK);
    for (uint32_t i = 0; i < CLIFF_SINGLE_RAYS; i++)
        assert_int_equal(c->single[i], c->counts->hit[i].primitive);
    return work_of(c) / CLIFF_RAYS_COUNTED;
}

static double count_occluded(counting *c)
{
    const cgt_rays rays = ray_array(c->rays, CLIFF_RAYS_COUNTED);
    assert_int_equal(cgt_occluded_rays(c->committed, &rays, c->counts->occluded, &c->options), CGT_OK);
    for (uint32_t i = 0; i < CLIFF_RAYS_COUNTED; i++)
        assert_int_equal(c->counts->occluded[i], c->counts->hit[i].primitive != CGT_INVALID_ID);
    return work_of(c) / CLIFF_RAYS_COUNTED;
}

void cliff_counts_make(cliff_counts *counts, cgt_context *context, const cliff *c, bool disturbed,
                       cliff_structure structure)
{
    static truth_ray rays[CLIFF_RAYS_COUNTED];
    cliff_scene scene;
    counting all = {.scene = &scene, .counts = counts, .rays = rays};
    const cgt_scene_options options = cliff_structure_options(structure);
    memset(counts, 0, sizeof *counts);
    assert_true(cliff_make(&scene, c, disturbed, c->base == CLIFF_MESH ? CLIFF_MESH_PRIMITIVES : CLIFF_PRIMITIVES));
    cliff_make_rays(&scene, c, disturbed, rays, CLIFF_RAYS_COUNTED);
    all.research_options.statistics = &all.research;
    all.options.statistics = &all.trace;
    all.options.research = &all.research_options;
    assert_int_equal(cgt_scene_create(context, &options, &all.committed), CGT_OK);
    assert_int_equal(cliff_add(&scene, all.committed), CGT_OK);
    assert_int_equal(cgt_scene_commit(all.committed), CGT_OK);
    /* in the order of cliff_call: single rays come before a call that may build a BVH */
    counts->work[CLIFF_COMMIT] = count_commit(&all);
    counts->work[CLIFF_CAMERA] = count_camera(&all);
    counts->work[CLIFF_SINGLE] = count_single(&all);
    counts->work[CLIFF_LIGHT] = count_light(&all);
    counts->work[CLIFF_RAYS] = count_rays(&all);
    counts->work[CLIFF_OCCLUDED] = count_occluded(&all);
    cgt_scene_release(all.committed);
    cliff_free(&scene);
}

void cliff_counts_free(cliff_counts *counts) { planes_free(&counts->frame); }

void cliff_counts_compare(const cliff *c, const cliff_counts *a, const cliff_counts *b)
{
    for (uint32_t i = 0; i < CLIFF_RAYS_COUNTED; i++)
        if (memcmp(&a->hit[i], &b->hit[i], sizeof a->hit[i]) != 0)
            fail_msg("%s: ray %u hits %u at %a, through another structure %u at %a", c->name, i, a->hit[i].primitive,
                     (double)a->hit[i].t, b->hit[i].primitive, (double)b->hit[i].t);
    if (!planes_equal(&a->frame, &b->frame))
        fail_msg("%s: the frame differs from that of another structure", c->name);
}

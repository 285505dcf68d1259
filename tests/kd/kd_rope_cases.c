/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes of a few primitives, trees that no heuristic would build, and rays in their split planes. */
#include "exact/valid_primitive.h"
#include "kd/kd_rope_cases.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "papers/model/leaf_triangle.h"

/* ---- primitives ---- */

static float coordinate(test_random *r, const rope_case *c)
{
    return c->unit * (c->place == ROPE_PLACE_ANYWHERE ? random_float(r, -1, 1) : (float)random_below(r, 9) - 4);
}

static void make_spheres(test_random *r, rope_case *c, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        for (int a = 0; a < 3; a++)
            c->sphere[i][a] = coordinate(r, c);
        c->sphere[i][3] = c->place == ROPE_PLACE_ANYWHERE ? c->unit * random_log(r, 1e-3f, 0.5f)
                          : c->place == ROPE_PLACE_PLANAR ? 0
                                                          : c->unit * 0.5f * (float)random_below(r, 4);
    }
}

static void make_triangles(test_random *r, rope_case *c, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t flat = random_below(r, 4); /* one of three is perpendicular to an axis */
        for (uint32_t k = 0; k < 3; k++)
            for (uint32_t a = 0; a < 3; a++)
                c->vertex[3 * i + k][a] = k && a == flat ? c->vertex[3 * i][a] : coordinate(r, c);
    }
}

static void flatten_case(test_random *r, rope_case *c, uint32_t count)
{
    const uint32_t axis = random_below(r, 3);
    const float at = coordinate(r, c);
    for (uint32_t i = 0; i < count; i++) {
        c->sphere[i][axis] = at;
        for (uint32_t k = 0; k < 3; k++)
            c->vertex[3 * i + k][axis] = at;
    }
}

/* ---- the scene ---- */

static float rounded(double value, bool up)
{
    const float nearest = (float)value;
    if (up)
        return nearest < value ? nextafterf(nearest, INFINITY) : nearest;
    return nearest > value ? nextafterf(nearest, -INFINITY) : nearest;
}

static void set_scene_bounds(cgt_committed_scene *w)
{
    float largest = 0;
    for (int a = 0; a < 3; a++) {
        w->low[a] = INFINITY;
        w->high[a] = -INFINITY;
    }
    for (uint32_t i = 0; i < w->prims.count; i++) {
        double low[3], high[3];
        const cgt_primitive s = cgt_primitives_get(&w->prims, i);
        if (cgt_primitive_check(&s) != CGT_PRIMITIVE_VALID)
            continue;
        w->valid++;
        object_bounds(&w->prims, i, low, high);
        for (int a = 0; a < 3; a++) {
            const float l = rounded(low[a], false), h = rounded(high[a], true);
            w->low[a] = l < w->low[a] ? l : w->low[a];
            w->high[a] = h > w->high[a] ? h : w->high[a];
            largest = fmaxf(largest, fmaxf(fabsf(l), fabsf(h)));
        }
    }
    w->scale = largest > 0 ? ldexpf(1, -ilogbf(largest)) : 1;
}

static void make_primitives(test_random *r, rope_case *c)
{
    const uint32_t count = 1 + random_below(r, ROPE_MOST_OBJECTS), spheres = random_below(r, 3) * count / 2;
    const uint32_t triangles = count - spheres;
    cgt_primitives *o = &c->committed_scene.prims;
    make_spheres(r, c, spheres);
    make_triangles(r, c, triangles);
    if (c->place == ROPE_PLACE_PLANAR)
        flatten_case(r, c, ROPE_MOST_OBJECTS);
    *o = (cgt_primitives){.array = c->array, .count = count, .spheres = spheres, .triangles = triangles};
    if (spheres)
        c->array[o->arrays++] = (cgt_primitive_array){.kind = CGT_KIND_SPHERES,
                                                      .point = (const char *)c->sphere,
                                                      .point_stride = sizeof c->sphere[0],
                                                      .radius = (const char *)&c->sphere[0][3],
                                                      .radius_stride = sizeof c->sphere[0],
                                                      .count = spheres};
    if (triangles)
        c->array[o->arrays++] = (cgt_primitive_array){.kind = CGT_KIND_TRIANGLES,
                                                      .first = spheres,
                                                      .spheres_before = spheres,
                                                      .geometry = 1,
                                                      .point = (const char *)c->vertex,
                                                      .point_stride = sizeof c->vertex[0],
                                                      .count = triangles,
                                                      .points = 3 * triangles};
    set_scene_bounds(&c->committed_scene);
}

/* A tree from a builder, or one that no builder would make. */
static void make_tree(test_random *r, cgt_context *context, rope_case *c)
{
    static const uint32_t depths[] = {1, 4, 8, 16, 30, CGT_KD_MAX_DEPTH - 1, CGT_KD_MAX_DEPTH - 1};
    const cgt_memory_hooks hooks = cgt_memory_default();
    const cgt_kd_memory memory = {&c->nodes, &c->references, &c->leaves};
    const cgt_kd_layout layout = (cgt_kd_layout)(CGT_KD_LAYOUT_DEPTH_FIRST + random_below(r, 3));
    const bool built = random_below(r, 3) == 0;
    random_tree tree = {0};
    cgt_buffer work = {0};
    if (built) {
        const cgt_kd_costs cheap = {.inner = 0.1, .test = {1, 1}, .empty_cut_off = 0.2}; /* deep trees */
        assert_int_equal(cgt_kd_build(context, &work, &c->committed_scene, &cheap, &tree.raw), CGT_OK);
    } else {
        const uint32_t depth = depths[random_below(r, TEST_COUNT(depths))];
        tree = random_tree_make(r, &c->committed_scene, depth, random_below(r, 2));
    }
    assert_int_equal(cgt_kd_flatten(context, &memory, &tree.raw, layout, 3, true, &c->papers.kd), CGT_OK);
    assert_int_equal(cgt_leaf_triangles_init(context, &c->triangles, &c->committed_scene), CGT_OK);
    random_tree_free(&tree);
    cgt_buffer_release(&hooks, &work);
}

rope_case *rope_case_make(test_random *r, cgt_context *context, rope_place place)
{
    static const float units[] = {1, 1, 1, 0x1p-100f, 0x1p-20f, 0x1p40f};
    rope_case *c = calloc(1, sizeof *c);
    assert_non_null(c);
    c->place = place;
    c->committed_scene.papers = &c->papers;
    c->unit = units[random_below(r, TEST_COUNT(units))];
    do {
        c->committed_scene.valid = 0;
        make_primitives(r, c);
    } while (!c->committed_scene.valid);
    make_tree(r, context, c);
    c->committed_scene.structure = CGT_STRUCTURE_KD_ROPES;
    return c;
}

void rope_case_free(rope_case *c)
{
    const cgt_memory_hooks hooks = cgt_memory_default();
    cgt_buffer_release(&hooks, &c->nodes);
    cgt_buffer_release(&hooks, &c->references);
    cgt_buffer_release(&hooks, &c->leaves);
    cgt_buffer_release(&hooks, &c->triangles);
    free(c);
}

/* ---- rays ---- */

/* A corner of a leaf; along axes whose bit is set in `inside`, a random coordinate of its box. */
static void leaf_point(test_random *r, const rope_case *c, unsigned inside, float p[3])
{
    const cgt_kd_leaf *leaf = &c->papers.kd.leaf[random_below(r, c->papers.kd.leaves)];
    for (int a = 0; a < 3; a++) {
        const float low = leaf->low[a], high = leaf->high[a];
        p[a] = inside >> a & 1 ? random_float(r, low, high) : random_below(r, 2) ? low : high;
    }
}

static void any_point(test_random *r, const rope_case *c, float p[3])
{
    switch (random_below(r, 4)) {
    case 0:
        for (int a = 0; a < 3; a++)
            p[a] = coordinate(r, c);
        break;
    case 1:
        for (int a = 0; a < 3; a++)
            p[a] = 8 * c->unit * random_float(r, -1, 1);
        break;
    default: leaf_point(r, c, (unsigned)random_below(r, 8), p);
    }
}

/* Zero or nearly zero; most are 0. */
static float no_component(test_random *r)
{
    static const float nothing[] = {0.f,       -0.f,       0.f,      -0.f,      0.f,     -0.f,
                                    0x1p-149f, -0x1p-140f, 0x1p-75f, -0x1p-71f, 0x1p-69f};
    return nothing[random_below(r, TEST_COUNT(nothing))];
}

static void direction(test_random *r, const rope_case *c, const float org[3], float dir[3])
{
    const uint32_t how = random_below(r, 4), drop = random_below(r, 3) ? 0 : 1 + random_below(r, 7);
    float to[3], longest = 0;
    any_point(r, c, to);
    for (int a = 0; a < 3; a++) {
        dir[a] = how == 0 ? (float)random_below(r, 7) - 3 /* hits lattice points exactly */
                          : (to[a] - org[a]) / c->unit;
        dir[a] = drop >> a & 1 ? no_component(r) : dir[a];
        longest = fmaxf(longest, fabsf(dir[a]));
    }
    if (longest < 0x1p-20f)
        dir[random_below(r, 3)] = random_below(r, 2) ? 1.f : -1.f;
    if (random_below(r, 4) == 0)
        for (int a = 0; a < 3; a++)
            dir[a] = ldexpf(dir[a], (int)random_below(r, 50) - 25);
}

truth_ray rope_case_ray(test_random *r, const rope_case *c)
{
    truth_ray ray = {.t_min = 0, .t_max = INFINITY};
    any_point(r, c, ray.org);
    direction(r, c, ray.org, ray.dir);
    const float t = (random_below(r, 2) ? random_float(r, -4, 4) : (float)random_below(r, 9) - 4) * c->unit;
    switch (random_below(r, 8)) {
    case 0: ray.t_min = -INFINITY; break;
    case 1: ray.t_min = t; break;
    case 2: ray.t_max = fabsf(t); break;
    case 3:
        ray.t_min = -fabsf(t);
        ray.t_max = fabsf(t);
        break;
    default: break;
    }
    return ray;
}

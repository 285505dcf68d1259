/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays that the bounds of packets and streams do not cover, one at a time: moved (moved_ray.h), through whatever
 * structure the rays of the call go through. Boxes are missed for certain, hits decided on the ray as it was
 * given; so they are those of every primitive tested exactly. */
#include "exact/valid_primitive.h"
#include "kernel/bvh/bvh_single.h"
#include "kernel/moved/moved_cells.h"
#include "model/triangle_cluster.h"

/* ---- every primitive ---- */

/* For scenes without a structure, and origins so far away that double precision does not tell what they pass. */
static void moved_trace_all(moved_query *u)
{
    const cgt_primitives *prims = &u->committed_scene->prims;
    double t;
    for (uint32_t prim = cgt_next_valid(prims, 0); prim < prims->count; prim = cgt_next_valid(prims, prim + 1)) {
        u->counts->packet_tests++;
        u->counts->ray_tests++;
        if (moved_skips(u, prim))
            continue;
        if (u->list) {
            cgt_hit_list_decide(u->list, prim, CGT_BOTH_SIDES);
            continue;
        }
        if (!filter_is_closer(prims, u->given, u->any_hit ? CGT_INVALID_ID : u->prim, prim, &t, u->counts))
            continue;
        u->prim = prim;
        if (u->any_hit)
            return;
    }
}

/* ---- BVH ---- */

/* The moved ray for the tree's slabs. */
static void moved_init_slabs(const moved_query *u, const bvh_call *c, bvh_ray *r)
{
    float org[3], slab_error[3], rdir[3];
    r->still = 0;
    for (int a = 0; a < 3; a++) {
        r->still |= (uint32_t)(u->given->line.dir[a] == 0) << a;
        r->org[a] = u->moved.start[a];
        r->dir[a] = (float)u->moved.dir[a];
        org[a] = fabsf(r->org[a]);
        rdir[a] = 1 / (fabsf(r->dir[a]) < BVH_MIN_DIR ? copysignf(BVH_MIN_DIR, r->dir[a]) : r->dir[a]);
    }
    bvh_slab_error(c, org, slab_error);
    r->near = u->moved.near_out;
    r->far = u->high;
    bvh_ray_set_slabs(c, rdir, slab_error, r);
}

static void moved_test_leaf(moved_query *u, const cgt_bvh *tree, uint32_t code)
{
    const cgt_bvh_leaf leaf = cgt_bvh_find_leaf(tree, code);
    const uint32_t *prim = leaf.kind == CGT_KIND_SPHERES ? ((const sphere_block *)tree->sphere + leaf.block)->prim
                           : leaf.kind == CGT_KIND_TRIANGLES
                               ? ((const triangle_block *)tree->triangle + leaf.block)->prim
                               : ((const capsule_block *)tree->capsule + leaf.block)->prim;
    u->counts->leaves++;
    moved_test_prims(u, prim, bvh_leaf_count(code));
}

static void moved_trace_bvh(moved_query *u)
{
    bvh_call c;
    bvh_ray r;
    bvh_slabs q;
    bvh_stack s;
    uint32_t code = 0;
    bvh_call_init(u->committed_scene, u->counts, &c);
    moved_init_slabs(u, &c, &r);
    bvh_slabs_init(&r, &q);
    s.top = 0;
    while (code != CGT_BVH_NO_CHILD && !u->done) {
        if (code & CGT_BVH_LEAF) {
            moved_test_leaf(u, c.tree, code);
            r.far = u->high;
            code = CGT_BVH_NO_CHILD;
        } else {
            u->counts->nodes++;
            code = bvh_single_step(&c, &r, &q, (const bvh_node *)c.tree->node + code, &s, false);
        }
        if (code == CGT_BVH_NO_CHILD)
            code = bvh_single_pop(&s, r.far, false);
    }
}

/* ---- loose grid ---- */

/* The valid triangles of a cluster that the ray may meet. In a plane across an axis, half is 0; a ray that does not
 * move along the axis is parallel to them. */
static void moved_test_cluster(moved_query *u, uint32_t number)
{
    const cgt_cluster *c = &u->committed_scene->cluster[number];
    const double scale = (double)u->committed_scene->scale;
    double near = u->moved.near, far = u->high;
    uint32_t prim[CGT_CLUSTER], count = 0;
    for (int a = 0; a < 3; a++) {
        const double middle = (double)c->middle[a], half = (double)c->half[a];
        if (half == 0 && u->given->line.dir[a] == 0)
            return;
        if (!moved_ray_clip(&u->moved, a, (middle - half) * scale, (middle + half) * scale, &near, &far))
            return;
    }
    for (uint32_t valid = c->valid; valid; valid &= valid - 1)
        prim[count++] = number * CGT_CLUSTER + (uint32_t)__builtin_ctz(valid);
    moved_test_prims(u, prim, count);
}

static void moved_visit_loose(moved_query *u, const void *of, const uint32_t cell[3])
{
    const cgt_loose_grid *grid = &u->committed_scene->loose;
    const cgt_loose_level *l = of;
    const uint32_t number = l->first + (cell[2] * l->size[1] + cell[1]) * l->size[0] + cell[0];
    const uint32_t first = grid->start[number], end = grid->start[number + 1];
    u->counts->cells++;
    u->counts->references += end - first;
    if (!u->committed_scene->cluster) {
        moved_test_prims(u, grid->prim + first, end - first);
        return;
    }
    for (uint32_t i = first; i < end && !u->done; i++)
        moved_test_cluster(u, grid->prim[i]);
}

static void moved_trace_loose_grid(moved_query *u)
{
    const double scale = (double)u->committed_scene->scale;
    for (uint32_t i = 0; i < u->committed_scene->loose.levels && !u->done; i++) {
        const cgt_loose_level *l = &u->committed_scene->loose.level[i];
        moved_grid g;
        for (int a = 0; a < 3; a++) {
            g.low[a] = (double)l->low[a] * scale;
            g.cell[a] = (double)l->cell[a] * scale;
            g.rcell[a] = 1 / g.cell[a];
            g.reach[a] = (double)l->reach[a] * scale;
            g.size[a] = l->size[a];
        }
        moved_visit_cells(u, &g, moved_visit_loose, l);
    }
}

/* ---- any ---- */

/* The BVH is read only if the caller says that it is there: another thread may be building it. */
static void moved_trace_structure(moved_query *u, bool use_bvh)
{
    if (use_bvh)
        moved_trace_bvh(u);
    else if (u->committed_scene->structure == CGT_STRUCTURE_LOOSE_GRID)
        moved_trace_loose_grid(u);
    else
        CGT_KERNEL(cgt_papers_trace_unusual)(u);
}

/* What tests need of a ray that was moved. */
static void moved_prims_init(moved_query *u)
{
    float square = 0;
    for (int a = 0; a < 3; a++)
        square += (float)u->moved.dir[a] * (float)u->moved.dir[a];
    u->rdd = 1 / square;
    u->low = u->moved.far_in;
    u->high = u->moved.far_out;
}

/* Moves the ray. */
static moved_state moved_begin(moved_query *u)
{
    return u->committed_scene->brute_force ? MOVED_TOO_FAR : moved_ray_init(&u->moved, u->committed_scene, u->given);
}

uint32_t CGT_KERNEL(cgt_trace_unusual)(const cgt_committed_scene *committed_scene, const cgt_ray *ray, bool use_bvh,
                                       uint32_t skip_prim, uint32_t mask, bool any_hit, cgt_counts *counts)
{
    moved_query u = {.committed_scene = committed_scene,
                     .given = ray,
                     .counts = counts,
                     .skip_prim = skip_prim,
                     .mask = mask,
                     .any_hit = any_hit,
                     .prim = CGT_INVALID_ID};
    const moved_state state = moved_begin(&u);
    if (state == MOVED_MISS)
        return CGT_INVALID_ID;
    if (state == MOVED_TOO_FAR)
        moved_trace_all(&u);
    else {
        moved_prims_init(&u);
        moved_trace_structure(&u, use_bvh);
    }
    return u.prim;
}

/* Hits up to `after` are left out. */
static bool moved_begin_after(moved_ray *m, const cgt_hit_list *list)
{
    const float first = list->has_after ? list->after.low : -INFINITY;
    m->near_out = first > m->near_out ? first : m->near_out;
    m->near = (double)first > m->near ? (double)first : m->near;
    return m->near <= m->far;
}

static void moved_list_hits(const cgt_committed_scene *committed_scene, bool use_bvh, cgt_hit_list *list,
                            cgt_counts *counts)
{
    moved_query u = {.committed_scene = committed_scene,
                     .given = list->ray,
                     .counts = counts,
                     .skip_prim = list->skip,
                     .mask = list->mask,
                     .list = list,
                     .prim = CGT_INVALID_ID};
    const moved_state state = moved_begin(&u);
    if (state == MOVED_TOO_FAR) {
        cgt_hit_list_set_units(list, 1, 0);
        moved_trace_all(&u);
    } else if (state == MOVED_READY) {
        cgt_hit_list_set_units(list, u.moved.speed, u.moved.way);
        moved_prims_init(&u);
        if (moved_begin_after(&u.moved, list))
            moved_trace_structure(&u, use_bvh);
    }
}

void CGT_KERNEL(cgt_list_unusual)(const cgt_committed_scene *committed_scene, bool use_bvh, cgt_hit_list *lists,
                                  uint32_t count, cgt_counts *counts)
{
    for (uint32_t i = 0; i < count; i++)
        moved_list_hits(committed_scene, use_bvh, &lists[i], counts);
}

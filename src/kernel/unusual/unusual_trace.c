/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays that the bounds of packets and streams do not cover, one at a time: moved (moved_ray.h), through whatever
 * structure the rays of the call go through. Boxes are missed for certain, hits decided on the ray as it was
 * given; so they are those of every primitive tested exactly. */
#include "exact/valid_primitive.h"
#include "kernel/bvh/bvh_single.h"
#include "kernel/unusual/unusual_cells.h"

/* ---- every primitive ---- */

/* For scenes without a structure, and origins so far away that double precision does not tell what they pass. */
static void unusual_trace_all(unusual_ray *u)
{
    const cgt_primitives *prims = &u->committed_scene->prims;
    double t;
    for (uint32_t prim = cgt_next_valid(prims, 0); prim < prims->count; prim = cgt_next_valid(prims, prim + 1)) {
        u->counts->packet_tests++;
        u->counts->ray_tests++;
        if (unusual_skips(u, prim) ||
            !filter_is_closer(prims, u->given, u->any_hit ? CGT_INVALID_ID : u->prim, prim, &t, u->counts))
            continue;
        u->prim = prim;
        if (u->any_hit)
            return;
    }
}

/* ---- BVH ---- */

/* The moved ray for the tree's slabs, whose slack has the origin's error besides. */
static void unusual_init_slabs(const unusual_ray *u, const bvh_call *c, bvh_ray *r)
{
    float org[3], slab_error[3], rdir[3];
    for (int a = 0; a < 3; a++) {
        r->org[a] = u->moved.start[a];
        r->dir[a] = (float)u->moved.dir[a];
        org[a] = fabsf(r->org[a]);
        rdir[a] = 1 / (fabsf(r->dir[a]) < BVH_MIN_DIR ? copysignf(BVH_MIN_DIR, r->dir[a]) : r->dir[a]);
    }
    bvh_slab_error(c, org, slab_error);
    for (int a = 0; a < 3; a++)
        slab_error[a] += u->moved.start_error * 1.125f; /* second order terms */
    r->near = u->moved.near_out;
    r->far = u->high;
    bvh_ray_set_slabs(c, rdir, slab_error, r);
}

static void unusual_test_leaf(unusual_ray *u, const cgt_bvh *tree, uint32_t code)
{
    const uint32_t index = code & CGT_BVH_INDEX_MASK;
    const uint32_t *prim = code & CGT_BVH_TRIANGLE_LEAF ? ((const triangle_block *)tree->triangle + index)->prim
                                                        : ((const sphere_block *)tree->sphere + index)->prim;
    u->counts->leaves++;
    unusual_test_prims(u, prim, bvh_leaf_count(code));
}

static void unusual_trace_bvh(unusual_ray *u)
{
    bvh_call c;
    bvh_ray r;
    bvh_stack s;
    uint32_t code = 0;
    bvh_call_init(u->committed_scene, u->counts, &c);
    unusual_init_slabs(u, &c, &r);
    s.top = 0;
    for (;;) {
        if (code & CGT_BVH_LEAF)
            unusual_test_leaf(u, c.tree, code);
        else
            bvh_single_node(&c, &r, (const bvh_node *)c.tree->node + code, &s, false);
        r.far = u->high;
        do {
            if (!s.top || u->done)
                return;
            s.top--;
        } while (s.near[s.top] > r.far);
        code = s.code[s.top];
    }
}

/* ---- kd-tree ---- */

typedef struct unusual_kd_entry {
    double near, far;
    uint32_t node;
} unusual_kd_entry;

/* Descends to a leaf; children that the ray may reach later go to the stack. An interval ends a little beyond the split
 * on either side, by the bounds of moved_ray_clip. */
static uint32_t unusual_descend(const unusual_ray *u, unusual_kd_entry entry, unusual_kd_entry *stack, uint32_t *top)
{
    const cgt_kd_tree *tree = &u->committed_scene->kd;
    for (cgt_kd_node n = tree->node[entry.node]; !cgt_kd_is_leaf(n); n = tree->node[entry.node]) {
        const uint32_t a = cgt_kd_axis(n), upper_first = u->moved.dir[a] < 0;
        const double split = (double)cgt_kd_split(n) * (double)u->committed_scene->scale;
        unusual_kd_entry part[2] = {entry, entry}; /* below, above */
        const bool below = moved_ray_clip(&u->moved, (int)a, -8, split, &part[0].near, &part[0].far);
        const bool above = moved_ray_clip(&u->moved, (int)a, split, 8, &part[1].near, &part[1].far);
        u->counts->nodes++;
        part[0].node = n.word[1];
        part[1].node = n.word[1] + 1;
        if (below && above)
            stack[(*top)++] = part[!upper_first];
        entry = below && above ? part[upper_first] : part[above];
    }
    return entry.node;
}

static void unusual_trace_kd(unusual_ray *u)
{
    const cgt_kd_tree *tree = &u->committed_scene->kd;
    unusual_kd_entry stack[CGT_KD_MAX_DEPTH + 1], entry = {u->moved.near, u->moved.far, 0};
    uint32_t top = 0;
    for (;;) {
        const cgt_kd_node *leaf = &tree->node[unusual_descend(u, entry, stack, &top)];
        u->counts->leaves++;
        u->counts->references += cgt_kd_count(*leaf);
        if (cgt_kd_count(*leaf))
            unusual_test_prims(u, cgt_kd_references(tree, leaf), cgt_kd_count(*leaf));
        do {
            if (!top || u->done)
                return;
            entry = stack[--top];
        } while (entry.near > (double)u->high);
    }
}

/* ---- BIH ---- */

/* Steps from an inner node: entry becomes the child that the ray passes first, and the other one goes to the stack.
 * False where it passes none. */
static bool unusual_bih_step(const unusual_ray *u, const cgt_bih_node *n, unusual_kd_entry *entry,
                             unusual_kd_entry *stack, uint32_t *top)
{
    const int a = (int)cgt_bih_axis(n);
    const uint32_t child = n->word[3], upper_first = u->moved.dir[a] < 0;
    const double scale = (double)u->committed_scene->scale, plane0 = (double)cgt_bih_plane(n, 0) * scale,
                 plane1 = (double)cgt_bih_plane(n, 1) * scale;
    unusual_kd_entry part[2] = {*entry, *entry}; /* of the lower child, of the upper one */
    part[0].node = child;
    part[1].node = child + 1;
    if (cgt_bih_is_clip(n)) {
        *entry = part[0];
        return moved_ray_clip(&u->moved, a, plane0, plane1, &entry->near, &entry->far);
    }
    const bool below = moved_ray_clip(&u->moved, a, -8, plane0, &part[0].near, &part[0].far);
    const bool above = moved_ray_clip(&u->moved, a, plane1, 8, &part[1].near, &part[1].far);
    if (below && above)
        stack[(*top)++] = part[!upper_first];
    *entry = below && above ? part[upper_first] : part[above];
    return below || above;
}

static void unusual_trace_bih(unusual_ray *u)
{
    const cgt_bih *tree = &u->committed_scene->bih;
    unusual_kd_entry stack[CGT_BIH_MAX_DEPTH], entry = {u->moved.near, u->moved.far, 0};
    uint32_t top = 0;
    for (;;) {
        const cgt_bih_node *n = &tree->node[entry.node];
        bool passes = true;
        for (; passes && !cgt_bih_is_leaf(n); n = &tree->node[entry.node]) {
            u->counts->nodes++;
            passes = unusual_bih_step(u, n, &entry, stack, &top);
        }
        if (passes) {
            u->counts->leaves++;
            u->counts->references += cgt_bih_count(n);
            unusual_test_prims(u, cgt_bih_references(tree, n), cgt_bih_count(n));
        }
        do {
            if (!top || u->done)
                return;
            entry = stack[--top];
        } while (entry.near > (double)u->high);
    }
}

/* ---- any ---- */

/* The BVH is not looked at but where the caller says that it is there: another thread may be building it. */
static void unusual_trace_structure(unusual_ray *u, bool use_bvh)
{
    const cgt_structure structure = u->committed_scene->structure;
    if (use_bvh)
        unusual_trace_bvh(u);
    else if (structure == CGT_STRUCTURE_KD || structure == CGT_STRUCTURE_KD_ROPES)
        unusual_trace_kd(u);
    else if (structure == CGT_STRUCTURE_BIH)
        unusual_trace_bih(u);
    else if (structure == CGT_STRUCTURE_LOOSE_GRID)
        unusual_trace_loose_grid(u);
    else
        unusual_trace_queue_grid(u);
}

__attribute__((cold)) uint32_t CGT_KERNEL(cgt_trace_unusual)(const cgt_committed_scene *committed_scene,
                                                             const cgt_ray *ray, bool use_bvh, uint32_t skip_prim,
                                                             uint32_t mask, bool any_hit, cgt_counts *counts)
{
    unusual_ray u = {.committed_scene = committed_scene,
                     .given = ray,
                     .counts = counts,
                     .skip_prim = skip_prim,
                     .mask = mask,
                     .any_hit = any_hit,
                     .prim = CGT_INVALID_ID};
    const bool ordinary =
        !committed_scene->brute_force && committed_scene->scale <= 0x1p60f && committed_scene->scale >= 0x1p-60f;
    const moved_state state = ordinary ? moved_ray_init(&u.moved, committed_scene, ray) : MOVED_TOO_FAR;
    if (state == MOVED_MISS)
        return CGT_INVALID_ID;
    if (state == MOVED_TOO_FAR)
        unusual_trace_all(&u);
    else {
        unusual_prims_init(&u);
        unusual_trace_structure(&u, use_bvh);
    }
    return u.prim;
}

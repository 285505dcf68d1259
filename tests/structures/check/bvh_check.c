/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Checks a BVH from the root down. */
#include "exact/valid_primitive.h"
#include "structures/check/bvh_check.h"

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/oracle/dyadic.h"
#include "kernel/bvh/bvh_node.h"

static _Thread_local char fault_text[160];

__attribute__((format(printf, 1, 2))) static const char *fault(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vsnprintf(fault_text, sizeof fault_text, format, list);
    va_end(list);
    return fault_text;
}

/* A node to visit and the box that its parent gives it. */
typedef struct visit {
    uint32_t node, depth;
    float low[3], high[3];
} visit;

typedef struct walk {
    const cgt_committed_scene *committed_scene;
    const cgt_bvh *tree;
    const bvh_node *node;
    uint8_t *reached;      /* primitives */
    uint8_t *reached_node; /* nodes */
    visit *stack;
    uint32_t waiting, nodes, blocks[CGT_KINDS], prims, depth;
} walk;

/* ---- leaves ---- */

static bool sphere_within(const cgt_sphere *q, const float low[3], const float high[3])
{
    const float center[3] = {q->x, q->y, q->z};
    for (int a = 0; a < 3; a++) {
        /* a value that rounds beyond a float lies beyond it */
        if ((double)center[a] - q->r > low[a] && (double)center[a] + q->r < high[a])
            continue;
        const dyadic c = dyadic_of_float(center[a]), r = dyadic_of_float(q->r);
        const dyadic l = dyadic_of_float(low[a]), h = dyadic_of_float(high[a]);
        const dyadic from = dyadic_sub(&c, &r), to = dyadic_add(&c, &r);
        const dyadic below = dyadic_sub(&from, &l), above = dyadic_sub(&h, &to);
        if (below.sign < 0 || above.sign < 0)
            return false;
    }
    return true;
}

static bool triangle_within(const cgt_triangle *q, const float low[3], const float high[3])
{
    bool within = true;
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            within &= low[a] <= q->v[k][a] && q->v[k][a] <= high[a];
    return within;
}

static const char *check_sphere(const sphere_block *b, uint32_t k, const cgt_sphere *q)
{
    const float got[4] = {b->center[0][k], b->center[1][k], b->center[2][k], b->radius[k]};
    return memcmp(got, q, sizeof got) ? fault("sphere %u differs from the caller's", b->prim[k]) : NULL;
}

static const char *check_triangle(const triangle_block *b, uint32_t k, const cgt_triangle *q, float scale)
{
    bool same = true;
    for (int a = 0; a < 3; a++)
        same &= b->vertex[a][k] == q->v[0][a] * scale;
    for (int e = 0; e < 2; e++) {
        float sum = 0;
        for (int a = 0; a < 3; a++) {
            const float edge = q->v[e + 1][a] * scale - q->v[0][a] * scale;
            same &= b->edge[e][a][k] == edge;
            sum = a ? sum + fabsf(edge) : fabsf(edge);
        }
        same &= b->sum[e][k] == sum;
    }
    return same ? NULL : fault("triangle %u is wrong", b->prim[k]);
}

/* Whether a leaf's triangles all lie in one plane across axis a; others never do. */
static bool leaf_is_flat(const walk *w, uint32_t code, int a)
{
    const cgt_bvh_leaf leaf = cgt_bvh_find_leaf(w->tree, code);
    bool flat = leaf.kind == CGT_KIND_TRIANGLES;
    if (!flat)
        return false;
    const triangle_block *b = (const triangle_block *)w->tree->triangle + leaf.block;
    const float height = cgt_primitives_get(&w->committed_scene->prims, b->prim[0]).triangle.v[0][a];
    for (uint32_t k = 0; k < bvh_leaf_count(code); k++)
        for (int i = 0; i < 3; i++)
            flat &= cgt_primitives_get(&w->committed_scene->prims, b->prim[k]).triangle.v[i][a] == height;
    return flat;
}

/* Ends and radii are exact, bounds rounded twice. */
static bool capsule_within(const cgt_capsule *q, const float low[3], const float high[3])
{
    bool within = true;
    for (int a = 0; a < 3; a++) {
        const double least = fmin((double)q->p[a], (double)q->q[a]), most = fmax((double)q->p[a], (double)q->q[a]);
        within &= (double)low[a] <= least - (double)q->r && most + (double)q->r <= (double)high[a];
    }
    return within;
}

static const char *check_capsule(const capsule_block *b, uint32_t k, const cgt_capsule *q, float scale)
{
    bool same = b->radius[k] == q->r * scale;
    for (int a = 0; a < 3; a++)
        same &= b->end[0][a][k] == q->p[a] * scale && b->end[1][a][k] == q->q[a] * scale;
    return same ? NULL : fault("capsule %u is wrong", b->prim[k]);
}

static const uint32_t *prims_of(const cgt_bvh *t, cgt_bvh_leaf leaf)
{
    switch (leaf.kind) {
    case CGT_KIND_SPHERES: return ((const sphere_block *)t->sphere)[leaf.block].prim;
    case CGT_KIND_TRIANGLES: return ((const triangle_block *)t->triangle)[leaf.block].prim;
    case CGT_KIND_CAPSULES: break;
    }
    return ((const capsule_block *)t->capsule)[leaf.block].prim;
}

/* Lane k of a leaf holds primitive q, which is within the bounds. */
static const char *check_lane(const walk *w, cgt_bvh_leaf leaf, uint32_t k, const cgt_primitive *q, const float low[3],
                              const float high[3])
{
    const cgt_bvh *t = w->tree;
    const float scale = w->committed_scene->scale;
    const char *wrong = NULL;
    bool within = false;
    switch (leaf.kind) {
    case CGT_KIND_SPHERES:
        within = sphere_within(&q->sphere, low, high);
        wrong = check_sphere((const sphere_block *)t->sphere + leaf.block, k, &q->sphere);
        break;
    case CGT_KIND_TRIANGLES:
        within = triangle_within(&q->triangle, low, high);
        wrong = check_triangle((const triangle_block *)t->triangle + leaf.block, k, &q->triangle, scale);
        break;
    case CGT_KIND_CAPSULES:
        within = capsule_within(&q->capsule, low, high);
        wrong = check_capsule((const capsule_block *)t->capsule + leaf.block, k, &q->capsule, scale);
        break;
    }
    return within ? wrong : fault("a primitive of leaf %u of kind %d is not within it", leaf.block, (int)leaf.kind);
}

static const char *check_leaf(walk *w, uint32_t code, const float low[3], const float high[3])
{
    const cgt_bvh_leaf leaf = cgt_bvh_find_leaf(w->tree, code);
    const uint32_t count = bvh_leaf_count(code);
    const uint32_t blocks[CGT_KINDS] = {w->tree->sphere_blocks, w->tree->triangle_blocks, w->tree->capsule_blocks};
    if (leaf.block >= blocks[leaf.kind] || count > CGT_LANES)
        return fault("leaf %08x: number or count", code);
    const uint32_t *prim = prims_of(w->tree, leaf);
    w->blocks[leaf.kind]++;
    w->prims += count;
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        if (prim[k] >= w->committed_scene->prims.count)
            return fault("leaf %08x: primitive %u", code, prim[k]);
        if (k < count ? w->reached[prim[k]]++ : prim[k] != prim[count - 1])
            return fault("primitive %u is in two leaves", prim[k]);
        if (k && prim[k] == prim[k - 1])
            continue;
        const cgt_primitive q = cgt_primitives_get(&w->committed_scene->prims, prim[k]);
        if (q.kind != leaf.kind || cgt_primitive_check(&q) != CGT_PRIMITIVE_VALID)
            return fault("primitive %u is of another kind, or invalid", prim[k]);
        const char *wrong = check_lane(w, leaf, k, &q, low, high);
        if (wrong)
            return wrong;
    }
    return NULL;
}

/* ---- nodes ---- */

static double along(const bvh_node *n, uint32_t child, uint32_t octant)
{
    double sum = 0;
    for (uint32_t a = 0; a < 3; a++) {
        const double middle = (double)n->low[a][child] + (double)n->high[a][child];
        sum += octant >> a & 1 ? -middle : middle;
    }
    return sum;
}

/* Allows for rounded sums. */
static const char *check_order(const bvh_node *n, uint32_t number, uint32_t octant)
{
    const uint8_t *order = n->order[octant];
    double size = 0;
    uint32_t lanes = 0;
    for (uint32_t k = 0; k < n->children; k++)
        for (int a = 0; a < 3; a++)
            size = fmax(size, fmax(fabs((double)n->low[a][k]), fabs((double)n->high[a][k])));
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        if (order[k] >= CGT_LANES || (order[k] < n->children) != (k < n->children))
            return fault("node %u: order of octant %u", number, octant);
        lanes |= 1u << order[k];
        if (k && k < n->children &&
            along(n, order[k], octant) < along(n, order[k - 1], octant) - size * 0x1p-18 - 0x1p-140)
            return fault("node %u: children are out of order for octant %u", number, octant);
    }
    return lanes == CGT_ALL_LANES ? NULL : fault("node %u: a lane is missing in the order", number);
}

/* Planes lie outside by 2^-20 of their size: see kernel/bvh/bvh_ray.h. Rounding takes a sixteenth of that where the
 * box itself was exact, as those of triangles are. Those of spheres and capsules have 2^-23 of their own: more. */
static const char *check_margined_leaf(walk *w, const visit *v)
{
    const cgt_kind kind = cgt_bvh_find_leaf(w->tree, v->node).kind;
    const float margin = kind == CGT_KIND_TRIANGLES ? 0x1.cp-21f : 0x1.fcp-21f;
    float low[3], high[3];
    for (int a = 0; a < 3; a++) {
        low[a] = v->low[a] + fabsf(v->low[a]) * margin;
        high[a] = v->high[a] - fabsf(v->high[a]) * margin;
    }
    return check_leaf(w, v->node, low, high);
}

/* Whether turned slabs of a child hold all capsules below it: planes are times the scene's scale, doubles exact but for
 * 2^-50. A margin of 2^-21 remains of what the planes were moved by. */
static const char *check_turned(const walk *w, const visit *v, uint32_t child, uint32_t code)
{
    const bvh_turned *t = (const bvh_turned *)w->tree->turned + v->node;
    const double scale = (double)w->committed_scene->scale;
    if (!(code & CGT_BVH_LEAF)) {
        const bvh_node *n = &w->node[code];
        const char *wrong = NULL;
        for (uint32_t k = 0; k < n->children && !wrong; k++)
            wrong = check_turned(w, v, child, n->child[k]);
        return wrong;
    }
    const cgt_bvh_leaf leaf = cgt_bvh_find_leaf(w->tree, code);
    if (leaf.kind != CGT_KIND_CAPSULES)
        return fault("node %u: turned slabs of other kinds", v->node);
    for (uint32_t k = 0; k < bvh_leaf_count(code); k++) {
        const cgt_capsule q = cgt_primitives_get(&w->committed_scene->prims, prims_of(w->tree, leaf)[k]).capsule;
        for (int i = 0; i < 2; i++) {
            double at[2] = {0, 0}, size = 0, length = 0;
            for (int a = 0; a < 3; a++) {
                const double u = (double)t->across[i][a];
                at[0] += u * (double)q.p[a] * scale;
                at[1] += u * (double)q.q[a] * scale;
                size = fmax(size, fmax(fabs((double)q.p[a]), fabs((double)q.q[a])) * scale);
                length += u * u;
            }
            const double r = (double)q.r * scale, margin = size * 0x1p-21;
            if (length > 1 || fmin(at[0], at[1]) - r - margin < (double)t->low[i][child] ||
                fmax(at[0], at[1]) + r + margin > (double)t->high[i][child])
                return fault("node %u: turned slab %d of child %u", v->node, i, child);
        }
    }
    return NULL;
}

static const char *check_children(walk *w, const visit *v)
{
    const bvh_node *n = &w->node[v->node];
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        visit child = {.node = n->child[k], .depth = v->depth + 1};
        bool within = true, empty = n->child[k] == CGT_BVH_NO_CHILD;
        for (int a = 0; a < 3; a++) {
            child.low[a] = n->low[a][k];
            child.high[a] = n->high[a][k];
            within &= v->low[a] <= child.low[a] && child.low[a] <= child.high[a] && child.high[a] <= v->high[a];
            empty &= child.low[a] == INFINITY && child.high[a] == -INFINITY;
        }
        if (k < n->children ? !within : !empty)
            return fault("node %u: box of child %u", v->node, k);
        if (k >= n->children)
            continue;
        const char *wrong = NULL;
        for (int a = 0; a < 3 && !wrong && child.node & CGT_BVH_LEAF; a++)
            if ((n->flat[a] >> k & 1) != leaf_is_flat(w, child.node, a))
                wrong = fault("node %u: child %u is flat, or not", v->node, k);
        if (!wrong && n->flat[0] & BVH_TURNED)
            wrong = check_turned(w, v, k, child.node);
        if (wrong)
            return wrong;
        if (child.node & CGT_BVH_LEAF)
            wrong = check_margined_leaf(w, &child);
        else if (child.node >= w->tree->nodes || w->reached_node[child.node]++)
            wrong = fault("node %u: child %u has number %u", v->node, k, child.node);
        else
            w->stack[w->waiting++] = child;
        if (wrong)
            return wrong;
    }
    return NULL;
}

static const char *check_node(walk *w, const visit *v)
{
    const bvh_node *n = &w->node[v->node];
    const char *wrong = NULL;
    w->nodes++;
    w->depth = v->depth > w->depth ? v->depth : w->depth;
    if (n->children < (v->node ? 2u : 1u) || n->children > CGT_LANES)
        return fault("node %u: %u children", v->node, n->children);
    for (uint32_t octant = 0; octant < 4 && !wrong; octant++)
        wrong = check_order(n, v->node, octant);
    return wrong ? wrong : check_children(w, v);
}

static const char *check_counts(const walk *w)
{
    const cgt_bvh *t = w->tree;
    if (w->nodes != t->nodes || w->blocks[0] != t->sphere_blocks || w->blocks[1] != t->triangle_blocks ||
        w->blocks[2] != t->capsule_blocks)
        return fault("%u nodes, %u, %u and %u blocks of %u, %u, %u and %u", w->nodes, w->blocks[0], w->blocks[1],
                     w->blocks[2], t->nodes, t->sphere_blocks, t->triangle_blocks, t->capsule_blocks);
    if (w->prims != w->committed_scene->valid)
        return fault("%u primitives of %u", w->prims, w->committed_scene->valid);
    if (w->depth != t->depth || t->depth > CGT_BVH_MAX_DEPTH)
        return fault("depth %u, but the BVH states %u", w->depth, t->depth);
    return NULL;
}

const char *bvh_check(const cgt_committed_scene *committed_scene)
{
    const cgt_bvh *t = &committed_scene->bvh;
    walk w = {.committed_scene = committed_scene, .tree = t, .node = t->node};
    const char *wrong = NULL;
    if (!t->node)
        return committed_scene->valid && !committed_scene->brute_force ? fault("there is no BVH") : NULL;
    w.reached = calloc((size_t)committed_scene->prims.count + 1, 1);
    w.reached_node = calloc((size_t)t->nodes + 1, 1);
    w.stack = malloc(((size_t)t->nodes + 1) * sizeof *w.stack);
    if (!w.reached || !w.reached_node || !w.stack)
        wrong = fault("out of memory");
    else {
        visit root = {.depth = 1};
        for (int a = 0; a < 3; a++) {
            root.low[a] = t->low[a] - fabsf(t->low[a]) * 0x1p-19f;
            root.high[a] = t->high[a] + fabsf(t->high[a]) * 0x1p-19f;
        }
        w.stack[w.waiting++] = root;
        w.reached_node[0] = 1;
    }
    while (!wrong && w.waiting) {
        const visit v = w.stack[--w.waiting];
        wrong = check_node(&w, &v);
    }
    free(w.reached);
    free(w.reached_node);
    free(w.stack);
    return wrong ? wrong : check_counts(&w);
}

bool bvh_equal(const cgt_bvh *a, const cgt_bvh *b)
{
    const bvh_node *n = a->node, *m = b->node;
    const bvh_turned *t = a->turned, *u = b->turned;
    bool same = a->nodes == b->nodes && a->sphere_blocks == b->sphere_blocks &&
                a->triangle_blocks == b->triangle_blocks && a->capsule_blocks == b->capsule_blocks &&
                a->depth == b->depth && !memcmp(a->low, b->low, sizeof a->low) &&
                !memcmp(a->high, b->high, sizeof a->high);
    for (uint32_t i = 0; same && i < a->nodes; i++) /* without a node's padding */
        same = !memcmp(&n[i], &m[i], offsetof(bvh_node, flat) + sizeof n[i].flat) &&
               (!(n[i].flat[0] & BVH_TURNED) || !memcmp(&t[i], &u[i], offsetof(bvh_turned, across) + sizeof t->across));
    return same && (!a->sphere_blocks || !memcmp(a->sphere, b->sphere, a->sphere_blocks * sizeof(sphere_block))) &&
           (!a->triangle_blocks || !memcmp(a->triangle, b->triangle, a->triangle_blocks * sizeof(triangle_block))) &&
           (!a->capsule_blocks || !memcmp(a->capsule, b->capsule, a->capsule_blocks * sizeof(capsule_block)));
}

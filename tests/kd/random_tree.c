/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Random kd-trees. Nodes to be split are taken from the end of the list or from a random position, so that some trees
 * are deep and some broad; then the pairs of children get random positions. */
#include "exact/valid_primitive.h"
#include "kd/random_tree.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct box {
    float low[3], high[3];
} box;

/* A node that may be split; its primitives are in the list. */
typedef struct waiting {
    uint32_t node, depth;
    size_t first, count;
    box box;
} waiting;

typedef struct growth {
    test_random *random;
    const cgt_primitives *prims;
    double (*low)[3], (*high)[3]; /* bounds, by primitive */
    cgt_kd_node *node;
    uint32_t nodes, node_room;
    uint32_t *list; /* primitives of each node made so far, inner nodes included: gaps in the final references */
    size_t listed, list_room;
    waiting *open;
    uint32_t opened;
    uint32_t max_depth, leaf_size;
    bool deep;
} growth;

static void *get(size_t count, size_t size)
{
    void *memory = calloc(count ? count : 1, size);
    if (!memory) {
        fprintf(stderr, "random_tree: out of memory\n");
        abort();
    }
    return memory;
}

void object_bounds(const cgt_primitives *prims, uint32_t prim, double low[3], double high[3])
{
    const cgt_primitive s = cgt_primitives_get(prims, prim);
    const float center[3] = {s.sphere.x, s.sphere.y, s.sphere.z};
    for (int a = 0; a < 3; a++) {
        if (s.kind == CGT_KIND_SPHERES) {
            low[a] = nextafter((double)center[a] - (double)s.sphere.r, -INFINITY);
            high[a] = nextafter((double)center[a] + (double)s.sphere.r, INFINITY);
        } else {
            low[a] = (double)fminf(fminf(s.triangle.v[0][a], s.triangle.v[1][a]), s.triangle.v[2][a]);
            high[a] = (double)fmaxf(fmaxf(s.triangle.v[0][a], s.triangle.v[1][a]), s.triangle.v[2][a]);
        }
    }
}

/* ---- where to split ---- */

static float object_coordinate(growth *g, const waiting *w, uint32_t axis)
{
    const uint32_t prim = g->list[w->first + random_below(g->random, (uint32_t)w->count)];
    const cgt_primitive s = cgt_primitives_get(g->prims, prim);
    if (s.kind == CGT_KIND_TRIANGLES)
        return s.triangle.v[random_below(g->random, 3)][axis];
    switch (random_below(g->random, 3)) {
    case 0: return axis == 0 ? s.sphere.x : axis == 1 ? s.sphere.y : s.sphere.z;
    case 1: return (float)g->low[prim][axis];
    default: return (float)g->high[prim][axis];
    }
}

static float any_position(growth *g, const waiting *w, uint32_t axis)
{
    const float low = w->box.low[axis], high = w->box.high[axis];
    const double thin = ((double)high - (double)low) * ldexp(1, -(int)random_below(g->random, 24));
    switch (random_below(g->random, 10)) {
    case 0: return low;
    case 1: return high;
    case 2: return (float)(low + thin);
    case 3: return (float)(high - thin);
    case 4:
    case 5:
    case 6:
        if (w->count)
            return object_coordinate(g, w, axis);
        return low / 2 + high / 2;
    default: return random_float(g->random, low, high);
    }
}

/* Rounds the split to a float that a node can hold, within the box; false if no neighbouring float qualifies. */
static bool fit_split(const box *b, uint32_t axis, float *split)
{
    const float nearer = cgt_kd_round_split(*split);
    float further;
    uint32_t bits;
    memcpy(&bits, &nearer, sizeof bits);
    bits += 4;
    memcpy(&further, &bits, sizeof further);
    *split = nearer >= b->low[axis] && nearer <= b->high[axis] ? nearer : further;
    return *split >= b->low[axis] && *split <= b->high[axis];
}

static bool choose(growth *g, const waiting *w, uint32_t *axis, float *split)
{
    if (w->depth >= g->max_depth || g->nodes + 2 > g->node_room || g->listed + 2 * w->count > g->list_room)
        return false;
    if (w->depth && random_below(g->random, 16) < (w->count > g->leaf_size ? 1u : 12u))
        return false;
    *axis = random_below(g->random, 3);
    *split = any_position(g, w, *axis);
    return fit_split(&w->box, *axis, split);
}

/* ---- growing ---- */

/* Opens a child with the primitives of the parent that touch its side of the split. */
static void open_child(growth *g, const waiting *parent, uint32_t node, uint32_t axis, float split, bool upper)
{
    waiting child = {node, parent->depth + 1, g->listed, 0, parent->box};
    *(upper ? &child.box.low[axis] : &child.box.high[axis]) = split;
    for (size_t i = 0; i < parent->count; i++) {
        const uint32_t prim = g->list[parent->first + i];
        if (upper ? g->high[prim][axis] >= split : g->low[prim][axis] <= split)
            g->list[g->listed++] = prim;
    }
    child.count = g->listed - child.first;
    g->open[g->opened++] = child;
}

static void grow(growth *g)
{
    while (g->opened) {
        uint32_t axis,
            pick = g->deep && random_below(g->random, 4) ? g->opened - 1 : random_below(g->random, g->opened);
        float split;
        const waiting w = g->open[pick];
        g->open[pick] = g->open[--g->opened];
        if (!choose(g, &w, &axis, &split)) {
            g->node[w.node] = cgt_kd_leaf_node((uint32_t)w.count, (uint32_t)w.first);
            continue;
        }
        const uint32_t lower = g->nodes;
        g->node[w.node] = cgt_kd_inner(axis, split, lower);
        g->nodes += 2;
        open_child(g, &w, lower, axis, split, false);
        open_child(g, &w, lower + 1, axis, split, true);
    }
}

/* Gives each pair of children one of twice as many positions; the entries between hold nothing valid. */
static cgt_kd_node *scatter(growth *g, uint32_t *nodes)
{
    const uint32_t pairs = (g->nodes - 2) / 2, places = 2 * pairs, start = 1 + random_below(g->random, 2);
    uint32_t *place = get(places, sizeof *place);
    *nodes = start + 2 * places;
    cgt_kd_node *node = get(*nodes, sizeof *node);
    memset(node, 0xee, *nodes * sizeof *node);
    for (uint32_t i = 0; i < places; i++) {
        const uint32_t other = random_below(g->random, i + 1);
        place[i] = place[other];
        place[other] = i;
    }
    for (uint32_t i = 0; i < g->nodes; i++) {
        cgt_kd_node n = g->node[i];
        if (i == 1) /* not used */
            continue;
        if (!cgt_kd_is_leaf(n))
            n.word[1] = start + 2 * place[(n.word[1] - 2) / 2];
        node[i ? start + 2 * place[(i - 2) / 2] + (i & 1) : 0] = n;
    }
    free(place);
    return node;
}

static void bound_objects(growth *g)
{
    const cgt_primitives *prims = g->prims;
    g->low = get(prims->count, sizeof *g->low);
    g->high = get(prims->count, sizeof *g->high);
    for (uint32_t i = 0; i < prims->count; i++) {
        const cgt_primitive s = cgt_primitives_get(prims, i);
        if (cgt_primitive_check(&s) != CGT_PRIMITIVE_VALID)
            continue;
        object_bounds(prims, i, g->low[i], g->high[i]);
        g->list[g->listed++] = i;
    }
}

static random_tree finish(growth *g, const cgt_committed_scene *committed_scene)
{
    random_tree tree = {.reference = g->list};
    tree.node = scatter(g, &tree.raw.nodes);
    tree.raw.node = tree.node;
    tree.raw.reference = tree.reference;
    memcpy(tree.raw.low, committed_scene->low, sizeof tree.raw.low);
    memcpy(tree.raw.high, committed_scene->high, sizeof tree.raw.high);
    free(g->low);
    free(g->high);
    free(g->node);
    free(g->open);
    return tree;
}

random_tree random_tree_make(test_random *r, const cgt_committed_scene *committed_scene, uint32_t max_depth,
                             uint32_t leaf_size)
{
    growth g = {
        .random = r, .prims = &committed_scene->prims, .max_depth = max_depth, .leaf_size = leaf_size, .nodes = 2};
    waiting root = {0};
    g.deep = random_below(r, 2);
    g.node_room = 16 * (committed_scene->valid < (1u << 26) ? committed_scene->valid : 1u << 26) + 512;
    g.list_room = 256 * (size_t)committed_scene->valid + 4096;
    g.node = get(g.node_room, sizeof *g.node);
    g.open = get(g.node_room, sizeof *g.open);
    g.list = get(g.list_room, sizeof *g.list);
    bound_objects(&g);
    root.count = g.listed;
    memcpy(root.box.low, committed_scene->low, sizeof root.box.low);
    memcpy(root.box.high, committed_scene->high, sizeof root.box.high);
    g.open[g.opened++] = root;
    grow(&g);
    return finish(&g, committed_scene);
}

random_tree random_tree_leaf(const cgt_committed_scene *committed_scene)
{
    test_random r = random_make(0);
    return random_tree_make(&r, committed_scene, 0, 0);
}

void random_tree_free(random_tree *tree)
{
    free(tree->node);
    free(tree->reference);
    *tree = (random_tree){0};
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Checks a bounding interval hierarchy from the root down. */
#include "exact/valid_primitive.h"
#include "structures/check/structure_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "papers/build/bih/bih_build.h"

typedef struct box64 {
    double low[3], high[3];
} box64;

typedef struct checker {
    const cgt_bih *tree;
    const cgt_primitives *prims;
    uint8_t *seen_node, *seen_prim;
    uint32_t nodes, clips, leaves, depth, largest_leaf;
    uint64_t references;
} checker;

static box64 box_of(const cgt_primitive *primitive)
{
    box64 b;
    for (int a = 0; a < 3; a++) {
        if (primitive->kind == CGT_KIND_SPHERES) {
            const float c[3] = {primitive->sphere.x, primitive->sphere.y, primitive->sphere.z};
            b.low[a] = (double)c[a] - (double)primitive->sphere.r;
            b.high[a] = (double)c[a] + (double)primitive->sphere.r;
            continue;
        }
        const float(*v)[3] = primitive->triangle.v;
        b.low[a] = fmin((double)v[0][a], fmin((double)v[1][a], (double)v[2][a]));
        b.high[a] = fmax((double)v[0][a], fmax((double)v[1][a], (double)v[2][a]));
    }
    return b;
}

/* The planes on the way to a leaf bound its primitives, with half the margin to spare. */
static void check_leaf(checker *c, const cgt_bih_node *n, const box64 *way)
{
    const uint32_t count = cgt_bih_count(n), *prim = cgt_bih_references(c->tree, n);
    box64 first = {0};
    bool equal = true;
    for (uint32_t k = 0; k < count; k++) {
        assert_true(prim[k] < c->prims->count);
        if (c->seen_prim[prim[k]]++)
            fail_msg("primitive %u is in two leaves", prim[k]);
        const cgt_primitive primitive = cgt_primitives_get(c->prims, prim[k]);
        const box64 b = box_of(&primitive);
        first = k ? first : b;
        for (int a = 0; a < 3; a++) {
            equal &= (float)b.low[a] == (float)first.low[a] && (float)b.high[a] == (float)first.high[a];
            if (way->low[a] > b.low[a] - fabs(way->low[a]) * 0x1p-20 ||
                way->high[a] < b.high[a] + fabs(way->high[a]) * 0x1p-20)
                fail_msg("primitive %u from %a to %a along axis %d, planes %a and %a", prim[k], b.low[a], b.high[a], a,
                         way->low[a], way->high[a]);
        }
    }
    assert_true(count > 0 && (count <= CGT_BIH_LEAF_ITEMS || equal));
    c->leaves++;
    c->largest_leaf = c->largest_leaf > count ? c->largest_leaf : count;
    c->references += count > CGT_BIH_INLINE_PRIMS ? count : 0;
}

static void check_node(checker *c, uint32_t node, uint32_t depth, box64 way)
{
    assert_true(node < c->tree->node_slots && node != 1);
    if (c->seen_node[node]++)
        fail_msg("node %u has two parents", node);
    const cgt_bih_node *n = &c->tree->node[node];
    c->nodes++;
    c->depth = c->depth > depth ? c->depth : depth;
    if (cgt_bih_is_leaf(n)) {
        check_leaf(c, n, &way);
        return;
    }
    const uint32_t axis = cgt_bih_axis(n), child = n->word[3];
    const double first = (double)cgt_bih_plane(n, 0), second = (double)cgt_bih_plane(n, 1);
    assert_int_equal(child % 2, 0);
    box64 part = way;
    if (cgt_bih_is_clip(n)) {
        assert_true(first <= second);
        part.low[axis] = fmax(part.low[axis], first);
        part.high[axis] = fmin(part.high[axis], second);
        c->clips++;
        check_node(c, child, depth, part);
        return;
    }
    part.high[axis] = fmin(part.high[axis], first);
    check_node(c, child, depth + 1, part);
    part = way;
    part.low[axis] = fmax(part.low[axis], second);
    check_node(c, child + 1, depth + 1, part);
}

void bih_check(const cgt_bih *tree, const cgt_committed_scene *committed_scene)
{
    checker c = {.tree = tree, .prims = &committed_scene->prims};
    const box64 all = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
    const uint32_t valid = committed_scene->valid;
    uint32_t listed = 0;
    c.seen_node = calloc(tree->node_slots, 1);
    c.seen_prim = calloc(c.prims->count, 1);
    assert_true(c.seen_node && c.seen_prim);
    check_node(&c, 0, 0, all);
    for (uint32_t prim = 0; prim < c.prims->count; prim++) {
        const cgt_primitive primitive = cgt_primitives_get(c.prims, prim);
        listed += c.seen_prim[prim];
        if (c.seen_prim[prim] != (cgt_primitive_check(&primitive) == CGT_PRIMITIVE_VALID))
            fail_msg("primitive %u is listed %u times", prim, c.seen_prim[prim]);
    }
    assert_int_equal(listed, valid);
    assert_int_equal(c.nodes, tree->nodes);
    assert_int_equal(c.leaves, tree->leaves);
    assert_int_equal(c.clips, tree->clips);
    assert_int_equal(c.depth, tree->depth);
    assert_int_equal(c.largest_leaf, tree->largest_leaf);
    assert_int_equal(c.references, tree->references);
    assert_int_equal(tree->nodes, 2 * tree->leaves - 1 + tree->clips);
    assert_true(tree->depth <= CGT_BIH_MAX_DEPTH && tree->leaves <= valid);
    free(c.seen_node);
    free(c.seen_prim);
}

/* From a node on: trees over the same primitives with the same nodes, at the same places; between slices anything may
 * lie. */
static bool same_below(const cgt_bih *a, const cgt_bih *b, uint32_t node)
{
    const cgt_bih_node *n = &a->node[node], *m = &b->node[node];
    const uint32_t count = cgt_bih_count(n);
    if (memcmp(n, m, sizeof *n) != 0)
        return false;
    if (cgt_bih_is_leaf(n))
        return count <= CGT_BIH_INLINE_PRIMS ||
               memcmp(cgt_bih_references(a, n), cgt_bih_references(b, m), count * sizeof(uint32_t)) == 0;
    return same_below(a, b, n->word[3]) && (cgt_bih_is_clip(n) || same_below(a, b, n->word[3] + 1));
}

bool bih_same(const cgt_bih *a, const cgt_bih *b)
{
    return a->nodes == b->nodes && a->node_slots == b->node_slots && a->depth == b->depth && same_below(a, b, 0);
}

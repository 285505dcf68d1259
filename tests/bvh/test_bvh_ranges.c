/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The ranges of cells that the tasks of a BVH's build take: they hold all primitives in order, none can be smaller or
 * larger, and their depths are those of the binary tree in which both sides of a node hold primitives. */
#include "support/test.h"
#include "support/suite.h"

#include <stdlib.h>
#include <string.h>

#include "builders/bvh/bvh_build.h"

#define MAX_BITS 7u
#define MAX_CELLS ((size_t)CGT_BVH_PARTS << MAX_BITS)

/* Parts, how many primitives lie before each of their cells, and where the binary tree has the parts that are used. */
typedef struct ranges_case {
    cgt_bvh_plan plan;
    uint32_t start[MAX_CELLS + 1];
    uint32_t used_part[CGT_BVH_PARTS], depth[CGT_BVH_PARTS], parting[CGT_BVH_PARTS], used_parts;
} ranges_case;

static bool is_used(const ranges_case *c, uint32_t cell, uint32_t bits)
{
    return c->start[cell + (1u << bits)] > c->start[cell];
}

/* Parts in a row are halved again and again. */
static void place_parts(ranges_case *c, uint32_t first, uint32_t end, uint32_t depth)
{
    const uint32_t middle = first + (end - first + 1) / 2;
    if (end - first < 2) {
        c->depth[first] = depth;
        return;
    }
    c->parting[middle] = depth;
    place_parts(c, first, middle, depth + 1);
    place_parts(c, middle, end, depth + 1);
}

/* Returns how many primitives there are. */
static uint32_t make_case(test_random *r, ranges_case *c)
{
    memset(c, 0, sizeof *c);
    for (uint32_t k = 0; k < CGT_KINDS; k++)
        c->plan.first[k + 1] = c->plan.first[k] + random_below(r, CGT_BVH_PARTS / CGT_KINDS + 1);
    for (uint32_t i = 0; i < c->plan.first[CGT_KINDS]; i++) {
        cgt_bvh_part *part = &c->plan.part[i];
        const uint32_t of_16 = random_below(r, 4) ? 1 + random_below(r, 16) : 0;
        part->first = c->plan.cells;
        part->curve.bits = random_below(r, MAX_BITS + 1);
        for (uint32_t cell = part->first; cell < part->first + (1u << part->curve.bits); cell++)
            c->start[cell + 1] = c->start[cell] + (random_below(r, 16) < of_16 ? 1 + random_below(r, 5) : 0);
        c->plan.cells += 1u << part->curve.bits;
        if (is_used(c, part->first, part->curve.bits))
            c->used_part[c->used_parts++] = i;
    }
    if (c->used_parts)
        place_parts(c, 0, c->used_parts, 0);
    return c->start[c->plan.cells];
}

/* Of the 2^bits cells around this one: above them each node of which both sides are used is a level. */
static uint32_t depth_of(const ranges_case *c, uint32_t used, uint32_t cell, uint32_t bits)
{
    const cgt_bvh_part *part = &c->plan.part[c->used_part[used]];
    uint32_t depth = c->depth[used];
    for (; bits < part->curve.bits; bits++) {
        const uint32_t lower = part->first + (cell - part->first) / (2u << bits) * (2u << bits);
        depth += is_used(c, lower, bits) && is_used(c, lower + (1u << bits), bits);
    }
    return depth;
}

/* Of the node around two ranges of one part. */
static uint32_t common_depth(const ranges_case *c, uint32_t used, uint32_t cell, uint32_t other)
{
    const uint32_t first = c->plan.part[c->used_part[used]].first;
    uint32_t bits = 0;
    while ((cell - first) >> bits != (other - first) >> bits)
        bits++;
    return depth_of(c, used, cell, bits);
}

static void check_ranges(const ranges_case *c, const cgt_bvh_range *range, uint32_t count, uint32_t most)
{
    uint32_t used = 0, begin = 0;
    for (uint32_t i = 0; i < count; i++) {
        const cgt_bvh_range *q = &range[i];
        const cgt_bvh_part *part = &c->plan.part[c->used_part[used]];
        const bool first = q->begin == c->start[part->first];
        assert_true(c->used_part[used] >= c->plan.first[q->kind] && c->used_part[used] < c->plan.first[q->kind + 1]);
        assert_int_equal(q->begin, begin);
        assert_int_equal(q->begin, c->start[q->cell]);
        assert_int_equal(q->end, c->start[q->cell + (1u << q->bits)]);
        assert_true(q->end > q->begin && (q->end - q->begin <= most || !q->bits));
        assert_int_equal((q->cell - part->first) % (1u << q->bits), 0);
        if (q->bits < part->curve.bits) { /* what is around it holds too much */
            const uint32_t around = q->cell - (q->cell - part->first) % (2u << q->bits);
            assert_true(c->start[around + (2u << q->bits)] - c->start[around] > most);
        }
        assert_int_equal(q->depth, depth_of(c, used, q->cell, q->bits));
        assert_int_equal(q->parting, first ? c->parting[used] : common_depth(c, used, q->cell, q[-1].cell));
        begin = q->end;
        if (begin == c->start[part->first + (1u << part->curve.bits)])
            used++;
    }
    assert_int_equal(used, c->used_parts);
}

TEST(ranges_are_subtrees)
{
    static ranges_case c;
    static cgt_bvh_range range[MAX_CELLS];
    test_random r = random_make(1);
    uint32_t ranges = 0;
    for (uint32_t round = 0; round < 20 + test_scaled(1000); round++) {
        const uint32_t prims = make_case(&r, &c), least = 1 + random_below(&r, 12);
        const uint32_t prims_each = CGT_BVH_RANGE_PRIMS / least, share = prims / CGT_BVH_RANGES;
        const uint32_t most = share > CGT_BVH_RANGE_PRIMS / prims_each ? share : CGT_BVH_RANGE_PRIMS / prims_each;
        const uint32_t count = cgt_bvh_list_ranges(&c.plan, c.start, prims, prims_each, NULL);
        assert_true(count <= MAX_CELLS);
        assert_int_equal(cgt_bvh_list_ranges(&c.plan, c.start, prims, prims_each, range), count);
        check_ranges(&c, range, count, most);
        ranges += count;
    }
    assert_true(ranges > 100);
}

SEEDED_SUITE("test_bvh_ranges", NULL, NULL)

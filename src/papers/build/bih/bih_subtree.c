/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The rules by which a node of a bounding interval hierarchy is divided, and the subtree of a task. */
#include <math.h>

#include "papers/build/bih/bih_build.h"

/* Clip nodes: of nodes with as many items, where they leave less than this share of the surface. Counted on cloud20k
 * and blob100k: 0.8 saves a sixth of the leaves and adds a twentieth of the nodes, which is about even. */
#define CLIP_MIN_ITEMS 8u
#define CLIP_SHARE 0.6f

/* ---- how to divide ---- */

/* The least e with 2^e >= count. */
static inline uint32_t ceil_log2(uint32_t count) { return count < 2 ? 0 : 32 - (uint32_t)__builtin_clz(count - 1); }

/* The longest axis of [low, high]; 3: all lengths are 0. */
static inline uint32_t longest_axis(cgt_bih_float4 low, cgt_bih_float4 high)
{
    uint32_t axis = 3;
    float longest = 0;
    for (uint32_t a = 0; a < 3; a++) {
        const float length = high[a] - low[a];
        if (length > longest) {
            longest = length;
            axis = a;
        }
    }
    return axis;
}

/* Items with one centre: by where their boxes end, else begin, along the axis where that differs most. */
static cgt_bih_split choose_by_size(const cgt_bih_item *item, uint32_t count)
{
    cgt_bih_split split = {.median = true, .key = CGT_BIH_KEY_HIGH};
    cgt_bih_float4 first[2] = {item->high, item->low}, last[2] = {item->high, item->low};
    for (uint32_t i = 1; i < count; i++)
        for (int k = 0; k < 2; k++)
            for (int a = 0; a < 3; a++) {
                const float x = k ? item[i].low[a] : item[i].high[a];
                first[k][a] = fminf(first[k][a], x);
                last[k][a] = fmaxf(last[k][a], x);
            }
    split.axis = longest_axis(first[0], last[0]);
    if (split.axis == 3) {
        split.key = CGT_BIH_KEY_LOW;
        split.axis = longest_axis(first[1], last[1]);
    }
    split.leaf = split.axis == 3;
    return split;
}

cgt_bih_split cgt_bih_choose(const cgt_bih_item *item, uint32_t count, uint32_t depth, const cgt_bih_bounds *bounds)
{
    const uint32_t axis = longest_axis(bounds->first_sum, bounds->last_sum);
    if (axis == 3)
        return choose_by_size(item, count);
    const float first = bounds->first_sum[axis], last = bounds->last_sum[axis], middle = (first + last) * 0.5f;
    /* the first sum is at the threshold or before it, and the last one is not: two neighbours may have no middle */
    return (cgt_bih_split){.median = depth + 1 + ceil_log2(count - 1) > CGT_BIH_MAX_DEPTH,
                           .key = CGT_BIH_KEY_SUM,
                           .axis = axis,
                           .threshold = middle < last ? middle : first};
}

/* ---- nodes ---- */

/* A plane moved outwards; the product's rounding is nothing against what the margin has to spare. */
static inline float margin(float plane) { return fabsf(plane) * CGT_BIH_MARGIN + CGT_BIH_LEAST_MARGIN; }
static inline float moved_down(float plane) { return plane - margin(plane); }
static inline float moved_up(float plane) { return plane + margin(plane); }

static inline float half_area(const float length[3])
{
    return length[0] * length[1] + length[1] * length[2] + length[2] * length[0];
}

/* The axis across which clipping leaves the least of the box's surface; 3: not worth a node. */
static uint32_t choose_clip(const cgt_bih_box *box, const cgt_bih_bounds *bounds)
{
    float length[3];
    for (int a = 0; a < 3; a++)
        length[a] = box->high[a] - box->low[a];
    float least = half_area(length) * CLIP_SHARE;
    uint32_t axis = 3;
    for (uint32_t a = 0; a < 3; a++) {
        float clipped[3] = {length[0], length[1], length[2]};
        clipped[a] = bounds->high[a] - bounds->low[a];
        const float area = half_area(clipped);
        if (area < least) {
            least = area;
            axis = a;
        }
    }
    return axis;
}

void cgt_bih_clip(cgt_bih_output *out, cgt_bih_part *part, const cgt_bih_bounds *bounds)
{
    while (part->count >= CLIP_MIN_ITEMS && out->spare_pairs) {
        const uint32_t axis = choose_clip(&part->box, bounds);
        if (axis == 3)
            return;
        const float low = moved_down(bounds->low[axis]), high = moved_up(bounds->high[axis]);
        const uint32_t child = 2 * out->next_pair++;
        out->spare_pairs--;
        out->node[part->node] = cgt_bih_inner(axis, true, low, high, child);
        out->clips++;
        part->node = child;
        part->box.low[axis] = bounds->low[axis];
        part->box.high[axis] = bounds->high[axis];
    }
}

void cgt_bih_add_split(cgt_bih_output *out, const cgt_bih_part *part, uint32_t axis, const cgt_bih_sides *sides,
                       cgt_bih_part child[2])
{
    const uint32_t pair = 2 * out->next_pair++;
    out->node[part->node] =
        cgt_bih_inner(axis, false, moved_up(sides->end_of_lower), moved_down(sides->begin_of_upper), pair);
    out->splits++;
    child[0] = child[1] = *part;
    child[0].node = pair;
    child[1].node = pair + 1;
    child[0].count = sides->below;
    child[1].first += sides->below;
    child[1].count -= sides->below;
    child[0].box.high[axis] = sides->end_of_lower;
    child[1].box.low[axis] = sides->begin_of_upper;
    child[0].depth = child[1].depth = part->depth + 1;
    out->depth = out->depth > part->depth ? out->depth : part->depth + 1;
}

static void add_leaf(cgt_bih_output *out, const cgt_bih_part *part, const cgt_bih_item *item)
{
    cgt_bih_node n = {{part->count << 3 | 3, 0, 0, 0}};
    if (part->count <= CGT_BIH_INLINE_PRIMS) {
        for (uint32_t k = 0; k < part->count; k++)
            n.word[1 + k] = cgt_bih_item_prim(&item[part->first + k]);
    } else {
        n.word[1] = part->first;
        for (uint32_t k = 0; k < part->count; k++)
            out->reference[part->first + k] = cgt_bih_item_prim(&item[part->first + k]);
        out->references += part->count;
    }
    out->node[part->node] = n;
    out->leaves++;
    out->spare_pairs += part->count - 1; /* splits that there will not be */
    out->largest_leaf = out->largest_leaf > part->count ? out->largest_leaf : part->count;
}

/* ---- the subtree ---- */

/* Divides a part; false where it became a leaf. */
static bool divide_part(cgt_bih_item *item, cgt_bih_output *out, cgt_bih_part *part, cgt_bih_part child[2])
{
    cgt_bih_item *first = item + part->first;
    if (part->count > CGT_BIH_LEAF_ITEMS) {
        const cgt_bih_bounds bounds = cgt_bih_bound(first, part->count);
        const cgt_bih_split split = cgt_bih_choose(first, part->count, part->depth, &bounds);
        cgt_bih_clip(out, part, &bounds);
        if (!split.leaf) {
            const cgt_bih_sides sides = split.median ? cgt_bih_divide_at_median(first, part->count, &split)
                                                     : cgt_bih_divide(first, part->count, &split);
            cgt_bih_add_split(out, part, split.axis, &sides, child);
            return true;
        }
    }
    add_leaf(out, part, item);
    return false;
}

/* Depth first, so that a node's children lie near to it. */
void cgt_bih_build_subtree(cgt_bih_item *item, cgt_bih_task *task)
{
    cgt_bih_part stack[CGT_BIH_MAX_DEPTH], part = task->part, child[2];
    uint32_t top = 0;
    for (;;) {
        if (divide_part(item, &task->out, &part, child)) {
            stack[top++] = child[1];
            part = child[0];
        } else if (top) {
            part = stack[--top];
        } else {
            return;
        }
    }
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The cache of triangles (thesis, section 7.6.5): those that a leaf's test lacks come by one list of DMA. A list fills
 * consecutive places of local store, so places are taken in turn, and an index tells where a triangle went.
 *
 * The thesis' listing 7.7 is mended:
 *   - it writes what it fetches over the first triangles of the cache, which the leaf may have been found to hold, and
 *     never notes what lies there. Here the next places in turn are taken, and a triangle counts as there only while
 *     none of the current leaf's fetches can reach its place
 *   - it compares each primitive with each triangle of the cache; the index takes one comparison
 *   - a leaf of more primitives than places overflows the cache, and its arrays on the stack grow with the leaf. Here a
 *     leaf is tested in batches that fit
 *   - where nothing is missing it gives a list of no elements. Here there is no command then
 *   - its list is aligned to 4 bytes, not 8, and its addresses lose their carry where the array crosses 4 GB */
#ifndef KD_TRIANGLES_H
#define KD_TRIANGLES_H

#include "cell/programs/kd/kd_nodes.h"

static uint32_t kd_triangles_lay_out(const cgt_kd_frame_image *f, uint32_t first)
{
    kd_triangle_cache *const c = &s()->triangles;
    const uint32_t most = f->triangles.blocks / 2 ? f->triangles.blocks / 2 : 1;
    c->slots = f->triangles.blocks;
    c->mask = (1u << f->triangles.log2) - 1;
    c->batch = f->batch < most ? f->batch : most;
    /* lists under way, three at most, must not meet in one place */
    c->ahead.is = s()->control.flags & CGT_KD_PREFETCH && c->slots >= 4 * c->batch;
    c->first = first;
    c->index = first + (c->slots * (uint32_t)sizeof(cgt_leaf_triangle) + 127) / 128 * 128;
    return c->index + (c->mask + 1) * (uint32_t)sizeof(kd_triangle_entry);
}

static inline kd_triangle_entry *kd_triangle_index(void) { return (void *)(s()->arena + s()->triangles.index); }

static void kd_triangles_start(void)
{
    kd_triangle_cache *const c = &s()->triangles;
    kd_triangle_entry *const entry = kd_triangle_index();
    for (uint32_t k = 0; k <= c->mask; k++)
        entry[k] = (kd_triangle_entry){UINT32_MAX, 0};
    c->next = 0;
    c->pending = 0;
    c->buffer = 1;
}

/* Waits for lists under way. */
static inline void kd_triangles_wait(void)
{
    if (!s()->triangles.pending)
        return;
    kd_wait(s()->triangles.pending);
    s()->triangles.pending = 0;
}

/* Sends the list for `count` triangles that begin at fetch `from`. */
static __attribute__((noinline)) void kd_triangles_send(uint32_t buffer, uint32_t from, uint32_t count)
{
    kd_triangle_cache *const c = &s()->triangles;
    cgt_leaf_triangle *const to = (cgt_leaf_triangle *)(void *)(s()->arena + c->first) + (from & (c->slots - 1));
    mfc_getl(to, kd_ea(s()->control.triangles), s()->list[buffer], 8 * count, TAG_LIST0 + buffer, 0, 0);
    c->pending |= 1u << (TAG_LIST0 + buffer);
    c->fetches += count;
    c->lists++;
}

/* Starts to fetch those of a batch that are not there; slot[k] becomes the place of triangle k. They stay there until
 * the next batch. buffer: of the list, no longer under way. */
static inline void kd_triangles_bring(const uint32_t *id, uint32_t count, uint32_t *slot, uint32_t buffer)
{
    kd_triangle_cache *const c = &s()->triangles;
    kd_triangle_entry *const entry = kd_triangle_index();
    const uint32_t last = c->slots - 1, mask = c->mask;
    uint32_t from = c->next;
    if ((from & last) + c->batch > c->slots) /* a list does not go round the end */
        from = (from | last) + 1;
    uint32_t next = from;
    const uint32_t oldest = from + c->batch - c->slots;
    for (uint32_t k = 0; k < count; k++) {
        kd_triangle_entry *const e = &entry[id[k] & mask];
        uint32_t fetch = e->fetch;
        /* fetches since `oldest` keep their places; the difference is right across 2^32 */
        if (__builtin_expect((e->id != id[k]) | (fetch - oldest >= next - oldest), 0)) {
            uint32_t *const element = s()->list[buffer][next - from];
            if (__builtin_expect(id[k] >= s()->frame.triangle_count, 0))
                kd_break(); /* what comes in its place is not used */
            element[0] = sizeof(cgt_leaf_triangle);
            element[1] = s()->control.triangles[1] + id[k] * (uint32_t)sizeof(cgt_leaf_triangle);
            fetch = next++;
            *e = (kd_triangle_entry){id[k], fetch};
        }
        slot[k] = fetch & last;
    }
    c->next = next;
    if (next != from)
        kd_triangles_send(buffer, from, next - from);
}

/* ---- ahead ---- */

/* Starts to fetch the triangles of a leaf, the first batch of them, where its references are at hand. */
static __attribute__((noinline)) void kd_fetch_leaf_ahead(kd_node n)
{
    kd_triangle_cache *const c = &s()->triangles;
    kd_cache *const r = &s()->references;
    const uint32_t *id = &n.word[1];
    uint32_t slot[KD_BATCH], there = KD_INLINE_PRIMS;
    if (kd_node_count(n) > KD_INLINE_PRIMS) {
        const uint32_t block = n.word[1] >> r->log2.is;
        if (r->tag[block & r->mask.is].is != block)
            return;
        id = kd_get_references(n.word[1], &there);
    }
    const uint32_t most = there < c->batch ? there : c->batch, buffer = 3 - c->buffer;
    const uint32_t tag = 1u << (TAG_LIST0 + buffer);
    if (c->pending & tag) {
        kd_wait(tag);
        c->pending &= ~tag;
    }
    c->buffer = buffer;
    kd_triangles_bring(id, kd_node_count(n) < most ? kd_node_count(n) : most, slot, buffer);
}

/* One level above a leaf (thesis, section 7.6.5), where it is pushed: the rays are tested against its sibling first. */
static inline void kd_fetch_ahead(kd_node n)
{
    if (__builtin_expect(s()->triangles.ahead.is, 0) && kd_node_is_leaf(n) && kd_node_count(n))
        kd_fetch_leaf_ahead(n);
}

static inline const cgt_leaf_triangle *kd_triangle(uint32_t slot)
{
    return (const cgt_leaf_triangle *)(const void *)(s()->arena + s()->triangles.first) + slot;
}

/* ---- leaves ---- */

/* A triangle that some ray may hit. */
static __attribute__((noinline)) void kd_test_triangle(leaf_tests *l, const lane_rays *r, uint32_t id, uint32_t slot,
                                                       uint32_t i)
{
    lane_triangles triangle;
    lane_hits q;
    lane_triangles_of_one(kd_triangle(slot), &triangle);
    if (lane_test_triangle(r, &triangle, &q))
        leaf_update_vector(l, id, i, &q);
}

/* Lane k of a quadword in every lane. */
#if defined(__SPU__)
#define KD_SPLAT(q, k) spu_shuffle(q, q, splat##k)
#else
#define KD_SPLAT(q, k) spux_vfloat((q)[k])
#endif

/* As lane_triangles_of_one, by quadwords. */
static inline void kd_splat_triangle(const cgt_leaf_triangle *t, lane_triangles *q)
{
    const float *const from = t->vertex;
    const vfloat a = spux_load(from), b = spux_load(from + 4), c = spux_load(from + 8);
#if defined(__SPU__)
    const vec_uchar16 splat0 = CGT_SPUX_LANES(0, 0, 0, 0), splat1 = CGT_SPUX_LANES(1, 1, 1, 1);
    const vec_uchar16 splat2 = CGT_SPUX_LANES(2, 2, 2, 2), splat3 = CGT_SPUX_LANES(3, 3, 3, 3);
#endif
    q->vertex[0] = KD_SPLAT(a, 0);
    q->vertex[1] = KD_SPLAT(a, 1);
    q->vertex[2] = KD_SPLAT(a, 2);
    q->edge[0][0] = KD_SPLAT(a, 3);
    q->edge[0][1] = KD_SPLAT(b, 0);
    q->edge[0][2] = KD_SPLAT(b, 1);
    q->edge[1][0] = KD_SPLAT(b, 2);
    q->edge[1][1] = KD_SPLAT(b, 3);
    q->edge[1][2] = KD_SPLAT(c, 0);
    q->sum[0] = KD_SPLAT(c, 1);
    q->sum[1] = KD_SPLAT(c, 2);
}

/* Two triangles, or one of them, whose sides of the rays are computed together, so that one's instructions fill the
 * other's latencies. rays: what r points to. */
static inline void kd_test_two(leaf_tests *l, const lane_rays *r, const lane_rays *rays, const uint32_t *id,
                               const uint32_t *slot, uint32_t count, uint32_t i)
{
    lane_triangles triangle[2];
    lane_passes passes[2];
    kd_splat_triangle(kd_triangle(slot[0]), &triangle[0]);
    kd_splat_triangle(kd_triangle(slot[1]), &triangle[1]);
    lane_pass_triangle(rays, &triangle[0], false, &passes[0]);
    lane_pass_triangle(rays, &triangle[1], false, &passes[1]);
    if (__builtin_expect(spux_all(spu_and(passes[0].outside, passes[1].outside)), 1))
        return;
    kd_test_triangle(l, r, id[0], slot[0], i);
    if (count > 1)
        kd_test_triangle(l, r, id[1], slot[1], i);
}

/* A batch of a leaf against the rays from i on. */
static void kd_test_batch(leaf_tests *l, const lane_rays *r, const uint32_t *id, uint32_t count, uint32_t i)
{
    const lane_rays rays = *r;
    uint32_t slot[KD_BATCH + 1];
    kd_triangles_bring(id, count, slot, 0);
    kd_triangles_wait();
    s()->tests += count;
    slot[count] = slot[0];
    for (uint32_t k = 0; k < count; k += 2)
        kd_test_two(l, r, &rays, id + k, slot + k, count - k, i);
}

static void kd_test_list(leaf_tests *l, const lane_rays *r, uint32_t first, uint32_t count, uint32_t i)
{
    const uint32_t batch = s()->triangles.batch, total = s()->references.total;
    if ((first > total || count > total - first) && kd_break())
        return;
    while (count) {
        uint32_t there;
        const uint32_t *const id = kd_get_references(first, &there);
        const uint32_t most = there < batch ? there : batch, some = count < most ? count : most;
        kd_test_batch(l, r, id, some, i);
        first += some;
        count -= some;
    }
}

/* Of a leaf without ropes: the node itself holds few references. */
static void kd_test_node(leaf_tests *l, const lane_rays *r, kd_node n, uint32_t i)
{
    const uint32_t count = kd_node_count(n);
    if (count > KD_INLINE_PRIMS)
        kd_test_list(l, r, n.word[1], count, i);
    else if (KD_INLINE_PRIMS == 1 || count <= s()->triangles.batch)
        kd_test_batch(l, r, &n.word[1], count, i);
    else
        for (uint32_t k = 0; k < count; k++)
            kd_test_batch(l, r, &n.word[1 + k], 1, i);
}

#endif

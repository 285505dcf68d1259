/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The thesis' tracer, a program of an SPE: rays in envelopes of tiles, made on the SPEs and kept in main memory; a
 * scene of triangles of any size, in one kd-tree or in several that are intersected one after the other, seen through
 * caches of nodes, references, leaf boxes and triangles; with a stack or along ropes. Kernels are the library's, in its
 * row `spu`; the same source is compiled for the host. cell/image/kd_image.h has the protocol. spe_bih.c makes another
 * program of it, for bounding interval hierarchies.
 *
 * Ids are final but for the doubts: a ray's nearest triangle is the one stored or one of its doubts, since any other
 * one was certainly missed, certainly beyond a certain hit, or replaced by a hit that is certainly nearer. Occlusion is
 * final but for the doubts, too: a bit that is set has a certain hit. */
#include "cell/programs/kd/kd_store.h"

struct leaf_tests;
struct lane_rays;
static void kd_add_doubt(uint32_t i, uint32_t object);
static inline const kd_node *kd_get_nodes(uint32_t i);
static inline const cgt_kd_leaf *kd_get_leaf(uint32_t i);
static void kd_test_list(struct leaf_tests *l, const struct lane_rays *r, uint32_t first, uint32_t count, uint32_t i);
static inline void kd_fetch_ahead(kd_node n);
static void kd_test_node(struct leaf_tests *l, const struct lane_rays *r, kd_node n, uint32_t i);

/* the kernels themselves: one translation unit, so that what the program does not need goes */
#if KD_IS_BIH
#include "papers/kernel/kd/kd_leaf.h"
#else
#include "papers/model/plane_order.h"

static int kd_plane_order(const cgt_plane_time *a, const cgt_plane_time *b);

#include "papers/model/plane_order.c"     /* NOLINT(bugprone-suspicious-include) */
#include "papers/kernel/kd/kd_traverse.c" /* NOLINT(bugprone-suspicious-include) */
#endif

#include "cell/programs/kd/kd_envelopes.h"
#if KD_IS_BIH
#include "cell/programs/kd/kd_hierarchies.h"
#endif
#include "cell/programs/kd/kd_secondary.h"
#include "cell/programs/kd/kd_setup.h"
#include "cell/programs/kd/kd_triangles.h"

#if !KD_IS_BIH
static inline bool kd_is_finite(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return (bits >> 23 & 255) < 255;
}

static inline bool kd_is_finite_time(const cgt_plane_time *t)
{
    return kd_is_finite(t->plane) && kd_is_finite(t->org) && kd_is_finite(t->dir);
}

/* The exact order, of what the whole numbers are made for: an SPU's floats go further, planes of a scene do not. */
static __attribute__((noinline)) int kd_plane_order(const cgt_plane_time *a, const cgt_plane_time *b)
{
    if (kd_is_finite_time(a) && kd_is_finite_time(b))
        return cgt_plane_order_exact(a, b);
    kd_break();
    return 0;
}
#endif

/* What the kernels see of the store. */
typedef struct kd_world {
    cgt_primitive_array array;
    cgt_committed_scene scene; /* of those: */
    cgt_paper_structures papers;
    cgt_trace_settings settings;
    cgt_counts counts;
} kd_world;

/* Ray i of the current packet and a triangle. */
static __attribute__((noinline)) void kd_add_doubt(uint32_t i, uint32_t object)
{
    const cgt_kd_info *const tile = s()->tile;
    const uint32_t ray =
        tile ? (tile[i / 4].y + i % 4 / 2) << 16 | (tile[i / 4].x + i % 2) : CGT_KD_SECONDARY | (s()->ray_number + i);
    if (s()->doubts.half_doubts + 1 == s()->doubts.capacity)
        kd_wait(3u << TAG_SECONDARY0); /* the PPE reads the rays of doubts that it is told of: some may be secondary */
    spe_doubts_add(&s()->doubts, ray, object);
}

/* ---- setting up ---- */

static int kd_report(uint32_t state, uint32_t value)
{
    s()->report.state = state;
    s()->report.value = value;
    mfc_put(&s()->report, kd_ea(s()->control.report), sizeof s()->report, TAG_SETUP, 0, 0);
    kd_wait(1u << TAG_SETUP);
    return state != CGT_KD_STATE_DONE;
}

static bool kd_is_cache(cgt_kd_cache_size size, uint32_t blocks, uint32_t least, uint32_t most)
{
    return size.blocks && !(size.blocks & (size.blocks - 1)) && size.blocks <= blocks && size.log2 >= least &&
           size.log2 <= most;
}

/* Whether a picture has these envelopes; tiles are not 0. */
static bool kd_are_envelopes(const cgt_kd_frame_image *f)
{
    const uint32_t across = (f->width + 2 * f->tiles_x - 1) / (2 * f->tiles_x);
    const uint32_t down = (f->height + 2 * f->tiles_y - 1) / (2 * f->tiles_y);
    return f->across == across && f->envelopes == across * down;
}

/* Whether the numbers that lay local store out are those that the PPE may give: damaged ones would reach beyond it. */
static bool kd_is_sound(void)
{
    const cgt_kd_frame_image *const f = &s()->frame;
    const cgt_kd_control *const c = &s()->control;
    const bool picture = f->width - 1 < CGT_FRAME_MAX_EDGE && f->height - 1 < CGT_FRAME_MAX_EDGE;
    const bool tiles = f->tiles_x - 1 < CGT_KD_TILES && f->tiles_y - 1 < CGT_KD_TILES && kd_tiles() <= CGT_KD_TILES;
    const bool counts = f->parts <= CGT_KD_PARTS && f->batch - 1 < KD_BATCH && f->lights <= CGT_KD_LIGHTS &&
                        f->ambient <= CGT_KD_DIRECTIONS && f->mirror <= (f->parts <= 1);
    const bool envelopes = tiles && kd_are_envelopes(f);
    const bool share = !c->envelopes || (c->step && c->first + (c->envelopes - 1) * (uint64_t)c->step < f->envelopes);
    const bool setup = c->setup_first + (uint64_t)c->setup_envelopes <= f->envelopes;
    const bool ring = c->half && c->half % CGT_DOUBTS_LINE == 0 && c->half <= 32768;
    const bool caches = kd_is_cache(f->nodes, CGT_KD_BLOCKS, 1, KD_IS_BIH ? 10 : 11) &&
                        kd_is_cache(f->leaves, CGT_KD_BLOCKS, 0, 7) &&
                        kd_is_cache(f->references, CGT_KD_BLOCKS, 2, 12) && kd_is_cache(f->triangles, 4096, 0, 13);
    return picture && tiles && counts && envelopes && share && setup && ring && caches;
}

/* Lays the caches out. Returns whether they fit. */
static bool kd_lay_out(void)
{
    const cgt_kd_frame_image *const f = &s()->frame;
    uint32_t at = kd_cache_lay_out(&s()->nodes, &f->nodes, sizeof(kd_node), 0);
    at = kd_cache_lay_out(&s()->references, &f->references, sizeof(uint32_t), at);
    if (s()->control.flags & CGT_KD_ROPES)
        at = kd_cache_lay_out(&s()->leaves, &f->leaves, sizeof(cgt_kd_leaf), at);
    at = kd_triangles_lay_out(f, at);
    return at <= CGT_KD_CACHE_BYTES;
}

static void kd_init(kd_world *w)
{
    packet *const p = &s()->packet;
    memset(p, 0, sizeof *p);
    memset(w, 0, sizeof *w);
    w->array =
        (cgt_primitive_array){.kind = CGT_KIND_TRIANGLES, .mask = UINT32_MAX, .count = s()->frame.triangle_count};
    w->scene.prims =
        (cgt_primitives){.array = &w->array, .arrays = 1, .count = w->array.count, .triangles = w->array.count};
    w->scene.papers = &w->papers;
    w->scene.scale = s()->frame.scale;
    const cgt_kd_control *const c = &s()->control;
    s()->doubts = (spe_doubts){.ea = {c->doubts[0], c->doubts[1]}, .capacity = c->half, .tag = TAG_DOUBT0};
}

/* Whether the counts of a part may be: there are nodes, the last of them too, which breaks a rule of DMA where it is
 * not, and no more leaves. So nothing that is counted by them takes longer than main memory is large. */
static bool kd_is_part(const cgt_kd_part *q)
{
    const uint32_t most = KD_IS_BIH ? CGT_KD_MAX_BIH_NODES : CGT_KD_MAX_NODES, some = 16 / sizeof(kd_node);
    if (q->nodes - 1 >= most || q->leaves > q->nodes)
        return false;
    mfc_get(s()->list[0], kd_ea(q->node) + (q->nodes - 1) / some * UINT64_C(16), 16, TAG_SETUP, 0, 0);
    kd_wait(1u << TAG_SETUP);
    return true;
}

/* Makes a part of the scene the current one. */
static void kd_begin_part(kd_world *w, uint32_t part)
{
    const cgt_kd_part *const q = &s()->part;
    mfc_get(&s()->part, kd_ea(s()->control.parts) + part * sizeof(cgt_kd_part), sizeof s()->part, TAG_SETUP, 0, 0);
    kd_wait(1u << TAG_SETUP);
    if (!kd_is_part(q))
        kd_break();
    for (uint32_t a = 0; a < 3; a++) {
        w->papers.kd.low[a] = w->papers.bih.low[a] = q->low[a];
        w->papers.kd.high[a] = w->papers.bih.high[a] = q->high[a];
    }
    w->papers.kd.nodes = w->papers.bih.nodes = q->nodes;
    w->papers.kd.leaves = q->leaves;
    kd_cache_start(&s()->nodes, q->node, q->nodes);
    kd_cache_start(&s()->references, q->reference, q->references);
    if (s()->control.flags & CGT_KD_ROPES)
        kd_cache_start(&s()->leaves, q->leaf, q->leaves);
}

/* ---- phases ---- */

static void kd_trace_packet(kd_world *w)
{
    if (s()->broken)
        return;
#if KD_IS_BIH
    kd_bih_trace(&w->scene, &s()->packet, &w->settings, &w->counts);
#else
    if (s()->control.flags & CGT_KD_ROPES)
        CGT_KERNEL(cgt_kd_ropes_trace)(&w->scene, &s()->packet, &w->settings, &w->counts);
    else
        CGT_KERNEL(cgt_kd_trace)(&w->scene, &s()->packet, &w->settings, &w->counts);
#endif
}

/* The secondary rays of an envelope whose rays and hits lie in `buffer`. */
static void kd_trace_secondary(kd_world *w, uint32_t envelope, uint32_t from, bool make)
{
    const uint32_t batches = kd_batches();
    for (uint32_t batch = 0; batch < batches; batch++) {
        const uint32_t buffer = batch & 1;
        kd_begin_batch(envelope, batch, from, buffer, make);
        s()->ray_number = (uint32_t)(4 * kd_secondary_place(envelope, batch));
        kd_load_secondary(batch, buffer);
        kd_trace_packet(w);
        kd_add_occlusion(buffer);
        if (kd_is_mirror(batch))
            kd_put_nearest(envelope, batch, buffer);
        mfc_put(s()->occlusion[buffer], kd_occlusion_ea(envelope, batch), (kd_tiles() + 3) / 4 * 16,
                TAG_SECONDARY0 + buffer, 0, 0);
    }
}

/* What is done with an envelope in a phase. */
typedef struct kd_phase {
    bool hits; /* of earlier parts come */
    bool primary, secondary;
    bool make; /* secondary rays */
} kd_phase;

static void kd_trace_envelope(kd_world *w, const kd_phase *phase, uint32_t envelope, uint32_t buffer)
{
    if (phase->primary) {
        kd_load_packet(buffer, phase->hits);
        kd_trace_packet(w);
        kd_store_hits(buffer);
        kd_put_hits(envelope, buffer);
    }
    if (phase->secondary)
        kd_trace_secondary(w, envelope, buffer, phase->make);
    s()->report.envelopes++;
}

static void kd_run_phase(kd_world *w, const kd_phase *phase)
{
    kd_assigned assigned = {0, (s()->control.flags & CGT_KD_MAILBOX) != 0};
    uint32_t current = kd_next_envelope(&assigned), buffer = 0;
    if (current != CGT_STRIP_END)
        kd_get_envelope(current, 0, phase->hits);
    for (; current != CGT_STRIP_END; buffer ^= 1) {
        const uint32_t next = kd_next_envelope(&assigned);
        if (next != CGT_STRIP_END)
            kd_get_envelope(next, buffer ^ 1, phase->hits);
        kd_wait(1u << (TAG_IN0 + buffer));
        kd_trace_envelope(w, phase, current, buffer);
        current = next;
    }
    kd_wait(3u << TAG_OUT0 | 3u << TAG_SECONDARY0);
}

static void kd_run(kd_world *w)
{
    const cgt_kd_frame_image *const f = &s()->frame;
    const uint32_t parts = f->parts;
    const bool secondary = kd_batches() != 0;
    kd_set_up();
    s()->report.setup = 0xffffffff - spu_read_decrementer();
    kd_triangles_start();
    for (uint32_t part = 0; part < parts; part++) {
        const bool both = secondary && parts == 1;
        const kd_phase phase = {.hits = part > 0, .primary = true, .secondary = both, .make = both};
        kd_barrier();
        kd_begin_part(w, part);
        kd_run_phase(w, &phase);
    }
    for (uint32_t part = 0; part < parts && parts > 1 && secondary; part++) {
        const kd_phase phase = {.hits = true, .secondary = true, .make = part == 0};
        kd_barrier();
        kd_begin_part(w, part);
        kd_run_phase(w, &phase);
    }
    s()->report.traced = 0xffffffff - spu_read_decrementer() - s()->report.setup;
}

#if KD_IS_BIH
CGT_SPE_MAIN(spe_bih)
#else
CGT_SPE_MAIN(spe_kd)
#endif
{
    kd_world w;
    memset(s(), 0, offsetof(kd_store, arena));
    memset(&s()->nodes, 0, sizeof *s() - offsetof(kd_store, nodes));
    mfc_get(&s()->control, argument, sizeof s()->control, TAG_SETUP, 0, 0);
    kd_wait(1u << TAG_SETUP);
    if (s()->control.magic != CGT_KD_MAGIC)
        return kd_report(CGT_KD_STATE_BAD_CONTROL, 0);
    mfc_get(&s()->frame, kd_ea(s()->control.frame), CGT_KD_FRAME_BYTES, TAG_SETUP, 0, 0);
    kd_wait(1u << TAG_SETUP);
    mfc_get(&s()->camera, kd_ea(s()->frame.camera), sizeof s()->camera, TAG_SETUP, 0, 0);
    kd_wait(1u << TAG_SETUP);
    if (!(s()->control.flags & CGT_KD_BIH) != !KD_IS_BIH)
        return kd_report(CGT_KD_STATE_OTHER_TREE, 0);
    if (!kd_is_sound())
        return kd_report(CGT_KD_STATE_BAD_CONTROL, 1);
    if (!kd_lay_out())
        return kd_report(CGT_KD_STATE_CACHES, CGT_KD_CACHE_BYTES);
    kd_init(&w);
    spu_write_decrementer(0xffffffff);
    kd_run(&w);
    spe_doubts_end(&s()->doubts);
    cgt_kd_report *const r = &s()->report;
    r->doubts = s()->doubts.doubts;
    r->rest_half = s()->doubts.half;
    r->rest = s()->doubts.half_doubts;
    r->nodes = (uint32_t)w.counts.nodes;
    r->leaves = (uint32_t)w.counts.leaves;
    r->tests = s()->tests;
    r->loops = (uint32_t)w.counts.rope_loops;
    r->exact_steps = (uint32_t)w.counts.exact_steps;
    r->node_fetches = s()->nodes.fetches;
    r->reference_fetches = s()->references.fetches;
    r->leaf_fetches = s()->leaves.fetches;
    r->triangle_fetches = s()->triangles.fetches;
    r->triangle_lists = s()->triangles.lists;
    return kd_report(s()->broken || r->loops ? CGT_KD_STATE_BROKEN : CGT_KD_STATE_DONE, 0);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Coherent grid traversal of a packet (Wald et al. 2006; Chapman, section 3): the frustum marches slice by slice along
 * its main axis; the references in the cells that it touches are collected; a vector of primitives at a time is culled
 * against the frustum; the remaining ones are tested against the rays; the packet is done when every ray's hit lies
 * before the next slice.
 *
 * The cells of the slices are visited in two ways with the same result: by three nested loops, and by Chapman's one
 * loop, which steps cell, row and slice by selection and not by branches. His listing keeps one pair of bounds for all
 * slices and enters slices that hold no cell; here the bounds of every slice are found first, empty ones left out. */
#include "papers/kernel/grid/packet_prims.h"
#include "papers/kernel/packet/packet_split.h"
#include "papers/model/paper_structures.h"

/* A packet that spreads over more cells of a slice than this many per ray is halved. Measured with shuffled rays; flat
 * from half to twice as many. */
#define CELLS_PER_RAY 3.f

#define BATCH_FULL (PACKET_MAX_PRIMS - CGT_QUEUE_LENGTH)
#define MAILBOX_SIZE 64 /* direct mapped by the low bits of the reference */

typedef struct traversal {
    packet_prims prims;
    const cgt_queue_grid *grid;
    cgt_counts *counts;
    bool mailbox;
    uint32_t pending; /* references collected and not yet tested */
    _Alignas(64) uint32_t reference[PACKET_MAX_PRIMS];
    uint32_t visited[MAILBOX_SIZE];
} traversal;

/* ---- collecting ---- */

static void collect_overflow(traversal *v, uint32_t cell);
static void flush_pending(traversal *v);

/* A voxel's references fill it from the front: copy all of it, keep the ones that are there. */
CGT_SPU_INLINE uint32_t copy_voxel16(const cgt_voxel *voxel, uint32_t *to)
{
    for (int k = 0; k < CGT_QUEUE_LENGTH; k++)
        to[k] = voxel->reference[k];
    return spux_find16(voxel->reference, CGT_QUEUE_NONE);
}
CGT_SPU_INLINE uint32_t copy_voxel32(const cgt_voxel32 *voxel, uint32_t *to)
{
    uint32_t none = 1u << CGT_QUEUE_LENGTH;
    for (uint32_t k = 0; k < CGT_QUEUE_LENGTH; k += CGT_LANES) {
        const vuint reference = spux_load_uint(voxel->reference + k);
        spux_store_unaligned_uint(to + k, reference);
        none |= spux_mask_bits(spu_cmpeq(reference, spux_vuint(CGT_INVALID_ID))) << k;
    }
    return (uint32_t)__builtin_ctz(none);
}

CGT_SPU_INLINE void visit_cell(traversal *v, uint32_t cell)
{
    uint32_t *to = v->reference + v->pending;
    const uint32_t length =
        v->grid->refs_are_32_bits ? copy_voxel32(&v->grid->voxel32[cell], to) : copy_voxel16(&v->grid->voxel[cell], to);
    v->pending += length;
    v->counts->cells++;
    if (length == CGT_QUEUE_LENGTH && v->grid->overflows)
        collect_overflow(v, cell);
}

static void collect_overflow(traversal *v, uint32_t cell)
{
    const cgt_queue_grid *g = v->grid;
    for (uint32_t i = cgt_queue_grid_overflow(g, cell); i < g->overflows && g->overflow[i].cell == cell; i++) {
        if (v->pending >= BATCH_FULL)
            flush_pending(v);
        v->reference[v->pending++] = g->overflow[i].reference;
    }
}

/* Removes the references that the mailbox holds, and adds the others to it. */
static void apply_mailbox(traversal *v)
{
    uint32_t unvisited = 0;
    for (uint32_t i = 0; i < v->pending; i++) {
        const uint32_t reference = v->reference[i], slot = reference % MAILBOX_SIZE;
        const bool visited = v->visited[slot] == reference;
        v->reference[unvisited] = reference;
        v->visited[slot] = reference;
        unvisited += !visited;
    }
    v->counts->mailbox_skipped += v->pending - unvisited;
    v->pending = unvisited;
}

/* ---- testing ---- */

static void flush_pending(traversal *v)
{
    v->counts->references += v->pending;
    if (v->mailbox)
        apply_mailbox(v);
    packet_test_prims(&v->prims, v->reference, v->pending);
    v->pending = 0;
}

/* Tests what a slice held. Returns true where no ray needs the next slices. */
static bool finish_slice(traversal *v, uint32_t slice)
{
    if (v->pending) {
        flush_pending(v);
        v->prims.w_far = packet_max_w(&v->prims);
    }
    if (!(v->prims.w_far < (float)(slice + 1)))
        return false;
    v->counts->early_exits++;
    return true;
}

/* ---- the two loops ---- */

/* The voxel of cell (u, v) = (0, 0) of a slice. */
CGT_SPU_INLINE uint32_t slice_cell(const cgt_queue_grid *g, const frustum *f, uint32_t slice)
{
    return (f->reverse ? g->resolution[f->w] - 1 - slice : slice) * g->stride[f->w];
}

static void traverse_nested(traversal *v)
{
    const frustum *f = &v->prims.frustum;
    const uint32_t *stride = v->grid->stride;
    for (uint32_t slice = f->first; slice < f->end; slice++) {
        const vec_int4 b = frustum_slice(f, slice);
        const uint32_t cell = slice_cell(v->grid, f, slice);
        v->counts->slices += (b[0] <= b[1]) & (b[2] <= b[3]);
        for (int32_t y = b[2]; y <= b[3]; y++)
            for (int32_t x = b[0]; x <= b[1]; x++) {
                visit_cell(v, cell + (uint32_t)y * stride[f->v] + (uint32_t)x * stride[f->u]);
                if (v->pending >= BATCH_FULL)
                    flush_pending(v);
            }
        if (finish_slice(v, slice))
            return;
    }
}

/* A slice that holds cells. */
typedef struct slice_cells {
    int32_t low_u, high_u, low_v, high_v;
    uint32_t cell; /* voxel of its (0, 0) */
    uint32_t slice;
} slice_cells;

/* Finds the slices and returns the sum of their cells. */
static uint32_t find_slices(traversal *v, slice_cells *s)
{
    const frustum *f = &v->prims.frustum;
    uint32_t slices = 0, cells = 0;
    for (uint32_t slice = f->first; slice < f->end; slice++) {
        const vec_int4 b = frustum_slice(f, slice);
        const int32_t across = b[1] - b[0] + 1, down = b[3] - b[2] + 1;
        const bool nonempty = across > 0 && down > 0;
        s[slices] = (slice_cells){b[0], b[1], b[2], b[3], slice_cell(v->grid, f, slice), slice};
        slices += nonempty;
        cells += nonempty ? (uint32_t)(across * down) : 0;
    }
    s[slices] = s[slices ? slices - 1 : 0]; /* read, not used, after the last cell */
    return cells;
}

static void traverse_flattened(traversal *v)
{
    slice_cells slices[CGT_GRID_MAX_RESOLUTION + 1];
    const slice_cells *s = slices;
    const uint32_t stride_u = v->grid->stride[v->prims.frustum.u], stride_v = v->grid->stride[v->prims.frustum.v];
    const uint32_t cells = find_slices(v, slices);
    int32_t x = s->low_u, y = s->low_v;
    for (uint32_t remaining = cells; remaining; remaining--) {
        visit_cell(v, s->cell + (uint32_t)y * stride_v + (uint32_t)x * stride_u);
        const bool row_ends = x == s->high_u, slice_ends = row_ends & (y == s->high_v);
        const slice_cells *next = s + slice_ends;
        const int32_t x_next = row_ends ? next->low_u : x + 1, y_next = slice_ends ? next->low_v : y + row_ends;
        if (slice_ends | (v->pending >= BATCH_FULL)) {
            if (!slice_ends)
                flush_pending(v);
            else if (finish_slice(v, s->slice)) {
                v->counts->slices += (uint32_t)(next - slices);
                return;
            }
        }
        x = x_next;
        y = y_next;
        s = next;
    }
    v->counts->slices += (uint32_t)(s - slices);
}

/* ---- packets ---- */

static bool is_incoherent(const traversal *v)
{
    const frustum *f = &v->prims.frustum;
    const vec_int4 b = frustum_slice(f, f->first + (f->end - f->first) / 2);
    const float cells = (float)(b[1] - b[0] + 1) * (float)(b[3] - b[2] + 1);
    return v->prims.p->rays > 1 && b[1] >= b[0] && cells > 4 + CELLS_PER_RAY * (float)v->prims.p->rays;
}

static void traverse_cells(traversal *v, const cgt_trace_settings *settings)
{
    v->counts->packets++;
    packet_prims_init(&v->prims);
    if (v->mailbox)
        memset(v->visited, 0xff, sizeof v->visited);
    if (settings->flattened)
        traverse_flattened(v);
    else
        traverse_nested(v);
}

/* Traces rays with one main axis and sign. Returns false where they must be split first. */
static bool traverse(const cgt_committed_scene *committed_scene, packet *p, uint32_t class,
                     const cgt_trace_settings *settings, cgt_counts *counts)
{
    const cgt_queue_grid *g = &committed_scene->papers->grid;
    traversal *v = cgt_scratch_take(counts->scratch, sizeof *v);
    v->prims.committed_scene = committed_scene;
    v->prims.p = p;
    v->prims.counts = counts;
    v->prims.cull = settings->cull;
    v->prims.frustum = (frustum){0};
    for (int a = 0; a < 3; a++) {
        v->prims.space.org[a] = g->org[a];
        v->prims.space.rcell[a] = g->rcell[a];
        v->prims.space.cell_error[a] = g->cell_error[a];
        v->prims.space.resolution[a] = g->resolution[a];
    }
    v->grid = g;
    v->counts = counts;
    v->mailbox = settings->mailbox;
    v->pending = 0;
    const bool reaches_grid = frustum_init(&v->prims.space, p, (int)(class >> 1), class & 1, &v->prims.frustum);
    const bool coherent = !reaches_grid || !is_incoherent(v);
    if (reaches_grid && coherent)
        traverse_cells(v, settings);
    cgt_scratch_return(counts->scratch, v);
    return coherent;
}

/* Splits by main axis and sign first. */
void CGT_KERNEL(cgt_queue_grid_trace)(const cgt_committed_scene *committed_scene, packet *p,
                                      const cgt_trace_settings *settings, cgt_counts *counts)
{
    _Alignas(64) uint32_t class[PACKET_MAX_RAYS];
    class[0] = 0; /* there is at least one ray, which the compiler cannot know */
    packet_classify(p, class);
    if (!packet_all_equal(class, p->lanes))
        packet_trace_parts(committed_scene, p, class, PACKET_CLASSES, CGT_KERNEL(cgt_queue_grid_trace), settings,
                           counts);
    else if (!traverse(committed_scene, p, class[0], settings, counts))
        packet_trace_split(committed_scene, p, 2, CGT_KERNEL(cgt_queue_grid_trace), settings, counts);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the tracing calls share. */
#include "trace/trace_call.h"

#include <string.h>

/* Measured by `cgt-bench loops` (docs/reports/coherent_grid_traversal.md): the largest packets share the most work, whether a
 * sphere is 3 pixels across or 40; the loops are within a few per cent of each other on x86-64. */
#define DEFAULT_PACKET 16
#define DEFAULT_FLATTENED false

void cgt_trace_options_init(cgt_trace_options *options)
{
    *options = (cgt_trace_options){.cull = CGT_CULL_BLOCKS, .mailbox = 1};
}

static cgt_result choose_settings(cgt_context *c, const cgt_trace_options *o, bool camera, cgt_trace_settings *s)
{
    if (o->packet != 0 && o->packet != 4 && o->packet != 8 && o->packet != 16)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "trace options: packet %u: 4, 8, 16 or 0", o->packet);
    if ((unsigned)o->tile > CGT_TILE_SHAPE_STRIP)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "trace options: tile is unknown");
    if ((unsigned)o->loop > CGT_LOOP_FLATTENED)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "trace options: loop is unknown");
    if ((unsigned)o->cull > CGT_CULL_BLOCKS)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "trace options: cull is unknown");
    if ((unsigned)o->kd_traversal > CGT_KD_TRAVERSAL_PACKET)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "trace options: kd_traversal is unknown");
    if ((unsigned)o->precision > CGT_PRECISION_EXACT)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "trace options: precision is unknown");
    if ((unsigned)o->triangle_test > CGT_TRIANGLE_TEST_ACCELERATED)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "trace options: triangle_test is unknown");
    if (o->triangle_test != CGT_TRIANGLE_TEST_WATERTIGHT && o->precision != CGT_PRECISION_FAST)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT,
                        "trace options: this triangle_test has no error bound: precision must be FAST");
    s->strip = camera && o->tile == CGT_TILE_SHAPE_STRIP;
    if (s->strip && o->packet > 4)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT,
                        "trace options: strips of four scanlines take packets of 4, not %u", o->packet);
    s->tiled = camera && !o->packet && o->tile == CGT_TILE_SHAPE_AUTO && o->loop == CGT_LOOP_AUTO &&
               o->cull == CGT_CULL_BLOCKS && o->mailbox && o->triangle_test == CGT_TRIANGLE_TEST_WATERTIGHT;
    s->packet = s->strip ? 4 : o->packet ? o->packet : DEFAULT_PACKET;
    s->flattened = o->loop == CGT_LOOP_AUTO ? DEFAULT_FLATTENED : o->loop == CGT_LOOP_FLATTENED;
    s->cull = o->cull;
    s->mailbox = o->mailbox;
    s->kd_traversal = o->kd_traversal == CGT_KD_TRAVERSAL_AUTO ? CGT_KD_TRAVERSAL_PACKET : o->kd_traversal;
    s->precision = o->precision;
    s->triangle_test = o->triangle_test;
    s->use_bvh = false; /* rays ask for it */
    if (!camera)
        s->packet = 0;
    return CGT_OK;
}

cgt_result cgt_trace_prepare(const cgt_scene *scene, const cgt_trace_options *options, bool camera,
                             cgt_trace_settings *settings, cgt_trace_counter *counter)
{
    cgt_trace_options defaults;
    cgt_trace_options_init(&defaults);
    counter->start_ms = options && options->statistics ? cgt_now_ms() : 0; /* a call of one ray takes as long */
    for (size_t i = 0; i < CGT_COUNTS; i++)
        atomic_init(&counter->sum[i], 0);
    if (!scene->is_committed)
        return cgt_fail(scene->context, CGT_ERROR_NOT_COMMITTED, "trace: the scene was not committed since it changed");
    return choose_settings(scene->context, options ? options : &defaults, camera, settings);
}

cgt_result cgt_check_stride(cgt_context *c, const char *what, size_t stride, uint64_t count)
{
    if (stride % sizeof(float))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: stride is not a multiple of 4", what);
    if (count > (SIZE_MAX / 2) / (stride ? stride : sizeof(float)) || count / CGT_RAYS_CHUNK >= UINT32_MAX)
        return cgt_fail(c, CGT_ERROR_TOO_LARGE, "%s: count times stride leaves the address space", what);
    return CGT_OK;
}

void cgt_trace_counter_add(cgt_trace_counter *counter, const cgt_counts *counts)
{
    uint64_t value[CGT_COUNTS];
    if (!counter)
        return;
    memcpy(value, counts, sizeof value);
    for (size_t i = 0; i < CGT_COUNTS; i++)
        if (value[i])
            atomic_fetch_add_explicit(&counter->sum[i], value[i], memory_order_relaxed);
}

void cgt_trace_store_statistics(const cgt_trace_options *options, const cgt_trace_settings *settings,
                                cgt_trace_counter *counter)
{
    uint64_t value[CGT_COUNTS];
    cgt_counts c;
    if (!options || !options->statistics)
        return;
    for (size_t i = 0; i < CGT_COUNTS; i++)
        value[i] = atomic_load_explicit(&counter->sum[i], memory_order_relaxed);
    memcpy(&c, value, sizeof c);
    *options->statistics =
        (cgt_trace_statistics){.rays = c.rays,
                               .invalid_rays = c.invalid_rays,
                               .hits = c.hits,
                               .bvh_rays = c.bvh_rays,
                               .tiles = c.tiles,
                               .packets = c.packets,
                               .split_packets = c.split_packets,
                               .slices = c.slices,
                               .cells = c.cells,
                               .nodes = c.nodes,
                               .leaves = c.leaves,
                               .rope_steps = c.rope_steps,
                               .exact_steps = c.exact_steps,
                               .rope_loops = c.rope_loops,
                               .references = c.references,
                               .mailbox_skipped = c.mailbox_skipped,
                               .cull_tests = c.cull_tests,
                               .culled = c.culled,
                               .packet_tests = c.packet_tests,
                               .ray_tests = c.ray_tests,
                               .double_tests = c.double_tests,
                               .exact_tests = c.exact_tests,
                               .exact_values = c.exact_values,
                               .early_exits = c.early_exits,
                               .packet_size = settings->packet,
                               .tile = settings->strip ? CGT_TILE_SHAPE_STRIP : CGT_TILE_SHAPE_SQUARE,
                               .loop = settings->flattened ? CGT_LOOP_FLATTENED : CGT_LOOP_NESTED,
                               .trace_ms = cgt_now_ms() - counter->start_ms};
}

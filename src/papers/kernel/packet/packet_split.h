/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Packets whose rays disagree on the main axis, or run apart, are traced as several. */
#ifndef CGT_PACKET_SPLIT_H
#define CGT_PACKET_SPLIT_H

#include "kernel/packet/packet.h"

/* Traces a packet through a structure. */
typedef void packet_tracer(const cgt_committed_scene *committed_scene, packet *p, const cgt_trace_settings *settings,
                           cgt_counts *counts);

#define PACKET_CLASSES 6u

/* Main axis and sign of each ray as a number: 2 * axis + reverse. */
static void packet_classify(const packet *p, uint32_t *class)
{
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const vfloat d[3] = {spux_load(p->dir[0] + i), spux_load(p->dir[1] + i), spux_load(p->dir[2] + i)};
        const vfloat x = spux_abs(d[0]), y = spux_abs(d[1]), z = spux_abs(d[2]), zero = spux_vfloat(0);
        const vmask y_is_main = spu_andc(spu_cmpgt(y, x), spu_cmpgt(z, y));
        const vmask z_is_main = spu_and(spu_cmpgt(z, x), spu_cmpgt(z, y));
        const vfloat main = spux_select(spux_select(d[0], d[1], y_is_main), d[2], z_is_main);
        const vuint y_axis = spux_select(spux_vuint(0), spux_vuint(2), y_is_main);
        const vuint axis = spux_select(y_axis, spux_vuint(4), z_is_main);
        spux_store_uint(class + i, spux_select(axis, spu_or(axis, spux_vuint(1)), spu_cmpgt(zero, main)));
    }
}

static bool packet_all_equal(const uint32_t *class, uint32_t count)
{
    uint32_t differs = 0;
    for (uint32_t i = 1; i < count; i++)
        differs |= class[i] ^ class[0];
    return !differs;
}

/* Copies the rays of one part to a new packet; from[] holds where each was. */
static void packet_extract(const packet *p, const uint32_t *part, uint32_t part_number, packet *sub, uint32_t *from)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < p->lanes; i++)
        if (part[i] == part_number && p->high[i] != -INFINITY)
            from[n++] = i;
    sub->rays = n;
    sub->lanes = (n + CGT_LANES - 1) / CGT_LANES * CGT_LANES;
    for (uint32_t k = 0; k < sub->lanes; k++) {
        const uint32_t i = from[k < n ? k : 0];
        for (int a = 0; a < 3; a++) {
            sub->org[a][k] = p->org[a][i];
            sub->dir[a][k] = p->dir[a][i];
        }
        sub->rdd[k] = p->rdd[i];
        sub->t_min[k] = p->t_min[i];
        sub->t_max[k] = p->t_max[i];
        sub->low[k] = k < n ? p->low[i] : -INFINITY;
        sub->high[k] = k < n ? p->high[i] : -INFINITY;
        sub->prim[k] = p->prim[i];
        if (p->skips_prims) {
            sub->skip_prim[k] = p->skip_prim[i];
            sub->mask[k] = p->mask[i];
        }
        sub->u[k] = p->u[i];
        sub->v[k] = p->v[i];
    }
}

/* A part, and its rays in the whole. */
typedef struct packet_part {
    packet sub;
    uint32_t from[PACKET_MAX_RAYS];
} packet_part;

/* Traces the rays of a packet as several packets; part[i], below `parts`, is the one of ray i. */
static void packet_trace_parts(const cgt_committed_scene *committed_scene, packet *p, const uint32_t *part,
                               uint32_t parts, packet_tracer *trace, const cgt_trace_settings *settings,
                               cgt_counts *counts)
{
    packet_part *work = cgt_scratch_take(counts->scratch, sizeof *work);
    packet *sub = &work->sub;
    uint32_t *from = work->from;
    sub->common_origin = p->common_origin;
    sub->from_origin = p->from_origin;
    sub->to_light = p->to_light;
    for (int a = 0; a < 3; a++)
        sub->light[a] = p->light[a];
    sub->skips_prims = p->skips_prims;
    sub->has_masks = p->has_masks;
    sub->any_hit = p->any_hit;
    sub->fast = p->fast;
    sub->triangle_test = p->triangle_test;
    sub->extreme = false;
    counts->split_packets++;
    for (uint32_t k = 0; k < parts; k++) {
        packet_extract(p, part, k, sub, from);
        if (!sub->rays)
            continue;
        trace(committed_scene, sub, settings, counts);
        for (uint32_t i = 0; i < sub->rays; i++) {
            p->low[from[i]] = sub->low[i];
            p->high[from[i]] = sub->high[i];
            p->prim[from[i]] = sub->prim[i];
            if (p->fast) {
                p->u[from[i]] = sub->u[i];
                p->v[from[i]] = sub->v[i];
            }
        }
    }
    cgt_scratch_return(counts->scratch, work);
}

/* The rays in `parts` parts of equal size, at most as many as there are rays, neighbours together. */
static void packet_trace_split(const cgt_committed_scene *committed_scene, packet *p, uint32_t parts,
                               packet_tracer *trace, const cgt_trace_settings *settings, cgt_counts *counts)
{
    uint32_t *part = cgt_scratch_take(counts->scratch, PACKET_MAX_RAYS * sizeof *part), active = 0;
    for (uint32_t i = 0; i < p->lanes; i++) {
        part[i] = active * parts / p->rays;
        active += p->high[i] != -INFINITY;
    }
    packet_trace_parts(committed_scene, p, part, parts, trace, settings, counts);
    cgt_scratch_return(counts->scratch, part);
}

#endif

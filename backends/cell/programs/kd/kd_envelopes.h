/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Envelopes of rays against a part of the scene (thesis, section 7.6.6): rays and info of the next envelope come, and
 * hits of the last one go, while one is traced.
 *
 * The thesis' listing 7.8 is mended:
 *   - it fetches the rays of an identifier before it looks whether that ends the phase, and after the loop intersects
 *     an envelope that was not assigned where there are none
 *   - an SPE whose first identifier ends the phase leaves the loop over all parts. Here it goes on to the next
 *   - it goes on to the next part without waiting for the others, while hits of the last part may be under way. There
 *     is a barrier here
 *   - it writes hits from a buffer and asks for the hits of another envelope in it with no fence between */
#ifndef KD_ENVELOPES_H
#define KD_ENVELOPES_H

#include "cell/programs/kd/kd_store.h"

static inline uint32_t kd_tiles(void) { return s()->frame.tiles_x * s()->frame.tiles_y; }

/* ---- which is next ---- */

typedef struct kd_assigned {
    uint32_t next; /* of the fixed share */
    bool mailbox;  /* more come by mailbox */
} kd_assigned;

static uint32_t kd_next_envelope(kd_assigned *a)
{
    if (a->next < s()->control.envelopes)
        return s()->control.first + a->next++ * s()->control.step;
    if (!a->mailbox)
        return CGT_STRIP_END;
    const uint32_t envelope = spu_read_in_mbox();
    a->mailbox = envelope != CGT_STRIP_END;
    if (a->mailbox)
        spu_write_out_mbox(envelope);
    return envelope;
}

/* Until all SPEs are here. */
static void kd_barrier(void)
{
    spu_write_out_mbox(CGT_KD_PHASE);
    while (spu_read_in_mbox() != CGT_KD_PHASE)
        ;
}

/* ---- rays and hits ---- */

/* Starts to fetch an envelope. hits: those of earlier parts come, too. */
static void kd_get_envelope(uint32_t envelope, uint32_t buffer, bool hits)
{
    const uint32_t tiles = kd_tiles();
    const uint64_t first = (uint64_t)envelope * tiles;
    mfc_get(s()->ray[buffer], kd_ea(s()->control.rays) + first * sizeof(cgt_kd_ray_tile),
            tiles * sizeof(cgt_kd_ray_tile), TAG_IN0 + buffer, 0, 0);
    mfc_get(s()->ray_info[buffer], kd_ea(s()->control.ray_infos) + first * sizeof(cgt_kd_info),
            tiles * sizeof(cgt_kd_info), TAG_IN0 + buffer, 0, 0);
    kd_wait(1u << (TAG_OUT0 + buffer)); /* the buffer's last hits */
    if (hits)
        mfc_get(s()->hit[buffer], kd_ea(s()->control.hits) + first * sizeof(cgt_kd_hit_tile),
                tiles * sizeof(cgt_kd_hit_tile), TAG_IN0 + buffer, 0, 0);
}

static void kd_put_hits(uint32_t envelope, uint32_t buffer)
{
    const uint32_t tiles = kd_tiles();
    mfc_put(s()->hit[buffer], kd_ea(s()->control.hits) + (uint64_t)envelope * tiles * sizeof(cgt_kd_hit_tile),
            tiles * sizeof(cgt_kd_hit_tile), TAG_OUT0 + buffer, 0, 0);
}

static inline vmask kd_active(const cgt_kd_info *info) { return spux_mask_from_bits(info->id_or_active); }

/* The packet of an envelope's rays, and its best hits so far. */
static void kd_load_packet(uint32_t buffer, bool hits)
{
    const cgt_camera_image *const c = &s()->camera;
    packet *const p = &s()->packet;
    const vfloat closed = spux_vfloat(-INFINITY);
    p->lanes = 4 * kd_tiles();
    p->any_hit = false;
    s()->tile = s()->ray_info[buffer];
    for (uint32_t i = 0; i < p->lanes; i += 4) {
        const cgt_kd_ray_tile *const ray = &s()->ray[buffer][i / 4];
        const cgt_kd_hit_tile *const hit = &s()->hit[buffer][i / 4];
        const vmask active = kd_active(&s()->ray_info[buffer][i / 4]);
        for (uint32_t a = 0; a < 3; a++) {
            spux_store(p->dir[a] + i, spux_load(ray->dir[a]));
            spux_store(p->org[a] + i, spux_vfloat(ray->org[a]));
        }
        spux_store(p->t_min + i, spux_vfloat(c->t_min));
        spux_store(p->t_max + i, spux_vfloat(c->t_max));
        spux_store(p->low + i, spux_select(closed, hits ? spux_load(hit->low) : spux_vfloat(c->t_max), active));
        spux_store(p->high + i, spux_select(closed, hits ? spux_load(hit->high) : spux_vfloat(c->t_max), active));
        spux_store_uint(p->prim + i, hits ? spux_load_uint(hit->prim) : spux_vuint(CGT_INVALID_ID));
    }
}

static void kd_store_hits(uint32_t buffer)
{
    const packet *const p = &s()->packet;
    for (uint32_t i = 0; i < p->lanes; i += 4) {
        cgt_kd_hit_tile *const hit = &s()->hit[buffer][i / 4];
        const vmask active = kd_active(&s()->ray_info[buffer][i / 4]);
        spux_store_uint(hit->prim, spux_load_uint(p->prim + i));
        spux_store(hit->low, spux_select(spux_vfloat(0), spux_load(p->low + i), active));
        spux_store(hit->high, spux_select(spux_vfloat(0), spux_load(p->high + i), active));
        hit->info = s()->ray_info[buffer][i / 4];
    }
}

#endif

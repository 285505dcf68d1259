/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a frame of the kd program gives: hit packets lie in the order of their envelopes, and go to their pixels
 * here. */
#include <string.h>

#include "cell/ppe/kd/kd_frame_memory.h"

/* Doubts that found a hit occlude their rays. */
static void merge_decided(kd_frame *f)
{
    const uint8_t *const decided = f->array[KD_ARRAY_DECIDED];
    for (uint32_t e = 0; e < f->image.envelopes && !f->options->cell.keep_doubts; e++)
        for (uint32_t b = 0; b < f->batches; b++)
            for (uint32_t k = 0; k < f->tiles; k++) {
                const uint64_t tile = ((uint64_t)e * f->batches + b) * f->tiles + k;
                cgt_kd_frame_occlusion(f, e, b)[k] |= decided[tile / 2] >> tile % 2 * 4 & 15u;
            }
}

/* Reflected rays get the nearer one of their hit and of their nearest doubt. */
static void merge_reflected(kd_frame *f)
{
    const uint32_t batch = f->batches - 1, *const nearest = f->array[KD_ARRAY_REFLECTED];
    for (uint32_t e = 0; e < f->image.envelopes && f->image.mirror && !f->options->cell.keep_doubts; e++)
        for (uint32_t k = 0; k < f->tiles; k++) {
            cgt_kd_secondary_tile *const tile = &cgt_kd_frame_secondary(f, e, batch)[k];
            uint32_t *const bits = &cgt_kd_frame_occlusion(f, e, batch)[k];
            for (uint32_t lane = 0; lane < 4; lane++) {
                if (!(tile->info.id_or_active >> lane & 1))
                    continue;
                const cgt_ray ray = cgt_kd_frame_secondary_ray(f, tile, batch, lane);
                tile->prim[lane] = cgt_doubts_merge(&f->run.doubts, &ray, tile->prim[lane],
                                                    nearest[((size_t)e * f->tiles + k) * 4 + lane]);
                *bits = (*bits & ~(1u << lane)) | (uint32_t)(tile->prim[lane] != CGT_INVALID_ID) << lane;
            }
        }
}

static void write_secondary(kd_frame *f, uint32_t envelope, uint32_t tile, uint32_t lane, size_t pixel)
{
    const size_t pixels = (size_t)f->image.width * f->image.height;
    for (uint32_t b = 0; b < f->batches; b++) {
        const cgt_kd_secondary_tile *const from = &cgt_kd_frame_secondary(f, envelope, b)[tile];
        const uint32_t bits = cgt_kd_frame_occlusion(f, envelope, b)[tile];
        const bool active = from->info.id_or_active >> lane & 1;
        if (f->output->occluded)
            f->output->occluded[b * pixels + pixel] = active ? bits >> lane & 1 : CGT_KD_NO_RAY;
        if (cgt_kd_frame_is_mirror(f, b) && f->output->reflected)
            f->output->reflected[pixel] = active ? from->prim[lane] : CGT_INVALID_ID;
        for (int a = 0; a < 3 && f->output->ray; a++) {
            f->output->ray[b * pixels + pixel][a] = from->org[a][lane];
            f->output->ray[b * pixels + pixel][3 + a] = from->dir[a][lane];
        }
    }
}

/* One ray of a hit tile goes to its pixel. */
static cgt_result write_pixel(kd_frame *f, uint32_t envelope, uint32_t tile, uint32_t lane)
{
    const cgt_kd_hit_tile *const hit =
        (const cgt_kd_hit_tile *)f->array[KD_ARRAY_HITS] + (size_t)envelope * f->tiles + tile;
    const uint32_t x = hit->info.x + lane % 2, y = hit->info.y + lane / 2;
    if (!(hit->info.id_or_active >> lane & 1))
        return CGT_OK;
    if (x >= f->image.width || y >= f->image.height) {
        f->run.broken = true;
        return CGT_OK;
    }
    const size_t pixel = (size_t)y * f->image.width + x;
    uint32_t id = hit->prim[lane];
    cgt_result result = CGT_OK;
    if (!f->options->cell.keep_doubts && cgt_doubts_finish(&f->run.doubts, x, y, &id))
        result = cgt_kd_frame_secondary_again(f, envelope, tile, lane, id);
    const cgt_kd_ray_tile *const ray =
        (const cgt_kd_ray_tile *)f->array[KD_ARRAY_RAYS] + (size_t)envelope * f->tiles + tile;
    for (int a = 0; a < 3 && f->output->direction; a++)
        f->output->direction[pixel][a] = ray->dir[a][lane];
    if (f->output->ids)
        f->output->ids[pixel] = id;
    write_secondary(f, envelope, tile, lane, pixel);
    return result;
}

cgt_result cgt_kd_frame_write(kd_frame *f)
{
    const size_t pixels = (size_t)f->image.width * f->image.height;
    cgt_result result = CGT_OK;
    if (f->output->ids)
        memset(f->output->ids, 0xff, pixels * sizeof *f->output->ids);
    if (f->output->direction)
        memset(f->output->direction, 0, pixels * sizeof *f->output->direction);
    if (f->output->occluded)
        memset(f->output->occluded, CGT_KD_NO_RAY, pixels * f->batches);
    if (f->output->ray)
        memset(f->output->ray, 0, pixels * f->batches * sizeof *f->output->ray);
    if (f->output->reflected && f->image.mirror)
        memset(f->output->reflected, 0xff, pixels * sizeof *f->output->reflected);
    merge_decided(f);
    merge_reflected(f);
    for (uint32_t e = 0; e < f->image.envelopes && f->scene->parts; e++)
        for (uint32_t k = 0; k < 4 * f->tiles && result == CGT_OK; k++)
            result = write_pixel(f, e, k / 4, k % 4);
    return result;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Memory of a frame of the kd program. */
#include "cell/ppe/kd/kd_frame_memory.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#define MOST_BYTES 0x80000000u /* of an array: half its window */

static size_t whole_lines(uint64_t bytes) { return (size_t)((bytes + 127) / 128 * 128); }

cgt_result cgt_kd_frame_allocate(kd_frame *f, char message[CGT_CELL_MESSAGE_BYTES])
{
    const uint64_t envelopes = f->image.envelopes, tiles = envelopes * f->tiles, batches = f->batches;
    const uint64_t secondary = tiles * batches;
    const uint64_t bytes[KD_ARRAYS] = {
        [KD_ARRAY_INFOS] = envelopes * sizeof(cgt_kd_info),
        [KD_ARRAY_RAYS] = tiles * sizeof(cgt_kd_ray_tile),
        [KD_ARRAY_RAY_INFOS] = tiles * sizeof(cgt_kd_info),
        [KD_ARRAY_HITS] = tiles * sizeof(cgt_kd_hit_tile),
        [KD_ARRAY_SECONDARY] = secondary * sizeof(cgt_kd_secondary_tile),
        [KD_ARRAY_OCCLUSION] = envelopes * batches * ((f->tiles + 3) / 4 * 16),
        [KD_ARRAY_DECIDED] = (secondary * 4 + 7) / 8,
        [KD_ARRAY_REFLECTED] = f->image.mirror ? tiles * 4 * sizeof(uint32_t) : 0,
    };
    for (int k = 0; k < KD_ARRAYS; k++)
        if (bytes[k] > MOST_BYTES) {
            snprintf(message, CGT_CELL_MESSAGE_BYTES,
                     "%" PRIu32 " x %" PRIu32 " pixels with %" PRIu32
                     " secondary rays each exceed the 2 GB of addresses for an array",
                     f->image.width, f->image.height, f->batches);
            return CGT_ERROR_TOO_LARGE;
        }
    for (int k = 0; k < KD_ARRAYS; k++) {
        f->bytes[k] = whole_lines(bytes[k]);
        if (!f->bytes[k])
            continue;
        f->array[k] = cgt_frame_allocate(&f->run, f->bytes[k], k == KD_ARRAY_REFLECTED ? 0xff : 0, message);
        if (!f->array[k])
            return CGT_ERROR_OUT_OF_MEMORY;
    }
    return CGT_OK;
}

void cgt_kd_frame_release(kd_frame *f)
{
    for (int k = 0; k < KD_ARRAYS; k++)
        if (f->array[k])
            cgt_free(f->run.memory, f->array[k], f->bytes[k]);
    cgt_frame_release(&f->run);
}

static cgt_result map_scene(kd_frame *f)
{
    const cgt_kd_scene *const s = f->scene;
    cgt_result result = CGT_OK;
    for (uint32_t k = 0; k < s->parts && result == CGT_OK; k++) {
        const cgt_kd_scene_part *const p = &s->part[k];
        const cgt_frame_region region[] = {{CGT_KD_EA(CGT_KD_NODES + k), p->node, p->node_bytes, false},
                                           {CGT_KD_EA(CGT_KD_REFERENCES + k), p->reference, p->reference_bytes, false},
                                           {CGT_KD_EA(CGT_KD_LEAVES + k), p->leaf, p->leaf_bytes, false}};
        result = cgt_frame_map(&f->run, region, sizeof region / sizeof region[0]);
        f->parts[k] = p->image;
        f->parts[k].node[0] = CGT_KD_NODES + k;
        f->parts[k].reference[0] = CGT_KD_REFERENCES + k;
        f->parts[k].leaf[0] = CGT_KD_LEAVES + k;
    }
    return result;
}

cgt_result cgt_kd_frame_map(cgt_cell_frame *run)
{
    kd_frame *const f = (kd_frame *)run;
    const cgt_frame_region region[] = {
        {CGT_EA_CONTROL, f->control, sizeof f->control, false},
        {CGT_EA_SCENE, f->parts, sizeof f->parts, false},
        {CGT_KD_EA_FRAME, f->image_bytes, CGT_KD_FRAME_BYTES, false},
        {CGT_KD_EA(CGT_KD_TRIANGLES), f->scene->triangle, f->scene->triangle_bytes, false},
        {CGT_KD_EA(CGT_KD_INFOS), f->array[KD_ARRAY_INFOS], f->bytes[KD_ARRAY_INFOS], false},
        {CGT_KD_EA(CGT_KD_RAYS), f->array[KD_ARRAY_RAYS], f->bytes[KD_ARRAY_RAYS], true},
        {CGT_KD_EA(CGT_KD_RAY_INFOS), f->array[KD_ARRAY_RAY_INFOS], f->bytes[KD_ARRAY_RAY_INFOS], true},
        {CGT_KD_EA(CGT_KD_HITS), f->array[KD_ARRAY_HITS], f->bytes[KD_ARRAY_HITS], true},
        {CGT_KD_EA(CGT_KD_SECONDARY_RAYS), f->array[KD_ARRAY_SECONDARY], f->bytes[KD_ARRAY_SECONDARY], true},
        {CGT_KD_EA(CGT_KD_OCCLUSION), f->array[KD_ARRAY_OCCLUSION], f->bytes[KD_ARRAY_OCCLUSION], true}};
    const cgt_result result = map_scene(f);
    return result == CGT_OK ? cgt_frame_map(run, region, sizeof region / sizeof region[0]) : result;
}

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
    const uint64_t pixels = (uint64_t)f->image.width * f->image.height, secondary = tiles * batches;
    const uint64_t bytes[KD_ARRAYS] = {
        [KD_ARRAY_INFOS] = envelopes * sizeof(cgt_kd_info),
        [KD_ARRAY_RAYS] = tiles * sizeof(cgt_kd_ray_tile),
        [KD_ARRAY_RAY_INFOS] = tiles * sizeof(cgt_kd_info),
        [KD_ARRAY_HITS] = tiles * sizeof(cgt_kd_hit_tile),
        [KD_ARRAY_SECONDARY] = secondary * sizeof(cgt_kd_secondary_tile),
        [KD_ARRAY_OCCLUSION] = envelopes * batches * ((f->tiles + 3) / 4 * 16),
        [KD_ARRAY_RING] = (uint64_t)f->run_options.spes * 2 * f->half * sizeof(cgt_doubt),
        [KD_ARRAY_NEAREST] = pixels * sizeof(uint32_t),
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
        f->array[k] = cgt_allocate(&f->scene->memory, f->bytes[k]);
        if (!f->array[k]) {
            snprintf(message, CGT_CELL_MESSAGE_BYTES, "out of memory for a frame of %" PRIu32 " x %" PRIu32 " pixels",
                     f->image.width, f->image.height);
            return CGT_ERROR_OUT_OF_MEMORY;
        }
        memset(f->array[k], 0, f->bytes[k]);
    }
    return CGT_OK;
}

void cgt_kd_frame_release(kd_frame *f)
{
    cgt_cell_destroy(f->run.cell);
    for (int k = 0; k < KD_ARRAYS; k++)
        if (f->array[k])
            cgt_free(&f->scene->memory, f->array[k], f->bytes[k]);
    cgt_camera_tables_release(&f->tables);
}

static cgt_result add(kd_frame *f, uint64_t ea, const void *memory, size_t bytes, bool writable)
{
    return bytes ? cgt_cell_add_memory(f->run.cell, ea, (void *)(uintptr_t)memory, bytes / 4, 4, writable) : CGT_OK;
}

static cgt_result map_scene(kd_frame *f)
{
    const cgt_kd_scene *const s = f->scene;
    cgt_result result = add(f, CGT_KD_EA(CGT_KD_TRIANGLES), s->triangle, s->triangle_bytes, false);
    for (uint32_t k = 0; k < s->parts && result == CGT_OK; k++) {
        const cgt_kd_scene_part *const p = &s->part[k];
        result = add(f, CGT_KD_EA(CGT_KD_NODES + k), p->node, p->node_bytes, false);
        if (result == CGT_OK)
            result = add(f, CGT_KD_EA(CGT_KD_REFERENCES + k), p->reference, p->reference_bytes, false);
        if (result == CGT_OK)
            result = add(f, CGT_KD_EA(CGT_KD_LEAVES + k), p->leaf, p->leaf_bytes, false);
        f->parts[k] = p->image;
        f->parts[k].node[0] = CGT_KD_NODES + k;
        f->parts[k].reference[0] = CGT_KD_REFERENCES + k;
        f->parts[k].leaf[0] = CGT_KD_LEAVES + k;
    }
    return result;
}

cgt_result cgt_kd_frame_map(kd_frame *f)
{
    const cgt_camera_tables *const t = &f->tables;
    const struct {
        uint64_t ea;
        const void *memory;
        size_t bytes;
        bool writable;
    } region[] = {{CGT_EA_CONTROL, f->control, sizeof f->control, false},
                  {CGT_EA_REPORT, f->report, sizeof f->report, true},
                  {CGT_EA_CAMERA, &t->image, sizeof t->image, false},
                  {CGT_EA_SCENE, f->parts, sizeof f->parts, false},
                  {CGT_KD_EA_FRAME, f->image_bytes, CGT_KD_FRAME_BYTES, false},
                  {CGT_EA_COLUMNS, t->column, t->column_bytes, false},
                  {CGT_EA_ROWS, t->row, t->row_bytes, false},
                  {CGT_EA_DOUBTS, f->array[KD_ARRAY_RING], f->bytes[KD_ARRAY_RING], true},
                  {CGT_KD_EA(CGT_KD_INFOS), f->array[KD_ARRAY_INFOS], f->bytes[KD_ARRAY_INFOS], false},
                  {CGT_KD_EA(CGT_KD_RAYS), f->array[KD_ARRAY_RAYS], f->bytes[KD_ARRAY_RAYS], true},
                  {CGT_KD_EA(CGT_KD_RAY_INFOS), f->array[KD_ARRAY_RAY_INFOS], f->bytes[KD_ARRAY_RAY_INFOS], true},
                  {CGT_KD_EA(CGT_KD_HITS), f->array[KD_ARRAY_HITS], f->bytes[KD_ARRAY_HITS], true},
                  {CGT_KD_EA(CGT_KD_SECONDARY_RAYS), f->array[KD_ARRAY_SECONDARY], f->bytes[KD_ARRAY_SECONDARY], true},
                  {CGT_KD_EA(CGT_KD_OCCLUSION), f->array[KD_ARRAY_OCCLUSION], f->bytes[KD_ARRAY_OCCLUSION], true}};
    cgt_result result = map_scene(f);
    for (size_t i = 0; i < sizeof region / sizeof region[0] && result == CGT_OK; i++)
        result = add(f, region[i].ea, region[i].memory, region[i].bytes, region[i].writable);
    return result;
}

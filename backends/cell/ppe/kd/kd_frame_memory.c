/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Memory of a frame of the kd program. */
#include "cell/ppe/kd/kd_frame_memory.h"

#include <inttypes.h>
#include <math.h>
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

/* ---- secondary rays ---- */

cgt_kd_secondary_tile *cgt_kd_frame_secondary(const kd_frame *f, uint32_t envelope, uint32_t batch)
{
    cgt_kd_secondary_tile *const first = f->array[KD_ARRAY_SECONDARY];
    return first + ((size_t)envelope * f->batches + batch) * f->tiles;
}

uint32_t *cgt_kd_frame_occlusion(const kd_frame *f, uint32_t envelope, uint32_t batch)
{
    uint32_t *const first = f->array[KD_ARRAY_OCCLUSION];
    return first + ((size_t)envelope * f->batches + batch) * ((f->tiles + 3) / 4 * 4);
}

/* The direction of an ambient ray, on the side of the triangle that `ray` comes from. */
static void ambient_direction(const kd_frame *f, const cgt_ray *ray, const cgt_triangle *q, uint32_t number, float d[3])
{
    double e[2][3], n[3], along = 0, up = 0;
    for (int a = 0; a < 3; a++) {
        e[0][a] = (double)q->v[1][a] - (double)q->v[0][a];
        e[1][a] = (double)q->v[2][a] - (double)q->v[0][a];
        d[a] = f->direction[16 + number % CGT_KD_DIRECTIONS][a];
    }
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        n[a] = e[0][b] * e[1][c] - e[0][c] * e[1][b];
        along += n[a] * (double)ray->line.dir[a];
        up += n[a] * (double)d[a];
    }
    if ((along > 0) == (up > 0))
        for (int a = 0; a < 3; a++)
            d[a] = -d[a];
}

/* Whether anything lies in a ray's way. */
static cgt_result trace_occlusion(const kd_frame *f, const float org[3], const float d[3], bool light, bool *occluded)
{
    const float t_min = light ? f->image.light_t_min : f->image.ambient_t_min,
                t_max = light ? 1 : f->image.ambient_t_max;
    const cgt_rays rays = {
        .count = 1, .org = {&org[0], &org[1], &org[2]}, .dir = {&d[0], &d[1], &d[2]}, .t_min = &t_min, .t_max = &t_max};
    const cgt_trace_options options = {.precision = CGT_PRECISION_EXACT};
    *occluded = false;
    for (uint32_t k = 0; k < f->scene->parts && !*occluded; k++) {
        uint8_t hit = 0;
        const cgt_result result = cgt_occluded_rays(f->scene->part[k].scene, &rays, &hit, &options);
        if (result != CGT_OK)
            return result;
        *occluded = hit != 0;
    }
    return CGT_OK;
}

cgt_result cgt_kd_frame_secondary_again(kd_frame *f, uint32_t envelope, uint32_t tile, uint32_t lane, uint32_t id)
{
    for (uint32_t batch = 0; batch < f->batches; batch++) {
        cgt_kd_secondary_tile *const to = &cgt_kd_frame_secondary(f, envelope, batch)[tile];
        const uint32_t x = to->info.x + lane % 2, y = to->info.y + lane / 2;
        const cgt_ray ray = cgt_kd_doubts_ray(&f->doubts, x, y);
        cgt_decided_hit hit = cgt_kd_doubts_object(&f->doubts, id);
        float org[3], d[3], most = 0;
        bool occluded = false;
        cgt_decide_t(&ray, &hit);
        for (int a = 0; a < 3; a++) {
            org[a] = (float)((double)ray.line.org[a] + hit.t * (double)ray.line.dir[a]);
            d[a] = batch < f->image.lights ? f->image.light[batch][a] - org[a] : 0;
        }
        if (batch >= f->image.lights)
            ambient_direction(f, &ray, &hit.primitive.triangle, x * 5 + y * 19 + (batch - f->image.lights) * 27, d);
        for (int a = 0; a < 3; a++)
            most = fmaxf(most, fabsf(d[a]));
        const uint32_t bit = 1u << lane;
        const bool usual = most > 0x1p-20f && most < 0x1p20f;
        for (int a = 0; a < 3; a++) {
            to->org[a][lane] = usual ? org[a] : 0;
            to->dir[a][lane] = usual ? d[a] : 1;
        }
        if (usual) {
            const cgt_result result = trace_occlusion(f, org, d, batch < f->image.lights, &occluded);
            if (result != CGT_OK)
                return result;
        }
        uint32_t *const bits = &cgt_kd_frame_occlusion(f, envelope, batch)[tile];
        to->info.id_or_active = (to->info.id_or_active & ~bit) | (usual ? bit : 0);
        *bits = (*bits & ~bit) | (occluded ? bit : 0);
    }
    return CGT_OK;
}

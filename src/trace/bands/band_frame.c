/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Regions of frames, and how the bands' hits become one picture. The most populous
 * band is traced into the caller's planes. Pixels where another band comes first are marked, and patched at the end:
 * their hits are computed from the caller's numbers. */
#include "trace/bands/band_trace.h"

#include <math.h>

#include "core/float_environment.h"
#include "query/tile_limits.h"

/* ---- the frame ---- */

static void scale_cameras(cgt_band_frame *f, bool packets)
{
    const struct cgt_bands *bands = f->call.scene->bands;
    for (uint32_t b = 0; b < bands->count; b++) {
        const cgt_committed_scene *scene = &bands->band[b].scene->committed_scene;
        cgt_band_camera *c = &f->band[b];
        c->is_scaled = scene->valid && cgt_band_scale_camera(&bands->band[b], f->camera, &c->camera);
        c->by_tiles = c->is_scaled && !packets && cgt_tile_supports(scene, &c->camera);
    }
}

cgt_result cgt_band_frame_begin(const cgt_scene *scene, const cgt_camera_rays *camera,
                                const cgt_trace_settings *settings, bool packets, uint32_t regions, uint32_t max_pixels,
                                cgt_band_frame *frame)
{
    cgt_float_environment callers;
    const cgt_result result =
        cgt_bands_begin(scene, settings, (uint64_t)regions * max_pixels, max_pixels, &frame->call);
    if (result != CGT_OK)
        return result;
    frame->camera = camera;
    cgt_float_environment_enter(&callers);
    scale_cameras(frame, packets);
    cgt_float_environment_leave(&callers);
    return CGT_OK;
}

/* ---- regions ---- */

static cgt_band_ray pixel_ray(const cgt_camera_rays *c, uint32_t x, uint32_t y)
{
    cgt_band_ray ray = {.ray = {.t_min = c->t_min, .t_max = c->t_max}, .mask = c->mask, .skip = CGT_INVALID_ID};
    cgt_camera_pixel(c, x, y, ray.ray.line.org, ray.ray.line.dir);
    return ray;
}

/* Whether t, a float times a power of two, rounds to the float that the canonical t rounds to. Normal numbers stay as
 * they are. Below them rounding twice gives another result only where the first one has led to the middle between two
 * floats: it keeps the order of all numbers, and the middle is a float itself, times the power. */
static bool t_scales(float scaled_t, double t, const cgt_camera_rays *c)
{
    return cgt_band_t_is_plain((double)scaled_t, t, c->t_min, c->t_max) &&
           (fabs(t) >= 0x1p-126 || fabs(t - (double)(float)t) != 0x1p-150);
}

/* The hits of band 0, which are in the caller's planes, to the caller's names and units. Normals, u and v have no unit:
 * their bits are those of the caller's numbers. Hits whose t does not scale are decided anew, and patched. */
static void rename_hits(const cgt_band_frame *f, const cgt_region *r, const cgt_band_scratch *s, cgt_counts *counts)
{
    const cgt_scene *scene = f->call.scene;
    const cgt_band *band = &scene->bands->band[0];
    const cgt_primitives *prims = &scene->committed_scene.prims, *own = &band->scene->committed_scene.prims;
    const uint32_t *number = band->number.data;
    const double factor = cgt_power_of_two(-band->exponent);
    for (uint32_t i = 0; i < r->width * r->height; i++) {
        const uint32_t x = i % r->width, y = i / r->width;
        const size_t at = y * r->row_stride + x;
        const float scaled_t = r->t[at];
        const double t = (double)scaled_t * factor;
        if (r->primitive[at] == CGT_INVALID_ID)
            continue;
        const uint32_t j = r->geometry[at];
        const uint32_t prim =
            own->arrays == 1 ? number[r->primitive[at]] : cgt_band_primitive(band, j, r->primitive[at]);
        if (t_scales(scaled_t, t, f->camera)) {
            s->best[i] = (cgt_band_best){prim, t};
            r->t[at] = (float)t;
            r->primitive[at] = prim - prims->array[j].first;
            r->geometry[at] = prims->array[j].geometry;
            continue;
        }
        const cgt_band_ray ray = pixel_ray(f->camera, r->x + x, r->y + y);
        cgt_band_accept(prims, band, &ray, prim, scaled_t, band->exponent, &s->best[i], counts);
        s->occluded[i] = true;
    }
}

/* Another band's hits against the best ones, pixel by pixel. */
static void take_hits(const cgt_band_frame *f, uint32_t b, const cgt_region *region, const cgt_band_scratch *s,
                      cgt_counts *counts)
{
    const cgt_scene *scene = f->call.scene;
    const cgt_band *band = &scene->bands->band[b];
    for (uint32_t i = 0; i < region->width * region->height; i++) {
        if (s->primitive[i] == CGT_INVALID_ID)
            continue;
        const cgt_band_ray ray = pixel_ray(f->camera, region->x + i % region->width, region->y + i / region->width);
        const uint32_t before = s->best[i].prim;
        cgt_band_accept(&scene->committed_scene.prims, band, &ray,
                        cgt_band_primitive(band, s->geometry[i], s->primitive[i]), s->t[i], band->exponent, &s->best[i],
                        counts);
        s->occluded[i] |= s->best[i].prim != before;
    }
}

static void trace_camera(const cgt_band_frame *f, uint32_t b, const cgt_trace_settings *settings, const cgt_region *to,
                         cgt_counts *counts)
{
    const cgt_kernel *kernel = f->call.scene->context->kernel;
    const cgt_committed_scene *scene = &f->call.scene->bands->band[b].scene->committed_scene;
    cgt_counts own = {.scratch = counts->scratch};
    (f->band[b].by_tiles ? kernel->trace_tile : kernel->trace_region)(scene, &f->band[b].camera, settings, to, &own);
    cgt_band_add_counts(counts, &own);
}

/* Planes of a region in the scratch. */
static cgt_region scratch_region(const cgt_region *region, const cgt_band_scratch *s)
{
    return (cgt_region){.x = region->x,
                        .y = region->y,
                        .width = region->width,
                        .height = region->height,
                        .row_stride = region->width,
                        .t = s->t,
                        .primitive = s->primitive,
                        .geometry = s->geometry};
}

static void trace_scaled(const cgt_band_frame *f, uint32_t b, const cgt_region *region, const cgt_band_scratch *s,
                         cgt_counts *counts)
{
    const cgt_trace_settings settings = cgt_band_settings(f->call.settings);
    const cgt_region to = scratch_region(region, s);
    trace_camera(f, b, &settings, &to, counts);
    take_hits(f, b, region, s, counts);
}

/* Where band 0 goes: straight to the caller's planes, or to scratch, where one of those is missing that names hits. */
static cgt_region choose_planes(const cgt_region *region, uint32_t fields, const cgt_band_scratch *s)
{
    cgt_region to = *region;
    to.nontemporal = false;
    if (region->t && region->primitive && region->geometry)
        return to;
    to = scratch_region(region, s);
    if (fields & CGT_FIELD_NORMAL)
        for (int a = 0; a < 3; a++)
            to.normal[a] = s->org[a];
    to.u = fields & CGT_FIELD_UV ? s->dir[0] : NULL;
    to.v = fields & CGT_FIELD_UV ? s->dir[1] : NULL;
    return to;
}

static void copy_planes(const cgt_region *from, const cgt_region *to)
{
    for (int k = 0; k < CGT_PLANES; k++)
        for (uint32_t y = 0; to->plane[k] && to->plane[k] != from->plane[k] && y < to->height; y++)
            memcpy(to->plane[k] + y * to->row_stride, from->plane[k] + y * from->row_stride,
                   to->width * sizeof(uint32_t));
}

/* Traces band 0 and stores its hits, all fields of them. */
static void trace_main(const cgt_band_frame *f, const cgt_region *region, const cgt_band_scratch *s, cgt_counts *counts)
{
    cgt_trace_settings settings = cgt_band_settings(f->call.settings);
    const cgt_region to = choose_planes(region, f->call.settings->fields, s);
    settings.fields |= f->call.settings->fields;
    trace_camera(f, 0, &settings, &to, counts);
    rename_hits(f, &to, s, counts);
    copy_planes(&to, region);
}

/* Rays of pixels as arrays of the caller's would hold them. */
#define BLOCK_EDGE 8u
#define BLOCK (BLOCK_EDGE * BLOCK_EDGE)

typedef struct pixel_block {
    float org[3][BLOCK], dir[3][BLOCK], t_min[BLOCK], t_max[BLOCK];
    uint32_t mask[BLOCK], pixel[BLOCK];
    cgt_band_best best[BLOCK];
} pixel_block;

static void append_pixel(const cgt_camera_rays *c, const cgt_region *region, uint32_t pixel, pixel_block *p,
                         uint32_t to)
{
    const cgt_band_ray ray = pixel_ray(c, region->x + pixel % region->width, region->y + pixel / region->width);
    for (int a = 0; a < 3; a++) {
        p->org[a][to] = ray.ray.line.org[a];
        p->dir[a][to] = ray.ray.line.dir[a];
    }
    p->t_min[to] = c->t_min;
    p->t_max[to] = c->t_max;
    p->mask[to] = c->mask;
    p->pixel[to] = pixel;
}

static cgt_rays block_rays(const pixel_block *p, uint32_t count)
{
    return (cgt_rays){.count = count,
                      .org = {p->org[0], p->org[1], p->org[2]},
                      .dir = {p->dir[0], p->dir[1], p->dir[2]},
                      .t_min = p->t_min,
                      .t_max = p->t_max,
                      .mask = p->mask};
}

static uint32_t read_block(const cgt_camera_rays *c, const cgt_region *region, uint32_t x0, uint32_t y0, pixel_block *p)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < BLOCK; i++) {
        const uint32_t x = x0 + i % BLOCK_EDGE, y = y0 + i / BLOCK_EDGE;
        if (x < region->width && y < region->height)
            append_pixel(c, region, y * region->width + x, p, count++);
    }
    return count;
}

/* The pixels' rays through band b, one by one; past all bands: through the rest. */
static void trace_rays(const cgt_band_frame *f, uint32_t b, const cgt_region *region, const cgt_band_scratch *s,
                       cgt_counts *counts)
{
    pixel_block p;
    uint8_t occluded[BLOCK];
    cgt_band_scratch block = *s; /* whose planes are free meanwhile, but for the marks of pixels */
    block.best = p.best;
    block.occluded = occluded;
    block.capacity = BLOCK;
    for (uint32_t y = 0; y < region->height; y += BLOCK_EDGE)
        for (uint32_t x = 0; x < region->width; x += BLOCK_EDGE) {
            const uint32_t count = read_block(f->camera, region, x, y, &p);
            const cgt_rays rays = block_rays(&p, count);
            const cgt_band_chunk chunk = {
                .call = &f->call, .scratch = &block, .rays = &rays, .count = count, .counts = counts};
            for (uint32_t i = 0; i < count; i++)
                p.best[i] = s->best[p.pixel[i]];
            if (b < f->call.scene->bands->count)
                cgt_band_trace_chunk(&chunk, b);
            else
                cgt_band_trace_rest(&chunk);
            for (uint32_t i = 0; i < count; i++) {
                s->occluded[p.pixel[i]] |= s->best[p.pixel[i]].prim != p.best[i].prim;
                s->best[p.pixel[i]] = p.best[i];
            }
        }
}

/* Stores the hits of up to BLOCK pixels, computed from the caller's numbers. */
static void patch_block(const cgt_band_frame *f, const cgt_region *region, const cgt_band_scratch *s, pixel_block *p,
                        uint32_t count, cgt_counts *counts)
{
    uint32_t plane[CGT_PLANES][BLOCK], prim[BLOCK];
    cgt_region block = {.plane = {NULL}};
    for (int k = 0; k < CGT_PLANES; k++)
        block.plane[k] = region->plane[k] ? plane[k] : NULL;
    const cgt_hits hits = cgt_region_hits(&block);
    const cgt_rays rays = block_rays(p, count);
    for (uint32_t i = 0; i < count; i++)
        prim[i] = s->best[p->pixel[i]].prim;
    f->call.scene->context->kernel->resolve_rays(&f->call.scene->committed_scene, &rays, 0, count, prim,
                                                 f->call.settings, &hits, counts);
    for (int k = 0; k < CGT_PLANES; k++)
        for (uint32_t i = 0; region->plane[k] && i < count; i++)
            region->plane[k][p->pixel[i] / region->width * region->row_stride + p->pixel[i] % region->width] =
                plane[k][i];
}

/* Stores the pixels that are marked. */
static void patch_pixels(const cgt_band_frame *f, const cgt_region *region, const cgt_band_scratch *s,
                         cgt_counts *counts)
{
    pixel_block p;
    uint32_t count = 0;
    for (uint32_t i = 0; i < region->width * region->height; i++) {
        if (!s->occluded[i])
            continue;
        append_pixel(f->camera, region, i, &p, count++);
        if (count == BLOCK) {
            patch_block(f, region, s, &p, count, counts);
            count = 0;
        }
    }
    if (count)
        patch_block(f, region, s, &p, count, counts);
}

void cgt_band_trace_region(const cgt_band_frame *f, uint32_t slot, const cgt_region *region, cgt_counts *counts)
{
    const struct cgt_bands *bands = f->call.scene->bands;
    const cgt_band_scratch s = cgt_band_slot(&f->call, slot);
    const uint32_t pixels = region->width * region->height;
    const bool fast = f->call.settings->precision == CGT_PRECISION_FAST; /* values are of the caller's numbers alone */
    for (uint32_t i = 0; i < pixels; i++) {
        s.best[i] = (cgt_band_best){CGT_INVALID_ID, INFINITY};
        s.occluded[i] = fast || !f->band[0].is_scaled; /* then pixels without a hit are stored at the end, too */
    }
    for (uint32_t b = 0; b < bands->count; b++)
        if (!b && f->band[0].is_scaled && !fast)
            trace_main(f, region, &s, counts);
        else if (f->band[b].is_scaled)
            trace_scaled(f, b, region, &s, counts);
        else
            trace_rays(f, b, region, &s, counts);
    if (bands->rest)
        trace_rays(f, bands->count, region, &s, counts);
    for (uint32_t i = 0; i < pixels; i++)
        counts->hits += !s.occluded[i] && s.best[i].prim != CGT_INVALID_ID;
    counts->rays += pixels;
    patch_pixels(f, region, &s, counts);
}

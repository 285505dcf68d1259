/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Turns hits into pixels; see shade.h. A tile is processed in runs of up to RUN hits of one row: first the brightness
 * of each, in plain loops that a compiler vectorises, then colour and sRGB codes through tables. */
#include "picture/draw/shade.h"

#include <math.h>
#include <string.h>

enum { RUN = 16 }; /* hits; a multiple of SHADE_MAX_SAMPLES. Short, so that many runs contain background only */

/* Shares of the light. The side of a sphere that faces light and eye reaches 1: no colour is clipped. */
static const float share_light = 0.85f, share_head = 0.35f, share_ambient = 0.05f;

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void normalize(float v[3])
{
    const float length = sqrtf(dot(v, v));
    for (int c = 0; c < 3; c++)
        v[c] = length > 0.0f ? v[c] / length : 0.0f;
}

static void cross(const float a[3], const float b[3], float out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

void shade_begin(shade_job *job)
{
    const cgt_camera *camera = &job->camera;
    for (int c = 0; c < 3; c++)
        job->forward[c] = camera->target[c] - camera->eye[c];
    normalize(job->forward);
    cross(job->forward, camera->up, job->right);
    normalize(job->right);
    cross(job->right, job->forward, job->up);
    /* The headlight of an orthographic camera shines along the view everywhere. */
    const float half = camera->projection == CGT_PROJECTION_PERSPECTIVE ? tanf(camera->fov * 0.00872664626f) : 0.0f;
    const float aspect = (float)job->width / (float)job->height;
    for (int c = 0; c < 3; c++) {
        job->right[c] *= half * aspect;
        job->up[c] *= half;
    }
    atomic_store_explicit(&job->hits, 0, memory_order_relaxed);
}

uint32_t shade_fields(const shade_job *job)
{
    return (uint32_t)CGT_FIELD_PRIMITIVE | (uint32_t)CGT_FIELD_NORMAL | (job->pixels ? (uint32_t)CGT_FIELD_T : 0u) |
           (job->surface.vertex_normal || job->surface.mix ? (uint32_t)CGT_FIELD_UV : 0u);
}

/* Ray directions of a run: of the first ray, and the step from each to the next. */
typedef struct run_rays {
    float first[3], step[3];
} run_rays;

/* The rays of row y of the frame, from x on. */
static run_rays rays_from(const shade_job *job, uint32_t x, uint32_t y)
{
    run_rays rays;
    const float step = 2.0f / (float)(job->width * job->samples);
    const float v = 1.0f - 2.0f * ((float)y + 0.5f) / (float)(job->height * job->samples);
    const float u = ((float)x + 0.5f) * step - 1.0f;
    for (int c = 0; c < 3; c++) {
        rays.first[c] = job->forward[c] + v * job->up[c] + u * job->right[c];
        rays.step[c] = job->right[c] * step;
    }
    return rays;
}

/* Shading normals of a run of triangles, from element `offset` of the tile on, all turned to the eye's side. */
static void triangle_normals(const shade_job *job, const cgt_tile *tile, size_t offset, uint32_t count,
                             const run_rays *rays, float out[3][RUN])
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t primitive = tile->primitive[offset + i];
        float geometric[3], mixed[3], along_ray = 0.0f;
        for (int c = 0; c < 3; c++) {
            geometric[c] = primitive == CGT_INVALID_ID ? 0.0f : tile->normal[c][offset + i];
            along_ray += geometric[c] * (rays->first[c] + (float)i * rays->step[c]);
        }
        const float *n = geometric;
        int flip = along_ray > 0.0f;
        if (job->surface.vertex_normal && primitive != CGT_INVALID_ID &&
            surface_mix_normal(&job->surface, primitive, tile->u[offset + i], tile->v[offset + i], mixed)) {
            flip = (dot(geometric, mixed) < 0.0f) != flip;
            n = mixed;
        }
        for (int c = 0; c < 3; c++)
            out[c][i] = flip ? -n[c] : n[c];
    }
}

/* Brightness of `count` hits; n are their normals, zero where nothing was hit. */
static void brightness(const shade_job *job, const run_rays *rays, uint32_t count, const float *const n[3],
                       float out[RUN])
{
    const float *const base = rays->first;
    const float rx = rays->step[0], ry = rays->step[1], rz = rays->step[2];
    const float lx = job->light[0], ly = job->light[1], lz = job->light[2];
    const float *const nx = n[0], *const ny = n[1], *const nz = n[2];
    for (uint32_t i = 0; i < count; i++) {
        const float k = (float)(int32_t)i;
        const float dx = base[0] + k * rx, dy = base[1] + k * ry, dz = base[2] + k * rz;
        const float lambert = nx[i] * lx + ny[i] * ly + nz[i] * lz;
        /* Inside a sphere the normal points away from the eye; the headlight is the same on both sides. */
        const float head = fabsf(nx[i] * dx + ny[i] * dy + nz[i] * dz) / sqrtf(dx * dx + dy * dy + dz * dz);
        out[i] = share_ambient + share_head * head + share_light * (lambert > 0.0f ? lambert : 0.0f);
    }
}

/* The palette entry of a hit, element `offset` of the tile. */
static uint32_t entry_of(const shade_job *job, const cgt_tile *tile, size_t offset)
{
    const uint32_t primitive = tile->primitive[offset];
    if (!job->surface.mix || !job->surface.triangle)
        return job->surface.index[primitive];
    return surface_entry(&job->surface, primitive, tile->u[offset], tile->v[offset]);
}

/* Adds the light of `count` hits from element `offset` on to their pixels. Returns the number of hits. */
static uint32_t gather(const shade_job *job, const cgt_tile *tile, size_t offset, uint32_t count, const float *bright,
                       float sum[RUN][3])
{
    const uint32_t *primitive = tile->primitive + offset;
    const unsigned shift = job->samples == 4 ? 2 : job->samples - 1; /* a division per hit would be measurable */
    uint32_t hits = 0;
    for (uint32_t i = 0; i < count; i++) {
        float *pixel = sum[i >> shift];
        if (primitive[i] == CGT_INVALID_ID) {
            for (int c = 0; c < 3; c++)
                pixel[c] += job->background[c];
            continue;
        }
        const float *color = job->surface.palette[entry_of(job, tile, offset + i)];
        for (int c = 0; c < 3; c++)
            pixel[c] += color[c] * bright[i];
        hits++;
    }
    return hits;
}

/* Depth and primitive of a pixel: those of its closest hit. offset: element of the block's first hit. */
static void set_closest(const shade_job *job, const cgt_tile *tile, size_t offset, image_pixel *pixel)
{
    pixel->z = INFINITY;
    pixel->id = CGT_INVALID_ID;
    for (uint32_t j = 0; j < job->samples; j++)
        for (uint32_t i = 0; i < job->samples; i++) {
            const size_t k = offset + j * tile->row_stride + i;
            if (tile->primitive[k] == CGT_INVALID_ID || tile->t[k] >= pixel->z)
                continue;
            pixel->z = tile->t[k];
            pixel->id = tile->primitive[k];
        }
}

/* Whether `count` x `samples` elements from `offset` on are all misses: CGT_INVALID_ID is all ones. */
static int is_background(const shade_job *job, const cgt_tile *tile, size_t offset, uint32_t count)
{
    uint32_t combined = CGT_INVALID_ID;
    for (uint32_t row = 0; row < job->samples; row++)
        for (uint32_t i = 0; i < count; i++)
            combined &= tile->primitive[offset + row * tile->row_stride + i];
    return combined == CGT_INVALID_ID;
}

static void fill_background(const shade_job *job, size_t first, uint32_t pixels)
{
    uint8_t rgb[3];
    for (int c = 0; c < 3; c++)
        rgb[c] = srgb_encode(job->tables, job->background[c]);
    for (uint32_t k = 0; k < pixels; k++)
        memcpy(job->rgb + (first + k) * 3, rgb, sizeof rgb);
    for (uint32_t k = 0; job->pixels && k < pixels; k++)
        job->pixels[first + k] =
            (image_pixel){job->background[0], job->background[1], job->background[2], INFINITY, CGT_INVALID_ID, 1.0f};
}

/* One run of a row of pixels: `count` hits wide and `samples` hits high, from element (i, j) of the tile. */
static uint32_t shade_run(const shade_job *job, const cgt_tile *tile, uint32_t i, uint32_t j, uint32_t count)
{
    float bright[RUN], sum[RUN][3], shading[3][RUN];
    uint32_t hits = 0;
    const uint32_t n = job->samples;
    const size_t first = (size_t)((tile->y + j) / n) * job->width + (tile->x + i) / n;
    if (is_background(job, tile, j * tile->row_stride + i, count)) {
        fill_background(job, first, count / n);
        return 0;
    }
    memset(sum, 0, sizeof sum[0] * (count / n));
    for (uint32_t row = 0; row < n; row++) {
        const size_t offset = (j + row) * tile->row_stride + i;
        const run_rays rays = rays_from(job, tile->x + i, tile->y + j + row);
        const float *const sphere[3] = {tile->normal[0] + offset, tile->normal[1] + offset, tile->normal[2] + offset};
        const float *const triangle[3] = {shading[0], shading[1], shading[2]};
        if (job->surface.triangle)
            triangle_normals(job, tile, offset, count, &rays, shading);
        brightness(job, &rays, count, job->surface.triangle ? triangle : sphere, bright);
        hits += gather(job, tile, offset, count, bright, sum);
    }
    const float share = 1.0f / (float)(n * n);
    for (uint32_t k = 0; k < count / n; k++) {
        uint8_t *rgb = job->rgb + (first + k) * 3;
        for (int c = 0; c < 3; c++)
            rgb[c] = srgb_encode(job->tables, sum[k][c] * share);
        if (!job->pixels)
            continue;
        image_pixel *pixel = job->pixels + first + k;
        pixel->r = sum[k][0] * share;
        pixel->g = sum[k][1] * share;
        pixel->b = sum[k][2] * share;
        pixel->a = 1.0f;
        set_closest(job, tile, j * tile->row_stride + i + k * n, pixel);
    }
    return hits;
}

cgt_visit shade_tile(void *user, const cgt_tile *tile)
{
    shade_job *job = user;
    const uint32_t n = job->samples;
    uint64_t hits = 0;
    /* Tiles of 64 pixels or 4 scanlines hold whole blocks; others cannot be shaded. */
    if (tile->x % n || tile->y % n || tile->width % n || tile->height % n || (job->stop && *job->stop))
        return CGT_VISIT_STOP;
    for (uint32_t j = 0; j < tile->height; j += n)
        for (uint32_t i = 0; i < tile->width; i += RUN) {
            const uint32_t remaining = tile->width - i;
            hits += shade_run(job, tile, i, j, remaining < RUN ? remaining : RUN);
        }
    atomic_fetch_add_explicit(&job->hits, hits, memory_order_relaxed);
    return CGT_VISIT_CONTINUE;
}

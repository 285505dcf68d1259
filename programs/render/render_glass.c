/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A transparent mesh among spheres; see render_glass.h. */
#include "render/render_glass.h"

#include <stdlib.h>
#include <string.h>

static size_t picture_pixels(const renderer *r) { return (size_t)r->options.width * r->options.height; }

/* Bytes of a picture that is kept: colours, opacity, linear pixels, the last first, so that they are aligned. */
static size_t behind_bytes(const renderer *r) { return picture_pixels(r) * (sizeof(image_pixel) + 4); }

int render_glass_setup(renderer *r)
{
    if (!r->options.particles.mesh || r->options.particles.mesh_opacity >= 1.0f)
        return 0;
    r->behind = malloc(behind_bytes(r));
    return r->behind ? 0 : -1;
}

static void keep_behind(const renderer *r)
{
    const size_t pixels = picture_pixels(r);
    image_pixel *linear = r->behind;
    uint8_t *rgb = (uint8_t *)(linear + pixels), *alpha = rgb + 3 * pixels;
    memcpy(rgb, r->job.rgb, 3 * pixels);
    if (r->alpha)
        memcpy(alpha, r->alpha, pixels);
    if (r->job.pixels)
        memcpy(linear, r->job.pixels, pixels * sizeof *linear);
}

/* Mixes the picture with the one behind the mesh; depth and primitive stay the mesh's. */
static void mix_behind(const renderer *r)
{
    const size_t pixels = picture_pixels(r);
    const image_pixel *linear = r->behind;
    const uint8_t *rgb = (const uint8_t *)(linear + pixels), *alpha = rgb + 3 * pixels;
    const float share = r->options.particles.mesh_opacity;
    for (size_t i = 0; i < pixels; i++) {
        const float front = r->alpha ? share * (float)r->alpha[i] : share,
                    back = (1.0f - share) * (r->alpha ? (float)alpha[i] : 1.0f);
        image_pixel *p = r->job.pixels ? &r->job.pixels[i] : NULL;
        for (int c = 0; c < 3 && front + back > 0.0f; c++) {
            const float ours = r->tables.decode[r->job.rgb[3 * i + c]], theirs = r->tables.decode[rgb[3 * i + c]];
            r->job.rgb[3 * i + c] = srgb_encode(&r->tables, (front * ours + back * theirs) / (front + back));
        }
        if (r->alpha)
            r->alpha[i] = (uint8_t)(front + back + 0.5f);
        if (p) {
            p->r = share * p->r + (1.0f - share) * linear[i].r;
            p->g = share * p->g + (1.0f - share) * linear[i].g;
            p->b = share * p->b + (1.0f - share) * linear[i].b;
            p->a = share * p->a + (1.0f - share) * linear[i].a;
        }
    }
}

cgt_result render_glass_draw(renderer *r, const cgt_trace_options *options)
{
    cgt_camera without = r->job.camera;
    without.mask = MASK_ALL_BUT_MESH;
    cgt_result result = draw_frame(&r->drawing, r->scene, &without, NULL);
    if (result != CGT_OK)
        return result;
    keep_behind(r);
    result = draw_frame(&r->drawing, r->scene, &r->job.camera, options);
    if (result == CGT_OK)
        mix_behind(r);
    return result;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Something transparent in front, such as a mesh among spheres: a frame is drawn without it, then with it, and the two
 * are mixed, so that what lies behind its nearest side shines through. It casts no shadows on what is seen through
 * it. */
#include <string.h>

#include "picture/draw/draw.h"

typedef struct layer {
    image_pixel *linear; /* first, so that it is aligned */
    uint8_t *rgb, *alpha;
} layer;

static size_t pixels_of(const drawing *d) { return (size_t)d->settings.width * d->settings.height; }

static layer layer_behind(const drawing *d)
{
    image_pixel *const linear = d->behind;
    uint8_t *const rgb = (uint8_t *)(linear + pixels_of(d));
    return (layer){linear, rgb, rgb + 3 * pixels_of(d)};
}

static void keep(const drawing *d)
{
    const layer to = layer_behind(d);
    const size_t pixels = pixels_of(d);
    memcpy(to.rgb, d->rgb, 3 * pixels);
    if (d->alpha)
        memcpy(to.alpha, d->alpha, pixels);
    if (d->pixels)
        memcpy(to.linear, d->pixels, pixels * sizeof *to.linear);
}

/* Mixes the picture with the one behind; depth and primitive stay those in front. */
static void mix(const drawing *d)
{
    const layer from = layer_behind(d);
    const float share = d->settings.front;
    for (size_t i = 0; i < pixels_of(d); i++) {
        const float front = d->alpha ? share * (float)d->alpha[i] : share,
                    back = (1.0f - share) * (d->alpha ? (float)from.alpha[i] : 1.0f);
        for (size_t c = 3 * i; c < 3 * i + 3 && front + back > 0.0f; c++) {
            const float ours = d->tables->decode[d->rgb[c]], theirs = d->tables->decode[from.rgb[c]];
            d->rgb[c] = srgb_encode(d->tables, (front * ours + back * theirs) / (front + back));
        }
        if (d->alpha)
            d->alpha[i] = (uint8_t)(front + back + 0.5f);
        if (d->pixels) {
            image_pixel *p = &d->pixels[i];
            p->r = share * p->r + (1.0f - share) * from.linear[i].r;
            p->g = share * p->g + (1.0f - share) * from.linear[i].g;
            p->b = share * p->b + (1.0f - share) * from.linear[i].b;
            p->a = share * p->a + (1.0f - share) * from.linear[i].a;
        }
    }
}

cgt_result draw_layers(drawing *d, const cgt_scene *scene, const cgt_camera *camera, const cgt_trace_options *options)
{
    cgt_camera without = *camera;
    without.mask = d->settings.behind;
    cgt_result result = draw_planes(d, scene, &without, NULL);
    if (result != CGT_OK)
        return result;
    keep(d);
    result = draw_planes(d, scene, camera, options);
    if (result == CGT_OK)
        mix(d);
    return result;
}

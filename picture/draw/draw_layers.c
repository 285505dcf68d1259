/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What is seen through: each layer is a frame of its own, whose hits lie in front of what is opaque. A ray's light is
 * that of the layers it goes through and of what is behind them, from the farthest to the nearest (Porter, Duff,
 * "Compositing Digital Images", SIGGRAPH 1984: each over what is behind it). */
#include <math.h>
#include <string.h>

#include "draw/draw.h"

/* A row of rays; without a mask it was not traced. */
static void hide_row(void *argument, uint32_t index)
{
    drawing *const d = argument;
    const size_t first = (size_t)(d->first_ray_row + index) * d->ray_width;
    for (size_t k = first; k < first + d->ray_width; k++) {
        if (d->camera.mask && (d->primitive[k] == CGT_INVALID_ID || d->t[k] < d->behind->t[k]))
            continue;
        d->t[k] = INFINITY;
        d->primitive[k] = d->geometry[k] = CGT_INVALID_ID;
    }
}

cgt_result cgt_draw_hide_layer(drawing *d) { return cgt_context_run_tasks(d->context, hide_row, d, d->ray_rows); }

/* Puts a ray's layer before those that are farther off. */
static void insert(uint8_t order[CGT_PICTURE_MAX_LAYERS], uint32_t count, uint8_t layer, uint32_t ray,
                   const draw_ray_light of[CGT_PICTURE_MAX_LAYERS][DRAW_BLOCK])
{
    uint32_t at = count;
    for (; at > 0 && of[order[at - 1]][ray].depth > of[layer][ray].depth; at--)
        order[at] = order[at - 1];
    order[at] = layer;
}

/* Lays a layer over what is behind it. */
static void lay_over(draw_ray_light *light, const draw_ray_light *layer, float opacity)
{
    for (int c = 0; c < 3; c++)
        light->color[c] = opacity * layer->color[c] + (1.0f - opacity) * light->color[c];
    light->cover = opacity + (1.0f - opacity) * light->cover;
    light->depth = layer->depth;
    light->id = layer->id;
}

void cgt_draw_mix_layers(const drawing *d, uint32_t x, uint32_t y, uint32_t count, draw_ray_light *light)
{
    const cgt_picture_layer *const style = d->options->style.layers;
    draw_ray_light of[CGT_PICTURE_MAX_LAYERS][DRAW_BLOCK];
    for (uint32_t l = 0; l < d->layers; l++)
        cgt_draw_shade_rays(&d->layer[l], x, y, count, of[l]);
    for (uint32_t i = 0; i < count; i++) {
        uint8_t order[CGT_PICTURE_MAX_LAYERS];
        uint32_t hits = 0;
        for (uint32_t l = 0; l < d->layers; l++)
            if (of[l][i].cover > 0.0f)
                insert(order, hits++, (uint8_t)l, i, of);
        while (hits-- > 0)
            lay_over(&light[i], &of[order[hits]][i], style[order[hits]].opacity);
    }
}

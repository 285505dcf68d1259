/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Spheres and bonds that are seen through: those of an opacity are two geometries of their own, with the mask of their
 * layer of cgt_picture_style. */
#include "figure_state.h"

uint32_t cgt_figure_layer_mask(const particle_options *o, uint32_t layer) { return o->layer_count ? 1u << layer : 0; }

static cgt_result set_spheres(cgt_figure *figure, uint32_t layer)
{
    figure_scene *const s = &figure->parts;
    const particles *const p = &s->frame->particles;
    const uint32_t begin = p->begin[layer], count = p->begin[layer + 1] - begin;
    const float *const xyzr = p->xyzr + 4 * (size_t)begin;
    const cgt_spheres spheres = {.count = count,
                                 .centers = cgt_floats(xyzr, 4 * sizeof(float)),
                                 .radii = cgt_floats(count ? xyzr + 3 : NULL, 4 * sizeof(float)),
                                 .mask = cgt_figure_layer_mask(&figure->options.particles, layer)};
    if (!s->has_layer_spheres[layer] && !count)
        return CGT_OK;
    if (!s->has_layer_spheres[layer])
        s->layer_spheres[layer] = CGT_INVALID_ID;
    const cgt_result result = cgt_scene_set_spheres(figure->scene, &s->layer_spheres[layer], &spheres);
    s->has_layer_spheres[layer] |= result == CGT_OK;
    return result;
}

static cgt_result set_bonds(cgt_figure *figure, uint32_t layer)
{
    figure_scene *const s = &figure->parts;
    const sticks *const t = &s->frame->sticks;
    const uint32_t begin = s->frame->bond_begin[layer], count = s->frame->bond_begin[layer - 1] - begin;
    const cgt_capsules capsules = {.count = count,
                                   .vertex_count = 2 * count,
                                   .vertices = cgt_floats(count ? t->end + 6 * (size_t)begin : NULL, 0),
                                   .radii = cgt_floats(count ? t->radius + begin : NULL, 0),
                                   .mask = cgt_figure_layer_mask(&figure->options.particles, layer)};
    if (!s->has_layer_bonds[layer] && !count)
        return CGT_OK;
    if (!s->has_layer_bonds[layer])
        s->layer_bonds[layer] = CGT_INVALID_ID;
    const cgt_result result = cgt_scene_set_capsules(figure->scene, &s->layer_bonds[layer], &capsules);
    s->has_layer_bonds[layer] |= result == CGT_OK;
    return result;
}

cgt_result cgt_figure_layers_set(cgt_figure *figure)
{
    cgt_result result = CGT_OK;
    for (uint32_t k = 1; k <= figure->options.particles.layer_count && figure->parts.selects && !result; k++) {
        result = set_spheres(figure, k);
        if (result == CGT_OK)
            result = set_bonds(figure, k);
    }
    return result;
}

uint32_t cgt_figure_layers_looks(const cgt_figure *figure, cgt_look *looks)
{
    const figure_scene *const s = &figure->parts;
    const cgt_look plain = {.palette = s->palette[0]};
    uint32_t count = 0;
    for (uint32_t k = 1; k < PARTICLE_LAYERS; k++) {
        if (s->has_layer_spheres[k]) {
            cgt_look *const look = &looks[s->layer_spheres[k]];
            *look = plain;
            look->index = s->frame->particles.index + s->frame->particles.begin[k];
            look->ids = s->frame->particles.source + s->frame->particles.begin[k];
            count++;
        }
        if (s->has_layer_bonds[k]) {
            cgt_look *const look = &looks[s->layer_bonds[k]];
            *look = plain;
            look->index = s->frame->sticks.entry ? s->frame->sticks.entry + 2 * (size_t)s->frame->bond_begin[k] : NULL;
            look->halves = true;
            count++;
        }
    }
    return count;
}

int cgt_figure_layers_find(const cgt_figure *figure, uint32_t geometry, uint32_t *primitive)
{
    const figure_scene *const s = &figure->parts;
    for (uint32_t k = 1; k < PARTICLE_LAYERS; k++)
        if (s->has_layer_spheres[k] && geometry == s->layer_spheres[k]) {
            *primitive += s->frame->particles.begin[k];
            return 0;
        }
    return -1;
}

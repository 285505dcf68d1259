/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The spheres of a frame that are drawn; see particles.h. */
#include "data/particles.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "data/frame_access.h"

enum { BLOCK = 256 };

int cgt_particle_rules_are_empty(const particle_rules *r)
{
    return !r->show && !r->radius && !r->layer && r->radius_scale == 1.0f && !r->radius_count &&
           r->images[0] * r->images[1] * r->images[2] == 1;
}

static int reserve(particles *p, uint64_t count, int has_layers, char *error, size_t error_size)
{
    if (count > (uint64_t)1 << 31) {
        snprintf(error, error_size, "the periodic images have %llu spheres: at most 2^31", (unsigned long long)count);
        return -1;
    }
    if (count <= p->capacity && p->xyzr && (p->layer || !has_layers))
        return 0;
    cgt_particles_free(p);
    const size_t n = count ? (size_t)count : 1;
    p->xyzr = malloc(n * 4 * sizeof *p->xyzr);
    p->index = malloc(n * sizeof *p->index);
    p->source = malloc(n * sizeof *p->source);
    p->layer = has_layers ? malloc(n) : NULL;
    if (p->xyzr && p->index && p->source && (p->layer || !has_layers)) {
        p->capacity = n;
        return 0;
    }
    cgt_particles_free(p);
    snprintf(error, error_size, "out of memory for %llu spheres", (unsigned long long)count);
    return -1;
}

void cgt_particles_free(particles *p)
{
    free(p->xyzr);
    free(p->index);
    free(p->source);
    free(p->layer);
    memset(p, 0, sizeof *p);
}

/* The radius of a sphere by the rules for kinds, else `radius`; the last of several that fit counts. */
static float radius_of(const particle_rules *r, const cgt_trajectory_frame *f, uint32_t i, float radius)
{
    for (uint32_t k = 0; k < r->radius_count; k++) {
        const particle_kind *kind = &r->radii[k];
        const int fits =
            kind->is_element ? f->element && f->element[i] == kind->kind : f->type && f->type[i] == kind->kind;
        radius = fits ? kind->value[0] : radius;
    }
    return radius;
}

void cgt_particle_radii(const particle_rules *r, const cgt_trajectory_frame *f, uint32_t first, uint32_t count,
                        float *radius)
{
    double values[BLOCK];
    for (uint32_t k = 0; k < count && !r->radius && !r->radius_count; k++)
        radius[k] = r->radius_scale * f->xyzr[4 * (size_t)(first + k) + 3];
    for (uint32_t k = 0; k < count && (r->radius || r->radius_count); k++) {
        if (r->radius && k % BLOCK == 0)
            cgt_expression_values(r->radius, first + k, count - k < BLOCK ? count - k : BLOCK, values);
        const float own = r->radius ? (float)values[k % BLOCK] : f->xyzr[4 * (size_t)(first + k) + 3];
        radius[k] = r->radius_scale * radius_of(r, f, first + k, own);
    }
}

/* The spheres that are shown, without images. */
static void select_block(particles *p, const particle_rules *r, const cgt_trajectory_frame *f, const uint16_t *index,
                         uint32_t first, uint32_t count)
{
    double show[BLOCK], layer[BLOCK];
    float radius[BLOCK];
    if (r->layer)
        cgt_expression_values(r->layer, first, count, layer);
    if (r->show)
        cgt_expression_values(r->show, first, count, show);
    cgt_particle_radii(r, f, first, count, radius);
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i = first + k;
        float *to = p->xyzr + 4 * (size_t)p->count;
        if (r->show && !cgt_expression_holds(show[k]))
            continue;
        const int is_dropped = r->radius && !(radius[k] >= 0.0f);
        p->dropped += is_dropped;
        p->points += r->radius && radius[k] == 0.0f;
        if (is_dropped)
            continue;
        memcpy(to, f->xyzr + 4 * (size_t)i, 3 * sizeof *to);
        to[3] = radius[k];
        if (r->layer)
            p->layer[p->count] = (uint8_t)((uint32_t)layer[k] % PARTICLE_LAYER_STEP);
        p->index[p->count] = index[i];
        p->source[p->count++] = i;
    }
}

/* Copies the spheres so far, moved along the box's edges. */
static void add_images(particles *p, const uint32_t images[3], const cgt_trajectory_frame *f)
{
    const uint32_t originals = p->count;
    for (uint32_t copy = 1; copy < images[0] * images[1] * images[2]; copy++) {
        const uint32_t along_a = copy % images[0], along_b = copy / images[0] % images[1],
                       along_c = copy / images[0] / images[1];
        const double along[3] = {along_a, along_b, along_c};
        double move[3];
        for (int c = 0; c < 3; c++)
            move[c] = along[0] * f->box_edge[0][c] + along[1] * f->box_edge[1][c] + along[2] * f->box_edge[2][c];
        for (uint32_t i = 0; i < originals; i++) {
            const float *from = p->xyzr + 4 * (size_t)i;
            float *to = p->xyzr + 4 * (size_t)p->count;
            for (int c = 0; c < 3; c++)
                to[c] = (float)((double)from[c] + move[c]);
            to[3] = from[3];
            if (p->layer)
                p->layer[p->count] = p->layer[i];
            p->index[p->count] = p->index[i];
            p->source[p->count++] = p->source[i];
        }
    }
}

int cgt_particles_select(particles *p, const particle_rules *r, const cgt_trajectory_frame *f, const uint16_t *index,
                         char *error, size_t error_size)
{
    const uint32_t copies = r->images[0] * r->images[1] * r->images[2];
    if (copies > 1 && !frame_has_box(f)) {
        snprintf(error, error_size, "--images: frame %llu has no box", (unsigned long long)f->number);
        return -1;
    }
    if (reserve(p, (uint64_t)f->count * copies, r->layer != NULL, error, error_size))
        return -1;
    if (!r->layer) { /* those of rules before these */
        free(p->layer);
        p->layer = NULL;
    }
    p->count = p->dropped = p->points = 0;
    for (uint32_t first = 0; first < f->count; first += BLOCK)
        select_block(p, r, f, index, first, f->count - first < BLOCK ? f->count - first : BLOCK);
    add_images(p, r->images, f);
    return 0;
}

int cgt_particles_sort(particles *p)
{
    uint32_t at[PARTICLE_LAYERS] = {0};
    particles to = {.count = 0};
    at[0] = p->layer ? 0 : p->count;
    for (uint32_t i = 0; i < p->count && p->layer; i++)
        at[p->layer[i]]++;
    for (uint32_t k = 0, sum = 0; k < PARTICLE_LAYERS; k++) {
        p->begin[k] = sum;
        sum += at[k];
        at[k] = p->begin[k];
    }
    p->begin[PARTICLE_LAYERS] = p->count;
    if (!p->layer || p->begin[1] == p->count)
        return 0;
    char ignored[80];
    if (reserve(&to, p->capacity, 1, ignored, sizeof ignored))
        return -1;
    for (uint32_t i = 0; i < p->count; i++) {
        const size_t k = at[p->layer[i]]++;
        memcpy(to.xyzr + 4 * k, p->xyzr + 4 * (size_t)i, 4 * sizeof *to.xyzr);
        to.index[k] = p->index[i];
        to.source[k] = p->source[i];
        to.layer[k] = p->layer[i];
    }
    to.count = p->count;
    to.dropped = p->dropped;
    to.points = p->points;
    memcpy(to.begin, p->begin, sizeof to.begin);
    cgt_particles_free(p);
    *p = to;
    return 0;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Light that comes straight from lights: shadows, matt surfaces, highlights.
 *
 * A ray to a light begins at the rounded place like any other. What lies beyond `reach` is found by the library's
 * shadows of points; nearer, rays as short as that tell surfaces in contact from ghosts. */
#include <math.h>
#include <string.h>

#include "vector_range.h"
#include "whitted/whitted_internal.h"

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* From the place to the light, as cgt_occluded_points takes it. */
static void towards(const cgt_light *light, const float place[3], float out[3])
{
    for (int a = 0; a < 3; a++)
        out[a] = light->kind == CGT_LIGHT_POINT ? light->position[a] - place[a] : light->position[a];
}

static cgt_result occlude(const whitted *w, whitted_memory *m, const cgt_light *light, uint32_t mask, uint32_t count,
                          uint8_t *occluded)
{
    const whitted_lit *lit = m->lit;
    const cgt_points points = {.count = count,
                               .stride = sizeof *lit,
                               .position = {&lit->position[0], &lit->position[1], &lit->position[2]},
                               .t_min = &lit->t_min,
                               .t_max = &lit->t_max,
                               .mask = mask ? &lit->mask : NULL,
                               .skip_primitive = &lit->primitive,
                               .skip_geometry = &lit->geometry};
    for (uint32_t i = 0; mask && i < count; i++)
        m->lit[i].mask = mask;
    return cgt_occluded_points(w->scene, light, &points, occluded, NULL);
}

/* Finds the points that surfaces in contact with theirs hide: those that nothing else does. */
static cgt_result find_contacts(const whitted *w, whitted_memory *m, const cgt_light *light, uint32_t count)
{
    uint32_t rays = 0;
    for (uint32_t i = 0; i < count; i++) {
        const whitted_lit *lit = &m->lit[i];
        if (m->occluded[i] || !(lit->t_max >= lit->t_min))
            continue;
        whitted_ray *ray = &m->contact[rays];
        memset(ray, 0, sizeof *ray);
        memcpy(ray->org, lit->position, sizeof ray->org);
        memcpy(ray->from, lit->from, sizeof ray->from);
        towards(light, lit->position, ray->dir);
        ray->reach = ray->t_max = lit->t_min;
        ray->t_min = -lit->t_min;
        ray->mask = w->shadow_mask;
        ray->skip_primitive = lit->primitive;
        ray->skip_geometry = lit->geometry;
        ray->side = lit->side;
        ray->nested = lit->nested;
        memcpy(ray->inside, lit->inside, sizeof ray->inside);
        m->contact_of[rays++] = i;
    }
    const cgt_result result = rays ? cgt_whitted_nearest(w, m, m->contact, rays, m->contact_hit, m->surface) : CGT_OK;
    for (uint32_t k = 0; result == CGT_OK && k < rays; k++)
        if (m->contact_hit[k].primitive != CGT_INVALID_ID)
            m->occluded[m->contact_of[k]] = 1;
    return result;
}

/* Sets the range of each point; points that face away from the light are off. Returns how many are not. */
static uint32_t set_ranges(whitted_memory *m, const cgt_light *light, uint32_t count)
{
    uint32_t on = 0;
    for (uint32_t i = 0; i < count; i++) {
        whitted_lit *lit = &m->lit[i];
        float to[3];
        towards(light, lit->position, to);
        const int exponent = picture_bring_near(to);
        const float length = ldexpf(sqrtf(picture_square(to)), exponent), facing = dot(to, lit->normal);
        lit->t_min = length > 0.0f ? lit->reach / length : 0.0f;
        lit->t_max = !(facing > 0.0f) ? -1.0f : light->kind == CGT_LIGHT_POINT ? 1.0f : INFINITY;
        on += facing > 0.0f;
    }
    return on;
}

/* Adds one light to a point: Lambert, and Blinn's highlight. */
static void add_light(const whitted_light *light, const whitted_lit *lit, float share, float rgb[3])
{
    float to[3], half[3];
    towards(&light->light, lit->position, to);
    picture_bring_near(to);
    const float length = sqrtf(picture_square(to));
    const float facing = dot(to, lit->normal) / length;
    for (int a = 0; a < 3; a++)
        half[a] = to[a] / length + lit->eye[a];
    float highlight = 0.0f;
    if (lit->gloss > 0.0f) {
        const float size = sqrtf(dot(half, half)), along = dot(half, lit->normal);
        highlight = size > 0.0f && along > 0.0f ? powf(along / size, lit->gloss) : 0.0f;
    }
    for (int c = 0; c < 3; c++)
        rgb[c] += share * light->color[c] * (lit->matte[c] * facing + lit->shine[c] * highlight);
}

cgt_result cgt_whitted_light_up(const whitted *w, whitted_memory *m, uint32_t count, float (*light)[3])
{
    cgt_result result = CGT_OK;
    for (uint32_t l = 0; l < w->lights && count > 0 && result == CGT_OK; l++) {
        const cgt_light *at = &w->light[l].light;
        const uint32_t on = set_ranges(m, at, count);
        if (on == 0)
            continue;
        WHITTED_COUNT(w, shadow_rays, on);
        result = occlude(w, m, at, w->shadow_mask, count, m->occluded);
        if (result == CGT_OK)
            result = find_contacts(w, m, at, count);
        if (result == CGT_OK && w->glass_mask)
            result = occlude(w, m, at, w->glass_mask, count, m->dimmed);
        for (uint32_t i = 0; result == CGT_OK && i < count; i++)
            if (m->lit[i].t_max >= 0.0f && !m->occluded[i])
                add_light(&w->light[l], &m->lit[i], w->glass_mask && m->dimmed[i] ? w->glass_shadow : 1.0f,
                          light[m->lit[i].pixel]);
    }
    return result;
}

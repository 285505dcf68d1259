/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays through a scene, and their troubles. */
#include "support/cliffs/cliffs.h"

#include <math.h>
#include <string.h>

static truth_ray make_ray(const cliff_scene *s, test_random *r, uint32_t i)
{
    truth_ray ray = {.t_max = INFINITY};
    random_direction(r, ray.dir);
    if (i % 2 == 0) {
        for (int a = 0; a < 3; a++)
            ray.org[a] = s->middle[a] + s->reach * random_float(r, -1, 1);
        return ray;
    }
    float target[3];
    cliff_middle(s, random_below(r, s->count), target);
    for (int a = 0; a < 3; a++) {
        ray.org[a] = s->middle[a] - 2 * s->reach * ray.dir[a];
        ray.dir[a] = target[a] - ray.org[a] + s->size * random_float(r, -1, 1);
    }
    return ray;
}

void cliff_make_rays(const cliff_scene *scene, const cliff *c, bool disturbed, truth_ray *rays, uint32_t count)
{
    test_random base = cliff_random(CLIFF_STREAM_RAYS), trouble = cliff_random(CLIFF_STREAM_BENT);
    for (uint32_t i = 0; i < count; i++) {
        rays[i] = make_ray(scene, &base, i);
        if (disturbed && c->bend)
            c->bend(scene, &trouble, c->bend_amount, i, &rays[i]);
    }
}

/* ---- troubles ---- */

/* A direction of this length, or near it. */
void cliff_bend_length(const cliff_scene *s, test_random *r, float amount, uint32_t i, truth_ray *ray)
{
    (void)s;
    (void)r;
    (void)i;
    for (int a = 0; a < 3; a++)
        ray->dir[a] *= amount;
}

/* From so far away: half along an axis, which meets the scene; half towards it as well as floats can tell. */
void cliff_bend_far(const cliff_scene *s, test_random *r, float amount, uint32_t i, truth_ray *ray)
{
    const int axis = (int)random_below(r, 3);
    const float sign = random_below(r, 2) ? 1 : -1;
    float away[3];
    random_direction(r, away);
    for (int a = 0; a < 3; a++) {
        const float near = s->middle[a] + s->reach * random_float(r, -1, 1);
        if (i % 2) {
            ray->org[a] = near + amount * away[a];
            ray->dir[a] = -away[a];
        } else {
            ray->org[a] = a == axis ? near + sign * amount : near;
            ray->dir[a] = a == axis ? -sign : 0;
        }
    }
}

/* From the middle of the scene. */
void cliff_bend_inside(const cliff_scene *s, test_random *r, float amount, uint32_t i, truth_ray *ray)
{
    (void)i;
    random_direction(r, ray->dir);
    for (int a = 0; a < 3; a++)
        ray->org[a] = s->middle[a] + s->reach * amount * random_float(r, -1, 1);
}

static void along_axis(truth_ray *ray, uint32_t axis)
{
    for (uint32_t a = 0; a < 3; a++)
        ray->dir[a] = a == axis / 2 ? axis % 2 ? -1.0f : 1.0f : axis % 2 ? -0.0f : 0.0f;
}

void cliff_bend_axis(const cliff_scene *s, test_random *r, float amount, uint32_t i, truth_ray *ray)
{
    (void)amount;
    (void)i;
    for (int a = 0; a < 3; a++)
        ray->org[a] = s->middle[a] + s->reach * random_float(r, -1, 1);
    along_axis(ray, random_below(r, 6));
}

/* Rays that hit nothing: invalid, or off. */
void cliff_bend_dead(const cliff_scene *s, test_random *r, float amount, uint32_t i, truth_ray *ray)
{
    (void)s;
    (void)amount;
    const int a = (int)random_below(r, 3);
    switch (i % 6) {
    case 0: ray->org[a] = NAN; break;
    case 1: ray->dir[a] = NAN; break;
    case 2: ray->dir[a] = INFINITY; break;
    case 3: ray->t_max = NAN; break;
    case 4: ray->t_max = -1; break;
    default: memset(ray->dir, 0, sizeof ray->dir); break;
    }
}

/* A range of one value. */
void cliff_bend_moment(const cliff_scene *s, test_random *r, float amount, uint32_t i, truth_ray *ray)
{
    (void)s;
    (void)r;
    (void)i;
    ray->t_min = ray->t_max = amount;
}

void cliff_bend_short(const cliff_scene *s, test_random *r, float amount, uint32_t i, truth_ray *ray)
{
    (void)s;
    (void)r;
    (void)i;
    ray->t_max = amount;
}

/* All the same ray. */
void cliff_bend_same(const cliff_scene *s, test_random *r, float amount, uint32_t i, truth_ray *ray)
{
    static const float dir[3] = {0.1f, -0.2f, 1};
    (void)r;
    (void)i;
    for (int a = 0; a < 3; a++) {
        ray->org[a] = s->middle[a] - amount * s->reach * dir[a];
        ray->dir[a] = dir[a];
    }
}

/* Hits behind the origin count. */
void cliff_bend_behind(const cliff_scene *s, test_random *r, float amount, uint32_t i, truth_ray *ray)
{
    (void)s;
    (void)r;
    (void)i;
    ray->t_min = -amount;
}

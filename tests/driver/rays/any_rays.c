/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays that are hard on a scene: a table of origins and one of directions, and what may change about a ray then. */
#include <math.h>
#include <string.h>

#include "driver/rays/lines.h"
#include "oracle/hard_rays.h"

float line_gauss(test_random *r)
{
    float sum = 0;
    for (int k = 0; k < 4; k++)
        sum += random_float(r, -1, 1);
    return sum;
}

/* ---- places ---- */

static void place_at_triangle(test_random *r, const float v[9], float p[3])
{
    const uint32_t how = random_below(r, 4), from = random_below(r, 3), to = random_below(r, 3);
    const float share = how == 1 ? 0.5f : how == 2 ? random_float(r, 0, 1) : 0;
    for (int a = 0; a < 3; a++)
        p[a] =
            how == 3 ? (v[a] + v[3 + a] + v[6 + a]) / 3 : v[3 * from + a] + share * (v[3 * to + a] - v[3 * from + a]);
}

/* Of a sphere, both ends are its centre. */
static void place_at_axis(test_random *r, const float p[3], const float q[3], float radius, float at[3])
{
    const uint32_t how = random_below(r, 4);
    const float share = how == 0 ? 0 : how == 1 ? 1 : how == 2 ? 0.5f : random_float(r, 0, 1);
    float out[3];
    random_direction(r, out);
    for (int a = 0; a < 3; a++)
        at[a] = share < 1 ? p[a] + share * (q[a] - p[a]) : q[a];
    switch (random_below(r, 3)) {
    case 0: at[random_below(r, 3)] += random_below(r, 2) ? radius : -radius; break;
    case 1:
        for (int a = 0; a < 3; a++)
            at[a] += radius * out[a];
        break;
    default: break;
    }
}

void line_place(judge_scene *s, float p[3])
{
    test_random *r = &s->random;
    const oracle_primitive *const at = s->count ? &s->primitive[random_below(r, s->count)] : NULL;
    if (!at || judge_is_broken(at)) {
        for (int a = 0; a < 3; a++)
            p[a] = s->scale * line_gauss(r);
        return;
    }
    switch (at->kind) {
    case ORACLE_SPHERE: place_at_axis(r, at->data, at->data, at->data[3], p); break;
    case ORACLE_CAPSULE: place_at_axis(r, at->data, at->data + 3, at->data[6], p); break;
    case ORACLE_TRIANGLE: place_at_triangle(r, at->data, p); break;
    }
}

void line_place_beside(judge_scene *s, const float at[3], float p[3])
{
    float other[3], out[3], far = 0;
    line_place(s, other);
    random_direction(&s->random, out);
    for (int a = 0; a < 3; a++)
        far = fmaxf(far, fabsf(at[a] - other[a]));
    for (int a = 0; a < 3; a++)
        p[a] = at[a] + 2 * far * out[a];
}

static void place_beside(judge_scene *s, float p[3])
{
    float at[3];
    line_place(s, at);
    line_place_beside(s, at, p);
}

static void place_around(judge_scene *s, float p[3])
{
    for (int a = 0; a < 3; a++)
        p[a] = 2 * s->scale * line_gauss(&s->random);
}

static void place_on_lattice(judge_scene *s, float p[3])
{
    const float step = random_below(&s->random, 2) ? 0.5f : 1;
    for (int a = 0; a < 3; a++)
        p[a] = step * ((float)random_below(&s->random, 9) - 2);
}

static void place_far(judge_scene *s, float p[3])
{
    const float far = s->scale * exp2f(random_float(&s->random, 0, 25));
    for (int a = 0; a < 3; a++)
        p[a] = far * line_gauss(&s->random);
}

/* ---- directions, from an origin ---- */

static void to_place(judge_scene *s, truth_ray *ray)
{
    float p[3];
    line_place(s, p);
    for (int a = 0; a < 3; a++)
        ray->dir[a] = p[a] - ray->org[a];
}

static void along_axis(judge_scene *s, truth_ray *ray)
{
    for (int a = 0; a < 3; a++)
        ray->dir[a] = random_below(&s->random, 2) ? 0.f : -0.f;
    for (uint32_t k = 0; k < 1 + (random_below(&s->random, 3) == 0); k++)
        ray->dir[random_below(&s->random, 3)] = random_below(&s->random, 2) ? 1 : -1;
}

static void along_lattice(judge_scene *s, truth_ray *ray)
{
    for (int a = 0; a < 3; a++)
        ray->dir[a] = (float)random_below(&s->random, 5) - 2;
}

static void anywhere(judge_scene *s, truth_ray *ray) { random_direction(&s->random, ray->dir); }

/* From outside, along an axis through a place: a tangent, or in a plane, of what is aligned. */
static void aligned(judge_scene *s, truth_ray *ray)
{
    float p[3];
    line_place(s, p);
    hard_ray_align(&s->random, p, ray);
}

typedef void place_maker(judge_scene *s, float p[3]);
typedef void direction_maker(judge_scene *s, truth_ray *ray);
static place_maker *const origins[] = {place_around, place_beside, place_on_lattice, place_beside,
                                       line_place,   line_place,   line_place,       place_far};
static direction_maker *const directions[] = {to_place, to_place,      to_place, to_place,
                                              aligned,  along_lattice, anywhere, along_axis};

/* ---- what may change ---- */

static void change_range(test_random *r, truth_ray *ray)
{
    switch (random_below(r, 12)) {
    case 0: ray->t_min = -INFINITY; break;
    case 1: ray->t_min = -expf(line_gauss(r)); break;
    case 2:
        ray->t_min = expf(line_gauss(r));
        ray->t_max = ray->t_min * (1 + random_float(r, 0, 1));
        break;
    case 3: ray->t_max = random_below(r, 5) ? 1 : -1; break;
    default: break;
    }
}

static void make_line(judge_scene *s, truth_ray *line)
{
    test_random *r = &s->random;
    origins[random_below(r, 8)](s, line->org);
    directions[random_below(r, 8)](s, line);
    if (random_below(r, 3) == 0)
        hard_ray_stretch(r, line);
    change_range(r, line);
    if (random_below(r, 80) == 0)
        line->org[random_below(r, 3)] = NAN;
    if (random_below(r, 80) == 0)
        line->dir[random_below(r, 3)] = INFINITY;
}

void garbage_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    test_random *const r = &s->random;
    for (uint32_t i = 0; i < count; i++) {
        truth_ray *const line = &ray[i].line;
        make_line(s, line);
        for (int a = 0; a < 3 && i % 3; a++) {
            line->org[a] = random_below(r, 2) ? random_any_float(r) : line->org[a];
            line->dir[a] = random_below(r, 2) ? random_any_float(r) : line->dir[a];
        }
        line->t_min = i % 3 && random_below(r, 4) == 0 ? random_any_float(r) : line->t_min;
        line->t_max = i % 3 && random_below(r, 4) == 0 ? random_any_float(r) : line->t_max;
    }
}

void any_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        make_line(s, &ray[i].line);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays that single precision does not cover: they are moved to the scene in double. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "driver/rays/lines.h"

typedef enum line_family {
    LINE_LENGTH,   /* ordinary but for the length of the direction */
    LINE_PARALLEL, /* along an axis, from anywhere */
    LINE_EXACT,    /* from afar, through a place exactly */
    LINE_AIMED,    /* from afar, as near to a place as floats allow */
    LINE_AWAY,     /* from afar, turned away or anywhere */
    LINE_INSIDE,   /* from within the scene */
    LINE_FAMILIES
} line_family;

static float power(test_random *r, int low, int high)
{
    return ldexpf(1, low + (int)random_below(r, (uint32_t)(high - low + 1)));
}

/* A direction of few bits, so that multiples of it are exact. */
static void short_direction(test_random *r, float d[3])
{
    do
        for (int a = 0; a < 3; a++)
            d[a] = (float)random_below(r, 65) - 32;
    while (d[0] == 0 && d[1] == 0 && d[2] == 0);
}

static void choose_direction(test_random *r, line_family f, float d[3])
{
    if (f == LINE_EXACT)
        short_direction(r, d);
    else
        random_direction(r, d);
    if (f == LINE_PARALLEL)
        for (uint32_t a = 0, along = random_below(r, 3); a < 3; a++)
            d[a] = a == along ? 1 : 0;
}

static void make_line(judge_scene *s, line_family f, truth_ray *line)
{
    test_random *r = &s->random;
    float place[3], d[3];
    const float far = power(r, 4, 121), sign = f == LINE_AWAY && random_below(r, 2) ? -1 : 1;
    line_place(s, place);
    choose_direction(r, f, d);
    for (int a = 0; a < 3; a++) {
        const float at = fabsf(place[a]) < 0x1p50f ? place[a] : 0, side = random_float(r, -2, 2);
        line->dir[a] = sign * d[a];
        line->org[a] = at;
        if (f == LINE_LENGTH)
            line->org[a] -= 4 * d[a] * s->scale;
        else if (f != LINE_INSIDE)
            line->org[a] -= d[a] * far - (f == LINE_AWAY ? side * far : 0);
    }
}

/* Lengths from the least float to the largest. */
static void scale_direction(test_random *r, float dir[3])
{
    const float longest = fmaxf(fabsf(dir[0]), fmaxf(fabsf(dir[1]), fabsf(dir[2])));
    const int room = 127 - ilogbf(longest);
    const float scale = power(r, random_below(r, 4) ? -126 : -140, room < 127 ? room : 127);
    float scaled[3];
    for (int a = 0; a < 3; a++)
        scaled[a] = dir[a] * scale;
    if (scaled[0] != 0 || scaled[1] != 0 || scaled[2] != 0)
        memcpy(dir, scaled, sizeof scaled);
}

void unusual_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const line_family f = (line_family)(i % LINE_FAMILIES);
        make_line(s, f, &ray[i].line);
        if (f == LINE_LENGTH || random_below(&s->random, 2))
            scale_direction(&s->random, ray[i].line.dir);
        if (random_below(&s->random, 4) == 0)
            ray[i].line.t_min = -INFINITY;
    }
}

void slow_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    const int scale = ilogbf(s->scale), slow = scale - 126 - (int)random_below(&s->random, 15),
              least = slow > -140 ? slow : -140;
    float place[3];
    line_place(s, place);
    for (uint32_t i = 0; i < count; i++) {
        if (i % 2) /* the near side of what it is in lies below the range of float */
            ray[i].line.t_min = -INFINITY;
        for (int a = 0; a < 3; a++) {
            ray[i].line.org[a] = place[a];
            ray[i].line.dir[a] = ldexpf(random_float(&s->random, -1, 1), least);
        }
    }
}

/* ---- between primitives of any magnitudes ---- */

static float clamp(double v) { return (float)fmax(fmin(v, (double)FLT_MAX), -(double)FLT_MAX); }

/* A size between powers of two, not only powers. */
static float size_between(test_random *r, int least, int most)
{
    return power(r, least, most) * (random_below(r, 2) ? 1 : random_float(r, 0.5f, 1));
}

/* In a distance that is like a primitive's own from the origin. */
static void near_place(judge_scene *s, float away, float p[3])
{
    float size = 0;
    line_place(s, p);
    for (int a = 0; a < 3; a++)
        size = fmaxf(size, fabsf(p[a]));
    for (int a = 0; a < 3; a++)
        p[a] = clamp((double)p[a] + (double)size * (double)random_float(&s->random, -away, away));
}

/* To a place, with a length that is the distance, 1 or any. */
static void aim(judge_scene *s, truth_ray *line)
{
    test_random *r = &s->random;
    float to[3];
    double way[3], largest = 1e-300;
    near_place(s, random_below(r, 2) ? 0.1f : 1, to);
    for (int a = 0; a < 3; a++) {
        way[a] = (double)to[a] - (double)line->org[a];
        largest = fmax(largest, fabs(way[a]));
    }
    const double length = random_below(r, 3)   ? 1
                          : random_below(r, 2) ? ldexp(1, (int)random_below(r, 240) - 130) / largest
                                               : 1 / largest;
    for (int a = 0; a < 3; a++)
        line->dir[a] = clamp(way[a] * length);
    if (line->dir[0] == 0 && line->dir[1] == 0 && line->dir[2] == 0)
        line->dir[random_below(r, 3)] = size_between(r, -149, 120);
}

void band_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    test_random *r = &s->random;
    for (uint32_t i = 0; i < count; i++) {
        truth_ray *const line = &ray[i].line;
        near_place(s, random_below(r, 3) ? 2 : 0, line->org);
        aim(s, line);
        if (random_below(r, 4) == 0)
            line->t_min = random_below(r, 2) ? size_between(r, -149, 20) : -size_between(r, -149, 60);
        if (random_below(r, 4) == 0)
            line->t_max = random_below(r, 4) ? size_between(r, -40, 127) : 0;
    }
}

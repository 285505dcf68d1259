/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays that are hard for boxes: in streams, near their faces, in their planes, to an end among them. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "driver/rays/lines.h"
#include "support/scenes.h"

/* ---- what they have in common ---- */

static truth_ray through_scene(judge_scene *s)
{
    cloud where = {.reach = s->scale};
    memcpy(where.middle, s->middle, sizeof where.middle);
    return ray_random(&s->random, &where);
}

static void aim(judge_scene *s, truth_ray *line)
{
    float place[3];
    line_place(s, place);
    for (int a = 0; a < 3; a++)
        line->dir[a] = place[a] - line->org[a];
}

static void from_anywhere(judge_scene *s, float org[3])
{
    for (int a = 0; a < 3; a++)
        org[a] = s->middle[a] + s->scale * random_float(&s->random, -1, 1);
}

void through_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        ray[i].line = through_scene(s);
}

/* ---- slabs and ranges ---- */

/* At a surface or a corner, with components that are nearly zero. */
static void nearly_along_axis(judge_scene *s, uint32_t axis, truth_ray *line)
{
    static const float none[] = {0, -0.f, 0x1p-149f, -0x1p-140f, 0x1p-60f, -0x1p-41f, 0x1p-39f};
    line_place(s, line->org);
    for (uint32_t a = 0; a < 3; a++)
        line->dir[a] = a == axis ? 1 : none[random_below(&s->random, TEST_COUNT(none))];
    line->org[axis] -= random_float(&s->random, -3, 3) * s->scale;
}

static void from_far_away(judge_scene *s, truth_ray *line)
{
    test_random *r = &s->random;
    for (int a = 0; a < 3; a++)
        line->org[a] = s->middle[a] + s->scale * random_log(r, 10, 1e9f) * random_float(r, -1, 1);
    aim(s, line);
}

/* So far behind the origin that a normalised end is -infinity. */
static void end_far_behind(test_random *r, truth_ray *line)
{
    for (int a = 0; a < 3; a++)
        line->dir[a] *= 16;
    line->t_min = -INFINITY;
    line->t_max = -FLT_MAX * random_float(r, 0.1f, 1);
}

static truth_ray slab_line(judge_scene *s)
{
    test_random *r = &s->random;
    truth_ray line = through_scene(s);
    const uint32_t axis = random_below(r, 3);
    switch (random_below(r, 10)) {
    case 0: nearly_along_axis(s, axis, &line); break;
    case 1: from_far_away(s, &line); break;
    case 2: line_place(s, line.org); break;
    case 3: /* of any length */
        for (int a = 0; a < 3; a++)
            line.dir[a] *= ldexpf(1, (int)random_below(r, 100) - 50);
        break;
    case 4: /* hits behind the origin count */
        line.t_min = random_below(r, 2) ? -INFINITY : -random_log(r, 1e-3f, 1e3f);
        break;
    case 5: /* invalid, or without a range */
        line.t_max = random_below(r, 2) ? NAN : line.t_min - 1;
        line.dir[axis] = random_below(r, 2) ? NAN : line.dir[axis];
        break;
    case 6: /* ends at infinity */
        line.t_min = random_below(r, 2) ? INFINITY : -INFINITY;
        line.t_max = random_below(r, 2) ? INFINITY : -INFINITY;
        break;
    case 7: line.dir[axis] *= 0x1p70f; break; /* beyond single precision */
    case 8: end_far_behind(r, &line); break;
    default: aim(s, &line); break;
    }
    return line;
}

void slab_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        ray[i].line = i % 2 ? slab_line(s) : through_scene(s);
        if (i % 3 == 0)
            aim(s, &ray[i].line);
    }
}

/* ---- lattices ---- */

/* From a point in sixteenths of the scene's size, along an axis or a diagonal. */
static truth_ray lattice_line(judge_scene *s)
{
    test_random *r = &s->random;
    truth_ray line = {.t_max = INFINITY};
    for (int a = 0; a < 3; a++) {
        line.org[a] = s->middle[a] + s->scale / 16 * (float)((int)random_below(r, 49) - 24);
        line.dir[a] = (float)((int)random_below(r, 3) - 1);
    }
    if (line.dir[0] == 0 && line.dir[1] == 0 && line.dir[2] == 0)
        line.dir[random_below(r, 3)] = random_below(r, 2) ? 1 : -1;
    return line;
}

void lattice_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        ray[i].line = i % 3 == 2 ? lattice_line(s) : through_scene(s);
        if (i / 16 % 3 == 1) /* from one point in all directions */
            memcpy(ray[i].line.org, ray[i - i % 16 - 1].line.org, sizeof ray[i].line.org);
    }
}

/* ---- streams ---- */

/* Turns a line to the silhouette of a sphere, but for roundings. */
static void graze(judge_scene *s, truth_ray *line)
{
    const oracle_primitive *const at = s->count ? &s->primitive[random_below(&s->random, s->count)] : NULL;
    float out[3];
    double way[3], square = 0, along = 0, aside = 0;
    if (!at || at->kind != ORACLE_SPHERE || judge_is_broken(at))
        return;
    const double radius = (double)at->data[3];
    random_direction(&s->random, out);
    for (int a = 0; a < 3; a++) {
        way[a] = (double)at->data[a] - (double)line->org[a];
        square += way[a] * way[a];
        along += way[a] * (double)out[a];
    }
    const double rest = square - radius * radius;
    if (!(rest > 0))
        return;
    for (int a = 0; a < 3; a++) {
        const double across = (double)out[a] - way[a] * along / square;
        aside += across * across;
    }
    for (int a = 0; a < 3; a++)
        line->dir[a] = (float)(way[a] * rest / square +
                               ((double)out[a] - way[a] * along / square) * radius * sqrt(rest / square / aside));
}

/* In any octant; or all equal, to a pole of a sphere, where box and sphere end. */
void neighbour_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    static const float spreads[] = {0, 0x1p-24f, 1e-5f, 1e-3f, 0.1f};
    test_random *r = &s->random;
    const float spread = spreads[random_below(r, TEST_COUNT(spreads))] * s->scale, side = random_below(r, 2) ? 1 : -1;
    const uint32_t axis = random_below(r, 3);
    const bool along = random_below(r, 3) == 0, behind = random_below(r, 4) == 0, ends = random_below(r, 3);
    float from[3];
    line_place(s, from);
    from[axis] += along ? 0.5f * side * s->scale : 0;
    for (uint32_t i = 0; i < count; i++) {
        truth_ray *const line = &ray[i].line;
        *line = through_scene(s);
        line->t_min = behind && i % 64 == 5 ? -random_log(r, 1e-6f, 1) : 0;
        line->t_max = ends && !along ? random_float(r, 0, 0.3f) * s->scale : INFINITY;
        for (uint32_t a = 0; a < 3; a++)
            line->org[a] = from[a] + spread * (i % 8 && !along ? random_float(r, -1, 1) : 0);
        if (i % 4 == 1)
            aim(s, line);
        if (i % 4 == 2)
            line->dir[random_below(r, 3)] = random_below(r, 2) ? 0 : -0.f;
        if (i % 4 == 3)
            graze(s, line);
        for (uint32_t a = 0; a < 3 && along; a++)
            line->dir[a] = a == axis ? -side : 0;
    }
}

/* Single precision decides most of them, since they are moved to their end. */
void lamp_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    float lamp[3];
    line_place(s, lamp);
    for (uint32_t i = 0; i < count; i++) {
        truth_ray *const line = &ray[i].line;
        from_anywhere(s, line->org);
        line->t_max = 1;
        for (int a = 0; a < 3; a++)
            line->dir[a] = lamp[a] - line->org[a];
    }
}

/* ---- planes and points ---- */

/* Rays in the plane across an axis, some through a place and along another axis or above it. Those that vanish
 * begin on a primitive and move along the axis, too, by so little that a normalised direction does not. */
void plane_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    test_random *r = &s->random;
    const uint32_t axis = s->axis < 3 ? s->axis : random_below(r, 3);
    const bool vanish = random_below(r, 2);
    for (uint32_t i = 0; i < count; i++) {
        truth_ray *const line = &ray[i].line;
        const uint32_t other = (axis + 1 + random_below(r, 2)) % 3;
        *line = through_scene(s);
        line->t_max = INFINITY;
        if (i % 4 == 1 || (vanish && i % 4 == 2))
            line_place(s, line->org);
        for (uint32_t a = 0; a < 3 && i % 4 == 1; a++) {
            line->dir[a] = a == other;
            line->org[a] -= 2 * s->scale * line->dir[a];
        }
        if (i % 8)
            line->org[axis] = 0;
        if (i % 16 != 7)
            line->dir[axis] = i % 2 ? 0 : -0.f;
        if (vanish && i % 4 == 2) {
            line->dir[axis] = 0x1p-149f;
            line->dir[other] = 4;
        }
    }
}

/* All of one octant, so that origins may lie on one side, or of any. */
void speck_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    test_random *r = &s->random;
    const uint32_t side = random_below(r, 3);
    for (uint32_t i = 0; i < count && s->count; i++) {
        const float *at = s->primitive[random_below(r, s->count)].data;
        const float steps = (float)((side ? 6 : 1) + random_below(r, side ? 6 : 12));
        for (int a = 0; a < 3; a++) {
            ray[i].line.dir[a] = side ? (float)(32 + random_below(r, 32)) / (side == 1 ? 64 : -64)
                                      : ((float)random_below(r, 127) - 63) / 64;
            ray[i].line.org[a] = at[a] - steps * ray[i].line.dir[a];
        }
    }
}

/* ---- long lists ---- */

/* Along the axis of a scene in whole units, exactly, most of them from end to end; some through a place, or its
 * middle. */
void long_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    test_random *r = &s->random;
    const uint32_t axis = s->axis < 3 ? s->axis : random_below(r, 3);
    for (uint32_t i = 0; i < count; i++) {
        truth_ray *const line = &ray[i].line;
        const float turned = i % 4 ? 0 : s->scale;
        memset(line->org, 0, sizeof line->org);
        memset(line->dir, 0, sizeof line->dir);
        line->org[axis] = -300 * s->scale;
        line->org[(axis + 1) % 3] = i % 3 ? s->scale * (float)random_below(r, 90) : turned;
        line->dir[axis] = i % 2 ? 2 : 300 * s->scale;
        line->t_min = i % 2 ? -INFINITY : 0;
        if (i % 3 == 0 && turned > 0)
            line->dir[(axis + 1) % 3] = -turned * line->dir[axis] / (300 * s->scale);
        if (i % 5 == 4)
            aim(s, line);
    }
}

/* ---- edges ---- */

/* A vertex, the middle of an edge, or a point of it rounded to float. */
static void edge_point(judge_scene *s, float p[3])
{
    test_random *r = &s->random;
    const float *const v = s->primitive[random_below(r, s->count)].data;
    const uint32_t from = random_below(r, 3), to = (from + 1) % 3, how = random_below(r, 4);
    const double share = how == 0 ? 0 : how == 1 ? 0.5 : (double)random_float(r, 0, 1);
    for (int a = 0; a < 3; a++)
        p[a] = (float)((double)v[3 * from + a] + share * ((double)v[3 * to + a] - (double)v[3 * from + a]));
}

void edge_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    test_random *r = &s->random;
    float eye[3] = {0}, point[3];
    for (uint32_t i = 0; i < count && s->count; i++) {
        truth_ray *const line = &ray[i].line;
        const float beyond = i / 32 % 2 ? 0 : random_float(r, 1.5f, 4);
        for (int a = 0; a < 3 && i % 32 == 0; a++)
            eye[a] = s->middle[a] + 0.3f * s->scale * random_float(r, -1, 1);
        edge_point(s, point);
        for (int a = 0; a < 3; a++) {
            line->org[a] = eye[a] + beyond * (point[a] - eye[a]);
            line->dir[a] = beyond > 0 ? eye[a] - line->org[a] : point[a] - eye[a];
        }
    }
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays through the seams of capsules, along their axes, along their silhouettes and from inside. */
#include <math.h>
#include <string.h>

#include "driver/rays/lines.h"
#include "oracle/hard_rays.h"

/* A direction across a capsule's axis, nearly, or any; its length is not 1. False: it is none. */
static bool across_axis(test_random *r, const float *c, float out[3])
{
    double length = 0, dot = 0, size = 0;
    random_direction(r, out);
    if (random_below(r, 2)) { /* exact where the axis is along a coordinate */
        const uint32_t k = random_below(r, 3);
        memset(out, 0, 3 * sizeof *out);
        out[k] = random_below(r, 2) ? 1 : -1;
    }
    for (int a = 0; a < 3; a++) {
        const double axis = (double)c[3 + a] - (double)c[a];
        length += axis * axis;
        dot += axis * (double)out[a];
    }
    const bool across = random_below(r, 4) && length > 0;
    for (int a = 0; a < 3; a++) {
        if (across)
            out[a] -= (float)(dot / length * ((double)c[3 + a] - (double)c[a]));
        size += (double)out[a] * (double)out[a];
    }
    for (int a = 0; a < 3 && size > 0; a++)
        out[a] /= (float)sqrt(size);
    return size > 0;
}

/* A point of a capsule's axis, of its silhouette, its seam, its tip. Returns the capsule; NULL: there is none. */
static const float *target(judge_scene *s, float p[3])
{
    test_random *r = &s->random;
    const uint32_t from = s->count ? random_below(r, s->count) : 0;
    const oracle_primitive *at = NULL;
    float out[3];
    for (uint32_t k = 0; k < s->count && !at; k++)
        if (s->primitive[(from + k) % s->count].kind == ORACLE_CAPSULE)
            at = &s->primitive[(from + k) % s->count];
    if (!at)
        return NULL;
    const float *const c = at->data, u = 0.25f * (float)random_below(r, 5);
    const float inside = random_below(r, 2) ? 1 - ldexpf(0.5f, -(int)random_below(r, 24)) : 1; /* all but a tangent */
    const float reach = across_axis(r, c, out) && random_below(r, 3) ? inside * c[6] : 0;
    for (int a = 0; a < 3; a++)
        p[a] = c[a] + u * (c[3 + a] - c[a]) + reach * out[a];
    return c;
}

static void make_line(judge_scene *s, truth_ray *line)
{
    test_random *r = &s->random;
    float at[3] = {0}, away[3];
    const float *const c = target(s, at);
    const uint32_t how = random_below(r, 10);
    if (!c)
        return;
    random_direction(r, away);
    if (how < 3) /* from another one: inside, or on it */
        (void)target(s, line->org);
    else
        for (int a = 0; a < 3; a++)
            line->org[a] = at[a] + (how < 5 ? 4 : 40) * (c[6] + 0.1f) * away[a];
    for (int a = 0; a < 3; a++)
        line->dir[a] = at[a] - line->org[a];
    for (int a = 0; a < 3 && how >= 8; a++) { /* along the axis, at its distance or at the radius */
        line->dir[a] = (c[3 + a] - c[a]) * (how == 8 ? 1 : -2);
        line->org[a] = at[a] - 4 * line->dir[a];
    }
    if (how == 7)
        hard_ray_align(r, at, line);
    if (how == 7 && random_below(r, 2)) { /* from so far that t is right, and the place on a thin capsule may not be */
        const float distance = ldexpf(c[6], (int)random_below(r, 40));
        for (int a = 0; a < 3; a++)
            line->org[a] = at[a] - distance * line->dir[a];
    }
    hard_ray_stretch(r, line);
}

void capsule_lines(judge_scene *s, judge_ray *ray, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        make_line(s, &ray[i].line);
}

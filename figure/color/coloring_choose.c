/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What colours show where nobody says it, and over which range, from a survey; see coloring.h. */
#include "color/coloring.h"

int cgt_coloring_has_jumps(const survey *s)
{
    int jumps = 0;
    for (int c = 0; c < 3 && s->kind == CGT_TRAJECTORY_SPHERES; c++)
        jumps |= s->drawable && s->boxless_steps[c] > 0.5f * (s->bounds_max[c] - s->bounds_min[c]);
    return jumps;
}

coloring_by cgt_coloring_choose(const survey *s)
{
    if (s->has_rgb)
        return COLORING_RGB;
    if (s->has_element)
        return COLORING_ELEMENT;
    if (s->has_type && s->type_max > s->type_min)
        return COLORING_TYPE;
    if (s->kind == CGT_TRAJECTORY_TRIANGLES)
        return COLORING_PLAIN;
    return cgt_survey_speed_quantile(s, 1.0) > 0.0f && !cgt_coloring_has_jumps(s) ? COLORING_SPEED : COLORING_ID;
}

void cgt_coloring_choose_range(const survey *s, coloring_by by, int axis, int logarithmic, const double origin[3],
                               double *min, double *max)
{
    const float fastest = cgt_survey_speed_quantile(s, 0.99);
    if (by == COLORING_SPEED) {
        const double still = s->speeds ? (double)s->speed_bins[0] / (double)s->speeds : 0.0;
        const double slow = (double)cgt_survey_speed_quantile(s, still + 0.01 * (1.0 - still));
        *max = (double)(fastest > 0.0f ? fastest : cgt_survey_speed_quantile(s, 1.0));
        *min = logarithmic ? fmin(slow, *max) : 0.0;
    } else if (by == COLORING_ID && s->id_min <= s->id_max) {
        *min = logarithmic && s->id_min == 0 && s->id_max > 0 ? 1.0 : (double)s->id_min;
        *max = (double)s->id_max;
    } else if (by == COLORING_VALUE && s->values) {
        cgt_survey_value_range(s, logarithmic, min, max);
    } else if (by == COLORING_HEIGHT && s->drawable) {
        *min = (double)s->bounds_min[axis] + origin[axis];
        *max = (double)s->bounds_max[axis] + origin[axis];
    }
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What is this? See view_ask.h. */
#include "view/view_ask.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "data/expression/expression.h"
#include "figure_state.h"

/* ---- Bonds -------------------------------------------------------------------------------------------------- */

/* How far a place is from the axis of a capsule. */
static double axis_distance(const float place[3], const float end[6])
{
    double along[3], from[3], square = 0.0, share = 0.0, distance = 0.0;
    for (int c = 0; c < 3; c++) {
        along[c] = (double)end[3 + c] - (double)end[c];
        from[c] = (double)place[c] - (double)end[c];
        square += along[c] * along[c];
        share += along[c] * from[c];
    }
    share = square > 0.0 ? fmax(0.0, fmin(1.0, share / square)) : 0.0;
    for (int c = 0; c < 3; c++)
        distance += (from[c] - share * along[c]) * (from[c] - share * along[c]);
    return sqrt(distance);
}

/* The sphere of the data that is drawn at a place; UINT32_MAX: none. */
static uint32_t sphere_at(const particles *p, const float place[3])
{
    for (uint32_t i = 0; i < p->count; i++)
        if (memcmp(p->xyzr + 4 * (size_t)i, place, 3 * sizeof *place) == 0)
            return p->source[i];
    return UINT32_MAX;
}

int view_ask_bond(const cgt_figure *figure, const cgt_figure_hit *hit, uint32_t ends[2])
{
    const frame_parts *const parts = figure->parts.frame;
    const sticks *const s = &parts->sticks;
    uint32_t nearest = UINT32_MAX;
    double least = INFINITY;
    for (uint32_t i = 0; i < parts->bonds && i < s->count; i++) {
        const double off = fabs(axis_distance(hit->place, s->end + 6 * (size_t)i) - (double)s->radius[i]);
        if (off < least) {
            least = off;
            nearest = i;
        }
    }
    /* a hit is off by the rounding of its ray's length and place, which are of the size of t at most */
    if (nearest == UINT32_MAX || least > 0.01 * (double)s->radius[nearest] + 1e-6 * (double)hit->t)
        return 0;
    for (int k = 0; k < 2; k++)
        ends[k] = sphere_at(&parts->particles, s->end + 6 * (size_t)nearest + 3 * k);
    return ends[0] != UINT32_MAX && ends[1] != UINT32_MAX;
}

/* ---- Triangles ---------------------------------------------------------------------------------------------- */

void view_ask_shares(const cgt_trajectory_frame *f, uint32_t triangle, const float place[3], double share[2])
{
    const uint32_t *const corner = f->index + 3 * (size_t)triangle;
    double a[3], b[3], p[3], aa = 0.0, ab = 0.0, bb = 0.0, pa = 0.0, pb = 0.0;
    for (int c = 0; c < 3; c++) {
        const double from = (double)f->position[3 * (size_t)corner[0] + c];
        a[c] = (double)f->position[3 * (size_t)corner[1] + c] - from;
        b[c] = (double)f->position[3 * (size_t)corner[2] + c] - from;
        p[c] = (double)place[c] - from;
        aa += a[c] * a[c];
        ab += a[c] * b[c];
        bb += b[c] * b[c];
        pa += p[c] * a[c];
        pb += p[c] * b[c];
    }
    const double area = aa * bb - ab * ab; /* above 0: it was hit */
    share[0] = area > 0.0 ? (pa * bb - pb * ab) / area : 0.0;
    share[1] = area > 0.0 ? (pb * aa - pa * ab) / area : 0.0;
}

void view_ask_place(const cgt_trajectory_frame *f, uint32_t triangle, const double share[2], float place[3])
{
    const uint32_t *const corner = f->index + 3 * (size_t)triangle;
    for (int c = 0; c < 3; c++)
        place[c] = (float)((1.0 - share[0] - share[1]) * (double)f->position[3 * (size_t)corner[0] + c] +
                           share[0] * (double)f->position[3 * (size_t)corner[1] + c] +
                           share[1] * (double)f->position[3 * (size_t)corner[2] + c]);
}

/* ---- Selections --------------------------------------------------------------------------------------------- */

int64_t view_ask_select(const cgt_figure_frame *frame, const char *formula, double center[3], char *why, size_t size)
{
    enum { BLOCK = 1024 };
    const cgt_trajectory_frame *const f = cgt_figure_frame_get_data(frame);
    double value[BLOCK];
    int64_t count = 0;
    memset(center, 0, 3 * sizeof *center);
    if (f->kind == CGT_TRAJECTORY_TRIANGLES) {
        snprintf(why, size, "selections are of spheres, and this is a file of triangles");
        return -1;
    }
    expression *const e = cgt_expression_parse(formula, why, size);
    if (!e || cgt_expression_bind(e, f, frame->speed, why, size)) {
        cgt_expression_free(e);
        return -1;
    }
    for (uint32_t first = 0; first < f->count; first += BLOCK) {
        const uint32_t part = f->count - first < BLOCK ? f->count - first : BLOCK;
        cgt_expression_values(e, first, part, value);
        for (uint32_t i = 0; i < part; i++) {
            if (!cgt_expression_holds(value[i]))
                continue;
            count++;
            for (int c = 0; c < 3; c++)
                center[c] += (double)f->xyzr[4 * ((size_t)first + i) + (size_t)c];
        }
    }
    for (int c = 0; c < 3; c++)
        center[c] /= count ? (double)count : 1.0;
    cgt_expression_free(e);
    return count;
}

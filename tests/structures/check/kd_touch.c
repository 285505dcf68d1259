/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Primitives and boxes: double where it decides, dyadic numbers elsewhere. A triangle and a box are disjoint if one of
 * 13 axes separates them: the axes of the box, the triangle's normal, and the cross products of its edges with those
 * axes. */
#include "structures/check/kd_touch.h"

#include <math.h>

#include "support/oracle/dyadic.h"

/* Each sum below has fewer than 32 roundings. */
#define SURE 0x1p-47

static dyadic difference(float a, float b)
{
    const dyadic x = dyadic_of_float(a), y = dyadic_of_float(b);
    return dyadic_sub(&x, &y);
}

static int sign_of_difference(const dyadic *a, const dyadic *b) { return dyadic_sub(a, b).sign; }

/* ---- spheres ---- */

/* The coordinate of the box nearest to the centre along an axis, or furthest from it. */
static float extreme(float center, float low, float high, bool furthest)
{
    if (furthest)
        return (double)center - low > (double)high - center ? low : high;
    return center < low ? low : center > high ? high : center;
}

/* Sign of the squared distance from the centre to the nearest or furthest point of the box, minus the squared radius.
 * Where rounding decides which end is furthest, both are equally far to within that rounding, which is far below the
 * error bound. */
static int sphere_sign(const cgt_sphere *q, const kd_box *box, bool furthest)
{
    const float center[3] = {q->x, q->y, q->z};
    float at[3];
    double distance2 = 0, r2 = (double)q->r * q->r;
    for (int a = 0; a < 3; a++) {
        at[a] = extreme(center[a], box->low[a], box->high[a], furthest);
        distance2 += ((double)at[a] - center[a]) * ((double)at[a] - center[a]);
    }
    if (fabs(distance2 - r2) > SURE * (distance2 + r2))
        return distance2 > r2 ? 1 : -1;
    dyadic d[3];
    for (int a = 0; a < 3; a++)
        d[a] = difference(at[a], center[a]);
    const dyadic r = dyadic_of_float(q->r), exact_r2 = dyadic_mul(&r, &r), exact_d2 = dyadic_dot(d, d);
    return sign_of_difference(&exact_d2, &exact_r2);
}

/* ---- triangles ---- */

/* The direction of edge k, and its cross product with axis a of the box; for doubles and for dyadic numbers. */
static const int edge_ends[3][2] = {{0, 1}, {0, 2}, {1, 2}};

/* In double, relative to vertex 0: 1 if the axis separates, -1 if it does not, 0 if undecided. size bounds the axis. */
static int axis_sure(const double axis[3], const double edge[3][3], const double low[3], const double high[3],
                     double size)
{
    double box_low = 0, box_high = 0, extent = 0, triangle_low = 0, triangle_high = 0;
    for (int a = 0; a < 3; a++) {
        box_low += fmin(axis[a] * low[a], axis[a] * high[a]);
        box_high += fmax(axis[a] * low[a], axis[a] * high[a]);
        extent += fabs(low[a]) + fabs(high[a]) + fabs(edge[0][a]) + fabs(edge[1][a]);
    }
    for (int k = 0; k < 2; k++) {
        const double at = axis[0] * edge[k][0] + axis[1] * edge[k][1] + axis[2] * edge[k][2];
        triangle_low = fmin(triangle_low, at);
        triangle_high = fmax(triangle_high, at);
    }
    const double gap = fmax(box_low - triangle_high, triangle_low - box_high);
    return fabs(gap) <= SURE * size * extent ? 0 : gap > 0 ? 1 : -1;
}

static void order(const dyadic *a, const dyadic *b, dyadic *low, dyadic *high)
{
    const bool swapped = sign_of_difference(a, b) > 0;
    const dyadic x = swapped ? *b : *a, y = swapped ? *a : *b;
    *low = x;
    *high = y;
}

static bool axis_separates(const dyadic axis[3], const cgt_triangle *q, const kd_box *box)
{
    dyadic box_low = {0}, box_high = {0}, triangle_low = {0}, triangle_high = {0};
    for (int a = 0; a < 3; a++) {
        const dyadic low = dyadic_of_float(box->low[a]), high = dyadic_of_float(box->high[a]);
        dyadic x = dyadic_mul(&axis[a], &low), y = dyadic_mul(&axis[a], &high);
        order(&x, &y, &x, &y);
        box_low = dyadic_add(&box_low, &x);
        box_high = dyadic_add(&box_high, &y);
    }
    for (int k = 0; k < 3; k++) {
        dyadic vertex[3], low, unused;
        for (int a = 0; a < 3; a++)
            vertex[a] = dyadic_of_float(q->v[k][a]);
        const dyadic at = dyadic_dot(axis, vertex);
        if (k == 0)
            triangle_low = triangle_high = at;
        order(&at, &triangle_low, &low, &unused);
        triangle_low = low;
        order(&at, &triangle_high, &unused, &triangle_high);
    }
    return sign_of_difference(&triangle_low, &box_high) > 0 || sign_of_difference(&box_low, &triangle_high) > 0;
}

/* The exact axis: the normal for k = 3, else the cross product of edge k and axis a of the box. */
static void exact_axis(const cgt_triangle *q, int k, int a, dyadic axis[3])
{
    dyadic edge[3][3];
    for (int e = 0; e < 3; e++)
        for (int i = 0; i < 3; i++)
            edge[e][i] = difference(q->v[edge_ends[e][1]][i], q->v[edge_ends[e][0]][i]);
    if (k == 3) {
        dyadic_cross(edge[0], edge[1], axis);
        return;
    }
    axis[a] = (dyadic){0};
    axis[(a + 1) % 3] = edge[k][(a + 2) % 3];
    axis[(a + 2) % 3] = dyadic_signed(&edge[k][(a + 1) % 3], -1);
}

static bool apart(const cgt_triangle *q, const kd_box *box, const double edge[3][3], int k, int a)
{
    double axis[3] = {0, 0, 0}, low[3], high[3], length[3] = {0, 0, 0};
    const double *e = edge[0], *f = edge[1];
    for (int i = 0; i < 3; i++) {
        low[i] = (double)box->low[i] - q->v[0][i];
        high[i] = (double)box->high[i] - q->v[0][i];
        if (k == 3)
            axis[i] = e[(i + 1) % 3] * f[(i + 2) % 3] - e[(i + 2) % 3] * f[(i + 1) % 3];
        for (int j = 0; j < 3; j++)
            length[j] += fabs(edge[j][i]);
    }
    if (k < 3) {
        axis[(a + 1) % 3] = edge[k][(a + 2) % 3];
        axis[(a + 2) % 3] = -edge[k][(a + 1) % 3];
    }
    const int sure = axis_sure(axis, edge, low, high, k == 3 ? length[0] * length[1] : length[k]);
    if (sure)
        return sure > 0;
    dyadic exact[3];
    exact_axis(q, k, a, exact);
    return axis_separates(exact, q, box);
}

static bool triangle_touches(const cgt_triangle *q, const kd_box *box)
{
    double edge[3][3];
    for (int a = 0; a < 3; a++) {
        if (fmaxf(fmaxf(q->v[0][a], q->v[1][a]), q->v[2][a]) < box->low[a] ||
            fminf(fminf(q->v[0][a], q->v[1][a]), q->v[2][a]) > box->high[a])
            return false;
        for (int k = 0; k < 3; k++)
            edge[k][a] = (double)q->v[edge_ends[k][1]][a] - q->v[edge_ends[k][0]][a];
    }
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            if (apart(q, box, (const double(*)[3])edge, k, a))
                return false;
    return !apart(q, box, (const double(*)[3])edge, 3, 0);
}

bool kd_touches(const cgt_primitive *primitive, const kd_box *box)
{
    if (primitive->kind == CGT_KIND_TRIANGLES)
        return triangle_touches(&primitive->triangle, box);
    return sphere_sign(&primitive->sphere, box, false) <= 0 && sphere_sign(&primitive->sphere, box, true) >= 0;
}

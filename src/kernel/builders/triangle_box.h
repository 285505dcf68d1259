/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whether a triangle touches a box, by separating axes (Akenine-Moller, "Fast 3D Triangle-Box Overlap Testing", 2001):
 * the plane's normal and the nine cross products of edges and coordinate axes; the tested boxes lie in the bounds
 * already. All boxes of a grid have one size, so the reach of a box along each axis is computed once. Conservative:
 * false only where exact arithmetic gives false. */
#ifndef CGT_TRIANGLE_BOX_H
#define CGT_TRIANGLE_BOX_H

#include <math.h>
#include <stdbool.h>

#define CGT_TRIANGLE_BOX_AXES 10

typedef struct cgt_triangle_box {
    double origin[3]; /* vertex 0: all is seen from there */
    double axis[CGT_TRIANGLE_BOX_AXES][3];
    double low[CGT_TRIANGLE_BOX_AXES], high[CGT_TRIANGLE_BOX_AXES]; /* of the centres of boxes that touch */
} cgt_triangle_box;

/* Along an axis the triangle covers the span of its vertices, and a box of half edges `half` reaches `reach` around its
 * centre. The axis errs by 2^-51 of `magnitude` in each component, which bounds the error where the box is at most
 * `extent` away. */
static inline void cgt_triangle_box_axis(cgt_triangle_box *t, int i, const double axis[3], const double edge[2][3],
                                         const double half[3], double magnitude)
{
    double low = 0, high = 0, reach = 0, extent = 0;
    for (int a = 0; a < 3; a++) {
        t->axis[i][a] = axis[a];
        reach += fabs(axis[a]) * half[a];
        extent += fabs(edge[0][a]) + fabs(edge[1][a]) + 2 * half[a];
    }
    for (int k = 0; k < 2; k++) {
        const double projection = axis[0] * edge[k][0] + axis[1] * edge[k][1] + axis[2] * edge[k][2];
        low = fmin(low, projection);
        high = fmax(high, projection);
    }
    reach += 0x1p-48 * magnitude * extent;
    t->low[i] = low - reach;
    t->high[i] = high + reach;
}

/* v: vertices; half: half edges of the boxes, all of them finite. */
static inline void cgt_triangle_box_init(const double v[3][3], const double half[3], cgt_triangle_box *t)
{
    double edge[2][3], size[2] = {0, 0};
    int axes = 0;
    for (int a = 0; a < 3; a++) {
        t->origin[a] = v[0][a];
        for (int k = 0; k < 2; k++) {
            edge[k][a] = v[k + 1][a] - v[0][a];
            size[k] += fabs(edge[k][a]);
        }
    }
    const double *e = edge[0], *f = edge[1];
    const double normal[3] = {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
    cgt_triangle_box_axis(t, axes++, normal, (const double(*)[3])edge, half, size[0] * size[1]);
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            double axis[3] = {0, 0, 0};
            axis[b] = k == 2 ? f[c] - e[c] : edge[k][c];
            axis[c] = -(k == 2 ? f[b] - e[b] : edge[k][b]);
            cgt_triangle_box_axis(t, axes++, axis, (const double(*)[3])edge, half, size[0] + size[1]);
        }
}

static inline bool cgt_triangle_box_touches(const cgt_triangle_box *t, const double center[3])
{
    const double x = center[0] - t->origin[0], y = center[1] - t->origin[1], z = center[2] - t->origin[2];
    for (int i = 0; i < CGT_TRIANGLE_BOX_AXES; i++) {
        const double projection = t->axis[i][0] * x + t->axis[i][1] * y + t->axis[i][2] * z;
        if (projection < t->low[i] || projection > t->high[i])
            return false;
    }
    return true;
}

#endif

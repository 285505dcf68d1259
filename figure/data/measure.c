/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Distances, angles and dihedrals; see measure.h. */
#include "data/measure.h"

#include <float.h>
#include <math.h>

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static double length(const double a[3]) { return sqrt(dot(a, a)); }

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* ---- Measures ----------------------------------------------------------------------------------------------- */

static double degrees(double radians) { return radians * 57.29577951308232; }

int cgt_measure(const periodic_box *box, const float (*points)[3], uint32_t count, double *value)
{
    double step[MEASURE_MOST - 1][3], size[MEASURE_MOST - 1], normal[2][3], largest = 0.0;
    if (count < 2 || count > MEASURE_MOST)
        return 0;
    for (uint32_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) {
            if (!isfinite(points[i][c]))
                return 0;
            largest = fmax(largest, fabs((double)points[i][c]));
        }
    /* each end of a step is off by half of the last bit of its three numbers, at most largest * FLT_EPSILON / 2 each */
    const double off = largest * (double)FLT_EPSILON * sqrt(3.0);
    for (uint32_t i = 0; i + 1 < count; i++) {
        for (int c = 0; c < 3; c++)
            step[i][c] = (double)points[i + 1][c] - (double)points[i][c];
        cgt_nearest_image(box, step[i]);
        size[i] = length(step[i]);
        if (count > 2 && !(size[i] > off))
            return 0;
    }
    if (count == 2) {
        *value = size[0];
        return 1;
    }
    cross(step[0], step[1], normal[0]);
    if (count == 3) {
        *value = degrees(atan2(length(normal[0]), -dot(step[0], step[1])));
        return 1;
    }
    cross(step[1], step[2], normal[1]);
    for (int k = 0; k < 2; k++) /* the sine of the angle between two steps, beside what their ends may turn them by */
        if (!(length(normal[k]) > off * (size[k] + size[k + 1])))
            return 0;
    *value = degrees(atan2(size[1] * dot(step[0], normal[1]), dot(normal[0], normal[1])));
    return 1;
}

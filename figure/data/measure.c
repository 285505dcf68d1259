/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Distances, angles and dihedrals; see measure.h. In a tilted box the nearest image is not always that of the least
 * shares: the edges are reduced as Selling does (Conway and Sloane, Low-Dimensional Lattices VI, 1992) until no two of
 * them and their negative sum meet at less than a right angle. Then the faces of the cell of the lattice lie halfway to
 * sums of some of them, and a vector that none of these shortens is the least. */
#include "data/measure.h"

#include <float.h>
#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static double length(const double a[3]) { return sqrt(dot(a, a)); }

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Adds `times` b to a. */
static void add(double a[3], double times, const double b[3])
{
    for (int c = 0; c < 3; c++)
        a[c] += times * b[c];
}

/* ---- The nearest image -------------------------------------------------------------------------------------- */

enum { STEPS_MOST = 1000 }; /* of loops that end by themselves in exact arithmetic */

/* One step of Selling's: a pair of the edges and their negative sum, the last of `count`, that meets at less than a
 * right angle is parted. Returns whether there was one. */
static int part_edges(double edge[4][3], int count)
{
    for (int i = 0; i < count; i++)
        for (int j = i + 1; j < count; j++) {
            const double least = 1e-12 * (dot(edge[i], edge[i]) + dot(edge[j], edge[j])); /* what rounding leaves */
            if (!(dot(edge[i], edge[j]) > least))
                continue;
            if (count == 3) { /* i to its negative, and the third to j less i: the sum stays 0 */
                const int k = 3 - i - j;
                memcpy(edge[k], edge[j], sizeof edge[k]);
                add(edge[k], -1.0, edge[i]);
                for (int c = 0; c < 3; c++)
                    edge[j][c] = -edge[j][c];
                return 1;
            }
            for (int k = 0; k < count; k++)
                if (k != i && k != j)
                    add(edge[k], 1.0, edge[i]);
            for (int c = 0; c < 3; c++)
                edge[i][c] = -edge[i][c];
            return 1;
        }
    return 0;
}

/* Takes a sum of edges away, or adds it, as often as that makes the vector shorter. Returns whether it did. */
static int shorten(double vector[3], const double sum[3])
{
    const double rounding = 1e-12; /* of a share: half of an edge stays what it is */
    const double share = dot(vector, sum) / dot(sum, sum);
    if (!(fabs(share) > 0.5 + rounding))
        return 0;
    add(vector, -rint(share), sum);
    return 1;
}

void cgt_nearest_image(const periodic_box *box, double vector[3])
{
    double edge[4][3] = {{0.0}};
    int count = 0, is_shorter = 1;
    for (int e = 0; e < 3; e++)
        if (dot(box->row[e], box->row[e]) > 0.0) {
            memcpy(edge[count], box->edge[e], sizeof edge[count]);
            count++;
        }
    if (!count || !isfinite(dot(vector, vector)))
        return;
    for (int k = 0; k < count; k++)
        add(edge[count], -1.0, edge[k]);
    for (int step = 0; step < STEPS_MOST && count > 1 && part_edges(edge, count + 1); step++) {
    }
    for (int step = 0; step < STEPS_MOST && is_shorter; step++) {
        is_shorter = 0;
        for (int some = 1; some < 1 << count; some++) {
            double sum[3] = {0.0};
            for (int k = 0; k < count; k++)
                add(sum, some >> k & 1 ? 1.0 : 0.0, edge[k]);
            is_shorter |= shorten(vector, sum);
        }
    }
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

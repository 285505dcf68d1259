/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Periodic boundaries; see periodic_box.h. In a tilted box the nearest image is not always that of the least shares:
 * the edges are reduced as Selling does (Conway and Sloane, Low-Dimensional Lattices VI, 1992) until no two of them
 * and their negative sum meet at less than a right angle. Then the faces of the cell of the lattice lie halfway to
 * sums of some of them, and a vector that none of these shortens is the least. */
#include "sequence/periodic_box.h"

#include <math.h>
#include <string.h>

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Adds `times` b to a. */
static void add(double a[3], double times, const double b[3])
{
    for (int c = 0; c < 3; c++)
        a[c] += times * b[c];
}

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

/* A unit vector across the edge e, which is 0, and those of the other two that are not. */
static void set_normal(double edge[3][3], int e)
{
    const double *const a = edge[(e + 1) % 3], *const b = edge[(e + 2) % 3];
    const double *const known = dot(a, a) > 0.0 ? a : b;
    double normal[3], axis[3] = {0.0, 0.0, 0.0};
    int least = 0;
    for (int c = 1; c < 3; c++)
        least = fabs(known[c]) < fabs(known[least]) ? c : least;
    axis[least] = 1.0;
    cross(known, dot(a, a) > 0.0 && dot(b, b) > 0.0 ? b : axis, normal);
    const double length = sqrt(dot(normal, normal));
    for (int c = 0; c < 3 && length > 0.0; c++)
        edge[e][c] = normal[c] / length;
}

/* The edges, with others in place of those that are 0: sheets and chains have shares of the edges they have. */
static void complete_edges(const cgt_trajectory_frame *f, double edge[3][3])
{
    memcpy(edge, f->box_edge, 3 * sizeof *edge);
    for (int e = 0; e < 3; e++)
        if (!(dot(edge[e], edge[e]) > 0.0))
            set_normal(edge, e);
}

/* Whether something goes through the boundary across an edge. */
static int is_open(const cgt_trajectory_frame *f, int e)
{
    return dot(f->box_edge[e], f->box_edge[e]) > 0.0 && f->periodic[e] != 0 && !f->unwrapped[e];
}

periodic_box cgt_periodic_box_of(const cgt_trajectory_frame *f)
{
    periodic_box box;
    double edge[3][3], least = INFINITY; /* height */
    double longest = 0.0; /* of rows, by the sum of their numbers: no share is larger than that times the step */
    memset(&box, 0, sizeof box);
    memcpy(box.edge, f->box_edge, sizeof box.edge);
    complete_edges(f, edge);
    for (int e = 0; e < 3; e++) {
        double normal[3];
        cross(edge[(e + 1) % 3], edge[(e + 2) % 3], normal);
        const double volume = dot(normal, edge[e]);
        for (int c = 0; c < 3 && volume != 0.0 && is_open(f, e); c++)
            box.row[e][c] = normal[c] / volume;
        longest = fmax(longest, fabs(box.row[e][0]) + fabs(box.row[e][1]) + fabs(box.row[e][2]));
        least = dot(box.row[e], box.row[e]) > 0.0 ? fmin(least, cgt_periodic_box_height(&box, e)) : least;
    }
    for (int e = 0; e < 3; e++) {
        const int next = (e + 1) % 3;
        box.leans |= dot(box.row[e], box.row[e]) > 0.0 && dot(box.row[next], box.row[next]) > 0.0 &&
                     dot(edge[e], edge[next]) != 0.0;
    }
    box.near = longest > 0.0 ? 0.5 / longest : INFINITY;
    box.sure = 0.5 * least;
    if (box.leans) /* a step is at most sqrt(3) times its longest part */
        box.near = fmin(box.near, box.sure / sqrt(3.0));
    return box;
}

double cgt_periodic_box_share(const periodic_box *box, int e, const double vector[3])
{
    return box->row[e][0] * vector[0] + box->row[e][1] * vector[1] + box->row[e][2] * vector[2];
}

double cgt_periodic_box_height(const periodic_box *box, int e)
{
    const double square = dot(box->row[e], box->row[e]);
    return square > 0.0 ? 1.0 / sqrt(square) : 0.0;
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

/* ---- Crossings ---------------------------------------------------------------------------------------------- */

/* A step without the edges that are counted. */
static void take_edges(const periodic_box *box, const double step[3], const double count[3], double rest[3])
{
    memcpy(rest, step, 3 * sizeof *rest);
    for (int e = 0; e < 3; e++)
        add(rest, -count[e], box->edge[e]);
}

/* Sets the count to that of the nearest image, where another one is longer by more than `rounding`. */
static void count_nearest(const periodic_box *box, const double step[3], double rounding, double count[3])
{
    double rest[3], nearest[3];
    take_edges(box, step, count, rest);
    if (dot(rest, rest) <= box->sure * box->sure)
        return;
    memcpy(nearest, step, sizeof nearest);
    cgt_nearest_image(box, nearest);
    /* half an edge and a share r of it more is longer, by its square, than half an edge and r less: 8 r of it */
    const double least = dot(nearest, nearest) * (1.0 + 8.0 * rounding);
    if (dot(step, step) <= least)
        memset(count, 0, 3 * sizeof *count);
    else if (!(dot(rest, rest) <= least)) {
        for (int c = 0; c < 3; c++)
            rest[c] = step[c] - nearest[c];
        for (int e = 0; e < 3; e++)
            count[e] = rint(cgt_periodic_box_share(box, e, rest));
    }
}

int cgt_periodic_box_count(const periodic_box *box, const double step[3], double count[3])
{
    const double rounding = 1e-6; /* of places in single precision: half of an edge is no crossing */
    for (int e = 0; e < 3; e++) {
        const double share = cgt_periodic_box_share(box, e, step);
        count[e] = isfinite(share) && fabs(share) > 0.5 + rounding ? rint(share) : 0.0;
    }
    if (box->leans && isfinite(dot(step, step)))
        count_nearest(box, step, rounding, count);
    return count[0] != 0.0 || count[1] != 0.0 || count[2] != 0.0;
}

int cgt_periodic_box_crossed(const periodic_box *box, const float a[3], const float b[3], double count[3])
{
    const double step[3] = {(double)b[0] - (double)a[0], (double)b[1] - (double)a[1], (double)b[2] - (double)a[2]};
    return cgt_periodic_box_count(box, step, count);
}

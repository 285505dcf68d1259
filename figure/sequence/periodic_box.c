/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Periodic boundaries; see periodic_box.h. */
#include "sequence/periodic_box.h"

#include <math.h>
#include <string.h>

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

periodic_box cgt_periodic_box_of(const cgt_trajectory_frame *f)
{
    periodic_box box;
    double longest = 0.0; /* of rows, by the sum of their numbers: no share is larger than that times the step */
    memset(&box, 0, sizeof box);
    memcpy(box.edge, f->box_edge, sizeof box.edge);
    for (int e = 0; e < 3; e++) {
        double normal[3], volume = 0.0;
        cross(f->box_edge[(e + 1) % 3], f->box_edge[(e + 2) % 3], normal);
        for (int c = 0; c < 3; c++)
            volume += normal[c] * f->box_edge[e][c];
        for (int c = 0; c < 3 && volume != 0.0 && f->periodic[e] != 0 && !f->unwrapped[e]; c++)
            box.row[e][c] = normal[c] / volume;
        longest = fmax(longest, fabs(box.row[e][0]) + fabs(box.row[e][1]) + fabs(box.row[e][2]));
    }
    box.near = longest > 0.0 ? 0.5 / longest : INFINITY;
    return box;
}

double cgt_periodic_box_share(const periodic_box *box, int e, const double vector[3])
{
    return box->row[e][0] * vector[0] + box->row[e][1] * vector[1] + box->row[e][2] * vector[2];
}

double cgt_periodic_box_height(const periodic_box *box, int e)
{
    const double square = cgt_periodic_box_share(box, e, box->row[e]);
    return square > 0.0 ? 1.0 / sqrt(square) : 0.0;
}

int cgt_periodic_box_crossed(const periodic_box *box, const float a[3], const float b[3], double count[3])
{
    const double rounding = 1e-6; /* of places in single precision: half of an edge is no crossing */
    int crossed = 0;
    for (int e = 0; e < 3; e++) {
        const double step[3] = {(double)b[0] - (double)a[0], (double)b[1] - (double)a[1], (double)b[2] - (double)a[2]};
        const double share = cgt_periodic_box_share(box, e, step);
        count[e] = isfinite(share) && fabs(share) > 0.5 + rounding ? rint(share) : 0.0;
        crossed |= count[e] != 0.0;
    }
    return crossed;
}

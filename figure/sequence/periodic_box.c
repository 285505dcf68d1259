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
    memset(&box, 0, sizeof box);
    memcpy(box.edge, f->box_edge, sizeof box.edge);
    box.is_open = 1;
    for (int e = 0; e < 3; e++) {
        double normal[3], volume = 0.0;
        cross(f->box_edge[(e + 1) % 3], f->box_edge[(e + 2) % 3], normal);
        for (int c = 0; c < 3; c++)
            volume += normal[c] * f->box_edge[e][c];
        for (int c = 0; c < 3 && volume != 0.0 && f->periodic[e] != 0 && !f->unwrapped[e]; c++) {
            box.row[e][c] = normal[c] / volume;
            box.is_open = 0;
        }
    }
    return box;
}

int cgt_periodic_box_crossed(const periodic_box *box, const float a[3], const float b[3], double count[3])
{
    const double rounding = 1e-6; /* of places in single precision: half of an edge is no crossing */
    int crossed = 0;
    for (int e = 0; e < 3; e++) {
        double share = 0.0;
        for (int c = 0; c < 3; c++)
            share += box->row[e][c] * ((double)b[c] - (double)a[c]);
        count[e] = isfinite(share) && fabs(share) > 0.5 + rounding ? rint(share) : 0.0;
        crossed |= count[e] != 0.0;
    }
    return crossed;
}

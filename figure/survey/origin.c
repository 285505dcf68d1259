/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Origins; see origin.h. */
#include "survey/origin.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "options/numbers.h"

static const double steps = 32768.0;    /* of single precision across the picture: more than it has pixels */
static const double round_steps = 64.0; /* across a radius: with fewer, equal spheres overlap unevenly */

/* `place` in units of the largest power of ten that is not above `size`; 0 where it is not far. */
static double rounded(double place, double size)
{
    const double digits = floor(log10(size)), unit = pow(10.0, fabs(digits));
    if (!(fabs(place) > size))
        return 0.0;
    return digits < 0.0 ? rint(place * unit) / unit : rint(place / unit) * unit;
}

static int find_origin(const double middle[3], double size, double radius, double origin[3])
{
    double far = 0.0;
    for (int c = 0; c < 3; c++)
        far = fmax(far, fabs(middle[c]));
    const double spacing = far * (double)FLT_EPSILON;
    if (!(size > 0.0) || !isfinite(far) || !(far > 16.0 * size) ||
        !(spacing > size / steps || spacing > radius / round_steps))
        return 0;
    for (int c = 0; c < 3; c++)
        origin[c] = rounded(middle[c], size);
    return 1;
}

int cgt_origin_of_bulk(const bulk *b, double origin[3])
{
    double middle[3], size = 0.0;
    const uint32_t rank = b->count ? (b->count - 1) / 100 : 0;
    float *const sorted = b->count ? malloc(b->count * sizeof *sorted) : NULL;
    if (!sorted)
        return 0;
    for (int c = 0; c < 3; c++) {
        cgt_bulk_sort_places(b, c, sorted);
        middle[c] = (double)sorted[b->count / 2];
        size = fmax(size, (double)sorted[b->count - 1 - rank] - (double)sorted[rank]);
    }
    cgt_bulk_sort_places(b, 3, sorted);
    const double radius = (double)sorted[b->count / 2];
    free(sorted);
    return find_origin(middle, size + 2.0 * radius, radius > 0.0 ? radius : INFINITY, origin);
}

int cgt_origin_of_camera(const double eye[3], const double target[3], double origin[3])
{
    double square = 0.0;
    for (int c = 0; c < 3; c++)
        square += (eye[c] - target[c]) * (eye[c] - target[c]);
    return find_origin(target, sqrt(square), INFINITY, origin);
}

void cgt_origin_tell(const double origin[3], const char *what, char *text, size_t size)
{
    snprintf(text, size,
             "%s far from 0, where single precision rounds coordinates visibly: --origin %s,%s,%s is "
             "subtracted from them in double",
             what, cgt_number(15, origin[0]).text, cgt_number(15, origin[1]).text, cgt_number(15, origin[2]).text);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bands of magnitudes, for scenes of any size.
 *
 * Why. Every kernel tests in single precision, within bounds that are derived. These bounds hold while squares and
 * products of coordinates stay within the range of float: for largest coordinates from 2^-36 to 2^40. Coordinates may
 * be any floats, though, and one scale for all does not help: a single stray at 1e17 would move a scene of size 1 to
 * where its sizes vanish, and every ray would have to test every primitive.
 *
 * How. A scene that leaves this range is cut into bands of primitives of like magnitude. Each band is a scene of its
 * own over copies of its primitives, multiplied by a power of two. The product is exact, and brings the band to where
 * the bounds hold, so that it has a structure like any other scene. Hits are decided on the scaled numbers, which
 * changes no sign and no order. Their values are computed from the caller's. Most scenes have no bands, and pay nothing
 * for them.
 *
 * Where. builders/bands/ plans, copies and commits bands. trace/bands/ traces them: band_ray.h brings rays and cameras
 * to a band's units, band_trace.c traces arrays, band_frame.c frames. */
#ifndef CGT_BANDS_H
#define CGT_BANDS_H

#include "scene/scene.h"

/* Peaks of bands are at least CGT_BAND_ABOVE + 1 powers of two apart (builders/bands/bands_sort.c), of 280. */
#define CGT_MAX_BANDS 18u

typedef struct cgt_band {
    cgt_scene *scene;          /* kept from commit to commit; geometry i is array i of the primitives */
    int exponent;              /* its coordinates are the caller's times 2^exponent */
    uint32_t count;            /* primitives */
    double low[3], high[3];    /* bounds in the caller's units */
    cgt_buffer points, number; /* copies; of each, which primitive it is, ascending */
} cgt_band;

struct cgt_bands {
    uint32_t count; /* of the last commit, the most populous first */
    cgt_band band[CGT_MAX_BANDS];
    uint32_t rest;                           /* primitives that no power of two brings into range without a loss */
    cgt_buffer rest_number;                  /* these, ascending: every ray tests them */
    cgt_buffer work_exponents, work_offsets; /* of the commit */
};

/* The primitive of a band's hit. */
static inline uint32_t cgt_band_primitive(const cgt_band *band, uint32_t geometry, uint32_t primitive)
{
    const uint32_t number = cgt_primitives_number(&band->scene->committed_scene.prims, geometry, primitive);
    return number == CGT_INVALID_ID ? CGT_INVALID_ID : ((const uint32_t *)band->number.data)[number];
}

#endif

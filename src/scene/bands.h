/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bands of magnitudes: a scene whose coordinates leave the comfortable range of float, far out or far in, is cut into
 * bands of primitives of like magnitude. Each band is a scene of its own over copies of its primitives, multiplied by a
 * power of two. The product is exact, and brings the band to where the bounds of single precision hold, so that it has
 * a structure like any other scene. Hits are decided on the scaled numbers, which changes no sign and no order, and
 * their values are computed from the caller's. */
#ifndef CGT_BANDS_H
#define CGT_BANDS_H

#include "scene/scene.h"

/* Peaks of bands are at least CGT_BAND_ABOVE + 1 powers of two apart (builders/bands/bands_plan.c), of 280. */
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

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which band each primitive is in.
 *
 * Bands lie around peaks. A scene's magnitudes thin out towards its middle, and its strays are few: a band that begins
 * at the most populous class holds the scene whole, where bands of fixed limits might cut through it.
 *
 * Copies are multiplied by a power of two. The product is exact unless bits fall below 2^-149, the last one of float.
 * That can happen to coordinates near 0 of primitives far out. Primitives that would lose a bit stay as they are: they
 * are the rest. */
#include <math.h>
#include <string.h>

#include "builders/bands/bands_commit.h"
#include "exact/valid_primitive.h"

/* ---- the plan ---- */

/* The most populous class without a band; CGT_MAGNITUDES where none is left. */
static uint32_t find_peak(const uint32_t count[CGT_MAGNITUDES], const cgt_bands_plan *plan)
{
    uint32_t peak = CGT_MAGNITUDES;
    for (uint32_t k = 0; k < CGT_MAGNITUDES; k++)
        if (plan->band_of[k] == CGT_NO_BAND && count[k] && (peak == CGT_MAGNITUDES || count[k] > count[peak]))
            peak = k;
    return peak;
}

void cgt_plan_bands(const uint32_t count[CGT_MAGNITUDES], cgt_bands_plan *plan)
{
    uint32_t peak;
    plan->bands = 0;
    memset(plan->band_of, CGT_NO_BAND, sizeof plan->band_of);
    while ((peak = find_peak(count, plan)) < CGT_MAGNITUDES) {
        const int exponent = (int)peak - CGT_MAGNITUDE_ZERO;
        plan->exponent[plan->bands] = exponent > CGT_BAND_MAX_PEAK   ? CGT_BAND_MAX_PEAK - exponent
                                      : exponent < CGT_BAND_MIN_PEAK ? CGT_BAND_MIN_PEAK - exponent
                                                                     : 0;
        const int first = (int)peak - CGT_BAND_BELOW, last = (int)peak + CGT_BAND_ABOVE;
        for (int k = first < 0 ? 0 : first; k <= last && k < (int)CGT_MAGNITUDES; k++)
            if (plan->band_of[k] == CGT_NO_BAND && count[k])
                plan->band_of[k] = (uint8_t)plan->bands;
        plan->bands++;
    }
}

/* ---- primitives ---- */

static uint32_t chunk_end(const cgt_bands_job *job, uint32_t first)
{
    return job->prims->count - first < CGT_BANDS_CHUNK ? job->prims->count : first + CGT_BANDS_CHUNK;
}

/* Lists the numbers of a primitive as they are copied. Returns the radius. */
static float list_numbers(const cgt_primitive *q, float v[CGT_BAND_MAX_FLOATS])
{
    const cgt_capsule *c = &q->capsule;
    switch (q->kind) {
    case CGT_KIND_SPHERES: memcpy(v, &q->sphere, sizeof q->sphere); return q->sphere.r;
    case CGT_KIND_CAPSULES:
        memcpy(v, (const float[]){c->p[0], c->p[1], c->p[2], c->r, c->q[0], c->q[1], c->q[2], 0}, 8 * sizeof *v);
        return c->r;
    case CGT_KIND_TRIANGLES: break;
    }
    memcpy(v, q->triangle.v, sizeof q->triangle.v);
    return 0;
}

/* The class of a primitive's largest coordinate, its radius included. */
static uint16_t magnitude_class(const cgt_primitive *q)
{
    float v[CGT_BAND_MAX_FLOATS];
    const double radius = (double)list_numbers(q, v);
    double most = 0;
    uint64_t bits;
    for (uint32_t k = 0; k < cgt_band_floats(q->kind); k++)
        if (q->kind == CGT_KIND_TRIANGLES || k % 4 != 3) /* a coordinate */
            most = fabs((double)v[k]) > most ? fabs((double)v[k]) : most;
    most += radius;
    if (most == 0)
        return 0;
    memcpy(&bits, &most, sizeof bits); /* a normal double: frexp's exponent is its own less 1022 */
    return (uint16_t)((int)(bits >> 52) - 1022 + CGT_MAGNITUDE_ZERO);
}

void cgt_bands_classify(void *argument, uint32_t index)
{
    const cgt_bands_job *job = argument;
    const uint32_t first = index * CGT_BANDS_CHUNK, end = chunk_end(job, first);
    const cgt_primitive_array *a = cgt_primitives_array(job->prims, first);
    for (uint32_t prim = first; prim < end; prim++) {
        while (prim - a->first >= a->count)
            a++;
        const cgt_primitive q = cgt_array_primitive(a, prim - a->first);
        job->class_of[prim] =
            cgt_primitive_check(&q) == CGT_PRIMITIVE_VALID ? magnitude_class(&q) : (uint16_t)CGT_MAGNITUDES;
    }
}

/* Multiplies all numbers of a primitive. Returns whether none has lost a bit. */
static bool scale_numbers(const cgt_primitive *q, double factor, float *to)
{
    float v[CGT_BAND_MAX_FLOATS];
    bool exact = true;
    list_numbers(q, v);
    for (uint32_t k = 0; k < cgt_band_floats(q->kind); k++) {
        const double product = (double)v[k] * factor;
        to[k] = (float)product;
        exact &= (double)to[k] == product;
    }
    return exact;
}

/* The band of a valid primitive. Powers of at least 1 lose nothing: a band's coordinates stay below 2^47. */
static uint32_t choose_band(const cgt_bands_job *job, const cgt_primitive *q, uint32_t class)
{
    float scaled[CGT_BAND_MAX_FLOATS];
    const uint32_t band = job->plan.band_of[class];
    return job->factor[band] >= 1 || scale_numbers(q, job->factor[band], scaled) ? band : CGT_BAND_OF_REST;
}

void cgt_bands_count(void *argument, uint32_t index)
{
    const cgt_bands_job *job = argument;
    const uint32_t first = index * CGT_BANDS_CHUNK, end = chunk_end(job, first);
    const cgt_primitive_array *a = cgt_primitives_array(job->prims, first);
    cgt_band_offset count[CGT_MAX_BANDS + 1] = {0};
    for (uint32_t prim = first; prim < end; prim++) {
        while (prim - a->first >= a->count)
            a++;
        if (job->class_of[prim] == CGT_MAGNITUDES)
            continue;
        const cgt_primitive q = cgt_array_primitive(a, prim - a->first);
        const uint32_t b = choose_band(job, &q, job->class_of[prim]);
        job->class_of[prim] = (uint16_t)b;
        count[b].prims++;
        count[b].floats += cgt_band_floats(a->kind);
    }
    for (uint32_t b = 0; b <= CGT_MAX_BANDS; b++)
        job->offset[index][b] = count[b];
}

void cgt_bands_copy(void *argument, uint32_t index)
{
    const cgt_bands_job *job = argument;
    const uint32_t first = index * CGT_BANDS_CHUNK, end = chunk_end(job, first);
    const cgt_primitive_array *a = cgt_primitives_array(job->prims, first);
    for (uint32_t prim = first; prim < end; prim++) {
        const uint32_t b = job->class_of[prim];
        while (prim - a->first >= a->count)
            a++;
        if (b == CGT_MAGNITUDES)
            continue;
        cgt_band_offset *to = &job->offset[index][b];
        if (b == CGT_BAND_OF_REST) {
            ((uint32_t *)job->bands->rest_number.data)[to->prims++] = prim;
            continue;
        }
        const cgt_primitive q = cgt_array_primitive(a, prim - a->first);
        scale_numbers(&q, job->factor[b], (float *)job->bands->band[b].points.data + to->floats);
        ((uint32_t *)job->bands->band[b].number.data)[to->prims++] = prim;
        to->floats += cgt_band_floats(a->kind);
    }
}

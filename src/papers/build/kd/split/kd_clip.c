/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Clipping in double, with the error of each step in the bounds. Vertices are floats up to 2^55, whole multiples of
 * 2^-149, so nothing here over- or underflows. u is 2^-53. */
#include "papers/build/kd/split/kd_clip.h"

/* Floats at most and at least x. Rounding to nearest misses by half a step, or 2^-150; the subtrahend is at least a
 * whole step of the result. */
static inline float round_down(double x)
{
    const float f = (float)x;
    return f - (fabsf(f) * 0x1p-23f + 0x1p-149f);
}

static inline float round_up(double x)
{
    const float f = (float)x;
    return f + (fabsf(f) * 0x1p-23f + 0x1p-149f);
}

typedef double double4 __attribute__((vector_size(32)));

static inline void add_span(cgt_kd_bounds4 *s, cgt_float4 low, cgt_float4 high)
{
    s->low = cgt_select4(low < s->low, low, s->low);
    s->high = cgt_select4(high > s->high, high, s->high);
}

/* Where the edge from a to b crosses the plane: x = a + (b - a) t with t = (split - a) / (b - a) of the axis. Five
 * roundings in (b - a) t, each u of at most |a| + |b|, and one in the sum and in what is taken off: below 9 u (|a| +
 * |b|). The exact point is between the ends as well. */
static inline cgt_kd_bounds4 crossing(cgt_float4 a, cgt_float4 b, uint32_t axis, float split)
{
    const cgt_int4 magnitude = {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX};
    const double4 from = __builtin_convertvector(a, double4), to = __builtin_convertvector(b, double4);
    const double t = ((double)split - (double)a[axis]) / ((double)b[axis] - (double)a[axis]);
    const double4 x = from + (to - from) * t;
    const cgt_float4 size = (cgt_float4)((cgt_int4)a & magnitude) + (cgt_float4)((cgt_int4)b & magnitude);
    const double4 error = __builtin_convertvector(size, double4) * 0x1.1p-49;
    const cgt_float4 l = __builtin_convertvector(x - error, cgt_float4),
                     h = __builtin_convertvector(x + error, cgt_float4);
    const cgt_float4 low = l - ((cgt_float4)((cgt_int4)l & magnitude) * 0x1p-23f + 0x1p-149f),
                     high = h + ((cgt_float4)((cgt_int4)h & magnitude) * 0x1p-23f + 0x1p-149f);
    const cgt_float4 least = cgt_select4(a < b, a, b), most = cgt_select4(a < b, b, a);
    return (cgt_kd_bounds4){cgt_select4(low > least, low, least), cgt_select4(high < most, high, most)};
}

void cgt_kd_clip_sides(const cgt_triangle *q, uint32_t axis, float split, cgt_kd_bounds4 side[2])
{
    side[0] = side[1] = (cgt_kd_bounds4){cgt_all4(INFINITY), cgt_all4(-INFINITY)};
    cgt_float4 v[3];
    for (int i = 0; i < 3; i++)
        v[i] = (cgt_float4){q->v[i][0], q->v[i][1], q->v[i][2], 0};
    for (int i = 0; i < 3; i++) {
        const int k = i < 2 ? i + 1 : 0;
        const float a = q->v[i][axis], b = q->v[k][axis];
        if (a <= split)
            add_span(&side[0], v[i], v[i]);
        if (a >= split)
            add_span(&side[1], v[i], v[i]);
        if ((a < split && b > split) || (a > split && b < split)) {
            const cgt_kd_bounds4 x = crossing(v[i], v[k], axis, split);
            add_span(&side[0], x.low, x.high);
            add_span(&side[1], x.low, x.high);
        }
    }
}

/* ---- the whole box ---- */

/* Sutherland and Hodgman's way around the six planes, each of them moved outwards by `margin`. A step errs by E, at
 * most 2^-48 times the largest coordinate along an axis. Every point of the exact part is close to the polygon: where
 * it was within D of it before a plane, its neighbour there is inside the moved plane, as long as D is at most the
 * margin; clipping moves that by E, and by D once more where corners that rounding dented are not those of the hull. So
 * D is at most 63 E after six planes. 2^-42 is more than 63 times 2^-48. */
#define CLIP_REL_ERROR 0x1p-42

/* A dented polygon of n corners leaves the plane's inside at most n / 2 times, and has a corner more each time. */
#define MAX_CORNERS 28

typedef struct polygon {
    int corners;
    double v[MAX_CORNERS][3];
} polygon;

/* Keeps what has sign * x at most `limit` along the axis. */
static void clip_plane(const polygon *p, polygon *out, uint32_t axis, double sign, double limit)
{
    out->corners = 0;
    for (int i = 0; i < p->corners; i++) {
        const double *a = p->v[i], *b = p->v[i + 1 == p->corners ? 0 : i + 1];
        const double side_a = sign * a[axis] - limit, side_b = sign * b[axis] - limit;
        if (side_a <= 0)
            memcpy(out->v[out->corners++], a, sizeof out->v[0]);
        if ((side_a < 0 && side_b > 0) || (side_a > 0 && side_b < 0)) {
            const double t = side_a / (side_a - side_b);
            double *x = out->v[out->corners++];
            for (uint32_t k = 0; k < 3; k++)
                x[k] = k == axis ? sign * limit : a[k] + (b[k] - a[k]) * t;
        }
    }
}

static bool beyond(const polygon *p, uint32_t axis, double sign, double limit)
{
    for (int i = 0; i < p->corners; i++)
        if (sign * p->v[i][axis] > limit)
            return true;
    return false;
}

bool cgt_kd_clip_box(const cgt_triangle *q, const cgt_kd_box *box, cgt_kd_box *bounds)
{
    polygon room[2], *p = &room[0], *scratch = &room[1];
    double margin[3] = {0, 0, 0};
    p->corners = 3;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            p->v[i][k] = q->v[i][k];
            margin[k] = fmax(margin[k], CLIP_REL_ERROR * fabs(p->v[i][k]));
        }
    for (uint32_t k = 0; k < 3; k++)
        for (int side = 0; side < 2; side++) {
            const double sign = side ? 1 : -1;
            const double limit = (side ? (double)box->high[k] : -(double)box->low[k]) + margin[k];
            if (!beyond(p, k, sign, limit))
                continue;
            clip_plane(p, scratch, k, sign, limit);
            polygon *clipped = scratch;
            scratch = p;
            p = clipped;
        }
    bool nonempty = p->corners > 0;
    for (int k = 0; k < 3 && nonempty; k++) {
        double low = p->v[0][k], high = low;
        for (int i = 1; i < p->corners; i++) {
            low = fmin(low, p->v[i][k]);
            high = fmax(high, p->v[i][k]);
        }
        const float l = round_down(low - margin[k]), h = round_up(high + margin[k]);
        bounds->low[k] = l > bounds->low[k] ? l : bounds->low[k];
        bounds->high[k] = h < bounds->high[k] ? h : bounds->high[k];
        nonempty = bounds->low[k] <= bounds->high[k];
    }
    return nonempty;
}

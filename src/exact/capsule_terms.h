/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The terms of capsule_double.h, for numbers of a type CAPSULE_REAL, a double or a vector of them, and functions called
 * CAPSULE_NAME(name). Included once for each: there is no guard. */

#define CAPSULE_DOT(p, q) ((p)[0] * (q)[0] + (p)[1] * (q)[1] + (p)[2] * (q)[2])
#define CAPSULE_SUM(p) (CAPSULE_ABS((p)[0]) + CAPSULE_ABS((p)[1]) + CAPSULE_ABS((p)[2]))

typedef struct CAPSULE_NAME(terms) {
    CAPSULE_REAL d[3], n[3], c[3], m[3];
    CAPSULE_REAL nn, dn, mm, middle, product, disc;      /* middle: m.w, product: P, disc: E */
    CAPSULE_REAL length_d, length_n, length_c, length_m; /* 1-norms */
    CAPSULE_REAL r, reach, size;                         /* reach: r + C, size: s */
} CAPSULE_NAME(terms);

static inline void CAPSULE_NAME(cross)(const CAPSULE_REAL p[3], const CAPSULE_REAL q[3], CAPSULE_REAL cross[3])
{
    cross[0] = CGT_CROSS(p, q, 1, 2);
    cross[1] = CGT_CROSS(p, q, 2, 0);
    cross[2] = CGT_CROSS(p, q, 0, 1);
}

static inline void CAPSULE_NAME(init)(CAPSULE_NAME(terms) * e, const CAPSULE_REAL org[3], const CAPSULE_REAL dir[3],
                                      const CAPSULE_REAL p[3], const CAPSULE_REAL q[3], CAPSULE_REAL r)
{
    CAPSULE_REAL w[3], k[3];
    for (int a = 0; a < 3; a++) {
        e->d[a] = dir[a];
        e->n[a] = q[a] - p[a];
        e->c[a] = p[a] - org[a];
    }
    CAPSULE_NAME(cross)(e->c, e->n, w);
    CAPSULE_NAME(cross)(e->d, e->c, k);
    CAPSULE_NAME(cross)(e->d, e->n, e->m);
    const CAPSULE_REAL volume = CAPSULE_DOT(e->n, k), rr = r * r;
    e->r = r;
    e->nn = CAPSULE_DOT(e->n, e->n);
    e->dn = CAPSULE_DOT(e->d, e->n);
    e->mm = CAPSULE_DOT(e->m, e->m);
    e->middle = CAPSULE_DOT(e->m, w);
    e->product = CAPSULE_DOT(w, w) - rr * e->nn;
    e->disc = rr * e->mm - volume * volume;
    e->length_d = CAPSULE_SUM(e->d);
    e->length_n = CAPSULE_SUM(e->n);
    e->length_c = CAPSULE_SUM(e->c);
    e->length_m = CAPSULE_SUM(e->m);
    e->reach = r + e->length_c;
    e->size = r * e->length_m + CAPSULE_ABS(volume) + 4.25 * CGT_DOUBLE_U * (e->length_d * e->length_n * e->reach);
}

static inline CAPSULE_REAL CAPSULE_NAME(disc_error)(const CAPSULE_NAME(terms) * e)
{
    return 24 * CGT_DOUBLE_U * (e->length_d * e->length_n * e->reach) * e->size;
}

static inline CAPSULE_REAL CAPSULE_NAME(dn_error)(const CAPSULE_NAME(terms) * e)
{
    return 5 * CGT_DOUBLE_U * (e->length_d * e->length_n);
}

/* X and Q at an end, with their bounds. */
typedef struct CAPSULE_NAME(end) {
    CAPSULE_REAL x, q, x_error, q_error;
} CAPSULE_NAME(end);

/* c: the end, seen from the origin. */
static inline CAPSULE_NAME(end) CAPSULE_NAME(at_end)(const CAPSULE_NAME(terms) * e, const CAPSULE_REAL c[3])
{
    CAPSULE_REAL k[3], g[3];
    CAPSULE_NAME(cross)(e->d, c, k);
    CAPSULE_NAME(cross)(e->n, k, g);
    const CAPSULE_REAL length_c = CAPSULE_SUM(c), all = e->length_d * e->length_n * (e->r + length_c);
    return (CAPSULE_NAME(end)){.x = -(CAPSULE_DOT(k, e->m)),
                               .q = CAPSULE_DOT(g, g) - e->r * e->r * (e->dn * e->dn),
                               .x_error = 8 * CGT_DOUBLE_U * e->length_d *
                                          (length_c * e->length_m + e->length_n * CAPSULE_SUM(k) +
                                           4 * CGT_DOUBLE_U * (e->length_d * length_c * e->length_n)),
                               .q_error = 24 * CGT_DOUBLE_U * all *
                                          (CAPSULE_SUM(g) + e->r * CAPSULE_ABS(e->dn) + 4.25 * CGT_DOUBLE_U * all)};
}

/* A value that is a sum or, where that cancels, a quotient of others. It is safe where `margin` and that of its form
 * are not below 0. */
typedef struct CAPSULE_NAME(value) {
    CAPSULE_REAL sum, other, margin, sum_margin, other_margin;
} CAPSULE_NAME(value);

/* t of a root of the cylinder: the sum where the middle's sign is that of the root. */
static inline CAPSULE_NAME(value) CAPSULE_NAME(root)(const CAPSULE_NAME(terms) * e, bool far)
{
    const CAPSULE_REAL half = CAPSULE_ROOT(e->disc), length = CAPSULE_ROOT(e->nn), root = length * half,
                       large = CAPSULE_ABS(e->middle) + root, turned = far ? large : -large;
    const CAPSULE_REAL extent = e->length_n * e->reach, axes = e->length_d * e->length_n, loss = e->size / half,
                       place = CGT_CAPSULE_PLACE_SHARE * length * e->r,
                       product_error = extent * extent * CGT_CAPSULE_PRODUCT_LOSS;
    return (CAPSULE_NAME(value)){
        .sum = turned / e->mm,
        .other = e->product / -turned,
        .margin = CAPSULE_LESS(large, place * e->length_m) - extent * axes * loss * CGT_CAPSULE_SUM_LOSS,
        .sum_margin = e->mm - e->length_m * axes * CGT_CAPSULE_SCALE_LOSS,
        .other_margin =
            CAPSULE_LESS(CAPSULE_ABS(e->product) - product_error, place * large - product_error * e->length_m)};
}

/* u of a root of the cylinder: the sum where x and lean have one sign. */
static inline CAPSULE_NAME(value)
    CAPSULE_NAME(share)(const CAPSULE_NAME(terms) * e, const CAPSULE_NAME(end) * p, bool far, CAPSULE_REAL *lean)
{
    const CAPSULE_REAL half = CAPSULE_ROOT(e->disc), length = CAPSULE_ROOT(e->nn), axes = e->length_d * e->length_n,
                       loss = e->size / half;
    const CAPSULE_REAL error =
        p->x_error + CGT_DOUBLE_U * (6 * axes * half + 24 * CAPSULE_ABS(e->dn) * (axes * e->reach) * loss) / length;
    *lean = (far ? e->dn : -e->dn) * half / length;
    return (CAPSULE_NAME(value)){.sum = (p->x + *lean) / e->mm,
                                 .other = p->q / (e->nn * (p->x - *lean)),
                                 .margin = CAPSULE_ABS(p->x) + CAPSULE_ABS(*lean) - error * CGT_CAPSULE_U_LOSS,
                                 .sum_margin = e->mm - e->length_m * axes * CGT_CAPSULE_SCALE_LOSS,
                                 .other_margin = CAPSULE_ABS(p->q) - p->q_error * CGT_CAPSULE_U_LOSS};
}

/* Across the axis from where the ray is at t, over r. */
static inline void CAPSULE_NAME(normal)(const CAPSULE_NAME(terms) * e, CAPSULE_REAL t, CAPSULE_REAL normal[3])
{
    CAPSULE_REAL h[3];
    for (int a = 0; a < 3; a++)
        h[a] = t * e->d[a] - e->c[a];
    const CAPSULE_REAL u = CAPSULE_DOT(h, e->n) / e->nn, k = 1 / e->r;
    for (int a = 0; a < 3; a++)
        normal[a] = (h[a] - u * e->n[a]) * k;
}

#undef CAPSULE_DOT
#undef CAPSULE_SUM

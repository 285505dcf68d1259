/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Capsules in double, then exactly. */
#include "exact/decide_capsule.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "exact/capsule_double.h"

/* ---- the parts that a line enters and leaves at ---- */

/* What double tells of a line: the parts as numbers of cgt_capsule_part, or UNKNOWN. */
typedef struct line_parts {
    int part[2]; /* where it enters, where it leaves */
} line_parts;

#define UNKNOWN (-1)

/* 1, -1, or 0 where the sign is not certain. */
static int certain_sign(double value, double error) { return value > error ? 1 : value < -error ? -1 : 0; }

/* The part that a line enters at, by the rules of exact_decide.h; where it leaves, with the ends exchanged and signs of
 * x reversed. known: the order of the ends is certain. Otherwise only what does not depend on it is. */
static int entered_part(int first_x, int first_q, int last_x, int last_q, bool known, int first, int last)
{
    if (!known && !(first_q > 0 && last_q > 0))
        return UNKNOWN;
    if (first_q < 0 || first_x < 0)
        return first;
    if (!(first_q > 0 && first_x > 0))
        return UNKNOWN;
    if (last_q > 0 && last_x > 0)
        return last;
    return last_q < 0 || last_x < 0 ? CGT_CAPSULE_SIDE : UNKNOWN;
}

static cgt_capsule_double_terms terms_of(const cgt_ray *ray, const cgt_capsule *capsule)
{
    cgt_capsule_double_terms e;
    double org[3], dir[3], p[3], q[3];
    for (int a = 0; a < 3; a++) {
        org[a] = ray->line.org[a];
        dir[a] = ray->line.dir[a];
        p[a] = capsule->p[a];
        q[a] = capsule->q[a];
    }
    cgt_capsule_double_init(&e, org, dir, p, q, capsule->r);
    return e;
}

static line_parts parts_of_line(const cgt_capsule_double_terms *e, const cgt_ray *ray, const cgt_capsule *capsule)
{
    double c[3];
    for (int a = 0; a < 3; a++)
        c[a] = (double)capsule->q[a] - (double)ray->line.org[a];
    const cgt_capsule_double_end p = cgt_capsule_double_at_end(e, e->c), q = cgt_capsule_double_at_end(e, c);
    const bool known = fabs(e->dn) > cgt_capsule_double_dn_error(e);
    const bool from_q = e->dn < 0;
    const int turned = from_q ? -1 : 1; /* the axis points along the line */
    const int x[2] = {turned * certain_sign(p.x, p.x_error), turned * certain_sign(q.x, q.x_error)};
    const int s[2] = {certain_sign(p.q, p.q_error), certain_sign(q.q, q.q_error)};
    const int first = from_q ? CGT_CAPSULE_Q : CGT_CAPSULE_P, last = from_q ? CGT_CAPSULE_P : CGT_CAPSULE_Q;
    return (line_parts){{entered_part(x[from_q], s[from_q], x[!from_q], s[!from_q], known, first, last),
                         entered_part(-x[!from_q], s[!from_q], -x[from_q], s[from_q], known, last, first)}};
}

/* The part where the line enters or leaves, exactly. */
static cgt_capsule_part part_at(const cgt_ray *ray, const cgt_capsule *capsule, const line_parts *line, bool far)
{
    cgt_capsule_part exact[2] = {CGT_CAPSULE_P, CGT_CAPSULE_P};
    if (line->part[far] != UNKNOWN)
        return (cgt_capsule_part)line->part[far];
    (void)cgt_exact_capsule_roots(&ray->line, capsule, exact);
    return exact[far];
}

/* In how many places the line meets the capsule, which is no sphere. */
static int roots_of_line(const cgt_ray *ray, const cgt_capsule *capsule, const cgt_capsule_double_terms *e,
                         const line_parts *line, uint64_t *exact)
{
    const int near = line->part[0], far = line->part[1];
    cgt_capsule_part parts[2];
    if (near == CGT_CAPSULE_SIDE && e->disc > cgt_capsule_double_disc_error(e))
        return 2;
    if ((near == CGT_CAPSULE_P || near == CGT_CAPSULE_Q) && far != UNKNOWN) {
        const int roots = cgt_decide_sphere_roots(ray, cgt_capsule_end(capsule, (cgt_capsule_part)near), exact);
        return roots && near != far ? 2 : roots;
    }
    ++*exact;
    return cgt_exact_capsule_roots(&ray->line, capsule, parts);
}

int cgt_decide_capsule_roots(const cgt_ray *ray, const cgt_capsule *capsule, uint64_t *exact)
{
    const cgt_capsule_double_terms e = terms_of(ray, capsule);
    if (e.nn == 0) /* a sphere */
        return cgt_decide_sphere_roots(ray, cgt_capsule_end(capsule, CGT_CAPSULE_P), exact);
    if (e.disc < -cgt_capsule_double_disc_error(&e))
        return 0;
    const line_parts line = parts_of_line(&e, ray, capsule);
    return roots_of_line(ray, capsule, &e, &line, exact);
}

/* ---- canonical values ---- */

/* Takes the sum or the other form; false where it is not safe. */
static bool take_value(const cgt_capsule_double_value *from, bool is_sum, double *value)
{
    *value = is_sum ? from->sum : from->other;
    return from->margin >= 0 && (is_sum ? from->sum_margin : from->other_margin) >= 0;
}

static double root_at(const cgt_ray *ray, const cgt_capsule *capsule, const cgt_capsule_double_terms *e, bool far,
                      cgt_capsule_part part)
{
    double t;
    if (part != CGT_CAPSULE_SIDE) {
        const cgt_ray line = {.line = ray->line, .t_min = -INFINITY};
        const cgt_sphere sphere = cgt_capsule_end(capsule, part);
        bool before; /* the near root is before the range of float */
        if (far)
            return cgt_canonical_sphere_far(ray, sphere);
        t = cgt_canonical_sphere_t(&line, sphere, &before);
        return before ? -INFINITY : t;
    }
    const cgt_capsule_double_value root = cgt_capsule_double_root(e, far);
    if (take_value(&root, (e->middle > 0) == far, &t))
        return t;
    const cgt_primitive primitive = {.kind = CGT_KIND_CAPSULES, .capsule = *capsule};
    return cgt_exact_t(&ray->line, &(cgt_exact_root){&primitive, far});
}

/* As cgt_canonical_capsule_t, of a capsule that is no sphere. */
static double first_root(const cgt_ray *ray, const cgt_capsule *capsule, const cgt_capsule_double_terms *e,
                         const line_parts *line, bool *far, cgt_capsule_part *part)
{
    *far = false;
    *part = part_at(ray, capsule, line, false);
    const double near = root_at(ray, capsule, e, false, *part);
    if ((float)near >= fmaxf(ray->t_min, -FLT_MAX))
        return near;
    *far = true;
    *part = part_at(ray, capsule, line, true);
    return root_at(ray, capsule, e, true, *part);
}

double cgt_canonical_capsule_t(const cgt_ray *ray, const cgt_capsule *capsule, bool *far, cgt_capsule_part *part)
{
    const cgt_capsule_double_terms e = terms_of(ray, capsule);
    *part = CGT_CAPSULE_P;
    if (e.nn == 0) /* a sphere */
        return cgt_canonical_sphere_t(ray, cgt_capsule_end(capsule, CGT_CAPSULE_P), far);
    const line_parts line = parts_of_line(&e, ray, capsule);
    return first_root(ray, capsule, &e, &line, far, part);
}

bool cgt_decide_capsule_hit(const cgt_ray *ray, cgt_decided_hit *hit, uint64_t *exact)
{
    const cgt_capsule *capsule = &hit->primitive.capsule;
    const cgt_capsule_double_terms e = terms_of(ray, capsule);
    if (e.nn == 0) { /* a sphere */
        const cgt_sphere sphere = cgt_capsule_end(capsule, CGT_CAPSULE_P);
        if (!cgt_decide_sphere_roots(ray, sphere, exact))
            return false;
        hit->part = CGT_CAPSULE_P;
        hit->t = cgt_canonical_sphere_t(ray, sphere, &hit->far);
        return true;
    }
    if (e.disc < -cgt_capsule_double_disc_error(&e))
        return false;
    const line_parts line = parts_of_line(&e, ray, capsule);
    if (!roots_of_line(ray, capsule, &e, &line, exact))
        return false;
    hit->t = first_root(ray, capsule, &e, &line, &hit->far, &hit->part);
    return true;
}

double cgt_canonical_capsule_far(const cgt_ray *ray, const cgt_capsule *capsule, cgt_capsule_part *part)
{
    const cgt_capsule_double_terms e = terms_of(ray, capsule);
    *part = CGT_CAPSULE_P;
    if (e.nn != 0) {
        const line_parts line = parts_of_line(&e, ray, capsule);
        *part = part_at(ray, capsule, &line, true);
    }
    return root_at(ray, capsule, &e, true, *part);
}

float cgt_canonical_capsule_u(const cgt_ray *ray, const cgt_capsule *capsule, bool far, cgt_capsule_part part)
{
    double u;
    if (part != CGT_CAPSULE_SIDE)
        return part == CGT_CAPSULE_Q;
    const cgt_capsule_double_terms e = terms_of(ray, capsule);
    const cgt_capsule_double_end p = cgt_capsule_double_at_end(&e, e.c);
    double lean;
    const cgt_capsule_double_value share = cgt_capsule_double_share(&e, &p, far, &lean);
    if (!take_value(&share, p.x * lean > 0, &u))
        u = cgt_exact_capsule_u(&ray->line, capsule, far);
    const float rounded = (float)u;
    return rounded > 0 ? rounded < 1 ? rounded : 1 : 0;
}

void cgt_canonical_capsule_normal(const cgt_ray *ray, const cgt_capsule *capsule, double t, cgt_capsule_part part,
                                  float normal[3])
{
    double n[3];
    if (part != CGT_CAPSULE_SIDE || !(capsule->r > 0)) {
        cgt_canonical_sphere_normal(ray, cgt_capsule_end(capsule, part), t, normal);
        return;
    }
    const cgt_capsule_double_terms e = terms_of(ray, capsule);
    cgt_capsule_double_normal(&e, t, n);
    for (int a = 0; a < 3; a++)
        normal[a] = (float)n[a];
}

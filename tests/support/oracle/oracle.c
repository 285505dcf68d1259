/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The exact hit of a ray in a scene, and verdicts by it: brute force, first filtered in double, then in integers. */
#include "support/oracle/oracle.h"

#include <math.h>
#include <string.h>

#include "support/oracle/oracle_filter.h"
#include "support/oracle/oracle_line.h"

/* ---- the nearest hit ---- */

typedef struct nearest {
    uint32_t index;
    int number; /* of the root */
    oracle_root root;
} nearest;

static truth_real magnitude(truth_real a) { return a < 0 ? -a : a; }

/* Order of two roots: by their values where these are certainly apart. */
static int order_of(const oracle_root *a, const oracle_root *b)
{
    const truth_real difference = a->t - b->t;
    if (magnitude(difference) > 0x1p-40 * (magnitude(a->t) + magnitude(b->t)))
        return difference < 0 ? -1 : 1;
    return oracle_compare(a, b);
}

/* Closer, or at the same t with lower ids. */
static bool precedes(const oracle_scene *scene, const nearest *a, const nearest *b)
{
    const int order = order_of(&a->root, &b->root);
    if (order != 0)
        return order < 0;
    const oracle_primitive *x = &scene->primitive[a->index], *y = &scene->primitive[b->index];
    return x->geometry != y->geometry ? x->geometry < y->geometry : x->primitive < y->primitive;
}

static nearest find_nearest(const oracle_scene *scene, const truth_ray *ray, const oracle_line *line,
                            const oracle_range *range)
{
    oracle_filter filter = oracle_filter_make(ray);
    nearest best = {.index = ORACLE_NONE}, other;
    double margin[ORACLE_BLOCK];
    for (uint32_t first = 0; first < scene->count; first += ORACLE_BLOCK) {
        const uint32_t remaining = scene->count - first, count = remaining < ORACLE_BLOCK ? remaining : ORACLE_BLOCK;
        oracle_bounds made;
        const oracle_bounds *bounds = scene->bounds ? scene->bounds + first / ORACLE_BLOCK : &made;
        if (!scene->bounds)
            oracle_bound(scene->primitive + first, count, &made);
        oracle_filter_line(&filter, bounds, margin);
        for (uint32_t i = 0; i < count; i++) {
            const oracle_primitive *primitive = &scene->primitive[first + i];
            if (margin[i] < 0 || !oracle_filter_keeps(&filter, bounds, i, primitive))
                continue;
            other.index = first + i;
            other.number = oracle_first_root(line, primitive, range, &other.root);
            if (other.number >= 0 && (best.index == ORACLE_NONE || precedes(scene, &other, &best))) {
                best = other;
                oracle_filter_cut(&filter, best.root.t);
            }
        }
    }
    return best;
}

static oracle_hit hit_of(const oracle_scene *scene, const oracle_line *line, const nearest *found)
{
    oracle_hit hit = {.index = found->index};
    if (found->index != ORACLE_NONE) {
        hit.far = found->number == 1;
        oracle_describe(line, &scene->primitive[found->index], &found->root, &hit);
    }
    return hit;
}

oracle_hit oracle_trace(const oracle_scene *scene, const truth_ray *ray)
{
    oracle_line line;
    if (!oracle_line_make(ray, &line))
        return (oracle_hit){.index = ORACLE_NONE};
    const oracle_range range = oracle_range_make(ray->t_min, ray->t_max, 0);
    const nearest found = find_nearest(scene, ray, &line, &range);
    return hit_of(scene, &line, &found);
}

bool oracle_hits(const oracle_primitive *primitive, const truth_ray *ray, oracle_hit *hit)
{
    *hit = oracle_trace(&(oracle_scene){.primitive = primitive, .count = 1}, ray);
    return hit->index != ORACLE_NONE;
}

/* ---- verdicts ---- */

static uint32_t find_named(const oracle_scene *scene, uint32_t geometry, uint32_t primitive)
{
    for (uint32_t i = 0; i < scene->count; i++)
        if (scene->primitive[i].geometry == geometry && scene->primitive[i].primitive == primitive)
            return i;
    return ORACLE_NONE;
}

/* Whether an answer other than the exact one is right because t at the end of the range may round the other way: the
 * named primitive is hit in the wider range, and nothing in the narrower range comes before it. */
static bool is_right_in_doubt(const oracle_scene *scene, const truth_ray *ray, uint32_t named, oracle_hit *hit)
{
    oracle_line line;
    if (!oracle_line_make(ray, &line))
        return false;
    const oracle_range narrow = oracle_range_make(ray->t_min, ray->t_max, 1);
    const oracle_range wide = oracle_range_make(ray->t_min, ray->t_max, -1);
    const nearest certain = find_nearest(scene, ray, &line, &narrow);
    nearest claimed = {.index = named};
    if (named != ORACLE_NONE) {
        claimed.number = oracle_first_root(&line, &scene->primitive[named], &wide, &claimed.root);
        if (claimed.number < 0)
            return false;
    }
    if (certain.index != named && certain.index != ORACLE_NONE &&
        (named == ORACLE_NONE || precedes(scene, &certain, &claimed)))
        return false;
    *hit = hit_of(scene, &line, &claimed);
    return true;
}

oracle_verdict oracle_judge(const oracle_scene *scene, const truth_ray *ray, uint32_t geometry, uint32_t primitive,
                            oracle_hit *truth)
{
    *truth = oracle_trace(scene, ray);
    const oracle_primitive *exact = truth->index == ORACLE_NONE ? NULL : &scene->primitive[truth->index];
    const bool none = geometry == ORACLE_NONE;
    if (exact ? geometry == exact->geometry && primitive == exact->primitive : none)
        return ORACLE_RIGHT;
    const uint32_t named = none ? ORACLE_NONE : find_named(scene, geometry, primitive);
    if ((none || named != ORACLE_NONE) && is_right_in_doubt(scene, ray, named, truth))
        return ORACLE_RIGHT;
    return none ? ORACLE_MISSED : exact ? ORACLE_WRONG : ORACLE_INVENTED;
}

const char *oracle_check(const oracle_scene *scene, const truth_ray *ray, uint32_t geometry, uint32_t primitive,
                         float t)
{
    static const char *const name[] = {NULL, "a hit is missed", "a hit is invented", "another hit is closer"};
    oracle_hit truth;
    const oracle_verdict verdict = oracle_judge(scene, ray, geometry, primitive, &truth);
    if (verdict != ORACLE_RIGHT)
        return name[verdict];
    if (geometry == ORACLE_NONE)
        return t == INFINITY ? NULL : "no hit, but a t";
    if (oracle_ulp(truth.t, t) > 0.51) /* of a sphere's two roots, the nearer one may be the one in doubt */
        (void)is_right_in_doubt(scene, ray, find_named(scene, geometry, primitive), &truth);
    return oracle_ulp(truth.t, t) <= 0.51 ? NULL : "t is more than 0.51 ulp off";
}

/* ---- errors ---- */

double oracle_ulp(truth_real exact, float got)
{
    const float rounded = (float)exact;
    uint32_t bits;
    if (!isfinite(got))
        return INFINITY;
    memcpy(&bits, &rounded, sizeof bits);
    const int field = (int)(bits >> 23 & 255), known = field < 1 ? 1 : field > 254 ? 254 : field;
    return (double)(magnitude(exact - (truth_real)got) / (truth_real)ldexp(1, known - 150));
}

double oracle_angle(const truth_real exact[3], const float got[3])
{
    truth_real dot = 0, square = 0;
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        const truth_real cross = exact[b] * got[c] - exact[c] * got[b];
        dot += exact[a] * got[a];
        square += cross * cross;
    }
    const double sine = (double)truth_square_root(square), cosine = (double)dot;
    return isfinite(cosine) && (sine > 0 || cosine != 0) ? atan2(sine, cosine) : (double)INFINITY;
}

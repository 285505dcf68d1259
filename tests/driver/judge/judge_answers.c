/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Answers against what is right: which hits, in which order, and their values. */
#include <math.h>
#include <stddef.h>

#include "driver/judge/judge.h"

/* ---- which ---- */

int64_t judge_next(const judge_scene *s, const judge_pool *pool, const judge_truth *truth, uint32_t *at,
                   uint32_t geometry, uint32_t primitive, int far, float t)
{
    while (*at < truth->count) {
        const judge_hit *h = &pool->hit[truth->first + (*at)++];
        const oracle_primitive *p = &s->primitive[h->index];
        const bool named = p->geometry == geometry && p->primitive == primitive && (far < 0 || far == h->far);
        if (named && (!h->doubtful || isnan(t) || oracle_ulp(h->values.t, t) <= 0.51))
            return truth->first + *at - 1;
        if (!h->doubtful)
            return -1;
    }
    return -1;
}

bool judge_is_end(const judge_pool *pool, const judge_truth *truth, uint32_t at)
{
    for (; at < truth->count; at++)
        if (!pool->hit[truth->first + at].doubtful)
            return false;
    return true;
}

/* ---- values ---- */

static double distance_of(const float a[3], const float b[3])
{
    double sum = 0;
    for (int k = 0; k < 3; k++)
        sum += ((double)a[k] - (double)b[k]) * ((double)a[k] - (double)b[k]);
    return sqrt(sum);
}

/* Of a normal as a vector: 2^-23 + 2^-48 c / r. */
static double bound_of_normal(const judge_ray *ray, const oracle_primitive *p)
{
    const float r = p->data[p->kind == ORACLE_SPHERE ? 3 : 6];
    const double near = distance_of(p->data, ray->line.org),
                 far = p->kind == ORACLE_CAPSULE ? distance_of(p->data + 3, ray->line.org) : 0;
    return 0x1p-23 + (r > 0 ? 0x1p-48 * (near > far ? near : far) / (double)r : 0);
}

const char *judge_values(const judge_scene *s, const judge_ray *ray, const judge_hit *right, const judge_answer *answer)
{
    const oracle_primitive *p = &s->primitive[right->index];
    double off = 0;
    if (!(oracle_ulp(right->values.t, answer->t) <= 0.51))
        return "t is more than 0.51 ulp off";
    if (!right->has_values)
        return NULL;
    for (int k = 0; k < 2; k++)
        if (!(oracle_ulp(right->values.uv[k], answer->uv[k]) <= (p->kind == ORACLE_CAPSULE ? 0.51 : 1)))
            return "u or v is too far off";
    for (int a = 0; a < 3; a++) {
        const double error = (double)(right->values.normal[a] - (truth_real)answer->normal[a]);
        if (p->kind == ORACLE_TRIANGLE && !(oracle_ulp(right->values.normal[a], answer->normal[a]) <= 1))
            return "the normal is more than an ulp off";
        off += error * error;
    }
    const double bound = p->kind == ORACLE_TRIANGLE ? 0x1p-20 : bound_of_normal(ray, p);
    return bound >= 0.25 || sqrt(off) <= bound ? NULL : "the normal is too far off";
}

/* Of FAST; where the bound of a normal says nothing, it may be anything. */
static const char *judge_numbers(const judge_scene *s, const judge_ray *ray, const judge_hit *right,
                                 const judge_answer *answer)
{
    const oracle_primitive *const p = &s->primitive[right->index];
    const float sum = answer->normal[0] + answer->normal[1] + answer->normal[2] + answer->uv[0] + answer->uv[1];
    const bool any = p->kind != ORACLE_TRIANGLE && bound_of_normal(ray, p) >= 0.25;
    return any || isfinite(sum) ? NULL : "a value is no number";
}

static bool is_empty(const judge_answer *a)
{
    return a->t == INFINITY && a->geometry == ORACLE_NONE && a->normal[0] == 0 && a->normal[1] == 0 &&
           a->normal[2] == 0 && a->uv[0] == 0 && a->uv[1] == 0;
}

const char *judge_nearest(const judge_scene *s, const judge_pool *pool, const judge_truth *truth, const judge_ray *ray,
                          bool fast, const judge_answer *answer)
{
    const char *wrong = "another hit is the nearest";
    uint32_t at = 0;
    int64_t k;
    if (answer->primitive == ORACLE_NONE)
        return !judge_is_end(pool, truth, 0) ? "a hit is missed" : is_empty(answer) ? NULL : "a miss has values";
    /* a sphere's near surface may be in doubt, and the far one meant */
    while ((k = judge_next(s, pool, truth, &at, answer->geometry, answer->primitive, -1, fast ? NAN : answer->t)) >=
           0) {
        wrong = fast ? judge_numbers(s, ray, &pool->hit[k], answer) : judge_values(s, ray, &pool->hit[k], answer);
        if (!wrong || !pool->hit[k].doubtful)
            break;
    }
    if (!wrong && fast && !(answer->t >= ray->line.t_min && answer->t <= ray->line.t_max))
        wrong = "t is out of its range";
    return wrong;
}

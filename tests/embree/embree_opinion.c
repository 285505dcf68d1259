/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Answers judged and printed. */
#include "embree/embree_opinion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/oracle/oracle_line.h"

bool opinion_make(opinion *o, const char *config, uint32_t rays)
{
    *o = (opinion){.config = config,
                   .hit = calloc((size_t)rays + 1, sizeof *o->hit),
                   .exact_t = calloc((size_t)rays + 1, sizeof *o->exact_t),
                   .t_error = calloc((size_t)rays + 1, sizeof *o->t_error),
                   .uv_error = calloc((size_t)rays + 1, sizeof *o->uv_error)};
    if (o->hit && o->exact_t && o->t_error && o->uv_error)
        return true;
    opinion_free(o);
    return false;
}

void opinion_free(opinion *o)
{
    free(o->hit);
    free(o->exact_t);
    free(o->t_error);
    free(o->uv_error);
    *o = (opinion){.hit = NULL};
}

/* ---- verdicts ---- */

const oracle_primitive *opinion_named(const oracle_scene *scene, const full_hit *hit)
{
    uint32_t low = 0, high = scene->count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const oracle_primitive *p = &scene->primitive[middle];
        if (p->geometry == hit->geometry && p->primitive == hit->primitive)
            return p;
        if (p->geometry < hit->geometry || (p->geometry == hit->geometry && p->primitive < hit->primitive))
            low = middle + 1;
        else
            high = middle;
    }
    return NULL;
}

/* Whether the ray hits both primitives first at exactly the same t. */
static bool is_tie(const truth_ray *ray, const oracle_primitive *a, const oracle_primitive *b)
{
    oracle_line line;
    oracle_root root[2];
    if (!oracle_line_make(ray, &line))
        return false;
    const oracle_range range = oracle_range_make(ray->t_min, ray->t_max, 0);
    return oracle_first_root(&line, a, &range, &root[0]) >= 0 && oracle_first_root(&line, b, &range, &root[1]) >= 0 &&
           oracle_compare(&root[0], &root[1]) == 0;
}

static double distance(truth_real exact, float got)
{
    return isfinite(got) ? fabs((double)(exact - (truth_real)got)) : (double)INFINITY;
}

static void measure(opinion *o, uint32_t i, const oracle_primitive *named, const oracle_hit *exact)
{
    const full_hit *hit = &o->hit[i];
    o->exact_t[i] = (double)exact->t;
    o->t_error[i] = oracle_ulp(exact->t, hit->t);
    if (named->kind == ORACLE_TRIANGLE)
        o->uv_error[i] = 0x1p24 * fmax(distance(exact->uv[0], hit->uv[0]), distance(exact->uv[1], hit->uv[1]));
}

void opinion_judge(opinion *o, const hard_scene *s, const hard_truth *truth)
{
    o->tally = (hard_tally){.rays = s->rays};
    o->tied = 0;
    for (uint32_t i = 0; i < s->rays; i++) {
        const full_hit *hit = &o->hit[i];
        oracle_hit exact;
        oracle_verdict verdict = hard_judge(s, truth, i, hit, &exact);
        const oracle_primitive *named = opinion_named(&truth->scene, hit);
        o->exact_t[i] = o->t_error[i] = o->uv_error[i] = NAN;
        o->tally.hits += truth->hit[i].index != ORACLE_NONE;
        if (verdict == ORACLE_WRONG && named &&
            is_tie(&s->ray[i], named, &truth->scene.primitive[truth->hit[i].index])) {
            o->tied++;
            verdict = ORACLE_RIGHT;
            oracle_hits(named, &s->ray[i], &exact);
        }
        o->tally.missed += verdict == ORACLE_MISSED;
        o->tally.invented += verdict == ORACLE_INVENTED;
        o->tally.wrong += verdict == ORACLE_WRONG;
        if (verdict == ORACLE_RIGHT && named)
            measure(o, i, named, &exact);
    }
}

/* ---- order statistics ---- */

static int compare_numbers(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

bool opinion_quantiles_of(const double *number, const uint8_t *among, uint32_t count, opinion_quantiles *spread)
{
    double *sorted = malloc(((size_t)count + 1) * sizeof *sorted);
    size_t n = 0;
    *spread = (opinion_quantiles){NAN, NAN, NAN};
    if (!sorted)
        return false;
    for (uint32_t i = 0; i < count; i++)
        if (!isnan(number[i]) && (!among || among[i]))
            sorted[n++] = number[i];
    if (n) {
        qsort(sorted, n, sizeof *sorted, compare_numbers);
        *spread = (opinion_quantiles){sorted[(n - 1) / 2], sorted[(size_t)(0.99 * (double)(n - 1))], sorted[n - 1]};
    }
    free(sorted);
    return true;
}

/* ---- the table ---- */

void opinion_print_head(FILE *file)
{
    fputs("# hits: by exact arithmetic; wrong: the primitive is not the closest hit, or the ray misses it;\n"
          "# tied: another primitive at exactly the same distance, which is no error.\n"
          "# t_ulp: error of t in ulp where the hit is right or tied; uv: the larger error of u and v in 2^-24.\n"
          "# left_out: what Embree does not accept: values beyond 1.844e18, rays that begin behind their origin.\n"
          "# Embree's manual promises nothing for hits at tnear and tfar: at the origin and at the ends of the range.\n"
          "row\tcase\tconfig\trays\thits\tmissed\tinvented\twrong\ttied\tt_ulp_median\tt_ulp_p99\tt_ulp_worst\t"
          "uv_median\tuv_p99\tuv_worst\tleft_out\n",
          file);
}

static void print_spread(FILE *file, const opinion_quantiles *spread)
{
    const double number[3] = {spread->median, spread->p99, spread->worst};
    for (int i = 0; i < 3; i++) {
        if (isnan(number[i]))
            fprintf(file, "\t-");
        else
            fprintf(file, "\t%.4g", fabs(number[i]));
    }
}

bool opinion_print_row(FILE *file, const char *row, const char *name, const opinion *o, uint32_t rays,
                       const char *left_out)
{
    opinion_quantiles t, uv;
    if (!opinion_quantiles_of(o->t_error, NULL, rays, &t) || !opinion_quantiles_of(o->uv_error, NULL, rays, &uv))
        return false;
    fprintf(file, "%s\t%s\t%s\t%llu\t%llu\t%llu\t%llu\t%llu\t%llu", row, name, o->config,
            (unsigned long long)o->tally.rays, (unsigned long long)o->tally.hits, (unsigned long long)o->tally.missed,
            (unsigned long long)o->tally.invented, (unsigned long long)o->tally.wrong, (unsigned long long)o->tied);
    print_spread(file, &t);
    print_spread(file, &uv);
    fprintf(file, "\t%s\n", left_out);
    return true;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All surfaces along a ray: balls around the primitives in double say which ones it may meet, whole numbers the rest.
 *
 * Crossings take the line once more, really moved: by 2^low (h^4, h^5, h^6) with an h = 2^-k that is small enough for
 * the scene and the ray. With n = high - low + the bits of the direction, every coefficient of a polynomial in h that
 * is asked for is 0, or its ratio to another one is below 2^(n + 5) if it is linear in a length, 2^(2 n + 6) if it is a
 * discriminant, whose first two powers of h are four apart: k = n + 8 is enough. */
#include "driver/judge/judge.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/oracle/oracle_line.h"

/* ---- the line ---- */

typedef struct judge_line {
    oracle_line line, moved;
    bool is_moved;
    float t_min, t_max;
    oracle_range narrow, wide; /* where both are apart, an answer is in doubt */
    bool has_ranges;
    double low, high; /* of t, and slack around them in which ranges decide */
    double slack_low, slack_high;
} judge_line;

static void move_line(const judge_scene *s, const truth_ray *ray, judge_line *l)
{
    int low = s->low, high = s->high, dir_low = 200, dir_high = -200;
    for (int a = 0; a < 3; a++) {
        judge_widen_bits(ray->org[a], &low, &high);
        judge_widen_bits(ray->dir[a], &dir_low, &dir_high);
    }
    low = low > high ? high = 0 : low;
    const int k = high - low + dir_high - dir_low + 8;
    l->moved = l->line;
    l->is_moved = true;
    for (int a = 0; a < 3; a++) {
        const dyadic shift = dyadic_make(1, low - (4 + a) * k);
        l->moved.org[a] = dyadic_add(&l->line.org[a], &shift);
    }
}

static bool line_make(const judge_scene *s, const truth_ray *ray, bool moved, judge_line *l)
{
    if (!oracle_line_make(ray, &l->line) || ray->t_min > ray->t_max)
        return false;
    l->is_moved = l->has_ranges = false;
    l->t_min = ray->t_min;
    l->t_max = ray->t_max;
    l->low = ray->t_min == -INFINITY ? (double)-0x1.fffffep127f : (double)ray->t_min;
    l->high = ray->t_max == INFINITY ? (double)0x1.fffffep127f : (double)ray->t_max;
    l->slack_low = 0x1p-22 * fabs(l->low) + 0x1p-148;
    l->slack_high = 0x1p-22 * fabs(l->high) + 0x1p-148;
    if (moved)
        move_line(s, ray, l);
    return true;
}

/* ---- one surface ---- */

typedef struct surface {
    oracle_root root;
    uint32_t index;
    int number; /* of the root */
    bool far, doubtful;
} surface;

typedef enum place { OUTSIDE, INSIDE, DOUBTFUL } place;

static place place_of(judge_line *l, const oracle_root *root)
{
    const double t = (double)root->t;
    if (t < l->low - l->slack_low || t > l->high + l->slack_high)
        return OUTSIDE;
    if (t > l->low + l->slack_low && t < l->high - l->slack_high)
        return INSIDE;
    if (!l->has_ranges) {
        l->narrow = oracle_range_make(l->t_min, l->t_max, 1);
        l->wide = oracle_range_make(l->t_min, l->t_max, -1);
        l->has_ranges = true;
    }
    return oracle_is_in(root, &l->narrow) ? INSIDE : oracle_is_in(root, &l->wide) ? DOUBTFUL : OUTSIDE;
}

static int sign_of(const oracle_root *root) { return oracle_sign_of_surd(&root->p, root->sigma, &root->disc); }

/* At t_min = 0: what rounds to 0 counts where the moved t is above 0. */
static place place_of_crossing(judge_line *l, const oracle_root *root, const oracle_root *moved)
{
    const double t = fabs((double)root->t);
    if (l->t_min != 0 || t > 0x1p-149)
        return place_of(l, root);
    if (fabs(t - 0x1p-150) < 0x1p-156)
        return DOUBTFUL;
    if (t > 0x1p-150)
        return place_of(l, root);
    return sign_of(moved) > 0 ? INSIDE : OUTSIDE;
}

/* ---- order ---- */

static truth_real magnitude(truth_real a) { return a < 0 ? -a : a; }

static int order_of(const judge_scene *s, const surface *a, const surface *b)
{
    const truth_real difference = a->root.t - b->root.t;
    if (magnitude(difference) > 0x1p-40 * (magnitude(a->root.t) + magnitude(b->root.t)))
        return difference < 0 ? -1 : 1;
    const int order = a->index == b->index ? 0 : oracle_compare(&a->root, &b->root);
    const oracle_primitive *x = &s->primitive[a->index], *y = &s->primitive[b->index];
    if (order)
        return order;
    if (x->geometry != y->geometry)
        return x->geometry < y->geometry ? -1 : 1;
    if (a->index != b->index)
        return x->primitive < y->primitive ? -1 : 1;
    return a->number - b->number;
}

/* ---- a ray ---- */

typedef struct tracing {
    const judge_scene *scene;
    judge_question question;
    judge_line line;
    oracle_filter filter;
    surface *found;
    uint32_t count, order[2 * JUDGE_PRIMITIVES];
    bool ended; /* a shadow is certain */
} tracing;

/* At its place in the order. */
static void add(tracing *t, const oracle_root *root, uint32_t index, int number, bool far, place at)
{
    if (at == OUTSIDE)
        return;
    surface *const f = &t->found[t->count];
    *f = (surface){.root = *root, .index = index, .number = number, .far = far, .doubtful = at == DOUBTFUL};
    uint32_t i = t->count++;
    for (; i > 0 && t->question != JUDGE_SHADOW && order_of(t->scene, f, &t->found[t->order[i - 1]]) < 0; i--)
        t->order[i] = t->order[i - 1];
    t->order[i] = t->count - 1;
    if (at == INSIDE && t->question == JUDGE_NEAREST)
        oracle_filter_cut(&t->filter, root->t);
    t->ended |= at == INSIDE && t->question == JUDGE_SHADOW;
}

/* Ends the program: a judge that is wrong about the theory is of no use. */
static void must(bool holds, const char *what)
{
    if (holds)
        return;
    fprintf(stderr, "judge: %s\n", what);
    abort();
}

static void add_crossings(tracing *t, uint32_t index)
{
    const oracle_primitive *const p = &t->scene->primitive[index];
    oracle_root root[2], moved[2];
    const int count = oracle_roots(&t->line.line, p, root), still = oracle_roots(&t->line.moved, p, moved);
    if (p->kind == ORACLE_TRIANGLE) {
        must(still <= count, "the moved line meets a triangle that the line misses");
        if (still)
            add(t, root, index, 0, oracle_triangle_side(&t->line.line, p->data) > 0,
                place_of_crossing(&t->line, root, moved));
        return;
    }
    if (count == 2) {
        must(still == 2, "the moved line meets a sphere at other places");
        for (int k = 0; k < 2; k++)
            add(t, &root[k], index, k, k > 0, place_of_crossing(&t->line, &root[k], &moved[k]));
    } else if (count == 1 && still == 2 && t->line.t_min == 0 && sign_of(&moved[0]) < 0 && sign_of(&moved[1]) > 0)
        add(t, &root[0], index, 0, true, INSIDE); /* out of the sphere that the moved origin is in */
}

static void add_hits(tracing *t, uint32_t index)
{
    oracle_root root[2];
    const int count = oracle_roots(&t->line.line, &t->scene->primitive[index], root);
    for (int k = 0; k < count && !t->ended; k++)
        add(t, &root[k], index, k, k > 0, place_of(&t->line, &root[k]));
}

static bool sees(const judge_scene *s, const judge_ray *ray, const oracle_primitive *p)
{
    const uint32_t mask = s->geometry[p->geometry].mask;
    return ((mask ? mask : UINT32_MAX) & (ray->mask ? ray->mask : UINT32_MAX)) &&
           !(p->geometry == ray->skip_geometry && p->primitive == ray->skip_primitive);
}

static void look_along(tracing *t, const judge_ray *ray)
{
    const judge_scene *s = t->scene;
    double margin[ORACLE_BLOCK];
    for (uint32_t first = 0; first < s->count && !t->ended; first += ORACLE_BLOCK) {
        const oracle_bounds *bounds = &s->bounds[first / ORACLE_BLOCK];
        oracle_filter_line(&t->filter, bounds, margin);
        for (uint32_t i = 0; i < ORACLE_BLOCK && first + i < s->count && !t->ended; i++) {
            const oracle_primitive *p = &s->primitive[first + i];
            if (margin[i] < 0 || !oracle_filter_keeps(&t->filter, bounds, i, p) || !sees(s, ray, p))
                continue;
            if (t->question == JUDGE_CROSSINGS)
                add_crossings(t, first + i);
            else
                add_hits(t, first + i);
        }
    }
}

static void store(const tracing *t, const surface *f, bool values, judge_pool *pool)
{
    if (pool->count == pool->room) {
        pool->room = pool->room ? 2 * pool->room : 1024;
        pool->hit = realloc(pool->hit, pool->room * sizeof *pool->hit);
        must(pool->hit != NULL, "no memory");
    }
    judge_hit *h = &pool->hit[pool->count++];
    *h = (judge_hit){.index = f->index, .far = f->far, .doubtful = f->doubtful, .has_values = values};
    h->values.t = f->root.t;
    if (values)
        oracle_describe(&t->line.line, &t->scene->primitive[f->index], &f->root, &h->values);
}

/* Room for all surfaces of a scene, which is used again. */
static surface *room_for(uint32_t count)
{
    static surface *found;
    static uint32_t room;
    if (count <= room)
        return found;
    free(found);
    room = count;
    found = malloc(room * sizeof *found);
    must(found != NULL, "no memory");
    return found;
}

judge_truth judge_trace(const judge_scene *s, const judge_ray *ray, judge_question question, bool values,
                        judge_pool *pool)
{
    static tracing t;
    judge_truth truth = {.first = pool->count};
    t.scene = s;
    t.question = question;
    t.found = room_for(2 * s->count + 1);
    t.count = 0;
    t.ended = false;
    if (!line_make(s, &ray->line, question == JUDGE_CROSSINGS, &t.line))
        return truth;
    t.filter = oracle_filter_make(&ray->line);
    look_along(&t, ray);
    for (uint32_t i = 0; i < t.count; i++) {
        const surface *f = &t.found[t.order[i]];
        store(&t, f, values, pool);
        truth.count++;
        if (question == JUDGE_NEAREST && !f->doubtful)
            break;
    }
    return truth;
}

/* ---- points inside ---- */

/* Of the sphere's c.c - r^2 at the moved origin, by double if that is certain: each term is within 2^-50 of itself. */
static bool is_in_sphere(const judge_line *l, const float point[3], const float sphere[4])
{
    double cc = 0;
    for (int a = 0; a < 3; a++)
        cc += ((double)sphere[a] - (double)point[a]) * ((double)sphere[a] - (double)point[a]);
    const double rr = (double)sphere[3] * (double)sphere[3];
    if (fabs(cc - rr) > 0x1p-40 * (cc + rr))
        return cc < rr;
    dyadic c[3];
    const dyadic r = dyadic_of_float(sphere[3]), square = dyadic_mul(&r, &r);
    oracle_from_origin(&l->moved, sphere, c);
    const dyadic distance = dyadic_dot(c, c);
    return dyadic_sub(&distance, &square).sign < 0;
}

/* The winding number and the number of crossings ahead along any direction. */
static int crossings_ahead(const judge_scene *s, const judge_geometry *g, const truth_ray *ray, const judge_line *l,
                           int *winding)
{
    oracle_filter filter = oracle_filter_make(ray);
    double margin[ORACLE_BLOCK];
    int crossings = 0;
    for (uint32_t i = g->first; i < g->first + g->count; i++) {
        const oracle_bounds *bounds = &s->bounds[i / ORACLE_BLOCK];
        oracle_root root[2];
        if (i == g->first || i % ORACLE_BLOCK == 0)
            oracle_filter_line(&filter, bounds, margin);
        if (margin[i % ORACLE_BLOCK] < 0 || !oracle_filter_keeps(&filter, bounds, i % ORACLE_BLOCK, &s->primitive[i]))
            continue;
        if (!oracle_roots(&l->moved, &s->primitive[i], root) || root[0].p.sign <= 0)
            continue;
        crossings++;
        *winding += oracle_triangle_side(&l->moved, s->primitive[i].data);
    }
    return crossings;
}

bool judge_inside(const judge_scene *s, const float point[3], uint32_t mask, bool parity)
{
    static const float direction[3] = {0x1.8p-2f, 0x1.ap-1f, -0x1.1p-1f}; /* any will do: of few bits */
    static judge_line l;
    truth_ray ray = {.t_max = INFINITY};
    memcpy(ray.org, point, sizeof ray.org);
    memcpy(ray.dir, direction, sizeof ray.dir);
    if (!line_make(s, &ray, true, &l))
        return false;
    for (uint32_t k = 0; k < s->geometries; k++) {
        const judge_geometry *g = &s->geometry[k];
        int winding = 0;
        if (!((g->mask ? g->mask : UINT32_MAX) & (mask ? mask : UINT32_MAX)))
            continue;
        for (uint32_t i = g->first; i < g->first + g->count && g->kind == ORACLE_SPHERE; i++)
            if (!judge_is_broken(&s->primitive[i]) && is_in_sphere(&l, point, s->primitive[i].data))
                return true;
        if (g->kind != ORACLE_TRIANGLE)
            continue;
        const int crossings = crossings_ahead(s, g, &ray, &l, &winding);
        if (parity ? crossings % 2 : winding)
            return true;
    }
    return false;
}

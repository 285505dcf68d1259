/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays that go on from what rays have hit, twice, and what they hit then: inside a sphere or a capsule that is its far
 * side, where nothing is nearer. Surfaces, directions and far sides are judged by the roots of the lines in whole
 * numbers, where the bounds of cgt/bounces.h hold: c / h < 2^18, for half the chord h of the sphere around the nearest
 * point of the axis. */
#include <cgt/bounces.h>

#include <math.h>
#include <string.h>

#include "driver/driver.h"
#include "support/oracle/oracle_line.h"

#define MOST 64u /* rays that go on */
#define BOUNCES 2u

typedef enum medium { MIRROR, STRAIGHT, GLASS, MEDIA } medium;

static const cgt_media media[MEDIA] = {{0}, {.inside = 1}, {.inside = 1.25f}};

typedef struct surface {
    double position[3], normal[3];
    uint32_t front, unused;
} surface;

/* Rays, what they hit, and the rays that go on from there. */
typedef struct wave {
    uint32_t count;
    judge_ray ray[MOST], next[MOST];
    full_hit hit[MOST];
    surface surface[MOST];
    bool moved[MOST]; /* the end of its range, whose bits tell that it is inside */
} wave;

static medium chosen;
static wave waves[BOUNCES], first[BOUNCES]; /* those of this setup, and of the first one */

/* ---- a line and the primitive that it meets ---- */

typedef struct meeting {
    oracle_hit root[2];
    int count, at;         /* roots, and the one that was hit */
    bool is_well, is_tied; /* the bounds hold; both roots round to t */
    double away, half;     /* c, h */
} meeting;

static double distance_of(const float a[3], const float b[3])
{
    double sum = 0;
    for (int k = 0; k < 3; k++)
        sum += ((double)a[k] - (double)b[k]) * ((double)a[k] - (double)b[k]);
    return sqrt(sum);
}

static double length_of(const float v[3]) { return distance_of(v, (const float[3]){0}); }

/* The product of two edges over the area between them. */
static double slant_of(const float v[9])
{
    double e[2][3], n[3];
    for (int a = 0; a < 3; a++)
        for (int k = 0; k < 2; k++)
            e[k][a] = (double)v[3 * k + 3 + a] - (double)v[a];
    for (int a = 0; a < 3; a++)
        n[a] = e[0][(a + 1) % 3] * e[1][(a + 2) % 3] - e[0][(a + 2) % 3] * e[1][(a + 1) % 3];
    return distance_of(v, v + 3) * distance_of(v, v + 6) / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

static double radius_of(const oracle_primitive *p)
{
    return p->kind == ORACLE_TRIANGLE ? 0 : (double)p->data[p->kind == ORACLE_SPHERE ? 3 : 6];
}

static void find_conditions(const oracle_primitive *p, const truth_ray *ray, float t, meeting *m)
{
    const double r = radius_of(p);
    double along = 0;
    if (p->kind == ORACLE_TRIANGLE) {
        m->is_well = slant_of(p->data) < 0x1p18;
        return;
    }
    const double near = distance_of(p->data, ray->org),
                 other = p->kind == ORACLE_CAPSULE ? distance_of(p->data + 3, ray->org) : 0;
    m->away = (near > other ? near : other) + r;
    for (int a = 0; a < 3; a++)
        along += (double)m->root[m->at].normal[a] * (double)ray->dir[a];
    m->half = r * fabs(along) / length_of(ray->dir);
    m->is_tied = m->count == 2 && oracle_ulp(m->root[1 - m->at].t, t) <= 0.52;
    m->is_well = r > 0 && m->half > 0x1p-18 * m->away;
}

/* The root that rounds to t; where t is infinite, the far one. */
static meeting meet(const oracle_primitive *p, const truth_ray *ray, float t)
{
    oracle_line line;
    oracle_root root[2];
    meeting m = {.count = 0};
    if (!oracle_line_make(ray, &line))
        return m;
    m.count = oracle_roots(&line, p, root);
    for (int k = 0; k < m.count; k++) {
        m.root[k].t = root[k].t;
        oracle_describe(&line, p, &root[k], &m.root[k]);
    }
    m.at = m.count == 2 && (t == INFINITY || oracle_ulp(m.root[1].t, t) < oracle_ulp(m.root[0].t, t));
    if (m.count)
        find_conditions(p, ray, t, &m);
    return m;
}

static const oracle_primitive *primitive_of(const judge_scene *s, uint32_t geometry, uint32_t primitive)
{
    return &s->primitive[s->geometry[geometry].first + primitive];
}

static bool is_own(const judge_ray *ray, const full_hit *hit)
{
    return hit->primitive != CGT_INVALID_ID && hit->primitive == ray->skip_primitive &&
           hit->geometry == ray->skip_geometry;
}

/* ---- the rays that go on ---- */

static bool bounce(driver_run *run, wave *w)
{
    judge_ray *const n = w->next;
    surface *const s = w->surface;
    cgt_trace_statistics statistics;
    const cgt_trace_options options = {.statistics = &statistics};
    const cgt_rays rays = driver_ray_array(w->ray, w->count);
    const cgt_hits hits = hit_array(w->hit);
    const cgt_surfaces surfaces = {.stride = sizeof *s,
                                   .position = {&s->position[0], &s->position[1], &s->position[2]},
                                   .normal = {&s->normal[0], &s->normal[1], &s->normal[2]},
                                   .front = &s->front};
    const cgt_bounced_rays to = {.stride = sizeof *n,
                                 .org = {&n->line.org[0], &n->line.org[1], &n->line.org[2]},
                                 .dir = {&n->line.dir[0], &n->line.dir[1], &n->line.dir[2]},
                                 .t_min = &n->line.t_min,
                                 .t_max = &n->line.t_max,
                                 .skip_primitive = &n->skip_primitive,
                                 .skip_geometry = &n->skip_geometry};
    uint64_t found = 0;
    memset(n, 0x77, w->count * sizeof *n);
    memset(s, 0, w->count * sizeof *s);
    if (!driver_succeeds(run,
                         cgt_bounce_rays(run->setup.scene, &rays, &hits, chosen == MIRROR ? NULL : &media[chosen],
                                         &surfaces, chosen == MIRROR ? &to : NULL, chosen == MIRROR ? NULL : &to,
                                         &options),
                         "cgt_bounce_rays"))
        return false;
    for (uint32_t i = 0; i < w->count; i++) {
        n[i].mask = w->ray[i].mask;
        found += w->hit[i].primitive != CGT_INVALID_ID;
    }
    if (statistics.rays != w->count || statistics.hits + statistics.invalid_rays != found)
        driver_fail(run, NULL, "cgt_bounce_rays", "%llu surfaces, %llu invalid, of %llu hits",
                    (unsigned long long)statistics.hits, (unsigned long long)statistics.invalid_rays,
                    (unsigned long long)found);
    return true;
}

/* Mirrored, or straight on; glass: any. */
static bool is_direction(const judge_ray *ray, const meeting *m, const float dir[3])
{
    const double length = length_of(ray->line.dir);
    const truth_real *const n = m->root[m->at].normal;
    double along = 0, off = 0;
    for (int a = 0; a < 3; a++)
        along += (double)n[a] * ((double)ray->line.dir[a] / length);
    for (int a = 0; a < 3 && chosen != GLASS; a++)
        off = fmax(off, fabs((double)ray->line.dir[a] / length - (chosen == MIRROR ? 2 * along * (double)n[a] : 0) -
                             (double)dir[a]));
    return off <= 0x1p-23;
}

static bool is_surface(const judge_ray *ray, const oracle_primitive *p, const meeting *m, const surface *s)
{
    const oracle_hit *const right = &m->root[m->at];
    double off = 0, place = 0;
    truth_real along = 0;
    double sizes = 0;
    for (int a = 0; a < 3; a++) {
        const truth_real at = (truth_real)ray->line.org[a] + right->t * (truth_real)ray->line.dir[a];
        off = fmax(off, fabs((double)(right->normal[a] - (truth_real)s->normal[a])));
        place = fmax(place, fabs((double)(at - (truth_real)s->position[a])) - 0x1p-50 * fabs((double)at));
        along += right->normal[a] * (truth_real)ray->line.dir[a];
        sizes += fabs((double)(right->normal[a] * (truth_real)ray->line.dir[a]));
    }
    /* The place follows t where the plane is nearly along the ray; where truth_real tells no side, either is right. */
    if (p->kind == ORACLE_TRIANGLE)
        return off <= 0x1p-30 && (s->front == (along < 0) || fabs((double)along) <= 0x1p-60 * sizes);
    const double r = radius_of(p);
    return off <= 0x1p-28 + 0x1p-48 * m->away / r && place <= 0x1p-48 * m->away * (r / m->half + 1) &&
           s->front == (m->at == 0);
}

/* Where the new ray leaves the sphere or the capsule that it is in: INFINITY where it is in none. */
static bool is_far_side(const oracle_primitive *p, const judge_ray *n, bool inside)
{
    if (p->kind == ORACLE_TRIANGLE || !inside)
        return n->line.t_max == INFINITY;
    const meeting m = meet(p, &n->line, INFINITY);
    if (m.count < 2 || !m.is_well)
        return n->line.t_max >= 0;
    const double r = radius_of(p), far = (double)m.root[1].t,
                 bound = 0x1p-24 * fabs(far) + 0x1p-46 * m.away * (r / m.half + 1) + 0x1p-149;
    if (n->line.t_max == INFINITY) /* no float is as far */
        return far + bound >= 0x1.ffffffp127;
    return fabs((double)n->line.t_max - (far > 0 ? far : 0)) <= bound;
}

static void judge_bounce(driver_run *run, const wave *w, uint32_t i)
{
    const judge_ray *const ray = &w->ray[i], *const n = &w->next[i];
    const full_hit *const hit = &w->hit[i];
    const surface *const s = &w->surface[i];
    const bool off = n->line.t_max == -1;
    const char *wrong = NULL;
    if (hit->primitive == CGT_INVALID_ID) {
        if (!off || n->skip_primitive != CGT_INVALID_ID || s->normal[0] != 0)
            driver_fail(run, ray, "cgt_bounce_rays", "a ray without a hit goes on");
        return;
    }
    const oracle_primitive *const p = primitive_of(&run->scene, hit->geometry, hit->primitive);
    meeting m = meet(p, &ray->line, is_own(ray, hit) ? INFINITY : hit->t);
    const bool inside = chosen == MIRROR ? !s->front : s->front;
    if (!m.count || !m.is_well)
        return;
    m.at = m.is_tied ? !s->front : m.at; /* either is right */
    run->count[COUNT_BOUNCES]++;
    if (!is_surface(ray, p, &m, s))
        wrong = "the surface is another one";
    else if (off && chosen != GLASS)
        wrong = "it does not go on";
    else if (!off && (n->skip_primitive != hit->primitive || n->skip_geometry != hit->geometry))
        wrong = "it does not skip what it leaves";
    else if (!off && !is_direction(ray, &m, n->line.dir))
        wrong = "it goes elsewhere";
    else if (!off && !is_far_side(p, n, inside))
        wrong = "it does not end at the far side";
    if (wrong)
        driver_fail(run, ray, "cgt_bounce_rays", "%s: %d.%d at %a, to %a %a %a, %a", wrong, (int)hit->geometry,
                    (int)hit->primitive, (double)hit->t, (double)n->line.dir[0], (double)n->line.dir[1],
                    (double)n->line.dir[2], (double)n->line.t_max);
}

/* ---- what they hit ---- */

/* Whether a ray inside its own primitive sees that. */
static bool meets_own(const judge_scene *s, const judge_ray *ray)
{
    const uint32_t mask = s->geometry[ray->skip_geometry].mask;
    return ray->line.t_max >= 0 && ray->line.t_max < INFINITY &&
           ((mask ? mask : UINT32_MAX) & (ray->mask ? ray->mask : UINT32_MAX));
}

/* The far side as a hit: nothing that is certain lies clearly before it, and its values are those of the root. */
static const char *judge_own(const driver_run *run, const judge_ray *ray, const judge_truth *right, const full_hit *hit)
{
    const oracle_primitive *const p = primitive_of(&run->scene, hit->geometry, hit->primitive);
    const meeting m = meet(p, &ray->line, INFINITY);
    double off = 0;
    for (uint32_t k = 0; k < right->count; k++) {
        const judge_hit *const h = &run->pool.hit[right->first + k];
        if (!h->doubtful && (double)h->values.t < (double)ray->line.t_max * (1 - 0x1p-20) - 0x1p-149)
            return "something is nearer than its own";
    }
    if (!same_bits(hit->t, ray->line.t_max) || hit->uv[1] != 0)
        return "its own is not where the range ends";
    if (m.count < 2 || !m.is_well)
        return NULL;
    for (int a = 0; a < 3; a++)
        off = fmax(off, fabs((double)(m.root[1].normal[a] - (truth_real)hit->normal[a])));
    return off > 0x1p-22 || fabs((double)(m.root[1].uv[0] - (truth_real)hit->uv[0])) > 0x1p-20
               ? "the values of its own are others"
               : NULL;
}

static void judge_next_hit(driver_run *run, const wave *w, uint32_t i)
{
    const judge_ray *const ray = &w->ray[i];
    const full_hit *const h = &w->hit[i];
    const uint32_t before = run->pool.count;
    const judge_answer answer = {
        h->t, h->primitive, h->geometry, {h->normal[0], h->normal[1], h->normal[2]}, {h->uv[0], h->uv[1]}};
    const bool own = ray->skip_primitive != CGT_INVALID_ID && !w->moved[i] && meets_own(&run->scene, ray);
    const judge_truth right = driver_trace(run, ray, JUDGE_NEAREST, true);
    const char *wrong = is_own(ray, h) ? own ? judge_own(run, ray, &right, h) : "it meets what it skips"
                        : own && h->primitive == CGT_INVALID_ID
                            ? "it does not leave its own"
                            : judge_nearest(&run->scene, &run->pool, &right, ray, false, &answer);
    run->count[COUNT_OWN] += is_own(ray, h);
    run->count[COUNT_ANSWERS]++;
    if (wrong)
        driver_fail(run, ray, "cgt_trace_bounced_rays", "%s: %d.%d at %a", wrong, (int)h->geometry, (int)h->primitive,
                    (double)h->t);
    run->pool.count = before;
}

/* ---- the call ---- */

static bool trace(driver_run *run, wave *w, bool bounced)
{
    const cgt_rays rays = driver_ray_array(w->ray, w->count);
    const cgt_hits hits = hit_array(w->hit);
    const test_trace_options o = driver_options(run, CGT_PRECISION_EXACT);
    memset(w->hit, 0x77, w->count * sizeof *w->hit);
    return driver_succeeds(
        run, (bounced ? cgt_trace_bounced_rays : cgt_trace_rays)(run->setup.scene, &rays, &hits, TRACE_OPTIONS(&o)),
        bounced ? "cgt_trace_bounced_rays" : "cgt_trace_rays");
}

/* The first setup is judged, the others must have its bits. */
static void ask_wave(driver_run *run, uint32_t number)
{
    wave *const w = &waves[number];
    if (!trace(run, w, number > 0) || !bounce(run, w))
        return;
    for (uint32_t i = 0; i < w->count && !run->setup.number; i++) {
        if (number)
            judge_next_hit(run, w, i);
        judge_bounce(run, w, i);
    }
    for (uint32_t i = 0; i < w->count && run->setup.number; i++)
        if (memcmp(&w->hit[i], &first[number].hit[i], sizeof w->hit[i]) != 0 ||
            memcmp(&w->next[i], &first[number].next[i], sizeof w->next[i]) != 0 ||
            memcmp(&w->surface[i], &first[number].surface[i], sizeof w->surface[i]) != 0)
            driver_fail(run, &w->ray[i], "cgt_bounce_rays", "not the bits of the first setup");
    run->count[COUNT_ANSWERS] += w->count;
    if (!run->setup.number)
        first[number] = *w;
}

/* The rays that go on from the last wave; some see something else. */
static void take_next(const wave *from, wave *to)
{
    to->count = from->count;
    memcpy(to->ray, from->next, sizeof to->ray);
    for (uint32_t i = 0; i < to->count; i++) {
        judge_ray *const ray = &to->ray[i];
        to->moved[i] = i % 7 == 3 && ray->line.t_max > 0x1p-126f;
        if (to->moved[i])
            ray->line.t_max = nextafterf(ray->line.t_max, i % 2 ? 0 : INFINITY);
        if (i % 5 == 1)
            ray->mask = 1u << i % 4;
    }
}

static void begin(driver_run *run) { chosen = (medium)random_below(&run->scene.random, MEDIA); }

static void ask(driver_run *run)
{
    waves[0].count = run->rays < MOST ? run->rays : MOST;
    memcpy(waves[0].ray, run->ray, waves[0].count * sizeof *waves[0].ray);
    for (uint32_t k = 0; k < BOUNCES; k++) {
        if (k)
            take_next(&waves[k - 1], &waves[k]);
        ask_wave(run, k);
    }
}

const driver_call call_bounces = {begin, ask};

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Waves of rays: what each ray of a wave meets, what it brings to its pixel, and the rays that go on from there. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "whitted/whitted_internal.h"

/* ---- Memory ------------------------------------------------------------------------------------------------- */

whitted_memory *cgt_whitted_memory_create(uint32_t bounces)
{
    whitted_memory *m = calloc(1, sizeof *m);
    if (!m)
        return NULL;
    for (m->levels = 0; m->levels <= bounces; m->levels++) {
        m->ray[m->levels] = malloc(2 * WHITTED_WAVE * sizeof *m->ray[0]);
        if (!m->ray[m->levels]) {
            cgt_whitted_memory_free(m);
            return NULL;
        }
    }
    return m;
}

void cgt_whitted_memory_free(whitted_memory *m)
{
    if (!m)
        return;
    for (uint32_t i = 0; i < m->levels; i++)
        free(m->ray[i]);
    free(m);
}

/* ---- Rays that go on ---------------------------------------------------------------------------------------- */

static double length_of(const float v[3])
{
    return sqrt((double)v[0] * (double)v[0] + (double)v[1] * (double)v[1] + (double)v[2] * (double)v[2]);
}

/* A ray from a surface, with the parent's bodies. */
static void leave(const whitted_ray *parent, const whitted_hit *hit, const whitted_surface *s,
                  const whitted_leaving *leaving, const float weight[3], whitted_side side, whitted_ray *out)
{
    *out = *parent;
    for (int a = 0; a < 3; a++) {
        out->from[a] = s->position[a];
        out->org[a] = leaving->org[a];
        out->dir[a] = leaving->dir[a];
        out->weight[a] = weight[a];
    }
    out->reach = cgt_whitted_reach(s->position);
    out->t_min = -out->reach;
    out->t_max = leaving->t_max;
    out->skip_primitive = hit->primitive;
    out->skip_geometry = hit->geometry;
    out->side = side;
}

/* Where the rays of the next bounce go: reflected ones from the front, refracted ones from the back, so that
 * neighbours are alike. */
typedef struct whitted_next {
    whitted_ray *ray;
    uint32_t front, back; /* rays at either end */
} whitted_next;

enum { NEXT_ROOM = 2 * WHITTED_WAVE };

static whitted_ray *add_front(whitted_next *next) { return &next->ray[next->front++]; }
static whitted_ray *add_back(whitted_next *next) { return &next->ray[NEXT_ROOM - ++next->back]; }

/* Whether a path with this weight goes on; adds the light of one that ends. */
static bool goes_on(const whitted *w, uint32_t bounce, const float weight[3], float rgb[3])
{
    const float most = fmaxf(weight[0], fmaxf(weight[1], weight[2]));
    if (!(most > 0.0f))
        return false;
    if (most >= w->faintest && bounce < w->bounces)
        return true;
    if (most < w->faintest)
        WHITTED_COUNT(w, faint, 1);
    else
        WHITTED_COUNT(w, cut, 1);
    for (int c = 0; c < 3; c++)
        rgb[c] += weight[c] * w->rest[c];
    return false;
}

/* The bodies beyond the surface. Returns their number, or -1 where there are too many. */
static int bodies_beyond(const whitted_ray *ray, const whitted_surface *s, whitted_body beyond[WHITTED_NESTED])
{
    int count = 0;
    const int at = s->front ? -1 : cgt_whitted_find(ray, s->body);
    if (s->front && ray->nested == WHITTED_NESTED)
        return -1;
    for (int i = 0; i < ray->nested; i++)
        if (i != at)
            beyond[count++] = ray->inside[i];
    if (s->front)
        beyond[count++] = s->body;
    return count;
}

/* The reflected ray, and of glass the refracted one. */
static void spawn(const whitted *w, const whitted_ray *ray, const whitted_hit *hit, const whitted_surface *s,
                  uint32_t bounce, whitted_next *next, float rgb[3])
{
    const bool is_glass = s->material->kind == CGT_MATERIAL_GLASS;
    const whitted_leaving *leaving[2] = {&s->reflected, &s->refracted};
    whitted_body beyond[WHITTED_NESTED];
    float weight[2][3];
    const int count = is_glass ? bodies_beyond(ray, s, beyond) : 0;
    if (count < 0) {
        WHITTED_COUNT(w, too_deep, 1);
        return;
    }
    for (int k = 0; k < 2; k++)
        for (int c = 0; c < 3; c++)
            weight[k][c] = ray->weight[c] * leaving[k]->share * (is_glass ? 1.0f : s->material->color[c]);
    const whitted_side near = s->front ? WHITTED_OUTSIDE : WHITTED_INSIDE;
    const whitted_side far = s->front ? WHITTED_INSIDE : WHITTED_OUTSIDE;
    if (goes_on(w, bounce, weight[0], rgb))
        leave(ray, hit, s, &s->reflected, weight[0], near, add_front(next));
    if (goes_on(w, bounce, weight[1], rgb)) {
        whitted_ray *child = add_back(next);
        leave(ray, hit, s, &s->refracted, weight[1], far, child);
        memcpy(child->inside, beyond, sizeof beyond);
        child->nested = (uint8_t)count;
    }
}

/* ---- What a ray meets --------------------------------------------------------------------------------------- */

static void add_sky(const whitted *w, const whitted_ray *ray, float rgb[3])
{
    const double length = length_of(ray->dir);
    double height = 0.0;
    for (int a = 0; a < 3; a++)
        height += (double)ray->dir[a] * (double)w->up[a];
    const float share = height > 0.0 ? (float)(height / length) : 0.0f;
    for (int c = 0; c < 3; c++)
        rgb[c] += ray->weight[c] * (w->sky[1][c] + share * (w->sky[0][c] - w->sky[1][c]));
}

/* Beer's law for the way through the medium. */
static void absorb(const whitted *w, whitted_ray *ray, double length)
{
    const whitted_body *medium = cgt_whitted_medium(w, ray->inside, ray->nested, -1);
    if (!medium || !(length > 0.0))
        return;
    const float *absorption = cgt_whitted_material_of(w, medium->geometry, medium->primitive)->absorption;
    for (int c = 0; c < 3; c++)
        if (absorption[c] > 0.0f)
            ray->weight[c] = (float)((double)ray->weight[c] * exp(-(double)absorption[c] * length));
}

/* Sets all that lights need; returns whether any of it can shine. */
static bool set_lit(const whitted *w, const whitted_ray *ray, const whitted_hit *hit, const whitted_surface *s,
                    const double dir[3], const double facing[3], whitted_lit *lit)
{
    const cgt_material *material = s->material;
    const whitted_geometry *g = &w->geometry[hit->geometry];
    const bool matte = material->kind == CGT_MATERIAL_MATTE;
    float color[3] = {material->color[0], material->color[1], material->color[2]};
    if (matte && g->color)
        g->color(g->color_user, hit->primitive, color);
    if (!matte && !(material->gloss > 0.0f && s->front))
        return false;
    for (int a = 0; a < 3; a++) {
        lit->from[a] = s->position[a];
        lit->position[a] = s->start[a];
        lit->normal[a] = (float)facing[a];
        lit->eye[a] = (float)-dir[a];
        lit->matte[a] = matte ? ray->weight[a] * color[a] : 0.0f;
        lit->shine[a] = material->gloss > 0.0f ? ray->weight[a] : 0.0f;
    }
    lit->gloss = material->gloss;
    lit->reach = cgt_whitted_reach(s->position);
    lit->pixel = ray->pixel;
    lit->primitive = hit->primitive;
    lit->geometry = hit->geometry;
    lit->side = s->front ? WHITTED_OUTSIDE : WHITTED_INSIDE;
    lit->nested = ray->nested;
    memcpy(lit->inside, ray->inside, sizeof lit->inside);
    return true;
}

/* A camera that is inside a body of glass sees its surface from behind. */
static void find_camera(whitted_ray *ray, const whitted_surface *s)
{
    if (ray->side != WHITTED_CAMERA || s->front || s->material->kind != CGT_MATERIAL_GLASS)
        return;
    ray->inside[0] = s->body;
    ray->nested = 1;
}

/* One ray and what it met. Returns whether it set lit. */
static bool meet(const whitted *w, uint32_t bounce, whitted_ray *ray, const whitted_hit *hit, const whitted_surface *s,
                 whitted_next *next, whitted_lit *lit, float (*light)[3])
{
    double dir[3], facing[3];
    if (w->watch)
        w->watch(w->watch_user, bounce, ray, hit);
    if (hit->primitive == CGT_INVALID_ID) {
        add_sky(w, ray, light[ray->pixel]);
        return false;
    }
    find_camera(ray, s);
    absorb(w, ray, s->length);
    const double length = length_of(ray->dir);
    for (int a = 0; a < 3; a++) {
        dir[a] = (double)ray->dir[a] / length;
        facing[a] = s->front ? s->normal[a] : -s->normal[a];
    }
    const bool is_lit = set_lit(w, ray, hit, s, dir, facing, lit);
    if (s->material->kind == CGT_MATERIAL_MATTE)
        for (int c = 0; c < 3; c++)
            light[ray->pixel][c] += lit->matte[c] * w->ambient[c];
    else
        spawn(w, ray, hit, s, bounce, next, light[ray->pixel]);
    return is_lit;
}

/* ---- Waves -------------------------------------------------------------------------------------------------- */

static cgt_result trace_wave(const whitted *w, whitted_memory *m, uint32_t bounce, whitted_ray *ray, uint32_t count,
                             float (*light)[3]);

/* The rays of the next bounce, which are too many for one wave at times. */
static cgt_result trace_next(const whitted *w, whitted_memory *m, uint32_t bounce, whitted_ray *ray, uint32_t count,
                             float (*light)[3])
{
    cgt_result result = CGT_OK;
    for (uint32_t first = 0; first < count && result == CGT_OK; first += WHITTED_WAVE)
        result =
            trace_wave(w, m, bounce, ray + first, count - first < WHITTED_WAVE ? count - first : WHITTED_WAVE, light);
    return result;
}

/* What the rays of a wave bring whose hits and surfaces are known: memory->hit, surface. */
static cgt_result shade_wave(const whitted *w, whitted_memory *m, uint32_t bounce, whitted_ray *ray, uint32_t count,
                             float (*light)[3])
{
    whitted_next next = {.ray = bounce < w->bounces ? m->ray[bounce + 1] : NULL};
    uint32_t lit = 0;
    WHITTED_COUNT(w, rays[bounce], count);
    for (uint32_t i = 0; i < count; i++)
        lit += meet(w, bounce, &ray[i], &m->hit[i], &m->surface[i], &next, &m->lit[lit], light);
    cgt_result result = cgt_whitted_light_up(w, m, lit, light);
    if (result == CGT_OK && next.front)
        result = trace_next(w, m, bounce + 1, next.ray, next.front, light);
    if (result == CGT_OK && next.back)
        result = trace_next(w, m, bounce + 1, next.ray + NEXT_ROOM - next.back, next.back, light);
    return result;
}

static cgt_result trace_wave(const whitted *w, whitted_memory *m, uint32_t bounce, whitted_ray *ray, uint32_t count,
                             float (*light)[3])
{
    const cgt_result result = cgt_whitted_nearest(w, m, ray, count, m->hit, m->surface);
    return result ? result : shade_wave(w, m, bounce, ray, count, light);
}

/* Makes rays of the camera from memory->org and dir. */
static void begin(const whitted *w, whitted_memory *m, uint32_t count, float (*light)[3])
{
    memset(m->ray[0], 0, count * sizeof *m->ray[0]);
    for (uint32_t i = 0; i < count; i++) {
        whitted_ray *ray = &m->ray[0][i];
        memcpy(ray->org, m->org[i], sizeof ray->org);
        memcpy(ray->dir, m->dir[i], sizeof ray->dir);
        ray->t_max = INFINITY;
        ray->mask = w->mask;
        ray->skip_primitive = ray->skip_geometry = CGT_INVALID_ID;
        ray->pixel = m->pixel[i];
        for (int c = 0; c < 3; c++) {
            ray->weight[c] = 1.0f;
            light[ray->pixel][c] = 0.0f;
        }
    }
}

cgt_result cgt_whitted_shade(const whitted *w, whitted_memory *m, uint32_t count, float (*light)[3])
{
    begin(w, m, count, light);
    const cgt_result result = cgt_whitted_surfaces(w, m->ray[0], m->hit, count, m->surface);
    return result ? result : shade_wave(w, m, 0, m->ray[0], count, light);
}

cgt_result cgt_whitted_trace(const whitted *w, whitted_memory *m, uint32_t count, const float (*org)[3],
                             const float (*dir)[3], float (*light)[3])
{
    for (uint32_t i = 0; i < count; i++) {
        memcpy(m->org[i], org[i], sizeof m->org[i]);
        memcpy(m->dir[i], dir[i], sizeof m->dir[i]);
        m->pixel[i] = i;
    }
    begin(w, m, count, light);
    return trace_wave(w, m, 0, m->ray[0], count, light);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Geometries of a scene, and what the judge wants to know about it. */
#include <math.h>
#include <string.h>

#include "driver/scenes/scene_heap.h"

/* ---- the bits of coordinates ---- */

/* The exponents of the lowest bit that is set and the one above the highest one; false: the number is 0. */
static bool bits_of(float f, int *low, int *high)
{
    int exponent;
    if (f == 0)
        return false;
    const float m = frexpf(fabsf(f), &exponent);
    const uint32_t whole = (uint32_t)ldexpf(m, 24);
    *low = exponent - 24 + __builtin_ctz(whole);
    *high = exponent;
    return true;
}

void judge_widen_bits(float f, int *low, int *high)
{
    int l, h;
    if (!bits_of(f, &l, &h))
        return;
    *low = l < *low ? l : *low;
    *high = h > *high ? h : *high;
}

void judge_scene_measure(judge_scene *s)
{
    for (uint32_t i = 0; i < s->count; i += ORACLE_BLOCK)
        oracle_bound(s->primitive + i, s->count - i < ORACLE_BLOCK ? s->count - i : ORACLE_BLOCK,
                     &s->bounds[i / ORACLE_BLOCK]);
    s->low = 200;
    s->high = -200;
    for (uint32_t i = 0; i < s->count; i++)
        for (int k = 0; k < oracle_floats(s->primitive[i].kind) && !judge_is_broken(&s->primitive[i]); k++)
            judge_widen_bits(s->primitive[i].data[k], &s->low, &s->high);
}

/* ---- geometries ---- */

float *scene_heap_add(scene_heap *h, oracle_kind kind)
{
    static float nowhere[9];
    return h->count[kind] < JUDGE_PRIMITIVES / 2 ? h->data[kind][h->count[kind]++] : nowhere;
}

static void add_geometry(scene_heap *h, oracle_kind kind, uint32_t from, uint32_t count)
{
    judge_scene *s = h->scene;
    judge_geometry *g = &s->geometry[s->geometries];
    *g = (judge_geometry){.kind = kind, .first = s->count, .count = count};
    for (uint32_t i = 0; i < count; i++) {
        oracle_primitive *p = &s->primitive[s->count++];
        *p = (oracle_primitive){.kind = kind, .geometry = s->geometries, .primitive = i};
        memcpy(p->data, h->data[kind][from + i], sizeof p->data);
    }
    s->of_kind[kind] += count;
    s->geometries++;
}

/* How many of `all` go to a geometry of their own: of closed meshes all, or up to the seam between two. */
static uint32_t cut_at(const scene_heap *h, oracle_kind kind, uint32_t all)
{
    const bool closed = h->scene->closed && kind == ORACLE_TRIANGLE;
    if (random_below(h->r, 4) && !(closed && h->seam && random_below(h->r, 2)))
        return all;
    return !closed ? all / 2 : h->seam && h->seam < all ? h->seam : all;
}

/* The sorts in any order, some cut in two. */
static void make_geometries(scene_heap *h)
{
    const uint32_t first = random_below(h->r, JUDGE_KINDS);
    for (uint32_t k = 0; k < JUDGE_KINDS; k++) {
        const oracle_kind kind = (oracle_kind)((first + k) % JUDGE_KINDS);
        const uint32_t room = JUDGE_PRIMITIVES - h->scene->count, all = h->count[kind] < room ? h->count[kind] : room,
                       cut = cut_at(h, kind, all);
        if (random_below(h->r, 6) == 0)
            add_geometry(h, kind, 0, 0); /* an id without a primitive */
        if (cut)
            add_geometry(h, kind, 0, cut);
        if (all > cut)
            add_geometry(h, kind, cut, all - cut);
    }
    if (random_below(h->r, 3) == 0)
        for (uint32_t k = 0; k < h->scene->geometries; k++)
            h->scene->geometry[k].mask = random_below(h->r, 2) ? 1u << random_below(h->r, 4) : random_below(h->r, 4);
}

bool judge_is_broken(const oracle_primitive *p)
{
    for (int k = 0; k < oracle_floats(p->kind); k++)
        if (!isfinite(p->data[k]))
            return true;
    return p->kind != ORACLE_TRIANGLE && p->data[p->kind == ORACLE_SPHERE ? 3 : 6] < 0;
}

/* ---- scenes ---- */

/* Of a scene of any magnitude: that of one of its primitives. */
static float scale_of(scene_heap *h)
{
    const judge_scene *s = h->scene;
    const oracle_primitive *p = s->count ? &s->primitive[random_below(h->r, s->count)] : NULL;
    float largest = 0;
    for (int k = 0; p && !judge_is_broken(p) && k < oracle_floats(p->kind); k++)
        largest = fmaxf(largest, fabsf(p->data[k]));
    return largest > 0x1p-140f ? fminf(largest, 0x1p120f) : 1;
}

/* The group that has a family of a profile; *family becomes that of the group. */
static const scene_group *group_of(const scene_group *const *groups, uint32_t number, uint32_t *family)
{
    uint32_t families = 0, k = 0;
    for (uint32_t i = 0; i < SCENE_GROUPS && groups[i]; i++)
        families += groups[i]->families;
    *family = (*family == SCENE_ANY_FAMILY ? number : *family) % families;
    for (; *family >= groups[k]->families; k++)
        *family -= groups[k]->families;
    return groups[k];
}

void scene_make(judge_scene *s, test_random random, const scene_group *const *groups, uint32_t number, uint32_t family,
                uint32_t n)
{
    static scene_heap h;
    const scene_group *const group = group_of(groups, number, &family);
    memset(s, 0, sizeof *s);
    memset(&h, 0, sizeof h);
    s->random = random;
    s->number = number;
    s->family = group->name(family);
    s->scale = s->step = 1;
    s->axis = 3;
    h.scene = s;
    h.r = &s->random;
    h.n = 1 + random_below(h.r, n);
    group->make(&h, family);
    make_geometries(&h);
    judge_scene_measure(s);
    if (s->scale == 0)
        s->scale = scale_of(&h);
}

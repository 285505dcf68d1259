/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Loose grids built by the direct method. */
#include "exact/valid_primitive.h"
#include "tile/loose_reference.h"

#include <math.h>
#include <stdlib.h>

typedef struct box {
    double low[3], high[3];
} box;

static box box_of(const cgt_primitive *primitive)
{
    box b;
    for (int a = 0; a < 3; a++) {
        if (primitive->kind == CGT_KIND_SPHERES) {
            const double c[3] = {(double)primitive->sphere.x, (double)primitive->sphere.y, (double)primitive->sphere.z};
            b.low[a] = c[a] - (double)primitive->sphere.r;
            b.high[a] = c[a] + (double)primitive->sphere.r;
            continue;
        }
        const double x = (double)primitive->triangle.v[0][a], y = (double)primitive->triangle.v[1][a],
                     z = (double)primitive->triangle.v[2][a];
        b.low[a] = fmin(x, fmin(y, z));
        b.high[a] = fmax(x, fmax(y, z));
    }
    return b;
}

static double size_of(const box *b)
{
    double size = 0;
    for (int a = 0; a < 3; a++)
        size = fmax(size, 0.5 * (b->high[a] - b->low[a]));
    return size;
}

/* Visits the valid primitives, ascending. */
typedef void visit(void *user, uint32_t prim, const box *b);

static void visit_all(const cgt_primitives *prims, visit *each, void *user)
{
    for (uint32_t i = 0; i < prims->count; i++) {
        const cgt_primitive primitive = cgt_primitives_get(prims, i);
        if (cgt_primitive_check(&primitive) != CGT_PRIMITIVE_VALID)
            continue;
        const box b = box_of(&primitive);
        each(user, i, &b);
    }
}

/* A level before its layout. */
typedef struct plan {
    loose_reference *r;
    double largest;
    double low[CGT_LOOSE_LEVELS][3], high[CGT_LOOSE_LEVELS][3]; /* of the primitives' centres */
    double reach[CGT_LOOSE_LEVELS][3];
    uint32_t prims[CGT_LOOSE_LEVELS];
    uint32_t number[CGT_LOOSE_LEVELS]; /* of a class of sizes: its level */
    uint32_t *at;                      /* NULL: not yet */
} plan;

static void find_largest(void *user, uint32_t prim, const box *b)
{
    plan *p = user;
    (void)prim;
    p->largest = fmax(p->largest, size_of(b));
}

static uint32_t class_of(const plan *p, const box *b)
{
    const double size = size_of(b);
    double limit = p->largest / 4;
    uint32_t k = 0;
    for (; k < CGT_LOOSE_LEVELS - 1 && size <= limit; k++)
        limit /= 4;
    return k;
}

static void measure(void *user, uint32_t prim, const box *b)
{
    plan *p = user;
    const uint32_t k = class_of(p, b);
    (void)prim;
    for (int a = 0; a < 3; a++) {
        const double middle = 0.5 * (b->low[a] + b->high[a]);
        p->low[k][a] = p->prims[k] ? fmin(p->low[k][a], middle) : middle;
        p->high[k][a] = p->prims[k] ? fmax(p->high[k][a], middle) : middle;
    }
    p->prims[k]++;
}

static uint32_t cell_of(const cgt_loose_level *l, int a, double middle)
{
    const double k = floor((middle - (double)l->low[a]) / (double)l->cell[a]);
    return k < 0 ? 0 : k >= l->size[a] ? l->size[a] - 1 : (uint32_t)k;
}

static void count_one(void *user, uint32_t prim, const box *b)
{
    plan *p = user;
    const uint32_t class = class_of(p, b), number = p->number[class];
    cgt_loose_level *l = &p->r->grid.level[number];
    uint32_t at[3];
    for (int a = 0; a < 3; a++) {
        at[a] = cell_of(l, a, 0.5 * (b->low[a] + b->high[a]));
        const double low = (double)l->low[a] + at[a] * (double)l->cell[a], high = low + (double)l->cell[a];
        p->reach[number][a] = fmax(p->reach[number][a], fmax(low - b->low[a], b->high[a] - high));
    }
    const uint32_t cell = l->first + (at[2] * l->size[1] + at[1]) * l->size[0] + at[0];
    if (p->at)
        p->r->prim[p->at[cell]++] = prim;
    else
        p->r->start[cell + 1]++;
}

static void lay_out(plan *p, uint32_t class, double per_cell, cgt_loose_level *l)
{
    double extent[3], largest = 0, volume = 1;
    const double cells = fmax(p->prims[class] / per_cell, 1);
    for (int a = 0; a < 3; a++) {
        extent[a] = p->high[class][a] - p->low[class][a];
        largest = fmax(largest, extent[a]);
    }
    for (int a = 0; a < 3; a++)
        volume *= fmax(extent[a], 1e-3 * largest);
    const double edge = largest > 0 ? cbrt(volume / cells) : 1;
    for (int a = 0; a < 3; a++) {
        const double size = fmin(fmax(ceil(extent[a] / edge), 1), 200);
        l->size[a] = (uint32_t)size;
        l->low[a] = (float)p->low[class][a];
        l->cell[a] = fmaxf((float)(extent[a] / size), 0x1p-100f) * (1 + 0x1p-20f);
    }
    l->prims = p->prims[class];
    l->first = p->r->grid.cells;
    p->r->grid.cells += l->size[0] * l->size[1] * l->size[2];
}

bool loose_reference_make(const cgt_primitives *prims, double per_cell, loose_reference *r)
{
    plan p = {.r = r};
    *r = (loose_reference){0};
    visit_all(prims, find_largest, &p);
    visit_all(prims, measure, &p);
    for (uint32_t k = 0; k < CGT_LOOSE_LEVELS; k++) {
        p.number[k] = r->grid.levels;
        if (p.prims[k])
            lay_out(&p, k, per_cell, &r->grid.level[r->grid.levels++]);
    }
    r->start = calloc(r->grid.cells + 1, sizeof *r->start);
    r->prim = malloc((prims->count + 1) * sizeof *r->prim);
    uint32_t *at = malloc((r->grid.cells + 1) * sizeof *at);
    if (r->start && r->prim && at) {
        visit_all(prims, count_one, &p);
        for (uint32_t c = 0; c < r->grid.cells; c++)
            r->start[c + 1] += r->start[c];
        for (uint32_t c = 0; c <= r->grid.cells; c++)
            at[c] = r->start[c];
        p.at = at;
        visit_all(prims, count_one, &p);
        for (uint32_t k = 0; k < r->grid.levels; k++)
            for (int a = 0; a < 3; a++) /* including what rounding adds */
                r->grid.level[k].reach[a] =
                    (float)((p.reach[k][a] + fabs((double)r->grid.level[k].low[a]) * 0x1p-40) * (1 + 0x1p-20));
    }
    free(at);
    r->grid.start = r->start;
    r->grid.prim = r->prim;
    if (r->start && r->prim && at)
        return true;
    loose_reference_free(r);
    return false;
}

void loose_reference_free(loose_reference *r)
{
    free(r->start);
    free(r->prim);
    *r = (loose_reference){0};
}

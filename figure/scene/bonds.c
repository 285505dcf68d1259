/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bonds; see shapes.h. Those by distance are found through a hash of cells whose edges are the distance: neighbours
 * lie in the 27 cells around a sphere, of which half are looked at from each. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/shapes.h"
#include "sequence/periodic_box.h"

/* ---- One bond ----------------------------------------------------------------------------------------------- */

/* Two halves, which meet in the middle. */
static void add_bond(sticks *s, const bond_rules *r, const particles *p, uint32_t a, uint32_t b)
{
    const float *pa = p->xyzr + 4 * (size_t)a, *pb = p->xyzr + 4 * (size_t)b;
    const uint16_t ea = r->entry < 0 ? p->index[a] : (uint16_t)r->entry;
    const uint16_t eb = r->entry < 0 ? p->index[b] : (uint16_t)r->entry;
    cgt_sticks_add(s, pa, pb, cgt_sticks_visible(s, pa, cgt_sticks_visible(s, pb, r->radius)), ea, eb);
}

static float square_between(const float *a, const float *b)
{
    const float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

/* ---- Bonds of the file -------------------------------------------------------------------------------------- */

/* The image in which the other end of a bond is drawn, the first end being in the image `from`; UINT32_MAX: none. */
static uint32_t image_across(const uint32_t images[3], uint32_t from, const double count[3])
{
    const uint32_t at[3] = {from % images[0], from / images[0] % images[1], from / images[0] / images[1]};
    double other[3];
    for (int e = 0; e < 3; e++) {
        other[e] = (double)at[e] - count[e];
        if (other[e] < 0.0 || other[e] >= (double)images[e])
            return UINT32_MAX;
    }
    return (uint32_t)other[0] + images[0] * ((uint32_t)other[1] + images[1] * (uint32_t)other[2]);
}

/* The spheres are in the file's order, those that are not drawn left out, then come the images. */
static int add_file_bonds(sticks *s, const bond_rules *r, const cgt_trajectory_frame *f, const particles *p,
                          char *error, size_t error_size)
{
    const periodic_box box = cgt_periodic_box_of(f);
    const uint32_t copies = r->images[0] * r->images[1] * r->images[2], originals = p->count / copies;
    uint32_t *place = malloc(((size_t)f->count + 1) * sizeof *place);
    if (!place) {
        snprintf(error, error_size, "out of memory for bonds");
        return -1;
    }
    for (uint32_t i = 0; i < f->count; i++)
        place[i] = UINT32_MAX;
    for (uint32_t i = 0; i < originals; i++)
        place[p->source[i]] = i;
    for (uint32_t i = 0; i < f->bonds; i++) {
        const uint32_t a = place[f->bond[2 * (size_t)i]], b = place[f->bond[2 * (size_t)i + 1]];
        double count[3];
        if (a == UINT32_MAX || b == UINT32_MAX)
            continue;
        cgt_periodic_box_crossed(&box, p->xyzr + 4 * (size_t)a, p->xyzr + 4 * (size_t)b, count);
        for (uint32_t image = 0; image < copies; image++) {
            const uint32_t other = image_across(r->images, image, count);
            if (other != UINT32_MAX)
                add_bond(s, r, p, image * originals + a, other * originals + b);
        }
    }
    free(place);
    return 0;
}

/* ---- Covalent radii ------------------------------------------------------------------------------------------ */

/* Angstrom, in order of atomic numbers: B. Cordero, V. Gomez, A. E. Platero-Prats, M. Reves, J. Echeverria, E.
 * Cremades, F. Barragan, S. Alvarez, "Covalent radii revisited", Dalton Trans. (2008), 2832-2838, table 2; of carbon
 * sp3, of manganese, iron and cobalt low spin. */
static const float covalent[] = {
    0.31f, 0.28f, 1.28f, 0.96f, 0.84f, 0.76f, 0.71f, 0.66f, 0.57f, 0.58f, 1.66f, 1.41f, 1.21f, 1.11f, 1.07f, 1.05f,
    1.02f, 1.06f, 2.03f, 1.76f, 1.70f, 1.60f, 1.53f, 1.39f, 1.39f, 1.32f, 1.26f, 1.24f, 1.32f, 1.22f, 1.22f, 1.20f,
    1.19f, 1.20f, 1.20f, 1.16f, 2.20f, 1.95f, 1.90f, 1.75f, 1.64f, 1.54f, 1.47f, 1.46f, 1.42f, 1.39f, 1.45f, 1.44f,
    1.42f, 1.39f, 1.39f, 1.38f, 1.39f, 1.40f, 2.44f, 2.15f, 2.07f, 2.04f, 2.03f, 2.01f, 1.99f, 1.98f, 1.98f, 1.96f,
    1.94f, 1.92f, 1.92f, 1.89f, 1.90f, 1.87f, 1.87f, 1.75f, 1.70f, 1.62f, 1.51f, 1.44f, 1.41f, 1.36f, 1.36f, 1.32f,
    1.45f, 1.46f, 1.48f, 1.40f, 1.50f, 1.50f, 2.60f, 2.21f, 2.15f, 2.06f, 2.00f, 1.96f, 1.90f, 1.87f, 1.80f, 1.69f};
static const float tolerance = 0.45f, nearest = 0.4f; /* Angstrom, as Open Babel has them; nearer atoms are one */

/* 0: no element, or none that the table has. */
static float covalent_radius(uint8_t element)
{
    return element > 0 && element <= sizeof covalent / sizeof covalent[0] ? covalent[element - 1] : 0.0f;
}

/* How spheres are bonded by their distance. */
typedef struct near_rule {
    float longest;                     /* bond */
    const cgt_trajectory_frame *atoms; /* pairs of covalent radii decide; NULL: longest alone */
    const uint32_t *source;            /* of particles */
} near_rule;

static near_rule rule_by_elements(const cgt_trajectory_frame *f, const particles *p)
{
    float largest = 0.0f;
    for (uint32_t i = 0; i < p->count; i++)
        largest = fmaxf(largest, covalent_radius(f->element[p->source[i]]));
    return (near_rule){.longest = (2.0f * largest + tolerance) * f->angstrom, .atoms = f, .source = p->source};
}

static int is_bonded(const near_rule *n, uint32_t a, uint32_t b, float square)
{
    if (!(square <= n->longest * n->longest))
        return 0;
    if (!n->atoms)
        return 1;
    const float ra = covalent_radius(n->atoms->element[n->source[a]]);
    const float rb = covalent_radius(n->atoms->element[n->source[b]]);
    const float least = nearest * n->atoms->angstrom, most = (ra + rb + tolerance) * n->atoms->angstrom;
    return ra > 0.0f && rb > 0.0f && square >= least * least && square <= most * most;
}

/* ---- Bonds by distance -------------------------------------------------------------------------------------- */

typedef struct cell_hash {
    uint32_t mask;      /* of the hash: buckets - 1 */
    uint32_t *begin;    /* of each bucket in `sphere`, and the end of the last */
    uint32_t *sphere;   /* by buckets; those at places that are not finite are left out */
    int32_t (*cell)[3]; /* of each sphere */
} cell_hash;

static int32_t cell_of(float x, float edge)
{
    const double cell = floor((double)x / (double)edge);
    return cell < -1e9 ? -1000000000 : cell > 1e9 ? 1000000000 : (int32_t)cell; /* NaN is never asked for */
}

static uint32_t bucket_of(const cell_hash *h, const int32_t cell[3])
{
    uint32_t key = (uint32_t)cell[0] * 73856093u ^ (uint32_t)cell[1] * 19349663u ^ (uint32_t)cell[2] * 83492791u;
    key ^= key >> 15;
    return key & h->mask;
}

static int is_finite(const float *p) { return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]); }

static void fill(cell_hash *h, const particles *p, float edge)
{
    memset(h->begin, 0, ((size_t)h->mask + 2) * sizeof *h->begin);
    for (uint32_t i = 0; i < p->count; i++) {
        const float *at = p->xyzr + 4 * (size_t)i;
        for (int c = 0; c < 3 && is_finite(at); c++)
            h->cell[i][c] = cell_of(at[c], edge);
        if (is_finite(at))
            h->begin[bucket_of(h, h->cell[i])]++;
    }
    for (uint32_t i = 0; i <= h->mask; i++)
        h->begin[i + 1] += h->begin[i];
    for (uint32_t i = p->count; i-- > 0;) /* from the last to the first: begin[] moves from ends to beginnings */
        if (is_finite(p->xyzr + 4 * (size_t)i))
            h->sphere[--h->begin[bucket_of(h, h->cell[i])]] = i;
}

/* Bonds from sphere i to those in a cell; in its own to those after it. Two cells may share a bucket. */
static void add_from_cell(sticks *s, const bond_rules *r, const near_rule *n, const particles *p, const cell_hash *h,
                          uint32_t i, const int32_t cell[3], int is_own)
{
    const uint32_t bucket = bucket_of(h, cell);
    for (uint32_t at = h->begin[bucket]; at < h->begin[bucket + 1]; at++) {
        const uint32_t k = h->sphere[at];
        const int32_t *other = h->cell[k];
        if (other[0] != cell[0] || other[1] != cell[1] || other[2] != cell[2] || (is_own && k <= i) ||
            !is_bonded(n, i, k, square_between(p->xyzr + 4 * (size_t)i, p->xyzr + 4 * (size_t)k)))
            continue;
        add_bond(s, r, p, i < k ? i : k, i < k ? k : i);
    }
}

static int add_near_bonds(sticks *s, const bond_rules *r, const near_rule *n, const particles *p, char *error,
                          size_t error_size)
{
    cell_hash h = {.mask = 63};
    while (h.mask < p->count && h.mask < 0x7fffffff)
        h.mask = 2 * h.mask + 1;
    h.begin = malloc(((size_t)h.mask + 2) * sizeof *h.begin);
    h.sphere = malloc(((size_t)p->count + 1) * sizeof *h.sphere);
    h.cell = calloc((size_t)p->count + 1, sizeof *h.cell);
    const int enough = h.begin && h.sphere && h.cell;
    if (enough)
        fill(&h, p, n->longest);
    for (uint32_t i = 0; i < p->count && enough && !s->failed; i++)
        for (int k = 13; k < 27 && is_finite(p->xyzr + 4 * (size_t)i); k++) { /* its own, and half of those around it */
            const int32_t *own = h.cell[i];
            const int32_t cell[3] = {own[0] + k % 3 - 1, own[1] + k / 3 % 3 - 1, own[2] + k / 9 - 1};
            add_from_cell(s, r, n, p, &h, i, cell, k == 13);
        }
    free(h.begin);
    free(h.sphere);
    free(h.cell);
    if (!enough)
        snprintf(error, error_size, "out of memory for bonds");
    return enough ? 0 : -1;
}

int cgt_shapes_add_bonds(sticks *s, const bond_rules *r, const cgt_trajectory_frame *f, const particles *p, char *error,
                         size_t error_size)
{
    const near_rule given = {.longest = r->distance};
    if (r->distance > 0.0f)
        return add_near_bonds(s, r, &given, p, error, error_size);
    if (f->bond)
        return add_file_bonds(s, r, f, p, error, error_size);
    if (!f->element) {
        snprintf(error, error_size, "--bonds: the file has no bonds; give the longest distance of two that are bonded");
        return -1;
    }
    const near_rule guessed = rule_by_elements(f, p);
    return add_near_bonds(s, r, &guessed, p, error, error_size);
}

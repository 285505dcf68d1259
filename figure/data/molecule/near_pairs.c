/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Near spheres, through a hash of cells whose edges are the distance: neighbours lie in the 27 cells around a sphere,
 * of which half are looked at from each. */
#include "data/molecule/near_pairs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct cell_hash {
    const float *xyzr;
    uint32_t count;
    float longest;
    uint32_t mask;      /* of the hash: buckets - 1 */
    uint32_t *begin;    /* of each bucket in `sphere`, and the end of the last */
    uint32_t *sphere;   /* by buckets; those at places that are not finite are left out */
    int32_t (*cell)[3]; /* of each sphere */
} cell_hash;

static float square_between(const float *a, const float *b)
{
    const float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

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

static void fill(cell_hash *h)
{
    memset(h->begin, 0, ((size_t)h->mask + 2) * sizeof *h->begin);
    for (uint32_t i = 0; i < h->count; i++) {
        const float *at = h->xyzr + 4 * (size_t)i;
        for (int c = 0; c < 3 && is_finite(at); c++)
            h->cell[i][c] = cell_of(at[c], h->longest);
        if (is_finite(at))
            h->begin[bucket_of(h, h->cell[i])]++;
    }
    for (uint32_t i = 0; i <= h->mask; i++)
        h->begin[i + 1] += h->begin[i];
    for (uint32_t i = h->count; i-- > 0;) /* from the last to the first: begin[] moves from ends to beginnings */
        if (is_finite(h->xyzr + 4 * (size_t)i))
            h->sphere[--h->begin[bucket_of(h, h->cell[i])]] = i;
}

/* Pairs of sphere i with those in a cell; in its own with those after it. Two cells may share a bucket. */
static int take_from_cell(const cell_hash *h, uint32_t i, const int32_t cell[3], int is_own,
                          int (*take)(void *user, uint32_t first, uint32_t second, float square), void *user)
{
    const uint32_t bucket = bucket_of(h, cell);
    int failed = 0;
    for (uint32_t at = h->begin[bucket]; at < h->begin[bucket + 1] && !failed; at++) {
        const uint32_t k = h->sphere[at];
        const int32_t *other = h->cell[k];
        if (other[0] != cell[0] || other[1] != cell[1] || other[2] != cell[2] || (is_own && k <= i))
            continue;
        const float square = square_between(h->xyzr + 4 * (size_t)i, h->xyzr + 4 * (size_t)k);
        if (square <= h->longest * h->longest)
            failed = take(user, i < k ? i : k, i < k ? k : i, square);
    }
    return failed;
}

int cgt_near_pairs_find(const float *xyzr, uint32_t count, float longest,
                        int (*take)(void *user, uint32_t first, uint32_t second, float square), void *user)
{
    cell_hash h = {.xyzr = xyzr, .count = count, .longest = longest, .mask = 63};
    while (h.mask < count && h.mask < 0x7fffffff)
        h.mask = 2 * h.mask + 1;
    h.begin = malloc(((size_t)h.mask + 2) * sizeof *h.begin);
    h.sphere = malloc(((size_t)count + 1) * sizeof *h.sphere);
    h.cell = calloc((size_t)count + 1, sizeof *h.cell);
    int failed = !h.begin || !h.sphere || !h.cell;
    if (!failed)
        fill(&h);
    for (uint32_t i = 0; i < count && !failed; i++)
        for (int k = 13; k < 27 && is_finite(xyzr + 4 * (size_t)i) && !failed; k++) { /* its own, and half around it */
            const int32_t *own = h.cell[i];
            const int32_t cell[3] = {own[0] + k % 3 - 1, own[1] + k / 3 % 3 - 1, own[2] + k / 9 - 1};
            failed = take_from_cell(&h, i, cell, k == 13, take, user);
        }
    free(h.begin);
    free(h.sphere);
    free(h.cell);
    return failed ? -1 : 0;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Trails: where spheres were in the frames before, as tubes that get thinner; see figures.h. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "picture/figures/figures.h"

enum { MANY_PLACES = 1 << 17 }; /* in all trails together: from there on tubes have fewer sides */

static const float tail = 0.15f;          /* of the radius that is left at the end of the trail */
static const float default_radius = 0.2f; /* as a share of the sphere's */
static const float shortest = 0.5f;       /* piece, as a share of the radius: places so near are one */

/* ---- The periodic boundary ---------------------------------------------------------------------------------- */

/* From a difference of places to shares of the box's edges; edges that are not periodic have a row of zeros. */
typedef struct box_shares {
    double row[3][3];
} box_shares;

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static box_shares shares_of(const trajectory_frame *f)
{
    box_shares s;
    memset(&s, 0, sizeof s);
    for (int e = 0; e < 3; e++) {
        double normal[3], volume = 0.0;
        cross(f->box_edge[(e + 1) % 3], f->box_edge[(e + 2) % 3], normal);
        for (int c = 0; c < 3; c++)
            volume += normal[c] * f->box_edge[e][c];
        for (int c = 0; c < 3 && volume != 0.0 && f->periodic[e] != 0; c++)
            s.row[e][c] = normal[c] / volume;
    }
    return s;
}

/* Whether a sphere has gone through the boundary from one frame to the next: half of an edge or more is too far for a
 * step. */
static int has_jumped(const box_shares *s, const float a[3], const float b[3])
{
    for (int e = 0; e < 3; e++) {
        double share = 0.0;
        for (int c = 0; c < 3; c++)
            share += s->row[e][c] * ((double)b[c] - (double)a[c]);
        if (fabs(share) >= 0.5)
            return 1;
    }
    return 0;
}

/* ---- One trail ---------------------------------------------------------------------------------------------- */

static float distance(const float a[3], const float b[3])
{
    const float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrtf(x * x + y * y + z * z);
}

typedef struct trail {
    float place[TRAIL_LONGEST + 1][3];
    float radius[TRAIL_LONGEST + 1];
    float kept[TRAIL_LONGEST + 1][3]; /* of the piece between two jumps, what is far enough apart */
    float kept_radius[TRAIL_LONGEST + 1];
} trail;

/* Whether the sphere hides its trail, as it does where it hardly moves. */
static int is_hidden(const trail *t, uint32_t count, const float *sphere)
{
    for (uint32_t k = 0; k < count; k++)
        if (!(distance(t->place[k], sphere) + t->radius[k] < sphere[3]))
            return 0;
    return 1;
}

/* The piece from place `first` up to the next jump. Returns where the next piece begins. */
static uint32_t add_piece(tubes *out, trail *t, const box_shares *shares, uint32_t first, uint32_t count,
                          uint16_t entry)
{
    uint32_t kept = 0, k = first;
    for (; k < count && (k == first || !has_jumped(shares, t->place[k - 1], t->place[k])); k++) {
        if (kept && distance(t->place[k], t->kept[kept - 1]) < shortest * t->radius[k])
            continue;
        memcpy(t->kept[kept], t->place[k], sizeof t->kept[kept]);
        t->kept_radius[kept++] = t->radius[k];
    }
    tubes_add_path(out, (const float(*)[3])t->kept, t->kept_radius, kept, entry);
    return k;
}

/* Returns the number of its places. */
static uint32_t add_trail(tubes *out, const trail_rules *r, const box_shares *shares, const particles *p, uint32_t i,
                          const float *original, trail *t)
{
    const float *sphere = p->xyzr + 4 * (size_t)i;
    const float radius = r->radius > 0.0f ? r->radius : default_radius * sphere[3];
    const uint32_t count = trail_history_places(r->history, p->source[i], t->place);
    for (uint32_t k = 0; k < count; k++) {
        const float age = (float)k / (float)trail_history_length(r->history);
        t->radius[k] = radius * (1.0f - (1.0f - tail) * age);
        for (int c = 0; c < 3; c++) /* of an image: as far off as its sphere */
            t->place[k][c] += sphere[c] - original[c];
    }
    if (!(radius > 0.0f) || is_hidden(t, count, sphere))
        return 0;
    const uint16_t entry = r->entry < 0 ? p->index[i] : (uint16_t)r->entry;
    for (uint32_t k = 0; k < count;)
        k = add_piece(out, t, shares, k, count, entry);
    return count;
}

int figures_add_trails(tubes *out, const trail_rules *r, const trajectory_frame *f, const particles *p, char *error,
                       size_t error_size)
{
    const box_shares shares = shares_of(f);
    const uint64_t most = (uint64_t)p->count * trail_history_length(r->history);
    const uint32_t sides = out->sides;
    trail *t = malloc(sizeof *t);
    uint64_t places = 0;
    if (!t) {
        snprintf(error, error_size, "out of memory for trails");
        return -1;
    }
    out->sides = most < MANY_PLACES ? 8 : 6;
    for (uint32_t i = 0; i < p->count && places <= FIGURES_MOST_PLACES; i++)
        places += add_trail(out, r, &shares, p, i, f->xyzr + 4 * (size_t)p->source[i], t);
    out->sides = sides;
    free(t);
    if (places <= FIGURES_MOST_PLACES)
        return 0;
    snprintf(error, error_size,
             "--trails: frame %llu: more than %d places of spheres that move: give fewer frames, or show fewer spheres",
             (unsigned long long)f->number, FIGURES_MOST_PLACES);
    return -1;
}

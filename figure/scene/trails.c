/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Trails: where spheres were in the frames before, as capsules that get thinner; see shapes.h. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/shapes.h"
#include "sequence/periodic_box.h"

static const float tail = 0.15f;          /* of the radius that is left at the end of the trail */
static const float default_radius = 0.2f; /* as a share of the sphere's */
static const float shortest = 0.5f;       /* piece, as a share of the radius: places so near are one */

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
static uint32_t add_piece(sticks *out, trail *t, const periodic_box *box, uint32_t first, uint32_t count,
                          uint16_t entry)
{
    uint32_t kept = 0, k = first;
    double crossed[3];
    for (; k < count && (k == first || !cgt_periodic_box_crossed(box, t->place[k - 1], t->place[k], crossed)); k++) {
        if (kept && distance(t->place[k], t->kept[kept - 1]) < shortest * t->radius[k])
            continue;
        memcpy(t->kept[kept], t->place[k], sizeof t->kept[kept]);
        t->kept_radius[kept++] = t->radius[k];
    }
    for (uint32_t i = 1; i < kept; i++)
        cgt_sticks_add(out, t->kept[i - 1], t->kept[i], 0.5f * (t->kept_radius[i - 1] + t->kept_radius[i]), entry,
                       entry);
    return k;
}

/* Returns the number of its places. */
static uint32_t add_trail(sticks *out, const trail_rules *r, const periodic_box *box, const particles *p, uint32_t i,
                          const float *original, trail *t)
{
    const float *sphere = p->xyzr + 4 * (size_t)i;
    const float radius = r->radius > 0.0f ? r->radius : default_radius * sphere[3];
    const uint32_t count = cgt_trail_history_places(r->history, p->source[i], t->place);
    for (uint32_t k = 0; k < count; k++) {
        const float age = (float)k / (float)cgt_trail_history_length(r->history);
        t->radius[k] = radius * (1.0f - (1.0f - tail) * age);
        for (int c = 0; c < 3; c++) /* of an image: as far off as its sphere */
            t->place[k][c] += sphere[c] - original[c];
        t->radius[k] = cgt_sticks_visible(out, t->place[k], t->radius[k]);
    }
    if (!(radius > 0.0f) || is_hidden(t, count, sphere))
        return 0;
    const uint16_t entry = r->entry < 0 ? p->index[i] : (uint16_t)r->entry;
    for (uint32_t k = 0; k < count;)
        k = add_piece(out, t, box, k, count, entry);
    return count;
}

int cgt_shapes_add_trails(sticks *out, const trail_rules *r, const cgt_trajectory_frame *f, const particles *p,
                          char *error, size_t error_size)
{
    const periodic_box box = cgt_periodic_box_of(f);
    trail *t = malloc(sizeof *t);
    uint64_t places = 0;
    if (!t) {
        snprintf(error, error_size, "out of memory for trails");
        return -1;
    }
    for (uint32_t i = 0; i < p->count && places <= SHAPES_MOST_PLACES; i++)
        places += add_trail(out, r, &box, p, i, f->xyzr + 4 * (size_t)p->source[i], t);
    free(t);
    if (places <= SHAPES_MOST_PLACES)
        return 0;
    snprintf(error, error_size,
             "--trails: frame %llu: more than %d places of spheres that move: give fewer frames, or show fewer spheres",
             (unsigned long long)f->number, SHAPES_MOST_PLACES);
    return -1;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bonds; see shapes.h. */
#include <stdio.h>
#include <stdlib.h>

#include "data/molecule/bond_guess.h"
#include "data/molecule/near_pairs.h"
#include "scene/shapes.h"
#include "sequence/periodic_box.h"

/* ---- One bond ----------------------------------------------------------------------------------------------- */

static int is_left_out(const bond_rules *r, const particles *p, uint32_t a, uint32_t b)
{
    const uint32_t one = p->layer ? p->layer[a] : 0, other = p->layer ? p->layer[b] : 0;
    if (!r->opacity)
        return 0;
    return (r->layer >= 0 ? (uint32_t)r->layer : r->opacity[one] <= r->opacity[other] ? one : other) != r->only;
}

/* Two halves, which meet in the middle. */
static void add_bond(sticks *s, const bond_rules *r, const particles *p, uint32_t a, uint32_t b)
{
    if (is_left_out(r, p, a, b))
        return;
    const float *pa = p->xyzr + 4 * (size_t)a, *pb = p->xyzr + 4 * (size_t)b;
    const uint16_t ea = r->entry < 0 ? p->index[a] : (uint16_t)r->entry;
    const uint16_t eb = r->entry < 0 ? p->index[b] : (uint16_t)r->entry;
    cgt_sticks_add(s, pa, pb, cgt_sticks_visible(s, pa, cgt_sticks_visible(s, pb, r->radius)), ea, eb);
}

/* ---- Bonds of the frame ------------------------------------------------------------------------------------- */

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

typedef struct frame_bonds {
    sticks *s;
    const bond_rules *r;
    const particles *p;
    uint32_t copies, originals;
    uint32_t *place; /* among the spheres that are drawn; UINT32_MAX: it is not */
} frame_bonds;

/* Adds a bond in each image that has both ends. */
static int add_image_bond(void *user, uint32_t a, uint32_t b, const double count[3])
{
    const frame_bonds *const f = user;
    const uint32_t from = f->place[a], to = f->place[b];
    for (uint32_t image = 0; image < f->copies && from != UINT32_MAX && to != UINT32_MAX; image++) {
        const uint32_t other = image_across(f->r->images, image, count);
        if (other == UINT32_MAX && f->r->cut)
            ++*f->r->cut;
        if (other != UINT32_MAX)
            add_bond(f->s, f->r, f->p, image * f->originals + from, other * f->originals + to);
    }
    return f->s->failed ? -1 : 0;
}

/* The spheres are in the file's order, those that are not drawn left out, then come the images. */
static int add_frame_bonds(sticks *s, const bond_rules *r, const cgt_trajectory_frame *f, const particles *p)
{
    const periodic_box box = cgt_periodic_box_of(f);
    frame_bonds to = {.s = s, .r = r, .p = p, .copies = r->images[0] * r->images[1] * r->images[2]};
    to.originals = p->count / to.copies;
    to.place = malloc(((size_t)f->count + 1) * sizeof *to.place);
    if (!to.place)
        return -1;
    for (uint32_t i = 0; i < f->count; i++)
        to.place[i] = UINT32_MAX;
    for (uint32_t i = 0; i < to.originals; i++)
        to.place[p->source[i]] = i;
    int failed = 0;
    for (uint32_t i = 0; i < f->bonds && !failed; i++) {
        const uint32_t a = f->bond[2 * (size_t)i], b = f->bond[2 * (size_t)i + 1];
        double count[3];
        cgt_periodic_box_crossed(&box, f->xyzr + 4 * (size_t)a, f->xyzr + 4 * (size_t)b, count);
        failed = add_image_bond(&to, a, b, count);
    }
    failed = failed || cgt_guess_image_bonds(f, add_image_bond, &to);
    free(to.place);
    return failed ? -1 : 0;
}

/* ---- Bonds by distance -------------------------------------------------------------------------------------- */

typedef struct near_bonds {
    sticks *s;
    const bond_rules *r;
    const particles *p;
} near_bonds;

static int add_near_bond(void *user, uint32_t first, uint32_t second, float square)
{
    const near_bonds *const n = user;
    (void)square;
    add_bond(n->s, n->r, n->p, first, second);
    return n->s->failed ? -1 : 0;
}

int cgt_shapes_add_bonds(sticks *s, const bond_rules *r, const cgt_trajectory_frame *f, const particles *p, char *error,
                         size_t error_size)
{
    near_bonds near = {s, r, p};
    const int has_bonds = f->bonds > 0 || f->bond_source == CGT_TRAJECTORY_BONDS_GUESSED; /* to own images alone */
    const int failed = r->distance > 0.0f ? cgt_near_pairs_find(p->xyzr, p->count, r->distance, add_near_bond, &near)
                       : has_bonds        ? add_frame_bonds(s, r, f, p)
                                          : 0;
    if (failed && !s->failed) {
        snprintf(error, error_size, "out of memory for bonds");
        return -1;
    }
    return 0;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whole molecules; see unwrap.h. Bonds join trees of spheres, each with the number of edges by which it is to be moved
 * against its parent: R. E. Tarjan, "Applications of Path Compression on Balanced Trees", J. ACM 26 (1979), 690-715.
 * The root of a tree is the first of its spheres in the file. Without image flags spheres are followed from frame to
 * frame: each to the nearest image by its shares of the box, whatever the box does. */
#include "data/frame_access.h"
#include "sequence/unwrap.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "data/molecule/bond_guess.h"
#include "sequence/id_match.h"
#include "sequence/periodic_box.h"

typedef struct molecule_sum {
    double place[3];
    uint32_t count; /* of spheres at finite places */
} molecule_sum;

/* How the spheres of a run are unwrapped: its first frame decides. */
typedef enum unwrap_way { WAY_UNKNOWN = 0, WAY_FLAGS, WAY_FOLLOWED } unwrap_way;

/* Where the spheres of the frame before were. */
typedef struct unwrap_past {
    int is_there;
    id_match spheres;
    size_t capacity;
    double (*share)[3]; /* of the edges, as the file has the places */
    double (*move)[3];  /* edges to add */
} unwrap_past;

struct unwrapping {
    unwrap_mode mode;
    unwrap_way way;
    unwrap_past past; /* where spheres are followed */
    size_t capacity;  /* spheres */
    float *xyzr;
    uint32_t *parent;
    double (*move)[3];   /* edges to add, against the parent's */
    uint8_t *is_endless; /* the molecule whose root this is has no end */
    molecule_sum *sum;   /* of the molecule whose root this is */
};

unwrapping *cgt_unwrap_create(unwrap_mode mode)
{
    unwrapping *const u = calloc(1, sizeof *u);
    if (u)
        u->mode = mode;
    return u;
}

static void free_arrays(unwrapping *u)
{
    free(u->xyzr);
    free(u->parent);
    free(u->move);
    free(u->is_endless);
    free(u->sum);
    u->xyzr = NULL;
    u->parent = NULL;
    u->move = NULL;
    u->is_endless = NULL;
    u->sum = NULL;
    u->capacity = 0;
}

void cgt_unwrap_release(unwrapping *u)
{
    if (u) {
        free_arrays(u);
        cgt_id_match_free(&u->past.spheres);
        free(u->past.share);
        free(u->past.move);
    }
    free(u);
}

void cgt_unwrap_restart(unwrapping *u) { u->past.is_there = 0; }

int cgt_unwrap_follows(const unwrapping *u) { return u->mode == UNWRAP_IMAGES && u->way == WAY_FOLLOWED; }

int cgt_unwrap_needs_all(const unwrapping *u) { return u->mode == UNWRAP_IMAGES && u->way != WAY_FLAGS; }

static int reserve(unwrapping *u, size_t count)
{
    if (count <= u->capacity && u->xyzr)
        return 0;
    free_arrays(u);
    u->xyzr = malloc((count + 1) * 4 * sizeof *u->xyzr);
    u->parent = malloc((count + 1) * sizeof *u->parent);
    u->move = malloc((count + 1) * sizeof *u->move);
    u->is_endless = malloc(count + 1);
    u->sum = u->mode == UNWRAP_WHOLE ? malloc((count + 1) * sizeof *u->sum) : NULL;
    if (!u->xyzr || !u->parent || !u->move || !u->is_endless || (u->mode == UNWRAP_WHOLE && !u->sum)) {
        free_arrays(u);
        return -1;
    }
    u->capacity = count;
    return 0;
}

/* ---- Image flags -------------------------------------------------------------------------------------------- */

static const char *const flags[] = {"ix", "iy", "iz", "image_x", "image_y", "image_z"};

const char *const *cgt_unwrap_columns(size_t *count)
{
    *count = sizeof flags / sizeof flags[0];
    return flags;
}

/* All three columns of flags, or none: 1 or 0. */
static int find_flags(const cgt_trajectory_frame *f, const float *value[3])
{
    for (size_t first = 0; first < sizeof flags / sizeof flags[0]; first += 3) {
        int found = 1;
        for (size_t e = 0; e < 3; e++) {
            const cgt_trajectory_column *const column = frame_column(f, flags[first + e]);
            value[e] = column && column->kind != CGT_TRAJECTORY_WORD ? column->value : NULL;
            found &= value[e] != NULL;
        }
        if (found)
            return 1;
    }
    return 0;
}

static void take_flags(unwrapping *u, const cgt_trajectory_frame *f, const float *const value[3])
{
    for (uint32_t i = 0; i < f->count; i++)
        for (int e = 0; e < 3; e++)
            u->move[i][e] = isfinite(value[e][i]) ? (double)value[e][i] : 0.0;
}

/* ---- Molecules ---------------------------------------------------------------------------------------------- */

/* The root of a sphere, which becomes its parent; u->move[i] is then against the root, whose own is 0. */
static uint32_t find_root(unwrapping *u, uint32_t i)
{
    uint32_t root = i;
    double sum[3] = {0.0, 0.0, 0.0};
    while (u->parent[root] != root) {
        for (int e = 0; e < 3; e++)
            sum[e] += u->move[root][e];
        root = u->parent[root];
    }
    while (u->parent[i] != root && i != root) {
        const uint32_t next = u->parent[i];
        for (int e = 0; e < 3; e++) {
            const double own = u->move[i][e];
            u->move[i][e] = sum[e];
            sum[e] -= own;
        }
        u->parent[i] = root;
        i = next;
    }
    return root;
}

/* Joins the molecules of both ends, b being in the image that the count tells. One that a bond leads back to at another
 * image has no end. */
static int join(void *user, uint32_t a, uint32_t b, const double count[3])
{
    unwrapping *const u = user;
    double between[3]; /* what the root of b must be moved by against that of a */
    const uint32_t ra = find_root(u, a), rb = find_root(u, b);
    int differs = 0;
    for (int e = 0; e < 3; e++) {
        between[e] = u->move[a][e] - count[e] - u->move[b][e];
        differs |= between[e] != 0.0;
    }
    u->is_endless[ra] |= ra == rb && differs;
    if (ra == rb)
        return 0;
    const int a_first = ra < rb;
    u->is_endless[a_first ? ra : rb] |= u->is_endless[a_first ? rb : ra];
    u->parent[a_first ? rb : ra] = a_first ? ra : rb;
    for (int e = 0; e < 3; e++)
        u->move[a_first ? rb : ra][e] = a_first ? between[e] : -between[e];
    return 0;
}

static void add_edges(const periodic_box *box, const double count[3], double place[3])
{
    for (int c = 0; c < 3; c++)
        place[c] += count[0] * box->edge[0][c] + count[1] * box->edge[1][c] + count[2] * box->edge[2][c];
}

/* The edges by which the middle of a molecule's spheres is outside of the box. */
static void move_of_middle(const periodic_box *box, const cgt_trajectory_frame *f, const molecule_sum *sum,
                           double move[3])
{
    for (int e = 0; e < 3; e++) {
        double share = 0.0;
        for (int c = 0; c < 3 && sum->count; c++)
            share += box->row[e][c] * (sum->place[c] / sum->count - f->box_origin[c]);
        move[e] = isfinite(share) ? -floor(share) : 0.0;
    }
}

/* Moves each molecule so that its middle is in the box. */
static void center(unwrapping *u, const periodic_box *box, const cgt_trajectory_frame *f)
{
    /* NOLINTNEXTLINE(clang-analyzer-core.NonNullParamChecker): a frame with spheres has reserved it */
    memset(u->sum, 0, f->count * sizeof *u->sum);
    for (uint32_t i = 0; i < f->count; i++) {
        const float *const p = f->xyzr + 4 * (size_t)i;
        double place[3] = {(double)p[0], (double)p[1], (double)p[2]};
        molecule_sum *const sum = &u->sum[u->parent[i]];
        add_edges(box, u->move[i], place);
        if (!isfinite(place[0] + place[1] + place[2]))
            continue;
        for (int c = 0; c < 3; c++)
            sum->place[c] += place[c];
        sum->count++;
    }
    for (uint32_t i = 0; i < f->count; i++) {
        double more[3];
        move_of_middle(box, f, &u->sum[u->parent[i]], more);
        for (int e = 0; e < 3 && !u->is_endless[u->parent[i]]; e++)
            u->move[i][e] += more[e];
    }
}

/* Sets whether a molecule has no end: that stays as the file has it. Returns 0, or -1: no memory. */
static int join_bonds(unwrapping *u, const periodic_box *box, const cgt_trajectory_frame *f, int *endless)
{
    for (uint32_t i = 0; i < f->count; i++)
        u->parent[i] = i;
    memset(u->move, 0, f->count * sizeof *u->move);
    memset(u->is_endless, 0, f->count);
    for (size_t i = 0; i < f->bonds; i++) {
        const uint32_t a = f->bond[2 * i], b = f->bond[2 * i + 1];
        double count[3];
        cgt_periodic_box_crossed(box, f->xyzr + 4 * (size_t)a, f->xyzr + 4 * (size_t)b, count);
        join(u, a, b, count);
    }
    if (cgt_guess_image_bonds(f, join, u))
        return -1;
    for (uint32_t i = 0; i < f->count; i++)
        if (u->is_endless[find_root(u, i)]) {
            memset(u->move[i], 0, sizeof u->move[i]);
            *endless = 1;
        }
    return 0;
}

/* ---- From frame to frame --------------------------------------------------------------------------------------- */

static int reserve_past(unwrap_past *past, size_t count)
{
    if (count <= past->capacity && past->share)
        return 0;
    double(*const share)[3] = realloc(past->share, (count + 1) * sizeof *share);
    past->share = share ? share : past->share;
    double(*const move)[3] = realloc(past->move, (count + 1) * sizeof *move);
    past->move = move ? move : past->move;
    if (!share || !move)
        return -1;
    past->capacity = count;
    return 0;
}

/* The edges to add to sphere i, which was number k of the frame before. */
static void follow_sphere(unwrapping *u, const periodic_box *box, const double share[3], uint32_t i, uint32_t k)
{
    double jump[3], step[3] = {0.0, 0.0, 0.0}, count[3];
    for (int e = 0; e < 3; e++)
        jump[e] = share[e] - u->past.share[k][e];
    add_edges(box, jump, step);
    cgt_periodic_box_count(box, step, count);
    for (int e = 0; e < 3; e++)
        u->move[i][e] = u->past.move[k][e] - count[e];
}

/* From the box's corner: those of far boxes whose edges change would jump. */
static void share_of(const periodic_box *box, const cgt_trajectory_frame *f, uint32_t i, double share[3])
{
    const float *const p = f->xyzr + 4 * (size_t)i;
    const double place[3] = {(double)p[0] - f->box_origin[0], (double)p[1] - f->box_origin[1],
                             (double)p[2] - f->box_origin[2]};
    for (int e = 0; e < 3; e++)
        share[e] = cgt_periodic_box_share(box, e, place);
}

/* Follows the spheres. In the first frame, molecules are put together where it has bonds; later spheres without one in
 * the frame before are where the file has them. Returns 0, or -1: no memory. */
static int follow(unwrapping *u, const periodic_box *box, const cgt_trajectory_frame *f, int *endless)
{
    unwrap_past *const past = &u->past;
    double share[3];
    if (past->is_there ? cgt_id_match_prepare(&past->spheres, f->id, f->count) : join_bonds(u, box, f, endless))
        return -1;
    for (uint32_t i = 0; i < f->count && past->is_there; i++) {
        const uint32_t k = id_match_find(&past->spheres, f->id, f->count, i);
        memset(u->move[i], 0, sizeof u->move[i]);
        share_of(box, f, i, share);
        if (k != UINT32_MAX)
            follow_sphere(u, box, share, i, k);
    }
    if (reserve_past(past, f->count) || cgt_id_match_remember(&past->spheres, f->id, f->count))
        return -1;
    for (uint32_t i = 0; i < f->count; i++)
        share_of(box, f, i, past->share[i]);
    if (f->count)
        memcpy(past->move, u->move, f->count * sizeof *past->move);
    past->is_there = 1;
    return 0;
}

/* ---- A frame ------------------------------------------------------------------------------------------------ */

static int refuse(const unwrapping *u, const cgt_trajectory_frame *f, const char *problem, char *error, size_t size)
{
    snprintf(error, size, "%s: frame %llu %s", u->mode == UNWRAP_WHOLE ? "--whole" : "--unwrap",
             (unsigned long long)f->number, problem);
    return -1;
}

static int is_periodic(const periodic_box *box, int e)
{
    return box->row[e][0] != 0.0 || box->row[e][1] != 0.0 || box->row[e][2] != 0.0;
}

static void set_places(const unwrapping *u, const periodic_box *box, cgt_trajectory_frame *f)
{
    for (uint32_t i = 0; i < f->count; i++) {
        const float *const p = f->xyzr + 4 * (size_t)i;
        float *const to = u->xyzr + 4 * (size_t)i;
        double place[3] = {(double)p[0], (double)p[1], (double)p[2]}, count[3];
        for (int e = 0; e < 3; e++)
            count[e] = is_periodic(box, e) ? u->move[i][e] : 0.0;
        add_edges(box, count, place);
        for (int c = 0; c < 3; c++)
            to[c] = (float)place[c];
        to[3] = p[3];
    }
    f->xyzr = u->xyzr;
}

int cgt_unwrap_frame(unwrapping *u, cgt_trajectory_frame *f, int *endless, char *error, size_t error_size)
{
    const float *value[3];
    if (f->kind != CGT_TRAJECTORY_SPHERES)
        return refuse(u, f, "is a mesh, which no periodic box has cut", error, error_size);
    if (f->box_min[0] > f->box_max[0])
        return refuse(u, f, "has no box", error, error_size);
    const periodic_box box = cgt_periodic_box_of(f);
    if (!is_periodic(&box, 0) && !is_periodic(&box, 1) && !is_periodic(&box, 2))
        return 0;
    if (reserve(u, f->count))
        return refuse(u, f, "is too large for the memory", error, error_size);
    const int has_flags = u->mode == UNWRAP_IMAGES && u->way != WAY_FOLLOWED && find_flags(f, value);
    if (u->mode == UNWRAP_IMAGES && u->way == WAY_FLAGS && !has_flags)
        return refuse(u, f, "has no image flags (ix, iy, iz), unlike the first", error, error_size);
    u->way = has_flags ? WAY_FLAGS : WAY_FOLLOWED;
    if (u->mode == UNWRAP_WHOLE && f->bond_source == CGT_TRAJECTORY_BONDS_UNKNOWN)
        return refuse(u, f, "has no bonds; --topology takes them from another file", error, error_size);
    if (has_flags)
        take_flags(u, f, value);
    else if (u->mode == UNWRAP_WHOLE ? join_bonds(u, &box, f, endless) : follow(u, &box, f, endless))
        return refuse(u, f, "is too large for the memory", error, error_size);
    if (u->mode == UNWRAP_WHOLE)
        center(u, &box, f);
    set_places(u, &box, f);
    for (int e = 0; e < 3 && has_flags; e++)
        f->unwrapped[e] |= is_periodic(&box, e) != 0;
    return 0;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * GSD of HOOMD-blue (schema hoomd): arrays of particles and bonds. What a frame lacks is that of frame 0, if there are
 * as many particles, else the schema's default. Little-endian. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/binary/atom_array.h"
#include "trajectory/gsd/gsd_index.h"
#include "trajectory/gsd/gsd_shapes.h"
#include "trajectory/atoms/trajectory_bonds.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST_TYPE_BYTES 1048576u

typedef struct gsd_state {
    gsd_index file; /* first: gsd_index.h */
    unsigned char *type_bytes;
    size_t type_capacity;
    uint64_t types, type_length; /* names of types, and the bytes of each */
    int has_type, has_velocity, has_radius;
    unsigned char *shape_bytes;
    size_t shape_capacity;
    bond_list bond;
} gsd_state;

/* ---- Arrays ------------------------------------------------------------------------------------------------- */

/* Reads the first `count` values of an array; they stay as they are where the file lacks it. */
static int read_values(cgt_trajectory *t, gsd_known name, double *values, uint32_t count)
{
    gsd_state *const s = t->state;
    gsd_entry e;
    if (!gsd_find(&s->file, name, &e) || e.rows * e.columns < count)
        return 1;
    unsigned char bytes[8];
    if (gsd_go_to(t, &e) < 0)
        return -1;
    for (uint32_t i = 0; i < count; i++) {
        if (binary_bytes(&s->file.in, bytes, gsd_size_of(e.type), gsd_chunk) < 0)
            return -1;
        values[i] = gsd_value_of(e.type, bytes);
    }
    return 1;
}

static int read_array(cgt_trajectory *t, const gsd_entry *e, const atom_array *a, uint32_t count)
{
    gsd_state *const s = t->state;
    const size_t size = gsd_size_of(e->type);
    unsigned char bytes[8 * ATOM_MOST_PARTS];
    for (uint32_t i = 0; i < count; i++) {
        if (binary_bytes(&s->file.in, bytes, size * a->parts, gsd_chunk) < 0)
            return -1;
        for (uint32_t k = 0; k < a->parts; k++)
            atom_array_store(t, a, i, k, gsd_value_of(e->type, bytes + size * k));
    }
    s->has_type |= a->use == ATOM_TYPE;
    s->has_velocity |= a->use == ATOM_VELOCITY;
    s->has_radius |= a->use == ATOM_DIAMETER;
    return 1;
}

/* Arrays of particles, those too that were logged: log/particles/... */
static int read_particles(cgt_trajectory *t, uint32_t count)
{
    gsd_state *const s = t->state;
    for (uint32_t k = 0; k < s->file.particles; k++) {
        const uint32_t i = s->file.particle[k];
        const char *name = s->file.name[i];
        name += strncmp(name, "log/", 4) == 0 ? 4 : 0;
        gsd_entry e;
        if (!gsd_find_number(&s->file, i, &e) || e.rows != count || e.columns > ATOM_MOST_PARTS ||
            strcmp(name, "particles/types") == 0 || strcmp(name, "particles/type_shapes") == 0 ||
            strcmp(name, "particles/N") == 0)
            continue;
        name += 10;
        atom_array a = {.use = strcmp(name, "position") == 0 && e.columns == 3 ? ATOM_PLACE
                               : strcmp(name, "typeid") == 0 && e.columns == 1 ? ATOM_TYPE
                                                                               : ATOM_NONE};
        if (atom_array_plan(t, &a, name, e.columns, e.type != 9 && e.type != 10) < 0 || gsd_go_to(t, &e) < 0 ||
            trajectory_reserve(t, count, count) < 0)
            return -1;
        if ((a.is_wanted || a.use == ATOM_TYPE) && read_array(t, &e, &a, count) < 0)
            return -1;
    }
    return 1;
}

/* The names of types, zeros behind each. */
static int read_types(cgt_trajectory *t)
{
    gsd_state *const s = t->state;
    gsd_entry e;
    s->types = 0;
    if (!gsd_find(&s->file, GSD_TYPES, &e))
        return 1;
    if (gsd_size_of(e.type) != 1 || e.rows * e.columns > MOST_TYPE_BYTES)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": the names of types are damaged", t->next);
    s->types = e.rows;
    s->type_length = e.columns;
    return gsd_go_to(t, &e) < 0 || gsd_check_growth(t, e.rows * e.columns) < 0
               ? -1
               : binary_blob(&s->file.in, &s->type_bytes, &s->type_capacity, (size_t)(e.rows * e.columns), gsd_chunk);
}

/* Types count from 1; their names are a column. */
static int name_types(cgt_trajectory *t, uint32_t count)
{
    gsd_state *const s = t->state;
    const int slot = columns_add_named(t, "name", CGT_TRAJECTORY_WORD);
    if (slot < 0 || trajectory_reserve(t, count, count) < 0)
        return -1;
    for (uint32_t i = 0; i < count; i++) {
        const uint64_t type = s->has_type ? t->store.type[i] : 0;
        const char *const name = type < s->types ? (const char *)s->type_bytes + type * s->type_length : "";
        const size_t length = type < s->types ? strnlen(name, (size_t)s->type_length) : 0;
        t->store.type[i] = (uint32_t)type + 1;
        if (slot > 0)
            columns_store_word(t, slot, i, (text_span){name, name + length});
    }
    return 1;
}

/* Gives particles the size of their type's shape, where the file has no diameters. */
static int read_shapes(cgt_trajectory *t, uint32_t count)
{
    gsd_state *const s = t->state;
    gsd_entry e;
    uint32_t of_volume = 0, others = 0;
    if (s->has_radius || !gsd_find(&s->file, GSD_SHAPES, &e))
        return 1;
    if (gsd_size_of(e.type) != 1 || e.rows * e.columns > MOST_TYPE_BYTES)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": the shapes of types are damaged", t->next);
    if (gsd_go_to(t, &e) < 0 || gsd_check_growth(t, e.rows * e.columns) < 0 ||
        binary_blob(&s->file.in, &s->shape_bytes, &s->shape_capacity, (size_t)(e.rows * e.columns), gsd_chunk) < 0)
        return -1;
    for (uint32_t i = 0; i < count; i++) {
        const uint64_t type = t->store.type[i] - 1u; /* they count from 1 */
        const char *const json = (const char *)s->shape_bytes + (type < e.rows ? type * e.columns : 0);
        float *const radius = &t->store.xyzr[4 * (size_t)i + 3];
        *radius = trajectory_default_radius(t);
        const gsd_shape shape =
            type < e.rows ? gsd_shape_read((text_span){json, json + strnlen(json, e.columns)}, radius) : GSD_SHAPE_NONE;
        s->has_radius |= shape == GSD_SHAPE_SPHERE || shape == GSD_SHAPE_OF_VOLUME;
        of_volume += shape == GSD_SHAPE_OF_VOLUME;
        others += shape == GSD_SHAPE_OTHER;
    }
    if (of_volume + others > 0)
        trajectory_warn(t, DOUBT_SHAPES, 0,
                        "shapes are drawn as spheres: %" PRIu32 " ellipsoids by their volume, %" PRIu32
                        " polygons, polyhedra or others by the usual radius",
                        of_volume, others);
    return 1;
}

static int read_bonds(cgt_trajectory *t, uint32_t count)
{
    gsd_state *const s = t->state;
    gsd_entry e;
    double bonds = 0.0;
    bond_list_clear(&s->bond);
    if (read_values(t, GSD_BONDS, &bonds, 1) < 0)
        return -1;
    if (!gsd_find(&s->file, GSD_BOND_PAIRS, &e) || e.columns != 2 || (e.type != 3 && e.type != 7) ||
        (double)e.rows != bonds)
        return 1;
    if (gsd_go_to(t, &e) < 0 || gsd_check_growth(t, 8 * e.rows) < 0)
        return -1;
    for (uint64_t i = 0; i < e.rows; i++) {
        uint32_t first, second;
        if (binary_u32(&s->file.in, &first, gsd_chunk) < 0 || binary_u32(&s->file.in, &second, gsd_chunk) < 0)
            return -1;
        if (first >= count || second >= count)
            return trajectory_fail(t, 0, "frame %" PRIu64 ": bond %" PRIu64 " has a particle that is not there",
                                   t->next, i);
        if (bond_list_add(&s->bond, first, second))
            return trajectory_fail(t, 0, "not enough memory for the bonds");
    }
    return 1;
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

/* Lengths along x, y, z and tilts; two dimensions may have no length along z. The middle is the origin. */
static void set_box(cgt_trajectory_frame *frame, const double box[6])
{
    const double z = box[2] > 0.0 ? box[2] : 1.0;
    const double edge[3][3] = {{box[0], 0, 0}, {box[3] * box[1], box[1], 0}, {box[4] * z, box[5] * z, z}};
    double origin[3];
    for (int k = 0; k < 3; k++)
        origin[k] = -0.5 * (edge[0][k] + edge[1][k] + edge[2][k]);
    if (!(box[0] > 0.0 && box[1] > 0.0))
        return;
    trajectory_frame_set_box(frame, origin, edge);
    memset(frame->periodic, 1, sizeof frame->periodic);
}

static int gsd_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    gsd_state *const s = t->state;
    double count = 0.0, step = 0.0, box[6] = {0};
    if (s->file.at == s->file.frames)
        return 0;
    s->has_type = s->has_velocity = s->has_radius = 0;
    gsd_enter_frame(&s->file);
    if (read_values(t, GSD_COUNT, &count, 1) < 0 || read_values(t, GSD_STEP, &step, 1) < 0 ||
        read_values(t, GSD_BOX, box, 6) < 0)
        return -1;
    if (!(count >= 0.0 && count <= (double)UINT32_MAX && fabs(step) < 0x1p63))
        return trajectory_fail(t, 0, "frame %" PRIu64 ": %g particles, step %g: damaged", t->next, count, step);
    if (binary_check_count(&s->file.in, (uint64_t)count) < 0)
        return -1;
    const uint32_t n = (uint32_t)count;
    gsd_entry places;
    if (n == 0 && gsd_find(&s->file, GSD_POSITION, &places) && places.frame == s->file.at && places.rows > 0)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": %" PRIu64 " positions of 0 particles", t->next, places.rows);
    if (n > 0 && (!gsd_find(&s->file, GSD_POSITION, &places) || places.rows != n || places.columns != 3))
        return trajectory_fail(t, 0, "frame %" PRIu64 ": no positions of %" PRIu32 " particles", t->next, n);
    if ((n > 0 && gsd_go_to(t, &places) < 0) ||
        gsd_check_growth(t, 16 * (uint64_t)n + 8 * (uint64_t)s->file.particles) < 0 ||
        trajectory_reserve(t, 0, n) < 0 || read_particles(t, n) < 0 || read_types(t) < 0 || name_types(t, n) < 0 ||
        read_shapes(t, n) < 0 || read_bonds(t, n) < 0)
        return -1;
    for (size_t i = 0; i < n && !s->has_radius; i++)
        t->store.xyzr[4 * i + 3] = trajectory_default_radius(t);
    trajectory_frame_fill(t, frame, n);
    frame->step = (int64_t)step;
    frame->type = t->store.type;
    frame->has_radius = s->has_radius;
    frame->velocity = s->has_velocity ? t->store.velocity : NULL;
    frame->bonds = (uint32_t)s->bond.count;
    frame->bond = s->bond.count > 0 ? s->bond.pair : NULL;
    frame->bond_source = gsd_has(&s->file, GSD_BOND_PAIRS) ? CGT_TRAJECTORY_BONDS_LISTED : CGT_TRAJECTORY_BONDS_UNKNOWN;
    set_box(frame, box);
    s->file.at++;
    return 1;
}

static int gsd_skip(cgt_trajectory *t)
{
    gsd_state *const s = t->state;
    cgt_trajectory_frame unused;
    if (s->file.at == s->file.frames)
        return 0;
    if (columns_want(t, "name")) /* words are numbered in order of appearance */
        return gsd_read(t, &unused);
    if (gsd_check_growth(t, 0) < 0)
        return -1;
    s->file.at++;
    return 1;
}

static double gsd_progress(const cgt_trajectory *t)
{
    const gsd_state *const s = t->state;
    return s->file.frames > 0 ? (double)s->file.at / (double)s->file.frames : 1.0;
}

static void gsd_end(cgt_trajectory *t)
{
    gsd_state *const s = t->state;
    gsd_index_free(&s->file);
    free(s->type_bytes);
    free(s->shape_bytes);
    bond_list_free(&s->bond);
}

const trajectory_format trajectory_format_gsd = {
    .is_binary = 1,
    .is_series = 1,
    .state_size = sizeof(gsd_state),
    .begin = gsd_begin,
    .read = gsd_read,
    .skip = gsd_skip,
    .end = gsd_end,
    .progress = gsd_progress,
};
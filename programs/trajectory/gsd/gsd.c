/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * GSD of HOOMD-blue (file layer 1 and 2, schema hoomd): a header that tells where an index and a list of names are; an
 * entry of the index for each array of a frame: its name, numbers, and place. What a frame lacks is that of frame 0, if
 * there are as many particles, else the schema's default. Little-endian. The index may lie anywhere, so the file has to
 * be a regular one. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include "trajectory/binary/atom_array.h"
#include "trajectory/binary/binary_reader.h"
#include "trajectory/trajectory_bonds.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAGIC UINT64_C(0x65DF65DF65DF65DF)
#define HEADER_BYTES 256u
#define ENTRY_BYTES 32u
#define MOST_NAMES 65536u /* an entry has 16 bits for its name */
#define MOST_TYPE 11      /* 1 to 4 unsigned, 5 to 8 signed, 9 float, 10 double, 11 characters */
#define MOST_TYPE_BYTES 1048576u

typedef struct gsd_entry {
    uint64_t frame, rows, place;
    uint32_t columns;
    uint32_t name; /* number in the list */
    int type;
} gsd_entry;

typedef struct gsd_state {
    binary_reader in;
    unsigned char *index, *name_bytes, *type_bytes;
    size_t index_capacity, name_capacity, type_capacity;
    const char **name;
    uint32_t names;
    uint64_t entries, frames, at; /* at: the next frame of this file */
    uint64_t types, type_length;  /* names of types, and the bytes of each */
    int has_type, has_velocity, has_radius;
    bond_list bond;
} gsd_state;

static const char chunk[] = "an array of a frame";

/* ---- The file layer ----------------------------------------------------------------------------------------- */

/* Bytes of a value. */
static size_t size_of(int type)
{
    static const size_t sizes[MOST_TYPE] = {1, 2, 4, 8, 1, 2, 4, 8, 4, 8, 1};
    return type >= 1 && type <= MOST_TYPE ? sizes[type - 1] : 1;
}

static double value_of(int type, const unsigned char *bytes)
{
    if (type == 9)
        return (double)binary_get_f32(bytes, 0);
    if (type == 10)
        return binary_get_f64(bytes, 0);
    const size_t size = size_of(type);
    const int is_negative = type >= 5 && type <= 8 && bytes[size - 1] > 127;
    uint64_t bits = is_negative ? UINT64_MAX : 0;
    for (size_t i = size; i-- > 0;)
        bits = bits << 8 | bytes[i];
    return is_negative ? -(double)(~bits + 1) : (double)bits;
}

static int seek(cgt_trajectory *t, uint64_t place)
{
    gsd_state *const s = t->state;
    if (fseeko(t->file, (off_t)place, SEEK_SET) != 0)
        return trajectory_fail(t, 0, "%s", strerror(errno));
    s->in.read = place;
    return 1;
}

/* Reads a block that the header tells of. */
static int read_block(cgt_trajectory *t, uint64_t place, uint64_t count, uint64_t bytes, unsigned char **block,
                      size_t *capacity)
{
    gsd_state *const s = t->state;
    if (place > t->file_size || count > (t->file_size - place) / bytes)
        return trajectory_fail(t, 0, "the index or the names lie beyond the end of the file: it is cut off");
    return seek(t, place) < 0 ? -1 : binary_blob(&s->in, block, capacity, (size_t)(count * bytes), "the index");
}

static gsd_entry entry_at(const gsd_state *s, uint64_t i)
{
    const unsigned char *const b = s->index + ENTRY_BYTES * i;
    return (gsd_entry){.frame = binary_get_u64(b, 0),
                       .rows = binary_get_u64(b + 8, 0),
                       .place = binary_get_u64(b + 16, 0),
                       .columns = binary_get_u32(b + 24, 0),
                       .name = (uint32_t)b[28] | (uint32_t)b[29] << 8,
                       .type = b[30]};
}

/* Names follow each other, each with a zero behind it; in version 1 as many as fill 64 bytes. */
static int list_names(cgt_trajectory *t, size_t size)
{
    gsd_state *const s = t->state;
    s->names = 0;
    if (trajectory_grow(&s->name, MOST_NAMES, sizeof *s->name))
        return trajectory_fail(t, 0, "not enough memory for the names");
    for (size_t i = 0; i < size && s->names < MOST_NAMES; i++)
        if (s->name_bytes[i] != '\0' && (i == 0 || s->name_bytes[i - 1] == '\0'))
            s->name[s->names++] = (const char *)s->name_bytes + i;
    return size == 0 || s->name_bytes[size - 1] == '\0' ? 1 : trajectory_fail(t, 0, "a name of an array without end");
}

/* Counts entries, which are in the order of frames, and frames. */
static int check_index(cgt_trajectory *t, uint64_t allocated)
{
    gsd_state *const s = t->state;
    s->frames = 0;
    for (s->entries = 0; s->entries < allocated; s->entries++) {
        const gsd_entry e = entry_at(s, s->entries);
        if (e.place == 0)
            break;
        if (e.type < 1 || e.type > MOST_TYPE || e.columns == 0 || e.name >= s->names || e.frame >= UINT32_MAX ||
            e.frame + 1 < s->frames)
            return trajectory_fail(t, 0, "entry %" PRIu64 " of the index is damaged", s->entries);
        s->frames = e.frame + 1;
    }
    return 1;
}

/* Goes to an array, all of which has to lie in the file. */
static int go_to(cgt_trajectory *t, const gsd_entry *e)
{
    const uint64_t room = e->place < t->file_size ? t->file_size - e->place : 0;
    if (e->rows > room / size_of(e->type) / e->columns)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": the file ends in %s: it is cut off", t->next, chunk);
    return seek(t, e->place);
}

static int gsd_begin(cgt_trajectory *t)
{
    gsd_state *const s = t->state;
    unsigned char head[HEADER_BYTES];
    binary_begin(&s->in, t, 0);
    s->at = 0;
    if (!t->regular)
        return trajectory_fail(t, 0, "GSD has to be a regular file, neither compressed nor a pipe");
    if (binary_bytes(&s->in, head, sizeof head, "the header") < 0)
        return -1;
    const uint32_t version = binary_get_u32(head + 44, 0);
    if (binary_get_u64(head, 0) != MAGIC || version >> 16 < 1 || version >> 16 > 2)
        return trajectory_fail(t, 0, "not a GSD file of version 1 or 2");
    if (memcmp(head + 112, "hoomd", 6) != 0)
        return trajectory_fail(t, 0, "a GSD file of the schema '%.40s', not hoomd", (const char *)head + 112);
    const uint64_t allocated = binary_get_u64(head + 16, 0), names = binary_get_u64(head + 32, 0);
    return read_block(t, binary_get_u64(head + 24, 0), names, 64, &s->name_bytes, &s->name_capacity) < 0 ||
                   list_names(t, (size_t)(64 * names)) < 0 ||
                   read_block(t, binary_get_u64(head + 8, 0), allocated, ENTRY_BYTES, &s->index, &s->index_capacity) < 0
               ? -1
               : check_index(t, allocated);
}

/* ---- Arrays ------------------------------------------------------------------------------------------------- */

/* Finds the array of a name in a frame: 1 or 0. */
static int find_in(const gsd_state *s, uint64_t frame, uint32_t name, gsd_entry *e)
{
    uint64_t low = 0, high = s->entries;
    while (low < high) {
        const uint64_t middle = low + (high - low) / 2;
        if (entry_at(s, middle).frame < frame)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < s->entries && (*e = entry_at(s, low)).frame == frame; low++)
        if (e->name == name)
            return 1;
    return 0;
}

/* The same in this frame, else in frame 0. */
static int find_number(const gsd_state *s, uint32_t name, gsd_entry *e)
{
    return find_in(s, s->at, name, e) || find_in(s, 0, name, e);
}

static int find(const gsd_state *s, const char *name, gsd_entry *e)
{
    for (uint32_t i = 0; i < s->names; i++)
        if (strcmp(s->name[i], name) == 0)
            return find_number(s, i, e);
    return 0;
}

/* Reads the first `count` values of an array; they stay as they are where the file lacks it. */
static int read_values(cgt_trajectory *t, const char *name, double *values, uint32_t count)
{
    gsd_state *const s = t->state;
    gsd_entry e;
    if (!find(s, name, &e) || e.rows * e.columns < count)
        return 1;
    unsigned char bytes[8];
    if (go_to(t, &e) < 0)
        return -1;
    for (uint32_t i = 0; i < count; i++) {
        if (binary_bytes(&s->in, bytes, size_of(e.type), chunk) < 0)
            return -1;
        values[i] = value_of(e.type, bytes);
    }
    return 1;
}

static int read_array(cgt_trajectory *t, const gsd_entry *e, const atom_array *a, uint32_t count)
{
    gsd_state *const s = t->state;
    const size_t size = size_of(e->type);
    unsigned char bytes[8 * ATOM_MOST_PARTS];
    for (uint32_t i = 0; i < count; i++) {
        if (binary_bytes(&s->in, bytes, size * a->parts, chunk) < 0)
            return -1;
        for (uint32_t k = 0; k < a->parts; k++)
            atom_array_store(t, a, i, k, value_of(e->type, bytes + size * k));
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
    for (uint32_t i = 0; i < s->names; i++) {
        const char *name = s->name[i];
        name += strncmp(name, "log/", 4) == 0 ? 4 : 0;
        gsd_entry e;
        if (strncmp(name, "particles/", 10) != 0 || !find_number(s, i, &e) || e.rows != count ||
            e.columns > ATOM_MOST_PARTS || strcmp(name, "particles/types") == 0 || strcmp(name, "particles/N") == 0)
            continue;
        name += 10;
        atom_array a = {.use = strcmp(name, "position") == 0 && e.columns == 3 ? ATOM_PLACE
                               : strcmp(name, "typeid") == 0 && e.columns == 1 ? ATOM_TYPE
                                                                               : ATOM_NONE};
        if (atom_array_plan(t, &a, name, e.columns, e.type != 9 && e.type != 10) < 0 || go_to(t, &e) < 0 ||
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
    if (!find(s, "particles/types", &e))
        return 1;
    if (size_of(e.type) != 1 || e.rows * e.columns > MOST_TYPE_BYTES)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": the names of types are damaged", t->next);
    s->types = e.rows;
    s->type_length = e.columns;
    return go_to(t, &e) < 0
               ? -1
               : binary_blob(&s->in, &s->type_bytes, &s->type_capacity, (size_t)(e.rows * e.columns), chunk);
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
        const char *reason = "";
        t->store.type[i] = (uint32_t)type + 1;
        if (slot > 0) {
            const size_t length = type < s->types ? strnlen(name, (size_t)s->type_length) : 0;
            columns_values(t, slot)[i] =
                length > 0 ? (float)columns_word(t, slot, (text_span){name, name + length}, &reason) : 0.0f;
        }
        if (*reason != '\0')
            return trajectory_fail(t, 0, "frame %" PRIu64 ": %s", t->next, reason);
    }
    return 1;
}

static int read_bonds(cgt_trajectory *t, uint32_t count)
{
    gsd_state *const s = t->state;
    gsd_entry e;
    double bonds = 0.0;
    bond_list_clear(&s->bond);
    if (read_values(t, "bonds/N", &bonds, 1) < 0)
        return -1;
    if (!find(s, "bonds/group", &e) || e.columns != 2 || (e.type != 3 && e.type != 7) || (double)e.rows != bonds)
        return 1;
    if (go_to(t, &e) < 0)
        return -1;
    for (uint64_t i = 0; i < e.rows; i++) {
        uint32_t first, second;
        if (binary_u32(&s->in, &first, chunk) < 0 || binary_u32(&s->in, &second, chunk) < 0)
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
    if (s->at == s->frames)
        return 0;
    s->has_type = s->has_velocity = s->has_radius = 0;
    if (read_values(t, "particles/N", &count, 1) < 0 || read_values(t, "configuration/step", &step, 1) < 0 ||
        read_values(t, "configuration/box", box, 6) < 0)
        return -1;
    if (!(count >= 0.0 && count <= (double)UINT32_MAX && fabs(step) < 0x1p63))
        return trajectory_fail(t, 0, "frame %" PRIu64 ": %g particles, step %g: damaged", t->next, count, step);
    if (binary_check_count(&s->in, (uint64_t)count) < 0)
        return -1;
    const uint32_t n = (uint32_t)count;
    gsd_entry places;
    if (n > 0 && (!find(s, "particles/position", &places) || places.rows != n || places.columns != 3))
        return trajectory_fail(t, 0, "frame %" PRIu64 ": no positions of %" PRIu32 " particles", t->next, n);
    if ((n > 0 && go_to(t, &places) < 0) || trajectory_reserve(t, 0, n) < 0 || read_particles(t, n) < 0 ||
        read_types(t) < 0 || name_types(t, n) < 0 || read_bonds(t, n) < 0)
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
    set_box(frame, box);
    s->at++;
    return 1;
}

static int gsd_skip(cgt_trajectory *t)
{
    gsd_state *const s = t->state;
    return s->at < s->frames ? (int)(s->at++, 1) : 0;
}

static double gsd_progress(const cgt_trajectory *t)
{
    const gsd_state *const s = t->state;
    return s->frames > 0 ? (double)s->at / (double)s->frames : 1.0;
}

static void gsd_end(cgt_trajectory *t)
{
    gsd_state *const s = t->state;
    free(s->index);
    free(s->name_bytes);
    free(s->type_bytes);
    free(s->name);
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

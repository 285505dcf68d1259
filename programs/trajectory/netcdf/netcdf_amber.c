/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Amber's netCDF (conventions AMBER and AMBERRESTART): coordinates of (frame, atom, spatial), or of (atom, spatial) in
 * a restart file; time, cell_lengths, cell_angles, velocities where present. LAMMPS and others add variables of (frame,
 * atom) and (frame, atom, any), which are columns under their names. The file is read forwards, record by record. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include "trajectory/binary/atom_array.h"
#include "trajectory/molecule/molecule_atom.h"
#include "trajectory/netcdf/netcdf_header.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define BARE_RADIUS 1.0f /* Angstrom, where the options say nothing */
#define PART 4096u       /* atoms read at a time, so that memory grows with the file */

typedef struct netcdf_state {
    binary_reader in;
    netcdf_header h;
    const netcdf_variable *places;
    uint32_t count;
    uint64_t fixed; /* frames where their dimension has a length of its own, and each variable has all; 0: has not */
    uint64_t at;    /* records of this file so far */
    uint64_t place; /* in the file */
    /* Of the frame. */
    double length[3], angle[3], origin[3], time;
    int cell_parts; /* bits: lengths, angles */
    int has_id, has_type, has_velocity, has_radius;
} netcdf_state;

static const char data[] = "the data of a frame";

/* ---- Opening ------------------------------------------------------------------------------------------------ */

/* The length of dimension i of a variable, counted without that of the records; 0: none. */
static uint64_t length_of(const netcdf_state *s, const netcdf_variable *v, uint32_t i)
{
    const uint32_t at = i + (uint32_t)(v->is_record != 0);
    return at < v->dimensions ? s->h.dimension[v->dimension[at]].length : 0;
}

/* nccopy -u and others give the frames a dimension of fixed length: then each variable is cut into frames. */
static int cut_frames(cgt_trajectory *t)
{
    netcdf_state *const s = t->state;
    const netcdf_variable *const places = netcdf_find(&s->h, "coordinates");
    s->fixed = 0;
    if (places == NULL || places->is_odd || places->is_record || places->dimensions != 3)
        return 1;
    const uint32_t frame = places->dimension[0];
    const uint64_t frames = s->h.dimension[frame].length;
    if (frames == 0)
        return trajectory_fail(t, 0, "a damaged netCDF header: the dimension of the frames has no length");
    if (!t->regular)
        return trajectory_fail(t, 0, "the frames have a dimension of fixed length: that needs a regular file");
    s->fixed = frames;
    for (uint32_t i = 0; i < s->h.variables; i++) {
        netcdf_variable *const v = &s->h.variable[i];
        if (v->is_odd || v->is_record || v->dimensions == 0 || v->dimension[0] != frame)
            continue;
        v->is_record = 1;
        v->values /= frames;
        v->bytes = v->stride = v->values * netcdf_size(v->type);
    }
    s->h.records = frames;
    s->h.record_bytes = 1; /* there is data */
    return 1;
}

/* Goes to a place in the file, forwards unless frames are cut. */
static int go_to(cgt_trajectory *t, uint64_t place)
{
    netcdf_state *const s = t->state;
    if (place >= s->in.read)
        return binary_skip(&s->in, place - s->in.read, data);
    if (s->fixed == 0)
        return trajectory_fail(t, 0, "a damaged netCDF header: variables overlap");
    if (place > INT64_MAX || fseeko(t->file, (off_t)place, SEEK_SET) != 0)
        return trajectory_fail(t, 0, "the file cannot be read");
    s->in.read = place;
    return 1;
}

/* Leaves the variables that frames have: a header may have thousands of others, which each frame would pass. */
static void keep_variables(netcdf_state *s)
{
    uint32_t kept = 0;
    const int is_record = s->places->is_record;
    for (uint32_t i = 0; i < s->h.variables; i++) {
        const netcdf_variable *const v = &s->h.variable[i];
        if (v->is_record == is_record && (v->bytes > 0 || v == s->places))
            s->h.variable[kept++] = *v;
    }
    s->h.variables = kept;
    s->places = netcdf_find(&s->h, "coordinates");
}

static int netcdf_begin(cgt_trajectory *t)
{
    netcdf_state *const s = t->state;
    binary_begin(&s->in, t, 1);
    s->at = 0;
    if (netcdf_read_header(&s->in, &s->h) < 0 || cut_frames(t) < 0)
        return -1;
    s->places = netcdf_find(&s->h, "coordinates");
    if (s->places == NULL || s->places->is_odd || length_of(s, s->places, 1) != 3 ||
        s->places->values != 3 * length_of(s, s->places, 0))
        return trajectory_fail(t, 0, "no coordinates of (frame, atom, 3): not a trajectory as Amber writes them");
    if (binary_check_count(&s->in, length_of(s, s->places, 0)) < 0)
        return -1;
    s->count = (uint32_t)length_of(s, s->places, 0);
    keep_variables(s);
    return s->places->is_record && s->h.record_bytes == 0 ? trajectory_fail(t, 0, "a frame without any data") : 1;
}

/* ---- Variables ---------------------------------------------------------------------------------------------- */

static int plan_variable(cgt_trajectory *t, const netcdf_variable *v, atom_array *a)
{
    const netcdf_state *const s = t->state;
    *a = (atom_array){.use = v == s->places ? ATOM_PLACE : ATOM_NONE};
    if (v->is_odd || v->is_record != s->places->is_record || s->count == 0 || length_of(s, v, 0) != s->count ||
        v->dimension[v->is_record != 0] != s->places->dimension[s->places->is_record != 0] ||
        v->values / s->count > ATOM_MOST_PARTS)
        return 1;
    /* types 5 and 6 are float and double */
    return atom_array_plan(t, a, v->name, (uint32_t)(v->values / s->count), v->type != 5 && v->type != 6);
}

/* Reads a variable with values for each atom. */
static int read_atoms(cgt_trajectory *t, const netcdf_variable *v, const atom_array *a)
{
    netcdf_state *const s = t->state;
    unsigned char bytes[8 * ATOM_MOST_PARTS];
    const size_t size = netcdf_size(v->type);
    if (binary_expect(&s->in, v->bytes, data) < 0)
        return -1;
    for (uint32_t i = 0; i < s->count; i++) {
        const uint32_t part = s->count - i < PART ? s->count - i : PART;
        if ((i % PART == 0 && trajectory_reserve(t, (size_t)i + part, s->count) < 0) ||
            binary_bytes(&s->in, bytes, size * a->parts, data) < 0)
            return -1;
        for (uint32_t k = 0; k < a->parts; k++) {
            const double value = netcdf_value(v->type, bytes + size * k);
            atom_array_store(t, a, i, k, v->scale == 1.0 ? value : v->scale * value);
        }
    }
    s->has_velocity |= a->use == ATOM_VELOCITY;
    s->has_id |= a->use == ATOM_ID;
    s->has_type |= a->use == ATOM_TYPE;
    s->has_radius |= a->use == ATOM_RADIUS || a->use == ATOM_DIAMETER;
    return binary_skip(&s->in, v->bytes - (uint64_t)size * a->parts * s->count, data);
}

/* Reads time and cell: a few numbers. */
static int read_numbers(cgt_trajectory *t, const netcdf_variable *v, double *values, uint32_t count)
{
    netcdf_state *const s = t->state;
    unsigned char bytes[8];
    const size_t size = netcdf_size(v->type);
    for (uint32_t i = 0; i < count; i++) {
        if (binary_bytes(&s->in, bytes, size, data) < 0)
            return -1;
        values[i] = v->scale == 1.0 ? netcdf_value(v->type, bytes) : v->scale * netcdf_value(v->type, bytes);
    }
    return binary_skip(&s->in, v->bytes - size * count, data);
}

static int read_variable(cgt_trajectory *t, const netcdf_variable *v)
{
    netcdf_state *const s = t->state;
    atom_array plan;
    if (strcmp(v->name, "time") == 0 && v->values == 1)
        return read_numbers(t, v, &s->time, 1);
    if (strcmp(v->name, "cell_lengths") == 0 && v->values == 3) {
        s->cell_parts |= 1;
        return read_numbers(t, v, s->length, 3);
    }
    if (strcmp(v->name, "cell_angles") == 0 && v->values == 3) {
        s->cell_parts |= 2;
        return read_numbers(t, v, s->angle, 3);
    }
    if (strcmp(v->name, "cell_origin") == 0 && v->values == 3)
        return read_numbers(t, v, s->origin, 3);
    if (plan_variable(t, v, &plan) < 0)
        return -1;
    return plan.is_wanted ? read_atoms(t, v, &plan) : binary_skip(&s->in, v->bytes, data);
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

/* Whether there is another frame, by the header or, where that does not tell, by the bytes: 1, 0, -1. */
static int has_frame(cgt_trajectory *t)
{
    netcdf_state *const s = t->state;
    const int is_told = s->h.records != NETCDF_UNKNOWN;
    if (!s->places->is_record || s->fixed > 0)
        return s->at < (s->places->is_record ? s->h.records : 1);
    if (is_told && s->at < s->h.records)
        return 1;
    /* The count is written after the frames: of a run that was killed there may be more of them. */
    if (is_told && t->regular && t->file_size - s->in.read < s->h.record_bytes)
        return 0;
    const int c = fgetc(t->file);
    if (c == EOF)
        return ferror(t->file) ? trajectory_fail(t, 0, "the file cannot be read") : 0;
    if (is_told)
        trajectory_warn(t, DOUBT_FRAMES, 0, "the header says %" PRIu64 " frames, the file has more: they are read",
                        s->h.records);
    return ungetc(c, t->file) == c ? 1 : trajectory_fail(t, 0, "the file cannot be read");
}

/* Goes through the variables of a record, or of a restart file, in their order in the file. */
static int read_record(cgt_trajectory *t, int skips)
{
    netcdf_state *const s = t->state;
    for (uint32_t i = 0; i < s->h.variables; i++) {
        const netcdf_variable *const v = &s->h.variable[i];
        if (go_to(t, v->begin + (v->is_record ? s->at * v->stride : 0)) < 0 ||
            (skips ? binary_skip(&s->in, v->bytes, data) : read_variable(t, v)) < 0)
            return -1;
    }
    s->at++;
    return 1;
}

static void set_box(const netcdf_state *s, cgt_trajectory_frame *frame)
{
    double edge[3][3];
    if (s->cell_parts == 3 && molecule_cell(s->length, s->angle, edge)) {
        trajectory_frame_set_box(frame, s->origin, (const double(*)[3])edge);
        memset(frame->periodic, 1, sizeof frame->periodic);
    }
}

static int netcdf_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    netcdf_state *const s = t->state;
    const int status = has_frame(t);
    if (status <= 0)
        return status;
    s->time = NAN;
    s->cell_parts = s->has_id = s->has_type = s->has_velocity = s->has_radius = 0;
    memset(s->origin, 0, sizeof s->origin);
    if (trajectory_reserve(t, 0, s->count) < 0 || read_record(t, 0) < 0)
        return -1;
    for (size_t i = 0; i < s->count && !s->has_radius; i++)
        t->store.xyzr[4 * i + 3] = t->options.radius > 0.0f ? t->options.radius : BARE_RADIUS;
    trajectory_frame_fill(t, frame, s->count);
    frame->time = s->time;
    frame->has_radius = s->has_radius;
    frame->id = s->has_id ? t->store.id : NULL;
    frame->type = s->has_type ? t->store.type : NULL;
    frame->velocity = s->has_velocity ? t->store.velocity : NULL;
    set_box(s, frame);
    return 1;
}

static int netcdf_skip(cgt_trajectory *t)
{
    const int status = has_frame(t);
    return status <= 0 ? status : read_record(t, 1);
}

static void netcdf_end(cgt_trajectory *t)
{
    netcdf_state *const s = t->state;
    netcdf_free_header(&s->h);
}

const trajectory_format trajectory_format_netcdf = {
    .is_binary = 1,
    .is_series = 1,
    .state_size = sizeof(netcdf_state),
    .begin = netcdf_begin,
    .read = netcdf_read,
    .skip = netcdf_skip,
    .end = netcdf_end,
};

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Spheres by the atoms of another file. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/atoms/trajectory_topology.h"
#include "trajectory/trajectory_internal.h"
#include "trajectory/atoms/trajectory_sites.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- The file ----------------------------------------------------------------------------------------------- */

/* Notes in t what the topology says of itself. */
static cgt_result tell(cgt_trajectory *t, const trajectory_topology *p, cgt_result result)
{
    cgt_trajectory_get_error_message(p->file, t->message, sizeof t->message);
    return t->error = result;
}

static cgt_result read_first(cgt_trajectory *t, trajectory_topology *p, const char *path)
{
    const cgt_result result = cgt_trajectory_read(p->file, &p->frame);
    if (result == CGT_END)
        return trajectory_result(t, trajectory_refuse(t, path, CGT_ERROR_FILE, "the topology has no frame"));
    if (result == CGT_OK && p->frame.kind != CGT_TRAJECTORY_SPHERES)
        return trajectory_result(t, trajectory_refuse(t, path, CGT_ERROR_FILE, "the topology is a mesh"));
    return result == CGT_OK ? result : tell(t, p, result);
}

cgt_result topology_open(cgt_trajectory *t, const char *path, const cgt_trajectory_options *options)
{
    cgt_trajectory_options reading = *options;
    reading.topology = reading.format = NULL;
    reading.leave_out_sites = false; /* the atoms of both files go by their order */
    reading.follow = 0.0;
    trajectory_topology *const p = t->topology = calloc(1, sizeof *p);
    if (p == NULL)
        return trajectory_result(t, trajectory_refuse(t, path, CGT_ERROR_OUT_OF_MEMORY, "not enough memory"));
    const cgt_result result = trajectory_open_topology(path, &reading, &p->file);
    return result == CGT_OK ? read_first(t, p, path) : tell(t, p, result);
}

cgt_result topology_want_columns(cgt_trajectory *t, const char *const *names, size_t count)
{
    trajectory_topology *const p = t->topology;
    cgt_result result = cgt_trajectory_rewind(p->file);
    if (result == CGT_OK) {
        memset(&p->frame, 0, sizeof p->frame); /* its arrays are no more */
        result = cgt_trajectory_want_columns(p->file, names, count);
    }
    return result == CGT_OK ? read_first(t, p, p->file->path) : tell(t, p, result);
}

void topology_close(trajectory_topology *p)
{
    if (p != NULL) {
        cgt_trajectory_close(p->file);
        bond_list_free(&p->ids);
        free(p->index);
        free(p->sphere);
        free(p);
    }
}

/* ---- Which sphere is which atom ----------------------------------------------------------------------------- */

static int reserve_maps(cgt_trajectory *t, trajectory_topology *p, uint32_t count)
{
    if ((count > p->index_capacity && trajectory_grow(&p->index, count, sizeof *p->index)) ||
        (p->frame.count > p->sphere_capacity && trajectory_grow(&p->sphere, p->frame.count, sizeof *p->sphere)))
        return trajectory_fail(t, 0, "not enough memory for the topology");
    p->index_capacity = count > p->index_capacity ? count : p->index_capacity;
    p->sphere_capacity = p->frame.count > p->sphere_capacity ? p->frame.count : p->sphere_capacity;
    return 1;
}

/* Whether the ids of a frame are the numbers from 1 to its count, each once. index: so many places. */
static int are_numbers(const cgt_trajectory_frame *frame, uint32_t *index)
{
    for (uint32_t i = 0; i < frame->count; i++)
        index[i] = 0;
    for (uint32_t i = 0; i < frame->count; i++)
        if (frame->id[i] < 1 || frame->id[i] > frame->count || index[frame->id[i] - 1]++ > 0)
            return 0;
    return 1;
}

static int do_ascend(const cgt_trajectory_frame *frame)
{
    int ascends = 1;
    for (uint32_t i = 1; i < frame->count; i++)
        ascends &= frame->id[i - 1] < frame->id[i];
    return ascends;
}

/* Where only the frame has ids. Those from 1 on are numbers of the topology's atoms: dumps of several processes are in
 * any order. With others the atoms go by their order, which is told where it may be another one. */
static int go_by_numbers(cgt_trajectory *t, const trajectory_topology *p, const cgt_trajectory_frame *frame)
{
    if (frame->id == NULL || p->frame.id != NULL || do_ascend(frame))
        return 0;
    if (are_numbers(frame, p->index))
        return 1;
    trajectory_warn(t, DOUBT_TOPOLOGY_ORDER, 0,
                    "frame %" PRIu64
                    ": the topology has no ids, and those of the file neither ascend nor are 1 to %" PRIu32
                    ": its spheres are taken in the order of the topology's atoms",
                    frame->number, frame->count);
    return 0;
}

/* By ids, where a dump has some of the atoms in any order; else all atoms, by their numbers or in the same order. */
static int map_spheres(cgt_trajectory *t, trajectory_topology *p, const cgt_trajectory_frame *frame)
{
    const int by_id = frame->id != NULL && p->frame.id != NULL;
    if (!by_id && frame->count != p->frame.count)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": %" PRIu32 " spheres, but the topology has %" PRIu32 " atoms",
                               frame->number, frame->count, p->frame.count);
    if (reserve_maps(t, p, frame->count) < 0 ||
        (by_id && p->ids.keys == 0 && bond_list_index(p->file, &p->ids, p->frame.count) < 0))
        return t->failed ? -1 : trajectory_fail(t, 0, "not enough memory for the topology");
    const int by_number = go_by_numbers(t, p, frame);
    for (uint32_t i = 0; i < p->frame.count; i++)
        p->sphere[i] = BOND_NONE;
    for (uint32_t i = 0; i < frame->count; i++) {
        const uint32_t atom = by_id ? bond_list_find(&p->ids, frame->id[i]) : by_number ? frame->id[i] - 1 : i;
        if (atom == BOND_NONE)
            return trajectory_fail(t, 0, "frame %" PRIu64 ": the topology has no atom with the id %" PRIu32,
                                   frame->number, frame->id[i]);
        p->index[i] = atom;
        p->sphere[atom] = i;
    }
    return 1;
}

/* ---- What a frame lacks ------------------------------------------------------------------------------------- */

/* The bonds between atoms that the frame has, the smaller number first as everywhere. */
static int set_bonds(cgt_trajectory *t, trajectory_topology *p, cgt_trajectory_frame *frame)
{
    p->ids.count = 0;
    for (uint32_t i = 0; i < p->frame.bonds; i++) {
        const uint32_t first = p->sphere[p->frame.bond[2 * (size_t)i]];
        const uint32_t second = p->sphere[p->frame.bond[2 * (size_t)i + 1]];
        const uint32_t low = first < second ? first : second, high = first < second ? second : first;
        if (first != BOND_NONE && second != BOND_NONE && bond_list_add(&p->ids, low, high))
            return trajectory_fail(t, 0, "not enough memory for the bonds");
    }
    frame->bonds = (uint32_t)p->ids.count;
    frame->bond = p->ids.count > 0 ? p->ids.pair : NULL;
    frame->bond_source = p->frame.bond_source;
    return 1;
}

/* A file with radii of its own has elements, or names its radii: this is for those with neither. Where the topology has
 * elements the unit of this file counts, else its radii are taken. */
static void set_radii(cgt_trajectory *t, const trajectory_topology *p, uint32_t count)
{
    const float unit = t->format->unit > 0.0f ? t->format->unit : 1.0f;
    for (size_t i = 0; i < count; i++) {
        const uint32_t atom = p->index[i];
        t->store.xyzr[4 * i + 3] = p->frame.element != NULL ? element_radius(p->frame.element[atom]) * unit
                                                            : p->frame.xyzr[4 * (size_t)atom + 3];
    }
}

int topology_complete(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    trajectory_topology *const p = t->topology;
    if (frame->kind != CGT_TRAJECTORY_SPHERES)
        return trajectory_fail(t, 0, "a mesh has no topology");
    if (p->file->failed) /* when columns were asked for: it was whole before */
        return trajectory_fail(t, 0, "the topology cannot be read: %.600s", p->file->message);
    p->has_bonds = p->frame.bond_source != CGT_TRAJECTORY_BONDS_UNKNOWN &&
                   (frame->bond_source == CGT_TRAJECTORY_BONDS_UNKNOWN || t->format->lists_some);
    if (map_spheres(t, p, frame) < 0 || (p->has_bonds && set_bonds(t, p, frame) < 0))
        return -1;
    const int takes_elements = frame->element == NULL && p->frame.element != NULL;
    const int takes_types = frame->type == NULL && p->frame.type != NULL;
    const int takes_ids = frame->id == NULL && p->frame.id != NULL;
    if (frame->element == NULL && t->options.radius == 0.0f && !frame->has_radius)
        set_radii(t, p, frame->count);
    for (size_t i = 0; i < frame->count; i++) {
        const uint32_t atom = p->index[i];
        t->store.element[i] = takes_elements ? p->frame.element[atom] : t->store.element[i];
        t->store.type[i] = takes_types ? p->frame.type[atom] : t->store.type[i];
        t->store.id[i] = takes_ids ? p->frame.id[atom] : t->store.id[i];
    }
    if (takes_elements && p->file->sites > 0) {
        t->sites = 0;
        for (size_t i = 0; i < frame->count; i++)
            t->sites += t->store.site[i] = p->file->store.site[p->index[i]];
        sites_set_radii(t, frame);
    }
    frame->element = takes_elements ? t->store.element : frame->element;
    frame->type = takes_types ? t->store.type : frame->type;
    frame->id = takes_ids ? t->store.id : frame->id;
    return 1;
}

/* Whether a column tells what atoms are, at any time. Words do, and these numbers: image flags, velocities, forces,
 * energies and whatever else a file may have are of the topology's own time. */
static int is_lasting(const cgt_trajectory_column *column)
{
    static const char *const lasting[] = {"id",
                                          "type",
                                          "typeid",
                                          "element",
                                          "Z",
                                          "numbers",
                                          "atomic_number",
                                          "atomic_numbers",
                                          "mol",
                                          "molid",
                                          "mol_id",
                                          "molecule",
                                          "body",
                                          "resid",
                                          "mass",
                                          "masses",
                                          "density",

                                          "q",
                                          "charge",
                                          "charges",
                                          "occupancy",
                                          "b_factor",
                                          "diameter",
                                          "site",
                                          "tags",
                                          "initial_charges",
                                          "lineflag",
                                          "bodyflag",
                                          "ellipsoidflag",
                                          "triangleflag",
                                          "template"};
    int is_known = column->kind == CGT_TRAJECTORY_WORD;
    for (size_t i = 0; i < sizeof lasting / sizeof lasting[0]; i++)
        is_known |= strcmp(column->name, lasting[i]) == 0;
    return is_known;
}

int topology_add_columns(cgt_trajectory *t, const cgt_trajectory_frame *frame)
{
    const trajectory_topology *const p = t->topology;
    for (uint32_t k = 0; k < p->frame.columns; k++) {
        const cgt_trajectory_column *const from = &p->frame.column[k];
        const int slot = is_lasting(from) ? columns_add_named(t, from->name, from->kind) : 0;
        if (slot < 0)
            return -1;
        if (slot == 0 || from->value == NULL)
            continue;
        if (columns_reserve(t, frame->count))
            return trajectory_fail(t, 0, "not enough memory for the column %s", from->name);
        if (from->kind == CGT_TRAJECTORY_WORD)
            columns_set_words(t, slot, from);
        for (uint32_t i = 0; i < frame->count; i++)
            columns_values(t, slot)[i] = from->value[p->index[i]];
    }
    return 1;
}

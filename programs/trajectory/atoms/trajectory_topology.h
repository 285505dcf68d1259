/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the spheres of a trajectory are, from another file: formats such as .xtc and .dcd have positions alone. */
#ifndef TRAJECTORY_TOPOLOGY_H
#define TRAJECTORY_TOPOLOGY_H

#include <cgt/trajectory.h>
#include "trajectory/atoms/trajectory_bonds.h"

typedef struct trajectory_topology {
    cgt_trajectory *file;
    cgt_trajectory_frame frame; /* its first one */
    bond_list ids;              /* of its atoms; and the bonds of the last frame */
    uint32_t *index;            /* the atom of each sphere of the last frame */
    uint32_t *sphere;           /* the sphere of each atom, BOND_NONE for those that the frame lacks */
    size_t index_capacity, sphere_capacity;
    int has_bonds; /* the last frame has its bonds */
} trajectory_topology;

/* Opens the file of options->topology for t and reads its first frame; t has the message of an error. */
cgt_result topology_open(cgt_trajectory *t, const char *path, const cgt_trajectory_options *options);

/* Reads the wanted columns, too. */
cgt_result topology_want_columns(cgt_trajectory *t, const char *const *names, size_t count);

/* Gives a frame what it lacks: elements, types, ids, bonds, radii. Atoms go by their ids where both files have some,
 * by their numbers where the ids of the frame are those from 1 on, else by their order. Returns 1 or -1. */
int topology_complete(cgt_trajectory *t, cgt_trajectory_frame *frame);

/* Adds the columns of the topology that the frame lacks and that hold at all times to its table. Returns 1 or -1. */
int topology_add_columns(cgt_trajectory *t, const cgt_trajectory_frame *frame);

void topology_close(trajectory_topology *p);

#endif

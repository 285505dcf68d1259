/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What goes through a periodic boundary of a frame's box: bonds, and the steps of speeds and trails. Each edge is
 * looked at by itself, in tilted boxes by its share of the height. */
#ifndef PERIODIC_BOX_H
#define PERIODIC_BOX_H

#include <cgt/trajectory.h>

/* From a difference of places to shares of the box's edges. Edges that nothing goes through have a row of zeros: they
 * are not periodic, or the positions are not wrapped along them. */
typedef struct periodic_box {
    double edge[3][3];
    double row[3][3];
    double near; /* a step that is shorter along x, y and z goes through no boundary */
} periodic_box;

periodic_box cgt_periodic_box_of(const cgt_trajectory_frame *frame);

/* A vector's share of an edge, and the height of the box across it; 0 along edges that nothing goes through. */
double cgt_periodic_box_share(const periodic_box *box, int e, const double vector[3]);
double cgt_periodic_box_height(const periodic_box *box, int e);

/* How many times each edge must be taken from b so that it is within half of that edge from a: count[e] is 0 along
 * edges whose boundary lies not between them. Returns whether one does. */
int cgt_periodic_box_crossed(const periodic_box *box, const float a[3], const float b[3], double count[3]);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What goes through a periodic boundary of a frame's box: bonds, and the steps of speeds and trails. It goes to
 * the nearest image, in tilted boxes, too. */
#ifndef PERIODIC_BOX_H
#define PERIODIC_BOX_H

#include <cgt/trajectory.h>

/* From a difference of places to shares of the box's edges. Edges that nothing goes through have a row of zeros: they
 * are not periodic, or the positions are not wrapped along them. */
typedef struct periodic_box {
    double edge[3][3];
    double row[3][3];
    double near; /* a step that is shorter along x, y and z goes through no boundary */
    double sure; /* half of the least height: no image of a vector of this length is shorter */
    int leans;   /* two edges with rows are not at right angles */
} periodic_box;

periodic_box cgt_periodic_box_of(const cgt_trajectory_frame *frame);

/* A vector's share of an edge, and the height of the box across it; 0 along edges that nothing goes through. */
double cgt_periodic_box_share(const periodic_box *box, int e, const double vector[3]);
double cgt_periodic_box_height(const periodic_box *box, int e);

/* The least of the vectors that differ from this one by edges of the box that something goes through. */
void cgt_nearest_image(const periodic_box *box, double vector[3]);

/* How many times each edge must be taken from a step so that it is the shortest: 0 along edges whose boundary it does
 * not go through, as a step of half an edge does not. Returns whether it goes through one. */
int cgt_periodic_box_count(const periodic_box *box, const double step[3], double count[3]);

/* The same of the step from a to b. */
int cgt_periodic_box_crossed(const periodic_box *box, const float a[3], const float b[3], double count[3]);

#endif

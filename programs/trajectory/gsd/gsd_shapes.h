/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shapes of particles in GSD: "particles/type_shapes", JSON for each type. */
#ifndef GSD_SHAPES_H
#define GSD_SHAPES_H

#include "trajectory/text/text_reader.h"

/* How a type is drawn. */
typedef enum gsd_shape {
    GSD_SHAPE_NONE,      /* nothing is told of it */
    GSD_SHAPE_SPHERE,    /* as it is */
    GSD_SHAPE_OF_VOLUME, /* an ellipsoid, as the sphere of its volume */
    GSD_SHAPE_OTHER      /* a polygon, polyhedron, mesh or union, as a sphere of the usual size */
} gsd_shape;

/* Reads the shape of a type; *radius stays where it tells no size. */
gsd_shape gsd_shape_read(text_span json, float *radius);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Families of rays: functions that fill an array with rays which are hard on a scene. Before, each ray has a range from
 * 0 to infinity and sees everything. */
#ifndef LINES_H
#define LINES_H

#include "driver/judge/judge.h"

typedef void line_maker(judge_scene *s, judge_ray *ray, uint32_t count);

line_maker any_lines;       /* from and to what is there, along axes, from afar, of any length and range */
line_maker garbage_lines;   /* two of three of any bits */
line_maker unusual_lines;   /* of any length, from afar, exactly through a place or as near as floats allow */
line_maker through_lines;   /* anywhere through the scene */
line_maker slab_lines;      /* at surfaces and corners, nearly along axes, with odd ranges */
line_maker lattice_lines;   /* from a lattice along axes and diagonals, and from one point: planes that split */
line_maker neighbour_lines; /* from one place, where boxes and primitives end, or near to it */
line_maker lamp_lines;      /* from anywhere to one place, where they end */
line_maker plane_lines;     /* in the plane of a flat scene, some that leave it very slowly */
line_maker slow_lines;      /* so slow that t is no float for most of what they meet */
line_maker speck_lines;     /* exactly through centres, a few short steps away */
line_maker long_lines;      /* along the axis of a scene in whole units, all of the line */
line_maker edge_lines;      /* in bundles from inside and from outside through edges and vertices of triangles */
line_maker capsule_lines;   /* through seams, tips and silhouettes of capsules, along their axes, from inside */
line_maker crossing_lines;  /* those of a closed mesh on a lattice */
line_maker afar_lines;      /* from afar, past tiny primitives */
line_maker case_lines;      /* those of a hard case */
line_maker band_lines;      /* between primitives of any magnitudes */

/* ---- places ---- */

/* A place that is worth it: a vertex, a centre, on a surface, on an edge, or anywhere. */
void line_place(judge_scene *s, float p[3]);

/* Beside a place, in its distance to another one: outside of what is there, at any scale. */
void line_place_beside(judge_scene *s, const float at[3], float p[3]);

/* Sums of four evenly spread numbers. */
float line_gauss(test_random *r);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What is no atom: sites of charges without mass, lone pairs, Drude particles, dummies, ghosts, vacancies. Readers
 * store one of the marks below in place of an element; here they become the column `site`, or are left out. */
#ifndef TRAJECTORY_SITES_H
#define TRAJECTORY_SITES_H

#include <cgt/trajectory.h>
#include "trajectory/text/text_reader.h"

#define SITE_MARK 255u     /* in place of an atomic number */
#define SITE_OF_WATER 254u /* the same where an atom of water is before it: M is a type in other files */
#define SITE_LIGHTEST 0.1  /* atomic mass units: what has less is no atom */

/* The mark for a name in a residue (empty: the file has none), or 0: it may be an atom. before: the name of the atom
 * before it in its residue, or empty. */
uint32_t site_find(text_span name, text_span residue, text_span before);

/* Sets which spheres of a frame are sites. Marks count where other spheres have elements. */
void sites_finish(cgt_trajectory *t, cgt_trajectory_frame *frame);

/* Gives sites their radius, where radii go by elements. */
void sites_set_radii(cgt_trajectory *t, const cgt_trajectory_frame *frame);

/* Leaves them out of a complete frame, where that is asked for. Returns 1 or -1. */
int sites_leave_out(cgt_trajectory *t, cgt_trajectory_frame *frame);

#endif

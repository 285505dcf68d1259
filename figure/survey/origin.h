/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The origin of a run that lies far from 0, where single precision rounds places so much that it shows: readers
 * subtract it in double (cgt_trajectory_set_origin). */
#ifndef ORIGIN_H
#define ORIGIN_H

#include <stddef.h>

#include "survey/bulk.h"

/* Finds an origin, as few decimal digits as do, near the middle of the bulk. It is needed where places are rounded to
 * more than a 32768th of the bulk, or a 64th of the spheres' radius. Returns 1, or 0 where none is needed. */
int cgt_origin_of_bulk(const bulk *b, double origin[3]);

/* The same for a camera: near its target, where places there are rounded to more than a 32768th of its distance. */
int cgt_origin_of_camera(const double eye[3], const double target[3], double origin[3]);

/* A sentence about an origin that was found. what: "the spheres are". */
void cgt_origin_tell(const double origin[3], const char *what, char *text, size_t size);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What is this? What doors find out of a figure's shown frame beside cgt_figure_pick: the ends of a bond, places that
 * stay on a triangle, and the spheres that a formula selects. */
#ifndef VIEW_ASK_H
#define VIEW_ASK_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/figure.h>
#include <cgt/trajectory.h>

/* The two spheres of the bond on whose surface a hit is. Returns whether there is one: boxes, trails, arrows and floors
 * are hit, too. */
int view_ask_bond(const cgt_figure *figure, const cgt_figure_hit *hit, uint32_t ends[2]);

/* The shares of a triangle's second and third corner at a place in its plane, and the place that has these shares. */
void view_ask_shares(const cgt_trajectory_frame *frame, uint32_t triangle, const float place[3], double share[2]);
void view_ask_place(const cgt_trajectory_frame *frame, uint32_t triangle, const double share[2], float place[3]);

/* How many spheres of a frame a formula selects, and the mean of their places; -1 with a sentence. */
int64_t view_ask_select(const cgt_figure_frame *frame, const char *formula, double center[3], char *why, size_t size);

#endif

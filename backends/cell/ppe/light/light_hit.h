/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Hits as SPEs compute them (cell/image/light_rays.h), one at a time. */
#ifndef CGT_LIGHT_HIT_H
#define CGT_LIGHT_HIT_H

#include <stdbool.h>

/* Where a ray hits a sphere, x, y, z, radius, that it is known to hit, and the normal there, of the radius' length. */
void cgt_light_hit(const float eye[3], const float dir[3], float t_min, const float sphere[4], float point[3],
                   float normal[3]);
bool cgt_light_normal_looks_away(const float normal[3], const float dir[3]);

#endif

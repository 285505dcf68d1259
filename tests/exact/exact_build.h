/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Compiles the library's exact stage again under the name EXACT_BUILD (exact_builds.h). A file defines the settings
 * and includes this once. */
#include <stdbool.h>
#include <stdint.h>

#define EXACT_JOIN_(build, name) exact_##build##_##name
#define EXACT_JOIN(build, name) EXACT_JOIN_(build, name)
#define EXACT_TEXT_(x) #x
#define EXACT_TEXT(x) EXACT_TEXT_(x)

#define cgt_exact_line_hits_triangle EXACT_JOIN(EXACT_BUILD, line_meets_triangle)
#define cgt_exact_triangle_side EXACT_JOIN(EXACT_BUILD, triangle_side)
#define cgt_exact_sphere_roots EXACT_JOIN(EXACT_BUILD, sphere_roots)
#define cgt_exact_capsule_roots EXACT_JOIN(EXACT_BUILD, capsule_roots)
#define cgt_exact_capsule_u EXACT_JOIN(EXACT_BUILD, capsule_u)
#define cgt_exact_capsule_dots EXACT_JOIN(EXACT_BUILD, capsule_dots)
#define cgt_exact_capsule_middle EXACT_JOIN(EXACT_BUILD, capsule_middle)
#define cgt_exact_capsule_plane EXACT_JOIN(EXACT_BUILD, capsule_plane)
#define cgt_exact_cylinder_terms EXACT_JOIN(EXACT_BUILD, cylinder_terms)
#define cgt_exact_compare EXACT_JOIN(EXACT_BUILD, compare)
#define cgt_exact_t EXACT_JOIN(EXACT_BUILD, t)
#define cgt_exact_uv EXACT_JOIN(EXACT_BUILD, uv)
#define cgt_exact_normal EXACT_JOIN(EXACT_BUILD, normal)
#define cgt_exact_crossing EXACT_JOIN(EXACT_BUILD, crossing)
#define cgt_exact_crossing_t_sign EXACT_JOIN(EXACT_BUILD, crossing_t_sign)
#define cgt_exact_sphere_signs EXACT_JOIN(EXACT_BUILD, sphere_signs)
#define cgt_exact_plane_terms EXACT_JOIN(EXACT_BUILD, plane_terms)
#define cgt_exact_sphere_terms EXACT_JOIN(EXACT_BUILD, sphere_terms)
#define cgt_exact_edge_terms EXACT_JOIN(EXACT_BUILD, edge_terms)
#define cgt_exact_shift_terms EXACT_JOIN(EXACT_BUILD, shift_terms)
#define cgt_exact_normal_terms EXACT_JOIN(EXACT_BUILD, normal_terms)

#include "exact/integer/exact_terms.c"
#include "exact/integer/exact_crossing.c"
#include "exact/integer/exact_decide.c"
#include "exact/integer/exact_value.c"

#include "exact/exact_builds.h"

#define EXACT_BUILD_STRUCT_(build) exact_##build
#define EXACT_BUILD_STRUCT(build) EXACT_BUILD_STRUCT_(build)

const exact_build EXACT_BUILD_STRUCT(EXACT_BUILD) = {
    .name = EXACT_TEXT(EXACT_BUILD),
    .line_meets_triangle = cgt_exact_line_hits_triangle,
    .triangle_side = cgt_exact_triangle_side,
    .sphere_roots = cgt_exact_sphere_roots,
    .capsule_roots = cgt_exact_capsule_roots,
    .capsule_u = cgt_exact_capsule_u,
    .compare = cgt_exact_compare,
    .t = cgt_exact_t,
    .uv = cgt_exact_uv,
    .normal = cgt_exact_normal,
    .crossing = cgt_exact_crossing,
    .crossing_t_sign = cgt_exact_crossing_t_sign,
};

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Crossings: each closed surface once, also where a ray goes through edges or vertices, along a face, or begins on the
 * surface. All questions are asked of a ray that is moved aside, in thought, by the same shift e = (h^4, h^5, h^6) for
 * every ray and primitive, h > 0 smaller than any number that a question depends on (H. Edelsbrunner, E. P. Muecke,
 * "Simulation of Simplicity", 1990; here the line alone is moved, the primitives stay). Each question is the sign of a
 * polynomial in h: that of its first coefficient that is not 0. The constant one is what the ray itself gives, so only
 * zeros are decided by the others.
 *
 *   Edge    w = d.(P x Q) for the edge from p to q, P = p - org, Q = q - org, becomes w + e.(d x (q - p)), since
 *           e x e = 0. It is 0 only where the edge is parallel to d
 *   Plane   t = n.(v0 - org) / d.n becomes (n.(v0 - org) - e.n) / d.n. It is never 0, since n is not
 *   Sphere  c.c - r^2 becomes c.c - r^2 - 2 e.c + e.e, which is not 0 either
 *
 * Why these powers. All that triangles are asked is linear in e: the first component of a vector that is not 0 decides,
 * x before y before z, whatever the powers are, as long as they ascend. Of spheres e.e = h^8 + h^10 + h^12 counts too.
 * Powers that are above half the greatest let all linear terms come before all squares: the first component of c that
 * is not 0 decides, the origin is moved inwards where it is above 0, and only a point, c = 0 and r = 0, is left to e.e,
 * outside. With (h, h^2, h^3) the coefficient of h^2 would be 1 - 2 c_y: answers would depend on the unit of length.
 * Here another unit multiplies each coefficient by a number above 0.
 *
 * Why spheres and meshes agree. Finitely many polynomials have their final signs for all h below some h0. So answers
 * about one point are true of one real point, org + e(h) with any such h, against all primitives at once: what holds
 * of every real point on no surface, holds of the answers. A point is in one of two bodies that share a face, in a ball
 * if it is in a box within the ball, in no two bodies that merely touch.
 *
 * A triangle is crossed where its three w have one sign. That of d.n, their sum, tells whether the line goes along the
 * normal, out of the body, or into it.
 *
 * Why the count is right. Seen along d, the moved line is a point x, a triangle its projection. One with an edge
 * parallel to d, or with d in its plane, is projected to a segment or a point, and is not crossed. The others: x lies
 * on none of their edges, so it is inside or outside of each, and the sign that they cross with is the winding number
 * of the projected boundary around x. That is a sum over edges of a function that changes sign with the edge's
 * direction and depends on its two places alone. On a closed mesh, in which each edge from p to q has one from q to p
 * as its partner, by the floats of p and q, it is 0: the line enters as often as it leaves. If edges merely come in
 * even numbers, the count is even. With a ray in place of the line, the moved origin cuts the crossings in two, and
 * what lies ahead gives its winding number, or parity: the same along every d, since between two directions it can
 * change only where the origin is on the surface, and the moved one is on none. A triangle without area is projected
 * to a segment, so that it does not count, as one that is not in the scene. The same shift for all makes a point that
 * lies on several bodies which together fill a space belong to exactly one of them.
 *
 * A line that meets a sphere at two places still does when it is moved, and goes in at the first and out at the second.
 * One that touches it is moved off it, or into it and out of it at one place, which adds nothing to a sum: such a hit
 * is no crossing. A ray that begins there, moved into the sphere, has the way in behind it: the hit is a crossing, out
 * of the sphere. So what lies ahead of a moved origin adds 1 if it is in the sphere, else 0, along every d.
 *
 * A crossing is a hit: where the w of the moved line have one sign, none of the others differs, and not all are 0. So
 * its t and its order are those of the hit, which differ from the moved ones by no finite number. */
#ifndef CGT_CROSSING_H
#define CGT_CROSSING_H

#include "exact/decide.h"

/* How the moved line crosses a triangle: 1 along its normal, out of the body, -1 into it, 0 not at all. */
int cgt_decide_crossing(const cgt_ray *ray, const cgt_triangle *triangle, uint64_t *exact);

/* Whether a hit of a ray, whose line meets the primitive at `roots` places, is a crossing. At t_min = 0 the ray begins
 * at its moved origin. */
bool cgt_decide_hit_crosses(const cgt_ray *ray, const cgt_decided_hit *hit, int roots, uint64_t *exact);

/* Of a crossing: 1 where the ray leaves the body, -1 where it enters it. */
int cgt_decide_crossing_side(const cgt_ray *ray, const cgt_decided_hit *hit, uint64_t *exact);

/* Whether the moved origin of a ray is in a sphere. */
bool cgt_decide_sphere_contains(const cgt_ray *ray, cgt_sphere sphere, uint64_t *exact);

#endif

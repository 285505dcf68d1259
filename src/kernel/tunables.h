/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Constants that tests replace, by defining them before they include a kernel: bounds are tightened until they break,
 * buffers made as small as they may be, and choices forced. The library is built with the values below. */
#ifndef CGT_TUNABLES_H
#define CGT_TUNABLES_H

#include "vector.h"

/* ---- bounds ---- */

/* The unit roundoff u of single precision, in every bound of a filter. The bounds are derived with 2^-24; they are of
 * first order in u, hold for reciprocals and roots within 2^-21, which is 8 u or 4 u, and so hold for either value. */
#ifndef FILTER_ROUNDOFF
#define FILTER_ROUNDOFF SPUX_ROUNDOFF
#endif

/* The relative error of spu_rsqrte. */
#if CGT_LANES == 16
#define TILE_RSQRT_ERROR 0x1p-14f
#else
#define TILE_RSQRT_ERROR 0x1.8p-12f
#endif

/* Factors of the errors of a frustum (packet/frustum.h), of the cones around blocks (packet/block_cones.h), and of the t
 * before which no ray meets a sphere (primitive/filter.h). */
#ifndef FRUSTUM_ERROR_SCALE
#define FRUSTUM_ERROR_SCALE 1.f
#endif
#ifndef CONE_ERROR_SCALE
#define CONE_ERROR_SCALE 1.f
#endif
#ifndef MIN_T_ERROR_SCALE
#define MIN_T_ERROR_SCALE 1.f
#endif

/* Factor of the slabs' error E (bvh/bvh_ray.h). */
#ifndef BVH_ERROR_SCALE
#define BVH_ERROR_SCALE 1.f
#endif

/* Factor of what a ray adds to the margins of planes (bih/bih_rays.h). */
#ifndef BIH_ERROR_SCALE
#define BIH_ERROR_SCALE 1.f
#endif

/* The margin of a light's frustum, as a share of the largest coordinates: derived in light/light_packet.h. */
#ifndef LIGHT_MARGIN
#define LIGHT_MARGIN 0x1p-17f
#endif

/* ---- programs for an SPU ---- */

/* Quotient and root of single floats. Programs that are to give an SPU's bits on a host take the words': what a
 * compiler makes of these is its own matter. */
#ifndef SCALAR_DIVIDE
#define SCALAR_DIVIDE(a, b) ((a) / (b))
#define SCALAR_SQRT(a) __builtin_sqrtf(a)
#endif

/* 1 over a power of two. A quotient of an SPU need not be exact. */
#ifndef POWER_RECIPROCAL
#define POWER_RECIPROCAL(power) (1 / (power))
#endif

/* Whether somebody else decides if primitive `prim` is the closest hit of ray i of packet p, and has been told. The
 * ray's best hit then is the best of those that are certain. */
#ifndef FILTER_DEFER
#define FILTER_DEFER(p, i, prim) false
#endif

/* Scenes have no triangles: their tests are left out. */
#ifndef CGT_ONLY_SPHERES
#define CGT_ONLY_SPHERES false
#endif

/* Whether a packet may have FAST precision: programs of EXACT alone leave its tests out. */
#ifndef PACKET_IS_FAST
#define PACKET_IS_FAST(p) ((p)->fast)
#endif

/* Whether kd-trees are traversed ray by ray where the settings say so. */
#ifndef KD_SINGLE_RAYS
#define KD_SINGLE_RAYS true
#endif

/* The arrays of a kd-tree. Programs that keep but parts of them at hand look here whether an element is: a pointer to a
 * node, behind which its sibling lies where it is a lower child, is good until the next one is asked for, a pointer to a
 * leaf likewise. KD_TEST_NODE tests a vector of rays against the primitives of a leaf that is a node without ropes,
 * KD_TEST_LEAF against those of one with ropes. */
#ifndef KD_NODES
#define KD_NODES(tree, i) (&(tree)->node[i])
#define KD_LEAF(tree, i) (&(tree)->leaf[i])
#define KD_TEST_NODE(tree, l, rays, n, i) leaf_test_vector(l, rays, cgt_kd_references(tree, &(n)), cgt_kd_count(n), i)
#define KD_TEST_LEAF(tree, l, rays, of, i) leaf_test_vector(l, rays, (tree)->reference + (of)->first, (of)->count, i)
#endif

/* Called with each node that is pushed, to be visited after its sibling. */
#ifndef KD_AHEAD
#define KD_AHEAD(n) ((void)0)
#endif

/* Programs that get their trees from elsewhere watch them; the library builds its own. KD_IS_BROKEN, at a leaf: the
 * vector of rays has visited more than `most` inner nodes, of which a tree has each once, or pushed more than the deepest
 * tree does; it stops then, and the program keeps it in mind. KD_PLACE: of an entry in a stack of KD_STACK, which no tree
 * fills. KD_IS_TOO_DEEP: that many inner nodes in one way down along ropes. */
#ifndef KD_IS_BROKEN
#define KD_IS_BROKEN(nodes, most, top) ((void)(most), false)
#define KD_STACK CGT_KD_MAX_DEPTH
#define KD_PLACE(top) (top)
#define KD_IS_TOO_DEEP(depth) ((void)(depth), false)
#endif

/* The exact order of two times. Programs whose doubles do not round to nearest take whole numbers alone. */
#ifndef ROPE_PLANE_ORDER
#define ROPE_PLANE_ORDER cgt_plane_order
#endif

/* Whether a queue grid's references take 32 bits. Programs of few primitives leave that out. */
#ifndef GRID_REFS_ARE_32_BITS
#define GRID_REFS_ARE_32_BITS(grid) ((grid)->refs_are_32_bits)
#endif

/* Whether a queue grid's fill stops before a primitive whose references the overflow list might not hold. If not, it
 * counts what does not fit, and leaves it out. */
#ifndef FILL_STOPS
#define FILL_STOPS true
#endif

/* References of a packet's list in a grid. */
#ifndef PACKET_MAX_PRIMS
#define PACKET_MAX_PRIMS 144u
#endif

/* A queue grid's packet that spreads over more cells of a slice than this many per ray is halved. Measured with
 * shuffled rays; flat from half to twice as many. */
#ifndef CELLS_PER_RAY
#define CELLS_PER_RAY 3.f
#endif

/* ---- buffers ---- */

/* Words of a stream's arena that lists may take. */
#ifndef STREAM_ARENA_USED
#define STREAM_ARENA_USED CGT_STREAM_ARENA
#endif

/* Entries of an interleaved ray's stack that it may take. */
#ifndef INTERLEAVED_STACK_USED
#define INTERLEAVED_STACK_USED INTERLEAVED_STACK
#endif

/* ---- choices ---- */

/* A call's rays are interleaved where streams would be short: where an octant has fewer rays than the first number, or
 * than more of them if they start far apart, up to a limit. Measured, with the rays of `cgt-bench rays`. Closest
 * hits: half the growth, half the limit. */
#ifndef INTERLEAVE_MIN_RAYS
#define INTERLEAVE_MIN_RAYS 8.f
#define INTERLEAVE_SPREAD_RAYS (CGT_LANES == 16 ? 300.f : CGT_LANES == 8 ? 600.f : 1000.f)
#define INTERLEAVE_MAX_RAYS (CGT_LANES == 16 ? 160.f : CGT_LANES == 8 ? 320.f : 640.f)
#endif

/* Work, in nodes visited and primitives tested, that a packet of a light's rays may take in the BVH before its chunk is
 * traced ray by ray. Measured. */
#ifndef LIGHT_PACKET_WORK
#define LIGHT_PACKET_WORK 160u
#endif

/* ---- observation ---- */

/* Called for each leaf that a ray along ropes visits: lanes are those of a vector whose first ray is `first` of the
 * packet. */
#ifndef ROPE_VISIT
#define ROPE_VISIT(first, lanes, leaf) ((void)0)
#endif

#endif

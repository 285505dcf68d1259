/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What programs for an SPU change in the kernels of the papers: they define it before they include them. A program's
 * trees lie in main memory and come from elsewhere, its quotients are its words', and it leaves doubts to the PPE. The
 * library is built with the values below. */
#ifndef CGT_SPU_PROGRAMS_H
#define CGT_SPU_PROGRAMS_H

/* Quotient and root of single floats. Programs that are to give an SPU's bits on a host take the words': what a
 * compiler makes of these is its own matter. */
#ifndef SCALAR_DIVIDE
#define SCALAR_DIVIDE(a, b) ((a) / (b))
#define SCALAR_SQRT(a) __builtin_sqrtf(a)
#endif

/* FILTER_DEFERS: somebody else decides if primitive `prim` is the closest hit of ray i of packet p. FILTER_DEFER tells
 * them, and returns true. The ray's best hit then is the best of those that are certain. */
#ifndef FILTER_DEFERS
#define FILTER_DEFERS false
#define FILTER_DEFER(p, i, prim) ((void)(p), (void)(i), (void)(prim), false)
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
 * node, behind which its sibling lies where it is a lower child, is good until the next one is asked for, a pointer to
 * a leaf likewise. KD_TEST_NODE tests a vector of rays against the primitives of a leaf that is a node without ropes,
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
 * vector of rays has visited more than `most` inner nodes, of which a tree has each once, or pushed more than the
 * deepest tree does; it stops then, and the program keeps it in mind. KD_PLACE: of an entry in a stack of KD_STACK,
 * which no tree fills. KD_IS_TOO_DEEP: that many inner nodes in one way down along ropes. */
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

#endif

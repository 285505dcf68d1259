/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * libcgt for all hits along rays, not only the nearest: what lies behind, how thick, how often. The conventions are
 * those of cgt.h. In outline, for at most four hits a ray:
 *
 *   rows.capacity = 4;
 *   rows.hits.t = t, rows.hits.primitive = primitive;     4 * rays.count elements
 *   rows.count = count;                                   rays.count elements
 *   cgt_trace_all_rays(scene, &rays, NULL, &rows, NULL);
 *   hit j < count[i] of ray i is element 4 * i + j
 *
 * Which:  every hit whose t is in the ray's range: a sphere's and a capsule's near and far surface, each by itself; one
 *         that the ray only touches, once; a triangle once. Masks, skipped primitives, invalid rays, ranges, precision
 *         and values are those of cgt_trace_rays. The first hit is the one that it finds, bit for bit; research.h's
 *         triangle tests are for cgt_trace_rays alone
 * Order:  by exact distance, then by geometry, then by primitive: a total order, in which no two hits are equal. Floats
 *         of t may be. In precision FAST they may even descend: t is less exact than the order
 * Going on: a restart at t_min = t meets hits of equal t again, or none of them. `after` names a hit by its primitive,
 *         which tells its exact place: hits after it, and no others, follow. So calls that go on where others ended
 *         find together what one call finds */
#ifndef CGT_ALL_HITS_H
#define CGT_ALL_HITS_H

#include <cgt/cgt.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What is asked of all hits. */
typedef struct cgt_all_hits_options {
    /* Each ray's hits begin after this hit of its line: element i of each at byte i * after_stride. It need not be in
     * the ray's range, nor visible to it. A ray whose line has no such hit is invalid: it hits nothing, and is
     * counted. */
    const uint32_t *after_primitive; /* CGT_INVALID_ID: at its t_min. NULL (default): all do */
    const uint32_t *after_geometry;  /* NULL (default): 0 for all. Not read if after_primitive is NULL, as the next */
    const uint32_t *after_surface;   /* cgt_surface. NULL (default): the near one */
    size_t after_stride;             /* bytes, a multiple of 4; 0 (default): 4 */
    bool crossings;                  /* only hits that are crossings; see below. false (default): all */
} cgt_all_hits_options;

/* Fills in the defaults. */
CGT_API void cgt_all_hits_options_init(cgt_all_hits_options *options);

/* Rows of hits in the caller's arrays: hit j of ray i is element i * capacity + j of each array of hits. Elements of a
 * row beyond its hits stay as they are. */
typedef struct cgt_hit_rows {
    uint32_t capacity; /* hits that a row holds, 1 or more: the first ones of a ray */
    cgt_hits hits;     /* rays->count * capacity elements */
    uint32_t *surface; /* cgt_surface, as many, with the stride of hits.t. NULL: not wanted */
    uint32_t *count;   /* gets the hits in each ray's row; rays->count elements, one after another */
    /* Gets 1 if the ray has more hits than its row holds, else 0; rays->count bytes. NULL: not wanted, which spares
     * the search for one more hit. */
    uint8_t *more;
} cgt_hit_rows;

/* Traces rays to their first hits, at most rows->capacity each; may build a BVH in the scene first.
 *   rays      as of cgt_trace_rays
 *   all       NULL: the defaults
 *   rows      gets the hits
 *   options   NULL: the defaults. Its statistics count hits, not rays that have some
 * Speed:   four hits of rays in no order take up to twice as long as the nearest one; of neighbours, 2.5 to 4 times
 * Errors:  as cgt_trace_rays; INVALID_ARGUMENT (capacity, or no count) */
CGT_API cgt_result cgt_trace_all_rays(const cgt_scene *scene, const cgt_rays *rays, const cgt_all_hits_options *all,
                                      const cgt_hit_rows *rows, const cgt_trace_options *options);

/* Gets hits of a ray, in order, 1 to 64 a call; further calls for the same ray follow on the same thread. Rays without
 * a hit are not visited. CGT_VISIT_STOP ends the trace: cgt_visit_all_rays then returns CGT_ERROR_STOPPED.
 *   ray       its number in the arrays
 *   hits      valid during the call
 * Order:   of rays, any
 * Threads: those that trace, several at once, in the floating-point environment of the call */
typedef cgt_visit cgt_hits_visitor(void *user, uint64_t ray, const cgt_hit *hits, uint32_t count);

/* Traces rays to all their hits, any number; may build a BVH in the scene first.
 *   rays      as of cgt_trace_rays
 *   all       NULL: the defaults
 *   fields    cgt_field values that the visitor wants, combined: NORMAL and UV are 0 if they are not among them; t,
 *             primitive, geometry and surface are always there. POSITION is INVALID_ARGUMENT
 *   visitor   gets the hits; user is passed to it
 *   options   as of cgt_trace_all_rays
 * Errors:  as cgt_trace_rays; STOPPED */
CGT_API cgt_result cgt_visit_all_rays(const cgt_scene *scene, const cgt_rays *rays, const cgt_all_hits_options *all,
                                      uint32_t fields, cgt_hits_visitor *visitor, void *user,
                                      const cgt_trace_options *options);

/* Traces one ray to its first hits; may build a BVH in the scene first. To go on, let `all` point into the last hit.
 *   ray        as of cgt_trace_ray
 *   all        NULL: the defaults; element 0 of its arrays is read
 *   hits       gets the hits, room for `capacity`, 1 or more
 *   count      gets how many
 *   more       gets whether there are more; NULL: not wanted
 *   options    as of cgt_trace_all_rays
 * Threads: the calling one traces
 * Errors: as cgt_trace_rays */
CGT_API cgt_result cgt_trace_all_ray(const cgt_scene *scene, const cgt_single_ray *ray, const cgt_all_hits_options *all,
                                     cgt_hit *hits, uint32_t capacity, uint32_t *count, bool *more,
                                     const cgt_trace_options *options);

/* ---- Crossings and points inside -------------------------------------------------------------------------------- */

/* Crossings count how often a ray goes into closed surfaces and out of them. A hit at an edge belongs to two triangles
 * or more, one at a vertex to several, and a ray may graze a body there; of these hits crossings are those that count:
 * as many as the line would have if it were moved aside by (h^4, h^5, h^6), h > 0 smaller than any number that matters
 * (H. Edelsbrunner, E. P. Muecke, "Simulation of Simplicity", 1990). They are decided exactly, and do not depend on the
 * unit of length. cgt_surface tells their side: NEAR goes in, FAR out.
 *   Closed    a mesh in which, by the floats of its vertices, each edge from p to q has one from q to p as its partner.
 *             Along any ray from outside to outside a closed mesh is entered as often as it is left; if partners run
 *             the same way, as in meshes of mixed orientation, the number of crossings is still even. Duplicate
 *             vertices, coincident triangles, triangles without area, and parts that pass through each other do no harm
 *   Spheres   are crossed at both surfaces; not where a ray merely touches one, or a point. A ray that begins where it
 *             touches a sphere, and is moved into it, leaves it there
 *   Capsules  have no crossings: calls that ask for some in a scene with capsules are UNSUPPORTED
 *   Range     that of hits, with one exception: at t_min = 0 the ray begins at its moved origin, which is on no
 *             surface. So the sum of crossings ahead does not depend on the direction
 *   Order     that of hits. Where t is equal, a body may be left before it is entered: sums are right after all
 *             crossings of one t */

/* What makes a point be inside a geometry of triangles. */
typedef enum cgt_inside_rule {
    CGT_INSIDE_PARITY = 0, /* a ray from it has an odd number of crossings. Meshes need no orientation */
    /* A ray from it does not go in as often as out: parts of one geometry that overlap are united. Triangles are
     * oriented alike, inwards or outwards. */
    CGT_INSIDE_WINDING
} cgt_inside_rule;

typedef struct cgt_inside_options {
    cgt_inside_rule rule;
} cgt_inside_options;

/* Fills in the defaults. */
CGT_API void cgt_inside_options_init(cgt_inside_options *options);

/* Finds which points are inside of bodies; may build a BVH in the scene first. A geometry of triangles, closed, is a
 * body, or several; so is each sphere. A point is inside if it is in any of them that its mask sees.
 *   points    neighbours in the arrays should be neighbours in space. t_min, t_max, and primitives to skip are not read
 *   how       NULL: the defaults
 *   inside    gets points->count bytes: 1 if the point is inside, else 0
 *   options   NULL: the defaults. Its statistics count points as rays, those inside as hits
 * Surface:  decided exactly, for a point moved by (h^4, h^5, h^6) as above: x counts before y, y before z. So a point
 *           on a surface is inside or not: on a sphere it is if the centre is beyond it along the first axis along
 *           which they differ. Of bodies that together fill a space, such as cells with common faces, exactly one has
 *           it
 * Open:     a mesh that is not closed has no inside: results are the same bits for any structure, variant and number of
 *           threads, but depend on a direction that the library chooses
 * Invalid:  a NaN or an infinity in the point: not inside, counted
 * Speed:    spheres are looked up around the point if there is a BVH; for triangles, one ray goes to the nearest face
 *           of the scene's bounds, as long as there are no more than 16,384 geometries
 * Errors:   as cgt_trace_rays; INVALID_ARGUMENT (rule), UNSUPPORTED (the scene has capsules) */
CGT_API cgt_result cgt_points_inside(const cgt_scene *scene, const cgt_points *points, const cgt_inside_options *how,
                                     uint8_t *inside, const cgt_trace_options *options);

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * libcgt for mirrors and glass: from rays and what they have hit to the rays that go on from there, as arrays, a whole
 * bounce at once (T. Whitted, "An Improved Illumination Model for Shaded Display", 1980). The conventions are those of
 * cgt.h. In outline, for a scene of glass:
 *
 *   cgt_trace_rays(scene, &rays, &hits, NULL);
 *   for (each bounce) {
 *       cgt_bounce_rays(scene, &rays, &hits, &glass, NULL, &reflected, &refracted, NULL);
 *       (keep what has enough of the light, make it the next rays)
 *       cgt_trace_bounced_rays(scene, &rays, &hits, NULL);
 *   }
 *
 * No offset is needed: a ray skips the primitive that it leaves, and starts at the float next to the place. Such a
 * start may lie beyond a surface that is nearer than the distance of two floats; picture/whitted shows how to keep
 * even such surfaces apart, by state instead of distance. */
#ifndef CGT_BOUNCES_H
#define CGT_BOUNCES_H

#include <cgt/cgt.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Indices of refraction on both sides of what rays hit. The inside of a sphere is where its centre is, that of a
 * capsule where its axis is, that of a triangle the side that its normal, (v1 - v0) x (v2 - v0), points away from. An
 * index is finite and above 0. */
typedef struct cgt_media {
    float inside;  /* of all; 0 (default): opaque, nothing is refracted */
    float outside; /* of all; 0 (default): 1 */
    /* The same for each ray, of the surface that ray i hits: element i at byte i * stride. NULL: what follows, or the
     * above. */
    size_t stride; /* bytes, a multiple of 4; 0 (default): 4 */
    const float *inside_of_ray, *outside_of_ray;
    /* The same for each primitive: inside_of_primitive[g][p] for geometry g, primitive p. Geometries from `geometries`
     * on, and those whose pointer is NULL, have `inside`. NULL: all have it. */
    const float *const *inside_of_primitive;
    uint32_t geometries;
} cgt_media;

/* Surfaces that rays have hit, in the caller's arrays: element i of each at byte i * stride. NULL: not wanted. If ray i
 * has no surface, all its numbers are 0. */
typedef struct cgt_surfaces {
    size_t stride;       /* bytes, a multiple of 8; 0 (default): 8 */
    double *position[3]; /* of the hit, in world units; all three or none */
    double *normal[3];   /* outward, of unit length; all three or none */
    /* A float next to the position, on the side that the ray came from, axis by axis: where the new rays begin, and
     * rays to lights may; all three or none. */
    float *start[3];
    double *length;  /* from the ray's origin to the position, in world units; 0 for hits behind it */
    uint32_t *front; /* 1 if the ray comes from outside, else 0 */
} cgt_surfaces;

/* Rays that leave surfaces, in the caller's arrays: element i, at byte i * stride, of origins and directions at byte
 * i * vector_stride, belongs to ray i. They fit cgt_rays.
 * A ray that is not there (see cgt_bounce_rays) is off: t_min 0, t_max -1, origin 0, direction (0, 0, 1), no primitive
 * to skip, share 0. */
typedef struct cgt_bounced_rays {
    size_t stride;        /* bytes, a multiple of 4; 0 (default): 4 */
    size_t vector_stride; /* of org and dir: bytes, a multiple of 4; 0 (default): stride */
    float *org[3];        /* as `start` of cgt_surfaces */
    float *dir[3];        /* of unit length */
    /* +infinity, or where a ray inside a sphere or a capsule meets that again: see cgt_trace_bounced_rays */
    float *t_max;
    float *t_min;             /* gets 0; NULL: not wanted, and so are the next three */
    uint32_t *skip_primitive; /* the primitive that it leaves */
    uint32_t *skip_geometry;
    float *share; /* of the light that the new ray sees, how much goes along the old one: 0 to 1 */
} cgt_bounced_rays;

/* Makes the rays that go on from what rays have hit: mirrored, and refracted by Snell's law. Fresnel's equations share
 * unpolarised light among the two (not Schlick's approximation).
 *   rays        the rays: org and dir are read, and what they skip, if it is not NULL: a sphere or a capsule that is
 *               hit although it is skipped is hit from inside
 *   hits        what they have hit: t and primitive, and geometry if it is not NULL, else 0 for all; read only. Planes
 *               of a frame will do
 *   media       NULL: everything is a mirror; a reflected ray then has share 1
 *   surfaces    gets the surfaces; NULL: not wanted
 *   reflected   gets the mirrored rays; NULL: not wanted
 *   refracted   gets the refracted rays; NULL: not wanted
 *   options     NULL: the defaults. Statistics: rays; hits, those with a surface; invalid_rays; trace_ms
 * Surface:  a ray without a hit has none. Neither has an invalid one: a hit with a NaN or an infinity in origin,
 *           direction or t, a zero direction, a primitive that is not there or has the radius 0, an index that is not
 *           finite and above 0, or a place beyond the range of float
 * Off:      new rays without a surface; a refracted ray if the surface is opaque or all light is reflected; a reflected
 *           one if both indices are equal. The other ray then has share 1
 * Values:   t only tells which root of a sphere or a capsule was hit. Place, normal and directions are computed in
 *           double from the floats of ray and primitive, and rounded once; so is whether all light is reflected. If the
 *           ray's plane is so slanted that t is the better number, a triangle's place is org + t dir
 * Accuracy: a direction is within 2^-23 along each axis, as long as c / h < 2^18 for a sphere (c the distance of the
 *           ray's origin to its centre, h half the chord), k < 2^18 for a triangle (k the product of two edges over its
 *           area). A capsule is a sphere around the point of its axis that is nearest to the hit, with c the distance
 *           to its farther end. A share is within 2^-22, a place on the surface but for rounding in double
 * Memory:   none. An array of `reflected` or `refracted` may be that of `rays` or of `hits`, with the same stride: an
 *           element is read before it is written
 * Threads:  one task per 4,096 rays; any number of threads and any variant give the same bits
 * Errors:   INVALID_ARGUMENT (arrays that are missing, strides, `inside` or `outside`), NOT_COMMITTED, TOO_LARGE (count
 *           times stride) */
CGT_API cgt_result cgt_bounce_rays(const cgt_scene *scene, const cgt_rays *rays, const cgt_hits *hits,
                                   const cgt_media *media, const cgt_surfaces *surfaces,
                                   const cgt_bounced_rays *reflected, const cgt_bounced_rays *refracted,
                                   const cgt_trace_options *options);

/* Traces rays of cgt_bounce_rays to their nearest hits; may build a BVH in the scene first. It does what cgt_trace_rays
 * does, except for rays inside spheres and capsules. These skip theirs, as others do, and meet it again at its far
 * root, which is their t_max. If nothing is nearer, by roots in double, that is their hit.
 *   rays      as of cgt_trace_rays. A ray is inside a sphere or a capsule if it skips one and its t_max has the bits
 *             that cgt_bounce_rays gives it; t_min does not matter for that hit. t_max must not be NULL
 *   hits      as of cgt_trace_rays; t, primitive and geometry must not be NULL. The normal of such a hit is computed in
 *             double and rounded, and so is u
 *   options   as of cgt_trace_rays, whose statistics do not count these hits
 * Errors: as cgt_trace_rays; INVALID_ARGUMENT if an array is missing */
CGT_API cgt_result cgt_trace_bounced_rays(const cgt_scene *scene, const cgt_rays *rays, const cgt_hits *hits,
                                          const cgt_trace_options *options);

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The planes of hits, by name or by number, and regions of them. */
#ifndef CGT_REGION_H
#define CGT_REGION_H

#include <stdbool.h>

#include <cgt/cgt.h>

/* The planes of a frame: 4 bytes per pixel in each, float or uint32_t. */
typedef enum cgt_plane {
    CGT_PLANE_T,
    CGT_PLANE_PRIMITIVE,
    CGT_PLANE_GEOMETRY,
    CGT_PLANE_NORMAL, /* three of them */
    CGT_PLANE_U = CGT_PLANE_NORMAL + 3,
    CGT_PLANE_V,
    CGT_PLANES
} cgt_plane;

/* The field that each plane is a part of. */
static const uint32_t cgt_plane_field[CGT_PLANES] = {CGT_FIELD_T,      CGT_FIELD_PRIMITIVE, CGT_FIELD_GEOMETRY,
                                                     CGT_FIELD_NORMAL, CGT_FIELD_NORMAL,    CGT_FIELD_NORMAL,
                                                     CGT_FIELD_UV,     CGT_FIELD_UV};

/* Initialises an array of CGT_PLANES pointers from any struct that names its planes as cgt_frame does. */
#define CGT_PLANES_OF(s)                                                                                               \
    {                                                                                                                  \
        (s)->t, (s)->primitive, (s)->geometry, (s)->normal[0], (s)->normal[1], (s)->normal[2], (s)->u, (s)->v          \
    }

/* The fields that have planes. */
static inline uint32_t cgt_planes_fields(void *const plane[CGT_PLANES])
{
    uint32_t fields = 0;
    for (int k = 0; k < CGT_PLANES; k++)
        fields |= plane[k] ? cgt_plane_field[k] : 0;
    return fields;
}

/* A region of a camera's frame and where its hits go: pixel (x + i, y + j) to element j * row_stride + i of each
 * plane; NULL planes are not written. */
typedef struct cgt_region {
    uint32_t x, y, width, height;
    size_t row_stride;
    union {
        struct {
            float *t;
            uint32_t *primitive;
            uint32_t *geometry;
            float *normal[3];
            float *u, *v;
        };
        uint32_t *plane[CGT_PLANES]; /* the same pointers, to bits of float or uint32_t */
    };
    bool nontemporal; /* nobody reads the planes soon */
} cgt_region;

/* The planes of a region whose rows follow each other, as an array's hits. */
static inline cgt_hits cgt_region_hits(const cgt_region *r)
{
    return (cgt_hits){.t = r->t,
                      .primitive = r->primitive,
                      .geometry = r->geometry,
                      .normal = {r->normal[0], r->normal[1], r->normal[2]},
                      .u = r->u,
                      .v = r->v};
}

/* The part of a region that begins `x` columns and `y` rows after it, at most `width` x `height` pixels. */
static inline cgt_region cgt_region_part(const cgt_region *r, uint32_t x, uint32_t y, uint32_t width, uint32_t height)
{
    const size_t first = (size_t)y * r->row_stride + x;
    cgt_region part = *r;
    part.x += x;
    part.y += y;
    part.width = r->width - x < width ? r->width - x : width;
    part.height = r->height - y < height ? r->height - y : height;
    for (int k = 0; k < CGT_PLANES; k++)
        part.plane[k] = r->plane[k] ? r->plane[k] + first : NULL;
    return part;
}

#endif

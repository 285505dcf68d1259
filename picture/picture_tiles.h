/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pictures of tiles that something else than cgt_trace_camera traces: cgt-render's Cell. */
#ifndef PICTURE_TILES_H
#define PICTURE_TILES_H

#include <cgt/picture.h>

/* Begins a picture, PLAIN alone, whose pixels come from cgt_picture_visit_tile, wherever they are. Arguments
 * and errors as those of cgt_picture_begin and cgt_picture_read; image is copied.
 *   scene    whose looks are shaded; NULL: all geometries are of spheres
 *   fields   gets what visited tiles must have, cgt_field values combined; NULL: not wanted */
cgt_result cgt_picture_begin_tiles(cgt_picture *picture, const cgt_scene *scene, const cgt_camera *camera,
                                   const cgt_look *looks, uint32_t look_count, const cgt_image *image,
                                   uint32_t *fields);

/* Shades a tile of width * antialias by height * antialias rays, as a cgt_tile_visitor or by hand, from any threads at
 * once; each tile once. Place and size must be multiples of antialias.
 *   picture   the cgt_picture */
cgt_visit cgt_picture_visit_tile(void *picture, const cgt_tile *tile);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Styles of pictures: what light, sky and background are where a user says nothing of them. */
#ifndef PICTURE_STYLE_H
#define PICTURE_STYLE_H

#include <stdint.h>

#include <cgt/cgt.h>

typedef enum picture_style { STYLE_SOFT = 0, STYLE_PAPER, STYLE_PLAIN } picture_style;

typedef struct style_values {
    int ambient, mesh_ambient;     /* rays to the sky, of spheres, of triangles: on smooth ones grain shows */
    int shadows;                   /* 1: the light has shadows */
    float key, sky, head, outline; /* as in cgt_picture_options; key: of the first light */
    uint8_t background[3];         /* sRGB */
} style_values;

extern const float cgt_style_mesh_color[3]; /* sRGB, 0 to 1: of meshes without another */

const style_values *cgt_style_get(picture_style style);

/* The height of what a camera shows at its target. It stands for the size of the scene: it is known without a look at
 * the frames, and the same for all of them. */
float cgt_style_shown_height(const cgt_camera *camera);
float cgt_style_distance(const cgt_camera *camera); /* to its target */

/* What lies farther off does not occlude, where nothing else is said. */
float cgt_style_ambient_radius(const cgt_camera *camera);

#endif

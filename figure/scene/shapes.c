/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Boxes and arrows; see shapes.h. */
#include "scene/shapes.h"

#include <math.h>

int cgt_shapes_add_box(sticks *s, const cgt_trajectory_frame *f, const uint32_t images[3], float radius, uint16_t entry)
{
    float corner[8][3];
    double size = 0.0;
    for (int k = 0; k < 8; k++)
        for (int c = 0; c < 3; c++) {
            double at = f->box_origin[c];
            for (int e = 0; e < 3; e++)
                at += k >> e & 1 ? (double)images[e] * f->box_edge[e][c] : 0.0;
            corner[k][c] = (float)at;
            size += fabs(f->box_edge[k % 3][c]);
        }
    if (!(size > 0.0) || !isfinite(size))
        return -1;
    for (int k = 0; k < 8; k++)
        radius = cgt_sticks_visible(s, corner[k], radius);
    for (int k = 0; k < 8; k++) {
        cgt_sticks_add_ball(s, corner[k], radius, entry);
        for (int e = 0; e < 3; e++)
            if (!(k >> e & 1))
                cgt_sticks_add_cylinder(s, corner[k], corner[k | 1 << e], radius, entry);
    }
    return 0;
}

static void add_arrow(sticks *s, const float from[3], const float vector[3], float radius, uint16_t entry)
{
    float length = 0.0f, neck[3], tip[3];
    for (int c = 0; c < 3; c++)
        length += vector[c] * vector[c];
    length = sqrtf(length);
    if (!(length > 0.0f) || !isfinite(length))
        return;
    const float head = fminf(4.0f * radius, 0.5f * length),
                width = fminf(cgt_sticks_visible(s, from, radius), 0.25f * length);
    for (int c = 0; c < 3; c++) {
        tip[c] = from[c] + vector[c];
        neck[c] = tip[c] - vector[c] * (head / length);
    }
    cgt_sticks_add_cylinder(s, from, neck, width, entry);
    cgt_sticks_add_cone(s, neck, tip, 2.0f * width, entry);
}

void cgt_shapes_add_arrows(sticks *s, const expression *const vector[3], float scale, float radius, const particles *p,
                           int32_t entry)
{
    for (uint32_t i = 0; i < p->count; i++) {
        float v[3];
        for (int c = 0; c < 3; c++) {
            double value;
            cgt_expression_values(vector[c], p->source[i], 1, &value);
            v[c] = (float)(value * (double)scale);
        }
        add_arrow(s, p->xyzr + 4 * (size_t)i, v, radius, entry < 0 ? p->index[i] : (uint16_t)entry);
    }
}

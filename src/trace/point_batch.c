/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * See point_batch.h. */
#include "trace/point_batch.h"

#include "query/ray_intake.h"

static void copy_numbers(const ray_source *s, const uint32_t *array, const uint32_t *number, uint32_t count,
                         uint32_t *to)
{
    for (uint32_t k = 0; array && k < count; k++)
        to[k] = ray_number(s, array, number[k]);
}

static void copy_floats(const ray_source *s, const float *array, const uint32_t *number, uint32_t count, float *to)
{
    for (uint32_t k = 0; array && k < count; k++)
        to[k] = ray_element(s, array, number[k]);
}

void cgt_point_batch_fill(cgt_point_batch *b, const cgt_rays *points, const uint32_t *number, uint32_t count)
{
    const ray_source source = ray_source_init(points, NULL);
    for (int a = 0; a < 3; a++)
        copy_floats(&source, points->org[a], number, count, b->position[a]);
    copy_floats(&source, points->t_min, number, count, b->t_min);
    copy_floats(&source, points->t_max, number, count, b->t_max);
    copy_numbers(&source, points->mask, number, count, b->mask);
    copy_numbers(&source, points->skip_primitive, number, count, b->primitive);
    copy_numbers(&source, points->skip_geometry, number, count, b->geometry);
    b->rays = (cgt_rays){.count = count,
                         .org = {b->position[0], b->position[1], b->position[2]},
                         .t_min = points->t_min ? b->t_min : NULL,
                         .t_max = points->t_max ? b->t_max : NULL,
                         .mask = points->mask ? b->mask : NULL,
                         .skip_primitive = points->skip_primitive ? b->primitive : NULL,
                         .skip_geometry = points->skip_geometry ? b->geometry : NULL};
}

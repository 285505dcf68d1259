/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Grid or tree. A grid is built in a fraction of a tree's time, and camera packets march through it as fast, as long as
 * its cells hold about as many objects wherever there are any. Two things are against it: objects that crowd in a small
 * part of the bounds (a teapot in a stadium), and rays that run apart, which share no cells.
 *
 * Crowding is measured with a sample of the objects, taken at equal steps through their numbers, in a coarse grid: how
 * many of the sample lie in an object's cell, itself included, over how many would in an even spread. It is the factor
 * by which the cells that matter are overfull. */
#include "choose_structure.h"

#include <stdio.h>

#define SAMPLE 4096u
#define COARSE 16u /* cells an axis */

/* Measured by `cgt-bench structures` (docs/structures.md). */
#define CROWDED 60.0

static void middle_of(const cgt_shape *shape, double middle[3])
{
    const cgt_sphere s = shape->sphere;
    const double center[3] = {s.x, s.y, s.z};
    for (int a = 0; a < 3; a++) {
        const float(*v)[3] = shape->triangle.v;
        middle[a] = shape->kind == CGT_KIND_SPHERES ? center[a] : ((double)v[0][a] + v[1][a] + v[2][a]) / 3;
    }
}

static uint32_t coarse_cell(const cgt_world *world, const double middle[3])
{
    uint32_t cell = 0;
    for (int a = 0; a < 3; a++) {
        const double extent = (double)world->high[a] - world->low[a];
        const double g = extent > 0 ? (middle[a] - world->low[a]) / extent * COARSE : 0;
        cell = cell * COARSE + (g <= 0 ? 0 : g >= COARSE ? COARSE - 1 : (uint32_t)g);
    }
    return cell;
}

/* 1 where objects are spread evenly over all cells. */
static double crowding(const cgt_world *world)
{
    uint16_t count[COARSE * COARSE * COARSE] = {0};
    const uint64_t objects = world->objects.count, sample = objects < SAMPLE ? objects : SAMPLE;
    uint32_t taken = 0;
    double pairs = 0;
    for (uint64_t i = 0; i < sample; i++) {
        const cgt_shape shape = cgt_objects_shape(&world->objects, (uint32_t)(i * objects / sample));
        double middle[3];
        if (cgt_shape_check(&shape) != CGT_OBJECT_VALID)
            continue;
        middle_of(&shape, middle);
        pairs += count[coarse_cell(world, middle)]++;
        taken++;
    }
    return taken ? (1 + 2 * pairs / taken) / (1 + (taken - 1.0) / (COARSE * COARSE * COARSE)) : 1;
}

cgt_structure cgt_choose_structure(const cgt_world *world, cgt_ray_kind rays, char *why, size_t bytes)
{
    const double crowded = crowding(world);
    if (rays == CGT_RAYS_INCOHERENT) {
        snprintf(why, bytes, "kd-tree: incoherent rays share no cells of a grid");
        return CGT_STRUCTURE_KD;
    }
    if (crowded > CROWDED) {
        snprintf(why, bytes, "kd-tree: objects crowd, %.3g times an even spread", crowded);
        return CGT_STRUCTURE_KD;
    }
    return CGT_STRUCTURE_QUEUE_GRID;
}

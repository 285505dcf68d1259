/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against one light through the wide tree. Neighbours in the arrays become packets: all that runs between them
 * and the light lies in a frustum (light_frustum.h), against which a node's children are tested at once, and a leaf's
 * primitives. What is left is tested against all rays (light_leaf.h).
 *
 * That shares most where primitives are large beside the packet. Where they are not, each ray is better off by itself:
 * a chunk of points whose first packets take more work than that goes through the tree as any other rays do. */
#include "kernel/light/light_leaf.h"
#include "kernel/light/light_points.h"

#define LIGHT_RAYS 64u
#define LIGHT_STACK (CGT_WIDE_MAX_DEPTH * (CGT_LANES - 1) + 1)

/* Packets that tell whether a chunk goes on as packets, and the work, in visits and tests, that one may take. Measured. */
#define LIGHT_TRIED 4u
#ifndef LIGHT_WORK
#define LIGHT_WORK 160u
#endif
#define LIGHT_TOO_MUCH (4 * LIGHT_WORK) /* of one packet: it is left off */

/* ---- nodes and leaves ---- */

static void light_test_leaf(const light_call *c, light_packet *l, uint32_t code)
{
    const cgt_wide_tree *tree = &c->world->wide;
    const uint32_t block = code & CGT_WIDE_INDEX, count = wide_leaf_count(code);
    const bool of_triangles = code & CGT_WIDE_TRIANGLES;
    const wide_spheres *spheres = of_triangles ? NULL : (const wide_spheres *)tree->sphere + block;
    const wide_triangles *triangles = of_triangles ? (const wide_triangles *)tree->triangle + block : NULL;
    light_primitives q;
    if (of_triangles)
        light_place_triangles(l, triangles, c->world->scale, &q);
    else
        light_place_spheres(l, spheres, &q);
    const vmask meets = of_triangles ? light_meets(&l->frustum, &q, 3) : light_meets(&l->frustum, &q, 1);
    const unsigned left = spux_mask_bits(meets) & CGT_ALL_LANES >> (CGT_LANES - count);
    const uint32_t tests = spux_count_bits(left);
    c->counts->leaves++;
    c->counts->cull_tests += count;
    c->counts->culled += count - tests;
    c->counts->packet_tests += tests;
    c->counts->ray_tests += (uint64_t)tests * l->rays.lanes;
    l->work += 1 + tests;
    if (!left)
        return;
    if (!of_triangles)
        light_test_spheres(c->world, l, spheres, left, c->counts);
    else if (l->rays.to_light)
        light_test_triangles(c->world, l, triangles, left, true, c->counts);
    else
        light_test_triangles(c->world, l, triangles, left, false, c->counts);
    if (!l->open)
        l->last = code;
}

/* False where it took too much work: what was found by then is right, the rest is not known. The leaf that closed the
 * packet before comes first: shadows are larger than packets. */
static bool light_traverse(const light_call *c, light_packet *l)
{
    const wide_node *nodes = c->world->wide.node;
    uint32_t stack[LIGHT_STACK], top = 0, code = 0;
    l->work = 0;
    if (l->last && l->open) {
        light_test_leaf(c, l, l->last);
        if (l->open)
            l->last = 0;
    }
    while (l->open) {
        if (l->work > LIGHT_TOO_MUCH)
            return false;
        if (code & CGT_WIDE_LEAF) {
            light_test_leaf(c, l, code);
        } else {
            const wide_node *node = &nodes[code];
            c->counts->nodes++;
            l->work++;
            for (unsigned left = light_children(l, node); left; left &= left - 1)
                stack[top++] = node->child[__builtin_ctz(left)];
        }
        if (!top)
            return true;
        code = stack[--top];
    }
    return true;
}

/* ---- points ---- */

/* Rays as structure of arrays. */
typedef struct light_rays {
    float org[3][CGT_RAYS_CHUNK], dir[3][CGT_RAYS_CHUNK], t_min[CGT_RAYS_CHUNK], t_max[CGT_RAYS_CHUNK];
    uint32_t mask[CGT_RAYS_CHUNK], primitive[CGT_RAYS_CHUNK], geometry[CGT_RAYS_CHUNK];
} light_rays;

static const uint32_t *copy_numbers(const light_call *c, const uint32_t *from, uint64_t first, uint32_t count,
                                    uint32_t *to)
{
    if (!from)
        return NULL;
    for (uint32_t k = 0; k < count; k++)
        to[k] = ray_number(&c->source, from, first + k);
    return to;
}

/* Points first to end - 1 as rays like any others. */
__attribute__((noinline)) static void trace_apart(const light_call *c, uint64_t first, uint64_t end)
{
    light_rays own;
    const cgt_rays *points = c->source.rays;
    const uint32_t count = (uint32_t)(end - first);
    cgt_rays rays = {.count = count,
                     .t_min = own.t_min,
                     .t_max = own.t_max,
                     .mask = copy_numbers(c, points->mask, first, count, own.mask),
                     .skip_primitive = copy_numbers(c, points->skip_primitive, first, count, own.primitive),
                     .skip_geometry = copy_numbers(c, points->skip_geometry, first, count, own.geometry)};
    for (int a = 0; a < 3; a++) {
        for (uint32_t k = 0; k < count; k++) {
            own.org[a][k] = ray_element(&c->source, points->org[a], first + k);
            own.dir[a][k] = ray_direction(&c->source, first + k, a, own.org[a][k]);
        }
        rays.org[a] = own.org[a];
        rays.dir[a] = own.dir[a];
    }
    for (uint32_t k = 0; k < count; k++) {
        own.t_min[k] = points->t_min ? ray_element(&c->source, points->t_min, first + k) : 0;
        own.t_max[k] = points->t_max ? ray_element(&c->source, points->t_max, first + k) : c->source.t_max;
    }
    CGT_KERNEL(cgt_wide_trace_rays)(c->world, &rays, 0, count, c->settings, NULL, c->occluded + first, c->counts);
    c->counts->rays -= count; /* the call has counted them */
}

/* Points first to first + count - 1 of the order, and the work that they took. False where it was too much: then they
 * are as they were before. */
static bool trace_points(const light_call *c, light_packet *l, uint32_t first, uint32_t count, uint64_t *work)
{
    const uint64_t invalid = c->counts->invalid_rays;
    if (!light_points_read(c, first, count, &l->rays)) {
        for (uint32_t k = 0; k < count; k++)
            if (!trace_points(c, l, first + k, 1, work)) {
                c->counts->invalid_rays = invalid;
                return false;
            }
        return true;
    }
    if (l->rays.rays && light_packet_make(c->world, l)) {
        const bool done = light_traverse(c, l);
        c->counts->packets++;
        c->counts->bvh_rays += done ? count : 0;
        *work += l->work;
        if (!done) {
            c->counts->invalid_rays = invalid;
            return false;
        }
    } else
        CGT_KERNEL(cgt_packet_trace)(c->world, &l->rays, c->settings, c->counts);
    light_hand_out(c, &l->rays, first, count);
    return true;
}

void CGT_KERNEL(cgt_wide_trace_light)(const cgt_world *world, const cgt_rays *points, const cgt_light *light,
                                      uint64_t first, uint64_t end, const cgt_trace_settings *settings,
                                      uint8_t *occluded, cgt_counts *counts)
{
    light_packet l;
    const light_call c = {.world = world,
                          .source = ray_source_make(points, light),
                          .light = *light,
                          .order = {first, NULL},
                          .settings = settings,
                          .occluded = occluded,
                          .counts = counts};
    const uint32_t count = (uint32_t)(end - first);
    uint32_t done = 0;
    uint64_t work = 0;
    l.rays.any_hit = true;
    l.rays.fast = false;
    l.last = 0;
    counts->rays += count;
    while (light_is_near(&c) && done < count &&
           (done < LIGHT_TRIED * LIGHT_RAYS || LIGHT_RAYS * work <= (uint64_t)LIGHT_WORK * done)) {
        const uint32_t more = count - done < LIGHT_RAYS ? count - done : LIGHT_RAYS;
        if (!trace_points(&c, &l, done, more, &work))
            break;
        done += more;
    }
    light_count_hits(&c, done);
    if (done < count)
        trace_apart(&c, first + done, end);
}

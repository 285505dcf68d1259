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

#define LIGHT_BVH_PACKET_RAYS 64u
#define LIGHT_STACK_SIZE (CGT_BVH_MAX_DEPTH * (CGT_LANES - 1) + 1)

/* Packets that tell whether a chunk goes on as packets, and the work, in visits and tests, that one may take. Measured. */
#define LIGHT_TRIAL_PACKETS 4u
#define LIGHT_MAX_WORK (4 * LIGHT_PACKET_WORK) /* of one packet: it is left off */

/* ---- nodes and leaves ---- */

static void light_test_leaf(const light_call *c, light_packet *l, uint32_t code)
{
    const cgt_bvh *tree = &c->committed_scene->bvh;
    const uint32_t block = code & CGT_BVH_INDEX_MASK, count = bvh_leaf_count(code);
    const bool is_triangle_leaf = code & CGT_BVH_TRIANGLE_LEAF;
    const sphere_block *spheres = is_triangle_leaf ? NULL : (const sphere_block *)tree->sphere + block;
    const triangle_block *triangles = is_triangle_leaf ? (const triangle_block *)tree->triangle + block : NULL;
    light_primitives q;
    if (is_triangle_leaf)
        light_transform_triangles(l, triangles, c->committed_scene->scale, &q);
    else
        light_transform_spheres(l, spheres, &q);
    const vmask overlaps =
        is_triangle_leaf ? light_frustum_overlaps(&l->frustum, &q, 3) : light_frustum_overlaps(&l->frustum, &q, 1);
    const unsigned remaining = spux_mask_bits(overlaps) & CGT_ALL_LANES >> (CGT_LANES - count);
    const uint32_t tests = spux_count_bits(remaining);
    c->counts->leaves++;
    c->counts->cull_tests += count;
    c->counts->culled += count - tests;
    c->counts->packet_tests += tests;
    c->counts->ray_tests += (uint64_t)tests * l->rays.lanes;
    l->work += 1 + tests;
    if (!remaining)
        return;
    light_leaf leaf;
    leaf.sphere = spheres;
    leaf.triangle = triangles;
    if (!is_triangle_leaf)
        light_test_primitives(c->committed_scene, l, &leaf, LIGHT_SPHERES, remaining, c->counts);
    else if (l->rays.to_light)
        light_test_primitives(c->committed_scene, l, &leaf, LIGHT_TRIANGLES_TO_POINT, remaining, c->counts);
    else
        light_test_primitives(c->committed_scene, l, &leaf, LIGHT_TRIANGLES_PARALLEL, remaining, c->counts);
    if (!l->undecided)
        l->last_leaf = code;
}

/* False where it took too much work: what was found by then is right, the rest is not known. The leaf that closed the
 * packet before comes first: shadows are larger than packets. */
static bool light_traverse(const light_call *c, light_packet *l)
{
    const bvh_node *nodes = c->committed_scene->bvh.node;
    uint32_t stack[LIGHT_STACK_SIZE], top = 0, code = 0;
    l->work = 0;
    if (l->last_leaf && l->undecided) {
        light_test_leaf(c, l, l->last_leaf);
        if (l->undecided)
            l->last_leaf = 0;
    }
    while (l->undecided) {
        if (l->work > LIGHT_MAX_WORK)
            return false;
        if (code & CGT_BVH_LEAF) {
            light_test_leaf(c, l, code);
        } else {
            const bvh_node *node = &nodes[code];
            c->counts->nodes++;
            l->work++;
            for (unsigned remaining = light_visible_children(l, node); remaining; remaining &= remaining - 1)
                stack[top++] = node->child[__builtin_ctz(remaining)];
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

static const uint32_t *light_copy_ids(const light_call *c, const uint32_t *from, uint64_t first, uint32_t count,
                                      uint32_t *to)
{
    if (!from)
        return NULL;
    for (uint32_t k = 0; k < count; k++)
        to[k] = ray_number(&c->source, from, first + k);
    return to;
}

/* Points first to end - 1 as rays like any others. */
__attribute__((noinline)) static void light_trace_single_rays(const light_call *c, uint64_t first, uint64_t end)
{
    light_rays copy;
    const cgt_rays *points = c->source.rays;
    const uint32_t count = (uint32_t)(end - first);
    cgt_rays rays = {.count = count,
                     .t_min = copy.t_min,
                     .t_max = copy.t_max,
                     .mask = light_copy_ids(c, points->mask, first, count, copy.mask),
                     .skip_primitive = light_copy_ids(c, points->skip_primitive, first, count, copy.primitive),
                     .skip_geometry = light_copy_ids(c, points->skip_geometry, first, count, copy.geometry)};
    for (int a = 0; a < 3; a++) {
        for (uint32_t k = 0; k < count; k++) {
            copy.org[a][k] = ray_element(&c->source, points->org[a], first + k);
            copy.dir[a][k] = ray_direction(&c->source, first + k, a, copy.org[a][k]);
        }
        rays.org[a] = copy.org[a];
        rays.dir[a] = copy.dir[a];
    }
    for (uint32_t k = 0; k < count; k++) {
        copy.t_min[k] = points->t_min ? ray_element(&c->source, points->t_min, first + k) : 0;
        copy.t_max[k] = points->t_max ? ray_element(&c->source, points->t_max, first + k) : c->source.t_max;
    }
    CGT_KERNEL(cgt_bvh_trace_rays)
    (c->committed_scene, &rays, 0, count, c->settings, NULL, c->occluded + first, c->counts);
    c->counts->rays -= count; /* the call has counted them */
}

/* Points first to first + count - 1 of the order, and the work that they took. False where it was too much: then they
 * are as they were before. */
static bool light_trace_points(const light_call *c, light_packet *l, uint32_t first, uint32_t count, uint64_t *work)
{
    const uint64_t invalid = c->counts->invalid_rays;
    if (!light_read_packet(c, first, count, &l->rays)) {
        for (uint32_t k = 0; k < count; k++)
            if (!light_trace_points(c, l, first + k, 1, work)) {
                c->counts->invalid_rays = invalid;
                return false;
            }
        return true;
    }
    if (l->rays.rays && light_packet_init(c->committed_scene, l)) {
        const bool done = light_traverse(c, l);
        c->counts->packets++;
        c->counts->bvh_rays += done ? count : 0;
        *work += l->work;
        if (!done) {
            c->counts->invalid_rays = invalid;
            return false;
        }
    } else
        CGT_KERNEL(cgt_packet_trace)(c->committed_scene, &l->rays, c->settings, c->counts);
    light_store_occluded(c, &l->rays, first, count);
    return true;
}

void CGT_KERNEL(cgt_bvh_trace_light)(const cgt_committed_scene *committed_scene, const cgt_rays *points,
                                     const cgt_light *light, uint64_t first, uint64_t end,
                                     const cgt_trace_settings *settings, uint8_t *occluded, cgt_counts *counts)
{
    light_packet l;
    const light_call c = {.committed_scene = committed_scene,
                          .source = ray_source_init(points, light),
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
    l.last_leaf = 0;
    counts->rays += count;
    while (light_is_near(&c) && done < count &&
           (done < LIGHT_TRIAL_PACKETS * LIGHT_BVH_PACKET_RAYS ||
            LIGHT_BVH_PACKET_RAYS * work <= (uint64_t)LIGHT_PACKET_WORK * done)) {
        const uint32_t batch = count - done < LIGHT_BVH_PACKET_RAYS ? count - done : LIGHT_BVH_PACKET_RAYS;
        if (!light_trace_points(&c, &l, done, batch, &work))
            break;
        done += batch;
    }
    light_count_hits(&c, done);
    if (done < count)
        light_trace_single_rays(&c, first + done, end);
}

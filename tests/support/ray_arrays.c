/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of rays and hits. */
#include "support/ray_arrays.h"

cgt_rays ray_array(const truth_ray *rays, uint64_t count)
{
    cgt_rays r = {.count = count, .stride = sizeof *rays, .t_min = &rays->t_min, .t_max = &rays->t_max};
    for (int a = 0; a < 3; a++) {
        r.org[a] = &rays->org[a];
        r.dir[a] = &rays->dir[a];
    }
    return r;
}

cgt_hits hit_array(full_hit *hits)
{
    cgt_hits h = {.stride = sizeof *hits, .t = &hits->t, .primitive = &hits->primitive, .geometry = &hits->geometry};
    for (int a = 0; a < 3; a++)
        h.normal[a] = &hits->normal[a];
    h.u = &hits->uv[0];
    h.v = &hits->uv[1];
    return h;
}

full_hit full_hit_of(const cgt_hit *hit)
{
    return (full_hit){
        hit->t, hit->primitive, hit->geometry, {hit->normal[0], hit->normal[1], hit->normal[2]}, {hit->u, hit->v}};
}

cgt_single_ray single_ray(const truth_ray *ray)
{
    return (cgt_single_ray){.org = {ray->org[0], ray->org[1], ray->org[2]},
                            .dir = {ray->dir[0], ray->dir[1], ray->dir[2]},
                            .t_min = ray->t_min,
                            .t_max = ray->t_max};
}

cgt_result trace_array(const cgt_scene *scene, const truth_ray *rays, uint64_t count, full_hit *hits,
                       const cgt_trace_options *options)
{
    const cgt_rays r = ray_array(rays, count);
    const cgt_hits h = hit_array(hits);
    return cgt_trace_rays(scene, &r, &h, options);
}

truth_ray camera_ray(const cgt_camera_rays *camera, uint32_t x, uint32_t y)
{
    truth_ray ray = {.t_min = camera->t_min, .t_max = camera->t_max};
    const float px = ((float)x + 0.5f) * camera->pixel[0] - 1, py = 1 - ((float)y + 0.5f) * camera->pixel[1];
    for (int a = 0; a < 3; a++) {
        const float start = camera->orthographic ? camera->eye[a] : camera->fwd[a];
        const float right = px * camera->right[a], sum = start + right, up = py * camera->up[a];
        ray.org[a] = camera->orthographic ? sum + up : camera->eye[a];
        ray.dir[a] = camera->orthographic ? camera->fwd[a] : sum + up;
    }
    return ray;
}

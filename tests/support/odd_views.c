/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cameras, lights and points next to the primitives of odd scenes. */
#include "support/odd_scenes.h"

#include <math.h>
#include <string.h>

float odd_place(test_random *r, const odd_scene *s, float p[3])
{
    const uint32_t all = s->spheres + s->capsules + s->triangles;
    uint32_t i = random_below(r, all ? all : 1);
    float size = 1, u = random_below(r, 3) ? (float)random_below(r, 2) : random_float(r, 0, 1), from[3] = {0, 0, 0};
    if (i < s->spheres) {
        memcpy(from, s->sphere[i], sizeof from);
        size = s->sphere[i][3];
    } else if ((i -= s->spheres) < s->capsules) {
        const float *c = s->capsule[i];
        for (int a = 0; a < 3; a++)
            from[a] = u == 0 ? c[a] : u == 1 ? c[3 + a] : c[a] + u * (c[3 + a] - c[a]);
        size = c[6];
    } else if ((i -= s->capsules) < s->triangles) {
        float(*v)[3] = (float(*)[3])(s->vertex + 3 * i);
        const float w = random_below(r, 3) ? 0 : random_float(r, 0, 1 - u);
        const uint32_t k = random_below(r, 3);
        size = 0;
        for (int a = 0; a < 3; a++) {
            from[a] = v[k][a] + u * (v[(k + 1) % 3][a] - v[k][a]) + w * (v[(k + 2) % 3][a] - v[k][a]);
            size += fabsf(v[1][a] - v[0][a]);
        }
    }
    size = size > 0 ? size : 1e-3f;
    switch (random_below(r, 5)) {
    case 0: memcpy(p, from, sizeof from); break;
    case 1: odd_beside(r, from, size, p); break; /* on a surface */
    case 2: odd_beside(r, from, size * (1 + random_log(r, 1e-7f, 1)), p); break;
    case 3: odd_beside(r, from, size * random_float(r, 0, 1), p); break;
    default: odd_beside(r, from, size * random_log(r, 1, 1e3f), p);
    }
    return size;
}

static float distance_of(const float p[3], const float q[3])
{
    double sum = 0;
    for (int a = 0; a < 3; a++)
        sum += ((double)p[a] - (double)q[a]) * ((double)p[a] - (double)q[a]);
    return (float)sqrt(sum);
}

cgt_camera odd_camera(test_random *r, const odd_scene *s, bool zoomed)
{
    const float unit = s->unit;
    cgt_camera c;
    float at[3];
    cgt_camera_init(&c);
    const float size = odd_place(r, s, at);
    float opening = 0;
    memcpy(c.target, at, sizeof at);
    switch (random_below(r, 5)) {
    case 0: /* from outside */ odd_beside(r, at, unit * random_float(r, 0.5f, 4), c.eye); break;
    case 1: /* from where something is */ odd_place(r, s, c.eye); break;
    case 2: { /* from far away: what is there fills the picture */
        const float far = (random_below(r, 2) ? unit : size) * odd_power(r, 1, random_below(r, 2) ? 1e4f : 1e12f);
        odd_beside(r, at, far, c.eye);
        opening = (random_below(r, 2) ? unit : size) / far * random_log(r, 0.01f, 3);
        break;
    }
    case 3: /* past something */
        odd_place(r, s, c.eye);
        odd_beside(r, c.eye, size * random_log(r, 1e-6f, 1e3f), c.target);
        break;
    default: odd_beside(r, at, size * random_log(r, 1e-7f, 1e3f), c.eye);
    }
    random_direction(r, c.up);
    const float way = distance_of(c.eye, c.target);
    c.fov = random_below(r, 2) ? random_float(r, 20, 100) : random_log(r, 1e-6f, 179);
    if (zoomed)
        c.fov = random_log(r, 0.12f, 5);
    else if (opening > 0 && random_below(r, 4))
        c.fov = fmaxf(1e-6f, fminf(179, atanf(opening) * 114.6f));
    if (random_below(r, 3) == 0) {
        c.projection = CGT_PROJECTION_ORTHOGRAPHIC;
        c.height = (random_below(r, 2) ? unit : random_below(r, 2) ? way : size) * random_log(r, 0.01f, 10);
        c.height = c.height > 1e-37f && c.height < 1e36f ? c.height : 1;
    }
    if (random_below(r, 8) == 0)
        c.t_min = way * random_log(r, 1e-3f, 2);
    if (random_below(r, 8) == 0)
        c.t_max = fmaxf(c.t_min, way * random_log(r, 1e-3f, 2));
    c.t_max = c.t_max > 0 ? c.t_max : INFINITY; /* what a camera's 0 stands for */
    return c;
}

cgt_light odd_light(test_random *r, const odd_scene *s)
{
    cgt_light light = {.kind = random_below(r, 4) ? CGT_LIGHT_POINT : CGT_LIGHT_DIRECTIONAL};
    if (light.kind == CGT_LIGHT_DIRECTIONAL) {
        const float zero[3] = {0, 0, 0};
        odd_beside(r, zero, random_below(r, 2) ? 1 : odd_power(r, 1e-6f, 1e6f), light.position);
    } else if (random_below(r, 3))
        odd_place(r, s, light.position);
    else {
        float at[3];
        odd_place(r, s, at);
        odd_beside(r, at, s->unit * odd_power(r, 0.1f, random_below(r, 2) ? 30 : 1e9f), light.position);
    }
    return light;
}

void odd_points(test_random *r, const odd_scene *s, uint32_t count, float *const position[3])
{
    float p[3], size = 1;
    for (uint32_t i = 0; i < count; i++) {
        if (i % 64 == 0)
            size = odd_place(r, s, p);
        float q[3];
        if (random_below(r, 4))
            odd_beside(r, p, size * random_log(r, 1e-4f, 4), q);
        else
            odd_place(r, s, q);
        for (int a = 0; a < 3; a++)
            position[a][i] = q[a];
    }
}

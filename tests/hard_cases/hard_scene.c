/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Builds scenes with hard rays piece by piece. */
#include "hard_cases/hard_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void hard_scene_free(hard_scene *s)
{
    for (uint32_t g = 0; g < HARD_MOST_GEOMETRIES; g++) {
        free(s->geometry[g].sphere);
        free(s->geometry[g].vertex);
        free(s->geometry[g].index);
    }
    free(s->ray);
    memset(s, 0, sizeof *s);
}

uint32_t hard_scene_primitives(const hard_scene *s)
{
    uint32_t sum = 0;
    for (uint32_t g = 0; g < s->geometries; g++)
        sum += s->geometry[g].spheres + s->geometry[g].triangles;
    return sum;
}

void hard_put(const hard_scene *s, const double point[3], float placed[3])
{
    for (int a = 0; a < 3; a++)
        placed[a] = (float)(point[a] * s->place.scale + s->place.offset[a]);
}

/* Grows an array to `count` elements. Returns NULL on failure; the old array is then untouched. */
static void *grow(hard_scene *s, void *array, size_t *room, size_t count, size_t size)
{
    if (s->failed)
        return NULL;
    if (count <= *room)
        return array;
    const size_t wanted = count < 32 ? 64 : 2 * count;
    void *grown = count > SIZE_MAX / 2 / size ? NULL : realloc(array, wanted * size);
    s->failed = grown == NULL;
    if (grown)
        *room = wanted;
    return grown;
}

/* ---- primitives ---- */

void hard_new_geometry(hard_scene *s)
{
    if (s->geometries == HARD_MOST_GEOMETRIES)
        s->failed = true;
    else
        s->geometries++;
}

/* The last geometry if it holds no primitives of the other kind; else a new one. */
static hard_geometry *last_geometry(hard_scene *s, bool of_spheres)
{
    const hard_geometry *last = s->geometries ? &s->geometry[s->geometries - 1] : NULL;
    if (!last || (of_spheres ? last->triangles : last->spheres))
        hard_new_geometry(s);
    return s->failed ? NULL : &s->geometry[s->geometries - 1];
}

void hard_raw_sphere(hard_scene *s, const float sphere[4])
{
    hard_geometry *g = last_geometry(s, true);
    void *grown = g ? grow(s, g->sphere, &g->room[0], (size_t)g->spheres + 1, sizeof *g->sphere) : NULL;
    if (!grown)
        return;
    g->sphere = grown;
    memcpy(g->sphere[g->spheres++], sphere, sizeof *g->sphere);
}

void hard_sphere(hard_scene *s, const double center[3], double r)
{
    float sphere[4];
    hard_put(s, center, sphere);
    sphere[3] = (float)(r * s->place.scale);
    hard_raw_sphere(s, sphere);
}

static bool add_vertex(hard_scene *s, hard_geometry *g, const float vertex[3])
{
    void *grown = grow(s, g->vertex, &g->room[1], (size_t)g->vertices + 1, sizeof *g->vertex);
    if (!grown)
        return false;
    g->vertex = grown;
    memcpy(g->vertex[g->vertices++], vertex, sizeof *g->vertex);
    return true;
}

static bool add_indices(hard_scene *s, hard_geometry *g, uint32_t a, uint32_t b, uint32_t c)
{
    void *grown = grow(s, g->index, &g->room[2], (size_t)g->triangles + 1, sizeof *g->index);
    if (!grown)
        return false;
    g->index = grown;
    uint32_t *index = g->index[g->triangles++];
    index[0] = a;
    index[1] = b;
    index[2] = c;
    return true;
}

void hard_raw_triangle(hard_scene *s, const float vertex[3][3])
{
    hard_geometry *g = last_geometry(s, false);
    if (!g)
        return;
    const uint32_t first = g->vertices;
    for (int k = 0; k < 3; k++)
        if (!add_vertex(s, g, vertex[k]))
            return;
    add_indices(s, g, first, first + 1, first + 2);
}

void hard_triangle(hard_scene *s, const double vertex[3][3])
{
    float placed[3][3];
    for (int k = 0; k < 3; k++)
        hard_put(s, vertex[k], placed[k]);
    hard_raw_triangle(s, (const float(*)[3])placed);
}

void hard_mesh(hard_scene *s, const closed_mesh *mesh, double scale, const double shift[3])
{
    hard_new_geometry(s);
    if (s->failed)
        return;
    hard_geometry *g = &s->geometry[s->geometries - 1];
    for (uint32_t i = 0; i < mesh->vertices; i++) {
        double p[3];
        float placed[3];
        for (int a = 0; a < 3; a++)
            p[a] = mesh->vertex[i][a] * scale + shift[a];
        hard_put(s, p, placed);
        if (!add_vertex(s, g, placed))
            return;
    }
    for (uint32_t i = 0; i < mesh->triangles; i++)
        if (!add_indices(s, g, mesh->index[i][0], mesh->index[i][1], mesh->index[i][2]))
            return;
}

void hard_closed_mesh(hard_scene *s, closed_kind kind, uint32_t detail)
{
    closed_mesh mesh;
    const double middle[3] = {0, 0, 0};
    if (closed_mesh_make(&mesh, kind, detail))
        hard_mesh(s, &mesh, 1, middle);
    else
        s->failed = true;
    closed_mesh_free(&mesh);
}

/* ---- rays ---- */

bool hard_wants_ray(const hard_scene *s) { return !s->failed && s->rays < s->wanted; }

void hard_raw_ray(hard_scene *s, const truth_ray *ray)
{
    if (!hard_wants_ray(s))
        return;
    void *grown = grow(s, s->ray, &s->room, (size_t)s->rays + 1, sizeof *s->ray);
    if (!grown)
        return;
    s->ray = grown;
    s->ray[s->rays++] = *ray;
}

void hard_ray(hard_scene *s, const double org[3], const float dir[3])
{
    truth_ray ray = {.t_min = 0, .t_max = INFINITY};
    hard_put(s, org, ray.org);
    memcpy(ray.dir, dir, sizeof ray.dir);
    hard_raw_ray(s, &ray);
}

void hard_aim(hard_scene *s, const float org[3], const float target[3], float length)
{
    truth_ray ray = {.t_min = 0, .t_max = INFINITY};
    for (int a = 0; a < 3; a++) {
        ray.org[a] = org[a];
        ray.dir[a] = (target[a] - org[a]) * length;
    }
    if (ray.dir[0] == 0 && ray.dir[1] == 0 && ray.dir[2] == 0)
        ray.dir[0] = 1;
    hard_raw_ray(s, &ray);
}

/* ---- random parts ---- */

double hard_real(hard_scene *s, double low, double high)
{
    return low + (double)(random_bits(&s->random) >> 11) * 0x1p-53 * (high - low);
}

void hard_point(hard_scene *s, double low, double high, double p[3])
{
    for (int a = 0; a < 3; a++)
        p[a] = hard_real(s, low, high);
}

void hard_direction(hard_scene *s, double d[3])
{
    float f[3];
    random_direction(&s->random, f);
    for (int a = 0; a < 3; a++)
        d[a] = f[a];
}

void hard_lattice_point(hard_scene *s, int low, int high, double unit, double p[3])
{
    for (int a = 0; a < 3; a++)
        p[a] = unit * (low + (int)random_below(&s->random, (uint32_t)(high - low) + 1));
}

float hard_length(hard_scene *s) { return random_below(&s->random, 4) ? 1 : random_log(&s->random, 0x1p-20f, 0x1p20f); }

bool hard_any_triangle(hard_scene *s, float vertex[3][3])
{
    uint32_t all = 0;
    for (uint32_t g = 0; g < s->geometries; g++)
        all += s->geometry[g].triangles;
    uint32_t chosen = all ? random_below(&s->random, all) : 0;
    for (uint32_t g = 0; g < s->geometries; g++) {
        const hard_geometry *of = &s->geometry[g];
        if (chosen >= of->triangles) {
            chosen -= of->triangles;
            continue;
        }
        for (int k = 0; k < 3; k++)
            memcpy(vertex[k], of->vertex[of->index[chosen][k]], sizeof vertex[k]);
        return true;
    }
    return false;
}

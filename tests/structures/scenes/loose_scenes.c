/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes that stress bounds, sizes and cells. */
#include "structures/scenes/loose_scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene.h"

const char *loose_name(loose_kind kind)
{
    static const char *const name[LOOSE_KINDS] = {"uniform",    "clustered", "flat",  "line",    "orders",  "points",
                                                  "coincident", "lattice",   "far",   "huge",    "tiny",    "spoiled",
                                                  "stadium",    "layers",    "wide",  "fan",     "garbage", "powers",
                                                  "space",      "stray",     "heaps", "denormal"};
    return name[kind];
}

/* ---- positions and sizes ---- */

static float wide(test_random *r) { return random_log(r, 0x1p-125f, 0x1p53f) * (random_below(r, 2) ? 1.f : -1.f); }

static float garbage(test_random *r)
{
    const float x = random_any_float(r);
    return fabsf(x) > 0x1p53f ? NAN : x; /* larger numbers are for bands */
}

/* Number i of a geometry. */
static void place(test_random *r, loose_kind kind, uint32_t count, uint32_t i, float q[4])
{
    static const float heights[] = {-0.0f, 0.0f, 1, 1.00000012f, -0x1p-149f, 3};
    const float spacing = 2 / cbrtf((float)count);
    for (int a = 0; a < 3; a++)
        q[a] = random_float(r, -1, 1);
    q[3] = spacing * random_float(r, 0.3f, 0.5f);
    switch (kind) {
    case LOOSE_CLUSTERED:
        for (int a = 0; a < 3; a++)
            q[a] = q[a] * 1e-3f + (float)(random_below(r, 2) * 2) - 1;
        break;
    case LOOSE_FLAT: q[2] = 0.1f; break;
    case LOOSE_LINE: q[0] = q[2] = -0.f; break;
    case LOOSE_ORDERS: q[3] = random_below(r, 20) ? random_log(r, 1e-30f, 1) : 0; break;
    case LOOSE_POINTS: q[3] = random_below(r, 2) ? 0 : -0.f; break;
    case LOOSE_COINCIDENT:
        for (int a = 0; a < 4; a++)
            q[a] = 0.7f;
        break;
    case LOOSE_LATTICE:
        for (int a = 0; a < 4; a++)
            q[a] = (float)random_below(r, a < 3 ? 9 : 3);
        break;
    case LOOSE_FAR:
        for (int a = 0; a < 3; a++)
            q[a] = 1e5f + q[a];
        break;
    case LOOSE_HUGE:
    case LOOSE_TINY:
        for (int a = 0; a < 4; a++)
            q[a] *= kind == LOOSE_HUGE ? 0x1p53f : 0x1p-110f;
        break;
    case LOOSE_SPOILED:
        if (random_below(r, 3) == 0) {
            const uint32_t at = random_below(r, 4);
            q[at] = at == 3 && random_below(r, 2) ? -1 : random_below(r, 2) ? NAN : INFINITY;
        }
        break;
    case LOOSE_STADIUM:
        if (random_below(r, 20))
            for (int a = 0; a < 4; a++)
                q[a] = q[a] * 1e-4f + (a < 3 ? 0.9f : 0);
        break;
    case LOOSE_LAYERS: q[i % 3] = heights[random_below(r, 6)]; break;
    case LOOSE_WIDE:
        for (int a = 0; a < 4; a++)
            q[a] = wide(r);
        q[3] = fabsf(q[3]);
        break;
    case LOOSE_FAN: q[3] = sqrtf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]); break;
    case LOOSE_GARBAGE:
        for (int a = 0; a < 4; a++)
            q[a] = garbage(r);
        break;
    case LOOSE_POWERS:
        q[0] = ldexpf(1, 50 - (int)(i % 190));
        q[1] = q[2] = 0;
        q[3] = i % 2 ? 0 : q[0] / 8;
        break;
    case LOOSE_SPACE:
        for (uint32_t a = 0; a < 3; a++)
            q[a] = ldexpf(1 + (float)(i % 7) / 8, 40 - (int)((i * 7 + a * 59) % 160));
        q[3] = fminf(q[0], q[1]) / 8;
        break;
    case LOOSE_STRAY:
        q[1] = (float)(i % 71);
        q[2] = i ? 0 : 1e12f;
        q[3] = 0.001f;
        break;
    case LOOSE_HEAPS:
        q[0] = i % 2 ? 1 : nextafterf(1, 2);
        q[1] = q[2] = 0;
        q[3] = 1;
        break;
    case LOOSE_DENORMAL:
        for (int a = 0; a < 4; a++)
            q[a] = 0x1p-149f * (float)random_below(r, a < 3 ? 9 : 3);
        break;
    default: break;
    }
}

/* A triangle at a sphere's position, of its size. */
static void triangle_at(test_random *r, loose_kind kind, uint32_t i, const float q[4], float v[3][3])
{
    const int flat = kind == LOOSE_FLAT ? 2 : kind == LOOSE_LAYERS ? (int)(i % 3) : 3;
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++) {
            const float way = kind == LOOSE_LATTICE ? (float)random_below(r, 2) : random_float(r, -1, 1);
            v[k][a] = q[a] + (a == flat ? 0 : q[3] * way);
            if (kind == LOOSE_FAN && k == 0)
                v[k][a] = 0;
            if (kind == LOOSE_GARBAGE)
                v[k][a] = garbage(r);
        }
    if (kind == LOOSE_SPOILED && random_below(r, 5) == 0) { /* a needle, with or without an area */
        for (int a = 0; a < 3; a++)
            v[2][a] = 0.25f * v[0][a] + 0.75f * v[1][a];
    }
}

/* ---- geometries ---- */

static void *array_of(loose_scene *s, size_t bytes)
{
    void *p = malloc(bytes ? bytes : 1);
    assert_non_null(p);
    memset(p, 0xff, bytes ? bytes : 1); /* NaN between the elements */
    assert_true(s->arrays < LOOSE_ARRAYS);
    return s->array[s->arrays++] = p;
}

/* Spheres as records of four floats, or in two arrays with other strides. */
static void add_spheres(loose_scene *s, test_random *r, loose_kind kind, uint32_t all, uint32_t count, int form)
{
    const size_t stride = form == 0 ? 4 : form == 1 ? 3 : 5, radius_stride = form == 0 ? 4 : form == 1 ? 1 : 3;
    float *center = array_of(s, (count ? (count - 1) * stride + (form ? 3 : 4) : 0) * sizeof(float));
    float *radius = form && count ? array_of(s, ((count - 1) * radius_stride + 1) * sizeof(float)) : center + 3;
    for (uint32_t i = 0; i < count; i++) {
        float q[4];
        place(r, kind, all, i, q);
        memcpy(center + i * stride, q, 3 * sizeof(float));
        radius[i * radius_stride] = q[3];
    }
    s->sphere[s->geometries] = true;
    s->spheres[s->geometries++] = (cgt_spheres){.count = count,
                                                .centers = cgt_floats(center, stride * sizeof(float)),
                                                .radii = cgt_floats(radius, radius_stride * sizeof(float))};
}

/* Triangles in order, or with descending indices. */
static void add_triangles(loose_scene *s, test_random *r, loose_kind kind, uint32_t all, uint32_t count, int form)
{
    const size_t stride = form == 1 ? 3 : 4, index_stride = form == 1 ? 3 : 4;
    const uint32_t vertices = 3 * count;
    float *vertex = array_of(s, (count ? (vertices - 1) * stride + 3 : 0) * sizeof(float));
    uint32_t *index = form && count ? array_of(s, ((count - 1) * index_stride + 3) * sizeof(uint32_t)) : NULL;
    for (uint32_t i = 0; i < count; i++) {
        float q[4], v[3][3];
        place(r, kind, all, i, q);
        triangle_at(r, kind, i, q, v);
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t at = index ? vertices - 1 - (3 * i + k) : 3 * i + k;
            memcpy(vertex + at * stride, v[k], sizeof v[k]);
            if (index)
                index[i * index_stride + k] = at;
        }
    }
    s->sphere[s->geometries] = false;
    s->triangles[s->geometries++] = (cgt_triangles){.count = count,
                                                    .indices = cgt_uint32s(index, index_stride * sizeof(uint32_t)),
                                                    .vertex_count = vertices,
                                                    .vertices = cgt_floats(vertex, stride * sizeof(float))};
}

loose_scene loose_make(test_random *r, loose_kind kind, loose_what what, uint32_t count)
{
    loose_scene s = {.arrays = 0};
    uint32_t remaining = count;
    for (int form = 0; form < 3; form++) {
        const bool last = form == 2;
        const uint32_t part = last ? remaining : random_below(r, remaining + 1);
        const uint32_t triangles = what == LOOSE_SPHERES ? 0 : what == LOOSE_TRIANGLES ? part : part / 2;
        if (what != LOOSE_TRIANGLES)
            add_spheres(&s, r, kind, count, part - triangles, form);
        if (what != LOOSE_SPHERES)
            add_triangles(&s, r, kind, count, triangles, form);
        remaining -= part;
    }
    return s;
}

void loose_free(loose_scene *s)
{
    for (uint32_t i = 0; i < s->arrays; i++)
        free(s->array[i]);
}

cgt_scene *loose_add(const loose_scene *s, cgt_context *context, const cgt_scene_options *options)
{
    cgt_scene *scene = NULL;
    assert_int_equal(cgt_scene_create(context, options, &scene), CGT_OK);
    for (uint32_t i = 0; i < s->geometries; i++)
        assert_int_equal(s->sphere[i] ? cgt_scene_set_spheres(scene, NULL, &s->spheres[i])
                                      : cgt_scene_set_triangles(scene, NULL, &s->triangles[i]),
                         CGT_OK);
    scene->is_band = true; /* structures are looked at as they are, whatever their scale */
    return scene;
}

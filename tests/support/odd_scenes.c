/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes at odds with single precision. */
#include "support/odd_scenes.h"

#include <math.h>
#include <string.h>

/* ---- primitives ---- */

float odd_power(test_random *r, float low, float high)
{
    return random_below(r, 3) ? random_log(r, low, high) : powf(10, rintf(log10f(random_log(r, low, high))));
}

static void random_point(test_random *r, float reach, float p[3])
{
    for (int a = 0; a < 3; a++)
        p[a] = random_below(r, 4) ? random_float(r, -reach, reach) : rintf(random_float(r, -2, 2)) * reach / 2;
}

void odd_beside(test_random *r, const float from[3], float way, float p[3])
{
    float d[3];
    random_direction(r, d);
    if (random_below(r, 4) == 0)
        for (uint32_t a = 0, axis = random_below(r, 3); a < 3; a++)
            d[a] = a == axis ? (random_below(r, 2) ? 1.f : -1.f) : 0;
    for (int a = 0; a < 3; a++)
        p[a] = from[a] + way * d[a];
}

static void add_sphere(odd_scene *s, const float p[3], float radius)
{
    if (s->spheres == ODD_MOST)
        return;
    memcpy(s->sphere[s->spheres], p, 3 * sizeof *p);
    s->sphere[s->spheres++][3] = radius;
}

static void add_capsule(odd_scene *s, const float p[3], const float q[3], float radius)
{
    if (s->capsules == ODD_MOST)
        return;
    memcpy(s->capsule[s->capsules], p, 3 * sizeof *p);
    memcpy(s->capsule[s->capsules] + 3, q, 3 * sizeof *q);
    s->capsule[s->capsules++][6] = radius;
}

static void add_triangle(odd_scene *s, const float p[3], const float q[3], const float v[3])
{
    if (s->triangles == ODD_MOST)
        return;
    memcpy(s->vertex[3 * s->triangles], p, 3 * sizeof *p);
    memcpy(s->vertex[3 * s->triangles + 1], q, 3 * sizeof *q);
    memcpy(s->vertex[3 * s->triangles++ + 2], v, 3 * sizeof *v);
}

/* A primitive of any kind, of about that size. */
static void add_usual(test_random *r, odd_scene *s, uint32_t kinds, float reach, float size)
{
    float p[3], q[3], v[3];
    random_point(r, reach, p);
    odd_beside(r, p, size, q);
    odd_beside(r, p, size, v);
    switch (kinds >> random_below(r, 3) & 1 ? random_below(r, 3) : kinds % 3) {
    case 0: add_sphere(s, p, size / 2); break;
    case 1: add_triangle(s, p, q, v); break;
    default: add_capsule(s, p, q, random_below(r, 8) ? size / 8 : 0); break;
    }
}

static void add_some(test_random *r, odd_scene *s)
{
    const uint32_t kinds = random_below(r, 8);
    for (uint32_t k = random_below(r, 24); k; k--)
        add_usual(r, s, kinds, 1, random_log(r, 0.01f, 0.5f));
}

static void place_rods(test_random *r, odd_scene *s)
{
    const uint32_t count = 1 + random_below(r, 10);
    const float thick = odd_power(r, 1e-3f, 1), along = odd_power(r, 1, 1e9f);
    float way[3], zero[3] = {0, 0, 0};
    odd_beside(r, zero, 1, way);
    for (uint32_t k = 0; k < count; k++) {
        const float length = random_below(r, 3) ? along : odd_power(r, 1, 1e15f);
        float p[3], q[3];
        random_point(r, random_below(r, 2) ? 1 : 10 * thick, p);
        odd_beside(r, p, length * thick, q);
        for (int a = 0; a < 3 && k % 3 == 2; a++)
            q[a] = p[a] + way[a] * length * thick;
        add_capsule(s, p, q, random_below(r, 10) ? thick * (random_below(r, 3) ? 1 : random_float(r, 0, 1)) : 0);
        if (random_below(r, 5) == 0)
            add_sphere(s, random_below(r, 2) ? p : q, thick);
    }
    if (random_below(r, 3) == 0)
        add_some(r, s);
}

static void place_slivers(test_random *r, odd_scene *s)
{
    const uint32_t count = 1 + random_below(r, 16);
    const float width = odd_power(r, 1e-6f, 1), aspect = odd_power(r, 10, 1e9f);
    for (uint32_t k = 0; k < count; k++) {
        const float length = width * (random_below(r, 3) ? aspect : odd_power(r, 10, 1e15f));
        float p[3], q[3], v[3];
        random_point(r, random_below(r, 2) ? 1 : 10 * width, p);
        odd_beside(r, p, length, q);
        const float at = random_below(r, 3) ? (float)random_below(r, 2) : random_float(r, 0, 1);
        for (int a = 0; a < 3; a++)
            v[a] = p[a] + (q[a] - p[a]) * at;
        odd_beside(r, v, width, v);
        add_triangle(s, p, q, v);
        if (random_below(r, 4) == 0)
            add_triangle(s, q, p, v);
    }
    if (random_below(r, 3) == 0)
        add_some(r, s);
}

static void place_giants(test_random *r, odd_scene *s)
{
    add_some(r, s);
    for (uint32_t k = 1 + random_below(r, 3); k; k--) {
        const float size = odd_power(r, 10, random_below(r, 2) ? 1e4f : 1e15f);
        float p[3], q[3], v[3], near[3];
        random_point(r, 1, near);
        odd_beside(r, near, size, p);
        odd_beside(r, p, size, q);
        odd_beside(r, p, size, v);
        switch (random_below(r, 5)) {
        case 0: add_sphere(s, p, size); break;
        case 1: add_sphere(s, p, size * random_float(r, 0.9f, 1.1f)); break;
        case 2: add_capsule(s, p, q, size * random_float(r, 0, 1)); break;
        case 3: add_triangle(s, p, q, v); break;
        default:
            for (int a = 0; a < 3; a++) /* a floor */
                p[a] = a == 1 ? -1 : -size,
                q[a] = a == 0   ? size
                       : a == 1 ? -1
                                : -size,
                v[a] = a == 1 ? -1
                       : a    ? size
                              : 0;
            add_triangle(s, p, q, v);
        }
    }
}

static void place_strays(test_random *r, odd_scene *s)
{
    for (uint32_t k = 1 + random_below(r, 20), kinds = random_below(r, 8); k; k--)
        add_usual(r, s, kinds, 1, random_log(r, 0.01f, 0.5f));
    for (uint32_t k = 1 + random_below(r, 3); k; k--) {
        const float far = odd_power(r, 1e2f, random_below(r, 2) ? 1e9f : random_below(r, 2) ? 1e15f : 1e32f);
        const float size = random_below(r, 2) ? random_log(r, 0.01f, 1) : far * random_log(r, 1e-6f, 1);
        float p[3], q[3], v[3], zero[3] = {0, 0, 0};
        odd_beside(r, zero, far, p);
        odd_beside(r, p, size, q);
        odd_beside(r, p, size, v);
        switch (random_below(r, 6)) {
        case 0: add_sphere(s, p, size); break;
        case 1: add_triangle(s, p, q, v); break;
        case 2: add_capsule(s, p, q, size / 4); break;
        case 3:
            random_point(r, 1, q);
            add_capsule(s, q, p, random_below(r, 2) ? 0.1f : far * 1e-3f);
            break;
        case 4:
            random_point(r, 1, q);
            random_point(r, 1, v);
            add_triangle(s, q, random_below(r, 2) ? v : q, p);
            break;
        default:
            random_point(r, 1, q);
            odd_beside(r, q, far, v);
            add_triangle(s, q, v, p);
        }
    }
}

static void place_sizes(test_random *r, odd_scene *s)
{
    const float low = odd_power(r, 1e-12f, 1), high = odd_power(r, 1, 1e12f);
    for (uint32_t k = 1 + random_below(r, 30), kinds = random_below(r, 8); k; k--) {
        const float size = random_log(r, low, high);
        add_usual(r, s, kinds, size, size * random_log(r, 0.01f, 1));
    }
}

static void place_equals(test_random *r, odd_scene *s)
{
    for (uint32_t k = 1 + random_below(r, 20); k; k--) {
        float p[3], q[3], v[3];
        for (int a = 0; a < 3; a++) {
            p[a] = (float)random_below(r, 3) - 1;
            q[a] = random_below(r, 2) ? p[a] : (float)random_below(r, 3) - 1;
            v[a] = random_below(r, 2) ? p[a] : (float)random_below(r, 3) - 1;
        }
        const float radius = random_below(r, 4) ? 0.5f : random_below(r, 2) ? 0.25f : 0;
        switch (random_below(r, 3)) {
        case 0: add_sphere(s, p, radius); break;
        case 1: add_triangle(s, p, q, v); break;
        default: add_capsule(s, p, q, radius);
        }
    }
}

static void place_usual(test_random *r, odd_scene *s)
{
    const uint32_t kinds = random_below(r, 8);
    const float most = random_below(r, 2) ? 0.1f : 1;
    for (uint32_t k = 1 + random_below(r, 40); k; k--)
        add_usual(r, s, kinds, 1, random_log(r, 0.01f, most));
}

static void place_crowds(test_random *r, odd_scene *s)
{
    const uint32_t kinds = random_below(r, 8), clumps = 1 + random_below(r, 4);
    const float spread = random_below(r, 2) ? 1 : odd_power(r, 1, 1e5f);
    float middle[4][3];
    for (uint32_t k = 0; k < clumps; k++)
        random_point(r, spread, middle[k]);
    for (uint32_t k = 300 + random_below(r, 1500); k; k--) {
        float p[3], q[3], v[3];
        const float size = random_log(r, 1e-3f, 0.1f);
        odd_beside(r, middle[random_below(r, clumps)], random_float(r, 0, 1), p);
        odd_beside(r, p, size, q);
        odd_beside(r, p, size, v);
        switch (kinds < 3 ? kinds : kinds < 6 ? random_below(r, 3) : 1 + random_below(r, 2)) {
        case 0: add_sphere(s, p, size / 2); break;
        case 1: add_triangle(s, p, q, v); break;
        default: add_capsule(s, p, q, size / 8);
        }
    }
    for (uint32_t k = random_below(r, 4); k; k--)
        add_usual(r, s, kinds, odd_power(r, 1, 1e9f), odd_power(r, 0.01f, 1e9f));
}

/* Squares of 1e-19 to 1e-23 of what is far away are denormal where that is about 1. */
static void place_specks(test_random *r, odd_scene *s)
{
    const float far = odd_power(r, random_below(r, 2) ? 1e-8f : 1, 1e12f);
    const float size = far * (random_below(r, 3) ? random_log(r, 1e-23f, 1e-19f) : odd_power(r, 1e-36f, 1e-12f));
    const uint32_t kinds = random_below(r, 8);
    const bool alike = random_below(r, 2);
    for (uint32_t k = 1 + random_below(r, 30); k; k--) {
        float p[3];
        random_point(r, size, p);
        if (alike)
            add_sphere(s, p, size * random_log(r, 0.05f, 0.5f));
        else
            add_usual(r, s, kinds, size, size * random_log(r, 0.01f, 0.5f));
    }
    for (uint32_t k = 1 + random_below(r, 3); k; k--)
        add_usual(r, s, random_below(r, 8), far, far * random_log(r, 1e-12f, 1));
    s->unit = size;
}

typedef void place_fn(test_random *r, odd_scene *s);

static const struct {
    const char *name;
    place_fn *place;
} families[ODD_FAMILIES] = {
    [ODD_RODS] = {"rods", place_rods},       [ODD_SLIVERS] = {"slivers", place_slivers},
    [ODD_GIANTS] = {"giants", place_giants}, [ODD_STRAYS] = {"strays", place_strays},
    [ODD_SIZES] = {"sizes", place_sizes},    [ODD_EQUALS] = {"equals", place_equals},
    [ODD_USUAL] = {"usual", place_usual},    [ODD_CROWDS] = {"crowds", place_crowds},
    [ODD_SPECKS] = {"specks", place_specks},
};

const char *odd_name(odd_family family) { return families[family].name; }

/* Multiplies all, and moves it. */
static void scale_scene(odd_scene *s, float scale, const float by[3])
{
    for (uint32_t i = 0; i < s->spheres; i++)
        for (int a = 0; a < 4; a++)
            s->sphere[i][a] = s->sphere[i][a] * scale + (a < 3 ? by[a] : 0);
    for (uint32_t i = 0; i < s->capsules; i++)
        for (int a = 0; a < 7; a++)
            s->capsule[i][a] = s->capsule[i][a] * scale + (a < 6 ? by[a % 3] : 0);
    for (uint32_t i = 0; i < 3 * s->triangles; i++)
        for (int a = 0; a < 3; a++)
            s->vertex[i][a] = s->vertex[i][a] * scale + by[a];
}

void odd_scene_make(test_random *r, odd_family family, odd_scene *s)
{
    float by[3] = {0, 0, 0};
    s->spheres = s->capsules = s->triangles = 0;
    s->unit = 1;
    families[family].place(r, s);
    if (family == ODD_SPECKS) /* they have their size, and a place where floats tell them apart */
        return;
    if (random_below(r, 4) == 0)
        s->unit = odd_power(r, 1e-30f, 1e30f);
    else if (random_below(r, 6) == 0)
        s->unit = odd_power(r, 1e-9f, 1e9f);
    if (random_below(r, 6) == 0)
        odd_beside(r, by, s->unit * odd_power(r, 1, 1e6f), by);
    scale_scene(s, s->unit, by);
}

/* ---- scenes of the library and the oracle ---- */

cgt_scene *odd_scene_commit(cgt_context *context, const odd_scene *s)
{
    cgt_scene_options options = {.structure = CGT_STRUCTURE_AUTO};
    cgt_scene *scene = NULL;
    assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
    const cgt_spheres spheres = spheres_of(s->sphere, s->spheres);
    const cgt_capsules capsules = {.count = s->capsules,
                                   .vertices = cgt_floats(s->capsule[0], 7 * sizeof(float)),
                                   .ends = cgt_floats(s->capsule[0] + 3, 7 * sizeof(float)),
                                   .vertex_count = s->capsules,
                                   .radii = cgt_floats(&s->capsule[0][6], 7 * sizeof(float))};
    const cgt_triangles triangles = {
        .count = s->triangles, .vertices = cgt_floats(s->vertex[0], 0), .vertex_count = 3 * s->triangles};
    if (s->spheres)
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    if (s->capsules)
        assert_int_equal(cgt_scene_set_capsules(scene, NULL, &capsules), CGT_OK);
    if (s->triangles)
        assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

oracle_scene odd_scene_truth(const odd_scene *s)
{
    oracle_scene truth = {0};
    uint32_t geometry = 0;
    if (s->spheres)
        oracle_scene_add_spheres(&truth, geometry++, (const float(*)[4])s->sphere, s->spheres);
    if (s->capsules)
        oracle_scene_add_capsules(&truth, geometry++, (const float(*)[7])s->capsule, s->capsules);
    if (s->triangles)
        oracle_scene_add_triangles(&truth, geometry, (const float(*)[3])s->vertex, 3 * s->triangles, NULL,
                                   s->triangles);
    return truth;
}

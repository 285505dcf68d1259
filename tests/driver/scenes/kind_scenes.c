/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Small random scenes of many kinds, one row each, each hard in its own way. */
#include <math.h>
#include <string.h>

#include "driver/scenes/scene_heap.h"

#define KIND_MOST 48u /* of each sort: spheres, triangles, capsules */

typedef struct kind_scene {
    float sphere[KIND_MOST][4], vertex[3 * KIND_MOST][3], capsule[KIND_MOST][7];
    uint32_t spheres, triangles, capsules;
    test_random random;
    float shared[3]; /* a point that primitives may share */
} kind_scene;

static float real(kind_scene *s, float low, float high) { return random_float(&s->random, low, high); }
static float whole(kind_scene *s, uint32_t count) { return (float)random_below(&s->random, count); }

static void any_point(kind_scene *s, float reach, float p[3])
{
    for (int a = 0; a < 3; a++)
        p[a] = real(s, -reach, reach);
}

/* ---- kinds: what becomes of sphere i and triangle i, which are evenly spread and small at first ---- */

typedef void change(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3]);

/* Calls for each coordinate of both: those of the sphere, its radius as axis 3, and those of the triangle. */
#define EACH(k, a, x)                                                                                                  \
    for (uint32_t k = 0; k < 4; k++)                                                                                   \
        for (uint32_t a = 0; a < (k ? 3u : 4u); a++)                                                                   \
            for (float *x = k ? &vertex[k - 1][a] : &sphere[a]; x; x = NULL)

static void scale(float sphere[4], float (*vertex)[3], float by) { EACH(k, a, x) *x *= by; }

static void even(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)s, (void)i, (void)sphere, (void)vertex;
}

static void lattice(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)i;
    EACH(k, a, x) *x = a == 3 ? 0.5f : whole(s, 4);
}

static void sheet(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)s, (void)i;
    EACH(k, a, x) *x = a == 2 ? 0 : *x;
}

static void slope(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)s, (void)i;
    for (int k = 0; k < 3; k++)
        vertex[k][2] = 0.125f + 0.5f * vertex[k][0];
    sphere[2] = 0.125f + 0.5f * sphere[0];
}

static void coincident(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    if (i >= 4) {
        const uint32_t from = (uint32_t)whole(s, 4);
        memcpy(sphere, s->sphere[from], sizeof s->sphere[0]);
        for (uint32_t k = 0; k < 3; k++) /* turned, so that other edges come first */
            memcpy(vertex[k], s->vertex[3 * from + (k + i) % 3], sizeof *vertex);
    }
}

static void nested(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    static const float corner[3][3] = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    (void)s;
    EACH(k, a, x) *x = k == 0 ? (a == 3 ? (float)(i + 1) / 8 : 0) : corner[k - 1][a] * (float)(i + 1) / 8;
}

static void sizes(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)i;
    scale(sphere, vertex, ldexpf(1, (int)whole(s, 201) - 100));
}

static void strays(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    if (i % 16 == 15)
        scale(sphere, vertex, ldexpf(1, 20 + (int)whole(s, 60)));
}

static void not_finite(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    static const float odd[] = {NAN, INFINITY, -INFINITY, -1};
    if (i % 2) {
        sphere[(uint32_t)whole(s, 4)] = odd[(uint32_t)whole(s, 4)];
        vertex[(uint32_t)whole(s, 3)][(uint32_t)whole(s, 3)] = odd[(uint32_t)whole(s, 4)];
    }
}

static void slivers(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)i;
    any_point(s, 1, vertex[1]);
    for (int a = 0; a < 3; a++)
        vertex[2][a] = vertex[1][a] + real(s, -1e-6f, 1e-6f);
    sphere[3] *= 1e-6f;
}

static void denormal(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)s, (void)i;
    scale(sphere, vertex, 0x1p-140f);
}

static void tiny(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)s, (void)i;
    scale(sphere, vertex, 0x1p-60f);
}

static void near_limit(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)s, (void)i;
    scale(sphere, vertex, 0x1.8p126f);
}

static void far_away(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)i;
    EACH(k, a, x) *x += a == 3 ? 0 : 0x1p18f * s->shared[a];
}

static void points(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    sphere[3] = 0;
    if (i % 2) /* without an area */
        memcpy(vertex[(uint32_t)whole(s, 2)], vertex[2], sizeof *vertex);
}

static void axis_line(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)s, (void)i;
    sphere[1] = sphere[2] = 0;
    for (int k = 0; k < 2; k++)
        vertex[k][1] = vertex[k][2] = 0;
}

/* Spheres that touch each other, and triangles that touch them. */
static void tangent(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)s;
    const float at[4] = {(float)(i % 4), (float)(i / 4 % 4), (float)(i / 16), 0.5f};
    memcpy(sphere, at, sizeof at);
    for (int k = 0; k < 3; k++)
        vertex[k][2] = at[2] + 0.5f;
}

static void log_normal(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    float sum = 0;
    (void)i;
    for (int k = 0; k < 12; k++)
        sum += real(s, -0.5f, 0.5f);
    sphere[3] = 0.01f * expf(3 * sum);
    for (int a = 0; a < 3; a++)
        vertex[1][a] = vertex[0][a] + sphere[3] * vertex[1][a];
}

static void fan(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    memcpy(vertex[0], s->shared, sizeof *vertex);
    if (i)
        memcpy(vertex[1], s->vertex[3 * i - 1], sizeof *vertex);
    memcpy(sphere, s->shared, sizeof s->shared); /* concentric */
}

static void nearly_equal(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    const float first[4] = {s->sphere[0][0], s->sphere[0][1], s->sphere[0][2], s->sphere[0][3]};
    if (i == 0)
        return;
    EACH(k, a, x)
    {
        *x = k ? s->vertex[k - 1][a] : first[a];
        for (uint32_t steps = (uint32_t)whole(s, 3); steps > 0; steps--)
            *x = nextafterf(*x, i % 2 ? INFINITY : -INFINITY);
    }
}

/* A strip of squares whose triangles share their edges. */
static void strip(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)s, (void)sphere;
    const float x = (float)(i / 2) / 8,
                corner[4][3] = {{x, 0, 0}, {x, 0.5f, 0}, {x + 0.125f, 0, 0.1f * x}, {x + 0.125f, 0.5f, 0}};
    for (uint32_t k = 0; k < 3; k++)
        memcpy(vertex[k], corner[k + i % 2], sizeof *vertex);
}

/* Seen along z, both edges run in nearly the same direction, and the first vertex has more digits than the others: the
 * normal's z is 2^-46 of the products whose difference it is, which double rounds at 2^-53. Every fourth triangle has a
 * z of that vertex alone, which edges in double lose; others have exact edges with rounded products. */
static void cancelling(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    const bool lost = i % 4 == 0;
    const float digits = lost ? 0x1p-60f : i % 4 == 1 ? 0x1p-20f : 0x1p-36f, end = lost ? 2 : 1;
    const float slope = lost ? 1 : 1 + 0x1p-23f * (1 + whole(s, 9)), twice = 1 + 2 * (slope - 1);
    const float size = ldexpf(1, (int)whole(s, 3) - 2), height = real(s, 0.25f, 1);
    const float corner[3][3] = {{real(s, 0, digits), real(s, 0, digits), -height},
                                {size, size * slope, 0},
                                {size * slope * end, size * twice * end, lost ? 0 : height}};
    (void)sphere;
    memcpy(vertex, corner, sizeof corner);
}

/* Each coordinate may have a size of its own. */
static void odd_coordinates(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)i;
    EACH(k, a, x)
    if (whole(s, 6) == 0)
        *x = ldexpf(*x, (int)whole(s, 221) - 110);
}

static void any_bits(kind_scene *s, uint32_t i, float sphere[4], float (*vertex)[3])
{
    (void)i;
    EACH(k, a, x) *x = random_any_float(&s->random);
}

static const struct {
    const char *name;
    change *change;
    uint32_t most; /* primitives of each sort; 0: KIND_MOST */
} kinds[] = {{"even", even, 0},
             {"lattice", lattice, 0},
             {"sheet", sheet, 0},
             {"sloped plane", slope, 0},
             {"coincident", coincident, 0},
             {"nested", nested, 0},
             {"sizes 2^-100 to 2^100", sizes, 0},
             {"strays", strays, 0},
             {"one", even, 1},
             {"not finite", not_finite, 0},
             {"slivers", slivers, 0},
             {"denormal", denormal, 0},
             {"tiny", tiny, 0},
             {"near 2^127", near_limit, 0},
             {"far from the origin", far_away, 0},
             {"points", points, 0},
             {"axis line", axis_line, 0},
             {"tangent", tangent, 0},
             {"log-normal", log_normal, 0},
             {"fan", fan, 0},
             {"nearly equal", nearly_equal, 0},
             {"strip", strip, 0},
             {"cancelling", cancelling, 0},
             {"odd coordinates", odd_coordinates, 0},
             {"any bits", any_bits, 0}};

static const char *kind_name(uint32_t kind) { return kinds[kind].name; }

/* From the sphere to a vertex, an edge of the triangle, or from the end of the one before; some are spheres. */
static void make_capsule(kind_scene *s, uint32_t i)
{
    float *const to = s->capsule[i];
    const float(*const vertex)[3] = (const float(*)[3]) & s->vertex[3 * i];
    const uint32_t how = random_below(&s->random, 8);
    memcpy(to, how < 3 ? s->sphere[i] : how < 5 && i ? s->capsule[i - 1] + 3 : vertex[1], 3 * sizeof *to);
    memcpy(to + 3, how == 7 ? to : vertex[0], 3 * sizeof *to);
    to[6] = s->sphere[i][3];
    if (how == 0) /* about as wide as long */
        for (int a = 0; a < 3; a++)
            to[3 + a] = to[a] + 0.5f * (vertex[0][a] - vertex[1][a]);
}

static void kind_scene_make(kind_scene *s, uint32_t kind, uint64_t stream)
{
    const uint32_t most = kinds[kind].most ? kinds[kind].most : KIND_MOST;
    memset(s, 0, sizeof *s);
    s->random = random_make(stream);
    any_point(s, 1, s->shared);
    /* any sorts, as bits: spheres, triangles, capsules */
    const uint32_t any = 1 + random_below(&s->random, 7), sorts = kinds[kind].change == cancelling ? 2 : any;
    s->spheres = sorts & 1 ? 1 + random_below(&s->random, most) : 0;
    s->triangles = sorts & 2 ? 1 + random_below(&s->random, most) : 0;
    s->capsules = sorts & 4 ? 1 + random_below(&s->random, most) : 0;
    for (uint32_t i = 0; i < most; i++) {
        any_point(s, 1, s->sphere[i]);
        s->sphere[i][3] = real(s, 0.01f, 0.3f);
        float(*const vertex)[3] = &s->vertex[3 * i];
        any_point(s, 1, vertex[0]);
        for (int k = 1; k < 3; k++)
            for (int a = 0; a < 3; a++)
                vertex[k][a] = vertex[0][a] + real(s, -0.4f, 0.4f);
        kinds[kind].change(s, i, s->sphere[i], vertex);
        make_capsule(s, i);
    }
}

/* Without capsules twice as often as with them: such scenes have crossings, and all structures. */
static void make(scene_heap *h, uint32_t kind)
{
    static kind_scene k;
    const bool capsules = random_below(h->r, 2);
    kind_scene_make(&k, kind, random_bits(h->r));
    for (uint32_t i = 0; i < k.spheres; i++)
        memcpy(scene_heap_add(h, ORACLE_SPHERE), k.sphere[i], sizeof k.sphere[i]);
    for (uint32_t i = 0; i < k.triangles; i++)
        memcpy(scene_heap_add(h, ORACLE_TRIANGLE), k.vertex[3 * i], 3 * sizeof k.vertex[0]);
    for (uint32_t i = 0; i < k.capsules && capsules; i++)
        memcpy(scene_heap_add(h, ORACLE_CAPSULE), k.capsule[i], sizeof k.capsule[i]);
    h->scene->scale = 0; /* of any magnitude */
}

const scene_group kind_scenes = {sizeof kinds / sizeof kinds[0], kind_name, make};

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Checker of raw kd-trees, and degenerate scenes. */
#include "exact/valid_primitive.h"
#include "kd/kd_build_cases.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kd/kd_touch.h"

/* ---- raw trees ---- */

typedef struct check {
    const cgt_kd_raw *raw;
    const cgt_committed_scene *committed_scene;
    const cgt_kd_costs *costs;
    uint8_t *reached; /* of each node */
    uint32_t max_leaf_depth;
    double root_area, cost;
    char *text;
} check;

static char fault[256];

static double half_area(const kd_box *b)
{
    const double x = (double)b->high[0] - b->low[0], y = (double)b->high[1] - b->low[1],
                 z = (double)b->high[2] - b->low[2];
    return x * y + y * z + z * x;
}

/* Whether the bounds, rounded outwards, touch the box. */
static bool bounds_touch(const cgt_primitive *primitive, const kd_box *box)
{
    for (int a = 0; a < 3; a++) {
        const cgt_triangle *t = &primitive->triangle;
        const cgt_sphere *s = &primitive->sphere;
        const float center = a == 0 ? s->x : a == 1 ? s->y : s->z;
        const bool sphere = primitive->kind == CGT_KIND_SPHERES;
        const float low =
            sphere ? nextafterf(center - s->r, -INFINITY) : fminf(t->v[0][a], fminf(t->v[1][a], t->v[2][a]));
        const float high =
            sphere ? nextafterf(center + s->r, INFINITY) : fmaxf(t->v[0][a], fmaxf(t->v[1][a], t->v[2][a]));
        if (low > box->high[a] || high < box->low[a])
            return false;
    }
    return true;
}

static bool listed(const uint32_t *reference, uint32_t count, uint32_t prim)
{
    for (uint32_t i = 0; i < count; i++)
        if (reference[i] == prim)
            return true;
    return false;
}

static bool report_fault(uint32_t node, const char *what, uint32_t prim)
{
    snprintf(fault, sizeof fault, "node %u: %s (primitive %u)", node, what, prim);
    return false;
}

static bool check_leaf(check *c, uint32_t number, const kd_box *box, const uint32_t *candidates, uint32_t count)
{
    const cgt_primitives *o = &c->committed_scene->prims;
    const uint32_t references = cgt_kd_count(c->raw->node[number]);
    const uint32_t *reference = c->raw->reference + c->raw->node[number].word[1];
    double weight = 0;
    for (uint32_t i = 0; i < references; i++) {
        if (reference[i] >= o->count || (i && reference[i] <= reference[i - 1]))
            return report_fault(number, "references do not ascend", reference[i]);
        const cgt_primitive primitive = cgt_primitives_get(o, reference[i]);
        if (cgt_primitive_check(&primitive) != CGT_PRIMITIVE_VALID)
            return report_fault(number, "not a valid primitive", reference[i]);
        if (!bounds_touch(&primitive, box))
            return report_fault(number, "its bounds do not touch the leaf", reference[i]);
        weight += c->costs->test[primitive.kind];
    }
    for (uint32_t i = 0; i < count; i++)
        if (!listed(reference, references, candidates[i]))
            return report_fault(number, "touches the leaf but is not listed", candidates[i]);
    c->cost += weight * half_area(box) / c->root_area;
    return true;
}

/* candidates: the primitives that touch the box of the parent. */
static bool check_node(check *c, uint32_t number, const kd_box *box, uint32_t depth, const uint32_t *candidates,
                       uint32_t count)
{
    if (number >= c->raw->nodes || c->reached[number]++)
        return report_fault(number, "out of range, or reached twice", 0);
    const cgt_kd_node node = c->raw->node[number];
    uint32_t *touching = malloc((count + 1) * sizeof *touching), touching_count = 0;
    assert_non_null(touching);
    for (uint32_t i = 0; i < count; i++) {
        const cgt_primitive primitive = cgt_primitives_get(&c->committed_scene->prims, candidates[i]);
        if (kd_touches(&primitive, box))
            touching[touching_count++] = candidates[i];
    }
    bool good;
    if (cgt_kd_is_leaf(node)) {
        good = check_leaf(c, number, box, touching, touching_count);
    } else {
        const uint32_t axis = cgt_kd_axis(node);
        const float split = cgt_kd_split(node);
        kd_box lower = *box, upper = *box;
        lower.high[axis] = upper.low[axis] = split;
        c->cost += c->costs->inner * half_area(box) / c->root_area;
        good = split > box->low[axis] && split < box->high[axis] ? true
                                                                 : report_fault(number, "the split is not inside", 0);
        good = good && (depth < c->max_leaf_depth ? true : report_fault(number, "too deep", 0));
        good = good && (node.word[1] % 2 == 0 ? true : report_fault(number, "children are not a pair", 0));
        good = good && check_node(c, node.word[1], &lower, depth + 1, touching, touching_count) &&
               check_node(c, node.word[1] + 1, &upper, depth + 1, touching, touching_count);
    }
    free(touching);
    return good;
}

const char *raw_tree_check(const cgt_kd_raw *raw, const cgt_committed_scene *committed_scene, const cgt_kd_costs *costs)
{
    check c = {.raw = raw, .committed_scene = committed_scene, .costs = costs, .reached = calloc(raw->nodes, 1)};
    uint32_t *valid = malloc((committed_scene->prims.count + 1) * sizeof *valid), count = 0;
    assert_non_null(valid);
    assert_non_null(c.reached);
    for (uint32_t i = 0; i < committed_scene->prims.count; i++) {
        const cgt_primitive primitive = cgt_primitives_get(&committed_scene->prims, i);
        if (cgt_primitive_check(&primitive) == CGT_PRIMITIVE_VALID)
            valid[count++] = i;
    }
    assert_int_equal(count, committed_scene->valid);
    c.max_leaf_depth = (uint32_t)floor(8 + 1.3 * log2(count));
    kd_box box;
    memcpy(box.low, raw->low, sizeof box.low);
    memcpy(box.high, raw->high, sizeof box.high);
    c.root_area = half_area(&box);
    bool good = check_node(&c, 0, &box, 0, valid, count);
    if (good && !(fabs(c.cost - raw->cost) <= 1e-9 * c.cost)) {
        snprintf(fault, sizeof fault, "the cost is %.17g, not %.17g", c.cost, raw->cost);
        good = false;
    }
    free(valid);
    free(c.reached);
    return good ? NULL : fault;
}

static void mix(uint64_t *hash, uint64_t value)
{
    *hash = (*hash ^ value) * UINT64_C(0x9e3779b97f4a7c15);
    *hash ^= *hash >> 29;
}

static void hash_node(const cgt_kd_raw *raw, uint32_t number, uint64_t *hash)
{
    const cgt_kd_node n = raw->node[number];
    mix(hash, n.word[0]);
    if (cgt_kd_is_leaf(n)) {
        for (uint32_t i = 0; i < cgt_kd_count(n); i++)
            mix(hash, raw->reference[n.word[1] + i]);
        return;
    }
    hash_node(raw, n.word[1], hash);
    hash_node(raw, n.word[1] + 1, hash);
}

uint64_t raw_tree_hash(const cgt_kd_raw *raw)
{
    uint64_t hash = raw->limited_leaves, bits;
    memcpy(&bits, &raw->cost, sizeof bits);
    mix(&hash, bits);
    hash_node(raw, 0, &hash);
    return hash;
}

/* ---- degenerate scenes ---- */

static void sphere(degenerate_scene *d, float x, float y, float z, float r)
{
    float *s = d->sphere[d->spheres++];
    s[0] = x;
    s[1] = y;
    s[2] = z;
    s[3] = r;
}

static void triangle(degenerate_scene *d, const float v[3][3])
{
    memcpy(d->vertex[3 * d->triangles++], v, 9 * sizeof(float));
}

/* A random triangle within `size` of the origin; flat: perpendicular to an axis. */
static void random_triangle(degenerate_scene *d, test_random *r, float size, float floor)
{
    float v[3][3];
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++) {
            const float x = random_float(r, -size, size);
            v[k][a] = fabsf(x) < floor ? copysignf(floor, x) : x;
        }
    triangle(d, (const float(*)[3])v);
}

static void floor_triangle(degenerate_scene *d, uint32_t i, uint32_t axis, float height)
{
    const float x = (float)(i / 2 % 16), y = (float)(i / 32), corner = i % 2 ? 1 : 0;
    const float in[3][2] = {{x + corner, y + corner}, {x + 1, y}, {x, y + 1}};
    float v[3][3];
    for (int k = 0; k < 3; k++) {
        v[k][axis] = height;
        v[k][(axis + 1) % 3] = in[k][0];
        v[k][(axis + 2) % 3] = in[k][1];
    }
    triangle(d, (const float(*)[3])v);
}

/* Arbitrary bits, except numbers so large that no tree would be built. */
static float garbage(test_random *r)
{
    const float x = random_any_float(r);
    return fabsf(x) > 0x1p54f ? NAN : x;
}

static void add(degenerate_scene *d, degenerate_kind kind, test_random *r, uint32_t i)
{
    static const float heights[] = {-0.0f, 0.0f, 1, 1.00000012f, -0x1p-149f, 3};
    const float angle = (float)i * 0.37f;
    float v[3][3] = {{0, 0, 0}, {1, 0.3f, 0.7f}, {-0.2f, 0.9f, 0.5f}};
    switch (kind) {
    case DEGENERATE_SAME_SPHERES: sphere(d, 1.1f, -2.3f, 0.7f, 0.6f); break;
    case DEGENERATE_POINTS: {
        const float x = (float)(i % 5), y = random_float(r, -1, 1);
        sphere(d, x, i % 3 ? y : -0.0f, 0, 0);
        break;
    }
    case DEGENERATE_SAME_TRIANGLES: triangle(d, (const float(*)[3])v); break;
    case DEGENERATE_FLOOR: floor_triangle(d, i, 1, 0.1f); break;
    case DEGENERATE_LAYERS: floor_triangle(d, i % 64, i % 3, heights[random_below(r, 6)]); break;
    case DEGENERATE_LINE: sphere(d, 3, -1, 0.25f * (float)i, i % 2 ? 0 : 0.125f); break;
    case DEGENERATE_HUGE: random_triangle(d, r, 0x1.fp54f, 0); break;
    case DEGENERATE_TINY: random_triangle(d, r, i % 2 ? 0x1p-140f : 0x1p-126f, i % 3 ? 0 : 0x1p-149f); break;
    case DEGENERATE_WIDE: random_triangle(d, r, random_log(r, 0x1p-125f, 0x1p54f), 0); break;
    case DEGENERATE_FAN:
        v[1][0] = cosf(angle);
        v[1][1] = sinf(angle);
        v[2][0] = cosf(angle + 0.2f);
        v[2][1] = sinf(angle + 0.2f);
        v[2][2] = 0.3f * cosf(3 * angle);
        triangle(d, (const float(*)[3])v);
        break;
    case DEGENERATE_GARBAGE:
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                v[k][a] = i ? garbage(r) : v[k][a];
        triangle(d, (const float(*)[3])v);
        if (i)
            sphere(d, garbage(r), garbage(r), garbage(r), garbage(r));
        break;
    case DEGENERATE_KINDS: break;
    }
}

void degenerate_make(degenerate_scene *d, degenerate_kind kind, uint32_t count)
{
    test_random r = random_make(40 + (uint64_t)kind);
    *d = (degenerate_scene){.sphere = calloc(count, sizeof *d->sphere), .vertex = calloc(count, 3 * sizeof *d->vertex)};
    assert_non_null(d->sphere);
    assert_non_null(d->vertex);
    for (uint32_t i = 0; i < count; i++)
        add(d, kind, &r, i);
}

cgt_scene *degenerate_commit(cgt_context *context, const degenerate_scene *d)
{
    cgt_scene *scene;
    uint32_t id;
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    const cgt_spheres spheres = spheres_of((const float(*)[4])d->sphere, d->spheres);
    const cgt_triangles triangles = {.count = d->triangles,
                                     .vertices = d->vertex[0],
                                     .vertex_stride = sizeof d->vertex[0],
                                     .vertex_count = 3 * d->triangles};
    if (d->spheres)
        assert_int_equal(cgt_scene_add_spheres(scene, &spheres, &id), CGT_OK);
    if (d->triangles)
        assert_int_equal(cgt_scene_add_triangles(scene, &triangles, &id), CGT_OK);
    scene->is_band = true; /* trees are built over it, whatever its scale */
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_true(scene->committed_scene.valid > 0);
    assert_false(scene->committed_scene.brute_force);
    return scene;
}

void degenerate_free(degenerate_scene *d)
{
    free(d->sphere);
    free(d->vertex);
}

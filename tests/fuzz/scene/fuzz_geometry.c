/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Geometries from bytes: arrays of any stride and any numbers, valid and invalid descriptions. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz/scene/fuzz_model.h"

/* Some are below an element, some no multiples of 4, the last so large that no address space holds two elements. */
static const size_t strides[] = {0,  0,  0,  4, 8,  12,       16,           20,
                                 24, 36, 64, 3, 13, SIZE_MAX, SIZE_MAX - 3, (SIZE_MAX / 2 & ~(size_t)3) - 16};
#define STRIDES (sizeof strides / sizeof strides[0])
#define GOOD_STRIDE_MOST 64u

typedef struct array {
    void *block;
    char *at; /* first element */
    size_t stride;
    bool bad; /* must be refused */
} array;

static size_t step_of(size_t stride, size_t element) { return stride ? stride : element; }

/* An array of count elements of `words` numbers of `number` bytes. An invalid array has one element. */
static array make_array(fuzz_model *m, uint32_t count, uint32_t words, size_t number)
{
    const uint8_t how = fuzz_byte(&m->bytes);
    const size_t element = number * (size_t)words;
    const size_t shift = 4 * (size_t)(how / STRIDES % 3) + (how / STRIDES / 3 == 4); /* some are aligned to nothing */
    array a = {.stride = strides[how % STRIDES]};
    const size_t step = step_of(a.stride, element);
    a.bad = step < element || (step > GOOD_STRIDE_MOST && count > 1) || (step > SIZE_MAX / 2 - element && count > 0);
    const size_t bytes = shift + element + (a.bad || !count ? 0 : step * (count - 1));
    a.block = fuzz_allocate(bytes);
    memset(a.block, 0xff, bytes);
    a.at = (char *)a.block + shift;
    return a;
}

/* Address of number k of element i. */
static char *number_at(const array *a, uint32_t words, size_t number, uint32_t i, uint32_t k)
{
    return a->at + i * step_of(a->stride, number * words) + number * k;
}

/* Floats, or doubles that are floats and half a unit in the last place more. */
static array float_array(fuzz_model *m, uint32_t count, uint32_t words, bool doubles)
{
    const size_t number = doubles ? sizeof(double) : sizeof(float);
    array a = make_array(m, count, words, number);
    for (uint32_t i = 0; i < count && !a.bad; i++)
        for (uint32_t k = 0; k < words; k++) {
            const float value = fuzz_float(&m->bytes);
            const double between = (double)value * (1 + 0x1p-24);
            memcpy(number_at(&a, words, number, i, k), doubles ? (const void *)&between : &value, number);
        }
    return a;
}

/* Whole numbers of 1, 2 or 4 bytes, mostly below a limit. */
static array index_array(fuzz_model *m, uint32_t count, uint32_t words, size_t number, uint32_t limit)
{
    array a = make_array(m, count, words, number);
    for (uint32_t i = 0; i < count && !a.bad; i++)
        for (uint32_t k = 0; k < words; k++) {
            const uint8_t byte = fuzz_byte(&m->bytes);
            const uint32_t index = byte == 255   ? fuzz_word(&m->bytes)
                                   : byte == 254 ? limit
                                                 : byte % (limit ? limit : 1);
            const uint8_t index8 = (uint8_t)index;
            const uint16_t index16 = (uint16_t)index;
            const void *const from = number == 1   ? (const void *)&index8
                                     : number == 2 ? (const void *)&index16
                                                   : &index;
            memcpy(number_at(&a, words, number, i, k), from, number);
        }
    return a;
}

/* As the library sees it, if it is of numbers of a format. */
static cgt_array described(const array *a, cgt_format format) { return (cgt_array){a->at, a->stride, format}; }

/* 0 .. 47, mostly fewer */
static uint32_t small_count(fuzz_model *m)
{
    const uint8_t byte = fuzz_byte(&m->bytes);
    return byte < 224 ? byte % 16 : byte % 48;
}

/* Flaws for which a description must be refused. */
typedef enum flaw { FLAW_NONE, FLAW_NULL, FLAW_FORMAT, FLAW_COUNT } flaw;

static flaw any_flaw(fuzz_model *m)
{
    const uint8_t byte = fuzz_byte(&m->bytes);
    return byte < 250 ? FLAW_NONE : (flaw)(1 + byte % 3);
}

/* The points, with the flaw applied. */
static cgt_array described_points(const array *a, bool doubles, flaw f)
{
    if (f == FLAW_NULL)
        return (cgt_array){NULL, a->stride, CGT_FORMAT_FLOAT};
    return described(a, f == FLAW_FORMAT ? CGT_FORMAT_UINT32 : doubles ? CGT_FORMAT_DOUBLE : CGT_FORMAT_FLOAT);
}

/* Returns false where the origin is to be refused. */
static bool make_origin(fuzz_model *m, uint8_t how, double origin[3])
{
    bool good = true;
    for (int a = 0; a < 3 && how >> 6 == 3; a++) {
        origin[a] = (double)fuzz_float(&m->bytes) / 3;
        good &= isfinite(origin[a]);
    }
    return good;
}

/* Chosen by the bits of a byte that nothing else reads. */
static uint32_t any_mask(uint8_t how)
{
    static const uint32_t masks[] = {0, 0, 1, 2, 3, 0x80000000u, UINT32_MAX, 6};
    return masks[how >> 2 & 7];
}

/* Radii of spheres, or of capsules, which take them from there. Returns true where they must be refused. */
static bool make_radii(fuzz_model *m, fuzz_geometry *g, uint32_t count, uint8_t how, cgt_spheres *s)
{
    if (how % 4 == 0) {
        s->radius = fuzz_float(&m->bytes);
        return !(s->radius >= 0) || !isfinite(s->radius);
    }
    const array radius = float_array(m, count, 1, false);
    bool bad = radius.bad;
    g->block[1] = radius.block;
    s->radii = described(&radius, CGT_FORMAT_FLOAT);
    if (how >> 6 == 1) {
        const array type = index_array(m, count, 1, sizeof(uint8_t), count);
        g->block[2] = type.block;
        s->types = described(&type, CGT_FORMAT_UINT8);
        s->type_count = count;
        bad |= type.bad;
    }
    return bad;
}

/* Returns true where the description must be refused. */
static bool make_spheres(fuzz_model *m, fuzz_geometry *g)
{
    const uint32_t count = small_count(m);
    const flaw f = any_flaw(m);
    const uint8_t how = fuzz_byte(&m->bytes);
    const bool doubles = (how >> 5 & 1) && f != FLAW_NULL; /* without an array they are floats */
    const array center = float_array(m, count, 3, doubles);
    cgt_spheres *s = &g->spheres;
    *g = (fuzz_geometry){.used = true, .block = {center.block}};
    *s = (cgt_spheres){.count = f == FLAW_COUNT ? UINT32_MAX : count};
    s->centers = described_points(&center, doubles, f);
    s->mask = any_mask(how);
    bool bad = (center.bad && f != FLAW_NULL) || f == FLAW_FORMAT || f == FLAW_COUNT || (f == FLAW_NULL && count);
    bad |= !make_origin(m, how, s->origin);
    return make_radii(m, g, count, how, s) || bad;
}

static bool make_triangles(fuzz_model *m, fuzz_geometry *g)
{
    const uint32_t count = small_count(m), vertices = small_count(m);
    const flaw f = any_flaw(m);
    const uint8_t how = fuzz_byte(&m->bytes);
    const bool indexed = how % 4 != 0, doubles = (how >> 5 & 1) && f != FLAW_NULL;
    const array vertex = float_array(m, vertices, 3, doubles);
    cgt_triangles *t = &g->triangles;
    *g = (fuzz_geometry){.used = true, .kind = CGT_KIND_TRIANGLES, .block = {vertex.block}};
    *t = (cgt_triangles){.count = f == FLAW_COUNT ? UINT32_MAX : count, .vertex_count = vertices};
    t->vertices = described_points(&vertex, doubles, f);
    t->mask = any_mask(how);
    bool bad = (vertex.bad && f != FLAW_NULL) || f == FLAW_FORMAT || f == FLAW_COUNT || (f == FLAW_NULL && vertices);
    bad |= !make_origin(m, how, t->origin);
    if (indexed) {
        const bool small = how >> 6 == 1;
        const array index = index_array(m, count, 3, small ? sizeof(uint16_t) : sizeof(uint32_t), vertices);
        g->block[1] = index.block;
        t->indices = described(&index, small ? CGT_FORMAT_UINT16 : CGT_FORMAT_UINT32);
        bad |= index.bad;
    } else {
        bad |= vertices / 3 < count;
    }
    return bad;
}

/* By index, or two vertices each. */
static bool make_capsules(fuzz_model *m, fuzz_geometry *g)
{
    const uint32_t count = small_count(m), vertices = small_count(m);
    const flaw f = any_flaw(m);
    const uint8_t how = fuzz_byte(&m->bytes);
    const bool doubles = (how >> 5 & 1) && f != FLAW_NULL;
    const array vertex = float_array(m, vertices, 3, doubles);
    *g = (fuzz_geometry){.used = true, .kind = CGT_KIND_CAPSULES, .block = {vertex.block}};
    cgt_capsules *q = &g->capsules;
    *q = (cgt_capsules){.count = f == FLAW_COUNT ? UINT32_MAX : count, .vertex_count = vertices};
    q->vertices = described_points(&vertex, doubles, f);
    q->mask = any_mask(how);
    bool bad = (vertex.bad && f != FLAW_NULL) || f == FLAW_FORMAT || f == FLAW_COUNT || (f == FLAW_NULL && vertices);
    bad |= !make_origin(m, how, q->origin);
    bad |= make_radii(m, g, count, how, &g->spheres);
    q->radii = g->spheres.radii;
    q->radius = g->spheres.radius;
    q->types = g->spheres.types;
    q->type_count = g->spheres.type_count;
    if (how % 3 == 0)
        return bad || vertices / 2 < count;
    const array index = index_array(m, count, 2, sizeof(uint32_t), vertices);
    g->block[3] = index.block;
    q->indices = described(&index, CGT_FORMAT_UINT32);
    return bad || index.bad;
}

void fuzz_release_geometry(fuzz_geometry *g)
{
    for (int i = 0; i < 4; i++)
        free(g->block[i]);
    *g = (fuzz_geometry){0};
}

/* ---- elements ---- */

uint32_t fuzz_count(const fuzz_geometry *g)
{
    return g->kind == CGT_KIND_TRIANGLES  ? g->triangles.count
           : g->kind == CGT_KIND_CAPSULES ? g->capsules.count
                                          : g->spheres.count;
}

uint32_t fuzz_mask_of(const fuzz_geometry *g)
{
    const uint32_t mask = g->kind == CGT_KIND_TRIANGLES  ? g->triangles.mask
                          : g->kind == CGT_KIND_CAPSULES ? g->capsules.mask
                                                         : g->spheres.mask;
    return mask ? mask : UINT32_MAX;
}

bool fuzz_has(const fuzz_model *m, cgt_kind kind)
{
    for (uint32_t id = 0; id < FUZZ_GEOMETRIES; id++)
        if (m->geometry[id].used && m->geometry[id].kind == kind && fuzz_count(&m->geometry[id]))
            return true;
    return false;
}

/* The radius of a sphere or, since make_capsules keeps a copy there, of a capsule. */
static float radius_at(const cgt_spheres *s, uint32_t i)
{
    const uint64_t number = s->types.data ? cgt_array_get_whole(&s->types, i, 1, 0) : i;
    return s->radii.data ? (float)cgt_array_get_number(&s->radii, number, 1, 0) : s->radius;
}

/* The vertices of a triangle, or of a capsule. */
static void corners_at(const fuzz_geometry *g, uint32_t i, uint32_t corner[3])
{
    const uint32_t each = g->kind == CGT_KIND_TRIANGLES ? 3 : g->kind == CGT_KIND_CAPSULES ? 2 : 0;
    const cgt_array *indices = each == 3 ? &g->triangles.indices : &g->capsules.indices;
    for (uint32_t k = 0; k < each; k++)
        corner[k] = indices->data ? (uint32_t)cgt_array_get_whole(indices, i, each, k) : each * i + k;
}

/* Centres, or vertices. */
static const cgt_array *points_of(const fuzz_geometry *g)
{
    return g->kind == CGT_KIND_SPHERES     ? &g->spheres.centers
           : g->kind == CGT_KIND_TRIANGLES ? &g->triangles.vertices
                                           : &g->capsules.vertices;
}

/* One of them, as the library takes it. */
static void vertex_at(const fuzz_geometry *g, uint32_t vertex, float point[3])
{
    const double *origin = g->kind == CGT_KIND_SPHERES     ? g->spheres.origin
                           : g->kind == CGT_KIND_TRIANGLES ? g->triangles.origin
                                                           : g->capsules.origin;
    for (uint32_t a = 0; a < 3; a++)
        point[a] = (float)(cgt_array_get_number(points_of(g), vertex, 3, a) - origin[a]);
}

cgt_primitive fuzz_primitive_at(const fuzz_geometry *g, uint32_t i)
{
    cgt_primitive p = {.kind = g->kind};
    uint32_t corner[3];
    float center[3];
    if (g->kind == CGT_KIND_SPHERES) {
        vertex_at(g, i, center);
        p.sphere = (cgt_sphere){center[0], center[1], center[2], radius_at(&g->spheres, i)};
        return p;
    }
    corners_at(g, i, corner);
    if (g->kind == CGT_KIND_CAPSULES) {
        vertex_at(g, corner[0], p.capsule.p);
        vertex_at(g, corner[1], p.capsule.q);
        p.capsule.r = radius_at(&g->spheres, i);
        return p;
    }
    for (uint32_t k = 0; k < 3; k++)
        vertex_at(g, corner[k], p.triangle.v[k]);
    return p;
}

bool fuzz_is_valid(const cgt_primitive *p)
{
    static const uint32_t numbers[] = {4, 9, 7};
    const float *const number = &p->sphere.x;
    for (uint32_t k = 0; k < numbers[p->kind]; k++)
        if (!isfinite(number[k]))
            return false;
    return p->kind == CGT_KIND_TRIANGLES || number[numbers[p->kind] - 1] >= 0;
}

bool fuzz_indices_are_good(const fuzz_geometry *g)
{
    uint32_t corner[3];
    const uint32_t limit = g->kind == CGT_KIND_TRIANGLES ? g->triangles.vertex_count : g->capsules.vertex_count;
    for (uint32_t i = 0; i < fuzz_count(g); i++) {
        if (g->spheres.types.data && cgt_array_get_whole(&g->spheres.types, i, 1, 0) >= g->spheres.type_count)
            return false;
        corners_at(g, i, corner);
        for (int k = 0; k < (g->kind == CGT_KIND_TRIANGLES ? 3 : g->kind == CGT_KIND_CAPSULES ? 2 : 0); k++)
            if (corner[k] >= limit)
                return false;
    }
    return true;
}

/* ---- calls ---- */

static cgt_result call_add(cgt_scene *scene, const fuzz_geometry *g, uint32_t *id)
{
    return g->kind == CGT_KIND_TRIANGLES  ? cgt_scene_set_triangles(scene, id, &g->triangles)
           : g->kind == CGT_KIND_CAPSULES ? cgt_scene_set_capsules(scene, id, &g->capsules)
                                          : cgt_scene_set_spheres(scene, id, &g->spheres);
}

static cgt_result call_update(fuzz_model *m, uint32_t id, const fuzz_geometry *g)
{
    return g->kind == CGT_KIND_TRIANGLES  ? cgt_scene_set_triangles(m->scene, &id, &g->triangles)
           : g->kind == CGT_KIND_CAPSULES ? cgt_scene_set_capsules(m->scene, &id, &g->capsules)
                                          : cgt_scene_set_spheres(m->scene, &id, &g->spheres);
}

static bool make_geometry(fuzz_model *m, fuzz_geometry *g)
{
    const uint8_t byte = fuzz_byte(&m->bytes);
    return byte >= 208 ? make_capsules(m, g) : byte % 2 ? make_triangles(m, g) : make_spheres(m, g);
}

void fuzz_add(fuzz_model *m)
{
    fuzz_geometry g;
    uint32_t lowest = 0, id = CGT_INVALID_ID;
    while (lowest < FUZZ_GEOMETRIES && m->geometry[lowest].used)
        lowest++;
    if (lowest == FUZZ_GEOMETRIES)
        return;
    const bool bad = make_geometry(m, &g);
    cgt_result result = call_add(m->scene, &g, &id);
    if (result == CGT_ERROR_OUT_OF_MEMORY) {
        fuzz_check_error(m, result);
        FUZZ_CHECK(id == CGT_INVALID_ID, "add: an id after an error");
        result = call_add(m->scene, &g, &id);
    }
    FUZZ_CHECK(bad == (result != CGT_OK), "add: %s", cgt_get_result_string(result));
    if (result == CGT_OK) {
        FUZZ_CHECK(id == lowest, "add: id %u, not %u", id, lowest);
        m->geometry[id] = g;
        m->committed = false;
    } else {
        fuzz_check_error(m, result);
        fuzz_release_geometry(&g);
    }
}

/* Replaces a geometry, which need not exist, by one of any kind. The old arrays are freed at once: nothing may read
 * them afterwards. */
void fuzz_update(fuzz_model *m)
{
    fuzz_geometry g;
    const uint32_t id = fuzz_below(&m->bytes, FUZZ_GEOMETRIES);
    fuzz_geometry *const old = &m->geometry[id];
    const bool bad = make_geometry(m, &g) || !old->used || old->kind != g.kind;
    const cgt_result result = call_update(m, id, &g);
    FUZZ_CHECK(bad == (result != CGT_OK), "update: %s", cgt_get_result_string(result));
    if (result == CGT_OK) {
        fuzz_release_geometry(old);
        *old = g;
        m->committed = false;
    } else {
        fuzz_check_error(m, result);
        fuzz_release_geometry(&g);
    }
}

void fuzz_remove(fuzz_model *m)
{
    const uint8_t byte = fuzz_byte(&m->bytes);
    const uint32_t id = byte == 255 ? CGT_INVALID_ID : byte % FUZZ_GEOMETRIES;
    const bool there = id < FUZZ_GEOMETRIES && m->geometry[id].used;
    const cgt_result result = cgt_scene_remove_geometry(m->scene, id);
    FUZZ_CHECK(there == (result == CGT_OK), "remove: %s", cgt_get_result_string(result));
    if (!there) {
        fuzz_check_error(m, result);
        return;
    }
    fuzz_release_geometry(&m->geometry[id]);
    m->committed = false;
}

void fuzz_move(fuzz_model *m)
{
    fuzz_geometry *const g = &m->geometry[fuzz_below(&m->bytes, FUZZ_GEOMETRIES)];
    const cgt_array *points = points_of(g);
    const uint32_t count = g->kind == CGT_KIND_SPHERES     ? g->spheres.count
                           : g->kind == CGT_KIND_TRIANGLES ? g->triangles.vertex_count
                                                           : g->capsules.vertex_count;
    if (!g->used || !count)
        return;
    const bool doubles = points->format == CGT_FORMAT_DOUBLE;
    const array p = {.at = (char *)(uintptr_t)points->data, .stride = points->stride};
    const uint32_t i = fuzz_below(&m->bytes, count), k = fuzz_below(&m->bytes, 3);
    const float value = fuzz_float(&m->bytes);
    const double wide = (double)value;
    memcpy(number_at(&p, 3, cgt_format_get_size(points->format), i, k), doubles ? (const void *)&wide : &value,
           cgt_format_get_size(points->format));
    fuzz_commit(m);
}

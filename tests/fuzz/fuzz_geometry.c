/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Geometries from bytes: arrays of any stride and any numbers, valid and invalid descriptions. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz/fuzz_model.h"

/* The last five are no multiples of 4, or so large that no address space holds two elements. */
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

/* An array of count elements of `words` numbers. An invalid array has one element. */
static array make_array(fuzz_model *m, uint32_t count, uint32_t words)
{
    const uint8_t how = fuzz_byte(&m->bytes);
    const size_t element = 4 * (size_t)words, shift = 4 * (size_t)(how / STRIDES % 3);
    array a = {.stride = strides[how % STRIDES]};
    const size_t step = step_of(a.stride, element);
    a.bad = step % 4 || (step > GOOD_STRIDE_MOST && count > 1) || (step > SIZE_MAX / 2 - element && count > 0);
    const size_t bytes = shift + element + (a.bad || !count ? 0 : step * (count - 1));
    a.block = fuzz_allocate(bytes);
    memset(a.block, 0xff, bytes);
    a.at = (char *)a.block + shift;
    return a;
}

/* Address of word k of element i. */
static char *word_at(const array *a, uint32_t words, uint32_t i, uint32_t k)
{
    return a->at + i * step_of(a->stride, 4 * (size_t)words) + 4 * (size_t)k;
}

static array float_array(fuzz_model *m, uint32_t count, uint32_t words)
{
    array a = make_array(m, count, words);
    for (uint32_t i = 0; i < count && !a.bad; i++)
        for (uint32_t k = 0; k < words; k++) {
            const float value = fuzz_float(&m->bytes);
            memcpy(word_at(&a, words, i, k), &value, sizeof value);
        }
    return a;
}

static array index_array(fuzz_model *m, uint32_t count, uint32_t vertices)
{
    array a = make_array(m, count, 3);
    for (uint32_t i = 0; i < count && !a.bad; i++)
        for (uint32_t k = 0; k < 3; k++) {
            const uint8_t byte = fuzz_byte(&m->bytes);
            const uint32_t index = byte == 255   ? fuzz_word(&m->bytes)
                                   : byte == 254 ? vertices
                                                 : byte % (vertices ? vertices : 1);
            memcpy(word_at(&a, 3, i, k), &index, sizeof index);
        }
    return a;
}

/* 0 .. 47, mostly fewer */
static uint32_t small_count(fuzz_model *m)
{
    const uint8_t byte = fuzz_byte(&m->bytes);
    return byte < 224 ? byte % 16 : byte % 48;
}

/* Flaws for which a description must be refused. */
typedef enum flaw { FLAW_NONE, FLAW_NULL, FLAW_MISALIGNED, FLAW_COUNT } flaw;

static flaw any_flaw(fuzz_model *m)
{
    const uint8_t byte = fuzz_byte(&m->bytes);
    return byte < 250 ? FLAW_NONE : (flaw)(1 + byte % 3);
}

/* A pointer with the flaw applied. */
static void *flawed(void *at, flaw f) { return f == FLAW_NULL ? NULL : f == FLAW_MISALIGNED ? (char *)at + 1 : at; }

/* Chosen by the bits of a byte that nothing else reads. */
static uint32_t any_mask(uint8_t how)
{
    static const uint32_t masks[] = {0, 0, 1, 2, 3, 0x80000000u, UINT32_MAX, 6};
    return masks[how >> 2 & 7];
}

/* Returns true where the description must be refused. */
static bool make_spheres(fuzz_model *m, fuzz_geometry *g)
{
    const uint32_t count = small_count(m);
    const flaw f = any_flaw(m);
    const uint8_t how = fuzz_byte(&m->bytes);
    const bool radii = how % 4 != 0;
    const array center = float_array(m, count, 3);
    cgt_spheres *s = &g->spheres;
    *g = (fuzz_geometry){.used = true, .block = {center.block}};
    *s = (cgt_spheres){.count = f == FLAW_COUNT ? UINT32_MAX : count, .center_stride = center.stride};
    s->centers = flawed(center.at, f);
    s->mask = any_mask(how);
    bool bad = center.bad || f == FLAW_MISALIGNED || f == FLAW_COUNT || (f == FLAW_NULL && count);
    if (radii) {
        const array radius = float_array(m, count, 1);
        g->block[1] = radius.block;
        s->radii = (const float *)(const void *)radius.at;
        s->radius_stride = radius.stride;
        bad |= radius.bad;
    } else {
        s->radius = fuzz_float(&m->bytes);
        bad |= !(s->radius >= 0) || !isfinite(s->radius);
    }
    return bad;
}

static bool make_triangles(fuzz_model *m, fuzz_geometry *g)
{
    const uint32_t count = small_count(m), vertices = small_count(m);
    const flaw f = any_flaw(m);
    const uint8_t how = fuzz_byte(&m->bytes);
    const bool indexed = how % 4 != 0;
    const array vertex = float_array(m, vertices, 3);
    cgt_triangles *t = &g->triangles;
    *g = (fuzz_geometry){.used = true, .triangular = true, .block = {vertex.block}};
    *t = (cgt_triangles){.count = f == FLAW_COUNT ? UINT32_MAX : count, .vertex_count = vertices};
    t->vertex_stride = vertex.stride;
    t->vertices = flawed(vertex.at, f);
    t->mask = any_mask(how);
    bool bad = vertex.bad || f == FLAW_MISALIGNED || f == FLAW_COUNT || (f == FLAW_NULL && vertices);
    if (indexed) {
        const array index = index_array(m, count, vertices);
        g->block[1] = index.block;
        t->indices = (const uint32_t *)(const void *)index.at;
        t->index_stride = index.stride;
        bad |= index.bad;
    } else {
        bad |= vertices / 3 < count;
    }
    return bad;
}

void fuzz_release_geometry(fuzz_geometry *g)
{
    free(g->block[0]);
    free(g->block[1]);
    *g = (fuzz_geometry){0};
}

/* ---- elements ---- */

uint32_t fuzz_count(const fuzz_geometry *g) { return g->triangular ? g->triangles.count : g->spheres.count; }

void fuzz_sphere_at(const fuzz_geometry *g, uint32_t i, float sphere[4])
{
    const cgt_spheres *s = &g->spheres;
    memcpy(sphere, (const char *)s->centers + i * step_of(s->center_stride, 12), 12);
    sphere[3] = s->radius;
    if (s->radii)
        memcpy(&sphere[3], (const char *)s->radii + i * step_of(s->radius_stride, 4), 4);
}

static void corners_at(const cgt_triangles *t, uint32_t i, uint32_t corner[3])
{
    for (uint32_t k = 0; k < 3; k++)
        corner[k] = 3 * i + k;
    if (t->indices)
        memcpy(corner, (const char *)t->indices + i * step_of(t->index_stride, 12), 12);
}

void fuzz_triangle_at(const fuzz_geometry *g, uint32_t i, float vertex[3][3])
{
    const cgt_triangles *t = &g->triangles;
    uint32_t corner[3];
    corners_at(t, i, corner);
    for (int k = 0; k < 3; k++)
        memcpy(vertex[k], (const char *)t->vertices + corner[k] * step_of(t->vertex_stride, 12), 12);
}

bool fuzz_indices_are_good(const fuzz_geometry *g)
{
    uint32_t corner[3];
    for (uint32_t i = 0; g->triangular && i < g->triangles.count; i++) {
        corners_at(&g->triangles, i, corner);
        for (int k = 0; k < 3; k++)
            if (corner[k] >= g->triangles.vertex_count)
                return false;
    }
    return true;
}

/* ---- calls ---- */

static cgt_result call_add(fuzz_model *m, const fuzz_geometry *g, uint32_t *id)
{
    return g->triangular ? cgt_scene_add_triangles(m->scene, &g->triangles, id)
                         : cgt_scene_add_spheres(m->scene, &g->spheres, id);
}

static cgt_result call_update(fuzz_model *m, uint32_t id, const fuzz_geometry *g)
{
    return g->triangular ? cgt_scene_update_triangles(m->scene, id, &g->triangles)
                         : cgt_scene_update_spheres(m->scene, id, &g->spheres);
}

static bool make_geometry(fuzz_model *m, fuzz_geometry *g)
{
    return fuzz_below(&m->bytes, 2) ? make_triangles(m, g) : make_spheres(m, g);
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
    cgt_result result = call_add(m, &g, &id);
    if (result == CGT_ERROR_OUT_OF_MEMORY) {
        fuzz_check_error(m, result);
        FUZZ_CHECK(id == CGT_INVALID_ID, "add: an id after an error");
        result = call_add(m, &g, &id);
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

/* Replaces a geometry, which need not exist, by one of either kind. The old arrays are freed at once: nothing may read
 * them afterwards. */
void fuzz_update(fuzz_model *m)
{
    fuzz_geometry g;
    const uint32_t id = fuzz_below(&m->bytes, FUZZ_GEOMETRIES);
    fuzz_geometry *const old = &m->geometry[id];
    const bool bad = make_geometry(m, &g) || !old->used || old->triangular != g.triangular;
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
    const uint32_t points = g->triangular ? g->triangles.vertex_count : g->spheres.count;
    if (!g->used || !points)
        return;
    const size_t step = step_of(g->triangular ? g->triangles.vertex_stride : g->spheres.center_stride, 12);
    const uint32_t i = fuzz_below(&m->bytes, points), k = fuzz_below(&m->bytes, 3);
    const float value = fuzz_float(&m->bytes);
    const size_t offset =
        (size_t)((const char *)(g->triangular ? g->triangles.vertices : g->spheres.centers) - (char *)g->block[0]);
    memcpy((char *)g->block[0] + offset + i * step + 4 * (size_t)k, &value, sizeof value);
    fuzz_commit(m);
}

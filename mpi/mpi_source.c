/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a rank brings: its arrays, as cgt.h and picture.h describe them, element by element as columns of floats. */
#include <math.h>
#include <string.h>

#include "mpi_job.h"

/* ---- Reading ------------------------------------------------------------------------------------------------- */

/* origin: three numbers. */
static void write_point(const cgt_array *points, const double *origin, size_t i, char *to)
{
    float point[3];
    for (size_t c = 0; c < 3; c++)
        point[c] = (float)(cgt_array_get_number(points, i, 3, c) - origin[c]);
    memcpy(to, point, sizeof point);
}

/* The radii of spheres and capsules. */
typedef struct mpi_radii {
    cgt_array radii, types;
    float radius;
    uint32_t type_count;
} mpi_radii;

#define RADII_OF(s)                                                                                                    \
    {                                                                                                                  \
        (s)->radii, (s)->types, (s)->radius, (s)->type_count                                                           \
    }

static mpi_radii radii_of(const cgt_mpi_geometry *g)
{
    if (g->spheres)
        return (mpi_radii)RADII_OF(g->spheres);
    if (g->capsules)
        return (mpi_radii)RADII_OF(g->capsules);
    return (mpi_radii){.radius = 0.0f}; /* analysers do not know that there is one of them */
}

static void write_radius(const mpi_radii *r, uint32_t i, char *to)
{
    const uint64_t number = r->types.data ? cgt_array_get_whole(&r->types, i, 1, 0) : i;
    const float radius = r->radii.data ? (float)cgt_array_get_number(&r->radii, number, 1, 0) : r->radius;
    memcpy(to, &radius, sizeof radius);
}

/* Vertex k of primitive i, of `corners` vertices. */
static uint64_t read_index(const cgt_array *indices, size_t corners, size_t i, size_t k)
{
    return indices->data ? cgt_array_get_whole(indices, i, corners, k) : corners * i + k;
}

static uint64_t triangle_vertex(const cgt_triangles *t, size_t i, size_t k) { return read_index(&t->indices, 3, i, k); }

static uint64_t capsule_vertex(const cgt_capsules *c, size_t i, size_t k)
{
    return c->ends.data ? i : read_index(&c->indices, 2, i, k);
}

/* ---- What there is ------------------------------------------------------------------------------------------- */

mpi_kind cgt_mpi_kind_of(const cgt_mpi_geometry *g)
{
    return g->spheres ? KIND_SPHERES : g->triangles ? KIND_TRIANGLES : KIND_CAPSULES;
}

uint32_t cgt_mpi_primitives_of(const cgt_mpi_geometry *g)
{
    return g->spheres ? g->spheres->count : g->triangles ? g->triangles->count : g->capsules ? g->capsules->count : 0;
}

uint32_t cgt_mpi_vertices_of(const cgt_mpi_geometry *g) { return g->triangles ? g->triangles->vertex_count : 0; }

const cgt_look *cgt_mpi_look_of(const cgt_mpi_geometry *g)
{
    static const cgt_look none = {.color = {0}};
    return g->look ? g->look : &none;
}

unsigned cgt_mpi_parts_of(const cgt_mpi_geometry *g)
{
    const cgt_look *const l = cgt_mpi_look_of(g);
    return (g->ids ? PART_IDS : 0u) |
           (l->index    ? PART_INDEX
            : l->colors ? PART_COLORS
                        : 0u) |
           (l->materials ? PART_MATERIALS : 0u) | (l->bodies ? PART_BODIES : 0u) |
           (l->vertex_normals && g->triangles ? PART_NORMALS : 0u);
}

/* FNV-1a, of words. */
static uint64_t add_word(uint64_t hash, uint32_t word) { return (hash ^ word) * 0x100000001b3u; }

uint64_t cgt_mpi_settings_of(const cgt_mpi_geometry *g)
{
    const cgt_look *const l = cgt_mpi_look_of(g);
    const uint32_t mask = g->spheres ? g->spheres->mask : g->triangles ? g->triangles->mask : g->capsules->mask;
    const uint32_t words[] = {
        (uint32_t)cgt_mpi_kind_of(g), mask,          l->palette_steps, l->lineless_from, l->material,
        l->palette != NULL,           l->per_vertex, l->halves,        l->sheet};
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        hash = add_word(hash, words[i]);
    for (int c = 0; c < 3; c++) {
        uint32_t word;
        memcpy(&word, &l->color[c], sizeof word);
        hash = add_word(hash, word);
    }
    return hash;
}

/* ---- Checks -------------------------------------------------------------------------------------------------- */

static cgt_result check_types(cgt_mpi *m, uint32_t geometry, const mpi_radii *r, uint32_t count)
{
    for (uint32_t i = 0; i < count && r->types.data; i++) {
        const uint64_t type = cgt_array_get_whole(&r->types, i, 1, 0);
        if (type >= r->type_count)
            return cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT, "geometry %u: type %llu of primitive %u: there are %u",
                                geometry, (unsigned long long)type, i, r->type_count);
    }
    return CGT_OK;
}

cgt_result cgt_mpi_check_elements(cgt_mpi *m, uint32_t geometry, const cgt_mpi_geometry *g)
{
    const cgt_triangles *const t = g->triangles;
    const cgt_capsules *const c = g->capsules;
    const uint32_t corners = t ? 3 : c ? 2 : 0, vertices = t ? t->vertex_count : c ? c->vertex_count : 0;
    const uint32_t count = cgt_mpi_primitives_of(g);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < corners; k++) {
            const uint64_t index = t ? triangle_vertex(t, i, k) : capsule_vertex(c, i, k);
            if (index >= vertices)
                return cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT,
                                    "geometry %u: vertex %llu of primitive %u: there are %u", geometry,
                                    (unsigned long long)index, i, vertices);
        }
    if (t)
        return CGT_OK;
    const mpi_radii radii = radii_of(g);
    return check_types(m, geometry, &radii, count);
}

/* ---- Columns ------------------------------------------------------------------------------------------------- */

static void add_column(mpi_table *t, size_t bytes) { t->bytes[t->columns++] = bytes; }

/* The look's columns that belong to the table, in the order of cgt_mpi_pack. */
static unsigned parts_in(const mpi_source *s)
{
    const unsigned with_vertices = cgt_mpi_look_of(s->geometry)->per_vertex ? PART_COLORS | PART_INDEX : 0u;
    return s->parts & (s->vertices ? with_vertices | PART_NORMALS : ~(with_vertices | PART_NORMALS));
}

/* Elements that a colour or an index has for a primitive. */
static size_t ends_of(const mpi_source *s) { return cgt_mpi_look_of(s->geometry)->halves ? 2 : 1; }

void cgt_mpi_set_columns(const mpi_source *s, mpi_table *t)
{
    const unsigned parts = parts_in(s);
    t->columns = 0;
    if (s->vertices || s->kind == KIND_TRIANGLES)
        add_column(t, 3 * sizeof(float)); /* a place, or three indices */
    else if (s->kind == KIND_SPHERES)
        add_column(t, 4 * sizeof(float)); /* centre and radius */
    else {
        add_column(t, 6 * sizeof(float));
        add_column(t, sizeof(float));
    }
    if (parts & PART_NORMALS)
        add_column(t, 3 * sizeof(float));
    if (parts & PART_COLORS)
        add_column(t, ends_of(s) * 3 * sizeof(float));
    if (parts & PART_INDEX)
        add_column(t, ends_of(s) * sizeof(uint16_t));
    if (parts & PART_MATERIALS)
        add_column(t, 1);
    if (parts & PART_BODIES)
        add_column(t, sizeof(uint32_t));
}

static char *pack_shape(const mpi_source *s, uint32_t i, char *to)
{
    const cgt_mpi_geometry *const g = s->geometry;
    if (s->vertices) {
        const cgt_triangles *const t = g->triangles;
        write_point(&t->vertices, t->origin, i, to);
        return to + 3 * sizeof(float);
    }
    if (s->kind == KIND_TRIANGLES) {
        uint32_t index[3];
        for (size_t k = 0; k < 3; k++)
            index[k] = s->first_vertex + (uint32_t)triangle_vertex(g->triangles, i, k);
        memcpy(to, index, sizeof index);
        return to + sizeof index;
    }
    const mpi_radii radii = radii_of(g);
    if (s->kind == KIND_SPHERES) {
        const cgt_spheres *const p = g->spheres;
        write_point(&p->centers, p->origin, i, to);
        write_radius(&radii, i, to + 3 * sizeof(float));
        return to + 4 * sizeof(float);
    }
    const cgt_capsules *const c = g->capsules;
    write_point(&c->vertices, c->origin, capsule_vertex(c, i, 0), to);
    write_point(c->ends.data ? &c->ends : &c->vertices, c->origin, capsule_vertex(c, i, 1), to + 3 * sizeof(float));
    write_radius(&radii, i, to + 6 * sizeof(float));
    return to + 7 * sizeof(float);
}

static char *pack_array(const void *array, size_t bytes, uint32_t i, char *to)
{
    if (array) /* which it is; analysers do not know what parts tell */
        memcpy(to, (const char *)array + i * bytes, bytes);
    return to + bytes;
}

void cgt_mpi_pack(const mpi_source *s, uint32_t i, char *to)
{
    const cgt_look *const l = cgt_mpi_look_of(s->geometry);
    const unsigned parts = parts_in(s);
    to = pack_shape(s, i, to);
    if (parts & PART_NORMALS)
        to = pack_array(l->vertex_normals, 3 * sizeof(float), i, to);
    if (parts & PART_COLORS)
        to = pack_array(l->colors, ends_of(s) * 3 * sizeof(float), i, to);
    if (parts & PART_INDEX)
        to = pack_array(l->index, ends_of(s) * sizeof(uint16_t), i, to);
    if (parts & PART_MATERIALS)
        to = pack_array(l->materials, 1, i, to);
    if (parts & PART_BODIES)
        pack_array(l->bodies, sizeof(uint32_t), i, to);
}

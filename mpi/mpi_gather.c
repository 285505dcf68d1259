/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All geometries of all ranks on every machine, and the scenes of leaders over them. Primitives lie in the order of
 * their ids, since of equally near ones the first in its geometry is hit. */
#include <fenv.h>
#include <stdlib.h>

#include "mpi_job.h"
#include "mpi_processors.h"

enum { ROOM_OF_IDS = 1 << 20 }; /* with 4 times the primitives: more is a mistake, and would fill the memory */

/* What all ranks say of a geometry. */
typedef struct mpi_totals {
    uint64_t primitives, vertices;
    uint64_t first, first_vertex; /* of this rank */
    uint64_t numbers;             /* 1 + the highest id */
    unsigned parts;
} mpi_totals;

/* ---- Checks on each rank ------------------------------------------------------------------------------------- */

/* Of looks, which tell how their arrays are packed; cgt_mpi_draw checks the rest. */
static cgt_result check_look(cgt_mpi *m, uint32_t i, const cgt_mpi_geometry *g)
{
    const cgt_look *const l = cgt_mpi_look_of(g);
    if (l->halves && !g->capsules)
        return cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT, "geometry %u: a look's halves are for capsules", i);
    if ((l->per_vertex || l->vertex_normals) && !g->triangles)
        return cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT,
                            "geometry %u: a look's per_vertex and vertex_normals are for triangles", i);
    return CGT_OK;
}

/* The library's own checks, by adding the geometry to a scene that is never committed. */
static cgt_result check_arrays(cgt_mpi *m, cgt_scene *scene, uint32_t i, const cgt_mpi_geometry *g)
{
    if (!g->spheres + !g->triangles + !g->capsules != 2)
        return cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT, "geometry %u: either spheres or triangles or capsules", i);
    const cgt_result result = g->spheres     ? cgt_scene_set_spheres(scene, NULL, g->spheres)
                              : g->triangles ? cgt_scene_set_triangles(scene, NULL, g->triangles)
                                             : cgt_scene_set_capsules(scene, NULL, g->capsules);
    if (result != CGT_OK)
        return cgt_mpi_fail_context(m, result);
    const cgt_result looks = check_look(m, i, g);
    return looks == CGT_OK ? cgt_mpi_check_elements(m, i, g) : looks;
}

static cgt_result check_geometries(cgt_mpi *m, const cgt_mpi_geometry *geometries, uint32_t count)
{
    cgt_scene *scene = NULL;
    if (count && !geometries)
        return cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT, "geometries are NULL, and there are %u", count);
    cgt_result result = cgt_scene_create(m->context, NULL, &scene);
    if (result != CGT_OK)
        return cgt_mpi_fail_context(m, result);
    for (uint32_t i = 0; i < count && result == CGT_OK; i++)
        result = check_arrays(m, scene, i, &geometries[i]);
    cgt_scene_release(scene);
    return result;
}

/* ---- What all ranks have together ---------------------------------------------------------------------------- */

/* The smallest and the largest of all ranks' values. */
static void find_range(const cgt_mpi *m, uint64_t value, bool counts, uint64_t range[2])
{
    const uint64_t own[2] = {counts ? value : UINT64_MAX, counts ? ~value : UINT64_MAX};
    MPI_Allreduce(own, range, 2, MPI_UINT64_T, MPI_MIN, m->ranks);
    range[1] = ~range[1];
}

static cgt_result check_same_count(cgt_mpi *m, uint32_t count)
{
    uint64_t range[2];
    find_range(m, count, true, range);
    return range[0] == range[1] ? CGT_OK
                                : cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT, "ranks have from %u to %u geometries",
                                               (unsigned)range[0], (unsigned)range[1]);
}

static uint64_t numbers_of(const cgt_mpi_geometry *g)
{
    const uint32_t count = cgt_mpi_primitives_of(g);
    uint64_t numbers = 0;
    for (uint32_t i = 0; i < count && g->ids; i++)
        numbers = g->ids[i] >= numbers ? (uint64_t)g->ids[i] + 1 : numbers;
    return numbers;
}

/* Collective. Ids that are out of range fail on the ranks that have them alone. */
static cgt_result find_totals(cgt_mpi *m, uint32_t i, const cgt_mpi_geometry *g, mpi_totals *totals)
{
    const uint64_t own[2] = {cgt_mpi_primitives_of(g), cgt_mpi_vertices_of(g)}, numbers = numbers_of(g);
    uint64_t sum[2], before[2] = {0, 0}, settings[2], parts[2];
    MPI_Allreduce(own, sum, 2, MPI_UINT64_T, MPI_SUM, m->ranks);
    MPI_Exscan(own, before, 2, MPI_UINT64_T, MPI_SUM, m->ranks);
    MPI_Allreduce(&numbers, &totals->numbers, 1, MPI_UINT64_T, MPI_MAX, m->ranks);
    find_range(m, cgt_mpi_settings_of(g), true, settings);
    find_range(m, cgt_mpi_parts_of(g), own[0] > 0, parts);
    totals->primitives = sum[0];
    totals->vertices = sum[1];
    totals->first = m->rank ? before[0] : 0; /* which rank 0 does not get */
    totals->first_vertex = m->rank ? before[1] : 0;
    totals->parts = sum[0] ? (unsigned)parts[0] : 0;
    if (settings[0] != settings[1] || (sum[0] && parts[0] != parts[1]))
        return cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT,
                            "geometry %u: ranks differ in its kind, its look or its mask, or in "
                            "which arrays it has",
                            i);
    const uint64_t room = ROOM_OF_IDS + 4 * sum[0];
    if (!(totals->parts & PART_IDS))
        totals->numbers = sum[0];
    else if (totals->numbers > room) /* told by the ranks that have them */
        return numbers <= room ? CGT_OK
                               : cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT,
                                              "geometry %u: ids up to %llu, and %llu primitives: each number takes "
                                              "memory, so that ids are at most 4 times as many, and 1,048,576",
                                              i, (unsigned long long)numbers - 1, (unsigned long long)sum[0]);
    if (totals->numbers >= UINT32_MAX || sum[1] >= UINT32_MAX)
        return cgt_mpi_fail(m, CGT_ERROR_TOO_LARGE, "geometry %u: %llu numbers and %llu vertices: each below 2^32 - 1",
                            i, (unsigned long long)totals->numbers, (unsigned long long)sum[1]);
    return CGT_OK;
}

/* Collective: the tables of a geometry. */
static cgt_result gather_tables(cgt_mpi *m, uint32_t i, const cgt_mpi_geometry *g)
{
    mpi_geometry *const to = &m->geometry[i];
    mpi_totals totals;
    cgt_result result = cgt_mpi_agree(m, find_totals(m, i, g, &totals));
    if (result != CGT_OK)
        return result;
    to->kind = cgt_mpi_kind_of(g);
    to->parts = totals.parts;
    mpi_source s = {.geometry = g,
                    .kind = to->kind,
                    .parts = totals.parts,
                    .count = cgt_mpi_primitives_of(g),
                    .ids = totals.parts & PART_IDS ? g->ids : NULL,
                    .first = (uint32_t)totals.first,
                    .first_vertex = (uint32_t)totals.first_vertex};
    /* A number without a primitive: no place, or a triangle without area. */
    result = cgt_mpi_table_gather(m, i, &to->primitives, &s, (uint32_t)totals.numbers,
                                  to->kind == KIND_TRIANGLES ? 0x00 : 0xff);
    if (result != CGT_OK || to->kind != KIND_TRIANGLES)
        return result;
    s.vertices = true;
    s.count = cgt_mpi_vertices_of(g);
    s.ids = NULL;
    s.first = s.first_vertex;
    return cgt_mpi_table_gather(m, i, &to->vertices, &s, (uint32_t)totals.vertices, 0);
}

/* ---- The scene of a leader ----------------------------------------------------------------------------------- */

static const float *floats(const char *at) { return (const float *)(const void *)at; }

/* Describes the tables as the scene and looks have them. */
static void describe(const cgt_mpi_geometry *g, mpi_geometry *to, cgt_look *look)
{
    const mpi_table *const p = &to->primitives, *const v = &to->vertices;
    const cgt_look *const given = cgt_mpi_look_of(g);
    const mpi_table *const colored = given->per_vertex ? v : p;
    uint32_t next = to->kind == KIND_CAPSULES ? 2 : 1, next_vertex = 1; /* columns, as cgt_mpi_set_columns has them */
    uint32_t *const next_color = given->per_vertex ? &next_vertex : &next;
    *look = *given;
    look->colors = NULL;
    look->index = NULL;
    look->ids = look->bodies = NULL;
    look->materials = NULL;
    look->vertex_normals = to->parts & PART_NORMALS ? floats(v->column[next_vertex++]) : NULL;
    if (to->parts & PART_COLORS)
        look->colors = floats(colored->column[(*next_color)++]);
    if (to->parts & PART_INDEX)
        look->index = (const uint16_t *)(const void *)colored->column[(*next_color)++];
    if (to->parts & PART_MATERIALS)
        look->materials = (const uint8_t *)p->column[next++];
    if (to->parts & PART_BODIES)
        look->bodies = (const uint32_t *)(const void *)p->column[next];
    look->per_vertex = given->per_vertex && (look->colors || look->index);
    if (to->kind == KIND_SPHERES)
        to->spheres = (cgt_spheres){.count = p->slots,
                                    .centers = cgt_floats(floats(p->column[0]), p->bytes[0]),
                                    .radii = cgt_floats(floats(p->column[0]) + 3, p->bytes[0]),
                                    .mask = g->spheres->mask};
    else if (to->kind == KIND_TRIANGLES)
        to->triangles = (cgt_triangles){.count = p->slots,
                                        .indices = cgt_uint32s((const uint32_t *)(const void *)p->column[0], 0),
                                        .vertex_count = v->slots,
                                        .vertices = cgt_floats(v->slots ? floats(v->column[0]) : NULL, 0),
                                        .mask = g->triangles->mask};
    else
        to->capsules = (cgt_capsules){.count = p->slots,
                                      .vertex_count = 2 * p->slots,
                                      .vertices = cgt_floats(p->slots ? floats(p->column[0]) : NULL, 0),
                                      .radii = cgt_floats(floats(p->column[1]), 0),
                                      .mask = g->capsules->mask};
}

static cgt_result add(cgt_scene *scene, const mpi_geometry *g)
{
    return g->kind == KIND_SPHERES     ? cgt_scene_set_spheres(scene, NULL, &g->spheres)
           : g->kind == KIND_TRIANGLES ? cgt_scene_set_triangles(scene, NULL, &g->triangles)
                                       : cgt_scene_set_capsules(scene, NULL, &g->capsules);
}

/* The scene keeps its memory from one commit to the next; geometries come and go. */
static cgt_result commit(cgt_mpi *m, const cgt_mpi_geometry *geometries, uint32_t count)
{
    cgt_result result = m->scene ? CGT_OK : cgt_scene_create(m->context, NULL, &m->scene);
    for (uint32_t i = 0; i < m->in_scene; i++)
        cgt_scene_remove_geometry(m->scene, i);
    m->in_scene = 0;
    for (uint32_t i = 0; i < count && result == CGT_OK; i++) {
        describe(&geometries[i], &m->geometry[i], &m->looks[i]);
        result = add(m->scene, &m->geometry[i]);
        m->in_scene += result == CGT_OK;
    }
    if (result == CGT_OK)
        result = cgt_scene_commit(m->scene);
    return result == CGT_OK ? result : cgt_mpi_fail_context(m, result);
}

/* ---- The call ------------------------------------------------------------------------------------------------ */

static cgt_result make_room(cgt_mpi *m, uint32_t count)
{
    if (count <= m->room)
        return CGT_OK;
    mpi_geometry *const more = realloc(m->geometry, count * sizeof *more);
    if (more)
        m->geometry = more;
    cgt_look *const looks = more ? realloc(m->looks, count * sizeof *looks) : NULL;
    if (!looks)
        return cgt_mpi_fail(m, CGT_ERROR_OUT_OF_MEMORY, "out of memory for %u geometries", count);
    m->looks = looks;
    for (; m->room < count; m->room++) {
        m->geometry[m->room] = (mpi_geometry){.kind = KIND_SPHERES};
        m->geometry[m->room].primitives.memory.window = m->geometry[m->room].vertices.memory.window = MPI_WIN_NULL;
    }
    return CGT_OK;
}

static cgt_result gather(cgt_mpi *m, const cgt_mpi_geometry *geometries, uint32_t count)
{
    cgt_result result = check_geometries(m, geometries, count);
    if (result == CGT_OK)
        result = make_room(m, count);
    result = cgt_mpi_agree(m, result);
    if (result == CGT_OK)
        result = cgt_mpi_agree(m, check_same_count(m, count));
    for (uint32_t i = 0; i < count && result == CGT_OK; i++)
        result = gather_tables(m, i, &geometries[i]);
    if (result != CGT_OK)
        return result;
    cgt_mpi_memory_fence(m);
    if (m->leaders != MPI_COMM_NULL) {
        cgt_mpi_take_processors(m);
        result = commit(m, geometries, count);
        cgt_mpi_return_processors(m);
    }
    return cgt_mpi_agree(m, result);
}

cgt_result cgt_mpi_gather(cgt_mpi *m, const cgt_mpi_geometry *geometries, uint32_t count)
{
    fenv_t callers;
    if (!m || m->failed)
        return CGT_ERROR_INVALID_ARGUMENT;
    fegetenv(&callers); /* doubles are rounded to nearest, denormals stay */
    fesetenv(FE_DFL_ENV);
    m->committed = false;
    const cgt_result result = gather(m, geometries, count);
    fesetenv(&callers);
    m->committed = result == CGT_OK;
    m->count = count;
    return result;
}

const cgt_scene *cgt_mpi_get_scene(const cgt_mpi *m) { return m && m->committed ? m->scene : NULL; }

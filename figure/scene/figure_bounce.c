/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Mirrors and glass; see figure_state.h.*/
#include "figure_state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { OPAQUE, GLASS, KINDS, MOST_MATERIALS = 256 };

/* Spheres of a kind, in arrays that are kept from frame to frame. */
typedef struct sphere_list {
    uint32_t count, capacity;
    float *xyzr;
    uint16_t *entry; /* of the palette */
    uint8_t *material;
    uint32_t *place; /* among all that is drawn of the file */
} sphere_list;

struct figure_bounce {
    cgt_material material[MOST_MATERIALS]; /* 0 is matt */
    uint32_t materials;
    uint8_t material_of[BOUNCE_MATERIALS][COLORING_ENTRIES]; /* by rule and colour; 0: none yet */
    uint32_t last_step; /* of the colours of a range, which are more than materials; 0: each has a material */
    sphere_list list[KINDS];
    cgt_triangles floor;
    const uint16_t *triangle_entry;
    int per_vertex;
    uint32_t *body;     /* of the triangles, where they are glass; then their corners, for which that was found */
    uint32_t bodies_of; /* so many triangles */
    uint32_t looks, geometries, id[FIGURE_LOOKS];
    cgt_look look[FIGURE_LOOKS];
    float floor_color[2 * FLOOR_CHEQUERS * FLOOR_CHEQUERS][3];
    const float (*palette)[3];
};

/* ---- Materials ---------------------------------------------------------------------------------------------- */

/* The colour of a range's nearest step; of other entries their own. */
static uint32_t nearest_step(const figure_bounce *b, uint32_t entry)
{
    const uint32_t last = b->last_step, most = COLORING_STEPS - 1;
    if (!last || entry > most)
        return entry;
    const uint32_t step = (entry * last + most / 2) / most;
    return (step * most + last / 2) / last;
}

/* The material of a rule in a colour. Glass of radius r is as dark as its colour along r. */
static uint8_t material_of(figure_bounce *b, const bounce_options *o, int rule, uint32_t entry, float radius)
{
    if (rule < 0 || o->materials[rule].material == CGT_MATERIAL_MATTE)
        return 0;
    entry = nearest_step(b, entry);
    uint8_t *known = &b->material_of[rule][entry];
    if (*known)
        return *known;
    if (b->materials == MOST_MATERIALS) /* so many colours: the last one will do */
        return *known = MOST_MATERIALS - 1;
    cgt_material *m = &b->material[b->materials];
    *m = (cgt_material){.kind = o->materials[rule].material,
                        .index = o->materials[rule].index,
                        .priority = (uint8_t)o->materials[rule].priority,
                        .gloss = 300.0f};
    for (int c = 0; c < 3; c++) {
        const float color = fminf(fmaxf(b->palette[entry][c], 0.02f), 1.0f);
        m->color[c] = 0.35f + 0.65f * color;
        m->absorption[c] = radius > 0.0f ? -logf(color) / (4.0f * radius) : 0.0f;
    }
    return *known = (uint8_t)b->materials++;
}

/* ---- Geometries --------------------------------------------------------------------------------------------- */

static int has_room(sphere_list *list)
{
    if (list->count < list->capacity)
        return 1;
    const size_t more = list->capacity ? 2 * (size_t)list->capacity : 4096;
    float *xyzr = realloc(list->xyzr, more * 4 * sizeof *xyzr);
    list->xyzr = xyzr ? xyzr : list->xyzr;
    uint16_t *entry = realloc(list->entry, more * sizeof *entry);
    list->entry = entry ? entry : list->entry;
    uint8_t *material = realloc(list->material, more * sizeof *material);
    list->material = material ? material : list->material;
    uint32_t *place = realloc(list->place, more * sizeof *place);
    list->place = place ? place : list->place;
    if (!xyzr || !entry || !material || !place || more > UINT32_MAX)
        return 0;
    list->capacity = (uint32_t)more;
    return 1;
}

/* Divides the frame's spheres. */
static int divide(cgt_figure *figure, const frame_parts *parts)
{
    figure_bounce *b = figure->bounce;
    const bounce_options *o = &figure->options.bounce;
    const int selects = figure->parts.selects;
    const uint32_t count = selects ? parts->particles.count : figure->frame->count;
    const float *xyzr = selects ? parts->particles.xyzr : figure->frame->xyzr;
    b->list[OPAQUE].count = b->list[GLASS].count = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint16_t entry = selects ? parts->particles.index[i] : figure->coloring.index[i];
        const int rule = parts->rules ? parts->rules[i] : -1;
        sphere_list *list = &b->list[rule >= 0 && o->materials[rule].material == CGT_MATERIAL_GLASS ? GLASS : OPAQUE];
        if (!has_room(list))
            return -1;
        memcpy(list->xyzr + 4 * (size_t)list->count, xyzr + 4 * (size_t)i, 4 * sizeof *xyzr);
        list->entry[list->count] = entry;
        list->place[list->count] = i;
        list->material[list->count++] = material_of(b, o, rule, entry, xyzr[4 * (size_t)i + 3]);
    }
    return 0;
}

/* A geometry more, or its update: in the same order in each frame. */
static cgt_result set_geometry(cgt_figure *figure, const cgt_look *look, const cgt_spheres *spheres,
                               const cgt_triangles *triangles)
{
    figure_bounce *b = figure->bounce;
    const uint32_t k = b->looks++;
    b->look[k] = *look;
    b->look[k].palette = b->palette[0];
    if (k >= b->geometries)
        b->id[k] = CGT_INVALID_ID;
    const cgt_result result = spheres ? cgt_scene_set_spheres(figure->scene, &b->id[k], spheres)
                                      : cgt_scene_set_triangles(figure->scene, &b->id[k], triangles);
    b->geometries += k >= b->geometries && result == CGT_OK;
    return result;
}

static cgt_result set_spheres(cgt_figure *figure)
{
    figure_bounce *b = figure->bounce;
    cgt_result result = CGT_OK;
    for (int k = 0; k < KINDS && result == CGT_OK; k++) {
        const sphere_list *list = &b->list[k];
        const cgt_spheres spheres = {.count = list->count,
                                     .centers = cgt_floats(list->xyzr, 4 * sizeof(float)),
                                     .radii = cgt_floats(list->count ? list->xyzr + 3 : NULL, 4 * sizeof(float)),
                                     .mask = 1u << k};
        result = set_geometry(figure, &(cgt_look){.materials = list->material, .index = list->entry}, &spheres, NULL);
    }
    return result;
}

/* Bodies of a mesh of glass: found again where its corners change, not where its vertices move; in every frame where no
 * triangles share a vertex, since then places alone join them. */
static int find_bodies(cgt_figure *figure)
{
    figure_bounce *b = figure->bounce;
    const cgt_trajectory_frame *f = figure->frame;
    const size_t corners = 3 * (size_t)f->triangles;
    uint32_t bodies, wrong[3];
    if (!corners || (b->body && b->bodies_of == f->triangles && f->count < corners &&
                     memcmp(b->body + f->triangles, f->index, corners * sizeof *f->index) == 0))
        return 0;
    free(b->body);
    b->body = malloc((f->triangles + corners) * sizeof *b->body);
    b->bodies_of = f->triangles;
    if (!b->body)
        return cgt_figure_fail(figure, "out of memory for the bodies of %u triangles", f->triangles);
    memcpy(b->body + f->triangles, f->index, corners * sizeof *f->index);
    const cgt_result result = cgt_find_bodies(f->index, f->triangles, f->position, f->count, b->body, &bodies, wrong);
    if (result == CGT_ERROR_INVALID_ARGUMENT) /* the reader has checked the indices */
        return cgt_figure_fail(
            figure,
            "%s: glass must be closed: the mesh is not closed: the edge of triangle %u from vertex %u to %u "
            "has no other side, or one that is turned inside out",
            figure->source, wrong[0], wrong[1], wrong[2]);
    return result ? cgt_figure_fail(figure, "out of memory for the bodies of %u triangles", f->triangles) : 0;
}

static int set_triangles(cgt_figure *figure)
{
    figure_bounce *b = figure->bounce;
    const cgt_trajectory_frame *f = figure->frame;
    const bounce_options *o = &figure->options.bounce;
    const int rule = cgt_bounce_rule_of(o, NULL, NULL);
    const int glass = rule >= 0 && o->materials[rule].material == CGT_MATERIAL_GLASS;
    if (glass && find_bodies(figure))
        return -1;
    float size = 0.0f;
    for (int c = 0; c < 3 && figure->has_survey; c++)
        size = fmaxf(size, figure->survey.bounds_max[c] - figure->survey.bounds_min[c]);
    b->triangle_entry = figure->coloring.index;
    b->per_vertex = figure->coloring.per_vertex;
    const cgt_triangles triangles = {.count = f->triangles,
                                     .indices = cgt_uint32s(f->index, 0),
                                     .vertex_count = f->count,
                                     .vertices = cgt_floats(f->position, 0),
                                     .mask = 1u << (glass ? GLASS : OPAQUE)};
    const uint32_t entry = f->triangles ? b->triangle_entry[0] : 0;
    const cgt_result result = set_geometry(figure,
                                           &(cgt_look){.material = material_of(b, o, rule, entry, 0.2f * size),
                                                       .bodies = glass ? b->body : NULL,
                                                       .sheet = !glass,
                                                       .index = b->triangle_entry,
                                                       .per_vertex = b->per_vertex},
                                           NULL, &triangles);
    return result ? cgt_figure_fail_library(figure, "take the triangles", result) : 0;
}

int cgt_figure_bounce_find(const cgt_figure *figure, uint32_t geometry, uint32_t *primitive)
{
    const figure_bounce *const b = figure->bounce;
    if (figure->frame->kind == CGT_TRAJECTORY_TRIANGLES)
        return geometry == b->id[0];
    for (int k = 0; k < KINDS; k++)
        if (geometry == b->id[k]) {
            *primitive = b->list[k].place[*primitive];
            return 1;
        }
    return 0;
}

/* Materials are made anew, of the colours at hand: a frame looks the same whatever came before it. */
int cgt_figure_bounce_set(cgt_figure *figure, const frame_parts *parts)
{
    figure_bounce *b = figure->bounce;
    const uint32_t rules = figure->options.bounce.count;
    b->looks = 0;
    b->materials = 1;
    memset(b->material_of, 0, sizeof b->material_of);
    b->last_step = cgt_coloring_has_range(&figure->coloring) && rules
                       ? (MOST_MATERIALS - 1) / rules - 2 /* of each rule all steps, and what is unknown */
                       : 0;
    cgt_result result = CGT_OK;
    const int has_spheres = figure->frame->kind != CGT_TRAJECTORY_TRIANGLES;
    if (!has_spheres && set_triangles(figure))
        return -1;
    if (has_spheres && divide(figure, parts))
        return cgt_figure_fail(figure, "out of memory for the spheres");
    if (has_spheres)
        result = set_spheres(figure);
    if (result == CGT_OK && b->floor.count)
        result = set_geometry(figure, &(cgt_look){.sheet = true, .colors = b->floor_color[0]}, NULL, &b->floor);
    return result ? cgt_figure_fail_library(figure, "take the frame", result) : 0;
}

/* ---- Set-up ------------------------------------------------------------------------------------------------- */

/* One colour, or those of squares. */
static void color_floor(figure_bounce *b)
{
    for (uint32_t i = 0; i < b->floor.count; i++) {
        const uint32_t square = i / 2;
        const float share = (square % FLOOR_CHEQUERS + square / FLOOR_CHEQUERS) % 2 ? 0.7f : 0.22f;
        for (int c = 0; c < 3; c++)
            b->floor_color[i][c] = b->floor.count == 2 ? b->palette[FIGURE_FLOOR][c] : share;
    }
}

int cgt_figure_bounce_create(cgt_figure *figure)
{
    if (cgt_figure_scene_has_figures(figure))
        return cgt_figure_fail(figure, "--bounces takes the file's spheres or triangles, without figures");
    figure_bounce *const b = calloc(1, sizeof *b);
    figure->bounce = b;
    if (!b)
        return cgt_figure_fail(figure, "out of memory for mirrors and glass");
    b->palette = (const float(*)[3])figure->parts.palette;
    b->material[0] = (cgt_material){.kind = CGT_MATERIAL_MATTE, .color = {0.7f, 0.7f, 0.7f}};
    b->materials = 1;
    b->floor = figure->parts.floor.triangles;
    b->floor.mask = 1u << OPAQUE;
    color_floor(b);
    return 0;
}

void cgt_figure_bounce_release(figure_bounce *b)
{
    if (!b)
        return;
    for (int k = 0; k < KINDS; k++) {
        free(b->list[k].xyzr);
        free(b->list[k].entry);
        free(b->list[k].material);
        free(b->list[k].place);
    }
    free(b->body);
    free(b);
}

/* Whether the camera sees an axis upright: it lies in the plane of its view and up, on the side of up. */
static int is_upright(const float axis[3], const float right[3], const float up[3])
{
    const float tolerance = 1e-5f; /* of cameras that come from others by rotations */
    float aside = 0.0f, along = 0.0f, square = 0.0f;
    for (int c = 0; c < 3; c++) {
        aside += axis[c] * right[c];
        along += axis[c] * up[c];
        square += axis[c] * axis[c];
    }
    return square > 0.0f && fabsf(aside) <= tolerance * sqrtf(square) && along > tolerance * sqrtf(square);
}

/* Where the sky's zenith is. An automatic camera's up is an axis; a hand's is that axis made orthogonal to the view,
 * and its picture the same. So the zenith is the axis that stands upright, and only without one the camera's way up. */
static void find_zenith(const cgt_figure *figure, float zenith[3])
{
    const float *const given = figure->path.start.up, *const axis = figure->options.up;
    const int usual = figure->survey.kind == CGT_TRAJECTORY_TRIANGLES ? 1 : 2;
    float right[3], up[3], forward[3], most = 0.0f;
    cgt_camera_get_axes(&figure->path.start, right, up, forward);
    memcpy(zenith, up, sizeof up);
    if ((given[0] != 0.0f) + (given[1] != 0.0f) + (given[2] != 0.0f) == 1) {
        memcpy(zenith, given, sizeof up);
        return;
    }
    if (is_upright(axis, right, up)) {
        memcpy(zenith, axis, sizeof up);
        return;
    }
    for (int i = 0; i < 6; i++) { /* the usual one, else that which is most upright */
        const float sign = i < 3 ? 1.0f : -1.0f,
                    one[3] = {i % 3 == 0 ? sign : 0.0f, i % 3 == 1 ? sign : 0.0f, i % 3 == 2 ? sign : 0.0f};
        const float along = i == usual ? 2.0f : sign * up[i % 3];
        if (!is_upright(one, right, up) || along <= most)
            continue;
        most = along;
        memcpy(zenith, one, sizeof up);
    }
}

void cgt_figure_bounce_settings(const cgt_figure *figure, cgt_picture_options *settings)
{
    settings->bounces.materials = figure->bounce->material;
    settings->bounces.material_count = MOST_MATERIALS;
    settings->bounces.limit = figure->options.bounce.bounces;
    settings->bounces.shadow_mask = 1u << OPAQUE;
    settings->bounces.glass_mask = 1u << GLASS;
    find_zenith(figure, settings->bounces.up);
}

uint32_t cgt_figure_bounce_looks(const figure_bounce *b, cgt_look *looks)
{
    memcpy(looks, b->look, b->looks * sizeof *looks);
    return b->looks;
}

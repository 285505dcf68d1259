/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Mirrors and glass; see render_setup.h. */
#include "render/render_setup.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "picture/draw/draw_store.h"
#include "whitted/closed_mesh.h"
#include "whitted/whitted.h"

enum { OPAQUE, GLASS, KINDS, MOST_MATERIALS = 256 };

/* Spheres of a kind, in arrays that are kept from frame to frame. */
typedef struct sphere_list {
    uint32_t count, capacity;
    float *xyzr;
    uint16_t *entry; /* of the palette */
    uint8_t *material;
} sphere_list;

struct render_bounce {
    whitted w;
    whitted_light lights[DRAW_MAX_LIGHTS];
    whitted_material material[MOST_MATERIALS]; /* 0 is matt */
    uint32_t materials;
    uint8_t material_of[BOUNCE_MATERIALS][COLORING_ENTRIES]; /* by rule and colour; 0: none yet */
    sphere_list list[KINDS];
    cgt_spheres spheres[KINDS];
    cgt_triangles triangles, floor;
    const uint16_t *triangle_entry;
    int per_vertex;
    uint32_t *body;     /* of the triangles, where they are glass */
    uint32_t bodies_of; /* triangles for which that was made */
    uint32_t geometries, id[KINDS + 2];
    whitted_geometry geometry[KINDS + 2];
    float (*light)[3]; /* of each ray of the picture */
    float *t;          /* of the camera's hits, and what they hit; NULL: not wanted */
    uint32_t *primitive;
    const float (*palette)[3];
};

/* ---- Materials ---------------------------------------------------------------------------------------------- */

/* The material of a rule in a colour. Glass of radius r is as dark as its colour along r. */
static uint8_t material_of(render_bounce *b, const bounce_options *o, int rule, uint32_t entry, float radius)
{
    if (rule < 0 || o->materials[rule].material == WHITTED_MATTE)
        return 0;
    uint8_t *known = &b->material_of[rule][entry];
    if (*known)
        return *known;
    if (b->materials == MOST_MATERIALS) /* so many colours: the last one will do */
        return *known = MOST_MATERIALS - 1;
    whitted_material *m = &b->material[b->materials];
    *m = (whitted_material){.kind = o->materials[rule].material,
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

static void color_of_sphere(void *user, uint32_t primitive, float rgb[3])
{
    const render_bounce *b = user;
    memcpy(rgb, b->palette[b->list[OPAQUE].entry[primitive]], 3 * sizeof *rgb);
}

static void color_of_triangle(void *user, uint32_t primitive, float rgb[3])
{
    const render_bounce *b = user;
    const uint32_t i = b->per_vertex ? b->triangles.indices[3 * (size_t)primitive] : primitive;
    memcpy(rgb, b->palette[b->triangle_entry[i]], 3 * sizeof *rgb);
}

static void color_of_floor(void *user, uint32_t primitive, float rgb[3])
{
    const render_bounce *b = user;
    const uint32_t square = primitive / 2;
    if (b->floor.count == 2)
        memcpy(rgb, b->palette[FIGURE_FLOOR], 3 * sizeof *rgb);
    else
        rgb[0] = rgb[1] = rgb[2] = (square % FLOOR_CHEQUERS + square / FLOOR_CHEQUERS) % 2 ? 0.7f : 0.22f;
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
    if (!xyzr || !entry || !material || more > UINT32_MAX)
        return 0;
    list->capacity = (uint32_t)more;
    return 1;
}

/* Divides the frame's spheres. */
static int divide(renderer *r, const frame_parts *parts)
{
    render_bounce *b = r->bounce;
    const bounce_options *o = &r->options.bounce;
    const int selects = r->parts.selects;
    const uint32_t count = selects ? parts->particles.count : r->frame->count;
    const float *xyzr = selects ? parts->particles.xyzr : r->frame->xyzr;
    b->list[OPAQUE].count = b->list[GLASS].count = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint16_t entry = selects ? parts->particles.index[i] : r->coloring.index[i];
        const int rule = parts->rules ? parts->rules[i] : -1;
        sphere_list *list = &b->list[rule >= 0 && o->materials[rule].material == WHITTED_GLASS ? GLASS : OPAQUE];
        if (!has_room(list))
            return -1;
        memcpy(list->xyzr + 4 * (size_t)list->count, xyzr + 4 * (size_t)i, 4 * sizeof *xyzr);
        list->entry[list->count] = entry;
        list->material[list->count++] = material_of(b, o, rule, entry, xyzr[4 * (size_t)i + 3]);
    }
    return 0;
}

/* A geometry more, or its update: in the same order in each frame. */
static cgt_result set_geometry(renderer *r, const whitted_geometry *g)
{
    render_bounce *b = r->bounce;
    const uint32_t k = b->w.geometries++;
    b->geometry[k] = *g;
    if (k < b->geometries)
        return g->spheres ? cgt_scene_update_spheres(r->scene, b->id[k], g->spheres)
                          : cgt_scene_update_triangles(r->scene, b->id[k], g->triangles);
    const cgt_result result = g->spheres ? cgt_scene_add_spheres(r->scene, g->spheres, &b->id[k])
                                         : cgt_scene_add_triangles(r->scene, g->triangles, &b->id[k]);
    b->geometries += result == CGT_OK;
    return result;
}

static cgt_result set_spheres(renderer *r)
{
    render_bounce *b = r->bounce;
    cgt_result result = CGT_OK;
    for (int k = 0; k < KINDS && result == CGT_OK; k++) {
        const sphere_list *list = &b->list[k];
        b->spheres[k] = (cgt_spheres){.count = list->count,
                                      .centers = list->xyzr,
                                      .center_stride = 4 * sizeof(float),
                                      .radii = list->count ? list->xyzr + 3 : NULL,
                                      .radius_stride = 4 * sizeof(float),
                                      .mask = 1u << k};
        result = set_geometry(r, &(whitted_geometry){.spheres = &b->spheres[k],
                                                     .material = list->material,
                                                     .color = k == OPAQUE ? color_of_sphere : NULL,
                                                     .color_user = b});
    }
    return result;
}

/* Bodies of a mesh of glass: found again where the number of its triangles changes. */
static int find_bodies(renderer *r)
{
    render_bounce *b = r->bounce;
    const cgt_trajectory_frame *f = r->frame;
    uint32_t bodies;
    if (b->body && b->bodies_of == f->triangles)
        return 0;
    free(b->body);
    b->body = malloc(((size_t)f->triangles + 1) * sizeof *b->body);
    b->bodies_of = f->triangles;
    if (!b->body) {
        program_error("out of memory for the bodies of %u triangles", f->triangles);
        return -1;
    }
    if (closed_mesh_bodies(f->index, f->triangles, f->position, f->count, b->body, &bodies, r->error,
                           sizeof r->error)) {
        program_error("%s: glass must be closed: %s", r->options.input, r->error);
        return -1;
    }
    return 0;
}

static int set_triangles(renderer *r)
{
    render_bounce *b = r->bounce;
    const cgt_trajectory_frame *f = r->frame;
    const bounce_options *o = &r->options.bounce;
    const int rule = bounce_rule_of(o, NULL, NULL);
    const int glass = rule >= 0 && o->materials[rule].material == WHITTED_GLASS;
    if (glass && find_bodies(r))
        return -1;
    float size = 0.0f;
    for (int c = 0; c < 3 && r->has_survey; c++)
        size = fmaxf(size, r->survey.bounds_max[c] - r->survey.bounds_min[c]);
    b->triangle_entry = r->coloring.index;
    b->per_vertex = r->coloring.per_vertex;
    b->triangles = (cgt_triangles){.count = f->triangles,
                                   .indices = f->index,
                                   .vertex_count = f->count,
                                   .vertices = f->position,
                                   .mask = 1u << (glass ? GLASS : OPAQUE)};
    const uint32_t entry = f->triangles ? b->triangle_entry[0] : 0;
    const cgt_result result =
        set_geometry(r, &(whitted_geometry){.triangles = &b->triangles,
                                            .material_of_all = material_of(b, o, rule, entry, 0.2f * size),
                                            .body = glass ? b->body : NULL,
                                            .sheet = !glass,
                                            .color = color_of_triangle,
                                            .color_user = b});
    return result ? render_fail_library(r, "take the triangles", result) : 0;
}

int render_bounce_set(renderer *r, const frame_parts *parts)
{
    render_bounce *b = r->bounce;
    b->w.geometries = 0;
    cgt_result result = CGT_OK;
    if (r->frame->kind == CGT_TRAJECTORY_TRIANGLES) {
        if (set_triangles(r))
            return -1;
    } else if (divide(r, parts)) {
        program_error("out of memory for the spheres");
        return -1;
    } else {
        result = set_spheres(r);
    }
    if (result == CGT_OK && b->floor.count)
        result = set_geometry(
            r,
            &(whitted_geometry){
                .triangles = &b->floor, .material_of_all = 0, .sheet = true, .color = color_of_floor, .color_user = b});
    if (result)
        return render_fail_library(r, "take the frame", result);
    b->w.scene = r->scene;
    b->w.geometry = b->geometry;
    b->w.material = b->material;
    b->w.materials = b->materials;
    return 0;
}

/* ---- Set-up ------------------------------------------------------------------------------------------------- */

static void choose_light(const renderer *r, render_bounce *b, const draw_settings *settings)
{
    static const float zenith[3] = {0.35f, 0.5f, 0.85f};
    whitted *w = &b->w;
    const float *up = r->path.start.up, length = sqrtf(up[0] * up[0] + up[1] * up[1] + up[2] * up[2]);
    for (uint32_t i = 0; i < settings->light_count; i++) {
        b->lights[i].light = settings->lights[i].light;
        memcpy(b->lights[i].color, settings->lights[i].color, sizeof b->lights[i].color);
    }
    w->light = b->lights;
    w->lights = settings->light_count;
    for (int c = 0; c < 3; c++) {
        w->ambient[c] = settings->sky;
        w->sky[1][c] = settings->background[c];
        w->sky[0][c] = settings->background[c] * zenith[c];
        w->rest[c] = 0.5f * settings->background[c];
        w->up[c] = up[c] / length;
    }
    w->bounces = r->options.bounce.bounces;
    w->faintest = 1.0f / 512.0f;
    w->shadow_mask = 1u << OPAQUE;
    w->glass_mask = 1u << GLASS;
    w->glass_shadow = 0.6f;
}

static int allocate(renderer *r, render_bounce *b)
{
    const size_t rays = (size_t)r->drawing.ray_width * r->drawing.ray_height;
    b->light = malloc(rays * sizeof *b->light);
    b->t = malloc(rays * sizeof *b->t);
    b->primitive = malloc(rays * sizeof *b->primitive);
    return b->light && b->t && b->primitive ? 0 : -1;
}

int render_bounce_create(renderer *r)
{
    if (render_scene_has_figures(r) || r->cell || r->options.cell.mode) {
        program_error("--bounces takes the file's spheres or triangles, without figures and without --cell");
        return -1;
    }
    if (r->options.stats) {
        program_error("--stats counts the camera's rays, and with --bounces those are the fewest");
        return -1;
    }
    render_bounce *const b = calloc(1, sizeof *b);
    r->bounce = b;
    if (!b || allocate(r, b)) {
        program_error("out of memory for %ux%u rays", r->drawing.ray_width, r->drawing.ray_height);
        return -1;
    }
    b->palette = (const float(*)[3])r->parts.palette;
    b->material[0] = (whitted_material){.kind = WHITTED_MATTE, .color = {0.7f, 0.7f, 0.7f}};
    b->materials = 1;
    b->floor = r->parts.floor.triangles;
    b->floor.mask = 1u << OPAQUE;
    choose_light(r, b, &r->drawing.settings);
    return 0;
}

void render_bounce_release(render_bounce *b)
{
    if (!b)
        return;
    for (int k = 0; k < KINDS; k++) {
        free(b->list[k].xyzr);
        free(b->list[k].entry);
        free(b->list[k].material);
    }
    free(b->body);
    free(b->light);
    free(b->t);
    free(b->primitive);
    free(b);
}

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

/* The picture from the light of its rays: those that hit nothing see the sky. Returns the hits. */
static uint32_t store_pixel(const renderer *r, uint32_t x, uint32_t y)
{
    const render_bounce *b = r->bounce;
    const drawing *d = &r->drawing;
    const uint32_t n = d->settings.samples;
    pixel_sum sum = {.depth = INFINITY, .id = CGT_INVALID_ID};
    for (uint32_t k = 0; k < n * n; k++) {
        const size_t ray = (size_t)(y * n + k / n) * d->ray_width + x * n + k % n;
        const int is_hit = b->primitive[ray] != CGT_INVALID_ID;
        for (int c = 0; c < 3; c++) {
            sum.all[c] += b->light[ray][c];
            sum.hits[c] += is_hit ? b->light[ray][c] : 0.0f;
        }
        sum.count += (uint32_t)is_hit;
        if (b->t[ray] < sum.depth) {
            sum.depth = b->t[ray];
            sum.id = b->primitive[ray];
        }
    }
    draw_store(d, &sum, (size_t)y * d->settings.width + x);
    return sum.count;
}

cgt_result render_bounce_trace(renderer *r)
{
    render_bounce *b = r->bounce;
    drawing *d = &r->drawing;
    uint64_t hits = 0;
    const char *wrong = whitted_check(&b->w);
    cgt_frame frame;
    if (wrong) {
        program_error("%s", wrong);
        return CGT_ERROR_INVALID_ARGUMENT;
    }
    cgt_frame_init(&frame, d->ray_width, d->ray_height);
    frame.t = b->t;
    frame.primitive = b->primitive;
    const cgt_result result = whitted_frame(&b->w, &r->camera, d->ray_width, d->ray_height, &frame, b->light);
    if (result)
        return result;
    for (uint32_t y = 0; y < d->settings.height; y++)
        for (uint32_t x = 0; x < d->settings.width; x++)
            hits += store_pixel(r, x, y);
    atomic_store_explicit(&d->hits, hits, memory_order_relaxed);
    return CGT_OK;
}

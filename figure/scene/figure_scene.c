/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The geometries of a frame; see figure_scene.h. */
#include "scene/figure_scene.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figure_state.h"

int cgt_bounce_rule_of(const bounce_options *o, const uint32_t *type, const uint8_t *element)
{
    int named = -1, all = -1;
    for (uint32_t k = 0; k < o->count; k++) {
        const bounce_material *m = &o->materials[k];
        if (m->is_all)
            all = (int)k;
        else if (m->is_element ? element && *element == m->kind : type && *type == m->kind)
            named = (int)k;
    }
    return named >= 0 ? named : all;
}

/* ---- Before the first frame --------------------------------------------------------------------------------- */

static int open_formula(cgt_figure *figure, const char *text, expression **formula)
{
    if (!text || !*text)
        return 0;
    *formula = cgt_expression_parse(text, figure->message, sizeof figure->message);
    return *formula ? cgt_frame_sequence_bind(&figure->sequence, *formula, figure->message, sizeof figure->message)
                    : -1;
}

/* Three formulas with commas between them, outside of parentheses. */
static int parse_arrows(cgt_figure *figure, const char *text)
{
    char part[3][256];
    int parts = 0, depth = 0;
    size_t length = 0;
    text = strcmp(text, "velocity") == 0 ? "vx,vy,vz" : strcmp(text, "force") == 0 ? "fx,fy,fz" : text;
    for (const char *c = text; parts < 3; c++) {
        depth += (*c == '(') - (*c == ')');
        if (*c && (*c != ',' || depth)) {
            if (length + 1 < sizeof part[0])
                part[parts][length++] = *c;
            continue;
        }
        part[parts++][length] = '\0';
        length = 0;
        if (!*c)
            break;
    }
    if (parts != 3) {
        snprintf(figure->message, sizeof figure->message, "--arrows: \"%s\" is not velocity, force or three formulas",
                 text);
        return -1;
    }
    for (int i = 0; i < 3; i++)
        if (open_formula(figure, *part[i] ? part[i] : "?", &figure->parts.arrow[i]))
            return -1;
    return 0;
}

static int open_labels(cgt_figure *figure)
{
    const picture_options *const o = &figure->options.picture;
    label_rules *const rules = &figure->parts.labels;
    if (!*o->label)
        return 0;
    rules->is_id = !o->label_text;
    if (open_formula(figure, o->label, &rules->which) ||
        (o->label_text && cgt_label_rules_split(rules, o->label_text, figure->message, sizeof figure->message)))
        return -1;
    for (uint32_t i = 0; i < rules->parts; i++)
        if (cgt_frame_sequence_bind(&figure->sequence, rules->part[i].value, figure->message, sizeof figure->message))
            return -1;
    return 0;
}

int cgt_figure_scene_open(cgt_figure *figure)
{
    const particle_options *o = &figure->options.particles;
    figure_scene *s = &figure->parts;
    particle_rules *rules = &s->rules;
    if (open_formula(figure, o->show, &s->show) || open_formula(figure, o->radius, &s->radius) ||
        open_formula(figure, o->opacity, &s->layer) || (o->arrows && parse_arrows(figure, o->arrows)) ||
        open_labels(figure))
        return -1;
    rules->show = s->show;
    rules->radius = s->radius;
    rules->layer = s->layer;
    rules->radius_scale = o->radius_scale;
    rules->radius_count = o->radius_count;
    memcpy(rules->radii, o->radii, sizeof rules->radii);
    memcpy(rules->images, o->images, sizeof rules->images);
    figure->sequence.rules = rules;
    s->selects = !cgt_particle_rules_are_empty(rules) || o->bonds || o->arrows || o->trails;
    return 0;
}

static void extend(survey *s, const camera_directions *fit, const float p[3])
{
    const double place[3] = {(double)p[0], (double)p[1], (double)p[2]};
    for (int c = 0; c < 3; c++) {
        s->bounds_min[c] = fminf(s->bounds_min[c], p[c]);
        s->bounds_max[c] = fmaxf(s->bounds_max[c], p[c]);
    }
    cgt_camera_reach_add(&s->reach, fit, place, 0.0);
}

int cgt_figure_scene_mesh(cgt_figure *figure, const cgt_trajectory_frame *mesh)
{
    figure_scene *s = &figure->parts;
    s->mesh = *mesh;
    s->mesh_entries = malloc(((size_t)mesh->triangles + 1) * sizeof *s->mesh_entries);
    if (!s->mesh_entries)
        return cgt_figure_fail(figure, "out of memory for the mesh");
    for (uint32_t i = 0; i < mesh->triangles; i++)
        s->mesh_entries[i] = FIGURE_MESH;
    return 0;
}

/* The camera shows box, images and mesh, too. */
void cgt_figure_scene_bound(cgt_figure *figure)
{
    const figure_scene *parts = &figure->parts;
    survey *s = &figure->survey;
    if (!figure->has_survey)
        return;
    const camera_directions *const fit = figure_fit(figure);
    for (uint32_t k = 0; k < fit->count; k++) {
        s->reach.along[k] += fmax(s->move_reach.along[k], 0.0);
        if (figure->options.particles.box)
            s->reach.along[k] = fmax(s->reach.along[k], s->box_reach.along[k]);
    }
    for (int c = 0; c < 3; c++) {
        s->bounds_min[c] = (float)((double)s->bounds_min[c] + s->move_min[c]);
        s->bounds_max[c] = (float)((double)s->bounds_max[c] + s->move_max[c]);
        if (figure->options.particles.box && s->box_min[c] <= s->box_max[c]) {
            s->bounds_min[c] = fminf(s->bounds_min[c], (float)s->box_min[c]);
            s->bounds_max[c] = fmaxf(s->bounds_max[c], (float)s->box_max[c]);
        }
    }
    for (uint32_t i = 0; i < parts->mesh.count; i++) {
        const float *p = parts->mesh.position + 3 * (size_t)i;
        if (isfinite(p[0] + p[1] + p[2]))
            extend(s, fit, p);
    }
    s->drawable += parts->mesh.triangles;
}

void cgt_figure_scene_floor(cgt_figure *figure)
{
    floor_options *const o = &figure->options.floor;
    const survey *s = &figure->survey;
    const float *up = figure->path.start.up;
    float middle[3], size = 0.0f;
    int axis = 0;
    for (int c = 0; c < 3; c++) {
        axis = fabsf(up[c]) > fabsf(up[axis]) ? c : axis;
        size = fmaxf(size, s->bounds_max[c] - s->bounds_min[c]);
        middle[c] = 0.5f * (s->bounds_min[c] + s->bounds_max[c]);
    }
    const int is_down = o->axis ? o->axis > 3 : !(up[axis] > 0.0f);
    axis = o->axis ? (int)(o->axis - 1) % 3 : axis;
    middle[axis] = is_down ? s->bounds_max[axis] : s->bounds_min[axis];
    for (int c = 0; c < 3 && o->has_place; c++)
        middle[c] = (float)(o->place[c] - figure->origin[c]);
    size = o->has_place ? (float)o->place[3] : size;
    if (o->has_height)
        middle[axis] = (float)((is_down ? -o->height : o->height) - figure->origin[axis]);
    /* as another command line would have to say it */
    o->axis = (uint32_t)axis + (is_down ? 4 : 1);
    for (int c = 0; c < 3; c++)
        o->place[c] = (double)middle[c] + figure->origin[c];
    o->place[3] = (double)size;
    cgt_floor_make(&figure->parts.floor, middle, axis, size, figure->options.bounce.is_set && !o->has_color);
}

/* ---- Each frame --------------------------------------------------------------------------------------------- */

static double box_diagonal(const cgt_trajectory_frame *f)
{
    double square = 0.0;
    for (int c = 0; c < 3; c++) {
        const double sum = f->box_edge[0][c] + f->box_edge[1][c] + f->box_edge[2][c];
        square += sum * sum;
    }
    return sqrt(square);
}

/* Lines are so thick that rays of all of their pixels meet them. */
static void set_thinnest(const cgt_figure *figure, const cgt_trajectory_frame *f, sticks *t)
{
    const double facets = 1.1; /* a cylinder of few sides is thinner between its edges */
    const double pi = 3.14159265358979323846;
    const figure_options *o = &figure->options;
    cgt_camera camera;
    double square = 0.0;
    cgt_figure_camera_at(figure, f->number, &camera);
    for (int c = 0; c < 3; c++) {
        t->eye[c] = (double)camera.eye[c];
        square += ((double)camera.target[c] - t->eye[c]) * ((double)camera.target[c] - t->eye[c]);
    }
    t->spread = facets * tan((double)camera.fov * pi / 360.0) / (double)(o->height * o->samples);
    t->least = o->picture.ortho ? t->spread * sqrt(square) : 0.0;
    t->spread = o->picture.ortho ? 0.0 : t->spread;
}

/* Fewer sides where there are many arrows. */
static uint32_t choose_sides(const particle_options *o, const particles *p)
{
    const uint32_t count = o->arrows ? p->count : 0;
    return count < 5000 ? 20 : count < 50000 ? 12 : 8;
}

/* The edges of the box and the trails, which are lines, after all else. */
static int make_lines(const cgt_figure *figure, const cgt_trajectory_frame *f, frame_parts *parts, char *error,
                      size_t error_size)
{
    const particle_options *o = &figure->options.particles;
    const float radius = o->box_radius > 0.0f ? o->box_radius : 0.0015f * (float)box_diagonal(f);
    const frame_sequence *const sequence = figure->shown ? &figure->keeping.sequence : &figure->sequence;
    const trail_rules trails = {sequence->trails, o->trail_radius, o->has_trail_color ? FIGURE_TRAIL : -1};
    parts->bonds = parts->sticks.count;
    parts->arrows = parts->sticks.triangles;
    if (o->box && cgt_shapes_add_box(&parts->sticks, f, o->images, radius, FIGURE_BOX)) {
        snprintf(error, error_size, "%s: frame %" PRIu64 ": --box: the file has no box", figure->source, f->number);
        return -1;
    }
    return o->trails ? cgt_shapes_add_trails(&parts->sticks, &trails, f, &parts->particles, error, error_size) : 0;
}

/* By what sticks are measured where no option says how thick they are: an Angstrom where there are elements, else the
 * smallest sphere's diameter, whatever the unit of length is. */
static float figure_unit(const cgt_trajectory_frame *f, const particles *p)
{
    float smallest = INFINITY;
    if (f->element)
        return f->angstrom;
    for (uint32_t i = 0; i < p->count; i++)
        if (p->xyzr[4 * (size_t)i + 3] > 0.0f)
            smallest = fminf(smallest, p->xyzr[4 * (size_t)i + 3]);
    return isfinite(smallest) ? 2.0f * smallest : 1.0f;
}

/* Layer by layer, what is opaque last. */
static int add_bonds(const particle_options *o, const bond_rules *rules, const cgt_trajectory_frame *f,
                     frame_parts *parts, char *error, size_t error_size)
{
    float opacity[PARTICLE_LAYERS] = {1.0f};
    bond_rules of_layer = *rules;
    memcpy(opacity + 1, o->layers, sizeof o->layers);
    of_layer.opacity = o->layer_count ? opacity : NULL;
    of_layer.layer = o->has_bond_layer ? (int32_t)o->bond_layer : -1;
    parts->cut_bonds = 0;
    for (uint32_t k = PARTICLE_LAYERS; k-- > 0;) {
        of_layer.cut = k ? NULL : &parts->cut_bonds; /* once */
        parts->bond_begin[k] = parts->sticks.count;
        of_layer.only = k;
        if (o->bonds && k <= o->layer_count &&
            cgt_shapes_add_bonds(&parts->sticks, &of_layer, f, &parts->particles, error, error_size))
            return -1;
    }
    return 0;
}

static int make_figures(const cgt_figure *figure, const cgt_trajectory_frame *f, frame_parts *parts, char *error,
                        size_t error_size)
{
    const particle_options *o = &figure->options.particles;
    const figure_scene *s = &figure->parts;
    const expression *const vector[3] = {s->arrow[0], s->arrow[1], s->arrow[2]};
    const int asks = (o->bonds && !(o->bond_radius > 0.0f)) || (o->arrows && !(o->arrow_radius > 0.0f));
    const float unit = asks ? figure_unit(f, &parts->particles) : 0.0f;
    const bond_rules bonds = {.distance = o->bond_distance,
                              .radius = o->bond_radius > 0.0f ? o->bond_radius : 0.15f * unit,
                              .entry = o->has_bond_color ? FIGURE_BOND : -1,
                              .images = {o->images[0], o->images[1], o->images[2]}};
    cgt_sticks_clear(&parts->sticks, choose_sides(o, &parts->particles));
    set_thinnest(figure, f, &parts->sticks);
    if (add_bonds(o, &bonds, f, parts, error, error_size))
        return -1;
    if (o->arrows)
        cgt_shapes_add_arrows(&parts->sticks, vector, o->arrow_scale,
                              o->arrow_radius > 0.0f ? o->arrow_radius : 0.1f * unit, &parts->particles,
                              o->has_arrow_color ? FIGURE_ARROW : -1);
    if (make_lines(figure, f, parts, error, error_size))
        return -1;
    if (parts->sticks.failed) {
        snprintf(error, error_size, "out of memory for bonds, arrows, trails or box of frame %" PRIu64, f->number);
        return -1;
    }
    return 0;
}

/* The material of each sphere that is drawn. */
static int find_rules(const cgt_figure *figure, const cgt_trajectory_frame *f, frame_parts *parts, char *error,
                      size_t error_size)
{
    const bounce_options *o = &figure->options.bounce;
    const uint32_t count = figure->parts.selects ? parts->particles.count : f->count;
    if (o->count == 0 || f->kind == CGT_TRAJECTORY_TRIANGLES) {
        free(parts->rules); /* those of options before these */
        parts->rules = NULL;
        parts->rule_room = 0;
        return 0;
    }
    if (!parts->rules || count > parts->rule_room) {
        free(parts->rules);
        parts->rules = malloc((size_t)count + 1);
        parts->rule_room = parts->rules ? count : 0;
    }
    if (!parts->rules) {
        snprintf(error, error_size, "out of memory for the materials of %" PRIu32 " spheres", count);
        return -1;
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t k = figure->parts.selects ? parts->particles.source[i] : i;
        parts->rules[i] =
            (int8_t)cgt_bounce_rule_of(o, f->type ? f->type + k : NULL, f->element ? f->element + k : NULL);
    }
    return 0;
}

int cgt_figure_scene_prepare(const cgt_figure *figure, const cgt_trajectory_frame *f, const uint16_t *index,
                             frame_parts *parts, char *error, size_t error_size)
{
    const figure_scene *s = &figure->parts;
    if (f->kind == CGT_TRAJECTORY_TRIANGLES && s->selects) {
        snprintf(
            error, error_size,
            "%s: --show, --hide, --slice, --cut, radii, opacity, bonds, arrows, trails and images are for spheres, "
            "and this is a file of triangles",
            figure->source);
        return -1;
    }
    parts->angstrom = f->element ? f->angstrom : 0.0f;
    if (f->kind == CGT_TRAJECTORY_TRIANGLES && s->labels.which) {
        snprintf(error, error_size, "%s: --label is for spheres, and this is a file of triangles", figure->source);
        return -1;
    }
    if (!s->labels.which) { /* those of options before these */
        parts->labels.count = 0;
    } else if (cgt_label_rules_apply(&s->labels, &s->rules, f, &parts->labels)) {
        snprintf(error, error_size, "out of memory for labels");
        return -1;
    }
    if (s->selects && cgt_particles_select(&parts->particles, &s->rules, f, index, error, error_size))
        return -1;
    if (find_rules(figure, f, parts, error, error_size) || make_figures(figure, f, parts, error, error_size))
        return -1;
    if (s->selects && cgt_particles_sort(&parts->particles)) {
        snprintf(error, error_size, "out of memory for %" PRIu32 " spheres", parts->particles.count);
        return -1;
    }
    return 0;
}

void cgt_frame_parts_free(frame_parts *parts)
{
    cgt_particles_free(&parts->particles);
    cgt_sticks_free(&parts->sticks);
    free(parts->rules);
    free(parts->labels.list);
}

/* The scene uses the reader's array: x, y, z, radius of each sphere; or the copy of those that are drawn. */
static cgt_result set_spheres(cgt_figure *figure)
{
    const float *xyzr = figure->parts.selects ? figure->parts.frame->particles.xyzr : figure->frame->xyzr;
    const uint32_t count = figure->parts.selects ? figure->parts.frame->particles.begin[1] : figure->frame->count;
    const cgt_spheres spheres = {.count = count,
                                 .centers = cgt_floats(xyzr, 4 * sizeof(float)),
                                 .radii = cgt_floats(count ? xyzr + 3 : NULL, 4 * sizeof(float)),
                                 .mask = cgt_figure_layer_mask(&figure->options.particles, 0)};
    if (!figure->has_geometry)
        figure->geometry = CGT_INVALID_ID;
    return cgt_scene_set_spheres(figure->scene, &figure->geometry, &spheres);
}

static cgt_result set_triangles(cgt_figure *figure, const cgt_triangles *triangles, int *is_there, uint32_t *geometry)
{
    if (!*is_there)
        *geometry = CGT_INVALID_ID;
    const cgt_result result = cgt_scene_set_triangles(figure->scene, geometry, triangles);
    *is_there |= result == CGT_OK;
    return result;
}

static cgt_result set_mesh(cgt_figure *figure, const cgt_trajectory_frame *f, uint32_t mask, int *is_there,
                           uint32_t *geometry)
{
    const cgt_triangles triangles = {.count = f->triangles,
                                     .indices = cgt_uint32s(f->index, 0),
                                     .vertex_count = f->count,
                                     .vertices = cgt_floats(f->position, 0),
                                     .mask = mask};
    return set_triangles(figure, &triangles, is_there, geometry);
}

static cgt_result set_sticks(cgt_figure *figure)
{
    figure_scene *s = &figure->parts;
    const sticks *t = &s->frame->sticks;
    const uint32_t begin = s->frame->bond_begin[0], count = t->count - begin;
    const uint32_t mask = cgt_figure_layer_mask(&figure->options.particles, 0);
    const cgt_capsules capsules = {.count = count,
                                   .vertex_count = 2 * count,
                                   .vertices = cgt_floats(count ? t->end + 6 * (size_t)begin : t->end, 0),
                                   .radii = cgt_floats(count ? t->radius + begin : NULL, 0),
                                   .mask = mask};
    const cgt_triangles facets = {.count = t->triangles,
                                  .indices = cgt_uint32s(t->index, 0),
                                  .vertex_count = t->vertices,
                                  .vertices = cgt_floats(t->position, 0),
                                  .mask = mask};
    cgt_result result = CGT_OK;
    if (!s->has_sticks)
        s->sticks_geometry = CGT_INVALID_ID;
    if (s->has_sticks || count)
        result = cgt_scene_set_capsules(figure->scene, &s->sticks_geometry, &capsules);
    s->has_sticks |= count && result == CGT_OK;
    if (result == CGT_OK && (s->has_facets || t->triangles))
        result = set_triangles(figure, &facets, &s->has_facets, &s->facets_geometry);
    return result;
}

/* Tells once of spheres that a formula of radii takes away. */
static void tell_radii(cgt_figure *figure, const particles *p)
{
    if (figure->has_radii_told || (!p->dropped && !p->points))
        return;
    figure->has_radii_told = 1;
    cgt_notices_add(&figure->notices,
                    "--radius-by: in frame %" PRIu64 " %" PRIu32
                    " spheres are left out, whose radius is negative or no number, and %" PRIu32 " have the radius 0",
                    figure->frame->number, p->dropped, p->points);
}

/* Tells once of bonds that the box cuts. */
static void tell_bonds(cgt_figure *figure, uint64_t cut)
{
    if (figure->has_cut_told || !cut)
        return;
    figure->has_cut_told = 1;
    cgt_notices_add(&figure->notices,
                    "--bonds: in frame %" PRIu64 " %" PRIu64
                    " %s through the outer boundary of the box, and %s left out",
                    figure->frame->number, cut, cut == 1 ? "bond goes" : "bonds go", cut == 1 ? "is" : "are");
}

int cgt_figure_scene_set(cgt_figure *figure, const frame_parts *parts)
{
    figure_scene *s = &figure->parts;
    const cgt_trajectory_frame *f = figure->frame;
    s->frame = parts;
    tell_radii(figure, &parts->particles);
    tell_bonds(figure, parts->cut_bonds);
    const particle_options *const o = &figure->options.particles;
    if (figure->coloring.by == COLORING_RGB)
        memcpy(s->palette, figure->coloring.palette, sizeof figure->coloring.palette);
    if (figure->bounce)
        return cgt_figure_bounce_set(figure, parts);
    cgt_result result = f->kind == CGT_TRAJECTORY_TRIANGLES
                            ? set_mesh(figure, f, cgt_figure_layer_mask(o, 0), &figure->has_geometry, &figure->geometry)
                            : set_spheres(figure);
    if (result)
        return cgt_figure_fail_library(
            figure, f->kind == CGT_TRAJECTORY_TRIANGLES ? "take the triangles" : "take the spheres", result);
    figure->has_geometry = 1;
    if (s->mesh_entries && !s->has_mesh)
        result = set_mesh(figure, &s->mesh, cgt_figure_layer_mask(o, o->mesh_layer), &s->has_mesh, &s->mesh_geometry);
    s->floor.triangles.mask = cgt_figure_layer_mask(o, 0);
    if (!result && s->floor.triangles.count && !s->has_floor)
        result = set_triangles(figure, &s->floor.triangles, &s->has_floor, &s->floor_geometry);
    if (!result)
        result = set_sticks(figure);
    if (!result)
        result = cgt_figure_layers_set(figure);
    return result ? cgt_figure_fail_library(figure, "take figures or mesh", result) : 0;
}

int cgt_figure_scene_find(const cgt_figure *figure, uint32_t geometry, uint32_t primitive, uint32_t *element)
{
    const figure_scene *const s = &figure->parts;
    const int is_file = figure->bounce
                            ? cgt_figure_bounce_find(figure, geometry, &primitive)
                            : geometry == figure->geometry || cgt_figure_layers_find(figure, geometry, &primitive) == 0;
    *element = is_file && s->selects ? s->frame->particles.source[primitive] : primitive;
    return is_file;
}

/* ---- Looks -------------------------------------------------------------------------------------------------- */

int cgt_figure_scene_has_figures(const cgt_figure *figure)
{
    const particle_options *o = &figure->options.particles;
    return o->box || o->bonds || o->arrows || figure->parts.mesh_entries || o->trails;
}

uint32_t cgt_figure_scene_looks(const cgt_figure *figure, cgt_look *looks)
{
    const figure_scene *s = &figure->parts;
    const cgt_trajectory_frame *f = figure->frame;
    const int triangles = f->kind == CGT_TRAJECTORY_TRIANGLES;
    const cgt_look plain = {.palette = s->palette[0], .palette_steps = COLORING_STEPS};
    cgt_look *file = &looks[figure->geometry];
    *file = plain;
    file->index = s->selects ? s->frame->particles.index : figure->coloring.index;
    file->ids = s->selects ? s->frame->particles.source : NULL;
    file->per_vertex = triangles && figure->coloring.per_vertex;
    file->vertex_normals = triangles ? f->vertex_normal : NULL;
    if (s->has_sticks) {
        cgt_look *stick = &looks[s->sticks_geometry];
        *stick = plain;
        stick->index = s->frame->sticks.entry + 2 * (size_t)s->frame->bond_begin[0];
        stick->halves = true;
        stick->lineless_from = s->frame->bonds - s->frame->bond_begin[0] + 1;
    }
    if (s->has_facets) {
        cgt_look *facets = &looks[s->facets_geometry];
        *facets = plain;
        facets->index = s->frame->sticks.mesh_entry;
        facets->vertex_normals = s->frame->sticks.normal;
        facets->lineless_from = s->frame->arrows + 1;
    }
    if (s->has_mesh) {
        cgt_look *mesh = &looks[s->mesh_geometry];
        *mesh = plain;
        mesh->index = s->mesh_entries;
        mesh->vertex_normals = s->mesh.vertex_normal;
    }
    if (s->has_floor) {
        static const uint16_t entry[2] = {FIGURE_FLOOR, FIGURE_FLOOR};
        cgt_look *floor = &looks[s->floor_geometry];
        *floor = plain;
        floor->index = entry;
        floor->lineless_from = 1; /* its horizon is no rim */
    }
    return 1 + (uint32_t)s->has_sticks + (uint32_t)s->has_facets + (uint32_t)s->has_mesh + (uint32_t)s->has_floor +
           cgt_figure_layers_looks(figure, looks);
}

void cgt_figure_scene_close(cgt_figure *figure)
{
    figure_scene *s = &figure->parts;
    cgt_expression_free(s->show);
    cgt_expression_free(s->radius);
    cgt_expression_free(s->layer);
    for (int i = 0; i < 3; i++)
        cgt_expression_free(s->arrow[i]);
    cgt_label_rules_free(&s->labels);
    free(s->mesh_entries);
}

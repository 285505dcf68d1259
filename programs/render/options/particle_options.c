/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Options about what is drawn; see particle_options.h. */
#include "render/options/particle_options.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#include "common/program.h"
#include "picture/figures/trail_history.h"
#include "render/options/settings/option_values.h"
#include "trajectory/trajectory_elements.h"

enum {
    OPTION_SHOW = 2048,
    OPTION_HIDE,
    OPTION_SLICE,
    OPTION_CUT,
    OPTION_RADIUS_BY,
    OPTION_RADIUS_SCALE,
    OPTION_TYPE_RADIUS,
    OPTION_TYPE_COLOR,
    OPTION_TYPE_NAME,
    OPTION_IMAGES,
    OPTION_BOX,
    OPTION_BONDS,
    OPTION_BOND_RADIUS,
    OPTION_BOND_COLOR,
    OPTION_ARROWS,
    OPTION_ARROW_SCALE,
    OPTION_ARROW_RADIUS,
    OPTION_ARROW_COLOR,
    OPTION_TRAILS,
    OPTION_TRAIL_RADIUS,
    OPTION_TRAIL_COLOR,
    OPTION_MESH,
    OPTION_MESH_COLOR,
    OPTION_MESH_OPACITY
};

static const struct argp_option table[] = {
    {NULL, 0, NULL, 0, "What is drawn:", 12},
    {"show", OPTION_SHOW, "FORMULA", 0,
     "Only spheres for which the formula is not 0, such as 'type != 2 && z < 5'. This and the next three may be given "
     "several times; a sphere is shown where all agree",
     0},
    {"hide", OPTION_HIDE, "TYPES", 0, "Leave out spheres of these types, such as 2,3", 0},
    {"slice", OPTION_SLICE, "A,B,C,D", 0, "Only spheres whose centres have A x + B y + C z <= D", 0},
    {"cut", OPTION_CUT, "X0,Y0,Z0,X1,Y1,Z1", 0, "Only spheres whose centres are in this box", 0},
    {"radius-by", OPTION_RADIUS_BY, "FORMULA", 0, "Radius of each sphere, such as 'sqrt(c_mass)/2'", 0},
    {"radius-scale", OPTION_RADIUS_SCALE, "S", 0, "Multiply all radii, for balls and sticks by 0.3 for example", 0},
    {"type-radius", OPTION_TYPE_RADIUS, "TYPE=R", 0, "Radius of a type, by its number, or of an element: 2=0.4, O=1.2",
     0},
    {"type-color", OPTION_TYPE_COLOR, "TYPE=COLOR", 0, "Colour of a type or an element: 2=red, O=00a0ff", 0},
    {"type-name", OPTION_TYPE_NAME, "TYPE=NAME", 0, "What --legend calls a type or an element: 2=water", 0},
    {"images", OPTION_IMAGES, "A,B,C", 0, "Repeat everything so many times along the edges of the box", 0},
    {"box", OPTION_BOX, "RADIUS", OPTION_ARG_OPTIONAL, "Edges of the simulation box, as tubes of this radius", 0},
    {"bonds", OPTION_BONDS, "DISTANCE", OPTION_ARG_OPTIONAL,
     "Bonds as cylinders: those of the file, or between spheres whose centres are not farther apart", 0},
    {"bond-radius", OPTION_BOND_RADIUS, "R", 0, "Radius of bonds; default 0.15", 0},
    {"bond-color", OPTION_BOND_COLOR, "RRGGBB", 0, "Colour of bonds; default: half and half those of their ends", 0},
    {"arrows", OPTION_ARROWS, "X,Y,Z", 0,
     "An arrow at each sphere, by three formulas, such as fx,fy,fz; velocity and force stand for vx,vy,vz and fx,fy,fz",
     0},
    {"arrow-scale", OPTION_ARROW_SCALE, "S", 0, "World units for each unit of the vectors; default 1", 0},
    {"arrow-radius", OPTION_ARROW_RADIUS, "R", 0, "Radius of arrows' shafts; default 0.1", 0},
    {"arrow-color", OPTION_ARROW_COLOR, "RRGGBB", 0, "Colour of arrows; default: that of their spheres", 0},
    {"trails", OPTION_TRAILS, "N", 0,
     "Where each sphere was in the N frames before, 1 to 1000, as a tube that gets thinner; those frames are read, too",
     0},
    {"trail-radius", OPTION_TRAIL_RADIUS, "R", 0, "Radius of trails at the sphere; default: a fifth of its own", 0},
    {"trail-color", OPTION_TRAIL_COLOR, "RRGGBB", 0, "Colour of trails; default: that of their spheres", 0},
    {"mesh", OPTION_MESH, "FILE", 0, "A mesh that stands still among the spheres, such as the walls of a drum", 0},
    {"mesh-opacity", OPTION_MESH_OPACITY, "SHARE", 0,
     "How much of its nearest side covers what is behind, above 0 to 1 (default); each frame is then drawn twice", 0},
    {"mesh-color", OPTION_MESH_COLOR, "RRGGBB", 0, "Its colour; default b8bcc2", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

/* Adds a condition to those that a sphere must meet. */
static int add_condition(particle_options *o, const char *condition, char *error, size_t size)
{
    expression *formula = expression_parse(condition, error, size);
    const size_t used = strlen(o->show);
    if (!formula)
        return -1;
    expression_free(formula);
    const int length = snprintf(o->show + used, sizeof o->show - used, "%s(%s)", used ? " && " : "", condition);
    if (length < 0 || (size_t)length >= sizeof o->show - used) {
        o->show[used] = '\0';
        snprintf(error, size, "the conditions are too long together");
        return -1;
    }
    return 0;
}

static int parse_hide(const char *text, particle_options *o, char *error, size_t size)
{
    float types[16];
    char condition[64];
    size_t count;
    if (option_parse_numbers(text, 1, 16, types, &count, error, size))
        return -1;
    for (size_t i = 0; i < count; i++) {
        snprintf(condition, sizeof condition, "type != %.9g", (double)types[i]);
        if (add_condition(o, condition, error, size))
            return -1;
    }
    return 0;
}

static int parse_slice(const char *text, particle_options *o, char *error, size_t size)
{
    float v[4];
    char condition[128];
    if (program_parse_floats(text, 4, v, error, size))
        return -1;
    snprintf(condition, sizeof condition, "%.9g * x + %.9g * y + %.9g * z <= %.9g", (double)v[0], (double)v[1],
             (double)v[2], (double)v[3]);
    return add_condition(o, condition, error, size);
}

static int parse_cut(const char *text, particle_options *o, char *error, size_t size)
{
    float v[6];
    char condition[256];
    if (program_parse_floats(text, 6, v, error, size))
        return -1;
    if (v[0] > v[3] || v[1] > v[4] || v[2] > v[5]) {
        snprintf(error, size, "\"%s\": the first corner is not below the second", text);
        return -1;
    }
    snprintf(condition, sizeof condition, "x >= %.9g && y >= %.9g && z >= %.9g && x <= %.9g && y <= %.9g && z <= %.9g",
             (double)v[0], (double)v[1], (double)v[2], (double)v[3], (double)v[4], (double)v[5]);
    return add_condition(o, condition, error, size);
}

/* TYPE=VALUE: sets the kind. Returns the value, or NULL with a sentence. */
static const char *parse_kind(const char *text, particle_kind *kind, uint32_t count, char *error, size_t size)
{
    const char *equals = strchr(text, '=');
    char name[32];
    element_reading reading;
    if (count == PARTICLE_KINDS) {
        snprintf(error, size, "more than %d types", PARTICLE_KINDS);
        return NULL;
    }
    if (!equals || equals == text || (size_t)(equals - text) >= sizeof name) {
        snprintf(error, size, "\"%s\" is not of the form TYPE=VALUE", text);
        return NULL;
    }
    memcpy(name, text, (size_t)(equals - text));
    name[equals - text] = '\0';
    kind->is_element = name[0] < '0' || name[0] > '9';
    kind->kind = kind->is_element ? element_find((text_span){name, name + strlen(name)}, &reading) : 0;
    if (kind->is_element && !kind->kind) {
        snprintf(error, size, "\"%s\" is neither a type's number nor a chemical element", name);
        return NULL;
    }
    if (!kind->is_element && program_parse_u32(name, 0, UINT32_MAX, &kind->kind, error, size))
        return NULL;
    return equals + 1;
}

static int parse_type_radius(const char *text, particle_options *o, char *error, size_t size)
{
    particle_kind kind;
    const char *value = parse_kind(text, &kind, o->radius_count, error, size);
    if (!value || program_parse_float(value, 0.0f, 1e30f, &kind.value[0], error, size))
        return -1;
    o->radii[o->radius_count++] = kind;
    return 0;
}

static int parse_type_color(const char *text, particle_options *o, char *error, size_t size)
{
    particle_kind kind;
    uint8_t rgb[3];
    const char *value = parse_kind(text, &kind, o->color_count, error, size);
    if (!value || option_parse_color(value, rgb, error, size))
        return -1;
    for (int c = 0; c < 3; c++)
        kind.value[c] = (float)rgb[c] / 255.0f;
    o->colors[o->color_count++] = kind;
    return 0;
}

static int parse_type_name(const char *text, particle_options *o, char *error, size_t size)
{
    particle_name name;
    name.name = parse_kind(text, &name.kind, o->name_count, error, size);
    if (!name.name)
        return -1;
    o->names[o->name_count++] = name;
    return 0;
}

static int parse_images(const char *text, uint32_t images[3], char *error, size_t size)
{
    float v[3];
    if (program_parse_floats(text, 3, v, error, size))
        return -1;
    for (int c = 0; c < 3; c++)
        if (!(v[c] >= 1.0f && v[c] <= 100.0f) || v[c] != (float)(uint32_t)v[c]) {
            snprintf(error, size, "\"%s\" is not three whole numbers from 1 to 100", text);
            return -1;
        }
    for (int c = 0; c < 3; c++)
        images[c] = (uint32_t)v[c];
    return 0;
}

/* Checks a formula that is parsed again where it is used. */
static int check_formula(const char *text, const char **formula, char *error, size_t size)
{
    expression *e = expression_parse(text, error, size);
    if (!e)
        return -1;
    expression_free(e);
    *formula = text;
    return 0;
}

/* Options of spheres. Returns 0, 1 where key is none of them, or -1 with a sentence. */
static int parse_spheres(int key, const char *arg, particle_options *o, char *error, size_t size)
{
    switch (key) {
    case OPTION_SHOW: return add_condition(o, arg, error, size);
    case OPTION_HIDE: return parse_hide(arg, o, error, size);
    case OPTION_SLICE: return parse_slice(arg, o, error, size);
    case OPTION_CUT: return parse_cut(arg, o, error, size);
    case OPTION_RADIUS_BY: return check_formula(arg, &o->radius, error, size);
    case OPTION_RADIUS_SCALE: return program_parse_float(arg, FLT_MIN, 1e30f, &o->radius_scale, error, size);
    case OPTION_TYPE_RADIUS: return parse_type_radius(arg, o, error, size);
    case OPTION_TYPE_COLOR: return parse_type_color(arg, o, error, size);
    case OPTION_TYPE_NAME: return parse_type_name(arg, o, error, size);
    case OPTION_IMAGES: return parse_images(arg, o->images, error, size);
    default: return 1;
    }
}

/* Options of what is drawn beside spheres. Results as parse_spheres. */
static int parse_figures(int key, const char *arg, particle_options *o, char *error, size_t size)
{
    switch (key) {
    case OPTION_BOX: o->box = 1; return arg ? program_parse_float(arg, FLT_MIN, 1e30f, &o->box_radius, error, size) : 0;
    case OPTION_BONDS:
        o->bonds = 1;
        return arg ? program_parse_float(arg, FLT_MIN, 1e18f, &o->bond_distance, error, size) : 0;
    case OPTION_BOND_RADIUS: return program_parse_float(arg, FLT_MIN, 1e30f, &o->bond_radius, error, size);
    case OPTION_BOND_COLOR: o->has_bond_color = 1; return option_parse_color(arg, o->bond_color, error, size);
    case OPTION_ARROWS: o->arrows = arg; return 0;
    case OPTION_ARROW_SCALE: return program_parse_float(arg, -1e30f, 1e30f, &o->arrow_scale, error, size);
    case OPTION_ARROW_RADIUS: return program_parse_float(arg, FLT_MIN, 1e30f, &o->arrow_radius, error, size);
    case OPTION_ARROW_COLOR: o->has_arrow_color = 1; return option_parse_color(arg, o->arrow_color, error, size);
    case OPTION_TRAILS: return program_parse_u32(arg, 1, TRAIL_LONGEST, &o->trails, error, size);
    case OPTION_TRAIL_RADIUS: return program_parse_float(arg, FLT_MIN, 1e30f, &o->trail_radius, error, size);
    case OPTION_TRAIL_COLOR: o->has_trail_color = 1; return option_parse_color(arg, o->trail_color, error, size);
    case OPTION_MESH: o->mesh = arg; return 0;
    case OPTION_MESH_OPACITY: return program_parse_float(arg, 0.001f, 1.0f, &o->mesh_opacity, error, size);
    case OPTION_MESH_COLOR: return option_parse_color(arg, o->mesh_color, error, size);
    default: return 1;
    }
}

static error_t parse_key(int key, char *arg, struct argp_state *state)
{
    particle_options *o = state->input;
    char error[PROGRAM_ERROR_SIZE];
    int result = parse_spheres(key, arg, o, error, sizeof error);
    if (result == 1)
        result = parse_figures(key, arg, o, error, sizeof error);
    for (const struct argp_option *row = table; result < 0 && (row->name || row->doc); row++)
        if (row->key == key && row->name)
            argp_error(state, "--%s: %s", row->name, error);
    return result == 1 ? ARGP_ERR_UNKNOWN : 0;
}

const struct argp particle_options_parser = {table, parse_key, NULL, NULL, NULL, NULL, NULL};

void particle_options_init(particle_options *o)
{
    memset(o, 0, sizeof *o);
    o->radius_scale = o->arrow_scale = 1.0f;
    o->images[0] = o->images[1] = o->images[2] = 1;
    o->bond_radius = 0.15f;
    o->mesh_opacity = 1.0f;
    o->arrow_radius = 0.1f;
    memcpy(o->mesh_color, (const uint8_t[]){0xb8, 0xbc, 0xc2}, sizeof o->mesh_color);
}

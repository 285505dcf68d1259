/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All that may be said of a figure: a new option is a row here, and a member of figure_options. cgt-render and cgt-view
 * take their options from here, with letters and help. */
#include "options/option_row.h"

#include <float.h>
#include <string.h>

#define OPTION_TABLE figure_options /* whose members the rows are about */
#include "options/figure_values.h"
#include "options/option_macros.h"
#include "sequence/trail_history.h"

#define GIVEN(member) .given = offsetof(figure_options, member) + 1
#define OTHERWISE(text) .is_optional = 1, .otherwise = text

const option_row cgt_figure_rows[] = {
    {.help = "Pictures:", .group = 1},
    {"size", 's', "WxH", "Pixels; default 1280x720", WHOLE(cgt_parse_size)},
    {"antialias", 'a', "N", "Trace NxN rays for each pixel: 1, 2 (default) or 4", PARSED(samples, cgt_parse_samples)},
    {.help = "Camera:", .group = 2},
    {"camera", 'c', "EX,EY,EZ,TX,TY,TZ,UX,UY,UZ,FOV",
     "Eye, target, up, vertical angle in degrees; default: shows the whole scene in all frames",
     PARSED(camera, cgt_parse_camera), GIVEN(has_camera)},
    {"camera-keys", 0, "FILE",
     "Key frames of the camera, in lines of FRAME CAMERA [ease|linear|hold]: a frame's number, what -c takes, and how "
     "the camera goes on to the next key: slowly at both ends (default), evenly, not before it",
     WHOLE(cgt_parse_keys)},
    {"orbit", 0, "DEGREES", "Turn around the target by this angle during the run", FLOAT(orbit, -36000.0, 36000.0)},
    {"view", 0, "X,Y,Z|SIDE",
     "Without -c: direction from the scene to the eye, or front, back, right, left, top or bottom; default "
     "0.5,-1,0.45 for up z, 0.5,0.45,1 for up y",
     WHOLE(cgt_parse_view), GIVEN(has_view), .words = VIEW_SIDES},
    {"up", 0, "x|y|z", "Without -c: the axis that points up; default z for spheres, y for triangles",
     PARSED(up, cgt_parse_axis), GIVEN(has_up), .words = "x y z"},
    {"fov", 0, "DEGREES", "Without -c: vertical angle; default 30", FLOAT(fov, 0.1f, 170.0), GIVEN(has_fov)},
    {"zoom", 0, "FACTOR",
     "Without -c: show everything so many times as large, 0.1 to 100, by a narrower or wider angle; 1 shows the whole "
     "scene",
     FLOAT(zoom, 0.1f, 100.0)},
    {.help = "Colours and light:", .group = 3},
    {"color", 'k', "BY",
     "type, element, id, speed, height, one colour as RRGGBB or by name, a column of words, such as chain or resname, "
     "in colours that tell words apart, or a formula over the file's columns, such as c_pe or 'sqrt(vx^2+vy^2)'; or "
     "auto (default): element where the file has some, type where it has several, else "
     "for spheres speed where they move, else id, for triangles dcd3c4",
     WHOLE(cgt_parse_coloring), .words = "auto type element id speed height"},
    {"category", 0, "COLUMN|FORMULA",
     "Colours that tell apart: one for each whole number of a column or formula, such as mol or 'floor(x/10)', or for "
     "each word of a column, as --color=COLUMN has where there are words",
     WHOLE(cgt_parse_category)},
    {"colormap", 0, "NAME|FILE",
     "For values: viridis (default), plasma, cividis, magma, inferno, batlow; for values about 0 coolwarm, vik, "
     "berlin; "
     "for angles romaO, vikO; NAME_r is reversed. Or a file with a colour a line, red, green and blue from 0 to 1 or "
     "to "
     "255, or RRGGBB",
     WHOLE(cgt_parse_colormap), .words = "viridis plasma cividis magma inferno batlow coolwarm vik berlin romaO vikO"},
    {"range", 0, "MIN,MAX|symmetric",
     "Values at the ends of the map; default: the 1 % and the 99 % quantile of the run's values, for speeds 0 and the "
     "99 % quantile; for id and height the whole range. symmetric: as far below 0 as above",
     WHOLE(cgt_parse_range), .words = "symmetric"},
    {"log-scale", 0, NULL, "Equal steps of colour are equal ratios of the value, which is above 0", FLAG(logarithmic)},
    {"light", 0, "X,Y,Z", "Direction towards the light; default: over the first camera's left shoulder",
     PARSED(light, cgt_parse_direction), GIVEN(has_light)},
    {.help = "Input:", .group = 4},
    {"unwrap", 0, NULL,
     "Let spheres go on beyond the periodic box, by image flags (ix, iy, iz) where the file has them, else by "
     "following "
     "them from frame to frame; in the first one molecules are put together by bonds",
     FLAG(unwrap)},
    {"type-element", 0, "TYPE=ELEMENT,...",
     "Which element a type is, by its number, where the file does not tell: 1=O,2=H. Radii, colours, bonds and "
     "formulas "
     "follow",
     PARSED(particles, cgt_parse_type_element), .repeats = 1},
    {"whole", 0, NULL, "Put molecules together that the periodic box cuts, by bonds, each with its middle in the box",
     FLAG(whole)},
    {.help = "Style and light:", .group = 10},
    {"style", 0, "NAME",
     "soft (default): ambient occlusion, a light with shadows; paper: the same on white, with outlines; plain: a light "
     "without shadows, the fastest. The options below change what a style sets",
     WORD(picture.style, STYLE_SOFT, "soft paper plain")},
    {"ambient", 0, "N",
     "Ambient occlusion by N rays for each pixel, 0 (none) to 256; soft and paper: 5, for triangles 16",
     U32(picture.ambient, 0, CGT_PICTURE_MAX_RAYS)},
    {"ambient-radius", 0, "R",
     "What is farther than R world units does not occlude; 0: any distance; default: a quarter of the height that the "
     "camera shows at its target",
     FLOAT(picture.ambient_radius, 0.0, 1e30f)},
    {"shadows", 0, NULL, "Lights cast shadows; default in soft and paper", FLAG(picture.shadows)},
    {"no-shadows", 0, NULL, "Lights shine through everything; default in plain", AT(FLAG, picture.shadows)},
    {"light-size", 0, "SIZE",
     "Soft shadows: radius of a lamp in world units, of other lights in degrees, 0 to 45; default 0: hard ones",
     FLOAT(picture.light_size, 0.0, 45.0)},
    {"light-samples", 0, "N", "Rays for each pixel to a light with a size, 1 to 256; default 8",
     U32(picture.light_samples, 1, CGT_PICTURE_MAX_RAYS)},
    {"light-strength", 0, "S", "Of the first light: 1 shows colours as they are where it falls straight",
     FLOAT(picture.key, 0.0, 100.0)},
    {"fill", 0, "S", "Strength of the light from all sides, which ambient occlusion dims",
     FLOAT(picture.sky, 0.0, 100.0)},
    {"head", 0, "S", "Strength of the light from the eye, without shadows", FLOAT(picture.head, 0.0, 100.0)},
    {"sun", 0, "X,Y,Z[,STRENGTH[,RRGGBB]]",
     "One more light, in this direction from everywhere; default strength 0.4. Up to seven with --lamp",
     PARSED(picture, cgt_parse_sun), .repeats = 1},
    {"lamp", 0, "X,Y,Z[,STRENGTH[,RRGGBB]]", "One more light, at this place; it does not fade",
     PARSED(picture, cgt_parse_lamp), .repeats = 1},
    {.help = "Drawing:", .group = 11},
    {"background", 0, "RRGGBB", "Background colour; default by style", PARSED(picture.background, cgt_parse_color),
     GIVEN(picture.has_background)},
    {"transparent", 0, NULL, "PNG or EXR with alpha: the background is transparent", FLAG(picture.transparent)},
    {"ortho", 0, NULL, "Parallel projection; it shows what the perspective camera shows at its target",
     FLAG(picture.ortho)},
    {"depth-cue", 0, "SHARE",
     "What lies behind the target fades to the background, and what lies before it less; far behind it by this share, "
     "default 0.6",
     FLOAT(picture.cue, 0.0, 1.0), OTHERWISE("0.6")},
    {"outline", 0, "PIXELS", "Dark outlines of this width; default 1", FLOAT(picture.outline, 0.0, 20.0),
     OTHERWISE("1")},
    {"title", 0, "TEXT", "A title over the picture", TEXT(picture.title)},
    {"time", 0, "FORMAT",
     "Time below the picture; {time}, {step} and {frame} in the format are replaced, such as 't = {time} ps'; "
     "{time:.2f} has two decimals in all frames",
     TEXT(picture.time), OTHERWISE("")},
    {"colorbar", 0, "TITLE",
     "A bar with the colours' values, with this title, such as 'speed, nm/ps'; of types, elements and categories a "
     "legend",
     TEXT(picture.bar), OTHERWISE("")},
    {"legend", 0, "TITLE",
     "Swatches with the names of the types, elements or categories that are drawn in any frame, with this title",
     TEXT(picture.legend), OTHERWISE("")},
    {"axes", 0, NULL, "The directions of x, y and z in a corner", FLAG(picture.axes)},
    {"scale-bar", 0, "LENGTH,UNIT",
     "A bar of a round length, or of this one, with a unit such as nm; either may be left out. Without --ortho it is "
     "true "
     "at the depth of the camera's target alone. Where the file has elements lengths are known, and the unit is nm or "
     "Angstrom unless given; else LENGTH is in the file's unit",
     PARSED(picture.scale, cgt_parse_scale_bar), OTHERWISE("")},
    {"label", 0, "FORMULA",
     "Label the spheres for which the formula is not 0, such as 'id == 5' or 'name == CA and resid < 9', at most 300; "
     "those of several formulas. Labels are drawn though something covers the sphere",
     PARSED(picture, cgt_parse_label), .repeats = 1},
    {"label-text", 0, "TEXT",
     "What labels say; columns and formulas in braces are replaced, such as '{name}{resid}'; default: ids, or "
     "indices from 0 where there are none",
     PARSED(picture.label_text, cgt_parse_label_text)},
    {"font", 0, "FILE", "Font of texts; default DejaVu Sans", TEXT(picture.font)},
    {"text-size", 0, "SHARE", "Size of texts as a share of the picture's height; default 0.03",
     FLOAT(picture.text_size, 0.005f, 0.2f)},
    {.help = "What is drawn:", .group = 12},
    {"show", 0, "FORMULA",
     "Only spheres for which the formula is not 0, such as 'type != 2 && z < 5', 'chain == \"A\" and not water' or "
     "'name == CA or resid > 20'. This and the next three may be given several times; a sphere is shown where all "
     "agree",
     PARSED(particles, cgt_parse_show), .repeats = 1},
    {"hide", 0, "TYPES|FORMULA",
     "Leave out spheres of these types or elements, such as 2,3 or H; or those for which a formula is not 0, such as "
     "water",
     PARSED(particles, cgt_parse_hide), .repeats = 1},
    {"slice", 0, "A,B,C,D", "Only spheres whose centres have A x + B y + C z <= D", PARSED(particles, cgt_parse_slice),
     .repeats = 1},
    {"cut", 0, "X0,Y0,Z0,X1,Y1,Z1", "Only spheres whose centres are in this box", PARSED(particles, cgt_parse_cut),
     .repeats = 1},
    {"radius-by", 0, "FORMULA", "Radius of each sphere that --type-radius does not name, such as 'sqrt(c_mass)/2'",
     PARSED(particles.radius, cgt_parse_formula)},
    {"radius-scale", 0, "S", "Multiply all radii, for balls and sticks by 0.3 for example",
     FLOAT(particles.radius_scale, FLT_MIN, 1e30f)},
    {"type-radius", 0, "TYPE=R", "Radius of a type, by its number, or of an element: 2=0.4, O=1.2",
     PARSED(particles, cgt_parse_type_radius), .repeats = 1},
    {"type-color", 0, "TYPE=COLOR",
     "Colour of a type, an element, or a category by its word or number: 2=red, O=00a0ff, ALA=gold",
     PARSED(particles, cgt_parse_type_color), .repeats = 1},
    {"type-name", 0, "TYPE=NAME", "What --legend calls a type, an element or a category: 2=water, A='chain A'",
     PARSED(particles, cgt_parse_type_name), .repeats = 1},
    {"opacity", 0, "WHAT=SHARE",
     "How much of the nearest side of spheres covers what is behind them, above 0 to 1: of a type, an element, those "
     "for "
     "which a formula is not 0, or of bonds, such as 2=0.3, H=0.5, water=0.2, 'chain != \"A\"=0.2', bonds=0.5; the "
     "last "
     "that fits a sphere counts. Bonds are as their more transparent end; at most eight shares",
     PARSED(particles, cgt_parse_opacity), .words = "bonds=0.5 water=0.2", .repeats = 1},
    {"images", 0, "A,B,C",
     "Repeat everything so many times along the edges of the box: what --show, --hide, --slice and --cut leave of the "
     "original",
     PARSED(particles.images, cgt_parse_images)},
    {"box", 0, "RADIUS", "Edges of the simulation box, as tubes of this radius",
     FLOAT(particles.box_radius, FLT_MIN, 1e30f), GIVEN(particles.box), OTHERWISE(NULL)},
    {"bonds", 0, "DISTANCE",
     "Bonds as sticks: those of the file, and those that it does not list by the covalent radii of its elements; or "
     "between spheres whose centres are not farther apart",
     FLOAT(particles.bond_distance, FLT_MIN, 1e18f), GIVEN(particles.bonds), OTHERWISE(NULL)},
    {"bond-radius", 0, "R",
     "Radius of bonds; default: 0.15 Angstrom where there are elements, else 0.3 of the smallest sphere's",
     FLOAT(particles.bond_radius, FLT_MIN, 1e30f)},
    {"bond-color", 0, "RRGGBB", "Colour of bonds; default: half and half those of their ends",
     PARSED(particles.bond_color, cgt_parse_color), GIVEN(particles.has_bond_color)},
    {"arrows", 0, "X,Y,Z",
     "An arrow at each sphere, by three formulas, such as fx,fy,fz; velocity and force stand for vx,vy,vz and fx,fy,fz",
     TEXT(particles.arrows)},
    {"arrow-scale", 0, "S", "World units for each unit of the vectors; default 1",
     FLOAT(particles.arrow_scale, -1e30f, 1e30f)},
    {"arrow-radius", 0, "R", "Radius of arrows' shafts; default: two thirds of that of bonds",
     FLOAT(particles.arrow_radius, FLT_MIN, 1e30f)},
    {"arrow-color", 0, "RRGGBB", "Colour of arrows; default: that of their spheres",
     PARSED(particles.arrow_color, cgt_parse_color), GIVEN(particles.has_arrow_color)},
    {"trails", 0, "N",
     "Where each sphere was in the N frames before, 1 to 1000, as a tube that gets thinner; those frames are read, too",
     U32(particles.trails, 1, TRAIL_LONGEST)},
    {"trail-radius", 0, "R", "Radius of trails at the sphere; default: a fifth of its own",
     FLOAT(particles.trail_radius, FLT_MIN, 1e30f)},
    {"trail-color", 0, "RRGGBB", "Colour of trails; default: that of their spheres",
     PARSED(particles.trail_color, cgt_parse_color), GIVEN(particles.has_trail_color)},
    {"mesh-opacity", 0, "SHARE",
     "How much of its nearest side covers what is behind, above 0 to 1 (default); each frame is then drawn twice",
     FLOAT(particles.mesh_opacity, 0.001f, 1.0)},
    {"mesh-color", 0, "RRGGBB", "Its colour; default b8bcc2", PARSED(particles.mesh_color, cgt_parse_color)},
    {"floor", 0, "COLOR",
     "A floor under everything, with shadows on it in all styles; default: a grey, with --bounces chequered",
     PARSED(floor, cgt_parse_floor), GIVEN(floor.is_set), OTHERWISE(NULL)},
    {"floor-axis", 0, "AXIS",
     "The axis that points up from the floor: x, y, z, -x, -y or -z; default: that nearest to the camera's up",
     WORD(floor.axis, 1, FLOOR_AXES)},
    {"floor-height", 0, "H", "Height of the floor along its axis; default: below the lowest of the run",
     DOUBLE(floor.height, -1e30, 1e30), GIVEN(floor.has_height)},
    {"floor-place", 0, "X,Y,Z,SIZE",
     "The middle of the floor and the extent of what stands on it, which its size follows; default: by a look at the "
     "run",
     PARSED(floor.place, cgt_parse_floor_place), GIVEN(floor.has_place)},
    {.help = "Mirrors and glass:", .group = 14},
    {"bounces", 0, "N", "Follow light through up to N reflections and refractions, with hard shadows; at most 64",
     U32(bounce.bounces, 0, CGT_PICTURE_MAX_BOUNCES), GIVEN(bounce.is_set)},
    {"material", 0, "TYPE=KIND",
     "What a type, by its number, or an element is made of, or all others: matt (default), mirror, glass, glass:INDEX "
     "of refraction, 1.5 unless given, or glass:INDEX:PRIORITY, 0 to 255, where bodies of glass overlap: 2=glass, "
     "Si=mirror, all=glass:1.33. Glass and mirrors have their type's colour",
     PARSED(bounce, cgt_parse_material), .words = "all=matt all=mirror all=glass", .repeats = 1},
};

const size_t cgt_figure_row_count = sizeof cgt_figure_rows / sizeof cgt_figure_rows[0];

const option_row *cgt_figure_find_row(const char *name)
{
    for (size_t i = 0; i < cgt_figure_row_count; i++)
        if (cgt_figure_rows[i].name && strcmp(cgt_figure_rows[i].name, name) == 0)
            return &cgt_figure_rows[i];
    return NULL;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All options of cgt-render: a new one is a row here, and a member of render_options. */
#include "common/options.h"

#include <float.h>

#include "picture/figures/trail_history.h"
#include "render/options/option_parsers.h"
#include "trajectory/trajectory_formats.h"

#define AT(type_, member) .type = OPTION_##type_, .at = offsetof(render_options, member)
#define FLAG(member) AT(FLAG, member), .first = 1
#define TEXT(member) AT(TEXT, member)
#define WORD(member, first_, words_) AT(WORD, member), .first = first_, .words = words_
#define NAME(member, words_) AT(NAME, member), .words = words_
#define FLOAT(member, low_, high_) AT(FLOAT, member), .low = low_, .high = high_
#define DOUBLE(member, low_, high_) AT(DOUBLE, member), .low = low_, .high = high_
#define U32(member, first_, last_) AT(U32, member), .first = first_, .last = last_
#define U64(member, first_, last_) AT(U64, member), .first = first_, .last = last_
#define PARSED(member, function) AT(PARSED, member), .parse = function
#define WHOLE(function) .type = OPTION_PARSED, .parse = function /* its place is all of the options */
#define GIVEN(member) .given = offsetof(render_options, member) + 1
#define OTHERWISE(text) .is_optional = 1, .otherwise = text
#define RUNNING .is_running = 1

static const option_row rows[] = {
    {.help = "Pictures:", .group = 1},
    {"output", 'o', "PATTERN",
     "Names of the pictures, .png, .exr, .jpg or .tif; default out/frame_%04d.png. %04d becomes the frame's number in "
     "the input: 0000, 0001, ...; folders are created. Or a movie, by the program ffmpeg: .mp4, .mov, .mkv, .webm or "
     ".gif. Or - for raw frames on standard output, 3 bytes a pixel. May be given up to four times",
     WHOLE(parse_output), RUNNING},
    {"no-images", 'n', NULL, "Write no pictures: to measure, or for a contact sheet alone", FLAG(no_images), RUNNING},
    {"size", 's', "WxH", "Pixels; default 1280x720", WHOLE(parse_size)},
    {"antialias", 'a', "N", "Trace NxN rays for each pixel: 1 (default), 2 or 4", PARSED(samples, parse_samples)},
    {"contact-sheet", 0, "FILE", "Also write evenly spaced frames, small, as one .png",
     PARSED(contact_sheet, parse_sheet), RUNNING},
    {"sheet-grid", 0, "CxR", "Columns and rows of the contact sheet; default 4x3", WHOLE(parse_grid), RUNNING},
    {.help = "Camera:", .group = 2},
    {"camera", 'c', "EX,EY,EZ,TX,TY,TZ,UX,UY,UZ,FOV",
     "Eye, target, up, vertical angle in degrees; default: shows the whole scene in all frames",
     PARSED(camera, parse_camera), GIVEN(has_camera)},
    {"camera-keys", 0, "FILE",
     "Key frames of the camera, in lines of FRAME CAMERA [ease|linear|hold]: a frame's number, what -c takes, and how "
     "the camera goes on to the next key: slowly at both ends (default), evenly, not before it",
     WHOLE(parse_keys)},
    {"orbit", 0, "DEGREES", "Turn around the target by this angle during the run", FLOAT(orbit, -36000.0, 36000.0)},
    {"view", 0, "X,Y,Z|SIDE",
     "Without -c: direction from the scene to the eye, or front, back, right, left, top or bottom; default "
     "0.5,-1,0.45 for up z, 0.5,0.45,1 for up y",
     WHOLE(parse_view), GIVEN(has_view), .words = VIEW_SIDES},
    {"up", 0, "x|y|z", "Without -c: the axis that points up; default z for spheres, y for triangles",
     PARSED(up, option_parse_axis), GIVEN(has_up), .words = "x y z"},
    {"fov", 0, "DEGREES", "Without -c: vertical angle; default 30", FLOAT(fov, 0.1f, 170.0), GIVEN(has_fov)},
    {"zoom", 0, "FACTOR",
     "Without -c: show everything so many times as large, 0.1 to 100, by a narrower or wider angle; 1 shows the whole "
     "scene",
     FLOAT(zoom, 0.1f, 100.0)},
    {.help = "Colours and light:", .group = 3},
    {"color", 'k', "BY",
     "type, element, id, speed, height, one colour as RRGGBB or by name, or a formula over the file's columns, such as "
     "c_pe or 'sqrt(vx^2+vy^2)'; or auto (default): element where the file has some, type where it has several, else "
     "for spheres speed where they move, else id, for triangles dcd3c4",
     WHOLE(parse_coloring), .words = "auto type element id speed height"},
    {"colormap", 0, "NAME", "For values: viridis (default), plasma, cividis, magma, inferno or batlow",
     PARSED(map, parse_colormap), .words = "viridis plasma cividis magma inferno batlow"},
    {"range", 0, "MIN,MAX",
     "Values at the ends of the map; default: the 1 % and the 99 % quantile of the run's values, for speeds 0 and the "
     "99 % quantile; for id and height the whole range",
     WHOLE(parse_range)},
    {"log-scale", 0, NULL, "Equal steps of colour are equal ratios of the value, which is above 0", FLAG(logarithmic)},
    {"light", 0, "X,Y,Z", "Direction towards the light; default: over the first camera's left shoulder",
     PARSED(light, option_parse_direction), GIVEN(has_light)},
    {.help = "Input:", .group = 4},
    {"first", 0, "N",
     "First frame to render, counted from 0. Numbers in names, automatic camera and colours stay those of the whole "
     "run",
     U64(range.first, 0, UINT64_MAX - 1), RUNNING},
    {"last", 0, "N", "Last frame to render", U64(range.last, 0, UINT64_MAX - 1), RUNNING},
    {"every", 0, "N", "Render every Nth frame", U64(range.every, 1, UINT64_MAX - 1), RUNNING},
    {"radius", 'r', "R",
     "Radius of spheres where the file has none; default: by element, 1 Angstrom in formats of molecular dynamics, "
     "else 0.5",
     FLOAT(reading.radius, FLT_MIN, 1e30f)},
    {"origin", 0, "X,Y,Z",
     "Subtract this in double from all coordinates before they are rounded to single precision; options and results "
     "stay in the file's coordinates. Default: that of a .frames file, else one is found where the scene is far from 0",
     PARSED(reading.origin, option_parse_origin), .given_bool = offsetof(render_options, reading.has_origin) + 1},
    {"wrapped", 0, NULL, "Prefer coordinates wrapped into the box where a file has both kinds",
     AT(BOOL, reading.wrapped)},
    {"unwrap", 0, NULL,
     "Let spheres go on beyond the periodic box, by image flags (ix, iy, iz) where the file has them, else by "
     "following them from frame to frame; in the first one molecules are put together by bonds",
     FLAG(unwrap)},
    {"whole", 0, NULL, "Put molecules together that the periodic box cuts, by bonds, each with its middle in the box",
     FLAG(whole)},
    {"fps", 0, "N", "Frames per second of a mesh's animation; default 30", DOUBLE(reading.fps, 1e-3f, 1e6f)},
    {"clip", 0, "NAME", "Animation of a mesh, by its name or its number from 0; default: the first",
     TEXT(reading.clip)},
    {"format", 0, "NAME",
     "Format of the input whatever its name: " TRAJECTORY_FORMATS "; default: by the name, else by the first bytes",
     TEXT(reading.format), .words = TRAJECTORY_FORMATS},
    {"no-limit", 0, NULL, "Read files that unpack or expand to more than 1 GiB and 500 times their size",
     AT(BOOL, reading.no_limit)},
    {"topology", 0, "FILE",
     "A file whose first frame tells the elements, types and bonds of the spheres, where the trajectory does not",
     TEXT(reading.topology)},
    {"follow", 0, "SECONDS",
     "At the end wait so long for more, of a run that is still being written; the automatic camera and colours are "
     "those of the frames that are there at the start",
     DOUBLE(reading.follow, 0.05f, 1e9f), RUNNING},
    {.help = "Running:", .group = 5},
    {"threads", 't', "N",
     "Threads that build and trace, and read large frames of text; 0 (default): one per CPU. One more reads ahead, and "
     "as many, at most 8, write pictures: three frames of the input and up to ten pictures are in memory",
     U32(threads, 0, 1024), RUNNING},
    {"memory", 0, "MIB",
     "Frames that were read for the automatic camera and colours are kept in so much memory, so that they are not read "
     "again; default: a quarter of the machine's",
     U32(memory_mib, 0, 1u << 24), RUNNING},
    {"variant", 0, "NAME", "Kernels to use; default: the widest that this CPU runs", TEXT(variant), RUNNING},
    {"stats", 0, NULL, "Print counts of structure and rays; counting makes tracing slower", FLAG(stats), RUNNING},
    {"log-file", 0, "FILE", "Write a line of times for each frame, tab-separated", TEXT(log_file), RUNNING},
    {"settings", 0, "FILE",
     "Read options from a file of lines such as 'style = paper'; those of the command line override them",
     TEXT(settings_file), RUNNING},
    {"print-settings", 0, NULL,
     "Print the options of this command line as a settings file, the others as comments, and end", FLAG(print_settings),
     RUNNING},
    {"quiet", 'q', NULL, "No progress", FLAG(quiet), RUNNING},
    {"verbose", 'v', NULL, "Show the library's log", FLAG(verbose), RUNNING},
    {.help = "Movies and parts of runs:", .group = 6},
    {"rate", 0, "N", "Frames per second of movies; default 30", DOUBLE(output.rate, 1e-3f, 1000.0)},
    {"quality", 0, "N",
     "Quality of movies and .jpg, 1 (smallest files) to 100 (best); default 80 of movies, 92 of .jpg",
     U32(output.quality, 1, 100)},
    {"preset", 0, "NAME", "Effort of x264, from ultrafast to veryslow: smaller files for more time; default veryfast",
     NAME(output.preset, "ultrafast superfast veryfast faster fast medium slow slower veryslow")},
    {"part", 0, "K/N",
     "Render the Kth of N parts of the run, with the names, camera and colours of the whole: for N processes, each "
     "with "
     "a K of its own",
     PARSED(output, parse_part), RUNNING},
    {"survey", 0, "N",
     "Look only at the first N frames for automatic camera and colours; default: at all, which reads the input twice",
     U64(output.survey, 1, UINT64_MAX - 1)},
    {.help = "Style and light:", .group = 10},
    {"style", 0, "NAME",
     "soft (default): ambient occlusion, a light with shadows; paper: the same on white, with outlines; plain: a light "
     "without shadows, the fastest. The options below change what a style sets",
     WORD(picture.style, STYLE_SOFT, "soft paper plain")},
    {"ambient", 0, "N",
     "Ambient occlusion by N rays for each pixel, 0 (none) to 256; soft and paper: 5, for files of meshes 16",
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
     PARSED(picture, parse_sun)},
    {"lamp", 0, "X,Y,Z[,STRENGTH[,RRGGBB]]", "One more light, at this place; it does not fade",
     PARSED(picture, parse_lamp)},
    {.help = "Drawing:", .group = 11},
    {"background", 0, "RRGGBB", "Background colour; default by style", PARSED(picture.background, option_parse_color),
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
     "Time below the picture; {time}, {step} and {frame} in the format are replaced, such as 't = {time} ps'",
     TEXT(picture.time), OTHERWISE("")},
    {"colorbar", 0, "TITLE",
     "A bar with the colours' values, with this title, such as 'speed, nm/ps'; of types and elements a legend",
     TEXT(picture.bar), OTHERWISE("")},
    {"legend", 0, "TITLE",
     "Swatches with the names of the types or elements that are drawn in any frame, with this title",
     TEXT(picture.legend), OTHERWISE("")},
    {"axes", 0, NULL, "The directions of x, y and z in a corner", FLAG(picture.axes)},
    {"font", 0, "FILE", "Font of texts; default DejaVu Sans", TEXT(picture.font)},
    {"no-metadata", 0, NULL, "Pictures do not say how they were made", FLAG(picture.no_metadata), RUNNING},
    {"text-size", 0, "SHARE", "Size of texts as a share of the picture's height; default 0.03",
     FLOAT(picture.text_size, 0.005f, 0.2f)},
    {.help = "What is drawn:", .group = 12},
    {"show", 0, "FORMULA",
     "Only spheres for which the formula is not 0, such as 'type != 2 && z < 5', 'chain == \"A\" and not water' or "
     "'name == CA or resid > 20'. This and the next three may be given several times; a sphere is shown where all "
     "agree",
     PARSED(particles, add_condition)},
    {"hide", 0, "TYPES|FORMULA",
     "Leave out spheres of these types or elements, such as 2,3 or H; or those for which a formula is not 0, such as "
     "water",
     PARSED(particles, parse_hide)},
    {"slice", 0, "A,B,C,D", "Only spheres whose centres have A x + B y + C z <= D", PARSED(particles, parse_slice)},
    {"cut", 0, "X0,Y0,Z0,X1,Y1,Z1", "Only spheres whose centres are in this box", PARSED(particles, parse_cut)},
    {"radius-by", 0, "FORMULA", "Radius of each sphere, such as 'sqrt(c_mass)/2'",
     PARSED(particles.radius, parse_formula)},
    {"radius-scale", 0, "S", "Multiply all radii, for balls and sticks by 0.3 for example",
     FLOAT(particles.radius_scale, FLT_MIN, 1e30f)},
    {"type-radius", 0, "TYPE=R", "Radius of a type, by its number, or of an element: 2=0.4, O=1.2",
     PARSED(particles, parse_type_radius)},
    {"type-color", 0, "TYPE=COLOR", "Colour of a type or an element: 2=red, O=00a0ff",
     PARSED(particles, parse_type_color)},
    {"type-name", 0, "TYPE=NAME", "What --legend calls a type or an element: 2=water",
     PARSED(particles, parse_type_name)},
    {"images", 0, "A,B,C", "Repeat everything so many times along the edges of the box",
     PARSED(particles.images, parse_images)},
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
     PARSED(particles.bond_color, option_parse_color), GIVEN(particles.has_bond_color)},
    {"arrows", 0, "X,Y,Z",
     "An arrow at each sphere, by three formulas, such as fx,fy,fz; velocity and force stand for vx,vy,vz and fx,fy,fz",
     TEXT(particles.arrows)},
    {"arrow-scale", 0, "S", "World units for each unit of the vectors; default 1",
     FLOAT(particles.arrow_scale, -1e30f, 1e30f)},
    {"arrow-radius", 0, "R", "Radius of arrows' shafts; default: two thirds of that of bonds",
     FLOAT(particles.arrow_radius, FLT_MIN, 1e30f)},
    {"arrow-color", 0, "RRGGBB", "Colour of arrows; default: that of their spheres",
     PARSED(particles.arrow_color, option_parse_color), GIVEN(particles.has_arrow_color)},
    {"trails", 0, "N",
     "Where each sphere was in the N frames before, 1 to 1000, as a tube that gets thinner; those frames are read, too",
     U32(particles.trails, 1, TRAIL_LONGEST)},
    {"trail-radius", 0, "R", "Radius of trails at the sphere; default: a fifth of its own",
     FLOAT(particles.trail_radius, FLT_MIN, 1e30f)},
    {"trail-color", 0, "RRGGBB", "Colour of trails; default: that of their spheres",
     PARSED(particles.trail_color, option_parse_color), GIVEN(particles.has_trail_color)},
    {"mesh", 0, "FILE", "A mesh that stands still among the spheres, such as the walls of a drum",
     TEXT(particles.mesh)},
    {"mesh-opacity", 0, "SHARE",
     "How much of its nearest side covers what is behind, above 0 to 1 (default); each frame is then drawn twice",
     FLOAT(particles.mesh_opacity, 0.001f, 1.0)},
    {"mesh-color", 0, "RRGGBB", "Its colour; default b8bcc2", PARSED(particles.mesh_color, option_parse_color)},
    {"floor", 0, "COLOR",
     "A floor under everything, with shadows on it in all styles; default: a grey, with --bounces chequered",
     PARSED(floor, parse_floor), GIVEN(floor.is_set), OTHERWISE(NULL)},
    {"floor-axis", 0, "AXIS",
     "The axis that points up from the floor: x, y, z, -x, -y or -z; default: that nearest to the camera's up",
     WORD(floor.axis, 1, FLOOR_AXES)},
    {"floor-height", 0, "H", "Height of the floor along its axis; default: below the lowest of the run",
     DOUBLE(floor.height, -1e30, 1e30), GIVEN(floor.has_height)},
    {"floor-place", 0, "X,Y,Z,SIZE",
     "The middle of the floor and the extent of what stands on it, which its size follows; default: by a look at the "
     "run",
     PARSED(floor.place, parse_floor_place), GIVEN(floor.has_place)},
    {.help = "On an emulated Cell:", .group = 15},
    {"cell", 0, "native|sim|real",
     "Trace spheres by Chapman's program on SPEs of 256 KB each, to the same picture: native, the program compiled for "
     "this machine, or sim, the SPU's own, by instructions and cycles, seconds a frame; real: that on SPEs of this "
     "machine",
     WORD(cell.mode, RENDER_CELL_NATIVE, "native sim real")},
    {"spes", 0, "N", "SPEs, 1 to 16; default 6. Without --cell: native", U32(cell.spes, 1, 16)},
    {"cell-assignment", 0, "NAME", "Who traces which strip: interleaved (default), static, dynamic or hybrid",
     WORD(cell.assignment, 0, RENDER_CELL_ASSIGNMENTS)},
    {"cell-program", 0, "FILE", "Of sim and real: spe_grid.elf; default: the installed one", TEXT(cell.program)},
    {.help = "Mirrors and glass:", .group = 14},
    {"bounces", 0, "N", "Follow light through up to N reflections and refractions, with hard shadows; at most 64",
     U32(bounce.bounces, 0, CGT_PICTURE_MAX_BOUNCES), GIVEN(bounce.is_set)},
    {"material", 0, "TYPE=KIND",
     "What a type, by its number, or an element is made of, or all others: matt (default), mirror, glass, glass:INDEX "
     "of refraction, 1.5 unless given, or glass:INDEX:PRIORITY, 0 to 255, where bodies of glass overlap: 2=glass, "
     "Si=mirror, all=glass:1.33. Glass and mirrors have their type's colour",
     PARSED(bounce, parse_material), .words = "all=matt all=mirror all=glass"},
};

const option_table render_option_table = {
    .rows = rows,
    .count = sizeof rows / sizeof rows[0],
    .arguments = "TRAJECTORY...",
    .text =
        "Renders the moving spheres or triangles of a trajectory (" TRAJECTORY_ENDINGS "); or a "
        "mesh with its animation: .obj, .ply, .gltf, .dae, .x, .ifc and others. Several files, one for each step, are "
        "one run, in the order of the numbers in their names; - is standard input, and needs --format.\v"
        "The structure is built anew for every frame. Exit codes: 0 all frames were rendered, 1 something failed, 2 "
        "the command line is wrong.\n\n"
        "Example: cgt-render -s 1920x1080 -a 2 --orbit 90 -o out/pour_%04d.png pour.lammpstrj\n"
        "         cgt-render -o pour.mp4 pour.lammpstrj",
    .finish = render_options_finish,
};

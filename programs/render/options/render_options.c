/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The command line of cgt-render; see render_options.h. Parsed by argp, which is part of glibc. */
#define _GNU_SOURCE
#include "render/options/render_options.h"

#include <argp.h>
#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "playback/camera_path.h"
#include "picture/overlay/contact_sheet.h"
#include "picture/files/image_write.h"
#include "picture/files/movie.h"
#include "common/program.h"
#include "render/options/settings/option_values.h"
#include "render/options/settings/settings_file.h"

enum {
    OPTION_ORBIT = 256,
    OPTION_VIEW,
    OPTION_UP,
    OPTION_FOV,
    OPTION_COLORMAP,
    OPTION_RANGE,
    OPTION_LOG_SCALE,
    OPTION_LIGHT,
    OPTION_FIRST,
    OPTION_LAST,
    OPTION_EVERY,
    OPTION_SHEET,
    OPTION_SHEET_GRID,
    OPTION_LOG_FILE,
    OPTION_STATS,
    OPTION_VARIANT,
    OPTION_WRAPPED,
    OPTION_FPS,
    OPTION_CLIP,
    OPTION_FORMAT,
    OPTION_FOLLOW,
    OPTION_KEYS,
    OPTION_TOPOLOGY,
    OPTION_SETTINGS,
    OPTION_PRINT_SETTINGS
};

static const struct argp_option table[] = {
    {NULL, 0, NULL, 0, "Pictures:", 1},
    {"output", 'o', "PATTERN", 0,
     "Names of the pictures, .png, .exr, .jpg or .tif; default out/frame_%04d.png. %04d becomes the frame's number in "
     "the input: 0000, 0001, ...; folders are created. Or a movie, by the program ffmpeg: .mp4, .mov, .mkv, .webm or "
     ".gif. Or - for raw frames on standard output, 3 bytes a pixel. May be given up to four times",
     0},
    {"no-images", 'n', NULL, 0, "Write no pictures: to measure, or for a contact sheet alone", 0},
    {"size", 's', "WxH", 0, "Pixels; default 1280x720", 0},
    {"antialias", 'a', "N", 0, "Trace NxN rays for each pixel: 1 (default), 2 or 4", 0},
    {"contact-sheet", OPTION_SHEET, "FILE", 0, "Also write evenly spaced frames, small, as one .png", 0},
    {"sheet-grid", OPTION_SHEET_GRID, "CxR", 0, "Columns and rows of the contact sheet; default 4x3", 0},
    {NULL, 0, NULL, 0, "Camera:", 2},
    {"camera", 'c', "EX,EY,EZ,TX,TY,TZ,UX,UY,UZ,FOV", 0,
     "Eye, target, up, vertical angle in degrees; default: shows the whole scene in all frames", 0},
    {"camera-keys", OPTION_KEYS, "FILE", 0,
     "Key frames of the camera, in lines of FRAME CAMERA [ease|linear|hold]: a frame's number, what -c takes, and how "
     "the "
     "camera goes on to the next key: slowly at both ends (default), evenly, not before it",
     0},
    {"orbit", OPTION_ORBIT, "DEGREES", 0, "Turn around the target by this angle during the run", 0},
    {"view", OPTION_VIEW, "X,Y,Z", 0,
     "Without -c: direction from the scene to the eye; default 0.5,-1,0.45 for up z, 0.5,0.45,1 for up y", 0},
    {"up", OPTION_UP, "x|y|z", 0, "Without -c: the axis that points up; default z for spheres, y for triangles", 0},
    {"fov", OPTION_FOV, "DEGREES", 0, "Without -c: vertical angle; default 30", 0},
    {NULL, 0, NULL, 0, "Colours and light:", 3},
    {"color", 'k', "BY", 0,
     "type, element, id, speed, height, one colour as RRGGBB or by name, or a formula over the file's columns, such as "
     "c_pe or 'sqrt(vx^2+vy^2)'; or auto (default): element where the file has some, type where it has several, else "
     "for "
     "spheres speed where they move, else id, for triangles dcd3c4",
     0},
    {"colormap", OPTION_COLORMAP, "NAME", 0, "For values: viridis (default), plasma, cividis, magma, inferno or batlow",
     0},
    {"range", OPTION_RANGE, "MIN,MAX", 0,
     "Values at the ends of the map; default: the range of the run, for speeds 0 to the 99 % quantile", 0},
    {"log-scale", OPTION_LOG_SCALE, NULL, 0, "Equal steps of colour are equal ratios of the value, which is above 0",
     0},
    {"light", OPTION_LIGHT, "X,Y,Z", 0, "Direction towards the light; default: over the first camera's left shoulder",
     0},
    {NULL, 0, NULL, 0, "Input:", 4},
    {"first", OPTION_FIRST, "N", 0,
     "First frame to render, counted from 0. Numbers in names, automatic camera and colours stay those of the whole "
     "run",
     0},
    {"last", OPTION_LAST, "N", 0, "Last frame to render", 0},
    {"every", OPTION_EVERY, "N", 0, "Render every Nth frame", 0},
    {"radius", 'r', "R", 0,
     "Radius of spheres where the file has none; default: by element, 1 Angstrom in formats of molecular dynamics, "
     "else 0.5",
     0},
    {"wrapped", OPTION_WRAPPED, NULL, 0, "Prefer coordinates wrapped into the box where a file has both kinds", 0},
    {"fps", OPTION_FPS, "N", 0, "Frames per second of a mesh's animation; default 30", 0},
    {"clip", OPTION_CLIP, "NAME", 0, "Animation of a mesh, by its name or its number from 0; default: the first", 0},
    {"format", OPTION_FORMAT, "NAME", 0,
     "Format of the input whatever its name: " TRAJECTORY_FORMATS "; default: by the name's ending", 0},
    {"topology", OPTION_TOPOLOGY, "FILE", 0,
     "A file whose first frame tells the elements, types and bonds of the spheres, where the trajectory does not", 0},
    {"follow", OPTION_FOLLOW, "SECONDS", 0,
     "At the end wait so long for more, of a run that is still being written; the automatic camera and colours are "
     "those "
     "of the frames that are there at the start",
     0},
    {NULL, 0, NULL, 0, "Running:", 5},
    {"threads", 't', "N", 0,
     "Threads that build and trace, and read large frames of text; 0 (default): one per CPU. One more reads ahead, and "
     "as "
     "many, at most 8, write pictures: three frames of the input and up to ten pictures are in memory",
     0},
    {"variant", OPTION_VARIANT, "NAME", 0, "Kernels to use; default: the widest that this CPU runs", 0},
    {"stats", OPTION_STATS, NULL, 0, "Print counts of structure and rays; counting makes tracing slower", 0},
    {"log-file", OPTION_LOG_FILE, "FILE", 0, "Write a line of times for each frame, tab-separated", 0},
    {"settings", OPTION_SETTINGS, "FILE", 0,
     "Read options from a file of lines such as 'style = paper'; those of the command line override them", 0},
    {"print-settings", OPTION_PRINT_SETTINGS, NULL, 0,
     "Print the options of this command line as a settings file, the others as comments, and end", 0},
    {"quiet", 'q', NULL, 0, "No progress", 0},
    {"verbose", 'v', NULL, 0, "Show the library's log", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

/* Two whole numbers with an x between them. */
static int parse_grid(const char *text, uint32_t *columns, uint32_t *rows, char *error, size_t error_size)
{
    char first[16];
    const char *x = strchr(text, 'x');
    if (!x || (size_t)(x - text) >= sizeof first) {
        snprintf(error, error_size, "\"%s\" is not of the form 4x3", text);
        return -1;
    }
    memcpy(first, text, (size_t)(x - text));
    first[x - text] = '\0';
    return program_parse_u32(first, 1, CONTACT_SHEET_MAX_EDGE, columns, error, error_size) ||
                   program_parse_u32(x + 1, 1, CONTACT_SHEET_MAX_EDGE, rows, error, error_size)
               ? -1
               : 0;
}

render_output render_output_kind(const char *pattern)
{
    if (strcmp(pattern, "-") == 0)
        return OUTPUT_RAW;
    if (movie_is_name(pattern))
        return OUTPUT_MOVIE;
    return image_format_of(pattern) != IMAGE_NONE ? OUTPUT_PICTURE : OUTPUT_NONE;
}

static int parse_output(const char *text, render_options *o, char *error, size_t error_size)
{
    if (o->output_count == RENDER_MAX_OUTPUTS) {
        snprintf(error, error_size, "more than %d patterns", RENDER_MAX_OUTPUTS);
        return -1;
    }
    if (out_path_parse(&o->outputs[o->output_count], text, error, error_size))
        return -1;
    const render_output kind = render_output_kind(text);
    if (kind == OUTPUT_NONE) {
        snprintf(error, error_size,
                 "\"%s\" ends in none of .png, .exr, .jpg, .tif, .mp4, .mov, .mkv, .webm, .gif, and is not -", text);
        return -1;
    }
    if (kind == OUTPUT_MOVIE && o->outputs[o->output_count].numbered) {
        snprintf(error, error_size, "\"%s\": a movie has all frames and no number", text);
        return -1;
    }
    o->output_count++;
    return 0;
}

static int parse_samples(const char *text, uint32_t *samples, char *error, size_t error_size)
{
    uint32_t n;
    if (program_parse_u32(text, 1, 4, &n, error, error_size))
        return -1;
    if (n == 3) {
        snprintf(error, error_size, "3 is not 1, 2 or 4");
        return -1;
    }
    *samples = n;
    return 0;
}

static int parse_sheet(const char *text, const char **file, char *error, size_t error_size)
{
    if (!out_path_ends_in(text, ".png")) {
        snprintf(error, error_size, "\"%s\" does not end in .png", text);
        return -1;
    }
    *file = text;
    return 0;
}

static int read_keys(const char *path, render_options *o, char *error, size_t error_size)
{
    camera_keys_free(&o->keys);
    if (camera_keys_read(&o->keys, path, error, error_size))
        return -1;
    o->has_camera = 1;
    o->camera = o->keys.key[0].camera;
    return 0;
}

typedef struct parse_state {
    render_options *options;
    int no_images;
    int has_view, has_up, has_fov;
    int print_settings;
} parse_state;

/* Options of pictures. Returns 0, 1 where key is none of them, or -1 with a sentence. */
static int parse_picture(int key, const char *arg, parse_state *s, char *error, size_t size)
{
    render_options *o = s->options;
    switch (key) {
    case 'o': return parse_output(arg, o, error, size);
    case 'n': s->no_images = 1; return 0;
    case 's': return program_parse_size(arg, &o->width, &o->height, error, size);
    case 'a': return parse_samples(arg, &o->samples, error, size);
    case OPTION_SHEET: return parse_sheet(arg, &o->contact_sheet, error, size);
    case OPTION_SHEET_GRID: return parse_grid(arg, &o->sheet_columns, &o->sheet_rows, error, size);
    case 'c': o->has_camera = 1; return program_parse_camera(arg, &o->camera, error, size);
    case OPTION_KEYS: return read_keys(arg, o, error, size);
    case OPTION_ORBIT: return program_parse_float(arg, -36000.0f, 36000.0f, &o->orbit, error, size);
    case OPTION_VIEW: s->has_view = 1; return option_parse_direction(arg, o->view, error, size);
    case OPTION_UP: s->has_up = 1; return option_parse_axis(arg, o->up, error, size);
    case OPTION_FOV: s->has_fov = 1; return program_parse_float(arg, 0.1f, 170.0f, &o->fov, error, size);
    case 'k': return render_options_parse_color(arg, o, error, size);
    case OPTION_COLORMAP: return render_options_parse_colormap(arg, &o->map, error, size);
    case OPTION_RANGE: return render_options_parse_range(arg, o, error, size);
    case OPTION_LOG_SCALE: o->logarithmic = 1; return 0;
    case OPTION_LIGHT: o->has_light = 1; return option_parse_direction(arg, o->light, error, size);
    default: return 1;
    }
}

static int parse_double(const char *text, float min, float max, double *number, char *error, size_t error_size)
{
    float value;
    if (program_parse_float(text, min, max, &value, error, error_size))
        return -1;
    *number = (double)value;
    return 0;
}

/* Options of input and execution. Results as parse_picture. */
static int parse_run(int key, const char *arg, parse_state *s, char *error, size_t size)
{
    render_options *o = s->options;
    switch (key) {
    case OPTION_FIRST: return program_parse_u64(arg, 0, UINT64_MAX - 1, &o->range.first, error, size);
    case OPTION_LAST: return program_parse_u64(arg, 0, UINT64_MAX - 1, &o->range.last, error, size);
    case OPTION_EVERY: return program_parse_u64(arg, 1, UINT64_MAX - 1, &o->range.every, error, size);
    case 'r': return program_parse_float(arg, FLT_MIN, 1e30f, &o->reading.radius, error, size);
    case OPTION_WRAPPED: o->reading.wrapped = 1; return 0;
    case OPTION_FPS: return parse_double(arg, 1e-3f, 1e6f, &o->reading.fps, error, size);
    case OPTION_FORMAT: o->reading.format = arg; return 0;
    case OPTION_TOPOLOGY: o->reading.topology = arg; return 0;
    case OPTION_FOLLOW: return parse_double(arg, 0.05f, 1e9f, &o->reading.follow, error, size);
    case OPTION_CLIP: o->reading.clip = arg; return 0;
    case 't': return program_parse_u32(arg, 0, 1024, &o->threads, error, size);
    case OPTION_VARIANT: o->variant = arg; return 0;
    case OPTION_STATS: o->stats = 1; return 0;
    case OPTION_LOG_FILE: o->log_file = arg; return 0;
    case OPTION_SETTINGS: return 0; /* its options are on the command line by now */
    case OPTION_PRINT_SETTINGS: s->print_settings = 1; return 0;
    case 'q': o->quiet = 1; return 0;
    case 'v': o->verbose = 1; return 0;
    default: return 1;
    }
}

static const char *option_name(int key)
{
    for (const struct argp_option *row = table; row->name || row->doc; row++)
        if (row->key == key && row->name)
            return row->name;
    return "option";
}

static int is_zero(const float v[3]) { return v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f; }

void render_options_axes(render_options *options, trajectory_kind kind)
{
    float *up = options->up, *view = options->view;
    if (is_zero(up)) {
        const int axis = kind == TRAJECTORY_TRIANGLES ? 1 : 2;
        up[axis] = 1.0f;
        if (!is_zero(view) && camera_path_is_along(view, up)) {
            up[axis] = 0.0f;
            up[3 - axis] = 1.0f;
        }
    }
    if (!is_zero(view))
        return;
    const int axis = up[0] != 0.0f ? 0 : up[1] != 0.0f ? 1 : 2;
    view[axis] = 0.45f;
    view[(axis + 1) % 3] = axis == 2 ? 0.5f : 1.0f;
    view[(axis + 2) % 3] = axis == 2 ? -1.0f : 0.5f;
}

/* Checks that need the whole command line. */
static void finish(struct argp_state *state, parse_state *s)
{
    render_options *o = s->options;
    char error[PROGRAM_ERROR_SIZE];
    picture_options_finish(&o->picture);
    if (!o->input && !s->print_settings)
        argp_error(state, "no trajectory: give a .lammpstrj, .xyz or .frames file, or a mesh");
    if (s->no_images && o->output_count)
        argp_error(state, "--output and --no-images exclude each other");
    if (!s->no_images && !o->output_count && parse_output("out/frame_%04d.png", o, error, sizeof error))
        argp_error(state, "%s", error);
    if (o->logarithmic && o->has_range && !(o->range_min > 0.0f))
        argp_error(state, "--log-scale: the range must be above 0");
    for (uint32_t i = 0; i < o->output_count && o->picture.transparent; i++)
        if (image_format_of(o->outputs[i].pattern) != IMAGE_PNG && image_format_of(o->outputs[i].pattern) != IMAGE_EXR)
            argp_error(state, "--transparent: \"%s\" holds no opacity; .png and .exr do", o->outputs[i].pattern);
    if (o->keys.count && o->orbit != 0.0f)
        argp_error(state, "--camera-keys and --orbit exclude each other");
    if (o->range.last < o->range.first)
        argp_error(state, "--last is before --first");
    if ((uint64_t)o->width * o->height * o->samples * o->samples > RENDER_MAX_PIXELS ||
        o->width > RENDER_MAX_EDGE / o->samples || o->height > RENDER_MAX_EDGE / o->samples)
        argp_error(state, "%ux%u pixels of %ux%u rays: at most %d an edge and %llu in all", o->width, o->height,
                   o->samples, o->samples, RENDER_MAX_EDGE, (unsigned long long)RENDER_MAX_PIXELS);
    if (o->has_camera && (s->has_view || s->has_up || s->has_fov))
        argp_error(state, "--view, --up and --fov are for the automatic camera and exclude --camera");
    if (s->has_view && s->has_up && camera_path_is_along(o->view, o->up))
        argp_error(state, "--view: the direction must not be along the axis that points up");
}

static error_t parse_key(int key, char *arg, struct argp_state *state)
{
    parse_state *s = state->input;
    char error[PROGRAM_ERROR_SIZE];
    if (key == ARGP_KEY_ARGS) {
        s->options->inputs = (const char **)(void *)(state->argv + state->next);
        s->options->input_count = (size_t)(state->argc - state->next);
        s->options->input = s->options->inputs[0];
        return 0;
    }
    if (key == ARGP_KEY_INIT) {
        state->child_inputs[0] = &s->options->output;
        state->child_inputs[1] = &s->options->picture;
        state->child_inputs[2] = &s->options->particles;
        state->child_inputs[3] = &s->options->cell;
        state->child_inputs[4] = &s->options->bounce;
        return 0;
    }
    if (key == ARGP_KEY_END) {
        finish(state, s);
        return 0;
    }
    int result = parse_picture(key, arg, s, error, sizeof error);
    if (result == 1)
        result = parse_run(key, arg, s, error, sizeof error);
    if (result < 0)
        argp_error(state, "--%s: %s", option_name(key), error);
    return result == 1 ? ARGP_ERR_UNKNOWN : 0;
}

void render_options_parse(render_options *options, int argc, char **argv)
{
    static const struct argp_child children[] = {
        {&output_options_argp, 0, NULL, 0},     {&picture_options_parser, 0, NULL, 0},
        {&particle_options_parser, 0, NULL, 0}, {&render_cell_argp, 0, NULL, 0},
        {&bounce_options_parser, 0, NULL, 0},   {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        table,
        parse_key,
        "TRAJECTORY...",
        "Renders the moving spheres or triangles of a trajectory (" TRAJECTORY_ENDINGS "); or a "
        "mesh with its animation: .obj, .ply, .gltf, .dae, .x, .ifc and others. Several files, one for each step, are "
        "one "
        "run, in the order of the numbers in their names; - is standard input, and needs --format.\v"
        "The structure is built anew for every frame. Exit codes: 0 all frames were rendered, 1 something failed, 2 "
        "the "
        "command line is wrong.\n\n"
        "Example: cgt-render -s 1920x1080 -a 2 --orbit 90 -o out/pour_%04d.png pour.lammpstrj\n"
        "         cgt-render -o pour.mp4 pour.lammpstrj",
        children,
        NULL,
        NULL};
    parse_state state = {options, 0, 0, 0, 0, 0};
    settings_arguments arguments;
    char error[PROGRAM_ERROR_SIZE];
    memset(options, 0, sizeof *options);
    trajectory_options_init(&options->reading);
    output_options_init(&options->output);
    options->reading.fps = 0.0; /* not given: the reader's default */
    cgt_camera_init(&options->camera);
    options->range = (frame_range){0, UINT64_MAX - 1, 1};
    options->sheet_columns = 4;
    options->sheet_rows = 3;
    options->width = 1280;
    options->height = 720;
    options->samples = 1;
    options->fov = 30.0f;
    memcpy(options->plain, (const float[]){0xdc / 255.0f, 0xd3 / 255.0f, 0xc4 / 255.0f}, sizeof options->plain);
    picture_options_init(&options->picture);
    particle_options_init(&options->particles);
    if (settings_expand(argc, argv, &arguments, error, sizeof error)) {
        program_error("--settings: %s", error);
        exit(PROGRAM_USAGE);
    }
    argp_parse(&parser, arguments.argc, arguments.argv, 0, NULL, &state);
    options->settings = settings_text(&parser, arguments.argc, arguments.argv, state.print_settings);
    if (!state.print_settings)
        return;
    printf("%s", options->settings ? options->settings : "");
    exit(program_exit(options->settings ? PROGRAM_OK : PROGRAM_FAILED));
}

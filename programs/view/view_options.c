/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The command line of cgt-view; see view_options.h. */
#include "view/view_options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/out_path.h"
#include "common/program.h"
#include "picture/files/image_write.h"
#include "render/options/settings_arguments.h"

static const char is_of_files[] = "this is for the files that cgt-render writes";
static const char is_of_hand[] = "the hand moves the camera; the key k adds key frames for cgt-render's --camera-keys";
static const char is_of_cell[] = "an emulated Cell takes seconds for a picture: cgt-render has it";

/* Rows of cgt-render that a window has no use for, and why. */
static const struct {
    const char *name, *why;
} left_out[] = {{"output", is_of_files},
                {"no-images", is_of_files},
                {"contact-sheet", is_of_files},
                {"sheet-grid", is_of_files},
                {"stats", is_of_files},
                {"log-file", is_of_files},
                {"quiet", is_of_files},
                {"preset", is_of_files},
                {"part", is_of_files},
                {"camera-keys", is_of_hand},
                {"print-settings", is_of_files},
                {"orbit", is_of_hand},
                {"cell", is_of_cell},
                {"spes", is_of_cell},
                {"cell-assignment", is_of_cell},
                {"cell-program", is_of_cell}};

#ifdef CGT_HAVE_PANEL
#define PANEL ", o opens a panel of all options"
#else
#define PANEL ". This build has no panel of options: it needs Dear ImGui"
#endif
#define AT(type_, member) .type = OPTION_##type_, .at = offsetof(view_options, member)

static const option_row own_rows[] = {
    {.help = "Window:", .group = 7},
    {"budget", 0, "MS",
     "Milliseconds that a picture may take while something moves: where shadows take longer they are left out, then "
     "pixels; default 16.7, for 60 pictures a second",
     AT(FLOAT, budget), .low = 1.0, .high = 1e6, .is_running = 1},
    {"pictures", 'o', "PATTERN",
     "Names of the pictures that the key s writes; default view_%04d.png. %04d becomes the frame's number. A file that "
     "is there is kept: the next name gets -2, -3, ...",
     AT(TEXT, pictures), .is_running = 1},
    {"keys", 0, "FILE", "The key k adds key frames to this file, for cgt-render's --camera-keys; default camera.keys",
     AT(TEXT, keys), .is_running = 1},
    {"script", 0, "FILE",
     "Take events from this file, a line each, and end after the last: press or release BUTTON X Y; move, click or "
     "double X Y; wheel TURNS X Y; key NAME, as Space, Shift+D or Ctrl+Z; text WORDS; drop FILE; size W H; settle, "
     "until the picture and a movie are complete; wait SECONDS; shot FILE, the window as .png; say, the state; close",
     AT(TEXT, script), .is_running = 1},
};

enum { OWN_ROWS = sizeof own_rows / sizeof own_rows[0], LEFT_OUT = sizeof left_out / sizeof left_out[0] };

static const char *why_left_out(const char *name)
{
    for (size_t i = 0; i < LEFT_OUT; i++)
        if (strcmp(name, left_out[i].name) == 0)
            return left_out[i].why;
    return NULL;
}

const char *view_options_why_not(const char *name) { return why_left_out(name); }

int view_options_check_opacity(int transparent, const char *pictures, char *error, size_t size)
{
    if (!transparent || image_format_of(pictures) == IMAGE_PNG)
        return 0;
    snprintf(error, size, "--transparent: \"%s\" holds no opacity; .png does", pictures);
    return -1;
}

static int finish(void *options, const char **operands, size_t count, char *error, size_t size)
{
    view_options *const o = options;
    out_path path;
    o->render.no_images = 1;
    if (out_path_parse(&path, o->pictures, error, size))
        return -1;
    const image_format format = image_format_of(o->pictures);
    if (format == IMAGE_NONE || format == IMAGE_EXR) {
        snprintf(error, size, "--pictures: \"%s\" ends in none of .png, .jpg, .tif", o->pictures);
        return -1;
    }
    if (view_options_check_opacity(o->render.figure.picture.transparent, o->pictures, error, size))
        return -1;
    o->render.print_settings = count == 0; /* which is no error here: the window asks for a file */
    const int result = render_options_finish(&o->render, operands, count, error, size);
    o->render.print_settings = 0;
    return result;
}

/* The rows of cgt-render, each heading with the first that is kept, and the window's own. */
static size_t join_rows(option_row rows[OPTIONS_MOST])
{
    const option_row *heading = NULL;
    size_t count = 0;
    for (size_t i = 0; i < render_option_table()->count && count + 2 + OWN_ROWS < OPTIONS_MOST; i++) {
        const option_row *const row = &render_option_table()->rows[i];
        if (!row->name)
            heading = row;
        if (!row->name)
            continue;
        const char *const why = why_left_out(row->name);
        if (why) {
            rows[count++] = (option_row){.name = row->name,
                                         .value = row->value,
                                         .help = why,
                                         .type = OPTION_REFUSED,
                                         .is_optional = row->is_optional};
            continue;
        }
        if (heading)
            rows[count++] = *heading;
        heading = NULL;
        rows[count++] = *row;
        if (strcmp(row->name, "rate") == 0)
            rows[count - 1].help = "Frames a second while playing; default 30";
        if (strcmp(row->name, "memory") == 0)
            rows[count - 1].help =
                "Frames that were read are kept in so much memory; default: a quarter of the machine's";
        if (strcmp(row->name, "survey") == 0)
            rows[count - 1].help = "Look at the first N frames for automatic camera and colours; default: at all of "
                                   "files up to 32 MiB, else at 4";
        if (strcmp(row->name, "antialias") == 0)
            rows[count - 1].help = "At rest trace NxN rays for each pixel: 1, 2 (default) or 4";
    }
    memcpy(rows + count, own_rows, sizeof own_rows);
    return count + OWN_ROWS;
}

void view_options_parse(view_options *o, int argc, char **argv)
{
    static option_row rows[OPTIONS_MOST];
    const option_table table = {
        .rows = rows,
        .count = join_rows(rows),
        .arguments = "[FILE...]",
        .text = "Shows the moving spheres or triangles of a trajectory in a window, as cgt-render draws them: all "
                "that cgt-render reads, and its options for looks.\v"
                "Drag to turn, with the right button to pan, the wheel zooms to the pointer, a click tells what is "
                "there, a double click makes it what everything turns about; h lists all keys" PANEL
                ". While something moves "
                "pictures are drawn without soft light; at rest they grow to what cgt-render writes. The key s writes "
                "that picture, and prints the command line of cgt-render that makes the same file.",
        .finish = finish,
    };
    settings_arguments arguments;
    options_given given;
    char error[PROGRAM_ERROR_SIZE];
    memset(o, 0, sizeof *o);
    render_options_init(&o->render);
    o->render.output.survey = VIEW_SURVEY_AUTO;
    o->budget = 1e3f / 60.0f;
    o->pictures = "view_%04d.png";
    o->keys = "camera.keys";
    if (settings_expand(argc, argv, &arguments, error, sizeof error)) {
        program_error("--settings: %s", error);
        exit(PROGRAM_USAGE);
    }
    options_parse(&table, o, arguments.argc, arguments.argv, &given);
    o->render.settings = given.settings;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The command line of cgt-render: what is not given, and what needs several options; see render_options.h. */
#include "render/options/render_options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/program.h"
#include "common/settings_file.h"
#include "picture/files/image_write.h"
#include "render/options/option_parsers.h"
#include "render/options/settings_arguments.h"
#include "system/system.h"
#include "options/numbers.h"

/* ---- The whole command line ---------------------------------------------------------------------------------- */

/* In MiB; 1024 where the system does not tell. */
static uint32_t quarter_of_memory(void)
{
    const uint64_t bytes = system_memory(), mib = bytes > 0 ? bytes >> 22 : 1024;
    return mib < UINT32_MAX ? (uint32_t)mib : UINT32_MAX;
}

/* Whether two patterns make a name that is the same. Of two with numbers only equal ones are known to. */
static int make_the_same(const out_path *a, const out_path *b)
{
    return strcmp(a->pattern, b->pattern) == 0 || (!b->numbered && out_path_makes(a, b->pattern)) ||
           (!a->numbered && out_path_makes(b, a->pattern));
}

/* A file would be written twice, and one of them lost. */
static int check_names(const render_options *o, char *error, size_t size)
{
    for (uint32_t i = 0; i < o->output_count; i++) {
        if (o->contact_sheet && out_path_makes(&o->outputs[i], o->contact_sheet))
            return cgt_refuse(error, size, "--contact-sheet: \"%s\" is the name of a picture of \"%s\", too",
                              o->contact_sheet, o->outputs[i].pattern);
        for (uint32_t k = 0; k < i; k++)
            if (make_the_same(&o->outputs[i], &o->outputs[k]))
                return cgt_refuse(error, size, "--output: \"%s\" and \"%s\" name the same file", o->outputs[k].pattern,
                                  o->outputs[i].pattern);
    }
    return 0;
}

int render_options_finish(void *options, const char **operands, size_t count, char *error, size_t size)
{
    render_options *o = options;
    o->inputs = operands;
    o->input_count = count;
    o->input = count ? operands[0] : NULL;
    if (o->cell.mode == RENDER_CELL_NONE && o->cell.spes)
        o->cell.mode = RENDER_CELL_NATIVE;
    if (!o->input && !o->print_settings)
        return cgt_refuse(error, size, "no trajectory: give a .lammpstrj, .xyz or .frames file, or a mesh");
    if (o->no_images && o->output_count)
        return cgt_refuse(error, size, "--output and --no-images exclude each other");
    if (!o->no_images && !o->output_count && parse_output("out/frame_%04d.png", o, error, size))
        return -1;
    for (uint32_t i = 0; i < o->output_count && o->figure.picture.transparent; i++)
        if (image_format_of(o->outputs[i].pattern) != IMAGE_PNG && image_format_of(o->outputs[i].pattern) != IMAGE_EXR)
            return cgt_refuse(error, size, "--transparent: \"%s\" holds no opacity; .png and .exr do",
                              o->outputs[i].pattern);
    if (check_names(o, error, size))
        return -1;
    if (o->range.last < o->range.first)
        return cgt_refuse(error, size, "--last is before --first");
    if (cgt_figure_options_finish(&o->figure, error, size))
        return -1;
    if (o->cell.mode == RENDER_CELL_NONE && (o->cell.assignment || o->cell.program))
        return cgt_refuse(error, size, "--cell-assignment and --cell-program are for --cell");
    if (o->cell.mode == RENDER_CELL_NATIVE && o->cell.program)
        return cgt_refuse(error, size, "--cell-program is for --cell sim: a native Cell has its program built in");
    return 0;
}

void render_options_init(render_options *o)
{
    memset(o, 0, sizeof *o);
    cgt_trajectory_options_init(&o->reading);
    o->reading.fps = 0.0; /* not given: the reader's default */
    o->range = (frame_range){0, UINT64_MAX - 1, 1};
    o->output.survey = UINT64_MAX;
    o->sheet_columns = 4;
    o->sheet_rows = 3;
    o->memory_mib = quarter_of_memory();
    cgt_figure_options_init(&o->figure);
}

void render_options_parse(render_options *options, int argc, char **argv)
{
    settings_arguments arguments;
    options_given given;
    char error[PROGRAM_ERROR_SIZE];
    render_options_init(options);
    if (settings_expand(argc, argv, &arguments, error, sizeof error)) {
        program_error("--settings: %s", error);
        exit(PROGRAM_USAGE);
    }
    options_parse(render_option_table(), options, arguments.argc, arguments.argv, &given);
    options->settings = given.settings;
    if (!options->print_settings)
        return;
    char *const lines = given.settings ? settings_quote(given.settings) : NULL;
    if (lines) {
        printf("%s", lines);
        options_print_others(render_option_table(), &given);
    }
    const int code = lines ? PROGRAM_OK : PROGRAM_FAILED;
    free(lines);
    exit(program_exit(code));
}

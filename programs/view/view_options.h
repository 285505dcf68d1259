/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The command line of cgt-view: cgt-render's options for looks and input, from its own table, and those of the window.
 */
#ifndef VIEW_OPTIONS_H
#define VIEW_OPTIONS_H

#include "render/options/option_parsers.h"
#include "render/options/render_options.h"

enum { VIEW_SURVEY_AUTO = 0 }; /* output.survey was not given */

typedef struct view_options {
    render_options render; /* the first member: cgt-render's rows have their places in it */
    float budget;          /* ms of a picture while something moves */
    const char *keys;      /* file of key frames */
    const char *pictures;  /* pattern of names */
    const char *script;    /* events in place of a user's; NULL: none */
} view_options;

/* Parses the command line, with the files of --settings. options->render.settings gets what was given for looks.
 * Ends the program on --help, --version and errors, as render_options_parse does. */
void view_options_parse(view_options *options, int argc, char **argv);

/* Why an option cannot change while the window is open; NULL: it can. */
const char *view_options_why_not(const char *name);

/* Whether pictures of these names hold a transparent background. Returns 0, or -1 with a sentence. */
int view_options_check_opacity(int transparent, const char *pictures, char *error, size_t size);

#endif

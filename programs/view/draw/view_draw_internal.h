/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the files of view_draw.h share. */
#ifndef VIEW_DRAW_INTERNAL_H
#define VIEW_DRAW_INTERNAL_H

#include "render/render_setup.h"
#include "view/draw/view_draw.h"

struct view_draw {
    renderer r; /* its drawing is that of VIEW_FULL */
    stop_flag stop;
    frame_parts parts;
    cgt_picture *quick[VIEW_FULL];
    uint8_t *small; /* a picture of fewer pixels */
    uint8_t *alpha; /* of a picture that is written with opacity; NULL: the background is in the picture */
    uint32_t grown; /* rays of the picture at rest so far, of each of the camera's hits */
    char *given;    /* the settings of the command line */
    char *show;     /* the conditions of the command line */
    char condition[2048], color[512], formula[512];
    int checked;
};

/* Makes the full picture's planes and overlay anew, of the options at hand. */
int view_draw_set_up_full(view_draw *d);

/* Whether colours are those of values; gives such that are all the same a range, so that a command line can tell it;
 * says what the colours show. After each change of colours. */
int view_draw_has_range(const coloring *c);
void view_draw_widen_range(coloring *c);
void view_draw_name_color(view_draw *d);

/* What is measured by a name of --color; NULL: nothing. */
const char *view_draw_measured(const figure_options *o);

#endif

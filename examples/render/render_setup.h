/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The state of a run of cgt-render, and its set-up before the first frame. */
#ifndef RENDER_SETUP_H
#define RENDER_SETUP_H

#include <signal.h>
#include <stdint.h>

#include <cgt/cgt.h>

#include "playback/camera_path.h"
#include "picture/coloring.h"
#include "picture/contact_sheet.h"
#include "playback/frame_source.h"
#include "common/program.h"
#include "render/render_options.h"
#include "render/render_report.h"
#include "picture/shade.h"
#include "picture/srgb.h"

typedef struct renderer {
    render_options options;
    const volatile sig_atomic_t *stop; /* not 0: a signal has come */
    frame_source source;
    int has_survey;
    survey survey; /* where has_survey */
    coloring coloring;
    srgb_tables tables;
    camera_path path;
    shade_job job;
    contact_sheet *sheet; /* NULL: none */
    cgt_context *context;
    cgt_scene *scene;
    struct render_cell *cell; /* --cell: traces in place of the library; else NULL */
    int has_geometry;         /* made from the first frame, which tells the kind */
    uint32_t geometry;
    render_report report;
    uint64_t rendered; /* frames */
    char error[PROGRAM_ERROR_SIZE];
} renderer;

/* Both print an error and return -1: the text in r->error, or the library's message about a failed action. */
int render_fail(renderer *r);
int render_fail_library(renderer *r, const char *action, cgt_result result);

/* Opens the input and surveys it if necessary, chooses colours and camera, makes folders, buffers and an empty scene.
 * options and stop are set, the rest is zero. Returns 0, or -1 with the message printed. */
int render_setup(renderer *r);

/* Frees what render_setup made, also after a failure. */
void render_close(renderer *r);

#endif

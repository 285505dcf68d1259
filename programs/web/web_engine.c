/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the page of programs/web asks of the libraries: a file's frames, a camera, options of looks, pictures as bytes
 * for a canvas, and what a pixel shows. One worker calls it. Functions that return an int give 0, or -1 with a sentence
 * in web_message. */
#define _POSIX_C_SOURCE 200809L
#include <emscripten.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "common/settings_file.h"
#include "options/figure_options.h"
#include "view/view_camera.h"
#include "web/web_state.h"
#include "web/web_text.h"

web_state web;

EMSCRIPTEN_KEEPALIVE int web_seek(uint32_t number);

int web_fail(const char *text)
{
    snprintf(web.message, sizeof web.message, "%s", text);
    return -1;
}

int web_check(cgt_result result)
{
    if (result)
        cgt_figure_get_error_message(web.figure, web.message, sizeof web.message);
    return result ? -1 : 0;
}

/* Bytes of the heap that are in use. */
EMSCRIPTEN_KEEPALIVE double web_used(void) { return (double)mallinfo().uordblks; }

EMSCRIPTEN_KEEPALIVE const char *web_message(void) { return web.message; }

/* Starts with so many threads, the caller's included. Returns how many there are, or -1. */
EMSCRIPTEN_KEEPALIVE int web_start(uint32_t threads)
{
    cgt_context_options options = {.threads = threads};
    cgt_result result = cgt_context_create(&options, &web.context);
    while (result == CGT_ERROR_THREADS && options.threads > 1) { /* the browser refuses so many */
        cgt_context_release(web.context);
        options.threads /= 2;
        result = cgt_context_create(&options, &web.context);
    }
    if (!result)
        result = cgt_figure_create(web.context, &web.figure);
    if (result && !cgt_context_get_error_message(web.context, web.message, sizeof web.message))
        web_fail(cgt_get_result_string(result));
    return result ? -1 : (int)options.threads;
}

/* ---- Options ------------------------------------------------------------------------------------------------ */

/* A figure with one sphere that is kept: what it refuses this build cannot do. NULL: no memory. */
static cgt_figure *create_probe(cgt_figure_frame **frame)
{
    static const float place[3] = {0.0f};
    const cgt_figure_data data = {.points = {.count = 1, .positions = cgt_floats(place, 12)}};
    cgt_figure *probe = NULL;
    uint64_t lead;
    *frame = NULL;
    if (cgt_figure_create(web.context, &probe) == CGT_OK && cgt_figure_survey(probe, &data) == CGT_OK &&
        cgt_figure_begin_keep(probe, &lead) == CGT_OK && cgt_figure_keep(probe, &data, frame, NULL, 0) == CGT_OK &&
        cgt_figure_show_frame(probe, *frame) == CGT_OK)
        return probe;
    cgt_figure_frame_release(*frame);
    cgt_figure_release(probe);
    return NULL;
}

/* Sets an option to any value that its kind may have, and takes it back. The sentence is "" where it is taken. */
static void try_option(cgt_figure *probe, const cgt_figure_option *o, char *sentence, size_t size)
{
    char low[32];
    const int is_number = o->kind == CGT_FIGURE_NUMBER || o->kind == CGT_FIGURE_WHOLE;
    snprintf(low, sizeof low, "%.9g", is_number ? o->low : 1.0);
    sentence[0] = '\0';
    if (cgt_figure_set(probe, o->name, o->kind == CGT_FIGURE_SWITCH || o->is_optional ? NULL : low))
        cgt_figure_get_error_message(probe, sentence, size);
    cgt_figure_unset(probe, o->name);
}

/* Whether the page has an option. without_text: the sentence that refuses texts, "": they can be written. */
static int has_option(cgt_figure *probe, const cgt_figure_option *o, const char *without_text)
{
    static const char *const canvas[] = {"size", "transparent"};      /* it has the window's size, and no alpha */
    static const char *const letters[] = {"label-text", "text-size"}; /* how texts look, which alone is not refused */
    char sentence[256];
    for (size_t i = 0; i < sizeof canvas / sizeof canvas[0]; i++)
        if (strcmp(o->name, canvas[i]) == 0)
            return 0;
    if (o->value && strcmp(o->value, "FILE") == 0) /* of the user's disk */
        return 0;
    for (size_t i = 0; without_text[0] && i < sizeof letters / sizeof letters[0]; i++)
        if (strcmp(o->name, letters[i]) == 0)
            return 0;
    try_option(probe, o, sentence, sizeof sentence);
    return !without_text[0] || strcmp(sentence, without_text) != 0;
}

/* What may be set, as an array of JSON: the members of cgt_figure_option, without what a page cannot have. NULL: no
 * memory. */
EMSCRIPTEN_KEEPALIVE const char *web_options(void)
{
    static const char *const kinds[] = {"switch", "word", "number", "whole", "color", "text", "formula", "list"};
    const cgt_figure_option axes = {.name = "axes", .kind = CGT_FIGURE_SWITCH}; /* three letters */
    char without_text[256];
    cgt_figure_option o;
    cgt_figure_frame *frame;
    size_t size;
    if (web.options)
        return web.options;
    cgt_figure *const probe = create_probe(&frame);
    FILE *const to = probe ? open_memstream(&web.options, &size) : NULL;
    if (to)
        try_option(probe, &axes, without_text, sizeof without_text);
    int count = 0;
    for (uint32_t i = 0; to && cgt_figure_get_option(i, &o); i++) {
        if (!has_option(probe, &o, without_text))
            continue;
        fprintf(to, "%s{\"kind\":\"%s\"", count++ ? "," : "[", kinds[o.kind]);
        web_print_text(to, "name", o.name);
        web_print_text(to, "group", o.group);
        web_print_text(to, "value", o.value);
        web_print_text(to, "help", o.help);
        web_print_text(to, "words", o.words);
        web_print_text(to, "otherwise", o.otherwise);
        if (o.kind == CGT_FIGURE_NUMBER || o.kind == CGT_FIGURE_WHOLE)
            fprintf(to, ",\"low\":%.9g,\"high\":%.9g", o.low, o.high);
        fprintf(to, ",\"optional\":%s,\"repeats\":%s}", o.is_optional ? "true" : "false", o.repeats ? "true" : "false");
    }
    if (to)
        fputc(']', to);
    if (to && fclose(to)) {
        free(web.options);
        web.options = NULL;
    }
    cgt_figure_frame_release(frame);
    cgt_figure_release(probe);
    return web.options;
}

/* The camera of the hand, or that of an option which takes its place. */
static int change(const char *name, const char *value, int is_set)
{
    if (web.shown && web_check(cgt_figure_set_camera(web.figure, &web.camera)))
        return -1;
    if (web_check(is_set ? cgt_figure_set(web.figure, name, value) : cgt_figure_unset(web.figure, name)))
        return -1;
    if (web.shown)
        cgt_figure_get_camera(web.figure, &web.camera);
    return 0;
}

/* Sets an option of the picture, NULL: without a value; or takes it back. What is refused changes nothing. */
EMSCRIPTEN_KEEPALIVE int web_set(const char *name, const char *value) { return change(name, value, 1); }
EMSCRIPTEN_KEEPALIVE int web_unset(const char *name) { return change(name, NULL, 0); }

/* Settings of a figure as cgt_figure_get has them, to be freed. NULL: no memory. */
static char *get_settings(const cgt_figure *figure, const char *name)
{
    const size_t length = cgt_figure_get(figure, name, NULL, 0);
    char *const text = malloc(length + 1);
    if (text)
        cgt_figure_get(figure, name, text, length + 1);
    return text;
}

/* Where the line of the camera is in settings; their end: there is none. */
static size_t find_camera(const char *settings)
{
    const char *line = settings;
    while (*line && strncmp(line, "camera ", 7) != 0)
        line = settings_next_line(line);
    return (size_t)(line - settings);
}

/* What was set of an option: its values, a line each; "": nothing; name NULL: of all, as a settings file has them.
 * NULL: no memory. */
EMSCRIPTEN_KEEPALIVE const char *web_values(const char *name)
{
    char *const values = get_settings(web.figure, name);
    free(web.values);
    web.values = values && !name ? settings_quote(values) : values;
    if (web.values != values)
        free(values);
    return web.values;
}

/* ---- Files -------------------------------------------------------------------------------------------------- */

static void close_file(void)
{
    cgt_figure_frame_release(web.shown);
    frame_source_close(&web.file);
    web.shown = NULL;
    web.frames = 0;
}

static int fail_file(void)
{
    close_file();
    return -1;
}

/* Hands the mesh that stands still to the figure; none: does nothing. */
static int read_mesh(const double origin[3])
{
    cgt_trajectory *file;
    cgt_trajectory_frame mesh;
    if (!web.files.mesh)
        return 0;
    cgt_result result = cgt_trajectory_open(web.files.mesh, NULL, &file);
    if (!result) {
        cgt_trajectory_set_origin(file, origin);
        result = cgt_trajectory_read(file, &mesh);
    }
    const int has_triangles = !result && mesh.kind == CGT_TRAJECTORY_TRIANGLES;
    const cgt_figure_data data = {.frame = &mesh};
    if (result)
        cgt_trajectory_get_error_message(file, web.message, sizeof web.message);
    else if (!has_triangles)
        snprintf(web.message, sizeof web.message, "%.200s has no triangles", web.files.mesh);
    const int failed = !has_triangles || web_check(cgt_figure_set_mesh(web.figure, &data));
    cgt_trajectory_close(file);
    return failed ? -1 : 0;
}

/* The bytes of the run's files. */
static double run_size(void)
{
    double size = 0.0;
    struct stat info;
    for (uint32_t i = 0; i < web.files.count; i++)
        size += stat(web.files.run[i], &info) == 0 ? (double)info.st_size : 0.0;
    return size;
}

/* Looks at all frames, as cgt-render does, for colours and camera; of a large run at the first few. Counts all. */
static int survey_file(void)
{
    const double large = 64 << 20; /* bytes */
    static const stop_flag never = 0;
    survey_walk survey = {.most = run_size() > large ? 4 : UINT64_MAX, .count = 1, .quiet = 1, .stop = &never};
    double origin[3];
    for (int turn = 0; turn < 2; turn++) {
        web.message[0] = '\0';
        cgt_trajectory_get_origin(web.file.file, origin);
        if (read_mesh(origin) || figure_run_look(web.figure, &web.file, &survey, web.message, sizeof web.message))
            return -1;
        if (turn || !cgt_figure_get_origin(web.figure, origin))
            break;
        cgt_trajectory_set_origin(web.file.file, origin); /* all lies far from 0 */
        if (frame_source_rewind(&web.file, web.message, sizeof web.message))
            return -1;
    }
    if (survey.is_cut)
        memcpy(web.doubt, web.message, sizeof web.message);
    web.frames = survey.total;
    return survey.frames ? 0 : web_fail("the file has no frame");
}

cgt_trajectory_options web_reading(void)
{
    return (cgt_trajectory_options){
        .threads = 1, .all_bonds = true, .leave_out_sites = true, .topology = web.files.topology};
}

/* The camera that the figure has chosen, or that of its options, is the hand's. */
static int take_camera(void)
{
    const int failed = web_check(cgt_figure_get_camera(web.figure, &web.camera));
    web.chosen = web.camera;
    return failed;
}

/* With a figure of its own, which has the settings. Its first frame that has something is the one that is drawn. */
static int open_files(const char *settings)
{
    const web_files *const files = &web.files;
    const cgt_trajectory_options options = web_reading();
    const size_t kept = 64 << 20; /* bytes of frames, which are not read again */
    cgt_figure *figure;
    close_file();
    web.message[0] = web.doubt[0] = '\0';
    if (cgt_figure_create(web.context, &figure))
        return web_fail("out of memory");
    cgt_figure_release(web.figure);
    web.figure = figure;
    cgt_figure_set_source(figure, files->run[0]);
    if (web_check(cgt_figure_set_lines(figure, settings)) ||
        frame_source_open(&web.file, &web.raw, files->run, files->count, &options, web.message, sizeof web.message))
        return fail_file();
    web.file.keep.most = kept;
    if (figure_run_want_all(&web.file, web.message, sizeof web.message) < 0 || survey_file() ||
        web_check(cgt_figure_begin_keep(figure, &web.lead)))
        return fail_file();
    web.file.looks_ahead = 1; /* which a survey ends */
    uint32_t number = 0;
    do {
        if (web_seek(number++))
            return -1;
    } while (!figure_run_shows(web.shown) && number < web.frames);
    if (!figure_run_shows(web.shown) && web_seek(0))
        return -1;
    return take_camera() ? fail_file() : 0;
}

/* Takes the names of a run's files, a line each, and those of its topology and of a mesh, "" for none. */
static int take_names(web_files *f, const char *run, const char *topology, const char *mesh)
{
    const size_t length[3] = {strlen(run) + 1, strlen(topology) + 1, strlen(mesh) + 1};
    free(f->names);
    *f = (web_files){.names = malloc(length[0] + length[1] + length[2])};
    if (!f->names)
        return web_fail("out of memory for names of files");
    memcpy(f->names, run, length[0]);
    for (char *name = f->names; *name; f->count++) {
        char *const end = name + strcspn(name, "\n");
        if (f->count == WEB_FILES_MOST)
            return web_fail("more than 10000 files");
        f->run[f->count] = name;
        name = end + (*end == '\n');
        *end = '\0';
    }
    f->topology = *topology ? memcpy(f->names + length[0], topology, length[1]) : NULL;
    f->mesh = *mesh ? memcpy(f->names + length[0] + length[1], mesh, length[2]) : NULL;
    cgt_trajectory_sort_series(f->run, f->count);
    return f->count ? 0 : web_fail("there is no file");
}

/* How the user names the files that are opened next. */
EMSCRIPTEN_KEEPALIVE int web_name(const char *run, const char *topology, const char *mesh)
{
    return take_names(&web.given, run, topology, mesh);
}

/* Opens files, without the camera that was set for those before. Options that do not fit them are left out, but for
 * size and style. */
EMSCRIPTEN_KEEPALIVE int web_open(const char *run, const char *topology, const char *mesh)
{
    static const char *const kept[] = {"size", "style"};
    char *const settings = get_settings(web.figure, NULL);
    char few[128] = "", why[sizeof web.message];
    for (size_t i = 0; i < sizeof kept / sizeof kept[0]; i++)
        if (cgt_figure_get(web.figure, kept[i], why, sizeof why))
            snprintf(few + strlen(few), sizeof few - strlen(few), "%s = %.32s", kept[i], why);
    if (settings && web.shown) {
        char *const camera = settings + find_camera(settings);
        const char *const rest = settings_next_line(camera);
        memmove(camera, rest, strlen(rest) + 1);
    }
    web_forget_run();
    int failed = settings ? take_names(&web.files, run, topology, mesh) : web_fail("out of memory for options");
    if (failed)
        close_file();
    else if (open_files(settings) && !(failed = strlen(settings) <= strlen(few))) {
        memcpy(why, web.message, sizeof why);
        failed = open_files(few);
        if (!failed)
            snprintf(web.doubt, sizeof web.doubt, "options are left out: %s", why);
    }
    free(settings);
    return failed ? -1 : 0;
}

/* Of the file, as far as it can be read. */
EMSCRIPTEN_KEEPALIVE uint32_t web_frames(void) { return (uint32_t)web.frames; }

/* How many frames before one it needs. */
EMSCRIPTEN_KEEPALIVE uint32_t web_lead(void) { return (uint32_t)web.lead; }

int web_get_origin(double origin[3])
{
    memset(origin, 0, 3 * sizeof *origin);
    if (web.file.file)
        cgt_trajectory_get_origin(web.file.file, origin);
    return origin[0] != 0.0 || origin[1] != 0.0 || origin[2] != 0.0;
}

EMSCRIPTEN_KEEPALIVE int web_has_triangles(void)
{
    return web.shown && cgt_figure_frame_get_data(web.shown)->kind == CGT_TRAJECTORY_TRIANGLES;
}

EMSCRIPTEN_KEEPALIVE uint32_t web_frame(void)
{
    return web.shown ? (uint32_t)cgt_figure_frame_get_data(web.shown)->number : 0;
}

EMSCRIPTEN_KEEPALIVE uint32_t web_primitives(void)
{
    return web.shown ? frame_primitives(cgt_figure_frame_get_data(web.shown)) : 0;
}

/* Makes frame `number` the one that is drawn. */
int web_seek(uint32_t number)
{
    cgt_figure_frame *frame = NULL;
    if (!web.file.file)
        return web_fail("no file is open");
    if (web.shown && number == web_frame())
        return 0;
    const int status =
        figure_run_keep(web.figure, &web.file, web.lead, number, &frame, web.message, sizeof web.message);
    if (status == 0)
        web_fail("there is no such frame");
    if (status <= 0 || web_check(cgt_figure_show_frame(web.figure, frame))) {
        cgt_figure_frame_release(frame);
        return fail_file();
    }
    cgt_figure_frame_release(web.shown);
    web.shown = frame;
    web_take_frame();
    return 0;
}

/* ---- All values of an option -------------------------------------------------------------------------------- */

static int repeats(const char *name)
{
    cgt_figure_option o;
    for (uint32_t i = 0; cgt_figure_get_option(i, &o); i++)
        if (strcmp(name, o.name) == 0)
            return o.repeats;
    return 0;
}

/* Sets an option to exactly these lines, as web_values has them. What is refused may leave some of several. */
static int set_lines_of(const char *name, const char *lines)
{
    const int is_list = repeats(name);
    const size_t first = strcspn(lines, "\n");
    if (!is_list && lines[first] && lines[first + 1]) {
        snprintf(web.message, sizeof web.message, "%.80s: the option takes one value", name);
        return -1;
    }
    if ((!lines[0] || is_list) && web_unset(name))
        return -1;
    for (const char *line = lines; *line;) {
        const size_t length = strcspn(line, "\n");
        char *const value = strndup(line, length);
        const int failed = !value ? web_fail("out of memory for options") : web_set(name, length ? value : NULL);
        free(value);
        if (failed)
            return -1;
        line += length + (line[length] == '\n');
    }
    return 0;
}

/* Opens the files anew with these settings, at the same frame; what is refused changes nothing. */
static int reopen(const char *settings, int keeps_camera)
{
    const uint32_t number = web_frame();
    const cgt_camera camera = web.camera;
    char why[sizeof web.message];
    char *const before = get_settings(web.figure, NULL);
    if (!before)
        return web_fail("out of memory for options");
    const int failed = open_files(settings);
    memcpy(why, web.message, sizeof why);
    if (!(failed && open_files(before)) && web_seek(number) == 0) { /* else there is no file any more */
        if (failed || keeps_camera)
            web.camera = camera;
        else
            take_camera(); /* what is followed has moved it from frame to frame */
        memcpy(web.message, why, sizeof why);
    }
    free(before);
    return failed;
}

/* For an option by which frames are read: where they are kept a figure refuses it. */
static int read_anew(const char *name, const char *lines)
{
    char *const before = get_settings(web.figure, NULL), *next = NULL;
    cgt_figure_frame *const shown = web.shown;
    cgt_figure *const figure = web.figure;
    int failed = before ? 0 : web_fail("out of memory for options");
    if (failed || cgt_figure_create(web.context, &web.figure)) { /* one without frames finds what the settings are */
        web.figure = figure;
        free(before);
        return failed ? failed : web_fail("out of memory");
    }
    web.shown = NULL;
    failed = web_check(cgt_figure_set_lines(web.figure, before)) || set_lines_of(name, lines);
    if (!failed)
        next = get_settings(web.figure, NULL);
    cgt_figure_release(web.figure);
    web.figure = figure;
    web.shown = shown;
    if (!failed && !next)
        failed = web_fail("out of memory for options");
    if (!failed)
        failed = reopen(next, 1);
    free(before);
    free(next);
    return failed ? -1 : 0;
}

int web_take(const char *settings)
{
    const int has_camera = settings[find_camera(settings)] != '\0';
    const int is_moved = memcmp(&web.camera, &web.chosen, sizeof web.camera) != 0;
    if (web.shown)
        return reopen(settings, is_moved && !has_camera);
    char why[sizeof web.message];
    char *const before = get_settings(web.figure, NULL);
    if (!before)
        return web_fail("out of memory for options");
    const int failed =
        web_check(cgt_figure_unset(web.figure, NULL)) || web_check(cgt_figure_set_lines(web.figure, settings));
    memcpy(why, web.message, sizeof why);
    if (failed) {
        cgt_figure_unset(web.figure, NULL);
        cgt_figure_set_lines(web.figure, before);
        memcpy(web.message, why, sizeof why);
    }
    free(before);
    return failed ? -1 : 0;
}

/* Sets an option to these values, a line each, in place of all that it had; an empty line: without a value; "": takes
 * it back. What is refused changes nothing. */
EMSCRIPTEN_KEEPALIVE int web_put(const char *name, const char *values)
{
    if (web.shown && cgt_figure_option_is_of_frames(name))
        return read_anew(name, values);
    char *const before = get_settings(web.figure, name);
    if (!before)
        return web_fail("out of memory for options");
    const int failed = set_lines_of(name, values);
    if (failed && repeats(name)) {
        char why[sizeof web.message];
        memcpy(why, web.message, sizeof why);
        set_lines_of(name, before);
        memcpy(web.message, why, sizeof why);
    }
    free(before);
    return failed;
}

/* Names of the columns that formulas and colours may use, as an array of JSON. NULL: no memory. */
EMSCRIPTEN_KEEPALIVE const char *web_columns(void)
{
    const cgt_trajectory_frame *const frame = web.shown ? cgt_figure_frame_get_data(web.shown) : NULL;
    size_t size;
    free(web.columns);
    web.columns = NULL;
    FILE *const to = open_memstream(&web.columns, &size);
    if (!to)
        return NULL;
    fputc('[', to);
    for (uint32_t i = 0; frame && i < frame->columns; i++) {
        web_print_string(to, i ? "," : "", frame->column[i].name);
    }
    fputc(']', to);
    return fclose(to) ? NULL : web.columns;
}

/* The next thing that is doubtful about the file, or was chosen for it; NULL: there is none. */
EMSCRIPTEN_KEEPALIVE const char *web_warning(void)
{
    if (!web.shown)
        return NULL;
    if (web.doubt[0]) {
        memcpy(web.message, web.doubt, sizeof web.message);
        web.doubt[0] = '\0';
        return web.message;
    }
    const char *const notice = cgt_figure_take_notice(web.figure);
    return notice ? notice : cgt_trajectory_take_warning(web.file.file);
}

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

EMSCRIPTEN_KEEPALIVE int web_resize(uint32_t width, uint32_t height)
{
    uint8_t *const pixels = malloc(4 * (size_t)width * height);
    char size[32];
    snprintf(size, sizeof size, "%ux%u", (unsigned)width, (unsigned)height);
    if (!pixels)
        return web_fail("out of memory for the picture");
    free(web.pixels);
    web.pixels = pixels;
    web.width = width;
    web.height = height;
    return web_set("size", size);
}

EMSCRIPTEN_KEEPALIVE uint8_t *web_pixels(void) { return web.pixels; }

/* Draws the frame by the hand's camera, as fast as it goes, or with hard shadows. */
EMSCRIPTEN_KEEPALIVE int web_draw(int shadows)
{
    const cgt_image image = {.bytes = web.pixels, .channels = 4};
    if (!web.shown)
        return web_fail("no file is open");
    return web_check(cgt_figure_set_camera(web.figure, &web.camera)) ||
                   web_check(
                       cgt_figure_draw_quick(web.figure, shadows ? CGT_FIGURE_SHADOWS : CGT_FIGURE_PLAIN, 1, &image))
               ? -1
               : 0;
}

/* Makes the picture of the options, then adds a step of soft light to it; begins: the first. Returns how many are left,
 * or -1. */
EMSCRIPTEN_KEEPALIVE int web_grow(int begins)
{
    const cgt_image image = {.bytes = web.pixels, .channels = 4};
    uint32_t left = 0;
    if (!web.shown)
        return web_fail("no file is open");
    if ((begins &&
         (web_check(cgt_figure_set_camera(web.figure, &web.camera)) || web_check(cgt_figure_begin(web.figure)))) ||
        web_check(cgt_figure_step(web.figure, 1, &left)) || web_check(cgt_figure_read(web.figure, &image)))
        return -1;
    return (int)left;
}

/* ---- The camera --------------------------------------------------------------------------------------------- */

/* The camera that shows all of the frame; from where it looks stays. */
EMSCRIPTEN_KEEPALIVE int web_fit(void)
{
    if (web_check(cgt_figure_set_camera(web.figure, &web.camera)) || web_check(cgt_figure_fit(web.figure)))
        return -1;
    return web_check(cgt_figure_get_camera(web.figure, &web.camera));
}

/* By pixels of the picture. */
EMSCRIPTEN_KEEPALIVE void web_turn(float right, float down)
{
    const float turn = 4.0f / (float)web.height;
    float up[3];
    if (cgt_figure_get_up(web.figure, up) == CGT_OK)
        view_camera_turn(&web.camera, web.camera.target, up, right * turn, down * turn);
}

EMSCRIPTEN_KEEPALIVE void web_pan(float right, float down) { view_camera_pan(&web.camera, right, -down, web.height); }

/* By a factor, about what a pixel shows as far off as the target. */
EMSCRIPTEN_KEEPALIVE void web_zoom(float x, float y, float factor)
{
    float place[3];
    view_camera_place(&web.camera, (float)web.width / (float)web.height, x / (float)web.width, y / (float)web.height,
                      place);
    view_camera_zoom(&web.camera, place, factor);
}

/* As -c of cgt-render takes it. */
EMSCRIPTEN_KEEPALIVE const char *web_camera(void)
{
    cgt_figure_set_camera(web.figure, &web.camera);
    cgt_figure_get_chosen(web.figure, "camera", web.message, sizeof web.message);
    web.message[strcspn(web.message, "\n")] = '\0';
    return web.message;
}

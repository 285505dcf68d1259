/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the viewer writes: pictures as cgt-render does, key frames for its --camera-keys, the camera for its -c. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "common/out_file.h"
#include "common/out_path.h"
#include "view/viewer/viewer_internal.h"

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

/* A pattern whose file is not there: view_%04d.png, then view_%04d-2.png and so on. name gets the file's. */
static int find_name(const viewer *v, char *pattern, char *name, size_t size)
{
    const char *const wanted = v->options.pictures, *const dot = strrchr(wanted, '.');
    const size_t stem = dot ? (size_t)(dot - wanted) : strlen(wanted);
    out_path path;
    char error[PROGRAM_ERROR_SIZE];
    for (int i = 1; i < 100000; i++) {
        const int length = i == 1 ? snprintf(pattern, size, "%s", wanted)
                                  : snprintf(pattern, size, "%.*s-%d%s", (int)stem, wanted, i, wanted + stem);
        if (length < 0 || (size_t)length >= size || out_path_parse(&path, pattern, error, sizeof error) ||
            out_path_name(&path, v->shown->frame.number, name, size))
            return -1;
        if (access(name, F_OK) != 0)
            return 0;
    }
    return -1;
}

/* Whether files of --pictures can have the picture's background; else a message is printed. */
static int holds_opacity(const viewer *v)
{
    char error[PROGRAM_ERROR_SIZE];
    const int transparent = view_draw_has(v->draw, "transparent");
    const int failed = view_options_check_opacity(transparent, v->options.pictures, error, sizeof error);
    if (failed)
        program_error("%s", error);
    return !failed;
}

void viewer_write_picture(viewer *v)
{
    char pattern[4096], name[4096], error[PROGRAM_ERROR_SIZE];
    if (!v->shown || v->scene_is_wrong || !holds_opacity(v))
        return;
    if (find_name(v, pattern, name, sizeof name)) {
        program_error("%s: there is no name left for a picture", v->options.pictures);
        return;
    }
    if (out_path_make_folder(name, error, sizeof error)) {
        program_error("%s", error);
        return;
    }
    if (view_draw_tell(v->draw, cgt_figure_set_camera(v->draw->figure, &v->camera)))
        return;
    char *const settings = view_draw_settings(v->draw);
    if (settings && view_draw_write(v->draw, settings, name) == 0) {
        char *const command = view_command(v->draw, settings, v->shown, pattern);
        printf("%s", command ? command : "");
        fflush(stdout);
        free(command);
        viewer_say(v, "wrote %s", name);
    }
    free(settings);
    v->outdated = v->changed = 1;
}

/* ---- Key frames --------------------------------------------------------------------------------------------- */

/* The whole file; "" where there is none; NULL with the message printed. */
static char *read_file(const char *path)
{
    FILE *const file = fopen(path, "rb");
    char *text = malloc(1);
    size_t size = 0, got;
    if (text)
        *text = '\0';
    if (!file && errno == ENOENT)
        return text;
    do {
        char *const more = text && file ? realloc(text, size + 65536 + 1) : NULL;
        text = more ? more : text;
        got = more ? fread(more + size, 1, 65536, file) : 0;
        size += got;
        if (more)
            more[size] = '\0';
    } while (got > 0);
    const int failed = !file || ferror(file) || !text || strlen(text) != size;
    if (file)
        fclose(file);
    if (!failed)
        return text;
    program_error("%s: cannot read the key frames that are there", path);
    free(text);
    return NULL;
}

/* Copies the lines of the file, with the new key in the place of the one of its frame, or in order. */
static void merge_keys(const char *text, uint64_t frame, const char *key, FILE *to)
{
    int done = 0;
    for (const char *line = text; *line;) {
        const size_t length = strcspn(line, "\n");
        char *end;
        const uint64_t number = strtoull(line, &end, 10);
        const int is_key = end != line;
        if (is_key && number >= frame && !done) {
            fputs(key, to);
            done = 1;
        }
        if (!is_key || number != frame)
            fprintf(to, "%.*s\n", (int)length, line);
        line += length + (line[length] == '\n');
    }
    if (!done)
        fputs(key, to);
}

/* The camera as -c takes it, without the line feed. */
static char *camera_text(const viewer *v)
{
    if (view_draw_tell(v->draw, cgt_figure_set_camera(v->draw->figure, &v->camera)))
        return NULL;
    char *const text = view_draw_get(v->draw, cgt_figure_get_chosen, "camera");
    if (text)
        text[strcspn(text, "\n")] = '\0';
    return text;
}

/* Written at once, and whole or not at all: what ends the program later loses no key. */
void viewer_add_key(viewer *v)
{
    const char *const path = v->options.keys;
    char error[PROGRAM_ERROR_SIZE], key[1024];
    out_file out;
    if (!v->shown)
        return;
    const uint64_t frame = v->shown->frame.number;
    char *const camera = camera_text(v), *const before = camera ? read_file(path) : NULL;
    const char *const name = before ? out_file_begin(&out, path, error, sizeof error) : NULL;
    if (before && !name)
        program_error("%s", error);
    if (name) {
        snprintf(key, sizeof key, "%" PRIu64 " %s\n", frame, camera);
        FILE *const to = fopen(name, "wb");
        if (to)
            merge_keys(before, frame, key, to);
        const int failed = !to || ferror(to), closed = to ? fclose(to) : -1;
        if (out_file_end(&out, !failed && closed == 0, error, sizeof error))
            program_error("%s", error);
        else if (failed || closed)
            program_error("%s: cannot be written", path);
        else
            viewer_say(v, "key frame %" PRIu64 " is in %s", frame, path);
    }
    free(before);
    free(camera);
}

/* ---- The clipboard ------------------------------------------------------------------------------------------ */

/* Takes the text over, and prints it, too. */
static void copy(viewer *v, char *text, const char *what)
{
    if (!text)
        return;
    printf("%s%s", text, text[0] && text[strlen(text) - 1] == '\n' ? "" : "\n");
    fflush(stdout);
    pthread_mutex_lock(&v->lock);
    free(v->clipboard);
    v->clipboard = text;
    pthread_mutex_unlock(&v->lock);
    viewer_say(v, "%s in the clipboard", what);
}

void viewer_copy_camera(viewer *v)
{
    char *const text = camera_text(v), *copied = text ? malloc(strlen(text) + 4) : NULL;
    if (copied)
        sprintf(copied, "-c %s", text);
    copy(v, copied, "the camera is, as -c takes it,");
    free(text);
}

/* Settings of the picture at hand; NULL: there is none. */
static char *settings_of_picture(viewer *v)
{
    if (!v->shown || v->scene_is_wrong || view_draw_tell(v->draw, cgt_figure_set_camera(v->draw->figure, &v->camera)))
        return NULL;
    return view_draw_settings(v->draw);
}

void viewer_copy_command(viewer *v)
{
    char *const settings = holds_opacity(v) ? settings_of_picture(v) : NULL;
    if (settings)
        copy(v, view_command(v->draw, settings, v->shown, v->options.pictures), "the command line of the picture is");
    free(settings);
}

void viewer_copy_python(viewer *v)
{
    char *const settings = settings_of_picture(v);
    if (settings)
        copy(v, view_command_python(v->draw, settings, v->shown), "Python for the picture is");
    free(settings);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pictures of a file by <cgt/figure.h>, as bytes on standard output, for doors.sh to compare with cgt-render's.
 *   figure_raw COLUMNS|FRAMES|KEPT FILE [NAME[=VALUE]...]
 * COLUMNS: the frames' arrays are given as columns; FRAMES: the frames as they are; KEPT: the same, kept before they
 * are shown. The locale is that of the environment. */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/figure.h>
#include <cgt/trajectory.h>

enum { MOST = CGT_TRAJECTORY_MOST_COLUMNS };

static int fail(const char *what, const char *why)
{
    fprintf(stderr, "figure_raw: %s: %s\n", what, why);
    return 1;
}

static int fail_figure(const cgt_figure *figure)
{
    char text[1024];
    cgt_figure_get_error_message(figure, text, sizeof text);
    return fail("figure", text);
}

static int fail_file(const cgt_trajectory *file)
{
    char text[1024];
    cgt_trajectory_get_error_message(file, text, sizeof text);
    return fail("file", text);
}

/* A frame as a program has it, in columns. */
static void give_columns(const cgt_trajectory_frame *f, cgt_figure_data *data, cgt_figure_column columns[MOST + 4],
                         const char **words[MOST], double **place)
{
    const size_t stride = 4 * sizeof(float);
    uint32_t count = 0;
    *data = (cgt_figure_data){.number = f->number, .step = f->step, .time = &f->time, .angstrom = f->angstrom};
    data->points.count = f->count;
    *place = realloc(*place, (3 * (size_t)f->count + 1) * sizeof **place);
    for (size_t i = 0; i < f->count && *place; i++)
        for (size_t c = 0; c < 3; c++)
            (*place)[3 * i + c] = (double)(f->xyzr ? f->xyzr[4 * i + c] : f->position[3 * i + c]) + f->origin[c];
    data->points.positions = cgt_doubles(*place, 0);
    memcpy(data->origin, f->origin, sizeof data->origin);
    if (f->xyzr)
        columns[count++] = (cgt_figure_column){.name = "radius", .values = cgt_floats(f->xyzr + 3, stride)};
    if (f->element)
        columns[count++] = (cgt_figure_column){.name = "element", .values = cgt_uint8s(f->element, 0)};
    if (f->type)
        columns[count++] = (cgt_figure_column){.name = "type", .values = cgt_uint32s(f->type, 0)};
    if (f->id)
        columns[count++] = (cgt_figure_column){.name = "id", .values = cgt_uint32s(f->id, 0)};
    if (f->velocity)
        columns[count++] = (cgt_figure_column){.name = "velocity", .values = cgt_floats(f->velocity, 0)};
    for (uint32_t i = 0; i < f->columns; i++) {
        const cgt_trajectory_column *const c = &f->column[i];
        static const char taken[] = " x y z vx vy vz radius element type id ";
        char word[70];
        snprintf(word, sizeof word, " %.60s ", c->name);
        if (!c->value || strstr(taken, word))
            continue;
        columns[count] = (cgt_figure_column){.name = c->name, .values = cgt_floats(c->value, 0)};
        if (c->kind == CGT_TRAJECTORY_WORD) {
            words[i] = realloc(words[i], (c->words + 1) * sizeof *words[i]);
            for (uint32_t w = 0; w < c->words && words[i]; w++)
                words[i][w] = c->word[w];
            columns[count].words = words[i];
            columns[count].word_count = c->words;
        }
        count++;
    }
    data->points.columns = columns;
    data->points.column_count = count;
    if (f->index)
        data->triangles = (cgt_figure_triangles){f->triangles, cgt_uint32s(f->index, 0)};
    data->bonds = (cgt_figure_bonds){f->bonds, f->bond};
    for (int c = 0; c < 3; c++)
        data->box.corner[c] = f->box_origin[c] + f->origin[c];
    memcpy(data->box.edges, f->box_edge, sizeof data->box.edges);
    memcpy(data->box.periodic, f->periodic, sizeof data->box.periodic);
    memcpy(data->box.unwrapped, f->unwrapped, sizeof data->box.unwrapped);
}

/* The first frame of a file of triangles. */
static int give_mesh(cgt_figure *figure, const char *path)
{
    cgt_trajectory *file = NULL;
    cgt_trajectory_frame frame;
    const cgt_figure_data mesh = {.frame = &frame};
    if (cgt_trajectory_open(path, NULL, &file) || cgt_trajectory_read(file, &frame))
        return fail_file(file);
    const int failed = cgt_figure_set_mesh(figure, &mesh) ? fail_figure(figure) : 0;
    cgt_trajectory_close(file); /* which was copied */
    return failed;
}

/* All columns of the file are read. */
static cgt_result want_columns(cgt_trajectory *file)
{
    cgt_trajectory_frame frame;
    const char *names[MOST];
    cgt_result result = cgt_trajectory_read(file, &frame);
    for (uint32_t i = 0; i < frame.columns && i < MOST && !result; i++)
        names[i] = frame.column[i].name;
    if (!result)
        result = cgt_trajectory_want_columns(file, names, frame.columns < MOST ? frame.columns : MOST);
    return result ? result : cgt_trajectory_rewind(file);
}

/* Keeps a frame; where it is to be shown, it is, in the place of the one before. */
static int keep(cgt_figure *figure, const cgt_figure_data *data, int is_shown, cgt_figure_frame **shown)
{
    cgt_figure_frame *frame = NULL;
    char text[1024];
    uint64_t lead;
    if (cgt_figure_begin_keep(figure, &lead))
        return fail_figure(figure);
    if (cgt_figure_keep(figure, data, is_shown ? &frame : NULL, text, sizeof text))
        return fail("frame", text);
    if (*text)
        fprintf(stderr, "%s\n", text);
    if (is_shown && cgt_figure_show_frame(figure, frame))
        return fail_figure(figure);
    cgt_figure_frame_release(*shown);
    *shown = frame;
    return 0;
}

int main(int argc, char **argv)
{
    static cgt_figure_column columns[MOST + 4];
    static const char **words[MOST];
    enum { WIDTH = 96, HEIGHT = 64 };
    static uint8_t rgb[HEIGHT][WIDTH][3];
    double *place = NULL;
    cgt_context *context = NULL;
    cgt_figure *figure = NULL;
    cgt_trajectory *file = NULL;
    cgt_trajectory_frame frame;
    cgt_figure_frame *shown = NULL;
    cgt_result result = CGT_OK;
    setlocale(LC_ALL, "");
    if (argc < 3)
        return fail("arguments", "COLUMNS|FRAMES|KEPT FILE [NAME[=VALUE]...]");
    const int gives_columns = strcmp(argv[1], "COLUMNS") == 0, keeps = strcmp(argv[1], "KEPT") == 0;
    if (cgt_context_create(NULL, &context) || cgt_figure_create(context, &figure))
        return fail("context", "cannot be made");
    if (cgt_figure_set(figure, "size", "96x64"))
        return fail_figure(figure);
    for (int i = 3; i < argc; i++) {
        char *const value = strchr(argv[i], '=');
        if (value)
            *value = '\0';
        if (strcmp(argv[i], "mesh") == 0 && value                       ? give_mesh(figure, value + 1)
            : cgt_figure_set(figure, argv[i], value ? value + 1 : NULL) ? fail_figure(figure)
                                                                        : 0)
            return 1;
    }
    cgt_trajectory_options reading;
    cgt_trajectory_options_init(&reading);
    reading.leave_out_sites = true;     /* as cgt-render has it */
    reading.all_bonds = !gives_columns; /* of columns the figure guesses them */
    if (cgt_trajectory_open(argv[2], &reading, &file) || want_columns(file))
        return fail_file(file);
    const int last = keeps ? 2 : 1;
    for (int turn = 0; turn <= last;
         turn++) { /* look at all, show each; between that keep them, for the first's speeds */
        while ((result = cgt_trajectory_read(file, &frame)) == CGT_OK) {
            cgt_figure_data data = {.frame = &frame};
            const cgt_image image = {.bytes = rgb[0][0]};
            if (gives_columns)
                give_columns(&frame, &data, columns, words, &place);
            if (turn > 0 && keeps) {
                if (keep(figure, &data, turn == last, &shown))
                    return 1;
            } else if (turn == 0 ? cgt_figure_survey(figure, &data) : cgt_figure_show(figure, &data)) {
                return fail_figure(figure);
            }
            if (turn < last)
                continue;
            if (cgt_figure_draw(figure, &image, NULL))
                return fail_figure(figure);
            if (fwrite(rgb, sizeof rgb, 1, stdout) != 1)
                return fail("standard output", "cannot be written");
        }
        if (result != CGT_END)
            return fail_file(file);
        double origin[3];
        if (turn == 0 && cgt_figure_get_origin(figure, origin)) {
            cgt_trajectory_set_origin(file, origin);
            turn = -1;
        }
        if (cgt_trajectory_rewind(file))
            return fail_file(file);
    }
    for (const char *notice; (notice = cgt_figure_take_notice(figure)) != NULL;)
        fprintf(stderr, "%s\n", notice);
    for (uint32_t i = 0; i < MOST; i++)
        free(words[i]);
    free(place);
    cgt_figure_release(figure);
    cgt_figure_frame_release(shown);
    cgt_trajectory_close(file);
    cgt_context_release(context);
    return 0;
}

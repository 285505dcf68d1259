/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Figures: from columns of particles, meshes, bonds and a box, and options that say how to show them, to the pixels of
 * a labelled picture, the same that cgt-render makes. In outline:
 *
 *   cgt_figure_create(context, &figure);
 *   cgt_figure_set(figure, "color", "charge");              what cgt-render --color=charge means
 *   cgt_figure_set(figure, "colorbar", "charge, e");
 *   while (next(&data))
 *       cgt_figure_survey(figure, &data);                   camera, range and legend are those of all frames
 *   while (next(&data)) {
 *       cgt_figure_show(figure, &data);
 *       cgt_figure_draw(figure, &image, NULL);
 *   }
 *
 * (examples/draw_figure.c is a whole program.) Without a survey camera and range are those of the first frame that is
 * shown. The same options and frames give the same bytes as cgt-render's, for any number of threads and any variant;
 * texts depend on FreeType and the font.
 *
 * Conventions are those of cgt.h and picture.h. Options and data are in the data's own coordinates, whatever origin is
 * subtracted from them.
 * Errors   Functions give a cgt_result; the figure has the sentence. A call of cgt_figure_set that fails changes
 *          nothing; after another one that fails the survey begins anew.
 * Threads  One thread at a time calls a figure.
 * Numbers  are read and written with a point, whatever the locale of the process is. */
#ifndef CGT_FIGURE_H
#define CGT_FIGURE_H

#include <cgt/picture.h>

#ifdef __cplusplus
extern "C" {
#endif

struct cgt_trajectory_frame; /* <cgt/trajectory.h> */

typedef struct cgt_figure cgt_figure;

/* ---- Data --------------------------------------------------------------------------------------------------- */

/* A column: what each particle or vertex has, floats, doubles or halves; id, type and element may be whole numbers.
 * Some names mean something: radius, id, type, element (atomic number), velocity (three numbers), normal (three; of
 * vertices), rgb (three, linear; of particles, where no option says what colours show). Others are for formulas and
 * colours. */
typedef struct cgt_figure_column {
    const char *name;
    cgt_array values;
    const char *const *words; /* value v means words[v - 1], of at most 63 letters, 0 none; NULL (default): numbers */
    uint32_t word_count;
} cgt_figure_column;

typedef struct cgt_figure_points {
    uint32_t count;      /* of particles, or of vertices if there are triangles */
    cgt_array positions; /* x, y, z each, rounded to float after the origin was subtracted */
    const cgt_figure_column *columns;
    uint32_t column_count;
    float radius; /* of particles without a column radius; 0 (default): by element, else 0.5 */
} cgt_figure_points;

/* Three vertices each. corners without data: the points are particles. */
typedef struct cgt_figure_triangles {
    uint32_t count;
    cgt_array corners;
} cgt_figure_triangles;

/* Two particles each, once each. count 0 and ends not NULL: it is known that there are none. */
typedef struct cgt_figure_bonds {
    uint32_t count;
    const uint32_t *ends;
} cgt_figure_bonds;

typedef struct cgt_figure_box {
    double corner[3], edges[3][3]; /* edges 0 (default): there is no box */
    int8_t periodic[3];            /* along each edge: 1 periodic; 0 (default) not; -1 unknown, as if it were */
    bool unwrapped[3];             /* positions go on beyond that boundary */
} cgt_figure_box;

/* A frame of a run: the caller's arrays, needed during a call only. */
typedef struct cgt_figure_data {
    const struct cgt_trajectory_frame *frame; /* as it was read, in place of all below; NULL (default): none */
    uint64_t number;    /* in the run, from 0: speeds and trails are of frames whose numbers follow each other */
    int64_t step;       /* rises from frame to frame */
    const double *time; /* NULL (default): unknown */
    cgt_figure_points points;
    cgt_figure_triangles triangles;
    cgt_figure_bonds bonds;
    cgt_figure_box box;
    float angstrom;   /* in the unit of lengths; 0 (default): 1 */
    double origin[3]; /* subtracted from positions and box in double; the same in all frames */
} cgt_figure_data;

/* ---- The figure --------------------------------------------------------------------------------------------- */

/* Creates a figure.
 *   context   of its scenes; must outlive it
 *   figure    gets it; NULL if there is no memory for it
 * Errors: OUT_OF_MEMORY, INVALID_ARGUMENT */
CGT_API cgt_result cgt_figure_create(cgt_context *context, cgt_figure **figure);

/* Releases a figure; NULL does nothing. */
CGT_API void cgt_figure_release(cgt_figure *figure);

/* Copies the message of the last call that failed, as cgt_context_get_error_message does. */
CGT_API size_t cgt_figure_get_error_message(const cgt_figure *figure, char *text, size_t size);

/* Returns the next thing that was chosen or is doubtful and that a user should read, such as what a camera leaves out;
 * NULL: nothing new. Valid until the next call. */
CGT_API const char *cgt_figure_take_notice(cgt_figure *figure);

/* ---- Options ------------------------------------------------------------------------------------------------ */

typedef enum cgt_figure_kind {
    CGT_FIGURE_SWITCH = 0, /* on, without a value */
    CGT_FIGURE_WORD,       /* one of `words` */
    CGT_FIGURE_NUMBER,     /* from low to high */
    CGT_FIGURE_WHOLE,      /* the same, without a fraction */
    CGT_FIGURE_COLOR,      /* RRGGBB, or a name such as red */
    CGT_FIGURE_TEXT,       /* a title, a path */
    CGT_FIGURE_FORMULA,    /* over columns */
    CGT_FIGURE_LIST        /* of the form that `value` shows */
} cgt_figure_kind;

/* What may be said of a figure: a row of the table that help, panels and keywords are made from. */
typedef struct cgt_figure_option {
    const char *name;  /* "type-color" */
    const char *group; /* "What is drawn:" */
    const char *value; /* how help calls the value; NULL: there is none */
    const char *help;
    const char *words;     /* values that can be offered, with blanks between them; NULL: none */
    const char *otherwise; /* the value where an optional one is left out; NULL: none */
    cgt_figure_kind kind;
    double low, high; /* of numbers */
    bool is_optional; /* the value may be left out */
    bool repeats;     /* each value is added to those before it */
} cgt_figure_option;

/* Gets the option of an index from 0 on. Its texts are valid forever. Returns whether there is one. */
CGT_API bool cgt_figure_get_option(uint32_t index, cgt_figure_option *option);

/* Sets an option. A value replaces the one before, or is added where the option repeats. After a frame was given, the
 * survey begins anew.
 *   value   NULL: without a value; copied
 * Errors: INVALID_ARGUMENT (there is no such option; the value; it does not go with another option), OUT_OF_MEMORY */
CGT_API cgt_result cgt_figure_set(cgt_figure *figure, const char *name, const char *value);

/* Takes back all that was set of an option; NULL: of all options. Errors: as cgt_figure_set */
CGT_API cgt_result cgt_figure_unset(cgt_figure *figure, const char *name);

/* Copies what was set: the values of an option, a line each; name NULL: of all options, lines "name = value" of a
 * settings file. Returns the length of the whole text; 0: nothing was set. */
CGT_API size_t cgt_figure_get(const cgt_figure *figure, const char *name, char *text, size_t size);

/* Sets a mesh that stands still among the particles, such as walls; its points, triangles and column normal are copied,
 * less its origin, which is that of the frames. NULL: none. After a frame was given, the survey begins anew.
 * Errors: INVALID_ARGUMENT (it has no triangles; as cgt_figure_show), OUT_OF_MEMORY */
CGT_API cgt_result cgt_figure_set_mesh(cgt_figure *figure, const cgt_figure_data *mesh);

/* ---- A run -------------------------------------------------------------------------------------------------- */

/* Looks at a frame: automatic camera, ranges and legend follow all frames that were looked at, in order. Speeds of
 * frame 0 are those towards frame 1 where that was looked at. A frame after one that was shown begins a new survey.
 * Errors: as cgt_figure_show */
CGT_API cgt_result cgt_figure_survey(cgt_figure *figure, const cgt_figure_data *data);

/* Ends a survey. Returns whether its frames, or the camera that is set, lie so far from 0 that single precision shows:
 * then frames had better be given less this origin, and surveyed anew. */
CGT_API bool cgt_figure_get_origin(cgt_figure *figure, double origin[3]);

/* Makes a frame the one that is drawn: what is shown, colours, bonds, the scene's commit. The data are copied.
 * Errors: INVALID_ARGUMENT (what the options ask for is not there, or wrong), OUT_OF_MEMORY, TOO_LARGE */
CGT_API cgt_result cgt_figure_show(cgt_figure *figure, const cgt_figure_data *data);

/* Gets the camera of the shown frame, less the data's origin. Errors: INVALID_ARGUMENT: nothing is shown */
CGT_API cgt_result cgt_figure_get_camera(const cgt_figure *figure, cgt_camera *camera);

/* Makes a whole picture of the option size with its texts.
 *   image     texts need rows without gaps and three channels
 *   options   of the camera's rays; NULL: the defaults
 * Errors: INVALID_ARGUMENT (nothing is shown), OUT_OF_MEMORY, and those of cgt_picture_draw */
CGT_API cgt_result cgt_figure_draw(cgt_figure *figure, const cgt_image *image, const cgt_trace_options *options);

#ifdef __cplusplus
}
#endif

#endif

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
 * texts depend on FreeType and the installed fonts.
 *
 * Conventions are those of cgt.h and picture.h. Options and data are in the data's own coordinates, whatever origin is
 * subtracted from them.
 * Errors   Functions give a cgt_result; the figure has the sentence. A call of cgt_figure_set that fails changes
 *          nothing, but may end a picture that has begun; after another one that fails the survey begins anew.
 * Threads  One thread at a time calls a figure; beside it one more may be in cgt_figure_keep, with the option trails
 *          not while a frame is shown or an option set.
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
 * Some names mean something: radius, id, type, element (atomic number; these four of particles), velocity (three
 * numbers), normal (three; of vertices), rgb (three, linear; of particles, where no option says what colours show).
 * Others are for formulas and colours. */
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

/* Two particles each, once each. count 0 and ends not NULL: it is known that there are none. ends NULL (default): where
 * options ask for bonds they are guessed by the covalent radii of the column element, as cgt-render does for files. */
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

/* Sets how messages call the data, such as a path; the text must outlive the figure. */
CGT_API void cgt_figure_set_source(cgt_figure *figure, const char *name);

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
 * survey begins anew. But where frames are kept what was found stays, and the shown frame is made anew at once: colours
 * or a camera that the option changes are those of this frame, a camera of cgt_figure_set_camera ends with the second.
 *   value   NULL: without a value; copied, with blanks in place of ends of lines
 * Errors: INVALID_ARGUMENT (there is no such option; the value; it does not go with another option; unwrap, whole,
 *         trails and type-element once cgt_figure_begin_keep was called), OUT_OF_MEMORY; where frames are kept as
 *         cgt_figure_show, too */
CGT_API cgt_result cgt_figure_set(cgt_figure *figure, const char *name, const char *value);

/* Sets options by lines "name = value", or "name" alone, of a settings file, in their order; what needs several of them
 * is checked after the last, and a line that is refused has none of them set. Errors: as cgt_figure_set */
CGT_API cgt_result cgt_figure_set_lines(cgt_figure *figure, const char *settings);

/* Takes back all that was set of an option; NULL: of all options. Errors: as cgt_figure_set */
CGT_API cgt_result cgt_figure_unset(cgt_figure *figure, const char *name);

/* Copies what was set: the values of an option, a line each; name NULL: of all options, lines "name = value" of a
 * settings file. Returns the length of the whole text; 0: nothing was set. */
CGT_API size_t cgt_figure_get(const cgt_figure *figure, const char *name, char *text, size_t size);

/* Copies settings by which another figure makes the same picture of the shown frame: what was set, and in the place of
 * automatic ones camera, size, antialias, color, range, floor-axis and floor-place as they were chosen; where the
 * camera has moved on from that of the first frame, light and ambient-radius, too, which follow that one; log-scale
 * only where the colours have it. What is of several frames is not told: legends, the colours of words and categories,
 * and glass are those of the frames that the other figure looks at; speeds and trails need the frames before.
 *   name   the value of one of these seven, or light; NULL: all settings
 * Returns as cgt_figure_get; 0: nothing was chosen yet. */
CGT_API size_t cgt_figure_get_chosen(const cgt_figure *figure, const char *name, char *text, size_t size);

/* Sets a mesh that stands still among the particles, such as walls; its points, triangles and column normal are copied,
 * less its origin, which is that of the frames. NULL: none. After a frame was given, the survey begins anew.
 * Errors: INVALID_ARGUMENT (it has no triangles; as cgt_figure_show), OUT_OF_MEMORY */
CGT_API cgt_result cgt_figure_set_mesh(cgt_figure *figure, const cgt_figure_data *mesh);

/* ---- A run -------------------------------------------------------------------------------------------------- */

/* Looks at a frame: automatic camera, ranges and legend follow all frames that were looked at, in order. Speeds of
 * frame 0 are those towards frame 1 where that was looked at. A frame after one that was shown begins a new survey.
 * Errors: as cgt_figure_show; the survey is then what it was before, without this frame */
CGT_API cgt_result cgt_figure_survey(cgt_figure *figure, const cgt_figure_data *data);

/* Returns whether the options ask for another frame to be looked at; the first is needed in any case. */
CGT_API bool cgt_figure_needs_frame(const cgt_figure *figure);

/* Ends a survey. Returns whether its frames, or the camera that is set, lie so far from 0 that single precision shows:
 * then frames had better be given less this origin, and surveyed anew. */
CGT_API bool cgt_figure_get_origin(cgt_figure *figure, double origin[3]);

/* Makes a frame the one that is drawn: what is shown, colours, bonds, the scene's commit. The data are copied.
 * Errors: INVALID_ARGUMENT (what the options ask for is not there, or wrong), OUT_OF_MEMORY, TOO_LARGE; then none is
 *         shown, and the survey stays, unless the frame is of another kind: triangles, or particles; without a survey,
 *         what was found of this frame does not stay */
CGT_API cgt_result cgt_figure_show(cgt_figure *figure, const cgt_figure_data *data);

/* ---- Frames that are kept ----------------------------------------------------------------------------------- */

/* A frame with all that it has, for a program that shows frames in any order, or reads them in a thread of its own. */
typedef struct cgt_figure_frame cgt_figure_frame;

/* Begins to keep frames, and ends the survey. May be called again. Frames that are not kept may still be shown, with
 * trails of their own.
 *   lead   gets how many frames before one must be given for its speeds, trails and molecules
 * Errors: as cgt_figure_show */
CGT_API cgt_result cgt_figure_begin_keep(cgt_figure *figure, uint64_t *lead);

/* Keeps a frame: the data are copied, molecules put together as the options say, speeds found. Trails are those of the
 * frame that was kept last. Speeds of frame 0 are those towards frame 1 where that was given after it, and then frame 0
 * again.
 *   frame   gets it; NULL: it only goes before others
 *   text    gets why it fails, or what a user should read; "": nothing
 * Threads: any one thread, also beside another call
 * Errors:  INVALID_ARGUMENT, OUT_OF_MEMORY, as cgt_figure_show */
CGT_API cgt_result cgt_figure_keep(cgt_figure *figure, const cgt_figure_data *data, cgt_figure_frame **frame,
                                   char *text, size_t size);

/* Returns the bytes that it takes, and the frame as <cgt/trajectory.h> has it; valid as long as it. */
CGT_API size_t cgt_figure_frame_get_bytes(const cgt_figure_frame *frame);
CGT_API const struct cgt_trajectory_frame *cgt_figure_frame_get_data(const cgt_figure_frame *frame);

/* Releases a frame; one that is shown is taken away first, by the thread that calls the figure. NULL does nothing. */
CGT_API void cgt_figure_frame_release(cgt_figure_frame *frame);

/* Makes it the one that is drawn, in place, until another one is, or another figure shows it. One that another figure
 * has kept is as the options of that one say.
 * Errors: as cgt_figure_show, then none is shown; INVALID_ARGUMENT (trails of a figure that has kept no frames) */
CGT_API cgt_result cgt_figure_show_frame(cgt_figure *figure, cgt_figure_frame *frame);

/* ---- The camera --------------------------------------------------------------------------------------------- */

/* Gets the camera of the shown frame, before that of the first one, less the data's origin.
 * Errors: INVALID_ARGUMENT: nothing is shown, and no survey has ended */
CGT_API cgt_result cgt_figure_get_camera(const cgt_figure *figure, cgt_camera *camera);

/* Gets the axis that points up by the options, else the camera's up. Errors: as cgt_figure_get_camera */
CGT_API cgt_result cgt_figure_get_up(const cgt_figure *figure, float up[3]);

/* Sets the camera of all frames, less the data's origin, in place of that of the options; zeros are the defaults of
 * cgt_camera, projection and height are by the option ortho. Lines, such as edges of the box, have the thickness that
 * this camera asks for from the next cgt_figure_draw or _begin on, but those of a frame that is not kept from the next
 * cgt_figure_show on.
 * Errors: INVALID_ARGUMENT (what cgt_camera and the option camera refuse: eye and target are the same, up is along the
 *         view, fov is not below 180, a number is not finite); the camera is the one before */
CGT_API cgt_result cgt_figure_set_camera(cgt_figure *figure, const cgt_camera *camera);

/* Moves the camera so that it shows all of the shown frame, in the same direction; it is then one that was set.
 * Errors: INVALID_ARGUMENT: there is nothing */
CGT_API cgt_result cgt_figure_fit(cgt_figure *figure);

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

/* Sets what is asked while pictures are made that begin from now on: true ends the call with STOPPED. NULL: nothing.
 * Quick pictures do not ask. */
CGT_API void cgt_figure_set_stop(cgt_figure *figure, bool (*stop)(const void *user), const void *user);

/* Makes a whole picture of the option size with its texts.
 *   image     as of cgt_picture_draw
 *   options   of the camera's rays; NULL: the defaults
 * Errors: INVALID_ARGUMENT (nothing is shown), OUT_OF_MEMORY, and those of cgt_picture_draw */
CGT_API cgt_result cgt_figure_draw(cgt_figure *figure, const cgt_image *image, const cgt_trace_options *options);

/* The same in steps, as cgt_picture_begin, _step and _read; the background is never transparent. After the last step
 * the picture is that of cgt_figure_draw. A camera that is set meanwhile is that of the next picture.
 * Errors: as cgt_figure_draw; INVALID_ARGUMENT (no picture has begun since a frame was shown or released, or an option
 *         set; an option that the shown frame refuses ends a picture, too) */
CGT_API cgt_result cgt_figure_begin(cgt_figure *figure);
CGT_API cgt_result cgt_figure_step(cgt_figure *figure, uint32_t samples, uint32_t *left);
CGT_API cgt_result cgt_figure_read(cgt_figure *figure, const cgt_image *image);

typedef enum cgt_figure_quality {
    CGT_FIGURE_PLAIN = 0, /* no shadows; mirrors and glass are matt */
    CGT_FIGURE_SHADOWS,   /* the same with hard shadows */
    CGT_FIGURE_QUALITIES
} cgt_figure_quality;

/* Makes a picture that takes less time, without antialiasing and occlusion. Lines keep the thickness of the camera that
 * the frame was shown with.
 *   shrink   one ray for so many pixels along each edge; 1: each has its own
 * Errors: as cgt_figure_draw; INVALID_ARGUMENT (the image has no bytes, or gaps between its rows) */
CGT_API cgt_result cgt_figure_draw_quick(cgt_figure *figure, cgt_figure_quality quality, uint32_t shrink,
                                         const cgt_image *image);

/* ---- What is there ------------------------------------------------------------------------------------------ */

/* What a pixel shows. */
typedef struct cgt_figure_hit {
    bool is_hit;
    bool is_data;     /* a particle or triangle of the data; else a bond, a line, the floor, the mesh */
    uint32_t element; /* its number in the data */
    float t;
    float place[3]; /* less the data's origin */
} cgt_figure_hit;

/* Finds it, within t_min, t_max and mask of the camera. Errors: INVALID_ARGUMENT (nothing is shown; a pixel that is not
 * in the picture) */
CGT_API cgt_result cgt_figure_pick(cgt_figure *figure, uint32_t x, uint32_t y, cgt_figure_hit *hit);

/* Copies what is known of a particle or triangle of the shown frame, in lines: number, id, type, element; of particles
 * place, radius, each column, the speed. Frames that are not kept have neither ids, types, elements nor columns.
 * Returns the length of the whole text; 0: there is none. */
CGT_API size_t cgt_figure_describe(const cgt_figure *figure, uint32_t element, char *text, size_t size);

#ifdef __cplusplus
}
#endif

#endif

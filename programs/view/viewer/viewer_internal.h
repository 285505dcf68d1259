/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The state of the viewer, and what its parts offer each other. */
#ifndef VIEWER_INTERNAL_H
#define VIEWER_INTERNAL_H

#include <pthread.h>

#include "common/program.h"
#include "data/measure.h"
#include "options/figure_settings.h"
#include "system/process.h"
#include "text/text.h"
#include "view/view_camera.h"
#include "view/view_draw.h"
#include "view/viewer/viewer.h"

enum { VIEW_CHANGES = 100, VIEW_SENTENCE = 1024 };
#define VIEW_ALL UINT32_MAX /* in place of an option */
enum { VIEW_PICKS = MEASURE_MOST, VIEW_MESSAGES = 6, VIEW_LIST_MOST = 300, VIEW_LEVELS = 6 };

/* A sphere or triangle that was clicked. It is followed through the frames by its id, where there are ids. */
typedef struct view_pick {
    uint32_t element; /* in the frame that is shown; UINT32_MAX: it is not there */
    uint32_t id;
    float place[3];  /* centre of a sphere, hit of a triangle */
    double share[2]; /* of the triangle's second and third corner */
} view_pick;

typedef struct view_message {
    char text[512];
    double until; /* seconds; 0: it was not yet seen */
} view_message;

/* An option as other threads see it, each NULL for "". */
typedef struct view_option {
    char *values;  /* as cgt_figure_get has them */
    char *refused; /* why what was put last is not among them */
} view_option;

/* What a file that was opened in the window needs: the names of files, and the texts of the options. */
typedef struct view_opened {
    char *paths, **inputs;
    figure_settings settings;
} view_opened;

/* What a formula selects. */
typedef struct view_filter {
    char *formula; /* NULL: none */
    int64_t count; /* of the shown frame; -1: the formula is wrong */
    int is_followed;
    double center[3]; /* where the middle was */
} view_filter;

/* A movie that is being made by cgt-render. */
typedef struct view_movie {
    int is_made, is_stopped;
    process_child child;
    FILE *messages;
    char name[64], log[1024];
    uint64_t frames; /* so far */
} view_movie;

/* What can be undone; what one event has changed is undone together. */
typedef struct view_change {
    uint32_t option; /* VIEW_ALL: of a settings file that was loaded */
    char *before;    /* its values; of all the lines */
    int has_camera;  /* the file had one; before it was: */
    cgt_camera camera;
    uint64_t event;
} view_change;

typedef enum view_quality {
    VIEW_PLAIN = CGT_FIGURE_PLAIN,
    VIEW_SHADOWS = CGT_FIGURE_SHADOWS,
    VIEW_FULL = CGT_FIGURE_QUALITIES /* as cgt-render */
} view_quality;

typedef enum view_drag { DRAG_NONE = 0, DRAG_TURN, DRAG_PAN, DRAG_BAR } view_drag;

struct viewer {
    view_options options;
    viewer_wake *wake;
    void *user;
    int opens;       /* the first step opens the input */
    view_draw *draw; /* NULL: the input could not be opened, or there is none */
    view_opened opened;
    view_frames *frames;
    double now;
    int wants_end;

    /* What is seen. */
    uint32_t width, height;
    float scale;
    cgt_camera camera;
    float axis[3], pivot[3];
    view_frame *shown;  /* NULL: none yet */
    int scene_is_wrong; /* the frame could not be set: there is nothing to draw */
    uint64_t wanted;    /* frame */
    int is_arriving;    /* nobody chose a frame: the first that has something is looked for */
    int playing;
    double rate, next_frame; /* frames a second; when the next one is due */
    double moved;            /* when something moved last */

    /* The user's hand. */
    view_drag drag;
    int dragged; /* the button moved since it was pressed */
    int is_new;  /* nobody has pressed anything yet */
    float x, y, pressed_x, pressed_y;

    /* The picture without what lies over it. */
    uint8_t *rgb;
    int outdated;         /* it is of another camera, frame or look */
    view_quality quality; /* of it */
    uint32_t shrink;
    int is_full;
    uint32_t grown;                  /* rays of the picture at rest so far, of each of the camera's hits */
    double cost[VIEW_LEVELS];        /* ms; 0: not known */
    double build_cost, compose_cost; /* ms of a frame beside drawing */
    double frame_ms, last_picture;
    double created;              /* seconds */
    uint64_t drawn;              /* pictures, each step of one at rest included; what lies over them apart */
    double waited, longest_wait; /* from an event to its picture: ms of all and of the longest */
    uint64_t waits;

    /* What lies over it. */
    text_font *font;
    uint8_t *over; /* the picture with it */
    int changed;   /* to be composed anew */
    int is_opening;
    int help, list, list_at;
    char list_names[VIEW_LIST_MOST][64];
    uint32_t list_count;
    view_pick pick[VIEW_PICKS];
    uint32_t picks;
    int has_bond; /* the two are the ends of one */
    view_filter filter;
    view_movie movie;
    char *clipboard; /* NULL: nothing new */
    view_change change[VIEW_CHANGES];
    uint32_t change_count;
    uint64_t event; /* the number of the one at hand */
    int panel;      /* view_panel_state */

    stop_flag stop; /* ends the picture at hand */
    stop_flag closing;
    pthread_mutex_t lock; /* of all below */
    view_event *events;
    size_t event_count, event_room;
    double sent;  /* when the first of the events came, that no picture shows; 0: none */
    int is_woken; /* frames have arrived, or messages */
    view_message message[VIEW_MESSAGES];
    uint32_t messages;
    char progress[128]; /* of what takes long; "": nothing does */
    int is_leaving;     /* the window was closed while files were opened */
    view_option option[OPTIONS_MOST];
    char *columns;
    char *formula;   /* of the selection, where it was made from what was picked; NULL: nothing new */
    char *selection; /* how many spheres the formula selects, or what is wrong with it; NULL: there is none */
    uint64_t options_version;
    view_request request;
    uint32_t asked[2];            /* the size that is */
    pthread_mutex_t picture_lock; /* of all below */
    uint32_t *pixels;
    uint32_t pixels_width, pixels_height;
    uint32_t dirty[VIEW_RECTS][2]; /* of each band of rows: the columns that differ, [from, to) */
    uint64_t picture_number;
    char title[256];
};

/* viewer_set.c: all controls of looks go this way. Makes these lines all values of an option, and what is seen follows;
 * or nothing changes and a sentence tells why. Returns 0, -1, or 1 where it may be tried again. */
typedef enum view_put {
    VIEW_PUT_NEW,
    VIEW_PUT_ON, /* goes on with the last change, as a slider does */
    VIEW_PUT_BACK
} view_put;
int viewer_put(viewer *v, const char *name, const char *lines, view_put how, char *why, size_t size);
void viewer_take_put(viewer *v, const view_event *event);
void viewer_undo(viewer *v);
void viewer_remember(viewer *v, view_change next, int continues); /* takes next.before over */

/* The same of one value, which is added where the option repeats, and of none; the sentence is printed. */
int viewer_set(viewer *v, const char *name, const char *value);
int viewer_unset(viewer *v, const char *name);
int viewer_set_lines(viewer *v, const char *name, const char *lines); /* all values */

int viewer_show_frame(viewer *v, view_frame *frame); /* makes it the one that is drawn; the same results */
void viewer_publish(viewer *v);                      /* other threads see the options as they are now */
void viewer_free_options(viewer *v);

/* viewer_events.c: changes the state. */
void viewer_handle(viewer *v, const view_event *event);
void viewer_move_to(viewer *v, uint64_t frame);

/* viewer_picture.c: a picture of the state, as good as time allows: draws one at most. Returns as viewer_step. */
double viewer_picture_step(viewer *v);
int viewer_picture_resize(viewer *v, uint32_t width, uint32_t height, float scale);
void viewer_compose(viewer *v); /* what lies over it, and what differs */
int viewer_is_moving(const viewer *v);
uint32_t viewer_band(uint32_t height); /* rows of a band */

/* viewer_panels.c: draws what lies over the picture, which is in v->over. */
void viewer_draw_panels(viewer *v);
int viewer_bar_at(const viewer *v, float x, float y, double *share); /* whether that is on the bar; where along it */
int viewer_button_at(const viewer *v, float x, float y);             /* whether that is on the button of the panel */
int viewer_list_row(const viewer *v, float x, float y);              /* of the list; -1: none */

/* viewer_select.c */
void viewer_click(viewer *v, float x, float y);
void viewer_follow_picks(viewer *v); /* after a new frame */
uint32_t viewer_pick_lines(const viewer *v, char lines[][128], uint32_t most);
void viewer_open_list(viewer *v);
void viewer_take_list(viewer *v, int row);
void viewer_hide(viewer *v, int kind, int only);
void viewer_show_all(viewer *v);
void viewer_select_picks(viewer *v); /* the formula becomes that of what was picked */

/* viewer_filter.c: a formula's spheres; "": none. what: hide, show, fade, label or follow. */
void viewer_select(viewer *v, const char *formula);
void viewer_use_selection(viewer *v, const char *what);
void viewer_follow_selection(viewer *v); /* after a new frame */
void viewer_free_selection(viewer *v);

/* viewer_open.c: what fails leaves all as it is, with the message printed. Paths are lines. Returns 0, -1, or 1 where
 * the user ended it. */
void viewer_open_first(viewer *v); /* what the command line names */
int viewer_open(viewer *v, const char *paths);
void viewer_read_anew(viewer *v);
int viewer_read_by(viewer *v, const char *name, const char *values); /* other values of an option */
void viewer_load_settings(viewer *v, const char *path);
int viewer_unload_settings(viewer *v, const view_change *change);
void viewer_save_settings(viewer *v);
void viewer_forget_settings(viewer *v); /* of a command line without a file */
void viewer_free_opened(view_opened *opened);

/* viewer_movie.c: of all frames, and with an orbit of so many degrees; or ends the one that is being made. */
void viewer_start_movie(viewer *v, float orbit);
void viewer_stop_movie(viewer *v);
double viewer_watch_movie(viewer *v, int waits); /* returns in how many seconds to look again */

/* viewer_out.c */
void viewer_write_picture(viewer *v);
void viewer_add_key(viewer *v);
void viewer_copy_camera(viewer *v);
void viewer_copy_command(viewer *v);
void viewer_copy_python(viewer *v);

/* viewer.c */
void viewer_on_frames(void *user); /* frames have arrived; any thread */
void viewer_say(viewer *v, const char *format, ...) __attribute__((format(printf, 2, 3)));

static inline uint64_t viewer_number(const viewer *v, uint64_t chosen)
{
    return v->options.render.range.first + chosen * v->options.render.range.every;
}

#endif

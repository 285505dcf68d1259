/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which process renders which frames. Frames are numbered here among those that were chosen: 0, 1, 2, ... A process
 * alone renders all of them. Under mpirun the process of rank 0 hands them out, a few at a time, to whoever is free;
 * gathers what became of them; and receives the pictures that must come in order, as a movie's must. What others have
 * to say is told by rank 0, once. All functions return 0, or -1 with the message printed, unless they say otherwise. */
#ifndef RENDER_SHARE_H
#define RENDER_SHARE_H

#include <pthread.h>
#include <stdint.h>

#include "common/stop_flag.h"
#include "playback/frame_source.h"
#include "render/share/mpi_module.h"
#include "render/render_report.h"

/* A frame whose pictures are written. */
typedef struct share_done {
    uint64_t chosen;
    frame_record record;
    int counted; /* the rest is set */
    render_counts counts;
    cgt_scene_statistics scene;
} share_done;

/* A few consecutive frames of one process. */
typedef struct share_grant {
    uint64_t begin, end;
    uint32_t rank;
    uint32_t done; /* bit i: frame begin + i */
} share_grant;

typedef struct render_share {
    process_link link;                                  /* rank 0 of size 1 without MPI */
    stop_flag *stop;                                    /* not 0: a signal has come */
    int (*on_done)(void *user, const share_done *done); /* on rank 0, for each frame, one at a time; not 0: failed */
    void *user;
    int first_pid; /* of rank 0 where it runs on this machine; else 0 */

    pthread_mutex_t lock; /* of all below */
    pthread_cond_t changed;
    pthread_t server;
    int has_server;
    int ready; /* next and end are set */
    uint64_t next, end;
    uint64_t own, own_end; /* handed out to this process */
    share_grant *grants;   /* in the order of their frames; rank 0 of several processes alone */
    size_t grant_count, grant_capacity;
    uint64_t done;
    int failed;
    int left;  /* other processes that have no more to do */
    int wrong; /* one of them ends with an error */
} render_share;

/* Joins the job where mpirun started this program. stop, on_done and user are set, the rest is zero. */
int share_join(render_share *share);

/* Whether this process gathers the run: it is rank 0. */
static inline int share_is_first(const render_share *share) { return share->link.rank == 0; }

/* All processes tell whether they got so far (wrong: 0 or not), and their part of the survey, which becomes the whole
 * one. NULL: none. Returns 0, or -1 where one of them did not. */
int share_agree(render_share *share, int wrong, survey *found);

/* Sets the frames to be rendered, [begin, end); end: UINT64_MAX where the input's length is unknown. */
int share_begin(render_share *share, uint64_t begin, uint64_t end);

/* The next frame of this process: 1, or 0 where there is none. Frames rise. */
int share_next(render_share *share, uint64_t *chosen);

/* The input has no frame `chosen`. */
void share_end_at(render_share *share, uint64_t chosen);

/* A frame is done. */
void share_finish_frame(render_share *share, const share_done *done);

/* Something went wrong in this process; its message is printed. No more frames are handed out. */
void share_fail(render_share *share);
int share_has_failed(render_share *share);

/* Frames that are done, of all processes. */
uint64_t share_count_done(render_share *share);

/* Waits until it is known who renders a frame. Returns 1 with the rank, or 0: nobody will. Rank 0 alone. */
int share_find_owner(render_share *share, uint64_t chosen, int *rank);

/* Sends a picture to rank 0; receives the next one of a rank. Pictures of one process come in the order of their
 * frames. Return 0, or -1 without a message: the run has failed or was interrupted. */
int share_send_picture(render_share *share, const uint8_t *rgb, size_t bytes);
int share_receive_picture(render_share *share, uint64_t chosen, int rank, uint8_t *rgb, size_t bytes);

/* After a failure: takes pictures that others still send and drops them, until all have left. */
void share_drop_pictures(render_share *share, uint8_t *rgb, size_t bytes);

/* Waits for all processes. Returns 0, or -1 where one of them, or this one (result), failed. */
int share_leave(render_share *share, int result, void (*on_wait)(void *user));

/* After an interrupt of several processes: rank 0 tells which frames of the range are missing, by their numbers in the
 * file; rank 1 tells where rank 0 itself has died. */
void share_tell_missing(render_share *share, const frame_range *range);

/* Where the launcher ends the job, waits to be ended, for ten seconds at most; else returns at once. Open MPI's second
 * between its signals is a sleep that the first process to leave cuts short: others would be killed before they have
 * told what is missing, and removed files that are not whole. So this is a process's last step. */
void share_await_end(void);

/* Frees the memory. */
void share_close(render_share *share);

#endif

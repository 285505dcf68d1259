/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The frames of a run one after the other, as they come from a file or a program: molecules put together, speeds,
 * trails, and formulas that are bound to each. */
#ifndef FRAME_SEQUENCE_H
#define FRAME_SEQUENCE_H

#include <stddef.h>
#include <stdint.h>

#include "color/categories.h"
#include "data/expression/expression.h"
#include "data/particles.h"
#include "notices.h"
#include "sequence/frame_atoms.h"
#include "sequence/trail_history.h"
#include "data/frame_access.h"
#include "sequence/unwrap.h"
#include "sequence/speed.h"
#include <cgt/trajectory.h>

enum { SEQUENCE_FORMULAS = 13 };

/* All zero at first: frames are taken as they are. */
typedef struct frame_sequence {
    frame_atoms atoms;          /* of each frame; what it asks for is the caller's */
    unwrapping *unwrap;         /* of each frame; NULL: places are those of the data */
    speed_tracker *tracker;     /* NULL: no speeds; the caller's to set, and freed here */
    trail_history *trails;      /* places in the frames before; NULL: none; as the tracker */
    cgt_trajectory_frame frame; /* the one that was taken last */
    const float *speed;         /* per sphere or vertex, NaN where unknown; NULL without speeds */
    speed_source speed_from;
    expression *formulas[SEQUENCE_FORMULAS]; /* bound to each frame; the caller's */
    uint32_t formula_count;
    int is_endless, is_followed; /* a molecule without end, spheres that are followed: it was told */
    int wants_kinds;             /* a survey tells which types and elements are shown; the caller's */
    categories *categories;      /* a survey tells of the first formula's; NULL: it does not; the caller's */
    const particle_rules *rules; /* of what is drawn, for a survey; NULL: all as it is; the caller's */
} frame_sequence;

/* Adds a formula to those that are bound to each frame. NULL is ignored. Returns 0, or -1 with a text. */
int cgt_frame_sequence_bind(frame_sequence *s, expression *formula, char *error, size_t error_size);

/* Puts the molecules of all frames together that come from now on. UNWRAP_NOT is ignored. Returns 0, or -1 with a
 * text. */
int cgt_frame_sequence_unwrap(frame_sequence *s, unwrap_mode mode, char *error, size_t error_size);

/* The columns that frames must have, of those the data have: copies at most `most` names, and returns how many. */
size_t cgt_frame_sequence_columns(const frame_sequence *s, const char **names, size_t most);

/* Makes the frame's spheres atoms, and puts its molecules together: it may be that of the sequence, or the second one,
 * for a look ahead. What is doubtful is told once. Returns 0, or -1 with a text. */
int cgt_frame_sequence_place(frame_sequence *s, cgt_trajectory_frame *frame, notices *told, char *error,
                             size_t error_size);

/* Binds the formulas to s->frame and s->speed. Returns 0, or -1 with a text. */
int cgt_frame_sequence_bind_all(const frame_sequence *s, char *error, size_t error_size);

/* Takes s->frame, which follows the one before: trails, speeds, formulas. Returns 0, or -1 with a text. */
int cgt_frame_sequence_take(frame_sequence *s, char *error, size_t error_size);

/* Whether the first frame, which was taken last, asks for the second; finds its speeds from that: 0, or -1 with a
 * text. Then both are taken again. */
int cgt_frame_sequence_looks_ahead(const frame_sequence *s);
int cgt_frame_sequence_look_ahead(frame_sequence *s, const cgt_trajectory_frame *second, char *error,
                                  size_t error_size);

/* How many frames before one must be taken to know all about it. */
uint64_t cgt_frame_sequence_lead(const frame_sequence *s);

/* A frame is left out; the next one is the first again. */
void cgt_frame_sequence_skip(frame_sequence *s);
void cgt_frame_sequence_restart(frame_sequence *s);

/* Frees all but the formulas; it is all zero then. */
void cgt_frame_sequence_close(frame_sequence *s);

#endif

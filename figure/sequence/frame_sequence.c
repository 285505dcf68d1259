/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames one after the other; see frame_sequence.h. */
#include "sequence/frame_sequence.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

int cgt_frame_sequence_bind(frame_sequence *s, expression *formula, char *error, size_t error_size)
{
    if (!formula)
        return 0;
    if (s->formula_count == SEQUENCE_FORMULAS) {
        snprintf(error, error_size, "more than %d formulas", SEQUENCE_FORMULAS);
        return -1;
    }
    s->formulas[s->formula_count++] = formula;
    return 0;
}

int cgt_frame_sequence_unwrap(frame_sequence *s, unwrap_mode mode, char *error, size_t error_size)
{
    if (mode == UNWRAP_NOT)
        return 0;
    s->unwrap = cgt_unwrap_create(mode);
    if (s->unwrap)
        return 0;
    snprintf(error, error_size, "out of memory");
    return -1;
}

size_t cgt_frame_sequence_columns(const frame_sequence *s, const char **names, size_t most)
{
    size_t count = 0, own;
    const char *const *name = cgt_unwrap_columns(&own);
    for (size_t k = 0; k < own && s->unwrap && count < most; k++)
        names[count++] = name[k];
    for (uint32_t i = 0; i < s->formula_count; i++) {
        name = cgt_expression_names(s->formulas[i], &own);
        for (size_t k = 0; k < own && count < most; k++)
            names[count++] = name[k];
    }
    return count;
}

int cgt_frame_sequence_place(frame_sequence *s, cgt_trajectory_frame *frame, notices *told, char *error,
                             size_t error_size)
{
    int endless = 0;
    if (cgt_frame_atoms_complete(&s->atoms, frame, error, error_size))
        return -1;
    if (!s->unwrap)
        return 0;
    const int failed = cgt_unwrap_frame(s->unwrap, frame, &endless, error, error_size);
    if (endless && !s->is_endless)
        cgt_notices_add(told, "frame %" PRIu64 " has a molecule that is bonded to its own image: it stays as it is",
                        frame->number);
    s->is_endless |= endless;
    const int follows = !failed && cgt_unwrap_follows(s->unwrap);
    if (follows && !s->is_followed)
        cgt_notices_add(told, "--unwrap: no image flags: spheres are followed from frame to frame through the "
                              "boundaries");
    s->is_followed |= follows;
    return failed;
}

int cgt_frame_sequence_bind_all(const frame_sequence *s, char *error, size_t error_size)
{
    for (uint32_t i = 0; i < s->formula_count; i++)
        if (cgt_expression_bind(s->formulas[i], &s->frame, s->speed, error, error_size))
            return -1;
    return 0;
}

int cgt_frame_sequence_take(frame_sequence *s, char *error, size_t error_size)
{
    const unsigned long long number = s->frame.number;
    s->speed = NULL;
    if (s->trails && s->frame.kind == CGT_TRAJECTORY_SPHERES && cgt_trail_history_add(s->trails, &s->frame)) {
        snprintf(error, error_size, "out of memory for the trails of frame %llu", number);
        return -1;
    }
    if (s->tracker && cgt_speed_next(s->tracker, &s->frame, &s->speed, &s->speed_from)) {
        snprintf(error, error_size, "out of memory for the speeds of frame %llu", number);
        return -1;
    }
    return cgt_frame_sequence_bind_all(s, error, error_size);
}

int cgt_frame_sequence_looks_ahead(const frame_sequence *s) { return s->tracker && !s->frame.velocity; }

int cgt_frame_sequence_look_ahead(frame_sequence *s, const cgt_trajectory_frame *second, char *error, size_t error_size)
{
    if (!cgt_speed_look_ahead(s->tracker, second))
        return 0;
    snprintf(error, error_size, "out of memory for the speeds of frame 0");
    return -1;
}

uint64_t cgt_frame_sequence_lead(const frame_sequence *s)
{
    const uint64_t speeds = s->tracker != NULL, trails = s->trails ? cgt_trail_history_length(s->trails) : 0;
    if (s->unwrap && cgt_unwrap_needs_all(s->unwrap))
        return UINT64_MAX;
    return speeds > trails ? speeds : trails;
}

void cgt_frame_sequence_skip(frame_sequence *s)
{
    if (s->trails)
        cgt_trail_history_restart(s->trails); /* its frames follow each other */
}

void cgt_frame_sequence_restart(frame_sequence *s)
{
    if (s->tracker)
        cgt_speed_restart(s->tracker);
    if (s->unwrap)
        cgt_unwrap_restart(s->unwrap);
    cgt_frame_sequence_skip(s);
}

void cgt_frame_sequence_close(frame_sequence *s)
{
    cgt_frame_atoms_free(&s->atoms);
    cgt_unwrap_release(s->unwrap);
    cgt_speed_release(s->tracker);
    cgt_trail_history_release(s->trails);
    memset(s, 0, sizeof *s);
}

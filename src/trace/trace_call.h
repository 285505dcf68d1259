/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the tracing calls share: options to settings, and the counting over threads. */
#ifndef CGT_TRACE_CALL_H
#define CGT_TRACE_CALL_H

#include "dispatch/kernel.h"
#include "scene/scene.h"

typedef struct cgt_trace_counter {
    _Atomic uint64_t sum[CGT_COUNTS]; /* cgt_counts */
    double start_ms;
} cgt_trace_counter;

/* Checks that the scene may be traced and makes the choices that the options leave open. */
cgt_result cgt_trace_prepare(const cgt_scene *scene, const cgt_trace_options *options, bool camera,
                             cgt_trace_settings *settings, cgt_trace_counter *counter);

/* Whether so many elements of a caller's array, `what`, can be told apart by addresses and be shared out to tasks. */
cgt_result cgt_check_stride(cgt_context *c, const char *what, size_t stride, uint64_t count);

/* Whether a frame's size, stride and planes are ones. */
cgt_result cgt_check_frame(cgt_context *c, const cgt_frame *f);

/* Adds the counts of one task; counter may be NULL. */
void cgt_trace_counter_add(cgt_trace_counter *counter, const cgt_counts *counts);

/* Fills in the caller's statistics, where asked for. */
void cgt_trace_store_statistics(const cgt_trace_options *options, const cgt_trace_settings *settings,
                                cgt_trace_counter *counter);

#endif

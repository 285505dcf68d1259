/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The record of DMA. */
#include <stdlib.h>

#include "cell/mfc/mfc_internal.h"

void cgt_mfc_trace_init(cgt_mfc_trace *trace) { *trace = (cgt_mfc_trace){0}; }

void cgt_mfc_trace_free(cgt_mfc_trace *trace)
{
    free(trace->record);
    cgt_mfc_trace_init(trace);
}

static bool make_room(cgt_mfc_trace *trace)
{
    if (trace->count < trace->capacity)
        return true;
    const size_t capacity = trace->capacity ? 2 * trace->capacity : 256;
    if (capacity > SIZE_MAX / sizeof trace->record[0])
        return false;
    cgt_mfc_record *const grown = realloc(trace->record, capacity * sizeof trace->record[0]);
    if (!grown)
        return false;
    trace->record = grown;
    trace->capacity = capacity;
    return true;
}

void cgt_mfc_trace_add(cgt_mfc *mfc, const cgt_mfc_record *record)
{
    cgt_mfc_trace *const trace = mfc->trace;
    if (!trace)
        return;
    if (make_room(trace))
        trace->record[trace->count++] = *record;
    else
        trace->lost++;
}

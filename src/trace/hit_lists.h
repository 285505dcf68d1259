/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Lists of hits (query/hit_list.h) of the rays of a call, through whatever the scene has. */
#ifndef CGT_HIT_LISTS_H
#define CGT_HIT_LISTS_H

#include "query/hit_list.h"
#include "trace/bands/band_trace.h"
#include "trace/trace_call.h"

/* Fails with a message in a scene with capsules, whose crossings are not decided. */
cgt_result cgt_check_crossings(const cgt_scene *scene);

/* Makes ready what so many rays go through. Fails with a message. */
cgt_result cgt_ready_lists(const cgt_scene *scene, uint64_t rays, cgt_trace_settings *settings, cgt_band_call *bands);

/* Whether these go through a BVH: any band's counts. */
bool cgt_lists_use_bvh(const cgt_scene *scene, const cgt_trace_settings *settings, const cgt_band_call *bands);

/* Lists the first hits of each list's ray, which is valid and not off. Lists are empty. */
void cgt_list_rays(const cgt_scene *scene, const cgt_trace_settings *settings, const cgt_band_call *bands,
                   cgt_hit_list *lists, uint32_t count, cgt_counts *counts);

#endif

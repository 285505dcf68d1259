/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Statistics and messages of a commit. Builders set what is theirs alone themselves. */
#ifndef CGT_REPORT_H
#define CGT_REPORT_H

#include "scene/scene.h"

/* Sets the statistics that follow from the primitives' bounds, and the bytes. */
void cgt_report_scene(cgt_scene *scene, const cgt_primitive_bounds *bounds);

/* Sets the statistics of local stores: the structure's bytes and those of the primitives that it refers to, against
 * 256 KB of which 64 KB are for code and stack. */
void cgt_report_local_store(cgt_scene *scene, size_t sphere_bytes, size_t triangle_bytes);

/* Tells the log, once a commit has ended, what was skipped and what was built. */
void cgt_log_commit(const cgt_scene *scene);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bands of a scene (scene/bands.h): filled and committed. */
#ifndef CGT_BANDS_COMMIT_H
#define CGT_BANDS_COMMIT_H

#include "scene/bands.h"

/* Cuts the valid primitives of scene->committed_scene, of which there is at least one, into bands, commits these, and
 * sets scene->in_bands and the statistics of structures. Indices are in range. Fails with a message. */
cgt_result cgt_bands_commit(cgt_scene *scene);

#endif

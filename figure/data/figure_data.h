/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames made of a caller's columns. */
#ifndef FIGURE_DATA_H
#define FIGURE_DATA_H

#include <cgt/figure.h>
#include <cgt/trajectory.h>

enum { FIGURE_DATA_BLOCKS = 4 * CGT_TRAJECTORY_MOST_COLUMNS + 8 }; /* four for vectors, at most three for others */

/* All zero at first. */
typedef struct figure_data {
    cgt_trajectory_frame frame; /* its arrays are the blocks, and the caller's bonds */
    cgt_trajectory_column *column;
    const float *radius; /* the column of that name; NULL: none */
    void *block[FIGURE_DATA_BLOCKS];
    uint32_t blocks;
} figure_data;

/* Makes the frame; frees the one before. Returns 0, or -1 with a sentence. */
int cgt_figure_data_take(figure_data *d, const cgt_figure_data *data, char *error, size_t error_size);

void cgt_figure_data_free(figure_data *d);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A wavy sheet, rolled up, and what makes it hard for clusters. */
#include "structures/scenes/rolled_sheet.h"

#include <math.h>
#include <string.h>

#include "model/triangle_cluster.h"

#define COLUMNS 64u /* squares per row */

static void point_at(uint32_t column, uint32_t row, uint32_t rows, double phase, float p[3])
{
    const double s = (double)row / rows, t = (double)column / COLUMNS;
    const double angle = 9 * s * (0.2 + 0.8 * s) + phase, radius = 0.35 + 0.07 * angle + 0.03 * sin(20 * t + phase);
    p[0] = (float)(radius * cos(angle));
    p[1] = (float)(radius * sin(angle));
    p[2] = (float)(2 * t * (0.1 + 0.9 * t) - 1 + 0.05 * sin(7 * angle - phase));
}

void rolled_sheet(float (*sheet)[3][3], uint32_t count, double phase)
{
    static const uint32_t corner[2][3][2] = {{{0, 0}, {1, 0}, {0, 1}}, {{1, 1}, {0, 1}, {1, 0}}};
    const uint32_t rows = (count + 2 * COLUMNS - 1) / (2 * COLUMNS);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < 3; k++)
            point_at(i / 2 % COLUMNS + corner[i % 2][k][0], i / 2 / COLUMNS + corner[i % 2][k][1], rows, phase,
                     sheet[i][k]);
}

void rolled_sheet_spoil(float (*sheet)[3][3], uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t c = i / CGT_CLUSTER;
        float(*const v)[3] = sheet[i];
        if (c % 41 == 5 || i % 11 == 7)
            memcpy(v[2], v[1], sizeof v[2]);
        if (c % 82 == 46 || (c % 37 == 3 && i % 2))
            v[i % 3][i / 3 % 3] = i % 5 ? NAN : -INFINITY;
        if (c % 53 == 4 && i % 3 == 0)
            for (int a = 0; a < 3; a++)
                v[0][a] = v[1][a] = v[2][a] = i % 2 ? 1.5f : -1.5f;
    }
}

void rolled_sheet_loosen(float (*sheet)[3][3], uint32_t count)
{
    enum { CLUSTERS = 8, BLOCK = CLUSTERS * CGT_CLUSTER };
    for (uint32_t first = 0; first + BLOCK <= count; first += BLOCK) {
        float block[BLOCK][3][3];
        memcpy(block, sheet[first], sizeof block);
        for (uint32_t k = 0; k < BLOCK; k++)
            memcpy(sheet[first + k], block[k % CGT_CLUSTER * CLUSTERS + k / CGT_CLUSTER], sizeof block[0]);
    }
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Meshes whose neighbours follow one another, large enough for clusters. */
#include <string.h>

#include "driver/scenes/scene_heap.h"
#include "structures/scenes/rolled_sheet.h"

#define LEAST 8192u /* fewest triangles that get clusters */
#define MOST 9200u

enum { EVEN, SPOILT, LOOSE, FAMILIES };

static const char *family_name(uint32_t family)
{
    static const char *const name[FAMILIES] = {"a rolled sheet", "a spoilt sheet", "a sheet of loose clusters"};
    return name[family];
}

static void make(scene_heap *h, uint32_t family)
{
    static float sheet[MOST][3][3];
    const uint32_t count = LEAST + random_below(h->r, MOST - LEAST);
    rolled_sheet(sheet, count, 0.1 * random_below(h->r, 10));
    if (family == LOOSE)
        rolled_sheet_loosen(sheet, count);
    if (family != EVEN)
        rolled_sheet_spoil(sheet, count);
    for (uint32_t i = 0; i < count; i++)
        memcpy(scene_heap_add(h, ORACLE_TRIANGLE), sheet[i], sizeof sheet[i]);
}

const scene_group sheet_scenes = {FAMILIES, family_name, make};

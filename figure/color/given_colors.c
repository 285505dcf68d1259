/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Colours that the data have; see given_colors.h. They are told apart by the codes of 8 bits that screens have; low
 * bits are dropped until there are as few as the palette holds, which eight to the power of three always are. */
#include "color/given_colors.h"

#include <string.h>

#include "data/frame_access.h"

enum { SLOTS = 4 * COLORING_STEPS };

static int find_columns(const cgt_trajectory_frame *frame, const float *part[3])
{
    static const char *const names[] = RGB_COLUMNS;
    for (int c = 0; c < 3; c++) {
        const cgt_trajectory_column *const column = frame_column(frame, names[c]);
        part[c] = column ? column->value : NULL;
    }
    return part[0] && part[1] && part[2];
}

int cgt_coloring_has_given(const cgt_trajectory_frame *frame)
{
    const float *part[3];
    return frame->kind == CGT_TRAJECTORY_SPHERES && find_columns(frame, part);
}

/* The codes of a colour, without their low bits. */
static uint32_t key_of(const float *const part[3], size_t i, uint32_t dropped)
{
    uint32_t key = 0;
    for (int c = 0; c < 3; c++) {
        const float share = part[c][i] > 0.0f ? fminf(part[c][i], 1.0f) : 0.0f; /* NaN is black */
        key = key << 8 | (uint32_t)cgt_srgb_encode(share) >> dropped;
    }
    return key;
}

/* A colour of a key; black and white stay what they are. */
static void set_entry(float entry[3], uint32_t key, uint32_t dropped)
{
    for (int c = 0; c < 3; c++)
        entry[c] = cgt_srgb_decode((uint8_t)((key >> (16 - 8 * c) & 255u) * 255u / (255u >> dropped)));
}

/* Returns 0, or -1: there are more keys than entries. */
static int index_colors(coloring *c, const float *const part[3], uint32_t count, uint32_t dropped)
{
    uint32_t keys[COLORING_STEPS], entries = 0;
    uint16_t slots[SLOTS]; /* by a hash: the entry of a key, from 1 on */
    memset(slots, 0, sizeof slots);
    for (size_t i = 0; i < count; i++) {
        const uint32_t key = key_of(part, i, dropped);
        uint32_t slot = key * 2654435769u >> 20;
        while (slots[slot] && keys[slots[slot] - 1] != key)
            slot = (slot + 1) % SLOTS;
        if (!slots[slot]) {
            if (entries == COLORING_STEPS)
                return -1;
            set_entry(c->palette[entries], key, dropped);
            keys[entries++] = key;
            slots[slot] = (uint16_t)entries;
        }
        c->index[i] = (uint16_t)(slots[slot] - 1);
    }
    return 0;
}

void cgt_coloring_give(coloring *c, const cgt_trajectory_frame *frame)
{
    const float *part[3];
    if (!find_columns(frame, part))
        for (size_t i = 0; i < frame->count; i++)
            c->index[i] = COLORING_UNKNOWN;
    else
        for (uint32_t dropped = 0; index_colors(c, part, frame->count, dropped); dropped++) {
        }
}

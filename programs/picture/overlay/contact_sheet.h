/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A contact sheet: one picture with a grid of evenly spaced frames, each scaled down and marked with its number. The
 * scaling averages linear light over whole pixels. */
#ifndef CONTACT_SHEET_H
#define CONTACT_SHEET_H

#include <stddef.h>
#include <stdint.h>

typedef struct contact_sheet contact_sheet;

enum {
    CONTACT_SHEET_THUMB = 320,   /* pixels, the longer edge of a scaled frame; smaller frames keep their size */
    CONTACT_SHEET_GAP = 8,       /* pixels around each */
    CONTACT_SHEET_MAX_EDGE = 100 /* columns, rows */
};

/* Makes an empty sheet for a run of `frames` frames of width x height pixels. The first and the last frame are on it;
 * where there are fewer frames than columns * rows, cells and rows are left out. Returns NULL on a value of 0, more
 * than CONTACT_SHEET_MAX_EDGE columns or rows, or a lack of memory. */
contact_sheet *contact_sheet_create(uint32_t columns, uint32_t rows, uint64_t frames, uint32_t width, uint32_t height);

void contact_sheet_release(contact_sheet *sheet);

/* Returns 1 where frame k, counted from 0, is on the sheet. */
int contact_sheet_wants(const contact_sheet *sheet, uint64_t k);

/* Puts frame k on the sheet, if it has a cell there, with number in its corner.
 *   rgb     3 * width * height bytes, sRGB
 *   alpha   a byte a pixel, how much rgb covers of the background; NULL: all */
void contact_sheet_add(contact_sheet *sheet, uint64_t k, uint64_t number, const uint8_t *rgb, const uint8_t *alpha,
                       const uint8_t background[3]);

/* Returns the sheet's pixels, 3 * *width * *height bytes, valid until its release. */
const uint8_t *contact_sheet_pixels(const contact_sheet *sheet, uint32_t *width, uint32_t *height);

#endif

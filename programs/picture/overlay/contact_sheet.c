/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A contact sheet; see contact_sheet.h. */
#include "picture/overlay/contact_sheet.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/picture.h>

enum { PAPER = 40 }; /* the sheet's own grey, sRGB */

struct contact_sheet {
    uint32_t columns, cells;
    uint64_t frames;
    uint32_t frame_width, frame_height; /* of the source frames, in pixels */
    uint32_t thumb_width, thumb_height; /* of the scaled frames */
    uint32_t width, height;             /* pixels of the sheet */
    uint8_t *rgb;
};

/* Edge of a scaled frame, in proportion, so that the longer edge becomes CONTACT_SHEET_THUMB. */
static uint32_t thumb_edge(uint32_t edge, uint32_t longer)
{
    if (longer <= CONTACT_SHEET_THUMB)
        return edge;
    const uint64_t scaled = ((uint64_t)edge * CONTACT_SHEET_THUMB + longer / 2) / longer;
    return scaled ? (uint32_t)scaled : 1;
}

contact_sheet *contact_sheet_create(uint32_t columns, uint32_t rows, uint64_t frames, uint32_t width, uint32_t height)
{
    if (!columns || !rows || !frames || !width || !height || columns > CONTACT_SHEET_MAX_EDGE ||
        rows > CONTACT_SHEET_MAX_EDGE)
        return NULL;
    contact_sheet *sheet = calloc(1, sizeof *sheet);
    if (!sheet)
        return NULL;
    sheet->frames = frames;
    sheet->cells = frames < columns * rows ? (uint32_t)frames : columns * rows;
    sheet->columns = sheet->cells < columns ? sheet->cells : columns;
    rows = (sheet->cells + sheet->columns - 1) / sheet->columns;
    sheet->frame_width = width;
    sheet->frame_height = height;
    sheet->thumb_width = thumb_edge(width, width > height ? width : height);
    sheet->thumb_height = thumb_edge(height, width > height ? width : height);
    /* At most 100 * 328 + 8 pixels an edge: no product below can overflow. */
    sheet->width = sheet->columns * (sheet->thumb_width + CONTACT_SHEET_GAP) + CONTACT_SHEET_GAP;
    sheet->height = rows * (sheet->thumb_height + CONTACT_SHEET_GAP) + CONTACT_SHEET_GAP;
    const size_t bytes = (size_t)sheet->width * sheet->height * 3;
    sheet->rgb = malloc(bytes);
    if (!sheet->rgb) {
        free(sheet);
        return NULL;
    }
    memset(sheet->rgb, PAPER, bytes);
    return sheet;
}

void contact_sheet_release(contact_sheet *sheet)
{
    if (!sheet)
        return;
    free(sheet->rgb);
    free(sheet);
}

/* The frame in a cell: the first and last cell get the first and last frame, the others are evenly spaced. */
static uint64_t frame_of_cell(const contact_sheet *sheet, uint32_t cell)
{
    if (sheet->cells == 1)
        return 0;
    const uint64_t gaps = sheet->cells - 1, whole = (sheet->frames - 1) / gaps, remainder = (sheet->frames - 1) % gaps;
    return cell * whole + cell * remainder / gaps; /* cell * (frames - 1) / gaps without overflow */
}

/* The cell of frame k, or cells where it has none. Frames of the cells rise strictly, because cells <= frames. */
static uint32_t cell_of_frame(const contact_sheet *sheet, uint64_t k)
{
    for (uint32_t cell = 0; cell < sheet->cells; cell++)
        if (frame_of_cell(sheet, cell) == k)
            return cell;
    return sheet->cells;
}

int contact_sheet_wants(const contact_sheet *sheet, uint64_t k) { return cell_of_frame(sheet, k) < sheet->cells; }

/* A frame that is put on the sheet. */
typedef struct sheet_frame {
    const uint8_t *rgb, *alpha; /* alpha NULL: opaque */
    double background[3];       /* linear */
} sheet_frame;

/* Averages the source pixels [x0, x1) x [y0, y1) in linear light. */
static void average(const contact_sheet *sheet, const sheet_frame *frame, uint32_t x0, uint32_t x1, uint32_t y0,
                    uint32_t y1, uint8_t out[3])
{
    double sum[3] = {0.0, 0.0, 0.0};
    for (uint32_t y = y0; y < y1; y++)
        for (uint32_t x = x0; x < x1; x++) {
            const size_t pixel = (size_t)y * sheet->frame_width + x;
            const double cover = frame->alpha ? frame->alpha[pixel] / 255.0 : 1.0;
            for (int c = 0; c < 3; c++)
                sum[c] +=
                    cover * (double)cgt_srgb_decode(frame->rgb[3 * pixel + c]) + (1.0 - cover) * frame->background[c];
        }
    const double share = 1.0 / ((double)(x1 - x0) * (double)(y1 - y0));
    for (int c = 0; c < 3; c++)
        out[c] = cgt_srgb_encode((float)(sum[c] * share));
}

/* Digits, three pixels wide and five high: one octal digit a row, its highest bit on the left. */
static const uint16_t digit_rows[10] = {075557, 026227, 071747, 071717, 055711, 074717, 074757, 071122, 075757, 075717};

static void fill(contact_sheet *sheet, uint32_t x0, uint32_t y0, uint32_t edge, uint8_t grey)
{
    for (uint32_t y = y0; y < y0 + edge && y < sheet->height; y++)
        for (uint32_t x = x0; x < x0 + edge && x < sheet->width; x++)
            memset(sheet->rgb + ((size_t)y * sheet->width + x) * 3, grey, 3);
}

/* Writes number at (left, top) if it fits into the cell, light with a dark outline, readable on any background. */
static void write_number(contact_sheet *sheet, uint32_t left, uint32_t top, uint64_t number)
{
    enum { SCALE = 2, ADVANCE = 4 * SCALE, HEIGHT = 7 * SCALE };
    char text[24];
    const uint32_t digits = (uint32_t)snprintf(text, sizeof text, "%" PRIu64, number);
    if (digits * ADVANCE + 2 * SCALE > sheet->thumb_width || HEIGHT > sheet->thumb_height)
        return;
    for (int light = 0; light < 2; light++)
        for (uint32_t i = 0; i < digits; i++)
            for (uint32_t bit = 0; bit < 15; bit++) {
                if (!(digit_rows[text[i] - '0'] >> (14 - bit) & 1))
                    continue;
                const uint32_t x = left + SCALE + i * ADVANCE + bit % 3 * SCALE, y = top + SCALE + bit / 3 * SCALE;
                if (light)
                    fill(sheet, x, y, SCALE, 235);
                else
                    fill(sheet, x - 1, y - 1, SCALE + 2, 0);
            }
}

void contact_sheet_add(contact_sheet *sheet, uint64_t k, uint64_t number, const uint8_t *rgb, const uint8_t *alpha,
                       const uint8_t background[3])
{
    const uint32_t cell = cell_of_frame(sheet, k);
    sheet_frame frame = {.rgb = rgb, .alpha = alpha};
    if (cell == sheet->cells)
        return;
    for (int c = 0; c < 3; c++)
        frame.background[c] = (double)cgt_srgb_decode(background[c]);
    const uint32_t left = CONTACT_SHEET_GAP + cell % sheet->columns * (sheet->thumb_width + CONTACT_SHEET_GAP);
    const uint32_t top = CONTACT_SHEET_GAP + cell / sheet->columns * (sheet->thumb_height + CONTACT_SHEET_GAP);
    for (uint32_t y = 0; y < sheet->thumb_height; y++) {
        const uint32_t y0 = (uint32_t)((uint64_t)y * sheet->frame_height / sheet->thumb_height);
        const uint32_t y1 = (uint32_t)((uint64_t)(y + 1) * sheet->frame_height / sheet->thumb_height);
        for (uint32_t x = 0; x < sheet->thumb_width; x++) {
            const uint32_t x0 = (uint32_t)((uint64_t)x * sheet->frame_width / sheet->thumb_width);
            const uint32_t x1 = (uint32_t)((uint64_t)(x + 1) * sheet->frame_width / sheet->thumb_width);
            average(sheet, &frame, x0, x1, y0, y1, sheet->rgb + ((size_t)(top + y) * sheet->width + left + x) * 3);
        }
    }
    write_number(sheet, left, top, number);
}

const uint8_t *contact_sheet_pixels(const contact_sheet *sheet, uint32_t *width, uint32_t *height)
{
    *width = sheet->width;
    *height = sheet->height;
    return sheet->rgb;
}

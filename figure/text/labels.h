/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Labels of things that are seen at some places of a picture: each is drawn where it overlaps neither another label nor
 * the picture's texts: at its place, or beside it. The nearest are placed first. */
#ifndef LABELS_H
#define LABELS_H

#include <stdint.h>

#include "text/overlay.h"

typedef struct text_label {
    float x, y;   /* in pixels */
    float radius; /* of what is labelled, in pixels */
    float depth;  /* from the eye */
    const char *text;
} text_label;

/* Draws labels, whose order changes, and returns how many have found no place. */
uint32_t cgt_labels_draw(const overlay *o, const canvas *c, text_label *labels, uint32_t count);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Text on pictures, by FreeType. In builds without it cgt_text_open fails with a sentence. What the font lacks is drawn
 * in other fonts, which fontconfig finds, in builds that have it. */
#ifndef TEXT_H
#define TEXT_H

#include <stddef.h>
#include <stdint.h>

#include "text/canvas.h"

typedef struct text_font text_font;

/* Where DejaVu Sans is; NULL: not where distributions put it. */
const char *cgt_text_find_file(void);

/* Opens a font file; path NULL: DejaVu Sans where distributions put it. pixels: size of the font, 1 to 1000. Returns
 * NULL with a sentence in error. A font is for one thread at a time. */
text_font *cgt_text_open(const char *path, float pixels, char *error, size_t error_size);
void cgt_text_close(text_font *font); /* NULL is ignored */

/* Changes the size of an open font; NULL is ignored. A font that lacks the size keeps the one before. */
void cgt_text_set_size(text_font *font, float pixels);

/* How many bytes of a text, in whole characters, are no wider than so many pixels. */
size_t cgt_text_fit(const text_font *font, const char *utf8, float width);

/* Width of a text in UTF-8, in pixels. What is no UTF-8 counts as one unknown character a byte. */
float cgt_text_width(const text_font *font, const char *utf8);

/* Appends the characters of a text that neither the font nor another installed one has to `missing`, each once, as far
 * as it has room, and returns the code of the first of them that was not there yet; 0: none. */
uint32_t cgt_text_find_missing(const text_font *font, const char *utf8, char *missing, size_t size);

/* Draws a text from x on, with its baseline at y; color is linear. */
void cgt_text_draw(const text_font *font, const canvas *c, float x, float y, const char *utf8, const float color[3]);

/* Draws the rim of a text, so many pixels around its letters, in place of them. rim 0: the text. */
void cgt_text_draw_rim(const text_font *font, const canvas *c, float x, float y, const char *utf8, uint32_t rim,
                       const float color[3]);

#endif

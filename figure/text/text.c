/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Text on pictures; see text.h. */
#include "text/text.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "options/numbers.h"

#ifdef CGT_HAVE_FREETYPE

#include <freetype/freetype.h>

struct text_font {
    FT_Library library;
    FT_Face face;
};

static FT_Error open_face(text_font *font, const char *path)
{
    static const char *const places[] = {
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
        "/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/share/fonts/dejavu/DejaVuSans.ttf",
        "/usr/local/share/fonts/dejavu/DejaVuSans.ttf"};
    if (path)
        return FT_New_Face(font->library, path, 0, &font->face);
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
        if (FT_New_Face(font->library, places[i], 0, &font->face) == 0)
            return 0;
    return 1;
}

text_font *cgt_text_open(const char *path, float pixels, char *error, size_t error_size)
{
    text_font *font = calloc(1, sizeof *font);
    if (!font || FT_Init_FreeType(&font->library)) {
        snprintf(error, error_size, "out of memory for a font");
        free(font);
        return NULL;
    }
    if (open_face(font, path)) {
        if (path)
            snprintf(error, error_size, "%s: this is no font that can be read", path);
        else
            snprintf(
                error, error_size,
                "text needs a font, and DejaVu Sans is not where distributions put it (package fonts-dejavu-core): "
                "give one by --font");
    } else if (FT_Set_Char_Size(font->face, (FT_F26Dot6)(64.0f * pixels), 0, 72, 72)) {
        snprintf(error, error_size, "%s: the font has no size of %s pixels", path ? path : "DejaVu Sans",
                 cgt_number(6, (double)pixels).text);
    } else {
        return font;
    }
    cgt_text_close(font);
    return NULL;
}

void cgt_text_close(text_font *font)
{
    if (!font)
        return;
    if (font->face)
        FT_Done_Face(font->face);
    FT_Done_FreeType(font->library);
    free(font);
}

/* The next character of UTF-8; *text moves behind it. Returns 0 at the end. */
static uint32_t next_character(const char **text)
{
    const unsigned char *t = (const unsigned char *)*text;
    const int more = t[0] >= 0xf0 ? 3 : t[0] >= 0xe0 ? 2 : t[0] >= 0xc0 ? 1 : 0;
    uint32_t code = more ? t[0] & (0x3fu >> more) : t[0];
    if (!t[0])
        return 0;
    for (int i = 1; i <= more; i++) {
        if ((t[i] & 0xc0) != 0x80) { /* cut off, or another encoding */
            *text += 1;
            return 0xfffd;
        }
        code = code << 6 | (t[i] & 0x3fu);
    }
    *text += 1 + more;
    return t[0] >= 0x80 && !more ? 0xfffd : code;
}

void cgt_text_set_size(text_font *font, float pixels)
{
    if (font)
        FT_Set_Char_Size(font->face, 0, (FT_F26Dot6)(64.0f * pixels), 72, 72);
}

static float advance_of(const text_font *font, uint32_t code)
{
    const FT_Face face = font->face;
    return FT_Load_Char(face, code, FT_LOAD_TARGET_LIGHT) == 0 ? (float)face->glyph->advance.x / 64.0f : 0.0f;
}

float cgt_text_width(const text_font *font, const char *utf8)
{
    float width = 0.0f;
    uint32_t code;
    while ((code = next_character(&utf8)) != 0)
        width += advance_of(font, code);
    return width;
}

size_t cgt_text_fit(const text_font *font, const char *utf8, float width)
{
    const char *const begin = utf8;
    uint32_t code;
    for (const char *at = utf8; (code = next_character(&utf8)) != 0; at = utf8) {
        width -= advance_of(font, code);
        if (width < 0.0f)
            return (size_t)(at - begin);
    }
    return (size_t)(utf8 - begin);
}

uint32_t cgt_text_find_missing(const text_font *font, const char *utf8, char *missing, size_t size)
{
    uint32_t code, first = 0;
    for (const char *at = utf8; (code = next_character(&utf8)) != 0; at = utf8) {
        char character[5] = "";
        const size_t length = strlen(missing);
        memcpy(character, at, (size_t)(utf8 - at));
        if (FT_Get_Char_Index(font->face, code) || strstr(missing, character))
            continue;
        first = first ? first : code;
        if (length + strlen(character) < size)
            memcpy(missing + length, character, strlen(character) + 1);
    }
    return first;
}

static void draw_bitmap(const canvas *c, FT_GlyphSlot glyph, int32_t x, int32_t y, const float color[3])
{
    const FT_Bitmap *b = &glyph->bitmap;
    if (b->pixel_mode != FT_PIXEL_MODE_GRAY)
        return; /* a font of bitmaps */
    /* In linear light dark strokes look thinner than light ones, and small texts pale. */
    const int is_dark = color[0] + color[1] + color[2] < 0.6f;
    for (uint32_t j = 0; j < b->rows; j++)
        for (uint32_t i = 0; i < b->width; i++) {
            const float share = (float)b->buffer[(ptrdiff_t)j * b->pitch + (ptrdiff_t)i] / 255.0f;
            cgt_canvas_blend(c, x + glyph->bitmap_left + (int32_t)i, y - glyph->bitmap_top + (int32_t)j, color,
                             is_dark ? sqrtf(share) : share);
        }
}

void cgt_text_draw(const text_font *font, const canvas *c, float x, float y, const char *utf8, const float color[3])
{
    uint32_t code;
    while ((code = next_character(&utf8)) != 0) {
        if (FT_Load_Char(font->face, code, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) != 0)
            continue;
        draw_bitmap(c, font->face->glyph, (int32_t)(x + 0.5f), (int32_t)(y + 0.5f), color);
        x += (float)font->face->glyph->advance.x / 64.0f;
    }
}

#else

text_font *cgt_text_open(const char *path, float pixels, char *error, size_t error_size)
{
    (void)path;
    (void)pixels;
    snprintf(error, error_size, "this program was built without FreeType, and cannot write text on pictures");
    return NULL;
}

void cgt_text_close(text_font *font) { (void)font; }

void cgt_text_set_size(text_font *font, float pixels)
{
    (void)font;
    (void)pixels;
}

float cgt_text_width(const text_font *font, const char *utf8)
{
    (void)font;
    (void)utf8;
    return 0.0f;
}

size_t cgt_text_fit(const text_font *font, const char *utf8, float width)
{
    (void)font;
    (void)width;
    return strlen(utf8);
}

uint32_t cgt_text_find_missing(const text_font *font, const char *utf8, char *missing, size_t size)
{
    (void)font;
    (void)utf8;
    (void)missing;
    (void)size;
    return 0;
}

void cgt_text_draw(const text_font *font, const canvas *c, float x, float y, const char *utf8, const float color[3])
{
    (void)font;
    (void)c;
    (void)x;
    (void)y;
    (void)utf8;
    (void)color;
}

#endif

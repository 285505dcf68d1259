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

const char *cgt_text_find_file(void)
{
    static const char *const places[] = {
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
        "/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/share/fonts/dejavu/DejaVuSans.ttf",
        "/usr/local/share/fonts/dejavu/DejaVuSans.ttf"};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        FILE *const file = fopen(places[i], "rb");
        if (file) {
            fclose(file);
            return places[i];
        }
    }
    return NULL;
}

#ifdef CGT_HAVE_FREETYPE

#ifdef CGT_HAVE_FONTCONFIG
#include <fontconfig/fontconfig.h>
#endif
#include <freetype/freetype.h>

enum { OTHER_FONTS = 8, LACKING = 64 };

/* Fonts for what the font lacks; found when they are needed. The configuration is the font's own, so that no state is
 * shared with a program that uses fontconfig, too. */
typedef struct other_fonts {
#ifdef CGT_HAVE_FONTCONFIG
    FcConfig *config;
#endif
    FT_Face face[OTHER_FONTS];
    uint32_t count;
    uint32_t lacking[LACKING], lacking_count; /* characters that no font has; beyond them none is looked for */
} other_fonts;

struct text_font {
    FT_Library library;
    FT_Face face;
    FT_F26Dot6 size;
    other_fonts *others;
};

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

/* ---- Other fonts -------------------------------------------------------------------------------------------- */

#ifdef CGT_HAVE_FONTCONFIG

/* Opens a font of outlines that has a character; NULL: it is none, or cannot be read. */
static FT_Face open_other(const text_font *font, FcPattern *found, uint32_t code)
{
    FcChar8 *file;
    FcCharSet *characters;
    FT_Face face;
    int index = 0;
    if (FcPatternGetCharSet(found, FC_CHARSET, 0, &characters) != FcResultMatch ||
        !FcCharSetHasChar(characters, code) || FcPatternGetString(found, FC_FILE, 0, &file) != FcResultMatch)
        return NULL;
    FcPatternGetInteger(found, FC_INDEX, 0, &index);
    if (FT_New_Face(font->library, (const char *)file, index, &face))
        return NULL;
    if (FT_IS_SCALABLE(face) && !FT_HAS_COLOR(face) && FT_Get_Char_Index(face, code) &&
        FT_Set_Char_Size(face, font->size, 0, 72, 72) == 0)
        return face;
    FT_Done_Face(face);
    return NULL;
}

/* A font that has a character, the nearest to a sans-serif one by the system's rules; NULL: there is none. */
static FT_Face find_other(const text_font *font, uint32_t code)
{
    FcConfig *const config = font->others->config ? font->others->config : FcInitLoadConfigAndFonts();
    FcPattern *const wanted = FcPatternCreate();
    FcCharSet *const characters = FcCharSetCreate();
    FcFontSet *fonts = NULL;
    FcResult result;
    FT_Face face = NULL;
    font->others->config = config;
    if (config && wanted && characters && FcCharSetAddChar(characters, code) &&
        FcPatternAddCharSet(wanted, FC_CHARSET, characters) &&
        FcPatternAddString(wanted, FC_FAMILY, (const FcChar8 *)"sans-serif") &&
        FcConfigSubstitute(config, wanted, FcMatchPattern)) {
        FcDefaultSubstitute(wanted);
        fonts = FcFontSort(config, wanted, FcFalse, NULL, &result);
    }
    for (int i = 0; fonts && i < fonts->nfont && !face; i++)
        face = open_other(font, fonts->fonts[i], code);
    if (fonts)
        FcFontSetDestroy(fonts);
    if (characters)
        FcCharSetDestroy(characters);
    if (wanted)
        FcPatternDestroy(wanted);
    return face;
}

static void free_config(other_fonts *o)
{
    if (o->config)
        FcConfigDestroy(o->config);
}

#else

static FT_Face find_other(const text_font *font, uint32_t code)
{
    (void)font;
    (void)code;
    return NULL;
}

static void free_config(other_fonts *o) { (void)o; }

#endif

/* The font that a character is drawn in: the first that has it; where none has, the first of all, which draws a box. */
static FT_Face face_of(const text_font *font, uint32_t code)
{
    other_fonts *const o = font->others;
    if (FT_Get_Char_Index(font->face, code) || code == 0xfffd)
        return font->face;
    for (uint32_t i = 0; i < o->count; i++)
        if (FT_Get_Char_Index(o->face[i], code))
            return o->face[i];
    for (uint32_t i = 0; i < o->lacking_count; i++)
        if (o->lacking[i] == code)
            return font->face;
    if (o->count == OTHER_FONTS || o->lacking_count == LACKING)
        return font->face;
    FT_Face found = find_other(font, code);
    if (found)
        return o->face[o->count++] = found;
    o->lacking[o->lacking_count++] = code;
    return font->face;
}

/* ---- The font ----------------------------------------------------------------------------------------------- */

static FT_Error open_face(text_font *font, const char *path)
{
    const char *const file = path ? path : cgt_text_find_file();
    return file ? FT_New_Face(font->library, file, 0, &font->face) : 1;
}

text_font *cgt_text_open(const char *path, float pixels, char *error, size_t error_size)
{
    text_font *font = calloc(1, sizeof *font);
    other_fonts *others = calloc(1, sizeof *others);
    if (!font || !others || FT_Init_FreeType(&font->library)) {
        snprintf(error, error_size, "out of memory for a font");
        free(others);
        free(font);
        return NULL;
    }
    font->others = others;
    font->size = (FT_F26Dot6)(64.0f * pixels);
    if (open_face(font, path)) {
        if (path)
            snprintf(error, error_size, "%s: this is no font that can be read", path);
        else
            snprintf(
                error, error_size,
                "text needs a font, and DejaVu Sans is not where distributions put it (package fonts-dejavu-core): "
                "give one by --font");
    } else if (FT_Set_Char_Size(font->face, font->size, 0, 72, 72)) {
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
    for (uint32_t i = 0; i < font->others->count; i++)
        FT_Done_Face(font->others->face[i]);
    free_config(font->others);
    free(font->others);
    if (font->face)
        FT_Done_Face(font->face);
    FT_Done_FreeType(font->library);
    free(font);
}

void cgt_text_set_size(text_font *font, float pixels)
{
    if (!font)
        return;
    font->size = (FT_F26Dot6)(64.0f * pixels);
    FT_Set_Char_Size(font->face, font->size, 0, 72, 72);
    for (uint32_t i = 0; i < font->others->count; i++)
        FT_Set_Char_Size(font->others->face[i], font->size, 0, 72, 72);
}

/* ---- Widths ------------------------------------------------------------------------------------------------- */

static float advance_of(const text_font *font, uint32_t code)
{
    FT_Face face = face_of(font, code);
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
        if (FT_Get_Char_Index(face_of(font, code), code) || strstr(missing, character))
            continue;
        first = first ? first : code;
        if (length + strlen(character) < size)
            memcpy(missing + length, character, strlen(character) + 1);
    }
    return first;
}

static uint8_t value_at(const FT_Bitmap *b, int32_t i, int32_t j)
{
    return i < 0 || j < 0 || i >= (int32_t)b->width || j >= (int32_t)b->rows ? 0 : b->buffer[j * b->pitch + i];
}

/* The darkest of what lies around a pixel, at a distance. */
static uint8_t value_around(const FT_Bitmap *b, int32_t i, int32_t j, int32_t far)
{
    static const int32_t sides[8][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    const int32_t near = (181 * far + 128) / 256; /* on the diagonals */
    uint8_t most = 0;
    for (int k = 0; k < 8; k++) {
        const int32_t by = k < 4 ? far : near;
        const uint8_t value = value_at(b, i + by * sides[k][0], j + by * sides[k][1]);
        most = value > most ? value : most;
    }
    return most;
}

/* rim: 0, or how far around the letter its rim is, which is drawn in its place. */
static void draw_bitmap(const canvas *c, FT_GlyphSlot glyph, int32_t x, int32_t y, int32_t rim, const float color[3])
{
    const FT_Bitmap *b = &glyph->bitmap;
    if (b->pixel_mode != FT_PIXEL_MODE_GRAY)
        return; /* a font of bitmaps */
    /* In linear light dark strokes look thinner than light ones, and small texts pale. */
    const int is_dark = color[0] + color[1] + color[2] < 0.6f;
    for (int32_t j = -rim; j < (int32_t)b->rows + rim; j++)
        for (int32_t i = -rim; i < (int32_t)b->width + rim; i++) {
            const float share = (float)(rim ? value_around(b, i, j, rim) : value_at(b, i, j)) / 255.0f;
            cgt_canvas_blend(c, x + glyph->bitmap_left + i, y - glyph->bitmap_top + j, color,
                             is_dark ? sqrtf(share) : share);
        }
}

void cgt_text_draw_rim(const text_font *font, const canvas *c, float x, float y, const char *utf8, uint32_t rim,
                       const float color[3])
{
    uint32_t code;
    while ((code = next_character(&utf8)) != 0) {
        FT_Face face = face_of(font, code);
        if (FT_Load_Char(face, code, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) != 0)
            continue;
        draw_bitmap(c, face->glyph, (int32_t)(x + 0.5f), (int32_t)(y + 0.5f), (int32_t)rim, color);
        x += (float)face->glyph->advance.x / 64.0f;
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

void cgt_text_draw_rim(const text_font *font, const canvas *c, float x, float y, const char *utf8, uint32_t rim,
                       const float color[3])
{
    (void)font;
    (void)c;
    (void)x;
    (void)y;
    (void)utf8;
    (void)rim;
    (void)color;
}

#endif

void cgt_text_draw(const text_font *font, const canvas *c, float x, float y, const char *utf8, const float color[3])
{
    cgt_text_draw_rim(font, c, x, y, utf8, 0, color);
}

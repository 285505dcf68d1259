/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Maps numbers to colours; see colormap.h.
 *
 * viridis and plasma are by Nathaniel J. Smith, Stefan van der Walt and (viridis) Eric Firing, published with
 * matplotlib and dedicated to the public domain under CC0. The tables hold every fifth of their 256 entries, rounded
 * to 8 bits; lines between them stay within two and a half 8-bit steps of the full tables.
 * The colours of kinds are those of Masataka Okabe and Kei Ito, "Color Universal Design" (2008), with a grey in
 * place of their black, on which shading would not show. */
#include "picture/colormap.h"

#include <stddef.h>
#include <string.h>

enum { KNOTS = 52 };

struct colormap {
    const char *name;
    uint8_t srgb[KNOTS][3];
};

static const colormap maps[] = {
    {"viridis",
     {{68, 1, 84},    {70, 8, 92},    {71, 16, 99},   {72, 23, 105},  {72, 29, 111},  {72, 36, 117},  {71, 42, 122},
      {70, 48, 126},  {69, 55, 129},  {67, 61, 132},  {65, 66, 135},  {63, 72, 137},  {61, 78, 138},  {58, 83, 139},
      {56, 89, 140},  {53, 94, 141},  {51, 99, 141},  {49, 104, 142}, {46, 109, 142}, {44, 113, 142}, {42, 118, 142},
      {41, 123, 142}, {39, 128, 142}, {37, 132, 142}, {35, 137, 142}, {33, 142, 141}, {32, 146, 140}, {31, 151, 139},
      {30, 156, 137}, {31, 161, 136}, {33, 165, 133}, {36, 170, 131}, {40, 174, 128}, {46, 179, 124}, {53, 183, 121},
      {61, 188, 116}, {70, 192, 111}, {80, 196, 106}, {90, 200, 100}, {101, 203, 94}, {112, 207, 87}, {124, 210, 80},
      {137, 213, 72}, {149, 216, 64}, {162, 218, 55}, {176, 221, 47}, {189, 223, 38}, {202, 225, 31}, {216, 226, 25},
      {229, 228, 25}, {241, 229, 29}, {253, 231, 37}}},
    {"plasma",
     {{13, 8, 135},   {27, 6, 141},   {38, 5, 145},   {47, 5, 150},   {56, 4, 154},   {65, 4, 157},   {73, 3, 160},
      {81, 2, 163},   {89, 1, 165},   {97, 0, 167},   {105, 0, 168},  {113, 0, 168},  {120, 1, 168},  {128, 4, 168},
      {135, 7, 166},  {142, 12, 164}, {149, 17, 161}, {156, 23, 158}, {162, 29, 154}, {168, 34, 150}, {174, 40, 146},
      {180, 46, 141}, {186, 51, 136}, {191, 57, 132}, {196, 62, 127}, {201, 68, 122}, {205, 74, 118}, {210, 79, 113},
      {214, 85, 109}, {218, 91, 105}, {222, 97, 100}, {226, 102, 96}, {230, 108, 92}, {233, 114, 87}, {237, 121, 83},
      {240, 127, 79}, {243, 133, 75}, {245, 140, 70}, {247, 147, 66}, {249, 154, 62}, {251, 161, 57}, {252, 168, 53},
      {253, 175, 49}, {254, 183, 45}, {254, 190, 42}, {253, 198, 39}, {252, 206, 37}, {251, 215, 36}, {248, 223, 37},
      {246, 232, 38}, {243, 240, 39}, {240, 249, 33}}},
};

enum { MAPS = sizeof(maps) / sizeof(maps[0]) };

static const char *const names[MAPS + 1] = {"viridis", "plasma", NULL};

/* Shading brings orange, yellow and vermilion close, so this order keeps them apart in files of few types. */
static const uint8_t kinds[COLORMAP_TYPES][3] = {
    {230, 159, 0},   /* orange */
    {86, 180, 233},  /* sky blue */
    {0, 158, 115},   /* bluish green */
    {204, 121, 167}, /* reddish purple */
    {240, 228, 66},  /* yellow */
    {0, 114, 178},   /* blue */
    {213, 94, 0},    /* vermilion */
    {153, 153, 153}  /* grey */
};

const colormap *colormap_find(const char *name)
{
    for (size_t i = 0; i < MAPS; i++)
        if (strcmp(maps[i].name, name) == 0)
            return &maps[i];
    return NULL;
}

const char *const *colormap_names(void) { return names; }

void colormap_at(const colormap *map, float x, float srgb[3])
{
    const float position = x > 0.0f ? (x < 1.0f ? x : 1.0f) * (float)(KNOTS - 1) : 0.0f;
    const int k = position < (float)(KNOTS - 1) ? (int)position : KNOTS - 2;
    const float f = position - (float)k;
    for (int c = 0; c < 3; c++)
        srgb[c] = ((1.0f - f) * (float)map->srgb[k][c] + f * (float)map->srgb[k + 1][c]) / 255.0f;
}

void colormap_type(uint32_t type, float srgb[3])
{
    const uint8_t *kind = kinds[(type + COLORMAP_TYPES - 1) % COLORMAP_TYPES];
    for (int c = 0; c < 3; c++)
        srgb[c] = (float)kind[c] / 255.0f;
}

void colormap_unknown(float srgb[3]) { srgb[0] = srgb[1] = srgb[2] = 0.62f; }

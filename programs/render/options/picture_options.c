/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Options about the look of pictures; see picture_options.h. */
#include "render/options/picture_options.h"

#include <stdio.h>
#include <string.h>

#include "common/program.h"
#include "picture/color/srgb.h"
#include "render/options/settings/option_values.h"

enum {
    OPTION_STYLE = 1024,
    OPTION_AMBIENT,
    OPTION_AMBIENT_RADIUS,
    OPTION_SHADOWS,
    OPTION_NO_SHADOWS,
    OPTION_LIGHT_SIZE,
    OPTION_LIGHT_SAMPLES,
    OPTION_KEY,
    OPTION_SKY,
    OPTION_HEAD,
    OPTION_SUN,
    OPTION_LAMP,
    OPTION_CUE,
    OPTION_OUTLINE,
    OPTION_BACKGROUND,
    OPTION_TRANSPARENT,
    OPTION_ORTHO,
    OPTION_TITLE,
    OPTION_TIME,
    OPTION_BAR,
    OPTION_LEGEND,
    OPTION_AXES,
    OPTION_FONT,
    OPTION_TEXT_SIZE,
    OPTION_NO_METADATA
};

static const struct argp_option table[] = {
    {NULL, 0, NULL, 0, "Style and light:", 10},
    {"style", OPTION_STYLE, "NAME", 0,
     "soft (default): ambient occlusion, a light with shadows; paper: the same on white, with outlines; plain: a light "
     "without shadows, the fastest. The options below change what a style sets",
     0},
    {"ambient", OPTION_AMBIENT, "N", 0,
     "Ambient occlusion by N rays for each pixel, 0 (none) to 256; soft and paper: 16", 0},
    {"ambient-radius", OPTION_AMBIENT_RADIUS, "R", 0,
     "What is farther than R world units does not occlude; 0: any distance; default: a quarter of the height that the "
     "camera shows at its target",
     0},
    {"shadows", OPTION_SHADOWS, NULL, 0, "Lights cast shadows; default in soft and paper", 0},
    {"no-shadows", OPTION_NO_SHADOWS, NULL, 0, "Lights shine through everything; default in plain", 0},
    {"light-size", OPTION_LIGHT_SIZE, "SIZE", 0,
     "Soft shadows: radius of a lamp in world units, of other lights in degrees, 0 to 45; default 0: hard ones", 0},
    {"light-samples", OPTION_LIGHT_SAMPLES, "N", 0, "Rays for each pixel to a light with a size, 1 to 256; default 8",
     0},
    {"light-strength", OPTION_KEY, "S", 0, "Of the first light: 1 shows colours as they are where it falls straight",
     0},
    {"fill", OPTION_SKY, "S", 0, "Strength of the light from all sides, which ambient occlusion dims", 0},
    {"head", OPTION_HEAD, "S", 0, "Strength of the light from the eye, without shadows", 0},
    {"sun", OPTION_SUN, "X,Y,Z[,STRENGTH[,RRGGBB]]", 0,
     "One more light, in this direction from everywhere; default strength 0.4. Up to seven with --lamp", 0},
    {"lamp", OPTION_LAMP, "X,Y,Z[,STRENGTH[,RRGGBB]]", 0, "One more light, at this place; it does not fade", 0},
    {NULL, 0, NULL, 0, "Drawing:", 11},
    {"background", OPTION_BACKGROUND, "RRGGBB", 0, "Background colour; default by style", 0},
    {"transparent", OPTION_TRANSPARENT, NULL, 0, "PNG or EXR with alpha: the background is transparent", 0},
    {"ortho", OPTION_ORTHO, NULL, 0, "Parallel projection; it shows what the perspective camera shows at its target",
     0},
    {"depth-cue", OPTION_CUE, "SHARE", OPTION_ARG_OPTIONAL,
     "What lies behind the target fades to the background, and what lies before it less; far behind it by this share, "
     "default 0.6",
     0},
    {"outline", OPTION_OUTLINE, "PIXELS", OPTION_ARG_OPTIONAL, "Dark outlines of this width; default 1", 0},
    {"title", OPTION_TITLE, "TEXT", 0, "A title over the picture", 0},
    {"time", OPTION_TIME, "FORMAT", OPTION_ARG_OPTIONAL,
     "Time below the picture; {time}, {step} and {frame} in the format are replaced, such as 't = {time} ps'", 0},
    {"colorbar", OPTION_BAR, "TITLE", OPTION_ARG_OPTIONAL,
     "A bar with the colours' values, with this title, such as 'speed, nm/ps'; of types and elements a legend", 0},
    {"legend", OPTION_LEGEND, "TITLE", OPTION_ARG_OPTIONAL,
     "Swatches with the names of the types or elements that are drawn in any frame, with this title", 0},
    {"axes", OPTION_AXES, NULL, 0, "The directions of x, y and z in a corner", 0},
    {"font", OPTION_FONT, "FILE", 0, "Font of texts; default DejaVu Sans", 0},
    {"no-metadata", OPTION_NO_METADATA, NULL, 0, "Pictures do not say how they were made", 0},
    {"text-size", OPTION_TEXT_SIZE, "SHARE", 0, "Size of texts as a share of the picture's height; default 0.03", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

static int parse_style(const char *text, picture_style *style, char *error, size_t size)
{
    static const char *const names[] = {"soft", "paper", "plain"};
    for (int i = 0; i < 3; i++)
        if (strcmp(text, names[i]) == 0) {
            *style = (picture_style)i;
            return 0;
        }
    snprintf(error, size, "\"%s\" is not soft, paper or plain", text);
    return -1;
}

static int parse_count(const char *text, uint32_t least, float *value, char *error, size_t size)
{
    uint32_t count;
    if (program_parse_u32(text, least, DRAW_MAX_SAMPLES, &count, error, size))
        return -1;
    *value = (float)count;
    return 0;
}

/* x,y,z, then strength, then colour. */
static int parse_lamp(const char *text, cgt_light_kind kind, picture_options *o, char *error, size_t size)
{
    char numbers[256];
    float v[4] = {0.0f, 0.0f, 0.0f, 0.4f};
    uint8_t rgb[3] = {255, 255, 255};
    size_t count, commas = 0;
    if (o->lamp_count == DRAW_MAX_LIGHTS - 1) {
        snprintf(error, size, "more than %d lights beside the first", DRAW_MAX_LIGHTS - 1);
        return -1;
    }
    if (strlen(text) >= sizeof numbers) {
        snprintf(error, size, "the text is too long");
        return -1;
    }
    strcpy(numbers, text);
    for (char *c = numbers; *c; c++)
        if (*c == ',' && ++commas == 4) {
            *c = '\0';
            if (option_parse_color(c + 1, rgb, error, size))
                return -1;
            break;
        }
    if (option_parse_numbers(numbers, 3, 4, v, &count, error, size))
        return -1;
    if (v[3] < 0.0f || v[3] > 100.0f || (kind == CGT_LIGHT_DIRECTIONAL && !v[0] && !v[1] && !v[2])) {
        snprintf(error, size, "\"%s\": a strength is 0 to 100, and 0,0,0 is no direction", text);
        return -1;
    }
    picture_lamp *lamp = &o->lamps[o->lamp_count++];
    lamp->kind = kind;
    lamp->strength = v[3];
    for (int c = 0; c < 3; c++) {
        lamp->place[c] = v[c];
        lamp->color[c] = srgb_to_linear((float)rgb[c] / 255.0f);
    }
    return 0;
}

/* Returns 0, 1 where key is none of light, or -1 with a sentence. */
static int parse_light(int key, const char *arg, picture_options *o, char *error, size_t size)
{
    switch (key) {
    case OPTION_STYLE: return parse_style(arg, &o->style, error, size);
    case OPTION_AMBIENT: return parse_count(arg, 0, &o->ambient, error, size);
    case OPTION_AMBIENT_RADIUS: return program_parse_float(arg, 0.0f, 1e30f, &o->ambient_radius, error, size);
    case OPTION_SHADOWS: o->shadows = 1.0f; return 0;
    case OPTION_NO_SHADOWS: o->shadows = 0.0f; return 0;
    case OPTION_LIGHT_SIZE: return program_parse_float(arg, 0.0f, 45.0f, &o->light_size, error, size);
    case OPTION_LIGHT_SAMPLES: return parse_count(arg, 1, &o->light_samples, error, size);
    case OPTION_KEY: return program_parse_float(arg, 0.0f, 100.0f, &o->key, error, size);
    case OPTION_SKY: return program_parse_float(arg, 0.0f, 100.0f, &o->sky, error, size);
    case OPTION_HEAD: return program_parse_float(arg, 0.0f, 100.0f, &o->head, error, size);
    case OPTION_SUN: return parse_lamp(arg, CGT_LIGHT_DIRECTIONAL, o, error, size);
    case OPTION_LAMP: return parse_lamp(arg, CGT_LIGHT_POINT, o, error, size);
    default: return 1;
    }
}

static int parse_drawing(int key, const char *arg, picture_options *o, char *error, size_t size)
{
    switch (key) {
    case OPTION_BACKGROUND: o->has_background = 1; return option_parse_color(arg, o->background, error, size);
    case OPTION_TRANSPARENT: o->transparent = 1; return 0;
    case OPTION_ORTHO: o->ortho = 1; return 0;
    case OPTION_CUE: return program_parse_float(arg ? arg : "0.6", 0.0f, 1.0f, &o->cue, error, size);
    case OPTION_NO_METADATA: o->no_metadata = 1; return 0;
    case OPTION_TITLE: o->title = arg; return 0;
    case OPTION_TIME: o->time = arg ? arg : ""; return 0;
    case OPTION_BAR: o->bar = arg ? arg : ""; return 0;
    case OPTION_LEGEND: o->legend = arg ? arg : ""; return 0;
    case OPTION_AXES: o->axes = 1; return 0;
    case OPTION_FONT: o->font = arg; return 0;
    case OPTION_TEXT_SIZE: return program_parse_float(arg, 0.005f, 0.2f, &o->text_size, error, size);
    case OPTION_OUTLINE: return program_parse_float(arg ? arg : "1", 0.0f, 20.0f, &o->outline, error, size);
    default: return 1;
    }
}

static const char *option_name(int key)
{
    for (const struct argp_option *row = table; row->name || row->doc; row++)
        if (row->key == key && row->name)
            return row->name;
    return "option";
}

static error_t parse_key(int key, char *arg, struct argp_state *state)
{
    picture_options *o = state->input;
    char error[PROGRAM_ERROR_SIZE];
    int result = parse_light(key, arg, o, error, sizeof error);
    if (result == 1)
        result = parse_drawing(key, arg, o, error, sizeof error);
    if (result < 0)
        argp_error(state, "--%s: %s", option_name(key), error);
    return result == 1 ? ARGP_ERR_UNKNOWN : 0;
}

const struct argp picture_options_parser = {table, parse_key, NULL, NULL, NULL, NULL, NULL};

void picture_options_init(picture_options *o)
{
    memset(o, 0, sizeof *o);
    o->text_size = 0.03f;
    o->ambient = o->ambient_radius = o->shadows = o->light_size = o->light_samples = -1.0f;
    o->key = o->sky = o->head = o->cue = o->outline = -1.0f;
}

typedef struct style_values {
    float ambient, shadows, key, sky, head, outline;
    uint8_t background[3];
} style_values;

static void set_default(float *value, float otherwise) { *value = *value < 0.0f ? otherwise : *value; }

void picture_options_finish(picture_options *o)
{
    /* Where all of a style's light falls, a colour is shown as it is or little brighter. */
    static const style_values styles[] = {
        [STYLE_SOFT] = {16.0f, 1.0f, 0.62f, 0.36f, 0.10f, 0.0f, {0x2a, 0x2f, 0x37}},
        [STYLE_PAPER] = {16.0f, 1.0f, 0.45f, 0.55f, 0.12f, 0.8f, {0xff, 0xff, 0xff}},
        [STYLE_PLAIN] = {0.0f, 0.0f, 0.85f, 0.05f, 0.35f, 0.0f, {0x3a, 0x3f, 0x47}},
    };
    const style_values *s = &styles[o->style];
    o->own_light = o->key >= 0.0f || o->sky >= 0.0f || o->head >= 0.0f;
    set_default(&o->ambient, s->ambient);
    set_default(&o->shadows, s->shadows);
    set_default(&o->key, s->key);
    set_default(&o->sky, s->sky);
    set_default(&o->head, s->head);
    set_default(&o->outline, s->outline);
    set_default(&o->light_size, 0.0f);
    set_default(&o->light_samples, 8.0f);
    set_default(&o->cue, 0.0f);
    if (!o->has_background)
        memcpy(o->background, s->background, sizeof s->background);
}

int picture_options_have_overlay(const picture_options *o)
{
    return o->title || o->time || o->bar || o->legend || o->axes;
}

int picture_options_need_drawing(const picture_options *o)
{
    return o->style != STYLE_PLAIN || o->ambient > 0.0f || o->shadows > 0.0f || o->lamp_count || o->cue > 0.0f ||
           o->outline > 0.0f || o->transparent || o->own_light;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pictures of cgt-render; see render_setup.h. cgt/picture.h makes them from what is chosen here. */
#define _POSIX_C_SOURCE 200809L
#include "render/render_setup.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "picture/figures/element_symbols.h"

static void set_first_light(const renderer *r, cgt_picture_light *light)
{
    const picture_options *o = &r->options.figure.picture;
    *light = (cgt_picture_light){.light = {.kind = CGT_LIGHT_DIRECTIONAL}, .shadows = o->shadows > 0.0f};
    light->size = o->light_size;
    for (int c = 0; c < 3; c++) {
        light->light.position[c] = r->light[c];
        light->color[c] = o->key;
    }
}

static void set_lamp(const renderer *r, const picture_lamp *lamp, cgt_picture_light *light)
{
    const picture_options *const o = &r->options.figure.picture;
    *light = (cgt_picture_light){.light = {.kind = lamp->kind}, .shadows = o->shadows > 0.0f, .size = o->light_size};
    for (int c = 0; c < 3; c++) {
        light->color[c] = lamp->strength * lamp->color[c];
        light->light.position[c] =
            lamp->kind == CGT_LIGHT_DIRECTIONAL ? lamp->place[c] : (float)(lamp->at[c] - r->origin[c]);
    }
}

cgt_picture_options render_picture_settings(const renderer *r)
{
    const picture_options *o = &r->options.figure.picture;
    cgt_picture_options s = {
        .width = r->options.figure.width, .height = r->options.figure.height, .antialias = r->options.figure.samples};
    const int is_full =
        picture_options_need_drawing(o) || render_scene_has_figures(r) || r->options.figure.floor.is_set;
    s.shading = r->options.figure.bounce.is_set ? CGT_SHADING_BOUNCES : is_full ? CGT_SHADING_FULL : CGT_SHADING_PLAIN;
    s.lighting.ambient = (uint32_t)o->ambient;
    s.lighting.ambient_radius = o->ambient_radius < 0.0f ? style_ambient_radius(&r->path.start) : o->ambient_radius;
    s.lighting.light_samples = (uint32_t)o->light_samples;
    set_first_light(r, &s.lighting.lights[s.lighting.light_count++]);
    for (uint32_t i = 0; i < o->lamp_count; i++)
        set_lamp(r, &o->lamps[i], &s.lighting.lights[s.lighting.light_count++]);
    s.lighting.sky = o->sky;
    s.lighting.head = o->head;
    s.style.transparent = o->transparent;
    s.style.cue = o->cue;
    s.style.cue_range[0] = fmaxf(0.0f, style_distance(&r->path.start) - 0.6f * style_shown_height(&r->path.start));
    s.style.cue_range[1] = style_distance(&r->path.start) + 0.6f * style_shown_height(&r->path.start);
    s.style.outline = o->outline;
    for (int c = 0; c < 3; c++) {
        s.style.background[c] = cgt_srgb_decode(o->background[c]);
        s.style.outline_color[c] = 0.01f;
    }
    if (r->options.mesh && r->options.figure.particles.mesh_opacity < 1.0f) {
        s.style.front = r->options.figure.particles.mesh_opacity;
        s.style.behind_mask = MASK_ALL_BUT_MESH;
    }
    if (r->bounce)
        render_bounce_settings(r, &s);
    s.work.stop = stop_flag_is_set;
    s.work.stop_user = r->stop;
    return s;
}

/* The orthographic camera shows what the perspective one shows at its target. */
static void set_projection(const renderer *r, cgt_camera *camera)
{
    if (!r->options.figure.picture.ortho)
        return;
    camera->projection = CGT_PROJECTION_ORTHOGRAPHIC;
    camera->height = style_shown_height(camera);
}

/* ---- Overlay ------------------------------------------------------------------------------------------------ */

static void name_kind(const renderer *r, uint32_t kind, int is_element, char *name, size_t size)
{
    const particle_options *o = &r->options.figure.particles;
    if (!is_element)
        snprintf(name, size, "type %" PRIu32, kind);
    else
        snprintf(name, size, "%s", kind ? element_symbol(kind) : "others");
    for (uint32_t i = 0; i < o->name_count; i++)
        if (o->names[i].kind.is_element == is_element && o->names[i].kind.kind == kind)
            snprintf(name, size, "%s", o->names[i].name);
}

/* Types and elements in the order of their numbers; spheres that are no element come last. */
static void choose_legend(renderer *r)
{
    const picture_options *o = &r->options.figure.picture;
    const int is_element = r->coloring.by == COLORING_ELEMENT;
    const uint8_t *has = is_element ? r->survey.has_elements : r->survey.has_types;
    overlay *v = &r->overlay;
    v->legend = o->legend ? o->legend : o->bar;
    v->kinds = r->kinds;
    for (uint32_t i = 0; i < SURVEY_KINDS && v->legend; i++) {
        const uint32_t kind = is_element ? (i + 1) % SURVEY_KINDS : i;
        if (!has[kind])
            continue;
        if (v->kind_count < OVERLAY_MOST_KINDS) {
            overlay_kind *const line = &r->kinds[v->kind_count];
            memcpy(line->color, r->coloring.palette[coloring_entry_of_kind(&r->coloring, kind)], sizeof line->color);
            name_kind(r, kind, is_element, line->name, sizeof line->name);
        }
        v->kind_count++;
    }
}

static void choose_bar(renderer *r)
{
    const picture_options *o = &r->options.figure.picture;
    r->overlay.bar = o->bar;
    if (o->bar && !(r->coloring.max > r->coloring.min))
        program_error("--colorbar: the colours are those of neither types nor values of some range: there is no bar");
    if (o->legend)
        program_error("--legend: the colours are those of neither types nor elements: there is no legend");
}

static int choose_overlay(renderer *r)
{
    const picture_options *o = &r->options.figure.picture;
    const uint8_t *back = o->background;
    overlay *v = &r->overlay;
    if (!picture_options_have_overlay(o))
        return 0;
    v->size = fmaxf(8.0f, o->text_size * (float)r->options.figure.height);
    v->font = text_open(o->font, v->size, r->error, sizeof r->error);
    if (!v->font)
        return render_fail(r);
    v->title = o->title;
    v->time = !o->time || *o->time ? o->time : "t = {time}";
    v->axes = o->axes;
    v->coloring = &r->coloring;
    if (r->coloring.by == COLORING_TYPE || r->coloring.by == COLORING_ELEMENT)
        choose_legend(r);
    else
        choose_bar(r);
    const float grey = back[0] + back[1] + back[2] > 384 ? 0.01f : 0.85f; /* dark on light, light on dark */
    for (int c = 0; c < 3; c++)
        v->color[c] = grey;
    return 0;
}

void render_picture_overlay(renderer *r)
{
    const canvas c = {r->options.figure.width, r->options.figure.height, r->image.bytes, r->image.alpha,
                      r->image.linear};
    overlay_frame frame = {.number = r->frame->number, .step = r->frame->step, .time = r->frame->time};
    if (!r->overlay.font)
        return;
    cgt_camera_get_axes(&r->camera, frame.right, frame.up, frame.forward);
    overlay_draw(&r->overlay, &c, &frame);
}

/* ---- What pictures say of themselves ------------------------------------------------------------------------ */

static void add_text(renderer *r, const char *key, const char *value)
{
    if (value && *value)
        r->texts[r->text_count++] = (png_text){key, value};
}

/* The settings, then the camera and the range that were found, so that the picture can be made again. */
static int describe(renderer *r)
{
    const render_options *o = &r->options;
    const char *const settings = o->settings ? o->settings : "";
    const int digits = renderer_is_moved(r) ? 15 : 9;
    char camera[RENDERER_CAMERA_SIZE], origin[100] = "", range[100] = "";
    if (o->no_metadata)
        return 0;
    renderer_name_camera(r, &r->path.start, camera);
    if (!o->reading.has_origin && renderer_is_moved(r))
        snprintf(origin, sizeof origin, "origin = %.15g,%.15g,%.15g\n", r->origin[0], r->origin[1], r->origin[2]);
    if (!o->figure.has_range && r->coloring.max > r->coloring.min)
        snprintf(range, sizeof range, "range = %.*g,%.*g\n", digits, r->coloring.min, digits, r->coloring.max);
    const size_t size = strlen(settings) + sizeof camera + sizeof origin + sizeof range;
    char *const text = malloc(size);
    if (!text) {
        program_error("out of memory");
        return -1;
    }
    snprintf(text, size, "%s%s%s%s%s", settings,
             o->figure.has_camera ? "" : "camera = ", o->figure.has_camera ? "" : camera, origin, range);
    r->settings = text;
    add_text(r, "Software", "cgt-render (libcgt " CGT_VERSION_STRING ")");
    add_text(r, "Source", o->input);
    add_text(r, "Title", o->figure.picture.title);
    add_text(r, "Settings", r->settings);
    return 0;
}

/* ---- A run -------------------------------------------------------------------------------------------------- */

int render_picture_setup(renderer *r)
{
    if (choose_overlay(r) || describe(r))
        return -1;
    const cgt_picture_options settings = render_picture_settings(r);
    const cgt_result result = cgt_picture_create(r->context, &settings, &r->drawing);
    if (result == CGT_ERROR_OUT_OF_MEMORY)
        program_error("out of memory for the planes of %" PRIu32 "x%" PRIu32 " rays: --style plain takes none",
                      r->options.figure.width * r->options.figure.samples,
                      r->options.figure.height * r->options.figure.samples);
    else if (result) {
        char reason[256];
        cgt_picture_get_error_message(r->drawing, reason, sizeof reason);
        program_error("cannot make pictures: %s", reason);
    }
    return result ? -1 : 0;
}

void render_picture_close(renderer *r)
{
    cgt_picture_release(r->drawing);
    r->drawing = NULL;
    text_close(r->overlay.font);
    free(r->settings);
    free(r->options.settings);
}

uint32_t render_picture_begin(renderer *r, cgt_look *looks)
{
    set_projection(r, &r->camera);
    return r->bounce ? render_bounce_looks(r->bounce, looks) : render_scene_looks(r, looks);
}

cgt_result render_picture_trace(renderer *r, const cgt_trace_options *options)
{
    cgt_look looks[RENDER_LOOKS];
    const uint32_t count = render_picture_begin(r, looks);
    const cgt_result result = cgt_picture_draw(r->drawing, r->scene, &r->camera, looks, count, &r->image, options);
    if (result == CGT_OK)
        render_picture_overlay(r);
    return result;
}

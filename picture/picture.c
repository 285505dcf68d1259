/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The calls of cgt/picture.h. draw/draw.h makes the pixels. */
#include <cgt/picture.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw/draw.h"
#include "picture_options.h"
#include "picture_tiles.h"

typedef enum picture_state { NOTHING = 0, TILES, SCENE } picture_state; /* what has begun */

struct cgt_picture {
    cgt_context *context;
    bool failed; /* its creation: all calls do */
    cgt_picture_options options;
    int has_default_light;
    srgb_table srgb;
    drawing front, behind; /* behind: the same without what is in front, where that is transparent */
    picture_looks looks;
    picture_state state;
    const cgt_scene *scene;
    cgt_trace_options trace; /* of PLAIN, when it is read */
    char message[256];
};

static int has_layers(const cgt_picture_options *o) { return o->style.front < 1.0f && o->shading == CGT_SHADING_FULL; }

static cgt_result fail(cgt_picture *p, cgt_result result, const char *message)
{
    snprintf(p->message, sizeof p->message, "%s", message);
    return result;
}

/* An error of a call that draws: the picture's own memory or a stop, else the context has the message. */
static cgt_result tell_drawing(cgt_picture *p, cgt_result result)
{
    if (result == CGT_ERROR_STOPPED)
        return fail(p, result, "the picture was stopped");
    if (result != CGT_OK)
        cgt_context_get_error_message(p->context, p->message, sizeof p->message);
    if (result == CGT_ERROR_OUT_OF_MEMORY)
        return fail(p, result, "out of memory for the rays of a picture");
    return result;
}

/* The same, after which nothing is there to be read. */
static cgt_result fail_drawing(cgt_picture *p, cgt_result result)
{
    p->state = result == CGT_OK ? p->state : NOTHING;
    return tell_drawing(p, result);
}

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

static int has_same_planes(const cgt_picture_options *a, const cgt_picture_options *b)
{
    int same = a->width == b->width && a->height == b->height && a->antialias == b->antialias &&
               a->shading == b->shading && !a->lighting.ambient == !b->lighting.ambient &&
               a->lighting.light_count == b->lighting.light_count && has_layers(a) == has_layers(b);
    for (uint32_t i = 0; i < a->lighting.light_count && same; i++)
        same = a->lighting.lights[i].shadows == b->lighting.lights[i].shadows &&
               draw_is_soft(&a->lighting.lights[i]) == draw_is_soft(&b->lighting.lights[i]);
    return same;
}

/* Makes planes, where they are not there already; what fails leaves the picture as it was. */
static cgt_result set_options(cgt_picture *p, cgt_picture_options *checked)
{
    const int has_default_light = cgt_picture_has_default_light(checked);
    if (has_default_light)
        cgt_picture_set_default_light(checked, NULL);
    if (!has_same_planes(&p->options, checked)) {
        drawing next[2] = {{.options = checked, .srgb = &p->srgb}, {.options = checked, .srgb = &p->srgb}};
        if (cgt_draw_init(&next[0]) || (has_layers(checked) && cgt_draw_init(&next[1]))) {
            cgt_draw_free(&next[0]);
            return CGT_ERROR_OUT_OF_MEMORY;
        }
        cgt_draw_free(&p->front);
        cgt_draw_free(&p->behind);
        p->front = next[0];
        p->behind = next[1];
        p->front.context = p->behind.context = p->context;
    }
    p->options = *checked;
    p->has_default_light = has_default_light;
    p->state = NOTHING;
    cgt_draw_set_options(&p->front, &p->options);
    cgt_draw_set_options(&p->behind, &p->options);
    return CGT_OK;
}

static cgt_result choose_options(cgt_picture *p, const cgt_picture_options *options)
{
    cgt_picture_options checked;
    if (!p->context)
        return fail(p, CGT_ERROR_INVALID_ARGUMENT, "a picture needs a context");
    if (!*cgt_context_get_variant(p->context))
        return fail(p, CGT_ERROR_INVALID_ARGUMENT, "a picture needs a context whose creation has not failed");
    cgt_result result = cgt_picture_check_options(options, &checked, p->message, sizeof p->message);
    if (result == CGT_OK)
        result = set_options(p, &checked);
    return result == CGT_ERROR_OUT_OF_MEMORY ? fail(p, result, "out of memory for the rays of a picture") : result;
}

cgt_result cgt_picture_create(cgt_context *context, const cgt_picture_options *options, cgt_picture **picture)
{
    if (!picture)
        return CGT_ERROR_INVALID_ARGUMENT;
    cgt_picture *p = *picture = calloc(1, sizeof *p);
    if (!p)
        return CGT_ERROR_OUT_OF_MEMORY;
    p->context = context;
    cgt_srgb_table_init(&p->srgb);
    const cgt_result result = choose_options(p, options);
    p->failed = result != CGT_OK;
    return result;
}

cgt_result cgt_picture_set_options(cgt_picture *p, const cgt_picture_options *options)
{
    return !p || p->failed ? CGT_ERROR_INVALID_ARGUMENT : choose_options(p, options);
}

void cgt_picture_release(cgt_picture *p)
{
    if (!p)
        return;
    cgt_draw_free(&p->front);
    cgt_draw_free(&p->behind);
    cgt_looks_free(&p->looks);
    free(p);
}

size_t cgt_picture_get_error_message(const cgt_picture *p, char *text, size_t size)
{
    const char *const message = p ? p->message : "out of memory for a picture";
    if (text && size)
        snprintf(text, size, "%s", message);
    return strlen(message);
}

/* ---- Steps -------------------------------------------------------------------------------------------------- */

/* Copies looks and camera. */
static cgt_result begin(cgt_picture *p, const cgt_scene *scene, const cgt_camera *camera, const cgt_look *looks,
                        uint32_t count)
{
    p->state = NOTHING;
    if (!camera || (count && !looks))
        return fail(p, CGT_ERROR_INVALID_ARGUMENT, "a picture needs a camera, and looks if there is a count of them");
    const cgt_result result = cgt_looks_set(&p->looks, scene, looks, count, p->message, sizeof p->message);
    if (result != CGT_OK)
        return result;
    if (p->has_default_light)
        cgt_picture_set_default_light(&p->options, camera);
    drawing *const both[2] = {&p->front, &p->behind};
    for (int k = 0; k < 1 + has_layers(&p->options); k++) {
        cgt_camera seen = *camera;
        both[k]->looks = p->looks.look;
        both[k]->last_look = p->looks.count - 1;
        both[k]->has_triangles = both[k]->has_halves = 0;
        for (uint32_t i = 0; i < p->looks.count; i++) {
            both[k]->has_triangles |= p->looks.look[i].is_triangles;
            both[k]->has_halves |= p->looks.look[i].of.halves;
        }
        seen.mask = k ? p->options.style.behind_mask : camera->mask;
        cgt_draw_begin(both[k], &seen);
    }
    return CGT_OK;
}

static cgt_result trace_bounces(cgt_picture *p)
{
    const char *wrong;
    const cgt_result result = cgt_draw_bounces(&p->front, p->scene, &wrong);
    const cgt_result told = fail_drawing(p, result);
    return wrong ? fail(p, told, wrong) : told;
}

cgt_result cgt_picture_begin(cgt_picture *p, const cgt_scene *scene, const cgt_camera *camera, const cgt_look *looks,
                             uint32_t look_count, const cgt_trace_options *options)
{
    if (!p || p->failed)
        return CGT_ERROR_INVALID_ARGUMENT;
    if (!scene)
        return fail(p, CGT_ERROR_INVALID_ARGUMENT, "a picture needs a scene");
    cgt_result result = begin(p, scene, camera, looks, look_count);
    if (result != CGT_OK)
        return result;
    p->scene = scene;
    cgt_trace_options_init(&p->trace);
    if (options)
        p->trace = *options;
    p->state = SCENE;
    if (p->options.shading == CGT_SHADING_PLAIN)
        return CGT_OK;
    if (p->options.shading == CGT_SHADING_BOUNCES)
        return trace_bounces(p);
    if (has_layers(&p->options))
        result = cgt_draw_trace(&p->behind, scene, NULL);
    if (result == CGT_OK)
        result = cgt_draw_trace(&p->front, scene, options);
    return fail_drawing(p, result);
}

cgt_result cgt_picture_step(cgt_picture *p, uint32_t samples, uint32_t *left)
{
    cgt_result result = CGT_OK;
    if (!p || p->failed)
        return CGT_ERROR_INVALID_ARGUMENT;
    if (p->state != SCENE)
        return fail(p, CGT_ERROR_INVALID_ARGUMENT, "a picture takes steps after cgt_picture_begin");
    if (has_layers(&p->options))
        result = cgt_draw_step(&p->behind, p->scene, samples);
    if (result == CGT_OK)
        result = cgt_draw_step(&p->front, p->scene, samples);
    if (left)
        *left = cgt_draw_samples(&p->front) - p->front.samples;
    return fail_drawing(p, result);
}

cgt_result cgt_picture_read(cgt_picture *p, const cgt_image *image)
{
    if (!p || p->failed)
        return CGT_ERROR_INVALID_ARGUMENT;
    if (p->state != SCENE || !image)
        return fail(p, CGT_ERROR_INVALID_ARGUMENT, "a picture is read to an image, after cgt_picture_begin");
    cgt_result result = cgt_picture_check_image(image, &p->options, &p->front.image, p->message, sizeof p->message);
    if (result != CGT_OK)
        return result;
    result = p->options.shading == CGT_SHADING_PLAIN ? cgt_draw_tiles(&p->front, p->scene, &p->trace)
             : has_layers(&p->options)               ? cgt_draw_layers(&p->front, &p->behind)
                                                     : cgt_draw_shade(&p->front);
    return tell_drawing(p, result);
}

cgt_result cgt_picture_draw(cgt_picture *p, const cgt_scene *scene, const cgt_camera *camera, const cgt_look *looks,
                            uint32_t look_count, const cgt_image *image, const cgt_trace_options *options)
{
    cgt_result result = cgt_picture_begin(p, scene, camera, looks, look_count, options);
    if (result == CGT_OK)
        result = cgt_picture_step(p, UINT32_MAX, NULL);
    return result == CGT_OK ? cgt_picture_read(p, image) : result;
}

uint64_t cgt_picture_get_hits(const cgt_picture *p)
{
    return p ? atomic_load_explicit(&p->front.hits, memory_order_relaxed) : 0;
}

/* ---- Tiles from elsewhere ----------------------------------------------------------------------------------- */

cgt_result cgt_picture_begin_tiles(cgt_picture *p, const cgt_scene *scene, const cgt_camera *camera,
                                   const cgt_look *looks, uint32_t look_count, const cgt_image *image, uint32_t *fields)
{
    if (!p || p->failed)
        return CGT_ERROR_INVALID_ARGUMENT;
    if (p->options.shading != CGT_SHADING_PLAIN || !image)
        return fail(p, CGT_ERROR_INVALID_ARGUMENT, "tiles make pictures of plain shading, in an image");
    cgt_result result = begin(p, scene, camera, looks, look_count);
    if (result == CGT_OK)
        result = cgt_picture_check_image(image, &p->options, &p->front.image, p->message, sizeof p->message);
    if (result != CGT_OK)
        return result;
    atomic_store_explicit(&p->front.hits, 0, memory_order_relaxed);
    p->state = TILES;
    if (fields)
        *fields = cgt_draw_tile_fields(&p->front);
    return CGT_OK;
}

cgt_visit cgt_picture_visit_tile(void *picture, const cgt_tile *tile)
{
    cgt_picture *const p = picture;
    return p->state == TILES ? cgt_draw_tile(&p->front, tile) : CGT_VISIT_STOP;
}

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

enum { BAND_BYTES = 1 << 25, LEAST_BAND = 64 }; /* of planes; rows of pixels */

typedef enum picture_state { NOTHING = 0, TILES, SCENE, BANDS } picture_state; /* what has begun, or is complete */

struct cgt_picture {
    cgt_context *context;
    bool failed; /* its creation: all calls do */
    cgt_picture_options options;
    int has_default_light;
    srgb_table srgb;
    drawing opaque, layer[CGT_PICTURE_MAX_LAYERS], whole;
    picture_looks looks;
    picture_state state;
    const cgt_scene *scene;
    cgt_trace_options trace; /* of what is traced when it is read */
    char message[256];
};

static uint32_t layers_of(const cgt_picture_options *o)
{
    return o->shading == CGT_SHADING_FULL ? o->style.layer_count : 0;
}

/* The opaque drawing for 0, then the layers; each step is made of all of them. */
static drawing *part_of(cgt_picture *p, uint32_t k) { return k ? &p->layer[k - 1] : &p->opaque; }

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
        return fail(p, result, "out of memory for a picture");
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
               a->lighting.light_count == b->lighting.light_count && layers_of(a) == layers_of(b);
    for (uint32_t i = 0; i < a->lighting.light_count && same; i++)
        same = a->lighting.lights[i].shadows == b->lighting.lights[i].shadows &&
               draw_is_soft(&a->lighting.lights[i]) == draw_is_soft(&b->lighting.lights[i]);
    return same;
}

static void free_parts(cgt_picture *p)
{
    cgt_draw_free(&p->whole);
    for (uint32_t k = 0; k <= CGT_PICTURE_MAX_LAYERS; k++)
        cgt_draw_free(part_of(p, k));
}

static cgt_result make_planes(cgt_picture *p, const cgt_picture_options *checked)
{
    enum { WHOLE = 1 + CGT_PICTURE_MAX_LAYERS, PARTS };
    drawing next[PARTS] = {{.options = NULL}};
    for (uint32_t k = 0; k < PARTS; k++) {
        next[k] = (drawing){.options = checked, .srgb = &p->srgb, .context = p->context};
        next[k].antialias = k == WHOLE ? 1 : checked->antialias;
        next[k].keeps_whole = k == 0 && draw_keeps_whole(checked);
        if ((k == WHOLE ? !draw_keeps_whole(checked) : k > layers_of(checked)) || cgt_draw_init(&next[k]) == 0)
            continue;
        while (k-- > 0)
            cgt_draw_free(&next[k]);
        return CGT_ERROR_OUT_OF_MEMORY;
    }
    free_parts(p);
    for (uint32_t k = 0; k < WHOLE; k++)
        *part_of(p, k) = next[k];
    p->whole = next[WHOLE];
    return CGT_OK;
}

/* Of the options, whose rows may have changed. */
static void set_parts(cgt_picture *p)
{
    for (uint32_t k = 0; k <= layers_of(&p->options); k++)
        cgt_draw_set_options(part_of(p, k), &p->options);
    if (p->opaque.whole)
        cgt_draw_set_options(&p->whole, &p->options);
}

/* Makes planes, where they are not there already; what fails leaves the picture as it was. */
static cgt_result set_options(cgt_picture *p, cgt_picture_options *checked)
{
    const int has_default_light = cgt_picture_has_default_light(checked);
    if (has_default_light)
        cgt_picture_set_default_light(checked, NULL);
    if (!has_same_planes(&p->options, checked) && make_planes(p, checked))
        return CGT_ERROR_OUT_OF_MEMORY;
    p->options = *checked;
    p->has_default_light = has_default_light;
    p->state = NOTHING;
    p->opaque.whole = draw_has_whole(checked) ? &p->whole : NULL;
    set_parts(p);
    p->opaque.layer = p->layer;
    p->opaque.layers = layers_of(checked);
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
    return result == CGT_ERROR_OUT_OF_MEMORY ? fail(p, result, "out of memory for a picture") : result;
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
    free_parts(p);
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

static void begin_part(const cgt_picture *p, drawing *d, const cgt_camera *seen)
{
    d->looks = p->looks.look;
    d->last_look = p->looks.count - 1;
    d->has_triangles = d->has_halves = 0;
    for (uint32_t i = 0; i < p->looks.count; i++) {
        d->has_triangles |= p->looks.look[i].is_triangles;
        d->has_halves |= p->looks.look[i].of.halves;
    }
    d->light_mask = seen->mask;
    cgt_draw_begin(d, seen);
}

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
    const uint32_t layers = layers_of(&p->options);
    const cgt_picture_layer *const layer = p->options.style.layers;
    cgt_camera seen = *camera;
    for (uint32_t k = 0; k < layers; k++)
        seen.mask = (seen.mask ? seen.mask : UINT32_MAX) & ~layer[k].mask;
    if (layers && !seen.mask)
        return fail(p, CGT_ERROR_INVALID_ARGUMENT, "the mask of a picture's camera has bits of layers alone");
    for (uint32_t k = 0; k <= layers; k++) {
        drawing *const d = part_of(p, k);
        begin_part(p, d, &seen);
        d->behind = k ? &p->opaque : NULL;
        d->camera.mask = k ? layer[k - 1].mask & (camera->mask ? camera->mask : UINT32_MAX) : seen.mask;
    }
    if (p->opaque.whole)
        begin_part(p, &p->whole, &seen);
    return CGT_OK;
}

static cgt_result trace_bounces(cgt_picture *p)
{
    const char *wrong;
    const cgt_result result = cgt_draw_bounces(&p->opaque, p->scene, &p->trace, &wrong);
    const cgt_result told = fail_drawing(p, result);
    return wrong ? fail(p, told, wrong) : told;
}

/* Lets the planes begin at the rows that are traced, or at the first. */
static void move_planes(cgt_picture *p, bool at_rows)
{
    for (uint32_t k = 0; k <= layers_of(&p->options); k++)
        cgt_draw_move_planes(part_of(p, k), at_rows ? part_of(p, k)->first_ray_row : 0);
    if (p->opaque.whole)
        cgt_draw_move_planes(&p->whole, at_rows ? p->whole.first_ray_row : 0);
}

static cgt_result trace_parts(cgt_picture *p)
{
    const cgt_trace_options of_layers = {.precision = p->trace.precision}; /* statistics are of one call */
    cgt_result result = CGT_OK;
    for (uint32_t k = 0; k <= layers_of(&p->options) && result == CGT_OK; k++)
        result = cgt_draw_trace(part_of(p, k), p->scene, k ? &of_layers : &p->trace);
    return result == CGT_OK && p->opaque.whole ? cgt_draw_find_whole(&p->opaque) : result;
}

static cgt_result step_parts(cgt_picture *p, uint32_t samples)
{
    cgt_result result = CGT_OK;
    for (uint32_t k = 0; k <= layers_of(&p->options) && result == CGT_OK; k++)
        result = cgt_draw_step(part_of(p, k), p->scene, samples);
    return result;
}

static void set_trace(cgt_picture *p, const cgt_trace_options *options)
{
    cgt_trace_options_init(&p->trace);
    if (options)
        p->trace = *options;
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
    set_trace(p, options);
    p->state = SCENE;
    if (p->options.shading == CGT_SHADING_PLAIN)
        return CGT_OK;
    if (p->options.shading == CGT_SHADING_BOUNCES)
        return trace_bounces(p);
    move_planes(p, false);
    return fail_drawing(p, trace_parts(p));
}

cgt_result cgt_picture_step(cgt_picture *p, uint32_t samples, uint32_t *left)
{
    if (!p || p->failed)
        return CGT_ERROR_INVALID_ARGUMENT;
    if (p->state != SCENE && p->state != BANDS)
        return fail(p, CGT_ERROR_INVALID_ARGUMENT, "a picture takes steps after cgt_picture_begin");
    const cgt_result result = p->state == BANDS ? CGT_OK : step_parts(p, samples); /* bands have had all */
    if (left)
        *left = cgt_draw_samples(&p->opaque) - p->opaque.samples;
    return fail_drawing(p, result);
}

/* Rows of pixels whose planes are some 32 MB, the bands as even as can be. */
static uint32_t band_rows(cgt_picture *p)
{
    const uint32_t rows = p->options.work.row_count;
    size_t bytes = p->opaque.whole ? cgt_draw_row_bytes(&p->whole) : 0;
    for (uint32_t k = 0; k <= layers_of(&p->options); k++)
        bytes += cgt_draw_row_bytes(part_of(p, k));
    const size_t most = BAND_BYTES / bytes > LEAST_BAND ? BAND_BYTES / bytes : LEAST_BAND;
    const uint32_t bands = (uint32_t)((rows + most - 1) / most);
    return (rows + bands - 1) / bands;
}

/* Draws bands of rows one after the other, in the same memory. One band alone can be read again. */
static cgt_result draw_bands(cgt_picture *p)
{
    const cgt_picture_work work = p->options.work;
    const uint32_t band = band_rows(p);
    cgt_result result = CGT_OK;
    uint64_t hits = 0;
    for (uint32_t done = 0; done < work.row_count && result == CGT_OK; done += band) {
        p->options.work.first_row = work.first_row + done;
        p->options.work.row_count = work.row_count - done < band ? work.row_count - done : band;
        set_parts(p);
        move_planes(p, true);
        result = trace_parts(p);
        if (result == CGT_OK)
            result = step_parts(p, UINT32_MAX);
        if (result == CGT_OK)
            result = cgt_draw_shade(&p->opaque);
        hits += atomic_load_explicit(&p->opaque.hits, memory_order_relaxed);
    }
    p->options.work = work;
    set_parts(p);
    atomic_store_explicit(&p->opaque.hits, hits, memory_order_relaxed);
    p->state = band < work.row_count ? BANDS : SCENE;
    return fail_drawing(p, result);
}

cgt_result cgt_picture_read(cgt_picture *p, const cgt_image *image)
{
    if (!p || p->failed)
        return CGT_ERROR_INVALID_ARGUMENT;
    if ((p->state != SCENE && p->state != BANDS) || !image)
        return fail(p, CGT_ERROR_INVALID_ARGUMENT, "a picture is read to an image, after cgt_picture_begin");
    const cgt_result result =
        cgt_picture_check_image(image, &p->options, &p->opaque.image, p->message, sizeof p->message);
    if (result != CGT_OK)
        return result;
    if (p->state == BANDS)
        return draw_bands(p);
    return tell_drawing(p, p->options.shading == CGT_SHADING_PLAIN ? cgt_draw_tiles(&p->opaque, p->scene, &p->trace)
                                                                   : cgt_draw_shade(&p->opaque));
}

cgt_result cgt_picture_draw(cgt_picture *p, const cgt_scene *scene, const cgt_camera *camera, const cgt_look *looks,
                            uint32_t look_count, const cgt_image *image, const cgt_trace_options *options)
{
    const bool counts = options && (options->statistics || options->research); /* of one call */
    if (!p || p->failed || p->options.shading != CGT_SHADING_FULL || counts || !scene || !image) {
        cgt_result result = cgt_picture_begin(p, scene, camera, looks, look_count, options);
        if (result == CGT_OK)
            result = cgt_picture_step(p, UINT32_MAX, NULL);
        return result == CGT_OK ? cgt_picture_read(p, image) : result;
    }
    cgt_result result = begin(p, scene, camera, looks, look_count);
    if (result == CGT_OK)
        result = cgt_picture_check_image(image, &p->options, &p->opaque.image, p->message, sizeof p->message);
    if (result != CGT_OK)
        return result;
    p->scene = scene;
    set_trace(p, options);
    return draw_bands(p);
}

uint64_t cgt_picture_get_hits(const cgt_picture *p)
{
    return p ? atomic_load_explicit(&p->opaque.hits, memory_order_relaxed) : 0;
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
        result = cgt_picture_check_image(image, &p->options, &p->opaque.image, p->message, sizeof p->message);
    if (result != CGT_OK)
        return result;
    atomic_store_explicit(&p->opaque.hits, 0, memory_order_relaxed);
    p->state = TILES;
    if (fields)
        *fields = cgt_draw_tile_fields(&p->opaque);
    return CGT_OK;
}

cgt_visit cgt_picture_visit_tile(void *picture, const cgt_tile *tile)
{
    cgt_picture *const p = picture;
    return p->state == TILES ? cgt_draw_tile(&p->opaque, tile) : CGT_VISIT_STOP;
}

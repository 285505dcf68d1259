/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The inside of a picture (cgt/picture.h): the camera's frame is traced to planes, lights are asked for what they
 * reach, and then the rows of the picture are shaded. What the options leave out costs nothing. With CGT_SHADING_PLAIN
 * tiles are shaded while their hits are in cache, and there are no planes (draw_tiles.c). */
#ifndef DRAW_H
#define DRAW_H

#include <stdatomic.h>
#include <stdint.h>

#include <cgt/picture.h>

#include "color/srgb.h"
#include "draw/look.h"

typedef struct drawing drawing;
struct drawing {
    const cgt_picture_options *options; /* with the defaults in place of zeros, directions of unit length */
    const srgb_table *srgb;
    cgt_context *context;      /* whose threads shade */
    const picture_look *looks; /* of geometry 0, 1, ...; the last one of all others */
    uint32_t last_look;
    int has_triangles, has_halves; /* one of the looks is that of triangles; of capsules with two colours */
    cgt_camera camera;
    cgt_image image;           /* that is made; row_stride and channels are set */
    atomic_uint_fast64_t hits; /* rays of it with a hit */
    /* The frame's planes, of width * antialias by height * antialias rays. */
    uint32_t antialias; /* of the options; 1 of whole pixels */
    uint32_t ray_width, ray_height;
    uint32_t first_plane_row;            /* at which the planes' memory begins: above it they have none */
    uint32_t first_ray_row, ray_rows;    /* that are traced: those of the picture's rows, and what these look at */
    float share;                         /* of a ray in its pixel */
    void *memory, *uv_memory, *more_sky; /* of all planes; of u and v, from the first frame with triangles on; of a
                                             step's sky, from the first step that is not the only one on */
    uint32_t ambient, light_samples;     /* rays of each ray to the sky and to soft lights, once the picture is whole */
    uint32_t samples;                    /* of these, traced so far */
    float *t, *normal[3], *u, *v;
    float (*light)[3]; /* of rays that bounce, in place of all but t, primitive and geometry */
    uint32_t *primitive, *geometry;
    float *sky, *sky_plane;                       /* share of the sky that the ray's hit sees; NULL: all of it */
    float *reach[CGT_PICTURE_MAX_LIGHTS];         /* share of a soft light that arrives there; NULL: all of it */
    float *reach_plane[CGT_PICTURE_MAX_LIGHTS];   /* these two are planes, those NULL before the first step */
    uint8_t *occluded[CGT_PICTURE_MAX_LIGHTS];    /* of a hard light: 1 where it does not arrive; NULL: it does */
    float right[3], up[3], forward[3], origin[3]; /* of the camera: ray = origin or forward, plus shares of right, up */
    /* Whole pixels go on as one ray each, in a frame of their own, and `rest` has the primitives of the other rays; see
     * draw_whole.c. NULL: there are none. */
    drawing *whole;
    int keeps_whole; /* there are planes for them */
    uint32_t *rest_plane;
    /* What is transparent has planes of its own, where it is nearer than what is opaque; else its rays hit nothing. */
    drawing *layer; /* of the opaque one */
    uint32_t layers;
    const drawing *behind; /* of a layer: the opaque one */
    uint32_t light_mask;   /* of rays to lights and the sky: what casts shadows */
};

/* Makes the planes; options and srgb are set, context before it shades, the rest is zero. Returns 0, or -1 where memory
 * is missing. */
int cgt_draw_init(drawing *d);

/* Sets the options, whose planes must be those of the last, and the rows of rays. */
void cgt_draw_set_options(drawing *d, const cgt_picture_options *options);
void cgt_draw_free(drawing *d);

/* Bytes of planes for each row of pixels; lets the planes' memory begin at a row of rays, so that a picture may be made
 * by bands of rows in the same small part of it, which stays in the caches and takes few pages. */
size_t cgt_draw_row_bytes(const drawing *d);
void cgt_draw_move_planes(drawing *d, uint32_t first_row);

/* The rays of a frame, before its planes or tiles are traced. */
void cgt_draw_begin(drawing *d, const cgt_camera *camera);

/* Traces the camera's rays and hard shadows to the planes; then `samples` more rays to the sky and to soft lights. */
cgt_result cgt_draw_trace(drawing *d, const cgt_scene *scene, const cgt_trace_options *options);
cgt_result cgt_draw_step(drawing *d, const cgt_scene *scene, uint32_t samples);
uint32_t cgt_draw_samples(const drawing *d); /* of the whole picture */

/* Makes the pixels of d->image from the planes. */
cgt_result cgt_draw_shade(drawing *d);

/* The same without planes. */
cgt_result cgt_draw_tiles(drawing *d, const cgt_scene *scene, const cgt_trace_options *options);

/* The camera with the library's defaults in place of an eye and an up of zeros. */
cgt_camera cgt_draw_default_view(const cgt_camera *camera);

/* Makes a vector of any length a unit one; 0, 0, 0 stays. */
void cgt_draw_normalize(float v[3]);

/* A camera's unit vectors to the right and up, scaled to half a picture, and along its axis. */
void cgt_draw_half_picture(const cgt_camera *camera, float aspect, float right[3], float up[3], float forward[3]);

/* ---- The steps, in files of their own ----------------------------------------------------------------------- */

static inline bool draw_is_stopped(const drawing *d)
{
    return d->options->work.stop && d->options->work.stop(d->options->work.stop_user);
}

static inline int draw_is_soft(const cgt_picture_light *light) { return light->shadows && light->size > 0.0f; }

/* draw.c: the planes of hits that there are as a frame's, with the rows that are traced. */
cgt_frame cgt_draw_frame(const drawing *d);

/* The same: nothing of the sky and soft lights is traced yet. */
void cgt_draw_forget_light(drawing *d);

/* The same: planes of u and v. Returns 0, or -1 where memory is missing. */
int cgt_draw_make_uv(drawing *d);

/* draw_whole.c: whether a picture of these options has planes for whole pixels, and whether there are any: outlines
 * want every ray. How many rays to the sky or to a light such a pixel takes for one of another ray. */
static inline int draw_keeps_whole(const cgt_picture_options *o)
{
    return o->shading == CGT_SHADING_FULL && o->antialias > 1;
}
static inline int draw_has_whole(const cgt_picture_options *o)
{
    return draw_keeps_whole(o) && !(o->style.outline > 0.0f);
}
static inline const uint32_t *draw_rest(const drawing *d) { return d->whole ? d->rest_plane : d->primitive; }
static inline uint32_t draw_whole_rays(const cgt_picture_options *o)
{
    /* of sixteen rays half as many more, since theirs began at places of their own */
    return o->antialias == 2 ? 4 : 24;
}

/* The same: finds them after the camera's rays and hard lights, those of layers, too; lays what they see on their rays,
 * after each step. */
cgt_result cgt_draw_find_whole(drawing *d);
cgt_result cgt_draw_spread_whole(drawing *d);

/* draw_light.c: hard lights; more rays to the sky and to soft lights. */
cgt_result cgt_draw_trace_hard_lights(drawing *d, const cgt_scene *scene);
cgt_result cgt_draw_trace_sky(drawing *d, const cgt_scene *scene, uint32_t samples);
cgt_result cgt_draw_trace_soft_light(drawing *d, const cgt_scene *scene, uint32_t light, uint32_t samples);

/* draw_smooth.c: of `count` rays from (x, y) on, at most DRAW_BLOCK, what is sampled with few rays, averaged with their
 * neighbours: first the sky where there is one, then each soft light. Those of rays without a hit are undefined. */
enum { DRAW_NEIGHBOURS = 2 }; /* rows of pixels above and below that these are in, at most */
enum { DRAW_BLOCK = 128, DRAW_PAD = 4, DRAW_SMOOTHED = 1 + CGT_PICTURE_MAX_LIGHTS };
typedef struct draw_means {
    float mean[DRAW_SMOOTHED][DRAW_BLOCK + DRAW_PAD]; /* whole vectors are stored */
} draw_means;
void cgt_draw_smooth(const drawing *d, uint32_t x, uint32_t y, uint32_t count, draw_means *means);

/* draw_layers.c: of a layer, drops the hits that lie behind what is opaque. */
cgt_result cgt_draw_hide_layer(drawing *d);

/* What the eye gets along a ray. */
typedef struct draw_ray_light {
    float color[3], cover; /* how much of the background that covers, by which the colour is multiplied */
    float depth;           /* of the nearest hit, +infinity: none; id: what it is on */
    uint32_t id;
} draw_ray_light;

/* The same: lays the layers over what is opaque along `count` rays of a row, from (x, y) on, at most DRAW_BLOCK. */
void cgt_draw_mix_layers(const drawing *d, uint32_t x, uint32_t y, uint32_t count, draw_ray_light *light);

/* draw_shade.c: the light of `count` rays of a row, from (x, y) on, at most DRAW_BLOCK; cover 0: a ray has no hit. */
void cgt_draw_shade_rays(const drawing *d, uint32_t x, uint32_t y, uint32_t count, draw_ray_light *light);

/* draw_tiles.c: the fields of a tile that the visitor reads, whose user is the drawing. */
uint32_t cgt_draw_tile_fields(const drawing *d);
cgt_visit cgt_draw_tile(void *user, const cgt_tile *tile);

/* draw_shade.c: from the planes to row y of the picture. Returns the number of rays with a hit. */
uint32_t cgt_draw_shade_row(const drawing *d, uint32_t y);

/* draw_bounce.c: the same from the light of rays that bounce; and that light. *wrong gets a sentence, or NULL. */
uint32_t cgt_draw_bounced_row(const drawing *d, uint32_t y);
cgt_result cgt_draw_bounces(drawing *d, const cgt_scene *scene, const cgt_trace_options *options, const char **wrong);

/* draw_outline.c: how dark the outline at a ray is, 0 to 1. */
float cgt_draw_outline_at(const drawing *d, uint32_t x, uint32_t y);

static inline const picture_look *draw_look(const drawing *d, uint32_t geometry)
{
    return &d->looks[geometry < d->last_look ? geometry : d->last_look];
}

/* Origin and direction of a ray of the frame; dir has length 1 along the camera's axis. */
static inline void draw_ray(const drawing *d, uint32_t x, uint32_t y, float org[3], float dir[3])
{
    const float s = 2.0f * ((float)x + 0.5f) / (float)d->ray_width - 1.0f;
    const float r = 1.0f - 2.0f * ((float)y + 0.5f) / (float)d->ray_height;
    const int perspective = d->camera.projection == CGT_PROJECTION_PERSPECTIVE;
    for (int c = 0; c < 3; c++) {
        const float aside = s * d->right[c] + r * d->up[c];
        org[c] = perspective ? d->origin[c] : d->origin[c] + aside;
        dir[c] = perspective ? d->forward[c] + aside : d->forward[c];
    }
}

#endif

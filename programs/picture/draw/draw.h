/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From a committed scene to a picture: ambient occlusion, shadows of several lights, outlines, depth cue, any number of
 * geometries, one of which may be transparent. The camera's frame is traced to planes, lights are asked for what they
 * reach, and then the rows of the picture are shaded. What the settings leave out costs nothing. Where a headlight and
 * one light without shadows are all, tiles are shaded while their hits are in cache, and there are no planes
 * (draw_tiles.c). The same bytes come from any number of threads and any variant: each pixel's sample directions depend
 * on its place in the picture alone, neither on time nor on chance, so that what stands still looks the same in all
 * frames. */
#ifndef DRAW_H
#define DRAW_H

#include <stdatomic.h>
#include <stdint.h>

#include <cgt/cgt.h>

#include "common/stop_flag.h"
#include "picture/files/image_write.h"
#include "picture/color/srgb.h"
#include "picture/draw/surface.h"

enum { DRAW_MAX_LIGHTS = 8, DRAW_MAX_SURFACES = 8, DRAW_MAX_SAMPLES = 256 };

typedef struct draw_light {
    cgt_light light; /* a direction: of unit length */
    float color[3];  /* linear, times the light's strength. A lamp does not weaken with distance */
    int shadows;     /* 0: it shines through everything */
    float size;      /* of soft shadows: radius of a lamp in world units, of a direction's cone in degrees; 0: hard */
} draw_light;

typedef struct draw_settings {
    int tiles; /* 1: only the first light's direction, background and sizes count, the light has no shadows,
                               and one geometry is drawn */
    uint32_t width, height; /* pixels */
    uint32_t samples;       /* rays of a pixel along each edge: 1, 2 or 4 */
    uint32_t ambient;       /* rays of a pixel to the sky, up to DRAW_MAX_SAMPLES; 0: no ambient occlusion */
    float ambient_radius;   /* world units; what is farther off does not occlude; 0: any distance */
    uint32_t light_samples; /* rays of a pixel to each light with a size, up to DRAW_MAX_SAMPLES; 1 or more */
    uint32_t light_count;
    draw_light lights[DRAW_MAX_LIGHTS];
    float sky;               /* share of light from all sides, which ambient occlusion dims */
    float head;              /* of light from the eye */
    float background[3];     /* linear */
    int transparent;         /* 1: colours of pixels with a hit leave the background out, for an alpha plane */
    float cue;               /* 0 to 1: how much of the farthest point's colour becomes the background's */
    float cue_near, cue_far; /* depths along the camera's axis between which that grows; near < far */
    float outline;           /* width of outlines in pixels; 0: none */
    float outline_color[3];  /* linear */
    float front;             /* opacity of what `behind` leaves out; a frame is then drawn without it, too. 0: opaque */
    uint32_t behind;         /* mask of the camera that draws what is behind it */
    uint32_t threads;        /* 1 or more */
    const stop_flag *stop;   /* not 0: stop the frame; NULL: never */
} draw_settings;

typedef struct drawing {
    draw_settings settings;
    surface surfaces[DRAW_MAX_SURFACES]; /* by the ids of the scene's geometries */
    cgt_camera camera;                   /* of the frame */
    uint8_t *rgb;              /* 3 * width * height: sRGB, not premultiplied; the caller's, and the next two */
    uint8_t *alpha;            /* width * height: share of rays with a hit; NULL: not wanted */
    image_pixel *pixels;       /* width * height, linear; NULL: not wanted */
    atomic_uint_fast64_t hits; /* rays of the last frame */
    const srgb_tables *tables;
    /* The frame's planes, of width * samples by height * samples rays. */
    uint32_t ray_width, ray_height;
    float share;              /* of a ray in its pixel */
    void *memory, *uv_memory; /* of all planes; of u and v, which the first frame with triangles makes */
    void *behind;             /* a picture without what is in front, where that is transparent */
    float *t, *normal[3], *u, *v;
    uint32_t *primitive, *geometry;
    float *sky;                                   /* share of the sky that the ray's hit sees; NULL: not asked for */
    float *reach[DRAW_MAX_LIGHTS];                /* share of a soft light that arrives there; NULL: all of it */
    uint8_t *occluded[DRAW_MAX_LIGHTS];           /* of a hard light: 1 where it does not arrive; NULL: it does */
    float right[3], up[3], forward[3], origin[3]; /* of the camera: ray = origin or forward, plus shares of right, up */
} drawing;

/* Makes the planes for the settings; drawing is zero. Returns 0, or -1 where memory is missing or a size would
 * overflow. Tiles need none. Else a ray takes 24 bytes, 8 more from the first frame with triangles on, 4 with ambient
 * occlusion, 1 for each hard light with shadows, and 4 for each soft one. */
int draw_init(drawing *d, const draw_settings *settings, const srgb_tables *tables);
void draw_free(drawing *d);

/* Draws a committed scene into rgb, alpha and pixels. Surfaces are set for each of its geometries. Errors are the
 * library's, CGT_ERROR_STOPPED where *stop became other than 0. options: of the camera's frame. */
cgt_result draw_frame(drawing *d, const cgt_scene *scene, const cgt_camera *camera, const cgt_trace_options *options);

/* The parts of that where tiles come from elsewhere: before the first, and the visitor, whose user is the drawing. */
void draw_begin(drawing *d, const cgt_camera *camera);
cgt_visit draw_tile(void *user, const cgt_tile *tile);

/* A camera's unit vectors to the right, up, and along its axis; those to the right and up scaled to half a picture. */
void draw_camera_axes(const cgt_camera *camera, float right[3], float up[3], float forward[3]);
void draw_half_picture(const cgt_camera *camera, float aspect, float right[3], float up[3], float forward[3]);

/* ---- The steps, in files of their own ----------------------------------------------------------------------- */

/* draw_light.c: fills sky and reach. */
cgt_result draw_trace_lights(drawing *d, const cgt_scene *scene);

/* draw_smooth.c: of `count` rays from (x, y) on, at most DRAW_BLOCK, what is sampled with few rays, averaged with their
 * neighbours: first the sky where there is one, then each soft light. Those of rays without a hit are undefined. */
enum { DRAW_BLOCK = 128, DRAW_SMOOTHED = 1 + DRAW_MAX_LIGHTS };
typedef struct draw_means {
    float mean[DRAW_SMOOTHED][DRAW_BLOCK];
} draw_means;
void draw_smooth(const drawing *d, uint32_t x, uint32_t y, uint32_t count, draw_means *means);

/* draw_tiles.c: the fields of a tile that draw_tile reads. */
uint32_t draw_tile_fields(const drawing *d);

/* draw_layers.c: a frame with something transparent in front. */
cgt_result draw_layers(drawing *d, const cgt_scene *scene, const cgt_camera *camera, const cgt_trace_options *options);

/* draw.c: a frame by planes. */
cgt_result draw_planes(drawing *d, const cgt_scene *scene, const cgt_camera *camera, const cgt_trace_options *options);

/* draw_shade.c: from the planes to row y of the picture. Returns the number of rays with a hit. */
uint32_t draw_shade_row(const drawing *d, uint32_t y);

/* draw_outline.c: how dark the outline at a ray is, 0 to 1. */
float draw_outline_at(const drawing *d, uint32_t x, uint32_t y);

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

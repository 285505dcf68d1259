/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * libcgt-picture: from a committed scene to the pixels of a picture. The conventions are those of cgt.h. In outline:
 *
 *   const cgt_picture_options options = {.width = 1280, .height = 720};
 *   const cgt_look look = {.color = {0.8f, 0.4f, 0.1f}};      of geometry 0
 *   const cgt_image image = {.bytes = rgb};         3 * 1280 * 720 bytes
 *   cgt_picture_create(context, &options, &picture);
 *   cgt_picture_draw(picture, scene, &camera, &look, 1, &image, NULL);
 *
 * Progressive, for a window: the camera's rays once, then more and more of those to the sky and to soft lights, with a
 * picture whenever one is wanted:
 *
 *   cgt_picture_begin(picture, scene, &camera, &look, 1, NULL);
 *   for (uint32_t left = 1; left;) {
 *       cgt_picture_step(picture, 1, &left);
 *       cgt_picture_read(picture, &image);
 *   }
 *
 * After the last step the image has, byte for byte, what cgt_picture_draw gives, and what cgt-render writes with the
 * same settings. The bytes are the same for any number of threads and any variant: the directions of a pixel's rays
 * depend on its place in the picture alone, neither on time nor on chance, so that what stands still looks the same in
 * all frames.
 *
 * Colours are linear shares of red, green and blue unless a text says sRGB (<cgt/color.h>). Lengths are world units. */
#ifndef CGT_PICTURE_H
#define CGT_PICTURE_H

#include <cgt/cgt.h>
#include <cgt/color.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- What primitives look like ------------------------------------------------------------------------------ */

/* The look of a geometry of the scene, in the caller's arrays, which must stay until the picture is read. So must the
 * indices of triangles that the scene has, with per_vertex or vertex_normals; and with CGT_SHADING_BOUNCES all arrays
 * of the geometry. A colour comes from `index` and `palette`, else from `colors`, else it is `color`. */
typedef struct cgt_look {
    float color[3];        /* of all; 0, 0, 0 (default): a light grey */
    const float *colors;   /* three floats a primitive, or a vertex; NULL (default): none */
    const uint16_t *index; /* entry of the palette, of each primitive or vertex; NULL (default): none */
    const float *palette;  /* three floats an entry; goes with index */
    /* Triangles: colors or index have an element a vertex, interpolated over each triangle; with CGT_SHADING_BOUNCES
     * it has the colour of its first vertex. */
    bool per_vertex;
    bool halves; /* capsules: colors or index have two elements each, of the half near either end */
    /* `index` with per_vertex: entries below it are one row of colours, along which a hit's entry is interpolated; a
     * hit on a triangle with another entry takes that one. */
    uint32_t palette_steps;
    /* Triangles: three floats a vertex, of any length; NULL (default), or CGT_SHADING_BOUNCES: triangles are flat.
     * Light is that of the side which the eye sees. */
    const float *vertex_normals;
    const uint32_t *ids; /* number of each primitive for cgt_linear_pixel; NULL (default): its index */
    /* 1 + the first primitive without outlines, which all behind it lack, too; 0 (default): all have outlines. */
    uint32_t lineless_from;
    /* CGT_SHADING_BOUNCES, of spheres and triangles: of floats at multiples of 4, without origin and types. */
    uint8_t material;         /* of all: its number in cgt_picture_bounces.materials */
    const uint8_t *materials; /* of each primitive; NULL (default): `material` */
    const uint32_t *bodies;   /* triangles of glass: what cgt_find_bodies has found; NULL (default): one body */
    bool sheet;               /* opaque triangles that are not closed: both sides are surfaces */
} cgt_look;

typedef enum cgt_material_kind { CGT_MATERIAL_MATTE = 0, CGT_MATERIAL_MIRROR, CGT_MATERIAL_GLASS } cgt_material_kind;

typedef struct cgt_material {
    cgt_material_kind kind;
    float color[3];      /* MIRROR: share of the light that is reflected, 0 to 1. MATTE has the look's colour, 0 to 1 */
    float index;         /* GLASS: of refraction, 1 to 100 */
    float absorption[3]; /* GLASS: light over a length is multiplied by exp(-absorption * length); 0 or more */
    uint8_t priority;    /* GLASS: where bodies overlap, the one of the highest fills the place */
    float gloss;         /* exponent of the lights' highlights (Blinn), at most 1e6; 0 (default): none */
} cgt_material;

/* Finds which bodies the triangles of a mesh close in: what glass needs. Vertices at the same place are one, whatever
 * their index, and triangles that share one belong to one body. A body is closed if each of its edges is used as often
 * one way as the other. Triangles without area count like others. Takes O(n log n).
 *   indices            three vertices for each of `count` triangles; below vertex_count
 *   vertices           x, y, z of each vertex
 *   body               gets the number of each triangle's body, from 0 on in the order of their first triangles
 *   bodies             gets how many there are
 *   wrong              gets what INVALID_ARGUMENT means: the triangle and the two vertices of an edge that has no other
 *                      side, or one that is turned inside out (body and bodies are set); or a triangle with an index
 *                      that is too large, and CGT_INVALID_ID twice
 * Errors: INVALID_ARGUMENT, TOO_LARGE (2^32 / 3 triangles), OUT_OF_MEMORY */
CGT_API cgt_result cgt_find_bodies(const uint32_t *indices, uint32_t count, const float *vertices,
                                   uint32_t vertex_count, uint32_t *body, uint32_t *bodies, uint32_t wrong[3]);

/* ---- How a picture is made ---------------------------------------------------------------------------------- */

enum {
    CGT_PICTURE_MAX_LIGHTS = 8,
    CGT_PICTURE_MAX_LAYERS = 8,
    CGT_PICTURE_MAX_RAYS = 256,
    CGT_PICTURE_MAX_BOUNCES = 64
};

typedef enum cgt_shading {
    /* One directional light without shadows, lights[0], whose direction alone counts, at 0.85; a headlight at 0.35;
     * 0.05 from all sides. No shadows, ambient occlusion, outlines, depth cue or opacity. Tiles are shaded while
     * their hits are in cache: the fastest. */
    CGT_SHADING_PLAIN = 0,
    CGT_SHADING_FULL, /* all of cgt_picture_options but bounces */
    /* Mirrors and glass by Whitted's method: lights with hard shadows, sky, background, transparent, and
     * cgt_picture_bounces. Nothing is progressive. */
    CGT_SHADING_BOUNCES
} cgt_shading;

/* A light. It does not fade with distance. */
typedef struct cgt_picture_light {
    cgt_light light; /* a direction may have any length but 0 */
    float color[3];  /* brightness of a white surface that faces it, 0 or more */
    bool shadows;    /* false (default): it shines through everything, but with CGT_SHADING_BOUNCES */
    /* Of soft shadows: radius of a lamp; of a direction's cone in degrees, at most 89; 0 (default): hard ones. */
    float size;
} cgt_picture_light;

/* What lights a picture. If light_count, sky and head are 0, or shading is plain and light_count is: the light of
 * cgt_camera_get_key_light, else of 0.62, with shadows, sky 0.36, head 0.1. */
typedef struct cgt_picture_lighting {
    uint32_t light_count; /* at most CGT_PICTURE_MAX_LIGHTS */
    cgt_picture_light lights[CGT_PICTURE_MAX_LIGHTS];
    float sky; /* light from all sides, which ambient occlusion dims: 0 or more */
    /* Light from the eye, without shadows; of it, too, ambient occlusion takes up to 0.6: 0 or more. */
    float head;
    /* Rays of a pixel to the sky, at most CGT_PICTURE_MAX_RAYS; 0 (default): no ambient occlusion. The rays of
     * antialiasing share them, rounded up: each has one at least. With antialias 4, pixels that go on as one ray take
     * half as many more. */
    uint32_t ambient;
    float ambient_radius; /* what is farther off does not occlude; 0 (default): +infinity */
    /* Rays of a pixel to each light with a size, shared in the same way; as many at most; 0 (default): 8. */
    uint32_t light_samples;
} cgt_picture_lighting;

/* Geometries that are seen through: a skin, of which the eye sees the nearest side alone, however many surfaces of it
 * lie behind that. */
typedef struct cgt_picture_layer {
    /* Geometries whose mask has one of these bits are in the layer; those of no layer have none of them. */
    uint32_t mask;
    float opacity; /* how much of what is behind it covers; 0 (default): 1 */
} cgt_picture_layer;

/* What is drawn besides light on surfaces. */
typedef struct cgt_picture_style {
    float background[3];
    bool transparent;   /* colours of pixels leave the background out, for an image with opacity */
    float cue;          /* depth cue, 0 (default) to 1: how much of the farthest colours becomes the background's */
    float cue_range[2]; /* depths along the camera's axis between which that grows; the first below the second */
    float outline;      /* width of outlines in pixels; 0 (default): none */
    float outline_color[3];
    /* What is transparent, at most CGT_PICTURE_MAX_LAYERS; 0 (default): nothing. Each is traced by itself, and mixed
     * with what is behind it, ray by ray and in linear light. Layers cast no shadows and occlude nothing, but get the
     * shadows of what is opaque. */
    uint32_t layer_count;
    cgt_picture_layer layers[CGT_PICTURE_MAX_LAYERS];
} cgt_picture_style;

/* CGT_SHADING_BOUNCES. Surfaces of glass and mirrors see a sky whose horizon is the background, which turns bluish and
 * darker towards `up`. */
typedef struct cgt_picture_bounces {
    uint32_t limit; /* reflections and refractions of a path, at most CGT_PICTURE_MAX_BOUNCES; 0 (default): none */
    uint32_t material_count;       /* at most 256; 0 (default): there is one, which is matt */
    const cgt_material *materials; /* must outlive the picture, and may change before it begins */
    uint32_t shadow_mask;          /* mask of geometries that cast shadows; 0 (default): all */
    uint32_t glass_mask; /* of those that cast light shadows, which leave 0.6 of the light; 0 (default): none */
    float up[3];         /* 0, 0, 0 (default): (0, 1, 0) */
} cgt_picture_bounces;

/* What part of a picture is made, and by whom. */
typedef struct cgt_picture_work {
    /* Rows of the picture that are made, with the bytes that they have in the whole, such as one machine's share; all
     * other pixels stay. row_count 0 (default): all from first_row on. */
    uint32_t first_row, row_count;
    /* Asked by any thread, often: true ends the call with STOPPED. NULL (default): none. */
    bool (*stop)(const void *user);
    const void *stop_user; /* passed to stop */
} cgt_picture_work;

typedef struct cgt_picture_options {
    uint32_t width, height; /* pixels, each times antialias at most 65,536; 0 (default): 1280, 720 */
    uint32_t antialias;     /* rays of a pixel along each edge: 1, 2 or 4; 0 (default): 1 */
    cgt_shading shading;
    cgt_picture_lighting lighting;
    cgt_picture_style style;
    cgt_picture_bounces bounces;
    cgt_picture_work work;
} cgt_picture_options;

/* Fills in the defaults. */
CGT_API void cgt_picture_options_init(cgt_picture_options *options);

/* ---- Pixels ------------------------------------------------------------------------------------------------- */

/* A pixel in linear light. With cgt_picture_style.transparent colours are premultiplied and leave out the background,
 * else opacity is 1. */
typedef struct cgt_linear_pixel {
    float r, g, b;
    float depth; /* of the nearest of the pixel's hits, along the camera's axis; +infinity: none */
    uint32_t id; /* of that hit's primitive: see cgt_look.ids; CGT_INVALID_ID: none */
    float a;     /* opacity: the share of the pixel's rays with a hit; of layers their opacity counts */
} cgt_linear_pixel;

/* Where pixels go: the caller's memory, first row at the top. */
typedef struct cgt_image {
    uint8_t *bytes;    /* sRGB, not premultiplied: red, green, blue, and opacity if channels is 4; NULL: not wanted */
    uint32_t channels; /* 3 or 4; 0 (default): 3 */
    size_t row_stride; /* bytes from one row of `bytes` to the next; 0 (default): width * channels */
    uint8_t *alpha;    /* width * height bytes: opacity in a plane of its own; NULL: not wanted */
    cgt_linear_pixel *linear; /* width * height; NULL: not wanted */
    float dpi;                /* pixels to an inch, as a file tells them, up to 10^6; 0 (default): it does not */
} cgt_image;

/* Writes an image's bytes to a PNG file.
 * Errors: INVALID_ARGUMENT (there are no bytes, or 2^30 or more; row_stride is less than a row), OUT_OF_MEMORY, FILE
 *         (errno tells why) */
CGT_API cgt_result cgt_write_png(const char *path, const cgt_image *image, uint32_t width, uint32_t height);

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

typedef struct cgt_picture cgt_picture;

/* Creates a picture.
 *   context   where its scenes are from; must outlive it
 *   options   NULL: the defaults; copied
 *   picture   gets the picture; on an error, one that has the message, or NULL if there is no memory even for that
 * Memory:  the C library's. PLAIN: 10 KB. BOUNCES: 24 bytes a ray, and 3.3 MB + 1.4 MB * (bounces + 1) for each thread
 *          while it traces. Else 24 bytes a ray (a pixel has antialias * antialias), 8 more from the first picture
 *          with triangles, 4 with ambient occlusion, 8 after two steps of it, 1 for each hard light with shadows, 4 for
 *          each soft one, all of it again for each layer; with antialiasing 4 more, and as much as a ray for each
 *          pixel; during a step with soft lights 600 bytes for each ray of a row, times its samples
 * Threads: one at a time uses a picture; several pictures may be made of one scene at once
 * Errors:  INVALID_ARGUMENT, OUT_OF_MEMORY, TOO_LARGE */
CGT_API cgt_result cgt_picture_create(cgt_context *context, const cgt_picture_options *options, cgt_picture **picture);

/* Releases a picture; NULL does nothing. */
CGT_API void cgt_picture_release(cgt_picture *picture);

/* Sets other options, without allocation if size, antialiasing, shading and the kinds of lights stay. The picture must
 * begin anew. Errors as cgt_picture_create; they leave the picture as it was. */
CGT_API cgt_result cgt_picture_set_options(cgt_picture *picture, const cgt_picture_options *options);

/* Copies the message of the last call that failed on this picture, as cgt_context_get_error_message does. */
CGT_API size_t cgt_picture_get_error_message(const cgt_picture *picture, char *text, size_t size);

/* Makes a whole picture: begin, all steps, read. Arguments and errors are theirs. With CGT_SHADING_FULL and without
 * statistics large ones are drawn by bands of rows, which touch some 32 MB of the memory; to read such a picture once
 * more draws it once more, for which the scene must stay committed. */
CGT_API cgt_result cgt_picture_draw(cgt_picture *picture, const cgt_scene *scene, const cgt_camera *camera,
                                    const cgt_look *looks, uint32_t look_count, const cgt_image *image,
                                    const cgt_trace_options *options);

/* Begins a picture: traces the camera's rays and hard shadows. PLAIN traces nothing before the picture is read.
 *   scene       committed; must stay so until the last step, PLAIN: until the picture is read
 *   camera      copied
 *   looks       copied, not the arrays that they name: of geometry 0, 1, and so on
 *   look_count  geometries from here on have the default look, {0}
 *   options     of the camera's rays; NULL: the defaults. Statistics are of what is opaque, and must outlive the last
 *               read of PLAIN
 * Building: as cgt_occluded_frame with shadows, as cgt_trace_camera without
 * Errors:   as cgt_trace_camera; STOPPED; OUT_OF_MEMORY; INVALID_ARGUMENT. There is nothing to read then */
CGT_API cgt_result cgt_picture_begin(cgt_picture *picture, const cgt_scene *scene, const cgt_camera *camera,
                                     const cgt_look *looks, uint32_t look_count, const cgt_trace_options *options);

/* Traces more rays to the sky and to lights with a size.
 *   samples   rays from each ray's hit, to each of them; UINT32_MAX: all that are left
 *   left      gets how many are left, 0: the picture is complete. NULL: not wanted. The whole is the larger of
 *             `ambient` and, if a light has a size and shadows, `light_samples`, over antialias squared, rounded up;
 *             0 if the picture has neither
 * Building: may build a BVH in the scene
 * Errors:   as cgt_ambient_occlusion and cgt_occluded_rays; STOPPED; INVALID_ARGUMENT if nothing has begun. The picture
 *           must begin anew then */
CGT_API cgt_result cgt_picture_step(cgt_picture *picture, uint32_t samples, uint32_t *left);

/* Makes pixels from what is traced so far: before the first step everything sees the whole sky and all of each soft
 * light.
 *   image   gets the pixels
 * Errors: INVALID_ARGUMENT if nothing has begun or image is wrong; STOPPED, which leaves pixels undefined; PLAIN: as
 *         cgt_trace_camera */
CGT_API cgt_result cgt_picture_read(cgt_picture *picture, const cgt_image *image);

/* Returns how many of the camera's rays hit something in the picture that was read last. */
CGT_API uint64_t cgt_picture_get_hits(const cgt_picture *picture);

/* ---- Cameras ------------------------------------------------------------------------------------------------ */

/* Gets a camera's unit vectors to the right, up, and along its axis. In this and the calls below zeros stand for the
 * defaults of cgt_camera. */
CGT_API void cgt_camera_get_axes(const cgt_camera *camera, float right[3], float up[3], float forward[3]);

/* Gets the direction towards a light over the camera's left shoulder, not of unit length.
 *   width, height   pixels of the picture, on which the last bits depend */
CGT_API void cgt_camera_get_key_light(const cgt_camera *camera, uint32_t width, uint32_t height, float direction[3]);

/* Turns the eye about the axis through the target along `up`, counter-clockwise seen from the tip of up. */
CGT_API void cgt_camera_orbit(cgt_camera *camera, double degrees);

/* Moves a camera so that it shows all of some spheres with a margin of 4 percent, in the middle between the two edges
 * that they come nearest to.
 *   camera          its direction, up, angle and projection stay; gets eye and target, and height if it is orthographic
 *   width, height   pixels
 *   spheres         as of cgt_scene_set_spheres. What is not finite or has a negative radius is left out
 * Errors: INVALID_ARGUMENT, if there is nothing to show, or floats cannot hold the camera; it stays as it was */
CGT_API cgt_result cgt_camera_fit_spheres(cgt_camera *camera, uint32_t width, uint32_t height,
                                          const cgt_spheres *spheres);

/* The same in parts, for anything, and for all that a moving scene ever reaches. */
typedef struct cgt_camera_fit cgt_camera_fit;

/* Begins a fit.
 *   camera          as of cgt_camera_fit_spheres; copied
 *   orbit_degrees   what is added is to be seen all along this way around it (cgt_camera_orbit); 0: from the start
 *   fit             gets the fit; NULL on an error
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY */
CGT_API cgt_result cgt_camera_fit_create(const cgt_camera *camera, uint32_t width, uint32_t height,
                                         double orbit_degrees, cgt_camera_fit **fit);

/* Releases a fit; NULL does nothing. */
CGT_API void cgt_camera_fit_release(cgt_camera_fit *fit);

/* Adds a ball. One that is not finite or has a negative radius is left out. */
CGT_API void cgt_camera_fit_add(cgt_camera_fit *fit, const double center[3], double radius);

/* Adds the corners of a box, each as a ball of radius 0. */
CGT_API void cgt_camera_fit_add_box(cgt_camera_fit *fit, const float min[3], const float max[3]);

/* Moves a camera so that it shows all that was added so far, as cgt_camera_fit_spheres does.
 *   camera   the one that the fit began with: gets eye and target, and height if it is orthographic
 * Errors: INVALID_ARGUMENT, if nothing was added, or floats cannot hold the camera; it stays as it was */
CGT_API cgt_result cgt_camera_fit_apply(const cgt_camera_fit *fit, cgt_camera *camera);

#ifdef __cplusplus
}
#endif

#endif

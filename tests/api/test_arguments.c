/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Refused arguments: a table of the calls, the bad field, its value, the expected result, and a word of the message. A
 * refused call changes nothing. */
#include <cgt/all_hits.h>
#include <cgt/bounces.h>

#include "support/scenes.h"
#include "support/suite.h"

#include <math.h>
#include <string.h>

enum {
    CAMERA = 1,
    RAYS = 2,
    OCCLUDED_RAYS = 4,
    POINTS = 8,
    AMBIENT = 16,
    SPHERES = 32, /* adding and updating */
    TRIANGLES = 64,
    OPTIONS = 128, /* creating a scene and setting its options */
    ONE = 256,     /* closest and any hit */
    SHADOWS = 512,
    BOUNCED = 1024, /* tracing them */
    BOUNCE = 2048,
    PIXEL = 4096,     /* its ray */
    RECTANGLE = 8192, /* its rays */
    PREPARE = 16384,
    ALL_RAYS = 32768, /* their hits in rows */
    ALL_VISIT = 65536,
    ALL_RAY = 131072,
    INSIDE = 262144,
    CAPSULES = 524288,
    CALLS = 1048576,
    ALL_ARRAYS = ALL_RAYS | ALL_VISIT,
    FRAMES = CAMERA | AMBIENT | SHADOWS,
    ARRAYS = RAYS | OCCLUDED_RAYS | BOUNCED | ALL_ARRAYS,
    TRACES = FRAMES | ARRAYS | POINTS | ONE | ALL_RAY | INSIDE
};

/* All arguments of all calls. Pointers point to the structs that follow them. */
typedef struct arguments {
    const cgt_scene *const_scene;
    cgt_scene *scene;
    cgt_context *context;
    const cgt_camera *camera_at;
    const cgt_frame *frame_at;
    const cgt_rays *rays_at;
    const cgt_hits *hits_at;
    const cgt_points *points_at;
    const cgt_light *light_at;
    const cgt_spheres *spheres_at;
    const cgt_triangles *triangles_at;
    const cgt_capsules *capsules_at;
    uint8_t *occluded;
    float *visibility;
    const cgt_single_ray *ray_at;
    cgt_hit *hit_at;
    bool *occluded_at;
    const cgt_hit_rows *rows_at;
    cgt_hits_visitor *visitor;
    uint32_t fields;
    cgt_hit *surface_hits;
    uint32_t capacity, *count_at;
    float *org[3], *dir[3]; /* of pixels */
    uint32_t width, height, x, y, columns, lines;
    size_t ray_stride;
    cgt_ray_kind kind;
    cgt_camera camera;
    cgt_frame frame;
    cgt_rays rays;
    cgt_hits hits;
    cgt_hit_rows hit_rows;
    cgt_all_hits_options all;
    cgt_inside_options inside;
    cgt_points points;
    cgt_light light;
    cgt_shadow_options shadows;
    cgt_single_ray ray;
    cgt_media media;
    cgt_surfaces surfaces;
    cgt_bounced_rays bounced;
    cgt_ambient_options ambient;
    cgt_spheres spheres;
    cgt_triangles triangles;
    cgt_capsules capsules;
    test_scene_options options;
    test_trace_options trace;
} arguments;

typedef struct row {
    unsigned calls;
    size_t offset, bytes;
    const void *value;
    cgt_result result;
    const char *word; /* NULL: the call has no context to keep a message in, or the message is not checked */
} row;

#define BAD(calls, field, type, bad, word)                                                                             \
    {                                                                                                                  \
        calls, offsetof(arguments, field), sizeof(type), &(type){bad}, CGT_ERROR_INVALID_ARGUMENT, word                \
    }
#define LARGE(calls, field, type, bad, word)                                                                           \
    {                                                                                                                  \
        calls, offsetof(arguments, field), sizeof(type), &(type){bad}, CGT_ERROR_TOO_LARGE, word                       \
    }
#define NONE(calls, field, word) BAD(calls, field, void *, NULL, word)
#define BAD3(calls, field, x, y, z, word)                                                                              \
    {                                                                                                                  \
        calls, offsetof(arguments, field), 3 * sizeof(float), (const float[3]){x, y, z}, CGT_ERROR_INVALID_ARGUMENT,   \
            word                                                                                                       \
    }
#define NOT_FINITE(calls, field, word)                                                                                 \
    BAD(calls, field[0], float, NAN, word), BAD(calls, field[1], float, INFINITY, word),                               \
        BAD(calls, field[2], float, -INFINITY, word)

static const float data[64] = {0};
static const uint8_t small_types[8] = {0};

static const row rows[] = {
    /* missing arguments */
    NONE(TRACES | BOUNCE | PREPARE, const_scene, NULL),
    NONE(SPHERES | TRIANGLES | CAPSULES, scene, NULL),
    NONE(FRAMES, camera_at, "NULL"),
    NONE(PIXEL | RECTANGLE, camera_at, NULL), /* no context, no message */
    NONE(FRAMES, frame_at, "NULL"),
    NONE(ARRAYS | BOUNCE, rays_at, "NULL"),
    NONE(RAYS | BOUNCED | BOUNCE, hits_at, "NULL"),
    NONE(ONE | ALL_RAY, ray_at, "NULL"),
    NONE(ALL_RAYS, rows_at, "NULL"),
    NONE(ALL_VISIT, visitor, "NULL"),
    NONE(ALL_RAY, surface_hits, "NULL"),
    NONE(ALL_RAY, count_at, "NULL"),
    NONE(ONE, hit_at, "NULL"),
    NONE(POINTS | INSIDE, points_at, "NULL"),
    NONE(POINTS | SHADOWS, light_at, "NULL"),
    NONE(OCCLUDED_RAYS | POINTS | SHADOWS | INSIDE, occluded, "NULL"),
    NONE(PIXEL | RECTANGLE, org[1], NULL),
    NONE(PIXEL | RECTANGLE, dir[0], NULL),
    NONE(AMBIENT, visibility, "NULL"),
    NONE(SPHERES, spheres_at, "NULL"),
    NONE(TRIANGLES, triangles_at, "NULL"),
    NONE(CAPSULES, capsules_at, "NULL"),
    /* trace options */
    BAD(TRACES, trace.precision, cgt_precision, (cgt_precision)2, "precision"),
    BAD(TRACES, trace.precision, cgt_precision, (cgt_precision)-1, "precision"),
    BAD(TRACES, trace.packet, uint32_t, 1, "packet"),
    BAD(TRACES, trace.packet, uint32_t, 5, "packet"),
    BAD(TRACES, trace.packet, uint32_t, 32, "packet"),
    BAD(TRACES, trace.tile, cgt_tile_shape, (cgt_tile_shape)3, "tile"),
    BAD(TRACES, trace.tile, cgt_tile_shape, (cgt_tile_shape)-1, "tile"),
    BAD(TRACES, trace.loop, cgt_loop, (cgt_loop)3, "loop"),
    BAD(TRACES, trace.loop, cgt_loop, (cgt_loop)-1, "loop"),
    BAD(TRACES, trace.cull, cgt_cull, (cgt_cull)4, "cull"),
    BAD(TRACES, trace.cull, cgt_cull, (cgt_cull)-1, "cull"),
    BAD(TRACES, trace.mailbox, cgt_mailbox, (cgt_mailbox)3, "mailbox"),
    BAD(TRACES, trace.mailbox, cgt_mailbox, (cgt_mailbox)-1, "mailbox"),
    BAD(TRACES, trace.kd_traversal, cgt_kd_traversal, (cgt_kd_traversal)3, "kd_traversal"),
    BAD(TRACES, trace.kd_traversal, cgt_kd_traversal, (cgt_kd_traversal)-1, "kd_traversal"),
    BAD(TRACES, trace.triangle_test, cgt_triangle_test, (cgt_triangle_test)3, "triangle_test"),
    BAD(TRACES, trace.triangle_test, cgt_triangle_test, (cgt_triangle_test)-1, "triangle_test"),
    BAD(TRACES, trace.triangle_test, cgt_triangle_test, CGT_TRIANGLE_TEST_ACCELERATED, "FAST"),
    /* cameras */
    NOT_FINITE(FRAMES, camera.eye, "eye"),
    NOT_FINITE(FRAMES, camera.target, "target"),
    NOT_FINITE(FRAMES, camera.up, "up"),
    BAD3(FRAMES, camera.target, 0, 0, 5, "target"), /* equals the eye */
    BAD3(FRAMES, camera.eye, 0, 0, 0, "target"),    /* equals the target; with an up vector, not the default view */
    BAD3(FRAMES, camera.up, 0, 0, 1, "up"),
    BAD3(FRAMES, camera.up, 0, 0, -1e-20f, "up"),
    BAD3(FRAMES, camera.up, 0, 1e-8f, 1, "up"),
    BAD(FRAMES, camera.projection, cgt_projection, (cgt_projection)2, "projection"),
    BAD(FRAMES, camera.projection, cgt_projection, (cgt_projection)-1, "projection"),
    BAD(FRAMES, camera.fov, float, -45, "fov"),
    BAD(FRAMES, camera.fov, float, 180, "fov"),
    BAD(FRAMES, camera.fov, float, 1e30f, "fov"),
    BAD(FRAMES, camera.fov, float, NAN, "fov"),
    BAD(FRAMES, camera.fov, float, INFINITY, "fov"),
    BAD(FRAMES, camera.t_min, float, -1e-30f, "t_min"),
    BAD(FRAMES, camera.t_min, float, NAN, "t_min"),
    BAD(FRAMES, camera.t_max, float, -1, "t_max"),
    BAD(FRAMES, camera.t_max, float, NAN, "t_max"),
    /* frames */
    BAD(FRAMES, frame.width, uint32_t, 0, "frame"),
    BAD(FRAMES, frame.height, uint32_t, 0, "frame"),
    LARGE(FRAMES, frame.width, uint32_t, 65537, "65,536"),
    LARGE(FRAMES, frame.height, uint32_t, UINT32_MAX, "65,536"),
    BAD(FRAMES, frame.row_stride, size_t, 3, "row_stride"),
    LARGE(FRAMES, frame.row_stride, size_t, SIZE_MAX / 8, "row_stride"),
    LARGE(FRAMES, frame.vector_stride, size_t, SIZE_MAX / 8, "vector_stride"),
    NONE(FRAMES, frame.normal[0], "normal"),
    NONE(FRAMES, frame.normal[1], "normal"),
    NONE(FRAMES, frame.normal[2], "normal"),
    BAD(FRAMES, frame.position[1], float *, (float *)(uintptr_t)data, "position"), /* one of three */
    NONE(FRAMES, frame.u, "u and v"),
    NONE(FRAMES, frame.v, "u and v"),
    BAD(FRAMES, frame.first_row, uint32_t, 65536, "rows from row"),
    BAD(FRAMES, frame.row_count, uint32_t, UINT32_MAX, "rows from row"),
    BAD(FRAMES, frame.visitor_fields, uint32_t, 64, "visitor_fields"),
    NONE(AMBIENT, frame.t, "planes"),
    NONE(SHADOWS, frame.t, "plane t"),
    BAD(SHADOWS, shadows.t_min, float, NAN, "t_min"),
    BAD(SHADOWS, shadows.t_min, float, -1, "t_min"),
    NONE(AMBIENT, frame.primitive, "planes"),
    NONE(AMBIENT, frame.geometry, "planes"),
    BAD(AMBIENT, ambient.samples, uint32_t, 1025, "samples"),
    BAD(AMBIENT, ambient.samples, uint32_t, UINT32_MAX, "samples"),
    BAD(AMBIENT, ambient.radius, float, -1, "radius"),
    BAD(AMBIENT, ambient.radius, float, NAN, "radius"),
    /* arrays */
    NONE(ARRAYS, rays.org[0], "org"),
    NONE(ARRAYS, rays.org[2], "org"),
    NONE(ARRAYS, rays.dir[0], "dir"),
    NONE(ARRAYS, rays.dir[1], "dir"),
    BAD(ARRAYS, rays.stride, size_t, 6, "rays: stride"),
    BAD(ARRAYS, rays.vector_stride, size_t, 6, "rays: vector_stride"),
    LARGE(ARRAYS, rays.vector_stride, size_t, SIZE_MAX / 2 / 4 * 4, "count times vector_stride"),
    LARGE(ARRAYS, rays.stride, size_t, SIZE_MAX / 2 / 4 * 4, "stride"),
    LARGE(ARRAYS, rays.count, uint64_t, UINT64_MAX, "count"),
    LARGE(ARRAYS, rays.count, uint64_t, UINT64_C(1) << 45, "count"),
    NONE(BOUNCED, rays.t_max, "must not be NULL"),
    NONE(BOUNCED | BOUNCE, hits.t, NULL),
    NONE(BOUNCED | BOUNCE, hits.primitive, "primitive"),
    NONE(BOUNCED, hits.geometry, "must not be NULL"),
    NONE(BOUNCE, rays.org[1], "org"),
    BAD(BOUNCE, hits.stride, size_t, 3, NULL),
    BAD(BOUNCE, surfaces.stride, size_t, 12, "multiple of 8"),
    NONE(BOUNCE, surfaces.normal[2], NULL),
    NONE(BOUNCE, bounced.dir[0], NULL),
    NONE(BOUNCE, bounced.t_max, "reflected: t_max"),
    BAD(BOUNCE, bounced.stride, size_t, 7, NULL),
    BAD(BOUNCE, bounced.vector_stride, size_t, 7, "reflected: vector_stride"),
    BAD(BOUNCE, media.inside, float, -1, "inside"),
    BAD(BOUNCE, media.inside, float, NAN, "inside"),
    BAD(BOUNCE, media.outside, float, INFINITY, "outside"),
    BAD(BOUNCE, media.stride, size_t, 6, "stride"),
    LARGE(BOUNCE, rays.count, uint64_t, UINT64_MAX / 8, NULL),
    BAD(RAYS, hits.stride, size_t, 7, "hits"),
    BAD(RAYS, hits.vector_stride, size_t, 7, "hits: vector_stride"),
    NONE(RAYS, hits.normal[0], "normal"),
    NONE(RAYS, hits.normal[1], "normal"),
    NONE(RAYS, hits.u, "u and v"),
    NONE(RAYS, hits.v, "u and v"),
    BAD(ALL_RAYS, hit_rows.capacity, uint32_t, 0, "capacity"),
    BAD(ALL_RAY, capacity, uint32_t, 0, "capacity"),
    NONE(ALL_RAYS, hit_rows.count, "count"),
    NONE(ALL_RAYS, hit_rows.hits.normal[1], "normal"),
    NONE(ALL_RAYS, hit_rows.hits.v, "u and v"),
    BAD(ALL_RAYS, hit_rows.hits.stride, size_t, 7, "rows"),
    BAD(ALL_RAYS, hit_rows.hits.vector_stride, size_t, 7, "rows: vector_stride"),
    LARGE(ALL_RAYS, hit_rows.hits.stride, size_t, SIZE_MAX / 2 / 4 * 4, "rows"),
    BAD(ALL_ARRAYS | ALL_RAY, all.after_stride, size_t, 6, "after"),
    LARGE(ALL_ARRAYS, all.after_stride, size_t, SIZE_MAX / 2 / 4 * 4, "after"),
    BAD(ALL_VISIT, fields, uint32_t, CGT_FIELD_POSITION, "fields"),
    NONE(POINTS | INSIDE, points.position[0], "position"),
    NONE(POINTS | INSIDE, points.position[1], "position"),
    NONE(POINTS | INSIDE, points.position[2], "position"),
    BAD(INSIDE, inside.rule, cgt_inside_rule, (cgt_inside_rule)2, "rule"),
    BAD(INSIDE, inside.rule, cgt_inside_rule, (cgt_inside_rule)-1, "rule"),
    BAD(POINTS | INSIDE, points.stride, size_t, 6, "stride"),
    BAD(POINTS | INSIDE, points.vector_stride, size_t, 6, "points: vector_stride"),
    LARGE(POINTS | INSIDE, points.count, uint64_t, UINT64_MAX / 2, "count"),
    NOT_FINITE(POINTS | SHADOWS, light.position, "light"),
    BAD(POINTS | SHADOWS, light.kind, cgt_light_kind, (cgt_light_kind)2, "light"),
    BAD(POINTS | SHADOWS, light.kind, cgt_light_kind, (cgt_light_kind)-1, "light"),
    BAD(POINTS | SHADOWS, light.kind, cgt_light_kind, CGT_LIGHT_DIRECTIONAL,
        "length zero"), /* its position is the origin */
    /* pixels, of a picture of 8 x 8, from (2, 3) on */
    BAD(PIXEL | RECTANGLE, width, uint32_t, 2, NULL),
    BAD(PIXEL | RECTANGLE, height, uint32_t, 3, NULL),
    BAD(PIXEL, x, uint32_t, 8, NULL),
    BAD(PIXEL, y, uint32_t, 8, NULL),
    BAD(RECTANGLE, x, uint32_t, 7, NULL),
    BAD(RECTANGLE, y, uint32_t, 9, NULL),
    BAD(RECTANGLE, columns, uint32_t, 8, NULL),
    BAD(RECTANGLE, lines, uint32_t, 6, NULL),
    BAD(RECTANGLE, ray_stride, size_t, 6, NULL),
    LARGE(RECTANGLE, ray_stride, size_t, SIZE_MAX / 8 * 4, NULL),
    LARGE(PIXEL | RECTANGLE, width, uint32_t, 65537, NULL),
    BAD(PIXEL | RECTANGLE, camera.fov, float, 180, NULL),
    BAD(PREPARE, kind, cgt_ray_kind, (cgt_ray_kind)2, "rays 2"),
    BAD(PREPARE, kind, cgt_ray_kind, (cgt_ray_kind)-1, "rays -1"),
    /* geometries; together with the existing one, the sum of counts reaches 2^32 - 1 */
    NONE(SPHERES, spheres.centers, "centers"),
    BAD(SPHERES, spheres.centers.format, cgt_format, CGT_FORMAT_UINT32, "floats, doubles or halves"),
    BAD(SPHERES, spheres.centers.format, cgt_format, CGT_FORMAT_NONE, "centers"),
    BAD(SPHERES, spheres.centers.format, cgt_format, (cgt_format)-1, "format -1"),
    BAD(SPHERES, spheres.radii.format, cgt_format, CGT_FORMAT_UINT8, "radii"),
    BAD(SPHERES, spheres.origin[0], double, NAN, "origin"),
    BAD(SPHERES, spheres.origin[1], double, INFINITY, "origin"),
    BAD(SPHERES, spheres.origin[2], double, -INFINITY, "origin"),
    BAD(SPHERES, spheres.types.data, const void *, small_types, "types without radii"),
    BAD(SPHERES, spheres.types.format, cgt_format, CGT_FORMAT_FLOAT, "whole numbers"),
    BAD(SPHERES, spheres.types.stride, size_t, 3, "stride"),
    BAD(SPHERES, spheres.types.stride, size_t, SIZE_MAX / 3, "stride"),
    BAD(SPHERES, spheres.centers.stride, size_t, 3, "stride"),
    BAD(SPHERES, spheres.centers.stride, size_t, 11, "stride"),
    BAD(SPHERES, spheres.centers.stride, size_t, SIZE_MAX - 3, "stride"),
    BAD(SPHERES, spheres.centers.stride, size_t, SIZE_MAX / 8 * 4, "stride"),
    BAD(SPHERES, spheres.radii.stride, size_t, 3, "stride"),
    BAD(SPHERES, spheres.radii.stride, size_t, SIZE_MAX - 3, "stride"),
    BAD(SPHERES, spheres.radius, float, -1, "radius"),
    BAD(SPHERES, spheres.radius, float, NAN, "radius"),
    BAD(SPHERES, spheres.radius, float, INFINITY, "radius"),
    BAD(SPHERES, spheres.radius, float, -INFINITY, "radius"),
    LARGE(SPHERES, spheres.count, uint32_t, UINT32_MAX, "2^32"),
    NONE(TRIANGLES, triangles.vertices, "vertices"),
    BAD(TRIANGLES, triangles.vertices.format, cgt_format, CGT_FORMAT_UINT64, "vertices"),
    BAD(TRIANGLES, triangles.indices.format, cgt_format, CGT_FORMAT_HALF, "indices have the format 3"),
    BAD(TRIANGLES, triangles.indices.format, cgt_format, (cgt_format)8, "format 8"),
    BAD(TRIANGLES, triangles.origin[2], double, NAN, "origin"),
    BAD(TRIANGLES, triangles.vertices.stride, size_t, 3, "stride"),
    BAD(TRIANGLES, triangles.vertices.stride, size_t, SIZE_MAX / 2, "stride"),
    BAD(TRIANGLES, triangles.indices.stride, size_t, 8, "stride"),
    BAD(TRIANGLES, triangles.indices.stride, size_t, SIZE_MAX - 3, "stride"),
    BAD(TRIANGLES, triangles.count, uint32_t, 2, "indices"),
    NONE(CAPSULES, capsules.vertices, "vertices"),
    BAD(CAPSULES, capsules.vertices.format, cgt_format, CGT_FORMAT_UINT16, "vertices"),
    BAD(CAPSULES, capsules.ends.data, const void *, data, "both indices and ends"),
    BAD(CAPSULES, capsules.indices.format, cgt_format, CGT_FORMAT_DOUBLE, "indices"),
    BAD(CAPSULES, capsules.radii.format, cgt_format, CGT_FORMAT_UINT32, "radii"),
    BAD(CAPSULES, capsules.origin[1], double, NAN, "origin"),
    BAD(CAPSULES, capsules.types.data, const void *, small_types, "types without radii"),
    BAD(CAPSULES, capsules.types.stride, size_t, 3, "stride"),
    BAD(CAPSULES, capsules.vertices.stride, size_t, 11, "stride"),
    BAD(CAPSULES, capsules.indices.stride, size_t, 7, "stride"),
    BAD(CAPSULES, capsules.radii.stride, size_t, 3, "stride"),
    BAD(CAPSULES, capsules.radius, float, -1, "radius"),
    BAD(CAPSULES, capsules.radius, float, NAN, "radius"),
    BAD(CAPSULES, capsules.count, uint32_t, 3, "need more than 4 vertices"),
    LARGE(CAPSULES, capsules.count, uint32_t, UINT32_MAX / 2 + 1, "2^31"),
    /* scene options */
    BAD(OPTIONS, options.structure, cgt_structure, (cgt_structure)7, "structure"),
    BAD(OPTIONS, options.structure, cgt_structure, CGT_STRUCTURE_MAX, "structure"),
    BAD(OPTIONS, options.structure, cgt_structure, (cgt_structure)-1, "structure"),
    BAD(OPTIONS, options.rays, cgt_ray_kind, (cgt_ray_kind)2, "rays"),
    BAD(OPTIONS, options.rays, cgt_ray_kind, (cgt_ray_kind)-1, "rays"),
    BAD(OPTIONS, options.kd_layout, cgt_kd_layout, (cgt_kd_layout)4, "kd_layout"),
    BAD(OPTIONS, options.kd_layout, cgt_kd_layout, (cgt_kd_layout)-1, "kd_layout"),
    BAD(OPTIONS, options.kd_break_level, uint32_t, 51, "kd_break_level"),
    BAD(OPTIONS, options.resolution[0], uint32_t, 4, "resolution"),
    BAD(OPTIONS, options.resolution[2], uint32_t, 1, "resolution"),
    {OPTIONS, offsetof(arguments, options.resolution), 3 * sizeof(uint32_t), (const uint32_t[3]){1025, 1, 1},
     CGT_ERROR_TOO_LARGE, "resolution"},
    {OPTIONS, offsetof(arguments, options.resolution), 3 * sizeof(uint32_t), (const uint32_t[3]){1, 1, UINT32_MAX},
     CGT_ERROR_TOO_LARGE, "resolution"},
    {OPTIONS, offsetof(arguments, options.resolution), 3 * sizeof(uint32_t), (const uint32_t[3]){1024, 128, 129},
     CGT_ERROR_TOO_LARGE, "resolution"},
    {OPTIONS, offsetof(arguments, options.resolution), 3 * sizeof(uint32_t), (const uint32_t[3]){1024, 1024, 1024},
     CGT_ERROR_TOO_LARGE, "resolution"},
};

/* ---- the calls ---- */

#define PIXELS 16
#define COUNT 2

static float plane[6][PIXELS], hit[6][COUNT], visibility[PIXELS], bounced[9][COUNT], pixel[6][COUNT * 2];
static double surface[7][COUNT];
static cgt_hit single;
static bool single_occluded;
static uint32_t ids[4][PIXELS];
static uint8_t occluded[PIXELS];
static const float one[COUNT] = {1, 1};
static cgt_hit surface_hit[COUNT];
static uint32_t hit_counts[COUNT];

static cgt_visit go_on(void *user, uint64_t ray, const cgt_hit *hits, uint32_t count)
{
    (void)user, (void)ray, (void)hits, (void)count;
    return CGT_VISIT_CONTINUE;
}

static void init_arguments(arguments *a, cgt_context *context, cgt_scene *scene)
{
    *a = (arguments){
        .const_scene = scene,
        .scene = scene,
        .context = context,
        .camera_at = &a->camera,
        .frame_at = &a->frame,
        .rays_at = &a->rays,
        .hits_at = &a->hits,
        .points_at = &a->points,
        .light_at = &a->light,
        .spheres_at = &a->spheres,
        .triangles_at = &a->triangles,
        .capsules_at = &a->capsules,
        .occluded = occluded,
        .visibility = visibility,
        .frame = {.width = 4,
                  .height = 4,
                  .t = plane[0],
                  .primitive = ids[0],
                  .geometry = ids[1],
                  .normal = {plane[1], plane[2], plane[3]},
                  .u = plane[4],
                  .v = plane[5]},
        .ray_at = &a->ray,
        .hit_at = &single,
        .occluded_at = &single_occluded,
        .rows_at = &a->hit_rows,
        .visitor = go_on,
        .surface_hits = surface_hit,
        .capacity = COUNT,
        .count_at = hit_counts,
        .hit_rows = {.capacity = 1,
                     .hits = {.t = hit[0], .normal = {hit[1], hit[2], hit[3]}, .u = hit[4], .v = hit[5]},
                     .count = hit_counts},
        .org = {pixel[0], pixel[1], pixel[2]},
        .dir = {pixel[3], pixel[4], pixel[5]},
        .width = 8,
        .height = 8,
        .x = 2,
        .y = 3,
        .columns = 2,
        .lines = 2,
        .ray = {.dir = {1, 1, 1}},
        .surfaces = {.position = {surface[0], surface[1], surface[2]}, .normal = {surface[3], surface[4], surface[5]}},
        .bounced = {.org = {bounced[0], bounced[1], bounced[2]},
                    .dir = {bounced[3], bounced[4], bounced[5]},
                    .t_max = bounced[6]},
        .rays = {.count = COUNT, .org = {one, one, one}, .dir = {one, one, one}, .t_max = one},
        .hits = {.t = hit[0],
                 .primitive = ids[2],
                 .geometry = ids[3],
                 .normal = {hit[1], hit[2], hit[3]},
                 .u = hit[4],
                 .v = hit[5]},
        .points = {.count = COUNT, .position = {one, one, one}},
        .spheres = {.count = 4, .centers = cgt_floats(data, 0), .radius = 1},
        .triangles = {.count = 1, .vertex_count = 3, .vertices = cgt_floats(data, 0)},
        .capsules = {.vertex_count = 4, .vertices = cgt_floats(data, 0), .radius = 1},
    };
    cgt_camera_init(&a->camera);
}

/* Some fields are read only beside others: strides with arrays, types with other types. */
static void adapt(arguments *a, size_t offset, size_t bytes)
{
    if (offset == offsetof(arguments, spheres.radii.stride) || offset == offsetof(arguments, spheres.radii.format))
        a->spheres.radii = cgt_floats(data, 0);
    if (offset == offsetof(arguments, spheres.types.stride) || offset == offsetof(arguments, spheres.types.format)) {
        a->spheres.radii = cgt_floats(data, 0);
        a->spheres.types = cgt_uint32s(ids[0], 0);
    }
    if (offset == offsetof(arguments, triangles.indices.stride) ||
        offset == offsetof(arguments, triangles.indices.format))
        a->triangles.indices = cgt_uint32s(ids[0], 0);
    if (offset == offsetof(arguments, capsules.indices.stride) ||
        offset == offsetof(arguments, capsules.indices.format) ||
        (offset == offsetof(arguments, capsules.ends.data) && bytes == sizeof(void *)))
        a->capsules.indices = cgt_uint32s(ids[0], 0);
    if (offset == offsetof(arguments, capsules.radii.stride) || offset == offsetof(arguments, capsules.types.stride) ||
        offset == offsetof(arguments, capsules.radii.format))
        a->capsules.radii = cgt_floats(data, 0);
    if (offset == offsetof(arguments, capsules.types.stride))
        a->capsules.types = cgt_uint32s(ids[0], 0);
}

static cgt_result make_call(unsigned call, const arguments *a)
{
    const cgt_trace_options *o = TRACE_OPTIONS(&a->trace);
    cgt_scene *made = NULL;
    uint32_t id = CGT_INVALID_ID;
    cgt_result result = CGT_OK, other = CGT_OK;
    switch (call) {
    case CAMERA: return cgt_trace_camera(a->const_scene, a->camera_at, a->frame_at, o);
    case RAYS: return cgt_trace_rays(a->const_scene, a->rays_at, a->hits_at, o);
    case OCCLUDED_RAYS: return cgt_occluded_rays(a->const_scene, a->rays_at, a->occluded, o);
    case POINTS: return cgt_occluded_points(a->const_scene, a->light_at, a->points_at, a->occluded, o);
    case INSIDE: return cgt_points_inside(a->const_scene, a->points_at, &a->inside, a->occluded, o);
    case AMBIENT:
        return cgt_ambient_occlusion(a->const_scene, a->camera_at, a->frame_at, &a->ambient, a->visibility, o);
    case ONE:
        result = cgt_trace_ray(a->const_scene, a->ray_at, a->hit_at, o);
        other = cgt_occluded_ray(a->const_scene, a->ray_at, a->hit_at ? a->occluded_at : NULL, o);
        break;
    case SHADOWS:
        return cgt_occluded_frame(a->const_scene, a->camera_at, a->frame_at, a->light_at, 1, &a->shadows, a->occluded,
                                  o);
    case ALL_RAYS: return cgt_trace_all_rays(a->const_scene, a->rays_at, &a->all, a->rows_at, o);
    case ALL_VISIT: return cgt_visit_all_rays(a->const_scene, a->rays_at, &a->all, a->fields, a->visitor, NULL, o);
    case ALL_RAY:
        return cgt_trace_all_ray(a->const_scene, a->ray_at, &a->all, a->surface_hits, a->capacity, a->count_at, NULL,
                                 o);
    case BOUNCED: return cgt_trace_bounced_rays(a->const_scene, a->rays_at, a->hits_at, o);
    case BOUNCE:
        return cgt_bounce_rays(a->const_scene, a->rays_at, a->hits_at, &a->media, &a->surfaces, &a->bounced, NULL, o);
    case PIXEL: /* pointers to three numbers */
        return cgt_camera_get_ray(a->camera_at, a->width, a->height, a->x, a->y, a->org[1] ? pixel[0] : NULL,
                                  a->dir[0] ? pixel[3] : NULL);
    case RECTANGLE:
        return cgt_camera_get_rays(a->camera_at, a->width, a->height, a->x, a->y, a->columns, a->lines, a->ray_stride,
                                   a->org, a->dir);
    case PREPARE: return cgt_scene_prepare(a->const_scene ? a->scene : NULL, a->kind);
    case SPHERES:
        result = cgt_scene_set_spheres(a->scene, &id, a->spheres_at);
        other = cgt_scene_set_spheres(a->scene, &(uint32_t){0}, a->spheres_at);
        break;
    case TRIANGLES:
        result = cgt_scene_set_triangles(a->scene, &id, a->triangles_at);
        other = cgt_scene_set_triangles(a->scene, &(uint32_t){1}, a->triangles_at);
        break;
    case CAPSULES:
        result = cgt_scene_set_capsules(a->scene, &id, a->capsules_at);
        other = cgt_scene_set_capsules(a->scene, &(uint32_t){2}, a->capsules_at);
        break;
    default:
        result = cgt_scene_create(a->context, SCENE_OPTIONS(&a->options), &made);
        other = cgt_scene_set_options(a->scene, SCENE_OPTIONS(&a->options));
        assert_true(result == CGT_OK || !made);
        cgt_scene_release(made);
    }
    assert_int_equal(other, result);
    assert_true(result == CGT_OK || id == CGT_INVALID_ID);
    return result;
}

/* Fills what calls write to, and returns the sum of it; fill < 0: leaves it. */
static uint64_t sum_outputs(int fill)
{
    uint64_t sum = 0;
    unsigned char *const block[] = {(void *)plane,   (void *)hit,         (void *)visibility, (void *)ids,
                                    occluded,        (void *)bounced,     (void *)surface,    (void *)pixel,
                                    (void *)&single, (void *)surface_hit, (void *)hit_counts};
    const size_t bytes[] = {sizeof plane,    sizeof hit,         sizeof visibility, sizeof ids,
                            sizeof occluded, sizeof bounced,     sizeof surface,    sizeof pixel,
                            sizeof single,   sizeof surface_hit, sizeof hit_counts};
    for (size_t k = 0; k < TEST_COUNT(block); k++) {
        if (fill >= 0)
            memset(block[k], fill, bytes[k]);
        for (size_t i = 0; i < bytes[k]; i++)
            sum = sum * 31 + block[k][i];
    }
    return sum;
}

/* A sphere about the origin, geometry 0, a triangle next to it, geometry 1, and no capsules, geometry 2. */
static cgt_scene *make_scene(cgt_context *context)
{
    static const float sphere[1][4] = {{0, 0, 0, 1}}, corner[9] = {9, 0, 0, 10, 0, 0, 9, 1, 0};
    const cgt_triangles triangles = {.count = 1, .vertex_count = 3, .vertices = cgt_floats(corner, 0)};
    cgt_scene *scene = scene_of(context, NULL, sphere, 1);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
    assert_int_equal(cgt_scene_set_capsules(scene, NULL, &(cgt_capsules){0}), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

static void check_row(const row *r, size_t number, unsigned call, cgt_context *context, cgt_scene *scene)
{
    const uint64_t outputs = sum_outputs(0x5a);
    cgt_trace_statistics statistics = {.rays = 55};
    arguments a;
    init_arguments(&a, context, scene);
    a.trace.statistics = &statistics;
    adapt(&a, r->offset, r->bytes);
    memcpy((char *)&a + r->offset, r->value, r->bytes);
    assert_int_equal(cgt_scene_remove_geometry(scene, 4711), CGT_ERROR_INVALID_ARGUMENT); /* another message */
    const cgt_result result = make_call(call, &a);
    if (result != r->result)
        fail_msg("row %zu, call %u: %s", number, call, cgt_get_result_string(result));
    if (r->word && !strstr(context_message(context), r->word))
        fail_msg("row %zu, call %u: \"%s\" does not mention %s", number, call, context_message(context), r->word);
    assert_true(sum_outputs(-1) == outputs && statistics.rays == 55);
    /* nothing has changed: the scene can still be traced */
    assert_true(ray_trace(scene, (truth_ray){{0, 0, 5}, {0, 0, -1}, 0, INFINITY}).t == 4);
}

TEST(bad_values_are_refused)
{
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = make_scene(context);
    for (size_t i = 0; i < TEST_COUNT(rows); i++)
        for (unsigned call = 1; call < CALLS; call *= 2)
            if (rows[i].calls & call)
                check_row(&rows[i], i, call, context, scene);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* The values that the table does not list are accepted. */
TEST(good_values_are_accepted)
{
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = make_scene(context);
    arguments a;
    init_arguments(&a, context, scene);
    a.light.position[0] = 1;
    for (unsigned call = 1; call < CALLS; call *= 2) {
        assert_int_equal(make_call(call, &a), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    }
    static const uint32_t largest[][3] = {{1024, 128, 128}, {128, 1024, 128}, {1, 1, 1}};
    for (size_t i = 0; i < TEST_COUNT(largest); i++) {
        memcpy(a.options.resolution, largest[i], sizeof largest[i]);
        assert_int_equal(make_call(OPTIONS, &a), CGT_OK);
    }
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    a.camera.height = NAN; /* a projection does not read fields that it does not use */
    assert_int_equal(make_call(CAMERA, &a), CGT_OK);
    a.camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
    static const float bad_height[] = {-1, NAN, INFINITY};
    for (size_t i = 0; i < TEST_COUNT(bad_height); i++) {
        a.camera.height = bad_height[i];
        assert_int_equal(make_call(CAMERA, &a), CGT_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(context_message(context), "height"));
    }
    a.camera.height = 3;
    a.camera.fov = 1000;
    assert_int_equal(make_call(CAMERA, &a), CGT_OK);
    a.camera.t_min = 2;
    a.camera.t_max = 1.5f;
    assert_int_equal(make_call(CAMERA, &a), CGT_ERROR_INVALID_ARGUMENT);
    a.camera.t_max = 2;
    assert_int_equal(make_call(CAMERA, &a), CGT_OK);
    a.trace.tile = CGT_TILE_SHAPE_STRIP;
    a.trace.packet = 8;
    assert_int_equal(make_call(CAMERA, &a), CGT_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(context_message(context), "strips"));
    assert_int_equal(make_call(RAYS, &a), CGT_OK); /* ray arrays have neither tiles nor pixel packets */
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* Without rays or points nothing is read or written, whichever pointers are NULL. */
TEST(empty_arrays_are_valid)
{
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = make_scene(context);
    const uint64_t outputs = sum_outputs(0x5a);
    arguments a;
    init_arguments(&a, context, scene);
    a.rays = (cgt_rays){0};
    a.points = (cgt_points){0};
    assert_int_equal(cgt_occluded_frame(scene, &a.camera, &a.frame, NULL, 0, NULL, NULL, NULL), CGT_OK); /* no light */
    assert_int_equal(make_call(RAYS, &a), CGT_OK);
    assert_int_equal(make_call(OCCLUDED_RAYS, &a), CGT_OK);
    assert_int_equal(make_call(POINTS, &a), CGT_OK);
    a.occluded = NULL;
    a.hits = (cgt_hits){0};
    a.bounced = (cgt_bounced_rays){0};
    assert_int_equal(make_call(BOUNCED, &a), CGT_OK);
    assert_int_equal(cgt_bounce_rays(scene, &a.rays, &a.hits, NULL, NULL, NULL, NULL, NULL), CGT_OK);
    assert_int_equal(make_call(RAYS, &a), CGT_OK);
    assert_int_equal(make_call(OCCLUDED_RAYS, &a), CGT_OK);
    assert_int_equal(make_call(POINTS, &a), CGT_OK);
    assert_true(sum_outputs(-1) == outputs);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

TEST(uncommitted_scenes_are_refused)
{
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = make_scene(context);
    arguments a;
    init_arguments(&a, context, scene);
    assert_int_equal(make_call(OPTIONS, &a), CGT_OK);
    for (unsigned call = 1; call < CALLS; call *= 2)
        if ((TRACES | BOUNCE | PREPARE) & call)
            assert_int_equal(make_call(call, &a), CGT_ERROR_NOT_COMMITTED);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* Calls that do not fit the table. */
TEST(null_is_refused)
{
    const cgt_result bad = CGT_ERROR_INVALID_ARGUMENT;
    const cgt_scene_options options = {0};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = make_scene(context), *made = scene;
    cgt_scene_statistics statistics;
    cgt_research_scene_statistics research;
    assert_int_equal(cgt_scene_create(NULL, NULL, &made), bad);
    assert_int_equal(cgt_scene_create(context, NULL, NULL), bad);
    assert_int_equal(cgt_scene_set_options(NULL, &options), bad);
    assert_int_equal(cgt_scene_set_options(scene, NULL), bad);
    assert_int_equal(cgt_scene_remove_geometry(NULL, 0), bad);
    assert_int_equal(cgt_scene_commit(NULL), bad);
    assert_int_equal(cgt_scene_get_statistics(NULL, &statistics), bad);
    assert_int_equal(cgt_scene_get_statistics(scene, NULL), bad);
    assert_int_equal(cgt_research_get_scene_statistics(NULL, &research), bad);
    assert_int_equal(cgt_research_get_scene_statistics(scene, NULL), bad);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* Geometries are told as they were set, by kind. */
TEST(geometries_are_told)
{
    static const float corner[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const uint16_t index[3] = {0, 1, 2};
    const cgt_spheres balls = {.count = 2, .centers = cgt_floats(corner, 0), .radius = 0.5f, .mask = 6};
    const cgt_triangles faces = {
        .count = 1, .indices = cgt_uint16s(index, 0), .vertex_count = 3, .vertices = cgt_floats(corner, 12)};
    const cgt_capsules sticks = {.count = 1, .vertex_count = 2, .vertices = cgt_floats(corner, 0), .radius = 2.0f};
    cgt_context *context;
    cgt_scene *scene;
    cgt_spheres s;
    cgt_triangles t;
    cgt_capsules c;
    assert_int_equal(cgt_context_create(NULL, &context), CGT_OK);
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    assert_int_equal(cgt_scene_get_geometries(scene), 0);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &balls), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &faces), CGT_OK);
    assert_int_equal(cgt_scene_set_capsules(scene, NULL, &sticks), CGT_OK);
    assert_int_equal(cgt_scene_get_geometries(scene), 3);
    assert_true(cgt_scene_get_spheres(scene, 0, &s) && cgt_scene_get_triangles(scene, 1, &t) &&
                cgt_scene_get_capsules(scene, 2, &c));
    assert_true(s.count == 2 && s.centers.data == corner && s.centers.stride == 12 && s.radius == 0.5f && s.mask == 6);
    assert_true(t.count == 1 && t.indices.data == index && t.indices.stride == 6 && t.vertex_count == 3);
    assert_true(c.count == 1 && c.vertices.data == corner && c.radius == 2.0f);
    for (uint32_t id = 0; id < 4; id++) {
        assert_int_equal(cgt_scene_get_spheres(scene, id, &s), id == 0);
        assert_int_equal(cgt_scene_get_triangles(scene, id, &t), id == 1);
        assert_int_equal(cgt_scene_get_capsules(scene, id, &c), id == 2);
    }
    assert_int_equal(cgt_scene_remove_geometry(scene, 0), CGT_OK);
    assert_false(cgt_scene_get_spheres(scene, 0, &s));
    assert_false(cgt_scene_get_spheres(NULL, 0, &s) || cgt_scene_get_triangles(NULL, 1, &t) ||
                 cgt_scene_get_capsules(NULL, 2, &c) || cgt_scene_get_triangles(scene, 1, NULL));
    assert_int_equal(cgt_scene_get_geometries(NULL), 0);
    assert_int_equal(cgt_context_get_error_message(context, NULL, 0), 0); /* none of these is an error */
    cgt_scene_release(scene);
    cgt_context_release(context);
}

SEEDED_SUITE("test_arguments", NULL, NULL)

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Fuzz target: bytes as a scene of up to some thousand primitives and rays through it. The work that a call counts must
 * be in proportion to what scene and rays justify: a way through a tree for each ray, and a decision for each primitive
 * that the ray passes near. So this looks for time cliffs, by counters and not by clocks. Hits are fuzz_scene's
 * concern. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz/fuzz.h"
#include "support/cliffs/cliffs.h"
#include "support/ray_arrays.h"

/* The work that is allowed, times what is justified. A uniform cloud takes half of that; the most that was seen within
 * the exponents below is 83, where triangles of 2^-13 lie in one plane 2^19 away, and rays in that plane. Every ray
 * against every primitive in double precision takes up to 120. The exponents are those of places, sizes and directions.
 * Worlds of more than 2^30 in extent are known to take more: rays that bands of magnitudes do not scale exactly. */
#define MOST_FACTOR 96.0
#define MOST_EXPONENT 20

/* Justified: for each ray this for each level of a tree; for each primitive that it passes a decision in double. */
#define LEVEL_WORK 16.0
#define DECISION_WORK 32.0

/* And for a call: the set-up of tiles and packets. */
#define CALL_WORK 2000.0

/* A ray passes a ball when it comes this near: in radii, and in distances from its origin, which is what boxes in
 * single precision can tell. */
#define NEAR_RADII 1.5
#define NEAR_DISTANCE 0x1p-18

/* Bytes of structures: of a primitive, and of any scene. */
#define MOST_PRIMITIVE_BYTES 1024u
#define MOST_SCENE_BYTES (1u << 20)

#define MOST_GROUPS 4u
#define MOST_GROUP_COUNT 512u
#define MOST_RAYS 64u
#define EDGE 8u /* of a picture, in pixels */

typedef struct ball {
    double middle[3], radius;
} ball;

typedef struct group {
    bool triangles;
    uint32_t count;
    float middle[3], extent;
    float *data; /* as cliff_scene has them */
} group;

typedef struct fuzz_cliff {
    fuzz_bytes bytes;
    test_random random; /* for what bytes would be too many */
    group group[MOST_GROUPS];
    uint32_t groups;
    ball ball[MOST_GROUPS * MOST_GROUP_COUNT];
    uint32_t balls;
    cgt_scene *scene;
    truth_ray ray[MOST_RAYS];
    cgt_trace_statistics trace;
    cgt_research_trace_statistics research;
} fuzz_cliff;

/* ---- the scene ---- */

/* Plus or minus a power of two, or 0. */
static float any_power(fuzz_cliff *f, int least, int most)
{
    const uint8_t byte = fuzz_byte(&f->bytes), sign = fuzz_byte(&f->bytes);
    const float power = ldexpf(1, least + byte % (most - least + 1));
    return sign % 4 == 0 ? 0 : sign % 4 == 1 ? -power : power;
}

static float any_size(fuzz_cliff *f, int least, int most)
{
    return ldexpf(1 + (float)(fuzz_byte(&f->bytes) % 8) / 8,
                  least + (int)fuzz_below(&f->bytes, (uint32_t)(most - least) + 1));
}

/* A primitive's place and size by one of the laws. */
static float place(fuzz_cliff *f, const group *g, uint32_t law, uint32_t i, float size, float middle[3])
{
    const float along = random_float(&f->random, -1, 1);
    float scale = 1;
    for (int a = 0; a < 3; a++)
        middle[a] = random_float(&f->random, -1, 1);
    switch (law) {
    case 1: /* line */
        middle[0] = along;
        middle[1] = along / 2;
        middle[2] = 0;
        break;
    case 2: middle[1] = 0; break;                         /* plane */
    case 3: memset(middle, 0, 3 * sizeof *middle); break; /* point */
    case 4: scale = random_log(&f->random, 0x1p-20f, 1); break;
    case 5: size *= random_log(&f->random, 0x1p-12f, 1); break;
    case 6: size *= ldexpf(1, -(int)(i % 16)); break;
    default: break;
    }
    for (int a = 0; a < 3; a++)
        middle[a] = g->middle[a] + g->extent * scale * middle[a];
    return size * scale;
}

static void fill_group(fuzz_cliff *f, group *g)
{
    const uint32_t law = fuzz_below(&f->bytes, 8);
    const float size = g->extent * any_size(f, -10, 0);
    for (uint32_t i = 0; i < g->count; i++) {
        float middle[3], *p = g->data + (size_t)i * (g->triangles ? 9 : 4);
        const float own = place(f, g, law, i, size, middle);
        ball *b = &f->ball[f->balls++];
        b->radius = (double)own * (g->triangles ? 1.75 : 1);
        for (int a = 0; a < 3; a++)
            b->middle[a] = (double)middle[a];
        if (!g->triangles)
            memcpy(p, middle, sizeof middle);
        if (!g->triangles)
            p[3] = own;
        for (int k = 0; k < 9 && g->triangles; k++)
            p[k] = middle[k % 3] + own * random_float(&f->random, -1, 1);
    }
}

static void make_group(fuzz_cliff *f)
{
    group *g = &f->group[f->groups++];
    g->triangles = fuzz_byte(&f->bytes) % 2;
    g->count = 1u << fuzz_below(&f->bytes, 10); /* MOST_GROUP_COUNT at most */
    g->extent = any_size(f, -MOST_EXPONENT, MOST_EXPONENT);
    for (int a = 0; a < 3; a++)
        g->middle[a] = any_power(f, -MOST_EXPONENT, MOST_EXPONENT);
    f->random.state += fuzz_byte(&f->bytes);
    g->data = fuzz_allocate(((size_t)g->count * (g->triangles ? 9 : 4) + 1) * sizeof(float));
    fill_group(f, g);
    const cliff_scene as = {.base = g->triangles ? CLIFF_SOUP : CLIFF_CLOUD, .count = g->count, .data = g->data};
    FUZZ_CHECK(cliff_add(&as, f->scene) == CGT_OK, "a geometry is refused");
}

/* ---- rays ---- */

static void make_ray(fuzz_cliff *f, uint32_t law, const group *from, const group *to, float length, float away,
                     truth_ray *ray)
{
    *ray = (truth_ray){.t_max = INFINITY};
    float target[3];
    random_direction(&f->random, ray->dir);
    for (int a = 0; a < 3; a++) {
        target[a] = to->middle[a] + to->extent * random_float(&f->random, -1, 1);
        ray->org[a] = from->middle[a] + from->extent * random_float(&f->random, -1, 1);
        if (law & 1)
            ray->org[a] = target[a] - away * from->extent * ray->dir[a];
        if (law & 2)
            ray->dir[a] = a == (int)(law >> 3) % 3 ? copysignf(1, ray->dir[a]) : 0;
        else if (law & 4)
            ray->dir[a] = target[a] - ray->org[a];
        ray->dir[a] *= length;
    }
    ray->t_max = law & 16 ? length : INFINITY;
}

static void make_rays(fuzz_cliff *f)
{
    const uint32_t law = fuzz_byte(&f->bytes);
    const group *from = &f->group[fuzz_below(&f->bytes, f->groups)], *to = &f->group[fuzz_below(&f->bytes, f->groups)];
    const float length = law & 32 ? any_size(f, -MOST_EXPONENT, MOST_EXPONENT) : 1;
    const float away = law & 64 ? any_size(f, 0, 16) : 2;
    for (uint32_t i = 0; i < MOST_RAYS; i++)
        make_ray(f, law, from, to, length, away, &f->ray[i]);
}

/* ---- what is justified ---- */

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Whether a ray passes near a ball, from its origin on. Everything that is not finite counts as near. */
static bool passes(const truth_ray *ray, const ball *b)
{
    const double dir[3] = {(double)ray->dir[0], (double)ray->dir[1], (double)ray->dir[2]};
    double off[3];
    for (int a = 0; a < 3; a++)
        off[a] = b->middle[a] - (double)ray->org[a];
    const double square = dot(dir, dir), along = dot(off, dir), distance = sqrt(dot(off, off));
    const double t = fmin(fmax(along / square, (double)ray->t_min), (double)ray->t_max);
    for (int a = 0; a < 3; a++)
        off[a] -= t * dir[a];
    return !(sqrt(dot(off, off)) > NEAR_RADII * b->radius + NEAR_DISTANCE * distance);
}

static double justified(const fuzz_cliff *f, const truth_ray *rays, uint32_t count)
{
    double work = CALL_WORK + count * LEVEL_WORK * (1 + log2(f->balls));
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < f->balls; k++)
            work += passes(&rays[i], &f->ball[k]) ? DECISION_WORK : 0;
    return work;
}

static void check_work(const fuzz_cliff *f, const char *call, const truth_ray *rays, uint32_t count)
{
    const double work = cliff_work(&f->trace, &f->research), allowed = MOST_FACTOR * justified(f, rays, count);
    FUZZ_CHECK(work <= allowed, "%s: %u rays through %u primitives take %.0f steps, allowed are %.0f", call, count,
               f->balls, work, allowed);
}

/* ---- calls ---- */

static void trace_rays(fuzz_cliff *f, const cgt_trace_options *options)
{
    full_hit hit[MOST_RAYS];
    uint8_t occluded[MOST_RAYS];
    const cgt_rays rays = ray_array(f->ray, MOST_RAYS);
    FUZZ_CHECK(trace_array(f->scene, f->ray, MOST_RAYS, hit, options) == CGT_OK, "rays are refused");
    check_work(f, "rays", f->ray, MOST_RAYS);
    FUZZ_CHECK(cgt_occluded_rays(f->scene, &rays, occluded, options) == CGT_OK, "rays are refused");
    check_work(f, "occluded rays", f->ray, MOST_RAYS);
    FUZZ_CHECK(trace_array(f->scene, f->ray, 1, hit, options) == CGT_OK, "a ray is refused");
    check_work(f, "a single ray", f->ray, 1);
}

static void trace_light(fuzz_cliff *f, const cgt_camera_rays *camera, const float *t, const uint32_t *primitive,
                        const cgt_trace_options *options)
{
    truth_ray lit[EDGE * EDGE];
    uint8_t occluded[EDGE * EDGE];
    uint32_t count = 0;
    cgt_light light = {.kind = CGT_LIGHT_POINT};
    for (int a = 0; a < 3; a++)
        light.position[a] = camera->eye[a] + 2 * f->group[0].extent * random_float(&f->random, -1, 1);
    for (uint32_t k = 0; k < EDGE * EDGE; k++) {
        const truth_ray eye = camera_ray(camera, k % EDGE, k / EDGE);
        lit[count] = (truth_ray){.t_max = 1};
        for (int a = 0; a < 3; a++) {
            lit[count].org[a] = eye.org[a] + t[k] * eye.dir[a];
            lit[count].dir[a] = light.position[a] - lit[count].org[a];
        }
        count += primitive[k] != CGT_INVALID_ID;
    }
    const cgt_points points = {
        .count = count, .stride = sizeof *lit, .position = {&lit->org[0], &lit->org[1], &lit->org[2]}};
    FUZZ_CHECK(cgt_occluded_points(f->scene, &light, &points, occluded, options) == CGT_OK, "points are refused");
    check_work(f, "light", lit, count);
}

static void trace_camera(fuzz_cliff *f, const cgt_trace_options *options)
{
    const group *at = &f->group[fuzz_below(&f->bytes, f->groups)];
    const float away = any_size(f, -4, 12);
    float t[EDGE * EDGE], toward[3];
    uint32_t primitive[EDGE * EDGE];
    char message[CGT_CAMERA_MESSAGE_BYTES];
    truth_ray rays[EDGE * EDGE];
    cgt_camera_rays camera_rays;
    cgt_camera camera;
    cgt_frame frame;
    cgt_camera_init(&camera);
    cgt_frame_init(&frame, EDGE, EDGE);
    frame.t = t;
    frame.primitive = primitive;
    random_direction(&f->random, toward);
    for (int a = 0; a < 3; a++) {
        camera.target[a] = at->middle[a];
        camera.eye[a] = at->middle[a] + away * at->extent * toward[a];
    }
    if (cgt_camera_prepare(&camera, EDGE, EDGE, &camera_rays, message) != CGT_OK)
        return;
    FUZZ_CHECK(cgt_trace_camera(f->scene, &camera, &frame, options) == CGT_OK, "a camera is refused");
    for (uint32_t k = 0; k < EDGE * EDGE; k++)
        rays[k] = camera_ray(&camera_rays, k % EDGE, k / EDGE);
    check_work(f, "camera", rays, EDGE * EDGE);
    trace_light(f, &camera_rays, t, primitive, options);
}

static void trace_all(fuzz_cliff *f)
{
    const cgt_research_trace_options research = {.statistics = &f->research};
    const cgt_trace_options options = {.statistics = &f->trace, .research = &research};
    cgt_scene_statistics st;
    FUZZ_CHECK(cgt_scene_commit(f->scene) == CGT_OK, "the commit fails");
    trace_camera(f, &options);
    make_rays(f);
    trace_rays(f, &options);
    FUZZ_CHECK(cgt_scene_get_statistics(f->scene, &st) == CGT_OK, "no statistics");
    FUZZ_CHECK(st.structure_bytes + st.bvh_bytes <= MOST_SCENE_BYTES + (size_t)MOST_PRIMITIVE_BYTES * f->balls,
               "%zu and %zu bytes for %u primitives", st.structure_bytes, st.bvh_bytes, f->balls);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_cliff *f = fuzz_allocate(sizeof *f);
    cgt_context *context = NULL;
    memset(f, 0, sizeof *f);
    f->bytes = fuzz_bytes_of(data, size);
    const uint8_t how = fuzz_byte(&f->bytes);
    const cgt_scene_options scene_options = cliff_structure_options(how & 1 ? CLIFF_BVH : CLIFF_AUTO);
    FUZZ_CHECK(cgt_context_create(&(cgt_context_options){.threads = 1}, &context) == CGT_OK, "no context");
    FUZZ_CHECK(cgt_scene_create(context, &scene_options, &f->scene) == CGT_OK, "no scene");
    for (uint32_t k = 0; k <= (uint32_t)(how >> 1) % MOST_GROUPS; k++)
        make_group(f);
    trace_all(f);
    cgt_scene_release(f->scene);
    cgt_context_release(context);
    for (uint32_t k = 0; k < f->groups; k++)
        free(f->group[k].data);
    free(f);
    return 0;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Troubles of places and sizes: primitives far away, crowded, of all sizes; whole scenes scaled or moved; an eye or a
 * light at an odd place. */
#include "support/cliffs/cliffs.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

static const float origin[3] = {0, 0, 0};

/* How much larger a primitive has to become so that a triangle still has area at this distance. Spheres stay. */
static float visible_from(const cliff_scene *s, float distance)
{
    return s->base == CLIFF_CLOUD || s->base == CLIFF_STICKS ? 1 : fmaxf(1, distance * 1e-3f / s->size);
}

static void random_place(test_random *r, float reach, float place[3])
{
    for (int a = 0; a < 3; a++)
        place[a] = random_float(r, -1, 1) * reach;
}

/* ---- far away ---- */

void cliff_one_stray(cliff_scene *s, test_random *r, float amount)
{
    const float place[3] = {amount, -amount / 2, amount / 4};
    (void)r;
    cliff_place(s, s->count / 2, place, visible_from(s, amount));
}

/* One primitive of a hundred. */
void cliff_strays(cliff_scene *s, test_random *r, float amount)
{
    for (uint32_t i = 50; i < s->count; i += 100) {
        float place[3];
        random_place(r, amount, place);
        cliff_place(s, i, place, visible_from(s, amount));
    }
}

/* The ground: a sphere or a lying capsule of this radius that touches the scene from below, or a square of two
 * triangles. */
void cliff_giant(cliff_scene *s, test_random *r, float amount)
{
    float *p = s->data + (size_t)(s->count - 2) * cliff_floats(s);
    (void)r;
    if (s->base == CLIFF_STICKS) {
        const float capsule[8] = {-amount, -1 - amount, 0, amount, amount, -1 - amount, 0, amount};
        memcpy(p, capsule, sizeof capsule);
        return;
    }
    if (s->base == CLIFF_CLOUD) {
        const float sphere[4] = {0, -1 - amount, 0, amount};
        memcpy(s->data + (size_t)(s->count - 1) * 4, sphere, sizeof sphere);
        return;
    }
    for (int k = 0; k < 6; k++) { /* corners 0, 1, 2 and 1, 2, 3 */
        const int corner = k % 3 + k / 3;
        p[3 * k] = corner % 2 ? amount : -amount;
        p[3 * k + 1] = -1;
        p[3 * k + 2] = corner / 2 ? amount : -amount;
    }
}

/* Eight clusters, one at the origin, the others at corners of a cube. */
void cliff_far_clusters(cliff_scene *s, test_random *r, float amount)
{
    (void)r;
    for (uint32_t i = 0; i < s->count; i++) {
        float m[3];
        cliff_middle(s, i, m);
        for (uint32_t a = 0; a < 3; a++)
            m[a] += i >> a & 1 ? amount : 0;
        cliff_place(s, i, m, i % 8 ? visible_from(s, amount) : 1);
    }
}

/* All but 64 primitives in a small part of the world. */
static void make_dense(cliff_scene *s, float amount)
{
    for (uint32_t i = 64; i < s->count; i++) {
        float m[3];
        cliff_middle(s, i, m);
        for (int a = 0; a < 3; a++)
            m[a] *= amount;
        cliff_place(s, i, m, amount);
    }
}

void cliff_dense_near(cliff_scene *s, test_random *r, float amount)
{
    (void)r;
    make_dense(s, amount);
    cliff_look(s, origin, amount);
}

void cliff_dense_whole(cliff_scene *s, test_random *r, float amount)
{
    (void)r;
    make_dense(s, amount);
}

/* Half the primitives around, the others in a small part of the ground that is looked at. */
void cliff_stadium(cliff_scene *s, test_random *r, float amount)
{
    const float ball[3] = {0.25f, -1, 0.5f};
    for (uint32_t i = 0; i < s->count; i++) {
        float m[3];
        random_place(r, 1, m);
        m[1] = -1;
        for (int a = 0; a < 3 && i % 2; a++)
            m[a] = ball[a] + amount * random_float(r, -1, 1);
        cliff_place(s, i, m, i % 2 ? amount : 1);
    }
    cliff_look(s, ball, amount);
}

/* ---- sizes ---- */

/* Sizes over 60 powers of two, evenly spread. */
void cliff_octaves(cliff_scene *s, test_random *r, float amount)
{
    (void)r;
    for (uint32_t i = 0; i < s->count; i++) {
        float m[3];
        cliff_middle(s, i, m);
        cliff_place(s, i, m, ldexpf(1, -(int)(i % (uint32_t)amount)));
    }
}

/* The same, each octave the smaller scene around the origin. */
void cliff_nested_octaves(cliff_scene *s, test_random *r, float amount)
{
    (void)r;
    for (uint32_t i = 0; i < s->count; i++) {
        const float factor = ldexpf(1, -(int)(i % (uint32_t)amount));
        float m[3];
        cliff_middle(s, i, m);
        for (int a = 0; a < 3; a++)
            m[a] *= factor;
        cliff_place(s, i, m, factor);
    }
}

/* Nine primitives each of 15 sizes, each size `amount` times the one before, around the scene. */
void cliff_levels(cliff_scene *s, test_random *r, float amount)
{
    float factor = 1;
    for (uint32_t i = 0; i < 15 * 9 && i < s->count / 2; i++) {
        float d[3];
        if (i % 9 == 0)
            factor *= amount;
        random_direction(r, d);
        for (int a = 0; a < 3; a++)
            d[a] *= 4 + 3 * factor * s->size;
        cliff_place(s, i, d, factor);
    }
}

/* From a few times the usual size down to `amount` of that, as many of each power of two. */
void cliff_log_sizes(cliff_scene *s, test_random *r, float amount)
{
    for (uint32_t i = 0; i < s->count; i++) {
        float m[3];
        cliff_middle(s, i, m);
        cliff_place(s, i, m, 3 * random_log(r, amount, 1));
    }
}

/* Distances from the origin down to `amount`, as many of each power of two, and sizes to match. */
void cliff_self_similar(cliff_scene *s, test_random *r, float amount)
{
    for (uint32_t i = 0; i < s->count; i++) {
        const float distance = random_log(r, amount, 1);
        float d[3];
        random_direction(r, d);
        for (int a = 0; a < 3; a++)
            d[a] *= distance;
        cliff_place(s, i, d, 0.05f * distance / s->size);
    }
}

/* At a distance from the middle, in any direction. */
static void place_around(cliff_scene *s, test_random *r, uint32_t i, float distance)
{
    float d[3];
    random_direction(r, d);
    for (int a = 0; a < 3; a++)
        d[a] *= distance;
    cliff_place(s, i, d, 0.1f);
}

/* A halo: distances as those of cliff_self_similar, all of one size. */
void cliff_halo(cliff_scene *s, test_random *r, float amount)
{
    for (uint32_t i = 0; i < s->count; i++)
        place_around(s, r, i, random_log(r, amount, 1));
}

/* Plummer's sphere of this radius, "On the problem of distribution in globular star clusters", 1911. */
void cliff_plummer(cliff_scene *s, test_random *r, float amount)
{
    for (uint32_t i = 0; i < s->count; i++)
        place_around(s, r, i, amount / sqrtf(powf(random_float(r, 1e-4f, 1), -2.f / 3) - 1 + 1e-6f));
}

/* All so big that they overlap. */
void cliff_big(cliff_scene *s, test_random *r, float amount)
{
    (void)r;
    for (uint32_t i = 0; i < s->count; i++) {
        float m[3];
        cliff_middle(s, i, m);
        cliff_place(s, i, m, amount / s->size);
    }
}

/* ---- crowds ---- */

/* Copies of one primitive. */
void cliff_copies(cliff_scene *s, test_random *r, float amount)
{
    const uint32_t floats = cliff_floats(s);
    const float place[3] = {0.1f, 0.2f, -0.3f};
    (void)r;
    cliff_place(s, 0, place, amount / s->size);
    for (uint32_t i = 1; i < s->count; i++)
        memcpy(s->data + (size_t)i * floats, s->data, floats * sizeof(float));
}

/* Like ones, at almost the same place. */
void cliff_nearly_point(cliff_scene *s, test_random *r, float amount)
{
    for (uint32_t i = 0; i < s->count; i++) {
        float place[3];
        random_place(r, amount, place);
        cliff_place(s, i, place, 0.3f / s->size);
    }
}

/* One within the other. */
void cliff_concentric(cliff_scene *s, test_random *r, float amount)
{
    const uint32_t floats = cliff_floats(s);
    (void)r;
    cliff_place(s, 0, origin, 1);
    for (uint32_t i = 1; i < s->count; i++)
        memcpy(s->data + (size_t)i * floats, s->data, floats * sizeof(float));
    for (uint32_t i = 0; i < s->count; i++)
        cliff_place(s, i, origin, amount * (1 - 0.5f * (float)i / (float)s->count) / s->size);
}

/* Middles times these factors, the third one of another axis, along x instead. */
static void flatten(cliff_scene *s, const float onto[3][3])
{
    for (uint32_t i = 0; i < s->count; i++) {
        float from[3], m[3];
        cliff_middle(s, i, from);
        for (int a = 0; a < 3; a++)
            m[a] = onto[a][0] * from[0] + onto[a][1] * from[1] + onto[a][2] * from[2];
        cliff_place(s, i, m, 1);
    }
}

void cliff_line(cliff_scene *s, test_random *r, float amount)
{
    const float onto[3][3] = {{1, 0, 0}, {0.7f, 0, 0}, {-0.6f, 0, 0}};
    (void)r;
    (void)amount;
    flatten(s, onto);
}

void cliff_axis_line(cliff_scene *s, test_random *r, float amount)
{
    const float onto[3][3] = {{1, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    (void)r;
    (void)amount;
    flatten(s, onto);
}

void cliff_plane(cliff_scene *s, test_random *r, float amount)
{
    const float onto[3][3] = {{1, 0, 0}, {0, 0, 0}, {0, 0, 1}};
    (void)r;
    (void)amount;
    flatten(s, onto);
}

void cliff_tilted_plane(cliff_scene *s, test_random *r, float amount)
{
    const float onto[3][3] = {{1, 0, 0}, {0.6f, 0, 0.3f}, {0, 0, 1}};
    (void)r;
    (void)amount;
    flatten(s, onto);
}

/* ---- everything ---- */

void cliff_scale(cliff_scene *s, test_random *r, float amount)
{
    (void)r;
    for (size_t k = 0; k < (size_t)s->count * cliff_floats(s); k++)
        s->data[k] *= amount;
    s->size *= amount;
    cliff_look(s, origin, amount);
}

void cliff_translate(cliff_scene *s, test_random *r, float amount)
{
    const float by[3] = {amount, -amount, amount / 2};
    (void)r;
    for (uint32_t i = 0; i < s->count; i++) {
        float m[3];
        cliff_middle(s, i, m);
        for (int a = 0; a < 3; a++)
            m[a] += by[a];
        cliff_place(s, i, m, 1);
    }
    cliff_look(s, by, 1);
}

/* ---- eye and light ---- */

/* Everything so big, and the eye among it. */
void cliff_eye_inside(cliff_scene *s, test_random *r, float amount)
{
    cliff_big(s, r, amount);
    for (int a = 0; a < 3; a++)
        s->camera.eye[a] *= 0.1f;
}

/* Sizes whose logarithms have this deviation around the usual one's, and the eye among them. */
void cliff_log_normal(cliff_scene *s, test_random *r, float amount)
{
    for (uint32_t i = 0; i < s->count; i++) {
        const float deviation = sqrtf(-2 * logf(random_float(r, 1e-6f, 1))), angle = random_float(r, 0, 2 * (float)PI);
        float m[3];
        cliff_middle(s, i, m);
        cliff_place(s, i, m, expf(amount * deviation * cosf(angle)));
    }
    for (int a = 0; a < 3; a++)
        s->camera.eye[a] *= 0.1f;
}

/* From so far away, with as narrow an angle as shows the same picture. */
void cliff_eye_far(cliff_scene *s, test_random *r, float amount)
{
    float *eye = s->camera.eye;
    const double before = sqrt((double)(eye[0] * eye[0] + eye[1] * eye[1] + eye[2] * eye[2]));
    const double half = before * tan((double)s->camera.fov * PI / 360);
    (void)r;
    for (int a = 0; a < 3; a++)
        eye[a] = (float)((double)eye[a] * (double)amount / before);
    s->camera.fov = (float)(360 / PI * atan(half / (double)amount));
    s->camera.height = (float)(2 * half);
}

void cliff_eye_far_parallel(cliff_scene *s, test_random *r, float amount)
{
    cliff_eye_far(s, r, amount);
    s->camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
}

/* On a sphere's surface, or in a triangle's plane. */
void cliff_eye_on_surface(cliff_scene *s, test_random *r, float amount)
{
    const float *p = s->data;
    (void)r;
    memcpy(s->camera.eye, p, sizeof s->camera.eye);
    if (s->base != CLIFF_CLOUD)
        return;
    s->camera.eye[0] -= p[3] * sqrtf(1 - amount * amount);
    s->camera.eye[2] -= p[3] * amount;
}

/* A room around the scene, and a lamp beside it: a sphere for spheres, else twelve triangles. turn: tilts it. */
static void add_room(cliff_scene *s, float amount, const float turn[3][3])
{
    float *p = s->data + (size_t)(s->count - 12) * 9;
    if (s->base == CLIFF_CLOUD) {
        const float sphere[4] = {0, 0, 0, amount};
        memcpy(s->data + (size_t)(s->count - 1) * 4, sphere, sizeof sphere);
    } else
        for (int side = 0; side < 6; side++)
            for (int k = 0; k < 6; k++, p += 3) { /* corners 0, 1, 2 and 1, 2, 3 */
                const int corner = k % 3 + k / 3, axis = side / 2;
                float q[3];
                q[axis] = side % 2 ? amount : -amount;
                q[(axis + 1) % 3] = corner % 2 ? amount : -amount;
                q[(axis + 2) % 3] = corner / 2 ? amount : -amount;
                for (int a = 0; a < 3; a++)
                    p[a] = turn[a][0] * q[0] + turn[a][1] * q[1] + turn[a][2] * q[2];
            }
    for (int a = 0; a < 3; a++)
        s->light[a] = a == 2 ? -1.5f : 1.5f;
}

void cliff_room(cliff_scene *s, test_random *r, float amount)
{
    static const float turn[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    (void)r;
    add_room(s, amount, turn);
}

void cliff_tilted_room(cliff_scene *s, test_random *r, float amount)
{
    static const float turn[3][3] = {{0.8f, -0.36f, 0.48f}, {0.6f, 0.48f, -0.64f}, {0, 0.8f, 0.6f}};
    (void)r;
    add_room(s, amount, turn);
}

void cliff_far_light(cliff_scene *s, test_random *r, float amount)
{
    (void)r;
    for (int a = 0; a < 3; a++)
        s->light[a] *= amount;
}

void cliff_light_inside(cliff_scene *s, test_random *r, float amount)
{
    (void)r;
    for (int a = 0; a < 3; a++)
        s->light[a] = amount;
}

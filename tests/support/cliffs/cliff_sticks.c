/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Troubles of capsules: long ones, bundles, one within the other, bonds that are listed from both of their atoms. */
#include "support/cliffs/cliffs.h"

#include <math.h>
#include <string.h>

static void put_stick(cliff_scene *s, uint32_t i, const float from[3], const float to[3], float radius)
{
    float *p = s->data + (size_t)8 * i;
    for (int a = 0; a < 3; a++) {
        p[a] = from[a];
        p[4 + a] = to[a];
    }
    p[3] = p[7] = radius;
}

/* One through the scene, so long. */
void cliff_one_long(cliff_scene *s, test_random *r, float amount)
{
    const float from[3] = {-amount / 2, 0.1f, 0.1f}, to[3] = {amount / 2, 0.2f, 0.1f};
    (void)r;
    put_stick(s, s->count / 2, from, to, 0.01f);
}

/* As long as the scene, and so thin. */
void cliff_needles(cliff_scene *s, test_random *r, float amount)
{
    for (uint32_t i = 0; i < s->count; i++) {
        float d[3], from[3], to[3];
        random_direction(r, d);
        for (int a = 0; a < 3; a++) {
            const float middle = random_float(r, -1, 1);
            from[a] = middle - d[a];
            to[a] = middle + d[a];
        }
        put_stick(s, i, from, to, amount);
    }
}

/* As long as the scene, side by side: along the view, or, where amount is 1, along a diagonal of it. */
void cliff_parallel(cliff_scene *s, test_random *r, float amount)
{
    const float lean = amount * 0.577f, half = amount > 0 ? 0.577f : 1;
    for (uint32_t i = 0; i < s->count; i++) {
        const float x = random_float(r, -1, 1), y = random_float(r, -1, 1);
        const float from[3] = {x - lean, y - lean, -half}, to[3] = {x + lean, y + lean, half};
        put_stick(s, i, from, to, 1e-3f);
    }
}

/* One within the other, with radii up to this one. */
void cliff_coaxial(cliff_scene *s, test_random *r, float amount)
{
    static const float from[3] = {-0.5f, 0, 0}, to[3] = {0.5f, 0, 0};
    (void)r;
    for (uint32_t i = 0; i < s->count; i++)
        put_stick(s, i, from, to, amount * (0.5f + 0.5f * (float)i / (float)s->count));
}

/* The same, seen from their axis. */
void cliff_coaxial_inside(cliff_scene *s, test_random *r, float amount)
{
    cliff_coaxial(s, r, amount);
    for (int a = 0; a < 3; a++)
        s->camera.eye[a] *= a ? 0 : 0.05f;
    s->camera.target[2] = 1;
}

/* The second half are the first ones, from the other end. */
void cliff_listed_twice(cliff_scene *s, test_random *r, float amount)
{
    const uint32_t half = s->count / 2;
    (void)r, (void)amount;
    for (uint32_t i = 0; i < half; i++) {
        const float *p = s->data + (size_t)8 * i;
        put_stick(s, half + i, p + 4, p, p[3]);
    }
}

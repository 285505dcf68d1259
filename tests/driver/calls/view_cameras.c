/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cameras that are hard on a scene, and the sizes of their frames. */
#include <math.h>

#include "driver/calls/view.h"

/* From so far away that a length fills the picture, or a part of it. */
static void look_from_afar(judge_scene *s, cgt_camera *c)
{
    test_random *const r = &s->random;
    float other[3], out[3], size = 0;
    line_place(s, other);
    random_direction(r, out);
    for (int a = 0; a < 3; a++)
        size = fmaxf(size, fabsf(other[a] - c->target[a]));
    const float far =
        (size > 0 && random_below(r, 2) ? size : s->scale) * random_log(r, 1, random_below(r, 2) ? 1e4f : 1e12f);
    for (int a = 0; a < 3; a++)
        c->eye[a] = c->target[a] + far * out[a];
    c->fov = fmaxf(1e-6f, fminf(179, 115 * atanf(size / far * random_log(r, 0.01f, 3))));
    c->height = size * random_log(r, 0.01f, 10);
}

/* Along an axis or a diagonal, from outside or away from it, where the scene is behind. */
static void look_along(judge_scene *s, cgt_camera *c)
{
    test_random *r = &s->random;
    const float far = s->scale * (random_below(r, 4) ? 3 : -3);
    float d[3] = {0, 0, 0};
    while (d[0] == 0 && d[1] == 0 && d[2] == 0)
        for (int a = 0; a < 3; a++)
            d[a] = (float)random_below(r, 3) - 1;
    for (int a = 0; a < 3; a++) {
        c->target[a] = s->middle[a];
        c->eye[a] = s->middle[a] - far * d[a];
        c->target[a] += far < 0 ? -2 * far * d[a] : 0;
        c->up[a] = d[(a + 1) % 3] != 0 && d[a] == 0 ? 1 : 0.25f * (float)a;
    }
}

/* As a ray does that is there already. */
static void look_along_ray(driver_run *run, cgt_camera *c)
{
    const truth_ray *const line = &run->ray[random_below(&run->scene.random, run->rays)].line;
    for (int a = 0; a < 3; a++) {
        c->eye[a] = line->org[a];
        c->target[a] = line->org[a] + line->dir[a];
        c->up[a] = a ? 0 : 1;
    }
}

/* As the scene is made for. */
static void look_as_aimed(driver_run *run, driver_view *w)
{
    cgt_camera *const c = &w->camera;
    const bool cone = run->scene.aims == SCENE_AIMS_CONE;
    for (int a = 0; a < 3; a++) {
        c->eye[a] = 0;
        c->target[a] = a == 2;
        c->up[a] = a == 1;
    }
    c->fov = 90;
    c->height = 2;
    c->projection = cone ? CGT_PROJECTION_PERSPECTIVE : CGT_PROJECTION_ORTHOGRAPHIC;
    w->width = w->height = w->rows = 64;
    w->first_row = 0;
    w->pixels = w->width * w->height;
}

static void make_camera(driver_run *run, driver_view *w)
{
    static const float fov[] = {1e-4f, 0.1f, 90, 150, 175, 179, 179.9f, 179.999f};
    judge_scene *s = &run->scene;
    test_random *r = &s->random;
    const uint32_t how = random_below(r, 6);
    cgt_camera *c = &w->camera;
    cgt_camera_init(c);
    line_place(s, c->target);
    for (int a = 0; a < 3; a++)
        c->eye[a] = how > 1 ? 3 * s->scale * line_gauss(r) : c->target[a] + (a == 2 ? 3 * s->scale : 0);
    if (how == 1)
        line_place(s, c->eye);
    if (how > 3)
        line_place_beside(s, c->target, c->eye);
    if (random_below(r, 3) == 0)
        random_direction(r, c->up);
    if (random_below(r, 6) == 0)
        look_along(s, c);
    if (run->profile->pixels && random_below(r, 4) == 0)
        look_along_ray(run, c);
    c->fov = random_below(r, 4) ? random_float(r, 5, 130) : fov[random_below(r, TEST_COUNT(fov))];
    c->projection = random_below(r, 3) ? CGT_PROJECTION_PERSPECTIVE : CGT_PROJECTION_ORTHOGRAPHIC;
    c->height = s->scale * random_float(r, 0.1f, 4);
    if (run->profile->pixels && random_below(r, 4) == 0)
        look_from_afar(s, c);
    c->height = c->height > 1e-37f && c->height < 1e36f ? c->height : 1;
    c->mask = random_below(r, 5) ? 0 : random_below(r, 16);
    if (random_below(r, 4) == 0)
        c->t_min = random_float(r, 0, 4);
    if (random_below(r, 4) == 0)
        c->t_max = c->t_min + random_float(r, 0, 4);
}

/* Of the rows in the middle of a frame so large that its pixels are as near as the rounding of directions. */
static void zoom(test_random *r, driver_view *w)
{
    w->camera.fov = random_log(r, 0.12f, 5);
    w->width = w->height = 1024u << random_below(r, 4);
    w->rows = 1 + random_below(r, 3) % (DRIVER_PIXELS / w->width);
    w->first_row = w->height / 2 - random_below(r, 4);
}

static void choose_size(driver_run *run, driver_view *w)
{
    test_random *const r = &run->scene.random;
    const uint32_t most = run->profile->pixels;
    const bool large = most && random_below(r, 3);
    w->width = 2 + random_below(r, large ? 200 : random_below(r, 3) ? 30 : 120);
    const uint32_t rows = (large ? most : DRIVER_SMALL) / w->width, limit = large ? 200 : 24;
    w->height = 1 + random_below(r, rows < limit ? rows : limit);
    if (random_below(r, 4) == 0) { /* tall */
        const uint32_t width = w->width;
        w->width = w->height;
        w->height = width;
    }
    w->first_row = 0;
    w->rows = w->height;
    if (most && random_below(r, 5) == 0)
        zoom(r, w);
    w->pixels = w->width * w->rows;
    if (run->scene.aims && most && random_below(r, 4))
        look_as_aimed(run, w);
    w->every = driver_every(run, w->pixels, DRIVER_SAMPLE);
}

void driver_camera_make(driver_run *run, driver_view *w)
{
    make_camera(run, w);
    choose_size(run, w);
}

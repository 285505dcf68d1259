/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cameras: their rays, and pictures from hard positions: along the axes and diagonals, from inside, with the scene
 * behind, with fields of view near 0 and 180 degrees, with clipped ranges. Brute force judges the pixels. */
#include "support/scenes.h"
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static cgt_context *context;

static int open_context(void **state)
{
    (void)state;
    context = context_make(2, NULL);
    return 0;
}

static int close_context(void **state)
{
    (void)state;
    cgt_context_release(context);
    return 0;
}

/* ---- rays ---- */

typedef long double vec3[3];

static void cross(const vec3 a, const vec3 b, vec3 c)
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void normalise(vec3 a)
{
    const long double length = sqrtl(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (int i = 0; i < 3; i++)
        a[i] /= length;
}

/* The public formula, in long double. */
static void formula_ray(const cgt_camera *c, uint32_t width, uint32_t height, uint32_t x, uint32_t y, vec3 org,
                        vec3 dir)
{
    vec3 fwd, right, up = {c->up[0], c->up[1], c->up[2]};
    for (int i = 0; i < 3; i++)
        fwd[i] = (long double)c->target[i] - c->eye[i];
    normalise(fwd);
    cross(fwd, up, right);
    normalise(right);
    cross(right, fwd, up);
    const bool flat = c->projection == CGT_PROJECTION_ORTHOGRAPHIC;
    const long double h =
        flat ? (long double)c->height / 2 : tanl((long double)c->fov * 3.14159265358979323846264338L / 360);
    const long double px = (2 * (x + 0.5L) / width - 1) * h * width / height, py = (1 - 2 * (y + 0.5L) / height) * h;
    for (int i = 0; i < 3; i++) {
        const long double sum = px * right[i] + py * up[i];
        org[i] = c->eye[i] + (flat ? sum : 0);
        dir[i] = fwd[i] + (flat ? 0 : sum);
    }
}

TEST(rays_match_the_formula)
{
    for (uint32_t round = 0; round < test_scaled(400); round++) {
        test_random r = random_make(round);
        const cloud c = {.reach = random_log(&r, 0.01f, 1000)};
        const cgt_camera camera = camera_random(&r, &c);
        const uint32_t width = 1 + random_below(&r, 40), height = 1 + random_below(&r, 40);
        truth_ray *rays = frame_rays(&camera, width, height);
        for (uint32_t i = 0; i < width * height; i++) {
            vec3 org, dir;
            formula_ray(&camera, width, height, i % width, i / width, org, dir);
            /* the field of view limits the lengths of right and up */
            const double half = camera.projection == CGT_PROJECTION_ORTHOGRAPHIC
                                    ? 0.5 * (double)camera.height
                                    : tan((double)camera.fov * 3.14159265358979 / 360);
            const double longest = 1 + half * (1 + (double)width / height);
            double eye = 0;
            for (int a = 0; a < 3; a++)
                eye = fmax(eye, fabs((double)camera.eye[a]));
            for (int a = 0; a < 3; a++) {
                assert_true(fabs((double)(rays[i].dir[a] - dir[a])) <= 4 * 0x1p-24 * longest);
                assert_true(fabs((double)(rays[i].org[a] - org[a])) <= 4 * 0x1p-24 * (longest + eye));
            }
        }
        free(rays);
    }
}

TEST(frames_match_arrays_of_the_same_rays)
{
    static const uint32_t size[][2] = {{1, 1}, {1, 70}, {200, 3}, {64, 64}, {65, 66}, {131, 67}, {17, 5}, {1300, 6}};
    for (uint32_t round = 0; round < test_scaled(6) * TEST_COUNT(size); round++) {
        test_random r = random_make(round);
        cloud c = cloud_make(&r, (cloud_kind)(round % CLOUD_KINDS), 300);
        const cgt_camera camera = camera_random(&r, &c);
        planes p = planes_make(size[round % TEST_COUNT(size)][0], size[round % TEST_COUNT(size)][1]);
        truth_ray *rays = frame_rays(&camera, p.width, p.height);
        ray_hit *hits = malloc(p.elements * sizeof *hits);
        const cgt_scene_options made = structure_in_turn(round + round / (uint32_t)TEST_COUNT(size));
        cgt_scene *scene = scene_of(context, &made, (const float(*)[4])c.sphere, c.count);
        assert_non_null(hits);
        frame_trace(scene, &camera, &p, NULL);
        rays_trace(scene, rays, p.elements, hits, NULL);
        for (size_t i = 0; i < p.elements; i++) {
            assert_true(same_bits(p.t[i], hits[i].t));
            assert_int_equal(p.primitive[i], hits[i].primitive);
            assert_int_equal(p.geometry[i], hits[i].geometry);
            for (int a = 0; a < 3; a++)
                assert_true(same_bits(p.normal[a][i], hits[i].normal[a]));
        }
        cgt_scene_release(scene);
        free(hits);
        free(rays);
        planes_free(&p);
        cloud_free(&c);
    }
}

/* ---- positions ---- */

static uint32_t count_hits(const planes *p)
{
    uint32_t hits = 0;
    for (size_t i = 0; i < p->elements; i++)
        hits += p->primitive[i] != CGT_INVALID_ID;
    return hits;
}

/* Traces with both loops and checks the pixels; returns the number of hits. */
static uint32_t look(const cgt_scene *scene, const cgt_camera *camera, const cloud *c, const planes *p)
{
    truth_ray *rays = frame_rays(camera, p->width, p->height);
    planes other = planes_make(p->width, p->height);
    test_trace_options options = {0};
    options.loop = CGT_LOOP_FLATTENED;
    frame_trace(scene, camera, p, NULL);
    frame_trace(scene, camera, &other, TRACE_OPTIONS(&options));
    assert_true(planes_equal(p, &other));
    frame_judge(p, rays, (const float(*)[4])c->sphere, c->count);
    planes_free(&other);
    free(rays);
    return count_hits(p);
}

static void point_camera(cgt_camera *camera, int direction, const float middle[3], float distance)
{
    const float d[3] = {(float)(direction % 3 - 1), (float)(direction / 3 % 3 - 1), (float)(direction / 9 - 1)};
    for (int a = 0; a < 3; a++) {
        camera->target[a] = middle[a] + (distance == 0 ? d[a] : 0);
        camera->eye[a] = middle[a] - distance * d[a];
    }
    /* the axis that d is most nearly orthogonal to */
    memcpy(camera->up, (float[3]){0, 1, 0}, sizeof camera->up);
    if (d[1] != 0)
        memcpy(camera->up, d[0] == 0 ? (float[3]){1, 0, 0} : (float[3]){0, 0, d[2] == 0 ? 1.f : -1.f},
               sizeof camera->up);
}

TEST(along_26_directions)
{
    test_random r = random_make(1);
    planes p = planes_make(33, 21);
    for (uint32_t kind = 0; kind < 3 && kind < test_scaled(3); kind++) {
        cloud c = cloud_make(&r, kind == 0 ? CLOUD_LATTICE : kind == 1 ? CLOUD_UNIFORM : CLOUD_PLANAR, 200);
        cgt_scene *scenes[4]; /* one of each structure */
        for (uint32_t k = 0; k < TEST_COUNT(scenes); k++) {
            const cgt_scene_options made = structure_in_turn(k);
            scenes[k] = scene_of(context, &made, (const float(*)[4])c.sphere, c.count);
        }
        for (int direction = 0; direction < 27; direction++)
            for (int place = 0; place < 3; place++) { /* outside, at the centre, orthographic from inside */
                cgt_camera camera;
                const cgt_scene *scene = scenes[(size_t)(direction + place) % TEST_COUNT(scenes)];
                if (direction == 13)
                    continue; /* no direction */
                cgt_camera_init(&camera);
                point_camera(&camera, direction, c.middle, place == 0 ? 3 * c.reach : 0);
                camera.fov = 50;
                if (place == 2)
                    camera.projection = CGT_PROJECTION_ORTHOGRAPHIC, camera.height = 2 * c.reach;
                const uint32_t hits = look(scene, &camera, &c, &p);
                assert_true(kind != 1 || hits > 0);
                if (place)
                    continue;
                for (int a = 0; a < 3; a++)
                    camera.target[a] = 2 * camera.eye[a] - camera.target[a]; /* turned around */
                camera.fov = 20;
                assert_int_equal(look(scene, &camera, &c, &p), 0);
            }
        for (size_t k = 0; k < TEST_COUNT(scenes); k++)
            cgt_scene_release(scenes[k]);
        cloud_free(&c);
    }
    planes_free(&p);
}

TEST(wide_and_narrow_fields_of_view)
{
    static const float fov[] = {1e-4f, 0.1f, 90, 150, 175, 179, 179.9f, 179.999f};
    planes p = planes_make(40, 27);
    for (uint32_t round = 0; round < test_scaled(5) * TEST_COUNT(fov); round++) {
        test_random r = random_make(round);
        cloud c = cloud_make(&r, CLOUD_UNIFORM, 400);
        cgt_camera camera = camera_random(&r, &c);
        camera.projection = CGT_PROJECTION_PERSPECTIVE;
        camera.fov = fov[round % TEST_COUNT(fov)];
        const cgt_scene_options made = structure_in_turn(round + round / (uint32_t)TEST_COUNT(fov));
        cgt_scene *scene = scene_of(context, &made, (const float(*)[4])c.sphere, c.count);
        look(scene, &camera, &c, &p);
        /* packets whose rays differ in the main axis were split, with right results */
        if (camera.fov > 170 && made.structure == CGT_STRUCTURE_QUEUE_GRID) {
            cgt_research_trace_statistics statistics;
            test_trace_options options = {0};
            options.packet = 16;
            options.research_statistics = &statistics;
            frame_trace(scene, &camera, &p, TRACE_OPTIONS(&options));
            assert_true(statistics.split_packets > 0);
        }
        cgt_scene_release(scene);
        cloud_free(&c);
    }
    planes_free(&p);
}

TEST(ranges_are_clipped)
{
    planes p = planes_make(48, 32), whole = planes_make(48, 32);
    uint32_t fewer = 0, others = 0;
    for (uint32_t round = 0; round < 16 + test_scaled(14); round++) {
        test_random r = random_make(round);
        cloud c = cloud_make(&r, CLOUD_UNIFORM, 300);
        cgt_camera camera = camera_random(&r, &c);
        const cgt_scene_options made = structure_in_turn(round);
        cgt_scene *scene = scene_of(context, &made, (const float(*)[4])c.sphere, c.count);
        const uint32_t all = look(scene, &camera, &c, &whole);
        camera.t_min = random_float(&r, 0, 3) * c.reach;
        camera.t_max = round % 3 ? camera.t_min + random_float(&r, 0, 2) * c.reach : INFINITY;
        if (round % 4 == 0 && all) { /* exactly at the hit of a pixel, with each structure */
            size_t i = random_below(&r, (uint32_t)p.elements);
            while (whole.primitive[i] == CGT_INVALID_ID)
                i = (i + 1) % p.elements;
            camera.t_min = camera.t_max = whole.t[i];
            frame_trace(scene, &camera, &p, NULL);
            assert_true(p.t[i] == whole.t[i] && p.primitive[i] == whole.primitive[i]);
        }
        fewer += look(scene, &camera, &c, &p) < all;
        for (size_t i = 0; i < p.elements; i++)
            others += p.primitive[i] != whole.primitive[i] && p.primitive[i] != CGT_INVALID_ID;
        cgt_scene_release(scene);
        cloud_free(&c);
    }
    assert_true(fewer > 0 && others > 0); /* some hits clipped away, others uncovered */
    planes_free(&p);
    planes_free(&whole);
}

/* cgt_camera_get_rays: the rays of cgt_camera_get_ray. */
TEST(rectangles_have_their_rays)
{
    enum { WIDTH = 37, HEIGHT = 23, STRIDE = 28 };
    static char memory[WIDTH * HEIGHT * STRIDE];
    float *const org[3] = {(float *)(void *)memory, (float *)(void *)(memory + 4), (float *)(void *)(memory + 8)};
    float *const dir[3] = {(float *)(void *)(memory + 12), (float *)(void *)(memory + 16),
                           (float *)(void *)(memory + 20)};
    const uint32_t rectangle[][4] = {
        {0, 0, WIDTH, HEIGHT}, {5, 7, 1, 1}, {36, 22, 1, 1}, {3, 0, 11, 23}, {37, 23, 0, 0}};
    cgt_camera camera;
    cgt_camera_init(&camera);
    for (size_t k = 0; k < 2 * TEST_COUNT(rectangle); k++) {
        const uint32_t *at = rectangle[k / 2], x = at[0], y = at[1], columns = at[2], rows = at[3];
        camera.projection = k % 2 ? CGT_PROJECTION_ORTHOGRAPHIC : CGT_PROJECTION_PERSPECTIVE;
        assert_int_equal(cgt_camera_get_rays(&camera, WIDTH, HEIGHT, x, y, columns, rows, STRIDE, org, dir), CGT_OK);
        for (uint32_t i = 0; i < columns * rows; i++) {
            float ray[2][3];
            assert_int_equal(
                cgt_camera_get_ray(&camera, WIDTH, HEIGHT, x + i % columns, y + i / columns, ray[0], ray[1]), CGT_OK);
            assert_memory_equal(memory + (size_t)i * STRIDE, ray, sizeof ray);
        }
    }
}

SEEDED_SUITE("test_camera", open_context, close_context)

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Random scenes, structures, cameras and options: every pixel and ray has the hit that brute force finds. A failure
 * names the round; the printed seed reproduces it. */
#include "support/scenes.h"

#include <stdio.h>
#include <stdlib.h>

#define WIDTH 61 /* not a multiple of a packet or a tile */
#define HEIGHT 47

static test_trace_options random_options(test_random *r)
{
    test_trace_options o = {0};
    o.packet = (uint32_t[]){0, 4, 8, 16}[random_below(r, 4)];
    o.loop = (cgt_loop)random_below(r, 3);
    o.cull = (cgt_cull)random_below(r, 3);
    o.mailbox = (cgt_mailbox)random_below(r, 3);
    o.kd_traversal = (cgt_kd_traversal)random_below(r, 3);
    o.tile = o.packet <= 4 ? (cgt_tile_shape)random_below(r, 3) : CGT_TILE_SHAPE_SQUARE;
    return o;
}

static test_scene_options random_scene_options(test_random *r)
{
    test_scene_options o = structure_random(r);
    if (o.structure == CGT_STRUCTURE_QUEUE_GRID && random_below(r, 2))
        for (int a = 0; a < 3; a++)
            o.resolution[a] = 1 + random_below(r, random_below(r, 6) ? 24 : 90);
    return o;
}

static uint32_t random_count(test_random *r)
{
    return random_below(r, 3) ? random_below(r, 400) : random_below(r, 3001);
}

/* Random rays, or fans: close rays from one origin, which become coherent packets. */
static void judge_rays(const cgt_scene *scene, const cloud *c, test_random *r, bool fan,
                       const test_trace_options *options, uint64_t *doubts)
{
    enum { RAYS = 384 };
    truth_ray ray[RAYS];
    ray_hit hit[RAYS];
    const truth_scene truth = {(const float(*)[4])c->sphere, c->count};
    for (int i = 0; i < RAYS; i++) {
        ray[i] = ray_random(r, c);
        if (!fan || i % 64 == 0)
            continue;
        const truth_ray *first = &ray[i / 64 * 64];
        const float spread = 0.01f * (float)(1 + i / 64 * 8);
        for (int a = 0; a < 3; a++) {
            ray[i].org[a] = first->org[a];
            ray[i].dir[a] = first->dir[a] * (1 + random_float(r, -spread, spread)) + 0x1p-60f;
        }
    }
    rays_trace(scene, ray, RAYS, hit, TRACE_OPTIONS(options));
    for (int i = 0; i < RAYS; i++) {
        const char *wrong = truth_judge(&truth, &ray[i], hit[i].primitive, hit[i].t, doubts);
        if (wrong)
            fail_msg("ray %d: %s (sphere %u, t %a): org %a %a %a dir %a %a %a range %a %a", i, wrong, hit[i].primitive,
                     (double)hit[i].t, (double)ray[i].org[0], (double)ray[i].org[1], (double)ray[i].org[2],
                     (double)ray[i].dir[0], (double)ray[i].dir[1], (double)ray[i].dir[2], (double)ray[i].t_min,
                     (double)ray[i].t_max);
    }
}

/* The variants share the rounds: each runs every step-th one. 3 and 2 are coprime to the number of kinds of clouds. */
static uint32_t round_step(void)
{
    uint32_t variants = 0;
    FOR_EACH_VARIANT(variant)
    variants++;
    return variants < 3 ? variants : 3;
}

static void closest_hits_are_those_of_brute_force(void **state)
{
    (void)state;
    const uint32_t rounds = 2 + test_scaled(14), step = round_step(); /* the first of each kind are nearly empty */
    uint32_t turn = 0;
    uint64_t pixels = 0, hits = 0, doubts = 0;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(2, variant);
        for (uint32_t round = test_sample_start(turn++, step); round < rounds * CLOUD_KINDS; round += step) {
            test_random r = random_make(round);
            cloud c =
                cloud_make(&r, (cloud_kind)(round % CLOUD_KINDS), round < CLOUD_KINDS ? round / 2 : random_count(&r));
            const test_scene_options scene_options = random_scene_options(&r);
            const test_trace_options options = random_options(&r);
            const cgt_camera camera = camera_random(&r, &c);
            planes p = planes_make(WIDTH, HEIGHT);
            truth_ray *rays = frame_rays(&camera, WIDTH, HEIGHT);
            cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&scene_options), (const float(*)[4])c.sphere, c.count);
            print_message("round %u of %s: %u %s spheres, structure %d\n", round, variant, c.count,
                          cloud_name((cloud_kind)(round % CLOUD_KINDS)), (int)scene_options.structure);
            frame_trace(scene, &camera, &p, TRACE_OPTIONS(&options));
            doubts += frame_judge(&p, rays, (const float(*)[4])c.sphere, c.count);
            judge_rays(scene, &c, &r, false, &options, &doubts);
            judge_rays(scene, &c, &r, true, &options, &doubts);
            for (size_t i = 0; i < p.elements; i++)
                hits += p.primitive[i] != CGT_INVALID_ID;
            pixels += p.elements;
            cgt_scene_release(scene);
            free(rays);
            planes_free(&p);
            cloud_free(&c);
        }
        cgt_context_release(context);
    }
    print_message("%llu pixels, %llu hits, %llu beyond double precision\n", (unsigned long long)pixels,
                  (unsigned long long)hits, (unsigned long long)doubts);
    assert_true(hits > pixels / 10); /* the scenes were visible */
    assert_true(doubts <= pixels / 10000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(closest_hits_are_those_of_brute_force)};
    test_begin("test_properties");
    return cmocka_run_group_tests(tests, NULL, NULL);
}

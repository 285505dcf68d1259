/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * soak [SECONDS]: pictures for as long as is wanted, 1 second without an argument.
 *
 * A round has a scene of balls, sticks and a floor that its number chooses, moves it for some steps, and makes a
 * picture, rays and shadows of each, with a context and a scene that live on, and with some that come and go. After
 * CYCLE rounds the same rounds come again: their bits must be those of the first time, and the process must not have
 * more memory or open files than after the second cycle. */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cgt/all_hits.h>
#include <cgt/picture.h>

#include "core/sanitized.h"
#include "support/frame_hash.h"
#include "support/random.h"

#define CYCLE (CGT_SANITIZED ? 6 : 24)

enum { STEPS = 3, MOST = 4000, RAYS = 3000, WIDTH = 160, HEIGHT = 96, PIXELS = WIDTH * HEIGHT };

#define KEPT_BYTES (UINT64_C(4) << 20) /* by which the process may grow: an allocator keeps some */

typedef struct round {
    float center[3 * MOST], radius[MOST], velocity[3 * MOST];
    uint32_t pair[2 * MOST], balls, sticks;
    uint64_t hash;
} round_state;

/* What lives on. */
typedef struct soak {
    cgt_context *context;
    cgt_scene *scene;
    cgt_picture *picture;
} soak;

static round_state r;

static void check(cgt_result result, const cgt_context *context, const char *what)
{
    char message[256];
    if (result == CGT_OK)
        return;
    cgt_context_get_error_message(context, message, sizeof message);
    fprintf(stderr, "soak: %s: %s %s\n", what, cgt_get_result_string(result), message);
    exit(EXIT_FAILURE);
}

static void add_bytes(const void *bytes, size_t size) { r.hash = frame_hash_bytes(r.hash, bytes, size); }

/* ---- a round's scene ---- */

static void make_round(uint32_t number)
{
    test_random random = random_make(number);
    r.hash = UINT64_C(0xcbf29ce484222325);
    r.balls = 1 + random_below(&random, MOST);
    r.sticks = random_below(&random, r.balls);
    const float spread = random_log(&random, 0.1f, 10), largest = random_log(&random, 0.01f, 0.5f);
    for (uint32_t i = 0; i < r.balls; i++) {
        const float share = random_below(&random, 4) ? 1 : 0.1f; /* some are in a cluster */
        for (int a = 0; a < 3; a++) {
            r.center[3 * i + (uint32_t)a] = share * random_float(&random, -spread, spread);
            r.velocity[3 * i + (uint32_t)a] = random_float(&random, -0.1f, 0.1f);
        }
        r.radius[i] = random_float(&random, 0.1f, 1) * largest;
    }
    for (uint32_t i = 0; i < 2 * r.sticks; i++)
        r.pair[i] = random_below(&random, r.balls);
}

static void move(void)
{
    for (uint32_t i = 0; i < 3 * r.balls; i++)
        r.center[i] += r.velocity[i];
}

static void set_scene(const cgt_context *context, cgt_scene *scene)
{
    static const float corner[4][3] = {{-9, -3, -9}, {9, -3, -9}, {9, -3, 9}, {-9, -3, 9}};
    static const uint32_t quad[6] = {0, 1, 2, 0, 2, 3};
    const cgt_spheres balls = {.count = r.balls, .centers = cgt_floats(r.center, 0), .radii = cgt_floats(r.radius, 0)};
    const cgt_capsules sticks = {.count = r.sticks,
                                 .indices = cgt_uint32s(r.pair, 0),
                                 .vertices = cgt_floats(r.center, 0),
                                 .vertex_count = r.balls,
                                 .radius = 0.01f};
    const cgt_triangles floor = {
        .count = 2, .indices = cgt_uint32s(quad, 0), .vertices = cgt_floats(corner[0], 0), .vertex_count = 4};
    const bool is_new = !cgt_scene_get_geometries(scene);
    uint32_t id[3] = {0, 1, 2};
    for (uint32_t k = 0; is_new && k < 3; k++)
        id[k] = CGT_INVALID_ID;
    check(cgt_scene_set_spheres(scene, &id[0], &balls), context, "balls");
    check(cgt_scene_set_capsules(scene, &id[1], &sticks), context, "sticks");
    check(cgt_scene_set_triangles(scene, &id[2], &floor), context, "floor");
}

/* ---- what is made of it ---- */

static void draw(cgt_picture *picture, const cgt_scene *scene)
{
    static uint8_t bytes[3 * PIXELS];
    const cgt_camera camera = {.eye = {4, 5, 12}, .fov = 60};
    const cgt_look looks[3] = {{.color = {0.8f, 0.4f, 0.1f}}, {.color = {0.2f, 0.4f, 0.8f}}};
    const cgt_image image = {.bytes = bytes};
    if (cgt_picture_draw(picture, scene, &camera, looks, 3, &image, NULL) != CGT_OK) {
        char message[256];
        cgt_picture_get_error_message(picture, message, sizeof message);
        fprintf(stderr, "soak: picture: %s\n", message);
        exit(EXIT_FAILURE);
    }
    add_bytes(bytes, sizeof bytes);
}

static void trace(const cgt_context *context, const cgt_scene *scene, uint32_t number)
{
    static float org[3][RAYS], dir[3][RAYS], t[RAYS];
    static uint32_t primitive[RAYS];
    static uint8_t flags[RAYS];
    test_random random = random_make(1000 + number);
    for (uint32_t i = 0; i < RAYS; i++) {
        float d[3];
        random_direction(&random, d);
        for (int a = 0; a < 3; a++) {
            org[a][i] = random_float(&random, -10, 10);
            dir[a][i] = d[a];
        }
    }
    const cgt_rays rays = {.count = RAYS, .org = {org[0], org[1], org[2]}, .dir = {dir[0], dir[1], dir[2]}};
    const cgt_hits hits = {.t = t, .primitive = primitive};
    check(cgt_trace_rays(scene, &rays, &hits, NULL), context, "rays");
    add_bytes(t, sizeof t);
    add_bytes(primitive, sizeof primitive);
    check(cgt_occluded_rays(scene, &rays, flags, NULL), context, "occluded rays");
    add_bytes(flags, sizeof flags);
    const cgt_light lamp = {CGT_LIGHT_POINT, {2, 9, 3}};
    const cgt_points points = {.count = RAYS, .position = {org[0], org[1], org[2]}};
    check(cgt_occluded_points(scene, &lamp, &points, flags, NULL), context, "points against a light");
    add_bytes(flags, sizeof flags);
}

static void make_picture(cgt_context *context, uint32_t number, cgt_picture **picture)
{
    cgt_picture_options options = {.width = WIDTH, .height = HEIGHT};
    options.shading = number % 3 ? CGT_SHADING_FULL : CGT_SHADING_PLAIN;
    options.antialias = number % 4 ? 1 : 2;
    options.lighting.ambient = number % 5 ? 0 : 4;
    options.style.outline = number % 2 ? 1 : 0;
    if (*picture)
        check(cgt_picture_set_options(*picture, &options), context, "options of a picture");
    else
        check(cgt_picture_create(context, &options, picture), context, "picture");
}

static void run_steps(const soak *s, uint32_t number)
{
    for (uint32_t step = 0; step < STEPS; step++) {
        move();
        check(cgt_scene_commit(s->scene), s->context, "commit");
        draw(s->picture, s->scene);
        trace(s->context, s->scene, number);
    }
}

/* Returns the bits of all that a round has made. fresh: by objects of its own. */
static uint64_t run_round(soak *lasting, uint32_t number, bool fresh)
{
    soak own = {NULL, NULL, NULL};
    soak *s = fresh ? &own : lasting;
    const cgt_context_options options = {.threads = 1 + number % 4};
    make_round(number);
    if (!s->context) {
        check(cgt_context_create(&options, &s->context), s->context, "context");
        check(cgt_scene_create(s->context, NULL, &s->scene), s->context, "scene");
    }
    make_picture(s->context, number, &s->picture);
    set_scene(s->context, s->scene);
    run_steps(s, number);
    if (fresh) {
        cgt_picture_release(s->picture);
        cgt_scene_release(s->scene);
        cgt_context_release(s->context);
    }
    return r.hash;
}

/* ---- the process ---- */

static uint64_t resident_bytes(void)
{
    unsigned long long pages = 0, resident = 0;
    FILE *f = fopen("/proc/self/statm", "r");
    if (f && fscanf(f, "%llu %llu", &pages, &resident) != 2)
        resident = 0;
    if (f)
        fclose(f);
    return resident * 4096;
}

static uint32_t open_files(void)
{
    uint32_t files = 0;
    DIR *folder = opendir("/proc/self/fd");
    while (folder && readdir(folder))
        files++;
    if (folder)
        closedir(folder);
    return files;
}

int main(int count, char **arguments)
{
    const double seconds = count > 1 ? strtod(arguments[1], NULL) : 1;
    const time_t start = time(NULL);
    static uint64_t first[CYCLE];
    uint64_t most_bytes = 0, bytes = 0, rounds = 0;
    uint32_t files = 0;
    soak lasting = {NULL, NULL, NULL};
    for (; rounds < 3 * CYCLE || difftime(time(NULL), start) < seconds; rounds++) {
        const uint32_t number = (uint32_t)(rounds % CYCLE);
        const uint64_t cycle = rounds / CYCLE, hash = run_round(&lasting, number, cycle % 2);
        if (!cycle)
            first[number] = hash;
        if (hash != first[number]) {
            fprintf(stderr, "soak: round %u has other bits in cycle %llu\n", number, (unsigned long long)cycle);
            return EXIT_FAILURE;
        }
        if (number != CYCLE - 1)
            continue;
        bytes = resident_bytes();
        if (cycle == 1) {
            most_bytes = bytes + bytes / 20 + KEPT_BYTES;
            files = open_files();
        }
        /* a sanitizer keeps what was freed for a while */
        if (cycle > 1 && ((bytes > most_bytes && !CGT_SANITIZED) || open_files() > files)) {
            fprintf(stderr, "soak: cycle %llu: %llu bytes, at most %llu; %u open files, %u before\n",
                    (unsigned long long)cycle, (unsigned long long)bytes, (unsigned long long)most_bytes, open_files(),
                    files);
            return EXIT_FAILURE;
        }
    }
    printf("soak: %llu rounds, %llu pictures, the same bits; %.1f MB in the end\n", (unsigned long long)rounds,
           (unsigned long long)rounds * STEPS, (double)bytes * 1e-6);
    cgt_picture_release(lasting.picture);
    cgt_scene_release(lasting.scene);
    cgt_context_release(lasting.context);
    return EXIT_SUCCESS;
}

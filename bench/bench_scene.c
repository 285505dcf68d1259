/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The calls into the library that both sub-commands make, and the names of configurations. */
#include "bench_scene.h"

#include <stdio.h>
#include <string.h>

#include "program.h"

cgt_result bench_context_create(uint32_t threads, const char *variant, cgt_context **context)
{
    cgt_context_options options;
    cgt_context_options_init(&options);
    options.threads = threads;
    options.variant = variant;
    return cgt_context_create(&options, context);
}

static cgt_spheres spheres_of(const bench_scene *scene, uint32_t count)
{
    cgt_spheres spheres;
    memset(&spheres, 0, sizeof spheres);
    spheres.count = count;
    spheres.centers = scene->xyzr;
    spheres.center_stride = 4 * sizeof(float);
    spheres.radii = scene->xyzr + 3;
    spheres.radius_stride = 4 * sizeof(float);
    return spheres;
}

cgt_result bench_scene_create(bench_scene *scene, cgt_context *context, const float *xyzr, const uint32_t resolution[3])
{
    cgt_scene_options options;
    memset(scene, 0, sizeof *scene);
    scene->context = context;
    scene->xyzr = xyzr;
    cgt_scene_options_init(&options);
    memcpy(options.resolution, resolution, sizeof options.resolution);
    cgt_result result = cgt_scene_create(context, &options, &scene->scene);
    if (result != CGT_OK) {
        scene->scene = NULL;
        return result;
    }
    const cgt_spheres spheres = spheres_of(scene, 0);
    result = cgt_scene_add_spheres(scene->scene, &spheres, &scene->geometry);
    if (result != CGT_OK)
        bench_scene_release(scene);
    return result;
}

void bench_scene_release(bench_scene *scene)
{
    cgt_scene_release(scene->scene);
    scene->scene = NULL;
}

cgt_result bench_scene_commit(bench_scene *scene, uint32_t count)
{
    if (count != scene->held) {
        const cgt_spheres spheres = spheres_of(scene, count);
        const cgt_result result = cgt_scene_update_spheres(scene->scene, scene->geometry, &spheres);
        if (result != CGT_OK)
            return result;
        scene->held = count;
    }
    return cgt_scene_commit(scene->scene);
}

int bench_scene_failed(const cgt_context *context, const char *what, cgt_result result)
{
    char message[512] = "";
    if (context)
        cgt_error_message(context, message, sizeof message);
    program_error("%s: %s%s%s", what, cgt_result_string(result), message[0] ? ": " : "", message);
    return PROGRAM_FAILED;
}

/* ---- Names --------------------------------------------------------------------------------------------------- */

const char *bench_structure_name(cgt_structure structure)
{
    switch (structure) {
    case CGT_STRUCTURE_QUEUE_GRID: return "grid-queue";
    case CGT_STRUCTURE_AUTO: break;
    }
    return "none";
}

const char *bench_loop_name(cgt_loop loop)
{
    return loop == CGT_LOOP_NESTED ? "nested" : loop == CGT_LOOP_FLATTENED ? "flattened" : "auto";
}

const char *bench_cull_name(cgt_cull cull)
{
    return cull == CGT_CULL_NONE ? "off" : cull == CGT_CULL_FRUSTUM ? "frustum" : "blocks";
}

const char *bench_tile_name(cgt_tile_shape tile)
{
    return tile == CGT_TILE_SQUARE ? "square" : tile == CGT_TILE_STRIP ? "strip" : "auto";
}

static void append(char name[BENCH_NAME_SIZE], const char *key, const char *value)
{
    const size_t length = strlen(name);
    snprintf(name + length, BENCH_NAME_SIZE - length, ",%s=%s", key, value);
}

void bench_choice_name(const bench_choice *choice, cgt_structure structure, char name[BENCH_NAME_SIZE])
{
    char packet[16];
    snprintf(name, BENCH_NAME_SIZE, "%s", bench_structure_name(structure));
    snprintf(packet, sizeof packet, "%u", (unsigned)choice->packet);
    if (choice->variant)
        append(name, "variant", choice->variant);
    if (choice->packet)
        append(name, "packet", packet);
    if (choice->tile != CGT_TILE_AUTO)
        append(name, "tile", bench_tile_name(choice->tile));
    if (choice->loop != CGT_LOOP_AUTO)
        append(name, "loop", bench_loop_name(choice->loop));
    if (choice->cull != CGT_CULL_BLOCKS)
        append(name, "cull", bench_cull_name(choice->cull));
    if (!choice->mailbox)
        append(name, "mailbox", "off");
    if (choice->grid)
        append(name, "grid", choice->grid);
}

void bench_choice_options(const bench_choice *choice, cgt_trace_statistics *statistics, cgt_trace_options *options)
{
    cgt_trace_options_init(options);
    options->packet = choice->packet;
    options->tile = choice->tile;
    options->loop = choice->loop;
    options->cull = choice->cull;
    options->mailbox = choice->mailbox;
    options->statistics = statistics;
}

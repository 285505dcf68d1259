/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The options. A name may stand in several rows, with another meaning for each subject. */
#include "common/bench_options.h"

#include <stdio.h>
#include <string.h>

#include "ways/bench_way.h"

/* ---- values that need a function ---- */

static int parse_camera(bench_settings *s, const char *text, char *error, size_t size)
{
    return program_parse_camera(text, &s->camera, error, size);
}

static int parse_size(bench_settings *s, const char *text, char *error, size_t size)
{
    uint32_t width = 0, height = 0;
    if (program_parse_size(text, &width, &height, error, size))
        return -1;
    if ((uint64_t)width * height > BENCH_MOST_PIXELS) {
        snprintf(error, size, "%s: more than %lu pixels", text, (unsigned long)BENCH_MOST_PIXELS);
        return -1;
    }
    s->width = width;
    s->height = height;
    return 0;
}

static int parse_radius(bench_settings *s, const char *text, char *error, size_t size)
{
    return program_parse_float(text, 0.0f, 1e30f, &s->radius, error, size);
}

static int parse_light(bench_settings *s, const char *text, char *error, size_t size)
{
    s->lit = 1;
    return program_parse_floats(text, 3, s->light, error, size);
}

static int parse_packet(bench_settings *s, const char *text, char *error, size_t size)
{
    if (program_parse_u32(text, 4, 16, &s->choice.packet, error, size))
        return -1;
    if (s->choice.packet == 4 || s->choice.packet == 8 || s->choice.packet == 16)
        return 0;
    snprintf(error, size, "%s: packets are 4, 8 or 16 pixels wide", text);
    return -1;
}

static int parse_embree_packet(bench_settings *s, const char *text, char *error, size_t size)
{
    if (program_parse_u32(text, 1, 16, &s->embree_packet, error, size))
        return -1;
    if (s->embree_packet == 1 || s->embree_packet == 4 || s->embree_packet == 8 || s->embree_packet == 16)
        return 0;
    snprintf(error, size, "%s: 1, 4, 8 or 16 rays", text);
    return -1;
}

static int parse_isa(bench_settings *s, const char *text, char *error, size_t size)
{
    s->embree_isa = text;
    if (bench_embree_has_isa(text))
        return 0;
    snprintf(error, size, "this build has no %s", text);
    return -1;
}

/* "nx,ny,nz". The library checks the product. */
static int parse_grid(bench_settings *s, const char *text, char *error, size_t size)
{
    char part[BENCH_LISTED_SIZE];
    const char *list = text;
    int axis = 0;
    while (bench_next_name(&list, part)) {
        if (axis < 3 && program_parse_u32(part, 1, 1024, &s->choice.resolution[axis], error, size))
            return -1;
        axis++;
    }
    if (axis == 3)
        return 0;
    snprintf(error, size, "%s: needs three whole numbers, separated by commas", text);
    return -1;
}

/* The name of a variant of this build. Whether the CPU runs it shows when the context is created. */
static int parse_variant(bench_settings *s, const char *text, char *error, size_t size)
{
    const int which = bench_find_name(cgt_get_variant_names(), text, error, size);
    s->choice.variant = which < 0 ? NULL : cgt_get_variant_names()[which];
    return which < 0 ? -1 : 0;
}

static int parse_precision(bench_settings *s, const char *text, char *error, size_t size)
{
    const int which = bench_find_name(bench_precisions, text, error, size);
    s->choice.precision = (cgt_precision)which;
    s->choice.precision_named = 1;
    return which < 0 ? -1 : 0;
}

static int parse_ways(bench_settings *s, const char *text, char *error, size_t size)
{
    char name[BENCH_LISTED_SIZE];
    while (bench_next_name(&text, name)) {
        const int which = bench_find_name(bench_way_names(), name, error, size);
        size_t i = 0;
        if (which < 0)
            return -1;
        while (i < s->ways && s->way[i] != which)
            i++;
        if (i == BENCH_MOST_NAMED) {
            snprintf(error, size, "%s: at most %d can be named", name, BENCH_MOST_NAMED);
            return -1;
        }
        s->way[i] = which;
        s->ways += i == s->ways;
    }
    return 0;
}

static int parse_batches(bench_settings *s, const char *text, char *error, size_t size)
{
    char name[BENCH_LISTED_SIZE];
    while (bench_next_name(&text, name)) {
        uint64_t batch = UINT64_MAX;
        size_t at = 0;
        if (strcmp(name, "all") != 0 && program_parse_u64(name, 1, 100000000, &batch, error, size))
            return -1;
        while (at < s->batches && s->batch[at] < batch)
            at++;
        if (at < s->batches && s->batch[at] == batch)
            continue;
        if (s->batches == BENCH_MOST_BATCHES) {
            snprintf(error, size, "more than %d counts", BENCH_MOST_BATCHES);
            return -1;
        }
        memmove(&s->batch[at + 1], &s->batch[at], (s->batches++ - at) * sizeof s->batch[0]);
        s->batch[at] = batch;
    }
    return 0;
}

static int parse_numbers(bench_settings *s, const char *text, uint32_t least, uint32_t most, char *error, size_t size)
{
    char name[BENCH_LISTED_SIZE];
    s->counts = 0;
    while (bench_next_name(&text, name)) {
        if (s->counts == BENCH_MOST_COUNTS) {
            snprintf(error, size, "more than %d counts", BENCH_MOST_COUNTS);
            return -1;
        }
        if (program_parse_u32(name, least, most, &s->count[s->counts++], error, size))
            return -1;
    }
    return 0;
}

static int parse_primitives(bench_settings *s, const char *text, char *error, size_t size)
{
    return parse_numbers(s, text, 64, 10000000, error, size);
}

static int parse_threads(bench_settings *s, const char *text, char *error, size_t size)
{
    return parse_numbers(s, text, 1, BENCH_MOST_SCALING, error, size);
}

static int parse_seed(bench_settings *s, const char *text, char *error, size_t size)
{
    s->seeded = 1;
    return program_parse_u64(text, 0, UINT64_MAX, &s->seed, error, size);
}

static int be_quick(bench_settings *s, const char *text, char *error, size_t size)
{
    (void)text, (void)size;
    error[0] = '\0';
    s->count[0] = 10000;
    s->counts = 1;
    s->way[0] = CGT_STRUCTURE_AUTO;
    s->ways = 1;
    s->steps = 3;
    s->limit_ms = 40;
    return 0;
}

/* ---- the table ---- */

#define FILES (BENCH_ACCURACY | BENCH_BOUNCES | BENCH_FRAME | BENCH_LIGHT | BENCH_RAYS | BENCH_SCALING)
#define BUT_SCALING ~(unsigned)BENCH_SCALING
#define SETS (BENCH_BOUNCES | BENCH_LIGHT | BENCH_RAYS)
#define LIBRARY (FILES | BENCH_CLIFFS)
#define ALL_ROWS (LIBRARY | BENCH_CELL)

#define FLAG(field) BENCH_OPTION_FLAG, offsetof(bench_settings, field), 0, 0, NULL, NULL
#define U32(field, least, most) BENCH_OPTION_U32, offsetof(bench_settings, field), least, most, NULL, NULL
#define U64(field, least, most) BENCH_OPTION_U64, offsetof(bench_settings, field), least, most, NULL, NULL
#define TEXT(field) BENCH_OPTION_TEXT, offsetof(bench_settings, field), 0, 0, NULL, NULL
#define ONE(field, names) BENCH_OPTION_ONE, offsetof(bench_settings, field), 0, 0, names, NULL
#define LIST(field, names) BENCH_OPTION_LIST, offsetof(bench_settings, field), 0, 0, names, NULL
#define CALL(function) BENCH_OPTION_CALL, 0, 0, 0, NULL, function

enum { SCENE, WAYS, LIBRARY_CHOICE, RAYS, ROWS, MEASUREMENT };
const char *const bench_option_groups[BENCH_OPTION_GROUPS] = {
    "Scene and camera:",
    "Ways; lists have commas, or the option is given several times:",
    "Settings of the library:",
    "Rays:",
    "Which rows:",
    "Measurement:"};

static const char *const accuracy_parts[] = {"cases", "frames", "paths", NULL};
static const char *const cliff_calls[] = {"commit", "camera", "light", "single", "rays", "occluded", NULL};

/* clang-format off */
const bench_option bench_options[] = {
    {"camera", 'c', "EX,EY,EZ,TX,TY,TZ,UX,UY,UZ,FOV", "eye, target, up, vertical angle in degrees", SCENE, FILES,
     CALL(parse_camera)},
    {"size", 's', "WxH", "pixels", SCENE, FILES, CALL(parse_size)},
    {"frames", 'n', "COUNT", "the first COUNT frames of the file; rays, bounces and light trace the last of them",
     SCENE, FILES, U64(frames, 1, UINT64_MAX)},
    {"frames", 'n', "COUNT", "frames to write (default 6)", SCENE, BENCH_MAKE, U64(frames, 1, 1000000)},
    {"radius", 0, "R", "radius of spheres in files that have none", SCENE, FILES, CALL(parse_radius)},
    {"wrapped", 0, NULL, "prefer wrapped coordinates where a file has both kinds", SCENE, FILES,
     FLAG(wrapped)},
    {"primitives", 0, "COUNTS", "with commas (default 1000,10000,100000,1000000)", SCENE, BENCH_CLIFFS,
     CALL(parse_primitives)},
    {"pixels", 0, "WxH", "of a frame of --frames (default 320x180)", SCENE, BENCH_CELL, CALL(parse_size)},
    {"spheres", 0, "COUNT", "of its scene (default 2000)", SCENE, BENCH_CELL, U32(spheres, 1, UINT32_MAX)},

    {"structure", 'S', "NAMES", "structures of the library: auto, queue-grid, loose-grid, kd, kd-ropes, bih, bvh; of "
     "Embree, where it is installed: embree, the fastest of its settings; embree-all; embree-low, -medium or -refit, "
     "and of spheres alone embree-low-builtin or -user", WAYS, BENCH_FRAME | SETS | BENCH_CLIFFS, CALL(parse_ways)},
    {"structure", 'S', "NAME", "one of the library (default auto)", WAYS, BENCH_SCALING, CALL(parse_ways)},
    {"structure", 'S', "NAME", "of frames: one of the library (default queue-grid, whose packets take all tests)", WAYS,
     BENCH_ACCURACY, CALL(parse_ways)},
    {"traversals", 0, NULL, "a row for each way to traverse a structure", WAYS, BENCH_RAYS,
     FLAG(traversals)},
    {"layouts", 0, NULL, "rows for all layouts of kd-trees", WAYS, BENCH_RAYS, FLAG(layouts)},
    {"all", 0, NULL, "a row for each packet size and tile shape, too", WAYS, BENCH_FRAME, FLAG(all)},
    {"no-embree", 0, NULL, "leave Embree out of the ways that are measured by default", WAYS,
     BENCH_BOUNCES | BENCH_LIGHT | BENCH_CLIFFS, FLAG(no_embree)},
    {"packets", 0, "RAYS", "of Embree: 1, 4, 8 or 16 (default: as many as it has vectors for)", WAYS,
     BENCH_FRAME, CALL(parse_embree_packet)},
    {"isa", 0, "NAME", "limit Embree: sse4.2, avx, avx2 or avx512", WAYS, BENCH_FRAME | SETS, CALL(parse_isa)},
    {"robust", 0, NULL, "set Embree's RTC_SCENE_FLAG_ROBUST", WAYS, BENCH_FRAME | SETS, FLAG(embree_robust)},

    {"threads", 't', "COUNT", "threads, 0 for one per CPU (default 1)", LIBRARY_CHOICE, LIBRARY & BUT_SCALING,
     U32(threads, 0, 1024)},
    {"threads", 't', "COUNTS", "threads to simulate, 1 to 1024 (default 1,2,4,8,16,32,64)", LIBRARY_CHOICE,
     BENCH_SCALING, CALL(parse_threads)},
    {"variant", 0, "NAME", "instruction set, as the library names it", LIBRARY_CHOICE, LIBRARY,
     CALL(parse_variant)},
    {"packet", 'k', "EDGE", "pixels along a packet's edge: 4, 8 or 16", LIBRARY_CHOICE,
     BENCH_FRAME | BENCH_RAYS | BENCH_ACCURACY, CALL(parse_packet)},
    {"grid", 'g', "NX,NY,NZ", "cells of the grid; AUTO is the queue grid then", LIBRARY_CHOICE,
     BENCH_FRAME | BENCH_RAYS | BENCH_ACCURACY, CALL(parse_grid)},
    {"kd-layout", 0, "NAME", "of their nodes: depth-first, breadth-first or mixed", LIBRARY_CHOICE,
     BENCH_FRAME | BENCH_RAYS, ONE(choice.kd_layout, bench_kd_layouts)},
    {"kd-break", 0, "LEVELS", "of mixed: levels stored breadth first, 1 to 50", LIBRARY_CHOICE,
     BENCH_FRAME | BENCH_RAYS, U32(choice.kd_break, 1, 50)},
    {"kd-traversal", 0, "NAME", "of kd-trees and bih: single or packet", LIBRARY_CHOICE,
     BENCH_FRAME | BENCH_RAYS, ONE(choice.kd_traversal, bench_kd_traversals)},
    {"precision", 'p', "NAME", "exact (default) or fast", LIBRARY_CHOICE, BENCH_FRAME, CALL(parse_precision)},
    {"test", 0, "NAME", "of triangles with -p fast: watertight, moller-trumbore or accelerated", LIBRARY_CHOICE,
     BENCH_FRAME, ONE(choice.test, bench_triangle_tests)},
    {"loop", 0, "NAME", "nested or flattened", LIBRARY_CHOICE, BENCH_FRAME, ONE(choice.loop, bench_loops)},
    {"tile", 0, "NAME", "square or strip", LIBRARY_CHOICE, BENCH_FRAME, ONE(choice.tile, bench_tiles_names)},
    {"cull", 0, "NAME", "off, frustum or blocks", LIBRARY_CHOICE, BENCH_FRAME, ONE(choice.cull, bench_culls)},
    {"no-mailbox", 0, NULL, "do not remember which primitives a packet was tested against", LIBRARY_CHOICE,
     BENCH_FRAME, BENCH_OPTION_ONE, offsetof(bench_settings, choice.mailbox), CGT_MAILBOX_OFF, 0, NULL, NULL},

    {"light", 'l', "X,Y,Z", "a shadow ray from every hit to this point", RAYS,
     BENCH_FRAME | BENCH_RAYS | BENCH_SCALING, CALL(parse_light)},
    {"ao", 'a', "RAYS", "ambient-occlusion rays from every hit, at most 1024", RAYS,
     BENCH_FRAME | BENCH_RAYS | BENCH_SCALING,      U32(ao, 0, BENCH_MOST_AO_RAYS)},
    {"nearest", 0, NULL, "ambient-occlusion rays search for the nearest hit instead of any hit", RAYS,
     BENCH_FRAME, FLAG(nearest)},
    {"orthographic", 'O', NULL, "parallel rays; the picture is as high as the camera's view at its target", RAYS,
     BENCH_FRAME, FLAG(orthographic)},
    {"shade", 0, NULL, "shade a picture of 8 bits a channel; no planes are stored", RAYS, BENCH_FRAME,
     FLAG(shade)},
    {"output", 'o', "HITS", "write the hits of the first row's last frame: per pixel float32 t and uint32 primitive",
     RAYS, BENCH_FRAME, TEXT(output)},

    {"kinds", 'K', "NAMES", "frame, camera, shadow, ao, bounce, random (default: all)", RAYS, BENCH_RAYS,
     LIST(kind, bench_rays_kinds)},
    {"light", 'K', "NAMES", "outside, near, inside, edge, hole, surface, +x, -x, +y, -y, +z, -z, slanted or row "
     "(default: all)", RAYS, BENCH_LIGHT, LIST(kind, bench_light_places)},
    {"material", 'K', "NAMES", "mirror or glass (default: both)", RAYS, BENCH_BOUNCES, LIST(kind, bench_materials)},
    {"orders", 'O', "NAMES", "camera (default), tile, shuffled", RAYS, BENCH_RAYS, LIST(order, bench_rays_orders)},
    {"points", 'O', "NAMES", "tiles, skipping, frame, shuffled, scattered or sorted (default: all)", RAYS, BENCH_LIGHT,
     LIST(order, bench_light_orders)},
    {"order", 'O', "NAMES", "waves, made, octant, wave-morton, origin or octant-morton (default: all)", RAYS,
     BENCH_BOUNCES, LIST(order, bench_wave_orders)},
    {"queries", 'Q', "NAMES", "nearest, any, four hits (default: nearest for camera and bounce, any for shadow and "
     "ao, both for random)", RAYS, BENCH_RAYS, LIST(query, bench_queries)},
    {"batches", 'B', "COUNTS", "rays in a call, 1: by the calls of one ray; all (default): the whole set", RAYS,
     BENCH_RAYS, CALL(parse_batches)},
    {"rays", 0, "COUNT", "rays of a set at most, from the picture's middle (default 131072)", RAYS, BENCH_RAYS,
     U32(rays, 1, 100000000)},
    {"rays", 0, "COUNT", "rays of each case and file (default 4000)", RAYS, BENCH_ACCURACY,
     U32(rays, 1, 10000000)},
    {"random", 0, "COUNT", "random rays (default: as --rays)", RAYS, BENCH_RAYS, U32(random, 1, 100000000)},

    {"call", 0, "NAMES", "commit, camera, light, single, rays, occluded (default: all)", ROWS, BENCH_CLIFFS,
     LIST(call, cliff_calls)},
    {"scene", 0, "TEXT", "only scenes whose names contain TEXT", ROWS, BENCH_CLIFFS, TEXT(text)},
    {"worst", 0, "COUNT", "rows of each summary (default 10)", ROWS, BENCH_CLIFFS, U32(worst, 0, 1000000)},
    {"quick", 0, NULL, "10000 primitives, auto, 3 steps, 40 ms: about a minute", ROWS, BENCH_CLIFFS,
     CALL(be_quick)},
    {"list", 0, NULL, "print the names of the scenes", ROWS, BENCH_CLIFFS, FLAG(list)},
    {"part", 'w', "NAMES", "cases, frames, paths; a list with commas (default: all)", ROWS, BENCH_ACCURACY,
     LIST(part, accuracy_parts)},
    {"case", 0, "TEXT", "only cases and files whose names contain TEXT", ROWS, BENCH_ACCURACY, TEXT(text)},
    {"seed", 0, "NUMBER", "seed of the cases' random numbers", ROWS, BENCH_ACCURACY, CALL(parse_seed)},
    {"frames", 0, NULL, "FILE is spe_grid.elf: trace frames of spheres on 1 to 8 SPEs", ROWS, BENCH_CELL,
     FLAG(cell_frames)},
    {"kd", 0, NULL, "FILE is spe_kd.elf: trace frames of triangles through caches", ROWS, BENCH_CELL,
     FLAG(cell_kd)},
    {"bih", 0, "FILE", "with --kd: spe_bih.elf, to compare bounding interval hierarchies with kd-trees", ROWS,
     BENCH_CELL, TEXT(bih_path)},
    {"profile", 0, NULL, "with --frames: one frame on one SPE, function by function", ROWS, BENCH_CELL,
     FLAG(profile)},
    {"section", 0, "NAME", "with --frames or --kd: this section of the rows alone", ROWS, BENCH_CELL,
     TEXT(section)},

    {"repeat", 'r', "COUNT", "measure COUNT times", MEASUREMENT, FILES, U32(repeat, 1, 1000000)},
    {"limit", 0, "MS", "no call is measured for longer, but for 192 rays (default 1000)", MEASUREMENT,
     BENCH_CLIFFS, U32(limit_ms, 1, 1000000)},
    {"steps", 0, "COUNT", "calls grow from 192 rays by four, so many times, 1 to 7 (default 5)", MEASUREMENT,
     BENCH_CLIFFS, U32(steps, 1, 7)},
    {"cycles", 0, "COUNT", "most cycles of a program, or of an SPE in a frame (default 10^11)", MEASUREMENT,
     BENCH_CELL, U64(cycles, 1, UINT64_MAX)},
    {"verbose", 'v', NULL, "report on standard error what the library chose", MEASUREMENT, FILES & BUT_SCALING,
     FLAG(verbose)},
    {"json", 'j', "FILE", "write the rows as JSON, too", MEASUREMENT, ALL_ROWS, TEXT(json_path)}};
/* clang-format on */
const size_t bench_option_count = sizeof bench_options / sizeof bench_options[0];

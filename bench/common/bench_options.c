/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The options. A name may stand in several rows, with another meaning for each subject. */
#include "common/bench_options.h"

#include <stdio.h>
#include <string.h>

#include "ways/bench_way.h"

/* ---- values that need a function ---- */

static int parse_camera(const char *text, void *to, char *error, size_t size)
{
    return cgt_read_camera(text, to, error, size);
}

static int parse_size(const char *text, void *to, char *error, size_t size)
{
    bench_settings *const s = to;
    uint32_t width = 0, height = 0;
    if (cgt_read_size(text, &width, &height, error, size))
        return -1;
    if ((uint64_t)width * height > BENCH_MOST_PIXELS) {
        snprintf(error, size, "%s: more than %lu pixels", text, (unsigned long)BENCH_MOST_PIXELS);
        return -1;
    }
    s->width = width;
    s->height = height;
    return 0;
}

static int parse_light(const char *text, void *to, char *error, size_t size)
{
    return cgt_read_floats(text, 3, to, error, size);
}

static int parse_packet(const char *text, void *to, char *error, size_t size)
{
    bench_settings *const s = to;
    if (cgt_read_u32(text, 4, 16, &s->choice.packet, error, size))
        return -1;
    if (s->choice.packet == 4 || s->choice.packet == 8 || s->choice.packet == 16)
        return 0;
    snprintf(error, size, "%s: packets are 4, 8 or 16 pixels wide", text);
    return -1;
}

static int parse_embree_packet(const char *text, void *to, char *error, size_t size)
{
    bench_settings *const s = to;
    if (cgt_read_u32(text, 1, 16, &s->embree_packet, error, size))
        return -1;
    if (s->embree_packet == 1 || s->embree_packet == 4 || s->embree_packet == 8 || s->embree_packet == 16)
        return 0;
    snprintf(error, size, "%s: 1, 4, 8 or 16 rays", text);
    return -1;
}

static int parse_isa(const char *text, void *to, char *error, size_t size)
{
    bench_settings *const s = to;
    s->embree_isa = text;
    if (bench_embree_has_isa(text))
        return 0;
    snprintf(error, size, "this build has no %s", text);
    return -1;
}

/* "nx,ny,nz". The library checks the product. */
static int parse_grid(const char *text, void *to, char *error, size_t size)
{
    bench_settings *const s = to;
    char part[OPTION_ITEM_SIZE];
    const char *list = text;
    int axis = 0;
    while (cgt_option_next(&list, part)) {
        if (axis < 3 && cgt_read_u32(part, 1, 1024, &s->choice.resolution[axis], error, size))
            return -1;
        axis++;
    }
    if (axis == 3)
        return 0;
    snprintf(error, size, "%s: needs three whole numbers, separated by commas", text);
    return -1;
}

/* The name of a variant of this build. Whether the CPU runs it shows when the context is created. */
static int parse_variant(const char *text, void *to, char *error, size_t size)
{
    bench_settings *const s = to;
    const int which = cgt_option_find(cgt_get_variant_names(), text, error, size);
    s->choice.variant = which < 0 ? NULL : cgt_get_variant_names()[which];
    return which < 0 ? -1 : 0;
}

static int parse_ways(const char *text, void *to, char *error, size_t size)
{
    bench_settings *const s = to;
    char name[OPTION_ITEM_SIZE];
    while (cgt_option_next(&text, name)) {
        const int which = cgt_option_find(bench_way_names(), name, error, size);
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

static int parse_batches(const char *text, void *to, char *error, size_t size)
{
    bench_settings *const s = to;
    char name[OPTION_ITEM_SIZE];
    while (cgt_option_next(&text, name)) {
        uint64_t batch = UINT64_MAX;
        size_t at = 0;
        if (strcmp(name, "all") != 0 && cgt_read_u64(name, 1, 100000000, &batch, error, size))
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
    char name[OPTION_ITEM_SIZE];
    s->counts = 0;
    while (cgt_option_next(&text, name)) {
        if (s->counts == BENCH_MOST_COUNTS) {
            snprintf(error, size, "more than %d counts", BENCH_MOST_COUNTS);
            return -1;
        }
        if (cgt_read_u32(name, least, most, &s->count[s->counts++], error, size))
            return -1;
    }
    return 0;
}

static int parse_primitives(const char *text, void *to, char *error, size_t size)
{
    bench_settings *const s = to;
    return parse_numbers(s, text, 64, 10000000, error, size);
}

static int be_quick(const char *text, void *to, char *error, size_t size)
{
    bench_settings *const s = to;
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

#define FILES (BENCH_ACCURACY | BENCH_BOUNCES | BENCH_FRAME | BENCH_LIGHT | BENCH_RAYS)
#define SETS (BENCH_BOUNCES | BENCH_LIGHT | BENCH_RAYS)
#define LIBRARY (FILES | BENCH_CLIFFS)
#define ALL_ROWS (LIBRARY | BENCH_CELL)

#define AT(type_, field) .type = OPTION_##type_, .at = offsetof(bench_settings, field)
#define FLAG(field) AT(FLAG, field), .first = 1
#define U32(field, least, most) AT(U32, field), .first = least, .last = most
#define U64(field, least, most) AT(U64, field), .first = least, .last = most
#define TEXT(field) AT(TEXT, field)
#define ONE(field, names_) AT(WORD, field), .names = names_
#define LIST(field, names_) AT(LIST, field), .names = names_
#define PARSED(field, function) AT(PARSED, field), .parse = function
#define WHOLE(function) .type = OPTION_PARSED, .parse = function /* its place is all of the settings */
#define GIVEN(field) .given = offsetof(bench_settings, field) + 1

static const char *const accuracy_parts[] = {"cases", "frames", "paths", NULL};
static const char *const cliff_calls[] = {"commit", "camera", "light", "single", "rays", "occluded", NULL};

const bench_option bench_options[] = {
    {~0u, {.help = "Scene and camera:", .group = 1}},
    {FILES,
     {"camera", 'c', "EX,EY,EZ,TX,TY,TZ,UX,UY,UZ,FOV", "eye, target, up, vertical angle in degrees",
      PARSED(camera, parse_camera)}},
    {FILES, {"size", 's', "WxH", "pixels", WHOLE(parse_size)}},
    {FILES,
     {"frames", 'n', "COUNT", "the first COUNT frames of the file; rays, bounces and light trace the last of them",
      U64(frames, 1, UINT64_MAX)}},
    {BENCH_MAKE, {"frames", 'n', "COUNT", "frames to write (default 6)", U64(frames, 1, 1000000)}},
    {FILES,
     {"radius", 0, "R", "radius of spheres in files that have none", .type = OPTION_FLOAT,
      .at = offsetof(bench_settings, radius), .high = 1e30}},
    {FILES, {"wrapped", 0, NULL, "prefer wrapped coordinates where a file has both kinds", FLAG(wrapped)}},
    {BENCH_CLIFFS,
     {"primitives", 0, "COUNTS", "with commas (default 1000,10000,100000,1000000)", WHOLE(parse_primitives)}},
    {BENCH_CELL, {"pixels", 0, "WxH", "of a frame of --frames (default 320x180)", WHOLE(parse_size)}},
    {BENCH_CELL, {"spheres", 0, "COUNT", "of its scene (default 2000)", U32(spheres, 1, UINT32_MAX)}},
    {~0u, {.help = "Ways; lists have commas, or the option is given several times:", .group = 2}},
    {BENCH_FRAME | SETS | BENCH_CLIFFS,
     {"structure", 'S', "NAMES",
      "structures of the library: auto, queue-grid, loose-grid, kd, kd-ropes, bih, bvh; of Embree, where it is "
      "installed: embree, the fastest of its settings; embree-all; embree-low, -medium or -refit, and of spheres alone "
      "embree-low-builtin or -user",
      WHOLE(parse_ways)}},
    {BENCH_ACCURACY,
     {"structure", 'S', "NAME", "of frames: one of the library (default queue-grid, whose packets take all tests)",
      WHOLE(parse_ways)}},
    {BENCH_RAYS, {"traversals", 0, NULL, "a row for each way to traverse a structure", FLAG(traversals)}},
    {BENCH_RAYS, {"layouts", 0, NULL, "rows for all layouts of kd-trees", FLAG(layouts)}},
    {BENCH_FRAME, {"all", 0, NULL, "a row for each packet size and tile shape, too", FLAG(all)}},
    {BENCH_BOUNCES | BENCH_LIGHT | BENCH_CLIFFS,
     {"no-embree", 0, NULL, "leave Embree out of the ways that are measured by default", FLAG(no_embree)}},
    {BENCH_FRAME,
     {"packets", 0, "RAYS", "of Embree: 1, 4, 8 or 16 (default: as many as it has vectors for)",
      WHOLE(parse_embree_packet)}},
    {BENCH_FRAME | SETS, {"isa", 0, "NAME", "limit Embree: sse4.2, avx, avx2 or avx512", WHOLE(parse_isa)}},
    {BENCH_FRAME | SETS, {"robust", 0, NULL, "set Embree's RTC_SCENE_FLAG_ROBUST", FLAG(embree_robust)}},
    {~0u, {.help = "Settings of the library:", .group = 3}},
    {LIBRARY, {"threads", 't', "COUNT", "threads, 0 for one per CPU (default 1)", U32(threads, 0, 1024)}},
    {LIBRARY, {"variant", 0, "NAME", "instruction set, as the library names it", WHOLE(parse_variant)}},
    {BENCH_FRAME | BENCH_RAYS | BENCH_ACCURACY,
     {"packet", 'k', "EDGE", "pixels along a packet's edge: 4, 8 or 16", WHOLE(parse_packet)}},
    {BENCH_FRAME | BENCH_RAYS | BENCH_ACCURACY,
     {"grid", 'g', "NX,NY,NZ", "cells of the grid; AUTO is the queue grid then", WHOLE(parse_grid)}},
    {BENCH_FRAME | BENCH_RAYS,
     {"kd-layout", 0, "NAME", "of their nodes: depth-first, breadth-first or mixed",
      ONE(choice.kd_layout, bench_kd_layouts)}},
    {BENCH_FRAME | BENCH_RAYS,
     {"kd-break", 0, "LEVELS", "of mixed: levels stored breadth first, 1 to 50", U32(choice.kd_break, 1, 50)}},
    {BENCH_FRAME | BENCH_RAYS,
     {"kd-traversal", 0, "NAME", "of kd-trees and bih: single or packet",
      ONE(choice.kd_traversal, bench_kd_traversals)}},
    {BENCH_FRAME,
     {"precision", 'p', "NAME", "exact (default) or fast", ONE(choice.precision, bench_precisions),
      GIVEN(choice.precision_named)}},
    {BENCH_FRAME,
     {"test", 0, "NAME", "of triangles with -p fast: watertight, moller-trumbore or accelerated",
      ONE(choice.test, bench_triangle_tests)}},
    {BENCH_FRAME, {"loop", 0, "NAME", "nested or flattened", ONE(choice.loop, bench_loops)}},
    {BENCH_FRAME, {"tile", 0, "NAME", "square or strip", ONE(choice.tile, bench_tiles_names)}},
    {BENCH_FRAME, {"cull", 0, "NAME", "off, frustum or blocks", ONE(choice.cull, bench_culls)}},
    {BENCH_FRAME,
     {"no-mailbox", 0, NULL, "do not remember which primitives a packet was tested against", AT(FLAG, choice.mailbox),
      .first = CGT_MAILBOX_OFF}},
    {~0u, {.help = "Rays:", .group = 4}},
    {BENCH_FRAME | BENCH_RAYS,
     {"light", 'l', "X,Y,Z", "a shadow ray from every hit to this point", PARSED(light, parse_light), GIVEN(lit)}},
    {BENCH_FRAME | BENCH_RAYS,
     {"ao", 'a', "RAYS", "ambient-occlusion rays from every hit, at most 1024", U32(ao, 0, BENCH_MOST_AO_RAYS)}},
    {BENCH_FRAME,
     {"nearest", 0, NULL, "ambient-occlusion rays search for the nearest hit instead of any hit", FLAG(nearest)}},
    {BENCH_FRAME,
     {"orthographic", 'O', NULL, "parallel rays; the picture is as high as the camera's view at its target",
      FLAG(orthographic)}},
    {BENCH_FRAME, {"shade", 0, NULL, "shade a picture of 8 bits a channel; no planes are stored", FLAG(shade)}},
    {BENCH_FRAME,
     {"output", 'o', "HITS", "write the hits of the first row's last frame: per pixel float32 t and uint32 primitive",
      TEXT(output)}},
    {BENCH_RAYS,
     {"kinds", 'K', "NAMES", "frame, camera, shadow, ao, bounce, random (default: all)", LIST(kind, bench_rays_kinds)}},
    {BENCH_LIGHT,
     {"light", 'K', "NAMES",
      "outside, near, inside, edge, hole, surface, +x, -x, +y, -y, +z, -z, slanted or row (default: all)",
      LIST(kind, bench_light_places)}},
    {BENCH_BOUNCES, {"material", 'K', "NAMES", "mirror or glass (default: both)", LIST(kind, bench_materials)}},
    {BENCH_RAYS, {"orders", 'O', "NAMES", "camera (default), tile, shuffled", LIST(order, bench_rays_orders)}},
    {BENCH_LIGHT,
     {"points", 'O', "NAMES", "tiles, skipping, frame, shuffled, scattered or sorted (default: all)",
      LIST(order, bench_light_orders)}},
    {BENCH_BOUNCES,
     {"order", 'O', "NAMES", "waves, made, octant, wave-morton, origin or octant-morton (default: all)",
      LIST(order, bench_wave_orders)}},
    {BENCH_RAYS,
     {"queries", 'Q', "NAMES",
      "nearest, any, four hits (default: nearest for camera and bounce, any for shadow and ao, both for random)",
      LIST(query, bench_queries)}},
    {BENCH_RAYS,
     {"batches", 'B', "COUNTS", "rays in a call, 1: by the calls of one ray; all (default): the whole set",
      WHOLE(parse_batches)}},
    {BENCH_RAYS,
     {"rays", 0, "COUNT", "rays of a set at most, from the picture's middle (default 131072)",
      U32(rays, 1, 100000000)}},
    {BENCH_ACCURACY, {"rays", 0, "COUNT", "rays of each case and file (default 4000)", U32(rays, 1, 10000000)}},
    {BENCH_RAYS, {"random", 0, "COUNT", "random rays (default: as --rays)", U32(random, 1, 100000000)}},
    {~0u, {.help = "Which rows:", .group = 5}},
    {BENCH_CLIFFS,
     {"call", 0, "NAMES", "commit, camera, light, single, rays, occluded (default: all)", LIST(call, cliff_calls)}},
    {BENCH_CLIFFS, {"scene", 0, "TEXT", "only scenes whose names contain TEXT", TEXT(text)}},
    {BENCH_CLIFFS, {"worst", 0, "COUNT", "rows of each summary (default 10)", U32(worst, 0, 1000000)}},
    {BENCH_CLIFFS, {"quick", 0, NULL, "10000 primitives, auto, 3 steps, 40 ms: about a minute", WHOLE(be_quick)}},
    {BENCH_CLIFFS, {"list", 0, NULL, "print the names of the scenes", FLAG(list)}},
    {BENCH_ACCURACY,
     {"part", 'w', "NAMES", "cases, frames, paths; a list with commas (default: all)", LIST(part, accuracy_parts)}},
    {BENCH_ACCURACY, {"case", 0, "TEXT", "only cases and files whose names contain TEXT", TEXT(text)}},
    {BENCH_ACCURACY,
     {"seed", 0, "NUMBER", "seed of the cases' random numbers", U64(seed, 0, UINT64_MAX), GIVEN(seeded)}},
    {BENCH_CELL,
     {"frames", 0, NULL, "FILE is spe_grid.elf: trace frames of spheres on 1 to 8 SPEs", FLAG(cell_frames)}},
    {BENCH_CELL, {"kd", 0, NULL, "FILE is spe_kd.elf: trace frames of triangles through caches", FLAG(cell_kd)}},
    {BENCH_CELL,
     {"bih", 0, "FILE", "with --kd: spe_bih.elf, to compare bounding interval hierarchies with kd-trees",
      TEXT(bih_path)}},
    {BENCH_CELL, {"profile", 0, NULL, "with --frames: one frame on one SPE, function by function", FLAG(profile)}},
    {BENCH_CELL, {"section", 0, "NAME", "with --frames or --kd: this section of the rows alone", TEXT(section)}},
    {~0u, {.help = "Measurement:", .group = 6}},
    {FILES, {"repeat", 'r', "COUNT", "measure COUNT times", U32(repeat, 1, 1000000)}},
    {BENCH_CLIFFS,
     {"limit", 0, "MS", "no call is measured for longer, but for 192 rays (default 1000)", U32(limit_ms, 1, 1000000)}},
    {BENCH_CLIFFS,
     {"steps", 0, "COUNT", "calls grow from 192 rays by four, so many times, 1 to 7 (default 5)", U32(steps, 1, 7)}},
    {BENCH_CELL,
     {"cycles", 0, "COUNT", "most cycles of a program, or of an SPE in a frame (default 10^11)",
      U64(cycles, 1, UINT64_MAX)}},
    {FILES, {"verbose", 'v', NULL, "report on standard error what the library chose", FLAG(verbose)}},
    {ALL_ROWS, {"json", 'j', "FILE", "write the rows as JSON, too", TEXT(json_path)}}};
const size_t bench_option_count = sizeof bench_options / sizeof bench_options[0];

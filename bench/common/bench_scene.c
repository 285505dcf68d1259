/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The calls into the library that sub-commands share, and the names of configurations. */
#include "common/bench_scene.h"

#include <stdio.h>
#include <string.h>

#include "common/bench_timing.h"
#include "common/program.h"

static char refused[512]; /* why the last context was not created */

cgt_result bench_context_create(uint32_t threads, const char *variant, cgt_context **context)
{
    cgt_context_options options;
    cgt_context_options_init(&options);
    options.threads = threads;
    options.variant = variant;
    options.message = refused;
    options.message_size = sizeof refused;
    return cgt_context_create(&options, context);
}

cgt_result bench_scene_create(bench_scene *scene, cgt_context *context, const float *moving,
                              const uint32_t resolution[3])
{
    cgt_scene_options options;
    cgt_research_scene_options research = {0};
    memset(scene, 0, sizeof *scene);
    scene->context = context;
    scene->moving = moving;
    cgt_scene_options_init(&options);
    options.structure = CGT_STRUCTURE_QUEUE_GRID;
    options.research = &research;
    memcpy(research.resolution, resolution, sizeof research.resolution);
    const cgt_result result = cgt_scene_create(context, &options, &scene->scene);
    if (result != CGT_OK)
        scene->scene = NULL;
    return result;
}

cgt_result bench_scene_structure(const bench_scene *scene, cgt_structure structure, cgt_ray_kind rays,
                                 const bench_kd_choice *kd, const uint32_t resolution[3])
{
    const cgt_research_scene_options research = {.resolution = {resolution[0], resolution[1], resolution[2]},
                                                 .kd_layout = kd->layout,
                                                 .kd_break_level = kd->break_level};
    const cgt_scene_options options = {.structure = structure, .rays = rays, .research = &research};
    return cgt_scene_set_options(scene->scene, &options);
}

void bench_scene_release(bench_scene *scene)
{
    cgt_scene_release(scene->scene);
    scene->scene = NULL;
}

void bench_scene_set_triangles(bench_scene *scene, const uint32_t *index, uint32_t triangles)
{
    scene->index = index;
    scene->triangles = triangles;
}

static cgt_result take_spheres(bench_scene *scene, uint32_t count)
{
    const cgt_spheres spheres = {.count = count,
                                 .centers = scene->moving,
                                 .center_stride = 4 * sizeof(float),
                                 .radii = scene->moving + 3,
                                 .radius_stride = 4 * sizeof(float)};
    return scene->has_geometry ? cgt_scene_update_spheres(scene->scene, scene->geometry, &spheres)
                               : cgt_scene_add_spheres(scene->scene, &spheres, &scene->geometry);
}

static cgt_result take_triangles(bench_scene *scene, uint32_t vertices)
{
    const cgt_triangles triangles = {
        .count = scene->triangles, .indices = scene->index, .vertex_count = vertices, .vertices = scene->moving};
    return scene->has_geometry ? cgt_scene_update_triangles(scene->scene, scene->geometry, &triangles)
                               : cgt_scene_add_triangles(scene->scene, &triangles, &scene->geometry);
}

cgt_result bench_scene_commit(bench_scene *scene, uint32_t count)
{
    if (!scene->has_geometry || count != scene->held) {
        const cgt_result result = scene->index ? take_triangles(scene, count) : take_spheres(scene, count);
        if (result != CGT_OK)
            return result;
        scene->has_geometry = 1;
        scene->held = count;
    }
    return cgt_scene_commit(scene->scene);
}

cgt_result bench_scene_build(bench_scene *scene, bench_build *build, uint32_t count, const uint32_t resolution[3],
                             const char *path, double *ms)
{
    const double begin = bench_now_ms();
    cgt_result result = bench_scene_structure(scene, build->structure, build->rays, &build->kd, resolution);
    if (result == CGT_OK)
        result = bench_scene_commit(scene, count);
    *ms = bench_now_ms() - begin;
    if (result == CGT_OK)
        result = cgt_scene_get_statistics(scene->scene, &build->built);
    if (result == CGT_OK)
        result = cgt_research_get_scene_statistics(scene->scene, &build->research);
    const cgt_structure built = build->built.structure;
    /* a scene without a valid primitive correctly has no structure */
    const int other = result == CGT_OK && build->structure != CGT_STRUCTURE_AUTO && built != build->structure &&
                      built != CGT_STRUCTURE_AUTO;
    if (result == CGT_ERROR_UNSUPPORTED || other) {
        char message[256] = "";
        cgt_context_get_error_message(scene->context, message, sizeof message);
        program_error("%s: no %s: left out: %s%s", path, bench_structure_name(build->structure),
                      other ? "the library builds " : message, other ? bench_structure_name(built) : "");
        build->left_out = 1;
        return CGT_OK;
    }
    return result;
}

int bench_scene_failed(const cgt_context *context, const char *what, cgt_result result)
{
    char message[512] = "";
    if (context)
        cgt_context_get_error_message(context, message, sizeof message);
    const char *reason = context ? message : refused;
    program_error("%s: %s%s%s", what, cgt_get_result_string(result), reason[0] ? ": " : "", reason);
    return PROGRAM_FAILED;
}

/* ---- Names --------------------------------------------------------------------------------------------------- */

static const char *const loops[] = {
    [CGT_LOOP_AUTO] = "auto", [CGT_LOOP_NESTED] = "nested", [CGT_LOOP_FLATTENED] = "flattened"};
static const char *const culls[] = {
    [CGT_CULL_AUTO] = "auto", [CGT_CULL_NONE] = "off", [CGT_CULL_FRUSTUM] = "frustum", [CGT_CULL_BLOCKS] = "blocks"};
static const char *const tiles[] = {
    [CGT_TILE_SHAPE_AUTO] = "auto", [CGT_TILE_SHAPE_SQUARE] = "square", [CGT_TILE_SHAPE_STRIP] = "strip"};
static const char *const precisions[] = {
    [CGT_PRECISION_ROBUST] = "robust", [CGT_PRECISION_FAST] = "fast", [CGT_PRECISION_EXACT] = "exact"};
static const char *const triangle_tests[] = {[CGT_TRIANGLE_TEST_AUTO] = "auto",
                                             [CGT_TRIANGLE_TEST_WATERTIGHT] = "watertight",
                                             [CGT_TRIANGLE_TEST_MOLLER_TRUMBORE] = "moller-trumbore",
                                             [CGT_TRIANGLE_TEST_ACCELERATED] = "accelerated"};

static const char *const structures[] = {[CGT_STRUCTURE_AUTO] = "auto",
                                         [CGT_STRUCTURE_QUEUE_GRID] = "queue-grid",
                                         [CGT_STRUCTURE_KD] = "kd",
                                         [CGT_STRUCTURE_KD_ROPES] = "kd-ropes",
                                         [CGT_STRUCTURE_LOOSE_GRID] = "loose-grid",
                                         [CGT_STRUCTURE_BVH] = "bvh",
                                         [CGT_STRUCTURE_BIH] = "bih"};
static const char *const kd_traversals[] = {
    [CGT_KD_TRAVERSAL_AUTO] = "auto", [CGT_KD_TRAVERSAL_SINGLE] = "single", [CGT_KD_TRAVERSAL_PACKET] = "packet"};
static const char *const kd_layouts[] = {[CGT_KD_LAYOUT_AUTO] = "auto",
                                         [CGT_KD_LAYOUT_DEPTH_FIRST] = "depth-first",
                                         [CGT_KD_LAYOUT_BREADTH_FIRST] = "breadth-first",
                                         [CGT_KD_LAYOUT_MIXED] = "mixed"};

const char *bench_structure_name(cgt_structure structure)
{
    return structure == CGT_STRUCTURE_AUTO ? "none" : structures[structure];
}

const char *bench_loop_name(cgt_loop loop) { return loops[loop]; }
const char *bench_cull_name(cgt_cull cull) { return culls[cull]; }
const char *bench_tile_name(cgt_tile_shape tile) { return tiles[tile]; }
const char *bench_precision_name(cgt_precision precision) { return precisions[precision]; }
const char *bench_triangle_test_name(cgt_triangle_test test) { return triangle_tests[test]; }
const char *bench_kd_traversal_name(cgt_kd_traversal traversal) { return kd_traversals[traversal]; }
const char *bench_kd_layout_name(cgt_kd_layout layout) { return kd_layouts[layout]; }

/* Index of a name in a list; -1 where there is none. */
static int find(const char *name, const char *const *names, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!strcmp(name, names[i]))
            return (int)i;
    return -1;
}

/* Sets *value, of an enum, to the index of a name in its list; returns 0, or -1 where there is none. */
#define FIND(name, names, type, value)                                                                                 \
    do {                                                                                                               \
        const int index = find(name, names, sizeof(names) / sizeof *(names));                                          \
        if (index >= 0)                                                                                                \
            *(value) = (type)index;                                                                                    \
        return index < 0 ? -1 : 0;                                                                                     \
    } while (0)

int bench_precision_find(const char *name, cgt_precision *value) { FIND(name, precisions, cgt_precision, value); }
int bench_structure_find(const char *name, cgt_structure *value) { FIND(name, structures, cgt_structure, value); }
int bench_cull_find(const char *name, cgt_cull *value) { FIND(name, culls, cgt_cull, value); }
int bench_loop_find(const char *name, cgt_loop *value) { FIND(name, loops, cgt_loop, value); }
int bench_tile_find(const char *name, cgt_tile_shape *value) { FIND(name, tiles, cgt_tile_shape, value); }
int bench_kd_layout_find(const char *name, cgt_kd_layout *value) { FIND(name, kd_layouts, cgt_kd_layout, value); }

int bench_triangle_test_find(const char *name, cgt_triangle_test *value)
{
    FIND(name, triangle_tests, cgt_triangle_test, value);
}

int bench_kd_traversal_find(const char *name, cgt_kd_traversal *value)
{
    FIND(name, kd_traversals, cgt_kd_traversal, value);
}

void bench_file_name(const char *path, char name[BENCH_NAME_SIZE])
{
    const char *slash = strrchr(path, '/');
    snprintf(name, BENCH_NAME_SIZE, "%s", slash ? slash + 1 : path);
    char *dot = strrchr(name, '.');
    if (dot && dot > name)
        *dot = '\0';
}

static void append(char name[BENCH_NAME_SIZE], const char *key, const char *value)
{
    const size_t length = strlen(name);
    snprintf(name + length, BENCH_NAME_SIZE - length, ",%s=%s", key, value);
}

static void append_kd(char name[BENCH_NAME_SIZE], const bench_kd_choice *kd)
{
    char level[16];
    snprintf(level, sizeof level, "%u", (unsigned)kd->break_level);
    if (kd->traversal != CGT_KD_TRAVERSAL_AUTO)
        append(name, "traversal", bench_kd_traversal_name(kd->traversal));
    if (kd->layout != CGT_KD_LAYOUT_AUTO)
        append(name, "layout", bench_kd_layout_name(kd->layout));
    if (kd->break_level)
        append(name, "break", level);
}

void bench_choice_name(const bench_choice *choice, cgt_structure structure, char name[BENCH_NAME_SIZE])
{
    char packet[16];
    snprintf(name, BENCH_NAME_SIZE, "%s", bench_structure_name(structure));
    snprintf(packet, sizeof packet, "%u", (unsigned)choice->packet);
    if (structure == CGT_STRUCTURE_KD || structure == CGT_STRUCTURE_KD_ROPES)
        append_kd(name, &choice->kd);
    else if (structure == CGT_STRUCTURE_BIH && choice->kd.traversal != CGT_KD_TRAVERSAL_AUTO)
        append(name, "traversal", bench_kd_traversal_name(choice->kd.traversal));
    if (choice->variant)
        append(name, "variant", choice->variant);
    if (choice->packet)
        append(name, "packet", packet);
    if (choice->tile != CGT_TILE_SHAPE_AUTO)
        append(name, "tile", bench_tile_name(choice->tile));
    if (choice->loop != CGT_LOOP_AUTO)
        append(name, "loop", bench_loop_name(choice->loop));
    if (choice->cull == CGT_CULL_NONE || choice->cull == CGT_CULL_FRUSTUM)
        append(name, "cull", bench_cull_name(choice->cull));
    if (choice->mailbox == CGT_MAILBOX_OFF)
        append(name, "mailbox", "off");
    if (choice->precision_named || choice->precision != CGT_PRECISION_ROBUST)
        append(name, "precision", bench_precision_name(choice->precision));
    if (choice->test != CGT_TRIANGLE_TEST_AUTO)
        append(name, "test", bench_triangle_test_name(choice->test));
    if (choice->grid)
        append(name, "grid", choice->grid);
}

void bench_choice_options(const bench_choice *choice, bench_counts *counts, cgt_trace_options *options,
                          cgt_research_trace_options *research)
{
    *research = (cgt_research_trace_options){.packet = choice->packet,
                                             .tile = choice->tile,
                                             .loop = choice->loop,
                                             .cull = choice->cull,
                                             .mailbox = choice->mailbox,
                                             .kd_traversal = choice->kd.traversal,
                                             .triangle_test = choice->test,
                                             .statistics = counts ? &counts->research : NULL};
    *options = (cgt_trace_options){
        .precision = choice->precision, .statistics = counts ? &counts->trace : NULL, .research = research};
}

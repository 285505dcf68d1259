/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The library as a tracer. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <cgt/all_hits.h>

#include "ways/bench_tracer.h"

int bench_context_create(uint32_t threads, const char *variant, cgt_context **context)
{
    cgt_context_options options;
    cgt_context_options_init(&options);
    options.threads = threads;
    options.variant = variant;
    const cgt_result result = cgt_context_create(&options, context);
    if (result == CGT_OK)
        return PROGRAM_OK;
    bench_failed(*context, variant ? variant : "context", result);
    cgt_context_release(*context);
    *context = NULL;
    return PROGRAM_FAILED;
}

int bench_failed(const cgt_context *context, const char *what, cgt_result result)
{
    char message[512] = "";
    cgt_context_get_error_message(context, message, sizeof message);
    program_error("%s: %s%s%s", what, cgt_get_result_string(result), message[0] ? ": " : "", message);
    return PROGRAM_FAILED;
}

static int done(const bench_tracer *t, cgt_result result)
{
    return result == CGT_OK ? PROGRAM_OK : bench_failed(t->session->context, t->session->path, result);
}

/* ---- scenes ---- */

/* Arrays of rays have no packets of pixels and no tiles: apart from precision and traversal theirs are the library's
 * choice. */
static void set_trace_options(bench_tracer *t)
{
    const bench_choice *c = &t->way->choice;
    t->research_options[0] = (cgt_research_trace_options){.packet = c->packet,
                                                          .tile = c->tile,
                                                          .loop = c->loop,
                                                          .cull = c->cull,
                                                          .mailbox = c->mailbox,
                                                          .kd_traversal = c->kd_traversal,
                                                          .triangle_test = c->test};
    t->research_options[1] =
        (cgt_research_trace_options){.loop = c->loop, .kd_traversal = c->kd_traversal, .triangle_test = c->test};
    t->options = (cgt_trace_options){.precision = c->precision, .research = &t->research_options[0]};
    t->ray_options = (cgt_trace_options){.precision = c->precision, .research = &t->research_options[1]};
}

static int library_open(bench_tracer *t)
{
    const bench_choice *c = &t->way->choice;
    const cgt_research_scene_options research = {.resolution = {c->resolution[0], c->resolution[1], c->resolution[2]},
                                                 .kd_layout = c->kd_layout,
                                                 .kd_break_level = c->kd_break};
    const cgt_scene_options options = {.structure = t->way->structure, .rays = t->way->rays, .research = &research};
    set_trace_options(t);
    if (t->built_by != t)
        return PROGRAM_OK;
    const cgt_result result = cgt_scene_create(t->session->context, &options, &t->scene);
    if (result == CGT_ERROR_UNSUPPORTED) {
        char message[256] = "";
        cgt_context_get_error_message(t->session->context, message, sizeof message);
        program_error("%s: no %s: left out: %s", t->session->path, bench_structures[t->way->structure], message);
        t->left_out = 1;
        return PROGRAM_OK;
    }
    return done(t, result);
}

static void library_close(bench_tracer *t)
{
    cgt_scene_release(t->scene);
    t->scene = NULL;
    t->has_geometry = 0;
}

static cgt_result set_spheres(bench_tracer *t)
{
    const bench_session *s = t->session;
    const cgt_spheres spheres = {.count = s->count,
                                 .centers = cgt_floats(s->input.moving, 4 * sizeof(float)),
                                 .radii = cgt_floats(s->input.moving + 3, 4 * sizeof(float))};
    return cgt_scene_set_spheres(t->scene, &t->geometry, &spheres);
}

static cgt_result set_triangles(bench_tracer *t)
{
    const bench_session *s = t->session;
    const cgt_triangles triangles = {.count = s->input.triangles,
                                     .indices = cgt_uint32s(s->input.is_soup ? NULL : s->input.index, 0),
                                     .vertex_count = s->count,
                                     .vertices = cgt_floats(s->input.moving, 0)};
    return cgt_scene_set_triangles(t->scene, &t->geometry, &triangles);
}

static cgt_result set_capsules(bench_tracer *t)
{
    const bench_session *s = t->session;
    const cgt_capsules capsules = {.count = s->count / 2,
                                   .vertex_count = s->count,
                                   .vertices = cgt_floats(s->input.moving, 4 * sizeof(float)),
                                   .radii = cgt_floats(s->input.moving + 3, 8 * sizeof(float))};
    return cgt_scene_set_capsules(t->scene, &t->geometry, &capsules);
}

static void library_move(bench_tracer *t) { (void)t; } /* the scene refers to the session's array */

static int library_commit(bench_tracer *t)
{
    cgt_result result = CGT_OK;
    if (t->built_by != t)
        return PROGRAM_OK;
    if (!t->has_geometry)
        t->geometry = CGT_INVALID_ID;
    if (!t->has_geometry || t->held != t->session->count)
        result = t->session->input.triangles ? set_triangles(t)
                 : t->session->input.index   ? set_capsules(t)
                                             : set_spheres(t);
    if (result == CGT_OK) {
        t->has_geometry = 1;
        t->held = t->session->count;
        result = cgt_scene_commit(t->scene);
    }
    return done(t, result);
}

/* ---- frames ---- */

static int library_picture(bench_tracer *t, const bench_planes *planes, bench_picture *picture)
{
    cgt_frame frame;
    if (picture) {
        cgt_frame_init(&frame, picture->width, picture->height);
        frame.visitor = bench_shade_tile;
        frame.visitor_user = picture;
        frame.visitor_fields = CGT_FIELD_PRIMITIVE | CGT_FIELD_NORMAL;
    } else
        bench_planes_frame(planes, &frame);
    return done(t, cgt_trace_camera(t->built_by->scene, t->session->camera, &frame, &t->options));
}

static void library_planes(bench_tracer *t, const bench_planes *planes)
{
    (void)t;
    (void)planes; /* have the hits */
}

static int library_aim(bench_tracer *t, const bench_set *set, uint32_t light)
{
    (void)t;
    (void)set;
    (void)light; /* points are all that the library needs */
    return PROGRAM_OK;
}

/* ---- rays ---- */

static cgt_rays part_of(const cgt_rays *rays, uint64_t first, uint64_t count)
{
    cgt_rays part = *rays;
    const float **const arrays[] = {&part.org[0], &part.org[1], &part.org[2], &part.dir[0],
                                    &part.dir[1], &part.dir[2], &part.t_min,  &part.t_max};
    part.count = count;
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        *arrays[i] = *arrays[i] ? *arrays[i] + first : NULL;
    part.skip_primitive = rays->skip_primitive ? rays->skip_primitive + first : NULL;
    return part;
}

/* A call of one ray, for programs that have no more at a time. */
static cgt_result trace_single(const cgt_scene *scene, const cgt_rays *part, bench_query query,
                               const bench_found *found, uint64_t i, const cgt_trace_options *options)
{
    const cgt_hit skip = {.primitive = part->skip_primitive ? part->skip_primitive[0] : CGT_INVALID_ID};
    const cgt_single_ray ray = {.org = {part->org[0][0], part->org[1][0], part->org[2][0]},
                                .dir = {part->dir[0][0], part->dir[1][0], part->dir[2][0]},
                                .t_min = part->t_min ? part->t_min[0] : 0,
                                .t_max = part->t_max ? part->t_max[0] : 0,
                                .skip = part->skip_primitive ? &skip : NULL};
    cgt_hit hit;
    bool occluded = false;
    if (query == BENCH_ANY) {
        const cgt_result result = cgt_occluded_ray(scene, &ray, &occluded, options);
        found->occluded[i] = occluded;
        return result;
    }
    const cgt_result result = cgt_trace_ray(scene, &ray, &hit, options);
    if (result == CGT_OK) {
        found->t[i] = hit.t;
        found->primitive[i] = hit.primitive;
    }
    return result;
}

static cgt_result trace_points(const cgt_scene *scene, const cgt_light *light, const cgt_rays *part, uint8_t *occluded,
                               const cgt_trace_options *options)
{
    const cgt_points points = {.count = part->count,
                               .position = {part->org[0], part->org[1], part->org[2]},
                               .skip_primitive = part->skip_primitive};
    return cgt_occluded_points(scene, light, &points, occluded, options);
}

/* Each call counts its hits in the flags' memory, where nothing else of this query lies. */
static cgt_result trace_four(const cgt_scene *scene, const cgt_rays *part, const bench_found *found, uint64_t first,
                             const cgt_trace_options *options)
{
    const uint64_t at = BENCH_FOUR_HITS * first;
    const cgt_hit_rows rows = {.capacity = BENCH_FOUR_HITS,
                               .hits = {.t = found->t + at, .primitive = found->primitive + at},
                               .count = (uint32_t *)(void *)(found->occluded + at)};
    return cgt_trace_all_rays(scene, part, NULL, &rows, options);
}

static cgt_result trace_part(bench_tracer *t, const bench_set *set, uint64_t first, uint64_t count, uint32_t light,
                             const bench_found *found, const cgt_trace_options *options)
{
    const cgt_scene *scene = t->built_by->scene;
    const cgt_rays part = part_of(&set->rays, first, count);
    cgt_frame frame;
    switch (set->query) {
    case BENCH_PICTURE:
        bench_planes_frame(&found->planes, &frame);
        return cgt_trace_camera(scene, t->session->camera, &frame, options);
    case BENCH_LIT_PICTURE:
        bench_planes_frame(&found->planes, &frame);
        return cgt_occluded_frame(scene, t->session->camera, &frame, set->light, set->lights, NULL, found->occluded,
                                  options);
    case BENCH_POINTS:
        return trace_points(scene, &set->light[light], &part, found->occluded + light * set->rays.count + first,
                            options);
    case BENCH_FOUR: return trace_four(scene, &part, found, first, options);
    default:
        if (count == 1)
            return trace_single(scene, &part, set->query, found, first, options);
        if (set->query == BENCH_ANY)
            return cgt_occluded_rays(scene, &part, found->occluded + first, options);
        const cgt_hits hits = {.t = found->t + first, .primitive = found->primitive + first};
        return cgt_trace_rays(scene, &part, &hits, options);
    }
}

static int library_trace(bench_tracer *t, const bench_set *set, uint64_t first, uint64_t count, uint32_t light,
                         const bench_found *found, bench_counts *counts)
{
    const cgt_trace_options *usual = set->query == BENCH_PICTURE ? &t->options : &t->ray_options;
    cgt_trace_options options = *usual;
    cgt_research_trace_options research;
    if (counts) {
        research = *(const cgt_research_trace_options *)usual->research;
        research.statistics = &counts->research;
        options.statistics = &counts->trace;
        options.research = &research;
    }
    return done(t, trace_part(t, set, first, count, light, found, &options));
}

/* ---- a frame's secondary rays ---- */

static cgt_result sink_batch(void *user, const cgt_rays *batch, const cgt_hits *scratch, uint8_t *occluded)
{
    const bench_tracer *t = user;
    const cgt_scene *scene = t->built_by->scene;
    if (!t->nearest)
        return cgt_occluded_rays(scene, batch, occluded, &t->ray_options);
    const cgt_result result = cgt_trace_rays(scene, batch, scratch, &t->ray_options);
    for (uint64_t i = 0; i < batch->count; i++)
        occluded[i] = scratch->t[i] < INFINITY;
    return result;
}

/* The library gets points and a light. A tile is one task, which the calling thread runs. */
static cgt_result sink_tile(void *user, const float light[3], const cgt_rays *tile, uint8_t *occluded)
{
    const bench_tracer *t = user;
    const cgt_light lamp = {.position = {light[0], light[1], light[2]}, .kind = CGT_LIGHT_POINT};
    return trace_points(t->built_by->scene, &lamp, tile, occluded, &t->ray_options);
}

static bench_rays_sink library_sink(bench_tracer *t, int coherent, int nearest, int form)
{
    (void)coherent;
    (void)form;
    t->nearest = nearest;
    return (bench_rays_sink){.batch = sink_batch, .tile = sink_tile, .user = t};
}

const bench_engine bench_library_engine = {
    library_open,   library_close, library_move,  library_commit, library_picture,
    library_planes, library_aim,   library_trace, library_sink,   1};

/* ---- what the library tells ---- */

int bench_library_inspect(bench_tracer *t)
{
    if (t->way->embree || t->left_out || t->built_by != t)
        return PROGRAM_OK;
    cgt_result result = cgt_scene_get_statistics(t->scene, &t->built);
    if (result == CGT_OK)
        result = cgt_research_get_scene_statistics(t->scene, &t->research);
    const cgt_structure asked = t->way->structure, built = t->built.structure;
    /* a scene without a valid primitive correctly has no structure */
    if (result == CGT_OK && asked != CGT_STRUCTURE_AUTO && built != asked && built != CGT_STRUCTURE_AUTO) {
        program_error("%s: no %s: left out: the library builds %s", t->session->path, bench_structures[asked],
                      bench_structures[built]);
        t->left_out = 1;
    }
    return done(t, result);
}

void bench_library_cells(const bench_tracer *t, bench_table *table)
{
    const cgt_scene_statistics *built = &t->built_by->built;
    const cgt_research_scene_statistics *r = &t->built_by->research;
    BENCH_ROW(table, CELL("bytes", built->structure_bytes), CELL("kd_nodes", r->kd_nodes),
              CELL("kd_leaves", r->kd_leaves), CELL("kd_depth", r->kd_depth),
              CELL("kd_cost", r->kd_nodes ? r->kd_cost : NAN), CELL("bih_nodes", r->bih_nodes),
              CELL("bih_leaves", r->bih_leaves), CELL("bih_depth", r->bih_depth),
              CELL("chosen", t->way->embree     ? "embree"
                             : built->structure ? bench_structures[built->structure]
                                                : "none"),
              CELL("reason", t->way->embree ? "-" : built->reason));
}

int bench_library_describe(bench_tracer *t, const bench_planes *planes)
{
    const cgt_scene_statistics *built = &t->built_by->built;
    const cgt_research_scene_statistics *r = &t->built_by->research;
    const bench_set set = {.query = BENCH_PICTURE};
    const bench_found found = {.planes = *planes};
    bench_counts counts;
    memset(&counts, 0, sizeof counts);
    if (library_trace(t, &set, 0, 0, 0, &found, &counts) != PROGRAM_OK)
        return PROGRAM_FAILED;
    fprintf(
        stderr,
        "%s: %s, variant %s, structure %s (%s), grid %ux%ux%u, kd-tree of %u nodes in %u levels, packet %u, tile %s, "
        "loop %s, %u primitives, %u skipped, %zu bytes, %.2f ray tests per ray\n",
        t->session->scene, t->config, cgt_context_get_variant(t->session->context), bench_structures[built->structure],
        built->reason, (unsigned)r->resolution[0], (unsigned)r->resolution[1], (unsigned)r->resolution[2],
        (unsigned)r->kd_nodes, (unsigned)r->kd_depth, (unsigned)counts.research.packet_size,
        bench_tiles_names[counts.research.tile], bench_loops[counts.research.loop], (unsigned)built->primitives,
        (unsigned)(built->skipped_not_finite + built->skipped_radius + built->skipped_degenerate), built->bytes,
        (double)counts.trace.ray_tests / (double)(counts.trace.rays ? counts.trace.rays : 1));
    return PROGRAM_OK;
}

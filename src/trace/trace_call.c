/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the tracing calls share. */
#include "trace/trace_call.h"

#include <string.h>

#include "builders/bvh/bvh_on_demand.h"
#include "core/float_environment.h"

/* Measured (docs/reports/coherent_grid_traversal.md): the largest packets share the most work, whether a sphere is 3
 * pixels across or 40; the loops are within a few per cent of each other on x86-64. */
#define DEFAULT_PACKET 16
#define DEFAULT_FLATTENED false

static const cgt_trace_options default_options;
static const cgt_research_trace_options default_research;

void cgt_trace_options_init(cgt_trace_options *options) { *options = default_options; }

void cgt_research_trace_options_init(cgt_research_trace_options *options) { *options = default_research; }

/* ---- options to settings ---- */

static const cgt_research_trace_options *research_options(const cgt_trace_options *o)
{
    return o->research ? o->research : &default_research;
}

static cgt_result check_options(cgt_context *c, const cgt_trace_options *o)
{
    const cgt_research_trace_options *r = research_options(o);
    const struct {
        const char *name;
        unsigned value, last;
    } option[] = {{"precision", o->precision, CGT_PRECISION_FAST},
                  {"tile", r->tile, CGT_TILE_SHAPE_STRIP},
                  {"loop", r->loop, CGT_LOOP_FLATTENED},
                  {"cull", r->cull, CGT_CULL_BLOCKS},
                  {"mailbox", r->mailbox, CGT_MAILBOX_OFF},
                  {"kd_traversal", r->kd_traversal, CGT_KD_TRAVERSAL_PACKET},
                  {"triangle_test", r->triangle_test, CGT_TRIANGLE_TEST_ACCELERATED}};
    for (size_t i = 0; i < sizeof option / sizeof option[0]; i++)
        if (option[i].value > option[i].last)
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "trace options: %s %d is unknown", option[i].name,
                            (int)option[i].value);
    if (r->packet != 0 && r->packet != 4 && r->packet != 8 && r->packet != 16)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "trace options: packet %u: 4, 8, 16 or 0", r->packet);
    if (r->triangle_test != CGT_TRIANGLE_TEST_AUTO && o->precision != CGT_PRECISION_FAST)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT,
                        "trace options: triangle_test %d has no error bound: precision must be FAST",
                        (int)r->triangle_test);
    return CGT_OK;
}

static cgt_result choose_settings(cgt_context *c, const cgt_trace_options *o, bool camera, cgt_trace_settings *s)
{
    const cgt_research_trace_options *r = research_options(o);
    const cgt_result result = check_options(c, o);
    if (result != CGT_OK)
        return result;
    *s = (cgt_trace_settings){.strip = camera && r->tile == CGT_TILE_SHAPE_STRIP,
                              .flattened = r->loop == CGT_LOOP_AUTO ? DEFAULT_FLATTENED : r->loop == CGT_LOOP_FLATTENED,
                              .cull = r->cull == CGT_CULL_AUTO ? CGT_CULL_BLOCKS : r->cull,
                              .mailbox = r->mailbox != CGT_MAILBOX_OFF,
                              .kd_traversal =
                                  r->kd_traversal == CGT_KD_TRAVERSAL_AUTO ? CGT_KD_TRAVERSAL_PACKET : r->kd_traversal,
                              .precision = o->precision,
                              .triangle_test = r->triangle_test};
    if (s->strip && r->packet > 4)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT,
                        "trace options: strips of four scanlines take packets of 4, not %u", r->packet);
    if (camera)
        s->packet = s->strip ? 4 : r->packet ? r->packet : DEFAULT_PACKET;
    return CGT_OK;
}

bool cgt_requires_packets(const cgt_trace_options *options)
{
    const cgt_research_trace_options *r = options ? research_options(options) : &default_research;
    return r->packet || r->tile != CGT_TILE_SHAPE_AUTO || r->loop != CGT_LOOP_AUTO || r->cull != CGT_CULL_AUTO ||
           r->mailbox != CGT_MAILBOX_AUTO || r->triangle_test != CGT_TRIANGLE_TEST_AUTO;
}

cgt_result cgt_trace_prepare(const cgt_scene *scene, const cgt_trace_options *options, bool camera,
                             cgt_trace_settings *settings, cgt_trace_counter *counter)
{
    const cgt_trace_options *o = options ? options : &default_options;
    counter->enabled = o->statistics || research_options(o)->statistics;
    if (counter->enabled) { /* reading the clock takes as long as a call of one ray */
        counter->start_ms = cgt_now_ms();
        for (size_t i = 0; i < CGT_COUNTS; i++)
            atomic_init(&counter->sum[i], 0);
    }
    if (!scene->is_committed)
        return cgt_fail(scene->context, CGT_ERROR_NOT_COMMITTED, "trace: the scene was not committed since it changed");
    if (research_options(o)->triangle_test != CGT_TRIANGLE_TEST_AUTO && scene->committed_scene.prims.capsules)
        return cgt_fail(scene->context, CGT_ERROR_UNSUPPORTED,
                        "trace options: triangle_test: the scene has capsules, which only AUTO takes");
    return choose_settings(scene->context, o, camera, settings);
}

cgt_result cgt_ready_structures(const cgt_scene *scene, uint64_t rays, cgt_trace_settings *settings)
{
    return cgt_bvh_build_on_demand(scene, rays, &settings->use_bvh);
}

/* ---- visitors ---- */

void cgt_visits_begin(cgt_visits *visits)
{
    atomic_init(&visits->stopped, false);
    cgt_float_environment_enter(&visits->callers); /* keeps it for the visitor */
    cgt_float_environment_leave(&visits->callers);
}

void cgt_visits_enter(const cgt_visits *visits) { cgt_float_environment_leave(&visits->callers); }

void cgt_visits_leave(cgt_visits *visits, cgt_visit visit)
{
    cgt_float_environment visitors;
    cgt_float_environment_enter(&visitors);
    if (visit != CGT_VISIT_CONTINUE)
        atomic_store_explicit(&visits->stopped, true, memory_order_relaxed);
}

cgt_result cgt_visits_end(cgt_context *c, const cgt_visits *visits, const char *message)
{
    return cgt_visits_stopped(visits) ? cgt_fail(c, CGT_ERROR_STOPPED, "%s", message) : CGT_OK;
}

/* ---- checks ---- */

static cgt_result check_stride(cgt_context *c, const char *what, const char *name, size_t stride, uint64_t count)
{
    if (stride % sizeof(float))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: %s is not a multiple of 4", what, name);
    if (count > (SIZE_MAX / 2) / (stride ? stride : sizeof(float)) || count / CGT_RAYS_CHUNK >= UINT32_MAX)
        return cgt_fail(c, CGT_ERROR_TOO_LARGE, "%s: count times %s leaves the address space", what, name);
    return CGT_OK;
}

cgt_result cgt_check_strides(cgt_context *c, const char *what, size_t stride, size_t vector_stride, uint64_t count)
{
    const cgt_result result = check_stride(c, what, "stride", stride, count);
    return result == CGT_OK ? check_stride(c, what, "vector_stride", vector_stride, count) : result;
}

cgt_result cgt_check_rays(cgt_context *c, const cgt_rays *r)
{
    for (int a = 0; a < 3 && r->count; a++)
        if (!r->org[a] || !r->dir[a])
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "rays: org and dir must not be NULL");
    return cgt_check_strides(c, "rays", r->stride, r->vector_stride, r->count);
}

cgt_result cgt_check_points(cgt_context *c, const cgt_points *p)
{
    for (int a = 0; a < 3 && p->count; a++)
        if (!p->position[a])
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "points: position must not be NULL");
    return cgt_check_strides(c, "points", p->stride, p->vector_stride, p->count);
}

cgt_result cgt_check_planes(cgt_context *c, const char *what, void *const plane[CGT_PLANES])
{
    for (uint32_t k = 1; k < CGT_PLANES; k++)
        if (cgt_plane_field[k] == cgt_plane_field[k - 1] && !plane[k] != !plane[k - 1])
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: %s or none", what,
                            cgt_plane_field[k] == CGT_FIELD_NORMAL ? "normal: all three" : "u and v: both");
    return CGT_OK;
}

cgt_result cgt_check_frame(cgt_context *c, const cgt_frame *f)
{
    void *const plane[CGT_PLANES] = CGT_PLANES_OF(f);
    const uint32_t all_fields =
        CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY | CGT_FIELD_NORMAL | CGT_FIELD_UV | CGT_FIELD_POSITION;
    if (!f->width || !f->height)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "frame: %u x %u pixels: at least 1 x 1", f->width, f->height);
    if (f->width > 65536 || f->height > 65536)
        return cgt_fail(c, CGT_ERROR_TOO_LARGE, "frame: %u x %u pixels: at most 65,536 a side", f->width, f->height);
    if (f->row_stride && f->row_stride < f->width)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "frame: row_stride is less than width");
    if (f->row_stride > SIZE_MAX / sizeof(float) / f->height)
        return cgt_fail(c, CGT_ERROR_TOO_LARGE, "frame: row_stride times height leaves the address space");
    if (f->vector_stride > SIZE_MAX / sizeof(float) / f->height / (f->row_stride ? f->row_stride : f->width))
        return cgt_fail(c, CGT_ERROR_TOO_LARGE,
                        "frame: vector_stride times row_stride times height leaves the address space");
    if (f->first_row >= f->height || f->row_count > f->height - f->first_row)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "frame: %u rows from row %u on: there are %u", f->row_count,
                        f->first_row, f->height);
    if (f->visitor_fields & ~all_fields)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "frame: visitor_fields has unknown bits");
    if (!f->position[0] != !f->position[1] || !f->position[0] != !f->position[2])
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "frame: position: all three or none");
    return cgt_check_planes(c, "frame", plane);
}

cgt_frame cgt_cut_frame(const cgt_frame *f)
{
    cgt_frame cut = *f;
    cut.row_count = f->row_count ? f->row_count : f->height - f->first_row;
    cut.height = f->first_row + cut.row_count;
    return cut;
}

cgt_result cgt_prepare_camera(cgt_context *c, const cgt_camera *camera, const cgt_frame *frame, cgt_camera_rays *rays)
{
    char message[CGT_CAMERA_MESSAGE_BYTES];
    cgt_float_environment callers;
    cgt_float_environment_enter(&callers);
    const cgt_result result = cgt_camera_prepare(camera, frame->width, frame->height, rays, message);
    cgt_float_environment_leave(&callers);
    return result == CGT_OK ? result : cgt_fail(c, result, "%s", message);
}

/* ---- statistics ---- */

static const char *const light_ways[CGT_LIGHT_WAYS] = {
    [CGT_LIGHT_WAY_NONE] = "",
    [CGT_LIGHT_WAY_UNSERVED] = "no tiles: they do not serve this light or this scene",
    [CGT_LIGHT_WAY_TILES] = "tiles: they took less than a BVH and its building",
    [CGT_LIGHT_WAY_TREE] = "no tiles: there is a BVH, and tiles gave up before, or the points are few",
    [CGT_LIGHT_WAY_GIVEN_UP] = "tiles: some points took too much and went another way"};

void cgt_trace_counter_add(cgt_trace_counter *counter, const cgt_counts *counts)
{
    uint64_t value[CGT_COUNTS];
    if (!counter->enabled)
        return;
    memcpy(value, counts, sizeof value);
    for (size_t i = 0; i < CGT_COUNTS; i++)
        if (value[i])
            atomic_fetch_add_explicit(&counter->sum[i], value[i], memory_order_relaxed);
}

static cgt_counts read_counts(const cgt_trace_counter *counter)
{
    uint64_t value[CGT_COUNTS];
    cgt_counts counts = {0};
    for (size_t i = 0; i < CGT_COUNTS; i++)
        value[i] = atomic_load_explicit(&counter->sum[i], memory_order_relaxed);
    memcpy(&counts, value, sizeof value);
    return counts;
}

void cgt_trace_store_statistics(const cgt_trace_options *options, const cgt_trace_settings *settings,
                                const cgt_trace_counter *counter)
{
    if (!counter->enabled)
        return;
    const cgt_counts c = read_counts(counter);
    cgt_research_trace_statistics *research = research_options(options)->statistics;
    if (options->statistics)
        *options->statistics = (cgt_trace_statistics){.rays = c.rays,
                                                      .invalid_rays = c.invalid_rays,
                                                      .hits = c.hits,
                                                      .bvh_rays = c.bvh_rays,
                                                      .tiles = c.tiles,
                                                      .packets = c.packets,
                                                      .packet_tests = c.packet_tests,
                                                      .ray_tests = c.ray_tests,
                                                      .double_tests = c.double_tests,
                                                      .exact_tests = c.exact_tests,
                                                      .exact_values = c.exact_values,
                                                      .trace_ms = cgt_now_ms() - counter->start_ms};
    if (research)
        *research =
            (cgt_research_trace_statistics){.split_packets = c.split_packets,
                                            .slices = c.slices,
                                            .cells = c.cells,
                                            .nodes = c.nodes,
                                            .leaves = c.leaves,
                                            .rope_steps = c.rope_steps,
                                            .exact_steps = c.exact_steps,
                                            .rope_loops = c.rope_loops,
                                            .references = c.references,
                                            .mailbox_skipped = c.mailbox_skipped,
                                            .cull_tests = c.cull_tests,
                                            .culled = c.culled,
                                            .early_exits = c.early_exits,
                                            .given_up = c.given_up,
                                            .light_way = light_ways[settings->light_way],
                                            .packet_size = settings->packet,
                                            .tile = settings->strip ? CGT_TILE_SHAPE_STRIP : CGT_TILE_SHAPE_SQUARE,
                                            .loop = settings->flattened ? CGT_LOOP_FLATTENED : CGT_LOOP_NESTED};
}

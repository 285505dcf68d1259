/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * compare-embree: times Embree 3 as cgt-bench frame times the library. For each frame of a trajectory the spheres or
 * vertices move, the scene is committed and all primary rays are traced; on request shadow and ambient-occlusion rays
 * as well, the latter one by one and in packets, of which the faster way counts. One row of medians per configuration,
 * in the columns of cgt-bench frame. The first frame warms up. Spheres run as Embree's own type and as user geometry,
 * which is faster: compare with the best row. scripts/compare_embree.sh runs both programs. */
#include "embree/compare_embree.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_frame_row.h"
#include "common/bench_timing.h"
#include "rays/bench_output.h"

enum { OPTION_PACKETS = 0x700, OPTION_NEAREST, OPTION_SHADE };

typedef struct embree_settings {
    bench_settings shared;
    int quality[EMBREE_QUALITIES]; /* 1: requested; none: all */
    int builtin, user;             /* kinds of spheres; none: both */
    int robust;
    bench_secondary_settings secondary;
    int nearest;
    int shade;
    uint32_t packet; /* rays; 0: the widest packets that Embree has vectors for */
    const char *isa;
    const char *output;
} embree_settings;

typedef struct embree_job {
    const embree_settings *settings;
    bench_table *table;
    RTCDevice device;
    bench_input input;
    bench_threads *threads;
    embree_view view;
    bench_planes planes;
    bench_picture picture; /* with --shade */
    bench_rays *rays;
    embree_callbacks callbacks;
    double *ms[BENCH_FRAME_TIMES];
    bench_output output;
    uint64_t open; /* ambient-occlusion rays of the last frame that hit nothing */
} embree_job;

static const char *const qualities[EMBREE_QUALITIES] = {"low", "medium", "refit"};

/* The callbacks of spheres as user geometry, by the instruction set that Embree is limited to. */
static const struct {
    const char *isa;
    embree_callbacks callbacks;
} isas[] = {
#ifdef CGT_HAVE_AVX512
    {"avx512", {embree_sphere_intersect_avx512, embree_sphere_occluded_avx512}},
#endif
#ifdef CGT_HAVE_AVX2
    {"avx2", {embree_sphere_intersect_avx2, embree_sphere_occluded_avx2}},
#endif
#ifdef CGT_HAVE_SSE
    {"avx", {embree_sphere_intersect_sse, embree_sphere_occluded_sse}},
    {"sse4.2", {embree_sphere_intersect_sse, embree_sphere_occluded_sse}},
#endif
#ifdef CGT_HAVE_NEON
    {"neon", {embree_sphere_intersect_neon, embree_sphere_occluded_neon}},
#endif
#ifdef CGT_HAVE_PORTABLE
    {"portable", {embree_sphere_intersect_portable, embree_sphere_occluded_portable}},
#endif
};
enum { ISAS = sizeof isas / sizeof isas[0] };

/* ---- Command line -------------------------------------------------------------------------------------------- */

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "Embree:", 4},
    {"quality", 'm', "NAME", 0, "low, medium or refit; may be given several times (default: all)", 4},
    {"spheres", 'G', "NAME", 0, "builtin or user; may be given twice (default: both)", 4},
    {"packets", OPTION_PACKETS, "RAYS", 0, "1, 4, 8 or 16 (default: as many as Embree has vectors for)", 4},
    {"isa", 'i', "NAME", 0, "limit Embree: sse4.2, avx, avx2 or avx512", 4},
    {"nearest", OPTION_NEAREST, NULL, 0, "ambient-occlusion rays search for the nearest hit instead of any hit", 4},
    {"shade", OPTION_SHADE, NULL, 0, "shade a picture of 8 bits a channel; no hits are stored", 4},
    {"robust", 'R', NULL, 0, "set RTC_SCENE_FLAG_ROBUST", 4},
    {"output", 'o', "HITS", 0, "write the hits of the last row's last frame: per pixel float32 t and uint32 primitive",
     4},
    {NULL, 0, NULL, 0, NULL, 0}};

static void choose_quality(embree_settings *settings, struct argp_state *state, const char *name)
{
    for (int q = 0; q < EMBREE_QUALITIES; q++)
        if (!strcmp(name, qualities[q])) {
            settings->quality[q] = 1;
            return;
        }
    argp_error(state, "-m: low, medium or refit, not %s", name);
}

static void choose_packet(embree_settings *settings, struct argp_state *state, const char *text)
{
    uint32_t rays = 0;
    bench_parse_u32(state, "--packets", text, 1, 16, &rays);
    if (rays != 1 && rays != 4 && rays != 8 && rays != 16)
        argp_error(state, "--packets: %s: 1, 4, 8 or 16 rays", text);
    settings->packet = rays;
}

static void choose_isa(embree_settings *settings, struct argp_state *state, const char *name)
{
    for (size_t i = 0; i < ISAS; i++)
        if (!strcmp(name, isas[i].isa)) {
            settings->isa = name;
            return;
        }
    argp_error(state, "-i: this build has no %s", name);
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    embree_settings *settings = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &settings->shared;
        state->child_inputs[1] = &settings->secondary;
        return 0;
    case 'm': choose_quality(settings, state, argument); return 0;
    case 'G':
        if (strcmp(argument, "builtin") != 0 && strcmp(argument, "user") != 0)
            argp_error(state, "-G: builtin or user, not %s", argument);
        *(argument[0] == 'b' ? &settings->builtin : &settings->user) = 1;
        return 0;
    case OPTION_PACKETS: choose_packet(settings, state, argument); return 0;
    case 'i': choose_isa(settings, state, argument); return 0;
    case OPTION_NEAREST: settings->nearest = 1; return 0;
    case OPTION_SHADE: settings->shade = 1; return 0;
    case 'R': settings->robust = 1; return 0;
    case 'o': settings->output = argument; return 0;
    case ARGP_KEY_END:
        if (settings->shared.threads == 0)
            argp_error(state, "-t: 1 or more");
        if (settings->shade && (settings->secondary.lit || settings->secondary.ao))
            argp_error(state, "--shade stores no hits, from which secondary rays would start: leave out -l and -a");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- One row ------------------------------------------------------------------------------------------------- */

/* Shadow rays go in packets, ambient-occlusion rays in the faster of two forms. */
static void measure_arrays(embree_job *job, RTCScene scene, double ms[BENCH_FRAME_TIMES])
{
    const embree_settings *s = job->settings;
    embree_arrays arrays = {.scene = scene, .threads = job->threads, .packet = job->view.packet, .coherent = 1};
    uint64_t hidden;
    ms[BENCH_SHADOW] = ms[BENCH_AO] = 0.0;
    if (!s->secondary.lit && !s->secondary.ao)
        return;
    embree_view_planes(&job->view, &job->planes);
    bench_rays_set_sink(job->rays, embree_arrays_trace, &arrays);
    bench_rays_set_tile_sink(job->rays, embree_arrays_trace_tile);
    if (s->secondary.lit) {
        const double begin = bench_now_ms();
        bench_rays_shadow(job->rays, NULL, NULL, s->secondary.light, &hidden);
        ms[BENCH_SHADOW] = bench_now_ms() - begin;
    }
    arrays.coherent = 0;
    arrays.nearest = s->nearest;
    for (int single = 0; single < 2 && s->secondary.ao; single++) {
        if (single)
            arrays.packet = 1;
        const double begin = bench_now_ms();
        bench_rays_ao(job->rays, NULL, NULL, s->secondary.ao, &job->open);
        const double taken = bench_now_ms() - begin;
        ms[BENCH_AO] = single && ms[BENCH_AO] < taken ? ms[BENCH_AO] : taken;
    }
}

static void measure_frame(embree_job *job, embree_moving *moving, size_t frame, double ms[BENCH_FRAME_TIMES])
{
    embree_moving_move(moving, frame);
    const double begin = bench_now_ms();
    embree_moving_commit(moving, frame);
    const double built = bench_now_ms();
    embree_view_trace(&job->view, moving->scene, job->threads);
    const double end = bench_now_ms();
    ms[BENCH_BUILD] = built - begin;
    ms[BENCH_PRIMARY] = end - built;
    measure_arrays(job, moving->scene, ms);
    ms[BENCH_FRAME] = end - begin + ms[BENCH_SHADOW] + ms[BENCH_AO];
}

/* Returns how many frames were measured. */
static size_t measure_frames(embree_job *job, embree_moving *moving)
{
    const size_t total = job->input.frames * job->settings->shared.repeat;
    size_t measured = 0;
    for (size_t i = 0; i < total; i++) {
        double ms[BENCH_FRAME_TIMES];
        measure_frame(job, moving, i % job->input.frames, ms);
        if (i == 0 && total > 1)
            continue;
        for (int c = 0; c < BENCH_FRAME_TIMES; c++)
            job->ms[c][measured] = ms[c];
        measured++;
    }
    return measured;
}

static int run_row(embree_job *job, embree_quality quality, int user)
{
    embree_moving moving;
    char config[64];
    const char *kind = job->input.index ? "" : user ? "-user" : "-builtin";
    if (embree_moving_create(&moving, job->device, &job->input, quality, user, job->settings->robust,
                             &job->callbacks)) {
        program_error("Embree: no scene, or out of memory");
        return PROGRAM_FAILED;
    }
    job->view.picture = job->settings->shade ? &job->picture : NULL;
    const size_t measured = measure_frames(job, &moving);
    job->view.picture = NULL;
    if (job->settings->shade) /* the hits of the last frame, not timed */
        embree_view_trace(&job->view, moving.scene, job->threads);
    embree_view_planes(&job->view, &job->planes);
    embree_moving_release(&moving);
    const enum RTCError error = rtcGetDeviceError(job->device);
    if (error != RTC_ERROR_NONE) {
        program_error("Embree: error %d", (int)error);
        return PROGRAM_FAILED;
    }
    snprintf(config, sizeof config, "embree-%s%s%s%s", qualities[quality], kind, job->settings->robust ? ",robust" : "",
             job->settings->shade ? ",shade" : "");
    bench_frame_row(job->table, config, job->settings->shared.threads, job->ms, measured, &job->planes, job->open);
    return PROGRAM_OK;
}

static int run_rows(embree_job *job)
{
    const embree_settings *s = job->settings;
    const int any = s->quality[EMBREE_LOW] || s->quality[EMBREE_MEDIUM] || s->quality[EMBREE_REFIT];
    int code = PROGRAM_OK;
    bench_table_section(job->table, "frame");
    for (int user = 0; user < 2; user++)
        for (int q = 0; q < EMBREE_QUALITIES && code == PROGRAM_OK; q++) {
            if (any && !s->quality[q])
                continue;
            if (job->input.index ? user : (s->builtin || s->user) && !(user ? s->user : s->builtin))
                continue;
            code = run_row(job, (embree_quality)q, user);
        }
    return code;
}

/* ---- Whole --------------------------------------------------------------------------------------------------- */

/* Rays of the widest packets that Embree has vectors for on this CPU, within its limit. */
static uint32_t native_packet(RTCDevice device)
{
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED))
        return 16;
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED))
        return 8;
    return rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED) ? 4 : 1;
}

/* Vectors as wide as Embree's packets. */
static embree_callbacks find_callbacks(const embree_settings *settings, uint32_t packet)
{
    const char *wanted = settings->isa ? settings->isa : packet == 16 ? "avx512" : packet == 8 ? "avx2" : "";
    for (size_t i = 0; i < ISAS; i++)
        if (!strcmp(wanted, isas[i].isa))
            return isas[i].callbacks;
    for (size_t i = 0; i < ISAS; i++) /* four lanes, which any CPU of the kind runs */
        if (strncmp(isas[i].isa, "avx", 3) != 0)
            return isas[i].callbacks;
    return isas[ISAS - 1].callbacks;
}

static int open_device(embree_job *job)
{
    const embree_settings *settings = job->settings;
    char text[128];
    snprintf(text, sizeof text, "threads=%u,set_affinity=0%s%s", (unsigned)settings->shared.threads,
             settings->isa ? ",max_isa=" : "", settings->isa ? settings->isa : "");
    job->device = rtcNewDevice(text);
    if (!job->device) {
        program_error("Embree: no device, error %d", (int)rtcGetDeviceError(NULL));
        return PROGRAM_FAILED;
    }
    return PROGRAM_OK;
}

static int prepare(embree_job *job)
{
    const embree_settings *settings = job->settings;
    const bench_settings *shared = &settings->shared;
    if (bench_input_load_file(&job->input, shared, shared->paths[0]))
        return PROGRAM_FAILED;
    if (bench_output_begin(&job->output, settings->output))
        return PROGRAM_FAILED;
    if (open_device(job) != PROGRAM_OK)
        return PROGRAM_FAILED;
    const uint32_t native = native_packet(job->device);
    job->callbacks = find_callbacks(settings, native);
    int complete = !embree_view_create(&job->view, shared, settings->packet ? settings->packet : native);
    complete = complete && !bench_planes_create(&job->planes, shared->width, shared->height);
    complete = complete && (!settings->shade || !bench_picture_create(&job->picture, shared->width, shared->height));
    complete = complete && (job->threads = bench_threads_create(shared->threads)) != NULL;
    complete = complete &&
               (job->rays = bench_rays_create(job->threads, &job->view.axes, &job->planes, settings->secondary.ao));
    if (shared->repeat > SIZE_MAX / sizeof(double) / job->input.frames)
        complete = 0;
    for (int c = 0; complete && c < BENCH_FRAME_TIMES; c++)
        complete = (job->ms[c] = calloc(job->input.frames * shared->repeat, sizeof(double))) != NULL;
    if (complete)
        return PROGRAM_OK;
    program_error("out of memory or threads");
    return PROGRAM_FAILED;
}

int main(int argc, char **argv)
{
    static const struct argp_child children[] = {
        {&bench_settings_argp, 0, NULL, 0}, {&bench_secondary_argp, 0, NULL, 0}, {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "FILE",
        .children = children,
        .doc = "Times Embree on a trajectory of spheres or triangles as cgt-bench frame times the library: build and "
               "primary rays, shadow and ambient-occlusion rays. --variant, --packet and --grid are the library's, and "
               "have no effect here."};
    embree_settings settings;
    embree_job job;

    program_init("compare-embree");
    out_file_catch_signals(NULL);
    memset(&settings, 0, sizeof settings);
    bench_settings_init(&settings.shared);
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return program_exit(PROGRAM_USAGE);
    memset(&job, 0, sizeof job);
    job.settings = &settings;
    job.table = bench_table_open(settings.shared.json_path);
    int code = job.table ? prepare(&job) : PROGRAM_FAILED;
    if (code == PROGRAM_OK)
        code = run_rows(&job);
    if (bench_output_end(&job.output, code == PROGRAM_OK ? &job.planes : NULL))
        code = PROGRAM_FAILED;
    if (bench_table_close(job.table))
        code = PROGRAM_FAILED;
    for (int c = 0; c < BENCH_FRAME_TIMES; c++)
        free(job.ms[c]);
    bench_rays_release(job.rays);
    bench_threads_release(job.threads);
    bench_planes_release(&job.planes);
    bench_picture_release(&job.picture);
    embree_view_release(&job.view);
    bench_input_release(&job.input);
    if (job.device)
        rtcReleaseDevice(job.device);
    return program_exit(code);
}

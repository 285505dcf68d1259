/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The report of a run; see render_report.h. */
#include "render/render_report.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static const char *unit_of(const render_report *report)
{
    return report->kind == CGT_TRAJECTORY_TRIANGLES ? "triangles" : "spheres";
}

int render_report_open(render_report *report, const char *log_path, char *error, size_t error_size)
{
    memset(report, 0, sizeof *report);
    if (!log_path)
        return 0;
    report->log_path = log_path;
    report->log = fopen(log_path, "w");
    if (!report->log) {
        snprintf(error, error_size, "%s: cannot write: %s", log_path, strerror(errno));
        return -1;
    }
    fprintf(report->log, "frame\tstep\tprimitives\tskipped\thits\tread_ms\tcolor_ms\tbuild_ms\ttrace_ms\twrite_ms\n");
    return 0;
}

static void add_counts(render_counts *sum, const render_counts *frame)
{
    sum->trace.rays += frame->trace.rays;
    sum->trace.invalid_rays += frame->trace.invalid_rays;
    sum->trace.hits += frame->trace.hits;
    sum->trace.tiles += frame->trace.tiles;
    sum->trace.packets += frame->trace.packets;
    sum->research.split_packets += frame->research.split_packets;
    sum->research.slices += frame->research.slices;
    sum->research.cells += frame->research.cells;
    sum->research.references += frame->research.references;
    sum->research.mailbox_skipped += frame->research.mailbox_skipped;
    sum->research.cull_tests += frame->research.cull_tests;
    sum->research.culled += frame->research.culled;
    sum->trace.packet_tests += frame->trace.packet_tests;
    sum->trace.ray_tests += frame->trace.ray_tests;
    sum->trace.double_tests += frame->trace.double_tests;
    sum->trace.exact_tests += frame->trace.exact_tests;
    sum->trace.exact_values += frame->trace.exact_values;
    sum->research.early_exits += frame->research.early_exits;
    sum->research.packet_size = frame->research.packet_size;
    sum->research.tile = frame->research.tile;
    sum->research.loop = frame->research.loop;
}

static void write_log(FILE *log, const frame_record *f)
{
    fprintf(log, "%" PRIu64 "\t%" PRId64 "\t%" PRIu32 "\t%" PRIu32 "\t%" PRIu64, f->number, f->step, f->primitives,
            f->skipped_not_finite + f->skipped_radius + f->skipped_degenerate, f->hits);
    fprintf(log, "\t%.4f\t%.4f\t%.4f\t%.4f\t%.4f\n", f->read_ms, f->color_ms, f->build_ms, f->trace_ms, f->write_ms);
}

int render_report_add(render_report *report, const frame_record *frame, const cgt_scene_statistics *scene,
                      const render_counts *traced, char *error, size_t error_size)
{
    if (report->count == report->capacity) {
        const size_t capacity = report->capacity ? report->capacity * 2 : 256;
        frame_record *grown =
            capacity <= SIZE_MAX / sizeof *grown ? realloc(report->frames, capacity * sizeof *grown) : NULL;
        if (!grown) {
            snprintf(error, error_size, "out of memory after %zu frames", report->count);
            return -1;
        }
        report->frames = grown;
        report->capacity = capacity;
    }
    report->frames[report->count++] = *frame;
    if (traced) {
        add_counts(&report->traced, traced);
        if (!report->has_stats || scene->primitives >= report->scene.primitives) {
            report->scene = *scene;
            report->traced.scene = traced->scene;
        }
        report->has_stats = 1;
    }
    if (report->log)
        write_log(report->log, frame);
    return 0;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sum and median of the member at `offset` over all frames. scratch: a double per frame. */
static double column(const render_report *report, size_t offset, double *scratch, double *median)
{
    double sum = 0.0;
    const size_t n = report->count;
    for (size_t i = 0; i < n; i++) {
        memcpy(&scratch[i], (const char *)&report->frames[i] + offset, sizeof scratch[i]);
        sum += scratch[i];
    }
    qsort(scratch, n, sizeof *scratch, compare);
    *median = n % 2 ? scratch[n / 2] : 0.5 * (scratch[n / 2 - 1] + scratch[n / 2]);
    return sum;
}

static void print_rate(FILE *to, const char *name, size_t frames, double ms, const char *scope)
{
    if (ms > 0.0)
        fprintf(to, "%-18s%9.1f     %s\n", name, (double)frames * 1000.0 / ms, scope);
}

static void print_times(const render_report *report, uint64_t rays, uint64_t hits, uint32_t images, FILE *to)
{
    double read, color, build, trace, write;
    double *scratch = malloc(report->count * sizeof *scratch);
    if (!scratch) {
        fprintf(to, "(no memory for the medians)\n");
        return;
    }
    const double reads = column(report, offsetof(frame_record, read_ms), scratch, &read);
    const double colors = column(report, offsetof(frame_record, color_ms), scratch, &color);
    const double builds = column(report, offsetof(frame_record, build_ms), scratch, &build);
    const double traces = column(report, offsetof(frame_record, trace_ms), scratch, &trace);
    const double writes = column(report, offsetof(frame_record, write_ms), scratch, &write);
    free(scratch);
    fprintf(to, "%-18s%9.3f ms  median\n", "build", build);
    fprintf(to, "%-18s%9.3f ms  median, shading included; %.1f %% of the rays hit\n", "trace", trace,
            rays ? 100.0 * (double)hits / ((double)rays * (double)report->count) : 0.0);
    fprintf(to, "%-18s%9.3f ms  median\n", "colours", color);
    if (images)
        fprintf(to, "%-18s%9.3f ms  median\n", "image writing", write);
    fprintf(to, "%-18s%9.3f ms  median\n", "reading", read);
    const double frame = colors + builds + traces;
    print_rate(to, "frames per second", report->count, frame, "colours, build and trace");
    if (images)
        print_rate(to, "", report->count, frame + writes, "with image writing");
    print_rate(to, "", report->count, frame + writes + reads,
               images ? "with image writing and reading" : "with reading");
}

static void print_stats(const render_report *report, FILE *to)
{
    const cgt_scene_statistics *s = &report->scene;
    const cgt_research_scene_statistics *r = &report->traced.scene;
    const cgt_trace_statistics *t = &report->traced.trace;
    const cgt_research_trace_statistics *u = &report->traced.research;
    const double n = (double)report->count, rays = t->rays ? (double)t->rays : 1.0;
    fprintf(to, "structure         %" PRIu32 "x%" PRIu32 "x%" PRIu32 " cells; %s\n", r->resolution[0], r->resolution[1],
            r->resolution[2], s->reason);
    fprintf(to, "references        %" PRIu64, r->references);
    if (s->structure == CGT_STRUCTURE_QUEUE_GRID)
        fprintf(to, ", %" PRIu64 " of them overflow in %" PRIu32 " cells; %" PRIu32 " %s larger than a cell",
                r->overflow_references, r->overflow_cells, r->large_primitives, unit_of(report));
    fprintf(to, "\nmemory            %zu bytes", s->bytes);
    if (s->structure == CGT_STRUCTURE_QUEUE_GRID)
        fprintf(to, "; on a Cell SPU %zu bytes: %s its 256 KB", r->local_store_bytes,
                r->fits_local_store ? "fits into" : "does not fit into");
    fputc('\n', to);
    fprintf(to, "                  (the frame with the most %s; below: per frame)\n", unit_of(report));
    fprintf(to, "tiles             %.0f traced as a whole\n", (double)t->tiles / n);
    fprintf(to, "packets           %.0f of %" PRIu32 "x%" PRIu32 " rays, %.0f split, %.0f left early\n",
            (double)t->packets / n, u->packet_size, u->packet_size, (double)u->split_packets / n,
            (double)u->early_exits / n);
    fprintf(to, "slices, cells     %.0f slices, %.0f cells, %.0f references\n", (double)u->slices / n,
            (double)u->cells / n, (double)u->references / n);
    fprintf(to, "culling           %.0f %s tested, %.0f culled\n", (double)u->cull_tests / n, unit_of(report),
            (double)u->culled / n);
    fprintf(to, "tests             %.0f %s against packets, %.0f against rays (%.2f a ray)\n",
            (double)t->packet_tests / n, unit_of(report), (double)t->ray_tests / n, (double)t->ray_tests / rays);
    fprintf(to, "decided           %.0f tests in double, %.0f exactly; %.0f values exactly\n",
            (double)t->double_tests / n, (double)t->exact_tests / n, (double)t->exact_values / n);
}

void render_report_print(const render_report *report, uint64_t rays, uint32_t images, FILE *to)
{
    uint32_t count_min = UINT32_MAX, count_max = 0;
    uint64_t not_finite = 0, negative = 0, flat = 0, hits = 0;
    if (report->count == 0)
        return;
    for (size_t i = 0; i < report->count; i++) {
        const frame_record *f = &report->frames[i];
        count_min = f->primitives < count_min ? f->primitives : count_min;
        count_max = f->primitives > count_max ? f->primitives : count_max;
        not_finite += f->skipped_not_finite;
        negative += f->skipped_radius;
        flat += f->skipped_degenerate;
        hits += f->hits;
    }
    fprintf(to, "frames            %9zu\n", report->count);
    fprintf(to, "%-18s%9" PRIu32 "%s", unit_of(report), count_min, count_max == count_min ? "\n" : "");
    if (count_max != count_min)
        fprintf(to, " to %" PRIu32 "\n", count_max);
    if (not_finite + negative + flat)
        fprintf(to,
                "skipped           %9" PRIu64 "     in all frames: %" PRIu64 " not finite, %" PRIu64
                " with a negative radius, %" PRIu64 " triangles without an area\n",
                not_finite + negative + flat, not_finite, negative, flat);
    print_times(report, rays, hits, images, to);
    if (report->has_stats)
        print_stats(report, to);
}

int render_report_close(render_report *report, char *error, size_t error_size)
{
    int result = 0;
    if (report->log) {
        const int failed = ferror(report->log);
        errno = 0;
        if (fclose(report->log) != 0 || failed) {
            snprintf(error, error_size, "%s: cannot write: %s", report->log_path,
                     errno ? strerror(errno) : "the device is full or gone");
            result = -1;
        }
    }
    free(report->frames);
    memset(report, 0, sizeof *report);
    return result;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scripts for gnuplot; see bench_pareto_draw.h. */
#define _POSIX_C_SOURCE 200809L
#include "pareto/bench_pareto_draw.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/program.h"

static const int shapes[DRAW_MOST_KINDS] = {13, 7, 9, 11, 5}; /* gnuplot's filled symbols */

/* Okabe and Ito's colours without their yellow, for variants; more repeat them. */
static const char *const colors[] = {"#000000", "#0072b2", "#009e73", "#d55e00", "#cc79a7", "#e69f00", "#56b4e9"};
static const char *const bar_colors[DRAW_BARS] = {"#0072b2", "#d55e00"};
enum { COLORS = sizeof colors / sizeof colors[0] };

static const double ulp_floor = 0.25; /* where 0 stands on the axis of ulp */

/* Ends of the axes of errors. A logarithm has no place for 0, so that gets one below all others. */
typedef struct axes {
    double share_floor, share_top, ulp_top;
} axes;

static axes axes_of(const draw_picture *p)
{
    double least = 1e6, share = 0.0, ulp = 0.0;
    for (size_t i = 0; i < p->count; i++) {
        least = fmin(least, 1e6 / (double)p->points[i].of);
        share = fmax(share, 1e6 * p->points[i].share);
        ulp = fmax(ulp, p->points[i].ulp);
    }
    const double floor_share = pow(10.0, floor(log10(least)) - 1.0);
    return (axes){floor_share, fmax(3.0 * share, 100.0 * floor_share), fmax(3.0 * ulp, 10.0)};
}

/* A string of gnuplot: in single quotes all stands for itself but the quote, which is doubled. */
static void write_text(FILE *to, const char *text)
{
    fputc('\'', to);
    for (; *text; text++) {
        if (*text == '\'')
            fputc('\'', to);
        fputc(*text == '\n' || *text == '\r' ? ' ' : *text, to);
    }
    fputc('\'', to);
}

static void write_figures(const draw_picture *p, const axes *a, FILE *to)
{
    fprintf(to, "# scene, variant, kind, time, wrong per million, worst t error in ulp, cost in per cent, bar\n"
                "$figures << END_OF_FIGURES\n");
    for (size_t i = 0; i < p->count; i++) {
        const draw_point *d = &p->points[i];
        const double share = 1e6 * d->share;
        fprintf(to, "%zu %zu %zu %.4f %.6g %.6g %.2f %d\n", d->scene, d->variant, d->kind, d->time,
                share > 0.0 ? share : a->share_floor, d->ulp > 0.0 ? d->ulp : ulp_floor, d->cost, d->bar);
    }
    fprintf(to, "END_OF_FIGURES\n\n");
}

static void write_array(FILE *to, const char *name, const char *const *texts, size_t count)
{
    fprintf(to, "array %s[%zu]\n", name, count);
    for (size_t i = 0; i < count; i++) {
        fprintf(to, "%s[%zu] = ", name, i + 1);
        write_text(to, texts[i]);
        fputc('\n', to);
    }
}

static void write_arrays(const draw_picture *p, FILE *to)
{
    write_array(to, "scenes", p->scenes, p->scene_count);
    write_array(to, "variants", p->variants, p->variant_count);
    write_array(to, "kinds", p->kinds, p->kind_count);
    fprintf(to, "array colors[%zu]\narray shapes[%zu]\n", p->variant_count, p->kind_count);
    for (size_t i = 0; i < p->variant_count; i++)
        fprintf(to, "colors[%zu] = '%s'\n", i + 1, colors[i % COLORS]);
    for (size_t i = 0; i < p->kind_count; i++)
        fprintf(to, "shapes[%zu] = %d\n", i + 1, shapes[i % DRAW_MOST_KINDS]);
}

/* One panel of points: column `column` of the figures over the time, with an axis on which 0 stands at floor. */
static void write_points(const draw_picture *p, int column, const char *label, const char *zero, double floor_at,
                         double top, FILE *to)
{
    fprintf(to, "    set yrange [%g:%g]; set ytics auto; set ytics add ('%s' %g)\n    set ylabel s == 0 ? ",
            floor_at / 2.0, top, zero, floor_at);
    write_text(to, label);
    fprintf(to,
            " : ''\n"
            "    plot for [v=0:%zu] for [k=0:%zu] $figures using ($1 == s && $2 == v && $3 == k ? $4 : NaN):%d \\\n"
            "      with points pointtype shapes[k + 1] pointsize 1.2 linecolor rgb colors[v + 1] notitle, \\\n",
            p->variant_count - 1, p->kind_count - 1, column);
}

/* Two panels of points. The keys of the first column's panels stand for all. */
static void write_errors(const draw_picture *p, const axes *a, double rows, FILE *to)
{
    fprintf(to,
            "    set title scenes[s + 1] noenhanced; if (s == 0) { set key on at screen key_x,0.95 }\n"
            "    set logscale y; set format y '10^{%%T}'; set xrange [%s:*]; set xtics auto\n"
            "    %s; set xlabel ",
            p->time_logarithmic ? "*" : "0", p->time_logarithmic ? "set logscale x" : "unset logscale x");
    write_text(to, p->time_label);
    fputc('\n', to);
    write_points(p, 5, p->share_label, "none", a->share_floor, a->share_top, to);
    fprintf(
        to,
        "      for [k=0:%zu] keyentry with points pointtype shapes[k + 1] linecolor rgb '#777777' title kinds[k + 1]\n"
        "    unset title; set format y '%%g'; if (s == 0) { set key at screen key_x,%g }\n",
        p->kind_count - 1, 0.95 - 0.99 / rows);
    write_points(p, 6, "worst error of t, ulp", "0", ulp_floor, a->ulp_top, to);
    fprintf(to,
            "      for [v=0:%zu] keyentry with points pointtype 7 linecolor rgb colors[v + 1] title variants[v + 1]\n",
            p->variant_count - 1);
}

/* A panel of bars: what the ways cost in each variant. */
static void write_bars(const draw_picture *p, FILE *to)
{
    const size_t last = p->variant_count - 1;
    fprintf(to,
            "    unset logscale y; set yrange [*:*]; set ytics auto; set xlabel ''; set xrange [-0.6:%zu + 0.6]\n"
            "    set xtics ('' -1); do for [v=0:%zu] { set xtics add (variants[v + 1] v) }\n"
            "    if (s == 0) { set key at screen key_x,0.29 }\n"
            "    set ylabel s == 0 ? ",
            last, last);
    write_text(to, p->cost_label);
    fprintf(to, " : ''\n    plot 0 with lines linecolor rgb '#777777' notitle");
    for (int bar = 0; bar < DRAW_BARS; bar++) {
        fprintf(
            to,
            ", \\\n      $figures using ($1 == s && $8 == %d ? $2 + %g : NaN):7 with boxes linecolor rgb '%s' title ",
            bar, bar ? 0.2 : -0.2, bar_colors[bar]);
        write_text(to, p->bar_names[bar]);
    }
    fputc('\n', to);
}

static void write_script(const draw_picture *p, const char *prefix, FILE *to)
{
    const int rows = p->cost_label ? 3 : 2;
    const size_t width = 310 + 360 * p->scene_count;
    const int height = 10 + 330 * rows;
    const axes a = axes_of(p);
    fprintf(to, "# Time against error, written by cgt-bench pareto. Draw it with: gnuplot FILE\n"
                "set encoding utf8\nprefix = ");
    write_text(to, prefix);
    fputc('\n', to);
    write_figures(p, &a, to);
    write_arrays(p, to);
    fprintf(to,
            "set grid linecolor rgb '#dddddd'; set border 3; set tics nomirror; set boxwidth 0.35\n"
            "set style fill solid 0.8 noborder\n"
            "do for [form=1:2] {\n"
            "  if (form == 1) { set terminal svg size %zu,%d font 'sans,12' background '#ffffff' }\n"
            "  if (form == 2 && strstrt(GPVAL_TERMINALS, 'pngcairo')) "
            "{ set terminal pngcairo size %zu,%d font 'sans,10' }\n"
            "  if (form == 2 && !strstrt(GPVAL_TERMINALS, 'pngcairo')) { set terminal png size %zu,%d }\n"
            "  set output prefix . (form == 1 ? '.svg' : '.png')\n",
            width, height, width, height, width, height);
    fprintf(to,
            "  set multiplot layout %d,%zu columnsfirst margins %g,%g,%g,0.95 spacing %g,%g\n"
            "  key_x = %g\n"
            "  set key reverse Left left top samplen 1\n"
            "  do for [s=0:%zu] {\n",
            rows, p->scene_count, 80.0 / (double)width, 1.0 - 230.0 / (double)width, 0.18 / rows, 70.0 / (double)width,
            0.27 / rows, 1.0 - 215.0 / (double)width, p->scene_count - 1);
    write_errors(p, &a, (double)rows, to);
    if (p->cost_label)
        write_bars(p, to);
    fprintf(to, "    set key off\n  }\n  unset multiplot\n  set output\n}\n");
}

/* Runs gnuplot on the script. */
static int run_gnuplot(const char *script)
{
    enum { NOT_FOUND = 127 }; /* as a shell has it */
    int status = 0;
    const pid_t child = fork();
    if (child == 0) {
        execlp("gnuplot", "gnuplot", script, (char *)NULL);
        _exit(NOT_FOUND);
    }
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR)
        continue;
    if (child > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return PROGRAM_OK;
    if (child < 0 || (WIFEXITED(status) && WEXITSTATUS(status) == NOT_FOUND))
        program_error("cannot run gnuplot: the table is written, the picture is not; gnuplot %s draws it", script);
    else
        program_error("gnuplot failed on %s: the table is written, the picture is not whole", script);
    return PROGRAM_FAILED;
}

int draw_picture_files(const draw_picture *picture, const char *prefix)
{
    char script[4096];
    if (snprintf(script, sizeof script, "%s.gnuplot", prefix) >= (int)sizeof script) {
        program_error("%s: the name is too long", prefix);
        return PROGRAM_FAILED;
    }
    FILE *file = fopen(script, "w");
    if (!file) {
        program_error("%s: cannot write: %s", script, strerror(errno));
        return PROGRAM_FAILED;
    }
    write_script(picture, prefix, file);
    const int failed = ferror(file);
    errno = 0;
    if (fclose(file) || failed) {
        program_error("%s: cannot write: %s", script, strerror(errno ? errno : EIO));
        return PROGRAM_FAILED;
    }
    return run_gnuplot(script);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the programs share; see program.h. */
#define _POSIX_C_SOURCE 200809L
#include "common/program.h"

#include <errno.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "system/process.h"
#include "system/system.h"

static const char *own_name = "cgt";
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* of all below, and of standard error */
static int bar_is_shown;                                 /* on the terminal's current line */
static program_error_sink *error_sink;
static void *error_user;
static program_progress_sink *progress_sink;
static void *progress_user;

/* ---- Start, errors, end ------------------------------------------------------------------------------------- */

void program_init(const char *name)
{
    process_watch_children();
    own_name = name;
    system_begin();
}

const char *program_name(void) { return own_name; }

static void clear_bar(void)
{
    if (bar_is_shown) {
        fputs("\r\033[K", stderr);
        bar_is_shown = 0;
    }
}

void program_set_error_sink(program_error_sink *sink, void *user)
{
    pthread_mutex_lock(&lock);
    error_sink = sink;
    error_user = user;
    pthread_mutex_unlock(&lock);
}

/* Names and pieces of damaged files must not steer the terminal. */
static void hide_controls(char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < ' ' || *text == 0x7f)
            *text = '?';
}

void program_error(const char *format, ...)
{
    char text[PROGRAM_ERROR_SIZE + 4096];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    hide_controls(text);
    pthread_mutex_lock(&lock);
    if (error_sink == NULL || !error_sink(error_user, text)) {
        fflush(stdout); /* so that both streams stay in order in one log */
        clear_bar();
        fprintf(stderr, "%s: %s\n", own_name, text);
    }
    pthread_mutex_unlock(&lock);
}

int program_exit(int code)
{
    errno = 0;
    const int failed = fflush(stdout) != 0 || ferror(stdout);
    if (failed && code == PROGRAM_OK) {
        program_error("standard output: %s", errno != 0 ? strerror(errno) : "it cannot be written");
        return PROGRAM_FAILED;
    }
    return code;
}

/* ---- Progress ----------------------------------------------------------------------------------------------- */

#define BAR_WIDTH 30
#define BAR_EVERY 0.1  /* seconds between two bars on a terminal, or two lines to a sink */
#define LINE_EVERY 5.0 /* seconds between two lines elsewhere */

double program_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void program_set_progress_sink(program_progress_sink *sink, void *user)
{
    pthread_mutex_lock(&lock);
    progress_sink = sink;
    progress_user = user;
    pthread_mutex_unlock(&lock);
}

void program_progress_start(program_progress *p, const char *activity, const char *unit, double total, int quiet)
{
    p->activity = activity;
    p->unit = unit;
    p->total = total;
    p->start = p->last = program_seconds();
    p->terminal = isatty(STDERR_FILENO);
    pthread_mutex_lock(&lock);
    p->sink = progress_sink;
    p->user = progress_user;
    pthread_mutex_unlock(&lock);
    p->quiet = quiet && !p->sink;
}

/* Writes " 01:23 left", with hours where there are any. */
static void write_remaining_time(char *text, size_t size, double seconds)
{
    const double longest = 99 * 3600.0;
    const unsigned s = (unsigned)(seconds < longest ? seconds + 0.5 : longest);
    if (s >= 3600)
        snprintf(text, size, ", %u:%02u:%02u left", s / 3600, s / 60 % 60, s % 60);
    else
        snprintf(text, size, ", %02u:%02u left", s / 60, s % 60);
}

static void draw_bar(double share)
{
    char bar[BAR_WIDTH + 1];
    const int full = (int)(share * BAR_WIDTH);
    memset(bar, '.', BAR_WIDTH);
    memset(bar, '#', (size_t)full);
    bar[BAR_WIDTH] = '\0';
    fprintf(stderr, "[%s] ", bar);
}

void program_progress_update(program_progress *p, double done, double share)
{
    const double now = program_seconds();
    if (p->quiet || now - p->last < (p->terminal || p->sink ? BAR_EVERY : LINE_EVERY))
        return;
    p->last = now;
    const double seconds = now - p->start;
    share = share < 0.0 && p->total > 0.0 ? done / p->total : share;
    share = share > 1.0 ? 1.0 : share;
    char remaining[40] = "", part[16] = "", text[256];
    if (share > 0.0)
        write_remaining_time(remaining, sizeof remaining, seconds * (1.0 - share) / share);
    if (share >= 0.0)
        snprintf(part, sizeof part, "%3.0f %%, ", 100.0 * share);
    snprintf(text, sizeof text, "%s%.0f %s, %.1f/s%s", part, done, p->unit, seconds > 0.0 ? done / seconds : 0.0,
             remaining);
    if (p->sink) {
        char line[300];
        snprintf(line, sizeof line, "%s %s", p->activity, text);
        p->sink(p->user, line);
        return;
    }
    pthread_mutex_lock(&lock);
    clear_bar();
    fprintf(stderr, "%s ", p->activity);
    if (p->terminal && share >= 0.0)
        draw_bar(share);
    fputs(text, stderr);
    if (p->terminal) {
        fflush(stderr);
        bar_is_shown = 1;
    } else {
        fputc('\n', stderr);
    }
    pthread_mutex_unlock(&lock);
}

void program_progress_end(program_progress *p)
{
    if (p->sink) {
        p->sink(p->user, "");
    } else if (!p->quiet) {
        pthread_mutex_lock(&lock);
        clear_bar();
        pthread_mutex_unlock(&lock);
    }
}

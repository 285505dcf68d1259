/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Movies by a pipe to ffmpeg; see movie.h. */
#define _POSIX_C_SOURCE 200809L
#include "picture/files/movie.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include "common/out_file.h"
#include "common/out_path.h"
#include "common/program.h"
#include "picture/files/yuv.h"
#include "system/process.h"
#include "system/system.h"

enum { MOST_ARGUMENTS = 64, DEFAULT_QUALITY = 80 };
enum { GIF_RATE = 50 }; /* delays are hundredths of a second, and players take 0 and 1 of them for 10 */

struct movie {
    movie_options options;
    out_file file;
    const char *temporary;
    FILE *messages; /* what ffmpeg says */
    process_child encoder;
    uint8_t *yuv; /* a frame as encoders take it: made here, since ffmpeg takes twice as long; NULL: as it is */
};

/* ---- The command line --------------------------------------------------------------------------------------- */

typedef struct command {
    const char *argv[MOST_ARGUMENTS];
    int count;
    char text[768]; /* of the arguments that are made here */
    size_t used;
} command;

static void add(command *c, const char *argument)
{
    if (c->count < MOST_ARGUMENTS - 1)
        c->argv[c->count++] = argument;
    c->argv[c->count] = NULL;
}

static void add_all(command *c, const char *const *arguments)
{
    for (; *arguments; arguments++)
        add(c, *arguments);
}

static void add_made(command *c, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void add_made(command *c, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(c->text + c->used, sizeof c->text - c->used, format, arguments);
    va_end(arguments);
    if (length >= 0 && (size_t)length < sizeof c->text - c->used) {
        add(c, c->text + c->used);
        c->used += (size_t)length + 1;
    }
}

/* A quality from 1 to 100 as the encoder counts it: from `worst` at low qualities down to 0 at 100; 80 becomes
 * 20 * step. */
static int quantizer(const movie_options *o, double step, int worst)
{
    const double value = step * (100 - (o->quality ? o->quality : DEFAULT_QUALITY));
    return value < worst ? (int)(value + 0.5) : worst;
}

/* What yuv.h makes, told to the encoder and to players. */
static void add_colors(command *c)
{
    static const char *const colors[] = {"-pix_fmt",         "yuv420p", "-colorspace", "bt709",
                                         "-color_primaries", "bt709",   "-color_trc",  "bt709",
                                         "-color_range",     "tv",      NULL};
    add_all(c, colors);
}

static void add_encoder(command *c, const movie_options *o)
{
    static const char *const vp9[] = {"-c:v", "libvpx-vp9", "-deadline", "realtime", "-cpu-used", "8", "-row-mt",
                                      "1",    "-b:v",       "0",         "-f",       "webm",      NULL};
    /* a palette for each frame: one for all would need all frames in memory */
    static const char *const gif[] = {
        "-filter_complex", "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1", "-f", "gif", NULL};
    if (out_path_ends_in(o->path, ".gif")) {
        if (o->rate > GIF_RATE) { /* frames are left out: the movie lasts as long */
            add(c, "-r");
            add_made(c, "%d", GIF_RATE);
        }
        add_all(c, gif);
        return;
    }
    add_colors(c);
    add(c, "-threads"); /* on each machine as many: they decide on the bytes */
    add(c, "6");
    add(c, "-crf");
    if (out_path_ends_in(o->path, ".webm")) {
        add_made(c, "%d", quantizer(o, 1.5, 63));
        add_all(c, vp9);
        return;
    }
    add_made(c, "%d", quantizer(o, 0.9, 51));
    add(c, "-c:v");
    add(c, "libx264");
    add(c, "-preset");
    add(c, o->preset ? o->preset : "veryfast");
    add(c, "-f");
    add(c, out_path_ends_in(o->path, ".mkv") ? "matroska" : out_path_ends_in(o->path, ".mov") ? "mov" : "mp4");
    if (!out_path_ends_in(o->path, ".mkv")) {
        add(c, "-movflags"); /* players may start before they have all of it */
        add(c, "+faststart");
    }
}

static void make_command(command *c, const movie *m, const char *output)
{
    static const char *const input[] = {"ffmpeg", "-v",       "error",    "-xerror", "-nostdin",
                                        "-f",     "rawvideo", "-pix_fmt", NULL};
    static const char *const made[] = {"-i", "pipe:0", "-an", "-fflags", "+bitexact", "-map_metadata", "-1", NULL};
    const movie_options *const o = &m->options;
    memset(c, 0, sizeof *c);
    add_all(c, input);
    add(c, m->yuv ? "yuv420p" : "rgb24");
    add(c, "-s");
    add_made(c, "%ux%u", (unsigned)(m->yuv ? yuv_edge(o->width) : o->width),
             (unsigned)(m->yuv ? yuv_edge(o->height) : o->height));
    add(c, "-r");
    add_made(c, "%.9g", o->rate);
    add_all(c, made);
    add_encoder(c, o);
    add(c, "-y");
    add(c, output);
}

/* ---- The process -------------------------------------------------------------------------------------------- */

static int start_encoder(movie *m, char *error, size_t error_size)
{
    command c;
    char output[OUT_FILE_PATH_SIZE + 32];
    snprintf(output, sizeof output, "file:%s", m->temporary); /* "file:": a name is no protocol and no option */
    make_command(&c, m, output);
    const int wrong = process_start(&m->encoder, c.argv, m->messages);
    if (!wrong)
        return 0;
    snprintf(error, error_size, "%s: movies need the program ffmpeg, and it cannot be started: %s", m->options.path,
             wrong == ENOENT ? "it is not installed, or not in PATH" : strerror(wrong));
    return -1;
}

static int is_stopped(const movie *m) { return m->options.stop && *m->options.stop; }

/* Waits for ffmpeg's end, up to a signal, which may come to any thread: then ffmpeg is ended. Returns its exit code; -1
 * with a sentence. */
static int await_end(movie *m, char *reason, size_t reason_size)
{
    const struct timespec pause = {0, 5000000};
    int code = 0;
    for (;;) {
        const int stopped = is_stopped(m);
        if (stopped)
            process_kill(&m->encoder);
        if (process_has_ended(&m->encoder, stopped, &code, reason, reason_size))
            return code;
        if (!stopped)
            nanosleep(&pause, NULL);
    }
}

/* Waits for ffmpeg's end. Returns 0 where it is content: what it said is then passed on. Else -1 with what it said
 * first. */
static int wait_for_encoder(movie *m, char *error, size_t error_size)
{
    char said[300] = "", reason[300] = "";
    process_close_pipe(&m->encoder);
    const int code = await_end(m, reason, sizeof reason);
    if (is_stopped(m)) {
        snprintf(error, error_size, "%s: interrupted", m->options.path);
        return -1;
    }
    rewind(m->messages);
    for (char line[300]; !*said && fgets(line, sizeof line, m->messages);) /* the first line is the cause */
        snprintf(said, sizeof said, "%.*s", (int)strcspn(line, "\n"), line);
    if (code == 0) {
        struct stat made;
        if (stat(m->temporary, &made) == 0 && made.st_size > 0) {
            if (*said)
                program_error("%s: ffmpeg: %s", m->options.path, said);
            return 0;
        }
        if (!*said)
            snprintf(said, sizeof said, "it wrote nothing");
    }
    if (*reason)
        snprintf(said, sizeof said, "%s", reason);
    snprintf(error, error_size, "%s: cannot write: ffmpeg: %s", m->options.path,
             *said ? said : "it failed without a word");
    return -1;
}

/* ---- Movies ------------------------------------------------------------------------------------------------- */

int movie_is_name(const char *path)
{
    static const char *const endings[] = {".mp4", ".mov", ".mkv", ".webm", ".gif"};
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++)
        if (out_path_ends_in(path, endings[i]))
            return 1;
    return 0;
}

static void free_movie(movie *m)
{
    if (m->messages)
        fclose(m->messages);
    free(m->yuv);
    free(m);
}

movie *movie_begin(const movie_options *options, char *error, size_t error_size)
{
    movie *m = calloc(1, sizeof *m);
    const int as_it_is = out_path_ends_in(options->path, ".gif");
    if (as_it_is && options->rate > GIF_RATE)
        program_error("%s: players keep at most %d frames a second of a GIF: of %g a second some are left out, and it "
                      "lasts as long",
                      options->path, GIF_RATE, options->rate);
    if (m && !as_it_is)
        m->yuv = malloc(yuv_bytes(options->width, options->height));
    if (m && (m->yuv || as_it_is))
        m->messages = system_temporary();
    if (!m || !m->messages) {
        snprintf(error, error_size, "%s: cannot write: %s", options->path, strerror(errno));
        if (m)
            free_movie(m);
        return NULL;
    }
    m->options = *options;
    m->encoder = (process_child){-1, -1};
    m->temporary = out_file_begin(&m->file, options->path, error, error_size);
    if (m->temporary && start_encoder(m, error, error_size)) {
        char unused[16];
        out_file_end(&m->file, 0, unused, sizeof unused);
        m->temporary = NULL;
    }
    if (m->temporary)
        return m;
    free_movie(m);
    return NULL;
}

int movie_add(movie *m, const uint8_t *rgb, char *error, size_t error_size)
{
    const uint8_t *bytes = rgb;
    size_t left = (size_t)m->options.width * m->options.height * 3;
    if (m->yuv) {
        yuv_from_rgb(rgb, m->options.width, m->options.height, m->yuv);
        bytes = m->yuv;
        left = yuv_bytes(m->options.width, m->options.height);
    }
    while (left > 0 && m->encoder.pipe != -1) {
        if (is_stopped(m)) {
            snprintf(error, error_size, "%s: interrupted", m->options.path);
            return -1;
        }
        const long written = process_feed(&m->encoder, bytes, left);
        if (written >= 0) {
            bytes += written;
            left -= (size_t)written;
        } else {
            const int wrong = errno;
            if (wait_for_encoder(m, error, error_size) == 0) /* it ended early, and content */
                snprintf(error, error_size, "%s: cannot write: ffmpeg: %s", m->options.path, strerror(wrong));
        }
    }
    return left > 0 ? -1 : 0;
}

int movie_end(movie *m, int keep, char *error, size_t error_size)
{
    if (!m)
        return 0;
    int result = 0;
    if (m->encoder.process != -1 && !keep)
        process_kill(&m->encoder);
    if (m->encoder.process != -1)
        result = wait_for_encoder(m, error, keep ? error_size : 0);
    else
        result = -1; /* it ended before, and movie_add told */
    if (!keep)
        result = 0;
    if (out_file_end(&m->file, keep && result == 0, error, error_size))
        result = -1;
    free_movie(m);
    return result;
}

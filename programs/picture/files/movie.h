/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Movies: frames through a pipe to the program ffmpeg, which encodes them. The file is written under a temporary name
 * and is there when it is whole (common/out_file.h). The formats, by a name's ending: .mp4, .mov, .mkv (H.264 by x264),
 * .webm (VP9), .gif. */
#ifndef MOVIE_H
#define MOVIE_H

#include <stddef.h>
#include <stdint.h>

#include "common/stop_flag.h"

typedef struct movie movie;

typedef struct movie_options {
    const char *path;       /* must stay valid */
    uint32_t width, height; /* pixels; where H.264 and VP9 need even edges, the last line is doubled */
    double rate;            /* frames a second, above 0 */
    int quality;            /* 1 (smallest file) to 100 (best); 0: 80. GIF has one quality */
    const stop_flag *stop;  /* not 0: movie_add and movie_end give up; NULL: never */
    const char *preset;     /* of x264: "ultrafast" to "veryslow"; NULL: "veryfast" */
} movie_options;

/* Whether a name ends as a movie's does: 1 or 0. */
int movie_is_name(const char *path);

/* Starts ffmpeg. SIGPIPE must be ignored by the caller: then a broken pipe is an error of movie_add. Returns NULL with
 * a sentence in error: ffmpeg is not there, the file's folder refuses, no memory. Says so where a GIF's rate is above
 * 50, which players do not keep: frames are then left out. */
movie *movie_begin(const movie_options *options, char *error, size_t error_size);

/* Adds a frame: 3 * width * height bytes, sRGB, first row at the top. Returns 0, or -1 with a sentence, in which ffmpeg
 * tells what is wrong; the movie can then only be ended without keep. */
int movie_add(movie *movie, const uint8_t *rgb, char *error, size_t error_size);

/* Ends a movie and frees it: with keep it waits for ffmpeg and gives the file its name; without, ffmpeg is ended and
 * the file removed. NULL is ignored. Returns 0, or -1 with a sentence: the file is not there. */
int movie_end(movie *movie, int keep, char *error, size_t error_size);

#endif

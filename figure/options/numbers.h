/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Numbers, words and cameras from texts. A parser returns 0, or -1 with a sentence in error. One that fails changes
 * none of its results. Numbers have a point, whatever the locale of the process is. */
#ifndef NUMBERS_H
#define NUMBERS_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/cgt.h>

/* Reads the value of an option to its place. Returns 0, or -1 with a sentence. */
typedef int option_parser(const char *text, void *to, char *error, size_t error_size);

/* As strtod and strtof, with a point. */
double cgt_scan_double(const char *text, char **end);
float cgt_scan_float(const char *text, char **end);

/* Writes a sentence, unless error is NULL or error_size 0, and returns -1. */
int cgt_refuse(char *error, size_t error_size, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Whether a sentence is about memory that there is not: all of these begin alike, and no other does but by a user's
 * words. */
int cgt_tells_of_memory(const char *sentence);

/* A number by %.*g, with a point: printed by cgt_number(digits, value).text. */
typedef struct number_text {
    char text[32];
} number_text;
number_text cgt_number(int digits, double value);

/* The text of a time or a value, which tells it from those near it: all digits of whole numbers; of others six, or up
 * to ten where these are the number, of floats seven. What has no such text has three decimals, or six digits. */
number_text cgt_number_shortest(double value);

/* How many digits tell numbers apart that are `step` from each other and at most `largest`: 6 to 15. */
int cgt_number_digits(double largest, double step);

/* The same with so many decimals, 0 to 9, where the number is below 10^15. */
number_text cgt_fixed(int decimals, double value);

/* A whole number from min to max, decimal digits only. */
int cgt_read_u64(const char *text, uint64_t min, uint64_t max, uint64_t *value, char *error, size_t error_size);
int cgt_read_u32(const char *text, uint32_t min, uint32_t max, uint32_t *value, char *error, size_t error_size);

/* A finite number from min to max, both included. */
int cgt_read_float(const char *text, float min, float max, float *value, char *error, size_t error_size);

/* Exactly `count` finite numbers with commas between them; count is at most 16. */
int cgt_read_floats(const char *text, size_t count, float *values, char *error, size_t error_size);

/* The same in double. */
int cgt_read_doubles(const char *text, size_t count, double *values, char *error, size_t error_size);

/* A picture's size, "1280x720": each edge 1 to 65,536 pixels. */
int cgt_read_size(const char *text, uint32_t *width, uint32_t *height, char *error, size_t error_size);

/* A camera, "ex,ey,ez,tx,ty,tz,ux,uy,uz,fov": eye, target, up, vertical angle in degrees. Sets projection, eye,
 * target, up and fov and leaves the rest of camera as it is. Refuses eye = target, an up that is zero or parallel to
 * the view, and an angle that is not above 0 and below 180. */
int cgt_read_camera(const char *text, cgt_camera *camera, char *error, size_t error_size);

/* The same, with eye and target also in double: so near to each other that single precision may not tell them apart. */
int cgt_read_far_camera(const char *text, cgt_camera *camera, double eye[3], double target[3], char *error,
                        size_t error_size);

/* Makes blanks of line feeds and carriage returns: settings are lines, which a value must not end. */
void cgt_join_lines(char *text);

/* The number of a word in a list with blanks or ", " between them; -1: it is not there. */
int cgt_find_word(const char *list, const char *word);

#endif

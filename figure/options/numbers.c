/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Numbers, words and cameras from texts; see numbers.h. */
#include "options/numbers.h"

#include <float.h>
#include <inttypes.h>
#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Numbers ------------------------------------------------------------------------------------------------ */

int cgt_refuse(char *error, size_t error_size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (error != NULL && error_size > 0)
        vsnprintf(error, error_size, format, arguments);
    va_end(arguments);
    return -1;
}

/* Reads decimal digits at *text and moves it past them. Returns 0, or -1: no digit, or beyond 64 bits. */
static int scan_u64(const char **text, uint64_t *value)
{
    const char *p = *text;
    uint64_t number = 0;
    if (*p < '0' || *p > '9')
        return -1;
    for (; *p >= '0' && *p <= '9'; p++) {
        const uint64_t digit = (uint64_t)(*p - '0');
        if (number > (UINT64_MAX - digit) / 10)
            return -1;
        number = 10 * number + digit;
    }
    *text = p;
    *value = number;
    return 0;
}

int cgt_read_u64(const char *text, uint64_t min, uint64_t max, uint64_t *value, char *error, size_t error_size)
{
    const char *p = text;
    uint64_t number = 0;
    if (scan_u64(&p, &number) || *p != '\0' || number < min || number > max)
        return cgt_refuse(error, error_size, "'%.80s' is not a whole number from %" PRIu64 " to %" PRIu64, text, min,
                          max);
    *value = number;
    return 0;
}

int cgt_read_u32(const char *text, uint32_t min, uint32_t max, uint32_t *value, char *error, size_t error_size)
{
    uint64_t number = 0;
    if (cgt_read_u64(text, min, max, &number, error, error_size))
        return -1;
    *value = (uint32_t)number;
    return 0;
}

enum { NUMBER_MOST = 512 }; /* letters of a number, in a locale without a point */

/* The number at the start of a text, as the locale writes it; the text itself where that has a point, or in the copy,
 * which ends behind all letters that numbers may have. */
static const char *localize(const char *text, char copy[NUMBER_MOST])
{
    const char *const point = localeconv()->decimal_point;
    size_t length = strspn(text, "+-.0123456789eExXabcdfABCDFpP");
    if (strcmp(point, ".") == 0 || strlen(point) != 1)
        return text;
    length = length < NUMBER_MOST ? length : NUMBER_MOST - 1;
    for (size_t i = 0; i < length; i++)
        copy[i] = text[i] == '.' ? *point : text[i];
    copy[length] = '\0';
    return copy;
}

double cgt_scan_double(const char *text, char **end)
{
    char copy[NUMBER_MOST], *after;
    const char *const local = localize(text, copy);
    const double number = strtod(local, &after);
    *end = (char *)(uintptr_t)(text + (after - local));
    return number;
}

float cgt_scan_float(const char *text, char **end)
{
    char copy[NUMBER_MOST], *after;
    const char *const local = localize(text, copy);
    const float number = strtof(local, &after);
    *end = (char *)(uintptr_t)(text + (after - local));
    return number;
}

static void put_point(char *text)
{
    const char *const point = localeconv()->decimal_point;
    char *const at = strstr(text, point);
    if (!at)
        return;
    *at = '.';
    memmove(at + 1, at + strlen(point), strlen(at + strlen(point)) + 1);
}

number_text cgt_number(int digits, double value)
{
    number_text n;
    snprintf(n.text, sizeof n.text, "%.*g", digits, value);
    put_point(n.text);
    return n;
}

/* Whether a text is the number: sums and products of decimals are rounded, and floats are of nine digits. */
static int is_number(const number_text *n, double value, int is_float)
{
    char *end;
    const double back = cgt_scan_double(n->text, &end);
    return is_float ? (float)back == (float)value : fabs(back - value) <= 1e-12 * fabs(value);
}

number_text cgt_number_shortest(double value)
{
    const int is_float = fabs(value) <= (double)FLT_MAX && value == (double)(float)value;
    if (value == floor(value) && fabs(value) < 1e15)
        return cgt_number(15, value + 0.0); /* no -0 */
    for (int digits = 6; digits <= (is_float ? 7 : 10); digits++) {
        const number_text n = cgt_number(digits, value);
        if (is_number(&n, value, is_float))
            return n;
    }
    const double decimals = 3.0, power = fabs(value) >= 1.0 ? floor(log10(fabs(value))) : -1.0;
    return cgt_number((int)fmin(fmax(power + 1.0 + decimals, 6.0), 15.0), value);
}

int cgt_number_digits(double largest, double step)
{
    const int least = 6, most = 15;
    const double needed = step > 0.0 && largest > step ? 1.0 + ceil(log10(largest / step)) : 1.0;
    if (!(needed > least))
        return least;
    return (int)fmin(fmax(needed, 1.0 + floor(log10(largest))), most); /* whole numbers without an exponent */
}

number_text cgt_fixed(int decimals, double value)
{
    number_text n;
    if (!(fabs(value) < 1e15))
        return cgt_number(6, value);
    snprintf(n.text, sizeof n.text, "%.*f", decimals, value);
    put_point(n.text);
    return n;
}

/* Reads a finite number at *text and moves it past it. */
static int scan_float(const char **text, float *value)
{
    const char first = **text;
    char *end;
    if (!((first >= '0' && first <= '9') || first == '-' || first == '+' || first == '.'))
        return -1; /* no blanks, nan, inf */
    const float number = cgt_scan_float(*text, &end);
    if (end == *text || !isfinite(number))
        return -1;
    *text = end;
    *value = number;
    return 0;
}

int cgt_read_float(const char *text, float min, float max, float *value, char *error, size_t error_size)
{
    const char *p = text;
    float number;
    if (scan_float(&p, &number) || *p != '\0' || !(number >= min && number <= max))
        return cgt_refuse(error, error_size, "'%.80s' is not a number from %s to %s", text,
                          cgt_number(6, (double)min).text, cgt_number(6, (double)max).text);
    *value = number;
    return 0;
}

int cgt_read_floats(const char *text, size_t count, float *values, char *error, size_t error_size)
{
    float numbers[16];
    const char *p = text;
    if (count > sizeof numbers / sizeof numbers[0])
        return cgt_refuse(error, error_size, "more than 16 numbers cannot be read at once");
    for (size_t i = 0; i < count; i++) {
        if (scan_float(&p, &numbers[i]) || *p != (i + 1 < count ? ',' : '\0'))
            return cgt_refuse(error, error_size, "'%.200s' is not %zu numbers with commas between them", text, count);
        p++;
    }
    memcpy(values, numbers, count * sizeof *values);
    return 0;
}

int cgt_read_doubles(const char *text, size_t count, double *values, char *error, size_t error_size)
{
    float rounded[16];
    char *end;
    if (cgt_read_floats(text, count, rounded, error, error_size))
        return -1;
    for (size_t i = 0; i < count; i++, text = end + 1)
        values[i] = cgt_scan_double(text, &end);
    return 0;
}

int cgt_read_size(const char *text, uint32_t *width, uint32_t *height, char *error, size_t error_size)
{
    const char *p = text;
    uint64_t w = 0, h = 0;
    int wrong = scan_u64(&p, &w) || *p != 'x';
    if (!wrong) {
        p++;
        wrong = scan_u64(&p, &h) || *p != '\0';
    }
    if (wrong || w < 1 || h < 1 || w > 65536 || h > 65536)
        return cgt_refuse(error, error_size, "'%.80s' is not a size like 1280x720 with edges from 1 to 65536", text);
    *width = (uint32_t)w;
    *height = (uint32_t)h;
    return 0;
}

/* ---- Camera ------------------------------------------------------------------------------------------------- */

static double length3(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* Whether up is zero, or so close to the view direction that it defines no upright picture. */
static int up_is_parallel(const float view[3], const float up[3])
{
    const double v[3] = {(double)view[0], (double)view[1], (double)view[2]};
    const double u[3] = {(double)up[0], (double)up[1], (double)up[2]};
    const double c[3] = {v[1] * u[2] - v[2] * u[1], v[2] * u[0] - v[0] * u[2], v[0] * u[1] - v[1] * u[0]};
    return !(length3(c) > 1e-6 * length3(v) * length3(u));
}

int cgt_read_far_camera(const char *text, cgt_camera *camera, double eye_at[3], double target_at[3], char *error,
                        size_t error_size)
{
    float v[10] = {0};
    double d[10];
    if (cgt_read_floats(text, 10, v, error, error_size) || cgt_read_doubles(text, 10, d, error, error_size))
        return cgt_refuse(error, error_size, "'%.200s' is not ex,ey,ez,tx,ty,tz,ux,uy,uz,fov: ten numbers", text);
    const float *const eye = v, *const target = v + 3, *const up = v + 6;
    const float view[3] = {(float)(d[3] - d[0]), (float)(d[4] - d[1]), (float)(d[5] - d[2])};
    if (view[0] == 0.0f && view[1] == 0.0f && view[2] == 0.0f)
        return cgt_refuse(error, error_size, "eye and target are the same point");
    if (up_is_parallel(view, up))
        return cgt_refuse(error, error_size, "up is zero, or parallel to the view from eye to target");
    if (!(v[9] > 0.0f && v[9] < 180.0f))
        return cgt_refuse(error, error_size, "the angle %s is not above 0 and below 180 degrees",
                          cgt_number(6, (double)v[9]).text);
    camera->projection = CGT_PROJECTION_PERSPECTIVE;
    memcpy(camera->eye, eye, sizeof camera->eye);
    memcpy(camera->target, target, sizeof camera->target);
    memcpy(camera->up, up, sizeof camera->up);
    camera->fov = v[9];
    memcpy(eye_at, d, 3 * sizeof *d);
    memcpy(target_at, d + 3, 3 * sizeof *d);
    return 0;
}

int cgt_read_camera(const char *text, cgt_camera *camera, char *error, size_t error_size)
{
    cgt_camera parsed = *camera;
    double eye[3], target[3];
    if (cgt_read_far_camera(text, &parsed, eye, target, error, error_size))
        return -1;
    if (memcmp(parsed.eye, parsed.target, sizeof parsed.eye) == 0)
        return cgt_refuse(error, error_size, "eye and target are the same point in single precision");
    *camera = parsed;
    return 0;
}

int cgt_tells_of_memory(const char *sentence)
{
    static const char memory[] = "out of memory";
    const size_t length = sizeof memory - 1;
    return strncmp(sentence, memory, length) == 0 && strchr(", ", sentence[length]) != NULL; /* or the end */
}

/* ---- Words -------------------------------------------------------------------------------------------------- */

int cgt_find_word(const char *list, const char *word)
{
    static const char separators[] = ", ";
    const size_t length = strlen(word);
    for (int i = 0; *list; i++) {
        const size_t size = strcspn(list, separators);
        if (size == length && memcmp(list, word, size) == 0)
            return i;
        list += size + strspn(list + size, separators);
    }
    return -1;
}

void cgt_join_lines(char *text)
{
    for (; *text; text++)
        if (*text == '\n' || *text == '\r')
            *text = ' ';
}

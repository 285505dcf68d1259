/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of the caller's, of any type of numbers and at any distance. The constructors take typed pointers, so that the
 * compiler checks that a pointer is what its format says. <cgt/cgt.h> includes this header. */
#ifndef CGT_ARRAY_H
#define CGT_ARRAY_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The type of an array's numbers. Coordinates and radii are of the first three, indices and types of the others. */
typedef enum cgt_format {
    CGT_FORMAT_NONE = 0, /* no array */
    CGT_FORMAT_FLOAT,
    CGT_FORMAT_DOUBLE,
    CGT_FORMAT_HALF, /* of IEEE 754, 16 bits */
    CGT_FORMAT_UINT8,
    CGT_FORMAT_UINT16,
    CGT_FORMAT_UINT32, /* or int32 that are not negative */
    CGT_FORMAT_UINT64  /* or int64 that are not negative */
} cgt_format;

/* An array. Element i begins at byte i * stride; its numbers, such as x, y, z, lie side by side. {0}: there is none. */
typedef struct cgt_array {
    const void *data;  /* NULL (default): no array */
    size_t stride;     /* bytes, not less than an element; 0 (default): elements lie side by side */
    cgt_format format; /* of its numbers */
} cgt_array;

/* Return the array of these numbers; stride as above. */
static inline cgt_array cgt_floats(const float *data, size_t stride)
{
    const cgt_array array = {data, stride, CGT_FORMAT_FLOAT};
    return array;
}

static inline cgt_array cgt_doubles(const double *data, size_t stride)
{
    const cgt_array array = {data, stride, CGT_FORMAT_DOUBLE};
    return array;
}

static inline cgt_array cgt_halves(const uint16_t *data, size_t stride)
{
    const cgt_array array = {data, stride, CGT_FORMAT_HALF};
    return array;
}

static inline cgt_array cgt_uint8s(const uint8_t *data, size_t stride)
{
    const cgt_array array = {data, stride, CGT_FORMAT_UINT8};
    return array;
}

static inline cgt_array cgt_uint16s(const uint16_t *data, size_t stride)
{
    const cgt_array array = {data, stride, CGT_FORMAT_UINT16};
    return array;
}

static inline cgt_array cgt_uint32s(const uint32_t *data, size_t stride)
{
    const cgt_array array = {data, stride, CGT_FORMAT_UINT32};
    return array;
}

static inline cgt_array cgt_int32s(const int32_t *data, size_t stride)
{
    const cgt_array array = {data, stride, CGT_FORMAT_UINT32};
    return array;
}

static inline cgt_array cgt_uint64s(const uint64_t *data, size_t stride)
{
    const cgt_array array = {data, stride, CGT_FORMAT_UINT64};
    return array;
}

static inline cgt_array cgt_int64s(const int64_t *data, size_t stride)
{
    const cgt_array array = {data, stride, CGT_FORMAT_UINT64};
    return array;
}

/* Returns the bytes of one number; 0 for what is no format. */
static inline size_t cgt_format_get_size(cgt_format format)
{
    switch (format) {
    case CGT_FORMAT_UINT8: return 1;
    case CGT_FORMAT_HALF:
    case CGT_FORMAT_UINT16: return 2;
    case CGT_FORMAT_FLOAT:
    case CGT_FORMAT_UINT32: return 4;
    case CGT_FORMAT_DOUBLE:
    case CGT_FORMAT_UINT64: return 8;
    case CGT_FORMAT_NONE: break;
    }
    return 0;
}

/* Returns the value of a half, which a float holds exactly. */
static inline float cgt_half_get_float(uint16_t half)
{
    const uint32_t sign = (uint32_t)(half & 0x8000u) << 16, low = half & 0x7fffu;
    uint32_t bits;
    float value = (float)low * 5.9604644775390625e-8f; /* 2^-24: one without an exponent, exactly */
    if (low >= 0x400u) {
        bits = low >= 0x7c00u ? low << 13 | 0x7f800000u : (low << 13) + (112u << 23);
        memcpy(&value, &bits, sizeof value);
    }
    memcpy(&bits, &value, sizeof bits);
    bits |= sign;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Reads number k of element i, of elements of `width` numbers, as the library does. Alignment does not matter.
 *   array   of coordinates or radii, with data */
static inline double cgt_array_get_number(const cgt_array *array, size_t i, size_t width, size_t k)
{
    const size_t size = cgt_format_get_size(array->format);
    const char *at = (const char *)array->data + i * (array->stride ? array->stride : width * size) + k * size;
    double d;
    float f;
    uint16_t half;
    if (array->format == CGT_FORMAT_DOUBLE) {
        memcpy(&d, at, sizeof d);
        return d;
    }
    if (array->format == CGT_FORMAT_HALF) {
        memcpy(&half, at, sizeof half);
        return (double)cgt_half_get_float(half);
    }
    memcpy(&f, at, sizeof f);
    return (double)f;
}

/* The same for indices and types. */
static inline uint64_t cgt_array_get_whole(const cgt_array *array, size_t i, size_t width, size_t k)
{
    const size_t size = cgt_format_get_size(array->format);
    const char *at = (const char *)array->data + i * (array->stride ? array->stride : width * size) + k * size;
    uint64_t u64;
    uint32_t u32;
    uint16_t u16;
    switch (array->format) {
    case CGT_FORMAT_UINT8: return *(const uint8_t *)at;
    case CGT_FORMAT_UINT16: memcpy(&u16, at, sizeof u16); return u16;
    case CGT_FORMAT_UINT64: memcpy(&u64, at, sizeof u64); return u64;
    default: memcpy(&u32, at, sizeof u32); return u32;
    }
}

#ifdef __cplusplus
}
#endif

#endif

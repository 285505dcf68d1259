/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Numbers of a glTF file. Nothing in an accessor is believed before it is checked against the bytes that are there. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/gltf/gltf_reader.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#define MOST_EMPTY 16777216u /* elements of an accessor that has no bytes: a few words may claim any number */

enum { BYTE = 5120, UNSIGNED_BYTE, SHORT, UNSIGNED_SHORT, INT, UNSIGNED_INT, FLOAT };

/* ---- One number ---------------------------------------------------------------------------------------------- */

/* Bytes of a component; 0: glTF has no such type. */
static unsigned component_bytes(int component)
{
    switch (component) {
    case BYTE:
    case UNSIGNED_BYTE: return 1;
    case SHORT:
    case UNSIGNED_SHORT: return 2;
    case UNSIGNED_INT:
    case FLOAT: return 4;
    default: return 0;
    }
}

static uint32_t bits_at(const unsigned char *b, unsigned bytes)
{
    uint32_t bits = 0;
    for (unsigned i = 0; i < bytes; i++)
        bits |= (uint32_t)b[i] << (8 * i);
    return bits;
}

static float float_at(const unsigned char *b, const gltf_accessor *a)
{
    const uint32_t bits = bits_at(b, component_bytes(a->component));
    double value = bits, most = 1.0;
    float result;
    switch (a->component) {
    case FLOAT: memcpy(&result, &bits, sizeof result); return result;
    case BYTE: value = (int8_t)bits, most = INT8_MAX; break;
    case UNSIGNED_BYTE: most = UINT8_MAX; break;
    case SHORT: value = (int16_t)bits, most = INT16_MAX; break;
    case UNSIGNED_SHORT: most = UINT16_MAX; break;
    default: break;
    }
    if (!a->is_normalized)
        return (float)value;
    return (float)(value < -most ? -1.0 : value / most);
}

/* ---- Where the numbers are ----------------------------------------------------------------------------------- */

typedef struct source {
    const unsigned char *bytes;
    uint64_t stride;
} source;

/* Finds `count` elements of `size` bytes in a view. is_packed: the view's stride does not count. */
static int locate(const gltf_reader *r, int view, int64_t offset, uint64_t count, uint64_t size, int is_packed,
                  const char *what, source *out)
{
    if (view < 0 || (size_t)view >= r->f->views)
        return trajectory_fail(r->t, 0, "%s: there is no bufferView %d", what, view);
    const gltf_view *const v = &r->f->view[view];
    if (v->is_compressed)
        return trajectory_fail(r->t, 0, "%s: compressed by meshopt, which cannot be read here", what);
    out->stride = is_packed || v->stride == 0 ? size : v->stride;
    const int fits = size > 0 && v->bytes != NULL && offset >= 0 && (uint64_t)offset <= v->size &&
                     (count == 0 || (size <= v->size - (uint64_t)offset &&
                                     count - 1 <= (v->size - (uint64_t)offset - size) / out->stride));
    if (!fits)
        return trajectory_fail(r->t, 0, "%s: %" PRIu64 " elements do not lie in bufferView %d", what, count, view);
    out->bytes = v->bytes + offset;
    return 1;
}

/* ---- An accessor --------------------------------------------------------------------------------------------- */

/* Numbers of either kind: all are 32 bits. */
typedef union number {
    float real;
    uint32_t whole;
} number;
_Static_assert(sizeof(number) == sizeof(float) && sizeof(number) == sizeof(uint32_t), "an array of either");

static void take(const gltf_accessor *a, const unsigned char *element, int is_whole, unsigned char *out)
{
    const unsigned bytes = component_bytes(a->component);
    for (unsigned k = 0; k < (unsigned)a->components; k++) {
        number n;
        if (is_whole)
            n.whole = bits_at(element + k * bytes, bytes);
        else
            n.real = float_at(element + k * bytes, a);
        memcpy(out + k * sizeof n, &n, sizeof n);
    }
}

static int check(const gltf_reader *r, int accessor, int components, int is_whole, const char *what)
{
    if (accessor == GLTF_NONE)
        return trajectory_fail(r->t, 0, "%s are missing", what);
    if (accessor < 0 || (size_t)accessor >= r->f->accessors)
        return trajectory_fail(r->t, 0, "%s: there is no accessor %d", what, accessor);
    const gltf_accessor *const a = &r->f->accessor[accessor];
    const int is_kind =
        is_whole ? a->component == UNSIGNED_BYTE || a->component == UNSIGNED_SHORT || a->component == UNSIGNED_INT
                 : component_bytes(a->component) > 0;
    if (!is_kind || a->components != components || a->is_matrix != (components == 16) ||
        (a->is_matrix && a->component != FLOAT))
        return trajectory_fail(r->t, 0, "%s: accessor %d has %d numbers of type %d an element", what, accessor,
                               a->components, a->component);
    if (a->count == 0 || a->count >= UINT32_MAX || (a->view == GLTF_NONE && a->count > MOST_EMPTY))
        return trajectory_fail(r->t, 0, "%s: accessor %d has %" PRIu64 " elements", what, accessor, a->count);
    return 1;
}

/* Single elements that are given apart. */
static int replace(const gltf_reader *r, const gltf_accessor *a, int is_whole, const char *what, unsigned char *out)
{
    const unsigned size = component_bytes(a->component) * (unsigned)a->components;
    const unsigned index_size = component_bytes(a->index_component);
    const int is_index = a->index_component == UNSIGNED_BYTE || a->index_component == UNSIGNED_SHORT ||
                         a->index_component == UNSIGNED_INT;
    source at = {NULL, 0}, values = {NULL, 0};
    if (a->replaced < 1 || (uint64_t)a->replaced > a->count || !is_index)
        return trajectory_fail(r->t, 0, "%s: %" PRId64 " sparse elements of type %d", what, a->replaced,
                               a->index_component);
    if (locate(r, a->index_view, a->index_offset, (uint64_t)a->replaced, index_size, 1, what, &at) < 0 ||
        locate(r, a->value_view, a->value_offset, (uint64_t)a->replaced, size, 1, what, &values) < 0 ||
        at.bytes == NULL || values.bytes == NULL)
        return -1;
    for (uint64_t i = 0; i < (uint64_t)a->replaced; i++) {
        const uint32_t index = bits_at(at.bytes + i * at.stride, index_size);
        if (index >= a->count)
            return trajectory_fail(r->t, 0, "%s: sparse element %" PRIu32 " of %" PRIu64, what, index, a->count);
        take(a, values.bytes + i * values.stride, is_whole, out + index * (size_t)a->components * sizeof(number));
    }
    return 1;
}

static int read_all(const gltf_reader *r, int accessor, int components, int is_whole, const char *what,
                    unsigned char **out, uint32_t *count)
{
    *out = NULL;
    if (check(r, accessor, components, is_whole, what) < 0)
        return -1;
    const gltf_accessor *const a = &r->f->accessor[accessor];
    const size_t element = (size_t)components * sizeof(number);
    if (gltf_make(r, a->count * element) < 0)
        return -1;
    source from = {NULL, 0};
    if (a->view != GLTF_NONE &&
        (a->offset > INT64_MAX || locate(r, a->view, (int64_t)a->offset, a->count,
                                         component_bytes(a->component) * (unsigned)components, 0, what, &from) < 0))
        return a->offset > INT64_MAX ? trajectory_fail(r->t, 0, "%s: offset %" PRIu64, what, a->offset) : -1;
    *out = calloc((size_t)a->count, element);
    if (*out == NULL)
        return trajectory_fail(r->t, 0, "not enough memory for %" PRIu64 " %s", a->count, what);
    for (uint64_t i = 0; from.bytes != NULL && i < a->count; i++)
        take(a, from.bytes + i * from.stride, is_whole, *out + i * element);
    *count = (uint32_t)a->count;
    return a->is_sparse ? replace(r, a, is_whole, what, *out) : 1;
}

int gltf_read_floats(const gltf_reader *r, int accessor, int components, const char *what, float **out, uint32_t *count)
{
    unsigned char *bytes = NULL;
    const int result = read_all(r, accessor, components, 0, what, &bytes, count);
    *out = (float *)(void *)bytes;
    return result;
}

int gltf_read_whole(const gltf_reader *r, int accessor, int components, const char *what, uint32_t **out,
                    uint32_t *count)
{
    unsigned char *bytes = NULL;
    const int result = read_all(r, accessor, components, 1, what, &bytes, count);
    *out = (uint32_t *)(void *)bytes;
    return result;
}

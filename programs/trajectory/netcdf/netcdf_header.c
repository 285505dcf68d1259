/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Classic netCDF ("The NetCDF Classic Format Specification", Unidata). Numbers are big-endian; names and values are
 * padded to multiples of 4 bytes. Version 2 has offsets of 64 bits, version 5 lengths of 64 bits, too. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/netcdf/netcdf_header.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { TAG_DIMENSION = 10, TAG_VARIABLE = 11, TAG_ATTRIBUTE = 12 };
enum { NC_BYTE = 1, NC_CHAR, NC_SHORT, NC_INT, NC_FLOAT, NC_DOUBLE, NC_UBYTE, NC_USHORT, NC_UINT, NC_INT64, NC_UINT64 };

static const char name[] = "the header";

typedef struct header_reader {
    binary_reader *in;
    int version;
    uint32_t unlimited; /* index of the dimension of the records */
    int has_unlimited;
} header_reader;

/* ---- Values ------------------------------------------------------------------------------------------------- */

size_t netcdf_size(uint32_t type)
{
    static const uint8_t size[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    return type < sizeof size ? size[type] : 0;
}

static int64_t to_signed(uint64_t value, unsigned bits)
{
    const uint64_t sign = (uint64_t)1 << (bits - 1);
    return (value & sign) != 0 ? -(int64_t)(~(value | (~(uint64_t)0 << (bits - 1))) + 1) : (int64_t)value;
}

double netcdf_value(uint32_t type, const unsigned char *bytes)
{
    switch (type) {
    case NC_BYTE: return (double)to_signed(bytes[0], 8);
    case NC_CHAR:
    case NC_UBYTE: return (double)bytes[0];
    case NC_SHORT: return (double)to_signed((uint64_t)bytes[0] << 8 | bytes[1], 16);
    case NC_USHORT: return (double)((uint32_t)bytes[0] << 8 | bytes[1]);
    case NC_INT: return (double)to_signed(binary_get_u32(bytes, 1), 32);
    case NC_UINT: return (double)binary_get_u32(bytes, 1);
    case NC_FLOAT: return (double)binary_get_f32(bytes, 1);
    case NC_DOUBLE: return binary_get_f64(bytes, 1);
    case NC_INT64: return (double)to_signed(binary_get_u64(bytes, 1), 64);
    default: return (double)binary_get_u64(bytes, 1);
    }
}

/* ---- Parts of the header ------------------------------------------------------------------------------------ */

static int fail(const header_reader *r, const char *what)
{
    return trajectory_fail(r->in->t, 0, "a damaged netCDF header: %s", what);
}

/* A length: 32 bits, or in version 5 64. */
static int read_length(header_reader *r, uint64_t *length)
{
    uint32_t narrow = 0;
    if (r->version == 5)
        return binary_u64(r->in, length, name);
    if (binary_u32(r->in, &narrow, name) < 0)
        return -1;
    *length = narrow;
    return 1;
}

/* A list's tag and its length; both are 0 where it is absent. */
static int read_list(header_reader *r, uint32_t tag, uint32_t *length)
{
    uint32_t found;
    uint64_t count;
    if (binary_u32(r->in, &found, name) < 0 || read_length(r, &count) < 0)
        return -1;
    if (!(found == tag || (found == 0 && count == 0)) || count > NETCDF_MOST)
        return fail(r, "a list of an unknown kind, or a very long one");
    *length = (uint32_t)count;
    return 1;
}

static int read_name(header_reader *r, char text[NETCDF_NAME])
{
    uint64_t length;
    unsigned char padding[4];
    if (read_length(r, &length) < 0)
        return -1;
    if (length >= NETCDF_NAME)
        return fail(r, "a name of more than 255 bytes");
    if (binary_bytes(r->in, text, (size_t)length, name) < 0 ||
        binary_bytes(r->in, padding, (4 - length % 4) % 4, name) < 0)
        return -1;
    text[length] = '\0';
    return 1;
}

/* Reads attributes; *scale gets that of the name scale_factor. */
static int read_attributes(header_reader *r, double *scale)
{
    uint32_t count = 0;
    if (read_list(r, TAG_ATTRIBUTE, &count) < 0)
        return -1;
    for (uint32_t i = 0; i < count; i++) {
        char text[NETCDF_NAME];
        unsigned char value[8];
        uint32_t type;
        uint64_t values;
        if (read_name(r, text) < 0 || binary_u32(r->in, &type, name) < 0 || read_length(r, &values) < 0)
            return -1;
        const size_t size = netcdf_size(type);
        if (size == 0 || values > ((uint64_t)1 << 40))
            return fail(r, "an attribute of an unknown type, or a very long one");
        const uint64_t bytes = (values * size + 3) / 4 * 4;
        const int is_scale = strcmp(text, "scale_factor") == 0 && values == 1 && size >= 4;
        if (is_scale ? binary_bytes(r->in, value, (size_t)bytes, name) < 0 : binary_skip(r->in, bytes, name) < 0)
            return -1;
        if (is_scale)
            *scale = netcdf_value(type, value);
    }
    return 1;
}

static int read_dimensions(header_reader *r, netcdf_header *h)
{
    if (read_list(r, TAG_DIMENSION, &h->dimensions) < 0)
        return -1;
    h->dimension = calloc((size_t)h->dimensions + 1, sizeof *h->dimension);
    if (h->dimension == NULL)
        return trajectory_fail(r->in->t, 0, "not enough memory for the header");
    for (uint32_t i = 0; i < h->dimensions; i++) {
        if (read_name(r, h->dimension[i].name) < 0 || read_length(r, &h->dimension[i].length) < 0)
            return -1;
        if (h->dimension[i].length == 0) {
            r->has_unlimited = 1;
            r->unlimited = i;
        }
    }
    return 1;
}

/* Values and bytes of a variable, from its dimensions. */
static int measure(const header_reader *r, const netcdf_header *h, netcdf_variable *v)
{
    v->values = 1;
    for (uint32_t i = 0; i < v->dimensions && i < NETCDF_DIMENSIONS; i++) {
        const uint64_t length = h->dimension[v->dimension[i]].length;
        if (i == 0 && v->is_record)
            continue;
        if (length > 0 && v->values > ((uint64_t)1 << 48) / length)
            return fail(r, "a variable of more than 2^48 values");
        v->values *= length;
    }
    v->bytes = (v->values * netcdf_size(v->type) + 3) / 4 * 4;
    return 1;
}

static int read_variable(header_reader *r, netcdf_header *h, netcdf_variable *v)
{
    uint64_t dimensions, size, index;
    uint32_t narrow;
    if (read_name(r, v->name) < 0 || read_length(r, &dimensions) < 0)
        return -1;
    if (dimensions > 1024)
        return fail(r, "a variable of more than 1024 dimensions");
    v->is_odd = dimensions > NETCDF_DIMENSIONS;
    v->dimensions = (uint32_t)(v->is_odd ? NETCDF_DIMENSIONS : dimensions);
    for (uint64_t i = 0; i < dimensions; i++) {
        if (read_length(r, &index) < 0)
            return -1;
        if (index >= h->dimensions)
            return fail(r, "a variable of a dimension that is not there");
        if (i < NETCDF_DIMENSIONS)
            v->dimension[i] = (uint32_t)index;
        v->is_record |= i == 0 && r->has_unlimited && index == r->unlimited;
    }
    v->scale = 1.0;
    if (read_attributes(r, &v->scale) < 0 || binary_u32(r->in, &v->type, name) < 0 || read_length(r, &size) < 0)
        return -1;
    if (netcdf_size(v->type) == 0)
        return fail(r, "a variable of an unknown type");
    if (r->version == 1) {
        if (binary_u32(r->in, &narrow, name) < 0)
            return -1;
        v->begin = narrow;
    } else if (binary_u64(r->in, &v->begin, name) < 0) {
        return -1;
    }
    if (v->is_odd) { /* not read, but it takes its place in each record */
        v->values = 0;
        v->bytes = size;
        return size > ((uint64_t)1 << 48) ? fail(r, "a variable of more than 2^48 bytes") : 1;
    }
    return measure(r, h, v);
}

/* ---- All ---------------------------------------------------------------------------------------------------- */

/* Variables in the order of their places, so that a pipe can be read. */
static int compare_places(const void *a, const void *b)
{
    const netcdf_variable *const left = a, *const right = b;
    return (left->begin > right->begin) - (left->begin < right->begin);
}

static int read_variables(header_reader *r, netcdf_header *h)
{
    if (read_list(r, TAG_VARIABLE, &h->variables) < 0)
        return -1;
    uint32_t records = 0, last = 0;
    for (uint32_t i = 0; i < h->variables; i++) {
        const int is_full = (i & (i - 1)) == 0; /* a power of two, or 0 */
        if (is_full && trajectory_grow(&h->variable, i == 0 ? 1 : 2 * (size_t)i, sizeof *h->variable))
            return trajectory_fail(r->in->t, 0, "not enough memory for the header");
        netcdf_variable *const v = &h->variable[i];
        memset(v, 0, sizeof *v);
        if (read_variable(r, h, v) < 0)
            return -1;
        records += v->is_record != 0;
        last = v->is_record ? i : last;
        h->record_bytes += v->is_record ? v->bytes : 0;
    }
    if (records == 1 && !h->variable[last].is_odd) { /* the only one is not padded */
        h->variable[last].bytes = h->variable[last].values * netcdf_size(h->variable[last].type);
        h->record_bytes = h->variable[last].bytes;
    }
    for (uint32_t i = 0; i < h->variables; i++)
        h->variable[i].stride = h->record_bytes;
    if (h->variables > 1)
        qsort(h->variable, h->variables, sizeof *h->variable, compare_places);
    return 1;
}

static int read_magic(header_reader *r)
{
    unsigned char magic[4];
    if (binary_bytes(r->in, magic, sizeof magic, name) < 0)
        return -1;
    if (memcmp(magic, "\x89HDF", 4) == 0)
        return trajectory_fail(
            r->in->t, 0, "a netCDF file of version 4, which is HDF5: nccopy -k classic makes one that can be read");
    r->version = magic[3];
    if (memcmp(magic, "CDF", 3) != 0 || !(r->version == 1 || r->version == 2 || r->version == 5))
        return trajectory_fail(r->in->t, 0, "not a netCDF file: it does not begin with CDF");
    return 1;
}

int netcdf_read_header(binary_reader *in, netcdf_header *h)
{
    header_reader r = {.in = in};
    double unused = 1.0;
    netcdf_free_header(h);
    if (read_magic(&r) < 0 || read_length(&r, &h->records) < 0)
        return -1;
    if (h->records == (r.version == 5 ? UINT64_MAX : UINT32_MAX))
        h->records = NETCDF_UNKNOWN;
    return read_dimensions(&r, h) < 0 || read_attributes(&r, &unused) < 0 || read_variables(&r, h) < 0 ? -1 : 1;
}

void netcdf_free_header(netcdf_header *h)
{
    free(h->dimension);
    free(h->variable);
    memset(h, 0, sizeof *h);
}

const netcdf_variable *netcdf_find(const netcdf_header *h, const char *wanted)
{
    for (uint32_t i = 0; i < h->variables; i++)
        if (strcmp(h->variable[i].name, wanted) == 0)
            return &h->variable[i];
    return NULL;
}

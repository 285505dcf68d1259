/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The header of a classic netCDF file (versions 1, 2 and 5): which variables it has, of which shape, and where. */
#ifndef NETCDF_HEADER_H
#define NETCDF_HEADER_H

#include "trajectory/binary/binary_reader.h"

#define NETCDF_NAME 256     /* bytes of a name, its zero included */
#define NETCDF_MOST 4096    /* dimensions, variables, or attributes of one of them */
#define NETCDF_DIMENSIONS 8 /* of a variable */
#define NETCDF_UNKNOWN UINT64_MAX

typedef struct netcdf_dimension {
    char name[NETCDF_NAME];
    uint64_t length; /* 0: that of the records */
} netcdf_dimension;

typedef struct netcdf_variable {
    char name[NETCDF_NAME];
    uint32_t dimensions;
    uint32_t dimension[NETCDF_DIMENSIONS]; /* indices; one with more dimensions has is_odd */
    int is_odd;
    int is_record;   /* one value or array for each record */
    uint32_t type;   /* netcdf_size tells the bytes of one value */
    double scale;    /* attribute scale_factor, 1 where there is none */
    uint64_t values; /* in a record, or in all */
    uint64_t bytes;  /* of those, with padding */
    uint64_t begin;  /* of the first, in the file */
    uint64_t stride; /* from record to record */
} netcdf_variable;

typedef struct netcdf_header {
    uint64_t records; /* NETCDF_UNKNOWN: as many as there are */
    uint32_t dimensions, variables;
    netcdf_dimension *dimension;
    netcdf_variable *variable;
    uint64_t record_bytes;
} netcdf_header;

/* Reads the header from the start of a file. Returns 1 or -1. */
int netcdf_read_header(binary_reader *in, netcdf_header *h);
void netcdf_free_header(netcdf_header *h);

/* Bytes of a value of a type, 0: no such type. */
size_t netcdf_size(uint32_t type);

/* A value as a number. */
double netcdf_value(uint32_t type, const unsigned char *bytes);

/* The variable of this name, or NULL. */
const netcdf_variable *netcdf_find(const netcdf_header *h, const char *name);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The effective addresses that an SPE's DMA can reach: a small table of regions. Addresses are numbers that the program
 * chooses, never pointers of the host, so that traces repeat, overruns are found, and a list's 32-bit addresses fit.
 *
 * Main memory is the host's: arrays of elements in the host's byte order. A region has one element size, its unit. A
 * local store of the SPU's byte order and memory of the host's are copied element by element, so that both sides see
 * the same numbers; where the orders agree that is a plain copy. A program that is to run both natively and simulated
 * declares its elements by their true size. Structures of 32-bit words have unit 4; a 64-bit number in them is two
 * words, high first.
 *
 * Threads: a map and its MFCs belong to one thread at a time. */
#ifndef CGT_EA_MAP_H
#define CGT_EA_MAP_H

#include <stdbool.h>
#include <stdint.h>

#include <cgt/cgt.h>

#define CGT_EA_MAX_REGIONS 128
#define CGT_MAX_SPES 16
#define CGT_LINE_BYTES 128 /* of an atomic command, and of the alignment of regions */

struct cgt_mfc;

typedef enum cgt_ea_kind {
    CGT_EA_MEMORY,
    CGT_EA_LOCAL_STORE, /* of an SPE: bytes in the order of that store */
    CGT_EA_SIGNAL       /* a signal notification register: 4 bytes, only for mfc_sndsig */
} cgt_ea_kind;

typedef struct cgt_ea_region {
    uint64_t ea;    /* of the first byte */
    uint64_t bytes; /* at least 1; ea + bytes does not wrap */
    cgt_ea_kind kind;
    bool writable;         /* put may change it */
    uint32_t unit;         /* MEMORY: bytes of an element: 1, 2, 4 or 8 */
    uint8_t *memory;       /* of the host; not for SIGNAL */
    struct cgt_mfc *owner; /* SIGNAL, LOCAL_STORE: whose */
    unsigned number;       /* SIGNAL: 1 or 2 */
} cgt_ea_region;

typedef struct cgt_ea_map {
    cgt_ea_region region[CGT_EA_MAX_REGIONS]; /* by rising address */
    unsigned regions;
    struct cgt_mfc *mfc[CGT_MAX_SPES]; /* whose reservations a write can break */
    unsigned mfcs;
    uint64_t port_free; /* cycle from which the memory's port is free (cgt_mfc_timing.memory_bytes_per_cycle) */
} cgt_ea_map;

/* An empty map. */
void cgt_ea_map_init(cgt_ea_map *map);

/* Adds a region.
 *   region   copied. ea is a multiple of 4 for SIGNAL, of CGT_LINE_BYTES else; memory has region->bytes bytes
 *            and stays valid while the map is used; a region that is not writable is never written
 * INVALID_ARGUMENT where a member is out of its range or the region overlaps another; TOO_LARGE beyond
 * CGT_EA_MAX_REGIONS. The map is unchanged then. */
cgt_result cgt_ea_map_add(cgt_ea_map *map, const cgt_ea_region *region);

/* Main memory: count elements of `unit` bytes at `memory`. Errors as above, and TOO_LARGE where the size overflows. */
cgt_result cgt_ea_map_add_memory(cgt_ea_map *map, uint64_t ea, void *memory, uint64_t count, uint32_t unit,
                                 bool writable);

/* The region that has the address; NULL for none. */
const cgt_ea_region *cgt_ea_map_find(const cgt_ea_map *map, uint64_t ea);

/* Tells that bytes were written: reservations of their lines are lost. */
void cgt_ea_map_written(cgt_ea_map *map, uint64_t ea, uint64_t bytes);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Main memory of a real Cell's run, mapped where the program expects it. */
#define _GNU_SOURCE
#include <inttypes.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "cell/machine/spufs_internal.h"

/* A kernel gives the address that is asked for where nothing else lies there; MAP_FIXED would replace what does. */
static cgt_result map_piece(cgt_cell *cell, cgt_spufs_memory *memory, uint64_t start, uint64_t end)
{
    void *const wanted = (void *)(uintptr_t)start;
    void *const at = (uintptr_t)wanted != start || end - start > SIZE_MAX
                         ? MAP_FAILED
                         : mmap(wanted, end - start, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (at == wanted) {
        memory->piece[memory->pieces].at = at;
        memory->piece[memory->pieces++].bytes = end - start;
        return CGT_OK;
    }
    if (at != MAP_FAILED)
        munmap(at, end - start);
    cgt_cell_fail(cell,
                  "this process cannot have memory from 0x%" PRIx64 " to 0x%" PRIx64 ", where the program wants it",
                  start, end - 1);
    return CGT_ERROR_INVALID_ARGUMENT;
}

/* Regions are sorted; those that share pages are mapped together. */
cgt_result cgt_spufs_map(cgt_cell *cell, cgt_spufs_memory *memory)
{
    const uint64_t page = (uint64_t)sysconf(_SC_PAGESIZE);
    cgt_result result = CGT_OK;
    memory->pieces = 0;
    cell->map = cell->memory;
    for (unsigned i = 0; i < cell->map.regions && result == CGT_OK;) {
        const uint64_t start = cell->map.region[i].ea / page * page;
        uint64_t end = start;
        for (; i < cell->map.regions && (end == start || cell->map.region[i].ea < end); i++)
            end = (cell->map.region[i].ea + cell->map.region[i].bytes + page - 1) / page * page;
        result = map_piece(cell, memory, start, end);
    }
    for (unsigned i = 0; i < cell->map.regions && result == CGT_OK; i++) {
        cgt_ea_region *const region = &cell->map.region[i];
        uint8_t *const at = (uint8_t *)(uintptr_t)region->ea;
        memcpy(at, region->memory, region->bytes);
        region->memory = at;
    }
    if (result != CGT_OK)
        cgt_spufs_unmap(cell, memory);
    return result;
}

void cgt_spufs_unmap(cgt_cell *cell, cgt_spufs_memory *memory)
{
    for (unsigned i = 0; i < cell->map.regions; i++) {
        const cgt_ea_region *const from = &cell->map.region[i], *const to = &cell->memory.region[i];
        if (to->writable && from->memory != to->memory)
            memcpy(to->memory, from->memory, to->bytes);
    }
    cell->map = cell->memory;
    for (unsigned i = 0; i < memory->pieces; i++)
        munmap(memory->piece[i].at, memory->piece[i].bytes);
    memory->pieces = 0;
}

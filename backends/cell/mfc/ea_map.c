/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The table of effective addresses. A few regions in a sorted array: a look-up halves the range. */
#include <string.h>

#include "cell/mfc/ea_map.h"
#include "cell/mfc/mfc_internal.h"

void cgt_ea_map_init(cgt_ea_map *map) { memset(map, 0, sizeof *map); }

/* first region whose end lies above the address */
static unsigned region_above(const cgt_ea_map *map, uint64_t ea)
{
    unsigned low = 0, high = map->regions;
    while (low < high) {
        const unsigned middle = (low + high) / 2;
        if (map->region[middle].ea + (map->region[middle].bytes - 1) < ea)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static bool memory_is_valid(const cgt_ea_region *r)
{
    if (!r->memory || r->ea % CGT_LINE_BYTES != 0)
        return false;
    if (r->kind == CGT_EA_LOCAL_STORE)
        return r->owner && r->bytes <= CGT_LOCAL_STORE_BYTES;
    return (r->unit == 1 || r->unit == 2 || r->unit == 4 || r->unit == 8) && r->bytes % r->unit == 0;
}

static bool region_is_valid(const cgt_ea_region *r)
{
    if (r->bytes == 0 || r->ea + (r->bytes - 1) < r->ea)
        return false;
    switch (r->kind) {
    case CGT_EA_MEMORY:
    case CGT_EA_LOCAL_STORE: return memory_is_valid(r);
    case CGT_EA_SIGNAL: return r->owner && r->bytes == 4 && r->ea % 4 == 0 && (r->number == 1 || r->number == 2);
    }
    return false;
}

cgt_result cgt_ea_map_add(cgt_ea_map *map, const cgt_ea_region *region)
{
    if (!region_is_valid(region))
        return CGT_ERROR_INVALID_ARGUMENT;
    const unsigned at = region_above(map, region->ea);
    if (at < map->regions && map->region[at].ea <= region->ea + (region->bytes - 1))
        return CGT_ERROR_INVALID_ARGUMENT;
    if (map->regions == CGT_EA_MAX_REGIONS)
        return CGT_ERROR_TOO_LARGE;
    memmove(&map->region[at + 1], &map->region[at], (map->regions - at) * sizeof map->region[0]);
    map->region[at] = *region;
    map->regions++;
    return CGT_OK;
}

cgt_result cgt_ea_map_add_memory(cgt_ea_map *map, uint64_t ea, void *memory, uint64_t count, uint32_t unit,
                                 bool writable)
{
    if (unit == 0 || unit > 8)
        return CGT_ERROR_INVALID_ARGUMENT;
    if (count > UINT64_MAX / unit)
        return CGT_ERROR_TOO_LARGE;
    const cgt_ea_region region = {
        .ea = ea, .bytes = count * unit, .kind = CGT_EA_MEMORY, .writable = writable, .unit = unit, .memory = memory};
    return cgt_ea_map_add(map, &region);
}

const cgt_ea_region *cgt_ea_map_find(const cgt_ea_map *map, uint64_t ea)
{
    const unsigned at = region_above(map, ea);
    return at < map->regions && map->region[at].ea <= ea ? &map->region[at] : NULL;
}

void cgt_ea_map_written(cgt_ea_map *map, uint64_t ea, uint64_t bytes)
{
    for (unsigned i = 0; i < map->mfcs; i++) {
        cgt_mfc *const mfc = map->mfc[i];
        /* the line [reserved, reserved + 128) and the bytes [ea, ea + bytes) meet */
        const uint64_t line = mfc->reservation.ea;
        if (mfc->reservation.valid && bytes > 0 && (line - ea < bytes || ea - line < CGT_LINE_BYTES))
            cgt_mfc_lose_reservation(mfc);
    }
}

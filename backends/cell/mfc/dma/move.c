/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Moves bytes between a local store and the regions of the map. Arguments have been checked. */
#include <string.h>

#include "cell/mfc/mfc_internal.h"

#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define HOST_IS_BIG_ENDIAN 1
#else
#define HOST_IS_BIG_ENDIAN 0
#endif

/* Copies elements of `unit` bytes with their bytes reversed: from a host's order to the SPU's and back. */
static void copy_swapped(uint8_t *to, const uint8_t *from, uint32_t size, uint32_t unit)
{
    for (uint32_t i = 0; i < size; i += unit)
        for (uint32_t k = 0; k < unit; k++)
            to[i + k] = from[i + unit - 1 - k];
}

/* Between the store and a region: elements keep their numbers. Local stores have one order among them. */
static void copy(const cgt_mfc *mfc, const cgt_ea_region *region, uint8_t *to, const uint8_t *from, uint32_t size)
{
    const bool swaps = mfc->store.order == CGT_STORE_BIG_ENDIAN && !HOST_IS_BIG_ENDIAN &&
                       region->kind == CGT_EA_MEMORY && region->unit > 1;
    if (swaps)
        copy_swapped(to, from, size, region->unit);
    else
        memmove(to, from, size); /* an SPE may copy within its own store */
}

static void tell(const cgt_mfc *mfc, uint32_t lsa, uint32_t size)
{
    if (mfc->store.written)
        mfc->store.written(mfc->store.user, lsa, size);
}

void cgt_mfc_move(cgt_mfc *mfc, bool to_memory, uint32_t lsa, uint64_t ea, uint32_t size)
{
    const cgt_ea_region *const region = cgt_ea_map_find(mfc->map, ea);
    uint8_t *const memory = region->memory + (ea - region->ea), *const local = mfc->store.bytes + lsa;
    if (to_memory) {
        copy(mfc, region, memory, local, size);
        mfc->counts.bytes_out += size;
        if (region->kind == CGT_EA_LOCAL_STORE)
            tell(region->owner, (uint32_t)(ea - region->ea), size);
        cgt_ea_map_written(mfc->map, ea, size);
    } else {
        copy(mfc, region, local, memory, size);
        mfc->counts.bytes_in += size;
        tell(mfc, lsa, size);
    }
}

void cgt_mfc_zero(cgt_mfc *mfc, uint64_t ea, uint32_t size)
{
    const cgt_ea_region *const region = cgt_ea_map_find(mfc->map, ea);
    memset(region->memory + (ea - region->ea), 0, size);
    if (region->kind == CGT_EA_LOCAL_STORE)
        tell(region->owner, (uint32_t)(ea - region->ea), size);
    cgt_ea_map_written(mfc->map, ea, size);
}

uint32_t cgt_mfc_load32(const cgt_mfc *mfc, uint32_t lsa)
{
    const uint8_t *const b = mfc->store.bytes + lsa;
    uint32_t word;
    if (mfc->store.order == CGT_STORE_BIG_ENDIAN)
        return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
    memcpy(&word, b, sizeof word);
    return word;
}

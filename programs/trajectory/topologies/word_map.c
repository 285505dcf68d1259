/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A hash table with open addressing. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/topologies/word_map.h"
#include "trajectory/trajectory_internal.h"

#include <stdlib.h>
#include <string.h>

/* The slot of a word, or the free one where it would be; there is one. */
static uint32_t find_slot(const word_map *map, text_span word)
{
    uint64_t hash = 14695981039346656037u; /* FNV-1a */
    for (const char *p = word.begin; p < word.end; p++)
        hash = (hash ^ (unsigned char)*p) * 1099511628211u;
    uint32_t at = (uint32_t)((hash ^ hash >> 32) % map->slots);
    while (map->slot[at] != 0 && !text_is(word, map->word[map->slot[at] - 1]))
        at = at + 1 < map->slots ? at + 1 : 0;
    return at;
}

uint32_t word_map_find(const word_map *map, text_span word)
{
    const uint32_t number = map->slots > 0 ? map->slot[find_slot(map, word)] : 0;
    return number > 0 ? number - 1 : WORD_NONE;
}

/* Makes room for one word more. */
static int grow(word_map *map)
{
    const uint32_t capacity = 2 * map->capacity + 64, slots = 2 * capacity + 1;
    uint32_t *const slot = calloc(slots, sizeof *slot);
    if (slot == NULL || trajectory_grow(&map->word, capacity, sizeof *map->word)) {
        free(slot);
        return -1;
    }
    free(map->slot);
    map->slot = slot;
    map->slots = slots;
    map->capacity = capacity;
    for (uint32_t i = 0; i < map->count; i++)
        map->slot[find_slot(map, (text_span){map->word[i], map->word[i] + strlen(map->word[i])})] = i + 1;
    return 0;
}

uint32_t word_map_add(word_map *map, text_span word)
{
    const uint32_t found = word_map_find(map, word);
    if (found != WORD_NONE)
        return found;
    if (map->count == map->capacity && grow(map))
        return WORD_NONE;
    const size_t length = text_length(word);
    char *const copy = malloc(length + 1);
    if (copy == NULL)
        return WORD_NONE;
    memcpy(copy, word.begin, length);
    copy[length] = '\0';
    map->word[map->count++] = copy;
    map->slot[find_slot(map, word)] = map->count;
    return map->count - 1;
}

void word_map_free(word_map *map)
{
    for (uint32_t i = 0; i < map->count; i++)
        free(map->word[i]);
    free(map->word);
    free(map->slot);
    *map = (word_map){.count = 0};
}

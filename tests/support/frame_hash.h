/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A frame of a trajectory as one number (FNV-1a), to compare readings of a file bit by bit: frames of equal hashes
 * count as equal. */
#ifndef FRAME_HASH_H
#define FRAME_HASH_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cgt/trajectory.h>

static inline uint64_t frame_hash_bytes(uint64_t hash, const void *bytes, size_t size)
{
    const unsigned char *const b = bytes;
    hash = (hash ^ (bytes != NULL)) * UINT64_C(0x100000001b3); /* an array that is not there is not one of zeros */
    for (size_t i = 0; i < size && bytes != NULL; i++)
        hash = (hash ^ b[i]) * UINT64_C(0x100000001b3);
    return hash;
}

/* Of the data that a .frames file stores. */
static inline uint64_t frame_hash_shapes(const cgt_trajectory_frame *f)
{
    uint64_t hash = frame_hash_bytes(UINT64_C(0xcbf29ce484222325), &f->count, sizeof f->count);
    hash = frame_hash_bytes(hash, f->xyzr, (size_t)f->count * 16);
    hash = frame_hash_bytes(hash, f->index, (size_t)f->triangles * 12);
    return frame_hash_bytes(hash, f->position, (size_t)f->count * 12);
}

static inline uint64_t frame_hash_column(uint64_t hash, const cgt_trajectory_column *c, uint32_t count)
{
    const int is_word = c->value != NULL && c->kind == CGT_TRAJECTORY_WORD;
    hash = frame_hash_bytes(hash, c->name, strlen(c->name));
    hash = frame_hash_bytes(hash, &c->kind, sizeof c->kind);
    hash = frame_hash_bytes(hash, c->value, (size_t)count * 4);
    for (uint32_t i = 0; is_word && i < c->words; i++)
        hash = frame_hash_bytes(hash, c->word[i], strlen(c->word[i]) + 1);
    return hash;
}

/* Of all data of a frame. */
static inline uint64_t frame_hash(const cgt_trajectory_frame *f)
{
    const size_t count = f->count;
    uint64_t hash = frame_hash_shapes(f);
    hash = frame_hash_bytes(hash, &f->number, sizeof f->number);
    hash = frame_hash_bytes(hash, &f->kind, sizeof f->kind);
    hash = frame_hash_bytes(hash, &f->step, sizeof f->step);
    hash = frame_hash_bytes(hash, f->vertex_normal, count * 12);
    hash = frame_hash_bytes(hash, f->id, count * 4);
    hash = frame_hash_bytes(hash, f->type, count * 4);
    hash = frame_hash_bytes(hash, f->velocity, count * 12);
    hash = frame_hash_bytes(hash, f->element, count);
    hash = frame_hash_bytes(hash, f->bond, (size_t)f->bonds * 8);
    hash = frame_hash_bytes(hash, f->origin, sizeof f->origin);
    hash = frame_hash_bytes(hash, f->box_min, sizeof f->box_min);
    hash = frame_hash_bytes(hash, f->box_max, sizeof f->box_max);
    hash = frame_hash_bytes(hash, f->box_origin, sizeof f->box_origin);
    hash = frame_hash_bytes(hash, f->box_edge, sizeof f->box_edge);
    hash = frame_hash_bytes(hash, f->periodic, sizeof f->periodic);
    hash = frame_hash_bytes(hash, f->unwrapped, sizeof f->unwrapped);
    hash = frame_hash_bytes(hash, &f->time, sizeof f->time);
    hash = frame_hash_bytes(hash, &f->has_radius, sizeof f->has_radius);
    hash = frame_hash_bytes(hash, &f->angstrom, sizeof f->angstrom);
    for (uint32_t i = 0; i < f->columns; i++)
        hash = frame_hash_column(hash, &f->column[i], f->count);
    return hash;
}

#endif

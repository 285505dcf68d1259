/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The SPU's register image on any host.
 *
 *   quad   a register as the SPU has it: 16 bytes, byte 0 the most significant byte of element 0 */
#ifndef SPU_QUAD_H
#define SPU_QUAD_H

#include <stdbool.h>
#include <stdint.h>

typedef struct spu_quad {
    uint8_t byte[16];
} spu_quad;

/* Types of elements, named as the tokens of simd/spu/spu_words.h are. */
typedef enum spu_type {
    SPU_u8,
    SPU_s8,
    SPU_u16,
    SPU_s16,
    SPU_u32,
    SPU_s32,
    SPU_u64,
    SPU_s64,
    SPU_f32,
    SPU_f64
} spu_type;

int spu_bits(spu_type type);     /* of an element */
int spu_elements(spu_type type); /* of a quad */
bool spu_is_float(spu_type type);

/* Element i as bits in the low end of a number, and back. */
uint64_t spu_get(const spu_quad *quad, spu_type type, int i);
void spu_set(spu_quad *quad, spu_type type, int i, uint64_t bits);

/* 16 bytes of the host, element 0 first, each element in the host's byte order. */
void spu_to_host(const spu_quad *quad, spu_type type, void *bytes);
spu_quad spu_from_host(const void *bytes, spu_type type);

/* The first bytes in hexadecimal, a space between elements. */
const char *spu_text(const spu_quad *quad, spu_type type, int bytes, char text[48]);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A program as written for an SPU: of the library it uses only the header behind the name. It compiles unchanged with
 * an SPU's own compiler. */
#include <spu_intrinsics.h>
#include <stdio.h>

/* c = a * b, rows of four */
static void multiply(const vector float a[4], const vector float b[4], vector float c[4])
{
    for (int i = 0; i < 4; i++) {
        const vector float x = spu_splats(spu_extract(a[i], 0)), y = spu_splats(spu_extract(a[i], 1));
        const vector float z = spu_splats(spu_extract(a[i], 2)), w = spu_splats(spu_extract(a[i], 3));
        c[i] = spu_madd(w, b[3], spu_madd(z, b[2], spu_madd(y, b[1], spu_mul(x, b[0]))));
    }
}

static void transpose(const vec_float4 a[4], vec_float4 t[4])
{
    const vec_uchar16 high = {0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21, 22, 23};
    const vec_uchar16 low = {8, 9, 10, 11, 24, 25, 26, 27, 12, 13, 14, 15, 28, 29, 30, 31};
    const vec_float4 x = spu_shuffle(a[0], a[2], high), y = spu_shuffle(a[1], a[3], high);
    const vec_float4 z = spu_shuffle(a[0], a[2], low), w = spu_shuffle(a[1], a[3], low);
    t[0] = spu_shuffle(x, y, high);
    t[1] = spu_shuffle(x, y, low);
    t[2] = spu_shuffle(z, w, high);
    t[3] = spu_shuffle(z, w, low);
}

/* a + b as numbers of 128 bits: the carries go up a word at a time */
static vec_uint4 add128(vec_uint4 a, vec_uint4 b)
{
    vec_uint4 carry = spu_slqwbyte(spu_genc(a, b), 4);
    for (int i = 0; i < 2; i++)
        carry = spu_or(carry, spu_slqwbyte(spu_gencx(a, b, carry), 4));
    return spu_addx(a, b, carry);
}

/* ones in a quadword */
static unsigned count(vec_uint4 a)
{
    const vec_uchar16 ones = spu_cntb((vec_uchar16)a);
    const vec_uint4 words = (vec_uint4)spu_sumb(ones, spu_splats((unsigned char)0));
    const vec_uint4 two = spu_add(words, spu_rlqwbyte(words, 8)), one = spu_add(two, spu_rlqwbyte(two, 4));
    const unsigned sum = spu_extract(one, 0);
    return (sum & 0xffff) + (sum >> 16); /* the sums lie in the odd halfwords */
}

/* the least of four, and where it is */
static float least(vec_float4 a, int *position)
{
    const vec_float4 b = spu_sel(a, spu_rlqwbyte(a, 8), spu_cmpgt(a, spu_rlqwbyte(a, 8)));
    const vec_float4 c = spu_sel(b, spu_rlqwbyte(b, 4), spu_cmpgt(b, spu_rlqwbyte(b, 4)));
    const unsigned equal = spu_extract(spu_gather(spu_cmpeq(a, c)), 0);
    *position = (int)spu_extract(spu_cntlz(spu_promote(equal << 28, 0)), 0);
    return spu_extract(c, 0);
}

int main(void)
{
    vec_float4 a[4] = {{0}}, b[4] = {{0}}, c[4], t[4];
    int wrong = 0, position = -1;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++) {
            a[i] = spu_insert((float)(i + 2 * k), a[i], k);
            b[i] = spu_insert((float)(3 * i - k), b[i], k);
        }
    multiply(a, b, c);
    transpose(c, t);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++) {
            float sum = 0;
            for (int j = 0; j < 4; j++)
                sum += (float)(i + 2 * j) * (float)(3 * j - k);
            wrong += spu_extract(c[i], k) != sum || spu_extract(t[k], i) != sum;
        }
    const vec_uint4 s = add128((vec_uint4){0, 0xffffffffu, 0xffffffffu, 0xffffffffu}, (vec_uint4){0, 0, 0, 1});
    wrong += spu_extract(s, 0) != 1 || spu_extract(s, 1) != 0 || spu_extract(s, 3) != 0;
    wrong += count((vec_uint4){0xff, 0x80000001u, 0, 0xffffffffu}) != 42;
    wrong += least((vec_float4){3, 1, -2, 7}, &position) != -2 || position != 2;
    printf("%d wrong\n", wrong);
    return wrong != 0;
}

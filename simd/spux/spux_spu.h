/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Words of vector.h on four lanes for which an SPU has better than the plain C of spux_four.h: it compares and stores
 * quadwords alone, so that what C writes element by element costs it a load, a rotation and a shuffle for each. They
 * are made of the generic words, and thus run on hosts too, for a test (CGT_SPUX_SPU), but for those that touch memory:
 * these rely on local store, where no address faults.
 *
 *   quadword   16 bytes at a multiple of 16; loads and stores take nothing else, and ignore the low bits of an address
 *   pattern    of spu_shuffle: bytes 0 to 15 of the first operand, 16 to 31 of the second, 0x80 for zero
 *
 * Every store to less than a quadword reads the quadword and writes it back. So it does for a scalar in C; here as
 * there no DMA may be under way to the quadwords that hold what is stored. Others are not written. */
#ifndef CGT_SPUX_SPU_H
#define CGT_SPUX_SPU_H

#ifndef spux_cast /* of spu_intrinsics.h, which an SPU does without: there a cast is what it says */
#define spux_cast(type, a) ((type)(a))
#endif

#define CGT_SPUX_LANE(n) 4 * (n), 4 * (n) + 1, 4 * (n) + 2, 4 * (n) + 3 /* of a pattern: word n of both operands */
#define CGT_SPUX_NONE 0x80, 0x80, 0x80, 0x80
#define CGT_SPUX_LANES(a, b, c, d)                                                                                     \
    {                                                                                                                  \
        CGT_SPUX_LANE(a), CGT_SPUX_LANE(b), CGT_SPUX_LANE(c), CGT_SPUX_LANE(d)                                         \
    }

/* ---- masks ---- */

/* spu_gather and spu_maskw have lane 0 in the highest of four bits. */
#define CGT_SPUX_OWN_MASK_BITS
CGT_SPU_INLINE unsigned spux_mask_bits(vmask m)
{
    const vec_uchar16 reverse = CGT_SPUX_LANES(3, 2, 1, 0);
    return spu_extract(spu_gather(spu_shuffle(m, m, reverse)), 0);
}
#define CGT_SPUX_OWN_MASK_FROM_BITS
CGT_SPU_INLINE vmask spux_mask_from_bits(unsigned bits)
{
    const vec_uchar16 reverse = CGT_SPUX_LANES(3, 2, 1, 0);
    const vec_uint4 m = spu_maskw(bits);
    return spu_shuffle(m, m, reverse);
}
#define CGT_SPUX_OWN_COUNT_BITS
CGT_SPU_INLINE uint32_t spux_count_bits(unsigned bits)
{
    const vec_uint4 word = spu_promote(bits & 15, 0); /* its lowest byte has all */
    return spu_extract(spux_cast(vec_uint4, spu_cntb(spux_cast(vec_uchar16, word))), 0);
}
#define CGT_SPUX_OWN_ANY_ALL
CGT_SPU_INLINE bool spux_any(vmask m) { return spu_extract(spu_gather(m), 0) != 0; }
CGT_SPU_INLINE bool spux_all(vmask m) { return spu_extract(spu_gather(m), 0) == 15; }

/* ---- between lanes ---- */

/* Bytes 4n to 4n + 3 for each lane number n: the number's last byte four times, and 0 to 3. */
#define CGT_SPUX_OWN_PERMUTE
CGT_SPU_INLINE vuint cgt_spux_permute_w(vuint a, vuint index)
{
    const vec_uchar16 last_byte = {3, 3, 3, 3, 7, 7, 7, 7, 11, 11, 11, 11, 15, 15, 15, 15};
    const vec_uchar16 in_word = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
    const vec_uchar16 first = spux_cast(vec_uchar16, spu_sl(spu_and(index, 3), 2));
    return spu_shuffle(a, a, spu_or(spu_shuffle(first, first, last_byte), in_word));
}

/* The words of the true lanes side by side, then zeros, by the bits that spu_gather makes. */
#define CGT_SPUX_OWN_COMPRESS
CGT_SPU_INLINE vuint cgt_spux_compress_w(vuint a, vmask m)
{
#define W_ CGT_SPUX_LANE
#define N_ CGT_SPUX_NONE
    static const vec_uchar16 packed[16] = {
        {N_, N_, N_, N_},       {W_(3), N_, N_, N_},       {W_(2), N_, N_, N_},       {W_(2), W_(3), N_, N_},
        {W_(1), N_, N_, N_},    {W_(1), W_(3), N_, N_},    {W_(1), W_(2), N_, N_},    {W_(1), W_(2), W_(3), N_},
        {W_(0), N_, N_, N_},    {W_(0), W_(3), N_, N_},    {W_(0), W_(2), N_, N_},    {W_(0), W_(2), W_(3), N_},
        {W_(0), W_(1), N_, N_}, {W_(0), W_(1), W_(3), N_}, {W_(0), W_(1), W_(2), N_}, {W_(0), W_(1), W_(2), W_(3)}};
#undef W_
#undef N_
    return spu_shuffle(a, a, packed[spu_extract(spu_gather(m), 0)]);
}

#define CGT_SPUX_OWN_HORIZONTAL
CGT_SPU_INLINE float cgt_spux_hmin_f32w(vfloat a)
{
    const vfloat b = spu_rlqwbyte(a, 8), two = spu_sel(a, b, spu_cmpgt(a, b)), c = spu_rlqwbyte(two, 4);
    return spu_extract(spu_sel(two, c, spu_cmpgt(two, c)), 0);
}
CGT_SPU_INLINE float cgt_spux_hmax_f32w(vfloat a)
{
    const vfloat b = spu_rlqwbyte(a, 8), two = spu_sel(a, b, spu_cmpgt(b, a)), c = spu_rlqwbyte(two, 4);
    return spu_extract(spu_sel(two, c, spu_cmpgt(c, two)), 0);
}
CGT_SPU_INLINE uint32_t cgt_spux_hmin_u32w(vuint a)
{
    const vuint b = spu_rlqwbyte(a, 8), two = spu_sel(a, b, spu_cmpgt(a, b)), c = spu_rlqwbyte(two, 4);
    return spu_extract(spu_sel(two, c, spu_cmpgt(two, c)), 0);
}
CGT_SPU_INLINE uint32_t cgt_spux_hmax_u32w(vuint a)
{
    const vuint b = spu_rlqwbyte(a, 8), two = spu_sel(a, b, spu_cmpgt(b, a)), c = spu_rlqwbyte(two, 4);
    return spu_extract(spu_sel(two, c, spu_cmpgt(c, two)), 0);
}

#define CGT_SPUX_OWN_TRANSPOSE
CGT_SPU_INLINE void cgt_spux_transpose4_w(const vfloat r[4], vfloat d[4])
{
    const vec_uchar16 low = CGT_SPUX_LANES(0, 4, 1, 5), high = CGT_SPUX_LANES(2, 6, 3, 7);
    const vfloat low02 = spu_shuffle(r[0], r[2], low), low13 = spu_shuffle(r[1], r[3], low);
    const vfloat high02 = spu_shuffle(r[0], r[2], high), high13 = spu_shuffle(r[1], r[3], high);
    d[0] = spu_shuffle(low02, low13, low);
    d[1] = spu_shuffle(low02, low13, high);
    d[2] = spu_shuffle(high02, high13, low);
    d[3] = spu_shuffle(high02, high13, high);
}
#define CGT_SPUX_OWN_UNZIP
CGT_SPU_INLINE void spux_unzip(vuint v[2])
{
    const vec_uchar16 even = CGT_SPUX_LANES(0, 2, 4, 6), odd = CGT_SPUX_LANES(1, 3, 5, 7);
    const vuint a = v[0], b = v[1];
    v[0] = spu_shuffle(a, b, even);
    v[1] = spu_shuffle(a, b, odd);
}

/* ---- memory ---- */

#if defined(__SPU__) && !defined(CGT_SPU_HOST)

typedef vec_uchar16 cgt_spux_quadword __attribute__((may_alias));

CGT_SPU_INLINE cgt_spux_quadword *cgt_spux_quadword_at(uintptr_t p)
{
    return (cgt_spux_quadword *)(p & ~(uintptr_t)15);
}

/* 16 bytes at any address: the end of the quadword that holds the first one, and the beginning of the one that holds
 * the last. At a multiple of 16 that is one quadword, and nothing is taken of it the second time. */
CGT_SPU_INLINE vec_uchar16 cgt_spux_load_bytes16(const void *p)
{
    const uintptr_t first = (uintptr_t)p;
    const vec_uchar16 a = *cgt_spux_quadword_at(first), b = *cgt_spux_quadword_at(first + 15);
    return spu_or(spu_slqwbyte(a, (unsigned)first & 15), spu_rlmaskqwbyte(b, (int)(first & 15) - 16));
}

#define CGT_SPUX_OWN_UNALIGNED
CGT_SPU_INLINE vuint cgt_spux_load_unaligned_w(const void *p) { return (vuint)cgt_spux_load_bytes16(p); }

/* Stores the lanes in m. The quadword of the last byte is written first: at a multiple of 16 both are one, and the
 * second store has the right bytes. Where it gets no lane it is not written. */
CGT_SPU_INLINE void cgt_spux_store_mask_w(void *p, vuint v, vmask m)
{
    const uintptr_t first = (uintptr_t)p;
    const int offset = (int)(first & 15);
    const vec_uchar16 ones = (vec_uchar16)spu_splats(0xffffffffu), front = spu_rlmaskqwbyte(ones, -offset);
    const vec_uchar16 bytes = (vec_uchar16)spu_rlqwbyte(v, -offset), stored = (vec_uchar16)spu_rlqwbyte(m, -offset);
    const vec_uchar16 behind = spu_andc(stored, front);
    cgt_spux_quadword *const a = cgt_spux_quadword_at(first);
    cgt_spux_quadword *const b = spux_any((vmask)behind) ? cgt_spux_quadword_at(first + 15) : a;
    const vec_uchar16 old = *a;
    *b = spu_sel(*b, bytes, behind);
    *a = spu_sel(old, bytes, spu_and(stored, front));
}
CGT_SPU_INLINE void cgt_spux_store_unaligned_w(void *p, vuint v)
{
    const uintptr_t first = (uintptr_t)p;
    const int offset = (int)(first & 15);
    const vec_uchar16 ones = (vec_uchar16)spu_splats(0xffffffffu), front = spu_rlmaskqwbyte(ones, -offset);
    const vec_uchar16 bytes = (vec_uchar16)spu_rlqwbyte(v, -offset);
    cgt_spux_quadword *const a = cgt_spux_quadword_at(first), *const b = cgt_spux_quadword_at(first + 15);
    const vec_uchar16 old = *a;
    *b = spu_sel(bytes, *b, front);
    *a = spu_sel(old, bytes, front);
}

/* Reading what is not wanted harms nobody. */
#define CGT_SPUX_OWN_LOAD_STORE_MASK
CGT_SPU_INLINE vuint cgt_spux_load_mask_w(const void *p, vmask m) { return spu_and(cgt_spux_load_unaligned_w(p), m); }

/* The words at four addresses, each a multiple of 4: rotated to the front of its quadword, then put side by side. */
#define CGT_SPUX_OWN_GATHER
CGT_SPU_INLINE vuint cgt_spux_gather_w(const void *base, vint index)
{
    const vec_uchar16 low = CGT_SPUX_LANES(0, 4, 0, 4), pairs = CGT_SPUX_LANES(0, 1, 4, 5);
    vuint word[4];
    for (int i = 0; i < 4; i++) {
        const uintptr_t at = (uintptr_t)base + 4 * (uintptr_t)spu_extract(index, i);
        word[i] = (vuint)spu_rlqwbyte(*cgt_spux_quadword_at(at), (int)(at & 15));
    }
    return spu_shuffle(spu_shuffle(word[0], word[1], low), spu_shuffle(word[2], word[3], low), pairs);
}

#define CGT_SPUX_OWN_LOAD_BYTES
CGT_SPU_INLINE vuint spux_load_bytes(const uint8_t *p)
{
    const vec_uchar16 spread = {0x80, 0x80, 0x80, 0, 0x80, 0x80, 0x80, 1, 0x80, 0x80, 0x80, 2, 0x80, 0x80, 0x80, 3};
    const vec_uchar16 bytes = cgt_spux_load_bytes16(p);
    return (vuint)spu_shuffle(bytes, bytes, spread);
}

/* A bit per halfword, the first one highest; their leading zeros are the index. */
#define CGT_SPUX_OWN_FIND16
CGT_SPU_INLINE uint32_t spux_find16(const uint16_t *p, uint16_t x)
{
    const vec_ushort8 wanted = spu_splats(x);
    const vec_uint4 front = spu_gather(spu_cmpeq((vec_ushort8)cgt_spux_load_bytes16(p), wanted));
    const vec_uint4 back = spu_gather(spu_cmpeq((vec_ushort8)cgt_spux_load_bytes16(p + 8), wanted));
    const vec_uint4 found = spu_or(spu_sl(front, 24), spu_sl(back, 16));
    return spu_extract(spu_cntlz(spu_or(found, 0x8000u)), 0); /* a bit behind the last: 16 */
}

/* Lane k's record at AT(k). */
#define CGT_SPUX_OWN_LOAD_RECORDS4
#define CGT_SPUX_LOAD_RECORDS4(AT, d)                                                                                  \
    do {                                                                                                               \
        vfloat r_[4];                                                                                                  \
        for (int k_ = 0; k_ < 4; k_++)                                                                                 \
            r_[k_] = (vfloat)cgt_spux_load_bytes16(AT(k_));                                                            \
        cgt_spux_transpose4_w(r_, d);                                                                                  \
    } while (0)

#endif

#endif

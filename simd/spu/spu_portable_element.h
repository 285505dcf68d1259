/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Portable mapping: words between scalars and elements. A part of spu_portable.h. */
#ifndef CGT_SPU_PORTABLE_ELEMENT_H
#define CGT_SPU_PORTABLE_ELEMENT_H

#define CGT_SPU_X(type, vec, element, mask, n)                                                                         \
    CGT_SPU_INLINE vec cgt_spu_splats_##type(element a) { return (vec){CGT_SPU_TIMES_##n(a)}; }                        \
    /* positions count modulo the number of elements, as the SPU's rotate and insert do */                             \
    CGT_SPU_INLINE element cgt_spu_extract_##type(vec a, int position) { return a[position & (n - 1)]; }               \
    CGT_SPU_INLINE vec cgt_spu_insert_##type(element a, vec b, int position)                                           \
    {                                                                                                                  \
        b[position & (n - 1)] = a;                                                                                     \
        return b;                                                                                                      \
    }                                                                                                                  \
    /* the other elements are undefined on an SPU; here they hold the scalar too */                                    \
    CGT_SPU_INLINE vec cgt_spu_promote_##type(element a, int position)                                                 \
    {                                                                                                                  \
        (void)position;                                                                                                \
        return cgt_spu_splats_##type(a);                                                                               \
    }
CGT_SPU_EACH(CGT_SPU_X)
#undef CGT_SPU_X

#endif

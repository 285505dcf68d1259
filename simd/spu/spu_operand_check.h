/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Checks the operands of a word other than the one that selects its function: each macro is the operand itself where
 * its type fits, and otherwise an object that no function accepts and whose name states the mistake.
 *
 * clang silently converts any vector type to any other of the same size. GCC does not and needs no check; nor do the
 * library's kernels at more than four lanes. */
#ifndef CGT_SPU_OPERAND_CHECK_H
#define CGT_SPU_OPERAND_CHECK_H

#if defined(__clang__) && (!defined(CGT_LANES) || CGT_LANES == 4)

extern struct cgt_spu_operand_types_do_not_match {
    int nothing;
} cgt_spu_operand_types_do_not_match;

#define CGT_SPU_OF_TYPE(type, b) _Generic((b), type : (b), default : cgt_spu_operand_types_do_not_match)
/* the type of a value; + drops qualifiers */
#define CGT_SPU_TYPE_OF(a) __typeof__(+(a))

/* b of a's type; of a type; of a's type unless a is a scalar; a mask for vectors of a's type; what is added to a
 * product of a's type */
#define CGT_SPU_OPERAND_SAME(a, b) CGT_SPU_OF_TYPE(CGT_SPU_TYPE_OF(a), b)
#define CGT_SPU_OPERAND_IS(type, b) CGT_SPU_OF_TYPE(type, b)
#define CGT_SPU_OPERAND_LIKE(a, b)                                                                                     \
    CGT_SPU_OF_TYPE(CGT_SPU_TYPE_OF(__builtin_choose_expr(sizeof(__typeof__(a)) < 16, (b), (a))), b)
#define CGT_SPU_OPERAND_MASK(a, m)                                                                                     \
    CGT_SPU_OF_TYPE(CGT_SPU_TYPE_OF(_Generic((a), vec_uchar16                                                          \
                                             : (vec_uchar16){0}, vec_char16                                            \
                                             : (vec_uchar16){0}, vec_ushort8                                           \
                                             : (vec_ushort8){0}, vec_short8                                            \
                                             : (vec_ushort8){0}, vec_ullong2                                           \
                                             : (vec_ullong2){0}, vec_llong2                                            \
                                             : (vec_ullong2){0}, vec_double2                                           \
                                             : (vec_ullong2){0}, default                                               \
                                             : (vec_uint4){0})),                                                       \
                    m)
#define CGT_SPU_OPERAND_ADDEND(a, c)                                                                                   \
    CGT_SPU_OF_TYPE(CGT_SPU_TYPE_OF(_Generic((a), vec_short8                                                           \
                                             : (vec_int4){0}, vec_ushort8                                              \
                                             : (vec_uint4){0}, default                                                 \
                                             : (a))),                                                                  \
                    c)

#else

#define CGT_SPU_OPERAND_SAME(a, b) b
#define CGT_SPU_OPERAND_IS(type, b) b
#define CGT_SPU_OPERAND_LIKE(a, b) b
#define CGT_SPU_OPERAND_MASK(a, m) m
#define CGT_SPU_OPERAND_ADDEND(a, c) c

#endif
#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The row's functions as a table: cgt_kernel_sse and the like, for src/dispatch/variant.c. */
#include "dispatch/kernel.h"

#define DECLARE(type, name, function) type CGT_KERNEL(function);
#define ENTRY(type, name, function) .name = CGT_KERNEL(function),

CGT_KERNELS(DECLARE)
extern const struct cgt_bvh_builder CGT_KERNEL(cgt_bvh_builder);
extern const struct cgt_paper_kernels CGT_KERNEL(cgt_paper_kernels);

#define NAME_(variant) #variant
#define NAME(variant) NAME_(variant)

const cgt_kernel CGT_KERNEL(cgt_kernel) = {.name = NAME(CGT_VARIANT),
                                           .lanes = CGT_LANES,
                                           .bvh_builder = &CGT_KERNEL(cgt_bvh_builder),
                                           .papers = &CGT_KERNEL(cgt_paper_kernels),
                                           CGT_KERNELS(ENTRY)};

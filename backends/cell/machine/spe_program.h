/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * For the source of an SPE program that is compiled for an SPU and for the host:
 *
 *   typedef struct store {              // all that the program keeps, and that DMA touches
 *       _Alignas(128) float in[1024];
 *       ...
 *   } store;
 *   CGT_SPE_STORE(store, s)             // s() is its address; checked against the budget when compiled
 *
 *   CGT_SPE_MAIN(scale)                 // main on an SPU, a function `scale` on the host
 *   {
 *       mfc_get(s()->in, argument, sizeof s()->in, 0, 0, 0);
 *       ...
 *       return 0;
 *   }
 *
 * On an SPU the store is a static object. On the host it is an arena of the size of a local store, one for each thread
 * that cgt_cell_run_native starts. DMA reaches nothing else there: no other static objects, nothing on the stack.
 *
 * Rules for the same bits both ways: only elements of the region's unit cross a DMA (ea_map.h); the store has no
 * pointers in what is transferred; float arithmetic is in the spu_* words, with CGT_SPU_EXACT on the host; float
 * constants are hexadecimal words or need 24 bits at most. */
#ifndef CGT_SPE_PROGRAM_H
#define CGT_SPE_PROGRAM_H

#include "cell/machine/spe_addresses.h"
#include "spu_intrinsics.h"
#include "spu_mfcio.h"

/* The budget: what local store has beside the store. A program with other needs defines these before it includes the
 * header; the linker of the SPU has the last word. */
#ifndef CGT_SPE_TEXT_BYTES
#define CGT_SPE_TEXT_BYTES 65536 /* text, constants, the C library */
#endif
#ifndef CGT_SPE_STACK_BYTES
#define CGT_SPE_STACK_BYTES 16384
#endif
#define CGT_SPE_STORE_BYTES (262144 - CGT_SPE_TEXT_BYTES - CGT_SPE_STACK_BYTES)

#define CGT_SPE_ARGUMENTS                                                                                              \
    unsigned long long spe __attribute__((unused)), unsigned long long argument __attribute__((unused)),               \
        unsigned long long environment __attribute__((unused))

#if defined(__SPU__) && !defined(CGT_SPU_HOST)

#define CGT_SPE_STORE(type, name)                                                                                      \
    _Static_assert(sizeof(type) <= CGT_SPE_STORE_BYTES, "the store exceeds what text and stack leave of 256 KB");      \
    static type cgt_spe_static_store __attribute__((aligned(128)));                                                    \
    static inline type *name(void) { return &cgt_spe_static_store; }

#define CGT_SPE_MAIN(name) int main(CGT_SPE_ARGUMENTS)

/* What another SPE adds to CGT_SPE_EA to reach the same place. */
static inline uint32_t cgt_spe_local_address(const volatile void *p) { return (uint32_t)p; }

#else

/* The arena of this thread: cgt_cell_run_native's host begins with its address. */
static inline void *cgt_spe_arena(void)
{
    const cgt_spu_host *const host = cgt_spu_get_host();
    if (!host)
        cgt_spu_fail("cgt_spe_arena", CGT_SPU_NO_CHANNEL, "self");
    return *(void *const *)host->self;
}

static inline uint32_t cgt_spe_local_address(const volatile void *p)
{
    return (uint32_t)((uintptr_t)p - (uintptr_t)cgt_spe_arena());
}

#define CGT_SPE_STORE(type, name)                                                                                      \
    _Static_assert(sizeof(type) <= CGT_SPE_STORE_BYTES, "the store exceeds what text and stack leave of 256 KB");      \
    static inline type *name(void) { return (type *)cgt_spe_arena(); }

/* The program's arithmetic mode lies around a function that is not inlined: see spu_arithmetic_mode.h. */
#define CGT_SPE_MAIN(name)                                                                                             \
    static __attribute__((noinline)) int name##_main(CGT_SPE_ARGUMENTS);                                               \
    int name(unsigned long long spe, unsigned long long argument, unsigned long long environment);                     \
    int name(unsigned long long spe, unsigned long long argument, unsigned long long environment)                      \
    {                                                                                                                  \
        const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();                                                   \
        const int code = name##_main(spe, argument, environment);                                                      \
        cgt_spu_leave_arithmetic(saved);                                                                               \
        return code;                                                                                                   \
    }                                                                                                                  \
    static int name##_main(CGT_SPE_ARGUMENTS)

#endif
#endif

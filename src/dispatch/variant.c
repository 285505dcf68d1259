/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The variant table at run time: one row per row of cmake/variants.cmake, narrowest first. Rows that this build leaves
 * out are here, too: CGT_DISABLE_CPU knows their names on every machine. */
#include "dispatch/variant.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Whether the CPU has, and the system saves, what a row's compiler flags require. */
static bool any_cpu(void) { return true; }
#ifdef CGT_HAVE_SSE
static bool cpu_has_sse(void) { return __builtin_cpu_supports("sse4.1"); }
#endif
#ifdef CGT_HAVE_AVX2
static bool cpu_has_avx2(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi");
}
#endif
#ifdef CGT_HAVE_AVX512
static bool cpu_has_avx512(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
           __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
#endif

/* Defined by src/kernel/entry/kernel_table.c, compiled once per row. */
extern const cgt_kernel cgt_kernel_portable, cgt_kernel_sse, cgt_kernel_neon, cgt_kernel_wasm, cgt_kernel_avx2,
    cgt_kernel_avx512;

static const struct row {
    const char *name;
    const cgt_kernel *kernel; /* NULL: not in this build */
    bool (*runs)(void);
} table[] = {
#ifdef CGT_HAVE_PORTABLE
    {"portable", &cgt_kernel_portable, any_cpu},
#else
    {"portable", NULL, any_cpu},
#endif
#ifdef CGT_HAVE_SSE
    {"sse", &cgt_kernel_sse, cpu_has_sse},
#else
    {"sse", NULL, any_cpu},
#endif
#ifdef CGT_HAVE_NEON
    {"neon", &cgt_kernel_neon, any_cpu}, /* part of the architecture */
#else
    {"neon", NULL, any_cpu},
#endif
#ifdef CGT_HAVE_WASM
    {"wasm", &cgt_kernel_wasm, any_cpu}, /* a module with vectors does not load where they are missing */
#else
    {"wasm", NULL, any_cpu},
#endif
#ifdef CGT_HAVE_AVX2
    {"avx2", &cgt_kernel_avx2, cpu_has_avx2},
#else
    {"avx2", NULL, any_cpu},
#endif
#ifdef CGT_HAVE_AVX512
    {"avx512", &cgt_kernel_avx512, cpu_has_avx512},
#else
    {"avx512", NULL, any_cpu},
#endif
};

#define ROWS (sizeof table / sizeof table[0])

static const char *const names[ROWS + 1] = {
#ifdef CGT_HAVE_PORTABLE
    "portable",
#endif
#ifdef CGT_HAVE_SSE
    "sse",
#endif
#ifdef CGT_HAVE_NEON
    "neon",
#endif
#ifdef CGT_HAVE_WASM
    "wasm",
#endif
#ifdef CGT_HAVE_AVX2
    "avx2",
#endif
#ifdef CGT_HAVE_AVX512
    "avx512",
#endif
    NULL,
};

const char *const *cgt_get_variant_names(void) { return names; }

/* Reads CGT_DISABLE_CPU each time: contexts are created rarely, and nothing global is kept. Row i is bit i. False where
 * a name is unknown: a test must not believe in a mask that is not there. */
static bool read_disabled_rows(unsigned *disabled, char unknown[CGT_VARIANT_NAME_BYTES])
{
    const char *list = getenv("CGT_DISABLE_CPU");
    *disabled = 0;
    while (list && *list) {
        const size_t length = strcspn(list, ",");
        size_t i = 0;
        while (i < ROWS && (strlen(table[i].name) != length || strncmp(table[i].name, list, length) != 0))
            i++;
        if (i < ROWS)
            *disabled |= 1u << i;
        else if (length) {
            const size_t kept = length < CGT_VARIANT_NAME_BYTES ? length : CGT_VARIANT_NAME_BYTES - 1;
            memcpy(unknown, list, kept);
            unknown[kept] = 0;
            return false;
        }
        list += length + (list[length] == ',');
    }
    return true;
}

const cgt_kernel *cgt_variant_find(const char *name, cgt_variant_state *state, char unknown[CGT_VARIANT_NAME_BYTES])
{
    unsigned disabled;
    if (!read_disabled_rows(&disabled, unknown)) {
        *state = CGT_VARIANT_BAD_LIST;
        return NULL;
    }
    *state = CGT_VARIANT_ABSENT;
    for (size_t i = ROWS; i-- > 0;) {
        if (!table[i].kernel || (name && strcmp(name, table[i].name) != 0))
            continue;
        if (disabled >> i & 1)
            *state = CGT_VARIANT_DISABLED;
        else if (!table[i].runs())
            *state = CGT_VARIANT_UNSUPPORTED;
        else {
            *state = CGT_VARIANT_RUNS;
            return table[i].kernel;
        }
    }
    return NULL;
}

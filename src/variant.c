/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The variant table as the library sees it: one row per row of cmake/variants.cmake, narrowest first. */
#include "variant.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* CPU features that a row may need, by the names that CGT_DISABLE_CPU takes. */
typedef enum feature { FEATURE_NONE, FEATURE_SSE41, FEATURE_NEON, FEATURES } feature;
static const char *const feature_name[FEATURES] = {"", "sse4.1", "neon"};

static bool cpu_has(feature f)
{
    switch (f) {
    case FEATURE_NONE: return true;
#if defined(__x86_64__)
    case FEATURE_SSE41: return __builtin_cpu_supports("sse4.1");
#endif
#if defined(__aarch64__)
    case FEATURE_NEON: return true; /* part of the architecture */
#endif
    default: return false;
    }
}

/* Defined by src/kernel/kernel_table.c, compiled once per row. */
extern const cgt_kernel cgt_kernel_portable, cgt_kernel_sse, cgt_kernel_neon;

static const struct row {
    const cgt_kernel *kernel;
    feature needs;
} table[] = {
#ifdef CGT_HAVE_PORTABLE
    {&cgt_kernel_portable, FEATURE_NONE},
#endif
#ifdef CGT_HAVE_SSE
    {&cgt_kernel_sse, FEATURE_SSE41},
#endif
#ifdef CGT_HAVE_NEON
    {&cgt_kernel_neon, FEATURE_NEON},
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
    NULL,
};

const char *const *cgt_variants(void) { return names; }

static void disable_unknown(const char *name, size_t length)
{
    fprintf(stderr, "libcgt: CGT_DISABLE_CPU: no feature \"%.*s\"; there are:", (int)length, name);
    for (int f = 1; f < FEATURES; f++)
        fprintf(stderr, " %s", feature_name[f]);
    fprintf(stderr, "\n");
    abort();
}

/* Reads CGT_DISABLE_CPU each time: a context is made rarely, and nothing global is kept. */
static bool is_disabled(feature wanted)
{
    const char *list = getenv("CGT_DISABLE_CPU");
    bool disabled = false;
    while (list && *list) {
        const size_t length = strcspn(list, ",");
        int f = 1;
        while (f < FEATURES && (strlen(feature_name[f]) != length || strncmp(feature_name[f], list, length) != 0))
            f++;
        if (f == FEATURES && length)
            disable_unknown(list, length);
        disabled |= f == (int)wanted;
        list += length + (list[length] == ',');
    }
    return disabled;
}

const cgt_kernel *cgt_variant_find(const char *name, bool *known)
{
    const cgt_kernel *found = NULL;
    *known = name == NULL;
    for (size_t i = 0; i < ROWS; i++) {
        if (name && strcmp(name, table[i].kernel->name) != 0)
            continue;
        *known = true;
        if (!is_disabled(table[i].needs) && cpu_has(table[i].needs))
            found = table[i].kernel;
    }
    return found;
}

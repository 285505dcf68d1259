/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * For an SPU: the functions of spux_calls.h, in its order. */
#include "spu/serve.h"
#include "spu/spux_calls.h"

_Static_assert(sizeof(spux_record) == 16 * SPUX_QUADS, "a record has no padding");

#define SERVE(name, bits)                                                                                              \
    static void serve_##name(vec_uint4 *record) { call_##name((spux_record *)record); }
SPUX_CALLS(SERVE)

#define SERVE_NAME(name, bits) serve_##name,
static serve_call *const calls[] = {SPUX_CALLS(SERVE_NAME)};

int main(void) { return serve(calls, sizeof calls / sizeof calls[0], SPUX_QUADS); }

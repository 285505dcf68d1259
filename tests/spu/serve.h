/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The main loop of a program of an SPU that works for a test (exchange.h). */
#ifndef SERVE_H
#define SERVE_H

#include <stdint.h>

#include "spu_intrinsics.h"

#include "spu/exchange.h"

typedef void serve_call(vec_uint4 *record);

static vec_uint4 serve_area[EXCHANGE_QUADS];

/* quads: of a record. */
static inline int serve(serve_call *const calls[], uint32_t functions, uint32_t quads)
{
    spu_writech(EXCHANGE_OUTBOUND, (uint32_t)serve_area);
    for (;;) {
        const uint32_t number = spu_readch(EXCHANGE_INBOUND);
        if (number >= functions)
            return number != EXCHANGE_END;
        const uint32_t count = spu_readch(EXCHANGE_INBOUND);
        for (uint32_t i = 0; i < count; i++)
            calls[number](serve_area + i * quads);
    }
}

#endif

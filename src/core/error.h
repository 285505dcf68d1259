/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The message of a failure. */
#ifndef CGT_ERROR_H
#define CGT_ERROR_H

#include <cgt/cgt.h>

#define CGT_MESSAGE_BYTES 256

/* Keeps the message in the context, logs it, returns the result. */
cgt_result cgt_fail(cgt_context *context, cgt_result result, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif

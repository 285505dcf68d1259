/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The message of a failure. */
#ifndef CGT_ERROR_H
#define CGT_ERROR_H

#include <stdio.h>

#include <cgt/cgt.h>

#define CGT_MESSAGE_BYTES 256

/* MinGW has two kinds of printf; its stdio.h says which one this is. */
#ifdef __MINGW_PRINTF_FORMAT
#define CGT_PRINTF(format_at, arguments_at) __attribute__((format(__MINGW_PRINTF_FORMAT, format_at, arguments_at)))
#else
#define CGT_PRINTF(format_at, arguments_at) __attribute__((format(printf, format_at, arguments_at)))
#endif

/* Keeps the message in the context, logs it, returns the result. */
cgt_result cgt_fail(cgt_context *context, cgt_result result, const char *format, ...) CGT_PRINTF(3, 4);

#endif

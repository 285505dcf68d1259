/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Results as sentences, and the message of the last failure. */
#include "core/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "core/context.h"

const char *cgt_get_result_string(cgt_result result)
{
    switch (result) {
    case CGT_OK: return "no error";
    case CGT_ERROR_INVALID_ARGUMENT: return "an argument is outside its range";
    case CGT_ERROR_OUT_OF_MEMORY: return "out of memory";
    case CGT_ERROR_TOO_LARGE: return "a size is beyond its limit";
    case CGT_ERROR_NOT_COMMITTED: return "the scene is not committed";
    case CGT_ERROR_UNSUPPORTED: return "not supported by this CPU or this build";
    case CGT_ERROR_THREADS: return "the system refused a thread or a lock";
    case CGT_ERROR_STOPPED: return "stopped by the visitor";
    case CGT_ERROR_FILE: return "a file cannot be read or written";
    case CGT_END: return "no further frame";
    }
    return "unknown result";
}

cgt_result cgt_fail(cgt_context *context, cgt_result result, const char *format, ...)
{
    char text[CGT_MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    pthread_mutex_lock(&context->message_lock);
    memcpy(context->message, text, sizeof text);
    pthread_mutex_unlock(&context->message_lock);
    if (context->log.write)
        context->log.write(context->log.user, CGT_LOG_LEVEL_ERROR, text);
    return result;
}

size_t cgt_context_get_error_message(const cgt_context *context, char *text, size_t size)
{
    cgt_context *c = (cgt_context *)context; /* the lock alone changes */
    if (!c) {
        static const char none[] = "out of memory for a context";
        if (text && size)
            snprintf(text, size, "%s", none);
        return sizeof none - 1;
    }
    pthread_mutex_lock(&c->message_lock);
    const size_t length = strlen(c->message);
    if (text && size)
        snprintf(text, size, "%s", c->message);
    pthread_mutex_unlock(&c->message_lock);
    return length;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What readers say: errors, which end the reading, and warnings, which tell how a doubtful file was read. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/trajectory_internal.h"
#include "trajectory/atoms/trajectory_topology.h"

#include <inttypes.h>
#include <stdarg.h>
#include <string.h>

/* A long path loses its front: its end, the line and the sentence tell more. */
static int write_place(char *text, size_t size, const char *path, uint64_t line)
{
    const size_t limit = 600;
    const size_t length = strlen(path);
    const char *dots = length > limit ? "..." : "";
    const char *tail = length > limit ? path + (length - limit) : path;
    if (line > 0)
        return snprintf(text, size, "%s%s:%" PRIu64 ": ", dots, tail, line);
    return snprintf(text, size, "%s%s: ", dots, tail);
}

int trajectory_fail(cgt_trajectory *t, uint64_t line, const char *format, ...)
{
    static const char memory[] = "not enough memory"; /* so all sentences about it begin */
    const int used = write_place(t->message, sizeof t->message, t->path, line);
    t->error = CGT_ERROR_FILE;
    if (used >= 0 && (size_t)used < sizeof t->message) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(t->message + used, sizeof t->message - (size_t)used, format, arguments);
        va_end(arguments);
        if (strncmp(t->message + used, memory, sizeof memory - 1) == 0)
            t->error = CGT_ERROR_OUT_OF_MEMORY;
    }
    t->failed = 1;
    return -1;
}

int trajectory_refuse(cgt_trajectory *t, const char *path, cgt_result result, const char *reason)
{
    const int used = write_place(t->message, sizeof t->message, path, 0);
    if (used >= 0 && (size_t)used < sizeof t->message)
        snprintf(t->message + used, sizeof t->message - (size_t)used, "%s", reason);
    t->error = result;
    return -1;
}

void trajectory_warn(cgt_trajectory *t, trajectory_doubt doubt, uint64_t line, const char *format, ...)
{
    const unsigned bit = 1u << doubt;
    if (t->doubts & bit)
        return;
    t->doubts |= bit;
    char *const text = t->warning[doubt];
    const int used = write_place(text, sizeof t->warning[doubt], t->path, line);
    if (used >= 0 && (size_t)used < sizeof t->warning[doubt]) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(text + used, sizeof t->warning[doubt] - (size_t)used, format, arguments);
        va_end(arguments);
    }
}

void trajectory_warn_open(cgt_trajectory *t, uint64_t line)
{
    trajectory_warn(t, DOUBT_OPEN_LINE, line,
                    "the last line has no line feed: if the file is cut off there, its last value is wrong");
}

void trajectory_warn_names(cgt_trajectory *t, uint64_t line)
{
    trajectory_warn(t, DOUBT_NAMES, line, "more than %d different names: the others share one type", NAMES_MOST);
}

const char *cgt_trajectory_take_warning(cgt_trajectory *t)
{
    for (unsigned doubt = 0; t != NULL && doubt < DOUBTS; doubt++) {
        const unsigned bit = 1u << doubt;
        if ((t->doubts & bit) && !(t->told & bit)) {
            t->told |= bit;
            return t->warning[doubt];
        }
    }
    return t != NULL && t->topology != NULL ? cgt_trajectory_take_warning(t->topology->file) : NULL;
}

size_t cgt_trajectory_get_error_message(const cgt_trajectory *t, char *text, size_t size)
{
    const char *const message = t != NULL ? t->message : "not enough memory for a trajectory";
    if (text != NULL && size > 0)
        snprintf(text, size, "%s", message);
    return strlen(message);
}

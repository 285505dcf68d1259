/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Threads of the page, for tracing and shading alike. They are made once: a browser starts a thread only when the code
 * that asks for it has returned, so none may be made for each call, as the picture library does of its own. */
#ifndef WEB_TASKS_H
#define WEB_TASKS_H

#include <cgt/cgt.h>

/* Starts threads - 1 of them, at most 63; returns how many work, the caller included: fewer where the browser refuses.
 * Once. */
uint32_t web_tasks_start(uint32_t threads);

/* cgt_task_runner.run; one call at a time. user: not used. */
void web_tasks_run(void *user, cgt_task *task, void *argument, uint32_t count);

#endif

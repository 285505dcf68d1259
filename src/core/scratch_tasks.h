/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tasks that need scratch memory. */
#ifndef CGT_SCRATCH_TASKS_H
#define CGT_SCRATCH_TASKS_H

#include "core/context.h"
#include "core/scratch.h"

typedef void cgt_scratch_task(void *argument, uint32_t index, cgt_scratch *scratch);

/* Runs tasks as cgt_run_tasks does, each with a block of its own. Where memory does not suffice for all threads, fewer
 * tasks run at once. OUT_OF_MEMORY, with a message, where there is not even one block: then no task has run. */
cgt_result cgt_run_scratch_tasks(cgt_context *context, cgt_scratch_task *task, void *argument, uint32_t count);

/* Takes up to `count` blocks, at least one, as a list; NULL with a message where there is none. */
cgt_scratch *cgt_scratch_borrow(cgt_context *context, uint32_t count);
/* Gives a list of blocks back; NULL is ignored. */
void cgt_scratch_give_back(cgt_context *context, cgt_scratch *list);

/* Memory of a whole call: one buffer that the context keeps, or none yet where another call has it. Give it back at the
 * end, grown or not; the context keeps the larger one. */
cgt_buffer cgt_buffer_borrow(cgt_context *context);
void cgt_buffer_give_back(cgt_context *context, cgt_buffer buffer);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What processes tell each other; inside render_share*.c. */
#ifndef SHARE_MESSAGES_H
#define SHARE_MESSAGES_H

#include <sys/types.h>

#include "common/program.h"
#include "render/share/render_share.h"

enum { TAG_CONTROL = 1, TAG_GRANT, TAG_AGREE, TAG_AGREED, TAG_PICTURE, TAG_RESULT };

typedef enum share_event { EVENT_ASK, EVENT_DONE, EVENT_END, EVENT_FAILED, EVENT_TEXT, EVENT_LEFT } share_event;

/* To rank 0. */
typedef struct share_message {
    share_event event;
    uint64_t chosen;               /* of EVENT_END */
    int wrong;                     /* of EVENT_LEFT: the process will end with an error */
    share_done done;               /* of EVENT_DONE */
    char text[PROGRAM_ERROR_SIZE]; /* of EVENT_TEXT */
} share_message;

typedef struct share_status {
    int wrong;
    pid_t first; /* rank 0's process, and its machine */
    char host[256];
    survey survey;
} share_status;

/* A link_give_up for a render_share: a signal has come. */
int share_stopped(void *share);

int share_send_message(render_share *share, const share_message *message);

/* Waits under the lock for a change, or a tenth of a second, since signals wake nobody. */
void share_wait_for_change(render_share *share);

/* Rank 0's thread, which answers the others until all have left. */
void *share_serve(void *share);

#endif

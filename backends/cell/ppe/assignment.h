/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which SPE traces which strip (thesis, section 7.5). */
#ifndef CGT_ASSIGNMENT_H
#define CGT_ASSIGNMENT_H

#include "cell/image/control_block.h"
#include "cell/machine/machine.h"

typedef enum cgt_assignment {
    CGT_ASSIGN_INTERLEAVED = 0, /* SPE i of n: strips i, i + n, ... */
    CGT_ASSIGN_STATIC,          /* contiguous parts of equal size, as in the thesis */
    CGT_ASSIGN_DYNAMIC,         /* the next strip to whoever begins its last one, by mailbox */
    CGT_ASSIGN_HYBRID           /* a share interleaved, the rest by mailbox */
} cgt_assignment;

#define CGT_ASSIGNMENTS 4
#define CGT_HYBRID_SHARE 60 /* percent */

typedef struct cgt_assigner {
    uint32_t next, strips;           /* the strips that are left for mailboxes: next to strips - 1 */
    uint32_t fixed;                  /* the first of them */
    uint32_t messages[CGT_MAX_SPES]; /* sent and received */
} cgt_assigner;

/* Sets first, strips, step, and the mailbox flag of each of `spes` blocks. share: percent, of HYBRID alone. */
void cgt_assign(cgt_assignment how, uint32_t share, uint32_t strips, uint32_t spes, cgt_control_block *block,
                cgt_assigner *assigner);

/* Sends an SPE its next strip, or the end. False: its mailbox is full, which the protocol excludes. */
bool cgt_assigner_send(cgt_assigner *assigner, cgt_cell *cell, unsigned spe);

#endif

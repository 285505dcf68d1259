/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Assignment of strips. */
#include "cell/ppe/assignment.h"

void cgt_assign(cgt_assignment how, uint32_t share, uint32_t strips, uint32_t spes, cgt_control_block *block,
                cgt_assigner *assigner)
{
    const uint32_t fixed = how == CGT_ASSIGN_DYNAMIC  ? 0
                           : how == CGT_ASSIGN_HYBRID ? (uint32_t)((uint64_t)strips * share / 100)
                                                      : strips;
    *assigner = (cgt_assigner){.next = fixed, .strips = strips, .fixed = fixed};
    for (uint32_t i = 0; i < spes; i++) {
        cgt_control_block *const b = &block[i];
        const uint32_t low = (uint32_t)((uint64_t)fixed * i / spes),
                       high = (uint32_t)((uint64_t)fixed * (i + 1) / spes);
        b->first = how == CGT_ASSIGN_STATIC ? low : i;
        b->step = how == CGT_ASSIGN_STATIC ? 1 : spes;
        b->strips = how == CGT_ASSIGN_STATIC ? high - low : i < fixed ? (fixed - i - 1) / spes + 1 : 0;
        if (how == CGT_ASSIGN_DYNAMIC || how == CGT_ASSIGN_HYBRID)
            b->flags |= CGT_CONTROL_MAILBOX;
    }
}

bool cgt_assigner_send(cgt_assigner *assigner, cgt_cell *cell, unsigned spe)
{
    const uint32_t strip = assigner->next < assigner->strips ? assigner->next++ : CGT_STRIP_END;
    assigner->messages[spe]++;
    return cgt_cell_send_mailbox(cell, spe, strip);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * DMA lists. The elements lie in local store: two words, the first with the stall-and-notify bit highest and the size
 * in its lowest 15 bits, the second the lower half of the effective address. They are taken up to the next element that
 * notifies, so that a program may write those behind it while the list is stalled. Data of consecutive elements lies at
 * consecutive quadwords of local store; the lowest four bits of each address there are those of the effective one. */
#include "cell/mfc/mfc_internal.h"
#include "spu_mfcio.h"

static cgt_mfc_element load_element(const cgt_mfc *mfc, uint32_t lsa)
{
    const uint32_t first = cgt_mfc_load32(mfc, lsa);
    return (cgt_mfc_element){.notify = first >> 31 != 0, .size = first & 0x7fff, .eal = cgt_mfc_load32(mfc, lsa + 4)};
}

/* where the data of an element lies, after what lay before it */
static uint32_t element_lsa(uint32_t lsa, const cgt_mfc_element *e) { return (lsa & ~15u) | (e->eal & 15u); }

static uint32_t next_lsa(uint32_t lsa, const cgt_mfc_element *e) { return (lsa & ~15u) + ((e->size + 15u) & ~15u); }

bool cgt_mfc_begin_list(cgt_mfc *mfc, cgt_mfc_command *c, uint64_t *bus_bytes)
{
    uint32_t lsa = c->list_lsa;
    cgt_mfc_element e = {.notify = false};
    *bus_bytes = 0;
    /* behind a last element that notified there is nothing */
    for (c->end = c->done; c->end < c->size && !e.notify; c->end += 8) {
        e = load_element(mfc, c->list + c->end);
        if (!cgt_mfc_check_element(mfc, c, &e, element_lsa(lsa, &e)))
            return false;
        *bus_bytes += e.size < mfc->timing.least_bytes ? mfc->timing.least_bytes : e.size;
        lsa = next_lsa(lsa, &e);
    }
    return true;
}

/* The elements are read and checked once more: the program may have changed them since. */
bool cgt_mfc_end_list(cgt_mfc *mfc, cgt_mfc_command *c, cgt_mfc_record *record)
{
    const bool puts = c->operation->kind == CGT_MFC_PUT;
    const uint32_t end = c->end;
    bool notifies = false;
    c->end = c->done;
    if (c->done < end)
        record->ea = (c->ea >> 32 << 32) | load_element(mfc, c->list + c->done).eal;
    record->lsa = c->list_lsa;
    while (c->done < end) {
        const cgt_mfc_element e = load_element(mfc, c->list + c->done);
        const uint32_t lsa = element_lsa(c->list_lsa, &e);
        if (!cgt_mfc_check_element(mfc, c, &e, lsa))
            return false;
        if (e.size > 0)
            cgt_mfc_move(mfc, puts, lsa, (c->ea >> 32 << 32) | e.eal, e.size);
        c->list_lsa = next_lsa(c->list_lsa, &e);
        record->bytes += e.size;
        record->elements++;
        notifies = e.notify;
        c->done += 8;
        c->end = c->done;
    }
    mfc->counts.elements += record->elements;
    return notifies;
}

cgt_channel_status cgt_mfc_acknowledge_list(cgt_mfc *mfc, uint32_t tag)
{
    bool any = false;
    for (unsigned i = 0; i < mfc->queued; i++) {
        cgt_mfc_command *const c = &mfc->queue[i];
        if (c->state == CGT_MFC_STALLS && c->tag == tag) {
            c->state = CGT_MFC_WAITS;
            any = true;
        }
    }
    if (!any) {
        cgt_mfc_fail(mfc, CGT_RULE_LIST_ACKNOWLEDGE, "MFC_WrListStallAck(tag %u): no list of this tag has stalled",
                     tag);
        return CGT_CHANNEL_ERROR;
    }
    cgt_mfc_start_commands(mfc);
    return CGT_CHANNEL_DONE;
}

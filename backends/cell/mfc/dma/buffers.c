/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Buffers that are used again too early. A put sends what lies in local store when it is carried out, which may be any
 * time up to the wait for its tag. A program that writes there before has an error that most runs do not show, since
 * most puts end soon. Here a sum of the bytes is taken when the put is given, and compared when the program learns that
 * its tag is done, and when it gives another put of some of these bytes. A get into them needs a fence or a barrier
 * between.
 *
 * Puts by lists are not watched, nor is what a program reads before its get has ended: it finds the old bytes. */
#include <inttypes.h>
#include <string.h>

#include "cell/mfc/mfc_internal.h"

void cgt_mfc_watch_buffers(cgt_mfc *mfc) { mfc->watches = true; }

static uint64_t sum_bytes(const cgt_mfc *mfc, uint32_t lsa, uint32_t size)
{
    const uint8_t *const bytes = mfc->store.bytes + lsa;
    uint64_t sum = UINT64_C(0xcbf29ce484222325), word;
    uint32_t i = 0;
    for (; i + sizeof word <= size; i += sizeof word) {
        memcpy(&word, bytes + i, sizeof word);
        sum = (sum ^ word) * UINT64_C(0x9e3779b97f4a7c15);
        sum ^= sum >> 32;
    }
    for (; i < size; i++)
        sum = (sum ^ bytes[i]) * UINT64_C(0x100000001b3);
    return sum;
}

static bool overlap(const cgt_mfc_command *a, const cgt_mfc_command *b)
{
    return a->lsa < b->lsa + b->size && b->lsa < a->lsa + a->size;
}

static void remove_source(cgt_mfc *mfc, unsigned at)
{
    mfc->sources--;
    memmove(&mfc->source[at], &mfc->source[at + 1], (mfc->sources - at) * sizeof mfc->source[0]);
}

/* Whether the bytes are still those that the put was given. */
static bool check_source(cgt_mfc *mfc, const cgt_mfc_source *s)
{
    if (sum_bytes(mfc, s->command.lsa, s->command.size) == s->sum)
        return true;
    cgt_mfc_fail_command(mfc, &s->command, CGT_RULE_BUFFER,
                         "the program wrote to these bytes before it had waited for tag %" PRIu32, s->command.tag);
    return false;
}

/* ---- commands ---- */

static bool is_watched_put(const cgt_mfc_command *c)
{
    return c->operation->kind == CGT_MFC_PUT && !c->operation->list;
}

static bool add_source(cgt_mfc *mfc, const cgt_mfc_command *c)
{
    for (unsigned i = 0; i < mfc->sources; i++)
        if (overlap(&mfc->source[i].command, c) && !check_source(mfc, &mfc->source[i]))
            return false;
    if (mfc->sources == CGT_MFC_SOURCES)
        remove_source(mfc, 0);
    mfc->source[mfc->sources++] = (cgt_mfc_source){.command = *c, .sum = sum_bytes(mfc, c->lsa, c->size)};
    return true;
}

/* A get into bytes of a put that may still be under way. */
static bool check_get(cgt_mfc *mfc, const cgt_mfc_command *c)
{
    const bool fenced = c->operation->fence || c->operation->barrier;
    for (unsigned i = 0; i < mfc->sources;) {
        const cgt_mfc_source *const s = &mfc->source[i];
        const bool same = s->command.tag == c->tag;
        if (!overlap(&s->command, c)) {
            i++;
        } else if (s->ordered || (same && (fenced || s->ordered_in_tag))) {
            remove_source(mfc, i); /* what lies there changes in its turn */
        } else {
            cgt_mfc_fail_command(mfc, c, CGT_RULE_BUFFER,
                                 "%s of tag %" PRIu32 " may still send these bytes: no wait and no fence between",
                                 s->command.operation->name, s->command.tag);
            return false;
        }
    }
    return true;
}

/* What orders all that was given before it and all after, of its tag or of any. */
static void note_order(cgt_mfc *mfc, const cgt_mfc_command *c)
{
    const cgt_mfc_kind kind = c->operation->kind;
    for (unsigned i = 0; i < mfc->sources; i++) {
        cgt_mfc_source *const s = &mfc->source[i];
        s->ordered |= kind == CGT_MFC_BARRIER;
        s->ordered_in_tag |= s->command.tag == c->tag && (kind == CGT_MFC_ORDER || c->operation->barrier);
    }
}

bool cgt_mfc_watch_command(cgt_mfc *mfc, const cgt_mfc_command *c)
{
    if (!mfc->watches)
        return true;
    note_order(mfc, c);
    if (is_watched_put(c))
        return add_source(mfc, c);
    return c->operation->kind != CGT_MFC_GET || c->operation->list || check_get(mfc, c);
}

/* ---- waits ---- */

void cgt_mfc_watch_tags(cgt_mfc *mfc, uint32_t idle)
{
    for (unsigned i = 0; i < mfc->sources; i++)
        mfc->source[i].done |= idle >> mfc->source[i].command.tag & 1;
}

bool cgt_mfc_watch_status(cgt_mfc *mfc)
{
    for (unsigned i = 0; i < mfc->sources;) {
        if (!mfc->source[i].done) {
            i++;
            continue;
        }
        if (!check_source(mfc, &mfc->source[i]))
            return false;
        remove_source(mfc, i);
    }
    return true;
}

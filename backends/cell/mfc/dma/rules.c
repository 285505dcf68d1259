/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The rules of DMA, each with its name and its sentence. A message is the rule's name, the command with its arguments,
 * and what is wrong with them; addresses in local store are offsets, so that a native and a simulated program that
 * break the same rule get the same message. */
#include <inttypes.h>
#include <stdarg.h>
#include <string.h>

#include "cell/mfc/mfc_internal.h"

#define MAX_TRANSFER 16384u
#define MAX_LIST 16384u /* bytes: 2,048 elements of 8 */

const char *cgt_mfc_rule_name(cgt_mfc_rule rule)
{
    static const char *const name[CGT_RULES] = {
        [CGT_RULE_NONE] = "none",
        [CGT_RULE_COMMAND] = "command",
        [CGT_RULE_TAG] = "tag",
        [CGT_RULE_SIZE] = "size",
        [CGT_RULE_ALIGNMENT] = "alignment",
        [CGT_RULE_LOW_BITS] = "low bits",
        [CGT_RULE_LOCAL_STORE] = "local store",
        [CGT_RULE_ADDRESS] = "address",
        [CGT_RULE_BOUNDS] = "bounds",
        [CGT_RULE_READ_ONLY] = "read only",
        [CGT_RULE_UNIT] = "unit",
        [CGT_RULE_REGISTER] = "register",
        [CGT_RULE_LIST_SIZE] = "list size",
        [CGT_RULE_LIST_ADDRESS] = "list address",
        [CGT_RULE_LIST_CROSSING] = "list crossing",
        [CGT_RULE_LIST_ACKNOWLEDGE] = "list acknowledge",
        [CGT_RULE_TAG_UPDATE] = "tag update",
        [CGT_RULE_TAG_STATUS] = "tag status",
        [CGT_RULE_ATOMIC_STATUS] = "atomic status",
        [CGT_RULE_CHANNEL] = "channel",
        [CGT_RULE_HALT] = "halt",
        [CGT_RULE_BUFFER] = "buffer",
        [CGT_RULE_WORD] = "word",
        [CGT_RULE_DEADLOCK] = "deadlock",
    };
    return rule < CGT_RULES ? name[rule] : "unknown";
}

/* ---- messages ---- */

void cgt_mfc_fail(cgt_mfc *mfc, cgt_mfc_rule rule, const char *format, ...)
{
    if (mfc->rule != CGT_RULE_NONE)
        return; /* the first reason counts */
    mfc->rule = rule;
    mfc->changes++;
    const int used = snprintf(mfc->message, sizeof mfc->message, "%s: ", cgt_mfc_rule_name(rule));
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(mfc->message + used, sizeof mfc->message - (size_t)used, format, arguments);
    va_end(arguments);
}

void cgt_mfc_fail_command(cgt_mfc *mfc, const cgt_mfc_command *c, cgt_mfc_rule rule, const char *format, ...)
{
    char reason[128];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    if (c->operation->list)
        cgt_mfc_fail(mfc, rule,
                     "%s(lsa 0x%" PRIx32 ", eah 0x%" PRIx32 ", list 0x%" PRIx32 ", size %" PRIu32 ", tag %" PRIu32
                     "): %s",
                     c->operation->name, c->lsa, (uint32_t)(c->ea >> 32), c->list, c->size, c->tag, reason);
    else
        cgt_mfc_fail(mfc, rule, "%s(lsa 0x%" PRIx32 ", ea 0x%" PRIx64 ", size %" PRIu32 ", tag %" PRIu32 "): %s",
                     c->operation->name, c->lsa, c->ea, c->size, c->tag, reason);
}

/* ---- one transfer, of a command or of an element ---- */

/* the arguments of a transfer, and where a message says that they stand */
typedef struct transfer {
    const cgt_mfc_command *command;
    uint32_t lsa, size;
    uint64_t ea;
    bool writes; /* memory */
    char where[40];
} transfer;

static bool size_is_valid(uint32_t size)
{
    return size == 1 || size == 2 || size == 4 || size == 8 || (size % 16 == 0 && size > 0 && size <= MAX_TRANSFER);
}

static bool check_size(cgt_mfc *mfc, const transfer *t)
{
    if (!size_is_valid(t->size)) {
        cgt_mfc_fail_command(mfc, t->command, CGT_RULE_SIZE,
                             "%s%" PRIu32 " bytes are none of 1, 2, 4, 8, 16 n up to %u", t->where, t->size,
                             MAX_TRANSFER);
        return false;
    }
    return true;
}

static bool check_addresses(cgt_mfc *mfc, const transfer *t, bool uses_store)
{
    const uint32_t alignment = t->size < 16 ? t->size : 16;
    if ((uses_store && t->lsa % alignment != 0) || t->ea % alignment != 0) {
        cgt_mfc_fail_command(mfc, t->command, CGT_RULE_ALIGNMENT,
                             "%slsa 0x%" PRIx32 " and ea 0x%" PRIx64 " must be multiples of %" PRIu32, t->where, t->lsa,
                             t->ea, alignment);
        return false;
    }
    if (uses_store && t->lsa % 16 != t->ea % 16) {
        cgt_mfc_fail_command(mfc, t->command, CGT_RULE_LOW_BITS,
                             "%sthe lowest four bits of lsa 0x%" PRIx32 " and ea 0x%" PRIx64 " differ", t->where,
                             t->lsa, t->ea);
        return false;
    }
    return true;
}

static bool check_store(cgt_mfc *mfc, const transfer *t)
{
    if (t->lsa > mfc->store.size || t->size > mfc->store.size - t->lsa) {
        cgt_mfc_fail_command(mfc, t->command, CGT_RULE_LOCAL_STORE,
                             "%slsa 0x%" PRIx32 " + %" PRIu32 " is beyond the local store's 0x%" PRIx32, t->where,
                             t->lsa, t->size, mfc->store.size);
        return false;
    }
    return true;
}

static bool check_region(cgt_mfc *mfc, const transfer *t)
{
    const cgt_ea_region *const region = cgt_ea_map_find(mfc->map, t->ea);
    const cgt_mfc_command *const c = t->command;
    const bool signals = c->operation->kind == CGT_MFC_SIGNAL;
    if (!region) {
        cgt_mfc_fail_command(mfc, c, CGT_RULE_ADDRESS, "%sno memory at ea 0x%" PRIx64, t->where, t->ea);
        return false;
    }
    if (t->size > region->bytes - (t->ea - region->ea)) {
        cgt_mfc_fail_command(mfc, c, CGT_RULE_BOUNDS,
                             "%sea 0x%" PRIx64 " + %" PRIu32 " is beyond the region of 0x%" PRIx64 " + %" PRIu64,
                             t->where, t->ea, t->size, region->ea, region->bytes);
        return false;
    }
    if (signals != (region->kind == CGT_EA_SIGNAL)) {
        cgt_mfc_fail_command(mfc, c, CGT_RULE_REGISTER, "%sea 0x%" PRIx64 " is %s signal register", t->where, t->ea,
                             signals ? "no" : "a");
        return false;
    }
    if (t->writes && !signals && !region->writable) {
        cgt_mfc_fail_command(mfc, c, CGT_RULE_READ_ONLY, "%sthe region of 0x%" PRIx64 " + %" PRIu64 " is not writable",
                             t->where, region->ea, region->bytes);
        return false;
    }
    if (region->kind == CGT_EA_MEMORY && t->size < region->unit) {
        cgt_mfc_fail_command(mfc, c, CGT_RULE_UNIT,
                             "%s%" PRIu32 " bytes are a part of an element: the region of 0x%" PRIx64 " has %" PRIu32
                             " bytes an element",
                             t->where, t->size, region->ea, region->unit);
        return false;
    }
    return true;
}

/* ---- commands ---- */

static bool check_list(cgt_mfc *mfc, const cgt_mfc_command *c)
{
    if (c->size == 0 || c->size > MAX_LIST || c->size % 8 != 0) {
        cgt_mfc_fail_command(mfc, c, CGT_RULE_LIST_SIZE, "a list of %" PRIu32 " bytes is no multiple of 8 from 8 to %u",
                             c->size, MAX_LIST);
        return false;
    }
    if (c->list % 8 != 0 || c->list > mfc->store.size || c->size > mfc->store.size - c->list) {
        cgt_mfc_fail_command(mfc, c, CGT_RULE_LIST_ADDRESS,
                             "a list at 0x%" PRIx32 " + %" PRIu32 " is not aligned to 8 or beyond the local store",
                             c->list, c->size);
        return false;
    }
    return true;
}

static bool check_line(cgt_mfc *mfc, const cgt_mfc_command *c)
{
    if (c->lsa % CGT_LINE_BYTES != 0 || c->ea % CGT_LINE_BYTES != 0) {
        cgt_mfc_fail_command(mfc, c, CGT_RULE_ALIGNMENT,
                             "lsa 0x%" PRIx32 " and ea 0x%" PRIx64 " of a line must be multiples of %d", c->lsa, c->ea,
                             CGT_LINE_BYTES);
        return false;
    }
    return true;
}

static bool check_transfer(cgt_mfc *mfc, const cgt_mfc_command *c)
{
    transfer t = {.command = c, .lsa = c->lsa, .size = c->size, .ea = c->ea};
    const cgt_mfc_kind kind = c->operation->kind;
    const bool line = kind == CGT_MFC_LINE || kind == CGT_MFC_ATOMIC,
               cache = kind == CGT_MFC_CACHE || kind == CGT_MFC_ZERO;
    if (line)
        t.size = CGT_LINE_BYTES; /* MFC_Size does not count */
    t.writes = !(kind == CGT_MFC_GET || kind == CGT_MFC_CACHE || c->operation->opcode == 0xd0);
    if (kind == CGT_MFC_SIGNAL && t.size != 4) {
        cgt_mfc_fail_command(mfc, c, CGT_RULE_SIZE, "a signal has 4 bytes");
        return false;
    }
    return check_size(mfc, &t) && (!line || check_line(mfc, c)) && check_addresses(mfc, &t, !cache) &&
           (cache || check_store(mfc, &t)) && check_region(mfc, &t);
}

bool cgt_mfc_check_command(cgt_mfc *mfc, const cgt_mfc_command *c)
{
    const cgt_mfc_kind kind = c->operation->kind;
    if (kind != CGT_MFC_ATOMIC && c->tag > 31) {
        cgt_mfc_fail_command(mfc, c, CGT_RULE_TAG, "the tag is above 31");
        return false;
    }
    if (kind == CGT_MFC_ORDER || kind == CGT_MFC_BARRIER)
        return true;
    return c->operation->list ? check_list(mfc, c) : check_transfer(mfc, c);
}

bool cgt_mfc_check_element(cgt_mfc *mfc, const cgt_mfc_command *c, const cgt_mfc_element *e, uint32_t lsa)
{
    transfer t = {.command = c, .lsa = lsa, .size = e->size, .ea = (c->ea >> 32 << 32) | e->eal};
    t.writes = c->operation->kind == CGT_MFC_PUT;
    snprintf(t.where, sizeof t.where, "element %" PRIu32 ": ", c->end / 8);
    if (e->size == 0)
        return true; /* nothing to move */
    if (!check_size(mfc, &t) || !check_addresses(mfc, &t, true) || !check_store(mfc, &t))
        return false;
    if ((uint64_t)e->eal + e->size > UINT64_C(1) << 32) {
        cgt_mfc_fail_command(mfc, c, CGT_RULE_LIST_CROSSING,
                             "%seal 0x%" PRIx32 " + %" PRIu32 " crosses a multiple of 4 GB", t.where, e->eal, e->size);
        return false;
    }
    return check_region(mfc, &t);
}

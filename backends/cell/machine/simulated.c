/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Simulated SPEs on one thread, in the order of simulated time. Three kinds of things happen: an MFC ends a command,
 * the PPE has served an event, an SPE accesses a channel. The earliest is next; at equal cycles MFCs come first, then
 * the PPE, then SPEs, each by number. SPEs meet nowhere but there, so instructions between two accesses may run ahead:
 * an SPE runs until it wants a channel while something else is still to happen before, and is stopped there by the gate
 * around its channels. */
#include <inttypes.h>

#include "cell/machine/machine_internal.h"

/* How far an SPE that accesses no channel runs ahead of the others. A program that waits for its data by looking at
 * local store sees it this many cycles late at most. */
#define QUANTUM 4096

/* One SPE's channels, as the SPE sees them. */
typedef struct gate {
    cgt_cell *cell;
    unsigned spe;
    cgt_spu_channels channels; /* the MFC's */
    bool yields;               /* the access has been refused: something else comes before it */
    bool polls;                /* it asked for a count since it began to run */
    uint64_t cycle;            /* of the last access */
} gate;

/* ---- what is next ---- */

static uint64_t next_ppe(const cgt_cell *cell)
{
    if (cell->events == 0)
        return CGT_NO_CYCLE;
    const uint64_t start = cell->event[0].cycle > cell->ppe_free ? cell->event[0].cycle : cell->ppe_free;
    return start + cell->options.ppe_cycles;
}

static uint64_t next_mfc(const cgt_cell *cell, unsigned *which)
{
    uint64_t next = CGT_NO_CYCLE;
    for (unsigned i = 0; i < cell->options.spes; i++) {
        const cgt_mfc *const mfc = cell->spe[i].mfc;
        const uint64_t cycle = cgt_mfc_next_event(mfc);
        /* nobody sees the decrementer of a program that has ended */
        if (cycle < next && (cell->spe[i].state != CGT_SPE_ENDED || cgt_mfc_is_busy(mfc))) {
            next = cycle;
            *which = i;
        }
    }
    return next;
}

static unsigned next_spe(const cgt_cell *cell)
{
    unsigned next = cell->options.spes;
    for (unsigned i = 0; i < cell->options.spes; i++)
        if (cell->spe[i].state == CGT_SPE_RUNS &&
            (next == cell->options.spes || cell->spe[i].cycle < cell->spe[next].cycle))
            next = i;
    return next;
}

static uint64_t earlier(uint64_t a, uint64_t b) { return a < b ? a : b; }

/* The first cycle in which something else comes before an access of the SPE. */
static uint64_t horizon(const cgt_cell *cell, unsigned spe)
{
    unsigned which = 0;
    uint64_t cycle = earlier(next_mfc(cell, &which), next_ppe(cell));
    for (unsigned i = 0; i < cell->options.spes; i++)
        if (i != spe && cell->spe[i].state == CGT_SPE_RUNS)
            cycle = earlier(cycle, cell->spe[i].cycle + (i > spe));
    return cycle;
}

/* ---- the gate ---- */

static bool may_pass(gate *g, uint64_t cycle)
{
    g->cycle = cycle;
    g->yields = horizon(g->cell, g->spe) <= cycle;
    return !g->yields;
}

static cgt_channel_status gate_read(void *user, unsigned channel, uint64_t cycle, uint32_t *value)
{
    gate *const g = user;
    if (!may_pass(g, cycle))
        return CGT_CHANNEL_STALL;
    return g->channels.read(g->channels.user, channel, cycle, value);
}

static cgt_channel_status gate_write(void *user, unsigned channel, uint64_t cycle, uint32_t value)
{
    gate *const g = user;
    cgt_ppe_event event = {.spe = g->spe, .cycle = cycle};
    if (!may_pass(g, cycle))
        return CGT_CHANNEL_STALL;
    const cgt_channel_status status = g->channels.write(g->channels.user, channel, cycle, value);
    if (status == CGT_CHANNEL_DONE && cgt_cell_event_of_channel(channel, &event.kind))
        cgt_cell_post(g->cell, event);
    return status;
}

/* A count cannot be refused. Where something else comes first the SPE gets the count of the last cycle that is certain:
 * cycle 0 does not move the MFC on. An SPE that polls runs no further ahead than that from its next turn on. */
static uint32_t gate_count(void *user, unsigned channel, uint64_t cycle)
{
    gate *const g = user;
    g->polls = true;
    return g->channels.count(g->channels.user, channel, horizon(g->cell, g->spe) <= cycle ? 0 : cycle);
}

/* the cycle up to which an SPE may run now */
static uint64_t turn_end(const gate *g, uint64_t cycle)
{
    uint64_t end = cycle + QUANTUM;
    if (g->polls)
        end = earlier(end, horizon(g->cell, g->spe));
    return end > cycle ? end : cycle + 1;
}

/* ---- steps ---- */

/* SPEs whose MFC has changed try their access again. */
static void wake_waiting(cgt_cell *cell, uint64_t cycle)
{
    for (unsigned i = 0; i < cell->options.spes; i++) {
        cgt_spe *const spe = &cell->spe[i];
        if (spe->state == CGT_SPE_WAITS && cgt_mfc_get_changes(spe->mfc) != spe->changes) {
            if (cycle > spe->cycle) {
                cgt_cell_add_wait(spe, spe->channel, cycle - spe->cycle);
                spe->cycle = cycle;
                spe->late = true;
            }
            spe->state = CGT_SPE_RUNS;
        }
    }
}

static void check_mfcs(cgt_cell *cell)
{
    for (unsigned i = 0; i < cell->options.spes; i++)
        if (cgt_mfc_get_error(cell->spe[i].mfc, NULL) != CGT_RULE_NONE)
            cgt_cell_fail_mfc(cell, i);
}

static void step_mfc(cgt_cell *cell, unsigned which, uint64_t cycle)
{
    cgt_mfc_advance(cell->spe[which].mfc, cycle);
    wake_waiting(cell, cycle);
    check_mfcs(cell);
}

static void step_ppe(cgt_cell *cell, uint64_t cycle)
{
    cell->ppe_free = cycle;
    cgt_cell_serve(cell, cgt_cell_take_event(cell));
    wake_waiting(cell, cycle);
    check_mfcs(cell);
}

static void end_spe(cgt_cell *cell, unsigned number, uint32_t code, uint64_t cycle)
{
    cgt_spe *const spe = &cell->spe[number];
    spe->state = CGT_SPE_ENDED;
    spe->result.stopped = true;
    spe->result.code = code;
    spe->result.cycle = cycle;
    cgt_cell_post(cell, (cgt_ppe_event){.kind = CGT_PPE_STOPPED, .spe = number, .value = code, .cycle = cycle});
}

/* a unit's error: its own, or that of a channel */
static void fail_unit(cgt_cell *cell, unsigned number, const cgt_spe_unit *unit)
{
    if (cgt_mfc_get_error(cell->spe[number].mfc, NULL) != CGT_RULE_NONE)
        cgt_cell_fail_mfc(cell, number);
    else
        cgt_cell_fail(cell, "SPE %u: %s", number, unit->get_message ? unit->get_message(unit->user) : "failed");
}

static void run_spe(cgt_cell *cell, unsigned number, const cgt_spe_unit *unit, gate *g)
{
    cgt_spe *const spe = &cell->spe[number];
    const cgt_spu_channels channels = {.user = g, .read = gate_read, .write = gate_write, .count = gate_count};
    const uint64_t until = turn_end(g, spe->cycle);
    if (spe->late)
        unit->raise_cycle(unit->user, spe->cycle);
    spe->late = g->polls = false;
    const cgt_spu_end end = unit->run(unit->user, &channels, until);
    const uint64_t now = unit->get_cycle(unit->user);
    switch (end.reason) {
    case CGT_SPU_STOPPED: end_spe(cell, number, end.value, now); break;
    case CGT_SPU_STALLED:
        spe->cycle = g->cycle;
        spe->channel = end.value;
        spe->changes = cgt_mfc_get_changes(spe->mfc);
        spe->state = g->yields ? CGT_SPE_RUNS : CGT_SPE_WAITS;
        break;
    case CGT_SPU_CYCLES: spe->cycle = now; break;
    case CGT_SPU_HALTED:
        cgt_mfc_fail(spe->mfc, CGT_RULE_HALT, "the program halted");
        fail_unit(cell, number, unit);
        break;
    case CGT_SPU_ERROR: fail_unit(cell, number, unit); break;
    }
}

static bool all_ended(const cgt_cell *cell)
{
    for (unsigned i = 0; i < cell->options.spes; i++)
        if (cell->spe[i].state != CGT_SPE_ENDED)
            return false;
    return true;
}

/* One thing happens. Returns false where nothing can, or the run has failed. */
static bool step(cgt_cell *cell, const cgt_spe_unit *unit, gate *gates)
{
    unsigned mfc = 0;
    const unsigned spe = next_spe(cell);
    const uint64_t mfc_cycle = next_mfc(cell, &mfc), ppe_cycle = next_ppe(cell);
    const uint64_t spe_cycle = spe < cell->options.spes ? cell->spe[spe].cycle : CGT_NO_CYCLE;
    uint64_t now = spe_cycle;
    if (mfc_cycle <= ppe_cycle && mfc_cycle <= spe_cycle && mfc_cycle != CGT_NO_CYCLE)
        step_mfc(cell, mfc, now = mfc_cycle);
    else if (ppe_cycle <= spe_cycle && ppe_cycle != CGT_NO_CYCLE)
        step_ppe(cell, now = ppe_cycle);
    else if (spe_cycle != CGT_NO_CYCLE)
        run_spe(cell, spe, &unit[spe], &gates[spe]);
    else
        return false;
    if (cell->options.cycle_limit > 0 && now > cell->options.cycle_limit)
        cgt_cell_fail(cell, "the limit of %" PRIu64 " cycles is reached", cell->options.cycle_limit);
    return !cell->failed;
}

static cgt_result prepare(cgt_cell *cell, const cgt_spe_unit *unit, gate *gates, cgt_ppe_function *ppe, void *user)
{
    cgt_local_store store[CGT_MAX_SPES];
    for (unsigned i = 0; i < cell->options.spes; i++)
        store[i] = (cgt_local_store){.bytes = unit[i].local_store,
                                     .size = unit[i].store_bytes,
                                     .order = unit[i].order,
                                     .written = unit[i].written,
                                     .user = unit[i].user};
    const cgt_result result = cgt_cell_prepare(cell, store, ppe, user);
    for (unsigned i = 0; i < cell->options.spes && result == CGT_OK; i++) {
        gates[i] = (gate){.cell = cell, .spe = i, .channels = cgt_mfc_get_channels(cell->spe[i].mfc)};
        cell->spe[i].cycle = unit[i].get_cycle(unit[i].user);
    }
    return result;
}

cgt_result cgt_cell_run_simulated(cgt_cell *cell, const cgt_spe_unit *unit, cgt_ppe_function *ppe, void *user)
{
    gate gates[CGT_MAX_SPES] = {{.spe = 0}};
    cell->native = false;
    const cgt_result result = prepare(cell, unit, gates, ppe, user);
    if (result != CGT_OK)
        return result;
    while (step(cell, unit, gates)) {
    }
    if (!cell->failed && !all_ended(cell))
        cgt_cell_fail_deadlock(cell);
    return cell->failed ? CGT_ERROR_STOPPED : CGT_OK;
}

/* ---- a simulated SPU as the processor of an SPE ---- */

static cgt_spu_end run_spu(void *user, const cgt_spu_channels *channels, uint64_t until_cycle)
{
    return cgt_spu_run(user, channels, until_cycle);
}

static uint64_t get_cycle(void *user) { return ((const cgt_spu *)user)->cycle; }

static void raise_cycle(void *user, uint64_t cycle)
{
    cgt_spu *const spu = user;
    if (cycle > spu->cycle)
        spu->cycle = cycle;
}

static void written(void *user, uint32_t lsa, uint32_t size) { cgt_spu_forget(user, lsa, size); }

static const char *get_message(void *user) { return ((const cgt_spu *)user)->message; }

static void set_register(cgt_spu *spu, unsigned number, uint64_t value)
{
    spu->reg[number] = (cgt_spu_register){{(uint32_t)(value >> 32), (uint32_t)value, 0, 0}};
}

cgt_spe_unit cgt_cell_unit_of(cgt_spu *spu, unsigned spe, uint64_t argument, uint64_t environment)
{
    set_register(spu, 3, spe);
    set_register(spu, 4, argument);
    set_register(spu, 5, environment);
    return (cgt_spe_unit){.user = spu,
                          .local_store = spu->local_store,
                          .store_bytes = CGT_SPU_LOCAL_STORE,
                          .order = CGT_STORE_BIG_ENDIAN,
                          .run = run_spu,
                          .get_cycle = get_cycle,
                          .raise_cycle = raise_cycle,
                          .written = written,
                          .get_message = get_message};
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The constants of the model of time, at 3.2 GHz. They are a model's: nothing here was measured on a Cell.
 *
 *   latency 300              Kistler, Perrone, Petrini, "Cell Multiprocessor Communication Network: Built for Speed",
 *                            IEEE Micro 26(3), 2006: a DMA of one line in less than 100 ns, 320 cycles; 16 of them on
 *                            the bus
 *   bytes_per_cycle 8        the same: 25.6 GB/s of one SPE
 *   memory_bytes_per_cycle 8 IBM's and Sony's data of the machine: 25.6 GB/s of the XDR memory, which all share
 *   least_bytes 128          CBE Programming Handbook: a request on the bus is one line, however little of it is wanted
 *   atomic_latency 300       as a get: no source has a figure of its own; lines that the atomic cache holds take less
 *   signal_latency 300       likewise
 *   decrementer_cycles 40    the PlayStation 3's time base of 79.8 MHz
 *   jitter 0                 everything in the order of the queue */
#include "cell/mfc/mfc.h"

const cgt_mfc_timing cgt_mfc_default_timing = {
    .latency = 300,
    .bytes_per_cycle = 8,
    .memory_bytes_per_cycle = 8,
    .least_bytes = 128,
    .atomic_latency = 300,
    .signal_latency = 300,
    .decrementer_cycles = 40,
    .jitter = 0,
    .jitter_seed = 0,
};

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The sweep along one axis of one node, from scratch: for the top of the tree. */
#ifndef CGT_KD_SWEEP_H
#define CGT_KD_SWEEP_H

#include "builders/kd/split/kd_builder.h"

/* The cheapest plane across the axis. memory: CGT_KD_SWEEP_AXIS_BYTES an item. */
cgt_kd_plane cgt_kd_sweep_once(const cgt_kd_rules *rules, const cgt_kd_box *box, uint32_t axis, const cgt_kd_item *item,
                               uint32_t count, void *memory);

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Operations of space groups by their Hall symbols, and settings by their names. */
#ifndef SPACE_GROUP_H
#define SPACE_GROUP_H

#include "trajectory/molecule/cif_crystal.h"

/* Makes the operations of a Hall symbol, centrings included. Returns how many, at most CRYSTAL_MOST_OPERATIONS; 0: the
 * symbol cannot be read. */
uint32_t space_group_of_hall(const char *hall, cif_operation operation[CRYSTAL_MOST_OPERATIONS]);

/* Makes the operations of a group by its name, such as "P 21/c", "Fm-3m", "R -3 c :H", or its number, in the setting
 * that the cell has. 0: it is not known, or no single setting of it fits, as where two origins are usual. */
uint32_t space_group_of_name(const char *given, const double edge[3][3],
                             cif_operation operation[CRYSTAL_MOST_OPERATIONS]);

#endif

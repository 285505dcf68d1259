#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""space_groups.py [--check]: writes programs/trajectory/molecule/space_group_table.h, settings of the 230 space groups by
their names and Hall symbols, from the table of gemmi (Debian: python3-gemmi; MPL-2.0 or LGPL-3; names and symbols alone
are taken, as data). --check: fails where the file is another one."""
import os
import sys

import gemmi

PATH = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))),
                    "programs/trajectory/molecule/space_group_table.h")
HEAD = """/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Settings of space groups: number, name by Hermann and Mauguin, choice of origin or axes (0: there is none), Hall
 * symbol. The first of a number is the usual one. Written by scripts/space_groups.py from the table of gemmi. Part of
 * space_group.c: data. */
/* clang-format off */
"""


def rows():
    for group in gemmi.spacegroup_table():
        choice = group.ext if group.ext != "\0" else ""
        hall = group.hall.replace('"', '\\"')
        yield f'{{{group.number}, "{group.hm}", ' + (f"'{choice}'" if choice else "0") + f', "{hall}"}},'


def main():
    text = HEAD
    line = ""
    for row in rows():
        if len(line) + len(row) + 1 > 120:
            text += line + "\n"
            line = ""
        line += (" " if line else "") + row
    text += line + "\n"
    if "--check" in sys.argv:
        with open(PATH, encoding="utf-8") as file:
            sys.exit(file.read() != text and "space_group_table.h is not what gemmi's table makes")
    with open(PATH, "w", encoding="utf-8") as file:
        file.write(text)


main()

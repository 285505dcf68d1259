# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""visible_symbols.py ARCHIVE NEW_ARCHIVE: a copy of an archive of ELF objects in which hidden symbols are visible.

What the compiler made of hidden symbols stays as it is; only the two bits of visibility in the symbol tables change. A
shared object of the copy, linked with -Bsymbolic, serves tests that call the library's own functions: the same code as in
the archive, and a program of 60 KB in place of 5 MB."""
import struct
import sys

GLOBAL_HEADER, MEMBER_HEADER = 8, 60
SYMTAB, HIDDEN = 2, 2


def show(data, at):
    """Changes the object at an offset; returns how many symbols were hidden."""
    if data[at:at + 4] != b"\x7fELF":
        return 0
    wide, order = data[at + 4] == 2, "<" if data[at + 5] == 1 else ">"
    word = order + ("Q" if wide else "I")
    sections = at + struct.unpack_from(word, data, at + (0x28 if wide else 0x20))[0]
    size, count = struct.unpack_from(order + "HH", data, at + (0x3A if wide else 0x2E))
    step, info, other = (24, 4, 5) if wide else (16, 12, 13)
    shown = 0
    for header in range(sections, sections + size * count, size):
        if struct.unpack_from(order + "I", data, header + 4)[0] != SYMTAB:
            continue
        start, length = struct.unpack_from(word + word[1], data, header + (0x18 if wide else 0x10))
        for symbol in range(at + start, at + start + length, step):
            if data[symbol + info] >> 4 and data[symbol + other] & 3 == HIDDEN:
                data[symbol + other] &= 0xFC
                shown += 1
    return shown


def main():
    with open(sys.argv[1], "rb") as file:
        data = bytearray(file.read())
    if data[:GLOBAL_HEADER] != b"!<arch>\n":
        sys.exit(f"{sys.argv[1]}: no archive")
    at, shown = GLOBAL_HEADER, 0
    while at < len(data):
        size = int(data[at + 48:at + 58])
        shown += show(data, at + MEMBER_HEADER)
        at += MEMBER_HEADER + size + size % 2
    if not shown:
        sys.exit(f"{sys.argv[1]}: no hidden symbol")
    with open(sys.argv[2], "wb") as file:
        file.write(data)


main()

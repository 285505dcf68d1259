/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Chemical elements by their symbols: of the readers and of the figures, neither of which needs the other. */
#ifndef ELEMENT_SYMBOLS_H
#define ELEMENT_SYMBOLS_H

#include <stdint.h>
#include <string.h>

enum { ELEMENTS = 118 };

/* The symbol of an element by its atomic number, "" for 0 and beyond the last. */
static inline const char *element_symbol(uint32_t number)
{
    static const char symbols[ELEMENTS + 1][3] = {
        "",   "H",  "He", "Li", "Be", "B",  "C",  "N",  "O",  "F",  "Ne", "Na", "Mg", "Al", "Si", "P",  "S",
        "Cl", "Ar", "K",  "Ca", "Sc", "Ti", "V",  "Cr", "Mn", "Fe", "Co", "Ni", "Cu", "Zn", "Ga", "Ge", "As",
        "Se", "Br", "Kr", "Rb", "Sr", "Y",  "Zr", "Nb", "Mo", "Tc", "Ru", "Rh", "Pd", "Ag", "Cd", "In", "Sn",
        "Sb", "Te", "I",  "Xe", "Cs", "Ba", "La", "Ce", "Pr", "Nd", "Pm", "Sm", "Eu", "Gd", "Tb", "Dy", "Ho",
        "Er", "Tm", "Yb", "Lu", "Hf", "Ta", "W",  "Re", "Os", "Ir", "Pt", "Au", "Hg", "Tl", "Pb", "Bi", "Po",
        "At", "Rn", "Fr", "Ra", "Ac", "Th", "Pa", "U",  "Np", "Pu", "Am", "Cm", "Bk", "Cf", "Es", "Fm", "Md",
        "No", "Lr", "Rf", "Db", "Sg", "Bh", "Hs", "Mt", "Ds", "Rg", "Cn", "Nh", "Fl", "Mc", "Lv", "Ts", "Og"};
    return number <= ELEMENTS ? symbols[number] : "";
}

/* The element whose symbol these letters are, in any case; 0: none. Deuterium and tritium are hydrogen. */
static inline uint32_t element_spelt(const char *letters, size_t length)
{
    if (length == 1 && strchr("DdTt", *letters) != NULL)
        return 1;
    for (uint32_t number = 1; number <= ELEMENTS && (length == 1 || length == 2); number++) {
        const char *const symbol = element_symbol(number);
        const int second = length == 2 ? letters[1] | 0x20 : '\0';
        if ((letters[0] | 0x20) == (symbol[0] | 0x20) && second == (symbol[1] ? symbol[1] | 0x20 : '\0'))
            return number;
    }
    return 0;
}

static inline uint32_t element_named(const char *symbol) { return element_spelt(symbol, strlen(symbol)); }

#endif

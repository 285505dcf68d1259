/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scale bars; see scale_bar.h. */
#include "text/scale_bar.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

#include "options/numbers.h"

typedef struct length_unit {
    const char *name;
    double angstroms;
} length_unit;

static const length_unit units[] = {{"\xc3\x85", 1.0},  {"\xe2\x84\xab", 1.0}, {"A", 1.0},         {"Ang", 1.0},
                                    {"Angstrom", 1.0},  {"Angstroms", 1.0},    {"fm", 1e-5},       {"pm", 0.01},
                                    {"nm", 10.0},       {"um", 1e4},           {"\xc2\xb5m", 1e4}, /* micro sign, mu */
                                    {"\xce\xbcm", 1e4}, {"mm", 1e7},           {"cm", 1e8},        {"m", 1e10}};

/* Whether two names are the same but for capitals of ASCII. */
static int are_same(const char *a, const char *b)
{
    for (; *a && *b; a++, b++) {
        const int is_letter = (*a | 0x20) >= 'a' && (*a | 0x20) <= 'z';
        if (*a != *b && !(is_letter && (*a | 0x20) == (*b | 0x20)))
            return 0;
    }
    return *a == *b;
}

static double angstroms_of(const char *unit)
{
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++)
        if (are_same(units[i].name, unit))
            return units[i].angstroms;
    return 0.0;
}

int cgt_scale_bar_is_unknown(const scale_bar *bar, double angstrom)
{
    return bar->is_set && *bar->unit && angstrom > 0.0 && !(angstroms_of(bar->unit) > 0.0);
}

static const char *unit_of_data(double angstrom)
{
    return fabs(angstrom - 0.1) < 1e-6 ? "nm" : fabs(angstrom - 1.0) < 1e-6 ? "\xc3\x85" : "";
}

float cgt_scale_bar_share(const scale_bar *bar) { return bar->length > 0.0 ? 0.4f : 0.25f; }

static void write_label(double length, const char *unit, char label[SCALE_BAR_LABEL])
{
    snprintf(label, SCALE_BAR_LABEL, "%s%s%s", cgt_number(6, length).text, *unit ? " " : "", unit);
}

void cgt_scale_bar_longest(const scale_bar *bar, char label[SCALE_BAR_LABEL])
{
    write_label(bar->length > 0.0 ? bar->length : 5e-05, *bar->unit ? bar->unit : "nm", label);
}

/* The longest of 1, 2 or 5 times a power of ten that is not above a length. */
static double round_length(double most)
{
    const double power = pow(10.0, floor(log10(most)));
    const double share = most / power * (1.0 + 1e-9);
    return power * (share >= 5.0 ? 5.0 : share >= 2.0 ? 2.0 : 1.0);
}

int cgt_scale_bar_find(const scale_bar *bar, double pixel, double angstrom, float most, float *length,
                       char label[SCALE_BAR_LABEL])
{
    const char *const unit = *bar->unit ? bar->unit : unit_of_data(angstrom);
    const double known = angstrom * angstroms_of(unit), world = known > 0.0 ? known : 1.0; /* of the unit */
    const double chosen = bar->length > 0.0 ? bar->length : round_length((double)most * pixel / world);
    *length = (float)(chosen * world / pixel);
    if (!(*length <= most) || !(*length >= 2.0f))
        return -1;
    write_label(chosen, unit, label);
    return 0;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scale bars; see scale_bar.h. */
#include "text/scale_bar.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "options/numbers.h"

typedef struct length_unit {
    const char *name;
    double angstroms;
} length_unit;

static const length_unit units[] = {{"\xc3\x85", 1.0},  {"A", 1.0},  {"Angstrom", 1.0},  {"pm", 0.01},
                                    {"nm", 10.0},       {"um", 1e4}, {"\xc2\xb5m", 1e4}, /* micro sign, mu */
                                    {"\xce\xbcm", 1e4}, {"mm", 1e7}};

static double angstroms_of(const char *unit)
{
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++)
        if (strcmp(units[i].name, unit) == 0)
            return units[i].angstroms;
    return 0.0;
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
    const int is_nm = fabs(angstrom - 0.1) < 1e-6, is_angstrom = fabs(angstrom - 1.0) < 1e-6;
    const char *const unit = *bar->unit ? bar->unit : is_nm ? "nm" : is_angstrom ? "\xc3\x85" : "";
    const double known = angstrom * angstroms_of(unit), world = known > 0.0 ? known : 1.0; /* of the unit */
    const double chosen = bar->length > 0.0 ? bar->length : round_length((double)most * pixel / world);
    *length = (float)(chosen * world / pixel);
    if (!(*length <= most) || !(*length >= 2.0f))
        return -1;
    write_label(chosen, unit, label);
    return 0;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Elements by their names and masses; see trajectory_elements.h. */
#include "trajectory/atoms/trajectory_elements.h"
#include "trajectory/atoms/trajectory_sites.h"

#include <math.h>
#include <string.h>

/* Standard atomic weights (IUPAC 2021, abridged) up to bismuth, but for technetium and promethium. */
static const float masses[] = {
    1.008f,  4.0026f, 6.94f,   9.0122f, 10.81f,  12.011f, 14.007f, 15.999f, 18.998f, 20.180f, 22.990f, 24.305f,
    26.982f, 28.085f, 30.974f, 32.06f,  35.45f,  39.95f,  39.098f, 40.078f, 44.956f, 47.867f, 50.942f, 51.996f,
    54.938f, 55.845f, 58.933f, 58.693f, 63.546f, 65.38f,  69.723f, 72.630f, 74.922f, 78.971f, 79.904f, 83.798f,
    85.468f, 87.62f,  88.906f, 91.224f, 92.906f, 95.95f,  0,       101.07f, 102.91f, 106.42f, 107.87f, 112.41f,
    114.82f, 118.71f, 121.76f, 127.60f, 126.90f, 131.29f, 132.91f, 137.33f, 138.91f, 140.12f, 140.91f, 144.24f,
    0,       150.36f, 151.96f, 157.25f, 158.93f, 162.50f, 164.93f, 167.26f, 168.93f, 173.05f, 174.97f, 178.49f,
    180.95f, 183.84f, 186.21f, 190.23f, 192.22f, 195.08f, 196.97f, 200.59f, 204.38f, 207.2f,  208.98f};

/* Up to oxygen force fields write two decimals or more, 12.01 and 14.0067, and there are other particles close to an
 * element: CH2 as one has 14.02 to 14.03, as NH2 16.02, N beside a hydrogen of 3.024 has 11.991, O 13.983. Beyond, old
 * weights differ by as much as 47.88 for titanium does. */
uint32_t element_by_mass(double mass)
{
    if (!(mass > 0.0 && mass < 300.0) || mass == floor(mass))
        return 0;
    for (uint32_t i = 0; i < sizeof masses / sizeof masses[0]; i++)
        if (masses[i] > 0.0f && fabs(mass - (double)masses[i]) <= (i < 8 ? 0.012 : 0.03))
            return i + 1;
    return 0;
}

static int is_digit(char c) { return c >= '0' && c <= '9'; }
static int is_upper(char c) { return c >= 'A' && c <= 'Z'; }
static int is_letter(char c) { return is_upper(c) || (c >= 'a' && c <= 'z'); }

/* Whether two capitals may be the label of an atom in a molecule: an element of such molecules, then the atom's place,
 * counted in Greek letters (alpha, beta, gamma, delta, epsilon, zeta, eta) from the backbone, or another mark. */
static int may_be_label(const char *letters)
{
    return is_upper(letters[0]) && is_upper(letters[1]) && strchr("HCNOSP", letters[0]) != NULL &&
           strchr("ABGDEZHX", letters[1]) != NULL;
}

uint32_t element_find(text_span name, element_reading *reading)
{
    const char *p = name.begin;
    while (p < name.end && is_digit(*p)) /* "1HB" */
        p++;
    const int numbered = p > name.begin;
    size_t letters = 0, capitals = 0;
    while (p + letters < name.end && is_letter(p[letters])) {
        capitals += (size_t)is_upper(p[letters]);
        letters++;
    }
    const char *after = p + letters;
    while (after < name.end && is_digit(*after))
        after++;
    const int has_digits = numbered || after > p + letters;
    *reading = ELEMENT_NONE;
    if (letters == 0)
        return 0;
    const uint32_t symbol = after == name.end || letters <= 2 ? element_spelt(p, letters) : 0;
    const int ambiguous = letters == 2 && may_be_label(p);
    if (symbol != 0 && !(ambiguous && has_digits)) {
        *reading = ambiguous ? ELEMENT_EITHER : ELEMENT_SYMBOL;
        return symbol;
    }
    /* Labels are written in capitals and have one to four characters. */
    const uint32_t first = letters == capitals && name.end - name.begin <= 4 ? element_spelt(p, 1) : 0;
    *reading = first != 0 ? ELEMENT_LABEL : ELEMENT_NONE;
    return first;
}

/* FNV-1a. Three of four buckets stay free, so that searches are short. */
static uint32_t hash_name(text_span name)
{
    uint32_t hash = 2166136261u;
    for (const char *p = name.begin; p < name.end; p++)
        hash = (hash ^ (unsigned char)*p) * 16777619u;
    return (hash ^ hash >> 15) % NAME_BUCKETS;
}

uint32_t name_table_peek(const name_table *names, text_span name)
{
    for (uint32_t at = hash_name(name); names->bucket[at] != 0; at = (at + 1) % NAME_BUCKETS)
        if (text_is(name, names->name[names->bucket[at] - 1u]))
            return names->bucket[at];
    return 0;
}

static const char is_full[] = "more than 1024 different names";

uint32_t name_table_find(name_table *names, text_span name, const char **reason)
{
    if (names->count > 0 && text_is(name, names->name[names->last]))
        return names->last + 1;
    uint32_t at = hash_name(name);
    for (; names->bucket[at] != 0; at = (at + 1) % NAME_BUCKETS) {
        const uint32_t i = names->bucket[at] - 1u;
        if (text_is(name, names->name[i])) {
            names->last = i;
            return i + 1;
        }
    }
    const size_t length = text_length(name);
    if (length > NAME_LONGEST) {
        *reason = "the name is longer than 63 characters";
        return 0;
    }
    if (memchr(name.begin, '\0', length)) {
        *reason = "the name has a zero byte in it";
        return 0;
    }
    if (names->count == NAMES_MOST) {
        *reason = is_full;
        return 0;
    }
    names->last = names->count++;
    names->bucket[at] = (uint16_t)names->count;
    memcpy(names->name[names->last], name.begin, length);
    names->name[names->last][length] = '\0';
    element_reading reading;
    const text_span none = {name.end, name.end};
    const uint32_t site = site_find(name, none, none);
    names->element[names->last] = (uint8_t)(site != 0 ? site : element_find(name, &reading));
    names->radius[names->last] = element_radius(names->element[names->last]);
    return names->last + 1;
}

uint32_t name_table_type(name_table *names, text_span name, const char **reason)
{
    const uint32_t type = name_table_find(names, name, reason);
    return type == 0 && *reason == is_full ? NAMES_MOST + 1 : type;
}

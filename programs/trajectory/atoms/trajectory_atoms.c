/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Residues and alternate places. */
#include "trajectory/atoms/trajectory_atoms.h"
#include "data/molecule/residue_names.h"
#include "trajectory/molecule/residues.h"
#include "trajectory/atoms/trajectory_sites.h"

#include <string.h>

void atoms_begin(cgt_trajectory *t) { t->store.has_residues = t->store.has_places = 0; }

static int is_standard(text_span name)
{
    char word[8];
    const size_t length = text_length(name) < sizeof word ? text_length(name) : 0;
    memcpy(word, name.begin, length);
    word[length] = '\0';
    return residue_is_organic(name) || residue_is_protein(word);
}

uint32_t atoms_set_residue(cgt_trajectory *t, residue_run *run, size_t i, text_span key, text_span residue,
                           text_span name)
{
    const size_t longest = sizeof run->key - 1, length = text_length(key) < longest ? text_length(key) : longest;
    if (i == 0 || strncmp(run->key, key.begin, length) != 0 || run->key[length] != '\0') {
        run->number = i == 0 ? 0 : run->number + 1;
        run->is_standard = is_standard(residue);
        run->name[0] = '\0';
        memcpy(run->key, key.begin, length);
        run->key[length] = '\0';
    }
    t->store.residue[i] = 2 * run->number + (uint32_t)run->is_standard;
    t->store.has_residues = 1;
    const uint32_t site = site_find(name, residue, (text_span){run->name, run->name + strlen(run->name)});
    snprintf(run->name, sizeof run->name, "%.*s", (int)(text_length(name) < 8 ? text_length(name) : 0), name.begin);
    return site;
}

void atoms_set_place(cgt_trajectory *t, size_t i, char mark)
{
    t->store.place[i] = mark;
    t->store.has_places |= mark != '\0';
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tags of CIF. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/molecule/cif_tags.h"

#include <string.h>

/* Tags by role, in small letters and with underscores; label_ is used where a file has no auth_. */
static const struct {
    const char *tag;
    int role;
} tags[] = {
    {"_atom_site_auth_atom_id", CIF_NAME},
    {"_atom_site_label_atom_id", CIF_NAME},
    {"_atom_site_label", CIF_NAME},
    {"_atom_site_auth_comp_id", CIF_RESIDUE},
    {"_atom_site_label_comp_id", CIF_RESIDUE},
    {"_atom_site_auth_asym_id", CIF_CHAIN},
    {"_atom_site_label_asym_id", CIF_CHAIN},
    {"_atom_site_auth_seq_id", CIF_SEQUENCE},
    {"_atom_site_label_seq_id", CIF_SEQUENCE},
    {"_atom_site_occupancy", CIF_OCCUPANCY},
    {"_atom_site_b_iso_or_equiv", CIF_B},
    {"_atom_site_label_alt_id", CIF_PLACE},
    {"_atom_site_disorder_group", CIF_GROUP},
    {"_atom_site_calc_flag", CIF_FLAG},
    {"_atom_site_cartn_x", CIF_X},
    {"_atom_site_cartn_y", CIF_Y},
    {"_atom_site_cartn_z", CIF_Z},
    {"_atom_site_fract_x", CIF_FRACT_X},
    {"_atom_site_fract_y", CIF_FRACT_Y},
    {"_atom_site_fract_z", CIF_FRACT_Z},
    {"_atom_site_type_symbol", CIF_ELEMENT},
    {"_atom_site_id", CIF_ID},
    {"_atom_site_pdbx_pdb_model_num", CIF_MODEL},
    {"_symmetry_equiv_pos_as_xyz", CIF_OPERATION},
    {"_space_group_symop_operation_xyz", CIF_OPERATION},
    {"_space_group_symop_magn_operation_xyz", CIF_OPERATION},
    {"_space_group_symop_magn_centering_xyz", CIF_CENTRING},
};

void cif_tag_copy(text_span text, char tag[CIF_TAG_SIZE])
{
    const size_t length = text_length(text) < CIF_TAG_SIZE - 1 ? text_length(text) : CIF_TAG_SIZE - 1;
    for (size_t i = 0; i < length; i++) {
        const char c = text.begin[i];
        tag[i] = c == '.' ? '_' : c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
    }
    tag[length] = '\0';
}

int cif_tags_add(cif_tags *c, const char *tag)
{
    int found = CIF_ROLES;
    for (size_t i = 0; i < sizeof tags / sizeof tags[0] && found == CIF_ROLES; i++)
        if (strcmp(tag, tags[i].tag) == 0)
            found = tags[i].role;
    const int is_label = strncmp(tag, "_atom_site_label_", 17) == 0;
    int role = found;
    for (uint32_t k = 0; k < c->count && k < CIF_MOST_TAGS && found != CIF_ROLES; k++) {
        if (c->role[k] != found)
            continue;
        if (is_label)
            role = CIF_ROLES; /* the auth_ one was before */
        else
            c->role[k] = CIF_ROLES;
    }
    if (c->count < CIF_MOST_TAGS)
        c->role[c->count] = role;
    c->count++;
    return found;
}

int cif_tags_rows(cgt_trajectory *t, cif_tags *c)
{
    unsigned found = 0;
    for (uint32_t i = 0; i < c->count && i < CIF_MOST_TAGS; i++)
        found |= 1u << c->role[i];
    const unsigned places = found >> CIF_X & 7u, fractions = found >> CIF_FRACT_X & 7u;
    const int are_atoms = places != 0 || fractions != 0;
    if (!are_atoms && (found & (1u << CIF_OPERATION | 1u << CIF_CENTRING)) == 0)
        return CIF_ROWS_OTHER;
    if (c->count > CIF_MOST_TAGS)
        return trajectory_fail(t, t->text.line, "more than 256 tags in a loop");
    if (!are_atoms)
        return CIF_ROWS_OPERATIONS;
    c->is_fractional = places != 7;
    if (places != 7 && fractions != 7)
        return trajectory_fail(t, t->text.line,
                               "_atom_site has not all of Cartn_x, Cartn_y, Cartn_z, nor of fract_x, fract_y, "
                               "fract_z: the atoms have no place");
    return CIF_ROWS_ATOMS;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The tags of CIF that are used, and what those of a loop make. Names have a point in mmCIF where those of small
 * molecules have an underscore (_atom_site.occupancy, _atom_site_occupancy): both are read. */
#ifndef CIF_TAGS_H
#define CIF_TAGS_H

#include "trajectory/trajectory_internal.h"

#define CIF_MOST_TAGS 256u /* of a loop that is used */
#define CIF_TAG_SIZE 64u

/* Values of an atom that are used; the wanted columns are the first ones. */
typedef enum cif_role {
    CIF_NAME,
    CIF_RESIDUE,
    CIF_CHAIN,
    CIF_SEQUENCE,
    CIF_OCCUPANCY,
    CIF_B,
    CIF_PLACE, /* of several that an atom has */
    CIF_COLUMNS,
    CIF_X = CIF_COLUMNS,
    CIF_Y,
    CIF_Z,
    CIF_FRACT_X,
    CIF_FRACT_Y,
    CIF_FRACT_Z,
    CIF_ELEMENT,
    CIF_ID,
    CIF_MODEL,
    CIF_GROUP, /* of disorder */
    CIF_FLAG,  /* how the place was found: "dum" is no atom */
    CIF_OPERATION,
    CIF_CENTRING,
    CIF_ROLES
} cif_role;

typedef enum cif_rows { CIF_ROWS_OTHER, CIF_ROWS_ATOMS, CIF_ROWS_OPERATIONS } cif_rows;

typedef struct cif_tags {
    uint32_t count;
    int role[CIF_MOST_TAGS]; /* CIF_ROLES: unused */
    int is_fractional;       /* the atoms have fractions of the cell */
} cif_tags;

/* Copies a tag in small letters, with underscores for points, cut off where it is longer than all that are used. */
void cif_tag_copy(text_span text, char tag[CIF_TAG_SIZE]);

/* Adds a tag that cif_tag_copy made. Returns its role, CIF_ROLES for one that is not used. An auth_ tag replaces the
 * label_ tag of the same role. */
int cif_tags_add(cif_tags *c, const char *tag);

/* Looks what the tags make. Returns a cif_rows or -1. */
int cif_tags_rows(cgt_trajectory *t, cif_tags *c);

#endif

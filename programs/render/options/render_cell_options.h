/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The options of cgt-render for an emulated Cell. */
#ifndef RENDER_CELL_OPTIONS_H
#define RENDER_CELL_OPTIONS_H

#include <stdint.h>

struct argp;

typedef enum render_cell_mode {
    RENDER_CELL_NONE = 0, /* the library traces */
    RENDER_CELL_NATIVE,   /* the SPEs' program compiled for this machine, a thread an SPE */
    RENDER_CELL_SIM,      /* the program that an SPU's compiler made, instruction by instruction */
    RENDER_CELL_REAL      /* the same on SPEs of this machine */
} render_cell_mode;

typedef struct render_cell_options {
    render_cell_mode mode;
    uint32_t spes;       /* 1 to 16; 0: six, as a PlayStation 3 has them */
    uint32_t assignment; /* a number of render_cell_assignments */
    const char *program; /* SIM, REAL: the ELF file; NULL: the one beside the installed files */
} render_cell_options;

extern const char *const render_cell_assignments[4];

/* The options, as a child of another parser of argp; its input is a render_cell_options. */
extern const struct argp render_cell_argp;

#endif

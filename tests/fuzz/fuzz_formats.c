/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Fuzz target: formats of molecular dynamics. The first byte chooses the kind of file and the options, the rest is the
 * file. */
#include "fuzz/fuzz_file.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const endings[] = {".gro", ".pdb", ".cif", ".data", ".bin", ".dcd",    ".xtc", ".trr",
                                          ".nc",  ".vtk", ".gsd", ".vasp", ".psf", ".prmtop", ".top"};
    enum { ENDINGS = sizeof endings / sizeof endings[0], TOPOLOGIES = 3 };
    static const char run[] = "3\n\nO 0 0 0\nH 1 0 0\nH 0 1 0\n";
    cgt_trajectory_options options;
    fuzz_bytes b = fuzz_bytes_of(data, size);
    const uint8_t how = fuzz_byte(&b);
    cgt_trajectory_options_init(&options);
    options.radius = how & 16 ? 0.25f : 0;
    options.max_count = how & 64 ? 3 : 4096;
    const int kind = how % 16 % ENDINGS;
    if (kind >= ENDINGS - TOPOLOGIES) {
        options.topology = fuzz_scratch("topology", endings[kind], b.at, b.left);
        fuzz_file(".xyz", (const uint8_t *)run, sizeof run - 1, &options);
    } else {
        fuzz_file(endings[kind], b.at, b.left, &options);
    }
    return 0;
}

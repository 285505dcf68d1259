/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Fuzz target: formats of molecular dynamics. The first byte chooses the kind of file and the options, the rest is the
 * file. */
#include "fuzz/fuzz_file.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const endings[] = {".gro", ".pdb", ".cif", ".data", ".bin", ".dcd",
                                          ".xtc", ".trr", ".nc",  ".vtk",  ".gsd", ".vasp"};
    cgt_trajectory_options options;
    fuzz_bytes b = fuzz_bytes_of(data, size);
    const uint8_t how = fuzz_byte(&b);
    cgt_trajectory_options_init(&options);
    options.radius = how & 16 ? 0.25f : 0;
    options.max_count = how & 64 ? 3 : 4096;
    fuzz_file(endings[how % 16 % 12], b.at, b.left, &options);
    return 0;
}

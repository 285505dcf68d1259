/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Fuzz target: the first byte chooses the kind of mesh file and the options, the rest is the file. */
#include "fuzz/fuzz_file.h"

/* assimp 5.2.5 leaks memory when an import fails. The leak check skips allocations of assimp and C++, but not those of
 * the readers, which are C. The sanitizer looks for this function. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) { return "leak:libassimp\nleak:libstdc++\n"; }

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const endings[] = {".obj", ".ply", ".off", ".stl", ".gltf", ".x"};
    cgt_trajectory_options options;
    fuzz_bytes b = fuzz_bytes_of(data, size);
    const uint8_t how = fuzz_byte(&b);
    cgt_trajectory_options_init(&options);
    options.fps = how & 64 ? 5 : 0;
    options.clip = how & 128 ? "0" : NULL;
    fuzz_file(endings[how % 8 % 6], b.at, b.left, &options);
    return 0;
}

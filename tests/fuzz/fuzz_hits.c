/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Fuzz target: scenes by the profiles of tests/driver, whose random numbers are the input's bytes. The first byte
 * says the profile, the next two the number of the scene, and so its family; the judge in whole numbers says what
 * is right. */
#include "driver/driver.h"
#include "fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static driver_run *run;
    if (size < 3)
        return 0;
    if (!run)
        run = driver_run_make(driver_profiles);
    run->profile = &driver_profiles[data[0] % driver_profile_count];
    driver_run_scene(run, random_of_bytes(data + 3, size - 3), (uint32_t)(data[1] << 8 | data[2]), SCENE_ANY_FAMILY);
    FUZZ_CHECK(!run->bad, "%llu answers are wrong", (unsigned long long)run->bad);
    return 0;
}

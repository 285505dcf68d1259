/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * hits [PROFILE [FIRST [SCENES [FAMILY]]]]
 * Runs a profile, or a scene of each. Each scene depends on its number, its profile and CGT_TEST_SEED alone, so
 * that what fails is seen again by its number. Without SCENES it takes as many as the profile says, or one of each,
 * times CGT_TEST_SCALE; those of one profile must have been as hard as it says. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/driver.h"

#define ENOUGH 20u /* scenes with wrong answers */

static const char *const counter_name[] = {
#define X(name, text) text,
    DRIVER_COUNTERS(X)
#undef X
};

static void print_counts(const driver_run *run)
{
    printf("%s:", run->profile->name);
    for (uint32_t k = 0; k < COUNTERS; k++)
        if (run->count[k])
            printf("%s %llu %s", k ? "," : "", (unsigned long long)run->count[k], counter_name[k]);
    printf("\n");
}

/* Whether the cases were what the profile promises; of other seeds half of it will do, which have other cases. */
static bool was_hard(const driver_run *run)
{
    const double share = getenv("CGT_TEST_SEED") ? 0.5 : 1.0;
    bool hard = true;
    for (uint32_t k = 0; k < TEST_COUNT(run->profile->shows); k++) {
        const driver_show *const s = &run->profile->shows[k];
        if ((double)run->count[s->of] >= share * s->least * (double)run->count[s->for_each])
            continue;
        printf("%s: too easy: %llu %s of %llu %s, not %g of each\n", run->profile->name,
               (unsigned long long)run->count[s->of], counter_name[s->of], (unsigned long long)run->count[s->for_each],
               counter_name[s->for_each], share * s->least);
        hard = false;
    }
    return hard;
}

/* What a profile runs; scenes 0: all of its own. */
typedef struct range {
    uint32_t first, scenes, family;
} range;

static bool run_profile(const driver_profile *profile, const range *of)
{
    driver_run *const run = driver_run_make(profile);
    const uint32_t scenes = of->scenes ? of->scenes : test_scaled(profile->scenes / (clusters_always() ? 3 : 1));
    const uint32_t most = of->scenes ? scenes : 8 * scenes; /* some do not count where there are clusters */
    for (uint32_t k = 0; k < most && run->count[COUNT_SCENES] < scenes && run->bad_scenes <= ENOUGH; k++) {
        driver_run_scene(run, random_make(of->first + k), of->first + k, of->family);
        if (k % 1000 == 999)
            print_counts(run);
    }
    print_counts(run);
    /* fewer than the profile's are too few to tell whether they were hard */
    const bool tells = !of->scenes && run->count[COUNT_SCENES] >= profile->scenes && !clusters_always();
    const bool good = !run->bad && (!tells || was_hard(run));
    if (run->bad)
        printf("%llu answers are wrong, of %llu scenes or more\n", (unsigned long long)run->bad,
               (unsigned long long)run->bad_scenes);
    driver_run_free(run);
    return good;
}

static uint32_t number_of(int argc, char **argv, int i, uint32_t without)
{
    return argc > i ? (uint32_t)strtoul(argv[i], NULL, 0) : without;
}

int main(int argc, char **argv)
{
    const range all = {.first = number_of(argc, argv, 2, clusters_always() ? 10000 : 0),
                       .scenes = number_of(argc, argv, 3, argc > 1 ? 0 : test_scaled(1)),
                       .family = number_of(argc, argv, 4, SCENE_ANY_FAMILY)};
    bool good = true, found = false;
    test_begin("hits");
    for (uint32_t k = 0; k < driver_profile_count; k++)
        if (argc == 1 || !strcmp(argv[1], driver_profiles[k].name)) {
            found = true;
            good &= run_profile(&driver_profiles[k], &all);
        }
    if (!found)
        printf("no profile is named %s\n", argv[1]);
    return !good || !found;
}

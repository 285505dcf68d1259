/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points inside of bodies, by both rules. */
#include <string.h>

#include "driver/driver.h"

/* Of open meshes all setups must say the same, whatever it is. */
static bool knows_inside(const driver_run *run)
{
    return driver_has_crossings(run) && (run->scene.closed || !run->scene.of_kind[ORACLE_TRIANGLE]);
}

static void begin(driver_run *run)
{
    for (uint32_t i = 0; i < DRIVER_POINTS; i++)
        for (int rule = 0; rule < 2 && knows_inside(run); rule++) {
            run->inside[rule][i] =
                judge_inside(&run->scene, run->point[i], run->point_mask[i], rule == CGT_INSIDE_PARITY);
            run->count[COUNT_INSIDE] += run->inside[rule][i];
            run->count[COUNT_JUDGED]++;
        }
}

static void ask(driver_run *run)
{
    uint8_t inside[DRIVER_POINTS];
    const cgt_points points = {.count = DRIVER_POINTS,
                               .vector_stride = sizeof run->point[0],
                               .position = {&run->point[0][0], &run->point[0][1], &run->point[0][2]},
                               .mask = run->point_mask};
    for (int rule = 0; rule < 2; rule++) {
        const cgt_inside_options how = {.rule = (cgt_inside_rule)rule};
        memset(inside, 9, sizeof inside);
        const cgt_result result = cgt_points_inside(run->setup.scene, &points, &how, inside, NULL);
        if (!driver_has_crossings(run)) {
            if (result != CGT_ERROR_UNSUPPORTED)
                driver_fail(run, NULL, "cgt_points_inside", "capsules are not refused");
            continue;
        }
        if (!driver_succeeds(run, result, "cgt_points_inside"))
            continue;
        for (uint32_t i = 0; i < DRIVER_POINTS && knows_inside(run); i++)
            if (inside[i] != run->inside[rule][i])
                driver_fail(run, NULL, "cgt_points_inside", "rule %d: point %a %a %a mask %u is %u, not %u", rule,
                            (double)run->point[i][0], (double)run->point[i][1], (double)run->point[i][2],
                            (unsigned)run->point_mask[i], inside[i], run->inside[rule][i]);
        run->count[COUNT_ANSWERS] += DRIVER_POINTS;
        if (!run->setup.number)
            memcpy(run->first_inside[rule], inside, sizeof inside);
        else if (memcmp(run->first_inside[rule], inside, sizeof inside) != 0)
            driver_fail(run, NULL, "cgt_points_inside", "not the bits of the first setup");
    }
}

const driver_call call_inside = {begin, ask};

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where a colour bar has ticks; see overlay.h. */
#include <math.h>

#include "text/overlay.h"

/* Ends of a range may be floats, whose 0.1 is farther from a tenth than doubles round. In steps or decades: a tick so
 * little beyond an end lies on it. */
static const double tick_slack = 1e-6;

enum { MORE_TICKS = 32 }; /* than any bar has */

/* Of so many ticks every second, third, ... that there are `most` or fewer. */
static uint32_t thin_ticks(const double *all, uint32_t count, double *ticks, uint32_t most)
{
    const uint32_t every = count > most ? (count + most - 3) / (most - 1) : 1;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i += every)
        ticks[kept++] = all[i];
    return kept;
}

static uint32_t step_ticks(double min, double max, double step, double ticks[MORE_TICKS])
{
    const double rounding = ldexp(fmax(fabs(min), fabs(max)), -24) / step, slack = tick_slack + fmin(rounding, 0.1);
    uint32_t count = 0;
    for (double k = ceil(min / step - slack); k <= max / step + slack && count < MORE_TICKS; k += 1.0)
        ticks[count++] = k * step + 0.0; /* no -0 */
    return count;
}

static uint32_t linear_ticks(double min, double max, double *ticks, uint32_t most)
{
    static const double steps[] = {1.0, 2.0, 5.0, 10.0, 20.0};
    const double rough = (1.0 - tick_slack) * (max - min) / most, power = pow(10.0, floor(log10(rough)));
    double fine[MORE_TICKS], wide[MORE_TICKS];
    int i = 0;
    while (steps[i] * power < rough)
        i++;
    /* Where `most` steps end on ticks there is one more than that: the next step, unless that leaves a single tick. */
    const uint32_t count = step_ticks(min, max, steps[i] * power, fine);
    const uint32_t fewer = count > most ? step_ticks(min, max, steps[i + 1] * power, wide) : 0;
    return fewer >= 2 ? thin_ticks(wide, fewer, ticks, most) : thin_ticks(fine, count, ticks, most);
}

/* 1, 2 and 5 times powers of ten. */
static uint32_t digit_ticks(double min, double max, double ticks[MORE_TICKS])
{
    static const double digits[] = {1.0, 2.0, 5.0};
    uint32_t count = 0;
    for (double k = floor(log10(min)); count < MORE_TICKS && pow(10.0, k) <= max * (1.0 + tick_slack); k += 1.0)
        for (int i = 0; i < 3 && count < MORE_TICKS; i++) {
            const double value = digits[i] * pow(10.0, k);
            if (value >= min * (1.0 - tick_slack) && value <= max * (1.0 + tick_slack))
                ticks[count++] = value;
        }
    return count;
}

/* Powers of ten at equal steps, by which the last is reached from the first where such a step is less than twice the
 * least. */
static uint32_t decade_ticks(double min, double max, double *ticks, uint32_t most)
{
    const int first = (int)ceil(log10(min) - tick_slack), last = (int)floor(log10(max) + tick_slack);
    const int least = (last - first) / (int)most + 1; /* of n steps the ends are n + 1 ticks */
    int every = least;
    uint32_t count = 0;
    while (every < 2 * least && (last - first) % every)
        every++;
    every = every < 2 * least ? every : least;
    for (int k = first; k <= last; k += every)
        ticks[count++] = pow(10.0, k);
    return count;
}

uint32_t cgt_overlay_ticks(double min, double max, int logarithmic, double *ticks, uint32_t most)
{
    double fine[MORE_TICKS];
    if (!(max > min) || !isfinite(max - min))
        return 0;
    if (!logarithmic || max / min < 10.0 * (1.0 - tick_slack))
        return linear_ticks(min, max, ticks, most);
    const uint32_t count = digit_ticks(min, max, fine);
    const uint32_t decades = count > most ? decade_ticks(min, max, ticks, most) : 0;
    return decades >= 2 ? decades : thin_ticks(fine, count, ticks, most);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * See hard_rays.h. */
#include "oracle/hard_rays.h"

#include <math.h>
#include <string.h>

void hard_ray_align(test_random *random, const float at[3], truth_ray *ray)
{
    const uint32_t axis = random_below(random, 3);
    memcpy(ray->org, at, sizeof ray->org);
    memset(ray->dir, 0, sizeof ray->dir);
    ray->org[axis] -= 3;
    ray->dir[axis] = 1;
}

void hard_ray_stretch(test_random *random, truth_ray *ray)
{
    if (random_below(random, 3))
        return;
    const int exponent = (int)random_below(random, 241) - 120;
    for (int a = 0; a < 3; a++)
        ray->dir[a] = ldexpf(ray->dir[a], exponent);
}

truth_ray hard_ray_cut(test_random *random, truth_ray ray, float t)
{
    switch (random_below(random, 6)) {
    case 0: ray.t_max = t; break;
    case 1: ray.t_max = nextafterf(t, -INFINITY); break;
    case 2: ray.t_min = t; break;
    case 3: ray.t_min = nextafterf(t, INFINITY); break;
    case 4: ray.t_min = -INFINITY; break;
    default: ray.t_min = ray.t_max = t; break;
    }
    return ray;
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reflection, refraction and Fresnel's reflectance against their definitions in long double, energy and reciprocity. */
#include <math.h>

#include "support/suite.h"
#include "support/test.h"
#include "trace/bounce/optics.h"

static test_random random_state;

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static double reflectance(const double d[3], const double n[3], double eta)
{
    double out[3], share;
    (void)optics_refract(d, n, eta, out, &share);
    return share;
}

static void random_unit(double v[3])
{
    double square;
    do {
        for (int a = 0; a < 3; a++)
            v[a] = 2.0 * (double)random_float(&random_state, 0, 1) - 1.0;
        square = dot(v, v);
    } while (square > 1.0 || square < 0.01);
    for (int a = 0; a < 3; a++)
        v[a] /= sqrt(square);
}

TEST(angles_are_equal)
{
    for (int i = 0; i < 10000; i++) {
        double n[3], d[3], out[3];
        random_unit(n);
        random_unit(d);
        if (dot(d, n) > 0.0)
            continue;
        optics_reflect(d, n, out);
        assert_true(fabs(dot(out, n) + dot(d, n)) < 1e-15);
        assert_true(fabs(dot(out, out) - 1.0) < 1e-14);
    }
}

/* Snell: eta times the sine of the incoming angle is the sine of the outgoing one, in one plane. Energy: what is not
 * reflected goes on. Reciprocity: the way back has the same share and the same direction. */
TEST(light_is_refracted)
{
    uint32_t total = 0, refracted = 0;
    for (int i = 0; i < 20000; i++) {
        double n[3], d[3], out[3], back[3], turned[3], reversed[3];
        const double eta = exp(2.0 * (double)random_float(&random_state, 0, 1) - 1.0);
        random_unit(n);
        random_unit(d);
        if (dot(d, n) > -1e-6)
            continue;
        const double sine = sqrt(fmax(0.0, 1.0 - dot(d, n) * dot(d, n)));
        double share, unused;
        if (!optics_refract(d, n, eta, out, &share)) {
            assert_true(eta * sine > 1.0 - 1e-12);
            assert_true(share == 1.0);
            total++;
            continue;
        }
        refracted++;
        assert_true(fabs(dot(out, out) - 1.0) < 1e-13);
        assert_true(dot(out, n) < 0.0);
        for (int a = 0; a < 3; a++) /* tangential parts */
            assert_true(fabs((out[a] - dot(out, n) * n[a]) - eta * (d[a] - dot(d, n) * n[a])) < 1e-14);
        for (int a = 0; a < 3; a++)
            reversed[a] = -out[a], turned[a] = -n[a];
        const double there = reflectance(reversed, turned, 1.0 / eta);
        assert_true(share >= 0.0 && share <= 1.0);
        if (dot(out, n) < -1e-3)
            assert_true(fabs(share - there) < 1e-9);
        if (optics_refract(reversed, turned, 1.0 / eta, back, &unused))
            for (int a = 0; a < 3; a++)
                assert_true(fabs(back[a] + d[a]) < 1e-7);
    }
    assert_true(total > 500 && refracted > 5000);
}

/* Known values: along the normal ((n1 - n2) / (n1 + n2))^2; Brewster's angle, where half of the polarisations is not
 * reflected at all; along the surface 1. */
/* Indices as far apart as floats: what is refracted at all has a direction, of unit length, by Snell's law. */
TEST(far_indices_leave_a_direction)
{
    const double n[3] = {0.6, 0.8, 0};
    for (int k = 0; k < 270; k++)
        for (int oblique = 0; oblique < (k < 40 ? 2 : 1); oblique++) { /* smaller angles are lost in d */
            const double eta = ldexp(1.5, k), sine = oblique ? 0.25 / eta : 0.0, beyond = oblique ? 0.25 : 0.0;
            const double d[3] = {-0.6 - 0.8 * sine, -0.8 + 0.6 * sine, 0};
            double out[3] = {0}, share;
            assert_true(optics_refract(d, n, eta, out, &share));
            assert_true(fabs(dot(out, out) - 1.0) < 1e-2 && dot(out, n) < -0.9);
            assert_true(fabs(out[0] * -0.8 + out[1] * 0.6 - beyond) < 1e-3);
        }
}

TEST(reflectance_is_fresnels)
{
    const double n[3] = {0, 0, 1}, straight[3] = {0, 0, -1};
    assert_true(fabs(reflectance(straight, n, 1.0 / 1.5) - 0.04) < 1e-15);
    assert_true(fabs(reflectance(straight, n, 1.5) - 0.04) < 1e-15);
    assert_true(reflectance(straight, n, 1.0) == 0.0);
    const double brewster = atan(1.5), d[3] = {sin(brewster), 0, -cos(brewster)};
    const double across = (1.0 - 1.5 * 1.5) / (1.0 + 1.5 * 1.5); /* at that angle */
    assert_true(fabs(reflectance(d, n, 1.0 / 1.5) - 0.5 * across * across) < 1e-14);
    const double along[3] = {1, 0, 0};
    assert_true(fabs(reflectance(along, n, 1.0 / 1.5) - 1.0) < 1e-15);
}

int main(void)
{
    test_begin("test_optics");
    random_state = random_make(1);
    return SUITE_RUN(NULL, NULL);
}

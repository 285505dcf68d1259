/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Verdicts of the exact oracle: every kind of wrong answer is detected, the interval of doubt has the right width, and
 * errors are measured. */
#include "support/test.h"

#include <float.h>
#include <math.h>

#include "support/oracle/oracle.h"

#include "oracle/oracle_input.h"

/* ---- verdicts ---- */

static oracle_verdict judge_id(const oracle_scene *scene, truth_ray ray, uint32_t id, oracle_hit *truth)
{
    return oracle_judge(scene, &ray, id, id == ORACLE_NONE ? ORACLE_NONE : 0, truth);
}

static void wrong_answers_are_told(void **state)
{
    (void)state;
    const oracle_primitive all[] = {sphere_of(0, 0, 0, 9, 1), plane_at(1, 7), plane_at(2, 7),
                                    sphere_of(3, 0, 50, 0, 1)};
    const oracle_scene scene = {.primitive = all, .count = TEST_COUNT(all)};
    const truth_ray hit = ray_of(0, 0, 0, 0, 0, 1), miss = ray_of(0, 0, 0, 0, 0, -1);
    oracle_hit truth;
    assert_int_equal(judge_id(&scene, hit, 1, &truth), ORACLE_RIGHT);
    assert_true(truth.index == 1 && truth.t == 7);
    assert_int_equal(judge_id(&scene, hit, ORACLE_NONE, &truth), ORACLE_MISSED);
    assert_true(truth.index == 1 && truth.t == 7);
    assert_int_equal(judge_id(&scene, hit, 0, &truth), ORACLE_WRONG); /* farther */
    assert_int_equal(judge_id(&scene, hit, 2, &truth), ORACLE_WRONG); /* at the same t, with a higher id */
    assert_int_equal(judge_id(&scene, hit, 3, &truth), ORACLE_WRONG); /* not hit */
    assert_int_equal(judge_id(&scene, hit, 9, &truth), ORACLE_WRONG); /* no such primitive */
    assert_int_equal(oracle_judge(&scene, &hit, 1, 1, &truth), ORACLE_WRONG);
    assert_int_equal(judge_id(&scene, miss, ORACLE_NONE, &truth), ORACLE_RIGHT);
    for (uint32_t id = 0; id < 5; id++)
        assert_int_equal(judge_id(&scene, miss, id, &truth), ORACLE_INVENTED);
    assert_true(truth.index == ORACLE_NONE);
    assert_int_equal(judge_id(&scene, ray_of(0, 0, 0, 0, 0, 0), 1, &truth), ORACLE_INVENTED);
    assert_int_equal(judge_id(&scene, ray_of(0, 0, 0, 0, NAN, 1), ORACLE_NONE, &truth), ORACLE_RIGHT);
}

/* Both answers are right within 2^-6 ulp of the point where the end of the range rounds, but no further away. */
static void doubt_at_the_ends(void **state)
{
    (void)state;
    const oracle_primitive all[] = {plane_at(0, 1), plane_at(1, 1.5f)};
    const oracle_scene scene = {.primitive = all, .count = 2};
    for (int sign = -1; sign <= 1; sign += 2)
        for (int bits = 27; bits <= 33; bits++) { /* 1 + 2^-24 is where t_max = 1 ends; its ulp is 2^-23 */
            truth_ray ray = ray_of(0, 0, 0, 0, 0, 1);
            oracle_hit truth;
            const bool doubt = bits > 29;
            ray.org[2] = -(0x1p-24f + (float)sign * ldexpf(1, -bits));
            ray.t_max = 1;
            const bool inside = sign < 0;
            assert_true(is_hit(all[0], ray) == inside);
            assert_int_equal(judge_id(&scene, ray, 0, &truth), inside || doubt ? ORACLE_RIGHT : ORACLE_INVENTED);
            assert_int_equal(truth.index, inside || doubt ? 0 : ORACLE_NONE);
            assert_int_equal(judge_id(&scene, ray, ORACLE_NONE, &truth),
                             !inside || doubt ? ORACLE_RIGHT : ORACLE_MISSED);
            assert_int_equal(judge_id(&scene, ray, 1, &truth), inside ? ORACLE_WRONG : ORACLE_INVENTED);
            ray.t_max = INFINITY; /* the same at the beginning of a range that contains a second hit */
            ray.t_min = nextafterf(1, 2);
            assert_int_equal(judge_id(&scene, ray, 0, &truth), !inside || doubt ? ORACLE_RIGHT : ORACLE_WRONG);
            assert_int_equal(judge_id(&scene, ray, 1, &truth), inside || doubt ? ORACLE_RIGHT : ORACLE_WRONG);
            assert_int_equal(judge_id(&scene, ray, ORACLE_NONE, &truth), ORACLE_MISSED);
        }
}

/* ---- errors ---- */

static void errors_are_measured(void **state)
{
    (void)state;
    assert_true(oracle_ulp(1, 1) == 0 && oracle_ulp(1, nextafterf(1, 2)) == 1 &&
                oracle_ulp(1, nextafterf(1, 0)) == 0.5);
    assert_true(oracle_ulp(-1.5, -1.5f + 0x1p-22f) == 2 && oracle_ulp((truth_real)1 + 0x1p-25, 1) == 0.25);
    assert_true(oracle_ulp((truth_real)0x1p-150, 0) == 0.5 && oracle_ulp(0, 0x1p-149f) == 1);
    assert_true(oracle_ulp(FLT_MAX, nextafterf(FLT_MAX, 0)) == 1 && oracle_ulp(0, 1) == 0x1p149);
    assert_true(oracle_ulp(1, INFINITY) == INFINITY && oracle_ulp(1, NAN) == INFINITY);
    const truth_real z[3] = {0, 0, 1};
    assert_true(oracle_angle(z, (float[3]){0, 0, 3}) == 0);
    assert_true(fabs(oracle_angle(z, (float[3]){0, 2, 0}) - acos(0)) < 1e-15);
    assert_true(fabs(oracle_angle(z, (float[3]){0, 0, -1}) - acos(-1)) < 1e-15);
    assert_true(fabs(oracle_angle(z, (float[3]){0x1p-24f, 0, 1}) - 0x1p-24) < 1e-20);
    assert_true(oracle_angle(z, (float[3]){0, 0, 0}) == INFINITY && oracle_angle(z, (float[3]){0, NAN, 1}) == INFINITY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_answers_are_told),
        cmocka_unit_test(doubt_at_the_ends),
        cmocka_unit_test(errors_are_measured),
    };
    test_begin("test_oracle_verdicts");
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The tests of FAST in one variant. With CGT_SPU_EXACT everything runs in the SPU's arithmetic, including the setup of
 * each primitive. */
#include "accuracy/accuracy_kernel.h"

#include <math.h>

#include "papers/kernel/packet/sphere_filter.h"
#include "papers/kernel/packet/triangle_fast.h"

#ifdef CGT_SPU_EXACT
#define KERNEL_NAME(variant) KERNEL_JOIN(variant, _spu)
#else
#define KERNEL_NAME(variant) KERNEL_JOIN(variant, )
#endif
#define KERNEL_JOIN(variant, suffix) KERNEL_JOIN_(variant, suffix)
#define KERNEL_JOIN_(variant, suffix) accuracy_kernel_##variant##suffix

/* Not inlined, so that no arithmetic moves into or out of the SPU's mode. */
#define APART static __attribute__((noinline))

APART void make_packet(const accuracy_work *work, packet *p)
{
    memset(p, 0, sizeof *p);
    for (uint32_t i = 0; i < ACCURACY_RAYS; i++) {
        float square = 0;
        for (int a = 0; a < 3; a++) {
            p->org[a][i] = work->org[a];
            p->dir[a][i] = work->dir[i][a];
            square += work->dir[i][a] * work->dir[i][a];
        }
        p->rdd[i] = 1 / square;
        p->t_max[i] = p->low[i] = p->high[i] = INFINITY;
        p->prim[i] = CGT_INVALID_ID;
    }
    p->rays = p->lanes = ACCURACY_RAYS;
    p->common_origin = p->from_origin = p->fast = true;
}

/* One primitive against all rays. */
CGT_SPU_INLINE void test_rays(const packet *p, filter_test *test, const void *primitive, float *t)
{
    const vfloat none = spux_vfloat(INFINITY);
    for (uint32_t i = 0; i < ACCURACY_RAYS; i += CGT_LANES) {
        filter_result f;
        const bool any = test(p, primitive, i, true, &f);
        spux_store(t + i, any ? spux_select(none, f.low, f.certain_hit) : none);
    }
}

APART void test_spheres(const accuracy_work *work, const packet *p, const filter_packet *of_packet)
{
    filter_spheres s;
    for (uint32_t first = 0; first < work->primitives; first += CGT_LANES) {
        for (uint32_t k = 0; k < CGT_LANES; k++) {
            for (int a = 0; a < 3; a++)
                s.center[a][k] = work->primitive[first + k][a];
            s.radius[k] = work->primitive[first + k][3];
            s.prim[k] = 0;
        }
        filter_spheres_bound(of_packet, &s);
        for (uint32_t k = 0; k < CGT_LANES; k++) {
            filter_sphere q = filter_sphere_get(p, &s, (int)k, true);
            q.r2 = spux_vfloat(s.radius[k] * s.radius[k]);
            test_rays(p, filter_sphere_rays_fast, &q, work->t + (size_t)(first + k) * ACCURACY_RAYS);
        }
    }
}

APART void test_triangles(const accuracy_work *work, const packet *p, const filter_packet *of_packet)
{
    filter_triangles s;
    for (uint32_t first = 0; first < work->primitives; first += CGT_LANES) {
        for (uint32_t k = 0; k < CGT_LANES; k++) {
            for (int i = 0; i < 9; i++)
                s.vertex[i / 3][i % 3][k] = work->primitive[first + k][i];
            s.prim[k] = 0;
        }
        if (work->test == ACCURACY_WATERTIGHT)
            filter_triangles_bound(of_packet, &s);
        for (uint32_t k = 0; k < CGT_LANES; k++) {
            float *t = work->t + (size_t)(first + k) * ACCURACY_RAYS;
            if (work->test == ACCURACY_WATERTIGHT) {
                const filter_triangle q = filter_triangle_get(of_packet, &s, (int)k, true);
                test_rays(p, filter_triangle_rays_fast, &q, t);
            } else if (work->test == ACCURACY_MOLLER_TRUMBORE) {
                const moller_trumbore_triangle q = moller_trumbore_get(&s, (int)k);
                test_rays(p, moller_trumbore_rays, &q, t);
            } else {
                const accelerated_triangle q = accelerated_get(&s, (int)k);
                test_rays(p, accelerated_rays, &q, t);
            }
        }
    }
}

APART void prepare(const packet *p, filter_packet *of_packet) { filter_packet_init(p, 1, of_packet); }

void KERNEL_NAME(CGT_VARIANT)(const accuracy_work *work);
void KERNEL_NAME(CGT_VARIANT)(const accuracy_work *work)
{
    packet p;
    filter_packet of_packet;
    make_packet(work, &p);
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    prepare(&p, &of_packet);
    if (work->test == ACCURACY_SPHERE)
        test_spheres(work, &p, &of_packet);
    else
        test_triangles(work, &p, &of_packet);
    cgt_spu_leave_arithmetic(saved);
}

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * t, u and normals of the rays that hit capsules, a vector at a time: those that enter from outside, where double tells
 * at which part, and is safe. The rest is computed ray by ray. The terms are those of capsule_double.h, by the same
 * text, and the ends are spheres (resolve_spheres.h). In precision FAST too. */
#ifndef CGT_RESOLVE_CAPSULES_H
#define CGT_RESOLVE_CAPSULES_H

#include "exact/capsule_double.h"
#include "exact/decide_capsule.h"
#include "kernel/resolve/resolve_spheres.h"
#include "kernel/resolve/resolve_triangles.h"

#define CAPSULE_NAME(name) resolve_capsule_##name
#define CAPSULE_REAL vdouble
#define CAPSULE_ABS(x) spux_double_abs(x)
#define CAPSULE_ROOT(x) spux_double_sqrt(x)
#define CAPSULE_LESS(x, y) spux_double_select(x, y, (x) - (y))
#include "exact/capsule_terms.h"
#undef CAPSULE_NAME
#undef CAPSULE_REAL
#undef CAPSULE_ABS
#undef CAPSULE_ROOT
#undef CAPSULE_LESS

/* The fields of hits; v is 0. */
typedef struct resolved_capsules {
    vfloat t, u, normal[3];
} resolved_capsules;

typedef struct resolved_capsule {
    float t, u, normal[3];
} resolved_capsule;

/* A ray with a value that suffers from cancellation, that leaves the capsule, or whose capsule has no length or
 * radius. */
__attribute__((noinline, unused)) static resolved_capsule resolve_capsule_ray(const cgt_ray *ray, const cgt_capsule *q)
{
    resolved_capsule h;
    cgt_capsule_part part;
    bool far;
    const double t = cgt_canonical_capsule_t(ray, q, &far, &part);
    h.t = (float)t;
    h.u = cgt_canonical_capsule_u(ray, q, far, part);
    cgt_canonical_capsule_normal(ray, q, t, part, h.normal);
    return h;
}

/* Lanes whose value is certainly above, and below, the bound of its error. */
typedef struct resolve_signs {
    vmask above, below;
} resolve_signs;

CGT_SPU_INLINE resolve_signs resolve_certain_signs(const vdouble value[2], const vdouble error[2])
{
    const vdouble minus[2] = {-value[0], -value[1]};
    return (resolve_signs){spux_double_cmpgt(value, error), spux_double_cmpgt(minus, error)};
}

CGT_SPU_INLINE resolve_signs resolve_select_signs(resolve_signs a, resolve_signs b, vmask m)
{
    return (resolve_signs){spu_or(spu_andc(a.above, m), spu_and(b.above, m)),
                           spu_or(spu_andc(a.below, m), spu_and(b.below, m))};
}

CGT_SPU_INLINE resolve_signs resolve_turned(resolve_signs a) { return (resolve_signs){a.below, a.above}; }

/* Lanes that certainly enter at the side, at p, and at q. */
typedef struct resolve_parts {
    vmask side, p, q;
} resolve_parts;

/* As entered_part of decide_capsule.c. */
CGT_SPU_INLINE resolve_parts resolve_entered_parts(const resolve_capsule_terms e[2], const resolve_capsule_end p[2],
                                                   const resolve_capsule_end q[2])
{
    const vdouble zero[2] = {spux_vdouble(0), spux_vdouble(0)}, dn[2] = {e[0].dn, e[1].dn};
    const vdouble lean[2] = {spux_double_abs(dn[0]), spux_double_abs(dn[1])};
    const vdouble lean_error[2] = {resolve_capsule_dn_error(&e[0]), resolve_capsule_dn_error(&e[1])};
    const vdouble x[2][2] = {{p[0].x, p[1].x}, {q[0].x, q[1].x}}, s[2][2] = {{p[0].q, p[1].q}, {q[0].q, q[1].q}};
    const vdouble x_error[2][2] = {{p[0].x_error, p[1].x_error}, {q[0].x_error, q[1].x_error}};
    const vdouble s_error[2][2] = {{p[0].q_error, p[1].q_error}, {q[0].q_error, q[1].q_error}};
    const vmask from_q = spux_double_cmpgt(zero, dn), known = spux_double_cmpgt(lean, lean_error);
    const resolve_signs x_p = resolve_certain_signs(x[0], x_error[0]), x_q = resolve_certain_signs(x[1], x_error[1]);
    const resolve_signs s_p = resolve_certain_signs(s[0], s_error[0]), s_q = resolve_certain_signs(s[1], s_error[1]);
    const resolve_signs first_x = resolve_select_signs(x_p, resolve_turned(x_q), from_q),
                        last_x = resolve_select_signs(x_q, resolve_turned(x_p), from_q),
                        first_s = resolve_select_signs(s_p, s_q, from_q),
                        last_s = resolve_select_signs(s_q, s_p, from_q);
    const vmask usable = spu_or(known, spu_and(first_s.above, last_s.above));
    const vmask first = spu_and(usable, spu_or(first_s.below, first_x.below));
    const vmask behind = spu_and(usable, spu_and(first_s.above, first_x.above));
    const vmask last = spu_and(behind, spu_and(last_s.above, last_x.above));
    return (resolve_parts){.side = spu_and(behind, spu_or(last_s.below, last_x.below)),
                           .p = spu_or(spu_andc(first, from_q), spu_and(last, from_q)),
                           .q = spu_or(spu_and(first, from_q), spu_andc(last, from_q))};
}

/* The side's values, in double; *safe: the lanes where they are right. */
CGT_SPU_INLINE void resolve_capsule_side(const resolve_capsule_terms e[2], const resolve_capsule_end p[2],
                                         uint32_t fields, resolved_capsules *to, vmask *safe)
{
    vdouble t[2], margin[2], form[2], normal[2][3], u[2], u_margin[2], u_form[2];
    const vdouble zero[2] = {spux_vdouble(0), spux_vdouble(0)};
    for (int i = 0; i < 2; i++) {
        const resolve_capsule_value root = resolve_capsule_root(&e[i], false);
        t[i] = spux_double_select(root.sum, root.other, e[i].middle);
        margin[i] = root.margin;
        form[i] = spux_double_select(root.sum_margin, root.other_margin, e[i].middle);
    }
    to->t = spux_float_of(t[0], t[1]);
    *safe = spu_and(spux_double_cmpgt(margin, zero), spux_double_cmpgt(form, zero));
    if (fields & CGT_FIELD_NORMAL) {
        for (int i = 0; i < 2; i++)
            resolve_capsule_normal(&e[i], t[i], normal[i]);
        for (int a = 0; a < 3; a++)
            to->normal[a] = spux_float_of(normal[0][a], normal[1][a]);
    }
    if (!(fields & CGT_FIELD_UV))
        return;
    for (int i = 0; i < 2; i++) {
        vdouble lean;
        const resolve_capsule_value share = resolve_capsule_share(&e[i], &p[i], false, &lean);
        const vdouble agree = p[i].x * lean;
        u[i] = spux_double_select(share.other, share.sum, agree);
        u_margin[i] = share.margin;
        u_form[i] = spux_double_select(share.other_margin, share.sum_margin, agree);
    }
    to->u = shares_of(u[0], u[1]);
    *safe = spu_and(*safe, spu_and(spux_double_cmpgt(u_margin, zero), spux_double_cmpgt(u_form, zero)));
}

/* The values at the ends: of spheres. They replace those of their lanes. */
__attribute__((noinline, unused)) static void resolve_capsule_ends(const vfloat org[3], const vfloat dir[3],
                                                                   const vfloat sphere[4], bool normal, vmask ends,
                                                                   resolved_capsules *to, vmask *safe)
{
    resolve_half h[2];
    vfloat t, n[3];
    const vfloat any = spux_vfloat(-INFINITY); /* which root it is was decided */
    resolve_directions(dir, h);
    const vmask short_lanes = resolve_spheres_vector(org, sphere, any, normal, ends, h, &t, n);
    const vmask right = resolve_spheres_fallback(org, dir, sphere, any, normal, ends, short_lanes, &t, n);
    to->t = spux_select(to->t, t, ends);
    for (int a = 0; normal && a < 3; a++)
        to->normal[a] = spux_select(to->normal[a], n[a], ends);
    *safe = spu_or(spu_andc(*safe, ends), spu_and(right, ends));
}

CGT_SPU_INLINE void resolve_capsule_half(const vfloat from[3], int i, vdouble to[3])
{
    for (int a = 0; a < 3; a++)
        to[a] = i ? spux_double_high(from[a]) : spux_double_low(from[a]);
}

/* Returns the lanes of `hit` whose result is right; the others are left to resolve_capsule_ray. */
CGT_SPU_INLINE vmask resolve_capsules_vector(const vfloat org[3], const vfloat dir[3], const vfloat p[3],
                                             const vfloat q[3], vfloat radius, vfloat t_min, uint32_t fields, vmask hit,
                                             resolved_capsules *to)
{
    resolve_capsule_terms e[2];
    resolve_capsule_end at_p[2], at_q[2];
    for (int i = 0; i < 2; i++) {
        vdouble o[3], d[3], first[3], last[3], c[3];
        resolve_capsule_half(org, i, o);
        resolve_capsule_half(dir, i, d);
        resolve_capsule_half(p, i, first);
        resolve_capsule_half(q, i, last);
        resolve_capsule_init(&e[i], o, d, first, last, i ? spux_double_high(radius) : spux_double_low(radius));
        for (int a = 0; a < 3; a++)
            c[a] = last[a] - o[a];
        at_p[i] = resolve_capsule_at_end(&e[i], e[i].c);
        at_q[i] = resolve_capsule_at_end(&e[i], c);
    }
    const resolve_parts part = resolve_entered_parts(e, at_p, at_q);
    const vmask ends = spu_and(hit, spu_or(part.p, part.q));
    vmask safe;
    resolve_capsule_side(e, at_p, fields, to, &safe);
    safe = spu_and(safe, spu_and(hit, part.side));
    if (spux_any(ends)) {
        const vfloat sphere[4] = {spux_select(p[0], q[0], part.q), spux_select(p[1], q[1], part.q),
                                  spux_select(p[2], q[2], part.q), radius};
        resolve_capsule_ends(org, dir, sphere, fields & CGT_FIELD_NORMAL, ends, to, &safe);
        to->u = spux_select(to->u, spux_select(spux_vfloat(0), spux_vfloat(1), part.q), ends);
    }
    const vmask ahead = spu_and(spu_cmpgt(to->t, spux_vfloat(0)), spux_cmpge(to->t, t_min));
    return spu_and(safe, spu_and(ahead, spu_cmpgt(radius, spux_vfloat(0))));
}

#endif

/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What light does at a smooth surface, in double: reflection, refraction (Snell), Fresnel's reflectance. Directions and
 * normals are unit vectors; the normal points to the side that the light comes from: dot(direction, normal) <= 0. */
#ifndef OPTICS_H
#define OPTICS_H

/* out = d mirrored at the surface. */
void optics_reflect(const double d[3], const double n[3], double out[3]);

/* Refracts d. eta: index of the medium that it leaves over that of the one it enters. Returns 1, or 0 where all light is
 * reflected: out is then not set. */
int optics_refract(const double d[3], const double n[3], double eta, double out[3]);

/* The share of unpolarised light that is reflected, 0 to 1; 1 where all of it is. eta as above. */
double optics_reflectance(const double d[3], const double n[3], double eta);

#endif

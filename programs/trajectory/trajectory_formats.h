/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The readers of spheres, a row for each. Help, messages and completion take their words from here, so that a new
 * reader is a file with its trajectory_format, and a row. Columns: the name of its trajectory_format; the name for
 * --format, and others that do; the endings that help tells, and others that are known. <cgt/trajectory.h> says what is
 * read of each. */
#ifndef TRAJECTORY_FORMATS_H
#define TRAJECTORY_FORMATS_H

#define TRAJECTORY_READERS(FIRST, NEXT)                                                                                \
    FIRST(lammps, "lammps", "lammpstrj, dump", ".lammpstrj, .dump", "")                                                \
    NEXT(lammps_binary, "lammps-binary", "", ".bin", ".lammpsbin")                                                     \
    NEXT(lammps_data, "lammps-data", "", ".data", ".lmpdat")                                                           \
    NEXT(xyz, "xyz", "extxyz", ".xyz, .extxyz", "")                                                                    \
    NEXT(gro, "gro", "", ".gro", "")                                                                                   \
    NEXT(xtc, "xtc", "", ".xtc", "")                                                                                   \
    NEXT(trr, "trr", "", ".trr", "")                                                                                   \
    NEXT(pdb, "pdb", "", ".pdb", ".ent")                                                                               \
    NEXT(mmcif, "mmcif", "cif", ".cif", ".mmcif")                                                                      \
    NEXT(dcd, "dcd", "", ".dcd", "")                                                                                   \
    NEXT(netcdf, "netcdf", "nc", ".nc", ".ncdf, .ncrst")                                                               \
    NEXT(gsd, "gsd", "", ".gsd", "")                                                                                   \
    NEXT(vasp, "vasp", "poscar, contcar, xdatcar", ".vasp", ".poscar, .contcar, .xdatcar")                             \
    NEXT(vtk, "vtk", "", ".vtk", "")                                                                                   \
    NEXT(psf, "psf", "", ".psf", "")                                                                                   \
    NEXT(prmtop, "prmtop", "parm7", ".prmtop", ".parm7")                                                               \
    NEXT(top, "top", "", ".top", ".itp")                                                                               \
    NEXT(frames, "frames", "", ".frames", "")

/* For help and messages: "lammps, lammps-binary, ..." and ".lammpstrj, .dump, ...". */
#define TRAJECTORY_NAME(format, name, names, told, known) name
#define TRAJECTORY_NEXT_NAME(format, name, names, told, known) ", " name
#define TRAJECTORY_TOLD(format, name, names, told, known) told
#define TRAJECTORY_NEXT_TOLD(format, name, names, told, known) ", " told
#define TRAJECTORY_FORMATS TRAJECTORY_READERS(TRAJECTORY_NAME, TRAJECTORY_NEXT_NAME)
#define TRAJECTORY_ENDINGS TRAJECTORY_READERS(TRAJECTORY_TOLD, TRAJECTORY_NEXT_TOLD)

#endif

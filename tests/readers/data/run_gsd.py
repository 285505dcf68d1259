# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Writes run.gsd with GSD's own module (Debian 12, package python3-gsd): python3 run_gsd.py
import gsd.hoomd
import numpy

with gsd.hoomd.open('run.gsd', 'wb') as f:
    for k in range(3):
        s = gsd.hoomd.Snapshot()
        s.configuration.step = 100 * k
        s.configuration.box = [10, 9, 8, 0.1, -0.2, 0.3]
        s.particles.N = 4 if k < 2 else 3
        s.particles.position = [[i, 0.5 * k, -i] for i in range(s.particles.N)]
        s.particles.velocity = [[k, i, 0.25] for i in range(s.particles.N)]
        s.bonds.N = 2 if k < 2 else 0
        if k == 0:  # frame 1 has what differs from this, frame 2 defaults, since its number is another
            s.particles.types = ['A', 'poly']
            s.particles.typeid = [0, 1, 1, 0]
            s.particles.diameter = [1, 2, 3, 4]
            s.particles.image = [[0, 0, -1]] * 4
            s.bonds.types = ['b']
            s.bonds.typeid = [0, 0]
            s.bonds.group = [[0, 1], [3, 2]]
        s.log['particles/energy'] = numpy.array([0.5 * i + k for i in range(s.particles.N)])
        f.append(s)

# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Files as pictures, in a line each: the last line of a notebook's cell shows them without `save`."""
import os
import sys

import numpy as np

try:
    from cgt import read, show
except ImportError as error:
    print(f"left out: {error}")
    sys.exit(77)

folder = sys.argv[1] if len(sys.argv) > 1 else "."
data = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "data")

with read(os.path.join(data, "caffeine.xyz")) as molecules:
    frame = molecules[0]
    show(frame, outline=1.5, width=480, height=360).save(os.path.join(folder, "show_a_file_molecule.png"))
    distances = np.linalg.norm(frame.positions[:, None] - frame.positions, axis=-1)
    pairs = np.argwhere(np.triu(distances < 1.6, 1))  # the file has no bonds
    picture = show(frame, 0.35, bonds=pairs, bond_radius=0.13, outline=1.5, width=480, height=360)
    picture.save(os.path.join(folder, "show_a_file_sticks.png"))

with read(os.path.join(data, "pour2k.lammpstrj")) as run:
    for frame in run[::25]:
        if len(frame):
            picture = show(frame, width=480, height=270, ambient=16)
            picture.save(os.path.join(folder, f"show_a_file_{frame.number:02}.png"))

# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Files as pictures, in a line each: the last line of a notebook's cell shows them without `save`."""
import os
import sys

try:
    from cgt import Figure, read, show
except ImportError as error:
    print(f"left out: {error}")
    sys.exit(77)

folder = sys.argv[1] if len(sys.argv) > 1 else "."
data = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "data")

with read(os.path.join(data, "caffeine.xyz"), all_bonds=True) as molecules:
    frame = molecules[0]
    show(frame, outline=1.5, size=(480, 360)).save(os.path.join(folder, "show_a_file_molecule.png"))
    figure = show(frame, bonds=True, radius_scale=0.25, style="paper", size=(480, 360))
    figure.save(os.path.join(folder, "show_a_file_sticks.png"))

with read(os.path.join(data, "pour2k.lammpstrj")) as run:
    figure = Figure(size=(480, 270), color="speed", colorbar="speed", box=True).survey(run)  # one camera, one scale
    for frame in run[::25]:
        if len(frame):
            figure.show(frame).save(os.path.join(folder, f"show_a_file_{frame.number:02}.png"))

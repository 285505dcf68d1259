# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Structures of the papers: the work that each pixel's tile costs, and that all of them find the same hits."""
import numpy as np

import cgt
import cgt.research
import png

rng = np.random.default_rng(5)
centers, radii = rng.normal(scale=0.6, size=(20000, 3)).astype("f4"), rng.uniform(0.005, 0.03, 20000).astype("f4")
pictures = {}
for structure in ("loose_grid", "queue_grid", "kd", "kd_ropes", "bih", "bvh"):
    scene = cgt.Scene(structure=structure)
    scene.add(cgt.Spheres(centers, radii))
    scene.commit()
    options = cgt.research.TraceOptions()
    frame = scene.trace_camera(cgt.Camera((0, 0, 4), fov=40), 320, 320, ("t", "normal"), statistics=True,
                               research=options)
    counts = options.statistics
    print(f"{structure:10}  {scene.statistics.structure_bytes >> 10:5} KB  {frame.statistics.ray_tests:10,} tests"
          f"  {counts.nodes:10,} nodes  {counts.cells:8,} cells")
    pictures[structure] = frame.t.tobytes() + frame.normal.tobytes()
assert len(set(pictures.values())) == 1, "structures differ"
png.write("structures.png", np.where(frame.hit, 0.1 + 0.9 * np.clip(frame.normal[..., 2], 0, 1) ** 2, 0.9))

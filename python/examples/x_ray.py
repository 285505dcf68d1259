# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""All hits along rays: the length of each pixel's ray in matter, as an X-ray picture of a packing has it."""
import numpy as np

import cgt
import png

rng = np.random.default_rng(3)
scene = cgt.Scene(rays="incoherent")
scene.add(cgt.Spheres(rng.normal(scale=0.5, size=(1500, 3)), rng.uniform(0.04, 0.12, 1500)))
scene.commit()
org, dir = cgt.camera_rays(cgt.Camera((0, 0, 5), fov=35), 320, 320)
dir /= np.linalg.norm(dir, axis=-1, keepdims=True)  # t is then a length
hits = scene.trace_all_rays(org.reshape(-1, 3), dir.reshape(-1, 3), ("t", "surface"))
depth = np.bincount(hits.ray, weights=np.where(hits.surface == 1, hits.t, -hits.t), minlength=320 * 320)
png.write("x_ray.png", np.exp(-2.5 * depth).reshape(320, 320))

# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""A mesh that moves: 100,000 triangles of a cloth, its normals as an array of (height, width, 3), without a copy."""
import numpy as np

import cgt
import png

n = 224
u, w = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n), indexing="ij")
i, j = (a.ravel() for a in np.meshgrid(np.arange(n - 1), np.arange(n - 1), indexing="ij"))
corner = i * n + j
faces = np.concatenate([np.stack([corner, corner + 1, corner + n], 1),
                        np.stack([corner + 1, corner + n + 1, corner + n], 1)]).astype("u4")
vertices = np.zeros((n * n, 3), "f4")  # float32: traced where it lies

camera = cgt.Camera((1.6, 1.5, 2.0), fov=46)
scene = cgt.Scene()
scene.add(cgt.Triangles(vertices, faces))
scene.commit()
frame = scene.trace_camera(camera, 480, 360, ("t", "normal"))
for step in range(8):
    wave = 0.12 * np.sin(5 * u + 0.5 * step) + 0.08 * np.sin(7 * w - 0.4 * step)
    vertices[:] = np.stack([u.ravel(), wave.ravel(), w.ravel()], 1)
    scene.commit()
    frame = scene.trace_camera(camera, 480, 360, ("t", "normal"), out=frame.arrays)
facing = np.abs(frame.normal @ np.array((0.4, 0.8, 0.45), "f4"))
png.write("waving_mesh.png", np.where(frame.hit[..., None], facing[..., None] * (0.9, 0.45, 0.2), 0.9))

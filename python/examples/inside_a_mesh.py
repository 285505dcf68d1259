# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Points inside of a closed mesh by the intersector with trimesh's interface: slices through a knot of tubes."""
from types import SimpleNamespace

import numpy as np

import cgt.trimesh
import png

turns, around = 400, 48
a = np.linspace(0, 2 * np.pi, turns, endpoint=False)[:, None]
b = np.linspace(0, 2 * np.pi, around, endpoint=False)[None]
path = np.stack([np.sin(a) + 2 * np.sin(2 * a), np.cos(a) - 2 * np.cos(2 * a), -np.sin(3 * a)], -1)
along = np.roll(path, -1, 0) - np.roll(path, 1, 0)
side = np.cross(along, (0, 0, 1.0))
side /= np.linalg.norm(side, axis=-1, keepdims=True)
over = np.cross(along, side)
over /= np.linalg.norm(over, axis=-1, keepdims=True)
vertices = path + 0.45 * (np.cos(b)[..., None] * side + np.sin(b)[..., None] * over)
k, m = np.meshgrid(np.arange(turns), np.arange(around), indexing="ij")
quad = [(k * around + m), ((k + 1) % turns * around + m), ((k + 1) % turns * around + (m + 1) % around),
        (k * around + (m + 1) % around)]
faces = np.concatenate([np.stack([quad[0], quad[1], quad[2]], -1).reshape(-1, 3),
                        np.stack([quad[0], quad[2], quad[3]], -1).reshape(-1, 3)])
mesh = SimpleNamespace(vertices=vertices.reshape(-1, 3), faces=faces)
rays = cgt.trimesh.RayMeshIntersector(mesh)

x, y = np.meshgrid(np.linspace(-3.6, 3.6, 200), np.linspace(3.6, -3.6, 200))
slices = []
for z in (-0.9, 0.0, 0.9):
    points = np.stack([x, y, np.full_like(x, z)], -1).reshape(-1, 3)
    slices.append(rays.contains_points(points).reshape(x.shape))
png.write("inside_a_mesh.png", np.where(np.stack(slices, -1), (0.85, 0.4, 0.2), 0.03))

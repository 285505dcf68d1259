# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""A simulation that draws itself: grains in doubles fall on a floor, with the sun's shadow and occlusion."""
import numpy as np

import cgt
import png

rng = np.random.default_rng(1)
x = rng.uniform((-2, 0.2, -2), (2, 5, 2), (3000, 3))
v, radius = np.zeros_like(x), rng.uniform(0.05, 0.12, len(x))
floor = np.array([[-50, 0, -50], [50, 0, -50], [0, 0, 100.0]])
camera, sun = cgt.Camera((5, 6, 12), (0, 1.8, 0), fov=32), cgt.Light((2, 3, 1), "directional")

with cgt.Scene() as scene:
    grains = scene.add(cgt.Spheres(x, radius))
    scene.add(cgt.Triangles(floor, [[0, 2, 1]]))
    for frame_number in range(3):
        for _ in range(12):  # steps of the simulation, in place
            v[:, 1] -= 9.81 * 0.01
            x += 0.01 * v
            below = x[:, 1] < radius
            x[below, 1], v[below, 1] = radius[below], -0.4 * v[below, 1]
        scene.commit()  # reads x where it is
        frame = scene.trace_camera(camera, 480, 360, ("t", "primitive", "geometry", "normal"))
        lit = ~scene.occluded_frame(frame, sun)[0]
        sky = scene.ambient_occlusion(frame, 32, radius=1.0)
        cosine = np.clip(frame.normal @ np.array(sun.position) / np.linalg.norm(sun.position), 0, 1)
        of_grain = frame.hit & (frame.geometry == grains)
        colour = np.full(frame.shape + (3,), 0.7)
        height = np.clip(x[frame.primitive[of_grain], 1] / 4, 0, 1)[:, None]
        colour[of_grain] = (1 - height) * (0.75, 0.3, 0.1) + height * (0.1, 0.35, 0.75)
        picture = colour * (0.35 * sky + 0.75 * cosine * lit)[..., None]
        picture[~frame.hit] = 0.8
        png.write(f"falling_grains_{frame_number}.png", picture)

# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Mirrors and glass: a glass ball before a chequered floor, eight bounces, each a whole array of rays at once."""
import numpy as np

import cgt
import png

WIDTH, HEIGHT = 400, 300
scene = cgt.Scene(rays="incoherent")
ball = scene.add(cgt.Spheres([[0.0, 1, 0], [-1.4, 0.5, -1.2]], np.array([1, 0.5])))
floor = scene.add(cgt.Triangles([[-200.0, 0, -200], [0.0, 0, 200], [200.0, 0, -200]]))
scene.commit()

org, dir = (a.reshape(-1, 3) for a in cgt.camera_rays(cgt.Camera((0, 1.6, 5), (0, 0.8, 0), fov=38), WIDTH, HEIGHT))
pixel, weight = np.arange(len(org)), np.ones(len(org))
picture = np.zeros((len(org), 3))
none = np.full(len(org), cgt.INVALID_ID, "u4")
rays = cgt.Fields({"org": org, "dir": dir, "skip_primitive": none, "skip_geometry": none})
hits = scene.trace_rays(org, dir, ("t", "primitive", "geometry"))
for bounce in range(8):
    on_floor = hits.geometry == floor
    place = rays.org + np.where(on_floor, hits.t, 0)[:, None] * rays.dir
    chequer = (np.floor(place[:, 0]) + np.floor(place[:, 2])) % 2
    haze = np.exp(-0.04 * np.linalg.norm(place, axis=-1))[:, None]
    rise = np.clip(rays.dir[:, 1] / np.linalg.norm(rays.dir, axis=-1), 0, 1)[:, None]
    sky = (1 - rise) * (0.75, 0.85, 0.95) + rise * (0.15, 0.35, 0.7)
    tile = haze * (0.1 + 0.7 * chequer[:, None]) + (1 - haze) * (0.75, 0.85, 0.95)
    ends = hits.geometry != ball
    light = np.where(on_floor[:, None], tile, sky)
    np.add.at(picture, pixel[ends], (weight[:, None] * light)[ends])
    of_ball = np.where(ends, 0, 1.5).astype("f4")  # the floor is opaque
    both = scene.bounce_rays(rays.org, rays.dir, hits, inside_of_ray=np.where(ends, 1, of_ball),
                             skip_primitive=rays.skip_primitive, skip_geometry=rays.skip_geometry)[:2]
    parts = [(r, (r.share * weight > 0.002) & ~ends) for r in both]
    pixel = np.concatenate([pixel[keep] for _, keep in parts])
    weight = np.concatenate([(weight * r.share)[keep] for r, keep in parts])
    rays = cgt.Fields({name: np.concatenate([r[name][keep] for r, keep in parts]) for name in both[0].keys()})
    if not len(pixel):
        break
    hits = scene.trace_bounced_rays(rays)
png.write("glass_ball.png", picture.reshape(HEIGHT, WIDTH, 3))

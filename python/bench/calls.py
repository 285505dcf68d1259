# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""How long calls take from Python, beside the library's own time of the same calls (trace_ms, commit_ms).

    python3 bench.py [THREADS] [REPEATS]

Both times are of one call, so that what else runs on the machine slows both. Prints medians, and how much longer
Python's call took than C's: the median of the differences.
"""
import statistics
import sys
import time

import numpy as np

import cgt

THREADS = int(sys.argv[1]) if len(sys.argv) > 1 else 1
REPEATS = int(sys.argv[2]) if len(sys.argv) > 2 else 31
N, RAYS = 100_000, 1_000_000
rng = np.random.default_rng(1)


def row(name, call, milliseconds, repeats=REPEATS):
    """One line: `milliseconds` gives C's time of what `call` returned."""
    pairs = []
    for _ in range(repeats):
        begin = time.perf_counter()
        result = call()
        python = 1e3 * (time.perf_counter() - begin)
        pairs.append((python, milliseconds(result)))
    median = [statistics.median(p) for p in zip(*pairs)]
    extra = statistics.median(p - c for p, c in pairs)
    share = 100 * extra / median[1]
    print(f"| {name} | {median[0]:.4g} | {median[1]:.4g} | {1e3 * extra:.3g} | {share:.3g} % |", flush=True)


def measure(title, geometry, move, rays):
    """All calls of one scene that moves."""
    scene = cgt.Scene(cgt.Context(threads=THREADS), rays=rays)
    scene.add(geometry)
    camera = cgt.Camera((0, 0, 4), fov=40)
    of_call, fields = (lambda r: r.statistics.trace_ms), ("t", "primitive", "geometry", "normal")

    def commit():
        scene.commit()

    def moved():
        move()
        commit()

    moved()
    row(f"{title}: commit", commit, lambda _: scene.statistics.commit_ms)
    if rays == "coherent":
        out = scene.trace_camera(camera, 1280, 720, fields).arrays
        for name, given in (("own arrays", out), ("new arrays", None)):
            row(f"{title}: frame of 1280x720 with normals, {name}",
                lambda: scene.trace_camera(camera, 1280, 720, fields, out=given, statistics=True), of_call)
        row(f"{title}: frame of 8x8", lambda: scene.trace_camera(camera, 8, 8, statistics=True), of_call, 1000)
        return
    org, dir = rng.uniform(-1, 1, (RAYS, 3)).astype("f4"), rng.normal(size=(RAYS, 3)).astype("f4")
    out = scene.trace_rays(org, dir).arrays
    row(f"{title}: {RAYS:,} rays", lambda: scene.trace_rays(org, dir, out=out, statistics=True), of_call)
    for count in (1000, 1):
        few = org[:count], dir[:count]
        row(f"{title}: {count:,} rays", lambda: scene.trace_rays(*few, statistics=True), of_call, 2000)


def main():
    """Both scenes, for both kinds of rays."""
    x = rng.uniform(-1, 1, (N, 3))
    side = 225
    u = np.linspace(-1, 1, side)
    mesh = np.stack(np.meshgrid(u, u, indexing="ij") + [np.zeros((side, side))], -1).reshape(-1, 3)
    i, j = (a.ravel() for a in np.meshgrid(np.arange(side - 1), np.arange(side - 1), indexing="ij"))
    k = i * side + j
    faces = np.concatenate([np.stack([k, k + 1, k + side], 1), np.stack([k + 1, k + side + 1, k + side], 1)])
    print(f"libcgt {cgt.version()}, {cgt.Context(threads=THREADS).variant}, threads: {THREADS}\n")
    print("| call | Python, ms | C, ms | more, us | more |\n|---|---|---|---|---|")

    def move_spheres():
        x[:] += rng.uniform(-1e-3, 1e-3, x.shape)

    def move_mesh():
        mesh[:, 2] += 1e-3 * np.sin(9 * mesh[:, 0])

    for rays in ("coherent", "incoherent"):
        measure(f"{N:,} spheres", cgt.Spheres(x, 0.012), move_spheres, rays)
        measure(f"{len(faces):,} triangles", cgt.Triangles(mesh, faces.astype("u4")), move_mesh, rays)


main()

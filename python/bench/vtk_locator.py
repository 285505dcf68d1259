# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""A mesh that moves, in VTK's locators of cells and in libcgt, both from Python (Debian: apt-get install python3-vtk9).

    python3 python/bench/vtk_locator.py [REPEATS]

One thread. Prints medians of the processor's time, which other jobs hardly change: structure anew, rays one by one, as
VTK's interface has them, and rays as an array.
"""
import statistics
import sys
import time

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

import cgt

REPEATS = int(sys.argv[1]) if len(sys.argv) > 1 else 5
SIDE, RAYS = 225, 5_000
rng = np.random.default_rng(1)
u = np.linspace(-1, 1, SIDE)
vertices = np.stack(np.meshgrid(u, u, indexing="ij") + [np.zeros((SIDE, SIDE))], -1).reshape(-1, 3)
i, j = (a.ravel() for a in np.meshgrid(np.arange(SIDE - 1), np.arange(SIDE - 1), indexing="ij"))
k = i * SIDE + j
faces = np.concatenate([np.stack([k, k + 1, k + SIDE], 1), np.stack([k + 1, k + SIDE + 1, k + SIDE], 1)])
org = np.c_[rng.uniform(-1, 1, (RAYS, 2)), np.full(RAYS, 2.0)].astype("f4")
dir = np.c_[rng.normal(scale=0.3, size=(RAYS, 2)), np.full(RAYS, -1.0)].astype("f4")
end = org + 10 * dir

points, cells, mesh = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkPolyData()
points.SetData(numpy_to_vtk(vertices))
cells.SetData(3, numpy_to_vtkIdTypeArray(np.ascontiguousarray(faces.ravel(), np.int64), deep=1))
mesh.SetPoints(points)
mesh.SetPolys(cells)
context = cgt.Context(threads=1)
indices = faces.astype("u4")
bvh, grid = cgt.Scene(context, structure="bvh"), cgt.Scene(context, structure="loose_grid")
for made in (bvh, grid):
    made.add(cgt.Triangles(vertices, indices))


def median(call):
    """Milliseconds, and what the last call returned."""
    times = []
    for _ in range(REPEATS):
        vertices[:, 2] += 1e-3 * np.sin(9 * vertices[:, 0])
        mesh.Modified()
        points.Modified()
        begin = time.process_time()
        result = call()
        times.append(1e3 * (time.process_time() - begin))
    return statistics.median(times), result


def vtk_rays(locator):
    """Which rays hit."""
    t, x, p, sub, cell = vtk.mutable(0), [0, 0, 0], [0, 0, 0], vtk.mutable(0), vtk.mutable(0)
    return np.array([locator.IntersectWithLine(a, b, 0.0, t, x, p, sub, cell)
                     for a, b in zip(org.tolist(), end.tolist())], bool)


def cgt_single(scene):
    """The same, ray by ray."""
    return sum(scene.trace_ray(a, d).hit for a, d in zip(org[:2000].tolist(), dir[:2000].tolist()))


print(f"VTK {vtk.vtkVersion.GetVTKVersion()}, libcgt {cgt.version()}, one thread, {len(faces):,} triangles\n")
print("| | structure, ms | one ray, us | rays that hit | of them others than cgt's |\n|---|---|---|---|---|")
vtk.vtkSMPTools.Initialize(1)
for name in ("vtkStaticCellLocator", "vtkCellLocator"):
    def build(make=getattr(vtk, name)):
        """A locator of the mesh as it is now."""
        locator = make()
        locator.SetDataSet(mesh)
        locator.BuildLocator()
        return locator

    built, locator = median(build)
    begin = time.process_time()
    hits = vtk_rays(locator)
    each = 1e6 * (time.process_time() - begin) / RAYS
    bvh.commit()  # of the mesh as it is
    others = (hits != bvh.trace_rays(org, dir).hit).sum()
    print(f"| {name} | {built:.1f} | {each:.2f} | {hits.sum()} | {others} |", flush=True)
for name, scene in (("BVH", bvh), ("loose grid", grid)):
    built, _ = median(scene.commit)
    traced, hits = median(lambda: scene.trace_rays(org, dir))
    single, _ = median(lambda: cgt_single(scene))
    print(f"| cgt, {name}, array of rays | {built:.2f} | {1e3 * traced / RAYS:.3f} | {hits.hit.sum()} | |")
    print(f"| cgt, {name}, ray by ray | {built:.2f} | {1e3 * single / 2000:.2f} | {hits.hit.sum()} | |", flush=True)

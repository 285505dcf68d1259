# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""The intersector: what trimesh asks of one, on meshes made here."""
from types import SimpleNamespace

import numpy as np
import pytest

import cgt
from cgt.trimesh import RayMeshIntersector


def box(extent=1.0):
    """A closed cube of twelve triangles about the origin."""
    v = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * extent / 2
    f = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
         [1, 5, 7], [1, 7, 3]]
    return SimpleNamespace(vertices=v, faces=np.array(f))


def test_each_vertex_and_edge_is_hit_once():
    mesh = box()
    corners = mesh.vertices
    middles = (corners[mesh.faces] + corners[np.roll(mesh.faces, 1, axis=1)]).reshape(-1, 3) / 2
    for targets in (corners, middles):
        rays = RayMeshIntersector(mesh)
        origins = np.zeros_like(targets)
        assert rays.intersects_any(origins, targets).all()
        locations, index_ray, index_tri = rays.intersects_location(origins, targets)
        assert index_ray.tolist() == list(range(len(targets)))
        assert np.allclose(locations, targets)
        assert (rays.intersects_first(origins, targets) == index_tri).all()


def test_first_hits_and_all_hits():
    mesh, n = box(2), 64
    x, y = np.meshgrid(np.arange(-n, n, 2.0), np.arange(-n, n, 2.0))
    directions = np.stack([x.ravel(), y.ravel(), np.full(x.size, 500.0)], axis=-1)
    origins = np.tile([0, 0, -15.0], (len(directions), 1))
    rays = RayMeshIntersector(mesh)
    tri, ray = rays.intersects_id(ray_origins=origins, ray_directions=directions, multiple_hits=False)
    assert len(np.unique(tri)) == 2 and len(np.unique(ray)) == len(ray)
    every, of_ray = rays.intersects_id(origins, directions, multiple_hits=True)
    assert len(np.unique(every)) > 2 and (np.diff(of_ray) >= 0).all()
    assert np.bincount(of_ray)[np.bincount(of_ray) > 0].tolist() == [2] * len(ray)
    one, _ = rays.intersects_id(origins, directions, max_hits=1)
    assert np.array_equal(one, tri)
    assert rays.intersects_first(origins, directions).tolist() == [
        dict(zip(ray.tolist(), tri.tolist())).get(i, -1) for i in range(len(origins))]


def test_locations_keep_the_ray():
    mesh = box()
    x, y = np.meshgrid(np.linspace(-0.52, 0.52, 100), np.linspace(-0.52, 0.52, 100))
    origins = np.stack([x.ravel(), y.ravel(), np.full(x.size, -100.0)], axis=-1)
    locations, ray, _ = RayMeshIntersector(mesh).intersects_location(origins, np.tile([0, 0, 1.0], (len(origins), 1)))
    assert np.allclose(locations[:, :2], origins[ray, :2]) and np.allclose(abs(locations[:, 2]), 0.5, atol=1e-5)
    inside = (np.abs(origins[:, :2]) < 0.5).all(axis=1)
    assert np.array_equal(np.bincount(ray, minlength=len(origins)), 2 * inside)


def test_a_ray_leaves_where_it_begins():
    tri, _ = RayMeshIntersector(box(10000)).intersects_id([[0, 0, 5000.0]], [[0, 0, -1.0]], multiple_hits=True)
    assert len(tri) == 1
    assert RayMeshIntersector(box(10000)).intersects_first([[0, 0, 5000.0]], [[0, 0, 1.0]]).tolist() == [-1]


def test_no_hit_gives_empty_arrays():
    rays = RayMeshIntersector(box())
    origins = np.random.default_rng(1).uniform(size=(100, 3)) + [0, 0, -5]
    up = np.tile([0, 1, 0], (100, 1))
    tri, ray, locations = rays.intersects_id(origins, up, return_locations=True)
    assert tri.shape == ray.shape == (0,) and locations.shape == (0, 3) and tri.dtype == ray.dtype == np.int64
    assert [a.shape for a in rays.intersects_id(np.zeros((0, 3)), np.zeros((0, 3)))] == [(0,), (0,)]
    assert not rays.intersects_any(origins, up).any()


def test_points_inside():
    mesh = box()
    rays = RayMeshIntersector(mesh)
    assert rays.contains_points(mesh.vertices / 1.5).all() and rays.contains_points([[0, 0, 0]]).all()
    assert not rays.contains_points(mesh.vertices * 1.5).any()
    assert not rays.contains_points(np.random.default_rng(1).uniform(1, 100, (30, 3))).any()


def test_far_away_meshes_keep_their_digits():
    mesh = box()
    far = np.array([1e8, -3e7, 5e8])
    moved = SimpleNamespace(vertices=mesh.vertices + far, faces=mesh.faces)
    r = np.random.default_rng(2)
    origins, directions = r.uniform(-2, 2, (500, 3)).astype("f4").astype("f8"), r.normal(size=(500, 3))
    near = RayMeshIntersector(mesh).intersects_first(origins, directions)
    found = RayMeshIntersector(moved).intersects_first(origins + far, directions)
    assert (near >= 0).sum() > 30 and (near != found).mean() < 0.01


def test_changes_are_seen():
    class Mesh(SimpleNamespace):
        """With a hash of its contents, as trimesh's."""

        def __hash__(self):
            return hash(self.vertices.tobytes())

    mesh = Mesh(**vars(box()))
    rays = RayMeshIntersector(mesh)
    assert rays.intersects_any([[0, 0, -5]], [[0, 0, 1]]).all()
    mesh.vertices[:] += 100
    assert not rays.intersects_any([[0, 0, -5]], [[0, 0, 1]]).any()
    plain = box()
    rays = RayMeshIntersector(plain)
    assert rays.intersects_any([[0, 0, -5]], [[0, 0, 1]]).all()
    plain.vertices += 100
    rays.update()
    assert not rays.intersects_any([[0, 0, -5]], [[0, 0, 1]]).any()


def test_bad_arguments_are_named():
    rays = RayMeshIntersector(box())
    with pytest.raises(cgt.InvalidArgument, match=r"ray_origins, ray_directions: shapes \(3,\)"):
        rays.intersects_any([0, 0, 0], [0, 0, 1])
    with pytest.raises(cgt.InvalidArgument, match="mesh.faces: 0 to 9, of 3 vertices"):
        RayMeshIntersector(SimpleNamespace(vertices=np.eye(3), faces=[[0, 1, 9]])).update()

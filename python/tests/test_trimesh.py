# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""The intersector: what trimesh asks of one, on meshes made here."""
import copy
import pickle
from fractions import Fraction
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
    for multiple, most in ((True, 0), (False, 0), (False, 1), (False, 5)):
        some, _ = rays.intersects_id(origins, directions, multiple_hits=multiple, max_hits=most)
        assert np.array_equal(some, tri[:len(tri) * (most > 0)])
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


def ball(r):
    """A closed mesh of triangles that lean at random, at places that no float holds."""
    rows, columns = 6, 8
    at = np.pi * np.arange(1, rows)[:, None] / rows, 2 * np.pi * np.arange(columns) / columns
    size = 0.7 * r.uniform(0.8, 1.2, (rows - 1, columns))
    ring = size[..., None] * np.stack(np.broadcast_arrays(np.sin(at[0]) * np.cos(at[1]), np.sin(at[0]) * np.sin(at[1]),
                                                          np.cos(at[0])), -1)
    v = np.concatenate([[[0, 0, 0.7]], ring.reshape(-1, 3), [[0, 0, -0.7]]]) + [3.1, -2.3, 5.7]
    f, last = [], len(v) - 1
    for k in range(columns):
        a, b = 1 + k, 1 + (k + 1) % columns
        f += [[0, a, b], [last, last - columns + (k + 1) % columns, last - columns + k]]
        for row in range(rows - 2):
            f += [[a, a + columns, b + columns], [a, b + columns, b]]
            a, b = a + columns, b + columns
    return SimpleNamespace(vertices=v, faces=np.array(f))


def exact_hits(mesh, origin, direction):
    """The hits of a ray in fractions: distances and triangles, in order."""
    def whole(x):
        return np.array([Fraction(float(y)) for y in np.ravel(x)], object).reshape(np.shape(x))

    o, d, found = whole(origin), whole(direction), []
    for k, corners in enumerate(whole(mesh.vertices[mesh.faces])):
        a, b, c = corners - o
        u, v, w = d @ np.cross(c, b), d @ np.cross(a, c), d @ np.cross(b, a)
        if min(u, v, w) >= 0 or max(u, v, w) <= 0:
            normal = np.cross(b - a, c - a)
            if normal @ d and (normal @ a) / (normal @ d) > 0:
                found.append(((normal @ a) / (normal @ d), k))
    return sorted(found)


@pytest.mark.parametrize("distance", [0.3, 1, 1e4, 1e7, 1e10])
def test_rays_from_anywhere_are_as_exact_as_fractions(distance):
    r = np.random.default_rng(5)
    mesh, n = ball(r), 8
    rays = RayMeshIntersector(mesh)
    directions = r.normal(size=(n, 3))
    directions *= 10 ** r.uniform(-3, 3, (n, 1)) / np.linalg.norm(directions, axis=1)[:, None]
    lengths = np.linalg.norm(directions, axis=1)[:, None]
    origins = mesh.vertices.mean(axis=0) + r.uniform(-0.6, 0.6, (n, 3)) - distance * directions / lengths
    triangle, ray, place = rays.intersects_id(origins, directions, return_locations=True)
    first, any_hit = rays.intersects_first(origins, directions), rays.intersects_any(origins, directions)
    one, of_one = rays.intersects_id(origins, directions, multiple_hits=False)
    assert len(ray) > n / 2
    for k in range(n):
        right = exact_hits(mesh, origins[k], directions[k])
        assert triangle[ray == k].tolist() == [found for _, found in right]
        assert first[k] == (right[0][1] if right else -1) and any_hit[k] == bool(right)
        assert one[of_one == k].tolist() == [found for _, found in right[:1]]
        for (t, _), at in zip(right, place[ray == k]):
            wanted = [float(Fraction(x) + t * Fraction(y)) for x, y in zip(origins[k].tolist(), directions[k].tolist())]
            assert np.allclose(at, wanted, rtol=0, atol=4e-15 * max(1, distance))


def test_rays_go_on_from_where_they_hit():
    r = np.random.default_rng(6)
    mesh = ball(r)
    rays = RayMeshIntersector(mesh)
    directions = r.normal(size=(400, 3))
    origins = mesh.vertices.mean(axis=0) - 3 * directions / np.linalg.norm(directions, axis=1)[:, None]
    triangle, ray, place = rays.intersects_id(origins, directions, return_locations=True)
    later, of_hit = rays.intersects_id(place, directions[ray])
    for k in range(len(ray)):
        rest = triangle[k + 1:][ray[k + 1:] == ray[k]]
        assert later[of_hit == k].tolist() == rest.tolist()
    first = rays.intersects_first(place, directions[ray])
    assert [f >= 0 for f in first] == [(ray[k + 1:] == ray[k]).any() for k in range(len(ray))]


def test_walls_come_in_pairs_however_thin():
    for thickness in (1e-3, 1e-6, 1e-9, 1e-12):
        plate = box(2)
        plate.vertices[:, 2] *= thickness
        for distance in (1, 1e3, 1e6):
            rays = RayMeshIntersector(plate)
            tri, _ = rays.intersects_id([[0.3, 0.1, distance], [100.3, 100.1, distance]],
                                        [[0, 0, -1], [-100, -100, -distance]])
            assert len(tri) == 4, (thickness, distance)
    two = box(2)
    two = SimpleNamespace(vertices=np.concatenate([two.vertices, two.vertices + [0, 0, 2]]),
                          faces=np.concatenate([two.faces, two.faces + 8]))
    assert len(RayMeshIntersector(two).intersects_id([[0.3, 0.1, 9]], [[0, 0, -1]])[0]) == 4
    grid = np.stack(np.meshgrid(np.arange(-5, 6) / 4, np.arange(-5, 6) / 4, [9.0]), -1).reshape(-1, 3)
    down = np.tile([0, 0, -1.0], (len(grid), 1))  # through edges, vertices and along sides, too
    tri, ray = RayMeshIntersector(two).intersects_id(grid, down)
    count = np.bincount(ray, minlength=len(grid))
    assert set(count) == {0, 4} and (count[(np.abs(grid[:, :2]) < 1).all(axis=1)] == 4).all()
    assert ((RayMeshIntersector(two).intersects_first(grid, down) >= 0) == (count > 0)).all()
    assert (RayMeshIntersector(two).intersects_any(grid, down) == (count > 0)).all()


def test_meshes_with_an_intersector_are_copied():
    mesh = box()
    mesh.ray = RayMeshIntersector(mesh)
    mesh.ray.intersects_any([[0, 0, -5]], [[0, 0, 1]])
    for make in (copy.copy, copy.deepcopy, lambda m: pickle.loads(pickle.dumps(m))):
        other = make(mesh)
        assert make(other.ray).intersects_first([[0.1, 0.2, -5]], [[0, 0, 1]]) == mesh.ray.intersects_first(
            [[0.1, 0.2, -5]], [[0, 0, 1]])


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


def test_meshes_of_another_shape_are_refused():
    mesh = box()
    quads, flat = np.array([[0, 1, 3, 2]] * 3), mesh.vertices[:6, :2]
    rays = RayMeshIntersector(box())
    for vertices, faces, name in ((mesh.vertices, quads, "faces"), (mesh.vertices, [0, 1, 3], "faces"),
                                  (mesh.vertices, quads[None, :, :3], "faces"), (flat, [[0, 1, 2]], "vertices"),
                                  (mesh.vertices.reshape(-1), mesh.faces, "vertices"), (mesh.vertices, "a", "faces"),
                                  (mesh.vertices, [[0, 1], [2]], "faces"), (None, mesh.faces, "vertices"),
                                  (np.ma.masked_equal(mesh.vertices, 0.5), mesh.faces, "vertices")):
        rays.mesh = SimpleNamespace(vertices=vertices, faces=faces)
        with pytest.raises(cgt.InvalidArgument, match=f"^mesh.{name}: "):
            rays.update()
    for vertices, faces in ((np.empty((0, 3)), np.empty((0, 3), int)), ([], []), (mesh.vertices, []),
                            (mesh.vertices, np.empty((0, 4), int))):
        rays.mesh = SimpleNamespace(vertices=vertices, faces=faces)
        rays.update()
        assert not rays.intersects_any([[0, 0, 5]], [[0, 0, -1]])[0]
    rays.mesh = SimpleNamespace(vertices=mesh.vertices.tolist(), faces=mesh.faces.tolist())
    rays.update()
    assert rays.intersects_any([[0.1, 0.2, 5]], [[0, 0, -1]])[0]


def test_bad_arguments_are_named():
    rays = RayMeshIntersector(box())
    with pytest.raises(cgt.InvalidArgument, match=r"ray_origins, ray_directions: shapes \(3,\)"):
        rays.intersects_any([0, 0, 0], [0, 0, 1])
    with pytest.raises(cgt.InvalidArgument, match="mesh.faces: 0 to 9, of 3 vertices"):
        RayMeshIntersector(SimpleNamespace(vertices=np.eye(3), faces=[[0, 1, 9]])).update()

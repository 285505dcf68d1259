# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Files, frame by frame; left out where libcgt was installed without its readers."""
import os

import numpy as np
import pytest

import cgt

try:
    import cgt.trajectory  # noqa: F401
except ImportError as error:
    pytest.skip(str(error), allow_module_level=True)

XYZ = "3\nframe\nO 0 0 0\nH 0 0 1\nH 1 0 0\n"
DUMP = """ITEM: TIMESTEP
{step}
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp ff
0 10
0 20
-5 5
ITEM: ATOMS id type x y z vx vy vz radius c_q element
7 1 1 2 3 0.5 0 0 0.25 -1.5 C
9 2 4 5 {z} 0 0 1 0.75 2.5 H
"""


@pytest.fixture
def dump(tmp_path):
    """Three frames of two grains."""
    path = tmp_path / "run.lammpstrj"
    path.write_text("".join(DUMP.format(step=100 * k, z=k) for k in range(3)))
    return path


def test_frames_have_arrays(dump):
    with cgt.read(dump, columns=["c_q", "element"]) as run:
        frames = list(run)
    assert [f.step for f in frames] == [0, 100, 200] and [f.number for f in frames] == [0, 1, 2]
    last = frames[2]
    assert last.positions.tolist() == [[1, 2, 3], [4, 5, 2]] and last.radii.tolist() == [0.25, 0.75]
    assert last.ids.tolist() == [7, 9] and last.types.tolist() == [1, 2]
    assert last.velocities.tolist() == [[0.5, 0, 0], [0, 0, 1]]
    assert last.columns["c_q"].tolist() == [-1.5, 2.5]
    assert last.columns["element"].tolist() == ["C", "H"]
    assert "vx" in last.column_names and "vx" not in last.columns
    assert last.box_origin.tolist() == [0, 0, -5] and np.diag(last.box_edges).tolist() == [10, 20, 10]
    assert last.periodic.tolist() == [1, 1, 0] and last.elements.tolist() == [6, 1]
    assert last.bonds is None and np.isnan(last.time)
    assert frames[0].positions[1, 2] == 0  # a copy, which later frames leave alone


def test_frames_are_geometries(dump):
    scene = cgt.Scene()
    with cgt.read(dump, origin=(1, 2, 0)) as run:
        grains = scene.add(run.read().geometry())
        for k, frame in enumerate(run):
            assert frame.origin.tolist() == [1, 2, 0] and len(frame) == 2
            scene.update(grains, frame.geometry())
            scene.commit()
            assert scene.trace_ray((3, 3, 20), (0, 0, -1)).t == 20 - (k + 1) - 0.75


def test_frames_are_skipped_and_counted(dump):
    run = cgt.read(dump)
    assert run.count_frames() == 3 and run.skip() and run.read().number == 1
    run.rewind()
    assert run.read().number == 0 and run.mesh is None
    run.close()
    with pytest.raises(cgt.InvalidArgument, match="closed"):
        run.read()


def test_series_and_formats(tmp_path):
    paths = [tmp_path / f"step{k}.dat" for k in range(2)]
    for path in paths:
        path.write_text(XYZ)
    frames = list(cgt.read(paths, format="xyz"))
    assert len(frames) == 2 and frames[1].number == 1 and frames[1].elements.tolist() == [8, 1, 1]
    assert len(list(cgt.read([os.fspath(p) for p in paths[:1]], format="xyz"))) == 1
    with pytest.raises(cgt.InvalidArgument, match="path: an empty sequence"):
        cgt.read([])


def test_errors_name_the_file(tmp_path, dump):
    with pytest.raises(cgt.ReadError, match="nowhere.xyz: No such file"):
        cgt.read(tmp_path / "nowhere.xyz")
    dump.write_text(dump.read_text()[:-30])
    with cgt.read(dump) as run:
        run.read()
        run.read()
        with pytest.raises(OSError, match="run.lammpstrj"):
            run.read()
    with pytest.raises(cgt.ReadError, match="the format is not one of lammps"):
        cgt.read(dump, format="nonsense")


def test_doubts_are_warnings(tmp_path):
    path = tmp_path / "cut.xyz"
    path.write_text(XYZ[:-1])
    with pytest.warns(UserWarning, match="cut.xyz"):
        list(cgt.read(path))


def test_meshes(tmp_path):
    path = tmp_path / "square.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")
    try:
        run = cgt.read(path)
    except cgt.ReadError as error:
        pytest.skip(str(error))  # without assimp
    frame = run.read()
    assert frame.triangles.shape == (2, 3) and len(frame) == 4 and frame.radii is None and run.mesh.meshes == 1
    scene = cgt.Scene()
    scene.add(frame.geometry())
    scene.commit()
    assert scene.trace_ray((0.5, 0.25, 1), (0, 0, -1)).t == 1

# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Files, frame by frame; left out where libcgt was installed without its readers."""
import copy
import os
import struct
import threading
import warnings

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
        grains = scene.add(run[0].geometry())
        for k, frame in enumerate(run):
            assert frame.origin.tolist() == [1, 2, 0] and len(frame) == 2
            scene.update(grains, frame.geometry())
            scene.commit()
            assert scene.trace_ray((3, 3, 20), (0, 0, -1)).t == 20 - k - 0.75


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
    with pytest.raises(cgt.InvalidArgument, match="path: None: must be a path"):
        cgt.read(None)


def test_series_are_sorted_by_their_numbers(tmp_path):
    names = ["dump.100.gz", "dump.9.gz", "dump.10.gz"]
    assert cgt.sort_series([tmp_path / n for n in names]) == [
        os.fspath(tmp_path / n) for n in ("dump.9.gz", "dump.10.gz", "dump.100.gz")]
    assert cgt.sort_series([]) == []


def test_pipes_rewind_where_they_are_kept(tmp_path):
    path = tmp_path / "pipe.xyz"
    for keep in (False, True):
        if path.exists():
            path.unlink()
        os.mkfifo(path)
        writer = threading.Thread(target=lambda: path.write_text(XYZ * 2))
        writer.start()
        with cgt.read(path, keep=keep) as run:
            assert run.can_rewind == keep and len(list(run)) == 2 and run.progress < 0
            writer.join()
            if keep:
                run.rewind()
                assert run.read().number == 0
            else:
                with pytest.raises(cgt.ReadError, match="pipe.xyz"):
                    run.rewind()
    path.unlink()
    path.write_text(XYZ * 2)
    with cgt.read(path) as run:
        assert run.can_rewind and len(list(run)) == 2 and run.progress == 1


def test_every_format_is_read(tmp_path):
    """The files that the readers' own tests have, and small ones of the formats that are text."""
    data = os.path.join(os.path.dirname(__file__), "..", "..", "tests", "readers", "data")
    texts = {
        "a.xyz": XYZ, "a.lammpstrj": DUMP.format(step=0, z=0),
        "POSCAR": "water\n1.0\n9 0 0\n0 9 0\n0 0 9\nO H\n1 2\nCartesian\n0 0 0\n0 0 1\n1 0 0\n",
        "a.vtk": "# vtk DataFile Version 3.0\npoints\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 0 0 1 0 0\n",
        "a.cif": "data_x\nloop_\n_atom_site.group_PDB\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.Cartn_x\n"
                 "_atom_site.Cartn_y\n_atom_site.Cartn_z\nATOM 1 O 0 0 0\nATOM 2 H 0 0 1\n",
    }
    paths = [os.path.join(data, name) for name in sorted(os.listdir(data))
             if name.endswith((".bin", ".data", ".lammpstrj", ".gsd", ".dcd", ".gro", ".nc", ".pdb", ".trr", ".xtc"))]
    assert len(paths) >= 11
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
        paths.append(tmp_path / name)
    (tmp_path / "a.frames").write_bytes(frames_file())
    paths.append(tmp_path / "a.frames")
    for path in paths:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            frame = cgt.read(path).read()
        assert len(frame) and np.isfinite(frame.positions).all() and (frame.radii > 0).all(), path
        assert cgt.Scene().add(frame.geometry()) == 0


def test_bonds_and_sites_that_files_do_not_list(tmp_path):
    path = tmp_path / "water.xyz"
    path.write_text("4\n\nO 0 0 0\nH 0.96 0 0\nH -0.24 0.93 0\nMW 0.1 0.1 0\n")
    frame = cgt.read(path, columns=["site"]).read()
    assert frame.bonds is None and frame.columns["site"].tolist() == [0, 0, 0, 1] and frame.radii[3] == 0.5
    with pytest.warns(UserWarning, match="1 of 4 spheres are no atoms"):
        frame = cgt.read(path, all_bonds=True, leave_out_sites=True).read()
    assert len(frame) == 3 and frame.bonds.tolist() == [[0, 1], [0, 2]]
    path.write_text("1\n\nO 0 0 0\n")
    assert cgt.read(path, all_bonds=True).read().bonds.shape == (0, 2)


def frames_file():
    """A .frames file of one sphere, as trajectory.h describes it."""
    return b"CGTFRAM1" + struct.pack("<4I", 1, 1, 0, 0) + struct.pack("<I4f", 1, 1, 2, 3, 0.5)


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


def test_good_frames_stay_readable_after_an_error(dump):
    whole = dump.read_text()
    failing = (len, lambda run: run[-1], lambda run: run[:2], lambda run: run[2], lambda run: list(run),
               lambda run: run.count_frames(), lambda run: [run.skip() for _ in range(3)])
    for fail in failing:
        dump.write_text(whole[:-30])
        run = cgt.read(dump)
        assert run.read().number == 0
        for _ in range(2):
            with pytest.raises(cgt.ReadError, match="run.lammpstrj"):
                fail(run)
            assert [run[k].number for k in (0, 1, 0)] == [0, 1, 0] and run.read().number == 1
        with pytest.raises(cgt.ReadError):
            run.read()
        with pytest.raises(cgt.ReadError):
            run.read()
        dump.write_text(whole)
        assert run.read().number == 2 and run.read() is None
        assert run[2].number == 2 and len(run) == 3 and run[-1].number == 2
    run = cgt.read(dump)
    run.read()
    dump.write_text(whole[:-30])
    with pytest.raises(cgt.ReadError):
        len(run)
    assert run.read().number == 1  # it stays where it was
    step = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n"
    dump.write_text("".join(f"{step}1 {x} 0 0\n" for x in "0?0"))  # skipping does not see it
    run = cgt.read(dump)
    with pytest.raises(cgt.ReadError):
        list(run)
    assert run.count_frames() == 3 and len(run) == 3


def test_a_file_that_grows_is_counted_anew(dump):
    whole = dump.read_text()
    for count in (lambda run: run.count_frames(), lambda run: len(list(run)), lambda run: run[5].number + 1):
        dump.write_text(whole)
        run = cgt.read(dump)
        assert len(run) == 3
        dump.write_text(whole * 2)
        assert count(run) == 6 and len(run) == 6 and run[-1].number == 5


def test_what_is_looped_over_once_means_the_same(dump):
    wanted = cgt.read(dump, columns=["c_q"]).read().columns["c_q"]
    for once in (iter(["c_q"]), (n for n in ["c_q"]), {"c_q"}):
        assert np.array_equal(cgt.read(dump, columns=once).read()["c_q"], wanted)
    with pytest.raises(cgt.InvalidArgument, match="columns: nope: the file has"):
        cgt.read(dump, columns=(n for n in ["nope"])).read()
    for columns in (5, [1], b"c_q", (n for n in [b"c_q"])):
        with pytest.raises(cgt.InvalidArgument, match="columns: .*: must be"):
            cgt.read(dump, columns=columns)
    assert len(cgt.Trajectory((p for p in [dump, dump]), (), {})) == 6
    assert cgt.sort_series(p for p in [dump]) == [os.fspath(dump)]
    for paths in ("a.xyz", b"a.xyz", dump, 5):
        with pytest.raises(cgt.InvalidArgument, match="paths: .*: must be a sequence of paths"):
            cgt.sort_series(paths)
    origin = [1, 2, 0]
    run = cgt.read(dump, origin=origin)
    origin[0] = 5
    assert copy.copy(run).read().origin.tolist() == [1, 2, 0]


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


class Interrupted:
    """C, and Ctrl-C behind one of its calls."""

    def __init__(self, lib, name):
        self.lib, self.name = lib, name

    def __getattr__(self, name):
        call = getattr(self.lib, name)

        def interrupted(*arguments):
            call(*arguments)
            self.name = None
            raise KeyboardInterrupt

        return interrupted if name == self.name else call


def test_ctrl_c_shifts_no_frame(dump, tmp_path, monkeypatch):
    lib = cgt.trajectory.lib

    def interrupt(name, ask):
        monkeypatch.setattr(cgt.trajectory, "lib", Interrupted(lib, "cgt_trajectory_" + name))
        with pytest.raises(KeyboardInterrupt):
            ask()
        monkeypatch.setattr(cgt.trajectory, "lib", lib)

    for name, ask in (("read", lambda r: r.read()), ("read", lambda r: r[1]), ("skip", lambda r: r[2]),
                      ("skip", lambda r: r.skip()), ("rewind", lambda r: r.rewind()), ("rewind", lambda r: r[0]),
                      ("count_frames", len), ("count_frames", lambda r: r.count_frames())):
        for then in (lambda r: r.read().number == 1 or r[0].number == 0, lambda r: r[1].number == 1,
                     lambda r: [f.number for f in r] == [0, 1, 2], lambda r: len(r) == 3 and r[-1].number == 2):
            run = cgt.read(dump)
            run.read()
            interrupt(name, lambda: ask(run))
            assert then(run)
    pipe = tmp_path / "pipe.xyz"  # which cannot go back
    os.mkfifo(pipe)
    writer = threading.Thread(target=lambda: pipe.write_text(XYZ * 4))
    writer.start()
    with cgt.read(pipe) as run:
        interrupt("read", run.read)
        writer.join()
        with pytest.raises(cgt.ReadError, match="frame 0: a call was interrupted, and the pipe is behind it"):
            run[0]
        assert [f.number for f in run] == [2, 3]
        with pytest.raises(cgt.InvalidArgument, match="a pipe was read to its end"):
            list(run)

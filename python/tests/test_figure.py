# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Figures: what options and data of Python's mean; the same data from other packages; movies, the window. That pictures
have the bytes of cgt-render is compared by tests/figure/doors.sh."""
import copy
import importlib.machinery
import importlib.util
import json
import os
import pickle
import shutil
import subprocess
import sys
import threading
import types
from fractions import Fraction

import numpy as np
import pytest

try:
    import cgt.figure
    from cgt import _show
    from cgt._figure_data import FigureData, is_run
except ImportError as error:
    pytest.skip(str(error), allow_module_level=True)

SIZE = {"size": (60, 40)}
X = np.array([[0.0, 0, 0], [2, 0, 0], [4, 0.5, 1]])
PAIRS = [[0, 1], [1, 2]]


def pixels(data, options=(), **more):
    return cgt.Figure(**SIZE, **dict(options)).show(data, **more).pixels


def same(*pictures):
    return all(np.array_equal(pictures[0], p) for p in pictures[1:]) and pictures[0].std() > 5


def test_values_become_texts():
    camera = cgt.Camera((0, -9, 1), up=(0, 0, 1))
    figure = cgt.Figure(size=(60, 40), antialias=np.int64(2), camera=camera, title="A = b", range=[0.5, np.float32(2)],
                        show=["x > 0", "y < 2"], sun=[(1, 2, 3), (3, 2, 1, 0.5)], bonds=True,
                        lamp=(1, 2, 3.5), type_color={"O": "Tomato", 2: "#48f"}, background=(1.0, 0, 0), color="ff8000",
                        shadows=False, log_scale=False, floor="forestgreen", fov=None)
    assert figure.settings == """size = 60x40
antialias = 2
camera = 0,-9,1,0,0,0,0,0,1,45
title = A = b
range = 0.5,2.0
show = x > 0
show = y < 2
sun = 1,2,3
sun = 3,2,1,0.5
bonds
lamp = 1,2,3.5
type-color = O=ff6347
type-color = 2=4488ff
background = ff0000
color = ff8000
no-shadows
floor = 228b22
"""
    for other in (cgt.Figure(**figure.options), copy.copy(figure), pickle.loads(pickle.dumps(figure))):
        assert other.settings == figure.settings and other.options == figure.options
    figure.set(bonds=1.5, show="z > 0", shadows=True).unset("camera", "sun")
    assert figure.options["show"] == ["z > 0"] and figure.options["bonds"] == "1.5" and "sun" not in figure.options
    assert figure.options["shadows"] is True and "no_shadows" not in figure.options
    assert cgt.Figure(camera=cgt.Camera((0, -9, 1), projection="orthographic")).options["ortho"] is True
    figure.unset().set(color="y", arrows=("x", "y", 1), lamp=[(1, 2, 3, 0.5, "y")], floor="y")
    assert list(figure.options.values()) == ["y", "x,y,1", ["1,2,3,0.5,bfbf00"], "bfbf00"]
    assert figure.unset().options == {} and figure.size == (1280, 720)
    assert cgt.Figure(material={"all": "glass"}, bounces=3).settings == "material = all=glass\nbounces = 3\n"
    known = cgt.figure.options()
    assert known["text_size"].kind == "number" and known["style"].words == ("soft", "paper", "plain")


def test_a_camera_takes_its_lens_along():
    wide, flat = cgt.Camera((0, 0, 9), fov=40), cgt.Camera((0, 0, 9), projection="orthographic", height=3)
    wanted = pixels(X, {"camera": wide})
    for next_one in (wide, "0,0,9,0,0,0,0,1,0,40", (0, 0, 9, 0, 0, 0, 0, 1, 0, 40)):
        figure = cgt.Figure(**SIZE, camera=flat)
        assert figure.options["ortho"] is True and "ortho" not in figure.set(camera=next_one).options
        assert same(figure.show(X).pixels, wanted)
    assert "ortho" not in cgt.Figure(camera=flat).unset("camera").options
    assert "ortho" not in cgt.Figure(camera=flat).set(camera=None).options
    assert "ortho" not in copy.copy(cgt.Figure(camera=flat)).unset("camera").options
    assert "ortho" not in cgt.Figure(ortho=True).set(camera=wide).options
    # the same call says ortho, or another one did so for itself
    for figure in (cgt.Figure(camera=wide, ortho=True), cgt.Figure(ortho=True, camera=wide),
                   cgt.Figure(ortho=True).set(title="a", camera=None),
                   cgt.Figure(ortho=True).set(camera="0,0,9,0,0,0,0,1,0,40"),
                   cgt.Figure(camera=flat).set(ortho=True).unset("camera")):
        assert figure.options["ortho"] is True
    assert "ortho" not in cgt.Figure(camera=flat, ortho=False).options
    figure = cgt.Figure(camera=flat)
    with pytest.raises(cgt.InvalidArgument):
        figure.set(camera=wide, antialias=3)
    assert figure.options["ortho"] is True and "ortho" not in figure.unset("camera").options


def test_copies_show_the_same():
    ways = (copy.copy, copy.deepcopy, lambda f: pickle.loads(pickle.dumps(f)))
    heat, names = {"heat": [1.0, 2, 5]}, {"name": ["A", "B", "A"]}
    figure = cgt.Figure(**SIZE, style="plain", color="heat", title="frame %n").show(X, radius=0.5, columns=heat)
    figure.show(2 * X, radius=0.4, columns={**heat, **names}, time=2.0)
    first = figure.camera
    turned = figure.camera
    turned.orbit(40)
    for view in (None, turned, cgt.Camera((0, 0, 20))):
        if view is not None:
            figure.camera = view
        for other in [way(figure) for way in ways]:
            if view is None:  # the copy has looked at the second frame alone
                assert other.pick(30, 20) is not None and same(other.pixels, pixels(
                    2 * X, {"style": "plain", "color": "heat", "title": "frame %n"}, radius=0.4,
                    columns={**heat, **names}, time=2.0, number=1))
                continue
            assert np.array_equal(other.camera.eye, figure.camera.eye)
            assert same(other.pixels, figure.pixels)
            assert other.pick(30, 20) == figure.pick(30, 20)
            other.camera = first
            assert not np.array_equal(figure.camera.eye, first.eye)  # it is one of its own
    one = cgt.Figure(**SIZE, style="plain").show(X, radius=0.5)
    assert all(same(way(one).pixels, one.pixels) for way in ways)
    one.set(color="red")  # asks for it anew when it is drawn
    assert all(same(way(one).pixels, one.pixels) for way in ways)
    one.camera = first
    one.fit()
    assert all(same(way(one).pixels, one.pixels) for way in ways)
    flat = cgt.Figure(**SIZE, style="plain", ortho=True).show(X, radius=0.5)
    flat.camera = cgt.Camera((0, 0, 9), projection="orthographic", height=3)
    assert all(same(way(flat).pixels, flat.pixels) and way(flat).camera.height == flat.camera.height for way in ways)
    square = ([[0, 0, -1], [9, 0, -1], [9, 9, -1], [0, 9, -1.0]], [[0, 1, 2], [0, 2, 3]])
    walled = cgt.Figure(**SIZE, style="plain").set_mesh(square).show(X, radius=0.5)
    assert not same(walled.pixels, pixels(X, {"style": "plain"}, radius=0.5))
    assert all(same(way(walled).pixels, walled.pixels) for way in ways)
    for way in ways:  # a survey is made anew
        with pytest.raises(cgt.InvalidArgument, match="nothing is shown"):
            way(cgt.Figure(**SIZE).survey([X, 2 * X]).show(X)).draw()
    with pytest.raises(cgt.InvalidArgument, match="nothing is shown"):
        copy.copy(cgt.Figure()).draw()


def test_columns_of_objects_are_words_or_numbers():
    options = {"style": "plain", "color": "q", "show": "q > 1"}
    plain = pixels(X, options, radius=0.5, columns={"q": [3.0, 1, 2]})
    for values in (np.array([3.0, 1, 2], object), np.array([3, 1, 2], object), [Fraction(3), True, np.float32(2)]):
        assert same(pixels(X, options, radius=0.5, columns={"q": values}), plain)
    for values in ([3, None, 2.0], np.array([3, np.nan, 2], object), np.ma.array([3, 7, 2], mask=[0, 1, 0]),
                   np.ma.array([3, 7, 2], object, mask=[0, 1, 0]), [np.float64(3), None, Fraction(2)]):
        found = FigureData(X, columns={"q": values}).columns["q"]
        assert found.dtype == "f8" and found[0] == 3 and np.isnan(found[1]) and found[2] == 2
    words = ["A", "", "B"]
    for values in (["A", None, "B"], np.array(["A", np.nan, "B"], object), np.array([b"A", None, b"B"], object),
                   np.ma.array(["A", "x", "B"], mask=[0, 1, 0]), np.ma.array([b"A", b"x", b"B"], mask=[0, 1, 0]),
                   np.ma.array(["A", "x", "B"], object, mask=[0, 1, 0])):
        assert FigureData(X, columns={"q": values}).columns["q"].texts.tolist() == words
    assert FigureData(X, columns={"q": np.array([b"A", b"\xff", b"B"])}).columns["q"].texts[1] == "\ufffd"
    assert FigureData(X, columns={"id": np.array([7, 8, 9], object)}).columns["id"].tolist() == [7, 8, 9]
    for values in (["A", 1, 2.0], np.array([1, "2", 3], object), [object()] * 3, [1, 2j, 3], [[1], [2], [3]],
                   np.array([1, 10**30, 2], object), np.array([1j, 2, 3], object), np.zeros(3, "M8[s]"),
                   np.ma.array(np.zeros(3, "M8[s]"), mask=[0, 1, 0]), np.ma.array([1j, 2, 3], mask=[0, 1, 0])):
        with pytest.raises(cgt.InvalidArgument, match="^columns: q: "):
            FigureData(X, columns={"q": values})


class Table(dict):
    """As pandas has them."""

    columns = property(lambda self: list(self))

    def to_numpy(self):
        raise NotImplementedError


class Keyed:
    """A table that is neither a dictionary nor of pandas."""

    def keys(self):
        return ["q"]

    def __getitem__(self, name):
        return {"q": [3.0, 1, 2]}[name]


def test_tables_have_columns_that_nobody_asks_for():
    table = Table(x=X[:, 0], y=X[:, 1], z=X[:, 2], q=np.array([3, 1, 2], object), day=np.array([set()] * 3, object))
    plain = pixels(X, {"style": "plain", "color": "q"}, radius=0.5, columns={"q": [3.0, 1, 2]})
    assert same(pixels(table, {"style": "plain", "color": "q"}, radius=0.5), plain)
    with pytest.raises(cgt.InvalidArgument, match=r"^columns: day: objects \(set\)"):
        pixels(table, {"color": "day"}, radius=0.5)
    assert same(pixels(X, {"style": "plain", "color": "q"}, radius=0.5, columns=Keyed()), plain)


def test_words_may_lack_in_a_frame():
    figure = cgt.Figure(**SIZE, style="plain", color="q")
    figure.show(X, radius=0.5, columns={"q": ["A", "B", "A"]})
    figure.show(X, radius=0.5, columns={"q": [None] * 3})
    assert figure.pixels.std() > 5
    for values in (["A", np.ma.masked, "B"], list(np.ma.array(["A", "x", "B"], mask=[0, 1, 0]))):
        assert FigureData(X, columns={"q": values}).columns["q"].texts.tolist() == ["A", "", "B"]


def test_what_is_refused_is_named():
    figure, box = cgt.Figure(**SIZE, style="plain"), {"cell": np.eye(3)}
    for more, name in (
        ({**box, "pbc": (1, 1)}, "pbc"), ({**box, "pbc": "yes"}, "pbc"), ({**box, "pbc": (1.5, 1, 1)}, "pbc"),
        ({**box, "unwrapped": (1, 1)}, "unwrapped"), ({**box, "corner": 1}, "corner"), ({"time": "1 ps"}, "time"),
        ({"time": [1, 2]}, "time"), ({"number": 2**63}, "number"), ({"step": 2**63}, "step"),
        ({"columns": [1, 2, 3]}, "columns"), ({"columns": zip("a", [[1, 2, 3]])}, "columns"),
        ({"radius": -1}, "radius"), ({"radius": np.nan}, "radius"), ({"radius": np.inf}, "radius"),
        ({"angstrom": -1}, "angstrom"), ({"angstrom": np.nan}, "angstrom"), ({"cell": "a"}, "cell"),
        ({"bonds": "a"}, "bonds"),
    ):
        with pytest.raises(cgt.InvalidArgument, match=f"^{name}: "):
            figure.show(X, **more)
        with pytest.raises(cgt.InvalidArgument, match=f"^{name}: "):
            figure.survey([X, X], **more)
    for pbc, wanted in ((256, [1, 1, 1]), (True, [1, 1, 1]), ((0, 1, -1), [0, 1, -1]),
                        (np.array([0, 2, 0]), [0, 1, 0])):
        data = FigureData(X, **box, pbc=pbc, unwrapped=pbc)
        assert data.periodic.tolist() == wanted and data.unwrapped.tolist() == [w != 0 for w in wanted]
    for options, name in (({"range": (None, 5)}, "range"), ({"slice": np.eye(2, 4)}, "slice"), ({"zoom": 1j}, "zoom"),
                          ({"zoom": [None]}, "zoom"), ({"zoom": [b"2"]}, "zoom"), ({"zoom": np.array(True)}, "zoom")):
        with pytest.raises(cgt.InvalidArgument, match=f"^{name}: "):
            figure.set(**options)
    assert figure.set(zoom=np.array(2.0)).options["zoom"] == "2.0"
    figure.set(zoom=None).show(X)
    for call, name in ((lambda: figure.save("a.png", dpi="300"), "dpi"), (lambda: figure.save(5), "path"),
                       (lambda: figure.save("a\0.png"), "path"), (lambda: figure.movie(5, [X]), "path"),
                       (lambda: cgt.show(X, colors="red", columns=[1]), "columns"),
                       (lambda: cgt.show(X, colors=[1]), "columns: colors"),
                       (lambda: cgt.show(X, colors=np.array(5)), "colors"),
                       (lambda: cgt.show(X, colors=X / 4, columns=[1]), "columns")):
        with pytest.raises(cgt.InvalidArgument, match=f"^{name}"):
            call()


def test_what_is_refused_changes_nothing():
    figure = cgt.Figure(**SIZE, color="v").show(X, columns={"v": [1, 2, 3]})
    before, settings = figure.pixels, figure.settings
    for options, message in (
        ({"colour": 1}, "there is no option 'colour': did you mean color"),
        ({"title": True}, "title: True: must have a value, TEXT"),
        ({"fov": "wide"}, "fov: "), ({"fov": {1: 2}}, "fov: it takes no dictionary"),
        ({"style": "paper", "antialias": 3}, "antialias: 3 is not 1, 2 or 4"),
        ({"material": {2: "glass"}}, "material is for bounces"), ({"size": object()}, "size: <object"),
        ({"show": "x >"}, "show: "), ({"camera_keys": "x"}, "camera.keys"),
        ({"title": "a\0b"}, "title: .*C cannot read"), ({"title": "a\nb"}, "title: .*C cannot read"),
    ):
        with pytest.raises(cgt.InvalidArgument, match=message):
            figure.set(**options)
        assert figure.settings == settings and figure.draw() is not before and np.array_equal(figure.pixels, before)
    for data, more, message in (
        (X, {"columns": {"v": [1, 2]}}, r"columns: v: shape \(2,\): must be \(3,\)"),
        (X, {"columns": {"u": [1, 2, 3]}}, 'no column "v", but x, y, z, u'),
        (X, {"columns": {"type": [1, 2, -1]}}, "type: -1 to 2: must fit uint32"),
        (X, {"bonds": [[0, 3]]}, "bond 0 ends at 3"), ((X, [[0, 1, 3]]), {}, "triangle 0 has the corner 3"),
        (X, {"cell": [[1, 2]]}, "cell: shape"), ([], {}, "positions: shape"), (X[:, :2], {}, "positions: shape"),
        ({"x": 1}, {}, "positions"), (X, {"number": -1}, "number: -1"), (X, {"colour": 1}, "colour"),
        ("a.xyz", {}, "data: 'a.xyz': cgt.read opens files"), (None, {}, "positions"), (5.0, {}, "positions: shape"),
    ):
        with pytest.raises((cgt.InvalidArgument, TypeError), match=message):
            figure.show(data, **more)
    with pytest.raises(cgt.InvalidArgument, match="nothing is shown"):
        cgt.Figure().draw()
    with pytest.raises(cgt.InvalidArgument, match="a run without frames"):
        cgt.Figure().survey(iter(()))
    figure.close()
    with pytest.raises(cgt.InvalidArgument, match="figure: it is closed"):
        figure.draw()


def test_options_count_at_once_and_surveys_for_a_run():
    figure = cgt.Figure(**SIZE, style="plain").show(X, radius=0.5)
    first = figure.pixels
    assert figure.pixels is first and same(figure.set(color="red").pixels, pixels(X, {"style": "plain", "color": "red"},
                                                                                 radius=0.5))
    run = [X * scale for scale in (1, 2, 5)]
    surveyed = cgt.Figure(**SIZE).survey(run)
    assert not np.array_equal(surveyed.show(X).camera.eye, cgt.Figure(**SIZE).show(X).camera.eye)
    assert same(surveyed.show(X).pixels, cgt.Figure(**SIZE).survey(iter(run)).show(X).pixels)
    with pytest.raises(cgt.InvalidArgument, match="nothing is shown"):
        surveyed.set(color="red").draw()
    turned = surveyed.show(X).camera
    turned.orbit(90)
    surveyed.camera = turned
    assert not np.array_equal(surveyed.draw(), before := surveyed.show(run[2]).pixels) and before.std() > 5
    assert np.array_equal(surveyed.camera.eye, turned.eye) and not np.array_equal(surveyed.fit().camera.eye, turned.eye)
    flat = cgt.Camera((1, 2, -9), up=(0, 0, 1), projection="orthographic", height=3)
    wanted = cgt.Figure(**SIZE, camera=flat).show(X).pixels
    ortho = cgt.Figure(**SIZE, ortho=True).show(X)
    first = ortho.camera
    ortho.camera = first
    assert same(ortho.pixels, pixels(X, {"ortho": True}), pixels(X, {"camera": first}))
    ortho.camera = flat
    assert same(ortho.pixels, wanted) and ortho.camera.height == pytest.approx(3)
    first.height /= 2
    ortho.camera = first
    assert ortho.camera.height == pytest.approx(first.height) and not np.array_equal(ortho.pixels, wanted)
    with pytest.raises(cgt.InvalidArgument, match="camera: it is orthographic, and the option ortho is not set"):
        surveyed.camera = flat
    with pytest.raises(cgt.InvalidArgument, match="camera: t_min, t_max and mask: an option has none"):
        cgt.Figure(camera=cgt.Camera((0, -9, 1), t_min=1))
    hit = cgt.Figure(**SIZE, view="front").show(X[:1], radius=2).pick(30, 20)
    assert hit.is_hit and hit.is_data and hit.element == 0 and np.linalg.norm(hit.place) == pytest.approx(2, 1e-3)
    far = cgt.Figure(**SIZE).show(X + 1e7)
    assert same(far.pixels, pixels(X)) and abs(far.camera.target).max() < 10
    wall = cgt.Figure(**SIZE).set_mesh((X + [0, 2, 0], [[0, 1, 2]])).show(X)
    assert not np.array_equal(wall.pixels, pixels(X)) and wall.set_mesh(None).show(X).pixels.std() > 5
    clear = cgt.Figure(**SIZE, transparent=True).show(X)
    assert clear.pixels.shape == (40, 60, 4) and set(clear.pixels[..., 3].ravel()) >= {0, 255}
    assert any("log_scale" in text for text in cgt.Figure(**SIZE, color="x", log_scale=True).show(X[:1] - 1).notices)


def test_show_is_a_figure_in_a_line():
    plain = cgt.show(X, 0.5, **SIZE)
    assert isinstance(plain, cgt.Figure) and plain._repr_png_()[1:4] == b"PNG" and cgt.Figure()._repr_png_() is None
    assert same(cgt.show(X, 0.5, "r", **SIZE).pixels, cgt.show(X, 0.5, ["red"] * 3, **SIZE).pixels,
                cgt.show(X, 0.5, (1.0, 0, 0), **SIZE).pixels, cgt.show(X, [0.5] * 3, [[1, 0, 0]] * 3, **SIZE).pixels,
                cgt.show(X, 0.5, np.full((3, 3), [255, 0, 0], "u1"), **SIZE).pixels)
    values = np.array([3.0, 1, 2])
    assert same(cgt.show(np.tile(X, (2, 1)), 0.5, np.tile(values, 2), **SIZE).pixels,
                pixels(np.tile(X, (2, 1)), {"color": "v"}, radius=0.5, columns={"v": np.tile(values, 2)}))
    assert same(cgt.show(X, 0.3, bonds=PAIRS, **SIZE).pixels, pixels(X, {"bonds": True}, radius=0.3, bonds=PAIRS))
    assert same(cgt.show(X, 0.3, bonds=2.5, **SIZE).pixels, pixels(X, {"bonds": 2.5}, radius=0.3))
    with pytest.raises(cgt.InvalidArgument, match="bonds: the file has no bonds"):
        cgt.show(X, bonds=True, **SIZE)
    with pytest.raises(cgt.InvalidArgument, match="colors: color says another thing"):
        cgt.show(X, colors="red", color="x")


def test_other_packages_have_the_same_data(tmp_path):
    mesh = [[0, 1, 2]]
    assert same(pixels((X, mesh)), pixels(types.SimpleNamespace(vertices=X, faces=mesh)))
    water = np.array([[0.0, 0, 0.1], [0.76, 0, 0.69], [-0.76, 0, 0.69]])
    options, pairs = {"bonds": True, "radius_scale": 0.4}, [[0, 1], [0, 2]]
    wanted = pixels(water, options, columns={"element": [8, 1, 1]}, bonds=pairs)
    try:
        import ase
    except ImportError:
        pass
    else:
        atoms = ase.Atoms("OHH", water)
        assert same(pixels(atoms, options, bonds=pairs), wanted)
        atoms.set_cell([0.9, 9, 9])
        atoms.pbc = True
        assert same(pixels(atoms, {"box": True}), pixels(water, {"box": True}, columns={"element": [8, 1, 1]},
                                                         cell=[0.9, 9, 9]))
    try:
        import pandas
    except ImportError:
        pass
    else:
        table = pandas.DataFrame({"kind": ["a", "b", "a"], **dict(zip("xyz", water.T))})
        kinds = {"show": 'kind == "a"'}
        by_words = pixels(water, kinds, columns=table[["kind"]])
        assert same(pixels(table, kinds), by_words, pixels(water, {"show": "x <= 0"}))
        with pytest.raises(cgt.InvalidArgument, match="a table needs columns x, y and z"):
            pixels(table[["x", "y"]])
    path = tmp_path / "water.xyz"
    path.write_text("3\n\n" + "".join(f"{s} {x} {y} {z}\n" for s, (x, y, z) in zip("OHH", water)))
    assert same(pixels(cgt.read(path, all_bonds=True).read(), options), wanted)
    path.write_text("1\nProperties=species:S:1:pos:R:3:charge:R:1\nO 0 0 0 5\n")
    with pytest.raises(cgt.InvalidArgument, match="the file has it: cgt.read.*'charge'"):
        pixels(cgt.read(path).read(), {"color": "charge"})
    assert same(cgt.Figure(**SIZE, color="charge").survey(run := cgt.read(path)).show(run[0]).pixels,
                pixels(cgt.read(path, columns="charge").read(), {"color": "charge"}))
    residue = types.SimpleNamespace(name="HOH", resSeq=1, chain=types.SimpleNamespace(index=0))
    kinds = [types.SimpleNamespace(element=types.SimpleNamespace(atomic_number=z), name=s, residue=residue, index=k)
             for k, (z, s) in enumerate([(8, "O"), (1, "H1"), (1, "H2")])]
    topology = types.SimpleNamespace(atoms=kinds, bonds=[(kinds[0], kinds[1]), (kinds[0], kinds[2])])
    nanometres = types.SimpleNamespace(xyz=water[None] / 10, topology=topology, time=[1.0], unitcell_vectors=None)
    close = pixels(nanometres, options).astype(int) - wanted
    assert (abs(close) > 2).mean() < 0.02  # rounded another way
    assert pixels(nanometres, {"show": "resname == HOH and name == O"}).std() > 5


def test_universes_of_mdanalysis():
    MDAnalysis = pytest.importorskip("MDAnalysis")
    universe = MDAnalysis.Universe.empty(3, trajectory=True)
    universe.atoms.positions = X
    assert same(pixels(universe), pixels(X.astype("f4"), columns={"id": [1, 2, 3]}))
    with pytest.raises(cgt.InvalidArgument, match="bonds: the file has no bonds"):
        pixels(universe, {"bonds": True})
    universe.add_TopologyAttr("bonds", PAIRS)
    universe.add_TopologyAttr("elements", ["O", "H", "H"])
    universe.add_TopologyAttr("names", ["OW", "HW1", "HW2"])
    universe.dimensions = [3, 9, 9, 90, 90, 90]
    assert same(pixels(universe, {"bonds": True}), pixels(X, {"bonds": True}, columns={"element": [8, 1, 1]},
                                                          bonds=PAIRS, cell=[3, 9, 9]))
    part = universe.atoms[[2, 1]]
    assert same(pixels(part, {"bonds": True}), pixels(X[[2, 1]], {"bonds": True}, columns={"element": [1, 1]},
                                                      bonds=[[0, 1]], cell=[3, 9, 9]))
    assert same(*(pixels(universe, {"show": rule}) for rule in ("name == OW", "element == O", "id == 1")))


def test_movies(tmp_path, monkeypatch):
    run = [X + [0, 0, k] for k in range(4)]
    figure = cgt.Figure(size=(61, 40))
    for path, data, message in (("a.avi", run, "path: .avi: movies are .gif"), ("a.mp4", X, "run: ndarray"),
                                ("a.mp4", [], "run: list")):
        with pytest.raises(cgt.InvalidArgument, match=message):
            figure.movie(tmp_path / path, data)
    if shutil.which("ffmpeg"):
        for name in ("a.mp4", "a.gif"):
            figure.movie(tmp_path / name, (x for x in run), fps=10, progress=False)
            command = ["ffmpeg", "-v", "error", "-i", tmp_path / name, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
            raw = subprocess.run(command, capture_output=True, check=True).stdout
            width = 61 if name == "a.gif" else 62
            last = np.frombuffer(raw, "u1").reshape(4, 40, width, 3)[-1, :, :61]
            assert abs(last.astype(int) - figure.pixels).mean() < 6
        before = (tmp_path / "a.gif").read_bytes()
        for nothing in (iter([]), (x for x in ())):
            with pytest.raises(cgt.InvalidArgument, match="^run: without frames"):
                figure.movie(tmp_path / "a.gif", nothing, survey=False, progress=False)
        assert (tmp_path / "a.gif").read_bytes() == before
        with pytest.raises(cgt.InvalidArgument, match="positions: shape"):
            figure.movie(tmp_path / "b.mp4", [*run, X[:, :2]], survey=False, progress=False)
        assert sorted(os.listdir(tmp_path)) == ["a.gif", "a.mp4"]
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(cgt.InvalidArgument, match="movies need the program ffmpeg"):
        figure.movie(tmp_path / "a.mp4", run)


def test_show_opens_the_window(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(cgt.InvalidArgument, match="no cgt-view"):
        cgt.show(X, window=True, **SIZE)
    view = tmp_path / "cgt-view"
    view.write_text('#!/bin/sh\nprintf "%s\\n" "$@" >"$0.args"\n/bin/cp "$2" "$0.settings"\n/bin/cp "$3" "$0.file"\n')
    view.chmod(0o755)
    cgt.show(X, [0.5, 0.5, 1], window=False, **SIZE)
    assert not (tmp_path / "cgt-view.args").exists()
    cgt.show(X, [0.5, 0.5, 1], "q", columns={"type": [2, 1, 2], "q": [1, 2.5, 3]}, window=True, **SIZE)
    _show._Window._open[-1].process.wait()
    assert (tmp_path / "cgt-view.settings").read_text() == "size = 60x40\ncolor = q\n"
    frame = cgt.read(tmp_path / "cgt-view.file", format="xyz", columns="q").read()
    assert np.array_equal(frame.positions, X) and frame.radii.tolist() == [0.5, 0.5, 1]
    assert frame.types.tolist() == [2, 1, 2] and frame["q"].tolist() == [1, 2.5, 3]
    monkeypatch.setattr(_show, "_can_open", lambda: True)
    (tmp_path / "cgt-view.args").unlink()
    cgt.show(X, **SIZE)  # at a prompt
    _show._Window._open[-1].process.wait()
    assert (tmp_path / "cgt-view.args").exists()
    folders = [window.folder for window in _show._Window._open]
    _show._Window._close_all()
    assert not any(os.path.exists(folder) for folder in folders)


PAGE = """
import page from PATH;
const sent = [], listeners = {}, taken = [];
const image = { style: {}, addEventListener: (name, f) => { listeners[name] = f; }, setPointerCapture() {} };
globalThis.document = { createElement: () => image };
URL.createObjectURL = (blob) => `blob ${blob.size}`;
URL.revokeObjectURL = (url) => taken.push(url);
let hear = null;
const model = { send: (m) => sent.push({ ...m }), on: (_, f) => { hear = f; }, off() {} };
page.render({ model, el: { appendChild() {} } });
const picture = () => hear({ width: 60 }, [new Uint8Array(5)]);
picture();
listeners.pointermove({ clientX: 9, clientY: 9 }); // nothing is held
listeners.pointerdown({ clientX: 1, clientY: 1, pointerId: 1 });
for (const k of [4, 6, 9]) listeners.pointermove({ clientX: k, clientY: 1 }); // two while one is under way
picture();
listeners.pointerup();
picture();
picture();
listeners.wheel({ preventDefault() {}, deltaY: 500 });
picture();
listeners.dblclick();
console.log(JSON.stringify({ sent, src: image.src, width: image.width, taken: taken.length }));
"""


def test_the_mouse_turns_it_in_a_notebook(tmp_path, monkeypatch):
    figure = cgt.Figure(**SIZE).show(X)
    if importlib.util.find_spec("anywidget") is None:
        assert figure._repr_mimebundle_() is None  # then _repr_png_ counts
        sent, calls = [], {"on_msg": lambda self, call: None, "_repr_mimebundle_": lambda self: ({"a/view": {}}, {})}
        base = type("AnyWidget", (), {**calls, "send": lambda self, *a, **b: sent.append((a, b))})
        module = types.ModuleType("anywidget")
        module.AnyWidget, module.__spec__ = base, importlib.machinery.ModuleSpec("anywidget", None)
        monkeypatch.setitem(sys.modules, "anywidget", module)
    else:
        pytest.skip("anywidget wants a kernel")
    bundle = figure._repr_mimebundle_()
    assert set(bundle) == {"a/view", "image/png", "text/plain"} and bundle["image/png"] == figure._repr_png_()
    from cgt import _widget

    widget, still = _widget.Turned(figure), {"x": 0, "y": 0, "zoom": 1, "fit": False, "rest": True}
    first, eyes, distances = figure.pixels, [figure.camera.eye], []
    for told in ({}, {"x": 30, "rest": False}, {"y": 900}, {"zoom": 2}, {"fit": True}):
        widget._hear(widget, {**still, **told}, None)
        eyes.append(figure.camera.eye)
        distances.append(np.linalg.norm(eyes[-1] - figure.camera.target))
        assert sent[-1][0] == ({"width": 60},) and sent[-1][1]["buffers"][0][1:4] == b"PNG"
    assert np.array_equal(eyes[0], eyes[1]) and abs(eyes[2][2] - eyes[1][2]) < 1e-4 and eyes[3][2] > eyes[2][2]
    assert distances[:4] == pytest.approx([distances[0] * k for k in (1, 1, 1, 2)], 1e-5)
    assert distances[4] < distances[3] and not np.array_equal(figure.pixels, first)
    node = shutil.which("node")
    if node is None:
        return
    (tmp_path / "page.mjs").write_text(_widget.Turned._esm)
    (tmp_path / "test.mjs").write_text(PAGE.replace("PATH", '"./page.mjs"'))
    found = json.loads(subprocess.run([node, tmp_path / "test.mjs"], capture_output=True, check=True).stdout)
    assert [(m["x"], m["zoom"], m["fit"], m["rest"]) for m in found["sent"]] == [
        (0, 1, False, True), (3, 1, False, False), (5, 1, False, False), (0, 1, False, True),
        (0, pytest.approx(np.e), False, True), (0, 1, True, True)]
    assert found["src"] == "blob 5" and found["width"] == 60 and found["taken"] == 4


def test_words_keep_their_colours_from_frame_to_frame():
    x = np.array([[0, 0, 0], [2, 0, 0], [4, 0, 0]], np.float32)
    figure = cgt.Figure(size=(96, 32), color="kind", camera="2,0,9,2,0,0,0,1,0,40", style="plain")
    figure.survey(x, radius=0.9, columns={"kind": ["oil", "salt", ""]})
    figure.survey(x, radius=0.9, columns={"kind": ["salt", "oil", "air"]})
    first = figure.show(x, radius=0.9, columns={"kind": ["oil", "salt", "oil"]}).draw().copy()
    then = figure.show(x, radius=0.9, columns={"kind": ["salt", "salt", "oil"]}).draw()
    assert [(first[16, c] == then[16, c]).all() for c in (38, 48, 58)] == [False, True, True]
    assert (first[16, 48] != first[16, 58]).any() and (first[16, 48] != first[2, 2]).any()


def test_atoms_without_a_word_have_none(tmp_path):
    path = tmp_path / "two.pdb"
    path.write_text("ATOM      1  CA  ALA A   1       0.000   0.000   0.000  1.00  0.00           C\n"
                    "ATOM      2  CB  ALA     1       1.500   0.000   0.000  1.00  0.00           C\nEND\n")
    assert cgt.read(path, columns=["chain"])[0]["chain"].tolist() == ["A", ""]


def test_sheets_have_their_bonds_through_two_boundaries():
    x, cell = [[0.2, 1, 0], [3.8, 1, 0]], np.diag([4.0, 4, 0])
    pictures = [cgt.show(x, 0.3, bonds=[[0, 1]], cell=edges, pbc=(True, True, False), width=64, height=48, ambient=0,
                         window=False).pixels for edges in (cell, np.diag([4.0, 4, 30]))]
    assert np.array_equal(*pictures)
    assert not np.array_equal(pictures[0], cgt.show(x, 0.3, bonds=[[0, 1]], size=(64, 48), ambient=0).pixels)
    mapped = cgt.show(x, 0.3, [1.0, 2.0], map="magma", low=1, high=2, size=(64, 48), ambient=0, window=False).pixels
    assert np.array_equal(mapped, cgt.show(x, 0.3, [1.0, 2.0], colormap="magma", range=(1, 2), size=(64, 48), ambient=0,
                                           window=False).pixels)


def test_runs_of_meshes():
    cube = np.array([[x, y, z] for x in (-1.0, 1) for y in (-1, 1) for z in (-1, 1)])
    corners = np.array([[0, 1, 3], [0, 3, 2], [4, 7, 5], [4, 6, 7], [0, 5, 1], [0, 4, 5], [2, 3, 7], [2, 7, 6]])
    run = [(cube, corners[:7]), (2 * cube, corners[:7])]
    wanted = cgt.Figure(**SIZE).survey(iter(run)).show(run[0]).pixels
    for meshes in (run, [(a.tolist(), b.tolist()) for a, b in run], (m for m in run)):
        assert same(cgt.Figure(**SIZE).survey(meshes).show(run[0]).pixels, wanted)
    assert same(pixels((cube.tolist(), corners[:7].tolist())), pixels(run[0]))
    assert is_run([[[0, 0, 0]], [[1, 1, 1]]]) and not is_run([[0, 0, 0], [1, 1, 1]]) and not is_run([])


def test_a_drawn_picture_is_the_callers():
    figure = cgt.Figure(**SIZE).show(X, radius=0.5)
    first = figure.draw()
    kept = first.copy()
    first[:] = 0
    assert same(figure.pixels, kept) and same(figure.draw(), kept)


def test_colours_of_a_tuple_are_those_of_a_list():
    frame, rows = {"window": False, "radii": 0.5, **SIZE}, [(1.0, 0, 0), (0, 1, 0), (0, 0, 1)]
    for colors in (["red", "blue", "gold"], rows, [1.0, 2, 3, 4]):
        data = np.vstack([X, X[:1] + 1])[:len(colors)]
        assert same(cgt.show(data, colors=colors, **frame).pixels, cgt.show(data, colors=tuple(colors), **frame).pixels)
    assert same(cgt.show(X, colors=(1, 0, 0), **frame).pixels, cgt.show(X, colors="red", **frame).pixels)
    assert "color" not in cgt.show(X, colors=("red",) * 3, **frame).options
    bonded = {"data": X, "bonds": PAIRS}
    assert same(cgt.show(X, bonds=None, **frame).pixels, cgt.show(X, **frame).pixels)
    assert "bonds" not in cgt.show(X, bonds=None, **frame).options
    assert "bonds" not in cgt.show(X, bonds=np.False_, **frame).options and cgt.show(**bonded, **frame).options["bonds"]


def test_three_numbers_are_a_colour_for_all():
    x, like = np.random.default_rng(1).uniform(0, 5, (20, 3)), {"size": (64, 48), "window": False}
    red = cgt.show(x, 0.3, "red", **like).pixels
    for same in ([1.0, 0, 0], (1, 0, 0), np.array([255, 0, 0], np.uint8)):
        assert np.array_equal(cgt.show(x, 0.3, same, **like).pixels, red)
    with pytest.raises(cgt.InvalidArgument, match="colors: 60 to 200: must be from 0 to 1"):
        cgt.show(x, 0.3, [200, 60, 60], **like)
    values = cgt.show(x[:3], 0.3, [1.0, 2, 3], **like).pixels
    assert not np.array_equal(values, cgt.show(x[:3], 0.3, "red", **like).pixels)


def test_arrays_that_were_shown_keep_their_memory_and_shape():
    names = np.array(["A", "B"] * 20)
    given = {"columns": {"heat": np.arange(40.0), "name": names}, "bonds": np.array([[0, 1], [2, 3]], np.uint32)}
    places = np.random.default_rng(0).uniform(-1, 1, (40, 3))
    corners = np.array([[0, 1, 2], [3, 4, 5]], np.uint32)
    figure = cgt.Figure(**SIZE, color="heat", bonds=True).show(places, radius=0.1, **given)
    wall = cgt.Figure(**SIZE).set_mesh((places, corners)).show((places, corners))
    wanted, walled = figure.pixels, wall.pixels
    for a in (places, given["columns"]["heat"], names, given["bonds"], corners):
        with pytest.raises(ValueError):
            a.resize(2 * a.size, refcheck=False)
        a.shape = (a.size, 1)
    for way in (copy.copy, copy.deepcopy, lambda f: pickle.loads(pickle.dumps(f)), lambda f: f):
        assert same(way(figure).set(title="").set(title=None).pixels, wanted)
        assert same(way(wall).set_mesh(None).set_mesh((places.reshape(40, 3), corners.reshape(2, 3))).pixels, walled)
    places.__setstate__((1, (3,), places.dtype, False, bytes(24)))
    with pytest.raises(BufferError, match="positions: the array's memory was replaced"):
        figure.set(title="").draw()


def test_a_frame_that_is_refused_leaves_the_others():
    style = {"style": "plain", "color": "v"}
    heat, bad = {"radius": 0.5, "columns": {"v": [1, 2, 3]}}, {"columns": {"u": [1, 2, 3]}}
    more, run = {"radius": 0.5, "columns": {"v": [0, 9, 20]}}, [X, 4 * X]

    def refused():
        return pytest.raises(cgt.InvalidArgument, match='no column "v"')

    def new():
        return cgt.Figure(**SIZE, **style)

    numbered = new().show(X, **heat).show(X, **heat)
    with refused():
        numbered.show(X, **bad)
    assert numbered.draw() is not None and numbered._counts == [1, 2]  # by the number that it had
    first, wide = new().show(X, **heat), new().survey(X, **heat).survey(4 * X, **more)
    wanted, surveyed = first.pixels, wide.show(X, **heat).pixels
    assert not same(wanted, surveyed)
    for figure, pictures in ((first, wanted), (wide, surveyed)):
        figure.show(3 * X, **more)
        with refused():
            figure.show(X, **bad)
        assert same(figure.draw(), figure.show(3 * X, **more).pixels)
        figure.show(X, **heat)
        assert same(figure.pixels, pictures) and same(figure.show(X, **heat).pixels, pictures)
    with refused():
        first.survey(X, **bad)
    assert same(first.pixels, wanted)
    # a survey that goes on, and those of a run
    figure = new().survey(X, **heat)
    with refused():
        figure.survey(9 * X, **bad)
    assert same(figure.survey(4 * X, **more).show(X, **heat).pixels, surveyed)
    for again in (lambda f: f.show(X, **heat), lambda f: f.survey([X], **heat).show(X, **heat),
                  lambda f: f.survey(X, **heat).show(X, **heat)):
        for failing in ([9 * X, None], (x if x is X else 1 / 0 for x in (X, 9 * X))):
            figure = new()
            with pytest.raises((cgt.InvalidArgument, ZeroDivisionError)):
                figure.survey(failing, **heat)
            assert same(again(figure).pixels, wanted)
    for figure, pictures in ((new().show(X, **heat), wanted), (wide, surveyed)):
        for failing in (lambda f: f.survey([*run, None], **heat), lambda f: f.survey(9 * X, **bad),
                        lambda f: f.survey([9 * X], **bad)):
            kept = figure.draw()
            with pytest.raises(cgt.InvalidArgument, match="positions|no column"):
                failing(figure)
            assert figure.pixels is not kept and same(figure.pixels, pictures, figure.draw())
            assert same(figure.show(2 * X, **more).pixels, figure.draw())
            figure.show(X, **heat)
    turned, square = wide.camera, (X - 1, [[0, 1, 2]])
    turned.orbit(30)
    wide.camera = turned
    other = new().set_mesh(square).survey(run, **heat).show(X, **heat)
    other.camera = turned
    wide.set_mesh(square).survey(run, **heat).show(X, **heat)  # camera and mesh stay
    assert same(wide.pixels, other.pixels)
    empty = new()
    with refused():
        empty.show(9 * X, **bad)
    assert same(empty.show(X, **heat).pixels, wanted)


def test_a_mesh_stands_where_the_frames_are():
    far = np.array([1e7, -3e6, 0])
    square = np.array([[-1, -1, -1], [5, -1, -1], [5, 2, -1.0]])
    ways = (lambda f, x: f.set_mesh((square + x, [[0, 1, 2]])).show(X + x, radius=0.5),
            lambda f, x: f.show(X + x, radius=0.5).set_mesh((square + x, [[0, 1, 2]])),
            lambda f, x: f.set_mesh((square + x, [[0, 1, 2]])).survey([X + x]).show(X + x, radius=0.5))
    for way in ways:
        near, moved = (way(cgt.Figure(**SIZE, style="plain"), x) for x in (0, far))
        assert near.pick(30, 20).is_hit and same(near.pixels, moved.pixels)
        assert way is ways[2] or same(near.pixels, *(c(moved).pixels for c in (copy.copy, copy.deepcopy)))
    figure = ways[0](cgt.Figure(**SIZE, style="plain"), far)
    assert figure.show(X + far).set_mesh(None).pixels.std() > 5


def test_what_is_shown_anew_is_there_for_all_calls():
    for change in (lambda f: f.set(color="red"), lambda f: f.set_mesh((X - 1, [[0, 1, 2]]))):
        for ask in (lambda f: f.camera.eye.tolist(), lambda f: f.pick(30, 20), lambda f: f.fit().camera.eye.tolist(),
                    lambda f: f._draw_quick(2).tolist()):
            figures = [change(cgt.Figure(**SIZE).show(X)) for _ in range(2)]
            figures[0].draw()
            assert ask(figures[0]) == ask(figures[1])


def test_zeros_in_texts_are_refused():
    for columns in ({"a\0b": [1, 2, 3]}, {"a": ["x\0y", "z", "z"]}, {"a": [b"x\0y", b"z", b"z"]}):
        with pytest.raises(cgt.InvalidArgument, match="^columns: .*a zero is in it"):
            cgt.Figure().show(X, columns=columns)
    for call in (lambda: cgt.colors.palette("viridis\0x"), lambda: cgt.Context(variant=cgt.variants()[0] + "\0x")):
        with pytest.raises(cgt.InvalidArgument, match="a zero is in it"):
            call()


def test_colours_may_lack():
    eye, values = {"data": np.eye(3), "radii": 0.5, **SIZE}, [0, np.nan, 1]
    assert same(cgt.show(**eye, colors=[0, None, 1]).pixels, cgt.show(**eye, colors=values).pixels)
    assert same(cgt.show(**eye, color="c", columns={"c": values}).pixels, cgt.show(**eye, colors=values).pixels)


@pytest.mark.skipif(not shutil.which("ffmpeg"), reason="movies need ffmpeg")
def test_movies_of_pipes_and_into_folders(tmp_path):
    pipe, movies = tmp_path / "pipe.xyz", tmp_path / "movies"
    os.mkfifo(pipe)
    movies.mkdir()
    writer = threading.Thread(target=lambda: pipe.write_text("1\nframe\nO 0 0 0\n" * 3))
    writer.start()
    with cgt.read(pipe) as run:
        figure = cgt.Figure(**SIZE).movie(movies / "a.mkv", run, progress=False)
        writer.join()
        assert figure._counts == [3, 3]
        with pytest.raises(cgt.InvalidArgument, match="a pipe was read to its end"):
            figure.movie(movies / "b.mkv", run, progress=False)
    (movies / "c.mp4").mkdir()
    with pytest.raises(cgt.InvalidArgument, match="path: .*c.mp4: it is a folder"):
        figure.movie(movies / "c.mp4", [X], progress=False)
    assert sorted(os.listdir(movies)) == ["a.mkv", "c.mp4"]

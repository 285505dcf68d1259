# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""What figures draw, from the objects that others have it in: arrays, frames, meshes, atoms."""
from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from numbers import Number
from typing import Any, Dict, List, NamedTuple, Optional

import numpy as np

from . import _arrays
from ._arrays import F4, F8, I8, U4, Hold, array_of, check_shape, flags, numbers
from ._native import InvalidArgument, encoded, real, whole
from .trajectory import Trajectory, TrajectoryFrame, TrajectorySlice

_WHOLE = ("id", "type", "element")
_OWN = {"x", "y", "z", "vx", "vy", "vz", "radius", *_WHOLE}  # columns of files that frames have as attributes


class Words(NamedTuple):
    """A column of words, and those that go before all others of it."""

    texts: Any
    known: List[str]

    def number(self, table: List[str]) -> np.ndarray:
        """Which word of the table each is, from 1 on, 0 for none. New ones come to its end, in the order of the data."""
        words, first, place = np.unique(self.texts, return_index=True, return_inverse=True)
        at = {word: i for i, word in enumerate(table, 1)}
        for word in [*self.known, *words[np.argsort(first)].tolist()]:
            if word and word not in at:
                table.append(word)
                at[word] = len(table)
        return np.array([at.get(word, 0) for word in words.tolist()], F4)[place.reshape(-1)]


class FigureData:
    """A frame as <cgt/figure.h> takes it: arrays of its types, which C copies.

    What is the caller's is held where it lies, in the shape that it has now: C is told of no other.
    """

    def __init__(self, positions, *, radius=None, columns: Optional[Mapping] = None, bonds=None, cell=None, pbc=True,
                 triangles=None, corner=(0.0, 0.0, 0.0), unwrapped=(0, 0, 0), angstrom: float = 1.0,
                 number: Optional[int] = None, step: Optional[int] = None, time: Optional[float] = None,
                 origin=None, unread=(), odd: Optional[Mapping] = None):
        self._holds: Dict[str, Hold] = {}
        self.positions = self._hold("positions", _floats("positions", positions, ("n", 3)))
        count = len(self.positions)
        self.columns: Dict[str, Any] = {}
        self.radius, self.angstrom, self.origin = 0.0, _from_0("angstrom", angstrom), origin
        for name, values in ({} if columns is None else columns_of(columns)).items():
            a = _column(str(name), values, count)
            at = f"columns: {name}"
            self.columns[str(name)] = (Words(self._hold(at, a.texts), a.known) if isinstance(a, Words) else
                                       self._hold(at, a))
        if radius is not None and array_of("radius", radius).ndim:
            self.columns["radius"] = self._hold("radius", numbers("radius", radius, F4, (count,)))
        elif radius is not None:
            self.columns.pop("radius", None)
            self.radius = _from_0("radius", radius)
        self.triangles = None
        if triangles is not None:
            self.triangles = self._hold("triangles", numbers("triangles", triangles, U4, ("m", 3)))
        self.bonds = None
        if bonds is not None:
            pairs = array_of("bonds", bonds)
            pairs = numbers("bonds", pairs if pairs.size else np.empty((0, 2), U4), U4, ("m", 2))
            self.bonds = self._hold("bonds", pairs)
        self.edges = None
        if cell is not None:
            edges = self._hold("cell", numbers("cell", cell, F8))
            self.edges = np.diag(edges) if edges.shape == (3,) else edges
            check_shape("cell", self.edges, (3, 3))
            self.periodic, self.unwrapped = flags("pbc", pbc), flags("unwrapped", unwrapped) != 0
            self.corner = self._hold("corner", numbers("corner", corner, F8, (3,)))
            self._complete()
        self.number, self.step, self.unread, self.odd = number, step, unread, odd or {}
        self.time = None if time is None else self._hold("time", numbers("time", time, F8))
        if self.time is not None and self.time.ndim:
            raise InvalidArgument(f"time: shape {self.time.shape}: must be one number")

    def _hold(self, name: str, a: np.ndarray) -> np.ndarray:
        hold = self._holds[name] = Hold(a)
        return hold.view

    def _complete(self) -> None:
        """Sheets and chains have edges of no length: those are across the others there, as long as the data reach."""
        missing = ~self.edges.any(axis=1)
        if not missing.any() or missing.all() or not np.isfinite(self.edges).all():
            return
        self.edges, self.corner = np.array(self.edges, F8), np.array(self.corner, F8)
        across = np.linalg.svd(self.edges[~missing])[2][-missing.sum():]
        known = np.asarray(self.positions, F8)[np.isfinite(self.positions).all(axis=1)]
        for k, normal in zip(np.flatnonzero(missing), across):
            along = known @ normal if len(known) else np.zeros(1)
            self.edges[k], self.periodic[k] = normal * max(np.ptp(along), 1.0), 0
            self.corner += normal * (along.min() - self.corner @ normal)

    def fill(self, ffi, number: int, origin, keep: list, tables: Dict[str, List[str]]):
        """The C struct, and in `keep` what it points to; tables: of words, by column, from frame to frame."""
        for name, hold in self._holds.items():
            hold.check(name)
        c = ffi.new("cgt_figure_data *")
        c.number = whole("number", number if self.number is None else self.number, 0, 2**63 - 1)
        c.step = c.number if self.step is None else whole("step", self.step, -2**63, 2**63 - 1)
        if self.time is not None:
            keep.append(ffi.new("double *", float(self.time)))
            c.time = keep[-1]
        c.angstrom, c.origin = self.angstrom, origin
        points = c.points
        points.count, points.radius = len(self.positions), self.radius
        self._set(points.positions, self.positions, keep)
        columns = ffi.new("cgt_figure_column[]", len(self.columns))
        for column, (name, values) in zip(columns, self.columns.items()):
            keep.append(ffi.new("char[]", name.encode(errors="replace")))
            column.name = keep[-1]
            is_number = not isinstance(values, Words) and values.dtype.kind == "f" and values.ndim == 1
            if name in tables and is_number and np.isnan(values).all():
                values = Words(np.full(len(values), ""), [])  # words of other frames, all of which this one lacks
            if isinstance(values, Words):
                words = tables.setdefault(name, [])
                values = values.number(words)
                keep += [ffi.new("char[]", str(word).encode(errors="replace")) for word in words]
                keep.append(ffi.new("const char *[]", keep[len(keep) - len(words):]))
                column.words, column.word_count = keep[-1], len(words)
            self._set(column.values, values, keep)
        keep.append(columns)
        points.columns, points.column_count = columns, len(self.columns)
        if self.triangles is not None:
            c.triangles.count = len(self.triangles)
            self._set(c.triangles.corners, self.triangles, keep)
        if self.bonds is not None:
            keep.append(np.array(self.bonds, order="C"))  # C checks them, and reads them again
            c.bonds.count, c.bonds.ends = len(self.bonds), _arrays.pointer(keep[-1])
        if self.edges is not None:
            box = c.box
            box.corner, box.edges, box.periodic = self.corner.tolist(), self.edges.tolist(), self.periodic.tolist()
            box.unwrapped = self.unwrapped.tolist()
        return c

    @staticmethod
    def _set(struct, values, keep) -> None:
        keep.append(Hold(np.ascontiguousarray(values)))
        _arrays.set_array(struct, keep[-1].view, 0)


def _floats(name: str, values, shape) -> np.ndarray:
    a = array_of(name, values)
    return numbers(name, a, a.dtype if a.dtype == F4 else F8, shape)


def _from_0(name: str, value) -> float:
    """A number of which C takes 0 and what is below for none."""
    number = real(name, value)
    if not 0 <= number < np.inf:
        raise InvalidArgument(f"{name}: {value}: must be 0, as by default, or above")
    return number


def of_objects(name: str, a: np.ndarray) -> np.ndarray:
    """Words or numbers of an array of objects, as tables have them; what is missing is no word, or NaN."""
    if a.size and all(x.__class__ is str for x in a.flat):  # of large molecules, in each frame
        return a.astype(str)
    missing = np.array([x is None or type(x).__name__ == "NAType" or (isinstance(x, (float, np.floating)) and x != x)
                        for x in a.flat], bool).reshape(a.shape)
    found = a[~missing].tolist()
    if found and all(isinstance(x, (str, bytes)) for x in found):
        texts = [x.decode(errors="replace") if isinstance(x, bytes) else x for x in np.where(missing, "", a).flat]
        return np.array(texts, str).reshape(a.shape)
    if not all(isinstance(x, (Number, np.bool_)) and not isinstance(x, (complex, np.complexfloating)) for x in found):
        kinds = ", ".join(sorted({type(x).__name__ for x in found}))
        raise InvalidArgument(f"{name}: objects ({kinds}): must be words or numbers, not both")
    try:
        if len(found) == a.size and all(isinstance(x, (int, np.integer)) for x in found):
            return a.astype(I8)
        return np.where(missing, np.nan, a).astype(F8)
    except OverflowError:
        raise InvalidArgument(f"{name}: whole numbers beyond what 64 bits hold") from None


def _column(name: str, values, count: int):
    """Numbers of a column, or words."""
    encoded("columns", name)  # which C could not read
    known = values.known if isinstance(values, Words) else []
    a = array_of(f"columns: {name}", values.texts if isinstance(values, Words) else values, np.nan)
    if a.dtype.kind in "US" and isinstance(values, (list, tuple)) and not isinstance(values, Words) and a.ndim == 1:
        # numpy makes words of the numbers among them
        a = np.array([None if x is np.ma.masked else x for x in values] + [None], object)[:-1]
    if a.dtype == object:
        a = of_objects(f"columns: {name}", a)
    if a.dtype.kind in "US":
        check_shape(f"columns: {name}", a, (count,))
        texts = a if a.dtype.kind == "U" else np.char.decode(a, "utf-8", "replace")
        for word in texts.tolist():
            if "\0" in word:
                raise InvalidArgument(f"columns: {name}: {word!r}: a zero is in it")
        return Words(texts, known)
    if name in _WHOLE:
        return numbers(name, a, U4, (count,))
    if name in ("velocity", "normal", "rgb"):
        return numbers(name, a, F4, (count, 3))
    a = a.astype(F4) if a.dtype.kind == "b" else a
    return _floats(f"columns: {name}", a, (count,))


# ---- one frame ----


def take(given, **more) -> FigureData:
    """The frame that an object is; `more` replaces what it says."""
    if isinstance(given, (Trajectory, TrajectorySlice)):
        raise InvalidArgument(f"data: {given!r}: show() takes one of its frames; survey() and movie() take all")
    if isinstance(given, (str, os.PathLike)):
        raise InvalidArgument(f"data: {given!r}: cgt.read opens files, and its frames are data")
    if isinstance(given, TrajectoryFrame):
        found = _of_frame(given)
    elif hasattr(given, "get_atomic_numbers"):
        found = _of_ase(given)
    elif hasattr(given, "atoms") and hasattr(given.atoms, "positions"):
        found = _of_mdanalysis(given.atoms)
    elif hasattr(given, "xyz") and hasattr(given, "topology"):
        found = _of_mdtraj(given)
    elif hasattr(given, "vertices") and hasattr(given, "faces"):
        found = {"positions": given.vertices, "triangles": given.faces}
    elif isinstance(given, tuple) and len(given) == 2 and all(_axes(part) == 2 for part in given):
        found = {"positions": given[0], "triangles": given[1]}
    elif hasattr(given, "columns") and hasattr(given, "to_numpy"):
        names = [name for name in given.columns if name not in ("x", "y", "z")]
        if len(names) + 3 != len(given.columns):
            raise InvalidArgument("data: a table needs columns x, y and z")
        places = [_column(name, given[name], len(given[name])) for name in "xyz"]
        if any(isinstance(a, Words) for a in places):
            raise InvalidArgument("data: a table needs numbers in its columns x, y and z")
        found = {"positions": np.column_stack(places),
                 **_usable({str(name): given[name] for name in names}, len(places[0]))}
    else:
        found = {"positions": given}
    more = {name: value for name, value in more.items() if value is not None}
    if "columns" in more:
        table = more["columns"]
        more["columns"] = {**found.get("columns", {}), **columns_of(table)}
    return FigureData(**{**found, **more})


def columns_of(table) -> dict:
    """The columns of a dictionary or a table: what gives them once alone is none, since each frame of a run reads them."""
    if not isinstance(table, Mapping) and not hasattr(table, "keys"):
        raise InvalidArgument(f"columns: {type(table).__name__}: must be a dictionary, or a table")
    return {name: table[name] for name in table.keys()}


def _usable(columns: Mapping, count: int) -> dict:
    """Those of an object that nobody may have asked for; of odd objects, such as dates, what to say where one is."""
    kept, odd = {}, {}
    for name, values in columns.items():
        try:
            kept[name] = _column(name, values, count)
        except InvalidArgument as refused:
            odd[name] = str(refused)
    return {"columns": kept, "odd": odd}


def _of_frame(f: TrajectoryFrame) -> dict:
    """A frame as cgt.read gives it: nothing is lost, so that pictures have the bytes of cgt-render."""
    positions, columns = f.positions, {}
    if f.origin.any():  # C subtracts it again
        positions = positions.astype(F8) + f.origin
    for name, values in (("radius", f.radii), ("element", f.elements), ("type", f.types), ("id", f.ids),
                         ("velocity", f.velocities), ("normal", f.vertex_normals)):
        if values is not None:
            columns[name] = values
    columns.update((name, Words(values, f._words[name]) if name in f._words else values)
                   for name, values in f.columns.items() if name not in _OWN)
    found = {"positions": positions, "columns": columns, "triangles": f.triangles, "bonds": f.bonds,
             "angstrom": f.angstrom, "number": f.number, "step": f.step, "origin": f.origin.tolist(),
             "time": None if np.isnan(f.time) else f.time, "unread": set(f.column_names) - set(f.columns)}
    if f.box_edges is not None:
        found.update(cell=f.box_edges, corner=f.box_origin + f.origin, pbc=f.periodic, unwrapped=f.unwrapped)
    return found


def _of_ase(atoms) -> dict:
    columns, positions = {"element": atoms.get_atomic_numbers()}, atoms.get_positions()
    for name, values in getattr(atoms, "arrays", {}).items():
        if name not in ("numbers", "positions", "momenta") and np.ndim(values) == 1:
            columns["type" if name == "types" else name] = values
    if "momenta" in getattr(atoms, "arrays", {}):
        columns["velocity"] = atoms.get_velocities()
    forces = getattr(getattr(atoms, "calc", None), "results", {}).get("forces")
    if forces is not None and np.shape(forces) == np.shape(positions):
        columns.update(zip(("fx", "fy", "fz"), np.transpose(forces)))
    found = {"positions": positions, **_usable(columns, len(positions))}
    edges = getattr(getattr(atoms, "cell", None), "array", None)
    if edges is not None and edges.any():  # sheets and chains have edges of no length
        found.update(cell=edges, pbc=atoms.pbc & edges.any(axis=1))
    return found


def _of_mdanalysis(atoms) -> dict:
    columns: Dict[str, Any] = {"id": np.asarray(getattr(atoms, "indices", np.arange(len(atoms.positions)))) + 1}
    for name, attribute in (("name", "names"), ("resname", "resnames"), ("resid", "resids"), ("chain", "chainIDs"),
                            ("segment", "segids"), ("charge", "charges"), ("mass", "masses")):
        values = getattr(atoms, attribute, None)
        if values is not None:
            columns[name] = values
    columns.update(_kinds_of(atoms))
    found: Dict[str, Any] = {"positions": atoms.positions, "columns": columns, "bonds": _bonds_among(atoms)}
    universe = getattr(atoms, "universe", None)
    step = getattr(universe, "trajectory", None)
    sides = getattr(universe, "dimensions", None)
    if sides is not None and np.all(sides[:3] > 0):
        from MDAnalysis.lib.mdamath import triclinic_vectors

        found["cell"] = triclinic_vectors(sides)
    if step is not None:
        found.update(number=int(step.ts.frame), time=float(step.ts.time))
        if getattr(step.ts, "has_velocities", False):
            columns["velocity"] = atoms.velocities
    return found


def _kinds_of(atoms) -> dict:
    """Elements of MDAnalysis' atoms, by element, else type; else their types by numbers."""
    try:
        from MDAnalysis.guesser import tables  # from 2.8 on
    except ImportError:
        from MDAnalysis.topology import tables
    for name in ("elements", "types"):
        given = getattr(atoms, name, None)
        found = np.array([tables.SYMB2Z.get(str(s).capitalize(), 0) for s in (() if given is None else given)], int)
        if found.any():
            return {"element": found}
    types = getattr(atoms, "types", None)
    return {} if types is None else {"type": np.unique(np.asarray(types, str), return_inverse=True)[1] + 1}


def _bonds_among(atoms) -> Optional[np.ndarray]:
    """The bonds of MDAnalysis' atoms, by their places among these; None: it has none."""
    pairs = getattr(atoms, "bonds", None)
    if pairs is None:
        return None
    pairs = np.asarray(pairs.indices).reshape(-1, 2)
    order = np.argsort(atoms.indices)
    place = np.minimum(np.searchsorted(atoms.indices, pairs, sorter=order), len(order) - 1)
    return order[place][(atoms.indices[order[place]] == pairs).all(axis=1)]


def _of_mdtraj(run) -> dict:
    if len(run.xyz) != 1:
        raise InvalidArgument(f"data: {len(run.xyz)} frames: one of them, such as traj[0]; a movie takes all")
    atoms, time = list(run.topology.atoms), getattr(run, "time", None)
    columns = {"element": np.array([a.element.atomic_number if a.element else 0 for a in atoms], U4),
               "name": [a.name for a in atoms], "resname": [a.residue.name for a in atoms],
               "resid": [a.residue.resSeq for a in atoms],
               "chain": [str(getattr(a.residue.chain, "chain_id", None) or a.residue.chain.index) for a in atoms]}
    pairs = np.array([[b[0].index, b[1].index] for b in run.topology.bonds], int).reshape(-1, 2)
    found = {"positions": run.xyz[0], "columns": columns, "angstrom": 0.1,  # in nanometres
             "bonds": pairs if len(pairs) else None}
    if time is not None:
        found["time"] = float(time[0])
    if run.unitcell_vectors is not None:
        found["cell"] = run.unitcell_vectors[0]
    return found


# ---- runs ----


def is_run(given) -> bool:
    """Whether an object is frames one after the other."""
    if isinstance(given, (Trajectory, TrajectorySlice)) or hasattr(given, "trajectory"):
        return True
    if isinstance(given, (str, bytes)):
        return False
    if hasattr(given, "xyz") and hasattr(given, "topology"):
        return len(given.xyz) != 1
    return not isinstance(given, tuple) and hasattr(given, "__iter__") and not hasattr(given, "__array__") and not any(
        hasattr(given, name) for name in ("atoms", "get_atomic_numbers", "faces", "to_numpy", "column_names")) and (
            not isinstance(given, list) or bool(given) and not _is_place(given[0]))


def is_read_once(run) -> bool:
    """Whether a run has no frames any more once it was looped over."""
    return isinstance(run, Iterator) or (isinstance(run, Trajectory) and not run.can_rewind)


def _axes(thing) -> int:
    """How many axes something has, by what it begins with: of a mesh, rows are as many as they are."""
    if isinstance(thing, (list, tuple)):
        return 1 + (_axes(thing[0]) if thing else 0)
    return np.ndim(thing)


def _is_place(thing) -> bool:
    """Whether this begins a list of places: it is no frame."""
    return isinstance(thing, (list, tuple, np.ndarray)) and _axes(thing) < 2 or np.isscalar(thing)


def frames_of(run) -> Iterator[Any]:
    """The frames of a run; those of MDAnalysis are what was given, at one time after the other."""
    steps = getattr(run, "trajectory", None)
    if steps is None and hasattr(run, "atoms"):
        steps = getattr(getattr(run, "universe", None), "trajectory", None)
    if steps is not None:
        for _ in steps:
            yield run
    elif hasattr(run, "xyz") and hasattr(run, "topology"):
        for k in range(len(run.xyz)):
            yield run[k]
    else:
        yield from run

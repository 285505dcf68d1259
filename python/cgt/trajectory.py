# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Files of simulators and modellers, frame by frame, as arrays.

LAMMPS, GROMACS, XYZ, PDB, mmCIF, DCD, netCDF, GSD, VASP, VTK, compressed or not, and meshes: docs/guide/scenes.md of
libcgt lists them.
"""
from __future__ import annotations

import os
import warnings
from types import SimpleNamespace
from typing import Any, Iterable, Iterator, Optional, Sequence, Union, overload

import numpy as np

from ._gate import Gate
from ._native import Error, InvalidArgument, Plain, load_part, real, several, struct_values, switch, three, whole
from .geometry import Spheres, Triangles

ffi, lib = load_part("trajectory")
_NUMBER, _WHOLE, _WORD = 1, 2, 3


class ReadError(Error, OSError):
    """A file that cannot be read; the message names the path and the line."""


def _c_path(name: str, path):
    """A path or a name as C takes it."""
    try:
        text = os.fsencode(path)
    except TypeError:
        raise InvalidArgument(f"{name}: {path!r}: must be text or a path") from None
    if b"\0" in text:
        raise InvalidArgument(f"{name}: {path!r}: a zero is in it")
    return ffi.new("char[]", text)


def _array(p, shape, dtype) -> Optional[np.ndarray]:
    """A copy of C's numbers, which are valid until the next frame alone."""
    if p == ffi.NULL:
        return None
    size = int(np.prod(shape, dtype=np.int64)) * np.dtype(dtype).itemsize
    return np.frombuffer(ffi.buffer(p, size), dtype).reshape(shape).copy() if size else np.empty(shape, dtype)


class TrajectoryFrame:
    """One frame. What the file does not have is None.

    Attributes
    ----------
    number, step : int
    time : float
        NaN where the file has none.
    positions : (n, 3) float32
        Of spheres or vertices, in the file's unit, less `origin`.
    radii : (n,) float32
        Of spheres.
    triangles : (m, 3) uint32
        Of meshes, the same in all frames; vertex_normals is (n, 3) float32.
    ids, types : (n,) uint32
    velocities : (n, 3) float32
    elements : (n,) uint8
        Atomic numbers.
    bonds : (b, 2) uint32
        None where neither the file nor elements tell of any: `read` may guess them.
    origin : (3,) float64
        Was subtracted from places and box.
    box_origin, box_edges : (3,), (3, 3) float64
        A corner and the edges; periodic: (3,) int8, -1 where it is unknown; unwrapped: (3,) int8, where positions go
        on beyond the boundary.
    has_radius : bool
        Whether radii are the file's; angstrom: an Angstrom in the file's unit, where it has elements.
    columns : dict
        The columns that were asked for, by name: (n,) float32, words as numpy strings.
    column_names : tuple of str
        All that the file has.
    """

    __slots__ = ("number", "step", "time", "positions", "radii", "triangles", "vertex_normals", "ids", "types",
                 "velocities", "elements", "bonds", "origin", "box_origin", "box_edges", "periodic", "unwrapped",
                 "has_radius", "angstrom", "columns", "column_names", "_words", "__weakref__")

    number: int
    step: int
    time: float
    positions: np.ndarray
    radii: Any  # arrays, or None where the file has none
    triangles: Any
    vertex_normals: Any
    ids: Any
    types: Any
    velocities: Any
    elements: Any
    bonds: Any
    box_origin: Any
    box_edges: Any
    columns: dict[str, np.ndarray]
    column_names: tuple[str, ...]

    def __init__(self, f: Any):
        n = f.count
        self.number, self.step, self.time = f.number, f.step, f.time
        rows = _array(f.xyzr, (n, 4), "f4")
        self.positions = _array(f.position, (n, 3), "f4") if rows is None else rows[:, :3]
        self.radii = None if rows is None else rows[:, 3]
        self.triangles = _array(f.index, (f.triangles, 3), "u4")
        self.vertex_normals = _array(f.vertex_normal, (n, 3), "f4")
        self.ids, self.types = _array(f.id, (n,), "u4"), _array(f.type, (n,), "u4")
        self.velocities = _array(f.velocity, (n, 3), "f4")
        self.elements = _array(f.element, (n,), "u1")
        known = f.bond_source != 0
        self.bonds = np.empty((0, 2), "u4") if known and not f.bonds else _array(f.bond, (f.bonds, 2), "u4")
        self.origin = np.array(list(f.origin))
        edges = np.array([list(edge) for edge in f.box_edge])
        has_box = bool(edges.any())
        self.box_origin = np.array(list(f.box_origin)) if has_box else None
        self.box_edges = edges if has_box else None
        self.periodic, self.unwrapped = (np.array(list(flags), np.int8) for flags in (f.periodic, f.unwrapped))
        self.has_radius, self.angstrom = bool(f.has_radius), f.angstrom
        self.columns, self._words, names = {}, {}, []  # _words: those of the file so far, in its order
        for column in f.column[0:f.columns]:
            name = ffi.string(column.name).decode(errors="replace")
            names.append(name)
            if column.value == ffi.NULL:
                continue
            values = _array(column.value, (n,), "f4")
            if column.kind == _WORD:
                words = [ffi.string(w).decode(errors="replace") for w in column.word[0:column.words]]
                values = np.array(["", *words])[values.astype(np.int64)]
                self._words[name] = words
            self.columns[name] = values
        self.column_names = tuple(names)

    def __len__(self) -> int:
        return len(self.positions)

    def __getitem__(self, name: str) -> np.ndarray:
        """A column by its name."""
        if name not in self.columns:
            why = f"the file has {', '.join(self.column_names)}"
            if name in self.column_names:
                why = "read it with columns="
            raise KeyError(f"{name}: {why}")
        return self.columns[name]

    def geometry(self) -> Union[Spheres, Triangles]:
        """Its spheres or triangles, for `Scene.add` and `Scene.update`."""
        if self.triangles is not None:
            return Triangles(self.positions, self.triangles)
        return Spheres(self.positions, self.radii)

    def __repr__(self) -> str:
        kind = "spheres" if self.triangles is None else f"vertices, {len(self.triangles)} triangles"
        return f"TrajectoryFrame({self.number}, step {self.step}: {len(self)} {kind})"


def _check(handle, result: int) -> bool:
    """Whether there is a frame; raises ReadError with the message of this C trajectory."""
    if result not in (lib.CGT_OK, lib.CGT_END):
        text = ffi.new("char[1024]")
        lib.cgt_trajectory_get_error_message(handle, text, 1024)
        raise ReadError(ffi.string(text).decode(errors="replace"))
    return result == lib.CGT_OK


class Trajectory(Plain):
    """The frames of a file or of a series: loop over it, as often as you like, index it, slice it. `read` opens one.

    ``run[k]`` skips what lies before, and goes back where a file can; the frame after the last one read costs no more
    than `read`. A slice reads nothing until it is used. Loops begin at the first frame; that over a pipe goes on where
    it is. After an error frames before it can be read as ever, and what failed is tried again. One thread at a time
    uses it: others get `InUse`. Reading releases Python's lock. What is doubtful about a file comes as a warning of
    Python's.
    """

    __slots__ = ("_handle", "_gate", "_keep", "_wanted", "_next", "_count", "_failed", "_has_ended")
    _unmade = {"_made": False, "_handle": None, "_gate": Gate("trajectory")}

    def __init__(self, paths, columns: Sequence[str], options: dict):
        if self._handle is not None:
            raise InvalidArgument("trajectory: its __init__ has run")
        paths, columns = several("path", paths, "paths"), several("columns", (
            columns,) if isinstance(columns, str) else columns, "names")
        if not all(isinstance(name, str) for name in columns):
            raise InvalidArgument(f"columns: {columns!r}: must be names")
        if not paths:
            raise InvalidArgument("path: an empty sequence")
        self._given = {"paths": paths, "columns": columns, "options": dict(options)}
        self._keep = [_c_path("path", p) for p in paths]
        c = ffi.new("cgt_trajectory_options *")
        lib.cgt_trajectory_options_init(c)
        for name, value in options.items():
            if isinstance(value, (str, bytes)):
                self._keep.append(_c_path(name, value))
                value = self._keep[-1]
            setattr(c, name, value)
        made = ffi.new("cgt_trajectory **")
        result = lib.cgt_trajectory_open_series(ffi.new("const char *[]", self._keep[:len(paths)]), len(paths), c, made)
        handle = ffi.gc(made[0], lib.cgt_trajectory_close)
        _check(handle, result)
        names = [_c_path("columns", name) for name in columns]
        _check(handle, lib.cgt_trajectory_want_columns(handle, ffi.new("const char *[]", names), len(names)))
        self._next, self._wanted = 0, set(columns)
        self._count: Optional[int] = None
        self._failed = self._has_ended = False  # C is behind an error or Ctrl-C, not before the frame _next; at the end
        self._gate, self._handle, self._made = Gate("trajectory"), handle, True

    def __repr__(self) -> str:
        return f"Trajectory({', '.join(map(str, self._given['paths']))})" if self._made else super().__repr__()

    @property
    def _open(self):
        if self._handle is None:
            raise InvalidArgument(f"trajectory: it {'is closed' if self._made else 'has not run its __init__'}")
        return self._handle

    def _move(self, call, *arguments) -> bool:
        """A call by which C moves: where it is nobody knows until `_stand` tells, since Ctrl-C may come in between."""
        handle, self._failed = self._open, True
        self._has_ended = not _check(handle, call(handle, *arguments))
        if self._has_ended:
            self._failed = False
        return not self._has_ended

    def _stand(self, number: int) -> None:
        self._next, self._failed = number, False

    def _take_warnings(self) -> list:
        texts = []
        while (text := lib.cgt_trajectory_take_warning(self._open)) != ffi.NULL:
            texts.append(ffi.string(text).decode(errors="replace"))
        return texts

    @staticmethod
    def _warn(texts) -> None:
        for text in texts:
            warnings.warn(text, stacklevel=4)

    def _go_to(self, number: int) -> bool:
        """Within the gate: makes a frame the next one; false where there are not so many.

        After an error it goes there anew: the frames before are good, and the file may be whole by now.
        """
        if number < self._next or (self._failed and lib.cgt_trajectory_can_rewind(self._open)):
            self._rewind()
        while self._next < number:
            if not self._move(lib.cgt_trajectory_skip):
                return False
            self._stand(self._next + 1)
        return True

    def _rewind(self) -> None:
        self._move(lib.cgt_trajectory_rewind)
        self._stand(0)

    def _frame(self, number: Optional[int] = None) -> Optional[TrajectoryFrame]:
        """A frame by its number, or the next one; None behind the last."""
        frame, made = ffi.new("cgt_trajectory_frame *"), None
        with self._gate.alone:
            if self._go_to(self._next if number is None else number) and self._move(lib.cgt_trajectory_read, frame):
                self._stand(frame.number + 1)
                if number not in (None, frame.number):
                    raise ReadError(f"frame {number}: a call was interrupted, and the pipe is behind it")
                made = TrajectoryFrame(frame)
                if self._count is not None and self._next > self._count:
                    self._count = None  # the file has grown
            texts = self._take_warnings()
        self._warn(texts)
        if made is not None and self._wanted:
            missing, self._wanted = self._wanted.difference(made.column_names), set()
            if missing:
                raise InvalidArgument(f"columns: {', '.join(sorted(missing))}: the file has "
                                      f"{', '.join(made.column_names) or 'none'}")
        return made

    def read(self) -> Optional[TrajectoryFrame]:
        """The next frame; None at the end."""
        return self._frame()

    def __iter__(self) -> Iterator[TrajectoryFrame]:
        number, had_ended = 0 if self.can_rewind else None, self._has_ended
        while (frame := self._frame(number)) is not None:
            yield frame
            number, had_ended = None if number is None else number + 1, False
        if number is None and had_ended:
            raise InvalidArgument("trajectory: a pipe was read to its end: keep=True lets it be read again")

    def __len__(self) -> int:
        if self._given["options"].get("follow") or not self.can_rewind:
            raise TypeError("trajectory: how many frames a pipe or a run that goes on has is not known")
        if self._count is None:
            with self._gate.alone:
                number = self._next
                self._count = self._count_all()
                self._go_to(number)
        return self._count

    def _count_all(self) -> int:
        """Within the gate: counts the frames, and goes back to the first; an error leaves the next one the next."""
        if self._failed and lib.cgt_trajectory_can_rewind(self._open):  # else C repeats what it was
            self._rewind()
        count = ffi.new("uint64_t *")
        self._move(lib.cgt_trajectory_count_frames, count)
        self._stand(0)
        return count[0]

    def __bool__(self) -> bool:
        return True

    @overload
    def __getitem__(self, number: int) -> TrajectoryFrame: ...

    @overload
    def __getitem__(self, number: slice) -> "TrajectorySlice": ...

    def __getitem__(self, number):
        if isinstance(number, slice):
            return TrajectorySlice(self, range(*number.indices(len(self))))
        index = whole("frame", number, -2**63, 2**63)
        frame = self._frame(index) if index >= 0 else self._frame(index + len(self)) if -index <= len(self) else None
        if frame is None:
            raise IndexError(f"frame {index}: there are not so many")
        return frame

    def skip(self) -> bool:
        """Skips a frame; false at the end."""
        with self._gate.alone:
            return self._go_to(self._next + 1)

    def rewind(self) -> None:
        """Makes the first frame the next one; a pipe cannot go back."""
        with self._gate.alone:
            self._rewind()

    def count_frames(self) -> int:
        """Counts the frames that there are by now, and goes back to the first; `len` counts them once."""
        with self._gate.alone:
            self._count = self._count_all()
            return self._count

    @property
    def progress(self) -> float:
        """The share of the file that has been read, 0 to 1; negative where it is unknown (a pipe)."""
        with self._gate.alone:
            return lib.cgt_trajectory_progress(self._open)

    @property
    def can_rewind(self) -> bool:
        """Whether `rewind` can go back; a pipe cannot, unless it was opened with `keep`."""
        with self._gate.alone:
            return bool(lib.cgt_trajectory_can_rewind(self._open))

    @property
    def mesh(self) -> Optional[SimpleNamespace]:
        """What a file of a mesh holds, and what of it the frames lack; None for other files."""
        with self._gate.alone:
            found = lib.cgt_trajectory_get_mesh(self._open)
            return None if found == ffi.NULL else SimpleNamespace(**struct_values(found[0], ffi))

    def _prepare(self, text: str, origin: Optional[Sequence[float]]) -> None:
        """Before a figure reads it all: columns that its options' texts name, and places less an origin."""
        if not self.can_rewind or (first := self._frame(0)) is None:
            return
        more = (name for name in first.column_names if name in text and name not in self._given["columns"])
        names = [_c_path("columns", name) for name in (*self._given["columns"], *more)]
        with self._gate.alone:
            handle, array = self._open, ffi.new("const char *[]", names)
            self._failed = True  # until it is at the first frame
            _check(handle, lib.cgt_trajectory_want_columns(handle, array, len(names)))
            if origin is not None:
                lib.cgt_trajectory_set_origin(self._open, origin)
            self._rewind()

    def close(self) -> None:
        """Closes the file; `InUse` if a call is using it."""
        with self._gate.alone:
            self._handle = None  # C's goes with its last reference

    def __enter__(self) -> "Trajectory":
        return self

    def __exit__(self, *_) -> None:
        self.close()


class TrajectorySlice(Sequence):
    """Some frames of a trajectory, read when they are used."""

    def __init__(self, run: Trajectory, numbers: range):
        self._run, self._numbers = run, numbers

    def __len__(self) -> int:
        return len(self._numbers)

    def __getitem__(self, number):
        found = self._numbers[number]
        return TrajectorySlice(self._run, found) if isinstance(found, range) else self._run[found]

    def __repr__(self) -> str:
        return f"{self._run}[{self._numbers}]"


def sort_series(paths) -> list:
    """A sequence of paths in the order that a run has them, numbers by their values: dump.9.gz before dump.10.gz."""
    texts = [_c_path("paths", p) for p in several("paths", paths, "paths")]
    array = ffi.new("const char *[]", texts)
    lib.cgt_trajectory_sort_series(array, len(texts))
    return [os.fsdecode(ffi.string(text)) for text in array]


def read(path, *, columns: Union[str, Sequence[str]] = (), format: Optional[str] = None, topology: Optional[str] = None,
         radius: float = 0.0, wrapped: bool = False, origin: Optional[Sequence[float]] = None, follow: float = 0.0,
         fps: float = 0.0, clip: Optional[str] = None, threads: int = 1, no_limit: bool = False,
         keep: bool = False, all_bonds: bool = False, leave_out_sites: bool = False) -> Trajectory:
    """Opens a file, or several that follow each other in a run.

    Parameters
    ----------
    path : path or sequence of paths
        A series is read in the order given; `sort_series` sorts one.
    columns : str or sequence of str, optional
        Columns that frames have beside those with attributes of their own; `TrajectoryFrame.column_names` tells all. A
        name that the first frame lacks is an error.
    format : str, optional
        Whatever the file's name; None: by its ending, else by its first bytes.
    topology : path, optional
        A file whose first frame tells what the spheres are: elements, types, radii, ids, bonds, columns that
        hold at all times.
    radius : float, optional
        In the file's unit, for frames without radii; 0: by element, else 1 Angstrom or 0.5.
    wrapped : bool, optional
        Prefer x y z to xu yu zu.
    origin : three floats, optional
        Subtracted from all places, in double.
    follow : float, optional
        Seconds to wait at the end for more, of a run that is being written.
    fps, clip : optional
        Of animated meshes: frames per second, and the clip's name or number.
    threads : int, optional
        That read large frames of text.
    keep : bool, optional
        Keeps what a pipe delivers in a temporary file, so that `Trajectory.rewind` works.
    all_bonds : bool, optional
        Bonds that the file does not list are guessed by covalent radii, through periodic boundaries, too.
    leave_out_sites : bool, optional
        Frames have atoms alone, without virtual sites, lone pairs, dummies and ghosts; else these are small spheres, and
        have 1 in the column `site`.
    no_limit : bool, optional
        Reads files that unpack to more than 1 GiB and 500 times their size.

    Returns
    -------
    Trajectory

    Raises
    ------
    ReadError
        The file is not there, or no format of libcgt's; the message names path and line.

    Examples
    --------
    >>> import cgt, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), 'two.xyz')
    >>> with open(path, 'w') as file:
    ...     _ = file.write('2\\nwater\\nO 0 0 0\\nH 0 0 1\\n')
    >>> for frame in cgt.read(path):
    ...     print(frame, frame.positions.tolist(), frame.elements.tolist())
    TrajectoryFrame(0, step 0: 2 spheres) [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]] [8, 1]
    """
    single = isinstance(path, (str, bytes, os.PathLike))
    if not single and not isinstance(path, Iterable):
        raise InvalidArgument(f"path: {path!r}: must be a path, or a sequence of them")
    paths = (path,) if single else several("path", path, "paths")
    if not paths:
        raise InvalidArgument("path: an empty sequence")
    options = {"radius": real("radius", radius), "follow": real("follow", follow), "fps": real("fps", fps),
               "threads": whole("threads", threads, 0, 1024)}
    for name, flag in (("wrapped", wrapped), ("no_limit", no_limit), ("keep", keep), ("all_bonds", all_bonds),
                       ("leave_out_sites", leave_out_sites)):
        options[name] = int(switch(name, flag))
    for name, value in (("format", format), ("topology", topology), ("clip", clip)):
        if value is not None:
            if not isinstance(value, (str, bytes, os.PathLike)):
                raise InvalidArgument(f"{name}: {value!r}: must be text")
            options[name] = os.fspath(value) if isinstance(value, os.PathLike) else value
    if origin is not None:
        options.update(has_origin=1, origin=tuple(three("origin", origin)))
    return Trajectory(paths, columns, options)

# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Pictures in a line: arrays, frames of files, atoms of ASE and MDAnalysis, in a notebook or a window."""
from __future__ import annotations

import atexit
import os
import shutil
import subprocess
import sys
import tempfile
from typing import Any, List, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike

from . import colors as _colors
from ._arrays import F4, F8, array_of, check_shape, numbers
from ._bonds import half_bonds
from ._native import InvalidArgument, load_part, real
from .geometry import Camera, Capsules, Spheres, _Geometry
from .picture import Look, Picture
from .scene import Scene

ffi, lib = load_part("picture")


def fit_camera(geometries: Union[_Geometry, Sequence[_Geometry]], width: int, height: int) -> Camera:
    """A camera that sees all of some geometries, from a corner, with a margin of 4 percent.

    Parameters
    ----------
    geometries : Spheres, Triangles, Capsules or a sequence of them
    width, height : int
        Pixels of the picture.
    """
    camera = Camera((0.62, -0.70, 0.36), (0, 0, 0), (0, 0, 1), 30.0)
    camera.fit(geometries, width, height)
    return camera


def show(positions,
    radii: Union[float,
    ArrayLike,
    None] = None,
    colors: Any = None,
    *,
    map: Optional[str] = None,
    low: Optional[float] = None,
    high: Optional[float] = None,
    bonds: Union[bool,
    ArrayLike] = False,
    bond_radius: float = 0.0,
    camera: Optional[Camera] = None,
    ambient: int = 32,
    antialias: int = 2,
    width: int = 960,
    height: int = 540,
    window: Optional[bool] = None,
     **options) -> Picture:
    """A picture of spheres or of a frame, which a notebook shows where this is the last line of a cell.

    At a prompt, where there is a display, it also opens the window of cgt-view, which goes with Python.

    Parameters
    ----------
    positions : (n, 3) float, cgt.TrajectoryFrame, ase.Atoms, MDAnalysis.Universe or MDAnalysis.AtomGroup
    radii : float or (n,) float, optional
        None: those that it has, else 0.5.
    colors : colour, (n, 3) numbers, (n, 3) uint8 or n names, optional
        Names, "#rrggbb", bytes or numbers from 0 to 1, all sRGB. With `map`: n values. None: by element or type, where
        it has some; `cgt.colors` has more.
    map, low, high : optional
        Name of a colour map, and its ends, as of `cgt.colors.by_value`.
    bonds : bool or (m, 2) int, optional
        True: those that it has. Halves have the colours of their atoms, and go through the periodic boundaries that it
        has.
    bond_radius : float, optional
        0: half of the smallest of `radii`, which had better be small, too.
    camera : Camera, optional
        None: from a corner, so that all is seen.
    ambient, antialias, width, height, **options
        As of `Picture`.
    window : bool, optional
        True: an error where no window can be opened; False: none. It has spheres alone, and at most 256 colours.

    Returns
    -------
    Picture
    """
    what, bond_radius = _Particles(positions), real("bond_radius", bond_radius)
    radii = what.radii if radii is None else radii
    colors = what.colors if colors is None else colors
    if map is not None:
        colors = _colors.by_value(colors, map, low, high)
    if colors is not None:
        one = isinstance(colors, str) or array_of("colors", colors).dtype.kind != "U" and np.ndim(colors) == 1
        colors = _colors.light_of("colors", colors, (3,) if one else (len(what.positions), 3))
    if array_of("radii", radii).ndim:
        radii = numbers("radii", radii, F4, (len(what.positions),))
    shapes = [what.geometry or Spheres(what.positions, radii)]
    looks = [Look() if colors is None else Look(*((colors,) if colors.ndim == 1 else (None, colors)), linear=True)]
    if bonds is not False and len(shapes[0]):
        ends, atoms = half_bonds(what.positions, what.find_bonds() if bonds is True else bonds, *what.box)
        shapes.append(Capsules(ends, bond_radius or float(np.nanmin(radii)) / 2))
        looks.append(looks[0] if colors is None or colors.ndim == 1 else Look(colors=colors[atoms], linear=True))
    camera = camera or fit_camera(shapes, width, height)
    with Scene() as scene:
        ids = [scene.add(shape) for shape in shapes]
        scene.commit()
        picture = Picture(width, height, antialias=antialias, ambient=ambient, **options)
        picture.draw(scene, camera, dict(zip(ids, looks)))
    if window or (window is None and what.geometry is None and _can_open()):
        if what.geometry is not None:
            raise InvalidArgument("window: a mesh: cgt-view shows its file")
        _Window(np.asarray(what.positions), radii, colors, camera, (width, height))
    return picture


class _Particles:
    """What `show` takes, as arrays."""

    def __init__(self, given):
        self.radii, self.colors, self.geometry = 0.5, None, None
        self.given, self.box = given, ()
        elements = None
        if hasattr(given, "get_atomic_numbers"):  # ASE
            from ase.data import covalent_radii

            self.positions, elements = given.get_positions(), given.get_atomic_numbers()
            self.radii = covalent_radii[elements]
            if getattr(given, "cell", None) is not None:  # sheets and chains have edges of no length
                self.box = given.cell.array, given.pbc & given.cell.array.any(axis=1)
        elif hasattr(given, "atoms") and hasattr(given.atoms, "positions"):  # MDAnalysis: all atoms, or some
            self.positions = given.atoms.positions
            sides = getattr(getattr(given.atoms, "universe", None), "dimensions", None)
            if sides is not None and np.all(sides[:3] > 0):
                from MDAnalysis.lib.mdamath import triclinic_vectors

                self.box = (triclinic_vectors(sides),)
            elements, self.radii = _elements_of(given.atoms)
        elif hasattr(given, "column_names"):  # a frame of cgt.read
            self.positions, elements = given.positions, given.elements
            self.radii = given.radii
            if given.box_edges is not None:
                self.box = given.box_edges, (given.periodic != 0) & (given.unwrapped == 0)
            if given.triangles is not None:
                self.geometry = given.geometry()
            elif elements is None and given.types is not None:
                self.colors = _colors.by_type(given.types)
        else:
            given = array_of("positions", given)
            self.positions = given if given.dtype == F4 else numbers("positions", given, F8)
            check_shape("positions", self.positions, ("n", 3))
        self.positions = np.ascontiguousarray(self.positions)
        if elements is not None and self.geometry is None:
            self.colors = _colors.by_element(elements)

    def find_bonds(self) -> np.ndarray:
        """The bonds that it has, (m, 2); an error where it does not say."""
        if hasattr(self.given, "column_names"):
            found = self.given.bonds
        else:
            found = _bonds_among(self.given.atoms) if hasattr(self.given, "atoms") else None
        if found is None:
            raise InvalidArgument("bonds: it has none: give pairs, (m, 2)")
        return found


def _elements_of(atoms):
    """Elements' numbers and van der Waals radii of MDAnalysis' atoms, by element, else type; None, 0.5: unknown."""
    try:
        from MDAnalysis.guesser import tables  # from 2.8 on
    except ImportError:
        from MDAnalysis.topology import tables
    for name in ("elements", "types"):
        given = getattr(atoms, name, None)
        symbols = [] if given is None else [str(s).capitalize() for s in given]
        numbers = np.array([tables.SYMB2Z.get(s, 0) for s in symbols])
        if numbers.any():
            return numbers, np.array([tables.vdwradii.get(s.upper(), 2.0) for s in symbols])
    return None, 0.5


def _bonds_among(atoms) -> Optional[np.ndarray]:
    """The bonds of MDAnalysis' atoms, by their places among these; None: it has none."""
    pairs = getattr(atoms, "bonds", None)
    if pairs is None:
        return None
    pairs = np.asarray(pairs.indices).reshape(-1, 2)
    order = np.argsort(atoms.indices)
    place = np.minimum(np.searchsorted(atoms.indices, pairs, sorter=order), len(order) - 1)
    return order[place][(atoms.indices[order[place]] == pairs).all(axis=1)]


# ---- the window ----


def _can_open() -> bool:
    """Whether somebody sits at a prompt, before a display, and not in a notebook."""
    return (hasattr(sys, "ps1") and "ipykernel" not in sys.modules and shutil.which("cgt-view") is not None
            and bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")))


def _few_colors(colors: np.ndarray, most: int = 256):
    """sRGB codes of at most so many colours, and which of them each row has: bits are cleared until they are few."""
    encode = np.vectorize(lib.cgt_srgb_from_linear, otypes=[float])
    codes = np.rint(255 * encode(np.clip(colors, 0, 1))).astype(int)
    for bits in range(8):
        table, kinds = np.unique(codes >> bits << bits, axis=0, return_inverse=True)
        if len(table) <= most:
            break
    return table, kinds.reshape(-1)


class _Window:
    """A cgt-view on a file of its own; both go with Python."""

    _open: List["_Window"] = []

    def __init__(self, positions, radii, colors, camera: Camera, size):
        program = shutil.which("cgt-view")
        if program is None:
            raise InvalidArgument("window: no cgt-view: install libcgt's programs where PATH finds them")
        count = len(positions)
        table, kinds = _few_colors(np.broadcast_to(np.atleast_2d((0.7,) * 3 if colors is None else colors), (count, 3)))
        self.folder = tempfile.mkdtemp(prefix="cgt_show_")
        path = os.path.join(self.folder, "show.xyz")
        rows = np.column_stack([kinds + 1, positions, np.broadcast_to(radii, count)])
        np.savetxt(path, rows, ["%d"] + ["%.9g"] * 4, comments="",
                   header=f"{count}\nProperties=species:S:1:pos:R:3:radius:R:1")
        c = camera._struct
        place = ",".join(f"{x:.9g}" for x in [*c.eye, *c.target, *c.up, c.fov])
        args = [program, "-s", "%dx%d" % size, "-k", "type", "-c", place]
        for k, rgb in enumerate(table):
            args += ["--type-color", "%d=%02x%02x%02x" % (k + 1, *rgb)]
        self.process = subprocess.Popen(args + [path], stdin=subprocess.DEVNULL)
        if not _Window._open:
            atexit.register(_Window._close_all)
        _Window._open.append(self)

    @staticmethod
    def _close_all() -> None:
        for window in _Window._open:
            window.process.terminate()
            window.process.wait()
            shutil.rmtree(window.folder, ignore_errors=True)
        _Window._open.clear()

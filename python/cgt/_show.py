# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Figures in a line, in a notebook or a window."""
from __future__ import annotations

import atexit
import os
import re
import shutil
import subprocess
import sys
import tempfile
from typing import Any, List, Optional, Sequence, Union

import numpy as np

from ._arrays import array_of
from ._figure_data import FigureData, columns_of, of_objects
from ._native import InvalidArgument
from .colors import code_of, code_of_light, light_of
from .figure import Figure
from .geometry import Camera, _Geometry

_DATA = ("columns", "cell", "pbc", "corner", "unwrapped", "angstrom", "number", "step", "time")


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


def show(data, radii=None, colors: Any = None, *, bonds: Any = False, window: Optional[bool] = None,
         width: Optional[int] = None, height: Optional[int] = None, map: Optional[str] = None,
         low: Optional[float] = None, high: Optional[float] = None, **options: Any) -> Figure:
    """A figure of one frame, which a notebook shows where this is the last line of a cell.

    At a prompt, where there is a display, it also opens the window of cgt-view, which goes with Python.

    Parameters
    ----------
    data
        Places (n, 3), or what else `cgt.Figure` takes.
    radii : float or (n,) float, optional
        None: those that it has, else by element, else 0.5.
    colors : colour, (n, 3) numbers, n names or (n,) numbers, optional
        One for all, a name or three numbers, as a tuple of three always is; one each; or values, one each, for the map
        of the option `colormap`. None: what the option `color` says, by itself element or type, where it has some.
    bonds : bool, number or (m, 2) int, optional
        None, False: none; True: those that it has; a number: all pairs so near; pairs.
    window : bool, optional
        True: an error where no window can be opened; False: none. It has particles, their columns of numbers, and the
        options, but neither bonds that are pairs, nor a box, nor colours of each.
    width, height : int, optional
        In place of the option `size`.
    map, low, high : optional
        Name of a map and the values at its ends, in place of the options `colormap` and `range`.
    **options
        Those of `cgt.Figure`, and what its `show` takes.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import cgt
    >>> cgt.show([[0, 0, 0], [1, 0, 0]], 0.5, "steelblue", size=(64, 48)).pixels.shape
    (48, 64, 3)
    """
    more = {name: options.pop(name) for name in _DATA if name in options}
    if width is not None or height is not None:
        options["size"] = (1280 if width is None else width, 720 if height is None else height)
    if map is not None:
        options["colormap"] = map
    if (low is None) != (high is None):
        raise InvalidArgument("low, high: both or neither")
    if low is not None:
        options["range"] = (low, high)
    if colors is not None and "color" in options:
        raise InvalidArgument("colors: color says another thing")
    if bonds is not None and not isinstance(bonds, (bool, np.bool_, int, float, np.number)):
        bonds, more["bonds"] = True, bonds
    if isinstance(colors, str):
        code = code_of(colors)
        options["color"] = f"#{code}" if code else colors
    elif isinstance(colors, tuple) and len(colors) == 3 and not any(
            isinstance(x, str) or not np.isscalar(x) for x in colors):
        options["color"] = colors
    elif colors is not None:
        a = array_of("colors", colors, np.nan)
        if a.dtype == object:
            a = of_objects("colors", a)
        if not a.ndim:
            raise InvalidArgument(f"colors: {colors!r}: must be a colour, or one each")
        is_one = a.shape == (3,) and map is None and not (hasattr(data, "__len__") and len(data) == 3)
        if is_one and a.dtype.kind in "fiu":
            options["color"], own = f"#{code_of_light(light_of('colors', colors, (3,)))}", {}
        elif a.ndim == 1 and a.dtype.kind in "fiub":
            options["color"], own = "colors", {"colors": a}
        else:
            own = {"rgb": light_of("colors", colors, (len(a), 3))}
        columns = more.get("columns")
        more["columns"] = {**({} if columns is None else columns_of(columns)), **own}
    figure = Figure(**options, bonds=bonds).show(data, radius=radii, **more)
    shown = figure._shown
    if shown is not None and (window or (window is None and shown.triangles is None and _can_open())):
        _Window(figure, shown)
    return figure


# ---- the window ----


def _can_open() -> bool:
    """Whether somebody sits at a prompt, before a display, and not in a notebook."""
    return (hasattr(sys, "ps1") and "ipykernel" not in sys.modules and shutil.which("cgt-view") is not None
            and bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")))


class _Window:
    """A cgt-view on a file of its own, with the figure's options; both go with Python."""

    _open: List["_Window"] = []

    def __init__(self, figure: Figure, shown: FigureData):
        program = shutil.which("cgt-view")
        if program is None:
            raise InvalidArgument("window: no cgt-view: install libcgt's programs where PATH finds them")
        if shown.triangles is not None:
            raise InvalidArgument("window: a mesh: cgt-view shows its file")
        self.folder = tempfile.mkdtemp(prefix="cgt_show_")
        path, settings = (os.path.join(self.folder, name) for name in ("show.xyz", "settings"))
        with open(path, "w", encoding="utf-8") as file:
            _write_xyz(file, shown)
        with open(settings, "w", encoding="utf-8") as file:
            file.write(figure.settings)
        self.process = subprocess.Popen([program, "--settings", settings, path], stdin=subprocess.DEVNULL)
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


def _write_xyz(file, data: FigureData) -> None:
    """A frame as extended XYZ, with its columns of plain numbers."""
    count = len(data.positions)
    columns = {"pos:R:3": data.positions}
    if data.radius and "radius" not in data.columns:
        columns["radius:R:1"] = np.full(count, data.radius)
    for name, values in data.columns.items():
        if not isinstance(values, tuple) and values.ndim == 1 and re.fullmatch(r"\w+", name):
            kind = "I" if values.dtype.kind in "iu" else "R"
            columns[f"{'Z' if name == 'element' else name}:{kind}:1"] = values
    rows = np.column_stack([np.asarray(values, float) for values in columns.values()])
    np.savetxt(file, rows, "%.9g", header=f"{count}\nProperties={':'.join(columns)}", comments="")

# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Labelled pictures and movies of simulations: those of cgt-render, byte for byte, of what Python has."""
from __future__ import annotations

import copy
import difflib
import importlib.util
import math
import os
import re
import shutil
import subprocess
from collections.abc import Mapping
from contextlib import contextmanager, nullcontext
from types import SimpleNamespace
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from . import _arrays
from ._arrays import U1, Hold
from ._figure_data import FigureData, frames_of, is_read_once, is_run, take
from ._gate import Gate
from ._native import (Error, InvalidArgument, Plain, exception_of, instance, load_part, real, struct_values, switch,
                      text_of_path, whole)
from .colors import code_of, code_of_light, light_of
from .context import Context
from .geometry import Camera
from .picture import check_png, encode_png
from .trajectory import Trajectory, TrajectorySlice

ffi, lib = load_part("figure")
_SHOW = lib.cgt_figure_show
_FOUND = ("_handle", "_mesh_origin", "_origin", "_words", "_looked", "_shown", "_again", "_pixels", "_counts",
          "_has_ended")  # of frames, by C and here


def _list_options() -> Dict[str, SimpleNamespace]:
    found: Dict[str, SimpleNamespace] = {}
    option = ffi.new("cgt_figure_option *")
    kinds = {value: name[11:].lower() for value, name in ffi.typeof("cgt_figure_kind").elements.items()}
    while lib.cgt_figure_get_option(len(found), option):
        row = SimpleNamespace(**struct_values(option[0], ffi))
        row.kind, row.words = kinds[row.kind], tuple((row.words or "").split())
        found[row.name] = row
    return found


_OPTIONS = _list_options()


def options() -> Dict[str, SimpleNamespace]:
    """All that may be said of a figure: by keyword the name, group, kind, help, limits and words of an option.

    >>> import cgt.figure
    >>> cgt.figure.options()["style"].words
    ('soft', 'paper', 'plain')
    """
    return {name.replace("-", "_"): SimpleNamespace(**{**vars(row), "help": _in_python(row.help)})
            for name, row in _OPTIONS.items()}


def _in_python(text: str) -> str:
    """A sentence of C's, with options called as they are here."""
    text = re.sub(r"(?<![\w-])-c\b", "camera", text)
    return re.sub(r"--([a-z][a-z-]*)", lambda m: m[1].replace("-", "_") if m[1] in _OPTIONS else m[0], text)


# ---- values ----


def _number_text(keyword: str, value) -> str:
    one = value[()] if isinstance(value, np.ndarray) and not value.ndim else value
    try:
        if isinstance(one, (bool, np.bool_, str, bytes, bytearray, np.ndarray, np.complexfloating)):
            raise TypeError
        return str(int(one)) if isinstance(one, (int, np.integer)) else repr(float(one))
    except (TypeError, ValueError, OverflowError):
        raise InvalidArgument(f"{keyword}: {value!r}: must be a number") from None


def _fov_of(c) -> float:
    """The angle of the perspective camera that shows at its target what a camera of C's shows."""
    if c.projection == lib.CGT_PROJECTION_ORTHOGRAPHIC:
        return math.degrees(2 * math.atan2(c.height, 2 * math.dist(c.eye, c.target)))
    return c.fov


def _text_of(keyword: str, row, value) -> str:
    """One value as C reads it."""
    is_color = row.kind == "color" or row.name == "color"
    if isinstance(value, np.ndarray) and not value.ndim:
        value = value[()]
    if isinstance(value, Camera):
        c = instance(keyword, value, Camera)._struct
        if c.t_min or 0 < c.t_max < math.inf or c.mask:
            raise InvalidArgument(f"{keyword}: t_min, t_max and mask: an option has none of them")
        return ",".join(f"{x:.9g}" for x in [*c.eye, *c.target, *c.up, _fov_of(c)])
    if isinstance(value, (str, os.PathLike)):
        text = os.fsdecode(value)
        try:
            is_text = not {0, 10} & set(os.fsencode(text))  # C's end, and that of a setting
        except UnicodeEncodeError:
            is_text = False
        if not is_text:
            raise InvalidArgument(f"{keyword}: {value!r}: C cannot read this text")
        may_be = is_color and (row.name != "color" or len(text) > 1)  # x and y are columns, too
        return code_of(text) or text if may_be else text
    if isinstance(value, (int, float, np.integer, np.floating)) and not isinstance(value, bool):
        return _number_text(keyword, value)
    if isinstance(value, (list, tuple, np.ndarray)):
        parts = list(value)
        if is_color and len(parts) == 3:
            return code_of_light(light_of(keyword, value))
        between = "x" if re.fullmatch(r"[A-Za-z]+x[A-Za-z]+", row.value or "") else ","
        has_color = "RRGGBB" in (row.value or "")
        return between.join((has_color and code_of(p) or p) if isinstance(p, str) else _number_text(keyword, p)
                            for p in parts)
    raise InvalidArgument(f"{keyword}: {value!r}: must be text, a number, or several")


_Texts = Optional[List[Optional[str]]]


def _settings_of(keyword: str, value) -> List[Tuple[str, _Texts]]:
    """Names of options and the texts of their values; None for no value, and in place of the list: unset."""
    name = keyword.replace("_", "-")
    row = _OPTIONS.get(name)
    if row is None:
        near = difflib.get_close_matches(name, _OPTIONS, 1)
        hint = f": did you mean {near[0].replace('-', '_')}?" if near else ": cgt.figure.options() has all"
        raise InvalidArgument(f"there is no option {keyword!r}{hint}")
    if value is None:
        return [(name, None)]
    if isinstance(value, (bool, np.bool_)):
        if value and row.value and not row.is_optional:
            raise InvalidArgument(f"{keyword}: True: must have a value, {row.value}")
        if not value and "no-" + name in _OPTIONS:
            return [(name, None), ("no-" + name, [None])]
        return [(name, [None] if value else None)]
    if isinstance(value, Mapping):
        if "=" not in (row.value or ""):
            raise InvalidArgument(f"{keyword}: it takes no dictionary")
        colored = SimpleNamespace(**{**vars(row), "kind": "color" if "color" in name else row.kind})
        return [(name, [f"{key}={_text_of(keyword, colored, v)}" for key, v in value.items()])]
    many = row.repeats and isinstance(value, (list, tuple)) and not (
        value and isinstance(value[0], (int, float, np.integer, np.floating)))
    return [(name, [_text_of(keyword, row, v) for v in (value if many else [value])])]


class Figure(Plain):
    """Pictures of particles or meshes, with the options of cgt-render as keywords; a notebook shows it.

    Parameters
    ----------
    context : Context, optional
        None: one of its own, with the default threads.
    **options
        By their names, with _ for -: ``color="speed", bonds=True, title="A run"``. `cgt.figure.options` tells all.
        Switches are True or False, numbers and texts plain, several numbers a tuple (``size=(1280, 720)``), options
        that may be given several times a list (``show=["x > 0", "type == 1"]``), those of types and elements a
        dictionary (``type_color={"O": "tomato", 2: "#4060ff"}``). Colours are names of CSS, "#rrggbb" or three
        numbers as of `cgt.colors`; a camera may be a `cgt.Camera`, which says ortho, too, unless the same call does.
        None is what the option is by itself.

    Notes
    -----
    What is drawn may be a frame of `cgt.read`, places (n, 3), (vertices, triangles), a mesh of trimesh, atoms of ASE or
    MDAnalysis, one frame of mdtraj, or a table with columns x, y and z. Other arguments of `show` and `survey` tell
    more:

    radius : float or (n,) float
        0: as without it, by element, else 0.5.
    columns : dict or table of (n,)
        Numbers or words for colours and formulas; what is masked or None is NaN, or no word. Some mean something: id,
        type, element (atomic numbers), velocity (n, 3), normal (of vertices, (n, 3)).
    bonds : (m, 2) int
        Pairs, for ``bonds=True``.
    cell, pbc, corner, unwrapped
        Edges of the box as rows, or three lengths; along which it is periodic, True, False, or three of them; its
        corner; along which places go on beyond it, in the same way.
    number, step, time : number
        Of the frame in its run; by default frames are counted.
    angstrom : float
        In the unit of lengths, for radii by element.

    Copies and pickles have the options, the mesh that stands, an assigned camera, and the shown frame, of its arrays as
    they are then, which is the first that they look at: what follows the first of several is that one's. After a survey
    they have only the first three: the copy has to make it anew.

    What is refused changes nothing: the survey stays, and the frame before is shown again, of its arrays as they are
    then.

    One thread at a time uses a figure: others get `InUse`. All that takes time releases Python's lock.

    Examples
    --------
    >>> import cgt
    >>> figure = cgt.Figure(size=(64, 48), style="plain", color="tomato")
    >>> figure.show([[0, 0, 0], [1, 0, 0]], radius=0.5).pixels.shape
    (48, 64, 3)
    """

    __slots__ = ("_handle", "_context", "_context_handle", "_gate", "_texts", "_notices", "_origin", "_words",
                 "_looked", "_shown", "_again", "_pixels", "_counts", "_has_ended", "_mesh", "_mesh_origin", "_view",
                 "_has_lens")
    _unmade = {"_made": False, "_handle": None, "_gate": Gate("figure")}
    _handle: Any

    def __init__(self, context: Optional[Context] = None, **options: Any):
        if self._handle is not None:
            raise InvalidArgument("figure: its __init__ has run")
        self._context = Context() if context is None else instance("context", context, Context)
        self._context_handle = self._context.handle
        self._handle = self._create()
        self._gate = Gate("figure", self._context_handle)
        self._texts: Dict[str, List[Optional[str]]] = {}
        self._notices: List[str] = []
        self._mesh: Optional[FigureData] = None
        self._mesh_origin: Optional[list] = None  # less which C has it
        self._view: Optional[Camera] = None  # what was assigned or fitted
        self._has_lens = False  # whether ortho is of the option camera, and goes with it
        self._forget()
        self._given = {"context": context}
        self._made = True
        try:
            self.set(**options)
        except BaseException:
            self._made = False
            raise

    def _create(self):
        made = ffi.new("cgt_figure **")
        result = lib.cgt_figure_create(self._context_handle, made)
        if result:
            raise exception_of(result)
        handle = self._context_handle

        def release(figure, _context=handle):
            lib.cgt_figure_release(figure)

        return ffi.gc(made[0], release)

    def _arguments(self) -> dict:
        return {**self._given, **self.options}

    def _rest(self) -> dict:
        with self._gate.alone:
            frame, is_shown = self._last, self._again is None
            if frame is not None and frame.number is None and is_shown:
                frame = copy.copy(frame)
                frame.number = self._counts[1] - 1
            return {**super()._rest(), "_state": (frame, is_shown, self._mesh, self._view, self._has_lens)}

    def _set_state(self, state) -> None:
        frame, is_shown, mesh, view, self._has_lens = state
        if mesh is not None:
            self._stand(mesh)
        if view is not None:
            self.camera = view
        if frame is not None and is_shown:
            self._show(frame)
        else:
            self._again = frame

    _state = property(None, _set_state, doc="What a copy has besides its options.")

    def _told(self) -> dict:
        return self.options if self._made else {}

    def _check(self, result: int, handle=None) -> None:
        handle = handle or self._handle
        while handle is self._handle and (text := lib.cgt_figure_take_notice(handle)) != ffi.NULL:
            self._notices.append(_in_python(ffi.string(text).decode(errors="replace")))
        if result:
            text = ffi.new("char[1024]")
            lib.cgt_figure_get_error_message(handle, text, 1024)
            raise exception_of(result, _in_python(ffi.string(text).decode(errors="replace")))

    def _forget(self, again: Optional[FigureData] = None) -> None:
        """What C forgets as its options change, but for a frame that is to be shown again."""
        self._origin: Optional[list] = None
        self._words: Dict[str, List[str]] = {}  # of columns, in the order in which they came
        self._looked = ""  # by whom frames were looked at: "survey", "show"
        self._shown: Optional[FigureData] = None
        self._again = again
        self._pixels: Optional[np.ndarray] = None
        self._counts = [0, 0]  # of frames that were looked at, shown
        self._has_ended = False  # the survey: another frame begins the next one

    @property
    def _last(self) -> Optional[FigureData]:
        """The frame that is to be shown again where all is forgotten; none after a survey, which is to be made anew."""
        return None if self._looked == "survey" else self._again or self._shown

    def _begin(self, again: Optional[FigureData]) -> None:
        """Within the gate: forgets all frames, and so does C, whose survey may be open."""
        self._forget(again)
        self._check(lib.cgt_figure_set_lines(self._open, b""))

    def _bring_back(self) -> None:
        """Shows the frame again that is to be."""
        if self._again is not None:
            self._show(self._again)

    @property
    def _open(self):
        if self._handle is None or not self._made:
            raise InvalidArgument(f"figure: it {'is closed' if self._made else 'has not run its __init__'}")
        return self._handle

    # ---- options ----

    def set(self, **options: Any) -> "Figure":
        """Sets options, each in place of what was set of it, and returns the figure. An error changes nothing.

        After that a survey has to be made again; without one, what is shown is drawn by the new options, of its arrays
        as they are then.
        """
        texts, has_lens = dict(self._texts), self._has_lens and "ortho" not in options
        if "camera" in options and "ortho" not in options:
            camera = options["camera"]
            is_ortho = isinstance(camera, Camera) and instance("camera", camera, Camera).projection == "orthographic"
            if is_ortho or has_lens or isinstance(camera, Camera):
                options["ortho"] = is_ortho
            has_lens = is_ortho
        for keyword, value in options.items():
            for name, values in _settings_of(keyword, value):
                texts.pop(name, None)
                if name in ("shadows", "no-shadows"):  # the last one counts
                    texts.pop({"shadows": "no-shadows"}.get(name, "shadows"), None)
                if values:
                    texts[name] = values
        self._take(texts)
        self._has_lens = has_lens
        return self

    def unset(self, *names: str) -> "Figure":
        """Takes back what was set of some options, of all without names, and returns the figure."""
        return self.set(**dict.fromkeys(names or self.options))

    def _take(self, texts) -> None:
        with self._gate.alone:
            if self._open and texts != self._texts:
                self._renew(texts, self._last)

    def _renew(self, texts, again: Optional[FigureData] = None) -> None:
        """Within the gate: another figure of C's, with these options; what they refuse leaves the one that there is."""
        lines = [f"{name} = {value}" if value is not None else name for name in texts for value in texts[name]]
        handle = self._create()
        self._check(lib.cgt_figure_set_lines(handle, os.fsencode("\n".join(lines))), handle)
        if self._view is not None:
            lib.cgt_figure_set_camera(handle, self._view._struct)
        self._handle, self._texts, self._mesh_origin = handle, texts, None  # it has no mesh yet
        self._forget(again)

    @property
    def options(self) -> Dict[str, Any]:
        """What was set, by keyword: True, a text, or a list of texts; another figure takes it."""
        return {name.replace("-", "_"): [True if v is None else v for v in values] if _OPTIONS[name].repeats else
                True if values[0] is None else values[0] for name, values in self._texts.items()}

    @property
    def settings(self) -> str:
        """The same as the lines of a settings file, for cgt-render --settings."""
        with self._gate.alone:
            size = lib.cgt_figure_get(self._open, ffi.NULL, ffi.NULL, 0)
            text = ffi.new("char[]", size + 1)
            lib.cgt_figure_get(self._open, ffi.NULL, text, size + 1)
            return ffi.string(text).decode(errors="replace")

    @property
    def size(self) -> Tuple[int, int]:
        """Width and height in pixels."""
        width, height = str(self._texts.get("size", ["1280x720"])[0]).split("x")
        return int(width), int(height)

    @property
    def notices(self) -> List[str]:
        """What was chosen, or is doubtful, and a user should read, such as what a camera leaves out: all so far."""
        return list(self._notices)

    # ---- frames ----

    def _give(self, call, data: FigureData, number: int) -> None:
        """Within the gate: a frame for C, which takes nothing from one that it refuses."""
        keep: list = []
        origin = self._origin or list(data.origin or (0.0, 0.0, 0.0))
        words = {name: list(known) for name, known in self._words.items()}
        c = data.fill(ffi, number, origin, keep, words)
        if self._mesh is not None and self._mesh_origin != origin:
            self._give_mesh(self._mesh, origin)
        if call is _SHOW:  # until C has it, however this ends
            self._counts[1] -= self._shown is not None
            self._again, self._shown, self._pixels = self._shown or self._again, None, None
            self._has_ended = True
        try:
            self._check(call(self._open, c))
            self._origin, self._words = origin, words
        except Error as error:
            for name, sentence in data.odd.items():
                if f'column "{name}"' in str(error):
                    raise InvalidArgument(sentence) from None
            unread = [name for name in data.unread if f'column "{name}"' in str(error)]
            if unread:
                raise InvalidArgument(f"{error}; the file has it: cgt.read(..., columns={unread})") from None
            raise
        except BaseException:  # Ctrl-C: C may have it
            if call is not _SHOW:
                self._begin(self._last)
            raise
        del keep

    def _look(self, data: FigureData, who: str = "survey") -> None:
        """Within the gate."""
        self._give(lib.cgt_figure_survey, data, self._counts[0])
        self._counts[0] += 1
        self._looked = who

    def _move_origin(self) -> bool:
        """Within the gate: whether all that was looked at is so far from 0 that it has to be given less an origin."""
        origin = ffi.new("double[3]")
        is_far = lib.cgt_figure_get_origin(self._open, origin)
        self._has_ended = True
        if is_far:
            self._begin(self._again)
            self._origin = list(origin)
        return is_far

    def survey(self, data, **more) -> "Figure":
        """Looks at a frame, or at all frames of a run, and returns the figure: camera, ranges and legend fit them all.

        Parameters
        ----------
        data
            As of `show`; or a run: of `cgt.read`, a universe of MDAnalysis, frames of mdtraj, a list or anything that
            can be looped over. One of `cgt.read` that lies far from 0 is read less an origin from then on.
        **more
            As of `show`.
        """
        if is_run(data):
            self._survey_run(data, more)
        else:
            frame = take(data, **more)
            with self._anew() if self._has_ended else nullcontext(), self._gate.alone:
                self._look(frame)
                self._again = None
        return self

    @contextmanager
    def _anew(self):
        """A survey from its beginning, by another figure of C's; where it fails, all is what it was before."""
        with self._gate.alone:
            before = {name: getattr(self, name) for name in _FOUND}
        try:
            with self._gate.alone:
                if self._open:
                    self._renew(self._texts)
            yield
        except BaseException:
            with self._gate.alone:
                for name, value in before.items() if self._handle is not None else ():
                    setattr(self, name, value)
            raise

    def _survey_run(self, run, more) -> None:
        with self._anew():
            for _ in range(2):
                for frame in self._frames(run):
                    data = take(frame, **more)
                    with self._gate.alone:
                        self._look(data)
                if not self._counts[0]:
                    raise InvalidArgument("data: a run without frames")
                with self._gate.alone:
                    if is_read_once(run) or not self._move_origin():
                        break

    def _frames(self, run):
        """Frames of a run; of one of cgt.read with the columns that options name, less the origin."""
        reader = run._run if isinstance(run, TrajectorySlice) else run
        if isinstance(reader, Trajectory):
            reader._prepare(" ".join(v for values in self._texts.values() for v in values if v), self._origin)
        return frames_of(run)

    def show(self, data, **more) -> "Figure":
        """Makes a frame the one that is drawn, and returns the figure. Without a survey the first one is looked at.

        Parameters
        ----------
        data
            What is drawn; see `Figure`, as for the rest. Arrays are copied.
        """
        self._show(take(data, **more))
        return self

    def _show(self, data: FigureData) -> None:
        with self._gate.alone:
            is_first, again = not self._looked, self._again
            number = self._counts[1]
            try:
                if is_first:
                    self._look(data, "show")
                    if self._move_origin():
                        self._look(data, "show")
                self._give(_SHOW, data, number)
                self._counts[1] = number + 1
                self._shown, self._again = data, None
            except BaseException:
                if is_first:  # what was found is of this frame
                    self._begin(again)
                raise

    def set_mesh(self, mesh, **more) -> "Figure":
        """Sets a mesh that stands still among the particles, such as walls; None: none. Returns the figure.

        What is shown, and a survey, are as after `set`.
        """
        return self._stand(None if mesh is None else take(mesh, **more))

    def _stand(self, data: Optional[FigureData]) -> "Figure":
        with self._gate.alone:
            self._give_mesh(data, self._origin or (data and data.origin) or [0.0] * 3)
            self._mesh = data
            self._forget(self._last)
        return self

    def _give_mesh(self, data: Optional[FigureData], origin) -> None:
        """Within the gate: a mesh for C, which begins anew, less the origin of the frames."""
        keep: list = []
        c = ffi.NULL if data is None else data.fill(ffi, 0, origin, keep, {})
        self._check(lib.cgt_figure_set_mesh(self._open, c))
        self._mesh_origin = list(origin)
        del keep

    @property
    def camera(self) -> Camera:
        """The camera of the shown frame, less the data's origin, a copy; one that is assigned is that of all frames.

        With the option ortho it is orthographic, without it no such one can be assigned.
        """
        c = ffi.new("cgt_camera *")
        self._bring_back()
        with self._gate.alone:
            result = lib.cgt_figure_get_camera(self._open, c)
        if result:
            raise InvalidArgument("figure: nothing is shown")
        if "ortho" in self._texts:  # C's is so from the first picture on
            c.projection = lib.CGT_PROJECTION_ORTHOGRAPHIC
            c.height = 2 * math.dist(c.eye, c.target) * math.tan(math.radians(c.fov / 2))
        camera = Camera()
        camera._struct[0] = c[0]
        return camera

    @camera.setter
    def camera(self, camera: Camera) -> None:
        c = instance("camera", camera, Camera)._copy()._struct
        c.fov = _fov_of(c)
        with self._gate.alone:
            if camera.projection == "orthographic" and "ortho" not in self._texts:
                raise InvalidArgument("camera: it is orthographic, and the option ortho is not set")
            result = lib.cgt_figure_set_camera(self._open, c)
            self._pixels = None
        if result:
            raise InvalidArgument("camera: eye and target are the same")
        c.projection = lib.CGT_PROJECTION_PERSPECTIVE  # by its angle; the option ortho tells the other
        self._view = Camera()
        self._view._struct[0] = c[0]

    def fit(self) -> "Figure":
        """Moves the camera so that it shows all of the shown frame, in the same direction; returns the figure."""
        self._bring_back()
        with self._gate.alone:
            self._check(lib.cgt_figure_fit(self._open))
            self._pixels = None
            self._view = Camera()
            lib.cgt_figure_get_camera(self._open, self._view._struct)
            self._view._struct.projection = lib.CGT_PROJECTION_PERSPECTIVE
        return self

    def pick(self, x: int, y: int) -> SimpleNamespace:
        """What a pixel of the shown frame shows.

        Returns
        -------
        SimpleNamespace
            is_hit; is_data: a particle or triangle, whose number is `element`; else a bond, a line, the floor, the
            mesh; place: where, less the data's origin; t: how far along the pixel's ray, in units of its direction,
            which is not normalised (`cgt.camera_rays`).
        """
        self._bring_back()
        hit = ffi.new("cgt_figure_hit *")
        width, height = self.size
        with self._gate.alone:
            self._check(lib.cgt_figure_pick(self._open, whole("x", x, 0, width - 1), whole("y", y, 0, height - 1), hit))
        return SimpleNamespace(**struct_values(hit[0], ffi))

    # ---- pictures ----

    def draw(self) -> np.ndarray:
        """Draws the shown frame: (height, width, 3) uint8, a new array; with the option transparent 4 numbers."""
        return self._draw().copy()

    def _draw(self) -> np.ndarray:
        self._bring_back()
        if self._open and self._shown is None:
            raise InvalidArgument("figure: nothing is shown: show() a frame; after a survey set() asks for both anew")
        width, height = self.size
        with self._gate.alone:
            pixels, keep = np.zeros((height, width, 3), U1), []
            image = ffi.new("cgt_image *", {"bytes": _arrays.pointer(pixels), "channels": 3})
            if "transparent" in self._texts:
                keep.append(np.zeros((height, width), U1))
                image.alpha = _arrays.pointer(keep[0])
            hold = Hold(pixels)
            self._check(lib.cgt_figure_draw(self._open, image, ffi.NULL))
            self._pixels = np.dstack([pixels, *keep]) if keep else pixels
            del hold
            return self._pixels

    @property
    def pixels(self) -> np.ndarray:
        """The picture of the shown frame, drawn once: (height, width, 3 or 4) uint8, the array that `save` writes."""
        return self._draw() if self._pixels is None else self._pixels

    def save(self, path, dpi: Optional[float] = None) -> None:
        """Writes the picture of the shown frame, a PNG file. dpi: pixels to an inch, as the file tells them."""
        check_png(path, "; movie() makes movies")
        data = encode_png(self.pixels, dpi)
        with open(path, "wb") as file:
            file.write(data)

    def _draw_quick(self, shrink: int) -> np.ndarray:
        """The shown frame without shadows, one ray for so many pixels along each edge."""
        self._bring_back()
        width, height = self.size
        with self._gate.alone:
            pixels = np.zeros((height, width, 3), U1)
            hold, image = Hold(pixels), ffi.new("cgt_image *", {"bytes": _arrays.pointer(pixels), "channels": 3})
            self._check(lib.cgt_figure_draw_quick(self._open, lib.CGT_FIGURE_PLAIN, shrink, image))
            del hold
            return pixels

    def _repr_png_(self) -> Optional[bytes]:
        """What a notebook shows."""
        return None if self._shown is self._again is None else encode_png(self.pixels)

    def _repr_mimebundle_(self, **_: Any) -> Optional[Dict[str, Any]]:
        """The same, which the mouse turns where anywidget is installed and the kernel runs."""
        png = self._repr_png_()
        if png is None or importlib.util.find_spec("anywidget") is None:
            return None
        from ._widget import Turned

        found: Any = Turned(self)._repr_mimebundle_()
        return {**((found[0] if isinstance(found, tuple) else found) or {}), "image/png": png, "text/plain": repr(self)}

    def movie(self, path, run, fps: float = 25.0, quality: int = 80, survey: bool = True, progress: bool = True,
              **more) -> "Figure":
        """Draws all frames of a run, and writes a movie by the program ffmpeg. Returns the figure.

        Parameters
        ----------
        path : path
            .mp4, .mov, .mkv, .webm or .gif.
        run
            As of `survey`; with a survey it is looped over twice.
        fps : float, optional
            Frames per second.
        quality : int, optional
            1 to 100.
        survey : bool, optional
            Surveys the run first; False: camera and ranges are those of the survey before, or of the first frame.
        progress : bool, optional
            Shows a bar, where tqdm is installed.
        **more
            As of `show`.
        """
        if not is_run(run) and not hasattr(run, "atoms"):
            raise InvalidArgument(f"run: {type(run).__name__}: must be frames one after the other")
        survey, progress = switch("survey", survey), switch("progress", progress)
        with _Encoder(path, self.size, fps, quality) as encoder:
            if survey:
                run = list(run) if is_read_once(run) else run
                self._survey_run(run, more)
            for frame in _with_progress(self._frames(run), run, progress):
                self._show(take(frame, **more))
                encoder.write(self._draw())
        return self

    def close(self) -> None:
        """Releases it; `InUse` if a call is using it."""
        with self._gate.alone:
            self._handle = None

    def __enter__(self) -> "Figure":
        return self

    def __exit__(self, *_) -> None:
        self.close()


# ---- movies ----


def _with_progress(frames, run, wanted: bool):
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return frames
    try:
        total = len(getattr(run, "trajectory", run))
    except TypeError:
        total = None
    return tqdm(frames, total=total, unit="frame", disable=not wanted)


class _Encoder:
    """A pipe to ffmpeg, whose file is there only where all went well."""

    _COLORS = ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv", "-pix_fmt", "yuv420p",
               "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv"]
    _VP9 = ["-c:v", "libvpx-vp9", "-deadline", "realtime", "-cpu-used", "8", "-row-mt", "1", "-b:v", "0"]
    _GIF = ["-filter_complex", "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1"]

    def __init__(self, path, size, fps, quality):
        self.path, lost = os.path.abspath(text_of_path("path", path)), 100 - whole("quality", quality, 1, 100)
        ending = os.path.splitext(self.path)[1].lower()
        x264 = ["-crf", str(min(51, round(0.9 * lost))), "-c:v", "libx264", "-preset", "veryfast"]
        ways = {".gif": self._GIF, ".webm": self._COLORS + ["-crf", str(min(63, round(1.5 * lost)))] + self._VP9,
                ".mkv": self._COLORS + x264, **dict.fromkeys((".mp4", ".mov"),
                                                             self._COLORS + x264 + ["-movflags", "+faststart"])}
        if ending not in ways:
            raise InvalidArgument(f"path: {ending or self.path}: movies are {', '.join(ways)}")
        if os.path.isdir(self.path):
            raise InvalidArgument(f"path: {self.path}: it is a folder")
        if not 0 < real("fps", fps) <= 1000:
            raise InvalidArgument(f"fps: {fps}: must be above 0 and at most 1000")
        if shutil.which("ffmpeg") is None:
            raise InvalidArgument("path: movies need the program ffmpeg, and it is not in PATH (Debian: apt-get install "
                                  "ffmpeg)")
        self.count = 0  # of frames
        self.temporary = f"{self.path[:-len(ending)]}.{os.getpid()}{ending}"
        self.process = subprocess.Popen(
            ["ffmpeg", "-v", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", "%dx%d" % size, "-r", f"{fps:.9g}",
             "-i", "pipe:0", "-an", *ways[ending], "-y", "file:" + self.temporary],
            stdin=subprocess.PIPE, stderr=subprocess.PIPE)

    def write(self, pixels: np.ndarray) -> None:
        """One frame."""
        self.count += 1
        try:
            self.process.stdin.write(np.ascontiguousarray(pixels[..., :3]).data)
        except BrokenPipeError:
            pass  # __exit__ tells what ffmpeg said

    def __enter__(self) -> "_Encoder":
        return self

    def __exit__(self, kind, *_) -> None:
        if kind is not None:
            self.process.kill()
        said = self.process.communicate()[1].decode(errors="replace").strip()
        is_whole = kind is None and self.count and self.process.returncode == 0
        try:
            if is_whole:
                os.replace(self.temporary, self.path)
        finally:
            if os.path.exists(self.temporary):
                os.remove(self.temporary)
        if kind is None and not self.count:
            raise InvalidArgument("run: without frames")
        if kind is None and not is_whole:
            raise Error(f"{self.path}: ffmpeg: {said.splitlines()[0] if said else 'it failed'}")

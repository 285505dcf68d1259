# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Scenes: geometries over arrays, and their structure."""
from __future__ import annotations

from types import MappingProxyType, SimpleNamespace
from typing import Dict, Mapping, Optional, Union

import numpy as np

from ._frames import Frames
from ._gate import Gate
from ._held import Held
from ._native import InvalidArgument, NotCommitted, Plain, enum_value, ffi, instance, lib, struct_values, whole
from ._rays import Rays
from .context import Context, check
from .geometry import Capsules, Spheres, Triangles, _Geometry
from .research import SceneOptions


class Scene(Plain, Frames, Rays):
    """Geometries over the caller's arrays, and the structure that rays go through.

    Parameters
    ----------
    context : Context, optional
        None: one of its own, with the default threads.
    structure : {'auto', 'loose_grid', 'bvh', 'queue_grid', 'kd', 'kd_ropes', 'bih'}, optional
        The last four are those of published algorithms (see `cgt.research`).
    rays : {'coherent', 'incoherent'}, optional
        What the scene is mostly traced with: cameras, or rays that start anywhere and go anywhere.
    research : cgt.research.SceneOptions, optional

    Notes
    -----
    One thread at a time changes and commits a scene, while none traces it; any number of threads may trace it at once.
    What comes in between, from another thread or from a callback, gets `InUse`. Every call that commits or traces
    releases Python's lock. Results are the same bits for any number of threads.

    Examples
    --------
    >>> import cgt, numpy
    >>> with cgt.Scene() as scene:
    ...     ball = scene.add(cgt.Spheres([[0, 0, 0]], 1.0))
    ...     scene.commit()
    ...     hits = scene.trace_rays([[0, 0, 5], [0, 3, 5]], [0, 0, -1])
    ...     hits.t.tolist(), hits.hit.tolist()
    ([4.0, inf], [True, False])
    """

    __slots__ = (
    "_handle",
    "_gate",
    "_context",
    "_context_handle",
    "_geometries",
    "_committed",
    "_in_place",
     "_changes")
    _unmade = {"_made": False, "_handle": None, "_gate": Gate("scene"), "_changes": 0}

    def __init__(self, context: Optional[Context] = None, *, structure: str = "auto", rays: str = "coherent",
                 research=None):
        if self._handle is not None:
            raise InvalidArgument("scene: its __init__ has run")
        self._context = Context() if context is None else instance("context", context, Context)
        self._context_handle = self._context.handle
        made = ffi.new("cgt_scene **")
        self._check(lib.cgt_scene_create(self._context_handle, self._options(structure, rays, research), made))
        self._gate = Gate("scene", self._context_handle)
        self._geometries: Dict[int, Held] = {}
        self._committed: Optional[Dict[int, Held]] = {}  # what C reads when it traces
        self._in_place: list = []
        self._changes = 0
        self._given = {"structure": structure, "rays": rays, "research": research}
        self._handle = ffi.gc(made[0], lib.cgt_scene_release)
        self._made = True

    @staticmethod
    def _options(structure, rays, research):
        options = ffi.new("cgt_scene_options *")
        options.structure = enum_value("CGT_STRUCTURE_", structure, "structure")
        options.rays = enum_value("CGT_RAY_KIND_", rays, "rays")
        if research is not None:
            options.research = instance("research", research, SceneOptions)._struct
        return options

    def _check(self, result: int) -> None:
        check(self._context_handle, result)

    def _arguments(self) -> dict:
        if self._handle is None:
            raise InvalidArgument("scene: it is closed")
        return {"context": self._context, **self._given}

    def _rest(self) -> dict:
        return {**super()._rest(), "_data": (self.geometries.copy(), self._changes > 0)}

    def _set_data(self, data) -> None:
        geometries, is_committed = data
        for id in range(max(geometries, default=-1) + 1):
            self.add(geometries[id] if id in geometries else Spheres(np.empty((0, 3))))
        for id in set(self._geometries) - set(geometries):
            self.remove(id)
        if is_committed:
            self.commit()

    _data = property(None, _set_data, doc="The geometries of a copy, which is committed anew as the first was.")

    def _told(self) -> dict:
        return {**super()._told(), "geometries": dict(self.geometries)}

    @property
    def context(self) -> Context:
        """Where its threads are from."""
        return self._context

    @property
    def handle(self):
        """The C handle; an error once the scene is closed."""
        if self._handle is None:
            raise InvalidArgument(f"scene: it {'is closed' if self._made else 'has not run its __init__'}")
        return self._handle

    @property
    def _traced(self):
        """The C handle for a call that traces, within the gate."""
        if self._committed is None:
            raise NotCommitted("scene: its last commit was interrupted")
        for name, hold in self._in_place:
            hold.check(name)
        return self.handle

    def close(self) -> None:
        """Releases the structure and the arrays.

        Raises
        ------
        InUse
            A call uses the scene.
        """
        with self._gate.alone:
            if self._handle is not None:
                self._changes += 1
                self._handle = None  # C's scene goes with the last reference to it
                self._geometries, self._committed, self._in_place = {}, {}, []

    def __enter__(self) -> "Scene":
        return self

    def __exit__(self, *_) -> None:
        self.close()

    # ---- geometries ----

    @property
    def geometries(self) -> Mapping[int, _Geometry]:
        """The geometries by id."""
        return MappingProxyType({id: held.geometry for id, held in self._geometries.items()})

    def set_options(self, *, structure: str = "auto", rays: str = "coherent", research=None) -> None:
        """Sets the options of the next commit, as the constructor does."""
        options = self._options(structure, rays, research)
        with self._gate.alone:
            self._check(lib.cgt_scene_set_options(self.handle, options))
            self._given = {"structure": structure, "rays": rays, "research": research}

    def add(self, geometry: Union[Spheres, Triangles, Capsules]) -> int:
        """Adds a geometry and returns its id, the lowest that is free. It counts from the next commit on."""
        return self._set(lib.CGT_INVALID_ID, Held(geometry))

    def update(self, geometry: int, description: Union[Spheres, Triangles, Capsules]) -> None:
        """Replaces a geometry: another count, other arrays. New numbers in the same arrays need `commit` alone."""
        id = whole("geometry", geometry)
        if id == lib.CGT_INVALID_ID:
            raise InvalidArgument(f"geometry: {id}: there is no such one")
        self._set(id, Held(description))

    def _set(self, id: int, held: Held) -> int:
        out = ffi.new("uint32_t *", id)
        call = getattr(lib, "cgt_scene_set_" + held.kind)
        with self._gate.alone:
            self._check(call(self.handle, out, held.struct))
            self._geometries[out[0]] = held
        return out[0]

    def remove(self, geometry: int) -> None:
        """Removes a geometry. Its id is free again, the others stay."""
        id = whole("geometry", geometry)
        with self._gate.alone:
            self._check(lib.cgt_scene_remove_geometry(self.handle, id))
            del self._geometries[id]

    def commit(self) -> None:
        """Builds the structure from the arrays as they are now; the scene keeps them alive until the next commit.

        Raises
        ------
        InvalidArgument
            An index or a type is out of range.
        InUse
            A call uses the scene.
        BufferError
            An array's memory was replaced.
        OutOfMemory, TooLarge
        """
        with self._gate.alone:
            handle = self.handle
            self._changes += 1
            for held in self._geometries.values():
                held.check()
            self._committed = None  # until C has checked what was copied, however this ends
            for id, held in self._geometries.items():
                if held.read():
                    call = getattr(lib, "cgt_scene_set_" + held.kind)
                    self._check(call(handle, ffi.new("uint32_t *", id), held.struct))
            result = lib.cgt_scene_commit(handle)
            self._committed = dict(self._geometries)
            self._in_place = [pair for held in self._committed.values() for pair in held.in_place()]
            self._check(result)

    def prepare(self, rays: str = "incoherent") -> None:
        """Builds the BVH beside a grid now, not in the first call that needs it."""
        kind = enum_value("CGT_RAY_KIND_", rays, "rays")
        with self._gate.shared:
            self._check(lib.cgt_scene_prepare(self._traced, kind))

    @property
    def statistics(self) -> SimpleNamespace:
        """What the last commit found, chose and spent (cgt_scene_statistics); copied_bytes 0: all is read in place."""
        s = ffi.new("cgt_scene_statistics *")
        self._check(lib.cgt_scene_get_statistics(self.handle, s))
        return SimpleNamespace(**struct_values(s[0]))

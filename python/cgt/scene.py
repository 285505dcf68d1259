# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Scenes: geometries over arrays, and their structure."""
from types import SimpleNamespace
from typing import Dict, Optional, Tuple, Union

from ._frames import Frames
from ._native import InvalidArgument, enum_value, ffi, lib, struct_values
from ._rays import Rays
from .context import Context
from .geometry import Capsules, Spheres, Triangles, _Geometry


class Scene(Frames, Rays):
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
    Every call that commits or traces releases Python's lock. Results are the same bits for any number of threads.

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

    def __init__(self, context: Optional[Context] = None, *, structure: str = "auto", rays: str = "coherent",
                 research=None):
        self.context = Context() if context is None else context
        made = ffi.new("cgt_scene **")
        self.context.check(lib.cgt_scene_create(self.context.handle, self._options(structure, rays, research), made))
        self._handle = ffi.gc(made[0], lib.cgt_scene_release)
        self._geometries: Dict[int, _Geometry] = {}
        self._committed: Tuple[_Geometry, ...] = ()
        self._changes = 0

    def _options(self, structure, rays, research):
        self._research = research
        options = ffi.new("cgt_scene_options *")
        options.structure = enum_value("CGT_STRUCTURE_", structure, "structure")
        options.rays = enum_value("CGT_RAY_KIND_", rays, "rays")
        if research is not None:
            options.research = research._struct
        return options

    def _check(self, result: int) -> None:
        self.context.check(result)

    @property
    def handle(self):
        """The C handle; an error once the scene is closed."""
        if self._handle is None:
            raise InvalidArgument("scene: it is closed")
        return self._handle

    def close(self) -> None:
        """Releases the structure and the arrays; no thread may be using the scene."""
        if self._handle is not None:
            self._changes += 1
            ffi.release(self._handle)
            self._handle, self._geometries, self._committed = None, {}, ()

    def __enter__(self) -> "Scene":
        return self

    def __exit__(self, *_) -> None:
        self.close()

    # ---- geometries ----

    @property
    def geometries(self) -> Dict[int, _Geometry]:
        """The geometries by id."""
        return dict(self._geometries)

    def set_options(self, *, structure: str = "auto", rays: str = "coherent", research=None) -> None:
        """Sets the options of the next commit, as the constructor does."""
        self._check(lib.cgt_scene_set_options(self.handle, self._options(structure, rays, research)))

    def add(self, geometry: Union[Spheres, Triangles, Capsules]) -> int:
        """Adds a geometry and returns its id, the lowest that is free. It counts from the next commit on."""
        out = ffi.new("uint32_t *")
        call = getattr(lib, "cgt_scene_add_" + self._kind(geometry))
        self._check(call(self.handle, geometry._struct, out))
        self._geometries[out[0]] = geometry
        return out[0]

    def update(self, geometry: int, description: Union[Spheres, Triangles, Capsules]) -> None:
        """Replaces a geometry: another count, other arrays. New numbers in the same arrays need `commit` alone."""
        call = getattr(lib, "cgt_scene_update_" + self._kind(description))
        self._check(call(self.handle, geometry, description._struct))
        self._geometries[geometry] = description

    def remove(self, geometry: int) -> None:
        """Removes a geometry. Its id is free again, the others stay."""
        self._check(lib.cgt_scene_remove_geometry(self.handle, geometry))
        del self._geometries[geometry]

    @staticmethod
    def _kind(geometry) -> str:
        if not isinstance(geometry, _Geometry):
            raise InvalidArgument(f"geometry: {type(geometry).__name__}: must be Spheres, Triangles or Capsules")
        return geometry._kind

    def copied_bytes(self, geometry: int) -> int:
        """How many bytes of a geometry's arrays each commit will copy; 0: all are traced where they lie."""
        out = ffi.new("size_t *")
        self._check(lib.cgt_scene_get_copied_bytes(self.handle, geometry, out))
        return out[0]

    def commit(self) -> None:
        """Builds the structure from the arrays as they are now; the scene keeps them alive until the next commit.

        Raises
        ------
        InvalidArgument
            An index or a type is out of range.
        OutOfMemory, TooLarge
        """
        self._changes += 1  # before C goes on without the lock
        result = lib.cgt_scene_commit(self.handle)
        self._committed = tuple(self._geometries.values())
        self._check(result)

    def prepare(self, rays: str = "incoherent") -> None:
        """Builds the BVH beside a grid now, not in the first call that needs it."""
        self._check(lib.cgt_scene_prepare(self.handle, enum_value("CGT_RAY_KIND_", rays, "rays")))

    @property
    def statistics(self) -> SimpleNamespace:
        """What the last commit found, chose and spent (cgt_scene_statistics); copied_bytes 0: all is read in place."""
        s = ffi.new("cgt_scene_statistics *")
        self._check(lib.cgt_scene_get_statistics(self.handle, s))
        return SimpleNamespace(**struct_values(s[0]))

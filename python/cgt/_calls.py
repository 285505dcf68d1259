# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""What calls share: their options, rays, and where results go."""
from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from ._arrays import F4, U4, Hold, Outputs, is_output, ray_vectors, refuse_overlap, scalar_pointers, vector_pointers
from ._native import InvalidArgument, enum_value, ffi, instance, several, struct_values, switch
from .research import TraceOptions

Out = Optional[Union[Mapping[str, np.ndarray], np.ndarray]]


class _Call:
    """cgt_trace_options of one call, and its statistics."""

    def __init__(self, precision: str, statistics: bool, research):
        self.struct = ffi.new("cgt_trace_options *")
        self.struct.precision = enum_value("CGT_PRECISION_", precision, "precision")
        self.counts = ffi.new("cgt_trace_statistics *") if switch("statistics", statistics) else None
        if self.counts:
            self.struct.statistics = self.counts
        if research is not None:
            self.research = instance("research", research, TraceOptions)._native
            self.struct.research = self.research[0]

    def statistics(self) -> Optional[SimpleNamespace]:
        return SimpleNamespace(**struct_values(self.counts[0])) if self.counts else None


def _names(argument: str, names: Sequence[str]) -> Tuple[str, ...]:
    """One name, or several."""
    if names.__class__ is not tuple:  # most are, and need no look at what else they may be
        if isinstance(names, str) or not isinstance(names, Iterable):
            names = (names,)
        names = several(argument, list(names) if isinstance(names, Mapping) else names, "names")
    for name in names:
        if not isinstance(name, str):
            raise InvalidArgument(f"{argument}: {name!r}: must be names of fields")
    return tuple(names)


def _expand(fields: Sequence[str], argument: str = "fields") -> Tuple[str, ...]:
    """'uv' stands for u and v, which C gives together."""
    wanted: List[str] = []
    for name in _names(argument, fields):
        wanted += ["u", "v"] if name in ("uv", "u", "v") else [name]
    return tuple(dict.fromkeys(wanted))


def _taken(argument: str, given, names: Sequence[str]) -> dict:
    """Arrays by name of what a call returned, or of what has them in the same way."""
    found = {}
    for name in names:
        try:
            found[name] = given[name]
        except (TypeError, ValueError, LookupError):
            raise InvalidArgument(f"{argument}: {type(given).__name__}: it lacks {name!r}") from None
    return found


class _Rays:
    """A cgt_rays over arrays."""

    def __init__(self, org, dir, **numbers):
        (o, of_org), (d, of_dir) = ray_vectors("org", org), ray_vectors("dir", dir)
        shapes = of_org, of_dir
        if len(o) == 1 and len(shapes[0]) == 0:
            o, shapes = np.broadcast_to(o, d.shape), (shapes[1], shapes[1])
        elif len(d) == 1 and len(shapes[1]) == 0:
            d, shapes = np.broadcast_to(d, o.shape), (shapes[0], shapes[0])
        if shapes[0] != shapes[1]:
            raise InvalidArgument(f"dir: shape {of_dir + (3,)}: must be that of org, {of_org + (3,)}")
        self.shape = shapes[0]
        (org_p, dir_p), vector_stride, self.keep = vector_pointers(o, d)
        types = {"t_min": F4, "t_max": F4, "mask": U4, "skip_primitive": U4, "skip_geometry": U4}
        given = {name: (a, types[name]) for name, a in numbers.items() if a is not None}
        members, stride, keep = scalar_pointers(given, self.shape)
        self.keep += keep
        self.struct = ffi.new("cgt_rays *", {"count": len(o), "stride": stride, "vector_stride": vector_stride,
                                             "org": org_p, "dir": dir_p, **members})


def _hits_struct(outputs: Outputs, axes: int = 1) -> dict:
    numbers, vectors = outputs.strides(axes)
    members = outputs.pointers()
    members.update(stride=numbers[-1] if numbers else 0, vector_stride=vectors[-1] if vectors else 0)
    return members


def _flat(outputs: Outputs, shape) -> Outputs:
    """The same outputs along one axis; those that cannot be seen so are refused."""
    if len(shape) == 1:
        return outputs
    count = math.prod(shape)
    flat = Outputs((count,), (), {})
    flat.is_own = outputs.is_own
    for name, a in outputs.arrays.items():
        view = a.reshape((count,) + a.shape[len(shape):])
        if a.size and not np.shares_memory(view, a):
            raise InvalidArgument(f"out[{name!r}]: strides {a.strides}: rows must follow each other")
        flat.arrays[name] = view
    return flat


def _bytes_out(name: str, out: Optional[np.ndarray], shape, read: Iterable[Hold] = ()) -> Hold:
    """An array of bytes for a call, its own or the caller's, which is none of those that it reads."""
    if out is None:
        return Hold(np.empty(shape, np.uint8))
    if not isinstance(out, np.ndarray):
        raise InvalidArgument(f"{name}: {type(out).__name__}: must be an array of uint8 or bool")
    if not any(is_output(out, np.dtype(kind), shape) for kind in (np.uint8, np.bool_)) or (
            not np.asarray(out).flags.c_contiguous):
        raise InvalidArgument(f"{name}: dtype {out.dtype}, shape {out.shape}: must be a writable, contiguous array of "
                              f"uint8 or bool, shape {tuple(shape)}")
    refuse_overlap(name, out, read)
    return Hold(np.asarray(out).view(np.uint8))

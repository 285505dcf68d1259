# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Colours of values, types and elements, as cgt-render has them: linear shares of red, green and blue.

>>> import cgt
>>> cgt.colors.maps()[0]
'viridis'
>>> cgt.colors.by_value([0.0, 0.5, 1.0], low=0, high=1).shape
(3, 3)
"""
from typing import Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import F4
from ._native import InvalidArgument, load_part, whole

ffi, lib = load_part("picture")
_STEPS = 1024  # as in cgt-render


def maps() -> Tuple[str, ...]:
    """The names of the colour maps; the first is the default. With "_r" behind it a name is the map reversed."""
    names, found = lib.cgt_get_colormap_names(), []
    while names[len(found)]:
        found.append(ffi.string(names[len(found)]).decode())
    return tuple(found)


def _linear(of, *arguments) -> list:
    out = ffi.new("float[3]")
    of(*arguments, out)
    return [lib.cgt_srgb_to_linear(x) for x in out]


def unknown() -> np.ndarray:
    """The colour of values that are not finite, which no map contains: (3,) float32."""
    return np.array(_linear(lib.cgt_get_unknown_color), F4)


def palette(map: Optional[str] = None) -> np.ndarray:
    """The 1,024 colours of a map and `unknown`, for `cgt.Look` with the entries of `entries`: (1025, 3) float32."""
    found = lib.cgt_find_colormap(ffi.NULL if map is None else str(map).encode(errors="replace"))
    if found == ffi.NULL:
        raise InvalidArgument(f"map: {map!r}: one of {', '.join(maps())}")
    return np.array([_linear(lib.cgt_get_map_color, found, k / (_STEPS - 1)) for k in range(_STEPS)] + [unknown()], F4)


def entries(values: ArrayLike, low: Optional[float] = None, high: Optional[float] = None) -> np.ndarray:
    """The entries of `palette` for values, (n,) uint16.

    Parameters
    ----------
    values : (n,) numbers
        What is not finite gets the last entry.
    low, high : float, optional
        Ends of the map; None: the quantiles of 1 and 99 percent of the values.
    """
    values = np.asarray(values, np.float64)
    known = np.isfinite(values)
    ends = np.quantile(values[known], (0.01, 0.99)) if known.any() else (0.0, 1.0)
    low, high = ends[0] if low is None else low, ends[1] if high is None else high
    share = (np.where(known, values, low) - low) / (high - low if high > low else np.inf)
    return np.where(known, np.clip(share, 0, 1) * (_STEPS - 1) + 0.5, _STEPS).astype(np.uint16)


def by_value(values: ArrayLike, map: Optional[str] = None, low: Optional[float] = None,
             high: Optional[float] = None) -> np.ndarray:
    """The colours of values by a map, (n, 3) float32; arguments are those of `palette` and `entries`."""
    return palette(map)[entries(values, low, high)]


def _of_kinds(of, kinds) -> np.ndarray:
    values, place = np.unique(np.asarray(kinds), return_inverse=True)
    if len(values):
        whole("kinds", int(values[0]), 0), whole("kinds", int(values[-1]))
    return np.array([_linear(of, int(v)) for v in values], F4).reshape(-1, 3)[place.reshape(-1)]


def by_type(types: ArrayLike) -> np.ndarray:
    """The colours of types, (n,) int from 1 on: eight that everyone can tell apart, again and again: (n, 3) float32."""
    return _of_kinds(lib.cgt_get_type_color, types)


def by_element(numbers: ArrayLike) -> np.ndarray:
    """The colours of elements, (n,) atomic numbers, Jmol's; 0 is unknown, a light pink: (n, 3) float32."""
    return _of_kinds(lib.cgt_get_element_color, numbers)

# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Arrays as the library reads and writes them: checked, referenced where they lie, copied only where this is said."""
from __future__ import annotations

import math
import weakref
from typing import Dict, Iterable, List, Mapping, Optional, Sequence, Tuple

import numpy as np

from ._native import FLOAT_MAX, InvalidArgument, ffi, lib

F2, F4, F8, U8, I8, U4, I4, U2, U1 = (np.dtype(t) for t in ("f2", "f4", "f8", "u8", "i8", "u4", "i4", "u2", "u1"))
FORMAT = {F4: "FLOAT", F8: "DOUBLE", F2: "HALF", U1: "UINT8", U2: "UINT16", U4: "UINT32", I4: "UINT32", U8: "UINT64",
          I8: "UINT64"}  # of cgt_array: the numbers of indices and types are not negative
POINTER = {
    dtype: ffi.typeof(name)
    for dtype, name in (
        (F4, "float *"), (F8, "double *"), (U4, "uint32_t *"), (I4, "uint32_t *"), (U2, "uint16_t *"),
        (U1, "uint8_t *"), (F2, "uint16_t *"), (U8, "uint64_t *"), (I8, "uint64_t *")
    )
}


class Hold:
    """Keeps the memory of an array where it is: nothing that owns a part of it can be resized, closed or freed.

    A reference alone does not: numpy resizes an array that others refer to if it is told to (refcheck=False). It never
    does so where there are weak references; and what else owns memory, such as a mapped file, refuses while a buffer of
    it is exported.
    """

    __slots__ = ("view", "_owner", "_size", "_kept")

    def __init__(self, a: np.ndarray):
        self.view = np.asarray(a)[...]  # of the plain class, whatever a subclass tells; its shape is nobody else's
        self._kept, owner = [], a
        while isinstance(owner, np.ndarray):
            self._kept.append(weakref.ref(owner))
            self._owner, owner = owner, owner.base
        self._size = self._owner.nbytes
        if owner is not None:
            try:
                self._kept.append(memoryview(owner))
            except (TypeError, ValueError, BufferError):  # it has no buffer to export
                pass

    def __reduce__(self):
        return Hold, (self.view,)

    def check(self, name: str) -> None:
        """Refuses an array whose memory was replaced all the same (ndarray.data, ndarray.__setstate__)."""
        if self._owner.nbytes != self._size or not (np.may_share_memory(self._owner, self.view) or not self.view.size):
            raise BufferError(f"{name}: the array's memory was replaced: what was read is gone; pass the array anew")


def address(a: np.ndarray) -> int:
    """The address of an array."""
    return a.__array_interface__["data"][0]


def pointer(a: np.ndarray):
    """The address of an array as a C pointer of its type."""
    return ffi.cast(POINTER[a.dtype], address(a))


def set_array(struct, view: np.ndarray, stride: int) -> None:
    """Makes a cgt_array be an array, whose rows are `stride` bytes apart."""
    struct.data, struct.stride = pointer(view), stride
    struct.format = getattr(lib, "CGT_FORMAT_" + FORMAT[view.dtype])


def component_pointers(a: np.ndarray) -> list:
    """Pointers to the numbers of an array's first vector."""
    kind, first, stride = POINTER[a.dtype], address(a), a.strides[-1]
    return [ffi.cast(kind, first + k * stride) for k in range(a.shape[-1])]


# ---- the one rule for what comes in ----


def _unmasked(name: str, a, masked: Optional[float]):
    """A masked array, or a list with some, as plain ones; what is masked is refused, or becomes `masked`."""
    if isinstance(a, (list, tuple)) and any(isinstance(x, (np.ma.MaskedArray, list, tuple)) for x in a):
        return [_unmasked(name, x, masked) for x in a]
    if not isinstance(a, np.ma.MaskedArray):
        return a
    if masked is None and np.ma.is_masked(a):
        raise InvalidArgument(f"{name}: {np.ma.count_masked(a)} elements are masked: fill or drop them")
    if masked is None or a.dtype.kind not in "biufUSO":
        return a.data
    if a.dtype.kind in "biuf":
        return a.astype(F8).filled(masked)
    b = a.data.copy()
    b[np.ma.getmaskarray(a)] = None if a.dtype == object else ""  # no word
    return b


def array_of(name: str, a, masked: Optional[float] = None, follow: bool = False) -> np.ndarray:
    """What is passed for an array, over its own memory where it has some (arrays, buffers, DLPack), else a new one.

    What is masked is refused, or becomes `masked`. With `follow`, so is what has masks at all, since they may change,
    and what makes a copy each time it is asked: neither would follow the caller's data.
    """
    if a.__class__ is np.ndarray:
        return a
    if a.__class__ is float or a.__class__ is int:
        return np.array(a)
    try:
        if hasattr(a, "__dlpack__") and not hasattr(a, "__array__") and not hasattr(a, "__array_interface__"):
            return np.from_dlpack(a)
        own = isinstance(a, (list, tuple, range, int, float, np.generic)) or a is None
        array = np.asanyarray(_unmasked(name, a, masked) if own else a)
        if follow and not own and not isinstance(a, np.ndarray) and not np.may_share_memory(array, np.asanyarray(a)):
            raise InvalidArgument(
                f"{name}: {type(a).__name__}: it makes a copy, which would not follow it: pass an array")
    except (TypeError, ValueError, RuntimeError, BufferError) as error:  # rows of several lengths, memory of a GPU
        if isinstance(error, InvalidArgument):
            raise
        raise InvalidArgument(f"{name}: {error or type(a).__name__}") from None
    if isinstance(array, np.ma.MaskedArray):
        if follow:
            raise InvalidArgument(
                f"{name}: a masked array: pass {name}.filled(numpy.nan), whose primitives are skipped")
        array = _unmasked(name, array, masked)
    return np.asarray(array)


def check_shape(name: str, a: np.ndarray, shape: Sequence) -> None:
    """Refuses another shape, whatever its size. Names stand for any number, ... for any axes."""
    has, wanted = a.shape, tuple(shape)
    if wanted[:1] == (...,):
        has, wanted = has[max(len(has) + 1 - len(wanted), 0):], wanted[1:]
    if len(has) != len(wanted) or any(isinstance(w, int) and h != w for h, w in zip(has, wanted)):
        text = ", ".join("..." if w is ... else str(w) for w in shape) + ("," if len(shape) == 1 else "")
        raise InvalidArgument(f"{name}: shape {a.shape}: must be ({text})")


def numbers(name: str, a, dtype: np.dtype, shape: Sequence = (), masked: Optional[float] = None) -> np.ndarray:
    """An array of a type and a shape, for a call that reads it once: its own memory where it is that, else a copy.

    Floats may be rounded, but what does not fit the type is refused; whole numbers are neither made of floats nor cut.
    """
    a = array_of(name, a, masked)
    if shape:
        check_shape(name, a, shape)
    if a.dtype == dtype:
        return a
    floats = dtype.kind == "f"
    if a.dtype.kind not in ("fiu" if floats else "iu"):
        if not a.size and a.dtype == F8:  # an empty list
            return a.astype(dtype)
        raise InvalidArgument(f"{name}: dtype {a.dtype}: must be {'numbers' if floats else f'whole numbers, {dtype}'}")
    if floats:
        fits = dtype.itemsize >= a.itemsize or a.dtype.kind != "f" or not a.size
        if fits or (np.minimum.reduce(a, axis=None) >= -FLOAT_MAX and np.maximum.reduce(a, axis=None) <= FLOAT_MAX):
            return a.astype(dtype)
        with np.errstate(over="ignore"):
            b = a.astype(dtype)
        if (np.isinf(b) & np.isfinite(a)).any():
            raise InvalidArgument(f"{name}: {a[np.isinf(b) & np.isfinite(a)].flat[0]:g}: beyond what {dtype} holds")
        return b
    if a.size and not np.can_cast(a.dtype, dtype):
        limit = np.iinfo(dtype)
        if a.min() < limit.min or a.max() > limit.max:
            raise InvalidArgument(f"{name}: {a.min()} to {a.max()}: must fit {dtype}")
    return a.astype(dtype)


def flags(name: str, a) -> np.ndarray:
    """One flag for each of three edges, or one for all, as int8 (3,) of its own: 0, 1, and -1 for what is not known."""
    b = array_of(name, a)
    if b.dtype.kind not in "biu" or b.shape not in ((), (3,)):
        raise InvalidArgument(f"{name}: {a!r}: must be True, False, or three of them")
    return np.array(np.broadcast_to(np.where(b == -1, -1, b != 0), (3,)), np.int8)


def given_rows(name: str, a, dtypes: Sequence[np.dtype], width: int) -> Tuple[Hold, int]:
    """An array of `width` numbers a row that C reads in place, and its stride in bytes; of a list, one of its own."""
    own = isinstance(a, (list, tuple, range))
    array = array_of(name, a, follow=True)
    if own and array.dtype not in dtypes:
        array = numbers(name, array, dtypes[0])
    hold = Hold(array)
    a = hold.view
    if a.dtype not in dtypes:
        names = " or ".join(str(d) for d in dtypes)
        raise InvalidArgument(f"{name}: dtype {a.dtype}: must be {names}; pass {name}.astype({str(dtypes[0])!r})")
    check_shape(name, a, ("n", width) if width > 1 else ("n",))
    row = width * a.itemsize
    stride = a.strides[0] if len(a) > 1 else row
    if width > 1 and len(a) and a.strides[1] != a.itemsize:
        raise InvalidArgument(
            f"{name}: strides {a.strides}: the {width} numbers of a row must lie side by side; "
            f"pass numpy.ascontiguousarray({name})"
        )
    if stride < row:
        raise InvalidArgument(
            f"{name}: strides {a.strides}: rows must follow each other without overlap; "
            f"pass numpy.ascontiguousarray({name})"
        )
    return hold, stride


def ray_vectors(name: str, a) -> Tuple[np.ndarray, tuple]:
    """Vectors of rays or points, (..., 3), as float32 (n, 3), a copy unless they are that already; and their shape."""
    if a.__class__ is not np.ndarray or a.dtype != F4 or a.shape[-1:] != (3,):
        a = numbers(name, a, F4, (..., 3))
    return a.reshape(-1, 3), a.shape[:-1]


def vector_pointers(*arrays: np.ndarray) -> Tuple[list, int, list]:
    """Three pointers for each (n, 3) array and their common stride; arrays that do not fit it are copied.

    Returns the pointers, the stride, and what must outlive the call.
    """
    first = arrays[0].strides[0] if len(arrays[0]) > 1 else 12
    fits = first >= 4 and all(
        a.strides[1] % 4 == 0 and address(a) % 4 == 0 and (len(a) < 2 or a.strides[0] == first) for a in arrays
    )
    if first % 4 or not fits:
        arrays, first = tuple(np.ascontiguousarray(a) for a in arrays), 12
    return [component_pointers(a) for a in arrays], first, [Hold(a) for a in arrays]


def scalar_pointers(arrays: Dict[str, Tuple[np.ndarray, np.dtype]], shape) -> Tuple[dict, int, list]:
    """Pointers to arrays of one number each, and their common stride; single numbers are spread.

    Copies what has another type or another stride than the first.
    """
    stride, pointers, keep = 4, {}, []
    if not arrays:
        return {}, 4, []
    count = math.prod(shape)
    plain = {}
    for name, (a, dtype) in arrays.items():
        b = numbers(name, a, dtype)
        if b.ndim == 0:
            b = np.broadcast_to(b, shape)
        elif b.shape != shape:
            raise InvalidArgument(f"{name}: shape {b.shape}: must be {tuple(shape)}, or one number")
        plain[name] = b.reshape(count)
    places = {b.strides[0] for b in plain.values()} if count > 1 else set()
    aligned = all(address(b) % 4 == 0 for b in plain.values())
    if aligned and len(places) == 1 and min(places) >= 4 and min(places) % 4 == 0:
        stride = places.pop()
    else:
        plain = {name: np.ascontiguousarray(b) for name, b in plain.items()}
    for name, b in plain.items():
        keep.append(Hold(b))
        pointers[name] = pointer(b)
    return pointers, stride, keep


def is_output(a, dtype: np.dtype, shape) -> bool:
    """Whether an array is what a call may write to."""
    return (isinstance(a, np.ndarray) and not isinstance(a, np.ma.MaskedArray) and np.asarray(
        a).dtype == dtype and np.asarray(a).shape == tuple(shape) and np.asarray(a).flags.writeable)


def refuse_overlap(name: str, a: np.ndarray, holds: Iterable[Hold]) -> None:
    """Refuses an output that lies where the call reads, which goes on while others of its rays are done."""
    if any(np.may_share_memory(a, hold.view) and np.shares_memory(a, hold.view) for hold in holds):
        raise InvalidArgument(f"{name}: it overlaps what the call reads")


class Outputs:
    """The arrays that a call fills: its own, or those that the caller has given.

    Parameters
    ----------
    shape : tuple
        Of the rays or pixels.
    fields : sequence of str
        Names in `kinds`.
    kinds : dict
        Type and width of each name.
    out : mapping or structured array, optional
        Arrays by name.
    """

    def __init__(self, shape, fields, kinds, out=None, argument="fields"):
        self.shape, self.is_own = tuple(shape), out is None
        self.arrays: Dict[str, np.ndarray] = {}
        self.keep: List[Hold] = []
        if not (out is None or isinstance(out, Mapping) or (isinstance(out, np.ndarray) and out.dtype.names)):
            raise InvalidArgument(f"out: {type(out).__name__}: must be arrays by field, or a structured array")
        for field in fields:
            if field not in kinds:
                raise InvalidArgument(f"{argument}: {field!r}: one of {', '.join(kinds)}")
            dtype, width = kinds[field]
            full = self.shape + ((width,) if width > 1 else ())
            if out is None:
                self.arrays[field] = np.empty(full, dtype)
                continue
            if field not in (out.dtype.names if isinstance(out, np.ndarray) else out):
                raise InvalidArgument(f"out: it lacks {field!r}")
            a = out[field]
            if not is_output(a, dtype, full):
                has = f"dtype {a.dtype}, shape {a.shape}" if isinstance(a, np.ndarray) else type(a).__name__
                raise InvalidArgument(f"out[{field!r}]: {has}: must be a writable array of {dtype}, shape {full}")
            self.arrays[field] = a
        self._refuse_overlap(() if out is None else tuple(self.arrays))

    def _refuse_overlap(self, names) -> None:
        for k, first in enumerate(names):
            for second in names[:k]:
                a, b = np.asarray(self.arrays[first]), np.asarray(self.arrays[second])
                if np.may_share_memory(a, b) and np.shares_memory(a, b):
                    raise InvalidArgument(f"out[{first!r}]: it overlaps out[{second!r}]")

    def strides(self, axes: int) -> Tuple[Tuple[int, ...], Tuple[int, ...]]:
        """The strides of numbers and of vectors along the first `axes` axes, in bytes."""
        if self.is_own:  # side by side, of 4 bytes
            kinds = {a.ndim > len(self.shape) for a in self.arrays.values()}
            rows = (max(self.shape[1], 1),) if axes == 2 else ()
            narrow, wide = (tuple(size * n for n in (*rows, 1)) for size in (4, 12))
            return narrow if False in kinds else (), wide if True in kinds else ()
        found: List[Optional[Tuple[int, ...]]] = [None, None]
        for field, a in self.arrays.items():
            a = np.asarray(a)
            vector = a.ndim > len(self.shape)
            own = list(a.strides[:axes])
            dense = a.itemsize * (a.shape[-1] if vector else 1)
            for k in reversed(range(axes)):  # an axis of one element has any stride
                if a.shape[k] < 2 or not a.size:
                    own[k] = own[k + 1] * max(a.shape[k + 1], 1) if k + 1 < axes else dense
            crossed = any(own[k] < own[k + 1] * a.shape[k + 1] for k in range(axes - 1))
            if crossed or (vector and a.strides[-1] % 4) or any(s < dense or s % 4 for s in own) or address(a) % 4:
                raise InvalidArgument(f"out[{field!r}]: strides {a.strides}: not ones that C can step by")
            if found[vector] is not None and found[vector] != tuple(own):
                raise InvalidArgument(f"out[{field!r}]: strides {a.strides}: must be those of the other arrays in out")
            found[vector] = tuple(own)
        return found[0] or (), found[1] or ()

    def pointers(self) -> dict:
        """Members of a C struct that point to the arrays."""
        members = {}
        for field, a in self.arrays.items():
            self.keep.append(Hold(a))
            a = self.keep[-1].view
            if a.ndim > len(self.shape):
                members[field] = component_pointers(a)
            else:
                members[field] = pointer(a)
        return members

# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""The loaded library: its version and its structs are those of the definitions; results become exceptions."""
from __future__ import annotations

import importlib
import inspect
import math
import operator
import os
from collections.abc import Mapping, Set

import numpy as np

from . import _definitions
from ._definitions import ffi


_FLOAT = np.dtype(np.float32)
FLOAT_MAX = float(np.finfo(np.float32).max)


class Error(Exception):
    """What libcgt refuses; the message names the argument."""


class InvalidArgument(Error, ValueError):
    """A value is outside its documented range."""


class OutOfMemory(Error, MemoryError):
    """There is no memory for the call; nothing is lost, it may be repeated."""


class TooLarge(Error, OverflowError):
    """A size would overflow, or is beyond a documented limit."""


class NotCommitted(Error, RuntimeError):
    """The scene was never committed, or a geometry was changed since."""


class Unsupported(Error, RuntimeError):
    """This CPU or this build lacks what was requested."""


class ThreadsRefused(Error, RuntimeError):
    """The system refused a thread or a lock."""


class Stopped(Error):
    """A visitor stopped the call, which is incomplete."""


class InUse(Error, RuntimeError):
    """Another call, of another thread or around this callback, uses what this one would change."""


def _load(module, name):
    """API mode links the library; ABI mode loads it, beside CGT_LIBRARY or as the loader finds it."""
    if hasattr(module, "lib"):
        return module.lib
    constants = ffi.dlopen(None)
    major, minor = constants.CGT_VERSION_MAJOR, constants.CGT_VERSION_MINOR
    path = f"lib{name}.so.{major}" + (f".{minor}" if major == 0 else "")
    core, own = os.environ.get("CGT_LIBRARY"), os.path.join(os.path.dirname(__file__), path)
    if core:
        path = core if name == "cgt" else os.path.join(os.path.dirname(core), f"lib{name}.so")
    elif os.path.exists(own):  # the package has it
        path = own
    try:
        return module.ffi.dlopen(path)
    except OSError as error:
        raise ImportError(f"{error}; set CGT_LIBRARY to the path of libcgt.so") from None


def load_part(name):
    """The definitions and the library of a part that the installed libcgt may lack: trajectory, picture."""
    try:
        module = importlib.import_module("._" + name, __package__)
    except ModuleNotFoundError as error:
        if error.name and not error.name.endswith("._" + name):
            raise
        raise ImportError(
            f"cgt was installed beside a libcgt without the library cgt-{name}: install that, then cgt again"
        ) from None
    return module.ffi, _load(module, "cgt-" + name)


def check_library(library):
    """Refuses a library that is not of the version of the definitions."""
    made_for = ".".join(str(getattr(library, "CGT_VERSION_" + part)) for part in ("MAJOR", "MINOR", "PATCH"))
    loaded = ffi.string(library.cgt_get_version()).decode()
    if loaded.split(".")[:2] != made_for.split(".")[:2]:
        raise ImportError(f"cgt was made for libcgt {made_for}, and {loaded} was loaded: install cgt again")


lib = _load(_definitions, "cgt")
check_library(lib)

EXCEPTIONS = {
    lib.CGT_ERROR_INVALID_ARGUMENT: InvalidArgument,
    lib.CGT_ERROR_OUT_OF_MEMORY: OutOfMemory,
    lib.CGT_ERROR_TOO_LARGE: TooLarge,
    lib.CGT_ERROR_NOT_COMMITTED: NotCommitted,
    lib.CGT_ERROR_UNSUPPORTED: Unsupported,
    lib.CGT_ERROR_THREADS: ThreadsRefused,
    lib.CGT_ERROR_STOPPED: Stopped,
}


def exception_of(result, message=""):
    """The exception for a cgt_result, with the library's sentence."""
    text = message or ffi.string(lib.cgt_get_result_string(result)).decode()
    return EXCEPTIONS.get(result, Error)(text)


def enum_value(prefix, name, what, library=lib):
    """The number of an enumerator by the end of its name, in any case; `what` is the argument, for the message."""
    try:
        if not isinstance(name, str) or not name.isascii():  # cffi tells that by a SystemError
            raise AttributeError
        return getattr(library, prefix + name.upper())
    except AttributeError:
        names = sorted(n[len(prefix):].lower() for n in dir(library) if n.startswith(prefix) and n != prefix + "MAX")
        raise InvalidArgument(f"{what}: {name!r}: one of {', '.join(names)}") from None


def whole(name, value, low=0, high=0xFFFFFFFF):
    """An int within a range, or an error that names it."""
    if value.__class__ is int and low <= value <= high:
        return value
    try:
        if isinstance(value, (bool, np.ndarray)) and (isinstance(value, bool) or value.ndim):
            raise TypeError
        number = operator.index(value)
    except TypeError:
        raise InvalidArgument(f"{name}: {value!r}: must be a whole number") from None
    if not low <= number <= high:
        raise InvalidArgument(f"{name}: {number}: must be from {low} to {high}")
    return number


def real(name, value):
    """A float that C's single precision holds, or an error that names it."""
    if value.__class__ is float and -FLOAT_MAX <= value <= FLOAT_MAX:
        return value
    try:
        if isinstance(value, (str, bytes, bytearray, bool, np.bool_, np.complexfloating, np.ma.MaskedArray)) or (
                isinstance(value, np.ndarray) and (value.ndim or value.dtype.kind not in "fiu")):
            raise TypeError
        number = float(value)
    except (TypeError, ValueError):
        raise InvalidArgument(f"{name}: {value!r}: must be a number") from None
    except OverflowError:
        number = 1e300
    if FLOAT_MAX < abs(number) < math.inf:
        raise InvalidArgument(f"{name}: {value!r}: beyond what float32 holds")
    return number


def _listed(name, value, what, of):
    """The three elements of a list, a tuple or an array; what has no order, or is text, is refused."""
    try:
        if isinstance(
    value,
    (str,
    bytes,
    bytearray,
    Set,
    Mapping,
    np.ma.MaskedArray)) or getattr(
        value,
        "ndim",
         1) != 1:
            raise TypeError
        elements = list(value)
    except TypeError:
        elements = []
    if len(elements) != 3:
        raise InvalidArgument(f"{name}: {value!r}: must be three {what}")
    return [of(name, x) for x in elements]


def three(name, value):
    """Three floats that single precision holds, or an error that names it."""
    kind = value.__class__
    if kind is np.ndarray and value.shape == (3,):
        if value.dtype is _FLOAT:
            return value.tolist()
        if value.dtype.kind in "fiu":
            value = value.tolist()
            kind = list
    if (kind is list or kind is tuple) and len(value) == 3:
        x, y, z = value
        try:  # most are plain, and need no call each
            if -FLOAT_MAX <= x <= FLOAT_MAX and -FLOAT_MAX <= y <= FLOAT_MAX and -FLOAT_MAX <= z <= FLOAT_MAX:
                return value
        except (TypeError, ValueError):
            pass
    return _listed(name, value, "numbers", real)


def three_whole(name, value):
    """A list of three ints from 0 on, or an error that names it."""
    return _listed(name, value, "whole numbers", whole)


def pair(name, value):
    """Two values, or an error that names them."""
    try:
        first, second = value
    except (TypeError, ValueError):
        raise InvalidArgument(f"{name}: {value!r}: must be two values") from None
    return first, second


def text_of_path(name, value):
    """A path as text, or an error that names it."""
    try:
        text = os.fsdecode(value)
    except TypeError:
        raise InvalidArgument(f"{name}: {value!r}: must be text or a path") from None
    if "\0" in text:
        raise InvalidArgument(f"{name}: {value!r}: a zero is in it")
    return text


def encoded(name, text):
    """The bytes of a text, or an error that names it: C would end it at a zero."""
    if "\0" in text:
        raise InvalidArgument(f"{name}: {text!r}: a zero is in it")
    return text.encode(errors="replace")


def keep_error(errors):
    """What cffi calls with the exception of a callback: it keeps it in a list, for who has called C."""
    return lambda _kind, error, _trace: errors.append(error)


def switch(name, value):
    """True or False, or an error that names it."""
    try:
        return bool(value)
    except (TypeError, ValueError):  # an array
        raise InvalidArgument(f"{name}: {type(value).__name__}: must be True or False") from None


def several(name, value, what):
    """A tuple of what is looped over once, or an error that names it."""
    try:
        if isinstance(value, (str, bytes, Mapping)):
            raise TypeError
        values = iter(value)
    except TypeError:
        raise InvalidArgument(f"{name}: {value!r}: must be a sequence of {what}") from None
    return tuple(values)


def _remake(kind, base, arguments, rest):
    """What a copy or a pickle is made with: the arguments of `base`'s __init__, and what is set besides."""
    thing = kind.__new__(kind)
    base.__init__(thing, **arguments)
    for name, value in rest.items():
        setattr(thing, name, value)
    return thing


def given(name: str, doc: str) -> property:
    """An attribute that tells what __init__ was given, and cannot be set."""
    return property(lambda self: self._given[name], doc=doc)


class Plain:
    """What its __init__ makes as a whole. Attributes take effect or raise; copies and pickles are made of `_given`."""

    __slots__ = ("_made", "_given", "__weakref__")  # the last line of __init__ sets _made
    _unmade: dict = {"_made": False}

    def __getattr__(self, name: str):
        if name in self._unmade:
            return self._unmade[name]
        if not self._made:
            raise AttributeError(f"{type(self).__name__}: it has no {name}: its __init__ has not run to its end")
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    def _arguments(self) -> dict:
        """What __init__ makes an equal thing of."""
        return dict(self._given)

    def _rest(self) -> dict:
        """What a copy has besides."""
        return dict(getattr(self, "__dict__", {}))

    def __reduce_ex__(self, _protocol):
        if not self._made:
            raise TypeError(f"{type(self).__name__}: its __init__ has not run to its end: make another one")
        base = next(k for k in type(self).__mro__ if k.__module__.startswith(__package__ + "."))
        return _remake, (type(self), base, self._arguments(), self._rest())

    def __repr__(self) -> str:
        if not self._made:
            return f"{type(self).__name__}: its __init__ has not run to its end"
        return f"{type(self).__name__}({', '.join(f'{k}={_brief(v)}' for k, v in self._told().items())})"

    def _told(self) -> dict:
        """What repr tells: the arguments that are not their defaults."""
        parameters = inspect.signature(type(self).__init__).parameters
        defaults = {name: p.default for name, p in parameters.items()}
        return {k: v for k, v in self._given.items() if isinstance(v, np.ndarray) or k not in defaults or
                not (defaults[k] is v or list(_flat((defaults[k],))) == list(_flat((v,))))}


def _flat(values):
    for value in values:
        if isinstance(value, (list, tuple)):
            yield from _flat(value)
        else:
            yield value


def _brief(value) -> str:
    if isinstance(value, np.ndarray) and value.size > 4:
        return f"<{' x '.join(map(str, value.shape))} {value.dtype}>"
    return repr(value.tolist() if isinstance(value, np.ndarray) else value)


def instance(name, value, kind):
    """The value, if it is of a class and was made as a whole; else an error that names it."""
    if not isinstance(value, kind):
        raise InvalidArgument(f"{name}: {type(value).__name__}: must be cgt.{kind.__name__}")
    if not value._made:
        raise InvalidArgument(f"{name}: {type(value).__name__}: its __init__ has not run to its end")
    return value


def struct_values(struct, definitions=ffi):
    """The fields of a struct as a dictionary: numbers, strings and lists."""
    values = {}
    for name, field in definitions.typeof(struct).fields:
        value = getattr(struct, name)
        if field.type.kind == "array":
            is_text = field.type.item.cname == "char"
            value = ffi.string(value).decode() if is_text else list(value)
        elif field.type.kind == "pointer":
            value = ffi.string(value).decode() if value and field.type.item.cname == "char" else None
        values[name] = value
    return values

# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Contexts: threads, memory, log."""
from __future__ import annotations

import logging
from typing import Optional, Tuple

from ._gate import nesting
from ._native import InvalidArgument, Plain, encoded, exception_of, ffi, keep_error, lib, switch, whole

_LEVELS = (logging.ERROR, logging.WARNING, logging.INFO)
_logger = logging.getLogger("cgt")


_errors: list = []  # of loggers: Ctrl-C, most likely


@ffi.callback("void(void *, cgt_log_level, const char *)", onerror=keep_error(_errors))
def _log(_user, level, message):
    with nesting:
        _logger.log(_LEVELS[min(level, 2)], "%s", ffi.string(message).decode(errors="replace"))


def check(handle, result: int) -> None:
    """Raises what a logger raised, or the exception of a cgt_result, with the message of this C handle's context."""
    if _errors:
        raise _errors.pop()
    if result:
        text = ffi.new("char[512]")
        lib.cgt_context_get_error_message(handle, text, 512)
        raise exception_of(result, ffi.string(text).decode(errors="replace"))


def version() -> str:
    """The version of the loaded library."""
    return ffi.string(lib.cgt_get_version()).decode()


def variants() -> Tuple[str, ...]:
    """The instruction sets that the library was built for, narrowest first."""
    names, found = lib.cgt_get_variant_names(), []
    while names[len(found)]:
        found.append(ffi.string(names[len(found)]).decode())
    return tuple(found)


def _release(handle, _log=_log) -> None:
    """Ends a context while there is still what it logs with."""
    lib.cgt_context_release(handle)


class Context(Plain):
    """Threads and memory; scenes may share one.

    Parameters
    ----------
    threads : int, optional
        That work, the caller's included; 0: one per CPU that the process may use.
    variant : str, optional
        A name of `variants`; None: the widest that this CPU runs.
    log : bool, optional
        Whether errors, warnings and a line for each commit go to the logger "cgt".

    Notes
    -----
    Without `close` or a ``with`` block it ends with the last reference.
    """

    __slots__ = ("_handle",)
    _unmade = {"_made": False, "_handle": None}

    def __init__(self, threads: int = 0, variant: Optional[str] = None, *, log: bool = False):
        made = ffi.new("cgt_context **")
        if not isinstance(variant, (str, type(None))):
            raise InvalidArgument(f"variant: {variant!r}: one of {', '.join(variants())}")
        name = ffi.NULL if variant is None else ffi.new("char[]", encoded("variant", variant))
        options = ffi.new("cgt_context_options *", {"threads": whole("threads", threads), "variant": name})
        if switch("log", log):
            options.log.write = _log
        result = lib.cgt_context_create(options, made)
        handle = ffi.gc(made[0], _release)  # it lives on in scenes, pictures and calls
        check(handle, result)
        self._handle = handle
        self._given = {"threads": threads, "variant": variant, "log": log}
        self._made = True

    @property
    def handle(self):
        """The C handle; an error once the context is closed."""
        if self._handle is None:
            raise InvalidArgument(f"context: it {'is closed' if self._made else 'has not run its __init__'}")
        return self._handle

    @property
    def threads(self) -> int:
        """How many threads work for it."""
        return lib.cgt_context_get_threads(self.handle)

    @property
    def variant(self) -> str:
        """The instruction set that it uses."""
        return ffi.string(lib.cgt_context_get_variant(self.handle)).decode()

    def check(self, result: int) -> None:
        """Raises the exception of a cgt_result, with the context's message."""
        check(self.handle, result)

    def close(self) -> None:
        """Releases it; scenes that are open keep what they need."""
        self._handle = None

    def __enter__(self) -> "Context":
        return self

    def __exit__(self, *_) -> None:
        self.close()

# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Pictures of what lies distributed over the ranks of an MPI job, by communicators of mpi4py.

    job = cgt.mpi.Job(MPI.COMM_WORLD)
    job.gather([(cgt.Spheres(x, 0.5), ids, cgt.Look("gold"))])       # what this rank has
    picture = job.draw(cgt.Picture(1280, 720), camera)               # at rank 0; None at the others

All ranks make these calls together, in the same order. Pictures have the bytes of one process that has everything, in
the order of the ids, for any number of ranks and any distribution.
"""
from __future__ import annotations

import contextlib
import ctypes
import sys
from typing import Any, Optional, Sequence

from mpi4py import MPI

from ._arrays import U4, numbers, pointer
from ._gate import Gate
from ._held import Held
from ._native import InvalidArgument, Plain, exception_of, instance, load_part, several, whole
from .geometry import Camera
from .picture import Look, Picture

ffi, lib = load_part("mpi")


class Job(Plain):
    """The ranks of a communicator, which draw together.

    Parameters
    ----------
    ranks : mpi4py.MPI.Intracomm
        Copied.
    threads : int, optional
        Of leaders, the lowest ranks of each machine; 0: as many as their ranks may use processors.
    ranks_per_leader : int, optional
        At most; 0: all ranks of a machine have one.
    exchange_bytes : int, optional
        Memory of a leader for what comes from other machines at a time; 0: 64 MB.

    Raises
    ------
    Error
        On all ranks the same, that of the lowest rank where something is wrong, which it names.

    Notes
    -----
    `close` it on all ranks before MPI ends, or leave its ``with`` block.
    """

    __slots__ = ("_handle", "_gate", "_keep", "_is_first")
    _unmade = {"_made": False, "_handle": None, "_gate": Gate("job")}

    def __init__(self, ranks: Any, *, threads: int = 0, ranks_per_leader: int = 0, exchange_bytes: int = 0):
        if self._handle is not None:
            raise InvalidArgument("job: its __init__ has run")
        if not isinstance(ranks, MPI.Intracomm):
            raise InvalidArgument(f"ranks: {type(ranks).__name__}: must be mpi4py.MPI.Intracomm")
        # a handle is a pointer or an int, which calls take alike
        handle = int.from_bytes(ctypes.string_at(MPI._addressof(ranks), MPI._sizeof(ranks)), sys.byteorder)
        try:
            options = ffi.new("cgt_mpi_options *", {
                "ranks_per_leader": whole("ranks_per_leader", ranks_per_leader),
                "exchange_bytes": whole("exchange_bytes", exchange_bytes),
                "context": {"threads": whole("threads", threads)}})
        except BaseException as error:
            ranks.allgather(f"rank {ranks.rank}: {error}")  # so that the other ranks do not wait
            raise
        wrong = next(filter(None, ranks.allgather("")), None)
        if wrong:
            raise InvalidArgument(wrong)
        made = ffi.new("cgt_mpi **")
        result = lib.cgt_mpi_create(handle, options, made)
        self._gate, self._keep, self._handle, self._is_first = Gate("job"), [], made[0], ranks.rank == 0
        try:
            self._check(result)
        except BaseException:
            lib.cgt_mpi_release(made[0])
            self._handle = None
            raise
        self._made = True

    def _arguments(self) -> dict:
        raise TypeError("Job: it is the ranks of a communicator: make another one")

    def __repr__(self) -> str:
        return f"Job({'closed' if self._handle is None else 'of ' + MPI.Get_processor_name()})"

    def _check(self, result: int) -> None:
        if result:
            text = ffi.new("char[512]")
            if self._handle != ffi.NULL:
                lib.cgt_mpi_get_error_message(self._handle, text, 512)
            raise exception_of(result, ffi.string(text).decode(errors="replace"))

    @property
    def _open(self) -> Any:
        if self._handle is None:
            raise InvalidArgument(f"job: it {'is closed' if self._made else 'has not run its __init__'}")
        return self._handle

    def gather(self, geometries: Sequence[Any]) -> None:
        """Gathers what all ranks have, and commits it on each machine.

        Parameters
        ----------
        geometries : sequence of geometries, or of tuples (geometry, ids, look)
            This rank's share of each, read now; of any of the three kinds, the same on all ranks. ids, (n,) uint32, are
            the numbers of its primitives in the whole; None: those of a rank follow those of the ranks before it. The
            look, or None, has arrays of this rank's primitives.
        """
        with self._gate.alone:
            handle = self._open
            try:
                parts, keep = self._parts(geometries)
            except BaseException:
                lib.cgt_mpi_gather(handle, ffi.NULL, 1)  # so that the other ranks do not wait
                raise
            self._keep = keep  # palettes are read by pictures
            self._check(lib.cgt_mpi_gather(handle, ffi.new("cgt_mpi_geometry[]", parts), len(parts)))

    @staticmethod
    def _parts(geometries: Sequence[Any]) -> tuple[list, list]:
        parts: list = []
        keep: list = []
        for given in several("geometries", geometries, "geometries"):
            geometry, ids, look = (*given, None, None)[:3] if isinstance(given, tuple) else (given, None, None)
            held, c = Held(geometry), ffi.new("cgt_look *")
            held.check()
            (Look() if look is None else instance("look", look, Look))._fill(c, held, keep)
            part = {held.kind: held.struct, "look": c}
            if ids is not None:
                keep.append(numbers("ids", ids, U4, (len(geometry),)).copy())
                part["ids"] = pointer(keep[-1])
            keep += [held, c]
            parts.append(part)
        return parts, keep

    def draw(self, picture: Picture, camera: Camera) -> Optional[Picture]:
        """Makes a picture of what was gathered: `picture` at rank 0, whose options and camera count; else None."""
        with self._gate.alone, contextlib.ExitStack() as stack:
            handle = self._open
            try:
                camera = instance("camera", camera, Camera)._copy()
                stack.enter_context(instance("picture", picture, Picture)._gate.alone)
                if any(picture._given["rows"]):
                    raise InvalidArgument("picture: rows: the ranks make all of them")
                image, read, keep = picture._image_of(None, None)
            except BaseException:
                lib.cgt_mpi_draw(handle, ffi.NULL, ffi.NULL, ffi.NULL)  # so that the other ranks do not wait
                raise
            self._check(lib.cgt_mpi_draw(handle, picture._options, camera._struct, image))
            del keep
            if self._is_first:
                picture._read = read
            return picture if self._is_first else None

    def close(self) -> None:
        """Ends it, on all ranks together."""
        with self._gate.alone:
            handle, self._handle = self._handle, None
            if handle is not None:
                lib.cgt_mpi_release(handle)

    def __enter__(self) -> "Job":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Who uses a scene, a picture or a file: calls of several threads, callbacks within calls, processes after a fork."""
from __future__ import annotations

import os
import threading
import weakref

from ._native import InUse

_CHANGED = "another call is changing it: neither callbacks nor other threads may use it meanwhile"
_USED = "a call is using it: neither callbacks nor other threads may change, commit or close it meanwhile"
_gates: "weakref.WeakSet[Gate]" = weakref.WeakSet()


class _Shared:
    """Of calls that may run at once. A call first counts itself, then looks; one that is alone does so the other way
    round: of two that meet, at least one sees the other. Appending and popping are atomic."""

    __slots__ = ("gate_name", "users", "lock", "lost")

    def __init__(self, name):
        self.gate_name, self.users, self.lock, self.lost = name, [], threading.Lock(), False

    def refuse_lost(self):
        if self.lost:
            raise InUse(f"{self.gate_name}: the process was forked while another thread was inside a call of it")

    def __enter__(self):
        self.users.append(None)
        if self.lock.locked() or self.lost:
            self.users.pop()
            self.refuse_lost()
            raise InUse(f"{self.gate_name}: {_CHANGED}")

    def __exit__(self, *_):
        self.users.pop()


class _Alone:
    """Of a call that no other one may meet. It does not wait: a callback would wait for the call around it."""

    __slots__ = ("shared",)

    def __init__(self, shared):
        self.shared = shared

    def __enter__(self):
        s = self.shared
        s.refuse_lost()
        if not s.lock.acquire(blocking=False):
            raise InUse(f"{s.gate_name}: {_CHANGED}")
        if s.users:
            s.lock.release()
            raise InUse(f"{s.gate_name}: {_USED}")

    def __exit__(self, *_):
        self.shared.lock.release()


class Gate:
    """Lets in calls that share a thing, or one that has it alone. Others are refused.

    Parameters
    ----------
    name : str
        For the messages.
    group : object
        Things that share locks of C's: those of one context.
    """

    def __init__(self, name: str, group=None):
        self.shared = _Shared(name)
        self.alone = _Alone(self.shared)
        self.group = id(self) if group is None else id(group)
        _gates.add(self)


def _after_fork() -> None:
    """In the child no thread is left that would end a call, or give back what it has locked."""
    gates = list(_gates)
    lost = {gate.group for gate in gates if gate.shared.users or gate.shared.lock.locked()}
    for gate in gates:
        gate.shared.lost = gate.shared.lost or gate.group in lost


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork)


class Nesting(threading.local):
    """How deep calls, callbacks in them and calls in those are on this thread, whose stack of C's is finite."""

    depth = 0

    def __enter__(self):
        self.depth += 1
        if self.depth > 8:
            self.depth -= 1
            raise RecursionError("visitor: callbacks of calls within callbacks are at most 8 deep")

    def __exit__(self, *_):
        self.depth -= 1


nesting = Nesting()

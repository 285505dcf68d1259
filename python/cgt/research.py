# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Structures, traversals and counters of published algorithms: research.h tells what each does.

Examples
--------
>>> import cgt, cgt.research
>>> scene = cgt.Scene(structure='kd', research=cgt.research.SceneOptions(kd_layout='breadth_first'))
>>> _ = scene.add(cgt.Spheres([[0, 0, 0], [2, 0, 0]], 0.5))
>>> scene.commit()
>>> cgt.research.scene_statistics(scene).kd_leaves >= 1
True
"""
from __future__ import annotations

from types import SimpleNamespace
from typing import Sequence

from ._native import Plain, enum_value, ffi, instance, lib, struct_values, three_whole, whole


class SceneOptions(Plain):
    """Options of `cgt.Scene`.

    Parameters
    ----------
    resolution : three ints, optional
        Cells of a grid along x, y, z; 0, 0, 0: chosen from the scene.
    kd_layout : {'auto', 'depth_first', 'breadth_first', 'mixed'}, optional
    kd_break_level : int, optional
        Of 'mixed': levels stored breadth first.
    """

    __slots__ = ("_struct",)

    def __init__(self, resolution: Sequence[int] = (0, 0, 0), kd_layout: str = "auto", kd_break_level: int = 0):
        self._struct = ffi.new("cgt_research_scene_options *")
        self._struct.resolution = three_whole("resolution", resolution)
        self._struct.kd_layout = enum_value("CGT_KD_LAYOUT_", kd_layout, "kd_layout")
        self._struct.kd_break_level = whole("kd_break_level", kd_break_level)
        self._given = {"resolution": tuple(self._struct.resolution), "kd_layout": kd_layout,
                       "kd_break_level": kd_break_level}
        self._made = True


class TraceOptions(Plain):
    """Options of a call that traces; it counts what the last call did.

    Parameters
    ----------
    packet : {0, 4, 8, 16}, optional
        Edge of a camera's packets in pixels.
    tile : {'auto', 'square', 'strip'}, optional
    loop : {'auto', 'nested', 'flattened'}, optional
    cull : {'auto', 'none', 'frustum', 'blocks'}, optional
    mailbox : {'auto', 'on', 'off'}, optional
    kd_traversal : {'auto', 'single', 'packet'}, optional
    triangle_test : {'auto', 'watertight', 'moller_trumbore', 'accelerated'}, optional
        Others than 'auto' with precision 'fast' alone.
    """

    __slots__ = ("_native",)

    def __init__(self, packet: int = 0, tile: str = "auto", loop: str = "auto", cull: str = "auto",
                 mailbox: str = "auto", kd_traversal: str = "auto", triangle_test: str = "auto"):
        counts, s = ffi.new("cgt_research_trace_statistics *"), ffi.new("cgt_research_trace_options *")
        s.packet, s.statistics = whole("packet", packet), counts
        s.tile = enum_value("CGT_TILE_SHAPE_", tile, "tile")
        s.loop = enum_value("CGT_LOOP_", loop, "loop")
        s.cull = enum_value("CGT_CULL_", cull, "cull")
        s.mailbox = enum_value("CGT_MAILBOX_", mailbox, "mailbox")
        s.kd_traversal = enum_value("CGT_KD_TRAVERSAL_", kd_traversal, "kd_traversal")
        s.triangle_test = enum_value("CGT_TRIANGLE_TEST_", triangle_test, "triangle_test")
        self._given = {"packet": packet, "tile": tile, "loop": loop, "cull": cull, "mailbox": mailbox,
                       "kd_traversal": kd_traversal, "triangle_test": triangle_test}
        self._native = s, counts  # which calls keep as a pair
        self._made = True

    @property
    def statistics(self) -> SimpleNamespace:
        """What the last call with these options did (cgt_research_trace_statistics)."""
        return SimpleNamespace(**struct_values(self._native[1][0]))


def scene_statistics(scene) -> SimpleNamespace:
    """What `Scene.statistics` does not tell of the last commit (cgt_research_scene_statistics)."""
    from .scene import Scene

    s = ffi.new("cgt_research_scene_statistics *")
    instance("scene", scene, Scene)
    with scene._gate.shared:
        scene._check(lib.cgt_research_get_scene_statistics(scene.handle, s))
    return SimpleNamespace(**struct_values(s[0]))

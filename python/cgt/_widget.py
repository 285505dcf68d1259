# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""A figure in a notebook that turns under the mouse, by anywidget: the kernel draws, the page shows."""
from __future__ import annotations

import math
from typing import Any

import anywidget
import numpy as np

from .geometry import Camera
from .picture import encode_png

# One message is under way at a time: what the mouse does meanwhile is added up.
_PAGE = """
function render({ model, el }) {
  const image = document.createElement("img");
  let url = null, waits = true, held = null, told = null;
  image.draggable = false;
  image.style.cursor = "grab";
  image.style.touchAction = "none";
  image.title = "drag: turn; wheel: nearer or farther; double click: show all";
  const tell = ({ x = 0, y = 0, zoom = 1, fit = false, rest = true }) => {
    const before = told ?? { x: 0, y: 0, zoom: 1, fit: false };
    told = { x: before.x + x, y: before.y + y, zoom: before.zoom * zoom, fit: before.fit || fit, rest };
    if (waits) return;
    waits = true;
    model.send(told);
    told = null;
  };
  const hear = (message, buffers) => {
    const next = URL.createObjectURL(new Blob([buffers[0]], { type: "image/png" }));
    image.src = next;
    image.width = message.width;
    if (url) URL.revokeObjectURL(url);
    url = next;
    waits = false;
    if (told) tell({ rest: told.rest });
  };
  model.on("msg:custom", hear);
  image.addEventListener("pointerdown", (e) => {
    held = [e.clientX, e.clientY];
    image.setPointerCapture(e.pointerId);
  });
  image.addEventListener("pointermove", (e) => {
    if (!held) return;
    tell({ x: e.clientX - held[0], y: e.clientY - held[1], rest: false });
    held = [e.clientX, e.clientY];
  });
  image.addEventListener("pointerup", () => {
    held = null;
    tell({});
  });
  image.addEventListener("wheel", (e) => {
    e.preventDefault();
    tell({ zoom: Math.exp(e.deltaY / 500) });
  });
  image.addEventListener("dblclick", () => tell({ fit: true }));
  el.appendChild(image);
  model.send({ x: 0, y: 0, zoom: 1, fit: false, rest: true });
  return () => {
    model.off("msg:custom", hear);
    if (url) URL.revokeObjectURL(url);
  };
}
export default { render };
"""


class Turned(anywidget.AnyWidget):
    """The shown frame of a figure, whose camera the mouse moves."""

    _esm = _PAGE

    def __init__(self, figure):
        super().__init__()
        self._figure = figure
        self.on_msg(self._hear)

    def _hear(self, _widget: Any, told: dict, _buffers: Any) -> None:
        figure = self._figure
        if told["fit"]:
            figure.fit()
        if (told["x"], told["y"], told["zoom"]) != (0, 0, 1):
            figure.camera = turn(figure.camera, told["x"], told["y"], told["zoom"])
        pixels = figure.pixels if told["rest"] else figure._draw_quick(2)
        self.send({"width": figure.size[0]}, buffers=[encode_png(pixels)])


def turn(camera: Camera, x: float, y: float, zoom: float) -> Camera:
    """A camera that goes around its target by pixels of a mouse, and so many times as far off."""
    up = camera.up / np.linalg.norm(camera.up)
    camera.orbit(-0.4 * x)
    arm = camera.eye - camera.target
    length = np.linalg.norm(arm)
    height = math.asin(np.clip(arm @ up / length, -1, 1))
    flat = arm - (arm @ up) * up
    flat /= max(float(np.linalg.norm(flat)), 1e-30)
    height = float(np.clip(height + 0.007 * y, -1.5, 1.5))  # never along the axis that points up
    zoom = float(np.clip(zoom, 0.1, 10))
    length *= zoom
    if camera.projection == "orthographic":
        camera.height *= zoom
    camera.eye = camera.target + length * (math.cos(height) * flat + math.sin(height) * up)
    return camera

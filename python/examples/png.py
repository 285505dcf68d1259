# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""What the examples share: a picture of linear colours as a PNG file, and the folder that they write to."""
from __future__ import annotations

import os
import sys
from typing import Any

import numpy as np

from cgt.picture import encode_png


def write(name: str, linear: np.ndarray[Any, Any]) -> None:
    """Writes linear light, 0 to 1, (height, width) or (height, width, 3), to the folder of the first argument."""
    rgb = np.broadcast_to(linear if linear.ndim == 3 else linear[..., None], linear.shape[:2] + (3,))
    with open(os.path.join(sys.argv[1] if len(sys.argv) > 1 else ".", name), "wb") as file:
        file.write(encode_png((np.clip(rgb, 0, 1) ** (1 / 2.2) * 255 + 0.5).astype("u1")))

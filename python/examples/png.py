# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""What the examples share: a picture of linear colours as a PNG file, and the folder that they write to."""
import os
import struct
import sys
import zlib

import numpy as np


def write(name, linear):
    """Writes linear light, 0 to 1, (height, width) or (height, width, 3), to the folder of the first argument."""
    rgb = np.broadcast_to(linear if linear.ndim == 3 else linear[..., None], linear.shape[:2] + (3,))
    encoded = (np.clip(rgb, 0, 1) ** (1 / 2.2) * 255 + 0.5).astype("u1")
    height, width = encoded.shape[:2]
    rows = np.zeros((height, 1 + 3 * width), "u1")
    rows[:, 1:] = encoded.reshape(height, -1)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    folder = sys.argv[1] if len(sys.argv) > 1 else "."
    with open(os.path.join(folder, name), "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)))
        file.write(chunk(b"IDAT", zlib.compress(rows.tobytes())) + chunk(b"IEND", b""))

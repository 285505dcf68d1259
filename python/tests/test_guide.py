# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""The code of docs/guide/python.md runs as it stands, block after block, with the data that it takes for granted."""
import functools
import gzip
import os
import re
import shutil
from types import SimpleNamespace

import numpy as np
import pytest

try:
    import cgt.figure
    import cgt.trajectory
except ImportError as error:
    pytest.skip(str(error), allow_module_level=True)

ROOT = os.path.join(os.path.dirname(__file__), "..", "..")
DUMP = """ITEM: TIMESTEP
{0}
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp ff
0 10
0 20
-5 5
ITEM: ATOMS id type x y z c_pe
1 1 1 2 3 -1.5
2 2 4 5 1 {0}
"""


def test_the_code_of_the_guide_runs(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    shutil.copy(os.path.join(ROOT, "examples", "data", "caffeine.xyz"), tmp_path)
    with gzip.open(tmp_path / "run.lammpstrj.gz", "wt") as file:
        file.write("".join(DUMP.format(k) for k in range(3)))
    r = np.random.default_rng(1)
    positions, corners = r.uniform(-1, 1, (1000, 3)), np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    shown = []
    monkeypatch.setattr(cgt, "show", functools.partial(cgt.show, size=(96, 54)), raising=False)
    names = {
        "positions": positions, "radii": 0.1, "colors": r.uniform(size=(1000, 3)), "velocities": positions,
        "pairs": [[0, 1], [1, 2]], "window": SimpleNamespace(show=lambda pixels: shown.append(pixels.copy())),
        "mesh": SimpleNamespace(vertices=corners, faces=[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]),
        "origins": [[0.1, 0.1, 5]], "directions": [[0, 0, -1]],
    }
    with open(os.path.join(ROOT, "docs", "guide", "python.md"), encoding="utf-8") as file:
        blocks = re.findall(r"```python\n(.*?)```", file.read(), re.DOTALL)
    assert len(blocks) >= 6
    for block in blocks:
        for long, short in (("range(100)", "range(2)"), ("100_000", "1000"), ("1280, 720", "128, 72"), ("640, 480", "64, 48")):
            block = block.replace(long, short)
        try:
            exec(compile(block, "docs/guide/python.md", "exec"), names)
        except cgt.ReadError as error:
            assert "lammpstrj.gz" in str(error) and "libarchive" in str(error)  # a build without it
    assert (tmp_path / "caffeine.png").stat().st_size > 1000 and (tmp_path / "first.png").stat().st_size > 1000
    assert names["pixels"].shape == (48, 64, 3) and names["pixels"].std() > 5
    assert len(shown) == 15 and not np.array_equal(shown[0], shown[-1])
    assert names["index_ray"].tolist() == [0, 0] and capsys.readouterr().out.count("(2, 3)") in (0, 3)

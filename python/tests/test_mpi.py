# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Pictures by the ranks of an MPI job have the bytes of one process; what is wrong at one rank is told at all."""
import os
import re
import shutil
import subprocess
import sys

import pytest

pytest.importorskip("mpi4py", reason="no mpi4py (Debian: apt-get install python3-mpi4py openmpi-bin)")
try:
    import cgt.mpi  # noqa: F401
except ImportError as missing:
    pytest.skip(str(missing), allow_module_level=True)

WORLD = """
import sys
import numpy as np
from mpi4py import MPI
import cgt
import cgt.mpi

rng = np.random.default_rng(1)
x, r = rng.uniform(-1, 1, (900, 3)), rng.uniform(0.02, 0.1, 900)
colors = rng.uniform(0, 1, (900, 3))
bonds, camera = rng.integers(0, 900, (50, 2)), cgt.Camera((1, 2, 4))
options = dict(width=96, height=72, ambient=4, background="navy", linear=True)
world = MPI.COMM_WORLD


def print(*words):
    "In one piece: other ranks write, too."
    sys.stdout.write(" ".join(map(str, words)) + "\\n")
    sys.stdout.flush()


def share(ranks):
    "What a rank has of the spheres and the bonds, dealt out."
    ids, sticks = np.arange(900)[ranks.rank::ranks.size], np.arange(50)[ranks.rank::ranks.size]
    balls = cgt.Spheres(x[ids], r[ids]), ids, cgt.Look(colors=colors[ids])
    return [balls, (cgt.Capsules(x[bonds[sticks]].reshape(-1, 3), 0.01), sticks, cgt.Look("gold"))]


def drawn(ranks):
    with cgt.mpi.Job(ranks, threads=1) as job:
        job.gather(share(ranks))
        return job.draw(cgt.Picture(**options), camera)
"""


def run(ranks, code):
    """Runs a program on so many ranks; what it prints."""
    if not shutil.which("mpirun"):
        pytest.skip("no mpirun (Debian: apt-get install openmpi-bin)")
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    child = subprocess.run(["mpirun", "--oversubscribe", "-n", str(ranks), sys.executable, "-c", WORLD + code],
                           capture_output=True, text=True, timeout=120, check=False, env=environment)
    assert child.returncode == 0, child.stdout + child.stderr
    return child.stdout


def test_pictures_have_the_bytes_of_one_process():
    told = run(3, """
picture = drawn(world)
assert (picture is None) == (world.rank > 0)
half = drawn(world.Split(world.rank == 1, -world.rank))  # other communicators, in another order
if world.rank == 0:
    scene = cgt.Scene()
    scene.add(cgt.Spheres(x, r))
    scene.add(cgt.Capsules(x, 0.01, bonds))
    scene.commit()
    one = cgt.Picture(**options).draw(scene, camera, {0: cgt.Look(colors=colors), 1: cgt.Look("gold")})
    assert picture.pixels.tobytes() == one.pixels.tobytes() and picture.linear.tobytes() == one.linear.tobytes()
    assert half is None and one.pixels.std() > 10
    print("the same")
elif world.rank == 2:
    assert half is not None
""")
    assert told.count("the same") == 1


def test_mistakes_are_told_at_all_ranks():
    told = run(3, """
for wrong in (lambda: (cgt.Spheres(x, r), np.zeros(900)), lambda: (cgt.Spheres(x, r), np.full(900, 2**31))):
    job = cgt.mpi.Job(world, threads=1)
    part = wrong() if world.rank == 1 else (cgt.Spheres(x[:0], 1.0), np.arange(0))
    try:
        job.gather([part])
    except cgt.InvalidArgument as error:
        print("told:", error)
    job.close()
    try:
        job.draw(cgt.Picture(8, 6), camera)
    except cgt.InvalidArgument as error:
        assert "closed" in str(error)
try:
    cgt.mpi.Job(5)
except cgt.InvalidArgument as error:
    print("told:", error)
""")
    assert told.count("told:") == 9, told


def test_mistakes_at_one_rank_leave_none_waiting():
    told = run(3, """
job = cgt.mpi.Job(world, threads=1)
job.gather(share(world))
for wrong in range(3):
    for picture, place in ((None, camera), (cgt.Picture(8, 6), None), (cgt.Picture(8, 6, rows=(0, 2)), camera)):
        good = cgt.Picture(8, 6), camera
        try:
            job.draw(*((picture, place) if world.rank == wrong else good))
        except cgt.InvalidArgument as error:
            print("told:", "own" if world.rank == wrong else "of another", error)
job.close()
for wrong in range(3):
    try:
        cgt.mpi.Job(world, threads=-1 if world.rank == wrong else 1)
    except cgt.InvalidArgument as error:
        assert world.rank == wrong or str(error).startswith(f"rank {wrong}: threads: -1"), error
        print("not made")
""")
    assert told.count("told: own") == 9 and told.count("not made") == 9, told
    assert told.count("told: of another") >= 6, told  # rank 0 makes no picture then


def test_the_code_of_the_guide_runs():
    guide = os.path.join(os.path.dirname(__file__), "..", "..", "docs", "guide", "python.md")
    with open(guide, encoding="utf-8") as file:
        block, = re.findall(r"```py\n(.*?)```", file.read(), re.DOTALL)
    told = run(2, "ids = np.arange(450) + 450 * world.rank\nx = x[ids]\n" + block.replace("1280, 720", "64, 36") + """
job.close()
print("none" if picture is None else picture.pixels.shape)
""")
    assert told.count("(36, 64, 3)") == told.count("none") == 1

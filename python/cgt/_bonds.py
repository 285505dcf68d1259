# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Bonds as capsules, through periodic boundaries, too."""
from __future__ import annotations

from typing import Optional, Sequence, Tuple

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import F8, I8, array_of, flags, numbers
from ._native import InvalidArgument


def _faces(rows: np.ndarray) -> np.ndarray:
    """Sums of a lattice's edges, halfway to which the faces of its cell lie: what none of them shortens is the least.

    The edges are reduced as Selling does (Conway and Sloane, Low-Dimensional Lattices VI, 1992) until no two of them
    and their negative sum meet at less than a right angle.
    """
    edges, count = [*rows, -rows.sum(axis=0)], len(rows)
    for _ in range(1000 if count > 1 else 0):  # it ends by itself in exact arithmetic
        acute = [(i, j) for i in range(count) for j in range(i + 1, count + 1) if edges[i] @ edges[j] > 1e-12 * (
            edges[i] @ edges[i] + edges[j] @ edges[j])]
        if not acute:
            break
        i, j = acute[0]
        if count == 2:
            edges[3 - i - j], edges[j] = edges[j] - edges[i], -edges[j]
        else:
            edges = [e if k in (i, j) else e + edges[i] for k, e in enumerate(edges)]
            edges[i] = -edges[i]
    some = np.arange(1, 1 << count)[:, None] >> np.arange(count) & 1
    return some @ np.array(edges)[:count]


def _nearest(step: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """The least of each step and its images by periodic edges; half of an edge is no crossing."""
    if not len(rows):
        return step
    sums, step = _faces(rows), step.copy()
    with np.errstate(over="ignore"):  # shorter ones reach no face
        longer = np.flatnonzero((step * step).sum(axis=1) > (sums * sums).sum(axis=1).min() / 4)
    for _ in range(1000):  # each turn leaves over what it made shorter
        now = step[longer]
        moved = np.zeros(len(now), bool)
        for face in sums:
            with np.errstate(all="ignore"):
                share = now @ face / (face @ face)
            crosses = (np.abs(share) > 0.5 + 1e-6) & np.isfinite(share)
            now[crosses] -= np.rint(share[crosses])[:, None] * face
            moved |= crosses
        step[longer], longer = now, longer[moved]
        if not len(longer):
            break
    return step


def half_bonds(positions: ArrayLike, bonds: ArrayLike, edges: Optional[ArrayLike] = None,
               periodic: Sequence[int] = (1, 1, 1)) -> Tuple[np.ndarray, np.ndarray]:
    """Both halves of each bond, from its atoms to its middle, so that one that leaves a box goes on at the other side.

    Parameters
    ----------
    positions : (n, 3) float
    bonds : (m, 2) int
        Below n.
    edges : (3, 3) float, optional
        Edges of the box as rows, tilted or not; None: bonds go as the positions say.
    periodic : three ints, optional
        Along each edge; 0: it is not, and needs no length. A bond goes to the atom's nearest image, however tilted the
        box is.

    Returns
    -------
    vertices : (4 m, 3) float64
        Ends of 2 m capsules for `cgt.Capsules`: all first halves, then all second ones.
    atoms : (2 m,) int64
        The atom that each half begins at, for its colour.

    Examples
    --------
    >>> import cgt, numpy
    >>> vertices, atoms = cgt.half_bonds([[0.5, 1, 1], [9.5, 1, 1]], [[0, 1]], 10 * numpy.eye(3))
    >>> vertices[:, 0].tolist(), atoms.tolist()
    ([0.5, 0.0, 9.5, 10.0], [0, 1])
    """
    x, pairs = numbers("positions", positions, F8, ("n", 3)), array_of("bonds", bonds)
    pairs = numbers("bonds", pairs if pairs.size else np.empty((0, 2), I8), I8, ("m", 2))
    if len(pairs) and (pairs.min() < 0 or pairs.max() >= len(x)):
        raise InvalidArgument(f"bonds: {pairs.min()} to {pairs.max()}, of {len(x)} positions")
    step = x[pairs[:, 1]] - x[pairs[:, 0]]
    if edges is not None:
        # along the periodic edges alone: the others need no length
        rows = numbers("edges", edges, F8, (3, 3))[flags("periodic", periodic) != 0]
        if not np.isfinite(rows).all() or (len(rows) and np.linalg.matrix_rank(rows) < len(rows)):
            raise InvalidArgument(f"edges: {rows.tolist()}: must be the periodic edges of a box")
        step = _nearest(step, rows)
    begin = x[np.concatenate([pairs[:, 0], pairs[:, 1]])]
    end = begin + np.concatenate([step, -step]) / 2
    return np.stack([begin, end], axis=1).reshape(-1, 3), np.concatenate([pairs[:, 0], pairs[:, 1]])

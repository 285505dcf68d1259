# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Bonds as capsules, through periodic boundaries, too."""
from __future__ import annotations

from typing import Optional, Sequence, Tuple

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import F8, I8, array_of, check_shape, numbers
from ._native import InvalidArgument


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
        Along each edge; 0: it is not, and needs no length. A bond longer than half of a periodic edge goes to
        the atom's nearest image.

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
        flags = array_of("periodic", periodic)
        check_shape("periodic", flags, (3,))
        # along the periodic edges alone: the others need no length
        rows = numbers("edges", edges, F8, (3, 3))[flags != 0]
        if len(rows) and np.linalg.matrix_rank(rows) < len(rows):
            raise InvalidArgument(f"edges: {rows.tolist()}: must be the periodic edges of a box")
        share = step @ np.linalg.pinv(rows)
        step = step - np.where(np.abs(share) > 0.5 + 1e-6, np.rint(share), 0) @ rows  # half of an edge is no crossing
    begin = x[np.concatenate([pairs[:, 0], pairs[:, 1]])]
    end = begin + np.concatenate([step, -step]) / 2
    return np.stack([begin, end], axis=1).reshape(-1, 3), np.concatenate([pairs[:, 0], pairs[:, 1]])

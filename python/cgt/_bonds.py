# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Bonds as capsules, through periodic boundaries, too."""
from typing import Optional, Sequence, Tuple

import numpy as np
from numpy.typing import ArrayLike

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
        Along each edge; 0: it is not. A bond longer than half of a periodic edge goes to the atom's nearest image.

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
    x, given = np.asarray(positions, np.float64), np.asarray(bonds)
    if x.ndim != 2 or x.shape[1] != 3:
        raise InvalidArgument(f"positions: shape {x.shape}: must be (n, 3)")
    if given.size and (given.ndim != 2 or given.shape[1] != 2 or given.dtype.kind not in "iu"):
        raise InvalidArgument(f"bonds: shape {given.shape}, dtype {given.dtype}: must be (m, 2) whole numbers")
    pairs = given.reshape(-1, 2).astype(np.int64)
    if len(pairs) and (pairs.min() < 0 or pairs.max() >= len(x)):
        raise InvalidArgument(f"bonds: {pairs.min()} to {pairs.max()}, of {len(x)} positions")
    step = x[pairs[:, 1]] - x[pairs[:, 0]]
    if edges is not None:
        rows = np.asarray(edges, np.float64)
        if rows.shape != (3, 3) or not np.linalg.det(rows):
            raise InvalidArgument(f"edges: {rows.tolist()}: must be three edges of a box")
        share = np.where(periodic, step @ np.linalg.inv(rows), 0)
        step = step - np.where(np.abs(share) > 0.5 + 1e-6, np.rint(share), 0) @ rows  # half of an edge is no crossing
    begin = x[np.concatenate([pairs[:, 0], pairs[:, 1]])]
    end = begin + np.concatenate([step, -step]) / 2
    return np.stack([begin, end], axis=1).reshape(-1, 3), np.concatenate([pairs[:, 0], pairs[:, 1]])

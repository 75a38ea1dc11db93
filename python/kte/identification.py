"""Identification of inertial parameters from measured forces."""
from __future__ import annotations

from typing import List, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ._results import Array
from .errors import BadArgument

__all__ = ["BaseParameters", "base_parameters"]


class BaseParameters(NamedTuple):
    """Combinations of inertial parameters that forces depend on: pi_b = combinations pi, Y pi = Y[:, columns] pi_b."""

    columns: List[int]
    combinations: Array


def base_parameters(regressors: ArrayLike, tolerance: float = 1e-9) -> BaseParameters:
    """The base parameters of regressors Y, (..., n, parameters), of many random states: the columns that do not depend on
    those before them (Gautier, J. Robotic Systems 8, 1991), by QR factorization, and how the others add to them.

        y = kte.torque_regressor(robot, q, v, a)      # of 100 random states
        base = kte.base_parameters(y)
        base.combinations @ kte.inertial_parameters(robot)

    A column counts as dependent if what is left of it is below `tolerance` times its size.
    """
    y = np.asarray(regressors, dtype=float)
    if y.ndim < 2:
        raise BadArgument(f"kte: regressors has shape {y.shape}, expected (..., n, parameters)")
    y = y.reshape(-1, y.shape[-1])
    if not np.isfinite(y).all():
        raise BadArgument("kte: regressors have a number that is not finite")
    sizes = np.linalg.norm(y, axis=0)
    if len(y) < y.shape[1]:
        raise BadArgument(f"kte: {len(y)} rows of regressors are too few for {y.shape[1]} parameters")
    columns: List[int] = []
    q = np.zeros((len(y), 0))
    for k in range(y.shape[1]):
        left = y[:, k]
        for _ in range(2):  # the second time removes rounding errors of the first
            left = left - q @ (q.T @ left)
        if np.linalg.norm(left) > tolerance * sizes[k] and sizes[k] > 0:
            columns.append(k)
            q = np.column_stack([q, left / np.linalg.norm(left)])
    r = q.T @ y
    combinations = np.linalg.solve(r[:, columns], r)
    combinations[np.abs(combinations) < tolerance] = 0
    return BaseParameters(columns, combinations)

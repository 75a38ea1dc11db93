"""Linear systems and feedback (docs/control.md)."""
from __future__ import annotations

from typing import Any, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from ._kte import Chain, Robot, _discretize, _lqr, difference
from ._results import Array, DiscreteLinearSystem, Feedback, LinearSystem
from .errors import BadArgument

__all__ = ["discretize", "displacement", "lqr"]


def discretize(system: LinearSystem, dt: float) -> DiscreteLinearSystem:
    """The system from one sample to the next, with constant inputs for dt, s, exact by the matrix exponential."""
    if not isinstance(system, LinearSystem):
        raise TypeError(f"kte: system must be a LinearSystem, as linearize returns, not {system!r}")
    a, b, step = _discretize(system.A, system.B, system.x_dot, dt)
    return DiscreteLinearSystem(a, b, step, dt, system.inputs)


def lqr(
    system: Union[LinearSystem, DiscreteLinearSystem, Tuple[ArrayLike, ArrayLike]],
    Q: ArrayLike,
    R: ArrayLike,
    N: Optional[ArrayLike] = None,
) -> Feedback:
    """The feedback u = u0 - K d with the least integral of d' Q d + 2 d' N u + u' R u, or the least sum for a
    `DiscreteLinearSystem`. The system may also be a pair (A, B). Q, R: matrices, or their diagonals.

    Raises NoSolution where the inputs do not reach a mode that does not decay, and says which.
    """

    def matrix(name: str, x: ArrayLike) -> Array:
        a = np.asarray(x, dtype=float)
        if a.ndim > 2:
            raise BadArgument(f"kte: {name} has shape {a.shape}, expected a matrix or its diagonal")
        return a if a.ndim == 2 else np.diag(np.atleast_1d(a))

    if not isinstance(system, tuple) or len(system) < 2:
        raise TypeError(f"kte: system must be a linear system or a pair (A, B), not {system!r}")
    a, b = np.asarray(system[0], dtype=float), np.asarray(system[1], dtype=float)
    n = np.zeros((0, 0)) if N is None else np.asarray(N, dtype=float)
    return Feedback(*_lqr(a, b, matrix("Q", Q), matrix("R", R), n, isinstance(system, DiscreteLinearSystem)))


def displacement(
    chain: Union[Chain, Robot], q0: ArrayLike, v0: ArrayLike, q: ArrayLike, v: ArrayLike
) -> Array:
    """The d of `linearize` from the state (q0, v0) to (q, v), without internal states; of several too, (..., n)."""
    at_rest: Any = difference(chain, q0, q)
    rates = np.asarray(v, dtype=float) - np.asarray(v0, dtype=float)
    shape = np.broadcast_shapes(np.shape(at_rest), rates.shape)
    return np.concatenate([np.broadcast_to(at_rest, shape), np.broadcast_to(rates, shape)], axis=-1)

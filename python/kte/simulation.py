"""Simulations in one call, and events."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Iterable, Mapping, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from ._kte import Chain, Recording, Robot, Simulation, _rollout_in_lanes
from ._results import Array, Rollout
from .errors import BadArgument

# Functions return Any, since components of arrays are such: mypy --strict refuses them where a type is declared.
#: A number or array over time, of (t, q, v).
Law = Callable[[float, Array, Array], Any]
#: Whether a contact lands, a bool, of (t, q, v).
Gate = Callable[[float, Array, Array], Any]


@dataclass(frozen=True)
class Event:
    """A zero crossing of a function of (t, q, v).

    function   changes its sign at the event
    direction  "rising", "falling" or "both", as time increases
    terminal   whether the simulation ends there
    reset      a function of (t, q, v) that returns the new (q, v)
    name       in the list of events
    one_sided  the reset must send the function back to the side it came from
    """

    function: Callable[[float, Array, Array], Any]  # a number
    direction: str = "both"
    terminal: bool = False
    reset: Optional[Callable[[float, Array, Array], Tuple[ArrayLike, ArrayLike]]] = None
    name: str = ""
    one_sided: bool = False


def simulate(
    chain: Union[Chain, Robot],
    q: ArrayLike,
    v: Optional[ArrayLike] = None,
    *,
    time: float,
    every: Optional[float] = 0.01,
    at: Optional[ArrayLike] = None,
    control: Union[None, ArrayLike, Law] = None,
    control_every: Optional[float] = None,
    inputs: Optional[Mapping[str, Union[ArrayLike, Law]]] = None,
    events: Union[None, Event, Iterable[Event]] = None,
    only_if: Optional[Mapping[str, Gate]] = None,
    t: float = 0.0,
    solver: str = "dormand_prince45",
    tolerance: float = 1e-9,
    absolute: Optional[float] = None,
    relative: Optional[float] = None,
    step: float = 1e-3,
    max_steps: int = 1_000_000_000,
    largest_step: float = 0.0,
    implicit_control: bool = False,
) -> Recording:
    """Simulates a mechanism from q and v for a time, s, backward if it is negative, and returns a `Recording`.

    Rows are `every` s apart, at the times `at`, or at every step if both are None. Other arguments are those of
    `Simulation`.
    """
    if time != 0 and t + time == t:
        raise BadArgument(f"kte: a time of {time} s is lost in the rounding of t = {t} s")
    simulation = Simulation(
        chain,
        q,
        v,
        t=t,
        solver=solver,
        tolerance=tolerance,
        absolute=absolute,
        relative=relative,
        step=step,
        max_steps=max_steps,
        largest_step=largest_step,
        control=control,
        control_every=control_every,
        inputs=inputs,
        events=events,
        only_if=only_if,
        implicit_control=implicit_control,
    )
    return simulation.advance(t + time, every=None if at is not None else every, at=at)


def rollout(
    chain: Union[Chain, Robot],
    q: ArrayLike,
    v: ArrayLike,
    tau: ArrayLike,
    every: float,
    *,
    step: Optional[float] = None,
    threads: Optional[int] = None,
) -> Rollout:
    """Many motions under given forces, for controllers that try them: tau, (n, T, nv), are constant for `every` s each.
    q and v are one start, or n of them; inputs are 0. Returns a `Rollout` with T + 1 rows of each motion.

    Motions are by runge_kutta4 with steps of at most `step` s, by default `every`. Those of chains whose state consists
    of numbers q and v are computed side by side in packs and threads; others, as of free bodies and with contacts, one
    after the other.
    """
    mechanism = chain.chain if isinstance(chain, Robot) else chain
    nq, nv = mechanism.nq, mechanism.nv
    forces = np.ascontiguousarray(tau, dtype=float)
    if forces.ndim != 3 or forces.shape[2] != nv:
        raise BadArgument(f"kte: tau has shape {forces.shape}, expected (n, T, {nv})")
    if not every > 0 or not np.isfinite(every):
        raise BadArgument(f"kte: every must be finite and positive, got {every}")
    if step is not None and not step > 0:
        raise BadArgument(f"kte: step must be positive, got {step}")
    count, rows = forces.shape[:2]
    starts = []
    for name, x, n in (("q", q, nq), ("v", v, nv)):
        a = np.asarray(x, dtype=float)
        if a.shape not in ((n,), (count, n)):
            raise BadArgument(f"kte: {name} has shape {a.shape}, expected ({n},) or ({count}, {n})")
        starts.append(np.ascontiguousarray(np.broadcast_to(a, (count, n))))
    for name, a in (("q", starts[0]), ("v", starts[1]), ("tau", forces)):
        if not np.isfinite(a).all():
            raise BadArgument(f"kte: {name} has a number that is not finite")
    length = min(step or every, every)
    t = every * np.arange(rows + 1)
    found = _rollout_in_lanes(chain, starts[0], starts[1], forces, every, length, threads)
    if found is not None:
        return Rollout(t, *found)
    all_q, all_v = np.empty((count, rows + 1, nq)), np.empty((count, rows + 1, nv))
    for i in range(count):
        simulation = Simulation(chain, starts[0][i], starts[1][i], solver="runge_kutta4", step=length, control=np.zeros(nv))
        all_q[i, 0], all_v[i, 0] = simulation.q, simulation.v
        for k in range(rows):
            simulation.set_control(forces[i, k])
            simulation.advance(t[k + 1], every=None, at=[t[k + 1]])
            all_q[i, k + 1], all_v[i, k + 1] = simulation.q, simulation.v
    return Rollout(t, all_q, all_v)

"""Simulations in one call, and events."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Dict, Iterable, Optional, Tuple, Union

from numpy.typing import ArrayLike

from ._kte import Chain, Recording, Robot, Simulation
from ._results import Array

#: A number or array over time, of (t, q, v).
Law = Callable[[float, Array, Array], ArrayLike]


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

    function: Callable[[float, Array, Array], float]
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
    inputs: Optional[Dict[str, Union[ArrayLike, Law]]] = None,
    events: Union[None, Event, Iterable[Event]] = None,
    solver: str = "dormand_prince45",
    **options: Any,
) -> Recording:
    """Simulates a mechanism from q and v for a time, s, and returns a `Recording`.

    Rows are `every` so many s, at the times `at`, or at every step if both are None. Other arguments are those of
    `Simulation`.
    """
    simulation = Simulation(chain, q, v, control=control, inputs=inputs, events=events, solver=solver, **options)
    end = simulation.t + time
    return simulation.advance(end, every=None if at is not None else every, at=at)

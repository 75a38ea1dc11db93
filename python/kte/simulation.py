"""Simulations in one call, and events."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Iterable, Mapping, Optional, Tuple, Union

from numpy.typing import ArrayLike

from ._kte import Chain, Recording, Robot, Simulation
from ._results import Array
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

    Rows are `every` so many s, at the times `at`, or at every step if both are None. Other arguments are those of
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

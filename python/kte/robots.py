"""Pickles of robots."""
from __future__ import annotations

import warnings
from typing import Any, Dict, List, Tuple

from . import _kte
from ._kte import Chain, Robot
from .errors import RobotWarning


def _remade(function: str, argument: Any, options: Dict[str, Any], motors: List[Tuple[float, ...]], chain: Chain) -> Robot:
    """A robot read again from its file or text, with its motors and the chain of the pickle."""
    arguments = argument if isinstance(argument, tuple) else (argument,)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RobotWarning)  # they were given when the robot was read first
        robot: Robot = getattr(_kte, function)(*arguments, **options)
        for numbers in motors:
            robot.add_motors(**dict(zip(("stiffness", "damping", "stop_stiffness", "stop_damping"), numbers)))
    robot._put_chain(chain)
    return robot

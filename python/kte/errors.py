"""The exceptions of kte: the classes of the C++ library, with the same sentences (docs/errors.md)."""
from __future__ import annotations

__all__ = [
    "Error",
    "BadParameter",
    "BadWiring",
    "UnknownName",
    "BadArgument",
    "SingularMassMatrix",
    "NoSolution",
    "DeadPoint",
    "CannotAssemble",
    "BadFile",
    "MissingFile",
    "Unreachable",
    "IntegrationFailure",
    "RobotWarning",
]


class Error(Exception):
    """The base of all errors of this library."""


class BadParameter(Error, ValueError):
    """An invalid parameter of an element: a negative mass, an axis that is not of length 1, NaN."""


class BadWiring(Error, ValueError):
    """Elements that do not fit together: a frame written twice, read before it is written, of the wrong kind."""


class UnknownName(Error, LookupError):
    """A name that a chain does not have."""


class BadArgument(Error, ValueError):
    """An argument of the wrong shape or out of its range, or a result that is not finite."""


class SingularMassMatrix(Error, ArithmeticError):
    """The mass matrix has no factorization: a coordinate moves no mass."""


class NoSolution(Error, ArithmeticError):
    """Equations without a solution, or with several."""


class DeadPoint(Error, ArithmeticError):
    """A linkage at a dead point."""


class CannotAssemble(Error, ArithmeticError):
    """Loops that do not close from a guess."""


class BadFile(Error, ValueError):
    """A file that cannot be read or written; the text says where."""


class MissingFile(BadFile, FileNotFoundError):
    """A file that is not there."""


class Unreachable(Error, ArithmeticError):
    """A pose that the arm does not reach within its limits."""


class IntegrationFailure(Error, RuntimeError):
    """An integration that cannot go on."""

    #: of the failure, s
    time: float = 0.0
    #: "not_finite", "step_too_short", "too_many_steps", "no_convergence", "singular_matrix", "out_of_reach",
    #: "event_function" or "other"
    reason: str = "other"
    #: the message of the model, or the name of the event
    cause: str = ""
    #: index of the first number of the state that is not finite; -1 if unknown
    component: int = -1


class RobotWarning(UserWarning):
    """What is odd about a robot's file."""

"""Elements as data, and the conversion of their parameters."""
from __future__ import annotations

from typing import Any, Dict, Iterator, List, Optional, Protocol, Sequence, Tuple, Union, cast

import numpy as np
from numpy.typing import ArrayLike

from . import _kte
from .errors import BadParameter


class HasMatrix(Protocol):
    """A rotation with a matrix, such as `scipy.spatial.transform.Rotation`."""

    def as_matrix(self) -> Any: ...


#: A rotation: a matrix that maps own axes to parent axes, an object with `as_matrix()`, or in the plane an angle, rad.
Rotation = Union[ArrayLike, HasMatrix]


class Element:
    """An element of a chain as plain data: its type, the names that its ports are connected to, its parameters.

    The functions of `kte.elements` make them. `chain << element` appends one.
    """

    __slots__ = ("type", "ports", "parameters")

    def __init__(self, type: str, ports: Dict[str, str], parameters: Dict[str, List[float]]) -> None:
        self.type = type
        self.ports = dict(sorted(ports.items(), key=lambda port: port[0] not in ("loop", "contact")))  # their names first
        self.parameters = parameters

    def __repr__(self) -> str:
        arguments = [repr(name) for name in self.ports.values()]
        planar = self.type.endswith("_2D")
        for name, values in self.parameters.items():
            if not (planar and name == "axis" and values == [0.0, 0.0, 1.0]):  # which is no argument
                arguments.append(f"{name + '_length' if name in self.ports else name}={_short(values)}")
        return f"{self.type}({', '.join(arguments)})"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Element):
            return NotImplemented
        return (self.type, self.ports, self.parameters) == (other.type, other.ports, other.parameters)

    def __hash__(self) -> int:
        return hash((self.type, frozenset(self.ports.items())))

    def _record(self) -> Tuple[str, List[Tuple[str, str]], List[Tuple[str, List[float]]]]:
        return self.type, list(self.ports.items()), list(self.parameters.items())


def _short(values: Sequence[float]) -> str:
    if len(values) == 9:
        return str([list(values[i : i + 3]) for i in (0, 3, 6)])
    return repr(values[0] if len(values) == 1 else list(values))


def make(type: str, ports: Sequence[Tuple[str, str]], parameters: Sequence[Tuple[str, Optional[List[float]]]]) -> Element:
    """An element; parameters that are None are left out."""
    for role, name in ports:
        if not isinstance(name, str):
            raise TypeError(f"kte: {type}: {role} must be a str, the name of a coordinate, frame or signal, not {name!r}")
    element = Element(type, dict(ports), {name: values for name, values in parameters if values is not None})
    _kte._check_element(element._record())
    return element


class _Required:
    """The default of a parameter that must be given although optional ones precede it."""

    def __repr__(self) -> str:
        return "required"


required: Any = _Required()


def require(function: str, **arguments: Any) -> None:
    missing = [repr(name) for name, x in arguments.items() if x is required]
    if missing:
        raise TypeError(f"{function}() missing {len(missing)} required argument{'s' * (len(missing) > 1)}: {', '.join(missing)}")


def _array(name: str, x: ArrayLike) -> np.ndarray[Any, np.dtype[np.float64]]:
    _kte._refuse_masked(name, x)
    try:
        a = np.asarray(x)
        if a.dtype.kind not in "iuf":
            raise TypeError
        return a.astype(float)
    except (TypeError, ValueError):
        raise TypeError(f"kte: {name} must be numbers, not {x!r}") from None


def _refuse(name: str, a: np.ndarray[Any, Any], expected: str) -> None:
    raise BadParameter(f"kte: {name} has shape {a.shape}, expected {expected}")


def _list(a: np.ndarray[Any, Any]) -> List[float]:
    return cast(List[float], a.ravel().tolist())


def number(name: str, x: float) -> List[float]:
    a = _array(name, x)
    if a.size != 1:
        _refuse(name, a, "(): a number")
    return _list(a)


def flag(name: str, x: bool) -> Optional[List[float]]:
    return [1.0] if x else None


def number_list(name: str, x: ArrayLike) -> List[float]:
    a = _array(name, x)
    if a.ndim != 1:
        _refuse(name, a, "(n,): a list of numbers")
    return _list(a)


def vector(name: str, x: ArrayLike) -> List[float]:
    a = _array(name, x)
    if a.shape != (3,):
        _refuse(name, a, "(3,): x, y, z")
    return _list(a)


def planar_vector(name: str, x: ArrayLike) -> List[float]:
    a = _array(name, x)
    if a.shape not in ((2,), (3,)):
        _refuse(name, a, "(2,): x, y")
    return (_list(a) + [0.0])[:3]


planar_unit_vector = planar_vector


def surface_axis(name: str, x: Optional[ArrayLike], radius: float) -> List[float]:
    """Without an axis the half space below z = 0, or a ball."""
    return vector(name, ((0, 0, 0) if radius else (0, 0, 1)) if x is None else x)


def planar_surface_axis(name: str, x: Optional[ArrayLike], radius: float) -> List[float]:
    """Without an axis the half plane below y = 0, or a circle."""
    return planar_vector(name, ((0, 0) if radius else (0, 1)) if x is None else x)


def matrix(name: str, x: ArrayLike) -> List[float]:
    a = _array(name, x)
    if a.shape != (3, 3):
        _refuse(name, a, "(3, 3): a matrix")
    return _list(a)


def rotation(name: str, x: Optional[Rotation]) -> List[float]:
    if x is None:
        x = np.eye(3)
    elif hasattr(x, "as_matrix"):
        x = cast(HasMatrix, x).as_matrix()
    a = _array(name, cast(ArrayLike, x))
    if a.shape != (3, 3):
        _refuse(name, a, "(3, 3): a matrix that maps own axes to parent axes, or an object with as_matrix()")
    return _list(a)


def planar_rotation(name: str, x: Optional[Rotation]) -> List[float]:
    if x is None:
        return _list(np.eye(3))
    if not hasattr(x, "as_matrix"):
        a = _array(name, cast(ArrayLike, x))
        if a.ndim == 0:
            c, s = np.cos(a), np.sin(a)
            return [float(c), -float(s), 0.0, float(s), float(c), 0.0, 0.0, 0.0, 1.0]
        if a.shape == (2, 2):
            return [a[0, 0], a[0, 1], 0.0, a[1, 0], a[1, 1], 0.0, 0.0, 0.0, 1.0]
    return rotation(name, x)


def symmetric(name: str, x: ArrayLike) -> List[float]:
    """xx, xy, xz, yy, yz, zz of a matrix, of these six numbers, of the diagonal, or of one number for all of it."""
    a = _array(name, x)
    if a.ndim == 0:
        a = np.full(3, float(a))
    if a.shape == (3,):
        a = np.diag(a)
    if a.shape == (6,):
        return _list(a)
    if a.shape != (3, 3):
        _refuse(name, a, "(3, 3): a symmetric matrix; or (3,), its diagonal; or (6,), xx, xy, xz, yy, yz, zz")
    if not np.array_equal(a, a.T, equal_nan=True):
        raise BadParameter(f"kte: {name} must be a symmetric matrix, got {a.tolist()}")
    return _list(a[np.triu_indices(3)])


def planar_symmetric(name: str, x: ArrayLike) -> List[float]:
    a = _array(name, x)
    return [0.0, 0.0, 0.0, 0.0, 0.0, float(a)] if a.ndim == 0 else symmetric(name, x)



def flatten(parts: Any) -> Iterator[Any]:
    """The elements and chains of lists of them."""
    for part in parts:
        if isinstance(part, (list, tuple)):
            yield from flatten(part)
        else:
            yield part

"""Rigid and compliant contacts of points, capsules and boxes: contacts of spheres at their ends or corners."""
from __future__ import annotations

import inspect
from typing import Any, Callable, Concatenate, List, Optional, ParamSpec, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from . import elements
from ._element import Element, _array
from ._results import Array
from .errors import BadParameter

__all__ = [
    "point_contact_2D",
    "point_contact_3D",
    "capsule_contact_2D",
    "capsule_contact_3D",
    "box_contact_2D",
    "box_contact_3D",
    "compliant_capsule_contact_2D",
    "compliant_capsule_contact_3D",
    "compliant_box_contact_2D",
    "compliant_box_contact_3D",
]
P = ParamSpec("P")
R = TypeVar("R")


def _half(half: ArrayLike, dimension: int) -> Array:
    h = _array("half", half)
    if h.shape != (dimension,):
        raise BadParameter(f"kte: half must have {dimension} numbers, got {half!r}")
    return np.append(h, 0.0) if dimension == 2 else h


def _ends(half: ArrayLike, dimension: int) -> List[Array]:
    h = _half(half, dimension)
    return [h, -h]


def _corners(half: ArrayLike, dimension: int) -> List[Array]:
    """Counterclockwise from x, y > 0 in the plane; in space in the order of the binary numbers zyx."""
    h = _half(half, dimension)
    if not (np.isfinite(h).all() and (h[:dimension] > 0).all()):
        raise BadParameter(f"kte: half the lengths of a box must be finite and positive, got {half!r}")
    if dimension == 2:
        return [h * s for s in ((1, 1, 1), (-1, 1, 1), (-1, -1, 1), (1, -1, 1))]
    return [h * [1 if k & bit else -1 for bit in (1, 2, 4)] for k in range(8)]


def _at(dimension: int, kind: str, points: List[Array], names: List[str], *connected: str, **parameters: Any) -> List[Element]:
    """An element of a kind of contact at each point, with these names first."""
    make = getattr(elements, f"{kind}_{dimension}D")
    return [make(*names[k : k + 1], *connected, offset=p, **parameters) for k, p in enumerate(points)]


def _names(contact: str, part: str, points: List[Array]) -> List[str]:
    return [f"{contact}/{part} {k}" for k in range(1, len(points) + 1)]


def _in(dimension: int, function: Callable[Concatenate[int, P], R]) -> Callable[P, R]:
    """The function in the plane or in space."""

    def of_dimension(*arguments: P.args, **named: P.kwargs) -> R:
        return function(dimension, *arguments, **named)

    signature = inspect.signature(function)
    setattr(of_dimension, "__signature__", signature.replace(parameters=list(signature.parameters.values())[1:]))
    of_dimension.__name__ = of_dimension.__qualname__ = f"{function.__name__}_{dimension}D"
    of_dimension.__doc__ = function.__doc__
    return of_dimension


def point_contact(
    dimension: int,
    /,
    contact: str,
    frame1: str,
    frame2: str,
    friction: float = 0,
    restitution: float = 0,
    offset: Optional[ArrayLike] = None,
    surface_axis: Optional[ArrayLike] = None,
    surface_radius: float = 0,
) -> Element:
    """The rigid contact of a point of frame 2, by default its origin, with a surface of frame 1, by default a half space.

    friction: mu; restitution: e; offset: of the point, m; surface: as of sphere_contact.
    """
    make = elements.sphere_contact_2D if dimension == 2 else elements.sphere_contact_3D
    at = np.zeros(dimension) if offset is None else offset
    return make(contact, frame1, frame2, surface_axis, surface_radius, 0.0, at, friction, restitution)


def capsule_contact(
    dimension: int,
    /,
    contact: str,
    frame1: str,
    frame2: str,
    half: ArrayLike,
    radius: float,
    friction: float = 0,
    restitution: float = 0,
    surface_axis: Optional[ArrayLike] = None,
    surface_radius: float = 0,
) -> List[Element]:
    """The rigid contact of a capsule about the origin of frame 2 with a surface of frame 1, by default a half space.

    2 contacts `leg/end 1` ...; half: half the axis, m; radius, m; friction: mu; restitution: e. Its sides touch only
    what is flat.
    """
    points = _ends(half, dimension)
    return _at(
        dimension,
        "sphere_contact",
        points,
        _names(contact, "end", points),
        frame1,
        frame2,
        radius=radius,
        friction=friction,
        restitution=restitution,
        surface_axis=surface_axis,
        surface_radius=surface_radius,
    )


def box_contact(
    dimension: int,
    /,
    contact: str,
    frame1: str,
    frame2: str,
    half: ArrayLike,
    friction: float = 0,
    restitution: float = 0,
    surface_axis: Optional[ArrayLike] = None,
    surface_radius: float = 0,
) -> List[Element]:
    """The rigid contact of a box about the origin of frame 2 with a surface of frame 1, by default a half space.

    8 contacts, of a rectangle in the plane 4: `crate/corner 1` ...; half: half the lengths, m; friction: mu;
    restitution: e. Its sides touch only what is flat.
    """
    points = _corners(half, dimension)
    return _at(
        dimension,
        "sphere_contact",
        points,
        _names(contact, "corner", points),
        frame1,
        frame2,
        radius=0.0,
        friction=friction,
        restitution=restitution,
        surface_axis=surface_axis,
        surface_radius=surface_radius,
    )


def compliant_capsule_contact(
    dimension: int,
    /,
    frame1: str,
    frame2: str,
    half: ArrayLike,
    radius: float,
    stiffness: float,
    surface_axis: Optional[ArrayLike] = None,
    surface_radius: float = 0,
    **law: float,
) -> List[Element]:
    """The compliant contact of a capsule about the origin of frame 2 with a surface of frame 1, by default a half space.

    2 contacts; half: half the axis, m; radius, m; stiffness, N/m^p; law: exponent p, dissipation, s/m, friction,
    slip_speed, m/s, as of compliant_contact.
    """
    surface = {"surface_axis": surface_axis, "surface_radius": surface_radius}
    points = _ends(half, dimension)
    return _at(dimension, "compliant_contact", points, [], frame1, frame2, radius=radius, stiffness=stiffness, **surface, **law)


def compliant_box_contact(
    dimension: int,
    /,
    frame1: str,
    frame2: str,
    half: ArrayLike,
    stiffness: float,
    surface_axis: Optional[ArrayLike] = None,
    surface_radius: float = 0,
    **law: float,
) -> List[Element]:
    """The compliant contact of a box about the origin of frame 2 with a surface of frame 1, by default a half space.

    8 contacts, of a rectangle in the plane 4; half: half the lengths, m; stiffness, N/m^p; law: exponent p,
    dissipation, s/m, friction, slip_speed, m/s, as of compliant_contact.
    """
    surface = {"surface_axis": surface_axis, "surface_radius": surface_radius}
    points = _corners(half, dimension)
    return _at(dimension, "compliant_contact", points, [], frame1, frame2, radius=0.0, stiffness=stiffness, **surface, **law)


point_contact_2D, point_contact_3D = _in(2, point_contact), _in(3, point_contact)
capsule_contact_2D, capsule_contact_3D = _in(2, capsule_contact), _in(3, capsule_contact)
box_contact_2D, box_contact_3D = _in(2, box_contact), _in(3, box_contact)
compliant_capsule_contact_2D, compliant_capsule_contact_3D = _in(2, compliant_capsule_contact), _in(3, compliant_capsule_contact)
compliant_box_contact_2D, compliant_box_contact_3D = _in(2, compliant_box_contact), _in(3, compliant_box_contact)

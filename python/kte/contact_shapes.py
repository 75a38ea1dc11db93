"""Rigid and compliant contacts of capsules and boxes: lists of contacts of their ends or corners."""
from __future__ import annotations

from typing import Dict, List, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import ArrayLike

from ._element import Element
from ._results import Array
from .elements import compliant_contact_2D, compliant_contact_3D, sphere_contact_2D, sphere_contact_3D

__all__ = [
    "capsule_contact_2D",
    "capsule_contact_3D",
    "box_contact_2D",
    "box_contact_3D",
    "compliant_capsule_contact_2D",
    "compliant_capsule_contact_3D",
    "compliant_box_contact_2D",
    "compliant_box_contact_3D",
]


def _in_space(half: ArrayLike, size: int) -> Array:
    h = np.asarray(half, float)
    if h.shape != (size,):
        raise ValueError(f"kte: half must have {size} numbers, got {half!r}")
    return np.append(h, 0.0) if size == 2 else h


def _ends(half: ArrayLike, size: int) -> List[Array]:
    h = _in_space(half, size)
    return [h, -h]


def _corners(half: ArrayLike, size: int) -> List[Array]:
    """Counterclockwise from x, y > 0 in the plane; in space in the order of the binary numbers zyx."""
    h = _in_space(half, size)
    if size == 2:
        signs: Sequence[Sequence[int]] = [(1, 1, 1), (-1, 1, 1), (-1, -1, 1), (1, -1, 1)]
    else:
        signs = [[1 if k & bit else -1 for bit in (1, 2, 4)] for k in range(8)]
    return [h * s for s in signs]


def _rigid(
    size: int,
    contact: str,
    part: str,
    frame1: str,
    frame2: str,
    points: List[Array],
    radius: float,
    law: Tuple[float, float],
    surface: Tuple[ArrayLike, float],
) -> List[Element]:
    make = sphere_contact_2D if size == 2 else sphere_contact_3D
    return [make(f"{contact}/{part} {k}", frame1, frame2, *surface, radius, p, *law) for k, p in enumerate(points, 1)]


def _soft(
    size: int,
    frame1: str,
    frame2: str,
    points: List[Array],
    radius: float,
    stiffness: float,
    surface: Tuple[ArrayLike, float],
    parameters: Dict[str, float],
) -> List[Element]:
    make = compliant_contact_2D if size == 2 else compliant_contact_3D
    return [make(frame1, frame2, *surface, radius, stiffness, p, **parameters) for p in points]


def _surface(axis: Optional[ArrayLike], radius: float, size: int) -> Tuple[ArrayLike, float]:
    """Without an axis a half space, or a ball."""
    if axis is None:
        axis = (0, 0, 0) if radius else (0, 1, 0) if size == 2 else (0, 0, 1)
    return axis, radius


def capsule_contact_2D(
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

    2 contacts `leg/end 1` ...; `half`: half the axis, m; `radius`, m. Its sides touch only what is flat.
    """
    return _rigid(
        2, contact, "end", frame1, frame2, _ends(half, 2), radius, (friction, restitution), _surface(surface_axis, surface_radius, 2)
    )


def compliant_capsule_contact_2D(
    frame1: str,
    frame2: str,
    half: ArrayLike,
    radius: float,
    stiffness: float,
    surface_axis: Optional[ArrayLike] = None,
    surface_radius: float = 0,
    **parameters: float,
) -> List[Element]:
    """The compliant contact of a capsule about the origin of frame 2 with a surface of frame 1, by default a half space.

    2 contacts; `half`: half the axis, m; `radius`, m. `parameters`: exponent, dissipation, friction, slip_speed.
    """
    return _soft(2, frame1, frame2, _ends(half, 2), radius, stiffness, _surface(surface_axis, surface_radius, 2), parameters)


def capsule_contact_3D(
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

    2 contacts `leg/end 1` ...; `half`: half the axis, m; `radius`, m. Its sides touch only what is flat.
    """
    return _rigid(
        3, contact, "end", frame1, frame2, _ends(half, 3), radius, (friction, restitution), _surface(surface_axis, surface_radius, 3)
    )


def compliant_capsule_contact_3D(
    frame1: str,
    frame2: str,
    half: ArrayLike,
    radius: float,
    stiffness: float,
    surface_axis: Optional[ArrayLike] = None,
    surface_radius: float = 0,
    **parameters: float,
) -> List[Element]:
    """The compliant contact of a capsule about the origin of frame 2 with a surface of frame 1, by default a half space.

    2 contacts; `half`: half the axis, m; `radius`, m. `parameters`: exponent, dissipation, friction, slip_speed.
    """
    return _soft(3, frame1, frame2, _ends(half, 3), radius, stiffness, _surface(surface_axis, surface_radius, 3), parameters)


def box_contact_2D(
    contact: str,
    frame1: str,
    frame2: str,
    half: ArrayLike,
    friction: float = 0,
    restitution: float = 0,
    surface_axis: Optional[ArrayLike] = None,
    surface_radius: float = 0,
) -> List[Element]:
    """The rigid contact of a rectangle about the origin of frame 2 with a surface of frame 1, by default a half space.

    4 contacts `crate/corner 1` ...; `half`: half the lengths, m. Its sides touch only what is flat.
    """
    return _rigid(
        2, contact, "corner", frame1, frame2, _corners(half, 2), 0.0, (friction, restitution), _surface(surface_axis, surface_radius, 2)
    )


def compliant_box_contact_2D(
    frame1: str,
    frame2: str,
    half: ArrayLike,
    stiffness: float,
    surface_axis: Optional[ArrayLike] = None,
    surface_radius: float = 0,
    **parameters: float,
) -> List[Element]:
    """The compliant contact of a rectangle about the origin of frame 2 with a surface of frame 1, by default a half space.

    4 contacts; `half`: half the lengths, m. `parameters`: exponent, dissipation, friction, slip_speed.
    """
    return _soft(2, frame1, frame2, _corners(half, 2), 0.0, stiffness, _surface(surface_axis, surface_radius, 2), parameters)


def box_contact_3D(
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

    8 contacts `crate/corner 1` ...; `half`: half the lengths, m. Its sides touch only what is flat.
    """
    return _rigid(
        3, contact, "corner", frame1, frame2, _corners(half, 3), 0.0, (friction, restitution), _surface(surface_axis, surface_radius, 3)
    )


def compliant_box_contact_3D(
    frame1: str,
    frame2: str,
    half: ArrayLike,
    stiffness: float,
    surface_axis: Optional[ArrayLike] = None,
    surface_radius: float = 0,
    **parameters: float,
) -> List[Element]:
    """The compliant contact of a box about the origin of frame 2 with a surface of frame 1, by default a half space.

    8 contacts; `half`: half the lengths, m. `parameters`: exponent, dissipation, friction, slip_speed.
    """
    return _soft(3, frame1, frame2, _corners(half, 3), 0.0, stiffness, _surface(surface_axis, surface_radius, 3), parameters)

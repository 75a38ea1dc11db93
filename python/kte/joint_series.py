"""Joints of two coordinates, made of joints of one with the frame `end.inner` between, and fixed joints."""
from __future__ import annotations

from typing import List, Optional

import numpy as np
from numpy.typing import ArrayLike

from ._element import Element, Rotation, _array
from .elements import prismatic_joint_3D, revolute_joint_3D, rigid_link_2D, rigid_link_3D
from .errors import BadParameter

__all__ = ["cylindrical_joint_3D", "universal_joint_3D", "hooke_joint_3D", "fixed_joint_2D", "fixed_joint_3D"]


def _check_axes(axis1: ArrayLike, axis2: ArrayLike) -> None:
    if not np.linalg.norm(np.cross(_array("axis1", axis1), _array("axis2", axis2))) > 1e-6:
        raise BadParameter(f"kte: the axes of a universal joint must not be parallel, got {axis1!r} and {axis2!r}")


def cylindrical_joint_3D(
    turn: str,
    slide: str,
    base: str,
    end: str,
    axis: ArrayLike,
    position: Optional[ArrayLike] = None,
    rotation: Optional[Rotation] = None,
) -> List[Element]:
    """A sleeve on a shaft: turns about a unit axis n by `turn`, rad, and slides along it by `slide`, m.

    R = Rot(n, turn), p = slide n
    """
    inner = end + ".inner"
    return [revolute_joint_3D(turn, base, inner, axis, position, rotation), prismatic_joint_3D(slide, inner, end, axis)]


def universal_joint_3D(
    q1: str,
    q2: str,
    base: str,
    end: str,
    axis1: ArrayLike,
    axis2: ArrayLike,
    position: Optional[ArrayLike] = None,
    rotation: Optional[Rotation] = None,
) -> List[Element]:
    """A Cardan joint: a cross turns in the base about axis 1, the end in the cross about axis 2; unit vectors.

    R = Rot(n1, q1) Rot(n2, q2), p = 0
    """
    _check_axes(axis1, axis2)
    inner = end + ".inner"
    return [revolute_joint_3D(q1, base, inner, axis1, position, rotation), revolute_joint_3D(q2, inner, end, axis2)]


def hooke_joint_3D(
    q1: str,
    q2: str,
    base: str,
    end: str,
    axis1: ArrayLike,
    axis2: ArrayLike,
    offset: ArrayLike,
    position: Optional[ArrayLike] = None,
    rotation: Optional[Rotation] = None,
) -> List[Element]:
    """A universal joint with an offset r, m, from axis 1 to axis 2, in axes of the cross.

    R = Rot(n1, q1) Rot(n2, q2), p = Rot(n1, q1) r
    """
    _check_axes(axis1, axis2)
    inner = end + ".inner"
    first = revolute_joint_3D(q1, base, inner, axis1, position, rotation)
    return [first, revolute_joint_3D(q2, inner, end, axis2, position=offset)]


def fixed_joint_2D(
    base: str, end: str, position: ArrayLike = (0, 0), rotation: Optional[Rotation] = None
) -> Element:
    """A fixed joint in the plane: a `rigid_link_2D`."""
    return rigid_link_2D(base, end, position, rotation)


def fixed_joint_3D(
    base: str, end: str, position: ArrayLike = (0, 0, 0), rotation: Optional[Rotation] = None
) -> Element:
    """A fixed joint in space: a `rigid_link_3D`."""
    return rigid_link_3D(base, end, position, rotation)
